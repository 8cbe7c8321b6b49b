"""One instant, as kernels see it, and the samples that a device sent together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.math.quaternions import Quat
from poise.math.vectors import Vec3

Numbers = float | Sequence[float] | Sequence[Sequence[float]] | NDArray[np.floating] | NDArray[np.integer]


class Packet(NamedTuple):
    """One sample (a number and vectors of 3) or n samples ((n,) and (n, 3)) in the order of arrival."""

    time: Numbers
    """s"""
    gyr: Numbers
    """rad/s"""
    acc: Numbers
    """m/s², specific force: +9.81 along up at rest"""
    mag: Numbers | None = None
    """µT; None or NaN where the magnetometer has no sample at this instant"""


class Sample(NamedTuple):
    """What an estimator is given for one gyroscope instant; a sensor without a sample here holds NaN."""

    dt: float
    """s since the sample before; 0 at the first"""
    gyr: Vec3
    """rad/s"""
    acc: Vec3
    """m/s²"""
    mag: Vec3
    """µT"""
    acc_age: float
    """s from the accelerometer's own instant to this one"""
    mag_age: float
    """s from the magnetometer's own instant to this one"""
    acc_dt: float
    """s that the accelerometer's sample stands for: since the one before; dt where it is as fast as the gyroscope"""
    mag_dt: float
    """s that the magnetometer's sample stands for"""
    turn_variance: float
    """rad² about each axis: how far the body may have turned otherwise than *gyr* says; 0 where all of dt was measured"""


class Output(NamedTuple):
    """What an estimator says after a sample."""

    dt: float
    """s"""
    attitude: Quat
    """body to Earth (ENU), w x y z"""
    rate: Vec3
    """rad/s, body frame, bias removed"""
    bias: Vec3
    """rad/s, body frame"""
    sigma: Vec3
    """rad, standard deviation about Earth x, y, z; NaN where a method has none"""
    bias_sigma: Vec3
    """rad/s; NaN where a method has none"""
    flags: int
    """bits of :class:`poise.data.flags.Flag`"""
