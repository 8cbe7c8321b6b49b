// The numbers of one device at the instant shown: heading, tilt, whether they may be acted on, and why not.

import { angles, fixed } from "./attitude";
import type { Angles } from "./attitude";
import { h, say } from "./dom";
import type { Playhead } from "./playhead";
import { ALARMING } from "./protocol";
import type { DeviceInfo } from "./protocol";
import type { Store, Track } from "./store";
import { remedy, tipWord, ZERO } from "./words";

class Number_ {
  value = h("span", { class: "figure" }, "–");
  sigma = h("span", { class: "sigma" });
  note = h("p", { class: "note" });
  element: HTMLElement;

  constructor(name: string) {
    this.element = h("div", { class: "readout" }, h("h2", {}, name), h("p", {}, this.value, h("span", { class: "degree" }, "°"), this.sigma), this.note);
  }

  set(value: number, sigma: number, note: string): void {
    say(this.value, fixed(value, 1));
    say(this.sigma, Number.isFinite(sigma) ? `± ${fixed(sigma, 1)}°` : "");
    say(this.note, note);
  }
}

export class Readout {
  readonly element: HTMLElement;
  private first: Number_;
  private second: Number_;
  /** of a joint: about the base's z, x and y */
  private about: HTMLElement[] | null;
  private verdict = h("p", { class: "verdict" });
  private why = h("p", { class: "why" });
  private remedy = h("p", { class: "remedy" });
  private tip = h("p", { class: "tip" });
  private others = h("div", { class: "others" });
  private spoken = h("p", { class: "unseen", role: "status", "aria-live": "polite" });
  private written = 0;

  constructor(private store: Store, private playhead: Playhead, private device: DeviceInfo) {
    const joint = device.shape === "joint";
    [this.first, this.second] = [new Number_(joint ? "Angle" : "Heading"), new Number_("Tilt")];
    this.about = joint ? ["Turn", "Pitch", "Roll"].map(() => h("dd")) : null;
    const beside = this.about ? h("dl", { class: "facts" }, ...["Turn", "Pitch", "Roll"].map((name, k) => h("div", {}, h("dt", {}, name), this.about![k]))) : this.second.element;
    this.element = h("div", { class: "readouts" }, h("div", { class: "pair" }, this.first.element, beside), h("div", { class: "state" }, this.verdict, this.tip, this.why, this.remedy), this.others, this.spoken);
  }

  private row(track: Track): number {
    return this.playhead.following ? track.ring.length - 1 : track.ring.find(this.playhead.time);
  }

  update(now: number): { invalid: string; tip: number | null } | null {
    if (now - this.written < 100) return null;
    this.written = now;
    const tracks = this.store.tracksOf(this.device.id).filter((track) => track.running);
    const [main] = tracks;
    const k = main ? this.row(main) : -1;
    const invalid = !main ? "its method is being loaded" : this.playhead.following ? this.store.whyInvalid(main, k) : this.whyThen(main, k);
    const a = main && k >= 0 ? angles(main.ring, k) : null;
    this.figures(a, main);
    say(this.verdict, invalid ? "Not valid" : "Valid");
    say(this.why, invalid);
    say(this.remedy, invalid && this.playhead.following ? this.toDo() : "");
    say(this.spoken, `${this.device.id}: attitude ${invalid ? `not valid: ${invalid}` : "valid"}`);
    const tip = main && k >= 0 ? main.ring.tip(k) : 255;
    const watched = tip !== 255;
    say(this.tip, watched ? tipWord(tip) : "");
    this.tip.classList.toggle("bad", ALARMING.has(tip));
    this.element.classList.toggle("invalid", invalid !== "");
    this.compare(tracks.slice(1));
    return { invalid, tip: watched ? tip : null };
  }

  /** What can be done where nothing is known now; of a server that is gone, nothing is known of its devices either. */
  private toDo(): string {
    const health = this.store.conditions.get(this.device.id);
    return health && this.store.link.state === "open" ? remedy(health, this.about !== null) : "";
  }

  private figures(a: Angles | null, main: Track | undefined): void {
    if (this.about) {
      const { segment, base } = this.device;
      this.first.set(a?.angle ?? NaN, a?.sigmaAngle ?? NaN, segment && base ? `of ${segment}, seen from ${base}` : "seen from another body");
      const values = a ? [a.turn, a.pitch, a.roll] : [NaN, NaN, NaN];
      this.about.forEach((value, k) => say(value, `${fixed(values[k], 1)}°`));
      return;
    }
    this.first.set(a?.heading ?? NaN, a?.sigmaHeading ?? NaN, main ? ZERO[main.method.heading] : "");
    this.second.set(a?.tilt ?? NaN, a?.sigmaTilt ?? NaN, "between its z axis and up");
  }

  private whyThen(main: Track, k: number): string {
    if (k < 0) return "nothing is held of this instant";
    if (main.ring.valid(k)) return "";
    return this.store.sentences(main.ring.flags(k)).filter((each) => each.invalid).map((each) => each.sentence).join("; ") || "not to be acted on";
  }

  /** Other methods beside the first: their figures, small, in their colours. */
  private compare(tracks: Track[]): void {
    while (this.others.childElementCount > tracks.length) this.others.lastElementChild!.remove();
    while (this.others.childElementCount < tracks.length) this.others.append(h("p", {}, h("i", { class: "key" }), h("span"), h("b")));
    tracks.forEach((track, n) => {
      const [key, name, value] = this.others.children[n].children as unknown as [HTMLElement, HTMLElement, HTMLElement];
      const k = this.row(track);
      const a = k >= 0 ? angles(track.ring, k) : null;
      key.style.setProperty("--key", `var(--m${track.colour})`);
      say(name, track.method.name);
      const [first, second] = a ? (this.about ? [a.angle, a.turn] : [a.heading, a.tilt]) : [NaN, NaN];
      say(value, a ? `${fixed(first, 1)}°  ·  ${fixed(second, 1)}°${track.ring.valid(k) ? "" : "  not valid"}` : "–");
    });
  }
}
