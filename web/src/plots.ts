// The plots of a device: angles with bands, sensors, and a lane for every flag that was set.

import uPlot from "uplot";
import { Chart, CHART_AXIS } from "./chart";
import type { Line } from "./chart";
import { windowed } from "./curves";
import type { Lane } from "./curves";
import { h, say } from "./dom";
import type { Playhead } from "./playhead";
import type { Store } from "./store";

const XYZ: Line[] = [
  { label: "x", colour: "--x" },
  { label: "y", colour: "--y" },
  { label: "z", colour: "--z" },
];
const MOST_STRETCHES = 80;

export class Plots {
  readonly element = h("div", { class: "plots" });
  private charts: Record<"heading" | "pitch" | "roll" | "gyr" | "acc" | "mag", Chart> | null = null;
  private lanes = h("div", { class: "lanes" });
  private rows = new Map<number, { row: HTMLElement; bar: HTMLElement; key: string }>();
  private shown = "";
  private drawn = 0;
  private version = -1;
  private observer = new ResizeObserver(() => this.each((chart) => chart.fit()));
  private scheme = matchMedia("(prefers-color-scheme: dark)");
  private recolour = () => this.each((chart) => chart.recolour());

  constructor(private store: Store, private playhead: Playhead, private id: string) {
    this.observer.observe(this.element);
    this.scheme.addEventListener("change", this.recolour);
    this.lanes.style.setProperty("--axis", `${CHART_AXIS}px`);
  }

  destroy(): void {
    this.observer.disconnect();
    this.scheme.removeEventListener("change", this.recolour);
    this.each((chart) => chart.destroy());
  }

  private each(work: (chart: Chart) => void): void {
    if (this.charts) for (const chart of Object.values(this.charts)) work(chart);
  }

  /** Long windows are drawn less often: a pixel of them is many rows. */
  update(now: number): void {
    const range = this.playhead.range();
    const pause = Math.min(500, Math.max(66, ((range[1] - range[0]) * 1000) / 600));
    if (now - this.drawn < pause || (this.version === this.store.version && !this.playhead.following)) return;
    this.drawn = now;
    this.version = this.store.version;
    const tracks = this.store.tracksOf(this.id).filter((track) => track.ring.length);
    this.build(tracks.map(({ method, colour, running }) => ({ label: method.name + (running ? "" : " (before)"), colour: `--m${colour}`, dashed: !running })));
    const mark = this.store.instant && this.playhead.time;
    const { stretches, lanes, ...data } = windowed(this.store, tracks, ...range);
    for (const [name, chart] of Object.entries(this.charts!)) chart.set(data[name as keyof typeof data], range, stretches, mark);
    this.drawLanes(lanes, range);
  }

  private build(lines: Line[]): void {
    const key = JSON.stringify(lines);
    if (key === this.shown) return;
    this.shown = key;
    this.each((chart) => chart.destroy());
    const sync = uPlot.sync(`device ${this.id}`);
    const angle = { unit: "°", digits: 1, lines, bands: true };
    this.charts = {
      heading: new Chart({ title: "Heading", least: 10, compass: true, ...angle }, sync),
      pitch: new Chart({ title: "Pitch", least: 10, ...angle }, sync),
      roll: new Chart({ title: "Roll", least: 10, foot: true, ...angle }, sync),
      gyr: new Chart({ title: "Rate", unit: "rad/s", digits: 2, least: 0.5, lines: XYZ, bands: false }, sync),
      acc: new Chart({ title: "Specific force", unit: "m/s²", digits: 2, least: 2, lines: XYZ, bands: false }, sync),
      mag: new Chart({ title: "Magnetic field", foot: true, unit: "µT", digits: 1, least: 10, lines: XYZ, bands: false }, sync),
    };
    this.element.replaceChildren(
      ...Object.values(this.charts).slice(0, 3).map((chart) => chart.element),
      this.lanes,
      ...Object.values(this.charts).slice(3).map((chart) => chart.element),
    );
    this.each((chart) => chart.fit());
  }

  private drawLanes(lanes: Lane[], [from, to]: [number, number]): void {
    const present = new Set(lanes.map((lane) => lane.bit));
    for (const [bit, { row }] of this.rows) {
      if (present.has(bit)) continue;
      row.remove();
      this.rows.delete(bit);
    }
    for (const { bit, stretches } of lanes) {
      const [known] = this.store.sentences((1 << bit) >>> 0);
      if (!known) continue;
      let entry = this.rows.get(bit);
      if (!entry) {
        const bar = h("div", { class: "bars" });
        const row = h("div", { class: known.invalid ? "lane invalid" : "lane" }, h("p", {}, h("b", {}, known.name.toLowerCase().replaceAll("_", " ")), h("span", {}, known.sentence)), bar);
        entry = { row, bar, key: "" };
        this.rows.set(bit, entry);
        this.lanes.append(row);
      }
      const bars = stretches.slice(-MOST_STRETCHES);
      while (entry.bar.childElementCount > bars.length) entry.bar.lastElementChild!.remove();
      while (entry.bar.childElementCount < bars.length) entry.bar.append(h("i"));
      bars.forEach(([begin, end], k) => {
        const left = Math.max(0, (begin - from) / (to - from));
        const right = Math.min(1, (end - from) / (to - from));
        const { style } = entry.bar.children[k] as HTMLElement;
        style.left = `${(100 * left).toFixed(2)}%`;
        style.width = `${Math.max(0.2, 100 * (right - left)).toFixed(2)}%`;
      });
    }
    let empty = this.lanes.querySelector(".none");
    if (!this.rows.size && !empty) this.lanes.append(h("p", { class: "none" }, ""));
    empty = this.lanes.querySelector(".none");
    if (empty) {
      if (this.rows.size) empty.remove();
      else say(empty, "No flags in this window");
    }
  }
}
