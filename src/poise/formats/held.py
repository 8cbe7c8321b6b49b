"""Slower sensors whose last sample a logger repeats: every sample must count once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_LONGEST = 200  # rows
_LEAST = 0.5  # share of rows that must repeat the one before


def usual_distance(rows: Floats) -> int:
    """How many of *rows* (n, 3) a sample is repeated over; 0 where nothing is held.

    A sensor is held when most rows repeat the one before and changes come at a usual distance.
    """
    changed = np.concatenate([[True], (rows[1:] != rows[:-1]).any(axis=1)])
    if len(rows) <= 100 or not 3 <= changed.sum() <= (1.0 - _LEAST) * len(rows):
        return 0
    distances = np.diff(np.flatnonzero(changed))
    usual = int(np.median(distances))
    # Chance on a coarse grid makes changes at any distance; a held sensor never changes early.
    return usual if 2 <= usual <= _LONGEST and np.mean(distances < 0.6 * usual) <= 0.05 else 0


class Fresh:
    """Tells which rows hold a new sample of a sensor that is held over *usual* rows, one block after another.

    A value that stays longer than usual (a sensor at rest on a coarse grid) counts as a new sample every so many rows.
    """

    def __init__(self, usual: int) -> None:
        self.usual = usual
        self._last: list[float] | None = None
        self._since = 0  # rows since the last change, at the last row

    def of(self, rows: Floats) -> NDArray[np.bool_]:
        """(n,) which of the next *rows* (n, 3) hold a new sample."""
        if not len(rows):
            return np.empty(0, bool)
        before = np.full(3, np.nan) if self._last is None else np.array(self._last)
        changed = (np.vstack([before, rows[:-1]]) != rows).any(axis=1)
        starts = np.concatenate([[-1 - self._since], np.flatnonzero(changed)])
        since = np.arange(len(rows)) - starts[np.cumsum(changed)]
        self._last, self._since = rows[-1].tolist(), int(since[-1])
        return np.asarray(since % self.usual == 0)

    def state(self) -> Any:
        """What :meth:`restore` needs to go on in another process."""
        return [self._last, self._since]

    def restore(self, state: Any) -> None:
        """Go on after the rows that :meth:`state` was taken behind."""
        self._last, self._since = state


def fresh(rows: Floats) -> tuple[NDArray[np.bool_], int] | None:
    """Which of *rows* (n, 3) hold a new sample, and how many rows each stands for; None where nothing is held."""
    usual = usual_distance(rows)
    return (Fresh(usual).of(rows), usual) if usual else None
