"""E1: sequences of samples that no sensor can make, through the compiled loop that `estimate` runs.

Chains of sequences share one state. A sequence is a few rows with values of POISON in them, then a few good rows.
"""

from __future__ import annotations

import time as clock
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fault_bench.checked import Check
from poise import METHODS, Stream
from poise.data.attitude import COLUMNS
from poise.data.flags import valid
from poise.estimators.loop import GYR, TIME, WIDTH, advance, begin
from poise.math.compiled import direct
from poise.math.vectors import ZERO

Floats = NDArray[np.float64]

BAD, GOOD, CHAIN = 12, 4, 5  # rows with poison, good rows after them, sequences before the method starts anew
LENGTH = BAD + GOOD
BLOCK = 10_000  # sequences made at a time
PERIOD = 0.01  # s
POISON = np.array(
    [np.nan, np.inf, -np.inf, 1e30, -1e30, 1e308, -1e308, 1e160, -1e160, 1e-160, 0.0, -0.0, 5e-324, -5e-324, 1e-310]
)


def sequences(n: int, rng: np.random.Generator) -> tuple[Floats, NDArray[np.bool_]]:
    """(n, LENGTH, WIDTH) rows as the loop reads them, and (n, LENGTH) which of them are as a sensor makes them."""
    rows = np.zeros((n, LENGTH, WIDTH))
    rows[:, :, TIME] = PERIOD * np.arange(n * LENGTH).reshape(n, LENGTH)
    rows[:, :, GYR : GYR + 9] = rng.normal(size=(n, LENGTH, 9)) * np.repeat([0.5, 0.3, 0.5], 3)
    for column, length in ((GYR + 3, 9.81), (GYR + 6, 50.0)):
        directions = rng.normal(size=(n, 1, 3))
        rows[:, :, column : column + 3] += length * directions / np.linalg.norm(directions, axis=2, keepdims=True)
    share = rng.choice([0.02, 0.2, 0.6, 1.0], size=(n, 1, 1))
    poisoned = rng.random((n, BAD, GYR + 9)) < share
    # In half of the sequences only the stamps, or one sensor, are hit.
    part = np.array([0, *([1] * 3), *([2] * 3), *([3] * 3)])
    hit = rng.integers(0, 8, size=(n, 1, 1))
    poisoned &= (hit > 3) | (part == hit)
    values = rng.choice(POISON, size=poisoned.shape)
    one = rng.random((n, 1, 1)) < 0.3  # the same value everywhere
    values = np.where(one, values[:, :1, :1], values)
    part_rows = rows[:, :BAD, : GYR + 9]
    part_rows[poisoned] = values[poisoned]
    good = np.ones((n, LENGTH), bool)
    good[:, :BAD] = ~poisoned.any(axis=2)
    return rows, good


def fuzz(name: str, count: int, seed: int) -> list[Check]:
    """Feed *count* sequences to a method; bad rows are not finite once good samples have come, or valid and not finite."""
    start = clock.perf_counter()
    stream = Stream(METHODS[name]())
    rng = np.random.default_rng([seed, 1])
    bad, rows_done, first_bad = 0, 0, ""
    for block in range(0, count, BLOCK):
        rows, good = sequences(min(BLOCK, count - block), rng)
        table, flags = _run(stream, rows)
        wrong = _wrong(table, flags, good)
        if wrong.any() and not first_bad:
            first_bad = f", first in sequence {block + int(np.flatnonzero(wrong.any(axis=1))[0])}"
        bad += int(wrong.sum())
        rows_done += wrong.size
    seconds = clock.perf_counter() - start
    found = f"{bad} bad of {rows_done} rows in {seconds:.0f} s{first_bad}"
    return [Check("E1", f"{count} fuzzed sequences", "0 bad rows", name, found, bad == 0)]


def _run(stream: Stream, rows: Floats) -> tuple[Floats, NDArray[np.uint32]]:
    """What the method says to every row, (n, LENGTH, …); it starts anew at every CHAIN-th sequence."""
    n = len(rows)
    table, flags = np.empty((n, LENGTH, COLUMNS)), np.empty((n, LENGTH), np.uint32)
    running, fresh = stream._running, stream._aside.copy()
    chained = [np.ascontiguousarray(rows[i : i + CHAIN]).reshape(-1, WIDTH) for i in range(0, n, CHAIN)]
    run: Any = None
    for i, chain in enumerate(chained):
        memory = begin(running, chain, ZERO, fresh.copy())
        out = table[i * CHAIN : (i + 1) * CHAIN].reshape(-1, COLUMNS), flags[i * CHAIN : (i + 1) * CHAIN].reshape(-1)
        if run is None:
            advance(memory, chain, *out)
            run = direct(advance, memory, chain, *out)
        else:
            run(memory, chain, *out)
    return table, flags


def _wrong(table: Floats, flags: NDArray[np.uint32], good: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n, LENGTH) the rows that break the rule."""
    n = len(good)
    attitude_bias = np.concatenate([table[:, :, :4], table[:, :, 7:10]], axis=2)
    finite = np.isfinite(attitude_bias).all(axis=2)
    with np.errstate(over="ignore", invalid="ignore"):
        unit = np.abs(np.linalg.norm(table[:, :, :4], axis=2) - 1.0) < 1e-6
    # A good sample behind another: of the first alone, nobody knows whether its stamp or the one before is wrong.
    usable = good.reshape(-1) & np.concatenate([[False], good.reshape(-1)[:-1]])
    usable[:: CHAIN * LENGTH] = False
    known = np.empty_like(usable)
    for first in range(0, n * LENGTH, CHAIN * LENGTH):  # from there to the end of the chain
        known[first : first + CHAIN * LENGTH] = np.maximum.accumulate(usable[first : first + CHAIN * LENGTH])
    known = known.reshape(n, LENGTH)
    sure = finite & unit
    infinite = np.isinf(table).any(axis=2)
    return np.asarray(~sure & (known | valid(flags)) | infinite)
