"""Guard: keeps what is not a measurement away from a method, bridges short losses, restarts after long ones, and says so."""

from __future__ import annotations

from math import cos, radians
from typing import Annotated, Any, NamedTuple

from poise.data.flags import (
    ACC_MISSING,
    GAP,
    GYR_MISSING,
    HEADING_ARBITRARY,
    INITIALISING,
    LOST,
    MAG_MISSING,
    RESET,
    TIME_DISORDER,
)
from poise.data.packet import Output, Sample
from poise.estimators.protocol import output, restart, resting_sample, start, step, with_sensors
from poise.math.compiled import compiled
from poise.math.quaternions import IDENTITY, Quat, rotate, shortest_turn, up_in_body
from poise.math.vectors import ABSENT, UP, Vec3, dot, norm, present, unit, within

_REST_RATE, _REST_FORCE = 0.1, 0.05  # rad/s with any bias; share of gravity


class State(NamedTuple):
    inner: Any
    gyr: Vec3  # rad/s, the last one that was measured
    started: bool  # an accelerometer sample has given an attitude
    aligned: bool  # the heading is known: from a magnetometer sample, or given at the start
    mag_seen: bool  # the magnetometer has spoken
    lost: bool  # the motion was not measured for too long: start anew when it is again
    gyr_absent: float  # s
    acc_absent: float
    mag_absent: float
    astray: float  # s at rest with a tilt that gravity contradicts
    disorder: int  # rows in a row without a usable stamp
    flags: int


class Guard(NamedTuple):
    """Lets only finite samples of possible size reach *method*, in time that runs forward.

    A lost gyroscope sample is bridged with the last rate; after *longest_loss* without one, or a gap in the stamps that
    long, the method starts anew from accelerometer and magnetometer and keeps the bias it had. So it does at rest, where
    gravity says that the tilt is wrong. Before the first usable accelerometer sample the attitude is NaN and not valid.
    """

    method: Any
    declination: Annotated[float, "rad", "the method's own, so that a restart keeps the heading", (-3.2, 3.2)] = 0.0
    gravity: Annotated[float, "m/s²", "length of gravity, which a resting accelerometer measures", (0.1, 100.0)] = (
        9.80665
    )
    follows_mag: Annotated[
        bool,
        "yes/no",
        "the method follows a magnetometer: starts anew at a late first sample of it; its loss is flagged",
    ] = True
    gap: Annotated[float, "s", "a longer step between stamps is flagged"] = 0.2
    longest_loss: Annotated[float, "s", "without rotation for longer, the attitude is unknown"] = 1.0
    acc_loss: Annotated[float, "s", "without accelerometer for longer, samples are flagged"] = 0.5
    mag_loss: Annotated[float, "s", "without a magnetometer that was there before for longer, samples are flagged"] = (
        1.0
    )
    astray_angle: Annotated[float, "rad", "a tilt further from gravity, at rest, is wrong", (0.34, 3.2)] = radians(20.0)
    astray_time: Annotated[float, "s", "how long it may stay so before the method starts anew"] = 2.0
    longest_disorder: Annotated[int, "rows", "without a usable stamp for more, the attitude is unknown"] = 20
    largest_gyr: Annotated[float, "rad/s", "a larger rate is no measurement"] = 200.0
    largest_acc: Annotated[float, "m/s²", "a larger specific force is no measurement"] = 5000.0
    largest_mag: Annotated[float, "µT", "a larger field is no measurement"] = 1e6

    def start(self, sample: Sample, bias: Vec3) -> State:
        clean = _cleaned(self, sample, 0.0, 0.0)
        gyr = clean.gyr if present(clean.gyr) else bias
        seen = present(clean.acc)
        placeholder = resting_sample(IDENTITY, self.declination)
        first = (
            with_sensors(clean, gyr, clean.acc, clean.mag)
            if seen
            else with_sensors(placeholder, gyr, placeholder.acc, ABSENT)
        )
        inner = start(self.method, first, bias)
        aligned = seen and present(clean.mag)
        flags = (0 if seen else INITIALISING) | (0 if aligned else HEADING_ARBITRARY)
        return State(inner, gyr, seen, aligned, False, False, 0.0, 0.0, 0.0, 0.0, 0, flags)

    def step(self, state: State, sample: Sample) -> State:
        if not 1e-7 < sample.dt < 1e12:  # NaN too; a noise density over no time at all would overflow
            return _held(self, state)
        clean = _cleaned(self, sample, state.acc_absent, state.mag_absent)
        dt, flags = sample.dt, 0
        gyr_absent = 0.0 if present(clean.gyr) else state.gyr_absent + dt
        acc_absent = 0.0 if present(clean.acc) else state.acc_absent + dt
        mag_absent = 0.0 if present(clean.mag) else state.mag_absent + dt
        gyr = clean.gyr if present(clean.gyr) else state.gyr
        if gyr_absent > 0.0:
            flags |= GYR_MISSING
        if acc_absent > self.acc_loss:
            flags |= ACC_MISSING
        mag_seen = state.mag_seen or mag_absent == 0.0
        if mag_seen and self.follows_mag and mag_absent > self.mag_loss:
            flags |= MAG_MISSING
        if dt > self.gap:
            flags |= GAP
        lost = state.lost or gyr_absent > self.longest_loss or dt > self.longest_loss
        lost = lost or state.disorder > self.longest_disorder

        usable = acc_absent == 0.0 and gyr_absent == 0.0
        has_mag = mag_absent == 0.0
        sample = with_sensors(clean, gyr, clean.acc, clean.mag)
        if state.started and not lost and (state.aligned or not has_mag or not self.follows_mag):
            inner = step(self.method, state.inner, sample)
            astray = 0.0
            if usable and _at_rest(sample, self.gravity):
                along = dot(up_in_body(output(self.method, inner, sample).attitude), sample.acc)
                # 0.9 < cos²(18.4°): nearer than any astray_angle, and the cosine is left for the rare case
                if along < 0.0 or along * along < 0.9 * dot(sample.acc, sample.acc):
                    off = along < cos(self.astray_angle) * norm(sample.acc)
                    astray = state.astray + dt if off else 0.0
            lost = astray > self.astray_time
            if not lost:
                flags |= 0 if state.aligned else HEADING_ARBITRARY
                return State(
                    inner, gyr, True, state.aligned, mag_seen, False,
                    gyr_absent, acc_absent, mag_absent, astray, 0, flags,
                )  # fmt: skip

        # From here on the method does not step: it waits for samples to start from, or starts.
        before = output(self.method, state.inner, sample)
        if (not state.started or lost) and not usable:
            flags |= (LOST if state.started else INITIALISING) | (0 if state.aligned else HEADING_ARBITRARY)
            return State(
                state.inner, gyr, state.started, state.aligned, mag_seen, lost,
                gyr_absent, acc_absent, mag_absent, 0.0, 0, flags,
            )  # fmt: skip
        if state.started:
            flags |= RESET
            sample = _restart(self, before.attitude, sample, lost)
        inner = restart(self.method, state.inner, sample, before.bias)  # from the placeholder too: what it knew stays
        kept = state.aligned and (not state.mag_seen or not self.follows_mag)
        aligned = kept if state.started and not self.follows_mag else has_mag or (state.started and kept)
        flags |= 0 if aligned else HEADING_ARBITRARY
        return State(inner, gyr, True, aligned, mag_seen, False, gyr_absent, acc_absent, mag_absent, 0.0, 0, flags)

    def output(self, state: State, sample: Sample) -> Output:
        """What the method says; it sees the rate, not the other sensors, which it had in ``step``."""
        out = output(self.method, state.inner, with_sensors(sample, state.gyr, ABSENT, ABSENT))
        attitude = out.attitude if state.started else Quat(ABSENT.x, ABSENT.x, ABSENT.x, ABSENT.x)
        return Output(out.dt, attitude, out.rate, out.bias, out.sigma, out.bias_sigma, out.flags | state.flags)


@compiled
def _held(guard: Guard, state: State) -> State:
    """A row without a usable stamp: nothing moves, and too many of them lose the attitude."""
    disorder = state.disorder + 1
    flags = TIME_DISORDER | (0 if state.aligned else HEADING_ARBITRARY)
    if not state.started:
        flags |= INITIALISING
    elif state.lost or disorder > guard.longest_disorder:
        flags |= LOST
    return State(
        state.inner, state.gyr, state.started, state.aligned, state.mag_seen, state.lost,
        state.gyr_absent, state.acc_absent, state.mag_absent, state.astray, disorder, flags,
    )  # fmt: skip


@compiled
def _restart(guard: Guard, attitude: Quat, sample: Sample, lost: bool) -> Sample:
    """The sample to start anew from: what is known of tilt and heading stays, the rest is the sample's.

    After a loss the tilt is the accelerometer's; a first magnetometer sample changes the heading only, and that of a
    method without magnetometer stays what it was.
    """
    if lost:
        attitude = shortest_turn(unit(rotate(attitude, sample.acc)), UP) * attitude
    rest = resting_sample(attitude, guard.declination)
    mag = sample.mag if guard.follows_mag and present(sample.mag) else rest.mag
    return with_sensors(sample, sample.gyr, rest.acc, mag)


@compiled
def _at_rest(sample: Sample, gravity: float) -> bool:
    """No turning, and the length of gravity: an acceleration could then tilt the specific force by 18° at most."""
    least, most = (1.0 - _REST_FORCE) * gravity, (1.0 + _REST_FORCE) * gravity
    return within(sample.gyr, _REST_RATE) and least * least < dot(sample.acc, sample.acc) < most * most


@compiled
def _cleaned(guard: Guard, sample: Sample, acc_absent: float, mag_absent: float) -> Sample:
    """The sample with everything that is no measurement made absent; zeros point nowhere."""
    gyr = sample.gyr if dot(sample.gyr, sample.gyr) <= guard.largest_gyr**2 else ABSENT  # NaN is not
    acc = sample.acc if 1e-6 < dot(sample.acc, sample.acc) <= guard.largest_acc**2 else ABSENT
    mag = sample.mag if 1e-18 < dot(sample.mag, sample.mag) <= guard.largest_mag**2 else ABSENT
    dt = sample.dt
    acc_dt, mag_dt = min(acc_absent + dt, guard.gap), min(mag_absent + dt, guard.gap)
    return Sample(dt, gyr, acc, mag, sample.acc_age, sample.mag_age, acc_dt, mag_dt)
