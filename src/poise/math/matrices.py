"""Small matrices as rows of vectors, with one product for all shapes: ``A @ B @ v`` reads as in a paper."""

from __future__ import annotations

from typing import Any, NamedTuple

from poise.math.compiled import built_from, compiled, dispatched
from poise.math.quaternions import Quat
from poise.math.vectors import Vec3, cross, dot


class Mat3(NamedTuple):
    """3 × 3, three rows of Vec3."""

    x: Vec3
    y: Vec3
    z: Vec3

    def __add__(self, other: Mat3) -> Mat3:  # type: ignore[override]
        return Mat3(self.x + other.x, self.y + other.y, self.z + other.z)

    def __sub__(self, other: Mat3) -> Mat3:
        return Mat3(self.x - other.x, self.y - other.y, self.z - other.z)

    def __rmul__(self, scale: float) -> Mat3:  # type: ignore[override]
        return Mat3(scale * self.x, scale * self.y, scale * self.z)

    def __matmul__(self, other: Any) -> Any:
        return rows3(_mix3(self.x, other), _mix3(self.y, other), _mix3(self.z, other))

    def transposed(self) -> Mat3:
        return Mat3(
            Vec3(self.x.x, self.y.x, self.z.x), Vec3(self.x.y, self.y.y, self.z.y), Vec3(self.x.z, self.y.z, self.z.z)
        )


class Mat34(NamedTuple):
    """3 × 4, three rows of Quat."""

    x: Quat
    y: Quat
    z: Quat

    def __rmul__(self, scale: float) -> Mat34:  # type: ignore[override]
        return Mat34(scale * self.x, scale * self.y, scale * self.z)

    def __matmul__(self, other: Any) -> Any:
        return rows3(_mix4(self.x, other), _mix4(self.y, other), _mix4(self.z, other))

    def transposed(self) -> Mat43:
        return Mat43(
            Vec3(self.x.w, self.y.w, self.z.w),
            Vec3(self.x.x, self.y.x, self.z.x),
            Vec3(self.x.y, self.y.y, self.z.y),
            Vec3(self.x.z, self.y.z, self.z.z),
        )


class Mat43(NamedTuple):
    """4 × 3, four rows of Vec3."""

    w: Vec3
    x: Vec3
    y: Vec3
    z: Vec3

    def __rmul__(self, scale: float) -> Mat43:  # type: ignore[override]
        return Mat43(scale * self.w, scale * self.x, scale * self.y, scale * self.z)

    def __matmul__(self, other: Any) -> Any:
        return rows4(_mix3(self.w, other), _mix3(self.x, other), _mix3(self.y, other), _mix3(self.z, other))

    def transposed(self) -> Mat34:
        return Mat34(
            Quat(self.w.x, self.x.x, self.y.x, self.z.x),
            Quat(self.w.y, self.x.y, self.y.y, self.z.y),
            Quat(self.w.z, self.x.z, self.y.z, self.z.z),
        )


class Mat4(NamedTuple):
    """4 × 4, four rows of Quat."""

    w: Quat
    x: Quat
    y: Quat
    z: Quat

    def __add__(self, other: Mat4) -> Mat4:  # type: ignore[override]
        return Mat4(self.w + other.w, self.x + other.x, self.y + other.y, self.z + other.z)

    def __sub__(self, other: Mat4) -> Mat4:
        return Mat4(self.w - other.w, self.x - other.x, self.y - other.y, self.z - other.z)

    def __rmul__(self, scale: float) -> Mat4:  # type: ignore[override]
        return Mat4(scale * self.w, scale * self.x, scale * self.y, scale * self.z)

    def __matmul__(self, other: Any) -> Any:
        return rows4(_mix4(self.w, other), _mix4(self.x, other), _mix4(self.y, other), _mix4(self.z, other))

    def transposed(self) -> Mat4:
        return Mat4(
            Quat(self.w.w, self.x.w, self.y.w, self.z.w),
            Quat(self.w.x, self.x.x, self.y.x, self.z.x),
            Quat(self.w.y, self.x.y, self.y.y, self.z.y),
            Quat(self.w.z, self.x.z, self.y.z, self.z.z),
        )


I3 = Mat3(Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0))
I4 = Mat4(Quat(1.0, 0.0, 0.0, 0.0), Quat(0.0, 1.0, 0.0, 0.0), Quat(0.0, 0.0, 1.0, 0.0), Quat(0.0, 0.0, 0.0, 1.0))

# A row of the product is a mix of the other matrix's rows; what the rows are (numbers, Vec3 or Quat) decides the shape.
rows3 = built_from({Vec3: Mat3, Quat: Mat34}, Vec3)
rows4 = built_from({Vec3: Mat43, Quat: Mat4}, Quat)
transpose = dispatched("transposed")


@compiled
def _mix3(weights: Vec3, rows: Any) -> Any:
    return weights.x * rows.x + weights.y * rows.y + weights.z * rows.z


@compiled
def _mix4(weights: Quat, rows: Any) -> Any:
    return weights.w * rows.w + weights.x * rows.x + weights.y * rows.y + weights.z * rows.z


@compiled
def inverse(m: Mat3) -> Mat3:
    a, b, c = cross(m.y, m.z), cross(m.z, m.x), cross(m.x, m.y)
    adjugate: Mat3 = transpose(Mat3(a, b, c))
    return (1.0 / dot(m.x, a)) * adjugate


@compiled
def diagonal(x: float, y: float, z: float) -> Mat3:
    return Mat3(Vec3(x, 0.0, 0.0), Vec3(0.0, y, 0.0), Vec3(0.0, 0.0, z))


@compiled
def outer(u: Quat, v: Quat) -> Mat4:
    """u vᵀ."""
    return Mat4(u.w * v, u.x * v, u.y * v, u.z * v)


@compiled
def matrix(q: Quat) -> Mat3:
    """The rotation matrix of q: columns are the body's axes in the Earth frame."""
    w, x, y, z = q
    return Mat3(
        Vec3(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
        Vec3(2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
        Vec3(2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
    )
