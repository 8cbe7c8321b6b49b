// Alarms that hold until somebody has seen them, and the button that says so: in every view, for the power stays off meanwhile.

import { byId, h, say } from "./dom";
import { route } from "./grid";
import type { Alarming, Health } from "./protocol";
import type { Source } from "./source";
import type { Store } from "./store";
import { quoted } from "./words";

const ARMED = 1000; // ms from one press to the next: the second click of a double one must not take an alarm that came between
const TOLD = 6000; // ms that an answer stays after which nothing holds

/** The alarm of one device. */
class Row {
  readonly element: HTMLElement;
  private name: HTMLElement;
  private text = h("p", { tabindex: -1 });
  private answer = h("span", { class: "answer bad", role: "status" });
  private button: HTMLButtonElement;
  private pressed = -ARMED; // ms
  private asking = false;
  private before: Health | null = null; // what was known when the server acknowledged: older than its answer
  private over: number | null = null; // ms, since when nothing holds

  constructor(private store: Store, private source: Source, private id: string) {
    this.button = h("button", { "aria-label": `Acknowledge the alarm of ${id}`, onclick: () => void this.acknowledge() }, "Acknowledge");
    this.name = h("strong", {}, id);
    this.element = h("div", {}, this.name, this.text, this.answer, this.button);
  }

  /** Whether there is still something to say. */
  update(alarm: Alarming | undefined): boolean {
    if (this.before && this.before === this.store.health) return true;
    this.before = null;
    if (!this.name.firstElementChild && this.store.devices.has(this.id)) this.name.replaceChildren(h("a", { href: route(this.id) }, this.id)); // it may never have come
    const waiting = alarm?.unacknowledged ?? [];
    if (waiting.length) this.ask(waiting);
    else this.tell(alarm?.holding ?? []);
    return this.over === null || performance.now() - this.over < TOLD;
  }

  private ask(waiting: string[]): void {
    const may = this.store.hello?.may_write !== false;
    this.over = null;
    say(this.text, `Alarm not acknowledged: ${quoted(waiting)} ${waiting.length === 1 ? "holds" : "hold"} until it has been and ${this.id} stands upright.${may ? "" : " This needs a token with the scope “write”."}`);
    this.button.hidden = false;
    this.button.disabled = !may;
    this.button.setAttribute("aria-disabled", String(this.busy));
  }

  /** It has been acknowledged, here or elsewhere: what holds even so. */
  private tell(holding: string[]): void {
    say(this.text, holding.length ? `Acknowledged. Until ${this.id} stands upright, there holds: ${quoted(holding)}.` : "Acknowledged: nothing holds any more.");
    say(this.answer, "");
    if (!this.button.hidden && document.activeElement === this.button) this.text.focus(); // else the keyboard begins at the top again
    this.button.hidden = true;
    this.over = holding.length ? null : (this.over ?? performance.now());
  }

  private get busy(): boolean {
    return this.asking || performance.now() - this.pressed < ARMED;
  }

  private async acknowledge(): Promise<void> {
    if (this.busy) return;
    this.pressed = performance.now();
    this.asking = true;
    this.button.setAttribute("aria-disabled", "true"); // and not disabled, which would take the focus from it
    say(this.answer, "");
    try {
      const { holding } = await this.source.ask({ type: "acknowledge", device: this.id });
      this.before = this.store.health;
      this.tell(holding ?? []);
    } catch (problem) {
      const told = this.store.link.state === "open" ? "Not acknowledged" : "No answer"; // without one it may have been
      say(this.answer, `${told}: ${(problem as Error).message}`);
    }
    this.asking = false;
  }
}

export class Latched {
  private element = byId("latched");
  private rows = new Map<string, Row>();

  constructor(private store: Store, private source: Source) {
    store.on(["hello"], () => this.clear()); // of a server that was started anew nothing before is true
  }

  update(): void {
    const { health } = this.store;
    if (!health) return;
    const alarms = new Map(health.alarms.map((alarm) => [alarm.device, alarm]));
    for (const alarm of health.alarms) if (alarm.unacknowledged.length && !this.rows.has(alarm.device)) this.add(alarm.device);
    for (const [id, row] of this.rows) if (!row.update(alarms.get(id))) this.remove(id, row);
    document.body.classList.toggle("latching", this.rows.size > 0);
  }

  private add(id: string): void {
    const row = new Row(this.store, this.source, id);
    this.rows.set(id, row);
    this.element.append(row.element);
  }

  private remove(id: string, row: Row): void {
    row.element.remove();
    this.rows.delete(id);
  }

  private clear(): void {
    for (const [id, row] of this.rows) this.remove(id, row);
  }
}
