// What plots are drawn from: a window of the rings, as uPlot takes it.

import type uPlot from "uplot";
import { angles } from "./attitude";
import type { Angles } from "./attitude";
import type { Stretch } from "./chart";
import type { Ring } from "./ring";
import type { Store, Track } from "./store";

type Column = (number | null)[];

/** An angle over time: its value, and its sigma. */
export type Quantity = "heading" | "turn" | "pitch" | "roll" | "angle";

const VALUES: Record<Quantity, (a: Angles) => [number, number]> = {
  heading: (a) => [a.heading, a.sigmaHeading],
  turn: (a) => [a.turn, a.sigmaHeading],
  pitch: (a) => [a.pitch, a.sigmaPitch],
  roll: (a) => [a.roll, a.sigmaRoll],
  angle: (a) => [a.angle, a.sigmaAngle],
};
/** Where a quantity's band ends: a sigma of a whole turn would leave nothing to be seen of the angle. */
const ENDS: Partial<Record<Quantity, [number, number]>> = { pitch: [-90, 90], angle: [0, 180] };

export interface Windowed {
  /** by quantity, and by the sensors' fields */
  data: Map<Quantity | number, uPlot.AlignedData>;
  /** s since 1970, of the main method's rows */
  stretches: Stretch[];
  lanes: Lane[];
}

/** Where one flag was set. */
export interface Lane {
  bit: number;
  stretches: [number, number][];
}

/** s: with more between two rows, the line is broken */
const GAP = 0.5;

function bounds(ring: Ring, from: number, to: number): [number, number] {
  return [Math.max(0, ring.find(from)), ring.find(to) + 1];
}

/** *quantities* of *tracks* and the vectors at *fields* of the first of them, between two instants. */
export function windowed(store: Store, tracks: Track[], from: number, to: number, quantities: Quantity[], fields: number[]): Windowed {
  const spans = tracks.map(({ ring }) => bounds(ring, from, to));
  const stamps = merged(tracks, spans);
  const data = new Map<Quantity | number, uPlot.AlignedData>();
  const columns = tracks.map((track, t) => angleColumns(track.ring, spans[t], stamps as number[], tracks.length === 1, quantities));
  quantities.forEach((quantity, q) => data.set(quantity, [stamps, ...columns.flatMap((each) => each.slice(3 * q, 3 * q + 3))] as uPlot.AlignedData));
  const main = tracks[0]?.ring;
  for (const field of fields) data.set(field, (main ? sensorColumns(main, spans[0], field) : [[], [], [], []]) as uPlot.AlignedData);
  return { data, ...(main ? flagged(store, main, spans[0]) : { stretches: [], lanes: [] }) };
}

/** All instants of several rings, each once: rows of one device's methods have the same stamps. */
function merged(tracks: Track[], spans: [number, number][]): Column {
  if (tracks.length === 1) return stampsOf(tracks[0].ring, spans[0]);
  const all = new Set<number>();
  tracks.forEach(({ ring }, t) => stampsOf(ring, spans[t]).forEach((stamp) => all.add(stamp)));
  return [...all].sort((a, b) => a - b);
}

function stampsOf(ring: Ring, [first, end]: [number, number]): number[] {
  const stamps = new Array<number>(end - first);
  for (let k = first; k < end; k++) stamps[k - first] = ring.at(k);
  return stamps;
}

function angleColumns(ring: Ring, [first, end]: [number, number], stamps: number[], alone: boolean, quantities: Quantity[]): Column[] {
  const columns: Column[] = Array.from({ length: 3 * quantities.length }, () => new Array<number | null>(stamps.length).fill(null));
  let row = 0;
  for (let k = first; k < end; k++) {
    const at = ring.at(k);
    if (alone) row = k - first;
    else while (stamps[row] < at) row++;
    if (k > first && at - ring.at(k - 1) > GAP) continue; // one row less, so that the line is broken
    const a = angles(ring, k);
    quantities.forEach((quantity, q) => put(columns, 3 * q, row, ...VALUES[quantity](a), ENDS[quantity]));
  }
  return columns;
}

function put(columns: Column[], at: number, row: number, value: number, sigma: number, [least, most] = [value - 180, value + 180]): void {
  if (!Number.isFinite(value)) return;
  columns[at][row] = value;
  if (!Number.isFinite(sigma)) return;
  columns[at + 1][row] = Math.min(value + sigma, most);
  columns[at + 2][row] = Math.max(value - sigma, least);
}

function sensorColumns(ring: Ring, [first, end]: [number, number], field: number): Column[] {
  const columns: Column[] = [stampsOf(ring, [first, end]), ...[0, 1, 2].map(() => new Array<number | null>(end - first))];
  for (let k = first; k < end; k++) {
    for (let axis = 0; axis < 3; axis++) {
      const value = ring.value(k, field + axis);
      columns[1 + axis][k - first] = Number.isFinite(value) ? value : null;
    }
  }
  return columns;
}

function flagged(store: Store, ring: Ring, [first, end]: [number, number]): { stretches: Stretch[]; lanes: Lane[] } {
  const stretches: Stretch[] = [];
  const lanes = new Map<number, [number, number][]>();
  let since = NaN;
  for (let k = first; k < end; k++) {
    const at = ring.at(k);
    const until = k + 1 < end ? ring.at(k + 1) : store.link.state === "open" && k + 1 === ring.length ? store.edge() : at;
    if (!ring.valid(k)) {
      if (Number.isNaN(since)) since = at;
    } else if (!Number.isNaN(since)) {
      stretches.push({ from: since, to: at, invalid: true });
      since = NaN;
    }
    for (let flags = ring.allFlags(k), bit = 0; flags; flags >>>= 1, bit++) {
      if (!(flags & 1)) continue;
      const lane = lanes.get(bit) ?? [];
      lanes.set(bit, lane);
      const last = lane[lane.length - 1];
      if (last && last[1] >= at) last[1] = until;
      else lane.push([at, until]);
    }
  }
  if (!Number.isNaN(since)) stretches.push({ from: since, to: store.edge(), invalid: true });
  return { stretches, lanes: [...lanes].map(([bit, found]) => ({ bit, stretches: found })).sort((a, b) => a.bit - b.bit) };
}
