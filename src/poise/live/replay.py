"""A recording as a device: its samples at the pace of their stamps, or faster."""

from __future__ import annotations

import asyncio
import re
from collections.abc import AsyncIterator
from pathlib import Path

import numpy as np

from poise.data.recording import Recording
from poise.estimators.loop import ROW_COLUMNS
from poise.live.devices import Arrival, Shape

_STEP = 0.01  # s between deliveries
_MOST = 4096  # samples at a time, at any speed
_LONGEST_GAP = 2.0  # s that a gap in the stamps is waited for


class Replay:
    """Plays *recording* as the device *device*; *speed* 1 is real time, ``inf`` as fast as it can be taken."""

    shape: Shape = "board"
    can_wait = True

    def __init__(self, recording: Recording, device: str = "", speed: float = 1.0, loop: bool = False) -> None:
        name = re.sub(r"[^\w.:-]", "-", recording.name or "replay").lstrip(".")[:64]
        self.device = device or name.encode()[:160].decode("utf-8", "ignore").removesuffix(".attitude") or "replay"
        self.name = f"replay of {Path(recording.source).name or recording.name or 'a recording'}"
        self._speed, self._loop = speed, loop
        self._rows = np.column_stack([getattr(recording, column) for column in ROW_COLUMNS])
        steps = np.diff(recording.time, prepend=recording.time[:1])
        steps = np.clip(np.nan_to_num(steps, nan=0.0), 0.0, _LONGEST_GAP)
        self._due = np.cumsum(steps)
        self._step = float(np.median(steps[1:])) if len(steps) > 1 else _STEP

    async def arrivals(self) -> AsyncIterator[Arrival]:
        clock = asyncio.get_running_loop().time
        turn = 0
        while turn == 0 or self._loop:
            rows = self._rows.copy()
            if turn:  # the device's clock goes on
                rows[:, 0] += turn * (self._rows[-1, 0] - self._rows[0, 0] + self._step)
            began, done = clock(), 0
            while done < len(rows):
                due = int(np.searchsorted(self._due, (clock() - began) * self._speed, side="right"))
                due = min(max(due, done), done + _MOST)
                if due > done:
                    yield Arrival(self.device, rows[done:due])
                    done = due
                await asyncio.sleep(_STEP if self._speed < 1e6 else 0.001)
            turn += 1
