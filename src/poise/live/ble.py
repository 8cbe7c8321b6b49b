"""Devices over Bluetooth Low Energy; the only module that imports bleak."""

from __future__ import annotations

import asyncio
import re
from collections.abc import AsyncIterator, Callable
from functools import partial
from typing import Any

from poise.live.described import Decoder, Description
from poise.live.devices import Arrival, DeviceError, Shape

_SCAN, _RETRY = 10.0, 1.0  # s


class Ble:
    """The device called *name*, or at that address; its notifications mean what *description* says.

    Out of reach, or gone, it is waited for, and connected to again. Raises :class:`DeviceError` without a description that
    names a characteristic, and without bleak.
    """

    shape: Shape = "band"

    def __init__(self, name: str, description: Description | None = None) -> None:
        try:
            import bleak  # noqa: F401
        except ImportError:
            raise DeviceError(f'ble:{name}: needs bleak, which is not installed: pip install "poise[live]"') from None
        if description is None or not description.characteristic:
            raise DeviceError(
                f"ble:{name}: --describe FILE.toml is needed, with the characteristic that notifies: "
                '[ble] characteristic = "UUID"'
            )
        self.name, self._wanted, self._description = f"ble:{name}", name, description
        self.tell: Callable[[str], None] = lambda text: None
        """called with what people should know: it is waited for, it is there"""
        self._decoder = Decoder(description)
        self._device = description.device or re.sub(r"[^\w.:-]", "-", name).lstrip(".")[:64] or "ble"
        self._said = ""

    @property
    def rejected(self) -> int:
        """Notifications, lines or frames that could not be read."""
        return self._decoder.rejected

    async def arrivals(self) -> AsyncIterator[Arrival]:
        from bleak import BleakClient, BleakScanner
        from bleak.exc import BleakError

        radio = False  # whether it ever worked: one that is pulled out is waited for
        while True:
            try:
                found = await BleakScanner.find_device_by_filter(self._is_it, timeout=_SCAN)
                radio = True
            except (BleakError, OSError) as problem:
                if not radio:
                    raise DeviceError(
                        f"{self.name}: no Bluetooth here ({problem}); is there an adapter, is it on, may you use it?"
                    ) from None
                self._say("Bluetooth is gone; it is waited for")
                await asyncio.sleep(_RETRY)
                continue
            if found is None:
                self._say(f"not in reach, or connected to something else; looked for {_SCAN:g} s, and goes on looking")
                continue
            notes: asyncio.Queue[bytes | None] = asyncio.Queue()
            try:
                async with BleakClient(found, partial(_put_end, notes)) as client:
                    self._check(client)
                    await client.start_notify(self._description.characteristic, partial(_put, notes))
                    self._say("connected")
                    while (data := await notes.get()) is not None:
                        rows = self._decoder.feed(data)
                        if len(rows):
                            yield Arrival(self._device, rows)
                self._say("the connection is gone; it is waited for")
            except (BleakError, OSError) as problem:  # TimeoutError is one
                self._say(f"cannot be connected to ({problem}); tried again")
                await asyncio.sleep(_RETRY)

    def _is_it(self, device: Any, advertised: Any) -> bool:
        return self._wanted in (device.name, advertised.local_name) or device.address.lower() == self._wanted.lower()

    def _check(self, client: Any) -> None:
        wanted = self._description.characteristic
        has = client.services.get_characteristic(wanted)
        if has is not None and {"notify", "indicate"} & set(has.properties):
            return
        able = [each.uuid for each in client.services.characteristics.values() if "notify" in each.properties]
        trouble = f"it has no characteristic {wanted}" if has is None else f"{wanted} does not notify"
        raise DeviceError(f"{self.name}: {trouble}; those that notify: {', '.join(able) or 'none'}")

    def _say(self, text: str) -> None:
        """Once, until there is something else to say."""
        if text != self._said:
            self._said = text
            self.tell(f"{self.name}: {text}")


def _put(notes: asyncio.Queue[bytes | None], sender: Any, data: bytearray) -> None:
    notes.put_nowait(bytes(data))


def _put_end(notes: asyncio.Queue[bytes | None], client: Any) -> None:
    notes.put_nowait(None)
