"""``poise plot``: pictures."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from poise.cli import show
from poise.cli.options import Reading, Running
from poise.cli.targets import PICTURES, targets
from poise.cli.validity import WORTH_SAYING, none_valid, validity
from poise.cli.words import UsageError
from poise.errors import FormatError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from poise.data.attitude import Attitude


def plot(
    files: Annotated[list[Path], Parameter(name="FILE", negative="")],
    /,
    *,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    json: Annotated[bool, Parameter(negative="")] = False,
    reading: Reading | None = None,
    running: Running | None = None,
) -> int:
    """Draw recordings: what the sensors measured, and below it the attitude, with the reference where there is one.

    A FILE may also be an attitude that poise wrote (in a ROS bag too); then its angles are drawn.

    Examples: `poise plot walk.csv -o walk.png`; `poise plot logs/*.csv -m gated -o pictures/`

    Parameters
    ----------
    files
        Recordings, or attitudes written by poise.
    output
        A picture (.png, .svg, .pdf) for one FILE, or a folder for any number; `NAME.png` in the current folder if not given.
    json
        Print what was drawn as JSON.
    """
    reading, running = reading or Reading(), running or Running()
    try:
        running.build()
        reading.as_arguments()
        pictures = targets(files, output, ".png", PICTURES, "--output")

        def work(file: Path, tell: Callable[[str, float], None]) -> dict[str, Any]:
            tell("reading", 0.0)
            figure, kind, attitude = _drawn(file, reading, running, tell)
            from poise.plots import save_figure

            tell("drawing", 0.8)
            save_figure(figure, pictures[file])
            return {"file": str(file), "drawn": kind, "plot": str(pictures[file])} | validity(attitude)

        running.warm()
        results, refused = show.each(files, work)
    except UsageError as error:
        show.problem(error)
        return 2
    except FormatError as error:
        show.problem(error)
        return 1
    useless = none_valid(results, "plot", "drawn")
    refused += useless
    if json:
        show.as_json({"results": results, "errors": refused})
    elif results:
        show.table("", ["file", "drawn", "picture"], [[Path(r["file"]).name, r["drawn"], r["plot"]] for r in results])
        for result in results:
            if 0.0 < result["valid"] < WORTH_SAYING:
                name, why = Path(result["file"]).name, result["invalid_because"]
                show.note(f"{name}: only {result['valid']:.1%} of the rows are valid: {why}")
    for each in useless:
        show.problem(f"{each['file']}: {each['error']}")
    return 1 if refused else 0


def _drawn(
    file: Path, reading: Reading, running: Running, tell: Callable[[str, float], None]
) -> tuple[Figure, str, Attitude]:
    from poise.data.attitude import Attitude
    from poise.plots import attitude_figure, recording_figure

    recording = reading.read_either(file)
    if isinstance(recording, Attitude):
        running.means_nothing_to(file)
        return attitude_figure(recording, title=file.stem), "attitude", recording
    tell("estimating (a first run compiles the method)", 0.2)
    attitude = running.estimate(recording)
    figure = recording_figure(recording, attitude, title=recording.name)
    return figure, f"sensors and attitude ({running.method})", attitude
