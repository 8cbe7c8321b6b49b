"""The benchmarks: the comparison with stored figures finds what is worse, and what is timed is the same work."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from data_files import data_path
from helpers import wxyz
from poise import AdaptiveGain, Attitude, Recording, TwoStage, estimate
from poise.data.flags import LOST
from poise.math import arrays
from poise.peers import PEERS, installed
from poise.simulation import PERFECT, Motion, Sensor, Triad, at_rest, forearm, measure

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

import accuracy
import conditions
import scores
import speed
import vehicles
import worlds
from scores import Score
from stacked import Stacked
from studies import block_means
from tables import Cell, table

# -- accuracy ---------------------------------------------------------------------------------------------------------

STORED = {"filter": {trial: Score(2.0, 1.8, 0.8, False, 0) for trial in ("01_a", "03_b", "05_c", "07_d")}}


def changed(**trials: Score | None) -> list[str]:
    """What the comparison says when some trials of STORED come out otherwise; None for not at all."""
    measured = STORED["filter"] | {f"{name[1:]}": s for name, s in trials.items()}
    return scores.compare(STORED, {"filter": {trial: s for trial, s in measured.items() if s is not None}})


def total(value: float) -> Score:
    return STORED["filter"]["01_a"]._replace(total=value)


def test_better_and_half_a_percent_worse_pass() -> None:
    assert changed() == []
    assert changed(_01_a=total(1.0), _03_b=total(2.01)) == []


def test_two_percent_worse_is_named() -> None:
    (sentence,) = changed(_01_a=total(1.0), _05_c=total(2.04))
    assert "05_c" in sentence
    assert "+2.0%" in sentence


def test_what_is_missing_is_named() -> None:
    (sentence,) = changed(_03_b=None)
    assert "03_b" in sentence
    assert "not measured" in sentence
    assert len(scores.compare(STORED, {})) == 4
    assert scores.compare({}, STORED) == []  # new methods have nothing to be compared with


def test_losing_the_attitude_is_worse_however_small_the_error() -> None:
    better = total(1.0)
    assert len(changed(_01_a=better._replace(diverged=True))) == 1
    assert len(changed(_01_a=better._replace(missing=5))) == 1
    assert len(changed(_01_a=total(float("nan")))) == 1


def test_a_little_on_every_trial_is_worse_in_the_mean() -> None:
    slight = {f"_{trial}": total(2.016) for trial in STORED["filter"]}
    sentences = changed(**slight)
    assert sentences == [f"filter, mean of {half}: 2.000° → 2.016° (+0.8%)" for half in ("all", "chosen", "held-out")]


def test_means_are_over_the_halves() -> None:
    trials = {"01_a": total(1.0), "03_b": total(4.0), "05_c": total(2.0)}
    means = scores.means(trials, scores.halves(trials))
    assert [means[half]["total"] for half in ("all", "chosen", "held-out")] == pytest.approx([7 / 3, 1.5, 4.0])
    assert not scores.CHOSEN & scores.HELD_OUT
    assert "held-out" not in scores.halves(["01_a"])


def test_groups_come_from_the_words_of_a_trials_name() -> None:
    names = [
        "01_undisturbed_slow_rotation_A",
        "09_undisturbed_fast_rotation_with_breaks_B",
        "21_undisturbed_fast_combined",
        "27_disturbed_phone_vibration_B",
        "29_disturbed_stationary_magnet_B",
        "33_disturbed_attached_magnet_2cm",
    ]
    assert {group: [int(name[:2]) for name in members] for group, members in scores.groups(names).items()} == {
        "slow": [1],
        "fast": [9, 21],
        "rotation": [1, 9],
        "combined": [21],
        "undisturbed": [1, 9, 21],
        "vibration": [27],
        "stationary magnet": [29],
        "attached magnet": [33],
    }


# A method without a magnetometer's heading.
LEANING = {trial: Score(None, None, 2.0, False, 0) for trial in ("01_slow_a", "03_fast_b")}


def test_a_method_without_heading_is_judged_by_its_inclination() -> None:
    worse = {"tilt": LEANING | {"03_fast_b": Score(None, None, 2.1, False, 0)}}
    assert scores.compare({"tilt": LEANING}, worse)[0] == "tilt on 03_fast_b: 2.000° → 2.100° (+5.0%)"
    assert scores.compare({"tilt": LEANING}, {"tilt": LEANING}) == []
    other = {"tilt": {trial: Score(2.5, 1.5, 2.0, False, 0) for trial in LEANING}}
    assert "heading" in scores.compare({"tilt": LEANING}, other)[0]
    report = accuracy.report(STORED | {"tilt": LEANING}, markdown=False)
    assert "-/-/2.000" in report
    assert (
        " ".join(next(line for line in report.splitlines() if "01_slow_a" in line).split()[:4]) == "01_slow_a - - 2.000"
    )
    assert scores.document({"tilt": LEANING})["results"]["tilt"]["groups"]["fast"]["total"] is None


def test_a_heading_that_drifts_is_no_divergence_without_one() -> None:
    made = measure(at_rest(duration=40.0), PERFECT)
    attitude = Attitude.of(made.time, arrays.turn_about_up(made.time * 0.1))
    whole, leaning = (scores.score(attitude, made, has_heading) for has_heading in (True, False))
    assert whole.diverged
    assert leaning.total is leaning.heading is None
    assert leaning.inclination == pytest.approx(0.0, abs=1e-6)
    assert not leaning.diverged
    fallen = Attitude.of(made.time, np.tile([0.5, 0.8, 0.0, 0.0], (len(made), 1)))
    assert scores.score(fallen, made, False).diverged


def test_what_has_a_heading_is_known_from_its_fields() -> None:
    class Tilt(NamedTuple):
        gain: float = 1.0

    assert all(accuracy.has_heading(c) for c in (TwoStage(), AdaptiveGain(), PEERS["vqf"]))
    assert not accuracy.has_heading(Tilt())


def test_two_at_a_time_find_the_same_to_the_bit() -> None:
    names = ("01_undisturbed_slow_rotation_A", "33_disturbed_attached_magnet_2cm")
    files = [data_path("broad", f"{name}.mat") for name in names]
    contenders = {"adaptive-gain": AdaptiveGain()} | ({"vqf": PEERS["vqf"]} if installed("vqf") else {})
    assert accuracy.measure(files, contenders, jobs=2) == accuracy.measure(files, contenders)


def test_figures_are_stored_and_read_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scores, "RESULTS", tmp_path)
    accuracy.store("accuracy.json", scores.document(STORED))
    assert scores.load(tmp_path / "accuracy.json") == STORED
    assert accuracy.check(STORED) == 0
    assert accuracy.check({"filter": {}}) == 1
    report = accuracy.report(STORED, markdown=True)
    assert "| mean, chosen " in report


def test_a_peer_is_compared_with_the_same_release_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(scores, "RESULTS", tmp_path)
    trials = STORED["filter"]
    worse = {name: s._replace(total=3.0) for name, s in trials.items()}
    facts = {name: {"version": "1.0"} for name in ("vqf", "imufusion")}
    accuracy.store("accuracy.json", scores.document(STORED))
    accuracy.store("peers.json", scores.document({"vqf": trials, "imufusion": trials}, facts))

    monkeypatch.setattr(accuracy, "installed", lambda package: "1.0")
    assert accuracy.check(STORED, {"vqf": trials, "ahrs-ekf": trials, "imufusion": trials}) == 0
    assert "ahrs-ekf is not in the stored table" in capsys.readouterr().err
    assert accuracy.check(STORED, {"vqf": worse, "imufusion": trials}) == 1
    assert "WORSE vqf on 01_a: 2.000° → 3.000° (+50.0%)" in capsys.readouterr().err
    assert accuracy.check(STORED, {"vqf": trials}) == 0  # imufusion was left out

    monkeypatch.setattr(accuracy, "installed", lambda package: "1.1" if package == "vqf" else "1.0")
    assert accuracy.check(STORED, {"vqf": worse, "imufusion": trials}) == 0
    assert "vqf: stored with release 1.0, measured with 1.1: not compared" in capsys.readouterr().err


@pytest.mark.parametrize(("ci", "code"), [("", 0), ("true", 1)])
def test_without_recordings_it_says_so(ci: str, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("POISE_DATA", str(tmp_path))
    monkeypatch.setenv("CI", ci)
    assert accuracy.main([]) == code


# -- speed ------------------------------------------------------------------------------------------------------------


def test_one_stacked_update_is_the_two_stages() -> None:
    made = measure(forearm(6.0, 100.0, seed=3), Sensor(mag_rate=20.0))
    two = TwoStage(decouple=False)
    stacked, staged = (estimate(each, made, guard=None, rest_bias=False) for each in (Stacked(two), two))
    np.testing.assert_allclose(stacked.quat, staged.quat, rtol=0, atol=1e-9)
    np.testing.assert_allclose(stacked.sigma, staged.sigma, rtol=1e-6)
    np.testing.assert_array_equal(stacked.flags, staged.flags)
    assert stacked.heading_reference == staged.heading_reference


def test_contenders_take_turns() -> None:
    order: list[str] = []
    runs: dict[str, speed.Run] = {"a": lambda: order.append("a"), "b": lambda: order.append("b")}
    timings = speed.interleaved(speed.Group("", "ns", 0, 1, runs), rounds=3)
    assert order == ["a", "b"] * 4  # the first turn is not counted
    assert timings["a"].ratio_of_least == timings["a"].median_ratio == 1.0


def torque(quat: ArrayLike, rate: ArrayLike) -> NDArray[np.float64]:
    attitude = Attitude.of([0.0], np.array([quat], float))
    attitude.rate[:] = rate
    return np.array(speed.torque(attitude))


def test_the_torque_turns_to_the_target_and_damps() -> None:
    target = Rotation.from_quat(speed.TARGET, scalar_first=True)
    np.testing.assert_allclose(torque(speed.TARGET, [0.0, 0.0, 0.0]), 0.0, atol=1e-12)
    np.testing.assert_allclose(torque(speed.TARGET, [1.0, -2.0, 3.0]), -speed.DAMPING * np.array([1.0, -2.0, 3.0]))
    away = np.array([0.02, -0.01, 0.03])
    for sign in (1.0, -1.0):  # q and −q are one attitude
        pull = torque(sign * wxyz(target * Rotation.from_rotvec(away)), [0.0, 0.0, 0.0])
        np.testing.assert_allclose(pull, -0.5 * speed.STIFFNESS * away, rtol=1e-3)


def test_tables_line_up() -> None:
    rows: list[list[Cell]] = [["a", 1.0, None], ["long", 22.5, 3]]
    assert table(["", "x", "n"], rows, digits=1) == "         x  n\na      1.0  -\nlong  22.5  3"
    assert table(["", "x"], [["a", 1.0]], markdown=True).splitlines()[1] == "| - | ----: |"


def test_block_means_keep_the_centre() -> None:
    """Averaging three samples: values are means, stamps and reference those of the middle one."""
    made = measure(forearm(4.0, 90.0), PERFECT)
    recording = Recording(
        made.time, made.gyr, made.acc, made.mag, truth=made.truth, moving=np.ones(len(made), dtype=bool)
    )
    third = block_means(recording, 3)
    assert len(third) == len(recording) // 3
    np.testing.assert_array_equal(third.time, recording.time[1::3][: len(third)])
    np.testing.assert_allclose(third.gyr[0], recording.gyr[:3].mean(axis=0))
    assert third.truth is not None
    assert recording.truth is not None
    np.testing.assert_array_equal(third.truth.quat[0], recording.truth.quat[1])


# -- worlds -----------------------------------------------------------------------------------------------------------


def test_the_lag_of_an_output_behind_the_motion_is_found() -> None:
    time = np.arange(2000) / 200
    turned = arrays.turn_about_up(np.sin(3 * time) + 0.5 * np.sin(11 * time))
    late = arrays.turn_about_up(np.sin(3 * (time - 0.0105)) + 0.5 * np.sin(11 * (time - 0.0105)))
    errors = [worlds._rmse(late, turned, 200 * shift) for shift in np.arange(0.0, 0.0301, 0.0005)]
    assert int(np.argmin(errors)) == 21
    assert errors[21] < 0.05
    assert errors[0] > 1.0


def test_a_sensor_without_some_of_its_errors_keeps_the_others() -> None:
    whole = worlds.part(worlds.PART)
    assert whole.mag is not None
    no_iron = worlds.without(whole, "iron")
    assert no_iron.mag is not None
    assert (no_iron.mag.bias, no_iron.mag.noise, no_iron.gyr) == (0.0, whole.mag.noise, whole.gyr)
    assert worlds.without(whole, "gyroscope").gyr == Triad()
    assert worlds.without(whole, "accelerometer").mag == whole.mag


# -- vehicles and worse sensors ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("motion", "push"),
    [
        (vehicles.circling(0.8, 5.0, 1), 0.8**2 * 5.0),
        (vehicles.car(1), 12.0 * 0.35),
        (vehicles.weaving(0.3, 1), 3.0),
        (vehicles.weaving(0.0, 1), 0.0),
    ],
)
def test_a_vehicle_is_pushed_as_it_goes_and_ends_where_it_stands(motion: Motion, push: float) -> None:
    recording = measure(motion, PERFECT)
    force = arrays.rotate(motion.quat, recording.acc)[:, :2]
    np.testing.assert_allclose(force, motion.acceleration[:, :2], atol=1e-6)
    slow = np.column_stack([np.convolve(axis, np.ones(100) / 100.0, "same") for axis in motion.acceleration.T])
    ahead = arrays.rotate(arrays.conjugate(motion.quat), slow)
    assert np.abs(ahead[:, 0]).max() == pytest.approx(push, abs=0.3)
    assert not np.linalg.norm(motion.acceleration[-500:], axis=1).any()
    np.testing.assert_allclose(motion.rate, recording.gyr, atol=0.005)
    np.testing.assert_allclose(motion.acceleration.sum(axis=0) / vehicles.RATE, 0.0, atol=0.1)  # m/s


def test_a_slower_accelerometer_has_its_samples_where_it_gives_them() -> None:
    rows = np.arange(21.0).reshape(7, 3)
    assert conditions.repeated(rows, 3)[:, 0].tolist() == [0.0, 0.0, 0.0, 9.0, 9.0, 9.0, 18.0]
    assert np.flatnonzero(np.isfinite(conditions.single(rows, 3)[:, 0])).tolist() == [0, 3, 6]
    np.testing.assert_array_equal(conditions.means(rows, 3)[:, 0], [np.nan, np.nan, 3.0, np.nan, np.nan, 12.0, np.nan])


def test_what_sigma_does_not_cover_is_counted_where_the_rows_are_valid() -> None:
    made = measure(at_rest(duration=4.0), PERFECT)
    attitude = Attitude.of(made.time, arrays.turn_about_up(np.full(len(made), 0.1)))
    attitude.sigma[:] = 0.05, 0.05, 0.03
    attitude.sigma[:100, 2] = 0.04
    attitude.flags[200:] = LOST
    share = np.nanmean(conditions.outside(attitude, made), axis=0)
    np.testing.assert_allclose(share, [0.5, 0.0, 0.5])


def test_a_bias_is_known_once_it_is_right_for_ten_seconds() -> None:
    still = conditions.stepped(measure(vehicles.circling(0.5, 0.0, 0, seconds=90.0), Sensor(), seed=0), 2.0)
    assert still.moving is not None
    assert not still.moving[still.time < conditions.STEP].any()
    assert 0.0 < conditions.until_known(still, 2.0) < 20.0
    assert conditions.until_known(still, 4.0) == np.inf
