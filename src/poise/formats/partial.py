"""A long file while it is written: its rows so far and the state to go on from, in a folder beside its place."""

from __future__ import annotations

import io
import json
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from poise.errors import FormatError
from poise.formats.saving import shortened

_STATE, _LOCK, _WHOLE = "state.npz", "lock", "whole"
Arrays = dict[str, NDArray[Any]]


class Partial:
    """Rows that survive the process: what :meth:`save` was called behind is there again after a kill.

    *rows* and *index* are open for appending. Nothing stands under the final name before :meth:`finish`.
    """

    def __init__(self, folder: Path, target: Path, rows: BinaryIO, index: BinaryIO) -> None:
        self._folder, self._target = folder, target
        self.rows, self.index = rows, index

    def load(self, identity: str) -> tuple[dict[str, Any], Arrays] | None:
        """The facts and arrays last saved, rows and index cut to that place; None (and no rows) where it was other work."""
        kept, arrays = _loaded(self._folder / _STATE)
        lengths = kept.get("lengths", [0, 0])
        fits = kept.get("identity") == identity and lengths == [
            min(length, os.fstat(file.fileno()).st_size)
            for length, file in zip(lengths, (self.rows, self.index), strict=True)
        ]
        for file, length in zip((self.rows, self.index), lengths if fits else (0, 0), strict=True):
            file.truncate(length)
            file.seek(length)
        return (kept["facts"], arrays) if fits else None

    def save(self, identity: str, facts: dict[str, Any], arrays: Arrays) -> None:
        """From now on, a killed process loses nothing that was appended so far."""
        for file in (self.rows, self.index):
            file.flush()
            os.fsync(file.fileno())
        text = json.dumps({"identity": identity, "lengths": [self.rows.tell(), self.index.tell()], "facts": facts})
        made = io.BytesIO()
        named: dict[str, Any] = {"text": np.array(text), **arrays}
        np.savez(made, **named)
        beside = self._folder / f"{_STATE}.new"
        with beside.open("wb") as file:
            file.write(made.getbuffer())
            file.flush()
            os.fsync(file.fileno())
        beside.replace(self._folder / _STATE)

    def finish(self, head: bytes, tail: bytes) -> None:
        """Put *head*, the rows and *tail* under the final name."""
        whole = Path(self.rows.name)
        if head:
            whole = self._folder / _WHOLE
            self.rows.flush()
            self.rows.seek(0)
            with whole.open("wb") as file:
                file.write(head)
                shutil.copyfileobj(self.rows, file, 2**20)
                file.write(tail)
                file.flush()
                os.fsync(file.fileno())
        else:
            self.rows.write(tail)
            self.rows.flush()
            os.fsync(self.rows.fileno())
        self.rows.close()
        whole.replace(self._target)
        self.discard()

    def discard(self) -> None:
        """Forget all that was written."""
        self.rows.close()
        self.index.close()
        shutil.rmtree(self._folder, ignore_errors=True)


@contextmanager
def partial(target: Path) -> Iterator[Partial]:
    """What is there of *target*, or the beginning of it, for this process alone.

    Raises :class:`FormatError` where another process is at it, or the folder cannot be written to; then what was saved
    stays for the next time.
    """
    folder, owned = target.with_name(f"{shortened(target.name, 200)}.partial"), False
    try:
        folder.mkdir(exist_ok=True)
        with (folder / _LOCK).open("ab") as lock:
            _lock(target, lock)
            owned = True
            with (folder / "rows").open("ab+") as rows, (folder / "index").open("ab+") as index:
                yield Partial(folder, target, rows, index)
    except OSError as problem:
        kept = f"; what is written so far stays in {folder.name}, the same command goes on from it"
        said = kept if (folder / _STATE).exists() else ""
        raise FormatError(f"{target}: cannot be written: {problem.strerror or problem}{said}") from None
    finally:
        if owned and not (folder / _STATE).exists():
            shutil.rmtree(folder, ignore_errors=True)  # nothing to go on from


def _lock(target: Path, lock: BinaryIO) -> None:
    """Hold *lock* as long as this process lives, where the system has such locks."""
    with suppress(ImportError):
        import fcntl

        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise FormatError(f"{target}: another process is writing it; wait for it, or give another name") from None


def _loaded(path: Path) -> tuple[dict[str, Any], Arrays]:
    try:
        with np.load(path, allow_pickle=False) as found:
            arrays = {name: found[name] for name in found.files}
        kept = json.loads(str(arrays.pop("text")))
        return (kept, arrays) if isinstance(kept, dict) else ({}, {})
    except Exception:  # none there, or damaged: the work begins anew
        return {}, {}
