"""Rotations of whole arrays: quaternions (n, 4) w x y z and vectors (n, 3)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def numbers(values: Any) -> Floats:
    """*values*, of a user, as a new array of numbers; one of shape (0,) where they are none."""
    try:
        return np.array(values, float)
    except (TypeError, ValueError, OverflowError):
        return np.empty(0)


def multiply(p: Floats, q: Floats) -> Floats:
    """p ⊗ q row by row (Hamilton)."""
    p, q = np.asarray(p), np.asarray(q)
    pw, px, py, pz = p[..., 0], p[..., 1], p[..., 2], p[..., 3]
    qw, qx, qy, qz = q[..., 0], q[..., 1], q[..., 2], q[..., 3]
    w = pw * qw - px * qx - py * qy - pz * qz
    product = np.empty((*w.shape, 4), w.dtype)  # half of what stacking takes, in short ones
    product[..., 0] = w
    product[..., 1] = pw * qx + px * qw + py * qz - pz * qy
    product[..., 2] = pw * qy - px * qz + py * qw + pz * qx
    product[..., 3] = pw * qz + px * qy - py * qx + pz * qw
    return product


def conjugate(q: Floats) -> Floats:
    return np.asarray(np.asarray(q) * np.array([1.0, -1.0, -1.0, -1.0]))


def length(v: Floats) -> Floats:
    """(n,) the lengths of (n, m) vectors; inf for one too long for a float, without a warning."""
    with np.errstate(over="ignore"):
        return np.asarray(np.linalg.norm(v, axis=-1))


def normalize(q: Floats) -> Floats:
    """Rows of length one; a row without a length becomes NaN."""
    length = np.linalg.norm(q, axis=-1, keepdims=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(length > 0, q / length, np.nan)


def rotate(q: Floats, v: Floats) -> Floats:
    """v turned by q, row by row."""
    q, v = np.asarray(q, float), np.asarray(v, float)
    axis = q[..., 1:]
    t = 2.0 * _cross(axis, v)
    return np.asarray(v + q[..., :1] * t + _cross(axis, t))


def _cross(a: Floats, b: Floats) -> Floats:
    """a × b, row by row: the same bits as numpy's, with which `rotate` takes 1.5 to 3 times as long."""
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    x = ay * bz - az * by
    product = np.empty((*x.shape, 3))
    product[..., 0] = x
    product[..., 1] = az * bx - ax * bz
    product[..., 2] = ax * by - ay * bx
    return product


def matrix(q: Floats) -> Floats:
    """(..., 3, 3): columns are the body's axes in the Earth frame."""
    w, x, y, z = np.moveaxis(np.asarray(q, float), -1, 0)
    return np.stack(
        [
            np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], -1),
            np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], -1),
            np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], -1),
        ],
        axis=-2,
    )


def from_matrix(m: Floats) -> Floats:
    """The quaternion of one 3 × 3 rotation matrix, w ≥ 0."""
    k = np.array(
        [
            [m[0, 0] + m[1, 1] + m[2, 2], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]],
            [0, m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]],
            [0, 0, m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1]],
            [0, 0, 0, m[2, 2] - m[0, 0] - m[1, 1]],
        ]
    )
    q = np.linalg.eigh(k, UPLO="U")[1][:, -1]  # Bar-Itzhack: the eigenvector of the largest eigenvalue
    return np.asarray(q if q[0] >= 0 else -q)


def angle(q: Floats) -> Floats:
    """The whole angle of each turn, rad in [0, π]."""
    return np.asarray(2.0 * np.arctan2(np.linalg.norm(q[..., 1:], axis=-1), np.abs(q[..., 0])))


def rotation_vector(q: Floats) -> Floats:
    """(..., 3) rad: the axis of each turn times its angle, at most half a turn; q and −q are one turn."""
    q = np.where(q[..., :1] < 0.0, -q, q)
    sine = length(q[..., 1:])
    scale = np.divide(2.0 * np.arctan2(sine, q[..., 0]), sine, out=np.full_like(sine, 2.0), where=sine > 1e-9)
    return np.asarray(scale[..., None] * q[..., 1:])


def turn_about_up(angle_rad: Floats) -> Floats:
    """Quaternions that turn the Earth frame counter-clockwise about up."""
    half = 0.5 * np.asarray(angle_rad, float)
    zero = np.zeros_like(half)
    return np.stack([np.cos(half), zero, zero, np.sin(half)], axis=-1)


def continuous(q: Floats) -> Floats:
    """The same attitudes with signs chosen so that neighbours never jump from q to −q; NaN rows pass through."""
    q = np.array(q, float)
    known = np.flatnonzero(np.isfinite(q).all(axis=1))
    if len(known) > 1:
        flips = np.einsum("ij,ij->i", q[known[1:]], q[known[:-1]]) < 0
        q[known[1:][np.cumsum(flips) % 2 == 1]] *= -1.0
    return q


def slerp(p: Floats, q: Floats, t: Floats) -> Floats:
    """From p (t = 0) to q (t = 1) along the shorter way, row by row."""
    q = np.where(np.einsum("ij,ij->i", p, q)[:, None] < 0, -q, q)
    step = multiply(conjugate(p), q)
    sine = np.linalg.norm(step[:, 1:], axis=1)
    half = np.arctan2(sine, step[:, 0])
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(sine > 1e-12, np.sin(t * half) / sine, t)
    return multiply(p, np.column_stack([np.cos(t * half), ratio[:, None] * step[:, 1:]]))
