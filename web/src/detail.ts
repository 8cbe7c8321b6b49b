// One device: its body, its numbers, its plots, its methods.

import { BodyView } from "./bodies";
import { h, say } from "./dom";
import { Events } from "./events";
import { FilmSource } from "./film";
import { Filmed } from "./filmed";
import { Link } from "./link";
import { Methods } from "./methods";
import type { Playhead } from "./playhead";
import { Plots } from "./plots";
import { ALARMING } from "./protocol";
import type { DeviceInfo } from "./protocol";
import { Readout } from "./readout";
import type { Drawn } from "./scene";
import type { Source } from "./source";
import type { Stage } from "./stage";
import type { Store } from "./store";

export class Detail {
  readonly element: HTMLElement;
  private body = h("div", { class: "body", tabindex: 0, role: "img" });
  private readout: Readout;
  private plots: Plots;
  private methods: Methods;
  private link: Link;
  private events: Events;
  private view: BodyView;
  private answer = h("p", { class: "answer", role: "status", "aria-live": "polite" });
  private forward: HTMLButtonElement;
  private card: HTMLElement;

  constructor(private store: Store, playhead: Playhead, private stage: Stage, private source: Source, readonly device: DeviceInfo) {
    this.readout = new Readout(store, playhead, device.id);
    this.plots = new Plots(store, playhead, device.id);
    this.methods = new Methods(store, source, device.id);
    this.link = new Link(store, device.id);
    this.events = new Events(store, device.id);
    this.body.setAttribute("aria-label", `${device.id}: its body over the ground, north marked. Arrow keys turn the view.`);
    this.view = new BodyView(store, playhead, device.id, this.body, device.shape, true);
    this.forward = h("button", { onclick: () => void this.reset() }, "This way is forward");
    this.forward.title = "Sets the heading to 0° where its y axis points now";
    this.card = h("section", { class: "card", "aria-label": "Attitude" }, this.body, this.readout.element, source.live && h("div", { class: "actions" }, this.forward, this.answer));
    this.element = h(
      "div",
      { class: "detail" },
      h("div", { class: "left" }, this.card),
      this.plots.element,
      source instanceof FilmSource
        ? h("aside", { class: "side", "aria-label": "Methods and flags" }, new Filmed(store, playhead, device.id, source.films.get(device.id)!).element)
        : h("aside", { class: "side", "aria-label": "Methods, link and events" }, this.methods.element, this.link.element, this.events.element),
    );
    stage.add(this.view);
    if (!stage.works) this.body.append(h("p", { class: "note" }, "This browser draws no WebGL: numbers and plots only."));
    this.sync();
  }

  destroy(): void {
    this.stage.remove(this.view);
    this.plots.destroy();
  }

  drawn(method = 0): Drawn | null {
    return this.view.scene.drawn(method);
  }

  sync(): void {
    this.methods.sync();
    const may = this.store.hello?.may_write !== false;
    this.forward.disabled = !may || !this.source.live;
    if (!may) this.forward.title = "This needs a token with the scope “write”";
  }

  update(now: number): void {
    const state = this.readout.update(now);
    if (state) {
      this.card.classList.toggle("invalid", state.invalid !== "");
      this.card.classList.toggle("alarming", state.tip !== null && ALARMING.has(state.tip) && this.store.link.state === "open");
    }
    this.plots.update(now);
    this.link.update(now);
    this.events.update(now);
  }

  private async reset(): Promise<void> {
    this.answer.classList.remove("bad");
    try {
      await this.source.ask({ type: "reset_heading", device: this.device.id, forward: "y" });
      say(this.answer, "Heading set to 0°");
    } catch (problem) {
      say(this.answer, (problem as Error).message);
      this.answer.classList.add("bad");
    }
    setTimeout(() => say(this.answer, ""), 4000);
  }
}
