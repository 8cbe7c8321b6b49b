"""From a table as the file has it to a recording in SI units, and the account of how each unit was found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from poise.data.attitude import Attitude
from poise.data.recording import Recording
from poise.errors import FormatError
from poise.formats import evidence, units
from poise.formats.attitudes import reference
from poise.formats.evidence import Verdict
from poise.formats.held import fresh
from poise.formats.limits import Options
from poise.formats.names import QUAT as QUAT_NAMES
from poise.formats.names import SENSORS
from poise.formats.table import Floats, Table

_FREE = 3.0  # m/s²: no accelerometer on Earth shows less by its median


@dataclass(frozen=True)
class SensorFacts:
    """One sensor of a file (or its clock): the unit it is in, how that was found, and how many rows hold a sample."""

    unit: str
    how: str
    samples: int


@dataclass(frozen=True)
class Sniffed:
    """What was recognised in a file."""

    path: str
    format: str
    rows: int
    rate_hz: float
    duration: float
    """s"""
    gaps: tuple[int, float]
    """how many steps are longer than three usual ones, and the longest of them, s"""
    sensors: Mapping[str, SensorFacts]
    """by name: time, gyr, acc, mag"""
    columns: Mapping[str, str]
    """ours (gyr_x, …) to the file's"""
    notes: tuple[str, ...]
    doubts: tuple[str, ...]


def assemble(path: Path, table: Table, options: Options, source: str, digest: str) -> tuple[Recording, Sniffed]:
    """The recording of a *table* (which is emptied) and what was recognised on the way.

    Raises :class:`FormatError` where a unit cannot be told, or contradicts the samples by more than a factor of five.
    """
    where = source
    for sensor, unit in options.units.items():
        if sensor not in units.FACTORS:
            raise FormatError(f"{where}: --units {sensor}={unit}: expected one of {', '.join(units.FACTORS)}")
    values: dict[str, Any] = {sensor: _stack(table, [f"{sensor}_{axis}" for axis in "xyz"]) for sensor in SENSORS}
    quat = _stack(table, [f"truth_{name}" for name in QUAT_NAMES])
    rows = len(values["gyr"])
    table.columns.setdefault("time", np.empty(0))
    sensors: dict[str, SensorFacts] = {}
    values["time"], sensors["time"] = _time(where, table, options, rows)
    for sensor in ("acc", "mag", "gyr"):
        if values[sensor] is not None:
            values[sensor], sensors[sensor] = _scale(where, sensor, values, table, options)
    values |= {key: table.columns.pop(key) for key in ("acc_age", "mag_age") if key in table.columns}
    if "moving" in table.columns:
        values["moving"] = np.nan_to_num(table.columns.pop("moving")) != 0
    if quat is not None:
        values["truth"] = _truth(values["time"], quat, table.facts)
    _say(values, sensors, table)
    if gravity := table.facts.get("poise.gravity"):
        values["gravity"] = _gravity(where, gravity)
    said = (*table.notes, *table.doubts)
    facts: dict[str, Any] = {"name": path.stem, "source": source, "source_hash": digest, "notes": said}
    if options.as_is:  # stamps in another unit, too: a recording would refuse them
        stamps = values.pop("time")
        recording = Recording(time=np.arange(rows) / 100.0, **values, **facts).with_samples(time=stamps)
    else:
        recording = Recording(**values, **facts)
    return recording, _sniffed(recording, table, sensors)


def _stack(table: Table, keys: list[str]) -> Floats | None:
    if keys[0] not in table.columns:
        return None
    stacked = np.empty((len(table.columns[keys[0]]), len(keys)))
    for i, key in enumerate(keys):
        stacked[:, i] = table.columns.pop(key)
    return stacked


def _time(where: str, table: Table, options: Options, rows: int) -> tuple[Floats, SensorFacts]:
    stamps = table.columns.pop("time")
    rate = table.rate if options.rate is None and not len(stamps) else options.rate
    if rate is not None:
        if not (np.isfinite(rate) and rate > 0):
            raise FormatError(f"{where}: a rate of {rate} samples per second; expected a number above 0 (--rate HZ)")
        if len(stamps):
            table.notes.append(f"time: the file's own stamps are ignored for the given rate of {rate:g} Hz")
        return np.arange(rows) / rate, SensorFacts("s", f"from the rate of {rate:g} Hz", rows)
    stated, how = _stated(where, "time", table, options)
    verdict = evidence.of_time(stamps)
    if not stated and not verdict.unit and len(stamps) > 1 and not options.as_is:
        raise FormatError(
            f"{where}: unit of time not named, and {verdict.sentence}; say it: --units time=s (or ms, us, ns, 100us)"
        )
    unit = stated or verdict.unit or "s"
    if stated and not table.own and np.isfinite(verdict.size) and not options.as_is:
        hz = units.FACTORS["time"][unit] / verdict.size
        if not evidence.RATES[0] / 10 <= hz <= evidence.RATES[1] * 5:
            fix = f"; say --units time={verdict.unit}" if verdict.unit else "; say the unit with --units time="
            found = f"time {how} as {unit} means {hz:.4g} samples per second, but {verdict.sentence}"
            raise FormatError(f"{where}: {found}{fix}")
    if not stated and len(stamps) > 1:
        how = verdict.sentence
        table.notes.append(f"time: taken as {unit}, because {how}")
    if (per_second := units.FACTORS["time"][unit]) != 1.0:
        stamps /= per_second
    return stamps, SensorFacts(unit, how or "assumed", int(np.isfinite(stamps).sum()))


def _stated(where: str, sensor: str, table: Table, options: Options) -> tuple[str, str]:
    """The unit that the caller or the file names for *sensor*, and which of them; empty where neither does."""
    if sensor in options.units:
        return units.expect(sensor, options.units[sensor], where), "given"
    if text := table.layout.unit(sensor):
        if unit := units.named(sensor, text):
            return unit, "named by the file"
        if sensor != "mag":
            raise FormatError(
                f"{where}: unit {text!r} of {sensor} not understood; say it: --units {sensor}="
                f"{' or '.join(list(units.FACTORS[sensor])[:3])}"
            )
    if table.own:
        return ("s" if sensor == "time" else units.SI[sensor]), "written by poise"
    return (table.time_unit, "calendar stamps") if sensor == "time" and table.time_unit else ("", "")


def _scale(
    where: str, sensor: str, values: dict[str, Any], table: Table, options: Options
) -> tuple[Floats, SensorFacts]:
    unit, how = _stated(where, sensor, table, options)
    found: Floats = values[sensor]
    if sensor == "mag":
        unit, how = (unit, how) if unit else (units.AS_FOUND, "not named; only the direction counts")
        if unit == units.AS_FOUND:
            table.notes.append("mag: unit not known, values kept as they are: only the direction counts")
    elif options.as_is:
        unit, how = (unit, how) if unit else (units.SI[sensor], "not named")
    elif not table.own:
        if sensor == "acc":
            verdict = evidence.of_acc(found)
        else:
            mag = values["mag"] if values["mag"] is not None else np.full_like(found, np.nan)
            verdict = evidence.of_gyr(values["time"], found, values["acc"], mag)
        if unit:
            _contradict(where, sensor, unit, how, verdict, table)
        else:
            unit, how = _decide(where, sensor, verdict), verdict.sentence
            table.notes.append(f"{sensor}: taken as {unit}, because {verdict.sentence}")
    if (factor := units.FACTORS[sensor][unit]) != 1.0:
        with np.errstate(over="ignore"):
            found *= factor
    return found, SensorFacts(unit, how, int(np.isfinite(found).all(axis=1).sum()))


def _decide(where: str, sensor: str, verdict: Verdict) -> str:
    if verdict.unit:
        return verdict.unit
    if sensor == "acc" and verdict.size < _FREE:
        raise FormatError(f"{where}: {_gravity_free(verdict)}; if it is that already, say --units acc=g (or mg)")
    options = (
        "--units acc=m/s² or acc=g" if sensor == "acc" else "--units gyr=rad/s or gyr=deg/s (poise doctor may tell)"
    )
    raise FormatError(
        f"{where}: unit of {sensor} not named, and the samples do not decide: {verdict.sentence}; say it: {options}"
    )


def _gravity_free(verdict: Verdict) -> str:
    return (
        f"acceleration without gravity? {verdict.sentence}, gravity alone is 9.8 m/s². An attitude needs the "
        "accelerometer's own samples (specific force): export the raw or total acceleration"
    )


def _contradict(where: str, sensor: str, unit: str, how: str, verdict: Verdict, table: Table) -> None:
    """Raise where a stated unit is off by more than a factor of five, doubt where it is off by more than a quarter."""
    factor = units.FACTORS[sensor][unit]
    if not np.isfinite(verdict.size) or (sensor == "gyr" and not verdict.unit):
        return
    ratio = verdict.size * factor / 9.80665 if sensor == "acc" else factor / verdict.size
    if sensor == "acc" and verdict.size * factor < _FREE and not (verdict.unit and verdict.unit != unit):
        raise FormatError(f"{where}: {_gravity_free(verdict)} ({unit}, {how})")
    if not 0.2 <= ratio <= 5.0:
        fix = f"--units {sensor}={verdict.unit}" if verdict.unit else f"the unit with --units {sensor}="
        raise FormatError(f"{where}: {sensor} is {how} as {unit}, but {verdict.sentence}; say {fix}")
    if not (0.8 <= ratio <= 1.25 if sensor == "acc" else 0.5 <= ratio <= 2.0):
        table.doubts.append(f"{sensor}: {unit} ({how}) is off by a factor of {ratio:.2f}: {verdict.sentence}")


def _gravity(where: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise FormatError(f"{where}: poise.gravity is {text[:40]!r}, expected a number of m/s²") from None


def _truth(time: Floats, quat: Floats, facts: Mapping[str, str]) -> Attitude:
    frame: Any = facts.get("poise.truth_frame", "enu")
    heading: Any = facts.get("poise.truth_heading_reference", "arbitrary")
    return reference(time, quat, frame=frame, heading_reference=heading)


def _say(values: dict[str, Any], sensors: dict[str, SensorFacts], table: Table) -> None:
    if "mag" not in sensors or not sensors["mag"].samples:
        table.notes.append("no magnetometer: heading is arbitrary")
    backward = int(np.sum(np.diff(values["time"]) <= 0))
    if backward:
        table.doubts.append(f"time: {backward} stamps do not rise above the one before")
    for sensor in ("acc", "mag"):
        rows = values[sensor]
        if rows is not None and not table.own and (held := fresh(rows)):
            new, usual = held
            rows[~new] = np.nan
            sensors[sensor] = replace(sensors[sensor], samples=int(new.sum()))
            table.notes.append(
                f"{sensor}: slower than the gyroscope, each sample was repeated over {usual} rows; "
                f"the repeats are left out ({np.mean(new):.0%} of the rows hold a sample)"
            )


def _sniffed(recording: Recording, table: Table, sensors: dict[str, SensorFacts]) -> Sniffed:
    steps = np.diff(recording.time)
    with np.errstate(invalid="ignore"):
        long = steps[steps > 3.0 / recording.rate_hz]
    order = {name: sensors[name] for name in ("time", *SENSORS) if name in sensors}
    return Sniffed(
        path=recording.source,
        format=table.format,
        rows=len(recording),
        rate_hz=recording.rate_hz,
        duration=recording.duration,
        gaps=(len(long), float(long.max()) if len(long) else 0.0),
        sensors=order,
        columns={key: column.name for key, column in table.layout.columns.items()},
        notes=tuple(table.notes),
        doubts=tuple(table.doubts),
    )
