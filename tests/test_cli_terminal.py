"""The command where it is run: a full disk behind stdout, terminals of ASCII, links in a circle. Never a traceback."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import poise
from poise.simulation import Sensor, forearm, measure


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    poise.write(measure(forearm(3.0), Sensor(), seed=1), tmp_path / "ü ☃.csv")
    return tmp_path


def ran(
    folder: Path, *arguments: str, stdout: int | None = subprocess.PIPE, **environment: str
) -> tuple[int, str, str]:
    found = subprocess.run(
        [sys.executable, "-m", "poise", *arguments], cwd=folder, env=os.environ | environment, check=False,
        stdout=stdout, stderr=subprocess.PIPE,
    )  # fmt: skip
    out, err = (found.stdout or b"").decode(errors="replace"), found.stderr.decode(errors="replace")
    assert "Traceback" not in err, err
    return found.returncode, out, err


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
@pytest.mark.parametrize("arguments", [["methods"], ["methods", "--json"], ["--help"], ["sniff", "ü ☃.csv"]])
def test_a_full_disk_behind_stdout_is_one_line(folder: Path, arguments: list[str]) -> None:
    with Path("/dev/full").open("w") as full:
        code, _, err = ran(folder, *arguments, stdout=full.fileno())
    assert code == 1 and err.count("\n") == 1
    assert err.startswith("poise: stdout cannot be written: No space left on device")


def test_a_terminal_of_ascii_gets_escapes(folder: Path) -> None:
    code, out, _ = ran(folder, "sniff", "ü ☃.csv", PYTHONIOENCODING="ascii")
    assert code == 0 and "\\u2603" in out


def test_a_system_of_ascii_keeps_names(folder: Path) -> None:
    """With LC_ALL=C and UTF-8 mode off a name's bytes come as surrogates, which no file and no font takes."""
    system = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    told = ["estimate", "ü ☃.csv", "-m", "tilt", "-o", "å.parquet", "--plot", "å.png"]
    code, _, err = ran(folder, *told, **system)
    assert code == 0, err
    assert (folder / "å.parquet").exists() and (folder / "å.png").exists()
    assert poise.formats.read_attitude(folder / "å.parquet").provenance.source.endswith("ü ☃.csv")


def test_links_in_a_circle_are_told(folder: Path) -> None:
    (folder / "one.csv").symlink_to("two.csv")
    (folder / "two.csv").symlink_to("one.csv")
    code, _, err = ran(folder, "estimate", "one.csv", "-m", "tilt")
    assert code == 1 and err.startswith("poise: one.csv: cannot be opened") and err.count("\n") == 1


def test_an_interrupt_while_it_is_loaded_is_quiet(folder: Path) -> None:
    """Ctrl-C before the command is there: as quiet as later, exit code 130."""
    script = (
        "import builtins, runpy\n"
        "real = builtins.__import__\n"
        "def interrupted(name, *rest, **more):\n"
        "    if name == 'cyclopts': raise KeyboardInterrupt\n"
        "    return real(name, *rest, **more)\n"
        "builtins.__import__ = interrupted\n"
        "runpy.run_module('poise.__main__', run_name='__main__')\n"
    )
    found = subprocess.run([sys.executable, "-c", script], cwd=folder, capture_output=True, text=True, check=False)
    assert found.returncode == 130 and not found.stderr
