"""``poise simulate``: worlds as files that the other commands take, and refusals that say what there is."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

import poise
from poise.cli import run

if find_spec("mujoco") is None:
    pytest.skip("worlds need MuJoCo", allow_module_level=True)


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("ending", ["parquet", "csv", "npz"])
def test_a_world_becomes_a_file_with_its_reference(ending: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", "balance", "-o", f"robot.{ending}", "--duration", "4", "--set", "bumps=0.004"]) == 0
    told = capsys.readouterr()
    assert f"robot.{ending}: 79" in told.out
    assert "by the truth" in told.err
    recording = poise.read(f"robot.{ending}")
    assert recording.truth is not None
    assert recording.rate_hz == pytest.approx(200.0, rel=0.02)
    assert run(["evaluate", f"robot.{ending}", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["mean_rmse_deg"]["total"] < 5.0


def test_the_same_seed_is_the_same_file_and_the_arm_has_two_sensors() -> None:
    for name, more in (("a", ()), ("b", ()), ("c", ("--at", "upper_arm")), ("d", ("--seed", "5"))):
        assert run(["simulate", "arm", "-o", f"{name}.csv", "--duration", "2", *more]) == 0
    first, again, upper, other = (Path(f"{name}.csv").read_bytes() for name in "abcd")
    assert first == again
    assert first != upper
    assert first != other


def test_it_runs_at_the_rate_and_with_the_sensor_asked_for() -> None:
    asked = ["--sensor", "ICM-42688-P", "--rate", "500", "--duration", "2"]
    assert run(["simulate", "handle", "-o", "h.npz", *asked]) == 0
    recording = poise.read("h.npz")
    assert recording.rate_hz == pytest.approx(500.0, rel=0.03)
    assert not np.isfinite(recording.mag).any()


def test_pictures_stand_still_or_move() -> None:
    from PIL import Image

    assert run(["simulate", "arm", "-o", "r.csv", "--duration", "2", "--set", "rest=0.2", "--picture", "r.gif"]) == 0
    assert run(["simulate", "arm", "-o", "s.csv", "--duration", "0.5", "--picture", "s.png"]) == 0
    with Image.open("r.gif") as moving, Image.open("s.png") as still:
        assert moving.n_frames >= 8
        assert still.size == (640, 480)
        assert np.asarray(still.convert("L")).std() > 10


def test_the_list_names_worlds_options_and_sources(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", "--list"]) == 0
    told = capsys.readouterr().out
    for word in ("balance", "upper_arm", "bumps", "vibration", "MPU-6050", "PS-MPU-6000A-00", "+QMC5883L", "N m"):
        assert word in told
    assert run(["simulate", "--list", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert [world["name"] for world in document["worlds"]] == ["balance", "attitude", "arm", "handle"]


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        ([], 2, "which world"),
        (["moon"], 2, "no world 'moon'; there are balance"),
        (["balance", "--set", "wheels=3"], 2, "NAME of balance: hold"),
        (["balance", "--set", "bumps=high"], 2, "bumps: expected a number"),
        (["balance", "--sensor", "MPU-1"], 2, "expected one of MPU-6050"),
        (["balance", "--duration", "nan"], 2, "--duration nan: expected seconds"),
        (["balance", "--duration", "0.001"], 2, r"--duration 0\.001 at --rate 200 makes 0 rows, expected 2 at least"),
        (["balance", "--seed", "-1"], 2, "--seed -1"),
        (["arm", "--at", "hand"], 2, "arm has forearm, upper_arm"),
        (["balance", "-o", "robot.xls"], 2, r"ending in \.parquet"),
        (["balance", "--picture", "robot.jpg"], 2, r"ending in \.png"),
        (["balance", "-o", "nowhere/robot.csv"], 1, "folder nowhere does not exist"),
    ],
)
def test_refusals(arguments: list[str], code: int, says: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", *arguments]) == code
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert re.search(says, line), line
    assert not [*Path().iterdir()], "nothing half-written"


def test_without_mujoco_it_says_what_to_install() -> None:
    script = (
        "import sys; sys.modules['mujoco'] = None; from poise.cli import run; sys.exit(run(['simulate', 'balance']))"
    )
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert result.returncode == 1
    assert 'pip install "poise[sim]"' in result.stderr
    assert result.stderr.count("\n") == 1
