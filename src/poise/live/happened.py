"""What happened of late: a device that has much to tell leaves the others their share, and alarms theirs."""

from __future__ import annotations

from typing import Any

Event = dict[str, Any]
ALARM = "tip"  # the kind of what a tip-over monitor tells


def shared(events: list[Event], most: int) -> list[Event]:
    """*most* of *events* at most, in their order: the newest of each device, as many of each as there is room for.

    Alarms have half of the room, or what the others leave. Where there are more devices than room, the newest of all.
    """
    alarms, others = ([event for event in events if (event["kind"] == ALARM) == alarm] for alarm in (True, False))
    kept = _evenly(alarms, max(most // 2, most - len(others)))
    return sorted(kept + _evenly(others, most - len(kept)), key=_number)


def _evenly(events: list[Event], most: int) -> list[Event]:
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
    if share == 0 and most > 0:
        return sorted((own[-1] for own in of.values()), key=_number)[-most:]
    return [event for own in of.values() for event in own[max(len(own) - share, 0) :]]


def _number(event: Event) -> int:
    return int(event["number"])


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
