"""Estimators side by side: who is how far from the reference, or from the consensus, and when."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from poise.comparison import Comparison, Run
from poise.math import arrays
from poise.plots.lines import FORCE, RATE, fit, samples
from poise.plots.style import (
    BARE,
    BLUE,
    INK,
    NARROW,
    ORANGE,
    PAPER,
    QUIET,
    Floats,
    clock,
    figure_class,
    finish,
    head,
    is_narrow,
    legend,
    name_panel,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEVELS = (1.0, 2.0, 5.0, 10.0, 20.0, 45.0)
"""degrees between one shade and the next"""
SHADES = ("#F1F1F2", "#FCE3B5", "#FBBE6E", "#EE893B", "#D2531B", "#9A2A10", "#4D0F06")
"""from less than 1° to more than 45°: each darker than the one before, so that no eye needs the hue"""
ABSENT = "#A9BDD2"
_COLUMNS, _NARROW_COLUMNS = 900, 320  # of time in a strip


def comparison_figure(comparison: Comparison, title: str = "", *, narrow: bool = False) -> Figure:
    """What the sensors felt, then a strip for each estimator: its distance in heading, and in inclination, over time.

    Each column of a strip has the shade of the largest distance in it, and stays empty where no attitude is known. The
    number beside a strip is its RMS.
    """
    runs = comparison.done
    headed = [run for run in runs if run.heading != "none"]
    rows = [len(headed), len(runs)]
    strip = 0.26
    heights = [1.15, 1.15, *(max(n, 1) * strip for n in rows)]
    size = (NARROW if narrow else 11.0, sum(heights) + (3.4 if narrow else 2.7))
    figure = figure_class()(figsize=size, layout="constrained", facecolor=PAPER)
    axes: Sequence[Axes] = figure.subplots(4, 1, sharex=True, height_ratios=heights)
    time, label = clock(comparison.recording.time)
    _draw_turning(axes[0], time, comparison)
    _draw_strengths(axes[1], time, comparison)
    what = "the reference" if comparison.against == "reference" else "the consensus"
    for ax, part, shown in ((axes[2], "heading", headed), (axes[3], "inclination", runs)):
        name_panel(ax, f"{part.capitalize()}, from {what}", "")
        _draw_strips(ax, time, shown, part, _NARROW_COLUMNS if narrow else _COLUMNS)
    finish(figure, axes, time, label)
    for ax in axes[2:]:
        ax.grid(False)
        ax.spines[["left", "bottom"]].set_visible(False)
        ax.tick_params(axis="y", length=0, labelcolor=INK)
    _key(figure)
    recording = comparison.recording
    head(figure, title or recording.name or "Comparison", [f"{recording.duration:.1f} s at {recording.rate_hz:.1f} Hz"])
    return figure


def _draw_turning(ax: Axes, time: Floats, comparison: Comparison) -> None:
    name_panel(ax, "Turning [°/s]", "")
    samples(ax, time, np.degrees(arrays.length(comparison.recording.gyr)), "angular rate", INK)
    fit(ax, least=10.0, floor=0.0, plausible=RATE)
    legend(ax)


def _draw_strengths(ax: Axes, time: Floats, comparison: Comparison) -> None:
    recording = comparison.recording
    name_panel(ax, "Strength", "")
    samples(ax, time, arrays.length(recording.acc) / recording.gravity, "specific force / g", BLUE)
    if recording.has_mag:
        field = arrays.length(recording.mag)
        field[~((field > 0) & np.isfinite(field))] = np.nan
        if np.isfinite(field).any():
            samples(ax, time, field / np.nanmedian(field), "field / its median", ORANGE)
    fit(ax, least=0.5, plausible=FORCE / recording.gravity)
    legend(ax)


def _draw_strips(ax: Axes, time: Floats, runs: Sequence[Run], part: str, columns: int) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    if not runs:
        ax.text(0.5, 0.5, "no estimator has one", transform=ax.transAxes, ha="center", va="center", color=QUIET)
        ax.set_yticks([])
        return
    edges, place = _columns(time, columns)
    rectangles: dict[str, list[Floats]] = {colour: [] for colour in (*SHADES, ABSENT)}
    numbers = []
    for i, run in enumerate(runs):
        assert run.errors is not None  # of the runs that are done
        angle = np.degrees(getattr(run.errors, part))
        counted = angle[run.errors.counted]
        numbers.append(f"{np.sqrt(np.mean(counted**2)):.1f}°" if len(counted) else "–")
        for start, end, colour in _shaded(angle, place, len(edges) - 1):
            x0, x1, y0, y1 = edges[start], edges[end], i - 0.42, i + 0.42
            rectangles[colour].append(np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]))
    codes = [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
    for colour, boxes in rectangles.items():
        if boxes:
            path = Path(np.concatenate(boxes), codes * len(boxes))
            ax.add_patch(PathPatch(path, facecolor=colour, edgecolor="none", lw=0, snap=False))
    ax.set_ylim(len(runs) - 0.5, -0.5)
    ax.set_yticks(range(len(runs)), [run.name for run in runs], parse_math=False)
    beside = ax.secondary_yaxis("right")
    beside.set_yticks(range(len(runs)), numbers)
    beside.tick_params(length=0, labelsize=9, colors=INK)
    beside.spines["right"].set_visible(False)
    ax.text(1.0, 1.0, "RMS", transform=ax.transAxes, ha="left", va="bottom", fontsize=8.5, color=QUIET)


def _columns(time: Floats, most: int) -> tuple[Floats, np.ndarray[tuple[int], np.dtype[np.intp]]]:
    """The edges of the columns, s, and the column of each row; −1 for a row without a stamp."""
    known = np.isfinite(time)
    low, high = (float(time[known].min()), float(time[known].max())) if known.any() else (0.0, 1.0)
    n = int(np.clip(known.sum(), 1, most))
    edges = np.linspace(low, high if high > low else low + 1.0, n + 1)
    place = np.full(len(time), -1, np.intp)
    place[known] = np.clip(np.searchsorted(edges, time[known], side="right") - 1, 0, n - 1)
    return edges, place


def _shaded(angle: Floats, place: np.ndarray[tuple[int], np.dtype[np.intp]], n: int) -> list[tuple[int, int, str]]:
    """Runs of columns of one shade: first, one past the last, colour. Columns without a row are as the one before."""
    largest, rows = np.full(n, -1.0), np.bincount(place[place >= 0], minlength=n)
    known = np.isfinite(angle) & (place >= 0)
    np.maximum.at(largest, place[known], angle[known])
    level = np.where(largest < 0, len(SHADES), np.searchsorted(LEVELS, largest, side="right"))
    held = np.maximum.accumulate(np.where(rows > 0, np.arange(n), 0))
    near = np.arange(n) - held <= 2  # a longer silence is a gap and stays empty
    level = np.where(near, level[held], -1)
    cuts = np.concatenate([[0], np.flatnonzero(np.diff(level)) + 1, [n]])
    colours = (*SHADES, ABSENT)
    return [(int(a), int(b), colours[level[a]]) for a, b in zip(cuts, cuts[1:], strict=False) if level[a] >= 0]


def _key(figure: Figure) -> None:
    from matplotlib.patches import Patch

    bounds = [f"{b:g}" for b in LEVELS]
    names = [
        f"under {bounds[0]}°",
        *(f"{a}–{b}°" for a, b in zip(bounds, bounds[1:], strict=False)),
        f"over {bounds[-1]}°",
    ]
    patches = [Patch(color=c, lw=0, label=n) for c, n in zip(SHADES, names, strict=True)]
    patches.append(Patch(color=ABSENT, lw=0, label="unknown"))
    figure.legend(
        handles=patches, loc="outside lower right", ncols=4 if is_narrow(figure) else 8, fontsize=8.5, labelcolor=INK,
        handlelength=1.2, columnspacing=1.2, **BARE,
    )  # fmt: skip
