"""Units: which factor makes the numbers of a sensor, or of the clock, what physics allows."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.corrections import Corrections
from poise.data.recording import STANDARD_GRAVITY, Recording
from poise.data.stamps import rising_steps, usual_step
from poise.doctor import turning
from poise.doctor.findings import Finding, unit_after
from poise.doctor.turning import Blocks
from poise.formats.evidence import RATES
from poise.formats.units import FACTORS, SI

Floats = NDArray[np.float64]

_TIMES = (1e-3, 1e-6, 1e-9, 1e3, 1e6)
_RARE, _RARELY = "100us", 500.0  # Xsens counts in steps of 0.1 ms, and gives so many samples a second at most
_ACC = {"g": STANDARD_GRAVITY, "mg": STANDARD_GRAVITY * 1e-3, "m/s²": 1.0}
_NEAR = 1.5  # a median length within this factor of gravity is gravity
_STEADY = 0.55  # of the median: the shortest tenth of any motion's force with gravity in it, but for violent ones
_FREE = 0.3  # of gravity: no accelerometer on Earth shows less by its median
_EARTH = (15.0, 90.0)  # µT, with some iron about
_MAG = {"G": 100.0, "mG": 0.1, "nT": 1e-3, "mT": 1e3, "T": 1e6}
WANTED = (
    "An attitude needs the accelerometer's own samples (specific force): export the raw or total acceleration, or add the "
    "columns of gravity to it"
)
_LOOKED_AT = 50_000  # lengths are enough for a median


class Clock(NamedTuple):
    """In which unit the stamps may be."""

    factor: float
    """what they are multiplied by, until the gyroscope says otherwise"""
    others: tuple[float, ...] = ()
    """further factors that may be right"""
    finding: Finding | None = None
    counts: bool = False
    """whether the file's own stamps rise by one from row to row, and nobody named their unit"""


def of_time(recording: Recording, read_as: str = SI["time"], *, guessed: bool = False) -> Clock:
    """Whether the stamps are in another unit than s; *read_as* is what the file's own were taken for, or *guessed*."""
    if len(rising_steps(recording.time)) < 2:
        return Clock(1.0)
    step = usual_step(recording.time)
    if RATES[0] / 10 <= 1.0 / step <= 5 * RATES[1]:
        factors = {unit: FACTORS["time"][read_as] / count for unit, count in FACTORS["time"].items() if unit != read_as}
        if not guessed:
            return Clock(1.0)
        own = rising_steps(recording.time) * FACTORS["time"][read_as]
        counts = bool(np.mean(np.abs(own - 1.0) < 1e-6) > 0.9)
        return Clock(
            1.0, tuple(factor for unit, factor in factors.items() if _may_be(step, factor, unit)), counts=counts
        )
    said = f"the usual step between stamps is {step:.4g} s, {1.0 / step:.4g} samples per second, which no gyroscope has"
    fits = [factor for factor in _TIMES if RATES[0] <= 1.0 / (step * factor) <= RATES[1]]
    rare = 1.0 / FACTORS["time"][_RARE]
    unusual = [rare] if _may_be(step, rare, _RARE) else []
    if len(fits) == 1:
        fix = Corrections(factors={"time": fits[0]})
        text = f"{said}; {in_words(fits[0], step)}"
        others = tuple(factor / fits[0] for factor in unusual)
        return Clock(fits[0], others, Finding("time unit", "sure", text, fix))
    if not (fits := sorted([*fits, *unusual])):
        return Clock(
            1.0, (), Finding("time unit", "sure", f"{said}; no unit of time makes a rate of it", decided=False)
        )
    middle = fits[len(fits) // 2]
    told = " or ".join(in_words(factor, step) for factor in reversed(fits))
    choices = tuple(Corrections(factors={"time": factor}) for factor in reversed(fits))
    finding = Finding("time unit", "sure", f"{said}; {told}", decided=False, choices=choices)
    return Clock(middle, tuple(factor / middle for factor in fits if factor != middle), finding)


def in_words(factor: float, step: float, read_as: str = SI["time"]) -> str:
    """What stamps with the usual *step* s, read as a unit, are with a *factor*."""
    unit = unit_after("time", factor, {"time": read_as})
    return f"{f'in {unit}' if unit else f'times {factor:g}'} it is {1.0 / (step * factor):.1f} Hz"


def _may_be(step: float, factor: float, unit: str) -> bool:
    """Whether stamps with a *step* s may lack a *factor*, in *unit*, though nobody thought of it: at a rate that is usual."""
    return RATES[0] <= 1.0 / (step * factor) <= (_RARELY if unit == _RARE else RATES[1] / 2)


def of_acc(recording: Recording, found: Blocks, *, constant: bool = False) -> Finding | None:
    """Whether the specific force is in another unit than m/s², or lacks gravity; *constant* is one and the same sample."""
    length = _lengths(recording.acc)
    if len(length) < 2:
        return None
    low, median = (float(v) for v in np.quantile(length, [0.1, 0.5]))
    gravity = recording.gravity
    said = f"the median length of the specific force is {median:.4g}"
    fits = [unit for unit, factor in _ACC.items() if 1 / _NEAR < median * factor / gravity < _NEAR]
    unit = fits[0] if fits else ""
    if unit == "m/s²":
        return None
    if constant and not unit:
        text = f"{said}, the same in every sample: whether that is gravity ({gravity:.4g} m/s²), in what unit, cannot be told"
        return Finding("acc unit", "cannot-tell", text, decided=False)
    if unit and (low > _STEADY * median or _has_gravity(found, gravity / _ACC[unit])):
        fix = Corrections(factors={"acc": _ACC[unit]})
        return Finding("acc unit", "sure", f"{said}, gravity is {gravity:.4g} m/s²: it is in {unit}", fix)
    if median < _FREE * gravity:
        return Finding(
            "acc gravity", "sure",
            f"{said} m/s² and its shortest tenth is below {low:.2g}, gravity alone is {gravity:.4g}: gravity was removed. "
            f"{WANTED}",
            decided=False,
        )  # fmt: skip
    return Finding(
        "acc unit", "likely", f"{said}, which is gravity ({gravity:.4g} m/s²) in no known unit", decided=False
    )


def _has_gravity(found: Blocks, length: float) -> bool:
    """Whether something of that length stands still in the room, whatever the gyroscope's unit and axes."""
    for factor in (1.0, np.pi / 180):
        turns = turning.turns(found.acc, turning.path(found, factor), found.width, length)
        if len(turns.loss) and float(turns.total.min()) < 0.2:
            return True
    return False


def of_mag(recording: Recording) -> Finding | None:
    """What unit the field is likely in, where it is not µT: only its direction counts."""
    length = _lengths(recording.mag)
    length = length[length > 0]
    if not len(length):
        return None
    median = float(np.median(length))
    if _EARTH[0] <= median <= _EARTH[1]:
        return None
    said = f"the median length of the field is {median:.4g}, on Earth it is 25 to 65 µT"
    fits = [unit for unit, factor in _MAG.items() if _EARTH[0] <= median * factor <= _EARTH[1]]
    also = "; only its direction counts"
    if not fits:
        return Finding("mag unit", "note", f"{said}: in no known unit, uncalibrated or near iron{also}", decided=False)
    fix = Corrections(factors={"mag": _MAG[fits[0]]})
    return Finding("mag unit", "note", f"{said}: it would be in {fits[0]}{also}", fix, decided=False)


def _lengths(values: Floats) -> Floats:
    values = values[:: max(1, len(values) // _LOOKED_AT)]
    with np.errstate(over="ignore", invalid="ignore"):
        length = np.sqrt(np.einsum("ij,ij->i", values, values))
    return np.asarray(length[np.isfinite(length)])
