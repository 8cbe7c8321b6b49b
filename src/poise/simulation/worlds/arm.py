"""An arm that reaches: a band with a sensor on the forearm, a second sensor on the upper arm."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.simulation.worlds.world import Driver, World

Floats = NDArray[np.float64]

_JOINTS = ("azimuth", "elevation", "twist", "flexion", "pronation")
_START = np.array([0.2, -1.35, 0.0, 1.35, 0.0])  # rad: hanging down, the forearm level
_LOWEST = np.array([-0.7, -1.35, -0.8, 0.15, -1.1])
_HIGHEST = np.array([1.2, 0.7, 0.8, 2.0, 1.1])


class ArmOptions(NamedTuple):
    """How the arm moves when its own driver drives it."""

    pace: Annotated[float, "1", "how fast it reaches; 1: 0.6 to 1.4 s a reach", (0.1, 3.0)] = 1.0
    rest: Annotated[float, "s", "of rest at the start"] = 3.0


class Arm(World):
    """A shoulder of three joints and an elbow of two, moved by muscles like springs with damping. The band sits 0.1 m from
    the elbow and rolls a little on the tissue under it.

    A command is where the joints shall be, rad: azimuth (left), elevation (up), twist, flexion of the elbow, pronation.
    Sensors: ``forearm``, the first, and ``upper_arm``; y points along the limb to the hand.

    ``truth.state``: ``joints`` (5,) rad; ``tissue`` rad, how far the band has rolled.
    """

    name = "arm"
    sensors = ("forearm", "upper_arm")
    commands = tuple(f"{joint}, rad" for joint in _JOINTS)
    pushed = "forearm"
    Options = ArmOptions

    def _prepare(self) -> None:
        self._joints = [self.physics.joint(joint)[0] for joint in _JOINTS]
        for joint, angle in zip(self._joints, _START, strict=True):
            joint[0] = angle
        self.physics.data.ctrl[:] = _START
        self.physics.refresh()
        self._tissue = self.physics.joint("tissue")[0]

    def _take(self, command: Floats) -> None:
        self._wanted = command
        if self.powered:
            self.physics.data.ctrl[:] = command

    def _act(self) -> None:
        """Muscles act by themselves."""

    def _state(self) -> dict[str, Any]:
        return {"joints": np.array([joint[0] for joint in self._joints]), "tissue": float(self._tissue[0])}

    def driver(self) -> Driver:
        """Reaches for points drawn by the seed, along smooth ways, and waits at each for up to 1.5 s: open loop."""
        return _Reaching(self.seed, self.options.pace, self.options.rest)


class _Reaching:
    """Ways of least jerk from pose to pose."""

    def __init__(self, seed: int, pace: float, rest: float) -> None:
        self._rng, self._pace = np.random.default_rng([seed, 1]), pace
        self._from = self._to = _START
        self._start, self._lasts, self._wait = 0.0, rest, 0.0

    def __call__(self, world: World) -> Floats:
        part = (world.time - self._start) / self._lasts
        if part * self._lasts >= self._lasts + self._wait:
            self._from, self._to = self._to, self._rng.uniform(_LOWEST, _HIGHEST)
            self._start = world.time
            self._lasts, self._wait = self._rng.uniform([0.6, 0.1], [1.4, 1.5]) / self._pace
            part = 0.0
        return np.asarray(self._from + smooth(part) * (self._to - self._from))


def smooth(part: float) -> float:
    """From 0 to 1 with the least jerk."""
    v = min(max(part, 0.0), 1.0)
    return v**3 * (10.0 - 15.0 * v + 6.0 * v**2)
