"""Worlds obey physics, their sensors say what happens in them, and a seed settles everything."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import find_spec
from math import isnan, radians
from time import monotonic
from typing import Any

import numpy as np
import pytest

if find_spec("mujoco") is None:
    pytest.skip("worlds need MuJoCo", allow_module_level=True)

from poise import SelfCalibrating, estimate, evaluate
from poise.errors import PoiseError
from poise.math import arrays
from poise.simulation import PERFECT, worlds
from poise.simulation.worlds.world import GRAVITY

FIELD = np.array([0.0, 19.7, -43.1])


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
        (lambda: worlds.make("balance", seed=-1), "seed: expected a whole number"),
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


# -- the other worlds -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", [*worlds.WORLDS])
def test_a_perfect_sensor_says_what_physics_is_about(name: str) -> None:
    world = worlds.run(worlds.make(name, seed=2, sensor=PERFECT), 6.0)
    for sensor in world.sensors:
        recording = world.recording(sensor)
        truth = recording.truth
        assert truth is not None
        turned = arrays.multiply(arrays.conjugate(truth.quat[:-1]), truth.quat[1:])
        np.testing.assert_allclose(arrays.rotation_vector(turned) * world.rate, recording.gyr[1:], atol=0.05)
        np.testing.assert_allclose(recording.mag, arrays.rotate(arrays.conjugate(truth.quat), FIELD), atol=1e-6)
        upward = arrays.rotate(truth.quat, recording.acc)
        assert upward[:, 2].mean() == pytest.approx(GRAVITY, abs=0.3), "on the whole it neither rises nor falls"
        assert np.abs(recording.acc).max() < 60.0
        assert np.degrees(np.abs(truth.rate)).max() > 10.0, "it moved"


def test_in_free_fall_the_accelerometer_reads_nothing() -> None:
    world = worlds.Handle(sensor=PERFECT)
    world.physics.hold("grip", False)
    worlds.run(world, 0.3, lambda _: (0.0, 0.3, 0.93, 1.0, 0.0, 0.0, 0.0))
    assert np.abs(world.recording().acc[2:]).max() < 1e-6
    assert world.truth.state["position"][2] == pytest.approx(0.93 - 0.5 * GRAVITY * 0.3**2, abs=0.01)


def test_a_torque_turns_the_body_as_its_inertia_says_and_the_wheel_takes_up_the_momentum() -> None:
    world = worlds.AttitudeBody(sensor=PERFECT, hold=0.0, motor_lag=0.0, imbalance=0.0)
    worlds.run(world, 0.5, lambda _: (0.0, 0.0, 0.02))
    rate = world.truth.rate[2]
    assert rate == pytest.approx(0.02 * 0.5 / 0.0328, rel=0.05)
    spin = world.truth.state["wheels"][2]
    assert 2e-4 * spin + (0.0328 + 2e-4) * rate == pytest.approx(0.0, abs=5e-4)
    up = arrays.rotate(world.truth.quat, world.recording().acc[-1])
    assert up[2] == pytest.approx(GRAVITY, abs=0.01), "held at its centre of mass, it still feels gravity"


def test_a_wheel_at_its_speed_has_no_torque_left() -> None:
    world = worlds.AttitudeBody(sensor=PERFECT, hold=0.0, wheel_speed=50.0)
    worlds.run(world, 4.0, lambda _: (0.0, 0.06, 0.0))
    assert abs(world.truth.state["wheels"][1]) < 55.0
    assert abs(world.truth.state["torques"][1]) < 0.01


def test_the_arms_sensors_are_joined_by_the_elbow() -> None:
    world = worlds.run(worlds.Arm(seed=3, sensor=PERFECT), 8.0)
    lower, upper = world.recording("forearm").truth, world.recording("upper_arm").truth
    assert lower is not None
    assert upper is not None
    between = arrays.rotate(arrays.multiply(arrays.conjugate(upper.quat), lower.quat), np.array([0.0, 1.0, 0.0]))
    assert np.abs(between[:, 0]).max() < 1e-6, "an elbow bends about one axis"
    flexion = np.degrees(np.arctan2(between[:, 2], between[:, 1]))
    assert flexion.max() - flexion.min() > 20.0
    assert np.degrees(world.truth.state["joints"][3]) == pytest.approx(flexion[-1], abs=2.0)


BOUNDS = {"balance": 4.0, "attitude": 4.0, "arm": 5.0, "handle": 4.0}  # °: the iron of a drawn magnetometer is in it


@pytest.mark.parametrize("name", [*worlds.WORLDS])
def test_an_estimate_finds_the_attitude_in_every_world(name: str) -> None:
    recording = worlds.run(worlds.make(name, seed=21, sensor="ICM-42688-P+MMC5983MA"), 15.0).recording()
    rmse = evaluate(estimate(SelfCalibrating(), recording), recording).rmse_deg()
    assert rmse.inclination < 1.0
    assert rmse.total < BOUNDS[name]


def test_a_world_is_seen_without_a_screen() -> None:
    world = worlds.Balance()
    picture = world.render(160, 120)
    assert picture.shape == (120, 160, 3)
    worlds.run(world, 1.6, lambda _: (0.3, 0.3))
    assert np.abs(world.render(160, 120).astype(int) - picture).max() > 30, "it has moved"
    assert picture.std() > 10.0


@pytest.mark.parametrize(
    ("setting", "first", "says"),
    [("", "import mujoco", "set MUJOCO_GL=osmesa"), ("wrong", "", "MUJOCO_GL can be osmesa")],
)
def test_a_renderer_that_cannot_be_is_said(setting: str, first: str, says: str) -> None:
    """A program may have imported mujoco before, which chooses how to draw when it is imported."""
    if not sys.platform.startswith("linux"):
        pytest.skip("elsewhere there is a screen")
    code = f"""{first}
from poise.errors import PoiseError
from poise.simulation.worlds import Balance
try:
    Balance().render(64, 64)
except PoiseError as error:
    print(error)"""
    screenless = {name: text for name, text in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, env=screenless | {"MUJOCO_GL": setting}, capture_output=True, text=True, check=True)
    assert says in done.stdout and not done.stderr


def test_a_live_stream_keeps_time() -> None:
    began = monotonic()
    count = len(list(worlds.stream(worlds.Balance(), speed=2.0, duration=0.4)))
    assert monotonic() - began > 0.19
    assert count == pytest.approx(80, abs=2)
