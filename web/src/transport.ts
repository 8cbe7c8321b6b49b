// Pause, and scrub back over what is held.

import { byId, h, say } from "./dom";
import type { Playhead } from "./playhead";
import { KEPT } from "./store";
import type { Store } from "./store";

const WINDOWS: [number, string][] = [[10, "10 s"], [30, "30 s"], [120, "2 min"], [KEPT, "5 min"]];

const STEP = 0.05; // s

export class Transport {
  private pause = h("button", { class: "play", id: "pause", onclick: () => this.playhead.toggle() }, "Pause");
  private slider = h("input", { type: "range", id: "scrub", "aria-label": "Instant shown, seconds before now", max: 0, step: STEP, value: 0 });
  private label = h("output", { for: "scrub", id: "instant" });
  private written = 0;
  private dragged = false; // else what is shown moves into the past, and the thumb with it

  constructor(private store: Store, private playhead: Playhead) {
    const windows = WINDOWS.map(([seconds, text]) => {
      const choice = h("input", { type: "radio", name: "window", id: `window-${seconds}`, value: seconds, checked: seconds === playhead.window, onchange: () => playhead.setWindow(seconds) });
      return h("label", { for: choice.id }, choice, h("span", {}, text));
    });
    byId("transport").append(this.pause, this.slider, this.label, h("fieldset", { class: "windows" }, h("legend", { class: "unseen" }, "Plots reach back"), ...windows));
    this.slider.addEventListener("input", () => {
      const back = Number(this.slider.value);
      if (back >= 0) playhead.follow();
      else playhead.seek(store.edge() + back);
    });
    this.slider.addEventListener("pointerdown", () => (this.dragged = true));
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => (this.dragged = false));
    playhead.onChange(() => this.write());
    addEventListener("keydown", (key) => {
      const target = key.target as HTMLElement;
      if (key.key !== " " || target.closest("button, input, select, textarea, summary, a, dialog")) return;
      key.preventDefault();
      playhead.toggle();
    });
  }

  update(now: number): void {
    if (now - this.written < 200) return;
    this.written = now;
    this.write();
  }

  private write(): void {
    const edge = this.store.edge();
    const back = this.playhead.following ? 0 : Math.min(0, this.playhead.time - edge);
    const oldest = this.store.oldest();
    const longest = Math.max(1, Math.min(KEPT + 60, Number.isFinite(oldest) ? edge - oldest : 1));
    this.slider.min = (-Math.ceil(longest / STEP) * STEP).toFixed(2); // of whole steps, or now would be none
    if (!this.dragged) this.slider.value = String(back);
    const text = this.playhead.following ? "now" : `${back.toFixed(1).replace("-", "−")} s`;
    say(this.label, text);
    this.slider.setAttribute("aria-valuetext", this.playhead.following ? "now" : `${(-back).toFixed(1)} seconds ago`);
    say(this.pause, this.playhead.following ? "Pause" : "Back to now");
    this.pause.setAttribute("aria-pressed", String(!this.playhead.following));
    document.body.classList.toggle("paused", !this.playhead.following);
  }
}
