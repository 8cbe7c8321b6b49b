"""The one loop, and the few kernels that Python calls around it."""

from __future__ import annotations

from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from poise.data.flags import LOST, RESET
from poise.data.packet import Sample
from poise.estimators.protocol import output, resting_sample, start, step
from poise.math.compiled import compiled, entry
from poise.math.memory import Memory, borrowed, returned
from poise.math.quaternions import Quat, conjugate, inner, log
from poise.math.vectors import Vec3

Floats = NDArray[np.float64]

# Columns of the buffer that the loop reads: time, gyr, acc, mag, acc_age, mag_age.
TIME, GYR, ACC, MAG, ACC_AGE, MAG_AGE, WIDTH = 0, 1, 4, 7, 10, 11, 12
ROW_COLUMNS = ("time", "gyr", "acc", "mag", "acc_age", "mag_age")
# What the loop remembers beside the method's state: the clock, whether the next row is the first, the quaternion it
# wrote last, the turn about up that `reset_heading` asked for, and how many resets there were, with the turn and the
# time of the last one.
CLOCK, FIRST, LAST, TURN, RESETS, DELTA, RESET_AT, ASIDE = 0, 1, 2, 6, 10, 11, 14, 15


@compiled
def _vector(rows: Floats, i: int, column: int) -> Vec3:
    return Vec3(float(rows[i, column]), float(rows[i, column + 1]), float(rows[i, column + 2]))


@compiled
def _quaternion(aside: Floats, at: int) -> Quat:
    return Quat(float(aside[at]), float(aside[at + 1]), float(aside[at + 2]), float(aside[at + 3]))


@compiled
def _write(table: Floats, i: int, column: int, v: Vec3) -> None:
    table[i, column], table[i, column + 1], table[i, column + 2] = v.x, v.y, v.z


@compiled
def _sample(rows: Floats, i: int, dt: float) -> Sample:
    gyr, acc, mag = _vector(rows, i, GYR), _vector(rows, i, ACC), _vector(rows, i, MAG)
    return Sample(dt, gyr, acc, mag, float(rows[i, ACC_AGE]), float(rows[i, MAG_AGE]), dt, dt, 0.0)


@entry
def pack(
    rows: Floats, time: Floats, gyr: Floats, acc: Floats, mag: Floats, acc_age: Floats, mag_age: Floats
) -> None:  # fmt: skip
    """The columns of *rows* from whole arrays."""
    for i in range(len(rows)):
        rows[i, TIME], rows[i, ACC_AGE], rows[i, MAG_AGE] = time[i], acc_age[i], mag_age[i]
        for k in range(3):
            rows[i, GYR + k], rows[i, ACC + k], rows[i, MAG + k] = gyr[i, k], acc[i, k], mag[i, k]


@entry
def begin(method: Any, rows: Floats, bias: Vec3, aside: Floats) -> Any:
    """A method's memory, started from the first row."""
    return Memory(method, start(method, _sample(rows, 0, 0.0), bias), aside)


@entry
def begin_at(method: Any, attitude: Quat, declination: float, bias: Vec3, aside: Floats) -> Any:
    """A method's memory, started at an attitude."""
    return Memory(method, start(method, resting_sample(attitude, declination), bias), aside)


@entry
def recall(method: Any, state: Any, aside: Floats) -> Any:
    return Memory(method, state, aside)


@entry
def state_of(memory: Any) -> Any:
    return memory.state


@entry
def advance(memory: Any, rows: Floats, table: Floats, flags: NDArray[np.uint32]) -> None:
    """Step the method in *memory* over *rows* and write what it says into *table* and *flags*."""
    method, kept, aside = memory.method, memory.state, memory.aside
    state = borrowed(kept)
    clock, first = float(aside[CLOCK]), aside[FIRST] != 0.0  # float(): plain Python must not meet numpy's scalars
    last, turn = _quaternion(aside, LAST), _quaternion(aside, TURN)
    for i in range(len(rows)):
        time = float(rows[i, TIME])
        sample = _sample(rows, i, 0.0 if first else time - clock)
        if not first:
            state = step(method, state, sample)
        first = False
        if isfinite(time):
            clock = time
        out = output(method, state, sample)
        q = out.attitude
        if turn.z != 0.0:
            q = turn * q
        if out.flags & RESET != 0:
            jump = log(q * conjugate(last))
            aside[RESETS] += 1.0
            aside[DELTA], aside[DELTA + 1], aside[DELTA + 2], aside[RESET_AT] = jump.x, jump.y, jump.z, clock
        if inner(q, last) < 0.0:  # q and −q are one attitude: stay on the side we were
            q = -q
        if isfinite(q.w):
            last = q
        table[i, 0], table[i, 1], table[i, 2], table[i, 3] = q.w, q.x, q.y, q.z
        _write(table, i, 4, out.rate)
        _write(table, i, 7, out.bias)
        _write(table, i, 10, out.sigma)
        _write(table, i, 13, out.bias_sigma)
        flags[i] = out.flags if isfinite(q.w) else out.flags | LOST
    memory.state = returned(kept, state)
    aside[CLOCK], aside[FIRST] = clock, 0.0
    aside[LAST], aside[LAST + 1], aside[LAST + 2], aside[LAST + 3] = last.w, last.x, last.y, last.z
