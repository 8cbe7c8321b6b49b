"""A gyroscope with larger errors of scale and axes than expected: what was expected is taken back, what was measured stays.

Parts that were calibrated one by one are right to some tenths of a percent; of inexpensive ones, as they come, it is one to
three. Step 13 of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from math import log, radians

from poise.estimators.self_calibrating.covariance import correct_one
from poise.estimators.self_calibrating.model import OWN, SCALE, SENSOR, WIDENED, Floats, X
from poise.estimators.self_calibrating.watch import unsure_bias
from poise.math.compiled import compiled

_EVIDENCE = 1.0  # log of how much likelier what was measured is by each column: twenty times by all three
_ROUNDS = 2.0  # four times as much as was expected
_KNOWN = 0.25  # of the variance that was expected
_BIAS = radians(0.3)  # rad/s: what of the evidence may be another bias
# In the row OWN, behind how often σ was doubled (WIDENED): which elements have been judged, a bit each, and what they said (3).
_JUDGED, _SAID = WIDENED + 1, WIDENED + 2
_ALL = 0x1FF


@compiled
def expect_more(P: Floats, sigma: float) -> None:
    """Doubles σ of A's elements as it was at the start, *sigma*, where A is too large for that (eq. 38).

    That they are 0 ± σ was the first measurement. To have expected ± 2σ is one more, of a negative variance. What passes for
    a larger A may be another bias: that is made less sure as well, for the two to be told apart.
    """
    expected = expected_now(P, sigma) ** 2
    if P[OWN, WIDENED] == _ROUNDS or sigma == 0.0 or not unlikely(P, expected):
        return
    unsure_bias(P, _BIAS**2)
    for k in range(9):
        correct_one(P, SCALE + k, -float(P[SENSOR, k]), -4.0 / 3.0 * expected)
    P[OWN, WIDENED] += 1.0
    for column in range(3):
        P[OWN, _SAID + column] = 0.0


@compiled
def expected_now(P: Floats, sigma: float) -> float:
    """σ of an element of A before anything was measured: *sigma*, doubled as often as it was."""
    return sigma * float(2.0 ** P[OWN, WIDENED])


@compiled
def unlikely(P: Floats, expected: float) -> bool:
    """Whether all that was measured is much likelier with 2σ than with σ, whose square was *expected* (eq. 39).

    Each column of A, that of turns about one axis, has to speak for it: a gyroscope is of one make, and what passes for
    another scale where something only goes round, as a push across the way does, shows in some of them. An element that has
    become known without that is judged: if it changes later on, something else has.
    """
    more = 0.75 / expected
    judged = int(P[OWN, _JUDGED])
    known, all_speak = judged, True
    for column in range(3):
        said = float(P[OWN, _SAID + column])
        evidence = said
        for row in range(3):
            k = 3 * row + column
            if judged >> k & 1:
                continue
            error = float(P[SENSOR, k]) + P[X, SCALE + k]
            variance = min(float(P[SCALE + k, SCALE + k]), expected)
            share = 1.0 - more * variance
            own = 0.5 * (error * error * more / share - log(4.0 * share))
            evidence += own
            if variance < _KNOWN * expected:
                known, said = known | 1 << k, said + own
        P[OWN, _SAID + column] = said
        all_speak = all_speak and evidence > _EVIDENCE
    P[OWN, _JUDGED] = known
    return all_speak


@compiled
def expect_as_learned(P: Floats) -> None:
    """A is what it was found to be before, and no longer what was expected of any sensor: all elements are judged."""
    P[OWN, _JUDGED] = _ALL
