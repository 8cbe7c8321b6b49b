"""Recording: what the sensors said, in SI units, as one table of gyroscope instants."""

from __future__ import annotations

from collections.abc import Iterable
from copy import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.data import axes
from poise.data.attitude import BIAS, BIAS_SIGMA, QUAT, RATE, Attitude
from poise.data.stamps import usual_step
from poise.errors import RecordingError
from poise.math import arrays

Floats = NDArray[np.float64]

STANDARD_GRAVITY = 9.80665
_ALIKE = 50  # steps of 0: more than any packet of samples with one stamp
_SLOWEST = 0.5  # s: no gyroscope is read less often; a larger usual step means stamps in another unit
_EARLIEST = 0.5  # s before the first gyroscope instant: an older sample says nothing of it
_ROWS = ("time", "gyr", "acc", "mag", "acc_age", "mag_age")
_UNITS_OF_TIME = ((1e-3, "milliseconds", 1e3), (1e-6, "microseconds", 1e6), (1e-9, "nanoseconds", 1e9))


@dataclass(frozen=True, eq=False)
class Recording:
    """Inertial samples over time; rows are gyroscope instants, in the order they arrived.

    Give arrays as they come: lists, any number type, NaN where a sensor has no sample, uneven stamps. The body frame is
    the sensor's own, right-handed. A slower sensor stands in the rows that follow its own stamps and is NaN elsewhere
    (:meth:`from_sensors` does that); never repeat its last value.

    Raises :class:`RecordingError` where shapes, lengths or the unit of time cannot be right.
    """

    time: Floats
    """(n,) s, any origin"""
    gyr: Floats
    """(n, 3) rad/s"""
    acc: Floats
    """(n, 3) m/s², specific force: at rest +9.81 along up"""
    mag: Floats = None  # type: ignore[assignment]  # becomes NaN: a recording without a magnetometer
    """(n, 3) µT (or any unit: only the direction counts)"""
    acc_age: Floats = None  # type: ignore[assignment]
    """(n,) s from the accelerometer's own instant to the row's; 0 if not given"""
    mag_age: Floats = None  # type: ignore[assignment]
    """(n,) s from the magnetometer's own instant to the row's; 0 if not given"""
    truth: Attitude | None = None
    """a reference attitude on the same rows"""
    moving: NDArray[np.bool_] | None = None
    """(n,) the rows whose error counts"""
    gravity: float = STANDARD_GRAVITY
    """m/s²"""
    name: str = ""
    source: str = ""
    source_hash: str = ""
    notes: tuple[str, ...] = ()
    """what a reader had to say about the file"""

    def __post_init__(self) -> None:
        values: dict[str, Any] = samples(self.time, self.gyr, self.acc, self.mag)
        n = len(values["time"])
        for name in ("acc_age", "mag_age"):
            values[name] = _rows(name, getattr(self, name), (n,), 0.0)
        if self.moving is not None:
            values["moving"] = _rows("moving", self.moving, (n,), 0.0).astype(bool)
        if self.truth is not None and not isinstance(self.truth, Attitude):
            raise RecordingError(f"truth: expected an Attitude (see Attitude.of), found {type(self.truth).__name__}")
        if self.truth is not None and len(self.truth) != n:
            raise RecordingError(f"truth: expected {n} rows like time, found {len(self.truth)}")
        if not isinstance(self.gravity, (int, float)) or not 0.1 < self.gravity < 100.0:
            raise RecordingError(f"gravity: expected m/s², about 9.8 on Earth, found {self.gravity!r}")
        for name, value in values.items():
            object.__setattr__(self, name, value)
        check_unit_of_time(values["time"])

    @classmethod
    def at_rate(
        cls, rate: float, gyr: ArrayLike, acc: ArrayLike, mag: ArrayLike | None = None, **facts: Any
    ) -> Recording:
        """A recording of evenly spaced samples, *rate* per second, starting at 0 s."""
        if not isinstance(rate, (int, float, np.number)) or not 1.0 / _SLOWEST <= rate < np.inf:
            raise RecordingError(f"rate: expected samples per second, at least {1.0 / _SLOWEST:g}, found {rate!r}")
        time = np.arange(len(np.asarray(gyr))) / float(rate)
        return cls(time=time, gyr=gyr, acc=acc, mag=mag, **facts)  # type: ignore[arg-type]

    @classmethod
    def from_sensors(
        cls,
        gyr: tuple[ArrayLike, ArrayLike],
        acc: tuple[ArrayLike, ArrayLike],
        mag: tuple[ArrayLike, ArrayLike] | None = None,
        **facts: Any,
    ) -> Recording:
        """A recording from sensors with stamps of their own, each given as (time (n,), values (n, 3)).

        Every sample goes, exactly once, to the first gyroscope instant at or after its stamp, and its age is kept.
        Several that meet in one row are averaged, values and ages alike; what comes after the last row is left out.
        """
        time = _numbers("gyr time", gyr[0])
        falls = np.flatnonzero(~(np.diff(time) > 0)) + 1
        if len(falls):
            row = int(falls[0])
            raise RecordingError(
                f"gyr time: must rise from row to row where sensors are merged by their stamps, found {time[row]} s in row "
                f"{row} after {time[row - 1]} s; rows of one packet have to be spread over the time since the one before"
            )
        merged: dict[str, Any] = {}
        for name, sensor in (("acc", acc), ("mag", mag)):
            if sensor is not None:
                merged[name], merged[f"{name}_age"] = place(name, time, *sensor)
        return cls(time=time, gyr=gyr[1], **merged, **facts)  # type: ignore[arg-type]

    def __len__(self) -> int:
        return len(self.time)

    def __getitem__(self, rows: slice | NDArray[Any]) -> Recording:
        """The same recording, fewer rows: a slice, a mask or indices."""
        if not isinstance(rows, slice):
            rows = np.atleast_1d(rows)
        cut = {name: getattr(self, name)[rows] for name in _ROWS}
        cut |= {name: getattr(self, name)[rows] for name in ("truth", "moving") if getattr(self, name) is not None}
        return self.with_samples(**cut)

    def with_samples(self, **values: Any) -> Recording:
        """A copy with other, already checked values: a few rows may lie further apart than any gyroscope's."""
        part = copy(self)
        part.__dict__.update(values)
        return part

    @classmethod
    def joined(cls, parts: Iterable[Recording]) -> Recording:
        """The rows of consecutive *parts* of one recording, at least one, as one recording."""
        first: Recording | None = None
        rows: dict[str, list[Any]] = {name: [] for name in (*_ROWS, "moving", "truth")}
        for part in parts:
            first = first or part
            for name, found in rows.items():
                found.append(getattr(part, name))
        if first is None:
            raise RecordingError("no parts to join into a recording")
        if len(rows["time"]) == 1:
            return first
        truths = rows.pop("truth")
        values: dict[str, Any] = {}
        for name in list(rows):  # one after another, so that each part's memory is free again soon
            arrays_of = rows.pop(name)
            values[name] = None if arrays_of[0] is None else np.concatenate(arrays_of)
        if first.truth is not None:
            tables, flags = np.concatenate([t.table for t in truths]), np.concatenate([t.flags for t in truths])
            values["truth"] = replace(first.truth, time=values["time"], table=tables, flags=flags)
        return first.with_samples(**values)

    def between(self, start: float, end: float) -> Recording:
        """The rows with start ≤ time < end, s."""
        return self[(self.time >= start) & (self.time < end)]

    def remap(self, new_axes: str | ArrayLike, sensor: str = "") -> Recording:
        """The same motion with the sensor's axes renamed or turned; the reference follows.

        With *sensor* "gyr", "acc" or "mag" it is that one's axes against the others', which may be a mirror image, too.

        *new_axes* are words, ``"y -x z"``: the new x is the sensor's y, the new y its −x; or a mounting rotation, a
        (3, 3) matrix with v_new = M v_sensor. Raises :class:`RecordingError` for what is not a right-handed rotation.
        """
        if sensor:
            if sensor not in ("gyr", "acc", "mag"):
                raise RecordingError(f"sensor: expected gyr, acc or mag, found {sensor!r}")
            with np.errstate(invalid="ignore"):
                return self.with_samples(
                    **{sensor: getattr(self, sensor) @ axes.rotation_matrix(new_axes, mirror=True).T}
                )
        turn = axes.rotation_matrix(new_axes)
        truth = self.truth
        if truth is not None:
            table = truth.table.copy()
            table[:, QUAT] = arrays.multiply(truth.quat, arrays.conjugate(arrays.from_matrix(turn)))
            table[:, RATE], table[:, BIAS] = truth.rate @ turn.T, truth.bias @ turn.T
            table[:, BIAS_SIGMA] = np.sqrt(truth.bias_sigma**2 @ (turn**2).T)
            truth = replace(truth, table=table)
        with np.errstate(invalid="ignore"):  # infinite samples become NaN, as absent as they were
            turned = {name: getattr(self, name) @ turn.T for name in ("gyr", "acc", "mag")}
        return self.with_samples(**turned, truth=truth)

    def advance(self, **seconds: float) -> Recording:
        """The same samples with those of "acc" or "mag" set earlier: ``advance(mag=0.015)`` for one that comes 15 ms late.

        They move to the rows that follow their own instants, as in :meth:`from_sensors`; those of a sensor with a sample in
        most rows by whole rows, so that none is lost to jitter, and an age may then be half a step below 0.
        Raises :class:`RecordingError` for another sensor, for more than 1 s, and where stamps do not rise.
        """
        moved: dict[str, Any] = {}
        for sensor, late in seconds.items():
            if sensor not in ("acc", "mag"):
                raise RecordingError(
                    f"delay: expected acc or mag, whose delay counts from the gyroscope; found {sensor!r}"
                )
            if not abs(late) <= _EARLIEST * 2:
                raise RecordingError(f"delay of {sensor}: expected seconds, at most 1, found {late:g}")
            if len(self) > 1 and not (np.diff(self.time) > 0).all():
                raise RecordingError(f"delay of {sensor}: cannot be taken out where stamps do not rise from row to row")
            values = getattr(self, sensor)
            own = self.time - getattr(self, f"{sensor}_age") - late
            step = 1.0 / self.rate_hz if len(self) > 1 else 0.0
            snap = 0.0
            if (
                step and np.isfinite(values).all(axis=1).mean() > 0.5
            ):  # a sample a row: to the nearest, however stamps jitter
                snap = late - (np.round(late / step) + 0.5) * step
            stamps = own + snap
            stamps[stamps < self.time[:1] - step] = np.nan  # what came before the first row is no sample of it
            moved[sensor], age = place(sensor, self.time, stamps, values)
            moved[f"{sensor}_age"] = np.where(np.isfinite(moved[sensor]).all(axis=1), age + snap, 0.0)
        return self.with_samples(**moved)

    @property
    def rate_hz(self) -> float:
        """Samples per second: one over the median step between stamps (of rows in packets, the mean); NaN without steps."""
        return 1.0 / usual_step(self.time)

    @property
    def duration(self) -> float:
        """s from the first to the last stamp."""
        known = self.time[np.isfinite(self.time)]
        return float(known[-1] - known[0]) if len(known) else 0.0

    @property
    def has_mag(self) -> bool:
        """Whether the magnetometer says anything at all (zeros are silence)."""
        return bool((np.isfinite(self.mag).all(axis=1) & (self.mag != 0).any(axis=1)).any())

    def __repr__(self) -> str:
        sensors = [name for name in ("gyr", "acc", "mag") if np.isfinite(getattr(self, name)).any()]
        reference = ", truth" if self.truth is not None else ""
        return (
            f"Recording({self.name or 'unnamed'}: {len(self)} rows, {self.duration:.1f} s at {self.rate_hz:.1f} Hz, "
            f"{' '.join(sensors)}{reference})"
        )


def samples(time: Any, gyr: Any, acc: Any, mag: Any) -> dict[str, Floats]:
    """The four as contiguous float64 arrays (n,) and (n, 3), an absent sensor as NaN.

    Raises :class:`RecordingError` naming the argument, the expected and the found shape.
    """
    stamps = _numbers("time", time)
    if stamps.ndim != 1:
        raise RecordingError(f"time: expected (n,) seconds, found shape {stamps.shape}")
    shape = (len(stamps), 3)
    sensors = {"gyr": gyr, "acc": acc, "mag": mag}
    return {"time": stamps} | {name: _rows(name, values, shape, np.nan) for name, values in sensors.items()}


def _numbers(name: str, values: Any) -> Floats:
    try:
        if np.ma.isMaskedArray(values):
            values = np.ma.filled(values.astype(float), np.nan)
        array = np.asarray(values)
        if array.dtype.kind in "mMcSU" or (array.dtype.kind == "O" and not _holds_numbers(array)):
            raise TypeError(f"its type is {array.dtype}")
        return np.array(array, dtype=np.float64, order="C")
    except (TypeError, ValueError, OverflowError) as problem:
        raise RecordingError(f"{name}: expected numbers, found something else ({problem})") from None


def _holds_numbers(array: NDArray[Any]) -> bool:
    return all(item is None or isinstance(item, (int, float, np.number)) for item in array.ravel())


def _rows(name: str, values: Any, shape: tuple[int, ...], absent: float) -> Floats:
    if values is None:
        return np.full(shape, absent)
    array = _numbers(name, values)
    if array.size == 0 and shape[0] == 0:
        return np.empty(shape)
    if array.shape != shape:
        hint = "; transpose it" if array.shape == shape[::-1] and len(shape) == 2 else ""
        raise RecordingError(
            f"{name}: expected shape {shape} to go with {shape[0]} time stamps, found {array.shape}{hint}"
        )
    return array


def check_unit_of_time(time: Floats, even: bool = False) -> None:
    """Raises :class:`RecordingError`, which names the factor, for stamps that no gyroscope has in seconds.

    *even*: only where three steps or more are alike, so that a loss in a few live samples is not taken for a unit.
    """
    with np.errstate(invalid="ignore", over="ignore"):  # between infinities, or nearly
        steps = np.diff(time)
    if even and not (len(steps) > 2 and steps.min() > 0.0 and steps.max() < 3.0 * steps.min()):
        return
    if len(steps) >= _ALIKE and not (np.abs(steps) > 0.0).any():
        raise RecordingError(
            f"time: all {len(time)} stamps are {time[0]:g}, so that no rate of turn gives an angle; "
            "give the stamps in s, or the samples per second in their place (Recording.at_rate, --rate)"
        )
    if np.sum(steps < 0) > max(2, 0.5 * len(steps)):
        raise RecordingError(f"time: {np.sum(steps < 0)} of {len(steps)} steps go backwards; reverse the rows")
    steps = steps[(steps > 0) & (steps < 1e300)]  # the median's mean of two must not overflow
    if len(steps) < 2:
        return
    step = float(np.median(steps)) if even else usual_step(time)  # steps that are alike are of no packets
    if step <= _SLOWEST:
        return
    factor, unit, per_second = min(_UNITS_OF_TIME, key=lambda u: abs(np.log(step * u[0] / 0.01)))
    raise RecordingError(
        f"time: the usual step is {step:g} s, which no gyroscope has; stamps in {unit}? "
        f"Multiply them by {factor:g} (that gives {per_second / step:.1f} samples per second)"
    )


def place(name: str, rows: Floats, time: ArrayLike, values: ArrayLike) -> tuple[Floats, Floats]:
    """A sensor's *values* (m, 3) at *time* (m,) on the rising *rows* (n,) s, each sample once, and their ages (n,) s.

    :meth:`Recording.from_sensors` says how. Raises :class:`RecordingError` where nearly none falls to a row.
    """
    stamps = _numbers(f"{name} time", time)
    if stamps.ndim != 1:
        raise RecordingError(f"{name} time: expected (n,) seconds, found shape {stamps.shape}")
    given = _rows(name, values, (len(stamps), 3), np.nan)
    usable = np.isfinite(stamps) & np.isfinite(given).all(axis=1)
    row = np.searchsorted(rows, stamps, side="left")
    usable &= (row < len(rows)) & (stamps >= (rows[0] if len(rows) else 0.0) - _EARLIEST)
    if len(stamps) and len(rows) and usable.sum() < 0.05 * len(stamps):
        raise RecordingError(
            f"{name} time: only {usable.sum()} of {len(stamps)} samples fall to the gyroscope's {rows[0]:g} to {rows[-1]:g} s "
            f"(theirs run from {np.nanmin(stamps):g} to {np.nanmax(stamps):g} s); are both clocks and units the same?"
        )
    row, stamps, given = row[usable], stamps[usable], given[usable]
    count = np.bincount(row, minlength=len(rows)).astype(float)
    with np.errstate(invalid="ignore"):
        placed = np.column_stack([np.bincount(row, given[:, i], len(rows)) / count for i in range(3)])
        age = np.bincount(row, rows[row] - stamps, len(rows)) / count
    return placed, np.where(count > 0, age, 0.0)
