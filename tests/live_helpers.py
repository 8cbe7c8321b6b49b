"""A server of `poise.live` in a thread, as tests talk to it: over real sockets."""

from __future__ import annotations

import asyncio
import json
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import httpx
import numpy as np
from numpy.typing import NDArray
from websockets.sync.client import ClientConnection, connect

import poise
from poise.live import frames
from poise.live.hub import Hub
from poise.live.listening import Options
from poise.live.methods import Choice
from poise.live.server import Server

METHOD = "adaptive-gain"  # the quickest to compile


def made(seconds: float = 4.0, rate: float = 100.0, seed: int = 0) -> poise.Recording:
    """A made forearm."""
    from poise.simulation import Sensor, forearm, measure

    return measure(forearm(seconds, rate=rate), Sensor(), seed=seed)


def rows_of(recording: poise.Recording) -> NDArray[np.float64]:
    """(n, 10) what a device sends of it."""
    return np.column_stack([recording.time, recording.gyr, recording.acc, recording.mag])


def wait_for(what: Callable[[], Any], seconds: float = 20.0) -> Any:
    """What *what* answers once that is true."""
    end = time.monotonic() + seconds
    while not (found := what()):
        assert time.monotonic() < end, "it did not happen in time"
        time.sleep(0.005)
    return found


class Running:
    """A server, its address, and clients of it."""

    def __init__(self, server: Server, loop: asyncio.AbstractEventLoop) -> None:
        self.server, self.hub, self.loop = server, server.hub, loop
        self.address = f"127.0.0.1:{server.options.port}"
        self.http = httpx.Client(base_url=f"http://{self.address}", timeout=20.0)

    @contextmanager
    def device(self, name: str, **options: Any) -> Iterator[ClientConnection]:
        with connect(f"ws://{self.address}/ws/device/{name}", max_queue=None, **options) as device:
            yield device

    @contextmanager
    def viewer(self, every: bool = False, **options: Any) -> Iterator[ClientConnection]:
        with connect(f"ws://{self.address}/ws/view", max_queue=None, **options) as viewer:
            if every:
                ask(viewer, type="subscribe", rate="every")
            yield viewer

    def call(self, function: Callable[[], Any]) -> Any:
        """What *function* returns in the server's own thread."""

        async def called() -> Any:
            return function()

        return asyncio.run_coroutine_threadsafe(called(), self.loop).result(20.0)


@contextmanager
def serving(
    *sources: Any, methods: tuple[str, ...] = (METHOD,), recorder: Any = None, **options: Any
) -> Iterator[Running]:
    """A running server, its methods compiled."""
    max_rate, watch, films = options.pop("max_rate", 5000.0), options.pop("watch", None), options.pop("films", ())
    choices = tuple(Choice.of(name) for name in methods)
    for choice in choices:
        choice.warm()
    server = Server(Hub(choices, max_rate, watch), sources, Options(**{"port": 0, **options}), recorder, films)
    loops: list[asyncio.AbstractEventLoop] = []
    up = threading.Event()
    failures: list[BaseException] = []

    async def main() -> None:
        ready = asyncio.Event()
        loops.append(asyncio.get_running_loop())
        work = asyncio.ensure_future(server.run(ready))
        await asyncio.wait([work, asyncio.ensure_future(ready.wait())], return_when=asyncio.FIRST_COMPLETED)
        up.set()
        await work

    def run() -> None:
        try:
            asyncio.run(main())
        except BaseException as problem:
            failures.append(problem)
        finally:
            up.set()

    thread = threading.Thread(target=run)
    thread.start()
    up.wait(60.0)
    if failures:
        thread.join()
        raise failures[0]
    try:
        yield Running(server, loops[0])
    finally:
        loops[0].call_soon_threadsafe(server.stopping.set)
        thread.join(30.0)
        assert not thread.is_alive()
        if failures:
            raise failures[0]


def ask(viewer: ClientConnection, **message: Any) -> dict[str, Any]:
    """The answer to *message*."""
    viewer.send(json.dumps({"id": "asked", **message}))
    while True:
        found = heard(viewer)
        if found.get("id") == "asked":
            return found


def heard(connection: ClientConnection, kind: str | None = None, seconds: float = 20.0) -> dict[str, Any]:
    """The next text message, of that kind, which must come within *seconds* whatever else does."""
    until = time.monotonic() + seconds
    while True:
        message = connection.recv(timeout=max(until - time.monotonic(), 0.0))
        if isinstance(message, str):
            found: dict[str, Any] = json.loads(message)
            if kind in (None, found["type"]):
                return found


def seen(viewer: ClientConnection, n: int, seconds: float = 20.0) -> NDArray[np.void]:
    """The next *n* records."""
    found: list[NDArray[np.void]] = []
    until = time.monotonic() + seconds
    while sum(map(len, found)) < n:
        message = viewer.recv(timeout=max(until - time.monotonic(), 0.0))
        if isinstance(message, bytes):
            found.append(frames.records(message))
    return np.concatenate(found)


def send(device: ClientConnection, rows: NDArray[np.float64], first: int = 0, size: int = 20) -> None:
    """*rows*, *size* a frame, the first of them numbered *first*."""
    for at in range(0, len(rows), size):
        device.send(frames.encoded(rows[at : at + size], first + at))
