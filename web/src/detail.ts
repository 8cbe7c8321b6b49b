// One device: its body, its numbers, its plots, its methods.

import { BodyView } from "./bodies";
import type { Quantity } from "./curves";
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
import { route } from "./grid";
import type { Drawn } from "./scene";
import type { Source } from "./source";
import type { Stage } from "./stage";
import type { Store } from "./store";

export class Detail {
  readonly element: HTMLElement;
  private body = h("div", { class: "body", tabindex: 0, role: "img" });
  private readout: Readout;
  private plots: Plots;
  private methods: Methods | null;
  private link: Link;
  private events: Events;
  private view: BodyView;
  private answer = h("p", { class: "answer", role: "status", "aria-live": "polite" });
  private forward: HTMLButtonElement;
  private card: HTMLElement;

  constructor(private store: Store, playhead: Playhead, private stage: Stage, private source: Source, readonly device: DeviceInfo) {
    const joint = device.shape === "joint";
    this.readout = new Readout(store, playhead, device);
    this.plots = new Plots(store, playhead, device);
    this.methods = joint ? null : new Methods(store, source, device.id);
    this.link = new Link(store, device);
    this.events = new Events(store, device.id);
    this.body.setAttribute("aria-label", `${device.id}: ${joint ? "how it stands seen from its base" : "its body over the ground, north marked"}. Arrow keys turn the view.`);
    this.view = new BodyView(store, playhead, device.id, this.body, device.shape);
    this.forward = h("button", { onclick: () => void this.reset() }, joint ? "Both point the same way" : "This way is forward");
    this.forward.title = joint ? `Sets the headings of ${device.segment} and ${device.base} to 0° where their y axes point now` : "Sets the heading to 0° where its y axis points now";
    this.card = h("section", { class: "card", "aria-label": "Attitude" }, this.body, this.readout.element, source.live && h("div", { class: "actions" }, this.forward, this.answer));
    this.element = h(
      "div",
      { class: "detail" },
      h("div", { class: "left" }, this.card),
      this.plots.element,
      source instanceof FilmSource
        ? h("aside", { class: "side", "aria-label": "Methods and flags" }, new Filmed(store, playhead, device.id, source.films.get(device.id)!).element)
        : h("aside", { class: "side", "aria-label": "Methods, link and events" }, this.methods?.element ?? parts(device), this.link.element, this.events.element),
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

  /** The ends of a plot's scale. */
  ends(quantity: Quantity): [number, number] | null {
    return this.plots.ends(quantity);
  }

  sync(): void {
    this.methods?.sync();
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
      const { id, segment, base } = this.device;
      for (const device of segment && base ? [segment, base] : [id]) await this.source.ask({ type: "reset_heading", device, forward: "y" });
      say(this.answer, segment && base ? "Both headings set to 0°" : "Heading set to 0°");
    } catch (problem) {
      say(this.answer, (problem as Error).message);
      this.answer.classList.add("bad");
    }
    setTimeout(() => say(this.answer, ""), 4000);
  }
}

/** Which devices a joint is between. */
function parts({ segment, base }: DeviceInfo): HTMLElement {
  const row = (name: string, id = "") => h("div", {}, h("dt", {}, name), h("dd", {}, h("a", { href: route(id) }, id)));
  return h(
    "section",
    { class: "panel", "aria-label": "Joint" },
    h("h2", {}, "Joint"),
    h("dl", { class: "facts" }, row("Segment", segment), row("Seen from", base)),
    h("p", { class: "note" }, "A difference between the headings of the two is in it. Hold both so that their y axes point the same way, then press the button."),
  );
}
