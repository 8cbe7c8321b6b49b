"""The sources by the words of the command line."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import count
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING

from poise.live.devices import DeviceError, Source

if TYPE_CHECKING:
    from poise.data.recording import Recording
    from poise.live.described import Description

WORDS = "ws, phone, replay:FILE[@SPEED], sim:WORLD[@SPEED], udp:[HOST]:PORT, serial:PORT, mqtt://HOST[:PORT]/[TOPIC], ble:NAME"


def source(word: str, read: Callable[[Path], Recording], description: Description | None = None) -> Source | None:
    """The source that *word* names; None for ``ws`` and ``phone``, devices that connect by themselves.

    *description* is what the bytes of a serial port, datagrams and messages mean. Raises :class:`DeviceError` for a word that
    names none.
    """
    kind, _, rest = word.partition(":")
    if word in ("ws", "phone"):
        return None
    if kind == "replay" and rest:
        from poise.live.replay import Replay

        file, speed = _speed(rest)
        return Replay(read(Path(file)), speed=speed)
    if kind == "sim" and rest:
        from poise.live.simulated import Simulated

        world, speed = _speed(rest)
        return Simulated.of(world, speed)
    if kind == "udp":
        from poise.live.udp import Udp

        host, _, port = rest.rpartition(":")
        if not port.isdecimal() or not 0 <= int(port) <= 65535:
            raise DeviceError(f"{word}: expected udp:[HOST]:PORT, udp::9000 for all addresses of this machine")
        return Udp(host.strip("[]"), int(port), description)
    if kind == "serial" and rest:
        from poise.live.serial_port import SerialPort

        return SerialPort(rest, description)
    if kind == "ble" and rest:
        from poise.live.ble import Ble

        return Ble(rest, description)
    if kind in ("mqtt", "mqtts"):
        from poise.live.mqtt import Mqtt

        return Mqtt(word, description)
    raise DeviceError(f"{word!r} is no source; expected one of {WORDS}")


def apart(sources: list[Source]) -> list[Source]:
    """*sources*, where no two of them would send as one device: replays of one name are numbered.

    Raises :class:`DeviceError` for simulated devices of one name, or of a name that cannot be.
    """
    from poise.live.hub import HubError, check_name
    from poise.live.replay import Replay

    taken: set[str] = set()
    for each in sources:
        names: tuple[str, ...] = getattr(each, "devices", ())
        try:
            for name in names:
                check_name("device", name)
        except HubError as problem:
            raise DeviceError(f"{each.name}: {problem}") from None
        if both := taken.intersection(names):
            raise DeviceError(f"{min(both)}: two sources send as this device; give one a name: sim:WORLD?name=NAME")
        taken.update(names)
    for each in sources:
        if isinstance(each, Replay):
            each.device = next(name for name in _numbered(each.device) if name not in taken)
            taken.add(each.device)
    return sources


def _numbered(name: str) -> Iterator[str]:
    yield name
    for number in count(2):
        yield f"{name[: 63 - len(str(number))]}-{number}"


def _speed(text: str) -> tuple[str, float]:
    found = re.fullmatch(r"(.+)@([\d.]+x?|max)", text)
    if found is None:
        return text, 1.0
    if found[2] == "max":
        return found[1], inf
    try:
        speed = float(found[2].rstrip("x"))
    except ValueError:
        speed = 0.0
    if not 0.01 <= speed <= 1e6:
        raise DeviceError(f"@{found[2]}: expected a speed from 0.01 to 1e6, or max")
    return found[1], speed
