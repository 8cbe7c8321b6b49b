"""Simulated worlds as live devices: physics at the pace of the clock, in a thread of its own."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import suppress
from math import cos, pi, sin
from typing import TYPE_CHECKING, Any, Protocol
from urllib.parse import parse_qsl

import numpy as np

from poise.data.packet import Packet
from poise.errors import PoiseError
from poise.live.devices import Arrival, DeviceError, Shape

if TYPE_CHECKING:
    from poise.simulation.worlds import World

_SHAPES: dict[str, Shape] = {"balance": "robot", "attitude": "board", "arm": "band", "handle": "handle"}
_STEP = 0.005  # s between deliveries
_AHEAD = 16  # deliveries that wait for the hub; then the physics does
_LATE = 1.0  # s behind the clock, after which it is not caught up with
_PUSH, _STRONGEST = 8.0, 200.0  # N, the strongest push unless told, and the strongest that may be told
_LYING, _SET_UP = 3.0, 2.0  # s that a fallen robot lies, and that it is off while it is set up again


class Simulated:
    """The world *name* at *speed* times its pace, without an end: one device for each of its sensors.

    *options* are the world's own, and ``seed``, ``sensor``, ``rate``; ``name`` of the device; ``push`` (N) of balance, the
    strongest of the pushes that it is given. The same samples for the same seed, whatever the pace. Raises
    :class:`DeviceError` for a world or option that cannot be, and without MuJoCo.
    """

    one_clock = True
    """all its devices' stamps count from one instant"""

    def __init__(self, name: str, speed: float = 1.0, /, **options: Any) -> None:
        from poise.simulation import worlds

        self._world, self._speed = name, speed
        given = "&".join(
            f"{key}={value:g}" if isinstance(value, float) else f"{key}={value}" for key, value in options.items()
        )
        self.name = f"sim:{name}" + (f"?{given}" if given else "")
        prefix = options.pop("name", "")
        self._push = options.pop("push", _PUSH if name == "balance" else None)
        self._options = options
        try:
            if self._push is not None and name != "balance":
                raise DeviceError("only balance is pushed")
            if self._push is not None and not 0.0 <= self._push <= _STRONGEST:
                raise DeviceError(f"push: expected 0 to {_STRONGEST:g} N, found {self._push}")
            if name == "balance" and options.get("rate", 200.0) != 200.0:
                raise DeviceError("rate: the robot's controller takes 200 samples a second")
            world = worlds.make(name, **options)  # to know now what cannot be
        except PoiseError as problem:
            raise DeviceError(f"{self.name}: {problem}") from None
        self.shape: Shape = _SHAPES[name]
        if len(world.sensors) == 1:
            self._devices = {world.sensors[0]: prefix or name}
        else:
            self._devices = {sensor: f"{prefix}-{sensor}" if prefix else sensor for sensor in world.sensors}

    @classmethod
    def of(cls, text: str, speed: float = 1.0) -> Simulated:
        """The source of ``WORLD?OPTION=VALUE&…``."""
        name, _, given = text.partition("?")
        options: dict[str, Any] = {}
        try:
            pairs = parse_qsl(given, keep_blank_values=True, strict_parsing=bool(given))
        except ValueError:
            raise DeviceError(f"sim:{text}: expected OPTION=VALUE&OPTION=VALUE behind the question mark") from None
        for key, value in pairs:
            if key in options:
                raise DeviceError(f"sim:{text}: {key} twice")
            try:
                options[key] = value if key in ("name", "sensor") else int(value) if key == "seed" else float(value)
            except ValueError:
                raise DeviceError(f"sim:{text}: {key}: expected a number, found {value!r}") from None
            if key == "sensor":
                options[key] = value.replace(" ", "+")  # as forms write a space
        return cls(name, speed, **options)

    @property
    def devices(self) -> tuple[str, ...]:
        """The names of its devices."""
        return tuple(self._devices.values())

    async def arrivals(self) -> AsyncIterator[Arrival]:
        loop = asyncio.get_running_loop()
        deliveries: asyncio.Queue[list[Arrival] | PoiseError] = asyncio.Queue()
        ended, room = threading.Event(), threading.Semaphore(_AHEAD)

        def give(found: list[Arrival] | PoiseError) -> None:
            with suppress(RuntimeError):  # the loop is closed
                loop.call_soon_threadsafe(deliveries.put_nowait, found)

        threading.Thread(target=self._run, args=(give, ended, room), name=self.name, daemon=True).start()
        try:
            while True:
                found = await deliveries.get()
                if isinstance(found, PoiseError):
                    raise found
                for arrival in found:
                    yield arrival
                room.release()
        finally:
            ended.set()
            room.release()

    def _run(
        self,
        give: Callable[[list[Arrival] | PoiseError], None],
        ended: threading.Event,
        room: threading.Semaphore,
    ) -> None:
        try:
            scene = self._scene()
            step = _STEP * min(max(self._speed, 1.0), 20.0)
            began = time.monotonic()
            while room.acquire() and not ended.is_set():
                stop = scene.time + step
                came: dict[str, list[Packet]] = {sensor: [] for sensor in self._devices}
                since = scene.since
                while scene.time < stop - 1e-9 and scene.since == since:
                    for sensor, packets in scene.step().items():
                        came[sensor] += packets
                give(
                    [
                        Arrival(self._devices[sensor], _rows(packets, since))
                        for sensor, packets in came.items()
                        if packets
                    ]
                )
                ahead = scene.time / self._speed - (time.monotonic() - began)
                if ahead > 0.0:
                    ended.wait(ahead)
                elif ahead < -_LATE:
                    began -= ahead
        except PoiseError as problem:
            give(problem)

    def _scene(self) -> _Scene:
        from poise.simulation import worlds

        if self._push is not None:
            return _Robot(self._push, self._options)
        return _Driven(worlds.make(self._world, **self._options))


class _Scene(Protocol):
    """A world with whatever drives it."""

    since: float
    """s to add to the stamps of its samples"""

    @property
    def time(self) -> float:
        """s since the beginning."""

    def step(self) -> Mapping[str, list[Packet]]:
        """One sample further: those of each sensor that arrived."""


class _Driven:
    """A world under its own driver."""

    def __init__(self, world: World) -> None:
        self._world, self._drive, self.since = world, world.driver(), 0.0

    @property
    def time(self) -> float:
        return self._world.time

    def step(self) -> Mapping[str, list[Packet]]:
        self._world.step(self._drive(self._world))
        self._world.forget()
        return self._world.arrived


class _Robot:
    """The robot with its own estimator and controller, sent about and pushed; fallen, it is set up again.

    Meanwhile it is off: a gap in its stamps, which says of itself that the motion in it is unknown.
    """

    def __init__(self, strongest: float, options: Mapping[str, Any]) -> None:
        own = dict(options)
        own.pop("rate", None)
        self._seed, self._sensor = own.pop("seed", 0), own.pop("sensor", None)
        self._own, self._strongest, self.since, self._turn = own, strongest, 0.0, 0
        self._random = np.random.default_rng([self._seed, 17])
        self._begin()

    def _begin(self) -> None:
        from poise.loops.balancing import BalanceLoop
        from poise.loops.driving import Operator
        from poise.simulation.worlds.world import SENSOR

        seed = self._seed + self._turn
        self._loop = BalanceLoop(seed=seed, sensor=self._sensor or SENSOR, cuts=False, options=self._own)
        self._operator = Operator(seed)
        self._next = self._loop.world.options.hold + self._random.uniform(4.0, 8.0)

    @property
    def time(self) -> float:
        return self.since + self._loop.world.time

    def step(self) -> Mapping[str, list[Packet]]:
        loop = self._loop
        world = loop.world
        if world.time > world.impact + _LYING:
            self.since, self._turn = self.time + _SET_UP, self._turn + 1
            self._begin()
            return {}
        if world.impact == world.impact:  # NaN: it stands
            world.powered = False
        elif world.time >= self._next:
            force = self._random.uniform(0.25, 1.0) * self._strongest
            way = self._random.uniform(-pi, pi)
            loop.push((-force * sin(way), force * cos(way), 0.0))
            self._next += self._random.uniform(6.0, 12.0)
        loop.drive(*self._operator(loop))
        loop.step()
        for log in (loop.rows, loop.pushes, loop.events):
            log.clear()
        world.forget()
        return world.arrived


def _rows(packets: list[Packet], since: float) -> Any:
    """(n, 12) as the estimators' loop reads them."""
    rows = np.zeros((len(packets), 12))
    for row, packet in zip(rows, packets, strict=True):
        row[0], row[1:4], row[4:7], row[7:10] = packet[:4]
    rows[:, 0] += since
    return rows
