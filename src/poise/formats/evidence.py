"""Evidence for units: what the samples themselves say where a file names none, or names the wrong one."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.stamps import usual_step
from poise.formats.units import FACTORS

Floats = NDArray[np.float64]

RATES = (5.0, 10e3)  # 1/s: gyroscopes in use
_STRETCH, _STRETCHES = 25_000, 8  # rows looked at: evenly spread over a long recording
_WINDOW = 0.1  # s: longer than vibration, shorter than most turns
_SURE = 8.0  # standard errors between the fitted factor and none at all; neighbouring windows are not independent
_CLOCKS = ("s", "ms", "us", "ns")
_CANDIDATES = ("rad/s", "deg/s", "mdeg/s")


class Verdict(NamedTuple):
    """What the samples say of a unit: the one they decide for ("" if they do not) and the figures behind it."""

    unit: str
    sentence: str
    size: float = float("nan")
    """time: usual step; acc: median length; gyr: fitted rad/s per unit; all in the file's own units"""


def of_time(time: Floats, ticks: str = "") -> Verdict:
    """Which unit gives the stamps (n,) a rate that gyroscopes have.

    *ticks* is a unit that counts only where a clock is known for it ("100us"), and then before all others.
    """
    step = usual_step(time)
    if not step > 0.0:
        return Verdict("", "no stamp rises above the one before")
    rates = {unit: per_second / step for unit, per_second in FACTORS["time"].items() if unit in (*_CLOCKS, ticks)}
    fits = [unit for unit, rate in rates.items() if RATES[0] <= rate <= RATES[1]]
    if ticks in fits:
        fits = [ticks]
    if len(fits) == 1:
        return Verdict(fits[0], f"its usual step {step:.6g} means {rates[fits[0]]:.1f} samples per second", step)
    maybe = " or ".join(f"{rates[unit]:.4g} Hz in {unit}" for unit in fits) or "no rate of a gyroscope in any unit"
    return Verdict("", f"its usual step {step:.6g} would be {maybe}", step)


def of_acc(acc: Floats) -> Verdict:
    """Which unit gives the specific force (n, 3) the length of gravity: its median, and that it seldom comes near 0."""
    length = np.sqrt(np.einsum("ij,ij->i", acc, acc))
    length = length[np.isfinite(length)]
    if not len(length):
        return Verdict("", "it has no sample")
    low, median = (float(value) for value in np.quantile(length, [0.1, 0.5]))
    sentence = f"its median length is {median:.4g}"
    for unit in ("m/s²", "g", "mg"):
        gravity = 9.80665 / FACTORS["acc"][unit]
        if gravity / 1.5 < median < gravity * 1.5 and low > 0.4 * gravity:
            return Verdict(unit, sentence, median)
    return Verdict("", sentence, median)


def of_gyr(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Verdict:
    """Which unit makes gravity and the magnetic field turn as the gyroscope says: d(v)/dt = −ω × v.

    *time* (n,) in s; *gyr* (n, 3) in its unknown unit; *acc*, *mag* (n, 3) in any unit.
    """
    step = usual_step(time)
    if not step > 0.0:
        return Verdict("", "without rising stamps no turn can be measured")
    rows = max(1, round(_WINDOW / step))
    found = {}
    for name, vector in (("gravity", acc), ("the magnetic field", mag)):
        predicted, seen = _turns(gyr, vector, rows, step)
        if (fit := _fit(predicted, seen)) is not None:
            found[name] = fit
    if not found:
        return Verdict("", "it turns too little, or too few rows are complete, to compare it with gravity or the field")
    against, (scale, error) = max(found.items(), key=lambda item: item[1][0] / item[1][1])
    sentence = f"{against} turns by {scale:.3g} ± {error:.1g} rad per unit of it (rad/s is 1, deg/s 0.0175)"
    near = [unit for unit in _CANDIDATES if 0.4 < scale / FACTORS["gyr"][unit] < 2.5]
    if near and scale > _SURE * error:
        return Verdict(near[0], sentence, scale)
    return Verdict("", sentence, scale)


def _turns(gyr: Floats, vector: Floats, rows: int, step: float) -> tuple[Floats, Floats]:
    """Window by window: −θ × v with θ in units of gyr times s, and the change of the direction v, both (m, 3)."""
    predicted, seen = [np.empty((0, 3))], [np.empty((0, 3))]
    stride = max(_STRETCH, len(gyr) // _STRETCHES)
    for start in range(0, len(gyr), stride):
        v = _means(vector[start : start + _STRETCH], rows)
        turn = _means(gyr[start : start + _STRETCH], rows) * (rows * step)
        with np.errstate(invalid="ignore", divide="ignore"):
            v = v / np.sqrt(np.einsum("ij,ij->i", v, v))[:, None]
        if len(v) > 2:
            theta = (turn[:-1] + turn[1:]) / 2
            predicted.append(np.cross(v[:-1] + v[1:], theta) / 2)
            seen.append(np.diff(v, axis=0))
    p, d = np.concatenate(predicted), np.concatenate(seen)
    usable = np.isfinite(p).all(axis=1) & np.isfinite(d).all(axis=1)
    return p[usable], d[usable]


def _means(values: Floats, rows: int) -> Floats:
    """(m, 3) means over windows of *rows*, NaN where a window holds no sample at all."""
    windows = values[: len(values) // rows * rows].reshape(-1, rows, 3)
    known = np.isfinite(windows)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        return np.asarray(np.where(known, windows, 0.0).sum(axis=1) / known.sum(axis=1))


def _fit(predicted: Floats, seen: Floats) -> tuple[float, float] | None:
    """The factor that fits *seen* = factor × *predicted* best, and its standard error; None where there is no fit."""
    if len(seen) < 20:
        return None
    size = float(np.max(np.abs(predicted)))
    if not (np.isfinite(size) and size > 0):
        return None
    predicted = predicted / size
    power = float(np.sum(predicted**2))
    scale = float(np.sum(predicted * seen)) / power
    error = np.sqrt(float(np.sum((seen - scale * predicted) ** 2)) / (len(seen) * power))
    return scale / size, max(float(error), 1e-12) / size
