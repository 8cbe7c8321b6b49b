"""compare, plot and demo as a user meets them."""

from __future__ import annotations

import csv
import json
import shlex
import sys
from dataclasses import replace
from pathlib import Path

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


def test_compare_json_with_good_and_bad_files(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["made.csv", "blind.csv", "empty.csv", "nowhere.csv", "-m", "two-stage", "-m", "tilt", "--json"]
    assert run(["compare", *arguments, "--report", "out/all.html"]) == 1
    captured = capsys.readouterr()
    document = json.loads(captured.out)
    assert [result["against"] for result in document["results"]] == ["reference", "consensus"]
    assert [error["file"] for error in document["errors"]] == ["empty.csv", "nowhere.csv"]
    assert len(captured.err.strip().splitlines()) == 2
    assert {row["name"] for row in document["mean_rms_deg"]} == {"two-stage", "tilt"}
    expected = poise.evaluate(poise.estimate(poise.TwoStage(), poise.read("made.csv")), poise.read("made.csv"))
    assert document["results"][0]["estimators"][0]["error_deg"]["total"] == expected.table()["total"]
    page = (folder / "out" / "all.html").read_text(encoding="utf-8")
    assert "nowhere.csv" in page and "poise compare made.csv blind.csv" in page


def test_compare_tells_and_draws(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["compare", "blind.csv", "-m", "two-stage", "-m", "gated", "--limit", "0.1", "--plot", "a.svg"]) == 0
    captured = capsys.readouterr()
    assert "Distance from the consensus" in captured.out and "is off the consensus" in captured.out
    assert "neither can be blamed" in captured.err and "inclination only" in captured.err
    assert (folder / "a.svg").read_bytes().startswith(b"<?xml")


def test_the_command_in_the_report_makes_it_again(folder: Path) -> None:
    odd = folder / "it's $(odd).csv"
    (folder / "made.csv").rename(odd)
    assert run(["compare", odd.name, "-m", "gated", "--rate", "100", "--report", "a.html"]) == 0
    page = (folder / "a.html").read_text(encoding="utf-8")
    from html import unescape

    command = unescape(page.split("<pre><code>")[1].split("</code>")[0])
    words = shlex.split(command)
    assert words[:3] == ["poise", "compare", odd.name] and "gated" in words and "--rate" in words
    (folder / "a.html").unlink()
    assert run(words[1:]) == 0 and (folder / "a.html").exists()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["compare", "made.csv", "-m", "magic"], "no method 'magic'; there are"),
        (["compare", "made.csv", "--with", "magic"], "no peer or package called 'magic'"),
        (["compare", "made.csv", "--limit", "0"], "--limit"),
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
    assert run(["plot", "made.csv", "blind.csv", "a.parquet", "empty.csv", "-o", "pictures", "--json"]) == 1
    document = json.loads(capsys.readouterr().out)
    assert [result["drawn"].split()[0] for result in document["results"]] == ["sensors", "sensors", "attitude"]
    assert sorted(path.name for path in (folder / "pictures").iterdir()) == ["a.png", "blind.png", "made.png"]


def test_an_unwritable_report_is_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["compare", "made.csv", "-m", "gated", "--report", "empty.csv/a.html"]) == 1
    assert "is a file, not a folder" in capsys.readouterr().err


def test_demo_writes_everything(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys.modules["poise.cli.demo"], "_DURATION", 6.0)
    monkeypatch.setattr("poise.comparison.available_peers", dict)
    assert run(["demo", "-o", "shown"]) == 0
    names = {path.name for path in (folder / "shown").iterdir()}
    made = {f"{name}.{kind}" for name in ("forearm", "phone", "robot") for kind in ("csv", "png", "comparison.png")}
    assert names == made | {"report.html", "table.csv", "comparison.json", ".poise-demo"}
    rows = list(csv.DictReader((folder / "shown" / "table.csv").open()))
    assert len(rows) == 3 * len(poise.METHODS)
    assert all(float(row["inclination_rmse_deg"]) < 10.0 for row in rows)
    assert "Mean RMS error over 3 recordings" in capsys.readouterr().out
    assert run(["demo", "-o", "made.csv"]) == 1


def test_demo_writes_over_nothing_but_its_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys.modules["poise.cli.demo"], "_DURATION", 6.0)
    monkeypatch.setattr("poise.comparison.available_peers", dict)
    monkeypatch.setattr("poise.comparison.methods_named", lambda: {"gated": poise.Gated()})
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
