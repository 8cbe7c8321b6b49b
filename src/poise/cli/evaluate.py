"""``poise evaluate``: how far from the reference."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from poise.cli import show
from poise.cli.options import Reading, Running, UsageError, usage
from poise.errors import FormatError, RecordingError

if TYPE_CHECKING:
    from poise.data.recording import Recording


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

    Each FILE is a recording, which is estimated first, or an attitude that poise wrote. The reference is in the recording
    (as in the benchmark's files) or in --reference. RMSE over the moving rows, in degrees, nothing aligned first.

    Examples: `poise evaluate trials/*.mat -m adaptive-gain`; `poise evaluate walk.attitude.parquet --reference mocap.tum`

    Parameters
    ----------
    files
        Recordings, or attitudes written by poise.
    reference
        What to compare with, on the recording's clock: an attitude (Parquet or CSV by poise, TUM text) or a recording
        with a reference in it.
    plot
        A picture of one FILE's attitude, reference and error (.png, .svg, .pdf).
    json
        Print the figures as JSON.
    """
    reading, running = reading or Reading(), running or Running()
    try:
        running.build()
        reading.as_arguments()
        if plot and len(files) != 1:
            usage(f"--plot {plot} is one picture, for {len(files)} files; evaluate them one at a time")

        def work(file: Path, tell: Callable[[str, float], None]) -> dict[str, Any]:
            return _evaluated(file, reference, plot, reading, running, tell)

        running.warm()
        results, code = show.each(files, work)
    except UsageError as error:
        show.problem(error)
        return 2
    _report(results, running.method, json)
    return code


def _evaluated(
    file: Path,
    reference: Path | None,
    plot: Path | None,
    reading: Reading,
    running: Running,
    tell: Callable[[str, float], None],
) -> dict[str, Any]:
    from poise.evaluation import evaluate as measure
    from poise.formats import read_attitude

    tell("reading", 0.0)
    truth = None if reference is None else read_attitude(reference)
    recording: Recording | None = None
    try:
        recording = reading.read(file)
    except FormatError as no_recording:
        try:
            attitude = read_attitude(file)
        except FormatError:
            raise no_recording from None
        if truth is None:
            raise RecordingError("is an attitude; give what to compare it with: --reference FILE") from None
    else:
        tell("estimating (a first run compiles the method)", 0.3)
        attitude = running.estimate(recording)
    against = truth if truth is not None else recording
    assert against is not None  # one of the two: an attitude without a reference was refused above
    errors = measure(attitude, against)
    if not errors.counted.any():
        raise RecordingError("no row has both an attitude and a reference; do their clocks agree?")
    if plot:
        from poise.plots import attitude_figure, save_figure

        save_figure(attitude_figure(attitude, recording, errors, title=file.stem), plot)
    return {
        "file": str(file),
        "rmse_deg": errors.rmse_deg()._asdict(),
        "table_deg": errors.table(),
        "rows": int(errors.counted.sum()),
        "missing": errors.missing,
        "diverged": errors.diverged,
    }


def _report(results: list[dict[str, Any]], method: str, json: bool) -> None:
    kinds = ("total", "heading", "inclination")
    mean = {kind: sum(r["rmse_deg"][kind] for r in results) / len(results) for kind in kinds} if results else {}
    if json:
        show.as_json({"method": method, "mean_rmse_deg": mean, "results": results})
        return
    if not results:
        return
    rows = [
        [
            Path(result["file"]).name,
            *(result["rmse_deg"][kind] for kind in kinds),
            result["table_deg"]["total"]["p95"],
            result["table_deg"]["total"]["max"],
            result["rows"],
            "yes" if result["diverged"] else "no",
        ]
        for result in results
    ]
    columns = ["file", *kinds, "total p95", "total max", "rows", "diverged"]
    footer = ["mean", *mean.values(), "", "", "", ""] if len(results) > 1 else None
    show.table(f"{method}: RMSE in degrees", columns, rows, footer)
