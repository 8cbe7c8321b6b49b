"""What all worlds share: a body in MuJoCo that carries sensors, stepped by one sample of theirs at a time."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterator, Sequence
from math import ceil, nan
from time import monotonic, sleep
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.data.attitude import Attitude
from poise.data.packet import Packet
from poise.data.recording import Recording
from poise.estimators.parameters import checked
from poise.simulation.device import Device
from poise.simulation.parts import part
from poise.simulation.sensor import Sensor
from poise.simulation.worlds.physics import Physics, WorldError, model_text

Floats = NDArray[np.float64]
Driver = Callable[["World"], ArrayLike | None]

GRAVITY = 9.8124  # m/s², as in the models
SENSOR = "MPU-6050+QMC5883L"
_STEP = 0.001  # s, longest step of the physics
_SETTLING = 0.2  # s before time 0: contacts come to rest
_MOVING_RATE, _MOVING_ACCELERATION = 0.05, 0.2  # rad/s, m/s²: what is slower counts as rest


class Truth(NamedTuple):
    """How a sensor of a world really stands."""

    time: float
    """s"""
    quat: Floats
    """(4,) w x y z, body to ENU"""
    rate: Floats
    """(3,) rad/s, body"""
    impact: float
    """s, when the body first touched the ground; NaN as long as it has not"""
    state: dict[str, Any]
    """what else there is to know in this world; its class says what"""


class World:
    """A body with sensors, moved by physics, driven by a command a sample.

    Body axes are x right, y forward, z up; the Earth frame is ENU, north magnetic. Gyroscope and accelerometer give the
    mean over the sample that ends, as a converter that averages; the magnetometer gives an instant. Everything is the
    same for the same *seed*, on the same machine and MuJoCo.

    Raises :class:`WorldError` for a rate or an option that cannot be, and where MuJoCo is missing.
    """

    name: ClassVar[str]
    sensors: ClassVar[tuple[str, ...]] = ("imu",)
    """the first is the one that :meth:`step`, :attr:`truth` and :meth:`recording` mean"""
    commands: ClassVar[tuple[str, ...]]
    """what each number of a command is, with its unit"""
    pushed: ClassVar[str]
    """the body that :meth:`push` means"""
    cameras: ClassVar[str] = "follow"
    Options: ClassVar[type[Any]]

    def __init__(self, *, seed: int = 0, sensor: str | Sensor = SENSOR, rate: float = 200.0, **options: Any) -> None:
        if not (isinstance(rate, (int, float)) and 10.0 <= rate <= 4000.0):
            raise WorldError(f"rate: expected 10 to 4000 samples per second, found {rate!r}")
        if not (isinstance(seed, int) and seed >= 0):
            raise WorldError(f"seed: expected a whole number, 0 or more, found {seed!r}")
        if unknown := [name for name in options if name not in self.Options._fields]:
            raise WorldError(
                f"{self.name} has no option {unknown[0]!r}; there are {', '.join(self.Options._fields) or 'none'}"
            )
        self.options: Any = checked(self.Options(**options))
        self.seed, self.rate, self.sensor = seed, float(rate), part(sensor) if isinstance(sensor, str) else sensor
        self._substeps = ceil(1.0 / (rate * _STEP) - 1e-9)
        self._dt = 1.0 / (rate * self._substeps)
        for_world, *for_devices = np.random.SeedSequence(seed).spawn(1 + len(self.sensors))
        self.rng = np.random.default_rng(for_world)
        self.physics = Physics(self._model(model_text(self.name)), self._dt)
        self.devices = {
            name: Device(self.sensor, self.rate, each) for name, each in zip(self.sensors, for_devices, strict=True)
        }
        self.arrived: dict[str, list[Packet]] = {name: [] for name in self.sensors}
        """the samples of every sensor that arrived in the last step"""
        self.powered = True
        """False cuts the motors' power: commands then do nothing"""
        self.impact = nan
        """s, when the body first touched the ground"""
        self._views = {
            name: [self.physics.sensor(f"{name}_{kind}") for kind in ("gyr", "acc", "mag", "quat")]
            for name in self.sensors
        }
        self._body = self.physics.body(self.pushed)
        self._pushes: list[tuple[float, Floats, Floats | None]] = []
        self._log = {name: array("d") for name in self.sensors}  # flat: half an hour of objects would fill the memory
        self._sent = {name: array("d") for name in self.sensors}
        self._count = 0
        self._prepare()
        for _ in range(round(_SETTLING / self._dt)):
            self.physics.let_go(self._body)
            self._act()
            self.physics.step()
        self.physics.data.time = 0.0

    # -- what a world is made of ------------------------------------------------------------------------------------

    def _model(self, text: str) -> str:
        """The world's MJCF, from that of the package."""
        return text

    def _prepare(self) -> None:
        """Set the body up, before contacts settle."""

    def _take(self, command: Floats) -> None:
        """Note a new command."""
        raise NotImplementedError

    def _act(self) -> None:
        """Before every step of the physics: motors, and what disturbs."""
        raise NotImplementedError

    def _touched(self) -> bool:
        """Does the body touch the ground in this very step?"""
        return False

    def _state(self) -> dict[str, Any]:
        return {}

    def driver(self) -> Driver:
        """What drives this world where nobody else does: open loop or driven by the truth, never by an estimate."""
        raise NotImplementedError

    # -- for whoever uses it ----------------------------------------------------------------------------------------

    @property
    def time(self) -> float:
        """s since the start, at the end of the last sample."""
        return self._count / self.rate

    @property
    def truth(self) -> Truth:
        """How the first sensor stands now."""
        return self.truth_of(self.sensors[0])

    def truth_of(self, sensor: str) -> Truth:
        gyr, _, _, quat = self._views[sensor]
        return Truth(self.time, quat.copy(), gyr.copy(), self.impact, self._state())

    def step(self, command: ArrayLike | None = None) -> list[Packet]:
        """Go on by one sample under *command* (None: the one before) and give the samples that arrived by now.

        A sample arrives after its instant, never before it: none, one or several may. ``mag`` is NaN between samples of
        a slower magnetometer.
        """
        if command is not None:
            self._take(self._numbers(command))
        before = self.physics.data.time
        gyr = {name: np.zeros(3) for name in self.sensors}
        acc = {name: np.zeros(3) for name in self.sensors}
        views = [(gyr[name], acc[name], *self._views[name][:2]) for name in self.sensors]
        step, physics, act, touched, body = self._dt, self.physics, self._act, self._touched, self._body
        start = self.time
        for i in range(self._substeps):
            physics.let_go(body)
            act()
            self._push_on(start + i * step)
            physics.step()
            for rate, force, rate_view, force_view in views:
                rate += rate_view
                force += force_view
            if self.impact != self.impact and touched():  # NaN: not yet
                self.impact = start + (i + 1) * step
        if physics.data.time <= before:
            raise WorldError(
                f"{self.name}: the physics ran away at {self.time:.2f} s; a command or an option is too strong"
            )
        self._count += 1
        for name in self.sensors:
            self._sense(name, gyr[name] / self._substeps, acc[name] / self._substeps)
        return self.arrived[self.sensors[0]]

    def push(self, force: ArrayLike, duration: float, at: ArrayLike | None = None) -> None:
        """Push the body for *duration* s from now with *force* (3,) N, Earth axes; *at* (3,) m, body, or its centre of mass."""
        newton = np.array(force, float)
        point = None if at is None else np.array(at, float)
        if newton.shape != (3,) or not np.isfinite(newton).all() or (point is not None and point.shape != (3,)):
            raise WorldError(f"push: expected a force (3,) in N and a point (3,) in m, found {force!r} and {at!r}")
        if not 0.0 < duration < np.inf:
            raise WorldError(f"push: expected a duration in s above 0, found {duration!r}")
        self._pushes.append((self.time + duration, newton, point))

    def recording(self, sensor: str = "") -> Recording:
        """What has arrived so far from *sensor*, by default the first, with the truth."""
        name = sensor or self.sensors[0]
        if name not in self.sensors:
            raise WorldError(f"{self.name} has no sensor {name!r}; there are {', '.join(self.sensors)}")
        came = np.array(self._log[name]).reshape(-1, 10)
        table = np.array(self._sent[name]).reshape(-1, 11)[: len(came)]
        stamps = came[:, 0].copy()
        truth = Attitude.of(stamps, table[:, :4], heading_reference="magnetic")
        truth.rate[:], truth.bias[:] = table[:, 4:7], table[:, 7:10]
        still = (np.linalg.norm(table[:, 4:7], axis=1) < _MOVING_RATE) & (table[:, 10] < _MOVING_ACCELERATION)
        return Recording(
            time=stamps,
            gyr=came[:, 1:4].copy(),
            acc=came[:, 4:7].copy(),
            mag=came[:, 7:10].copy(),
            truth=truth,
            moving=~still if not still.all() else None,
            name=self.name if name == self.sensors[0] else f"{self.name}-{name}",
            source="simulation",
        )

    def forget(self) -> None:
        """Drop what :meth:`recording` has so far: for a world that runs without an end."""
        for name in self.sensors:
            n = len(self._log[name]) // 10
            del self._log[name][:], self._sent[name][: 11 * n]

    def render(self, width: int = 640, height: int = 480) -> NDArray[np.uint8]:
        """(height, width, 3) a picture of this moment, without a screen."""
        return self.physics.render(width, height, self.cameras)

    # -- inside -----------------------------------------------------------------------------------------------------

    def _numbers(self, command: ArrayLike) -> Floats:
        found = np.array(command, float).reshape(-1)
        if len(found) != len(self.commands) or not np.isfinite(found).all():
            raise WorldError(
                f"{self.name}: expected a command of {len(self.commands)} numbers "
                f"({', '.join(self.commands)}), found {found}"
            )
        return found

    def _push_on(self, now: float) -> None:
        if not self._pushes:
            return
        self._pushes = [push for push in self._pushes if push[0] > now + 1e-9]
        for _, force, at in self._pushes:
            self.physics.push(self._body, force, at)

    def _sense(self, name: str, gyr: Floats, acc: Floats) -> None:
        rate, _, field, quat = self._views[name]
        device = self.devices[name]
        if device.sample(self.time, gyr, acc, field.copy()):
            beside_gravity = abs(float(np.linalg.norm(acc)) - GRAVITY)
            self._sent[name].frombytes(np.concatenate([quat, rate, device.gyr_bias, [beside_gravity]]).tobytes())
        came = device.arrived(self.time)
        self.arrived[name] = came
        for time, of_gyr, of_acc, of_mag in came:
            self._log[name].frombytes(np.concatenate([[time], of_gyr, of_acc, of_mag]).tobytes())


def run(world: World, duration: float, driver: Driver | None = None) -> World:
    """*world* after *duration* s more under *driver*, by default its own."""
    drive = driver or world.driver()
    for _ in range(round(duration * world.rate)):
        world.step(drive(world))
    return world


def stream(
    world: World, driver: Driver | None = None, *, speed: float | None = None, duration: float | None = None
) -> Iterator[Packet]:
    """The packets of *world* as a live device sends them, *speed* times as fast as time, by default as fast as it can.

    It ends after *duration* s of the world's time, by default never. Late behind the clock, it does not wait.
    """
    drive = driver or world.driver()
    began, start = monotonic(), world.time
    while duration is None or world.time - start < duration - 0.5 / world.rate:
        came: Sequence[Packet] = world.step(drive(world))
        if speed is not None:
            ahead = (world.time - start) / speed - (monotonic() - began)
            if ahead > 0.0:
                sleep(ahead)
        yield from came
