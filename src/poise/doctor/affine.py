"""A sensor's scale, cross-axis terms and offset in the gyroscope's axes, from how both turn."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.recording import Recording
from poise.doctor import turning
from poise.errors import RecordingError
from poise.math import arrays

Floats = NDArray[np.float64]

_LAGS = (10, 20, 40)  # blocks from one direction to the other: 0.5 to 2 s
_LEAST = 200  # pairs
_SURE = 0.01  # of the field: the least singular value but one, per pair, without which the motion determines too little


class Affine(NamedTuple):
    """What makes a sensor's readings those of one without errors: ``matrix @ reading − offset``."""

    matrix: Floats
    """(3, 3), of determinant 1: turning alone does not tell the length of a field"""
    offset: Floats
    """(3,) in the sensor's unit"""

    def __call__(self, reading: Floats) -> Floats:
        """(..., 3) corrected."""
        return np.asarray(reading @ self.matrix.T - self.offset)


def magnetometer(recording: Recording) -> Affine:
    """Soft and hard iron of a *recording* in which the sensor turned about all its axes, and rested at times.

    The field stands still in the room, so x = B v − c of two instants are one vector turned: x₁ = R x₂, with R of the
    gyroscope. That is linear and homogeneous in B and c: the solution is the direction in which pairs of instants disagree
    least. Raises :class:`RecordingError` where the motion does not determine them.
    """
    found = turning.blocks(recording)
    along = turning.path(found)
    usual = float(np.nanmedian(np.linalg.norm(found.mag, axis=1))) if np.isfinite(found.mag).any() else 0.0
    rows = [_pairs(found.mag / usual, along, lag) for lag in _LAGS] if usual > 0.0 else []
    count = sum(map(len, rows)) // 3
    if count < _LEAST:
        raise RecordingError(f"magnetometer: {count} pairs of directions to calibrate by, expected {_LEAST} or more")
    normal = sum(part.T @ part for part in rows) / count
    values, vectors = np.linalg.eigh(normal)
    if not values[1] > _SURE**2:
        raise RecordingError("magnetometer: turn the sensor about all three axes: the motion determines too little")
    matrix, offset = vectors[:9, 0].reshape(3, 3), vectors[9:, 0]
    size = np.cbrt(np.linalg.det(matrix))
    return Affine(matrix / size, offset * (usual / size))


def _pairs(vector: Floats, along: turning.Path, lag: int) -> Floats:
    """(3 n, 12): the equations of *vector* (m, 3) and itself *lag* blocks later, for the rows of B and for c."""
    first = np.arange(max(len(vector) - lag, 0))
    second = first + lag
    known = np.isfinite(vector[first] + vector[second]).all(axis=1) & (along.unknown[first] == along.unknown[second])
    first, second = first[known], second[known]
    back = arrays.multiply(arrays.conjugate(along.plain[first]), along.plain[second])
    turn = arrays.matrix(back)  # (n, 3, 3)
    eye = np.broadcast_to(np.eye(3), turn.shape)
    of_matrix = eye[..., None] * vector[first][:, None, None, :] - turn[..., None] * vector[second][:, None, None, :]
    return np.concatenate([of_matrix.reshape(-1, 9), (turn - eye).reshape(-1, 3)], axis=1)
