"""What a sample of SelfCalibrating is made into before it is added to the block: steps 2 and 3 of its page."""

from __future__ import annotations

from poise.math.compiled import compiled
from poise.math.matrices import Mat3
from poise.math.vectors import Vec3, cross


@compiled
def turned_back(v: Vec3, w: Vec3, delay: float) -> Vec3:
    """exp(−ω delay) v, to second order: a vector measured *delay* ago, in the body of now."""
    turn = (-delay) * w
    once = cross(turn, v)
    return v + once + 0.5 * cross(turn, once)


@compiled
def clipped_columns(R: Mat3, gyr: Vec3, limit: float) -> Mat3:
    """The columns of R of the axes whose rate is at the end of the range."""
    x = 1.0 if abs(gyr.x) > limit else 0.0
    y = 1.0 if abs(gyr.y) > limit else 0.0
    z = 1.0 if abs(gyr.z) > limit else 0.0
    return Mat3(
        Vec3(x * R.x.x, y * R.x.y, z * R.x.z),
        Vec3(x * R.y.x, y * R.y.y, z * R.y.z),
        Vec3(x * R.z.x, y * R.z.y, z * R.z.z),
    )
