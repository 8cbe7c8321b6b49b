"""What is said of headings that iron on the sensor may turn: for a file as a whole, in a memory that does not grow."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude
from poise.data.flags import HARD_IRON, HEADING_UNPROVEN
from poise.data.recording import Recording

_TOLD = 3  # found irons whose times are told one by one


class HeadingProof:
    """Counts the rows whose heading is unproven, and where hard irons were found, as the rows pass."""

    def __init__(self) -> None:
        self._rows = np.zeros(4, np.int64)  # all, unproven ones, whether the last is, irons found
        self._first = np.full(_TOLD, np.nan)  # s, times of the first irons

    def add(self, recording: Recording, attitude: Attitude) -> None:
        """The next rows."""
        if not len(attitude):
            return
        unproven = (attitude.flags & np.uint32(HEADING_UNPROVEN)) != 0
        found = attitude.time[(attitude.flags & np.uint32(HARD_IRON)) != 0]
        told = int(self._rows[3])
        kept = found[: max(_TOLD - told, 0)]
        self._first[told : told + len(kept)] = kept
        self._rows += np.array([len(attitude), np.count_nonzero(unproven), 0, len(found)])
        self._rows[2] = unproven[-1]

    @property
    def unproven(self) -> float:
        """Share of the rows; 0 without any."""
        return float(self._rows[1] / max(self._rows[0], 1))

    def notes(self) -> list[str]:
        """What a user is told: of a heading that was never proven, and of irons that were found on the way."""
        said, found = [], int(self._rows[3])
        if found:
            times = ", ".join(f"{time:.2f}" for time in self._first[:found]) + (", …" if found > _TOLD else "")
            said.append(
                f"a hard iron on the sensor was found at {times} s and is taken off from there on: the heading before may be "
                "far off, and jumps; --offline knows it from the first row on, --learned tells it"
            )
        if self._rows[2]:
            said.append(
                f"the heading is not proven ({self.unproven:.0%} of the rows, to the end): the sensor was not turned enough to "
                "rule out a hard iron, which would turn it; turn the device about all axes once, in the recording or in one "
                "that you keep with --save-learned for --start-from"
            )
        return said

    def state(self) -> dict[str, NDArray[Any]]:
        """What :meth:`restore` needs to go on."""
        return {"rows": self._rows.copy(), "first": self._first.copy()}

    def restore(self, state: dict[str, NDArray[Any]]) -> None:
        """Go on where :meth:`state` was taken."""
        self._rows, self._first = state["rows"], state["first"]
