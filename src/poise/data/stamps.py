"""Time stamps as a whole: the usual step from row to row, also of rows that came in packets, and clocks that begin anew."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

OFTEN = 0.3  # of the rows have no stamp of their own
RIGHT_AFTER = 0.25  # of the mean step: what follows sooner was stamped, or read, with the row before
_FEWEST = 20  # steps
_PAUSE = 5.0  # times all but the longest steps: what takes longer is no packet


class Packed(NamedTuple):
    """Rows of which many share a stamp, or have one right after that of the row before: they came in packets."""

    step: float
    """in the stamps' unit, from row to row in the mean"""
    fewest: int
    """rows of a packet, of all but 5 %"""
    most: int
    apart: float
    """between the stamps of a packet, of all but 5 %"""

    @property
    def words(self) -> str:
        rows = f"{self.fewest} to {self.most}" if self.fewest < self.most else f"{self.most}"
        return f"{rows} rows" + (
            " that share a stamp" if self.apart == 0.0 else f" stamped {1e3 * self.apart:.3g} ms apart"
        )


def rising_steps(time: Floats) -> Floats:
    """The steps (m,) between the stamps *time* (n,) that are forward and not beyond any number."""
    with np.errstate(invalid="ignore", over="ignore"):
        steps = np.diff(time)
        return np.asarray(steps[(steps > 0.0) & (steps < 1e300)])


def packed(time: Floats) -> Packed | None:
    """How the rows with the stamps *time* (n,), in any unit, came in packets; None where each has a stamp of its own."""
    with np.errstate(invalid="ignore", over="ignore"):
        steps = np.diff(time[np.isfinite(time)])
    forward = steps[(steps >= 0.0) & (steps < 1e300)]
    # With pauses the mean is too large and too many rows seem to follow at once: if even so they are few, that is all
    if len(forward) < _FEWEST or np.mean(forward < RIGHT_AFTER * np.mean(forward)) <= OFTEN:
        return None
    longest = float(np.quantile(forward, 0.98))
    mean = float(np.mean(forward[forward <= _PAUSE * longest]))
    within = (steps >= 0.0) & (steps < RIGHT_AFTER * mean)
    if np.mean(within) <= OFTEN:
        return None
    sizes = np.diff(np.flatnonzero(np.concatenate(([True], ~within, [True]))))
    fewest, most = (int(rows) for rows in np.quantile(sizes, [0.05, 0.95]))
    return Packed(mean, fewest, most, float(np.quantile(steps[within], 0.95)))


def usual_step(time: Floats) -> float:
    """In the unit of *time* (n,): the median step forward, or, of rows in packets, the mean; NaN where none rises."""
    steps = rising_steps(time)
    if not len(steps):
        return float("nan")
    packets = packed(time)
    return float(np.median(steps)) if packets is None else packets.step


class Turns:
    """Stamps of a clock that begins anew at one of *ends*, block after block: they go on.

    A step back passes the end where that makes it one of *most* at most; all in the stamps' unit.
    """

    def __init__(self, ends: Sequence[float], most: float) -> None:
        self._most = most
        self._passed = dict.fromkeys(ends, 0)
        self._before: float | None = None

    @property
    def passed(self) -> dict[float, int]:
        """How often which end was passed."""
        return {end: count for end, count in self._passed.items() if count}

    def of(self, time: Floats) -> Floats:
        """The next stamps (n,) as those of a clock that never begins anew; those that are none (NaN) stay."""
        known = np.flatnonzero(np.isfinite(time))
        if not len(known):
            return time
        stamps, added = time[known], np.zeros(len(known))
        steps = np.diff(stamps, prepend=stamps[0] if self._before is None else self._before)
        self._before = float(stamps[-1])
        for end, count in self._passed.items():
            passed = count + np.cumsum((steps < 0.0) & (steps + end <= self._most))
            self._passed[end] = int(passed[-1])
            added += end * passed
        if not added[-1]:
            return time
        time = time.copy()
        time[known] += added
        return time

    def state(self) -> Any:
        """What :meth:`restore` needs to go on in another process."""
        return [list(self._passed.values()), self._before]

    def restore(self, state: Any) -> None:
        """Go on after the stamps that :meth:`state` was taken behind."""
        self._passed, self._before = dict(zip(self._passed, state[0], strict=True)), state[1]
