// The live source: a WebSocket that comes back by itself.

import type { Command, Done, Message } from "./protocol";
import type { Sink, Source } from "./source";

const KEY = "poise.token";
const FIRST_WAIT = 0.5;
const LONGEST_WAIT = 5;
/** As the server takes them: others could not even be sent. */
const TOKEN = /^[A-Za-z0-9._~-]+$/;
/** s without a message after which the connection is taken for dead: the server tells its health once a second. */
const DEAF = 6;

/** The token of `#token=…`, taken out of the address at once so that it is in no bookmark. */
export function tokenFromAddress(): string | null {
  const found = /^#token=([A-Za-z0-9._~-]+)/.exec(location.hash);
  if (!found) return null;
  sessionStorage.setItem(KEY, found[1]);
  history.replaceState(null, "", location.pathname + location.search);
  return found[1];
}

/** GET of the page's own server, with the token where there is one. */
export async function serverGet(path: string): Promise<Response> {
  const token = sessionStorage.getItem(KEY);
  return fetch(path, { headers: token ? { Authorization: `Bearer ${token}` } : {}, cache: "no-store" });
}

export class SocketSource implements Source {
  readonly live = true;
  private sink!: Sink;
  private socket: WebSocket | null = null;
  private wait = FIRST_WAIT;
  private lostAt = 0;
  private heard = 0;
  private asked = 0;
  private retry = 0;
  /** whether something came of devices that were told of only later */
  private missed = false;
  private pending = new Map<string, { resolve: (done: Done) => void; reject: (reason: Error) => void }>();

  start(sink: Sink): void {
    this.sink = sink;
    this.connect();
    setInterval(() => this.listen(), 1000);
  }

  identify(token: string): void {
    if (!TOKEN.test(token)) return this.sink.connection({ state: "refused", reason: "A token has letters, digits and . _ ~ - only." });
    sessionStorage.setItem(KEY, token);
    this.connect();
  }

  get(path: string): Promise<Response> {
    return serverGet(path);
  }

  ask(command: Command): Promise<Done> {
    const id = `page-${++this.asked}`;
    return new Promise((resolve, reject) => {
      if (this.socket?.readyState !== WebSocket.OPEN) return reject(new Error("there is no connection to the server"));
      this.pending.set(id, { resolve, reject });
      this.socket.send(JSON.stringify({ ...command, id }));
    });
  }

  private connect(): void {
    clearTimeout(this.retry);
    this.leave();
    this.sink.connection({ state: "connecting" });
    const token = sessionStorage.getItem(KEY);
    const address = location.origin.replace(/^http/, "ws") + "/ws/view";
    const socket = new WebSocket(address, token ? ["poise", `bearer.${token}`] : ["poise"]);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.heard = performance.now();
    let opened = false;
    socket.onopen = () => {
      opened = true;
      this.wait = FIRST_WAIT;
      this.lostAt = 0;
      this.sink.connection({ state: "open" });
    };
    socket.onmessage = ({ data }) => {
      if (this.socket !== socket) return;
      this.heard = performance.now();
      if (data instanceof ArrayBuffer) this.missed = !this.sink.frame(data) || this.missed;
      else this.hear(JSON.parse(data as string) as Message);
    };
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.leave();
      if (opened) this.again();
      else void this.why();
    };
  }

  /** The socket, if any, is no longer listened to, and what was asked of it is not answered. */
  private leave(): void {
    const socket = this.socket;
    this.socket = null;
    socket?.close();
    for (const { reject } of this.pending.values()) reject(new Error("the connection was lost"));
    this.pending.clear();
  }

  private hear(message: Message): void {
    if (message.type === "done" || message.type === "error") {
      const waiting = this.pending.get(message.id ?? "");
      this.pending.delete(message.id ?? "");
      if (message.type === "done") waiting?.resolve(message);
      else waiting?.reject(new Error(message.message));
    }
    this.sink.message(message);
    if (message.type === "devices" && this.missed && this.socket?.readyState === WebSocket.OPEN) {
      this.missed = false;
      this.socket.send(JSON.stringify({ type: "subscribe" })); // the newest of all again: one that is silent by now says no more
    }
  }

  /** A refused upgrade looks like a dead server to a page; a plain request tells them apart. */
  private async why(): Promise<void> {
    try {
      const answer = await this.get("/devices");
      if (answer.status === 401) {
        const had = sessionStorage.getItem(KEY) !== null;
        sessionStorage.removeItem(KEY);
        return this.sink.connection({ state: "refused", reason: had ? "That token is not one of this server, or it may not look: the scope “read” is needed." : "" });
      }
    } catch {
      // not there: tried again below
    }
    this.again();
  }

  private again(): void {
    this.lostAt ||= Date.now();
    this.sink.connection({ state: "lost", since: this.lostAt, retryAt: Date.now() + 1000 * this.wait });
    this.retry = setTimeout(() => this.connect(), 1000 * this.wait);
    this.wait = Math.min(LONGEST_WAIT, 1.6 * this.wait);
  }

  private listen(): void {
    if (this.socket?.readyState === WebSocket.OPEN && performance.now() - this.heard > 1000 * DEAF) {
      this.leave();
      this.again();
    }
  }
}
