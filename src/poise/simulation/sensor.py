"""What an imperfect sensor says about a motion: a Recording with its exact reference."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, radians

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude, HeadingReference
from poise.data.recording import STANDARD_GRAVITY, Recording
from poise.errors import RecordingError
from poise.math import arrays
from poise.simulation.motion import Motion

Floats = NDArray[np.float64]
Three = tuple[float, float, float]

_MOVING_RATE, _MOVING_ACCELERATION = 0.005, 0.02  # rad/s, m/s²: what is slower counts as rest


@dataclass(frozen=True)
class Triad:
    """The errors of one three-axis sensor, in its own unit: rad/s, m/s² or µT. Without arguments it has none.

    ``reading = (I + scale + misalignment) · true + bias + walk + noise``, clipped to ± *limit*, then rounded.
    """

    noise: float = 0.0
    """unit/√Hz, white noise density; a sample's standard deviation is noise · √rate"""
    bias: float | Three = 0.0
    """unit: three numbers are the bias itself; one number is the standard deviation it is drawn with"""
    walk: float = 0.0
    """unit/√s, random walk of the bias"""
    scale: float = 0.0
    """standard deviation of each axis's scale error, 0.01 is 1 %"""
    misalignment: float = 0.0
    """standard deviation of each cross-axis term, 0.01 is 1 % or 0.6°"""
    limit: float = inf
    """unit, end of the range"""
    resolution: float = 0.0
    """unit, one step of the converter; 0 for none"""


@dataclass(frozen=True)
class Sensor:
    """An inertial sensor with its errors; by default an inexpensive consumer MEMS part with a magnetometer.

    The defaults are the class of an ICM-20948 (16 bit, ±2000 °/s, ±16 g, 0.015 °/s/√Hz, 230 µg/√Hz, magnetometer 0.15
    µT a step): noise and ranges as such data sheets state them; offsets, scale and misalignment, of which they state
    limits, are drawn with a tenth to a half of these.
    """

    gyr: Triad = Triad(
        noise=radians(0.015),
        bias=radians(0.5),
        walk=radians(0.002),
        scale=0.005,
        misalignment=0.005,
        limit=radians(2000.0),
        resolution=radians(4000.0) / 2**16,
    )
    acc: Triad = Triad(
        noise=230e-6 * STANDARD_GRAVITY,
        bias=0.01 * STANDARD_GRAVITY,
        walk=2e-4,
        scale=0.003,
        misalignment=0.005,
        limit=16 * STANDARD_GRAVITY,
        resolution=32 * STANDARD_GRAVITY / 2**16,
    )
    mag: Triad | None = Triad(noise=0.05, bias=1.0, scale=0.01, misalignment=0.01, limit=4912.0, resolution=0.15)
    """its bias is the hard iron, its scale and misalignment the soft iron; None where there is no magnetometer"""
    mag_rate: float | None = None
    """samples per second of the magnetometer; None for that of the gyroscope"""
    mag_delay: float = 0.005
    """s by which the magnetometer's stamps are late"""
    jitter: float = 50e-6
    """s, standard deviation of the time stamps"""
    dropout: float = 0.0
    """the share of samples that never arrive"""
    latency: float = 0.0
    """s from a sample's instant to its arrival; matters live only (:class:`~poise.simulation.device.Device`)"""
    latency_jitter: float = 0.0
    """s, what a sample comes later still: the size of a normal deviate; samples arrive in order"""


TYPICAL = Sensor()
PERFECT = Sensor(gyr=Triad(), acc=Triad(), mag=Triad(), mag_delay=0.0, jitter=0.0)


def measure(
    motion: Motion,
    sensor: Sensor = TYPICAL,
    *,
    field: Three = (0.0, 20.0, -40.0),
    gravity: float = STANDARD_GRAVITY,
    seed: int = 0,
    name: str = "",
) -> Recording:
    """What *sensor* records of *motion* in a magnetic *field* (µT, ENU); the same bits for the same *seed*.

    The gyroscope gives the mean rate over the interval that ends at the row (the first row: the rate at its instant),
    so that a perfect one, integrated, is the reference; accelerometer and magnetometer give the value at their instant.
    ``truth`` is the motion with its true rate and the gyroscope's true bias; ``moving`` are the rows in motion, None
    where nothing moves. A field with a part to the east is a declination: the reference's heading is then "true",
    otherwise "magnetic". Each sensor draws from a stream of its own: changing one leaves the others' noise as it was.
    """
    if len(motion) < 2:
        raise RecordingError(f"a motion of at least 2 rows can be measured, found {len(motion)}")
    for_gyr, for_acc, for_mag, for_time, for_loss = np.random.default_rng(seed).spawn(5)
    rate = (len(motion) - 1) / float(motion.time[-1] - motion.time[0])
    stamps = _stamps(motion.time, sensor.jitter, for_time)
    gyr, bias = Readings(sensor.gyr, rate, for_gyr).of(_mean_rates(motion))
    force = arrays.rotate(arrays.conjugate(motion.quat), motion.acceleration + np.array([0.0, 0.0, gravity]))
    acc, _ = Readings(sensor.acc, rate, for_acc).of(force)
    mag = _magnetometer(motion, stamps, sensor, np.array(field, float), rate, for_mag)
    moving = (np.linalg.norm(motion.rate, axis=1) > _MOVING_RATE) | (
        np.linalg.norm(motion.acceleration, axis=1) > _MOVING_ACCELERATION
    )
    recording = Recording.from_sensors(
        (stamps, gyr),
        (stamps, acc),
        mag,
        truth=_truth(motion, stamps, bias, "true" if field[0] else "magnetic"),
        moving=moving if moving.any() else None,
        gravity=gravity,
        name=name,
        source="simulation",
    )
    return recording if sensor.dropout == 0.0 else recording[for_loss.random(len(recording)) >= sensor.dropout]


def _mean_rates(motion: Motion) -> Floats:
    """(n, 3) rad/s: the turn since the row before over the time it took."""
    turn = arrays.multiply(arrays.conjugate(motion.quat[:-1]), motion.quat[1:])
    turn *= np.where(turn[:, :1] < 0, -1.0, 1.0)
    sine = np.linalg.norm(turn[:, 1:], axis=1)
    per_sine = np.where(sine > 1e-12, np.arctan2(sine, turn[:, 0]) / np.maximum(sine, 1e-12), 1.0)
    mean = 2.0 * (per_sine / np.diff(motion.time))[:, None] * turn[:, 1:]
    return np.concatenate([motion.rate[:1], mean])


def _magnetometer(
    motion: Motion, stamps: Floats, sensor: Sensor, field: Floats, rate: float, rng: np.random.Generator
) -> tuple[Floats, Floats] | None:
    """The magnetometer's own stamps (m,) s and readings (m, 3) µT."""
    if sensor.mag is None:
        return None
    time = motion.time
    if sensor.mag_rate is not None:
        rate = sensor.mag_rate
        time = time[0] + np.arange(int((time[-1] - time[0]) * rate) + 1) / rate
        stamps = time
    instants = np.maximum(time - sensor.mag_delay, motion.time[0])
    before = np.clip(np.searchsorted(motion.time, instants, side="right") - 1, 0, len(motion) - 2)
    part = (instants - motion.time[before]) / (motion.time[before + 1] - motion.time[before])
    quat = arrays.slerp(motion.quat[before], motion.quat[before + 1], part)
    readings, _ = Readings(sensor.mag, rate, rng).of(arrays.rotate(arrays.conjugate(quat), field))
    return stamps, readings


class Readings:
    """What one three-axis sensor says of true values that come in blocks of any length."""

    def __init__(self, triad: Triad, rate: float, rng: np.random.Generator) -> None:
        self._triad, self._rng, self._root = triad, rng, float(np.sqrt(rate))
        cross = triad.misalignment * rng.standard_normal((3, 3))
        np.fill_diagonal(cross, triad.scale * rng.standard_normal(3))
        drawn = rng.standard_normal(3)
        self._cross = cross.T
        self.bias = triad.bias * drawn if isinstance(triad.bias, (int, float)) else np.array(triad.bias, float)
        """(3,) in the last reading"""
        self._first = True

    def of(self, true: Floats) -> tuple[Floats, Floats]:
        """The readings (n, 3) of the next true values, and the bias (n, 3) in them."""
        triad = self._triad
        steps = self._rng.standard_normal(true.shape)
        if self._first:
            steps[0], self._first = 0.0, False
        bias = self.bias + triad.walk / self._root * np.cumsum(steps, axis=0)
        self.bias = bias[-1]
        noise = triad.noise * self._root * self._rng.standard_normal(true.shape)
        readings = np.clip(true + true @ self._cross + bias + noise, -triad.limit, triad.limit)
        if triad.resolution > 0:
            readings = np.round(readings / triad.resolution) * triad.resolution
        return readings, bias


def _stamps(time: Floats, jitter: float, rng: np.random.Generator) -> Floats:
    """The instants (n,) s as stamped: late or early by less than half a step, so that they still rise."""
    most = 0.45 * float(np.diff(time).min())
    return time + np.clip(jitter * rng.standard_normal(len(time)), -most, most)


def _truth(motion: Motion, stamps: Floats, bias: Floats, heading_reference: HeadingReference) -> Attitude:
    truth = Attitude.of(stamps, motion.quat, heading_reference=heading_reference)
    truth.rate[:], truth.bias[:] = motion.rate, bias
    return truth
