"""The server: the hub's devices and attitudes over HTTP and WebSocket. docs/live.md has the protocol."""

from __future__ import annotations

import asyncio
import json
import signal
import time
from collections.abc import AsyncIterator, Callable, Iterable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from poise.data.flags import INVALID, SENTENCES, Flag
from poise.errors import PoiseError
from poise.live import frames, http
from poise.live.access import Access, Gate
from poise.live.feeding import Feeding
from poise.live.hub import Hub, HubError
from poise.live.joint import Joint
from poise.live.listening import Listening, Options
from poise.live.methods import Choice, described
from poise.live.missing import Missing
from poise.live.session import rebuilt
from poise.live.settled import Settled
from poise.live.sockets import DeviceSocket, Viewer, choices
from poise.version import __version__

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from poise.data.attitude import Attitude
    from poise.live.batch import Batch
    from poise.live.device import Device
    from poise.live.devices import Source
    from poise.live.film import Film
    from poise.live.recorder import Recorder

DASHBOARD = Path(__file__).parent / "dashboard"
PHONE = Path(__file__).parent / "phone"
_HEALTH_EVERY = 1.0  # s
_FLAGS_EVERY = 0.25  # s that a flag stays in `flags_since`, so that every viewer sees it
_HEAD_START = (
    1.5  # s to load the methods before the first device is served: beside a busy loop it takes several times as long
)
_LAST_WAIT, _RECORDED_WAIT = 2.0, 120.0  # s at the end for methods that samples wait for; to be recorded, till compiled
_LIST_EVERY = 0.2  # s between lists of devices
_PAST_EVENTS = 50  # that a viewer is told when it comes
_SLICE = 100  # devices in one message on health: thousands would hold up a tick


class Server:
    """A hub, its sources, its recorder and whoever is connected, in one event loop."""

    def __init__(
        self,
        hub: Hub,
        sources: Sequence[Source] = (),
        options: Options | None = None,
        recorder: Recorder | None = None,
        films: Sequence[Film] = (),
    ) -> None:
        self.hub, self.options, self.recorder = hub, options or Options(), recorder
        self.feeding, self.missing = Feeding(hub, sources), Missing(hub)
        self.films = tuple(films)
        """recordings for pages to play"""
        self.viewers: dict[Viewer, None] = {}
        self.device_sockets: dict[DeviceSocket, None] = {}
        self.listeners: set[asyncio.Queue[dict[str, Any]]] = set()
        self.access = Access(self.options.host, self.options.tokens, self.options.hosts)
        self.offers: list[str] = []
        """which of the pages that not every server has this one has"""
        self.app = Gate(http.application(self), self.access, http.needed)
        self.stopping = asyncio.Event()
        self.began = time.monotonic()
        self._frame = 0
        self._changed = False
        self._warming: set[Choice] = set()
        self._settled = Settled()
        self._failure: BaseException | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        hub.on_batch.append(self._to_viewers)
        hub.joints.on_rows.append(self._joint_to_viewers)
        hub.on_event.append(self._tell_event)
        hub.on_change.append(self._note_change)

    # -- running --------------------------------------------------------------------------------------------------

    async def run(self, ready: asyncio.Event | None = None) -> None:
        """Serves until :attr:`stopping` is set or the process is told to stop. Raises :class:`ServerError`."""
        from poise.live.serving import serve

        with Listening(self.options) as sockets:
            loop = asyncio.get_running_loop()
            for number in (signal.SIGINT, signal.SIGTERM):
                with suppress(NotImplementedError, RuntimeError, ValueError):
                    loop.add_signal_handler(number, self.stopping.set)
            if self.hub.watch is not None:
                self.hub.watch.open()
            if self.recorder is not None:
                self.recorder.open(self.hub)
            beginning = self.spawn(self._begin())
            await asyncio.wait((beginning,), timeout=_HEAD_START)
            fed = [self.spawn(self.feeding.feed(source)) for source in self.feeding.sources]
            self.spawn(self._ticking())
            try:
                await serve(self, sockets, ready)
            finally:
                for task in fed:
                    task.cancel()
                until = time.monotonic() + (_RECORDED_WAIT if self.recorder is not None else _LAST_WAIT)
                while self.hub.starting and self._failure is None and time.monotonic() < until:
                    await asyncio.sleep(0.02)  # their samples wait for a method to be loaded
                for task in list(self._tasks):
                    task.cancel()
                await asyncio.gather(*self._tasks, return_exceptions=True)
                while self._failure is None and self.hub.tick() is not None:
                    pass
                if self.hub.watch is not None:
                    await asyncio.to_thread(self.hub.watch.close)
                if self.recorder is not None:
                    await asyncio.to_thread(self.recorder.close)
        if self._failure is not None:
            raise self._failure

    def spawn(self, work: Any) -> asyncio.Task[None]:
        """Runs *work* beside; where it fails, which is a fault of ours, the server ends and :meth:`run` raises it."""
        task: asyncio.Task[None] = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._done)
        return task

    def _done(self, task: asyncio.Task[None]) -> None:
        self._tasks.discard(task)
        if not task.cancelled() and (failure := task.exception()) is not None:
            self._failure = failure
            self.stopping.set()

    async def _ticking(self) -> None:
        due, forget, listed = 0.0, 0.0, 0.0
        slices: list[list[Device | Joint]] = []
        headings: list[str] = []
        while True:
            self.hub.tick()
            now = time.monotonic()
            if self.hub.wanting:
                self._warm_wanted()
            if self.recorder is not None:
                self._acknowledge()
            if self._changed and now > listed:
                self._changed, listed = False, now + _LIST_EVERY
                self._say(self.device_list)
            if now > forget:
                forget = now + _FLAGS_EVERY
                self.hub.newest.forget_flags()
            if now > due:
                due, devices = now + _HEALTH_EVERY, self.hub.shown
                slices = [devices[k : k + _SLICE] for k in range(0, max(len(devices), 1), _SLICE)]
                before, headings = (
                    headings,
                    [r.stream.heading_reference for d in self.hub.devices.values() for r in d.runs],
                )
                self._changed |= headings != before  # a magnetometer has spoken: zero means something else now
                self.feeding.look()
                self.missing.look(now)
                self._settled.look(len(self.hub.devices) + len(self.device_sockets) + len(self.viewers))
            if slices:
                self._say(partial(self.health, slices.pop()))
            await asyncio.sleep(self.hub.pause)

    async def _begin(self) -> None:
        if self.hub.watch is not None:
            await asyncio.to_thread(self.hub.watch.warm)
        for choice in self.hub.methods:
            await self._warm(choice)
        self._settled.freeze()  # a compiler's many objects stay
        while (device := self.hub.next_to_restore()) is not None:
            try:
                streams = await asyncio.to_thread(rebuilt, device)
            except Exception as problem:  # whatever its checkpoint holds
                why = problem if isinstance(problem, PoiseError) else repr(problem)
                self.hub.event("refused", device, f"{device.name} begins anew: {why}")
                streams = []
            self.hub.restore(device, streams)

    def _warm_wanted(self) -> None:
        for device in self.hub.wanting:
            for each in device.wanted:
                if isinstance(each, Choice) and each not in self._warming:
                    self._warming.add(each)
                    self.spawn(self._warm(each))

    async def _warm(self, choice: Choice) -> None:
        self._warming.add(choice)
        try:
            await asyncio.to_thread(choice.warm)
            for device in list(self.hub.wanting):
                self.hub.set_methods(device, self.hub.wanted(device))
        finally:
            self._warming.discard(choice)

    # -- what is said ---------------------------------------------------------------------------------------------

    def next_frame(self) -> int:
        self._frame += 1
        return self._frame

    def _say(self, message: Callable[[], dict[str, Any]]) -> None:
        if self.viewers:
            text = json.dumps(message())
            for viewer in self.viewers:
                viewer.say(text)

    def _to_viewers(self, batch: Batch) -> None:
        self._put_records(batch.records)

    def _joint_to_viewers(self, joint: Joint, attitude: Attitude, records: NDArray[np.void]) -> None:
        self._put_records(lambda: records)

    def _put_records(self, records: Callable[[], NDArray[np.void]]) -> None:
        every = [viewer for viewer in self.viewers if viewer.wants_every]
        if every:
            frame = frames.attitudes(records(), self.next_frame())
            for viewer in every:
                viewer.put(records, frame)

    def _tell_event(self, event: dict[str, Any]) -> None:
        self._say(lambda: event)
        for queue in self.listeners:
            if queue.full():
                queue.get_nowait()
            queue.put_nowait(event)

    def _note_change(self) -> None:
        self._changed = True

    def _acknowledge(self) -> None:
        assert self.recorder is not None
        told = self.recorder.news()
        if told is None:
            return
        condition, durable = told
        for each in list(self.device_sockets):
            number = durable.get(each.device.name)
            if condition is not None:
                each.note(type="recording", **condition)
            if number is not None:
                each.note(type="ack", next=number, lost=self.recorder.lost_of(each.device.name))
        if condition is not None:
            self.hub.event("recording", None, condition["text"])

    def hello(self, may_write: bool = False) -> dict[str, Any]:
        """The first message to a viewer."""
        return {
            "type": "hello",
            "protocol": frames.VERSION,
            "server": f"poise {__version__}",
            "time": time.time(),
            "may_write": may_write,
            "methods": described(),
            "flags": {f.bit_length() - 1: [f.name, SENTENCES[f]] for f in Flag},
            "invalid_flags": INVALID,
            "offers": self.offers,
            "recording": self.recorder.condition() if self.recorder else None,
            "films": len(self.films),
            "events": self.hub.happened.newest(_PAST_EVENTS),
        }

    def device_list(self) -> dict[str, Any]:
        """All devices, for pages."""
        return {
            "type": "devices",
            "devices": [
                *(device.described() for device in self.hub.devices.values()),
                *(joint.described(self.hub.devices) for joint in self.hub.joints.all.values()),
            ],
        }

    def health(self, devices: Iterable[Device | Joint] | None = None) -> dict[str, Any]:
        """How *devices* and joints fare, all unless told."""
        hub = self.hub
        waits = self.hub.waits
        now = time.monotonic()
        return {
            "type": "health",
            "time": time.time(),
            "devices": hub.conditions(devices or hub.shown, now),
            "sources": self.feeding.conditions(),
            "alarms": [] if hub.watch is None else hub.watch.alarms(),
            "viewers": len(self.viewers),
            "wait_ms": {"p50": round(1e3 * waits.quantile(0.5), 3), "p99": round(1e3 * waits.quantile(0.99), 3)},
            "recording": self.recorder.condition() if self.recorder else None,
        }

    def change(self, kind: str, asked: dict[str, Any]) -> dict[str, Any]:
        """What someone who may write asks for: one of ``sockets._CHANGES``; what the answer says beside *done*.

        Raises :class:`PoiseError`.
        """
        if kind == "joint":
            self.hub.set_joint(*(str(asked.get(key, "")) for key in ("name", "segment", "base")))
        elif kind == "remove_joint":
            self.hub.remove_joint(str(asked.get("name")))
        elif kind == "acknowledge":
            return {"holding": self.acknowledge(str(asked.get("device")))}
        else:
            self._change_device(kind, asked)
        return {}

    def _change_device(self, kind: str, asked: dict[str, Any]) -> None:
        device = self.hub.find(str(asked.get("device")))
        if device.to_restore is not None:
            raise HubError(f"{device.name} is being brought to where its recording ends; ask again in a moment")
        if kind == "methods":
            self.hub.set_methods(device, choices(asked.get("methods")))
        else:
            forward = asked.get("forward", "y")
            if forward not in ("x", "y", "z", "-x", "-y", "-z"):
                raise HubError(f"forward: expected a body axis such as y or -x, found {forward!r}")
            self.hub.reset_heading(device, forward)

    def acknowledge(self, name: str) -> list[str]:
        """Someone has seen the alarm of the device *name*; the stages that hold even so. Raises :class:`HubError`."""
        known = {} if self.hub.watch is None else self.hub.watch.responses
        if name not in known:
            there = ", ".join(known) or "none: --respond NAME=FILE.toml"
            raise HubError(f"no device {name[:80]!r} that responses answer; there are: {there}")
        holding = known[name].acknowledge()
        still = f"; until it stands upright, there holds: {', '.join(holding)}" if holding else ""
        self.hub.event("acknowledged", self.hub.devices.get(name), f"{name}: acknowledged{still}")
        return list(holding)

    async def events(self, after: int) -> AsyncIterator[dict[str, Any]]:
        """Events numbered above *after*, those of the past first."""
        queue: asyncio.Queue[dict[str, Any]] = asyncio.Queue(1000)
        self.listeners.add(queue)
        try:
            for event in self.hub.happened.after(after):
                yield event
            while True:
                yield await queue.get()
        finally:
            self.listeners.discard(queue)
