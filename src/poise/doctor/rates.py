"""Rates: in which unit the gyroscope is, and the clock with it, by how gravity and the field turn.

A turn is a rate times a time, and the turning shows the product alone: rates that are a tenth of what they should be, and
a clock ten times too slow, are one and the same. Where the unit of time was guessed both are tried together.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.doctor import turning
from poise.doctor.axes import AGREED, SURE
from poise.doctor.turning import Blocks, Turns

Floats = NDArray[np.float64]

_GYR = (1.0, np.pi / 180, 180 / np.pi, 1e-3, np.pi / 180e3)
_USUAL = 1  # of these: deg/s
USUAL = _GYR[: _USUAL + 1]  # what a file that names no unit is in
_UNSEEN = 0.0076  # of the squared length: 5° between windows
_CLAIMED = 3.0  # times the misfit of deg/s: so much more do rates claim than one of the sensors sees
_EXPLAINED = 0.5  # of the turning that is seen: what leaves less explains it, and its factor is right within a third
_BETWEEN = 10.0 ** (np.arange(-28, 13) / 8)  # factors beside the units: a step leaves a seventh of the turning
_BESIDE = 10.0 ** (np.delete(np.arange(-8, 9), 8) / 8)
_NEAR = 1.04 ** np.arange(-6, 7)  # about a factor that was fitted
_APART = 2.5  # times: what is nearer to a unit is that unit, badly explained
_OFF = np.array([0.94, 1.06])  # by more no gyroscope's scale is off: raw counts of 16.4 a °/s are nearly mrad/s
_LOOKED_AT = 20_000  # blocks are enough for a fit
FASTEST = 100.0  # rad/s: 16 turns a second; an accelerometer 1 mm from the axis would feel more than gravity


class Unit(NamedTuple):
    """What the rates and the stamps may lack."""

    gyr: float
    """factor from the rates to rad/s"""
    time: float = 1.0
    """factor from the stamps to s"""

    @property
    def turn(self) -> float:
        """Factor from rate times time to rad: all that the turning shows."""
        return self.gyr * self.time


AS_IT_IS = Unit(1.0)


class Rates(NamedTuple):
    """The gyroscope's numbers under one factor."""

    factor: float
    acc: Turns
    mag: Turns


class Lengths(NamedTuple):
    """The usual lengths of specific force and field, in the sensors' own units."""

    acc: float
    mag: float


class Judged(NamedTuple):
    """In which unit rates and stamps are."""

    unit: Unit | None
    """the right one; None where it cannot be told"""
    rates: Rates
    """with the right one, or with *factor*, or as they are"""
    before: float = 0.0
    """the loss of the rates as they are; 0 where nothing speaks against them"""
    apart: float = 0.0
    """standard deviations from the rates as they are to what fits best"""
    factor: float | None = None
    """what the turning says that rate times time lacks, where that is no unit"""
    open: tuple[Unit, ...] = ()
    """where it cannot be told: units that nothing speaks against"""


def with_factor(found: Blocks, factor: float, lengths: Lengths) -> Rates:
    """How acc and mag turn with the rates times *factor*."""
    along = turning.path(found, factor)
    return Rates(
        factor,
        turning.turns(found.acc, along, found.width, lengths.acc),
        turning.turns(found.mag, along, found.width, lengths.mag),
    )


def explain(tried: Rates) -> bool:
    """Whether these rates, in some axes, explain the turning, better than none at all by more than chance."""
    gained, spread = 0.0, 0.0
    for turns in (tried.acc, tried.mag):
        votes = turns.votes
        difference = votes[:, 48] - votes[:, int(votes.sum(axis=0)[:48].argmin())] if len(votes) else np.zeros(1)
        gained, spread = gained + float(difference.sum()), spread + float(np.sum(difference**2))
    return bool(gained >= SURE * np.sqrt(max(spread, 1e-12))) and _share(tried) < _EXPLAINED


def judge(
    found: Blocks,
    as_is: Rates,
    lengths: Lengths,
    clocks: Sequence[float] = (),
    *,
    guessed: bool = False,
) -> Judged:
    """In which unit the rates are; *clocks* are other factors that the stamps may lack.

    A unit is right where it explains the turning and no factor beside it does so better; deg/s also where hardly anything
    turns and rates as they are claim much more. Where the unit was *guessed* factors beside the units are looked at, too.
    """
    if explain(as_is):
        return Judged(AS_IT_IS, as_is)
    units = [Unit(gyr) for gyr in _GYR] + [Unit(gyr, time) for time in clocks for gyr in _GYR]
    tried = [as_is, *(with_factor(found, unit.turn, lengths) for unit in units[1:])]
    usable = [i for i, each in enumerate(tried) if _windows(each) == _windows(as_is)]  # else so wild that it breaks off
    units, tried = [units[i] for i in usable], [tried[i] for i in usable]
    losses, still = _votes(tried)
    best = int(np.argmin([float(each.sum()) for each in losses]))
    if best > 1 and tried[best].factor < 1 and not explain(tried[best]):
        best = _USUAL  # of all factors that say "much less" deg/s is the usual one
    chosen, apart = tried[best], _deviations(losses[0], losses[best])
    open_ = tuple(
        unit
        for unit, each, loss in zip(units, tried, losses, strict=True)
        if _deviations(loss, losses[best]) < SURE or _ratio(each, chosen) <= _CLAIMED
    )
    seen, claimed = _deviations(still, losses[best]) >= AGREED, _deviations(losses[0], still) >= SURE
    too_much = best == _USUAL and claimed and _ratio(as_is, chosen) > _CLAIMED
    fits = (seen or too_much) and _share(chosen) < _EXPLAINED
    if best == 0 or apart < SURE or not (fits or (too_much and _seen(chosen) < _UNSEEN)):
        other = _between(found, as_is, lengths, units) if guessed or clocks else None
        return Judged(None, other or as_is, factor=other.factor if other else None, open=open_)
    beside = _BESIDE if best == _USUAL else np.append(_BESIDE, _OFF)
    other = _beside(found, chosen, lengths, chosen.factor * beside)
    if other is not None and not (best == _USUAL and _near(other, units)):
        return Judged(None, other, misfit(as_is), apart, other.factor)
    if any(unit.time != units[best].time and unit.gyr != units[best].gyr for unit in open_ if unit.gyr in USUAL):
        return Judged(None, as_is, misfit(as_is), apart, open=open_)
    return Judged(units[best], chosen, misfit(as_is), apart)


def with_other_clocks(
    others: Mapping[float, Blocks], found: Blocks, as_is: Rates, lengths: Lengths
) -> tuple[Blocks, Judged] | None:
    """The one clock with which rates in rad/s or deg/s explain the turning, by its own blocks; None where none, or several.

    *others* are the blocks by the factor that the stamps may lack. The blocks of a clock that is far off hold many turns.
    """
    fits = [
        (blocks, Judged(Unit(gyr, time), tried, misfit(as_is)))
        for time, blocks in ({1.0: found} | dict(others)).items()
        for gyr in USUAL
        if explain(tried := with_factor(blocks, gyr, lengths))
    ]
    return fits[0] if len(fits) == 1 and fits[0][0] is not found else None


def by_every_clock(judged: Judged, others: Mapping[float, Blocks], as_is: Rates, lengths: Lengths) -> Judged:
    """*judged*, or a choice where it is only that rates claim too much, and with another clock's blocks they do not."""
    unit = judged.unit
    if unit is None or explain(judged.rates):
        return judged
    apart = [time for time, blocks in others.items() if _alone(blocks, lengths) != unit.gyr]
    open_ = (unit, *(Unit(gyr, time) for time in apart for gyr in USUAL))
    return Judged(None, as_is, judged.before, judged.apart, open=open_) if apart else judged


def _alone(found: Blocks, lengths: Lengths) -> float | None:
    """The factor of the gyroscope's unit by *found* alone; None where it cannot be told."""
    judged = judge(found, with_factor(found, 1.0, lengths), lengths)
    return judged.unit.gyr if judged.unit else None


def _between(found: Blocks, as_is: Rates, lengths: Lengths, units: Iterable[Unit]) -> Rates | None:
    """The rates times a factor that explains the turning and is far from that of every one of *units*; None without any."""
    factors = np.concatenate([_BETWEEN, *(fitted * _NEAR for fitted in _fitted(found))])
    other = _beside(found, as_is, lengths, factors)
    return None if other is None or _near(other, units) else other


def _near(other: Rates, units: Iterable[Unit]) -> bool:
    return any(1.0 / _APART < other.factor / unit.turn < _APART for unit in units)


def _beside(found: Blocks, chosen: Rates, lengths: Lengths, factors: Iterable[float]) -> Rates | None:
    """The rates times that of *factors* which explains the turning, and surely better than *chosen*; None without any."""
    tried = _tried(found, chosen, lengths, factors)
    losses, _ = _votes(tried)
    best = int(np.argmin([float(each.sum()) for each in losses]))
    if best == 0 or _deviations(losses[0], losses[best]) < SURE or not explain(tried[best]):
        return None
    near = _tried(found, tried[best], lengths, tried[best].factor * _NEAR)
    losses, _ = _votes(near)
    return near[int(np.argmin([float(each.sum()) for each in losses]))]


def _tried(found: Blocks, first: Rates, lengths: Lengths, factors: Iterable[float]) -> list[Rates]:
    """*first*, and the rates times *factors*, but for those so wild that the turn breaks off."""
    others = (with_factor(found, float(factor), lengths) for factor in factors)
    return [first, *(each for each in others if _windows(each) == _windows(first))]


def _fitted(found: Blocks) -> list[float]:
    """The factors that fit the step of a field from block to block best, v' = −ω × v, in the axes that suit each."""
    factors = []
    rate = (found.gyr[2:] + 2 * found.gyr[1:-1] + found.gyr[:-2]) * (found.width / 2)
    for vector in (found.acc, found.mag):
        v = turning.directions(vector)
        v[~(np.abs(v) <= 1.0)] = np.nan  # of what is too short to have a direction
        step, between = v[2:] - v[:-2], v[1:-1]
        known = np.flatnonzero(np.isfinite(step + between + rate).all(axis=1))
        known = known[:: max(1, len(known) // _LOOKED_AT)]
        claimed = np.cross(between[known], np.einsum("sij,nj->sni", turning.signed_axes()[:24], rate[known]))
        along = np.einsum("sni,ni->s", claimed, step[known])
        power = np.einsum("sni,sni->s", claimed, claimed)
        best = int(np.argmax(along**2 / np.maximum(power, 1e-300)))
        if power[best] > 0.0:
            factors.append(abs(float(along[best] / power[best])))
    return factors


def too_fast(found: Blocks, factor: float) -> bool:
    """Whether a tenth of the recording would turn faster than anything that an accelerometer endures."""
    speed = np.sqrt(np.einsum("ij,ij->i", found.gyr, found.gyr))
    speed = speed[np.isfinite(speed)]
    return bool(len(speed)) and float(np.quantile(speed, 0.9)) * factor > FASTEST


def turned(found: Blocks) -> tuple[float, float]:
    """How far the sensor turned in all, and how fast at most, in the unit of the rates and in it times s; 0 without any."""
    rate = found.gyr - turning.bias(found)
    speed = np.sqrt(np.einsum("ij,ij->i", rate, rate))
    speed = speed[np.isfinite(speed)]
    return (float(speed.sum()) * found.width, float(speed.max())) if len(speed) else (0.0, 0.0)


def _windows(tried: Rates) -> tuple[int, int]:
    return len(tried.acc.loss), len(tried.mag.loss)


def misfit(tried: Rates) -> float:
    """The loss that is left in the axes that fit best, the mean of the sensors."""
    return float(np.mean([t.total.min() for t in (tried.acc, tried.mag) if len(t.loss)]))


def _share(tried: Rates) -> float:
    """What is left of the turning that is seen: the smaller share of the two sensors."""
    shares = [float(t.total.min() / max(t.still_total, 1e-9)) for t in (tried.acc, tried.mag) if len(t.loss)]
    return min(shares, default=1.0)


def _seen(tried: Rates) -> float:
    """The turning that is seen, whatever the rates: the smaller of the two sensors'."""
    return min((t.still_total for t in (tried.acc, tried.mag) if len(t.loss)), default=0.0)


def _ratio(worse: Rates, better: Rates) -> float:
    """How many times larger the misfit of *worse* is, with the sensor that sees it best."""
    both = ((worse.acc, better.acc), (worse.mag, better.mag))
    return max((float(w.total.min() / max(b.total.min(), turning.FLOOR)) for w, b in both if len(w.loss)), default=0.0)


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
