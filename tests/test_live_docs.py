"""The examples of docs/live.md as they stand, but for the port, and the command `poise live`."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

import poise
from live_helpers import METHOD, made, serving
from poise.cli import run
from poise.live.described import Description
from poise.live.replay import Replay

TEXT = (Path(__file__).parents[1] / "docs" / "live.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return [part.partition("```")[0] for part in TEXT.split(f"```{language}\n")[1:]]


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with serving(Replay(made(30.0), "walk", loop=True)) as live:
        yield live.address


def test_the_ten_lines_print_attitudes(address: str) -> None:
    (client,) = blocks("python")
    assert len([line for line in client.splitlines() if line.strip()]) <= 11
    code = client.replace("127.0.0.1:8760", address)
    with subprocess.Popen([sys.executable, "-u", "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        lines = [process.stdout.readline() for _ in range(5)]
        process.kill()
    assert all(line.startswith("0 ") and line.endswith(("True\n", "False\n")) for line in lines)


def test_curl(address: str) -> None:
    if shutil.which("curl") is None:
        pytest.skip("curl is not installed")
    (command,) = (line for block in blocks("sh") for line in block.splitlines() if line.startswith("curl"))
    shell = command.partition("#")[0].replace("127.0.0.1:8760", address)
    answer = subprocess.run(shell, shell=True, capture_output=True, text=True, check=True, timeout=30)
    assert '"quat_wxyz":[' in answer.stdout


def test_the_descriptions_are_descriptions() -> None:
    text, binary, ble = (Description.of(tomllib.loads(block)) for block in blocks("toml"))
    assert ble.characteristic.startswith("0000a001-")
    assert (ble.layout, ble.sync) == ("<hhhhhh", b"")
    assert text.device == "glove"
    assert binary.layout == "<hhhhhh"


def test_live_serves_until_it_is_told_to_end(tmp_path: Path) -> None:
    poise.write(made(20.0), tmp_path / "walk.csv")
    environment = os.environ | {"POISE_TOKEN": "a-token-of-some-length"}
    command = [
        sys.executable,
        "-m",
        "poise",
        "live",
        f"replay:{tmp_path / 'walk.csv'}@max",
        "--port",
        "0",
        "-m",
        METHOD,
    ]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment, bufsize=1
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert "poise live on http://127.0.0.1:" in process.stdout.readline()
        seen = []
        while "come to its end" not in (line := process.stderr.readline()):
            seen.append(line)
        process.send_signal(signal.SIGTERM)
        out, err = process.communicate(timeout=30)
    assert process.returncode == 0
    assert "ended: 2000 samples" in out
    assert "Traceback" not in err
    assert "a-token" not in "".join([*seen, out, err])


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--host", "0.0.0.0"], "give --token"),
        (["--host", "nowhere.invalid", "--token", "x" * 20], "no such address"),
        (["--port", "70000"], "--port 70000"),
        (["--token", "short"], "16 to 256"),
        (["-m", "magic"], "no method 'magic'"),
        (["-m", METHOD, "--set", "magic=1"], "--set 'magic=1'"),
        (["usb:1"], "is no source"),
        (["replay:nowhere.csv"], "nowhere.csv"),
        (["--max-rate", "0"], "--max-rate"),
        (["--describe", "nowhere.toml"], "nowhere.toml"),
    ],
)
def test_what_cannot_be_is_said_in_one_line(
    arguments: list[str], says: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("POISE_TOKEN", raising=False)
    assert run(["live", *arguments]) in (1, 2)
    err = capsys.readouterr().err
    assert says in err
    assert err.count("\n") == 1
