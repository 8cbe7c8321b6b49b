"""The time of a row, where its stamp cannot be taken as it is: missing, repeated, set back, far ahead."""

from __future__ import annotations

from math import floor, isfinite, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.flags import CLOCK_JUMP, GAP, JITTER, TIME_DISORDER
from poise.data.stamps import packed
from poise.estimators.guard.packets import (
    NONE,
    Packets,
    begins_packet,
    counted,
    followed,
    in_packets,
    longest,
    one_by_one,
    within_packet,
)
from poise.math.compiled import compiled, entry

Floats = NDArray[np.float64]

SHORTEST = 1e-7  # s: a noise density over no time at all would overflow
_LONGEST = 1e12
_SHARE = 0.02  # of a new step in the usual one: that of the last 50 rows or so
_MOST = 0.1  # of the usual step: a longer one counts as that much longer, for a lost row is not a slower sensor
_EARLY = 50.0  # rows: until then the usual step is the mean of all
_BEGUN, _FOLLOWED = 20.0, 400.0  # rows that the line through stamps that scatter is drawn through: from, and at most
_SCATTER = 4e-4  # (usual step)²: 2 % of it, squared; less is not worth a thought
_TURNS_BACK = -0.3  # correlation of successive steps. −0.5 where the stamps scatter, and 0 where the samples do
_STILL = -0.15  # the same, once it is known that they scatter
_AGAIN = 0.3  # of the scatter: a pattern of steps that comes again, and no scatter, correlates over two steps too
_LONG_STEP = 0.5  # more than the usual step: a row may have been lost
_LATEST = 0.9  # (usual step): a stamp later than that is the next row's
_TOO_MANY = 0.05  # (usual step): what a row is taken to last where one was taken for lost that was not
_OFTEN = 0.005  # of a new row in what is known of the scatter
_LONG = 5000.0  # rows whose mean step is that of stamps that scatter


class Pace(NamedTuple):
    """What is known of the clock."""

    step: float  # s, the usual time between rows; 0 while unknown
    ahead: float  # s that rows were taken to last which their stamps did not show: the next stamps pay it back
    back: float  # s that the clock was set back; should it come back to its old time, that is no gap
    waiting: int  # rows since the last stamp that rose
    held: int  # rows in a row that no time was given to
    off: float  # of the last step from the usual one, in usual steps
    earlier: float  # that of the step before
    scatter: float  # mean square of them
    turns: float  # mean product with the one before
    again: float  # and with the one before that
    rows: float  # that this is known from, counted up to 5000
    line: float  # rows that a line through stamps that scatter is drawn through, counted up to 400; 0 where they do not
    packets: Packets


UNKNOWN = Pace(0.0, 0.0, 0.0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, NONE)


class Timed(NamedTuple):
    """What a row's stamp is taken for."""

    pace: Pace
    dt: float  # s that the method steps; 0: the row is held
    flags: int


@compiled
def evenly(pace: Pace, dt: float, gap: float) -> bool:
    """Whether a step is an ordinary one, about the usual, and nothing is left to be paid back or to be looked at."""
    return (
        0.5 * pace.step < dt < 1.5 * pace.step
        and SHORTEST < dt <= gap
        and pace.ahead == 0.0
        and pace.waiting == 0
        and pace.off <= _LONG_STEP
        and pace.rows >= _EARLY
        and not pace.packets.long
        and not _scattered(pace)
    )


@compiled
def counted_on(pace: Pace, dt: float) -> Pace:
    """The pace after an ordinary step."""
    step = pace.step + _SHARE * (dt - pace.step)
    off = dt / pace.step - 1.0
    scatter, turns, again = pace.scatter, pace.turns, pace.again
    return Pace(
        step, 0.0, pace.back, 0, 0, off, pace.off, scatter + _OFTEN * (off * off - scatter),
        turns + _OFTEN * (off * pace.off - turns), again + _OFTEN * (off * pace.earlier - again),
        min(pace.rows + 1.0, _LONG), 0.0, one_by_one(pace.packets, step),
    )  # fmt: skip


@compiled
def _scattered(pace: Pace) -> bool:
    """Whether the stamps scatter and the samples do not: a stamp that is late makes one step long and the next one short."""
    back = _STILL if pace.line > 0.0 else _TURNS_BACK
    known = pace.scatter > _SCATTER and pace.turns < back * pace.scatter and pace.rows >= _EARLY
    known = known and abs(pace.again) < _AGAIN * pace.scatter
    return in_packets(pace.packets) or known


@compiled
def timed(pace: Pace, dt: float, repeated: bool, goes_on: bool, gap: float, longest_loss: float) -> Timed:
    """The time that a row stands for.

    *repeated*: it is the very row before, so that it may have been sent twice, unless rows share stamps anyway; *goes_on*:
    the samples go on from the row before as if no time had passed. A row without a stamp of its own still is a sample: it
    is taken to last the usual step, and that is set off against the stamps that follow. So swapped rows and a clock that
    stands still lose no rotation. Stamps that scatter about an even pace are followed slowly.
    """
    usual = pace.step
    if not SHORTEST < dt < _LONGEST:  # NaN too
        back = min(-dt, _LONGEST) if dt < 0.0 else 0.0
        waiting = pace.waiting + 1
        if 0.0 < back <= gap:  # an older row, late: what it measured is past, and the clock goes on from its stamp
            held = _with(pace, usual, pace.ahead + back, pace.back, pace.waiting, pace.held + 1)
            return Timed(held, 0.0, TIME_DISORDER)
        if back > gap:  # the clock was set back: nothing can be set off against it any more
            kept = min(pace.back + max(pace.ahead, 0.0) + back + usual, _LONGEST)
            return Timed(_with(pace, usual, 0.0, kept, 0, 0), usual, TIME_DISORDER | CLOCK_JUMP)
        if usual == 0.0 or (repeated and not in_packets(pace.packets)):  # in a packet a sensor may hold its sample
            return Timed(_with(pace, usual, pace.ahead, pace.back, waiting, pace.held + 1), 0.0, TIME_DISORDER)
        return Timed(_without_stamp(pace, 0.0), usual, TIME_DISORDER)

    left, kept, flags = dt - pace.ahead, pace.back, 0
    most = longest(pace.packets, usual, pace.rows, gap, longest_loss)
    if usual > 0.0 and in_packets(pace.packets) and within_packet(pace.packets, dt):
        return Timed(_without_stamp(pace, dt), usual, JITTER)
    if usual > 0.0 and dt <= most and begins_packet(pace.packets, dt, pace.waiting):
        row = followed(pace.packets, dt, usual, pace.ahead, pace.waiting, pace.rows, most)
        after = Pace(
            row.step, row.ahead, kept, 0, 0, 0.0, 0.0, pace.scatter, pace.turns, pace.again, row.rows, 0.0, row.packets
        )
        return Timed(after, row.given, 0)
    if dt <= gap and usual > 0.0 and _scattered(pace):
        late = min(0.5 + 1.5 * sqrt(0.5 * pace.scatter), _LATEST)  # beside 1.5 σ of a stamp
        steps = left / usual
        rows = _TOO_MANY if steps < 1.0 - late else max(floor(steps + 1.0 - late), 1.0)
        line = min(max(pace.line, _BEGUN) + max(rows, 1.0), _FOLLOWED)
        off = min(max(left - rows * usual, -late * usual), late * usual)
        follow = (4.0 * line - 2.0) / (line * (line + 1.0))
        given = rows * usual + min(max(follow * off, -0.5 * rows * usual), 0.5 * usual)
        ahead = given - left
        if abs(ahead) <= gap:
            usual += 6.0 / (line * (line + 1.0)) * off
            uneven = not 0.5 * usual < dt < 2.0 * usual
            return Timed(_after(pace, usual, ahead, kept, dt, line), given, JITTER if uneven else 0)
    if dt > longest_loss and goes_on and usual > 0.0:
        return Timed(_with(pace, usual, 0.0, 0.0, 0, 0), usual, CLOCK_JUMP)
    mean = dt / (pace.waiting + 1.0)
    if mean <= gap:
        share, most = min(_SHARE * (pace.waiting + 1.0), 1.0), _MOST * usual
        if pace.rows < _EARLY:
            share, most = max(share, 1.0 / (pace.rows + 1.0)), mean
        usual = usual + share * min(mean - usual, most) if usual > 0.0 else mean
    if kept > 0.0 and dt > gap and 0.0 < left - kept <= gap:  # the clock is back at the time it had
        return Timed(_with(pace, usual, 0.0, 0.0, 0, 0), left - kept, CLOCK_JUMP)
    ahead = 0.0
    if pace.ahead > 0.0:
        least = 0.5 * usual
        if left < least and pace.ahead <= gap:  # little by little
            ahead, left = least - left, least
        elif left < least:  # the clock stood still and went on from there
            left = dt
    if left > gap:
        flags |= GAP
    elif usual > 0.0 and not 0.5 * usual < left < 2.0 * usual:
        flags |= JITTER
    return Timed(_after(pace, usual, ahead, kept, dt, 0.0), left, flags)


@compiled
def _with(pace: Pace, step: float, ahead: float, back: float, waiting: int, held: int) -> Pace:
    """What is known of the scatter of the stamps stays."""
    return Pace(
        step, ahead, back, waiting, held, pace.off, pace.earlier, pace.scatter, pace.turns, pace.again, pace.rows,
        pace.line, pace.packets,
    )  # fmt: skip


@compiled
def _after(pace: Pace, step: float, ahead: float, back: float, dt: float, line: float) -> Pace:
    """The pace after a stamp that rose by *dt*: lost rows are no scatter."""
    alone = not within_packet(pace.packets, dt)
    share = max(_OFTEN, 1.0 / (pace.rows + 1.0))
    off, before, earlier = min(dt / step - 1.0, 1.0), pace.off, pace.earlier
    scatter, turns, again = pace.scatter, pace.turns, pace.again
    # A longer step may be that of a lost row: it says nothing, nor does the next.
    if off <= _LONG_STEP and before <= _LONG_STEP:
        scatter += share * (off * off - scatter)
        turns += share * (off * before - turns)
        if earlier <= _LONG_STEP:
            again += share * (off * earlier - again)
    return Pace(
        step, ahead, back, 0, 0, off, before, scatter, turns, again, min(pace.rows + 1.0, _LONG), line,
        counted(pace.packets, dt, alone, pace.waiting, pace.rows),
    )  # fmt: skip


@compiled
def _without_stamp(pace: Pace, dt: float) -> Pace:
    """The pace after a row that was given the usual step, although its stamp rose by *dt* only."""
    return Pace(
        pace.step, pace.ahead + pace.step - dt, pace.back, pace.waiting + 1, 0, 0.0, 0.0, pace.scatter, pace.turns, pace.again,
        min(pace.rows + 1.0, _LONG), pace.line, counted(pace.packets, dt, False, 0, pace.rows),
    )  # fmt: skip


def unpacked(time: Floats) -> Floats:
    """(n,) s: the stamps *time* (n,) s, those of rows that came in packets evenly apart; others are left as they are."""
    return evened(time) if packed(time) else time


def evened(time: Floats, gap: float = 0.2, longest_loss: float = 1.0) -> Floats:
    """(n,) s: the stamps *time* (n,) s as the guard takes them, from the first on; *gap* and *longest_loss* are the guard's."""
    even = np.full(len(time), np.nan)
    if len(time):
        _even_out(np.ascontiguousarray(time, float), gap, longest_loss, even)
    return even


@entry
def _even_out(time: Floats, gap: float, longest_loss: float, even: Floats) -> None:
    pace, clock, now = UNKNOWN, float(time[0]), float(time[0])
    even[0] = now
    for i in range(1, len(time)):
        dt = float(time[i]) - clock
        if isfinite(time[i]):
            clock = float(time[i])
        if evenly(pace, dt, gap):
            pace = counted_on(pace, dt)
        else:
            row = timed(pace, dt, False, False, gap, longest_loss)
            pace, dt = row.pace, row.dt
        now += dt
        even[i] = now
