"""Random pushes: whether every fall is detected before the impact, and nothing that recovers."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin
from typing import Any

import numpy as np

from poise.loops.balancing import BalanceLoop, BalanceRun

_AFTER = 4.0  # s after the push, after which a robot that stands has recovered


@dataclass(frozen=True, eq=False)
class Pushed:
    """A push and what came of it, without the monitor's hand in it and, if it fell, with it."""

    force: float
    """N"""
    direction: float
    """rad, from forward to the left"""
    watched: BalanceRun
    """the monitor only watches: would it have recovered?"""
    cut: BalanceRun | None
    """the same again with the relay, where it fell"""

    @property
    def fell(self) -> bool:
        return self.watched.fell

    @property
    def false_alarm(self) -> bool:
        """It recovered, and the monitor would have cut its motors."""
        return not self.fell and self.watched.triggered

    @property
    def lead(self) -> float:
        """s from the relay's edge to the impact."""
        return float("nan") if self.cut is None else self.cut.lead


def pushed(method: str, seed: int, *, strongest: float = 25.0, **options: Any) -> Pushed:
    """One push of 0.1 s whose force, direction and instant, and the robot's load and motors, the *seed* draws."""
    random = np.random.default_rng([seed, 11])
    force, direction, at = random.uniform(2.0, strongest), random.uniform(-pi, pi), random.uniform(4.0, 6.0)
    speed = float(random.choice([-0.3, 0.0, 0.3]))
    world = {"payload": random.uniform(0.0, 0.2), "motor_lag": random.uniform(0.01, 0.03)}
    runs = []
    for cuts in (False, True):
        with BalanceLoop(method, seed, cuts=cuts, options=world, **options) as loop:
            loop.run(at, lambda _: (speed, 0.0))
            loop.push((-force * sin(direction), force * cos(direction), 0.0))
            loop.run(at + _AFTER, lambda _: (speed, 0.0), after_impact=0.1)
            runs.append(loop.result())
        if not runs[0].fell:
            break
    return Pushed(force, direction, runs[0], runs[1] if len(runs) > 1 else None)
