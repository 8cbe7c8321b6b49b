"""``poise respond`` as a robot builder meets it: a configuration checked, tried, and proven."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from poise.cli import run
from programs import broker, program, subscriber, until

CONFIG = """
[responders.power]
type = "relay"
pin = 17
active_high = true
[responders.voice]
type = "voice"
wav = "said.wav"
[responders.stop]
type = "command"
argv = ["touch", "FOLDER/stopped"]
[responders.log]
type = "log"
file = "alarms.jsonl"
[[stages]]
state = "tipping"
fire = ["power", "voice", "stop"]
repeat = 5.0
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a configuration, on a machine with a mock board."""
    gpiozero = pytest.importorskip("gpiozero")
    program("espeak-ng")
    monkeypatch.setattr(gpiozero.Device, "pin_factory", None)
    monkeypatch.setenv("GPIOZERO_PIN_FACTORY", "mock")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "robot.toml").write_text(CONFIG.replace("FOLDER", str(tmp_path)))
    return tmp_path


def test_a_check_touches_nothing(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import gpiozero

    assert run(["respond", "--config", "robot.toml"]) == 0
    text = capsys.readouterr().out
    assert text.count("ready") == 4 and "a mock: nothing moves" in text and "every 5 s" in text
    assert [path.name for path in folder.iterdir()] == ["robot.toml"]
    assert gpiozero.Device.pin_factory.pins == {}


def test_a_test_tells_and_with_fire_it_acts(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import gpiozero

    assert run(["respond", "-c", "robot.toml", "--test"]) == 0
    assert "not tested: --fire" in capsys.readouterr().out
    assert (folder / "said.wav").stat().st_size > 20_000 and not (folder / "stopped").exists()
    assert json.loads((folder / "alarms.jsonl").read_text())["kind"] == "test"
    assert gpiozero.Device.pin_factory.pins == {}

    assert run(["respond", "-c", "robot.toml", "--test", "--fire", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert all(each["fired"] and each["problem"] is None for each in found["responders"])
    assert (folder / "stopped").exists()
    levels = [bool(each.state) for each in gpiozero.Device.pin_factory.pin(17).states]
    assert levels[:3] == [False, True, False]


def test_what_does_not_work_is_said_in_one_line_each(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (folder / "robot.toml").read_text()
    (folder / "robot.toml").write_text(text.replace("pin = 17", "pin = 77").replace('"touch"', '"tuoch"'))
    assert run(["respond", "-c", "robot.toml", "--test", "--fire"]) == 1
    out, err = capsys.readouterr()
    lines = err.strip().splitlines()
    assert len(lines) == 2 and "power.pin" in lines[0] and "tuoch is not there" in lines[1]
    assert out.count("FAILED") == 2 and out.count("tested") == 2  # the others are tried all the same


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["respond"], 2, "--config"),
        (["respond", "-c", "absent.toml"], 1, "absent.toml"),
        (["respond", "-c", "wrong.toml"], 1, "did you mean 'relay'?"),
        (["respond", "-c", "robot.toml", "--fire"], 2, "--test"),
    ],
)
def test_usage(folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], code: int, says: str) -> None:
    (folder / "wrong.toml").write_text(CONFIG.replace('"relay"', '"rely"'))
    assert run(arguments) == code
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert says in line


def test_a_test_message_leaves_the_alarm_that_holds_alone(folder: Path) -> None:
    pytest.importorskip("paho.mqtt")
    with broker(folder) as server, subscriber(server.port, "#") as got:
        (folder / "mqtt.toml").write_text(
            f'[responders.mqtt]\ntype = "mqtt"\nbroker = "127.0.0.1"\nport = {server.port}\n'
            '[[stages]]\nstate = "tipping"\nfire = ["mqtt"]\n'
        )
        assert run(["respond", "-c", "mqtt.toml", "--test"]) == 0
        assert until(lambda: any(topic == "poise/test" for topic, *_ in got))
        with subscriber(server.port, "#") as late:
            assert until(lambda: late)
        assert not any(topic == "poise/test" for topic, *_ in late)
