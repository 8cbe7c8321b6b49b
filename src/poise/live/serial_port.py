"""Devices at a serial port; the only module that imports pyserial."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import AsyncIterator, Callable
from contextlib import suppress
from pathlib import Path

from poise.live.described import Decoder, Description
from poise.live.devices import Arrival, DeviceError, Shape

_RETRY = 0.25  # s
_CHUNK = 65536
_PATIENCE = 0.02  # s that a read waits for more: chunks, not lines


class SerialPort:
    """Reads *port* in chunks, at the baud rate of *description*; a port that disappears is waited for."""

    shape: Shape = "board"

    def __init__(self, port: str, description: Description | None = None) -> None:
        self.port, self._description = port, description or Description()
        self.name = f"serial:{port}"
        if self._description.layout and not self._description.sync:
            raise DeviceError(f"{self.name}: the description has no sync, by which frames at a port are told apart")
        self._decoder = Decoder(description)
        self._device = self._description.device or Path(port).name

    @property
    def rejected(self) -> int:
        """Lines or frames that could not be read."""
        return self._decoder.rejected

    async def arrivals(self) -> AsyncIterator[Arrival]:
        loop = asyncio.get_running_loop()
        chunks: asyncio.Queue[bytes | DeviceError] = asyncio.Queue()
        ended = threading.Event()

        def give(found: bytes | DeviceError) -> None:
            with suppress(RuntimeError):  # the loop is closed
                loop.call_soon_threadsafe(chunks.put_nowait, found)

        thread = threading.Thread(target=self._read, args=(give, ended), daemon=True)
        thread.start()
        try:
            while True:
                found = await chunks.get()
                if isinstance(found, DeviceError):
                    raise found
                rows = self._decoder.feed(found)
                if len(rows):
                    yield Arrival(self._device, rows)
        finally:
            ended.set()

    def _read(self, give: Callable[[bytes | DeviceError], None], ended: threading.Event) -> None:
        import serial

        while not ended.is_set():
            try:
                with serial.Serial(self.port, self._description.baud, timeout=0.1, exclusive=True) as opened:
                    while not ended.is_set():
                        first = opened.read(1)
                        if first:
                            time.sleep(_PATIENCE / 4)
                            give(first + opened.read(min(opened.in_waiting, _CHUNK)))
            except PermissionError:
                return give(DeviceError(f"{self.name}: not allowed; add yourself to the port's group (dialout)"))
            except (serial.SerialException, OSError, TypeError) as problem:  # TypeError: its file vanished amid a read
                if "Permission" in str(problem):
                    return give(DeviceError(f"{self.name}: not allowed; add yourself to the port's group (dialout)"))
                if "exclusively lock" in str(problem):
                    return give(DeviceError(f"{self.name}: another program has it open"))
                ended.wait(_RETRY)
        return None
