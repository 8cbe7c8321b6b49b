"""The sides that a body can tip over: how far it leans across each of them, how fast, and where that ends.

A side is an edge that the body would turn about, or one of the four directions where only angles are known. The lean
across it is the angle between the vertical and the body's up in the plane across the edge: for a box on a floor it
reaches atan(d/h) exactly when the centre of mass stands above the edge.
"""

from __future__ import annotations

from math import atan2, cos, cosh, inf, log, nan, pi, sin, sinh, sqrt
from typing import NamedTuple

from poise.math.compiled import compiled
from poise.math.vectors import Vec3

EDGES = 8  # sides that a body may have; a fixed number is one compilation for all bodies
_BLIND = 0.03  # a body that lies along an edge (within 10°) has no lean across it that could be told: no rate there
_EXACT = 1e-9  # rad: what rounding makes of an angle that is at a limit


class Directions(NamedTuple):
    """One angle for each direction, rad."""

    forward: float
    back: float
    left: float
    right: float


class Side(NamedTuple):
    right: float  # the level unit vector, in the robot's frame, that points outward across the edge
    forward: float
    range: float  # rad: from here on it leans
    limit: float  # rad: from here on it cannot balance itself
    balance: float  # rad: where gravity neither rights it nor tips it


NEVER = Side(0.0, 0.0, inf, inf, 0.0)
NO_EDGES = (NEVER,) * EDGES


class Lean(NamedTuple):
    angle: float  # rad
    rate: float  # rad/s; NaN where it is not known


@compiled
def lean_across(side: Side, up: Vec3, change: Vec3) -> Lean:
    """The lean of a body with the vertical *up* in its own frame, which changes by *change* a second."""
    outward = -(side.right * up.x + side.forward * up.y)
    if up.z < 0.0 and abs(outward) < 1e-12:  # upside down: beyond every side
        return Lean(pi, 0.0)
    square = outward * outward + up.z * up.z
    angle = atan2(outward, up.z)
    if square < _BLIND:
        return Lean(angle, 0.0)
    faster = -(side.right * change.x + side.forward * change.y)
    return Lean(angle, (up.z * faster - outward * change.z) / square)


@compiled
def at_or_beyond(angle: float, limit: float) -> bool:
    return angle >= limit - _EXACT


@compiled
def beyond_by(side: Side, up: Vec3) -> float:
    """How far beyond its range, to compare sides by: the sine of that, less for one that the body lies along."""
    outward = -(side.right * up.x + side.forward * up.y)
    return outward * cos(side.range) - up.z * sin(side.range)


@compiled
def predicted(side: Side, lean: Lean, ahead: float, growth: float) -> float:
    """The lean after *ahead* s, rad; NaN where the rate is not known.

    With *growth* (1/s, √(g/l)) gravity takes part, linear about the balance point: e'' = growth² e; else the rate stays.
    """
    if growth == 0.0:
        return lean.angle + ahead * lean.rate
    away = lean.angle - side.balance
    return side.balance + away * cosh(growth * ahead) + lean.rate / growth * sinh(growth * ahead)


@compiled
def time_to(angle: float, side: Side, lean: Lean, growth: float) -> float:
    """s until the lean is *angle*, of the same motion as :func:`predicted`; NaN where it does not get there."""
    if at_or_beyond(lean.angle, angle):
        return 0.0
    end, away = angle - side.balance, lean.angle - side.balance
    if growth == 0.0 or end <= 0.0:
        return (angle - lean.angle) / lean.rate if lean.rate > 0.0 else nan
    speed = lean.rate / growth
    square = end * end - away * away + speed * speed
    if not (away + speed > 0.0 and square >= 0.0):  # gravity rights it first
        return nan
    return log((end + sqrt(square)) / (away + speed)) / growth
