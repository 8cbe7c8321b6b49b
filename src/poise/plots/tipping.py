"""The moment of a tip-over: the way the lean took over the ground's plan, and lean, rate and specific force around it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from poise.data.event import TipState
from poise.data.recording import Recording
from poise.math import arrays
from poise.monitor import Judgement, judge
from poise.monitor.dry_run import on_rows
from poise.plots.lines import FORCE, RATE, fit, line, spans
from poise.plots.style import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PALE,
    PAPER,
    PURPLE,
    QUIET,
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

Floats = NDArray[np.float64]

_BEFORE, _AFTER = 2.5, 2.0  # s around the moment
_OPACITY, _NARROWEST = 0.35, 0.008  # of the panel, a state that can be seen
_ALARMS = (TipState.TIPPING, TipState.FALLEN)
_SHADES = {
    TipState.UNKNOWN: PALE,
    TipState.LEANING: "#E3C800",
    TipState.TIPPING: ORANGE,
    TipState.FALLEN: "#8C2D04",
    TipState.FREE_FALL: PURPLE,
    TipState.PICKED_UP: BLUE,
    TipState.RIGHTED: GREEN,
}


def tip_over_figure(
    judgement: Judgement,
    recording: Recording | None = None,
    *,
    title: str = "",
    method: str = "",
    at: float | None = None,
) -> Figure:
    """The moment *at* (s; the first alarm, or where the least margin was left) with what led to it.

    On the left the lean over the ground's plan, with the range and the limit; on the right lean, rate and specific force
    over time, shaded by state. The reference of *recording*, where there is one, is dashed.
    """
    moment = _moment(judgement) if at is None else at
    rows = np.flatnonzero((judgement.time >= moment - _BEFORE) & (judgement.time <= moment + _AFTER))
    if not len(rows):
        rows = np.arange(len(judgement))
    figure = figure_class()(figsize=(12.0, 6.6), layout="constrained", facecolor=PAPER)
    grid = figure.add_gridspec(3, 2, width_ratios=(1.0, 1.35), height_ratios=(1.5, 0.9, 0.9))
    plan = figure.add_subplot(grid[:, 0])
    top = figure.add_subplot(grid[0, 1])
    axes = [top, *(figure.add_subplot(grid[i, 1], sharex=top) for i in (1, 2))]
    truth = None
    if recording is not None and recording.truth is not None:
        truth = judge(on_rows(recording.truth, judgement.time), None, judgement.tipover._replace(look_ahead=0.0))
    _draw_plan(plan, judgement, truth, rows, moment)
    stamps, label = clock(judgement.time)
    shift = judgement.time[rows[0]] - stamps[rows[0]] if len(rows) else 0.0
    time = stamps[rows]
    _draw_lean(axes[0], judgement, truth, rows, time)
    name_panel(axes[1], "Rate of the lean", "[°/s]")
    line(axes[1], time, np.degrees(judgement.rate[rows]), "rate", BLUE)
    fit(axes[1], least=20.0, plausible=RATE)
    name_panel(axes[2], "Specific force", "|f| / g")
    if recording is not None and len(recording) == len(judgement):
        line(axes[2], time, arrays.length(recording.acc[rows]) / judgement.tipover.gravity, "force", BLUE)
    axes[2].axhline(1.0, color=QUIET, lw=0.8, ls=":")
    fit(axes[2], least=0.5, floor=0.0, plausible=FORCE / judgement.tipover.gravity)
    finish(figure, axes, time, label)
    for ax in axes[:-1]:
        ax.tick_params(labelbottom=False)
    _shade(figure, axes, judgement, rows, time, moment - shift)
    alarms = sum(event.state in _ALARMS and event.before not in _ALARMS for event in judgement.events)
    facts = [method] * bool(method) + [f"{alarms} alarm{'s' * (alarms != 1)}", f"here at {moment:.2f} s"]
    head(figure, title or "Tip-over monitor", facts)
    return figure


def _moment(judgement: Judgement) -> float:
    for event in judgement.events:
        if event.state in _ALARMS:
            return event.time
    if np.isfinite(judgement.margin).any():
        return float(judgement.time[int(np.nanargmin(judgement.margin))])
    known = judgement.time[np.isfinite(judgement.time)]
    return float(known[0]) if len(known) else 0.0


def _draw_plan(ax: Axes, judgement: Judgement, truth: Judgement | None, rows: NDArray[np.intp], moment: float) -> None:
    name_panel(ax, "Tilt, as seen from above", "forward [°]")
    for kind, colour, name in (("range", "#C9A800", "range"), ("limit", ORANGE, "limit")):
        right, forward = boundary(judgement, kind)
        ax.plot(right, forward, color=colour, lw=1.6, label=name)
    if truth is not None:
        ax.plot(*_plan(truth, rows), color=INK, lw=1.0, ls=(0, (4, 2)), label="reference")
    right, forward = _plan(judgement, rows)
    ax.plot(right, forward, color=BLUE, lw=1.6, label="tilt")
    now = int(np.argmin(np.abs(np.where(np.isfinite(judgement.time), judgement.time, np.inf)[rows] - moment)))
    ax.plot(right[now], forward[now], "o", ms=9, mfc="none", mec=INK, mew=1.8, label="the moment")
    ax.axhline(0.0, color=PALE, lw=0.8)
    ax.axvline(0.0, color=PALE, lw=0.8)
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel("right [°]", fontsize=8.5, color=QUIET)
    ax.spines[["top", "right"]].set_visible(False)
    ax.tick_params(colors=QUIET, labelsize=9)
    ax.legend(frameon=False, fontsize=9, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=5, labelcolor=INK)


def _plan(judgement: Judgement, rows: NDArray[np.intp]) -> tuple[Floats, Floats]:
    """Degrees of tilt to the right and forward."""
    forward, _, _, right = np.tan(judgement.directions[rows]).T
    facing = np.where(judgement.tilt[rows] > np.pi / 2, -1.0, 1.0)  # past level the tangents turn about
    azimuth = np.arctan2(facing * right, facing * forward)
    tilt = np.degrees(judgement.tilt[rows])
    return tilt * np.sin(azimuth), tilt * np.cos(azimuth)


def boundary(judgement: Judgement, kind: str) -> tuple[Floats, Floats]:
    """Degrees of tilt to the right and forward at which the range or the limit is reached, all around."""
    sides = [side for side in judgement.tipover.sides() if np.isfinite(side.limit)]
    azimuth = np.linspace(-np.pi, np.pi, 1441)
    steepest = np.full(len(azimuth), np.inf)
    for side in sides:
        facing = side.right * np.sin(azimuth) + side.forward * np.cos(azimuth)
        with np.errstate(divide="ignore"):
            reach = np.where(facing > 1e-9, np.tan(min(getattr(side, kind), 1.57)) / np.maximum(facing, 1e-9), np.inf)
        steepest = np.minimum(steepest, reach)
    tilt = np.degrees(np.arctan(steepest))
    return tilt * np.sin(azimuth), tilt * np.cos(azimuth)


def _draw_lean(ax: Axes, judgement: Judgement, truth: Judgement | None, rows: NDArray[np.intp], time: Floats) -> None:
    name_panel(ax, "Lean", "across its side [°]")
    if truth is not None:
        line(ax, time, np.degrees(truth.lean[rows]), "reference")
    line(ax, time, np.degrees(judgement.lean[rows]), "lean", BLUE)
    line(ax, time, np.degrees(judgement.lean + judgement.margin)[rows], "limit", ORANGE)
    impact = float(np.degrees(judgement.tipover.impact))
    ax.axhline(impact, color=INK, lw=1.0, ls=":", label="impact")
    fit(ax, least=20.0)
    legend(ax)


def _shade(
    figure: Figure, axes: list[Axes], judgement: Judgement, rows: NDArray[np.intp], time: Floats, moment: float
) -> None:
    from matplotlib.patches import Patch

    told = []
    # A body that falls leans for one sample only, which the line of the moment would hide
    least = _NARROWEST * float(np.nanmax(time) - np.nanmin(time)) if np.isfinite(time).any() else 0.0
    for ax in axes:
        ax.axvline(moment, color=INK, lw=1.2)
    for state, colour in _SHADES.items():
        stretches = spans(time, judgement.state[rows] == state)
        for ax in axes:
            for start, length in stretches:
                begin = min(start, start + length - least)
                ax.axvspan(begin, start + length, color=colour, alpha=_OPACITY, lw=0)
        if stretches:
            told.append(Patch(color=colour, alpha=_OPACITY, label=state.name.lower().replace("_", " ")))
    if told:
        figure.legend(handles=told, loc="outside lower right", ncols=len(told), frameon=False, fontsize=9)
