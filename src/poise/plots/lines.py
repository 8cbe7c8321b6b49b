"""Lines thinned with their peaks, their bands, shaded stretches, and the limits of the axis beside them.

Nothing is drawn over a silence: there is no row in it, and a line from one side to the other would show what nobody saw.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from poise.plots.style import INK, Floats, Mask, is_narrow, name_panel

if TYPE_CHECKING:
    from matplotlib.axes import Axes

POINTS, NARROW_POINTS = 3000, 1000
"""most points of a line, and of one in a narrow picture; longer recordings are thinned so that every peak stays"""
RATE, FORCE = 2e4, 8e3  # °/s, m/s²: several times what the widest sensors for motion and impact measure
_SILENCE, _STEPS = 0.5, 5.0  # s, and usual steps: what is longer than both is a gap
_DRAWABLE = 1e12  # what is larger no axis can hold, and no sensor gives
_RARE = 0.01  # of the values: so many beyond what is plausible are no accident, but another unit


def line(
    ax: Axes,
    time: Floats,
    values: Floats,
    label: str,
    colour: str = "",
    width: Floats | None = None,
    low: float | None = None,
    thick: float = 1.3,
    style: str = "-",
    band: str = "±3σ",
    pale: float = 0.2,
) -> None:
    """A line with its band of ± *width* (n,); dashed, for a reference, without a *colour*. Both end at gaps.

    With *low* the values are angles in degrees shown within [low, low + 360): they are thinned unwrapped, so that a
    seam makes no peaks, and the line is broken there.
    """
    values = drawable(values)
    whole = values
    if low is not None:
        whole, known = values.copy(), np.isfinite(values)
        whole[known] = np.unwrap(values[known], period=360.0)
    cuts = gaps(time)
    rows = _with_ends(thinned(whole, ax), cuts)
    shown = whole[rows]
    if low is not None:
        shown = (shown - low) % 360.0 + low
        shown[np.abs(np.diff(shown, prepend=shown[:1])) > 180.0] = np.nan
    broken = np.searchsorted(rows, cuts)
    stamps, shown = np.insert(time[rows], broken, time[cuts]), np.insert(shown, broken, np.nan)
    if width is not None and np.isfinite(width).any():
        half = np.insert(drawable(width)[rows], broken, np.nan)
        name = "_" if any(each.get_label() == band for each in ax.collections) else band
        ax.fill_between(stamps, shown - half, shown + half, color=colour, alpha=pale, lw=0, label=name)
    if colour:
        ax.plot(stamps, shown, color=colour, lw=thick, ls=style, label=label, zorder=3.0)
    else:
        ax.plot(stamps, shown, color=INK, lw=1.2, ls=(0, (4, 2)), label=label, zorder=2.5)


def samples(ax: Axes, time: Floats, values: Floats, label: str, colour: str, thick: float = 0.9) -> None:
    """A line through the samples (n,) that are there, broken at gaps alone: a slower sensor has none in most rows."""
    known = np.flatnonzero(np.isfinite(time) & np.isfinite(drawable(values)))
    line(ax, time[known], values[known], label, colour, thick=thick)


def drawable(values: Floats) -> Floats:
    """*values* with NaN for what no axis can hold."""
    with np.errstate(invalid="ignore"):
        wild = ~(np.abs(values) < _DRAWABLE)
    return np.where(wild, np.nan, values) if wild.any() else values


def gaps(time: Floats) -> NDArray[np.intp]:
    """The rows with a silence before them."""
    with np.errstate(invalid="ignore"):
        steps = np.diff(time)
        rising = steps[steps > 0]
        if not len(rising):
            return np.empty(0, np.intp)
        return np.flatnonzero(steps > max(_SILENCE, _STEPS * float(np.median(rising)))) + 1


def _with_ends(rows: NDArray[np.intp], cuts: NDArray[np.intp]) -> NDArray[np.intp]:
    """*rows* with those on both sides of each gap, so that a thinned line ends where the samples do."""
    return np.union1d(rows, np.concatenate([cuts - 1, cuts])) if len(cuts) else rows


def thinned(values: Floats, ax: Axes) -> NDArray[np.intp]:
    """The rows to draw of values (n,): all, or the lowest and the highest of each of many short stretches, in order."""
    most = NARROW_POINTS if is_narrow(ax.figure) else POINTS
    n, stretches = len(values), most // 2
    if n <= most:
        return np.arange(n)
    size = -(-n // stretches)
    padded = np.full(-(-n // size) * size, np.nan)
    padded[:n] = values
    table = padded.reshape(-1, size)
    lowest = np.argmin(np.where(np.isnan(table), np.inf, table), axis=1)
    highest = np.argmax(np.where(np.isnan(table), -np.inf, table), axis=1)
    rows = np.sort(np.stack([lowest, highest], axis=1), axis=1) + size * np.arange(len(table))[:, None]
    return np.minimum(rows.ravel(), n - 1)


def spans(time: Floats, mask: Mask) -> list[tuple[float, float]]:
    """Start and length, s, of the stretches where *mask* holds; those too close to tell apart on paper are one.

    A row lasts to the next one, so that two states in turn meet; but not over a gap.
    """
    known = np.flatnonzero(np.isfinite(time))
    stamps, held = time[known], np.asarray(mask[known], bool)
    if not held.any():
        return []
    apart = np.zeros(len(stamps), bool)
    apart[gaps(stamps)] = True
    begins = held & (apart | ~np.append(False, held[:-1]))
    lasts = held & (np.append(apart[1:], True) | ~np.append(held[1:], False))
    until = np.where(np.append(apart[1:], True), stamps, np.maximum(np.append(stamps[1:], stamps[-1:]), stamps))
    starts, ends = stamps[begins], until[lasts]
    whole = float(stamps.max() - stamps.min())
    far = np.concatenate([[True], starts[1:] - ends[:-1] > whole / 500.0])
    starts, ends = starts[far], ends[np.append(far[1:], True)]
    return [(float(a), max(float(b - a), whole / 1000.0)) for a, b in zip(starts, ends, strict=True)]


def fit(ax: Axes, least: float, floor: float | None = None, plausible: float = np.inf) -> tuple[float, float]:
    """Limits from the lines alone (a band may be as wide as it likes), at least *least* apart.

    A few values beyond ±*plausible*, which would leave nothing to be seen of the others, are cut off, and the panel says so.
    """
    values = np.concatenate([np.asarray(line.get_ydata(), float) for line in ax.lines])
    values = values[np.isfinite(values)]
    beyond = np.abs(values) > plausible
    if 0 < np.count_nonzero(beyond) <= max(_RARE * len(values), 2.0):
        worst = float(values[beyond][np.argmax(np.abs(values[beyond]))])
        name_panel(ax, f"{ax.get_title(loc='left')} (cut off: up to {worst:.3g})", ax.get_ylabel())
        values = values[~beyond]
    low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
    least = max(least, 1e-6 * max(abs(low), abs(high)))  # of a large number a small step is none
    low, high = (low, high) if high - low > least else ((low + high - least) / 2, (low + high + least) / 2)
    low = low if floor is None else floor
    margin = 0.08 * (high - low)
    limits = low - margin, high + margin
    ax.set_ylim(*limits)
    return limits


def fit_degrees(ax: Axes, floor: float | None = None) -> None:
    from matplotlib.ticker import MaxNLocator, MultipleLocator

    low, high = fit(ax, least=2.0, floor=floor)
    tick = next((tick for tick, span in ((90.0, 240.0), (45.0, 120.0), (30.0, 80.0)) if high - low > span), None)
    ax.yaxis.set_major_locator(MultipleLocator(tick) if tick else MaxNLocator(5))
