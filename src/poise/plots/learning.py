"""What is known of the sensors over time: a panel for each quantity, each number with its band of one sigma."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from poise.data.learned import Learning
from poise.plots.lines import fit, line
from poise.plots.style import (
    BLUE,
    GREEN,
    NARROW,
    ORANGE,
    PAPER,
    PURPLE,
    clock,
    figure_class,
    finish,
    head,
    legend,
    name_panel,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PALE = 0.13  # bands lie on one another
_COLOURS = (BLUE, ORANGE, GREEN, PURPLE, "#56B4E9", "#999933")


class _Panel(NamedTuple):
    title: str
    unit: str  # as shown
    factor: float
    lines: tuple[tuple[str, str], ...]  # a number's name, and what its line is called
    least: float  # of the axis, in the unit shown


_OFF_DIAGONAL = tuple((f"gyr_scale_{pair}", pair) for pair in ("xy", "xz", "yx", "yz", "zx", "zy"))
_PANELS = (
    _Panel("Gyroscope bias", "[°/s]", float(np.degrees(1.0)), tuple((f"gyr_bias_{a}", a) for a in "xyz"), 0.02),
    _Panel("Gyroscope scale", "[%]", 100.0, tuple((f"gyr_scale_{a}{a}", a) for a in "xyz"), 0.2),
    _Panel("Gyroscope misalignment", "[%]", 100.0, _OFF_DIAGONAL, 0.2),
    _Panel("Accelerometer bias", "[m/s²]", 1.0, tuple((f"acc_bias_{a}", a) for a in "xyz"), 0.02),
    _Panel("Accelerometer scale", "[%]", 100.0, (("acc_scale", "all axes"),), 0.2),
    _Panel("Hard iron", "[magnetometer's unit]", 1.0, tuple((f"hard_iron_{a}", a) for a in "xyz"), 0.0),
    _Panel("Field", "[magnetometer's unit]", 1.0, (("field_north", "north"), ("field_up", "up")), 0.0),
    _Panel(
        "Delays behind the gyroscope", "[ms]", 1e3, (("mag_delay", "magnetometer"), ("acc_delay", "accelerometer")), 2.0
    ),
)


def learning_figure(learning: Learning, title: str = "", *, narrow: bool = False) -> Figure:
    """Biases, scales, misalignment, hard iron, field and delays over time, as far as they are known, with bands of ±σ."""
    panels = [panel for panel in _PANELS if any(name in learning.names for name, _ in panel.lines)]
    count = max(len(panels), 1)
    size = (NARROW, 0.8 + 2.0 * count) if narrow else (11.0, 0.9 + 1.75 * count)
    figure = figure_class()(figsize=size, layout="constrained", facecolor=PAPER)
    axes: list[Axes] = np.atleast_1d(figure.subplots(count, 1, sharex=True)).tolist()
    time, label = clock(learning.time)
    for ax, panel in zip(axes, panels, strict=False):
        _draw(ax, time, learning, panel)
    finish(figure, axes, time, label)
    head(figure, title or "Learned", ["what was known of the sensors by then, ±σ", learning.method])
    return figure


def _draw(ax: Axes, time: np.ndarray, learning: Learning, panel: _Panel) -> None:
    name_panel(ax, panel.title, panel.unit)
    colours = dict(zip((name for name, _ in panel.lines), _COLOURS, strict=False))
    for name, called in panel.lines:
        if name in learning.names:
            column = learning.names.index(name)
            value, sigma = panel.factor * learning.values[:, column], panel.factor * learning.sigma[:, column]
            line(ax, time, value, called, colours[name], sigma, band="_", pale=_PALE)
    _fit(ax, learning, panel)
    ax.axhline(0.0, color="#999999", lw=0.6, zorder=1.0)
    legend(ax, len(panel.lines))


def _fit(ax: Axes, learning: Learning, panel: _Panel) -> None:
    """Room for the lines, and for the bands as they are at the end: at the start they may be as wide as they like."""
    low, high = fit(ax, panel.least)
    at = [learning.names.index(name) for name, _ in panel.lines if name in learning.names]
    if len(learning):
        end, band = panel.factor * learning.values[-1, at], 1.2 * panel.factor * learning.sigma[-1, at]
        known = np.isfinite(end) & np.isfinite(band)
        if known.any():
            ax.set_ylim(min(low, float((end - band)[known].min())), max(high, float((end + band)[known].max())))
