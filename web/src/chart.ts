// One plot over time, in the page's own colours, with the flags of the main method shaded.

import uPlot from "uplot";
import { css, h, say } from "./dom";
import { fixed } from "./attitude";

export interface Line {
  label: string;
  /** a variable of the style sheet */
  colour: string;
  dashed?: boolean;
}

export interface Stretch {
  from: number;
  to: number;
  invalid: boolean;
}

export interface ChartSpec {
  title: string;
  unit: string;
  digits: number;
  /** the smallest range that the scale shows */
  least: number;
  lines: Line[];
  /** a band around each line: two more series a line, upper and lower */
  bands: boolean;
  /** an angle that goes on at its other end; all of it is shown once most of it is used */
  turn?: Turn;
  /** the last of its group, which has the times */
  foot?: boolean;
}

type Turn = [from: number, to: number];

const AXIS = 46;

export class Chart {
  readonly element: HTMLElement;
  private plot: uPlot | null = null;
  private values: HTMLElement[];
  private holder = h("div", { class: "plot" });
  private stretches: Stretch[] = [];
  private range: [number, number] = [0, 1];
  private data: uPlot.AlignedData = [[]];
  /** from where to where an angle that goes round is drawn: as its numbers are, or half a turn off */
  private branch: Turn | undefined;
  /** the instant shown of a recording, whose time is counted from its start */
  private mark: number | null = null;

  constructor(private spec: ChartSpec, private sync: uPlot.SyncPubSub) {
    this.values = spec.lines.map(() => h("b"));
    this.element = h(
      "section",
      { class: spec.foot ? "chart foot" : "chart", "aria-label": `${spec.title} over time, ${spec.unit}` },
      h(
        "header",
        {},
        h("h3", {}, spec.title),
        h("span", { class: "unit" }, spec.unit),
        h(
          "span",
          { class: "values" },
          ...spec.lines.map((line, k) => {
            const key = h("span", { class: "value" }, h("i", { class: line.dashed ? "key dashed" : "key" }), spec.lines.length > 1 ? `${line.label} ` : "", this.values[k]);
            (key.firstElementChild as HTMLElement).style.setProperty("--key", `var(${line.colour})`);
            return key;
          }),
        ),
      ),
      this.holder,
    );
  }

  /** uPlot wants a size; called once the element is in the page, and again when it changes. */
  fit(): void {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (!width || !height) return;
    if (this.plot) this.plot.setSize({ width, height });
    else this.plot = new uPlot(this.options(width, height), this.data, this.holder);
  }

  recolour(): void {
    this.destroy();
    this.fit();
  }

  destroy(): void {
    this.plot?.destroy();
    this.plot = null;
  }

  set(data: uPlot.AlignedData, range: [number, number], stretches: Stretch[], mark: number | null = null): void {
    this.mark = mark;
    this.data = data;
    this.branch = this.spec.turn && branched(data, this.spec);
    this.range = range;
    this.stretches = stretches;
    this.plot?.setData(data);
    this.showValues();
  }

  /** The ends of the scale upwards. */
  get ends(): [number, number] | null {
    const { min, max } = this.plot?.scales.y ?? {};
    return min == null || max == null ? null : [min, max];
  }

  private showValues(): void {
    const hovered = this.plot?.cursor.idx;
    const last = this.data[0].length - 1;
    const k = hovered ?? (this.mark === null ? last : atOrBefore(this.data[0] as number[], this.mark));
    const step = this.spec.bands ? 3 : 1;
    this.values.forEach((value, line) => {
      const found = (this.data[1 + line * step] as (number | null | undefined)[])?.[k];
      say(value, fixed(this.named(found ?? NaN), this.spec.digits));
    });
  }

  private options(width: number, height: number): uPlot.Options {
    const { spec } = this;
    const [ink, line] = [css("--muted"), css("--line")];
    const gaps = spec.turn ? { gaps: wraps } : {};
    const series: uPlot.Series[] = [{}];
    const bands: uPlot.Band[] = [];
    for (const each of spec.lines) {
      const colour = css(each.colour);
      series.push({ stroke: colour, width: 1.5, dash: each.dashed ? [5, 3] : undefined, points: { show: false }, spanGaps: false, ...gaps });
      if (!spec.bands) continue;
      for (let k = 0; k < 2; k++) series.push({ stroke: "transparent", width: 0, points: { show: false }, ...gaps });
      bands.push({ series: [series.length - 2, series.length - 1], fill: colour + "2e" });
    }
    const grid = { stroke: line, width: 1 };
    return {
      width,
      height,
      series,
      bands,
      legend: { show: false },
      padding: [6, 4, 0, 0],
      cursor: { sync: { key: this.sync.key, setSeries: false, scales: ["x", null] }, drag: { x: false, y: false }, points: { size: 5 }, y: false },
      scales: {
        x: { time: this.mark === null, range: () => this.range },
        y: { range: (_, low, high) => span(low, high, spec.least, this.branch) },
      },
      axes: [
        { stroke: ink, grid, ticks: { show: false }, size: spec.foot ? 22 : 4, font: FONT, values: (plot, splits) => (spec.foot ? this.times(plot, splits) : []), space: 70 },
        { stroke: ink, grid, ticks: { show: false }, size: AXIS, gap: 4, font: FONT, space: 22, incrs: spec.unit === "°" ? ANGLES : undefined, values: (_, splits) => splits.map((v) => String(Number(this.named(v).toPrecision(6))).replace("-", "−")) },
      ],
      hooks: { drawClear: [(plot) => this.shade(plot)], draw: [(plot) => this.point(plot)], setCursor: [() => this.showValues()] },
    };
  }

  /** An angle by its usual name, wherever it is drawn: 350° and not −10°. */
  private named(value: number): number {
    const [from, to] = this.spec.turn ?? [-Infinity, Infinity];
    return this.branch === this.spec.turn || (value >= from && value <= to) ? value : value + (value < from ? 360 : -360);
  }

  private times(plot: uPlot, splits: number[]): string[] {
    return this.mark === null ? clock(plot, splits) : splits.map((s) => `${Number(s.toFixed(3))} s`);
  }

  private point(plot: uPlot): void {
    if (this.mark === null) return;
    const { ctx, bbox } = plot;
    const x = Math.round(plot.valToPos(this.mark, "x", true)) + 0.5;
    if (x < bbox.left || x > bbox.left + bbox.width) return;
    ctx.save();
    ctx.strokeStyle = css("--muted");
    ctx.lineWidth = devicePixelRatio;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }

  private shade(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    for (const { from, to, invalid } of this.stretches) {
      const left = plot.valToPos(from, "x", true);
      ctx.fillStyle = css(invalid ? "--shade-invalid" : "--shade");
      ctx.fillRect(left, bbox.top, Math.max(2, plot.valToPos(to, "x", true) - left), bbox.height);
    }
    ctx.restore();
  }
}

/** The last of *stamps* at or before *time*. */
function atOrBefore(stamps: number[], time: number): number {
  let low = 0;
  let high = stamps.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (stamps[middle] <= time) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

const CLOCK = new Intl.DateTimeFormat("en-GB", { timeStyle: "medium" });
const FONT = "11px ui-sans-serif, system-ui, sans-serif";
const ANGLES = [1, 2, 5, 10, 15, 30, 45, 90, 180];

/** Times, but for one that would be cut off at the right. */
function clock(plot: uPlot, splits: number[]): string[] {
  const { min, max } = plot.scales.x;
  const room = (30 / plot.width) * (max! - min!);
  return splits.map((s) => (s > max! - room ? "" : CLOCK.format(1000 * s)));
}

/** Where to draw an angle that goes round, so that its lines pass the end least: *data* is moved there. */
function branched(data: uPlot.AlignedData, { turn, lines }: ChartSpec): Turn {
  const other: Turn = turn![0] === 0 ? [-180, 180] : [0, 360];
  const moved = (value: number) => (value > other[1] ? value - 360 : value < other[0] ? value + 360 : value);
  let passes = 0;
  const values = lines.map((_, line) => data[1 + 3 * line] as (number | null)[]);
  for (const column of values) {
    let before: number | null = null;
    for (const value of column) {
      if (value === null) continue;
      if (before !== null) passes += Number(Math.abs(value - before) > 180) - Number(Math.abs(moved(value) - moved(before)) > 180);
      before = value;
    }
  }
  if (passes <= 0) return turn!;
  values.forEach((column, line) => {
    const [upper, lower] = [2, 3].map((k) => data[k + 3 * line] as (number | null)[]);
    column.forEach((value, k) => {
      const by = value === null ? 0 : moved(value) - value;
      if (by) for (const each of [column, upper, lower]) if (each[k] !== null) each[k]! += by;
    });
  });
  return other;
}

const NEAR = 10; // px between two passes, below which both are drawn: gaps would leave nothing

/** Gaps where an angle passes its end: a null between two points of one pixel would not be seen. */
function wraps(plot: uPlot, index: number, first: number, last: number, found: uPlot.Series.Gaps): uPlot.Series.Gaps {
  const stamps = plot.data[0];
  const values = plot.data[index];
  const passes: [number, number][] = [];
  let before: number | null | undefined = null;
  let left = 0;
  for (let k = first; k <= last; k++) {
    const value = values[k];
    if (value === null || value === undefined) continue;
    const at = Math.round(plot.valToPos(stamps[k], "x", true));
    if (before !== null && before !== undefined && Math.abs(value - before) > 180) passes.push([left, at]);
    before = value;
    left = at;
  }
  const halo = Math.ceil(1.5 * devicePixelRatio); // the width of the line
  const near = NEAR * devicePixelRatio;
  passes.forEach(([from, to], n) => {
    const alone = (n === 0 || from - passes[n - 1][1] > near) && (n + 1 === passes.length || passes[n + 1][0] - to > near);
    if (alone) found.push([from - halo, to + halo]);
  });
  return found.sort((a, b) => a[0] - b[0]);
}

function span(low: number | null, high: number | null, least: number, turn: Turn | undefined): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [-least / 2, least / 2];
  if (turn && high - low > 200) return turn;
  const middle = (low + high) / 2;
  const half = Math.max(least, 1.12 * (high - low)) / 2;
  return [middle - half, middle + half];
}

export const CHART_AXIS = AXIS;
