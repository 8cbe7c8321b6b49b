"""Samples: clipped, stuck, repeated or missing ones, and what the sensors say at rest."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from poise.data.recording import Recording
from poise.doctor.findings import Finding, Severity

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

_SENSORS = ("gyr", "acc", "mag")
_FEWEST = 3  # samples in a row at the very same largest value: a clipped peak
_NEIGHBOURS = 20  # values next to the largest
_STUCK = 0.5  # s of one and the same sample
_REST = 1.0  # s: windows in which rest is looked for
_REST_GYR, _REST_ACC = 0.02, 0.15  # rad/s, m/s²: the standard deviation of what rests in a hand's reach
_REST_TURN = 0.06  # rad/s: the mean of what rests
_OFF, _ABSURD = 0.025, 0.5  # of gravity: more than an inexpensive accelerometer is off; what is no scale error any more
_APART = 40.0  # degrees between attitudes that tell a scale from an offset
_HELD = 0.5  # of the samples repeat: a slower sensor whose last value the logger held


def constant(values: Floats) -> bool:
    """Whether a sensor (n, 3) gives one and the same sample from beginning to end."""
    given = values[np.isfinite(values).all(axis=1)]
    return len(given) >= 3 and bool((given == given[0]).all())


def silence(dead: Sequence[str]) -> str:
    """What *dead* sensors do, in words; empty without any."""
    names = " and ".join(filter(None, (", ".join(dead[:-1]), *dead[-1:])))
    return (
        f"{names} {'give' if len(dead) > 1 else 'gives'} one and the same sample from beginning to end" if dead else ""
    )


def findings(recording: Recording) -> list[Finding]:
    """What there is to say of the samples themselves."""
    if len(recording) < 3 or not recording.rate_hz > 0:
        return []
    found: list[Finding] = []
    for sensor in _SENSORS:
        values = getattr(recording, sensor)
        known = np.isfinite(values).all(axis=1)
        if known.sum() < 3:
            continue
        found += _missing(recording, sensor, known)
        found += _stuck(recording, sensor, values[known], recording.time[known])
        found += _clipped(sensor, values[known])
    return found + _rest(recording)


def _missing(recording: Recording, sensor: str, known: Mask) -> list[Finding]:
    """Rows without a sample, of a sensor that has one in nearly every row."""
    share = float(np.mean(~known))
    if not 0.0 < share < 0.5:  # more is a slower sensor
        return []
    severity: Severity = "likely" if sensor == "gyr" and share > 0.01 else "note"
    text = f"{int(np.sum(~known))} rows ({share:.2%}) hold no sample of {sensor}"
    return [Finding(f"{sensor} missing", severity, text)]


def _stuck(recording: Recording, sensor: str, values: Floats, time: Floats) -> list[Finding]:
    """Stretches in which a sensor gives one and the same sample again and again."""
    same = np.asarray((np.diff(values, axis=0) == 0).all(axis=1))
    if not same.any():
        return []
    share = float(same.mean())
    if constant(values):
        text = f"{silence([sensor])}: a sensor that is stuck, or not one at all"
        return [Finding(f"{sensor} stuck", "likely", text)]
    edges = np.flatnonzero(np.diff(np.concatenate([[False], same, [False]]).astype(np.int8)))
    begin, end = time[edges[0::2]], time[edges[1::2]]
    with np.errstate(invalid="ignore"):
        long = end - begin >= _STUCK
    found = []
    if long.any():
        worst = int(np.argmax(np.where(long, end - begin, 0.0)))
        text = (
            f"{sensor} gives one and the same sample for {_STUCK:g} s or more in {int(long.sum())} "
            f"stretch{'es' * (int(long.sum()) > 1)}, the longest {end[worst] - begin[worst]:.2f} s from {begin[worst]:.2f} s"
        )
        found.append(Finding(f"{sensor} stuck", "likely", text))
    elif share > _HELD:
        text = f"{share:.0%} of the samples of {sensor} repeat the one before: a slower sensor whose last value is held"
        found.append(Finding(f"{sensor} repeated", "likely", text))
    elif share > 0.01:
        found.append(
            Finding(f"{sensor} repeated", "note", f"{share:.1%} of the samples of {sensor} repeat the one before")
        )
    return found


def _clipped(sensor: str, values: Floats) -> list[Finding]:
    """Peaks that are cut off at one and the same value."""
    found = []
    values = values[np.append(True, (np.diff(values, axis=0) != 0).any(axis=1))]  # a held sample is one
    if len(values) < 20:
        return []
    for axis, column in zip("xyz", values.T, strict=True):
        for end, sign in ((float(column.max()), "+"), (float(column.min()), "-")):
            at = column == end
            runs = np.diff(np.flatnonzero(np.diff(np.concatenate([[False], at, [False]]).astype(np.int8))))[0::2]
            if runs.max() >= _FEWEST and _piled_up(column, end):
                found.append((int(at.sum()), f"{sign}{axis} at {end:.4g}"))
    if not found:
        return []
    count = sum(n for n, _ in found)
    text = f"{count} samples of {sensor} are cut off: {', '.join(where for _, where in found)}; its range was too small"
    return [Finding(f"{sensor} clipped", "likely", text)]


def _piled_up(column: Floats, end: float) -> bool:
    """Whether the end of the range is met far more often than the values next to it; a slow signal may dwell, too."""
    values, counts = np.unique(column, return_counts=True)
    nearest = np.argsort(np.abs(values - end))[: _NEIGHBOURS + 1]
    beside = nearest[1:]
    most = float(counts[nearest[0]])
    return len(beside) >= 3 and most > _FEWEST and most >= 4.0 * float(np.median(counts[beside]))


def _rest(recording: Recording) -> list[Finding]:
    """Noise and bias at rest, and whether the recording begins with it."""
    rows = max(8, round(_REST * recording.rate_hz))
    count = len(recording) // rows
    if not count:
        return []
    known: Mask = np.asarray(np.isfinite(recording.acc).all(axis=1))
    why = silence([name for name in ("gyr", "acc") if constant(getattr(recording, name))])
    if not known.any() or not np.isfinite(recording.gyr).all(axis=1).any():
        why = "a sensor gives no sample"
    if why:
        text = f"{why}: whether it rests, and how noisy the sensors then are, cannot be told"
        return [Finding("rest", "cannot-tell", text, decided=False)]
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        gyr = recording.gyr[: count * rows].reshape(count, rows, 3)
        acc = np.where(known[:, None], recording.acc, np.nan)[: count * rows].reshape(count, rows, 3)
        drift, noise = gyr.mean(axis=1), gyr.std(axis=1)
        present: Mask = np.asarray(np.isfinite(acc).all(axis=2))
        n = present.sum(axis=1)[:, None]
        filled = np.where(present[:, :, None], acc, 0.0)
        level = filled.sum(axis=1) / n
        shake = np.sqrt(np.maximum((filled**2).sum(axis=1) / n - level**2, 0.0))
    rest = (noise.max(axis=1) < _REST_GYR) & (np.linalg.norm(drift, axis=1) < _REST_TURN)
    rest &= (shake.max(axis=1) < _REST_ACC) & (n[:, 0] > 3)
    if not rest.any():
        text = "it never rests for 1 s, so bias and noise of the sensors at rest are not known"
        return [Finding("rest", "note", f"{text}; methods that wait for rest start in motion")]
    where = "it begins at rest" if rest[0] else "it does not begin at rest"
    bias, spread = np.degrees(np.median(drift[rest], axis=0)), np.degrees(np.median(noise[rest], axis=0))
    moved = np.degrees(np.ptp(drift[rest], axis=0)).max()
    force = float(np.median(np.linalg.norm(level[rest], axis=1)))
    texts = [
        f"{where}; {int(rest.sum())} of {count} s rest",
        f"gyroscope bias {_three(bias)} °/s (it moves by up to {moved:.2g}), noise {_three(spread)} °/s",
        f"|f| {force:.3f} m/s² ({force / recording.gravity - 1.0:+.1%} of gravity), "
        f"noise {_three(np.median(shake[rest], axis=0))}",
    ]
    return [Finding("rest", "note", "; ".join(texts)), *_length_at_rest(level[rest], recording.gravity)]


def _length_at_rest(level: Floats, gravity: float) -> list[Finding]:
    """Whether the specific force (m, 3) in windows at rest has another length than gravity, and what mends that."""
    length = np.linalg.norm(level, axis=1)
    usual = float(np.median(length))
    off = usual / gravity - 1.0
    if not _OFF <= abs(off) < _ABSURD:
        return []
    toward = level / length[:, None]
    apart = float(np.degrees(np.arccos(np.clip(np.min(toward @ toward[0]), -1.0, 1.0))))
    spread = float(np.ptp(length))
    text = (
        f"at rest the specific force is {usual:.3f} m/s² long, {abs(off):.1%} {'more' if off > 0 else 'less'} than gravity "
        f"({gravity:.3f})"
    )
    option = f"self-calibrating learns that; two-stage, adaptive-gain and gated take --set gravity={usual:.4g}"
    if apart < _APART:
        text += f"; it rests one way up only, so its scale is off, or its offset: if the scale, {option}"
    elif spread < abs(off) * gravity / 2:
        text += f", and so it is in attitudes up to {apart:.0f}° apart: its scale is off; {option}"
    else:
        text += (
            f", and {spread:.2f} m/s² longer one way up than another: offsets, or scales of single axes; calibrate it"
        )
    return [Finding("acc scale", "likely", text)]


def _three(values: Floats) -> str:
    return " ".join(f"{v:.2g}" for v in values)
