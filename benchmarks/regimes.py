"""Each source's method in the regime that its source is made for: the figures on the methods' pages.

python benchmarks/regimes.py [armband] [tilt] [gated] [stamps] [sigma]     all of them by default
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np
from scipy.spatial.transform import Rotation

import poise
from accuracy import trial_files
from poise.data.recording import Recording
from poise.math import arrays
from poise.peers import chosen
from poise.simulation import PERFECT, at_rest, forearm, measure
from studies import block_means
from tables import Cell, table

Trials = dict[str, Recording]
Table = tuple[str, list[str], list[list[Cell]]]

SLOW, BREAKS = ("01", "03", "05", "11"), ("05", "09")
PURE = poise.Gated(gate_rate=0.0)  # never corrected: the gyroscope integrated


def armband(trials: Trials) -> Iterator[Table]:
    """A made forearm within ±60° of pitch, by all three kinematics."""
    del trials
    rows: list[list[Cell]] = []
    for seed in range(6):
        recording = measure(forearm(60.0, 100.0, seed), seed=seed)
        methods = [poise.Armband(), poise.Armband(kinematics="euler"), poise.Armband.as_printed()]
        errors = [poise.evaluate(poise.estimate(method, recording), recording) for method in methods]
        rows.append([f"seed {seed}", *(e.rmse_deg().total for e in errors)])
    yield "armband, made forearm: total RMSE, degrees", ["", "default", "euler", "as printed"], rows


def tilt(trials: Trials) -> Iterator[Table]:
    """Angle from the vertical in slow motion, and the bias at the end of each rest."""
    variants = {
        "default": poise.Tilt(),
        "Q per step": poise.Tilt(q_scaling="print"),
        "R at rest": poise.Tilt(r="rest"),
        "fixed ratio": poise.Tilt(gain="fixed"),
        "as printed": poise.Tilt.as_printed(),
    }
    rows: list[list[Cell]] = []
    for name in trials:
        if name[:2] in SLOW:
            errors = [poise.evaluate(poise.estimate(m, trials[name]), trials[name]) for m in variants.values()]
            rows.append([name, *(e.rmse_deg().inclination for e in errors)])
    rows.append(["mean", *(float(np.mean([row[i] for row in rows])) for i in range(1, len(variants) + 1))])  # type: ignore[arg-type]
    yield "tilt, slow trials: inclination RMSE, degrees", ["", *variants], rows

    rows = []
    for samples in (1, 3, 6):
        thinned = [block_means(recording, samples) for name, recording in trials.items() if name[:2] in SLOW]
        errors = [poise.evaluate(poise.estimate(poise.Tilt(), r), r).rmse_deg().inclination for r in thinned]
        rows.append([f"{285.7 / samples:.0f} Hz", *errors, float(np.mean(errors))])
    yield "tilt, slow trials by sampling rate: inclination RMSE, degrees", ["", *SLOW, "mean"], rows

    # What a user without a magnetometer may take instead
    choices = {
        "tilt": poise.Tilt(),
        "fixed ratio": poise.Tilt(gain="fixed"),
        "gated": poise.Gated(),
        "two-stage": poise.TwoStage(),
        "adaptive-gain": poise.AdaptiveGain(),
        "armband": poise.Armband(),
    }
    rows = []
    for name, recording in trials.items():
        six = replace(recording, mag=None)
        errors = [poise.evaluate(poise.estimate(m, six), six).rmse_deg().inclination for m in choices.values()]
        rows.append([name, *errors])
    rows.append(["mean", *(float(np.mean([row[i] for row in rows])) for i in range(1, len(choices) + 1))])  # type: ignore[arg-type]
    yield "without magnetometer, every method: inclination RMSE, degrees", ["", *choices], rows

    injected = np.radians([0.5, -0.4, 0.3])
    rows = []
    for name, recording in trials.items():
        assert recording.moving is not None
        biased = replace(recording, gyr=recording.gyr + injected)
        after, before = (poise.estimate(poise.Tilt(), r) for r in (biased, recording))
        ends = np.flatnonzero(np.diff(recording.moving.astype(int)) == 1)  # the last row of every rest before motion
        found = np.degrees(arrays.rotate(after.quat, after.bias - before.bias - injected))
        rows.append([name, len(ends), *(float(np.abs(found[ends, axis]).max()) for axis in range(3))])
    columns = ["", "rests", "Earth x", "Earth y", "up (not observable)"]
    yield "tilt: largest error of an injected bias at the end of a rest, deg/s", columns, rows


def from_the_reference(method: poise.Gated, recording: Recording) -> poise.Errors:
    """Errors from the reference's first attitude on, without RestBias; integration and print without Guard too."""
    assert recording.truth is not None
    recording = recording[int(np.argmax(np.isfinite(recording.truth.quat).all(axis=1))) :]
    guard = (
        method not in (PURE, poise.Gated.as_printed()) or None
    )  # it would start them anew where they have drifted off
    attitude = poise.estimate(method, recording, start=recording.truth, rest_bias=False, guard=guard)
    return poise.evaluate(attitude, recording)


def gated(trials: Trials) -> Iterator[Table]:
    """Against pure integration on the trials, and a phone held upright."""
    rows: list[list[Cell]] = []
    for name, recording in trials.items():
        pure, ours, printed = (
            from_the_reference(method, recording).rmse_deg()
            for method in (PURE, poise.Gated(), poise.Gated.as_printed())
        )
        rows.append(
            [
                name + (" *" if name[:2] in BREAKS else ""),
                *(pure.inclination, ours.inclination, printed.inclination, ours.inclination / pure.inclination),
                *(pure.heading, ours.heading, ours.heading / pure.heading),
            ]
        )
    columns = ["* has breaks", "pure incl.", "gated", "as printed", "gated/pure", "pure heading", "gated", "gated/pure"]
    yield "gated, from the reference's first attitude, without RestBias: RMSE, degrees", columns, rows

    rows = []
    for pitch in (76.0, 85.0):
        for axis in range(3):
            upright = Rotation.from_euler("ZXY", [30.0, pitch, 5.0], degrees=True).as_quat()[[3, 0, 1, 2]]
            still = measure(at_rest(upright, 30.0, 100.0), PERFECT)
            biased = replace(still, gyr=still.gyr + np.radians(0.2) * np.eye(3)[axis])
            errors = [from_the_reference(m, biased) for m in (poise.Gated(), poise.Gated.as_printed(), PURE)]
            rows.append([f"{pitch:.0f}°, bias on {'xyz'[axis]}", *(float(np.degrees(e.total[-1])) for e in errors)])
    columns = ["", "gated", "as printed", "pure integration"]
    yield "gated, a phone still for 30 s with 0.2 deg/s of bias: total error at the end, degrees", columns, rows


def stamps(trials: Trials) -> Iterator[Table]:
    """Stamps that scatter about an even pace, at 95 Hz: off by up to so much of a period, or late as on a busy computer."""
    vqf = chosen("vqf")["vqf"]
    rows: list[list[Cell]] = []
    for label, share in (
        ("even", 0.0),
        ("±0.1", 0.1),
        ("±0.2", 0.2),
        ("±0.3", 0.3),
        ("±0.4", 0.4),
        ("late, mean 0.2", -0.2),
    ):
        cells: list[list[float]] = []
        for name, recording in trials.items():
            thin, rng = block_means(recording, 3), np.random.default_rng(int(name[:2]))
            n, period = len(thin), float(np.median(np.diff(thin.time)))
            off = share * rng.uniform(-1.0, 1.0, n) if share >= 0.0 else rng.exponential(-share, n)
            late = replace(thin, time=np.maximum.accumulate(thin.time + period * off))
            made = [
                poise.estimate(poise.SelfCalibrating(), late),
                poise.smooth(late),
                poise.estimate(poise.TwoStage(), late),
            ]
            cells.append([poise.evaluate(a, thin).rmse_deg().total for a in (*made, vqf.attitude(late))])
        rows.append([label, *(float(v) for v in np.mean(cells, axis=0))])
    yield (
        "stamps off by a share of the period, 95 Hz: mean total RMSE, degrees",
        ["", "self-calibrating", "offline", "two-stage", "vqf"],
        rows,
    )


def sigma(trials: Trials) -> Iterator[Table]:
    """How the methods' sigma covers their errors, per Earth axis; of Tilt the inclination only."""
    rows: list[list[Cell]] = []
    for name in ("armband", "two-stage"):
        ratios = np.concatenate([_per_axis(poise.METHODS[name](), recording) for recording in trials.values()])
        inside, median = 100.0 * (ratios < 3.0).mean(axis=0), np.median(ratios, axis=0)
        rows.append([name, *inside.tolist(), *median.tolist()])
    columns = ["", "within 3σ: x %", "y %", "z %", "median error/σ: x", "y", "z"]
    yield "sigma about the Earth's axes, all trials pooled", columns, rows
    rows = []
    for label, names in (("slow trials", SLOW), ("all trials", tuple(name[:2] for name in trials))):
        ratios = np.concatenate([_tilt_ratio(r) for name, r in trials.items() if name[:2] in names])
        rows.append([f"tilt, {label}", float(100.0 * (ratios < 3.0).mean()), float(np.median(ratios))])
    yield "inclination error over √(σx² + σy²)", ["", "within 3 %", "median"], rows


def _per_axis(method: object, recording: Recording) -> np.ndarray:
    assert recording.truth is not None and recording.moving is not None
    attitude = poise.estimate(method, recording)
    ok = recording.moving & np.isfinite(recording.truth.quat).all(axis=1)
    q, truth = (Rotation.from_quat(a.quat[ok][:, [1, 2, 3, 0]]) for a in (attitude, recording.truth))
    return np.abs((q * truth.inv()).as_rotvec()) / attitude.sigma[ok]


def _tilt_ratio(recording: Recording) -> np.ndarray:
    attitude = poise.estimate(poise.Tilt(), recording)
    errors = poise.evaluate(attitude, recording)
    return (errors.inclination / np.hypot(attitude.sigma[:, 0], attitude.sigma[:, 1]))[errors.counted]


REGIMES: dict[str, Callable[[Trials], Iterator[Table]]] = {
    "armband": armband, "tilt": tilt, "gated": gated, "stamps": stamps, "sigma": sigma,
}  # fmt: skip


def main(sections: Mapping[str, Callable[[Trials], Iterator[Table]]], usage: str | None) -> None:
    """Print the tables of the sections named on the command line, or of all."""
    names = sys.argv[1:] or list(sections)
    if unknown := [name for name in names if name not in sections]:
        sys.exit(f"no section {unknown[0]!r}\n\n{usage}")
    if not (files := trial_files()):
        sys.exit("no BROAD trials here; POISE_DATA says where they are")
    recordings = {file.stem: poise.read(file) for file in files}
    for name in names:
        for title, columns, rows in sections[name](recordings):
            print(f"\n{title}\n{table(columns, rows, digits=2)}", flush=True)


if __name__ == "__main__":
    main(REGIMES, __doc__)
