"""Where the results of several files go."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path

from poise.cli.words import usage
from poise.errors import FormatError

PICTURES = (".png", ".svg", ".pdf")


def check_room(place: Path) -> None:
    """Raises :class:`FormatError` where *place* cannot be written, before any work is done for it.

    Its folder must be there: one that a slip of the pen names would hide the result.
    """
    folder = place.parent
    if not folder.exists():
        raise FormatError(f"{place}: folder {folder} does not exist; make it (mkdir -p), or name another")
    if not folder.is_dir():
        raise FormatError(f"{place}: cannot be written: {folder} is a file, not a folder")
    try:
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as problem:
        raise FormatError(f"{place}: cannot be written: {folder}: {problem.strerror or problem}") from None


def really(path: Path) -> Path:
    """Where *path* is behind its links; itself where these run in a circle, which is told where it is opened."""
    try:
        return path.resolve()
    except (OSError, RuntimeError):
        return path.absolute()


def distinct(files: Sequence[Path]) -> set[Path]:
    """Where *files* really are. Raises :class:`UsageError` for one that is given twice."""
    inputs = {really(file) for file in files}
    if len(inputs) < len(files):
        usage("a recording is given twice")
    return inputs


def targets(
    files: list[Path], target: Path | None, ending: str, known: tuple[str, ...], option: str
) -> dict[Path, Path]:
    """Where each file's result goes; never on top of an input or of one another, and only where there is room for it."""
    if target is None:
        places = {file: Path(file.stem + ending) for file in files}
    elif target.suffix.lower() in known and not target.is_dir():
        if len(files) != 1:
            usage(f"{option} {target} is one file, for {len(files)} recordings; give a folder")
        places = {files[0]: target}
    elif target.suffix and not target.is_dir():
        usage(f"{option} {target}: expected a folder, or a file ending in {', '.join(known)}")
    else:
        places = {file: target / (file.stem + ending) for file in files}
    inputs = distinct(files)
    taken: dict[Path, Path] = {}
    for file, place in places.items():
        if really(place) in inputs:
            usage(f"{option} {place} is one of the recordings; nothing is written over an input")
        if place in taken:
            usage(f"{taken[place]} and {file} would both be written to {place}; give them two folders")
        taken[place] = file
    for place in {place.parent: place for place in places.values()}.values():
        check_room(place)
    return places
