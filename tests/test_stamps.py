"""Stamps of rows that came in packets: seen as a whole, evened by the guard, and what files, doctor and peers make of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import poise
from data_files import data_path
from helpers import angle_between, in_packets
from poise.data.stamps import packed, usual_step
from poise.estimators.guard.stamps import evened, unpacked
from poise.peers import PEERS
from poise.peers.even import prepared
from poise.simulation import Sensor, forearm, measure

KINDS: dict[str, dict[str, Any]] = {
    "stamp of the last": {},
    "stamp of the first": {"first": True},
    "stamp of the arrival": {"late": 0.004},
    "read one after the other": {"late": 0.002, "apart": 5e-5},
}


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
@pytest.mark.parametrize("rate", [25.0, 100.0, 286.0])
def test_packets_are_seen_and_evened(kind: dict[str, Any], rate: float) -> None:
    true = 7.0 + np.arange(round(40.0 * rate)) / rate
    stamps = in_packets(true, 5, **kind)
    found = packed(stamps)
    assert found is not None
    assert 1.0 / found.step == pytest.approx(rate, rel=0.02)
    assert (found.fewest, found.most) == (4, 12)
    assert usual_step(stamps) == found.step
    steps = np.diff(unpacked(stamps))
    assert np.abs(steps[round(5.0 * rate) :] * rate - 1.0).max() < 0.05
    assert np.diff(evened(stamps + 1e9)).min() >= 0.0


@pytest.mark.parametrize(
    "stamps",
    [
        np.arange(2000) / 100.0,
        np.arange(2000) / 100.0 + np.random.default_rng(0).uniform(-0.004, 0.004, 2000),
        np.flatnonzero(np.random.default_rng(0).random(4000) < 0.7) / 100.0,
        np.floor(np.arange(2000) / 286.0 * 1000.0) / 1000.0,
        np.arange(2000) / 100.0 + 60.0 * (np.arange(2000) > 1000),
        np.array([0.0, 0.0, 1.0]),
        np.full(50, 3.0),
        np.full(50, np.nan),
        np.empty(0),
    ],
    ids=["even", "jitter", "30 % lost", "whole milliseconds", "a pause", "three", "one", "none", "empty"],
)
def test_other_stamps_are_no_packets(stamps: np.ndarray[tuple[int], np.dtype[np.float64]]) -> None:
    assert packed(stamps) is None
    assert unpacked(stamps) is stamps
    rising = np.diff(stamps)[np.diff(stamps) > 0]
    assert usual_step(stamps) == (np.median(rising) if len(rising) else pytest.approx(np.nan, nan_ok=True))


@settings(deadline=None, max_examples=60)
@given(st.lists(st.floats(allow_nan=True, allow_infinity=True) | st.integers(0, 3).map(float), max_size=60))
def test_evened_stamps_never_fall(stamps: list[float]) -> None:
    even = evened(np.array(stamps))
    assert len(even) == len(stamps)
    known = even[np.isfinite(even)]
    assert (np.diff(known) >= 0.0).all()


@pytest.mark.parametrize(
    "kind", [KINDS["stamp of the last"], KINDS["read one after the other"]], ids=["shared", "read"]
)
def test_the_doctor_says_so_and_finds_what_it_finds_with_good_stamps(kind: dict[str, Any]) -> None:
    recording = poise.read(next(data_path("broad").glob("05_*.mat")))
    found = poise.diagnose(recording.with_samples(time=in_packets(recording.time, 2, **kind)))
    assert not found.found("sure")
    told = {finding.name: finding.sentence for finding in found.findings}
    assert "packets of 4 to 12 rows" in told["packets"]
    assert "285.7" in told["packets"]
    assert not {"drops", "gaps", "stamps"} & set(told)
    assert float(told["mag delay"].split(":")[1].split()[0]) == pytest.approx(13.0, abs=1.5)  # ms
    assert not any(finding.fix for finding in found.findings)  # such stamps are too coarse to take a delay out


@pytest.mark.parametrize("unit", [1.0, 1000.0])
@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_a_file_without_units_is_read(tmp_path: Path, kind: dict[str, Any], unit: float) -> None:
    made = measure(forearm(30.0, 100.0, seed=1), Sensor(jitter=0.0), seed=1)
    time = in_packets(made.time, 1, **kind)
    table = np.column_stack([unit * time, np.degrees(made.gyr), made.acc / 9.80665, made.mag])
    file = tmp_path / "serial.csv"
    np.savetxt(file, table, "%.6f", ",", header="time,gx,gy,gz,ax,ay,az,mx,my,mz", comments="")
    recording = poise.read(file)
    assert recording.rate_hz == pytest.approx(100.0, rel=0.02)
    np.testing.assert_allclose(recording.gyr, made.gyr, atol=1e-6)
    assert any("packets of 4 to 12 rows" in note for note in recording.notes)
    assert poise.sniff(file).gaps[0] == 0
    away = angle_between(poise.estimate(poise.TwoStage(), recording).quat, poise.estimate(poise.TwoStage(), made).quat)
    assert np.degrees(away).max() < 2.0


def test_peers_run_on_evened_stamps() -> None:
    made = measure(forearm(30.0, 100.0, seed=1), Sensor(jitter=0.0), seed=1)
    even, notes = prepared(made.with_samples(time=in_packets(made.time, 1, apart=5e-5)))
    assert notes[0] == "packets of 4 to 12 rows stamped 0.05 ms apart: taken to be evenly apart"
    assert even.rate_hz == pytest.approx(100.0, rel=0.01)
    np.testing.assert_allclose(np.diff(even.time), 1.0 / even.rate_hz, rtol=1e-6)


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_a_peers_attitude_stands_on_the_rows_it_is_of(kind: dict[str, Any]) -> None:
    made = measure(forearm(30.0, 100.0, seed=1), Sensor(jitter=0.0), seed=1)
    packets = made.with_samples(time=in_packets(made.time, 1, **kind))
    attitude, true = PEERS["vqf"].attitude(packets), PEERS["vqf"].attitude(made)
    np.testing.assert_array_equal(attitude.time, packets.time)
    assert np.degrees(angle_between(attitude.quat, true.quat))[100:].max() < 2.0
