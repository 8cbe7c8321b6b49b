"""Other packages' filters: what comes out is in ENU, w x y z, on the rows of any recording, and what is unknown is flagged."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from data_files import data_path
from helpers import angle_between, wxyz
from poise import Attitude, Flag, PoiseError, Recording, evaluate, read
from poise import peers as peers_module
from poise.errors import RecordingError
from poise.peers import PEERS, chosen, installed, period, prepared
from poise.peers.adapters import dip_deg
from poise.peers.even import rising
from poise.simulation import PERFECT, at_rest, forearm, measure, turned_about_up

# Poses of a body with x right, y forward, z up: turned about up first, then about its own axes.
POSES: dict[str, tuple[str, float | list[float]]] = {
    "level, facing north": ("Z", 0),
    "level, facing east": ("Z", -90),
    "nose up, facing north": ("ZX", [0, 30]),
    "right side down, facing east": ("ZY", [-90, 40]),
    "tilted both ways, facing south-west": ("ZXY", [135, -35, 60]),
}


def present(name: str) -> peers_module.Peer:
    """A peer; skips where its package is absent, and fails in CI."""
    package = PEERS[name].package
    if not installed(package):
        reason = f"{package} is not installed (the extra 'peers' brings it)"
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)
    return PEERS[name]


def outcome(name: str, recording: Recording) -> NDArray[np.float64]:
    """The error of a peer, degrees a row, which is the same for its adapter and for its attitude."""
    peer = present(name)
    assert recording.truth is not None
    quat = peer.run(recording)
    assert quat.shape == (len(recording), 4)
    np.testing.assert_array_equal(peer.attitude(recording).quat, Attitude.of(recording.time, quat).quat)
    return np.degrees(angle_between(quat, recording.truth.quat))


@pytest.mark.parametrize("pose", POSES)
@pytest.mark.parametrize("name", PEERS)
def test_a_perfect_sensor_at_rest_comes_out_in_enu(name: str, pose: str) -> None:
    sequence, degrees = POSES[pose]
    quat = wxyz(Rotation.from_euler(sequence, degrees, degrees=True))
    error = outcome(name, measure(at_rest(quat, duration=15.0), PERFECT))
    assert error[-1] < 1.0


@pytest.mark.parametrize("name", PEERS)
def test_the_adapters_poses_are_what_their_names_say(name: str) -> None:
    """Against figures written by hand, not by the simulation: nose up by 30°, facing east, gravity and field in the body."""
    n, (s, c) = 1500, (0.5, np.sqrt(0.75))
    acc, mag = np.tile([0.0, 9.81 * s, 9.81 * c], (n, 1)), np.tile([-20.0, -40.0 * s, -40.0 * c], (n, 1))
    quat = np.tile(wxyz(Rotation.from_matrix([[0, c, -s], [-1, 0, 0], [0, s, c]])), (n, 1))
    time = np.arange(n) / 100.0
    made = Recording(time=time, gyr=np.zeros((n, 3)), acc=acc, mag=mag, truth=Attitude.of(time, quat))
    assert outcome(name, made)[-1] < 1.0


def turned(axis: str, heading_deg: float, degrees: float) -> Recording:
    """10 s level facing a compass heading, a turn about an axis of the body in 2 s, 10 s still; samples from the truth alone.

    The body is x right, y forward, z up; the field points north and down by 60°.
    """
    n, rate = 2200, 100.0
    time = np.arange(n) / rate
    angle = np.radians(degrees) * np.clip((time - 10.0) / 2.0, 0.0, 1.0)
    vector = np.eye(3)["xyz".index(axis)]
    attitude = Rotation.from_euler("Z", -heading_deg, degrees=True) * Rotation.from_rotvec(angle[:, None] * vector)
    body = attitude.inv()
    return Recording(
        time=time,
        gyr=np.gradient(angle, time)[:, None] * vector,
        acc=body.apply([0.0, 0.0, 9.80665]),
        mag=body.apply([0.0, 25.0, -25.0 * np.sqrt(3.0)]),
        truth=Attitude.of(time, wxyz(attitude)),
    )


@pytest.mark.parametrize(("axis", "heading_deg"), [("x", 0.0), ("y", 90.0), ("z", 215.0)])
@pytest.mark.parametrize("name", PEERS)
def test_a_turn_about_each_axis_from_a_known_heading(name: str, axis: str, heading_deg: float) -> None:
    """Quaternion order, each axis's sign and the gyroscope's unit; imufusion alone starts from identity, and needs seconds."""
    made = turned(axis, heading_deg, 70.0)
    found = outcome(name, made)
    assert made.truth is not None
    assert np.degrees(made.truth.heading()[0]) % 360.0 == pytest.approx(heading_deg)
    assert np.degrees(angle_between(made.truth.quat[1000], made.truth.quat[1200])) == pytest.approx(70.0)
    assert found[800:1201].max() < 1.0
    assert found[-1] < 1.0


@pytest.mark.parametrize("axis", ["x", "y", "z"])
@pytest.mark.parametrize("name", PEERS)
def test_without_a_magnetometer_a_turn_is_as_long_as_it_was(name: str, axis: str) -> None:
    made = without_mag(turned(axis, 90.0, 70.0))
    attitude = present(name).attitude(made)
    before, after = Rotation.from_quat(attitude.quat_xyzw[[1000, 1200]])
    vector = np.degrees((before.inv() * after).as_rotvec())
    np.testing.assert_allclose(vector, 70.0 * np.eye(3)["xyz".index(axis)], atol=4.0)
    assert tilt_error(attitude, made)[:1201].max() < 4.0


@pytest.mark.parametrize("name", PEERS)
def test_a_perfect_sensor_in_motion_comes_out_in_enu(name: str) -> None:
    motion = turned_about_up(forearm(40.0, 160.0, seed=1), 2.0)  # at no package's default rate
    error = outcome(name, measure(motion, PERFECT))[800:]
    assert np.sqrt(np.mean(error**2)) < 3.0
    assert error.max() < 6.0


@pytest.mark.parametrize("fault", ["a gap", "an absent sample"])
def test_peers_are_not_given_what_they_cannot_know(fault: str) -> None:
    made = measure(at_rest(duration=2.0), PERFECT)
    if fault == "a gap":
        time = made.time.copy()
        time[100:] += 0.01
        made = replace(made, time=time, truth=None)
    else:
        made.mag[7] = np.nan
    with pytest.raises(RecordingError, match="peers need"):
        period(made)


# -- without a magnetometer --------------------------------------------------------------------------------------------


def tilt_error(attitude: Attitude, recording: Recording) -> NDArray[np.float64]:
    """Degrees between the up of an attitude and that of the reference, a row."""
    assert recording.truth is not None
    return np.degrees(evaluate(attitude, replace(recording, moving=None)).inclination)


def without_mag(recording: Recording) -> Recording:
    return replace(recording, mag=np.full((len(recording), 3), np.nan))


@pytest.mark.parametrize("pose", POSES)
@pytest.mark.parametrize("name", PEERS)
def test_without_a_magnetometer_the_tilt_is_right_at_rest(name: str, pose: str) -> None:
    sequence, degrees = POSES[pose]
    quat = wxyz(Rotation.from_euler(sequence, degrees, degrees=True))
    made = without_mag(measure(at_rest(quat, duration=15.0), PERFECT))
    attitude = present(name).attitude(made)
    assert tilt_error(attitude, made)[-1] < 1.0
    assert attitude.heading_reference == "arbitrary"
    assert (attitude.flags & Flag.HEADING_ARBITRARY).all()


@pytest.mark.parametrize("name", PEERS)
def test_without_a_magnetometer_the_heading_goes_on_from_where_it_started(name: str) -> None:
    made = without_mag(measure(turned_about_up(forearm(40.0, 160.0, seed=1), 2.0), PERFECT))
    attitude = present(name).attitude(made)
    assert made.truth is not None
    assert np.sqrt(np.mean(tilt_error(attitude, made)[800:] ** 2)) < 3.0
    # q_est = turn about up ⊗ q_ref: the turn stays what it is, while the forearm goes through tens of degrees
    offset = Rotation.from_quat(attitude.quat_xyzw) * Rotation.from_quat(made.truth.quat_xyzw).inv()
    heading = np.degrees(np.unwrap(2.0 * np.arctan2(*offset.as_quat()[800:, [2, 3]].T)))
    assert np.ptp(heading) < 12.0
    own = np.degrees(np.unwrap(made.truth.heading()[800:]))
    assert np.ptp(own) > 40.0


# -- recordings as they come -------------------------------------------------------------------------------------------


def motion(duration: float = 40.0) -> Recording:
    return measure(turned_about_up(forearm(duration, 100.0, seed=1), 2.0), PERFECT)


def error(attitude: Attitude, recording: Recording) -> NDArray[np.float64]:
    """Degrees a row, NaN where there is no attitude; row by row, whatever the stamps."""
    assert recording.truth is not None
    assert len(attitude) == len(recording)
    np.testing.assert_array_equal(attitude.time, recording.time)
    found = np.full(len(recording), np.nan)
    known = np.isfinite(attitude.quat).all(axis=1)
    np.testing.assert_array_equal(known, attitude.valid)  # never NaN without a flag
    found[known] = np.degrees(angle_between(attitude.quat[known], recording.truth.quat[known]))
    return found


@pytest.mark.parametrize("name", PEERS)
def test_uneven_stamps_are_resampled_and_come_back_to_the_rows(name: str) -> None:
    made = motion()
    kept = np.sort(np.random.default_rng(0).choice(len(made), 3000, replace=False))
    uneven = made[kept]
    assert np.nanmax(error(present(name).attitude(uneven), uneven)[600:]) < 6.0
    even, notes = prepared(uneven)
    assert any("uneven stamps" in note for note in notes)
    np.testing.assert_allclose(np.diff(even.time), 0.01, rtol=0.01)
    period(even)


@pytest.mark.parametrize("name", PEERS)
def test_a_slower_magnetometer_is_interpolated_between_its_own_instants(name: str) -> None:
    made = motion()
    stamps = made.time[3::7] - 0.004  # between rows
    field = np.column_stack([np.interp(stamps, made.time, column) for column in made.mag.T])
    slow = Recording.from_sensors((made.time, made.gyr), (made.time, made.acc), (stamps, field), truth=made.truth)
    assert slow.mag_age.max() == pytest.approx(0.004)
    even, notes = prepared(slow)
    assert any("mag: a sample in 14% of the rows" in note for note in notes)
    np.testing.assert_allclose(even.mag[100:-100], made.mag[100:-100], atol=0.5)  # µT; with ages dropped it is 2
    np.testing.assert_array_equal(even.gyr, made.gyr)
    attitude = present(name).attitude(slow)
    assert attitude.heading_reference == "magnetic"
    assert np.max(error(attitude, slow)[800:]) < 6.0


@pytest.mark.parametrize("name", PEERS)
def test_short_holes_are_bridged_and_long_ones_unknown(name: str) -> None:
    made = motion()
    gyr, acc = made.gyr.copy(), made.acc.copy()
    gyr[1200:1205], gyr[1500], acc[1700:1710] = np.nan, np.inf, np.nan
    gyr[2000:2200] = np.nan  # 2 s
    holed = replace(made, gyr=gyr, acc=acc)
    attitude = present(name).attitude(holed)
    unknown = np.zeros(len(made), dtype=bool)
    unknown[2000:2200] = True
    found = error(attitude, holed)
    np.testing.assert_array_equal(np.isnan(found), unknown)
    assert (attitude.flags[unknown] & Flag.LOST).all()
    assert attitude.flags[2200] & Flag.GAP
    assert np.nanmax(found[800:2000]) < 6.0
    assert np.max(found[3200:]) < 6.0  # started anew
    assert [note for note in prepared(holed).notes if "gyr: no sample in 206 rows" in note]


@pytest.mark.parametrize("name", PEERS)
def test_a_gap_in_the_stamps_starts_the_filter_anew(name: str) -> None:
    made = motion()
    torn = made[np.r_[0:1000, 1600:4000]]  # 6 s are not there, in which the forearm moved
    attitude = present(name).attitude(torn)
    assert np.flatnonzero(attitude.flags & Flag.GAP).tolist() == [1000]
    assert np.max(error(attitude, torn)[2000:]) < 6.0
    alone = present(name).attitude(made[1600:4000])
    np.testing.assert_allclose(np.abs(np.sum(alone.quat * attitude.quat[1000:], axis=1)), 1.0, atol=1e-9)


@pytest.mark.parametrize("name", PEERS)
def test_an_absent_magnetometer_is_silence_and_not_a_field(name: str) -> None:
    made = motion()
    late, holed = made.mag.copy(), made.mag.copy()
    late[:500], holed[2000:2400] = np.nan, np.nan
    attitude = present(name).attitude(replace(made, mag=late))
    assert attitude.heading_reference == "magnetic"
    assert (attitude.flags[:490] & Flag.HEADING_ARBITRARY).all()
    assert not (attitude.flags[510:] & (Flag.MAG_MISSING | Flag.HEADING_ARBITRARY)).any()
    assert np.max(error(attitude, made)[2500:]) < 7.0
    attitude = PEERS[name].attitude(replace(made, mag=holed))
    assert (attitude.flags[2000:2400] & Flag.MAG_MISSING).all()
    assert np.max(error(attitude, made)[800:]) < 7.0


def test_a_clock_that_is_set_back_goes_on_after_a_gap() -> None:
    made = motion()
    time = made.time.copy()
    time[500], time[600], time[700] = time[499], time[580], np.nan
    time[2500:] -= time[2500]
    clock, forward = rising(time)
    assert (np.diff(clock) >= 0).all()
    assert np.flatnonzero(~forward).tolist() == [500, 600, 700]
    assert np.diff(clock)[2499] == pytest.approx(2.0)
    torn = replace(made, time=time, truth=made.truth)
    attitude = present("vqf").attitude(torn)
    assert (attitude.flags[[500, 600, 700]] & Flag.TIME_DISORDER).all()
    found = error(attitude, torn)
    assert np.max(found[800:2500]) < 6.0
    assert np.max(found[3300:]) < 6.0


def test_an_even_complete_recording_is_left_as_it_is() -> None:
    made = motion(10.0)
    assert prepared(made).recording is made
    assert prepared(made).notes == ()
    assert prepared(without_mag(made)).notes == (
        "no magnetometer: gyroscope and accelerometer only, the heading is arbitrary",
    )


def short(rows: int) -> Recording:
    return motion(10.0)[:rows]


@pytest.mark.parametrize(
    ("recording", "words"),
    [
        (short(0), "no row has a sample of the gyroscope"),
        (short(5), "at least 10 rows, found 5"),
        (replace(short(100), gyr=np.full((100, 3), np.nan)), "gyroscope"),
        (replace(short(100), acc=np.full((100, 3), np.nan)), "accelerometer"),
        (replace(short(40), time=np.zeros(40)), "rise"),
        (replace(short(400), gyr=np.where(np.arange(1200).reshape(400, 3) % 600 < 3, 0.0, np.nan)), "10 rows in a row"),
        (replace(short(14), time=np.cumsum(np.where(np.arange(14) % 2, 1e-6, 0.5))), "even rate"),
    ],
)
def test_what_no_filter_can_run_on_is_refused(recording: Recording, words: str) -> None:
    with pytest.raises(RecordingError, match=words):
        PEERS["vqf"].attitude(recording)


@pytest.mark.parametrize("name", PEERS)
def test_ten_rows_two_a_second_and_nonsense_are_no_tracebacks(name: str) -> None:
    peer = present(name)
    assert peer.attitude(short(10)).valid.all()
    slow = Recording.at_rate(2.0, np.zeros((20, 3)), np.tile([0.0, 0.0, 9.81], (20, 1)))
    assert np.all(np.degrees(peer.attitude(slow).tilt()) < 1.0)
    wild = short(200)
    wild.gyr[100] = 1e200
    try:
        attitude = peer.attitude(wild)
    except RecordingError as refused:
        assert name in str(refused)
        return
    np.testing.assert_array_equal(attitude.valid, np.isfinite(attitude.quat).all(axis=1))


@pytest.mark.parametrize("degrees", [-60.0, 0.0, 75.0])
def test_the_dip_that_the_kalman_filter_is_told_is_the_recordings_own(degrees: float) -> None:
    made = motion(10.0)
    down, north = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    assert made.truth is not None
    body = Rotation.from_quat(made.truth.quat_xyzw).inv()
    made = replace(made, acc=body.apply([0.0, 0.0, 9.8]), mag=body.apply([0.0, 40.0 * north, -40.0 * down]))
    made.mag[100:300] = 0.0  # silence
    assert dip_deg(made) == pytest.approx(degrees, abs=0.01)
    assert dip_deg(without_mag(made)) == 0.0


# -- choosing ------------------------------------------------------------------------------------------------------------


def test_a_package_means_all_of_its_peers() -> None:
    for name in PEERS:
        present(name)
    assert list(chosen("vqf")) == ["vqf", "vqf-offline"]
    assert list(chosen(" ahrs-mahony, VQF-offline,imufusion ")) == ["ahrs-mahony", "vqf-offline", "imufusion"]
    assert list(chosen("vqf,imufusion,ahrs")) == list(PEERS)
    assert list(chosen("ahrs-mahony,ahrs")) == ["ahrs-mahony", "ahrs-madgwick", "ahrs-ekf"]


@pytest.mark.parametrize("words", ["madgwick", "vqf,sekf", "", " , "])
def test_what_there_is_is_said_for_an_unknown_one(words: str) -> None:
    with pytest.raises(
        PoiseError, match=r"vqf, vqf-offline, imufusion, ahrs-madgwick, ahrs-mahony, ahrs-ekf, or by package"
    ):
        chosen(words)


def test_an_absent_package_is_said_with_the_way_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(peers_module, "installed", lambda package: None if package == "ahrs" else "1")
    with pytest.raises(PoiseError, match=r'not installed: ahrs; pip install "poise\[peers\]"'):
        chosen("imufusion,ahrs")
    with pytest.raises(PoiseError, match=r"pip install"):
        PEERS["ahrs-mahony"].attitude(short(100))


def test_provenance_says_which_release_ran_and_on_what() -> None:
    attitude = present("vqf-offline").attitude(replace(short(100), source="walk.csv"))
    assert attitude.provenance.method == f"vqf-offline {installed('vqf')}"
    assert attitude.provenance.source == "walk.csv"
    assert attitude.metadata()["poise.method"] == attitude.provenance.method
    assert attitude.provenance.parameters == {"settings": PEERS["vqf-offline"].settings, "prepared": []}
    uneven = short(100)[np.r_[0:50, 53:100]]
    told = json.loads(PEERS["vqf-offline"].attitude(uneven).metadata()["poise.parameters"])["prepared"]
    assert told == ["uneven stamps: gyr and acc interpolated to 100.0 even samples per second"]


# -- real recordings -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", PEERS)
def test_a_real_uneven_recording_with_a_slower_magnetometer(name: str) -> None:
    recording = read(data_path("other", "x-io_fusion_sensor_data.csv"))
    attitude = present(name).attitude(recording)
    assert attitude.valid.all()
    assert attitude.heading_reference == "magnetic"
    other = PEERS["vqf-offline"].attitude(recording)
    tilt = np.degrees(angle_between(attitude.quat, other.quat))
    assert np.median(tilt) < 25.0  # the same frame: another one would be 90° or 180° away


@pytest.mark.parametrize("name", PEERS)
def test_every_file_with_every_fault_at_once_is_no_traceback_and_no_nan_unsaid(name: str) -> None:
    peer = present(name)
    trials = sorted(data_path("broad").glob("*.mat"))
    if name.startswith("ahrs"):  # it is slow
        trials = trials[::4]
    for file in [*trials, data_path("other", "x-io_fusion_sensor_data.csv")]:
        for recording in faulty(file):
            attitude = peer.attitude(recording)
            known = np.isfinite(attitude.quat).all(axis=1)
            np.testing.assert_array_equal(known, attitude.valid, err_msg=file.name)
            assert 0.6 < known.mean() < 0.9, file.name
            assert attitude.provenance.parameters["prepared"]


@cache
def faulty(file: Path) -> tuple[Recording, Recording]:
    """The start of a file with rows, stamps and samples gone, as it is and without a magnetometer."""
    whole = read(file)[:1500]
    kept = np.sort(np.random.default_rng(0).choice(len(whole), 1200, replace=False))
    time, gyr, acc, mag = (np.array(getattr(whole, field)[kept]) for field in ("time", "gyr", "acc", "mag"))
    gyr[::50], acc[::70], mag[::3] = np.nan, np.nan, np.nan
    gyr[500:850] = np.nan  # more than 1 s at every file's rate
    mag[:50], time[100], time[200] = 0.0, time[99], np.nan
    torn = Recording(time=time, gyr=gyr, acc=acc, mag=mag)
    return torn, without_mag(torn)


@pytest.mark.parametrize("name", ["vqf", "imufusion"])
def test_a_real_recording_thinned_unevenly_is_as_good_as_whole(name: str) -> None:
    whole = read(data_path("broad", "05_undisturbed_slow_rotation_with_breaks_B.mat"))[:20000]
    thin = whole[np.sort(np.random.default_rng(0).choice(len(whole), 14000, replace=False))]
    peer = present(name)
    full, part = (evaluate(peer.attitude(r), r).rmse_deg().total for r in (whole, thin))
    assert abs(part - full) < 0.15
