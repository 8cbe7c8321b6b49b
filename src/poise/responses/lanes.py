"""Every responder on a lane of its own: a slow one delays nobody, and one that hangs is given up."""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from poise.data.event import TipState
from poise.errors import ResponseError
from poise.responses.alarm import Alarm
from poise.responses.responder import Responder

_GRACE = 1.0  # s that a responder has to keep its own time
_MOST = 64  # alarms that wait for one responder
_GRAVITY = (
    TipState.UPRIGHT,
    TipState.RIGHTED,
    TipState.PICKED_UP,
    TipState.LEANING,
    TipState.UNKNOWN,
    TipState.FREE_FALL,
    TipState.TIPPING,
    TipState.FALLEN,
)


@dataclass(frozen=True)
class Job:
    """An alarm for a responder, and who is tried if it fails."""

    alarm: Alarm
    then: tuple[str, ...] = ()
    tried: frozenset[str] = frozenset()
    allowed: Callable[[], bool] = lambda: True
    """asked at the last moment: a release that an alarm has overtaken must not happen"""
    behind: Callable[[], None] = lambda: None
    """goes on with what stands behind this job, should it hang in the thread that judged"""


Done = Callable[["Lane", Job, str | None], None]


class Lane:
    """A responder and what it still has to do; *done* hears how each job ended, None or why it failed."""

    def __init__(self, responder: Responder, done: Done) -> None:
        self.responder, self.failing = responder, False
        self._done = done
        self._pending: deque[Job] = deque()
        self._changed = threading.Condition()
        self._one = threading.Lock()
        self._running: Job | None = None
        self._deadline = math.inf
        self._given_up = False
        self._closed = False
        self._thread = threading.Thread(target=self._run, name=f"poise {responder.name}", daemon=True)

    def start(self) -> None:
        if not self.responder.immediate:
            self._thread.start()

    def submit(self, job: Job) -> None:
        """Do it now where the responder is immediate, else as soon as it is free."""
        if self.responder.immediate:
            self._at_once(job)
            return
        refused: list[tuple[Job, str]] = []
        with self._changed:
            if self._given_up:
                refused.append((job, "hangs since an alarm before"))
            elif job.alarm.count == 1 or not self._waits(job):  # a repetition of what is not yet said is nothing new
                self._pending.append(job)
                if len(self._pending) > _MOST:
                    refused.append((self._pending.popleft(), f"{_MOST} alarms were waiting for it"))
                self._changed.notify()
            running = self._running
        for late, why in refused:
            self._done(self, late, why)
        if running is not None and _graver(job.alarm, running.alarm):
            self.responder.interrupt()

    def overdue(self, now: float) -> Job | None:
        """The job that has hung beyond its time, once; its lane takes nothing more until it comes back."""
        with self._changed:
            if self._running is None or self._given_up or now < self._deadline:
                return None
            self._given_up = True
            return self._running

    def left_waiting(self) -> list[Job]:
        """Take what waits behind a job that hangs."""
        with self._changed:
            jobs, self._pending = list(self._pending), deque()
            return jobs

    def busy(self) -> bool:
        with self._changed:
            return not self._given_up and (self._running is not None or bool(self._pending))

    def close(self, timeout: float) -> None:
        with self._changed:
            self._closed = True
            self._changed.notify()
        if self._thread.is_alive():
            self._thread.join(0.0 if self._given_up else timeout)
            if self._thread.is_alive():
                self.responder.interrupt()
        if not self.responder.immediate or self._one.acquire(timeout=timeout):
            self.responder.close()

    def _at_once(self, job: Job) -> None:
        if self._given_up or not self._one.acquire(timeout=self.responder.timeout):
            self._done(self, job, "hangs since an alarm before")
            return
        try:
            self._do(job)
        finally:
            self._one.release()

    def _run(self) -> None:
        while True:
            with self._changed:
                while not self._pending and not self._closed:
                    self._changed.wait()
                if not self._pending:
                    return
                job = self._pending.popleft()
                self._begin(job, _GRACE)
            self._do(job)

    def _do(self, job: Job) -> None:
        if self._running is not job:
            self._begin(job, 0.0)
        problem: str | None = None
        try:
            if job.allowed():
                self.responder.fire(job.alarm)
        except ResponseError as error:
            problem = str(error)
        except Exception as error:  # a responder's own fault must not be the end of the others
            problem = f"{type(error).__name__}: {error}"
        with self._changed:
            late, self._given_up = self._given_up, False
            self._running, self._deadline = None, math.inf
        if not late:  # else it was told as hanging, and the next was tried
            self._done(self, job, problem)

    def _begin(self, job: Job, grace: float) -> None:
        self._running, self._deadline = job, time.monotonic() + self.responder.timeout + grace

    def _waits(self, job: Job) -> bool:
        waiting = [*self._pending, *([self._running] if self._running else [])]
        return any((each.alarm.stage, each.alarm.kind) == (job.alarm.stage, job.alarm.kind) for each in waiting)


def _graver(new: Alarm, old: Alarm) -> bool:
    if new.kind != "fired" or new.count > 1:
        return False
    return old.kind != "fired" or _GRAVITY.index(new.event.state) > _GRAVITY.index(old.event.state)
