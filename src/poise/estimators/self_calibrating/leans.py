"""Whether a mean specific force that leans tells of motion, although it lasts: in a bend, or where the field stands upright.

A vehicle in a bend is pushed across its way, by its speed times the rate about up; and a tilt that is wrong would move the field.
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import NamedTuple

from poise.estimators.self_calibrating.model import TURNED, Floats, Sums, put, vector
from poise.math.compiled import compiled
from poise.math.vectors import ZERO, Vec3, cross, dot

# Behind what has been turned, two rows keep the means over watch_time and over twice that: of the push (2) by a speed of 1 m/s,
# of the rate's square, of the push with the force (2), of the field's error (3), and of the time it was seen; the third
_PUSH, _RATE, _PUSHED, _ERROR, _SEEN = 18, 20, 21, 23, 26
_HEADING = 18  # keeps the turn about up
_SPEED = 10.0  # m/s: what a vehicle's speed is usually below
_STANDS = 0.3  # of what a tilt would have moved the field by: where it has moved by less, the tilt is right


class Lean(NamedTuple):
    """What a block has to say of a lean, Earth frame."""

    x: float  # the mean horizontal force, in g
    y: float
    push_x: float  # what a speed of 1 m/s along the body's own heading would push by, m/s²
    push_y: float
    field: Vec3  # the error of the field, in lengths
    seen: float  # the share of the block's time that it was seen for


@compiled
def lean_of(P: Floats, s: Sums, still: Vec3, error: Vec3, gravity: float) -> Lean:
    """Of a block; *still* its mean rate without the bias, *error* that of its field, ZERO where none was measured."""
    turn: Vec3 = s.rotation @ still
    heading = float(P[TURNED + 2, _HEADING])
    middle, rate = heading + 0.5 * turn.z, turn.z / s.time
    heading += turn.z
    if abs(heading) > pi:
        heading -= 2.0 * pi if heading > 0.0 else -2.0 * pi
    P[TURNED + 2, _HEADING] = heading
    per_time = 1.0 / (s.force_time * gravity)
    seen = s.mag_time / s.time if error != ZERO else 0.0
    return Lean(s.force.x * per_time, s.force.y * per_time, -rate * sin(middle), rate * cos(middle), error, seen)


@compiled
def take_lean(P: Floats, which: int, share: float, a: Lean) -> None:
    """Into the means, the first or the second."""
    row = TURNED + which
    P[row, _PUSH] += share * (a.push_x - P[row, _PUSH])
    P[row, _PUSH + 1] += share * (a.push_y - P[row, _PUSH + 1])
    P[row, _RATE] += share * (a.push_x * a.push_x + a.push_y * a.push_y - P[row, _RATE])
    P[row, _PUSHED] += share * (a.push_x * a.x + a.push_y * a.y - P[row, _PUSHED])
    P[row, _PUSHED + 1] += share * (a.push_x * a.y - a.push_y * a.x - P[row, _PUSHED + 1])
    error = vector(P, row, _ERROR)
    put(P, row, _ERROR, error + share * (a.seen * a.field - error))
    P[row, _SEEN] += share * (a.seen - P[row, _SEEN])


@compiled
def is_tilt(P: Floats, which: int, x: float, y: float, least: float, field: Vec3, gravity: float) -> bool:
    """Whether a mean force that leans by (x, y) g tells, beyond *least*, of a tilt (eq. 34, 35)."""
    if x * x + y * y <= least * least:
        return False
    row = TURNED + which
    # The likeliest speed along the body's own heading, and what is left without its push.
    unsure = least * gravity / _SPEED
    total = float(P[row, _RATE]) + unsure * unsure
    along, across = float(P[row, _PUSHED]) / total, float(P[row, _PUSHED + 1]) / total
    push_x, push_y = float(P[row, _PUSH]), float(P[row, _PUSH + 1])
    x -= push_x * along - push_y * across
    y -= push_y * along + push_x * across
    if x * x + y * y <= least * least:
        return False
    moved = vector(P, row, _ERROR)
    would = cross(field, Vec3(y, -x, 0.0))
    would = float(P[row, _SEEN]) * would
    return dot(moved, moved) >= _STANDS**2 * dot(would, would)


@compiled
def forget_lean(P: Floats) -> None:
    """Nothing seen yet."""
    for i in range(3):
        for k in range(_PUSH, _SEEN + 1):
            P[TURNED + i, k] = 0.0
