// The wire protocol of docs/live.md, as a viewer reads it.

export interface Parameter {
  name: string;
  default: unknown;
  unit: string;
  meaning: string;
  low: number | null;
  high: number | null;
  choices: unknown[];
  kind: string;
}

export interface MethodKind {
  name: string;
  parameters: Parameter[];
}

export interface Recording {
  recording: boolean;
  reason: string | null;
  text: string;
}

export interface Hello {
  type: "hello";
  server: string;
  time: number;
  may_write: boolean;
  methods: MethodKind[];
  flags: Record<string, [string, string]>;
  invalid_flags: number;
  offers: string[];
  events?: LiveEvent[];
  /** how many recordings `poise view` shows */
  films?: number;
  recording: Recording | null;
}

export interface RunningMethod {
  number: number;
  name: string;
  settings: string;
  heading: "true" | "magnetic" | "arbitrary";
}

export type Shape = "board" | "band" | "phone" | "handle" | "robot" | "joint";

export interface DeviceInfo {
  id: string;
  number: number;
  source: string;
  shape: Shape;
  connected: boolean;
  methods: RunningMethod[];
  /** of a joint: the device that is seen from the device `base` */
  segment?: string;
  base?: string;
  /** of a recording: whether its samples are there, and not its attitude alone */
  sensors?: boolean;
}

export type DeviceState = "waiting" | "starting" | "live" | "silent" | "standing" | "failed";

export interface DeviceHealth {
  id: string;
  state: DeviceState;
  /** the fault that ended its run */
  failed: string | null;
  rate_hz: number;
  samples: number;
  lost: number;
  repeated: number;
  rejected: number;
  silences: number;
  last_heard_s: number | null;
  clock_drift_ppm: number;
  clock_restarts: number;
  invalid: Record<string, number>;
  resets: Record<string, number>;
  wait_ms?: { p50: number; p99: number };
}

/** What the responses of a device hold: the names of their stages, and of those that wait until somebody has seen them. */
export interface Alarming {
  device: string;
  holding: string[];
  unacknowledged: string[];
}

export interface Health {
  type: "health";
  time: number;
  devices: DeviceHealth[];
  alarms: Alarming[];
  viewers: number;
  wait_ms: { p50: number; p99: number };
  recording: Recording | null;
}

export interface LiveEvent {
  type: "event";
  number: number;
  kind: string;
  time: number;
  device: string | null;
  text: string;
  state?: string;
  direction?: string;
  tilt_deg?: number | null;
  impact_s?: number | null;
}

/** A recording of `poise view`, as GET /films tells it; times are stamps, s. */
export interface FilmInfo {
  number: number;
  id: string;
  source: string;
  shape: Shape;
  start: number;
  end: number;
  rows: number;
  rate_hz: number | null;
  sensors: boolean;
  methods: (RunningMethod & {
    reference: boolean;
    error_deg: { total: number | null; heading: number | null; inclination: number | null } | null;
    stretches: { flag: string; start: number; end: number; rows: number; text: string }[];
  })[];
}

export interface Films extends Pick<Hello, "server" | "flags" | "invalid_flags"> {
  films: FilmInfo[];
}

/** The answer to a command; `holding`: to `acknowledge`, the stages that hold even so. */
export interface Done {
  type: "done";
  id: string | null;
  holding?: string[];
}

export type Message =
  | Hello
  | { type: "devices"; devices: DeviceInfo[] }
  | Health
  | LiveEvent
  | { type: "dropped"; frames: number }
  | Done
  | { type: "error"; id: string | null; message: string };

export type Command =
  | { type: "methods"; device: string; methods: { name: string; settings: Record<string, unknown> }[] }
  | { type: "reset_heading"; device: string; forward: string }
  | { type: "acknowledge"; device: string };

export const HEADER = 16;
export const RECORD = 120;

/** Offsets within a record, in units of the field's own size. */
export const AT = { device: 0, flags: 1, time: 1, host: 2, sequence: 3, quat: 8, rate: 12, sigma: 15, gyr: 18, acc: 21, mag: 24, method: 108, valid: 109, tip: 110, flagsSince: 28 };

export const TIP = ["unknown", "upright", "leaning", "tipping", "fallen", "free fall", "picked up", "righted"];
export const NOT_MONITORED = 255;
/** The states that must not be overlooked. */
export const ALARMING = new Set([3, 4, 5]);
