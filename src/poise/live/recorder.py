"""The recorder: everything the hub takes and says, on the disk before it is acknowledged."""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from poise.live import journal
from poise.live.journal import Encoded
from poise.live.session import Session, SessionError

if TYPE_CHECKING:
    from poise.live.batch import Batch
    from poise.live.device import Device
    from poise.live.hub import Hub

_EVERY = 0.05  # s between writes: what arrives meanwhile is written together
_RETRY = 0.5  # s
_MOST_WAITING = 256 << 20  # bytes that wait for a disk that is full or slow
_ROTATE = 256 << 20  # bytes of a journal file
_CHECKPOINTING = 0.003  # s of a tick


class Recorder:
    """Writes to *session* in a thread of its own; :meth:`news` says what is durable.

    Where the disk is full, read-only or slow, samples wait in memory, up to 256 MiB; then the oldest are given up and
    counted as lost. Nothing is acknowledged that is not on the disk, and the hub never waits.
    """

    def __init__(self, session: Session, rotate: int = _ROTATE, most_waiting: int = _MOST_WAITING) -> None:
        self.session = session
        self._rotate, self._most_waiting = rotate, most_waiting
        self._lock, self._wake = threading.Lock(), threading.Event()
        self._queue: deque[Any] = deque()  # batches and encoded checkpoints, in order
        self._waiting_bytes = self._waiting_samples = self.lost = 0
        self._durable: dict[str, int] = {}
        self._lost_of: dict[str, int] = {}
        self._news: dict[str, int] = {}
        self._reason: str | None = None
        self._changed = False
        self._closing = False
        self._file: int | None = None
        self._good = 0
        self._unwritten: list[Encoded] = []
        self._to_checkpoint: deque[Device] = deque()
        self._full: list[int] = []  # finished journal files whose devices are not all checkpointed in a later one
        self._converting: threading.Thread | None = None
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)

    def open(self, hub: Hub) -> None:
        """From now on keeps what *hub* takes; devices go on where they were when it was closed or killed."""
        self._hub = hub
        self.session.resume(hub)
        self._durable = {name: device.next for name, device in hub.devices.items()}
        hub.on_batch.append(self._put_batch)
        hub.on_switch.append(self.checkpoint)
        self._thread.start()

    def close(self) -> None:
        """Everything is on the disk and in Parquet files when it returns."""
        self._closing = True
        self._wake.set()
        self._thread.join()
        if self._file is not None:
            os.close(self._file)
        if self._converting is not None:
            self._converting.join()
        if self._unwritten:
            raise SessionError(
                f"{self.session.folder}: {self._waiting_samples} samples could not be written: {self._reason}; "
                "make room, then `poise recover` has what was acknowledged"
            )
        self.session.finish()

    def condition(self) -> dict[str, Any]:
        """``reason`` why nothing is written, or None; ``waiting`` and ``lost`` samples; ``text`` for people."""
        reason = self._reason
        text = f"not recording: {reason}; it goes on by itself" if reason else f"recording to {self.session.folder}"
        facts = {"reason": reason, "waiting": self._waiting_samples, "lost": self.lost}
        return facts | {"folder": str(self.session.folder), "text": text}

    def news(self) -> tuple[dict[str, Any] | None, dict[str, int]] | None:
        """The condition where it changed, and for each device the number below which all is durable; None for no news."""
        self._checkpoint_some()
        if not self._news and not self._changed:
            return None
        with self._lock:
            found, self._news = self._news, {}
            changed, self._changed = self._changed, False
        return self.condition() if changed else None, found

    def durable(self, device: str) -> int:
        """The number below which all samples of *device* are on the disk, but for those that were given up."""
        return self._durable.get(device, 0)

    def lost_of(self, device: str) -> int:
        """Samples of *device* that were given up."""
        return self._lost_of.get(device, 0)

    # -- in the hub's thread --------------------------------------------------------------------------------------

    def _put_batch(self, batch: Batch) -> None:
        with self._lock:
            self._queue.append(batch)
            self._waiting_bytes += _size(batch)
            self._waiting_samples += len(batch.rows)
            if self._waiting_bytes > self._most_waiting // 2:
                self._give_up_oldest()

    def _give_up_oldest(self) -> None:
        kept: deque[Any] = deque()
        while self._waiting_bytes > self._most_waiting // 2:
            item = self._queue.popleft()
            if hasattr(item, "rows"):
                self._waiting_bytes -= _size(item)
                self._lose(journal.counted(item))
            else:  # checkpoints stay: they are few, and what follows needs them
                kept.append(item)
        self._queue.extendleft(reversed(kept))

    def _lose(self, counts: dict[str, int]) -> None:
        for device, count in counts.items():
            self.lost += count
            self._waiting_samples -= count
            self._lost_of[device] = self._lost_of.get(device, 0) + count

    def checkpoint(self, device: Device) -> None:
        """Keeps how *device* goes on from here."""
        runs = []
        for run in () if device.failed else device.runs:
            start = None
            if run.start is not None:
                start = [run.start.quat[0].tolist(), run.start.bias[0].tolist(), run.start.heading_reference]
            saved = run.stream.save().decode()
            runs.append({"name": run.choice.name, "settings": run.choice.settings, "start": start, "saved": saved})
        with self._lock:
            self._queue.append(journal.encoded_checkpoint(device.name, device.done, runs))

    def _checkpoint_some(self) -> None:
        """A few of the checkpoints that a new journal file needs: all at once would hold up the hub."""
        if not self._full:
            return
        end = time.perf_counter() + _CHECKPOINTING
        while self._to_checkpoint and time.perf_counter() < end:
            device = self._to_checkpoint.popleft()
            if device.to_restore is not None:  # it is not yet where it was
                self._to_checkpoint.append(device)
                return
            self.checkpoint(device)
        if not self._to_checkpoint:
            with self._lock:
                self._queue.append(tuple(self._full))  # once all before it is on the disk, these are free
            self._full.clear()

    # -- in its own -----------------------------------------------------------------------------------------------

    def _run(self) -> None:
        while True:
            self._wake.wait(_EVERY if self._reason is None else _RETRY)
            last = self._closing
            try:
                self._step()
            except Exception as problem:  # a fault of ours: said and tried again, for nobody else sees this thread end
                self._failed(problem)
            if last:
                return

    def _step(self) -> None:
        with self._lock:
            items, self._queue, self._waiting_bytes = list(self._queue), deque(), 0
        free: list[int] = []
        for item in items:
            if isinstance(item, Encoded):
                self._unwritten.append(item)
            elif isinstance(item, tuple):
                free += item
            else:
                self._encode(item)
        if not self._unwritten:
            return
        try:
            if self._file is None:
                self._file, self._good = self.session.new_file(), 0
            journal.append(self._file, self._unwritten)
        except OSError as problem:
            self._failed(problem)
            if free:
                with self._lock:
                    self._queue.appendleft(tuple(free))
            return
        self._written()
        if free:
            self._convert(free[-1])
        if self._good >= self._rotate and not self._full:
            self._start_next()

    def _encode(self, batch: Batch) -> None:
        try:
            self._unwritten.append(journal.encoded_batch(batch))
        except Exception as problem:  # a fault of ours, which must not cost the batches behind it
            self._failed(problem)
            with self._lock:
                self._lose(journal.counted(batch))

    def _convert(self, number: int) -> None:
        """In a thread: acknowledgements do not wait for it."""
        if self._converting is not None:
            self._converting.join()
        self._converting = threading.Thread(target=self.session.free, args=(number,), daemon=True)
        self._converting.start()

    def _written(self) -> None:
        with self._lock:
            for block in self._unwritten:
                self._good += block.size
                self._waiting_samples -= block.samples
                self._durable.update(block.ends)
                self._news.update(block.ends)
            self._unwritten.clear()
            if self._reason is not None:
                self._reason, self._changed = None, True

    def _failed(self, problem: Exception) -> None:
        """Takes back what may have been written in part; all of it is tried again in a new file."""
        if self._file is not None:
            with suppress(OSError):
                os.ftruncate(self._file, self._good)
            with suppress(OSError):
                os.close(self._file)
            self._file = None
        self.session.failed()
        with self._lock:
            reason = problem.strerror if isinstance(problem, OSError) and problem.strerror else repr(problem)
            if reason != self._reason:
                self._reason, self._changed = reason, True
            size = sum(block.size for block in self._unwritten)
            kept: list[Encoded] = []
            for block in self._unwritten:
                if size > self._most_waiting // 2 and block.samples:
                    size -= block.size
                    self._lose(block.counts)
                else:
                    kept.append(block)
            self._unwritten = kept

    def _start_next(self) -> None:
        """The journal file is full: what comes goes to the next, which needs a checkpoint of every device."""
        assert self._file is not None
        os.close(self._file)
        self._file = None
        with self._lock:
            self._full = [self.session.number]
            self._to_checkpoint = deque(list(self._hub.devices.values()))


def _size(batch: Batch) -> int:
    return batch.rows.nbytes + batch.table.nbytes
