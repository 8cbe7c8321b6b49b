"""Every method in worlds with real physics, from a sensor of the MPU-6050's class at 200 samples a second.

    python benchmarks/worlds.py [--quick] [--write]

Four tables: the error of every method in every world; what was asked for, with the magnetometer's iron calibrated once,
too; what the sensor's errors are worth, one at a time made perfect; how late an attitude is. Every figure is a mean over
seeds that were used for nothing else. --write puts them into docs/worlds.md.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

import poise
from poise.doctor import affine
from poise.math import arrays
from poise.simulation import Sensor, Triad, worlds
from poise.simulation.parts import part
from tables import Cell, heading, table

SEEDS = range(9001, 9006)  # never used while worlds, sensors and methods were made
PART = "MPU-6050+QMC5883L"
PAGE = Path(__file__).parents[1] / "docs" / "worlds.md"
MARK = "<!-- what follows is written by: python benchmarks/worlds.py --write -->"
ASKED = {
    "arm, forearm": (3.0, 1.5),
    "arm, upper arm": (3.0, 1.5),
    "handle": (None, 2.0),
}  # ° with armband, with the best
COMMISSIONING = 60.0  # s of other motion that the magnetometer is calibrated by


class Case(NamedTuple):
    """A sensor in a world."""

    world: str
    options: Mapping[str, Any]
    duration: float
    """s"""
    sensors: Mapping[str, str]
    """the name in the table → the world's sensor"""


CASES = (
    Case("balance", {"bumps": 0.004, "vibration": 1.0}, 120.0, {"robot on bumps": "imu"}),
    Case("balance", {"bumps": 0.004, "vibration": 1.0, "hold": 1.0}, 120.0, {"robot, let go after 1 s": "imu"}),
    Case("attitude", {}, 120.0, {"attitude body": "imu"}),
    Case("arm", {}, 300.0, {"arm, forearm": "forearm", "arm, upper arm": "upper_arm"}),
    Case("handle", {}, 300.0, {"handle": "imu"}),
)
METHODS = {
    "self-calibrating": lambda r: poise.estimate(poise.SelfCalibrating(), r),
    "self-calibrating, offline": poise.smooth,
    "armband": lambda r: poise.estimate(poise.Armband(), r),
    "two-stage": lambda r: poise.estimate(poise.TwoStage(), r),
    "adaptive-gain": lambda r: poise.estimate(poise.AdaptiveGain(), r),
}


def without(sensor: Sensor, what: str) -> Sensor:
    """*sensor* with some of its errors taken away."""
    iron = sensor.mag or Triad()
    if what == "iron":
        return replace(sensor, mag=replace(iron, bias=0.0, scale=0.0, misalignment=0.0))
    if what == "gyroscope":
        return replace(sensor, gyr=Triad())
    if what == "accelerometer":
        return replace(sensor, acc=Triad())
    return sensor


def recordings(case: Case, seed: int, duration: float, lacking: str = "") -> dict[str, poise.Recording]:
    world = worlds.make(case.world, seed=seed, sensor=without(part(PART), lacking), **case.options)
    worlds.run(world, duration)
    return {name: world.recording(at) for name, at in case.sensors.items()}


def calibrated(case: Case, seed: int, found: Mapping[str, poise.Recording]) -> dict[str, poise.Recording]:
    """*found* with the iron taken out that another motion of the same devices has told."""
    world = worlds.make(case.world, seed=seed, sensor=PART, **case.options)
    worlds.run(world, COMMISSIONING, worlds.make(case.world, seed=seed + 1000, **case.options).driver())
    told = {name: affine.magnetometer(world.recording(at)) for name, at in case.sensors.items()}
    return {name: each.with_samples(mag=told[name](each.mag)) for name, each in found.items()}


Errors = dict[str, dict[str, list[tuple[float, float, float]]]]  # case → method → a triple a seed, °


def measured(
    cases: Sequence[Case], seeds: Sequence[int], share: float, lacking: str = "", after: Errors | None = None
) -> Errors:
    """Total, heading and inclination RMSE, over the rows in motion; *after* gets those of calibrated devices."""
    found: Errors = {}
    for case in cases:
        for seed in seeds:
            print(f"{case.world}, seed {seed}{f', no error of the {lacking}' if lacking else ''}", file=sys.stderr)
            plain = recordings(case, seed, share * case.duration, lacking)
            _add(found, plain)
            if after is not None and set(case.sensors) & set(ASKED):
                _add(after, calibrated(case, seed, plain))
    return found


def _add(errors: Errors, recordings: Mapping[str, poise.Recording]) -> None:
    for name, recording in recordings.items():
        for method, run in METHODS.items():
            triple = tuple(poise.evaluate(run(recording), recording).rmse_deg())
            errors.setdefault(name, {}).setdefault(method, []).append(triple)


def late(rate: float, seeds: Sequence[int], duration: float) -> list[Cell]:
    """By how much the handle's attitude follows its motion when it comes from a Stream, and what that costs."""
    lags, errors, aligned, calls, ways = [], [], [], [], []
    for seed in seeds:
        world = worlds.make("handle", seed=seed, sensor=PART, rate=rate)
        drive, live = world.driver(), poise.Stream(poise.SelfCalibrating())
        outputs, truths = [], []
        for _ in range(round(duration * rate)):
            for packet in world.step(drive(world)):
                began = perf_counter()
                latest = live.update(packet)
                calls.append(perf_counter() - began)
                ways.append(world.time - float(packet.time))  # type: ignore[arg-type]
            outputs.append(latest.quat[-1] if world.time > 0.1 else np.full(4, np.nan))
            truths.append(world.truth.quat)
        started = round(min(8.0, 0.5 * duration) * rate)
        out, true = np.array(outputs)[started:], np.array(truths)[started:]
        shifts = np.arange(0.0, 0.0301, 0.0005)
        found = [_rmse(out, true, shift * rate) for shift in shifts]
        lags.append(shifts[int(np.argmin(found))])
        errors.append(found[0])
        aligned.append(min(found))
    return [
        f"{rate:.0f}", 1e3 * float(np.mean(ways)), 1e6 * float(np.median(calls)), 1e3 * float(np.mean(lags)),
        float(np.mean(errors)), float(np.mean(aligned)),
    ]  # fmt: skip


def _rmse(out: np.ndarray, true: np.ndarray, rows: float) -> float:
    """° RMS between the output and the truth *rows* rows before."""
    whole, most = int(rows), 32
    n = len(true) - most
    now, then = true[most - whole : most - whole + n], true[most - whole - 1 : most - whole - 1 + n]
    error = arrays.angle(
        arrays.multiply(arrays.conjugate(out[most:]), arrays.slerp(now, then, np.full(n, rows - whole)))
    )
    return float(np.degrees(np.sqrt(np.mean(error**2))))


def report(quick: bool, markdown: bool) -> str:
    seeds, share = (list(SEEDS)[:1], 0.1) if quick else (list(SEEDS), 1.0)
    after: Errors = {}
    errors = measured(CASES, seeds, share, after=after)
    text = [heading(f"Errors, RMSE in degrees in motion, mean of {len(seeds)} seeds (worst)", markdown=markdown)]
    rows: list[list[Cell]] = []
    for name, methods in errors.items():
        for method, each in methods.items():
            mean, worst = np.mean(each, axis=0), np.max(each, axis=0)
            rows.append([name, method, *(f"{a:.2f} ({b:.2f})" for a, b in zip(mean, worst, strict=True))])
    text.append(table(["where", "method", "total", "heading", "inclination"], rows, markdown=markdown))
    text += [heading("What was asked for", markdown=markdown), verdicts(errors, after, markdown)]
    text.append(heading("Total RMSE with one sensor's errors taken away, degrees, mean", markdown=markdown))
    text.append(lacking(errors, seeds[:3], share, markdown))
    text.append(
        heading("From the handle's motion to the attitude, self-calibrating, sample by sample", markdown=markdown)
    )
    columns = [
        "samples/s", "sample on its way, ms", "Stream.update, µs", "output follows motion by, ms", "RMSE at once, °",
        "RMSE less that lag, °",
    ]  # fmt: skip
    text.append(
        table(
            columns,
            [late(rate, seeds[:2], max(60.0 * share, 12.0)) for rate in (200.0, 800.0)],
            markdown=markdown,
            digits=2,
        )
    )
    return "\n".join(text)


def verdicts(errors: Errors, after: Errors, markdown: bool) -> str:
    """As the device came, and with its magnetometer calibrated once."""
    rows: list[list[Cell]] = []
    for name, (with_armband, with_best) in ASKED.items():
        means, calibrated = (
            {method: float(np.mean([total for total, _, _ in each])) for method, each in found[name].items()}
            for found in (errors, after)
        )
        for method, mean in means.items():
            limit = with_armband if method == "armband" else with_best if "self-calibrating" in method else None
            said = [
                "-" if limit is None else "yes" if each <= limit else "missed" for each in (mean, calibrated[method])
            ]
            asked = "-" if limit is None else f"≤ {limit:g}"
            rows.append([name, method, asked, f"{mean:.2f}", said[0], f"{calibrated[method]:.2f}", said[1]])
    columns = ["where", "method", "asked, °", "as it came, °", "met", "calibrated once, °", "met"]
    return table(columns, rows, markdown=markdown)


def lacking(errors: Errors, seeds: Sequence[int], share: float, markdown: bool) -> str:
    cases = [case for case in CASES if case.world in ("arm", "handle")]
    kinds = ("iron", "accelerometer", "gyroscope")
    lesser = {kind: measured(cases, seeds, share, kind) for kind in kinds}
    rows: list[list[Cell]] = []
    for name in (name for case in cases for name in case.sensors):
        for method in METHODS:
            whole = float(np.mean([total for total, _, _ in errors[name][method][: len(seeds)]]))
            parts = [float(np.mean([total for total, _, _ in lesser[kind][name][method]])) for kind in kinds]
            rows.append([name, method, whole, *parts])
    columns = ["where", "method", "as it is", *(f"no errors of {kind}" for kind in kinds)]
    return table(columns, rows, markdown=markdown, digits=2)


def main() -> None:
    form = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    form.add_argument("--quick", action="store_true", help="one seed, a tenth of the time: does it run?")
    form.add_argument("--write", action="store_true", help="write the tables into docs/worlds.md")
    options = form.parse_args()
    found = report(options.quick, options.write)
    print(found)
    if options.write:
        kept = PAGE.read_text(encoding="utf-8").partition(MARK)[0].rstrip()
        PAGE.write_text(f"{kept}\n\n{MARK}\n{found}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
