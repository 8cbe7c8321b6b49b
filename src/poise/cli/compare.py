"""``poise compare``: estimators side by side."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from cyclopts import Parameter

from poise.cli import show
from poise.cli.options import Reading
from poise.cli.targets import PICTURES, check_room, distinct, really, targets
from poise.cli.words import UsageError, usage
from poise.errors import FormatError, PoiseError

if TYPE_CHECKING:
    from poise.comparison import Comparison

_TOLD = 5  # stretches of a file; --json and --report have them all


class Compared(NamedTuple):
    """A file's comparison, and the picture of it, or why there is none."""

    file: Path
    comparison: Comparison
    picture: Path | None
    undrawn: str = ""


def compare(
    files: Annotated[list[Path], Parameter(name="FILE", negative="")],
    /,
    *,
    method: Annotated[tuple[str, ...], Parameter(name=["--method", "-m"], negative="")] = (),
    with_: Annotated[str, Parameter(name="--with")] = "",
    threshold: float = 10.0,
    json: Annotated[bool, Parameter(negative="")] = False,
    plot: Path | None = None,
    report: Path | None = None,
    reading: Reading | None = None,
) -> int:
    """Run methods side by side: their errors, or how far, when and why they disagree.

    Where a FILE has a reference, the errors are those of `poise evaluate`. Where it has none, what most of the estimators
    agree on takes its place: who departs from it, from when to when, by how much, and what the flags and the sensors say
    about it. An estimator that cannot run on a file is a row with its reason.

    Examples: `poise compare walk.csv`; `poise compare walk.csv --with vqf,imufusion --report walk.html`;
    `poise compare trials/*.mat -m two-stage -m gated --json`

    Parameters
    ----------
    files
        Recordings: whatever `poise estimate` reads.
    method
        A method to compare; repeat for more. All of them, with their defaults, if not given.
    with_
        Other packages' filters to compare with: `vqf,imufusion,ahrs`, or single ones such as `vqf-offline`.
    threshold
        Degrees from the reference, or from the consensus, beyond which an estimator is said to depart.
    json
        Print everything as JSON.
    plot
        A picture (.png, .svg, .pdf) of who is how far off, and when; a folder for several FILEs.
    report
        One HTML file with the tables, pictures, stretches of disagreement and settings; it needs nothing beside it.
    """
    reading = reading or Reading()
    try:
        estimators = _chosen(method, with_, threshold)
        reading.as_arguments()
        pictures = targets(files, plot, ".comparison.png", PICTURES, "--plot") if plot else {}
        distinct(files)
        if report is not None:
            _check_report(report, [*files, *pictures.values()])
            check_room(report)
        done, refused = run(files, estimators, reading, threshold, pictures)
    except UsageError as error:
        show.problem(error)
        return 2
    except FormatError as error:
        show.problem(error)
        return 1
    problems = troubles(done)
    written = None
    if report is not None and done:
        try:
            write_report(report, done, refused, _command(files, method, with_, threshold, reading, report))
            written = report
        except PoiseError as error:
            problems.append({"file": str(report), "error": str(error)})
    if json:
        show.as_json(as_document(done, [*refused, *problems]))
    elif done:
        tell(done, written)
    for each in problems:
        show.problem(each["error"])
    return 1 if refused or problems else 0


def run(
    files: Sequence[Path],
    estimators: tuple[Mapping[str, Any], Mapping[str, Any]],
    reading: Reading,
    threshold: float,
    pictures: Mapping[Path, Path],
) -> tuple[list[Compared], list[dict[str, str]]]:
    """The comparison of every file that could be read, with its picture, and what was wrong with the others."""
    from poise.comparison import compare as side_by_side

    methods, peers = estimators

    def work(file: Path, tell: Callable[[str, float], None]) -> Compared:
        tell("reading", 0.0)
        recording = reading.read(file)
        comparison = side_by_side(
            recording,
            methods,
            peers,
            limit_deg=threshold,
            progress=lambda name, share: tell(f"{name} (a first run compiles it)", 0.1 + 0.8 * share),
        )
        if picture := pictures.get(file):
            tell("drawing", 0.9)
            try:
                _draw(comparison, picture)
            except PoiseError as problem:  # what was compared is told all the same
                return Compared(file, comparison, None, str(problem))
        return Compared(file, comparison, pictures.get(file))

    return show.each(files, work)


def troubles(done: Sequence[Compared]) -> list[dict[str, str]]:
    """What went wrong with files that could be read: no estimator can run on it, or its picture cannot be written."""
    found = [
        {"file": str(one.file), "error": f"{one.file}: no estimator gave an attitude"}
        for one in done
        if not one.comparison.done
    ]
    return found + [{"file": str(one.file), "error": one.undrawn} for one in done if one.undrawn]


def _draw(comparison: Comparison, picture: Path) -> None:
    from poise.plots import comparison_figure, save_figure

    save_figure(comparison_figure(comparison), picture)


def write_report(path: Path, done: Sequence[Compared], refused: Sequence[Mapping[str, str]], command: str) -> None:
    """The report of all that was compared. Raises :class:`PoiseError` where it cannot be drawn or written."""
    from poise.report import write_report as write

    with show.waiting([one.file for one in done]) as tell_progress:
        place = iter(one.file for one in done)
        write(
            path,
            [one.comparison for one in done],
            command=command,
            refused=[(each["file"], each["error"]) for each in refused],
            progress=lambda name, share: tell_progress(next(place), "drawing the report", 0.0),
        )


def as_document(done: Sequence[Compared], refused: Sequence[Mapping[str, str]]) -> dict[str, Any]:
    """What --json prints."""
    from poise.comparison.tables import means

    results = [
        {"file": str(one.file), "plot": str(one.picture) if one.picture else None} | one.comparison.to_dict()
        for one in done
    ]
    return {"mean_rms_deg": means([one.comparison for one in done]), "results": results, "errors": list(refused)}


def tell(done: Sequence[Compared], report: Path | None) -> None:
    """The tables, the worst stretches and the notes of every file, then the means."""
    from poise.comparison.tables import estimators, mean_tables, told

    for file, comparison, picture, _ in done:
        table = estimators(comparison)
        show.table(f"{file.name}: {table.title}", table.columns, table.rows)
        for note in comparison.notes:
            show.note(f"{file.name}: {note}")
        found = comparison.stretches()
        if found:
            some = f", the worst {_TOLD}" if len(found) > _TOLD else ""
            print(f"  {len(found)} stretch{'es' * (len(found) > 1)} beyond {comparison.limit_deg:g}°{some}:")
        for stretch in found[:_TOLD]:
            print(f"  {told(stretch, comparison)}")
        if picture:
            show.note(f"{file.name}: picture in {picture}")
        print()
    for table in mean_tables([one.comparison for one in done]):
        show.table(table.title, table.columns, table.rows)
    if report is not None:
        show.note(f"report in {report}")


def _chosen(method: Sequence[str], with_: str, threshold: float) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    from poise.comparison import methods_named
    from poise.peers import chosen

    if not 0.0 < threshold <= 180.0:
        usage(f"--threshold {threshold}: expected degrees above 0, up to 180")
    try:
        methods = methods_named(method or None)
    except PoiseError as error:
        usage(str(error))
    try:
        return methods, chosen(with_) if with_ else {}
    except PoiseError as error:
        usage(f"--with {with_}: {error}")


def _check_report(report: Path, others: Sequence[Path]) -> None:
    if report.suffix.lower() not in (".html", ".htm") or report.is_dir():
        usage(f"--report {report}: expected a file ending in .html")
    if really(report) in {really(other) for other in others}:
        usage(f"--report {report} is one of the recordings or pictures; nothing is written over them")


def again(files: Sequence[Path], options: Sequence[tuple[str, object]]) -> str:
    """The command, as a shell takes it, that compares *files* with *options* again."""
    words = ["poise", "compare", *(f"./{f}" if str(f).startswith("-") else str(f) for f in files)]
    for name, value in options:
        if value == "":  # a flag
            words.append(name)
        else:
            words += [f"{name}={value}"] if str(value).startswith("-") else [name, str(value)]
    return shlex.join(words)


def _command(
    files: Sequence[Path], method: Sequence[str], with_: str, threshold: float, reading: Reading, report: Path
) -> str:
    """The command that makes the same report."""
    options: list[tuple[str, object]] = [("--method", name) for name in method]
    options += [("--with", with_)] if with_ else []
    options += [("--threshold", threshold)] if threshold != 10.0 else []
    found = ((f"--{option.name}", getattr(reading, option.name)) for option in fields(reading))
    options += [(name, value) for name, value in found if value not in (None, False, True)]
    options += [("--force", "")] if reading.force else []
    return again(files, [*options, ("--report", report)])
