"""``poise doctor`` as a user meets it: the verdict, the repaired command, profiles, sheets, and who refuses what."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poise
from poise.cli import run
from poise.simulation import Sensor, forearm, measure

HEADER = "time,gx,gy,gz,ax,ay,az,mx,my,mz"


@pytest.fixture
def right() -> poise.Recording:
    return measure(forearm(40.0, seed=2), Sensor(mag_delay=0.0), seed=2)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, right: poise.Recording) -> Path:
    """A folder with a recording that is right, and one with the gyroscope's axes swapped, in deg/s, without units."""
    monkeypatch.chdir(tmp_path)
    poise.write(right, tmp_path / "right.csv")
    swapped = np.degrees(right.gyr)[:, [1, 0, 2]]
    table(tmp_path / "glove.csv", HEADER, right.time, swapped, right.acc, right.mag)
    return tmp_path


def table(path: Path, header: str, *columns: Any) -> None:
    np.savetxt(path, np.column_stack(columns), delimiter=",", header=header, comments="", fmt="%.9g")


def test_the_walk_through(folder: Path, capsys: pytest.CaptureFixture[str], right: poise.Recording) -> None:
    assert run(["estimate", "glove.csv"]) == 1  # neither unit nor axes: refused
    assert run(["doctor", "glove.csv", "--save-profile", "glove.toml"]) == 1
    text = capsys.readouterr().out
    assert "glove.csv: surely wrong: gyr unit, gyr axes" in text
    words = shlex.split(text.split("repaired: ")[1].splitlines()[0])
    assert words[:3] == ["poise", "estimate", "glove.csv"] and "gyr=y x z" in words
    assert run([*words[1:], "-m", "two-stage", "-o", "by-options.csv"]) == 0
    assert run(["estimate", "glove.csv", "--profile", "glove.toml", "-m", "two-stage", "-o", "by-profile.csv"]) == 0
    assert (folder / "by-options.csv").read_bytes()[-999:] == (folder / "by-profile.csv").read_bytes()[-999:]
    found, expected = poise.read_attitude("by-profile.csv"), poise.estimate(poise.TwoStage(), right)
    apart = 2 * np.arccos(np.clip(np.abs(np.sum(found.quat * expected.quat, axis=1)), 0, 1))
    assert np.degrees(np.max(apart)) < 0.1
    assert run(["doctor", "glove.csv", "--profile", "glove.toml"]) == 0
    assert "surely" not in capsys.readouterr().out.replace("nothing surely", "")


def test_a_right_recording_is_fine(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["doctor", "right.csv", "--json"]) == 0
    (result,) = json.loads(capsys.readouterr().out)["results"]
    assert result["options"] == "" and result["command"] == ""
    assert all(f["severity"] != "sure" for f in result["findings"])


def test_no_profile_where_nothing_is_to_be_repaired(
    folder: Path, capsys: pytest.CaptureFixture[str], right: poise.Recording
) -> None:
    assert run(["doctor", "right.csv", "--save-profile", "right.toml"]) == 0
    assert "right.csv: nothing to repair: no profile written" in capsys.readouterr().err
    poise.write(right.with_samples(acc=0.01 * right.acc + 0.1), folder / "free.csv")
    assert run(["doctor", "free.csv", "--save-profile", "free.toml"]) == 1
    assert "free.csv: nothing of it is repaired for sure: no profile written" in capsys.readouterr().err
    assert (
        run(["doctor", "right.csv", "--delay", "mag=0.01", "--save-profile", "told.toml"]) == 0
    )  # what was told is kept
    assert [path.name for path in folder.glob("*.toml")] == ["told.toml"]


def test_what_is_surely_wrong_is_refused_with_its_fix(
    folder: Path, capsys: pytest.CaptureFixture[str], right: poise.Recording
) -> None:
    poise.write(right.remap("x y -z", "acc"), folder / "left-handed.csv")
    for command in (["estimate"], ["evaluate"], ["plot"], ["compare", "-m", "tilt"]):
        assert run([command[0], "left-handed.csv", *command[1:]]) == 1
        (line,) = capsys.readouterr().err.strip().splitlines()
        assert '--remap "acc=x y -z"' in line and "--force" in line and "Traceback" not in line
    assert run(["evaluate", "left-handed.csv", "-m", "tilt", "--force"]) == 0
    capsys.readouterr()
    assert run(["evaluate", "left-handed.csv", "-m", "tilt", "--remap", "acc=x y -z"]) == 0


def test_options_add_up(folder: Path, capsys: pytest.CaptureFixture[str], right: poise.Recording) -> None:
    """What is found behind a turn of all sensors is said before it."""
    poise.write(right.remap("x y -z", "acc"), folder / "a.csv")
    assert run(["doctor", "a.csv", "--remap", "y z x", "--json"]) == 1
    (result,) = json.loads(capsys.readouterr().out)["results"]
    assert run(["doctor", *shlex.split(result["command"])[2:]]) == 0
    assert "acc=x y -z" in result["command"] and "all=y z x" in result["command"]


def test_a_value_may_begin_with_a_hyphen(
    folder: Path, capsys: pytest.CaptureFixture[str], right: poise.Recording
) -> None:
    """As an argument of its own: the one after the option is its value, whatever it begins with."""
    assert run(["doctor", "right.csv", "--remap", "-x -y z"]) == 0
    assert run(["doctor", "right.csv", "--remap=-x -y z"]) == 0
    np.savetxt(folder / "bare.csv", np.column_stack([right.time, right.time, right.gyr, right.acc]), delimiter=",")
    assert run(["doctor", "bare.csv", "--columns", "-,time,gx,gy,gz,ax,ay,az", "--units", "gyr=rad/s,acc=m/s2"]) == 0
    where = ["--place", "-33.9,151.2", "--date", "2026-01-01"]
    assert run(["estimate", "right.csv", "-m", "two-stage", *where, "-o", "south.csv"]) == 0
    assert "poise:" not in capsys.readouterr().err


def test_sheets(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("matplotlib")
    assert run(["doctor", "glove.csv", "right.csv", "--sheet", "both.html"]) == 1
    page = (folder / "both.html").read_text()
    assert page.count("<svg") == 8 and "gyr=y x z" in page and "http-equiv" in page
    assert run(["doctor", "right.csv", "--sheet", "one.png"]) == 0
    assert (folder / "one.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["doctor", "absent.csv"], 1, "absent.csv"),
        (["doctor", "right.csv", "glove.csv", "--save-profile", "x.toml"], 2, "one recording"),
        (["doctor", "right.csv", "--save-profile", "x.txt"], 2, r"\.toml"),
        (["doctor", "right.csv", "--sheet", "x.txt"], 2, r"\.html"),
        (["doctor", "right.csv", "glove.csv", "--sheet", "x.png"], 2, r"\.html holds"),
        (["doctor", "right.csv", "--sheet", "no.csv/x.html"], 1, "file, not a folder"),
        (["doctor", "right.csv", "--hemisphere", "east"], 2, "hemisphere"),
        (["estimate", "right.csv", "--remap", "acc=x x z"], 2, "--remap"),
        (["estimate", "right.csv", "--remap", "baro=x y z"], 2, "--remap"),
        (["estimate", "right.csv", "--remap", "-x y z"], 2, "--remap: axes '-x y z' make a left-handed frame"),
        (["estimate", "right.csv", "--remap", "--json"], 2, "--remap: axes '--json' not understood"),
        (["estimate", "right.csv", "--delay", "gyr=0.1"], 2, "--delay"),
        (["estimate", "right.csv", "--delay", "mag=late"], 2, "--delay"),
        (["estimate", "right.csv", "--profile", "absent.toml"], 2, "cannot be read"),
        (["estimate", "right.csv", "--profile", "no.csv"], 2, "no TOML"),
        (["estimate", "right.csv", "--profile", "odd.toml"], 2, r"no table \[unit\]"),
        (["estimate", "right.csv", "--units", "gyr=furlong"], 2, "--units: unit 'furlong' of gyr not understood"),
    ],
)
def test_mistakes(folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], code: int, says: str) -> None:
    (folder / "no.csv").write_text("time,\x01 =")
    (folder / "odd.toml").write_text("[unit]\ngyr = 'deg/s'\n")
    assert run(arguments) == code
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 1 and re.search(says, lines[0]), lines


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("[units]\ngyr = 'furlong'", r"\[units\] gyr: unit 'furlong' of gyr not understood; expected one of rad/s"),
        ("[units]\ngyr = 'deg/s,acc=g'", r"\[units\] gyr: unit 'deg/s,acc=g'"),
        ("[units]\ngyr = 3", r"\[units\] gyr: expected a text, found 3"),
        ("[units]\nbaro = 'Pa'", r"\[units\] baro: \[units\] is of time, gyr, acc, mag"),
        ("[unit]\ngyr = 'deg/s'", r"no table \[unit\] is known"),
        ("units = 'deg/s'", "units is no table"),
        ("[remap]\nacc = 'x x z'", r"\[remap\] acc: axes 'x x z' are not a rotation"),
        ("[remap]\nacc = ''", r"\[remap\] acc: axes ''"),
        ("[remap]\nall = 'x y -z'", r"\[remap\] all: axes 'x y -z' make a left-handed frame"),
        ("[delay]\nmag = 5.0", r"\[delay\] mag = 5.0: expected seconds, at most 1"),
        ("[delay]\nmag = nan", r"\[delay\] mag = nan: expected seconds"),
        ("[delay]\nmag = true", r"\[delay\] mag: expected seconds, a number"),
        ("[delay]\ngyr = 0.1", r"\[delay\] gyr: \[delay\] is of acc, mag"),
    ],
)
def test_a_mistake_in_a_profile_is_named_with_file_and_key(
    folder: Path, capsys: pytest.CaptureFixture[str], text: str, says: str
) -> None:
    (folder / "glove.toml").write_text(text)
    assert run(["estimate", "right.csv", "--profile", "glove.toml"]) == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert re.match(f"poise: --profile glove.toml: {says}", line), line


def test_a_file_in_chunks_is_refused_and_repaired_alike(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    told = ["estimate", "glove.csv", "--units", "gyr=deg/s,acc=m/s2", "-o", "long.parquet", "--limit", "whole=1"]
    assert run(told) == 1
    assert '--remap "gyr=y x z"' in capsys.readouterr().err
    assert not list(folder.glob("long*"))
    assert run([*told, "--remap", "gyr=y x z"]) == 0
    assert run([*told[:4], "-o", "short.parquet", "--remap", "gyr=y x z"]) == 0
    np.testing.assert_array_equal(
        poise.read_attitude(folder / "long.parquet").table, poise.read_attitude(folder / "short.parquet").table
    )


def test_the_hemisphere_is_north_or_south(right: poise.Recording) -> None:
    with pytest.raises(poise.PoiseError, match="hemisphere: expected 'north' or 'south', found 'west'"):
        poise.diagnose(right, hemisphere="west")  # type: ignore[arg-type]
