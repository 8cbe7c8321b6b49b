"""E16: the same bits in one piece, row by row, in packets, and resumed at any row; and what plain Python says."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from fault_bench.checked import Check
from fault_bench.injectors import LEAD
from poise import METHODS, Attitude, Packet, Recording, Stream, estimate, read
from poise.math import arrays

Floats = NDArray[np.float64]

SECONDS = 20.0
RESUMED = 400  # rows at each of which the stream is saved and goes on in another one
PLAIN = 1e-9  # rad


def troubled(recording: Recording, seconds: float, rng: np.random.Generator) -> Recording:
    """A stretch in motion with some of everything in it: NaN, spikes, stuck and clipped sensors, a gap, a clock set back."""
    assert recording.moving is not None
    start = recording.time[np.argmax(recording.moving)] + rng.uniform(LEAD, 3.0 * LEAD)
    part = recording.between(start, start + seconds)
    n = len(part)
    time, gyr, acc, mag = (np.array(getattr(part, name)) for name in ("time", "gyr", "acc", "mag"))
    for samples, size in ((gyr, 20.0), (acc, 80.0), (mag, 400.0)):
        samples[rng.random(n) < 0.01] = np.nan
        hit = rng.random(n) < 0.005
        samples[hit] += size * rng.normal(size=(int(hit.sum()), 3))
        first = int(rng.integers(n // 4, n // 2))
        samples[first : first + n // 20] = samples[first]
    first = int(rng.integers(n // 2, n // 2 + n // 20))
    gyr[first : first + n // 40] = np.nan
    mag[-n // 5 :: 2] = np.nan
    acc[-n // 8 : -n // 10] = 0.0
    gyr = np.clip(gyr, -6.0, 6.0)
    back = int(rng.integers(n // 10, n // 5))
    time[back:] -= 2.0
    time[-n // 3] = np.nan
    keep = np.ones(n, bool)
    keep[n // 2 + n // 8 : n // 2 + n // 6] = False
    part = replace(part, time=time, gyr=gyr, acc=acc, mag=mag, truth=None, moving=None)
    return part[keep]


def same_bits(name: str, file: Path, seed: int) -> list[Check]:
    """All checks of one method on one trial."""
    rng = np.random.default_rng([seed, 16])
    recording = read(file)
    part = troubled(recording, SECONDS, rng)
    whole = estimate(METHODS[name](), part)
    cuts = np.sort(rng.integers(0, len(part), 40))
    ways: dict[str, Callable[[], Iterator[Attitude]]] = {
        "the same again": lambda: iter([estimate(METHODS[name](), part)]),
        "stream, row by row": lambda: _streamed(name, part),
        "stream, packets of random lengths": lambda: _packets(name, part, cuts),
        f"resumed at each of {RESUMED} rows": lambda: _resumed(name, part),
    }
    checks = [_compared(way, whole, list(run()), name) for way, run in ways.items()]
    return [*checks, _silences(name, part), _plain(name, part, whole)]


def _rows(recording: Recording) -> Iterator[Packet]:
    for i in range(len(recording)):
        yield Packet(float(recording.time[i]), recording.gyr[i], recording.acc[i], recording.mag[i])


def _streamed(name: str, part: Recording) -> Iterator[Attitude]:
    stream = Stream(METHODS[name]())
    return (stream.update(packet) for packet in _rows(part))


def _packets(name: str, part: Recording, cuts: NDArray[np.intp]) -> Iterator[Attitude]:
    stream = Stream(METHODS[name]())
    for first, last in zip([0, *cuts.tolist()], [*cuts.tolist(), len(part)], strict=True):
        yield stream.update(Packet(*(getattr(part, s)[first:last] for s in ("time", "gyr", "acc", "mag"))))


def _resumed(name: str, part: Recording) -> Iterator[Attitude]:
    """A stream that is saved, and goes on in another one: at every row of a stretch, then once in a while."""
    n = len(part)
    often = range(n // 4, n // 4 + RESUMED // 2)
    seldom = np.linspace(0, n - 1, RESUMED // 2).astype(int).tolist()
    saved_at = {*often, *seldom}
    stream = Stream(METHODS[name]())
    for i, packet in enumerate(_rows(part)):
        yield stream.update(packet)
        if i in saved_at:
            stream = Stream(METHODS[name]()).restore(stream.save())


def _compared(way: str, whole: Attitude, pieces: list[Attitude], name: str) -> Check:
    table = np.concatenate([piece.table for piece in pieces])
    flags = np.concatenate([piece.flags for piece in pieces])
    bits, own = table.view(np.uint64), np.ascontiguousarray(whole.table).view(np.uint64)
    other = ((bits != own) & ~(np.isnan(table) & np.isnan(whole.table))).any(axis=1)
    other |= flags != whole.flags
    return Check("E16", way, "0 rows differ", name, f"{int(other.sum())} of {len(other)} differ", not other.any())


def _silences(name: str, part: Recording) -> Check:
    """A magnetometer of zeros, of NaN and none at all are one thing."""
    silent = [np.zeros_like(part.mag), np.full_like(part.mag, np.nan), None]
    zeros, *others = (estimate(METHODS[name](), replace(part, mag=mag)) for mag in silent)  # type: ignore[type-var]
    differ = sum(
        not (np.array_equal(zeros.table, o.table, equal_nan=True) and np.array_equal(zeros.flags, o.flags))
        for o in others
    )
    return Check("E10", "mag zero = NaN = absent", "the same bits", name, f"{differ} of 2 differ", differ == 0)


def _plain(name: str, part: Recording, whole: Attitude) -> Check:
    """The same files without a compiler."""
    with TemporaryDirectory() as folder:
        given, answer = Path(folder) / "rows.npz", Path(folder) / "quat.npy"
        np.savez(given, **{s: getattr(part, s) for s in ("time", "gyr", "acc", "mag")})
        here = os.pathsep.join(path for path in sys.path if path)
        subprocess.run(
            [sys.executable, "-m", "fault_bench.plain", name, str(given), str(answer)],
            env=os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": here},
            check=True,
        )
        quat = np.load(answer)
    both = np.isfinite(quat).all(axis=1) & np.isfinite(whole.quat).all(axis=1)
    worst = float(arrays.angle(arrays.multiply(quat[both], arrays.conjugate(whole.quat[both]))).max())
    met = worst <= PLAIN and bool(np.array_equal(np.isfinite(quat), np.isfinite(whole.quat)))
    return Check("E16", f"plain Python, {SECONDS:g} s", f"≤ {PLAIN:g} rad", name, f"{worst:.1e} rad", met)
