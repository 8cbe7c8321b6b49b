"""Recording: takes arrays as they come, refuses what cannot be right by name, merges sensors, turns axes."""

from __future__ import annotations

import dataclasses
import pickle
from typing import Any

import numpy as np
import pytest

from helpers import assert_same_attitude, random_quats, rotation
from poise.data.attitude import COLUMNS, Attitude
from poise.data.recording import Recording
from poise.errors import PoiseError, RecordingError

N = 20
TIME = 0.01 * np.arange(N)
RNG = np.random.default_rng(0)
GYR, ACC, MAG = RNG.normal(size=(3, N, 3))
SENSORS = ("gyr", "acc", "mag")


def made(**change: Any) -> Recording:
    return Recording(**{"time": TIME, "gyr": GYR, "acc": ACC, "mag": MAG} | change)


def with_truth(**change: Any) -> Recording:
    """A recording with a reference that has a number in every column."""
    table = np.random.default_rng(1).uniform(0.1, 1.0, (N, COLUMNS))
    table[:, :4] = random_quats(N)
    return made(truth=Attitude(TIME, table, np.zeros(N, np.uint32)), moving=np.arange(N) % 2 == 0, **change)


# -- what is taken ----------------------------------------------------------------------------------------------------


def strided(values: np.ndarray) -> np.ndarray:
    return np.repeat(values, 2, axis=0)[::2]


def read_only(values: np.ndarray) -> np.ndarray:
    copy = values.copy()
    copy.setflags(write=False)
    return copy


@pytest.mark.parametrize(
    "form",
    [np.ndarray.tolist, strided, read_only, np.asfortranarray, lambda v: v.astype(">f8"), lambda v: v.astype(object)],
)
def test_arrays_of_any_form_become_the_same_recording(form: Any) -> None:
    found = Recording(time=form(TIME), gyr=form(GYR), acc=form(ACC), mag=form(MAG))
    for name in ("time", *SENSORS):
        values = getattr(found, name)
        np.testing.assert_array_equal(values, getattr(made(), name))
        assert values.dtype == np.float64 and values.flags.c_contiguous and values.flags.writeable


@pytest.mark.parametrize("dtype", [np.float32, np.float16, np.int16, np.int64, np.uint8, bool])
def test_numbers_of_any_type_become_float64(dtype: Any) -> None:
    values = np.arange(N * 3).reshape(N, 3).astype(dtype)
    found = made(acc=values).acc
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, values)


def test_inputs_are_copied_and_never_written() -> None:
    time, gyr, moving = TIME.copy(), GYR.copy(), np.zeros(N, bool)
    found = made(time=time, gyr=gyr, moving=moving)
    found.time[:], found.gyr[:], found.moving[:] = -1.0, -1.0, True  # type: ignore[index]
    np.testing.assert_array_equal(time, TIME)
    np.testing.assert_array_equal(gyr, GYR)
    assert not moving.any()


def test_none_and_masks_are_missing_samples() -> None:
    holes = GYR.tolist()
    holes[3] = [None, 1.0, 2.0]
    np.testing.assert_array_equal(made(gyr=holes).gyr[3], [np.nan, 1, 2])
    mask = np.zeros((N, 3), bool)
    mask[5, 1] = True
    for values in (ACC, np.ones((N, 3), int)):
        found = made(acc=np.ma.masked_array(values, mask)).acc
        np.testing.assert_array_equal(np.isnan(found), mask)


def test_absent_sensors_and_ages_have_their_defaults() -> None:
    found = Recording(time=TIME, gyr=GYR, acc=ACC)
    assert found.mag.shape == (N, 3) and np.isnan(found.mag).all()
    np.testing.assert_array_equal(found.acc_age, np.zeros(N))
    np.testing.assert_array_equal(found.mag_age, np.zeros(N))
    assert not found.has_mag
    assert found.truth is None and found.moving is None
    assert made().has_mag
    assert not made(mag=np.zeros((N, 3))).has_mag


@pytest.mark.parametrize("n", [0, 1, 2])
def test_very_short_recordings(n: int) -> None:
    found = Recording(time=TIME[:n].tolist(), gyr=GYR[:n].tolist(), acc=ACC[:n].tolist())
    assert len(found) == n
    assert found.gyr.shape == found.mag.shape == (n, 3)
    assert np.isnan(found.rate_hz) == (n < 2)
    assert found.duration == (0.01 if n == 2 else 0.0)
    assert f"{n} rows" in repr(found)
    assert len(found[:0]) == 0
    assert found.remap("y -x z").gyr.shape == (n, 3)


def test_at_rate_makes_the_stamps() -> None:
    found = Recording.at_rate(50, GYR, ACC, name="chair")
    np.testing.assert_allclose(found.time, np.arange(N) / 50)
    assert found.rate_hz == pytest.approx(50)
    assert found.duration == pytest.approx((N - 1) / 50)
    assert found.name == "chair"
    assert len(Recording.at_rate(100, [], [])) == 0


def test_rate_is_the_median_and_survives_bad_stamps() -> None:
    time = TIME.copy()
    time[3], time[10:] = np.nan, time[10:] + 5.0
    time[15] = time[14]
    assert made(time=time).rate_hz == pytest.approx(100)
    assert made(time=time).duration == pytest.approx(5.19)


# -- what is refused --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"gyr": GYR[1:]}, r"gyr: expected shape \(20, 3\) to go with 20 time stamps, found \(19, 3\)"),
        ({"acc": ACC[:, :2]}, r"acc: expected shape \(20, 3\) .*, found \(20, 2\)"),
        ({"mag": MAG.T}, r"mag: expected shape \(20, 3\) .*, found \(3, 20\); transpose it"),
        ({"gyr": 1.0}, r"gyr: expected shape \(20, 3\) .*, found \(\)"),
        ({"gyr": []}, r"gyr: expected shape \(20, 3\) .*, found \(0,\)"),
        ({"mag_age": np.zeros(3)}, r"mag_age: expected shape \(20,\) .*, found \(3,\)"),
        ({"moving": [True]}, r"moving: expected shape \(20,\) .*, found \(1,\)"),
        ({"time": TIME[:, None]}, r"time: expected \(n,\) seconds, found shape \(20, 1\)"),
        ({"time": 3.0}, r"time: expected \(n,\) seconds, found shape \(\)"),
        ({"gyr": [["a", "b", "c"]] * N}, "gyr: expected numbers, found something else"),
        ({"gyr": GYR.astype(complex)}, "gyr: expected numbers, found something else .*complex"),
        ({"gyr": [[1.0, 2.0], [3.0]]}, "gyr: expected numbers"),
        ({"time": np.arange(N).astype("datetime64[ms]")}, "time: expected numbers, found something else .*datetime64"),
        ({"truth": Attitude.of(TIME[1:], random_quats(N - 1))}, "truth: expected 20 rows like time, found 19"),
        ({"truth": random_quats(N)}, "truth: expected .*Attitude"),
        ({"gravity": 0.01}, "gravity: expected m/s², about 9.8 on Earth, found 0.01"),
        ({"gravity": -9.81}, "gravity: expected m/s²"),
        ({"gravity": float("nan")}, "gravity: expected m/s²"),
    ],
)
def test_what_does_not_fit_is_refused_by_name(change: dict[str, Any], message: str) -> None:
    with pytest.raises(RecordingError, match=message) as caught:
        made(**change)
    assert isinstance(caught.value, PoiseError) and isinstance(caught.value, ValueError)


@pytest.mark.parametrize("rate", [10.0, 50.0, 100.0, 286.0, 1000.0])
@pytest.mark.parametrize(("factor", "unit"), [(1e-3, "milliseconds"), (1e-6, "microseconds"), (1e-9, "nanoseconds")])
def test_stamps_in_another_unit_are_refused_with_the_factor(rate: float, factor: float, unit: str) -> None:
    stamps = (1e3 + np.arange(N) / rate) / factor
    message = rf"stamps in {unit}\? Multiply them by {factor:g} .*{rate:.1f} samples per second"
    with pytest.raises(RecordingError, match=message):
        made(time=stamps)


def test_slow_and_epoch_stamps_in_seconds_are_taken() -> None:
    assert made(time=0.4 * np.arange(N)).rate_hz == pytest.approx(2.5)
    assert made(time=1.7e9 + TIME).rate_hz == pytest.approx(100, rel=1e-3)


@pytest.mark.parametrize("rate", [0, -100, float("nan"), float("inf")])
def test_at_rate_refuses_what_is_no_rate(rate: float) -> None:
    with pytest.raises(RecordingError, match="rate: expected samples per second"):
        Recording.at_rate(rate, GYR, ACC)


def test_fields_are_frozen() -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        made().gyr = GYR  # type: ignore[misc]


# -- parts, copies, axes ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rows", [slice(2, 9), slice(None, None, 3), np.arange(N) > 11, [4, 5, 19], 7])
def test_slicing_cuts_everything_alike(rows: Any) -> None:
    whole = with_truth(acc_age=TIME, mag_age=2 * TIME, name="chair", gravity=9.7)
    part = whole[rows]
    chosen = np.atleast_1d(np.arange(N)[rows])
    for name in ("time", *SENSORS, "acc_age", "mag_age", "moving"):
        np.testing.assert_array_equal(getattr(part, name), getattr(whole, name)[chosen])
    assert part.truth is not None and whole.truth is not None
    np.testing.assert_array_equal(part.truth.table, whole.truth.table[chosen])
    np.testing.assert_array_equal(part.truth.time, part.time)
    assert (part.name, part.gravity) == ("chair", 9.7)


@pytest.mark.parametrize("rows", [slice(None, None, 100), [0, 400, 999]])
def test_few_rows_of_a_long_recording_are_not_taken_for_another_unit(rows: Any) -> None:
    whole = Recording.at_rate(100, np.zeros((1000, 3)), np.zeros((1000, 3)))
    np.testing.assert_array_equal(whole[rows].time, whole.time[rows])


def test_between_takes_start_and_leaves_end() -> None:
    np.testing.assert_allclose(made().between(0.05, 0.08).time, [0.05, 0.06, 0.07])


def test_pickle_brings_it_back() -> None:
    whole = with_truth(name="chair", notes=("two sensors",))
    back = pickle.loads(pickle.dumps(whole))
    for name in ("time", *SENSORS, "moving"):
        np.testing.assert_array_equal(getattr(back, name), getattr(whole, name))
    np.testing.assert_array_equal(back.truth.table, whole.truth.table)  # type: ignore[union-attr]
    assert (back.name, back.notes) == ("chair", ("two sensors",))


def test_repr_says_what_is_inside() -> None:
    assert repr(with_truth(name="chair")) == "Recording(chair: 20 rows, 0.2 s at 100.0 Hz, gyr acc mag, truth)"
    assert repr(Recording(time=TIME, gyr=GYR, acc=ACC)) == "Recording(unnamed: 20 rows, 0.2 s at 100.0 Hz, gyr acc)"


def test_remap_renames_the_axes_of_every_sensor() -> None:
    found = made().remap("y -x z")
    for name in SENSORS:
        old = getattr(made(), name)
        np.testing.assert_array_equal(getattr(found, name), np.column_stack([old[:, 1], -old[:, 0], old[:, 2]]))
    np.testing.assert_array_equal(made().remap("Y, -X, +Z").gyr, found.gyr)


@pytest.mark.parametrize("axes", ["y -x z", "-z -y -x", [[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]]])
def test_the_reference_follows_remap(axes: Any) -> None:
    before = with_truth()
    after = before.remap(axes)
    assert before.truth is not None and after.truth is not None
    q_before, q_after = rotation(before.truth.quat), rotation(after.truth.quat)
    np.testing.assert_allclose(q_after.apply(after.acc), q_before.apply(before.acc), atol=1e-12)
    np.testing.assert_allclose(q_after.apply(after.truth.rate), q_before.apply(before.truth.rate), atol=1e-12)
    np.testing.assert_allclose(q_after.apply(after.truth.bias), q_before.apply(before.truth.bias), atol=1e-12)
    np.testing.assert_array_equal(after.truth.sigma, before.truth.sigma)  # about the Earth's axes: stays
    same = before.truth.to("enu", body=axes)
    assert_same_attitude(after.truth.quat, same.quat)
    np.testing.assert_allclose(after.truth.bias_sigma, same.bias_sigma)


def test_remap_and_back_is_the_same() -> None:
    back = with_truth().remap("y -x z").remap("-y x z")
    np.testing.assert_array_equal(back.acc, ACC)
    assert_same_attitude(back.truth.quat, with_truth().truth.quat)  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("axes", "message"),
    [
        ("x y -z", "left-handed.*flip one sign"),
        (np.diag([1.0, 1, -1]), "left-handed"),
        ("x x z", "each of x, y, z must appear once"),
        ("x y", "not understood; expected three signed axes"),
        ("x y w", "not understood"),
        ("x y z z", "not understood"),
        (2 * np.eye(3), "not a rotation"),
        (np.eye(4), r"\(3, 3\) matrix, not \(4, 4\)"),
    ],
)
def test_remap_refuses_what_no_mounting_can_be(axes: Any, message: str) -> None:
    with pytest.raises(RecordingError, match=message):
        made().remap(axes)


# -- sensors with clocks of their own ---------------------------------------------------------------------------------


def test_from_sensors_puts_each_sample_into_the_first_row_at_or_after_its_stamp() -> None:
    stamps = np.array([0.0, 0.013, 0.0299, 0.03, 0.19])
    values = RNG.normal(size=(5, 3))
    found = Recording.from_sensors((TIME, GYR), (TIME, ACC), (stamps, values))
    rows = np.flatnonzero(np.isfinite(found.mag).all(axis=1))
    np.testing.assert_array_equal(rows, [0, 2, 3, 19])
    np.testing.assert_allclose(found.mag[[0, 2, 19]], values[[0, 1, 4]])
    np.testing.assert_allclose(found.mag_age[[0, 2, 19]], [0, 0.007, 0], atol=1e-12)
    np.testing.assert_allclose(found.mag[3], values[2:4].mean(axis=0))  # two meet in one row
    np.testing.assert_allclose(found.mag_age[3], 0.00005)
    assert (found.mag_age[~np.isin(np.arange(N), rows)] == 0).all()
    np.testing.assert_array_equal(found.acc, ACC)


def test_from_sensors_uses_every_sample_exactly_once_and_never_early() -> None:
    rng = np.random.default_rng(2)
    time = np.cumsum(rng.uniform(0.001, 0.01, 500))
    stamps = np.sort(rng.uniform(0, time[-1], 60))
    values = np.eye(60)[:, :3] + np.arange(60)[:, None]
    found = Recording.from_sensors((time, np.zeros((500, 3))), (time, np.zeros((500, 3))), (stamps, values))
    expected: dict[int, list[int]] = {}
    for i, stamp in enumerate(stamps):
        expected.setdefault(int(np.argmax(time >= stamp)), []).append(i)
    for row in range(500):
        if row in expected:
            np.testing.assert_allclose(found.mag[row], values[expected[row]].mean(axis=0))
            assert found.mag_age[row] == pytest.approx(time[row] - stamps[expected[row]].mean(), abs=1e-12)
        else:
            assert np.isnan(found.mag[row]).all() and found.mag_age[row] == 0


def test_from_sensors_leaves_out_what_it_cannot_place() -> None:
    stamps = [0.05, np.nan, 0.07, 9.0]
    values = np.array([[1.0, 1, 1], [2, 2, 2], [3, np.nan, 3], [4, 4, 4]])
    found = Recording.from_sensors((TIME, GYR), (stamps, values))
    assert np.flatnonzero(np.isfinite(found.acc).any(axis=1)).tolist() == [5]
    assert not found.has_mag


@pytest.mark.parametrize("stamp", [TIME[3], TIME[0], np.nan])
def test_from_sensors_needs_rising_stamps_of_the_gyroscope_and_names_the_row(stamp: float) -> None:
    time = TIME.copy()
    time[4] = stamp
    with pytest.raises(RecordingError, match=r"in row 4 after .* packet"):
        Recording.from_sensors((time, GYR), (TIME, ACC))


def test_from_sensors_takes_stamps_in_any_order_and_sensors_without_samples() -> None:
    found = Recording.from_sensors((TIME, GYR), (TIME[::-1], ACC[::-1]), ([], []), name="chair")
    np.testing.assert_array_equal(found.acc, ACC)
    assert np.isnan(found.mag).all()
    assert found.name == "chair"
    assert len(Recording.from_sensors(([], []), (TIME, ACC))) == 0


@pytest.mark.parametrize(
    ("gyr", "acc", "message"),
    [
        ((TIME[::-1], GYR), (TIME, ACC), "gyr time: must rise"),
        ((np.zeros(N), GYR), (TIME, ACC), "gyr time: must rise"),
        ((TIME, GYR[1:]), (TIME, ACC), r"gyr: expected shape \(20, 3\)"),
        ((TIME, GYR), (TIME[1:], ACC), r"acc: expected shape \(19, 3\) .*, found \(20, 3\)"),
        ((TIME, GYR), (TIME[:, None], ACC), r"acc time: expected \(n,\) seconds, found shape \(20, 1\)"),
        ((TIME, GYR), (0.0, ACC), r"acc time: expected \(n,\) seconds, found shape \(\)"),
        ((TIME, GYR), (["a"] * N, ACC), "acc time: expected numbers"),
    ],
)
def test_from_sensors_refuses_what_does_not_fit(gyr: Any, acc: Any, message: str) -> None:
    with pytest.raises(RecordingError, match=message):
        Recording.from_sensors(gyr, acc)
