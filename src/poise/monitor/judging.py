"""The monitor at work: over a whole attitude, and live. Both run the same loop, and so give the same bits."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees, inf, isfinite, nan
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.data.attitude import COLUMNS, Attitude
from poise.data.event import TipEvent, TipState
from poise.data.packet import Output
from poise.data.recording import Recording
from poise.errors import MethodError, RecordingError
from poise.estimators.protocol import output as verdict_of
from poise.estimators.protocol import start, step
from poise.math import arrays
from poise.math.compiled import direct, entry
from poise.math.memory import Memory
from poise.math.quaternions import Quat
from poise.math.vectors import ABSENT, Vec3
from poise.monitor.parameters import checked, vertical_in_body
from poise.monitor.tip_over import CLOCK_STANDS, DIRECTIONS, TipOver

Floats = NDArray[np.float64]

# Columns of what the loop writes.
TILT, LEAN, RATE, LIMIT, IMPACT, SAID = 0, 1, 2, 3, 4, 5
_STANDS = (TipState.UPRIGHT, TipState.RIGHTED, TipState.UNKNOWN)
_TOWARD = {"": "", "forward": "forward", "back": "backward", "left": "to the left", "right": "to the right"}
_OTHERS = {
    TipState.UNKNOWN: "the attitude is not valid",
    TipState.FREE_FALL: "nothing carries it",
    TipState.PICKED_UP: "was lifted",
}


@entry
def begin(tipover: Any, aside: Floats) -> Any:
    """The monitor's memory before any row; *aside* holds the clock."""
    return Memory(tipover, start(tipover), aside)


@entry
def watch(
    memory: Any, time: Floats, table: Floats, flags: NDArray[np.uint32], acc: Floats, said: Floats, codes: NDArray[np.uint8]
) -> None:  # fmt: skip
    """Step the monitor over the rows of an attitude; *codes* (n, 2) are state and direction."""
    tipover, state, aside = memory.method, memory.state, memory.aside
    clock = float(aside[0])
    for i in range(len(time)):
        now = float(time[i])
        attitude = Quat(float(table[i, 0]), float(table[i, 1]), float(table[i, 2]), float(table[i, 3]))
        rate = Vec3(float(table[i, 4]), float(table[i, 5]), float(table[i, 6]))
        out = Output(
            now - clock, attitude, rate, ABSENT, ABSENT, ABSENT, int(flags[i])
        )  # NaN at the first: no time yet
        state = step(tipover, state, out, Vec3(float(acc[i, 0]), float(acc[i, 1]), float(acc[i, 2])))
        if isfinite(now):
            clock = now
        verdict = verdict_of(tipover, state)
        said[i, 0], said[i, 1], said[i, 2] = verdict.tilt, verdict.lean, verdict.rate
        said[i, 3], said[i, 4] = verdict.limit, verdict.time_to_impact
        codes[i, 0], codes[i, 1] = verdict.state, verdict.direction
    memory.state = state
    aside[0] = clock


@dataclass(frozen=True, eq=False)
class Judgement:
    """What the monitor says of every row of an attitude, and the changes of state."""

    time: Floats
    """(n,) s"""
    state: NDArray[np.uint8]
    """(n,) values of :class:`TipState`"""
    tilt: Floats
    """(n,) rad, between the robot's up and the vertical, mounting and tare removed; NaN where unknown"""
    lean: Floats
    """(n,) rad, across the side that is furthest beyond its range, or nearest to it"""
    rate: Floats
    """(n,) rad/s, of that lean; NaN where the attitude has no rate"""
    margin: Floats
    """(n,) rad, what is left of it until the body tips over"""
    time_to_impact: Floats
    """(n,) s; NaN where the body does not lean, or does not get there"""
    directions: Floats
    """(n, 4) rad, the lean forward, back, left and right"""
    events: list[TipEvent]
    tipover: TipOver
    flags: NDArray[np.uint32]
    """(n,) of the attitude that was judged"""

    def __len__(self) -> int:
        return len(self.time)

    @property
    def judged(self) -> NDArray[np.bool_]:
        """(n,) the rows of which anything is known."""
        return np.asarray(self.state != TipState.UNKNOWN)

    def seconds(self) -> dict[TipState, float]:
        """How long each state lasted, s; a row's state lasts to the next row."""
        length = np.diff(self.time)
        length = np.where(np.isfinite(length) & (length > 0.0), length, 0.0)
        return {state: float(length[self.state[:-1] == state].sum()) for state in TipState}


def judge(
    attitude: Attitude, recording: Recording | ArrayLike | None = None, tipover: TipOver | None = None
) -> Judgement:
    """What the monitor says of *attitude*, row by row, as it would have said it live.

    *recording* (or its ``acc`` (n, 3), m/s²), on the attitude's rows, tells free fall and picking up from a fall; without it
    neither is seen. Raises :class:`MethodError` for parameters and :class:`RecordingError` for rows that do not fit.
    """
    ready = checked(TipOver() if tipover is None else tipover)
    if not isinstance(attitude, Attitude):
        raise RecordingError(f"expected an Attitude to judge, found {type(attitude).__name__}")
    acc = recording.acc if isinstance(recording, Recording) else recording
    rows = np.full((len(attitude), 3), nan) if acc is None else np.ascontiguousarray(acc, float)
    if rows.shape != (len(attitude), 3):
        raise RecordingError(
            f"acc: expected ({len(attitude)}, 3), a row for each of the attitude's, found {rows.shape}; "
            "resample the attitude to the recording's time"
        )
    up = vertical_in_body(attitude)
    said, codes = np.full((len(attitude), SAID), nan), np.zeros((len(attitude), 2), np.uint8)
    time = np.ascontiguousarray(attitude.time, float)
    watch(begin(ready, np.array([nan])), time, *_columns(attitude), rows, said, codes)
    events = _events(time, said, codes, ready, TipState.UNKNOWN)
    with np.errstate(all="ignore"):
        lean = _leans(up, ready)
    lean[~np.isfinite(said[:, TILT])] = nan
    return Judgement(
        time, codes[:, 0], said[:, TILT], said[:, LEAN], said[:, RATE], said[:, LIMIT] - said[:, LEAN],
        said[:, IMPACT], lean, events, ready, attitude.flags,
    )  # fmt: skip


class Monitor:
    """A tip-over monitor running live: give it the attitude after every sample, get what changed.

    ``monitor.update(stream.update(packet), acc)`` behind a :class:`poise.Stream`; ``monitor.check(now)`` from a timer, so
    that silence is told; in a simulation an :class:`Output` will do. What it says is, bit for bit, what :func:`judge` says
    of the same rows. *silence* is how old the last row may be, s.
    """

    def __init__(self, tipover: TipOver | None = None, *, silence: float = 0.05) -> None:
        self.tipover = checked(TipOver() if tipover is None else tipover)
        if not isinstance(silence, (int, float)) or not 0.0 <= silence < inf:
            raise MethodError(f"silence: expected seconds, found {silence!r}")
        self._silence = float(silence)
        self._aside = np.array([nan])
        self._memory = begin(self.tipover, self._aside)
        self._run: Any = None
        self._absent, self._one = np.full((1, 3), nan), np.empty((1, 3))
        self._said, self._codes = np.full((1, SAID), nan), np.zeros((1, 2), np.uint8)
        self._row, self._flags = np.full((1, COLUMNS), nan), np.zeros(1, np.uint32)
        self._told = TipState.UNKNOWN

    @property
    def state(self) -> TipState:
        """The state as it was told last."""
        return self._told

    @property
    def tilt(self) -> float:
        """rad, after the last row; NaN where it is not known."""
        return float(self._said[-1, TILT])

    @property
    def margin(self) -> float:
        """rad, until the body tips over, after the last row."""
        return float(self._said[-1, LIMIT] - self._said[-1, LEAN])

    @property
    def time_to_impact(self) -> float:
        """s, after the last row; NaN where the body does not lean, or does not get there."""
        return float(self._said[-1, IMPACT])

    def update(self, attitude: Attitude | Output, acc: ArrayLike | None = None) -> list[TipEvent]:
        """The changes of state by the rows of *attitude* (or one :class:`Output`), in order; mostly none.

        *acc* is the specific force of the same rows, (3,) or (n, 3) m/s², or None where it is not known.
        Raises :class:`RecordingError` for shapes that do not fit; the monitor goes on as if they had not come.
        """
        if isinstance(attitude, Attitude):
            time, (table, flags) = attitude.time, _columns(attitude)
        elif isinstance(attitude, Output):
            time, table, flags = self._as_row(attitude)
        else:
            raise RecordingError(f"expected an Attitude or an Output, found {type(attitude).__name__}")
        n = len(time)
        if not n:
            return []
        force = self._force(acc, n)
        said, codes = (self._said, self._codes) if n == 1 else (np.empty((n, SAID)), np.zeros((n, 2), np.uint8))
        arguments = time, table, flags, force, said, codes
        if self._run is None:
            watch(self._memory, *arguments)
            self._run = direct(watch, self._memory, *arguments)
        else:
            self._run(self._memory, *arguments)
        before = self._told
        if n == 1 and codes[0, 0] == before:
            return []
        events = _events(time, said, codes, self.tipover, before)
        self._said, self._codes, self._told = said[-1:].copy(), codes[-1:].copy(), TipState(int(codes[-1, 0]))
        return events

    def check(self, now: float) -> list[TipEvent]:
        """The change to UNKNOWN where the last row is *silence* old, or older, at *now* (s, the rows' clock); for a timer.

        The next row says again what is; judging goes on from where it was.
        """
        if not isinstance(now, (int, float)) or not isfinite(now):
            raise RecordingError(f"now: expected seconds on the rows' clock, found {now!r}")
        silent = float(now) - float(self._aside[0])
        if silent < self._silence - 1e-9 or self._told is TipState.UNKNOWN:
            return []
        event = TipEvent(float(now), TipState.UNKNOWN, self._told, reason=f"no attitude for {silent:.3f} s")
        self._told = TipState.UNKNOWN
        self._said[:] = nan
        return [event]

    def _as_row(self, out: Output) -> tuple[Floats, Floats, NDArray[np.uint32]]:
        clock = self._aside[0]
        self._row[0, 0:4], self._row[0, 4:7], self._flags[0] = out.attitude, out.rate, out.flags
        return np.array([out.dt if not isfinite(clock) else clock + out.dt]), self._row, self._flags

    def _force(self, acc: ArrayLike | None, n: int) -> Floats:
        if acc is None:
            return self._absent if n == 1 else np.full((n, 3), nan)
        force = arrays.numbers(acc)
        if force.shape == (3,) and n == 1:
            self._one[0] = force
            return self._one
        if force.shape != (n, 3):
            raise RecordingError(f"acc: expected ({n}, 3) for {n} rows, found {acc!r}")
        return np.ascontiguousarray(force)


def _columns(attitude: Attitude) -> tuple[Floats, NDArray[np.uint32]]:
    if attitude.frame != "enu":
        with np.errstate(all="ignore"):
            attitude = attitude.to("enu")
    return np.ascontiguousarray(attitude.table), np.ascontiguousarray(attitude.flags)


def _leans(up: Floats, tipover: TipOver) -> Floats:
    """(n, 4) the lean forward, back, left and right."""
    x, y, z = arrays.rotate(np.array(tipover.mount), up).T
    return np.column_stack([np.arctan2(side, z) for side in (-y, y, x, -x)])


def _events(
    time: Floats, said: Floats, codes: NDArray[np.uint8], tipover: TipOver, before: TipState
) -> list[TipEvent]:  # fmt: skip
    states = codes[:, 0].astype(int)
    events = []
    for i in np.flatnonzero(np.diff(states, prepend=int(before))):
        state = TipState(int(states[i]))
        way = "" if state in _STANDS else DIRECTIONS[int(codes[i, 1])]
        tilt, lean, rate, limit, impact = (float(value) for value in said[i])
        where = f"{degrees(lean):.1f}° {_TOWARD[way]}"
        if state is TipState.TIPPING:
            reason = f"leans {where}, {_why_tipping(lean, rate, limit, tipover)}"
        elif state is TipState.FALLEN:
            reason = f"{'hit the ground' if lean >= tipover.impact - 1e-9 else 'lies still'} at {where}"
        elif state is TipState.LEANING:
            reason = f"leans {where}: " + (
                "came back" if before is TipState.TIPPING else "at or beyond the preset range"
            )
        elif state in (TipState.UPRIGHT, TipState.RIGHTED):
            reason = f"stands{' again' * (state is TipState.RIGHTED)}, {degrees(tilt):.1f}° from upright"
        elif state is TipState.UNKNOWN and int(codes[i, 1]) == CLOCK_STANDS:
            reason = "its clock stands still"
        else:
            reason = _OTHERS[state]
        events.append(TipEvent(float(time[i]), state, before, way, tilt, rate, impact, reason))
        before = state
    return events


def _why_tipping(lean: float, rate: float, limit: float, tipover: TipOver) -> str:
    most = f"the largest self-balancing angle of {degrees(limit):.1f}°"
    if lean >= limit - 1e-9:
        return f"at or beyond {most}"
    return f"and goes on at {degrees(rate):.0f}°/s: in {tipover.look_ahead:g} s at or beyond {most}"
