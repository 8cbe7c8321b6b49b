"""`Controller`: a control law running live behind a `Stream`, and the one loop that steps it."""

from __future__ import annotations

from math import nan
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.control.attitude import DAMPING, OFF, RATE_LIMITED, TORQUE_LIMITED, AttitudeControl, State, checked
from poise.control.target import NO_ATTITUDE, Slew, Slewing, Target, has_attitude
from poise.data.attitude import BIAS, BIAS_SIGMA, QUAT, RATE, SIGMA, Attitude
from poise.data.flags import INVALID
from poise.data.packet import Output
from poise.errors import MethodError
from poise.estimators.loop import state_of
from poise.estimators.parameters import prepared
from poise.estimators.protocol import start, step
from poise.math import arrays
from poise.math.compiled import compiled, entry
from poise.math.memory import Memory
from poise.math.quaternions import Quat
from poise.math.vectors import Vec3, present

Floats = NDArray[np.float64]

DOING = ("off", "damping", "rate", "attitude")


class Led(NamedTuple):
    inner: State
    slewing: Slewing


class Towards(NamedTuple):
    """*control* led to every new goal by *slew*, from where the body is and how it turns when the goal comes."""

    control: Any
    slew: Slew

    def start(self, out: Output, goal: Target) -> Led:
        slewing = start(self.slew, out.attitude, out.rate)
        return Led(start(self.control, out, _on_the_way(slewing, goal)), slewing)

    def step(self, state: Led, out: Output, goal: Target) -> Led:
        lost = state.inner.doing <= DAMPING or not has_attitude(goal)
        if lost and out.flags & INVALID == 0 and present(out.rate):  # nothing led the body here: begin where it is
            slewing = start(self.slew, out.attitude, out.rate)
        else:
            slewing = step(self.slew, state.slewing, out.dt, goal.attitude)
        return Led(step(self.control, state.inner, out, _on_the_way(slewing, goal)), slewing)


class Held(NamedTuple):
    inner: State


class Alone(NamedTuple):
    """*control* without a slew, in the shape of :class:`Towards`."""

    control: Any

    def start(self, out: Output, goal: Target) -> Held:
        return Held(start(self.control, out, goal))

    def step(self, state: Held, out: Output, goal: Target) -> Held:
        return Held(step(self.control, state.inner, out, goal))


@compiled
def _on_the_way(slewing: Slewing, goal: Target) -> Target:
    now = slewing.target
    if not (has_attitude(goal) and has_attitude(now)):
        return goal
    return Target(now.attitude, now.rate, now.acceleration, goal.torque)


@compiled
def _vector(values: Floats, at: int) -> Vec3:
    return Vec3(float(values[at]), float(values[at + 1]), float(values[at + 2]))


@compiled
def _target(values: Floats) -> Target:
    attitude = Quat(float(values[0]), float(values[1]), float(values[2]), float(values[3]))
    return Target(attitude, _vector(values, 4), _vector(values, 7), _vector(values, 10))


@compiled
def output_of(row: Floats, dt: float, flags: int) -> Output:
    """A row of an attitude as kernels see it."""
    attitude = Quat(float(row[0]), float(row[1]), float(row[2]), float(row[3]))
    return Output(dt, attitude, _vector(row, 4), _vector(row, 7), _vector(row, 10), _vector(row, 13), flags)


assert (QUAT.start, RATE.start, BIAS.start, SIGMA.start, BIAS_SIGMA.start) == (0, 4, 7, 10, 13)


@entry
def begin(law: Any, row: Floats, flags: int, target: Floats, clock: Floats) -> Any:
    """The memory of a control law, started from the first row of an attitude."""
    return Memory(law, start(law, output_of(row, 0.0, flags), _target(target)), clock)


@entry
def advance(
    memory: Any, time: Floats, table: Floats, flags: NDArray[np.uint32], targets: Floats, torques: Floats, doing: Floats
) -> None:
    """Step the law in *memory* over the rows of an attitude; the last target holds for all rows after it."""
    law, state, clock = memory.method, memory.state, memory.aside
    for i in range(len(time)):
        now = float(time[i])
        out = output_of(table[i], now - float(clock[0]), int(flags[i]))
        state = step(law, state, out, _target(targets[min(i, len(targets) - 1)]))
        told = state.inner
        torques[i, 0], torques[i, 1], torques[i, 2] = told.torque.x, told.torque.y, told.torque.z
        doing[i, 0], doing[i, 1] = told.doing, told.limited
        if now == now:
            clock[0] = now
    memory.state = state


class Controller:
    """A control law running live: give it what a `Stream` says, get the torque for the actuators.

    ``controller.hold(quat)`` sets a goal, ``torque = controller.update(stream.update(packet))[-1]`` answers every sample.
    Without a goal it brakes the rate to zero. *slew* bounds rate and acceleration of the way to a goal.
    """

    def __init__(self, control: AttitudeControl, slew: Slew | None = None) -> None:
        if not isinstance(control, AttitudeControl):
            raise MethodError(f"expected an AttitudeControl, found {type(control).__name__}")
        self.control, self.slew = control, slew
        ready = checked(control)
        self._law = Alone(ready) if slew is None else Towards(ready, prepared(slew))
        self._targets = _numbers(Target(Quat(0.0, 0.0, 0.0, 0.0)))  # no attitude, and no rate either: brake
        self._memory: Any = None
        self._doing = np.zeros((1, 2))

    def hold(self, attitude: Attitude | ArrayLike) -> None:
        """Bring the body to *attitude* (w x y z, body to the estimator's Earth frame; of an `Attitude`, its last row)."""
        quat = attitude.to("enu").quat[-1] if isinstance(attitude, Attitude) else attitude
        goal = _finite("attitude", quat, 4)
        if not 0.5 < float(np.linalg.norm(goal)) < 2.0:
            raise MethodError(f"attitude: expected a unit quaternion w x y z, found {goal.tolist()}")
        self.follow(Target(Quat(*(goal / np.linalg.norm(goal)).tolist())))

    def turn(self, rate: ArrayLike) -> None:
        """Hold *rate* (3,) rad/s, about the body's own axes, wherever that leads."""
        self.follow(Target(NO_ATTITUDE, Vec3(*_finite("rate", rate, 3).tolist())))

    def follow(self, *targets: Target) -> None:
        """Be at *targets*, one for each row of the next update; the last one holds on. A slew takes their attitude only."""
        if not targets or not all(isinstance(each, Target) for each in targets):
            raise MethodError(f"expected Target(…), one or more, found {targets!r}")
        self._targets = np.concatenate([_numbers(each) for each in targets])

    def update(self, attitude: Attitude) -> Floats:
        """(n, 3) N m, body frame: the torque after each row of *attitude*. Never NaN."""
        if not isinstance(attitude, Attitude):
            raise MethodError(f"expected an Attitude, as Stream.update returns it, found {type(attitude).__name__}")
        given = attitude if attitude.frame == "enu" else attitude.to("enu")
        n = len(given.time)
        torques, self._doing = np.zeros((n, 3)), np.zeros((n, 2))
        if n:
            table, time = np.ascontiguousarray(given.table), np.ascontiguousarray(given.time)
            if self._memory is None:
                clock = np.array([time[0] if np.isfinite(time[0]) else nan])
                self._memory = begin(self._law, table[0], int(given.flags[0]), self._targets[0], clock)
            advance(self._memory, time, table, given.flags, self._targets, torques, self._doing)
            self._targets = self._targets[-1:]
        return torques

    @property
    def doing(self) -> str:
        """What it did at the last row: ``off``, ``damping``, ``rate`` or ``attitude``."""
        return DOING[int(self._doing[-1, 0])] if len(self._doing) else DOING[OFF]

    @property
    def limited(self) -> tuple[str, ...]:
        """Which limits held it back at the last row: ``torque``, ``rate``."""
        bits = int(self._doing[-1, 1]) if len(self._doing) else 0
        return tuple(name for name, bit in (("torque", TORQUE_LIMITED), ("rate", RATE_LIMITED)) if bits & bit)

    @property
    def target(self) -> Target | None:
        """Where it wants the body to be at this instant: on the way of the slew; None before the first row."""
        if self._memory is None:
            return None
        slewing = getattr(state_of(self._memory), "slewing", None)
        values = self._targets[-1]
        goal = Target(Quat(*values[:4]), Vec3(*values[4:7]), Vec3(*values[7:10]), Vec3(*values[10:]))
        return goal if slewing is None or np.isnan(values[0]) else slewing.target


def _numbers(target: Target) -> Floats:
    named = zip(target._fields, target, (4, 3, 3, 3), strict=True)
    return np.concatenate([_finite(name, part, size, missing=True) for name, part, size in named])[None, :]


def _finite(name: str, values: ArrayLike, size: int, *, missing: bool = False) -> Floats:
    found = arrays.numbers(values)
    if found.shape != (size,) or not (missing or np.isfinite(found).all()):
        raise MethodError(f"{name}: expected {size} finite numbers, found {values!r}")
    return found
