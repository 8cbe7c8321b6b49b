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
from poise.estimators.batch import feed
from poise.estimators.engine import Stream
from poise.estimators.self_calibrating.backward import apply, back
from poise.estimators.self_calibrating.causal import SelfCalibrating
from poise.estimators.self_calibrating.model import COLUMNS as WIDTH
from poise.estimators.self_calibrating.model import ENTRIES, ENTRY, SENSOR, SIZE, Floats
from poise.estimators.wrapping import at_gravity
from poise.math.vectors import Vec3

_PART = 1024  # rows of a recording at a time: what they log stays near the processor
_INDEX = np.uint32(28)  # from this bit of the flags on the log's entries are counted
_KNOWN = np.uint32(KNOWN)  # the flags below it


def smooth(
    recording: Recording,
    method: SelfCalibrating | None = None,
    start: Attitude | ArrayLike | None = None,
    *,
    bias: ArrayLike = (0.0, 0.0, 0.0),
    guard: bool | None = True,
    window: float = 600.0,
    overlap: float = 200.0,
    start_from: Learned | Attitude | None = None,
    learning: float | None = None,
    progress: Callable[[int], None] | None = None,
) -> Attitude:
    """The attitude of every row of *recording*, from all of it: before the row and after (``SelfCalibrating`` only).

    The way back starts *overlap* seconds behind each *window* of them, while the way forward goes on; both together take
    about 80 kB of memory a second, at the default length of a block. Other arguments as for :func:`estimate`;
    ``attitude.learning`` is that of the way forward: of what walks the way back gives the bias, in every row, and what does
    not is that of the last row.
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
    way = _WayBack(recording.time, window, overlap, method.block)
    past = feed(
        stream,
        recording,
        _PART,
        after=lambda rows, flags: way.add(stream, rows, flags),
        learning=learning,
        progress=progress,
    )
    past.flags[:] &= _KNOWN
    way.finish()
    if len(way.corrections):
        tilt, heading = method.initial_tilt**2, min(method.initial_heading, pi) ** 2
        if past.learned and "field" in past.learned:  # the first block's heading, too, is that of the local field now
            heading -= method.local_field**2
        begun = Vec3(tilt, tilt, heading)
        apply(past.time, way.entry, past.table, way.time, way.corrections, begun, method.declination)
    return replace(past, provenance=replace(past.provenance, method="SelfCalibrating, smoothed"))


class _WayBack:
    """Goes back over the log a window at a time, as soon as a window and its overlap are there, and then forgets it."""

    def __init__(self, rows: Floats, window: float, overlap: float, block: float) -> None:
        self.entry = np.zeros(len(rows), np.int64)
        """entries of the log finished up to each row"""
        self.time = np.empty(0)
        """s, of each entry's last row"""
        self.corrections = np.empty((0, 22))
        self._rows, self._window, self._overlap = rows, window, overlap
        self._first, self._done, self._count = 0, 0, 0  # entry the log begins with; entries gone back over; entries
        span = min(float(np.ptp(rows[np.isfinite(rows)])) if np.isfinite(rows).any() else 0.0, window + overlap)
        likely = min(int(1.1 * span / block), len(rows)) + 1
        self._log = np.empty((likely * ENTRY, WIDTH))  # memory is taken where it is written

    def add(self, stream: Stream, rows: slice, flags: NDArray[np.uint32]) -> None:
        """Take the entries that *stream* has finished in *rows*, whose *flags* count them modulo 16; one a row at most."""
        counted = (flags >> _INDEX).astype(np.int64)
        finished = np.mod(np.diff(counted, prepend=self._count % 16), 16)
        self.entry[rows] = self._count + np.cumsum(finished)
        times = self._rows[rows][finished > 0]
        end = (self._count - self._first) * ENTRY
        self._make_room(end + len(times) * ENTRY, self._count + len(times))
        _take(stream, self._log[end : end + len(times) * ENTRY])
        self.time[self._count : self._count + len(times)] = times
        self._count += len(times)
        while self._count and self.time[self._count - 1] - self.time[self._done] > self._window + self._overlap:
            time = self.time[: self._count]
            last = max(int(np.searchsorted(time, time[self._done] + self._window)), self._done + 1)
            ahead = max(int(np.searchsorted(time, time[last - 1] + self._overlap)), last)
            self._go_back(last, min(ahead, self._count))

    def finish(self) -> None:
        """Go back over what is left."""
        self.time, self.corrections = self.time[: self._count], self.corrections[: self._count]
        if self._done < self._count:
            self._go_back(self._count, self._count)

    def _go_back(self, last: int, ahead: int) -> None:
        """Corrections up to the entry *last*, from the log up to *ahead*; what is before *last* is forgotten."""
        future, part = np.zeros((SIZE + 4, SIZE)), np.zeros((ahead - self._done, 22))
        back(self._log[: (ahead - self._first) * ENTRY], future, part)
        self.corrections[self._done : last] = part[: last - self._done]
        left = self._log[(last - self._first) * ENTRY : (self._count - self._first) * ENTRY]
        self._log[: len(left)] = left
        self._first = self._done = last

    def _make_room(self, log_rows: int, entries: int) -> None:
        if log_rows > len(self._log):
            self._log = _longer(self._log, log_rows)
        if entries > len(self.time):
            self.time, self.corrections = _longer(self.time, entries), _longer(self.corrections, entries)


def _longer(array: Floats, least: int) -> Floats:
    """*array* with room for *least* rows and as many again."""
    longer = np.empty((2 * least, *array.shape[1:]))
    longer[: len(array)] = array
    return longer


def _take(stream: Stream, into: Floats) -> None:
    """Move the finished entries of the log out, (k · ENTRY, WIDTH)."""
    state = stream.running_state
    while hasattr(state, "inner"):
        state = state.inner
    P: Floats = state.P
    done = int(P[SENSOR, 22] - P[SENSOR, 23])
    into[:] = P[ENTRIES : ENTRIES + done * ENTRY]
    P[ENTRIES : ENTRIES + ENTRY] = P[ENTRIES + done * ENTRY : ENTRIES + (done + 1) * ENTRY]
    P[SENSOR, 23] = P[SENSOR, 22]
