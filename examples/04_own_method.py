"""A method of your own: a NamedTuple of parameters with start and step, compiled and run like the built-in ones."""

from typing import NamedTuple

import poise
from poise.math.quaternions import Quat, attitude_of, exp, normalize, up_in_body
from poise.math.vectors import Vec3, cross, present, unit
from poise.simulation import Sensor, forearm, measure


class State(NamedTuple):
    attitude: Quat  # body to Earth
    bias: Vec3  # rad/s


class Mahony(NamedTuple):
    """Complementary filter on SO(3) with integral bias (Mahony, Hamel, Pflimlin 2008, doi 10.1109/TAC.2008.923738)."""

    gain: float = 0.5  # 1/s, how fast gravity pulls the attitude
    bias_gain: float = 0.01  # 1/s²

    def start(self, sample, bias):
        return State(attitude_of(sample.acc, sample.mag, 0.0), bias)

    def step(self, state, sample):
        rate, bias = sample.gyr - state.bias, state.bias
        if present(sample.acc):
            error = cross(unit(sample.acc), up_in_body(state.attitude))  # eq. 32c
            bias = bias - self.bias_gain * sample.dt * error  # eq. 32b
            rate = sample.gyr - bias + self.gain * error  # eq. 32a
        return State(normalize(state.attitude * exp(sample.dt * rate)), bias)


recording = measure(forearm(), Sensor())
attitude = poise.estimate(Mahony(gain=0.3), recording)
print(attitude, poise.evaluate(attitude, recording).rmse_deg())
