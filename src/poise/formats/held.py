"""Slower sensors whose last sample a logger repeats: every sample must count once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_LONGEST = 200  # rows
_LEAST = 0.5  # share of rows that must repeat the one before


def fresh(rows: Floats) -> tuple[NDArray[np.bool_], int] | None:
    """Which of *rows* (n, 3) hold a new sample, and how many rows each stands for; None where nothing is held.

    A sensor is held when most rows repeat the one before and changes come at a usual distance. A value that stays longer
    than that (a sensor at rest on a coarse grid) counts as a new sample every so many rows.
    """
    changed = np.concatenate([[True], (rows[1:] != rows[:-1]).any(axis=1)])
    if len(rows) <= 100 or not 3 <= changed.sum() <= (1.0 - _LEAST) * len(rows):
        return None
    starts = np.flatnonzero(changed)
    distances = np.diff(starts)
    usual = int(np.median(distances))
    # Chance on a coarse grid makes changes at any distance; a held sensor never changes early.
    if not 2 <= usual <= _LONGEST or np.mean(distances < 0.6 * usual) > 0.05:
        return None
    since = np.arange(len(rows)) - starts[np.cumsum(changed) - 1]
    return since % usual == 0, usual
