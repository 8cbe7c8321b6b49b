// Playing a recording: an instant that runs, a slider over all of it.

import { byId, h, say } from "./dom";
import type { FilmSource } from "./film";
import { Playhead } from "./playhead";
import type { Store } from "./store";

const SPEEDS = [0.1, 0.5, 1, 2, 5, 20];
const WINDOWS: [number, string][] = [[5, "5 s"], [30, "30 s"], [120, "2 min"], [Infinity, "All"]];
const STEP = 1; // s, of an arrow key

export class Reel extends Playhead {
  private instant = 0;
  playing = false;
  speed = 1;
  private last = 0;

  constructor(private held: Store, private source: FilmSource) {
    super(held);
    this.window = Infinity;
    held.instant = () => this.instant;
  }

  override get following(): boolean {
    return false;
  }

  override get time(): number {
    return this.instant;
  }

  get end(): number {
    return this.source.duration;
  }

  /** The instant shown stands in the middle, so that plots show what comes, too. */
  override range(): [number, number] {
    if (this.window >= this.end) return [0, this.end];
    const from = Math.min(this.end - this.window, Math.max(0, this.instant - this.window / 2));
    return [from, from + this.window];
  }

  override seek(time: number): void {
    this.instant = Math.min(this.end, Math.max(0, time));
    this.changed();
  }

  override toggle(): void {
    if (!this.playing && this.instant >= this.end) this.instant = 0;
    this.playing = !this.playing;
    this.changed();
  }

  override pause(): void {
    if (this.playing) this.toggle();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.changed();
  }

  /** Goes on to *now*, ms. */
  advance(now: number): void {
    const passed = Math.min(0.5, (now - this.last) / 1000);
    this.last = now;
    if (!this.playing) return;
    this.instant = Math.min(this.end, this.instant + passed * this.speed);
    this.held.version++;
    if (this.instant >= this.end) this.toggle();
  }
}

export class ReelBar {
  private play = h("button", { class: "play", id: "play", onclick: () => this.reel.toggle() }, "Play");
  private slider = h("input", { type: "range", id: "scrub", "aria-label": "Instant shown, seconds from the start", min: 0, max: 1, step: 0.01, value: 0 });
  private label = h("output", { for: "scrub", id: "instant" });

  constructor(private reel: Reel) {
    const windows = WINDOWS.map(([seconds, text]) => {
      const choice = h("input", { type: "radio", name: "window", id: `window-${seconds}`, value: seconds, checked: seconds === reel.window, onchange: () => reel.setWindow(seconds) });
      return h("label", { for: choice.id }, choice, h("span", {}, text));
    });
    const speed = h("select", { id: "speed", "aria-label": "Speed", onchange: () => reel.setSpeed(Number(speed.value)) }, ...SPEEDS.map((each) => h("option", { value: each, selected: each === 1 }, `${each}×`)));
    byId("transport").append(this.play, this.slider, this.label, speed, h("fieldset", { class: "windows" }, h("legend", { class: "unseen" }, "Plots show"), ...windows));
    this.slider.addEventListener("input", () => reel.seek(Number(this.slider.value)));
    reel.onChange(() => this.update());
    addEventListener("keydown", (key) => {
      const target = key.target as HTMLElement;
      if (target.closest("button, input, select, textarea, summary, a, dialog, .body")) return;
      if (key.key === " ") reel.toggle();
      else if (key.key === "ArrowLeft" || key.key === "ArrowRight") reel.seek(reel.time + (key.key === "ArrowLeft" ? -STEP : STEP));
      else return;
      key.preventDefault();
    });
  }

  update(): void {
    const { reel } = this;
    this.slider.max = String(reel.end);
    this.slider.value = String(reel.time);
    const text = `${reel.time.toFixed(2)} s of ${reel.end.toFixed(1)} s`;
    say(this.label, text);
    this.slider.setAttribute("aria-valuetext", text);
    say(this.play, reel.playing ? "Pause" : "Play");
    this.play.setAttribute("aria-pressed", String(reel.playing));
  }
}
