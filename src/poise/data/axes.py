"""Words for axes: ``"y -x z"`` names the sensor axis that each new axis takes."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.errors import RecordingError

_EXAMPLE = 'three signed axes such as "y -x z" (new x is the sensor\'s y, new y its -x, new z its z)'


def rotation_matrix(axes: str | ArrayLike, *, mirror: bool = False) -> NDArray[np.float64]:
    """The proper rotation (3, 3) that *axes* names: words such as ``"y -x z"``, or the matrix itself.

    Raises :class:`RecordingError` for anything that is not a right-handed rotation; with *mirror* a left-handed one, as a
    single sensor's axes may be written down, will do.
    """
    if isinstance(axes, str):
        words = re.findall(r"([+-]?)([xyz])", axes.lower())
        rest = re.sub(r"[+-]?[xyz]|[\s,;]", "", axes.lower())
        if rest or len(words) != 3:
            raise RecordingError(f"axes {axes!r} not understood; expected {_EXAMPLE}")
        matrix = np.zeros((3, 3))
        for row, (sign, name) in enumerate(words):
            matrix[row, "xyz".index(name)] = -1.0 if sign == "-" else 1.0
    else:
        matrix = np.array(axes, dtype=float)
        if matrix.shape != (3, 3):
            raise RecordingError(f"a mounting rotation is a (3, 3) matrix, not {matrix.shape}; or give {_EXAMPLE}")
    if not np.allclose(matrix @ matrix.T, np.eye(3), atol=1e-6):
        raise RecordingError(f"axes {axes!r} are not a rotation: each of x, y, z must appear once; expected {_EXAMPLE}")
    if np.linalg.det(matrix) < 0 and not mirror:
        raise RecordingError(
            f"axes {axes!r} make a left-handed frame (a mirror image, which no mounting can be); flip one sign, "
            "or rename a single sensor's"
        )
    return matrix


def unit_vector(axis: str) -> NDArray[np.float64]:
    """The body axis that "x", "-y", … names, as a unit vector (3,)."""
    if axis.lstrip("+-").lower() not in ("x", "y", "z") or len(axis) > 2:
        raise RecordingError(f'axis {axis!r} not understood; expected one of "x", "y", "z", "-x", "-y", "-z"')
    vector = np.zeros(3)
    vector["xyz".index(axis[-1].lower())] = -1.0 if axis[0] == "-" else 1.0
    return vector
