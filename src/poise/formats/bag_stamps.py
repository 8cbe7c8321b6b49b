"""When a message's sample was taken: its header's stamp, or, where that says nothing, the time of its arrival."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Nanoseconds = NDArray[np.int64]

_NEAR_ZERO = 10 * 10**9  # ns: a clock that starts at 0 passes through here; the others' first stamps do not
_SAME_CLOCK = 1.0  # s between the usual delays of two topics whose headers count on one clock


class Clock(NamedTuple):
    """What the inertial unit's stamps count on, for the sensors beside it."""

    headers: bool
    """whether its headers have stamps; if not, times are those of arrival"""
    delay: float
    """s, the usual time from the header's stamp to the arrival"""


def of_imu(topic: str, received: Nanoseconds, stamp: Nanoseconds, notes: list[str]) -> tuple[Floats, Clock]:
    """The times (n,) s of the inertial unit's messages, NaN where one has none, and the clock they count on."""
    if not _tells(stamp):
        what = "zero" if not stamp.any() else "the same"
        notes.append(f"time: the header stamps of {topic} are {what} in every message; the times of arrival are used")
        return seconds(received), Clock(False, 0.0)
    time = seconds(stamp)
    unset = stamp == 0
    if unset.any() and stamp[~unset].min() > _NEAR_ZERO:
        time[unset] = np.nan
        notes.append(f"time: {int(unset.sum())} header stamps of {topic} are zero: no time")
    return time, Clock(True, float(np.nanmedian(seconds(received) - time)))


def of_other(topic: str, received: Nanoseconds, stamp: Nanoseconds, clock: Clock, notes: list[str]) -> Floats:
    """The times (n,) s of another sensor's messages on the same *clock*."""
    arrival = seconds(received) - clock.delay
    if not clock.headers:
        return arrival
    time = seconds(stamp)
    if _tells(stamp) and abs(float(np.median(arrival - time))) < _SAME_CLOCK:
        return time
    why = "count on another clock" if _tells(stamp) else "say nothing"
    notes.append(f"time: the header stamps of {topic} {why}; its times are those of arrival less the usual delay")
    return arrival


def seconds(nanoseconds: Nanoseconds) -> Floats:
    """*nanoseconds* (n,) in s, each rounded once."""
    return np.asarray(nanoseconds // 10**9 + (nanoseconds % 10**9) / 1e9)


def nanoseconds(time: Floats) -> Nanoseconds:
    """*time* (n,) s, each rounded to a whole ns; :func:`seconds` gives it back within 1 ns, not always bit for bit."""
    whole = np.floor(time)
    return np.asarray(whole.astype(np.int64) * 10**9 + np.rint((time - whole) * 1e9).astype(np.int64))


def _tells(stamp: Nanoseconds) -> bool:
    return bool((stamp != stamp[0]).any()) or (len(stamp) == 1 and bool(stamp[0]))
