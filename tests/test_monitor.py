"""The tip-over monitor: when it says what, on attitudes from formulas."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import replace
from math import atan, inf, nan, pi, radians
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray

import poise
from helpers import for_all
from poise.data.event import TipState
from poise.data.flags import Flag
from poise.data.packet import Output
from poise.errors import MethodError, RecordingError
from poise.math.quaternions import Quat
from poise.math.vectors import ABSENT, ZERO, Vec3
from poise.monitor import Directions, Monitor, Support, TipOver, from_table, judge, mounted, read_settings, tared
from tip_scenes import first, names, times, toppling

Floats = NDArray[np.float64]
AXES = {"forward": (-1.0, 0.0), "back": (1.0, 0.0), "left": (0.0, -1.0), "right": (0.0, 1.0)}
CALM = TipOver(look_ahead=0.0)
ways = st.sampled_from(list(AXES))


def leaning(time: ArrayLike, degrees: ArrayLike, way: str = "forward", rate: bool = True) -> poise.Attitude:
    """The attitude of a robot that leans that many degrees that way, with its rate."""
    time, lean = np.asarray(time, float), np.radians(np.broadcast_to(np.asarray(degrees, float), np.shape(time)))
    x, y = AXES[way]
    zero = np.zeros_like(lean)
    attitude = poise.Attitude.of(
        time, np.column_stack([np.cos(lean / 2), x * np.sin(lean / 2), y * np.sin(lean / 2), zero])
    )
    if rate:
        speed = np.gradient(lean, time) if len(time) > 1 else zero
        attitude.table[:, 4:7] = np.column_stack([x * speed, y * speed, zero])
    return attitude


def states(attitude: poise.Attitude, tipover: TipOver = CALM, acc: Any = None) -> list[TipState]:
    return [TipState(int(code)) for code in judge(attitude, acc, tipover).state]


def spiked(attitude: poise.Attitude, rows: Any, degrees: float) -> poise.Attitude:
    """With the rows' attitude replaced by one that leans that much, and their rate with a large one."""
    wild = leaning(attitude.time, degrees)
    table = attitude.table.copy()
    table[rows] = wild.table[rows]
    table[rows, 4] = -10.0
    return replace(attitude, table=table)


# -- the range ---------------------------------------------------------------------------------------------------------


@for_all(ways, st.floats(5.0, 60.0), st.one_of(st.just(0.0), st.floats(0.01, 25.0)))
def test_it_triggers_at_the_range_and_not_below(way: str, limit: float, more: float) -> None:
    """At or beyond (≥): a lean of exactly the range counts, one a thousandth of a degree below does not."""
    tip = CALM._replace(range=radians(limit), self_balancing=radians(limit + more), impact=pi)
    time = times(0.3)
    assert names(judge(leaning(time, limit - 1e-3, way), tipover=tip).events) == ["UPRIGHT"]
    at = judge(leaning(time, limit, way), tipover=tip).events
    assert names(at) == ["TIPPING" if more == 0.0 else "LEANING"]
    assert at[0].direction == way
    beyond = judge(leaning(time, limit + more, way), tipover=tip).events
    assert names(beyond)[0] == "TIPPING" and beyond[0].direction == way
    assert "LEANING" not in names(beyond)


@for_all(st.tuples(*[st.floats(10.0, 40.0)] * 4), ways)
def test_each_direction_has_its_own_range(limits: tuple[float, ...], way: str) -> None:
    ranges = Directions(*np.radians(limits))
    tip = CALM._replace(range=ranges, self_balancing=Directions(*[radians(60.0)] * 4))
    own, time = getattr(ranges, way), times(0.5)
    assert names(judge(leaning(time, np.degrees(own) - 0.01, way), tipover=tip).events) == ["UPRIGHT"]
    assert names(judge(leaning(time, np.degrees(own), way), tipover=tip).events) == ["LEANING"]


@for_all(st.floats(0.0, 89.0), st.floats(0.0, 20.0), ways)
def test_more_lean_is_never_judged_milder(lean: float, more: float, way: str) -> None:
    order = [TipState.UPRIGHT, TipState.LEANING, TipState.TIPPING, TipState.FALLEN]
    mild, severe = (states(leaning(times(1.0), angle, way))[-1] for angle in (lean, lean + more))
    assert order.index(severe) >= order.index(mild)


def test_a_diagonal_lean_is_judged_across_each_edge() -> None:
    """30° towards a corner is atan(tan 30° / √2) = 22.2° across each of the two edges."""
    half = radians(15.0)
    axis = np.array([-1.0, 1.0, 0.0]) / np.sqrt(2)
    quat = np.tile([np.cos(half), *(np.sin(half) * axis)], (100, 1))
    attitude = poise.Attitude.of(times(0.5), quat)
    found = judge(attitude, tipover=CALM)
    np.testing.assert_allclose(found.tilt, radians(30.0))
    across = atan(np.tan(radians(30.0)) / np.sqrt(2))
    np.testing.assert_allclose(found.directions, np.tile([across, -across, -across, across], (100, 1)))
    np.testing.assert_allclose(found.lean, across)
    np.testing.assert_allclose(found.margin, radians(40.0) - across)


@pytest.mark.parametrize("quat", [[0, 1, 0, 0], [0, 0, 1, 0], [0, 0.6, 0.8, 0], [1e-9, 1, 0, 0]])
def test_upside_down_lies(quat: list[float]) -> None:
    attitude = poise.Attitude.of(times(1.0), np.tile(quat, (200, 1)))
    assert states(attitude)[-1] is TipState.FALLEN


# -- time ---------------------------------------------------------------------------------------------------------------


@for_all(st.floats(0.01, 0.5), st.floats(20.0, 500.0))
def test_a_lean_counts_once_it_has_held_for_the_dwell(dwell: float, rate: float) -> None:
    time = np.arange(round(3.0 * rate)) / rate
    begins = time >= 1.0
    tip = CALM._replace(dwell=dwell, samples=1)
    said = first(judge(leaning(time, np.where(begins, 50.0, 0.0), rate=False), tipover=tip).events, "TIPPING")
    start = time[begins][0]
    assert start + dwell - 1e-6 <= said <= start + dwell + 1.0 / rate + 1e-6


@for_all(st.integers(1, 10), st.sampled_from([1.0, 10.0, 50.0]))
def test_and_for_that_many_samples_however_slow_they_come(samples: int, rate: float) -> None:
    """At 1 Hz a dwell of 50 ms alone would be one sample."""
    time = np.arange(40) / rate
    tip = CALM._replace(samples=samples, dwell=0.0)
    said = states(leaning(time, np.where(np.arange(40) >= 20, 50.0, 0.0), rate=False), tip)
    assert said[20 + samples - 1] is TipState.TIPPING
    assert TipState.TIPPING not in said[: 20 + samples - 1]


@for_all(st.integers(20, 180), st.floats(-180.0, 180.0), st.integers(1, 2))
def test_single_bad_samples_trigger_nothing(row: int, angle: float, length: int) -> None:
    """Of an upright robot, with look-ahead and a wild rate; at any sample rate, as a count of samples is asked for too."""
    for time in (times(1.0), np.arange(200) / 10.0):
        attitude = spiked(leaning(time, 2.0), slice(row, row + length), angle)
        assert names(judge(attitude).events) == ["UPRIGHT"]


@for_all(st.lists(st.integers(205, 214), max_size=2, unique=True))
def test_nor_do_they_stop_what_is_under_way(rows: list[int]) -> None:
    """A fall with samples in it that say "upright" is told at most 6 samples later for each."""
    attitude = leaning(times(2.0), np.where(np.arange(400) >= 200, 50.0, 0.0), rate=False)
    on_time = first(judge(attitude, tipover=CALM).events, "TIPPING")
    table = attitude.table.copy()
    table[rows] = leaning(attitude.time, 0.0, rate=False).table[rows]
    late = first(judge(replace(attitude, table=table), tipover=CALM).events, "TIPPING")
    assert on_time <= late <= on_time + (6 * len(rows) + 1) * 0.005


@for_all(st.floats(0.3, 2.9), st.floats(2.0, 40.0), st.integers(0, 5))
def test_vibration_about_the_range_does_not_chatter(amplitude: float, hertz: float, seed: int) -> None:
    """Within the hysteresis there are two changes at most: to leaning, and none back."""
    time = times(10.0)
    rng = np.random.default_rng(seed)
    lean = 20.0 + amplitude * np.sin(2 * pi * hertz * time) + rng.normal(0.0, 0.02, len(time))
    assert len(judge(leaning(time, lean, rate=False)).events) <= 2


def test_it_is_upright_again_below_the_hysteresis_only() -> None:
    time = times(6.0)
    for back, expected in ((17.5, TipState.LEANING), (16.5, TipState.UPRIGHT)):
        lean = np.where(time < 1.0, 0.0, np.where(time < 3.0, 25.0, back))
        assert states(leaning(time, lean, rate=False))[-1] is expected
    lean = np.where(time < 1.0, 0.0, np.where(time < 3.0, 50.0, 38.0))
    assert states(leaning(time, lean, rate=False), CALM._replace(lie=9.0))[-1] is TipState.TIPPING
    lean = np.where(time < 1.0, 0.0, np.where(time < 3.0, 50.0, 36.0))
    assert states(leaning(time, lean, rate=False), CALM._replace(lie=9.0))[-1] is TipState.LEANING


# -- look-ahead ----------------------------------------------------------------------------------------------------------


@for_all(st.floats(21.0, 39.0), st.floats(0.1, 5.0), st.floats(0.05, 0.5), ways)
def test_a_lean_that_is_about_to_be_too_much_is_told(angle: float, rate: float, ahead: float, way: str) -> None:
    """By the attitude and the rate of the rows alone: angle + rate · look-ahead against the limit."""
    attitude = leaning(times(0.5), angle, way)
    attitude.table[:, 4:7] = np.array([*AXES[way], 0.0]) * rate
    reaches = angle + np.degrees(rate * ahead)
    if abs(reaches - 40.0) < 1e-6:
        return
    event = judge(attitude, tipover=TipOver(look_ahead=ahead)).events[0]
    assert event.state is (TipState.TIPPING if reaches > 40.0 else TipState.LEANING)
    assert event.rate == pytest.approx(rate)
    assert event.time_to_impact == pytest.approx((80.0 - angle) / np.degrees(rate))


def test_a_fast_turn_inside_the_range_is_no_fall() -> None:
    time = times(4.0)
    swings = 15.0 * np.sin(2 * pi * 2.0 * time)  # 190°/s
    assert names(judge(leaning(time, swings)).events) == ["UPRIGHT"]


@for_all(st.floats(0.1, 2.0), st.floats(15.0, 60.0))
def test_the_time_to_impact_of_a_pendulum_is_that_of_its_fall(length: float, angle: float) -> None:
    """Against the numerically integrated fall: never late by more than 5 ms, and early by a quarter at most."""
    time = times(6.0, 1000.0)
    lean = toppling(time, 0.5, length, push=0.2, end=85.0)
    hits, now = time[np.argmax(lean >= radians(80.0))], int(np.argmax(lean >= radians(max(angle, 21.0))))
    found = judge(leaning(time, np.degrees(lean)), tipover=TipOver(pendulum=length)).time_to_impact[now]
    left = hits - time[now]
    assert 0.75 * left - 0.005 < found < left + 0.005


def test_gravity_rights_a_body_whose_centre_of_mass_is_inside() -> None:
    """A box that is kicked: below the speed that carries it over its edge there is no impact, above there is."""
    support = Support([[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]], [0, 0, 0.3], margin=radians(15.0))
    tip = TipOver(edges=support.edges(), pendulum=support.pendulum())
    needed = np.sqrt(tip.gravity / tip.pendulum) * radians(10.0)  # from 10° before the edge
    at = float(np.degrees(support.margins().left)) - 10.0
    for share, falls in ((0.95, False), (1.05, True)):
        attitude = leaning(times(0.2), at, "left")
        attitude.table[:, 5] = -share * needed
        found = judge(attitude, tipover=tip)
        assert np.isfinite(found.time_to_impact[-1]) == falls


def test_without_a_rate_there_is_no_look_ahead() -> None:
    found = judge(leaning(times(1.0), 39.0, rate=False))
    assert names(found.events) == ["LEANING"]
    assert np.isnan(found.rate).all() and np.isnan(found.time_to_impact).all()


# -- unknown ----------------------------------------------------------------------------------------------------------------


@settings(max_examples=40, deadline=None)
@given(data=st.data())
def test_what_is_not_valid_is_unknown_and_never_upright(data: st.DataObject) -> None:
    """NaN, flags that forbid to act, quaternions that are none: unknown in the same row; no event but that."""
    attitude = leaning(times(1.0), data.draw(st.sampled_from([0.0, 30.0, 85.0])))
    rows = data.draw(st.lists(st.integers(50, 199), min_size=1, max_size=30, unique=True))
    kind = data.draw(st.sampled_from(["nan", "lost", "unsettled", "zero", "inf", "huge"]))
    table, flags = attitude.table.copy(), attitude.flags.copy()
    if kind in ("lost", "unsettled"):
        flags[rows] |= np.uint32(Flag[kind.upper()])
    else:
        table[rows, :4] = {"nan": nan, "zero": 0.0, "inf": inf, "huge": 1e200}[kind]
    said = judge(replace(attitude, table=table, flags=flags), tipover=CALM)
    usual = judge(attitude, tipover=CALM)
    assert (said.state[rows] == TipState.UNKNOWN).all()
    assert np.isnan(said.tilt[rows]).all()
    assert set(said.state) <= {*usual.state, TipState.UNKNOWN}


@for_all(st.lists(st.sampled_from([nan, inf, -inf, 1e300, -1e300, 0.0, 9.8]), min_size=9, max_size=9))
def test_wild_numbers_beside_a_good_attitude_fire_nothing(wild: list[float]) -> None:
    """In one row of ten: time, rate, specific force."""
    attitude, acc = leaning(times(2.0), 1.0), np.tile([0.0, 0.0, 9.81], (400, 1))
    attitude.table[::10, 4:7], acc[::10] = wild[:3], wild[3:6]
    attitude.time[::10] = np.where(np.isfinite(wild[6]), attitude.time[::10], wild[6])
    found = judge(attitude, acc)
    assert names(found.events) == ["UPRIGHT"]
    after = judge(leaning(times(2.0), np.where(times(2.0) > 1.0, 50.0, 0.0)), acc)
    assert "TIPPING" in names(after.events)  # nor block


def test_a_fall_is_told_after_a_loss_in_it() -> None:
    attitude = leaning(times(2.0), np.where(times(2.0) > 0.9, 50.0, 0.0), rate=False)
    attitude.flags[180:260] |= np.uint32(Flag.LOST)
    found = judge(attitude, tipover=CALM)
    assert names(found.events)[:3] == ["UPRIGHT", "UNKNOWN", "TIPPING"]
    assert first(found.events, "TIPPING") == pytest.approx(1.35)


@pytest.mark.parametrize("rate", [50.0, 200.0])
def test_a_fall_while_the_clock_stands_still_is_unknown_not_upright(rate: float) -> None:
    time = times(4.0, rate)
    lean = np.where(time < 2.0, 0.0, np.minimum(3.0 * (time - 2.0), 1.5))
    attitude = poise.Attitude.of(np.minimum(time, 2.0), _leaning(lean))
    judgement = judge(attitude)
    last = np.flatnonzero(judgement.state == TipState.UPRIGHT)[-1]
    assert time[last] - 2.0 < max(0.05, 4.5 / rate)
    assert (judgement.state[last + 1 :] == TipState.UNKNOWN).all()
    assert judgement.events[-1].reason == "its clock stands still"
    monitor = Monitor()
    events = [event for row in range(len(attitude)) for event in monitor.update(attitude[row : row + 1])]
    assert repr(events) == repr(judgement.events)  # NaN is not NaN
    again = judge(poise.Attitude.of(np.where(time < 3.0, np.minimum(time, 2.0), time), _leaning(0.0 * lean)))
    assert again.state[-1] == TipState.UPRIGHT  # it goes on


@pytest.mark.parametrize("sizes", [(10,), (4, 12, 7), (40,), (1, 10), (1, *[10] * 500)])
def test_packets_that_share_a_stamp_are_judged_as_ever(sizes: tuple[int, ...]) -> None:
    time = times(10.0, 100.0)
    ends = np.cumsum(np.resize(sizes, 1000))
    stamps = time[np.minimum(ends[np.searchsorted(ends, np.arange(1000), side="right")], 1000) - 1]
    standing = judge(poise.Attitude.of(stamps, _leaning(np.zeros(1000)))).events
    assert [event.state for event in standing] == [TipState.UPRIGHT]
    lean = toppling(time, 8.0)
    assert TipState.TIPPING in [event.state for event in judge(poise.Attitude.of(stamps, _leaning(lean))).events]


def test_stamps_that_are_missing_now_and_then_are_no_standstill() -> None:
    time = times(4.0, 100.0)
    time[100:300:3] = nan
    time[250] = -5.0
    assert [e.state for e in judge(poise.Attitude.of(time, _leaning(np.zeros(400)))).events] == [TipState.UPRIGHT]


def _leaning(lean: ArrayLike) -> NDArray[np.float64]:
    """(n, 4) quaternions of a body that leans forward by *lean* rad."""
    half = 0.5 * np.asarray(lean, float)
    return np.column_stack([np.cos(half), -np.sin(half), 0.0 * half, 0.0 * half])


def test_silence_is_unknown_within_50_ms_and_said_once() -> None:
    monitor, attitude = Monitor(), leaning(times(1.0), 1.0)
    assert names(monitor.check(0.0)) == [] and monitor.state is TipState.UNKNOWN  # nothing has come yet
    monitor.update(attitude)
    now = float(attitude.time[-1])
    assert monitor.check(now + 0.049) == [] and monitor.state is TipState.UPRIGHT
    event = monitor.check(now + 0.05)
    assert names(event) == ["UNKNOWN"] and event[0].before is TipState.UPRIGHT and "0.050 s" in event[0].reason
    assert monitor.state is TipState.UNKNOWN and np.isnan(monitor.tilt)
    assert monitor.check(now + 1.0) == []
    late = leaning(attitude.time[-3:] + 1.0, 1.0)
    assert names(monitor.update(late)) == ["UPRIGHT"]
    with pytest.raises(RecordingError, match="now: expected seconds"):
        monitor.check(nan)


# -- batch, stream, simulation ---------------------------------------------------------------------------------------------


def wild_ride() -> tuple[poise.Attitude, Floats]:
    """Everything at once: falls, losses, gaps, disordered stamps, missing forces."""
    time = times(20.0)
    rng = np.random.default_rng(3)
    lean = 60.0 * np.sin(0.9 * time) ** 3 + rng.normal(0.0, 0.3, len(time))
    attitude = leaning(time, lean, "back")
    attitude.flags[rng.integers(0, len(time), 20)] |= np.uint32(Flag.LOST)
    attitude.table[1000:1040, :4] = nan
    attitude.time[2000:] += 0.7
    attitude.time[3000], attitude.time[3100] = nan, attitude.time[3090]
    acc = rng.normal([0.0, 0.0, 9.8], 0.5, (len(time), 3))
    acc[1500:1560], acc[::7] = 0.2, nan
    return attitude, acc


@settings(max_examples=10, deadline=None)
@given(cuts=st.lists(st.integers(1, 3999), max_size=30, unique=True))
def test_batch_and_stream_say_the_same_bits(cuts: list[int]) -> None:
    attitude, acc = wild_ride()
    whole, monitor, events = judge(attitude, acc), Monitor(), []
    edges = [0, *sorted(cuts), len(attitude)]
    for a, b in zip(edges, edges[1:], strict=False):
        events += monitor.update(attitude[a:b], acc[a:b])
        assert monitor.state == whole.state[b - 1]
        assert (
            np.array([monitor.tilt, monitor.time_to_impact]).tobytes()
            == np.array([whole.tilt[b - 1], whole.time_to_impact[b - 1]]).tobytes()
        )
    assert repr(events) == repr(whole.events)
    assert len({event.state for event in events}) >= 6


def test_sample_by_sample_and_as_outputs_in_a_simulation_too() -> None:
    attitude, acc = wild_ride()
    attitude = attitude[:1900]
    whole, by_rows, by_outputs = judge(attitude, acc[:1900]), Monitor(), Monitor()
    rows, outputs, clock = [], [], 0.0
    for i in range(len(attitude)):
        rows += by_rows.update(attitude[i : i + 1], acc[i])
        dt = float(attitude.time[i]) - clock
        quat, rate = Quat(*map(float, attitude.quat[i])), Vec3(*map(float, attitude.rate[i]))
        outputs += by_outputs.update(Output(dt, quat, rate, ZERO, ABSENT, ABSENT, int(attitude.flags[i])), acc[i])
        clock += dt
    assert repr(rows) == repr(whole.events)
    assert [(e.state, e.direction) for e in outputs] == [(e.state, e.direction) for e in whole.events]
    np.testing.assert_allclose([e.time for e in outputs], [e.time for e in whole.events], atol=1e-9)


def test_the_bare_parameters_step_in_plain_python() -> None:
    tip, state = TipOver(), TipOver().start()
    for _ in range(20):
        state = tip.step(state, Output(0.005, Quat(1.0, 0.0, 0.0, 0.0), ZERO, ZERO, ABSENT, ABSENT, 0), ABSENT)
    assert tip.output(state).state == TipState.UPRIGHT


_PLAIN = """
import sys, numpy
sys.path.insert(0, sys.argv[2])
from test_monitor import wild_ride
from poise.monitor import judge
attitude, acc = wild_ride()
found = judge(attitude, acc)
numbers = numpy.column_stack([found.tilt, found.lean, found.rate, found.time_to_impact])
numpy.savez(sys.argv[1], state=found.state, numbers=numbers)
"""


def test_compiled_and_plain_python_agree(tmp_path: Path) -> None:
    out = tmp_path / "plain.npz"
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    here = str(Path(__file__).parent)
    subprocess.run([sys.executable, "-c", _PLAIN, str(out), here], check=True, env=environment, timeout=120)
    plain, (attitude, acc) = np.load(out), wild_ride()
    found = judge(attitude, acc)
    np.testing.assert_array_equal(plain["state"], found.state)
    numbers = np.column_stack([found.tilt, found.lean, found.rate, found.time_to_impact])
    np.testing.assert_allclose(plain["numbers"], numbers, atol=1e-9)


# -- mounting, tare, geometry -------------------------------------------------------------------------------------------------


@for_all(st.sampled_from(["x y z", "y -x z", "-x -y z", "x z -y", "-z y x", "-y -z x"]), ways, st.floats(0.0, 70.0))
def test_a_mounted_sensor_judges_the_robot(words: str, way: str, lean: float) -> None:
    """The sensor's attitude is the robot's, turned by how it is mounted; the judgement is the robot's."""
    robot = leaning(times(0.3), lean, way)
    tip = TipOver(mount=mounted(words))
    w, x, y, z = tip.mount
    quat = poise.math.arrays.multiply(robot.quat, np.array([w, x, y, z]))
    sensor = poise.Attitude.of(robot.time, quat)
    sensor.table[:, 4:7] = poise.math.arrays.rotate(np.array([w, -x, -y, -z]), robot.rate)
    own, seen = judge(robot), judge(sensor, tipover=tip)
    np.testing.assert_array_equal(own.state, seen.state)
    np.testing.assert_allclose(own.directions, seen.directions, atol=1e-9)
    np.testing.assert_allclose(own.rate, seen.rate, atol=1e-9)


@for_all(st.floats(-25.0, 25.0), st.sampled_from(["x y z", "y -x z"]), st.floats(0.0, 60.0), ways)
def test_a_tare_takes_the_sensors_slant_out(slant: float, words: str, lean: float, way: str) -> None:
    half = radians(slant) / 2
    mounting = Quat(np.cos(half), 0.6 * np.sin(half), 0.8 * np.sin(half), 0.0)

    def seen(robot: poise.Attitude) -> poise.Attitude:
        turned = poise.math.arrays.multiply(robot.quat, np.array(mounted(words)))
        return poise.Attitude.of(robot.time, poise.math.arrays.multiply(turned, np.array(mounting)))

    tip = tared(TipOver(mount=mounted(words)), seen(leaning(times(0.2), 0.0)))
    robot = leaning(times(0.3), lean, way)
    found, own = judge(seen(robot), tipover=tip), judge(robot, tipover=TipOver(look_ahead=0.0))
    np.testing.assert_allclose(found.tilt, radians(lean), atol=1e-7)
    assert names(found.events) == names(own.events)


def test_a_tare_needs_a_robot_that_stands() -> None:
    with pytest.raises(RecordingError, match=r"tare: the robot moves by .*°"):
        tared(TipOver(), leaning(times(1.0), np.linspace(0.0, 10.0, 200)))
    with pytest.raises(RecordingError, match="tare: no row"):
        tared(TipOver(), poise.Attitude.of([0.0], [[nan] * 4]))


@for_all(st.floats(0.05, 1.0), st.floats(0.05, 1.0), st.floats(0.05, 2.0), st.floats(-0.9, 0.9), st.floats(-0.9, 0.9))
def test_the_margins_of_a_box_are_its_closed_form(a: float, b: float, h: float, u: float, v: float) -> None:
    """atan(distance to the edge / height), and the support alone decides."""
    corners = [[a, b], [-a, b], [-a, -b], [a, -b], [0.0, 0.0]]
    support = Support(corners, [u * a, v * b, h], margin=0.0)
    right, forward = u * a, v * b
    closed = Directions(atan((b - forward) / h), atan((b + forward) / h), atan((a + right) / h), atan((a - right) / h))
    np.testing.assert_allclose(support.margins(), closed, atol=1e-12)
    tip = TipOver(edges=support.edges(), look_ahead=0.0, hysteresis=0.0, impact=pi)
    for way in AXES:
        edge = float(np.degrees(getattr(closed, way)))
        assert states(leaning(times(0.2), edge - 1e-3, way), tip)[-1] is TipState.UPRIGHT
        assert states(leaning(times(0.2), edge, way), tip)[-1] is TipState.TIPPING


def test_a_three_wheeled_robot_tips_over_its_oblique_edge_first() -> None:
    """One wheel in front: leaning to the front left it falls before it would forward or to the left."""
    support = Support([[-0.2, -0.2], [0.2, -0.2], [0.0, 0.3]], [0.0, 0.0, 0.5], margin=0.0)
    tip = TipOver(edges=support.edges(), look_ahead=0.0, hysteresis=0.0)
    distance = 0.3 * 0.2 / np.hypot(0.2, 0.5)
    limit = np.degrees(atan(distance / 0.5))
    half = radians(limit + 0.1) / 2
    axis = np.array([-0.2, -0.5, 0.0]) / np.hypot(0.2, 0.5)  # outward of that edge is (−0.5, 0.2)
    oblique = poise.Attitude.of(times(0.3), np.tile([np.cos(half), *(np.sin(half) * axis)], (60, 1)))
    assert states(oblique, tip)[-1] is TipState.TIPPING
    assert states(leaning(times(0.3), limit + 0.1, "forward"), tip)[-1] is TipState.UPRIGHT
    assert np.degrees(support.margins().left) > limit


def test_a_payload_moves_the_centre_of_mass() -> None:
    box = [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]]
    loaded = Support(box, [0, 0, 0.3], mass=10.0, payload=5.0, payload_at=[0.0, 0.15, 0.9])
    np.testing.assert_allclose(loaded.centre_of_mass(), [0.0, 0.05, 0.5])
    assert loaded.margins().forward < loaded.margins().back < Support(box, [0, 0, 0.3]).margins().back
    with pytest.raises(MethodError, match=r"Support\.polygon: the centre of mass at \(0, 0\.3\)"):
        Support(box, [0, 0, 0.3], mass=1.0, payload=1.0, payload_at=[0.0, 0.6, 0.3])
    with pytest.raises(MethodError, match=r"Support\.mass"):
        Support(box, [0, 0, 0.3], payload=1.0)


# -- bad parameters -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("bad", "named"),
    [
        ({"dwell": -0.1}, r"TipOver\.dwell"),
        ({"dwell": nan}, r"TipOver\.dwell"),
        ({"samples": 0}, r"TipOver\.samples"),
        ({"samples": 1.5}, r"TipOver\.samples"),
        ({"range": 0.0}, r"TipOver\.range forward.*empty range"),
        ({"range": Directions(0.3, 0.3, -0.1, 0.3)}, r"TipOver\.range left.*empty range"),
        ({"range": nan}, r"TipOver\.range forward"),
        ({"range": 20.0}, r"TipOver\.range forward.*rad"),
        ({"range": (0.1, 0.2)}, r"TipOver\.range.*Directions"),
        ({"range": 0.8}, r"TipOver\.range forward.*self_balancing"),
        ({"self_balancing": "wide"}, r"TipOver\.self_balancing forward"),
        ({"hysteresis": 0.4}, r"TipOver\.hysteresis"),
        ({"impact": 0.5}, r"TipOver\.impact"),
        ({"mount": (1.0, 1.0, 0.0, 0.0)}, r"TipOver\.mount"),
        ({"mount": "y -x z"}, r"TipOver\.mount"),
        ({"edges": "box"}, r"TipOver\.edges"),
        ({"free_fall": 2.0}, r"TipOver\.free_fall"),
        ({"pendulum": -1.0}, r"TipOver\.pendulum"),
        ({"gravity": 0.0}, r"TipOver\.gravity"),
    ],
)
def test_bad_parameters_are_named(bad: dict[str, Any], named: str) -> None:
    with pytest.raises(MethodError, match=named):
        Monitor(TipOver(**bad))


def test_other_bad_input_is_refused() -> None:
    with pytest.raises(MethodError, match="expected TipOver parameters"):
        Monitor(poise.Tilt())  # type: ignore[arg-type]
    with pytest.raises(MethodError, match="silence"):
        Monitor(silence=-1.0)
    with pytest.raises(RecordingError, match="expected an Attitude to judge"):
        judge([1.0])  # type: ignore[arg-type]
    attitude = leaning(times(0.1), 0.0)
    with pytest.raises(RecordingError, match=r"acc: expected \(20, 3\)"):
        judge(attitude, np.zeros((3, 3)))
    monitor = Monitor()
    for wrong in (np.zeros(2), "up", np.zeros((3, 3))):
        with pytest.raises(RecordingError, match="acc: expected"):
            monitor.update(attitude[:1], wrong)
    with pytest.raises(RecordingError, match="Output"):
        monitor.update(3.0)  # type: ignore[arg-type]
    assert monitor.update(attitude[:0]) == [] and judge(attitude[:0]).events == []
    with pytest.raises(RecordingError, match="another body"):
        judge(attitude.relative_to(attitude))


@pytest.mark.parametrize("frame", ["ned", "nwu"])
def test_any_earth_frame_will_do(frame: Any) -> None:
    attitude, acc = wild_ride()
    own, other = judge(attitude, acc), judge(attitude.to(frame), acc)
    np.testing.assert_array_equal(own.state, other.state)
    np.testing.assert_allclose(own.tilt, other.tilt, atol=1e-9)


# -- the file -----------------------------------------------------------------------------------------------------------------


def test_a_table_holds_degrees_and_seconds(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    path.write_text(
        """
        [tipover]
        range = { forward = 15, back = 25 }
        self_balancing = 45
        dwell = 0.1
        samples = 5
        hysteresis = 2
        impact = 85
        still = 10
        mount = "y -x z"
        tare = [2.0, -1.0]
        [[responses]]
        on = "tipping"
        """
    )
    tip = read_settings(path)
    np.testing.assert_allclose(np.degrees(tip.range), [15, 25, 20, 20])
    np.testing.assert_allclose(np.degrees(tip.self_balancing), 45)
    assert (tip.dwell, tip.samples) == (0.1, 5) and tip.still == pytest.approx(radians(10))
    seen = poise.Attitude.of(
        times(0.1), poise.math.arrays.multiply(_standing(2.0, -1.0), np.array(mounted("y -x z")))[None].repeat(20, 0)
    )
    np.testing.assert_allclose(judge(seen, tipover=tip).tilt, 0.0, atol=1e-9)


def _standing(forward: float, right: float) -> Floats:
    """An attitude with these leans across the forward and the right edge."""
    up = np.array([-np.tan(radians(right)), -np.tan(radians(forward)), 1.0])
    axis = np.cross(up / np.linalg.norm(up), [0.0, 0.0, 1.0])
    half = np.arcsin(np.linalg.norm(axis)) / 2
    return np.array([np.cos(half), *(np.sin(half) * axis / np.linalg.norm(axis))])


def test_a_support_in_a_table() -> None:
    box = {"polygon": [[-0.2, -0.3], [0.2, -0.3], [0.2, 0.3], [-0.2, 0.3]], "centre": [0, 0, 0.4], "margin": 4}
    tip = from_table({"support": box})
    assert [round(float(np.degrees(side.limit)), 2) for side in tip.edges[:4]] == [26.57, 26.57, 36.87, 36.87]
    assert all(side.limit - side.range == pytest.approx(radians(4.0)) for side in tip.edges[:4])
    assert tip.pendulum == pytest.approx(4 / 3 * np.hypot(0.4, 0.2))


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"dwel": 1}, "dwel: no parameter of the monitor"),
        ({"dwell": "long"}, "dwell: expected a number"),
        ({"range": {"ahead": 3}}, r"range\.ahead"),
        ({"range": True}, "range: expected a number"),
        ({"mount": "x y"}, "axes 'x y'"),
        ({"mount": 3}, "mount"),
        ({"tare": 3}, "tare: expected two angles"),
        ({"tare": [90, 0]}, "tare"),
        ({"support": {"polygon": [[0, 0], [1, 0], [1, 1]]}}, "support: expected a table with polygon and centre"),
        ({"support": {"polygon": [[0, 0], [1, 0]], "centre": [0, 0, 1]}}, r"Support\.polygon"),
        ({"support": {"polygon": [[0, 0], [1, 0], [0, 1]], "centre": [2, 2, 1]}}, r"Support\.polygon"),
        ({"support": {"polygon": [[0, 0], [1, 0], [0, 1]], "centre": [0.2, 0.2, -1]}}, r"Support\.centre"),
        ({"support": {"polygon": [[0, 0], [1, 0], [0, 1]], "centre": [0.2, 0.2, 1], "margin": 60}}, r"Support\.margin"),
        ({"support": {"polygon": [[0, 0], [1, 0], [0, 1]], "centre": [0.2, 0.2, 1], "width": 6}}, r"support\.width"),
        ({"range": 10, "support": {"polygon": [[-1, -1], [1, -1], [0, 1]], "centre": [0, 0, 1]}}, "support decides"),
    ],
)
def test_a_bad_table_is_refused(table: dict[str, Any], said: str) -> None:
    with pytest.raises(poise.PoiseError, match=said):
        from_table(table)


def test_a_bad_file_is_refused_by_name(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    for text, said in (
        ("[tipover", "no TOML file"),
        ("a = 1", r"no table \[tipover\]"),
        ("[tipover]\nrange = 0", r"\[tipover\]: .*empty"),
    ):
        path.write_text(text)
        with pytest.raises(poise.PoiseError, match=rf"robot\.toml: .*{said}|robot\.toml: {said}"):
            read_settings(path)
    with pytest.raises(poise.PoiseError, match="cannot be read"):
        read_settings(tmp_path / "absent.toml")
