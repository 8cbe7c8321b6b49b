"""The journal: blocks of samples, attitudes and checkpoints, appended one after another, each with its checksum.

A block is magic, kind, lengths of its JSON head and of its arrays, and the CRC-32 of all that follows; then the head and the
arrays. What does not fit its checksum, and everything behind it, is a torn tail.
"""

from __future__ import annotations

import json
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
_MOST = 1 << 31  # bytes in a block: a length beyond that is none


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


def read(path: Path) -> Iterator[Block | Torn]:
    """The blocks of a journal file; at the end a :class:`Torn` where there is more that is no block."""
    with path.open("rb") as file:
        size, good = os.fstat(file.fileno()).st_size, 0
        while good < size:
            block = _block(file.read(_HEAD.size), file)
            if block is None:
                yield Torn(good, size - good)
                return
            good = file.tell()
            yield block


class Torn(NamedTuple):
    """Where the good blocks of a file end, and how many bytes follow."""

    good: int
    torn: int


def _block(start: bytes, file: Any) -> Block | None:
    if len(start) < _HEAD.size:
        return None
    magic, kind, text_length, length, check = _HEAD.unpack(start)
    if magic != _MAGIC or text_length + length > _MOST:
        return None
    body = file.read(text_length + length)
    found = zlib.crc32(body, zlib.crc32(struct.pack("<IIQ", kind, text_length, length)))
    if len(body) != text_length + length or found != check:
        return None
    head = json.loads(body[:text_length])
    n, m = head.get("rows", 0), head.get("out", 0)
    at = text_length
    rows = np.frombuffer(body, "<f8", n * WIDTH, at).reshape(n, WIDTH)
    table = np.frombuffer(body, "<f8", m * COLUMNS, at + rows.nbytes).reshape(m, COLUMNS)
    flags = np.frombuffer(body, "<u4", m, at + rows.nbytes + table.nbytes)
    return Block(kind, head, rows, table, flags)
