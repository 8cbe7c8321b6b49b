"""The first block of SelfCalibrating: whether it is in motion, where it says that up and north are.

Step 1 of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from math import atan2, cos
from typing import TYPE_CHECKING

from poise.estimators.self_calibrating.covariance import forget
from poise.estimators.self_calibrating.model import IN_MOTION, SHAKEN, TURN, TURNED, TURNING, Floats, Sums
from poise.math.compiled import compiled
from poise.math.matrices import matrix
from poise.math.quaternions import Quat, conjugate, exp, rotate, shortest_turn
from poise.math.vectors import UP, Vec3, dot, norm, unit

if TYPE_CHECKING:
    from poise.estimators.self_calibrating.causal import SelfCalibrating


@compiled
def level(method: SelfCalibrating, P: Floats, s: Sums, dt: float, calm: float) -> bool:
    """Whether the first block can say where up is: one in motion goes on for `level_time`, or until nothing moves."""
    end = method.block - 0.5 * dt
    if s.time - dt < end:  # else it was found to be in motion
        shaken = unsteady(s, method.gravity) > (SHAKEN * method.gravity) ** 2
        moves = shaken or s.rate_square > TURNING**2 * s.samples
        forget(P, TURN, 2, ((IN_MOTION if moves else 1.0) * method.initial_tilt) ** 2)
        if not moves or s.time < end:
            return s.time >= end
    return s.time >= method.level_time or calm >= method.rest_time


@compiled
def unsteady(s: Sums, gravity: float) -> float:
    """(m/s²)²: how far the force has strayed from its mean, or that from gravity's length, whatever attitude it began at."""
    if s.force_time == 0.0:
        return 0.0
    mean = (1.0 / s.force_time) * s.force
    square = s.excess_square / s.samples + 2.0 * gravity * mean.z - gravity * gravity  # of the force itself
    off = norm(mean) - gravity
    return max(square - dot(mean, mean), off * off)


@compiled
def in_motion(method: SelfCalibrating, P: Floats) -> bool:
    """Whether the first block, while it is open, seems to be in motion."""
    return float(P[TURN, TURN]) > (2.0 * method.initial_tilt) ** 2


@compiled
def levelled(method: SelfCalibrating, P: Floats, q: Quat, s: Sums) -> Quat:
    """The attitude that the first block started at, levelled by its mean force.

    In motion always; else where gravity contradicts it: then it was given, and wrong.
    """
    if s.force_time == 0.0:
        return q
    mean = (1.0 / s.force_time) * s.force
    length = norm(mean)
    off = mean.z < cos(3.0 * method.initial_tilt) * length and abs(length - method.gravity) < 0.1 * method.gravity
    return shortest_turn(unit(mean), UP) * q if off or (in_motion(method, P) and length > 0.0) else q


@compiled
def so_far(q: Quat, s: Sums) -> Quat:
    """The attitude in a first block in motion that is still open: levelled, and turned to the field, by what it has seen."""
    if s.force_time == 0.0 or dot(s.force, s.force) == 0.0:
        return q
    levelling = shortest_turn(unit(s.force), UP)
    e = rotate(levelling, s.off)
    return (exp(atan2(e.x, e.y) * UP) * levelling if s.mags > 0.0 else levelling) * q


@compiled
def turned_sums(P: Floats, s: Sums, turn: Quat, gravity: float) -> Sums:
    """What the first block has added up, in P too, as if it had begun at the attitude that it has found, *turn* from the other.

    P couples the turn with bias, A and velocity by these sums: they must be of the Earth's axes.
    """
    D = matrix(turn)
    for k in range(9):
        column: Vec3 = D @ Vec3(float(P[TURNED, k]), float(P[TURNED + 1, k]), float(P[TURNED + 2, k]))
        P[TURNED, k], P[TURNED + 1, k], P[TURNED + 2, k] = column.x, column.y, column.z
    force: Vec3 = D @ s.force
    force_late: Vec3 = D @ s.force_late
    off: Vec3 = D @ s.off
    to_delay: Vec3 = D @ s.to_delay
    excess = s.excess_square
    if s.force_time > 0.0:
        excess += 2.0 * gravity * s.samples * (s.force.z - force.z) / s.force_time
    return Sums(
        s.time, s.samples, D @ s.rotation, force, force_late, s.force_time, s.gyr, s.rate_square, max(excess, 0.0),
        s.jump_square, s.mags, s.mag_time, off, D @ s.to_iron, to_delay, D @ s.clipped, s.unmeasured,
    )  # fmt: skip


@compiled
def begun_at(method: SelfCalibrating, P: Floats, q: Quat, s: Sums, length: float) -> Quat:
    """The attitude at the end of the first block: levelled, and turned to the field unless its *length* tells of an iron."""
    at = levelled(method, P, q, s)
    if s.mags > 0.0 and length == 0.0:
        e = rotate(at * conjugate(q), s.off)
        at = exp(atan2(e.x, e.y) * UP) * at
    return at
