"""What a body is to do: an attitude, a rate or a motion, and slews that bound the rate and acceleration on the way."""

from __future__ import annotations

from math import nan, sqrt
from typing import Annotated, NamedTuple

from poise.math.compiled import compiled
from poise.math.quaternions import Quat, conjugate, exp, inner, log, renormalized
from poise.math.vectors import ZERO, Vec3, norm, present

NO_ATTITUDE = Quat(nan, nan, nan, nan)


class Target(NamedTuple):
    """Where a body is to be and how it is to move there; rate and acceleration as fed forward, in the target's body frame."""

    attitude: Quat
    """body to Earth, w x y z; NaN where only the rate is to be held, which is then in the body's own frame"""
    rate: Vec3 = ZERO
    """rad/s"""
    acceleration: Vec3 = ZERO
    """rad/s²"""
    torque: Vec3 = ZERO
    """N m, body frame: added as it is, for what a user knows of the torques on the body"""


@compiled
def has_attitude(target: Target) -> bool:
    """Whether it has an attitude to hold and not only a rate."""
    square = inner(target.attitude, target.attitude)
    return 0.25 < square < 4.0  # NaN is neither


class Slewing(NamedTuple):
    """A place on the way of a :class:`Slew`."""

    target: Target


class Slew(NamedTuple):
    """A motion towards a goal attitude with bounded rate and acceleration: rest to rest, the shortest turn at constant axis.

    The goal may change on the way; the rate is then turned towards the new one within the same bounds.
    """

    rate: Annotated[float, "rad/s", "largest rate on the way", (1e-6, 1e6)] = 1.0
    acceleration: Annotated[float, "rad/s²", "largest acceleration on the way", (1e-6, 1e6)] = 2.0

    def start(self, attitude: Quat, rate: Vec3) -> Slewing:
        """In *attitude*, turning at *rate* (rad/s, body frame)."""
        return Slewing(Target(attitude, rate, ZERO, ZERO))

    def step(self, state: Slewing, dt: float, goal: Quat) -> Slewing:
        """*dt* seconds later. Without time, or with a goal that is not an attitude, it stays where it is."""
        now = state.target
        turn = log(conjugate(now.attitude) * goal)
        if not (0.0 < dt < 1e3 and present(turn)):
            return state
        wanted = _approach(turn, dt, self.rate, self.acceleration)
        change = wanted - now.rate
        size, most = norm(change), self.acceleration * dt
        if size > most:
            change = (most / size) * change
        rate = now.rate + change
        return Slewing(Target(renormalized(now.attitude * exp(dt * rate)), rate, change / dt, ZERO))


@compiled
def _approach(turn: Vec3, dt: float, rate: float, acceleration: float) -> Vec3:
    """The fastest rate along *turn* (rad) from which steps of *dt* can still brake to rest at its end."""
    angle = norm(turn)
    if angle < 1e-12:
        return ZERO
    # v dt + v²/2a = angle, so that what is left after this step is enough to brake in; v = angle/dt at the very end
    speed = acceleration * (sqrt(dt * dt + 2.0 * angle / acceleration) - dt)
    return (min(speed, rate) / angle) * turn
