"""One recording in its folder: journal files while it lasts, Parquet files of every device afterwards."""

from __future__ import annotations

import fcntl
import os
import shutil
from collections import defaultdict
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import COLUMNS, Attitude
from poise.errors import PoiseError
from poise.estimators.engine import Stream
from poise.live import journal, parts
from poise.live.methods import Choice

if TYPE_CHECKING:
    from poise.live.device import Device
    from poise.live.hub import Hub

Floats = NDArray[np.float64]

_JOURNAL = "journal"
_DONE = ".journal-done"  # nothing in it is needed


class SessionError(PoiseError):
    """A folder that cannot be recorded to, or recovered."""


@dataclass
class Found:
    """What the journal files of a session hold, read for one purpose or the other."""

    files: int = 0
    samples: int = 0
    damage: list[str] = field(default_factory=list)
    """a sentence for each tail that was cut, and for what was damaged before it"""


class Session:
    """The recording in *folder*; held against other processes from its making to :meth:`finish`.

    Raises :class:`SessionError` where the folder cannot be made or another process records there.
    """

    def __init__(self, folder: Path) -> None:
        self.folder, self.journal, self.root = folder, folder / _JOURNAL, folder
        try:
            self.journal.mkdir(parents=True, exist_ok=True)
            self._held = os.open(self.journal / "held", os.O_RDWR | os.O_CREAT, 0o644)
        except OSError as problem:
            raise SessionError(f"{folder}: cannot be recorded to: {problem.strerror}") from None
        try:
            fcntl.flock(self._held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(self._held)
            raise SessionError(f"{folder}: another process is recording there; end it first") from None
        self.number = max((number for number, _ in self.files()), default=0)
        self.found = Found()

    @classmethod
    def below(cls, folder: Path) -> Session:
        """The session below *folder* that was not finished, the youngest, or a new one named after the time."""
        for rest in folder.glob(f"*/{_DONE}"):
            shutil.rmtree(rest, ignore_errors=True)
        unfinished = interrupted(folder)
        name = datetime.now(UTC).strftime("%Y-%m-%dT%H-%M-%S")
        made = cls(unfinished[-1] if unfinished else _unused(folder / name))
        made.root = folder  # where its finished neighbours are
        return made

    def files(self) -> list[tuple[int, Path]]:
        """The journal files by their numbers."""
        return sorted((int(path.stem), path) for path in self.journal.glob("*.log") if path.stem.isdecimal())

    # -- writing --------------------------------------------------------------------------------------------------

    def new_file(self) -> int:
        """A new journal file, open for appending, its name durable."""
        self.number += 1
        path = self.journal / f"{self.number:06d}.log"
        file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_APPEND, 0o644)
        try:
            _sync(self.journal)
        except OSError:
            os.close(file)
            raise
        return file

    def failed(self) -> None:
        """The last file could not be written to; where nothing is in it, it goes."""
        path = self.journal / f"{self.number:06d}.log"
        with suppress(OSError):
            if path.stat().st_size == 0:
                path.unlink()

    def free(self, number: int) -> None:
        """Nothing after journal file *number* needs it, or one before it, to go on: they become Parquet files."""
        for each, path in self.files():
            if each <= number:
                self._convert(each, path)

    def _convert(self, number: int, path: Path) -> None:
        try:
            self.found.samples += parts.convert(path, number, self.journal)
            path.unlink()
        except (OSError, PoiseError):
            return  # the disk is full: `finish` tries again, and the journal file holds it all meanwhile

    def finish(self) -> list[Path]:
        """Everything in Parquet files, one a device and one a method of it; returns their names.

        Raises :class:`SessionError` where they cannot be written; then the journal stays, and `poise recover` goes on.
        """
        try:
            for number, path in self.files():
                self.found.samples += parts.convert(path, number, self.journal)
                path.unlink()
            made = parts.join(self.journal, self.folder)
            _sync(self.folder)
            done = self.folder / _DONE  # at once: who goes on from some of the parts would make shorter files of them
            self.journal.rename(done)
            shutil.rmtree(done, ignore_errors=True)
            os.close(self._held)
            if not made:
                with suppress(OSError):
                    self.folder.rmdir()
        except OSError as problem:
            raise SessionError(f"{self.folder}: {problem.strerror or problem}; `poise recover` goes on") from None
        return made

    # -- going on -------------------------------------------------------------------------------------------------

    def cut(self) -> Found:
        """Cuts torn tails off the journal files; what was found in them."""
        for _, path in self.files():
            self.found.files += 1
            for _ in self._blocks(path):
                pass
        return self.found

    def _blocks(self, path: Path) -> Iterator[journal.Block]:
        """The good blocks of a journal file, whose torn tail is cut off."""
        for block in journal.read(path):
            if isinstance(block, journal.Block):
                yield block
                continue
            self.found.damage.append(f"{path.name}: {block.said}")
            if block.tail:
                os.truncate(path, block.start)

    def resume(self, hub: Hub) -> None:
        """Puts the devices of an interrupted session back into *hub*, where they were: numbers at once, streams by the
        hub's next ticks."""
        last: dict[str, dict[str, Any]] = {}
        since: dict[str, list[tuple[int, Floats]]] = defaultdict(list)
        for _, path in self.files():
            for block in self._blocks(path):
                if block.kind == journal.CHECKPOINT:
                    last[block.head["device"]] = block.head
                    since[block.head["device"]].clear()
                    continue
                once = {name: (first, start, stop) for name, first, start, stop, *_ in block.head["spans"]}
                for name, (first, start, stop) in once.items():  # not once a method
                    since[name].append((first, block.rows[start:stop]))
        for text in self.found.damage:
            hub.event("damage", None, f"{self.folder.name}/{text}")
        for name in last | since:
            device = hub.restored(name)
            rows = since[name]
            head = last.get(
                name, {"runs": []}
            )  # its checkpoint was damaged: it goes on as a new device, but for its numbers
            device.next = rows[-1][0] + len(rows[-1][1]) if rows else head["next"]
            device.to_restore = (head, [part for _, part in rows])
        if last:
            hub.event("resumed", None, f"{len(last)} devices go on in {self.folder.name}")


def rebuilt(device: Device) -> list[tuple[Choice, Attitude | None, Stream]]:
    """The streams of a device's checkpoint after the samples since, each with its choice and what it was started at.

    Raises :class:`StateError` where another version of a method wrote it.
    """
    head, rows = device.to_restore
    return [_stream_of(run, rows) for run in head["runs"]]


def _stream_of(run: dict[str, Any], rows: list[Floats]) -> tuple[Choice, Attitude | None, Stream]:
    choice, start = Choice(run["name"], run["settings"]), None
    if run["start"] is not None:
        quat, bias, heading = run["start"]
        start = Attitude.of([0.0], [quat], heading_reference=heading)
        start.bias[:] = bias
    stream = choice.stream(start).restore(run["saved"].encode())
    for part in rows:
        stream.update_rows(part, np.empty((len(part), COLUMNS)), np.empty(len(part), np.uint32))
    return choice, start, stream


def interrupted(folder: Path) -> list[Path]:
    """The sessions in or below *folder* that were not finished, the oldest first."""
    if (folder / _JOURNAL).is_dir():
        return [folder]
    return sorted(path.parent for path in folder.glob(f"*/{_JOURNAL}") if path.is_dir())


def _unused(folder: Path) -> Path:
    found, n = folder, 1
    while found.exists():
        n += 1
        found = folder.with_name(f"{folder.name}-{n}")
    return found


def _sync(folder: Path) -> None:
    opened = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)
