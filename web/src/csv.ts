// What the page holds, as a file; columns as `poise` reads and writes them.

import { AT } from "./protocol";
import type { Store } from "./store";

const xyz = (name: string, unit = "") => ["x", "y", "z"].map((axis) => `${name}_${axis}${unit && ` (${unit})`}`);
const COLUMNS = [
  ...["device", "method", "time (s)", "host_time", "sequence", "qw", "qx", "qy", "qz"],
  ...[...xyz("rate"), ...xyz("sigma"), ...xyz("gyr", "rad/s"), ...xyz("acc", "m/s²"), ...xyz("mag", "µT")],
  ...["valid", "tip", "flags", "flag_names"],
].join();
const FLOATS = 19; // from the quaternion to the magnetometer

/** Seconds, rad/s, m/s², µT, sigma in rad; the newest attitude 30 times a second, not every sample. */
export function csv(store: Store, ids: string[]): string {
  const lines = [COLUMNS];
  for (const id of ids) {
    for (const { method, ring } of store.tracksOf(id)) {
      for (let k = 0; k < ring.length; k++) {
        const fields: (string | number)[] = [id, method.name, ring.deviceTime(k), ring.hostTime(k).toFixed(6), ring.sequence(k)];
        for (let n = 0; n < FLOATS; n++) fields.push(short(ring.value(k, AT.quat + n)));
        const tip = ring.tip(k);
        fields.push(Number(ring.valid(k)), tip === 255 ? "" : tip, ring.flags(k), store.sentences(ring.flags(k)).map((each) => each.name).join("|"));
        lines.push(fields.join(","));
      }
    }
  }
  return lines.join("\n") + "\n";
}

function short(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(9))) : "";
}

export function save(name: string, text: string): void {
  saveFile(name, new Blob([text], { type: "text/csv" }));
}

export function saveFile(name: string, file: Blob): void {
  const url = URL.createObjectURL(file);
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
