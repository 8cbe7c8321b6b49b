"""``poise evaluate``: how far from the reference."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from poise.cli import show
from poise.cli.options import Reading, Running
from poise.cli.targets import check_room, distinct
from poise.cli.words import UsageError, usage
from poise.errors import FormatError, PoiseError, RecordingError

if TYPE_CHECKING:
    from poise.data.attitude import Attitude
    from poise.data.recording import Recording

_KINDS = ("total", "heading", "inclination")


def evaluate(
    files: Annotated[list[Path], Parameter(name="FILE", negative="")],
    /,
    *,
    reference: Path | None = None,
    plot: Path | None = None,
    json: Annotated[bool, Parameter(negative="")] = False,
    reading: Reading | None = None,
    running: Running | None = None,
) -> int:
    """Compare attitudes with a reference, by the error definition of the BROAD benchmark.

    Each FILE is a recording, which is estimated first, or an attitude that poise wrote (in a ROS bag too). The reference
    is in the recording (as in the benchmark's files) or in --reference. RMSE in degrees, nothing aligned first, over the
    moving rows that the reference (or else the recording) names; over all rows, which is said, where neither names any.
    A method without a heading of its own (tilt, gated) is judged by its inclination.
    A reference that only agrees if it is read as inverted, in NED or with w last is said to be so.

    Examples: `poise evaluate trials/*.mat -m adaptive-gain`; `poise evaluate walk.attitude.parquet --reference mocap.tum`

    Parameters
    ----------
    files
        Recordings, or attitudes written by poise.
    reference
        What to compare with, on the recording's clock: an attitude (Parquet or CSV by poise, TUM text, the
        orientation in a ROS bag) or a recording with a reference in it.
    plot
        A picture of one FILE's attitude, reference and error (.png, .svg, .pdf).
    json
        Print the figures as JSON.
    """
    reading, running = reading or Reading(), running or Running()
    try:
        running.build()
        reading.as_arguments()
        distinct(files)
        if plot and len(files) != 1:
            usage(f"--plot {plot} is one picture, for {len(files)} files; evaluate them one at a time")
        if plot:
            check_room(plot)

        def work(file: Path, tell: Callable[[str, float], None]) -> dict[str, Any]:
            return _evaluated(file, reference, plot, reading, running, tell)

        running.warm()
        results, refused = show.each(files, work)
    except UsageError as error:
        show.problem(error)
        return 2
    except FormatError as error:
        show.problem(error)
        return 1
    if json:
        show.as_json({"mean_rmse_deg": _mean(results), "results": results, "errors": refused})
    elif results:
        _report(results)
    return 1 if refused else 0


def _evaluated(
    file: Path,
    reference: Path | None,
    plot: Path | None,
    reading: Reading,
    running: Running,
    tell: Callable[[str, float], None],
) -> dict[str, Any]:
    from poise.conformance.references import misread
    from poise.data.attitude import Attitude
    from poise.data.recording import Recording
    from poise.estimators import judged_by
    from poise.evaluation import evaluate as measure

    tell("reading", 0.0)
    given = None if reference is None else _reference(reference, reading)
    found = reading.read_either(file)
    recording: Recording | None = None
    if isinstance(found, Attitude):
        attitude = found
        running.means_nothing_to(file)
        if given is None:
            raise RecordingError("is an attitude; give what to compare it with: --reference FILE")
    else:
        recording = found if given is None else _against(found, given)
        tell("estimating (a first run compiles the method)", 0.3)
        attitude = running.estimate(recording)
    against = recording if recording is not None else given
    assert against is not None  # one of the two: an attitude without a reference was refused above
    errors = measure(attitude, against)
    moving = against.moving if isinstance(against, Recording) else None
    if moving is not None and not moving.any():
        raise RecordingError("no row moves, so none counts")
    if not errors.counted.any():
        raise RecordingError("no row has both an attitude and a reference; do their clocks agree?")
    if plot:
        from poise.plots import attitude_figure, save_figure

        save_figure(attitude_figure(attitude, recording, errors, title=file.stem), plot)
    judged = judged_by(attitude.provenance.method)
    other = misread(attitude, against, judged)
    return {
        "file": str(file),
        "method": attitude.provenance.method,
        "judged_by": judged,
        "rmse_deg": errors.rmse_deg()._asdict(),
        "table_deg": errors.table(),
        "rows": len(attitude),
        "compared": int(errors.counted.sum()),
        "over": "moving rows" if moving is not None else "all rows",
        "missing": errors.missing,
        "diverged": errors.diverged_by(judged),
        "reference": other.sentence if other else "",
    }


def _against(recording: Recording, reference: Recording | Attitude) -> Recording:
    """*recording* with that *reference*, and with the rows it says to count."""
    from poise.data.recording import Recording
    from poise.evaluation import moving_rows

    if not isinstance(reference, Recording):
        return replace(recording, truth=reference.resample(recording.time))
    assert reference.truth is not None  # looked at where it was read
    moving = moving_rows(reference, recording.time)
    moving = recording.moving if moving is None else moving
    return replace(recording, truth=reference.truth.resample(recording.time), moving=moving)


def _reference(path: Path, reading: Reading) -> Recording | Attitude:
    """The attitude in *path*, or the recording there: its reference counts, and the rows that it says are moving."""
    from poise.formats import read_attitude

    try:
        return _with_moving(path, read_attitude(path), reading)
    except FormatError as no_attitude:
        try:
            recording = replace(reading, topic=None).read(path)  # a topic is that of FILE
        except FormatError:
            raise no_attitude from None
        if recording.truth is None:
            raise FormatError(f"{path}: holds no reference attitude") from None
        return recording


def _with_moving(path: Path, attitude: Attitude, reading: Reading) -> Recording | Attitude:
    """The *attitude* read from *path*, in the recording that names its moving rows where the file is one."""
    from poise.formats import wrote_attitude

    if wrote_attitude(path, limits=reading.limits()):
        return attitude
    try:  # as the file stands: units and axes that are asked for are those of FILE, and its samples do not matter here
        recording = Reading(limit=reading.limit, force=True).read(path)
    except PoiseError:
        return attitude
    same = recording.moving is not None and len(recording) == len(attitude)
    return replace(recording, truth=attitude) if same else attitude


def _mean(results: list[dict[str, Any]]) -> dict[str, float]:
    return {kind: sum(r["rmse_deg"][kind] for r in results) / len(results) for kind in _KINDS} if results else {}


def _told(result: dict[str, Any]) -> dict[str, float]:
    """The RMSE that the table shows: total and heading only of a method that has a heading."""
    shown = _KINDS if result["judged_by"] == "total" else ("inclination",)
    return {kind: result["rmse_deg"][kind] if kind in shown else math.nan for kind in _KINDS}


def _over(values: list[float]) -> float:
    """The mean of the values that are there."""
    known = [value for value in values if not math.isnan(value)]
    return sum(known) / len(known) if known else math.nan


def _report(results: list[dict[str, Any]]) -> None:
    told = [_told(result) for result in results]
    rows = [
        [
            Path(result["file"]).name,
            result["method"],
            result["judged_by"],
            *figures.values(),
            result["table_deg"][result["judged_by"]]["p95"],
            result["table_deg"][result["judged_by"]]["max"],
            f"{result['compared']} of {result['rows']}",
            "yes" if result["diverged"] else "no",
        ]
        for result, figures in zip(results, told, strict=True)
    ]
    columns = ["file", "method", "judged by", *_KINDS, "its p95", "its max", "rows compared", "diverged"]
    means = [_over([figures[kind] for figures in told]) for kind in _KINDS]
    footer = ["mean", "", "", *means, "", "", "", ""] if len(results) > 1 else None
    show.table("RMSE in degrees", columns, rows, footer)
    from poise.formats.names import counted

    for result in results:
        if result["over"] == "all rows":
            show.note(
                f"{Path(result['file']).name}: no rows are named as moving: the figures are over all that have a reference"
            )
        if result["missing"]:
            rows_ = counted(result["missing"], "row")
            show.note(f"{Path(result['file']).name}: of the rows that should count, {rows_} without an attitude")
        if result["reference"]:
            show.note(f"{Path(result['file']).name}: {result['reference']}")
