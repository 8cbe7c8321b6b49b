"""Corrections on the command line: --units, --remap and --delay, their profiles, and the check of what was read."""

from __future__ import annotations

import math
import re
import shlex
import tomllib
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from poise.cli.options import Reading
from poise.cli.words import pairs, usage
from poise.errors import PoiseError, RecordingError

if TYPE_CHECKING:
    from poise.data.corrections import Corrections
    from poise.data.recording import Recording
    from poise.doctor import Diagnosis
    from poise.formats import Sniffed

_SENSORS = ("gyr", "acc", "mag")
_STATED = ("given", "named by the file", "written by poise", "calendar stamps")
_TABLES = {"units": ("time", *_SENSORS), "remap": ("all", *_SENSORS), "delay": ("acc", "mag")}


def read(reading: Reading, path: Path) -> Recording:
    """The recording in *path* with the corrections of *reading*.

    Raises :class:`RecordingError`, with what repairs it, where units or axes are surely wrong, unless it is forced.
    """
    from poise.formats import examine

    reading = with_profile(reading)
    recording, sniffed = examine(path, **reading.as_arguments())
    recording = applied(reading, recording)
    check(reading, recording, sniffed)
    return recording


def check(reading: Reading, recording: Recording, sniffed: Sniffed) -> None:
    """Raise :class:`RecordingError` where units or axes of what *reading* gave are surely wrong, unless it is forced."""
    from poise.doctor import diagnose

    if reading.force:
        return
    read_as = {name: facts.unit for name, facts in sniffed.sensors.items()}
    found = diagnose(recording, thorough=False, read_as=read_as, guessed=guessed(sniffed))
    if wrong := [f for f in found.found("sure") if f.name != "samples"]:
        told = "; ".join(f.sentence for f in wrong)
        fix = options(repaired(reading, found)) if found.repairs and all(f.decided for f in wrong) else ""
        cure = f"say {fix}" if fix else "poise doctor shows what is known"
        raise RecordingError(f"{told}; {cure}, or go on with --force")


def guessed(sniffed: Sniffed) -> set[str]:
    """Whose units nobody named: the clock's, told from its rate alone, and those that were taken for SI."""
    names = {name for name, facts in sniffed.sensors.items() if facts.how == "not named"}
    clock = sniffed.sensors.get("time")
    stated = clock is None or clock.how in _STATED or clock.how.startswith("from the rate")
    return names if stated else names | {"time"}


def applied(reading: Reading, recording: Recording) -> Recording:
    """*recording* with the axes and delays of *reading*."""
    whole, single = asked(reading)
    recording = single.apply(recording)
    return recording.remap(whole) if whole else recording


def asked(reading: Reading) -> tuple[str, Corrections]:
    """The words for the axes of all sensors, and the corrections of single ones; raises UsageError for what is neither."""
    from poise.data.corrections import Corrections

    told = _remaps(reading.remap)
    for sensor, words in told.items():
        _check_axes("--remap", sensor, words)
    delays = {}
    for sensor, text in (pairs(reading.delay, "--delay", "mag=0.015") or {}).items():
        if sensor not in _TABLES["delay"]:
            usage(f"--delay {sensor}={text}: expected acc or mag and seconds, such as mag=0.015")
        delays[sensor] = _seconds(f"--delay {sensor}={text}", text)
    return told.pop("all", ""), Corrections(axes=told, delays=delays)


def check_unit(where: str, sensor: str, text: str) -> None:
    """Raises :class:`UsageError`, which names *where*, for what is no unit of *sensor*."""
    from poise.formats.units import expect

    try:
        expect(sensor, text, where)
    except PoiseError as error:
        usage(str(error))


def _check_axes(where: str, sensor: str, words: str) -> None:
    from poise.data.axes import rotation_matrix

    try:
        rotation_matrix(words, mirror=sensor != "all")
    except PoiseError as error:
        usage(f"{where}: {error}")


def _seconds(where: str, text: str) -> float:
    try:
        late = float(text)
    except ValueError:
        late = math.nan
    if not abs(late) <= 1.0:
        usage(f"{where}: expected seconds, at most 1, such as 0.015")
    return late


def _remaps(text: str | None) -> dict[str, str]:
    """What --remap says, by sensor; words alone are for "all"."""
    if not text:
        return {}
    if "=" not in text:
        return {"all": text}
    told = {}
    for part in re.split(r"[,;\s]+(?=\w+\s*=)", text.strip()):
        sensor, _, words = (piece.strip() for piece in part.partition("="))
        if sensor not in _TABLES["remap"] or not words:
            usage(
                f'--remap {text!r}: expected axes such as "y -x z", or those of single sensors: "acc=y -x z,mag=-x y z"'
            )
        told[sensor] = words
    return told


def repaired(reading: Reading, diagnosis: Diagnosis, choice: Corrections | None = None) -> Reading:
    """*reading* with what repairs the recording that it gave: its own options and the new ones, taken together.

    *choice* is one of those that the diagnosis leaves open.
    """
    from poise.data.axes import rotation_matrix
    from poise.doctor.axes import words
    from poise.doctor.findings import merged, unit_after

    fix = merged([diagnosis.repairs, choice]) if choice else diagnosis.repairs
    whole, single = asked(reading)
    units = pairs(reading.units, "--units", "") or {}
    for sensor, factor in fix.factors.items():
        if unit := unit_after(sensor, factor, diagnosis.read_as):
            units[sensor] = unit
    axes, turn = dict(single.axes), rotation_matrix(whole or "x y z")
    for sensor, text in fix.axes.items():  # found behind the turn of all sensors, said before it
        before = rotation_matrix(axes.get(sensor, "x y z"), mirror=True)
        axes[sensor] = words(turn.T @ rotation_matrix(text, mirror=True) @ turn @ before)
    axes = {sensor: text for sensor, text in axes.items() if text != "x y z"} | ({"all": whole} if whole else {})
    delays = dict(single.delays)
    for sensor, late in fix.delays.items():
        delays[sensor] = round(delays.get(sensor, 0.0) + late, 4)
    remap = whole if whole and len(axes) == 1 else _joined(axes)
    return replace(reading, units=_joined(units), remap=remap, delay=_joined(delays))


def _joined(told: dict[str, Any]) -> str | None:
    return ",".join(f"{name}={value}" for name, value in told.items()) or None


def options(reading: Reading) -> str:
    """The options that make *reading*, as a shell takes them."""
    told: list[str] = []
    for option in fields(reading):
        value = getattr(reading, option.name)
        if value is True:
            told.append(f"--{option.name}")
        elif value is not None and value is not False and option.name != "profile":
            text = str(value)
            quoted = f'"{text}"' if " " in text and not set(text) & set('"$`\\!') else shlex.quote(text)
            told.append(f"--{option.name}={quoted}" if text.startswith("-") else f"--{option.name} {quoted}")
    return " ".join(told)


def with_profile(reading: Reading) -> Reading:
    """*reading* with what its profile says besides; an option goes before it. Raises UsageError for what is no profile."""
    if reading.profile is None:
        return reading
    profile = _loaded(reading.profile)
    told = {
        "units": pairs(reading.units, "--units", "gyr=deg/s,acc=g") or {},
        "remap": _remaps(reading.remap),
        "delay": pairs(reading.delay, "--delay", "mag=0.015") or {},
    }
    merged = {name: profile.get(name, {}) | values for name, values in told.items()}
    text = {name: _joined(values) for name, values in merged.items()}
    return replace(reading, profile=None, units=text["units"], remap=text["remap"], delay=text["delay"])


def _loaded(path: Path) -> dict[str, dict[str, Any]]:
    example = 'expected tables such as [units] gyr = "deg/s", [remap] acc = "y -x z", [delay] mag = 0.015'
    try:
        if path.stat().st_size > 64 * 2**10:
            usage(f"--profile {path}: is larger than any profile; {example}")
        found = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as problem:
        usage(f"--profile {path}: cannot be read: {problem.strerror or problem}")
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as problem:
        usage(f"--profile {path}: is no TOML ({problem}); {example}")
    if not any(found.values()):
        usage(f"--profile {path}: says nothing; {example}")
    for table, values in found.items():
        if table not in _TABLES:
            usage(f"--profile {path}: no table [{table}] is known; {example}")
        if not isinstance(values, dict):
            usage(f"--profile {path}: {table} is no table; {example}")
        for name, value in values.items():
            _check_entry(f"--profile {path}: [{table}] {name}", table, name, value)
    return found


def _check_entry(where: str, table: str, name: str, value: Any) -> None:
    """Raises :class:`UsageError`, which names the file and the key, for what a profile cannot say."""
    if name not in _TABLES[table]:
        usage(f"{where}: [{table}] is of {', '.join(_TABLES[table])}")
    if table == "delay":
        if isinstance(value, bool) or not isinstance(value, (float, int)):
            usage(f"{where}: expected seconds, a number such as 0.015, found {value!r}")
        _seconds(f"{where} = {value!r}", str(value))
        return
    if not isinstance(value, str):
        usage(f"{where}: expected a text, found {value!r}")
    if table == "units":
        check_unit(where, name, value)
    else:
        _check_axes(where, name, value)


def corrects(reading: Reading) -> bool:
    """Whether there is anything in *reading* for a profile to keep."""
    return bool(reading.units or reading.remap or reading.delay)


def save_profile(reading: Reading, path: Path, comment: str) -> None:
    """Write units, axes and delays of *reading* as a profile: the whole file or nothing."""
    from poise.formats.saving import replacing

    whole, single = asked(reading)
    axes = dict(single.axes) | ({"all": whole} if whole else {})
    tables: list[tuple[str, dict[str, Any]]] = [
        ("units", pairs(reading.units, "--units", "") or {}),
        ("remap", axes),
        ("delay", dict(single.delays)),
    ]
    lines = [f"# {' '.join(comment.split())}", "# for any command of poise that reads recordings: --profile THIS_FILE"]
    for name, values in tables:
        if values:
            lines += ["", f"[{name}]", *(f"{k} = {_toml(v)}" for k, v in values.items())]
    with replacing(path) as file:
        file.write(("\n".join(lines) + "\n").encode("utf-8"))


def _toml(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:g}" if "." in f"{value:g}" or "e" in f"{value:g}" else f"{value:.1f}"
    return '"' + str(value).replace("\\", "\\\\").replace('"', '\\"') + '"'
