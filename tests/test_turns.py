"""Hard iron by small turns: what goes around with the sensor, where the field's length tells nothing yet."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import poise
from data_files import data_path
from helpers import plain
from irons import FLAGSHIP, degrees, with_iron
from poise.data.flags import Flag
from poise.estimators.self_calibrating.another_field import take_field
from poise.estimators.self_calibrating.iron import shown_by
from poise.estimators.self_calibrating.model import BEGAN, COLUMNS, LENGTHS, ROWS, put
from poise.estimators.self_calibrating.turns import fit_of_turns
from poise.math.matrices import Mat3
from poise.math.vectors import ZERO, Vec3
from poise.simulation import PERFECT, Triad, measure, robot

Floats = NDArray[np.float64]
CORNERS = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]) / np.sqrt(3.0)


def small_turns(n: int, angle: float, rng: np.random.Generator) -> Floats:
    return Rotation.from_rotvec(angle * rng.normal(size=(n, 3))).as_matrix()


def memory_of(R: Floats, field: Floats, seconds: float = 0.5) -> Floats:
    """The filter's memory after blocks of the field (n, 3) in the Earth's frame, which each stand for *seconds*."""
    P = np.zeros((ROWS, COLUMNS))
    for r, f in zip(R, field, strict=True):
        take_field(P, Vec3(*map(float, f)), Mat3(*(Vec3(*map(float, row)) for row in r)), ZERO, ZERO, seconds)
    return P


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("angle", [0.15, 1.0])
def test_the_fit_is_that_of_least_squares(seed: int, angle: float) -> None:
    """Beside numpy's, over samples that count the same: few beside what is remembered."""
    rng = np.random.default_rng(seed)
    iron, n = 0.5 * rng.normal(size=3), 60
    R = small_turns(n, angle, rng)
    field = np.array([0.0, 0.4, -0.9]) + R @ iron + 0.005 * rng.normal(size=(n, 3))
    system = np.concatenate([np.hstack([np.eye(3), r]) for r in R])
    expected = np.linalg.lstsq(system, field.ravel(), rcond=None)[0]
    fit = fit_of_turns(FLAGSHIP, memory_of(R, field), ZERO)
    sigma = np.sqrt(np.diag(np.array(fit.covariance)))
    assert (
        np.abs(np.array(fit.iron) - expected[3:]) < 1.5 * sigma
    ).all()  # old samples fade, and ρ keeps it back a little
    assert (np.abs(np.array(fit.iron) - iron) < 4.0 * sigma).all()
    assert fit.length == pytest.approx(np.linalg.norm(expected[:3]), abs=0.05)


def test_an_axis_that_has_not_turned_is_unseen() -> None:
    rng = np.random.default_rng(1)
    R = Rotation.from_rotvec(np.outer(rng.normal(size=80), [0.0, 0.0, 0.5])).as_matrix()
    iron = np.array([0.3, -0.2, 0.6])
    field = np.array([0.0, 0.4, -0.9]) + R @ iron + 0.005 * rng.normal(size=(80, 3))
    fit = fit_of_turns(FLAGSHIP, memory_of(R, field), ZERO)
    unseen = np.diag(np.array(fit.unseen))
    assert unseen[2] > 0.9 and unseen[:2].max() < 0.05
    np.testing.assert_allclose(fit.iron[:2], iron[:2], atol=0.02)
    assert abs(fit.iron[2]) < 0.1  # nothing is made up along it


def test_few_samples_say_nothing() -> None:
    rng = np.random.default_rng(2)
    R = small_turns(4, 1.0, rng)
    assert fit_of_turns(FLAGSHIP, memory_of(R, R @ np.array([0.5, 0.0, 0.0]), 2.5), ZERO).length == 0.0


def test_a_magnet_that_came_after_the_heading_was_set_is_not_taken_over() -> None:
    rng = np.random.default_rng(3)
    R = small_turns(80, 0.5, rng)
    field = np.array([0.0, 0.4, -0.9]) + R @ np.array([0.6, 0.0, 0.0]) + 0.002 * rng.normal(size=(80, 3))
    for began, there in ((R[0].T @ field[0], True), (R[0].T @ [0.0, 0.4, -0.9], False)):
        P = memory_of(R, field)
        put(P, LENGTHS, BEGAN, Vec3(*map(float, began)))
        shown = shown_by(FLAGSHIP, P, ZERO, fit_of_turns(FLAGSHIP, P, ZERO))
        assert (shown.length > 0.0) is there


def test_kernels_and_the_python_behind_them_agree() -> None:
    rng = np.random.default_rng(4)
    R = small_turns(50, 0.3, rng)
    P = memory_of(R, R @ np.array([0.2, 0.1, 0.4]) + 0.01 * rng.normal(size=(50, 3)))
    one, other = (each(FLAGSHIP, P.copy(), ZERO) for each in (fit_of_turns, plain(fit_of_turns)))
    np.testing.assert_allclose(one.iron, other.iron, rtol=1e-9)
    np.testing.assert_allclose(np.array(one.covariance), np.array(other.covariance), rtol=1e-9)


def test_a_robot_on_bumps_learns_its_iron_along_up_too() -> None:
    white = replace(PERFECT, gyr=Triad(noise=1e-4), acc=Triad(noise=0.002), mag=Triad(noise=0.05))
    recording = with_iron(measure(robot(120.0, 100.0, 2), white, seed=1), (10.0, 5.0, 30.0))
    attitude = poise.estimate(FLAGSHIP, recording)
    assert attitude.learned is not None
    assert abs(attitude.learned["hard_iron"]["value"][2] - 30.0) < 3.0
    assert degrees(attitude, recording, slice(6000, None)) < 2.0


@pytest.mark.parametrize("number", ["11", "15", "25", "27"])
def test_trials_that_hardly_turn_show_their_iron(number: str) -> None:
    """Before, and in vqf, the heading stayed tens of degrees off."""
    recording = poise.read(next(data_path("broad").glob(f"{number}_*.mat")))
    assert recording.moving is not None
    clean = poise.evaluate(poise.smooth(recording), recording).rmse_deg().total
    for corner in CORNERS[:2]:
        beside = with_iron(recording, tuple(20.0 * corner))
        attitude = poise.estimate(FLAGSHIP, beside)
        assert ((attitude.flags & np.uint32(Flag.HARD_IRON)) != 0).any()
        assert attitude.learned is not None
        assert np.linalg.norm(np.array(attitude.learned["hard_iron"]["value"]) - 20.0 * corner) < 3.0
        assert poise.evaluate(poise.smooth(beside), beside).rmse_deg().total < clean + 3.5
