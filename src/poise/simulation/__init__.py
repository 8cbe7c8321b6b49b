"""Made recordings with an exact reference: a motion from formulas, seen by a sensor with stated errors."""

from poise.simulation.motion import Motion, at_rest, forearm, phone, robot, turned_about_up
from poise.simulation.sensor import PERFECT, Sensor, Triad, measure

__all__ = [
    "PERFECT",
    "Motion",
    "Sensor",
    "Triad",
    "at_rest",
    "forearm",
    "measure",
    "phone",
    "robot",
    "turned_about_up",
]
