"""A start beside a magnet, or on steel: the heading is set anew by the field that the sensor turns in after that."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import poise
from data_files import data_path
from irons import FLAGSHIP, NEVER, WHITE, calibrated
from poise.cli import run
from poise.data.flags import Flag
from poise.simulation import forearm, measure, robot

CORNERS = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]) / np.sqrt(3.0)
Mask = NDArray[np.bool_]


def beside(recording: poise.Recording, field: Any, since: float = 0.0, until: float = np.inf) -> poise.Recording:
    """Another field (µT, body frame) from *since* to *until*, s from the start on."""
    assert recording.mag is not None
    time = recording.time - recording.time[0]
    return replace(recording, mag=recording.mag + np.outer((time >= since) & (time < until), field))


def flagged(attitude: poise.Attitude, flag: Flag) -> Mask:
    return np.asarray((attitude.flags & np.uint32(flag)) != 0)


def heading(attitude: poise.Attitude, recording: poise.Recording) -> NDArray[np.float64]:
    """(n,) degrees, absolute."""
    return np.degrees(np.abs(poise.evaluate(attitude, recording).heading))


def trial(number: str) -> poise.Recording:
    return poise.read(next(data_path("broad").glob(f"{number}_*.mat")))


@pytest.mark.parametrize("field", [(20.0, 0.0, 0.0), (-10.0, 0.0, 0.0), (0.0, -80.0, 30.0)])
def test_the_heading_is_set_anew_by_the_field_that_it_turns_in(field: tuple[float, float, float]) -> None:
    recording = beside(calibrated(), field, until=3.0)
    attitude = poise.estimate(FLAGSHIP, recording)
    (row,) = np.flatnonzero(flagged(attitude, Flag.ANOTHER_FIELD))
    assert recording.time[row] < 25.0
    late = recording.time > recording.time[row] + 10.0
    assert heading(attitude, recording)[late].max() < 3.0
    assert heading(poise.estimate(NEVER, recording), recording)[late].max() > 15.0
    assert flagged(attitude, Flag.HEADING_UNPROVEN)[: row + 1].all()
    assert flagged(attitude, Flag.HEADING_UNPROVEN)[recording.time > 60.0].mean() < 0.1
    off = heading(attitude, recording) > 3.0 * np.degrees(attitude.sigma[:, 2])
    assert off[500] and flagged(attitude, Flag.HEADING_UNPROVEN)[off].all()


def test_the_jump_is_published() -> None:
    attitude = poise.estimate(FLAGSHIP, beside(calibrated(), (20.0, 0.0, 0.0), until=3.0))
    (reset,) = attitude.resets()
    assert flagged(attitude, Flag.ANOTHER_FIELD)[reset.row]
    assert abs(np.degrees(reset.delta[2])) > 20.0 > 5.0 > np.degrees(np.hypot(*reset.delta[:2]))


def test_backwards_all_rows_have_the_heading_of_that_field() -> None:
    recording = beside(calibrated(), (20.0, 0.0, 0.0), until=3.0)
    attitude = poise.smooth(recording)
    error = heading(attitude, recording)
    assert error.max() < 5.0 and not attitude.resets()
    assert (error < 3.0 * np.degrees(attitude.sigma[:, 2])).all()
    assert flagged(attitude, Flag.HEADING_UNPROVEN).mean() < 0.1
    assert flagged(attitude, Flag.ANOTHER_FIELD).sum() == 1


def test_backwards_a_restart_before_it_keeps_what_was_before_that() -> None:
    """Only since the attitude was set the last time is it wrong by that."""
    recording = calibrated()
    gap = (recording.time > 55.0) & (recording.time < 60.0)
    cut = beside(recording[~gap], (30.0, 0.0, 0.0), since=54.0, until=64.0)
    attitude = poise.smooth(cut)
    assert heading(attitude, cut)[cut.time < 54.0].max() < 3.0


@pytest.mark.parametrize("motion", [forearm, robot])
def test_backwards_what_confirmed_a_heading_after_a_gap_says_nothing_of_before(motion: Any) -> None:
    """The first stretch was beside a magnet and ended before anything was known of that."""
    recording = beside(measure(motion(120.0, 100.0, 3), WHITE, seed=3), (20.0, 0.0, 0.0), until=3.0)
    cut = recording[(recording.time < 10.0) | (recording.time > 30.0)]
    attitude = poise.smooth(cut)
    early = cut.time < 10.0
    assert np.median(heading(attitude, cut)[early]) > 20.0
    assert flagged(attitude, Flag.HEADING_UNPROVEN)[early].all()


@pytest.mark.parametrize("motion", [forearm, robot])
def test_backwards_a_gap_near_the_end_takes_nothing_from_before(motion: Any) -> None:
    recording = measure(motion(120.0, 100.0, 3), WHITE, seed=3)
    cut = recording[((recording.time < 90.0) | (recording.time > 105.0)) & (recording.time < 110.0)]
    assert flagged(poise.smooth(cut), Flag.HEADING_UNPROVEN)[cut.time < 90.0].mean() < 0.2


def test_some_seconds_of_agreement_in_motion_speak_for_the_first_field() -> None:
    """It was right, and not of one place: the other may be that of a steel hall."""
    recording = measure(robot(120.0, 100.0, 3), WHITE, seed=3)
    assert recording.truth is not None
    there = (recording.time >= 10.0) & (recording.time < 60.0)
    east = np.outer(there, [12.0, 0.0, 0.0])
    in_body = poise.math.arrays.rotate(poise.math.arrays.conjugate(recording.truth.quat), east)
    attitude = poise.estimate(FLAGSHIP, replace(recording, mag=recording.mag + in_body))  # type: ignore[operator]
    assert not flagged(attitude, Flag.ANOTHER_FIELD).any()
    assert heading(attitude, recording).max() < 15.0


def test_a_robot_that_leaves_its_dock() -> None:
    recording = beside(measure(robot(120.0, 100.0, 2), WHITE, seed=1), (0.0, 30.0, -10.0), until=4.0)
    late = recording.time > 60.0
    assert heading(poise.estimate(FLAGSHIP, recording), recording)[late].max() < 5.0
    assert heading(poise.estimate(NEVER, recording), recording)[late].max() > 20.0


@pytest.mark.parametrize("since", [40.0, 80.0])
def test_a_field_that_was_confirmed_is_kept_beside_another(since: float) -> None:
    """The Earth's in which it was turned, not that of a building that it is carried into: turned by 40 degrees."""
    recording = calibrated()
    assert recording.mag is not None and recording.truth is not None
    other = np.array([0.6 * 20.0, 0.8 * 20.0 - 20.0, 0.0])
    in_body = poise.math.arrays.rotate(poise.math.arrays.conjugate(recording.truth.quat), np.tile(other, (12000, 1)))
    carried = replace(recording, mag=recording.mag + np.where((recording.time > since)[:, None], in_body, 0.0))
    attitude = poise.estimate(FLAGSHIP, carried)
    assert not flagged(attitude, Flag.ANOTHER_FIELD).any()


@pytest.mark.parametrize("field", [(10.0, 0.0, 0.0), (24.0, -20.0, 25.0), (0.0, -80.0, 0.0)])
def test_a_magnet_on_the_sensor_is_not_another_field(field: tuple[float, float, float]) -> None:
    for since in (0.0, 3.0):
        attitude = poise.estimate(FLAGSHIP, beside(calibrated(), field, since))
        assert not flagged(attitude, Flag.ANOTHER_FIELD).any()


def test_stream_and_whole_agree_over_it() -> None:
    recording = beside(calibrated(), (20.0, 0.0, 0.0), until=3.0)[:3000]
    whole = poise.estimate(FLAGSHIP, recording)
    assert flagged(whole, Flag.ANOTHER_FIELD).any()
    stream, parts = poise.Stream(FLAGSHIP), []
    for start in range(0, 3000, 100):
        r = recording[start : start + 100]
        parts.append(stream.update(poise.Packet(r.time, r.gyr, r.acc, r.mag)))
        stream = poise.Stream(FLAGSHIP).restore(stream.save())
    np.testing.assert_array_equal(np.concatenate([part.flags for part in parts]), whole.flags)
    np.testing.assert_array_equal(np.concatenate([part.table for part in parts]), whole.table)


def test_the_command_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    poise.write(beside(calibrated(), (20.0, 0.0, 0.0), until=3.0), tmp_path / "dock.csv")
    for options in ([], ["--offline"]):
        assert run(["estimate", str(tmp_path / "dock.csv"), "-o", str(tmp_path / "a.csv"), "--json", *options]) == 0
        (result,) = json.loads(capsys.readouterr().out)["results"]
        (said,) = (note for note in result["notes"] if "set beside" in note)
        assert ("--offline" in said) is not bool(options)


@pytest.mark.parametrize("number", ["01", "03", "05", "07", "09", "21"])
def test_trials_that_turn_after_a_start_beside_a_magnet(number: str) -> None:
    recording = trial(number)
    clean = poise.estimate(FLAGSHIP, recording)
    assert recording.moving is not None
    late = recording.moving & (recording.time > recording.time[0] + 0.5 * recording.duration)
    for corner in CORNERS[:2]:
        docked = beside(recording, 20.0 * corner, until=5.0)
        attitude = poise.estimate(FLAGSHIP, docked)
        assert np.nanmean(heading(attitude, docked)[late]) < np.nanmean(heading(clean, recording)[late]) + 2.5
        smoothed = poise.smooth(docked)
        assert np.nanmean(heading(smoothed, docked)[recording.moving]) < 3.5
        off = heading(attitude, docked) > 3.0 * np.degrees(attitude.sigma[:, 2])
        assert flagged(attitude, Flag.HEADING_UNPROVEN)[off & recording.moving].all()


@pytest.mark.parametrize("number", ["05", "07", "11", "15", "21", "25", "27", "29", "31", "33", "35"])
def test_a_magnet_that_is_attached_to_a_trial_at_rest_is_none(number: str) -> None:
    recording = trial(number)
    for corner in CORNERS[::2]:
        attitude = poise.estimate(FLAGSHIP, beside(recording, 20.0 * corner, since=15.0))
        assert not flagged(attitude, Flag.ANOTHER_FIELD).any()
