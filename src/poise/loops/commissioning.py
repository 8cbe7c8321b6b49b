"""What is done once with a device before it is used: it rests, tumbles, and its sensors are calibrated by what they said."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from poise.control import AttitudeControl, Controller
from poise.data.attitude import COLUMNS, RATE, Attitude
from poise.data.packet import Packet
from poise.doctor import affine
from poise.simulation.worlds import AttitudeBody

Floats = NDArray[np.float64]

REST, TUMBLE, STOP = 3.0, 40.0, 3.0  # s
_RATE = 0.8  # rad/s
_PERIODS = np.array([11.0, 17.0, 7.0])  # s, of the rate about x, y and z: no two in step


@dataclass(frozen=True)
class Calibration:
    """The gyroscope's bias and the magnetometer's iron, as a device would keep them."""

    gyr_bias: Floats
    """(3,) rad/s"""
    mag: affine.Affine

    def __call__(self, packet: Packet) -> Packet:
        """*packet* with the errors taken out; what is missing stays missing."""
        return packet._replace(gyr=np.asarray(packet.gyr) - self.gyr_bias, mag=self.mag(np.asarray(packet.mag)))


def commissioned(world: AttitudeBody, control: AttitudeControl) -> Calibration:
    """Rest on the stand, 40 s of tumbling by the gyroscope alone, a stop; what that tells of the sensors of *world*.

    The world stays where it is, a body at rest: whoever uses it begins there.
    """
    controller, torque, bias = Controller(control), np.zeros(3), np.zeros(3)
    resting: list[Floats] = []
    while world.time < REST + TUMBLE + STOP - 1e-9:
        for packet in world.step(torque):
            if not world.released:
                resting.append(np.asarray(packet.gyr))
                bias = np.mean(resting, axis=0)
                continue
            row = np.full((1, COLUMNS), np.nan)  # a rate to hold needs no attitude
            row[0, RATE] = np.asarray(packet.gyr) - bias
            tumbling = world.time - REST
            phase = 2.0 * np.pi * tumbling / _PERIODS + np.array([0.0, 1.0, 0.5 * np.pi])
            controller.turn(_RATE * np.sin(phase) if tumbling < TUMBLE else np.zeros(3))
            torque = controller.update(Attitude(np.array([float(np.asarray(packet.time))]), row, _FINE))[0]
    return Calibration(bias, affine.magnetometer(world.recording()))


_FINE = np.zeros(1, np.uint32)
