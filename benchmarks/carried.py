"""What it is worth to start a recording from what was learned on another: the tables on the flagship's page.

    python benchmarks/carried.py [SECTION...]     all of them by default

sensors     what tells the sensors of the trials apart: bias, and scale and misalignment, of the gyroscope by the reference
start       every trial started from the one before it, of the same half and of the same sensor
slew        corrections given out at 5 deg/s on every trial, and around a magnet that comes and goes
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import inf, radians
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import poise
from ablation import FLAGSHIP, slashed
from poise.data.recording import Recording
from poise.math import arrays
from regimes import Table, Trials, main
from scores import halves
from tables import Cell

Floats = NDArray[np.float64]
# Trials whose gyroscopes have the same bias and the same A: see `sensors`.
SENSORS = (("05", "07", "09", "11", "21", "29", "31"), ("03", "25", "27"), ("01", "15"), ("33", "35"))
HALVES = ("all", "chosen", "held-out")


def by_reference(recording: Recording) -> tuple[Floats, Floats, Floats]:
    """A (3, 3), its sigma and the bias (3,) rad/s of the gyroscope: half a second of turning, time and again, beside the
    reference's, by least squares without outliers."""
    assert recording.truth is not None
    quat, step = recording.truth.quat, float(np.median(np.diff(recording.time)))
    n = round(0.5 / step)
    rows, turns = [], []
    for first in range(0, len(recording) - n, n):
        if not np.isfinite(quat[[first, first + n]]).all():
            continue
        gyr = recording.gyr[first + 1 : first + n + 1]
        R, by_bias, by_scale = np.eye(3), np.zeros((3, 3)), np.zeros((3, 9))
        for rate, turn in zip(gyr, Rotation.from_rotvec(gyr * step).as_matrix(), strict=True):
            R = R @ turn
            by_bias -= step * R
            by_scale += step * np.kron(R, rate)
        a, b = (Rotation.from_quat(q[[1, 2, 3, 0]]) for q in quat[[first, first + n]])
        turns.append((a.inv() * b * Rotation.from_matrix(R).inv()).as_rotvec())
        rows.append(np.hstack([by_scale, by_bias]))
    H, z = np.vstack(rows), np.concatenate(turns)
    for _ in range(4):
        x = np.linalg.lstsq(H, z, rcond=None)[0]
        off = np.abs(z - H @ x)
        deviation = 1.5 * float(np.median(off))
        H, z = H[off < 4.0 * deviation], z[off < 4.0 * deviation]
    sigma = deviation * np.sqrt(np.diag(np.linalg.inv(H.T @ H)))
    return x[:9].reshape(3, 3), sigma[:9].reshape(3, 3), x[9:]


def sensors(trials: Trials) -> Iterator[Table]:
    rows: list[list[Cell]] = []
    for group in SENSORS:
        for number in group:
            name = named(trials, number)
            A, sigma, bias = by_reference(trials[name])
            found = poise.estimate(FLAGSHIP, trials[name]).learned
            assert found is not None
            own = np.degrees(found["gyr_bias"]["value"])
            cells = [f"{100 * v:+.2f}±{100 * s:.2f}" for v, s in ((A[1, 2], sigma[1, 2]), (A[2, 1], sigma[2, 1]))]
            rows.append([name, *(f"{v:+.2f}" for v in own), *(f"{v:+.2f}" for v in np.degrees(bias)), *cells])
    columns = ["", "bias x", "y", "z", "by the reference: bias x", "y", "z", "A yz, %", "A zy, %"]
    yield "bias (deg/s) as learned and by the reference, and two elements of A by the reference", columns, rows


def named(trials: Trials, number: str) -> str:
    return next(name for name in trials if name.startswith(number))


def before(trials: Trials, groups: Any) -> dict[str, str]:
    """The trial that each one is started from: the one before it in its group, the last before the first."""
    return {named(trials, n): named(trials, group[i - 1]) for group in groups for i, n in enumerate(group)}


def first_seconds(recording: Recording, seconds: float) -> Recording:
    """The same, judged in its first seconds of motion only."""
    assert recording.truth is not None and recording.moving is not None
    counted = recording.moving & np.isfinite(recording.truth.quat).all(axis=1)
    begun = recording.time[int(np.argmax(counted))]
    return replace(recording, moving=counted & (recording.time < begun + seconds))


def drift(attitude: poise.Attitude, recording: Recording) -> float:
    """RMS of the heading's error, degrees, counted from the first row in motion."""
    assert recording.truth is not None and recording.moving is not None
    counted = recording.moving & np.isfinite(recording.truth.quat).all(axis=1)
    error = arrays.multiply(attitude.quat, arrays.conjugate(recording.truth.quat))[counted]
    heading = np.unwrap(2.0 * np.arctan2(error[:, 3], error[:, 0]))
    return float(np.degrees(np.sqrt(np.mean((heading - heading[0]) ** 2))))


def start(trials: Trials) -> Iterator[Table]:
    cold = {name: poise.estimate(FLAGSHIP, r) for name, r in trials.items()}
    in_halves = [sorted(n[:2] for n in names) for half, names in halves(trials).items() if half != "all"]
    orders = (
        ("the same sensor", before(trials, SENSORS)),
        ("the same half, whatever the sensor", before(trials, in_halves)),
    )
    for label, order in orders:
        cells: dict[str, Floats] = {}
        for name, r in trials.items():
            known = cold[order[name]].learned
            warm = poise.estimate(FLAGSHIP, r, start_from=known)
            both = [poise.evaluate(a, r).rmse_deg() for a in (cold[name], warm)]
            early = [poise.evaluate(a, first_seconds(r, 30.0)).rmse_deg().total for a in (cold[name], warm)]
            back = [poise.evaluate(poise.smooth(r, start_from=k), r).rmse_deg().total for k in (None, known)]
            alone = replace(r, mag=None)
            drifts = [drift(poise.estimate(FLAGSHIP, alone, start_from=k), r) for k in (None, known)]
            pairs = [*([e[i] for e in both] for i in (0, 2)), early, back, drifts]
            cells[name] = np.array(pairs).ravel()
        rows: list[list[Cell]] = [
            [name, order[name][:2], *(slashed(pair, 2) for pair in found.reshape(-1, 2))]
            for name, found in cells.items()
        ]
        for half in HALVES:
            means = np.mean([cells[name] for name in halves(cells)[half]], axis=0)
            rows.append([f"mean, {half}", "", *(slashed(pair) for pair in means.reshape(-1, 2))])
        columns = ["", "from", "total", "inclination", "first 30 s in motion", "offline", "drift without magnetometer"]
        yield f"as ever/started from a trial of {label}: RMSE, degrees", columns, rows


def stepped(attitude: poise.Attitude) -> Floats:
    """How fast, deg/s, each row turned away from what the rate explains."""
    dt = np.diff(attitude.time)
    turn = np.zeros((len(dt), 4))
    half = 0.5 * dt[:, None] * attitude.rate[1:]
    angle = np.linalg.norm(half, axis=1, keepdims=True)
    turn[:, :1], turn[:, 1:] = np.cos(angle), np.sinc(angle / np.pi) * half
    expected = arrays.multiply(attitude.quat[:-1], turn)
    return np.asarray(np.degrees(arrays.angle(arrays.multiply(attitude.quat[1:], arrays.conjugate(expected)))) / dt)


def slew(trials: Trials) -> Iterator[Table]:
    rates = (inf, 10.0, 5.0, 2.0, 1.0)
    rows: list[list[Cell]] = []
    every: dict[float, list[Floats]] = {rate: [] for rate in rates}
    for name, r in trials.items():
        row: list[Cell] = [name]
        for rate in rates:
            a = poise.estimate(FLAGSHIP, r, slew=None if rate == inf else radians(rate))
            begun = int(np.searchsorted(a.time, a.time[0] + 1.0))
            found = np.array([*poise.evaluate(a, r).rmse_deg(), np.max(stepped(a)[begun:])])
            every[rate].append(found)
            row.append(f"{slashed(found[[0, 2]], 2)}, {found[3]:.1f}")
        rows.append(row)
    rows.append(
        ["mean", *(f"{slashed(np.mean(e, axis=0)[[0, 2]])}, {np.max(e, axis=0)[3]:.1f}" for e in every.values())]
    )
    titles = ["as it comes", *(f"{rate:g} deg/s" for rate in rates[1:])]
    yield (
        "total/inclination RMSE, degrees, and the fastest turn that the rate does not explain after the first second, deg/s",
        ["", *titles],
        rows,
    )

    rows = []
    for name in (n for n in trials if "undisturbed" in n):
        r = trials[name]
        assert r.mag is not None
        middle = r.time[0] + 0.5 * r.duration
        near = (r.time >= middle) & (r.time < middle + 10.0)
        disturbed = replace(r, mag=r.mag + near[:, None] * np.array([0.0, 40.0, 0.0]))
        after = replace(r, moving=r.moving & (r.time >= middle) & (r.time < middle + 30.0))
        row = [name]
        for rate in (inf, 5.0):
            a = poise.estimate(FLAGSHIP, disturbed, slew=None if rate == inf else radians(rate))
            away = stepped(a)[(r.time >= middle)[1:]]
            row += [poise.evaluate(a, after).rmse_deg().total, float(away.max())]
        rows.append(row)
    columns = ["", "as it comes: total RMSE", "fastest, deg/s", "5 deg/s: total RMSE", "fastest, deg/s"]
    yield "40 µT on body y for 10 s in the middle: the 30 s from then on", columns, rows


SECTIONS: dict[str, Callable[[Trials], Iterator[Table]]] = {"sensors": sensors, "start": start, "slew": slew}

if __name__ == "__main__":
    main(SECTIONS, __doc__)
