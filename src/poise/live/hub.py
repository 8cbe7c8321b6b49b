"""The hub: every device's samples in, a stream for each of its methods, attitudes out once a tick."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from poise.data.attitude import Attitude
from poise.data.flags import INVALID
from poise.errors import PoiseError
from poise.estimators.engine import Stream
from poise.live.batch import Batch, Newest, Span
from poise.live.device import Device, Running
from poise.live.devices import Shape
from poise.live.guarding import Guarding
from poise.live.happened import Happened
from poise.live.joint import Joint
from poise.live.joints import Joints
from poise.live.methods import Choice, startable, warmed
from poise.live.waits import Waits, WaitsOf
from poise.live.watching import Watch

_EVENTS = 1000
MOST_DEVICES = 10_000
_QUICKEST, _SLOWEST = 0.004, 0.01  # s between ticks: more devices are done together the busier it is
_NAME_BYTES = 160  # of the 255 that a file's name may have: a recording's have the method and an ending, too
_LATE_PACKET = 0.05  # s
_LATE_TICK = 0.02  # s beside the pause; a tick that comes later than this says nothing about devices


class HubError(PoiseError):
    """What the hub refuses: a device that is not there, one too many."""


class Hub:
    """Devices by name, each with its methods; :meth:`tick` turns what has arrived into attitudes.

    *methods* are what a new device runs, and *watch* looks whether it tips over. Everything happens in one thread: only
    compiling a method, which may take seconds, is done in another, while the device's samples wait.
    """

    def __init__(self, methods: tuple[Choice, ...], max_rate: float = 5000.0, watch: Watch | None = None) -> None:
        self.methods, self.watch = methods, watch
        self.max_rate = max_rate
        self.devices: dict[str, Device] = {}
        self.newest = Newest()
        self.joints = Joints(self.devices, self.newest)
        self._numbers = 0  # of devices and joints, none given twice
        self.happened = Happened(_EVENTS)
        self.on_batch: list[Callable[[Batch], None]] = []
        """called with every tick's samples and attitudes: the recorder, viewers of every sample"""
        self.on_event: list[Callable[[dict[str, Any]], None]] = []
        self.on_change: list[Callable[[], None]] = []
        """called when a device or its methods changed"""
        self.on_switch: list[Callable[[Device], None]] = []
        """called between two samples of a device when what it runs, or its heading, was changed"""
        self.wanting: set[Device] = set()
        """devices whose methods are to be loaded"""
        self._waiting: dict[Device, None] = {}
        self._to_restore: deque[Device] = deque()
        self._event_number = 0
        self._last_tick = 0.0
        self.waits, self.waits_of = Waits(), WaitsOf()
        self.guarding = Guarding(self)
        self.joints.on_fault.append(self._joint_failed)
        self.tick_cost = 0.0
        """s, the running mean of what a tick with samples takes"""

    def device(self, name: str, source: str = "", shape: Shape = "board") -> Device:
        """The device *name*, made at its first mention. Raises :class:`HubError` for a name that cannot be, or one too many."""
        found = self.devices.get(name)
        if found is None:
            check_name("device", name)
            if name in self.joints.all:
                raise HubError(f"device {name!r}: there is a joint of that name")
            if len(self.devices) >= MOST_DEVICES:
                raise HubError(f"device {name!r}: there are {MOST_DEVICES} already")
            found = self.devices[name] = Device(name, self._number(), source, self._waiting, shape)
            self.set_methods(found, self.methods)
            self.event("device", found, f"device {name} from {source or 'somewhere'}")
        return found

    def reshape(self, device: Device, shape: Shape) -> None:
        """*device* looks different from what was thought: it was known from a recording, or says so only now."""
        device.shape = shape
        self._changed()

    def restored(self, name: str) -> Device:
        """The device *name* of a recording that goes on; it runs nothing until :meth:`restore`."""
        found = self.devices[name] = Device(name, self._number(), "recording", self._waiting)
        self._to_restore.append(found)
        return found

    def next_to_restore(self) -> Device | None:
        """One of the devices that wait for :func:`poise.live.session.rebuilt` and :meth:`restore`; None: no more."""
        return self._to_restore.popleft() if self._to_restore else None

    def restore(self, device: Device, rebuilt: list[tuple[Choice, Attitude | None, Stream]]) -> None:
        """*device* goes on with the streams it had; where there are none, it begins with the usual methods."""
        device.to_restore = None
        for number, (choice, start, stream) in enumerate(rebuilt):
            slot = self.newest.slot(device.number, number)
            device.runs.append(Running(choice, stream, number, slot, start))
        if not rebuilt:
            self.set_methods(device, self.methods)
        self._changed()

    def _number(self) -> int:
        self._numbers += 1
        return self._numbers - 1

    def set_joint(self, name: str, segment: str, base: str) -> None:
        """From now on the joint *name* says how the device *segment* stands seen from *base*; they may come later.

        Raises :class:`HubError` or :class:`JointError` for one that cannot be.
        """
        for kind, each in (("joint", name), ("segment", segment), ("base", base)):
            check_name(kind, each)
        self.joints.check(name, segment, base)
        self.joints.add(name, self._number(), segment, base)
        self.event("joint", None, f"joint {name}: {segment} seen from {base}")
        self._changed()

    def remove_joint(self, name: str) -> None:
        """Raises :class:`JointError` where there is none."""
        self.joints.remove(name)
        self.event("joint", None, f"joint {name} is no more")
        self._changed()

    def _joint_failed(self, joint: Joint, why: str) -> None:
        self.event("failed", None, f"joint {joint.name} has failed and is no more: {why}")
        self._changed()

    @property
    def shown(self) -> list[Device | Joint]:
        """All that viewers are shown: devices and the joints between them."""
        return [*self.devices.values(), *self.joints.all.values()]

    def find(self, name: str) -> Device:
        """The device *name*; raises :class:`HubError` where there is none."""
        if name not in self.devices:
            known = ", ".join(list(self.devices)[:10]) or "none yet"
            raise HubError(f"no device {name!r}; there are: {known}")
        return self.devices[name]

    def set_methods(self, device: Device, methods: tuple[Choice, ...]) -> None:
        """From the next tick after they are compiled on, *device* runs *methods*, side by side, from where it is.

        No sample is lost or counted twice: until then it runs what it ran. Methods that it runs already go on.
        """
        kept = {} if device.failed else {run.choice: run for run in device.runs}
        device.wanted = tuple(kept.get(choice) or choice for choice in methods)
        self.wanting.add(device)
        if all(isinstance(each, Running) or warmed(each) for each in device.wanted):
            self.switch(device)

    @staticmethod
    def wanted(device: Device) -> tuple[Choice, ...]:
        """The methods that *device* will run."""
        return tuple(each.choice if isinstance(each, Running) else each for each in device.wanted)

    def switch(self, device: Device) -> None:
        """Puts the wanted methods of *device* in place, between two samples."""
        latest = next((run.stream.latest for run in device.runs if run.stream.latest is not None), None)
        if device.failed:  # what it said last is not to be built upon
            latest = None
            device.begin_anew()
        runs, taken = [], {each.number for each in device.wanted if isinstance(each, Running)}
        for each in device.wanted:
            if isinstance(each, Running):
                runs.append(each)
                continue
            number = next(n for n in range(256) if n not in taken)
            taken.add(number)
            slot = self.newest.slot(device.number, number)
            start = latest if latest is not None and startable(latest) else None
            runs.append(Running(each, each.stream(start), number, slot, start))
        for run in device.runs:
            if run not in runs:
                self.newest.drop(run.slot)
        device.runs, device.wanted = runs, ()
        self.wanting.discard(device)
        for told in self.on_switch:
            told(device)
        self._changed()

    def reset_heading(self, device: Device, forward: str = "y") -> None:
        """The direction that body axis *forward* of *device* points to now is north from now on, for all its methods."""
        latest = [run.stream.latest for run in device.runs]
        if not latest or any(each is None or not np.isfinite(each.quat[-1]).all() for each in latest):
            raise HubError(f"{device.name} has no attitude yet, so there is no heading to reset")
        for run in device.runs:
            run.stream.reset_heading(forward)
        for told in self.on_switch:
            told(device)
        self.event("heading", device, f"heading of {device.name} set: {forward} points north")

    @property
    def starting(self) -> bool:
        """Whether samples wait for a method to be loaded, or for the streams of a recording that goes on."""
        return any(not device.runs for device in self._waiting)

    @property
    def pause(self) -> float:
        """s to the next tick: ticks take a quarter of the time, or what comes in 10 ms is done together."""
        return min(max(4.0 * self.tick_cost, _QUICKEST), _SLOWEST)

    def tick(self, now: float | None = None) -> Batch | None:
        """Runs every sample that has arrived through its device's methods; *now* is the host's monotonic clock, s."""
        now = time.monotonic() if now is None else now
        late, self._last_tick = now - self._last_tick > self.pause + _LATE_TICK, now
        batch = self._advance(now, late) if self._waiting else None
        self.guarding.hush(now, late)
        return batch

    def _advance(self, now: float, late: bool) -> Batch | None:
        began = time.perf_counter()
        ready, arrived, batch = self._taken(time.time() - now)
        if batch is None:
            return None
        for span in batch.spans:
            if not span.device.failed:
                try:
                    span.run.stream.update_rows(batch.rows[span.rows], batch.table[span.out], batch.flags[span.out])
                except Exception as problem:
                    self.guarding.fail(span.device, problem)
        self.guarding.judge(batch)
        batch = self._put(batch.sound())
        if not batch.spans:
            return None
        self._note(batch, now, late)
        self.joints.advance(batch, now)
        for told in self.on_batch:
            told(batch)
        waited = now - np.array(arrived) + (time.perf_counter() - began)
        self.waits.add(float(waited.max()))
        self.waits_of.add(np.array([device.number for device in ready]), waited)
        self.tick_cost += 0.1 * (time.perf_counter() - began - self.tick_cost)
        return batch

    def _taken(self, wall: float) -> tuple[list[Device], list[float], Batch | None]:
        """The devices whose samples are to be run, since when they waited, and these; *wall*: see :class:`Batch`."""
        waiting = [device for device in self._waiting if device.runs]
        ready, arrived, parts, spans, row, out = [], [], [], [], 0, 0
        for device in waiting:
            del self._waiting[device]
        for device in waiting:
            try:
                taken, stood = device.take(), device.standstill.standing
                last = float(taken.rows[-1, 0])
                device.clock.update(last, taken.arrived)
                device.standstill.see(taken.rows[:, 0], last, taken.arrived)
                if device.standstill.standing != stood:
                    self.guarding.tell_clock(device)
            except Exception as problem:
                self.guarding.fail(device, problem)
                continue
            ready.append(device)
            arrived.append(taken.first_arrived)
            parts.append(taken.rows)
            n = len(taken.rows)
            for run in device.runs:
                spans.append(Span(device, run, taken.sequence, slice(row, row + n), slice(out, out + n)))
                out += n
            row += n
        if not parts:
            return ready, arrived, None
        rows = np.concatenate(parts) if len(parts) > 1 else parts[0]
        return ready, arrived, Batch.empty(rows, spans, out, wall)

    def _put(self, batch: Batch) -> Batch:
        """What viewers are shown from now on; where all at once cannot be, one device after the other."""
        try:
            if batch.spans:
                self.newest.put(batch)
        except Exception:
            for device in dict.fromkeys(span.device for span in batch.spans):
                try:
                    self.newest.put(batch.of(lambda each, device=device: each is device))  # type: ignore[misc]
                except Exception as problem:
                    self.guarding.fail(device, problem)
            return batch.sound()
        return batch

    def _note(self, batch: Batch, now: float, late: bool) -> None:
        """What each device's health is told of the tick."""
        bad = (batch.flags & np.uint32(INVALID)) != 0
        invalid = np.add.reduceat(bad, [span.out.start for span in batch.spans])
        for span, count in zip(batch.spans, invalid.tolist(), strict=True):
            span.run.invalid += count
            device = span.device
            if span.run is not device.runs[0]:
                continue
            device.health.late += device.clock.late > _LATE_PACKET
            if device.health.silent:
                device.health.silent = False
                self.event("back", device, f"{device.name} is back")
            device.health.ticked(now, late)

    def event(self, kind: str, device: Device | None, text: str, **facts: Any) -> None:
        """Notes that something happened and tells whoever listens."""
        self._event_number += 1
        event = {"type": "event", "number": self._event_number, "kind": kind, "time": time.time()}
        event |= {"device": device.name if device else None, "text": text, **facts}
        self.happened.add(event)
        for told in self.on_event:
            told(event)

    def _changed(self) -> None:
        for told in self.on_change:
            told()

    def conditions(self, of: Iterable[Device | Joint], now: float) -> list[dict[str, Any]]:
        """How devices and joints fare, with how long a sample waits for its attitude; that of a joint is not measured."""
        each_of = list(of)
        numbers = [each.number for each in each_of]
        both = (self.waits_of.quantiles(numbers, share) for share in (0.5, 0.99))
        found = []
        for each, middle, most in zip(each_of, *both, strict=True):
            if isinstance(each, Joint):
                waits: dict[str, float | None] = {"p50": None, "p99": None}
                found.append(each.condition(self.devices, now) | {"wait_ms": waits})
            else:
                waits = {"p50": round(1e3 * middle, 3), "p99": round(1e3 * most, 3)}
                found.append(each.condition(now) | {"wait_ms": waits})
        return found

    def latest(self, device: Device | Joint, method: str | None = None) -> Any:
        """The newest record of *device* by *method* (its first one unless told); None before the first sample."""
        if isinstance(device, Joint):
            return self.newest.records[device.slot] if self.newest.versions[device.slot] else None
        for run in device.runs:
            if method in (None, run.choice.name):
                record = self.newest.records[run.slot]
                return record if self.newest.versions[run.slot] else None
        raise HubError(
            f"{device.name} does not run {method!r}; it runs {', '.join(r.choice.name for r in device.runs)}"
        )


def check_name(kind: str, name: str) -> None:
    """Raises :class:`HubError` for a name that cannot be that of files, beside the `NAME.METHOD.attitude.parquet` of others."""
    letters = 0 < len(name) <= 64 and all(c.isalnum() or c in "-_.:" for c in name)
    if not letters or len(name.encode()) > _NAME_BYTES or name.startswith(".") or name.endswith(".attitude"):
        raise HubError(f"{kind} {name[:80]!r}: expected 1 to 64 letters, digits, - _ . or :")
