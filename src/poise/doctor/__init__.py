"""The doctor: what is wrong with a recording, by physics, from the recording alone, and what repairs it."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np

from poise.data.corrections import Corrections
from poise.data.recording import Recording
from poise.data.stamps import packed
from poise.doctor import axes, exchange, gravity, offsets, rate_units, samples, timing, turning, units
from poise.doctor.axes import Hemisphere
from poise.doctor.findings import RANK, Diagnosis, Evidence, Finding
from poise.doctor.rate_units import Context
from poise.doctor.rates import Lengths, Rates, by_every_clock, explain, judge, with_factor, with_other_clocks
from poise.errors import RecordingError
from poise.estimators.guard import unpacked
from poise.formats.units import SI

__all__ = ["Corrections", "Diagnosis", "Finding", "Hemisphere", "diagnose"]

_LARGEST = 1e12  # no sensor's number, in any unit
_FEWEST = 10  # blocks that hold force and field, to speak of the angle between them
_SENSORS = {"gyr": "gyroscope", "acc": "accelerometer", "mag": "magnetometer"}


def diagnose(
    recording: Recording,
    *,
    hemisphere: Hemisphere = "north",
    thorough: bool = True,
    read_as: dict[str, str] | None = None,
    guessed: Collection[str] = (),
) -> Diagnosis:
    """What is wrong with *recording*: units, axes, signs, delays, stamps, samples; with what repairs it.

    Gravity and the magnetic field stand still in the room, so the gyroscope must explain how they turn in the body.
    *hemisphere* says where the field points: its dip gives the sign of acc and mag. Without *thorough* only units and
    axes are judged. *read_as* names the units that a file's numbers were taken for, so that options can name the right
    ones; which of "time" and "gyr" were *guessed* for that, so that nobody is believed who did not say it.
    """
    given, (recording, wild) = recording, _bounded(recording)
    if hemisphere not in ("north", "south"):
        raise RecordingError(f"hemisphere: expected 'north' or 'south', found {hemisphere!r}")
    dead = [name for name in _SENSORS if samples.constant(getattr(recording, name))]
    found, evidence = _of_units_and_axes(recording, hemisphere, dead, read_as or {}, guessed)
    if thorough:
        found += wild
        fixed = Diagnosis(recording, tuple(found)).repairs.apply(recording)
        found += timing.findings(fixed)
        in_packets = packed(fixed.time) is not None
        fixed = fixed.with_samples(time=unpacked(fixed.time))
        found += samples.findings(fixed)
        if any(f.choices for f in found):  # rates of unknown size: whether it rests is not known, nor what is late
            found = [f for f in found if f.name != "rest"]
        elif not any(f.severity == "sure" and not f.decided for f in found):
            late = offsets.findings(_without(fixed, dead))
            # The stamps of packets are too coarse for a delay to be taken out
            found += [replace(f, fix=Corrections()) for f in late] if in_packets else late
    order = {severity: i for i, severity in enumerate(RANK)}
    found.sort(key=lambda f: order[f.severity])
    return Diagnosis(given, tuple(found), evidence, dict(read_as or {}))


def _bounded(recording: Recording) -> tuple[Recording, list[Finding]]:
    """*recording* with what is not finite, or so large that its square is not, as missing; and what to say of that."""
    bounded, found = {}, []
    for sensor in _SENSORS:
        values = getattr(recording, sensor)
        with np.errstate(invalid="ignore"):
            wild = ~(np.abs(values) < _LARGEST) & ~np.isnan(values)
        if wild.any():
            bounded[sensor] = np.where(wild.any(axis=1)[:, None], np.nan, values)  # what is left of a row is no vector
            rows = int(wild.any(axis=1).sum())
            text = f"{rows} of {len(values)} samples of {sensor} are infinite or beyond {_LARGEST:g}: taken for missing"
            found.append(Finding(f"{sensor} samples", "likely", text))
    return (recording.with_samples(**bounded) if bounded else recording), found


def _without(recording: Recording, dead: list[str]) -> Recording:
    """*recording* as if the sensors *dead* were absent: one and the same sample says nothing of how anything turns."""
    return recording.with_samples(**{name: np.full_like(getattr(recording, name), np.nan) for name in dead})


def _of_units_and_axes(
    recording: Recording,
    hemisphere: Hemisphere,
    dead: list[str],
    read_as: Mapping[str, str],
    guessed: Collection[str],
) -> tuple[list[Finding], Evidence | None]:
    if instant := _instant(recording):
        return [instant], None
    clock = units.of_time(recording, read_as.get("time", SI["time"]), guessed="time" in guessed)
    if empty := _empty(recording):
        return [empty, *([clock.finding] if clock.finding else [])], None
    alive = _without(recording, dead)
    blocks = turning.blocks(alive, unpacked(recording.time * clock.factor))
    of_acc = units.of_acc(recording, blocks, constant="acc" in dead)
    length = _usual(blocks.acc)
    if of_acc is None or "acc" in of_acc.fix.factors:
        length = recording.gravity / (of_acc.fix.factors["acc"] if of_acc else 1.0)
    lengths = Lengths(length, _usual(blocks.mag))
    as_is = with_factor(blocks, 1.0, lengths)
    if swapped := exchange.exchanged(blocks, as_is, lengths.mag, read_as):
        return [swapped, *([clock.finding] if clock.finding else [])], None
    known = of_acc is None or bool(of_acc.fix)
    of_acc = gravity.removed(blocks, as_is, length, known=known, clocks=clock.others) or of_acc
    found = [f for f in (of_acc, units.of_mag(recording)) if f]
    free = of_acc is not None and of_acc.name == "acc gravity"
    if free:
        alive = _without(alive, ["acc"])
        blocks, as_is = blocks._replace(acc=np.full_like(blocks.acc, np.nan)), as_is._replace(acc=turning.NO_TURNS)
    others = {
        time: turning.blocks(alive, unpacked(recording.time * clock.factor * time))
        for time in (() if explain(as_is) else clock.others)
    }
    if others and (clocked := with_other_clocks(others, blocks, as_is, lengths)):
        blocks, judged = clocked
    else:
        judged = judge(blocks, as_is, lengths, clock.others, guessed="gyr" in guessed or clock.counts)
        judged = by_every_clock(judged, others, as_is, lengths)
    told = rate_units.findings(judged, Context(alive, blocks, clock, read_as, guessed, length))
    tried = judged.rates
    if judged.unit is not None and judged.unit.time in others:
        blocks = others[judged.unit.time]
        tried = with_factor(blocks, judged.unit.gyr, lengths)
    verdict = axes.judge(tried.acc, tried.mag)
    if judged.unit is None and (clock.others or "gyr" in guessed):  # another unit would show other axes
        verdict = verdict._replace(sure=False, wrong=False, agreed=False)
    found += [*told, *_of_axes(verdict, tried, blocks, alive, hemisphere, dead)]
    return found, Evidence(tried.acc, tried.mag, verdict)


def _instant(recording: Recording) -> Finding | None:
    """One row with samples: an attitude, but nothing turns that would show whether it is right."""
    if len(recording) != 1 or not (np.isfinite(recording.gyr).all() and _felt(recording)):
        return None
    text = (
        "1 row: an attitude if the sensor rests there, and nothing more; units, axes and stamps cannot be told, record 30 s "
        "in which it turns about all three axes"
    )
    return Finding("samples", "cannot-tell", text, decided=False)


def _felt(recording: Recording) -> bool:
    """Whether the accelerometer has a sample that is not zero."""
    given = recording.acc[np.isfinite(recording.acc).all(axis=1)]
    return bool(given.any())


def _empty(recording: Recording) -> Finding | None:
    """The recording is none: no rows, or a gyroscope or accelerometer without samples."""
    what = ""
    whole = {sensor: np.isfinite(getattr(recording, sensor)).all(axis=1) for sensor in ("gyr", "acc")}
    if not len(recording):
        what = "0 rows"
    elif absent := [_SENSORS[sensor] for sensor, known in whole.items() if not known.any()]:
        what = f"no usable sample of the {' and the '.join(absent)}"
    elif not _felt(recording):
        what = "every sample of the accelerometer is zero"
    elif not (np.diff(recording.time[np.isfinite(recording.time)]) > 0).any():
        what = "no time stamp rises above the one before"
    return Finding("samples", "sure", f"{what}: nothing to estimate an attitude from", decided=False) if what else None


def _of_axes(
    verdict: axes.Verdict,
    rates: Rates,
    blocks: turning.Blocks,
    recording: Recording,
    hemisphere: Hemisphere,
    dead: list[str],
) -> list[Finding]:
    figures = f"{verdict.against:.1f} standard deviations over {max(len(rates.acc.loss), len(rates.mag.loss))} windows"
    if verdict.wrong:
        return [_wrong(verdict, rates, blocks, hemisphere, figures)]
    found = []
    if not verdict.agreed:
        found.append(Finding("axes", "cannot-tell", _why_not(verdict, rates, dead), decided=False))
    cosine = float(np.trace(turning.mean_cosines(blocks.acc, blocks.mag)))
    together = np.flatnonzero(np.isfinite(blocks.acc).all(axis=1) & np.isfinite(blocks.mag).all(axis=1))
    if not recording.has_mag:
        without = "while mag gives one and the same sample" if "mag" in dead else "without a magnetometer"
        text = f"{without} the sign of the accelerometer cannot be told: specific force is +g along up at rest"
        found.append(Finding("acc sign", "note", text))
    elif len(together) >= _FEWEST and axes.opposed(cosine, hemisphere):
        away = "up" if hemisphere == "north" else "down"
        text = (
            f"the field points {away} (dip {_dip(cosine):+.0f}°), which it does not in the {hemisphere}ern hemisphere: acc "
            "has the other sign (the acceleration of gravity, not specific force), or mag has, or this is the other "
            "hemisphere (--hemisphere)"
        )
        found.append(Finding("acc sign", "likely", text, Corrections(axes={"acc": "-x -y -z"}), decided=False))
    return found


def _wrong(
    verdict: axes.Verdict, rates: Rates, blocks: turning.Blocks, hemisphere: Hemisphere, figures: str
) -> Finding:
    answer = verdict.answer
    clear = f"({figures}, {verdict.better:.0f} times the misfit)"
    if not verdict.sure:
        text = f"the axes of the sensors do not fit each other {clear}, but the motion does not tell which are wrong"
        return Finding("axes", "sure", f"{text}: {_why(verdict)}", decided=False)
    if answer.sensor == "both":
        told = ", ".join(
            f'{name} as "{axes.words(turning.signed_axes()[i].T)}"'
            for name, i in (("acc", answer.acc), ("mag", answer.mag))
        )
        text = f"the axes of acc, mag and gyr all differ from each other {clear}"
        fixes = axes.both_fixes(verdict, blocks.acc, blocks.mag, hemisphere)
        if fixes is None:
            return Finding("axes", "sure", f"{text}: {told} would fit, each up to its sign", decided=False)
        named = {sensor: axes.words(matrix) for sensor, matrix in fixes.axes.items()}
        fitting = " and ".join(f'{sensor} as "{words}"' for sensor, words in named.items())
        text += (
            f": {fitting} fit; the signs by the dip of {_dip(fixes.cosine):+.0f}°, {hemisphere}ern hemisphere assumed, "
        )
        text += "but acc and mag may both have the other sign: lay the sensor level, face up: acc z is then +g"
        return Finding("axes", "sure", text, Corrections(axes=named), decided=False)
    fix = axes.fix(answer, blocks.acc, blocks.mag, hemisphere)
    correction = Corrections(axes={answer.sensor: axes.words(fix.matrix)})
    name = f"{answer.sensor} axes"
    if not (len(rates.acc.loss) and len(rates.mag.loss)):
        one, other = (
            ("acc", "a magnetometer") if len(rates.acc.loss) else ("mag", "an accelerometer that feels gravity")
        )
        text = (
            f"the axes of {one} and gyr do not fit each other {clear}; without {other} it cannot be told which of the "
            f'two is wrong: gyr as "{axes.words(fix.matrix)}" fits, and so do other axes of {one}'
        )
        return Finding("axes", "sure", text, correction, decided=False)
    text = f"the {_SENSORS[answer.sensor]}'s axes do not fit the others' {clear}; \"{axes.words(fix.matrix)}\" of its own do"
    if answer.sensor != "gyr" and fix.decided:
        trusted = "acc taken for specific force" if answer.sensor == "mag" else "mag's sign taken for right"
        text += f"; the sign by the dip of {_dip(fix.cosine):+.0f}°, {hemisphere}ern hemisphere assumed and {trusted}"
    doubt = _doubt(answer, fix, verdict, hemisphere)
    return Finding(name, "sure", text + (f"; but {doubt}" if doubt else ""), correction, decided=not doubt)


def _doubt(answer: axes.Answer, fix: axes.Fix, verdict: axes.Verdict, hemisphere: Hemisphere) -> str:
    """Why *fix* of one sensor may not be what is wrong, although it fits; empty where it is beyond doubt."""
    if verdict.apart < axes.SURE:
        return (
            "acc and mag do not both say so by themselves, as far as they turn "
            f"({max(verdict.apart, 0.0):.1f} standard deviations): another sensor may be wrong, too"
        )
    if not fix.decided and axes.opposed(fix.cosine, hemisphere):
        other = "south" if hemisphere == "north" else "north"
        return (
            f"the field then points {'up' if hemisphere == 'north' else 'down'} (dip {_dip(fix.cosine):+.0f}°): acc or mag has "
            f"the other sign, too, or this is the other hemisphere (--hemisphere {other})"
        )
    if not fix.decided:
        what = "the signs of acc and mag" if answer.sensor == "gyr" else "its sign"
        return f"{what} cannot be told, the dip is too small ({_dip(fix.cosine):+.0f}°)"
    if fix.otherwise is not None:
        up = "xyz"[int(np.argmin(np.diag(fix.otherwise)))]
        return (
            f'acc and mag, both as "{axes.words(fix.otherwise)}", fit as well: turn {up} up; if acc {up} is then +g, it is the '
            "gyroscope"
        )
    return ""


def _why_not(verdict: axes.Verdict, rates: Rates, dead: list[str]) -> str:
    windows = max(len(rates.acc.loss), len(rates.mag.loss))
    if "gyr" in dead or (not windows and dead):
        return f"axes cannot be told: {samples.silence(dead)}"
    if not windows:
        return (
            "axes cannot be told: no two windows of 2 s hold gyroscope, accelerometer or magnetometer without a break"
        )
    seen = {
        name: np.degrees(np.sqrt(turns.still_total))
        for name, turns in (("gravity", rates.acc), ("the field", rates.mag))
        if len(turns.loss)
    }
    turned = " and ".join(f"{name} by {angle:.1f}°" for name, angle in seen.items())
    return (
        f"axes cannot be told: in {windows} windows of 2 s {turned} RMS is all that turns or shakes, and {_why(verdict)}; "
        "turn the sensor slowly about all three axes for 30 s"
    )


def _why(verdict: axes.Verdict) -> str:
    other = verdict.rival if verdict.answer.sensor == "" else verdict.answer
    if other.sensor in ("", "both"):
        return "several answers fit alike"
    matrix = turning.signed_axes()[other.acc or other.mag]
    matrix = matrix if other.sensor == "gyr" else matrix.T
    apart = verdict.margin if verdict.answer.sensor == "" else verdict.against
    return f'{other.sensor} as "{axes.words(matrix)}" fits about as well ({apart:.1f} standard deviations apart)'


def _dip(cosine: float) -> float:
    """Degrees below the horizon, from the cosine between force and field."""
    return float(-np.degrees(np.arcsin(np.clip(cosine, -1.0, 1.0))))


def _usual(vector: turning.Floats) -> float:
    """The usual length of a sensor's block means; NaN without any."""
    length = np.sqrt(np.einsum("ij,ij->i", vector, vector))
    length = length[np.isfinite(length) & (length > 0)]
    return float(np.median(length)) if len(length) else float("nan")
