"""A sensor with larger errors than expected: what was expected of them is taken back, and what was measured stays.

Parts that were calibrated one by one have gyroscopes whose scale and axes are right to some tenths of a percent, and
accelerometers to some mm/s²; of inexpensive ones, as they come, it is one to three percent and some tenths of a m/s².
Step 13 of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from math import log, radians

from poise.estimators.self_calibrating.covariance import correct_one
from poise.estimators.self_calibrating.model import (
    ACC_BIAS,
    OF_ACC_BIAS,
    OF_SCALE,
    OWN,
    SCALE,
    SENSOR,
    Floats,
    X,
)
from poise.estimators.self_calibrating.watch import unsure_bias
from poise.math.compiled import compiled

_EVIDENCE = 3.0  # log of how much likelier all that was measured is: twenty times
_ROUNDS = 3.0  # eight times as much as was expected
_AT_ONCE = 3  # numbers a block: the log has room for as many beside those of pseudo-velocity and magnetometer
_WARMER = radians(0.1)  # rad/s: what some kelvin make of a bias
_KNOWN = 0.25  # of the variance that was expected
_JUDGED, _SUM = (
    1,
    2,
)  # behind how often it was doubled: which numbers have been judged, a bit each, and what they spoke for
_KEPT_SCALE, _KEPT_ACC_BIAS = 0, 25  # where, in the row SENSOR


@compiled
def expect_more(P: Floats, scale: float, acc_bias: float) -> None:
    """Where A, or the accelerometer's bias, is too large for the *scale* (σ) and *acc_bias* that were expected of it.

    What passes for a larger A may be a bias that has changed a little: that is made as unsure, for both to be told apart.
    """
    before = float(P[OWN, OF_SCALE])
    if not _widen(P, SCALE, 9, _KEPT_SCALE, scale, OF_SCALE):
        _widen(P, ACC_BIAS, 3, _KEPT_ACC_BIAS, acc_bias, OF_ACC_BIAS)
    elif before % 9.0 == 0.0:
        unsure_bias(P, _WARMER**2)


@compiled
def _widen(P: Floats, first: int, count: int, kept: int, sigma: float, at: int) -> bool:
    """Doubles σ of the *count* errors from *first* on as it was at the start, three of them a block (eq. 38).

    That they are 0 ± σ was the first measurement. To have expected ± 2σ is one more, of a negative variance.
    """
    if sigma == 0.0:
        return False
    done = float(P[OWN, at])
    rounds = done // count
    expected = (sigma * 2.0**rounds) ** 2
    if done == count * rounds and (rounds == _ROUNDS or not _unlikely(P, first, count, kept, expected, at)):
        return False
    for _ in range(_AT_ONCE):
        k = int(done - count * rounds)
        if P[first + k, first + k] <= expected:  # one that walks may be less sure by now
            correct_one(P, first + k, -float(P[SENSOR, kept + k]), -4.0 / 3.0 * expected)
        done += 1.0
    P[OWN, at] = done
    P[OWN, at + _SUM] = 0.0
    return True


@compiled
def _unlikely(P: Floats, first: int, count: int, kept: int, expected: float, at: int) -> bool:
    """Whether all that was measured is much likelier with 2σ than with σ, whose square was *expected* (eq. 39).

    An error that has become known without that is judged: if it changes later on, something else has.
    """
    more = 0.75 / expected
    evidence, judged = float(P[OWN, at + _SUM]), int(P[OWN, at + _JUDGED])
    now_known, of_them = judged, evidence
    for k in range(count):
        if judged >> k & 1:
            continue
        error = float(P[SENSOR, kept + k]) + P[X, first + k]
        variance = min(float(P[first + k, first + k]), expected)
        share = 1.0 - more * variance
        own = 0.5 * (error * error * more / share - log(4.0 * share))
        evidence += own
        if variance < _KNOWN * expected:
            now_known, of_them = now_known | 1 << k, of_them + own
    if evidence > _EVIDENCE:
        return True
    P[OWN, at + _JUDGED], P[OWN, at + _SUM] = now_known, of_them
    return False
