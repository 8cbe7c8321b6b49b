"""From file to file in chunks: the bytes of one piece, whatever happens on the way."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poise
from poise import file_to_file
from poise.cli import run
from poise.errors import FormatError
from poise.formats import bodies, partial
from poise.simulation import forearm, measure

RATE = 100.0


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A made recording with its reference, and a hole in it."""
    recording = measure(forearm(60.0, rate=RATE, seed=2))
    gone = (recording.time > 20.0) & (recording.time < 23.0)
    return poise.write(recording[~gone], tmp_path_factory.mktemp("log") / "log.csv")


def whole(log: Path, target: Path, method: Any, frame: Any = "enu") -> bytes:
    return poise.write(poise.estimate(method, poise.read(log)).to(frame), target).read_bytes()


@pytest.mark.parametrize("suffix", ["parquet", "csv", "tum"])
@pytest.mark.parametrize("method", [poise.SelfCalibrating(), poise.AdaptiveGain()])
def test_the_bytes_of_one_piece(log: Path, tmp_path: Path, suffix: str, method: Any) -> None:
    want = whole(log, tmp_path / f"whole.{suffix}", method, "ned")
    target = tmp_path / f"chunks.{suffix}"
    rows = 65_536 if suffix == "parquet" else 500  # a chunk is a row group
    written = poise.estimate_file(poise.read_chunks(log, rows), target, method, frame="ned")
    assert target.read_bytes() == want
    attitude = poise.estimate(method, poise.read(log))
    assert written.rows == len(attitude) and written.valid == pytest.approx(attitude.valid.mean())
    assert written.heading_reference == "magnetic" and written.resumed == 0
    assert str(written.learned) == str(attitude.learned)
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"chunks.{suffix}", f"whole.{suffix}"]


def test_estimate_chunks_is_estimate(log: Path) -> None:
    attitude = poise.estimate(poise.TwoStage(), poise.read(log), bias=(0.01, 0, 0))
    pairs = list(poise.estimate_chunks(poise.TwoStage(), poise.read_chunks(log, 777), bias=(0.01, 0, 0)))
    np.testing.assert_array_equal(np.concatenate([part.table for _, part in pairs]), attitude.table)
    np.testing.assert_array_equal(np.concatenate([part.flags for _, part in pairs]), attitude.flags)
    assert all(len(recording) == len(part) for recording, part in pairs)


def test_small_row_groups_are_those_of_a_plain_writer(tmp_path: Path) -> None:
    import io

    import pyarrow as pa
    from pyarrow import parquet

    rng = np.random.default_rng(0)
    tables = [pa.table({"a": rng.normal(size=n), "b": np.arange(n) % 3 == 0}) for n in (1000, 1, 70, 40_000)]
    with (tmp_path / "parts").open("wb+") as file:
        body = bodies.ParquetBody(file, io.BytesIO(), ("a", "b"))
        for table in tables:
            body.add(table)
        file.write(body.tail({"poise.x": "y"}))
    schema = tables[0].schema.with_metadata({"poise.x": "y"})
    with parquet.ParquetWriter(tmp_path / "plain", schema, **bodies._PARQUET) as writer:
        for table in tables:
            writer.write_table(table)
    assert (tmp_path / "parts").read_bytes() == (tmp_path / "plain").read_bytes()


class Stop(Exception):
    """What ends a run between two chunks."""


class Stopper:
    """An account that ends the run after so many chunks, once."""

    def __init__(self, after: int) -> None:
        self.left = after

    def add(self, recording: poise.Recording, attitude: poise.Attitude) -> None:
        self.left -= 1
        if self.left == 0:
            raise Stop

    def state(self) -> dict[str, Any]:
        return {}

    def restore(self, state: Any) -> None:
        pass


@pytest.mark.parametrize("suffix", ["parquet", "csv", "tum"])
def test_goes_on_to_the_same_bytes(log: Path, tmp_path: Path, suffix: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(file_to_file, "_EVERY", 0.0)
    target, method = tmp_path / f"a.{suffix}", poise.SelfCalibrating()
    stopper = Stopper(0)
    poise.estimate_file(poise.read_chunks(log, 300), target, method, accounts={"stop": stopper})
    want = target.read_bytes()
    target.write_bytes(b"what was there before")
    resumed = []
    for after in (1, 3, 5, 2, 0):
        stopper.left = after
        try:
            written = poise.estimate_file(poise.read_chunks(log, 300), target, method, accounts={"stop": stopper})
            resumed.append(written.resumed)
        except Stop:
            assert target.read_bytes() == b"what was there before"
    assert resumed == [7 * 300] and target.read_bytes() == want
    assert [path.name for path in tmp_path.iterdir()] == [target.name]


def interrupted(log: Path, target: Path, monkeypatch: pytest.MonkeyPatch, after: int = 4, **options: Any) -> None:
    monkeypatch.setattr(file_to_file, "_EVERY", 0.0)
    with pytest.raises(Stop):
        stop = {"stop": Stopper(after)}
        poise.estimate_file(poise.read_chunks(log, 300), target, poise.AdaptiveGain(), accounts=stop, **options)


def test_other_work_begins_anew(log: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target, stop = tmp_path / "a.parquet", {"stop": Stopper(0)}

    def after(other: Path | None = None, rows: int = 300, method: Any = None, **options: Any) -> int:
        interrupted(log, target, monkeypatch)
        method = method or poise.AdaptiveGain()
        return poise.estimate_file(
            poise.read_chunks(other or log, rows), target, method, accounts=stop, **options
        ).resumed

    assert after() == 900
    assert (
        after(rows=301)
        == after(method=poise.TwoStage())
        == after(frame="nwu")
        == after(guard=None, rest_bias=False)
        == 0
    )
    assert after(start=(1.0, 0, 0, 0)) == after(correct=lambda r: r.remap("y -x z"), corrected_by="y -x z") == 0
    changed = tmp_path / log.name
    changed.write_bytes(log.read_bytes().replace(b"9.8", b"9.7", 1))
    assert after(changed) == 0


def test_a_damaged_state_begins_anew(log: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target, stop = tmp_path / "a.parquet", {"stop": Stopper(0)}
    poise.estimate_file(poise.read_chunks(log, 300), target, poise.AdaptiveGain(), accounts=stop)
    want = target.read_bytes()
    for name in ("state.npz", "rows", "index"):
        interrupted(log, target, monkeypatch)
        path = tmp_path / "a.parquet.partial" / name
        path.write_bytes(path.read_bytes()[: -path.stat().st_size // 2])
        written = poise.estimate_file(poise.read_chunks(log, 300), target, poise.AdaptiveGain(), accounts=stop)
        assert written.resumed == 0 and target.read_bytes() == want


def test_a_full_disk_keeps_what_is_written(log: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "a.parquet"
    monkeypatch.setattr(file_to_file, "_EVERY", 0.0)
    add, calls = bodies.ParquetBody.add, []

    def full(self: Any, table: Any) -> None:
        calls.append(1)
        if len(calls) == 4:
            raise OSError(28, "No space left on device")
        add(self, table)

    monkeypatch.setattr(bodies.ParquetBody, "add", full)
    with pytest.raises(FormatError, match=r"No space left.*stays in a\.parquet\.partial, the same command goes on"):
        poise.estimate_file(poise.read_chunks(log, 300), target, poise.AdaptiveGain())
    assert not target.exists()
    written = poise.estimate_file(poise.read_chunks(log, 300), target, poise.AdaptiveGain())
    assert written.resumed == 900 and written.rows == len(poise.read_attitude(target))


def test_a_bad_row_leaves_nothing(log: Path, tmp_path: Path) -> None:
    bad, target = tmp_path / "bad.csv", tmp_path / "a.parquet"
    bad.write_bytes(log.read_bytes() + b"1,2\n")
    with pytest.raises(FormatError, match=r"line \d+: 2 cells"):
        poise.estimate_file(poise.read_chunks(bad, 300), target, poise.AdaptiveGain())
    assert [path.name for path in tmp_path.iterdir()] == ["bad.csv"]


def test_two_processes_do_not_share_a_file(log: Path, tmp_path: Path) -> None:
    pytest.importorskip("fcntl")
    target = tmp_path / "a.parquet"
    with partial.partial(target), pytest.raises(FormatError, match="another process is writing it"):
        poise.estimate_file(poise.read_chunks(log, 300), target, poise.AdaptiveGain())


def test_formats_that_need_all_rows_are_refused(log: Path, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="bag cannot be written in chunks; expected parquet, csv, tum"):
        poise.estimate_file(poise.read_chunks(log), tmp_path / "a.bag", poise.AdaptiveGain())


SCRIPT = """
import sys
import poise
from poise import file_to_file
file_to_file._EVERY = 0.0
chunks = poise.read_chunks(sys.argv[1], 100)
poise.estimate_file(chunks, sys.argv[2], poise.AdaptiveGain())
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no SIGKILL here")
@pytest.mark.parametrize("suffix", ["parquet", "csv"])
def test_killed_anywhere(log: Path, tmp_path: Path, suffix: str) -> None:
    want, target = tmp_path / f"want.{suffix}", tmp_path / f"a.{suffix}"
    chunks = poise.read_chunks(log, 100)
    poise.estimate_file(chunks, want, poise.AdaptiveGain())
    folder, kills = tmp_path / f"a.{suffix}.partial", 0
    rng = np.random.default_rng(1)
    for _ in range(20):
        process = subprocess.Popen([sys.executable, "-c", SCRIPT, str(log), str(target)])
        while process.poll() is None and not folder.exists():
            time.sleep(0.002)
        time.sleep(float(rng.uniform(0.0, 0.12)))
        if process.poll() is None:
            os.kill(process.pid, signal.SIGKILL)
        process.wait()
        if target.exists():
            break
        kills += 1
    if not target.exists():
        subprocess.run([sys.executable, "-c", SCRIPT, str(log), str(target)], check=True)
    assert kills and target.read_bytes() == want.read_bytes()


# -- the command ------------------------------------------------------------------------------------------------------


def test_the_command_in_chunks(
    log: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    told = ["estimate", str(log), "-m", "self-calibrating", "--json", "--declination", "3", "--frame", "nwu"]
    assert run([*told, "-o", "a.parquet", "--plot", "a.png"]) == 0
    one = capsys.readouterr().out
    assert run([*told, "-o", "b.parquet", "--plot", "b.png", "--limit", "whole=0"]) == 0
    assert (tmp_path / "a.parquet").read_bytes() == (tmp_path / "b.parquet").read_bytes()
    import json

    first, second = (json.loads(text)["results"][0] for text in (one, capsys.readouterr().out))
    for part in (first, second):
        part.pop("output"), part.pop("plot")
    assert first.pop("error_deg") == pytest.approx(second.pop("error_deg"), rel=1e-12)
    assert first == second and first["heading"] == "true"
    assert (tmp_path / "b.png").stat().st_size > 10_000


def test_the_command_says_where_it_went_on(
    log: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from poise.cli import long

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(file_to_file, "_EVERY", 0.0)
    monkeypatch.setattr(long, "ROWS", 500)
    told = ["estimate", str(log), "-m", "adaptive-gain", "-o", "a.parquet", "--plot", "a.png", "--limit", "whole=0"]
    assert run(told) == 0
    want, errors = (tmp_path / "a.parquet").read_bytes(), capsys.readouterr()
    (tmp_path / "a.parquet").unlink()
    add = bodies.ParquetBody.add
    calls: list[int] = []

    def killed(self: Any, table: Any) -> None:
        calls.append(1)
        if len(calls) == 6:
            raise KeyboardInterrupt
        add(self, table)

    monkeypatch.setattr(bodies.ParquetBody, "add", killed)
    with pytest.raises(SystemExit, match="130"):
        run(told)
    capsys.readouterr()
    assert run(told) == 0
    assert "went on behind the 2,500 rows that an interrupted run had written" in (found := capsys.readouterr()).err
    assert (tmp_path / "a.parquet").read_bytes() == want and found.out == errors.out


def test_pictures_of_long_files_keep_every_flag() -> None:
    from poise.cli.long import Thinned

    n = 1000
    rng = np.random.default_rng(5)
    flags = np.where(rng.random(n) < 0.02, 1 << rng.integers(0, 5, n), 0).astype(np.uint32)
    table = np.tile([1.0, 0, 0, 0, *[0.0] * 12], (n, 1))
    attitude = poise.Attitude(np.arange(n) / 100, table, flags)
    none = np.full((n, 3), np.nan)
    recording = poise.Recording(attitude.time, none, none)
    for cuts in ((100,), (1, 7, 64, 333), (999,)):
        thin, at = Thinned(64), 0
        for cut in (*cuts, *[50] * 30):
            part = slice(at, min(at + cut, n))
            if part.start < n:
                thin.add(recording[part], attitude[part])
                at = part.stop
        shown = thin.rows("enu", "arbitrary")[1]
        assert thin.stride == 16 and len(shown) == 63
        np.testing.assert_array_equal(shown.time, attitude.time[::16])
        want = [np.bitwise_or.reduce(flags[i : i + 16]) for i in range(0, n, 16)]
        np.testing.assert_array_equal(shown.flags, want)
