"""Estimators side by side: figures against a reference, and who departs when there is none."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Annotated, Any, NamedTuple

import numpy as np
import pytest

import poise
from poise.comparison import Comparison, departures, tables
from poise.comparison.agreement import aligned, consensus, median_direction
from poise.data.flags import ACC_DOUBTED, RESET, Flag
from poise.errors import PoiseError, RecordingError
from poise.estimators import METHODS
from poise.math import arrays
from poise.peers import Peer
from poise.simulation import forearm, measure

TRUTHFUL = ("a", "b", "c", "d")


@pytest.fixture(scope="module")
def recording() -> poise.Recording:
    return measure(forearm(30.0), seed=3, name="an arm")


@pytest.fixture(scope="module")
def blind(recording: poise.Recording) -> poise.Recording:
    return replace(recording, truth=None, moving=None)


def planted(quat: np.ndarray, name: str, has_heading: bool = True) -> Peer:
    """An estimator that answers *quat*; "numpy" stands for a package that is installed."""
    return Peer(name, "numpy", "planted", lambda _: quat, has_heading)


def truthful(recording: poise.Recording) -> dict[str, Peer]:
    assert recording.truth is not None
    return {name: planted(recording.truth.quat, name) for name in TRUTHFUL}


def turned(recording: poise.Recording, degrees: float, rows: slice, axis: str = "up") -> np.ndarray:
    """The reference, turned about up (heading) or east (inclination) in some rows."""
    assert recording.truth is not None
    half = np.radians(degrees) / 2
    turn = np.array([np.cos(half), 0.0, 0.0, np.sin(half)] if axis == "up" else [np.cos(half), np.sin(half), 0.0, 0.0])
    quat = recording.truth.quat.copy()
    quat[rows] = arrays.multiply(turn, quat[rows])
    return quat


@pytest.fixture(scope="module")
def with_truth(recording: poise.Recording) -> Comparison:
    return poise.compare(recording)


def test_every_method_runs_with_the_figures_of_evaluate(with_truth: Comparison, recording: poise.Recording) -> None:
    assert [run.name for run in with_truth.runs] == list(METHODS)
    assert with_truth.against == "reference"
    for run in with_truth.runs:
        assert run.attitude is not None and run.errors is not None
        expected = poise.evaluate(poise.estimate(METHODS[run.name](), recording), recording)
        np.testing.assert_array_equal(run.errors.inclination, expected.inclination)
        figures = run.figures()
        assert figures["inclination"] == expected.table()["inclination"]
        if "declination" in METHODS[run.name]._fields:
            assert run.heading == "own" and figures == expected.table()
        else:
            assert run.heading == "none" and set(figures) == {"inclination"}


def test_the_document_is_json_without_nan_and_its_keys_are_stable(with_truth: Comparison) -> None:
    document = json.loads(json.dumps(with_truth.to_dict(), allow_nan=False))
    assert set(document) == {
        "recording", "against", "limit_deg", "notes", "estimators", "apart_rms_deg", "stretches",
    }  # fmt: skip
    assert set(document["estimators"][0]) == {
        "name", "kind", "settings", "heading", "failure", "error_deg", "rows", "missing", "valid", "diverged", "settled_s",
        "worst_5s", "seconds_away",
    }  # fmt: skip
    tilt = next(line for line in document["estimators"] if line["name"] == "tilt")
    assert tilt["error_deg"]["total"] is None and tilt["error_deg"]["inclination"]["rmse"] > 0


@pytest.mark.parametrize(("axis", "part"), [("up", "heading"), ("east", "inclination")])
def test_a_planted_disagreement_is_found_and_blamed(
    recording: poise.Recording, blind: poise.Recording, axis: str, part: str
) -> None:
    rows = slice(1000, 1500)
    peers = truthful(recording) | {"liar": planted(turned(recording, 25.0, rows, axis), "liar")}
    comparison = poise.compare(blind, {}, peers)
    assert comparison.against == "consensus"
    [stretch] = comparison.stretches()
    assert stretch.estimator == "liar" and stretch.part == part
    assert (stretch.start, stretch.end) == pytest.approx((blind.time[1000], blind.time[1499]), abs=0.02)
    assert stretch.median_deg == pytest.approx(25.0, abs=0.2)
    assert (stretch.others_within, stretch.others, stretch.majority) == (4, 4, True)
    assert comparison.seconds_away("liar") == pytest.approx(5.0, abs=0.05)
    assert "liar is off the consensus in " + part in tables.told(stretch, comparison)
    i = comparison.pairs.names.index("liar")
    assert getattr(comparison.pairs, part)[0, i] == pytest.approx(25.0 * np.sqrt(500 / 3000), rel=0.01)


def test_seconds_away_are_of_the_rows_beyond_the_limit_not_of_the_stretch(recording: poise.Recording) -> None:
    quat = turned(recording, 25.0, slice(1000, 1020))
    for first in range(1080, 1500, 80):  # 0.2 s beyond, 0.6 s within: one stretch
        quat[first : first + 20] = turned(recording, 25.0, slice(first, first + 20))[first : first + 20]
    quat[2000:2010] = turned(recording, 25.0, slice(2000, 2010))[2000:2010]  # too short to be told
    comparison = poise.compare(recording, {}, {"liar": planted(quat, "liar")})
    [stretch] = comparison.stretches()
    assert stretch.end - stretch.start == pytest.approx(5.0, abs=0.05)
    assert comparison.seconds_away("liar") == pytest.approx(7 * 0.2 + 0.1, abs=0.001)


def test_a_gap_in_the_stamps_is_not_time_beyond_the_limit() -> None:
    time = np.array([0.0, 0.01, 0.02, 60.0, 60.01])
    assert departures.beyond(time, np.array([0.0, 0.0, 0.3, 0.0, 0.3]), 0.1) == pytest.approx(0.02)
    assert departures.beyond(time[:1], np.array([0.3]), 0.1) == 0.0
    assert departures.beyond(time[:0], np.empty(0), 0.1) == 0.0


def test_with_a_reference_the_same_stretch_is_counted_from_it(recording: poise.Recording) -> None:
    everyone = {name: planted(turned(recording, 25.0, slice(1000, 1500)), name) for name in TRUTHFUL}
    found = poise.compare(recording, {}, everyone).stretches()
    assert {s.estimator for s in found} == set(TRUTHFUL)  # wrong together, which a consensus could not see
    assert not any(s.majority for s in found)


def test_an_estimator_without_heading_is_judged_by_inclination(
    recording: poise.Recording, blind: poise.Recording
) -> None:
    headless = planted(turned(recording, 90.0, slice(None)), "headless", has_heading=False)
    comparison = poise.compare(blind, {}, truthful(recording) | {"headless": headless})
    assert comparison.stretches() == ()
    run = comparison.runs[-1]
    assert set(run.figures()) == {"inclination"} and run.figures()["inclination"]["max"] < 0.01
    assert np.isnan(comparison.pairs.heading[-1]).all() and np.isfinite(comparison.pairs.inclination).all()


def test_arbitrary_headings_are_aligned_once(recording: poise.Recording, blind: poise.Recording) -> None:
    silent = replace(blind, mag=np.full_like(blind.mag, np.nan))
    peers = truthful(recording) | {"e": planted(turned(recording, 70.0, slice(None)), "e")}
    comparison = poise.compare(silent, {}, peers)
    assert {run.heading for run in comparison.runs} == {"aligned"}
    assert comparison.runs[-1].figures()["heading"]["max"] < 0.01
    assert any("no magnetometer" in note for note in comparison.notes)


def test_two_alone_cannot_be_blamed(recording: poise.Recording, blind: poise.Recording) -> None:
    two = {"a": truthful(recording)["a"], "b": planted(turned(recording, 40.0, slice(None)), "b")}
    comparison = poise.compare(blind, {}, two)
    for run in comparison.runs:
        assert run.figures()["heading"]["median"] == pytest.approx(20.0, abs=0.1)
    assert any("neither can be blamed" in note for note in comparison.notes)


def test_where_there_is_no_majority_it_is_said(recording: poise.Recording, blind: poise.Recording) -> None:
    split = truthful(recording) | {
        n: planted(turned(recording, 60.0, slice(500, 1500)), n) for n in ("e", "f", "g", "h")
    }
    assert any("10.0 s in all" in note for note in poise.compare(blind, {}, split).notes)


@pytest.mark.parametrize(("far", "said"), [((60.0, -60.0), False), ((60.0, -60.0, 90.0), True)])
def test_half_within_the_limit_is_enough(
    recording: poise.Recording, blind: poise.Recording, far: tuple[float, ...], said: bool
) -> None:
    everyone = {name: truthful(recording)[name] for name in "ab"}
    everyone |= {f"far{d:g}": planted(turned(recording, d, slice(500, 1500)), f"far{d:g}") for d in far}
    assert any("fewer than half" in note for note in poise.compare(blind, {}, everyone).notes) is said


def test_one_that_fails_is_a_row_with_its_reason(recording: poise.Recording) -> None:
    def broken(_: poise.Recording) -> np.ndarray:
        raise ZeroDivisionError("no luck")

    comparison = poise.compare(recording, {}, truthful(recording) | {"broken": Peer("broken", "numpy", "", broken)})
    assert len(comparison.done) == len(TRUTHFUL)
    assert "no luck" in comparison.runs[-1].failure
    table = tables.estimators(comparison)
    assert all(len(row) == len(table.columns) for row in table.rows) and "no luck" in table.rows[-1][-1]
    json.dumps(comparison.to_dict(), allow_nan=False)


def test_nothing_usable_is_told_row_by_row() -> None:
    empty = poise.Recording.at_rate(100.0, np.full((50, 3), np.nan), np.full((50, 3), np.nan))
    comparison = poise.compare(empty, ["two-stage"], "vqf")
    assert comparison.done == [] and comparison.stretches() == () and comparison.best is None
    assert all(run.failure for run in comparison.runs)
    table = tables.estimators(comparison)
    assert not any("consensus" in text for text in (*comparison.notes, table.title, *table.columns))
    assert [row[-1] for row in table.rows] == [run.failure for run in comparison.runs]
    assert tables.mean_tables([comparison, comparison]) == []
    json.dumps(comparison.to_dict(), allow_nan=False)


class Unfinished(NamedTuple):
    """A method that is none."""

    gain: Annotated[float, "1", "a number"] = 1.0


def test_what_cannot_be_compared_is_refused(recording: poise.Recording) -> None:
    for bad in ({"methods": ["magic"]}, {"peers": "magic"}, {"methods": {}}, {"limit_deg": 0.0}, {"limit_deg": np.nan}):
        with pytest.raises(PoiseError):
            poise.compare(recording, **bad)
    with pytest.raises(RecordingError, match="no rows"):
        poise.compare(recording[:0])
    assert "Unfinished" in poise.compare(recording, {"mine": Unfinished()}).runs[0].failure


@pytest.mark.parametrize(
    "bad",
    [
        {"methods": {"mine": poise.TwoStage}},
        {"methods": poise.TwoStage},
        {"methods": [poise.TwoStage()]},
        {"methods": {1: poise.TwoStage()}},
        {"methods": {"mine": "two-stage"}},
        {"methods": [1]},
        {"methods": 5},
        {"peers": 5},
        {"peers": [None]},
        {"peers": {"mine": "vqf"}},
        {"limit_deg": "5"},
        {"limit_deg": None},
        {"limit_deg": True},
    ],
)
def test_what_is_no_estimator_is_refused_in_words(recording: poise.Recording, bad: dict[str, Any]) -> None:
    with pytest.raises(PoiseError, match="expected"):
        poise.compare(recording, **({"methods": "tilt"} | bad))


def test_a_single_method_or_a_list_of_peers_will_do(recording: poise.Recording) -> None:
    assert [run.name for run in poise.compare(recording[:200], poise.TwoStage()).runs] == ["two-stage"]
    assert [run.name for run in poise.compare(recording, Unfinished(), truthful(recording)["a"]).runs] == [
        "Unfinished",
        "a",
    ]
    assert [run.name for run in poise.compare(recording[:200], "tilt", []).runs] == ["tilt"]
    pytest.importorskip("vqf")
    names = [run.name for run in poise.compare(recording[:200], {}, ["vqf-offline", "vqf"]).runs]
    assert names == ["vqf-offline", "vqf"]


def test_a_flag_explains_only_what_it_can(recording: poise.Recording, blind: poise.Recording) -> None:
    assert blind.truth is None
    attitude = poise.Attitude.of(
        blind.time, turned(recording, 25.0, slice(1000, 1500), "east"), heading_reference="magnetic"
    )
    attitude.flags[1000:1400] |= np.uint32(ACC_DOUBTED | Flag.MAG_MISSING)
    attitude.flags[950] |= np.uint32(RESET)
    attitude.flags[2500] |= np.uint32(RESET)
    errors = poise.evaluate(attitude, recording)
    assert recording.truth is not None
    [found] = departures.stretches(
        blind, {"x": departures.Judged(attitude, errors, True)}, recording.truth, np.radians(10)
    )
    told = " ".join(found.reasons)
    assert "counts less (80% of the stretch)" in told and "set anew" in told and "0.5 s before it begins" in told
    assert "magnetometer sample" not in told  # a missing magnetometer does not tilt anything


@pytest.mark.parametrize(
    ("rows", "is_start"),
    [(slice(0, 300), True), (slice(50, 300), False), (slice(0, 1200), False), (slice(2800, None), False)],
)
def test_its_start_is_what_begins_with_the_first_row_and_is_over(
    recording: poise.Recording, rows: slice, is_start: bool
) -> None:
    [found] = poise.compare(recording, {}, {"liar": planted(turned(recording, 25.0, rows), "liar")}).found
    assert any("its start" in reason for reason in found.reasons) is is_start


def test_a_departure_that_is_the_whole_recording_is_not_its_start(recording: poise.Recording) -> None:
    short = recording[:500]
    [found] = poise.compare(short, {}, {"liar": planted(turned(short, 25.0, slice(None)), "liar")}).found
    assert not found.reasons


def test_where_no_row_moves_it_is_said(recording: poise.Recording) -> None:
    still = replace(recording, moving=np.zeros(len(recording), bool))
    comparison = poise.compare(still, {}, truthful(recording))
    assert any("no row moves, so none counts" in note for note in comparison.notes)
    for row in tables.estimators(comparison).rows:
        assert not any(np.isfinite(cell) for cell in row if isinstance(cell, float)) and row[6] == "-"
    assert not any("moves" in note for note in poise.compare(recording, {}, truthful(recording)).notes)


def test_a_disturbed_field_is_told(recording: poise.Recording) -> None:
    mag = recording.mag.copy()
    mag[1000:1500] *= 1.4
    disturbed = replace(recording, mag=mag)
    [found] = poise.compare(disturbed, {}, {"liar": planted(turned(recording, 25.0, slice(1000, 1500)), "liar")}).found
    assert any("1.4" in text and "usual strength" in text for text in found.sensors)


def test_the_median_direction_resists_one_that_is_far_off() -> None:
    rng = np.random.default_rng(0)
    near = np.array([0.0, 0.0, 1.0]) + 0.01 * rng.normal(size=(6, 50, 3))
    near /= np.linalg.norm(near, axis=2, keepdims=True)
    far = np.tile([1.0, 0.0, 0.0], (2, 50, 1))
    median = median_direction(np.concatenate([near, far]))
    assert np.degrees(np.arccos(median[:, 2])).max() < 2.0
    far[:] = np.nan
    assert np.isfinite(median_direction(np.concatenate([near, far]))).all()
    assert np.isnan(median_direction(far)).all()
    assert np.isfinite(median_direction(np.array([[[1.0, 0.0]], [[-1.0, 0.0]]]))).all()


def test_consensus_and_alignment_at_every_pose() -> None:
    quat = arrays.normalize(np.random.default_rng(1).normal(size=(400, 4)))
    quat[0] = (0.0, 1.0, 0.0, 0.0)  # upside down
    attitude = poise.Attitude.of(np.arange(400) / 100.0, quat)
    agreed = consensus([attitude] * 3, [True, True, False])
    assert np.degrees(arrays.angle(arrays.multiply(agreed.quat, arrays.conjugate(quat)))).max() < 1e-4
    away = poise.Attitude.of(attitude.time, arrays.multiply(arrays.turn_about_up(np.array(2.5)), quat))
    back = aligned(away, attitude)
    assert np.degrees(arrays.angle(arrays.multiply(back.quat, arrays.conjugate(quat)))).max() < 1e-4
    assert not np.shares_memory(back.table, away.table)


def test_worst_and_settled() -> None:
    time = np.arange(3000) / 100.0
    angle = np.where(time < 2.0, 0.5, 0.01)
    angle[1200:1700] = 0.3
    worst = departures.worst(time, angle)
    assert worst is not None and worst["start"] == pytest.approx(12.0, abs=0.05)
    assert worst["mean_deg"] == pytest.approx(np.degrees(0.3), rel=0.01)
    assert departures.settled(time, angle, 0.1) == pytest.approx(2.0)
    assert departures.settled(time, np.full_like(time, 0.2), 0.1) is None
    assert departures.worst(time, np.full_like(time, np.nan)) is None


def test_means_say_over_how_many(recording: poise.Recording) -> None:
    good = poise.compare(recording, {}, truthful(recording))
    bad = poise.compare(recording, {}, {"a": Peer("a", "no-such-package", "", lambda _: np.empty(0))})
    rows = {row["name"]: row for row in tables.means([good, bad])}
    assert (rows["a"]["files"], rows["a"]["of"]) == (1, 2)
    [table] = tables.mean_tables([good, bad])
    assert table.rows[0][-1] == "1 of 2"


def test_stamps_since_1970_are_told_from_the_first(recording: poise.Recording, blind: poise.Recording) -> None:
    peers = truthful(recording) | {"liar": planted(turned(recording, 25.0, slice(1000, 1500)), "liar")}
    comparison = poise.compare(replace(blind, time=blind.time + 1.7e9), {}, peers)
    [stretch] = comparison.stretches()
    assert stretch.start == pytest.approx(1.7e9 + 10.0, abs=0.1)  # the recording's own clock
    assert tables.told(stretch, comparison).startswith("10.0-15.0 s: liar")
    assert tables.estimators(comparison).rows[-1][7].endswith("at 10 s")
