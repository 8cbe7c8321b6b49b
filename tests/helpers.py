"""What several test files need: NamedTuples as arrays, kernels and the Python behind them, comparison of rotations."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from hypothesis import given, settings
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

Floats = NDArray[np.float64]


def plain(function: Callable[..., Any]) -> Callable[..., Any]:
    """The Python function that a kernel was compiled from."""
    return getattr(function, "py_func", function)


def array(value: Any) -> Floats:
    """A vector, quaternion or matrix of NamedTuples as an array of its shape."""
    return np.array(value, float)


def flat(value: Any) -> list[float]:
    """Every number in nested tuples, in order."""
    return [number for part in value for number in flat(part)] if isinstance(value, tuple) else [float(value)]


def random_quats(n: int, seed: int = 0) -> Floats:
    """(n, 4) w x y z, evenly spread over all attitudes."""
    q = np.random.default_rng(seed).normal(size=(n, 4))
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def rotation(quat: ArrayLike) -> Rotation:
    """The scipy Rotation of w x y z."""
    return Rotation.from_quat(np.asarray(quat, float)[..., [1, 2, 3, 0]])


def wxyz(turn: Rotation) -> Floats:
    """w x y z of a scipy Rotation."""
    return turn.as_quat()[..., [3, 0, 1, 2]]


def angle_between(p: ArrayLike, q: ArrayLike) -> Floats:
    """The angle, rad, between attitudes given as w x y z; q and −q are one attitude."""
    return np.asarray((rotation(p).inv() * rotation(q)).magnitude())


def assert_same_attitude(p: ArrayLike, q: ArrayLike, atol: float = 1e-12) -> None:
    """Quaternions equal up to sign, row by row."""
    p, q = np.atleast_2d(np.asarray(p, float)), np.atleast_2d(np.asarray(q, float))
    sign = np.where(np.sum(p * q, axis=1, keepdims=True) < 0, -1.0, 1.0)
    np.testing.assert_allclose(sign * p, q, rtol=0, atol=atol)


def for_all(*strategies: Any, **named: Any) -> Callable[..., Any]:
    """Hypothesis without a deadline: the first call may compile."""
    return lambda test: settings(max_examples=60, deadline=None)(given(*strategies, **named)(test))


def close(found: Any, expected: Any, atol: float = 1e-12) -> None:
    np.testing.assert_allclose(array(found), array(expected), rtol=0, atol=atol)


def assert_compiled_as_python(area: Callable[..., Any], *args: Any) -> None:
    """A kernel that uses a whole area gives the numbers that its Python source gives."""
    by_python = plain(area)(*args)
    np.testing.assert_allclose(flat(area(*args)), flat(by_python), rtol=1e-13, atol=1e-15)


def in_packets(
    true: Floats, seed: int, *, first: bool = False, late: float = 0.0, apart: float = 0.0, most: int = 12
) -> Floats:
    """Stamps of rows that arrive 4 to *most* at a time: all of a packet have that of its last row, or of its *first*, or of
    when it was received, *late* s after its last in the mean, or when each was read, *apart* s after the one before."""
    rng, rows = np.random.default_rng(seed), np.arange(len(true))
    ends = np.cumsum(rng.integers(4, most + 1, len(true))) - 1
    packet = np.searchsorted(ends, rows)
    begins = np.append(0, ends + 1)[packet]
    stamps = true[begins if first else np.minimum(ends[packet], len(true) - 1)]
    return np.maximum.accumulate(stamps + late * rng.exponential(size=len(true))[packet] + apart * (rows - begins))
