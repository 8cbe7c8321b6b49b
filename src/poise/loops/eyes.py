"""What a loop knows of its body: an estimator behind the world's sensor, or, to compare with, the truth itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import COLUMNS, QUAT, RATE, Attitude
from poise.data.packet import Packet
from poise.errors import MethodError
from poise.estimators import METHODS
from poise.estimators.engine import Stream
from poise.simulation.worlds import World

Floats = NDArray[np.float64]
TRUTH = "truth"


class Seen(NamedTuple):
    """One sample and what was made of it."""

    packet: Packet
    attitude: Attitude


class Eyes:
    """The estimator called *method* on the sensor of *world*; ``"truth"`` is the world's own attitude and rate.

    *corrected* is what makes a packet of one that arrived: a calibration.
    """

    def __init__(self, method: str, world: World, corrected: Callable[[Packet], Packet] | None = None) -> None:
        check_method(method)
        self._world, self._corrected = world, corrected
        self._stream: Any = None if method == TRUTH else Stream(METHODS[method]())

    def see(self, packets: list[Packet]) -> list[Seen]:
        """The samples that arrived, each with the attitude after it."""
        if self._corrected is not None:
            packets = [self._corrected(packet) for packet in packets]
        return [Seen(packet, self._attitude(packet)) for packet in packets]

    def _attitude(self, packet: Packet) -> Attitude:
        if self._stream is not None:
            found: Attitude = self._stream.update(packet)
            return found
        truth = self._world.truth
        table = np.full((1, COLUMNS), np.nan)
        table[0, QUAT], table[0, RATE] = truth.quat, truth.rate
        return Attitude(np.array([float(np.asarray(packet.time))]), table, np.zeros(1, np.uint32), "magnetic")


def check_method(method: str) -> None:
    """Raises :class:`MethodError` for a name that is neither a method nor the truth."""
    if method != TRUTH and method not in METHODS:
        raise MethodError(f"no method {method!r}; there are {', '.join(METHODS)}, and {TRUTH} to compare with")
