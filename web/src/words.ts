// Sentences that several parts of the page say.

import { TIP } from "./protocol";
import type { RunningMethod } from "./protocol";

export function tipWord(state: number | null): string {
  return state === null ? "" : (TIP[state] ?? "");
}

export const ZERO: Record<RunningMethod["heading"], string> = {
  true: "0° is true north",
  magnetic: "0° is magnetic north",
  arbitrary: "0° is where it started: no magnetometer, or set by hand",
};

export const STATES: Record<string, string> = {
  waiting: "waiting for samples",
  starting: "loading its method",
  live: "live",
  silent: "silent",
};

export function count(value: number): string {
  return Math.round(value).toLocaleString("en").replaceAll(",", " ");
}

export function ago(seconds: number): string {
  if (seconds < 60) return `${seconds.toFixed(0)} s ago`;
  return seconds < 3600 ? `${Math.floor(seconds / 60)} min ago` : `${Math.floor(seconds / 3600)} h ago`;
}
