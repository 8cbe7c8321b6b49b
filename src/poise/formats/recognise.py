"""What a file is, by its content: which reader takes it, or why none does."""

from __future__ import annotations

import stat
from pathlib import Path

from poise.errors import FormatError
from poise.formats.limits import Limits

_ROS1 = b"#ROSBAG V2.0\n"
_MAGIC = (
    (b"PAR1", "parquet"),
    (b"PK\x03\x04", "zip"),
    (b"PK\x05\x06", "zip"),
    (b"\x93NUMPY", "one array of numpy's (.npy); save several with names: numpy.savez(file, time=…, gyr=…, acc=…)"),
    (b"MATLAB 7.3", "a MATLAB v7.3 (HDF5) file; save it as save('name.mat', ..., '-v7')"),
    (b"MATLAB", "mat"),
    (b"\x89HDF", "an HDF5 file; export it as CSV, Parquet or npz"),
    (_ROS1, "ros1"),
    (b"#ROSBAG", "a ROS 1 bag of another version than 2.0; convert it with rosbag"),
    (b"\x89MCAP0\r\n", "mcap"),
    (b"SQLite format 3\0", "db3"),
    (b"ULog\x01\x12", "a PX4 ULog; export sensor_combined as CSV (ulog2csv)"),
    (b"\xa3\x95\x80", "an ArduPilot log; export its IMU and MAG messages as CSV"),
    (b"\x1f\x8b", "gzip data; unpack it first: gunzip FILE"),
    (b"BZh", "bzip2 data; unpack it first"),
    (b"\xfd7zXZ", "xz data; unpack it first"),
    (b"\x28\xb5\x2f\xfd", "zstandard data; unpack it first"),
    (b"7z\xbc\xaf", "a 7z archive; unpack it first"),
    (b"ARROW1", "an Arrow/Feather file; write it as Parquet"),
    (b"%PDF", "a PDF document"),
    (b"\x89PNG", "a PNG image"),
    (b"\xff\xd8\xff", "a JPEG image"),
    (b"GIF8", "a GIF image"),
    (b"\x7fELF", "a program"),
    (b"\x80\x02", "a Python pickle, which is never opened: it can run anything; save numbers with numpy.savez"),
    (b"\x80\x03", "a Python pickle, which is never opened: it can run anything; save numbers with numpy.savez"),
    (b"\x80\x04", "a Python pickle, which is never opened: it can run anything; save numbers with numpy.savez"),
    (b"\x80\x05", "a Python pickle, which is never opened: it can run anything; save numbers with numpy.savez"),
    (b"<!DOCTYPE", "a web page"),
    (b"<html", "a web page"),
    (b"<?xml", "an XML document"),
)
_TEXT_BOMS = (b"\xff\xfe", b"\xfe\xff", b"\xef\xbb\xbf")
_READ = ("parquet", "mat", "ros1", "mcap", "db3")
_READABLE = "; poise reads CSV and other text tables, Parquet, npz, MATLAB files up to v7 and ROS bags"
_METADATA = "metadata.yaml"  # what makes a folder a ROS 2 bag


def check(where: str, path: Path, limits: Limits) -> None:
    """Raises :class:`FormatError` where *path* is no regular file or ROS 2 bag, cannot be opened, is empty or too large."""
    try:
        size = 0
        for part in files(path):
            found = part.stat()
            if not stat.S_ISREG(found.st_mode):
                kind = f"a folder without {_METADATA}" if stat.S_ISDIR(found.st_mode) else "a device or pipe"
                inside = "" if part == path else f"{part.name} in it is "
                raise FormatError(f"{where}: {inside}{kind}, expected a file or a ROS 2 bag's folder")
            with part.open("rb") as file:
                file.read(1)
            size += found.st_size
    except (OSError, ValueError) as problem:
        reason = getattr(problem, "strerror", None) or str(problem)
        raise FormatError(f"{where}: cannot be opened: {reason}") from None
    if not size:
        raise FormatError(f"{where}: the file is empty")
    limits.check(where, "size", size)


def files(path: Path) -> list[Path]:
    """The files that make up *path*: itself, or those in a ROS 2 bag's folder in order of their names."""
    if not (path / _METADATA).exists():
        return [path]
    return sorted(part for part in path.iterdir() if not part.is_dir())


def kind(where: str, path: Path) -> str:
    """Which reader takes the file: "text", "parquet", "npz", "mat", "ros1", "ros2", "mcap" or "db3".

    Raises :class:`FormatError` where none does.
    """
    if path.is_dir():
        return "ros2"
    with path.open("rb") as file:
        head = file.read(4096)
    for magic, what in _MAGIC:
        if head.startswith(magic):
            if what == "zip":
                return _zip(where, path)
            if what in _READ:
                return what
            if len(head) < len(_ROS1) and _ROS1.startswith(head):
                what = "a ROS 1 bag that is cut short; copy it again"
            raise FormatError(f"{where}: {what}" + (_READABLE if ";" not in what else ""))
    if head[124:128] in (b"\x00\x01IM", b"\x01\x00MI"):
        return "mat"
    if not head.startswith(_TEXT_BOMS) and _is_binary(head[:512]):
        raise FormatError(f"{where}: binary data of no kind that is known{_READABLE}")
    return "text"


def refuse_topic(where: str, kind: str, topic: str | None) -> None:
    """Raises :class:`FormatError` for a *topic* of a file that has none: what is asked for would be left out in silence."""
    if topic is not None and kind not in ("ros1", "ros2", "mcap", "db3"):
        raise FormatError(f"{where}: only ROS bags have topics, this is a {kind} file; leave --topic {topic!r} out")


def _is_binary(head: bytes) -> bool:
    control = sum(byte < 32 and byte not in b"\t\n\v\f\r" for byte in head)
    return control > 0.1 * len(head) or not any(byte in b"0123456789,;\n\r\t " for byte in head)


def _zip(where: str, path: Path) -> str:
    import struct
    import zipfile

    try:
        with zipfile.ZipFile(path) as archive:
            inside = archive.namelist()
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, EOFError, struct.error) as problem:
        raise FormatError(f"{where}: damaged zip or npz file ({problem}); copy it again") from None
    if inside and all(name.endswith(".npy") for name in inside):
        return "npz"
    if "[Content_Types].xml" in inside:
        raise FormatError(f"{where}: an office document; save the sheet as CSV")
    raise FormatError(f"{where}: a zip archive of {len(inside)} files; unpack it and read the files one by one")
