"""A body on reaction wheels that is sent to random attitudes, 120° away each: control by an estimate, judged by the truth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import degrees, inf, radians

import numpy as np
from numpy.typing import NDArray

from poise.control import AttitudeControl, Controller, Slew
from poise.loops.commissioning import REST, commissioned
from poise.loops.eyes import Eyes
from poise.math import arrays
from poise.simulation.worlds import AttitudeBody

Floats = NDArray[np.float64]

SENSOR = "MPU-6050+QMC5883L"
SETTLED = radians(2.0)
_BEGIN, _EACH, _LAST = 3.0, 9.0, 2.0  # s: the first goal, from goal to goal, over which the final error is taken
ANGLE = radians(120.0)

# What a user would state of this body: moments of inertia read from a drawing, 10 % off and without products of inertia;
# less torque than the wheels have. Wheels keep the whole's momentum where it was, so that no gyroscopic torque is left.
CONTROL = AttitudeControl.design((0.02, 0.025, 0.035), 0.8, 1.0, torque_limit=(0.05,) * 3, gyroscopic=False)
SLEW = Slew(rate=1.0, acceleration=1.0)


@dataclass(frozen=True)
class Turn:
    """One slew to a new attitude."""

    begun: float
    """s"""
    settling: float
    """s from the new goal until the body stays within 2° of it; infinite where it does not"""
    final: float
    """rad, largest error over the last 2 s"""
    estimate: float
    """rad, RMS error of the estimate meanwhile"""


@dataclass(frozen=True, eq=False)
class SlewingRun:
    """A body sent from goal to goal."""

    method: str
    seed: int
    time: Floats
    """(n,) s"""
    error: Floats
    """(n,) rad, from the goal to the true attitude"""
    estimate: Floats
    """(n,) rad, from the estimate to the true attitude"""
    torque: Floats
    """(n, 3) N m, as commanded"""
    turns: tuple[Turn, ...]

    def told(self) -> str:
        """One line a slew."""
        lines = [
            f"{turn.begun:6.2f} s: settled after {turn.settling:.2f} s, {degrees(turn.final):.2f}° off at the end, "
            f"estimate {degrees(turn.estimate):.2f}° RMS"
            for turn in self.turns
        ]
        return "\n".join(lines)


def slewing(
    method: str = "self-calibrating",
    *,
    seed: int = 0,
    turns: int = 3,
    sensor: str = SENSOR,
    control: AttitudeControl = CONTROL,
    slew: Slew | None = SLEW,
    calibrated: bool = True,
    look: Callable[[float, AttitudeBody], None] | None = None,
) -> SlewingRun:
    """Send a body to *turns* attitudes, each 120° about a random axis from the one before, by what *method* sees.

    Unless *calibrated* is False, the device is commissioned before; the method starts anew after that, and time with it.
    *look* is called after every sample with the time (s) and the world: for photographs.
    """
    world = AttitudeBody(seed=seed, sensor=sensor, rate=200.0, hold=REST)
    calibration = commissioned(world, control) if calibrated else None
    random = np.random.default_rng([seed, 7])
    eyes, controller = Eyes(method, world, calibration), Controller(control, slew)
    goal = said = np.full(4, np.nan)
    torque, rows, asked, began = np.zeros(3), [], _BEGIN, world.time
    end = began + _BEGIN + turns * _EACH
    while world.time < end - 1e-9:
        if world.time >= began + asked - 1e-9:
            axis = random.standard_normal(3)
            half = 0.5 * ANGLE
            turn = np.concatenate([[np.cos(half)], np.sin(half) * axis / np.linalg.norm(axis)])
            goal = arrays.multiply(said if np.isnan(goal[0]) else goal, turn)
            controller.hold(goal)
            asked += _EACH
        for seen in eyes.see(world.step(torque)):
            answer = controller.update(seen.attitude)[0]
            torque = answer if world.released else np.zeros(3)
            said = seen.attitude.quat[0]
        true = world.truth.quat
        if look is not None:
            look(world.time - began, world)
        rows.append([world.time - began, _angle(goal, true), _angle(said, true), *torque])
    table = np.array(rows)
    time, error, estimate = table[:, 0], table[:, 1], table[:, 2]
    return SlewingRun(method, seed, time, error, estimate, table[:, 3:], tuple(_turns(time, error, estimate, turns)))


def _turns(time: Floats, error: Floats, estimate: Floats, count: int) -> list[Turn]:
    found = []
    for begun in _BEGIN + _EACH * np.arange(count):
        rows = (time > begun + 1e-9) & (time < begun + _EACH + 1e-9)
        outside = np.flatnonzero(error[rows] > SETTLED)
        last = time[rows][outside[-1]] - begun if len(outside) else 0.0
        final = float(error[rows & (time > begun + _EACH - _LAST)].max(initial=0.0))
        rms = float(np.sqrt(np.mean(estimate[rows] ** 2)))
        found.append(Turn(float(begun), float(last) if last < _EACH - _LAST else inf, final, rms))
    return found


def _angle(a: Floats, b: Floats) -> float:
    return float(arrays.angle(arrays.multiply(arrays.conjugate(a), b)))
