"""Each source's method in the regime that its source is made for, on made and on real recordings."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import poise
from data_files import data_path
from helpers import Floats, wxyz
from poise.data.flags import Flag
from poise.math import arrays
from poise.simulation import PERFECT, Sensor, Triad, at_rest, forearm, measure, phone

INJECTED = np.radians([0.5, -0.4, 0.3])
PURE = poise.Gated(gate_rate=0.0)  # never corrected


@cache
def trial(name: str) -> poise.Recording:
    return poise.read(data_path("broad", name))


def upright(pitch: float, bias: Floats, duration: float = 30.0) -> poise.Recording:
    """A phone still at a pitch (degrees), by a gyroscope with *bias* (deg/s)."""
    still = measure(
        at_rest(wxyz(Rotation.from_euler("ZXY", [30.0, pitch, 5.0], degrees=True)), duration, 100.0), PERFECT
    )
    return replace(still, gyr=still.gyr + np.radians(bias))


# -- armband ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(4))
def test_armband_follows_a_forearm(seed: int) -> None:
    """With a magnetometer whose hard iron is calibrated: 1 µT of it turns the heading of every method by 3°."""
    recording = measure(forearm(40.0, 100.0, seed), replace(Sensor(), mag=Triad(noise=0.05)), seed=seed)
    error = poise.evaluate(poise.estimate(poise.Armband(), recording), recording)
    assert error.rmse_deg().total < 3.0
    assert not error.diverged


def test_the_prints_kinematics_hold_near_level_only() -> None:
    """Body rates added to angles: right for a small lean, lost on a forearm."""
    motion = phone(20.0, 100.0, 1)
    level = replace(motion, quat=np.tile([1.0, 0, 0, 0], (len(motion), 1)), rate=np.zeros_like(motion.rate))
    still = measure(replace(level, acceleration=np.zeros_like(motion.acceleration)), seed=1)
    printed = poise.Armband.as_printed()
    assert poise.evaluate(poise.estimate(printed, still), still).total[-1] < np.radians(8.0)  # hard iron again
    moving = measure(forearm(40.0, 100.0, 0), seed=0)
    assert poise.evaluate(poise.estimate(printed, moving), moving).rmse_deg().total > 30.0


def test_armband_starts_from_the_mean_of_a_rest() -> None:
    noisy = replace(Sensor(), acc=Triad(noise=0.008), mag=Triad(noise=0.05))
    truth = wxyz(Rotation.from_euler("ZXY", [1.0, 0.3, -0.4]))
    errors = []
    for seed in range(20):
        recording = measure(at_rest(truth, 2.0, 100.0), noisy, seed=seed)
        total = poise.evaluate(poise.estimate(poise.Armband(), recording), recording).total
        errors.append([total[0], total[99]])
    first, after = np.sqrt(np.mean(np.square(errors), axis=0))
    assert after < 0.2 * first  # 100 samples: a tenth of the noise


def test_armband_says_when_it_started_in_motion() -> None:
    whole = measure(forearm(20.0, 100.0, 1), seed=1)
    rested = poise.estimate(poise.Armband(), whole)
    assert not (rested.flags & Flag.START_IN_MOTION).any()
    moving = whole[700:]
    thrown = poise.estimate(poise.Armband(), moving)
    told = (thrown.flags & Flag.START_IN_MOTION) != 0
    assert told[1:90].all() and not told[110:].any()
    assert (thrown.sigma[1] > 2.0 * rested.sigma[50]).all(), "a wide P0"


def test_armbands_weights_of_one_leave_the_gyroscope_alone() -> None:
    """Z is then the prediction, and nothing is corrected."""
    recording = measure(forearm(20.0, 100.0, 2), PERFECT)
    alone = poise.Armband(alpha=1.0, beta=1.0, zeta=1.0)
    magnet = replace(recording, mag=recording.mag[:, [1, 0, 2]])
    a, b = (
        poise.estimate(alone, r, start=recording.truth, rest_bias=False, guard=None).quat for r in (recording, magnet)
    )
    moving = slice(500, None)  # after the start, which is a mean of acc and mag
    turned = arrays.multiply(a, arrays.conjugate(b))[moving]
    assert np.ptp(turned, axis=0).max() < 1e-9


def test_running_noise_trusts_a_shaken_accelerometer_less() -> None:
    recording = measure(forearm(40.0, 100.0, 3), seed=3)
    rng = np.random.default_rng(0)
    acc = recording.acc.copy()
    acc[2000:] += 8.0 * rng.standard_normal(acc[2000:].shape)
    shaken = replace(recording, acc=acc)
    sigma = {
        mode: poise.estimate(poise.Armband(r_mode=mode), shaken).sigma[3900, 0]  # type: ignore[arg-type]
        for mode in ("running", "fixed")
    }
    assert sigma["running"] > 1.3 * sigma["fixed"]


# -- tilt -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("attitude", [(0.0, 0.0), (0.5, 0.8), (-1.2, 2.5)])
def test_tilt_finds_the_bias_that_gravity_shows(attitude: tuple[float, float]) -> None:
    truth = wxyz(Rotation.from_euler("ZXY", [0.0, *attitude]))
    still = measure(at_rest(truth, 10.0, 100.0), seed=1)
    assert still.truth is not None
    recording = replace(still, gyr=still.gyr + INJECTED)
    found = poise.estimate(poise.Tilt(), recording)
    wrong = arrays.rotate(found.quat[-1], found.bias[-1] - still.truth.bias[-1] - INJECTED)
    assert np.abs(wrong[:2]).max() < np.radians(0.1), "horizontal"
    assert wrong[2] == pytest.approx(-arrays.rotate(found.quat[-1], still.truth.bias[-1] + INJECTED)[2], abs=1e-3)
    up = arrays.rotate(arrays.conjugate(truth), np.array([0.0, 0.0, 1.0]))
    assert found.bias_sigma[-1] == pytest.approx(np.abs(up) * np.radians(2.0), abs=2e-3)


def test_tilts_fixed_ratio_draws_the_angle_in_at_its_rate() -> None:
    still = measure(at_rest(np.array([1.0, 0, 0, 0]), 10.0, 100.0), PERFECT)
    leaning = wxyz(Rotation.from_euler("ZXY", [0.0, 0.2, 0.0]))
    attitude = poise.estimate(poise.Tilt(gain="fixed", ratio=0.5), still, start=leaning)
    lean = poise.evaluate(attitude, still).inclination
    assert lean[200] == pytest.approx(0.2 * np.exp(-1.0), rel=0.02)
    assert not attitude.bias.any(), "a fixed ratio learns no bias"


def test_tilts_noise_at_rest_is_the_measured_one() -> None:
    """R is the variance of the measured angle, so that sigma follows the accelerometer's noise."""
    sigmas = []
    for noise in (0.002, 0.02):
        recording = measure(
            at_rest(np.array([1.0, 0, 0, 0]), 20.0, 100.0), replace(PERFECT, acc=Triad(noise=noise)), seed=2
        )
        sigmas.append(poise.estimate(poise.Tilt(r="rest"), recording).sigma[-1, 0])
    assert 3.0 < sigmas[1] / sigmas[0] < 10.0


def test_tilt_goes_over_the_top() -> None:
    """A somersault: pitch passes 90° twice and the angle from the vertical goes up to 180° and back."""
    n, rate = 1000, 100.0
    angle = 2.0 * np.pi * np.arange(n) / n
    quat = wxyz(Rotation.from_euler("ZXY", np.column_stack([np.full(n, 0.7), angle, np.full(n, 0.2)])))
    up = arrays.rotate(arrays.conjugate(quat), np.array([0.0, 0.0, 9.80665]))
    turn = arrays.multiply(arrays.conjugate(quat[:-1]), quat[1:])
    gyr = np.vstack([np.zeros(3), 2.0 * rate * turn[:, 1:] * np.sign(turn[:, :1])])
    recording = poise.Recording.at_rate(rate, gyr, up)
    reference = poise.Attitude.of(recording.time, arrays.continuous(quat), heading_reference="arbitrary")
    error = poise.evaluate(poise.estimate(poise.Tilt(), recording), reference)
    assert np.degrees(error.inclination).max() < 3.0


def test_tilt_on_the_slow_trials() -> None:
    names = ("01_undisturbed_slow_rotation_A", "03_undisturbed_slow_rotation_C")
    names += ("05_undisturbed_slow_rotation_with_breaks_B", "11_undisturbed_slow_translation_B")
    errors = [poise.evaluate(poise.estimate(poise.Tilt(), trial(f"{n}.mat")), trial(f"{n}.mat")) for n in names]
    assert np.mean([error.rmse_deg().inclination for error in errors]) < 1.5


def test_tilt_finds_an_injected_bias_in_every_rest_of_a_real_recording() -> None:
    recording = trial("05_undisturbed_slow_rotation_with_breaks_B.mat")
    assert recording.moving is not None
    biased = replace(recording, gyr=recording.gyr + INJECTED)
    a, b = (poise.estimate(poise.Tilt(), r) for r in (biased, recording))
    ends = np.flatnonzero(np.diff(recording.moving.astype(int)) == 1)
    assert len(ends) == 4
    wrong = arrays.rotate(a.quat[ends], a.bias[ends] - b.bias[ends] - INJECTED)
    assert np.abs(wrong[:, :2]).max() < np.radians(0.1)


# -- gated ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("pitch", [76.0, 85.0])
def test_gated_holds_an_upright_phone(pitch: float) -> None:
    recording = upright(pitch, np.array([0.0, 0.0, 0.2]))

    def at_the_end(method: Any) -> float:
        attitude = poise.estimate(method, recording, start=recording.truth, rest_bias=False, guard=None)
        return float(np.degrees(poise.evaluate(attitude, recording).total[-1]))

    assert at_the_end(poise.Gated()) < 2.0
    assert at_the_end(PURE) == pytest.approx(6.0, abs=0.1)
    assert at_the_end(poise.Gated(rebuild="euler")) > 20.0, "the heading absorbs the bias by 1/cos θ"


@pytest.mark.parametrize(
    "name", ["05_undisturbed_slow_rotation_with_breaks_B.mat", "09_undisturbed_fast_rotation_with_breaks_B.mat"]
)
def test_gated_against_pure_integration(name: str) -> None:
    recording = trial(name)
    assert recording.truth is not None
    recording = recording[int(np.argmax(np.isfinite(recording.truth.quat).all(axis=1))) :]
    ours, pure = (
        poise.evaluate(poise.estimate(m, recording, start=recording.truth, rest_bias=False, guard=guarded), recording)
        for m, guarded in ((poise.Gated(), True), (PURE, None))
    )
    assert ours.rmse_deg().inclination < 0.6 * pure.rmse_deg().inclination
    assert ours.rmse_deg().heading < 1.1 * pure.rmse_deg().heading


def test_each_gate_keeps_the_correction_out() -> None:
    """A wrong lean of 10° at rest is corrected at once, or, behind any closed gate, not at all."""
    still = upright(20.0, np.array([0.0, 0.0, 1.0]), 3.0)  # turns at 1 deg/s, as far as the gyroscope says
    lean = wxyz(Rotation.from_euler("ZXY", [30.0, 30.0, 5.0], degrees=True))

    def left(method: Any, recording: poise.Recording = still) -> float:
        attitude = poise.estimate(method, recording, start=lean, rest_bias=False, guard=None)
        return float(np.degrees(poise.evaluate(attitude, recording).inclination[-1]))

    assert left(poise.Gated()) < 0.1
    assert left(poise.Gated(gate_rate=0.01)) > 8.0
    per_sample = poise.Gated(rotation_gate="per-sample")
    assert left(per_sample._replace(gate_vector=1.0001 * np.sin(np.radians(0.005)))) < 0.1
    assert left(per_sample._replace(gate_vector=0.9999 * np.sin(np.radians(0.005)))) > 8.0
    assert left(poise.Gated(pitch_window=(25.0, 35.0))) < 2.0, "the pitch before the correction counts"
    assert left(poise.Gated(pitch_window=(15.0, 25.0))) > 8.0
    pushed = replace(still, acc=1.1 * still.acc)
    assert left(poise.Gated(), pushed) > 8.0
    assert left(poise.Gated(still_gate=False), pushed) < 0.1


def test_gateds_window_of_none_is_all_of_it() -> None:
    recording = upright(40.0, np.array([0.1, 0.0, 0.0]))
    a, b = (poise.estimate(poise.Gated(pitch_window=window), recording) for window in (None, (-89.0, 89.0)))
    assert a.table.tobytes() == b.table.tobytes()
    for window in ((89.0, 75.0), (10.0, 95.0), (1.0,), 5.0, "75,89"):
        with pytest.raises(poise.PoiseError, match="pitch_window"):
            poise.estimate(poise.Gated(pitch_window=window), recording)  # type: ignore[arg-type]


def test_a_magnetometer_gives_gated_its_first_heading_only() -> None:
    recording = measure(forearm(20.0, 100.0, 1), seed=1)
    with_mag = poise.estimate(poise.Gated(), recording)
    late = recording.mag.copy()
    late[0] = np.nan
    without = poise.estimate(poise.Gated(), replace(recording, mag=late))
    assert not (without.flags & (Flag.RESET | Flag.MAG_MISSING)).any()
    apart = arrays.multiply(with_mag.quat, arrays.conjugate(without.quat))
    assert np.ptp(apart, axis=0).max() < 1e-9, "they differ by the heading they started with"
