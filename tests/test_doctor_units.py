"""Units that nobody named: the doctor decides them by evidence, or leaves the choice, and never takes one for granted."""

from __future__ import annotations

import json
import shlex
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poise
from data_files import data_path, trial
from poise import Recording, diagnose
from poise.cli import run
from poise.simulation import Sensor, at_rest, forearm, measure

GUESSED = {"time", "gyr", "acc"}
DEGREE = np.pi / 180


@pytest.fixture(scope="module")
def turned() -> Recording:
    return measure(forearm(60.0, seed=2), Sensor(mag_delay=0.0), seed=2)


def on_the_floor(top: float) -> Recording:
    """Turning this way and that on a level floor, *top* in the gyroscope's unit: gravity shows nothing of it."""
    time, rng = np.arange(6000) * 0.01, np.random.default_rng(0)
    rate = np.where((time > 10) & (time < 50), top * np.sign(np.sin(time / 5)), 0.0)
    gyr = np.column_stack([0 * time, 0 * time, rate]) + 0.1 * rng.standard_normal((6000, 3))
    return Recording(time, gyr, [0.0, 0.0, 9.81] + 0.03 * rng.standard_normal((6000, 3)))


def sure(found: poise.Diagnosis) -> list[str]:
    return [f.name for f in found.found("sure")]


def test_a_unit_that_nobody_named_and_nothing_shows_is_a_choice() -> None:
    found = diagnose(on_the_floor(30.0), guessed=GUESSED)
    (untold,) = found.untold
    assert (untold.name, untold.severity) == ("gyr unit", "cannot-tell") and not found.repairs
    assert [choice.factors["gyr"] for choice in untold.choices] == [1.0, pytest.approx(DEGREE)]
    assert "in deg/s it turned 1199° in all, and by 30.2 °/s at most" in untold.sentence
    assert found.verdict == "cannot tell: gyr unit; say --units gyr=rad/s or --units gyr=deg/s"
    assert not any(f.name == "rest" for f in found.findings)  # whether it rests is a matter of the unit
    assert not diagnose(on_the_floor(30.0)).untold  # a unit that somebody named


def test_no_sensor_turns_16_times_a_second_about_itself() -> None:
    found = diagnose(on_the_floor(300.0), guessed=GUESSED)
    assert sure(found) == ["gyr unit"] and found.repairs.factors == {"gyr": pytest.approx(DEGREE)}
    counts = on_the_floor(300.0)
    counts = counts.with_samples(gyr=np.round(counts.gyr))  # raw ones of any size look so, too
    assert not sure(diagnose(counts, guessed=GUESSED)) and diagnose(counts, guessed=GUESSED).untold


def test_evidence_decides_what_nobody_named(turned: Recording) -> None:
    assert not diagnose(turned, guessed=GUESSED).untold and not sure(diagnose(turned, guessed=GUESSED))
    degrees = diagnose(turned.with_samples(gyr=np.degrees(turned.gyr)), guessed=GUESSED)
    assert degrees.options() == "--units gyr=deg/s" and not degrees.untold


@pytest.mark.parametrize("rate", [50.0, 100.0, 200.0])
@pytest.mark.parametrize("unit", [1.0, DEGREE])
def test_a_clock_that_was_guessed_is_told_from_the_gyroscope(rate: float, unit: float) -> None:
    """Stamps in steps of 0.1 ms, taken for ms: the gyroscope seems to be ten times too fast, or in deg/s."""
    right = measure(forearm(60.0, rate, seed=2), Sensor(mag_delay=0.0, jitter=0.0), seed=2)
    wrong = right.with_samples(time=10.0 * right.time, gyr=right.gyr / unit)
    found = diagnose(wrong, read_as={"time": "ms"}, guessed={"time", "gyr"}, thorough=False)
    assert found.repairs.factors["time"] == pytest.approx(0.1)
    assert found.repairs.factors.get("gyr", 1.0) == pytest.approx(unit)
    assert "time=100us" in found.options() and "the clock is too slow" in found.findings[0].sentence
    np.testing.assert_allclose(found.repair(wrong).gyr, right.gyr)


def test_a_clock_far_off_is_told_by_its_own_blocks(turned: Recording) -> None:
    fast = turned.with_samples(time=turned.time / 100.0)
    found = diagnose(fast, read_as={"time": "us"}, guessed={"time", "gyr"}, thorough=False)
    assert found.options() == "--units time=100us"


def test_stamps_in_no_usual_unit_are_told_by_the_gyroscope(turned: Recording) -> None:
    """Steps of 100: 10 Hz in ms, 10 kHz in µs, and 100 Hz in units of 0.1 ms."""
    wrong = turned.with_samples(time=np.round(1e4 * turned.time))
    assert diagnose(wrong, thorough=False).options() == "--units time=100us"
    still = measure(at_rest(duration=30.0), Sensor(jitter=0.0), seed=1)
    found = diagnose(still.with_samples(time=np.round(1e4 * still.time)), thorough=False)
    assert sure(found) == ["time unit"] and not found.repairs
    assert [choice.factors["time"] for choice in found.untold[0].choices] == [1e-3, 1e-4, 1e-6]


def test_nothing_turns_is_not_sure_of_deg_s_with_a_guessed_clock() -> None:
    """A gyroscope that claims too much is in deg/s, or its clock is slow: only a clock that is known decides."""
    piece = trial("05_undisturbed_slow_rotation_with_breaks_B", 20.0, 35.0)[::8]  # as 36 Hz of ms, or 360 Hz of 0.1 ms
    noisy = piece.with_samples(gyr=np.degrees(piece.gyr))
    assert diagnose(noisy, guessed={"gyr"}, thorough=False).options() == "--units gyr=deg/s"
    found = diagnose(noisy, read_as={"time": "ms"}, guessed={"time", "gyr"}, thorough=False)
    assert not found.repairs and found.untold
    assert {"time": pytest.approx(0.1), "gyr": 1.0} in [dict(choice.factors) for choice in found.untold[0].choices]


@pytest.mark.parametrize("rate", [200.0, 286.0])
def test_stamps_that_count_rows_are_neither_unit(rate: float) -> None:
    """The turning gives a factor that no unit has; it is told as what the rate would be."""
    right = measure(forearm(60.0, rate, seed=2), Sensor(mag_delay=0.0), seed=2)
    rows = right.with_samples(time=1e-3 * np.arange(len(right)), gyr=np.degrees(right.gyr))
    found = diagnose(rows, read_as={"time": "ms"}, guessed={"time", "gyr"}, thorough=False)
    assert sure(found) == ["time or gyr unit"] and not found.repairs
    told = found.findings[0].sentence
    hz = float(told.split(" Hz if the rates are in deg/s")[0].split()[-1])
    assert hz == pytest.approx(rate, rel=0.16) and "count rows: say --rate HZ" in told


def test_a_unit_is_not_all_that_is_wrong_where_stamps_count_rows() -> None:
    right = measure(forearm(60.0, 57.0, seed=2), Sensor(mag_delay=0.0), seed=2)
    rows = right.with_samples(time=1e-3 * np.arange(len(right)), gyr=np.degrees(right.gyr))
    found = diagnose(rows, read_as={"time": "ms"}, guessed={"time", "gyr"}, thorough=False)
    assert sure(found) == ["gyr unit"] and not found.repairs and "count rows" in found.findings[0].sentence


def test_raw_counts_are_no_unit() -> None:
    """16.4 counts a °/s are nearly mrad/s: not for sure."""
    recording = poise.read(data_path("broad", "05_undisturbed_slow_rotation_with_breaks_B.mat"))
    counts = recording.with_samples(gyr=np.round(16.4 * np.degrees(recording.gyr)))
    assert not diagnose(counts, thorough=False).repairs and sure(diagnose(counts, thorough=False))


@pytest.mark.parametrize(
    ("name", "start", "end"),
    [
        ("25_disturbed_tapping_B", 45.0, 90.0),
        ("27_disturbed_phone_vibration_B", 120.0, 150.0),
        ("31_disturbed_stationary_magnet_D", 80.0, 100.0),
    ],
)
def test_what_hardly_turns_is_in_no_rare_unit(name: str, start: float, end: float) -> None:
    """Shaken pieces, of which the right rates explain little: smaller ones seemed to fit, or a factor beside the right one."""
    right = trial(name, start, end)
    found = diagnose(right.with_samples(gyr=np.degrees(right.gyr)), thorough=False)
    assert found.repairs.factors in ({}, {"gyr": pytest.approx(DEGREE)})
    assert not sure(diagnose(right, read_as={"time": "ms"}, guessed={"time", "gyr"}, thorough=False))


@pytest.mark.parametrize(("name", "start"), [("phidgets_imu_upside_down", 0.0), ("ardrone_imu", 60.0)])
def test_a_shaken_gyroscope_with_a_slow_clock_is_not_in_deg_s(name: str, start: float) -> None:
    right = poise.read(data_path("other", f"{name}.bag"))
    piece = right.between(right.time[0] + start, right.time[0] + start + 15.0)
    slow = piece.with_samples(time=10.0 * piece.time)
    assert not diagnose(slow, read_as={"time": "ms"}, guessed={"time"}, thorough=False).repairs


@pytest.mark.parametrize(("unit", "factor"), [("mdeg/s", 180e3 / np.pi), ("mrad/s", 1e3)])
def test_a_rare_unit_that_explains_the_turning_is_named(turned: Recording, unit: str, factor: float) -> None:
    found = diagnose(turned.with_samples(gyr=factor * turned.gyr), thorough=False)
    assert found.options() == f"--units gyr={unit}"


# ---- the command ----------------------------------------------------------------------------------------------------


def table(path: Path, *columns: Any, header: str = "time,gx,gy,gz,ax,ay,az") -> None:
    np.savetxt(path, np.column_stack(columns), delimiter=",", header=header, comments="", fmt="%.9g")


def test_the_command_offers_both(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    made = on_the_floor(30.0)
    table(tmp_path / "robot.csv", made.time, made.gyr, made.acc / 9.80665)
    assert run(["doctor", "robot.csv", "--save-profile", "robot.toml", "--sheet", "robot.html"]) == 1
    said = capsys.readouterr()
    assert "repaired:" not in said.out and "surely wrong: acc unit" in said.out and "cannot-tell gyr unit" in said.out
    assert "fine" not in said.out
    offered = [shlex.split(line.split("either:")[1]) for line in said.out.splitlines() if "either:" in line]
    assert [words[-1] for words in offered] == ["acc=g,gyr=rad/s", "acc=g,gyr=deg/s"]
    assert run(["doctor", "robot.csv", "--json"]) == 1
    (result,) = json.loads(capsys.readouterr().out)["results"]
    assert result["command"] == "" and len(result["choices"]) == 2
    assert run([*offered[1][1:], "-m", "tilt", "-o", "out.csv"]) == 0


def test_no_profile_of_a_unit_that_is_not_known(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    made = on_the_floor(30.0)
    table(tmp_path / "robot.csv", made.time, made.gyr, made.acc)
    assert run(["doctor", "robot.csv", "--save-profile", "robot.toml"]) == 1
    assert "no profile written" in capsys.readouterr().err and not (tmp_path / "robot.toml").exists()
    assert run(["doctor", "robot.csv", "--units", "gyr=deg/s", "--save-profile", "robot.toml"]) == 0
    assert run(["estimate", "robot.csv", "--profile", "robot.toml", "-m", "tilt", "-o", "out.csv"]) == 0


def test_the_command_tells_a_slow_clock(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], turned: Recording
) -> None:
    monkeypatch.chdir(tmp_path)
    columns = turned.gyr, turned.acc, turned.mag
    table(tmp_path / "xsens.csv", np.round(1e4 * turned.time), *columns, header="time,gx,gy,gz,ax,ay,az,mx,my,mz")
    assert run(["doctor", "xsens.csv"]) == 1
    words = shlex.split(capsys.readouterr().out.split("repaired: ")[1].splitlines()[0])
    assert "time=100us,gyr=rad/s,acc=m/s²" in words
    assert run([*words[1:], "-m", "tilt", "-o", "out.csv"]) == 0
