"""What a stream starts from, and when it takes down what it has learned."""

from __future__ import annotations

from math import inf, nan
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.data.attitude import Attitude
from poise.data.learned import Learned
from poise.errors import MethodError, RecordingError
from poise.math import arrays
from poise.math.quaternions import Quat
from poise.math.vectors import Vec3


def three_finite(name: str, values: ArrayLike) -> list[float]:
    """*values* as three numbers. Raises :class:`MethodError`, with the parameter's *name*."""
    array = arrays.numbers(values)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise MethodError(f"{name}: expected three finite numbers, found {values!r}")
    return [float(v) for v in array]


def start_quaternion(start: Attitude | ArrayLike) -> Quat:
    """The attitude to start at, w x y z, body to ENU. Raises :class:`RecordingError` where it is none."""
    if isinstance(start, Attitude):
        known = np.flatnonzero(np.isfinite(start.to("enu").quat).all(axis=1))
        if not len(known):
            raise RecordingError("start: the attitude given has no row that is known")
        start = start.to("enu").quat[known[0]]
    quat = arrays.numbers(start)
    length = float(np.linalg.norm(quat)) if quat.shape == (4,) else nan
    if not 0.5 < length < 2.0:
        raise RecordingError(f"start: expected a unit quaternion w x y z (4,), found {start!r}")
    return Quat(*(float(v) for v in quat / length))


def checked_start(core: Any, start_from: Any, bias: Vec3) -> Learned:
    """What to start from. Raises :class:`MethodError` where there is nothing, or it is not for this method."""
    learned = start_from.learned if isinstance(start_from, Attitude) else start_from
    if learned is None:
        raise MethodError(
            f"start_from: the attitude given ({start_from.provenance.method or 'of no method'}) has nothing that was learned"
        )
    if not isinstance(learned, Learned):
        raise MethodError(f"start_from: expected what was learned, or an attitude that has it, found {learned!r}")
    if not hasattr(core, "start_from"):
        raise MethodError(
            f"start_from: {type(core).__name__} learns nothing about the sensors, and so cannot start from it"
        )
    if any(bias):
        raise MethodError("bias and start_from both say the gyroscope's bias; give one")
    learned.check()
    core.check_start(learned)
    return learned


def every(seconds: float, time: NDArray[np.float64]) -> list[int]:
    """How many rows there are up to the first at or after every multiple of *seconds* since the first one, and in all."""
    if not isinstance(seconds, (int, float)) or not 0.0 < seconds < inf:
        raise MethodError(f"learning: expected seconds above 0, found {seconds!r}")
    known = np.isfinite(time)
    clock = np.maximum.accumulate(np.where(known, time, -inf))
    begun = clock > -inf
    if not begun.any():
        return []
    steps = np.floor((clock[begun] - clock[begun][0]) / seconds)
    rows = np.flatnonzero(begun)[np.concatenate([[True], np.diff(steps) > 0.0])]
    if rows[-1] != (last := int(np.flatnonzero(known)[-1])):
        rows = np.append(rows, last)
    return [int(row) + 1 for row in rows]
