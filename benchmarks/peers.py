"""Other packages' filters behind one shape: a recording in, quaternions w x y z, sensor to ENU, out.

Every package has its own frame, units and start; ``tests/test_benchmarks.py`` pins what comes out of these adapters.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.recording import STANDARD_GRAVITY, Recording
from poise.errors import RecordingError
from poise.math import arrays
from poise.math.quaternions import attitude_of
from poise.math.vectors import Vec3

Floats = NDArray[np.float64]

_QUARTER_TURN = arrays.turn_about_up(np.array(np.pi / 2))  # x north, y west, z up → east, north, up
_UNEVEN = 0.05  # the largest share by which a step between stamps may differ from the period that peers are given


class Peer(NamedTuple):
    """Another package's filter."""

    package: str
    settings: str
    """what it runs with, in words"""
    run: Callable[[Recording], Floats]
    """(n, 4) w x y z, sensor to ENU, of an even recording without absent samples"""


def vqf_causal(recording: Recording) -> Floats:
    """VQF with its defaults, 9 axes, sample after sample."""
    from vqf import VQF

    return np.asarray(VQF(period(recording)).updateBatch(recording.gyr, recording.acc, recording.mag)["quat9D"])


def vqf_offline(recording: Recording) -> Floats:
    """VQF's offline variant, which knows the future."""
    from vqf import offlineVQF

    return np.asarray(offlineVQF(recording.gyr, recording.acc, recording.mag, period(recording), None)["quat9D"])


def imufusion_ahrs(recording: Recording) -> Floats:
    """Fusion's bias and AHRS algorithms, one sample a call: it has no other way."""
    bias, ahrs = imufusion_filter(recording)
    quat = np.empty((len(recording), 4))
    for i, (gyr, acc, mag) in enumerate(zip(*imufusion_units(recording), strict=True)):
        ahrs.update(bias.update(gyr), acc, mag)
        quat[i] = ahrs.get_quaternion()
    return quat


def ahrs_madgwick(recording: Recording) -> Floats:
    """Madgwick's filter, whose world is x north, y west, z up; its own start takes half turns for identity."""
    from ahrs.filters import Madgwick

    # The gain has to be said: without arrays in the constructor it is that of a filter without magnetometer.
    madgwick = Madgwick(Dt=period(recording), gain=0.041)
    quat = np.empty((len(recording), 4))
    quat[0] = arrays.multiply(arrays.conjugate(_QUARTER_TURN), first_attitude(recording))
    for i in range(1, len(recording)):
        quat[i] = madgwick.updateMARG(quat[i - 1], recording.gyr[i], recording.acc[i], recording.mag[i])
    return arrays.multiply(_QUARTER_TURN, quat)


def ahrs_mahony(recording: Recording) -> Floats:
    """Mahony's filter, whose world is ENU."""
    from ahrs.filters import Mahony

    return np.asarray(Mahony(gyr=recording.gyr, acc=recording.acc, mag=recording.mag, Dt=period(recording)).Q)


def first_attitude(recording: Recording) -> Floats:
    """(4,) w x y z, sensor to ENU, of the first accelerometer and magnetometer sample."""
    return np.array(attitude_of(Vec3(*recording.acc[0]), Vec3(*recording.mag[0]), 0.0))


def imufusion_filter(recording: Recording) -> tuple[Any, Any]:
    """Fusion's bias and AHRS objects with the settings of the vendor's complete example, in ENU."""
    import imufusion

    settings = imufusion.AhrsSettings()
    settings.convention = imufusion.CONVENTION_ENU  # as an attribute: the constructor does not take it over
    settings.sample_rate = 1.0 / period(recording)
    settings.gain, settings.gyroscope_range = 0.5, 2000.0
    settings.acceleration_rejection = settings.magnetic_rejection = 10.0
    settings.rejection_timeout = 5.0
    ahrs = imufusion.Ahrs()
    ahrs.set_settings(settings)
    ahrs.set_sample_period(period(recording))
    still = imufusion.BiasSettings()
    still.sample_rate = settings.sample_rate
    bias = imufusion.Bias()
    bias.set_settings(still)
    return bias, ahrs


def imufusion_units(recording: Recording) -> tuple[Floats, Floats, Floats]:
    """Fusion's units: deg/s, g and any magnetic one."""
    return np.degrees(recording.gyr), recording.acc / STANDARD_GRAVITY, recording.mag


def period(recording: Recording) -> float:
    """s between samples, for filters that know one period and no absent sample.

    Raises :class:`RecordingError` for a recording that such a filter cannot be compared on.
    """
    seconds = 1.0 / recording.rate_hz
    if not np.allclose(np.diff(recording.time), seconds, rtol=_UNEVEN, atol=0.0):
        raise RecordingError("peers need even time stamps; resample the recording first")
    if not all(np.isfinite(sensor).all() for sensor in (recording.gyr, recording.acc, recording.mag)):
        raise RecordingError("peers need gyr, acc and mag in every row")
    return seconds


PEERS: dict[str, Peer] = {
    "vqf": Peer("vqf", "defaults, 9 axes, causal", vqf_causal),
    "vqf-offline": Peer("vqf", "defaults, 9 axes, not causal", vqf_offline),
    "imufusion": Peer("imufusion", "gain 0.5, rejections 10°, 5 s, with its bias algorithm", imufusion_ahrs),
    "ahrs-madgwick": Peer("ahrs", "gain 0.041, started from the first sample", ahrs_madgwick),
    "ahrs-mahony": Peer("ahrs", "k_P 1, k_I 0.3", ahrs_mahony),
}


def installed(package: str) -> str | None:
    """The version of a package, None where it is not there."""
    try:
        return version(package)
    except PackageNotFoundError:
        return None
