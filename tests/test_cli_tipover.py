"""``poise tipover``: what people see, and what goes wrong."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poise
from data_files import data_path
from poise.cli import run
from poise.monitor import dry_run, judge
from tip_scenes import motion, recorded, times, toppling

pytest.importorskip("matplotlib")


@cache
def fall() -> poise.Recording:
    """A robot that falls to the left, on the ground at 5.8 s; with the reference."""
    time = times(9.0)
    return recorded(motion(time, toppling(time, 5.0), way="left"))


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    poise.write(replace(fall(), truth=None, moving=None), "fall.csv")
    time = times(5.0)
    poise.write(recorded(motion(time, 0.0 * time)), "stands.csv")
    return tmp_path


def said(capsys: pytest.CaptureFixture[str], *arguments: str, code: int = 0) -> Any:
    assert run(["tipover", *arguments, "-m", "tilt", "--json"]) == code
    return json.loads(capsys.readouterr().out)


def test_it_tells_what_would_have_been_triggered(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = said(capsys, "fall.csv", "stands.csv", "--falls", "5.8")["results"]
    one = found[0]
    assert [event["state"] for event in one["events"]] == ["upright", "leaning", "tipping", "fallen"]
    (alarm,) = one["alarms"]
    assert alarm["direction"] == "left" and alarm["true"] is True and 0.15 < alarm["lead"] < 0.4
    assert one["missed"] == [] and one["false_per_hour"] == 0.0
    expected = judge(poise.estimate(poise.Tilt(), poise.read("fall.csv")), poise.read("fall.csv"))
    assert [event["time"] for event in one["events"]] == [event.time for event in expected.events]
    assert [event["state"] for event in found[1]["events"]] == ["upright"] and found[1]["alarms"] == []
    assert len(found[1]["missed"]) == 1  # the same falls are asked of each file


def test_the_lead_is_not_known_where_nobody_saw_the_ground(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A gyroscope of 250 °/s clips in the fall, and the attitude is unknown until long after it."""
    recording = replace(fall(), truth=None, moving=None)
    most = np.radians(120.0)
    poise.write(replace(recording, gyr=np.clip(recording.gyr, -most, most)), "clipped.csv")
    attitude = poise.estimate(poise.Tilt(), poise.read("clipped.csv"))
    judgement = judge(attitude, poise.read("clipped.csv"))
    states = [event.state.name for event in judgement.events]
    assert states[states.index("TIPPING") + 1] == "UNKNOWN"
    first = dry_run(judgement).alarms[0]
    lost = next(event.time for event in judgement.events if event.time > first.event.time)
    assert np.isnan(first.lead) and np.isnan(first.ground)
    assert first.at_least == pytest.approx(lost - first.event.time) and "gyroscope's range" in first.doubt
    assert all(np.isnan(alarm.lead) for alarm in dry_run(judgement).alarms)  # nor of what is told after the loss
    (known,) = dry_run(judgement, [5.8]).alarms[:1]
    assert 0.15 < known.lead < 0.4 and known.doubt == ""  # the truth says when
    assert run(["tipover", "clipped.csv", "-m", "tilt", "--report"]) == 0
    out, err = capsys.readouterr()
    assert f"at least {first.at_least:.2f}" in out and "lead not known" in err and "gyroscope's range" in err
    (one,) = said(capsys, "clipped.csv")["results"]
    alarm = one["alarms"][0]
    assert alarm["lead"] is None and alarm["lead_at_least"] == pytest.approx(first.at_least)
    assert "gyroscope's range" in alarm["lead_unknown"]


def test_false_alarms_are_counted_by_the_hour(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (one,) = said(capsys, "fall.csv", "--falls", "none")["results"]
    assert [alarm["true"] for alarm in one["alarms"]] == [False]
    assert one["false_per_hour"] == pytest.approx(3600.0 / 9.0, rel=0.01)
    (one,) = said(capsys, "fall.csv")["results"]
    assert (
        [alarm["true"] for alarm in one["alarms"]] == [None] and one["falls"] is None and one["false_per_hour"] is None
    )
    assert 0.15 < one["alarms"][0]["lead"] < 0.4  # by the attitude judged


def test_a_reference_tells_falls_and_those_that_were_missed() -> None:
    recording = fall()
    attitude = poise.estimate(poise.Tilt(), recording)
    found = judge(attitude, recording)
    outcome = dry_run(found, recording.truth, recording)
    assert outcome.falls is not None and len(outcome.falls) == 1
    assert outcome.falls[0].ground == pytest.approx(5.8, abs=0.05)
    assert [alarm.true for alarm in outcome.alarms] == [True] and outcome.missed == []
    upright = poise.Attitude.of(attitude.time, np.tile([1.0, 0.0, 0.0, 0.0], (len(attitude), 1)))
    blind = dry_run(judge(upright, recording), recording.truth, recording)
    assert blind.alarms == [] and len(blind.missed) == 1
    wrong = dry_run(found, upright, recording)
    assert [alarm.true for alarm in wrong.alarms] == [False] and wrong.false_per_hour > 0.0
    lost = dry_run(found, poise.Attitude.of(attitude.time, np.full((len(attitude), 4), np.nan)), recording)
    assert [alarm.true for alarm in lost.alarms] == [None] and lost.hours == 0.0


def test_options_and_the_file_reach_the_monitor(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("robot.toml").write_text("[tipover]\nrange = 10\nself_balancing = 60\nlook_ahead = 0\n")
    (by_file,) = said(capsys, "fall.csv", "--config", "robot.toml")["results"]
    options = ["--range", "10", "--self-balancing", "60", "--look-ahead", "0"]
    (by_options,) = said(capsys, "fall.csv", *options)["results"]
    assert by_file["events"] == by_options["events"]
    (usual,) = said(capsys, "fall.csv")["results"]
    (more,) = said(capsys, "fall.csv", "--config", "robot.toml", "--range", "left=30")["results"]
    starts = [next(e["time"] for e in one["events"] if e["state"] == "leaning") for one in (by_file, usual, more)]
    assert starts == sorted(starts) and starts[0] < starts[1] < starts[2]
    (turned,) = said(capsys, "fall.csv", "--mount", "y -x z")["results"]
    assert turned["alarms"][0]["direction"] == "forward"
    (tared,) = said(capsys, "fall.csv", "--tare", "1,4")["results"]
    assert tared["events"][0]["tilt_deg"] < 0.3 < usual["events"][0]["tilt_deg"]


def test_tables_and_a_picture(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["tipover", "fall.csv", "stands.csv", "-m", "tilt", "--report", "--plot", "out", "--falls", "5.8"]
    assert run(arguments) == 1
    assert "folder out does not exist" in capsys.readouterr().err
    Path("out").mkdir()
    assert run(arguments) == 0
    out, err = capsys.readouterr()
    for words in ("what would have been told", "to the left", "ground at s", "a fall", "How long it was in each state"):
        assert words in out
    assert "stands.csv: no alarm" in err and "missed: a fall at 5.80 s" in err
    for name in ("fall", "stands"):
        assert Path(f"out/{name}.tipover.png").read_bytes().startswith(b"\x89PNG")


def test_an_attitude_is_judged_without_specific_force(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["estimate", "fall.csv", "-m", "tilt", "-o", "a.parquet"]) == 0
    capsys.readouterr()
    assert run(["tipover", "a.parquet"]) == 0
    out, err = capsys.readouterr()
    assert "tipping" in out and "free fall and picking up are not told" in err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--range", "0"], "empty range"),
        (["--range", "wide"], "--range 'wide': expected degrees"),
        (["--range", "ahead=3"], "range.ahead"),
        (["--range", "50"], "beyond the largest self-balancing angle"),
        (["--dwell", "-1"], "--dwell: expected 0 to inf s, found -1"),
        (["--dwell", "nan"], "--dwell: expected a number (s)"),
        (["--range", "200"], "--range: expected degrees above 0, up to 90, found 200"),
        (["--range", "left=120"], "--range.left: expected degrees above 0, up to 90, found 120"),
        (["--impact", "181"], "--impact: expected 0 to 180 degrees, found 181"),
        (["--hysteresis", "-1"], "--hysteresis: expected 0 degrees or more, found -1"),
        (["--range", "2"], "--hysteresis: 3° leaves nothing of the range forward, 2°"),
        (["--self-balancing", "85"], "comes before the largest self-balancing angle"),
        (["--tare", "-5,2"], "--tare -5,2: expected START,END"),
        (["--mount", "x y"], "axes 'x y'"),
        (["--tare", "5"], "--tare 5: expected START,END"),
        (["--tare", "5,2"], "the start first"),
        (["--falls", "often"], "--falls 'often'"),
        (["--falls", "nan"], "--falls 'nan'"),
        (["--falls", "999"], "--falls 999: fall.csv lasts from 0.00 to "),
        (["--config", "absent.toml"], "--config absent.toml: cannot be read"),
        (["--config", "fall.csv"], "no TOML file"),
        (["--plot", "picture.txt"], "--plot"),
        (["fall.csv"], "twice"),
        (["--method", "none"], "no method 'none'"),
    ],
)
def test_usage_is_refused_in_one_line(
    here: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], words: str
) -> None:
    assert run(["tipover", "fall.csv", *arguments]) == 2
    out, err = capsys.readouterr()
    assert words in err and err.count("\n") == 1 and not out


def test_a_bad_file_beside_a_good_one(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("empty.csv").write_text("")
    Path("header.csv").write_text("time[s],gx[rad/s],gy[rad/s],gz[rad/s],ax[m/s^2],ay[m/s^2],az[m/s^2]\n")
    assert run(["tipover", "empty.csv", "header.csv", "stands.csv", "-m", "tilt"]) == 1
    out, err = capsys.readouterr()
    assert "stands.csv" in out and "empty.csv" in err and "header.csv" in err and "Traceback" not in err
    assert run(["tipover", "fall.csv", "-m", "tilt", "--tare", "5,6"]) == 1
    assert "tare: the robot moves by" in capsys.readouterr().err
    assert run(["tipover", "fall.csv", "-m", "tilt", "--tare", "50,60"]) == 1
    assert "no row between these seconds" in capsys.readouterr().err


def test_nothing_but_nan_is_unknown_throughout(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = np.full((300, 4), np.nan)
    poise.write(poise.Attitude.of(times(1.5), table), "nan.parquet")
    assert run(["tipover", "nan.parquet", "--report", "--plot", "nan.png", "--falls", "none"]) == 1
    out, err = capsys.readouterr()
    assert "no alarm" not in err and "nan.parquet: nothing was judged" in err and Path("nan.png").exists()
    assert "not judged" in out and "0.00 │" not in out
    assert run(["tipover", "nan.parquet", "--falls", "none", "--json"]) == 1
    found = json.loads(capsys.readouterr().out)
    (one,) = found["results"]
    assert one["judged"] == 0.0 and one["false_per_hour"] is None and found["errors"][0]["file"] == "nan.parquet"
    assert one["events"] == [] and one["seconds"]["upright"] == 0.0 and one["least_margin_deg"] is None


def test_what_could_not_be_judged_is_told(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The second half of a recording has no sample: that no alarm came of it says nothing."""
    time = times(20.0)
    stands = recorded(motion(time, 0.0 * time))
    gyr, acc = stands.gyr.copy(), stands.acc.copy()
    gyr[len(time) // 2 :] = acc[len(time) // 2 :] = np.nan
    poise.write(replace(stands, gyr=gyr, acc=acc, truth=None, moving=None), "half.csv")
    assert run(["tipover", "half.csv", "-m", "tilt", "--falls", "none"]) == 0
    err = capsys.readouterr().err
    assert "half.csv: 4" in err and "% of it was not judged, and no alarm could come there" in err
    recording = poise.read("half.csv")
    judgement = judge(poise.estimate(poise.Tilt(), recording), recording)
    known = 3600.0 * dry_run(judgement, []).hours
    assert 9.0 < known < 12.0 and known == pytest.approx(
        20.0 * said(capsys, "half.csv")["results"][0]["judged"], abs=0.1
    )


def test_a_false_alarm_has_no_ground(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["tipover", "fall.csv", "-m", "tilt", "--falls", "none", "--report"]) == 0
    out = capsys.readouterr().out
    assert "the ground as the truth has it" in out
    (row,) = [line for line in out.splitlines() if line.rstrip().endswith("false │")]
    assert [cell.strip() for cell in row.split("│")[3:5]] == ["-", "-"]
    assert out.count("fallen ┃") == 1  # how long it was in each state is told once
    (one,) = said(capsys, "fall.csv", "--falls", "none")["results"]
    assert one["alarms"][0]["ground"] is None and one["alarms"][0]["true"] is False


def test_options_may_begin_with_a_minus(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["tipover", "stands.csv", "-m", "tilt", "--mount", "-y x z"]) == 0
    assert "stands" in capsys.readouterr().out


def test_a_method_means_nothing_to_an_attitude(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["estimate", "stands.csv", "-m", "tilt", "-o", "stands.parquet"]) == 0
    capsys.readouterr()
    for command in (["tipover"], ["plot"], ["evaluate", "--reference", "stands.csv"]):
        assert run([*command, "stands.parquet", "-m", "gated"]) == 2
        assert "--method: stands.parquet is an attitude already" in capsys.readouterr().err


def test_the_optical_reference_of_a_real_trial_agrees(capsys: pytest.CaptureFixture[str]) -> None:
    path = next(data_path("broad").glob("03_*.mat"))
    assert run(["tipover", str(path), "--tare", "0,2", "--json"]) == 0
    (one,) = json.loads(capsys.readouterr().out)["results"]
    assert len(one["falls"]) >= 5 and one["missed"] == [] and one["false_per_hour"] == 0.0
