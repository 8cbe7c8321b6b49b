"""Worlds obey physics, their sensors say what happens in them, and a seed settles everything."""

from __future__ import annotations

from math import isnan, radians
from typing import Any

import numpy as np
import pytest

pytest.importorskip("mujoco")

from poise.errors import PoiseError
from poise.math import arrays
from poise.simulation import PERFECT, worlds

FIELD, GRAVITY = np.array([0.0, 19.7, -43.1]), 9.8124


def fallen(**options: Any) -> worlds.Balance:
    """A robot that nobody balances, 3 s after it was let go."""
    world = worlds.Balance(sensor=PERFECT, hold=0.2, **options)
    return worlds.run(world, 3.2, lambda _: (0.0, 0.0))  # type: ignore[return-value]


def test_on_its_stand_a_perfect_sensor_says_gravity_up_no_rate_and_the_field() -> None:
    world = worlds.Balance(sensor=PERFECT, lean=10.0, heading=30.0, hold=5.0)
    worlds.run(world, 0.5, lambda _: (0.0, 0.0))
    recording = world.recording()
    assert np.abs(recording.gyr).max() < 2e-3
    up = arrays.rotate(arrays.conjugate(world.truth.quat), np.array([0.0, 0.0, GRAVITY]))
    np.testing.assert_allclose(recording.acc[-20:].mean(axis=0), up, atol=0.02)
    np.testing.assert_allclose(recording.mag[-1], arrays.rotate(arrays.conjugate(world.truth.quat), FIELD), atol=0.05)
    assert world.truth.state["lean"] == pytest.approx(radians(10.0), abs=2e-3)
    assert recording.acc[-1, 1] < 0 < recording.acc[-1, 2], "leaning forward, gravity's reaction points back"


def test_the_gyroscope_integrates_to_the_true_attitude() -> None:
    world = worlds.run(worlds.Balance(seed=2, sensor=PERFECT), 8.0)
    truth = world.recording().truth
    assert truth is not None
    turn = truth.quat[0]
    for rate in world.recording().gyr[1:]:
        angle = float(np.linalg.norm(rate)) / world.rate
        half = 0.5 * rate / world.rate * (np.sinc(angle / 2 / np.pi))
        turn = arrays.multiply(turn, np.concatenate([[np.cos(angle / 2)], half]))
    error = arrays.angle(arrays.multiply(arrays.conjugate(turn), truth.quat[-1]))
    turned = arrays.angle(arrays.multiply(arrays.conjugate(truth.quat[:1]), truth.quat))
    assert float(error) < radians(0.2)
    assert turned.max() > radians(20.0)


def test_unbalanced_it_falls_and_the_impact_is_the_bodys_contact_with_the_ground() -> None:
    world = fallen(lean=2.0)
    assert 0.5 < world.impact < 2.5
    assert world.truth.impact == world.impact
    recording = world.recording()
    before = recording.between(world.impact - 0.05, world.impact - 0.01)
    assert np.linalg.norm(recording.between(world.impact, world.impact + 0.05).acc, axis=1).max() > 30.0
    assert np.linalg.norm(before.acc, axis=1).max() < 15.0
    assert abs(world.truth.state["lean"]) > radians(60.0)


def test_its_own_driver_balances_and_takes_a_push() -> None:
    world = worlds.Balance(seed=3, bumps=0.004, vibration=1.0)
    worlds.run(world, 2.0)
    world.push((0.0, 3.0, 0.0), 0.1)
    drive = world.driver()
    speeds = []
    for _ in range(200):
        world.step(drive(world))
        speeds.append(world.truth.state["speed"])
    assert max(speeds) > 0.05, "the push moved it"
    worlds.run(world, 10.0, drive)
    assert isnan(world.impact)
    assert abs(world.truth.state["lean"]) < radians(10.0)


def test_without_power_motors_do_nothing() -> None:
    world = worlds.Balance(sensor=PERFECT, hold=0.2)
    drive = world.driver()
    worlds.run(world, 1.0, drive)
    world.push((0.0, 1.0, 0.0), 0.1)
    world.powered = False
    worlds.run(world, 3.0, drive)
    assert not isnan(world.impact)
    np.testing.assert_allclose(world.truth.state["torques"], 0.0, atol=1e-12)


def test_a_seed_settles_everything() -> None:
    def made(seed: int) -> Any:
        return worlds.run(worlds.Balance(seed=seed, bumps=0.003, vibration=1.0), 3.0).recording()

    first, again, other = made(5), made(5), made(6)
    for name in ("time", "gyr", "acc", "mag"):
        np.testing.assert_array_equal(getattr(first, name), getattr(again, name))
    np.testing.assert_array_equal(first.truth.table, again.truth.table)
    assert not np.array_equal(first.gyr[0], other.gyr[0])


def test_a_stream_is_the_same_device_packet_by_packet() -> None:
    packets = list(worlds.stream(worlds.make("balance", seed=4), duration=1.5))
    recording = worlds.run(worlds.make("balance", seed=4), 1.5).recording()
    np.testing.assert_array_equal([packet.time for packet in packets], recording.time)
    np.testing.assert_array_equal([packet.acc for packet in packets], recording.acc)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: worlds.make("moon"), "no world 'moon'; there are balance"),
        (lambda: worlds.make("balance", wheels=3), "no option 'wheels'; there are hold"),
        (lambda: worlds.make("balance", bumps=1.0), "bumps: expected 0 to 0.02 m"),
        (lambda: worlds.make("balance", sensor="MPU-9999"), "expected one of MPU-6050"),
        (lambda: worlds.make("balance", rate=1.0), "rate: expected 10 to 4000"),
        (lambda: worlds.make("balance").step([1.0]), r"expected a command of 2 numbers \(left wheel, N m"),
        (lambda: worlds.make("balance").step([1.0, float("nan")]), "expected a command"),
        (lambda: worlds.make("balance").push((1.0, 2.0), 0.1), "expected a force"),
        (lambda: worlds.make("balance").push((1.0, 2.0, 0.0), -0.1), "expected a duration"),
        (lambda: worlds.make("balance").recording("wheel"), "no sensor 'wheel'"),
    ],
)
def test_what_cannot_be_is_refused_with_what_can(make: Any, says: str) -> None:
    with pytest.raises(PoiseError, match=says):
        make()
