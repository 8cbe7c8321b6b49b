"""What the doctor's verdicts rest on: how well every way to name the axes fits, when, and how long the vectors are."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from poise.doctor import Diagnosis
from poise.doctor.turning import LAGS, WINDOW
from poise.math import arrays
from poise.plots.lines import FORCE, RATE, fit, samples
from poise.plots.style import (
    BLUE,
    INK,
    NARROW,
    ORANGE,
    PAPER,
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

_SENSORS = (("acc", "gravity", BLUE), ("mag", "field", ORANGE))
_LEAST = 1e-2  # degrees, so that a logarithm is one


def diagnosis_figure(diagnosis: Diagnosis, title: str = "", *, narrow: bool = False) -> Figure:
    """The misfit of all 48 ways to name the axes, that of the axes as they are window by window, |f|, and the rates.

    A misfit is the angle by which gravity or the field move in the room, RMS, as the gyroscope tells.
    """
    figure = figure_class()(figsize=(NARROW, 10.0) if narrow else (11.0, 9.6), layout="constrained", facecolor=PAPER)
    axes: Sequence[Axes] = figure.subplots(4, 1, height_ratios=(1.25, 1.0, 0.9, 0.9))
    _draw_answers(axes[0], diagnosis)
    _draw_windows(axes[1], diagnosis)
    recording = diagnosis.repairs.apply(diagnosis.recording)
    time, label = clock(recording.time)
    force, rate = arrays.length(recording.acc), np.degrees(arrays.length(recording.gyr))
    name_panel(axes[2], "Specific force", "|f| [m/s²]")
    name_panel(axes[3], "Angular rate", "[°/s]")
    for ax, values, colour, name in ((axes[2], force, BLUE, "length"), (axes[3], rate, INK, "length")):
        samples(ax, time, values, name, colour)
    axes[2].axhline(recording.gravity, color=ORANGE, lw=1.2, ls=(0, (4, 2)), zorder=3.0, label="gravity")
    fit(axes[2], least=1.0, plausible=FORCE)
    fit(axes[3], least=10.0, floor=0.0, plausible=RATE)
    finish(figure, axes[:1], np.empty(0), "way to name the axes, the best first")
    finish(figure, axes[1:2], np.empty(0), f"window of {WINDOW:g} s")
    finish(figure, axes[2:], time, label)
    axes[2].sharex(axes[3])
    for ax in axes[2:]:
        legend(ax)
    repaired = "after repair" if diagnosis.repairs else ""
    facts = [f"{len(diagnosis.found('sure'))} sure, {len(diagnosis.found('likely'))} likely"]
    head(
        figure,
        title or diagnosis.recording.name or "Diagnosis",
        facts + ([f"lower panels {repaired}"] * bool(repaired)),
    )
    return figure


def _draw_answers(ax: Axes, diagnosis: Diagnosis) -> None:
    """The 48 answers by each sensor, sorted; the axes as they are marked."""
    name_panel(ax, "Misfit of the 48 ways to name the gyroscope's axes", "RMS [°], log")
    evidence = diagnosis.evidence
    drawn = False
    for sensor, name, colour in _SENSORS:
        turns = getattr(evidence, sensor) if evidence else None
        if turns is None or not len(turns.loss):
            continue
        misfit = _degrees(turns.total)
        order = np.argsort(misfit, kind="stable")
        ax.plot(np.arange(1, 49), misfit[order], "o", ms=4, color=colour, label=name, alpha=0.75)
        place = int(np.flatnonzero(order == 0)[0])
        ax.plot(place + 1, misfit[0], "o", ms=11, mfc="none", mec=colour, mew=1.8, label="_")
        still = float(_degrees(np.array(turns.still_total)))
        ax.axhline(still, color=colour, lw=1.0, ls=":", label="_")
        drawn = True
    if not drawn:
        _nothing(ax, "no windows to judge axes by")
        return
    ax.plot([], [], "o", ms=9, mfc="none", mec=QUIET, mew=1.6, label="axes as they are")
    ax.plot([], [], color=QUIET, lw=1.0, ls=":", label="no gyroscope at all")
    ax.set_yscale("log")
    ax.set_xlim(0.2, 48.8)
    _plain_ticks(ax)
    legend(ax)


def _draw_windows(ax: Axes, diagnosis: Diagnosis) -> None:
    """The misfit over time of the axes as they are, and of the likeliest where that is another."""
    name_panel(ax, "Misfit over time", "[°], log")
    evidence = diagnosis.evidence
    drawn = False
    for sensor, name, colour in _SENSORS:
        turns = getattr(evidence, sensor) if evidence else None
        if turns is None or not len(turns.loss) or evidence is None:
            continue
        best = getattr(evidence.axes.answer, sensor) if diagnosis.found("sure") else 0
        x = np.arange(len(turns.loss))
        ax.plot(x, _degrees(turns.still), color=colour, lw=0.9, ls=":", alpha=0.7, label="_")
        ax.plot(x, _degrees(turns.loss[:, 0]), color=colour, lw=1.2, label=f"{name}, as it is")
        if best:
            ax.plot(x, _degrees(turns.loss[:, best]), color=colour, lw=1.2, ls="--", label=f"{name}, repaired")
        drawn = True
    if not drawn:
        _nothing(ax, f"no window has another {LAGS[0] * WINDOW:g} s later")
        return
    ax.plot([], [], color=QUIET, lw=0.9, ls=":", label="no gyroscope at all")
    ax.set_yscale("log")
    _plain_ticks(ax)
    legend(ax)


def _degrees(
    loss: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return np.maximum(np.degrees(np.sqrt(loss)), _LEAST)


def _plain_ticks(ax: Axes) -> None:
    from matplotlib.ticker import FuncFormatter

    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def _nothing(ax: Axes, text: str) -> None:
    ax.text(0.5, 0.5, text, transform=ax.transAxes, ha="center", va="center", color=QUIET)
    ax.set_xticks([])
    ax.set_yticks([])
