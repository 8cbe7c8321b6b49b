"""What every picture shares: colours, titles, legends, the axis of time, and files. Its lines are those of `lines`."""

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
from poise.formats.saving import readable

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

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
    title = readable(title)
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
