"""A device as the hub knows it: what it has sent, what is still to be done with it, how it fares."""

from __future__ import annotations

import time
from collections import deque
from math import inf
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude
from poise.data.recording import check_unit_of_time
from poise.estimators.engine import Stream
from poise.live import frames
from poise.live.clock import DeviceClock, Standstill
from poise.live.devices import DeviceError, Shape
from poise.live.methods import Choice
from poise.monitor import Monitor

Floats = NDArray[np.float64]

State = Literal["waiting", "starting", "live", "silent", "standing", "failed"]
"""How a device fares; the page has words for each."""

_BURST = 1.0  # s of samples at the highest rate that may come at once
_SILENCE = 0.05  # s, at least; and three usual intervals between arrivals
_RATE_OVER = 2.0  # s that rates are counted over
_FAR_BACK = 4096  # samples: a number further back is a device that began to count anew
_WAITING = 100_000  # samples of one device that may wait for a method to be compiled


class Running:
    """A method at work for a device."""

    def __init__(self, choice: Choice, stream: Stream, number: int, slot: int, start: Attitude | None = None) -> None:
        self.choice, self.stream, self.number, self.slot = choice, stream, number, slot
        self.start = start
        """one row: the attitude that it was started at, if any"""
        self.invalid = 0
        """rows so far that were not to be acted on"""


class Taken(NamedTuple):
    """Samples of a device that are to be run now."""

    rows: Floats
    sequence: int
    arrived: float
    """s, monotonic, of the last packet"""
    first_arrived: float


class Allowance:
    """How many samples a device may send now: those of a second at once, over all its connections."""

    def __init__(self) -> None:
        self._left, self._filled = 0.0, -inf

    def grants(self, samples: int, now: float, most: float) -> bool:
        """Whether *samples* more stay within *most* a second; if so, they are counted."""
        left = min(self._left + (now - self._filled) * most, _BURST * most) - samples
        self._filled = now
        granted = left >= 0.0
        self._left = left if granted else left + samples
        return granted


class Health:
    """Counts of a device's samples."""

    def __init__(self) -> None:
        self.samples = self.lost = self.repeated = self.rejected = self.silences = 0
        self.throttled = 0
        """samples that were not taken since there were too many a second"""
        self.late = 0
        """packets that came more than 50 ms later than its clock says"""
        self.heard = 0.0
        """s, monotonic, of the last packet"""
        self.packets = 0
        """since the last tick that had samples of it"""
        self.silent = False
        self.silence = _SILENCE
        self._interval = self._ticked = 0.0
        self._counted: deque[tuple[float, int]] = deque()

    def ticked(self, now: float, late: bool = False) -> None:
        """A tick had samples of it; in one that comes *late* several packets may have gathered."""
        interval = (now - self._ticked) / (max(self.packets, 1) if late else 1)
        self.packets = 0
        if self._ticked and interval < 1.0:
            self._interval += (0.05 if self._interval else 1.0) * (interval - self._interval)
            self.silence = max(_SILENCE, 3.0 * self._interval)
        self._ticked = now
        if not self._counted or now - self._counted[-1][0] > 0.1:
            self._counted.append((now, self.samples))
            while now - self._counted[0][0] > _RATE_OVER:
                self._counted.popleft()

    def rate(self, now: float) -> float:
        """Samples a second of late."""
        if not self._counted or now - self.heard > _RATE_OVER:
            return 0.0
        since, before = self._counted[0]
        return (self.samples - before) / (now - since) if now - since > 0.2 else 0.0


class Device:
    """One source of samples, by its name."""

    def __init__(
        self, name: str, number: int, source: str, waiting: dict[Device, None], shape: Shape = "board"
    ) -> None:
        self.name, self.number, self.source, self.shape = name, number, source, shape
        self.runs: list[Running] = []
        self.wanted: tuple[Running | Choice, ...] = ()
        """the methods that it is to run once they are compiled; empty where it does"""
        self.clock, self.standstill = DeviceClock(), Standstill()
        self.failed = ""
        """the fault that ended its run, if any"""
        self.health = Health()
        self.allowance = Allowance()
        self.next = 0
        """the number of the next new sample"""
        self.connected = 0
        """how many connections it has now"""
        self.monitor: Monitor | None = None
        self.tip = frames.NOT_MONITORED
        self.timebase = ""
        """what its stamps count from, where other devices' stamps do, too"""
        self.to_restore: Any = None
        """a checkpoint and the samples since, of a recording that goes on"""
        self._ready: deque[Taken] = deque()  # samples before a gap in their numbers
        self._frames: list[bytes] = []  # payloads of 80 bytes a sample
        self._parts: list[Floats] = []
        self._waiting_samples = 0
        self._apart = 0
        """samples in `_ready`"""
        self._arrived = self._first_arrived = 0.0
        self._all_waiting = waiting
        self._stamps: list[float] | None = []  # until their unit is known

    def receive_frame(self, frame: bytes, now: float) -> int:
        """Takes a frame of samples; how many of them are new. Raises :class:`FrameError` for one that is malformed."""
        head = frames.head(frame)
        if self.failed:
            self._refuse()
        frames.check_stamps_in(frame, head.size)
        skip = self._number(head.sequence, head.samples)
        if skip >= head.samples:
            return 0
        if head.size == 80 and not self._parts and self._stamps is None:
            self._frames.append(frame[frames.HEADER.size + 80 * skip :])
            self._arrived_now(head.samples - skip, now)
        else:
            self._add(frames.samples(frame)[skip:], now)
        return head.samples - skip

    def receive(self, rows: Floats, now: float, sequence: int = frames.UNNUMBERED) -> int:
        """Takes (n, 12) samples, n ≥ 1, the first numbered *sequence*; how many of them are new. Raises as above."""
        if self.failed:
            self._refuse()
        frames.check_stamps(rows[:, 0].tolist())
        skip = self._number(sequence, len(rows))
        if skip < len(rows):
            self._add(rows[skip:], now)
        return max(0, len(rows) - skip)

    def _refuse(self) -> None:
        raise DeviceError(f"{self.name} is not run any more, until its methods are chosen anew: {self.failed}")

    def fail(self, why: str) -> None:
        """Its run has ended by a fault: what waits is given up, and nothing more is taken."""
        self.failed = why
        self.health.lost += self._apart + self._waiting_samples
        self._ready.clear()
        self._frames.clear()
        self._parts.clear()
        self._waiting_samples = self._apart = 0
        self._all_waiting.pop(self, None)

    def begin_anew(self) -> None:
        """It is run again, by other streams: nothing that may have failed is kept."""
        self.failed, self.monitor = "", None
        self.clock, self.standstill = DeviceClock(), Standstill()

    def _add(self, rows: Floats, now: float) -> None:
        if self._stamps is not None:
            self._look_at_stamps(rows)
        if self._frames:
            self._parts.append(self._joined())
        self._parts.append(rows)
        self._arrived_now(len(rows), now)

    def _look_at_stamps(self, rows: Floats) -> None:
        """Raises :class:`RecordingError` while a device begins with stamps that are not in seconds."""
        assert self._stamps is not None
        self._stamps = [*self._stamps, *rows[:8, 0].tolist()][-16:]
        stamps = np.array(self._stamps[-8:])
        if len(stamps) >= 4:
            check_unit_of_time(stamps, even=True)
        if len(self._stamps) >= 16:
            self._stamps = None

    def _arrived_now(self, n: int, now: float) -> None:
        self.next += n
        self.health.samples += n
        self.health.packets += 1
        if not self._waiting_samples:
            self._first_arrived = now
        self._waiting_samples += n
        self._arrived = self.health.heard = now
        self._all_waiting[self] = None
        while not self.runs and (over := self._apart + self._waiting_samples - _WAITING) > 0:
            self._give_up(over)

    def _give_up(self, over: int) -> None:
        """The oldest samples, *over* of them, wait for a method no longer; more where those before a gap are fewer."""
        if self._ready:
            gone = len(self._ready.popleft().rows)
            self._apart -= gone
        else:
            if self._frames:
                self._parts.append(self._joined())
            oldest = self._parts.pop(0)
            gone = min(over, len(oldest))
            if gone < len(oldest):
                self._parts.insert(0, oldest[gone:])
            self._waiting_samples -= gone
        self.health.lost += gone

    def _number(self, sequence: int, count: int) -> int:
        """How many of *count* samples from *sequence* on are known already; a gap before them counts as lost."""
        if sequence in (frames.UNNUMBERED, self.next):
            return 0
        if sequence > self.next or self.next - sequence > _FAR_BACK + count:
            self._set_apart()
        if sequence > self.next:
            if self.health.samples or self.next:
                self.health.lost += sequence - self.next
            self.next = sequence
            return 0
        if self.next - sequence > _FAR_BACK + count:
            self.next = sequence
            return 0
        known = min(count, self.next - sequence)
        self.health.repeated += known
        return known

    def _joined(self) -> Floats:
        data = b"".join(self._frames)
        self._frames.clear()
        return frames.widened(np.frombuffer(data, "<f8").reshape(-1, 10))

    def _set_apart(self) -> None:
        """What waits is numbered without a gap: what comes now is for the next tick."""
        if self._frames or self._parts:
            self._ready.append(self._take())
            self._apart += len(self._ready[-1].rows)

    @property
    def done(self) -> int:
        """The number of the next sample to be run."""
        return self._ready[0].sequence if self._ready else self.next - self._waiting_samples

    def take(self) -> Taken:
        """The samples that wait, up to a gap in their numbers."""
        if not self._ready:
            return self._take()
        found = self._ready.popleft()
        self._apart -= len(found.rows)
        if self._ready or self._frames or self._parts:
            self._all_waiting[self] = None
        return found

    def _take(self) -> Taken:
        if self._parts:
            parts, self._parts = self._parts, []
            if self._frames:
                parts.append(self._joined())
            rows = np.concatenate(parts) if len(parts) > 1 else parts[0]
        else:
            rows = self._joined()
        self._waiting_samples = 0
        return Taken(rows, self.next - len(rows), self._arrived, self._first_arrived)

    def silent_for(self, seconds: float, now: float | None = None) -> bool:
        """Whether nothing has come for so long."""
        return (time.monotonic() if now is None else now) - self.health.heard > seconds

    def described(self) -> dict[str, Any]:
        """What pages are told about it."""
        return {
            "id": self.name,
            "number": self.number,
            "source": self.source,
            "shape": self.shape,
            "connected": self.connected > 0,
            "methods": [
                {
                    "number": run.number,
                    "name": run.choice.name,
                    "settings": run.choice.settings,
                    "heading": run.stream.heading_reference,
                }
                for run in self.runs
            ],
        }

    def condition(self, now: float | None = None) -> dict[str, Any]:
        """How it fares, for pages and for people who watch a fleet."""
        now = time.monotonic() if now is None else now
        health = self.health
        return {
            "id": self.name,
            "state": self._state(),
            "rate_hz": round(health.rate(now), 2),
            "samples": health.samples,
            "lost": health.lost,
            "repeated": health.repeated,
            "rejected": health.rejected,
            "throttled": health.throttled,
            "late": health.late,
            "silences": health.silences,
            "last_heard_s": round(now - health.heard, 3) if health.samples else None,
            "invalid": {run.choice.name: run.invalid for run in self.runs},
            "resets": {run.choice.name: run.stream.resets for run in self.runs},
            "clock_drift_ppm": round(self.clock.drift_ppm, 2),
            "clock_restarts": self.clock.restarts,
            "failed": self.failed or None,
        }

    def _state(self) -> State:
        if self.failed:
            return "failed"
        if not self.health.samples:
            return "waiting"
        if self.health.silent:
            return "silent"
        if not self.runs:
            return "starting"
        return "standing" if self.standstill.standing else "live"
