"""Files in chunks: together they are the recording that comes in one piece, bit for bit, wherever they are cut."""

from __future__ import annotations

import json
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import poise
from data_files import data_path
from poise.errors import FormatError
from poise.formats import Limits, held, table, text

ROWS = 3000
UNITS = {"npz": {"gyr": "rad/s", "acc": "m/s2", "time": "s"}}


def made(seed: int = 3) -> poise.Recording:
    """A turning sensor with everything that is decided from a whole file or carried from row to row."""
    rng = np.random.default_rng(seed)
    time = np.arange(ROWS) / 100
    time[1000:1010] -= 3.0  # a clock that goes back
    time[2000:] += 5.0
    gyr = np.column_stack([0.3 * np.sin(time), 0.25 * np.cos(2 * time), 0.5 + 0.1 * np.sin(3 * time)])
    acc = np.array([0.5, -0.25, 9.75]) + 0.01 * rng.normal(size=(ROWS, 3))
    mag = np.repeat(rng.normal(size=(ROWS // 10, 3)), 10, axis=0)  # a logger that repeats
    mag[700:760] = mag[700]
    quat = rng.normal(size=(ROWS, 4))
    quat[::3] /= np.linalg.norm(quat[::3], axis=1, keepdims=True)
    quat[1500:1520] = np.nan
    truth = poise.Attitude.of(time, quat)
    truth.quat[:] = quat
    return poise.Recording(time, gyr, acc, mag, truth=truth, moving=rng.random(ROWS) < 0.5)


def foreign(folder: Path, recording: poise.Recording, kind: str) -> Path:
    """*recording* as others would write it: nothing in the file says that its units need no evidence."""
    path = poise.write(recording, folder / f"own.{'csv' if kind.startswith('csv') else kind}")
    if kind == "npz":
        with np.load(path) as arrays:
            np.savez(path, **{name: arrays[name] for name in arrays.files if name != "poise"})
    elif kind == "parquet":
        from pyarrow import parquet

        parquet.write_table(parquet.read_table(path).replace_schema_metadata(None), path, row_group_size=700)
    else:
        lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
        lines.insert(1500, "# a comment")
        break_, encoding = {"csv": ("\n", "utf-8"), "csv-16": ("\r\n", "utf-16"), "csv-cr": ("\r", "utf-8")}[kind]
        path.write_bytes(break_.join([*lines, ""]).encode(encoding))
    return path


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks and samples so small that a short file is a long one."""
    monkeypatch.setattr(text, "_BLOCK", 9_999)
    monkeypatch.setattr(text, "_SMALL", 50_000)
    for module in (table, text):
        monkeypatch.setattr(module, "STRETCH", 200)


def same(parts: list[poise.Recording], whole: poise.Recording) -> None:
    found = poise.Recording.joined(parts)
    for name in ("time", "gyr", "acc", "mag", "acc_age", "mag_age", "moving"):
        np.testing.assert_array_equal(getattr(found, name), getattr(whole, name), strict=True)
    assert whole.truth is not None and found.truth is not None
    np.testing.assert_array_equal(found.truth.quat, whole.truth.quat)
    np.testing.assert_array_equal(found.truth.flags, whole.truth.flags)


@pytest.mark.parametrize(
    ("kind", "rows"),
    [("csv-16", 333), ("csv-cr", 333), *product(["csv", "parquet", "npz"], [1, 333, 10_000])],
)
@pytest.mark.usefixtures("small")
def test_chunks_are_the_whole(tmp_path: Path, kind: str, rows: int) -> None:
    path = foreign(tmp_path, made(), kind)
    told = UNITS.get(kind)
    whole = poise.read(path, units=told)
    chunks = poise.read_chunks(path, rows, units=told)
    parts = list(chunks)
    assert [len(part) for part in parts[:-1]] == [rows] * (len(parts) - 1) and len(parts[-1]) <= rows
    same(parts, whole)
    assert chunks.notes == whole.notes and any("repeated over 10 rows" in note for note in whole.notes)
    assert any("stamps do not rise" in note for note in whole.notes)
    assert chunks.sniffed == poise.sniff(path, units=told)


def test_what_is_read_in_blocks_is_what_was_written(tmp_path: Path) -> None:
    path, recording = tmp_path / "a.csv", made()
    poise.write(recording, path)
    back = poise.Recording.joined(poise.read_chunks(path, 77))
    np.testing.assert_array_equal(back.mag, recording.mag)  # its own: nothing is taken for repeated
    np.testing.assert_array_equal(back.gyr, recording.gyr)


@pytest.mark.parametrize("kind", ["csv", "csv-16", "csv-cr", "parquet", "npz"])
@pytest.mark.usefixtures("small")
def test_another_process_goes_on_anywhere(tmp_path: Path, kind: str) -> None:
    path = foreign(tmp_path, made(), kind)
    told = UNITS.get(kind)
    whole = poise.read(path, units=told)
    for stop in range(0, ROWS // 250 + 1, 1 if kind in ("csv", "parquet") else 3):
        first = poise.read_chunks(path, 250, units=told)
        before = [part for _, part in zip(range(stop), first, strict=False)]
        state = first.state()
        second = poise.read_chunks(path, 250, units=told)
        second.go_on(state)
        same([*before, *second], whole)
        assert second.notes == whole.notes


@pytest.mark.usefixtures("small")
def test_a_long_file_is_decided_from_stretches_of_it(tmp_path: Path) -> None:
    path = foreign(tmp_path, made(), "csv")
    chunks = poise.read_chunks(path)
    sample, whole = chunks.sample(), poise.read(path)
    assert len(sample) == 200 * table.STRETCHES < ROWS
    assert np.isin(sample.gyr[:, 0], whole.gyr[:, 0]).all()
    np.testing.assert_array_equal(sample.gyr[:200], whole.gyr[:200])
    assert sample.time[-1] > whole.time[len(whole) * 3 // 4]
    same(list(chunks), whole)  # looking at the sample takes nothing away


@pytest.mark.usefixtures("small")
def test_a_bad_row_between_the_stretches_is_refused_with_its_line(tmp_path: Path) -> None:
    path = foreign(tmp_path, made(), "csv")
    lines = path.read_text().splitlines()
    for bad in (1234, 2900):
        path.write_text("\n".join([*lines[:bad], "1,2,oops", *lines[bad:], ""]))
        for use in (poise.read, lambda path: list(poise.read_chunks(path, 100))):
            with pytest.raises(FormatError, match=f"line {bad + 1}: 3 cells"):
                use(path)


def test_limits_hold_in_chunks(tmp_path: Path) -> None:
    path = foreign(tmp_path, made(), "csv")
    with pytest.raises(FormatError, match=r"rows, the limit is 2,000.*--limit rows="):
        list(poise.read_chunks(path, 500, limits=Limits(rows=2000)))
    with pytest.raises(poise.PoiseError, match="rows: expected a number above 0"):
        poise.read_chunks(path, 0)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.sampled_from([0.0, 1.0, float("nan")]), min_size=1, max_size=60), st.integers(2, 5), st.data())
def test_repeats_are_found_across_cuts(values: list[float], usual: int, data: st.DataObject) -> None:
    rows = np.repeat(np.array(values)[:, None], 3, axis=1)
    whole, parts, at = held.Fresh(usual).of(rows), [], 0
    fresh = held.Fresh(usual)
    while at < len(rows):
        step = data.draw(st.integers(1, 7))
        other = held.Fresh(usual)
        other.restore(json.loads(json.dumps(fresh.state())))
        parts.append(fresh.of(rows[at : at + step]))
        np.testing.assert_array_equal(other.of(rows[at : at + step]), parts[-1])
        at += step
    np.testing.assert_array_equal(np.concatenate(parts), whole)


@settings(max_examples=80, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.binary(max_size=300), st.integers(0, 4000), st.booleans())
def test_any_bytes_in_a_table_are_read_or_refused(tmp_path: Path, noise: bytes, at: int, replace: bool) -> None:
    path = tmp_path / "a.txt"
    lines = ["time (s),gx (rad/s),gy,gz,ax (m/s2),ay,az"] + [f"{i / 100},0.1,0.2,{i},0,0,9.8" for i in range(120)]
    content = ("\n".join(lines) + "\n").encode()
    path.write_bytes(content[:at] + noise + content[at + len(noise) * replace :])
    try:
        found = poise.Recording.joined(poise.read_chunks(path, 7))
    except FormatError as problem:
        assert str(problem).startswith(str(path))
        return
    assert len(found) >= 1


def test_real_recordings_in_chunks() -> None:
    for parts in (("broad", "29_disturbed_stationary_magnet_B.mat"), ("other", "x-io_fusion_sensor_data.csv")):
        path = data_path(*parts)
        whole, chunks = poise.read(path), poise.read_chunks(path, 1000)
        found = poise.Recording.joined(chunks)
        for name in ("time", "gyr", "acc", "mag"):
            np.testing.assert_array_equal(getattr(found, name), getattr(whole, name))
        assert chunks.notes == whole.notes
