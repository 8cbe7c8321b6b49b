"""The two kinds of WebSocket: devices, which push samples, and viewers, which are sent attitudes."""

from __future__ import annotations

import asyncio
import json
import time
from collections import deque
from collections.abc import Callable, MutableMapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from poise.errors import PoiseError
from poise.live import frames, texts
from poise.live.hub import HubError
from poise.live.methods import Choice
from poise.live.motion import Motion, asked

if TYPE_CHECKING:
    from poise.live.access import Receive, Send
    from poise.live.server import Server

_MOST_ERRORS = 10
_CHANGES = ("methods", "reset_heading", "joint", "remove_joint", "acknowledge")  # what takes the scope `write`
_EVERY_FRAMES, _EVERY_BYTES = 512, 8 << 20  # that may wait for a viewer of every sample
_POLICY, _TRY_LATER = 1008, 1013  # close codes
_RAW_MOTION = bytes((frames.MOTION,))
_NOTE_EVERY = 0.5  # s between notes of one device


class DeviceSocket:
    """One connection of a device: ``/ws/device/NAME``."""

    def __init__(self, server: Server, name: str, send: Send, query: bytes = b"") -> None:
        self._server, self._send, self._errors = server, send, 0
        shape, axes = asked(query)
        self.device = server.hub.device(name, "websocket", shape or "board")
        if shape not in (None, self.device.shape):
            server.hub.reshape(self.device, shape)
        self._motion = Motion(self.device, axes, self._event)
        self._noted = 0.0
        self._lock = asyncio.Lock()
        self._news: dict[str, dict[str, Any]] = {}

    async def run(self, receive: Receive) -> None:
        device = self.device
        device.connected += 1
        self._server.device_sockets[self] = None
        try:
            await self.tell(type="welcome", device=device.name, number=device.number, next=device.next)
            await self._tell_recording()
            while True:
                message = await receive()
                if message["type"] != "websocket.receive":
                    return None
                now = time.monotonic()
                try:
                    data = message.get("bytes")
                    new = self._bytes(data, now) if data is not None else self._text(message["text"], now)
                except PoiseError as problem:
                    device.health.rejected += 1
                    self._errors += 1
                    await self.tell(type="error", message=str(problem))
                    if self._errors >= _MOST_ERRORS:
                        return await self._close(_POLICY, f"{_MOST_ERRORS} frames that could not be read")
                    continue
                if not device.allowance.grants(new, now, self._server.hub.max_rate):
                    return await self._too_fast()
        finally:
            device.connected -= 1
            del self._server.device_sockets[self]

    def _bytes(self, data: bytes, now: float) -> int:
        if data[1:2] != _RAW_MOTION:
            return self.device.receive_frame(data, now)
        new = self._motion.take(data, now)
        for answer in self._motion.answers(self._server.hub.newest):
            self.note(**answer)
        return new

    def _text(self, text: str, now: float) -> int:
        if (note := texts.note(text)) is not None:
            if now - self._noted > _NOTE_EVERY:
                self._noted = now
                self._event("note", f"{self.device.name}: {note}")
            return 0
        rows, sequence = texts.from_json(text)
        return self.device.receive(rows, now, sequence)

    def _event(self, kind: str, text: str) -> None:
        self._server.hub.event(kind, self.device, text)

    async def _too_fast(self) -> None:
        """The device sends faster than allowed, for longer than a burst: its connection is closed."""
        text = f"more than {self._server.hub.max_rate:g} samples a second; `--max-rate` allows more"
        self._server.hub.event("throttled", self.device, f"{self.device.name} was cut off: {text}")
        await self.tell(type="error", message=text)
        await self._close(_POLICY, text)

    async def _tell_recording(self) -> None:
        recorder = self._server.recorder
        if recorder is not None:
            name = self.device.name
            await self.tell(type="recording", **recorder.condition())
            await self.tell(type="ack", next=recorder.durable(name), lost=recorder.lost_of(name))

    def note(self, **message: Any) -> None:
        """Tells it soon; of each type only the newest waits, however slowly the device reads."""
        idle = not self._news
        self._news[message["type"]] = message
        if idle:
            self._server.spawn(self._tell_news())

    async def _tell_news(self) -> None:
        with suppress(OSError, RuntimeError):  # the connection is gone; `receive` says so, too
            while self._news:
                kind, message = next(iter(self._news.items()))
                await self.tell(**message)
                if self._news.get(kind) is message:  # else a newer one has come meanwhile
                    del self._news[kind]
        self._news.clear()

    async def tell(self, **message: Any) -> None:
        async with self._lock:
            await self._send({"type": "websocket.send", "text": json.dumps(message)})

    async def _close(self, code: int, reason: str) -> None:
        await self._send({"type": "websocket.close", "code": code, "reason": reason[:120]})


class Viewer:
    """One connection of a viewer: ``/ws/view``."""

    def __init__(self, server: Server, send: Send, scopes: frozenset[str]) -> None:
        self._server, self._send, self._may_write = server, send, "write" in scopes
        self._texts: deque[str] = deque(maxlen=500)
        self._every: deque[bytes] | None = None
        self._every_bytes = 0
        self._interval = 1.0 / 30.0
        self._wanted: frozenset[str] | None = None  # names of devices; None: all
        self._seen = 0
        self._dropped = self._told_dropped = 0
        self._wake = asyncio.Event()

    async def run(self, receive: Receive) -> None:
        server = self._server
        server.viewers[self] = None
        self.say(server.hello(self._may_write))
        self.say(server.device_list())
        self.say(server.health())
        sending = asyncio.create_task(self._push())
        try:
            while (message := await receive())["type"] == "websocket.receive":
                self._command(message.get("text") or (message.get("bytes") or b"").decode("utf-8", "replace"))
        finally:
            del server.viewers[self]
            sending.cancel()

    def say(self, message: dict[str, Any] | str) -> None:
        """Queues a text message."""
        self._texts.append(message if isinstance(message, str) else json.dumps(message))
        self._wake.set()

    # -- out ------------------------------------------------------------------------------------------------------

    async def _push(self) -> None:
        try:
            while True:
                while self._texts:
                    await self._send({"type": "websocket.send", "text": self._texts.popleft()})
                if self._every is not None:
                    await self._push_every()
                else:
                    await self._push_newest()
        except (OSError, RuntimeError):  # the connection is gone; `receive` says so, too
            return

    async def _push_every(self) -> None:
        assert self._every is not None
        if not self._every:
            self._wake.clear()
            await self._wake.wait()
        if self._every:
            frame = self._every.popleft()
            self._every_bytes -= len(frame)
            await self._send({"type": "websocket.send", "bytes": frame})
        self._tell_dropped()

    async def _push_newest(self) -> None:
        began = time.monotonic()
        newest = self._server.hub.newest
        slots = newest.after(self._seen)
        if self._wanted is not None and len(slots):
            slots = slots[np.isin(newest.records["device"][slots], self._numbers())]
        self._seen = newest.change
        if len(slots):
            number = self._server.next_frame()
            await self._send({"type": "websocket.send", "bytes": frames.attitudes(newest.records[slots], number)})
            spent = time.monotonic() - began
            if spent > 2 * self._interval:
                self._dropped += int(spent / self._interval) - 1
        self._tell_dropped()
        with_pause = self._interval - (time.monotonic() - began)
        await asyncio.sleep(max(with_pause, 0.001))

    def _tell_dropped(self) -> None:
        if self._dropped != self._told_dropped:
            self._told_dropped = self._dropped
            self.say({"type": "dropped", "frames": self._dropped})

    def _numbers(self) -> list[int]:
        hub = self._server.hub
        both = (hub.devices.get(name) or hub.joints.all.get(name) for name in self._wanted or ())
        return [each.number for each in both if each is not None]

    @property
    def wants_every(self) -> bool:
        """Whether it is to get every sample, not the newest."""
        return self._every is not None

    def put(self, records: Callable[[], NDArray[np.void]], frame: bytes) -> None:
        """One more *frame*, of every one of *records*; where too many wait, the oldest is dropped and counted."""
        if self._every is None:
            return
        if self._wanted is not None:
            found = records()
            found = found[np.isin(found["device"], self._numbers())]
            if not len(found):
                return
            frame = frames.attitudes(found, self._server.next_frame())
        self._every.append(frame)
        self._every_bytes += len(frame)
        while len(self._every) > _EVERY_FRAMES or self._every_bytes > _EVERY_BYTES:
            self._every_bytes -= len(self._every.popleft())
            self._dropped += 1
        self._wake.set()

    # -- in -------------------------------------------------------------------------------------------------------

    def _command(self, text: str) -> None:
        try:
            asked = json.loads(text)
            kind = asked.get("type") if isinstance(asked, dict) else None
            facts: dict[str, Any] = {}
            if kind == "subscribe":
                self._subscribe(asked)
            elif kind in _CHANGES:
                if not self._may_write:
                    raise HubError("this token may look, not change: a token with the scope 'write' is needed")
                facts = self._server.change(kind, asked)
            else:
                raise HubError(f"message type {kind!r}: expected subscribe, {', '.join(_CHANGES)}")
            self.say({"type": "done", "id": asked.get("id"), "what": kind, **facts})
        except (PoiseError, ValueError, TypeError, KeyError, RecursionError) as problem:
            asked = locals().get("asked")
            answer = asked.get("id") if isinstance(asked, dict) else None
            self.say({"type": "error", "id": answer, "message": str(problem)[:500]})

    def _subscribe(self, asked: dict[str, Any]) -> None:
        devices, rate = asked.get("devices"), asked.get("rate", 30)
        if devices is not None and not (isinstance(devices, list) and all(isinstance(d, str) for d in devices)):
            raise HubError("devices: expected a list of names, or null for all")
        if rate == "every":
            self._every = deque()
        elif isinstance(rate, (int, float)) and 0.1 <= rate <= 100:
            self._every, self._interval = None, 1.0 / rate
        else:
            raise HubError(f'rate: expected 0.1 to 100 frames a second, or "every", found {rate!r}')
        self._every_bytes = 0
        self._wanted = None if devices is None else frozenset(devices)
        self._seen = 0
        self._wake.set()


def choices(asked: Any) -> tuple[Choice, ...]:
    """The methods of a message: ``[{"name": …, "settings": {…}}, …]``, 1 to 8."""
    if not isinstance(asked, list) or not 1 <= len(asked) <= 8:
        raise HubError('methods: expected a list of 1 to 8 like {"name": "two-stage", "settings": {}}')
    found = []
    for each in asked:
        if not isinstance(each, dict) or not isinstance(each.get("name"), str):
            raise HubError(f'methods: expected {{"name": …, "settings": {{…}}}}, found {each!r}')
        settings = each.get("settings") or {}
        if not isinstance(settings, dict):
            raise HubError("settings: expected names and values")
        found.append(Choice.of(each["name"], settings))
    if len(set(found)) != len(found):
        raise HubError("methods: the same one twice")
    return tuple(found)


def accept(scope: MutableMapping[str, Any]) -> dict[str, Any]:
    """The message that accepts a connection, with the first subprotocol that is no token."""
    offered = [p for p in scope.get("subprotocols", ()) if not p.startswith("bearer.")]
    return {"type": "websocket.accept", "subprotocol": offered[0] if offered else None}
