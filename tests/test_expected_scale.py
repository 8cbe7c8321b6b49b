"""What SelfCalibrating makes of a gyroscope whose scale and axes are worse than it expects."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st
from numpy.typing import NDArray

import poise
from data_files import data_path
from helpers import for_all
from poise.estimators.self_calibrating.covariance import correct, forget
from poise.estimators.self_calibrating.expected_scale import expect_as_learned, expect_more
from poise.estimators.self_calibrating.model import (
    COLUMNS,
    OWN,
    ROWS,
    SCALE,
    SENSOR,
    SIZE,
    WIDENED,
    H,
    X,
    sensor_of,
)
from poise.estimators.self_calibrating.recall import begin_memory, recall
from poise.estimators.self_calibrating.watch import unsure_bias
from poise.simulation import PERFECT, Triad, forearm, measure

Floats = NDArray[np.float64]
FLAGSHIP = poise.SelfCalibrating()


def memory(scale: float) -> Floats:
    P = np.zeros((ROWS, COLUMNS))
    for k in range(SIZE):
        P[k, k] = 1.0
    forget(P, SCALE, 9, scale**2)
    return P


def measured(P: Floats, seed: int, size: float, count: int) -> None:
    """Corrections by *count* numbers that tell of all errors together, of A's that are as large as *size*."""
    rng = np.random.default_rng(seed)
    errors = rng.normal(size=SIZE)
    errors[SCALE : SCALE + 9] *= size
    for _ in range(count):
        h = rng.normal(size=SIZE)
        h[SCALE : SCALE + 9] *= 100.0
        P[H, :SIZE] = h
        correct(P, float(h @ errors) + 0.1 * rng.normal(), 0.01)


@for_all(st.integers(0, 10_000), st.integers(60, 120))
def test_to_have_expected_more_from_the_start_is_the_same(seed: int, count: int) -> None:
    late, early = memory(0.003), memory(0.006)
    measured(late, seed, 0.02, count)
    measured(early, seed, 0.02, count)
    expect_more(late, 0.003)
    assume(late[OWN, WIDENED] == 1.0)  # a column that was drawn small may not speak for it
    unsure_bias(early, np.radians(0.3) ** 2)  # as it is with each doubling
    np.testing.assert_allclose(late[X, :SIZE], early[X, :SIZE], rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(late[:SIZE, :SIZE], early[:SIZE, :SIZE], rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize(("size", "expected"), [(0.02, 1.0), (0.001, 0.0)])
def test_it_is_asked_of_what_was_measured(size: float, expected: float) -> None:
    P = memory(0.003)
    expect_more(P, 0.003)
    assert P[OWN, WIDENED] == 0.0  # before there is any evidence
    measured(P, 1, size, 100)
    expect_more(P, 0.003)
    assert P[OWN, WIDENED] == expected


def test_what_becomes_known_without_that_is_judged() -> None:
    """A is a constant: what changes in it later on is another error, as that of a bias."""
    P = memory(0.003)
    measured(P, 1, 0.001, 200)
    expect_more(P, 0.003)
    P[SENSOR, :9] = 0.02
    expect_more(P, 0.003)
    assert P[OWN, WIDENED] == 0.0


def test_what_was_learned_before_is_what_is_expected() -> None:
    P = memory(0.002)
    P[SENSOR, :9] = 0.02
    expect_as_learned(P)
    expect_more(P, 0.003)
    assert P[OWN, WIDENED] == 0.0
    assert not P[X].any()


def turned(P: Floats) -> Floats:
    """About all three axes, a little."""
    for k in range(SCALE, SCALE + 9):
        P[k, k] *= 0.8
    return P


def test_not_by_turns_about_one_axis() -> None:
    """What goes round about up is pushed across its way, and follows that as it would another scale."""
    P = memory(0.003)
    for k in (2, 5, 8):
        P[SENSOR, k], P[SCALE + k, SCALE + k] = 0.02, 0.01 * 0.003**2
    expect_more(P, 0.003)
    assert P[OWN, WIDENED] == 0.0
    P = memory(0.003)
    P[SENSOR, :9] = 0.02
    expect_more(turned(P), 0.003)
    assert P[OWN, WIDENED] == 1.0


def test_no_more_than_no_sensor_has_and_none_where_none_is_expected() -> None:
    P = memory(0.003)
    for _ in range(20):
        turned(P)
        P[SENSOR, :9] = 0.9
        expect_more(P, 0.003)
    assert P[OWN, WIDENED] == 2.0
    assert 0.0 < P[SCALE, SCALE] <= (4 * 0.003) ** 2
    P = memory(0.0)
    P[SENSOR, :9] = 0.9
    expect_more(P, 0.0)
    assert P[OWN, WIDENED] == 0.0
    assert not P[X].any()


def test_a_memory_is_recalled_with_what_was_expected_then() -> None:
    P = memory(0.003)
    begin_memory(P, sensor_of(P))
    P[SENSOR, :9] = 0.02
    expect_more(turned(P), 0.003)
    assert P[OWN, WIDENED] == 1.0
    assert P[SCALE, SCALE] > 0.003**2
    recall(P, 1.0)
    assert P[OWN, WIDENED] == 0.0
    assert P[SCALE, SCALE] == pytest.approx(0.003**2)


CHEAP = replace(
    PERFECT,
    gyr=Triad(noise=1e-4, scale=0.02, misalignment=0.01, bias=0.01),
    acc=Triad(noise=0.002, bias=0.1),
    mag=Triad(noise=0.05),
)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_an_inexpensive_sensor(seed: int) -> None:
    """Up to 3 % off, ten sigma of what is expected: it used to hold on to that for minutes."""
    recording = measure(forearm(120.0, 100.0, 6), CHEAP, seed=seed)
    attitude = poise.estimate(FLAGSHIP, recording)
    assert poise.evaluate(attitude, recording).rmse_deg().total < 1.4
    assert poise.evaluate(poise.smooth(recording), recording).rmse_deg().total < 0.4
    assert attitude.learned is not None
    assert np.abs(attitude.learned["gyr_scale"]["value"]).max() > 0.015
    assert np.max(attitude.learned["gyr_scale"]["sigma"]) < 0.003


def test_two_per_cent_on_a_real_trial() -> None:
    """It took this one to 23 deg, and 21 on the way back."""
    clean = poise.read(next(data_path("broad").glob("21_*.mat")))
    scaled = replace(clean, gyr=1.02 * clean.gyr)
    assert poise.evaluate(poise.estimate(FLAGSHIP, scaled), scaled).rmse_deg().total < 8.0
    assert poise.evaluate(poise.smooth(scaled), scaled).rmse_deg().total < 2.0
