// Angles of a record, as `poise.Attitude` has them: a body with x right and y forward, Earth east-north-up. Degrees.

import { AT } from "./protocol";
import type { Ring } from "./ring";

export const DEGREES = 180 / Math.PI;

export interface Angles {
  /** clockwise from north, 0 to 360 */
  heading: number;
  /** up is positive, −90 to 90 */
  pitch: number;
  /** right side down is positive */
  roll: number;
  /** between the body's z and up */
  tilt: number;
  /** about the Earth's or the base's z, to the left, −180 to 180 */
  turn: number;
  /** of the whole rotation, 0 to 180: what a joint is bent by */
  angle: number;
  sigmaHeading: number;
  sigmaPitch: number;
  sigmaRoll: number;
  sigmaTilt: number;
  sigmaAngle: number;
}

export function angles(ring: Ring, k: number): Angles {
  const w = ring.value(k, AT.quat);
  const x = ring.value(k, AT.quat + 1);
  const y = ring.value(k, AT.quat + 2);
  const z = ring.value(k, AT.quat + 3);
  // the body's y and z in the Earth frame; row 3 of the matrix
  const forwardEast = 2 * (x * y - w * z);
  const forwardNorth = 1 - 2 * (x * x + z * z);
  const forwardUp = 2 * (y * z + w * x);
  const rightUp = 2 * (x * z - w * y);
  const upEast = 2 * (x * z + w * y);
  const upNorth = 2 * (y * z - w * x);
  const upUp = 1 - 2 * (x * x + y * y);
  const bearing = Math.atan2(forwardEast, forwardNorth);
  const heading = bearing * DEGREES;
  const east = ring.value(k, AT.sigma) * DEGREES;
  const north = ring.value(k, AT.sigma + 1) * DEGREES;
  // pitch turns about the level axis to the right, roll about the level axis ahead
  const sine = Math.sin(bearing);
  const cosine = Math.cos(bearing);
  const lean = Math.hypot(upEast, upNorth);
  const up = ring.value(k, AT.sigma + 2) * DEGREES;
  const half = Math.hypot(x, y, z);
  const [leanEast, leanNorth] = lean > 1e-6 ? [upEast / lean, upNorth / lean] : [Math.SQRT1_2, Math.SQRT1_2];
  return {
    heading: heading < 0 ? heading + 360 : heading,
    pitch: Math.asin(Math.max(-1, Math.min(1, forwardUp))) * DEGREES,
    roll: Math.atan2(-rightUp, upUp) * DEGREES,
    tilt: Math.atan2(lean, upUp) * DEGREES,
    turn: -heading,
    angle: 2 * Math.atan2(half, Math.abs(w)) * DEGREES,
    sigmaHeading: up,
    sigmaPitch: Math.hypot(east * cosine, north * sine),
    sigmaRoll: Math.hypot(east * sine, north * cosine),
    sigmaTilt: Math.hypot(east * leanNorth, north * leanEast),
    // about the axis that it is turned about; where it is not, about any
    sigmaAngle: half > 1e-3 ? Math.hypot(x * east, y * north, z * up) / half : Math.hypot(east, north, up) / Math.sqrt(3),
  };
}

export function fixed(value: number, digits: number): string {
  return Number.isFinite(value) ? value.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1").replace("-", "−") : "–";
}
