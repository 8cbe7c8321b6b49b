"""Made truth to feed to an estimator: a sensor turned on the spot, so that gravity is all that accelerates it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from poise.data.recording import Recording
from poise.math import arrays
from poise.simulation import Motion, Sensor, Triad, forearm, measure

Floats = NDArray[np.float64]

DIP_DEG = 63.7
"""of the made field, which points to magnetic north and down: that of central Europe, where filters have their defaults"""
FIELD_UT = 48.0

# Just enough noise that no two samples are equal: a repeated sample is a fault that a filter may look for.
_NEARLY_PERFECT = Sensor(
    gyr=Triad(noise=np.radians(0.002)), acc=Triad(noise=5e-4), mag=Triad(noise=0.005), mag_delay=0.0, jitter=0.0
)
_TURN, _HOLD, _TUMBLE = 0.8, 0.7, 18.0  # s
_QUARTERS = (("x", 1), ("x", -1), ("y", 1), ("y", -1), ("z", 1), ("z", -1), ("z", 1), ("x", 1), ("z", 1))
_PULSE_DEG, _PULSE, _APART = 20.0, 0.2, 2.0  # a turn that only the gyroscope tells of
# A pose that is the identity in no frame, in which no axis is level.
_START = arrays.multiply(
    arrays.multiply(arrays.turn_about_up(np.array(0.62)), np.array([np.cos(0.17), np.sin(0.17), 0.0, 0.0])),
    np.array([np.cos(0.11), 0.0, -np.sin(0.11), 0.0]),
)


@dataclass(frozen=True, eq=False)
class Scene:
    """A made recording, rad/s, m/s² and µT, and the rows at which an attitude is asked for."""

    recording: Recording
    quat: Floats
    """(n, 4) w x y z, body to ENU"""
    rest: int
    """rows of rest at the start, in which an estimator may settle"""

    @property
    def judged(self) -> NDArray[np.intp]:
        """The rows that count, about 400 of them: all but the rest at the start."""
        return np.unique(np.linspace(self.rest, len(self.quat) - 1, 400).astype(int))


def turntable(
    rate: float, rest: float = 10.0, *, uneven: bool = False, southern: bool = False, slower: float = 1.0
) -> Scene:
    """*rest* s still in a tilted pose, quarter turns about each body axis to and fro, then tumbling through all attitudes.

    *uneven* draws steps between 0.4 and 1.6 periods; *southern* lets the field point up, as on the southern half of the
    Earth; *slower* makes the motion after the rest take so many times longer.
    """
    last = rest + len(_QUARTERS) * (_TURN + _HOLD) + _TUMBLE
    stamps = np.arange(round((rest + slower * (last - rest)) * rate)) / rate
    if uneven:
        stamps = stamps + np.random.default_rng(4).uniform(-0.3, 0.3, len(stamps)) / rate
    time = np.minimum(stamps, rest) + np.maximum(stamps - rest, 0.0) / slower
    quat = np.tile(_START, (len(time), 1))
    for i, (axis, sign) in enumerate(_QUARTERS):
        share = np.clip((time - rest - i * (_TURN + _HOLD)) / _TURN, 0.0, 1.0)
        quat = arrays.multiply(quat, about(axis, sign * np.pi / 2 * _smooth(share)))
    since = np.maximum(time - last + _TUMBLE, 0.0)
    wave = _smooth(np.minimum(since / 1.5, 1.0))
    for axis, reach, hertz in (("x", 2.6, 0.19), ("y", 2.1, 0.27), ("z", 2.9, 0.23), ("x", 1.2, 0.61)):
        quat = arrays.multiply(quat, about(axis, wave * reach * np.sin(2 * np.pi * hertz * since)))
    return _measured(stamps, quat, round(rest * rate), southern)


def arm(rate: float) -> Scene:
    """A forearm with an inexpensive sensor: accelerations, rests and a bias, for what listens to the size of acc."""
    motion = forearm(40.0, rate, seed=3)
    recording = replace(measure(motion, Sensor(mag_delay=0.0, jitter=0.0), seed=3), moving=None)
    return Scene(recording, motion.quat, round(10.0 * rate))


@dataclass(frozen=True, eq=False)
class Pulses:
    """Rest, in which only the gyroscope tells of a turn about each axis in turn, by rows (first, last)."""

    scene: Scene
    rows: tuple[tuple[int, int], ...]
    angle: float
    """rad"""


def pulses(rate: float, rest: float) -> Pulses:
    """The gyroscope says +20° in 0.2 s about x, y and z, 2 s apart; accelerometer and magnetometer say that nothing moved."""
    n = round((rest + 3 * _APART) * rate)
    scene = _measured(np.arange(n) / rate, np.tile(_START, (n, 1)), round(rest * rate), False)
    gyr = scene.recording.gyr.copy()
    rows = []
    for axis in range(3):
        first = round((rest + axis * _APART) * rate)
        count = max(1, round(_PULSE * rate))
        gyr[first : first + count, axis] += np.radians(_PULSE_DEG) * rate / count
        rows.append((first - 1, first + count - 1))
    recording = replace(scene.recording, gyr=gyr, truth=None)
    return Pulses(Scene(recording, scene.quat, scene.rest), tuple(rows), float(np.radians(_PULSE_DEG)))


def about(axis: str, angle: Floats) -> Floats:
    """(n, 4) turns about a body axis."""
    quat = np.zeros((*np.shape(angle), 4))
    quat[..., 0], quat[..., 1 + "xyz".index(axis)] = np.cos(0.5 * angle), np.sin(0.5 * angle)
    return quat


def _measured(time: Floats, quat: Floats, rest: int, southern: bool) -> Scene:
    dip = np.radians(-DIP_DEG if southern else DIP_DEG)
    field = (0.0, FIELD_UT * float(np.cos(dip)), -FIELD_UT * float(np.sin(dip)))
    still = np.zeros((len(time), 3))
    # The rate of the motion is that of its first row only: the gyroscope's samples are made from its attitudes.
    recording = measure(Motion(time, quat, still, still), _NEARLY_PERFECT, field=field, name="conformance")
    return Scene(replace(recording, moving=None), arrays.normalize(quat), rest)


def _smooth(share: Floats) -> Floats:
    return np.asarray(share**3 * (10.0 - 15.0 * share + 6.0 * share**2))
