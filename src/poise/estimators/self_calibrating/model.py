"""What SelfCalibrating estimates, how its errors grow over a block, and how one measured number corrects them.

Errors, 25 numbers in this order, each true − estimated; the attitude's is a small turn ε about the Earth's axes,
R_true = Exp(ε) R: ε (3), gyroscope bias (3), gyroscope scale and misalignment A (9, by rows), pseudo-velocity v (3),
field h (north and up), hard iron (3), delay of the magnetometer and of the accelerometer behind the gyroscope.
Equation numbers are those of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.math.compiled import compiled
from poise.math.matrices import Mat3
from poise.math.quaternions import Quat
from poise.math.vectors import ZERO, Vec3

Floats = NDArray[np.float64]

# The errors' places.
TURN, BIAS, SCALE, VELOCITY, FIELD, IRON, MAG_DELAY, ACC_DELAY, SIZE = 0, 3, 6, 15, 18, 20, 23, 24, 25
# One table is the memory: P in its first 25 rows, then these. A NamedTuple of as many numbers would be copied at every step.
H, X, ROOM = 25, 26, 27  # of a correction: what is measured of the errors, their estimate, P h
TURNED = 28  # three rows: S_A = Σ R[:, i] g_j dt, column 3 i + j
SUMS, SENSOR, KEPT, LENGTHS, ROWS, COLUMNS = 31, 34, 35, 37, 38, 28  # two rows keep what was known before: recall.py
# iron.py keeps, behind the sums of the second row, a block's sums of m (3) and |m|², the turn that the heading was set by, and
# the m (3) of the last block that was taken. In the row of lengths, behind the means: how often an iron was found, the seconds
# since they were looked at, the turn (3) since the last block, the m (3) that the heading was set by, the seconds since.
SUMMED, HEADING_SET, TAKEN = 16, 20, 21
FOUND, LOOKED, TURNED_SINCE, BEGAN, ELAPSED = 18, 19, 20, 23, 26
# Behind that, where a smoother asked for it, one entry a block: P's rows of ε and bias after the corrections, what was
# injected, what the block added up, and each correction's h and P h. Column 25 of the entry's rows holds single numbers.
ENTRIES, ENTRY = ROWS, 28
INJECTED, ADDED, CORRECTIONS, MOST = 6, 7, 10, 9
ONE = SIZE  # the column of single numbers
GOES_ON, BEGUN_ANEW, ANOTHER_BIAS, ANOTHER_IRON = 0.0, 1.0, 2.0, 3.0  # what became, after a block, of what was known

_NONE = Mat3(ZERO, ZERO, ZERO)


class State(NamedTuple):
    """The method's state after a sample."""

    attitude: Quat  # body to Earth with magnetic north
    bias: Vec3  # rad/s
    rate: Vec3  # ω, rad/s
    mean_gyr: Vec3  # what stillness is judged against
    mean_acc: Vec3
    calm: float  # s that neither rate nor force have strayed from their means
    still: float  # s of that in which the mean rate could be the bias
    begun: bool  # a block has been closed
    P: Floats  # (38, 28): the errors' covariance and, below it, the rest of the memory: see ROWS


class Sums(NamedTuple):
    """What a block adds up, sample by sample; R is the attitude's matrix, dt the time a sample stands for."""

    time: float  # s
    samples: float
    rotation: Mat3  # S_R = Σ R dt
    force: Vec3  # S_f = Σ R f dt, at the accelerometer's instant
    force_late: Vec3  # ∂S_f/∂(delay of the accelerometer) = −Σ R (ω × f) dt
    force_time: float  # s of specific force
    gyr: Vec3  # Σ of the rate as measured
    rate_square: float  # Σ |ω|²
    excess_square: float  # Σ |R f − g e_z|² over the rows that it stands for
    mags: float  # magnetometer samples
    mag_time: float  # s that they stand for
    off: Vec3  # Σ R₀ (m − b − u), R₀ the attitude at the magnetometer's instant; Σ R m before the field is known
    to_iron: Mat3  # Σ R₀
    to_delay: Vec3  # Σ R₀ (ω × u)
    clipped: Mat3  # Σ R dt, of the columns whose rate was at the end of the range
    unmeasured: float  # rad²: Σ of the variance of what was turned unmeasured


class Sensor(NamedTuple):
    """What is known of the sensor and the place, beside the bias."""

    scale: Mat3  # A: ω = (I + A)(gyr − bias)
    velocity: Vec3  # m/s, pseudo
    field: Vec3  # h, in lengths of the field: east is 0
    iron: Vec3  # b, in lengths of the field, body frame
    mag_delay: float  # s behind the gyroscope
    acc_delay: float
    length: float  # of the field in the magnetometer's unit; 0 while unknown
    spread: float  # s²: mean square of the field's errors, per axis
    wander: float  # s_v², (m/s)²: mean square of the pseudo-velocity in motion, per axis


NOTHING = Sums(0.0, 0.0, _NONE, ZERO, ZERO, 0.0, ZERO, 0.0, 0.0, 0.0, 0.0, ZERO, _NONE, ZERO, _NONE, 0.0)


class Noise(NamedTuple):
    """Variances that a block adds (eq. 10)."""

    turn: float  # rad², about each axis
    bias: float  # (rad/s)²
    velocity: float  # (m/s)²
    field: float  # of a field of length 1
    iron: float


@compiled
def grow(P: Floats, sums: Sums, noise: Noise) -> None:
    """P ← F P Fᵀ + Q over a block, in place (eq. 9, 10).

    Only the rows of ε and v of F differ from the identity: ε⁺ = ε − S_R δb + S_A δA (eq. 7) and
    v⁺ = v − [S_f]× ε + S_l δτ_a (eq. 8). Of [S_f]× the column of the heading is left out: the pseudo-velocity is near 0 in
    every direction, so that a horizontal acceleration says nothing of the heading.
    """
    S_R = sums.rotation
    fx, fy, fz = sums.force
    lx, ly, lz = sums.force_late
    for j in range(SIZE):  # rows of v first: they take the old ε
        x, y, late = P[TURN, j], P[TURN + 1, j], P[ACC_DELAY, j]
        P[VELOCITY, j] += fz * y + lx * late
        P[VELOCITY + 1, j] += ly * late - fz * x
        P[VELOCITY + 2, j] += fy * x - fx * y + lz * late
    for i in range(3):
        row = S_R.x if i == 0 else (S_R.y if i == 1 else S_R.z)
        for j in range(SIZE):
            P[TURN + i, j] -= row.x * P[BIAS, j] + row.y * P[BIAS + 1, j] + row.z * P[BIAS + 2, j]
        for k in range(9):
            weight = P[TURNED + i, k]
            for j in range(SIZE):
                P[TURN + i, j] += weight * P[SCALE + k, j]
    # Then the columns. In a row that is none of the six, symmetry has the result already.
    for i in range(SIZE):
        if TURN + 3 <= i < VELOCITY or i >= FIELD:
            for k in range(3):
                P[i, TURN + k] = P[TURN + k, i]
                P[i, VELOCITY + k] = P[VELOCITY + k, i]
        else:
            x, y, z, late = P[i, TURN], P[i, TURN + 1], P[i, TURN + 2], P[i, ACC_DELAY]
            P[i, VELOCITY] += fz * y + lx * late
            P[i, VELOCITY + 1] += ly * late - fz * x
            P[i, VELOCITY + 2] += fy * x - fx * y + lz * late
            bx, by, bz = P[i, BIAS], P[i, BIAS + 1], P[i, BIAS + 2]
            x -= S_R.x.x * bx + S_R.x.y * by + S_R.x.z * bz
            y -= S_R.y.x * bx + S_R.y.y * by + S_R.y.z * bz
            z -= S_R.z.x * bx + S_R.z.y * by + S_R.z.z * bz
            for k in range(9):
                x += P[TURNED, k] * P[i, SCALE + k]
                y += P[TURNED + 1, k] * P[i, SCALE + k]
                z += P[TURNED + 2, k] * P[i, SCALE + k]
            P[i, TURN], P[i, TURN + 1], P[i, TURN + 2] = x, y, z
    for k in range(3):
        P[TURN + k, TURN + k] += noise.turn
        P[BIAS + k, BIAS + k] += noise.bias
        P[VELOCITY + k, VELOCITY + k] += noise.velocity
        P[IRON + k, IRON + k] += noise.iron
    P[FIELD, FIELD] += noise.field
    P[FIELD + 1, FIELD + 1] += noise.field


@compiled
def entry_row(P: Floats) -> int:
    """Where the present entry of the log begins; the count of finished entries is kept beside the sensor's numbers."""
    room: int = (P.shape[0] - ENTRIES) // ENTRY
    return ENTRIES + ENTRY * min(int(P[SENSOR, 22]) - int(P[SENSOR, 23]), room - 1)


@compiled
def enter_correction(P: Floats, residual: float, per_S: float) -> None:
    """What :func:`correct` is about to do, for the way back."""
    if P.shape[0] <= ROWS:
        return
    at = entry_row(P)
    n = int(P[at, ONE])
    if n == MOST:
        return
    row = at + CORRECTIONS + 2 * n
    for j in range(SIZE):
        P[row, j], P[row + 1, j] = P[H, j], P[ROOM, j]
    P[row, ONE], P[row + 1, ONE] = residual, per_S
    P[at, ONE] = n + 1.0


@compiled
def enter_block(P: Floats, s: Sums, event: float) -> None:
    """A block's entry is complete: P after the corrections, what was injected, what was added up."""
    if P.shape[0] <= ROWS:
        return
    at = entry_row(P)
    for i in range(6):
        for j in range(SIZE):
            P[at + i, j] = P[i, j]
    for j in range(SIZE):
        P[at + INJECTED, j] = P[X, j]
    for i in range(3):
        for k in range(9):
            P[at + ADDED + i, k] = P[TURNED + i, k]
    put_three(P, at + ADDED, 9, s.rotation)
    put(P, at + ADDED + 1, 9, s.force)
    put(P, at + ADDED + 2, 9, s.force_late)
    P[at + 1, ONE] = event
    P[SENSOR, 22] += 1.0
    P[entry_row(P), ONE] = 0.0


@compiled
def correct(P: Floats, residual: float, variance: float) -> None:
    """One measured number: K = P h/(hᵀ P h + R), x ← x + K (residual − hᵀ x), P ← P − K hᵀ P, in place (eq. 12).

    Rows H and X hold h and x; the correction is entered into the log. *residual* is measured − expected at x = 0.
    """
    for j in range(SIZE):
        P[ROOM, j] = 0.0
    for i in range(SIZE):
        weight = P[H, i]
        if weight != 0.0:
            residual -= weight * P[X, i]
            for j in range(SIZE):
                P[ROOM, j] += weight * P[i, j]
    S = variance
    for i in range(SIZE):
        S += P[H, i] * P[ROOM, i]
    per_S = 1.0 / S
    enter_correction(P, residual, per_S)
    for i in range(SIZE):
        gain = P[ROOM, i] * per_S
        P[X, i] += gain * residual
        for j in range(SIZE):
            P[i, j] -= gain * P[ROOM, j]


@compiled
def correct_one(P: Floats, at: int, residual: float, variance: float) -> None:
    """:func:`correct` where the number measured is one of the 25."""
    residual -= P[X, at]
    for j in range(SIZE):
        P[ROOM, j] = P[at, j]
    per_S = 1.0 / (P[ROOM, at] + variance)
    if P.shape[0] > ROWS:
        for j in range(SIZE):
            P[H, j] = 0.0
        P[H, at] = 1.0
        enter_correction(P, residual, per_S)
    for i in range(SIZE):
        gain = P[ROOM, i] * per_S
        P[X, i] += gain * residual
        for j in range(SIZE):
            P[i, j] -= gain * P[ROOM, j]


@compiled
def forget(P: Floats, first: int, count: int, variance: float) -> None:
    """Errors *first* … are as uncertain as *variance* says, and unrelated to all others."""
    for i in range(first, first + count):
        for j in range(SIZE):
            P[i, j] = 0.0
            P[j, i] = 0.0
        P[i, i] = variance


@compiled
def symmetrise(P: Floats) -> None:
    """What rounding has put apart."""
    for i in range(SIZE):
        for j in range(i):
            mean = 0.5 * (P[i, j] + P[j, i])
            P[i, j], P[j, i] = mean, mean


@compiled
def vector(P: Floats, row: int, at: int) -> Vec3:
    """Three numbers of a row."""
    return Vec3(float(P[row, at]), float(P[row, at + 1]), float(P[row, at + 2]))


@compiled
def put(P: Floats, row: int, at: int, v: Vec3) -> None:
    P[row, at], P[row, at + 1], P[row, at + 2] = v.x, v.y, v.z


@compiled
def three(P: Floats, row: int, at: int) -> Mat3:
    """Nine numbers of a row, as a matrix by rows."""
    return Mat3(vector(P, row, at), vector(P, row, at + 3), vector(P, row, at + 6))


@compiled
def put_three(P: Floats, row: int, at: int, m: Mat3) -> None:
    put(P, row, at, m.x)
    put(P, row, at + 3, m.y)
    put(P, row, at + 6, m.z)


@compiled
def sums_of(P: Floats) -> Sums:
    a, b, c = SUMS, SUMS + 1, SUMS + 2
    return Sums(
        float(P[a, 0]), float(P[a, 1]), three(P, a, 2), vector(P, a, 11), vector(P, a, 14), float(P[a, 17]),
        vector(P, a, 18), float(P[a, 21]), float(P[a, 22]), float(P[a, 23]), float(P[a, 24]), vector(P, b, 0),
        three(P, b, 3), vector(P, b, 12), three(P, c, 0), float(P[c, 9]),
    )  # fmt: skip


@compiled
def put_sums(P: Floats, s: Sums) -> None:
    a, b, c = SUMS, SUMS + 1, SUMS + 2
    P[a, 0], P[a, 1], P[a, 17], P[a, 21], P[a, 22] = s.time, s.samples, s.force_time, s.rate_square, s.excess_square
    P[a, 23], P[a, 24] = s.mags, s.mag_time
    put_three(P, a, 2, s.rotation)
    put(P, a, 11, s.force)
    put(P, a, 14, s.force_late)
    put(P, a, 18, s.gyr)
    put(P, b, 0, s.off)
    put_three(P, b, 3, s.to_iron)
    put(P, b, 12, s.to_delay)
    put_three(P, c, 0, s.clipped)
    P[c, 9] = s.unmeasured


@compiled
def sensor_of(P: Floats) -> Sensor:
    r = SENSOR
    return Sensor(
        three(P, r, 0), vector(P, r, 9), vector(P, r, 12), vector(P, r, 15),
        float(P[r, 18]), float(P[r, 19]), float(P[r, 20]), float(P[r, 21]), float(P[r, 24]),
    )  # fmt: skip


@compiled
def put_sensor(P: Floats, s: Sensor) -> None:
    r = SENSOR
    put_three(P, r, 0, s.scale)
    put(P, r, 9, s.velocity)
    put(P, r, 12, s.field)
    put(P, r, 15, s.iron)
    P[r, 18], P[r, 19], P[r, 20], P[r, 21], P[r, 24] = s.mag_delay, s.acc_delay, s.length, s.spread, s.wander


@compiled
def add_turned(P: Floats, R: Mat3, turn: Vec3) -> None:
    """S_A += R[:, i] g_j dt."""
    for i in range(3):
        row = R.x if i == 0 else (R.y if i == 1 else R.z)
        P[TURNED + i, 0] += row.x * turn.x
        P[TURNED + i, 1] += row.x * turn.y
        P[TURNED + i, 2] += row.x * turn.z
        P[TURNED + i, 3] += row.y * turn.x
        P[TURNED + i, 4] += row.y * turn.y
        P[TURNED + i, 5] += row.y * turn.z
        P[TURNED + i, 6] += row.z * turn.x
        P[TURNED + i, 7] += row.z * turn.y
        P[TURNED + i, 8] += row.z * turn.z


@compiled
def begin_block(P: Floats) -> None:
    """Nothing added up yet."""
    for i in range(3):
        for k in range(9):
            P[TURNED + i, k] = 0.0
    put_sums(P, NOTHING)
    for k in range(SUMMED, HEADING_SET + 1):
        P[SUMS + 1, k] = 0.0
