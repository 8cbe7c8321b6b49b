"""The flagship with the future known: `smooth` runs the causal filter, then goes back over its blocks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.data.attitude import Attitude
from poise.data.flags import KNOWN
from poise.data.learned import Learned
from poise.data.recording import Recording
from poise.errors import MethodError, RecordingError
from poise.estimators.engine import Stream, at_gravity, feed
from poise.estimators.self_calibrating.backward import apply, back
from poise.estimators.self_calibrating.causal import SelfCalibrating
from poise.estimators.self_calibrating.model import COLUMNS as WIDTH
from poise.estimators.self_calibrating.model import ENTRIES, ENTRY, SENSOR, SIZE, Floats
from poise.math import arrays
from poise.math.vectors import Vec3

Indices = NDArray[np.int64]

_PART = 8192  # rows of a recording at a time
_INDEX = np.uint32(28)  # from this bit of the flags on the log's entries are counted
_KNOWN = np.uint32(KNOWN)  # the flags below it


def smooth(
    recording: Recording,
    method: SelfCalibrating | None = None,
    start: Attitude | ArrayLike | None = None,
    *,
    bias: ArrayLike = (0.0, 0.0, 0.0),
    guard: bool = True,
    window: float = 600.0,
    overlap: float = 200.0,
    start_from: Learned | Attitude | None = None,
    learning: float | None = None,
    progress: Callable[[int], None] | None = None,
) -> Attitude:
    """The attitude of every row of *recording*, from all of it: before the row and after (``SelfCalibrating`` only).

    The way back starts *overlap* seconds behind each *window* of them; it needs about 80 kB of memory for a second of
    recording, at the default length of a block. Other arguments as for :func:`estimate`; ``attitude.learning`` is that of
    the way forward: of what walks the way back gives the bias, in every row, and what does not is that of the last row.
    Raises :class:`MethodError` for another method, and what :func:`estimate` raises.
    """
    if not isinstance(recording, Recording):
        raise RecordingError(f"expected a Recording, found {type(recording).__name__}; see poise.read")
    method = SelfCalibrating() if method is None else method
    if not isinstance(method, SelfCalibrating):
        raise MethodError(f"only SelfCalibrating can be smoothed, found {type(method).__name__}")
    if not (window > 0.0 and overlap >= 0.0):
        raise MethodError(f"window and overlap: expected seconds, found {window!r} and {overlap!r}")
    method = at_gravity(method, recording.gravity)._replace(log=0)
    stream = Stream(method._replace(log=_PART + 2), start, bias=bias, guard=guard, start_from=start_from)
    log: list[Floats] = []
    past = feed(
        stream, recording, _PART, after=lambda: log.append(_taken(stream)), learning=learning, progress=progress
    )
    entry = _unwrapped(past.flags >> _INDEX)
    past.flags[:] &= _KNOWN
    if len(past):
        _correct(past, entry, np.concatenate(log) if log else np.empty((0, WIDTH)), method, window, overlap)
    return replace(past, provenance=replace(past.provenance, method="SelfCalibrating, smoothed"))


def _taken(stream: Stream) -> Floats:
    """The finished entries of the log so far, (k · ENTRY, WIDTH); the log is empty then."""
    state = stream.running_state
    while hasattr(state, "inner"):
        state = state.inner
    P: Floats = state.P
    done = int(P[SENSOR, 22] - P[SENSOR, 23])
    taken = P[ENTRIES : ENTRIES + done * ENTRY].copy()
    P[ENTRIES : ENTRIES + ENTRY] = P[ENTRIES + done * ENTRY : ENTRIES + (done + 1) * ENTRY]
    P[SENSOR, 23] = P[SENSOR, 22]
    return taken


def _unwrapped(count: NDArray[np.uint32]) -> Indices:
    """Entries finished up to each row, from their number modulo 16; a row ends one at most."""
    steps: Indices = np.mod(np.diff(count.astype(np.int64), prepend=0), 16)
    return np.cumsum(steps)


def _correct(
    past: Attitude, entry: Indices, log: Floats, method: SelfCalibrating, window: float, overlap: float
) -> None:
    """Put into *past* what the future says of it."""
    n = len(log) // ENTRY
    ends = np.searchsorted(entry, np.arange(1, n + 1))  # the row at which each entry was finished
    time = past.time[np.minimum(ends, len(entry) - 1)]
    corrections = np.zeros((n, 22))
    first = 0
    while first < n:
        last = int(np.searchsorted(time, time[first] + window)) if window < time[-1] - time[first] else n
        last = max(last, first + 1)
        ahead = max(int(np.searchsorted(time, time[last - 1] + overlap)), last) if last < n else n
        future = np.zeros((SIZE + 2, SIZE))
        part = np.zeros((ahead - first, 22))
        back(log[first * ENTRY : ahead * ENTRY], future, part)
        corrections[first:last] = part[: last - first]
        first = last
    if n:
        tilt, heading = method.initial_tilt**2, min(method.initial_heading, pi) ** 2
        if past.learned and "field" in past.learned:  # the first block's heading, too, is that of the local field now
            heading -= method.local_field**2
        apply(past.time, entry, past.table, time, corrections, Vec3(tilt, tilt, heading), method.declination)
        past.quat[:] = arrays.continuous(past.quat)
