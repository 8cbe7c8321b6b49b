"""What a fault did to an attitude: figures against the clean run of the same method and against the reference."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fault_bench.injectors import LAST, Injected
from poise import Attitude, Flag, Recording

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
Figures = dict[str, float]

LIMIT_DEG, SIGMAS = 10.0, 5.0  # valid with a larger error than both is silently wrong
WATCHED = 10.0  # s after a fault in which the deviation still counts as the fault's
HELD = 1.0  # s that an attitude has to stay back to be called back
SUSTAINED = 0.9  # of the rows left of a fault that have to be flagged for "flagged from here on"

# What a row may carry without being suspicious, in any recording: a remark, not an alarm.
REMARKS = frozenset(
    (
        "REST",
        "ACC_DOUBTED",
        "CORRECTION_FORCED",
        "HEADING_ARBITRARY",
        "HEADING_UNPROVEN",
        "START_IN_MOTION",
        "MAG_DISTURBED",
        "INITIALISING",
    )
)
SENSORS = ("gyr", "acc", "mag")


@dataclass(frozen=True)
class Clean:
    """A contender's run on the recording as it is."""

    recording: Recording
    attitude: Attitude
    has_heading: bool
    error: Floats
    """(n,) deg, the error that the contender answers for; NaN where there is no reference"""
    inclination: Floats
    """(n,) deg"""


def clean_run(recording: Recording, attitude: Attitude, has_heading: bool) -> Clean:
    """The clean run with its errors against the reference."""
    assert recording.truth is not None
    total, _, inclination = angles(attitude.quat, recording.truth.quat)
    return Clean(recording, attitude, has_heading, total if has_heading else inclination, inclination)


def judge(clean: Clean, injected: Injected, attitude: Attitude, back: float, sensor: str = "") -> Figures:
    """All figures of one faulty run; NaN for what does not apply.

    *back* (deg) is how near to the clean run, or to the reference, an attitude has to be to count as back; *sensor* names
    the one whose flags count beside those about time and attitude.
    """
    assert clean.recording.truth is not None
    origin = injected.origin
    clock = clean.recording.time[origin]
    before, truth = clean.attitude, clean.recording.truth.quat
    if len(origin) != len(before) or (origin[1:] != origin[:-1] + 1).any():
        before, truth = before[origin], truth[origin]
    total, _, inclination = angles(attitude.quat, truth)
    off, off_heading, off_inclination = angles(attitude.quat, before.quat)
    error, off = (total, off) if clean.has_heading else (inclination, off_inclination)
    off = np.where(np.isfinite(off), off, np.where(np.isfinite(before.quat[:, 0]), 180.0, 0.0))
    valid, flagged = attitude.valid, _newly_flagged(attitude, before, sensor)
    late = clock - clean.recording.time[0] >= clean.recording.duration - LAST
    inside = (clock >= injected.start) & (clock <= injected.end)
    figures = {
        "ratio": _ratio(clean, clean.error, origin, error, late),
        "inclination ratio": _ratio(clean, clean.inclination, origin, inclination, late),
        "deviation": _worst(off[(clock >= injected.start) & (clock <= injected.end + WATCHED)]),
        "recovery": _recovery(clock, injected.end, (np.fmin(off, np.nan_to_num(error, nan=180.0)) <= back) & valid),
        "latency": _latency(clock, injected, inside, flagged),
        "flagged": _share(flagged[injected.wrong]),
        "flagged later": _share(_flagged(attitude, sensor)[inside & (clock >= injected.start + 2.0)]),
        "valid": float(valid.mean()),
        "silent": float(silent(attitude, error, inclination, clean.has_heading).mean()),
        "bad rows": float(bad_rows(attitude)),
        "bias": _bias_change(attitude, clock, injected),
    }
    if sensor == "mag" and not clean.has_heading:  # a sensor that the method does not use
        figures |= {"latency": np.nan, "flagged": np.nan, "flagged later": np.nan}
    figures |= _heading(clean, attitude, off_heading, clock, injected, inside, sensor)
    figures |= _saturation(clean, attitude, origin, error, clock, injected)
    figures["lost for ever"] = float(not np.isfinite(attitude.quat[-1]).all())
    return figures


def clean_figures(clean: Clean) -> Figures:
    """What a clean run has to say: false alarms, honesty, coverage."""
    attitude = clean.attitude
    size = _sigma_deg(attitude, clean.has_heading)
    known = np.isfinite(clean.error) & np.isfinite(size)
    return {
        "false alarms": float((alarmed(attitude) & ~_mended(attitude, clean.error)).mean()),
        "silent": float(silent(attitude, clean.error, clean.inclination, clean.has_heading).mean()),
        "within 3 sigma": float((clean.error[known] <= 3.0 * size[known]).mean()) if known.any() else np.nan,
        "bad rows": float(bad_rows(attitude)),
        "valid": float(attitude.valid.mean()),
    }


def bad_rows(attitude: Attitude) -> int:
    """Rows that are not finite although called valid, or although an attitude was known before; and no unit quaternion."""
    w, x, y, z = attitude.quat.T
    length = w * w + x * x + y * y + z * z
    finite = np.isfinite(length)
    known = np.maximum.accumulate(finite)
    wrong = (~finite & (attitude.valid | known)) | (np.abs(length - 1.0) > 1e-6)
    if np.isinf(attitude.table).any():
        wrong |= np.isinf(attitude.table).any(axis=1)
    return int(wrong.sum())


def silent(attitude: Attitude, error: Floats, inclination: Floats, has_heading: bool) -> Mask:
    """Rows that are valid with an error above 10° and 5 sigma, of rows with a reference; others are False.

    Where a row says that its heading is arbitrary, its inclination counts.
    """
    level = (attitude.flags & np.uint32(Flag.HEADING_ARBITRARY)) != 0 if has_heading else np.True_
    judged = np.where(level, inclination, error)
    x, y, z = np.degrees(attitude.sigma.T)
    size = np.nan_to_num(np.sqrt(x * x + y * y + np.where(level, 0.0, z * z)), nan=0.0, posinf=180.0)
    with np.errstate(invalid="ignore"):
        return np.asarray(attitude.valid & (judged > np.maximum(LIMIT_DEG, SIGMAS * size)))


def alarmed(attitude: Attitude, without: str = "") -> Mask:
    """Rows that carry anything but remarks, or but flags with the word *without*."""
    flags = (flag for flag in Flag if flag.name not in REMARKS and without not in str(flag.name).split("_"))
    bits = sum(map(int, flags))
    return np.asarray((attitude.flags & np.uint32(bits)) != 0)


def _mended(attitude: Attitude, error: Floats) -> Mask:
    """Rows with a reset where the attitude before was wrong: an alarm, but no false one."""
    reset = (attitude.flags & np.uint32(Flag.RESET)) != 0
    return np.asarray(reset & (np.concatenate([error[:1], error[:-1]]) > LIMIT_DEG))


def angles(quat: Floats, reference: Floats) -> tuple[Floats, Floats, Floats]:
    """The total, heading and inclination error of quaternions (n, 4), degrees, row by row.

    What :func:`poise.evaluate` gives, in a fifth of its time: it is asked a thousand times here.
    """
    w1, x1, y1, z1 = np.ascontiguousarray(quat.T)
    w2, x2, y2, z2 = np.ascontiguousarray(reference.T)
    w = w1 * w2 + x1 * x2 + y1 * y2 + z1 * z2
    x = x1 * w2 - w1 * x2 - y1 * z2 + z1 * y2
    y = y1 * w2 - w1 * y2 - z1 * x2 + x1 * z2
    z = z1 * w2 - w1 * z2 - x1 * y2 + y1 * x2
    level, upright = np.sqrt(x * x + y * y), np.sqrt(w * w + z * z)
    total = 2.0 * np.arctan2(np.sqrt(x * x + y * y + z * z), np.abs(w))
    heading = 2.0 * np.arctan2(np.abs(z), np.abs(w))
    return np.degrees(total), np.degrees(heading), np.degrees(2.0 * np.arctan2(level, upright))


def _ratio(clean: Clean, own: Floats, origin: NDArray[np.intp], error: Floats, late: Mask) -> float:
    """RMSE over the rows of the last stretch that count, against the clean run's there."""
    assert clean.recording.moving is not None
    counted = late & clean.recording.moving[origin] & np.isfinite(own[origin])
    if not np.isfinite(error[counted]).all():
        return np.inf
    return float(np.sqrt(np.mean(error[counted] ** 2) / np.mean(own[origin][counted] ** 2)))


def _share(mask: Mask) -> float:
    return float(mask.mean()) if len(mask) else np.nan


def _worst(values: Floats) -> float:
    return float(values.max()) if len(values) else np.nan


def _recovery(clock: Floats, end: float, good: Mask) -> float:
    """s from the end of a fault until an attitude is good, and stays so for a while."""
    after = clock > end
    if not after.any():
        return np.nan
    time, good = clock[after], good[after]
    bad = np.flatnonzero(~good)
    # the next bad row after each row says how long it stays good
    following = np.searchsorted(bad, np.arange(len(time)))
    until = np.append(time[bad], np.inf)[following]
    held = np.flatnonzero(good & (until - time >= min(HELD, time[-1] - time[0])))
    return float(time[held[0]] - end) if len(held) else np.inf


def _latency(clock: Floats, injected: Injected, inside: Mask, flagged: Mask) -> float:
    """s from a fault's start to the row from which it is flagged: a fault of one row once, a longer one throughout."""
    if injected.end - injected.start < 0.1:
        rows = np.flatnonzero((clock >= injected.start) & flagged)
        return float(clock[rows[0]] - injected.start) if len(rows) else np.inf
    rows = np.flatnonzero(inside)
    if not len(rows):
        return np.nan
    said = flagged[rows]
    remaining = np.cumsum(said[::-1])[::-1] / np.arange(len(said), 0, -1)
    first = np.flatnonzero(said & (remaining >= SUSTAINED))
    return float(clock[rows[first[0]]] - injected.start) if len(first) else np.inf


def _bits(sensor: str) -> np.uint32:
    """The flags that may announce a fault of *sensor*: those that name it, and those that name no sensor."""
    others = [name for name in SENSORS if name != sensor]
    bits = 0
    for flag in Flag:
        words = str(flag.name).lower().split("_")
        of_mag = flag in (Flag.HEADING_ARBITRARY, Flag.HARD_IRON)
        own = sensor in words or (sensor == "mag" and of_mag)
        if own or not (flag.name in REMARKS or of_mag or any(other in words for other in others)):
            bits |= int(flag)
    return np.uint32(bits)


def _flagged(attitude: Attitude, sensor: str) -> Mask:
    return np.asarray((attitude.flags & _bits(sensor)) != 0) | ~attitude.valid


def _newly_flagged(attitude: Attitude, before: Attitude, sensor: str) -> Mask:
    """Rows that carry a flag which the clean run has not there."""
    bits = _bits(sensor)
    return np.asarray((attitude.flags & bits & ~before.flags) != 0) | (~attitude.valid & before.valid)


def _bias_change(attitude: Attitude, clock: Floats, injected: Injected) -> float:
    """deg/s between the bias before a fault and that of the first valid row after it."""
    earlier, later = np.flatnonzero(clock < injected.start), np.flatnonzero((clock > injected.end) & attitude.valid)
    if not len(earlier) or not len(later):
        return np.nan
    return float(np.degrees(np.linalg.norm(attitude.bias[later[0]] - attitude.bias[earlier[-1]])))


def _heading(
    clean: Clean, attitude: Attitude, off: Floats, clock: Floats, injected: Injected, inside: Mask, sensor: str
) -> Figures:
    """How far a heading goes, whether its sigma covers that, and how often it is wrong without a word."""
    if not clean.has_heading:
        return {"heading": np.nan, "covered": np.nan, "silent heading": np.nan}
    sigma = np.degrees(attitude.sigma[:, 2])
    judged = inside & np.isfinite(off)
    unsaid = attitude.valid & ~_flagged(attitude, sensor) & (clock >= injected.start + 2.0)
    return {
        "heading": _worst(off[judged]),
        "covered": _share((off <= 3.0 * sigma)[judged & np.isfinite(sigma)]),
        "silent heading": _share((unsaid & (off > LIMIT_DEG))[inside]),
    }


def _saturation(
    clean: Clean, attitude: Attitude, origin: NDArray[np.intp], error: Floats, clock: Floats, injected: Injected
) -> Figures:
    """What clipped stretches do to sigma and validity, and valid rows that are wrong where the clean run is not."""
    wrong = injected.wrong
    ends = np.flatnonzero(wrong & ~np.append(wrong[1:], False))
    own, now = _sigma_deg(clean.attitude, clean.has_heading)[origin], _sigma_deg(attitude, clean.has_heading)
    before = clean.error[origin]
    with np.errstate(invalid="ignore", divide="ignore"):
        misled = attitude.valid & (error > LIMIT_DEG) & ~(before > LIMIT_DEG - 1.0)
    since = clock - np.maximum.accumulate(np.where(wrong, clock, -np.inf))
    unsure = ~attitude.valid & np.isfinite(since)
    return {
        "sigma growth": float(np.median(now[ends] / own[ends]))
        if len(ends) and np.isfinite(own[ends]).all()
        else np.nan,
        "misled": float(misled.mean()),
        "valid again": float(since[unsure].max(initial=0.0)),
    }


def _sigma_deg(attitude: Attitude, has_heading: bool) -> Floats:
    x, y, z = np.degrees(attitude.sigma.T)
    return np.asarray(np.sqrt(x * x + y * y + (z * z if has_heading else 0.0)))
