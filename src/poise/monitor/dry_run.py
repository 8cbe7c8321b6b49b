"""What a judgement is worth where the truth is known: which falls it told, how long before, and what it told wrongly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf, isfinite, nan

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import RATE, Attitude
from poise.data.event import TipEvent, TipState
from poise.data.flags import SENTENCES, Flag, why_invalid
from poise.data.recording import Recording
from poise.monitor.judging import Judgement, judge

Floats = NDArray[np.float64]

_EARLY, _LATE = 2.0, 1.0  # s before and after a fall in which an alarm is one of that fall
_DOWN = (TipState.TIPPING, TipState.FALLEN)


@dataclass(frozen=True)
class Fall:
    """A fall that took place."""

    start: float
    """s, beyond the largest self-balancing angle from here on; NaN where only the end is known"""
    ground: float
    """s, at the angle of impact; NaN where it did not get there"""
    end: float
    """s, until it stood again, or the recording ended"""


@dataclass(frozen=True)
class Alarm:
    """The monitor said that the body tips over."""

    event: TipEvent
    ground: float
    """s, when the body was at the angle of impact: by the truth where it is known, else by the attitude judged; NaN where
    it did not get there, and of a false alarm"""
    true: bool | None
    """whether it fell; None where the truth is not known"""
    at_least: float = nan
    """s that the lead is at least, where the attitude was unknown before the ground; NaN where that is not known either"""
    doubt: str = ""
    """why then nobody saw the ground"""

    @property
    def lead(self) -> float:
        """s from the alarm to the ground."""
        return self.ground - self.event.time


@dataclass(frozen=True)
class DryRun:
    """The alarms of one recording, held against the falls in it."""

    alarms: list[Alarm]
    falls: list[Fall] | None
    """None where the truth is not known"""
    missed: list[Fall]
    hours: float
    """in which the truth is known and the attitude was judged: only then an alarm could be a false one"""

    @property
    def false_per_hour(self) -> float:
        """False alarms per hour; NaN where the truth is not known."""
        wrong = sum(alarm.true is False for alarm in self.alarms)
        return wrong / self.hours if self.falls is not None and self.hours > 0.0 else nan


def dry_run(
    judgement: Judgement, truth: Attitude | Sequence[float] | None = None, recording: Recording | None = None
) -> DryRun:
    """The alarms of *judgement*, held against *truth*: a reference attitude on its rows, or when the body hit the ground, s.

    An empty sequence says that it never fell. The reference is judged by the same parameters, without look-ahead.
    """
    events = [e for e in judgement.events if e.state in _DOWN and e.before not in _DOWN]
    own = [_seen(judgement, event) for event in events]
    if truth is None:
        return DryRun(own, None, [], 0.0)
    if isinstance(truth, Attitude):
        falls, known, hours = _falls(judgement, truth, recording)
    else:
        falls = [Fall(nan, float(at), float(at)) for at in sorted(truth)]
        known, hours = np.ones(len(judgement), bool), _hours(judgement.time, judgement.judged)
    alarms, told = [], set()
    for event, seen in zip(events, own, strict=True):
        match = _fall_of(event.time, falls)
        if match is not None:
            told.add(match)
            alarms.append(Alarm(event, falls[match].ground, True))
        else:
            near = np.abs(judgement.time - event.time) <= _LATE
            alarms.append(Alarm(event, nan, False) if known[near].all() else seen)
    missed = [fall for i, fall in enumerate(falls) if i not in told and not _said(judgement, fall)]
    return DryRun(alarms, falls, missed, hours)


def _fall_of(time: float, falls: list[Fall]) -> int | None:
    """The fall that an alarm belongs to: the nearest that is not over yet, or just was."""
    near = [
        (time > fall.end, max(_begin(fall) - time, time - fall.end, 0.0), i)
        for i, fall in enumerate(falls)
        if _begin(fall) - _EARLY <= time <= fall.end + _LATE
    ]
    return min(near)[2] if near else None


def _said(judgement: Judgement, fall: Fall) -> bool:
    """Whether the monitor held the body for fallen then anyway, from an earlier alarm."""
    during = (judgement.time >= _begin(fall)) & (judgement.time <= fall.end)
    return bool(np.isin(judgement.state[during], [int(state) for state in _DOWN]).any())


def _begin(fall: Fall) -> float:
    return fall.ground if np.isnan(fall.start) else fall.start


def _falls(
    judgement: Judgement, truth: Attitude, recording: Recording | None
) -> tuple[list[Fall], NDArray[np.bool_], float]:
    truth = on_rows(truth, judgement.time)
    if not np.isfinite(truth.rate).any() and recording is not None:  # optics measure none, and carried bodies turn
        table = truth.table.copy()
        table[:, RATE] = recording.gyr
        truth = replace(truth, table=table)
    seen = judge(truth, recording, judgement.tipover._replace(look_ahead=0.0))
    falls: list[Fall] = []
    down = False
    for i, event in enumerate(seen.events):
        if event.state is TipState.UNKNOWN:  # a reference that is lost for a while ends no fall
            continue
        was, down = down, event.state in _DOWN
        if down and not was:
            after = (e.time for e in seen.events[i:] if e.state not in (*_DOWN, TipState.UNKNOWN))
            falls.append(Fall(event.time, _seen(seen, event).ground, next(after, float(np.nanmax(seen.time)))))
    known = seen.state != TipState.UNKNOWN
    return falls, known, _hours(seen.time, known & judgement.judged)


def on_rows(truth: Attitude, time: Floats) -> Attitude:
    """*truth* at the times of a judgement's rows."""
    same = len(truth) == len(time) and np.array_equal(truth.time, time, equal_nan=True)
    return truth if same else truth.resample(time)


def _hours(time: Floats, known: NDArray[np.bool_]) -> float:
    length = np.diff(time)
    good = known[:-1] & np.isfinite(length) & (length > 0.0)
    return float(length[good].sum()) / 3600.0


def _seen(judgement: Judgement, event: TipEvent) -> Alarm:
    """The alarm *event* by the attitude judged alone. Where that was unknown before the ground, nobody saw when it was:
    the first row that is known again may be long after."""
    ground, end = _ground(judgement, event.time)
    unknown = judgement.state == TipState.UNKNOWN
    unseen = unknown & (judgement.time >= event.time) & (judgement.time < (ground if isfinite(ground) else end))
    if unseen.any():
        first = float(judgement.time[unseen][0])
        return Alarm(
            event, nan, None, first - event.time, _why(judgement, event.time, float(judgement.time[unseen][-1]))
        )
    before = judgement.events[: judgement.events.index(event)]
    if event.before is TipState.UNKNOWN and before and before[-1].before in _DOWN:  # it was falling when it was lost
        return Alarm(event, nan, None, nan, _why(judgement, before[-1].time, event.time))
    return Alarm(event, ground, None)


def _why(judgement: Judgement, start: float, end: float) -> str:
    """Why the attitude was unknown in some of these seconds."""
    return why_unknown(judgement, np.asarray((judgement.time >= start) & (judgement.time <= end)))


def why_unknown(judgement: Judgement, rows: NDArray[np.bool_]) -> str:
    """Why nothing is known in some of these *rows* (n,)."""
    flags = int(np.bitwise_or.reduce(judgement.flags[rows]))
    if flags & Flag.GYR_CLIPPED:  # what follows from it is no news
        return SENTENCES[Flag.GYR_CLIPPED]
    return why_invalid(flags) or "the stamps stood still, or were missing"


def _ground(judgement: Judgement, since: float) -> tuple[float, float]:
    """s, of the first row from *since* on at the angle of impact (NaN for none), before the body stands again, and when
    that is."""
    after = judgement.time >= since
    stands = after & ~np.isin(judgement.state, [int(state) for state in (*_DOWN, TipState.UNKNOWN)])
    end = float(judgement.time[stands][0]) if stands.any() else inf
    hits = after & (judgement.time < end) & (judgement.lean >= judgement.tipover.impact - 1e-9)
    return (float(judgement.time[hits][0]) if hits.any() else nan), end
