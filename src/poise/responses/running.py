"""The responses of a robot while it runs: events in; relays, voices and messages out."""

from __future__ import annotations

import math
import os
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from types import TracebackType
from typing import Any, Self

from poise.data.event import TipEvent, TipState
from poise.errors import ResponseError
from poise.responses.alarm import Alarm, Failure, Kind, no_event, now_utc
from poise.responses.config import Config, load_config
from poise.responses.lanes import Job, Lane
from poise.responses.log import LOGGER
from poise.responses.staging import START, Staging, Step

_TICK = 0.05  # s, how late a repetition, or the news that a responder hangs, may be
_CLOSING = 5.0  # s that what is being told may take at the end
_KEPT = 1000  # failures


class Responses:
    """Answers a robot's changes of state as its configuration says; a context manager.

    ``with Responses.from_toml("robot.toml") as responses: responses.handle(event)``. Relays are driven before
    :meth:`handle` returns, everything else on a thread each. A responder that fails or hangs is answered by the ones in
    its ``if_failed``, told to all that tell somebody, and kept in :attr:`failures`; only what cannot start raises.
    """

    def __init__(self, config: Config, clock: Callable[[], float] = time.monotonic) -> None:
        self.config = config
        reporters = tuple(r.name for r in config.responders if "failure" in r.answers and r.kind != "log")
        logs = tuple(r.name for r in config.responders if r.kind == "log")
        tipping = config.unknown == "as tipping"  # then what is not known at the start is cut, too
        self._staging = Staging(
            stages=config.stages,
            unknown=config.unknown,
            unknown_after=config.unknown_after,
            warned=(*reporters, *logs),
            at_start=tuple(r.name for r in config.responders if r.fired_at_start or (tipping and r.immediate)),
        )
        self._clock, self._lock, self._order = clock, threading.RLock(), threading.Lock()
        self._lanes = {each.name: Lane(each, self._done, self._back) for each in config.responders}
        self._logs, self._reporters = logs, reporters
        self._holds: dict[str, set[str]] = {name: set() for name in self._lanes}  # the stages that hold a responder
        self._failures: deque[Failure] = deque(maxlen=_KEPT)
        self._open = False
        self._end = threading.Event()
        self._supervisor = threading.Thread(target=self._supervise, name="poise responses", daemon=True)

    @classmethod
    def from_toml(cls, path: str | os.PathLike[str]) -> Self:
        """The responses that a file asks for, not yet open; :class:`ResponseError` where it asks wrongly."""
        return cls(load_config(path))

    def open(self) -> Self:
        """Get every responder ready; :class:`ResponseError` names all that cannot be, and what to do, and none stays open."""
        problems = []
        for name, lane in self._lanes.items():
            try:
                lane.responder.open(lambda why, name=name: self._trouble(name, why))  # type: ignore[misc]
            except ResponseError as problem:
                problems.append(str(problem))
        if problems:
            for lane in self._lanes.values():
                lane.responder.close()
            raise ResponseError("; ".join(problems))
        for lane in self._lanes.values():
            lane.start()
        self._open = True
        self._begin()
        self._supervisor.start()
        self._log(self._alarm("started", no_event()))
        return self

    def _begin(self) -> None:
        """From here on the state is unknown: what is cut then is cut, and stays so until the body is first upright."""
        with self._lock:
            self._staging.begin(self._clock())
            alarm, at_start = self._alarm("fired", no_event(), stage=START), self._staging.at_start
            for name in (*at_start, *(self._logs if at_start else ())):
                self._holds[name].add(START)
        for name in at_start:
            if not self._lanes[name].responder.fired_at_start:
                self._submit(name, Job(alarm, tried=frozenset([name])))

    def close(self) -> None:
        """Tell what is still to be told, for a few seconds at most; relays go to their ``fail_safe`` level."""
        if not self._open:
            return
        self._open = False
        self._end.set()
        self._supervisor.join(_CLOSING)
        self._log(self._alarm("closed", no_event()))
        end = time.monotonic() + _CLOSING
        for lane in sorted(self._lanes.values(), key=lambda lane: not lane.responder.immediate):
            lane.close(max(end - time.monotonic(), 0.1))

    def __enter__(self) -> Self:
        return self.open()

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()

    def handle(self, event: TipEvent) -> None:
        """Answer *event*; one whose state is the one that held already is none. Never waits for a slow responder."""
        if not self._open:
            raise ResponseError("the responses are not open: use them in a with block, or call open() before")
        event = _sound(event)
        with self._in_order():
            with self._lock:
                new = event.state != self._staging.state
                jobs = self._jobs(self._staging.handle(event, self._clock()))
            self._carry_out(jobs)
            if new:
                self._log(self._alarm("event", event))

    def acknowledge(self) -> tuple[str, ...]:
        """End the repetitions, and release what has fired if the body stands; the stages that hold even so."""
        with self._in_order():
            with self._lock:
                jobs = self._jobs(self._staging.acknowledge())
                active, event = self._staging.active(), self._staging.event
            self._carry_out(jobs)
            self._log(self._alarm("acknowledged", event))
        return active

    @property
    def active(self) -> tuple[str, ...]:
        """The stages that have fired and were not released."""
        with self._lock:
            return self._staging.active()

    @property
    def unacknowledged(self) -> tuple[str, ...]:
        """Those of :attr:`active` that hold, whatever the body does, until :meth:`acknowledge`."""
        with self._lock:
            return self._staging.unacknowledged()

    @property
    def failures(self) -> tuple[Failure, ...]:
        """The last thousand failures, oldest first."""
        with self._lock:
            return tuple(self._failures)

    def wait(self, timeout: float = 10.0) -> bool:
        """Wait until everything that was decided has been told; False where it takes longer."""
        end = time.monotonic() + timeout
        while any(lane.busy() for lane in self._lanes.values()):
            if time.monotonic() > end:
                return False
            time.sleep(0.005)
        return True

    def _alarm(self, kind: Kind, event: TipEvent, **more: Any) -> Alarm:
        return Alarm(kind, event, now_utc(), robot=self.config.name, active=self._staging.active(), **more)

    @contextmanager
    def _in_order(self) -> Iterator[None]:
        """What is decided first is told first, whichever threads decide; but no relay that hangs stops them all."""
        mine = self._order.acquire(timeout=_TICK)
        try:
            yield
        finally:
            if mine:
                self._order.release()

    def _jobs(self, steps: Iterable[Step]) -> list[tuple[str, Job]]:
        """What *steps* ask of whom; called with the lock held."""
        jobs = []
        for step in steps:
            alarm = self._alarm(step.what, step.event, stage=step.stage.name, count=step.count)
            if step.what == "fired":
                for name in dict.fromkeys((*step.stage.fire, *self._logs)):
                    self._holds[name].add(step.stage.name)
                    jobs.append((name, Job(alarm, tried=frozenset([name]))))
                continue
            for name, stages in self._holds.items():
                if step.stage.name in stages:
                    stages.discard(step.stage.name)
                    jobs.append((name, Job(alarm, allowed=partial(self._may_release, name))))
        return jobs

    def _may_release(self, name: str) -> bool:
        """What acts stays as long as any stage holds it; who tells is to tell of each."""
        return not (self._lanes[name].responder.acts and self._holds[name])

    def _carry_out(self, jobs: list[tuple[str, Job]]) -> None:
        """Relays first and here, the others behind; should a relay hang, the supervisor goes on with the rest."""
        rest = deque(sorted(jobs, key=lambda each: not self._lanes[each[0]].responder.immediate))

        def go_on() -> None:
            while rest:
                try:
                    name, job = rest.popleft()
                except IndexError:  # the other thread was faster
                    return
                self._submit(name, replace(job, behind=go_on))

        go_on()

    def _submit(self, name: str, job: Job) -> None:
        lane = self._lanes[name]
        if job.alarm.kind in lane.responder.answers:
            lane.submit(job)

    def _log(self, alarm: Alarm) -> None:
        for name in self._logs:
            self._submit(name, Job(alarm, tried=frozenset([name])))

    def _done(self, lane: Lane, job: Job, problem: str | None) -> None:
        name = lane.responder.name
        if problem is not None:
            self._failed(lane, job, problem)
        elif lane.failing:
            lane.failing = False
            self._log(self._alarm("recovered", job.alarm.event, responder=name))

    def _failed(self, lane: Lane, job: Job, problem: str) -> None:
        """Keep it, try the next, tell the others."""
        name, alarm = lane.responder.name, job.alarm
        first, lane.failing = not lane.failing, True
        with self._lock:
            self._failures.append(Failure(now_utc(), name, problem, alarm))
        if alarm.kind == "failure":  # whoever told it would fail like this one: not again
            LOGGER.error("%s failed, and could not tell that %s", name, alarm.sentence())
            return
        told = replace(alarm, failures=(*alarm.failures, f"{name}: {problem}"))
        if alarm.kind == "fired":
            following = [*job.then, *(each for each in lane.responder.if_failed if each not in job.then)]
            following = [each for each in following if each not in job.tried]
            if following:
                with self._lock:
                    self._holds[following[0]].add(alarm.stage)
                tried = job.tried | {following[0]}
                self._submit(following[0], Job(told, then=tuple(following[1:]), tried=tried))
            elif lane.responder.if_failed or job.then:
                problem = f"{problem}; none of those to try in its place was left"
        self._report(name, problem, alarm, everyone=first)

    def _report(self, name: str, problem: str, alarm: Alarm, everyone: bool) -> None:
        """Tell the logs, and, the first time, everyone who tells somebody."""
        if all(getattr(self._lanes[each].responder, "file", None) for each in self._logs):
            LOGGER.error("%s failed: %s", name, problem)  # else one of the logs does
        failure = self._alarm("failure", alarm.event, stage=alarm.stage, responder=name, detail=problem)
        for other in (*self._logs, *(self._reporters if everyone else ())):
            if other != name:
                self._submit(other, Job(failure, tried=frozenset([other])))

    def _back(self, lane: Lane) -> None:
        """What was given up has ended after all; a relay may have done late what has been overtaken, and is set right."""
        name = lane.responder.name
        with self._lock:
            held, event = sorted(self._holds[name]), self._staging.event
            alarm = self._alarm("fired", event, stage=held[0] if held else "")
        if lane.responder.immediate and held:
            lane.submit(Job(alarm, tried=frozenset([name])))
        elif lane.failing:
            lane.failing = False
            self._log(self._alarm("recovered", event, responder=name))

    def _trouble(self, name: str, why: str | None) -> None:
        """What a responder tells of itself in between."""
        lane = self._lanes[name]
        event = no_event()
        if why is None:
            lane.failing = False
            self._log(self._alarm("recovered", event, responder=name))
            return
        first, lane.failing = not lane.failing, True
        with self._lock:
            self._failures.append(Failure(now_utc(), name, why))
        self._report(name, why, self._alarm("event", event), everyone=first)

    def _supervise(self) -> None:
        while not self._end.wait(self._pause()):
            try:
                if self._staging.next_due() <= self._clock():
                    with self._in_order():
                        with self._lock:
                            jobs = self._jobs(self._staging.due(self._clock()))
                        self._carry_out(jobs)
                for lane in self._lanes.values():
                    if (job := lane.overdue(time.monotonic())) is not None:
                        # not here: what is tried next may hang too
                        threading.Thread(target=self._given_up, args=(lane, job), daemon=True).start()
            except Exception:
                LOGGER.exception("responses go on after a fault of their own")

    def _pause(self) -> float:
        with self._lock:
            return min(max(self._staging.next_due() - self._clock(), 0.0), _TICK)

    def _given_up(self, lane: Lane, job: Job) -> None:
        job.behind()
        for each in (job, *lane.left_waiting()):
            self._failed(lane, each, f"did not come back within {lane.responder.timeout:g} s")


def _sound(event: TipEvent) -> TipEvent:
    """*event* as its types promise it, whatever it was made of; what is no state is unknown."""
    try:
        return TipEvent(
            time=_number(event.time),
            state=TipState(event.state),
            before=TipState(event.before),
            direction=str(event.direction or ""),
            tilt=_number(event.tilt),
            rate=_number(event.rate),
            time_to_impact=_number(event.time_to_impact),
            reason=str(event.reason or ""),
        )
    except (AttributeError, ValueError):
        return no_event(reason=f"no event that can be understood: {event!r}"[:200])


def _number(value: object) -> float:
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        return math.nan
