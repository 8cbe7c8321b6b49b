"""A sensor with larger errors than expected: what was expected of them is taken back, and what was measured stays.

Parts that were calibrated one by one have gyroscopes whose scale and axes are right to some tenths of a percent, and
accelerometers to some mm/s²; of inexpensive ones, as they come, it is one to three percent and some tenths of a m/s².
Step 13 of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from math import log

from poise.estimators.self_calibrating.covariance import correct_one
from poise.estimators.self_calibrating.model import (
    ACC_BIAS,
    ACC_BIAS_WIDENED,
    OWN,
    SCALE,
    SCALE_WIDENED,
    SENSOR,
    Floats,
    X,
)
from poise.math.compiled import compiled

_EVIDENCE = 3.0  # log of how much likelier all that was measured is: twenty times
_ROUNDS = 4.0  # sixteen times as much as was expected
_AT_ONCE = 3  # numbers a block: the log has room for as many beside those of pseudo-velocity and magnetometer
_KEPT_SCALE, _KEPT_ACC_BIAS = 0, 25  # where, in the row SENSOR


@compiled
def expect_more(P: Floats, scale: float, acc_bias: float) -> None:
    """Where A, or the accelerometer's bias, is too large for the *scale* (σ) and *acc_bias* that were expected of it."""
    if not _widen(P, SCALE, 9, _KEPT_SCALE, scale, SCALE_WIDENED):
        _widen(P, ACC_BIAS, 3, _KEPT_ACC_BIAS, acc_bias, ACC_BIAS_WIDENED)


@compiled
def _widen(P: Floats, first: int, count: int, kept: int, sigma: float, counter: int) -> bool:
    """Doubles σ of the *count* errors from *first* on as it was at the start, three of them a block (eq. 38).

    That they are 0 ± σ was the first measurement. To have expected ± 2σ is one more, of a negative variance.
    """
    if sigma == 0.0:
        return False
    done = float(P[OWN, counter])
    rounds = done // count
    expected = (sigma * 2.0**rounds) ** 2
    if done == count * rounds and (rounds == _ROUNDS or _evidence(P, first, count, kept, expected) < _EVIDENCE):
        return False
    for _ in range(_AT_ONCE):
        k = int(done - count * rounds)
        if P[first + k, first + k] <= expected:  # one that walks may be less sure by now
            correct_one(P, first + k, -float(P[SENSOR, kept + k]), -4.0 / 3.0 * expected)
        done += 1.0
    P[OWN, counter] = done
    return True


@compiled
def _evidence(P: Floats, first: int, count: int, kept: int, expected: float) -> float:
    """Log of how much likelier all that was measured is with 2σ than with σ, whose square was *expected* (eq. 39)."""
    more = 0.75 / expected
    left, off = 1.0, 0.0
    for k in range(count):
        error = float(P[SENSOR, kept + k]) + P[X, first + k]
        share = 1.0 - more * min(float(P[first + k, first + k]), expected)
        left *= 4.0 * share
        off += error * error * more / share
    return 0.5 * (off - log(left))
