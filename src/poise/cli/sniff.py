"""``poise sniff``: what a file is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from poise.cli import show
from poise.cli.options import Reading
from poise.cli.words import UsageError


def sniff(
    files: Annotated[list[Path], Parameter(name="FILE", negative="")],
    /,
    *,
    json: Annotated[bool, Parameter(negative="")] = False,
    reading: Reading | None = None,
) -> int:
    """Say what a file is: format, rates, gaps, units and how each was found, and what is doubtful.

    Parameters
    ----------
    files
        Files to look at.
    json
        Print as JSON.
    """
    from poise.formats import sniff as look

    reading = reading or Reading()

    def work(file: Path, tell: Callable[[str, float], None]) -> dict[str, Any]:
        tell("reading", 0.0)
        return asdict(look(file, **reading.as_arguments()))

    try:
        reading.as_arguments()
        results, refused = show.each(files, work)
    except UsageError as error:
        show.problem(error)
        return 2
    if json:
        show.as_json({"results": results, "errors": refused})
    else:
        for result in results:
            _tell(result)
    return 1 if refused else 0


def _tell(result: dict[str, Any]) -> None:
    from poise.formats.names import counted

    gaps, longest = result["gaps"]
    print(
        f"{result['path']}: {result['format']}, {counted(result['rows'], 'row')}, {result['duration']:.1f} s", end=" "
    )
    print(
        f"at {result['rate_hz']:.2f} Hz, "
        + (f"{counted(gaps, 'gap')}, the longest {longest:.3f} s" if gaps else "no gaps")
    )
    rows = []
    for name, facts in result["sensors"].items():
        columns = [theirs for ours, theirs in result["columns"].items() if ours.partition("_")[0] == name]
        rows.append([name, facts["unit"], facts["how"], facts["samples"], ", ".join(columns)])
    show.table("", ["sensor", "unit", "how it was found", "samples", "columns"], rows)
    for note in result["notes"]:
        print(f"  {note}")
    for doubt in result["doubts"]:
        print(f"  doubtful: {doubt}")
