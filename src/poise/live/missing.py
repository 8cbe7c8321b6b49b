"""Devices that were named at the start, and have not come: a name that is spelled wrongly must not stay unnoticed."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from poise.live.hub import Hub

_PATIENCE = 5.0  # s
_NAMED = 5  # devices that there are


class Missing:
    """The devices that responses and joints of *hub* wait for."""

    def __init__(self, hub: Hub) -> None:
        self._hub = hub
        self._since: dict[str, float] = {}
        self._told: set[str] = set()

    def look(self, now: float | None = None) -> None:
        """Says of each, once, that it has not come for some seconds. Once a second."""
        now = time.monotonic() if now is None else now
        wanted = self._wanted()
        self._since = {text: self._since.get(text, now) for text in wanted}
        self._told &= wanted.keys()
        for text, since in self._since.items():
            if now - since >= _PATIENCE and text not in self._told:
                self._told.add(text)
                self._hub.event("missing", None, self._sentence(text, wanted[text]))

    def reasons(self) -> list[str]:
        """What was said and is still so."""
        wanted = self._wanted()
        return [self._sentence(text, wanted[text]) for text in sorted(self._told) if text in wanted]

    def _wanted(self) -> dict[str, str]:
        """Who waits for a device, and for which."""
        hub = self._hub
        found = {f"--respond {name}": name for name in (hub.watch.responses if hub.watch is not None else ())}
        for joint in hub.joints.all.values():
            found |= {f"joint {joint.name}, {name}": name for name in (joint.segment, joint.base)}
        return {text: name for text, name in found.items() if not self._there(name)}

    def _there(self, name: str) -> bool:
        device = self._hub.devices.get(name)
        return device is not None and device.health.samples > 0

    def _sentence(self, text: str, name: str) -> str:
        if name in self._hub.devices:
            return f"{text}: this device has sent no sample so far"
        names = list(self._hub.devices)
        others = ", ".join(names[:_NAMED]) + ", …" * (len(names) > _NAMED)
        return f"{text}: no such device so far; there are: {others or 'none yet'}"
