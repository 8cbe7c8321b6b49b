"""Devices behind an MQTT broker; the only module that imports paho."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import AsyncIterator
from contextlib import suppress
from typing import Any
from urllib.parse import unquote, urlsplit

from poise.live.described import Decoder, Description
from poise.live.devices import Arrival, DeviceError, Shape
from poise.live.frames import FrameError
from poise.live.udp import joined

_TOPIC = "poise/+"
_MOST_WAITING = 100_000  # messages
_MOST_DEVICES = 10_000


class Mqtt:
    """Subscribes to ``mqtt://[user:password@]host[:port]/[topic]`` (``poise/+`` unless told).

    A device is named by the last level of its topic; a message holds what a datagram may. A broker that goes away is waited
    for. Raises :class:`DeviceError` for an address that is none.
    """

    shape: Shape = "board"

    def __init__(self, address: str, description: Description | None = None) -> None:
        try:
            parts = urlsplit(address)
            self._port = parts.port or (8883 if parts.scheme == "mqtts" else 1883)
        except ValueError as problem:
            raise DeviceError(f"{address}: {problem}") from None
        if parts.scheme not in ("mqtt", "mqtts") or not parts.hostname:
            raise DeviceError("expected mqtt://HOST[:PORT]/[TOPIC]")
        self._host, self._tls = parts.hostname, parts.scheme == "mqtts"
        self._topic = (
            unquote(parts.path.lstrip("/") + (f"#{parts.fragment}" if address.endswith("#") else "")) or _TOPIC
        )
        self._login = (unquote(parts.username), unquote(parts.password or "")) if parts.username else None
        self.name = f"mqtt://{self._host}:{self._port}/{self._topic}"  # without a password
        self._description = description
        self._decoders: dict[str, Decoder] = {}
        self.rejected = self.dropped = 0
        self.trouble = ""
        """why nothing comes, where that is known"""

    async def arrivals(self) -> AsyncIterator[Arrival]:
        from paho.mqtt.client import Client
        from paho.mqtt.enums import CallbackAPIVersion

        loop, wake = asyncio.get_running_loop(), asyncio.Event()
        waiting: deque[tuple[str, bytes]] = deque(maxlen=_MOST_WAITING)
        failure: list[str] = []

        def tell() -> None:
            with suppress(RuntimeError):  # the loop is closed
                loop.call_soon_threadsafe(wake.set)

        def connected(client: Any, data: Any, flags: Any, reason: Any, properties: Any) -> None:
            if reason.is_failure and reason.getName() in ("Bad user name or password", "Not authorized"):
                failure.append(str(reason))
                tell()
            elif reason.is_failure:
                self.trouble = f"the broker says {reason}; it is asked again"
            else:
                self.trouble = ""
                client.subscribe(self._topic)

        def failed(client: Any, data: Any) -> None:
            self.trouble = "the broker cannot be reached; it is tried again"

        def disconnected(client: Any, data: Any, flags: Any, reason: Any, properties: Any) -> None:
            if reason.is_failure:
                self.trouble = self.trouble or "the broker has gone; it is waited for"

        def arrived(client: Any, data: Any, message: Any) -> None:
            self.dropped += len(waiting) == _MOST_WAITING
            waiting.append((message.topic, message.payload))
            if not wake.is_set():
                tell()

        client = Client(CallbackAPIVersion.VERSION2)
        client.on_connect, client.on_message = connected, arrived
        client.on_connect_fail, client.on_disconnect = failed, disconnected
        client.reconnect_delay_set(1, 5)
        if self._login is not None:
            client.username_pw_set(*self._login)
        if self._tls:
            client.tls_set()
        client.connect_async(self._host, self._port)
        client.loop_start()
        try:
            while True:
                await wake.wait()
                wake.clear()
                if failure:
                    raise DeviceError(f"{self.name}: the broker refuses: {failure[0]}")
                together = [waiting.popleft() for _ in range(len(waiting))]
                for arrival in self._decoded(together):
                    yield arrival
        finally:
            client.disconnect()
            client.loop_stop()

    def _decoded(self, messages: list[tuple[str, bytes]]) -> list[Arrival]:
        found: dict[str, list[Arrival]] = {}
        for topic, payload in messages:
            name = topic.rpartition("/")[2]
            decoder = self._decoders.get(name)
            if decoder is None:
                if len(self._decoders) >= _MOST_DEVICES:
                    self.rejected += 1
                    continue
                decoder = self._decoders[name] = Decoder(self._description)
            try:
                found.setdefault(name, []).append(Arrival(name, *decoder.message(payload)))
            except FrameError:
                self.rejected += 1
        return [whole for arrivals in found.values() for whole in joined(arrivals)]
