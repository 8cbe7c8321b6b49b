"""What limits a method, trial by trial: its error once one sensor, alone, is replaced by what it should have measured.

python benchmarks/limits.py METHOD...     RMSE, degrees: total, or inclination of a method without a heading of its own

acc        gravity alone, seen from the reference
mag        a level field to the north, as long as the trial's, seen from the reference
scale      the gyroscope without its scale and misalignment errors, fitted to the reference's turns of one second
           (poorly where the trial hardly turns: 11, 15, 25, 27)
bias       the gyroscope without its mean bias in motion, from the same fit, in place of RestBias
gyr        the reference's own turns as rates, without RestBias
gyr+acc    both: what is left is the magnetometer's, and the method's own
"""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation, Slerp

import poise
from accuracy import trial_files
from poise.data.recording import Recording
from tables import Cell, table

Floats = NDArray[np.float64]
UP = np.array([0.0, 0.0, 9.80665])


class Gyroscope(NamedTuple):
    """What the reference says of it: its true rate is ``matrix @ gyr - bias``."""

    matrix: Floats
    bias: Floats


def reference(recording: Recording) -> Rotation:
    """The reference at every row, interpolated where it was not seen."""
    assert recording.truth is not None
    quat, rows = recording.truth.quat, np.arange(len(recording))
    seen = np.flatnonzero(np.isfinite(quat).all(axis=1))
    between = Slerp(seen, Rotation.from_quat(quat[seen][:, [1, 2, 3, 0]]))
    return between(np.clip(rows, seen[0], seen[-1]))


def fitted(recording: Recording, true: Rotation) -> Gyroscope:
    """Least squares, weighted against outliers, over the seconds in motion in which the reference was seen."""
    assert recording.truth is not None and recording.moving is not None
    n = round(recording.rate_hz)
    seen = np.isfinite(recording.truth.quat).all(axis=1)
    starts = [i for i in range(0, len(recording) - n, n) if recording.moving[i : i + n].mean() > 0.5]
    starts = [i for i in starts if seen[i] and seen[i + n] and seen[i : i + n].mean() > 0.95]
    rates = np.stack([recording.gyr[i + 1 : i + n + 1] for i in starts], axis=1)  # by sample in a second, second, axis
    turns = true[starts].inv() * true[np.add(starts, n)]

    def errors(p: Floats) -> Floats:
        turned = Rotation.identity(len(starts))
        for rate in rates @ (np.eye(3) + p[:9].reshape(3, 3)).T - p[9:]:
            turned = turned * Rotation.from_rotvec(rate / recording.rate_hz)
        return (turned.inv() * turns).as_rotvec().ravel()

    p, step = np.zeros(12), 1e-4
    for _ in range(3):
        e = errors(p)
        J = np.stack([(errors(p + step * axis) - e) / step for axis in np.eye(12)], axis=1)
        weight = 1.0 / np.maximum(np.abs(e), 2.0 * np.median(np.abs(e)))
        slack = np.diag([1e-6] * 9 + [0.0] * 3)  # an axis that never turned keeps its scale
        p = p - np.linalg.solve(J.T @ (weight[:, None] * J) + slack, J.T @ (weight * e))
    return Gyroscope(np.eye(3) + p[:9].reshape(3, 3), p[9:])


def replaced(recording: Recording) -> dict[str, tuple[Recording, bool]]:
    """The recording with one sensor after the other put right, and whether RestBias is to run on it."""
    assert recording.mag is not None
    true = reference(recording)
    gyroscope = fitted(recording, true)
    east, north, up = np.median(true.apply(recording.mag), axis=0)
    acc, mag = true.inv().apply(UP), true.inv().apply([0.0, np.hypot(east, north), up])
    turns = np.vstack([np.zeros(3), (true[:-1].inv() * true[1:]).as_rotvec()]) * recording.rate_hz
    return {
        "as it is": (recording, True),
        "acc": (replace(recording, acc=acc), True),
        "mag": (replace(recording, mag=mag), True),
        "scale": (replace(recording, gyr=recording.gyr @ gyroscope.matrix.T), True),
        "bias": (replace(recording, gyr=recording.gyr - gyroscope.bias), False),
        "gyr": (replace(recording, gyr=turns), False),
        "gyr+acc": (replace(recording, gyr=turns, acc=acc), False),
    }


def limits(methods: dict[str, Any]) -> None:
    """Print the tables."""
    rows: dict[str, list[list[Cell]]] = {name: [] for name in methods}
    columns: list[str] = []
    for file in trial_files():
        variants = replaced(poise.read(file))
        columns = list(variants)
        recording = variants["as it is"][0]
        for name, method in methods.items():
            kind = "total" if hasattr(method, "declination") else "inclination"
            attitudes = [poise.estimate(method, r, rest_bias=learns) for r, learns in variants.values()]
            errors = [poise.evaluate(attitude, recording).rmse_deg() for attitude in attitudes]
            rows[name].append([file.stem, *(float(getattr(e, kind)) for e in errors)])
    for name, method in methods.items():
        kind = "total" if hasattr(method, "declination") else "inclination"
        print(f"\n{name}: {kind} RMSE, degrees\n{table(['', *columns], rows[name], digits=2)}", flush=True)


if __name__ == "__main__":
    names = sys.argv[1:]
    if not names or any(name not in poise.METHODS for name in names):
        sys.exit(f"{__doc__}\nmethods: {', '.join(poise.METHODS)}")
    if not trial_files():
        sys.exit("no BROAD trials here; POISE_DATA says where they are")
    limits({name: poise.METHODS[name]() for name in names})
