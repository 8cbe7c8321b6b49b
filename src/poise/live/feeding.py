"""What the sources of a server give, to the hub; how each of them fares, and what is amiss with it."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from poise.errors import PoiseError

if TYPE_CHECKING:
    from poise.live.device import Device
    from poise.live.devices import Source
    from poise.live.hub import Hub


LOGGER = logging.getLogger("poise.live")

_MOST_TOLD = 100  # names and reasons of one source that are told one by one


class Feeding:
    """A hub's sources."""

    def __init__(self, hub: Hub, sources: Sequence[Source]) -> None:
        self.hub, self.sources = hub, sources
        self.refused = 0
        """packets that no device could take"""
        self.ended: dict[Source, str] = {}
        """sources that give nothing any more, each with what went wrong, if anything"""
        self._said: dict[str, object] = {}
        self._told: dict[Source, set[tuple[str, str]]] = {}

    async def feed(self, source: Source) -> None:
        """A source's packets to the hub; what goes wrong with it is an event, and other devices go on."""
        if hasattr(source, "tell"):
            source.tell = lambda text: self.hub.event("source", None, text)
        timebase = source.name if getattr(source, "one_clock", False) else ""
        waits = getattr(source, "can_wait", False)
        try:
            async for arrival in source.arrivals():
                device = self.hub.devices.get(arrival.device)
                try:
                    device = self.hub.device(arrival.device, source.name, source.shape)
                    device.timebase = timebase
                    now = time.monotonic()
                    if waits or device.allowance.grants(len(arrival.rows), now, self.hub.max_rate):
                        device.receive(arrival.rows, now, arrival.sequence)
                    else:
                        self._throttle(device, len(arrival.rows))
                except PoiseError as problem:
                    self._refused(device, source, arrival.device, problem)
                while waits and device is not None and not device.runs:
                    await asyncio.sleep(0.02)  # for the method to be loaded
            self.ended[source] = ""
            self.hub.event("end", None, f"{source.name} has come to its end")
        except (PoiseError, OSError) as problem:
            self.ended[source] = str(problem)
            self.hub.event("failed", None, f"{source.name}: {problem}")
        except Exception as problem:  # a fault of ours in one source: the others go on
            LOGGER.exception("%s failed", source.name)
            self.ended[source] = f"{type(problem).__name__}: {problem}"
            self.hub.event("failed", None, f"{source.name}: {self.ended[source]}")

    def conditions(self) -> list[dict[str, Any]]:
        """How the sources fare: *ok*, *ended*, *waiting* for one that is away, or *failed* for good, and why."""
        found = []
        for source in self.sources:
            text = self.ended.get(source, getattr(source, "trouble", ""))
            state = ("failed" if text else "ended") if source in self.ended else "waiting" if text else "ok"
            found.append({"name": source.name, "state": state, "text": text})
        return found

    def look(self) -> None:
        """Says what is amiss with a source that goes on: nothing else would tell why no device appears."""
        for source in self.sources:
            trouble, unread = getattr(source, "trouble", ""), getattr(source, "rejected", 0)
            if trouble != self._said.get(source.name, ""):
                self._said[source.name] = trouble
                self.hub.event("source", None, f"{source.name}: {trouble or 'it is there again'}")
            if unread and unread // 1000 != self._said.get(f"{source.name} unread"):
                self._said[f"{source.name} unread"] = unread // 1000
                what = f"{unread} lines or frames so far could not be read"
                self.hub.event("source", None, f"{source.name}: {what}; `--describe` says what a device sends")

    def _throttle(self, device: Device, samples: int) -> None:
        """Counts what was too much of a source that cannot be cut off; says so at the first and then every 100 000th."""
        before, device.health.throttled = device.health.throttled, device.health.throttled + samples
        if not before or before // 100_000 != device.health.throttled // 100_000:
            text = f"more than {self.hub.max_rate:g} samples a second are not taken; `--max-rate` allows more"
            self.hub.event("throttled", device, f"{device.name}: {text}")

    def _refused(self, device: Device | None, source: Source, name: str, problem: PoiseError) -> None:
        """Counts what a device should not have sent; says so once a name and reason, and then every thousandth time.

        Names and reasons can be made up: of one source so many are told one by one.
        """
        self.refused += 1
        if device is not None:
            device.health.rejected += 1
        told, what = self._told.setdefault(source, set()), (name, str(problem))
        new = what not in told and len(told) < _MOST_TOLD
        if new:
            told.add(what)
        if new or self.refused % 1000 == 1:
            self.hub.event("refused", device, f"{device.name if device else source.name}: {problem}")
