"""What hard iron the field's length shows.

The field is as long whichever way the sensor is turned; with a hard iron beside it, it is longer where the two agree. That
needs no attitude, and so is right when the heading is still that of field and iron together. Step 10, eq. 27 of
``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from poise.estimators.self_calibrating.iron import NO_FIT, OWN, Fit
from poise.estimators.self_calibrating.model import (
    BEGAN,
    ELAPSED,
    LENGTHS,
    LOOKED,
    SUMMED,
    SUMS,
    TAKEN,
    TURNED_SINCE,
    Floats,
    Sums,
    put,
    put_three,
    three,
    vector,
)
from poise.math.compiled import compiled
from poise.math.matrices import I3, Mat3, inverse
from poise.math.vectors import ZERO, Vec3, dot

if TYPE_CHECKING:
    from poise.estimators.self_calibrating.causal import SelfCalibrating

_TIME = 60.0  # s that are remembered: enough to turn about all axes, short enough to be at one place
_TURN = 0.1  # rad: another direction of the field
_EVERY = 1.0  # s of field from one look at what they show to the next
_FITTED = 4.0  # numbers that the line has: as many samples fit any
_UNTURNED = 0.05  # lengths: along an axis where the field has moved by no more, any iron explains its noise
_ROUNDS = 20  # of the fit at most: they make up for what _UNTURNED keeps it from where the field has turned
_N, _M, _Y, _YM, _YY, _MM = 0, 1, 4, 5, 8, 9  # s of field that count, and the means of m, y = |m|², y m, y², m mᵀ


@compiled
def add_length(P: Floats, m: Vec3) -> None:
    """A sample's m and |m|², in the magnetometer's unit."""
    row = SUMS + 1
    P[row, SUMMED] += m.x
    P[row, SUMMED + 1] += m.y
    P[row, SUMMED + 2] += m.z
    P[row, SUMMED + 3] += m.x * m.x + m.y * m.y + m.z * m.z


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
    mean_m, mean_y, mean_ym = vector(P, row, _M), float(P[row, _Y]), vector(P, row, _YM)
    mean_yy, mean_mm = float(P[row, _YY]), three(P, row, _MM)
    P[row, _N], P[row, _Y], P[row, _YY] = n, mean_y + share * (y - mean_y), mean_yy + share * (y * y - mean_yy)
    put(P, row, _M, mean_m + share * (m - mean_m))
    put(P, row, _YM, mean_ym + share * (y * m - mean_ym))
    put_three(P, row, _MM, mean_mm + share * (Mat3(m.x * m, m.y * m, m.z * m) - mean_mm))
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
    mean_m, mean_y, mean_mm = vector(P, row, _M), float(P[row, _Y]), three(P, row, _MM)
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
