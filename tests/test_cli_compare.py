"""compare, plot and demo as a user meets them."""

from __future__ import annotations

import csv
import json
import shlex
import sys
from dataclasses import replace
from html import unescape
from pathlib import Path
from typing import Any

import pytest

import poise
from poise.cli import run
from poise.simulation import Sensor, forearm, measure


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    recording = measure(forearm(8.0), Sensor(), seed=1)
    poise.write(recording, tmp_path / "made.csv")
    poise.write(replace(recording, truth=None, moving=None), tmp_path / "blind.csv")
    (tmp_path / "empty.csv").write_text("")
    return tmp_path


def blank(_figure: Any, file: Any, **_: Any) -> None:
    """A picture of nothing, in no time."""
    svg = '<svg viewBox="0 0 1 1"></svg>'
    file.write(svg) if hasattr(file, "write") else Path(file).write_text(svg)


def test_compare_json_with_good_and_bad_files(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", blank)
    arguments = ["made.csv", "blind.csv", "empty.csv", "nowhere.csv", "-m", "two-stage", "-m", "tilt", "--json"]
    assert run(["compare", *arguments, "--report", "all.html"]) == 1
    captured = capsys.readouterr()
    document = json.loads(captured.out)
    assert [result["against"] for result in document["results"]] == ["reference", "consensus"]
    assert [error["file"] for error in document["errors"]] == ["empty.csv", "nowhere.csv"]
    assert len(captured.err.strip().splitlines()) == 2
    assert {row["name"] for row in document["mean_rms_deg"]} == {"two-stage", "tilt"}
    expected = poise.evaluate(poise.estimate(poise.TwoStage(), poise.read("made.csv")), poise.read("made.csv"))
    assert document["results"][0]["estimators"][0]["error_deg"]["total"] == expected.table()["total"]
    page = (folder / "all.html").read_text(encoding="utf-8")
    assert "nowhere.csv" in page and "poise compare made.csv blind.csv" in page


def test_limits_of_files_and_degrees_are_two_options(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["compare", "made.csv", "-m", "tilt", "--limit", "rows=10"]) == 1
    assert "the limit is 10" in capsys.readouterr().err
    assert run(["compare", "made.csv", "-m", "tilt", "--limit", "rows=2e8", "--threshold", "5"]) == 0


def test_compare_tells_and_draws(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["compare", "blind.csv", "-m", "two-stage", "-m", "gated", "--threshold", "0.1", "--plot", "a.svg"]) == 0
    captured = capsys.readouterr()
    assert "Distance from the consensus" in captured.out and "is off the consensus" in captured.out
    assert "neither can be blamed" in captured.err and "inclination only" in captured.err
    assert (folder / "a.svg").read_bytes().startswith(b"<?xml")


def test_the_command_in_the_report_makes_it_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", blank)
    odd = folder / "it's $(odd).csv"
    (folder / "made.csv").rename(odd)
    options = ["--rate", "100", "--remap=-y x z", "--threshold", "3.123456789"]
    assert run(["compare", odd.name, "-m", "gated", *options, "--report=-a.html"]) == 0
    words = shlex.split(command_in(folder / "-a.html"))
    assert words[:3] == ["poise", "compare", odd.name] and "gated" in words and "--rate" in words
    assert "--remap=-y x z" in words and words[words.index("--threshold") + 1] == "3.123456789"
    (folder / "-a.html").unlink()
    assert run(words[1:]) == 0 and (folder / "-a.html").exists()


def command_in(report: Path) -> str:
    return unescape(report.read_text(encoding="utf-8").split("<pre><code>")[1].split("</code>")[0])


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["compare", "made.csv", "-m", "magic"], "no method 'magic'; there are"),
        (["compare", "made.csv", "--with", "magic"], "no peer or package called 'magic'"),
        (["compare", "made.csv", "--threshold", "0"], "--threshold"),
        (["compare", "made.csv", "--report", "made.csv"], r"ending in .html"),
        (["compare", "made.csv", "blind.csv", "--plot", "a.png"], "give a folder"),
        (["compare", "made.csv", "made.csv"], "given twice"),
        (["plot", "made.csv", "-o", "made.csv"], "--output"),
        (["plot", "made.csv", "-m", "magic"], "no method"),
        (["compare"], "FILE"),
    ],
)
def test_usage_is_code_2_and_one_line(
    arguments: list[str], says: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = sorted(folder.iterdir())
    assert run(arguments) == 2
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 1 and says in lines[0]
    assert sorted(folder.iterdir()) == before


def test_plot_draws_recordings_and_attitudes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["estimate", "made.csv", "-o", "a.parquet"]) == 0
    capsys.readouterr()
    (folder / "pictures").mkdir()
    assert run(["plot", "made.csv", "blind.csv", "a.parquet", "empty.csv", "-o", "pictures", "--json"]) == 1
    document = json.loads(capsys.readouterr().out)
    assert [result["drawn"].split()[0] for result in document["results"]] == ["sensors", "sensors", "attitude"]
    assert sorted(path.name for path in (folder / "pictures").iterdir()) == ["a.png", "blind.png", "made.png"]


def test_an_unwritable_report_is_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["compare", "made.csv", "-m", "gated", "--report", "empty.csv/a.html"]) == 1
    captured = capsys.readouterr()
    assert "is a file, not a folder" in captured.err and captured.out == ""


@pytest.mark.parametrize("option", ["--report={}/a.html", "--plot={}/a.png"])
def test_a_place_that_cannot_be_written_is_told_before_any_work(
    option: str, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("poise.comparison.compare", lambda *_, **__: pytest.fail("worked for nothing"))
    assert run(["compare", "made.csv", "-m", "gated", option.format("made.csv")]) == 1
    assert len(capsys.readouterr().err.strip().splitlines()) == 1
    monkeypatch.setattr("tempfile.TemporaryFile", _refuse)
    assert run(["compare", "made.csv", "-m", "gated", option.format(".")]) == 1
    assert "No space left" in capsys.readouterr().err and not [*folder.glob("a.*")]


def test_where_every_estimator_fails_the_exit_code_says_so(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    header = "time,gx[rad/s],gy[rad/s],gz[rad/s],ax[m/s^2],ay[m/s^2],az[m/s^2]\n"
    (folder / "void.csv").write_text(header + "".join(f"{i / 100},nan,nan,nan,nan,nan,nan\n" for i in range(50)))
    assert run(["compare", "void.csv", "-m", "two-stage", "-m", "gated", "--report", "a.html"]) == 1
    captured = capsys.readouterr()
    assert "poise: void.csv: no estimator gave an attitude" in captured.err.splitlines()
    page = (folder / "a.html").read_text(encoding="utf-8")
    assert "consensus" not in captured.out + captured.err + page.split("</style>")[1]
    assert run(["compare", "void.csv", "made.csv", "-m", "gated", "--json"]) == 1
    assert [error["file"] for error in json.loads(capsys.readouterr().out)["errors"]] == ["void.csv"]


def test_where_no_row_moves_evaluate_says_so(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    recording = poise.read("made.csv")
    poise.write(replace(recording, moving=[False] * len(recording)), folder / "still.csv")
    assert run(["evaluate", "still.csv"]) == 1
    error = capsys.readouterr().err
    assert "no row moves, so none counts" in error and "clocks" not in error


@pytest.mark.parametrize("json_too", [False, True])
@pytest.mark.parametrize("option", ["--report=a.html", "--plot=a.png"])
def test_results_are_told_where_a_file_cannot_be_written_after_all(
    option: str, json_too: bool, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("poise.formats.saving.os.fsync", _refuse)
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", _refuse if "plot" in option else lambda *_, **__: None)
    monkeypatch.setattr("poise.report.report", lambda *_, **__: "a page")
    assert run(["compare", "made.csv", "-m", "gated", option, *(["--json"] if json_too else [])]) == 1
    captured = capsys.readouterr()
    assert [line for line in captured.err.splitlines() if line.startswith("poise:")] == captured.err.splitlines()[-1:]
    assert "No space left" in captured.err and "report in" not in captured.err and "picture in" not in captured.err
    if json_too:
        document = json.loads(captured.out)
        assert document["results"][0]["estimators"][0]["rows"] > 0 and "No space left" in document["errors"][0]["error"]
    else:
        assert "gated" in captured.out


def _refuse(*_: object, **__: object) -> None:
    raise OSError(28, "No space left on device")


def test_demo_writes_everything(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys.modules["poise.cli.demo"], "_DURATION", 6.0)
    monkeypatch.setattr("poise.comparison.available_peers", dict)
    assert run(["demo", "-o", "what's shown"]) == 0
    names = {path.name for path in (folder / "what's shown").iterdir()}
    made = {f"{name}.{kind}" for name in ("forearm", "phone", "robot") for kind in ("csv", "png", "comparison.png")}
    assert names == made | {"report.html", "table.csv", "comparison.json", ".poise-demo"}
    rows = list(csv.DictReader((folder / "what's shown" / "table.csv").open()))
    assert len(rows) == 3 * len(poise.METHODS)
    assert all(float(row["inclination_rmse_deg"]) < 10.0 for row in rows)
    words = shlex.split(command_in(folder / "what's shown" / "report.html"))
    assert words[2] == str(Path("what's shown", "forearm.csv")) and words[-1] == str(
        Path("what's shown", "report.html")
    )
    assert "Mean RMS error over 3 recordings" in capsys.readouterr().out
    assert run(["demo", "-o", "made.csv"]) == 1


def test_demo_writes_over_nothing_but_its_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys.modules["poise.cli.demo"], "_DURATION", 6.0)
    monkeypatch.setattr("poise.comparison.available_peers", dict)
    monkeypatch.setattr("poise.comparison.methods_named", lambda: {"gated": poise.Gated()})
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", blank)  # which files there are does not depend on it
    monkeypatch.chdir(tmp_path)
    (tmp_path / "phone.csv").write_text("years of work")
    (tmp_path / "report.html").write_text("thesis")
    assert run(["demo", "-o", "."]) == 1
    told = capsys.readouterr().err
    assert "phone.csv, report.html" in told and "--output" in told
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {
        "phone.csv": "years of work",
        "report.html": "thesis",
    }
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "notes.txt").write_text("mine")
    written: list[set[str]] = []
    for _ in range(2):
        assert run(["demo", "-o", "other"]) == 0
        written.append({path.name for path in (tmp_path / "other").iterdir()})
    assert written[0] == written[1] == {*sys.modules["poise.cli.demo"]._FILES, ".poise-demo", "notes.txt"}
