"""The flagship with the future known: `smooth` runs the causal filter, then goes back over its blocks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import cos, pi, sin
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.data.attitude import QUAT, Attitude
from poise.data.flags import (
    ANOTHER_FIELD,
    HARD_IRON,
    HEADING_ARBITRARY,
    HEADING_UNPROVEN,
    INVALID,
    KNOWN,
    LOST,
    RESET,
)
from poise.data.learned import Learned
from poise.data.recording import Recording
from poise.errors import MethodError, RecordingError
from poise.estimators.batch import feed
from poise.estimators.engine import Stream
from poise.estimators.self_calibrating.backward import apply, back
from poise.estimators.self_calibrating.causal import SelfCalibrating
from poise.estimators.self_calibrating.first_rows import turn_back
from poise.estimators.self_calibrating.learned import KnownIron, begin_with_iron, irons_found, known_iron
from poise.estimators.self_calibrating.model import BIAS, ENTRIES, ENTRY, SCALE, SENSOR, SIZE, Floats, sensor_of
from poise.estimators.self_calibrating.model import COLUMNS as WIDTH
from poise.estimators.self_calibrating.unproven import ANY, MOST, left_open
from poise.estimators.wrapping import at_gravity, innermost
from poise.math import arrays
from poise.math.vectors import Vec3

_PART = 1024  # rows of a recording at a time: what they log stays near the processor
_SETTLED = 60.0  # s after which a hard iron that was found is known along all axes that the sensor turns about
_INDEX = np.uint32(30)  # from this bit of the flags on the log's entries are counted
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
    about 130 kB of memory a second, at the default length of a block. Other arguments as for :func:`estimate`;
    ``attitude.learning`` is that of the way forward: of what walks the way back gives the bias, in every row, and what does
    not is that of the last row. A hard iron that the way forward finds is there from the start on,
    and so is a heading that it sets by another field.
    Raises :class:`MethodError` for another method, and what :func:`estimate` raises.
    """
    if not isinstance(recording, Recording):
        raise RecordingError(f"expected a Recording, found {type(recording).__name__}; see poise.read")
    method = SelfCalibrating() if method is None else method
    if not isinstance(method, SelfCalibrating):
        raise MethodError(f"only SelfCalibrating can be smoothed, found {type(method).__name__}")
    if not (isinstance(window, (int, float)) and isinstance(overlap, (int, float)) and window > 0.0 and overlap >= 0.0):
        raise MethodError(f"window and overlap: expected seconds, found {window!r} and {overlap!r}")
    method = at_gravity(method, recording.gravity)._replace(log=0)
    stream = partial(_Stream, method._replace(log=_PART + 2), start, bias=bias, guard=guard, start_from=start_from)
    both_ways = partial(_both_ways, stream, method, recording, window, overlap, learning, _rising(progress))
    try:
        return both_ways(None, len(recording))
    except _IronShown as found:  # then it was there before it was found: once more, with it
        iron, row = found.iron, found.row
    try:
        return both_ways(iron, row)
    except _IronShown:  # it was not
        return both_ways(None, 0)


def _rising(progress: Callable[[int], None] | None) -> Callable[[int], None] | None:
    """*progress* that does not fall back where the way forward is begun again."""
    if progress is None:
        return None
    most = 0

    def rising(rows: int) -> None:
        nonlocal most
        most = max(most, rows)
        progress(most)

    return rising


class _IronShown(Exception):
    """On the way forward the field has shown a hard iron, at a *row*; it is known since as *iron*."""

    def __init__(self, iron: KnownIron, row: int) -> None:
        self.iron, self.row = iron, row


class _Stream(Stream):
    """One whose method may know a hard iron from the start on."""

    def __init__(self, *args: Any, iron: KnownIron | None, **options: Any) -> None:
        super().__init__(*args, **options)
        self._iron = iron
        self.first_A = np.zeros((3, 3))
        """what was known of A at the start"""

    @property
    def P(self) -> Floats:
        """The method's memory."""
        memory: Floats = innermost(self.running_state).P
        return memory

    def _begin(self, rows: Floats) -> None:
        super()._begin(rows)
        self.first_A = np.array(sensor_of(self.P).scale)
        if self._iron is not None:
            begin_with_iron(self.P, self._iron)

    def _cleared(self, mag: Floats) -> Floats:
        if self._iron is None:
            return super()._cleared(mag)
        return mag - self._iron.iron if mag.any() else mag  # zeros are a magnetometer that said nothing


def _both_ways(
    stream_of: Callable[..., _Stream],
    method: SelfCalibrating,
    recording: Recording,
    window: float,
    overlap: float,
    learning: float | None,
    progress: Callable[[int], None] | None,
    iron: KnownIron | None,
    before: int,
) -> Attitude:
    """Forward, from *iron* if one is known, and back. Raises :class:`_IronShown` where one is shown up to row *before*."""
    stream = stream_of(iron=iron)
    way = _WayBack(recording.time, window, overlap, method.block)
    shown: int | None = None  # the row by which one was

    def after(rows: slice, flags: NDArray[np.uint32]) -> None:
        nonlocal shown
        way.add(stream, rows, flags)
        if shown is None and rows.stop <= before and irons_found(stream.P):
            shown = rows.stop
        if shown is not None:
            since = recording.time[rows.stop - 1] - recording.time[shown - 1]
            known = known_iron(stream.P)
            if known.length > 0.0 and (not since < _SETTLED or rows.stop == len(recording)):
                raise _IronShown(known, shown)

    past = feed(stream, recording, _PART, after=after, learning=learning, progress=progress)
    past.flags[:] &= _KNOWN
    way.finish()
    if len(way.corrections):
        tilt, heading = method.initial_tilt**2, min(method.initial_heading, pi) ** 2
        if past.learned and "field" in past.learned:  # the first block's heading, too, is that of the local field now
            heading -= method.local_field**2
        begun = Vec3(tilt, tilt, heading)
        apply(past.time, way.entry, past.table, way.time, way.corrections, begun, method.declination)
        end, injected = way.corrections[0, BIAS : BIAS + 3], way.corrections[0, 6 + BIAS : 9 + BIAS]
        A = np.array(sensor_of(stream.P).scale) - stream.first_A
        A_sigma = float(np.sqrt(np.diag(stream.P[SCALE : SCALE + 9, SCALE : SCALE + 9]).max()))
        turn_back(past, np.flatnonzero(way.entry == 0), end + injected, A, A_sigma)
        _turn_what_was_before(past)
        if method.least_iron < ANY:
            judge_headings(stream.P, past, method.declination)
    return replace(past, provenance=replace(past.provenance, method="SelfCalibrating, smoothed"))


def judge_headings(P: Floats, attitude: Attitude, declination: float) -> None:
    """Of the rows whose heading was unproven on the way forward, those that the motion has proven since are no longer.

    Iron is the sensor's, and what is open of it at the end counts for all rows. What a heading was set by is confirmed in the
    stretch up to where it was set again, or never.
    """
    unproven = (attitude.flags & np.uint32(HEADING_UNPROVEN)) != 0
    headed = (attitude.flags & np.uint32(INVALID | HEADING_ARBITRARY)) == 0
    set_again = (attitude.flags & np.uint32(RESET | LOST | HARD_IRON)) != 0
    set_again &= (attitude.flags & np.uint32(ANOTHER_FIELD)) == 0
    stretch = np.cumsum(set_again)
    confirmed = np.bincount(stretch, headed & ~unproven, stretch[-1] + 1 if len(stretch) else 0) > 0
    rows = np.flatnonzero(unproven & confirmed[stretch])
    magnetic_east = np.array([cos(declination), -sin(declination), 0.0])
    east = arrays.rotate(arrays.conjugate(attitude.quat[rows]), np.broadcast_to(magnetic_east, (len(rows), 3)))
    open_square = np.einsum("ij,jk,ik->i", east, np.array(left_open(P)), east)
    # as on the way forward, once proven
    proven = open_square <= (2.0 * MOST * sensor_of(P).field.y) ** 2
    attitude.flags[rows[proven]] &= ~np.uint32(HEADING_UNPROVEN)


def _turn_what_was_before(attitude: Attitude) -> None:
    """Where the heading was set by another field than at the start, it was wrong by as much all the time before."""
    begun = (attitude.flags & np.uint32(RESET | LOST)) != 0
    there = (attitude.flags & np.uint32(ANOTHER_FIELD)) != 0
    quat = attitude.table[:, QUAT]
    for row in np.flatnonzero(there)[::-1]:
        first = int(np.flatnonzero(np.append(True, (begun & ~there)[1 : row + 1]))[-1])
        if row == 0 or not np.isfinite(quat[[row - 1, row]]).all():
            continue
        since = arrays.rotation_vector(arrays.multiply(quat[row], arrays.conjugate(quat[row - 1])))[2]
        turned = arrays.rotate(quat[row], attitude.rate[row])[2] * (attitude.time[row] - attitude.time[row - 1])
        quat[first:row] = arrays.multiply(arrays.turn_about_up(np.array(since - turned)), quat[first:row])
        attitude.sigma[first:row, 2] = np.minimum(np.hypot(attitude.sigma[first:row, 2], attitude.sigma[row, 2]), pi)
        attitude.flags[row] &= ~np.uint32(RESET)  # it does not jump any more


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

    def add(self, stream: _Stream, rows: slice, flags: NDArray[np.uint32]) -> None:
        """Take the entries that *stream* has finished in *rows*, whose *flags* count them modulo 4; one a row at most."""
        counted = (flags >> _INDEX).astype(np.int64)
        finished = np.mod(np.diff(counted, prepend=self._count % 4), 4)
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


def _take(stream: _Stream, into: Floats) -> None:
    """Move the finished entries of the log out, (k · ENTRY, WIDTH)."""
    P = stream.P
    done = int(P[SENSOR, 22] - P[SENSOR, 23])
    into[:] = P[ENTRIES : ENTRIES + done * ENTRY]
    P[ENTRIES : ENTRIES + ENTRY] = P[ENTRIES + done * ENTRY : ENTRIES + (done + 1) * ENTRY]
    P[SENSOR, 23] = P[SENSOR, 22]
