// What must not be overlooked: a device that tips over, or a connection that is gone.

import { byId, h, say } from "./dom";
import { route } from "./grid";
import { ALARMING } from "./protocol";
import type { LiveEvent } from "./protocol";
import type { Store } from "./store";
import { tipWord } from "./words";

const SHOWN = 3;
const TIPPING = 3;

export class Alarm {
  private element = byId("alarm");
  private shown = "";

  constructor(private store: Store) {}

  update(): void {
    const alarming = [...this.store.devices.keys()].filter((id) => ALARMING.has(this.store.tipOf(id) ?? 255));
    const facts = this.store.link.state + alarming.map((id) => `${id} ${this.store.tipOf(id)} ${this.last(id)?.number}`).join("|");
    if (facts === this.shown) return;
    this.shown = facts;
    this.element.replaceChildren(...alarming.slice(0, SHOWN).map((id) => this.row(id)));
    if (alarming.length > SHOWN) this.element.append(h("p", {}, `and ${alarming.length - SHOWN} more`));
    document.body.classList.toggle("alarmed", alarming.length > 0);
  }

  private last(id: string): LiveEvent | undefined {
    return this.store.events.findLast((event) => event.kind === "tip" && event.device === id);
  }

  private row(id: string): HTMLElement {
    const state = this.store.tipOf(id)!;
    const event = this.last(id);
    const told = event?.state === ["UNKNOWN", "UPRIGHT", "LEANING", "TIPPING", "FALLEN", "FREE_FALL"][state] ? event : undefined;
    const facts = [
      typeof told?.tilt_deg === "number" ? `tilt ${told.tilt_deg.toFixed(0)}°` : "",
      state === TIPPING && typeof told?.impact_s === "number" ? `hits the ground in ${told.impact_s.toFixed(1)} s unless caught` : "",
    ].filter(Boolean);
    const word = `${this.store.link.state === "open" ? "" : "was "}${tipWord(state)}`;
    return h("p", {}, h("strong", {}, `${word[0].toUpperCase()}${word.slice(1)}${told?.direction ? ` ${told.direction}` : ""}`), h("a", { href: route(id) }, id), h("span", {}, facts.join(" · ")));
  }
}

export class Banner {
  private element = byId("banner");

  constructor(private store: Store) {}

  update(): void {
    const { link } = this.store;
    const lost = link.state === "lost";
    document.body.classList.toggle("lost", lost || (link.state === "connecting" && document.body.classList.contains("lost")));
    if (!lost) {
      if (link.state === "open") say(this.element, "");
      return;
    }
    const wait = Math.max(0, Math.ceil((link.retryAt - Date.now()) / 1000));
    const gone = Math.round((Date.now() - link.since) / 1000);
    say(this.element, `Connection lost ${gone} s ago: what is shown is the last that came. ${wait ? `Trying again in ${wait} s.` : "Trying again …"}`);
  }
}
