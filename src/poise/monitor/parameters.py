"""The monitor's parameters, checked in one place before a kernel sees them; mounting and tare."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, isfinite, radians
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from poise.data import axes
from poise.data.attitude import Attitude
from poise.errors import MethodError, RecordingError
from poise.estimators.parameters import prepared
from poise.math import arrays
from poise.math.quaternions import Quat, rotate, shortest_turn
from poise.math.vectors import UP, Vec3
from poise.monitor.sides import EDGES, NO_EDGES, Directions, Side
from poise.monitor.tip_over import TipOver

_SPREAD = radians(2.0)  # a tare from a body that moves is none
_RIGHT_ANGLE = radians(90.0)


def checked(tipover: Any) -> TipOver:
    """*tipover* ready for a kernel; one number for ``range`` or ``self_balancing`` stands for all four directions.

    Raises :class:`MethodError` that names the field where the parameters make no sense.
    """
    if not isinstance(tipover, TipOver):
        raise MethodError(f"expected TipOver parameters, found {type(tipover).__name__}; give TipOver(…)")
    ready: TipOver = prepared(tipover)
    ready = ready._replace(
        range=_directions("range", ready.range),
        self_balancing=_directions("self_balancing", ready.self_balancing),
        mount=_quat(ready.mount),
        edges=_edges(ready.edges),
    )
    sides: list[tuple[str, float, float]]
    if ready.edges[0].limit < 1e9:
        sides = [(f"edges[{i}]", s.range, s.limit) for i, s in enumerate(ready.edges) if s.limit < 1e9]
    else:
        sides = [(name, getattr(ready.range, name), getattr(ready.self_balancing, name)) for name in Directions._fields]
    for name, first, last in sides:
        if first > last:
            raise MethodError(
                f"TipOver.range {name}: {degrees(first):g}° is beyond the largest self-balancing angle there, "
                f"{degrees(last):g}° (self_balancing); the range comes first"
            )
        if not ready.hysteresis < first:
            raise MethodError(
                f"TipOver.hysteresis: {degrees(ready.hysteresis):g}° leaves nothing of the range {name}, "
                f"{degrees(first):g}°: a body that leaned would never be upright again; give less"
            )
        if ready.impact < last:
            raise MethodError(
                f"TipOver.impact: {degrees(ready.impact):g}° comes before the largest self-balancing angle {name}, "
                f"{degrees(last):g}°"
            )
    return ready


def mounted(words: str | ArrayLike) -> Quat:
    """The ``mount`` of a sensor: which of its axes point to the robot's right, forward and up, such as ``"y -x z"``.

    Or a rotation matrix (3, 3) from the sensor's axes to the robot's. Raises :class:`RecordingError` for anything else.
    """
    w, x, y, z = arrays.from_matrix(axes.rotation_matrix(words))
    return Quat(float(w), float(x), float(y), float(z))


def tared(tipover: TipOver, attitude: Attitude) -> TipOver:
    """*tipover* for a sensor that is not quite level: *attitude* is of the robot standing upright, without payload.

    With a payload its lean would be taken for level. Raises :class:`RecordingError` where the attitude is not valid or
    moves by more than 2°.
    """
    valid = attitude.valid & np.isfinite(attitude.quat).all(axis=1)
    if not valid.any():
        raise RecordingError("tare: no row of it has a valid attitude; take a stretch where the robot stands")
    ups = vertical_in_body(attitude[valid])
    mean = ups.mean(axis=0)
    mean /= np.linalg.norm(mean)
    spread = float(np.arccos(np.clip(ups @ mean, -1.0, 1.0)).max())
    if not spread <= _SPREAD:
        raise RecordingError(
            f"tare: the robot moves by {degrees(spread):.1f}° there, 2° at most can be told from standing; "
            "take a stretch where it stands still and upright, without payload"
        )
    return level_at(tipover, Vec3(*map(float, mean)))


def level_at(tipover: TipOver, up: Vec3) -> TipOver:
    """*tipover* with the sensor-frame direction *up* (a unit vector) for the robot's own up."""
    return tipover._replace(mount=shortest_turn(rotate(tipover.mount, up), UP) * tipover.mount)


def vertical_in_body(attitude: Attitude) -> Any:
    """(n, 3) the Earth's up in the body's frame."""
    if attitude.frame == "body":
        raise RecordingError("tilt needs an Earth frame; this attitude is relative to another body")
    with np.errstate(all="ignore"):  # rows that are no attitude are NaN, or are judged unknown
        return arrays.rotate(arrays.conjugate(attitude.to("enu").quat), np.array([0.0, 0.0, 1.0]))


def _directions(field: str, value: Any) -> Directions:
    angles = value if isinstance(value, Sequence) and not isinstance(value, str) else [value] * 4
    if len(angles) != 4:
        raise MethodError(
            f"TipOver.{field}: expected one angle, or Directions(forward, back, left, right), found {value!r}"
        )
    found = []
    for name, angle in zip(Directions._fields, angles, strict=True):
        try:
            number = float(angle)
        except (TypeError, ValueError):
            number = float("nan")
        if not number > 0.0:
            empty = " (an empty range)" if number <= 0.0 else ""
            raise MethodError(f"TipOver.{field} {name}: expected an angle above 0{empty}, found {angle!r}")
        if number > _RIGHT_ANGLE:
            hint = "; angles are in rad" if number > 2.0 * _RIGHT_ANGLE else ""
            raise MethodError(f"TipOver.{field} {name}: expected at most 90° (1.5708 rad), found {angle!r}{hint}")
        found.append(number)
    return Directions(*found)


def _quat(value: Any) -> Quat:
    try:
        w, x, y, z = (float(part) for part in value)
    except (TypeError, ValueError):
        w = x = y = z = float("nan")
    square = w * w + x * x + y * y + z * z
    if not abs(square - 1.0) < 1e-3:
        raise MethodError(f'TipOver.mount: expected a unit quaternion w x y z, found {value!r}; see mounted("y -x z")')
    return Quat(*(float(part) / square**0.5 for part in (w, x, y, z)))


def _edges(value: Any) -> tuple[Side, ...]:
    try:
        sides = [Side(*(float(number) for number in side)) for side in value]
    except (TypeError, ValueError):
        raise MethodError(f"TipOver.edges: expected sides as Support(…).edges() gives them, found {value!r}") from None
    real = [side for side in sides if side.limit < 1e9]
    if len(real) > EDGES:
        raise MethodError(f"TipOver.edges: {len(real)} edges, {EDGES} at most")
    for i, side in enumerate(real):
        good = all(map(isfinite, side)) and side.range > 0.0 and abs(side.right**2 + side.forward**2 - 1.0) < 1e-6
        if not good or side.limit > _RIGHT_ANGLE:
            raise MethodError(
                f"TipOver.edges[{i}]: expected a level unit vector and angles in (0, 90°], found {side!r}"
            )
    return (*real, *NO_EDGES)[:EDGES]
