"""Slewed: corrections of a method given out at a bounded rate of turn, for whoever looks at or acts on the attitude."""

from __future__ import annotations

from math import isfinite, pi, radians, sqrt
from typing import Annotated, Any, NamedTuple

from poise.data.flags import INVALID, RESET
from poise.data.packet import Output, Sample
from poise.estimators.protocol import output, start, step
from poise.math.compiled import compiled
from poise.math.quaternions import Quat, conjugate, exp, log, renormalized
from poise.math.vectors import ZERO, Vec3, norm

_NOTHING = 1e-9  # rad: rounding is no correction


class State(NamedTuple):
    inner: Any
    given: Quat  # body to Earth: the attitude that is given out, before the method's lead
    pending: Vec3  # rad, about the Earth's axes: the turn from there to the method's attitude
    own: Output  # what the method itself says: it is asked once a sample


class Slewed(NamedTuple):
    """Follows the gyroscope at every sample and gives out what *method* corrects beside that at no more than *rate*.

    A correction is whatever the method's attitude does that the rate it gives out does not explain. What has not been
    given out yet stands in the state as ``pending`` and is part of sigma. A start, a restart (RESET) and rows that are not
    valid are no corrections: there the method's own attitude is given out, at once.
    """

    method: Any
    rate: Annotated[float, "rad/s", "how fast a correction may turn the attitude that is given out", (0.0, 1e9)] = (
        radians(10.0)
    )
    lead: Annotated[float, "s", "the method's own: what it turns ahead of the sample is no correction", (-1.0, 1.0)] = (
        0.0
    )

    def start(self, sample: Sample, bias: Vec3) -> State:
        inner = start(self.method, sample, bias)
        out = output(self.method, inner, sample)
        return State(inner, _at_sample(self, out), ZERO, out)

    def step(self, state: State, sample: Sample) -> State:
        inner = step(self.method, state.inner, sample)
        out = output(self.method, inner, sample)
        q = _at_sample(self, out)
        if out.flags & (INVALID | RESET) != 0 or not (isfinite(state.given.w) and isfinite(q.w)):
            return State(inner, q, ZERO, out)
        dt = out.dt if out.dt > 0.0 else 0.0  # the guard's, which knows how long the row was taken to last
        turned = state.given * exp(dt * out.rate)
        apart = log(q * conjugate(turned))
        angle, most = norm(apart), self.rate * dt
        if angle <= max(most, _NOTHING):
            return State(inner, q, ZERO, out)
        share = most / angle
        return State(inner, renormalized(exp(share * apart) * turned), (1.0 - share) * apart, out)

    def output(self, state: State, sample: Sample) -> Output:
        """What the method says, at the attitude given out; sigma² about each of the Earth's axes with pending² added."""
        out, left = state.own, state.pending
        if left.x == 0.0 and left.y == 0.0 and left.z == 0.0:
            return out
        q = state.given if self.lead == 0.0 else state.given * exp(self.lead * out.rate)
        sigma = Vec3(_sigma(out.sigma.x, left.x), _sigma(out.sigma.y, left.y), _sigma(out.sigma.z, left.z))
        return Output(out.dt, q, out.rate, out.bias, sigma, out.bias_sigma, out.flags)


@compiled
def _at_sample(slewed: Slewed, out: Output) -> Quat:
    """The method's attitude at the sample itself."""
    return out.attitude if slewed.lead == 0.0 else out.attitude * exp(-slewed.lead * out.rate)


@compiled
def _sigma(own: float, left: float) -> float:
    """rad; an angle of which nothing is known is not further off than half a turn."""
    whole = sqrt(own * own + left * left)
    return min(whole, pi) if whole == whole else whole
