"""The covariance of SelfCalibrating's errors: how a block adds to it, what a measured number takes away, and the log of both.

Equation numbers are those of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from poise.estimators.self_calibrating.model import (
    ACC_BIAS,
    ACC_DELAY,
    ACC_SCALE,
    ADDED,
    BIAS,
    CORRECTIONS,
    ENTRIES,
    ENTRY,
    FIELD,
    HELD,
    INJECTED,
    IRON,
    MOST,
    ONE,
    ROOM,
    ROWS,
    SCALE,
    SENSOR,
    SIZE,
    SUMS,
    TURN,
    TURNED,
    VELOCITY,
    Floats,
    H,
    Noise,
    Sums,
    X,
    put,
    put_three,
)
from poise.math.compiled import compiled
from poise.math.matrices import Mat3
from poise.math.vectors import ZERO


@compiled
def grow(P: Floats, sums: Sums, noise: Noise, gravity: float) -> None:
    """P ← F P Fᵀ + Q over a block, in place (eq. 9, 10).

    Only the rows of ε and v of F differ from the identity: ε⁺ = ε − S_R δb + S_A δA (eq. 7) and
    v⁺ = v − [S_f]× ε + S_l δτ_a − S_b δb_a + g T e_z δs_a (eq. 8). Of [S_f]× the column of the heading is left out: the
    pseudo-velocity is near 0 in every direction, so that a horizontal acceleration says nothing of the heading.
    """
    S_R = sums.rotation
    S_b, gT = force_rotation(sums), gravity * sums.force_time
    fx, fy, fz = sums.force
    lx, ly, lz = sums.force_late
    for j in range(SIZE):  # rows of v first: they take the old ε
        x, y, late = P[TURN, j], P[TURN + 1, j], P[ACC_DELAY, j]
        ax, ay, az = P[ACC_BIAS, j], P[ACC_BIAS + 1, j], P[ACC_BIAS + 2, j]
        P[VELOCITY, j] += fz * y + lx * late - (S_b.x.x * ax + S_b.x.y * ay + S_b.x.z * az)
        P[VELOCITY + 1, j] += ly * late - fz * x - (S_b.y.x * ax + S_b.y.y * ay + S_b.y.z * az)
        P[VELOCITY + 2, j] += (
            fy * x - fx * y + lz * late + gT * P[ACC_SCALE, j] - (S_b.z.x * ax + S_b.z.y * ay + S_b.z.z * az)
        )
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
            ax, ay, az = P[i, ACC_BIAS], P[i, ACC_BIAS + 1], P[i, ACC_BIAS + 2]
            P[i, VELOCITY] += fz * y + lx * late - (S_b.x.x * ax + S_b.x.y * ay + S_b.x.z * az)
            P[i, VELOCITY + 1] += ly * late - fz * x - (S_b.y.x * ax + S_b.y.y * ay + S_b.y.z * az)
            P[i, VELOCITY + 2] += (
                fy * x - fx * y + lz * late + gT * P[i, ACC_SCALE] - (S_b.z.x * ax + S_b.z.y * ay + S_b.z.z * az)
            )
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
        P[ACC_BIAS + k, ACC_BIAS + k] += noise.acc_bias
    P[FIELD, FIELD] += noise.field
    P[FIELD + 1, FIELD + 1] += noise.field


@compiled
def force_rotation(sums: Sums) -> Mat3:
    """S_b: Σ R over the time that the specific force stands for."""
    part: Mat3 = (sums.force_time / sums.time if sums.time > 0.0 else 0.0) * sums.rotation
    return part


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
    if P[SUMS, HELD] != 0.0:
        put(P, row + 1, ACC_BIAS, ZERO)
    P[row, ONE], P[row + 1, ONE] = residual, per_S
    P[at, ONE] = n + 1.0


@compiled
def enter_block(P: Floats, s: Sums, event: float, gravity: float) -> None:
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
    P[at + 2, ONE] = s.force_time / s.time if s.time > 0.0 else 0.0
    P[at + 3, ONE] = gravity * s.force_time
    P[SENSOR, 22] += 1.0
    P[entry_row(P), ONE] = 0.0


@compiled
def _take_in(P: Floats, residual: float, per_S: float) -> None:
    """x ← x + K residual, P ← P − K hᵀ P, with K = P h / S; row ROOM holds P h.

    Where the accelerometer's bias is held it has no gain: it stays as it is and as unsure, and all others know of that
    (Schmidt 1966).
    """
    held = P[SUMS, HELD] != 0.0
    for i in range(SIZE):
        if held and ACC_BIAS <= i < ACC_SCALE:
            continue
        gain = P[ROOM, i] * per_S
        P[X, i] += gain * residual
        for j in range(SIZE):
            P[i, j] -= gain * P[ROOM, j]
    if held:
        for k in range(ACC_BIAS, ACC_SCALE):
            for j in range(SIZE):
                P[k, j] = P[j, k]


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
    _take_in(P, residual, per_S)


@compiled
def correct_one(P: Floats, at: int, residual: float, variance: float) -> None:
    """:func:`correct` where the number measured is one of the 29."""
    residual -= P[X, at]
    for j in range(SIZE):
        P[ROOM, j] = P[at, j]
    per_S = 1.0 / (P[ROOM, at] + variance)
    if P.shape[0] > ROWS:
        for j in range(SIZE):
            P[H, j] = 0.0
        P[H, at] = 1.0
        enter_correction(P, residual, per_S)
    _take_in(P, residual, per_S)


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
