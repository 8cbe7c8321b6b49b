"""Gated: the gyroscope's attitude, corrected by gravity only while it can be trusted.

Source: CN 105021189 A, gyroscope attitude of a mobile device. Steps are numbered as in ``docs/methods/gated.md``, which
derives them.

Departures from the print:

- The low-pass of gravity is printed inside step 3, behind the gates; here it runs on every sample, so that it knows
  gravity when a gate opens.
- The pitch formulas are illegible: pitch is the elevation of the device's y axis, θ = asin(g_y/|g|), γ = atan2(−g_x, g_z)
  (Android's getOrientation has the opposite sign).
- ``rotation_gate="rate"``: the gate is a rate, where the print has the vector part of one sample's quaternion, which
  means another rate at every sample rate. ``"per-sample"`` is the print.
- ``low_pass="time-constant"``, where the print keeps three quarters of the last value per sample (``"per-sample"``).
- ``pitch_window=(-89, 89)``: corrected at any pitch (within ±89°). The print's is (75, 89).
- ``rebuild="minimal"``: the smallest turn that puts *up* where g says. The print (``"euler"``) keeps the Euler angle of
  heading, which near 90° of pitch lets the heading absorb the gyroscope's bias divided by cos θ.
- ``still_gate``: corrected only once the specific force has had gravity's length for a while. The print has no such gate.
"""

from __future__ import annotations

from math import radians, sin
from typing import Annotated, Literal, NamedTuple, Self

from poise.data.packet import Sample
from poise.estimators.parameters import Interval
from poise.math.compiled import compiled
from poise.math.quaternions import (
    Angles,
    Quat,
    angles_from,
    angles_of,
    attitude_of,
    exp,
    from_angles,
    renormalized,
    rotate,
    shortest_turn,
    up_in_body,
)
from poise.math.vectors import ABSENT, UP, Vec3, norm, present, unit


class State(NamedTuple):
    attitude: Quat  # R
    bias: Vec3  # always zero: the method has none of its own
    gravity: Vec3  # g, m/s², body frame, low-passed
    steady: float  # s for which |f| has been gravity's length


class Gated(NamedTuple):
    """Gyroscope attitude whose inclination is taken from gravity while the device holds still."""

    rotation_gate: Annotated[
        Literal["rate", "per-sample"], "choice", "what of the rotation must be small: its rate, or |rotV| of one sample"
    ] = "rate"
    gate_rate: Annotated[float, "rad/s", "largest rate that is corrected, with rotation_gate='rate'"] = 0.05
    gate_vector: Annotated[
        float, "1", "largest |rotV| = sin(|w|T/2) that is corrected, with rotation_gate='per-sample'"
    ] = 0.0005
    low_pass: Annotated[
        Literal["time-constant", "per-sample"],
        "choice",
        "how gravity is low-passed: over a time, or by alpha per sample",
    ] = "time-constant"
    low_pass_time: Annotated[float, "s", "time constant of gravity, with low_pass='time-constant'"] = 0.1
    alpha: Annotated[float, "1", "share of the last value kept per sample, with low_pass='per-sample'", (0.0, 1.0)] = (
        0.75
    )
    pitch_window: Annotated[
        Interval,
        "deg",
        "pitch (elevation of the y axis) at which it corrects; None stands for (-89, 89)",
        (-89.0, 89.0),
    ] = (-89.0, 89.0)
    rebuild: Annotated[
        Literal["minimal", "euler"], "choice", "how the inclination is put right: smallest turn, or with the same ψ"
    ] = "minimal"
    still_gate: Annotated[bool, "yes/no", "correct only while the specific force has gravity's length"] = True
    still_acc: Annotated[float, "m/s²", "largest ||f| − g| that passes the still gate"] = 0.2
    still_time: Annotated[float, "s", "how long it must do so first"] = 0.3
    gravity: Annotated[float, "m/s²", "length of gravity g", (0.1, 100.0)] = 9.80665

    @classmethod
    def as_printed(cls) -> Self:
        """The print's gates per sample, its pitch window, its low-pass and its rebuilding from Euler angles."""
        return cls(
            rotation_gate="per-sample",
            low_pass="per-sample",
            pitch_window=(75.0, 89.0),
            rebuild="euler",
            still_gate=False,
        )

    def start(self, sample: Sample, bias: Vec3) -> State:
        """The first specific force and, for the heading to start from, the first field."""
        return State(attitude_of(sample.acc, sample.mag, 0.0), bias, sample.acc, 0.0)

    def step(self, state: State, sample: Sample) -> State:
        w, T, f = sample.gyr - state.bias, sample.dt, sample.acc
        g, steady = state.gravity, state.steady

        # 1. R[n+1] = R[n] · rotV
        rotV = exp(T * w)
        R = renormalized(state.attitude * rotV)
        if not present(f):
            return State(R, state.bias, g, steady + T)

        # 3. Low-pass gravity, on every sample
        keep = self.alpha
        if self.low_pass == "time-constant":
            keep = self.low_pass_time / (self.low_pass_time + sample.acc_dt)
        g = f + keep * (g - f)
        steady = steady + T if abs(norm(f) - self.gravity) < self.still_acc else 0.0

        # 2. Correct only if the rotation is slow and the pitch, before any correction, is inside the window
        if gates_open(self, w, rotV, R, steady):
            # 3. Pitch and roll from g, heading from R
            if self.rebuild == "minimal":
                R = renormalized(shortest_turn(unit(rotate(R, g)), UP) * R)
            else:
                tilt = angles_of(g, ABSENT)
                R = from_angles(Angles(tilt.pitch, tilt.roll, angles_from(R).heading))
        return State(R, state.bias, g, steady)


@compiled
def gates_open(method: Gated, w: Vec3, rotV: Quat, R: Quat, steady: float) -> bool:
    """Whether rotation, pitch and, if asked, specific force allow a correction."""
    if method.rotation_gate == "rate":
        slow = norm(w) < method.gate_rate
    else:
        slow = norm(Vec3(rotV.x, rotV.y, rotV.z)) < method.gate_vector
    if not slow or (method.still_gate and steady < method.still_time):
        return False
    low, high = method.pitch_window  # type: ignore[misc]  # None was replaced before any kernel sees it
    return sin(radians(low)) < up_in_body(R).y < sin(radians(high))
