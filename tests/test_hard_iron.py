"""A magnetometer that was never calibrated: what the field's length tells the flagship of its hard iron."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

import poise
from data_files import data_path
from helpers import angle_between, plain
from irons import FLAGSHIP, IRON, NEVER, WHITE, calibrated, degrees, second_half, with_iron
from poise.data.flags import Flag
from poise.data.packet import Packet
from poise.estimators.self_calibrating.iron import Shown, forget_lengths, shown_by
from poise.estimators.self_calibrating.learned import iron_from_before
from poise.estimators.self_calibrating.lengths import add_length, add_turn, fit_of_lengths, take_lengths
from poise.estimators.self_calibrating.model import COLUMNS, NOTHING, ROWS, begin_block, sensor_of
from poise.estimators.self_calibrating.turns import fit_of_turns
from poise.estimators.wrapping import innermost
from poise.math.matrices import I3
from poise.math.vectors import ZERO, Vec3
from poise.simulation import measure, robot

Floats = NDArray[np.float64]


@pytest.mark.parametrize("seed", [4, 5, 6])
def test_the_heading_is_right_once_the_sensor_has_turned(seed: int) -> None:
    recording = with_iron(calibrated(seed))
    attitude = poise.estimate(FLAGSHIP, recording)
    late = second_half(recording)
    assert degrees(attitude, recording, late) < 1.5
    assert degrees(poise.estimate(NEVER, recording), recording, late) > 10.0
    assert attitude.learned is not None
    found, sigma = np.array(attitude.learned["hard_iron"]["value"]), np.array(attitude.learned["hard_iron"]["sigma"])
    assert np.linalg.norm(found - IRON) < 2.0
    assert (np.abs(found - IRON) < 4.0 * sigma).all()


def test_the_jump_of_the_heading_is_published() -> None:
    recording = with_iron(calibrated(), (0.0, -80.0, 0.0))
    attitude = poise.estimate(FLAGSHIP, recording)
    (reset,) = attitude.resets()
    assert np.flatnonzero(attitude.flags & np.uint32(Flag.HARD_IRON)).tolist() == [reset.row]
    before, after = attitude.quat[reset.row - 1], attitude.quat[reset.row]
    assert np.degrees(angle_between(before, after)) > 20.0
    east, north, up = np.degrees(reset.delta)
    assert abs(up) > 20.0 and np.hypot(east, north) < 5.0
    assert attitude.valid[reset.row :].all()
    assert degrees(attitude, recording, second_half(recording)) < 1.5
    stream = poise.Stream(FLAGSHIP)
    for row in range(reset.row + 1):
        stream.update(Packet(recording.time[row], recording.gyr[row], recording.acc[row], recording.mag[row]))  # type: ignore[index]
    assert stream.resets == 1 and stream.reset_time == recording.time[reset.row]
    np.testing.assert_allclose(np.degrees(stream.reset_delta), (east, north, up), atol=1.0)


@pytest.mark.parametrize("seed", [4, 5, 6])
def test_backwards_it_is_there_from_the_start_on(seed: int) -> None:
    recording = with_iron(calibrated(seed))
    attitude = poise.smooth(recording)
    assert degrees(attitude, recording) < 1.0
    assert not attitude.resets()
    assert attitude.provenance is not None and attitude.provenance.method == "SelfCalibrating, smoothed"
    assert degrees(poise.smooth(recording, NEVER), recording) > 10.0


@pytest.mark.parametrize("iron", [IRON, (0.0, -80.0, 0.0), (200.0, 0.0, 50.0)])
def test_backwards_a_magnet_that_came_later_was_not_there_before(iron: tuple[float, float, float]) -> None:
    recording = with_iron(calibrated(), iron, since=0.5)
    first = slice(0, len(recording) // 2 - 500)
    assert degrees(poise.smooth(recording), recording, first) < 1.0


def test_a_robot_that_only_turns_about_up() -> None:
    recording = with_iron(measure(robot(120.0, 100.0, 2), WHITE, seed=1), (20.0, 10.0, 0.0))
    late = second_half(recording)
    assert degrees(poise.estimate(FLAGSHIP, recording), recording, late) < 2.0
    assert degrees(poise.estimate(NEVER, recording), recording, late) > 10.0


def test_a_magnetometer_without_iron_is_left_alone() -> None:
    recording = calibrated()
    attitude, alone = poise.estimate(FLAGSHIP, recording), poise.estimate(NEVER, recording)
    np.testing.assert_array_equal(attitude.table, alone.table)
    np.testing.assert_array_equal(attitude.flags & ~np.uint32(Flag.HEADING_UNPROVEN), alone.flags)


def test_a_sensor_that_lies_still_shows_none() -> None:
    """Whatever the noise, any iron would explain it."""
    rng = np.random.default_rng(3)
    time = np.arange(6000) / 50.0
    gyr, acc = 1e-4 * rng.normal(size=(6000, 3)), np.tile([0.0, 0.0, 9.81], (6000, 1))
    for noise in (0.0, 0.1, 1.0, 5.0):
        mag = np.array([30.0, 40.0, -20.0]) + noise * rng.normal(size=(6000, 3))
        recording = poise.Recording(time, gyr, acc, mag)
        shown, alone = poise.estimate(FLAGSHIP, recording), poise.estimate(NEVER, recording)
        np.testing.assert_array_equal(shown.table, alone.table)


@pytest.mark.parametrize("seconds", [0.0, 3.0])
@pytest.mark.parametrize("strength", [5.0, 20.0, 80.0])
def test_a_magnet_that_comes_while_the_sensor_lies_still_is_none_on_it(strength: float, seconds: float) -> None:
    """Two clusters are a straight line, and so is a ramp: any iron explains them, but nothing has turned."""
    rng = np.random.default_rng(int(strength))
    time = np.arange(9000) / 100.0
    direction = rng.normal(size=3)
    come = np.clip((time - 30.0) / max(seconds, 1e-9), 0.0, 1.0)
    mag = np.array([0.0, 20.0, -45.0]) + strength * np.outer(come, direction / np.linalg.norm(direction))
    gyr, acc = 1e-4 * rng.normal(size=(9000, 3)), np.tile([0.0, 0.0, 9.81], (9000, 1))
    recording = poise.Recording(time, gyr, acc, mag + 0.05 * rng.normal(size=(9000, 3)))
    found, alone = poise.estimate(FLAGSHIP, recording), poise.estimate(NEVER, recording)
    np.testing.assert_array_equal(found.table, alone.table)


@pytest.mark.parametrize("iron", [(10.0, 0.0, 0.0), (24.0, -20.0, 25.0), (0.0, -80.0, 0.0)])
def test_a_magnet_that_came_before_the_motion_has_not_turned_the_heading(iron: tuple[float, float, float]) -> None:
    recording = calibrated()
    assert recording.mag is not None and recording.truth is not None
    rest = 3000
    rows = np.maximum(np.arange(len(recording) + rest) - rest, 0)
    time = np.arange(len(rows)) / 100.0
    still = (np.arange(len(rows)) < rest)[:, None]
    mag = recording.mag[rows] + np.outer(time > 10.0, iron)
    made = poise.Recording(time, np.where(still, 0.0, recording.gyr[rows]), recording.acc[rows], mag)
    attitude = poise.estimate(FLAGSHIP, made)
    truth = recording.truth.quat[rows]
    assert np.degrees(angle_between(attitude.quat, truth)).max() < 5.0


@pytest.mark.parametrize("up", [-30.0, 0.0, 20.0, 60.0])
def test_iron_along_an_axis_that_did_not_turn_has_an_honest_sigma(up: float) -> None:
    recording = with_iron(measure(robot(120.0, 100.0, 2), WHITE, seed=1), (20.0, 10.0, up))
    attitude = poise.estimate(FLAGSHIP, recording)
    assert degrees(attitude, recording, second_half(recording)) < 4.0
    assert attitude.learned is not None
    found, sigma = np.array(attitude.learned["hard_iron"]["value"]), np.array(attitude.learned["hard_iron"]["sigma"])
    assert (np.abs(found - (20.0, 10.0, up)) < 3.0 * sigma).all()


@pytest.mark.parametrize("strength", [200.0, 600.0])
def test_iron_of_many_times_the_field(strength: float) -> None:
    recording = with_iron(calibrated(), (strength, 0.0, 0.0))
    attitude = poise.estimate(FLAGSHIP, recording)
    assert degrees(attitude, recording, second_half(recording)) < 1.5
    assert degrees(poise.estimate(FLAGSHIP, recording, start_from=attitude), recording, slice(0, 3000)) < 1.5


def test_with_a_slow_accelerometer_it_is_published_once() -> None:
    recording = with_iron(calibrated(), (0.0, -80.0, 0.0))
    slow = np.where((np.arange(len(recording)) % 8 == 0)[:, None], recording.acc, np.nan)
    attitude = poise.estimate(FLAGSHIP, replace(recording, acc=slow))
    assert len(attitude.resets()) == 1


def test_backwards_beside_a_magnetometer_that_breaks() -> None:
    recording = with_iron(calibrated(), (0.0, -80.0, 0.0))
    assert recording.mag is not None
    mag = recording.mag.copy()
    mag[6000:6008] *= 1000.0
    mag[6008:] = 0.0
    attitude = poise.smooth(replace(recording, mag=mag))
    assert np.isfinite(attitude.quat).all()


def test_progress_does_not_fall_back() -> None:
    seen: list[int] = []
    poise.smooth(with_iron(calibrated()), progress=seen.append)
    assert seen == sorted(seen) and seen[-1] == len(calibrated())


def test_a_restart_knows_of_it() -> None:
    recording = with_iron(calibrated())
    gap = (recording.time > 60.0) & (recording.time < 65.0)
    cut = recording[~gap]
    attitude = poise.estimate(FLAGSHIP, cut)
    again = [reset.row for reset in attitude.resets() if reset.time > 60.0][-1]
    as_calibrated = poise.estimate(FLAGSHIP, calibrated()[~gap])
    assert again < np.searchsorted(cut.time, 68.5)  # 3 s after the gap, and a block
    assert np.degrees(angle_between(attitude.quat[again:], as_calibrated.quat[again:])).max() < 5.0


def test_a_magnetometer_that_comes_later_has_it_from_its_first_sample_on() -> None:
    recording = with_iron(calibrated())
    assert recording.mag is not None
    late = replace(recording, mag=np.where((recording.time < 40.0)[:, None], np.nan, recording.mag))
    there = slice(int(np.searchsorted(recording.time, 41.1)), None)
    assert degrees(poise.smooth(late), late, there) < 1.0


def test_it_is_carried_to_the_next_recording_of_the_sensor() -> None:
    first, second = with_iron(calibrated(4)), with_iron(calibrated(5))
    before = poise.estimate(FLAGSHIP, first)
    early = slice(0, 3000)
    warm, cold = (poise.estimate(FLAGSHIP, second, start_from=start) for start in (before, None))
    assert degrees(warm, second, early) < 1.0 and not warm.resets()
    assert degrees(cold, second, early) > 10.0


@pytest.mark.parametrize("strength", [20.0, 80.0])
@pytest.mark.parametrize("number", ["05", "09", "21"])
def test_real_trials_beside_iron_are_as_without(number: str, strength: float) -> None:
    recording = poise.read(next(data_path("broad").glob(f"{number}_*.mat")))
    assert recording.moving is not None
    iron = strength * np.array([0.48, -0.6, 0.64])
    beside = with_iron(recording, (iron[0], iron[1], iron[2]))
    late = replace(recording, moving=recording.moving & (recording.time > recording.time[0] + 0.5 * recording.duration))
    clean, attitude = poise.estimate(FLAGSHIP, recording), poise.estimate(FLAGSHIP, beside)
    assert poise.evaluate(attitude, late).rmse_deg().total < poise.evaluate(clean, late).rmse_deg().total + 0.5
    clean, attitude = poise.smooth(recording), poise.smooth(beside)
    assert (
        poise.evaluate(attitude, recording).rmse_deg().total < poise.evaluate(clean, recording).rmse_deg().total + 0.7
    )


@pytest.mark.parametrize("number", ["01", "03", "05", "07", "09", "11", "15", "21", "25", "27", "29", "31", "33", "35"])
def test_no_calibrated_trial_is_taken_for_one_that_is_not(number: str) -> None:
    """Magnets that come, stand by or are attached among them."""
    recording = poise.read(next(data_path("broad").glob(f"{number}_*.mat")))
    attitude, alone = poise.estimate(FLAGSHIP, recording), poise.estimate(NEVER, recording)
    np.testing.assert_array_equal(attitude.table, alone.table)


def test_what_the_turns_of_a_trial_show_is_what_the_reference_does() -> None:
    """Field = c + R b over a minute of the motion, R by the optical reference: 1.8 µT, just below what is taken over."""
    recording = poise.read(next(data_path("broad").glob("03_*.mat")))
    assert recording.truth is not None and recording.mag is not None
    rows = (recording.time > 60.0) & (recording.time < 120.0) & np.isfinite(recording.truth.quat).all(axis=1)
    R = Rotation.from_quat(np.roll(recording.truth.quat[rows], -1, axis=1)).as_matrix()
    field = np.einsum("nij,nj->ni", R, recording.mag[rows])
    system = np.concatenate([np.hstack([np.eye(3), r]) for r in R[::20]])
    expected = np.linalg.lstsq(system, field[::20].ravel(), rcond=None)[0][3:]
    stream = poise.Stream(FLAGSHIP)
    part = recording[recording.time < 72.0]
    stream.update(Packet(part.time, part.gyr, part.acc, part.mag))
    P = innermost(stream.running_state).P
    known = sensor_of(P)
    shown = known.length * np.array(fit_of_turns(FLAGSHIP, P, known.iron).iron)
    assert np.linalg.norm(expected) > 1.5
    assert np.linalg.norm(shown - expected) < 0.5


@pytest.mark.parametrize("every", [15, 60])
@pytest.mark.parametrize("number", ["01", "07", "15", "27", "33"])
def test_a_slow_magnetometer_is_no_reason_either(number: str, every: int) -> None:
    """Few samples fit any line."""
    recording = poise.read(next(data_path("broad").glob(f"{number}_*.mat")))
    mag = np.where((np.arange(len(recording)) % every == 0)[:, None], recording.mag, np.nan)
    slow = replace(recording, mag=mag)
    np.testing.assert_array_equal(poise.estimate(FLAGSHIP, slow).table, poise.estimate(NEVER, slow).table)


def memory_of(field: Floats, block: float = 0.1) -> Floats:
    """The filter's memory after blocks of one sample each (n, 3), in lengths of the field."""
    P = np.zeros((ROWS, COLUMNS))
    forget_lengths(P)
    for m in field:
        begin_block(P)
        add_length(P, Vec3(*map(float, m)))
        add_turn(P, Vec3(1.0, 0.0, 0.0))
        take_lengths(FLAGSHIP, P, NOTHING._replace(mags=1.0, mag_time=block), 1.0)
    return P


def shown_by_lengths(method: poise.SelfCalibrating, P: Floats, known: Vec3) -> Shown:
    shown: Shown = shown_by(method, P, known, fit_of_lengths(method, P, known))
    return shown


@pytest.mark.parametrize("seed", range(8))
def test_the_fit_is_that_of_a_sphere(seed: int) -> None:
    """Beside scipy's, by distance from the centre, over samples that count the same: few beside what is remembered."""
    rng = np.random.default_rng(seed)
    iron = rng.normal(size=3)
    field = Rotation.random(400, rng=rng).apply([0.0, 0.4, -0.9]) + iron + 0.01 * rng.normal(size=(400, 3))

    def off(x: Floats) -> Floats:
        return np.asarray(np.linalg.norm(field - x[:3], axis=1) - x[3])

    expected = least_squares(off, [0.0, 0.0, 0.0, 1.0]).x
    shown = shown_by_lengths(FLAGSHIP, memory_of(field), ZERO)
    np.testing.assert_allclose(shown.iron, expected[:3], atol=0.01)
    assert shown.length == pytest.approx(expected[3], abs=0.01)
    sigma = np.sqrt(np.diag(np.array(shown.covariance)))
    assert (np.abs(np.array(shown.iron) - iron) < 3.0 * sigma).all()


def test_what_is_known_is_not_shown_again() -> None:
    rng = np.random.default_rng(1)
    field = Rotation.random(400, rng=rng).apply([0.0, 0.4, -0.9]) + np.array([0.5, 0.0, 0.0])
    P = memory_of(field)
    for known, there in (
        ((0.5, 0.0, 0.0), False),
        ((0.49, 0.0, 0.0), False),
        ((0.4, 0.0, 0.0), True),
        ((0.0, 0.0, 0.0), True),
    ):
        assert (shown_by_lengths(FLAGSHIP, P, Vec3(*known)).length > 0.0) is there
    assert shown_by_lengths(NEVER, P, ZERO).length == 0.0


def test_kernels_and_the_python_behind_them_agree() -> None:
    field = Rotation.random(300, rng=np.random.default_rng(2)).apply([0.0, 0.4, -0.9]) + np.array([0.3, -0.2, 0.1])
    P = memory_of(field)
    by_python = plain(fit_of_lengths)(FLAGSHIP, P.copy(), ZERO)
    by_kernel = fit_of_lengths(FLAGSHIP, P.copy(), ZERO)
    np.testing.assert_allclose(by_python.iron, by_kernel.iron, rtol=1e-9)
    np.testing.assert_allclose(np.array(by_python.covariance), np.array(by_kernel.covariance), rtol=1e-9)


@pytest.mark.parametrize(
    ("seen", "carried"),
    [
        ((0.0, 50.0, 0.0), True),  # iron along x, the field along y
        ((200.0, 50.0, 0.0), True),  # both
        ((0.5, 0.0, 0.0), False),  # gauss
        ((50_000.0, 0.0, 0.0), False),  # nT
    ],
)
def test_iron_of_another_unit_is_not_carried(seen: tuple[float, float, float], carried: bool) -> None:
    share = Vec3(4.0 if seen[0] == 200.0 else 0.5, 0.0, 0.0)
    held = iron_from_before(share, 50.0, Vec3(*seen), I3)
    assert (held != ZERO) is carried


def test_samples_that_carry_the_flag_are_told_in_words() -> None:
    attitude = poise.estimate(FLAGSHIP, with_iron(calibrated(), (0.0, -80.0, 0.0)))
    told = [reason for reason in attitude.reasons() if reason.flag == Flag.RESET]
    assert len(told) == 1 and "magnetometer" in told[0].sentence
