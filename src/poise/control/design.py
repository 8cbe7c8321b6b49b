"""Gains from what a user knows of a body: placed poles, and linear-quadratic regulators."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite, pi, radians

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.errors import MethodError
from poise.math import arrays
from poise.math.matrices import Mat3
from poise.math.vectors import Vec3

Floats = NDArray[np.float64]
Matrix = float | Sequence[float] | Sequence[Sequence[float]] | Floats | Mat3


def lqr(a: ArrayLike, b: ArrayLike, q: ArrayLike, r: ArrayLike) -> Floats:
    """The gain K (m, n) of ``u = −K x`` that makes ∫ xᵀ Q x + uᵀ R u least for ``ẋ = A x + B u``.

    Raises :class:`MethodError` where a matrix does not fit, Q is not ≥ 0, R not > 0, or no gain can stabilise the body.
    """
    from scipy.linalg import LinAlgError, solve_continuous_are

    states, inputs = _rows("A", a), _rows("B", b)
    n, m = inputs.shape if inputs.ndim == 2 else (0, 0)
    if states.shape != (n, n) or not m:
        raise MethodError(f"lqr: A, B: expected (n, n) and (n, m), found {states.shape} and {inputs.shape}")
    cost, effort = _rows("Q", q), _rows("R", r)
    for name, matrix, size, strictly in (("Q", cost, n, False), ("R", effort, m, True)):
        if matrix.shape != (size, size):
            raise MethodError(f"lqr: {name}: expected ({size}, {size}), found {matrix.shape}")
        check_definite(f"lqr: {name}", matrix, strictly=strictly)
    try:
        gain = np.asarray(np.linalg.solve(effort, inputs.T @ solve_continuous_are(states, inputs, cost, effort)), float)
    except (LinAlgError, ValueError) as problem:
        raise MethodError(f"lqr: no gain stabilises A, B at the cost Q ({problem})") from None
    if not (np.linalg.eigvals(states - inputs @ gain).real < 0.0).all():
        raise MethodError("lqr: no gain stabilises A, B at the cost Q: a state of A is reached neither by B nor by Q")
    return gain


def inertia_matrix(name: str, inertia: Matrix) -> Floats:
    """(3, 3) kg m² from one number, three about the axes, or a whole matrix."""
    given = arrays.numbers(inertia)
    if given.shape not in ((), (3,), (3, 3)):
        raise MethodError(f"{name}: inertia: expected one number, three or 3 × 3 (kg m²), found {inertia!r}")
    whole = given if given.shape == (3, 3) else np.diag(np.broadcast_to(given, 3))
    check_definite(f"{name}.inertia", whole, strictly=True)
    return whole


def pole_gains(
    name: str, inertia: Matrix, bandwidth_hz: float, damping: float, integral: float
) -> tuple[Mat3, Mat3, Mat3, Mat3]:
    """Inertia, K, D and L that give the linearised body the poles of (s² + 2ζω s + ω²)(s + aω)."""
    matrix = inertia_matrix(name, inertia)
    w = 2.0 * pi * positive(name, "bandwidth_hz", bandwidth_hz, "Hz")
    zeta, share = positive(name, "damping", damping), positive(name, "integral", integral, zero=True)
    pole = share * w
    gains = (1.0, w * w + 2.0 * zeta * w * pole, 2.0 * zeta * w + pole, w * w * pole)
    inertia3, k, d, i = (mat3(each * matrix) for each in gains)
    return inertia3, k, d, i


def regulator_gains(name: str, inertia: Matrix, sizes: Mapping[str, float]) -> tuple[Mat3, Mat3, Mat3]:
    """Inertia, K and D of the regulator of a body at rest, ``J ẍ = u``; *sizes* as for ``AttitudeControl.optimal``."""
    matrix = inertia_matrix(name, inertia)
    angle, rate, torque = (positive(name, each, value) for each, value in sizes.items())
    zero, one = np.zeros((3, 3)), np.eye(3)
    a = np.block([[zero, one], [zero, zero]])
    b = np.vstack([zero, np.linalg.inv(matrix)])
    q = np.diag(np.repeat([radians(angle) ** -2, radians(rate) ** -2], 3))
    gain = lqr(a, b, q, one / torque**2)
    return mat3(matrix), mat3(gain[:, :3]), mat3(gain[:, 3:])


def check_definite(name: str, matrix: ArrayLike, *, strictly: bool) -> None:
    """Raises :class:`MethodError` unless *matrix* is symmetric and positive (or, not strictly, not negative)."""
    values = np.asarray(matrix, float)
    if not np.isfinite(values).all():
        raise MethodError(f"{name}: expected finite numbers, found {values.tolist()}")
    size = float(np.abs(values).max(initial=0.0))
    if not np.allclose(values, values.T, rtol=0.0, atol=1e-6 * size):
        raise MethodError(f"{name}: expected a symmetric matrix, found {values.tolist()}")
    least = float(np.linalg.eigvalsh(values).min())
    if least < -1e-9 * size or (strictly and least <= 1e-12 * size):
        expected = "positive about every axis" if strictly else "not negative about any axis"
        raise MethodError(f"{name}: expected {expected}, found a smallest eigenvalue of {least:.3g}")


def positive(name: str, field: str, value: float, unit: str = "", *, zero: bool = False) -> float:
    """*value* as a number above zero (or, where told, zero). Raises :class:`MethodError`, which names the field."""
    good = isinstance(value, (int, float, np.number)) and not isinstance(value, bool) and isfinite(value)
    if not good or value < 0.0 or (value == 0.0 and not zero):
        expected = f"expected a number {'of 0 or more' if zero else 'above 0'} {unit}".rstrip()
        raise MethodError(f"{name}: {field}: {expected}, found {value!r}")
    return float(value)


def mat3(matrix: Floats) -> Mat3:
    """The (3, 3) array as kernels see it."""
    x, y, z = (Vec3(*(float(each) for each in row)) for row in (matrix + matrix.T) / 2.0)
    return Mat3(x, y, z)


def _rows(name: str, matrix: ArrayLike) -> Floats:
    found = np.atleast_2d(arrays.numbers(matrix))
    if not found.size:
        raise MethodError(f"lqr: {name}: expected a matrix of numbers, found {matrix!r}")
    if not np.isfinite(found).all():
        raise MethodError(f"lqr: {name}: expected finite numbers, found {found.tolist()}")
    return found
