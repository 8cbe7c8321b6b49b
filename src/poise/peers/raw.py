"""The packages' filters as they come: what they are fed goes in untouched, what they say comes out untouched.

:mod:`poise.conformance` finds out by these what frame, order and units each has; the adapters have to agree with it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from poise.errors import PoiseError
from poise.peers import installed

Floats = NDArray[np.float64]
Raw = Callable[[Floats, Floats, Floats, Floats], Any]


def vqf(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
    from vqf import VQF

    return VQF(_period(time)).updateBatch(*_contiguous(gyr, acc, mag))["quat9D"]


def vqf_6d(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
    from vqf import VQF

    return VQF(_period(time)).updateBatch(*_contiguous(gyr, acc))["quat6D"]


def vqf_offline(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
    from vqf import offlineVQF

    return offlineVQF(*_contiguous(gyr, acc, mag), _period(time), None)["quat9D"]


def imufusion(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Floats:
    """With the settings it is made with."""
    return _imufusion(time, gyr, acc, mag, None)


def imufusion_enu(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Floats:
    return _imufusion(time, gyr, acc, mag, "CONVENTION_ENU")


def imufusion_ned(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Floats:
    return _imufusion(time, gyr, acc, mag, "CONVENTION_NED")


def _imufusion(time: Floats, gyr: Floats, acc: Floats, mag: Floats, convention: str | None) -> Floats:
    import imufusion as package

    ahrs = package.Ahrs()
    ahrs.set_sample_period(_period(time))
    if convention:
        settings = package.AhrsSettings()
        settings.convention = getattr(package, convention)
        settings.sample_rate = 1.0 / _period(time)
        ahrs.set_settings(settings)
    quat = np.empty((len(gyr), 4))
    for i in range(len(gyr)):
        ahrs.update(gyr[i], acc[i], mag[i])
        quat[i] = ahrs.get_quaternion()
    return quat


def ahrs_madgwick(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
    from ahrs.filters import Madgwick

    return Madgwick(gyr=gyr, acc=acc, mag=mag, Dt=_period(time)).Q


def ahrs_mahony(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
    from ahrs.filters import Mahony

    return Mahony(gyr=gyr, acc=acc, mag=mag, Dt=_period(time)).Q


def ahrs_ekf(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Floats:
    """In its frame "ENU", with the field of Munich that it assumes, sample by sample from the identity.

    Its constructor, given all samples, starts in a wrong attitude in this frame, and does not get out of it within a minute.
    """
    from ahrs.filters import EKF

    ekf = EKF(Dt=_period(time), frame="ENU")
    quat = np.empty((len(gyr), 4))
    latest = np.array([1.0, 0.0, 0.0, 0.0])
    for i in range(len(gyr)):
        ekf.mag = mag[i]  # it expects a field, or none, by this, whatever update() is given
        quat[i] = latest = ekf.update(latest, gyr[i], acc[i], mag[i])
    return quat


def ahrs_ekf_ned(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
    """In its frame "NED", its default."""
    from ahrs.filters import EKF

    return EKF(gyr=gyr, acc=acc, mag=mag, Dt=_period(time), frame="NED").Q


RAW: dict[str, Raw] = {
    "vqf": vqf,
    "vqf-6d": vqf_6d,
    "vqf-offline": vqf_offline,
    "imufusion": imufusion,
    "imufusion-enu": imufusion_enu,
    "imufusion-ned": imufusion_ned,
    "ahrs-madgwick": ahrs_madgwick,
    "ahrs-mahony": ahrs_mahony,
    "ahrs-ekf": ahrs_ekf,
    "ahrs-ekf-ned": ahrs_ekf_ned,
}


def named(word: str) -> dict[str, Raw]:
    """The filters that a name means: "imufusion-ned" is one, "ahrs" is all of that package that have its name in front.

    Raises :class:`PoiseError` for a package that is not installed; empty for a name that is none of these.
    """
    found = {word: RAW[word]} if word in RAW else {n: f for n, f in RAW.items() if n.partition("-")[0] == word}
    absent = [name for name in found if installed(name.partition("-")[0]) is None]
    if absent:
        raise PoiseError(f"{absent[0]} needs the package {absent[0].partition('-')[0]}, which is not installed: "
                         'pip install "poise[peers]"')  # fmt: skip
    return found


def _period(time: Floats) -> float:
    return float(np.median(np.diff(time)))


def _contiguous(*sensors: Floats) -> list[Floats]:
    return [np.ascontiguousarray(sensor) for sensor in sensors]
