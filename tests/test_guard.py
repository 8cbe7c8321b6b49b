"""What the guard finds in stamps and samples, what it does about it, and that it leaves good data alone."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays_of
from numpy.typing import NDArray

import poise
from data_files import data_path
from helpers import angle_between, in_packets
from poise.data.flags import KNOWN, SENTENCES, Flag
from poise.data.packet import Packet
from poise.errors import RecordingError
from poise.estimators.guard.stamps import evened
from poise.math import arrays
from poise.simulation import PERFECT, Sensor, at_rest, forearm, measure

METHOD = poise.AdaptiveGain()  # every rule is the same for every method; this one compiles quickest
RATE = 100.0
AT = 2500  # a row in motion


@cache
def clean() -> poise.Recording:
    return measure(forearm(60.0, RATE, seed=1), Sensor(jitter=0.0), seed=2)


@cache
def undisturbed() -> poise.Attitude:
    return poise.estimate(METHOD, clean())


def changed(**columns: NDArray[np.float64]) -> poise.Recording:
    return replace(clean(), **columns)


def with_rows(name: str, rows: Any, value: Any) -> poise.Recording:
    values = getattr(clean(), name).copy()
    values[rows] = value
    return changed(**{name: values})


def flagged(attitude: poise.Attitude, flag: Flag) -> NDArray[np.intp]:
    return np.flatnonzero(attitude.flags & np.uint32(flag))


def away_deg(attitude: poise.Attitude, rows: Any = slice(None)) -> NDArray[np.float64]:
    """How far from the attitude without the fault."""
    return np.degrees(angle_between(attitude.quat, undisturbed().quat[rows]))


def told(attitude: poise.Attitude) -> set[Flag]:
    """The flags that say that something was wrong."""
    return {flag for flag in Flag if len(flagged(attitude, flag))} - {Flag.REST, Flag.CORRECTION_FORCED}


def test_a_clean_recording_is_not_touched() -> None:
    bare = poise.estimate(METHOD, clean(), guard=None)
    np.testing.assert_array_equal(undisturbed().quat[1:], bare.quat[1:])
    assert told(undisturbed()) == set()
    assert undisturbed().valid.all()


@pytest.mark.parametrize(
    ("name", "true"),
    [
        ("broad/01_undisturbed_slow_rotation_A.mat", set()),
        ("broad/15_undisturbed_fast_translation_A.mat", set()),
        ("broad/25_disturbed_tapping_B.mat", {Flag.ACC_IGNORED}),  # blows that the gyroscope does not feel
        ("other/x-io_fusion_sensor_data.csv", {Flag.JITTER}),  # lost rows
        ("other/phidgets_imu_upside_down.bag", {Flag.JITTER}),  # the computer's stamps
    ],
)
def test_what_is_flagged_on_real_recordings(name: str, true: set[Flag]) -> None:
    attitude = poise.estimate(METHOD, poise.read(data_path(name)))
    assert told(attitude) - {Flag.HEADING_ARBITRARY} == true
    assert len(flagged(attitude, Flag.ACC_IGNORED)) < 20
    assert attitude.valid.all()


# -- stamps -----------------------------------------------------------------------------------------------------------


def stamps(rows: Any, value: Any) -> poise.Recording:
    return with_rows("time", rows, value)


def test_a_missing_stamp_is_the_usual_interval() -> None:
    attitude = poise.estimate(METHOD, stamps([AT, AT + 1, AT + 50], np.nan))
    assert list(flagged(attitude, Flag.TIME_DISORDER)) == [AT, AT + 1, AT + 50]
    assert away_deg(attitude).max() < 0.02
    assert attitude.valid.all()


@pytest.mark.parametrize("shift", [-10.0, -1000.0])
def test_a_clock_that_is_set_back_loses_no_rotation(shift: float) -> None:
    attitude = poise.estimate(METHOD, changed(time=clean().time + shift * (np.arange(len(clean())) >= AT)))
    assert list(flagged(attitude, Flag.CLOCK_JUMP)) == [AT]
    assert away_deg(attitude).max() < 0.02


def test_stamps_of_zero_for_a_while_lose_no_rotation() -> None:
    attitude = poise.estimate(METHOD, stamps(slice(AT, AT + 500), 0.0))
    assert list(flagged(attitude, Flag.TIME_DISORDER)) == list(range(AT, AT + 500))
    assert list(flagged(attitude, Flag.CLOCK_JUMP)) == [AT, AT + 500]
    assert away_deg(attitude).max() < 0.1


@pytest.mark.parametrize("field", [True, False])
def test_a_clock_put_forward_loses_nothing_where_the_samples_go_on(field: bool) -> None:
    recording = changed(time=clean().time + 3600.0 * (np.arange(len(clean())) >= AT))
    recording = recording if field else replace(recording, mag=np.full_like(recording.mag, np.nan))
    attitude = poise.estimate(METHOD, recording)
    assert list(flagged(attitude, Flag.CLOCK_JUMP)) == [AT]
    assert not len(flagged(attitude, Flag.GAP))
    assert not field or away_deg(attitude).max() < 0.02
    assert attitude.valid.all()


@pytest.mark.parametrize("lost", [130, 1000])
def test_rows_lost_for_long_are_a_gap(lost: int) -> None:
    kept = np.setdiff1d(np.arange(len(clean())), np.arange(AT, AT + lost))
    attitude = poise.estimate(METHOD, clean()[kept])
    assert list(flagged(attitude, Flag.GAP)) == [AT]
    assert attitude.flags[AT] & Flag.LOST
    assert attitude.valid[AT + 500 :].all()
    assert away_deg(attitude, kept)[AT + 1000 :].max() < 5.0


def test_at_rest_without_magnetometer_an_hour_is_a_gap() -> None:
    """Who knows what it was turned by meanwhile."""
    recording = changed(
        time=clean().time + 3600.0 * (np.arange(len(clean())) >= 300), mag=np.full((len(clean()), 3), np.nan)
    )
    assert list(flagged(poise.estimate(METHOD, recording), Flag.GAP)) == [300]


@pytest.mark.parametrize("method", [METHOD, poise.SelfCalibrating()])
def test_stamps_that_scatter_about_an_even_pace_are_followed_slowly(method: Any) -> None:
    rng, period = np.random.default_rng(4), 1.0 / RATE
    true = poise.estimate(method, clean()).quat
    for stamped in (clean().time + rng.uniform(-0.2, 0.2, len(clean())) * period, np.round(clean().time, 2)):
        attitude = poise.estimate(method, changed(time=stamped))
        assert np.degrees(arrays.angle(arrays.multiply(arrays.conjugate(true), attitude.quat)))[300:].max() < 0.5
        assert attitude.valid.all()


@pytest.mark.parametrize("kind", ["two fifths of a period", "as late as a busy computer", "0.3, and 2 % lost"])
def test_stamps_that_scatter_far_are_those_of_an_even_pace(kind: str) -> None:
    rng, period, true = np.random.default_rng(4), 1.0 / RATE, clean().time
    kept = rng.random(len(true)) > (0.02 if "lost" in kind else 0.0)
    even = true[kept]
    off = rng.exponential(0.2, len(even)) if "late" in kind else rng.uniform(-1.0, 1.0, len(even))
    scatter = 1.0 if "late" in kind else 0.3 if "lost" in kind else 0.4
    away = evened(np.maximum.accumulate(even + scatter * period * off)) - even
    away -= np.median(away)
    assert np.quantile(abs(away[1000:]), 0.95) < 0.15 * period
    assert np.quantile(abs(away[100:]), 0.9) < 0.3 * period


@pytest.mark.parametrize("kind", ["anywhere between", "exponential", "5 and 15 ms", "8, 8 and 14 ms"])
def test_steps_that_are_uneven_by_themselves_are_kept(kind: str) -> None:
    rng, n = np.random.default_rng(4), 12000
    drawn = {
        "anywhere between": rng.uniform(2.0, 18.0, n),
        "exponential": 1.0 + rng.exponential(10.0, n),
        "5 and 15 ms": np.tile([5.0, 15.0], n // 2),
        "8, 8 and 14 ms": np.tile([8.0, 8.0, 14.0], n // 3),
    }
    time = np.cumsum(drawn[kind]) * 1e-3
    np.testing.assert_allclose(np.diff(evened(time))[100:], np.diff(time)[100:], atol=1e-9)


def test_samples_that_come_unevenly_keep_their_stamps() -> None:
    """Every second row in five left out: steps of one and two periods, none of them an error of the clock."""
    kept = np.flatnonzero(np.arange(len(clean())) % 5 != 1)
    assert away_deg(poise.estimate(METHOD, clean()[kept]), kept).max() < 1.0


@pytest.mark.parametrize("rate", [25.0, 50.0, 286.0])
@pytest.mark.parametrize(
    "kind", [{}, {"first": True}, {"late": 0.004}, {"late": 0.002, "apart": 1e-4}, {"apart": 5e-5, "most": 6}]
)
def test_rows_that_come_in_packets_lose_no_rotation(rate: float, kind: dict[str, Any]) -> None:
    """However they are stamped, also where a packet lasts longer than a gap: 12 rows at 25 Hz are 0.48 s."""
    recording = measure(forearm(30.0, rate, seed=3), Sensor(jitter=0.0), seed=3)
    true = poise.estimate(METHOD, recording)
    attitude = poise.estimate(METHOD, replace(recording, time=in_packets(recording.time, 3, **kind)))
    assert np.degrees(angle_between(attitude.quat, true.quat)).max() < 0.5  # it was up to 143
    assert attitude.valid[round(3.0 * rate) :].all()
    assert len(set(flagged(attitude, Flag.GAP))) <= 1  # where they begin


def test_in_packets_a_sensor_may_hold_its_sample() -> None:
    """Four rows alike in every hundred, which passed for rows that were sent twice."""
    recording = measure(forearm(30.0, RATE, seed=3), Sensor(jitter=0.0), seed=3)
    first = np.arange(len(recording)) - np.where(
        np.arange(len(recording)) % 100 < 4, np.arange(len(recording)) % 100, 0
    )
    held = recording[first].with_samples(time=recording.time)
    attitude = poise.estimate(METHOD, replace(held, time=in_packets(held.time, 3)))
    assert np.degrees(angle_between(attitude.quat, poise.estimate(METHOD, held).quat)).max() < 1.0


def test_rows_that_are_lost_between_packets_are_a_gap() -> None:
    recording = measure(forearm(30.0, RATE, seed=3), Sensor(jitter=0.0), seed=3)
    kept = np.flatnonzero((recording.time < 15.0) | (recording.time > 15.6))
    attitude = poise.estimate(METHOD, replace(recording, time=in_packets(recording.time, 3))[kept])
    assert 15.0 <= attitude.time[flagged(attitude, Flag.GAP)[-1]] <= 15.8


def test_packets_that_begin_in_the_middle_are_followed() -> None:
    recording = measure(forearm(40.0, RATE, seed=3), Sensor(jitter=0.0), seed=3)
    half = len(recording) // 2
    stamps = np.append(recording.time[:half], in_packets(recording.time[half:], 3, apart=5e-5))
    true, attitude = poise.estimate(METHOD, recording), poise.estimate(METHOD, replace(recording, time=stamps))
    away = np.degrees(angle_between(attitude.quat, true.quat))
    assert away[:half].max() < 1e-6
    assert away[half + 1000 :].max() < 2.0


@pytest.mark.parametrize("seed", [11, 13])
def test_packets_of_many_sizes_are_followed_for_minutes(seed: int) -> None:
    """What their first stamps were taken for wrongly was paid back in one step of 0.2 s, a minute later."""
    recording = poise.read(next(data_path("broad").glob("25_*.mat")))
    flagship = poise.SelfCalibrating()
    attitude = poise.estimate(flagship, replace(recording, time=in_packets(recording.time, seed)))
    away = np.degrees(angle_between(attitude.quat, poise.estimate(flagship, recording).quat))
    assert away.max() < 5.0  # it was 21
    assert not flagged(attitude, Flag.JITTER)[10:].size


@pytest.mark.parametrize("rate", [75.0, 110.0, 200.0])
def test_packets_whose_pace_changes_are_followed_again(rate: float) -> None:
    """A body that turns at 1 rad/s for 30 s, at 100 samples a second, and for 30 s at another rate."""
    time = np.concatenate([np.arange(3000) / 100.0, 30.0 + np.arange(int(30 * rate)) / rate])
    gyr = np.tile([0.0, 0.0, 1.0], (len(time), 1))
    acc = np.tile([0.0, 0.0, 9.80665], (len(time), 1)) + 0.01 * np.random.default_rng(1).normal(size=(len(time), 3))
    attitude = poise.estimate(METHOD, poise.Recording(in_packets(time, 1), gyr, acc))
    heading = np.unwrap(2.0 * np.arctan2(attitude.quat[:, 3], attitude.quat[:, 0]))
    late = time >= 40.0
    assert np.polyfit(time[late], heading[late], 1)[0] == pytest.approx(1.0, abs=0.03)
    assert attitude.valid.all()


def test_stamps_in_batches_lose_no_rotation() -> None:
    last_of_five = np.minimum(np.arange(len(clean())) // 5 * 5 + 4, len(clean()) - 1)
    attitude = poise.estimate(METHOD, changed(time=clean().time[last_of_five]))
    assert away_deg(attitude)[500:].max() < 1.0
    assert attitude.valid.all()


def test_swapped_rows_lose_no_rotation() -> None:
    order = np.arange(len(clean()))
    first = np.arange(200, len(order) - 1, 100)
    order[first], order[first + 1] = order[first + 1], order[first].copy()
    attitude = poise.estimate(METHOD, clean()[order])
    assert list(flagged(attitude, Flag.TIME_DISORDER)) == list(first + 1)
    assert away_deg(attitude, order)[np.setdiff1d(np.arange(len(order)), [*first, *(first + 1)])].max() < 0.5


def test_a_row_that_comes_twice_counts_once() -> None:
    twice = np.sort(np.concatenate([np.arange(len(clean())), np.arange(100, 5000, 100)]))
    attitude = poise.estimate(METHOD, clean()[twice])
    again = np.flatnonzero(np.diff(twice) == 0) + 1
    assert list(flagged(attitude, Flag.TIME_DISORDER)) == list(again)
    np.testing.assert_array_equal(attitude.quat, undisturbed().quat[twice])


@pytest.mark.parametrize(("share", "most"), [(0.05, 1.0), (0.3, 4.0)])
def test_between_lost_rows_the_rate_goes_straight(share: float, most: float) -> None:
    kept = np.flatnonzero(np.random.default_rng(3).random(len(clean())) >= share)
    attitude = poise.estimate(METHOD, clean()[kept])
    assert away_deg(attitude, kept).max() < most
    jitter = flagged(attitude, Flag.JITTER)
    assert set(jitter) <= set(np.flatnonzero(np.diff(kept) > 1) + 1)
    assert attitude.valid.all()


def test_stamps_in_milliseconds_are_named_live_too() -> None:
    part = clean()[:50]
    for factor, unit in ((1e3, "milliseconds"), (1e6, "microseconds")):
        stream = poise.Stream(METHOD)
        with pytest.raises(RecordingError, match=f"{unit}.*Multiply them by {1 / factor:g}"):
            stream.update(Packet(part.time * factor, part.gyr, part.acc, part.mag))
        assert stream.update(Packet(part.time, part.gyr, part.acc, part.mag)).valid.all()
        with pytest.raises(RecordingError, match=f"Multiply them by {1 / factor:g}"):
            poise.Recording(part.time * factor, part.gyr, part.acc, part.mag)


def test_all_stamps_the_same_is_no_time_at_all() -> None:
    with pytest.raises(RecordingError, match=r"time: all 6000 stamps are 7, .*at_rate"):
        changed(time=np.full(len(clean()), 7.0))
    stream, few = poise.Stream(METHOD), clean()[:40]
    attitude = stream.update(Packet(np.full(40, 7.0), few.gyr, few.acc, few.mag))
    assert (attitude.flags[1:] & Flag.TIME_DISORDER).all()
    assert not attitude.valid[30:].any()


def test_a_rate_of_zero_amid_a_turn_is_no_measurement() -> None:
    row = int(np.argmax(np.linalg.norm(clean().gyr, axis=1)))
    attitude = poise.estimate(METHOD, with_rows("gyr", row, 0.0))
    assert list(flagged(attitude, Flag.GYR_IGNORED)) == [row]
    assert away_deg(attitude).max() < 0.1


# -- samples ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "size", "flag"),
    [("gyr", 10.0, Flag.GYR_IGNORED), ("acc", 50.0, Flag.ACC_IGNORED), ("mag", 300.0, Flag.MAG_IGNORED)],
)
def test_spikes_are_left_out(name: str, size: float, flag: Flag) -> None:
    rng = np.random.default_rng(4)
    rows = np.sort(rng.choice(np.arange(50, len(clean())), 50, replace=False))
    spikes = rng.normal(size=(len(rows), 3))
    values = getattr(clean(), name).copy()
    values[rows] += size * spikes / np.linalg.norm(spikes, axis=1, keepdims=True)
    attitude = poise.estimate(METHOD, changed(**{name: values}))
    found = flagged(attitude, flag)
    assert set(found) <= set(rows)
    assert len(found) >= 45
    assert np.median(away_deg(attitude)) < 0.5


@pytest.mark.parametrize(("name", "size", "flag"), [("gyr", 5.0, Flag.GYR_IGNORED), ("acc", 50.0, Flag.ACC_IGNORED)])
def test_a_second_spike_in_a_row_is_one_too(name: str, size: float, flag: Flag) -> None:
    """That a sample is late is no reason to expect more of it: what takes a blow takes one."""
    values = getattr(clean(), name).copy()
    values[AT] += [size, 0.0, 0.0]
    values[AT + 1] += [0.0, size, 0.0]
    np.testing.assert_array_equal(flagged(poise.estimate(METHOD, changed(**{name: values})), flag), [AT, AT + 1])


def test_a_blow_that_both_sensors_feel_is_no_spike() -> None:
    gyr, acc = clean().gyr.copy(), clean().acc.copy()
    gyr[AT] += [5.0, 0.0, 0.0]
    acc[AT] += [0.0, 60.0, 0.0]
    assert told(poise.estimate(METHOD, changed(gyr=gyr, acc=acc))) == set()


def test_a_step_that_stays_is_no_spike() -> None:
    mag = clean().mag.copy()
    mag[AT:] += [200.0, 0.0, 0.0]
    attitude = poise.estimate(METHOD, changed(mag=mag))
    assert list(flagged(attitude, Flag.MAG_IGNORED)) == [AT, AT + 1]


@pytest.mark.parametrize(("name", "flag"), [("gyr", Flag.STUCK_GYR), ("acc", Flag.STUCK_ACC), ("mag", Flag.STUCK_MAG)])
def test_a_sensor_that_hangs_is_found_within_a_quarter_of_a_second(name: str, flag: Flag) -> None:
    still = int(flagged(undisturbed(), Flag.REST)[50])
    for at in (AT, still) if name != "gyr" else (AT,):
        attitude = poise.estimate(METHOD, with_rows(name, slice(at, at + 300), getattr(clean(), name)[at]))
        found = flagged(attitude, flag)
        assert at + 19 < found[0] < at + 23
        assert list(found) == list(range(found[0], at + 300))
        assert told(attitude) >= {flag}


def test_what_repeats_by_nature_does_not_hang() -> None:
    perfect = measure(at_rest(np.array([1.0, 0, 0, 0]), 20.0, RATE), PERFECT)
    assert told(poise.estimate(METHOD, perfect)) == set()  # never changed
    held = np.arange(len(clean())) // 25 * 25  # four samples a second, repeated by a logger
    assert not told(poise.estimate(METHOD, changed(mag=clean().mag[held]))) & {Flag.STUCK_MAG, Flag.MAG_IGNORED}
    coarse = np.round(clean().acc / 0.15) * 0.15  # 8 bits: quiet at rest, lively in motion
    assert not told(poise.estimate(METHOD, changed(acc=coarse))) & {Flag.STUCK_ACC}


@pytest.mark.parametrize(("name", "flag"), [("acc", Flag.ACC_MISSING), ("mag", Flag.MAG_MISSING)])
@pytest.mark.parametrize("value", [0.0, np.nan])
def test_zeros_and_nan_are_silence_and_flagged_within_a_quarter_of_a_second(
    name: str, flag: Flag, value: float
) -> None:
    attitude = poise.estimate(METHOD, with_rows(name, slice(AT, AT + 300), value))
    missing = flagged(attitude, flag)
    assert AT + 18 < missing[0] < AT + 22
    assert list(missing) == list(range(missing[0], AT + 300))
    assert attitude.valid.all()


def test_the_silence_of_a_slow_sensor_is_judged_by_its_own_rate() -> None:
    slow = clean().mag.copy()
    slow[np.arange(len(slow)) % 50 > 0] = np.nan  # two samples a second
    assert not len(flagged(poise.estimate(METHOD, changed(mag=slow)), Flag.MAG_MISSING)[30:])
    slow[AT:] = np.nan
    missing = flagged(poise.estimate(METHOD, changed(mag=slow)), Flag.MAG_MISSING)
    assert AT + 50 < missing[-(len(slow) - AT) // 2] < AT + 2000
    assert missing[-1] == len(slow) - 1


@pytest.mark.parametrize(("name", "flag", "end"), [("gyr", Flag.GYR_CLIPPED, 2.3), ("acc", Flag.ACC_CLIPPED, 19.6)])
def test_the_end_of_a_range_is_learned(name: str, flag: Flag, end: float) -> None:
    acc = clean().acc.copy()
    acc[1000:3000, 0] += 30.0 * np.sin(2.0 * np.pi * 2.0 * clean().time[1000:3000])
    shaken = changed(acc=acc)
    assert not told(poise.estimate(METHOD, shaken))
    clipped = np.clip(getattr(shaken, name), -end, end)
    hit = np.flatnonzero((np.abs(clipped) == end).any(axis=1))
    found = flagged(poise.estimate(METHOD, replace(shaken, **{name: clipped})), flag)
    assert len(hit) > 50
    assert set(found) <= set(hit)
    assert len(hit) - len(found) <= 4, "a few equal extremes tell where the range ends"


@pytest.mark.parametrize(("name", "flag", "end"), [("gyr", Flag.GYR_CLIPPED, 1.6), ("acc", Flag.ACC_CLIPPED, 12.5)])
def test_a_range_smaller_than_data_sheets_have_is_learned_from_what_chance_would_not_do(
    name: str, flag: Flag, end: float
) -> None:
    shaken = shaken_in_steps(0.005, 0.001)
    assert not {Flag.ACC_CLIPPED, Flag.GYR_CLIPPED} & told(poise.estimate(METHOD, shaken))
    clipped = np.clip(getattr(shaken, name), -end, end)
    hit = np.flatnonzero((np.abs(clipped) == end).any(axis=1))
    attitude = poise.estimate(METHOD, replace(shaken, **{name: clipped}))
    found = flagged(attitude, flag)
    assert len(hit) > 100
    assert set(found) <= set(hit)
    assert len(hit) - len(found) <= 8, "how rarely a component repeats is not known early on"
    assert not len(flagged(attitude, Flag.ACC_MISSING)), "a clipped force is used: it is nearer than none"


def test_sigma_grows_while_the_specific_force_is_clipped() -> None:
    shaken, method = shaken_in_steps(0.005, 0.001), poise.TwoStage()
    clipped = np.clip(shaken.acc, -12.5, 12.5)
    attitude = poise.estimate(method, replace(shaken, acc=clipped))
    found = flagged(attitude, Flag.ACC_CLIPPED)
    grown = np.linalg.norm(attitude.sigma, axis=1) / np.linalg.norm(poise.estimate(method, shaken).sigma, axis=1)
    assert len(found) > 50
    assert np.median(grown[found]) > 1.005
    assert attitude.valid[found].all(), "what it hides is small"


def test_a_coarse_sensor_that_repeats_is_not_clipped() -> None:
    for coarse in (0.04, 0.15):
        attitude = poise.estimate(METHOD, shaken_in_steps(coarse, 0.05 * coarse))
        assert not len(flagged(attitude, Flag.ACC_CLIPPED)), coarse
        assert len(flagged(attitude, Flag.GYR_CLIPPED)) <= 3, "smooth peaks that touch the same step, beyond 125 deg/s"


def shaken_in_steps(acc_step: float, gyr_step: float) -> poise.Recording:
    """With more motion than the forearm has, in steps of so much."""
    time, shake = clean().time, np.zeros((len(clean()), 3))
    for k in range(3):
        shake[1000:, k] = sum(np.sin(2.0 * np.pi * f * time[1000:] + k * f) for f in (0.7, 1.13, 1.9)) / 3.0
    acc = np.round((clean().acc + 5.0 * shake) / acc_step) * acc_step
    gyr = np.round((clean().gyr + 0.6 * shake) / gyr_step) * gyr_step
    return changed(acc=acc, gyr=gyr)


# -- doubt, valid and resets ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seconds", [1.0, 10.0])
def test_a_lost_gyroscope_is_flagged_at_once_and_started_anew_from_three_seconds(seconds: float) -> None:
    end = AT + int(seconds * RATE)
    biased = changed(gyr=clean().gyr + 0.01)
    gyr = biased.gyr.copy()
    gyr[AT:end] = np.nan
    attitude = poise.estimate(METHOD, replace(biased, gyr=gyr))
    assert list(flagged(attitude, Flag.GYR_MISSING)) == list(range(AT, end))
    first_invalid = int(np.flatnonzero(~attitude.valid)[0])
    assert AT < first_invalid < AT + 50
    (reset,) = attitude.resets()
    assert end + 250 < reset.row <= end + 305
    np.testing.assert_array_equal(attitude.bias[reset.row], attitude.bias[AT - 1])
    assert attitude.valid[end + 500 :].all()
    assert away_deg(attitude)[end + 500 :].max() < 5.0


def test_sigma_grows_while_it_bridges() -> None:
    recording = with_rows("gyr", slice(AT, AT + 15), np.nan)
    plain, bridged = (poise.estimate(poise.TwoStage(), r) for r in (clean(), recording))
    growth = np.sqrt(bridged.sigma**2 - np.minimum(plain.sigma, bridged.sigma) ** 2)[:, 2]
    assert growth[AT - 1] == 0.0
    assert (np.diff(growth[AT : AT + 15]) > 0.0).all()
    assert growth[AT + 14] > np.radians(2.0)
    assert growth[AT + 1000] < np.radians(1.0)
    assert np.isnan(poise.estimate(METHOD, recording).sigma).all(), "a method without sigma gets none"


def test_a_reset_is_published_with_its_size() -> None:
    recording = with_rows("gyr", slice(AT, AT + 200), np.nan)
    attitude = poise.estimate(METHOD, recording)
    (reset,) = attitude.resets()
    assert reset.time == recording.time[reset.row]
    turned = arrays.multiply(attitude.quat[reset.row], arrays.conjugate(attitude.quat[reset.row - 1]))
    np.testing.assert_allclose(reset.delta, arrays.rotation_vector(turned), atol=1e-12)
    stream = poise.Stream(METHOD)
    assert stream.resets == 0
    assert np.isnan(stream.reset_delta).all()
    for part in (slice(0, AT + 100), slice(AT + 100, len(recording))):
        stream.update(Packet(recording.time[part], recording.gyr[part], recording.acc[part], recording.mag[part]))
    again = poise.Stream(METHOD).restore(stream.save())
    for s in (stream, again):
        assert (s.resets, s.reset_time) == (1, reset.time)
        np.testing.assert_allclose(s.reset_delta, reset.delta, atol=1e-12)


def test_live_silence_is_told_without_a_sample() -> None:
    stream = poise.Stream(METHOD)
    assert not stream.check(0.0).valid[0]
    stream.update(Packet(clean().time[:100], clean().gyr[:100], clean().acc[:100], clean().mag[:100]))
    last = float(clean().time[99])
    assert stream.check(last + 0.04).valid[0]
    late = stream.check(last + 0.06)
    assert late.flags[0] & Flag.SILENT
    assert not late.valid[0]


def test_every_flag_has_a_sentence_and_a_place_in_files() -> None:
    assert set(SENTENCES) == set(Flag)
    assert not any(int(flag) & ~KNOWN for flag in Flag)


# -- anything at all --------------------------------------------------------------------------------------------------

WILD = st.sampled_from(
    [0.0, -0.0, 5e-324, -1e-310, 1e-30, 1e-7, 0.01, 1.0, -9.81, 50.0, 1e4, 1e30, 1e308, -1e308, np.inf, -np.inf, np.nan]
)


@settings(max_examples=60, deadline=None)
@given(
    rows=arrays_of.arrays(float, st.tuples(st.integers(1, 60), st.just(10)), elements=WILD),
    stamped=st.booleans(),
    before=st.integers(0, 60),
)
def test_whatever_comes_the_state_stays_finite(rows: NDArray[np.float64], stamped: bool, before: int) -> None:
    good = clean()[1000:1800]
    stream = poise.Stream(METHOD)
    if before:
        part = good[:before]
        stream.update(Packet(part.time, part.gyr, part.acc, part.mag))
    time = rows[:, 0] if not stamped else good.time[before] + 0.01 * np.arange(len(rows))
    parts = []
    for i in range(len(rows)):
        parts.append(stream.update(Packet(float(time[i]), rows[i, 1:4], rows[i, 4:7], rows[i, 7:10])))
    for part in parts:
        known = np.isfinite(part.quat[0]).all()
        assert known or not part.valid[0]
        assert not known or abs(np.linalg.norm(part.quat[0]) - 1.0) < 1e-9
    rest = good[100:]
    after = stream.update(Packet(rest.time + 1000.0, rest.gyr, rest.acc, rest.mag))
    assert np.isfinite(after.table[-1, :10]).all()
    assert after.valid[-1]


@settings(max_examples=30, deadline=None)
@given(rows=arrays_of.arrays(float, st.tuples(st.integers(0, 30), st.just(10)), elements=WILD))
def test_a_recording_of_anything_is_refused_or_estimated(rows: NDArray[np.float64]) -> None:
    kept = rows.copy()
    try:
        recording = poise.Recording(rows[:, 0], rows[:, 1:4], rows[:, 4:7], rows[:, 7:10])
    except RecordingError:
        return
    attitude = poise.estimate(METHOD, recording)
    assert np.isfinite(attitude.quat[attitude.valid]).all()
    np.testing.assert_array_equal(rows, kept)


@pytest.mark.parametrize("every", [1, 2, 10])
@pytest.mark.parametrize("missing", [0.0, 0.05])
def test_a_loss_ends_with_a_slow_accelerometer_and_a_lossy_gyroscope_too(every: int, missing: float) -> None:
    recording = measure(forearm(60.0, 100.0, 1), seed=1)
    gyr, acc = recording.gyr.copy(), recording.acc.copy()
    gyr[2000:3000] = np.nan
    gyr[np.random.default_rng(0).random(len(gyr)) < missing] = np.nan
    acc[np.arange(len(acc)) % every > 0] = np.nan
    faulty = replace(recording, gyr=gyr, acc=acc)
    for method in (poise.SelfCalibrating(), poise.TwoStage()):
        attitude = poise.estimate(method, faulty)
        assert not attitude.valid[2200:3000].any()
        assert attitude.valid[3400:].all()
        assert np.degrees(poise.evaluate(attitude, faulty).total[-1000:].max()) < 8.0


def test_iron_under_foot_leaves_the_heading_to_the_gyroscope() -> None:
    """A field that stands upright for a while, in the midst of a recording, takes no heading with it."""
    still = measure(at_rest(duration=20.0), PERFECT, seed=1)
    over = (still.time > 8.0) & (still.time < 13.0)
    iron = np.where(over[:, None], still.acc * -6.0, still.mag) + np.array([0.5, 0.0, 0.0])
    attitude = poise.estimate(METHOD, still.with_samples(mag=iron))
    assert not flagged(attitude, Flag.HEADING_ARBITRARY).size and not flagged(attitude, Flag.RESET).size
    missing = attitude.time[flagged(attitude, Flag.MAG_MISSING)]
    assert 8.0 < missing.min() < 10.0 and 13.0 < missing.max() < 14.5
    assert np.degrees(poise.evaluate(attitude, still).heading).max() < 10.0
