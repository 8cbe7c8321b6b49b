"""``poise demo``: everything on made recordings, for someone without a file."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from poise.cli import show
from poise.cli.compare import Compared, again, as_document, run, tell, troubles, write_report
from poise.cli.options import Reading
from poise.errors import FormatError, PoiseError

if TYPE_CHECKING:
    from poise.data.recording import Recording

_DURATION = 60.0  # s
_MOTIONS = ("forearm", "phone", "robot")
_RESULTS = ("report.html", "comparison.json", "table.csv")
_FILES = (*(f"{name}{end}" for name in _MOTIONS for end in (".csv", ".png", ".comparison.png")), *_RESULTS)
_MARK = ".poise-demo"  # in a folder whose _FILES are the demo's own


def demo(*, output: Annotated[Path, Parameter(name=["--output", "-o"])] = Path("poise-demo")) -> int:
    """Show what poise does on three made recordings: a forearm, a phone and a robot, each with its exact reference.

    Writes the recordings as CSV files, runs every method on them, and every other package's filter that is installed,
    and writes a table, pictures and one report, `report.html`. The first run compiles the methods, about 10 s each.

    Parameters
    ----------
    output
        The folder to write into. Files that are there already are written over only where an earlier demo wrote them.
    """
    from poise.comparison import LIMIT_DEG, available_peers, methods_named

    try:
        _claim(output)
        files = [_write(recording, output) for recording in _made()]
        peers = available_peers()
        pictures = {file: file.with_suffix(".comparison.png") for file in files}
        done, refused = run(files, (methods_named(), peers), Reading(), LIMIT_DEG, pictures)
        for each in troubles(done):
            show.problem(each["error"])
        if refused or troubles(done):
            return 1
        for one in done:
            _draw(one)
        report = output / "report.html"
        options = [("--with", ",".join(peers))] if peers else []
        write_report(report, done, [], again(files, [*options, ("--report", report)]))
        _save(
            output / "comparison.json", json.dumps(as_document(done, []), indent=2, ensure_ascii=False, allow_nan=False)
        )
        _save(output / "table.csv", _table(done))
    except PoiseError as error:
        show.problem(error)
        return 1
    tell(done, report)
    show.note(f"recordings, pictures, table.csv and comparison.json in {output}")
    return 0


def _made() -> list[Recording]:
    from poise import simulation

    motions = (getattr(simulation, name) for name in _MOTIONS)
    sensor = simulation.Sensor()
    return [simulation.measure(each(_DURATION, seed=1), sensor, seed=1, name=each.__name__) for each in motions]


def _claim(folder: Path) -> None:
    """Mark *folder* as the demo's; raises :class:`FormatError` where somebody else's files are in the way."""
    from poise.formats.names import listed

    try:
        folder.mkdir(parents=True, exist_ok=True)  # the demo's own
    except OSError as problem:
        raise FormatError(f"{folder}: no folder can be made there: {problem.strerror or problem}") from None
    mark = folder / _MARK
    if mark.is_file():
        return
    if found := [name for name in _FILES if (folder / name).exists()]:
        raise FormatError(
            f"{folder}: holds {listed(found, len(_FILES))}, which no demo is known to have written; "
            "nothing is written over them: move them away, or name another folder with --output"
        )
    _save(mark, "poise demo writes over its files in this folder:\n" + "".join(f"{name}\n" for name in _FILES))


def _write(recording: Recording, folder: Path) -> Path:
    from poise.formats import write

    file = folder / f"{recording.name}.csv"
    write(recording, file)
    return file


def _draw(one: Compared) -> None:
    """The sensors with the attitude of the best method."""
    from poise.plots import recording_figure, save_figure

    best = one.comparison.best
    recording = one.comparison.recording
    save_figure(recording_figure(recording, best.attitude if best else None), one.file.with_suffix(".png"))


def _table(done: Sequence[Compared]) -> str:
    """A row for each recording and estimator."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    kinds = ("total", "heading", "inclination")
    rows.writerow(["recording", "estimator", *(f"{kind}_rmse_deg" for kind in kinds), "failure"])
    for one in done:
        for run_ in one.comparison.runs:
            figures = run_.figures()
            told = [f"{figures[kind]['rmse']:.4f}" if kind in figures else "" for kind in kinds]
            rows.writerow([one.comparison.recording.name, run_.name, *told, run_.failure])
    return text.getvalue()


def _save(path: Path, text: str) -> None:
    from poise.formats.saving import replacing

    with replacing(path) as file:
        file.write(text.encode("utf-8"))
