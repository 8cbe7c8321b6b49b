"""The per-sample algebra: group laws, known values, and the same numbers from plain Python and from compiled code."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, isfinite, pi, sin, sqrt
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from helpers import (
    angle_between,
    array,
    assert_compiled_as_python,
    assert_same_attitude,
    close,
    for_all,
    plain,
    rotation,
    wxyz,
)
from poise.estimators.two_stage import heading_turn, levelled, north_matrix, rate_matrix, turns_about_earth, up_matrix
from poise.math.compiled import compiled
from poise.math.matrices import I3, I4, Mat3, Mat4, Mat34, Mat43, diagonal, inverse, matrix, outer, transpose
from poise.math.quaternions import (
    IDENTITY,
    Angles,
    Quat,
    angles_from,
    angles_of,
    attitude_of,
    conjugate,
    exp,
    from_angles,
    inner,
    normalize,
    north_in_body,
    north_of,
    rotate,
    shortest_turn,
    up_in_body,
    wrapped,
)
from poise.math.vectors import ABSENT, NORTH, UP, ZERO, Vec3, cross, dot, norm, present, unit, within

numbers = st.floats(-10.0, 10.0).filter(lambda x: x == 0.0 or abs(x) > 1e-6)
vectors = st.builds(Vec3, numbers, numbers, numbers)
long_vectors = vectors.filter(lambda v: np.linalg.norm(v) > 1e-2)
any_quats = st.builds(Quat, numbers, numbers, numbers, numbers)
unit_quats = any_quats.filter(lambda q: np.linalg.norm(q) > 1e-2).map(lambda q: Quat(*(array(q) / np.linalg.norm(q))))
headings = st.floats(-3.1, 3.1)
pitches = st.floats(-1.5, 1.5)
declinations = st.one_of(st.just(0.0), st.floats(-3.0, 3.0))

p_, q_ = Quat(0.5, -0.1, 0.7, 0.2), Quat(-0.3, 0.4, 0.1, 0.6)
u_, v_ = Vec3(0.3, -2.0, 1.1), Vec3(-0.7, 0.4, 1.9)
EAST = Vec3(1.0, 0.0, 0.0)


# -- vectors ----------------------------------------------------------------------------------------------------------


@for_all(vectors, vectors, numbers)
def test_vector_operators_are_those_of_arrays(u: Vec3, v: Vec3, s: float) -> None:
    a, b = array(u), array(v)
    close(u + v, a + b)
    close(u - v, a - b)
    close(-u, -a)
    close(s * u, s * a)
    close(u * s, s * a)
    close(u / 4.0, a / 4.0)
    close(plain(dot)(u, v), a @ b)
    close(plain(cross)(u, v), np.cross(a, b))
    close(plain(norm)(u), np.linalg.norm(a))


@for_all(long_vectors)
def test_unit_keeps_the_direction(v: Vec3) -> None:
    close(plain(unit)(v), array(v) / np.linalg.norm(v))


def test_presence_and_limits() -> None:
    for sensor in (present, plain(present)):
        assert sensor(Vec3(0.0, 0.0, 0.0))
        assert not sensor(ABSENT)
        assert not sensor(Vec3(1.0, float("inf"), 2.0))
        assert not sensor(Vec3(float("inf"), float("-inf"), 2.0))
    for small in (within, plain(within)):
        assert small(Vec3(-2.0, 2.0, 0.0), 2.0)
        assert not small(Vec3(-2.1, 0.0, 0.0), 2.0)
        assert not small(ABSENT, 2.0)


@compiled
def vector_area(u: Vec3, v: Vec3) -> Any:
    sums = (u + v, u - v, -u, 2.5 * u, u * 2.5, u / 3.0)
    return sums, dot(u, v), cross(u, v), norm(u), unit(v), within(u, 1.5), within(u, 2.5), present(u), present(ABSENT)


def test_vectors_compiled_as_python() -> None:
    assert_compiled_as_python(vector_area, u_, v_)


# -- quaternions ------------------------------------------------------------------------------------------------------


@for_all(any_quats, any_quats, any_quats)
def test_product_is_associative_and_distributes(p: Quat, q: Quat, r: Quat) -> None:
    close((p * q) * r, p * (q * r), 1e-9)
    close(p * (q + r), p * q + p * r, 1e-9)
    close(p * (q - r), p * q - p * r, 1e-9)


def test_product_is_hamiltons() -> None:
    one, i, j, k = (Quat(*row) for row in np.eye(4).tolist())
    assert i * j == k and j * k == i and k * i == j
    assert i * i == j * j == k * k == -one
    assert j * i == -k


@for_all(unit_quats)
def test_conjugate_is_the_inverse_and_identity_does_nothing(q: Quat) -> None:
    close(q * plain(conjugate)(q), IDENTITY)
    close(plain(conjugate)(q) * q, IDENTITY)
    assert q * IDENTITY == q


@for_all(any_quats, any_quats, numbers)
def test_quaternions_add_and_scale_as_vectors_of_four(p: Quat, q: Quat, s: float) -> None:
    a, b = array(p), array(q)
    close(p + q, a + b)
    close(p - q, a - b)
    close(-p, -a)
    close(s * p, s * a)
    close(plain(inner)(p, q), a @ b)


@for_all(any_quats.filter(lambda q: np.linalg.norm(q) > 1e-2))
def test_normalize_has_length_one(q: Quat) -> None:
    close(plain(normalize)(q), array(q) / np.linalg.norm(q))


@for_all(unit_quats, unit_quats, vectors)
def test_rotate_is_a_homomorphism(p: Quat, q: Quat, v: Vec3) -> None:
    turn = plain(rotate)
    close(turn(p * q, v), turn(p, turn(q, v)), 1e-11)
    close(turn(q, v), rotation(q).apply(array(v)), 1e-11)
    close(turn(-q, v), turn(q, v), 1e-11)


@for_all(unit_quats, vectors)
def test_matrix_turns_as_rotate_does(q: Quat, v: Vec3) -> None:
    m = plain(matrix)(q)
    close(m @ v, plain(rotate)(q, v), 1e-11)
    close(m, rotation(q).as_matrix())


@for_all(unit_quats)
def test_axes_of_the_earth_seen_from_the_body(q: Quat) -> None:
    back = rotation(q).inv()
    close(plain(up_in_body)(q), back.apply(array(UP)))
    close(plain(north_in_body)(q), back.apply(array(NORTH)))


@pytest.mark.parametrize(
    "angle",
    [0.0, 5e-324, 1e-200, 1e-12, 1e-5, 0.01, 0.1, 0.1999999, 0.2, 0.2000001, 0.5, 1.0, 3.0, pi, 4.0, 2 * pi, 7.0, 40.0],
)
def test_exp_at_small_and_large_angles(angle: float) -> None:
    for axis in np.vstack([np.eye(3), [[0.6, -0.48, 0.64]]]):
        q = array(plain(exp)(Vec3(*(angle * axis).tolist())))
        half = 0.5 * angle
        np.testing.assert_allclose(q, [cos(half), *(sin(half) * axis)], rtol=1e-15, atol=2.3e-16)


@for_all(vectors)
@example(Vec3(1e-9, 0.0, -1e-9))
def test_exp_is_scipys_from_rotvec(v: Vec3) -> None:
    assert_same_attitude(plain(exp)(v), wxyz(Rotation.from_rotvec(array(v))), 1e-13)


def test_exp_is_continuous_where_the_series_ends() -> None:
    below, above = (array(plain(exp)(Vec3(0.0, angle, 0.0))) for angle in (np.nextafter(0.2, 0), np.nextafter(0.2, 1)))
    np.testing.assert_allclose(below, above, rtol=0, atol=2.3e-16)


@for_all(long_vectors, long_vectors)
def test_shortest_turn_takes_one_to_the_other_the_short_way(u: Vec3, v: Vec3) -> None:
    u, v = plain(unit)(u), plain(unit)(v)
    q = plain(shortest_turn)(u, v)
    close(plain(inner)(q, q), 1.0)
    close(plain(rotate)(q, u), v, 3e-6)  # to 1.4 µrad of opposite the turn may be taken for half a turn
    between = np.arctan2(np.linalg.norm(np.cross(u, v)), array(u) @ array(v))
    assert rotation(q).magnitude() == pytest.approx(between, abs=3e-6)


@pytest.mark.parametrize(
    "u", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1), (0.6, 0, -0.8), (0, 0.28, 0.96), (0.48, 0.6, 0.64)]
)
def test_shortest_turn_between_opposites_and_equals(u: tuple[float, float, float]) -> None:
    start = Vec3(*map(float, u))
    for turn in (shortest_turn, plain(shortest_turn)):
        half = turn(start, -start)
        close(rotate(half, start), -start)
        assert rotation(half).magnitude() == pytest.approx(pi)
        close(turn(start, start), IDENTITY)


@for_all(pitches, headings, headings)
def test_from_angles_is_heading_then_pitch_then_roll(pitch: float, roll: float, heading: float) -> None:
    q = plain(from_angles)(Angles(pitch, roll, heading))
    assert_same_attitude(q, wxyz(Rotation.from_euler("ZXY", [heading, pitch, roll])))


@for_all(pitches, headings, headings)
def test_angles_from_undoes_from_angles(pitch: float, roll: float, heading: float) -> None:
    angles = Angles(pitch, roll, heading)
    close(plain(angles_from)(plain(from_angles)(angles)), angles, 1e-9)


def resting(attitude: Rotation, declination: float = 0.0) -> tuple[Vec3, Vec3]:
    """What a resting sensor measures: specific force and a field that points to magnetic north and down."""
    field = [20.0 * sin(declination), 20.0 * cos(declination), -40.0]
    return Vec3(*attitude.inv().apply([0, 0, 9.81]).tolist()), Vec3(*attitude.inv().apply(field).tolist())


@for_all(pitches, headings, headings)
def test_angles_of_a_resting_sensor(pitch: float, roll: float, heading: float) -> None:
    acc, mag = resting(Rotation.from_euler("ZXY", [heading, pitch, roll]))
    close(plain(angles_of)(acc, mag), Angles(pitch, roll, heading), 1e-9)


@for_all(unit_quats, declinations)
def test_attitude_of_a_resting_sensor_is_its_attitude(q: Quat, declination: float) -> None:
    acc, mag = resting(rotation(q), declination)
    assume(abs(acc.y) < 9.81 * 0.999999)
    assert angle_between(plain(attitude_of)(acc, mag, declination), q) < 1e-9


@for_all(long_vectors, long_vectors, declinations)
def test_attitude_of_is_from_angles_of_angles_of(acc: Vec3, mag: Vec3, declination: float) -> None:
    up = plain(unit)(acc)
    assume(np.linalg.norm(np.cross(up, plain(unit)(mag))) > 1e-3 and abs(up.y) < 0.999999)
    angles = plain(angles_of)(acc, mag)
    by_angles = plain(from_angles)(Angles(angles.pitch, angles.roll, angles.heading - declination))
    assert_same_attitude(plain(attitude_of)(acc, mag, declination), by_angles, 1e-8)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("declination", [0.0, 0.1])
def test_attitude_of_with_the_y_axis_along_gravity(side: float, declination: float) -> None:
    acc, mag = Vec3(0.0, side * 9.81, 0.0), Vec3(3.0, -40.0, 20.0)
    angles = plain(angles_of)(acc, mag)
    by_angles = plain(from_angles)(Angles(angles.pitch, angles.roll, angles.heading - declination))
    for found in (attitude_of(acc, mag, declination), plain(attitude_of)(acc, mag, declination)):
        assert_same_attitude(found, by_angles)
        close(rotate(found, Vec3(0.0, side, 0.0)), UP)


@pytest.mark.parametrize("mag", [ABSENT, ZERO, Vec3(0.0, 0.0, -40.0)])
def test_without_a_level_field_the_heading_is_zero(mag: Vec3) -> None:
    acc = Vec3(0.0, 0.0, 9.81)
    for attitude in (attitude_of, plain(attitude_of)):
        close(attitude(acc, mag, 0.3), IDENTITY)
    assert plain(angles_of)(acc, mag).heading == 0.0


@pytest.mark.parametrize("tiny", [1e-160, -1e-160, 5e-324, 1e-158])
def test_attitude_of_components_whose_squares_underflow_is_a_unit_quaternion(tiny: float) -> None:
    acc, mag = Vec3(tiny, 9.81, tiny), Vec3(30.0, tiny, tiny)
    for attitude in (attitude_of, plain(attitude_of)):
        for a, m in ((acc, mag), (Vec3(0.0, 0.0, 9.81), Vec3(tiny, tiny, -40.0))):
            assert np.linalg.norm(attitude(a, m, 0.1)) == pytest.approx(1.0, abs=1e-12)


@for_all(long_vectors, long_vectors, declinations)
def test_north_of_is_the_north_of_attitude_of(acc: Vec3, mag: Vec3, declination: float) -> None:
    up = plain(unit)(acc)
    assume(np.linalg.norm(np.cross(up, plain(unit)(mag))) > 1e-3 and abs(up.y) < 0.999999)
    north = plain(north_of)(up, mag, declination)
    close(north, plain(north_in_body)(plain(attitude_of)(acc, mag, declination)), 1e-8)
    close(plain(dot)(north, up), 0.0)


@pytest.mark.parametrize("north", [north_of, plain(north_of)])
def test_a_field_along_up_does_not_make_north_nan(north: Callable[..., Vec3]) -> None:
    assert all(map(isfinite, north(UP, Vec3(0.0, 0.0, -40.0), 0.0)))


@for_all(st.floats(-50.0, 50.0))
@example(-pi)
@example(pi)
@example(3 * pi)
def test_wrapped_is_the_same_angle_within_half_a_turn(angle: float) -> None:
    found = plain(wrapped)(angle)
    assert -pi <= found <= pi
    assert abs((angle - found) / (2 * pi) - round((angle - found) / (2 * pi))) < 1e-12


@compiled
def quaternion_area(p: Quat, q: Quat, v: Vec3) -> Any:
    operators = (p * q, 2.0 * p, p + q, p - q, -p)
    r = normalize(p)
    turns = (rotate(r, v), exp(v), exp(0.01 * v), shortest_turn(unit(v), UP), shortest_turn(UP, -UP))
    return operators, turns, conjugate(p), inner(p, q), r, up_in_body(r), north_in_body(r)


@compiled
def angle_area(acc: Vec3, mag: Vec3) -> Any:
    angles = angles_of(acc, mag)
    q = attitude_of(acc, mag, 0.0)
    d = attitude_of(acc, mag, -0.2)
    bare = attitude_of(acc, ABSENT, 0.2)
    ends = (wrapped(4.0), wrapped(-4.0), wrapped(pi))
    return angles, q, d, bare, from_angles(angles), angles_from(d), north_of(unit(acc), mag, 0.4), ends


def test_quaternions_compiled_as_python() -> None:
    assert_compiled_as_python(quaternion_area, p_, q_, v_)


@pytest.mark.parametrize("acc", [Vec3(1.0, -2.0, 9.0), Vec3(1.0, 2.0, -9.0), Vec3(-3.0, 8.0, -0.5)])
def test_angles_compiled_as_python(acc: Vec3) -> None:
    assert_compiled_as_python(angle_area, acc, Vec3(-17.0, 4.0, -41.0))


# -- matrices ---------------------------------------------------------------------------------------------------------


def filled(kind: Any, seed: int) -> Any:
    rows, row = (3, Vec3) if kind in (Mat3, Mat34) else (4, Quat)
    row = Vec3 if kind in (Mat3, Mat43) else Quat
    values = np.random.default_rng(seed).normal(size=(rows, len(row._fields)))
    return kind(*(row(*line) for line in values.tolist()))


# (left, right) → what the product is
PRODUCTS = [
    (Mat3, Mat3, Mat3),
    (Mat3, Mat34, Mat34),
    (Mat34, Mat43, Mat3),
    (Mat34, Mat4, Mat34),
    (Mat43, Mat3, Mat43),
    (Mat43, Mat34, Mat4),
    (Mat4, Mat4, Mat4),
    (Mat4, Mat43, Mat43),
]


@pytest.mark.parametrize(("left", "right", "product"), PRODUCTS)
def test_products_of_every_shape(left: Any, right: Any, product: Any) -> None:
    a, b = filled(left, 1), filled(right, 2)
    assert type(a @ b) is product
    close(a @ b, array(a) @ array(b))


@pytest.mark.parametrize(
    ("kind", "vector", "product"),
    [(Mat3, u_, Vec3), (Mat43, u_, Quat), (Mat34, p_, Vec3), (Mat4, p_, Quat)],
)
def test_products_with_vectors(kind: Any, vector: Any, product: Any) -> None:
    a = filled(kind, 3)
    assert type(a @ vector) is product
    close(a @ vector, array(a) @ array(vector))


@pytest.mark.parametrize(("kind", "turned"), [(Mat3, Mat3), (Mat34, Mat43), (Mat43, Mat34), (Mat4, Mat4)])
def test_transpose_and_scale(kind: Any, turned: Any) -> None:
    a = filled(kind, 4)
    assert type(transpose(a)) is turned
    close(transpose(a), array(a).T)
    assert type(-1.5 * a) is kind
    close(-1.5 * a, -1.5 * array(a))


@pytest.mark.parametrize("kind", [Mat3, Mat4])
def test_sums_of_square_matrices(kind: Any) -> None:
    a, b = filled(kind, 5), filled(kind, 6)
    close(a + b, array(a) + array(b))
    close(a - b, array(a) - array(b))


@for_all(st.lists(numbers, min_size=9, max_size=9))
def test_inverse_is_numpys(values: list[float]) -> None:
    m = np.reshape(values, (3, 3))
    assume(np.linalg.cond(m) < 1e3)
    found = plain(inverse)(Mat3(*(Vec3(*row) for row in m.tolist())))
    np.testing.assert_allclose(array(found), np.linalg.inv(m), rtol=1e-9, atol=1e-9 * np.abs(np.linalg.inv(m)).max())


def test_special_matrices() -> None:
    close(plain(outer)(p_, q_), np.outer(p_, q_))
    close(plain(diagonal)(1.0, 2.0, 3.0), np.diag([1.0, 2.0, 3.0]))
    close(I3, np.eye(3))
    close(I4, np.eye(4))


@compiled
def matrix_area(a: Mat3, b: Mat34, c: Mat43, d: Mat4, v: Vec3, q: Quat) -> Any:
    products = (b @ c, a @ b, b @ q, d @ c, c @ b, c @ v)  # each shape that three or four rows can make
    transposed = (transpose(a), transpose(b), transpose(c), transpose(d))
    sums = (a + I3, a - I3, d + I4, 2.0 * b, 2.0 * c)
    return products, transposed, sums, inverse(a), diagonal(1.0, 2.0, 3.0), outer(q, q), matrix(q)


def test_matrices_compiled_as_python() -> None:
    assert_compiled_as_python(matrix_area, *(filled(kind, 7) for kind in (Mat3, Mat34, Mat43, Mat4)), v_, q_)


# -- the matrices of the two-stage filter -----------------------------------------------------------------------------


@pytest.mark.parametrize(("jacobian", "direction"), [(up_matrix, up_in_body), (north_matrix, north_in_body)])
@for_all(q=unit_quats)
def test_observation_matrices_are_derivatives(jacobian: Any, direction: Any, q: Quat) -> None:
    h = plain(direction)
    H = array(plain(jacobian)(q))
    close(H @ array(q), 2.0 * array(h(q)))
    step = 1e-6
    for column, axis in enumerate(np.eye(4)):
        ahead, behind = (array(h(Quat(*(array(q) + sign * step * axis).tolist()))) for sign in (1.0, -1.0))
        close(H[:, column], (ahead - behind) / (2 * step), 1e-8)


@for_all(vectors, any_quats)
def test_rate_matrix_is_the_product_with_the_rate(w: Vec3, q: Quat) -> None:
    close(plain(rate_matrix)(w) @ q, q * Quat(0.0, *w), 1e-10)


@for_all(unit_quats)
def test_turns_about_earth_are_products_with_the_earths_axes(q: Quat) -> None:
    expected = [Quat(0.0, *axis) * q for axis in (EAST, NORTH, UP)]
    close(transpose(plain(turns_about_earth)(q)), expected)
    close(plain(heading_turn)(q), expected[2])


@for_all(unit_quats, long_vectors)
def test_levelled_puts_the_force_up_without_turning_about_up(q: Quat, acc: Vec3) -> None:
    force = plain(unit)(acc)
    assume(rotate(q, force).z > -0.99)
    found = plain(levelled)(q, acc)
    close(plain(rotate)(found, force), UP, 1e-9)
    close((found * plain(conjugate)(q)).z, 0.0, 1e-9)


@compiled
def observation_area(q: Quat, w: Vec3) -> Any:
    return up_matrix(q), north_matrix(q), rate_matrix(w), turns_about_earth(q), heading_turn(q), levelled(q, w)


def test_observation_matrices_compiled_as_python() -> None:
    assert_compiled_as_python(observation_area, Quat(sqrt(0.5), 0.5, -0.5, 0.0), v_)
