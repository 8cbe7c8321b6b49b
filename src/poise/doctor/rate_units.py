"""What is said of the units of gyroscope and clock, from how :mod:`poise.doctor.rates` judges them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.corrections import Corrections
from poise.data.recording import Recording
from poise.data.stamps import usual_step
from poise.doctor import rates, units
from poise.doctor.findings import Finding, unit_after
from poise.doctor.rates import AS_IT_IS, USUAL, Judged, Unit
from poise.doctor.turning import Blocks
from poise.formats.units import SI

Floats = NDArray[np.float64]

_DEGREE = np.pi / 180
_COUNTS = "The stamps rise by one from row to row, so they may count rows: say --rate HZ"
_STEADY = 1.5  # of gravity: an accelerometer that goes round feels more


class Context(NamedTuple):
    """What a verdict on rates needs to know of the recording."""

    recording: Recording
    blocks: Blocks
    clock: units.Clock
    read_as: Mapping[str, str]
    """units that the file's numbers were taken for, by sensor"""
    guessed: Collection[str]
    """of these, the ones that nobody named"""
    gravity: float
    """in the accelerometer's own unit"""


def findings(judged: Judged, about: Context) -> list[Finding]:
    """What there is to say of the units of time and gyr."""
    clock = about.clock
    of_time = [clock.finding] if clock.finding else []
    if judged.factor is not None:
        return [*of_time, _no_unit(judged, about)]
    if judged.unit is None:
        return [*of_time, *_open(judged, about)]
    if judged.unit.time != 1.0 or (clock.finding and not clock.finding.decided):
        of_time = [_of_time(clock.factor * judged.unit.time, judged.unit, about)]
    if judged.unit.gyr == 1.0:
        return of_time
    return [*of_time, _of_gyr(judged, judged.unit, _whole(about.recording.gyr))]


def _of_time(factor: float, unit: Unit, about: Context) -> Finding:
    step, read_as = usual_step(about.recording.time), about.read_as.get("time", SI["time"])
    rate = "as they are" if unit.gyr == 1.0 else f"in {unit_after('gyr', unit.gyr)}"
    times = f"{max(factor, 1.0 / factor):.3g} times too"
    text = (
        f"the usual step between stamps is {step:.4g} s, {1.0 / step:.4g} samples per second, with which the gyroscope's rates "
        f"{rate} turn {times} {'much' if factor < 1.0 else 'little'} for gravity and the field: the clock is too "
        f"{'slow' if factor < 1.0 else 'fast'}; {units.in_words(factor, step, read_as)}, and they fit"
    )
    return Finding("time unit", "sure", text, Corrections(factors={"time": factor}))


def _of_gyr(judged: Judged, unit: Unit, whole: bool) -> Finding:
    named = unit_after("gyr", unit.gyr)
    counts = whole and unit.gyr not in USUAL
    what = f"it is in {named}" if named else f"its numbers must be multiplied by {unit.gyr:.4g}"
    what += ", or raw counts of about that size, since all of them are whole" if counts else ""
    sentence = (
        f"the turns that it claims are not those of gravity and the field: their loss is {judged.before:.3g} as they are, "
        f"{rates.misfit(judged.rates):.3g} times {unit.turn:.4g} ({judged.apart:.1f} standard deviations): {what}"
    )
    return Finding("gyr unit", "sure", sentence, Corrections(factors={"gyr": unit.gyr}), decided=not counts)


def _whole(values: Floats) -> bool:
    """Whether all of *values* (n, 3) are whole numbers, as those of a converter are."""
    return np.array_equal(values, np.round(values), equal_nan=True)


def _no_unit(judged: Judged, about: Context) -> Finding:
    """The turning gives a factor that neither a unit of rates nor one of time has."""
    factor = judged.factor or 1.0
    text = (
        f"gravity and the field turn about {factor:.2g} times as much as rates and stamps say (with that factor their loss is "
        f"{rates.misfit(judged.rates):.3g}), which is no unit: "
    )
    if "time" not in about.guessed:
        return Finding("gyr unit", "sure", f"{text}the gyroscope's numbers may be raw counts", decided=False)
    hz = 1.0 / (usual_step(about.recording.time) * about.clock.factor)
    told = " and ".join(
        f"about {_about(hz * gyr / factor)} Hz if the rates are in {unit_after('gyr', gyr)}" for gyr in reversed(USUAL)
    )
    text += f"the stamps, taken for {hz:.4g} Hz, would be those of {told}"
    text += f". {_COUNTS}" if about.clock.counts else ""
    return Finding("time or gyr unit", "sure", text, decided=False)


def _about(value: float, digits: int = 2) -> str:
    """*value* to so many digits, without an exponent."""
    return f"{float(f'{value:.{digits}g}'):g}"


def _open(judged: Judged, about: Context) -> list[Finding]:
    """No unit explains the turning: what speaks for one even so, or which there are to choose from."""
    alike = [unit for unit in judged.open if unit.gyr in USUAL]
    if "gyr" not in about.guessed and (judged.before == 0.0 or AS_IT_IS in alike):
        return []
    if "gyr" in about.guessed and (why := _too_fast(about)):
        why += f". {_COUNTS}" if about.clock.counts else ""
        return [Finding("gyr unit", "sure", why, Corrections(factors={"gyr": _DEGREE}), decided=not about.clock.counts)]
    if judged.before == 0.0 or AS_IT_IS in alike:
        alike = [Unit(gyr) for gyr in USUAL]
    choices = tuple(_correction(unit, about.clock.factor) for unit in alike)
    turn, most = rates.turned(about.blocks)
    told = "; ".join(
        f"{_words(unit, about)} it turned {np.degrees(turn * unit.turn):.0f}° in all, and by "
        f"{_about(np.degrees(most * unit.gyr), 3)} °/s at most"
        for unit in alike
    )
    if judged.before == 0.0 or "gyr" in about.guessed:
        text = f"rad/s or deg/s cannot be told: gravity and the field turn too little, or not as either says; {told}"
        return [Finding("gyr unit", "cannot-tell", text, decided=False, choices=choices)]
    text = f"the gyroscope claims turns that gravity and the field do not show ({judged.apart:.1f} standard deviations); {told}"
    return [Finding("time or gyr unit", "sure", text, decided=False, choices=choices)]


def _correction(unit: Unit, clock: float) -> Corrections:
    time = {} if unit.time == 1.0 else {"time": clock * unit.time}
    return Corrections(factors={"gyr": unit.gyr} | time)


def _words(unit: Unit, about: Context) -> str:
    words = f"in {unit_after('gyr', unit.gyr)}"
    if unit.time == 1.0:
        return words
    factor = about.clock.factor * unit.time
    stamps = unit_after("time", factor, about.read_as) or f"{1.0 / factor:g} s"
    return f"{words} with stamps in {stamps}"


def _too_fast(about: Context) -> str:
    """Why the rates cannot be in rad/s but must be in deg/s, whatever turns; empty where they can."""
    gyr, acc = about.recording.gyr, about.blocks.acc
    length = np.sqrt(np.einsum("ij,ij->i", acc, acc))
    calm = float(np.nanquantile(length, 0.9)) < _STEADY * about.gravity if np.isfinite(length).any() else False
    if _whole(gyr) or not calm or not rates.too_fast(about.blocks, 1.0) or rates.too_fast(about.blocks, _DEGREE):
        return ""
    return (
        f"a tenth of its rates is above {rates.FASTEST:g}: {rates.FASTEST:g} rad/s are 16 turns a second, and the "
        "accelerometer, which feels gravity and little besides, would have to lie within 1 mm of the axis: it is in deg/s"
    )
