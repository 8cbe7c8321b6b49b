// The plots of a device: angles with bands, sensors, and a lane for every flag that was set.

import uPlot from "uplot";
import { Chart, CHART_AXIS } from "./chart";
import type { ChartSpec, Line } from "./chart";
import { windowed } from "./curves";
import type { Lane, Quantity } from "./curves";
import { h, say } from "./dom";
import type { Playhead } from "./playhead";
import { AT } from "./protocol";
import type { DeviceInfo } from "./protocol";
import type { Store } from "./store";

const XYZ: Line[] = [
  { label: "x", colour: "--x" },
  { label: "y", colour: "--y" },
  { label: "z", colour: "--z" },
];
type Spec = Omit<ChartSpec, "lines" | "bands">;

const angle = (title: string, more: Partial<Spec> = {}): Spec => ({ title, unit: "°", digits: 1, least: 10, ...more });
const HALF: [number, number] = [-180, 180];
const RATE: Spec = { title: "Rate", unit: "rad/s", digits: 2, least: 0.5 };

/** What is plotted of a device. */
const EARTH = {
  angles: { heading: angle("Heading", { turn: [0, 360] }), pitch: angle("Pitch"), roll: angle("Roll", { turn: HALF, foot: true }) },
  sensors: [
    [AT.gyr, RATE],
    [AT.acc, { title: "Specific force", unit: "m/s²", digits: 2, least: 2 }],
    [AT.mag, { title: "Magnetic field", unit: "µT", digits: 1, least: 10, foot: true }],
  ] as [number, Spec][],
};
/** And of a joint, which is seen from its base and has no sensors. */
const JOINT = {
  angles: { angle: angle("Angle"), turn: angle("Turn", { turn: HALF }), pitch: angle("Pitch"), roll: angle("Roll", { turn: HALF, foot: true }) },
  sensors: [[AT.rate, { ...RATE, foot: true }]] as [number, Spec][],
};
const FINEST = 1 / 400; // of a lane's width, between two stretches: what is closer is drawn as one

export class Plots {
  readonly element = h("div", { class: "plots" });
  private charts = new Map<Quantity | number, Chart>();
  private kinds: { angles: Partial<Record<Quantity, Spec>>; sensors: [number, Spec][] };
  private lanes = h("div", { class: "lanes" });
  private rows = new Map<number, { row: HTMLElement; bar: HTMLElement; key: string }>();
  private shown = "";
  private drawn = 0;
  private version = -1;
  private observer = new ResizeObserver(() => this.each((chart) => chart.fit()));
  private scheme = matchMedia("(prefers-color-scheme: dark)");
  private recolour = () => this.each((chart) => chart.recolour());

  constructor(private store: Store, private playhead: Playhead, private device: DeviceInfo) {
    const { angles, sensors } = device.shape === "joint" ? JOINT : EARTH;
    this.kinds = { angles, sensors: device.sensors === false ? JOINT.sensors : sensors };
    this.observer.observe(this.element);
    this.scheme.addEventListener("change", this.recolour);
    this.lanes.style.setProperty("--axis", `${CHART_AXIS}px`);
  }

  destroy(): void {
    this.observer.disconnect();
    this.scheme.removeEventListener("change", this.recolour);
    this.each((chart) => chart.destroy());
  }

  ends(quantity: Quantity): [number, number] | null {
    return this.charts.get(quantity)?.ends ?? null;
  }

  private each(work: (chart: Chart) => void): void {
    for (const chart of this.charts.values()) work(chart);
  }

  /** Long windows are drawn less often: a pixel of them is many rows. */
  update(now: number): void {
    const range = this.playhead.range();
    const pause = Math.min(500, Math.max(66, ((range[1] - range[0]) * 1000) / 600));
    if (now - this.drawn < pause || (this.version === this.store.version && !this.playhead.following)) return;
    this.drawn = now;
    this.version = this.store.version;
    const tracks = this.store.tracksOf(this.device.id).filter((track) => track.ring.length);
    this.build(tracks.map(({ method, colour, running }) => ({ label: method.name + (running ? "" : " (before)"), colour: `--m${colour}`, dashed: !running })));
    const mark = this.store.instant && this.playhead.time;
    const quantities = Object.keys(this.kinds.angles) as Quantity[];
    const { stretches, lanes, data } = windowed(this.store, tracks, ...range, quantities, this.kinds.sensors.map(([field]) => field));
    for (const [name, chart] of this.charts) chart.set(data.get(name)!, range, stretches, mark);
    this.drawLanes(lanes, range);
  }

  private build(lines: Line[]): void {
    const key = JSON.stringify(lines);
    if (key === this.shown) return;
    this.shown = key;
    this.each((chart) => chart.destroy());
    const sync = uPlot.sync(`device ${this.device.id}`);
    const angles = Object.entries(this.kinds.angles).map(([name, spec]) => [name as Quantity, new Chart({ ...spec, lines, bands: true }, sync)] as const);
    const sensors = this.kinds.sensors.map(([field, spec]) => [field, new Chart({ ...spec, lines: XYZ, bands: false }, sync)] as const);
    this.charts = new Map<Quantity | number, Chart>([...angles, ...sensors]);
    this.element.replaceChildren(...angles.map(([, chart]) => chart.element), this.lanes, ...sensors.map(([, chart]) => chart.element));
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
      const bars = joined(stretches, from, FINEST * (to - from));
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

/** *stretches* that end after *from*, as one where less than *least* is between them. */
function joined(stretches: [number, number][], from: number, least: number): [number, number][] {
  const found: [number, number][] = [];
  for (const [begin, end] of stretches) {
    if (end < from) continue;
    const last = found.at(-1);
    if (last && begin - last[1] < least) last[1] = Math.max(last[1], end);
    else found.push([begin, end]);
  }
  return found;
}
