"""SelfCalibrating."""

from __future__ import annotations

from math import atan2, cos, pi, radians, sin, sqrt
from typing import Annotated, NamedTuple

import numpy as np

from poise.data.flags import REST
from poise.data.packet import Output, Sample
from poise.estimators.self_calibrating.model import (
    BIAS,
    DELAY,
    FIELD,
    IRON,
    SCALE,
    SIZE,
    TURN,
    VELOCITY,
    Floats,
    Noise,
    correct,
    grow,
    measure_one,
    symmetrise,
)
from poise.math.compiled import compiled
from poise.math.matrices import Mat3, matrix, transpose
from poise.math.quaternions import Quat, attitude_of, exp, normalize, renormalized
from poise.math.vectors import ABSENT, ZERO, Vec3, cross, dot, norm, present, within

_NO_TURN = Mat3(ZERO, ZERO, ZERO)


class Sums(NamedTuple):
    """What a block adds up."""

    time: float  # s
    count: float  # samples
    rotation: Mat3  # S_R = Σ R dt
    force: Vec3  # S_f = Σ R f dt
    force_time: float  # s that specific force stands for
    gyr: Vec3  # Σ of the raw rate
    rate_square: float  # Σ |ω|²
    excess_square: float  # Σ |R f − g e_z|²
    mags: float  # magnetometer samples
    mag_time: float
    off: Vec3  # Σ R₀ (m − b − u); before the field is known Σ R m
    to_iron: Mat3  # Σ R₀
    to_delay: Vec3  # Σ R₀ (ω × u)


NOTHING = Sums(0.0, 0.0, _NO_TURN, ZERO, 0.0, ZERO, 0.0, 0.0, 0.0, 0.0, ZERO, _NO_TURN, ZERO)


class State(NamedTuple):
    attitude: Quat
    bias: Vec3
    rate: Vec3
    scale: Mat3
    velocity: Vec3
    field: Vec3
    iron: Vec3
    delay: float
    length: float  # of the field, in the magnetometer's unit; 0 while unknown
    spread: float  # s²
    over: float  # s
    rested: bool
    mean_gyr: Vec3
    mean_acc: Vec3
    still: float
    sums: Sums
    S_A: Floats  # (3, 9)
    P: Floats  # (24, 24)
    work: Floats  # (3, 24)


class SelfCalibrating(NamedTuple):
    """x"""

    block: Annotated[float, "s", "time between two updates of the covariance", (1e-3, 1.0)] = 0.05
    gyr_noise: Annotated[float, "rad/s/√Hz", "gyroscope white noise σ_g"] = 1e-4
    scale_noise: Annotated[float, "√s", "k: noise density per rate of what A does not explain"] = 1e-4
    bias_walk_rest: Annotated[float, "rad/s/√s", "random walk of the bias at rest"] = 2e-6
    bias_walk: Annotated[float, "rad/s/√s", "random walk of the bias in motion"] = 2e-4
    motion_bias: Annotated[float, "rad/s", "how far the bias in motion is from that at rest"] = 0.0
    centre: Annotated[float, "1", "x"] = 0.0
    coning: Annotated[float, "1", "x"] = 0.0
    acc_noise: Annotated[float, "m/s²/√Hz", "accelerometer noise σ_v"] = 0.01
    motion_noise: Annotated[float, "√s", "κ: noise density per specific force beyond gravity"] = 0.01
    speed: Annotated[float, "m/s·√s", "how far the pseudo-velocity strays from 0"] = 0.3
    speed_tail: Annotated[float, "1", "ν of the Student-t distribution that it has", (0.1, 1e6)] = 1e4
    field_walk: Annotated[float, "1/√s", "random walk of the field's north and up"] = 3e-5
    iron_walk: Annotated[float, "1/√s", "random walk of the hard iron"] = 1e-3
    field_time: Annotated[float, "s", "how long an error of the field lasts"] = 3.0
    spread_time: Annotated[float, "s", "over which the field's errors are averaged"] = 10.0
    mag_rate_noise: Annotated[float, "s", "magnetometer error per rate"] = 1e-3
    rest_noise: Annotated[float, "rad/s", "mean rate of a block at rest about the bias"] = 3e-4
    rest_speed: Annotated[float, "m/s", "pseudo-velocity at rest"] = 0.01
    initial_scale: Annotated[float, "1", "A at the start"] = 0.004
    initial_delay: Annotated[float, "s", "tau0"] = 0.008
    initial_delay_sigma: Annotated[float, "s", "tau0 sigma"] = 0.008
    initial_iron: Annotated[float, "1", "hard iron at start"] = 1e-3
    jump_nis: Annotated[float, "1", "nis"] = 1e9
    jump_time: Annotated[float, "s", "time"] = 0.1
    jump_iron: Annotated[float, "1", "how far"] = 2.0
    sure_tilt: Annotated[float, "rad", "x"] = radians(2.0)
    gravity: Annotated[float, "m/s²", "length of gravity", (0.1, 100.0)] = 9.80665
    declination: Annotated[float, "rad", "true heading = magnetic heading + D, east positive", (-pi, pi)] = 0.0

    @property
    def learns_bias(self) -> bool:
        return True

    def start(self, sample: Sample, bias: Vec3) -> State:
        attitude = attitude_of(sample.acc, sample.mag, self.declination)
        P = np.zeros((SIZE, SIZE))
        for k in range(2):
            P[TURN + k, TURN + k] = radians(5.4) ** 2
            P[FIELD + k, FIELD + k] = 0.25
        P[TURN + 2, TURN + 2] = radians(60.0) ** 2
        for k in range(3):
            P[BIAS + k, BIAS + k] = radians(1.0) ** 2
            P[VELOCITY + k, VELOCITY + k] = 1.0
            P[IRON + k, IRON + k] = self.initial_iron**2
        for k in range(9):
            P[SCALE + k, SCALE + k] = self.initial_scale**2
        P[DELAY, DELAY] = self.initial_delay_sigma**2
        return State(
            attitude, bias, ZERO, _NO_TURN, ZERO, ZERO, ZERO, self.initial_delay, 0.0, 1e-4, 0.0, False,
            sample.gyr, sample.acc, 0.0, NOTHING, np.zeros((3, 9)), P, np.zeros((3, SIZE)),
        )  # fmt: skip

    def step(self, state: State, sample: Sample) -> State:
        T, f, m = sample.dt, sample.acc, sample.mag
        # Strapdown
        g = sample.gyr - state.bias
        turned: Vec3 = state.scale @ g
        w = g + turned
        c = self.centre
        mid = (1.0 - 0.5 * c) * w + 0.5 * c * state.rate
        q = renormalized(state.attitude * exp(T * mid + (self.coning * T * T / 12.0) * cross(state.rate, w)))
        R = matrix(q)

        # Rest
        share = T / (0.5 + T)
        mean_gyr = state.mean_gyr + share * (sample.gyr - state.mean_gyr)
        still = within(sample.gyr - mean_gyr, 0.035) and within(mean_gyr, 0.035)
        mean_acc = state.mean_acc

        # Sums
        s = state.sums
        S_A = state.S_A
        for i in range(3):
            row = R.x if i == 0 else (R.y if i == 1 else R.z)
            gx, gy, gz = T * g.x, T * g.y, T * g.z
            S_A[i, 0] += row.x * gx
            S_A[i, 1] += row.x * gy
            S_A[i, 2] += row.x * gz
            S_A[i, 3] += row.y * gx
            S_A[i, 4] += row.y * gy
            S_A[i, 5] += row.y * gz
            S_A[i, 6] += row.z * gx
            S_A[i, 7] += row.z * gy
            S_A[i, 8] += row.z * gz
        force, force_time, excess = s.force, s.force_time, s.excess_square
        if present(f):
            mean_acc = mean_acc + share * (f - mean_acc)
            still = still and within(f - mean_acc, 0.5)
            F: Vec3 = R @ f
            force = force + sample.acc_dt * F
            force_time += sample.acc_dt
            beyond = F - Vec3(0.0, 0.0, self.gravity)
            excess += dot(beyond, beyond)
        mags, mag_time, off, to_iron, to_delay = s.mags, s.mag_time, s.off, s.to_iron, s.to_delay
        if present(m):
            mags += 1.0
            mag_time += sample.mag_dt
            if state.length > 0.0:
                q0 = q * exp((-state.delay) * w)
                R0 = matrix(q0)
                u: Vec3 = transpose(R0) @ state.field
                left: Vec3 = R0 @ (m / state.length - state.iron - u)
                late: Vec3 = R0 @ cross(w, u)
                off, to_iron, to_delay = off + left, to_iron + R0, to_delay + late
            else:
                inside: Vec3 = R @ m
                off = off + inside
        sums = Sums(
            s.time + T, s.count + 1.0, s.rotation + T * R, force, force_time, s.gyr + sample.gyr,
            s.rate_square + dot(w, w), excess, mags, mag_time, off, to_iron, to_delay,
        )  # fmt: skip
        after = State(
            q, state.bias, w, state.scale, state.velocity, state.field, state.iron, state.delay, state.length,
            state.spread, state.over, state.rested, mean_gyr, mean_acc, state.still + T if still else 0.0, sums, S_A, state.P, state.work,
        )  # fmt: skip
        if sums.time < self.block - 0.5 * T:
            return after
        return block_closed(self, after)

    def output(self, state: State, sample: Sample) -> Output:
        P = state.P
        sigma = Vec3(sqrt(P[0, 0]), sqrt(P[1, 1]), sqrt(P[2, 2]))
        bias_sigma = Vec3(sqrt(P[3, 3]), sqrt(P[4, 4]), sqrt(P[5, 5]))
        return Output(
            sample.dt, state.attitude, state.rate, state.bias, sigma, bias_sigma, REST if state.still >= 1.5 else 0
        )


@compiled
def block_closed(method: SelfCalibrating, state: State) -> State:
    P, work, s, S_A = state.P, state.work, state.sums, state.S_A
    T, mean_rate_square = s.time, s.rate_square / s.count
    rest = state.still >= 1.5
    walk = method.bias_walk_rest if rest else method.bias_walk
    noise = Noise(
        (method.gyr_noise**2 + method.scale_noise**2 * mean_rate_square) * T,
        walk**2 * T,
        (method.acc_noise**2 + method.motion_noise**2 * s.excess_square / s.count) * T,
        method.field_walk**2 * T,
        method.iron_walk**2 * T,
    )
    grow(P, s.rotation, S_A, s.force, noise)
    if state.rested and not rest:
        for k in range(3):
            P[BIAS + k, BIAS + k] += method.motion_bias**2
    v = state.velocity + s.force - Vec3(0.0, 0.0, method.gravity * s.force_time)
    x = work[1]
    for j in range(SIZE):
        x[j] = 0.0
    for i in range(3):
        for k in range(9):
            S_A[i, k] = 0.0
    # 1. rest
    if rest:
        off = (1.0 / s.count) * s.gyr - state.bias
        at_rest = method.rest_noise**2 * (0.05 / T)
        measure_one(P, work, BIAS, off.x, at_rest)
        measure_one(P, work, BIAS + 1, off.y, at_rest)
        measure_one(P, work, BIAS + 2, off.z, at_rest)
    # 2. pseudo-velocity
    if s.force_time > 0.0:
        wide = method.rest_speed**2 * (0.05 / T) if rest else method.speed**2 / T
        for k in range(3):
            r = -(v.x if k == 0 else (v.y if k == 1 else v.z))
            R = wide
            if not rest:
                left = r - x[VELOCITY + k]
                nis = left * left / (P[VELOCITY + k, VELOCITY + k] + wide)
                R = wide * (method.speed_tail + nis) / (method.speed_tail + 1.0)
            measure_one(P, work, VELOCITY + k, r, R)
    # 3. magnetometer
    q, field, length, spread, over = state.attitude, state.field, state.length, state.spread, state.over
    if s.mags > 0.0:
        e = (1.0 / s.mags) * s.off
        if length == 0.0:
            length = norm(e)
            level = sqrt(e.x * e.x + e.y * e.y) / length
            turn = atan2(e.x, e.y) - method.declination
            field = Vec3(0.0, level, e.z / length)
            q = exp(Vec3(0.0, 0.0, turn)) * q
        else:
            share = T / (method.spread_time + T)
            spread += share * (min(dot(e, e) / 3.0, 9.0 * spread) - spread)
            R = (method.field_time * spread + 0.05 * method.mag_rate_noise**2 * mean_rate_square) / s.mag_time
            unsure = P[0, 0] + P[1, 1] > 2.0 * method.sure_tilt**2
            H_b, H_t = (1.0 / s.mags) * s.to_iron, (1.0 / s.mags) * s.to_delay
            nis = 0.0
            h = work[0]
            for k in range(3):
                for j in range(SIZE):
                    h[j] = 0.0
                row = H_b.x if k == 0 else (H_b.y if k == 1 else H_b.z)
                h[IRON], h[IRON + 1], h[IRON + 2] = row.x, row.y, row.z
                if k == 0:
                    h[TURN + 2] = field.y
                    if unsure:
                        h[TURN + 1] = -field.z
                    h[DELAY] = H_t.x
                    nis += correct(P, work, e.x, R)
                elif k == 1:
                    h[FIELD] = 1.0
                    if unsure:
                        h[TURN] = field.z
                    h[DELAY] = H_t.y
                    nis += correct(P, work, e.y, R)
                else:
                    h[FIELD + 1] = 1.0
                    if unsure:
                        h[TURN] = -field.y
                    h[DELAY] = H_t.z
                    nis += correct(P, work, e.z, R)
            over = over + T if nis > method.jump_nis else 0.0
            if over > method.jump_time:
                over = 0.0
                for k in range(3):
                    P[IRON + k, IRON + k] += method.jump_iron**2
    symmetrise(P)
    q = normalize(exp(Vec3(x[0], x[1], x[2])) * q)
    A = state.scale
    scale = Mat3(
        A.x + Vec3(x[SCALE], x[SCALE + 1], x[SCALE + 2]),
        A.y + Vec3(x[SCALE + 3], x[SCALE + 4], x[SCALE + 5]),
        A.z + Vec3(x[SCALE + 6], x[SCALE + 7], x[SCALE + 8]),
    )
    return State(
        q,
        state.bias + Vec3(x[BIAS], x[BIAS + 1], x[BIAS + 2]),
        state.rate,
        scale,
        v + Vec3(x[VELOCITY], x[VELOCITY + 1], x[VELOCITY + 2]),
        field + Vec3(0.0, x[FIELD], x[FIELD + 1]),
        state.iron + Vec3(x[IRON], x[IRON + 1], x[IRON + 2]),
        state.delay + x[DELAY],
        length, spread, over, rest, state.mean_gyr, state.mean_acc, state.still, NOTHING, S_A, P, work,
    )  # fmt: skip
