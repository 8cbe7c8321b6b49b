"""Attitude control: torques from what an estimator says, and gains from what is known of the body."""

from poise.control.attitude import AttitudeControl
from poise.control.controller import Controller
from poise.control.design import lqr
from poise.control.target import Slew, Target

__all__ = ["AttitudeControl", "Controller", "Slew", "Target", "lqr"]
