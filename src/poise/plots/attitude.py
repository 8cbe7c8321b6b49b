"""An attitude over time: heading, pitch and roll, tilt, and its error or the gyroscope's bias."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude
from poise.data.flags import HEADING_ARBITRARY, HEADING_UNPROVEN, INVALID, REST, Flag, valid
from poise.data.recording import Recording
from poise.errors import RecordingError
from poise.estimators import judged_by
from poise.evaluation import Errors, evaluate
from poise.plots.lines import fit, fit_degrees, line, spans
from poise.plots.style import (
    BARE,
    BLUE,
    GREEN,
    INK,
    NARROW,
    ORANGE,
    PALE,
    PAPER,
    PURPLE,
    QUIET,
    Floats,
    Mask,
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

SHADES = _REST_SHADE, _INVALID_SHADE, _FLAG_SHADE, _UNPROVEN_SHADE = (
    ("#8C8C70", 0.2),  # none of the lines' colours, whose bands lie on it
    ("#CC1F1F", 0.35),
    ("#E69F00", 0.9),
    ("#8A6BBE", 0.6),
)  # colour, opacity
_STRIP = 0.045  # of a panel's height, at its foot: flags are many, and shades behind the lines would drown them
_UNDETERMINED = 80.0  # degrees of pitch past which heading and roll are hardly determined


def attitude_figure(
    attitude: Attitude,
    recording: Recording | None = None,
    errors: Errors | None = None,
    title: str = "",
    *,
    narrow: bool = False,
) -> Figure:
    """Heading, pitch and roll, tilt, and the error over time; without a reference, the gyroscope's bias.

    The reference of *recording*, on the rows of *attitude*, is dashed. Light bands are ±3 standard deviations where the
    method knows them; shaded stretches are at rest, flagged or not valid. _Angles are those of a body with x right and
    y forward. Raises :class:`RecordingError` for an attitude relative to another body and for a recording whose rows
    are not the attitude's.
    """
    figure = figure_class()(figsize=(NARROW, 9.4) if narrow else (11.0, 8.6), layout="constrained", facecolor=PAPER)
    axes: Sequence[Axes] = figure.subplots(4, 1, sharex=True, height_ratios=(1.0, 1.0, 0.8, 0.8))
    errors = draw_attitude(figure, axes, attitude, recording, errors)
    facts = [attitude.provenance.method] if attitude.provenance.method else []
    facts += error_facts(attitude, errors, parts=True)
    head(figure, title or (recording.name if recording is not None else "") or "Attitude", facts)
    return figure


def error_facts(attitude: Attitude, errors: Errors | None, *, parts: bool = False) -> list[str]:
    """The figure that the method answers for, with its *parts*; of a method without a heading that is its inclination."""
    if errors is None or not errors.counted.any():
        return []
    rmse = errors.rmse_deg()
    if judged_by(attitude.provenance.method) == "inclination":
        return [f"RMSE of the inclination {rmse.inclination:.2f}°"]
    told = f" (heading {rmse.heading:.2f}°, inclination {rmse.inclination:.2f}°)" if parts else ""
    return [f"RMSE {rmse.total:.2f}°{told}"]


def draw_attitude(
    figure: Figure, axes: Sequence[Axes], attitude: Attitude, recording: Recording | None, errors: Errors | None
) -> Errors | None:
    """Draw into four panels, the last of which gets the time axis; the errors that were drawn."""
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
    time, label = clock(attitude.time)
    _draw_heading(axes[0], time, attitude, angles, reference)
    _draw_pitch_and_roll(axes[1], time, attitude, angles, reference)
    _draw_tilt(axes[2], time, attitude, angles, reference)
    if errors is not None:
        _draw_errors(axes[3], time, attitude, errors)
    else:
        _draw_bias(axes[3], time, attitude)
    finish(figure, axes, time, label)
    _draw_flags(figure, axes, time, attitude.flags)
    return errors


def _draw_heading(ax: Axes, time: Floats, attitude: Attitude, angles: _Angles, reference: _Angles | None) -> None:
    from matplotlib.ticker import FuncFormatter

    north = attitude.heading_reference
    zero = "an arbitrary zero" if north == "arbitrary" else f"{north} north"
    name_panel(ax, f"Heading ({north})", f"from {zero} [°]")
    heading, steep = angles.heading, angles.steep
    known = np.radians(heading[np.isfinite(heading)])
    centre = np.degrees(np.arctan2(np.sin(known).sum(), np.cos(known).sum()))
    low = float(np.round(centre / 45.0)) * 45.0 - 180.0  # the seam lies opposite to where the heading mostly is
    if reference is not None:
        line(ax, time, np.where(steep, np.nan, reference.heading), "reference", low=low)
    _doubtful_line(ax, time, heading, steep, low)
    plain = np.where(steep, np.nan, heading)
    line(ax, time, plain, "heading", BLUE, 3.0 * np.degrees(_euler_sigmas(attitude, angles)[0]), low)
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value % 360:g}"))
    fit_degrees(ax)
    legend(ax)


def _draw_pitch_and_roll(
    ax: Axes, time: Floats, attitude: Attitude, angles: _Angles, reference: _Angles | None
) -> None:
    name_panel(ax, "Pitch and roll", "about body x and y [°]")
    _, pitch, roll, _, steep = angles
    if reference is not None:
        line(ax, time, reference.pitch, "reference")
        line(ax, time, np.where(steep, np.nan, reference.roll), "_", low=-180.0)
    _, of_pitch, of_roll = _euler_sigmas(attitude, angles)
    _doubtful_line(ax, time, roll, steep, -180.0)
    plain = np.where(steep, np.nan, roll)
    line(ax, time, plain, "roll", ORANGE, 3.0 * np.degrees(of_roll), -180.0)
    line(ax, time, pitch, "pitch", BLUE, 3.0 * np.degrees(of_pitch))
    if steep.any():
        ax.plot([], [], color=PALE, label=f"|pitch| > {_UNDETERMINED:.0f}°: heading, roll not determined")
    fit_degrees(ax)
    legend(ax)


def _draw_tilt(ax: Axes, time: Floats, attitude: Attitude, angles: _Angles, reference: _Angles | None) -> None:
    name_panel(ax, "Tilt", "body z from up [°]")
    if reference is not None:
        line(ax, time, reference.tilt, "reference")
    sigma = np.hypot(*attitude.sigma[:, :2].T) / np.sqrt(2.0)
    line(ax, time, angles.tilt, "tilt", GREEN, 3.0 * np.degrees(sigma))
    fit_degrees(ax, floor=0.0)
    legend(ax)


def _draw_errors(ax: Axes, time: Floats, attitude: Attitude, errors: Errors) -> None:
    name_panel(ax, "Error", "against the reference [°]")
    headed = judged_by(attitude.provenance.method) == "total"
    for name, colour in (("inclination", GREEN), *((("heading", PURPLE), ("total", INK)) if headed else ())):
        line(ax, time, np.degrees(getattr(errors, name)), name, colour)
    fit_degrees(ax, floor=0.0)
    sigma = attitude.sigma if headed else attitude.sigma[:, :2]
    claimed = 3.0 * np.degrees(np.linalg.norm(sigma, axis=1))
    if np.isfinite(claimed).any():
        usual, what = float(np.nanmedian(claimed)), "total" if headed else "inclination"
        above = (
            f" (about {usual:.0f}°, above the axis)" if usual > ax.get_ylim()[1] and not is_narrow(ax.figure) else ""
        )
        line(ax, time, claimed, f"3σ of the {what}{above}", QUIET, style=":")
    legend(ax)


def _draw_bias(ax: Axes, time: Floats, attitude: Attitude) -> None:
    name_panel(ax, "Gyroscope bias", "[°/s]")
    for i, (axis, colour) in enumerate(zip("xyz", (BLUE, ORANGE, GREEN), strict=True)):
        bias, sigma = np.degrees(attitude.bias[:, i]), np.degrees(attitude.bias_sigma[:, i])
        line(ax, time, bias, axis, colour, 3.0 * sigma)
    fit(ax, least=0.2)
    legend(ax)


def _draw_flags(figure: Figure, axes: Sequence[Axes], time: Floats, flags: NDArray[np.uint32]) -> None:
    """Shade rest and what is not valid, mark other flags at the foot of each panel; one legend names them."""
    from matplotlib.patches import Patch

    invalid = ~valid(flags)
    # That a heading is arbitrary stands on its axis; as a flag it only matters where it changes.
    told = REST | INVALID | HEADING_UNPROVEN
    told |= HEADING_ARBITRARY if (flags & np.uint32(HEADING_ARBITRARY)).all() else 0
    others = flags & np.uint32(0xFFFFFFFF ^ told)
    unproven = (
        flags & np.uint32(HEADING_UNPROVEN)
    ) != 0  # of long stretches, and only about the heading: its own strip
    kinds: tuple[tuple[str, NDArray[np.bool_], tuple[str, float], tuple[float, float], Sequence[Axes]], ...] = (
        ("at rest", ((flags & np.uint32(REST)) != 0) & ~invalid, _REST_SHADE, (0, 1.0), axes),
        ("not valid", invalid, _INVALID_SHADE, (0, 1.0), axes),
        (f"flagged: {_flag_names(others)}", others != 0, _FLAG_SHADE, (0, _STRIP), axes),
        ("heading unproven", unproven, _UNPROVEN_SHADE, (1.0 - _STRIP, _STRIP), axes[:1]),
    )
    patches = []
    for name, mask, (colour, opacity), height, panels in kinds:
        if found := spans(time, mask):
            patches.append(Patch(color=colour, alpha=opacity, lw=0, label=name))
            for ax in panels:
                across = ax.get_xaxis_transform()
                ax.broken_barh(found, height, transform=across, color=colour, alpha=opacity, lw=0, zorder=0.5)
    if patches:
        figure.legend(
            handles=patches, loc="lower right", ncols=1 if is_narrow(figure) else 4, fontsize=9, labelcolor=INK, **BARE
        )


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


def _doubtful_line(ax: Axes, time: Floats, angle: Floats, doubtful: Mask, low: float) -> None:
    if doubtful.any():
        line(ax, time, np.where(doubtful, angle, np.nan), "_", PALE, low=low)
