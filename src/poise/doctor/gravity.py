"""Gravity in the accelerometer's samples: what speaks against it where their length looks right.

The mean of a specific force over some seconds is gravity, but for what the velocity changes meanwhile: over 5 s less than
1 or 2 m/s². So is the mean of its length, which cannot be less. Acceleration without gravity can be of any length in motion,
and is none when the motion pauses.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from poise.doctor.axes import judge
from poise.doctor.findings import Finding
from poise.doctor.rates import Rates, explain
from poise.doctor.turning import NO_TURNS, Blocks
from poise.doctor.units import WANTED

Floats = NDArray[np.float64]

_CALM = 5.0  # s
_FEWEST = 10  # blocks of a stretch
_KNOWN = 0.9  # of the blocks of a stretch hold a sample
_HALF = 0.5  # of gravity
_FAR = 0.15  # of the usual length: no unit and no motion make that of what has gravity in it
_STEADY = 0.55  # of the mean, the shortest tenth: gravity at rest, in whatever unit
_STANDS = 0.9  # of gravity: so much of it that stands still in the room is gravity, and a calm without it a fault
_SCATTER = 0.15  # of its squared length: more than is left of gravity in its right axes, whatever the motion
_LITTLE = 0.35  # of gravity
_WINDOWS = 4  # to judge by the field


def removed(
    found: Blocks, as_is: Rates, gravity: float, *, known: bool, clocks: Sequence[float] = ()
) -> Finding | None:
    """Whether gravity was removed; *gravity* is its length in the sensor's own unit, where that unit is *known*.

    *clocks* are factors that the stamps may lack: a calm must be long enough by each of them.
    """
    by_axes = np.median(as_is.acc.long, axis=0) if len(as_is.acc.long) else np.zeros(48)
    scatter = float(np.median(as_is.acc.loss, axis=0).min()) if len(as_is.acc.loss) else np.inf
    if by_axes.max() > _STANDS and scatter < _SCATTER:
        return None
    why = _by_calm(found, gravity, known, _CALM / min(1.0, *clocks, 1.0))
    if not why and known and scatter > _SCATTER and by_axes[0] < _LITTLE:
        why = _by_field(as_is, float(by_axes[0]))
    return Finding("acc gravity", "sure", f"{why}: gravity was removed. {WANTED}", decided=False) if why else None


def _by_calm(found: Blocks, gravity: float, known: bool, calm: float) -> str:
    """Why the calmest stretch of *calm* s has no gravity; empty where it has, or there is none."""
    length = np.sqrt(np.einsum("ij,ij->i", found.acc, found.acc))
    count = round(calm / found.width)
    there = np.isfinite(length)
    if not _FEWEST <= count <= len(length) or not there.any():
        return ""
    filled = np.where(there, length, 0.0)
    enough = _sums(there.astype(float), count)
    means = np.where(enough >= _KNOWN * count, _sums(filled, count) / np.maximum(enough, 1.0), np.inf)
    at = int(np.argmin(means))
    mean, stretch = float(means[at]), length[at : at + count]
    stretch = stretch[np.isfinite(stretch)]
    if not np.isfinite(mean) or np.ptp(stretch) == 0.0:  # a sensor that hangs
        return ""
    usual = float(np.median(length[there]))
    steady = float(np.quantile(stretch, 0.1)) > _STEADY * mean
    if mean >= _FAR * usual and not (known and not steady and mean < _HALF * gravity):
        return ""
    unit, wanted = (" m/s²", f"{gravity:.4g}") if known else ("", f"nearly the usual {usual:.3g}")
    return (
        f"the mean length of the force over {calm:g} s, {at * found.width:.1f} s after the start, is {mean:.3g}{unit}; "
        f"gravity alone would be {wanted}"
    )


def _by_field(as_is: Rates, stands: float) -> str:
    """Why what stands still of the specific force is not gravity, by the field that does; empty where the field says nothing.

    In other axes an acceleration to and fro may stand still too, but not steadily: the scatter was looked at before.
    """
    if (
        len(as_is.acc.long) < _WINDOWS
        or not judge(NO_TURNS, as_is.mag).agreed
        or not explain(as_is._replace(acc=NO_TURNS))
    ):
        return ""
    return (
        "the gyroscope explains how the magnetic field turns, and by it the mean of the specific force over 2 s is "
        f"{stands:.2g} of gravity, and steady in no axes"
    )


def _sums(values: Floats, count: int) -> Floats:
    """The sums over *count* values from each on."""
    total = np.concatenate([[0.0], np.cumsum(values)])
    return np.asarray(total[count:] - total[:-count])
