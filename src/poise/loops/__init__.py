"""Closed loops in physics: an estimate, never the truth, decides what the motors do."""

from poise.loops.balancing import BalanceLoop, BalanceRun, Cut, Push, balancing
from poise.loops.pushing import Pushed, pushed
from poise.loops.slewing import SlewingRun, slewing

__all__ = [
    "BalanceLoop",
    "BalanceRun",
    "Cut",
    "Push",
    "Pushed",
    "SlewingRun",
    "balancing",
    "pushed",
    "slewing",
]
