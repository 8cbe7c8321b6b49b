"""Joints: how one device stands seen from another, row by row, as :meth:`poise.Attitude.relative_to` says."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from math import inf
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import COLUMNS, QUAT, RATE, SIGMA, Attitude, Provenance
from poise.live.frames import ATTITUDE, NOT_MONITORED

if TYPE_CHECKING:
    from poise.live.batch import Span
    from poise.live.device import Device

Floats = NDArray[np.float64]

_PATIENCE = 0.1  # s that a row of the segment waits for the base; then it is unknown
_KEPT = 2.0  # s of the base
_MOST_KEPT = 20_000  # rows of it, whatever their stamps


class _Rows(NamedTuple):
    """Rows of one device's first method."""

    arrived: float
    """s, monotonic"""
    time: Floats
    table: Floats
    flags: NDArray[np.uint32]
    numbers: NDArray[np.uint64]

    def part(self, rows: Any) -> _Rows:
        return _Rows(self.arrived, self.time[rows], self.table[rows], self.flags[rows], self.numbers[rows])

    def attitude(self, time: Floats) -> Attitude:
        return Attitude.view(time, self.table, self.flags, "arbitrary", Provenance())


_NONE = _Rows(0.0, np.empty(0), np.empty((0, COLUMNS)), np.empty(0, np.uint32), np.empty(0, np.uint64))


class Joint:
    """The device *segment* seen from the device *base*, at the segment's samples; both by their first method.

    The base's attitude is turned evenly between the two rows beside the segment's instant: on the host's clock, or on the
    devices' own where they share one. A row whose base has not come within 0.1 s is not valid.
    """

    def __init__(self, name: str, number: int, slot: int, segment: str, base: str) -> None:
        self.name, self.number, self.slot, self.segment, self.base = name, number, slot, segment, base
        self.rows = self.invalid = 0
        """rows so far, and how many of them were not to be acted on"""
        self._waiting: deque[_Rows] = deque()
        self._before, self._newest, self._restarts = _NONE, -inf, 0  # rows of the base, the last stamp of them
        self._quat: Floats | None = None

    def take(self, span: Span, time: Floats, table: Floats, flags: NDArray[np.uint32], now: float) -> None:
        """Keeps what was made of the samples of *span*, which are the segment's or the base's."""
        numbers = np.arange(span.sequence, span.sequence + len(time), dtype=np.uint64)
        rows = _Rows(now, time, table, flags, numbers)
        if span.device.name == self.segment:
            self._waiting.append(rows)
        else:
            self._keep(rows, span.device.clock.restarts)

    def _keep(self, rows: _Rows, restarts: int) -> None:
        if restarts != self._restarts:  # the base's stamps began anew
            self._restarts, self._before, self._newest = restarts, _NONE, -inf
        stamps = np.where(np.isfinite(rows.time), rows.time, -inf)
        rows = rows.part(stamps > np.maximum.accumulate(np.concatenate([[self._newest], stamps[:-1]])))
        if not len(rows.time):
            return
        self._newest = float(rows.time[-1])
        kept = _joined([self._before, rows])
        start = max(int(np.searchsorted(kept.time, self._newest - _KEPT)), len(kept.time) - _MOST_KEPT)
        self._before = kept.part(slice(start, None))

    def advance(self, devices: dict[str, Device], now: float, wall: float) -> tuple[Attitude, NDArray[np.void]] | None:
        """The attitude at those of the segment's rows whose base is known by now, or is not waited for any longer, and
        the same as records; None for no row."""
        segment, base = devices.get(self.segment), devices.get(self.base)
        if not self._waiting or segment is None:
            return None
        shared = base is None or segment.timebase == base.timebase != ""
        own = self._before.time if shared or base is None else _on_host(base, self._before.time)
        clock: Callable[[Floats], Floats] = (lambda time: time) if shared else (lambda time: _on_host(segment, time))
        ready = self._ready(clock, float(own[-1]) if len(own) else -inf, now)
        if not len(ready.time):
            return None
        made = ready.attitude(clock(ready.time)).relative_to(self._before.attitude(own))
        self._go_on(made.table[:, QUAT])
        made.time[:] = ready.time
        self.rows += len(made)
        self.invalid += int(np.count_nonzero(~made.valid))
        return made, self._records(made, ready.numbers, _on_host(segment, ready.time) + wall)

    def _ready(self, clock: Callable[[Floats], Floats], newest: float, now: float) -> _Rows:
        found = [_NONE]
        while self._waiting:
            rows = self._waiting[0]
            n = len(rows.time)
            if now - rows.arrived < _PATIENCE:
                late = np.flatnonzero(clock(rows.time) > newest)
                n = int(late[0]) if len(late) else n
            found.append(rows.part(slice(0, n)))
            if n < len(rows.time):
                self._waiting[0] = rows.part(slice(n, None))
                break
            self._waiting.popleft()
        return _joined(found)

    def _go_on(self, quat: Floats) -> None:
        """The sign follows that of the last rows."""
        known = np.flatnonzero(np.isfinite(quat[:, 0]))
        if len(known):
            if self._quat is not None and self._quat @ quat[known[0]] < 0.0:
                quat *= -1.0
            self._quat = quat[known[-1]].copy()

    def _records(self, made: Attitude, numbers: NDArray[np.uint64], host: Floats) -> NDArray[np.void]:
        found = np.zeros(len(made), ATTITUDE)
        found["device"], found["time"], found["host"], found["sequence"] = self.number, made.time, host, numbers
        found["quat"], found["rate"], found["sigma"] = (made.table[:, part] for part in (QUAT, RATE, SIGMA))
        found["gyr"] = found["acc"] = found["mag"] = np.nan
        found["flags"] = found["flags_since"] = made.flags
        found["valid"], found["tip"] = made.valid, NOT_MONITORED
        return found

    def described(self, devices: dict[str, Device]) -> dict[str, Any]:
        """What pages are told about it."""
        segment, base = devices.get(self.segment), devices.get(self.base)
        method = {"number": 0, "name": "relative-to", "settings": "{}", "heading": "arbitrary"}
        return {
            "id": self.name,
            "number": self.number,
            "source": f"{self.segment}/{self.base}",
            "shape": "joint",
            "segment": self.segment,
            "base": self.base,
            "connected": any(each is not None and each.connected > 0 for each in (segment, base)),
            "methods": [method],
        }

    def condition(self, devices: dict[str, Device], now: float) -> dict[str, Any]:
        """How it fares, with the keys of a device; the rates are its segment's."""
        both = [devices.get(self.segment), devices.get(self.base)]
        states = [each.condition(now) for each in both if each is not None]
        silent = any(each["state"] in ("silent", "standing", "failed") for each in states)
        return (
            {
                "id": self.name,
                "state": "silent" if silent else "live" if self.rows else "waiting",
                "rate_hz": states[0]["rate_hz"] if both[0] is not None else 0.0,
                "samples": self.rows,
                "invalid": {"relative-to": self.invalid},
                "resets": {"relative-to": 0},
                "last_heard_s": max((each["last_heard_s"] or 0.0 for each in states), default=None),
            }
            | dict.fromkeys(("lost", "repeated", "rejected", "silences", "clock_drift_ppm", "clock_restarts"), 0)
            | {"failed": None}
        )


def _on_host(device: Device, time: Floats) -> Floats:
    start, slope = device.clock.line
    return start + slope * time


def _joined(parts: list[_Rows]) -> _Rows:
    if len(parts) == 2 and not len(parts[0].time):
        return parts[1]
    return _Rows(
        parts[-1].arrived,
        np.concatenate([part.time for part in parts]),
        np.concatenate([part.table for part in parts]),
        np.concatenate([part.flags for part in parts]),
        np.concatenate([part.numbers for part in parts]),
    )
