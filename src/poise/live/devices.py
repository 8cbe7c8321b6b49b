"""Where samples come from: the protocol of a source, and the sources by the words of the command line."""

from __future__ import annotations

from collections.abc import AsyncIterator
from typing import Literal, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from poise.data.packet import Packet
from poise.errors import PoiseError
from poise.live.frames import UNNUMBERED

Floats = NDArray[np.float64]
Shape = Literal["board", "band", "phone", "handle", "robot", "joint"]
"""what a page draws a device as"""


class DeviceError(PoiseError):
    """A device that cannot be reached or understood; the message names it."""


class Arrival(NamedTuple):
    """Samples of one device that came together."""

    device: str
    rows: Floats
    """(n, 12): time, gyr, acc, mag, acc_age, mag_age, as the estimators' loop reads them"""
    sequence: int = UNNUMBERED
    """the number of the first sample, where the device counts them"""

    @property
    def packet(self) -> Packet:
        """The same as a :class:`Packet`."""
        return Packet(self.rows[:, 0], self.rows[:, 1:4], self.rows[:, 4:7], self.rows[:, 7:10])


class Source(Protocol):
    """Anything that samples come from."""

    name: str
    """for people: what it is and where"""
    shape: Shape
    """what its devices look like"""

    def arrivals(self) -> AsyncIterator[Arrival]:
        """Samples as they come, without an end unless the source has one.

        A source that goes away is waited for. Raises :class:`DeviceError` where it cannot be had at all.
        """
        ...
