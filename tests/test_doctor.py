"""The doctor: clean recordings are fine, mistakes are named with their fix, and what cannot be told is not claimed."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

import poise
from data_files import data_path
from poise import Recording, diagnose
from poise.data.corrections import Corrections
from poise.doctor.axes import words
from poise.doctor.turning import signed_axes
from poise.errors import RecordingError
from poise.simulation import PERFECT, Sensor, at_rest, forearm, measure, phone, robot

TRIALS = ("01_undisturbed_slow_rotation_A", "07_undisturbed_fast_rotation_B", "35_disturbed_attached_magnet_4cm")
OTHERS = ("ardrone_imu.bag", "phidgets_imu_upside_down.bag", "sparkfun_razor.bag", "x-io_fusion_sensor_data.csv")
MISTAKES: dict[str, Any] = {
    "gyr=deg/s": lambda r: {"gyr": np.degrees(r.gyr)},
    "acc=g": lambda r: {"acc": r.acc / 9.80665},
    "acc=mg": lambda r: {"acc": r.acc / 9.80665e-3},
    "time=ms": lambda r: {"time": r.time * 1e3},
    "time=us": lambda r: {"time": r.time * 1e6},
}


@pytest.fixture(scope="module")
def turned() -> Recording:
    """A made recording that turns about every axis."""
    return measure(forearm(60.0, seed=2), Sensor(), seed=2)


def names(found: poise.Diagnosis, severity: Any) -> list[str]:
    return [f.name for f in found.found(severity)]


def same_up_to_a_rotation(one: Recording, other: Recording) -> bool:
    sensors = ("gyr", "acc", "mag")
    return any(
        all(np.allclose(getattr(one, s) @ m.T, getattr(other, s), equal_nan=True) for s in sensors)
        for m in signed_axes()[:24]
    )


@pytest.mark.parametrize("name", [f"broad/{t}.mat" for t in TRIALS] + [f"other/{o}" for o in OTHERS])
def test_real_recordings_are_clean_and_their_unit_mistakes_named(name: str) -> None:
    recording = poise.read(data_path(*name.split("/")))
    found = diagnose(recording)
    assert not found.repairs and not found.found("sure") and found.options() == ""
    for option, change in MISTAKES.items():
        wrong = recording.with_samples(**change(recording))
        found = diagnose(wrong, thorough=False)
        assert found.options() == f"--units {option}", found.verdict
        np.testing.assert_allclose(found.repair(wrong).gyr, recording.gyr, rtol=1e-12)
        np.testing.assert_allclose(found.repair(wrong).time, recording.time, rtol=1e-12, atol=1e-9)


@pytest.mark.parametrize(
    ("name", "start", "seconds"),
    [
        ("25_disturbed_tapping_B", 48.0, 54.0),
        ("25_disturbed_tapping_B", 61.0, 45.0),
    ],
)
def test_a_piece_that_never_rests_is_clean(name: str, start: float, seconds: float) -> None:
    """Its slowest blocks are no rest, and their middle no bias: taken for one, rates in rad/s seemed to be in deg/s."""
    recording = poise.read(data_path("broad", f"{name}.mat"))
    first = recording.time[0] + start
    assert not names(diagnose(recording.between(first, first + seconds)), "sure")


@pytest.mark.parametrize("trial", TRIALS)
def test_renamed_axes_of_one_sensor_are_put_right(trial: str) -> None:
    recording = poise.read(data_path("broad", f"{trial}.mat"))
    rng = np.random.default_rng(int(trial[:2]))
    for sensor in ("gyr", "acc", "mag"):
        for i in rng.integers(1, 48, 4):
            matrix = signed_axes()[i]
            if sensor != "gyr" and np.array_equal(matrix, -np.eye(3)):
                continue  # a sign that the gyroscope does not see: the next test
            wrong = recording.remap(words(matrix), sensor)
            found = diagnose(wrong, thorough=False)
            assert names(found, "sure") == [f"{sensor} axes"], (words(matrix), found.verdict)
            assert same_up_to_a_rotation(found.repair(wrong), recording)


def test_a_repair_of_one_sensor_is_sure_only_where_two_wrong_ones_cannot_look_like_it(turned: Recording) -> None:
    mended = diagnose(turned.remap("y x z", "gyr"), thorough=False)
    assert mended.options() == '--remap "gyr=y x z"'
    negated = turned.remap("y x z", "gyr").remap("-x -y -z", "acc")  # the dip tells that something else is wrong, too
    found = diagnose(negated, thorough=False)
    assert (
        names(found, "sure") == ["gyr axes"]
        and not found.repairs
        and "--hemisphere south" in found.findings[0].sentence
    )
    assert diagnose(negated, thorough=False, hemisphere="south").repairs
    half = diagnose(turned.remap("-x -y z", "gyr"), thorough=False)  # as acc and mag that both lack the sign of z
    assert names(half, "sure") == ["gyr axes"] and not half.repairs
    assert 'both as "x y -z"' in half.findings[0].sentence and half.findings[0].fix.axes == {"gyr": "-x -y z"}


def test_where_one_sensor_hardly_tells_a_second_wrong_one_may_hide_in_it() -> None:
    recording = poise.read(data_path("broad", "27_disturbed_phone_vibration_B.mat"))
    wrong = recording.remap("y x -z", "gyr").remap("-x y -z", "acc")
    found = diagnose(wrong, thorough=False)
    assert names(found, "sure") and not found.repairs


@pytest.mark.parametrize("trial", TRIALS)
def test_of_two_wrong_sensors_no_sure_repair_is_wrong(trial: str) -> None:
    recording = poise.read(data_path("broad", f"{trial}.mat"))
    rng = np.random.default_rng(int(trial[:2]) + 100)
    for _ in range(12):
        (one, two), (i, j) = rng.choice(("gyr", "acc", "mag"), 2, replace=False), rng.integers(1, 24, 2)
        wrong = recording.remap(words(signed_axes()[i]), one).remap(words(signed_axes()[j]), two)
        found = diagnose(wrong, thorough=False)
        assert found.found("sure") and (not found.repairs or same_up_to_a_rotation(found.repair(wrong), recording))


@pytest.mark.parametrize("make", [forearm, phone, robot])
@pytest.mark.parametrize("seed", range(3))
def test_made_recordings_are_clean(make: Any, seed: int) -> None:
    motion = make((12.0, 30.0, 60.0)[seed], (50.0, 100.0, 200.0)[seed], seed=seed)
    found = diagnose(measure(motion, Sensor(mag_delay=0.0), seed=seed))
    assert not found.repairs and not found.found("sure"), found.findings


def test_axes_and_units_at_once(turned: Recording) -> None:
    wrong = turned.with_samples(gyr=np.degrees(turned.gyr), acc=turned.acc / 9.80665).remap("-x z y", "gyr")
    found = diagnose(wrong)
    assert found.options() == '--units acc=g,gyr=deg/s --remap "gyr=-x z y"'
    assert same_up_to_a_rotation(found.repair(wrong), turned)


@pytest.mark.parametrize(
    "mistake",
    [
        {"acc": "y -x z", "mag": "x z -y"},
        {"acc": "y z x", "mag": "-y x z"},
        {"acc": "y x z", "mag": "x z y"},
        {"gyr": "y x z", "mag": "y -x z"},  # a mirror image: the gyroscope's, whatever else
        {"gyr": "-x y z", "acc": "x z -y"},
        {"gyr": "y z x", "acc": "-x -y z"},
    ],
)
def test_the_axes_of_two_renamed_sensors_are_named(turned: Recording, mistake: dict[str, str]) -> None:
    wrong = Corrections(axes=mistake).apply(turned.with_samples(gyr=np.degrees(turned.gyr)))
    found = diagnose(wrong)
    assert names(found, "sure") == ["gyr unit", "axes"]
    axes = found.found("sure")[1]
    assert not axes.decided and "not all of it" in found.verdict  # no motion tells the sign that force and field share
    assert "both have the other sign" in axes.sentence
    fixed = axes.fix.apply(found.repair(wrong))
    negated = fixed.remap("-x -y -z", "acc").remap("-x -y -z", "mag")
    assert same_up_to_a_rotation(fixed, turned) or same_up_to_a_rotation(negated, turned)


def test_a_rotation_of_all_sensors_is_no_fault(turned: Recording) -> None:
    found = diagnose(turned.remap("y z x"))
    assert (not found.found("sure") and not found.found("likely")) or names(found, "likely") == ["mag delay"]


@pytest.mark.parametrize("sensor", ["acc", "mag"])
def test_a_common_sign_is_likely_never_sure(turned: Recording, sensor: str) -> None:
    found = diagnose(turned.remap("-x -y -z", sensor))
    assert "acc sign" in names(found, "likely") and not found.repairs
    assert "acc sign" in names(diagnose(turned, hemisphere="south"), "likely")
    assert "acc sign" not in names(diagnose(turned.remap("-x -y -z", sensor), hemisphere="south"), "likely")


def test_the_hemisphere_decides_the_sign_of_renamed_axes(turned: Recording) -> None:
    wrong = turned.remap("-y x z", "acc")
    assert same_up_to_a_rotation(diagnose(wrong).repair(wrong), turned)
    south = diagnose(wrong, hemisphere="south").repair(wrong)
    np.testing.assert_allclose(south.acc, -turned.acc)


def test_without_a_magnetometer_the_wrong_sensor_cannot_be_told(turned: Recording) -> None:
    alone = turned.with_samples(mag=np.full_like(turned.mag, np.nan))
    assert not diagnose(alone).found("sure")
    found = diagnose(alone.remap("y -x z", "acc"))
    assert names(found, "sure") == ["axes"] and not found.repairs
    assert "without a magnetometer" in found.findings[0].sentence


def test_rest_cannot_tell_and_gravity_free_acceleration_is_named() -> None:
    still = measure(at_rest(duration=30.0), Sensor(), seed=1)
    found = diagnose(still)
    assert "axes" in names(found, "cannot-tell") and not found.found("sure")
    assert diagnose(still.remap("y -x z", "acc")).found("sure") == ()
    free = diagnose(still.with_samples(acc=still.acc - still.acc.mean(axis=0)))
    assert names(free, "sure") == ["acc gravity"] and not free.repairs


def test_a_swing_is_no_fault() -> None:
    """A sensor on a rope feels a force along the rope only: axes that turn about the rope would "explain" it."""
    time = np.arange(6000) / 100.0
    angle, rate = 0.6 * np.sin(1.5 * time), 0.9 * np.cos(1.5 * time)
    rng = np.random.default_rng(0)
    gyr = np.column_stack([rate, 0 * rate, 0 * rate]) + 0.002 * rng.standard_normal((6000, 3))
    acc = np.column_stack([0 * rate, 0 * rate, 9.81 * np.cos(angle) + 3.0 * rate**2]) + 0.03 * rng.standard_normal(
        (6000, 3)
    )
    assert not diagnose(Recording(time, gyr, acc), thorough=False).found("sure")


@pytest.mark.parametrize("late", [-0.02, 0.0, 0.03])
def test_a_late_magnetometer_is_measured_and_put_right(late: float) -> None:
    recording = measure(forearm(60.0, 200.0, seed=4), Sensor(mag_delay=0.0), seed=4).advance(mag=-late)
    found = next(f for f in diagnose(recording).findings if f.name == "mag delay")
    if late == 0.0:
        assert not found.fix
        return
    assert found.severity == "likely" and found.fix.delays["mag"] == pytest.approx(late, abs=0.003)
    again = next(f for f in diagnose(found.fix.apply(recording)).findings if f.name == "mag delay")
    assert not again.fix


def test_what_the_samples_show(turned: Recording) -> None:
    acc, mag = turned.acc.copy(), turned.mag + np.array([30.0, 0.0, 0.0])
    acc[1000:1100] = acc[1000]
    gyr = np.clip(turned.gyr, -0.5, 0.5)
    keep = np.ones(len(turned), bool)
    keep[3000:3100] = False
    found = diagnose(turned.with_samples(acc=acc, mag=mag, gyr=gyr)[keep])
    told = {f.name: f.sentence for f in found.findings}
    assert "1.0" in told["acc stuck"] or "0.99" in told["acc stuck"]
    assert "cut off" in told["gyr clipped"] and "1 gap" in told["gaps"]
    iron = diagnose(turned.with_samples(mag=mag))
    assert "hard iron" in names(iron, "likely")
    rest = next(f for f in iron.findings if f.name == "rest")
    assert "gyroscope bias" in rest.sentence and "begins at rest" in rest.sentence


def hostile() -> dict[str, Recording]:
    base = measure(phone(20.0, seed=3), Sensor(), seed=3)
    n, rng = len(base), np.random.default_rng(0)
    nothing = np.full((n, 3), np.nan)
    flat = np.tile([0.0, 0.0, 9.8], (n, 1))
    return {
        "empty": base[:0],
        "one row": base[:1],
        "two rows": base[:2],
        "half a second": base[:50],
        "nothing": Recording(base.time, nothing, nothing),
        "no acc": base.with_samples(acc=nothing),
        "no gyr": base.with_samples(gyr=nothing),
        "constant": Recording(base.time, np.zeros((n, 3)), flat, flat),
        "zeros": Recording(base.time, np.zeros((n, 3)), np.zeros((n, 3)), np.zeros((n, 3))),
        "wild": base.with_samples(gyr=np.where(rng.random((n, 3)) < 0.01, 1e300, base.gyr)),
        "infinite": base.with_samples(acc=np.where(rng.random((n, 3)) < 0.01, np.inf, base.acc)),
        "one time": base.with_samples(time=np.zeros(n)),
        "repeated stamps": base.with_samples(time=np.repeat(base.time[::2], 2)[:n]),
        "jump": base.with_samples(time=base.time + 1e12 * (np.arange(n) > n // 2)),
        "no times": base.with_samples(time=np.full(n, np.nan)),
        "20 Hz": measure(robot(20.0, 20.0), Sensor(), seed=1),
        "2 kHz": measure(phone(5.0, 2000.0), Sensor(), seed=1),
        "perfect rest": measure(at_rest(), PERFECT),
    }


@pytest.mark.parametrize("name", [*hostile()])
def test_nothing_breaks_the_doctor(name: str) -> None:
    recording = hostile()[name]
    found = diagnose(recording)
    assert found.verdict and not found.repairs
    assert len(found.repair(recording)) == len(recording)
    unusable = {"empty", "nothing", "no acc", "no gyr", "one time", "no times", "zeros"}
    assert bool(found.found("sure")) == (name in unusable)


@pytest.mark.parametrize(("share", "severity"), [(0.01, "note"), (0.04, "note"), (0.08, "likely")])
def test_a_hard_iron_is_told_with_what_to_expect(turned: Recording, share: float, severity: str) -> None:
    """What is advised makes the heading better: the flagship expects a calibrated magnetometer."""
    iron = share * np.linalg.norm(turned.mag[0]) / np.sqrt(3.0)
    magnetic = turned.with_samples(
        mag=measure(forearm(60.0, seed=2), PERFECT, seed=2).mag + iron * np.array([1, -1, 1])
    )
    found = next(finding for finding in diagnose(magnetic).findings if finding.name == "hard iron")
    assert found.severity == severity
    advised = re.search(r"--set initial_iron=([0-9.]+)\)", found.sentence)
    assert bool(advised) == (share > 0.03)
    if advised:
        assert float(advised[1]) == pytest.approx(share / np.sqrt(3.0), rel=0.2)
        told = poise.SelfCalibrating(initial_iron=float(advised[1]))
        errors = [
            poise.evaluate(poise.estimate(m, magnetic), magnetic).rmse_deg() for m in (poise.SelfCalibrating(), told)
        ]
        assert errors[1].heading < 0.7 * errors[0].heading


def test_one_sensor_is_renamed_or_set_earlier(turned: Recording) -> None:
    mirrored = turned.remap("-x y z", "acc")
    np.testing.assert_array_equal(mirrored.acc, turned.acc * [-1, 1, 1])
    np.testing.assert_array_equal(mirrored.gyr, turned.gyr)
    earlier = turned.advance(mag=0.05)
    np.testing.assert_array_equal(earlier.mag[:-5], turned.mag[5:])
    assert np.all(np.abs(earlier.mag_age[:-5]) < 0.006)
    for problem in (
        lambda: turned.remap("x y z", "baro"),
        lambda: turned.advance(gyr=0.1),
        lambda: turned.advance(mag=5.0),
    ):
        with pytest.raises(RecordingError):
            problem()
    with pytest.raises(RecordingError, match="left-handed"):
        turned.remap("-x y z")
