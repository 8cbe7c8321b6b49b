"""Stamps in files: counters that begin anew, clocks and dates as text, and stamps that are too coarse."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import poise
from poise.data.stamps import Turns
from poise.formats import text

NAMES = "gx (rad/s),gy,gz,ax (m/s2),ay,az"


def table(path: Path, stamps: Iterable[object], name: str = "time") -> Path:
    """A sensor at rest whose first columns are *stamps* under *name*."""
    path.write_text("\n".join([f"{name},{NAMES}", *(f"{stamp},0.1,0.2,0.3,0,0,9.8" for stamp in stamps), ""]))
    return path


def same_in_chunks(path: Path, whole: poise.Recording, **options: object) -> None:
    for rows in (1, 7, 100):
        chunks = poise.read_chunks(path, rows, **options)
        parts = [part for _, part in zip(range(3), chunks, strict=False)]
        state = chunks.state()
        again = poise.read_chunks(path, rows, **options)
        again.go_on(state)
        found = poise.Recording.joined([*parts, *again])
        np.testing.assert_array_equal(found.time, whole.time)
        assert again.notes == whole.notes


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks so small that a short file has many."""
    monkeypatch.setattr(text, "_BLOCK", 999)


@pytest.mark.parametrize(
    ("name", "bits", "step", "unit"),
    [
        ("micros", 32, 10_000, 1e6),
        ("millis", 32, 10, 1e3),
        ("time (us)", 32, 10_000, 1e6),
        ("time", 16, 10, 1e3),
        ("micros", 16, 10_000, 1e6),
        ("SampleTimeFine", 32, 100, 1e4),
    ],
)
@pytest.mark.usefixtures("small")
def test_a_counter_that_begins_anew_goes_on(tmp_path: Path, name: str, bits: int, step: int, unit: float) -> None:
    first = 2**bits - 5 * step - 3
    path = table(tmp_path / "a.csv", [(first + i * step) % 2**bits for i in range(300)], name)
    recording = poise.read(path)
    np.testing.assert_allclose(recording.time, (first + np.arange(300) * step) / unit, rtol=1e-15)
    assert recording.rate_hz == pytest.approx(100)
    count = (first + 299 * step) // 2**bits
    times = f"{count} time{'s' * (count > 1)}"
    assert f"time: the counter begins anew at {2**bits}, {times}; the stamps go on" in recording.notes
    assert not any("do not rise" in note for note in recording.notes)
    same_in_chunks(path, recording)


@pytest.mark.parametrize(
    "stamps",
    [
        [*range(5_000_000, 8_000_000, 10_000), *range(0, 1_000_000, 10_000)],  # the logger was started anew
        [i / 10 for i in range(2**32 - 3000, 2**32, 10)] + [i / 10 for i in range(0, 1000, 10)],  # no integers
        [*range(-30_000, 65_530, 10), *range(3, 1000, 10)],  # no counter of 16 bits
        [*range(100, 65_530, 10), *range(100, 70_000, 10)],
    ],
)
def test_other_steps_back_stay(tmp_path: Path, stamps: list[float]) -> None:
    recording = poise.read(table(tmp_path / "a.csv", stamps))
    np.testing.assert_array_equal(recording.time, np.array(stamps) / (1e6 if max(stamps) == 7_990_000 else 1e3))
    assert any("1 stamps do not rise" in note for note in recording.notes)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(1, 40), min_size=1, max_size=60), st.data())
def test_turns_are_the_same_however_blocks_are_cut(steps: list[int], data: st.DataObject) -> None:
    true = np.cumsum(steps).astype(float)
    stamps = true % 100
    turns, at, parts = Turns([100.0], most=50.0), 0, []
    while at < len(stamps):
        size = data.draw(st.integers(1, 9))
        went_on = Turns([100.0], most=50.0)
        went_on.restore(turns.state())
        parts.append(turns.of(stamps[at : at + size]))
        np.testing.assert_array_equal(went_on.of(stamps[at : at + size]), parts[-1])
        at += size
    np.testing.assert_array_equal(np.concatenate(parts) - parts[0][0], true - true[0])


def test_stamps_that_are_none_stay(tmp_path: Path) -> None:
    turns = Turns([100.0], most=50.0)
    found = turns.of(np.array([98.0, np.nan, 1.0, np.inf, 4.0]))
    np.testing.assert_array_equal(found, [98.0, np.nan, 101.0, np.inf, 104.0])
    assert turns.passed == {100.0: 1}
