"""What hard iron the motion so far leaves open, and whether it could turn the heading.

A sensor that was never turned shows nothing of its iron, and sigma allows only for that of a calibrated one. Step 11, eq. 29
and 30 of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from poise.estimators.self_calibrating.model import (
    BESIDE,
    BY_FIND,
    CONFIRMED,
    OPEN,
    UNPROVEN,
    Floats,
    put,
    put_three,
    three,
    vector,
)
from poise.math.compiled import compiled
from poise.math.matrices import I3, Mat3
from poise.math.vectors import ZERO, Vec3, dot

ANY = 1.0  # lengths: an iron of which nothing is known
VAGUE = 0.05  # lengths: with a larger sigma it is not known
_AS_GOOD = 2.0  # times the trace
MOST = 0.1  # rad: a heading that may be off by more is not proven; one that has been is so up to twice that


@compiled
def begin_open(P: Floats, least_iron: float) -> None:
    """An iron of ANY size may be there, unless *least_iron* says that nobody looks for one."""
    any_square = ANY * ANY if least_iron < ANY else 0.0
    put_three(P, OPEN, 0, Mat3(Vec3(any_square, 0.0, 0.0), Vec3(0.0, any_square, 0.0), Vec3(0.0, 0.0, any_square)))
    put(P, OPEN, BESIDE, ZERO)
    P[OPEN, BY_FIND] = 0.0


@compiled
def narrow(P: Floats, V: Mat3, beside: Vec3) -> None:
    """V (lengths²) of the iron beside the known one, and what there seems to be of it (lengths), which is not sure (eq. 29).

    What has been ruled out once stays so, unless a look that is as good says otherwise: without turns, a field that is
    another at another place passes for iron of any size.
    """
    now, before = trace(V), trace(three(P, OPEN, 0))
    if now < before:
        put_three(P, OPEN, 0, V)
    if now < _AS_GOOD * before:
        put(P, OPEN, BESIDE, beside)


@compiled
def left_open(P: Floats) -> Mat3:
    """Mean square of the iron that there may be beside the known one, lengths².

    What there seems to be counts along all axes: it has turned the heading in attitudes that have been, too.
    """
    d = vector(P, OPEN, BESIDE)
    return three(P, OPEN, 0) + dot(d, d) * I3


@compiled
def shrink(P: Floats, length: float) -> None:
    """In lengths of a field that is as long as *length* of those before."""
    per = 1.0 / length
    put_three(P, OPEN, 0, (per * per) * three(P, OPEN, 0))
    put(P, OPEN, BESIDE, per * vector(P, OPEN, BESIDE))


@compiled
def trace(V: Mat3) -> float:
    return V.x.x + V.y.y + V.z.z


@compiled
def judge_heading(P: Floats, east: Vec3, north: float) -> None:
    """Whether iron could turn the heading; *east* in the body frame, *north* of the field in lengths (eq. 30).

    On the sensor, or where the heading was set: until a field in turns has confirmed that.
    """
    V = left_open(P)
    most = (MOST if P[OPEN, UNPROVEN] != 0.0 else 2.0 * MOST) * north
    P[OPEN, UNPROVEN] = 1.0 if P[OPEN, CONFIRMED] == 0.0 or dot(east, V @ east) > most * most else 0.0
