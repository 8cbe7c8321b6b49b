"""Whether gyroscope and accelerometer are exchanged: what is given as rates has the length of gravity, and turns like it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from poise.doctor import rates
from poise.doctor.findings import Finding
from poise.doctor.rates import Lengths, Rates
from poise.doctor.turning import NO_TURNS, Blocks
from poise.formats.units import FACTORS, SI

Floats = NDArray[np.float64]

_CALM = 0.5  # of the median, the shortest tenth: no specific force, which has gravity in it even when it is calm
_NEAR = 1.5  # times gravity's length in some unit, the rates' median

ADVICE = (
    "name the columns the other way round, in the header or with --columns (such as "
    "time,acc_x[g],acc_y,acc_z,gyr_x[deg/s],gyr_y,gyr_z)"
)


def exchanged(found: Blocks, as_is: Rates, mag_length: float, read_as: Mapping[str, str]) -> Finding | None:
    """What to say where the samples of gyr and acc are each other's, beyond doubt; None where they are not.

    Seen from what is given as acc, taken for rates in rad/s or deg/s, what is given as gyr must turn as gravity does.
    """
    if rates.explain(as_is):
        return None
    length = np.sqrt(np.einsum("ij,ij->i", found.acc, found.acc))
    known = length[np.isfinite(length)]
    other = np.sqrt(np.einsum("ij,ij->i", found.gyr, found.gyr))
    if not len(known) or not np.isfinite(other).any() or np.quantile(known, 0.1) > _CALM * np.median(known):
        return None
    gravity = float(np.nanmedian(other))
    number = gravity / FACTORS["gyr"][read_as.get("gyr", SI["gyr"])]  # as in the file
    usual = {unit: FACTORS["acc"]["g"] / factor for unit, factor in FACTORS["acc"].items()}
    units = [unit for unit, size in usual.items() if 1 / _NEAR < number / size < _NEAR]
    if not units:
        return None
    lengths = Lengths(gravity, mag_length)
    swapped = found._replace(gyr=found.acc, acc=found.gyr)
    taken = FACTORS["acc"][read_as.get("acc", SI["acc"])]
    for unit in ("rad/s", "deg/s"):
        tried = rates.with_factor(swapped, FACTORS["gyr"][unit] / taken, lengths)
        if rates.explain(tried) and (not len(tried.mag.loss) or rates.explain(tried._replace(acc=NO_TURNS))):
            text = (
                f"what is given as gyr is as long as gravity is in {units[0]} ({number:.4g} in the median), and turns as what "
                f"is given as acc says, taken for {unit}: a loss of {rates.misfit(tried):.3g}, as they are named "
                f"{rates.misfit(as_is):.3g}. Gyroscope and accelerometer are exchanged: {ADVICE}"
            )
            return Finding("gyr and acc", "sure", text, decided=False)
    return None
