"""What is expected of the accelerometer's delay before motion shows it: a share of the accelerometer's own interval.

Its samples may come with every row, or with some of them; the gyroscope's interval says nothing of a slower sensor.
"""

from __future__ import annotations

from poise.estimators.self_calibrating.model import ACC_DELAY, OWN, Floats
from poise.math.compiled import compiled

_IN_A_ROW, _SHORTEST, _TAKEN = (
    0,
    1,
    2,
)  # samples with rows between them; their shortest time, s; what was taken for it, s
_MEAN, _SIGMA = 0.25, 0.15  # of an interval: evenly between none and half of it
_SURE = 8.0  # samples: single ones that are lost make no slower sensor
_SLOWER = 1.5  # times what was taken


@compiled
def note_interval(P: Floats, acc_dt: float, T: float) -> None:
    """Takes note of a sample that stands for *acc_dt* s, in a row of *T* s: slower is what lets rows pass each time."""
    if acc_dt > T:
        n = float(P[OWN, _IN_A_ROW])
        P[OWN, _SHORTEST] = min(acc_dt, float(P[OWN, _SHORTEST])) if n > 0.0 else acc_dt
        P[OWN, _IN_A_ROW] = n + 1.0
    else:
        P[OWN, _IN_A_ROW] = 0.0


@compiled
def expected_delay(P: Floats, delay: float, begun: bool, rows: float) -> float:
    """s: *delay*, moved with its variance to what is expected of the interval; *rows* is that of the rows, s (eq. 37).

    One that was learned before, of the same sensor, stays.
    """
    taken = float(P[OWN, _TAKEN])
    if not begun and delay == 0.0:
        interval = rows
    elif taken > 0.0 and P[OWN, _IN_A_ROW] >= _SURE:
        interval = float(P[OWN, _SHORTEST])
        P[OWN, _IN_A_ROW] = 0.0
        if interval < _SLOWER * taken:
            return delay
    else:
        return delay
    P[OWN, _TAKEN] = interval
    P[ACC_DELAY, ACC_DELAY] += (_SIGMA * interval) ** 2 - (_SIGMA * taken) ** 2
    return delay + _MEAN * (interval - taken)
