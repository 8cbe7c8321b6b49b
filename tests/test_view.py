"""``poise view``: recordings for the page of ``poise live``, over real HTTP."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

import poise
from live_helpers import METHOD, made
from poise.cli import run
from poise.cli.page import show_in_browser
from poise.data.flags import Flag
from poise.live.film import Film, FilmError, Strip, of_attitude, of_recording
from poise.live.frames import ATTITUDE, HEADER, records
from poise.simulation import Sensor, forearm, measure

pytest.importorskip("starlette", reason="the extra `live` is not installed")


def film(seconds: float = 4.0) -> tuple[Film, poise.Recording, poise.Attitude]:
    recording = made(seconds)
    attitude = poise.estimate(poise.AdaptiveGain(), recording)
    return of_recording(recording, [Strip(METHOD, attitude)]), recording, attitude


def test_a_frame_has_every_row_where_there_is_room() -> None:
    shown, recording, attitude = film()
    found = records(shown.frame(3, shown.start, shown.end, 10_000))
    assert len(found) == 2 * len(recording)  # the method and the reference
    first, second = found[: len(recording)], found[len(recording) :]
    np.testing.assert_array_equal(first["quat"], attitude.quat.astype("f4"))
    np.testing.assert_array_equal(first["gyr"], recording.gyr.astype("f4"))
    np.testing.assert_array_equal(first["valid"], attitude.valid)
    np.testing.assert_array_equal(first["flags"], attitude.flags)
    assert recording.truth is not None
    np.testing.assert_array_equal(second["quat"], recording.truth.quat.astype("f4"))
    assert set(found["device"]) == {3} and set(first["method"]) == {0} and set(second["method"]) == {1}
    described = shown.described(3)
    assert [each["reference"] for each in described["methods"]] == [False, True]
    wanted = poise.evaluate(attitude, recording).rmse_deg()
    assert described["methods"][0]["error_deg"] == pytest.approx(wanted._asdict())


def test_a_method_without_a_heading_has_the_error_of_its_inclination_only() -> None:
    recording = made(2.0)
    shown = of_recording(recording, [Strip("tilt", poise.estimate(poise.Tilt(), recording))])
    errors = shown.described(0)["methods"][0]["error_deg"]
    assert errors["total"] is None and errors["heading"] is None and errors["inclination"] > 0.0


def test_fewer_records_lose_no_flag() -> None:
    _, recording, attitude = film()
    flags = attitude.flags.copy()
    flags[123] |= np.uint32(Flag.GAP)
    marked = Film("marked", [Strip(METHOD, poise.data.attitude.Attitude.view(
        attitude.time, attitude.table, flags, attitude.heading_reference, attitude.provenance
    ))], recording)  # fmt: skip
    found = records(marked.frame(0, marked.start, marked.end, 10))
    assert len(found) == 10
    seen = found["flags_since"] & np.uint32(Flag.GAP)
    assert np.count_nonzero(seen) == 1 and not (found["flags"] & np.uint32(Flag.GAP)).any()
    assert any(each["flag"] == "GAP" and each["rows"] == 1 for each in marked.described(0)["methods"][0]["stretches"])


def test_a_window_is_the_rows_inside_it() -> None:
    shown, recording, _ = film()
    start, end = recording.time[100], recording.time[149]
    found = records(shown.frame(0, start, end, 1000))
    np.testing.assert_array_equal(found["time"][:50], recording.time[100:150])
    assert len(found) == 100
    assert len(records(shown.frame(0, end + 1e-5, end + 2e-5, 10))) == 0
    for bad in ((float("nan"), 1.0, 5), (2.0, 1.0, 5), (0.0, 1.0, 0), (0.0, 1.0, 10**6)):
        with pytest.raises(FilmError, match="expected start"):
            shown.frame(0, *bad)


def test_a_film_of_nothing_is_refused() -> None:
    with pytest.raises(FilmError, match="no row"):
        of_attitude("empty", poise.Attitude.of(np.empty(0), np.empty((0, 4))))
    with pytest.raises(FilmError, match="no row has a time"):
        of_attitude("timeless", poise.Attitude.of([np.nan], [[1.0, 0, 0, 0]]))


@contextmanager
def viewing(folder: Path, *arguments: str) -> Iterator[tuple[httpx.Client, subprocess.Popen[str]]]:
    """``poise view`` as a user starts it."""
    process = subprocess.Popen(
        [sys.executable, "-m", "poise", "view", *arguments, "--no-open"],
        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ | {"NO_COLOR": "1"},
    )  # fmt: skip
    try:
        assert process.stdout is not None
        line = process.stdout.readline()
        assert line.startswith("poise view on http://127.0.0.1:"), (line, process.stderr and process.stderr.read())
        yield httpx.Client(base_url=line.split()[3].removesuffix("?view"), timeout=20.0), process
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30.0)


def test_the_command_serves_methods_reference_and_monitor(tmp_path: Path) -> None:
    poise.write(measure(forearm(3.0, rate=50.0), Sensor(), seed=1), tmp_path / "walk.csv")
    (tmp_path / "monitor.toml").write_text("[tipover]\ndwell = 0.2\n")
    arguments = ("walk.csv", "-m", METHOD, "-m", "two-stage", "--set", "mag_noise=0.2", "--tipover", "monitor.toml")
    with viewing(tmp_path, *arguments) as (http, process):
        answer: dict[str, Any] = http.get("/films").json()
        (shown,) = answer["films"]
        assert [each["name"] for each in shown["methods"]][:2] == [METHOD, "two-stage"]
        assert "mag_noise" in shown["methods"][1]["settings"]
        assert dict(answer["flags"].values())["GAP"]
        body = http.get("/films/0/frame", params={"start": 0.5, "end": 1.5, "most": 20}).content
        assert HEADER.unpack_from(body)[2] == ATTITUDE.itemsize
        found = records(body)
        assert len(found) == 20 * len(shown["methods"])
        assert set(found["tip"][:40]) != {255}
        assert http.get("/films/9/frame").status_code == 404
        for wrong in ({"start": "x"}, {"most": "1e9"}, {"end": "nan"}):
            refused = http.get("/films/0/frame", params=wrong)
            assert refused.status_code == 400 and refused.json()["error"]
        assert http.get("/films", headers={"origin": "http://elsewhere.example"}).status_code == 403
        process.send_signal(signal.SIGINT)
        assert process.wait(20.0) == 0


@pytest.mark.parametrize(
    ("arguments", "status", "said"),
    [
        (["absent.csv"], 1, "absent.csv"),
        (["walk.csv", "-m", "nothing"], 2, "no method 'nothing'"),
        (["walk.csv", "--port", "70000"], 2, "--port"),
        (["walk.csv", "walk.csv"], 2, "twice"),
        (["walk.csv", "--port", "0", "other.csv"], 2, "'other.csv' is one too many; what has no name stands together"),
        (["walk.csv", "-m", METHOD, "--offline"], 2, "--offline"),
        (["walk.csv", "--tipover", "absent.toml"], 1, "absent.toml"),
    ],
)
def test_mistakes_are_told(
    arguments: list[str],
    status: int,
    said: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    poise.write(made(1.0), tmp_path / "walk.csv")
    assert run(["view", *arguments, "--no-open"]) == status
    assert said in capsys.readouterr().err


def test_a_port_that_is_taken_is_told_before_the_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    poise.write(made(1.0), tmp_path / "walk.csv")
    monkeypatch.setattr(sys.modules["poise.cli.view"], "_film", lambda *_: pytest.fail("it was estimated all the same"))
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        assert run(["view", str(tmp_path / "walk.csv"), "--port", str(port), "--no-open"]) == 1
    said = capsys.readouterr().err
    assert f"port {port}: another program listens there; give another --port" in said


@pytest.mark.parametrize(
    ("wanted", "terminal", "screen", "opens"),
    [
        (None, True, ":0", True),
        (None, False, ":0", False),
        (True, False, ":0", True),
        (True, True, "", False),
        (False, True, ":0", False),
    ],
)  # fmt: skip
def test_a_browser_is_opened_where_someone_sits(
    wanted: bool | None, terminal: bool, screen: str, opens: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    monkeypatch.setattr("sys.platform", "linux")
    monkeypatch.setattr("sys.stdout.isatty", lambda: terminal, raising=False)
    monkeypatch.setenv("DISPLAY", screen)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    show_in_browser("http://127.0.0.1:1/", wanted)
    assert opened == (["http://127.0.0.1:1/"] if opens else [])
