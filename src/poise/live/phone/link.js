// The connection to /ws/device/NAME: samples are counted, kept, and sent again from where the server says. docs/live.md.

const VERSION = 1, MOTION = 3, NUMBERS = 10, HEADER = 16;
const EVERY = 45; // ms between frames
const MOST_IN_FRAME = 500;
const MOST_WAITING = 256 * 1024; // bytes in the socket; more would only wait there
const MOST_KEPT = 40_000; // samples, about ten minutes, while the server keeps a recording
const MOST_KEPT_UNRECORDED = 4_000;
const SLOWEST = 5000; // ms between attempts

export class Link {
  /** changed(link) is called when the state is another, heard(message) with what the server says. */
  constructor(name, token, changed, heard) {
    Object.assign(this, { name, token, changed, heard });
    this.state = "connecting"; // connecting, on, lost, refused, closed
    this.problem = "";
    this.kept = [];
    this.first = 0; // number of kept[0]
    this.next = 0; // number of the next sample to send
    this.acked = null; // all below it are on the server's disk
    this.recording = false;
    this.givenUp = 0;
    this.axes = null;
    this.everSent = false;
    this.wait = 500;
    this.sentAt = 0;
  }

  open() {
    if (this.state === "closed") return;
    clearTimeout(this.retry);
    const query = new URLSearchParams({ shape: "phone" });
    if (this.axes) query.set("axes", this.axes);
    const address = `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/ws/device/${encodeURIComponent(this.name)}?${query}`;
    const protocols = this.token ? ["poise", `bearer.${this.token}`] : ["poise"];
    const socket = (this.socket = new WebSocket(address, protocols));
    let opened = false;
    socket.onopen = () => { opened = true; };
    socket.onmessage = ({ data }) => { if (socket === this.socket) this.message(JSON.parse(data)); };
    socket.onclose = ({ code, reason }) => { if (socket === this.socket) this.lost(opened, code, reason); };
  }

  close() {
    this.flush();
    this.set("closed");
    clearTimeout(this.retry);
    this.socket?.close(1000);
  }

  /** Keeps a sample, and sends it when it is time. */
  push(sample) {
    this.kept.push(sample);
    const most = this.recording ? MOST_KEPT : MOST_KEPT_UNRECORDED;
    if (this.kept.length > most + 500) this.forget(this.first + this.kept.length - most);
    if (performance.now() - this.sentAt >= EVERY) this.flush();
  }

  /** Tells whoever looks after the server. */
  note(text) {
    if (this.state === "on") this.socket.send(JSON.stringify({ type: "note", text }));
  }

  flush() {
    while (this.state === "on" && this.unsent > 0 && this.socket.bufferedAmount < MOST_WAITING) {
      const at = this.next - this.first;
      const samples = this.kept.slice(at, at + MOST_IN_FRAME);
      this.socket.send(encoded(samples, this.next));
      this.next += samples.length;
      this.everSent = true;
      this.sentAt = performance.now();
    }
  }

  get unsent() {
    return this.first + this.kept.length - this.next;
  }

  message(message) {
    if (message.type === "welcome") this.welcome(message.next);
    else if (message.type === "ack") this.acknowledge(message.next);
    else if (message.type === "recording") this.recording = message.reason === null;
    else if (message.type === "axes") this.axes = message.axes;
    this.heard(message);
  }

  /** Goes on from where the server is. */
  welcome(next) {
    if (!this.everSent) this.first = this.next = next; // this page is new: it counts on
    else if (next > this.first + this.kept.length) { // another page has used the name meanwhile
      this.kept = this.kept.slice(this.next - this.first);
      this.first = this.next = next;
    } else this.next = Math.max(next, this.first);
    this.wait = 500;
    this.set("on");
    this.flush();
  }

  acknowledge(next) {
    this.recording = true;
    this.acked = next;
    this.forget(Math.min(next, this.next));
  }

  forget(below) {
    const count = Math.min(below - this.first, this.kept.length);
    if (count <= 0) return;
    this.kept.splice(0, count);
    this.first += count;
    if (this.next < this.first) {
      this.givenUp += this.first - this.next;
      this.next = this.first;
    }
  }

  async lost(opened, code, reason) {
    if (this.state === "closed") return;
    const problem = opened ? reason || "the connection was cut" : await this.why();
    if (this.state === "closed") return;
    this.problem = problem;
    this.set(code === 1008 || (!opened && problem.startsWith("refused")) ? "refused" : "lost");
    this.retry = setTimeout(() => this.open(), this.wait);
    this.wait = Math.min(2 * this.wait, SLOWEST);
  }

  /** A WebSocket that was not opened does not say why; the same address over HTTP does. */
  async why() {
    const headers = this.token ? { Authorization: `Bearer ${this.token}` } : {};
    try {
      const answer = await fetch(`/ws/device/${encodeURIComponent(this.name)}`, { headers, cache: "no-store" });
      if (answer.status === 401) return "refused: this address has no valid token (any more); scan the server's code again";
      if (answer.status === 403) return `refused: ${await answer.text()}`;
      return "refused-socket";
    } catch {
      return "the server cannot be reached";
    }
  }

  set(state) {
    this.state = state;
    this.changed(this);
  }
}

function encoded(samples, number) {
  const buffer = new ArrayBuffer(HEADER + 8 * NUMBERS * samples.length);
  const view = new DataView(buffer);
  view.setUint8(0, VERSION);
  view.setUint8(1, MOTION);
  view.setUint16(2, 8 * NUMBERS, true);
  view.setUint32(4, samples.length, true);
  view.setBigUint64(8, BigInt(number), true);
  samples.forEach((sample, i) => sample.forEach((value, k) => view.setFloat64(HEADER + 8 * (NUMBERS * i + k), value, true)));
  return buffer;
}
