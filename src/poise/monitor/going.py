"""Whether the clock of the rows goes on: what turns without time falls unseen."""

from __future__ import annotations

from typing import NamedTuple

from poise.math.compiled import compiled

_STANDS, _USUAL = 0.05, 3.0  # s, and times the usual: rows may come for so long without the clock going on
_PACKETS = 3.0


class Clock(NamedTuple):
    """Rows that come in packets may share a stamp, but not for ever."""

    rows: float  # since it went on last, that one included
    usual: float  # rows of one stamp
    pace: float  # s a row
    packets: float  # stamps so far, as many as it takes to know the two


UNSTARTED = Clock(0.0, 0.0, 0.0, 0.0)


@compiled
def gone_on(old: Clock, dt: float) -> Clock:
    """The clock after a row, *dt* later than the one before; 0 where that is not known."""
    if dt == 0.0 or old.rows == 0.0:
        return Clock(old.rows + 1.0, old.usual, old.pace, old.packets)
    rows, pace = old.rows, dt / old.rows
    if old.packets == 0.0:
        return Clock(1.0, rows, pace, 1.0)
    if old.packets < _PACKETS:  # the first packet may be the end of one
        return Clock(1.0, max(old.usual, rows), max(old.pace, pace), old.packets + 1.0)
    weight = 0.5 if rows > old.usual else 0.1
    usual = old.usual + weight * (min(rows, 4.0 * old.usual) - old.usual)  # one standstill is no packet
    return Clock(1.0, usual, old.pace + 0.05 * (min(pace, 2.0 * old.pace) - old.pace), _PACKETS)  # a gap is no pace


@compiled
def stands(clock: Clock) -> bool:
    """Whether it stands still: for 50 ms by the rows' pace, and three times the rows that usually share a stamp."""
    known = clock.packets == _PACKETS
    return known and clock.rows > _USUAL * clock.usual and (clock.rows - 1.0) * clock.pace >= _STANDS - 1e-9
