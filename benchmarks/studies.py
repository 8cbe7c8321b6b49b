"""The measurements that the docs quote beside the accuracy table, each by its name; inclination for tilt and gated.

python benchmarks/studies.py rates         mean error at 286, 95 and 48 samples a second
python benchmarks/studies.py sensitivity   mean error with each parameter halved and doubled alone
python benchmarks/studies.py lean          how far 3 s means of specific force, and of its direction, are from up
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

import numpy as np

import poise
from accuracy import has_heading, trial_files
from poise.data.recording import Recording
from poise.math import arrays
from scores import CHOSEN, score

STRONG = ("07", "15", "21", "29", "31")


def block_means(recording: Recording, samples: int) -> Recording:
    """Fewer, averaged samples; stamps and reference are those of each block's centre."""
    n = len(recording) // samples * samples
    centre = slice(samples // 2, n, samples)
    means = (getattr(recording, name)[:n].reshape(-1, samples, 3).mean(axis=1) for name in ("gyr", "acc", "mag"))
    assert recording.truth is not None
    assert recording.moving is not None
    gyr, acc, mag = means
    truth, moving = recording.truth[centre], recording.moving[centre]
    return Recording(recording.time[centre], gyr, acc, mag, truth=truth, moving=moving)


def totals(method: Any, trials: dict[str, Recording]) -> dict[str, float]:
    """Total RMSE of every trial, degrees; that of the inclination for a method whose heading no sensor gives."""
    return {name: score(poise.estimate(method, r), r, has_heading(method)).judged for name, r in trials.items()}


def line(label: str, errors: dict[str, float]) -> str:
    """Means over all trials, the half that parameters were chosen on, and the other."""
    chosen = [error for name, error in errors.items() if int(name[:2]) in CHOSEN]
    held_out = [error for name, error in errors.items() if int(name[:2]) not in CHOSEN]
    return f"{label:38s} {np.mean(list(errors.values())):6.2f} {np.mean(chosen):6.2f} {np.mean(held_out):6.2f}"


def rates(trials: dict[str, Recording]) -> Iterator[str]:
    methods = {name: cls() for name, cls in poise.METHODS.items()}
    methods["two-stage, first-order"] = poise.TwoStage(transition="first-order")
    methods["armband, euler"] = poise.Armband(kinematics="euler")
    for samples in (1, 3, 6):
        thinned = {name: block_means(recording, samples) for name, recording in trials.items()}
        for name, method in methods.items():
            errors = totals(method, thinned)
            worst = max(errors, key=lambda trial: errors[trial])
            yield line(f"{name}, {285.7 / samples:.0f} Hz", errors) + f"   worst {worst[:2]}: {errors[worst]:.1f}"


def sensitivity(trials: dict[str, Recording]) -> Iterator[str]:
    varied = {
        "armband": ("gyr_noise", "pitch_noise", "roll_noise", "heading_noise", "running_time", "error_time", "alpha"),
        "two-stage": ("gyr_noise", "acc_noise", "mag_noise", "motion_factor"),
        "adaptive-gain": ("k_rest", "k_fast", "threshold", "check_threshold", "k_forced", "check_window"),
        "tilt": ("q_angle", "q_bias", "angle_noise", "initial_bias"),
        "gated": ("gate_rate", "low_pass_time", "still_acc", "still_time"),
    }
    for name, parameters in varied.items():
        method = poise.METHODS[name]()
        yield line(name, totals(method, trials))
        for parameter in parameters:
            for factor in (0.5, 2.0):
                changed = method._replace(**{parameter: factor * getattr(method, parameter)})
                yield line(f"{name}, {parameter} × {factor:g}", totals(changed, trials))
    yield line("two-stage, decouple off", totals(poise.TwoStage(decouple=False), trials))
    yield line("armband, α = β = ζ = 0", totals(poise.Armband(alpha=0.0, beta=0.0, zeta=0.0), trials))
    yield line("armband, fixed R", totals(poise.Armband(r_mode="fixed"), trials))
    yield line("armband, euler", totals(poise.Armband(kinematics="euler"), trials))
    yield line("armband, as printed", totals(poise.Armband.as_printed(), trials))


def lean(trials: dict[str, Recording]) -> Iterator[str]:
    yield "RMS angle between up and the mean over 3 s, with the true attitude, degrees: of f, of f/|f|"
    for name, recording in trials.items():
        if name[:2] in STRONG and recording.truth is not None and recording.moving is not None:
            known = recording.moving & np.isfinite(recording.truth.quat).all(axis=1)
            force = arrays.rotate(recording.truth.quat[known], recording.acc[known])
            direction = force / np.linalg.norm(force, axis=1, keepdims=True)
            angles = [tilt_of_means(v, round(3.0 * recording.rate_hz)) for v in (force, direction)]
            yield f"{name:38s} {angles[0]:6.1f} {angles[1]:6.1f}"


def tilt_of_means(vectors: np.ndarray[Any, Any], window: int) -> float:
    """RMS angle from up, degrees, of the running means of *vectors* (n, 3) in the Earth frame."""
    sums = np.cumsum(vectors, axis=0)
    x, y, z = (sums[window:] - sums[:-window]).T
    return float(np.degrees(np.sqrt(np.mean(np.arctan2(np.hypot(x, y), z) ** 2))))


STUDIES = {"rates": rates, "sensitivity": sensitivity, "lean": lean}

if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] not in STUDIES:
        sys.exit(__doc__)
    if not (files := trial_files()):
        sys.exit("no BROAD trials here; POISE_DATA says where they are")
    for text in STUDIES[sys.argv[1]]({file.stem: poise.read(file) for file in files}):
        print(text, flush=True)
