"""Every example runs as it stands."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import poise
from poise.simulation import Sensor, forearm, measure

EXAMPLES = sorted((Path(__file__).parents[1] / "examples").glob("*.py"))


def test_the_lines_in_the_readme_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")
    code = text.partition("```python\n")[2].partition("```")[0]
    monkeypatch.chdir(tmp_path)
    made = measure(forearm(6.0), Sensor(), seed=1)
    made = poise.Recording(made.time + 1.7e9, made.gyr, made.acc, made.mag)
    poise.write(made, "walk.csv")
    seen: dict[str, Any] = {}
    exec(code, seen)
    assert seen["latest"].valid.all()
    assert poise.read_attitude("walk.parquet").frame == "ned"
    assert len(poise.read_attitude("walk.bag")) == len(made)


@pytest.mark.parametrize("example", EXAMPLES, ids=[path.stem for path in EXAMPLES])
def test_the_example_runs(example: Path, tmp_path: Path) -> None:
    result = subprocess.run(
        [sys.executable, str(example)], cwd=tmp_path, capture_output=True, text=True, timeout=180, check=False
    )
    assert result.returncode == 0, result.stderr
    assert result.stdout
    assert "nan" not in result.stdout.lower()
