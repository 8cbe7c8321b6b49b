"""Stability from geometry: where the centre of mass stands over the support decides how far a body may lean."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, degrees, isfinite, nan, radians
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.errors import MethodError
from poise.math import arrays
from poise.monitor.sides import EDGES, NO_EDGES, Directions, Side

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Support:
    """A body on its wheels, feet or skids, in the robot's frame: x right, y forward, z up from the ground, m.

    ``TipOver(edges=Support(…).edges())`` judges by it. Raises :class:`MethodError` that names the field where the figures
    make no sense, such as a polygon that the centre of mass does not stand over.
    """

    polygon: ArrayLike
    """(n, 2) right and forward, where it touches the ground; what lies inside the others' hull does not count"""
    centre: ArrayLike
    """(3,) the centre of mass without payload"""
    mass: float = nan
    """kg without payload; needed with a payload only"""
    payload: float = 0.0
    """kg"""
    payload_at: ArrayLike = (0.0, 0.0, 0.0)
    """(3,) the payload's centre of mass"""
    margin: float = radians(5.0)
    """rad, how long before it tips over the body counts as leaning"""

    def __post_init__(self) -> None:
        self.edges()

    def centre_of_mass(self) -> Floats:
        """(3,) m, payload included."""
        centre, at = _vector("centre", self.centre), _vector("payload_at", self.payload_at)
        payload = _number("payload", self.payload)
        if not payload >= 0.0:
            raise MethodError(f"Support.payload: expected kilograms, 0 or more, found {self.payload!r}")
        if payload > 0.0:
            mass = _number("mass", self.mass)
            if not mass > 0.0:
                raise MethodError(
                    f"Support.mass: expected the body's kilograms without payload, above 0, found {self.mass!r}; "
                    "how far a payload moves the centre of mass depends on it"
                )
            centre = (mass * centre + payload * at) / (mass + payload)
        if not centre[2] > 0.0:
            raise MethodError(f"Support.centre: its height must be above the ground, found {centre[2]:g} m")
        return centre

    def edges(self) -> tuple[Side, ...]:
        """The sides to tip over, for ``TipOver.edges``: each with the angle at which the centre of mass stands above it."""
        centre = self.centre_of_mass()
        margin = _number("margin", self.margin)
        if not margin >= 0.0:
            raise MethodError(f"Support.margin: expected an angle, 0 or more, found {self.margin!r}")
        corners = self._corners()
        along = np.roll(corners, -1, axis=0) - corners
        along /= np.hypot(along[:, 0], along[:, 1])[:, None]
        outward = np.column_stack([along[:, 1], -along[:, 0]])  # the corners run counter-clockwise
        distances = np.sum((corners - centre[:2]) * outward, axis=1)
        sides = []
        for i in np.argsort(distances, kind="stable"):  # the worst edge first, for whoever reads the error
            a, b, distance = corners[i], corners[(i + 1) % len(corners)], float(distances[i])
            if not distance > 1e-12:
                raise MethodError(
                    f"Support.polygon: the centre of mass at ({centre[0]:g}, {centre[1]:g}) m (right, forward) is not inside "
                    f"it but {-distance:g} m beyond the edge from {_point(a)} to {_point(b)}: the body would not stand"
                )
            limit = atan2(distance, float(centre[2]))
            if not limit > margin:
                raise MethodError(
                    f"Support.margin: {degrees(margin):g}° leaves no range: over the edge from {_point(a)} to {_point(b)} "
                    f"the body tips at {degrees(limit):.2f}°; give a smaller margin"
                )
            sides.append(Side(float(outward[i, 0]), float(outward[i, 1]), limit - margin, limit, limit))
        return (*sides, *NO_EDGES)[:EDGES]

    def margins(self) -> Directions:
        """The tilt at which the upright body tips over, rad, when it leans exactly forward, back, left or right."""
        sides = [side for side in self.edges() if isfinite(side.limit)]
        ways = {"forward": (0.0, 1.0), "back": (0.0, -1.0), "left": (-1.0, 0.0), "right": (1.0, 0.0)}
        found = {}
        for name, (right, forward) in ways.items():
            found[name] = min(
                atan2(np.tan(side.limit), facing)
                for side in sides
                if (facing := right * side.right + forward * side.forward) > 1e-9
            )
        return Directions(**found)

    def pendulum(self) -> float:
        """m: the length as a pendulum about its nearest edge, of a body whose mass is spread evenly (4/3 of the distance)."""
        centre = self.centre_of_mass()
        near = min(side.limit for side in self.edges())
        return 4.0 / 3.0 * float(centre[2]) / float(np.cos(near))

    def _corners(self) -> Floats:
        """(n, 2) the hull's corners, counter-clockwise."""
        points = arrays.numbers(self.polygon)
        if points.ndim != 2 or points.shape[1:] != (2,) or not np.isfinite(points).all():
            raise MethodError(
                f"Support.polygon: expected points (n, 2), right and forward in m, found {self.polygon!r}"
            )
        lower, upper = _chain(sorted(map(tuple, points))), _chain(sorted(map(tuple, points), reverse=True))
        corners = lower[:-1] + upper[:-1]
        if len(corners) < 3:
            raise MethodError(
                f"Support.polygon: expected three corners or more that enclose an area, found {self.polygon!r}"
            )
        if len(corners) > EDGES:
            raise MethodError(f"Support.polygon: {len(corners)} corners, {EDGES} at most")
        return np.array(corners)


def _chain(points: list[Any]) -> list[Any]:
    """Half of the convex hull of sorted points (Andrew's monotone chain)."""
    chain: list[Any] = []
    for p in points:
        while len(chain) >= 2 and _turn(chain[-2], chain[-1], p) <= 0.0:
            chain.pop()
        chain.append(p)
    return chain


def _turn(a: Any, b: Any, c: Any) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _vector(field: str, value: ArrayLike) -> Floats:
    vector = arrays.numbers(value)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise MethodError(f"Support.{field}: expected three numbers (right, forward, up in m), found {value!r}")
    return vector


def _number(field: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float, np.number)):
        raise MethodError(f"Support.{field}: expected a number, found {value!r}")
    return float(value)


def _point(p: Floats) -> str:
    return f"({p[0]:g}, {p[1]:g})"
