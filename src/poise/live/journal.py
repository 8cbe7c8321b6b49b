"""The journal: blocks of samples, attitudes and checkpoints, appended one after another, each with its checksum.

A block is magic, kind, lengths of its JSON head and of its arrays, and the CRC-32 of all that follows; then the head and the
arrays. What does not fit its checksum, up to the next block that does, was damaged; where none follows, it is a torn tail.
"""

from __future__ import annotations

import json
import mmap
import os
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import COLUMNS
from poise.estimators.loop import WIDTH
from poise.live.batch import Batch

Floats = NDArray[np.float64]

_HEAD = struct.Struct("<4sIIQI")
_MAGIC = b"PSJ1"
SAMPLES, CHECKPOINT = 1, 2


class Encoded(NamedTuple):
    """A block, ready to be written."""

    parts: tuple[bytes | memoryview, ...]
    size: int
    samples: int
    ends: dict[str, int]
    """device → the number behind its last sample here"""
    counts: dict[str, int]
    """device → its samples here"""


class Block(NamedTuple):
    """A block that was read."""

    kind: int
    head: dict[str, Any]
    rows: Floats
    table: Floats
    flags: NDArray[np.uint32]


def encoded_batch(batch: Batch) -> Encoded:
    """The block of a tick's samples and attitudes."""
    methods: dict[tuple[str, str, str], int] = {}
    spans, ends = [], {}
    counts = counted(batch)
    for device, run, first, rows, out in batch.spans:
        kind = (run.choice.name, run.choice.settings, run.stream.heading_reference)
        spans.append([device.name, first, rows.start, rows.stop, out.start, methods.setdefault(kind, len(methods))])
        ends[device.name] = first + rows.stop - rows.start
    head = {"spans": spans, "methods": list(methods), "rows": len(batch.rows), "out": len(batch.table)}
    arrays = [_bytes(values) for values in (batch.rows, batch.table, batch.flags)]
    return _encoded(SAMPLES, head, arrays, ends, counts)


def _bytes(values: Any) -> memoryview:
    """The memory of an array, not copied."""
    dense: Any = np.ascontiguousarray(values)
    return memoryview(dense).cast("B")


def counted(batch: Batch) -> dict[str, int]:
    """How many samples each device has in *batch*."""
    return {span.device.name: span.rows.stop - span.rows.start for span in batch.spans}


def encoded_checkpoint(device: str, following: int, runs: list[dict[str, Any]]) -> Encoded:
    """The block that says how *device* goes on from sample number *following*: its methods and their streams' state."""
    return _encoded(CHECKPOINT, {"device": device, "next": following, "runs": runs}, [], {}, {})


def _encoded(kind: int, head: Any, arrays: list[memoryview], ends: dict[str, int], counts: dict[str, int]) -> Encoded:
    text = json.dumps(head).encode()
    length = sum(len(values) for values in arrays)
    check = zlib.crc32(struct.pack("<IIQ", kind, len(text), length))
    body: list[bytes | memoryview] = [text, *arrays]
    for values in body:
        check = zlib.crc32(values, check)
    parts = (_HEAD.pack(_MAGIC, kind, len(text), length, check), *body)
    return Encoded(parts, _HEAD.size + len(text) + length, sum(counts.values()), ends, counts)


def append(file: int, blocks: list[Encoded]) -> None:
    """Writes *blocks* behind what is in the open *file* and returns once they are on the disk."""
    parts = [memoryview(part) for block in blocks for part in block.parts if len(part)]
    while parts:
        written = os.writev(file, parts[:512])
        while parts and written >= len(parts[0]):
            written -= len(parts.pop(0))
        if written:
            parts[0] = parts[0][written:]
    os.fdatasync(file)


def read(path: Path) -> Iterator[Block | Unreadable]:
    """The blocks of a journal file, and between or behind them an :class:`Unreadable` for bytes that are none."""
    with path.open("rb") as file:
        size, at = os.fstat(file.fileno()).st_size, 0
        while at < size:
            block = _block(file, size)
            if block is None:
                good = at
                at = _next_block(file, good + 1, size)
                yield Unreadable(good, at - good, at == size)
                file.seek(at)
                continue
            at = file.tell()
            yield block


class Unreadable(NamedTuple):
    """Bytes of a journal file that are no block."""

    start: int
    size: int
    tail: bool
    """nothing good follows: what was being written when it all ended"""

    @property
    def said(self) -> str:
        if self.tail:
            return f"a torn tail of {self.size} bytes was cut off"
        return f"{self.size} bytes from byte {self.start} on are damaged and left out; what follows them is kept"


def _next_block(file: Any, start: int, size: int) -> int:
    """Where the next good block is from *start* on; *size*, the end of the file, where there is none."""
    with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        while (start := content.find(_MAGIC, start)) >= 0:
            file.seek(start)
            if _block(file, size) is not None:
                return start
            start += 1
    return size


def _block(file: Any, size: int) -> Block | None:
    """The block that begins where *file*, of *size* bytes, is read next."""
    start = file.read(_HEAD.size)
    if len(start) < _HEAD.size:
        return None
    magic, kind, text_length, length, check = _HEAD.unpack(start)
    if magic != _MAGIC or text_length + length > size - file.tell():
        return None
    body = bytearray(
        text_length + length
    )  # bytes would make arrays that cannot be written: another type for the compiler
    file.readinto(body)
    found = zlib.crc32(body, zlib.crc32(struct.pack("<IIQ", kind, text_length, length)))
    if found != check:
        return None
    head = json.loads(body[:text_length])
    n, m = head.get("rows", 0), head.get("out", 0)
    at = text_length
    rows = np.frombuffer(body, "<f8", n * WIDTH, at).reshape(n, WIDTH)
    table = np.frombuffer(body, "<f8", m * COLUMNS, at + rows.nbytes).reshape(m, COLUMNS)
    flags = np.frombuffer(body, "<u4", m, at + rows.nbytes + table.nbytes)
    return Block(kind, head, rows, table, flags)
