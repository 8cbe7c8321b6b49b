"""Attitude: known attitudes in, known angles, frames, tables and sentences out."""

from __future__ import annotations

import dataclasses
import json
import pickle
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import poise
from helpers import assert_same_attitude, random_quats, rotation, wxyz
from poise.data.attitude import COLUMNS, Attitude, Provenance
from poise.data.flags import SENTENCES, Flag
from poise.data.recording import Recording
from poise.errors import RecordingError

N = 40
QUATS = random_quats(N)
LEVEL_NORTH = [1.0, 0.0, 0.0, 0.0]  # body x east (right), y north (forward), z up
UNKNOWN = [np.nan] * 4
NED_FROM_ENU = np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]])
NWU_FROM_ENU = np.array([[0.0, 1, 0], [-1, 0, 0], [0, 0, 1]])


def made(quat: Any = QUATS, step: float = 0.1, **facts: Any) -> Attitude:
    return Attitude.of(step * np.arange(len(quat)), quat, **facts)


def full(n: int = N, seed: int = 5) -> Attitude:
    """An attitude with a number in every column."""
    table = np.random.default_rng(seed).uniform(0.1, 1.0, (n, COLUMNS))
    table[:, :4] = random_quats(n, seed)
    provenance = Provenance("two-stage", {"gain": 2.0}, "walk.csv", "ab12")
    return Attitude(0.1 * np.arange(n), table, np.zeros(n, np.uint32), "magnetic", "enu", provenance)


def turned(*degrees: float) -> np.ndarray:
    """A body that turns counter-clockwise about up, at these angles."""
    return wxyz(Rotation.from_euler("Z", np.array(degrees)[:, None], degrees=True))


# -- making one -------------------------------------------------------------------------------------------------------


def test_of_normalises_and_marks_rows_without_attitude() -> None:
    attitude = Attitude.of([0, 1, 2, 3], [[2, 0, 0, 0], UNKNOWN, [0, 0, 0, 0], [0, 3, 0, np.inf]])
    np.testing.assert_array_equal(attitude.quat[0], LEVEL_NORTH)
    assert np.isnan(attitude.quat[1:]).all()
    np.testing.assert_array_equal(attitude.valid, [True, False, False, False])
    np.testing.assert_array_equal(attitude.flags, [0, Flag.LOST, Flag.LOST, Flag.LOST])
    assert np.isnan(attitude.sigma).all() and np.isnan(attitude.rate).all()


def test_of_copies_what_it_is_given() -> None:
    time, quat = np.array([0.0]), np.array([[2.0, 0, 0, 0]])
    attitude = Attitude.of(time, quat)
    attitude.time[0], attitude.quat[0] = 9.0, np.nan
    assert time[0] == 0.0 and quat[0, 0] == 2.0


def test_quat_is_continuous_in_sign() -> None:
    quat = turned(*range(0, 720, 10))
    signs = np.where(np.arange(len(quat)) % 3 == 0, -1.0, 1.0)[:, None]
    found = made(signs * quat).quat
    assert (np.sum(found[1:] * found[:-1], axis=1) > 0).all()


@pytest.mark.parametrize(
    ("time", "quat", "found"),
    [
        ([0.0, 1.0], [LEVEL_NORTH], r"\(2,\) and \(1, 4\)"),
        ([0.0], LEVEL_NORTH, r"\(4,\)"),
        ([[0.0]], [LEVEL_NORTH], r"\(1, 1\)"),
    ],
)
def test_of_refuses_shapes_that_do_not_fit(time: Any, quat: Any, found: str) -> None:
    with pytest.raises(RecordingError, match=rf"time \(n,\) and quat \(n, 4\) expected, found .*{found}"):
        Attitude.of(time, quat)


def test_fields_are_views_of_one_table_in_a_frozen_record() -> None:
    attitude = full()
    columns = np.hstack([attitude.quat, attitude.rate, attitude.bias, attitude.sigma, attitude.bias_sigma])
    np.testing.assert_array_equal(columns, attitude.table)
    attitude.bias[3] = 7.0
    np.testing.assert_array_equal(attitude.table[3, 7:10], 7.0)
    np.testing.assert_array_equal(attitude.quat_xyzw, attitude.quat[:, [1, 2, 3, 0]])
    for name in ("time", "table", "frame", "quat"):
        with pytest.raises((dataclasses.FrozenInstanceError, AttributeError)):
            setattr(attitude, name, None)


def test_valid_is_the_flags_rule() -> None:
    attitude = made()
    not_to_be_acted_on = {Flag.INITIALISING, Flag.LOST, Flag.SILENT, Flag.UNSETTLED}
    for flag in Flag:
        attitude.flags[:] = flag | Flag.REST
        assert attitude.valid.all() == (flag not in not_to_be_acted_on)


@pytest.mark.parametrize("rows", [slice(3, 9), slice(None, None, -2), [1, 5], np.arange(N) > 30, 4, slice(0, 0)])
def test_slicing_cuts_every_column_alike(rows: Any) -> None:
    attitude = full()
    attitude.flags[:] = np.arange(N)
    part = attitude[rows]
    chosen = np.atleast_1d(np.arange(N)[rows])
    np.testing.assert_array_equal(part.flags, chosen)
    np.testing.assert_array_equal(part.time, attitude.time[chosen])
    np.testing.assert_array_equal(part.table, attitude.table[chosen])
    assert len(part) == len(chosen)
    assert (part.heading_reference, part.provenance) == ("magnetic", attitude.provenance)


def test_pickle_brings_it_back() -> None:
    attitude = full()
    back = pickle.loads(pickle.dumps(attitude))
    np.testing.assert_array_equal(back.table, attitude.table)
    np.testing.assert_array_equal(back.time, attitude.time)
    np.testing.assert_array_equal(back.flags, attitude.flags)
    assert (back.frame, back.heading_reference, back.provenance) == ("enu", "magnetic", attitude.provenance)


def test_repr_says_what_is_inside() -> None:
    text = repr(Attitude.of([0, 1], [LEVEL_NORTH, UNKNOWN], heading_reference="true"))
    assert text == "Attitude(2 rows, 0-1 s, ENU, heading true, 50.0% valid)"
    assert repr(made()[:0]) == "Attitude(0 rows, ENU, heading arbitrary, 0.0% valid)"


# -- angles -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("sequence", ["ZXY", "ZYX", "zyx", "XYZ", "ZXZ"])
@pytest.mark.parametrize("degrees", [False, True])
def test_euler_is_scipys_row_by_row(sequence: str, degrees: bool) -> None:
    found = made().euler(sequence, degrees=degrees)
    np.testing.assert_allclose(found, rotation(QUATS).as_euler(sequence, degrees=degrees), atol=1e-12)


def test_euler_of_the_default_sequence_is_heading_pitch_roll() -> None:
    attitude = made(wxyz(Rotation.from_euler("ZXY", [[30, 20, -10]], degrees=True)))
    np.testing.assert_allclose(attitude.euler(degrees=True), [[30, 20, -10]])


@pytest.mark.filterwarnings("error")
def test_euler_at_gimbal_lock_and_in_unknown_rows() -> None:
    upright = wxyz(Rotation.from_euler("ZXY", [0, 90, 0], degrees=True))
    found = made([upright, UNKNOWN]).euler(degrees=True)
    assert found[0, 1] == pytest.approx(90)
    assert np.isnan(found[1]).all()
    assert made([UNKNOWN]).euler().shape == (1, 3)


@pytest.mark.parametrize("sequence", ["", "ZY", "ABC", "ZXYZ", "ZZX", "ZXy"])
def test_euler_refuses_what_is_no_sequence(sequence: str) -> None:
    with pytest.raises(RecordingError, match="sequence"):
        made().euler(sequence)


def test_heading_is_the_compass_direction_of_forward() -> None:
    attitude = made(turned(0, -90, 180, 90, -10))
    for forward, expected in {
        "y": [0, 90, 180, 270, 10],
        "x": [90, 180, 270, 0, 100],
        "-x": [270, 0, 90, 180, 280],
    }.items():
        difference = np.degrees(attitude.heading(forward)) - expected
        np.testing.assert_allclose((difference + 180) % 360, 180, atol=1e-9)


def test_heading_of_a_pitched_and_rolled_body_is_that_of_its_forward_axis() -> None:
    attitude = made(wxyz(Rotation.from_euler("ZXY", [[-40, 70, 0], [-40, 0, 130], [-40, -60, 20]], degrees=True)))
    np.testing.assert_allclose(np.degrees(attitude.heading()), 40)


@pytest.mark.parametrize("noise", [1e-17, -1e-17, 1e-300, -1e-300])
def test_heading_never_reaches_a_whole_turn(noise: float) -> None:
    assert 0 <= made([[1.0, 0, 0, noise]]).heading()[0] < 2 * np.pi


def test_tilt_is_the_angle_to_up() -> None:
    attitude = made(wxyz(Rotation.from_euler("ZXY", [[0, 0, 0], [77, 30, 0], [5, 0, -90], [9, 180, 0]], degrees=True)))
    np.testing.assert_allclose(np.degrees(attitude.tilt()), [0, 30, 90, 180], atol=1e-6)
    np.testing.assert_allclose(np.degrees(attitude.tilt("-z")), [180, 150, 90, 0], atol=1e-6)
    np.testing.assert_allclose(np.degrees(attitude.tilt("y")), [90, 60, 90, 90], atol=1e-6)


def test_tilt_is_exact_near_level() -> None:
    assert made(wxyz(Rotation.from_rotvec([[1e-9, 0, 0]]))).tilt()[0] == pytest.approx(1e-9, rel=1e-6)


def test_angle_is_that_of_the_whole_turn() -> None:
    np.testing.assert_allclose(made().angle(), rotation(QUATS).magnitude())


@pytest.mark.parametrize("axis", ["", "w", "yy", "+-y", "forward"])
def test_axes_that_do_not_exist_are_refused(axis: str) -> None:
    for angle in (made().heading, made().tilt):
        with pytest.raises(RecordingError, match="expected one of"):
            angle(axis)


@pytest.mark.parametrize("frame", ["ned", "nwu"])
def test_heading_tilt_and_acceleration_do_not_depend_on_the_frame(frame: Any) -> None:
    here, there = made(), made().to(frame)
    recording = Recording(time=here.time, gyr=None, acc=np.random.default_rng(0).normal(size=(N, 3)))  # type: ignore[arg-type]
    np.testing.assert_allclose(there.heading(), here.heading())
    np.testing.assert_allclose(there.tilt(), here.tilt())
    np.testing.assert_allclose(there.linear_acceleration(recording), here.linear_acceleration(recording), atol=1e-12)


# -- with other things ------------------------------------------------------------------------------------------------


def test_linear_acceleration_is_force_without_gravity() -> None:
    attitude = made()
    in_earth = np.random.default_rng(6).normal(size=(N, 3))
    force = rotation(QUATS).inv().apply(in_earth + np.array([0, 0, 9.7]))
    recording = Recording(time=attitude.time, gyr=np.zeros((N, 3)), acc=force, gravity=9.7)
    np.testing.assert_allclose(attitude.linear_acceleration(recording), in_earth, atol=1e-12)
    in_body = rotation(QUATS).inv().apply(in_earth)
    np.testing.assert_allclose(attitude.linear_acceleration(recording, frame="body"), in_body, atol=1e-12)


def test_linear_acceleration_refuses_other_rows_and_frames() -> None:
    recording = Recording.at_rate(10, np.zeros((N, 3)), np.zeros((N, 3)))
    with pytest.raises(RecordingError, match="recording has 39 rows, the attitude 40; resample"):
        made().linear_acceleration(recording[1:])
    with pytest.raises(RecordingError, match='"earth" or "body"'):
        made().linear_acceleration(recording, frame="enu")  # type: ignore[arg-type]


def test_relative_to_is_the_joint_and_the_earth_frame_cancels() -> None:
    thigh, joint = rotation(QUATS), Rotation.from_rotvec(np.linspace(0, 1.5, N)[:, None] * [1, 0, 0])
    shank = thigh * joint
    found = made(wxyz(shank)).relative_to(made(QUATS))
    assert_same_attitude(found.quat, wxyz(joint))
    np.testing.assert_allclose(found.angle(), np.linspace(0, 1.5, N), atol=1e-9)
    assert (found.frame, found.heading_reference) == ("body", "arbitrary")

    shared_error = Rotation.from_rotvec([0.3, -0.2, 2.0])
    moved = made(wxyz(shared_error * shank)).relative_to(made(wxyz(shared_error * thigh)))
    assert_same_attitude(moved.quat, found.quat)


def test_relative_to_subtracts_the_rates_in_this_body() -> None:
    this, other = full(seed=7), full(seed=8)
    found = this.relative_to(other)
    others_rate_here = (rotation(this.quat).inv() * rotation(other.quat)).apply(other.rate)
    np.testing.assert_allclose(found.rate, this.rate - others_rate_here, atol=1e-12)


def test_relative_to_has_the_spread_of_both_about_the_others_axes() -> None:
    random = np.random.default_rng(3)
    this, other = random.uniform(0.001, 0.01, (2, 3))
    base, body = Rotation.random(2, rng=random)
    mine, theirs = (Rotation.from_rotvec(random.normal(0.0, sigma, (40_000, 3))) for sigma in (this, other))
    turns = (theirs * base).inv() * (mine * body) * (base.inv() * body).inv()
    first, second = made(wxyz(body)[None]), made(wxyz(base)[None])
    first.sigma[:], second.sigma[:] = this, other
    np.testing.assert_allclose(first.relative_to(second).sigma[0], turns.as_rotvec().std(axis=0), rtol=0.02)


def test_relative_to_takes_the_other_at_this_ones_times_and_both_flags() -> None:
    slow = made(turned(*range(0, 100, 10)), step=0.2)
    fast = made(turned(*range(0, 91, 5)), step=0.1)
    slow.flags[2], fast.flags[7] = Flag.REST, Flag.GAP
    found = fast.relative_to(slow)
    np.testing.assert_array_equal(found.time, fast.time)
    np.testing.assert_allclose(found.angle(), 0, atol=1e-7)
    np.testing.assert_array_equal(np.flatnonzero(found.flags), [3, 4, 5, 7])


def test_relative_to_goes_row_by_row_where_the_stamps_are_the_same() -> None:
    this, other = made(), made(random_quats(N, 9))
    this.time[7] = other.time[7] = np.nan
    expected = wxyz(rotation(other.quat).inv() * rotation(this.quat))
    assert_same_attitude(this.relative_to(other).quat, expected)


def test_relative_to_refuses_another_frame_and_earth_angles_refuse_the_result() -> None:
    joint = made().relative_to(made())
    with pytest.raises(RecordingError, match=r"frames differ: enu and ned; convert one with \.to\(\)"):
        made().relative_to(made().to("ned"))
    for earthly in (joint.heading, joint.tilt):
        with pytest.raises(RecordingError, match="relative to another body"):
            earthly()
    with pytest.raises(RecordingError, match="frame 'body'"):
        joint.to("ned")


def test_resample_is_exact_at_its_own_stamps() -> None:
    attitude = full()
    attitude.flags[:] = np.arange(N) % 2 * Flag.REST
    found = attitude.resample(attitude.time)
    assert_same_attitude(found.quat, attitude.quat, 1e-15)
    np.testing.assert_array_equal(found.table[:, 4:], attitude.table[:, 4:])
    np.testing.assert_array_equal(found.flags, attitude.flags)
    assert found.provenance == attitude.provenance


def test_resample_turns_evenly_in_between_in_any_order() -> None:
    attitude = made(turned(0, 40, 80), step=0.5)
    attitude.rate[:] = [[0.0, 0, 0], [1, 2, 3], [1, 2, 3]]
    found = attitude.resample([0.75, 0.125, 1.0, 0.0])
    np.testing.assert_allclose(found.euler(degrees=True)[:, 0], [60, 10, 80, 0], atol=1e-9)
    np.testing.assert_allclose(found.rate[:2], [[1, 2, 3], [0.25, 0.5, 0.75]])
    assert found.valid.all()


def test_resample_keeps_the_flags_of_both_neighbours() -> None:
    attitude = made(turned(0, 1, 2))
    attitude.flags[:] = [Flag.REST, Flag.GAP, 0]
    np.testing.assert_array_equal(
        attitude.resample([0.0, 0.05, 0.1, 0.15]).flags, [Flag.REST, Flag.REST | Flag.GAP, Flag.GAP, Flag.GAP]
    )


def test_resample_is_unknown_outside_and_at_no_time() -> None:
    found = made().resample([-0.01, 100.0, np.nan])
    assert np.isnan(found.table).all()
    assert not found.valid.any()
    nothing = made()[:0].resample([0.0])
    assert np.isnan(nothing.quat).all() and not nothing.valid.any()
    assert len(made().resample([])) == 0


def test_resample_does_not_bridge_gaps() -> None:
    attitude = Attitude.of([0.0, 1.0, 3.0, 4.0], turned(0, 10, 20, 30))
    found = attitude.resample([0.5, 1.0, 2.0, 3.0, 3.5])
    np.testing.assert_array_equal(found.valid, [True, True, False, True, True])
    assert np.isnan(found.quat[2]).all()
    assert found.flags[2] & Flag.GAP
    assert attitude.resample([2.0], max_gap=2.0).valid.all()


def test_resample_does_not_bridge_rows_without_attitude() -> None:
    attitude = made([*turned(0, 10), UNKNOWN, *turned(30)], step=0.5)
    found = attitude.resample([0.5, 0.75, 1.0, 1.25, 1.5])
    np.testing.assert_array_equal(found.valid, [True, False, False, False, True])
    np.testing.assert_array_equal(np.isnan(found.quat[:, 0]), [False, True, True, True, False])


def test_resample_passes_over_stamps_that_do_not_rise() -> None:
    attitude = Attitude.of([np.nan, 0.0, 0.2, 0.1, 0.2, np.nan, 0.4], turned(90, 0, 20, 90, 90, 90, 40))
    found = attitude.resample([0.1, 0.2, 0.3])
    np.testing.assert_allclose(found.euler(degrees=True)[:, 0], [10, 20, 30], atol=1e-9)


def test_resample_refuses_tables_of_times() -> None:
    with pytest.raises(RecordingError, match=r"time \(m,\) expected, found \(1, 2\)"):
        made().resample([[0.0, 1.0]])


@pytest.mark.parametrize(("frame", "change"), [("ned", NED_FROM_ENU), ("nwu", NWU_FROM_ENU)])
def test_to_changes_the_earths_axes_and_comes_back(frame: Any, change: np.ndarray) -> None:
    attitude = full()
    there = attitude.to(frame)
    assert there.frame == frame
    np.testing.assert_allclose(
        there.as_rotation().as_matrix(), change @ rotation(attitude.quat).as_matrix(), atol=1e-14
    )
    np.testing.assert_allclose(there.sigma, attitude.sigma @ np.abs(change).T)
    np.testing.assert_array_equal(there.rate, attitude.rate)
    back = there.to("enu")
    assert_same_attitude(back.quat, attitude.quat)
    np.testing.assert_array_equal(back.table[:, 4:], attitude.table[:, 4:])


def test_to_goes_between_ned_and_nwu() -> None:
    attitude = full().to("ned")
    found = attitude.to("nwu")
    flip = np.diag([1.0, -1, -1])
    np.testing.assert_allclose(found.as_rotation().as_matrix(), flip @ attitude.as_rotation().as_matrix(), atol=1e-14)
    np.testing.assert_array_equal(found.sigma, attitude.sigma)


def test_a_level_sensor_that_faces_north() -> None:
    attitude = made([LEVEL_NORTH])
    assert attitude.heading()[0] == 0
    assert attitude.tilt()[0] == 0
    np.testing.assert_array_equal(attitude.euler(), 0)
    # An autopilot's body is forward, right, down; level and facing north it is aligned with NED.
    assert_same_attitude(attitude.to("ned", body="y x -z").quat, [LEVEL_NORTH])
    east = made(turned(-90)).to("ned", body="y x -z")
    np.testing.assert_allclose(east.euler("ZYX", degrees=True), [[90, 0, 0]], atol=1e-9)


@pytest.mark.parametrize(
    "body", [[[0, 1, 0], [-1, 0, 0], [0, 0, 1]], Rotation.from_rotvec([0.4, -1.0, 0.3]).as_matrix()]
)
def test_to_renames_the_bodys_axes_in_every_column(body: Any) -> None:
    attitude = full()
    found = attitude.to("enu", body=body)
    before, after = rotation(attitude.quat), rotation(found.quat)
    np.testing.assert_allclose(after.apply(np.array(body) @ [1.0, 2, 3]), before.apply([1.0, 2, 3]), atol=1e-12)
    np.testing.assert_allclose(after.apply(found.rate), before.apply(attitude.rate), atol=1e-12)
    np.testing.assert_allclose(after.apply(found.bias), before.apply(attitude.bias), atol=1e-12)
    np.testing.assert_array_equal(found.sigma, attitude.sigma)
    np.testing.assert_allclose(np.sum(found.bias_sigma**2, axis=1), np.sum(attitude.bias_sigma**2, axis=1))


def test_body_words_name_the_sensor_axis_that_each_new_axis_takes() -> None:
    attitude = full()
    found = attitude.to("enu", body="y -x z")
    np.testing.assert_allclose(found.rate, attitude.rate[:, [1, 0, 2]] * [1, -1, 1])
    np.testing.assert_allclose(found.bias_sigma, attitude.bias_sigma[:, [1, 0, 2]])


def test_to_refuses_unknown_frames_and_mirror_images() -> None:
    with pytest.raises(RecordingError, match="from frame 'enu' to 'esu'; frames are enu, ned, nwu"):
        made().to("esu")  # type: ignore[arg-type]
    with pytest.raises(RecordingError, match="left-handed"):
        made().to("ned", body="x y -z")


# -- exits ------------------------------------------------------------------------------------------------------------


def test_as_rotation_is_the_attitude() -> None:
    np.testing.assert_allclose(made().as_rotation().as_matrix(), rotation(QUATS).as_matrix(), atol=1e-15)


def test_as_rotation_refuses_unknown_rows_and_says_what_to_do() -> None:
    attitude = made([LEVEL_NORTH, UNKNOWN, UNKNOWN])
    with pytest.raises(RecordingError, match=r"2 of 3 rows have no attitude.*attitude\[attitude\.valid\]"):
        attitude.as_rotation()
    assert len(attitude[attitude.valid].as_rotation()) == 1


VECTORS = ("rate", "bias", "sigma", "bias_sigma")
NAMES = ["time", *(f"q{c}" for c in "wxyz"), *(f"{v}_{c}" for v in VECTORS for c in "xyz"), "flags", "valid"]


@pytest.mark.parametrize("backend", ["pandas", "polars"])
def test_to_frame_has_every_column(backend: Any) -> None:
    pytest.importorskip(backend)
    attitude = full()
    frame = attitude.to_frame(backend)
    assert list(frame.columns) == NAMES
    np.testing.assert_array_equal(frame["qw"], attitude.quat[:, 0])
    np.testing.assert_array_equal(frame["bias_sigma_z"], attitude.bias_sigma[:, 2])
    np.testing.assert_array_equal(frame["valid"], attitude.valid)


def test_to_frame_refuses_other_backends() -> None:
    with pytest.raises(RecordingError, match="'excel' not known"):
        made().to_frame("excel")  # type: ignore[arg-type]


def test_to_arrow_carries_the_facts() -> None:
    attitude = full()
    attitude.flags[3] = Flag.LOST
    table = attitude.to("ned").to_arrow()
    assert table.column_names == NAMES
    np.testing.assert_array_equal(table["rate_y"], attitude.rate[:, 1])
    np.testing.assert_array_equal(table["flags"], attitude.flags)
    np.testing.assert_array_equal(table["valid"], np.arange(N) != 3)
    facts = {key.decode(): value.decode() for key, value in table.schema.metadata.items()}
    assert facts["poise.frame"] == "ned"
    assert facts["poise.heading_reference"] == "magnetic"
    assert facts["poise.version"] == poise.__version__
    assert facts["poise.method"] == "two-stage"
    assert facts["poise.source"] == "walk.csv" and facts["poise.source_sha256"] == "ab12"
    assert "w x y z" in facts["poise.quaternion"] and "NED" in facts["poise.quaternion"]
    assert "rad/s" in facts["poise.units"]
    assert json.loads(facts["poise.parameters"]) == {"gain": 2.0}
    assert json.loads(facts["poise.flags"]) == {flag.name: flag.value for flag in Flag}


def test_reasons_tell_every_flagged_stretch_in_order() -> None:
    attitude = made(np.tile(LEVEL_NORTH, (100, 1)))
    attitude.flags[50:53] |= np.uint32(Flag.GAP)
    attitude.flags[10:20] |= np.uint32(Flag.REST)
    attitude.flags[12] |= np.uint32(Flag.GYR_MISSING)
    attitude.flags[90:] |= np.uint32(Flag.REST)
    found = attitude.reasons()
    assert [(r.flag, r.samples) for r in found] == [
        (Flag.REST, 10),
        (Flag.GYR_MISSING, 1),
        (Flag.GAP, 3),
        (Flag.REST, 10),
    ]
    assert (found[0].start, found[0].end) == pytest.approx((1.0, 1.9))
    assert str(found[2]) == f"5.00-5.20 s (3 samples): {SENTENCES[Flag.GAP]}"
    assert made().reasons() == []
    assert set(SENTENCES) == set(Flag)


def test_reasons_bridge_short_pauses_only() -> None:
    attitude = made(np.tile(LEVEL_NORTH, (20, 1)))
    attitude.flags[[2, 4, 9]] = Flag.REST
    assert [r.samples for r in attitude.reasons()] == [2, 1]
    assert [r.samples for r in attitude.reasons(bridge=0.1)] == [1, 1, 1]
    assert [r.samples for r in attitude.reasons(bridge=1.0)] == [3]


def test_reasons_of_rows_without_stamps_have_times_to_show() -> None:
    attitude = Attitude.of([np.nan, np.nan, 0.0, 0.1, np.nan], np.tile(LEVEL_NORTH, (5, 1)))
    attitude.flags[[0, 1, 4]] = Flag.TIME_DISORDER
    found = attitude.reasons(bridge=0.05)
    assert sum(r.samples for r in found) == 3
    assert all(np.isfinite([r.start, r.end]).all() for r in found)
