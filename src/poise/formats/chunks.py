"""A file as consecutive recordings of bounded size, and the place to go on from."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from poise.data.recording import Recording
from poise.errors import FormatError, RecordingError
from poise.formats.assemble import Assembler, Sniffed
from poise.formats.decisions import decide
from poise.formats.limits import Options
from poise.formats.table import Columns, Table, joined


@contextmanager
def named(where: str) -> Iterator[None]:
    """What goes wrong inside, as an error that names the file."""
    try:
        yield
    except RecordingError as problem:
        raise FormatError(f"{where}: {problem}") from None
    except OSError as problem:
        raise FormatError(f"{where}: cannot be read: {problem.strerror or problem}") from None
    except MemoryError:
        raise FormatError(f"{where}: does not fit into memory; split it") from None


class Chunks:
    """The recordings that a file is read as, one after another: iterate once. :func:`read_chunks` makes it.

    Every chunk but the last has as many rows as were asked for. Units, rate and repeated samples are decided once, from
    a sample of the file, so that the chunks together are the recording that :func:`read` gives, bit for bit.
    """

    def __init__(self, where: str, path: Path, table: Table, digest: str, options: Options, rows: int | None) -> None:
        self.source, self.source_hash, self.name = where, digest, path.stem
        self.options, self.rows = options, rows
        self._table = table
        with named(where):
            self._decided = decide(where, table, options)
            self._assembler = self._fresh()
        self._waiting: deque[list[Any]] = deque()  # blocks with rows to hand out: position, columns, rows handed out
        self._at: tuple[int, ...] | None = None
        self._skip = 0
        self._recordings = self._made()

    @property
    def empty(self) -> Recording:
        """A recording like the chunks, without rows."""
        return self._assembler.empty

    @property
    def done(self) -> int:
        """Rows handed out so far."""
        return self._assembler.rows

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be said about the file so far; all of it after the last chunk."""
        return self._assembler.notes()

    @property
    def sniffed(self) -> Sniffed:
        """What was recognised, counted over the chunks so far; the rate is that of the sample."""
        return self._assembler.sniffed()

    def sample(self) -> Recording:
        """Evenly spread stretches of the file, one behind the other, and all of a short file: what was decided from."""
        with named(self.source):
            return self._fresh().recording(self._table.rows.sample())

    def __iter__(self) -> Iterator[Recording]:
        return self._recordings

    def state(self) -> str:
        """The place behind the last chunk, as JSON text; see :meth:`go_on`."""
        front = self._waiting[0] if self._waiting else [self._at, None, self._skip]
        return json.dumps({"at": front[0], "skip": front[2], "assembler": self._assembler.state()})

    def go_on(self, state: str) -> None:
        """Go on behind the chunk after which :meth:`state` was called on the same file with the same options."""
        kept = json.loads(state)
        self._at, self._skip = (None if kept["at"] is None else tuple(kept["at"])), kept["skip"]
        self._assembler.restore(kept["assembler"])

    def _fresh(self) -> Assembler:
        return Assembler(self._table, self._decided, self.name, self.source, self.source_hash)

    def _made(self) -> Iterator[Recording]:
        with named(self.source):
            for columns in self._cut():
                recording = self._assembler.recording(columns)
                self.options.limits.check(self.source, "rows", self.done)
                yield recording

    def _cut(self) -> Iterator[Columns]:
        ready = 0
        for position, columns in self._table.rows.blocks(self._at):
            count, skipped = _length(columns), min(self._skip, _length(columns))
            self._skip -= skipped
            self._waiting.append([position, columns, skipped])
            ready += count - skipped
            if self.rows is None and ready:
                yield self._taken(ready)
                ready = 0
            while self.rows is not None and ready >= self.rows:
                yield self._taken(self.rows)
                ready -= self.rows
        if ready:
            yield self._taken(ready)

    def _taken(self, rows: int) -> Columns:
        """The next *rows* of the blocks that wait; the last of them stays, for :meth:`state`."""
        parts = []
        while rows:
            while len(self._waiting) > 1 and self._waiting[0][2] == _length(self._waiting[0][1]):
                self._waiting.popleft()
            _, columns, used = front = self._waiting[0]
            front[2] = min(used + rows, _length(columns))
            rows -= front[2] - used
            parts.append({key: values[used : front[2]] for key, values in columns.items()})
        return joined(parts)


def _length(columns: Columns) -> int:
    return len(next(iter(columns.values())))
