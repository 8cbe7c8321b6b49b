"""The time of a row, where its stamp cannot be taken as it is: missing, repeated, set back, far ahead."""

from __future__ import annotations

from typing import NamedTuple

from poise.data.flags import CLOCK_JUMP, GAP, JITTER, TIME_DISORDER
from poise.math.compiled import compiled

SHORTEST = 1e-7  # s: a noise density over no time at all would overflow
_LONGEST = 1e12
_SHARE = 0.02  # of a new step in the usual one: that of the last 50 rows or so
_MOST = 0.1  # of the usual step: a longer one counts as that much longer, for a lost row is not a slower sensor


class Pace(NamedTuple):
    """What is known of the clock."""

    step: float  # s, the usual time between rows; 0 while unknown
    ahead: float  # s that rows were taken to last which their stamps did not show: the next stamps pay it back
    back: float  # s that the clock was set back; should it come back to its old time, that is no gap
    waiting: int  # rows since the last stamp that rose
    held: int  # rows in a row that no time was given to


class Timed(NamedTuple):
    """What a row's stamp is taken for."""

    pace: Pace
    dt: float  # s that the method steps; 0: the row is held
    flags: int


@compiled
def evenly(pace: Pace, dt: float, gap: float) -> bool:
    """Whether a step is an ordinary one, about the usual, and nothing is left to be paid back."""
    return 0.5 * pace.step < dt < 1.5 * pace.step and SHORTEST < dt <= gap and pace.ahead == 0.0 and pace.waiting == 0


@compiled
def counted_on(pace: Pace, dt: float) -> Pace:
    """The pace after an ordinary step."""
    return Pace(pace.step + _SHARE * min(dt - pace.step, _MOST * pace.step), 0.0, pace.back, 0, 0)


@compiled
def timed(pace: Pace, dt: float, repeated: bool, gap: float) -> Timed:
    """The time that a row stands for; *repeated*: it is the very row before, so that it may have been sent twice.

    A row without a stamp of its own still is a sample: it is taken to last the usual step, and that is set off against
    the stamps that follow. So stamps that come in batches, swapped rows and a clock that stands still lose no rotation.
    """
    usual = pace.step
    if not SHORTEST < dt < _LONGEST:  # NaN too
        back = min(-dt, _LONGEST) if dt < 0.0 else 0.0
        waiting = pace.waiting + 1
        if 0.0 < back <= gap:  # an older row, late: what it measured is past, and the clock goes on from its stamp
            return Timed(Pace(usual, pace.ahead + back, pace.back, pace.waiting, pace.held + 1), 0.0, TIME_DISORDER)
        if back > gap:  # the clock was set back: nothing can be set off against it any more
            flags = TIME_DISORDER | CLOCK_JUMP
            return Timed(Pace(usual, 0.0, min(pace.back + pace.ahead + back + usual, _LONGEST), 0, 0), usual, flags)
        if repeated or usual == 0.0:
            return Timed(Pace(usual, pace.ahead, pace.back, waiting, pace.held + 1), 0.0, TIME_DISORDER)
        return Timed(Pace(usual, pace.ahead + usual, pace.back, waiting, 0), usual, TIME_DISORDER)

    left, kept, flags = dt - pace.ahead, pace.back, 0
    mean = dt / (pace.waiting + 1.0)
    if mean <= gap:
        share = min(_SHARE * (pace.waiting + 1.0), 1.0)
        usual = usual + share * min(mean - usual, _MOST * usual) if usual > 0.0 else mean
    if kept > 0.0 and dt > gap and 0.0 < left - kept <= gap:  # the clock is back at the time it had
        return Timed(Pace(usual, 0.0, 0.0, 0, 0), left - kept, CLOCK_JUMP)
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
    return Timed(Pace(usual, ahead, kept, 0, 0), left, flags)
