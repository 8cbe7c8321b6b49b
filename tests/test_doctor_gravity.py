"""The accelerometer: gravity that is not there, samples that are the gyroscope's, and a length that is not gravity's."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import poise
from data_files import trial
from poise import Recording, diagnose
from poise.cli import run
from poise.doctor.axes import words
from poise.doctor.turning import signed_axes
from poise.math import arrays
from poise.simulation import Sensor, Triad, at_rest, forearm, measure

G = 9.80665


def without_gravity(recording: Recording) -> Recording:
    assert recording.truth is not None
    up = arrays.rotate(arrays.conjugate(recording.truth.quat), np.array([0.0, 0.0, G]))
    return recording.with_samples(acc=recording.acc - up)


def alone(recording: Recording) -> Recording:
    return recording.with_samples(mag=np.full_like(recording.mag, np.nan))


def sure(recording: Recording) -> list[str]:
    return [f.name for f in diagnose(recording, thorough=False).found("sure")]


def test_gravity_that_is_absent_in_a_pause() -> None:
    """In motion what is left has the length of gravity."""
    recording = trial("21_undisturbed_fast_combined", 20.0, 60.0)
    wrong = without_gravity(recording)
    assert 6.0 < np.nanmedian(np.linalg.norm(wrong.acc, axis=1)) < G
    for each, right in ((wrong, recording), (alone(wrong), alone(recording))):
        (found,) = diagnose(each).found("sure")
        assert found.name == "acc gravity" and "add the columns of gravity" in found.sentence and not found.fix
        assert not sure(right)


def test_gravity_that_is_absent_without_a_pause() -> None:
    """The field tells how the sensor turns, and nothing of gravity's length stands still."""
    for name, start in (("15_undisturbed_fast_translation_A", 60.0), ("21_undisturbed_fast_combined", 60.0)):
        recording = trial(name, start, start + 60.0)
        assert sure(without_gravity(recording)) == ["acc gravity"]
        assert not sure(recording)
        for matrix in signed_axes()[[5, 30]]:  # axes that are wrong, too: gravity stands still in others
            assert "acc gravity" not in sure(recording.remap(words(matrix), "acc"))


def test_a_sensor_that_fails_for_a_while_has_gravity() -> None:
    recording = trial("07_undisturbed_fast_rotation_B", 0.0, 60.0)
    for factor in (0.0, 0.01):
        acc = recording.acc.copy()
        acc[8000:10000] *= factor  # 7 s
        assert "acc gravity" not in sure(recording.with_samples(acc=acc))


def test_a_slow_clock_is_no_calm() -> None:
    """Half a second that passes for five: in a fast motion to and fro the force is short for so long."""
    piece = trial("15_undisturbed_fast_translation_A", 45.0, 60.0)[::8]
    slow = piece.with_samples(time=10.0 * piece.time)
    found = diagnose(slow, read_as={"time": "ms"}, guessed={"time"}, thorough=False)
    assert "acc gravity" not in [f.name for f in found.findings]


def test_what_hides_that_gravity_is_absent_is_not_taken_for_axes() -> None:
    """No pause, no magnetometer: an acceleration to and fro stands still better in other axes, and not well."""
    assert not sure(alone(without_gravity(trial("15_undisturbed_fast_translation_A", 60.0, 120.0))))


def test_what_hides_that_gravity_is_absent_is_no_evidence_of_a_unit() -> None:
    """What shakes shows no turn, and so none that the rates claim."""
    assert not sure(alone(without_gravity(trial("21_undisturbed_fast_combined", 45.0, 90.0))))


def test_it_is_refused_and_can_be_forced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    wrong = without_gravity(trial("21_undisturbed_fast_combined", 20.0, 60.0))
    poise.write(wrong, tmp_path / "lin.csv")
    told = ["estimate", str(tmp_path / "lin.csv"), "-m", "tilt", "-o", str(tmp_path / "out.csv")]
    assert run(told) == 1
    assert "gravity was removed" in capsys.readouterr().err
    assert run([*told, "--force"]) == 0


@pytest.mark.parametrize("units", [(1.0, 1.0), (np.pi / 180, G)])
def test_gyroscope_and_accelerometer_exchanged(units: tuple[float, float]) -> None:
    """As when columns are named in the wrong order, in whatever units they are then read."""
    made = measure(forearm(60.0, seed=2), Sensor(), seed=2)
    for right in (made, alone(made), trial("05_undisturbed_slow_rotation_with_breaks_B", 20.0, 80.0)):
        swapped = right.with_samples(gyr=right.acc * units[0], acc=right.gyr * units[1])
        named = {"gyr": "rad/s" if units[0] == 1.0 else "deg/s", "acc": "m/s²" if units[1] == 1.0 else "g"}
        found = diagnose(swapped, read_as=named)
        assert [f.name for f in found.found("sure")] == ["gyr and acc"] and not found.repairs
        assert "exchanged: name the columns the other way round" in found.findings[0].sentence


def test_a_resting_sensor_is_not_exchanged() -> None:
    still = measure(at_rest(duration=30.0), Sensor(), seed=1)
    for each in (still, still.with_samples(gyr=still.acc, acc=still.gyr)):  # nothing turns: gravity is missed, no more
        assert "gyr and acc" not in sure(each)


@pytest.mark.parametrize("factor", [0.96, 1.04])
def test_an_accelerometer_of_another_scale_comes_with_what_mends_it(factor: float) -> None:
    recording = trial("21_undisturbed_fast_combined", 0.0, 100.0)
    wrong = recording.with_samples(acc=recording.acc * factor)
    assert not [f for f in diagnose(recording).findings if f.name == "acc scale"]
    (found,) = (f for f in diagnose(wrong).findings if f.name == "acc scale")
    assert found.severity == "likely" and f"{abs(factor * 1.0017 - 1):.1%}" in found.sentence
    gravity = float(found.sentence.split("--set gravity=")[1])
    assert gravity == pytest.approx(factor * G, rel=5e-3)
    learns = poise.estimate(poise.SelfCalibrating(), wrong)
    assert learns.learned is not None and abs(learns.learned["acc_scale"]["value"] - (G / gravity - 1.0)) < 0.003
    told = poise.estimate(poise.TwoStage(gravity=gravity), wrong)
    as_it_was = poise.estimate(poise.TwoStage(), recording)
    totals = [poise.evaluate(attitude, wrong).rmse_deg().total for attitude in (told, as_it_was)]
    assert totals[0] == pytest.approx(totals[1], rel=0.02)


def test_scale_and_offset_are_told_apart_by_resting_twice() -> None:
    still = measure(at_rest(duration=10.0), Sensor(acc=Triad(noise=0.002)), seed=1)
    acc = np.concatenate([still.acc, -still.acc])
    twice = Recording(np.arange(len(acc)) * 0.01, np.concatenate([still.gyr, still.gyr]), acc)
    for changed, says in (
        (1.05 * acc, "attitudes up to 180° apart: its scale is off; self-calibrating learns that"),
        (acc + np.array([2.5, 0.0, 0.3]), "longer one way up than another"),
    ):
        (found,) = (f for f in diagnose(twice.with_samples(acc=changed)).findings if f.name == "acc scale")
        assert says in found.sentence
