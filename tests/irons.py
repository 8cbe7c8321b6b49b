"""Magnetometers with a hard iron, made and real, for the tests of what the flagship finds and says of it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

import poise
from helpers import angle_between
from poise.simulation import PERFECT, Triad, forearm, measure

Floats = NDArray[np.float64]

FLAGSHIP = poise.SelfCalibrating()
NEVER = FLAGSHIP._replace(least_iron=1e6)  # the hard iron is left to the filter
WHITE = replace(PERFECT, gyr=Triad(noise=1e-4), acc=Triad(noise=0.002), mag=Triad(noise=0.05))
IRON = (24.0, -20.0, 25.0)  # µT: 40, in a field of 45


@cache
def calibrated(seed: int = 4) -> poise.Recording:
    return measure(forearm(120.0, 100.0, seed), WHITE, seed=1)


def with_iron(
    recording: poise.Recording, iron: tuple[float, float, float] = IRON, since: float = 0.0
) -> poise.Recording:
    """A hard iron (µT) beside the magnetometer, from a share of the recording on."""
    assert recording.mag is not None
    there = recording.time >= recording.time[0] + since * recording.duration
    return replace(recording, mag=recording.mag + np.outer(there, iron))


def degrees(attitude: poise.Attitude, recording: poise.Recording, part: slice = slice(None)) -> float:
    """Root mean square over some of the rows."""
    assert recording.truth is not None
    off = angle_between(attitude.quat[part], recording.truth.quat[part])
    return float(np.degrees(np.sqrt(np.mean(off**2))))


def second_half(recording: poise.Recording) -> slice:
    return slice(len(recording) // 2, None)
