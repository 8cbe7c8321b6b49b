"""Pictures of an attitude; matplotlib is imported when the first one is drawn, and no state of it is touched."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from os import getpid
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude
from poise.data.flags import HEADING_ARBITRARY, INVALID, REST, Flag, valid
from poise.data.recording import Recording
from poise.errors import FormatError, PoiseError, RecordingError
from poise.evaluation import Errors, evaluate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

POINTS = 4000
"""most points of a line; longer recordings are thinned so that every peak stays"""
FORMATS = ("png", "svg", "pdf")

# Okabe and Ito's palette, which the colour-blind can tell apart.
_BLUE, _ORANGE, _GREEN, _PURPLE = "#0072B2", "#D55E00", "#009E73", "#AA4499"
_INK, _QUIET, _PALE = "#222222", "#666666", "#C4C4C4"
_REST_SHADE, _INVALID_SHADE, _FLAG_SHADE = ("#7FA6C9", 0.22), ("#CC1F1F", 0.35), ("#E69F00", 0.9)  # colour, opacity
_STRIP = 0.045  # of a panel's height, at its foot: flags are many, and shades behind the lines would drown them
_BARE: dict[str, Any] = {"frameon": False, "borderpad": 0.0, "borderaxespad": 0.3}  # a legend without a box
_UNDETERMINED = 80.0  # degrees of pitch past which heading and roll are hardly determined
_LONGEST_TITLE = 55  # characters that leave room for the figures beside them
_EPOCH = (1e8, 1e11)  # s: stamps between these count from 1970, not from the start of a recording


def attitude_figure(
    attitude: Attitude, recording: Recording | None = None, errors: Errors | None = None, title: str = ""
) -> Figure:
    """Heading, pitch and roll, tilt, and the error over time; without a reference, the gyroscope's bias.

    The reference of *recording*, on the rows of *attitude*, is dashed. Light bands are ±3 standard deviations where the
    method knows them; shaded stretches are at rest, flagged or not valid. _Angles are those of a body with x right and
    y forward. Raises :class:`RecordingError` for an attitude relative to another body and for a recording whose rows
    are not the attitude's.
    """
    for name, other in (("recording", recording), ("table of errors", errors.time if errors is not None else None)):
        if other is not None and len(other) != len(attitude):
            raise RecordingError(
                f"the {name} has {len(other)} rows, the attitude {len(attitude)}; resample the attitude"
            )
    truth = recording.truth if recording is not None else None
    if errors is None and recording is not None and truth is not None:
        errors = evaluate(attitude, recording)
    angles, reference = _angles(attitude), _angles(truth) if truth is not None else None
    attitude = _in_enu(attitude)
    figure = _figure_class()(figsize=(11.0, 8.6), layout="constrained", facecolor="white")
    axes: Sequence[Axes] = figure.subplots(4, 1, sharex=True, height_ratios=(1.0, 1.0, 0.8, 0.8))
    time, label = _clock(attitude.time)
    _draw_heading(axes[0], time, attitude, angles, reference)
    _draw_pitch_and_roll(axes[1], time, attitude, angles, reference)
    _draw_tilt(axes[2], time, attitude, angles, reference)
    if errors is not None:
        _draw_errors(axes[3], time, attitude, errors)
    else:
        _draw_bias(axes[3], time, attitude)
    _finish(figure, axes, time, label)
    _draw_flags(figure, axes, time, attitude.flags)
    _head(figure, title or (recording.name if recording is not None else ""), attitude, errors)
    return figure


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
        figure.savefig(beside, format=kind, dpi=150, metadata=stamp)
        beside.replace(path)
    except OSError as problem:
        raise FormatError(f"{path}: cannot write there: {problem.strerror or problem}") from None
    finally:
        beside.unlink(missing_ok=True)


def _figure_class() -> type[Figure]:
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise PoiseError('pictures need matplotlib; install it with: pip install "poise[plots]"') from None
    return Figure


# -- panels -------------------------------------------------------------------------------------------------------


def _draw_heading(ax: Axes, time: Floats, attitude: Attitude, angles: _Angles, reference: _Angles | None) -> None:
    from matplotlib.ticker import FuncFormatter

    north = attitude.heading_reference
    zero = "an arbitrary zero" if north == "arbitrary" else f"{north} north"
    _name(ax, f"Heading ({north})", f"from {zero} [°]")
    heading, steep = angles.heading, angles.steep
    known = np.radians(heading[np.isfinite(heading)])
    centre = np.degrees(np.arctan2(np.sin(known).sum(), np.cos(known).sum()))
    low = float(np.round(centre / 45.0)) * 45.0 - 180.0  # the seam lies opposite to where the heading mostly is
    if reference is not None:
        _line(ax, time, np.where(steep, np.nan, reference.heading), "reference", low=low)
    _doubtful_line(ax, time, heading, steep, low)
    plain = np.where(steep, np.nan, heading)
    _line(ax, time, plain, "heading", _BLUE, 3.0 * np.degrees(_euler_sigmas(attitude, angles)[0]), low)
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value % 360:g}"))
    _fit_degrees(ax)
    _legend(ax)


def _draw_pitch_and_roll(
    ax: Axes, time: Floats, attitude: Attitude, angles: _Angles, reference: _Angles | None
) -> None:
    _name(ax, "Pitch and roll", "about body x and y [°]")
    _, pitch, roll, _, steep = angles
    if reference is not None:
        _line(ax, time, reference.pitch, "reference")
        _line(ax, time, np.where(steep, np.nan, reference.roll), "_", low=-180.0)
    _, of_pitch, of_roll = _euler_sigmas(attitude, angles)
    _doubtful_line(ax, time, roll, steep, -180.0)
    plain = np.where(steep, np.nan, roll)
    _line(ax, time, plain, "roll", _ORANGE, 3.0 * np.degrees(of_roll), -180.0)
    _line(ax, time, pitch, "pitch", _BLUE, 3.0 * np.degrees(of_pitch))
    if steep.any():
        ax.plot([], [], color=_PALE, label=f"|pitch| > {_UNDETERMINED:.0f}°: heading, roll not determined")
    _fit_degrees(ax)
    _legend(ax)


def _draw_tilt(ax: Axes, time: Floats, attitude: Attitude, angles: _Angles, reference: _Angles | None) -> None:
    _name(ax, "Tilt", "body z from up [°]")
    if reference is not None:
        _line(ax, time, reference.tilt, "reference")
    sigma = np.hypot(*attitude.sigma[:, :2].T) / np.sqrt(2.0)
    _line(ax, time, angles.tilt, "tilt", _GREEN, 3.0 * np.degrees(sigma))
    _fit_degrees(ax, floor=0.0)
    _legend(ax)


def _draw_errors(ax: Axes, time: Floats, attitude: Attitude, errors: Errors) -> None:
    _name(ax, "Error", "against the reference [°]")
    for name, colour in (("inclination", _GREEN), ("heading", _PURPLE), ("total", _INK)):
        _line(ax, time, np.degrees(getattr(errors, name)), name, colour)
    _fit_degrees(ax, floor=0.0)
    claimed = 3.0 * np.degrees(np.linalg.norm(attitude.sigma, axis=1))
    if np.isfinite(claimed).any():
        rows, usual = _thinned(claimed), float(np.nanmedian(claimed))
        above = f" (about {usual:.0f}°, above the axis)" if usual > ax.get_ylim()[1] else ""
        ax.plot(time[rows], claimed[rows], color=_QUIET, lw=1.1, ls=":", label=f"3σ of the total{above}")
    _legend(ax)


def _draw_bias(ax: Axes, time: Floats, attitude: Attitude) -> None:
    _name(ax, "Gyroscope bias", "[°/s]")
    for i, (axis, colour) in enumerate(zip("xyz", (_BLUE, _ORANGE, _GREEN), strict=True)):
        bias, sigma = np.degrees(attitude.bias[:, i]), np.degrees(attitude.bias_sigma[:, i])
        _line(ax, time, bias, axis, colour, 3.0 * sigma)
    _fit(ax, least=0.2)
    _legend(ax)


def _draw_flags(figure: Figure, axes: Sequence[Axes], time: Floats, flags: NDArray[np.uint32]) -> None:
    """Shade rest and what is not valid, mark other flags at the foot of each panel; one legend names them."""
    from matplotlib.patches import Patch

    invalid = ~valid(flags)
    # That a heading is arbitrary stands on its axis; as a flag it only matters where it changes.
    told = REST | INVALID | (HEADING_ARBITRARY if (flags & np.uint32(HEADING_ARBITRARY)).all() else 0)
    others = flags & np.uint32(0xFFFFFFFF ^ told)
    kinds = (
        ("at rest", ((flags & np.uint32(REST)) != 0) & ~invalid, _REST_SHADE, 1.0),
        ("not valid", invalid, _INVALID_SHADE, 1.0),
        (f"flagged: {_flag_names(others)}", others != 0, _FLAG_SHADE, _STRIP),
    )
    patches = []
    for name, mask, (colour, opacity), height in kinds:
        if spans := _spans(time, mask):
            patches.append(Patch(color=colour, alpha=opacity, lw=0, label=name))
            for ax in axes:
                across = ax.get_xaxis_transform()
                ax.broken_barh(spans, (0, height), transform=across, color=colour, alpha=opacity, lw=0, zorder=0.5)
    if patches:
        figure.legend(handles=patches, loc="lower right", ncols=3, fontsize=9, labelcolor=_INK, **_BARE)


def _flag_names(flags: NDArray[np.uint32]) -> str:
    """The most frequent flags in words."""
    counts = {flag: np.count_nonzero(flags & np.uint32(flag)) for flag in Flag}
    found = sorted((flag for flag in Flag if counts[flag]), key=lambda flag: -counts[flag])
    words = [str(flag.name).lower().replace("_", " ") for flag in found]
    return ", ".join(words[:3]) + (", …" if len(words) > 3 else "")


class _Angles(NamedTuple):
    """What is drawn of an attitude: (n,) each, degrees."""

    heading: Floats
    pitch: Floats
    roll: Floats
    tilt: Floats
    steep: Mask
    """where heading and roll are hardly determined: the body's y axis points nearly up or down"""


def _angles(attitude: Attitude) -> _Angles:
    """The angles of ``euler("ZXY")``, ``heading()`` and ``tilt()`` in one go: long recordings are drawn, too."""
    w, x, y, z = np.ascontiguousarray(_in_enu(attitude).quat.T)
    up_x, up_y, up_z = 2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)
    heading = np.degrees(np.arctan2(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z)))
    level = np.hypot(up_x, up_z)
    pitch = np.degrees(np.arctan2(up_y, level))
    roll, tilt = np.degrees(np.arctan2(-up_x, up_z)), np.degrees(np.arctan2(np.hypot(up_x, up_y), up_z))
    return _Angles(heading, pitch, roll, tilt, np.abs(pitch) > _UNDETERMINED)


def _in_enu(attitude: Attitude) -> Attitude:
    return attitude if attitude.frame == "enu" else attitude.to("enu")


def _euler_sigmas(attitude: Attitude, angles: _Angles) -> tuple[Floats, Floats, Floats]:
    """Standard deviations (n,) rad of heading, pitch and roll, from those about east, north and up, uncorrelated.

    A small turn is dψ about up, dθ about the level axis to the right and dγ about y; solved for the three angles.
    """
    if not np.isfinite(attitude.sigma).any():
        return attitude.sigma[:, 0], attitude.sigma[:, 1], attitude.sigma[:, 2]
    east, north, up = attitude.sigma.T
    heading, pitch = np.radians(angles.heading), np.radians(angles.pitch)
    sine, cosine, level = np.sin(heading), np.cos(heading), np.maximum(np.cos(pitch), 0.1)
    right, ahead = np.hypot(east * cosine, north * sine), np.hypot(east * sine, north * cosine)
    return np.hypot(up, ahead * np.sin(pitch) / level), right, ahead / level


# -- lines, bands, stretches --------------------------------------------------------------------------------------


def _line(
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
        rows = _thinned(values)
        shown = values[rows]
    else:
        whole, known = values.copy(), np.isfinite(values)
        whole[known] = np.unwrap(values[known], period=360.0)
        rows = _thinned(whole)
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
        ax.plot(time[rows], shown, color=_INK, lw=1.2, ls=(0, (4, 2)), label=label, zorder=2.5)


def _doubtful_line(ax: Axes, time: Floats, angle: Floats, doubtful: Mask, low: float) -> None:
    if doubtful.any():
        _line(ax, time, np.where(doubtful, angle, np.nan), "_", _PALE, low=low)


def _thinned(values: Floats) -> NDArray[np.intp]:
    """The rows to draw of values (n,): all, or the lowest and the highest of each of POINTS / 2 stretches, in order."""
    n, stretches = len(values), POINTS // 2
    if n <= POINTS:
        return np.arange(n)
    size = -(-n // stretches)
    padded = np.full(-(-n // size) * size, np.nan)
    padded[:n] = values
    table = padded.reshape(-1, size)
    lowest = np.argmin(np.where(np.isnan(table), np.inf, table), axis=1)
    highest = np.argmax(np.where(np.isnan(table), -np.inf, table), axis=1)
    rows = np.sort(np.stack([lowest, highest], axis=1), axis=1) + size * np.arange(len(table))[:, None]
    return np.minimum(rows.ravel(), n - 1)


def _spans(time: Floats, mask: Mask) -> list[tuple[float, float]]:
    """Start and length, s, of the stretches where *mask* holds; those too close to tell apart on paper are one."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask & np.isfinite(time), [False]]).astype(np.int8)))
    if not len(edges):
        return []
    whole = float(np.nanmax(time) - np.nanmin(time))
    starts, ends = time[edges[0::2]], time[edges[1::2] - 1]
    apart = np.concatenate([[True], starts[1:] - ends[:-1] > whole / 500.0])
    starts, ends = starts[apart], ends[np.append(apart[1:], True)]
    return [(float(a), max(float(b - a), whole / 1000.0)) for a, b in zip(starts, ends, strict=True)]


# -- frame and words ----------------------------------------------------------------------------------------------


def _clock(time: Floats) -> tuple[Floats, str]:
    """The stamps as drawn, s, and the axis label: from the first stamp where they count from 1970."""
    known = time[np.isfinite(time)]
    if not len(known) or not _EPOCH[0] < known[0] < _EPOCH[1]:
        return time, "time [s]"
    began = datetime.fromtimestamp(float(known[0]), UTC)
    return time - known[0], f"time [s] since {began:%Y-%m-%d %H:%M:%S} UTC"


def _name(ax: Axes, name: str, unit: str) -> None:
    ax.set_title(name, loc="left", fontsize=10.5, fontweight="bold", color=_INK, pad=5)
    ax.set_ylabel(unit, fontsize=8.5, color=_QUIET)


def _legend(ax: Axes) -> None:
    ax.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=5, frameon=False, fontsize=9, labelcolor=_INK,
        borderaxespad=0.1, borderpad=0.2, columnspacing=1.4, handlelength=1.8,
    )  # fmt: skip


def _finish(figure: Figure, axes: Sequence[Axes], time: Floats, label: str) -> None:
    for ax in axes:
        ax.grid(True, color="#E4E4E4", linewidth=0.6)
        ax.set_axisbelow(True)
        ax.spines[["top", "right"]].set_visible(False)
        ax.spines[["left", "bottom"]].set_color("#AAAAAA")
        ax.tick_params(colors=_QUIET, labelsize=9)
    known = time[np.isfinite(time)]
    if len(known) and known.max() > known.min():
        axes[-1].set_xlim(float(known.min()), float(known.max()))
    axes[-1].set_xlabel(label, fontsize=9.5, color=_INK, loc="left")
    figure.align_ylabels(list(axes))


def _fit(ax: Axes, least: float, floor: float | None = None) -> tuple[float, float]:
    """Limits from the lines alone (a band may be as wide as it likes), at least *least* apart."""
    values = np.concatenate([np.asarray(line.get_ydata(), float) for line in ax.lines])
    values = values[np.isfinite(values)]
    low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
    low, high = (low, high) if high - low > least else ((low + high - least) / 2, (low + high + least) / 2)
    low = low if floor is None else floor
    margin = 0.08 * (high - low)
    limits = low - margin, high + margin
    ax.set_ylim(*limits)
    return limits


def _fit_degrees(ax: Axes, floor: float | None = None) -> None:
    from matplotlib.ticker import MaxNLocator, MultipleLocator

    low, high = _fit(ax, least=2.0, floor=floor)
    tick = next((tick for tick, span in ((90.0, 240.0), (45.0, 120.0), (30.0, 80.0)) if high - low > span), None)
    ax.yaxis.set_major_locator(MultipleLocator(tick) if tick else MaxNLocator(5))


def _head(figure: Figure, title: str, attitude: Attitude, errors: Errors | None) -> None:
    title = title or "Attitude"
    facts = [attitude.provenance.method] if attitude.provenance.method else []
    if errors is not None and errors.counted.any():
        rmse = errors.rmse_deg()
        facts.append(f"RMSE {rmse.total:.2f}° (heading {rmse.heading:.2f}°, inclination {rmse.inclination:.2f}°)")
    short = title if len(title) <= _LONGEST_TITLE else title[: _LONGEST_TITLE - 1] + "…"
    figure.suptitle(short, x=0.008, ha="left", fontsize=13, fontweight="bold", color=_INK)
    figure.text(0.993, 0.993, "  ·  ".join(facts), ha="right", va="top", fontsize=10.5, color=_INK)
