"""Unit quaternions, w x y z, and the angles of the RFU axes (x right, y forward, z up).

An attitude q turns body vectors into Earth vectors (ENU: x east, y north, z up): ``v_earth = rotate(q, v_body)``.
"""

from __future__ import annotations

from math import asin, atan2, cos, pi, sin, sqrt
from typing import NamedTuple

from poise.math.compiled import compiled
from poise.math.vectors import ZERO, Vec3, cross, dot, norm, unit

TINY = 1e-100  # a length below it comes from squares that have lost their digits: its direction is no direction


class Quat(NamedTuple):
    """A quaternion, scalar first; ``p * q`` turns by q, then by p."""

    w: float
    x: float
    y: float
    z: float

    def __mul__(self, other: Quat) -> Quat:  # type: ignore[override]  # Hamilton's product, not a tuple's repetition
        return Quat(
            self.w * other.w - self.x * other.x - self.y * other.y - self.z * other.z,
            self.w * other.x + self.x * other.w + self.y * other.z - self.z * other.y,
            self.w * other.y - self.x * other.z + self.y * other.w + self.z * other.x,
            self.w * other.z + self.x * other.y - self.y * other.x + self.z * other.w,
        )

    def __rmul__(self, scale: float) -> Quat:  # type: ignore[override]
        return Quat(scale * self.w, scale * self.x, scale * self.y, scale * self.z)

    def __add__(self, other: Quat) -> Quat:  # type: ignore[override]
        return Quat(self.w + other.w, self.x + other.x, self.y + other.y, self.z + other.z)

    def __sub__(self, other: Quat) -> Quat:
        return Quat(self.w - other.w, self.x - other.x, self.y - other.y, self.z - other.z)

    def __neg__(self) -> Quat:
        return Quat(-self.w, -self.x, -self.y, -self.z)


IDENTITY = Quat(1.0, 0.0, 0.0, 0.0)


class Angles(NamedTuple):
    """Pitch θ about x, roll γ about y, heading ψ about z (counter-clockwise from north), rad: q = Rz(ψ) Rx(θ) Ry(γ)."""

    pitch: float
    roll: float
    heading: float


@compiled
def conjugate(q: Quat) -> Quat:
    return Quat(q.w, -q.x, -q.y, -q.z)


@compiled
def inner(p: Quat, q: Quat) -> float:
    """The dot product of two quaternions as vectors of four."""
    return p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z


@compiled
def normalize(q: Quat) -> Quat:
    return (1.0 / sqrt(inner(q, q))) * q


@compiled
def renormalized(q: Quat) -> Quat:
    """A unit quaternion that one product has moved by rounding: a Newton step instead of a root and a division."""
    square = inner(q, q)
    if abs(square - 1.0) < 1e-7:  # the step's own error is 3/8 of the square of that
        return (1.5 - 0.5 * square) * q
    return (1.0 / sqrt(square)) * q


@compiled
def rotate(q: Quat, v: Vec3) -> Vec3:
    """v turned by q."""
    tx = 2.0 * (q.y * v.z - q.z * v.y)
    ty = 2.0 * (q.z * v.x - q.x * v.z)
    tz = 2.0 * (q.x * v.y - q.y * v.x)
    return Vec3(
        v.x + q.w * tx + q.y * tz - q.z * ty,
        v.y + q.w * ty + q.z * tx - q.x * tz,
        v.z + q.w * tz + q.x * ty - q.y * tx,
    )


@compiled
def exp(v: Vec3) -> Quat:
    """The quaternion of a turn by |v| rad about v."""
    square = 0.25 * dot(v, v)  # of half the angle
    if square < 0.01:  # the usual step between two samples: the series is exact to the last bit and needs no root
        c = 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0)))
        s = 0.5 - square / 12.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)))
        return Quat(c, s * v.x, s * v.y, s * v.z)
    half = sqrt(square)
    s = 0.5 * sin(half) / half
    return Quat(cos(half), s * v.x, s * v.y, s * v.z)


@compiled
def log(q: Quat) -> Vec3:
    """The rotation vector of q, of at most half a turn: the inverse of :func:`exp`."""
    sine = sqrt(q.x * q.x + q.y * q.y + q.z * q.z)
    scale = 2.0 if sine < 1e-9 else 2.0 * atan2(sine, abs(q.w)) / sine
    if q.w < 0.0:
        scale = -scale
    return Vec3(scale * q.x, scale * q.y, scale * q.z)


@compiled
def up_in_body(q: Quat) -> Vec3:
    """The body-frame direction of up, qᵀ e_z."""
    return Vec3(
        2.0 * (q.x * q.z - q.w * q.y),
        2.0 * (q.y * q.z + q.w * q.x),
        q.w * q.w - q.x * q.x - q.y * q.y + q.z * q.z,
    )


@compiled
def north_in_body(q: Quat) -> Vec3:
    """The body-frame direction of north, qᵀ e_y."""
    return Vec3(
        2.0 * (q.x * q.y + q.w * q.z),
        q.w * q.w - q.x * q.x + q.y * q.y - q.z * q.z,
        2.0 * (q.y * q.z - q.w * q.x),
    )


@compiled
def shortest_turn(u: Vec3, v: Vec3) -> Quat:
    """The smallest turn that takes the unit vector u to the unit vector v."""
    w = 1.0 + u.x * v.x + u.y * v.y + u.z * v.z
    if w < 1e-12:  # opposite: half a turn about any axis across u
        return normalize(Quat(0.0, -u.y, u.x, 0.0) if abs(u.z) < 0.9 else Quat(0.0, 0.0, -u.z, u.y))
    return normalize(Quat(w, u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x))


@compiled
def from_angles(angles: Angles) -> Quat:
    """q = Rz(ψ) Rx(θ) Ry(γ)."""
    cp, sp = cos(0.5 * angles.pitch), sin(0.5 * angles.pitch)
    cr, sr = cos(0.5 * angles.roll), sin(0.5 * angles.roll)
    ch, sh = cos(0.5 * angles.heading), sin(0.5 * angles.heading)
    return Quat(
        ch * cp * cr - sh * sp * sr,
        ch * sp * cr - sh * cp * sr,
        ch * cp * sr + sh * sp * cr,
        ch * sp * sr + sh * cp * cr,
    )


@compiled
def pitch_of(acc: Vec3) -> float:
    """θ of a resting sensor, rad."""
    return asin(min(max(acc.y / norm(acc), -1.0), 1.0))


@compiled
def roll_of(acc: Vec3) -> float:
    """γ of a resting sensor, rad."""
    return atan2(-acc.x, acc.z)


@compiled
def angles_of(acc: Vec3, mag: Vec3) -> Angles:
    """Pitch, roll and magnetic heading of a resting sensor; heading 0 where mag says nothing.

    ``f = g (−sin γ cos θ, sin θ, cos γ cos θ)`` at rest.
    """
    pitch, roll = pitch_of(acc), roll_of(acc)
    cp, sp, cr, sr = cos(pitch), sin(pitch), cos(roll), sin(roll)
    heading = atan2(cr * mag.x + sr * mag.z, sp * sr * mag.x + cp * mag.y - sp * cr * mag.z)
    return Angles(pitch, roll, heading if heading == heading else 0.0)


@compiled
def attitude_of(acc: Vec3, mag: Vec3, declination: float) -> Quat:
    """The attitude of a resting sensor from its specific force and the field; heading 0 where mag says nothing.

    The same as ``from_angles(angles_of(acc, mag))`` with ψ_true = ψ − D (*declination* D in rad, east positive), worked
    out on the sines and cosines of the angles, without the angles.
    """
    up = unit(acc)
    sp = min(max(up.y, -1.0), 1.0)
    cp = sqrt(up.x * up.x + up.z * up.z)
    cr, sr = (up.z / cp, -up.x / cp) if cp > TINY else (1.0, 0.0)
    y = cr * mag.x + sr * mag.z
    x = sp * sr * mag.x + cp * mag.y - sp * cr * mag.z
    length = sqrt(x * x + y * y)
    ch, sh = (x / length, y / length) if length > TINY else (1.0, 0.0)  # no field, or one that points along up
    if declination != 0.0 and length > TINY:
        cd, sd = cos(declination), sin(declination)
        ch, sh = ch * cd + sh * sd, sh * cd - ch * sd
    pitch, roll, heading = half_turn(cp, sp), half_turn(cr, sr), half_turn(ch, sh)
    return Quat(
        heading.x * pitch.x * roll.x - heading.y * pitch.y * roll.y,
        heading.x * pitch.y * roll.x - heading.y * pitch.x * roll.y,
        heading.x * pitch.x * roll.y + heading.y * pitch.y * roll.x,
        heading.x * pitch.y * roll.y + heading.y * pitch.x * roll.x,
    )


class CosSin(NamedTuple):
    x: float
    y: float


@compiled
def half_turn(c: float, s: float) -> CosSin:
    """Cosine and sine of half the angle in (−π, π] that has cosine c and sine s."""
    if c >= 0.0:
        half = sqrt(0.5 + 0.5 * c)
        return CosSin(half, 0.5 * s / half)
    half = sqrt(0.5 - 0.5 * c)
    half = -half if s < 0.0 else half
    return CosSin(0.5 * s / half, half)


@compiled
def angles_from(q: Quat) -> Angles:
    """The angles of q = Rz(ψ) Rx(θ) Ry(γ), pitch in ±90°."""
    up = up_in_body(q)
    heading = atan2(2.0 * (q.w * q.z - q.x * q.y), q.w * q.w - q.x * q.x + q.y * q.y - q.z * q.z)
    return Angles(asin(min(max(up.y, -1.0), 1.0)), atan2(-up.x, up.z), heading)


@compiled
def north_of(up: Vec3, mag: Vec3, declination: float) -> Vec3:
    """True north in the body frame, level with *up*, from the field, as :func:`attitude_of` has it; zero where it has none."""
    east = cross(mag, up)
    length = norm(east)
    if length <= TINY:  # the field points along up
        return ZERO
    east = east / length
    north = cross(up, east)
    if declination == 0.0:
        return north
    return cos(declination) * north - sin(declination) * east


@compiled
def wrapped(angle: float) -> float:
    """The same angle in [−π, π]."""
    if -pi <= angle <= pi:
        return angle
    return (angle + pi) % (2.0 * pi) - pi
