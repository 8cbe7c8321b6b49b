"""What was known of the sensor half a minute to a minute ago, for when everything learned since turns out to be doubtful.

While a bias is wrong and not yet doubted, its error goes into what it can pass for: the gyroscope's scale, the spread of the
field, the strays of the velocity, the accelerometer's bias and scale. Eq. 25 of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from poise.estimators.self_calibrating.covariance import forget
from poise.estimators.self_calibrating.model import (
    ACC_BIAS,
    KEPT,
    OWN,
    SCALE,
    WIDENED,
    Floats,
    Sensor,
    put,
    put_sensor,
    put_three,
    sensor_of,
    three,
    vector,
)
from poise.math.compiled import compiled
from poise.math.matrices import Mat3

_EVERY = 30.0  # s from one to the next: the older of two is 30 to 60 s old
_VARIANCES, _SPREAD, _WANDER, _AGE = 9, 18, 19, 20  # where, in a row that begins with A
_ACC, _ACC_VARIANCES, _LAST = (
    24,
    28,
    32,
)  # and behind what watch.py keeps there: the accelerometer's bias (3) and scale, and P of these
_YOUNGER, _OLDER = WIDENED + 5, WIDENED + 6  # in the row OWN: how often σ of A had been doubled


@compiled
def remember(P: Floats, known: Sensor, time: float) -> None:
    """*time* s later: another memory where the last one is old."""
    P[KEPT, _AGE] += time
    if P[KEPT, _AGE] >= _EVERY:
        _hand_on(P)
        _take(P, known)


@compiled
def begin_memory(P: Floats, known: Sensor) -> None:
    """There is nothing older than *known*."""
    _take(P, known)
    _hand_on(P)


@compiled
def scale_before(P: Floats) -> Mat3:
    """A as it was in the older memory."""
    return three(P, KEPT + 1, 0)


@compiled
def recall(P: Floats, undisturbed: float) -> None:
    """Goes back to the older memory; *undisturbed* is the mean square that the field has strayed whatever the heading is."""
    known = sensor_of(P)
    row = KEPT + 1
    spread = min(known.spread, max(float(P[row, _SPREAD]), undisturbed))
    wander = min(known.wander, float(P[row, _WANDER]))
    known = Sensor(
        scale_before(P), known.velocity, known.field, known.iron, known.mag_delay, known.acc_delay, known.length,
        spread, wander, vector(P, row, _ACC), float(P[row, _ACC + 3]),
    )  # fmt: skip
    put_sensor(P, known)
    for k in range(9):
        forget(P, SCALE + k, 1, float(P[row, _VARIANCES + k]))
    for k in range(4):
        forget(P, ACC_BIAS + k, 1, float(P[row, _ACC_VARIANCES + k]))
    P[OWN, WIDENED] = P[OWN, _OLDER]
    begin_memory(P, known)


@compiled
def _take(P: Floats, known: Sensor) -> None:
    put_three(P, KEPT, 0, known.scale)
    for k in range(9):
        P[KEPT, _VARIANCES + k] = P[SCALE + k, SCALE + k]
    P[KEPT, _SPREAD], P[KEPT, _WANDER], P[KEPT, _AGE] = known.spread, known.wander, 0.0
    put(P, KEPT, _ACC, known.acc_bias)
    P[KEPT, _ACC + 3] = known.acc_scale
    for k in range(4):
        P[KEPT, _ACC_VARIANCES + k] = P[ACC_BIAS + k, ACC_BIAS + k]
    P[OWN, _YOUNGER] = P[OWN, WIDENED]


@compiled
def _hand_on(P: Floats) -> None:
    """The younger memory is the older one, too."""
    for j in range(_AGE):
        P[KEPT + 1, j] = P[KEPT, j]
    for j in range(_ACC, _LAST):
        P[KEPT + 1, j] = P[KEPT, j]
    P[OWN, _OLDER] = P[OWN, _YOUNGER]
