"""Where the recordings for tests are: POISE_DATA, or ../shared/data beside the checkout."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import poise

ROOT = Path(os.environ.get("POISE_DATA") or Path(__file__).parents[2] / "shared" / "data")


def data_path(*parts: str) -> Path:
    """The recording at *parts* below the data folder; where it is absent the test skips, and fails in CI."""
    path = ROOT.joinpath(*parts)
    if not path.exists():
        reason = f"no {Path(*parts)} below {ROOT} (POISE_DATA says where the recordings are)"
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)
    return path


def trial(name: str, start: float, end: float) -> poise.Recording:
    """The BROAD trial *name* from *start* to *end*, s."""
    recording = poise.read(data_path("broad", f"{name}.mat"))
    return recording.between(recording.time[0] + start, recording.time[0] + end)
