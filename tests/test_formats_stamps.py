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
from poise.errors import FormatError
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


MIDDAY = "{h:02d}:{m:02d}:{s:06.3f}"
FORMS = {
    "10:11:12.345": (MIDDAY, 0.0),
    "comma": (MIDDAY.replace("{s:06.3f}", "{s:02.0f},{ms:03d}"), 0.0),
    "04-May-2023": ("04-May-2023 " + MIDDAY, 1683158400.0),
    "4 MAR 2024": ("4 MAR 2024 " + MIDDAY, 1709510400.0),
    "2023/05/04": ("2023/05/04 " + MIDDAY, 1683158400.0),
    "2023-5-4T": ("2023-5-4T" + MIDDAY, 1683158400.0),
}


def written(form: str, seconds: float) -> str:
    milli = round(seconds * 1e3) % 86_400_000
    hour, minute, second = milli // 3_600_000, milli // 60_000 % 60, milli % 60_000 / 1e3
    if ",{ms" in form:
        return form.format(h=hour, m=minute, s=second // 1, ms=milli % 1000)
    return form.format(h=hour, m=minute, s=second)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.usefixtures("small")
def test_stamps_in_words(tmp_path: Path, form: str) -> None:
    pattern, day = FORMS[form]
    stamps = [written(pattern, 36672.5 + i / 100) for i in range(200)]
    path = tmp_path / "a.csv"
    lines = [f"{stamp};0.1;0.2;0.3;0;0;9.8" for stamp in stamps]
    path.write_text("\n".join([f"time;{NAMES.replace(',', ';')}", *lines, ""]))
    recording = poise.read(path)
    np.testing.assert_allclose(recording.time, day + 36672.5 + np.arange(200) / 100, atol=3e-7, rtol=0)
    same_in_chunks(path, recording)


@pytest.mark.usefixtures("small")
def test_a_clock_passes_midnight(tmp_path: Path) -> None:
    stamps = [written(MIDDAY, 86399.0 + i / 100) for i in range(200)]
    stamps[50] = ""
    path = table(tmp_path / "a.csv", stamps)
    recording = poise.read(path)
    wanted = 86399.0 + np.arange(200) / 100
    wanted[50] = np.nan
    np.testing.assert_allclose(recording.time, wanted, atol=1e-9, rtol=0)
    assert "time: it passes midnight, 1 time; the stamps go on" in recording.notes
    same_in_chunks(path, recording)


def test_a_date_in_a_column_of_its_own(tmp_path: Path) -> None:
    stamps = [f"{'31-Dec-2023' if i < 100 else '01-Jan-2024'},{written(MIDDAY, 86399.0 + i / 100)}" for i in range(200)]
    path = table(tmp_path / "a.csv", stamps, "Date,Time")
    recording = poise.read(path)
    np.testing.assert_allclose(recording.time, 1704067199.0 + np.arange(200) / 100, atol=3e-7, rtol=0)
    assert not any("not used" in note or "midnight" in note for note in recording.notes)
    path = table(tmp_path / "b.csv", [f"04/05/2023,{written(MIDDAY, i / 100)}" for i in range(30)], "Date,Time")
    ambiguous = poise.read(path)  # two days it may be: the clock is enough
    assert ambiguous.time[1] == pytest.approx(0.01) and ambiguous.notes[-1] == "not used: Date"
    path = table(tmp_path / "c.csv", [f"2023-05-04,{i / 100}" for i in range(30)], "date,time")
    assert poise.read(path).time[1] == 0.01  # a time that is none of a day


@pytest.mark.parametrize(
    ("stamps", "reason"),
    [
        (["04/05/2023 10:11:12.3"] * 9, r"line 2, column 1 \(time\).*expected stamps like .*--rate HZ"),
        (["10:11:12.3 PM"] * 9, r"line 2, column 1 \(time\).*expected stamps like .*--rate HZ"),
        (["10:11:12.3", "10:11"], r"line 3, column 1 \(time\): found '10:11'.*--rate HZ"),
        (["10:61:12.3"], "names a day or time that is none"),
        (["30-Feb-2023 10:11:12.3"], "names a day or time that is none"),
        (["4-Mai-2023 10:11:12.3"], "names a day or time that is none"),
        (["2023/13/04 10:11:12.3"], "names a day or time that is none"),
    ],
)
def test_stamps_that_cannot_be_read_are_refused_and_rate_leaves_them_out(
    tmp_path: Path, stamps: list[str], reason: str
) -> None:
    path = table(tmp_path / "a.csv", [*stamps, *stamps[-1:] * 20])
    with pytest.raises(FormatError, match=reason):
        poise.read(path)
    recording = poise.read(path, rate=50)
    assert recording.rate_hz == pytest.approx(50)
    assert "time: the file's own stamps are ignored for the given rate of 50 Hz" in recording.notes


def test_parquet_with_stamps_that_are_no_numbers(tmp_path: Path) -> None:
    from pyarrow import csv, parquet

    path = table(tmp_path / "a.csv", ["10:11:12 PM"] * 30)
    parquet.write_table(csv.read_csv(path), tmp_path / "a.parquet")
    with pytest.raises(FormatError, match="holds string, expected numbers or time stamps; with --rate HZ"):
        poise.read(tmp_path / "a.parquet")
    assert len(poise.read(tmp_path / "a.parquet", rate=50)) == 30


@pytest.mark.parametrize(
    ("name", "form", "hz"),
    [
        ("timestamp", "2023-05-04T10:11:{:02d}", r" \(100, by"),
        ("time", "10:11:{:02d}", r" \(100, by"),
        ("epoch", "{}", ""),
    ],
)
def test_stamps_in_whole_seconds_are_too_coarse(tmp_path: Path, name: str, form: str, hz: str) -> None:
    path = table(tmp_path / "a.csv", [form.format(10 + i // 100) for i in range(1000)], name)
    with pytest.raises(FormatError, match=rf"99.1% of the stamps are that of the row before.*say --rate HZ{hz}"):
        poise.read(path)
    assert poise.read(path, rate=100).rate_hz == pytest.approx(100)


def test_packets_that_share_a_stamp_are_not_too_coarse(tmp_path: Path) -> None:
    path = table(tmp_path / "a.csv", [f"10:11:{10 + i // 10:02d}" for i in range(400)])
    assert any("packets of 10 rows" in note for note in poise.read(path).notes)


def test_a_reference_by_the_clock_passes_midnight(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(
        "time,qw,qx,qy,qz\n" + "".join(f"{written(MIDDAY, 86399.5 + i / 100)},1,0,0,0\n" for i in range(90))
    )
    np.testing.assert_allclose(poise.read_attitude(path).time, 86399.5 + np.arange(90) / 100)
