"""RestBias: the gyroscope's bias, measured whenever the sensor rests, for any method that does not learn it itself."""

from __future__ import annotations

from math import radians, sqrt
from typing import Annotated, Any, NamedTuple

from poise.data.flags import REST
from poise.data.packet import Output, Sample
from poise.estimators.protocol import output, restart, start, step, with_sensors
from poise.math.compiled import compiled
from poise.math.vectors import ZERO, Vec3, present, within

_FIRST = 0.5  # s of stillness before the mean so far is used, where nothing better is known


class State(NamedTuple):
    inner: Any
    bias: Vec3  # rad/s, in use now
    variance: float  # (rad/s)² of each axis of it
    prior: Vec3  # what it was when the present rest began
    prior_variance: float
    settled: bool  # a rest has been completed
    mean_gyr: Vec3  # low-passed, what "still" is judged against
    mean_acc: Vec3
    still: float  # s since the sensor last moved
    still_gyr: Vec3  # the mean rate over that time


class RestBias(NamedTuple):
    """Subtracts the gyroscope's bias, measured at rest, before *method* sees the rate.

    The sensor rests when, for *rest_time*, every sample lies close to the short-term mean and the mean rate is small.
    The bias is then the mean rate of the rest, weighed against what was known before. Causal: before the first rest is
    complete the mean so far is used while the sensor holds still.
    """

    method: Any
    rest_time: Annotated[float, "s", "how long the sensor must hold still before that counts as rest"] = 1.5
    mean_time: Annotated[float, "s", "time constant of the short-term mean"] = 0.5
    gyr_spread: Annotated[float, "rad/s", "largest distance of a still rate from its mean, per axis"] = radians(2.0)
    acc_spread: Annotated[float, "m/s²", "largest distance of a still specific force from its mean, per axis"] = 0.5
    largest_bias: Annotated[float, "rad/s", "largest mean rate that still passes for bias, per axis"] = radians(2.0)
    initial_sigma: Annotated[float, "rad/s", "how well the bias is known before any rest"] = radians(1.0)
    noise: Annotated[float, "rad/s/√Hz", "gyroscope white noise, which the mean over a rest averages out"] = radians(
        0.02
    )
    floor: Annotated[float, "rad/s", "how well the mean of a long rest gives the bias in motion"] = radians(0.01)
    walk: Annotated[float, "rad/s/√s", "random walk of the bias between rests"] = radians(0.003)

    def start(self, sample: Sample, bias: Vec3) -> State:
        inner = start(self.method, _without(sample, bias), ZERO)
        variance = self.initial_sigma * self.initial_sigma
        acc = sample.acc if present(sample.acc) else ZERO
        return State(inner, bias, variance, bias, variance, False, sample.gyr, acc, 0.0, ZERO)

    def restart(self, state: State, sample: Sample, bias: Vec3) -> State:
        """The method starts anew; what rests have taught stays, as well as it was known."""
        inner = restart(self.method, state.inner, _without(sample, state.bias), bias - state.bias)
        acc = sample.acc if present(sample.acc) else state.mean_acc
        return State(
            inner, state.bias, state.variance, state.prior, state.prior_variance, state.settled, sample.gyr, acc, 0.0, ZERO
        )  # fmt: skip

    def step(self, state: State, sample: Sample) -> State:
        dt = sample.dt
        gain = dt / (self.mean_time + dt)
        mean_gyr = state.mean_gyr + gain * (sample.gyr - state.mean_gyr)
        still = within(sample.gyr - mean_gyr, self.gyr_spread) and within(mean_gyr, self.largest_bias)
        mean_acc = state.mean_acc
        if present(sample.acc):
            mean_acc = mean_acc + gain * (sample.acc - mean_acc)
            still = still and within(sample.acc - mean_acc, self.acc_spread)

        bias, prior, settled = state.bias, state.prior, state.settled
        variance, prior_variance = state.variance, state.prior_variance
        time, still_gyr = state.still, state.still_gyr
        if still:
            time += dt
            still_gyr = still_gyr + (dt / time) * (sample.gyr - still_gyr)
            within_limits = within(still_gyr, self.largest_bias)
            if within_limits and (time >= self.rest_time or (not settled and time >= _FIRST)):
                measured = self.noise * self.noise / time + self.floor * self.floor
                if time < self.rest_time:  # it may yet turn out to be no rest
                    measured += self.largest_bias * self.largest_bias * (1.0 - time / self.rest_time)
                weight = prior_variance / (prior_variance + measured)
                bias = prior + weight * (still_gyr - prior)
                variance = (1.0 - weight) * prior_variance
        else:
            if time >= self.rest_time:  # a rest ends: what it taught becomes the prior of the next
                settled, prior, prior_variance = True, bias, variance
            elif not settled:  # too short to have been a rest
                bias, variance = prior, prior_variance
            time, still_gyr = 0.0, ZERO
            variance += self.walk * self.walk * dt
            prior_variance += self.walk * self.walk * dt
        inner = step(self.method, state.inner, _without(sample, bias))
        return State(
            inner, bias, variance, prior, prior_variance, settled, mean_gyr, mean_acc, time, still_gyr
        )  # fmt: skip

    def output(self, state: State, sample: Sample) -> Output:
        out = output(self.method, state.inner, _without(sample, state.bias))
        sigma = sqrt(state.variance)
        flags = out.flags | REST if state.still >= self.rest_time else out.flags
        # A method that says how well it knows a bias of its own has the better figure.
        bias_sigma = out.bias_sigma if present(out.bias_sigma) else Vec3(sigma, sigma, sigma)
        return Output(out.dt, out.attitude, out.rate, state.bias + out.bias, out.sigma, bias_sigma, flags)


@compiled
def _without(sample: Sample, bias: Vec3) -> Sample:
    return with_sensors(sample, sample.gyr - bias, sample.acc, sample.mag)
