"""Units: which factor makes the numbers of a sensor, or of the clock, what physics allows."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.corrections import Corrections
from poise.data.recording import STANDARD_GRAVITY, Recording
from poise.data.stamps import rising_steps, usual_step
from poise.doctor import turning
from poise.doctor.axes import AGREED, SURE
from poise.doctor.findings import Finding, unit_after
from poise.doctor.turning import Blocks, Turns
from poise.formats.evidence import RATES

Floats = NDArray[np.float64]

_TIMES = (1e-3, 1e-6, 1e-9, 1e3, 1e6)
_ACC = {"g": STANDARD_GRAVITY, "mg": STANDARD_GRAVITY * 1e-3, "m/s²": 1.0}
_GYR = (np.pi / 180, 180 / np.pi, 1e-3, np.pi / 180e3)
_NEAR = 1.5  # a median length within this factor of gravity is gravity
_STEADY = 0.55  # of the median: the shortest tenth of any motion's force with gravity in it, but for violent ones
_CLAIMED = 3.0  # times the misfit of deg/s: so much more do rates claim than one of the sensors sees
_FREE = 0.3  # of gravity: no accelerometer on Earth shows less by its median
_EARTH = (15.0, 90.0)  # µT, with some iron about
_MAG = {"G": 100.0, "mG": 0.1, "nT": 1e-3, "mT": 1e3, "T": 1e6}
_LOOKED_AT = 50_000  # lengths are enough for a median


def of_time(recording: Recording) -> Finding | None:
    """Whether the stamps are in another unit than s."""
    if len(rising_steps(recording.time)) < 2:
        return None
    step = usual_step(recording.time)
    if RATES[0] / 10 <= 1.0 / step <= 5 * RATES[1]:
        return None
    fits = [factor for factor in _TIMES if RATES[0] <= 1.0 / (step * factor) <= RATES[1]]
    said = f"the usual step between stamps is {step:.4g} s, {1.0 / step:.4g} samples per second, which no gyroscope has"
    if len(fits) != 1:
        return Finding("time unit", "sure", f"{said}; no unit of time makes a rate of it", decided=False)
    fix = Corrections(factors={"time": fits[0]})
    unit = unit_after("time", fits[0])
    taken = f"in {unit}" if unit else f"times {fits[0]:g}"
    return Finding("time unit", "sure", f"{said}; {taken} it is {1.0 / (step * fits[0]):.1f} Hz", fix)


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
            "An attitude needs the accelerometer's own samples (specific force): export the raw or total acceleration",
            decided=False,
        )  # fmt: skip
    return Finding(
        "acc unit", "likely", f"{said}, which is gravity ({gravity:.4g} m/s²) in no known unit", decided=False
    )


def _has_gravity(found: Blocks, length: float) -> bool:
    """Whether something of that length stands still in the room, whatever the gyroscope's unit and axes."""
    for factor in (1.0, *_GYR[:1]):
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


class Rates(NamedTuple):
    """The gyroscope's numbers under one factor."""

    factor: float
    acc: Turns
    mag: Turns


def rates(found: Blocks, factor: float, acc_length: float, mag_length: float) -> Rates:
    """How acc and mag turn with the rates times *factor*."""
    along = turning.path(found, factor)
    return Rates(
        factor,
        turning.turns(found.acc, along, found.width, acc_length),
        turning.turns(found.mag, along, found.width, mag_length),
    )


def explains(tried: Rates) -> bool:
    """Whether these rates, in some axes, explain the turning better than none at all, by more than chance."""
    gained, spread = 0.0, 0.0
    for turns in (tried.acc, tried.mag):
        votes = turns.votes
        difference = votes[:, 48] - votes[:, int(votes.sum(axis=0)[:48].argmin())] if len(votes) else np.zeros(1)
        gained, spread = gained + float(difference.sum()), spread + float(np.sum(difference**2))
    return bool(gained >= SURE * np.sqrt(max(spread, 1e-12)))


def of_gyr(found: Blocks, as_is: Rates, acc_length: float, mag_length: float) -> tuple[Finding | None, Rates]:
    """Whether the rates are in another unit than rad/s, and the turns with the right one."""
    if explains(as_is) and _share(as_is) < 0.5:
        return None, as_is
    tried = [as_is, *(rates(found, factor, acc_length, mag_length) for factor in _GYR)]
    losses, still = _votes(tried)
    totals = [float(each.sum()) for each in losses]
    best = int(np.argmin(totals))
    if best > 1 and tried[best].factor < 1 and _deviations(still, losses[best]) < SURE:
        best = 1  # where hardly anything turns, of all factors that say "much less" deg/s is the usual one
    if best == 0 or _deviations(losses[0], losses[best]) < SURE:
        return None, as_is
    seen, claimed = _deviations(still, losses[best]), _deviations(losses[0], still)
    chosen, apart = tried[best], _deviations(losses[0], losses[best])
    nothing_turns = best == 1 and claimed >= SURE and _ratio(as_is, chosen) > _CLAIMED
    if seen < AGREED and not nothing_turns:
        return None, as_is
    unit = unit_after("gyr", chosen.factor)
    what = f"it is in {unit}" if unit else f"its numbers must be multiplied by {chosen.factor:.4g}"
    sentence = (
        f"the turns that it claims are not those of gravity and the field: their loss is {_mean(as_is):.3g} as they are, "
        f"{_mean(chosen):.3g} times {chosen.factor:.4g} ({apart:.1f} standard deviations): {what}"
    )
    return Finding("gyr unit", "sure", sentence, Corrections(factors={"gyr": chosen.factor})), chosen


def _share(tried: Rates) -> float:
    """What is left of the turning that is seen: the smaller share of the two sensors."""
    shares = [float(t.total.min() / max(t.still_total, 1e-9)) for t in (tried.acc, tried.mag) if len(t.loss)]
    return min(shares, default=1.0)


def _ratio(worse: Rates, better: Rates) -> float:
    """How many times larger the misfit of *worse* is, with the sensor that sees it best."""
    both = ((worse.acc, better.acc), (worse.mag, better.mag))
    return max((float(w.total.min() / max(b.total.min(), turning.FLOOR)) for w, b in both if len(w.loss)), default=0.0)


def _mean(tried: Rates) -> float:
    return float(np.mean([t.total.min() for t in (tried.acc, tried.mag) if len(t.loss)]))


def _votes(tried: list[Rates]) -> tuple[list[Floats], Floats]:
    """(windows,) the votes for every factor, in the axes that suit it best, and for a gyroscope that says nothing."""
    found: list[list[Floats]] = [[] for _ in tried]
    silent: list[Floats] = []
    for turns in zip(*((one.acc, one.mag) for one in tried), strict=True):
        if not len(turns[0].loss):
            continue
        floor = turning.FLOOR + min(float(np.median(t.loss.min(axis=1))) for t in turns)
        for votes, t in zip(found, turns, strict=True):
            loss = np.log(floor + t.loss)
            votes.append(loss[:, int(loss.sum(axis=0).argmin())])
        silent.append(np.log(floor + turns[0].still))
    return [np.concatenate(each) if each else np.empty(0) for each in found], np.concatenate(silent or [np.empty(0)])


def _deviations(worse: Floats, better: Floats) -> float:
    difference = worse - better
    return float(difference.sum() / np.sqrt(max(float(np.sum(difference**2)), 1e-12)))


def _lengths(values: Floats) -> Floats:
    values = values[:: max(1, len(values) // _LOOKED_AT)]
    with np.errstate(over="ignore", invalid="ignore"):
        length = np.sqrt(np.einsum("ij,ij->i", values, values))
    return np.asarray(length[np.isfinite(length)])
