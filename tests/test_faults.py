"""The fault bench: faults are where they are said to be, figures say what happened, and a bad attitude does not pass."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from data_files import data_path
from helpers import wxyz
from poise import METHODS, Attitude, Flag, Recording, TwoStage, estimate, evaluate, read
from poise.math import arrays
from poise.peers import installed
from poise.simulation import forearm, measure

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

import faults
from fault_bench import bits, fuzz, injectors, live, report
from fault_bench.contenders import contender, names
from fault_bench.injectors import LAST, Injected, Injector
from fault_bench.judging import Clean, angles, bad_rows, clean_figures, clean_run, judge
from fault_bench.matrix import Case, Task, generator, perform
from fault_bench.rows import FAULTS, Demand, Fault

TRIAL = "05_undisturbed_slow_rotation_with_breaks_B.mat"


@pytest.fixture(scope="module")
def made() -> Recording:
    """A made forearm, all of whose rows count."""
    recording = measure(forearm(150.0, 100.0, seed=3), seed=4)
    return replace(recording, moving=np.ones(len(recording), bool))


@pytest.fixture(scope="module")
def clean(made: Recording) -> Clean:
    return clean_run(made, estimate(TwoStage(), made), has_heading=True)


def injected(inject: Injector, recording: Recording, seed: int = 1) -> Injected:
    return inject(recording, np.random.default_rng(seed))


def of(key: str) -> Fault:
    return next(fault for fault in FAULTS if fault.key == key)


# -- injectors --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("fault", [f for f in FAULTS if f.refusal is None], ids=lambda f: f.key)
def test_a_fault_is_where_it_is_said_to_be(fault: Fault, made: Recording) -> None:
    found = injected(fault.inject, made)
    rows = ("time", "gyr", "acc", "mag")
    same = np.ones(len(found.origin), bool)
    for name in rows:
        now, was = getattr(found.recording, name), getattr(made, name)[found.origin]
        same &= ((now == was) | (np.isnan(now) & np.isnan(was))).reshape(len(same), -1).all(axis=1)
    again = injected(fault.inject, made)
    assert np.array_equal(again.recording.gyr, found.recording.gyr, equal_nan=True)  # a seed stands for a fault
    rows_only = (
        "lost",
        "twice",
        "swapped",
        "clipped",
        "jitter",
        "batches",
        "bursts",
        "clock",
    )  # more or less than `wrong` changes
    if not any(word in fault.name for word in rows_only):
        assert not same[found.wrong].all()
        assert same[~found.wrong].all()
    if fault.group in ("E2", "E3", "E4", "E9") or "30 s" in fault.name:
        assert found.end < made.time[-1] - LAST  # the last stretch is clean
        assert found.recording.time[0] == made.time[0]
    assert made.truth is not None  # and the recording that was given is what it was
    assert np.isfinite(made.gyr).all()


def test_lost_rows_are_gone_and_the_first_row_after_is_the_wrong_one(made: Recording) -> None:
    found = injected(of("E4 link lost for 10 s").inject, made)
    (row,) = np.flatnonzero(found.wrong)
    assert len(found.recording) == len(made) - 1000
    assert found.recording.time[row] - found.recording.time[row - 1] == pytest.approx(10.01, abs=1e-3)


def test_a_clipped_sensor_is_wrong_from_the_second_extreme_on(made: Recording) -> None:
    found = injected(injectors.clipped("gyr", 0.05, 0.1), made)
    end = np.abs(found.recording.gyr).max()
    at_end = (np.abs(found.recording.gyr) == end).any(axis=1)
    assert end < np.abs(made.gyr).max()
    assert 0 < found.wrong.sum() < at_end.sum()
    assert at_end[found.wrong].all()
    assert at_end[np.flatnonzero(found.wrong) - 1].all()


def test_zero_and_absent_magnetometers_fail_at_the_same_instant(made: Recording) -> None:
    zero, absent = (
        fault.inject(made, generator(fault, "05", 1))
        for fault in (of("E10 mag zero for 30 s"), of("E10 mag NaN for 30 s"))
    )
    assert zero.start == absent.start
    other = of("E9 mag zero for 5 s")
    assert other.inject(made, generator(other, "05", 1)).start != zero.start
    assert other.inject(made, generator(other, "05", 2)).start != other.inject(made, generator(other, "05", 1)).start


# -- figures ----------------------------------------------------------------------------------------------------------


def nothing(recording: Recording, start: float, end: float) -> Injected:
    """No fault, said to be from *start* to *end*."""
    wrong = (recording.time >= start) & (recording.time <= end)
    return Injected(recording, np.arange(len(recording)), wrong, start, end)


def turned(attitude: Attitude, start: float, end: float, axis: str, degrees: float) -> Attitude:
    """The attitude, wrong between two instants."""
    quat = attitude.quat.copy()
    rows = (attitude.time >= start) & (attitude.time < end)
    half = np.radians(degrees) / 2
    turn = np.array([np.cos(half), *(np.sin(half) * (axis == name) for name in "xyz")])
    quat[rows] = arrays.multiply(turn, quat[rows])
    table = attitude.table.copy()
    table[:, :4] = quat
    return replace(attitude, table=table, flags=attitude.flags.copy())


def test_angles_are_those_of_evaluate(made: Recording) -> None:
    rng = np.random.default_rng(5)
    from scipy.spatial.transform import Rotation

    p, q = (wxyz(Rotation.random(50, random_state=rng)) for _ in range(2))
    errors = evaluate(Attitude.of(np.arange(50.0), p), Attitude.of(np.arange(50.0), q))
    for own, theirs in zip(angles(p, q), (errors.total, errors.heading, errors.inclination), strict=True):
        np.testing.assert_allclose(own, np.degrees(theirs), atol=1e-9)


def test_the_clean_run_itself_passes_every_figure(made: Recording, clean: Clean) -> None:
    figures = judge(clean, nothing(made, 40.0, 45.0), clean.attitude, back=1.0, sensor="acc")
    assert figures["ratio"] == figures["inclination ratio"] == 1.0
    assert figures["deviation"] == figures["heading"] == 0.0
    assert figures["recovery"] <= 0.011  # the next row
    assert figures["latency"] == np.inf  # nobody said a word
    assert figures["flagged"] == 0.0


def test_a_wrong_attitude_is_measured(made: Recording, clean: Clean) -> None:
    wrong = turned(clean.attitude, 40.0, 48.0, "z", 25.0)
    figures = judge(clean, nothing(made, 40.0, 45.0), wrong, back=2.0)
    assert figures["deviation"] == figures["heading"] == pytest.approx(25.0)
    assert figures["recovery"] == pytest.approx(3.0, abs=0.011)
    assert figures["ratio"] == 1.0
    level = clean_run(made, clean.attitude, has_heading=False)
    assert judge(level, nothing(made, 40.0, 45.0), wrong, back=2.0)["deviation"] < 1e-6  # of a heading it says nothing
    late = judge(clean, nothing(made, 40.0, 45.0), turned(clean.attitude, 100.0, 150.0, "x", 20.0), back=2.0)
    assert late["ratio"] > 3.0
    assert late["inclination ratio"] > 3.0


def test_wrong_and_valid_is_silent_unless_sigma_or_flags_say_so(made: Recording, clean: Clean) -> None:
    wrong = turned(clean.attitude, 40.0, 55.0, "x", 60.0)
    share = 1500 / len(made)
    assert judge(clean, nothing(made, 40.0, 45.0), wrong, 2.0)["silent"] == pytest.approx(share, rel=1e-3)
    unsure = replace(wrong, table=wrong.table.copy())
    unsure.sigma[:] = np.radians(20.0)
    assert judge(clean, nothing(made, 40.0, 45.0), unsure, 2.0)["silent"] == 0.0
    wrong.flags[4000:5500] |= np.uint32(Flag.LOST)
    figures = judge(clean, nothing(made, 40.0, 45.0), wrong, 2.0)
    assert figures["silent"] == 0.0
    assert figures["valid"] < 1.0
    assert figures["latency"] == pytest.approx(0.0, abs=0.011)


def test_flags_count_where_they_are_new_name_the_sensor_and_last(made: Recording, clean: Clean) -> None:
    fault = nothing(made, 40.0, 45.0)
    for flag, sensor, expected in (
        (Flag.ACC_MISSING, "acc", 1.0),
        (Flag.ACC_MISSING, "mag", np.inf),
        (Flag.REST, "acc", np.inf),
        (Flag.GAP, "gyr", 1.0),
    ):
        attitude = replace(clean.attitude, flags=clean.attitude.flags & ~np.uint32(flag))
        before = Clean(made, attitude, True, clean.error, clean.inclination)
        said = replace(attitude, flags=attitude.flags.copy())
        said.flags[4100:4502] |= np.uint32(flag)
        assert judge(before, fault, said, 2.0, sensor)["latency"] == pytest.approx(expected, abs=0.011)
        said.flags[4200:4502] &= ~np.uint32(flag)  # only for a second
        assert judge(before, fault, said, 2.0, sensor)["latency"] == np.inf


def test_rows_that_are_not_finite_are_counted(clean: Clean) -> None:
    broken = replace(clean.attitude, table=clean.attitude.table.copy(), flags=clean.attitude.flags.copy())
    assert bad_rows(broken) == 0
    broken.table[100:110, 1] = np.nan
    broken.flags[100:105] |= np.uint32(Flag.LOST)  # saying so is no excuse once there was an attitude
    broken.table[200, :4] *= 1.01
    broken.table[300, 11] = np.inf
    assert bad_rows(broken) == 12
    broken.table[:100, :4] = np.nan
    broken.flags[:100] |= np.uint32(Flag.INITIALISING)
    broken.flags[105:110] |= np.uint32(Flag.LOST)
    assert bad_rows(broken) == 2  # before the first attitude there is none to be had


def test_demands_and_outcomes() -> None:
    low, high = Demand("ratio", 1.1), Demand("flagged", 0.99, "at least", "%")
    assert (low.sentence, high.sentence) == ("ratio ≤ 1.1", "flagged ≥ 99 %")
    cases = [
        Case("E5 x", "two-stage", f"{i:02d}", 1, {"ratio": r}) for i, r in enumerate((1.0, 1.05, 1.3, float("nan")))
    ]
    assert report.outcome(low, cases) == (1.05, 1.3, 1, 3)
    refused = Case("E5 x", "two-stage", "09", 1, {}, "no")
    assert report.outcome(low, [*cases, refused]).failed == 2  # a refusal is no pass
    median = Demand("ratio", 1.2, of="median")
    assert report.outcome(median, cases).failed == 0
    assert not report.outcome(high, cases).applies


# -- on a recording ---------------------------------------------------------------------------------------------------


def test_rows_on_a_trial() -> None:
    keys = ("E2 one row of all NaN", "E4 link lost for 1 s", "E6 stamps in ms", "E10 mag NaN for ever")
    cases = perform(Task(data_path("broad", TRIAL), 1, ("adaptive-gain",), keys))
    figures = {case.fault: case.figures for case in cases}
    assert set(figures) == {"clean", *keys}
    assert all(case.figures.get("bad rows", 0.0) == 0.0 for case in cases)
    assert figures["clean"]["silent"] == 0.0
    one_row = of(keys[0])
    assert all(demand.met(figures[one_row.key][demand.figure]) for demand in one_row.demands)
    assert figures[keys[1]]["latency"] == 0.0
    assert figures[keys[1]]["bias"] < 0.1
    assert figures[keys[2]]["refused or never valid"] == 1.0
    assert figures[keys[3]]["latency"] <= 1.0
    (refused,) = [case for case in cases if case.refused]
    assert "0.001" in refused.refused
    text = "\n".join(report.group_tables(cases, ["adaptive-gain"], markdown=True))
    assert "one row of all NaN" in text
    assert "1 refused" in text


@pytest.mark.skipif(not installed("vqf"), reason="vqf is not installed")
def test_a_package_that_ends_in_nan_does_not_pass() -> None:
    (_, case) = perform(Task(data_path("broad", TRIAL), 1, ("vqf-bare",), ("E2 one row of mag NaN",)))
    assert case.figures["lost for ever"] == 1.0
    assert case.figures["bad rows"] > 1000
    assert case.figures["ratio"] == case.figures["recovery"] == np.inf


def test_contenders_by_name_package_and_group() -> None:
    assert names("methods") == list(METHODS)
    assert names("two-stage,two-stage") == ["two-stage"]
    assert contender("tilt").has_heading is False
    with pytest.raises(ValueError, match="kalman"):
        names("kalman")


# -- checks -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", list(METHODS))
def test_fuzzed_sequences_leave_nothing_that_is_not_finite(name: str) -> None:
    (check,) = fuzz.fuzz(name, 3000, seed=7)
    assert check.met, check.found


def test_fuzz_sees_what_is_not_finite() -> None:
    _, good = fuzz.sequences(fuzz.CHAIN, np.random.default_rng(1))
    table, flags = np.zeros((*good.shape, 16)), np.zeros(good.shape, np.uint32)
    table[:, :, 0] = 1.0
    assert not fuzz._wrong(table, flags, good).any()
    table[0, 0], flags[0, 0] = np.nan, np.uint32(Flag.INITIALISING)  # before there is anything
    assert not fuzz._wrong(table, flags, good).any()
    table[0, 0, 0], table[1, 2, 1], table[2, -1, 8], table[3, 3, 12] = np.nan, np.inf, np.nan, np.inf
    flags[0, 0] = 0
    assert fuzz._wrong(table, flags, good).sum() == 4


def test_fuzz_poisons_and_leaves_good_rows() -> None:
    rows, good = fuzz.sequences(500, np.random.default_rng(2))
    assert good[:, fuzz.BAD :].all()
    assert 0.1 < good[:, : fuzz.BAD].mean() < 0.9
    assert np.isfinite(rows[good]).all()
    assert np.isnan(rows).any()
    assert (np.abs(rows[np.isfinite(rows)]) == 1e30).any()
    assert ((rows == 0.0) & np.signbit(rows)).any()


def test_same_bits_however_it_is_fed_and_a_bit_that_differs_is_seen() -> None:
    part = bits.troubled(read(data_path("broad", TRIAL)), 4.0, np.random.default_rng(3))
    whole = estimate(METHODS["adaptive-gain"](), part)
    assert whole.valid.mean() > 0.5
    assert bits._compared("rows", whole, list(bits._resumed("adaptive-gain", part)), "").met
    other = replace(whole, table=whole.table.copy())
    row = int(np.flatnonzero(np.isfinite(whole.quat[:, 2]))[-1])
    other.table[row, 2] = np.nextafter(other.table[row, 2], 2.0)
    assert bits._compared("one bit", whole, [other], "").found.startswith("1 of")


def test_a_silent_link_is_asked_about() -> None:
    (check,) = live.asked_while_silent("adaptive-gain", data_path("broad", TRIAL), 1)
    assert check.met, check.found


def test_clean_figures_name_false_alarms(made: Recording, clean: Clean) -> None:
    assert clean_figures(clean)["false alarms"] == 0.0
    loud = replace(clean.attitude, flags=clean.attitude.flags | np.uint32(Flag.GAP))
    assert clean_figures(Clean(made, loud, True, clean.error, clean.inclination))["false alarms"] == 1.0


def test_made_recordings_take_the_place_of_trials(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    recordings = [read(file) for file in faults.made(50.0, tmp_path)]
    assert all(
        r.rate_hz == pytest.approx(50.0, rel=0.01) and r.truth is not None and r.moving is not None for r in recordings
    )
    for wrong in (["--made", "50", "--write"], ["--made", "5"], ["--made", "50", "--final"]):
        with pytest.raises(SystemExit):
            faults.main(wrong)
        assert "--made: expected 20 to 2000 Hz" in capsys.readouterr().err
