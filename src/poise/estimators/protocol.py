"""What an estimator is: a NamedTuple of its parameters with ``start``, ``step`` and, if it has more to say, ``output``.

    start(self, sample, bias) -> State             a State has at least `attitude` (Quat, body to Earth) and `bias` (Vec3)
    step(self, state, sample) -> State
    restart(self, state, sample, bias) -> State    after a loss; default: start(sample, bias)
    output(self, state, sample) -> Output          default: the state's attitude, gyr − bias, no sigmas, no flags

A method with a `declination` field has a heading from the magnetometer; one with ``learns_bias = True`` estimates the
gyroscope's bias itself and is not wrapped in RestBias. Methods nest by calling these functions on one another.
"""

from __future__ import annotations

from math import cos, sin
from typing import Any

from poise.data.packet import Output, Sample
from poise.math.compiled import compiled, dispatched
from poise.math.quaternions import Quat, conjugate, rotate, up_in_body
from poise.math.vectors import ABSENT, ZERO, Vec3


def _plain_output(method: Any, state: Any, sample: Sample) -> Output:
    return Output(sample.dt, state.attitude, sample.gyr - state.bias, state.bias, ABSENT, ABSENT, 0)


start = dispatched("start", inlined=False)
step = dispatched("step", polished=True)  # without, `two-stage` takes a sixth longer a sample
output = dispatched("output", default=_plain_output)


def _plain_restart(thing: Any, state: Any, sample: Sample, bias: Vec3) -> Any:
    return start(thing, sample, bias)


restart = dispatched("restart", default=_plain_restart, inlined=False)


@compiled
def resting_sample(attitude: Quat, declination: float) -> Sample:
    """What a perfect sensor at rest would measure: a method started from it starts at *attitude*."""
    field = Vec3(20.0 * sin(declination), 20.0 * cos(declination), -40.0)  # µT; magnetic north, pointing down
    return Sample(
        0.0, ZERO, 9.80665 * up_in_body(attitude), rotate(conjugate(attitude), field), 0.0, 0.0, 0.0, 0.0, 0.0
    )


@compiled
def with_sensors(sample: Sample, gyr: Vec3, acc: Vec3, mag: Vec3) -> Sample:
    """The same instant with other sensor values."""
    return Sample(
        sample.dt, gyr, acc, mag, sample.acc_age, sample.mag_age, sample.acc_dt, sample.mag_dt, sample.turn_variance
    )  # fmt: skip
