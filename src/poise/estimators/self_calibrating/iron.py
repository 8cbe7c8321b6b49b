"""What a fit of the field says of hard iron on the sensor, when that is sure, and what is known once it is taken over.

The fits are those of ``lengths.py`` and ``turns.py``. Step 10, eq. 28 and 29 of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from math import atan2, sqrt
from typing import TYPE_CHECKING, NamedTuple

from poise.estimators.self_calibrating.covariance import forget
from poise.estimators.self_calibrating.expected_scale import expect_as_learned, expected_now
from poise.estimators.self_calibrating.model import (
    BEGAN,
    COLUMNS,
    FIELD,
    FOUND,
    IRON,
    LENGTHS,
    MAG_DELAY,
    SCALE,
    TURN,
    Floats,
    Sensor,
    put,
    vector,
)
from poise.estimators.self_calibrating.recall import scale_before
from poise.estimators.self_calibrating.unproven import ANY, VAGUE, trace
from poise.math.compiled import compiled
from poise.math.matrices import Mat3
from poise.math.vectors import ZERO, Vec3, dot, norm, unit

if TYPE_CHECKING:
    from poise.estimators.self_calibrating.causal import SelfCalibrating

OWN = 0.005  # lengths that the magnetometer is off by, however well the lengths agree: its soft iron
_SURE = 8.0  # sigmas that the iron must be away from none, or from the known one, …
_OFF = 4.0  # … and from the known one at least: what the filter has begun to learn of it is not to hide it
_SEEMS = 2.0  # sigmas from which on it is a doubt about the heading that something beside the known one may be there
_CAME = 0.1  # lengths: what the heading was set by must fit that iron; one that came later has not turned it
ANOTHER_WAY = 0.3  # rad: the heading is set where it is further off than a correction reaches


class Shown(NamedTuple):
    """A hard iron that is to be taken over, in lengths of the field as it was known."""

    iron: Vec3
    length: float  # of the field without it; 0 where no other iron is shown than the known one
    covariance: Mat3  # of the iron
    spread: float  # mean square of what the length is off by, in lengths of that


class Fit(NamedTuple):
    """What a least-squares fit says of the iron, in lengths of the field as it was known; of length 0 where it says nothing."""

    iron: Vec3
    length: float  # of the field without it
    information: Mat3  # of the iron, times *variance*
    variance: float
    covariance: Mat3  # its inverse: of the iron
    unseen: Mat3  # the share of an axis that nothing is known of
    spread: float  # mean square of what is left, in lengths of that


NO_FIT = Fit(ZERO, 0.0, Mat3(ZERO, ZERO, ZERO), 0.0, Mat3(ZERO, ZERO, ZERO), Mat3(ZERO, ZERO, ZERO), 0.0)
NOT_SHOWN = Shown(ZERO, 0.0, Mat3(ZERO, ZERO, ZERO), 0.0)


@compiled
def forget_lengths(P: Floats) -> None:
    """No length seen yet."""
    found = P[LENGTHS, FOUND]
    for k in range(COLUMNS):
        P[LENGTHS, k] = 0.0
    P[LENGTHS, FOUND] = found


@compiled
def seems(fit: Fit, known: Vec3) -> Vec3:
    """What a *fit* says beside the *known* iron, in lengths, where that is more than chance."""
    off = fit.iron - known
    return (
        off / fit.length
        if fit.length > 0.0 and dot(off, fit.information @ off) > _SEEMS * _SEEMS * fit.variance
        else ZERO
    )


@compiled
def left_by(fit: Fit) -> Mat3:
    """V: mean square of the iron that there may be beside what the *fit* says, lengths²."""
    per = 1.0 / fit.length if fit.length > 0.0 else 0.0
    V: Mat3 = (per * per) * fit.covariance + (ANY * ANY) * (fit.unseen @ fit.unseen)
    return V


@compiled
def better(one: Fit, other: Fit) -> Fit:
    """Of two fits the one that leaves less open."""
    if one.length == 0.0 or other.length == 0.0:
        return other if one.length == 0.0 else one
    return one if trace(left_by(one)) < trace(left_by(other)) else other


@compiled
def shown_by(method: SelfCalibrating, P: Floats, known: Vec3, fit: Fit) -> Shown:
    """The iron of a *fit* where it is sure, another than the *known* one, and was there when the heading was set."""
    b, off = fit.iron, fit.iron - known
    square, variance = fit.length * fit.length, fit.variance
    least = method.least_iron**2 * square
    if 4.0 * dot(off, off) < least or max(dot(off, off), dot(b, b)) < least:
        return NOT_SHOWN
    far, large = dot(off, fit.information @ off), dot(b, fit.information @ b)
    if far < _OFF * _OFF * variance or max(far, large) < _SURE * _SURE * variance:
        return NOT_SHOWN
    if trace(fit.covariance) > VAGUE * VAGUE * square:
        return NOT_SHOWN
    if abs(norm(vector(P, LENGTHS, BEGAN) - b) - fit.length) > _CAME * fit.length:
        return NOT_SHOWN
    unknown: Mat3 = (dot(b, b) / 3.0) * (fit.unseen @ fit.unseen)  # iron as elsewhere
    return Shown(b, fit.length, fit.covariance + unknown, fit.spread)


@compiled
def set_by_field(
    method: SelfCalibrating, P: Floats, shown: Shown, seen: Vec3, rate_square: float, now: Sensor
) -> tuple[Sensor, float]:
    """What is known with the iron *shown*, and by what angle the attitude is to be turned about up (eq. 28).

    *seen* is the field without that iron, Earth frame, *rate_square* that of the rate while it was seen, by which a delay that
    is not known smears it. What was learned beside a wrong heading does not count: the delay, and what A has become of late.
    """
    per = 1.0 / shown.length
    length, iron = now.length * shown.length, per * shown.iron
    C: Mat3 = (per * per) * shown.covariance
    e: Vec3 = unit(seen)
    away = atan2(e.x, e.y)
    turn = away if abs(away) > ANOTHER_WAY else 0.0
    if turn != 0.0:
        forget(P, TURN + 2, 1, method.initial_heading**2)
    else:
        smeared = rate_square * (method.mag_delay**2 + method.mag_delay_sigma**2)
        P[TURN + 2, TURN + 2] += away * away + (trace(C) + smeared) / max(e.x * e.x + e.y * e.y, OWN)
    forget(P, IRON, 3, 0.0)
    put(P, IRON, IRON, C.x)
    put(P, IRON + 1, IRON, C.y)
    put(P, IRON + 2, IRON, C.z)
    forget(P, FIELD, 2, 0.25)
    forget(P, MAG_DELAY, 1, method.mag_delay_sigma**2)
    forget(P, SCALE, 9, expected_now(P, method.initial_scale) ** 2)
    scale = scale_before(P)
    if scale.x != ZERO or scale.y != ZERO or scale.z != ZERO:
        expect_as_learned(P)
    forget_lengths(P)
    field = Vec3(0.0, sqrt(e.x * e.x + e.y * e.y), e.z)
    spread = max(min(now.spread, shown.spread), trace(C))
    known = Sensor(
        scale, now.velocity, field, iron, method.mag_delay, now.acc_delay, length, spread, now.wander,
        now.acc_bias, now.acc_scale,
    )  # fmt: skip
    return known, turn
