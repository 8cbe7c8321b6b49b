"""The flagship's model: what is estimated, how errors grow over a block, and how one measured number corrects them.

Errors, 24 numbers in this order, each true − estimated, the attitude's as a small turn ε about the Earth's axes
(R_true = Exp(ε) R): ε (3), gyroscope bias (3), gyroscope scale and misalignment A (9, by rows), pseudo-velocity v (3),
field h (north and up), hard iron (3), magnetometer delay τ. Equation numbers are those of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.math.compiled import compiled
from poise.math.matrices import Mat3
from poise.math.vectors import Vec3

Floats = NDArray[np.float64]

TURN, BIAS, SCALE, VELOCITY, FIELD, IRON, DELAY, SIZE = 0, 3, 6, 15, 18, 20, 23, 24


class Noise(NamedTuple):
    """Variances that a block adds."""

    turn: float  # rad², about each axis
    bias: float  # (rad/s)²
    velocity: float  # (m/s)²
    field: float  # of the field's length = 1
    iron: float


@compiled
def grow(P: Floats, S_R: Mat3, S_A: Floats, S_f: Vec3, noise: Noise) -> None:
    """P ← F P Fᵀ + Q over a block, in place (eq. 7–9).

    Only the rows of ε and v of F differ from the identity: ε⁺ = ε − S_R δb + S_A δA and v⁺ = v − [S_f]× ε.
    """
    fx, fy, fz = S_f
    for j in range(SIZE):  # rows of v first: they take the old ε
        x, y, z = P[TURN, j], P[TURN + 1, j], P[TURN + 2, j]
        P[VELOCITY, j] += fz * y - fy * z
        P[VELOCITY + 1, j] += fx * z - fz * x
        P[VELOCITY + 2, j] += fy * x - fx * y
    for i in range(3):
        row = S_R.x if i == 0 else (S_R.y if i == 1 else S_R.z)
        for j in range(SIZE):
            P[i, j] -= row.x * P[BIAS, j] + row.y * P[BIAS + 1, j] + row.z * P[BIAS + 2, j]
        for k in range(9):
            weight = S_A[i, k]
            for j in range(SIZE):
                P[i, j] += weight * P[SCALE + k, j]
    # The same for the columns. Where the row is none of the six, symmetry has the result already.
    for i in range(SIZE):
        if TURN + 3 <= i < VELOCITY or i >= FIELD:
            for k in range(3):
                P[i, TURN + k] = P[TURN + k, i]
                P[i, VELOCITY + k] = P[VELOCITY + k, i]
        else:
            x, y, z = P[i, TURN], P[i, TURN + 1], P[i, TURN + 2]
            P[i, VELOCITY] += fz * y - fy * z
            P[i, VELOCITY + 1] += fx * z - fz * x
            P[i, VELOCITY + 2] += fy * x - fx * y
            bx, by, bz = P[i, BIAS], P[i, BIAS + 1], P[i, BIAS + 2]
            x -= S_R.x.x * bx + S_R.x.y * by + S_R.x.z * bz
            y -= S_R.y.x * bx + S_R.y.y * by + S_R.y.z * bz
            z -= S_R.z.x * bx + S_R.z.y * by + S_R.z.z * bz
            for k in range(9):
                x += S_A[0, k] * P[i, SCALE + k]
                y += S_A[1, k] * P[i, SCALE + k]
                z += S_A[2, k] * P[i, SCALE + k]
            P[i, TURN], P[i, TURN + 1], P[i, TURN + 2] = x, y, z
    for k in range(3):
        P[TURN + k, TURN + k] += noise.turn
        P[BIAS + k, BIAS + k] += noise.bias
        P[VELOCITY + k, VELOCITY + k] += noise.velocity
        P[IRON + k, IRON + k] += noise.iron
    P[FIELD, FIELD] += noise.field
    P[FIELD + 1, FIELD + 1] += noise.field


@compiled
def correct(P: Floats, work: Floats, residual: float, variance: float) -> float:
    """One measured number: K = P h/(hᵀ P h + R), x ← x + K (residual − hᵀx), P ← P − K hᵀP, in place (eq. 12).

    *work* (3, 24) holds h, x and room. Returns the residual's square over its variance.
    """
    for j in range(SIZE):
        work[2, j] = 0.0
    for i in range(SIZE):
        weight = work[0, i]
        if weight != 0.0:
            residual -= weight * work[1, i]
            for j in range(SIZE):
                work[2, j] += weight * P[i, j]
    S = variance
    for i in range(SIZE):
        S += work[0, i] * work[2, i]
    per_S = 1.0 / S
    for i in range(SIZE):
        gain = work[2, i] * per_S
        work[1, i] += gain * residual
        for j in range(SIZE):
            P[i, j] -= gain * work[2, j]
    return residual * residual * per_S


@compiled
def measure_one(P: Floats, work: Floats, at: int, residual: float, variance: float) -> float:
    """:func:`correct` where the number measured is one of the 24."""
    for j in range(SIZE):
        work[0, j] = 0.0
    work[0, at] = 1.0
    return correct(P, work, residual, variance)


@compiled
def symmetrise(P: Floats) -> None:
    """What rounding has put apart."""
    for i in range(SIZE):
        for j in range(i):
            mean = 0.5 * (P[i, j] + P[j, i])
            P[i, j], P[j, i] = mean, mean
