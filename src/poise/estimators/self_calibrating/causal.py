"""SelfCalibrating: an error-state Kalman filter that learns its sensors while it runs.

Source: our own, from published parts. Strapdown at every sample, covariance and corrections once per block (Savage 1998);
gravity as a pseudo-velocity that stays near zero; gyroscope scale, misalignment and the magnetometer's delay and hard iron as
states. Steps are numbered as in ``docs/methods/self-calibrating.md``, which derives them.

Departures from the print: there is none; what was tried and left out stands on that page.
"""

from __future__ import annotations

from math import pi, radians, sqrt
from typing import Annotated, NamedTuple

import numpy as np

from poise.data.flags import (
    ANOTHER_FIELD,
    GYR_CLIPPED,
    HARD_IRON,
    HEADING_UNPROVEN,
    MAG_DISTURBED,
    RESET,
    REST,
    UNSETTLED,
)
from poise.data.learned import Learned
from poise.data.packet import Output, Sample
from poise.estimators.self_calibrating.another_field import forget_field
from poise.estimators.self_calibrating.block import closed
from poise.estimators.self_calibrating.covariance import enter_block, forget
from poise.estimators.self_calibrating.delay import note_interval
from poise.estimators.self_calibrating.first_block import in_motion, level, so_far
from poise.estimators.self_calibrating.leans import put_rested
from poise.estimators.self_calibrating.learned import check_start, doubts, iron_from_before, take_over, without_iron
from poise.estimators.self_calibrating.learned import learned as known_by_now
from poise.estimators.self_calibrating.lengths import add_length
from poise.estimators.self_calibrating.model import (
    ACC_BIAS,
    ACC_DELAY,
    ACC_SCALE,
    ANOTHER_IRON,
    ANOTHER_NORTH,
    BEGAN,
    BEGUN_ANEW,
    BIAS,
    COLUMNS,
    ENTRY,
    FIELD,
    FORCE,
    HEADING_SET,
    IN_MOTION,
    IRON,
    JUST_FOUND,
    LENGTHS,
    MAG_DELAY,
    NOTHING,
    OPEN,
    ROWS,
    SCALE,
    SENSOR,
    SHAKEN,
    SUMS,
    TURN,
    TURNING,
    UNPROVEN,
    VELOCITY,
    Floats,
    Sensor,
    State,
    Sums,
    add_turned,
    begin_block,
    put,
    put_sensor,
    put_sums,
    sensor_of,
    sums_of,
    vector,
)
from poise.estimators.self_calibrating.sampled import clipped_columns, turned_back
from poise.estimators.self_calibrating.unproven import ANY, begin_open
from poise.estimators.self_calibrating.watch import forget_watch, settled
from poise.math.compiled import compiled
from poise.math.matrices import I3, Mat3, matrix, transpose
from poise.math.quaternions import attitude_of, exp, renormalized, rotate
from poise.math.vectors import UP, ZERO, Vec3, cross, dot, norm, present, within

_FIRST_SPREAD = 1e-4  # (share of the field)², before any has been measured
_FIRST_WANDER = 0.04  # (m/s)²


class SelfCalibrating(NamedTuple):
    """Our flagship: learns bias, scale, misalignment, hard iron and delays of its sensors, and says how sure it is."""

    block: Annotated[float, "s", "time between two corrections", (1e-3, 1.0)] = 0.08
    gyr_noise: Annotated[float, "rad/s/√Hz", "gyroscope white noise σ_g", (0.0, 10.0)] = 1e-4
    scale_noise: Annotated[float, "√s", "k: noise per rate, of what A does not explain", (0.0, 10.0)] = 1e-4
    bias_walk: Annotated[float, "rad/s/√s", "random walk of the bias in motion", (0.0, 10.0)] = 1.4e-4
    bias_walk_rest: Annotated[float, "rad/s/√s", "random walk of the bias at rest", (0.0, 10.0)] = 2e-6
    acc_noise: Annotated[float, "m/s²/√Hz", "accelerometer noise σ_v", (1e-9, 1e3)] = 0.01
    motion_noise: Annotated[float, "√s", "κ: noise per specific force beyond gravity", (0.0, 1e3)] = 0.01
    shock_noise: Annotated[
        float, "1", "share of a change of the specific force that a shock between two samples may be", (0.0, 1e3)
    ] = 0.3
    speed: Annotated[float, "m/s·√s", "how far the pseudo-velocity strays from 0, over one second", (1e-6, 1e6)] = 0.2
    speed_time: Annotated[float, "s", "how long a velocity lasts, that it has in motion", (0.0, 1e6)] = 0.4
    fastest: Annotated[float, "m/s", "largest velocity that is believed to last, RMS of an axis", (1e-3, 1e6)] = 2.0
    field_time: Annotated[float, "s", "how long an error of the field lasts", (1e-3, 1e6)] = 2.5
    spread_time: Annotated[float, "s", "over which errors of the field, and velocities, are averaged", (1e-3, 1e6)] = (
        10.0
    )
    mag_rate_noise: Annotated[float, "s", "error of the field per rate of turn", (0.0, 10.0)] = 1e-3
    field_walk: Annotated[float, "1/√s", "random walk of the field's north and up, in lengths of it", (0.0, 10.0)] = (
        3e-5
    )
    iron_walk: Annotated[float, "1/√s", "random walk of the hard iron, in lengths of the field", (0.0, 10.0)] = 1e-3
    local_field: Annotated[float, "rad", "how far magnetic north here may be from that of the region", (0.0, pi)] = (
        radians(1.5)
    )
    level_error: Annotated[float, "rad", "how far the accelerometer's own up is off, beside its bias", (0.0, pi)] = (
        radians(0.25)
    )
    time_error: Annotated[float, "s", "how far the attitude's instant is off: delays in the gyroscope", (0.0, 1.0)] = (
        0.002
    )
    initial_tilt: Annotated[float, "rad", "σ of pitch and roll at the start", (1e-6, 10.0)] = radians(5.4)
    initial_heading: Annotated[float, "rad", "σ of the heading at the start", (1e-6, 10.0)] = radians(60.0)
    initial_bias: Annotated[float, "rad/s", "σ of the gyroscope's bias at the start", (1e-9, 10.0)] = radians(1.0)
    initial_scale: Annotated[float, "1", "σ of each element of A at the start", (0.0, 1.0)] = 0.003
    initial_acc_bias: Annotated[float, "m/s²", "σ of the accelerometer's bias at the start, per axis", (0.0, 10.0)] = (
        0.03
    )
    initial_acc_scale: Annotated[
        float, "1", "σ of the accelerometer's scale at the start: that of gravity's length", (0.0, 1.0)
    ] = 0.03
    acc_bias_walk: Annotated[float, "m/s²/√s", "random walk of the accelerometer's bias", (0.0, 10.0)] = 1e-4
    initial_iron: Annotated[float, "1", "σ of the hard iron at the start, in lengths of the field", (0.0, 10.0)] = 3e-3
    least_iron: Annotated[
        float,
        "1",
        "a hard iron that the field shows is taken over from that size on, in lengths of it; none from 1 on",
        (0.0, 1e6),
    ] = 0.04
    mag_delay: Annotated[float, "s", "expected delay of the magnetometer behind the gyroscope", (-1.0, 1.0)] = 0.008
    mag_delay_sigma: Annotated[float, "s", "σ of that delay", (0.0, 1.0)] = 0.008
    acc_delay_sigma: Annotated[
        float, "s", "σ of the accelerometer's delay, beside that of its share of a sampling interval", (0.0, 1.0)
    ] = 0.0005
    rest_time: Annotated[float, "s", "how long the sensor must hold still before that counts as rest"] = 1.5
    rest_gyr: Annotated[
        float, "rad/s", "largest mean rate, or distance of it from the bias, and of a sample from it, at rest, per axis"
    ] = radians(2.0)
    rest_acc: Annotated[float, "m/s²", "largest distance of a still specific force from its mean, per axis"] = 0.5
    rest_noise: Annotated[float, "rad/s", "how far a block's mean rate at rest is from the bias", (1e-9, 10.0)] = 3e-4
    rest_speed: Annotated[float, "m/s", "pseudo-velocity of a block at rest", (1e-9, 1e3)] = 0.01
    watch_time: Annotated[
        float, "s", "over which the mean specific force must stand upright; longer than motions", (0.1, 1e6)
    ] = 5.0
    watch_tilt: Annotated[
        float, "rad", "a mean further off, beside what motion explains, means that the bias has changed", (1e-3, 10.0)
    ] = radians(1.5)
    watch_heading: Annotated[
        float, "rad", "a field turned further, with its dip and length, means the same", (1e-3, 10.0)
    ] = radians(12.0)
    level_time: Annotated[float, "s", "of samples that a start in motion is levelled by", (0.1, 100.0)] = 3.0
    sure_tilt: Annotated[
        float, "rad", "the magnetometer corrects the tilt too while that is less sure", (0.0, 10.0)
    ] = radians(2.0)
    gyr_range: Annotated[float, "rad/s", "end of the gyroscope's range: rates from 98 % of it on are clipped"] = (
        radians(2000.0)
    )
    log: Annotated[
        int, "blocks", "room for what `smooth` goes back over; it sets this itself, leave it at 0", (0, 1e6)
    ] = 0
    lead: Annotated[float, "s", "the attitude given out is that of now + lead", (-1.0, 1.0)] = 0.0
    gravity: Annotated[float, "m/s²", "length of gravity g", (0.1, 100.0)] = 9.80665
    declination: Annotated[float, "rad", "true heading = magnetic heading + D, east positive", (-pi, pi)] = 0.0

    @property
    def learns_bias(self) -> bool:
        """It does, in motion too: RestBias would take from it what it is to find."""
        return True

    def start(self, sample: Sample, bias: Vec3) -> State:
        """1. Attitude of the first acc and mag; everything else at what is expected of a sensor."""
        P = np.zeros((ROWS + ENTRY * self.log, COLUMNS))
        forget(P, BIAS, 3, self.initial_bias**2)
        forget(P, SCALE, 9, self.initial_scale**2)
        forget(P, FIELD, 2, 0.25)
        forget(P, IRON, 3, self.initial_iron**2)
        forget(P, MAG_DELAY, 1, self.mag_delay_sigma**2)
        forget(P, ACC_DELAY, 1, self.acc_delay_sigma**2)
        forget(P, ACC_BIAS, 3, self.initial_acc_bias**2)
        forget(P, ACC_SCALE, 1, self.initial_acc_scale**2)
        unsure_attitude(self, P)
        begin_open(P, self.least_iron)
        if present(sample.mag) and float(P[OPEN, 0]) > 0.0:
            P[OPEN, UNPROVEN] = 1.0
        if not within(sample.gyr - bias, TURNING) or abs(norm(sample.acc) - self.gravity) > SHAKEN * self.gravity:
            forget(P, TURN, 2, (IN_MOTION * self.initial_tilt) ** 2)
        none = Mat3(ZERO, ZERO, ZERO)
        put_sensor(P, Sensor(none, ZERO, ZERO, ZERO, self.mag_delay, 0.0, 0.0, _FIRST_SPREAD, _FIRST_WANDER, ZERO, 0.0))
        attitude = attitude_of(sample.acc, sample.mag, 0.0)
        return State(attitude, bias, ZERO, sample.gyr, sample.acc, 0.0, 0.0, False, P)

    def restart(self, state: State, sample: Sample, bias: Vec3) -> State:
        """Attitude from acc and mag anew; what was learned of the sensors, the bias too, stays."""
        P = state.P
        known, iron = sensor_of(P), ZERO
        if dot(known.iron, known.iron) > self.least_iron**2:
            iron = known.length * known.iron
            if known.length < 0.0:
                iron = iron_from_before(known.iron, -known.length, sample.mag, I3)
        unsure_attitude(self, P)
        if state.begun:
            forget(P, TURN, 2, (IN_MOTION * self.initial_tilt) ** 2)  # it may well be in motion
            enter_block(P, NOTHING, BEGUN_ANEW, self.gravity)
        begin_block(P)
        forget_watch(P)
        put_rested(P, False)
        put(P, SENSOR, 9, ZERO)
        put(P, SENSOR, FORCE, ZERO)
        put(P, LENGTHS, BEGAN, ZERO)
        forget_field(P)
        if known.length != 0.0 and self.least_iron < ANY:
            P[OPEN, UNPROVEN] = 1.0
        attitude = attitude_of(sample.acc, sample.mag - iron, 0.0)
        return State(attitude, state.bias, ZERO, sample.gyr, sample.acc, 0.0, 0.0, state.begun, P)

    def step(self, state: State, sample: Sample) -> State:
        T, f, m, P = sample.dt, sample.acc, sample.mag, state.P
        s, known = sums_of(P), sensor_of(P)

        # 2. Strapdown
        g = sample.gyr - state.bias
        more: Vec3 = known.scale @ g
        w = g + more
        q = renormalized(state.attitude * exp(T * w))
        R = matrix(q)

        # 3. What the block adds up
        resting = state.still >= self.rest_time
        if not resting:  # what turns a sensor at rest is noise, and shows nothing of A, nor of a delay
            add_turned(P, R, T * g)
        clipped = s.clipped
        if not within(sample.gyr, 0.98 * self.gyr_range):
            clipped = clipped + T * clipped_columns(R, sample.gyr, 0.98 * self.gyr_range)
        share = T / (0.5 + T)
        mean_gyr = state.mean_gyr + share * (sample.gyr - state.mean_gyr)
        calm = within(sample.gyr - mean_gyr, self.rest_gyr)
        slow = within(mean_gyr, self.rest_gyr) or within(mean_gyr - state.bias, self.rest_gyr)
        mean_acc = state.mean_acc
        force, force_late, force_time, excess, jumps = (
            s.force, s.force_late, s.force_time, s.excess_square, s.jump_square,
        )  # fmt: skip
        if present(f):
            mean_acc = mean_acc + sample.acc_dt / (0.5 + sample.acc_dt) * (f - mean_acc)
            calm = calm and within(f - mean_acc, self.rest_acc)
            f = (1.0 + known.acc_scale) * (f - known.acc_bias)
            before = vector(P, SENSOR, FORCE)
            jump = f - before if before != ZERO else ZERO
            put(P, SENSOR, FORCE, f)
            jumps += sample.acc_dt * sample.acc_dt * dot(jump, jump)
            earth: Vec3 = R @ turned_back(f, w, known.acc_delay)
            force = force + sample.acc_dt * earth
            if not resting:
                moved: Vec3 = R @ cross(w, f)
                force_late = force_late - sample.acc_dt * moved
            force_time += sample.acc_dt
            note_interval(P, sample.acc_dt, T)
            beyond = earth - self.gravity * UP
            rows = sample.acc_dt / T if T > 0.0 else 1.0  # that it stands for: an accelerometer may be slower
            excess += rows * dot(beyond, beyond)
        mags, mag_time, off, to_iron, to_delay = s.mags, s.mag_time, s.off, s.to_iron, s.to_delay
        if present(m):
            add_length(P, m)
            mags, mag_time = mags + 1.0, mag_time + sample.mag_dt
            if known.length > 0.0:
                u: Vec3 = transpose(R) @ known.field
                left: Vec3 = R @ turned_back(m / known.length - known.iron, w, known.mag_delay)
                late: Vec3 = R @ cross(w, u)
                off, to_iron = off + left - known.field, to_iron + R
                if not resting:
                    to_delay = to_delay + late
            else:
                seen: Vec3 = R @ m
                off, to_iron = off + seen, to_iron + R
        sums = Sums(
            s.time + T, s.samples + 1.0, s.rotation + T * R, force, force_late, force_time, s.gyr + sample.gyr,
            s.rate_square + dot(w, w), excess, jumps, mags, mag_time, off, to_iron, to_delay, clipped,
            s.unmeasured + sample.turn_variance,
        )  # fmt: skip
        seconds = state.calm + T if calm else 0.0
        still = state.still + T if calm and slow else 0.0
        ends = sums.time >= self.block - 0.5 * T if state.begun else level(self, P, sums, T, seconds)
        if not ends:
            put_sums(P, sums)
            return State(q, state.bias, w, mean_gyr, mean_acc, seconds, still, state.begun, P)
        return closed(self, State(q, state.bias, w, mean_gyr, mean_acc, seconds, still, state.begun, P), sums, known)

    def output(self, state: State, sample: Sample) -> Output:
        """The attitude, after *lead*, with true north; sigma about the Earth's axes from P and what P cannot know."""
        q = state.attitude
        starting = not state.begun and in_motion(self, state.P)
        if starting and self.log == 0:  # `smooth` turns them itself
            q = so_far(q, sums_of(state.P))
        if self.lead != 0.0:
            q = q * exp(self.lead * state.rate)
        if self.declination != 0.0:
            q = exp(-self.declination * UP) * q
        P = state.P
        north = self.local_field**2 if float(P[SENSOR, 20]) > 0.0 else 0.0
        turned, level = self.time_error * rotate(q, state.rate), self.level_error**2
        sigma = Vec3(
            _sigma(float(P[0, 0]) + level + turned.x * turned.x),
            _sigma(float(P[1, 1]) + level + turned.y * turned.y),
            _sigma(float(P[2, 2]) + north + turned.z * turned.z),
        )
        bias_sigma = Vec3(sqrt(float(P[3, 3])), sqrt(float(P[4, 4])), sqrt(float(P[5, 5])))
        flags = REST if state.still >= self.rest_time else 0
        if float(P[SENSOR, 21]) > 0.05**2:
            flags |= MAG_DISTURBED
        if starting or not settled(P):
            flags |= UNSETTLED
        if not within(sample.gyr, 0.98 * self.gyr_range):
            flags |= GYR_CLIPPED
        if float(P[OPEN, UNPROVEN]) != 0.0:
            flags |= HEADING_UNPROVEN
        if float(P[SUMS, 1]) == 0.0:  # a block has ended with this row
            flags |= RESET if float(P[SUMS + 1, HEADING_SET]) != 0.0 else 0
            flags |= HARD_IRON if float(P[SUMS + 1, JUST_FOUND]) == ANOTHER_IRON else 0
            flags |= ANOTHER_FIELD if float(P[SUMS + 1, JUST_FOUND]) == ANOTHER_NORTH else 0
        if self.log > 0:  # which entry of the log the row stands behind
            flags |= (int(P[SENSOR, 22]) & 0x3) << 30
        return Output(sample.dt, q, state.rate, state.bias, sigma, bias_sigma, flags)

    def learned(self, state: State) -> Learned:
        """What is known of the sensors by now: see :func:`poise.estimators.self_calibrating.learned.learned`."""
        return known_by_now(state.bias, state.P)

    def check_start(self, learned: Learned) -> None:
        """Raises :class:`MethodError` where it cannot start from *learned*."""
        check_start(learned)

    def cleared(self, mag: Floats, learned: Learned) -> Floats:
        """The first sample of the magnetometer (3,), without the hard iron that is *learned*, if it is to be carried."""
        return without_iron(mag, learned, self.least_iron)

    def start_from(self, state: State, learned: Learned) -> None:
        """Go on from *learned*, that of the same sensor, in a state that has begun with its bias."""
        take_over(state.P, learned, self.initial_iron, self.least_iron)

    def doubts(self, before: Learned, after: Learned) -> list[str]:
        """What speaks against *before*, which it started from, being of the sensor of *after*: a sentence each."""
        return doubts(before, after)


@compiled
def _sigma(variance: float) -> float:
    """rad; an angle of which nothing is known is not further off than half a turn."""
    return min(sqrt(variance), pi)


@compiled
def unsure_attitude(method: SelfCalibrating, P: Floats) -> None:
    """P of an attitude by one sample, and of a velocity of which nothing is known."""
    forget(P, TURN, 2, method.initial_tilt**2)
    forget(P, TURN + 2, 1, method.initial_heading**2)
    forget(P, VELOCITY, 3, 1.0)
