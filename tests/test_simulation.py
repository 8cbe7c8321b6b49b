"""Made motions are their own derivatives, a perfect sensor repeats them, and errors are as large as stated."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import radians

import numpy as np
import pytest

import poise
from poise.errors import RecordingError
from poise.math import arrays
from poise.simulation import PERFECT, Motion, Sensor, Triad, at_rest, forearm, measure, phone, robot, turned_about_up

MOTIONS = [forearm, phone, robot]


def rate_of(quat: np.ndarray, step: float) -> np.ndarray:
    """The body's rate by a sixth-order difference of the quaternion, for rows 3 … n − 4."""
    n = len(quat) - 6
    weights = {-3: -1, -2: 9, -1: -45, 1: 45, 2: -9, 3: 1}
    derivative = sum(w * quat[3 + i : 3 + i + n] for i, w in weights.items()) / (60 * step)
    return 2.0 * arrays.multiply(arrays.conjugate(quat[3:-3]), derivative)[:, 1:]


@pytest.mark.parametrize("make", MOTIONS)
@pytest.mark.parametrize("seed", [0, 7])
def test_rate_is_the_derivative_of_the_attitude(make: Callable[..., Motion], seed: int) -> None:
    motion = make(30.0, 1000.0, seed)
    np.testing.assert_allclose(motion.rate[3:-3], rate_of(motion.quat, 1e-3), atol=1e-6)
    assert np.abs(motion.rate).max() > 0.5


@pytest.mark.parametrize("make", [forearm, robot])
def test_acceleration_brings_the_sensor_to_a_stop_in_every_rest(make: Callable[..., Motion]) -> None:
    motion = make(60.0, 1000.0)
    mean = (motion.acceleration[1:] + motion.acceleration[:-1]) / 2
    velocity = np.cumsum(mean, axis=0) * 1e-3
    still = (motion.rate[1:] == 0).all(axis=1)
    assert np.flatnonzero(np.diff(still.astype(int))).size >= 5, "expected rests between, not only at the ends"
    assert np.abs(velocity[still]).max() < 1e-6
    assert np.linalg.norm(velocity, axis=1).max() > 0.3


def test_the_robot_is_an_axle_that_drives_and_turns_plus_its_lever_arm() -> None:
    motion = robot(30.0, 1000.0, lean_deg=20.0)
    arm = arrays.rotate(motion.quat, [0.0, 0.0, 0.3])
    of_arm = (-arm[4:] + 16 * arm[3:-1] - 30 * arm[2:-2] + 16 * arm[1:-3] - arm[:-4]) / (12 * 1e-6)
    axle = motion.acceleration[2:-2] - of_arm
    assert (np.abs(axle[:, 2]) < 1e-6).mean() > 0.8, "level but for the bumps"
    forward = arrays.rotate(motion.quat[2:-2], [0.0, 1.0, 0.0])[:, :2]
    forward /= np.linalg.norm(forward, axis=1, keepdims=True)
    turn = np.gradient(np.unwrap(np.arctan2(-forward[:, 0], forward[:, 1])), 1e-3)
    speed = np.cumsum(np.sum(axle[:, :2] * forward, axis=1)) * 1e-3
    leftward = axle[:, 1] * forward[:, 0] - axle[:, 0] * forward[:, 1]
    np.testing.assert_allclose(leftward, speed * turn, atol=2e-3)
    assert speed.max() == pytest.approx(0.8, abs=1e-3)


def test_motions_are_what_they_say() -> None:
    arm, held, driven = forearm(), phone(), robot()
    pitch = {m: np.degrees(np.arcsin(arrays.rotate(m.quat, [0.0, 1.0, 0.0])[:, 2])) for m in (arm, held, driven)}
    assert len(arm) == 6000 and arm.time[1] == 0.01
    assert 40 < np.abs(pitch[arm]).max() < 60
    assert (np.abs(pitch[held] - 76) < 4).mean() > 0.5
    assert np.abs(pitch[driven]).max() < 12
    for motion, rest in ((arm, 4.0), (held, 3.0), (driven, 3.0)):
        start = motion.time <= rest
        assert (motion.rate[start] == 0).all() and (motion.acceleration[start] == 0).all()
        np.testing.assert_allclose(np.linalg.norm(motion.quat, axis=1), 1.0, atol=1e-12)


def test_specific_force_and_field_at_rest() -> None:
    quat = arrays.normalize(np.array([0.8, 0.3, -0.2, 0.4]))
    recording = measure(at_rest(quat, 1.0), PERFECT, field=(0.0, 20.0, -40.0), gravity=9.81)
    back = arrays.conjugate(quat)
    np.testing.assert_allclose(recording.acc, np.tile(arrays.rotate(back, [0, 0, 9.81]), (100, 1)), atol=1e-12)
    np.testing.assert_allclose(recording.mag, np.tile(arrays.rotate(back, [0, 20, -40]), (100, 1)), atol=1e-12)
    assert not recording.gyr.any() and recording.moving is None
    np.testing.assert_allclose(measure(at_rest(), PERFECT).acc[0], [0, 0, 9.80665], atol=1e-12)


@pytest.mark.parametrize("make", MOTIONS)
def test_a_perfect_gyroscope_integrates_to_the_reference(make: Callable[..., Motion]) -> None:
    recording = measure(make(60.0, 50.0), PERFECT)
    quat = recording.truth.quat[0]
    worst = 0.0
    for dt, gyr, true in zip(np.diff(recording.time), recording.gyr[1:], recording.truth.quat[1:], strict=True):
        angle = np.linalg.norm(gyr) * dt
        axis = gyr * dt * (0.5 if angle < 1e-9 else np.sin(angle / 2) / angle)
        quat = arrays.multiply(quat, np.array([np.cos(angle / 2), *axis]))
        worst = max(worst, float(arrays.angle(arrays.multiply(quat, arrays.conjugate(true)))))
    assert worst < 1e-6


def test_the_same_seed_gives_the_same_bits() -> None:
    motion = forearm(10.0)
    a, b, c = measure(motion), measure(forearm(10.0)), measure(motion, seed=1)
    for name in ("time", "gyr", "acc", "mag"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name))
        assert not np.array_equal(getattr(a, name), getattr(c, name))
    other = measure(motion, replace(Sensor(), acc=Triad()))
    np.testing.assert_array_equal(other.gyr, a.gyr)
    np.testing.assert_array_equal(other.mag, a.mag)
    assert not np.array_equal(forearm(10.0, seed=1).quat, motion.quat)


def test_noise_bias_and_walk_are_as_large_as_stated() -> None:
    still, bias = at_rest(duration=400.0), (0.01, -0.02, 0.03)
    sensor = replace(PERFECT, gyr=Triad(noise=0.002, bias=bias), acc=Triad(noise=0.01), mag=Triad(noise=0.05))
    recording = measure(still, sensor)
    np.testing.assert_allclose(recording.gyr.std(axis=0), 0.002 * 10, rtol=0.03)
    np.testing.assert_allclose(recording.acc.std(axis=0), 0.01 * 10, rtol=0.03)
    np.testing.assert_allclose(recording.mag.std(axis=0), 0.05 * 10, rtol=0.03)
    np.testing.assert_allclose(recording.gyr.mean(axis=0), bias, atol=5 * 0.02 / np.sqrt(40_000))
    np.testing.assert_array_equal(recording.truth.bias, np.tile(bias, (40_000, 1)))
    walked = measure(still, replace(PERFECT, gyr=Triad(walk=1e-3))).gyr
    np.testing.assert_allclose(np.diff(walked, axis=0).std(axis=0), 1e-3 / 10, rtol=0.03)
    drawn = [measure(at_rest(duration=0.1), replace(PERFECT, gyr=Triad(bias=0.5)), seed=s).gyr[0] for s in range(300)]
    np.testing.assert_allclose(np.std(drawn), 0.5, rtol=0.1)


def test_scale_misalignment_range_and_steps() -> None:
    motion = forearm(20.0)
    true = measure(motion, PERFECT).gyr
    bent = measure(motion, replace(PERFECT, gyr=Triad(scale=0.02, misalignment=0.01))).gyr
    matrix = np.linalg.lstsq(true, bent, rcond=None)[0].T
    np.testing.assert_allclose(true @ matrix.T, bent, atol=1e-12)
    assert 0.0 < np.abs(matrix - np.eye(3)).max() < 0.08
    coarse = measure(motion, replace(PERFECT, gyr=Triad(limit=1.0, resolution=0.25))).gyr
    assert np.abs(coarse).max() == 1.0
    np.testing.assert_allclose(coarse, np.clip(np.round(true / 0.25) * 0.25, -1, 1), atol=1e-12)


def test_jitter_keeps_stamps_rising_and_truth_on_the_rows() -> None:
    recording = measure(forearm(10.0), replace(PERFECT, jitter=1.0))
    assert (np.diff(recording.time) > 0).all()
    assert np.abs(recording.time - forearm(10.0).time).max() == pytest.approx(0.0045)
    np.testing.assert_array_equal(recording.truth.time, recording.time)


def test_a_slower_magnetometer_stands_once_in_the_row_after_its_stamp() -> None:
    motion = forearm(10.0, 100.0)
    recording = measure(motion, replace(PERFECT, mag_rate=30.0))
    rows = np.flatnonzero(np.isfinite(recording.mag[:, 0]))
    stamps = np.arange(len(rows)) / 30.0
    np.testing.assert_allclose(recording.time[rows] - recording.mag_age[rows], stamps, atol=1e-9)
    assert len(rows) == 300 and recording.mag_age.max() < 0.01
    exact = forearm(10.0, 300.0)
    field = arrays.rotate(arrays.conjugate(exact.quat[::10]), [0.0, 20.0, -40.0])
    np.testing.assert_allclose(recording.mag[rows], field[: len(rows)], atol=0.01)


def test_a_late_magnetometer_shows_an_earlier_field() -> None:
    motion = forearm(10.0)
    now, late = measure(motion, PERFECT).mag, measure(motion, replace(PERFECT, mag_delay=0.03)).mag
    np.testing.assert_allclose(late[3:], now[:-3], atol=1e-9)


def test_turning_the_world_changes_the_heading_alone() -> None:
    motion, angle = forearm(20.0), radians(50.0)
    a, b = measure(motion, PERFECT), measure(turned_about_up(motion, angle), PERFECT)
    np.testing.assert_allclose(b.gyr, a.gyr, atol=1e-12)
    np.testing.assert_allclose(b.acc, a.acc, atol=1e-12)
    turned = np.unwrap(b.truth.heading()) - np.unwrap(a.truth.heading())
    np.testing.assert_allclose(np.cos(turned), np.cos(angle), atol=1e-9)
    np.testing.assert_allclose(np.sin(turned), -np.sin(angle), atol=1e-9)


def test_a_declined_field_makes_the_reference_true() -> None:
    assert measure(at_rest()).truth.heading_reference == "magnetic"
    assert measure(at_rest(), field=(2.0, 20.0, -40.0)).truth.heading_reference == "true"


def test_an_estimator_follows_the_made_forearm() -> None:
    motion = forearm()
    perfect, real = measure(motion, PERFECT), measure(motion)
    exact = poise.evaluate(poise.estimate(poise.TwoStage(), perfect), perfect)
    calm = np.linalg.norm(motion.acceleration, axis=1) < 0.3
    assert np.degrees(np.sqrt(np.mean(exact.total[calm] ** 2))) < 1.0
    assert poise.evaluate(poise.estimate(poise.TwoStage(), real), real).rmse_deg().total < 5.0
    assert 0.6 < np.mean(real.moving) < 0.95


def test_what_cannot_be_made_is_refused() -> None:
    for wrong in ({"duration": -1.0}, {"rate": 0.0}, {"rate": float("nan")}):
        with pytest.raises(RecordingError, match="above 0"):
            forearm(**wrong)
    with pytest.raises(RecordingError, match="w x y z"):
        at_rest((0.0, 0.0, 0.0, 0.0))
    with pytest.raises(RecordingError, match="at least 2 rows"):
        measure(at_rest(duration=0.01))
    good = at_rest(duration=0.1)
    with pytest.raises(RecordingError, match="expected shape"):
        replace(good, rate=good.rate[:3])
    with pytest.raises(RecordingError, match="must rise"):
        replace(good, time=good.time[::-1])
