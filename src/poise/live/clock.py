"""A device's clock against the host's: offset and drift from stamps that arrive late, never early."""

from __future__ import annotations

from math import inf, isfinite, nan

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_BIN = 1.0  # s of device time of which only the least delayed packet counts
_BINS = 120  # how many of them are kept
_FIT = 8  # bins before a drift is believed
_JUMP = 1.0  # s: no network delays by that, but a clock that is set does
_PATIENCE = 5.0  # s that packets may come later than by _JUMP before the clock is held to be set
_MOST_DRIFT = 0.02  # of an RC oscillator
_STANDS, _MOST_STANDS = 0.05, 0.5  # s that samples may come without the clock going on: at least, and whatever is usual
_USUAL = 3.0  # times as long as usual


class DeviceClock:
    """Maps stamps of one device to the host's time.

    A packet's delay is never negative, so host − device lies above a line whose level is offset (with the least delay of
    the link in it) and whose slope is drift. The line is the edge of the points' lower convex hull below their middle,
    which has the least sum of distances (Moon, Skelly and Towsley 1999). Jitter lies above it and drops out.
    """

    def __init__(self) -> None:
        self.restarts = -1
        """how often the device's clock was set"""
        self.late = 0.0
        """s that the last packet came later than the line says"""
        self._late_since = inf
        self._restart(nan)

    def _restart(self, device: float) -> None:
        self.restarts += 1
        self._zero, self._level, self._slope = device, inf, 0.0
        self._newest, self._bin = -inf, -1
        self._at: list[float] = []
        self._delays: list[float] = []

    def update(self, device: float, host: float) -> None:
        """A packet whose last sample is stamped *device* (s) has arrived at *host* (s)."""
        if not (isfinite(device) and isfinite(host)):
            return
        if not isfinite(self._zero):
            self._zero = device
        self.late = late = host - self.host(device) if self._at else 0.0
        if late < -_JUMP or (device < self._newest - _JUMP and abs(late) > _JUMP) or self._stays_late(late, host):
            self._restart(device)
        elapsed, delay = device - self._zero, host - device
        number = int(elapsed // _BIN)
        if number > self._bin:
            self._bin = number
            self._at.append(elapsed)
            self._delays.append(delay)
            del self._at[:-_BINS], self._delays[:-_BINS]
            self._fit()
        elif delay < self._delays[-1]:
            self._at[-1], self._delays[-1] = elapsed, delay
        self._newest = max(self._newest, device)
        if delay < self._level + self._slope * elapsed:  # nothing arrives before it was sent
            self._level = delay - self._slope * elapsed

    def _stays_late(self, late: float, host: float) -> bool:
        if late <= _JUMP:
            self._late_since = inf
            return False
        self._late_since = min(self._late_since, host)
        if host - self._late_since < _PATIENCE:
            return False
        self._late_since = inf
        return True

    def _fit(self) -> None:
        at, delays = self._at[:-1], self._delays[:-1]  # the last bin has only begun
        if len(at) < _FIT:
            self._level, self._slope = min(self._delays), 0.0
            return
        hull: list[int] = []
        for i in range(len(at)):
            while len(hull) > 1 and _turns_down(at, delays, hull[-2], hull[-1], i):
                hull.pop()
            hull.append(i)
        middle = sum(at) / len(at)
        right = next(k for k in range(1, len(hull)) if at[hull[k]] >= middle or k == len(hull) - 1)
        a, b = hull[right - 1], hull[right]
        slope = (delays[b] - delays[a]) / (at[b] - at[a])
        self._slope = min(max(slope, -_MOST_DRIFT), _MOST_DRIFT)
        self._level = min(d - self._slope * t for t, d in zip(self._at, self._delays, strict=True))

    def host(self, device: float) -> float:
        """s of the host when the device's clock shows *device*, the least delay of the link included; NaN before a packet."""
        return device + self._level + self._slope * (device - self._zero) if self._at else nan

    def device(self, host: float) -> float:
        """s of the device's clock at *host*: the inverse of :meth:`host`."""
        if not self._at:
            return nan
        return (host - self._level + self._slope * self._zero) / (1.0 + self._slope)

    @property
    def line(self) -> tuple[float, float]:
        """(a, b) with host = a + b · device, for many stamps at once; NaN before a packet."""
        return (self._level - self._slope * self._zero, 1.0 + self._slope) if self._at else (nan, nan)

    @property
    def offset(self) -> float:
        """s that the host is ahead of the device at its newest stamp, the least delay included."""
        return self.host(self._newest) - self._newest if self._at else nan

    @property
    def drift_ppm(self) -> float:
        """How much the host's clock gains on the device's, in 1e-6; 0 until it is known."""
        return 1e6 * self._slope


def _turns_down(at: list[float], values: list[float], a: int, b: int, c: int) -> bool:
    """Whether the point b lies on or above the line from a to c."""
    return (values[b] - values[a]) * (at[c] - at[a]) >= (values[c] - values[a]) * (at[b] - at[a])


class Standstill:
    """Whether a device's clock stands still while its samples come: then nothing tells how fast it turns, or falls.

    Packets whose samples share a stamp are no standstill: how long they usually last is followed. More than 0.5 s is one
    whatever is usual, since for so long nobody would see a fall.
    """

    def __init__(self) -> None:
        self.stamp = nan
        """s, the last one that was a number"""
        self.standing = False
        self._moved = nan  # s of the host
        self._usual = 0.0  # s between moves

    def see(self, stamps: Floats, last: float, host: float) -> None:
        """Samples with these *stamps*, the *last* of them once more, have arrived at *host* (s)."""
        moves = self.stamp < last < inf  # nearly always
        if moves:
            self.stamp = last
        if moves or self._moves(stamps):
            if isfinite(self._moved):
                lasted = host - self._moved
                self._usual += 0.5 * (min(lasted, 4.0 * self._usual) - self._usual) if self._usual else lasted
            self._moved, self.standing = host, False
        elif isfinite(self._moved):
            most = min(max(_STANDS, _USUAL * self._usual), _MOST_STANDS)
            self.standing = host - self._moved >= most - 1e-9
        else:
            self._moved = host  # no stamp was a number yet

    def _moves(self, stamps: Floats) -> bool:
        known = np.concatenate([[self.stamp], stamps])
        known = known[np.isfinite(known)]
        first = not isfinite(self.stamp)
        if len(known):
            self.stamp = float(known[-1])
        return bool((np.diff(known) > 0.0).any()) or (first and len(known) > 0)
