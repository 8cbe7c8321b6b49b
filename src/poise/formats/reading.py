"""One file to one recording, whole or in chunks: recognise, read, make sure of the units."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from poise.data.recording import Recording
from poise.errors import RecordingError
from poise.formats import bag, mat, npz, parquet, recognise, text
from poise.formats.assemble import Sniffed
from poise.formats.chunks import Chunks, named
from poise.formats.limits import Limits, Options
from poise.formats.table import BLOCK

_DEFAULT = Limits()
_READERS = {"text": text.read, "parquet": parquet.read, "npz": npz.read, "mat": mat.read} | dict.fromkeys(
    bag.KINDS, bag.read
)


def read(
    path: str | os.PathLike[str],
    *,
    columns: str | Sequence[str] | None = None,
    units: Mapping[str, str] | None = None,
    delimiter: str | None = None,
    decimal: str | None = None,
    rate: float | None = None,
    topic: str | None = None,
    limits: Limits = _DEFAULT,
) -> Recording:
    """The recording in a file: a text table, Parquet, npz, MATLAB or ROS bag, recognised by its content.

    *columns* names the columns where the file does not, in order (``"time,gx,gy,gz,ax,ay,az"``, ``-`` skips one) or
    one by one (``"their_name=gyr_x"``); *units* says what the file does not (``{"gyr": "deg/s", "acc": "g"}``); *rate*
    (1/s) replaces the stamps; *topic* picks a bag's inertial unit, or both (``"/imu/data_raw,/imu/mag"``). Everything
    that was assumed or left out is in ``Recording.notes``. A file that does not fit into memory: :func:`read_chunks`.

    Raises :class:`FormatError` with the line, the column and what to do.
    """
    chunks = _chunks(path, Options(columns, dict(units or {}), delimiter, decimal, rate, topic, limits), None)
    with named(chunks.source):
        recording = Recording.joined(chunks)
        return recording.with_samples(notes=chunks.notes)


def read_chunks(
    path: str | os.PathLike[str],
    rows: int = BLOCK,
    *,
    columns: str | Sequence[str] | None = None,
    units: Mapping[str, str] | None = None,
    delimiter: str | None = None,
    decimal: str | None = None,
    rate: float | None = None,
    topic: str | None = None,
    limits: Limits = _DEFAULT,
) -> Chunks:
    """The recording of :func:`read`, with its options and errors, as consecutive recordings of *rows* rows each.

    Text and Parquet files take a memory that does not grow with the file; the other kinds are in memory as a whole.
    """
    if not isinstance(rows, int) or rows < 1:
        raise RecordingError(f"rows: expected a number above 0, found {rows!r}")
    return _chunks(path, Options(columns, dict(units or {}), delimiter, decimal, rate, topic, limits), rows)


def sniff(
    path: str | os.PathLike[str],
    *,
    columns: str | Sequence[str] | None = None,
    units: Mapping[str, str] | None = None,
    delimiter: str | None = None,
    decimal: str | None = None,
    rate: float | None = None,
    topic: str | None = None,
    limits: Limits = _DEFAULT,
) -> Sniffed:
    """What :func:`read` recognises in a file, with the same options and errors: rate, gaps, units, columns, doubts."""
    chunks = _chunks(path, Options(columns, dict(units or {}), delimiter, decimal, rate, topic, limits), None)
    for _ in chunks:
        pass
    return chunks.sniffed


def examine(
    path: str | os.PathLike[str],
    *,
    columns: str | Sequence[str] | None = None,
    units: Mapping[str, str] | None = None,
    delimiter: str | None = None,
    decimal: str | None = None,
    rate: float | None = None,
    topic: str | None = None,
    limits: Limits = _DEFAULT,
    as_is: bool = False,
) -> tuple[Recording, Sniffed]:
    """What :func:`read` and :func:`sniff` give, in one go.

    With *as_is* no unit is asked of the samples, and none refused for them: those that the file or *units* states are
    taken, SI where none does, so that what is wrong can be found out afterwards.
    """
    chunks = _chunks(path, Options(columns, dict(units or {}), delimiter, decimal, rate, topic, limits, as_is), None)
    with named(chunks.source):
        recording = Recording.joined(chunks).with_samples(notes=chunks.notes)
    return recording, chunks.sniffed


def _chunks(path: str | os.PathLike[str], options: Options, rows: int | None) -> Chunks:
    source = str(path)
    path = Path(path)
    recognise.check(source, path, options.limits)
    kind = recognise.kind(source, path)
    recognise.refuse_topic(source, kind, options.topic)
    reader = _READERS[kind]
    with named(source):
        table = reader(path, options)
        return Chunks(source, path, table, _digest(path), options, rows)


def _digest(path: Path) -> str:
    """SHA-256 of a file, or of a bag's files one after the other."""
    digest = hashlib.sha256()
    for part in recognise.files(path):
        with part.open("rb") as file:
            hashlib.file_digest(file, lambda: digest)
    return digest.hexdigest()
