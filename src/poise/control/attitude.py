"""AttitudeControl: the torque that brings a body to its target, from the attitude and rate that an estimator gives."""

from __future__ import annotations

from math import isfinite, sqrt
from typing import Annotated, Any, Literal, NamedTuple, Self

from poise.control.design import Matrix, check_definite, pole_gains, regulator_gains
from poise.control.target import Target, has_attitude
from poise.data.flags import GYR_MISSING, INVALID
from poise.data.packet import Output
from poise.estimators.parameters import prepared
from poise.math.compiled import compiled
from poise.math.matrices import Mat3, diagonal, inverse
from poise.math.quaternions import IDENTITY, Quat, conjugate, inner, normalize, rotate
from poise.math.vectors import ZERO, Vec3, cross, dot, norm, present

OFF, DAMPING, RATE, ATTITUDE = 0, 1, 2, 3
"""What a controller does: gives no torque, brakes the rate to zero, holds a rate, holds an attitude."""
TORQUE_LIMITED, RATE_LIMITED = 1, 2
"""Bits of :attr:`State.limited`."""

NO_LIMIT = 1e9
_BRAKING = 0.5  # share of the torque that the approach counts on to brake with: the rest is for lag and disturbances
_SWITCH = 0.1  # of the error quaternion's w: 11° beyond half a turn, before the other way round is the shorter

_UNLIMITED = Vec3(NO_LIMIT, NO_LIMIT, NO_LIMIT)
_NONE = diagonal(0.0, 0.0, 0.0)
_ANY = (-1e12, 1e12)


class State(NamedTuple):
    torque: Vec3  # N m, body frame: what the actuators are to give
    doing: int  # OFF, DAMPING, RATE or ATTITUDE
    limited: int  # bits: TORQUE_LIMITED, RATE_LIMITED
    error: Quat  # from the target's body frame to the body's, on the side on which the way back is taken
    integral: Vec3  # rad s, body frame


class AttitudeControl(NamedTuple):
    """Quaternion feedback (Wie, Weiss, Arapostathis 1989) by the shortest way, PD or PID, with feed-forward and limits.

    ``torque = D (demand − rate) + rate × J rate + J α``, ``demand = target rate − D⁻¹ (K e + L ∫e)``, where e is twice the
    vector part of the error quaternion. The demand is bounded by *rate_limit* and by what the torque can brake; the torque is
    scaled down to *torque_limit* in its direction; the integral stands still while either is limited and it would add to it.

    An attitude that is not valid is not acted on: the rate is braked to zero where it is measured (``when_invalid="damp"``),
    otherwise, and with ``"off"``, there is no torque. A target that is not a number is answered likewise. No torque is NaN.
    """

    inertia: Annotated[Mat3, "kg m²", "of the body, in its frame", _ANY]
    stiffness: Annotated[Mat3, "N m/rad", "K: torque by error", _ANY]
    damping: Annotated[Mat3, "N m s/rad", "D: torque by rate", _ANY]
    integral: Annotated[Mat3, "N m/(rad s)", "L: torque by the error summed over time; zero for PD", _ANY] = _NONE
    torque_limit: Annotated[Vec3, "N m", "largest torque about each body axis", (1e-12, NO_LIMIT)] = _UNLIMITED
    rate_limit: Annotated[float, "rad/s", "largest rate that is asked for", (1e-9, NO_LIMIT)] = NO_LIMIT
    gyroscopic: Annotated[bool, "", "whether rate × J rate is fed forward: not for a body with reaction wheels"] = True
    when_invalid: Annotated[Literal["damp", "off"], "", "without a valid attitude"] = "damp"

    @classmethod
    def design(
        cls,
        inertia: Matrix,
        bandwidth_hz: float,
        damping: float = 1.0,
        *,
        integral: float = 0.0,
        **limits: Any,
    ) -> Self:
        """Gains from what a user knows: the *inertia* (kg m²: one number, three or 3 × 3), the natural frequency of the
        closed loop and its *damping* ratio.

        *integral* is the third pole as a share of the natural frequency (0.1 takes constant torques out in about 10/ω); 0: PD.
        *limits* are the other fields. Raises :class:`MethodError`, which names the field.
        """
        return cls(*pole_gains(cls.__name__, inertia, bandwidth_hz, damping, integral), **limits)

    @classmethod
    def optimal(
        cls, inertia: Matrix, *, error_deg: float = 5.0, rate_deg: float = 30.0, torque: float = 1.0, **limits: Any
    ) -> Self:
        """The linear-quadratic regulator of the body linearised at rest: error, rate (deg/s) and *torque* (N m) of these
        sizes cost alike (Bryson's rule)."""
        sizes = {"error_deg": error_deg, "rate_deg": rate_deg, "torque": torque}
        return cls(*regulator_gains(cls.__name__, inertia, sizes), **limits)

    def start(self, out: Output, target: Target) -> State:
        return _acted(self, State(ZERO, OFF, 0, IDENTITY, ZERO), out, target, 0.0)

    def step(self, state: State, out: Output, target: Target) -> State:
        return _acted(self, state, out, target, out.dt if 0.0 < out.dt < 1.0 else 0.0)


def checked(control: AttitudeControl) -> AttitudeControl:
    """*control*, ready for a kernel. Raises :class:`MethodError`, which names the field that cannot be."""
    ready: AttitudeControl = prepared(control)
    for name, least in (("inertia", True), ("stiffness", False), ("damping", True), ("integral", False)):
        check_definite(f"{type(control).__name__}.{name}", getattr(ready, name), strictly=least)
    return ready


@compiled
def _acted(control: AttitudeControl, state: State, out: Output, target: Target, dt: float) -> State:
    known = isfinite(inner(out.attitude, out.attitude))
    valid = known and out.flags & INVALID == 0
    if not present(out.rate) or (not valid and out.flags & GYR_MISSING != 0):
        return State(ZERO, OFF, 0, state.error, state.integral)
    free = target.attitude.w != target.attitude.w  # NaN: only the rate is to be held
    wanted = (free or has_attitude(target)) and present(target.rate + target.acceleration + target.torque)
    if not wanted or not (free or valid):
        if control.when_invalid == "off":
            return State(ZERO, OFF, 0, state.error, state.integral)
        torque, limited = _given(control, out.rate, ZERO, ZERO, ZERO, 0)
        return State(torque, DAMPING if limited >= 0 else OFF, max(limited, 0), state.error, state.integral)
    if free:
        demand, limited = _bounded(target.rate, control.rate_limit)
        torque, limited = _given(control, out.rate, demand, target.acceleration, target.torque, limited)
        return State(torque, RATE if limited >= 0 else OFF, max(limited, 0), state.error, state.integral)
    error = _same_side(conjugate(normalize(target.attitude)) * out.attitude, state.error)
    e = Vec3(2.0 * error.x, 2.0 * error.y, 2.0 * error.z)
    rate = rotate(conjugate(error), target.rate)
    acceleration = rotate(conjugate(error), target.acceleration) - cross(out.rate, rate)
    summed = state.integral + dt * e
    pull: Vec3 = control.stiffness @ e + control.integral @ summed
    demand, limited = _demand(control, rate, pull, norm(e))
    torque, limited = _given(control, out.rate, demand, acceleration, target.torque, limited)
    more: Vec3 = control.integral @ e
    if limited != 0 and dot(more, pull) > 0.0:  # it could only push harder against the limit
        summed = state.integral
    return State(torque, ATTITUDE if limited >= 0 else OFF, max(limited, 0), error, summed)


@compiled
def _same_side(error: Quat, before: Quat) -> Quat:
    """Of the two quaternions of one error, that with the shorter way back; about half a turn, that of the sample before."""
    if inner(error, before) < 0.0:
        error = -error
    return -error if error.w < -_SWITCH else error


@compiled
def _bounded(v: Vec3, most: float) -> tuple[Vec3, int]:
    size = norm(v)
    return ((most / size) * v, RATE_LIMITED) if size > most else (v, 0)


@compiled
def _demand(control: AttitudeControl, rate: Vec3, pull: Vec3, angle: float) -> tuple[Vec3, int]:
    """The rate to take: that of the target and that which brings the error down, as far as it can be braked again."""
    approach: Vec3 = -(inverse(control.damping) @ pull)
    speed = norm(approach)
    limited = 0
    if speed > 0.0:
        along: Vec3 = control.inertia @ (approach / speed)
        most = control.torque_limit
        fastest = 1.0 / max(abs(along.x) / most.x, abs(along.y) / most.y, abs(along.z) / most.z)  # rad/s²
        can_brake = sqrt(2.0 * _BRAKING * fastest * angle)
        if speed > can_brake:
            approach, limited = (can_brake / speed) * approach, RATE_LIMITED
    demand, over = _bounded(rate + approach, control.rate_limit)
    return demand, limited | over


@compiled
def _given(
    control: AttitudeControl, rate: Vec3, demand: Vec3, acceleration: Vec3, extra: Vec3, limited: int
) -> tuple[Vec3, int]:
    """The torque for a demanded rate, in its direction scaled down to the limit; zero and −1 where it is not a number."""
    torque: Vec3 = control.damping @ (demand - rate) + control.inertia @ acceleration + extra
    if control.gyroscopic:
        torque = torque + cross(rate, control.inertia @ rate)
    most = control.torque_limit
    over = max(abs(torque.x) / most.x, abs(torque.y) / most.y, abs(torque.z) / most.z)
    if over > 1.0:
        torque, limited = torque / over, limited | TORQUE_LIMITED
    return (torque, limited) if present(torque) else (ZERO, -1)
