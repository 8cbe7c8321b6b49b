"""Rows that come in packets: one stamp for all of them, or stamps of when a host read them, one right after the other."""

from __future__ import annotations

from typing import NamedTuple

from poise.data.stamps import OFTEN, RIGHT_AFTER
from poise.math.compiled import compiled

_UNKNOWN, _LAST, _FIRST = 0, 1, 2  # rows of a packet
_SELDOM = 0.1  # of the rows have no stamp of their own: no packets any more
_LONG = 1.5  # mean steps: what a packet begins with
_LONGER = 1.5  # times the longest packet lately: what takes more is a gap
_SHORTER = 0.02  # of a new packet in how long that is, where it is shorter
_FIT = 0.1  # of a new packet in how well its rows fit
_BETTER = 0.25  # of the other's squares: packets that are alike fit both ways, and no stamp is to change its meaning
_GAP = 1.0  # s: in the mean step no longer one counts
_SHARE = 0.02  # of a new row in means: that of the last 50 or so
_FOLLOW = 1e-4  # of what a stamp is off, packet by packet
_ANEW, _MANY = 30.0, 5000.0  # rows that a pace is taken to be known from, which is a new one; and at most
_EARLY = 100.0  # of them: until then any packet may be the longest


class Packets(NamedTuple):
    """What is known of them."""

    at_once: float  # share of the rows without a stamp of their own
    mean: float  # s, of all steps, as they come
    long: bool  # the last step that was not within a packet was one between packets
    rows: float  # of the longest packet lately
    span: float  # s between the first stamps of the last packet and of the one before it
    inner: float  # s between the last packet's first stamp and its last
    by_last: float  # s²: how badly a packet's rows fit if its stamp is that of its last row
    by_first: float  # … of its first row
    anchor: int  # whose stamp a packet's is thought to be
    other: float  # s, the usual step if it is that of the other row


class Followed(NamedTuple):
    """The first row of a packet."""

    packets: Packets
    step: float  # s, the usual one
    given: float  # s that the row is taken to last
    ahead: float  # s that rows were taken to last, beyond the stamps
    rows: float  # that the usual step is known from


NONE = Packets(0.0, 0.0, False, 1.0, 0.0, 0.0, 0.0, 0.0, _UNKNOWN, 0.0)


@compiled
def in_packets(packets: Packets) -> bool:
    return packets.at_once > (OFTEN if packets.anchor == _UNKNOWN else _SELDOM)


@compiled
def begins_packet(packets: Packets, dt: float, waiting: int) -> bool:
    """Whether a stamp is that of a new packet: rows have waited for it, or it is later than of one row."""
    return in_packets(packets) and (packets.anchor != _UNKNOWN or waiting > 0 or dt > _LONG * packets.mean)


@compiled
def within_packet(packets: Packets, dt: float) -> bool:
    """Whether a row was stamped right after the one before, as if both had been read at once."""
    return dt < RIGHT_AFTER * packets.mean and (packets.long or in_packets(packets))


@compiled
def longest(packets: Packets, usual: float, rows: float, gap: float, longest_loss: float) -> float:
    """s: a longer step between stamps is a gap, whatever rows follow; *rows* are known."""
    if not in_packets(packets):
        return gap
    lately = (_LONGER * packets.rows + 1.0) * usual
    return max(gap, lately if packets.anchor != _UNKNOWN and rows > _EARLY else max(lately, longest_loss))


@compiled
def counted(packets: Packets, dt: float, alone: bool, waiting: int, rows: float) -> Packets:
    """After a row *dt* s later, *alone* if it has a stamp of its own, which *waiting* rows before it had not."""
    p, share, packet = packets, max(_SHARE, 1.0 / (rows + 1.0)), waiting + 1.0
    mean = p.mean + share * (min(dt, _GAP) - p.mean)
    if not alone:
        at_once = p.at_once + share * (1.0 - p.at_once)
        return Packets(at_once, mean, p.long, p.rows, p.span, p.inner + dt, p.by_last, p.by_first, p.anchor, p.other)
    longest_lately = max(packet, p.rows + _SHORTER * (packet - p.rows))
    at_once = (1.0 - share) * p.at_once
    return Packets(
        at_once, mean, dt > _LONG * p.mean, longest_lately, 0.0, 0.0, p.by_last, p.by_first, p.anchor, p.other
    )


@compiled
def one_by_one(packets: Packets, step: float) -> Packets:
    """After an ordinary step; *step* is the usual one."""
    return Packets((1.0 - _SHARE) * packets.at_once, step, False, packets.rows, 0.0, 0.0, 0.0, 0.0, _UNKNOWN, 0.0)


@compiled
def followed(
    packets: Packets, dt: float, step: float, ahead: float, waiting: int, rows: float, most: float
) -> Followed:
    """The first row of a packet, *dt* s after the stamp of the one before, which had *waiting* rows more.

    All rows of a packet are taken to last the usual step. A stamp is that of the packet's last row, as of a host that
    stamps what it has received, or that of its first: as the rows of the packets so far fit the time between their
    stamps. What is then still off is followed slowly. Nothing is paid back of what the first packets were taken for.
    """
    p, packet, anew, other = packets, waiting + 1.0, False, packets.other
    by_last, by_first, anchor, span = p.by_last, p.by_first, p.anchor, p.inner + dt
    after = counted(p, dt, True, waiting, rows)
    if anchor == _UNKNOWN:  # the first that is known for one
        step, rows = (step, _ANEW) if rows > _EARLY else (p.mean, 0.0)
        anchor, anew, other = _LAST, True, step
    elif p.span == 0.0:  # the first after a gap
        anew = True
    else:
        of_last = p.span - packet * (step if anchor == _LAST else other)
        of_first = span - packet * (other if anchor == _LAST else step)
        step += (of_last if anchor == _LAST else of_first) / max(rows, packet)
        other += (of_first if anchor == _LAST else of_last) / max(rows, packet)
        anew = rows <= packet  # until then the usual step was a guess
        if not anew:
            by_last += _FIT * (of_last * of_last - by_last)
            by_first += _FIT * (of_first * of_first - by_first)
        if by_first < _BETTER * by_last if anchor == _LAST else by_last < _BETTER * by_first:
            anchor, step, other, anew = _FIRST if anchor == _LAST else _LAST, other, step, True
    off = -ahead - p.inner if anchor == _LAST else dt - ahead - step
    if abs(off) > most and not anew:  # another pace
        rows, anew = min(rows, _ANEW), True
    if anew:
        ahead, off = (-p.inner if anchor == _LAST else dt - step), 0.0
    follow = max(_FOLLOW, min(packet * (1.0 / (rows + 1.0) - 1e-3), 1.0))
    given = step + min(max(follow * off, -0.5 * step), 0.5 * step)
    after = Packets(after.at_once, after.mean, after.long, after.rows, span, 0.0, by_last, by_first, anchor, other)
    return Followed(after, step, given, ahead + given - dt, min(rows + 1.0, _MANY))
