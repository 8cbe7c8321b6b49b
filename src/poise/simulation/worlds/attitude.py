"""A body on a ball joint in its centre of mass, turned by three reaction wheels."""

from __future__ import annotations

from math import exp, radians
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.math import arrays
from poise.simulation.worlds.world import Driver, World

Floats = NDArray[np.float64]

_AXES = ("x", "y", "z")


class AttitudeOptions(NamedTuple):
    """How the body and its wheels are."""

    hold: Annotated[float, "s", "how long it is held before it is let go"] = 1.0
    tilt: Annotated[float, "deg", "of its first attitude, about an axis drawn by the seed", (0.0, 180.0)] = 0.0
    imbalance: Annotated[
        float, "m", "from the joint to the centre of mass, in a direction drawn by the seed", (0.0, 0.01)
    ] = 1e-5
    torque: Annotated[float, "N m", "most torque of a wheel", (1e-4, 1.0)] = 0.06
    wheel_speed: Annotated[float, "rad/s", "where a wheel has no torque left in that direction", (10.0, 5000.0)] = 500.0
    motor_lag: Annotated[float, "s", "time constant of a wheel's torque", (0.0, 0.5)] = 0.03


class AttitudeBody(World):
    """2.4 kg with moments of inertia of about 0.022, 0.027 and 0.033 kg m² about x, y and z (not quite the principal
    axes); wheels of 2e-4 kg m². The sensor sits 84 mm from the joint. Gravity acts: the accelerometer says where up is.

    A command is the torque on the body about its axes, N m; the wheels follow with a lag and take up the momentum until
    they reach their speed.

    ``truth.state``: ``wheels`` (3,) rad/s; ``torques`` (3,) N m on the body; ``released``.
    """

    name = "attitude"
    commands = ("torque about x, N m", "about y, N m", "about z, N m")
    pushed = "body"
    Options = AttitudeOptions

    def _model(self, text: str) -> str:
        axis, off = (v / np.linalg.norm(v) for v in self.rng.standard_normal((2, 3)))
        half = radians(self.options.tilt) / 2
        quat = np.concatenate([[np.cos(half)], np.sin(half) * axis])
        text = text.replace("{quat}", " ".join(f"{number:.15g}" for number in quat))
        return text.replace("{imbalance}", " ".join(f"{number:.15g}" for number in self.options.imbalance * off))

    def _prepare(self) -> None:
        self._wanted, self._torques = np.zeros(3), np.zeros(3)
        self._speeds = [self.physics.joint(f"wheel_{axis}")[1] for axis in _AXES]
        self._follow = 1.0 if self.options.motor_lag == 0.0 else 1.0 - exp(-self._dt / self.options.motor_lag)
        self._held = True

    def _take(self, command: Floats) -> None:
        self._wanted = command

    def _act(self) -> None:
        if self._held and self._count and self.time >= self.options.hold - 1e-9:
            self.physics.hold("stand", False)
            self._held = False
        most = self.options.torque
        wanted = np.clip(self._wanted, -most, most) if self.powered else np.zeros(3)
        self._torques = self._torques + self._follow * (wanted - self._torques)
        share = np.array([speed[0] for speed in self._speeds]) / self.options.wheel_speed
        # a wheel that spins fast can still be braked; its torque on the body is the opposite of that on the wheel
        self._torques = np.clip(
            self._torques, -most * np.clip(1.0 - share, 0.0, 1.0), most * np.clip(1.0 + share, 0.0, 1.0)
        )
        self.physics.data.ctrl[:] = -self._torques

    def _state(self) -> dict[str, Any]:
        wheels = np.array([speed[0] for speed in self._speeds])
        return {"wheels": wheels, "torques": self._torques.copy(), "released": self.released}

    @property
    def released(self) -> bool:
        """Is it free to turn?"""
        return not self._held

    def driver(self) -> Driver:
        """Slews to a new attitude every 6 to 10 s, by the truth."""
        return _Driver(self.seed)


class _Driver:
    """Feedback of the attitude's error and the rate, with gains found by hand for this body alone."""

    def __init__(self, seed: int) -> None:
        self._rng = np.random.default_rng([seed, 1])
        self._until, self._target = 3.0, np.array([1.0, 0.0, 0.0, 0.0])

    def __call__(self, world: World) -> Floats:
        truth = world.truth
        if world.time >= self._until:
            self._target = arrays.normalize(self._rng.standard_normal(4))
            self._until = world.time + float(self._rng.uniform(6.0, 10.0))
        error = arrays.rotation_vector(arrays.multiply(arrays.conjugate(truth.quat), self._target))
        return np.asarray(0.05 * error - 0.065 * truth.rate)
