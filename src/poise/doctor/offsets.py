"""Offsets: how late a sensor is against the gyroscope, and the magnetometer's hard iron, from how both turn."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.corrections import Corrections
from poise.data.recording import Recording
from poise.doctor import turning
from poise.doctor.findings import Finding
from poise.math import arrays

Floats = NDArray[np.float64]

_LAG = 10  # blocks from one direction to the other: 0.5 s
_FOLDS = 20  # parts of the recording that are left out in turn: neighbouring windows are not independent
_ROUNDS = 4  # of fits in which what lies far off counts less
_CERTAIN = 4.0  # sigma
_WORTH = {"acc": 0.02, "mag": 0.004}  # s: an acceleration that goes with the turn that makes it looks like a delay
_VAGUE = 0.004  # s, of sigma
_LARGEST = 0.25  # s: what is beyond is no delay but another fault
_UNEXPLAINED = {"acc": 0.05, "mag": 0.2}  # of the power
_KNOWN = 0.03  # of the field, the sigma of a hard iron that is well determined
_EXPECTED, _LARGE = 0.03, 0.05  # of the field: more than in a calibrated magnetometer; and degrees of heading


class Fit(NamedTuple):
    """A sensor against the gyroscope."""

    delay: float
    """s that it is late"""
    delay_sigma: float
    offset: Floats
    """(3,) in the sensor's unit: its bias, or hard iron"""
    offset_sigma: Floats
    left: float
    """of the turning that is seen, the share of its power that the fit leaves: accelerations, mostly"""
    pairs: int


def findings(recording: Recording) -> list[Finding]:
    """Delays worth a correction, and hard iron, of a recording whose units and axes are right."""
    found: list[Finding] = []
    blocks = turning.blocks(recording)
    along = turning.path(blocks)
    for sensor, name in (("acc", "accelerometer"), ("mag", "magnetometer")):
        vector = getattr(blocks, sensor)
        length = np.sqrt(np.einsum("ij,ij->i", vector, vector))
        if not np.isfinite(length).any():
            continue
        fitted = fit(vector, blocks, along)
        if fitted is None:
            text = f"the delay of {sensor} against gyr cannot be told: it turns too little"
            found.append(Finding(f"{sensor} delay", "note", text, decided=False))
            continue
        found.append(_of_delay(sensor, name, fitted))
        if sensor == "mag":
            found.append(_of_iron(fitted, float(np.nanmedian(length))))
    return found


def _of_delay(sensor: str, name: str, fitted: Fit) -> Finding:
    late, sigma = fitted.delay, fitted.delay_sigma
    figures = f"{1e3 * late:.1f} ± {1e3 * sigma:.1f} ms, from {fitted.pairs} pairs of directions"
    most = _UNEXPLAINED[sensor]
    if sigma > _VAGUE or abs(late) > _LARGEST or fitted.left > most:
        text = f"the delay of the {name} against the gyroscope is not determined ({figures})"
        if fitted.left > most:
            text += f": turning explains only {max(1.0 - fitted.left, 0.0):.0%} of how its direction changes"
        return Finding(f"{sensor} delay", "note", text, decided=False)
    if abs(late) > _CERTAIN * sigma and abs(late) >= _WORTH[sensor]:
        text = f"the {name} is {'late' if late > 0 else 'early'} against the gyroscope: {figures}"
        return Finding(f"{sensor} delay", "likely", text, Corrections(delays={sensor: round(late, 4)}))
    return Finding(
        f"{sensor} delay", "note", f"the {name} is late by {figures}, against the gyroscope: nothing to correct"
    )


def _of_iron(fitted: Fit, length: float) -> Finding:
    size, sigma = float(np.linalg.norm(fitted.offset)), float(np.max(fitted.offset_sigma))
    told = (
        f"hard iron {' '.join(f'{v:.2g}' for v in fitted.offset)} ± {' '.join(f'{v:.1g}' for v in fitted.offset_sigma)}, "
        f"{size / length:.1%} of the field"
    )
    if sigma > _KNOWN * length:
        text = f"{told}: the motion determines it badly; turn the sensor about all three axes"
        return Finding("hard iron", "note", text)
    if size < _EXPECTED * length or size < _CERTAIN * sigma:
        return Finding("hard iron", "note", f"{told}; the motion determines it")
    per_axis = size / length / 3.0**0.5
    text = f"{told}: calibrate the magnetometer, or let self-calibrating expect it (--set initial_iron={per_axis:.2g})"
    return Finding("hard iron", "likely" if size > _LARGE * length else "note", text)


def fit(vector: Floats, blocks: turning.Blocks, along: turning.Path) -> Fit | None:
    """The delay and the offset of *vector* (m, 3), by least squares over pairs of directions; None where nothing turns.

    With v(t − τ) ≈ v + τ ω × v, two vectors and the turn R between them leave
    v₂ − Rᵀv₁ = τ (ω₂ × v₂ − Rᵀ(ω₁ × v₁)) + (I − Rᵀ) h + T v₂ × b, h the sensor's offset and b the gyroscope's.
    """
    rate = blocks.gyr
    known = np.isfinite(vector).all(axis=1) & np.isfinite(rate).all(axis=1)
    known &= np.einsum("ij,ij->i", vector, vector) > 0
    index = np.flatnonzero(known)
    later = np.searchsorted(index, index + _LAG)
    first, later = index[later < len(index)], later[later < len(index)]
    second = index[later] if len(index) else index
    near = (second - first <= 3 * _LAG) & (along.unknown[first] == along.unknown[second])
    first, second = first[near], second[near]
    if len(first) < 10 * _FOLDS:
        return None
    usual = float(np.median(np.linalg.norm(vector[first], axis=1)))
    v1, v2 = vector[first] / usual, vector[second] / usual
    back = arrays.conjugate(arrays.multiply(arrays.conjugate(along.plain[first]), along.plain[second]))
    residual = v2 - arrays.rotate(back, v1)
    columns = [np.cross(rate[second], v2) - arrays.rotate(back, np.cross(rate[first], v1))]
    span = ((second - first) * blocks.width)[:, None]
    for axis in np.eye(3):
        columns.append(axis - arrays.rotate(back, np.broadcast_to(axis, v1.shape)))
    columns += [span * np.cross(v2, axis) for axis in np.eye(3)]
    design = np.stack(columns, axis=2)  # (n, 3, 7)
    fold = np.arange(len(first)) * _FOLDS // len(first)
    edges = np.searchsorted(fold, np.arange(_FOLDS + 1))
    weight = np.ones(len(first))
    for _ in range(_ROUNDS):
        weighted = (design * weight[:, None, None]).reshape(-1, 7)
        flat, target = design.reshape(-1, 7), residual.ravel()
        normal = np.array(
            [weighted[3 * a : 3 * b].T @ flat[3 * a : 3 * b] for a, b in zip(edges[:-1], edges[1:], strict=True)]
        )
        right = np.array(
            [weighted[3 * a : 3 * b].T @ target[3 * a : 3 * b] for a, b in zip(edges[:-1], edges[1:], strict=True)]
        )
        whole, all_right = normal.sum(axis=0), right.sum(axis=0)
        ridge = 1e-9 * np.trace(whole) * np.eye(7) / 7
        answer = np.linalg.solve(whole + ridge, all_right)
        misfit = np.linalg.norm(residual - design @ answer, axis=1)
        scale = max(1.5 * float(np.median(misfit)), 1e-9)
        weight = 1.0 / np.maximum(1.0, (misfit / scale) ** 2)
    left = float(np.sum(misfit**2) / max(float(np.sum((v2 - v1) ** 2)), 1e-12))
    without = np.array([np.linalg.solve(whole - n + ridge, all_right - r) for n, r in zip(normal, right, strict=True)])
    sigma = np.sqrt((_FOLDS - 1) / _FOLDS * np.sum((without - without.mean(axis=0)) ** 2, axis=0))
    if not (np.isfinite(sigma).all() and 0 < sigma[0] < _LARGEST):
        return None
    return Fit(float(answer[0]), float(sigma[0]), answer[1:4] * usual, sigma[1:4] * usual, left, len(first))
