"""Whether what is said of a device still holds: a body that tips over, silence, a clock that stands still, a fault of ours."""

from __future__ import annotations

import logging
from math import inf, isfinite, nan
from typing import TYPE_CHECKING

import numpy as np

from poise.data.attitude import Attitude, Provenance
from poise.data.event import TipEvent, TipState
from poise.data.flags import SILENT
from poise.live.frames import NOT_MONITORED
from poise.live.watching import as_facts, as_text

if TYPE_CHECKING:
    from poise.live.batch import Batch, Span
    from poise.live.device import Device
    from poise.live.hub import Hub

LOGGER = logging.getLogger("poise.live")

_AT_LEAST = 0.06  # s: a stream calls it silence from 0.05 s on
_BUSY = 0.2  # s, silence is told after no more, though every tick is late
_READING = 0.1  # s that a busy server may take to read what has come
_OVERLOADED = 1.0  # s after the last late tick
_MOST_TEXT = 200  # characters of a fault


class Guarding:
    """Looks after the devices of *hub*: what fails with one of them, or is no longer known of it, is told, and the others
    go on."""

    def __init__(self, hub: Hub) -> None:
        self._hub = hub
        self._before, self._late_since = nan, inf
        self._overloaded = -_OVERLOADED

    def overloaded(self, now: float) -> bool:
        """Whether ticks come late, one after the other: then silence is told later than it could be."""
        return now - self._overloaded < _OVERLOADED

    # -- with every tick ------------------------------------------------------------------------------------------

    def judge(self, batch: Batch) -> None:
        """Rows whose clock stands still are of unknown attitude; then each device's monitor looks at its first method."""
        watch = self._hub.watch
        for span in batch.spans:
            device = span.device
            if device.failed:
                continue
            try:
                if device.standstill.standing:
                    batch.flags[span.out] |= np.uint32(SILENT)
                if watch is not None and span.run is device.runs[0]:
                    self._judge(batch, span)
            except Exception as problem:
                self.fail(device, problem)

    def _judge(self, batch: Batch, span: Span) -> None:
        device, watch = span.device, self._hub.watch
        assert watch is not None
        if device.monitor is None:
            device.monitor = watch.monitor(device.name)
        rows = batch.rows[span.rows]
        time, table, flags = rows[:, 0].copy(), batch.table[span.out], batch.flags[span.out]
        attitude = Attitude.view(time, table, flags, "arbitrary", Provenance())
        self._tell(device, device.monitor.update(attitude, rows[:, 4:7]))

    def _tell(self, device: Device, events: list[TipEvent]) -> None:
        watch = self._hub.watch
        assert watch is not None
        assert device.monitor is not None
        device.tip = int(device.monitor.state)
        for event in events:
            self._hub.event("tip", device, as_text(device.name, event), **as_facts(event))
            watch.handle(device.name, event)

    def tell_clock(self, device: Device) -> None:
        """The clock of *device* stands still by now, or goes on."""
        standing = device.standstill.standing
        text = "its clock stands still: its attitude is unknown" if standing else "its clock goes on"
        self._hub.event("clock", device, f"{device.name}: {text}")

    # -- silence --------------------------------------------------------------------------------------------------

    def hush(self, now: float, late: bool) -> None:
        """Attitudes of devices that have fallen silent become unknown; *late*: this tick comes later than it should.

        After one late tick, what has come meanwhile may not be read yet, and nothing is said; where one follows the other,
        the silence of a device is told all the same, within 0.2 s as long as ticks take no more than half of that.
        """
        period, self._before = now - self._before, now
        first = late and self._late_since == inf
        self._late_since = min(self._late_since, now) if late else inf
        if first:
            return
        if now - self._late_since >= _BUSY:
            if not self.overloaded(now):
                self._hub.event("overloaded", None, f"overloaded: ticks are late, {1e3 * period:.0f} ms for the last")
            self._overloaded = now
        least = max(_BUSY - period, _READING) if late else 0.0
        for device in self._hub.devices.values():
            health = device.health
            since = now - health.heard
            if since <= health.silence or since <= least or health.silent:  # nearly always
                continue
            if device.runs and health.samples and not device.failed:
                try:
                    self._silent(device, now)
                except Exception as problem:
                    self.fail(device, problem)

    def _silent(self, device: Device, now: float) -> None:
        hub, health = self._hub, device.health
        health.silent = True
        health.silences += 1
        then = _last_stamp(device) + max(now - health.heard, _AT_LEAST)
        if device.monitor is not None:
            self._tell(device, device.monitor.check(then))
        for run in device.runs:
            if run.stream.latest is not None:
                hub.newest.unknown(run.slot, run.stream.check(then), device.tip)
        hub.joints.silent(device)
        hub.event("silent", device, f"{device.name} is silent: its attitude is unknown")

    # -- faults ---------------------------------------------------------------------------------------------------

    def fail(self, device: Device, problem: Exception) -> None:
        """What ran for *device* has failed, which is a fault of ours: its run ends, it is unknown, and the others go on."""
        why = f"{type(problem).__name__}: {problem}"[:_MOST_TEXT]
        LOGGER.error("what ran for %s failed", device.name, exc_info=problem)
        device.fail(why)
        hub = self._hub
        device.tip = NOT_MONITORED if hub.watch is None else int(TipState.UNKNOWN)
        if hub.watch is not None:
            before = TipState.UNKNOWN if device.monitor is None else device.monitor.state
            event = TipEvent(_last_stamp(device), TipState.UNKNOWN, before, reason=f"its run has ended: {why}")
            device.monitor = None
            hub.event("tip", device, as_text(device.name, event), **as_facts(event))
            try:
                hub.watch.handle(device.name, event)
            except Exception:
                LOGGER.exception("what answers for %s failed", device.name)
        for run in device.runs:
            hub.newest.silence(run.slot, device.tip)
        hub.joints.silent(device)
        text = f"{device.name}: its run has ended by a fault, its attitude is unknown: {why}"
        hub.event("failed", device, f"{text}; it begins anew once its methods are chosen anew")


def _last_stamp(device: Device) -> float:
    """s, of the last sample whose stamp is a number; 0 where there was none."""
    stamp = device.standstill.stamp
    return stamp if isfinite(stamp) else 0.0
