"""The way back over the blocks (Bierman 1977): what the future says, λ and Λ, so that the smoothed errors are −P λ and their
covariance P − P Λ P. Equation numbers are those of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from math import isfinite, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from poise.estimators.self_calibrating.model import (
    ACC_BIAS,
    ACC_DELAY,
    ACC_SCALE,
    ADDED,
    ANOTHER_BIAS,
    ANOTHER_IRON,
    ANOTHER_NORTH,
    ANOTHER_VELOCITY,
    BIAS,
    CORRECTIONS,
    ENTRY,
    FIELD,
    GOES_ON,
    IN_MOTION,
    INJECTED,
    MAG_DELAY,
    ONE,
    SCALE,
    SIZE,
    TURN,
    VELOCITY,
    Floats,
    three,
    vector,
)
from poise.math.compiled import compiled, entry
from poise.math.matrices import Mat3
from poise.math.quaternions import Quat, exp, inner
from poise.math.vectors import UP, Vec3


@compiled
def back_through_correction(future: Floats, P: Floats, row: int) -> None:
    """λ ← λ − h (r/S + kᵀλ), Λ ← h hᵀ/S + (I − h kᵀ) Λ (I − k hᵀ) with k = P h/S (eq. 20)."""
    residual, per_S = float(P[row, ONE]), float(P[row + 1, ONE])
    ahead, through = 0.0, 0.0  # kᵀ λ, kᵀ Λ k
    for j in range(SIZE):
        future[SIZE + 1, j] = 0.0
        ahead += per_S * P[row + 1, j] * future[SIZE, j]
    for i in range(SIZE):
        weight = per_S * P[row + 1, i]
        for j in range(SIZE):
            future[SIZE + 1, j] += weight * future[i, j]
    for j in range(SIZE):
        through += per_S * P[row + 1, j] * future[SIZE + 1, j]
    pull, own = residual * per_S + ahead, per_S + through
    for i in range(SIZE):  # h has few numbers that are not 0
        h = float(P[row, i])
        if h != 0.0:
            future[SIZE, i] -= h * pull
            for j in range(SIZE):
                future[i, j] += h * (own * P[row, j] - future[SIZE + 1, j])
            for j in range(SIZE):
                future[j, i] -= h * future[SIZE + 1, j]


@compiled
def back_through_block(future: Floats, P: Floats, at: int) -> None:
    """λ ← Fᵀ λ, Λ ← Fᵀ Λ F (eq. 21), with F as in :func:`grow`."""
    S_R, S_f, S_l = three(P, at + ADDED, 9), vector(P, at + ADDED + 1, 9), vector(P, at + ADDED + 2, 9)
    S_b: Mat3 = float(P[at + 2, ONE]) * S_R
    gT = float(P[at + 3, ONE])
    for j in range(SIZE):  # Fᵀ times Λ
        ex, ey, ez = future[TURN, j], future[TURN + 1, j], future[TURN + 2, j]
        vx, vy, vz = future[VELOCITY, j], future[VELOCITY + 1, j], future[VELOCITY + 2, j]
        future[BIAS, j] -= S_R.x.x * ex + S_R.y.x * ey + S_R.z.x * ez
        future[BIAS + 1, j] -= S_R.x.y * ex + S_R.y.y * ey + S_R.z.y * ez
        future[BIAS + 2, j] -= S_R.x.z * ex + S_R.y.z * ey + S_R.z.z * ez
        future[TURN, j] += S_f.y * vz - S_f.z * vy
        future[TURN + 1, j] += S_f.z * vx - S_f.x * vz
        future[ACC_DELAY, j] += S_l.x * vx + S_l.y * vy + S_l.z * vz
        future[ACC_BIAS, j] -= S_b.x.x * vx + S_b.y.x * vy + S_b.z.x * vz
        future[ACC_BIAS + 1, j] -= S_b.x.y * vx + S_b.y.y * vy + S_b.z.y * vz
        future[ACC_BIAS + 2, j] -= S_b.x.z * vx + S_b.y.z * vy + S_b.z.z * vz
        future[ACC_SCALE, j] += gT * vz
        future[SIZE + 1, j], future[SIZE + 2, j], future[SIZE + 3, j] = ex, ey, ez
    for k in range(9):
        x, y, z = P[at + ADDED, k], P[at + ADDED + 1, k], P[at + ADDED + 2, k]
        for j in range(SIZE):
            future[SCALE + k, j] += x * future[SIZE + 1, j] + y * future[SIZE + 2, j] + z * future[SIZE + 3, j]
    for i in range(SIZE + 1):  # then times F; in a row that F leaves as it is, symmetry has the result already
        if VELOCITY <= i < ACC_DELAY:
            for j in range(VELOCITY):
                future[i, j] = future[j, i]
            for j in range(ACC_DELAY, SIZE):
                future[i, j] = future[j, i]
        else:
            e, v = vector(future, i, TURN), vector(future, i, VELOCITY)
            future[i, BIAS] -= S_R.x.x * e.x + S_R.y.x * e.y + S_R.z.x * e.z
            future[i, BIAS + 1] -= S_R.x.y * e.x + S_R.y.y * e.y + S_R.z.y * e.z
            future[i, BIAS + 2] -= S_R.x.z * e.x + S_R.y.z * e.y + S_R.z.z * e.z
            for k in range(9):
                future[i, SCALE + k] += P[at + ADDED, k] * e.x + P[at + ADDED + 1, k] * e.y + P[at + ADDED + 2, k] * e.z
            future[i, TURN] += S_f.y * v.z - S_f.z * v.y
            future[i, TURN + 1] += S_f.z * v.x - S_f.x * v.z
            future[i, ACC_DELAY] += S_l.x * v.x + S_l.y * v.y + S_l.z * v.z
            future[i, ACC_BIAS] -= S_b.x.x * v.x + S_b.y.x * v.y + S_b.z.x * v.z
            future[i, ACC_BIAS + 1] -= S_b.x.y * v.x + S_b.y.y * v.y + S_b.z.y * v.z
            future[i, ACC_BIAS + 2] -= S_b.x.z * v.x + S_b.y.z * v.y + S_b.z.z * v.z
            future[i, ACC_SCALE] += gT * v.z


@compiled
def leave_open(future: Floats, k: int) -> None:
    """The future of one error is any: what it says of the others is what it says whatever that is (eq. 21a)."""
    own = float(future[k, k])
    if own > 0.0:
        pull = float(future[SIZE, k]) / own
        for i in range(SIZE):
            future[SIZE, i] -= future[i, k] * pull
            future[SIZE + 1, i] = future[i, k]
        for i in range(SIZE):
            for j in range(SIZE):
                future[i, j] -= future[SIZE + 1, i] * future[SIZE + 1, j] / own
    forget_future(future, k)


@compiled
def forget_future(future: Floats, k: int) -> None:
    """What the future says of one error that is unrelated to all others from here on."""
    for i in range(SIZE):
        future[i, k], future[k, i] = 0.0, 0.0
    future[SIZE, k] = 0.0


@entry
def back(log: Floats, future: Floats, corrections: Floats) -> None:
    """From the last entry of *log* to the first: the corrections (n, 22) of ε and bias after each block, what was injected
    there, their variances, whether the attitude was begun anew, ε's causal variances; *future* (33, 29) holds Λ, λ and room.
    """
    for n in range(len(corrections) - 1, -1, -1):
        at = n * ENTRY
        for i in range(6):
            for j in range(SIZE):
                future[SIZE + 1, j] = 0.0
            for k in range(SIZE):
                weight = log[at + i, k]
                for j in range(SIZE):
                    future[SIZE + 1, j] += weight * future[k, j]
            correction, variance = 0.0, float(log[at + i, i])
            for j in range(SIZE):
                correction -= log[at + i, j] * future[SIZE, j]
                variance -= log[at + i, j] * future[SIZE + 1, j]
            corrections[n, i] = correction
            corrections[n, 6 + i] = log[at + INJECTED, i]
            corrections[n, 12 + i] = variance
        corrections[n, 18] = log[at + 1, ONE]
        for i in range(3):
            corrections[n, 19 + i] = log[at + i, i]
        event = log[at + 1, ONE]
        if event == ANOTHER_VELOCITY:  # begun anew behind the block
            for k in range(VELOCITY, VELOCITY + 3):
                forget_future(future, k)
        elif event != GOES_ON:  # first what is unrelated from here on
            if event == ANOTHER_BIAS:
                for k in range(3):
                    forget_future(future, TURN + k)
                    forget_future(future, VELOCITY + k)
                    forget_future(future, BIAS + k)
                for k in range(ACC_BIAS, SIZE):
                    forget_future(future, k)
            if event in (ANOTHER_IRON, ANOTHER_NORTH):
                for k in range(FIELD, MAG_DELAY + 1):
                    forget_future(future, k)
            if event in (ANOTHER_BIAS, ANOTHER_IRON, ANOTHER_NORTH):  # and A, which is that of before
                for k in range(SCALE, SCALE + 9):
                    forget_future(future, k)
            for k in range(3):  # then attitude and velocity, of which some go on
                leave_open(future, TURN + k)
                leave_open(future, VELOCITY + k)
        if event in (GOES_ON, ANOTHER_VELOCITY):
            for m in range(int(log[at, ONE]) - 1, -1, -1):
                back_through_correction(future, log, at + CORRECTIONS + 2 * m)
            back_through_block(future, log, at)


@entry
def apply(
    rows: Floats,
    index: NDArray[np.int64],
    table: Floats,
    time: Floats,
    corrections: Floats,
    begun: Vec3,
    declination: float,
) -> None:
    """The blocks' corrections on every row of *table* (n, 16): at *rows* (s), which stand behind *index* entries.

    Between the ends of two blocks (at *time*) in proportion to time; the end's is of before its injection. *begun* are the
    variances of ε (rad²) before the first end.
    """
    north = exp(-declination * UP)
    south = exp(declination * UP)
    n = len(corrections)
    last = Quat(0.0, 0.0, 0.0, 0.0)
    for r in range(len(rows)):
        after = min(int(index[r]), n - 1)
        before = max(int(index[r]) - 1, 0)
        share = 0.0
        if index[r] == 0:
            share = 1.0
        elif index[r] < n and corrections[after, 18] == 0.0 and time[after] > time[before]:
            share = float((rows[r] - time[before]) / (time[after] - time[before]))
            share = min(max(share, 0.0), 1.0) if share == share else 0.0
        x = mixed(corrections, before, after, share, TURN)
        turn = north * exp(x) * south if declination != 0.0 else exp(x)
        q = turn * Quat(float(table[r, 0]), float(table[r, 1]), float(table[r, 2]), float(table[r, 3]))
        if inner(q, last) < 0.0:  # q and −q are one attitude: stay on the side we were
            q = -q
        if isfinite(q.w):
            last = q
        table[r, 0], table[r, 1], table[r, 2], table[r, 3] = q.w, q.x, q.y, q.z
        bias = mixed(corrections, before, after, share, BIAS)
        for i in range(3):
            change = bias.x if i == 0 else (bias.y if i == 1 else bias.z)
            table[r, 4 + i] -= change
            table[r, 7 + i] += change
            # What is in the causal sigma beside P stays; P, there, is that of the last end, until the next.
            first = begun.x if i == 0 else (begun.y if i == 1 else begun.z)
            if i < 2 and table[r, 10 + i] ** 2 > 4.0 * first:  # a start that was found to be in motion
                first *= IN_MOTION**2
            known = first if index[r] == 0 else corrections[before, 19 + i]
            now = (1.0 - share) * corrections[before, 12 + i] + share * corrections[after, 12 + i]
            table[r, 10 + i] = min(sqrt(max(table[r, 10 + i] ** 2 - known + now, 0.0)), pi)
            table[r, 13 + i] = sqrt(
                max((1.0 - share) * corrections[before, 15 + i] + share * corrections[after, 15 + i], 0.0)
            )


@compiled
def mixed(corrections: Floats, before: int, after: int, share: float, at: int) -> Vec3:
    """Three of the corrections between two ends."""
    start, end, injected = (
        vector(corrections, before, at),
        vector(corrections, after, at),
        vector(corrections, after, 6 + at),
    )
    return (1.0 - share) * start + share * (end + injected)
