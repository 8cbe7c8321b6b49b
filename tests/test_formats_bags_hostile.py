"""Damaged and hostile bags: one clear error each, in bounded memory and time, or the samples that are there."""

from __future__ import annotations

import os
import shutil
import sqlite3
import struct
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from data_files import data_path
from made_bags import ROWS, imu, mag, save, text
from poise.cli import run
from poise.errors import FormatError
from poise.formats import Limits, read, sniff

GIANT = 2**62


def _cut(kind: str) -> Callable[[Path], Path]:
    def make(folder: Path) -> Path:
        path = save(folder / "a", [*imu(), *mag()], kind)
        path.write_bytes(path.read_bytes()[:-5000])
        return path

    return make


def _noise(magic: bytes) -> Callable[[Path], Path]:
    def make(folder: Path) -> Path:
        path = folder / "a"
        path.write_bytes(magic + np.random.default_rng(1).bytes(20_000))
        return path

    return make


def _giant_bag(folder: Path) -> Path:
    """A record header that claims 4 GiB."""
    path = folder / "a.bag"
    path.write_bytes(b"#ROSBAG V2.0\n" + struct.pack("<I", 2**32 - 1) + b"op=\x03" * 100)
    return path


def _giant_mcap(folder: Path) -> Path:
    """A first record that claims 4 EiB."""
    path = folder / "a.mcap"
    path.write_bytes(b"\x89MCAP0\r\n\x01" + struct.pack("<Q", GIANT) + bytes(1000))
    return path


def _chunked(compression: str, packed: bytes, size: int, checksum: int = 0) -> bytes:
    """An MCAP log of ROS 2 with one chunk, as its format is specified."""
    word = compression.encode()
    chunk = struct.pack("<QQQII", 0, 1, size, checksum, len(word)) + word + struct.pack("<Q", len(packed)) + packed
    header = struct.pack("<I", 4) + b"ros2" + struct.pack("<I", 0)
    records = b"".join(
        struct.pack("<BQ", code, len(record)) + record for code, record in [(1, header), (6, chunk), (2, bytes(20))]
    )
    return b"\x89MCAP0\r\n" + records + b"\x89MCAP0\r\n"


def _bomb(folder: Path) -> Path:
    """A chunk of 8 MB that unpacks to 2 GB."""
    from lz4.frame import LZ4FrameCompressor

    path = folder / "a.mcap"
    with LZ4FrameCompressor() as packer:
        packed = packer.begin() + b"".join(packer.compress(bytes(10**8)) for _ in range(20)) + packer.flush()
    path.write_bytes(_chunked("lz4", packed, 2 * 10**9))
    return path


def _bad_checksum(folder: Path) -> Path:
    path = folder / "a.mcap"
    path.write_bytes(_chunked("", bytes(100), 100, zlib.crc32(bytes(100)) ^ 1))
    return path


def _sql(*statements: str) -> Callable[[Path], Path]:
    def make(folder: Path) -> Path:
        path = save(folder / "a.db3", [*imu(), *mag()], "bare-sqlite3")
        database = sqlite3.connect(path)
        for statement in statements:
            database.execute(statement)
        database.commit()
        database.close()
        return path

    return make


def _other_database(folder: Path) -> Path:
    path = folder / "a.db3"
    database = sqlite3.connect(path)
    database.execute("CREATE TABLE bookmarks (url TEXT)")
    database.commit()
    database.close()
    return path


def _folder(change: Callable[[Path], object]) -> Callable[[Path], Path]:
    def make(folder: Path) -> Path:
        path = save(folder / "walk", [*imu(), *mag()], "mcap")
        change(path)
        return path

    return make


def _edited(old: str, new: str) -> Callable[[Path], Path]:
    def change(path: Path) -> None:
        metadata = path / "metadata.yaml"
        assert old in metadata.read_text()
        metadata.write_text(metadata.read_text().replace(old, new))

    return _folder(change)


ENDLESS = (
    "CREATE VIEW message_definitions AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) "
    "SELECT i AS id, 'a' AS topic_type, 'ros2msg' AS encoding, '' AS encoded_message_definition, "
    "'' AS type_description_hash FROM n"
)
CASES: dict[str, tuple[Callable[[Path], Path], str]] = {
    "cut ROS 1 bag": (_cut("bag"), r"ROS 1 bag that cannot be read .*rosbag reindex"),
    "cut MCAP": (_cut("bare-mcap"), r"MCAP file that cannot be read .*mcap recover"),
    "cut SQLite": (_cut("bare-sqlite3"), r"ROS 2 SQLite file that cannot be read .*copy it again"),
    "noise as ROS 1 bag": (_noise(b"#ROSBAG V2.0\n"), "ROS 1 bag that cannot be read"),
    "noise as MCAP": (_noise(b"\x89MCAP0\r\n"), "MCAP file that cannot be read"),
    "noise as SQLite": (_noise(b"SQLite format 3\0"), "ROS 2 SQLite file that cannot be read"),
    "old ROS 1 bag": (_noise(b"#ROSBAG V1.2\n"), "a ROS 1 bag of another version than 2.0"),
    "giant record in a bag": (_giant_bag, "ROS 1 bag that cannot be read"),
    "giant record in MCAP": (_giant_mcap, "MCAP file that cannot be read"),
    "bomb": (_bomb, r"MCAP file that cannot be read \((needs more memory|.*buffer)"),
    "bad checksum": (_bad_checksum, r"MCAP file that cannot be read .*[Cc]hecksum"),
    "another database": (_other_database, "ROS 2 SQLite file that cannot be read .*missing tables"),
    "no messages table": (_sql("DROP TABLE messages"), "ROS 2 SQLite file that cannot be read .*missing tables"),
    "no definitions table": (_sql("DROP TABLE message_definitions"), "ROS 2 SQLite file that cannot be read"),
    "other columns": (_sql("ALTER TABLE messages RENAME data TO rest"), "ROS 2 SQLite file that cannot be read"),
    "numbers for bytes": (_sql("UPDATE messages SET data = 7"), "ROS 2 SQLite file that cannot be read"),
    "cut messages": (_sql("UPDATE messages SET data = substr(data, 1, 40)"), "ROS 2 SQLite file that cannot be read"),
    "no rows": (
        _sql("DELETE FROM messages"),
        r"no sensor_msgs/Imu message in this bag: /imu/data_raw .*without a message",
    ),
    "another encoding": (_sql("UPDATE topics SET serialization_format = 'json'"), "encoded as 'json', expected cdr"),
    "no metadata": (_folder(lambda path: (path / "metadata.yaml").unlink()), r"a folder without metadata\.yaml"),
    "metadata of another kind": (_folder(lambda path: (path / "metadata.yaml").write_text("a: [")), "YAML"),
    "metadata without a bag": (_folder(lambda path: (path / "metadata.yaml").write_text("a: 1")), "cannot be read"),
    "files missing": (_folder(lambda path: next(path.glob("*.mcap")).unlink()), "cannot be read .*missing"),
    "unknown storage": (_edited("storage_identifier: mcap", "storage_identifier: tape"), "'tape' not supported"),
    "a pipe in the folder": (_folder(lambda path: os.mkfifo(path / "more")), "more in it is a device or pipe"),
    "empty ROS 1 bag": (lambda folder: save(folder / "a.bag", []), "no sensor_msgs/Imu message.*no topic at all"),
    "empty MCAP": (lambda folder: save(folder / "a.mcap", [], "bare-mcap"), "no sensor_msgs/Imu message.*no topic at"),
    "no Imu": (
        lambda folder: save(folder / "a.bag", [*mag(), *text()]),
        r"no sensor_msgs/Imu.*/chatter \(std_msgs/String",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_hostile_bags_are_one_error(tmp_path: Path, case: str) -> None:
    make, reason = CASES[case]
    path = make(tmp_path)
    with pytest.raises(FormatError, match=reason) as caught:
        read(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert len(str(caught.value)) < 700 and "\n" not in str(caught.value)


def test_an_endless_bag_ends_in_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from poise.formats import bag

    monkeypatch.setattr(bag, "_SECONDS", 2)
    path = _sql("DROP TABLE message_definitions", ENDLESS)(tmp_path)
    with pytest.raises(FormatError, match=r"cannot be read \((the reader crashed|it took too long|needs more memory)"):
        read(path)


def test_more_rows_than_the_limit(tmp_path: Path) -> None:
    path = save(tmp_path / "a.bag", [*imu(), *mag()])
    with pytest.raises(FormatError, match="400 rows, the limit is 399"):
        read(path, limits=Limits(rows=399))
    assert len(read(path, limits=Limits(rows=400))) == ROWS


def test_another_definition_of_a_type_is_refused(tmp_path: Path) -> None:
    path = save(tmp_path / "a.bag", imu())
    content = path.read_bytes()
    digest = b"6a62c6daae103f4ff57a132d6f95cec2"  # of sensor_msgs/Imu in ROS 1
    assert digest in content
    path.write_bytes(content.replace(digest, digest[::-1]))
    with pytest.raises(FormatError, match="its sensor_msgs/msg/Imu is not the one that ROS defines"):
        read(path)


def test_an_index_that_promises_more_is_doubted(tmp_path: Path) -> None:
    path = _edited(f"message_count: {2 * ROWS}", "message_count: 9999")(tmp_path)
    metadata = path / "metadata.yaml"
    metadata.write_text(metadata.read_text().replace(f"message_count: {ROWS}", "message_count: 500"))
    assert any(f"promises 500 messages, {ROWS} were found" in doubt for doubt in sniff(path).doubts)


def test_the_command_tells_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = save(tmp_path / "two.bag", [*imu("/left/imu"), *imu("/right/imu")])
    assert run(["sniff", str(path)]) == 1
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert "2 Imu topics: /left/imu (sensor_msgs/Imu, 400), /right/imu (sensor_msgs/Imu, 400); say which" in line
    assert run(["sniff", str(path), "--topic", "/right/imu"]) == 0


@pytest.mark.parametrize("kind", ["bag", "bare-mcap", "bare-sqlite3"])
def test_flipped_bytes_are_read_or_refused(tmp_path: Path, kind: str) -> None:
    content = save(tmp_path / "a", [*imu(), *mag()], kind).read_bytes()
    path = tmp_path / "b"
    for seed in range(5):
        rng = np.random.default_rng(seed)
        flipped = bytearray(content)
        for place in rng.integers(len(flipped), size=20):
            flipped[place] = rng.integers(256)
        path.write_bytes(flipped[: rng.integers(len(flipped))] if seed % 4 == 3 else flipped)
        try:
            assert len(read(path)) <= ROWS
        except FormatError as problem:
            assert str(problem).startswith(f"{path}: ")


def test_a_real_bag_cut_short_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "cut.bag"
    shutil.copyfile(data_path("other", "sparkfun_razor.bag"), path)
    path.chmod(0o600)
    path.write_bytes(path.read_bytes()[:100_000])
    with pytest.raises(FormatError, match=r"ROS 1 bag that cannot be read .*rosbag reindex"):
        read(path)
