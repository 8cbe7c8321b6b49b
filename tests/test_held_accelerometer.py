"""A slower accelerometer whose samples are repeated in the rows until its next one, or absent there."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import poise
from data_files import data_path
from poise.data.flags import Flag
from poise.simulation import PERFECT, Sensor, Triad, at_rest, forearm, measure

Floats = NDArray[np.float64]

FLAGSHIP = poise.SelfCalibrating()
RATE, EVERY = 200.0, 8  # rows a second, rows to a sample of the accelerometer
FINE = replace(PERFECT, gyr=Triad(noise=1e-4), acc=Triad(noise=0.01), mag=Triad(noise=0.05))


def held(rows: Floats, every: int = EVERY) -> Floats:
    return rows[np.arange(len(rows)) // every * every]


def sparse(rows: Floats, every: int = EVERY) -> Floats:
    return np.where((np.arange(len(rows)) % every == 0)[:, None], rows, np.nan)


def trial(number: str) -> poise.Recording:
    return poise.read(next(data_path("broad").glob(f"{number}_*.mat")))


def moving(seconds: float = 60.0) -> poise.Recording:
    return measure(forearm(seconds, RATE, 3), Sensor(), seed=4)


def total(recording: poise.Recording) -> float:
    return poise.evaluate(poise.estimate(FLAGSHIP, recording), recording).rmse_deg().total


def test_what_is_repeated_is_no_new_sample() -> None:
    recording = moving()
    absent, repeated = (recording.with_samples(acc=f(recording.acc)) for f in (sparse, held))
    assert total(repeated) < total(absent) + 0.2  # 2.3° more where each repetition counted
    one, other = (poise.estimate(FLAGSHIP, r).learned["acc_delay"]["value"] for r in (absent, repeated))  # type: ignore[index]
    assert abs(one - other) < 1e-3


@pytest.mark.parametrize(("every", "most"), [(3, 1.7), (6, 2.3), (11, 3.0)])
def test_a_held_accelerometer_on_a_fast_trial(every: int, most: float) -> None:
    recording = trial("21")
    assert total(recording.with_samples(acc=held(recording.acc, every))) < most


def test_a_slower_accelerometer_that_gives_means_is_late_by_half_of_its_own_interval() -> None:
    recording, every = trial("21"), 6
    n = len(recording) // every * every
    acc = np.full_like(recording.acc, np.nan)
    acc[every - 1 : n : every] = recording.acc[:n].reshape(-1, every, 3).mean(axis=1)
    attitude = poise.estimate(FLAGSHIP, recording.with_samples(acc=acc))
    assert attitude.learned is not None
    late = 0.5 * (every - 1) * np.diff(recording.time).mean()
    assert abs(attitude.learned["acc_delay"]["value"] - late) < 1.5e-3
    assert poise.evaluate(attitude, recording).rmse_deg().total < 2.0  # 3.7 where the delay was that of the rows


def test_single_samples_that_are_lost_make_no_slower_sensor() -> None:
    recording = moving(20.0)
    lost = np.random.default_rng(1).random(len(recording)) < 0.3
    acc = np.where(lost[:, None], np.nan, recording.acc)
    whole, parts = (
        poise.estimate(FLAGSHIP, recording.with_samples(acc=a)).learned["acc_delay"]["value"]  # type: ignore[index]
        for a in (recording.acc, acc)
    )
    assert abs(whole - parts) < 1e-3


def test_a_coarse_accelerometer_that_repeats_by_chance_loses_nothing() -> None:
    recording = measure(at_rest(np.array([0.9, 0.3, -0.2, 0.1]), 30.0, RATE), FINE, seed=2)
    coarse = np.round(recording.acc / 0.5) * 0.5
    assert np.mean((coarse[1:] == coarse[:-1]).all(axis=1)) > 0.2
    guarded = poise.estimate(FLAGSHIP, recording.with_samples(acc=coarse))
    bare = poise.estimate(FLAGSHIP, recording.with_samples(acc=coarse), guard=None)
    np.testing.assert_array_equal(guarded.quat, bare.quat)


def test_one_that_hangs_for_seconds_is_still_told() -> None:
    recording = moving(20.0)
    acc = held(recording.acc)
    acc[2000:2600] = acc[2000]
    attitude = poise.estimate(FLAGSHIP, recording.with_samples(acc=acc))
    stuck = np.flatnonzero(attitude.flags & int(Flag.STUCK_ACC))
    assert 2000 + 0.2 * RATE <= stuck[0] < 2000 + 0.3 * RATE
    assert list(stuck) == list(range(stuck[0], 2600))
    assert not (
        poise.estimate(FLAGSHIP, recording.with_samples(acc=held(recording.acc))).flags & int(Flag.STUCK_ACC)
    ).any()


def test_row_by_row_and_saved_it_is_the_same() -> None:
    recording = moving(12.0)
    recording = recording.with_samples(acc=held(recording.acc))
    whole = poise.estimate(FLAGSHIP, recording)
    stream, parts = poise.Stream(FLAGSHIP), []
    for i, part in enumerate(range(0, len(recording), 7)):
        if i % 40 == 3:
            stream = poise.Stream(FLAGSHIP).restore(stream.save())
        rows = slice(part, part + 7)
        few = (getattr(recording, name)[rows] for name in ("time", "gyr", "acc", "mag"))
        parts.append(stream.update(poise.Packet(*few)))
    np.testing.assert_array_equal(np.vstack([part.quat for part in parts]), whole.quat)


_PLAIN = """
import sys, numpy, poise
columns = numpy.load(sys.argv[1])
recording = poise.Recording(columns[:, 0], columns[:, 1:4], columns[:, 4:7], columns[:, 7:])
numpy.save(sys.argv[2], poise.estimate(poise.SelfCalibrating(), recording).table)
"""


def test_plain_python_agrees_bit_for_bit(tmp_path: Path) -> None:
    recording = moving(6.0)
    recording = recording.with_samples(acc=held(recording.acc))
    rows, table = tmp_path / "rows.npy", tmp_path / "table.npy"
    np.save(rows, np.column_stack([recording.time, recording.gyr, recording.acc, recording.mag]))
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    subprocess.run([sys.executable, "-c", _PLAIN, str(rows), str(table)], check=True, env=environment)
    np.testing.assert_allclose(np.load(table), poise.estimate(FLAGSHIP, recording).table, atol=1e-9)
