"""The contract that every method in METHODS passes."""

from __future__ import annotations

import copy
import os
import pickle
import subprocess
import sys
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import poise
from helpers import angle_between, random_quats, wxyz
from poise.data.flags import Flag
from poise.data.packet import Packet
from poise.errors import MethodError, RecordingError, StateError
from poise.estimators import METHODS
from poise.estimators.parameters import parameters
from poise.estimators.saving import flat
from poise.math import arrays
from poise.simulation import PERFECT, Sensor, at_rest, forearm, measure, turned_about_up

every_method = pytest.mark.parametrize("method", [cls() for cls in METHODS.values()], ids=list(METHODS))
RATE = 50.0


def has_heading(method: Any) -> bool:
    """Whether the method takes its heading from a magnetometer; the others are judged by their inclination."""
    return "declination" in method._fields


def judged(error: poise.Errors, method: Any) -> NDArray[np.float64]:
    return error.total if has_heading(method) else error.inclination


def judged_rmse(error: poise.Errors, method: Any) -> float:
    return error.rmse_deg().total if has_heading(method) else error.rmse_deg().inclination


def adds_rates_to_angles(method: Any) -> bool:
    """Whether an option adds the body's rates to Euler angles, as two of the prints do: right near level only."""
    return getattr(method, "kinematics", "") == "small-angle"


@cache
def made(duration: float = 20.0, seed: int = 1, mag_rate: float | None = None) -> poise.Recording:
    """A forearm seen by an inexpensive sensor; small and the same every time."""
    sensor = Sensor() if mag_rate is None else replace(Sensor(), mag_rate=mag_rate)
    return measure(forearm(duration, RATE, seed), sensor, seed=seed)


@cache
def faulty() -> poise.Recording:
    """The same with everything that a link does to samples."""
    clean = made(mag_rate=12.5)
    time, gyr, acc, mag = (getattr(clean, name).copy() for name in ("time", "gyr", "acc", "mag"))
    acc[:3] = np.nan
    gyr[100], acc[120], mag[140] = np.nan, np.inf, 0.0
    gyr[200:260] = np.nan
    time[300:] += 5.0
    time[400], time[410] = np.nan, time[405]
    gyr[450] = 1e30
    assert clean.truth is not None
    return replace(clean, time=time, gyr=gyr, acc=acc, mag=mag, truth=replace(clean.truth, time=time))


def same_bits(a: poise.Attitude, b: poise.Attitude) -> bool:
    return a.table.tobytes() == b.table.tobytes() and a.flags.tobytes() == b.flags.tobytes()


def joined(parts: list[poise.Attitude]) -> poise.Attitude:
    table, flags = (np.concatenate([getattr(part, name) for part in parts]) for name in ("table", "flags"))
    return replace(parts[-1], time=np.concatenate([part.time for part in parts]), table=table, flags=flags)


def packet(recording: poise.Recording, first: int, last: int) -> Packet:
    """Rows as a device sends them: one as plain numbers, several as arrays."""
    r = recording
    if last - first == 1:
        return Packet(float(r.time[first]), tuple(r.gyr[first]), tuple(r.acc[first]), tuple(r.mag[first]))
    return Packet(r.time[first:last], r.gyr[first:last], r.acc[first:last], r.mag[first:last])


# -- batch, stream, resume --------------------------------------------------------------------------------------------


def without_ages(recording: poise.Recording) -> poise.Recording:
    """A packet carries no ages."""
    return replace(recording, acc_age=None, mag_age=None)


@every_method
@settings(max_examples=15, deadline=None)
@given(cuts=st.lists(st.integers(1, 999), max_size=40, unique=True), resume_at=st.integers(0, 999))
def test_batch_stream_and_resumed_stream_give_the_same_bits(method: Any, cuts: list[int], resume_at: int) -> None:
    recording = without_ages(faulty())
    whole = poise.estimate(method, recording)
    stream, parts = poise.Stream(method), []
    edges = [0, *sorted({*cuts, resume_at} - {0}), len(recording)]
    for first, last in zip(edges, edges[1:], strict=False):
        parts.append(stream.update(packet(recording, first, last)))
        if last == resume_at:
            stream = poise.Stream(method).restore(stream.save())
    assert same_bits(joined(parts), whole)


@every_method
def test_sample_by_sample_gives_the_same_bits(method: Any) -> None:
    recording = without_ages(faulty())
    stream = poise.Stream(method)
    parts = [stream.update(packet(recording, i, i + 1)) for i in range(len(recording))]
    assert same_bits(joined(parts), poise.estimate(method, recording))


@every_method
def test_twice_gives_the_same_bits(method: Any) -> None:
    assert same_bits(poise.estimate(method, faulty()), poise.estimate(method, faulty()))


@every_method
def test_a_saved_stream_belongs_to_its_method_and_parameters(method: Any) -> None:
    stream = poise.Stream(method)
    stream.update(packet(made(), 0, 10))
    saved = stream.save()
    name = next(p.name for p in parameters(type(method)) if p.kind is float)
    other = poise.Stream(method._replace(**{name: 1.5 * getattr(method, name)}))
    nested = b"[" * 100_000
    flipped = saved.replace(b"0.0", b"0.5", 1)
    for bytes_ in (saved[: len(saved) // 2], b"", b"[]", b"\xff\x00", b'{"poise": "stream"}', nested, flipped):
        with pytest.raises(StateError, match="saved stream"):
            poise.Stream(method).restore(bytes_)
    with pytest.raises(StateError, match="same method and parameters") as told:
        other.restore(saved)
    value = getattr(method, name)
    assert f": {name} is {value!r}, here {1.5 * value!r}; restore" in str(told.value)  # what differs, and only that


def test_a_stream_saved_by_another_method_says_so() -> None:
    saved = poise.Stream(poise.TwoStage()).save()
    for other, says in (
        (poise.Stream(poise.Tilt()), "another method.*here there is no gyr_noise.* more and there was no q_angle"),
        (poise.Stream(poise.TwoStage(), rest_bias=False), "here there is no .*rest_time"),
        (poise.Stream(poise.TwoStage(), guard=None), "here there is no .*longest_loss"),
    ):
        with pytest.raises(StateError, match=says) as told:
            other.restore(saved)
        assert len(str(told.value)) < 400


# -- what comes out ---------------------------------------------------------------------------------------------------


@every_method
def test_a_row_out_for_a_row_in_and_never_nan_without_a_flag(method: Any) -> None:
    attitude = poise.estimate(method, faulty())
    assert len(attitude) == len(faulty())
    length = np.linalg.norm(attitude.quat, axis=1)
    known = np.isfinite(length)
    np.testing.assert_allclose(length[known], 1.0, atol=1e-12)
    assert not attitude.valid[~known].any()
    assert not known[:3].any(), "no attitude before the first accelerometer sample"
    assert known[3:].all()
    assert (attitude.flags[:3] & Flag.INITIALISING).all()
    steps = np.sum(attitude.quat[4:] * attitude.quat[3:-1], axis=1)
    assert (steps > 0).all(), "the sign is continuous"


@every_method
def test_losses_are_flagged_and_survived(method: Any) -> None:
    attitude = poise.estimate(method, faulty())
    flags = attitude.flags
    assert flags[100] & Flag.GYR_MISSING
    assert flags[450] & Flag.GYR_MISSING
    assert flags[300] & Flag.GAP
    assert (flags[300:440] & Flag.LOST).all(), "three seconds of samples are gathered before it starts anew"
    reset = int(np.flatnonzero(flags & Flag.RESET)[-1])
    assert 445 <= reset <= 455, "single bad rows in between do not begin it anew"
    assert flags[400] & Flag.TIME_DISORDER
    assert flags[410] & Flag.TIME_DISORDER
    assert flags[255] & Flag.LOST, "the gyroscope was gone for over a second"
    assert not attitude.valid[255]
    assert not attitude.valid[262:reset].any()
    assert attitude.valid[reset + 100 :].all(), "and has settled soon after"
    error = poise.evaluate(attitude, faulty())
    assert np.nanmax(judged(error, method)[-250:]) < np.radians(20.0)


@every_method
@settings(max_examples=20, deadline=None)
@given(data=st.data())
def test_no_bytes_from_a_sensor_make_the_state_non_finite(method: Any, data: st.DataObject) -> None:
    values = st.sampled_from([0.0, -0.0, 1e-310, 1e-30, 1.0, -9.8, 1e30, np.inf, -np.inf, np.nan])
    rows = data.draw(st.lists(st.lists(values, min_size=10, max_size=10), min_size=1, max_size=12))
    clean = made()[:100]
    wild = np.array(rows)
    stream = poise.Stream(method)
    stream.update(packet(clean, 0, 50))
    stream.update(Packet(wild[:, 0], wild[:, 1:4], wild[:, 4:7], wild[:, 7:10]))
    after = stream.update(packet(clean, 50, 100))
    assert np.isfinite(after.table[:, :10]).all()


@every_method
def test_empty_and_single_rows(method: Any) -> None:
    empty = poise.estimate(method, made()[:0])
    assert len(empty) == 0
    assert empty.quat.shape == (0, 4)
    one = poise.estimate(method, made()[:1])
    assert one.valid.all()
    np.testing.assert_allclose(np.linalg.norm(one.quat, axis=1), 1.0)


# -- right ------------------------------------------------------------------------------------------------------------


@every_method
@settings(max_examples=12, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_right_at_rest_from_any_starting_attitude(method: Any, seed: int) -> None:
    truth, start = random_quats(2, seed)
    recording = measure(at_rest(truth, 400.0, 25.0), PERFECT)
    attitude = poise.estimate(method, recording, start=start)
    if has_heading(method):
        assert angle_between(attitude.quat[-1], truth) < np.radians(1.0)
    tilt = poise.evaluate(attitude, recording).inclination[-1]
    assert tilt < np.radians(0.5)


@every_method
def test_starts_where_it_is_told(method: Any) -> None:
    start = random_quats(1, 5)[0]
    attitude = poise.estimate(method, made(), start=start)
    if has_heading(method):
        assert angle_between(attitude.quat[0], start) < 1e-9
    again = poise.estimate(method, made(), start=attitude)
    assert angle_between(again.quat[0], attitude.quat[0]) < 1e-9


@every_method
def test_a_known_bias_is_taken_away(method: Any) -> None:
    bias = np.array([0.02, -0.01, 0.03])
    perfect = measure(forearm(10.0, RATE, 2), PERFECT)
    biased = replace(perfect, gyr=perfect.gyr + bias)
    with_bias = poise.estimate(method, biased, bias=bias, guard=None, rest_bias=False)
    without = poise.estimate(method, perfect, guard=None, rest_bias=False)
    assert angle_between(with_bias.quat, without.quat).max() < 1e-6
    np.testing.assert_allclose(with_bias.bias, without.bias + bias, atol=1e-9)  # what it learned itself is the same
    np.testing.assert_allclose(poise.estimate(method, biased[:5], bias=bias).bias, np.tile(bias, (5, 1)), atol=1e-3)


@every_method
def test_the_bias_is_found_at_rest(method: Any) -> None:
    bias = np.radians([0.5, -0.3, 0.2])
    still = measure(at_rest(np.array([1.0, 0, 0, 0]), 20.0, RATE), PERFECT)
    attitude = poise.estimate(method, replace(still, gyr=still.gyr + bias))
    if type(method) is poise.Tilt:  # from gravity, which a turn about up does not show
        assert np.abs(attitude.bias[-1] - bias)[:2].max() < np.radians(0.02)
        assert attitude.bias_sigma[-1, 2] > np.radians(1.0)
        return
    assert np.abs(attitude.bias[-1] - bias).max() < np.radians(0.01)
    assert attitude.flags[-1] & Flag.REST
    assert (attitude.bias_sigma[-1] < np.radians(0.05)).all()


@every_method
def test_turning_the_world_turns_the_answer(method: Any) -> None:
    if not has_heading(method):
        pytest.skip("the method has no heading of its own")
    motion, angle = forearm(20.0, RATE, 3), 2.0
    motion = replace(motion, acceleration=np.zeros_like(motion.acceleration))  # what it does to acc depends on north
    straight = poise.estimate(method, measure(motion, PERFECT))
    turned = poise.estimate(method, measure(turned_about_up(motion, angle), PERFECT))
    expected = arrays.multiply(arrays.turn_about_up(np.array(angle)), straight.quat)
    learns = type(method) is poise.SelfCalibrating  # what it learns first depends on where the field comes from
    assert angle_between(turned.quat, expected).max() < np.radians(0.6 if learns else 0.1)


@every_method
def test_declination_turns_the_answer(method: Any) -> None:
    if not has_heading(method):
        pytest.skip("the method has no heading of its own")
    magnetic = poise.estimate(method, made())
    true = poise.estimate(method._replace(declination=0.1), made())
    expected = arrays.multiply(arrays.turn_about_up(np.array(-0.1)), magnetic.quat)
    assert angle_between(true.quat, expected).max() < np.radians(0.5)
    assert (magnetic.heading_reference, true.heading_reference) == ("magnetic", "true")


@every_method
@pytest.mark.parametrize("axes", ["y -x z", "-z x -y", "x -y -z", "z x y"])
def test_rotating_the_sensors_axes_rotates_the_answer(method: Any, axes: str) -> None:
    if hasattr(method, "kinematics"):
        pytest.skip("filters the Euler angles of the axes it is given")
    plain, turned = made(), made().remap(axes)
    a, b = poise.estimate(method, plain), poise.estimate(method, turned)
    turn = np.array([[(("-" in word and -1) or 1) * (word[-1] == axis) for axis in "xyz"] for word in axes.split()])
    expected = arrays.multiply(a.quat, arrays.conjugate(wxyz(Rotation.from_matrix(turn))))
    assert angle_between(b.quat, expected).max() < 1e-6
    np.testing.assert_allclose(b.bias, a.bias @ turn.T, atol=1e-9)


# -- what goes in -----------------------------------------------------------------------------------------------------


@every_method
@pytest.mark.parametrize("rate", [100.0, 400.0])  # 50 µs of jitter: of fast rows some look uneven
def test_a_silent_magnetometer_is_no_magnetometer(method: Any, rate: float) -> None:
    clean = made() if rate == 100.0 else measure(forearm(10.0, rate, 1), seed=1)
    absent = replace(clean, mag=None)
    nan = replace(clean, mag=np.full_like(clean.mag, np.nan))
    zero = replace(clean, mag=np.zeros_like(clean.mag))
    results = [poise.estimate(method, recording) for recording in (absent, nan, zero)]
    assert same_bits(results[0], results[1])
    assert same_bits(results[0], results[2])
    assert {result.heading_reference for result in results} == {"arbitrary"}
    assert np.nanmax(poise.evaluate(results[0], clean).inclination) < np.radians(10.0)


def variants(values: NDArray[np.float64]) -> dict[str, Any]:
    """The same whole numbers in every shape that memory can have."""
    strided = np.zeros((len(values) * 2, values.shape[1] + 1))
    strided[::2, 1:] = values
    locked = values.copy()
    locked.setflags(write=False)
    return {
        "int": values.astype(np.int64),
        "float32": values.astype(np.float32),
        "strided": strided[::2, 1:],
        "fortran": np.asfortranarray(values),
        "read-only": locked,
        "list": values.tolist(),
        "big-endian": values.astype(">f8"),
    }


@every_method
def test_the_type_and_layout_of_arrays_do_not_matter(method: Any) -> None:
    clean = made()[:200]
    gyr, acc, mag = (np.round(values) + 0.0 for values in (clean.gyr, clean.acc, clean.mag))  # no −0, which int has not
    expected = poise.estimate(method, poise.Recording(clean.time, gyr, acc, mag))
    for name in variants(gyr):
        shaped = [variants(values)[name] for values in (gyr, acc, mag)]
        before = pickle.dumps(shaped)
        assert same_bits(poise.estimate(method, poise.Recording(clean.time, *shaped)), expected), name
        assert pickle.dumps(shaped) == before, "inputs are never written"


@every_method
def test_whole_numbers_as_parameters_are_numbers(method: Any) -> None:
    name = next(p.name for p in parameters(type(method)) if p.kind is float and p.low <= 1 <= p.high)
    a, b = method._replace(**{name: 1}), method._replace(**{name: 1.0})
    assert same_bits(poise.estimate(a, made()), poise.estimate(b, made()))


@every_method
def test_slower_sensors_are_used_once(method: Any) -> None:
    slow = made(mag_rate=12.5)
    assert 0.2 < np.isfinite(slow.mag[:, 0]).mean() < 0.3
    error = poise.evaluate(poise.estimate(method, slow), slow)
    assert judged_rmse(error, method) < 6.0


@every_method
def test_the_heading_says_until_when_it_is_arbitrary(method: Any) -> None:
    late = made().mag.copy()
    late[:100] = np.nan
    attitude = poise.estimate(method, replace(made(), mag=late))
    told = (attitude.flags & Flag.HEADING_ARBITRARY) != 0
    assert told[:100].all()
    if has_heading(method):
        assert not told[100:].any()
        assert attitude.flags[100] & Flag.RESET
    started = poise.estimate(method, replace(made(), mag=None), start=[1.0, 0.0, 0.0, 0.0])
    assert not (started.flags & Flag.MAG_MISSING).any()
    always = type(method) is poise.Tilt  # it has no heading at all
    assert ((started.flags & Flag.HEADING_ARBITRARY) != 0).all() == always


@every_method
@pytest.mark.parametrize(
    "motion", [at_rest(duration=8.0, rate=RATE), forearm(8.0, RATE, seed=3)], ids=["rest", "forearm"]
)
def test_a_field_along_gravity_tells_no_heading(method: Any, motion: Any) -> None:
    for iron in (0.0, 1.5):  # µT: what is left of the sensor's own, which would be north
        recording = measure(motion, replace(PERFECT, mag_delay=0.0), field=(iron, 0.0, -55.0), seed=3)
        attitude = poise.estimate(method, recording)
        unknown = (attitude.flags & np.uint32(Flag.HEADING_ARBITRARY)) != 0
        assert unknown[attitude.time > 1.5].all()
        assert np.nanmax(np.degrees(poise.evaluate(attitude, recording).inclination)) < 30.0


@every_method
def test_after_a_field_along_gravity_the_heading_is_found(method: Any) -> None:
    if not has_heading(method):
        pytest.skip("has no heading")
    motion = at_rest(duration=20.0, rate=RATE)
    poles, north = (measure(motion, PERFECT, field=(0.0, h, -45.0), seed=3) for h in (0.0, 20.0))
    later = poles.time > 8.0
    attitude = poise.estimate(method, poles.with_samples(mag=np.where(later[:, None], north.mag, poles.mag)))
    unknown = (attitude.flags & np.uint32(Flag.HEADING_ARBITRARY)) != 0
    assert unknown[~later].all() and not unknown[poles.time > 10.0].any()
    assert np.degrees(poise.evaluate(attitude, north).heading[-1]) < 3.0


@every_method
def test_gravity_is_the_recordings(method: Any) -> None:
    moon = measure(at_rest(random_quats(1, 8)[0], 30.0, RATE), PERFECT, gravity=1.62)
    wrong = random_quats(1, 9)[0]
    attitude = poise.estimate(method, moon, start=wrong)
    assert poise.evaluate(attitude, moon).inclination[-1] < np.radians(1.0)


# -- parameters, options, pickles -------------------------------------------------------------------------------------


@every_method
def test_every_parameter_has_a_unit_a_meaning_and_a_default(method: Any) -> None:
    for parameter in parameters(type(method)):
        assert parameter.unit, parameter.name
        assert len(parameter.meaning) > 10, parameter.name
        assert parameter.default is not None, parameter.name
    assert "Source:" in (sys.modules[type(method).__module__].__doc__ or "")
    assert "Departures from the print" in (sys.modules[type(method).__module__].__doc__ or "")


@every_method
def test_every_option_works(method: Any) -> None:
    recording = made()
    options = [type(method).as_printed()] if hasattr(method, "as_printed") else []
    for parameter in parameters(type(method)):
        values = parameter.choices or ((True, False) if parameter.kind is bool else ())
        options += [method._replace(**{parameter.name: value}) for value in values]
    for option in options:
        attitude = poise.estimate(option, recording, guard=None, rest_bias=False)  # as the oracles' tests compile it
        error = judged_rmse(poise.evaluate(attitude, recording), method)
        assert error < (180.0 if adds_rates_to_angles(option) else 15.0), option


@every_method
def test_nonsense_is_refused_before_anything_runs(method: Any) -> None:
    with pytest.raises(MethodError, match="is a class"):
        poise.estimate(type(method), made())
    with pytest.raises(RecordingError, match="expected a Recording"):
        poise.estimate(method, made().gyr)  # type: ignore[arg-type]
    with pytest.raises(RecordingError, match="unit quaternion"):
        poise.estimate(method, made(), start=[0.0, 0.0, 0.0, 0.0])
    with pytest.raises(MethodError, match="bias"):
        poise.estimate(method, made(), bias=[1.0, np.nan, 0.0])


@every_method
def test_methods_results_and_states_are_picklable(method: Any) -> None:
    recording = made()[:100]
    attitude = poise.estimate(method, recording)
    assert pickle.loads(pickle.dumps(method)) == method
    assert same_bits(pickle.loads(pickle.dumps(attitude)), attitude)
    stream = poise.Stream(method)
    stream.update(packet(recording, 0, 100))
    assert flat(pickle.loads(pickle.dumps(stream.state))) == flat(stream.state)
    twin = copy.deepcopy(stream)
    a, b = (s.update(packet(made(), 100, 150)) for s in (stream, twin))
    assert same_bits(a, b)


_PLAIN = """
import sys, numpy, poise
from poise.estimators import METHODS
from poise.simulation import Sensor, forearm, measure
recording = measure(forearm(20.0, 100.0, 4), Sensor(), seed=4)
numpy.save(sys.argv[2], poise.estimate(METHODS[sys.argv[1]](), recording).table)
"""


_PLAIN_BACK = """
import sys, numpy, poise
from poise.simulation import Sensor, forearm, measure
numpy.save(sys.argv[1], poise.smooth(measure(forearm(6.0, 50.0, 4), Sensor(), seed=4)).table)
"""


def test_compiled_and_plain_python_agree_on_the_way_back(tmp_path: Any) -> None:
    out = tmp_path / "plain.npy"
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    subprocess.run([sys.executable, "-c", _PLAIN_BACK, str(out)], check=True, env=environment, timeout=120)
    compiled = poise.smooth(measure(forearm(6.0, 50.0, 4), Sensor(), seed=4))
    np.testing.assert_allclose(np.load(out), compiled.table, atol=1e-9)


@every_method
def test_compiled_and_plain_python_agree(method: Any, tmp_path: Any) -> None:
    name = next(name for name, cls in METHODS.items() if cls is type(method))
    out = tmp_path / "plain.npy"
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    subprocess.run([sys.executable, "-c", _PLAIN, name, str(out)], check=True, env=environment, timeout=120)
    table = np.load(out)
    compiled = poise.estimate(method, measure(forearm(20.0, 100.0, 4), Sensor(), seed=4))
    assert angle_between(table[:, :4], compiled.quat).max() < 1e-9
    np.testing.assert_allclose(table[:, 4:], compiled.table[:, 4:], atol=1e-9)
