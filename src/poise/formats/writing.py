"""Recordings and attitudes to files that say what they hold and that poise reads back exactly."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from poise.data import arrow
from poise.data.attitude import Attitude
from poise.data.learned import Learned, Learning
from poise.data.recording import Recording
from poise.errors import FormatError
from poise.formats import bag_writing
from poise.formats.attitudes import TUM
from poise.formats.names import QUAT, SENSORS
from poise.formats.npz import FACTS
from poise.formats.saving import replacing
from poise.formats.units import SI

_SUFFIXES = {
    ".parquet": "parquet",
    ".csv": "csv",
    ".tum": "tum",
    ".txt": "tum",
    ".npz": "npz",
    ".bag": "bag",
    ".mcap": "mcap",
    ".json": "json",
}
_KINDS: dict[type, tuple[str, ...]] = {
    Attitude: ("parquet", "csv", "tum", *bag_writing.KINDS),
    Recording: ("parquet", "csv", "npz"),
    Learning: ("parquet", "csv"),
    Learned: ("json",),
}
_WHAT = {
    Attitude: "an attitude",
    Recording: "a recording",
    Learning: "what was learned over time",
    Learned: "what was learned",
}
_BLOCK = 65_536  # rows


def write(
    thing: Attitude | Recording | Learning | Learned,
    path: str | os.PathLike[str],
    format: str | None = None,
    *,
    recording: Recording | None = None,
) -> Path:
    """Write an attitude (Parquet, CSV, TUM, ROS bag) or a recording (Parquet, CSV, npz), or what was learned (JSON) or is
    known over time (Parquet, CSV); returns the path.

    The format is *format* or follows from the extension; "bag" is ROS 1, "mcap" one file and "ros2" a folder of ROS 2,
    which take the angular velocity and linear acceleration of the attitude's *recording* along.
    Raises :class:`FormatError` where it does not fit or the file cannot be written; then nothing is left behind and what
    stood there before still stands.
    """
    path = Path(path)
    allowed = _KINDS.get(type(thing))
    if allowed is None:
        raise FormatError(f"{path}: expected an Attitude or a Recording to write, found {type(thing).__name__}")
    kind = format or _SUFFIXES.get(path.suffix.lower(), "")
    if kind not in allowed:
        raise FormatError(
            f"{path}: {kind or path.suffix or 'no extension'} is no format for {_WHAT[type(thing)]}; "
            f"expected {', '.join(allowed)} (by extension or format=)"
        )
    if kind in bag_writing.KINDS and isinstance(thing, Attitude):
        bag_writing.write(thing, path, kind, recording)
        return path
    with replacing(path) as file:
        if kind == "npz" and isinstance(thing, Recording):
            _npz(thing, file)
        elif kind == "tum" and isinstance(thing, Attitude):
            _tum(thing, file)
        elif isinstance(thing, Learned):
            file.write(f"{thing.as_json(indent=2)}\n".encode())
        else:
            {"parquet": _parquet, "csv": _csv}[kind](thing, file)
    return path


def _columns(thing: Attitude | Recording | Learning) -> dict[str, Any]:
    if not isinstance(thing, Recording):
        return dict(thing.columns())
    columns: dict[str, Any] = {"time (s)": thing.time}
    for sensor in SENSORS:
        columns |= {f"{sensor}_{axis} ({SI[sensor]})": getattr(thing, sensor)[:, i] for i, axis in enumerate("xyz")}
    columns |= {f"{name} (s)": age for name in ("acc_age", "mag_age") if (age := getattr(thing, name)).any()}
    if thing.truth is not None:
        columns |= {f"truth_{name}": thing.truth.quat[:, i] for i, name in enumerate(QUAT)}
    if thing.moving is not None:
        columns["moving"] = thing.moving.astype(np.uint8)
    return columns


def _facts(thing: Attitude | Recording | Learning) -> dict[str, str]:
    if not isinstance(thing, Recording):
        return thing.metadata()
    from poise.version import __version__

    facts = {
        "poise.kind": "recording",
        "poise.version": __version__,
        "poise.units": "; ".join(f"{sensor} {unit}" for sensor, unit in SI.items()),
        "poise.gravity": repr(float(thing.gravity)),
        "poise.source": thing.source,
        "poise.source_sha256": thing.source_hash,
    }
    if thing.truth is not None:
        facts["poise.truth_frame"] = thing.truth.frame
        facts["poise.truth_heading_reference"] = thing.truth.heading_reference
    return facts


def _tables(thing: Attitude | Recording | Learning) -> Iterator[Any]:
    """Arrow tables of a block of rows each; at least one."""
    for start in range(0, max(len(thing), 1), _BLOCK):
        yield arrow.table(_columns(thing[start : start + _BLOCK]))


def _parquet(thing: Attitude | Recording | Learning, file: BinaryIO) -> None:
    from pyarrow import parquet

    writer = None
    facts = _facts(thing)
    how: dict[str, Any] = {"compression": "zstd", "use_dictionary": False, "write_page_checksum": True}
    names = list(_columns(thing))
    for table in _tables(thing):
        table = table.select(names).replace_schema_metadata(facts)
        writer = writer or parquet.ParquetWriter(file, table.schema, **how)
        writer.write_table(table)
    if writer is not None:
        writer.close()


def _csv(thing: Attitude | Recording | Learning, file: BinaryIO) -> None:
    names = list(_columns(thing))
    file.write(_comments(_facts(thing)) + (",".join(names) + "\n").encode())
    for table in _tables(thing):
        _rows(table.select(names), file, ",")


def _tum(attitude: Attitude, file: BinaryIO) -> None:
    known = np.isfinite(attitude.quat).all(axis=1) & np.isfinite(attitude.time)
    kept = attitude[known]
    file.write(_comments(attitude.metadata()))
    if len(kept) < len(attitude):
        left_out = len(attitude) - len(kept)
        file.write(f"# {left_out} of {len(attitude)} rows have no attitude and are left out\n".encode())
    file.write(f"# {' '.join(TUM)}\n".encode())
    for start in range(0, len(kept), _BLOCK):
        block = kept[start : start + _BLOCK]
        zero = np.zeros(len(block))
        columns = [block.time, zero, zero, zero, *block.quat_xyzw.T]
        _rows(arrow.table(dict(zip(TUM, columns, strict=True))), file, " ")


def _npz(recording: Recording, file: BinaryIO) -> None:
    arrays: dict[str, Any] = {name: getattr(recording, name) for name in ("time", *SENSORS, "acc_age", "mag_age")}
    if recording.truth is not None:
        arrays["truth_quat"] = recording.truth.quat
    if recording.moving is not None:
        arrays["moving"] = recording.moving
    arrays[FACTS] = np.array(json.dumps(_facts(recording)))
    np.savez(file, **arrays)


def _rows(table: Any, file: BinaryIO, delimiter: str) -> None:
    from pyarrow import csv

    csv.write_csv(table, file, csv.WriteOptions(include_header=False, delimiter=delimiter, quoting_style="none"))


def _comments(facts: dict[str, str]) -> bytes:
    return "".join(f"# {key}: {_one_line(value)}\n" for key, value in facts.items()).encode()


def _one_line(value: str) -> str:
    """*value*, or its JSON where it would not survive as the rest of a line."""
    return value if value.isprintable() and value == value.strip() and value[:1] != '"' else json.dumps(value)
