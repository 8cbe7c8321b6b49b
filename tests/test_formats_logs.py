"""Text above the rows of a log: what is left out is said, and what cannot be told is asked for."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from poise.errors import FormatError
from poise.formats import read, read_chunks, text
from poise.formats import table as tables

NAMES = "time[ms],gx[rad/s],gy,gz,ax[m/s2],ay,az"
ROWS = "".join(f"{10 * i},0.5,{i}.25,-0.3,0.5,-0.25,9.75\n" for i in range(30))
BOOT = "MPU6050 ready\nCalibrating...\ndone\n"


@pytest.fixture
def log(tmp_path: Path):
    """Write a log and return its path."""

    def write(content: str) -> Path:
        path = tmp_path / "log.txt"
        path.write_text(content)
        return path

    return write


def expect(path: Path, note: str, **options: object) -> None:
    for recording in (read(path, **options), *read_chunks(path, 100, **options)):
        np.testing.assert_array_equal(recording.gyr[:, 1], np.arange(30) + 0.25)
        np.testing.assert_allclose(recording.time, np.arange(30) / 100)
    assert any(note in said for said in read(path, **options).notes)


def test_text_above_rows_without_names_is_left_out_where_columns_are_told(log) -> None:
    path = log(BOOT + ROWS)
    expect(path, "3 lines before the first row (MPU6050 ready, Calibrating..., done): left out", columns=NAMES)
    with pytest.raises(FormatError, match=r"3 lines before the first row \(MPU6050 .*7 follow without a header; say"):
        read(path)


@pytest.mark.parametrize("cut", ["12,0.5,1\n", "5,-0.25,9.75\n"])
def test_the_rest_of_a_line_at_the_beginning_is_left_out_where_columns_are_told(log, cut: str) -> None:
    expect(log(cut + ROWS), "1 line before the first row", columns=NAMES)
    expect(log(BOOT + cut + ROWS), "4 lines before the first row", columns=NAMES)
    with pytest.raises(FormatError, match=r"line 2: [23] cells?, expected 7 like the rows below"):
        read(log(f"{NAMES}\n{cut}{ROWS}"))  # below names it is a row


@pytest.mark.parametrize("title", ["DeviceTag:,Left\nFirmwareVersion:,2.0\n", BOOT, "Rate,100\n\n5\n"])
def test_text_above_the_names_is_left_out(log, title: str) -> None:
    expect(log(f"{title}{NAMES}\n{ROWS}"), "before the column names are left out")
    expect(log(f"sep=,\n{title}{NAMES}\n{ROWS}"), "before the column names are left out")


def test_text_between_names_and_rows_is_left_out(log) -> None:
    expect(log(f"{NAMES}\n{BOOT}{ROWS}"), "3 lines before the first row")
    expect(log(f"# {NAMES}\n{BOOT}{ROWS}"), "3 lines before the first row")


def test_names_of_another_count_are_no_text(log) -> None:
    path = log(f"{NAMES},extra\n{ROWS}")
    with pytest.raises(FormatError, match="line 2 has 7 cells, the header above it names 8 columns"):
        read(path)
    expect(path, "1 line before the first row", columns=NAMES)


def test_a_second_table_below_a_small_one(log) -> None:
    expect(log(f"rate,range\n100,2000\n{NAMES}\n{ROWS}"), "2 lines before the column names are left out")


@pytest.mark.parametrize("delimiter", [",", ";", "\t", " "])
def test_text_between_rows_is_left_out_and_counted(log, monkeypatch: pytest.MonkeyPatch, delimiter: str) -> None:
    lines = ROWS.splitlines(keepends=True)
    content = "".join(line + "WARNING\n\n" * (i % 7 == 6) for i, line in enumerate(lines))
    path = log((f"{NAMES}\n{content}").replace(",", delimiter))
    expect(path, "4 lines of text between the rows, left out")
    monkeypatch.setattr(text, "_BLOCK", 60)
    expect(path, "4 lines of text between the rows, left out")
    monkeypatch.setattr(text, "_SMALL", 100)
    monkeypatch.setattr(tables, "STRETCH", 5)
    whole = read(path, units={"gyr": "rad/s"})
    for stop in range(0, 32, 3):  # another process goes on
        first = read_chunks(path, 1)
        for _ in zip(range(stop), first, strict=False):
            pass
        second = read_chunks(path, 1)
        second.go_on(first.state())
        assert stop + sum(len(part) for part in second) == max(len(whole), stop) and second.notes == whole.notes


@pytest.mark.parametrize("line", ["WARN 7", "12", "a,b,c", "done,", "0x1f"])
def test_other_lines_between_rows_are_refused(log, line: str) -> None:
    with pytest.raises(FormatError, match="line 32: "):
        read(log(f"{NAMES}\n{ROWS}{line}\n{ROWS}"))
