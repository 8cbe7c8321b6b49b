"""The tip-over monitor behind estimators: falls, rides and lifts from formulas as a cheap sensor has them, and real trials.

python benchmarks/tipover.py [made] [real]     both by default

Made scenes use seeds from 1000 on, which nothing was chosen by. Real trials are of a sensor moved by hand: what its optical
reference says of it is the truth.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from math import radians
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import poise
from accuracy import trial_files
from poise.data.recording import Recording
from poise.monitor import TipOver, dry_run, judge, tared
from poise.simulation.motion import Motion
from tables import Cell, table

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from tip_scenes import G, first, motion, recorded, step, times, toppling

Floats = NDArray[np.float64]

METHODS = {"tilt": poise.Tilt(), "self-calibrating": poise.SelfCalibrating(), "two-stage": poise.TwoStage()}
WAYS = ("forward", "back", "left", "right")
SEEDS = range(1000, 1008)


def falls() -> Iterator[list[Cell]]:
    """Pendulums pushed off upright, by length: told before the ground, and how long before."""
    time = times(8.0)
    for length in (0.2, 0.4, 0.7, 1.0):
        leads: dict[str, list[float]] = {name: [] for name in METHODS}
        for seed in SEEDS:
            rng = np.random.default_rng(seed)
            lean = toppling(time, 4.0 + rng.uniform(0.0, 1.0), length, push=rng.uniform(0.1, 1.5))
            recording = recorded(motion(time, lean, way=WAYS[seed % 4]), seed=seed)
            ground = time[np.argmax(lean >= radians(89.0))]
            for name, method in METHODS.items():
                found = judge(poise.estimate(method, recording), recording)
                leads[name].append(1e3 * (ground - first(found.events, "TIPPING")))
        for name, lead in leads.items():
            told = sum(value > 0.0 for value in lead)
            yield [f"{length} m", name, f"{told} of {len(lead)}", float(np.nanmin(lead)), float(np.nanmedian(lead))]


def ride(seed: int) -> Motion:
    """60 s over bumps up to 4 cm that tilt the robot by up to 12°, with vibration and slopes of up to 10°."""
    rng, time = np.random.default_rng(seed), times(60.0)
    on = step((time - 4.0) / 1.0)
    centres = np.cumsum(rng.uniform(0.3, 1.5, 60)) + 4.0
    centres = centres[centres < 59.0]
    bells = np.exp(-0.5 * ((time[:, None] - centres) / rng.uniform(0.04, 0.12, len(centres))) ** 2)
    height = bells @ rng.uniform(0.0, 0.04, len(centres))
    lean = radians(12.0) * bells @ rng.uniform(-1.0, 1.0, len(centres))
    slope = np.radians(10.0) * np.sin(2 * np.pi * time / 20.0) * on
    hertz = rng.uniform(15.0, 40.0)
    shake = on * rng.uniform(0.1, 0.5) * G / (2 * np.pi * hertz) ** 2 * np.sin(2 * np.pi * hertz * time)
    climb = np.cumsum(np.sin(slope)) / 200.0 * 0.5  # at 0.5 m/s
    return motion(time, lean + slope, height + shake + climb, way=WAYS[seed % 4])


def lift(seed: int) -> Motion:
    """Picked up by 0.3 to 0.8 m within 0.6 to 1.2 s, tilted by 45 to 80° in the hands, and put back."""
    rng, time = np.random.default_rng(seed), times(18.0)
    height, length = rng.uniform(0.3, 0.8), rng.uniform(0.6, 1.2)
    up = height * (step((time - 4.0) / length) - step((time - 12.0) / 1.2))
    wobble = (
        radians(4.0)
        * np.sin(2 * np.pi * rng.uniform(0.5, 1.0) * time)
        * (step((time - 4.0) / 0.5) - step((time - 12.5) / 0.5))
    )
    tilted = radians(rng.uniform(45.0, 80.0)) * (step((time - 5.5) / 0.6) - step((time - 9.0) / 0.6))
    return motion(time, tilted + wobble, up, way=WAYS[seed % 4])


def false_alarms() -> Iterator[list[Cell]]:
    for name, scene, minutes in (("rides", ride, 1.0), ("lifts", lift, 0.3)):
        for method_name, method in METHODS.items():
            alarms, others = 0, 0
            for seed in SEEDS:
                recording = recorded(scene(seed), seed=seed)
                found = judge(poise.estimate(method, recording), recording)
                alarms += len(dry_run(found, []).alarms)
                others += any(event.state.name in ("PICKED_UP", "FREE_FALL") for event in found.events)
            yield [name, method_name, f"{len(SEEDS)} of {minutes:g} min", str(alarms), f"{others} of {len(SEEDS)}"]


def real(trials: dict[str, Recording]) -> Iterator[list[Cell]]:
    for method_name, method in METHODS.items():
        told = missed = wrong = 0
        leads: list[float] = []
        hours = 0.0
        for recording in trials.values():
            attitude = poise.estimate(method, recording)
            assert recording.truth is not None
            found = judge(attitude, recording, tared(TipOver(), attitude[:500]))
            outcome = dry_run(found, recording.truth, recording)
            told += len(outcome.falls or []) - len(outcome.missed)
            missed += len(outcome.missed)
            wrong += sum(alarm.true is False for alarm in outcome.alarms)
            hours += outcome.hours
            leads += [1e3 * alarm.lead for alarm in outcome.alarms if alarm.true and np.isfinite(alarm.lead)]
        yield [method_name, told, missed, wrong, wrong / hours, float(np.median(leads))]


def main() -> None:
    chosen = sys.argv[1:] or ["made", "real"]
    if "made" in chosen:
        columns = ["length", "method", "told", "least lead, ms", "median, ms"]
        print(f"\nfalls from upright, by pendulum length\n{table(columns, list(falls()), digits=0)}", flush=True)
        columns = ["scene", "method", "runs", "false alarms", "told as carried"]
        print(f"\nwhat is no fall\n{table(columns, list(false_alarms()))}", flush=True)
    if "real" in chosen:
        trials = {path.stem: poise.read(path) for path in trial_files()}
        columns = ["method", "tips told", "missed", "false", "false/h", "median lead, ms"]
        print(f"\nBROAD, against the optical reference\n{table(columns, list(real(trials)), digits=1)}", flush=True)


if __name__ == "__main__":
    main()
