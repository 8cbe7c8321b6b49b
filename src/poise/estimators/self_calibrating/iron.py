"""Whether the length of the field shows a hard iron that the filter does not know of.

The field is as long whichever way the sensor is turned; with a hard iron beside it, it is longer where the two agree. That
needs no attitude, and so is right when the heading is still that of field and iron together. Step 10, eq. 27 and 28 of
``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from math import atan2, sqrt
from typing import TYPE_CHECKING, NamedTuple

from poise.estimators.self_calibrating.covariance import forget
from poise.estimators.self_calibrating.model import (
    BEGAN,
    COLUMNS,
    ELAPSED,
    FIELD,
    FOUND,
    IRON,
    LENGTHS,
    LOOKED,
    MAG_DELAY,
    SCALE,
    SUMMED,
    SUMS,
    TAKEN,
    TURN,
    TURNED_SINCE,
    Floats,
    Sensor,
    Sums,
    put,
    put_three,
    three,
    vector,
)
from poise.estimators.self_calibrating.recall import scale_before
from poise.estimators.self_calibrating.unproven import ANY, VAGUE, trace
from poise.math.compiled import compiled
from poise.math.matrices import I3, Mat3, inverse
from poise.math.vectors import ZERO, Vec3, dot, norm, unit

if TYPE_CHECKING:
    from poise.estimators.self_calibrating.causal import SelfCalibrating

_TIME = 60.0  # s that are remembered: enough to turn about all axes, short enough to be at one place
_TURN = 0.1  # rad: another direction of the field
_EVERY = 1.0  # s of field from one look at what they show to the next
_FITTED = 4.0  # numbers that the line has: as many samples fit any
OWN = 0.005  # lengths that the magnetometer is off by, however well the lengths agree: its soft iron
_UNTURNED = 0.05  # lengths: along an axis where the field has moved by no more, any iron explains its noise
_ROUNDS = 20  # of the fit at most: they make up for what _UNTURNED keeps it from where the field has turned
_SURE = 8.0  # sigmas that the iron must be away from none, or from the known one, …
_OFF = 4.0  # … and from the known one at least: what the filter has begun to learn of it is not to hide it
_SEEMS = 2.0  # sigmas from which on it is a doubt about the heading that something beside the known one may be there
_CAME = 0.1  # lengths: what the heading was set by must fit that iron; one that came later has not turned it
ANOTHER_WAY = 0.3  # rad: the heading is set where it is further off than a correction reaches
_N, M, _Y, _YM, _YY, MM = 0, 1, 4, 5, 8, 9  # s of field that count, and the means of m, y = |m|², y m, y², m mᵀ


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
def add_length(P: Floats, m: Vec3) -> None:
    """A sample's m and |m|², in the magnetometer's unit."""
    row = SUMS + 1
    P[row, SUMMED] += m.x
    P[row, SUMMED + 1] += m.y
    P[row, SUMMED + 2] += m.z
    P[row, SUMMED + 3] += m.x * m.x + m.y * m.y + m.z * m.z


@compiled
def forget_lengths(P: Floats) -> None:
    """No length seen yet."""
    found = P[LENGTHS, FOUND]
    for k in range(COLUMNS):
        P[LENGTHS, k] = 0.0
    P[LENGTHS, FOUND] = found


@compiled
def add_turn(P: Floats, turn: Vec3) -> None:
    """A block's turn (rad, body frame), by the gyroscope."""
    put(P, LENGTHS, TURNED_SINCE, vector(P, LENGTHS, TURNED_SINCE) + turn)


@compiled
def take_lengths(method: SelfCalibrating, P: Floats, s: Sums, length: float) -> float:
    """Takes a block's lengths in where the sensor has turned since the last, and says what time they stand for (s), or 0.

    What moves the field while nothing turns is no iron on the sensor, and a gyroscope that turns while the field stands has
    another bias.
    """
    row, per = LENGTHS, 1.0 / (s.mags * length)
    m, y = per * vector(P, SUMS + 1, SUMMED), per * float(P[SUMS + 1, SUMMED + 3]) / length
    since = vector(P, row, TURNED_SINCE)
    elapsed = float(P[row, ELAPSED]) + s.mag_time
    P[row, ELAPSED] = elapsed
    if vector(P, row, BEGAN) == ZERO:
        put(P, row, BEGAN, m)
    n = float(P[row, _N])
    moved = m - vector(P, SUMS + 1, TAKEN)
    if n > 0.0 and (dot(since, since) < _TURN * _TURN or dot(moved, moved) < _UNTURNED * _UNTURNED):
        return 0.0
    weight = min(elapsed, method.field_time)
    n = (1.0 - elapsed / (_TIME + elapsed)) * n + weight
    share = weight / n if n > 0.0 else 0.0
    mean_m, mean_y, mean_ym = vector(P, row, M), float(P[row, _Y]), vector(P, row, _YM)
    mean_yy, mean_mm = float(P[row, _YY]), three(P, row, MM)
    P[row, _N], P[row, _Y], P[row, _YY] = n, mean_y + share * (y - mean_y), mean_yy + share * (y * y - mean_yy)
    put(P, row, M, mean_m + share * (m - mean_m))
    put(P, row, _YM, mean_ym + share * (y * m - mean_ym))
    put_three(P, row, MM, mean_mm + share * (Mat3(m.x * m, m.y * m, m.z * m) - mean_mm))
    put(P, SUMS + 1, TAKEN, m)
    put(P, row, TURNED_SINCE, ZERO)
    P[row, ELAPSED] = 0.0
    P[row, LOOKED] += weight
    return weight


@compiled
def is_time_to_look(P: Floats) -> bool:
    """Whether a second of turning has passed since the last look; if so, it is begun anew."""
    due = float(P[LENGTHS, LOOKED]) >= _EVERY
    if due:
        P[LENGTHS, LOOKED] = 0.0
    return due


@compiled
def fit_of_lengths(method: SelfCalibrating, P: Floats, known: Vec3) -> Fit:
    """What iron the lengths show, from the *known* one on (eq. 27).

    |m|² = 2 mᵀb + |h|² − |b|² is a straight line in m: least squares over _TIME.
    """
    row = LENGTHS
    samples = float(P[row, _N]) / method.field_time  # that stand by themselves
    if samples < _FITTED + 1.0:
        return NO_FIT
    mean_m, mean_y, mean_mm = vector(P, row, M), float(P[row, _Y]), three(P, row, MM)
    C: Mat3 = mean_mm - Mat3(mean_m.x * mean_m, mean_m.y * mean_m, mean_m.z * mean_m)
    c = vector(P, row, _YM) - mean_y * mean_m
    b, square, information, inverted = known, 0.0, C, C
    for _ in range(_ROUNDS):
        square = mean_y - 2.0 * dot(b, mean_m) + dot(b, b)
        information = C + (_UNTURNED * _UNTURNED * square) * I3
        inverted = inverse(information)
        step: Vec3 = 0.5 * (inverted @ (c - 2.0 * (C @ b)))
        b = b + step
        if dot(step, step) < _UNTURNED * _UNTURNED * square:
            break
    square = mean_y - 2.0 * dot(b, mean_m) + dot(b, b)
    if square <= 0.0:
        return NO_FIT
    left = max(float(P[row, _YY]) - mean_y * mean_y - 4.0 * dot(b, c - C @ b), 0.0)  # variance of y about the line
    variance = (0.25 * left * samples / (samples - _FITTED) + OWN * OWN * square * square) / samples
    unseen: Mat3 = (_UNTURNED * _UNTURNED * square) * inverted
    return Fit(b, sqrt(square), information, variance, variance * inverted, unseen, 0.25 * left / (square * square))


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
    for k in range(SCALE, SCALE + 9):
        forget(P, k, 1, method.initial_scale**2)
    forget_lengths(P)
    field = Vec3(0.0, sqrt(e.x * e.x + e.y * e.y), e.z)
    spread = max(min(now.spread, shown.spread), C.x.x + C.y.y + C.z.z)
    known = Sensor(
        scale_before(P), now.velocity, field, iron, method.mag_delay, now.acc_delay, length, spread, now.wander
    )
    return known, turn
