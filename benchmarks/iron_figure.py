"""The picture of a magnetometer that was never calibrated: heading error over time on a trial, beside a hard iron.

python benchmarks/iron_figure.py PICTURE [TRIAL] [MICROTESLA]     05 and 40 by default; the iron is along body x
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

import poise
from ablation import RUNS, axis_errors
from accuracy import trial_files
from poise.plots import save_figure
from poise.plots.style import GRID, INK, QUIET, figure_class

COLOURS = {"causal": "#0072B2", "offline": "#56B4E9", "vqf": "#D55E00", "vqf-offline": "#E69F00"}
LABELS = {"causal": "self-calibrating", "offline": "self-calibrating, offline"}


def main(picture: Path, trial: str, strength: float) -> None:
    recording = next(poise.read(file) for file in trial_files() if file.stem.startswith(trial))
    assert recording.mag is not None
    beside = replace(recording, mag=recording.mag + np.array([strength, 0.0, 0.0]))
    figure = figure_class()(figsize=(9.0, 3.6), layout="constrained")
    ax = figure.subplots()
    for name, run in RUNS.items():
        off = np.abs(np.degrees(axis_errors(run(beside), recording)[:, 2]))
        known = np.flatnonzero(np.isfinite(off))[::50]
        time = recording.time[known] - recording.time[0]
        ax.plot(time, np.maximum(off[known], 0.05), color=COLOURS[name], lw=1.3, label=LABELS.get(name, name))
    ax.set_yscale("log")
    ax.set_yticks([0.1, 1, 10, 100], ["0.1°", "1°", "10°", "100°"])
    ax.grid(True, color=GRID, linewidth=0.6)
    ax.spines[["top", "right"]].set_visible(False)
    ax.tick_params(colors=QUIET, labelsize=9)
    ax.set_xlabel("time, s", color=INK)
    ax.set_ylabel("heading error", color=INK)
    length = float(np.nanmedian(np.linalg.norm(recording.mag, axis=1)))
    ax.set_title(f"trial {trial}, {strength:g} µT of hard iron from the start in a field of {length:.0f} µT", color=INK)
    figure.legend(loc="outside lower center", ncols=4, frameon=False, fontsize=9.5)
    save_figure(figure, picture)


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 4:
        sys.exit(__doc__)
    main(
        Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "05", float(sys.argv[3]) if len(sys.argv) > 3 else 40.0
    )
