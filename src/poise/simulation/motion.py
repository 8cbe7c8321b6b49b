"""Motions from formulas: attitude, angular rate and acceleration are exact derivatives of the same functions.

Functions of time travel as *jets*: an array whose first axis holds the value, the first and the second derivative. A
motion runs on a clock of its own that slows to a stop in rests, so that a rest holds whatever pose it finds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.errors import RecordingError
from poise.math import arrays

Floats = NDArray[np.float64]
Spans = Sequence[tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Motion:
    """The true motion of a sensor, one row per instant.

    Body axes are x right, y forward, z up; the Earth frame is ENU. Raises :class:`RecordingError` where shapes do not
    fit together or time does not rise.
    """

    time: Floats
    """(n,) s"""
    quat: Floats
    """(n, 4) w x y z, body to ENU"""
    rate: Floats
    """(n, 3) rad/s, angular rate in the body frame"""
    acceleration: Floats
    """(n, 3) m/s², of the sensor in ENU, without gravity"""

    def __post_init__(self) -> None:
        n = len(self.time)
        for name, shape in (("time", (n,)), ("quat", (n, 4)), ("rate", (n, 3)), ("acceleration", (n, 3))):
            if getattr(self, name).shape != shape:
                raise RecordingError(f"{name}: expected shape {shape}, found {getattr(self, name).shape}")
        if not (np.diff(self.time) > 0).all():
            raise RecordingError("time: a motion's instants must rise from row to row")

    def __len__(self) -> int:
        return len(self.time)


def forearm(duration: float = 60.0, rate: float = 100.0, seed: int = 0) -> Motion:
    """A forearm with a band: 4 s of rest, then elbow and shoulder motion with pitch within ±60° and a few rests.

    The band sits 0.22 m from the elbow, which itself moves slowly by some centimetres; *rate* is samples per second.
    """
    rng, time = np.random.default_rng(seed), _instants(duration, rate)
    clock = _clock(time, _stretches(rng, duration, first=4.0, busy=(9.0, 15.0), rest=(2.0, 3.5)), ramp=0.8)
    angles = _waves(rng, clock, np.radians([75.0, 58.0, 50.0]), slowest=0.15, fastest=1.1)
    elbow = _waves(rng, clock, [0.08, 0.08, 0.05], slowest=0.1, fastest=0.4)
    return _assembled(time, angles, elbow[2], lever=(0.0, 0.22, 0.02))


def phone(duration: float = 60.0, rate: float = 100.0, seed: int = 0) -> Motion:
    """A phone: 3 s flat at rest, then in the hand, slowly turned; raised to about 76° of pitch for most of the time."""
    rng, time = np.random.default_rng(seed), _instants(duration, rate)
    hand = _clock(time, [(3.0, duration + 10.0)], ramp=1.0)
    raised = _stretches(rng, duration, first=4.0, busy=(12.0, 20.0), rest=(2.0, 4.0))
    angles = _waves(rng, hand, np.radians([40.0, 2.5, 6.0]), slowest=0.03, fastest=0.3)
    angles += _waves(rng, hand, np.radians([0.1, 0.1, 0.1]), slowest=6.0, fastest=9.0)  # tremor
    angles[:, :, 1] += np.radians(73.0) * _pulses(time, raised, ramp=2.0)[1:]
    angles[0, :, 1] += np.radians(3.0)
    palm = _waves(rng, hand, [0.03, 0.03, 0.03], slowest=0.1, fastest=0.5)
    return _assembled(time, angles, palm[2], lever=(0.0, 0.15, 0.0))


def robot(duration: float = 60.0, rate: float = 100.0, seed: int = 0, lean_deg: float = 8.0) -> Motion:
    """A mobile robot on a floor: drives, turns, stops, runs over bumps and leans by up to *lean_deg* degrees.

    The sensor sits 0.3 m above the axle; y points forward, top speed is 0.8 m/s.
    """
    rng, time = np.random.default_rng(seed), _instants(duration, rate)
    drive = _clock(time, _stretches(rng, duration, first=3.0, busy=(8.0, 14.0), rest=(1.5, 3.0)), ramp=1.2)
    angles = _waves(rng, drive, np.radians([200.0, lean_deg, lean_deg / 2]), slowest=0.03, fastest=0.25)
    bumps = _chained(_bumps(drive[0], rng.uniform(0.0, duration, int(duration / 4)), width=0.06), drive)
    angles[:, :, 1] += np.radians(1.5) * bumps
    speed, turn = 0.8 * drive[1:], angles[:, :, 0]
    forward = np.column_stack([-np.sin(turn[0]), np.cos(turn[0]), np.zeros(len(time))])
    left = np.column_stack([-forward[:, 1], forward[:, 0], np.zeros(len(time))])
    axle = speed[1][:, None] * forward + (speed[0] * turn[1])[:, None] * left
    axle[:, 2] += 0.006 * bumps[2]
    return _assembled(time, angles, axle, lever=(0.0, 0.0, 0.3))


def at_rest(quat: ArrayLike = (1.0, 0.0, 0.0, 0.0), duration: float = 10.0, rate: float = 100.0) -> Motion:
    """A sensor that lies still at *quat*, w x y z, body to ENU."""
    time = _instants(duration, rate)
    pose = arrays.normalize(np.asarray(quat, float))
    if pose.shape != (4,) or not np.isfinite(pose).all():
        raise RecordingError(f"quat: expected a quaternion w x y z (4,), found {quat!r}")
    return Motion(time, np.tile(pose, (len(time), 1)), np.zeros((len(time), 3)), np.zeros((len(time), 3)))


def turned_about_up(motion: Motion, angle: float) -> Motion:
    """The same motion in a world turned counter-clockwise about up by *angle* (rad): gyr and acc say the same."""
    turn = arrays.turn_about_up(np.array(angle))
    quat, acceleration = arrays.multiply(turn, motion.quat), arrays.rotate(turn, motion.acceleration)
    return replace(motion, quat=quat, acceleration=acceleration)


def _instants(duration: float, rate: float) -> Floats:
    if not (np.isfinite([duration, rate]).all() and duration > 0 and rate > 0):
        raise RecordingError(f"duration and rate: expected seconds and samples per second above 0: {duration}, {rate}")
    return np.arange(round(duration * rate)) / float(rate)


# -- functions of time as jets ------------------------------------------------------------------------------------


def _step(u: Floats) -> Floats:
    """(4, n): a smooth step from 0 at u = 0 to 1 at u = 1, twice differentiable: integral, value, two derivatives."""
    v = np.clip(u, 0.0, 1.0)
    return np.stack(
        [
            v**4 * (2.5 - 3.0 * v + v**2) + np.maximum(u - 1.0, 0.0),
            v**3 * (10.0 - 15.0 * v + 6.0 * v**2),
            30.0 * (v * (1.0 - v)) ** 2,
            60.0 * v * (1.0 - v) * (1.0 - 2.0 * v),
        ]
    )


def _pulses(time: Floats, spans: Spans, ramp: float) -> Floats:
    """(4, n): 1 inside the *spans*, 0 outside, with ramps of *ramp* s inside: integral, value, two derivatives."""
    total = np.zeros((4, len(time)))
    for start, end in spans:
        total += _step((time - start) / ramp) - _step((time - end + ramp) / ramp)
    return np.asarray(total * ramp ** np.array([1.0, 0.0, -1.0, -2.0])[:, None])


def _clock(time: Floats, spans: Spans, ramp: float) -> Floats:
    """(3, n): the jet of a clock that runs inside the *spans* and stands still outside."""
    return _pulses(time, spans, ramp)[:3]


def _stretches(
    rng: np.random.Generator, duration: float, *, first: float, busy: tuple[float, float], rest: tuple[float, float]
) -> list[tuple[float, float]]:
    """Busy stretches of drawn lengths after a *first* rest, with drawn rests between them and one at the end, s."""
    spans, start = [], first
    while start < duration - 1.0:
        end = min(start + rng.uniform(*busy), duration - 1.0)
        spans.append((start, max(end, start + 2.0)))  # long enough for both ramps
        start = end + rng.uniform(*rest)
    return spans


def _waves(rng: np.random.Generator, clock: Floats, reach: ArrayLike, *, slowest: float, fastest: float) -> Floats:
    """(3, n, c): jets of sums of three sinusoids of drawn frequencies (Hz) and phases, each within ± *reach* (c,)."""
    columns = np.asarray(reach, float)
    omega = 2 * np.pi * np.exp(rng.uniform(np.log(slowest), np.log(fastest), (3, len(columns))))
    phase = rng.uniform(0.0, 2 * np.pi, omega.shape)
    size = columns * (1.0 / omega) / np.sum(1.0 / omega, axis=0)  # slow waves are large
    argument = clock[0][:, None, None] * omega + phase
    sine, cosine = np.sin(argument), np.cos(argument)
    jet = np.stack([size * sine, size * omega * cosine, -size * omega**2 * sine]).sum(axis=2)
    return _chained(jet, clock)


def _bumps(s: Floats, centres: Floats, width: float) -> Floats:
    """(3, n): the jet, over s, of Gaussian bumps of height 1."""
    u = (s[:, None] - centres) / width
    bell = np.exp(-0.5 * u**2)
    return np.asarray(np.stack([bell, -u / width * bell, (u**2 - 1.0) / width**2 * bell]).sum(axis=2))


def _chained(jet: Floats, clock: Floats) -> Floats:
    """The jet over time of a function given over the clock: f(s(t))."""
    _, s1, s2 = clock.reshape(3, -1, *[1] * (jet.ndim - 2))
    return np.stack([jet[0], jet[1] * s1, jet[2] * s1**2 + jet[1] * s2])


# -- from Euler angles to the motion of the sensor -------------------------------------------------------------------


def _assembled(time: Floats, angles: Floats, pivot: Floats, lever: tuple[float, float, float]) -> Motion:
    """The motion of a sensor at *lever* (m, body) from a pivot that accelerates by *pivot* (n, 3) m/s².

    *angles* (3, n, 3) are the jets of heading, pitch and roll, rad: q = Rz(heading) Rx(pitch) Ry(roll).
    """
    heading, pitch, roll = (0.5 * angles[0, :, i] for i in range(3))
    zero = np.zeros_like(heading)
    about_x = np.stack([np.cos(pitch), np.sin(pitch), zero, zero], axis=1)
    about_y = np.stack([np.cos(roll), zero, np.sin(roll), zero], axis=1)
    quat = arrays.multiply(arrays.multiply(arrays.turn_about_up(heading * 2), about_x), about_y)
    rate, change = _rates(angles)
    arm = np.array(lever)
    swing = np.cross(change, arm) + np.cross(rate, np.cross(rate, arm))
    return Motion(time, arrays.continuous(quat), rate, pivot + arrays.rotate(quat, swing))


def _rates(angles: Floats) -> tuple[Floats, Floats]:
    """The body's angular rate (n, 3) rad/s and its derivative, from the jets of heading, pitch and roll."""
    _, pitch, roll = angles[0].T
    heading1, pitch1, roll1 = angles[1].T
    heading2, pitch2, roll2 = angles[2].T
    sp, cp, sr, cr = np.sin(pitch), np.cos(pitch), np.sin(roll), np.cos(roll)
    level = cp * heading1  # the part of the heading's rate that the roll turns between x and z
    level1 = cp * heading2 - sp * pitch1 * heading1
    rate = np.column_stack([cr * pitch1 - sr * level, roll1 + sp * heading1, sr * pitch1 + cr * level])
    change = np.column_stack(
        [
            cr * pitch2 - sr * level1 - roll1 * rate[:, 2],
            roll2 + sp * heading2 + cp * pitch1 * heading1,
            sr * pitch2 + cr * level1 + roll1 * rate[:, 0],
        ]
    )
    return rate, change
