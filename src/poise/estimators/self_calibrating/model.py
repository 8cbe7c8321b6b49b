"""What SelfCalibrating estimates, how its errors grow over a block, and how one measured number corrects them.

Errors, 29 numbers in this order, each true − estimated; the attitude's is a small turn ε about the Earth's axes,
R_true = Exp(ε) R: ε (3), gyroscope bias (3), gyroscope scale and misalignment A (9, by rows), pseudo-velocity v (3),
field h (north and up), hard iron (3), delay of the magnetometer and of the accelerometer behind the gyroscope, bias (3)
and scale of the accelerometer.
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
TURN, BIAS, SCALE, VELOCITY, FIELD, IRON, MAG_DELAY, ACC_DELAY, ACC_BIAS, ACC_SCALE = (
    0,
    3,
    6,
    15,
    18,
    20,
    23,
    24,
    25,
    28,
)
SIZE = 29
# One table is the memory: P in its first 29 rows, then these. A NamedTuple of as many numbers would be copied at every step.
H, X, ROOM = 29, 30, 31  # of a correction: what is measured of the errors, their estimate, P h
TURNED = 32  # three rows: S_A = Σ R[:, i] g_j dt, column 3 i + j
SUMS, SENSOR, KEPT, LENGTHS, OPEN, TURNS = 35, 38, 39, 41, 42, 43  # two rows keep what was known before: recall.py
OWN = 44  # what delay.py keeps of the accelerometer's own interval
# Behind that: how often expected_scale.py has doubled what was expected of A, what it has judged of it (4), and how often it
# had been doubled when the two of recall.py were kept.
WIDENED = 3
ROWS, COLUMNS = 45, 32
# iron.py keeps, behind the sums of the second row, a block's sums of m (3) and |m|², the turn that the heading was set by, and
# the m (3) of the last block that was taken. In the row of lengths, behind the means: how often an iron was found, the seconds
# since they were looked at, the turn (3) since the last block, the m (3) that the heading was set by, the seconds since.
# unproven.py keeps in OPEN a matrix (9), whether the heading is unproven, and an iron (3); another_field.py, behind that,
# means of the field (3) and its square, their seconds, and whether they confirm what the heading was set by; whether the
# matrix is that of an iron that was found, and the seconds that agreed. In TURNS turns.py keeps its means,
# behind the sums of TURNED watch.py what a bias has turned and leans.py its means.
SUMMED, HEADING_SET, TAKEN, JUST_FOUND = 16, 20, 21, 24
FOUND, LOOKED, TURNED_SINCE, BEGAN, ELAPSED = 18, 19, 20, 23, 26
# Behind its sums the first row keeps whether the accelerometer's bias is held, that of what is known the last force (3).
HELD, FORCE = 26, 29
UNPROVEN, BESIDE, MEAN, SQUARE, SEEN, CONFIRMED, BY_FIND, AGREED = 9, 10, 13, 16, 17, 18, 19, 20
# Behind that, where a smoother asked for it, one entry a block: P's rows of ε and bias after the corrections, what was
# injected, what the block added up, and each correction's h and P h. Column 29 of the entry's rows holds single numbers.
ENTRIES, ENTRY = ROWS, 40
INJECTED, ADDED, CORRECTIONS, MOST = 6, 7, 10, 15  # six in motion, and nine that expected_scale.py adds; nine at rest
ONE = SIZE  # the column of single numbers
# What became, after a block, of what was known.
GOES_ON, BEGUN_ANEW, ANOTHER_BIAS, ANOTHER_IRON, ANOTHER_NORTH, ANOTHER_VELOCITY = 0.0, 1.0, 2.0, 3.0, 4.0, 5.0

TURNING, SHAKEN = 0.15, 0.15  # rad/s, with any bias, and of g, RMS since the start: beyond either it is in motion
IN_MOTION = 4.0  # initial tilts: σ of an attitude by one sample, or a few, in motion
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
    P: Floats  # (45, 32): the errors' covariance and, below it, the rest of the memory: see ROWS


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
    jump_square: float  # (m/s)²: Σ |f − f before|² dt²
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
    acc_bias: Vec3  # b_a, m/s², body frame: f = (1 + s_a)(acc − b_a)
    acc_scale: float  # s_a


NOTHING = Sums(0.0, 0.0, _NONE, ZERO, ZERO, 0.0, ZERO, 0.0, 0.0, 0.0, 0.0, 0.0, ZERO, _NONE, ZERO, _NONE, 0.0)


class Noise(NamedTuple):
    """Variances that a block adds (eq. 10)."""

    turn: float  # rad², about each axis
    bias: float  # (rad/s)²
    velocity: float  # (m/s)²
    field: float  # of a field of length 1
    iron: float
    acc_bias: float  # (m/s²)²


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
        vector(P, a, 18), float(P[a, 21]), float(P[a, 22]), float(P[a, 25]), float(P[a, 23]), float(P[a, 24]),
        vector(P, b, 0), three(P, b, 3), vector(P, b, 12), three(P, c, 0), float(P[c, 9]),
    )  # fmt: skip


@compiled
def put_sums(P: Floats, s: Sums) -> None:
    a, b, c = SUMS, SUMS + 1, SUMS + 2
    P[a, 0], P[a, 1], P[a, 17], P[a, 21], P[a, 22] = s.time, s.samples, s.force_time, s.rate_square, s.excess_square
    P[a, 23], P[a, 24], P[a, 25] = s.mags, s.mag_time, s.jump_square
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
        float(P[r, 18]), float(P[r, 19]), float(P[r, 20]), float(P[r, 21]), float(P[r, 24]), vector(P, r, 25), float(P[r, 28]),
    )  # fmt: skip


@compiled
def put_sensor(P: Floats, s: Sensor) -> None:
    r = SENSOR
    put_three(P, r, 0, s.scale)
    put(P, r, 9, s.velocity)
    put(P, r, 12, s.field)
    put(P, r, 15, s.iron)
    put(P, r, 25, s.acc_bias)
    P[r, 18], P[r, 19], P[r, 20], P[r, 21], P[r, 24] = s.mag_delay, s.acc_delay, s.length, s.spread, s.wander
    P[r, 28] = s.acc_scale


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
    P[SUMS + 1, JUST_FOUND] = 0.0
