"""Rotations of whole arrays against scipy, and what they do where rows are unknown."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from helpers import assert_same_attitude, random_quats, rotation, wxyz
from poise.math import arrays

P, Q = random_quats(50, seed=1), random_quats(50, seed=2)
V = np.random.default_rng(3).normal(size=(50, 3))
UNKNOWN = np.full(4, np.nan)


def test_multiply_is_scipys_product() -> None:
    assert_same_attitude(arrays.multiply(P, Q), wxyz(rotation(P) * rotation(Q)))


def test_multiply_takes_one_quaternion_for_all_rows() -> None:
    np.testing.assert_array_equal(arrays.multiply(P[0], Q), arrays.multiply(np.tile(P[0], (50, 1)), Q))


def test_conjugate_is_the_inverse() -> None:
    np.testing.assert_allclose(arrays.multiply(P, arrays.conjugate(P)), np.tile([1.0, 0, 0, 0], (50, 1)), atol=1e-15)


def test_rotate_and_matrix_are_scipys() -> None:
    np.testing.assert_allclose(arrays.rotate(P, V), rotation(P).apply(V), atol=1e-14)
    np.testing.assert_allclose(arrays.rotate(P, V[0]), rotation(P).apply(V[0]), atol=1e-14)
    np.testing.assert_allclose(arrays.matrix(P), rotation(P).as_matrix(), atol=1e-14)
    np.testing.assert_allclose(arrays.matrix(P[0]), rotation(P[0]).as_matrix(), atol=1e-14)


def test_from_matrix_undoes_matrix() -> None:
    for q in P:
        found = arrays.from_matrix(arrays.matrix(q))
        assert found[0] >= 0
        assert_same_attitude(found, q)


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, -1, 1)])
@pytest.mark.parametrize("angle", [0.0, 1e-8, np.pi / 2, np.pi - 1e-9, np.pi])
def test_from_matrix_at_every_angle(axis: tuple[float, ...], angle: float) -> None:
    turn = Rotation.from_rotvec(angle * np.array(axis) / np.linalg.norm(axis))
    assert_same_attitude(arrays.from_matrix(turn.as_matrix()), wxyz(turn))


def test_normalize_gives_length_one_and_knows_when_it_cannot() -> None:
    rows = arrays.normalize(np.array([[3.0, 0, 4, 0], [0, 0, 0, 0], UNKNOWN, [1e-9, 0, 0, 0]]))
    np.testing.assert_allclose(rows, [[0.6, 0, 0.8, 0], UNKNOWN, UNKNOWN, [1, 0, 0, 0]])


def test_angle_is_scipys_magnitude_and_exact_for_small_turns() -> None:
    np.testing.assert_allclose(arrays.angle(P), rotation(P).magnitude(), atol=1e-14)
    small = wxyz(Rotation.from_rotvec([[1e-10, 0, 0], [0, 0, 0], [0, np.pi, 0]]))
    np.testing.assert_allclose(arrays.angle(small), [1e-10, 0, np.pi], rtol=1e-12)
    np.testing.assert_allclose(arrays.angle(-small), [1e-10, 0, np.pi], rtol=1e-12)


def test_turn_about_up_is_counter_clockwise() -> None:
    east = np.array([1.0, 0, 0])
    np.testing.assert_allclose(arrays.rotate(arrays.turn_about_up(np.array(np.pi / 2)), east), [0, 1, 0], atol=1e-15)
    assert arrays.turn_about_up(np.linspace(0, 1, 5)).shape == (5, 4)


def test_slerp_is_scipys() -> None:
    t = np.linspace(0, 1, 50)
    expected = [wxyz(Slerp([0, 1], rotation(np.array([p, q])))(x)) for p, q, x in zip(P, Q, t, strict=True)]
    assert_same_attitude(arrays.slerp(P, Q, t), expected)


def test_slerp_takes_the_shorter_way_whatever_the_signs() -> None:
    t = np.full(50, 0.3)
    assert_same_attitude(arrays.slerp(P, -Q, t), arrays.slerp(P, Q, t))
    travelled = rotation(P).inv() * rotation(arrays.slerp(P, Q, t))
    np.testing.assert_allclose(travelled.magnitude(), 0.3 * (rotation(P).inv() * rotation(Q)).magnitude(), atol=1e-12)


def test_slerp_between_equal_and_almost_equal_attitudes() -> None:
    near = arrays.multiply(P, wxyz(Rotation.from_rotvec([1e-13, 0, 0])))
    for other in (P, -P, near):
        found = arrays.slerp(P, other, np.full(50, 0.5))
        np.testing.assert_allclose(found, P, rtol=0, atol=1e-13)
    np.testing.assert_array_equal(arrays.slerp(P, Q, np.zeros(50)), P)


def test_slerp_from_or_to_an_unknown_row_is_unknown() -> None:
    p, q = P[:3].copy(), Q[:3].copy()
    p[0], q[1] = np.nan, np.nan
    found = arrays.slerp(p, q, np.full(3, 0.5))
    assert np.isnan(found[:2]).all()
    assert np.isfinite(found[2]).all()


def test_continuous_never_jumps_and_keeps_the_attitudes() -> None:
    smooth = wxyz(Rotation.from_rotvec(np.linspace(0, 12, 300)[:, None] * [0.6, 0, 0.8]))
    torn = smooth * np.random.default_rng(4).choice([-1.0, 1.0], size=(300, 1))
    torn[[0, 10, 11, 299]] = np.nan
    before = torn.copy()
    found = arrays.continuous(torn)
    np.testing.assert_array_equal(torn, before)
    np.testing.assert_array_equal(np.isnan(found), np.isnan(torn))
    known = np.isfinite(found).all(axis=1)
    assert (np.sum(found[known][1:] * found[known][:-1], axis=1) > 0).all()
    np.testing.assert_array_equal(np.abs(found[known]), np.abs(torn[known]))
    np.testing.assert_array_equal(found[1], torn[1])  # the first known row decides


@pytest.mark.parametrize("rows", [np.empty((0, 4)), np.full((3, 4), np.nan), np.array([[0.0, 1, 0, 0]])])
def test_continuous_with_nothing_to_do(rows: np.ndarray) -> None:
    np.testing.assert_array_equal(arrays.continuous(rows), rows)
