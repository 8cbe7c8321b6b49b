"""Each package's filter as a function: an even, complete recording in, quaternions w x y z, sensor to ENU, out.

Every package has its own frame, units and start; ``tests/test_peers.py`` pins what comes out of these adapters. Without
a magnetometer each runs its variant for gyroscope and accelerometer, whose heading counts from where it started.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from poise.data.recording import STANDARD_GRAVITY, Recording
from poise.math import arrays
from poise.peers.even import period

Floats = NDArray[np.float64]

_QUARTER_TURN = arrays.turn_about_up(np.array(np.pi / 2))  # x north, y west, z up → east, north, up


def vqf_causal(recording: Recording) -> Floats:
    """VQF with its defaults, sample after sample."""
    from vqf import VQF

    vqf = VQF(period(recording))
    if not recording.has_mag:
        return np.asarray(vqf.updateBatch(recording.gyr, recording.acc)["quat6D"])
    return np.asarray(vqf.updateBatch(recording.gyr, recording.acc, recording.mag)["quat9D"])


def vqf_offline(recording: Recording) -> Floats:
    """VQF's offline variant, which knows the future; its silent magnetometer rows are filled in, see :func:`carried`."""
    from vqf import offlineVQF

    gyr, acc, mag, seconds = recording.gyr, recording.acc, recording.mag, period(recording)
    if not recording.has_mag or not mag.any(axis=1).all():
        level = np.asarray(offlineVQF(gyr, acc, None, seconds, None)["quat6D"])
        if not recording.has_mag:
            return level
        mag = carried(mag, level)
    return np.asarray(offlineVQF(gyr, acc, mag, seconds, None)["quat9D"])


def carried(mag: Floats, quat: Floats) -> Floats:
    """(n, 3) the field with its silent rows (0) as the attitude without magnetometer carries it over from the others.

    For a filter that takes 0 for a field that points along the body's x axis.
    """
    known = np.any(mag != 0.0, axis=1, keepdims=True)
    heard = np.flatnonzero(known)
    field = arrays.rotate(quat[heard], mag[heard])
    rows = np.arange(len(mag))
    carried_over = np.column_stack([np.interp(rows, heard, column) for column in field.T])
    return np.where(known, mag, arrays.rotate(arrays.conjugate(quat), carried_over))


def imufusion_ahrs(recording: Recording) -> Floats:
    """Fusion's bias and AHRS algorithms, one sample a call: it has no other way."""
    bias, ahrs = imufusion_filter(recording)
    quat = np.empty((len(recording), 4))
    has_mag = recording.has_mag
    for i, (gyr, acc, mag) in enumerate(zip(*imufusion_units(recording), strict=True)):
        if has_mag:
            ahrs.update(bias.update(gyr), acc, mag)
        else:
            ahrs.update_no_magnetometer(bias.update(gyr), acc)
        quat[i] = ahrs.get_quaternion()
    return quat


def ahrs_madgwick(recording: Recording) -> Floats:
    """Madgwick's filter, whose world is x north, y west, z up; its own start takes half turns for identity."""
    from ahrs.filters import Madgwick

    seconds = period(recording)

    def run(part: Recording) -> Floats:
        # The gain has to be said: without arrays in the constructor it is that of a filter without magnetometer.
        has_mag = part.has_mag
        madgwick = Madgwick(Dt=seconds, gain=0.041 if has_mag else 0.033)
        quat = np.empty((len(part), 4))
        quat[0] = arrays.multiply(arrays.conjugate(_QUARTER_TURN), first_attitude(part))
        for i in range(1, len(part)):
            if has_mag:
                quat[i] = madgwick.updateMARG(quat[i - 1], part.gyr[i], part.acc[i], part.mag[i])
            else:
                quat[i] = madgwick.updateIMU(quat[i - 1], part.gyr[i], part.acc[i])
        return arrays.multiply(_QUARTER_TURN, quat)

    return anew_at_first_field(recording, run)


def ahrs_mahony(recording: Recording) -> Floats:
    """Mahony's filter, whose world is ENU."""
    from ahrs.filters import Mahony

    seconds = period(recording)

    def run(part: Recording) -> Floats:
        mag, start = (part.mag, None) if part.has_mag else (None, first_attitude(part))
        return np.asarray(Mahony(gyr=part.gyr, acc=part.acc, mag=mag, q0=start, Dt=seconds).Q)

    return anew_at_first_field(recording, run)


def ahrs_ekf(recording: Recording) -> Floats:
    """Its extended Kalman filter, whose world is ENU and whose accelerometer measures gravity, not specific force.

    The dip that it has to be told is the median one of the recording, since the place is not known.
    """
    from ahrs.filters import EKF

    seconds = period(recording)

    def run(part: Recording) -> Floats:
        # It expects a field, or none, by its own `mag`, whatever update() is given: said row by row.
        ekf = EKF(Dt=seconds, frame="ENU", magnetic_ref=dip_deg(part))
        quat = np.empty((len(part), 4))
        quat[0] = first_attitude(part)
        heard = np.linalg.norm(part.mag, axis=1) > 0.0  # neither NaN nor silent
        for i in range(1, len(part)):
            ekf.mag = part.mag[i] if heard[i] else None
            quat[i] = ekf.update(quat[i - 1], part.gyr[i], -part.acc[i], ekf.mag)
        return quat

    return anew_at_first_field(recording, run)


def dip_deg(recording: Recording) -> float:
    """The median angle of the field below the horizontal plane that the accelerometer shows; 0 without magnetometer."""
    lengths = np.linalg.norm(recording.mag, axis=1) * np.linalg.norm(recording.acc, axis=1)
    known = np.flatnonzero(lengths > 0.0)
    if not len(known):
        return 0.0
    upward = np.sum(recording.mag[known] * recording.acc[known], axis=1) / lengths[known]
    return float(np.degrees(np.median(np.arcsin(np.clip(-upward, -1.0, 1.0)))))


def anew_at_first_field(recording: Recording, run: Callable[[Recording], Floats]) -> Floats:
    """What *run* gives, started anew where a late magnetometer sets in: from a wrong heading it would turn for minutes."""
    first = int(np.argmax(recording.mag.any(axis=1))) if recording.has_mag else 0
    return np.concatenate([run(recording[rows]) for rows in (slice(0, first), slice(first, None)) if rows.stop != 0])


def first_attitude(recording: Recording) -> Floats:
    """(4,) w x y z, sensor to ENU, of the first accelerometer and magnetometer sample; heading 0 without the latter."""
    from poise.math.quaternions import attitude_of
    from poise.math.vectors import Vec3

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
