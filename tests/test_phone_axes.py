"""Which way a browser's sensors point, pinned by its own orientation: against scipy's rotations."""

from __future__ import annotations

from itertools import permutations, product
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from poise.live import frames
from poise.live.batch import Newest
from poise.live.devices import DeviceError
from poise.live.hub import Hub
from poise.live.methods import Choice
from poise.live.motion import Motion, asked
from poise.live.pinning import Axes, Pinning, up

RATE = 60.0
ORDERS = [np.eye(3)[list(o)] * np.array(s) for o in permutations(range(3)) for s in product((1.0, -1.0), repeat=3)]
UNITS = {"deg": np.radians(1.0), "rad": 1.0}


def motion(
    seed: int, swing: tuple[float, float, float] = (1.0, 1.0, 1.0), seconds: float = 12.0, off: float = 0.0
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Times, rates (rad/s), specific force of a phone in a hand, and its browser's orientation, *off* degrees wrong."""
    rng = np.random.default_rng(seed)
    time = np.arange(0.0, seconds, 1.0 / RATE)
    waves = [rng.normal(size=3) * np.sin(2 * np.pi * f * time + rng.uniform(0, 6))[:, None] for f in (0.2, 0.5, 0.9)]
    rates = np.asarray(swing) * sum(waves)
    turned = [Rotation.from_euler("z", rng.uniform(0.0, 6.0)) * Rotation.from_rotvec(0.3 * rng.normal(size=3))]
    for rate in rates[:-1]:
        turned.append(turned[-1] * Rotation.from_rotvec(rate / RATE))
    attitude = Rotation.concatenate(turned)
    shaken = 0.5 * rng.normal(size=3) * np.sin(2 * np.pi * 1.3 * time)[:, None]
    force = attitude.inv().apply(shaken + np.array([0.0, 0.0, 9.81])) + 0.1 * rng.normal(size=rates.shape)
    noisy = rates + 0.01 * rng.normal(size=3) + 0.005 * rng.normal(size=rates.shape)
    opinion = Rotation.from_euler("zx", [100.0, off], degrees=True) * attitude
    return time, noisy, force, np.round(opinion.as_euler("ZXY", degrees=True), 2)


def as_browser(
    moved: tuple[NDArray[np.float64], ...], acc: NDArray[np.float64], rates: NDArray[np.float64], unit: str
) -> NDArray[np.float64]:
    """(n, 10) what a browser with these signed orders gives of it: its numbers times the order are the body's."""
    time, rate, force, angles = moved
    return np.column_stack([time, rate @ rates / UNITS[unit], force @ acc, angles])


def pinned(raw: NDArray[np.float64]) -> Axes | None:
    pinning = Pinning()
    for at in range(0, len(raw), 3):
        if pinning.add(raw[at : at + 3], raw[at, 0]) is not None:
            break
    return pinning.axes


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.integers(0, 47), st.integers(0, 47), st.sampled_from(["deg", "rad"]))
def test_any_sign_order_and_unit_is_found_from_motion_to_all_sides(seed: int, acc: int, rates: int, unit: str) -> None:
    found = pinned(as_browser(motion(seed), ORDERS[acc], ORDERS[rates], unit))
    assert found is not None
    np.testing.assert_array_equal(found.acc, ORDERS[acc])
    np.testing.assert_array_equal(found.rates, ORDERS[rates])
    assert found.unit == unit


@settings(max_examples=40, deadline=None)
@given(
    st.integers(0, 10_000),
    st.tuples(*[st.sampled_from([0.0, 0.02, 0.3, 2.0])] * 3),
    st.integers(0, 47),
    st.integers(0, 47),
    st.sampled_from(["deg", "rad"]),
    st.sampled_from([0.0, 8.0]),
)
def test_what_is_not_told_by_the_motion_is_not_believed(
    seed: int, swing: Any, acc: int, rates: int, unit: str, off: float
) -> None:
    found = pinned(as_browser(motion(seed, swing, 8.0, off), ORDERS[acc], ORDERS[rates], unit))
    if found is not None:
        np.testing.assert_array_equal(found.acc, ORDERS[acc])
        np.testing.assert_array_equal(found.rates, ORDERS[rates])
        assert found.unit == unit


@pytest.mark.parametrize("swing", [(0, 0, 0), (2, 0, 0), (0, 0, 2)])
def test_rest_and_turns_about_one_axis_say_too_little(swing: tuple[float, float, float]) -> None:
    assert pinned(as_browser(motion(3, swing, 30.0), ORDERS[0], ORDERS[5], "deg")) is None


@given(st.lists(st.floats(-180.0, 180.0), min_size=3, max_size=3))
def test_up_is_that_of_the_standards_angles(angles: list[float]) -> None:
    expected = Rotation.from_euler("ZXY", angles, degrees=True).inv().apply([0.0, 0.0, 1.0])
    np.testing.assert_allclose(up(np.array([angles]))[0], expected, atol=1e-12)


def test_the_hints_say_what_is_missing() -> None:
    raw = as_browser(motion(0), ORDERS[0], ORDERS[0], "deg")
    for columns, text in (((1, 2, 3), "no rotation rate"), ((7, 8, 9), "no orientation")):
        broken = raw.copy()
        broken[:, list(columns)] = np.nan
        pinning = Pinning()
        assert pinning.add(broken, 0.0) is None
        assert text in pinning.reason
    in_g = raw.copy()
    in_g[:, 4:7] /= 9.81
    pinning = Pinning()
    assert pinning.add(in_g, 0.0) is None
    assert "length of 1.0" in pinning.reason
    pinning = Pinning()
    assert pinning.add(as_browser(motion(0, (2, 0, 0)), ORDERS[0], ORDERS[0], "deg"), 0.0) is None
    assert pinning.reason == "tip the phone to the left and right"


def test_axes_are_told_and_read_as_text() -> None:
    for acc, rates, unit in zip(ORDERS, reversed(ORDERS), ["deg", "rad"] * 24, strict=True):
        axes = Axes(rates, acc, unit)
        again = Axes.parse(str(axes))
        assert str(again) == str(axes)
        np.testing.assert_array_equal(again.rates, rates)
    assert str(Axes(ORDERS[0], -ORDERS[0], "deg")) == "-x-y-z,+a+b+g,deg"
    for wrong in ("", "x", "+x+x+z,+a+b+g,deg", "+x+y+z,+a+b+g,turns", "+x+y+z+x,+a+b+g,deg", "+a+b+g,+x+y+z,deg"):
        with pytest.raises(ValueError, match="expected a text like"):
            Axes.parse(wrong)


def test_a_devices_query_names_its_shape_and_axes() -> None:
    assert asked(b"") == (None, None)
    shape, axes = asked(b"shape=phone&axes=-x-y-z%2C%2Bb%2Bg%2Ba%2Cdeg")
    assert (shape, str(axes)) == ("phone", "-x-y-z,+b+g+a,deg")
    with pytest.raises(DeviceError, match="shape 'cube': expected one of board"):
        asked(b"shape=cube")
    with pytest.raises(DeviceError, match="shape 'joint'"):  # which is no device
        asked(b"shape=joint")
    with pytest.raises(DeviceError, match="axes 'up'"):
        asked(b"axes=up")


def framed(raw: NDArray[np.float64], first: int) -> bytes:
    return frames.HEADER.pack(frames.VERSION, frames.MOTION, 80, len(raw), first) + raw.astype("<f8").tobytes()


def test_samples_wait_until_the_axes_are_known_and_then_none_is_lost() -> None:
    moved = motion(1)
    raw = as_browser(moved, -np.eye(3), ORDERS[11], "deg")
    events: list[str] = []
    hub = Hub((Choice.of("adaptive-gain"),))
    device = hub.device("hand")
    first = Motion(device, None, lambda kind, text: events.append(kind))
    assert first.take(framed(raw[:20], 0), 0.0) == 20
    assert first.take(framed(raw[10:30], 10), 0.0) == 10  # sent twice
    assert device.next == 0
    answers = list(first.answers(Newest()))
    assert answers[0]["axes"] is None
    assert answers[0]["reason"]
    again = Motion(device, None, lambda kind, text: events.append(kind))  # it had to connect anew: from `next`, 0
    for at in range(0, len(raw), 4):
        again.take(framed(raw[at : at + 4], at), 0.0)
    assert again.axes is not None
    assert events == ["axes"]
    assert (device.next, device.health.lost, device.health.repeated) == (len(raw), 0, 0)
    rows = device.take().rows
    np.testing.assert_allclose(rows[:, 1:4], moved[1], atol=1e-12)
    np.testing.assert_array_equal(rows[:, 4:7], moved[2])
    third = Motion(device, again.axes, lambda kind, text: events.append(kind))  # told the axes, it need not wait
    assert third.take(framed(raw[:5], len(raw)), 0.0) == 5
    assert device.next == len(raw) + 5


def test_of_samples_that_wait_the_last_half_minute_is_kept() -> None:
    still = as_browser(motion(2, (0, 0, 0), 60.0), np.eye(3), np.eye(3), "deg")
    turned = as_browser(motion(2), np.eye(3), np.eye(3), "deg")
    turned[:, 0] += 60.0
    device = Hub((Choice.of("adaptive-gain"),)).device("table")
    waiting = Motion(device, None, lambda kind, text: None)
    raw = np.concatenate([still, turned])
    for at in range(0, len(raw), 6):
        waiting.take(framed(raw[at : at + 6], at), raw[at, 0])
    rows = device.take().rows
    assert rows[-1, 0] == raw[-1, 0]
    assert 25.0 < raw[3600, 0] - rows[0, 0] <= 30.0
    assert device.health.lost == 0  # an attitude needs no earlier beginning


def test_stamps_that_stand_still_do_not_fill_the_memory() -> None:
    raw = np.zeros((4096, 10))
    waiting = Motion(Hub((Choice.of("adaptive-gain"),)).device("stuck"), None, lambda kind, text: None)
    for number in range(12):
        waiting.take(framed(raw, 4096 * number), 0.0)
    assert sum(len(part) for _, part in waiting._held) <= 20_000
