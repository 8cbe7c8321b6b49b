"""Quantiles of how long samples waited, without keeping them all."""

from __future__ import annotations

from math import log

_LEAST, _STEP, _BINS = 1e-4, 1.1, 150  # s; a bin is 10 % wide, the last one begins at 150 s
_FADE = 0.5  # what is older counts half as much every
_EVERY = 2000  # entries


class Waits:
    """A histogram with bins of 10 % that fades: quantiles of the last few thousand entries."""

    def __init__(self) -> None:
        self._counts = [0.0] * _BINS
        self._entries = 0

    def add(self, seconds: float) -> None:
        """One more wait."""
        bin = int(log(max(seconds, _LEAST) / _LEAST) / log(_STEP))
        self._counts[min(bin, _BINS - 1)] += 1.0
        self._entries += 1
        if self._entries % _EVERY == 0:
            self._counts = [_FADE * count for count in self._counts]

    def quantile(self, share: float) -> float:
        """s below which *share* of the waits lie; 0 before the first."""
        wanted, seen = share * sum(self._counts), 0.0
        if not wanted:
            return 0.0
        for number, count in enumerate(self._counts):
            seen += count
            if seen >= wanted:
                return _LEAST * _STEP ** (number + 1)
        return _LEAST * _STEP**_BINS
