"""What happened of late: a device that has much to tell leaves the others their share."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

Event = dict[str, Any]


def shared(events: Iterable[Event], most: int) -> list[Event]:
    """*most* of *events* at most, in their order: the newest of each device, of every one as many as there is room for.

    Where there are more devices than room, the newest of all.
    """
    of: dict[str | None, list[Event]] = {}
    for event in events:
        of.setdefault(event["device"], []).append(event)
    left, share = most, 0
    counts = sorted(len(own) for own in of.values())
    for k, count in enumerate(counts):  # who has less than a share leaves the rest of it to the others
        share = left // (len(counts) - k)
        if count > share:
            break
        left, share = left - count, count
    kept = [event for own in of.values() for event in own[max(len(own) - share, 0) :]]
    kept.sort(key=lambda event: event["number"])
    return (
        kept if kept or not of else sorted((own[-1] for own in of.values()), key=lambda event: event["number"])[-most:]
    )


class Happened:
    """The events that are remembered: about *most*, shared among the devices, the oldest first."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._events: list[Event] = []

    def add(self, event: Event) -> None:
        self._events.append(event)
        if len(self._events) > 1.25 * self._most:
            self._events = shared(self._events, self._most)

    def all(self) -> list[Event]:
        return list(self._events)

    def after(self, number: int) -> list[Event]:
        """Those numbered above *number*."""
        return [event for event in self._events if event["number"] > number]

    def newest(self, most: int) -> list[Event]:
        return shared(self._events, most)
