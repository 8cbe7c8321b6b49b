"""A balancing robot's run: moments as photographs, lean with the estimate and the judgement, speed, torques."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from poise.data.event import TipState
from poise.plots.lines import line, spans
from poise.plots.style import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PAPER,
    QUIET,
    figure_class,
    finish,
    head,
    legend,
    name_panel,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from poise.loops.balancing import BalanceRun

_SHADES = {TipState.LEANING: "#F6D9A8", TipState.TIPPING: "#F0A38C", TipState.FALLEN: "#D9D9D9"}


def balance_figure(run: BalanceRun, moments: list[tuple[float, NDArray[np.uint8]]], title: str) -> Figure:
    """*moments* are times (s) and photographs, drawn above the curves."""
    figure = figure_class()(figsize=(11.0, 8.6 if moments else 6.2), layout="constrained")
    head(figure, title, _facts(run))
    shares = [2.3, 2.2, 1.3, 1.1] if moments else [2.2, 1.3, 1.1]
    grid = figure.add_gridspec(len(shares), max(len(moments), 1), height_ratios=shares)
    for i, (moment, picture) in enumerate(moments):
        ax = figure.add_subplot(grid[0, i])
        ax.imshow(picture)
        ax.set_axis_off()
        ax.set_title(f"{moment:.2f} s", fontsize=9.5, color=INK)
    axes = [figure.add_subplot(grid[i, :]) for i in range(len(shares) - 3, len(shares))]
    for ax in axes[:-1]:
        ax.sharex(axes[-1])
        ax.tick_params(labelbottom=False)
    time = run["time"]
    lean, speed, torque = axes
    name_panel(lean, "Lean", "[°], forward")
    line(lean, time, np.degrees(run["estimate"]), "estimate", BLUE)
    line(lean, time, np.degrees(run["lean"]), "truth")
    _mark(axes, run)
    legend(lean, 6)
    name_panel(speed, "Speed", "[m/s]")
    line(speed, time, run["speed"], "robot", GREEN)
    line(speed, time, run["wanted"], "wanted")
    legend(speed)
    name_panel(torque, "Torque of the wheels", "[N m]")
    line(torque, time, run["left"], "left", ORANGE, thick=3.0)  # driving straight both are the same
    line(torque, time, run["right"], "right", BLUE, thick=0.9)
    legend(torque)
    finish(figure, axes, time, "time [s]")
    return figure


def _mark(axes: list[Axes], run: BalanceRun) -> None:
    """Pushes, the judgement, the cut and the impact."""
    time, state = run["time"], run["state"]
    for each, shade in _SHADES.items():
        for i, (start, length) in enumerate(spans(time, state == each)):
            name = "_" if i else each.name.lower()
            axes[0].axvspan(start, start + length, color=shade, lw=0, zorder=0, label=name)
    for push in run.pushes:
        for ax in axes:
            ax.axvspan(push.time, push.time + push.duration, color=QUIET, alpha=0.35, lw=0)
        _name(axes[0], push.time, f"push {np.linalg.norm(push.force):.0f} N", "right")
    if run.cut is not None:
        for ax in axes:
            ax.axvline(run.cut.edge, color=ORANGE, lw=1.2)
        _name(axes[0], run.cut.edge, "motors cut", "right", 0.62)
    if run.fell:
        for ax in axes:
            ax.axvline(run.impact, color=INK, lw=1.2)
        _name(axes[0], run.impact, "impact", "left", 0.34)


def _name(ax: Axes, time: float, text: str, side: str, height: float = 0.9) -> None:
    ax.annotate(
        text, (time, height), xycoords=("data", "axes fraction"), xytext=(-4 if side == "right" else 4, 0),
        textcoords="offset points", ha=side, fontsize=9, color=INK, zorder=4.0,
        bbox={"facecolor": PAPER, "alpha": 0.75, "lw": 0, "pad": 1.0},
    )  # fmt: skip


def _facts(run: BalanceRun) -> list[str]:
    facts = [f"estimate {degrees(run.estimate_rms()):.2f}° RMS"]
    if run.cut is not None and run.fell:
        facts.append(f"motors cut {1e3 * run.lead:.0f} ms before the impact")
    elif run.fell:
        facts.append("fell")
    else:
        facts.append(f"largest lean {degrees(float(np.abs(run['lean']).max())):.1f}°")
    return facts
