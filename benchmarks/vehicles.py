"""Made motions of vehicles on level ground, at 100 Hz, after `poise.simulation`'s arm, phone and robot."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.math import arrays
from poise.simulation import Motion

Floats = NDArray[np.float64]

RATE = 100.0
X = np.array([1.0, 0.0, 0.0])  # to the right
Y = np.array([0.0, 1.0, 0.0])  # forward


def instants(seconds: float) -> Floats:
    return np.arange(round(seconds * RATE)) / RATE


def between(time: Floats, begin: float, end: float, ramp: float) -> Floats:
    """0, then 1 from *begin* to *end*, with smooth ramps of *ramp* s behind each."""

    def step(u: Floats) -> Floats:
        v = np.clip(u, 0.0, 1.0)
        return np.asarray(v**3 * (10.0 - 15.0 * v + 6.0 * v**2))

    return step((time - begin) / ramp) - step((time - end) / ramp)


def shaking(rng: np.random.Generator, time: Floats, fastest: float, axes: int) -> Floats:
    """(n, axes): sums of eight sinusoids of drawn frequencies up to *fastest* (Hz) and phases, 1 in the mean square."""
    omega = 2.0 * np.pi * fastest * rng.uniform(0.05, 1.0, (8, axes))
    phase = rng.uniform(0.0, 2.0 * np.pi, (8, axes))
    return np.asarray(0.5 * np.sin(time[:, None, None] * omega + phase).sum(axis=1))


def driven(
    speed: Floats, turning: Floats, pitch: ArrayLike = 0.0, roll: ArrayLike = 0.0, shaken: ArrayLike = 0.0
) -> Motion:
    """A vehicle with its *speed* (m/s) along its way, *turning* (rad/s) about up, leaning (rad), *shaken* (m/s², ENU)."""
    heading = (np.cumsum(turning) - 0.5 * turning) / RATE
    lean_x, lean_y = (_about(axis, np.broadcast_to(angle, speed.shape)) for axis, angle in ((X, pitch), (Y, roll)))
    quat = arrays.continuous(arrays.multiply(arrays.multiply(arrays.turn_about_up(heading), lean_x), lean_y))
    ahead = arrays.rotate(arrays.turn_about_up(heading), np.tile(Y, (len(speed), 1)))
    left = np.column_stack([-ahead[:, 1], ahead[:, 0], ahead[:, 2]])
    pushed = np.gradient(speed, 1.0 / RATE)[:, None] * ahead + (speed * turning)[:, None] * left
    turn = 2.0 * arrays.multiply(arrays.conjugate(quat), np.gradient(quat, 1.0 / RATE, axis=0))
    return Motion(instants(len(speed) / RATE), quat, turn[:, 1:], pushed + shaken)


def _about(axis: Floats, angle: Floats) -> Floats:
    return np.column_stack([np.cos(0.5 * angle), np.outer(np.sin(0.5 * angle), axis)])


def circling(rate: float, radius: float, seed: int, seconds: float = 150.0) -> Motion:
    """Still for 8 s, round and round at *rate* (rad/s) on *radius* (m), pitching by 1° or so, and still for 6 s."""
    time = instants(seconds)
    going = between(time, 8.0, seconds - 10.0, 4.0)
    pitch = np.radians(1.0) * shaking(np.random.default_rng(seed), time, 0.3, 1)[:, 0] * going
    return driven(rate * radius * going, rate * going, pitch)


def car(seed: int) -> Motion:
    """Three minutes: up to speed with 2 m/s², straight on, bends of up to 4 m/s² and 20 s, brakes of 3 m/s², a stop.

    The body squats, dips and leans outwards, and the road shakes it.
    """
    rng, time = np.random.default_rng(seed), instants(180.0)
    gains = (2.0, 5.0, 12.0), (-2.5, 45.0, 48.0), (2.0, 52.0, 56.0), (-3.0, 110.0, 113.5), (2.0, 120.0, 124.0)
    bends = (0.25, 60.0, 80.0), (-0.3, 90.0, 96.0), (0.35, 130.0, 150.0)
    gain = _sum_of(time, (*gains, (-2.0, 165.0, 171.0)), 1.0)  # which ends at 0 m/s
    speed, turning = np.cumsum(gain) / RATE, _sum_of(time, bends, 1.5)
    fast = np.clip(speed / 10.0, 0.0, 1.0)[:, None]
    road = np.radians(0.3) * fast * shaking(rng, time, 1.5, 2)
    pitch = np.radians(0.8) * gain / 3.0 + road[:, 0]
    roll = np.radians(2.0) * speed * turning / 4.0 + road[:, 1]
    return driven(speed, turning, pitch, roll, np.array([0.2, 0.2, 0.6]) * fast * shaking(rng, time, 8.0, 3))


def _sum_of(time: Floats, stretches: Iterable[tuple[float, float, float]], ramp: float) -> Floats:
    """So much, from then, until then."""
    return np.sum([much * between(time, begin, end, ramp) for much, begin, end in stretches], axis=0)


def weaving(turning: float, seed: int, seconds: float = 250.0) -> Motion:
    """Still for 10 s, then at 10 m/s, to and fro by up to *turning* (rad/s) every 12 s, and still for the last 30 s."""
    rng, time = np.random.default_rng(seed), instants(seconds)
    going = between(time, 10.0, seconds - 38.0, 8.0)
    shaken = np.array([0.2, 0.2, 0.6]) * going[:, None] * shaking(rng, time, 8.0, 3)
    phase = rng.uniform(0.0, 2.0 * np.pi)
    return driven(10.0 * going, turning * going * np.sin(2.0 * np.pi * time / 12.0 + phase), shaken=shaken)
