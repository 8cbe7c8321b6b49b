"""A two-wheeled self-balancing robot on a floor."""

from __future__ import annotations

from math import atan2, cos, exp, hypot, pi, radians, sin, tau
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.simulation.worlds.world import Driver, World

Floats = NDArray[np.float64]

_COUNTS = 1320.0  # of an encoder, a turn of the wheel
_GROUND, _BUMPS = 4.0, 400  # m, half the side of the square with bumps in it
_RUMBLE, _RUMBLE_DAMPING = 45.0, 0.3  # Hz: where the frame resonates


class BalanceOptions(NamedTuple):
    """How the robot and its floor are."""

    hold: Annotated[float, "s", "how long a stand holds it before it is let go; a bias is learnt in 1.5 s"] = 2.0
    lean: Annotated[float, "deg", "how far forward it leans on the stand", (-30.0, 30.0)] = 0.0
    heading: Annotated[float, "deg", "where it looks, counter-clockwise from north", (-360.0, 360.0)] = 0.0
    bumps: Annotated[float, "m", "height of the ridges on the floor, of which 400 lie within 4 m", (0.0, 0.02)] = 0.0
    vibration: Annotated[
        float, "m/s²", "RMS of the shaking by the drive while it is free, about 45 Hz", (0.0, 20.0)
    ] = 0.0
    motor_lag: Annotated[float, "s", "time constant of a motor's torque", (0.0, 0.5)] = 0.02
    stall_torque: Annotated[float, "N m", "most torque of a motor, which falls to 0 at no_load_speed", (0.01, 10.0)] = (
        0.45
    )
    no_load_speed: Annotated[float, "rad/s", "of a wheel", (1.0, 500.0)] = 40.0
    payload: Annotated[float, "kg", "a load on top", (0.0, 5.0)] = 0.0


class Balance(World):
    """Two wheels of 50 mm radius, 0.2 m apart, under a body 0.26 m tall that weighs 1.6 kg, its centre of mass 0.135 m
    above the axle. The sensor sits 95 mm above the axle, off its middle.

    A command is the torque of each wheel, N m, positive forward; a motor follows with a lag, up to what it can at its
    speed. It stands on a stand for ``hold`` s and is then let go.

    ``truth.state``: ``position`` and ``velocity`` (3,) m and m/s of the axle, ENU; ``lean`` rad forward; ``speed`` m/s
    along its heading; ``wheels`` rad/s; ``torques`` N m; ``released``.
    """

    name = "balance"
    commands = ("left wheel, N m", "right wheel, N m")
    pushed = "chassis"
    Options = BalanceOptions

    def _model(self, text: str) -> str:
        half, turn = -radians(self.options.lean) / 2, radians(self.options.heading) / 2
        quat = (cos(turn) * cos(half), cos(turn) * sin(half), sin(turn) * sin(half), sin(turn) * cos(half))
        text = text.replace("{quat}", " ".join(f"{number:.15g}" for number in quat))
        if self.options.payload > 0.0:
            text = text.replace("<!-- payload -->", _PAYLOAD.format(self.options.payload))
        return text.replace("<!-- bumps -->", self._ridges() if self.options.bumps > 0.0 else "")

    def _prepare(self) -> None:
        self._wanted = self._torques = (0.0, 0.0)
        self._motors = self.physics.data.ctrl
        self._left, self._right = self.physics.joint("left"), self.physics.joint("right")
        self._found = self.physics.sensor("impact")
        self._follow = 1.0 if self.options.motor_lag == 0.0 else 1.0 - exp(-self._dt / self.options.motor_lag)
        self._held = True
        self._rumble = _Rumble(self.rng, self._dt) if self.options.vibration > 0.0 else None
        self._rumbling = self.options.vibration * 1.8  # kg

    def _take(self, command: Floats) -> None:
        self._wanted = (float(command[0]), float(command[1]))

    def _act(self) -> None:
        if self._held and self._count and self.time >= self.options.hold - 1e-9:
            self.physics.hold("stand", False)
            self._held = False
        torques = []
        for wanted, now, (_, speed) in zip(self._wanted, self._torques, (self._left, self._right), strict=True):
            now += self._follow * ((wanted if self.powered else 0.0) - now)
            share = speed[0] / self.options.no_load_speed
            most, least = self.options.stall_torque * (1.0 - share), -self.options.stall_torque * (1.0 + share)
            torques.append(min(max(now, min(least, 0.0)), max(most, 0.0)))
        self._torques = (torques[0], torques[1])
        self._motors[:] = torques
        if self._rumble is not None and self.powered and not self._held:  # on the stand the drive is idle
            self.physics.push(self._body, self._rumbling * self._rumble.next(), _AXLE)

    def _touched(self) -> bool:
        return bool(self._found[0] > 0.0)

    def _state(self) -> dict[str, Any]:
        physics = self.physics
        w, x, y, z = (float(number) for number in self._views["imu"][3])
        ahead, aside = w * w - x * x + y * y - z * z, 2.0 * (x * y - w * z)  # north and east of where it looks
        velocity = physics.sensor("velocity").copy()
        return {
            "position": physics.sensor("position").copy(),
            "velocity": velocity,
            "lean": atan2(-2.0 * (y * z + w * x), w * w - x * x - y * y + z * z),
            "speed": float(velocity[0] * aside + velocity[1] * ahead) / max(hypot(ahead, aside), 1e-9),
            "wheels": np.array([self._left[1][0], self._right[1][0]]),
            "torques": np.array(self._torques),
            "released": self.released,
        }

    @property
    def released(self) -> bool:
        """Has the stand let it go?"""
        return not self._held

    @property
    def encoders(self) -> Floats:
        """(2,) rad, how far the wheels have turned forward against the body, in steps of 1/1320 turn."""
        step = tau / _COUNTS
        return np.round(np.array([self._left[0][0], self._right[0][0]]) / step) * step

    def driver(self) -> Driver:
        """Balances and drives about at up to 0.3 m/s, by the truth; for loops with an estimator see `poise balance`."""
        return _Driver(self.seed)

    def _ridges(self) -> str:
        """Cylinders sunk into the floor, so that their backs are *bumps* m high."""
        height = self.options.bumps
        radius = 6.0 * height
        lines: list[str] = []
        while len(lines) < _BUMPS:
            x, y, turn = self.rng.uniform([-_GROUND, -_GROUND, 0.0], [_GROUND, _GROUND, pi])
            if np.hypot(x, y) < 0.3:
                continue
            along = 0.15 * np.array([cos(turn), sin(turn)])
            ends = (x - along[0], y - along[1], height - radius, x + along[0], y + along[1], height - radius)
            lines.append(_RIDGE.format(" ".join(f"{number:.5f}" for number in ends), radius))
        return "\n".join(lines)


_PAYLOAD = (
    '<geom name="payload" type="box" pos="0 0 0.267" size="0.05 0.03 0.01" mass="{:.15g}" rgba="0.45 0.6 0.35 1"/>'
)
_RIDGE = '<geom type="capsule" fromto="{}" size="{:.5f}" rgba="0.55 0.5 0.45 1" friction="0.9 0.005 0.0002"/>'
_AXLE = np.zeros(3)


class _Rumble:
    """(3,) white noise through a resonance, RMS 1 per axis."""

    def __init__(self, rng: np.random.Generator, step: float) -> None:
        self._rng = rng
        omega, damping = tau * _RUMBLE, _RUMBLE_DAMPING
        self._a1 = 2.0 * exp(-damping * omega * step) * cos(omega * step * (1.0 - damping**2) ** 0.5)
        self._a2 = -exp(-2.0 * damping * omega * step)
        variance = (1.0 - self._a2) / ((1.0 + self._a2) * ((1.0 - self._a2) ** 2 - self._a1**2))
        self._gain = variance**-0.5
        self._last, self._before = np.zeros(3), np.zeros(3)
        self._drawn, self._at = np.zeros((0, 3)), 0

    def next(self) -> Floats:
        if self._at == len(self._drawn):
            self._drawn, self._at = self._gain * self._rng.standard_normal((4096, 3)), 0
        now = self._a1 * self._last + self._a2 * self._before + self._drawn[self._at]
        self._at += 1
        self._before, self._last = self._last, now
        return np.asarray(now)


class _Driver:
    """State feedback of lean, its rate, speed and way, with gains found by hand for this robot alone."""

    def __init__(self, seed: int) -> None:
        self._rng = np.random.default_rng([seed, 1])
        self._until, self._speed, self._turn, self._way, self._ramped = 3.0, 0.0, 0.0, 0.0, 0.0

    def __call__(self, world: World) -> Floats:
        truth = world.truth
        state, step = truth.state, 1.0 / world.rate
        if not state["released"] or abs(state["lean"]) > 1.0:
            self._until = max(self._until, world.time + 2.0)
            return np.zeros(2)
        if world.time >= self._until:
            self._speed = float(self._rng.choice([-0.3, 0.0, 0.3]) * self._rng.uniform(0.5, 1.0))
            self._turn = float(self._rng.choice([-1.0, 0.0, 1.0]) * self._rng.uniform(0.3, 1.2))
            self._until = world.time + float(self._rng.uniform(2.0, 6.0))
        self._ramped += min(max(self._speed - self._ramped, -0.3 * step), 0.3 * step)
        self._way += step * (state["speed"] - self._ramped)
        self._way = min(max(self._way, -0.5), 0.5)
        lean_rate = -float(truth.rate[0])
        drive = 5.2 * state["lean"] + 0.55 * lean_rate + 1.3 * (state["speed"] - self._ramped) + 0.6 * self._way
        turn = 0.2 * (self._turn - float(truth.rate[2]))
        return np.array([0.5 * drive - turn, 0.5 * drive + turn])
