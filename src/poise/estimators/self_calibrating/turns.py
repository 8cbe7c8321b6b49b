"""Whether the field goes with the sensor's turns: what does is iron on it.

The gyroscope knows how the sensor has turned, whatever its heading is; in a frame that does not turn, the field stands, and
iron on the sensor goes around. Small turns tell that, which leave the field's length as it was. Step 10, eq. 33 of
``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from poise.estimators.self_calibrating.iron import NO_FIT, OWN, Fit
from poise.estimators.self_calibrating.model import (
    MEAN,
    OPEN,
    SEEN,
    SQUARE,
    TURNS,
    Floats,
    put,
    put_three,
    three,
    vector,
)
from poise.math.compiled import compiled
from poise.math.matrices import I3, Mat3, inverse, transpose
from poise.math.vectors import Vec3, dot

if TYPE_CHECKING:
    from poise.estimators.self_calibrating.causal import SelfCalibrating

_FITTED = 2.0  # numbers of each axis that the fit has, of the field's and the iron's six
_UNTURNED = 0.02  # rad: along an axis that has turned by no more, any iron explains the field
_R, _RR, _RF = 0, 9, 18  # the means of R, RᵀR, Rᵀf


@compiled
def add_to_turns(P: Floats, R: Mat3, field: Vec3, share: float) -> None:
    """A block's mean R, and its *field* f in the Earth's frame, with all iron, as a *share* of the means."""
    Rt = transpose(R)
    R_before, RR_before, RF_before = three(P, TURNS, _R), three(P, TURNS, _RR), vector(P, TURNS, _RF)
    put_three(P, TURNS, _R, R_before + share * (R - R_before))
    put_three(P, TURNS, _RR, RR_before + share * (Rt @ R - RR_before))
    put(P, TURNS, _RF, RF_before + share * (Rt @ field - RF_before))


@compiled
def forget_turns(P: Floats) -> None:
    """None seen yet."""
    for k in range(_RF + 3):
        P[TURNS, k] = 0.0


@compiled
def mean_field(P: Floats, iron: Vec3) -> Vec3:
    """The mean field in the Earth's frame without that *iron*."""
    mean: Vec3 = vector(P, OPEN, MEAN) - three(P, TURNS, _R) @ iron
    return mean


@compiled
def square_of(P: Floats, iron: Vec3) -> float:
    """The mean square of the field without that *iron*."""
    square = float(P[OPEN, SQUARE])
    return square - 2.0 * dot(iron, vector(P, TURNS, _RF)) + dot(iron, three(P, TURNS, _RR) @ iron)


@compiled
def fit_of_turns(method: SelfCalibrating, P: Floats, known: Vec3) -> Fit:
    """What iron the turns show, from the *known* one on: f = c + R b, least squares (eq. 33)."""
    samples = float(P[OPEN, SEEN]) / method.field_time  # that stand by themselves
    if samples < 2.0 * _FITTED + 1.0:
        return NO_FIT
    R = three(P, TURNS, _R)
    Rt = transpose(R)
    G: Mat3 = three(P, TURNS, _RR) - Rt @ R
    s: Vec3 = vector(P, TURNS, _RF) - Rt @ vector(P, OPEN, MEAN)
    information: Mat3 = G + (_UNTURNED * _UNTURNED) * I3
    inverted = inverse(information)
    iron: Vec3 = known + inverted @ (s - G @ known)
    field = mean_field(P, iron)
    square = dot(field, field)
    if square <= 0.0:
        return NO_FIT
    left = max(square_of(P, iron) - square, 0.0) / 3.0
    variance = (left * samples / (samples - _FITTED) + OWN * OWN * square) / samples
    unseen: Mat3 = (_UNTURNED * _UNTURNED) * inverted
    return Fit(iron, sqrt(square), information, variance, variance * inverted, unseen, left / square)
