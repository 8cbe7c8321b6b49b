"""Whether an estimator would follow if one sensor's axes were exchanged, negated or scaled: then the mistake is found."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

from poise.conformance import frames
from poise.conformance.conventions import Fit
from poise.conformance.examining import Examined
from poise.conformance.feeding import FOLLOWS, UPRIGHT, Trial, tried

Floats = NDArray[np.float64]


def mended_gyroscope(found: Examined, trial: Trial, answer: Floats) -> str | None:
    """A sentence, if it follows once the gyroscope is fed against its own *answer* (3, 3) to a turn about each axis."""
    order = np.argmax(np.abs(answer), axis=1)
    if len(set(order.tolist())) < 3:
        return None
    gains = answer[range(3), order]
    size = float(np.mean(np.abs(gains)))
    if size < 1e-3:
        return None
    scale = 1.0 if abs(size - 1.0) < 0.1 else size
    mixing = np.zeros((3, 3))
    mixing[range(3), order] = np.sign(gains) * scale
    turn: Floats = np.asarray(np.linalg.inv(mixing).T, float)  # fed = turn · gyr
    fit = _following(found, trial, "gyr", turn)
    if fit is None:
        return None
    axes = frames.body_words(np.sign(turn) * (np.abs(turn) > 0.5 / scale))
    what = [] if axes == "x y z" else [f'as "{axes}"']
    what += [] if scale == 1.0 else [f"times {1.0 / scale:.3g}"]
    return f"with gyr fed {', '.join(what)} it follows: {fit.residual:.2f}°, {fit.frame}" if what else None


def mended_axes(found: Examined, trial: Trial, sensor: str) -> str | None:
    """A sentence, if the estimator follows with the axes of *sensor* exchanged or negated, mirror images too."""
    tries = []
    for columns, signs in product(permutations(range(3)), product((1.0, -1.0), repeat=3)):
        matrix = np.zeros((3, 3))
        matrix[range(3), columns] = signs
        changes = sum(c != i for i, c in enumerate(columns)) + sum(s < 0 for s in signs)
        if changes > 0:
            tries.append((changes, matrix))
    for _, matrix in sorted(tries, key=lambda t: t[0]):
        if fit := _following(found, trial, sensor, matrix):
            return f'with {sensor} fed as "{frames.body_words(matrix)}" it follows: {fit.residual:.2f}°, {fit.frame}'
    return None


def _following(found: Examined, trial: Trial, sensor: str, turn: Floats) -> Fit | None:
    fed = found.scene.recording
    other = replace(fed, **{sensor: getattr(fed, sensor) @ turn.T}, truth=None)
    again = tried(found.run, replace(found.scene, recording=other), trial.feed)
    upright = [f for f in again.fits[:40] if f.residual <= FOLLOWS and (f.tilted < UPRIGHT or not found.hears["acc"])]
    return min(upright, key=lambda f: (f.complexity(True), f.residual), default=None)
