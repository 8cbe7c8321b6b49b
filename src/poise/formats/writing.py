"""Recordings and attitudes to files that say what they hold and that poise reads back exactly."""

from __future__ import annotations

import io
import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from poise.data import arrow
from poise.data.attitude import Attitude
from poise.data.learned import Learned, Learning
from poise.data.recording import Recording
from poise.errors import FormatError
from poise.formats import bag_writing
from poise.formats.attitudes import TUM
from poise.formats.bodies import Body, ParquetBody, TextBody
from poise.formats.names import QUAT, SENSORS
from poise.formats.npz import FACTS
from poise.formats.saving import replacing
from poise.formats.table import BLOCK
from poise.formats.units import SI

SUFFIXES = {
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
    kind = format or SUFFIXES.get(path.suffix.lower(), "")
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
        elif isinstance(thing, Learned):
            file.write(f"{thing.as_json(indent=2)}\n".encode())
        else:
            rows, facts = body(kind, file, io.BytesIO(), columns(kind, thing)), _facts(thing)
            unknown = int(np.sum(~has_attitude(thing))) if kind == "tum" else 0
            file.write(rows.head(facts, comments(unknown, len(thing))))
            for table in tables(kind, thing):
                rows.add(table)
            file.write(rows.tail(facts))
    return path


def body(kind: str, file: BinaryIO, index: BinaryIO, names: tuple[str, ...]) -> Body:
    """Where the rows of a "parquet", "csv" or "tum" file with columns *names* are appended to."""
    if kind == "parquet":
        return ParquetBody(file, index, names)
    return TextBody(file, names, " " if kind == "tum" else ",")


def columns(kind: str, thing: Attitude | Recording | Learning) -> tuple[str, ...]:
    """The names of a file's columns."""
    return TUM if kind == "tum" else tuple(_columns(thing))


def comments(unknown: int, rows: int) -> list[str]:
    """What a TUM file says of the rows that are not in it."""
    return [f"{unknown} of {rows} rows have no attitude and are left out"] if unknown else []


def tables(kind: str, thing: Attitude | Recording | Learning) -> Iterator[Any]:
    """The rows of a "parquet", "csv" or "tum" file as Arrow tables of a block of rows each; at least one."""
    if kind == "tum" and isinstance(thing, Attitude):
        thing = thing[has_attitude(thing)]
    for start in range(0, max(len(thing), 1), BLOCK):
        part = thing[start : start + BLOCK]
        yield arrow.table(_tum(part) if kind == "tum" and isinstance(part, Attitude) else _columns(part))


def has_attitude(thing: Any) -> NDArray[np.bool_]:
    """(n,) the rows of an attitude that a TUM file holds."""
    return np.asarray(np.isfinite(thing.quat).all(axis=1) & np.isfinite(thing.time))


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


def _tum(attitude: Attitude) -> dict[str, Any]:
    zero = np.zeros(len(attitude))
    return dict(zip(TUM, [attitude.time, zero, zero, zero, *attitude.quat_xyzw.T], strict=True))


def _npz(recording: Recording, file: BinaryIO) -> None:
    arrays: dict[str, Any] = {name: getattr(recording, name) for name in ("time", *SENSORS, "acc_age", "mag_age")}
    if recording.truth is not None:
        arrays["truth_quat"] = recording.truth.quat
    if recording.moving is not None:
        arrays["moving"] = recording.moving
    arrays[FACTS] = np.array(json.dumps(_facts(recording)))
    np.savez(file, **arrays)
