"""What every picture shares: colours, lines thinned with their peaks, shaded stretches, axes and files."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from os import getpid
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from poise.errors import FormatError, PoiseError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

POINTS, NARROW_POINTS = 3000, 1000
"""most points of a line, and of one in a narrow picture; longer recordings are thinned so that every peak stays"""
NARROW = 4.4
"""in, the width of a picture for a phone"""
FORMATS = ("png", "svg", "pdf")

# Okabe and Ito's palette, which the colour-blind can tell apart.
BLUE, ORANGE, GREEN, PURPLE = "#0072B2", "#D55E00", "#009E73", "#AA4499"
INK, QUIET, PALE, EDGE, GRID, PAPER = "#222222", "#666666", "#C4C4C4", "#AAAAAA", "#E4E4E4", "#FFFFFF"
BARE: dict[str, Any] = {"frameon": False, "borderpad": 0.0, "borderaxespad": 0.3}  # a legend without a box
LONGEST_TITLE = 55  # characters that leave room for the figures beside them
_EPOCH = (1e8, 1e11)  # s: stamps between these count from 1970, not from the start of a recording


def figure_class() -> type[Figure]:
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise PoiseError('pictures need matplotlib; install it with: pip install "poise[plots]"') from None
    return Figure


@contextmanager
def quiet() -> Iterator[None]:
    """Saving without warnings on stderr: of a character that no font has (it is a box then), of a size too large."""
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore", UserWarning)
        warnings.simplefilter("ignore", RuntimeWarning)
        yield


def save_figure(figure: Figure, path: str | Path) -> None:
    """Write *figure* as PNG, SVG or PDF, by the extension of *path*: the whole file or nothing.

    Raises :class:`FormatError` for another extension or where the file cannot be written.
    """
    path = Path(path)
    kind = path.suffix.lower().removeprefix(".")
    if kind not in FORMATS:
        raise FormatError(f"{path}: cannot draw {path.suffix or 'without an extension'!r}; expected .png, .svg or .pdf")
    stamp = {"png": {}, "svg": {"Date": None}, "pdf": {"CreationDate": None}}[kind]  # the same file each time
    beside = path.with_name(f".{path.name}.{getpid()}.part")
    try:
        with quiet():
            figure.savefig(beside, format=kind, dpi=150, metadata=stamp)
        beside.replace(path)
    except OSError as problem:
        raise FormatError(f"{path}: cannot write there: {problem.strerror or problem}") from None
    finally:
        beside.unlink(missing_ok=True)


def line(
    ax: Axes,
    time: Floats,
    values: Floats,
    label: str,
    colour: str = "",
    width: Floats | None = None,
    low: float | None = None,
) -> None:
    """A line with its band of ± *width* (n,); dashed, for a reference, without a *colour*.

    With *low* the values are angles in degrees shown within [low, low + 360): they are thinned unwrapped, so that a
    seam makes no peaks, and the line is broken there.
    """
    if low is None:
        rows = thinned(values, ax)
        shown = values[rows]
    else:
        whole, known = values.copy(), np.isfinite(values)
        whole[known] = np.unwrap(values[known], period=360.0)
        rows = thinned(whole, ax)
        shown = (whole[rows] - low) % 360.0 + low
        shown[np.abs(np.diff(shown, prepend=shown[:1])) > 180.0] = np.nan
    if width is not None and np.isfinite(width).any():
        half = width[rows]
        told = any(band.get_label() == "±3σ" for band in ax.collections)
        ax.fill_between(
            time[rows], shown - half, shown + half, color=colour, alpha=0.2, lw=0, label="_" if told else "±3σ"
        )
    if colour:
        ax.plot(time[rows], shown, color=colour, lw=1.3, label=label, zorder=3.0)
    else:
        ax.plot(time[rows], shown, color=INK, lw=1.2, ls=(0, (4, 2)), label=label, zorder=2.5)


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
    """Start and length, s, of the stretches where *mask* holds; those too close to tell apart on paper are one."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask & np.isfinite(time), [False]]).astype(np.int8)))
    if not len(edges):
        return []
    whole = float(np.nanmax(time) - np.nanmin(time))
    starts, ends = time[edges[0::2]], time[edges[1::2] - 1]
    apart = np.concatenate([[True], starts[1:] - ends[:-1] > whole / 500.0])
    starts, ends = starts[apart], ends[np.append(apart[1:], True)]
    return [(float(a), max(float(b - a), whole / 1000.0)) for a, b in zip(starts, ends, strict=True)]


def clock(time: Floats) -> tuple[Floats, str]:
    """The stamps as drawn, s, and the axis label: from the first stamp where they count from 1970."""
    known = time[np.isfinite(time)]
    if not len(known) or not _EPOCH[0] < known[0] < _EPOCH[1]:
        return time, "time [s]"
    began = datetime.fromtimestamp(float(known[0]), UTC)
    return time - known[0], f"time [s] since {began:%Y-%m-%d %H:%M:%S} UTC"


def name_panel(ax: Axes, name: str, unit: str) -> None:
    ax.set_title(name, loc="left", fontsize=10.5, fontweight="bold", color=INK, pad=5)
    ax.set_ylabel(unit, fontsize=8.5, color=QUIET)


def legend(ax: Axes, most: int = 5) -> None:
    """The names of the lines, *most* in a row, beside the panel's title; below it in a narrow picture."""
    narrow = is_narrow(ax.figure)
    if narrow:
        ax.set_title(ax.get_title(loc="left"), loc="left", fontsize=10.5, fontweight="bold", color=INK, pad=21)
    box = ax.legend(
        loc="lower left" if narrow else "lower right", bbox_to_anchor=(0.0 if narrow else 1.0, 1.0), ncols=most,
        frameon=False, fontsize=8 if narrow else 9, labelcolor=INK, borderaxespad=0.1, borderpad=0.2,
        columnspacing=1.0 if narrow else 1.4, handlelength=1.2 if narrow else 1.8, handletextpad=0.5 if narrow else 0.8,
    )  # fmt: skip
    box.set_in_layout(not narrow)  # it may reach beyond the panel, which must not shrink for it


def is_narrow(figure: Any) -> bool:
    """Whether *figure* is for a phone."""
    return bool(figure.get_figwidth() < 7.0)


def head(figure: Figure, title: str, facts: Sequence[str] = ()) -> None:
    """The title, and what is worth saying beside it; a narrow picture stands in a page that says both."""
    if is_narrow(figure):
        return
    short = title if len(title) <= LONGEST_TITLE else title[: LONGEST_TITLE - 1] + "…"
    figure.suptitle(short, x=0.008, ha="left", fontsize=13, fontweight="bold", color=INK, parse_math=False)
    figure.text(0.993, 0.993, "  ·  ".join(facts), ha="right", va="top", fontsize=10.5, color=INK, parse_math=False)


def finish(figure: Figure, axes: Sequence[Axes], time: Floats, label: str) -> None:
    for ax in axes:
        ax.grid(True, color=GRID, linewidth=0.6)
        ax.set_axisbelow(True)
        ax.spines[["top", "right"]].set_visible(False)
        ax.spines[["left", "bottom"]].set_color(EDGE)
        ax.tick_params(colors=QUIET, labelsize=9)
    known = time[np.isfinite(time)]
    if len(known) and known.max() > known.min():
        axes[-1].set_xlim(float(known.min()), float(known.max()))
    axes[-1].set_xlabel(label, fontsize=9.5, color=INK, loc="left")
    figure.align_ylabels(list(axes))


def fit(ax: Axes, least: float, floor: float | None = None) -> tuple[float, float]:
    """Limits from the lines alone (a band may be as wide as it likes), at least *least* apart."""
    values = np.concatenate([np.asarray(line.get_ydata(), float) for line in ax.lines])
    values = values[np.isfinite(values)]
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
