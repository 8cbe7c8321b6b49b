"""The command as a user meets it: results, exit codes, one line per problem, nothing half-written."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poise
from data_files import data_path
from poise.cli import run
from poise.formats import read_attitude
from poise.math import arrays
from poise.simulation import Sensor, forearm, measure


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty current folder with a made recording in it."""
    monkeypatch.chdir(tmp_path)
    poise.write(measure(forearm(8.0), Sensor(), seed=1), tmp_path / "made.csv")
    return tmp_path


def refused(capsys: pytest.CaptureFixture[str], *arguments: str, code: int, says: str) -> None:
    assert run(list(arguments)) == code
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 1, lines
    assert re.search(says, lines[0]), lines[0]
    assert "Traceback" not in lines[0]


def test_help_needs_no_compiler() -> None:
    loaded = "[m for m in ('numba', 'numpy') if m in sys.modules]"
    script = f"import sys; from poise.cli import run; run(['--help']); print({loaded})"
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert "estimate" in result.stdout
    assert result.stdout.rstrip().endswith("[]")


@pytest.mark.parametrize(
    "command", ["estimate", "evaluate", "compare", "plot", "doctor", "sniff", "methods", "demo", "simulate"]
)
def test_every_command_explains_itself(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run([command, "--help"]) == 0
    text = capsys.readouterr().out
    assert f"poise {command}" in text
    assert len(text) > 400


def test_help_teaches(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--help"]) == 0
    assert "the main job" in capsys.readouterr().out
    assert run(["estimate", "--help"]) == 0
    text = capsys.readouterr().out
    assert "Examples" in text
    assert "w x y z" in text


def test_estimate_writes_the_attitude_beside_its_facts(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["estimate", "made.csv", "--plot", "made.png"]) == 0
    out = capsys.readouterr().out
    assert "made.attitude.parquet" in out
    assert (folder / "made.png").read_bytes().startswith(b"\x89PNG")
    attitude = read_attitude(folder / "made.attitude.parquet")
    expected = poise.estimate(poise.SelfCalibrating(), poise.read("made.csv"))
    np.testing.assert_array_equal(attitude.quat, expected.quat)
    assert attitude.provenance.method == "SelfCalibrating"
    assert attitude.provenance.source_hash


def test_estimate_json_frames_methods_and_parameters(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["estimate", "made.csv", "-m", "adaptive-gain", "--set", "k_rest=0.3", "--frame", "ned", "--json"]
    assert run([*arguments, "-o", "out.csv", "--declination", "4"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["method"] == "adaptive-gain"
    assert report["results"][0]["heading"] == "true"
    attitude = read_attitude(folder / "out.csv")
    assert attitude.frame == "ned"
    method = poise.AdaptiveGain(k_rest=0.3, declination=np.radians(4))
    expected = poise.estimate(method, poise.read("made.csv")).to("ned")
    np.testing.assert_allclose(attitude.quat, expected.quat, atol=1e-15)


def test_place_and_date_give_the_declination(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["estimate", "made.csv", "--place", "52.5,13.4", "--date", "2024-07-01", "-o", "a.parquet"]) == 0
    assert run(["estimate", "made.csv", "--declination", "5.0", "-o", "b.parquet"]) == 0
    a, b = read_attitude(folder / "a.parquet"), read_attitude(folder / "b.parquet")
    assert np.degrees(a.heading()[-1] - b.heading()[-1]) == pytest.approx(0.0, abs=0.1)
    capsys.readouterr()


def test_evaluate_against_the_file_and_beside_it(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["evaluate", "made.csv", "--json"]) == 0
    inside = json.loads(capsys.readouterr().out)["results"][0]["rmse_deg"]
    recording = poise.read("made.csv")
    errors = poise.evaluate(poise.estimate(poise.SelfCalibrating(), recording), recording)
    assert inside["total"] == pytest.approx(errors.rmse_deg().total)
    assert recording.truth is not None
    poise.write(recording.truth, folder / "truth.tum")
    assert run(["estimate", "made.csv", "-o", "est.parquet"]) == 0
    capsys.readouterr()
    assert run(["evaluate", "est.parquet", "--reference", "truth.tum", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["results"][0]
    beside = told["rmse_deg"]
    assert told["method"] == "SelfCalibrating"
    assert told["compared"] + told["missing"] <= told["rows"]
    assert beside["heading"] == pytest.approx(inside["heading"], abs=0.3)


def test_every_route_to_a_reference_gives_one_figure(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The moving rows that a reference names count, however it is given; where none are named, that is said."""
    made = poise.read("made.csv")
    assert made.truth is not None
    moving = np.arange(len(made)) > len(made) // 2
    poise.write(replace(made, moving=moving), "named.parquet")
    poise.write(replace(made, truth=None, moving=None), "bare.csv")
    poise.write(made.truth, "truth.tum")
    assert run(["estimate", "bare.csv", "-m", "tilt", "-o", "estimate.parquet"]) == 0
    capsys.readouterr()

    def figure(*arguments: str) -> dict[str, Any]:
        assert run(["evaluate", *arguments, "--json"]) == 0
        found: dict[str, Any] = json.loads(capsys.readouterr().out)["results"][0]
        return {key: found[key] for key in ("rmse_deg", "compared", "over")}

    inside = figure("named.parquet", "-m", "tilt")
    assert inside["over"] == "moving rows" and inside["compared"] <= moving.sum()
    for route in (["bare.csv", "-m", "tilt"], ["estimate.parquet"], ["named.parquet", "-m", "tilt"]):
        beside = figure(*route, "--reference", "named.parquet")
        assert beside["compared"] == inside["compared"] and beside["over"] == "moving rows"
        assert beside["rmse_deg"] == pytest.approx(inside["rmse_deg"], abs=1e-5)
    # the recording names its moving rows, where the reference does not
    assert figure("named.parquet", "-m", "tilt", "--reference", "truth.tum")["compared"] == inside["compared"]
    assert figure("estimate.parquet", "--reference", "truth.tum")["over"] == "all rows"
    assert run(["evaluate", "estimate.parquet", "--reference", "truth.tum"]) == 0
    assert "estimate.parquet: no rows are named as moving" in capsys.readouterr().err


def test_options_without_any_effect_are_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    refused(
        capsys, "estimate", "made.csv", "--topic", "/imu", code=1, says="only ROS bags have topics, this is a text file"
    )
    (folder / "nothing.toml").write_text("# nothing\n[units]\n")
    refused(capsys, "estimate", "made.csv", "--profile", "nothing.toml", code=2, says="nothing.toml: says nothing")


def test_the_help_names_options_that_work(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["estimate", "--help"]) == 0
    told = re.sub(r"[│\s]+", " ", capsys.readouterr().out)
    (example,) = set(re.findall(r"--set (\w+=[\d.]+)", told))
    assert run(["estimate", "made.csv", "--set", example, "-o", "out.parquet"]) == 0
    assert run(["estimate", "--help"]) == 0
    assert not re.search(r"poise {2,}estimate", capsys.readouterr().out)


def test_a_picture_of_no_valid_row_is_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    made = poise.read("made.csv")
    nothing = np.full_like(made.acc, np.nan)
    poise.write(made.with_samples(acc=nothing, gyr=nothing), "nan.csv")
    assert run(["plot", "nan.csv", "-m", "tilt"]) == 1
    assert "nan.csv: no row is valid" in capsys.readouterr().err and Path("nan.png").exists()


@pytest.mark.parametrize("method", ["tilt", "gated"])
def test_a_method_without_heading_is_judged_by_inclination(
    method: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    made = measure(forearm(8.0), Sensor(), seed=1)
    assert made.truth is not None
    half = np.array([np.cos(np.pi / 2), 0.0, 0.0, np.sin(np.pi / 2)])  # a reference that heads the other way
    turned = poise.Attitude.of(made.time, arrays.multiply(half, made.truth.quat))
    poise.write(replace(made, truth=turned), "made.csv")
    assert run(["evaluate", "made.csv", "-m", method, "--json"]) == 0
    result = json.loads(capsys.readouterr().out)["results"][0]
    assert result["judged_by"] == "inclination" and not result["diverged"]
    assert result["rmse_deg"]["total"] > 90 > result["rmse_deg"]["inclination"]
    assert run(["evaluate", "made.csv", "-m", method]) == 0
    told = capsys.readouterr().out
    assert f"{result['rmse_deg']['inclination']:.2f}" in told and "judged by" in told
    assert f"{result['rmse_deg']['total']:.2f}" not in told
    assert run(["estimate", "made.csv", "-m", method, "-o", "a.parquet"]) == 0
    assert "inclination error °" in (told := capsys.readouterr().out)
    assert f"{result['rmse_deg']['inclination']:.2f}" in told
    assert run(["estimate", "made.csv", "-m", "two-stage", "-o", "b.parquet", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["results"][0]["judged_by"] == "total"


@pytest.mark.parametrize("name", ["[1].csv", '["made.csv"].csv', "[red]x.csv", "{a}.csv"])
def test_brackets_are_part_of_a_name(name: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "made.csv").rename(folder / name)
    out = f"{name[:-4]}.png.csv"
    assert run(["sniff", name]) == 0
    assert name in capsys.readouterr().out
    assert run(["estimate", name, "-o", out, "-m", "gated"]) == 0
    told = capsys.readouterr().out
    assert name in told and out in told
    assert run(["evaluate", name, "-m", "gated"]) == 0
    assert name in capsys.readouterr().out
    (folder / "[").mkdir()
    assert run(["estimate", name, "-o", "[/b].csv", "-m", "gated"]) == 0
    assert "[/b].csv" in capsys.readouterr().out
    assert run(["plot", name, "-m", "gated"]) == 0
    assert f"{name[:-4]}.png" in capsys.readouterr().out
    refused(capsys, "compare", "[2].csv", code=1, says=r"\[2\]\.csv")


def test_methods_say_where_heading_comes_from_and_which_is_the_default(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["methods", "--json"]) == 0
    listed = {entry["method"]: entry for entry in json.loads(capsys.readouterr().out)}
    assert (listed["tilt"]["heading"], listed["gated"]["heading"]) == ("none", "gyroscope")
    assert {name for name, entry in listed.items() if entry["heading"] == "magnetometer"} == set(listed) - {
        "tilt",
        "gated",
    }
    assert [name for name, entry in listed.items() if entry["default"]] == ["self-calibrating"]
    assert run(["methods"]) == 0
    assert "self-calibrating (default)" in capsys.readouterr().out


def test_methods_lists_and_explains(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["methods"]) == 0
    listed = capsys.readouterr().out
    assert all(name in listed for name in poise.METHODS)
    for name in poise.METHODS:
        assert run(["methods", name]) == 0
        assert "Departures from the print" in capsys.readouterr().out
    assert run(["methods", "--json"]) == 0
    assert {entry["method"] for entry in json.loads(capsys.readouterr().out)} == set(poise.METHODS)


def test_sniff_says_what_it_is(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["sniff", "made.csv"]) == 0
    text = capsys.readouterr().out
    assert "rad/s" in text
    assert "Hz" in text


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["estimate"], "FILE"),
        (["estimate", "made.csv", "--nonsense"], "nonsense"),
        (["estimate", "made.csv", "-m", "kalman"], "two-stage, adaptive-gain"),
        (["estimate", "made.csv", "--set", "nope=1"], "NAME=VALUE"),
        (["estimate", "made.csv", "--set", "gyr_noise=-1"], "gyr_noise: expected 0 to 10"),
        (["estimate", "made.csv", "--set", "gyr_noise=much"], "expected a number"),
        (["estimate", "made.csv", "--place", "52.5,13.4"], "--date"),
        (["estimate", "made.csv", "--place", "Berlin", "--date", "2024-01-01"], "LAT,LON"),
        (["estimate", "made.csv", "--place", "52,13", "--date", "1999-01-01"], "2010 to 2029"),
        (["estimate", "made.csv", "--declination", "1", "--place", "52,13", "--date", "2024-01-01"], "give one"),
        (["estimate", "made.csv", "-o", "made.csv"], "nothing is written over an input"),
        (["estimate", "made.csv", "-o", "out.xyz"], "ending in"),
        (["estimate", "made.csv", "./made.csv"], "twice"),
        (["estimate", "made.csv", "--units", "deg"], "pairs such as"),
        (["methods", "kalman"], "no method"),
        (["evaluate", "made.csv", "other.csv", "--plot", "a.png"], "one at a time"),
        (["evaluate", "made.csv", "./made.csv"], "twice"),
        (["estimate", "made.csv", "--learned-every", "2"], "goes with --learned-over-time"),
        (["fly"], "fly"),
        (["estimate", "made.csv", "--remap", "x x z"], "each of x, y, z"),
        (["estimate", "made.csv", "--units", "foo=s"], "expected one of"),
        (["estimate", "made.csv", "--rate", "0"], "above 0"),
        (["estimate", "made.csv", "--delimiter", "xx"], "one character"),
        (["estimate", "made.csv", "--set", "acc_noise=0"], "acc_noise"),
    ],
)
def test_usage_errors_are_one_line_and_code_2(
    folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], says: str
) -> None:
    refused(capsys, *arguments, code=2, says=says)
    assert [path.name for path in folder.iterdir()] == ["made.csv"]


def test_bad_files_are_told_and_the_good_ones_done(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "empty.csv").touch()
    (folder / "text.csv").write_text("hello\nworld\n")
    (folder / "picture.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(100))
    (folder / "out").mkdir()
    assert run(["estimate", "missing.csv", "empty.csv", "text.csv", "picture.png", "made.csv", "-o", "out"]) == 1
    captured = capsys.readouterr()
    problems = [line for line in captured.err.splitlines() if line.startswith("poise:")]
    assert len(problems) == 4
    assert [path.name for path in (folder / "out").iterdir()] == ["made.attitude.parquet"]


@pytest.mark.parametrize("limit", ["whole=1GiB", "whole=0"])  # in memory, and in chunks
def test_a_file_without_one_usable_sample_is_told(limit: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    made = poise.read("made.csv")
    poise.write(made.with_samples(acc=np.full_like(made.acc, np.nan)), folder / "dead.csv")
    arguments = ["estimate", "dead.csv", "made.csv", "-m", "two-stage", "--limit", limit, "--json"]
    assert run(arguments) == 1
    out, err = capsys.readouterr()
    (line,) = err.strip().splitlines()
    assert "dead.csv: no row is valid: no attitude yet" in line and "dead.attitude.parquet was written" in line
    found = json.loads(out)
    assert [result["file"] for result in found["results"]] == ["dead.csv", "made.csv"]
    assert [error["file"] for error in found["errors"]] == ["dead.csv"]
    attitude = read_attitude(folder / "dead.attitude.parquet")  # nothing is lost: the flags say why, row by row
    assert len(attitude) == len(made) and not attitude.valid.any() and attitude.reasons()


def test_messages_count_and_name_once(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    poise.write(poise.Recording([0.0], [[0.1, 0, 0]], [[0, 0, 9.8]]), "one.csv")
    assert run(["sniff", "one.csv"]) == 0
    assert "1 row," in capsys.readouterr().out
    (folder / "empty.csv").touch()
    assert run(["estimate", "empty.csv", "--json"]) == 1
    captured = capsys.readouterr()
    assert json.loads(captured.out)["errors"] == [{"file": "empty.csv", "error": "the file is empty"}]
    assert captured.err == "poise: empty.csv: the file is empty\n"
    refused(capsys, "estimate", "made.csv", "-m", "gated", "--set", "alpha=2", code=2, says="expected 0 to 1, found 2")


def test_an_unwritable_place_is_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "taken").write_text("a file, not a folder")
    refused(capsys, "estimate", "made.csv", "-o", "taken/out.parquet", code=1, says="taken")


@pytest.mark.parametrize(
    "arguments",
    [
        ["estimate", "made.csv", "-o", "nowhere"],
        ["estimate", "made.csv", "-o", "nowhere/a.parquet"],
        ["estimate", "made.csv", "--limit", "whole=0", "-o", "nowhere/a.parquet"],
        ["estimate", "made.csv", "--plot", "nowhere/a.png"],
        ["estimate", "made.csv", "--learned-over-time", "nowhere/a.csv"],
        ["estimate", "made.csv", "--save-learned", "nowhere/a.json"],
        ["evaluate", "made.csv", "--plot", "nowhere/a.png"],
        ["plot", "made.csv", "-o", "nowhere/a.png"],
        ["compare", "made.csv", "--plot", "nowhere"],
        ["compare", "made.csv", "--report", "nowhere/a.html"],
        ["doctor", "made.csv", "--sheet", "nowhere/a.png"],
        ["doctor", "made.csv", "--save-profile", "nowhere/a.toml"],
    ],
)
def test_a_folder_that_is_not_there_is_told_before_any_work(
    arguments: list[str], folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("poise.cli.show.each", lambda *_: pytest.fail("worked for nothing"))
    refused(capsys, *arguments, code=1, says=r"nowhere\S*: folder nowhere does not exist; make it")
    assert [path.name for path in folder.iterdir()] == ["made.csv"]


def test_no_reference_is_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    recording = poise.read("made.csv")
    bare = poise.Recording(recording.time, recording.gyr, recording.acc, recording.mag)
    poise.write(bare, folder / "bare.csv")
    refused(capsys, "evaluate", "bare.csv", code=1, says="no reference")


BROAD = [
    "01_undisturbed_slow_rotation_A.mat",
    "21_undisturbed_fast_combined.mat",
    "33_disturbed_attached_magnet_2cm.mat",
]


@pytest.mark.parametrize("method", list(poise.METHODS))
def test_real_recordings_with_no_options(
    method: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [str(data_path("broad", name)) for name in BROAD]
    files.append(str(data_path("other", "x-io_fusion_sensor_data.csv")))
    monkeypatch.chdir(tmp_path)
    assert run(["estimate", *files, "-m", method, "--json"]) == 0
    results: list[dict[str, Any]] = json.loads(capsys.readouterr().out)["results"]
    assert [result["valid"] for result in results] == pytest.approx([1.0] * 4, abs=2e-3)  # tilt: a start in motion
    kind = "total" if "declination" in poise.METHODS[method]._fields else "inclination"
    errors = [result["error_deg"][kind] for result in results[:3]]
    assert errors[0] < 8.0
    assert max(errors) < (45.0 if method == "tilt" else 20.0)  # fast motion is not what it is made for
    assert results[3]["error_deg"] is None
    assert len(list(tmp_path.glob("*.attitude.parquet"))) == 4


def test_time_that_runs_backwards_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    made = poise.read(folder / "made.csv")
    poise.write(made, folder / "forward.csv")
    lines = (folder / "forward.csv").read_text().splitlines()
    first = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    (folder / "made.csv").write_text("\n".join([lines[first], *lines[:first:-1]]) + "\n")
    refused(capsys, "estimate", "made.csv", code=1, says="backwards")
