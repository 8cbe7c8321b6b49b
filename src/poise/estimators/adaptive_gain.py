"""AdaptiveGain: gyroscope correction with a gain that follows the motion.

Source: "Attitude estimation method and device for a moving object from gyroscope and accelerometer data", 20 claims, no
number in the text. Steps are numbered as in ``docs/methods/adaptive-gain.md``, which derives them.

Departures from the print:

- Claim 11's first measure of deviation reads |w| − |w_c| or |w − w_c|: the latter here.
- Its third sums signed differences of Euler angles, which cancel: absolute differences here.
- Claims 8 and 9 compare with a mean and a standard deviation without saying over what: here over the last *window*
  samples, recursively, after *min_count* of them and with a floor for the deviation.
- The correction is w + K e with e = measured × predicted; the other sign settles upside down.
"""

from __future__ import annotations

from math import exp as exponential
from math import inf, pi, sqrt
from typing import Annotated, Literal, NamedTuple, Self

from poise.data.flags import CORRECTION_FORCED
from poise.data.packet import Output, Sample
from poise.math.compiled import compiled
from poise.math.quaternions import (
    Quat,
    angles_from,
    attitude_of,
    exp,
    north_in_body,
    north_of,
    renormalized,
    up_in_body,
    wrapped,
)
from poise.math.vectors import ABSENT, Vec3, cross, dot, norm, present, unit, within

_MEAN_TIME = 0.5  # s, time constant of the means that stillness is judged against


class State(NamedTuple):
    attitude: Quat  # q
    bias: Vec3  # always zero: the method has none of its own
    gravity: float  # g_ref, m/s²
    rested: float  # s of rest that g_ref is the mean of
    mean_acc: Vec3  # short-term means that stillness is judged against
    mean_mag: Vec3
    still: float  # s since one of the chosen sensors last moved
    mean: float  # µ of the deviation
    variance: float  # s² of the deviation
    judged: int  # deviations that µ and s² are made of
    forced: bool


class AdaptiveGain(NamedTuple):
    """Complementary filter on the rate: the gain falls back to a preset constant where the object accelerates."""

    k_rest: Annotated[float, "1/s", "correction gain without motion acceleration"] = 0.2
    k_fast: Annotated[float, "1/s", "preset gain where the motion acceleration exceeds the threshold"] = 0.001
    threshold: Annotated[float, "m/s²", "motion acceleration above which k_fast holds", (1e-6, 1e6)] = 5.5
    gain: Annotated[Literal["linear", "gaussian"], "choice", "how the gain goes from k_rest to k_fast"] = "linear"
    gain_width: Annotated[float, "m/s²", "width of the gaussian gain", (1e-6, 1e6)] = 6.0
    rest_sensors: Annotated[
        Literal["acc", "gyr", "mag", "acc+gyr", "acc+mag", "gyr+mag", "acc+gyr+mag"],
        "choice",
        "what must be still for rest",
    ] = "acc+gyr"
    rest_acc: Annotated[float, "m/s²", "largest distance of a still specific force from its mean, per axis"] = 0.5
    rest_gyr: Annotated[float, "rad/s", "largest rate at rest"] = 0.05
    rest_mag: Annotated[float, "1", "largest distance of a still field's direction from its mean, per axis"] = 0.02
    rest_time: Annotated[float, "s", "how long all chosen sensors must be still"] = 0.5
    deviation: Annotated[
        Literal["rate-norm", "rate-cross", "euler-sum"], "choice", "measure δ between a step with w and one with w_c"
    ] = "rate-norm"
    check: Annotated[
        Literal["relative", "absolute", "off"],
        "choice",
        "|δ − µ| > n·s (claim 9), δ − µ > a threshold (claim 8), or neither",
    ] = "absolute"
    check_factor: Annotated[float, "1", "n of the relative check"] = 3.0
    check_threshold: Annotated[float, "rad/s, rad²/s² or rad", "threshold of the absolute check"] = 0.00065
    check_window: Annotated[int, "samples", "how far back µ and s reach", (1, inf)] = 10000
    check_min_count: Annotated[int, "samples", "how many deviations must be known before any is judged"] = 100
    check_floor: Annotated[float, "rad/s, rad²/s² or rad", "smallest s that is believed"] = 0.001
    k_forced: Annotated[float, "1/s", "preset gain where the deviation stands out"] = 0.03
    gravity: Annotated[float, "m/s²", "length of gravity before any rest has measured it", (0.1, 100.0)] = 9.80665
    declination: Annotated[float, "rad", "true heading = magnetic heading + D, east positive", (-pi, pi)] = 0.0

    @classmethod
    def as_printed(cls) -> Self:
        """The print's choices: the linear gain of claim 6, the absolute check of claim 8 on claim 11's first measure."""
        return cls(gain="linear", deviation="rate-norm", check="absolute")

    def start(self, sample: Sample, bias: Vec3) -> State:
        attitude = attitude_of(sample.acc, sample.mag, self.declination)
        mean_mag = unit(sample.mag) if present(sample.mag) else ABSENT
        return State(attitude, bias, self.gravity, 0.0, sample.acc, mean_mag, 0.0, 0.0, 0.0, 0, False)

    def step(self, state: State, sample: Sample) -> State:
        q, T, f, m = state.attitude, sample.dt, sample.acc, sample.mag
        w = sample.gyr - state.bias
        gravity, rested, still = state.gravity, state.rested, state.still
        mean_acc, mean_mag = state.mean_acc, state.mean_mag
        mean, variance, judged, forced = state.mean, state.variance, state.judged, False
        w_c = w
        if present(f):
            predicted = q * exp(T * w)
            up, length = up_in_body(predicted), norm(f)

            # 1. Gravity: the mean of |f| over all rest so far, where the gyroscope's attitude sees up
            smooth = T / (_MEAN_TIME + T)
            mean_acc = mean_acc + smooth * (f - mean_acc)
            if _uses_mag(self) and present(m):
                mean_mag = mean_mag + smooth * (unit(m) - mean_mag) if present(mean_mag) else unit(m)
            still = still + T if is_still(self, w, f, m, mean_acc, mean_mag) else 0.0
            if still >= self.rest_time:
                rested += T
                gravity += (length - gravity) * T / rested
            f_g = gravity * up

            # 2. Motion acceleration, 3. correction gain
            a_m = f - f_g
            K = correction_gain(self, dot(a_m, a_m))

            # 4. Correction vector: measured × predicted, up and north
            up_measured = f / length
            per_step = 1.0 / T  # a slower sensor's sample stands for the steps since its last one
            e = (per_step * sample.acc_dt) * cross(up_measured, up)
            if present(m):
                north_measured = north_of(up_measured, m, self.declination)
                e = e + (per_step * sample.mag_dt) * cross(north_measured, north_in_body(predicted))

            # 5. Calibrated rate
            w_c = w + K * e

            # 6. Deviation check against the mean and standard deviation so far
            delta = deviation(self, q, w, w_c, T)
            if judged >= self.check_min_count and stands_out(self, delta, mean, variance):
                forced = True
                w_c = w + self.k_forced * e
            judged += 1
            change = delta - mean
            weight = 1.0 / min(judged, self.check_window)
            mean += weight * change
            variance += weight * (change * (delta - mean) - variance)

        # 7. Integrate
        q = renormalized(q * exp(T * w_c))
        return State(q, state.bias, gravity, rested, mean_acc, mean_mag, still, mean, variance, judged, forced)

    def output(self, state: State, sample: Sample) -> Output:
        flags = CORRECTION_FORCED if state.forced else 0
        return Output(sample.dt, state.attitude, sample.gyr - state.bias, state.bias, ABSENT, ABSENT, flags)


@compiled
def is_still(method: AdaptiveGain, w: Vec3, f: Vec3, m: Vec3, mean_acc: Vec3, mean_mag: Vec3) -> bool:
    """Whether every chosen sensor is still; one without a sample now does not object, one that never had any does."""
    if _uses_gyr(method) and dot(w, w) > method.rest_gyr**2:
        return False
    if _uses_acc(method) and not within(f - mean_acc, method.rest_acc):
        return False
    if _uses_mag(method):
        return present(mean_mag) and (not present(m) or within(unit(m) - mean_mag, method.rest_mag))
    return True


@compiled
def _uses_acc(method: AdaptiveGain) -> bool:
    return not (method.rest_sensors == "gyr" or method.rest_sensors == "mag" or method.rest_sensors == "gyr+mag")


@compiled
def _uses_gyr(method: AdaptiveGain) -> bool:
    return not (method.rest_sensors == "acc" or method.rest_sensors == "mag" or method.rest_sensors == "acc+mag")


@compiled
def _uses_mag(method: AdaptiveGain) -> bool:
    return not (method.rest_sensors == "acc" or method.rest_sensors == "gyr" or method.rest_sensors == "acc+gyr")


@compiled
def correction_gain(method: AdaptiveGain, square: float) -> float:
    """K over the motion acceleration, |a_m|² = *square*: k_rest at 0, the preset k_fast above the threshold."""
    if square > method.threshold**2:
        return method.k_fast
    if method.gain == "linear":
        return method.k_rest + (method.k_fast - method.k_rest) * sqrt(square) / method.threshold
    return method.k_fast + (method.k_rest - method.k_fast) * exponential(-0.5 * square / method.gain_width**2)


@compiled
def deviation(method: AdaptiveGain, q: Quat, w: Vec3, w_c: Vec3, T: float) -> float:
    """δ between one step with w and one with w_c from the same q (claim 11)."""
    if method.deviation == "rate-norm":
        return norm(w - w_c)
    if method.deviation == "rate-cross":
        return norm(cross(w, w_c))
    a, b = angles_from(q * exp(T * w)), angles_from(q * exp(T * w_c))
    return abs(wrapped(a.pitch - b.pitch)) + abs(wrapped(a.roll - b.roll)) + abs(wrapped(a.heading - b.heading))


@compiled
def stands_out(method: AdaptiveGain, delta: float, mean: float, variance: float) -> bool:
    """Claim 8: δ − µ above a threshold; claim 9: |δ − µ| above n·s."""
    if method.check == "absolute":
        return delta - mean > method.check_threshold
    if method.check == "relative":
        least = method.check_factor**2 * max(variance, method.check_floor**2)
        return (delta - mean) ** 2 > least
    return False
