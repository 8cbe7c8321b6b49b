"""Short closed loops in physics: the estimate decides, the truth judges, the relay really moves."""

from __future__ import annotations

import wave
from importlib.util import find_spec
from math import degrees, radians
from pathlib import Path

import numpy as np
import pytest

from poise.cli import run
from poise.control.balance import BalanceControl, Balancer
from poise.data.attitude import Attitude
from poise.data.flags import Flag
from poise.doctor.affine import magnetometer
from poise.errors import MethodError, RecordingError
from poise.loops import Push, balancing, slewing
from poise.loops.commissioning import commissioned
from poise.loops.driving import driven
from poise.loops.slewing import CONTROL, SENSOR
from poise.simulation.worlds import AttitudeBody
from programs import program

# not importorskip: importing MuJoCo here would be too early for the choice of a renderer
pytestmark = pytest.mark.skipif(not (find_spec("mujoco") and find_spec("gpiozero")), reason="needs poise[sim,respond]")


@pytest.fixture(autouse=True)
def _mock_pins(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GPIOZERO_PIN_FACTORY", "mock")


def test_the_robot_balances_drives_and_takes_a_push() -> None:
    done = balancing("two-stage", seed=1, duration=12.0, pushes=(Push(10.0, (0.0, 3.0, 0.0)),))
    assert not done.fell and not done.triggered and done.cut is None
    assert degrees(np.abs(done["lean"]).max()) < 12.0
    driving = (done["time"] > 6.5) & (done["time"] < 8.0)
    assert abs(done["speed"][driving].mean() - 0.3) < 0.08


def test_pushed_too_hard_its_motors_are_cut_well_before_the_impact() -> None:
    done = balancing("two-stage", seed=2, duration=8.0, pushes=(Push(4.0, (0.0, 32.0, 0.0)),))
    assert done.fell and done.cut is not None
    assert done.cut.event.direction and done.cut.event.time <= done.cut.edge
    assert 0.1 < done.lead < 1.0  # 150 ms is the benchmark's, over many; a clock of this machine is in it
    assert abs(done["left"][-1]) < 1e-3 and np.abs(done["time"][-1] - done.impact) < 1.0


def test_the_same_seed_gives_the_same_run() -> None:
    a, b = (balancing("two-stage", seed=3, duration=3.0, cuts=False).table for _ in range(2))
    assert a.tobytes() == b.tobytes()


def test_a_commissioned_body_settles_by_an_estimate_as_by_the_truth() -> None:
    by_truth, by_estimate = (slewing(method, seed=204, turns=1).turns[0] for method in ("truth", "self-calibrating"))
    assert by_truth.settling < 3.5 and by_truth.final < radians(0.2)
    assert by_estimate.settling < 1.2 * by_truth.settling and by_estimate.final < radians(2.0)


def test_a_tumble_finds_the_iron_and_a_sensor_that_rests_is_told_to_turn() -> None:
    world = AttitudeBody(seed=205, sensor=SENSOR, rate=200.0, hold=3.0)
    found = commissioned(world, CONTROL)
    real = world.devices["imu"]._mag
    assert real is not None
    iron = np.eye(3) + real._cross.T
    assert np.abs(found.mag.offset - found.mag.matrix @ real.bias).max() < 0.15  # µT, of 1
    product = found.mag.matrix @ iron
    assert np.abs(product / np.cbrt(np.linalg.det(product)) - np.eye(3)).max() < 5e-3
    still = world.recording()[:500]
    with pytest.raises(RecordingError, match="magnetometer: "):
        magnetometer(still)


def test_without_a_valid_attitude_the_wheels_have_no_torque() -> None:
    balancer = Balancer(BalanceControl.design(1.5, 0.12, 0.05))
    for i, flag in enumerate((0, int(Flag.LOST), 0)):
        row = Attitude.of([0.005 * i], [[np.cos(0.05), -np.sin(0.05), 0.0, 0.0]])
        row.rate[:], row.flags[:] = 0.0, flag
        torques = balancer.update(row, (0.0, 0.0))
        assert (torques == (0.0, 0.0)) == bool(flag) and (flag or min(torques) > 0.0)


def test_a_wheel_that_spins_in_the_air_is_not_taken_for_a_speed() -> None:
    """An airborne wheel at 600 rad/s² for 60 ms; then the robot drives off on both, turning."""
    balancer, wheels = Balancer(BalanceControl.design(1.5, 0.12, 0.05, torque_limit=0.45)), np.zeros(2)
    speeds, torques = [], []

    def advance(left: float, right: float, yaw: float = 0.0) -> None:
        wheels[:] += 0.005 * np.array([left, right])
        row = Attitude.of([0.005 * len(speeds)], [[1.0, 0.0, 0.0, 0.0]])
        row.rate[:] = 0.0, 0.0, yaw
        torques.append(balancer.update(row, wheels))
        assert balancer.state is not None
        speeds.append(balancer.state.speed)

    for i in range(12):
        advance(0.0, 600.0 * 0.005 * (i + 1))
    assert max(speeds) < 0.1 and torques[-1][1] < -0.05, "it is braked"
    assert abs(torques[-1][0]) < 0.1, "and the other does not follow it"
    for _ in range(60):
        advance(6.0 - 2.0, 6.0 + 2.0, yaw=2.0 * 0.05 / 0.1)
    assert speeds[-1] == pytest.approx(0.3, abs=0.01)


def test_over_bumps_it_goes_on_and_nothing_is_triggered() -> None:
    done = driven("two-stage", 104, 20.0)
    assert not done.fell and not done.triggered
    assert degrees(np.abs(done["lean"]).max()) < 10.0


def test_a_short_loss_is_bridged_by_the_rate_and_a_long_one_is_not() -> None:
    balancer, doing = Balancer(BalanceControl.design(1.5, 0.12, 0.05, bridge=0.5)), []
    for i in range(300):
        row = Attitude.of([0.005 * i], [[np.cos(0.05), -np.sin(0.05), 0.0, 0.0]])
        row.rate[:], row.flags[:] = (-0.1, 0.0, 0.0), int(Flag.UNSETTLED) if i >= 100 else 0
        doing.append(balancer.update(row, (0.0, 0.0)) != (0.0, 0.0))
        if i == 199:
            assert balancer.state is not None
            assert balancer.state.lean == pytest.approx(0.1 + 0.1 * 0.5, abs=2e-3)
    assert all(doing[:200]) and not any(doing[202:])


@pytest.mark.parametrize("field", ["body_mass", "height", "wheel_radius"])
def test_a_bad_robot_is_named(field: str) -> None:
    given = {"body_mass": 1.5, "height": 0.12, "wheel_radius": 0.05, field: -1.0}
    with pytest.raises(MethodError, match=field):
        BalanceControl.design(**given)


def test_the_command_tells_the_fall_and_draws_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    picture = tmp_path / "fall.svg"
    code = run(["balance", "--push", "32", "--every", "4", "--duration", "8", "-o", str(picture)])
    said = capsys.readouterr()
    if "OpenGL" in said.err:
        pytest.skip("no OpenGL without a screen here")
    assert code == 0 and picture.stat().st_size > 10_000
    assert "relay: motors cut" in said.out and "after the edge" in said.out


def test_the_command_speaks_the_alarm_into_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    program("espeak-ng")
    path = tmp_path / "alarm.wav"
    assert run(["balance", "--push", "32", "--every", "4", "--duration", "8", "--say", str(path)]) == 0, (
        capsys.readouterr()
    )
    assert "relay: motors cut" in capsys.readouterr().out
    with wave.open(str(path)) as file:
        sound = np.frombuffer(file.readframes(file.getnframes()), np.int16)
        assert file.getnframes() > 0.3 * file.getframerate() and np.abs(sound.astype(int)).max() > 1000
    assert run(["balance", "--duration", "2", "--say", str(tmp_path / "nowhere" / "alarm.wav")]) == 1
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert [each.name for each in tmp_path.iterdir()] == ["alarm.wav"]


def test_the_command_names_what_it_cannot_do(capsys: pytest.CaptureFixture[str]) -> None:
    for wrong in (
        ["--duration", "-1"],
        ["--method", "hope"],
        ["--sensor", "none"],
        ["--seed", "-1"],
        ["-o", "run.txt"],
        ["--say", "alarm.mp3"],
    ):
        assert run(["balance", *wrong]) == 2
        said = capsys.readouterr().err
        assert len(said.splitlines()) == 1 and wrong[1] in said
    assert run(["balance", "--push", "1e9"]) == 2
    assert "--push: expected 0 or more, below 100000, found 1e+09" in capsys.readouterr().err
