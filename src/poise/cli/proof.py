"""What is said of headings that iron on the sensor may turn: for a file as a whole, in a memory that does not grow."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude
from poise.data.flags import ANOTHER_FIELD, HARD_IRON, HEADING_UNPROVEN
from poise.data.recording import Recording

_TOLD = 3  # events whose times are told one by one
_EVENTS = (HARD_IRON, ANOTHER_FIELD)


class HeadingProof:
    """Counts the rows whose heading is unproven, and where iron or another field set it anew, as the rows pass."""

    def __init__(self) -> None:
        self._rows = np.zeros(3, np.int64)  # all, unproven ones, whether the last is
        self._found = np.zeros(len(_EVENTS), np.int64)
        self._times = np.full((len(_EVENTS), _TOLD), np.nan)  # s, of the first of each

    def add(self, recording: Recording, attitude: Attitude) -> None:
        """The next rows."""
        if not len(attitude):
            return
        unproven = (attitude.flags & np.uint32(HEADING_UNPROVEN)) != 0
        for i, event in enumerate(_EVENTS):
            found, told = attitude.time[(attitude.flags & np.uint32(event)) != 0], int(self._found[i])
            kept = found[: max(_TOLD - told, 0)]
            self._times[i, told : told + len(kept)] = kept
            self._found[i] += len(found)
        self._rows += np.array([len(attitude), np.count_nonzero(unproven), 0])
        self._rows[2] = unproven[-1]

    @property
    def unproven(self) -> float:
        """Share of the rows; 0 without any."""
        return float(self._rows[1] / max(self._rows[0], 1))

    def notes(self, offline: bool) -> list[str]:
        """What a user is told: of a heading that was never proven, and of what set it anew."""
        before = (
            ""
            if offline
            else ": the heading before may be far off, and jumps; --offline knows it from the first row on"
        )
        said = []
        if at := self._told(0):
            said.append(
                f"a hard iron on the sensor was found at {at} s and is taken off from there on{before}; --learned tells it"
            )
        if at := self._told(1):
            said.append(
                f"the heading was set beside something that turned the field, and set anew at {at} s by the field that the "
                f"sensor has turned in since{before}"
            )
        if self._rows[2]:
            said.append(
                f"the heading is not proven ({self.unproven:.0%} of the rows, to the end): the sensor was not turned enough to "
                "rule out iron on it, or beside it at the start, that would turn it; turn the device about all axes once, "
                "away from iron, in the recording or, as it is mounted, in one that you keep with --save-learned for "
                "--start-from"
            )
        return said

    def _told(self, event: int) -> str:
        found = int(self._found[event])
        return ", ".join(f"{time:.2f}" for time in self._times[event, :found]) + (", …" if found > _TOLD else "")

    def state(self) -> dict[str, NDArray[Any]]:
        """What :meth:`restore` needs to go on."""
        return {"rows": self._rows.copy(), "found": self._found.copy(), "times": self._times.copy()}

    def restore(self, state: dict[str, NDArray[Any]]) -> None:
        """Go on where :meth:`state` was taken."""
        self._rows, self._found, self._times = (state[name].copy() for name in ("rows", "found", "times"))
