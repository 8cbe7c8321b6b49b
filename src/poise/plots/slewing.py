"""A body that is sent from attitude to attitude: photographs, distance from the goal, estimate, torque."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from poise.plots.lines import line
from poise.plots.style import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    QUIET,
    figure_class,
    finish,
    head,
    legend,
    name_panel,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from poise.loops.slewing import SlewingRun

_SETTLED = 2.0  # °


def slewing_figure(run: SlewingRun, usual: SlewingRun, moments: list[tuple[float, NDArray[np.uint8]]]) -> Figure:
    """*run* beside *usual*, that of the truth; *moments* are times (s) and photographs, drawn above the curves."""
    figure = figure_class()(figsize=(11.0, 8.6 if moments else 6.2), layout="constrained")
    settling = ", ".join(f"{turn.settling:.2f}" for turn in run.turns)
    head(figure, f"Slews of 120° by {run.method}, seed {run.seed}", [f"settled after {settling} s"])
    shares = [2.3, 2.2, 1.3, 1.1] if moments else [2.2, 1.3, 1.1]
    grid = figure.add_gridspec(len(shares), max(len(moments), 1), height_ratios=shares)
    for i, (moment, picture) in enumerate(moments):
        photograph = figure.add_subplot(grid[0, i])
        photograph.imshow(picture)
        photograph.set_axis_off()
        photograph.set_title(f"{moment:.1f} s", fontsize=9.5, color=INK)
    axes = [figure.add_subplot(grid[i, :]) for i in range(len(shares) - 3, len(shares))]
    for ax in axes[:-1]:
        ax.sharex(axes[-1])
        ax.tick_params(labelbottom=False)
    away, estimate, torque = axes
    name_panel(away, "From the goal", "[°]")
    line(away, run.time, np.degrees(run.error), run.method, BLUE)
    line(away, usual.time, np.degrees(usual.error), usual.method)
    away.set_yscale("log")
    away.axhline(_SETTLED, color=QUIET, lw=0.8)
    for turn in run.turns:
        for ax in axes:
            ax.axvline(turn.begun, color=QUIET, lw=0.8, ls=":")
    legend(away)
    name_panel(estimate, "Error of the estimate", "[°]")
    line(estimate, run.time, np.degrees(run.estimate), run.method, BLUE)
    name_panel(torque, "Torque", "[N m]")
    for axis, colour, column in zip("xyz", (ORANGE, GREEN, PURPLE), run.torque.T, strict=True):
        line(torque, run.time, column, axis, colour)
    legend(torque)
    finish(figure, axes, run.time, "time [s]")
    return figure
