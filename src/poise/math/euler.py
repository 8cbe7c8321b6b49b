"""The angles of the RFU axes as a filter's state: their rates, and the fold past ±90° of pitch.

θ (pitch about x) stays in ±90°. An attitude has a second triple of angles, (±180° − θ, γ + 180°, ψ + 180°): the fold
goes from one to the other.
"""

from __future__ import annotations

from math import copysign, cos, pi, sin
from typing import NamedTuple

from poise.math.compiled import compiled
from poise.math.matrices import Mat3
from poise.math.quaternions import Angles, Quat, half_turn, wrapped
from poise.math.vectors import Vec3

_LEAST_COSINE = 0.02  # of pitch: 89°; nearer to the pole the rates of roll and heading would run away


class Slope(NamedTuple):
    """Sines and cosines of pitch and roll."""

    sp: float
    cp: float
    sr: float
    cr: float


@compiled
def slope_at(pitch: float, roll: float) -> Slope:
    return Slope(sin(pitch), cos(pitch), sin(roll), cos(roll))


@compiled
def without_heading(slope: Slope) -> Quat:
    """The attitude Rx(θ) Ry(γ)."""
    pitch, roll = half_turn(slope.cp, slope.sp), half_turn(slope.cr, slope.sr)
    return Quat(pitch.x * roll.x, pitch.y * roll.x, pitch.x * roll.y, pitch.y * roll.y)


@compiled
def rate_map(at: Slope) -> Mat3:
    """J: (θ', γ', ψ') = J w, rad/s from the body rate w (x, y, z); cos θ is kept from 0."""
    per_cp = 1.0 / copysign(max(abs(at.cp), _LEAST_COSINE), at.cp)
    tp = at.sp * per_cp
    return Mat3(Vec3(at.cr, 0.0, at.sr), Vec3(tp * at.sr, 1.0, -tp * at.cr), Vec3(-at.sr * per_cp, 0.0, at.cr * per_cp))


@compiled
def folds(pitch: float) -> bool:
    """Whether a pitch has gone past ±90°."""
    return abs(wrapped(pitch)) > 0.5 * pi


@compiled
def folded(angles: Angles) -> Angles:
    """The other triple of the same attitude, wrapped."""
    return Angles(wrapped(pi - angles.pitch), wrapped(angles.roll + pi), wrapped(angles.heading + pi))


@compiled
def off_by(measured: Angles, predicted: Angles, has_heading: bool) -> Angles:
    """Measured − predicted, wrapped, for that triple of the measured attitude which is nearer to the predicted one.

    Without a heading only pitch and roll are compared, and its difference is 0.
    """
    straight = _difference(measured, predicted, has_heading)
    other = _difference(folded(measured), predicted, has_heading)
    return other if _size(other) < _size(straight) else straight


@compiled
def _difference(a: Angles, b: Angles, has_heading: bool) -> Angles:
    heading = wrapped(a.heading - b.heading) if has_heading else 0.0
    return Angles(wrapped(a.pitch - b.pitch), wrapped(a.roll - b.roll), heading)


@compiled
def _size(difference: Angles) -> float:
    return abs(difference.pitch) + abs(difference.roll) + abs(difference.heading)
