"""Quantiles of how long samples waited, without keeping them all."""

from __future__ import annotations

from math import log

import numpy as np
from numpy.typing import NDArray

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


class WaitsOf:
    """The same for each of many devices, by their numbers: one row of a table each, since a call each would cost more."""

    def __init__(self) -> None:
        self._counts = np.zeros((16, _BINS), np.float32)
        self._entries = np.zeros(16, np.int64)

    def add(self, numbers: NDArray[np.intp], seconds: NDArray[np.float64]) -> None:
        """One more wait of each of the devices *numbers*, none of them twice."""
        while int(numbers.max()) >= len(self._counts):
            self._counts = np.concatenate([self._counts, np.zeros_like(self._counts)])
            self._entries = np.concatenate([self._entries, np.zeros_like(self._entries)])
        bins = (np.log(np.maximum(seconds, _LEAST) / _LEAST) / log(_STEP)).astype(np.intp)
        self._counts[numbers, np.minimum(bins, _BINS - 1)] += 1.0
        self._entries[numbers] += 1
        old = numbers[self._entries[numbers] % _EVERY == 0]
        if len(old):
            self._counts[old] *= _FADE

    def quantiles(self, numbers: list[int], share: float) -> list[float]:
        """s below which *share* of the waits of each device lie; 0 before the first."""
        known = np.array([number if number < len(self._counts) else 0 for number in numbers], np.intp)
        seen = np.cumsum(self._counts[known], axis=1)
        found = _LEAST * _STEP ** (1.0 + np.argmax(seen >= share * seen[:, -1:], axis=1))
        some = (seen[:, -1] > 0.0) & (known == np.array(numbers, np.intp))
        return [float(value) for value in np.where(some, found, 0.0)]
