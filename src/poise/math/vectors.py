"""Vectors of three, as kernels see them."""

from __future__ import annotations

from math import nan, sqrt
from typing import NamedTuple

from poise.math.compiled import compiled


class Vec3(NamedTuple):
    """Three numbers along x, y, z."""

    x: float
    y: float
    z: float

    def __add__(self, other: Vec3) -> Vec3:  # type: ignore[override]  # a vector sum, not a tuple's concatenation
        return Vec3(self.x + other.x, self.y + other.y, self.z + other.z)

    def __sub__(self, other: Vec3) -> Vec3:
        return Vec3(self.x - other.x, self.y - other.y, self.z - other.z)

    def __neg__(self) -> Vec3:
        return Vec3(-self.x, -self.y, -self.z)

    def __mul__(self, scale: float) -> Vec3:  # type: ignore[override]
        return Vec3(self.x * scale, self.y * scale, self.z * scale)

    def __rmul__(self, scale: float) -> Vec3:  # type: ignore[override]
        return Vec3(scale * self.x, scale * self.y, scale * self.z)

    def __truediv__(self, scale: float) -> Vec3:
        return (1.0 / scale) * self  # one division instead of three


ZERO = Vec3(0.0, 0.0, 0.0)
UP = Vec3(0.0, 0.0, 1.0)
NORTH = Vec3(0.0, 1.0, 0.0)
ABSENT = Vec3(nan, nan, nan)  # a sensor that said nothing: a None field would not compile


@compiled
def dot(u: Vec3, v: Vec3) -> float:
    return u.x * v.x + u.y * v.y + u.z * v.z


@compiled
def cross(u: Vec3, v: Vec3) -> Vec3:
    return Vec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x)


@compiled
def norm(v: Vec3) -> float:
    return sqrt(dot(v, v))


@compiled
def unit(v: Vec3) -> Vec3:
    return v / norm(v)


@compiled
def within(v: Vec3, limit: float) -> bool:
    """Whether all three are numbers of at most *limit* in magnitude."""
    return abs(v.x) <= limit and abs(v.y) <= limit and abs(v.z) <= limit


@compiled
def present(v: Vec3) -> bool:
    """Whether a sensor said anything (all three components are finite)."""
    total = v.x + v.y + v.z
    return total - total == 0.0  # NaN and infinity are not
