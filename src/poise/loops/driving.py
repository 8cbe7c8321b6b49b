"""Driving about for long, over bumps and with vibration: the monitor must stay silent."""

from __future__ import annotations

from math import atan2, hypot, pi
from typing import Any

import numpy as np

from poise.loops.balancing import BalanceLoop, BalanceRun

BUMPS, VIBRATION = 0.002, 1.0  # m high, m/s² RMS
_AREA = 3.0  # m: the operator turns it back towards the middle beyond


class Operator:
    """Sends a robot about at 0.15 to 0.3 m/s, forward and back, with turns, and keeps it near the middle of its floor."""

    def __init__(self, seed: int) -> None:
        self._random = np.random.default_rng([seed, 13])
        self._until, self._speed, self._turn = 3.0, 0.0, 0.0

    def __call__(self, loop: BalanceLoop) -> tuple[float, float]:
        now, truth = loop.world.time, loop.world.truth
        if now < self._until:
            return self._speed, self._turn
        x, y, _ = truth.state["position"]
        self._until = now + float(self._random.uniform(2.0, 6.0))
        self._speed = float(self._random.choice([-1.0, 1.0]) * self._random.uniform(0.15, 0.3))
        self._turn = float(self._random.uniform(-0.8, 0.8))
        if self._random.random() < 0.15:
            self._speed = 0.0
        if hypot(x, y) > _AREA:  # look at where it stands, and drive home
            w, a, b, z = truth.quat
            ahead = atan2(w * w - a * a + b * b - z * z, 2.0 * (a * b - w * z))
            off = (atan2(-y, -x) - ahead + pi) % (2.0 * pi) - pi
            self._speed = 0.3 if abs(off) < pi / 2 else -0.3
            off = off if abs(off) < pi / 2 else (off % (2.0 * pi)) - pi
            self._until, self._turn = now + 4.0, float(np.clip(off / 2.0, -0.8, 0.8))
        return self._speed, self._turn


def driven(
    method: str, seed: int, duration: float, *, bumps: float = BUMPS, vibration: float = VIBRATION, **options: Any
) -> BalanceRun:
    """*duration* s of driving about over ridges of *bumps* m, shaken by *vibration* m/s² RMS; the relay is live."""
    with BalanceLoop(method, seed, options={"bumps": bumps, "vibration": vibration}, **options) as loop:
        loop.run(duration, Operator(seed))
        return loop.result()
