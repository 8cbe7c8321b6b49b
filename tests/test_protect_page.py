"""docs/protect-your-robot.md: every command of it, as it stands but for the serial port."""

from __future__ import annotations

import json
import os
import pty
import re
import shlex
import signal
import subprocess
import sys
import threading
import tty
from importlib.util import find_spec
from pathlib import Path

import pytest

from poise.cli import run

PAGE = (Path(__file__).parents[1] / "docs" / "protect-your-robot.md").read_text(encoding="utf-8")
pytestmark = pytest.mark.skipif(
    not all(map(find_spec, ("mujoco", "gpiozero", "serial"))) or sys.platform != "linux",
    reason="needs poise[sim,respond,live] and ptys",
)


def blocks(language: str) -> list[str]:
    return [part.partition("```")[0] for part in PAGE.split(f"```{language}\n")[1:]]


def commands() -> list[list[str]]:
    return [shlex.split(line)[1:] for block in blocks("sh") for line in block.splitlines()]


def test_the_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("GPIOZERO_PIN_FACTORY", "mock")
    exec(blocks("python")[0], {})
    impact = float(re.findall(r"ground at ([\d.]+) s", capsys.readouterr().out)[0])
    assert Path("log.csv").read_text().splitlines()[0] == blocks("text")[0].splitlines()[0]
    for name, text in zip(("robot.toml", "mpu6050.toml"), blocks("toml"), strict=True):
        Path(name).write_text(text)
    *dry, live = commands()
    assert [command[0] for command in dry] == ["doctor", "tipover", "tipover", "respond"] and live[0] == "live"
    for command in dry:
        assert run(command) == 0, capsys.readouterr()
        told = capsys.readouterr().out
        if command[0] == "tipover":
            assert told.count("tipping") >= 1
    assert run([*dry[2], "--json"]) == 0
    alarms = re.findall(r'"time": ([\d.]+)[^{}]*"state": "tipping"', capsys.readouterr().out)
    assert any(impact - 1.0 < float(time) < impact for time in alarms)
    assert Path("moment.png").stat().st_size > 5000
    Path("alarms.jsonl").unlink()
    told_live = _live(live)
    assert "Traceback" not in told_live
    fired = [json.loads(line) for line in Path("alarms.jsonl").read_text().splitlines()]
    assert "fired" in [line["kind"] for line in fired], told_live


def _live(command: list[str]) -> str:
    """Run *command* at a pty that the log is written to in its own time; what it printed."""
    master, slave = pty.openpty()
    tty.setraw(slave)
    port = os.ttyname(slave)
    words = [word.replace("/dev/ttyUSB0", port) for word in command]
    stop = threading.Event()

    def feed() -> None:
        lines = Path("log.csv").read_text().splitlines()[1500:]
        for line in lines:
            os.write(master, f"{line}\n".encode())
            if stop.wait(0.01):
                return

    process = subprocess.Popen(
        [sys.executable, "-m", "poise", *words, "--port", "0"],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    seen = ""
    try:
        while "poise live on" not in seen and (line := process.stdout.readline()):
            seen += line
        feeding = threading.Thread(target=feed)
        feeding.start()
        feeding.join()
        stop.wait(2.0)
        process.send_signal(signal.SIGINT)
        return seen + process.communicate(timeout=60)[0]
    finally:
        stop.set()
        process.kill()
        process.wait()
        os.close(master)
        os.close(slave)
