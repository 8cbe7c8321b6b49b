"""The rows of a first block in motion, which lasts for seconds: what `smooth` makes of them once its end is known."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import QUAT, Attitude
from poise.data.flags import CLOCK_JUMP, GAP, GYR_CLIPPED, GYR_MISSING, LOST, RESET, UNSETTLED
from poise.math import arrays

Floats = NDArray[np.float64]

_BROKEN = GAP | LOST | RESET | GYR_MISSING | GYR_CLIPPED | CLOCK_JUMP  # what was turned there was not measured


def turn_back(attitude: Attitude, rows: NDArray[np.intp], bias: Floats, A: Floats, A_sigma: float) -> None:
    """Turns the *rows* before the first end back from it, by the *bias* (3,) rad/s and *A* (3, 3) that were not known then.

    Each has had the turn that its end was corrected by; between it and the end the gyroscope was read with the bias and the
    scale of the start. What is not known of them adds to sigma. Rows in which something was not measured stay unsettled.
    """
    starting = (attitude.flags[rows] & np.uint32(UNSETTLED)) != 0
    if len(rows) < 2 or not starting.any():
        return
    if (attitude.flags[rows] & np.uint32(_BROKEN)).any():
        attitude.flags[rows] |= np.uint32(UNSETTLED)
        return
    quat = attitude.table[rows, QUAT]
    rate, seconds = attitude.rate[rows], np.maximum(np.diff(attitude.time[rows], prepend=attitude.time[rows[0]]), 0.0)
    read_wrongly = arrays.rotate(quat, bias - rate @ A.T) * seconds[:, None]
    turned = arrays.rotate(quat, rate) * seconds[:, None]
    left, swept, time = (_after(x) for x in (read_wrongly, turned, seconds[:, None]))
    half = 0.5 * np.linalg.norm(left, axis=1, keepdims=True)
    turn = np.concatenate([np.cos(half), 0.5 * left * np.sinc(half / np.pi)], axis=1)
    attitude.table[rows, QUAT] = arrays.multiply(turn, quat)
    unknown = (attitude.bias_sigma[rows].max(axis=1) * time[:, 0]) ** 2 + A_sigma**2 * (swept**2).sum(axis=1)
    attitude.sigma[rows] = np.minimum(np.sqrt(attitude.sigma[rows] ** 2 + unknown[:, None]), np.pi)
    attitude.flags[rows] &= ~np.uint32(UNSETTLED)


def _after(steps: Floats) -> Floats:
    """(n, k): the sum of all *steps* (n, k) behind each."""
    return np.cumsum(steps[::-1], axis=0)[::-1] - steps
