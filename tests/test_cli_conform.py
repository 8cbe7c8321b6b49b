"""conform as a user meets it: files, modules, names, and what is wrong with them."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from poise.cli import run

FILTER = '''
import numpy as np

print("hello from a script")

def run(time, gyr, acc, mag):
    """An attitude from acc and mag, north-west-up, Earth to body, x y z w."""
    from scipy.spatial.transform import Rotation
    up = acc / np.linalg.norm(acc, axis=1, keepdims=True)
    west = np.cross(up, mag)
    west /= np.linalg.norm(west, axis=1, keepdims=True)
    body = Rotation.from_matrix(np.stack([np.cross(west, up), west, up], axis=1))
    return body.inv().as_quat()

def broken(time, gyr, acc, mag):
    return np.zeros(0)[1]

def still(time, gyr, acc, mag):
    return np.tile([1.0, 0.0, 0.0, 0.0], (len(time), 1))

class Holder:
    run = staticmethod(run)
'''


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    (tmp_path / "my_filter.py").write_text(FILTER)
    (tmp_path / "crash.py").write_text("import numpy\n\nnumpy.no_such_thing\n")
    (tmp_path / "syntax.py").write_text("def run(:\n")
    (tmp_path / "leave.py").write_text("raise SystemExit(3)\n")
    yield tmp_path
    for name in ("my_filter", "crash", "syntax", "leave"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize("target", ["my_filter.py:run", "my_filter:run", "my_filter.py:Holder.run"])
def test_a_file_or_a_module(folder: Path, target: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["conform", target, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)  # what the script prints is not in it
    (found,) = document["results"]
    assert not document["errors"] and found["verdict"] == "conforms"
    told = found["convention"]
    assert (told["order"], told["direction"], told["frame"]) == ("xyzw", "Earth to body", "NWU")
    assert told["uses"] == ["acc", "mag"]


def test_the_adapter_is_a_program(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["conform", "my_filter.py:run"]) == 0
    out = capsys.readouterr().out
    assert "body to Earth" in out and "NWU" in out
    code = "import numpy as np" + out.partition("import numpy as np")[2]
    code += """
from poise.simulation import PERFECT, at_rest, measure
made = measure(at_rest((0.5, 0.5, -0.5, 0.5), duration=0.5), PERFECT)
print(abs(np.sum(attitude(made).quat[-1] * made.truth.quat[-1])))
"""
    (folder / "adapted.py").write_text(code)
    done = subprocess.run([sys.executable, "adapted.py"], capture_output=True, text=True, cwd=folder, check=True)
    assert float(done.stdout.split()[-1]) == pytest.approx(1.0, abs=1e-9)


def test_one_that_does_not_conform_is_exit_code_1(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["conform", "my_filter.py:still", "my_filter.py:broken", "my_filter.py:run"]) == 1
    captured = capsys.readouterr()
    assert "does not conform" in captured.out and "constant" in captured.out and "NWU" in captured.out
    (problem,) = [line for line in captured.err.splitlines() if line.startswith("poise:")]
    assert "my_filter.py:broken raised IndexError" in problem
    assert "(my_filter.py, line 16, in broken: return np.zeros(0)[1])" in problem


@pytest.mark.parametrize(
    ("target", "code", "says"),
    [
        ("nowhere.py:run", 1, "nowhere.py: no such file"),
        ("my_filter.py", 1, "which of it? my_filter.py:NAME; it has run, broken, still, Holder"),
        ("my_filter.py:walk", 1, "no 'walk' in it; it has run"),
        ("nowhere:run", 1, "no module 'nowhere' here"),
        ("a/b:run", 1, "neither a file ending in .py nor the name of a module"),
        ("crash.py:run", 1, "crash.py raised AttributeError"),
        ("crash:run", 1, "line 3"),
        ("syntax.py:run", 1, "syntax.py raised SyntaxError"),
        ("leave.py:run", 1, "leave.py raised SystemExit: 3"),
        ("vqf:NAME", 1, "vqf: no 'NAME' in it; it has "),
        ("vqf:NAME", 1, "plain vqf is that package as it is"),
        ("math:pi", 1, "math:pi is a float that cannot be called"),
        ("sys:maxsize", 1, "sys:maxsize is an int that cannot be called"),
        ("magic", 2, "expected FILE.py:NAME or MODULE:NAME, a method (self-calibrating"),
        (":", 2, "expected FILE.py:NAME"),
    ],
)
def test_what_is_wrong_is_one_line(
    folder: Path, target: str, code: int, says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["conform", target]) == code
    captured = capsys.readouterr()
    lines = [line for line in captured.err.splitlines() if line.startswith("poise:")]
    assert len(lines) == 1 and says in lines[0] and "Traceback" not in captured.err
    assert not captured.out


def test_a_rate_out_of_range_is_a_usage_error(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["conform", "my_filter.py:run", "--rate", "5"]) == 2
    assert "--rate 5: expected 10 to 2000" in capsys.readouterr().err


def test_a_method_by_its_name(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["conform", "two-stage", "--json"]) == 0
    (found,) = json.loads(capsys.readouterr().out)["results"]
    assert found["convention"]["frame"] == "ENU" and "poise.TwoStage()" in found["adapter"]
