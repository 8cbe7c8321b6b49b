"""The sources by the words of the command line."""

from __future__ import annotations

import re
from collections.abc import Callable
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING

from poise.live.devices import DeviceError, Source

if TYPE_CHECKING:
    from poise.data.recording import Recording

WORDS = "replay:FILE[@SPEED], ws"


def source(word: str, read: Callable[[Path], Recording]) -> Source | None:
    """The source that *word* names; None for ``ws``, devices that connect by themselves.

    Raises :class:`DeviceError` for a word that names none.
    """
    kind, _, rest = word.partition(":")
    if word == "ws":
        return None
    if kind == "replay" and rest:
        from poise.live.replay import Replay

        file, speed = _speed(rest)
        return Replay(read(Path(file)), speed=speed)
    raise DeviceError(f"{word!r} is no source; expected one of {WORDS}")


def _speed(text: str) -> tuple[str, float]:
    found = re.fullmatch(r"(.+)@([\d.]+x?|max)", text)
    if found is None:
        return text, 1.0
    if found[2] == "max":
        return found[1], inf
    speed = float(found[2].rstrip("x"))
    if not 0.01 <= speed <= 1e6:
        raise DeviceError(f"@{found[2]}: expected a speed from 0.01 to 1e6, or max")
    return found[1], speed
