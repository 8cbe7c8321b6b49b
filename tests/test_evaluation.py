"""Evaluation: the benchmark's definition, worked out again from rotation matrices and angles."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from helpers import random_quats, rotation, wxyz
from poise.data.attitude import Attitude
from poise.data.recording import Recording
from poise.errors import RecordingError
from poise.evaluation import Errors, evaluate

N = 60
TIME = 0.1 * np.arange(N)
TRUTH, FOUND = random_quats(N, 1), random_quats(N, 2)


def attitude(quat: Any, time: Any = TIME, **facts: Any) -> Attitude:
    return Attitude.of(time, quat, **facts)


def recording(truth: Any = TRUTH, **facts: Any) -> Recording:
    zeros = np.zeros((len(truth), 3))
    return Recording(time=TIME[: len(truth)], gyr=zeros, acc=zeros, truth=attitude(truth, TIME[: len(truth)]), **facts)


def off_by(*turns: Rotation | Any) -> Errors:
    """The errors of an attitude that is off by these turns of the Earth frame."""
    error = Rotation.concatenate(turns)
    truth = TRUTH[: len(error)]
    return evaluate(attitude(wxyz(error * rotation(truth)), TIME[: len(error)]), recording(truth))


def test_errors_are_the_benchmarks() -> None:
    found = evaluate(attitude(FOUND), recording())
    error = rotation(FOUND) * rotation(TRUTH).inv()
    np.testing.assert_allclose(found.total, error.magnitude(), atol=1e-9)
    # inclination: how far the error takes up from up
    np.testing.assert_allclose(found.inclination, np.arccos(error.apply([0, 0, 1])[:, 2]), atol=1e-9)
    # heading: the turn about up that brings the attitude closest to the reference
    w, z = error.as_quat()[:, 3], error.as_quat()[:, 2]
    np.testing.assert_allclose(found.heading, 2 * np.arctan(np.abs(z / w)), atol=1e-9)
    up = np.array([0, 0, 1.0])
    left = [(Rotation.from_rotvec(sign * found.heading[:, None] * up) * error).magnitude() for sign in (-1, 1)]
    np.testing.assert_allclose(np.min(left, axis=0), found.inclination, atol=1e-7)


def test_signs_of_the_quaternions_do_not_matter() -> None:
    signs = np.random.default_rng(3).choice([-1.0, 1.0], (2, N, 1))
    found, again = (
        evaluate(attitude(FOUND), recording()),
        evaluate(attitude(signs[0] * FOUND), recording(signs[1] * TRUTH)),
    )
    for name in ("total", "heading", "inclination"):
        np.testing.assert_allclose(getattr(again, name), getattr(found, name), atol=1e-12)


def test_an_error_of_heading_only_and_of_inclination_only() -> None:
    degrees = np.array([10.0, -20, 179])
    heading = off_by(Rotation.from_euler("z", degrees[:, None], degrees=True))
    np.testing.assert_allclose(np.degrees(heading.heading), np.abs(degrees))
    np.testing.assert_allclose(heading.inclination, 0, atol=1e-7)
    inclination = off_by(Rotation.from_rotvec(np.radians(degrees)[:, None] * [0.6, 0.8, 0]))
    np.testing.assert_allclose(np.degrees(inclination.inclination), np.abs(degrees))
    np.testing.assert_allclose(inclination.heading, 0, atol=1e-7)
    for errors in (heading, inclination):
        np.testing.assert_allclose(np.degrees(errors.total), np.abs(degrees))


def test_no_error_is_zero_and_a_tiny_one_is_not_lost() -> None:
    assert evaluate(attitude(TRUTH), recording()).total.max() < 1e-15
    assert off_by(Rotation.from_rotvec([[0, 0, 1e-9]])).total[0] == pytest.approx(1e-9, rel=1e-6)


@pytest.mark.parametrize("frame", ["ned", "nwu"])
def test_frames_are_brought_together(frame: Any) -> None:
    one, other = evaluate(attitude(FOUND), recording()), evaluate(attitude(FOUND).to(frame), recording())
    np.testing.assert_allclose(other.heading, one.heading, atol=1e-9)
    np.testing.assert_allclose(other.inclination, one.inclination, atol=1e-9)


def test_only_moving_rows_with_a_reference_count() -> None:
    truth, found = TRUTH.copy(), FOUND.copy()
    truth[10:20] = np.nan
    found[15:25] = np.nan
    moving = np.arange(N) < 40
    errors = evaluate(attitude(found), recording(truth, moving=moving))
    counts = moving & np.isfinite(truth[:, 0]) & np.isfinite(found[:, 0])
    np.testing.assert_array_equal(errors.counted, counts)
    assert errors.missing == 5  # rows 20 to 24
    assert np.isnan(errors.total[10:25]).all()
    error = (rotation(found[counts]) * rotation(truth[counts]).inv()).magnitude()
    assert errors.rmse_deg().total == pytest.approx(np.degrees(np.sqrt(np.mean(error**2))))
    assert len(errors.total) == N and np.isfinite(errors.total[40:]).all()


def test_figures_of_known_errors() -> None:
    errors = off_by(*(Rotation.from_euler("z", [[angle]], degrees=True) for angle in (0, 3, 4, 5)))
    rmse = np.sqrt((9 + 16 + 25) / 4)
    assert errors.rmse_deg().heading == pytest.approx(rmse)
    assert errors.rmse_deg().inclination == pytest.approx(0, abs=1e-6)
    table = errors.table()
    assert set(table) == {"total", "heading", "inclination"}
    expected = {"rmse": rmse, "mean": 3, "median": 3.5, "p95": np.percentile([0, 3, 4, 5], 95), "max": 5}
    assert table["heading"] == pytest.approx(expected)


def test_nothing_to_count_gives_no_figures() -> None:
    errors = evaluate(attitude(FOUND), recording(moving=np.zeros(N, bool)))
    assert np.isnan(errors.rmse_deg()).all()
    assert errors.table() == {}
    empty = evaluate(attitude(FOUND)[:0], recording()[:0])
    assert np.isnan(empty.rmse_deg()).all() and not empty.diverged and empty.missing == 0


def errors_of(total_deg: Any, time: Any) -> Errors:
    turns = Rotation.from_euler("x", np.array(total_deg, float)[:, None], degrees=True)
    return evaluate(attitude(wxyz(turns), time), attitude(np.tile([1.0, 0, 0, 0], (len(total_deg), 1)), time))


@pytest.mark.parametrize(
    ("angle", "seconds", "expected"), [(91, 5.0, True), (91, 4.9, False), (89, 20.0, False), (180, 60.0, True)]
)
def test_diverged_is_above_a_right_angle_for_five_seconds(angle: float, seconds: float, expected: bool) -> None:
    time = np.arange(0, seconds + 4.05, 0.1)
    high = (time > 1.95) & (time < seconds + 2.05)
    assert errors_of(np.where(high, angle, 10), time).diverged is expected
    assert errors_of(np.where(high, angle, 10), time).total.max() == pytest.approx(np.radians(angle))


def test_two_short_excursions_are_no_divergence() -> None:
    time = np.arange(0, 10, 0.1)
    angle = np.where(np.abs(time - 5) < 0.35, 10, 120)
    assert not errors_of(angle, time).diverged
    errors = errors_of(np.full(100, 120), time)
    assert errors.diverged
    errors.total[50] = np.nan
    assert not errors.diverged


def test_rows_without_a_stamp_do_not_hide_divergence() -> None:
    time = np.arange(0, 10, 0.1)
    time[[0, 40, 99]] = np.nan
    assert errors_of(np.full(100, 120), time).diverged
    assert not errors_of(np.full(100, 120), np.full(100, np.nan)).diverged


def test_a_reference_of_its_own_times_is_resampled() -> None:
    fine = np.arange(0, 5, 0.01)
    path = Rotation.from_rotvec(np.sin(fine)[:, None] * [0.3, 0.5, 0.8])
    reference = attitude(wxyz(path), fine)
    at = np.arange(-0.5, 6, 0.0333)
    inside = (at >= 0) & (at <= fine[-1])
    exact = wxyz(Rotation.from_rotvec(np.sin(at)[:, None] * [0.3, 0.5, 0.8]))
    errors = evaluate(attitude(exact, at), reference)
    np.testing.assert_array_equal(errors.counted, inside)
    assert errors.total[inside].max() < 2e-5
    assert errors.missing == 0
    np.testing.assert_array_equal(errors.time, at)


def test_the_recordings_reference_is_found_for_an_attitude_of_other_rows() -> None:
    errors = evaluate(attitude(FOUND)[::2], recording())
    np.testing.assert_allclose(errors.total, evaluate(attitude(FOUND), recording()).total[::2], atol=1e-9)


def test_same_rows_are_compared_row_by_row_even_with_bad_stamps() -> None:
    time = TIME.copy()
    time[5], time[20] = np.nan, time[19]
    errors = evaluate(attitude(FOUND, time), attitude(TRUTH, time))
    assert errors.counted.all()


def test_what_cannot_be_evaluated_is_refused() -> None:
    bare = dataclasses.replace(recording(), truth=None)
    with pytest.raises(RecordingError, match="no reference to evaluate against"):
        evaluate(attitude(FOUND), bare)
    with pytest.raises(RecordingError, match="relative to another body"):
        evaluate(attitude(FOUND).relative_to(attitude(TRUTH)), recording())


def test_moving_rows_are_found_by_their_time() -> None:
    """An attitude on other rows than the recording's is compared where the recording moves."""
    time = np.arange(0.0, 200.0, 0.1)
    truth = Attitude.of(time, np.tile([1.0, 0, 0, 0], (len(time), 1)))
    still = np.zeros((len(time), 3))
    recording = Recording(time, still, still + np.array([0, 0, 9.8]), truth=truth, moving=(time >= 100) & (time < 120))
    for rows in (slice(None, None, 2), slice(200, None)):
        errors = evaluate(truth[rows], recording)
        counted = errors.time[errors.counted]
        assert counted.min() == pytest.approx(100.0, abs=0.1)
        assert counted.max() == pytest.approx(120.0, abs=0.2)
