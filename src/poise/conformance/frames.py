"""The 24 ways to name three axes, as quaternions, and their names for the Earth (ENU, NED, …) and the body."""

from __future__ import annotations

from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

from poise.math import arrays

Floats = NDArray[np.float64]


def _proper() -> Floats:
    """(24, 3, 3), the identity first."""
    found = []
    for columns in permutations(range(3)):
        for signs in product((1.0, -1.0), repeat=3):
            matrix = np.zeros((3, 3))
            matrix[range(3), columns] = signs
            if np.linalg.det(matrix) > 0:
                found.append(matrix)
    return np.array(found)


MATRICES = _proper()
QUATS = np.array([arrays.from_matrix(matrix) for matrix in MATRICES])


def earth_name(matrix: Floats) -> str:
    """The letters NED for the matrix (3, 3) from ENU to north-east-down: where each of the frame's axes points."""
    return "".join(_letter(row, ("EW", "NS", "UD")) for row in matrix)


def body_words(matrix: Floats) -> str:
    """The words of ``--remap``: which axis of ours each axis of theirs is, for v_theirs = M v_ours."""
    names = [_letter(row, ("x-", "y-", "z-")) for row in matrix]
    axes = ["xyz"[int(np.argmax(np.abs(row)))] for row in matrix]
    return " ".join(f"-{axis}" if name == "-" else axis for name, axis in zip(names, axes, strict=True))


def named_frame(name: str) -> Floats:
    """The quaternion from ENU to the frame that three letters name."""
    return np.asarray(QUATS[[earth_name(matrix) for matrix in MATRICES].index(name)])


def _letter(row: Floats, names: tuple[str, str, str]) -> str:
    axis = int(np.argmax(np.abs(row)))
    return names[axis][0 if row[axis] > 0 else 1]
