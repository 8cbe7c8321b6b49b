// Sentences that several parts of the page say.

import { TIP } from "./protocol";
import type { DeviceHealth, DeviceState, RunningMethod } from "./protocol";

export function tipWord(state: number | null): string {
  return state === null ? "" : (TIP[state] ?? "");
}

export const ZERO: Record<RunningMethod["heading"], string> = {
  true: "0° is true north",
  magnetic: "0° is magnetic north",
  arbitrary: "0° is where it started: no magnetometer, or set by hand",
};

export const STATES: Record<DeviceState, string> = {
  waiting: "waiting for samples",
  starting: "loading its method",
  live: "live",
  silent: "silent",
  standing: "clock stands still",
  failed: "ended by a fault",
};

/** Why nothing is known now, where the flag would say that no sample has come in time, which is not so. */
export const UNKNOWN: Partial<Record<DeviceState, string>> = {
  standing: "its samples come, but the clock in them stands still: the attitude now is unknown",
  failed: "its run has ended by a fault: the attitude now is unknown",
};

const REMEDIES: Record<DeviceState, string> = {
  waiting: "Nothing has come from it yet. See that it is switched on, and that it sends to this server.",
  starting: "Its samples wait until the method is loaded, which takes longest the first time.",
  live: "",
  silent: "See to its power, its cable or radio, and to what sends for it. It goes on by itself with the next sample.",
  standing: "See to what stamps its samples, or start the device anew. It goes on by itself once its clock does.",
  failed: "Nothing more is taken from it until it begins anew: under Methods choose another, or press Apply in its parameters. The fault is poise’s: please report it.",
};

/** What can be done about the state of a device; empty where there is nothing to be done. */
export function remedy({ state, failed }: DeviceHealth, joint: boolean): string {
  if (joint) return state === "live" ? "" : state === "waiting" ? "It begins once both of its devices send." : "One of its two devices is not live: its own page says why.";
  return failed ? `${failed.replace(/[.\s]*$/, "")}. ${REMEDIES.failed}` : REMEDIES[state];
}

/** Names of stages, to be read in a sentence. */
export function quoted(names: readonly string[]): string {
  return names.map((name) => `“${name}”`).join(", ");
}

export function count(value: number): string {
  return !Number.isFinite(value) ? "–" : Math.round(value).toLocaleString("en").replaceAll(",", " ");
}

export function ago(seconds: number): string {
  if (seconds < 60) return `${seconds.toFixed(0)} s ago`;
  return seconds < 3600 ? `${Math.floor(seconds / 60)} min ago` : `${Math.floor(seconds / 3600)} h ago`;
}
