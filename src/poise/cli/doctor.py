"""``poise doctor``: what is wrong with a recording, and what repairs it."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Collection
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, NamedTuple

from cyclopts import Parameter

from poise.cli import corrected, show
from poise.cli.options import Reading
from poise.cli.targets import PICTURES, check_room, distinct, really
from poise.cli.words import UsageError, usage
from poise.errors import FormatError

if TYPE_CHECKING:
    from poise.doctor import Diagnosis

_PAGES = (".html", ".htm")


class Examined(NamedTuple):
    """A file, what was found in it, and how to read it right."""

    file: Path
    diagnosis: Diagnosis
    reading: Reading
    """with the repairs"""
    reader: str
    """why it cannot be read without them; empty where it can"""
    choices: tuple[Reading, ...] = ()
    """how it may be read, where nothing tells which is right"""


def doctor(
    files: Annotated[list[Path], Parameter(name="FILE", negative="")],
    /,
    *,
    hemisphere: Literal["north", "south"] = "north",
    save_profile: Path | None = None,
    sheet: Path | None = None,
    json: Annotated[bool, Parameter(negative="")] = False,
    reading: Reading | None = None,
) -> int:
    """Say what is wrong with recordings, and which options repair it.

    From the samples alone: the gyroscope must explain how gravity and the magnetic field turn. That tells units, axes,
    signs and delays; besides stamps, gaps, clipping, stuck or repeated samples, noise and bias at rest, and hard iron are
    looked at. What is "sure" is refused by `poise estimate` too; "likely" is to be looked at; what cannot be told, and
    why, is said. Exit code 1: something is surely wrong, or a FILE cannot be read, or not without a unit that cannot be told.

    Examples: `poise doctor walk.csv`; `poise doctor walk.csv --save-profile glove.toml`, then
    `poise estimate walk.csv --profile glove.toml`; `poise doctor logs/*.csv --sheet logs.html`

    Parameters
    ----------
    files
        Recordings: whatever `poise estimate` reads.
    hemisphere
        Where they were made: the field points down in the north, up in the south, which tells the sign of acc and mag.
    save_profile
        Write what surely repairs the one FILE, as a file for --profile; nothing is written where nothing is to be repaired.
    sheet
        The plots behind the verdicts: one .html for all FILEs, or a picture (.png, .svg, .pdf) of one.
    json
        Print everything as JSON.
    """
    reading = reading or Reading()
    try:
        reading.as_arguments()
        _check_targets(files, save_profile, sheet)

        def work(file: Path, tell: Callable[[str, float], None]) -> Examined:
            tell("reading", 0.0)
            return examine(file, reading, hemisphere)

        done, refused = show.each(files, work)
        written = _write(done, save_profile, sheet)
    except UsageError as error:
        show.problem(error)
        return 2
    except FormatError as error:
        show.problem(error)
        return 1
    if json:
        results = [
            {
                "file": str(one.file),
                "reader": one.reader,
                "command": command(one),
                "choices": [_estimate(one, choice) for choice in one.choices],
            }
            | one.diagnosis.to_dict()
            for one in done
        ]
        show.as_json({"results": results, "errors": refused})
    else:
        for one in done:
            _tell(one)
        for line in written:
            show.note(line)
    bad = any(one.diagnosis.found("sure") or one.choices or (one.reader and not command(one)) for one in done)
    return 1 if refused or bad else 0


def examine(file: Path, reading: Reading, hemisphere: Literal["north", "south"]) -> Examined:
    """The diagnosis of *file*: as poise reads it, or as it stands where its units are refused for what the samples say."""
    from poise.doctor import diagnose
    from poise.formats import examine as read

    reading = corrected.with_profile(reading)
    arguments = reading.as_arguments()
    reader = ""
    try:
        recording, sniffed = read(file, **arguments)
    except FormatError as refusal:
        try:
            recording, sniffed = read(file, **arguments, as_is=True)
        except FormatError:
            raise refusal from None
        reader = str(refusal).removeprefix(f"{file}: ")
    recording = corrected.applied(reading, recording)
    read_as = {name: facts.unit for name, facts in sniffed.sensors.items()}
    found = diagnose(recording, hemisphere=hemisphere, read_as=read_as, guessed=corrected.guessed(sniffed))
    right = corrected.repaired(reading, found)
    if any(f.severity == "sure" and not f.decided for f in found.findings):
        return Examined(file, found, right, reader)
    # What was taken for SI and found right must be said where the reader does not decide
    taken = {name for name in corrected.guessed(sniffed) if reader and not _open(found, name)}
    choices = tuple(
        _said(corrected.repaired(reading, found, choice), taken) for untold in found.untold for choice in untold.choices
    )
    return Examined(file, found, right if _open(found) else _said(right, taken), reader, choices)


def _open(found: Diagnosis, sensor: str = "") -> bool:
    """Whether the unit of *sensor*, or of any that matters, is not known."""
    names = {f"{name} unit" for name in ((sensor,) if sensor else ("time", "gyr", "acc"))}
    return any(f.name in names and not f.decided for f in found.findings)


def _said(reading: Reading, taken: Collection[str]) -> Reading:
    """*reading* with the units of the sensors *taken* for SI."""
    from dataclasses import replace

    from poise.cli.words import pairs

    units = pairs(reading.units, "--units", "") or {}
    for sensor, unit in (("gyr", "rad/s"), ("acc", "m/s²")):
        if sensor in taken and sensor not in units:
            units[sensor] = unit
    return replace(reading, units=",".join(f"{k}={v}" for k, v in units.items()) or None)


def command(one: Examined) -> str:
    """The command that estimates the recording with what was found; empty where nothing is repaired for sure."""
    found = one.diagnosis
    if any(not f.decided for f in found.found("sure")) or not (found.repairs or one.reader):
        return ""
    return "" if one.reader and _open(found) else _estimate(one, one.reading)


def _estimate(one: Examined, reading: Reading) -> str:
    name = f"./{one.file}" if str(one.file).startswith("-") else str(one.file)
    return f"poise estimate {shlex.quote(name)} {corrected.options(reading)}".rstrip()


def _tell(one: Examined) -> None:
    from poise.doctor.findings import options

    found = one.diagnosis
    print(f"{one.file}: {found.verdict}")
    if one.reader:
        print(f"  poise estimate refuses it as it is: {one.reader}")
    for finding in found.findings:
        print(f"  {finding.severity:<11} {finding.name}: {finding.sentence}")
        if finding.fix and finding.severity != "sure" and (fix := options(finding.fix, found.read_as)):
            print(f"  {'':<11} if so: {fix}")
        elif finding.fix and not finding.decided and (fix := options(finding.fix, found.read_as)):
            print(f"  {'':<11} one that fits: {fix}")
    if run := command(one):
        print(f"  repaired: {run}")
    for choice in one.choices:
        print(f"  either:   {_estimate(one, choice)}")
    print()


def _check_targets(files: list[Path], save_profile: Path | None, sheet: Path | None) -> None:
    inputs = distinct(files)
    if save_profile is not None:
        if len(files) != 1:
            usage(f"--save-profile {save_profile} is of one recording, {len(files)} are given")
        if save_profile.suffix.lower() != ".toml":
            usage(f"--save-profile {save_profile}: expected a file ending in .toml")
    if sheet is not None:
        ending = sheet.suffix.lower()
        if ending not in (*_PAGES, *PICTURES) or sheet.is_dir():
            usage(f"--sheet {sheet}: expected a file ending in {', '.join((*_PAGES[:1], *PICTURES))}")
        if ending in PICTURES and len(files) != 1:
            usage(f"--sheet {sheet} is one picture, for {len(files)} files; a .html holds them all")
    for place in filter(None, (save_profile, sheet)):
        if really(place) in inputs:
            usage(f"{place} is one of the recordings; nothing is written over an input")
        check_room(place)


def _write(done: list[Examined], save_profile: Path | None, sheet: Path | None) -> list[str]:
    """Write the profile and the sheet; what to say of them."""
    written = []
    if save_profile is not None and done and not corrected.corrects(done[0].reading):
        open_ = done[0].diagnosis.found("sure") or done[0].reader
        what = "nothing of it is repaired for sure" if open_ else "nothing to repair"
        written.append(f"{done[0].file}: {what}: no profile written")
    elif save_profile is not None and done:
        one = done[0]
        corrected.save_profile(one.reading, save_profile, f"what repairs {one.file.name}, by poise doctor")
        written.append(
            f"profile in {save_profile}; poise estimate {shlex.quote(str(one.file))} --profile {save_profile}"
        )
    if sheet is not None and done:
        if sheet.suffix.lower() in _PAGES:
            from poise.report.diagnoses import write_sheet

            write_sheet(sheet, [(one.diagnosis, command(one)) for one in done])
        else:
            from poise.plots import diagnosis_figure, save_figure

            save_figure(diagnosis_figure(done[0].diagnosis), sheet)
        written.append(f"sheet in {sheet}")
    return written
