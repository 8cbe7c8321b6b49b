"""A handle of a VR set, or a phone, in a hand."""

from __future__ import annotations

from math import tau
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.math import arrays
from poise.simulation.worlds.arm import smooth
from poise.simulation.worlds.world import Driver, World

Floats = NDArray[np.float64]

_TABLE = np.array([0.0, 0.3, 0.93])
_LEVEL = np.array([1.0, 0.0, 0.0, 0.0])


class HandleOptions(NamedTuple):
    """How the hand moves when its own driver drives it."""

    pace: Annotated[
        float, "1", "how fast it turns; 1: 0.25 to 0.8 s a turn, as in a game; a phone about 0.4", (0.1, 3.0)
    ] = 1.0
    rest: Annotated[float, "s", "on the table at the start"] = 3.0
    tremor: Annotated[float, "deg", "RMS of the hand's tremor, 8 to 12 Hz", (0.0, 5.0)] = 0.1


class Handle(World):
    """165 g in a grip that gives a little. y points along the handle, away from the hand.

    A command is where the hand shall be: position (3) m and quaternion w x y z (4), body to ENU.

    ``truth.state``: ``position`` (3,) m, ENU.
    """

    name = "handle"
    commands = ("x, m", "y, m", "z, m", "qw", "qx", "qy", "qz")
    pushed = "handle"
    Options = HandleOptions

    def _prepare(self) -> None:
        self._pose = self._last = np.concatenate([_TABLE, _LEVEL])
        self._part = 1.0

    def _take(self, command: Floats) -> None:
        quat = arrays.normalize(command[3:])
        if not np.isfinite(quat).all():
            quat = _LEVEL
        if not self.powered:
            return
        self._last = self._pose
        sign = -1.0 if float(quat @ self._last[3:]) < 0.0 else 1.0
        self._pose, self._part = np.concatenate([command[:3], sign * quat]), 0.0

    def _act(self) -> None:
        self._part = min(self._part + 1.0 / self._substeps, 1.0)
        now = self._last + self._part * (self._pose - self._last)
        self.physics.data.mocap_pos[0] = now[:3]
        self.physics.data.mocap_quat[0] = now[3:] / np.linalg.norm(now[3:])

    def _state(self) -> dict[str, Any]:
        return {"position": self.physics.sensor("position").copy()}

    def driver(self) -> Driver:
        """Lies on the table, is taken up and points at things drawn by the seed: open loop."""
        return _Pointing(self.seed, self.options)


class _Pointing:
    """Turns of least jerk from aim to aim, with tremor."""

    def __init__(self, seed: int, options: Any) -> None:
        self._rng, self._options = np.random.default_rng([seed, 1]), options
        self._from = self._to = np.concatenate([_TABLE, np.zeros(3)])
        self._start, self._lasts, self._wait = 0.0, options.rest, 0.0
        self._waves = tau * self._rng.uniform(8.0, 12.0, (2, 3)), self._rng.uniform(0.0, tau, (2, 3))

    def __call__(self, world: World) -> Floats:
        time = world.time
        if time >= self._start + self._lasts + self._wait:
            first = self._start == 0.0 and (self._from is self._to)
            self._from, self._to = self._to, self._aim()
            self._start = time
            self._lasts, self._wait = self._rng.uniform([0.25, 0.05], [0.8, 1.2]) / self._options.pace
            self._lasts = max(self._lasts, 1.0) if first else self._lasts
        part = smooth((time - self._start) / self._lasts)
        pose = self._from + part * (self._to - self._from)
        if self._from is not self._to:
            omega, phase = self._waves
            pose[3:] += np.radians(self._options.tremor) * np.sin(omega * time + phase).sum(axis=0)
        return np.concatenate([pose[:3], _quat(pose[3:])])

    def _aim(self) -> Floats:
        """Where the hand is, m, and heading, pitch and roll, rad."""
        angles = np.radians(self._rng.uniform([-80.0, -50.0, -60.0], [80.0, 65.0, 60.0]))
        reach = 0.25 + 0.1 * self._rng.standard_normal(3) * [0.5, 1.0, 0.5]
        place = [-reach[0] * np.sin(angles[0]), reach[0] * np.cos(angles[0]), 1.2 + 0.3 * np.sin(angles[1])]
        return np.concatenate([place, angles])


def _quat(angles: Floats) -> Floats:
    """q = Rz(heading) Rx(pitch) Ry(roll)."""
    (ch, cp, cr), (sh, sp, sr) = np.cos(angles / 2), np.sin(angles / 2)
    turn = np.array([ch, 0.0, 0.0, sh])
    return np.asarray(
        arrays.multiply(arrays.multiply(turn, np.array([cp, sp, 0.0, 0.0])), np.array([cr, 0.0, sr, 0.0]))
    )
