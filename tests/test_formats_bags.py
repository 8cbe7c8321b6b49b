"""ROS bags: the real ones, made ones of every kind, and what their messages may lack."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poise
from data_files import data_path
from made_bags import ACC, FIELD, GYR, IMU, MAG, QUAT, ROWS, START, TIME, VECTOR, imu, mag, save, text
from poise.cli import run
from poise.errors import FormatError
from poise.formats import bag_library, bag_stamps, bag_topics, read, read_attitude, sniff, write, wrote_attitude
from poise.formats.bag_topics import Topic, Unclear

KINDS = ["bag", "mcap", "sqlite3", "bare-mcap", "bare-sqlite3"]


@pytest.mark.parametrize(
    ("name", "rows", "hz", "gravity", "magnetic", "length", "unit"),
    [
        ("phidgets_imu_upside_down", 13_964, 250.0, 9.88, 6_974, 40.0, "T"),
        ("ardrone_imu", 4_308, 49.99, 9.71, 4_308, 1e-4, "as found"),
        ("sparkfun_razor", 2_144, 68.95, 9.50, 108, 1e-4, "as found"),
    ],
)
def test_real_bags_need_no_option(
    name: str, rows: int, hz: float, gravity: float, magnetic: int, length: float, unit: str
) -> None:
    path = data_path("other", f"{name}.bag")
    facts, recording = sniff(path), read(path)
    assert facts.format == "ROS 1 bag" and facts.sensors["mag"].unit == unit and not facts.doubts
    assert len(recording) == rows and recording.rate_hz == pytest.approx(hz, abs=0.01)
    assert np.median(np.linalg.norm(recording.acc, axis=1)) == pytest.approx(gravity, abs=0.01)
    lengths = np.linalg.norm(recording.mag, axis=1)
    assert np.isfinite(lengths).sum() == magnetic == facts.sensors["mag"].samples
    assert np.nanmedian(lengths) == pytest.approx(length, rel=0.01)
    assert 1.3e9 < recording.time[0] < 1.4e9  # 2012 and 2013, from the headers


def test_real_bags_say_what_their_orientation_is_worth() -> None:
    for name, reason in [("sparkfun_razor", "the identity"), ("phidgets_imu_upside_down", "zero or NaN")]:
        with pytest.raises(FormatError, match=f"no attitude.*means nothing: {reason}"):
            read_attitude(data_path("other", f"{name}.bag"))
    path = data_path("other", "ardrone_imu.bag")
    onboard = read_attitude(path)
    assert len(onboard) == 4_308 and onboard.frame == "enu" and np.isnan(onboard.sigma).all()
    compared = read(path, columns="orientation=truth_quat").truth
    assert compared is not None
    np.testing.assert_array_equal(compared.quat, onboard.quat)


def test_upside_down_is_upside_down() -> None:
    recording = read(data_path("other", "phidgets_imu_upside_down.bag"))
    tilt = np.degrees(poise.estimate(poise.TwoStage(), recording).tilt())
    assert np.median(tilt) > 175


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_found_by_its_content(tmp_path: Path, kind: str) -> None:
    path = save(tmp_path / "walk 100%.csv", [*imu(), *mag(), *text()], kind)
    recording = read(path)
    np.testing.assert_array_equal(recording.time, bag_stamps.seconds(bag_stamps.nanoseconds(TIME)))
    np.testing.assert_array_equal(recording.gyr, GYR)
    np.testing.assert_array_equal(recording.acc, ACC)
    np.testing.assert_allclose(recording.mag, MAG * 1e6)
    assert not recording.mag_age.any()
    assert any("topic /imu/data_raw, magnetometer /imu/mag" in note for note in recording.notes)
    assert len(recording.source_hash) == 64


def test_a_slower_magnetometer_counts_once_and_keeps_its_age(tmp_path: Path) -> None:
    path = save(tmp_path / "a.bag", [*imu(), *mag(every=5, shift=0.004)])
    recording = read(path)
    known = np.isfinite(recording.mag[:, 0])
    np.testing.assert_array_equal(np.flatnonzero(known), np.arange(1, ROWS, 5))
    np.testing.assert_allclose(recording.mag[known], MAG[::5] * 1e6)
    np.testing.assert_allclose(recording.mag_age[known], 0.006, atol=1e-6)
    assert sniff(path).sensors["mag"].samples == ROWS // 5


def test_magnetometers_without_a_unit(tmp_path: Path) -> None:
    unit = MAG / np.linalg.norm(MAG, axis=1)[:, None]
    for i, (messages, note) in enumerate(
        [
            (mag(field=unit), "length 1: a direction that its driver normalised"),
            (mag(field=1e-4 * unit), "length 0.0001: a direction that its driver normalised"),
            (mag(field=MAG * 1e6), "should be in T, but its median length 48.5"),
            (mag(field=MAG * 1e4, kind=VECTOR), "unit not known"),
        ]
    ):
        path = save(tmp_path / f"{i}.bag", [*imu(), *messages])
        facts = sniff(path)
        assert facts.sensors["mag"].unit == "as found"
        assert any(note in said for said in facts.notes), facts.notes
    assert sniff(path, units={"mag": "G"}).sensors["mag"].unit == "G"
    assert np.linalg.norm(read(path, units={"mag": "G"}).mag[0]) == pytest.approx(48.47, abs=0.01)


def test_without_a_magnetometer(tmp_path: Path) -> None:
    path = save(tmp_path / "a.bag", [*imu(), *mag("/gps/velocity", kind=VECTOR)])
    recording = read(path)
    assert not recording.has_mag and "no magnetometer: heading is arbitrary" in recording.notes
    assert read(path, topic="/imu/data_raw,/gps/velocity").has_mag


@pytest.mark.parametrize(("stamp", "word"), [(0.0, "zero"), (START + 7.0, "the same")])
def test_headers_that_say_nothing_give_way_to_arrival(tmp_path: Path, stamp: float, word: str) -> None:
    path = save(tmp_path / "a.bag", [*imu(stamps=[stamp] * ROWS), *mag(stamps=[0.0] * ROWS)])
    recording = read(path)
    np.testing.assert_allclose(recording.time, TIME + 0.002, atol=1e-6)
    assert np.isfinite(recording.mag).all()
    assert any(f"are {word} in every message; the times of arrival are used" in note for note in recording.notes)


def test_a_magnetometer_on_another_clock_is_placed_by_its_arrival(tmp_path: Path) -> None:
    path = save(tmp_path / "a.bag", [*imu(), *mag(every=4, stamps=TIME - START)])
    recording = read(path)
    known = np.isfinite(recording.mag[:, 0])
    assert known.sum() == pytest.approx(ROWS / 4, abs=1)
    assert any("/imu/mag count on another clock" in note for note in recording.notes)


def test_a_few_unset_stamps_are_no_time(tmp_path: Path) -> None:
    path = save(tmp_path / "a.bag", [*imu(stamps=np.where(np.arange(ROWS) < 3, 0.0, TIME)), *mag()])
    recording = read(path)
    assert np.isnan(recording.time[:3]).all() and np.isfinite(recording.time[3:]).all()
    assert poise.estimate(poise.TwoStage(), recording).valid[10:].all()


def test_a_row_without_acceleration_is_missing_not_zero(tmp_path: Path) -> None:
    recording = read(save(tmp_path / "a.bag", imu(absent=range(1, ROWS, 2))))
    np.testing.assert_array_equal(np.isnan(recording.acc[:, 0]), np.arange(ROWS) % 2 == 1)
    path = save(tmp_path / "gyro.bag", imu("/camera/gyro/sample", absent=range(ROWS)))
    with pytest.raises(FormatError, match="/camera/gyro/sample carries no linear_acceleration"):
        read(path)


def test_acceleration_in_g_is_told(tmp_path: Path) -> None:
    path = save(tmp_path / "a.bag", imu(acc=ACC / 9.81))
    with pytest.raises(FormatError, match=r"acc is named by the file as m/s².*say --units acc=g"):
        read(path)
    np.testing.assert_allclose(read(path, units={"acc": "g"}).acc[0], [0, 0, 9.80665])


@pytest.mark.parametrize(
    ("quat", "covariance", "reason"),
    [
        (QUAT, -1.0, "its covariance is -1"),
        ((np.nan,) * 4, 0.0, "zero or NaN in every message"),
        ((0.0,) * 4, 0.0, "zero or NaN in every message"),
        ((1.0, 0.0, 0.0, 0.0), 0.0, "the identity in every message"),
        ((3.0, 0.0, 4.0, 0.0), 0.0, "no quaternion of length 1"),
    ],
)
def test_meaningless_orientations(tmp_path: Path, quat: Any, covariance: float, reason: str) -> None:
    path = save(tmp_path / "a.bag", imu(quat=quat, covariance=covariance))
    assert any(f"means nothing: {reason}" in note for note in read(path).notes)
    for refused in (lambda: read_attitude(path), lambda: read(path, columns="orientation=truth_quat")):
        with pytest.raises(FormatError, match=f"means nothing: {reason}"):
            refused()


def test_an_orientation_is_a_reference(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    messages = [*imu(), *imu("/imu/data", quat=QUAT, variance=0.01), *mag()]
    path = str(save(tmp_path / "a.mcap", messages, "bare-mcap"))
    attitude = read_attitude(path)  # of the filtered topic; samples are those of the raw one
    np.testing.assert_allclose(attitude.quat, QUAT, atol=1e-15)
    np.testing.assert_allclose(attitude.sigma, 0.1)
    assert "topic /imu/data_raw, magnetometer /imu/mag; left out /imu/data" in read(path).notes
    assert run(["evaluate", path, "--reference", path, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["results"][0]["rmse_deg"]["total"] < 1.0
    assert run(["evaluate", path, "--topic", "/imu/data", "--columns", "orientation=truth_quat", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["results"][0]["compared"] == ROWS


def test_the_topic_is_chosen_or_asked_for() -> None:
    def chosen(*names: str, wanted: str = "", raw: bool = True) -> str:
        counts = {"slow": 10}
        topics = [Topic(name, IMU, counts.get(name.rpartition("_")[2], 1000)) for name in names]
        return bag_topics.imu(topics, wanted, raw=raw).name

    assert chosen("/imu/data", "/imu/data_raw") == "/imu/data_raw"
    assert chosen("/imu/data", "/imu/data_raw", raw=False) == "/imu/data"
    assert chosen("/a/imu", "/b/imu", wanted="b/imu") == "/b/imu"
    for names in (("/a/imu", "/b/imu"), ("/a/imu", "/b/imu_raw"), ("/a/imu", "/a/imu_raw_slow"), ("/imu/a", "/imu/b")):
        with pytest.raises(Unclear, match=rf"2 Imu topics: {names[0]} \(sensor_msgs/Imu, 1000\).*--topic {names[0]}"):
            chosen(*names)
    with pytest.raises(Unclear, match=r"no topic '/c' of type sensor_msgs/Imu; there are /a/imu"):
        chosen("/a/imu", wanted="/c")


def test_the_magnetometer_is_the_one_beside_the_unit() -> None:
    def chosen(*topics: tuple[str, str], wanted: str = "") -> str | None:
        found = bag_topics.mag([Topic(*t, 9) for t in topics], Topic("/a/imu/data_raw", IMU, 9), wanted)
        return found and found.name

    assert chosen() is None
    assert chosen(("/b/mag", FIELD), ("/a/imu/mag", FIELD)) == "/a/imu/mag"
    assert chosen(("/a/imu/mag_vector", VECTOR), ("/a/imu/mag", FIELD)) == "/a/imu/mag"
    assert chosen(("/a/imu/magnetic", VECTOR), ("/a/imu/rpy", VECTOR), ("/a/image/x", VECTOR)) == "/a/imu/magnetic"
    assert chosen(("/a/imu/mag", FIELD), ("/a/imu/mag_raw", FIELD)) == "/a/imu/mag_raw"
    assert chosen(("/a/imu/mag", FIELD), wanted="-") is None
    with pytest.raises(Unclear, match=r"2 magnetometers beside /a/imu/data_raw.*say which: --topic"):
        chosen(("/a/imu/mag1", FIELD), ("/a/imu/mag2", FIELD))


@pytest.mark.parametrize("name", ["a.bag", "a.mcap", "folder"])
def test_what_is_written_comes_back(tmp_path: Path, name: str) -> None:
    recording = read(save(tmp_path / "in.bag", [*imu(absent=[7]), *mag()]))
    attitude = poise.estimate(poise.TwoStage(), recording)
    attitude.flags[:5] |= np.uint32(poise.Flag.LOST)
    path = tmp_path / name
    for _ in range(2):  # and over one that is there already
        write(attitude, path, "ros2" if name == "folder" else None, recording=recording)
    back, samples = read_attitude(path), read(path)
    np.testing.assert_array_equal(back.time, attitude.time)
    np.testing.assert_array_equal(back.quat[5:], attitude.quat[5:])
    np.testing.assert_allclose(back.sigma[5:], attitude.sigma[5:], rtol=1e-14)
    assert not back.valid[:5].any() and back.valid[5:].all()
    np.testing.assert_array_equal(samples.gyr, recording.gyr)
    np.testing.assert_array_equal(samples.acc, recording.acc)
    assert {place.name for place in tmp_path.iterdir()} == {"in.bag", name}


def test_ros_reads_what_is_written(tmp_path: Path) -> None:
    from rosbags.highlevel import AnyReader

    attitude = replace(poise.Attitude.of([0.0, 0.5], [QUAT[0], QUAT[200]]), frame="enu")
    attitude.sigma[1] = [0.1, 0.2, 0.3]
    attitude.rate[:] = [1.0, 2.0, 3.0]
    with AnyReader([write(attitude, tmp_path / "a.bag")]) as reader:
        (connection,) = reader.connections
        assert (connection.topic, connection.msgtype) == ("/imu/data", IMU)
        first, last = (reader.deserialize(raw, IMU) for _, _, raw in reader.messages())
    q, rate = last.orientation, last.angular_velocity
    np.testing.assert_array_equal([q.w, q.x, q.y, q.z], QUAT[200])
    np.testing.assert_allclose(last.orientation_covariance.reshape(3, 3), np.diag([0.01, 0.04, 0.09]))
    assert not first.orientation_covariance.any()  # not known, in ROS's words
    assert (rate.x, rate.y, rate.z) == (1.0, 2.0, 3.0) and last.linear_acceleration_covariance[0] == -1
    assert (last.header.stamp.sec, last.header.stamp.nanosec) == (0, 500_000_000)
    assert last.header.frame_id == "imu_link"


def test_what_ros_cannot_hold_is_refused_and_leaves_nothing(tmp_path: Path) -> None:
    attitude = poise.Attitude.of([0.0, 0.5], [QUAT[0], QUAT[200]])
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.txt").write_text("years of work")
    for thing, name, kind, reason in [
        (attitude.to("ned"), "a.bag", None, "east-north-up.*this attitude's frame is ned"),
        (replace(attitude, time=attitude.time - 1), "a.bag", None, "a ROS stamp holds 0 to"),
        (replace(attitude, time=attitude.time + 3e9), "a.mcap", None, "a ROS stamp holds 0 to"),
        (attitude, "full", "ros2", "nothing is written over it"),
        (attitude, "none/a.bag", None, "cannot be written"),
    ]:
        with pytest.raises(FormatError, match=reason):
            write(thing, tmp_path / name, kind)
    with pytest.raises(FormatError, match="the recording has 400 rows, the attitude 2"):
        write(attitude, tmp_path / "a.bag", recording=poise.Recording(time=TIME - START, gyr=GYR, acc=ACC))
    assert [place.name for place in tmp_path.rglob("*")] == ["full", "thesis.txt"]


def test_the_command_writes_bags(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    save(tmp_path / "in.bag", [*imu(), *mag()])
    assert run(["estimate", "in.bag", "-o", "out.mcap"]) == 0
    (tmp_path / "out").mkdir()
    assert run(["estimate", "in.bag", "-o", "out", "--format", "ros2"]) == 0
    assert sniff("out.mcap").format == "MCAP file" and sniff("out/in.attitude").format == "ROS 2 bag"
    capsys.readouterr()
    for arguments, says in [
        (["-o", "x.bag", "--frame", "ned"], "east-north-up"),
        (["--format", "mcap", "--frame", "nwu"], "east-north-up"),
        (["-o", "x.bag", "--format", "csv"], "contradict each other"),
        (["-o", "in.bag"], "nothing is written over an input"),
    ]:
        assert run(["estimate", "in.bag", *arguments]) == 2
        assert says in capsys.readouterr().err
    assert {place.name for place in tmp_path.iterdir()} == {"in.bag", "out.mcap", "out"}


@pytest.mark.parametrize("name", ["out.bag", "out.mcap", "in.attitude"])
def test_a_bag_that_poise_wrote_is_the_attitude_that_it_holds(
    tmp_path: Path, name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    save(tmp_path / "in.bag", [*imu(quat=QUAT), *mag()])
    recording = read("in.bag")
    attitude = poise.Attitude.of(TIME, np.roll(QUAT, 3, axis=1))  # no method would say so
    write(attitude, name, "ros2" if name == "in.attitude" else None, recording=recording)
    write(attitude, "reference.parquet")
    assert wrote_attitude(name) and not wrote_attitude("in.bag") and not wrote_attitude("reference.parquet")
    assert run(["evaluate", name, "--reference", "reference.parquet", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["results"][0]["rmse_deg"]["total"] == pytest.approx(0.0, abs=1e-6)
    assert run(["evaluate", name]) == 1
    assert "is an attitude" in capsys.readouterr().err
    assert run(["plot", name, "-o", "a.png", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["results"][0]["drawn"] == "attitude"


@pytest.mark.parametrize("kind", KINDS)
def test_a_bag_by_others_stays_a_recording(tmp_path: Path, kind: str) -> None:
    assert not wrote_attitude(save(tmp_path / "a", imu("/imu/data", quat=QUAT), kind))


@pytest.mark.parametrize(("start", "exact"), [(0.0, False), (1.7e9, True)])
def test_stamps_come_back_within_a_nanosecond(start: float, exact: bool) -> None:
    time = start + np.random.default_rng(0).random(10_000) * 100
    again = bag_stamps.seconds(bag_stamps.nanoseconds(time))
    np.testing.assert_allclose(again, time, rtol=0, atol=1e-9)
    assert (again == time).all() == exact


def test_a_bag_of_ten_bytes_is_cut_short(tmp_path: Path) -> None:
    path = tmp_path / "a.bag"
    path.write_bytes(b"#ROSBAG V2")
    with pytest.raises(FormatError, match="a ROS 1 bag that is cut short"):
        read(path)
    path.write_bytes(b"#ROSBAG V1.2\n")
    with pytest.raises(FormatError, match=r"another version than 2\.0"):
        read(path)


def test_without_rosbags_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = save(tmp_path / "a.bag", imu())
    monkeypatch.setattr(bag_library, "missing", lambda: True)
    for refused in (lambda: read(path), lambda: write(poise.Attitude.of([0.0], [QUAT[0]]), tmp_path / "b.bag")):
        with pytest.raises(FormatError, match=r'needs rosbags; install it with: pip install "poise\[ros\]"'):
            refused()
