"""Sensors that are sold, by name, with the figures of their data sheets.

Noise, range and step are the data sheet's. Offsets, scale and cross-axis errors are what it allows a part to have; a
device in use has been calibrated once, and its gyroscope is zeroed when it is switched on. What is left of them is drawn
anew with every seed: normal, with a tenth of the limit as its standard deviation, that of a gyroscope's offset 0.5 °/s at
most; ``as_delivered`` draws with a third of the limit. Data sheets do not state what a bias does over minutes, nor the
iron around a magnetometer in a device: these are the ones of :class:`Sensor`, for every part.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import radians

from poise.data.recording import STANDARD_GRAVITY
from poise.errors import RecordingError
from poise.simulation.sensor import Sensor, Triad

_CALIBRATED, _AS_DELIVERED = 0.1, 1.0 / 3.0
_ZEROED = 0.5  # °/s
_LATENCY, _LATENCY_JITTER, _JITTER = 0.002, 0.0005, 50e-6  # s: I²C at 400 kHz read by a microcontroller


@dataclass(frozen=True)
class Inertial:
    """A gyroscope and an accelerometer in one case, as its data sheet states them, at its widest ranges."""

    source: str
    gyr_noise: float
    """°/s/√Hz"""
    acc_noise: float
    """µg/√Hz"""
    gyr_offset: float
    """± °/s"""
    acc_offset: float
    """± mg"""
    gyr_scale: float
    """± %"""
    acc_scale: float
    """± %"""
    cross: float
    """± %, of both"""
    gyr_step: float
    """°/s a step"""
    acc_step: float
    """mg a step"""
    gyr_limit: float = 2000.0
    """± °/s"""
    acc_limit: float = 16.0
    """± g"""


@dataclass(frozen=True)
class Magnetic:
    """A magnetometer as its data sheet states it."""

    source: str
    noise: float
    """µT, RMS of a sample; half a step where the data sheet states none"""
    limit: float
    """± µT"""
    step: float
    """µT"""
    rate: float
    """samples per second"""
    delay: float
    """s by which it lags: half a measurement"""


INERTIAL = {
    "MPU-6050": Inertial(
        "InvenSense PS-MPU-6000A-00 rev. 3.4, 6.1 and 6.2", 0.005, 400, 20, 50, 3, 3, 2, 1 / 16.4, 1e3 / 2048
    ),
    "MPU-9250": Inertial(
        "InvenSense PS-MPU-9250A-01 rev. 1.0, tables 1 and 2", 0.01, 300, 5, 60, 3, 3, 2, 1 / 16.4, 1e3 / 2048
    ),
    "ICM-20948": Inertial(
        "TDK InvenSense DS-000189 rev. 1.3, tables 1 and 2", 0.015, 230, 5, 50, 1.5, 0.5, 2, 1 / 16.4, 1e3 / 2048
    ),
    "ICM-42688-P": Inertial(
        "TDK InvenSense DS-000347 rev. 1.7", 0.0028, 70, 0.5, 20, 0.5, 0.5, 1.25, 1 / 16.4, 1e3 / 2048
    ),
    "BMI270": Inertial(
        "Bosch BST-BMI270-DS000 rev. 1.5; cross-axis taken as ±1 %", 0.007, 160, 0.5, 20, 2, 0.4, 1, 1 / 16.384, 1e3 / 2048
    ),
    "LSM6DSOX": Inertial(
        "ST DS12814; scale and cross-axis taken as ±1 %", 0.0038, 70, 1, 20, 1, 1, 1, 0.070, 0.488
    ),
}  # fmt: skip

MAGNETIC = {
    "QMC5883L": Magnetic("QST QMC5883L rev. 1.0: 2 mG resolution of a field, 8 G range", 0.2, 800, 1 / 30, 200, 0.0025),
    "HMC5883L": Magnetic("Honeywell 900405 rev. E: 2 mG, gain 1090 LSB/G", 0.2, 130, 0.092, 75, 0.003),
    "MMC5983MA": Magnetic("MEMSIC MMC5983MA rev. A: 0.4 mG at 100 Hz, 18 bit", 0.04, 800, 0.00625, 100, 0.004),
    "AK8963": Magnetic("in the MPU-9250: PS-MPU-9250A-01; noise not stated", 0.075, 4800, 0.15, 100, 0.0036),
    "AK09916": Magnetic("in the ICM-20948: DS-000189, table 3; noise not stated", 0.075, 4900, 0.15, 100, 0.0036),
}  # fmt: skip

_INSIDE = {"MPU-9250": "AK8963", "ICM-20948": "AK09916"}


def names() -> list[str]:
    """What :func:`part` knows; a magnetometer goes behind a plus."""
    return [*INERTIAL, *(f"+{name}" for name in MAGNETIC)]


def part(name: str, *, as_delivered: bool = False) -> Sensor:
    """The sensor called *name*: ``"MPU-6050"`` without a magnetometer, ``"MPU-6050+QMC5883L"`` with one.

    Raises :class:`RecordingError` for a part that is not known.
    """
    inertial, _, magnetic = (text.strip() for text in name.partition("+"))
    magnetic = magnetic or _INSIDE.get(inertial, "")
    if inertial not in INERTIAL or (magnetic and magnetic not in MAGNETIC):
        raise RecordingError(
            f"sensor {name!r}: expected one of {', '.join(INERTIAL)}, with +{', +'.join(MAGNETIC)} for a magnetometer"
        )
    made = _inertial(INERTIAL[inertial], _AS_DELIVERED if as_delivered else _CALIBRATED, as_delivered)
    return replace(made, mag=None) if not magnetic else _with_magnetometer(made, MAGNETIC[magnetic])


def _inertial(of: Inertial, share: float, as_delivered: bool) -> Sensor:
    typical, g = Sensor(), STANDARD_GRAVITY
    offset = share * of.gyr_offset
    gyr = Triad(
        noise=radians(of.gyr_noise),
        bias=radians(offset if as_delivered else min(offset, _ZEROED)),
        walk=typical.gyr.walk,
        scale=share * of.gyr_scale / 100,
        misalignment=share * of.cross / 100,
        limit=radians(of.gyr_limit),
        resolution=radians(of.gyr_step),
    )
    acc = Triad(
        noise=of.acc_noise * 1e-6 * g,
        bias=share * of.acc_offset * 1e-3 * g,
        walk=typical.acc.walk,
        scale=share * of.acc_scale / 100,
        misalignment=share * of.cross / 100,
        limit=of.acc_limit * g,
        resolution=of.acc_step * 1e-3 * g,
    )
    return Sensor(gyr=gyr, acc=acc, jitter=_JITTER, latency=_LATENCY, latency_jitter=_LATENCY_JITTER)


def _with_magnetometer(sensor: Sensor, of: Magnetic) -> Sensor:
    iron = Sensor().mag or Triad()
    mag = replace(iron, noise=of.noise / of.rate**0.5, limit=of.limit, resolution=of.step)
    return replace(sensor, mag=mag, mag_rate=of.rate, mag_delay=of.delay)
