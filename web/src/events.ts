// What happened, the newest first.

import { h } from "./dom";
import type { LiveEvent } from "./protocol";
import type { Store } from "./store";

const SHOWN = 40;
const EVERY = 500; // ms
const CLOCK = new Intl.DateTimeFormat("en-GB", { timeStyle: "medium" });

export class Events {
  readonly element: HTMLElement;
  private list = h("ol", { class: "events" });
  private newest = -1;
  private written = -EVERY;

  /** Of one device, or of all. */
  constructor(private store: Store, private id: string | null) {
    this.element = h("section", { class: "panel", "aria-label": "Events" }, h("h2", {}, "Events"), this.list);
    this.update(0);
  }

  update(now: number): void {
    if (now - this.written < EVERY) return;
    this.written = now;
    const found = this.store.events.filter((event) => this.id === null || event.device === this.id || event.device === null).slice(-SHOWN);
    const newest = found.at(-1)?.time ?? 0;
    if (newest === this.newest) return;
    this.newest = newest;
    this.list.replaceChildren(...found.reverse().map(row));
    if (!found.length) this.list.append(h("li", { class: "none" }, "Nothing of late"));
  }
}

function row(event: LiveEvent): HTMLElement {
  const at = new Date(1000 * event.time);
  const loud = event.kind === "tip" && ["TIPPING", "FALLEN", "FREE_FALL"].includes(event.state ?? "");
  return h("li", { class: loud ? "bad" : "" }, h("time", { datetime: at.toISOString() }, CLOCK.format(at)), h("span", {}, event.text));
}
