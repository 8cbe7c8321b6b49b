"""The binary frames between devices, server and viewers, little-endian; docs/live.md, "Wire protocol", has them for people.

Both kinds begin with 16 bytes: version, kind, size of a record, number of records, a sequence or frame number.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.errors import PoiseError
from poise.estimators.loop import WIDTH

Floats = NDArray[np.float64]

VERSION = 1
SAMPLES, ATTITUDES, MOTION = 1, 2, 3
HEADER = struct.Struct("<BBHIQ")
UNNUMBERED = 2**64 - 1
"""The sequence number of a device that does not count its samples: the server counts them."""
MOST_NUMBER = 2**62
"""the largest number that a device may give a sample: what follows is counted from there, and must never overflow"""
MOST_SAMPLES = 4096
"""in one frame"""
FARTHEST = 1e12
"""s from zero that a stamp may be: further away a float does not tell 0.1 ms, and sums of two stamps may overflow"""
_STAMPS = {80: struct.Struct("<d72x"), 96: struct.Struct("<d88x")}
_SIZES = (80, 8 * WIDTH)  # time, gyr, acc, mag; and with acc_age, mag_age

ATTITUDE = np.dtype(
    {
        "names": [
            "device", "flags", "time", "host", "sequence", "quat", "rate", "sigma", "gyr", "acc", "mag",
            "method", "valid", "tip", "flags_since",
        ],
        "formats": [
            "<u4", "<u4", "<f8", "<f8", "<u8", "(4,)<f4", "(3,)<f4", "(3,)<f4", "(3,)<f4", "(3,)<f4", "(3,)<f4",
            "u1", "u1", "u1", "<u4",
        ],
        "offsets": [0, 4, 8, 16, 24, 32, 48, 60, 72, 84, 96, 108, 109, 110, 112],
        "itemsize": 120,
    }
)  # fmt: skip
"""One record of a frame of attitudes."""
NOT_MONITORED = 255
"""``tip`` of a device without a monitor."""


class FrameError(PoiseError):
    """A frame that a device should not have sent."""


class Head(NamedTuple):
    """What a frame of samples says about itself."""

    size: int
    """bytes a sample"""
    samples: int
    sequence: int
    """of the first sample, or UNNUMBERED"""


def head(frame: bytes, of: int = SAMPLES) -> Head:
    """The header of a frame of the kind *of*: samples, raw motion.

    Raises :class:`FrameError` unless the frame is whole and of this version.
    """
    if len(frame) < HEADER.size:
        raise FrameError(f"a frame begins with {HEADER.size} bytes of header; this one has {len(frame)} bytes")
    version, kind, size, count, sequence = HEADER.unpack_from(frame)
    if len(frame) == HEADER.size + size * count and version == VERSION and kind == of:
        check_number(sequence)
        known = size in _SIZES[: 1 if of == MOTION else 2]
        if known and 0 < count <= MOST_SAMPLES:
            return Head(size, count, sequence)
        if known:
            raise FrameError(f"a frame holds 1 to {MOST_SAMPLES} samples, this one {count}")
        sizes = f"{_SIZES[0]}" if of == MOTION else f"{_SIZES[0]} or {_SIZES[1]}"
        raise FrameError(f"a sample has {sizes} bytes, this frame says {size}")
    if version != VERSION:
        raise FrameError(f"version {version}: this server speaks version {VERSION} (the first byte)")
    if kind != of:
        raise FrameError(f"kind {kind}: a device sends kind {SAMPLES}, samples (the second byte)")
    raise FrameError(
        f"{count} samples of {size} bytes need a frame of {HEADER.size + size * count} bytes, this one has {len(frame)}"
    )


def check_number(sequence: int) -> None:
    """Raises :class:`FrameError` for the number of a sample that a device cannot have got to."""
    if not 0 <= sequence <= MOST_NUMBER and sequence != UNNUMBERED:
        raise FrameError(f"sequence: expected a whole number from 0 to 2**62, or 2**64 - 1 for none, found {sequence}")


def check_stamps(stamps: Iterable[float]) -> None:
    """Raises :class:`FrameError` for a time that no clock shows. NaN and infinity pass: the guard knows missing stamps."""
    for stamp in stamps:
        if FARTHEST < abs(stamp) < inf:
            raise FrameError(f"time: expected seconds, at most {FARTHEST:g} from zero, found {stamp:g}")


def check_stamps_in(frame: bytes, size: int) -> None:
    """The same of a frame whose samples have *size* bytes; without an array, since it is done for each that comes."""
    for (stamp,) in _STAMPS[size].iter_unpack(memoryview(frame)[HEADER.size :]):
        if not -FARTHEST <= stamp <= FARTHEST:
            check_stamps((stamp,))


def samples(frame: bytes) -> Floats:
    """(n, 12) the rows of a frame, as the estimators' loop reads them."""
    found = head(frame)
    return widened(np.frombuffer(frame, "<f8", offset=HEADER.size).reshape(found.samples, -1))


def widened(values: Floats) -> Floats:
    """(n, 12) rows from (n, 10) or (n, 12) values; ages that are not told are 0."""
    rows = np.zeros((len(values), WIDTH))
    rows[:, : values.shape[1]] = values
    return rows


def encoded(rows: Floats, sequence: int = UNNUMBERED) -> bytes:
    """The frame of samples of *rows*, (n, 10) or (n, 12): time s, gyr rad/s, acc m/s², mag µT, perhaps two ages s."""
    dense = np.ascontiguousarray(rows, "<f8")
    return HEADER.pack(VERSION, SAMPLES, 8 * dense.shape[1], len(dense), sequence) + dense.tobytes()


def attitudes(records: NDArray[np.void], number: int) -> bytes:
    """The frame of *records* (:data:`ATTITUDE`); *number* counts the frames of the server."""
    return HEADER.pack(VERSION, ATTITUDES, ATTITUDE.itemsize, len(records), number) + records.tobytes()


def records(frame: bytes) -> NDArray[np.void]:
    """The records of a frame of attitudes. Raises :class:`FrameError` for another frame."""
    if len(frame) < HEADER.size:
        raise FrameError(f"a frame begins with {HEADER.size} bytes of header; this one has {len(frame)} bytes")
    version, kind, size, count, _ = HEADER.unpack_from(frame)
    if (version, kind, size) != (VERSION, ATTITUDES, ATTITUDE.itemsize) or len(frame) != HEADER.size + size * count:
        raise FrameError("not a frame of attitudes of this version")
    return np.frombuffer(frame, ATTITUDE, offset=HEADER.size)
