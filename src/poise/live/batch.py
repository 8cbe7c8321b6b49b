"""What one tick of the hub made of everything that had arrived, and the newest of it by device and method."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data import flags as bits
from poise.data.attitude import COLUMNS, QUAT, RATE, SIGMA, Attitude
from poise.live.frames import ATTITUDE

if TYPE_CHECKING:
    from poise.live.device import Device, Running

Floats = NDArray[np.float64]


class Span(NamedTuple):
    """The samples of one device and what one of its methods says about them."""

    device: Device
    run: Running
    sequence: int
    """of the first sample"""
    rows: slice
    out: slice


@dataclass(frozen=True, eq=False)
class Batch:
    """The samples of all devices and their attitudes, side by side in two tables."""

    spans: list[Span]
    rows: Floats
    """(m, 12) the samples"""
    table: Floats
    """(n, 16) the attitudes: as many as there are samples times methods"""
    flags: NDArray[np.uint32]
    """(n,)"""
    wall: float
    """s to add to the host's monotonic clock for seconds since 1970"""

    @classmethod
    def empty(cls, rows: Floats, spans: list[Span], n: int, wall: float) -> Batch:
        return cls(spans, rows, np.empty((n, COLUMNS)), np.empty(n, np.uint32), wall)

    def of(self, keep: Callable[[Device], bool]) -> Batch:
        """The same of some of the devices only."""
        spans = [span for span in self.spans if keep(span.device)]
        kept_rows, kept_out = np.zeros(len(self.rows), bool), np.zeros(len(self.flags), bool)
        for span in spans:
            kept_rows[span.rows], kept_out[span.out] = True, True
        row, out = (np.cumsum(kept) - kept for kept in (kept_rows, kept_out))  # of each, how many are kept before it

        def moved(where: slice, before: NDArray[np.int64]) -> slice:
            start = int(before[where.start])
            return slice(start, start + where.stop - where.start)

        spans = [span._replace(rows=moved(span.rows, row), out=moved(span.out, out)) for span in spans]
        return Batch(spans, self.rows[kept_rows], self.table[kept_out], self.flags[kept_out], self.wall)

    def sound(self) -> Batch:
        """The same without devices whose run has failed."""
        failed = any(span.device.failed for span in self.spans)
        return self.of(lambda device: not device.failed) if failed else self

    def records(self) -> NDArray[np.void]:
        """(n,) every attitude as viewers get it (:data:`poise.live.frames.ATTITUDE`)."""
        where = np.concatenate([np.arange(span.rows.start, span.rows.stop) for span in self.spans])
        lengths = [span.out.stop - span.out.start for span in self.spans]
        first = np.repeat([span.sequence - span.rows.start for span in self.spans], lengths)
        found = self._records(slice(None), where, self.spans, lengths)
        found["sequence"] = first + where
        found["flags_since"] = self.flags
        return found

    def last(self) -> NDArray[np.void]:
        """One record a span, its last."""
        where = np.array([span.rows.stop - 1 for span in self.spans])
        out = np.array([span.out.stop - 1 for span in self.spans])
        found = self._records(out, where, self.spans, [1] * len(self.spans))
        found["sequence"] = [span.sequence + span.rows.stop - span.rows.start - 1 for span in self.spans]
        found["flags_since"] = np.bitwise_or.reduceat(self.flags, [span.out.start for span in self.spans])
        return found

    def _records(self, out: Any, where: Any, spans: list[Span], lengths: list[int]) -> NDArray[np.void]:
        rows, table = self.rows[where], self.table[out]
        found = np.zeros(len(rows), ATTITUDE)
        lines = np.array([span.device.clock.line for span in spans])
        facts = np.array([(span.device.number, span.run.number) for span in spans], np.uint32)
        if len(lines) != len(rows):
            lines, facts = np.repeat(lines, lengths, axis=0), np.repeat(facts, lengths, axis=0)
        found["device"], found["method"] = facts[:, 0], facts[:, 1]
        found["flags"] = self.flags[out]
        found["time"] = rows[:, 0]
        found["host"] = lines[:, 0] + lines[:, 1] * rows[:, 0] + self.wall
        found["quat"], found["rate"], found["sigma"] = table[:, QUAT], table[:, RATE], table[:, SIGMA]
        found["gyr"], found["acc"], found["mag"] = rows[:, 1:4], rows[:, 4:7], rows[:, 7:10]
        found["valid"] = (found["flags"] & np.uint32(bits.INVALID)) == 0
        found["tip"] = np.repeat([span.device.tip for span in spans], lengths)
        return found


class Newest:
    """The newest record of every device and method, and how often each has changed: what viewers are sent."""

    def __init__(self) -> None:
        self.records = np.zeros(64, ATTITUDE)
        self.versions = np.zeros(64, np.int64)
        """the count of changes at the record's last one; 0 before the first and after its method was dropped"""
        self.since = np.zeros(64, np.uint32)
        self.change = 0
        self._free: list[int] = []
        self._used = 0

    def slot(self, device: int, method: int) -> int:
        """A place for one more method of a device."""
        slot = self._free.pop() if self._free else self._used
        self._used = max(self._used, slot + 1)
        if slot >= len(self.records):
            grown = np.zeros(2 * len(self.records), ATTITUDE)
            grown[: len(self.records)] = self.records
            self.records = grown
            self.versions = np.concatenate([self.versions, np.zeros_like(self.versions)])
        self.records[slot] = np.zeros(1, ATTITUDE)[0]
        self.records[slot]["device"], self.records[slot]["method"] = device, method
        self.versions[slot] = 0
        return slot

    def drop(self, slot: int) -> None:
        """The place is free again."""
        self.versions[slot] = 0
        self._free.append(slot)

    def put(self, batch: Batch) -> None:
        """Takes over the last record of every span."""
        slots = np.array([span.run.slot for span in batch.spans])
        last = batch.last()
        last["flags_since"] |= self.records["flags_since"][slots]
        self.records[slots] = last
        self.change += 1
        self.versions[slots] = self.change

    def put_rows(self, slot: int, records: NDArray[np.void]) -> None:
        """Takes over the last of *records*, which are all of one slot."""
        last = records[-1:].copy()
        last["flags_since"] = self.records["flags_since"][slot] | np.bitwise_or.reduce(records["flags"])
        self.records[slot] = last[0]
        self.change += 1
        self.versions[slot] = self.change

    def silence(self, slot: int, tip: int | None = None) -> None:
        """What its record says is no longer known, and *tip* is the state of its body."""
        if self.versions[slot]:
            record = self.records[slot]
            if tip is not None:
                record["tip"] = tip
            record["flags"] |= np.uint32(bits.SILENT)
            record["flags_since"] |= record["flags"]
            record["valid"] = 0
            self.change += 1
            self.versions[slot] = self.change

    def unknown(self, slot: int, row: Attitude, tip: int) -> None:
        """Its device has fallen silent: *row* is what the stream says now."""
        record = self.records[slot]
        record["flags"] = record["flags_since"] = row.flags[0]
        record["valid"], record["tip"] = bool(row.valid[0]), tip
        self.change += 1
        self.versions[slot] = self.change

    def after(self, change: int) -> NDArray[np.intp]:
        """The slots that changed after that many changes."""
        return np.flatnonzero(self.versions > change)

    def forget_flags(self) -> None:
        """From now on, ``flags_since`` counts anew: called once all viewers could have seen it."""
        self.records["flags_since"] = self.records["flags"]
