"""What the sensors of a recording said, and the attitude below it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from poise.data.attitude import Attitude
from poise.data.recording import Recording
from poise.evaluation import Errors
from poise.formats.names import counted
from poise.math import arrays
from poise.plots.attitude import draw_attitude, error_facts
from poise.plots.lines import FORCE, RATE, drawable, fit, gaps, samples, spans, thinned
from poise.plots.style import (
    BLUE,
    GREEN,
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
    legend,
    name_panel,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SENSORS = (  # with what is beyond every sensor's range; a magnetometer's unit may be any
    ("gyr", "Gyroscope", "[°/s]", RATE),
    ("acc", "Accelerometer", "[m/s²]", FORCE),
    ("mag", "Magnetometer", "[µT]", 0.0),
)
_SPIKE = 1e3  # usual lengths of a field
_UNEVEN = 0.05  # a step between stamps that differs by so much of the usual one is worth a panel
_COUNTS = ("#E69F00", 0.9)


def recording_figure(
    recording: Recording,
    attitude: Attitude | None = None,
    errors: Errors | None = None,
    title: str = "",
    *,
    narrow: bool = False,
) -> Figure:
    """Every sensor's axes and length over time, and the steps between stamps where they are uneven.

    Below them, if given, the panels of :func:`attitude_figure`. The rows that errors are counted over are marked at the
    foot of the first panel. Raises :class:`RecordingError` where the attitude's rows are not the recording's.
    """
    panels = _panels(recording)
    ratios = [1.0] * len(panels) + ([1.0, 1.0, 0.8, 0.8] if attitude is not None else [])
    size = (NARROW, 0.6 + 2.3 * len(ratios)) if narrow else (11.0, 0.9 + 2.05 * len(ratios))
    figure = figure_class()(figsize=size, layout="constrained", facecolor=PAPER)
    axes: Sequence[Axes] = np.atleast_1d(figure.subplots(len(ratios), 1, sharex=True, height_ratios=ratios)).tolist()
    time, label = clock(recording.time)
    for ax, panel in zip(axes, panels, strict=False):
        if panel == "steps":
            _draw_steps(ax, time)
        else:
            _draw_sensor(ax, time, recording, panel)
    if recording.moving is not None:
        _mark_counted(axes[0], time, recording)
    facts = [f"{recording.duration:.1f} s at {recording.rate_hz:.1f} Hz, {len(recording)} rows"]
    if attitude is None:
        finish(figure, axes, time, label)
    else:
        finish(figure, axes[: len(panels)], time, "")
        errors = draw_attitude(figure, axes[len(panels) :], attitude, recording, errors)
        facts += [attitude.provenance.method] if attitude.provenance.method else []
        facts += error_facts(attitude, errors)
    head(figure, title or recording.name or "Recording", facts)
    return figure


def _panels(recording: Recording) -> list[str]:
    found = [s for s, *_ in _SENSORS if s != "mag" or recording.has_mag]
    steps = np.diff(recording.time)
    usual = np.median(steps) if len(steps) else np.nan
    uneven = usual > 0 and np.any(~(np.abs(steps / usual - 1.0) <= _UNEVEN))
    return found + (["steps"] if uneven else [])


def _draw_sensor(ax: Axes, time: Floats, recording: Recording, sensor: str) -> None:
    values = getattr(recording, sensor)
    _, name, unit, plausible = next(facts for facts in _SENSORS if facts[0] == sensor)
    values = np.degrees(values) if sensor == "gyr" else values
    given = ~np.isnan(values).any(axis=1) & np.isfinite(time)
    rows = np.flatnonzero(given & np.isfinite(drawable(values)).all(axis=1))
    share, wild = len(rows) / max(len(time), 1), int(np.count_nonzero(given)) - len(rows)
    if wild:
        name += f" ({counted(wild, 'sample')} too large to be drawn)"
    elif share <= 0.99:
        name += f" (a sample in {share:.0%} of the rows)"
    name_panel(ax, name, unit)
    if not len(rows):
        ax.text(0.5, 0.5, "no sample", transform=ax.transAxes, ha="center", va="center", color=QUIET)
        return
    shown = values[rows]
    length = arrays.length(shown)
    drawn = [(shown[:, i], axis, colour) for i, (axis, colour) in enumerate(zip("xyz", (BLUE, ORANGE, GREEN)))]  # noqa: B905
    if sensor != "gyr":
        drawn.insert(0, (length, "length", QUIET))
    for column, axis, colour in drawn:
        samples(ax, time[rows], column, axis, colour, 1.0 if axis != "length" else 1.4)
    fit(ax, least=1.0, plausible=plausible or _SPIKE * float(np.median(length)) or np.inf)
    legend(ax)


def _draw_steps(ax: Axes, time: Floats) -> None:
    name_panel(ax, "Step between stamps", "[ms]")
    steps = 1e3 * np.diff(time)
    keep = np.union1d(thinned(steps, ax), gaps(time) - 1)
    ax.plot(
        time[1:][keep],
        steps[keep],
        color=INK,
        lw=0.8,
        drawstyle="steps-pre",
        label=f"usually {np.nanmedian(steps):.2f} ms",
    )
    if np.nanmax(steps) > 30.0 * np.nanmedian(steps) > 0 and np.nanmin(steps) > 0:
        ax.set_yscale("log")
    else:
        fit(ax, least=1.0)
    legend(ax)


def _mark_counted(ax: Axes, time: Floats, recording: Recording) -> None:
    assert recording.moving is not None
    if found := spans(time, recording.moving):
        colour, opacity = _COUNTS
        across = ax.get_xaxis_transform()
        ax.broken_barh(
            found, (0, 0.03), transform=across, color=colour, alpha=opacity, lw=0, zorder=0.5, label="errors count"
        )
        legend(ax)
