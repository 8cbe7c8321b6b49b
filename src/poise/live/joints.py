"""The joints of a hub: added and removed while it runs, advanced with every tick."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude
from poise.errors import PoiseError
from poise.live.joint import Joint

if TYPE_CHECKING:
    from poise.live.batch import Batch, Newest
    from poise.live.device import Device

LOGGER = logging.getLogger("poise.live")

_MOST = 256


class JointError(PoiseError):
    """A joint that cannot be, or is not there."""


class Joints:
    """Joints by name, between *devices*; their newest records are in *newest*."""

    def __init__(self, devices: dict[str, Device], newest: Newest) -> None:
        self.all: dict[str, Joint] = {}
        self.on_rows: list[Callable[[Joint, Attitude, NDArray[np.void]], None]] = []
        """called with what a tick made of a joint: the rows, and as viewers get them"""
        self.on_fault: list[Callable[[Joint, str], None]] = []
        """called with a joint that is no more, since something in it failed, and why"""
        self._devices, self._newest = devices, newest
        self._of: dict[str, list[Joint]] = {}  # by the names of their devices

    def check(self, name: str, segment: str, base: str) -> None:
        """Raises :class:`JointError` for a joint that cannot be; its devices may come later."""
        if segment == base:
            raise JointError(f"joint {name!r}: two different devices expected, found {segment!r} twice")
        if name in self._devices or name in (segment, base):
            raise JointError(f"joint {name!r}: there is a device of that name")
        if also := {segment, base} & self.all.keys():
            raise JointError(f"joint {name!r}: between devices, and {min(also)!r} is a joint")
        if name not in self.all and len(self.all) >= _MOST:
            raise JointError(f"joint {name!r}: there are {_MOST} already")

    def add(self, name: str, number: int, segment: str, base: str) -> None:
        """The joint *name*, in the place of one that was called so."""
        if name in self.all:
            self.remove(name)
        self.all[name] = Joint(name, number, self._newest.slot(number, 0), segment, base)
        self._sort()

    def remove(self, name: str) -> None:
        """Raises :class:`JointError` where there is no such joint."""
        if name not in self.all:
            raise JointError(f"no joint {name[:80]!r}; there are: {', '.join(self.all) or 'none'}")
        self._newest.drop(self.all.pop(name).slot)
        self._sort()

    def _sort(self) -> None:
        self._of = {}
        for joint in self.all.values():
            for device in (joint.segment, joint.base):
                self._of.setdefault(device, []).append(joint)

    def advance(self, batch: Batch, now: float) -> None:
        """What *batch* says of the devices, to their joints, and on to whoever listens."""
        if not self.all:
            return
        for span in batch.spans:
            for joint in self._of.get(span.device.name, ()):
                if span.run is span.device.runs[0]:
                    time = batch.rows[span.rows, 0].copy()
                    joint.take(span, time, batch.table[span.out], batch.flags[span.out], now)
        for joint in list(self.all.values()):
            try:
                made = joint.advance(self._devices, now, batch.wall)
                if made is not None:
                    self._newest.put_rows(joint.slot, made[1])
            except Exception as problem:  # a fault of ours in one joint: devices and other joints go on
                self._fail(joint, problem)
                continue
            if made is not None:
                for told in self.on_rows:
                    told(joint, *made)

    def _fail(self, joint: Joint, problem: Exception) -> None:
        LOGGER.error("joint %s failed", joint.name, exc_info=problem)
        self.remove(joint.name)
        for told in self.on_fault:
            told(joint, f"{type(problem).__name__}: {problem}")

    def silent(self, device: Device) -> None:
        """*device* has fallen silent, and with it the joints that it is part of."""
        for joint in self._of.get(device.name, ()):
            self._newest.silence(joint.slot)
