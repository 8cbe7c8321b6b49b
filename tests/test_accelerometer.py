"""What SelfCalibrating makes of its accelerometer's bias, scale and shocks, and what it does not learn from a rest."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

import poise
from data_files import data_path
from helpers import angle_between
from poise.data.learned import Learned
from poise.estimators.self_calibrating.model import ACC_BIAS, COLUMNS, ROWS, SCALE, put_sensor, sensor_of
from poise.estimators.self_calibrating.recall import begin_memory, recall
from poise.math.vectors import ZERO, Vec3
from poise.simulation import PERFECT, Triad, at_rest, forearm, measure, phone, robot

Floats = NDArray[np.float64]

FLAGSHIP = poise.SelfCalibrating()
WITHOUT = FLAGSHIP._replace(initial_acc_bias=0.0, acc_bias_walk=0.0)
BIAS = np.array([0.06, -0.05, 0.08])  # m/s²
WHITE = replace(PERFECT, gyr=Triad(noise=1e-4), acc=Triad(noise=0.002), mag=Triad(noise=0.05))
BIASED = replace(WHITE, acc=Triad(noise=0.002, bias=(0.06, -0.05, 0.08)))


@cache
def made(biased: bool = True) -> poise.Recording:
    return measure(forearm(120.0, 100.0, 6), BIASED if biased else WHITE, seed=1)


def trial(number: str) -> poise.Recording:
    return poise.read(next(data_path("broad").glob(f"{number}_*.mat")))


def learned(attitude: poise.Attitude, name: str) -> tuple[Floats, Floats]:
    """A value and its sigma."""
    assert attitude.learned is not None
    return np.array(attitude.learned[name]["value"]), np.array(attitude.learned[name]["sigma"])


def inclination(attitude: poise.Attitude, recording: poise.Recording) -> float:
    return poise.evaluate(attitude, recording).rmse_deg().inclination


def test_the_accelerometers_bias() -> None:
    attitude = poise.estimate(FLAGSHIP, made())
    value, sigma = learned(attitude, "acc_bias")
    assert np.abs(value - BIAS).max() < 0.03
    assert (np.abs(value - BIAS) < 3.0 * sigma).all()
    assert (sigma < 0.7 * FLAGSHIP.initial_acc_bias).all()


@pytest.mark.parametrize("motion", [forearm, phone, robot])
def test_it_is_no_tilt_any_more(motion: object) -> None:
    recording = measure(motion(120.0, 100.0, 6), BIASED, seed=1)  # type: ignore[operator]
    tilted, level = poise.estimate(WITHOUT, recording), poise.estimate(FLAGSHIP, recording)
    assert inclination(level, recording) < 0.8 * inclination(tilted, recording)
    tilted, level = poise.smooth(recording, WITHOUT), poise.smooth(recording, FLAGSHIP)
    assert inclination(level, recording) < 0.5 * inclination(tilted, recording)


def test_a_robot_that_never_tilts_learns_it_by_turning_about_up() -> None:
    """Gravity is along one axis all the time, so only that the lean goes around with the robot tells the other two."""
    recording = measure(robot(120.0, 100.0, 6), BIASED, seed=1)
    value, sigma = learned(poise.estimate(FLAGSHIP, recording), "acc_bias")
    assert np.abs(value - BIAS)[:2].max() < 0.03
    assert (sigma[:2] < 0.7 * FLAGSHIP.initial_acc_bias).all()
    still = measure(at_rest(duration=60.0), BIASED, seed=1)
    _, sigma = learned(poise.estimate(FLAGSHIP, still), "acc_bias")
    assert (sigma[:2] > 0.9 * FLAGSHIP.initial_acc_bias).all()  # rest says nothing of them


@pytest.mark.parametrize("factor", [0.95, 1.05])
def test_gravity_as_long_as_the_accelerometer_has_it(factor: float) -> None:
    clean = made(biased=False)
    scaled = replace(clean, acc=factor * clean.acc)
    attitude, as_it_was = poise.estimate(FLAGSHIP, scaled), poise.estimate(FLAGSHIP, clean)
    assert np.degrees(angle_between(attitude.quat, as_it_was.quat).max()) < 0.2
    value, sigma = learned(attitude, "acc_scale")
    assert abs(value - (1.0 / factor - 1.0)) < max(3.0 * sigma, 1e-3)
    assert poise.evaluate(attitude, scaled).rmse_deg().total < 0.5


@pytest.mark.parametrize("number", ["09", "21"])
def test_a_scale_of_five_per_cent_costs_nothing_on_real_trials(number: str) -> None:
    clean = trial(number)
    for factor in (0.95, 1.05):
        scaled = replace(clean, acc=factor * clean.acc)
        for run in (lambda r: poise.estimate(FLAGSHIP, r), poise.smooth):
            was, now = (poise.evaluate(run(r), r).rmse_deg().total for r in (clean, scaled))
            assert abs(now - was) < 0.1


def test_taps_do_not_pass_for_a_bias() -> None:
    """Shocks between two samples leave velocities that no sample has, and the way back would make a bias of them."""
    tapped = trial("25")
    smoothed, believing = poise.smooth(tapped), poise.smooth(tapped, FLAGSHIP._replace(shock_noise=0.0))
    assert inclination(smoothed, tapped) < 0.35 < inclination(believing, tapped)


def test_a_rest_teaches_nothing_of_scale_and_delays() -> None:
    """The noise of a gyroscope that rests would be regressed on itself: after an hour A was 3 %, eleven sigma."""
    noisy = replace(WHITE, gyr=Triad(noise=1e-3), acc=Triad(noise=0.005))
    attitude = poise.estimate(FLAGSHIP, measure(at_rest(duration=900.0, rate=50.0), noisy, seed=1))
    scale, _ = learned(attitude, "gyr_scale")
    assert np.abs(scale).max() < 1e-4
    for name, expected in (("mag_delay", FLAGSHIP.mag_delay), ("acc_delay", 0.25 / 50.0)):
        delay, sigma = learned(attitude, name)
        assert abs(delay - expected) < 0.1 * sigma
    bias, sigma = learned(attitude, "acc_bias")
    assert (np.abs(bias) < 0.3 * sigma + 1e-3).all()


def test_it_is_carried_to_the_next_recording() -> None:
    before = poise.estimate(FLAGSHIP, made()).learned
    assert before is not None
    again = measure(phone(30.0, 100.0, 7), BIASED, seed=2)
    carried = poise.estimate(FLAGSHIP, again, start_from=before)
    assert inclination(carried, again) < 0.8 * inclination(poise.estimate(FLAGSHIP, again), again)


def test_what_an_earlier_version_learned_is_still_taken() -> None:
    known = poise.estimate(FLAGSHIP, made()).learned
    assert known is not None and known.covariance is not None
    quantities = {name: known[name] for name in known if name not in ("acc_bias", "acc_scale")}
    at = [i for i, name in enumerate(known.states) if not name.startswith(("acc_bias", "acc_scale"))]
    states = tuple(known.states[i] for i in at)
    earlier = Learned(known.method, quantities, states, known.covariance[np.ix_(at, at)])
    attitude = poise.estimate(FLAGSHIP, made(), start_from=earlier)
    assert inclination(attitude, made()) < 1.0
    assert attitude.learned is not None and "acc_bias" in attitude.learned


def test_a_doubted_bias_takes_back_what_the_accelerometer_learned_from_it() -> None:
    P = np.zeros((ROWS, COLUMNS))
    for k in range(SCALE, SCALE + 9):
        P[k, k] = 1e-6
    for k in range(4):
        P[ACC_BIAS + k, ACC_BIAS + k] = 1e-3
    known = sensor_of(P)._replace(acc_bias=Vec3(0.01, 0.02, 0.03), acc_scale=0.004, spread=1.0, wander=1.0)
    begin_memory(P, known)
    put_sensor(P, known._replace(acc_bias=ZERO, acc_scale=0.0))
    P[ACC_BIAS, ACC_BIAS] = P[ACC_BIAS + 3, ACC_BIAS + 3] = 1e-9
    recall(P, 0.0)
    after = sensor_of(P)
    assert (after.acc_bias, after.acc_scale) == (Vec3(0.01, 0.02, 0.03), 0.004)
    np.testing.assert_array_equal(np.diag(P)[ACC_BIAS : ACC_BIAS + 4], 1e-3)


def test_acceleration_without_gravity_is_without_the_bias_too() -> None:
    recording = made()
    attitude = poise.smooth(recording)
    assert recording.truth is not None
    truth = recording.truth.linear_acceleration(made(biased=False))
    off = attitude.linear_acceleration(recording) - truth
    as_measured = replace(attitude, learned=None).linear_acceleration(recording) - truth
    assert np.sqrt(np.mean(off**2)) < 0.6 * np.sqrt(np.mean(as_measured**2))
    body = attitude.linear_acceleration(recording, frame="body")
    np.testing.assert_allclose(np.linalg.norm(body, axis=1), np.linalg.norm(off + truth, axis=1), atol=1e-9)


def test_the_first_block_has_its_heading_from_the_future_too() -> None:
    """One sample of a noisy magnetometer begins the attitude; what the first block's mean makes of it counts before, too."""
    noisy = replace(WHITE, mag=Triad(noise=2.0))
    recording = measure(forearm(60.0, 100.0, 4), noisy, seed=1)[1500:]
    smoothed = poise.smooth(recording)
    assert recording.truth is not None
    off = np.degrees(angle_between(smoothed.quat, recording.truth.quat))
    began = np.degrees(angle_between(poise.estimate(FLAGSHIP, recording).quat[:1], recording.truth.quat[:1]))
    assert began > 3.0  # of which nothing is left
    assert off[:8].max() < off[8:30].max() + 0.2
