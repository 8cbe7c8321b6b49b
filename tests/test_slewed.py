"""Corrections given out at a bounded rate: what is promised of every row, for a simple method and for the flagship."""

from __future__ import annotations

import copy
import os
import subprocess
import sys
from dataclasses import replace
from functools import cache
from math import inf, radians
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import poise
from data_files import data_path
from helpers import angle_between, rotation, wxyz
from poise.cli import run
from poise.data.flags import Flag
from poise.data.packet import Packet
from poise.errors import MethodError
from poise.simulation import PERFECT, Sensor, Triad, forearm, measure

Floats = NDArray[np.float64]
SIMPLE, FLAGSHIP = poise.AdaptiveGain(), poise.SelfCalibrating()
WHITE = replace(PERFECT, gyr=Triad(noise=1e-4), acc=Triad(noise=0.002), mag=Triad(noise=0.05))
both = pytest.mark.parametrize("method", [SIMPLE, FLAGSHIP], ids=["adaptive-gain", "self-calibrating"])


@cache
def made(disturbed: bool = True, duration: float = 60.0) -> poise.Recording:
    """A forearm that comes near a magnet from 20 s to 30 s."""
    recording = measure(forearm(duration, 100.0, 3), Sensor(), seed=3)
    near = (recording.time >= 20.0) & (recording.time < 30.0)
    return replace(recording, mag=recording.mag + 40.0 * disturbed * np.outer(near, [0.0, 1.0, 0.0]))


@cache
def faulty() -> poise.Recording:
    """The same with losses that end in restarts, rows without a stamp, and a start without an accelerometer."""
    clean = made()
    time, gyr, acc, mag = (getattr(clean, name).copy() for name in ("time", "gyr", "acc", "mag"))
    acc[:5] = np.nan
    gyr[1500:1700] = np.nan
    time[2500:] += 3.0
    time[3000], time[3010] = np.nan, time[3005]
    gyr[3500] = 1e30
    return replace(clean, time=time, gyr=gyr, acc=acc, mag=mag, truth=None, moving=None)


def same_bits(a: poise.Attitude, b: poise.Attitude) -> bool:
    return a.table.tobytes() == b.table.tobytes() and a.flags.tobytes() == b.flags.tobytes()


def beside_the_rate(attitude: poise.Attitude) -> tuple[Floats, Floats]:
    """(n − 1,) rad: how far each row turned away from the row before, turned by its own rate; and the time it had, s."""
    dt = np.diff(attitude.time)
    expected = rotation(attitude.quat[:-1]) * rotation(wxyz(_turns(attitude.rate[1:] * dt[:, None])))
    return np.asarray((rotation(attitude.quat[1:]) * expected.inv()).magnitude()), dt


def _turns(vectors: Floats) -> Any:
    from scipy.spatial.transform import Rotation

    return Rotation.from_rotvec(vectors)


@both
@settings(max_examples=8, deadline=None)
@given(degrees=st.floats(0.0, 1.5))
def test_corrections_turn_it_no_faster_than_told(method: Any, degrees: float) -> None:
    attitude = poise.estimate(method, made(), slew=radians(degrees))
    away, dt = beside_the_rate(attitude)
    assert (away <= radians(degrees) * dt + 2e-9).all()


@both
def test_without_a_bound_the_magnet_is_seen_to_jump(method: Any) -> None:
    away, dt = beside_the_rate(poise.estimate(method, made()))
    assert np.degrees(away[100:] / dt[100:]).max() > (10.0 if method is FLAGSHIP else 1.5)  # the test above could fail


@both
def test_what_is_given_out_and_what_is_pending_make_the_methods_own(method: Any) -> None:
    own = poise.estimate(method, made())
    stream, r = poise.Stream(method, slew=radians(0.2)), made()
    most = 0.0
    for i in range(4000):
        row = stream.update(Packet(r.time[i : i + 1], r.gyr[i : i + 1], r.acc[i : i + 1], r.mag[i : i + 1]))
        pending = stream.pending
        whole = _turns(pending) * rotation(row.quat[0])
        assert angle_between(wxyz(whole), own.quat[i]) < 1e-7
        np.testing.assert_allclose(row.sigma[0] ** 2, own.sigma[i] ** 2 + pending**2, rtol=1e-9)
        most = max(most, float(np.linalg.norm(pending)))
    assert np.degrees(most) > 0.5


@both
def test_only_the_attitude_and_its_sigma_differ(method: Any) -> None:
    own, slewed = poise.estimate(method, faulty()), poise.estimate(method, faulty(), slew=radians(1.0))
    np.testing.assert_array_equal(slewed.flags, own.flags)
    np.testing.assert_array_equal(slewed.rate, own.rate)
    np.testing.assert_array_equal(slewed.bias, own.bias)
    np.testing.assert_array_equal(slewed.bias_sigma, own.bias_sigma)
    np.testing.assert_array_equal(np.isfinite(slewed.quat), np.isfinite(own.quat))
    assert angle_between(slewed.quat[5:], own.quat[5:]).max() > radians(0.5)


@both
def test_a_rate_that_is_large_enough_changes_no_bit(method: Any) -> None:
    own = poise.estimate(method, faulty())
    assert same_bits(poise.estimate(method, faulty(), slew=1e9), own)
    assert same_bits(poise.estimate(method, faulty(), slew=inf), own)


@both
def test_it_comes_to_the_methods_own_attitude(method: Any) -> None:
    """After the last large correction, in no more time than the rate needs for it."""
    own, slewed = poise.estimate(method, made()), poise.estimate(method, made(), slew=radians(10.0))
    apart = np.degrees(angle_between(own.quat, slewed.quat))
    assert apart[-2000:].max() < 1.0
    assert (apart[-2000:] == 0.0).mean() > 0.3


def test_from_a_wrong_start_it_comes_at_its_rate() -> None:
    """An attitude that is 40° off is set right at 10 deg/s: in 4 s."""
    clean = made(disturbed=False)[:1000]
    assert clean.truth is not None
    wrong = wxyz(_turns(np.array([0.0, 0.0, np.radians(40.0)])) * rotation(clean.truth.quat[0]))
    own = poise.estimate(FLAGSHIP, clean, start=wrong)
    slewed = poise.estimate(FLAGSHIP, clean, start=wrong, slew=radians(10.0))
    apart = np.degrees(angle_between(own.quat, slewed.quat))
    assert 25.0 < apart[100] < 35.0  # after 1 s
    assert apart[500] < 1.0
    assert np.degrees(slewed.sigma[100, 2]) > apart[100]


@both
def test_a_restart_is_given_out_at_once(method: Any) -> None:
    own, slewed = poise.estimate(method, faulty()), poise.estimate(method, faulty(), slew=radians(1.0))
    resets = np.flatnonzero(own.flags & Flag.RESET)
    assert len(resets) >= 2
    assert angle_between(own.quat[resets], slewed.quat[resets]).max() < 1e-12
    lost = (own.flags & Flag.LOST) != 0
    lost &= np.isfinite(own.quat[:, 0])
    assert lost.any()
    assert angle_between(own.quat[lost], slewed.quat[lost]).max() < 1e-12


def test_a_lead_is_no_correction() -> None:
    ahead = FLAGSHIP._replace(lead=0.05)
    own, slewed = poise.estimate(ahead, made(False)), poise.estimate(ahead, made(False), slew=radians(5.0))
    after = slice(1500, None)
    assert np.degrees(angle_between(own.quat, slewed.quat))[after].max() < 1.0
    assert np.degrees(np.linalg.norm(own.rate, axis=1)).max() * 0.05 > 5.0  # the lead itself turns by more than that


@both
def test_sigma_says_the_truth_while_something_is_pending(method: Any) -> None:
    if method is SIMPLE:
        assert np.isnan(poise.estimate(method, made(), slew=radians(1.0)).sigma).all()
        return
    recording = measure(forearm(60.0, 100.0, 4), WHITE, seed=1)
    assert recording.truth is not None
    wrong = wxyz(_turns(np.radians([0.0, 6.0, 20.0])) * rotation(recording.truth.quat[0]))
    attitude = poise.estimate(method, recording, start=wrong, slew=radians(1.0))
    error = (rotation(recording.truth.quat) * rotation(attitude.quat).inv()).as_rotvec()
    assert (np.mean(np.abs(error) < 3.0 * attitude.sigma, axis=0) > 0.99).all()
    own = poise.estimate(method, recording, start=wrong)
    assert np.mean(np.abs(error) < 3.0 * own.sigma, axis=0).min() < 0.8  # the method's own sigma would not


# -- the contract -------------------------------------------------------------------------------------------------------


@both
@settings(max_examples=8, deadline=None)
@given(cuts=st.lists(st.integers(1, 5999), max_size=20, unique=True), resume_at=st.integers(0, 5999))
def test_batch_stream_and_resumed_stream_give_the_same_bits(method: Any, cuts: list[int], resume_at: int) -> None:
    r, slew = faulty(), radians(3.0)
    whole = poise.estimate(method, r, slew=slew)
    stream, tables, flags = poise.Stream(method, slew=slew), [], []
    edges = [0, *sorted({*cuts, resume_at} - {0}), len(r)]
    for first, last in zip(edges, edges[1:], strict=False):
        part = stream.update(Packet(r.time[first:last], r.gyr[first:last], r.acc[first:last], r.mag[first:last]))
        tables.append(part.table.copy())
        flags.append(part.flags.copy())
        if last == resume_at:
            stream = poise.Stream(method, slew=slew).restore(stream.save())
    assert np.concatenate(tables).tobytes() == whole.table.tobytes()
    assert np.concatenate(flags).tobytes() == whole.flags.tobytes()


def test_a_copy_goes_on_alike_and_another_bound_is_another_stream() -> None:
    r = made()[:500]
    stream = poise.Stream(SIMPLE, slew=radians(3.0))
    stream.update(Packet(r.time[:200], r.gyr[:200], r.acc[:200], r.mag[:200]))
    rest = Packet(r.time[200:], r.gyr[200:], r.acc[200:], r.mag[200:])
    saved = stream.save()
    assert same_bits(copy.deepcopy(stream).update(rest), stream.update(rest))
    with pytest.raises(poise.PoiseError, match="same method and parameters"):
        poise.Stream(SIMPLE, slew=radians(4.0)).restore(saved)


@both
@settings(max_examples=15, deadline=None)
@given(data=st.data())
def test_no_bytes_from_a_sensor_make_it_non_finite(method: Any, data: st.DataObject) -> None:
    values = st.sampled_from([0.0, -0.0, 1e-310, 1e-30, 1.0, -9.8, 1e30, np.inf, -np.inf, np.nan])
    rows = data.draw(st.lists(st.lists(values, min_size=10, max_size=10), min_size=1, max_size=12))
    r, wild, stream = made(), np.array(rows), poise.Stream(method, slew=radians(2.0))
    stream.update(Packet(r.time[:50], r.gyr[:50], r.acc[:50], r.mag[:50]))
    stream.update(Packet(wild[:, 0], wild[:, 1:4], wild[:, 4:7], wild[:, 7:10]))
    after = stream.update(Packet(r.time[50:100], r.gyr[50:100], r.acc[50:100], r.mag[50:100]))
    assert np.isfinite(after.table[:, :10]).all()
    assert np.isfinite(stream.pending).all()


@both
def test_empty_and_single_rows(method: Any) -> None:
    assert len(poise.estimate(method, made()[:0], slew=radians(2.0))) == 0
    assert same_bits(poise.estimate(method, made()[:1], slew=radians(2.0)), poise.estimate(method, made()[:1]))


def test_without_the_guard_it_slews_too() -> None:
    clean = made()[:1000]
    away, dt = beside_the_rate(poise.estimate(SIMPLE, clean, guard=None, slew=radians(0.5)))
    assert (away <= radians(0.5) * dt + 2e-9).all()


_PLAIN = """
import sys, numpy, poise
from poise.simulation import Sensor, forearm, measure
recording = measure(forearm(20.0, 100.0, 4), Sensor(), seed=4)
numpy.save(sys.argv[1], poise.estimate(poise.SelfCalibrating(), recording, slew=0.02).table)
"""


def test_compiled_and_plain_python_agree(tmp_path: Path) -> None:
    out = tmp_path / "plain.npy"
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    subprocess.run([sys.executable, "-c", _PLAIN, str(out)], check=True, env=environment, timeout=120)
    table = np.load(out)
    compiled = poise.estimate(FLAGSHIP, measure(forearm(20.0, 100.0, 4), Sensor(), seed=4), slew=0.02)
    assert angle_between(table[:, :4], compiled.quat).max() < 1e-9
    np.testing.assert_allclose(table[:, 4:], compiled.table[:, 4:], atol=1e-9)


def test_by_hand_it_goes_around_any_method() -> None:
    by_hand = poise.estimate(poise.Slewed(SIMPLE, rate=radians(3.0)), made())  # guarded inside
    assert same_bits(by_hand, poise.estimate(SIMPLE, made(), slew=radians(3.0)))
    assert by_hand.provenance.method == "AdaptiveGain"
    assert by_hand.provenance.parameters["rate"] == radians(3.0)
    assert poise.Stream(SIMPLE).pending.tolist() == [0.0, 0.0, 0.0]
    for slew in (-1.0, float("nan"), "fast"):
        with pytest.raises(MethodError, match=r"Slewed\.rate"):
            poise.Stream(SIMPLE, slew=slew)  # type: ignore[arg-type]
    with pytest.raises(MethodError, match="slewed already"):
        poise.Stream(poise.Slewed(SIMPLE), slew=1.0)


# -- on real data, and the command -----------------------------------------------------------------------------------------


def test_on_a_real_trial_it_costs_nothing_and_bounds_every_step() -> None:
    trial = poise.read(next(data_path("broad").glob("35_*.mat")))
    own, slewed = poise.estimate(FLAGSHIP, trial), poise.estimate(FLAGSHIP, trial, slew=radians(5.0))
    a, b = (poise.evaluate(attitude, trial).rmse_deg().total for attitude in (own, slewed))
    assert abs(a - b) < 0.01
    away, dt = beside_the_rate(slewed)
    assert np.degrees((away - 2e-9) / dt).max() <= 5.0 + 1e-6
    assert np.degrees(np.divide(*beside_the_rate(own))).max() > 50.0


def test_the_command_slews(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    poise.write(made(), "made.csv")
    assert run(["estimate", "made.csv", "-m", "adaptive-gain", "--slew", "3", "-o", "a.parquet"]) == 0
    expected = poise.estimate(SIMPLE, poise.read("made.csv"), slew=radians(3.0))
    np.testing.assert_array_equal(poise.read_attitude("a.parquet").quat, expected.quat)
    capsys.readouterr()
    assert run(["estimate", "made.csv", "--slew", "-3"]) == 2
    assert "--slew -3.0: expected degrees a second" in capsys.readouterr().err
    assert run(["estimate", "made.csv", "--slew", "3", "--offline"]) == 2
    assert "--slew bounds corrections as they come" in capsys.readouterr().err
