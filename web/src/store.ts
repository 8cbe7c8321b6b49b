// All that the page holds: devices, their last minutes, their health, what happened.

import { AT, HEADER, RECORD, TIP } from "./protocol";
import type { DeviceHealth, DeviceInfo, Health, Hello, LiveEvent, Message, RunningMethod } from "./protocol";
import { Ring } from "./ring";
import type { Connection, Sink } from "./source";
import { UNKNOWN } from "./words";

/** s of the past that are kept, at 30 records a second */
export const KEPT = 300;
const MOST_RECORDS = 9000;
const MOST_BYTES = 192 << 20; // shared by all rings: a thousand devices keep seconds, not minutes
const MOST_EVENTS = 500;
const APART = 5; // s: a mapped clock that is further off, as of a replay at ten times the speed, is not plotted against

export interface Track {
  /** the device's name */
  device: string;
  method: RunningMethod;
  /** distinguishes the colours of methods side by side */
  colour: number;
  ring: Ring;
  /** whether the device still runs it */
  running: boolean;
}

type Topic = "hello" | "devices" | "health" | "event" | "connection";

export class Store implements Sink {
  /** s, the instant that is shown of recordings; null: whatever is newest */
  instant: (() => number) | null = null;
  hello: Hello | null = null;
  health: Health | null = null;
  readonly devices = new Map<string, DeviceInfo>();
  readonly conditions = new Map<string, DeviceHealth>();
  readonly events: LiveEvent[] = [];
  link: Connection = { state: "connecting" };
  dropped = 0;
  /** counts frames, so that who draws knows whether there is something new */
  version = 0;
  /** s, median of late, from the instant of a sample to its arrival here */
  readonly delays = new Map<string, number>();
  private tracks = new Map<string, Map<string, Track>>();
  private byNumber = new Map<number, { id: string; tracks: (Track | undefined)[] }>();
  private listeners = new Map<Topic, (() => void)[]>();
  private clock = Infinity; // s, this machine's clock ahead of the server's, at most
  private newest = 0;

  on(topics: Topic[], told: () => void): void {
    for (const topic of topics) this.listeners.set(topic, [...(this.listeners.get(topic) ?? []), told]);
  }

  private tell(topic: Topic): void {
    for (const told of this.listeners.get(topic) ?? []) told();
  }

  // -- what the source says -------------------------------------------------------------------------------------

  connection(now: Connection): void {
    this.link = now;
    this.version++;
    this.tell("connection");
  }

  message(message: Message): void {
    switch (message.type) {
      case "hello":
        this.hello = message;
        this.health = null; // of the connection before: it may have been another server's
        this.clock = Infinity;
        this.compareClocks(message.time);
        this.recall(message.events ?? []);
        return this.tell("hello");
      case "devices":
        this.setDevices(message.devices);
        return this.tell("devices");
      case "health":
        this.health = message;
        this.compareClocks(message.time);
        for (const each of message.devices) this.conditions.set(each.id, each);
        return this.tell("health");
      case "event":
        this.events.push(message);
        if (this.events.length > MOST_EVENTS) this.forgetOne();
        return this.tell("event");
      case "dropped":
        this.dropped = message.frames;
    }
  }

  frame(data: ArrayBuffer): boolean {
    let known = true;
    const head = new DataView(data);
    if (head.getUint8(0) !== 1 || head.getUint8(1) !== 2 || head.getUint16(2, true) !== RECORD) return known;
    const bytes = new Uint8Array(data);
    const now = this.serverNow();
    const most = Math.max(64, Math.min(MOST_RECORDS, Math.floor(MOST_BYTES / RECORD / Math.max(1, this.trackCount))));
    for (let offset = HEADER; offset + RECORD <= data.byteLength; offset += RECORD) {
      const device = this.byNumber.get(head.getUint32(offset, true));
      const track = device?.tracks[head.getUint8(offset + AT.method)];
      if (!device || !track) {
        known = false;
        continue;
      }
      const host = head.getFloat64(offset + 8 * AT.host, true);
      const at = this.instant || Math.abs(host - now) < APART ? host : now;
      track.ring.push(bytes, offset, at, most);
      if (at > this.newest) this.newest = at;
      const delay = this.delays.get(device.id);
      this.delays.set(device.id, delay === undefined ? now - at : delay + 0.05 * (now - at - delay));
    }
    this.version++;
    return known;
  }

  cleared(device: string): void {
    for (const { ring } of this.tracks.get(device)?.values() ?? []) ring.clear();
  }

  private setDevices(devices: DeviceInfo[]): void {
    this.devices.clear();
    this.byNumber.clear();
    for (const device of devices) {
      this.devices.set(device.id, device);
      const known = this.tracks.get(device.id) ?? new Map<string, Track>();
      this.tracks.set(device.id, known);
      for (const track of known.values()) track.running = false;
      const numbered: (Track | undefined)[] = [];
      for (const method of device.methods) {
        const key = `${method.name} ${method.settings}`;
        let track = known.get(key);
        if (!track) known.set(key, (track = { device: device.id, method, colour: unused(known), ring: new Ring(), running: true }));
        track.method = method;
        track.running = true;
        numbered[method.number] = track;
      }
      this.forget(known);
      this.byNumber.set(device.number, { id: device.id, tracks: numbered });
    }
    for (const id of this.tracks.keys()) if (!this.devices.has(id)) this.tracks.delete(id);
    this.version++;
  }

  /** Methods that a device ran before stay while there is something of them to scrub back to, two at most. */
  private forget(known: Map<string, Track>): void {
    const past = [...known].filter(([, track]) => !track.running);
    for (const [key] of past.slice(0, Math.max(0, past.length - 2))) known.delete(key);
  }

  private get trackCount(): number {
    let count = 0;
    for (const known of this.tracks.values()) count += known.size;
    return count;
  }

  /** Events before this page came, or while it was away. */
  private recall(past: LiveEvent[]): void {
    const named = ({ time, text }: LiveEvent) => `${time} ${text}`;
    const told = new Set(past.map(named));
    const own = this.events.filter((event) => !told.has(named(event)));
    this.events.splice(0, this.events.length, ...[...own, ...past].sort((a, b) => a.time - b.time));
  }

  /** The oldest event of the device that has most of them; alarms are counted by themselves. */
  private forgetOne(): void {
    const of = ({ device, kind }: LiveEvent) => `${kind === "tip"} ${device}`;
    const counts = new Map<string, number>();
    for (const event of this.events) counts.set(of(event), (counts.get(of(event)) ?? 0) + 1);
    const most = Math.max(...counts.values());
    this.events.splice(this.events.findIndex((event) => counts.get(of(event)) === most), 1);
  }

  private compareClocks(server: number): void {
    this.clock = Math.min(this.clock, Date.now() / 1000 - server);
  }

  // -- what the page asks ---------------------------------------------------------------------------------------

  /** s since 1970, by the server's clock. */
  serverNow(): number {
    return Date.now() / 1000 - (Number.isFinite(this.clock) ? this.clock : 0);
  }

  /** The instant that is shown when time is followed; it stands while there is no connection. */
  edge(): number {
    if (this.instant) return this.newest;
    return this.link.state === "open" ? this.serverNow() : this.newest || this.serverNow();
  }

  /** The instant of the newest record, or now where none has come of late. */
  lastSeen(): number {
    const edge = this.edge();
    return edge - this.newest < 0.5 ? this.newest : edge;
  }

  /** The first instant that is still held. */
  oldest(id?: string): number {
    let oldest = Infinity;
    for (const [device, known] of this.tracks) {
      if (id !== undefined && device !== id) continue;
      for (const { ring } of known.values()) if (ring.length) oldest = Math.min(oldest, ring.at(0));
    }
    return oldest;
  }

  /** What a device runs, then what it ran of late. */
  tracksOf(id: string): Track[] {
    return [...(this.tracks.get(id)?.values() ?? [])].sort((a, b) => Number(b.running) - Number(a.running) || a.method.number - b.method.number);
  }

  /** The first method of a device: what tiles show and what the monitor judges. */
  mainTrack(id: string): Track | undefined {
    return this.tracksOf(id)[0];
  }

  /** Bits that are set in *flags*, with their names and sentences. */
  sentences(flags: number): { bit: number; name: string; sentence: string; invalid: boolean }[] {
    const found = [];
    for (let bit = 0; bit < 32; bit++) {
      const known = (flags >>> bit) & 1 ? this.hello?.flags[bit] : undefined;
      if (known) found.push({ bit, name: known[0], sentence: known[1], invalid: ((this.hello!.invalid_flags >>> bit) & 1) === 1 });
    }
    return found;
  }

  /** Why record *k* must not be acted on; empty where it may be. */
  whyInvalid(track: Track, k: number): string {
    if (this.link.state !== "open") return "connection lost: the attitude now is unknown";
    const state = this.conditions.get(track.device)?.state;
    const why = state && UNKNOWN[state];
    if (k < 0) return why ?? "no sample yet";
    if (track.ring.valid(k)) return "";
    const reasons = this.sentences(track.ring.flags(k)).filter((each) => each.invalid);
    return reasons.map((each) => (each.name === "SILENT" && why ? why : each.sentence)).join("; ") || "the method says that it may not be acted on";
  }

  /** The tip-over state of now. */
  tipOf(id: string): number | null {
    const ring = this.mainTrack(id)?.ring;
    if (!ring?.length) return null;
    const state = ring.tip(this.instant ? Math.max(0, ring.find(this.instant())) : ring.length - 1);
    return state < TIP.length ? state : null;
  }
}

function unused(known: Map<string, Track>): number {
  const taken = new Set([...known.values()].map((track) => track.colour));
  let colour = 0;
  while (taken.has(colour)) colour++;
  return colour % 6;
}
