"""What is acknowledged is on the disk, and a recording that was cut goes on as if it had not been."""

from __future__ import annotations

import errno
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

import poise
from live_helpers import METHOD, ask, heard, made, rows_of, send, serving, wait_for
from poise.cli import run
from poise.estimators.loop import advance
from poise.live import frames, journal
from poise.live.methods import Choice
from poise.live.recorder import Recorder
from poise.live.session import Session, SessionError, interrupted

EXPECTED = poise.AdaptiveGain()


def acknowledged(device: Any, number: int) -> None:
    while heard(device, "ack")["next"] < number:
        pass


def same_as_uncut(folder: Path, name: str, recording: poise.Recording) -> None:
    """The files of *name* hold *recording* and what `estimate` says of it, bit for bit."""
    kept = poise.read(folder / f"{name}.parquet")
    for column in ("time", "gyr", "acc", "mag"):
        np.testing.assert_array_equal(getattr(kept, column), getattr(recording, column))
    found, expected = (
        poise.read_attitude(folder / f"{name}.{METHOD}.attitude.parquet"),
        poise.estimate(EXPECTED, recording),
    )
    np.testing.assert_array_equal(found.quat, expected.quat)
    np.testing.assert_array_equal(found.flags, expected.flags)
    assert found.heading_reference == expected.heading_reference
    assert found.provenance.method == "AdaptiveGain"


def test_what_came_in_is_in_the_files(tmp_path: Path) -> None:
    recording = made(4.0)
    with serving(recorder=Recorder(Session.below(tmp_path))) as live, live.device("arm") as device:
        send(device, rows_of(recording))
        acknowledged(device, len(recording))
    (session,) = tmp_path.iterdir()
    same_as_uncut(session, "arm", recording)
    assert not interrupted(tmp_path)


def test_journal_files_become_parquet_while_it_runs(tmp_path: Path) -> None:
    recording = made(20.0)
    recorder = Recorder(Session.below(tmp_path), rotate=60_000)
    with serving(recorder=recorder) as live, live.device("arm") as device:
        for k in range(0, len(recording), 200):
            send(device, rows_of(recording)[k : k + 200], first=k)
            acknowledged(device, min(k + 200, len(recording)))
        wait_for(lambda: len(list(tmp_path.glob("*/journal/arm@@*.parquet"))) >= 2)
    (session,) = tmp_path.iterdir()
    same_as_uncut(session, "arm", recording)


def test_an_end_while_the_journal_is_taken_away_shortens_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    recording, unlink = made(12.0), os.unlink

    def ending(path: Any, **options: Any) -> None:
        if str(path).endswith("@@000002.parquet"):
            raise OSError(errno.EIO, "the plug is pulled")
        unlink(path, **options)

    monkeypatch.setattr(os, "unlink", ending)
    recorder = Recorder(Session.below(tmp_path), rotate=60_000)
    try:
        with serving(recorder=recorder) as live, live.device("arm") as device:
            for k in range(0, len(recording), 200):
                send(device, rows_of(recording)[k : k + 200], first=k)
                acknowledged(device, min(k + 200, len(recording)))
    except SessionError:
        os.close(recorder.session._held)  # as the end of a process does
    assert list(tmp_path.glob("*/*journal*/arm@@000002.parquet"))
    monkeypatch.undo()
    run(["recover", str(tmp_path)])
    (session,) = tmp_path.iterdir()
    same_as_uncut(session, "arm", recording)
    Session.below(tmp_path).finish()
    assert not list(tmp_path.glob("*/*journal*"))


def test_methods_that_changed_have_a_file_each(tmp_path: Path) -> None:
    rows = rows_of(made(4.0))
    with (
        serving(recorder=Recorder(Session.below(tmp_path))) as live,
        live.viewer() as viewer,
        live.device("arm") as device,
    ):
        send(device, rows[:200])
        acknowledged(device, 200)
        other = {"name": METHOD, "settings": {"k_rest": 0.1}}
        ask(viewer, type="methods", device="arm", methods=[other])
        send(device, rows[200:], first=200)
        acknowledged(device, 400)
    (session,) = tmp_path.iterdir()
    lengths = sorted(len(poise.read_attitude(path)) for path in session.glob("*.attitude.parquet"))
    assert lengths == [200, 200]
    assert len(poise.read(session / "arm.parquet")) == 400


def test_cut_connections_lose_nothing_and_repeat_nothing(tmp_path: Path) -> None:
    recording = made(20.0)
    rows, random = rows_of(recording), np.random.default_rng(0)
    with serving(recorder=Recorder(Session.below(tmp_path))) as live:
        for _ in range(100):
            with suppress(ConnectionClosed), live.device("arm") as device:
                first = heard(device, "welcome")["next"]
                n = int(random.integers(1, 30))
                send(device, rows[max(first - 7, 0) : first + n], first=max(first - 7, 0), size=5)
                if random.random() < 0.7:
                    device.socket.shutdown(socket.SHUT_RDWR)  # cut, with frames under way
        with live.device("arm") as device:
            first = heard(device, "welcome")["next"]
            send(device, rows[first:], first=first)
            acknowledged(device, len(rows))
        assert live.hub.find("arm").health.lost == 0
    (session,) = tmp_path.iterdir()
    same_as_uncut(session, "arm", recording)


def test_a_full_disk_stops_acknowledgements_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    recording = made(6.0)
    rows = rows_of(recording)
    full, append = [False], journal.append

    def limited(file: int, blocks: list[journal.Encoded]) -> None:
        if full[0]:
            os.write(file, b"".join(blocks[0].parts)[:50])  # some of it fits
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        append(file, blocks)

    monkeypatch.setattr(journal, "append", limited)
    with serving(recorder=Recorder(Session.below(tmp_path))) as live, live.device("arm") as device:
        send(device, rows[:200])
        acknowledged(device, 200)
        full[0] = True
        send(device, rows[200:400], first=200)
        assert "No space left" in heard(device, "recording")["reason"]
        wait_for(lambda: live.http.get("/devices/arm/attitude").json()["sequence"] == 399)
        answer = live.http.get("/healthz")
        assert answer.status_code == 503
        assert "No space left" in answer.text
        full[0] = False
        assert heard(device, "recording")["reason"] is None
        acknowledged(device, 400)
        send(device, rows[400:], first=400)
        acknowledged(device, 600)
    (session,) = tmp_path.iterdir()
    same_as_uncut(session, "arm", recording)


def test_a_fault_in_the_recorder_is_said_and_costs_what_it_met(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rows = rows_of(made(6.0))
    faulty, encoded = [False], journal.encoded_batch

    def broken(batch: Any) -> journal.Encoded:
        if faulty[0]:
            raise ZeroDivisionError("a fault of ours")
        return encoded(batch)

    monkeypatch.setattr(journal, "encoded_batch", broken)
    recorder = Recorder(Session.below(tmp_path))
    with serving(recorder=recorder) as live, live.device("arm") as device:
        send(device, rows[:200])
        acknowledged(device, 200)
        faulty[0] = True
        send(device, rows[200:400], first=200)
        assert "a fault of ours" in heard(device, "recording")["reason"]
        wait_for(lambda: recorder.lost == 200)
        faulty[0] = False
        send(device, rows[400:], first=400)
        ack = heard(device, "ack")
        while ack["next"] < 600:
            ack = heard(device, "ack")
        assert ack["lost"] == 200
    (session,) = tmp_path.iterdir()
    assert len(poise.read(session / "arm.parquet")) == 400


def test_what_cannot_wait_any_longer_is_counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rows = rows_of(made(10.0))
    blocked = [True]
    append = journal.append

    def limited(file: int, blocks: list[journal.Encoded]) -> None:
        if blocked[0]:
            raise OSError(errno.EROFS, os.strerror(errno.EROFS))
        append(file, blocks)

    monkeypatch.setattr(journal, "append", limited)
    recorder = Recorder(Session.below(tmp_path), most_waiting=60_000)
    with serving(recorder=recorder) as live, live.device("arm") as device:
        for k in range(0, 1000, 50):
            send(device, rows[k : k + 50], first=k)
            time.sleep(0.02)
        wait_for(lambda: recorder.lost > 0)
        blocked[0] = False
        ack = heard(device, "ack")
        while ack["next"] < 1000:
            ack = heard(device, "ack")
        assert ack["lost"] == recorder.lost
    (session,) = tmp_path.iterdir()
    assert len(poise.read(session / "arm.parquet")) == 1000 - recorder.lost


def test_a_folder_is_held_by_one(tmp_path: Path) -> None:
    session = Session.below(tmp_path)
    with pytest.raises(SessionError, match="another process is recording there"):
        Session(session.folder)
    session.finish()
    assert list(tmp_path.iterdir()) == []


class Started:
    """`poise live` as a process of its own."""

    def __init__(self, folder: Path) -> None:
        Choice.of(METHOD).warm()  # less to compile while a test waits
        command = [sys.executable, "-m", "poise", "live", "--port", "0", "--record", str(folder), "-m", METHOD]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        self.port = int(line.split("/")[2].rpartition(":")[2])

    def end(self, number: int) -> int:
        self.process.send_signal(number)
        return self.process.wait(30)


def test_kill_9_loses_nothing_that_was_acknowledged(tmp_path: Path) -> None:
    recording = made(30.0)
    rows = rows_of(recording)
    random, known = np.random.default_rng(1), 0
    for turn in range(3):
        started = Started(tmp_path)
        with suppress(ConnectionClosed), connect(f"ws://127.0.0.1:{started.port}/ws/device/arm") as device:
            first = heard(device, "welcome")["next"]
            assert first >= known
            end = len(rows) if turn == 2 else first + int(random.integers(200, 700))
            for k in range(first, end, 10):
                device.send(frames.encoded(rows[k : min(k + 10, end)], k))
            while known < end - int(random.integers(0, 100)) * (turn < 2):
                known = max(known, heard(device, "ack", 120.0)["next"])  # it may have to compile first
            assert started.end(signal.SIGTERM if turn == 2 else signal.SIGKILL) == (0 if turn == 2 else -9)
    assert known == len(rows)
    (session,) = tmp_path.iterdir()
    same_as_uncut(session, "arm", recording)


def test_a_device_that_counted_anew_goes_on_from_its_new_numbers(tmp_path: Path) -> None:
    recording = made(64.0)
    rows, folder = rows_of(recording), tmp_path / "recording"
    with serving(recorder=Recorder(Session.below(folder)), max_rate=1e5) as live, live.device("arm") as device:
        send(device, rows[:600], first=9000)
        acknowledged(device, 9600)
        send(device, rows[600:], first=0)  # far back: it began anew
        acknowledged(device, len(rows) - 600)
        (journal_folder,) = folder.glob("*/journal")
        shutil.copytree(journal_folder, tmp_path / "killed" / "session" / "journal")
    recorder = Recorder(Session.below(tmp_path / "killed"))
    with serving(recorder=recorder) as live, live.device("arm") as device:
        assert heard(device, "welcome")["next"] == len(rows) - 600
        wait_for(lambda: live.hub.devices["arm"].runs)
        went_on = live.call(lambda: live.hub.devices["arm"].runs[0].stream.latest)
    np.testing.assert_array_equal(went_on.quat[-1], poise.estimate(EXPECTED, recording).quat[-1])


def test_recover_cuts_a_torn_tail_and_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    recording = made(4.0)
    started = Started(tmp_path)
    with suppress(ConnectionClosed), connect(f"ws://127.0.0.1:{started.port}/ws/device/arm") as device:
        send(device, rows_of(recording))
        acknowledged(device, len(recording))
        started.end(signal.SIGKILL)
    (session,) = interrupted(tmp_path)
    log = max((session / "journal").glob("*.log"))
    with log.open("ab") as file:
        file.write(log.read_bytes()[:77])
    assert run(["recover", str(tmp_path)]) == 0
    said = capsys.readouterr()
    assert "400 samples recovered" in said.out
    assert "torn tail of 77 bytes" in said.err
    same_as_uncut(session, "arm", recording)
    assert run(["recover", str(tmp_path / "nowhere")]) == 1


def test_a_flipped_bit_costs_its_block_and_no_other(tmp_path: Path) -> None:
    block = journal.encoded_checkpoint("arm", 7, [])
    path = tmp_path / "1.log"
    data = b"".join(block.parts)
    path.write_bytes(data * 3)
    assert [b.head["next"] for b in journal.read(path) if isinstance(b, journal.Block)] == [7, 7, 7]
    size = len(data)
    for bit in range(0, 8 * size, 5):
        for blocks in (2, 3):
            flipped = bytearray(data * blocks)
            flipped[size + bit // 8] ^= 1 << bit % 8
            path.write_bytes(flipped)
            first, damage, *rest = journal.read(path)
            assert isinstance(first, journal.Block)
            assert damage == journal.Unreadable(size, size, blocks == 2)
            assert len(rest) == blocks - 2
            assert all(isinstance(each, journal.Block) for each in rest)
    assert json.loads(bytes(block.parts[1]))["device"] == "arm"


@pytest.mark.parametrize("finish", ["recover", "go on"])
def test_damage_within_a_journal_is_left_out_and_what_follows_is_kept(
    tmp_path: Path, finish: str, capsys: pytest.CaptureFixture[str]
) -> None:
    recording = made(6.0)
    rows = rows_of(recording)
    started = Started(tmp_path)
    with suppress(ConnectionClosed), connect(f"ws://127.0.0.1:{started.port}/ws/device/arm") as device:
        for k in range(0, len(rows), 100):
            send(device, rows[k : k + 100], first=k)
            acknowledged(device, k + 100)
        started.end(signal.SIGKILL)
    (session,) = interrupted(tmp_path)
    log = max((session / "journal").glob("*.log"))
    content = bytearray(log.read_bytes())
    at = content.index(rows[250].tobytes())
    content[at + 3] ^= 16
    log.write_bytes(content)
    if finish == "recover":
        assert run(["recover", str(tmp_path)]) == 0
        said = capsys.readouterr()
        assert "are damaged and left out" in said.err
    else:
        Choice.of(METHOD).warm()
        kinds = len(advance.signatures)
        recorder = Recorder(Session.below(tmp_path))
        with serving(recorder=recorder) as live, live.device("arm") as device:
            assert heard(device, "welcome")["next"] == len(rows)
            assert any("are damaged and left out" in event["text"] for event in live.hub.happened.all())
            wait_for(lambda: live.hub.devices["arm"].runs)
        assert len(advance.signatures) == kinds  # to compile it anew would keep a device waiting for many seconds
    kept = poise.read(session / "arm.parquet").time
    missing = np.flatnonzero(~np.isin(recording.time, kept))
    assert 250 in missing
    assert len(missing) <= 100  # the block of one packet
    assert np.isin(kept, recording.time).all()
