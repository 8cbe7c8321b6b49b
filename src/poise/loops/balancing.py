"""A two-wheeled robot that balances by an estimate, watched by the tip-over monitor, which cuts its motors by a relay."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from math import degrees, nan, radians
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.control.balance import BalanceControl, Balancer
from poise.data.event import TipEvent, TipState
from poise.loops.eyes import Eyes
from poise.monitor import Directions, Monitor, TipOver
from poise.responses.config import config_of
from poise.responses.relay import Relay
from poise.responses.running import Responses
from poise.simulation.worlds import Balance

Floats = NDArray[np.float64]
Command = Callable[["BalanceLoop"], tuple[float, float]]
"""The speed (m/s) and the turn (rad/s) wanted now."""

SENSOR = "MPU-6050"
RATE = 200.0
PIN = 17

# What its builder would state of the robot: a body of 1.5 kg (it has 1.62, and up to 0.2 kg on top), its centre of mass 120 mm
# above the axle (135 mm), wheels of 200 g on discs, motors that follow at once (20 ms). The default method's attitude may be
# unsettled for 5 s when it doubts its bias; over that the rate alone strays by less than a degree.
CONTROL = BalanceControl.design(
    1.5, 0.12, 0.05, wheel_mass=0.2, way=0.2, speed=0.15, lean_deg=8.0, torque_limit=0.45, reach=0.1, bridge=6.0
)
# Found with 400 pushes of seeds that no table uses (docs/balance.md): 0.09 s ahead, no lean that came back was beyond 50.6°,
# and none that did not was short of 52.8° 150 ms before the ground. Sideways the robot stands on wheels 0.2 m apart, whose
# motors do not help: it came back from 29.4°, and was beyond 41° 150 ms before the ground.
TIPOVER = TipOver(
    range=Directions(*map(radians, (15.0, 15.0, 10.0, 10.0))),
    self_balancing=Directions(*map(radians, (51.5, 51.5, 34.0, 34.0))),
    look_ahead=0.09,
    dwell=0.002,
    samples=2,  # at 200 Hz; a third is 5 ms of the lead
    impact=radians(90.0),
)

COLUMNS = ("time", "lean", "estimate", "speed", "wanted", "left", "right", "state", "x", "y")


class Push(NamedTuple):
    """A push at the centre of mass."""

    time: float
    """s"""
    force: tuple[float, float, float]
    """N, in the robot's level frame: right, forward, up"""
    duration: float = 0.1
    """s"""


@dataclass(frozen=True)
class Cut:
    """The monitor's decision and what came of it."""

    event: TipEvent
    time: float
    """s, of the world: the sample that decided had arrived by then"""
    computed: float
    """s of a monotonic clock, from that sample's arrival to the decision: estimator and monitor"""
    relay: float
    """s of the same clock, from the decision to the relay's edge"""

    @property
    def edge(self) -> float:
        """s, of the world: when the motors' power was gone."""
        return self.time + self.computed + self.relay


@dataclass(frozen=True, eq=False)
class BalanceRun:
    """A robot's run: what it did, what was judged, what was cut."""

    method: str
    seed: int
    table: Floats
    """(n, 10): :data:`COLUMNS`; lean and estimate rad, wheel torques N m, x and y m"""
    pushes: tuple[Push, ...]
    events: tuple[TipEvent, ...]
    cut: Cut | None
    impact: float
    """s, when the body first touched the ground, by the contacts of the physics; NaN where it did not"""

    def __getitem__(self, column: str) -> Floats:
        return self.table[:, COLUMNS.index(column)]

    @property
    def fell(self) -> bool:
        return self.impact == self.impact

    @property
    def lead(self) -> float:
        """s from the relay's edge to the impact; NaN where there was not both."""
        return nan if self.cut is None else self.impact - self.cut.edge

    @property
    def triggered(self) -> bool:
        """Did the monitor say that it tips over, or worse?"""
        return any(event.state in CUTTING for event in self.events)

    def estimate_rms(self) -> float:
        """rad, of the estimated lean, until the body touches the ground."""
        error = (self["estimate"] - self["lean"])[(self["time"] > 1.0) & ~(self["time"] > self.impact)]
        return float(np.sqrt(np.mean(error**2))) if len(error) else nan


CUTTING = (TipState.TIPPING, TipState.FALLEN, TipState.FREE_FALL)


@dataclass
class BalanceLoop:
    """The robot in its world, closed: sensor, estimator, controller; monitor, relay. ``step`` goes on by a sample.

    ``cuts=False`` leaves the monitor watching only. *wav* is where its voice is written to. A context manager.
    """

    method: str = "two-stage"
    seed: int = 0
    sensor: str = SENSOR
    control: BalanceControl = CONTROL
    tipover: TipOver = TIPOVER
    cuts: bool = True
    wav: Path | None = None
    options: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.world = Balance(seed=self.seed, sensor=self.sensor, rate=RATE, **self.options)
        self.eyes, self.balancer, self.monitor = (
            Eyes(self.method, self.world),
            Balancer(self.control),
            Monitor(self.tipover),
        )
        self.events: list[TipEvent] = []
        self.pushes: list[Push] = []
        self.cut: Cut | None = None
        self.estimate = nan
        self.rows: list[list[float]] = []
        self._wanted, self._torques = (0.0, 0.0), (0.0, 0.0)
        self.relay: Relay | None = None
        self.responses: Responses | None = None
        if self.cuts:
            config = config_of(_responses(self.wav))
            self.relay = next(each for each in config.responders if isinstance(each, Relay))
            self.responses = Responses(config)

    def __enter__(self) -> BalanceLoop:
        if self.responses is not None:
            self.responses.open()
        return self

    def __exit__(self, *_: object) -> None:
        if self.responses is not None:
            self.responses.wait()
            self.responses.close()

    def drive(self, speed: float, turn: float = 0.0) -> None:
        """What is wanted of it from now on: m/s, rad/s."""
        self._wanted = (speed, turn)
        self.balancer.drive(speed, turn)

    def push(self, force: tuple[float, float, float], duration: float = 0.1) -> None:
        """Push it now; *force* (N) is to its right, forward and up, as it stands."""
        w, x, y, z = self.world.truth.quat
        ahead = np.array([2.0 * (x * y - w * z), w * w - x * x + y * y - z * z])
        ahead /= max(float(np.hypot(*ahead)), 1e-9)
        right = np.array([ahead[1], -ahead[0]])
        self.world.push([*(force[0] * right + force[1] * ahead), force[2]], duration)
        self.pushes.append(Push(self.world.time, force, duration))

    def step(self) -> None:
        """One sample of the sensor: physics, estimate, judgement, torques."""
        packets = self.world.step(self._torques)
        arrived = time.monotonic()
        for packet, attitude in self.eyes.see(packets):
            self._judge(self.monitor.update(attitude, packet.acc), arrived)
            if self.world.released:
                self._torques = self.balancer.update(attitude, self.world.encoders)
            self.estimate = _lean(attitude.quat[0])
        self._judge(self.monitor.check(self.world.time), arrived)
        state = self.world.truth.state
        self.rows.append([
            self.world.time, state["lean"], self.estimate, state["speed"], self._wanted[0], *state["torques"],
            float(self.monitor.state), *state["position"][:2].tolist(),
        ])  # fmt: skip

    def run(self, until: float, command: Command | None = None, *, after_impact: float = 0.5) -> None:
        """Go on until a time (s), or until the body has lain for *after_impact* s."""
        while self.world.time < until - 1e-9 and not self.world.time > self.world.impact + after_impact:
            if command is not None:
                self.drive(*command(self))
            self.step()

    def result(self) -> BalanceRun:
        """What has happened so far."""
        table = np.array(self.rows).reshape(-1, len(COLUMNS))
        events, pushes = tuple(self.events), tuple(self.pushes)
        return BalanceRun(self.method, self.seed, table, pushes, events, self.cut, self.world.impact)

    def _judge(self, events: list[TipEvent], arrived: float) -> None:
        for event in events:
            self.events.append(event)
            if self.responses is None or self.relay is None:
                continue
            decided, before = time.monotonic(), self.relay.cut
            self.responses.handle(event)
            if self.relay.cut and not before:
                self.cut = Cut(event, self.world.time, decided - arrived, self.relay.edge - decided)
            self.world.powered = not self.relay.cut


def balancing(
    method: str = "two-stage",
    *,
    seed: int = 0,
    duration: float = 60.0,
    pushes: tuple[Push, ...] = (),
    command: Command | None = None,
    **options: Any,
) -> BalanceRun:
    """A run of *duration* s with *pushes*; *command* is what is wanted of it, by default :func:`to_and_fro`."""
    with BalanceLoop(method, seed, **options) as loop:
        for push in sorted(pushes):
            loop.run(push.time, command or to_and_fro)
            if loop.world.time >= push.time - 1e-9:
                loop.push(push.force, push.duration)
        loop.run(duration, command or to_and_fro)
        return loop.result()


def to_and_fro(loop: BalanceLoop) -> tuple[float, float]:
    """Stand for 4 s, then drive forward, stand, drive back and stand again, at 0.3 m/s."""
    now = loop.world.time - 4.0
    if now < 0.0:
        return 0.0, 0.0
    return (0.3, 0.0, -0.3, 0.0)[int(now / 4.0) % 4], 0.0


def _responses(wav: Path | None) -> dict[str, Any]:
    """The configuration that a user of such a robot would write."""
    responders: dict[str, Any] = {"motors": {"type": "relay", "pin": PIN, "active_high": True, "fail_safe": "release"}}
    if wav is not None:
        responders["voice"] = {"type": "voice", "wav": str(wav)}
    stage = {"name": "tips over", "state": ["tipping", "fallen", "free fall"], "fire": list(responders)}
    return {"name": "robot", "unknown": "ignore", "responders": responders, "stages": [stage]}


def _lean(quat: Floats) -> float:
    """rad, forward."""
    w, x, y, z = quat
    return float(np.arctan2(-2.0 * (y * z + w * x), w * w - x * x - y * y + z * z))


def told(run: BalanceRun) -> str:
    """The run in a few lines."""
    lines = [f"seed {run.seed}, {run.method}: {run['time'][-1]:.1f} s, estimate {degrees(run.estimate_rms()):.2f}° RMS"]
    lines += [f"{event.time:7.3f} s  {event.state.name.lower()}: {event.reason}" for event in run.events]
    if run.cut is not None:
        cut = run.cut
        lines.append(
            f"{cut.edge:7.3f} s  relay: motors cut, {1e3 * cut.computed:.2f} ms after the sample the decision, "
            f"{1e3 * cut.relay:.2f} ms after that the edge"
        )
    if run.fell:
        lines.append(f"{run.impact:7.3f} s  impact" + (f", {run.lead:.3f} s after the edge" if run.cut else ""))
    return "\n".join(lines)
