"""Objects that stay are taken out of the garbage collector's rounds."""

from __future__ import annotations

import gc

_MORE, _FEWER = 1.2, 0.5


class Settled:
    """Devices and connections that have come to stay.

    A collector that goes over the objects of 1000 devices holds up ticks by 50 ms, every few seconds. Those that stay
    are frozen once most of them are there; after half of them have left, all are looked at again, so that what they
    left behind is freed.
    """

    def __init__(self) -> None:
        self._before = self._frozen = 0

    def freeze(self) -> None:
        """All objects of now stay."""
        gc.freeze()

    def look(self, count: int) -> None:
        """*count*: of devices and connections now. Once a second."""
        steady, self._before = count <= self._before, count
        if count < _FEWER * self._frozen:
            gc.unfreeze()
            self._frozen = 0
        elif steady and count > _MORE * self._frozen + 10:
            gc.freeze()
            self._frozen = count
