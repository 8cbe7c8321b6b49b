"""The doctor on recordings that hardly are any: no warning, no number that is none, no verdict that rests on nothing."""

from __future__ import annotations

import json
import warnings
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import poise
from poise import Recording, diagnose
from poise.errors import PoiseError
from poise.simulation import PERFECT, Sensor, at_rest, forearm, measure, phone

BASES = [
    measure(forearm(20.0, seed=3), Sensor(), seed=2),
    measure(phone(20.0, seed=1), Sensor(), seed=1),
    measure(at_rest(duration=20.0), Sensor(), seed=1),
    measure(at_rest(duration=20.0), PERFECT),
]


def some(values: Any, rng: np.random.Generator, share: float, value: float) -> Any:
    return np.where(rng.random((len(values), 1)) < share, value, values)


SAMPLES: dict[str, Any] = {
    "as it is": lambda v, rng: v,
    "constant": lambda v, rng: np.broadcast_to(v[0], v.shape).copy(),
    "zero": lambda v, rng: np.zeros_like(v),
    "absent": lambda v, rng: np.full_like(v, np.nan),
    "one sample": lambda v, rng: np.where(np.arange(len(v))[:, None] == len(v) // 2, v, np.nan),
    "a column absent": lambda v, rng: v * [1.0, np.nan, 1.0],
    "a column zero": lambda v, rng: v * [1.0, 0.0, 1.0],
    "mostly zero": lambda v, rng: some(v, rng, 0.9, 0.0),
    "mostly absent": lambda v, rng: some(v, rng, 0.9, np.nan),
    "some infinite": lambda v, rng: some(v, rng, 0.2, np.inf),
    "out of range": lambda v, rng: np.full_like(v, 1e13),
    "huge": lambda v, rng: v * 1e10,
    "beyond": lambda v, rng: v * 1e300,
    "tiny": lambda v, rng: v * 1e-30,
    "denormal": lambda v, rng: v * 1e-312,
    "shuffled": lambda v, rng: rng.permutation(v),
    "hangs": lambda v, rng: np.where(np.arange(len(v))[:, None] > len(v) // 3, v[len(v) // 3], v),
}
STAMPS: dict[str, Any] = {
    "as they are": lambda t, rng: t,
    "all equal": lambda t, rng: np.full_like(t, 7.0),
    "absent": lambda t, rng: np.full_like(t, np.nan),
    "half absent": lambda t, rng: np.where(rng.random(len(t)) < 0.5, np.nan, t),
    "backwards": lambda t, rng: t[::-1].copy(),
    "shuffled": lambda t, rng: rng.permutation(t),
    "a jump": lambda t, rng: t + 1e290 * (np.arange(len(t)) > len(t) // 2),
    "huge": lambda t, rng: t * 1e290,
    "tiny": lambda t, rng: t * 1e-290,
}


@settings(max_examples=80, deadline=None)
@given(
    base=st.sampled_from(range(len(BASES))),
    rows=st.sampled_from([1, 2, 3, 10, 60, 2000, 2000, 2000]),
    stamps=st.sampled_from(sorted(STAMPS)),
    changes=st.tuples(*[st.sampled_from(sorted(SAMPLES))] * 3),
    seed=st.integers(0, 99),
    guessed=st.sampled_from([(), ("time", "gyr", "acc")]),
)
def test_no_recording_is_too_poor(
    base: int, rows: int, stamps: str, changes: tuple[str, ...], seed: int, guessed: tuple[str, ...]
) -> None:
    rng, whole = np.random.default_rng(seed), BASES[base][:rows]
    values = {
        sensor: SAMPLES[change](getattr(whole, sensor), rng)
        for sensor, change in zip(("gyr", "acc", "mag"), changes, strict=True)
    }
    try:
        recording = Recording(STAMPS[stamps](whole.time, rng), **values)
    except PoiseError:
        return  # refused with a reason: another test's matter
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = diagnose(recording, guessed=guessed, read_as={"time": "ms"} if guessed else None)
        assert len(found.repair(recording)) == len(recording)
    assert found.verdict and json.dumps(found.to_dict(), allow_nan=False)
    for finding in found.findings:
        assert not {"nan", "inf", "-inf"} & set(finding.sentence.replace(",", " ").split()), finding


@pytest.mark.parametrize("sensor", ["gyr", "acc", "mag"])
@pytest.mark.parametrize("base", range(len(BASES)))
def test_one_and_the_same_sample_is_no_evidence(sensor: str, base: int) -> None:
    """A sensor that hangs from beginning to end: that is said, and nothing is concluded from it."""
    values = getattr(BASES[base], sensor)
    found = diagnose(BASES[base].with_samples(**{sensor: np.broadcast_to(values[0], values.shape).copy()}))
    assert not found.repairs and not found.found("sure")
    told = {f.name: f for f in found.findings}
    assert told[f"{sensor} stuck"].severity == "likely"
    assert f"{sensor} delay" not in told and (sensor != "mag" or "hard iron" not in told)
    assert "acc sign" not in told or told["acc sign"].severity == "note"
    if sensor != "mag":
        assert told["rest"].severity == "cannot-tell" and sensor in told["rest"].sentence


def test_why_there_is_nothing_to_look_at() -> None:
    base, n = BASES[0], len(BASES[0])
    zeros, beyond = np.zeros((n, 3)), np.full((n, 3), 1e13)
    for changed, says in (
        ({"acc": zeros}, "every sample of the accelerometer is zero"),
        ({"acc": beyond}, "no usable sample of the accelerometer"),
        ({"acc": np.array([0.0, 0.0, 1e308]) + zeros}, "no usable sample of the accelerometer"),
        ({"gyr": beyond * np.nan, "acc": beyond * np.nan}, "no usable sample of the gyroscope and the accelerometer"),
        ({"time": np.full(n, 3.0)}, "no time stamp rises"),
    ):
        (sure,) = diagnose(base.with_samples(**changed)).found("sure")
        assert sure.name == "samples" and says in sure.sentence
    few = diagnose(base.with_samples(mag=beyond)).findings
    assert f"{n} of {n} samples of mag are infinite or beyond 1e+12" in few[0].sentence


def test_the_doctor_and_the_estimate_agree_on_one_row() -> None:
    """A row at rest is an attitude: it cannot be told whether it is right, and it is not surely wrong."""
    one = poise.Recording([0.0], [[0.0, 0, 0]], [[0.0, 0, 9.8]], [[0.0, 20, -40]])
    assert poise.estimate(poise.TwoStage(), one).valid.all()
    (found,) = diagnose(one).findings
    assert found.severity == "cannot-tell" and "1 row" in found.sentence
    none = one.with_samples(acc=np.array([[0.0, 0.0, np.nan]]))
    assert diagnose(none).found("sure") and not poise.estimate(poise.TwoStage(), none).valid.any()


def test_one_pair_of_sensors_does_not_tell_which_is_wrong() -> None:
    """Without gravity in acc only the field is left, and then it is mag's axes or gyr's."""
    base = measure(forearm(60.0, seed=2), Sensor(), seed=2)
    free = np.random.default_rng(0).normal(0.0, 0.5, base.acc.shape)
    found = diagnose(base.with_samples(acc=free).remap("y -x z", "mag"))
    axes = next(f for f in found.found("sure") if f.name == "axes")
    assert not axes.decided and "without an accelerometer that feels gravity" in axes.sentence and not found.repairs
