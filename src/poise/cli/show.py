"""What people see: tables on stdout, problems and progress on stderr."""

from __future__ import annotations

import json
import math
import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

from poise.errors import PoiseError

_PATIENCE = 1.0  # s before a wait is explained


def problem(message: object) -> None:
    """One line on stderr."""
    print(f"poise: {' '.join(str(message).split())}", file=sys.stderr)


def note(message: str) -> None:
    """A remark about a result, on stderr, out of the way of what is piped."""
    print(f"  {message}", file=sys.stderr)


def as_json(value: Any) -> None:
    """One JSON document on stdout; NaN becomes null, as JSON has none."""
    print(json.dumps(_plain(value), indent=2, ensure_ascii=False))


def table(
    title: str, columns: Sequence[str], rows: Sequence[Sequence[Any]], footer: Sequence[Any] | None = None
) -> None:
    """A table on stdout; numbers stand right, and nothing is cut off when stdout is no terminal."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text  # never markup: a file may be called "[red].csv"

    console = Console(width=None if sys.stdout.isatty() else 160)
    grid = Table(
        title=Text(title) if title else None, title_justify="left", header_style="bold", show_footer=footer is not None
    )
    sample = rows[0] if rows else [""] * len(columns)
    for i, (name, cell) in enumerate(zip(columns, sample, strict=True)):
        end = footer[i] if footer is not None else ""
        numeric = isinstance(cell, (int, float))
        side: Literal["right", "left"] = "right" if numeric else "left"
        grid.add_column(Text(name), justify=side, footer=Text(_text(end)), overflow="fold")
    for row in rows:
        grid.add_row(*(Text(_text(cell)) for cell in row))
    console.print(grid)


@contextmanager
def waiting(files: Sequence[Path]) -> Iterator[Callable[[Path, str, float], None]]:
    """A progress bar over *files* that appears once the work has taken a second; call it with (file, doing, share)."""
    if not sys.stderr.isatty():
        yield lambda file, doing, share: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    said = TextColumn("{task.description}", markup=False)
    bar = Progress(said, BarColumn(), TimeRemainingColumn(), console=Console(stderr=True), transient=True)
    task = bar.add_task("", total=max(len(files), 1))
    place = {file: i for i, file in enumerate(files)}
    timer = threading.Timer(_PATIENCE, bar.start)
    timer.daemon = True
    timer.start()
    try:
        yield lambda file, doing, share: bar.update(
            task, description=f"{file.name}: {doing}", completed=place[file] + share
        )
    finally:
        timer.cancel()
        timer.join()
        bar.stop()


def each(
    files: Sequence[Path], work: Callable[[Path, Callable[[str, float], None]], Any]
) -> tuple[list[Any], list[dict[str, str]]]:
    """What *work* made of every file that could be used, and what was wrong with the others."""
    from poise.cli.words import UsageError

    results: list[Any] = []
    refused: list[dict[str, str]] = []
    with waiting(files) as tell:
        for file in files:
            try:
                results.append(work(file, lambda doing, share, file=file: tell(file, doing, share)))  # type: ignore[misc]
            except UsageError:
                raise
            except (PoiseError, OSError) as error:
                text = str(error)
                refused.append({"file": str(file), "error": text.removeprefix(f"{file}: ")})
                problem(text if file.name in text else f"{file}: {text}")
    return results, refused


def _text(cell: Any) -> str:
    if isinstance(cell, float):
        return "-" if math.isnan(cell) else f"{cell:.2f}"
    return str(cell)


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return str(value) if isinstance(value, Path) else value
