"""docs/responses.md: its configuration and its program, run as they stand, and all keys in it."""

from __future__ import annotations

import json
import math
import re
import signal
import subprocess
import sys
import tomllib
from dataclasses import fields
from pathlib import Path
from typing import Any

import pytest

from poise.cli import run
from poise.monitor.settings import read_settings
from poise.responses import RESPONDERS, load_config
from poise.responses.config import _STAGE, _TOP
from programs import broker, hook, program, until

PAGE = (Path(__file__).parents[1] / "docs" / "responses.md").read_text(encoding="utf-8")
CONFIG = PAGE.partition("```toml\n")[2].partition("```")[0]
CODE = PAGE.partition("```python\n")[2].partition("```")[0]


def test_every_key_there_is_stands_in_the_example() -> None:
    shown = tomllib.loads(CONFIG.replace("# wav", "wav"))
    assert set(shown) == set(_TOP)
    assert {key for stage in shown["stages"] for key in stage} == set(_STAGE)
    for kind, cls in RESPONDERS.items():
        keys = {key for table in shown["responders"].values() if table["type"] == kind for key in table}
        missing = {each.name for each in fields(cls)} - {"name", "if_failed"} - keys
        assert not missing, f"{kind}: {missing}"


def test_the_configuration_and_the_program_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    gpiozero = pytest.importorskip("gpiozero")
    pytest.importorskip("paho.mqtt")
    program("espeak-ng")
    from gpiozero.pins.mock import MockFactory

    board = MockFactory()
    monkeypatch.setattr(gpiozero.Device, "pin_factory", board)
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    monkeypatch.setenv("ALARM_TOKEN", "abc")
    monkeypatch.chdir(tmp_path)
    with broker(tmp_path) as server, hook() as web:
        text = CONFIG.replace("port = 1883", f"port = {server.port}").replace("https://example.org/alarms", web.url)
        text = text.replace('"localhost"', '"127.0.0.1"').replace("systemctl", "true").replace("# wav", "wav")
        (tmp_path / "robot.toml").write_text(text)
        assert load_config("robot.toml").name == "robot 7"
        assert read_settings("robot.toml").range.forward == pytest.approx(math.radians(25.0))  # one file for both
        assert run(["respond", "--config", "robot.toml", "--test"]) == 0, capsys.readouterr()
        seen: dict[str, Any] = {}
        exec(CODE.replace("    ...\n", "    active = responses.active\n    responses.wait()\n"), seen)
        assert seen["active"] == ("fall",) and seen["responses"].failures == ()
        assert [body["kind"] for _, body in web.got] == ["test", "fired"]
    assert (tmp_path / "said.wav").stat().st_size > 20_000
    assert True in [bool(each.state) for each in board.pin(17).states]
    kinds = [json.loads(line)["kind"] for line in (tmp_path / "alarms.jsonl").read_text().splitlines()]
    assert kinds == ["test", "started", "released", "event", "fired", "event", "acknowledged", "closed"]


def test_a_service_that_is_stopped_cuts_the_power(tmp_path: Path) -> None:
    """With the line for SIGTERM that the page has."""
    pytest.importorskip("gpiozero")
    (line,) = re.findall(r"^signal\.signal\(.*$", CODE, re.MULTILINE)
    code = f"""
import signal, sys, time
from gpiozero.pins.mock import MockFactory, MockPin
import gpiozero
from poise.responses import Responses, config_of

class Told(MockPin):
    def _change_state(self, value):
        print("pin", value, flush=True)
        return super()._change_state(value)

gpiozero.Device.pin_factory = MockFactory(pin_class=Told)
{line}
power = {{"type": "relay", "pin": 17, "active_high": True}}
with Responses(config_of({{"responders": {{"power": power}}, "stages": [{{"state": "tipping", "fire": ["power"]}}]}})):
    print("ready", flush=True)
    time.sleep(60)
"""
    robot = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert robot.stdout is not None
    try:
        told = ""
        while "ready" not in told:
            told += robot.stdout.readline()
        robot.terminate()
        assert "pin True" in robot.communicate(timeout=30)[0]
        assert until(lambda: robot.returncode == 0)
    finally:
        robot.kill()
        robot.wait()
