"""Writing beside and renaming: a file is there whole under its name, or not at all."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from poise.errors import FormatError


@contextmanager
def replacing(path: Path) -> Iterator[BinaryIO]:
    """A file to write into that takes the name *path* when the block ends well and disappears when it does not.

    Raises :class:`FormatError` where the folder cannot be written to.
    """
    part = _beside(path)
    try:
        with part.open("xb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        part.replace(path)
    except OSError as problem:
        raise FormatError(f"{path}: cannot be written: {problem.strerror or problem}") from None
    finally:
        part.unlink(missing_ok=True)


@contextmanager
def making(path: Path) -> Iterator[Path]:
    """A name for a library to make a file or folder under, that takes the name *path* when the block ends well.

    A folder at *path* is replaced whole. Raises :class:`FormatError` where the folder above cannot be written to.
    """
    workshop = _beside(path)
    try:
        workshop.mkdir()
        made, old = workshop / path.name, workshop / "old"
        yield made
        for file in [made, *made.rglob("*")]:
            if file.is_file():
                with file.open("rb+") as written:
                    os.fsync(written.fileno())
        if not made.is_dir():
            made.replace(path)
            return
        if path.is_dir():
            path.rename(old)
        try:
            made.rename(path)
        except OSError:
            if old.exists():
                old.rename(path)
            raise
    except OSError as problem:
        raise FormatError(f"{path}: cannot be written: {problem.strerror or problem}") from None
    finally:
        if path.exists() or not (workshop / "old").exists():  # never the only copy
            shutil.rmtree(workshop, ignore_errors=True)


def _beside(path: Path) -> Path:
    """A name that no file has; whatever the length of *path*'s own, within the 255 bytes that file systems allow."""
    return path.with_name(f".{shortened(path.name, 100)}.{secrets.token_hex(4)}.part")


def shortened(name: str, most: int) -> str:
    """The beginning of a file's *name*, *most* bytes of whole characters, as the system has it: that may know ASCII only."""
    return os.fsdecode(os.fsencode(name)[:most].decode("utf-8", "ignore").encode("utf-8"))


def readable(name: str) -> str:
    """A file's *name* as text that can be stored and drawn: bytes that are no UTF-8 are escaped."""
    return name.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")
