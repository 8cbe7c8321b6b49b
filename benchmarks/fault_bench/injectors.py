"""Faults as they are put into a recording, at places drawn from a seeded generator.

Every injector is a function of a clean recording and a generator and gives an :class:`Injected`. Sizes and durations are those
of the requirement; none is taken from, or shared with, the code that is tested.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from poise import Recording

Floats = NDArray[np.float64]
Rows = NDArray[np.intp]
Mask = NDArray[np.bool_]

LAST = 60.0  # s at the end of a recording over which the error is compared with that of the clean run
LEAD, SETTLE = 5.0, 12.0  # s of motion before a fault, and of time between a fault and the last stretch
TURNING = 0.3  # rad/s: what the gyroscope has to show, as a median over the fault, to count as moving
GRAVITY = 9.80665


@dataclass(frozen=True)
class Injected:
    """A recording with a fault in it."""

    recording: Recording
    origin: Rows
    """(m,) for each of its rows, the row of the clean recording that it was"""
    wrong: Mask
    """(m,) its rows that the fault is in; for what is only missing, the first row after"""
    start: float
    """s, on the clean recording's clock: the first instant at which the fault could be seen"""
    end: float
    """s, on that clock: the fault is over"""


Injector = Callable[[Recording, np.random.Generator], Injected]
Change = Callable[[dict[str, Floats], slice, np.random.Generator], None]


def place(recording: Recording, rng: np.random.Generator, seconds: float, turning: bool = False) -> slice:
    """Rows for a fault of *seconds* (0: one row) in the motion, after its start and well before the last stretch."""
    assert recording.moving is not None
    time = recording.time
    earliest = time[np.argmax(recording.moving)] + LEAD
    latest = max(time[-1] - LAST - SETTLE - seconds, earliest + 1.0)
    rows = np.flatnonzero((time >= earliest) & (time <= latest))
    n = max(1, round(seconds * recording.rate_hz))
    for _ in range(200):
        first = int(rng.choice(rows))
        rate = np.linalg.norm(recording.gyr[first : first + max(n // 4, 20)], axis=1)
        moves = bool(recording.moving[first : first + n].mean() > 0.8)
        if moves and (not turning or float(np.median(rate)) > TURNING):
            break
    return slice(first, first + n)


def values(change: Change, seconds: float, turning: bool = False) -> Injector:
    """An injector that changes samples in one stretch of *seconds*; rows and stamps stay."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        rows = place(recording, rng, seconds, turning)
        sensors = {name: getattr(recording, name).copy() for name in ("gyr", "acc", "mag")}
        change(sensors, rows, rng)
        wrong = np.zeros(len(recording), bool)
        wrong[rows] = True
        return Injected(_with(recording, **sensors), _all(recording), wrong, *_span(recording, rows))

    return inject


def _with(recording: Recording, **changed: Any) -> Recording:
    return replace(recording, truth=None, moving=None, **changed)


def _all(recording: Recording) -> Rows:
    return np.arange(len(recording))


def _span(recording: Recording, rows: slice) -> tuple[float, float]:
    return float(recording.time[rows.start]), float(recording.time[rows.stop - 1])


def _direction(rng: np.random.Generator) -> Floats:
    v = rng.normal(size=3)
    return np.asarray(v / np.linalg.norm(v))


# -- samples in one stretch -------------------------------------------------------------------------------------------


def fixed(sensors: str, value: float, seconds: float, turning: bool = False) -> Injector:
    """*value* in all axes of the named sensors ("gyr acc mag"), for one row (0 s) or longer."""

    def change(arrays: dict[str, Floats], rows: slice, rng: np.random.Generator) -> None:
        for name in sensors.split():
            arrays[name][rows] = value

    return values(change, seconds, turning)


def stuck(sensor: str, seconds: float, turning: bool = False) -> Injector:
    """The last sample before, over and over."""

    def change(arrays: dict[str, Floats], rows: slice, rng: np.random.Generator) -> None:
        arrays[sensor][rows] = arrays[sensor][rows.start - 1]

    return values(change, seconds, turning)


def from_then_on(sensor: str, value: float) -> Injector:
    """*value* in all axes from some instant to the end."""
    return _for_ever(sensor, lambda samples, rng: np.full_like(samples, value))


def hard_iron(microtesla: float, seconds: float | None) -> Injector:
    """A constant field fixed to the body, in a random direction, for *seconds* or for ever."""
    if seconds is None:
        return _for_ever("mag", lambda samples, rng: samples + microtesla * _direction(rng))

    def change(arrays: dict[str, Floats], rows: slice, rng: np.random.Generator) -> None:
        arrays["mag"][rows] += microtesla * _direction(rng)

    return values(change, seconds)


def bias_step(deg_s: float) -> Injector:
    """The gyroscope's bias jumps in a random direction and stays there."""
    return _for_ever("gyr", lambda samples, rng: samples + np.radians(deg_s) * _direction(rng))


def absent(recording: Recording, rng: np.random.Generator) -> Injected:
    """No magnetometer at all."""
    start, end = float(recording.time[0]), float(recording.time[-1])
    return Injected(_with(recording, mag=None), _all(recording), np.ones(len(recording), dtype=bool), start, end)


def _for_ever(sensor: str, change: Callable[[Floats, np.random.Generator], Floats]) -> Injector:
    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        first = place(recording, rng, 0.0).start
        samples = getattr(recording, sensor).copy()
        samples[first:] = change(samples[first:], rng)
        wrong = np.arange(len(recording)) >= first
        start, end = float(recording.time[first]), float(recording.time[-1])
        return Injected(_with(recording, **{sensor: samples}), _all(recording), wrong, start, end)

    return inject


# -- samples all over the recording -----------------------------------------------------------------------------------


def spikes(sensor: str, share: float, size: float) -> Injector:
    """*size* added in a random direction to a *share* of the rows."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        n = len(recording)
        wrong = rng.random(n) < share
        directions = rng.normal(size=(n, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        samples = getattr(recording, sensor) + np.where(wrong[:, None], size * directions, 0.0)
        return _throughout(recording, _with(recording, **{sensor: samples}), _all(recording), wrong)

    return inject


def clipped(sensor: str, share: float, least: float) -> Injector:
    """A sensor whose range ends where a *share* of its samples in motion lies beyond, but not below *least*.

    Rows count as wrong from the second equal extreme on.
    """

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        samples = getattr(recording, sensor)
        assert recording.moving is not None
        largest = np.abs(samples[recording.moving]).max(axis=1)
        end = max(least, float(np.quantile(largest, 1.0 - share * rng.uniform(0.5, 1.0))))
        beyond = np.abs(samples) >= end
        wrong = np.zeros(len(recording), bool)
        wrong[1:] = (beyond[1:] & beyond[:-1] & (np.sign(samples[1:]) == np.sign(samples[:-1]))).any(axis=1)
        changed = _with(recording, **{sensor: np.clip(samples, -end, end)})
        return _throughout(recording, changed, _all(recording), wrong)

    return inject


def _throughout(clean: Recording, recording: Recording, origin: Rows, wrong: Mask) -> Injected:
    return Injected(recording, origin, wrong, float(clean.time[0]), float(clean.time[-1]))


# -- rows -------------------------------------------------------------------------------------------------------------


def link_lost(seconds: float) -> Injector:
    """No rows at all for a while."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        rows = place(recording, rng, seconds)
        origin = np.delete(_all(recording), rows)
        wrong = np.arange(len(origin)) == rows.start  # the first row after
        # Nobody can see a loss in a file before the next row: that is when the clock of the requirement starts.
        back = float(recording.time[rows.stop])
        return Injected(_rows(recording, origin), origin, wrong, back, back)

    return inject


def loss(share: float) -> Injector:
    """Each row is lost with the same chance."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        origin = np.flatnonzero(rng.random(len(recording)) >= share)
        return _throughout(recording, _rows(recording, origin), origin, np.zeros(len(origin), bool))

    return inject


def duplicates(share: float) -> Injector:
    """Rows come twice, stamp and all."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        twice = rng.random(len(recording)) < share
        origin = np.repeat(_all(recording), 1 + twice)
        wrong = np.concatenate([[False], origin[1:] == origin[:-1]])
        return _throughout(recording, _rows(recording, origin), origin, wrong)

    return inject


def swaps(share: float) -> Injector:
    """Rows change places with the next one, stamp and all."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        origin = _all(recording)
        first = np.flatnonzero(rng.random(len(recording) - 1) < share)
        first = first[np.concatenate([[True], np.diff(first) > 1])]
        origin[first], origin[first + 1] = first + 1, first
        wrong = np.zeros(len(origin), bool)
        wrong[first] = wrong[first + 1] = True
        return _throughout(recording, _rows(recording, origin), origin, wrong)

    return inject


def _rows(recording: Recording, origin: Rows) -> Recording:
    return _with(recording[origin])


# -- stamps -----------------------------------------------------------------------------------------------------------


def jitter(share: float) -> Injector:
    """Stamps are off by up to a *share* of the period, either way."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        n = len(recording)
        time = recording.time + rng.uniform(-share, share, n) / recording.rate_hz
        return _throughout(recording, _with(recording, time=time), _all(recording), np.zeros(n, bool))

    return inject


def batched(fewest: int, most: int) -> Injector:
    """Rows arrive in batches and are stamped on arrival: all of a batch carry the stamp of its last row."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        n = len(recording)
        ends = np.cumsum(rng.integers(fewest, most + 1, n)) - 1
        last = np.minimum(ends[np.searchsorted(ends, np.arange(n))], n - 1)
        changed = _with(recording, time=recording.time[last])
        return _throughout(recording, changed, _all(recording), np.zeros(n, bool))

    return inject


def bursts(fewest: int, most: int, apart: float) -> Injector:
    """Rows arrive in batches and a program stamps them as it reads them, *apart* s from one to the next."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        injected = batched(fewest, most)(recording, rng)
        time = injected.recording.time
        firsts = np.flatnonzero(np.diff(time, prepend=-np.inf) > 0.0)
        since = np.arange(len(time)) - np.repeat(firsts, np.diff(np.append(firsts, len(time))))
        return replace(injected, recording=_with(injected.recording, time=time + apart * since))

    return inject


def clock_jump(seconds: float) -> Injector:
    """From some row on the clock is off by *seconds*."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        first = place(recording, rng, 0.0).start
        time = recording.time + np.where(np.arange(len(recording)) >= first, seconds, 0.0)
        wrong = np.arange(len(recording)) == first
        at = float(recording.time[first])
        return Injected(_with(recording, time=time), _all(recording), wrong, at, at)

    return inject


def stamps(value: float, seconds: float) -> Injector:
    """Stamps that are *value*, in one row (0 s) or for longer."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        rows = place(recording, rng, seconds)
        time = recording.time.copy()
        time[rows] = value
        wrong = np.zeros(len(time), bool)
        wrong[rows] = True
        return Injected(_with(recording, time=time), _all(recording), wrong, *_span(recording, rows))

    return inject


def scaled_stamps(factor: float) -> Injector:
    """Stamps in another unit; 0: all of them zero."""

    def inject(recording: Recording, rng: np.random.Generator) -> Injected:
        changed = _with(recording, time=factor * recording.time)
        return _throughout(recording, changed, _all(recording), np.ones(len(recording), bool))

    return inject
