// How a device's samples arrive.

import { fixed } from "./attitude";
import { h, say } from "./dom";
import type { DeviceInfo } from "./protocol";
import type { Store } from "./store";
import { count, STATES } from "./words";

const ROWS = ["State", "Source", "Rate", "Samples", "Lost", "Repeated", "Refused", "Silences", "Delay to here", "In the server, p99", "Clock drift"] as const;
type Row = (typeof ROWS)[number];
/** of a joint, to which nothing is sent */
const OF_JOINT: readonly Row[] = ["State", "Source", "Rate", "Samples", "Delay to here"];

export class Link {
  readonly element: HTMLElement;
  private values: Map<Row, HTMLElement>;
  private id: string;
  private written = 0;

  constructor(private store: Store, device: DeviceInfo) {
    this.id = device.id;
    this.values = new Map((device.shape === "joint" ? OF_JOINT : ROWS).map((name) => [name, h("dd", {}, "–")]));
    const rows = [...this.values].map(([name, value]) => h("div", {}, h("dt", {}, name), value));
    this.element = h("section", { class: "panel", "aria-label": "Link" }, h("h2", {}, "Link"), h("dl", { class: "facts" }, ...rows));
  }

  update(now: number): void {
    if (now - this.written < 500) return;
    this.written = now;
    const health = this.store.conditions.get(this.id);
    const device = this.store.devices.get(this.id);
    if (!health || !device) return;
    const heard = health.state === "silent" && health.last_heard_s !== null ? ` for ${fixed(health.last_heard_s, 1)} s` : "";
    const delay = this.store.delays.get(this.id);
    const p99 = health.wait_ms?.p99 ?? this.store.health?.wait_ms.p99;
    const open = this.store.link.state === "open";
    this.set("State", open ? STATES[health.state] + heard : "not known: connection lost", open && health.state === "failed");
    this.set("Source", device.source);
    this.set("Rate", `${fixed(health.rate_hz, 1)} Hz`);
    this.set("Samples", count(health.samples));
    this.set("Lost", count(health.lost), health.lost > 0);
    this.set("Repeated", count(health.repeated));
    this.set("Refused", count(health.rejected), health.rejected > 0);
    this.set("Silences", count(health.silences));
    this.set("Delay to here", delay === undefined ? "–" : `${fixed(Math.max(0, 1000 * delay), 0)} ms`);
    this.set("In the server, p99", typeof p99 === "number" ? `${fixed(p99, 1)} ms` : "–");
    this.set("Clock drift", `${fixed(health.clock_drift_ppm, 1)} ppm`);
  }

  private set(name: Row, text: string, bad = false): void {
    const value = this.values.get(name);
    if (!value) return;
    say(value, text);
    value.classList.toggle("bad", bad);
  }
}
