"""From a file of samples to a file of attitudes in a memory that does not grow, and on again after a kill."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, Protocol

import numpy as np

from poise.data.attitude import Attitude, HeadingReference
from poise.data.recording import Recording
from poise.errors import FormatError, PoiseError
from poise.estimators.batch import feed
from poise.estimators.engine import Stream
from poise.estimators.wrapping import at_gravity
from poise.formats import writing
from poise.formats.chunks import Chunks
from poise.formats.limits import Limits
from poise.formats.partial import Arrays, partial
from poise.version import __version__

KINDS = ("parquet", "csv", "tum")
_EVERY = 2.0  # s between the places that a killed run goes on from


class Account(Protocol):
    """Something that is kept of all rows while they pass, in a bounded memory."""

    def add(self, recording: Recording, attitude: Attitude) -> None:
        """The next rows."""

    def state(self) -> Arrays:
        """What :meth:`restore` needs to go on."""

    def restore(self, state: Arrays) -> None:
        """Go on where :meth:`state` was taken."""


@dataclass(frozen=True)
class Written:
    """What :func:`estimate_file` wrote."""

    path: Path
    rows: int
    valid: float
    """share of the rows that may be acted on; NaN without rows"""
    flags: int
    """every flag that any row has"""
    resumed: int
    """rows that an earlier, interrupted run had written"""
    heading_reference: HeadingReference
    learned: Mapping[str, Any] | None
    """as in :class:`Attitude`, by the last row"""


def estimate_file(
    chunks: Chunks,
    target: str | Path,
    method: Any,
    *,
    format: Literal["parquet", "csv", "tum"] | None = None,
    frame: Literal["enu", "ned", "nwu"] = "enu",
    correct: Callable[[Recording], Recording] | None = None,
    corrected_by: str = "",
    heading_reference: HeadingReference | None = None,
    accounts: Mapping[str, Account] | None = None,
    progress: Callable[[int], None] | None = None,
    **options: Any,
) -> Written:
    """Write the attitudes that *method* finds in a file's *chunks* (:func:`read_chunks`) to *target*.

    The file is, byte for byte, what :func:`write` makes of :func:`estimate` on the whole recording. Where a run is killed
    or cannot go on (a full disk), what it wrote stays in ``TARGET.partial``, and the same call goes on from there, to the
    same bytes. *correct* is done to every chunk, row by row (:meth:`Recording.remap`), and *corrected_by* names it, so that a
    run does not go on from one that was corrected otherwise; *heading_reference* replaces "magnetic", where the method was told
    the declination; *accounts* see all rows pass; *options* are those of :class:`Stream`.

    Raises :class:`FormatError` where a row cannot be read or the file cannot be written.
    """
    target = Path(target)
    kind = format or writing.SUFFIXES.get(target.suffix.lower(), "")
    if kind not in KINDS:
        raise FormatError(
            f"{target}: {kind or target.suffix or 'no extension'} cannot be written in chunks; expected {', '.join(KINDS)}"
        )
    run = _Run(chunks, Stream(at_gravity(method, chunks.empty.gravity), **options), dict(accounts or {}))
    shape = _Shape(kind, frame, heading_reference)
    identity = _identity(run, shape, corrected_by, options)
    with partial(target) as place:
        found = place.load(identity)
        if found is not None:
            run.go_on(*found)
        resumed = run.counts["rows"]
        try:
            body = writing.body(kind, place.rows, place.index, writing.columns(kind, shape.attitude(run.told())))
            saved = time.monotonic()
            for recording, attitude in run.pairs(shape, correct):
                for table in writing.tables(kind, attitude):
                    body.add(table)
                run.count(recording, attitude)
                if time.monotonic() - saved > _EVERY:
                    place.save(identity, *run.state())
                    saved = time.monotonic()
                if progress is not None:
                    progress(run.counts["rows"])
        except PoiseError:
            place.discard()  # the input is not right; once it is, it will be another file
            raise
        if run.counts["rows"] > resumed:
            place.save(identity, *run.state())
        final = shape.attitude(run.told())
        facts, said = final.metadata(), writing.comments(run.counts["unknown"] * (kind == "tum"), run.counts["rows"])
        head = body.head(facts, said)
        place.finish(head, body.tail(facts))
    rows = run.counts["rows"]
    valid = run.counts["valid"] / rows if rows else float("nan")
    return Written(target, rows, valid, run.counts["flags"], resumed, final.heading_reference, final.learned)


@dataclass(frozen=True)
class _Shape:
    """What the rows are written as."""

    kind: str
    frame: Literal["enu", "ned", "nwu"]
    heading: HeadingReference | None

    def attitude(self, attitude: Attitude) -> Attitude:
        if self.heading is not None and attitude.heading_reference == "magnetic":
            attitude = replace(attitude, heading_reference=self.heading)
        return attitude.to(self.frame)


class _Run:
    """One pass over the chunks, from wherever an earlier one got to."""

    def __init__(self, chunks: Chunks, stream: Stream, accounts: dict[str, Account]) -> None:
        self.chunks, self.stream, self.accounts = chunks, stream, accounts
        self.counts = {"rows": 0, "valid": 0, "unknown": 0, "flags": 0}

    def pairs(
        self, shape: _Shape, correct: Callable[[Recording], Recording] | None
    ) -> Iterator[tuple[Recording, Attitude]]:
        for chunk in self.chunks:
            recording = chunk if correct is None else correct(chunk)
            yield recording, shape.attitude(feed(self.stream, recording))

    def told(self) -> Attitude:
        """An attitude without rows that says what the stream says of all."""
        return feed(self.stream, self.chunks.empty)

    def count(self, recording: Recording, attitude: Attitude) -> None:
        self.counts["rows"] += len(attitude)
        self.counts["valid"] += int(attitude.valid.sum())
        self.counts["unknown"] += int(np.sum(~writing.has_attitude(attitude)))
        self.counts["flags"] |= int(np.bitwise_or.reduce(attitude.flags))
        for account in self.accounts.values():
            account.add(recording, attitude)

    def state(self) -> tuple[dict[str, Any], Arrays]:
        arrays = {f"{name}/{key}": array for name, kept in self.accounts.items() for key, array in kept.state().items()}
        return {"counts": self.counts, "chunks": self.chunks.state(), "stream": self.stream.save().decode()}, arrays

    def go_on(self, facts: dict[str, Any], arrays: Arrays) -> None:
        self.counts = facts["counts"]
        self.chunks.go_on(facts["chunks"])
        self.stream.restore(facts["stream"].encode())
        for name, account in self.accounts.items():
            own = {key.partition("/")[2]: array for key, array in arrays.items() if key.partition("/")[0] == name}
            account.restore(own)


def _identity(run: _Run, shape: _Shape, corrected_by: str, options: Mapping[str, Any]) -> str:
    """What must be the same for a run to go on from another's rows."""
    chunks, stream = run.chunks, run.stream
    told = {name: repr(value) for name, value in sorted(options.items()) if name != "start"}
    start = repr(stream._start)
    read = replace(chunks.options, limits=Limits())
    parts = [__version__, chunks.source, chunks.source_hash, repr(read), chunks.rows, stream.identity, told, start]
    return json.dumps([*parts, repr(shape), corrected_by, sorted(run.accounts)])
