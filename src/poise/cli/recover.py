"""``poise recover``: what a recording held when it was interrupted."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from poise.cli import show
from poise.errors import PoiseError


def recover(folders: Annotated[list[Path], Parameter(name="FOLDER", negative="")], /) -> int:
    """Finish recordings of `poise live --record FOLDER` that were interrupted: by a crash, a full disk, a pulled plug.

    Every sample that was acknowledged is there. What was being written at that instant is cut off, what the disk has damaged
    since is left out; both are said. To go on
    recording instead, start `poise live --record FOLDER` again.

    Example: `poise recover recordings/`

    Parameters
    ----------
    folders
        The folders given to --record, or single recordings in them.
    """
    from poise.live.session import Session, interrupted

    problems = 0
    for folder in folders:
        found = interrupted(folder)
        if not folder.is_dir():
            show.problem(f"{folder}: no such folder")
            problems += 1
        elif not found:
            show.note(f"{folder}: nothing was interrupted here")
        for each in found:
            try:
                session = Session(each)
                session.cut()
                made = session.finish()
            except PoiseError as error:
                show.problem(error)
                problems += 1
                continue
            for text in session.found.damage:
                show.note(f"{each}: {text}")
            print(f"{each}: {session.found.samples} samples recovered, in {len(made)} files")
    return 1 if problems else 0
