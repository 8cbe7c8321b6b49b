"""Devices that send datagrams."""

from __future__ import annotations

import asyncio
import socket
import time
from collections import deque
from collections.abc import AsyncIterator

import numpy as np

from poise.live.described import Decoder, Description
from poise.live.devices import Arrival, DeviceError, Shape
from poise.live.frames import UNNUMBERED, FrameError

_BUFFER = 8 << 20  # bytes the system keeps for us: the usual 200 KiB lost 77 % at 60 000 datagrams a second
_MOST_AT_ONCE = 1024  # datagrams
_LARGEST = 65536
_STALE = 2.0  # s after which another port may take over an address's name
_MOST_PEERS = 1000  # names can be made up: they take a tenth of the hub's places at most
_NAME = b"@"  # a datagram may begin with "@NAME\n"


class Udp:
    """Listens on *host* (all addresses where empty) and *port*; see docs/live.md for what a datagram may hold.

    A datagram without a name is of the device at its address; where several ports of one address send, of address:port.
    """

    shape: Shape = "board"

    def __init__(self, host: str, port: int, description: Description | None = None) -> None:
        self.host, self.port, self._description = host, port, description
        self.name = f"udp:{host}:{port}"
        self.rejected = 0
        self._decoders: dict[str, Decoder] = {}
        self._owner: dict[str, tuple[int, float]] = {}

    async def arrivals(self) -> AsyncIterator[Arrival]:
        try:
            where = socket.getaddrinfo(self.host or "0.0.0.0", self.port, type=socket.SOCK_DGRAM)[0]
            listening = socket.socket(where[0], socket.SOCK_DGRAM)
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _BUFFER)
            listening.setblocking(False)
            listening.bind(where[4])
        except (OSError, OverflowError) as problem:
            raise DeviceError(f"{self.name}: cannot listen there: {problem}") from None
        self.port = listening.getsockname()[1]
        loop, waiting, wake = asyncio.get_running_loop(), deque[tuple[bytes, tuple[str, int]]](), asyncio.Event()

        def drain() -> None:
            for _ in range(_MOST_AT_ONCE):
                try:
                    data, address = listening.recvfrom(_LARGEST)
                except (BlockingIOError, InterruptedError):
                    break
                waiting.append((data, address[:2]))
            wake.set()

        loop.add_reader(listening, drain)
        try:
            while True:
                await wake.wait()
                wake.clear()
                together = list(waiting)
                waiting.clear()
                for arrival in self._decoded(together):
                    yield arrival
        finally:
            loop.remove_reader(listening)
            listening.close()

    def _decoded(self, datagrams: list[tuple[bytes, tuple[str, int]]]) -> list[Arrival]:
        """One arrival a device, where their numbers allow."""
        found: dict[str, list[Arrival]] = {}
        for data, address in datagrams:
            name = self._named(address)
            if data[:1] == _NAME:
                head, _, data = data.partition(b"\n")
                name = head[1:].decode("utf-8", "replace").strip()
            decoder = self._decoders.get(name)
            if decoder is None:
                if len(self._decoders) >= _MOST_PEERS:
                    self.rejected += 1
                    continue
                decoder = Decoder(self._description)
            try:
                rows, sequence = decoder.message(data)
            except FrameError:
                self.rejected += 1
                continue
            self._decoders[name] = decoder  # only now: noise from made-up addresses takes no place
            found.setdefault(name, []).append(Arrival(name, rows, sequence))
        return [whole for arrivals in found.values() for whole in joined(arrivals)]

    def _named(self, address: tuple[str, int]) -> str:
        host, port = address
        now = time.monotonic()
        owner, heard = self._owner.get(host, (port, 0.0))
        if owner != port and now - heard < _STALE:
            return f"{host}:{port}"
        if len(self._owner) >= _MOST_PEERS:  # addresses can be made up: they are not kept for ever
            self._owner.clear()
        self._owner[host] = (port, now)
        return host


def joined(arrivals: list[Arrival]) -> list[Arrival]:
    """The same samples in as few arrivals as their numbers allow."""
    if len(arrivals) == 1:
        return arrivals
    made: list[list[Arrival]] = []
    following = -1
    for arrival in arrivals:
        if (
            made
            and arrival.sequence in (following, UNNUMBERED)
            and (following == UNNUMBERED) == (arrival.sequence == UNNUMBERED)
        ):
            made[-1].append(arrival)
        else:
            made.append([arrival])
        following = UNNUMBERED if arrival.sequence == UNNUMBERED else arrival.sequence + len(arrival.rows)
    return [Arrival(a[0].device, np.concatenate([each.rows for each in a]), a[0].sequence) for a in made]
