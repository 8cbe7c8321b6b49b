"""A tip-over monitor for every device, and the responses of those that have some."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees, isfinite
from typing import Any

from poise.data.attitude import Attitude
from poise.data.event import TipEvent
from poise.errors import PoiseError
from poise.monitor import Monitor, TipOver
from poise.responses import Responses


class Watch:
    """Monitors with the parameters *tipover*, or with its own where *own* has some for a device by its name, and the
    *responses* that answer what they say of a device."""

    def __init__(
        self,
        tipover: TipOver | None = None,
        own: Mapping[str, TipOver] | None = None,
        responses: Mapping[str, Responses] | None = None,
    ) -> None:
        self._tipover, self._own, self.responses = tipover, dict(own or {}), dict(responses or {})
        self._monitor(None)  # what cannot be is refused here

    def _monitor(self, device: str | None) -> Monitor:
        return Monitor(self._own.get(device or "", self._tipover))

    def monitor(self, device: str) -> Monitor:
        """A monitor for *device*."""
        return self._monitor(device)

    def warm(self) -> None:
        """Loads, or the first time compiles, the monitor."""
        self._monitor(None).update(Attitude.of([0.0], [[1.0, 0.0, 0.0, 0.0]]), [0.0, 0.0, 9.8])

    def open(self) -> None:
        """Gets all responders ready; raises :class:`ResponseError`, and none stays open, where one cannot be."""
        opened: list[Responses] = []
        try:
            for each in self.responses.values():
                opened.append(each.open())
        except PoiseError:
            for each in opened:
                each.close()
            raise

    def close(self) -> None:
        """Tells what is still to be told."""
        for each in self.responses.values():
            each.close()

    def alarms(self) -> list[dict[str, Any]]:
        """What holds of which device, and what of that waits until somebody says that it was seen.

        A device is among them that has never come: with ``unknown = "as tipping"`` that is an alarm, too.
        """
        found = [(name, each.active, each.unacknowledged) for name, each in self.responses.items()]
        return [
            {"device": name, "holding": list(holding), "unacknowledged": list(waiting)}
            for name, holding, waiting in found
            if holding
        ]

    def handle(self, device: str, event: TipEvent) -> None:
        """Answers a change of state of *device*."""
        if device in self.responses:
            self.responses[device].handle(event)


def as_facts(event: TipEvent) -> dict[str, Any]:
    """What is told of *event* beside its sentence; degrees, and null for what is not known."""
    angles = {"tilt_deg": degrees(event.tilt), "rate_deg_s": degrees(event.rate), "impact_s": event.time_to_impact}
    return {
        "state": event.state.name,
        "before": event.before.name,
        "direction": event.direction,
        "device_time": event.time,
        **{name: round(value, 3) if isfinite(value) else None for name, value in angles.items()},
    }


def as_text(device: str, event: TipEvent) -> str:
    """One line for people."""
    state = event.state.name.lower().replace("_", " ")
    return f"{device}: {state} {event.direction}".rstrip() + (f" ({event.reason})" if event.reason else "")
