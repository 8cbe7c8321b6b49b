"""The files of the fault matrix: a table written in every way people do, damaged, and made to do harm."""

from __future__ import annotations

import gzip
import io
import pickle
import re
import struct
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

ROWS = 400
NAMES = "time (s),gx (rad/s),gy,gz,ax (m/s2),ay,az,mx (uT),my,mz"
TOLD = "time,gx[rad/s],gy,gz,ax[m/s2],ay,az,mx[uT],my,mz"


def samples() -> NDArray[np.float64]:
    """(400, 10): time, gyr, acc, mag of a turning sensor, no value of which is another's with a digit less."""
    time = np.arange(ROWS) / 100
    gyr = np.column_stack([0.3 * np.sin(time), 0.25 * np.cos(2 * time), 0.5 + 0.1 * np.sin(3 * time)])
    acc = np.column_stack([0.5 * np.sin(time), 0.4 * np.cos(time), 9.8 + 0.1 * np.sin(5 * time)])
    mag = np.column_stack([18 * np.sin(time / 2), 18 * np.cos(time / 2), np.full(ROWS, -45.25)])
    return np.round(np.column_stack([time, gyr, acc, mag]), 5)


def text(rows: NDArray[np.float64], names: str = NAMES) -> str:
    lines = [",".join(f"{value:.5f}" for value in row) for row in rows]
    return "\n".join([*([names] if names else []), *lines]) + "\n"


class Case(NamedTuple):
    """A file, how it is read, and what may come of it."""

    content: bytes
    refused: str | None = None
    """what the refusal must say (a regular expression); None: it must be read right"""
    options: dict[str, Any] = {}  # noqa: RUF012  (never written to)
    said: str = ""
    """what must be said of it where it is read"""
    left_out: int = 0
    """rows at the end that may be missing, if it is said"""


def written() -> dict[str, Case]:
    """F2: the ways in which a table of samples is written down, right or wrong."""
    rows = samples()
    plain = text(rows)
    german = plain.replace(",", ";").replace(".", ",")
    lines = plain.splitlines(keepends=True)
    body = "".join(lines[1:])
    at = f"line {len(lines) + 1}"
    middle = lines[:200], lines[200:]

    def between(inserted: str | bytes) -> bytes:
        extra = inserted.encode() if isinstance(inserted, str) else inserted
        return "".join(middle[0]).encode() + extra + "".join(middle[1]).encode()

    ok = {
        "as it should be": plain,
        "semicolons": plain.replace(",", ";"),
        "decimal comma, semicolons": german,
        "decimal comma, tabs": german.replace(";", "\t"),
        "tabs": plain.replace(",", "\t"),
        "blanks": plain.replace(" (", "(").replace(",", "  "),
        "bars": plain.replace(",", "|"),
        "CR LF": plain.replace("\n", "\r\n"),
        "CR": plain.replace("\n", "\r"),
        "CR LF and LF mixed": plain.replace("\n", "\r\n", 100),
        "UTF-8 with byte order mark": "\ufeff" + plain,
        "comments above, between and below": "# a\n// b\n"
        + "".join(middle[0])
        + "% c\n"
        + "".join(middle[1])
        + "# d\n",
        "empty lines": plain.replace("\n", "\n\n", 50),
        "delimiter behind the last cell": plain.replace("\n", ",\n"),
        "title lines above the names": "Logger 3000\nmade today\n" + plain,
        "units below the names": "time,gx,gy,gz,ax,ay,az,mx,my,mz\ns,rad/s,,,m/s2,,,uT,,\n" + body,
        "quoted cells": re.sub(r"[^,\n]+", r'"\g<0>"', plain),
        "a first line sep=;": "sep=;\n" + plain.replace(",", ";"),
        "a column of text": re.sub(r"(?m)^(.+)$", r"walk,\1", plain),
    }
    cases = {name: Case(content.encode()) for name, content in ok.items()}
    cases |= {
        "UTF-16 LE": Case(plain.encode("utf-16")),
        "UTF-16 BE": Case(b"\xfe\xff" + plain.encode("utf-16-be")),
        "UTF-16 without a mark": Case(plain.encode("utf-16-le"), "binary data|UTF-16"),
        "Windows' µ and ² in the names": Case(plain.replace("uT", "µT").replace("m/s2", "m/s²").encode("cp1252")),
        "no names": Case(body.encode(), "10 columns without a header; say what they are: --columns"),
        "no names, told": Case(body.encode(), options={"columns": TOLD}),
        "names only": Case(lines[0].encode(), "line 1 names columns, but no row of numbers follows"),
        "names in one comment": Case(f"# {plain}".replace(" (", "(").encode()),
        "comments only": Case(b"# nothing\n# here\n", "no rows of numbers"),
        "nothing": Case(b"", "the file is empty"),
        "prose": Case(b"It was a dark night.\nThe storm raged.\n", "no rows of numbers"),
        "wrong delimiter told": Case(plain.encode(), "no rows of numbers with --delimiter ';'", {"delimiter": ";"}),
        "wrong decimal sign told": Case(plain.encode(), "no rows of numbers with --decimal ','", {"decimal": ","}),
        "decimal comma, commas between": Case(plain.replace(".", ",").encode(), "line|delimiter|decimal"),
        "decimal comma from line 201 on": Case(
            between(lines[200].replace(",", ";").replace(".", ",")), "line 201: 1 cells|line 201"
        ),
        "a row too short": Case(between("1,2,3\n"), "line 201: 3 cells, expected 10"),
        "a row too long": Case(between("1" + ",2" * 11 + "\n"), "line 201: 12 cells, expected 10"),
        "text in a number": Case(between(lines[200].replace(",", ",x", 3)), r"line 201, column 2 \(gx \(rad/s\)\)"),
        "NUL bytes": Case(between(b"\0" * 50), "line 201: NUL bytes"),
        "two logs, names again": Case((plain + plain).encode(), f"{at}: .*second log"),
        "two logs, other columns": Case((plain + "a,b,c\n1,2,3\n").encode(), f"{at}: .*(second log|3 cells)"),
        "two logs, stamps begin again": Case((plain + body).encode(), said="1 stamps do not rise"),
        "a cut last row": Case(plain.encode()[:-70], said="the last row is cut short and left out", left_out=1),
        "a last row cut in its last cell": Case(plain.encode()[:-3], said="the last row is cut short and left out", left_out=1),
        "a last row without line break": Case(plain.encode()[:-1], said="may be cut short"),
        "a quote that is never closed": Case(between('0.1,"1,2,3,4,5,6,7,8,9\n'), "line 201"),
        "thousands separators": Case(between(lines[200].replace("9.", "9'", 1)), "line 201, column"),
        "two columns of one name": Case(plain.replace("gy,gz", "gy,gx").encode(), "both claim to be gyr_x"),
        "a name too many": Case(plain.replace("mz", "mz,extra", 1).encode(), "names 11 columns"),
        "no time": Case(plain.replace("time (s)", "n", 1).encode(), "no time column"),
        "no gyroscope": Case(plain.replace("gx (rad/s),gy,gz", "a,b,c", 1).encode(), "no column for gyr_x"),
    }  # fmt: skip
    return cases


# -- F3 ---------------------------------------------------------------------------------------------------------------


def whole(folder: Path) -> dict[str, Path]:
    """One good file of every kind that can be written here."""
    from pyarrow import csv, parquet
    from scipy.io import savemat

    import poise

    rows = samples()
    recording = poise.Recording(rows[:, 0], rows[:, 1:4], rows[:, 4:7], rows[:, 7:])
    attitude = poise.estimate(poise.AdaptiveGain(), recording)
    made = {"csv": folder / "a.csv", "csv, UTF-16": folder / "a16.csv", "tsv": folder / "a.tsv"}
    made["csv"].write_bytes(text(rows).encode())
    made["csv, UTF-16"].write_bytes(text(rows).encode("utf-16"))
    made["tsv"].write_bytes(text(rows).replace(",", "\t").encode())
    made["csv of poise's"] = poise.write(recording, folder / "p.csv")
    made["parquet of poise's"] = poise.write(recording, folder / "p.parquet")
    made["npz of poise's"] = poise.write(recording, folder / "p.npz")
    made["parquet"], made["npz, packed"] = folder / "a.parquet", folder / "a.npz"
    parquet.write_table(csv.read_csv(made["csv"]), made["parquet"])
    arrays = {"time": rows[:, 0], "gyr": rows[:, 1:4], "acc": rows[:, 4:7], "mag": rows[:, 7:]}
    np.savez_compressed(made["npz, packed"], **arrays)
    for name, packed in (("mat", False), ("mat, packed", True)):
        made[name] = folder / f"{name.replace(', ', '-')}.mat"
        savemat(made[name], arrays, do_compression=packed)
    try:
        for suffix in ("bag", "mcap"):
            made[f"{suffix} (ROS)"] = poise.write(attitude, folder / f"a.{suffix}", recording=recording)
    except poise.PoiseError:  # without the extra
        made = {name: path for name, path in made.items() if "ROS" not in name}
    return made


def damaged(content: bytes, seed: int) -> bytes:
    """*content* cut off anywhere (even seeds), or with one to a hundred bytes replaced."""
    rng = np.random.default_rng(seed)
    if seed % 2 == 0:
        return content[: rng.integers(len(content))]
    flipped = bytearray(content)
    for _ in range(int(rng.choice([1, 3, 10, 100]))):
        flipped[rng.integers(len(flipped))] = rng.integers(256)
    return bytes(flipped)


# -- F4 ---------------------------------------------------------------------------------------------------------------


class Evil:
    """Leaves a file behind when it is unpickled."""

    def __init__(self, sign: Path) -> None:
        self.sign = sign

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[str, str]]:
        return open, (str(self.sign), "w")


def hostile(folder: Path, sign: Path) -> dict[str, Path]:
    """Files that ask for too much or for something to be run; *sign* appears where one is obeyed."""
    made: dict[str, Path] = {}

    def file(name: str, content: bytes, suffix: str = ".bin") -> None:
        made[name] = folder / (re.sub(r"\W+", "-", name) + suffix)
        made[name].write_bytes(content)

    nothing = np.zeros(3)
    for name, make in (("npz bomb", _npz_bomb), ("npz bomb, one member", _npz_bomb_small)):
        file(name, make(), ".npz")
    for name, content in _LYING.items():
        file(f"npz, {name}", _zipped({"gyr.npy": content}), ".npz")
    file("npz, object array", _saved(gyr=np.array([Evil(sign)], object), acc=nothing, time=nothing), ".npz")
    for suffix in (".csv", ".npz", ".npy", ".mat", ".parquet", ".bag"):
        for protocol in (0, 2, 5):
            file(f"pickle (protocol {protocol}) named {suffix}", pickle.dumps(Evil(sign), protocol), suffix)
    file("npy, object array", _npy(np.array([Evil(sign)], object)), ".npy")
    file("zip with ../ in it", _zipped({"../../../tmp/evil.csv": b"1,2,3"}), ".zip")
    file("npz with ../ in it", _zipped({"../../../tmp/gyr.npy": _npy(np.zeros((3, 3)))}), ".npz")
    file("gzip bomb", gzip.compress(bytes(200_000_000), 1), ".csv")
    file("a line of 50 MB", text(samples()).encode() + b"1" * 50_000_000)
    file("a first line of 50 MB", b"1," * 25_000_000)
    file("a line of 50 MB in UTF-16", text(samples()).encode("utf-16") + ("1" * 25_000_000).encode("utf-16-le"))
    file("100 000 columns", b",".join(b"c%d" % i for i in range(9000)) + b"\n" + b"1," * 8999 + b"1\n")
    file("mat bomb", _MAT + _mat_bomb(), ".mat")
    good = _matrix("gyr", 1, 3, bytes(24))
    tags = struct.pack("<II", 9, 24)
    file("mat, dimensions that lie", _MAT + _matrix("gyr", 2**31 - 1, 2**31 - 1, bytes(24)), ".mat")
    file("mat, a length that lies", _MAT + struct.pack("<II", 14, 2**32 - 8) + good[8:], ".mat")
    for i, tag in enumerate(((0xFFFF0009, 0xFFFFFFF0), (0x7FFF7FFF, 24), (9, 0xFFFFFFFF), (0x00040009, 24), (14, 24))):
        file(f"mat, crafted tags {i + 1}", _MAT + good.replace(tags, struct.pack("<II", *tag)), ".mat")
    file("mat, nested 3000 deep", _MAT + _nested(3000), ".mat")
    file("parquet bomb", _parquet_bomb(), ".parquet")
    file("parquet, footer of 2 GB", b"PAR1" + bytes(100) + struct.pack("<I", 2**31 - 1) + b"PAR1", ".parquet")
    for kind, magic in (("bag", b"#ROSBAG V2.0\n"), ("mcap", b"\x89MCAP0\r\n"), ("db3", b"SQLite format 3\0")):
        file(f"{kind}, noise", magic + np.random.default_rng(1).bytes(200_000), f".{kind}")
    file("bag, a record of 4 GB", b"#ROSBAG V2.0\n" + struct.pack("<I", 2**32 - 1) + bytes(100), ".bag")
    return made


def _npy(array: NDArray[Any]) -> bytes:
    made = io.BytesIO()
    np.save(made, array, allow_pickle=True)
    return made.getvalue()


def _saved(**arrays: NDArray[Any]) -> bytes:
    made = io.BytesIO()
    np.savez(made, allow_pickle=True, **arrays)  # type: ignore[arg-type]
    return made.getvalue()


def _zipped(members: dict[str, bytes]) -> bytes:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return made.getvalue()


def _member(shape: str, data: bytes = b"", descr: str = "<f8") -> bytes:
    header = f"{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}".ljust(117).encode() + b"\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + data


_LYING = {
    "a shape that lies": _member("(1000000000, 3)", bytes(24)),
    "a shape below 0": _member("(-1, 3)", bytes(24)),
    "a shape to be evaluated": _member("(10**30, 3)"),
    "objects said in the header": _member("(3, 1)", bytes(24), "|O"),
    "a call for a header": _member("__import__('os').system('true')"),
    "a header of 4 GB": b"\x93NUMPY\x02\x00" + b"\xff" * 4 + b" " * 1000,
}


def _npz_bomb() -> bytes:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("gyr.npy", "w") as stream:
        stream.write(_member("(20000000, 3)"))
        for _ in range(480):
            stream.write(bytes(1_000_000))
    return made.getvalue()


def _npz_bomb_small() -> bytes:
    """One whose directory claims a few bytes where there are many."""
    content = bytearray(_zipped({"gyr.npy": _member("(30, 3)") + bytes(100_000_000)}))
    true, claimed = struct.pack("<I", 128 + 100_000_000), struct.pack("<I", 128 + 720)
    return bytes(content.replace(true, claimed))


def _element(kind: int, data: bytes) -> bytes:
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def _matrix(name: str, rows: int, columns: int, data: bytes, flags: int = 6, kind: int = 9) -> bytes:
    parts = _element(6, struct.pack("<II", flags, 0)) + _element(5, struct.pack("<ii", rows, columns))
    return _element(14, parts + _element(1, name.encode()) + _element(kind, data))


_MAT = b"MATLAB 5.0 MAT-file".ljust(116) + bytes(8) + b"\x00\x01IM"


def _mat_bomb() -> bytes:
    packer = zlib.compressobj(1)
    start = _matrix("gyr", 100_000_000, 1, b"")[:-8] + struct.pack("<II", 9, 800_000_000)
    packed = packer.compress(start[:4] + struct.pack("<I", 800_000_056) + start[8:])
    return _element(15, packed + b"".join(packer.compress(bytes(1_000_000)) for _ in range(800)) + packer.flush())


def _nested(depth: int) -> bytes:
    inner = _matrix("", 1, 1, b"", 1)
    for _ in range(depth):
        inner = _element(14, inner[8:48] + inner)
    return inner


def _parquet_bomb() -> bytes:
    """A few kilobytes that are 3·10⁸ zeros."""
    import pyarrow
    from pyarrow import parquet

    zeros = pyarrow.array(np.zeros(1_000_000))
    table = pyarrow.table(dict.fromkeys(("time", "gx", "gy", "gz", "ax", "ay", "az"), zeros))
    made = io.BytesIO()
    with parquet.ParquetWriter(made, table.schema, compression="zstd") as writer:
        for _ in range(40):
            writer.write_table(table, 1_000_000)
    return made.getvalue()
