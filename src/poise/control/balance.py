"""BalanceControl: the wheel torques that keep a two-wheeled robot upright and drive it at a wanted speed."""

from __future__ import annotations

from math import atan2, radians
from typing import Annotated, Any, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.control.attitude import OFF
from poise.control.controller import DOING, output_of
from poise.control.design import lqr, positive
from poise.data.attitude import Attitude
from poise.data.flags import INVALID
from poise.data.packet import Output
from poise.errors import MethodError
from poise.estimators.loop import state_of
from poise.estimators.parameters import prepared
from poise.estimators.protocol import start, step
from poise.math.compiled import compiled, entry
from poise.math.memory import Memory
from poise.math.quaternions import inner, up_in_body
from poise.math.vectors import dot, present

Floats = NDArray[np.float64]
BALANCING = 3  # as ATTITUDE: it holds one
_GRAVITY = 9.81


class Wheels(NamedTuple):
    """How far the wheels have turned against the body, positive forward, as encoders tell it."""

    left: float
    """rad"""
    right: float
    """rad"""


class Drive(NamedTuple):
    """How a robot is to drive."""

    speed: float = 0.0
    """m/s, positive forward"""
    turn: float = 0.0
    """rad/s, counter-clockwise"""


class State(NamedTuple):
    left: float  # N m, positive forward
    right: float  # N m
    doing: int  # OFF or BALANCING
    rolled: Wheels  # m, how far each wheel has rolled
    hubs: Wheels  # m/s, the axle's speed as each wheel tells it, smoothed
    speed: float  # m/s, of the axle
    way: float  # m, that it has gone
    wanted: float  # m, where it was to be by now
    pace: float  # m/s, the wanted speed on its ramp
    lean: float  # rad
    blind: float  # s since the attitude was valid


class BalanceControl(NamedTuple):
    """State feedback of lean, its rate, speed and way; body axes x right, y forward, z up.

    ``torque = Kφ φ + Kω φ' + Kv (v − v*) + Ks (s − s*)`` for both wheels together; s* runs with the wanted speed v*, which
    changes by no more than *acceleration*, and is dragged along where s is more than *reach* away. Without a valid attitude, a
    measured rate and wheels, or leaning beyond *give_up*, there is no torque; but for *bridge* s a lean that was valid
    before is carried on by the measured rate. No torque is ever NaN.

    A wheel that leaves the ground spins up within some hundredths of a second, and a speed that believed it would make both
    motors follow. So each wheel tells the axle's speed, with the gyroscope's turning rate over *track* taken out; the one
    that agrees with the speed before counts more, the speed changes by no more than *grip* allows, and what a wheel spins
    faster than the axle goes is braked by *traction*.
    """

    way: Annotated[float, "N m/m", "Ks"]
    speed: Annotated[float, "N m s/m", "Kv"]
    lean: Annotated[float, "N m/rad", "Kφ"]
    lean_rate: Annotated[float, "N m s/rad", "Kω"]
    wheel_radius: Annotated[float, "m", "of a wheel", (1e-4, 10.0)]
    turn: Annotated[float, "N m s/rad", "torque of each wheel by the error of the turning rate"] = 0.1
    torque_limit: Annotated[float, "N m", "most torque of each wheel", (1e-9, 1e9)] = 1e9
    acceleration: Annotated[float, "m/s²", "how fast the wanted speed changes", (1e-6, 1e6)] = 0.3
    reach: Annotated[float, "m", "how far the way may be off before what is wanted gives in", (1e-6, 1e6)] = 0.3
    smoothing: Annotated[float, "s", "time constant of the speed, against the encoders' steps"] = 0.02
    track: Annotated[float, "m", "from wheel to wheel", (1e-3, 100.0)] = 0.2
    grip: Annotated[float, "m/s²", "most acceleration that the tyres can give", (1e-3, 1e6)] = 8.0
    slip: Annotated[float, "m/s", "how far a wheel's speed may be off by the encoder's steps", (1e-6, 1e6)] = 0.1
    traction: Annotated[float, "N m s/m", "torque against the slip of a wheel beyond that"] = 0.3
    bridge: Annotated[
        float, "s", "how long it balances on by the rate alone when the attitude is not valid", (0.0, 60.0)
    ] = 0.0
    give_up: Annotated[float, "rad", "largest lean that is still balanced", (0.0, 3.2)] = radians(50.0)

    @classmethod
    def design(
        cls,
        body_mass: float,
        height: float,
        wheel_radius: float,
        *,
        body_inertia: float | None = None,
        wheel_mass: float = 0.0,
        wheel_inertia: float | None = None,
        way: float = 0.1,
        speed: float = 0.2,
        lean_deg: float = 5.0,
        torque: float = 0.3,
        **limits: Any,
    ) -> Self:
        """The linear-quadratic regulator of the robot linearised upright, from its masses (kg; the wheels' together) and the
        *height* (m) of the body's centre of mass above the axle.

        Inertias (kg m², body about its centre of mass across the wheels) default to a rod of twice the height and to
        discs. Errors of *way* (m), *speed* (m/s) and *lean_deg* cost as much as *torque* (N m) of both wheels together.
        """
        name = cls.__name__
        m, h = positive(name, "body_mass", body_mass, "kg"), positive(name, "height", height, "m")
        r, mw = (
            positive(name, "wheel_radius", wheel_radius, "m"),
            positive(name, "wheel_mass", wheel_mass, "kg", zero=True),
        )
        ib = (
            m * (2.0 * h) ** 2 / 12.0 if body_inertia is None else positive(name, "body_inertia", body_inertia, "kg m²")
        )
        given = 0.5 * mw * r * r if wheel_inertia is None else wheel_inertia
        iw = positive(name, "wheel_inertia", given, "kg m²", zero=True)
        mass = np.array([[m + mw + iw / r**2, m * h], [m * h, ib + m * h * h]])
        by_lean, by_torque = np.linalg.solve(mass, [[0.0, 1.0 / r], [m * _GRAVITY * h, -1.0]]).T  # of s'' and φ''
        a, b = np.zeros((4, 4)), np.zeros((4, 1))
        a[0, 1] = a[2, 3] = 1.0
        a[[1, 3], 2], b[[1, 3], 0] = by_lean, by_torque
        sizes = (
            positive(name, "way", way),
            positive(name, "speed", speed),
            radians(positive(name, "lean_deg", lean_deg)),
        )
        cost = np.diag([*(each**-2.0 for each in sizes), 0.0])
        gains = -lqr(a, b, cost, positive(name, "torque", torque) ** -2.0)[0]
        k_way, k_speed, k_lean, k_rate = (float(each) for each in gains)
        return cls(k_way, k_speed, k_lean, k_rate, r, **limits)

    def start(self, out: Output, wheels: Wheels, drive: Drive) -> State:
        up = up_in_body(out.attitude)
        return _rest(_rolled(self, atan2(-up.y, up.z), wheels))

    def step(self, state: State, out: Output, wheels: Wheels, drive: Drive) -> State:
        dt = out.dt if 0.0 < out.dt < 1.0 else 0.0
        up = up_in_body(out.attitude)
        valid, blind, lean = out.flags & INVALID == 0, 0.0, atan2(-up.y, up.z)
        if not valid:
            blind, lean = state.blind + dt, state.lean - out.rate.x * dt
            valid = state.doing == BALANCING and blind <= self.bridge
        rolled = _rolled(self, lean, wheels)
        known = inner(out.attitude, out.attitude) + rolled.left + rolled.right + drive.speed + drive.turn
        stands = valid and present(out.rate) and known - known == 0.0 and abs(lean) <= self.give_up
        if not stands:
            return _rest(rolled)
        hubs, speed = state.hubs, state.speed
        if dt > 0.0:
            apart = 0.5 * self.track * dot(out.rate, up)
            before = state.rolled if _told(state.rolled) else rolled
            gain = dt / (self.smoothing + dt)
            left = hubs.left + gain * ((rolled.left - before.left) / dt + apart - hubs.left)
            right = hubs.right + gain * ((rolled.right - before.right) / dt - apart - hubs.right)
            hubs = Wheels(left, right)
            speed += _within(_agreed(hubs, speed, self.slip) - speed, self.grip * dt)
        pace = state.pace + _within(drive.speed - state.pace, self.acceleration * dt)
        way = state.way + speed * dt
        wanted = min(max(state.wanted + pace * dt, way - self.reach), way + self.reach)
        both = self.way * (way - wanted) + self.speed * (speed - pace) + self.lean * lean - self.lean_rate * out.rate.x
        turning = self.turn * (drive.turn - out.rate.z)
        left, right = _limited(0.5 * both, turning, self.torque_limit)
        left -= self.traction * _beyond(hubs.left - speed, self.slip)
        right -= self.traction * _beyond(hubs.right - speed, self.slip)
        left, right = _within(left, self.torque_limit), _within(right, self.torque_limit)
        return State(left, right, BALANCING, rolled, hubs, speed, way, wanted, pace, lean, blind)


@compiled
def _told(wheels: Wheels) -> bool:
    return wheels.left - wheels.left + wheels.right - wheels.right == 0.0


@compiled
def _rest(rolled: Wheels) -> State:
    return State(0.0, 0.0, OFF, rolled, Wheels(0.0, 0.0), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@compiled
def _rolled(control: BalanceControl, lean: float, wheels: Wheels) -> Wheels:
    """m, how far the wheels have rolled: they turn against a body that leans itself."""
    return Wheels(control.wheel_radius * (wheels.left + lean), control.wheel_radius * (wheels.right + lean))


@compiled
def _agreed(hubs: Wheels, speed: float, slip: float) -> float:
    """m/s of the axle: the mean of what the wheels tell, less and less of one that is further than *slip* from *speed*."""
    left = 1.0 / (slip * slip + (hubs.left - speed) ** 2)
    right = 1.0 / (slip * slip + (hubs.right - speed) ** 2)
    return (left * hubs.left + right * hubs.right) / (left + right)


@compiled
def _within(value: float, most: float) -> float:
    return min(max(value, -most), most)


@compiled
def _beyond(value: float, least: float) -> float:
    """What of *value* is more than *least*, either way."""
    return value - _within(value, least)


@compiled
def _limited(each: float, turning: float, most: float) -> tuple[float, float]:
    """Both wheels' torques within the limit: balancing comes before turning."""
    each = _within(each, most)
    turning = _within(turning, most - abs(each))
    return each - turning, each + turning


@entry
def begin(law: Any, row: Floats, flags: int, clock: Floats) -> Any:
    wheels, drive = Wheels(float(clock[1]), float(clock[2])), Drive(float(clock[3]), float(clock[4]))
    return Memory(law, start(law, output_of(row, 0.0, flags), wheels, drive), clock)


@entry
def advance(memory: Any, time: Floats, table: Floats, flags: NDArray[np.uint32], torques: Floats) -> None:
    """Step the law in *memory* over the rows of an attitude, with the wheels and the drive in its ``aside``."""
    law, state, clock = memory.method, memory.state, memory.aside
    wheels, drive = Wheels(float(clock[1]), float(clock[2])), Drive(float(clock[3]), float(clock[4]))
    for i in range(len(time)):
        now = float(time[i])
        state = step(law, state, output_of(table[i], now - float(clock[0]), int(flags[i])), wheels, drive)
        torques[i, 0], torques[i, 1] = state.left, state.right
        if now == now:
            clock[0] = now
    memory.state = state


class Balancer:
    """A balancing robot's controller running live: attitude and wheels in, torques of the wheels out.

    ``left, right = balancer.update(stream.update(packet), (left_angle, right_angle))``; :meth:`drive` says where to.
    """

    def __init__(self, control: BalanceControl) -> None:
        if not isinstance(control, BalanceControl):
            raise MethodError(f"expected a BalanceControl, found {type(control).__name__}")
        self.control: BalanceControl = prepared(control)
        self._memory: Any = None
        self._clock = np.zeros(5)

    def drive(self, speed: float, turn: float = 0.0) -> None:
        """Drive at *speed* (m/s, positive forward), turning at *turn* (rad/s, counter-clockwise)."""
        told = np.array([speed, turn], float)
        if not np.isfinite(told).all():
            raise MethodError(f"drive: expected a speed (m/s) and a turn (rad/s), found {speed!r}, {turn!r}")
        self._clock[3:5] = told

    def update(self, attitude: Attitude, wheels: ArrayLike) -> tuple[float, float]:
        """N m of the left and the right wheel, positive forward, after the last row of *attitude*.

        *wheels* (2,) are how far they have turned against the body by now (rad, positive forward).
        """
        turned = np.asarray(wheels, float)
        if not isinstance(attitude, Attitude) or turned.shape != (2,):
            raise MethodError(f"expected an Attitude and the angles of two wheels, found {attitude!r}, {wheels!r}")
        self._clock[1:3] = turned
        given = attitude if attitude.frame == "enu" else attitude.to("enu")
        n = len(given.time)
        if n == 0:
            return 0.0, 0.0
        table, time = np.ascontiguousarray(given.table), np.ascontiguousarray(given.time)
        if self._memory is None:
            self._clock[0] = time[0]
            self._memory = begin(self.control, table[0], int(given.flags[0]), self._clock)
        torques = np.zeros((n, 2))
        advance(self._memory, time, table, given.flags, torques)
        return float(torques[-1, 0]), float(torques[-1, 1])

    @property
    def state(self) -> State | None:
        """What it knows of the way and the speed; None before the first row."""
        return None if self._memory is None else state_of(self._memory)

    @property
    def doing(self) -> str:
        """``off`` or ``attitude``, at the last row."""
        state = self.state
        return DOING[OFF if state is None else state.doing]
