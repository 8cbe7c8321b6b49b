"""What an attitude's flags say, told: stretches with a sentence, and the rows at which an attitude was set anew."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.flags import RESET, SENTENCES, Flag
from poise.math import arrays

Floats = NDArray[np.float64]
Flags = NDArray[np.uint32]


class Reason(NamedTuple):
    """A stretch of rows that carry the same flag."""

    flag: Flag
    start: float
    """s, time of the first row"""
    end: float
    """s, time of the last row"""
    samples: int
    sentence: str

    def __str__(self) -> str:
        return f"{self.start:.2f}-{self.end:.2f} s ({self.samples} samples): {self.sentence}"


class Reset(NamedTuple):
    """A row at which the attitude was set anew."""

    row: int
    time: float
    """s"""
    delta: tuple[float, float, float]
    """rad: the rotation vector, about the frame's axes, from the attitude of the row before to this one's"""


def reasons(time: Floats, flags: Flags, bridge: float) -> list[Reason]:
    """The stretches of every flag, in order of time; those less than *bridge* (s) apart are one."""
    found = []
    known = np.isfinite(time)
    clock = np.maximum.accumulate(np.where(known, time, time[known][0] if known.any() else 0.0))
    for flag in Flag:
        rows = np.flatnonzero(flags & np.uint32(flag))
        if len(rows):
            cuts = np.flatnonzero((np.diff(rows) > 1) & (np.diff(clock[rows]) > bridge)) + 1
            for stretch in np.split(rows, cuts):
                start, end = float(clock[stretch[0]]), float(clock[stretch[-1]])
                found.append(Reason(flag, start, end, len(stretch), SENTENCES[flag]))
    return sorted(found, key=lambda reason: (reason.start, reason.flag))


def resets(time: Floats, quat: Floats, flags: Flags) -> list[Reset]:
    """The rows flagged RESET that have an attitude before them, and the turn since that."""
    rows = np.flatnonzero(flags & np.uint32(RESET))
    known = np.isfinite(quat[:, 0])
    before = np.maximum.accumulate(np.where(known, np.arange(len(quat)), -1))
    rows = rows[(rows > 0) & known[rows]]
    rows = rows[before[rows - 1] >= 0]
    turns = arrays.rotation_vector(arrays.multiply(quat[rows], arrays.conjugate(quat[before[rows - 1]])))
    return [
        Reset(int(row), float(time[row]), (float(x), float(y), float(z)))
        for row, (x, y, z) in zip(rows, turns, strict=True)
    ]
