"""Attitudes from files: what poise wrote, bit for bit, and other people's references (quaternion tables, TUM)."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from poise.data.attitude import COLUMNS, QUAT, SIGMA, Attitude, Provenance
from poise.data.learned import Learned
from poise.data.stamps import Turns
from poise.errors import FormatError, RecordingError
from poise.formats import bag, evidence, names, parquet, recognise, text, text_head, text_stamps, units
from poise.formats.limits import Limits, Options
from poise.formats.names import QUAT as QUAT_NAMES
from poise.formats.table import Floats, everything

TABLE = (*QUAT_NAMES, *(f"{name}_{axis}" for name in ("rate", "bias", "sigma", "bias_sigma") for axis in "xyz"))
TUM = ("timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw")


def read_attitude(path: str | os.PathLike[str], *, topic: str | None = None, limits: Limits | None = None) -> Attitude:
    """The attitude in a Parquet, CSV or TUM file: one that poise wrote, or a table with time and qw, qx, qy, qz.

    From a ROS bag, the orientation in the Imu messages of *topic*: body to ENU, with sigma where a covariance is given.
    Raises :class:`FormatError` where there is none.
    """
    where, options = str(path), Options(topic=topic, limits=limits or Limits())
    path = Path(path)
    recognise.check(where, path, options.limits)
    kind = recognise.kind(where, path)
    if kind not in ("text", "parquet", *bag.KINDS):
        raise FormatError(
            f"{where}: attitudes are read from Parquet, CSV, TUM text and ROS bags, this is a {kind} file"
        )
    recognise.refuse_topic(where, kind, topic)
    try:
        if kind in bag.KINDS:
            time, quat, sigma = bag.orientation(path, options)
            attitude = reference(time, quat)
            attitude.table[:, SIGMA] = sigma
            return attitude
        found, facts, time_unit = (_from_parquet if kind == "parquet" else _from_text)(where, path, options)
        return _attitude(where, found, facts, time_unit)
    except RecordingError as problem:
        raise FormatError(f"{where}: {problem}") from None


def wrote_attitude(path: str | os.PathLike[str], *, limits: Limits | None = None) -> bool:
    """Whether *path* is a ROS bag whose orientation poise wrote: an attitude, though it holds samples too.

    Raises :class:`FormatError` where the file cannot be read.
    """
    where, options = str(path), Options(limits=limits or Limits())
    path = Path(path)
    recognise.check(where, path, options.limits)
    return recognise.kind(where, path) in bag.KINDS and bag.own(path, options)


def reference(time: Floats, quat: Floats, **facts: Any) -> Attitude:
    """:meth:`Attitude.of` that leaves quaternions (n, 4) of length 1 as they are, bit for bit."""
    attitude = Attitude.of(time, quat, **facts)
    with np.errstate(invalid="ignore", over="ignore"):
        unit = np.abs(np.einsum("ij,ij->i", quat, quat) - 1) < 1e-12
    attitude.quat[unit] = quat[unit]
    return attitude


def _from_parquet(where: str, path: Path, options: Options) -> tuple[dict[str, Floats], dict[str, str], str]:
    with parquet.opened(where, path) as file:
        present = file.schema_arrow.names
        options.limits.check(where, "columns", len(present))
        facts = parquet.metadata(file)
        wanted, unit = _wanted(where, present)
        rows = parquet.ParquetRows(where, path, file, {k: present[i] for k, i in wanted.items()}, options)
    return everything(where, rows, options.limits), facts, "s" if rows.calendar else unit


def _from_text(where: str, path: Path, options: Options) -> tuple[dict[str, Floats], dict[str, str], str]:
    with path.open("rb") as file:
        head = file.read(4 * options.limits.line)
        dialect = text_head.inspect(where, head, not file.read(1), options)
        header = dialect.names
        if header is None and len(dialect.first) == len(TUM) and dialect.delimiter == " ":
            header = TUM
        if header is None:
            found = f"{len(dialect.first)} columns without a header"
            raise FormatError(f"{where}: {found}; expected columns time, qw, qx, qy, qz, or the eight of TUM")
        wanted, unit = _wanted(where, header)
    values = everything(where, text.TextRows(where, path, dialect, wanted, options.limits), options.limits)
    written = dialect.written(wanted)
    if written == text_stamps.CLOCK:
        values["time"] = Turns([text_stamps.DAY], text_stamps.DAY / 2).of(values["time"])
    return values, dialect.facts, "s" if header == TUM or written or dialect.iso(wanted["time"]) else unit


def _wanted(where: str, present: tuple[str, ...] | list[str]) -> tuple[dict[str, int], str]:
    """Column numbers by name, and the unit that the name of time carries."""
    parsed = [names.parse(name) for name in present]
    roles = {field.role: i for i, field in reversed(list(enumerate(parsed))) if field.role}
    kind = "quat" if "quat_qw" in roles else "truth"
    missing = [name for name in QUAT_NAMES if f"{kind}_{name}" not in roles]
    if missing or "time" not in roles:
        raise FormatError(f"{where}: no attitude: expected columns time, qw, qx, qy, qz, found {names.listed(present)}")
    wanted = {name: roles[f"{kind}_{name}"] for name in QUAT_NAMES} | {"time": roles["time"]}
    wanted |= {name: present.index(name) for name in (*TABLE[4:], "flags") if name in present}
    return wanted, parsed[roles["time"]].unit


def _attitude(where: str, found: Mapping[str, Floats], facts: Mapping[str, str], time_unit: str) -> Attitude:
    own = facts.get("poise.kind") == "attitude"
    prefix = "poise.truth_" if facts.get("poise.kind") == "recording" else "poise."
    kept: dict[str, Any] = {
        "frame": facts.get(f"{prefix}frame", "enu"),
        "heading_reference": facts.get(f"{prefix}heading_reference", "arbitrary"),
        "provenance": _provenance(facts) if own else Provenance(),
        "learned": Learned.of_json(facts["poise.learned"]) if own and "poise.learned" in facts else None,
    }
    if kept["frame"] not in ("enu", "ned", "nwu", "body"):
        raise FormatError(f"{where}: frame {kept['frame']!r} is not known; expected enu, ned, nwu or body")
    time = found["time"] if own else _seconds(where, found["time"], time_unit)
    if own and all(name in found for name in (*TABLE, "flags")):
        table = np.empty((len(time), COLUMNS))
        for i, name in enumerate(TABLE):
            table[:, i] = found[name]
        with np.errstate(invalid="ignore"):
            return Attitude(time, table, np.nan_to_num(found["flags"]).astype(np.uint32), **kept)
    quat = np.column_stack([found[name] for name in TABLE[QUAT]])
    learned = kept.pop("learned")
    return replace(reference(time, quat, **kept), learned=learned)


def _seconds(where: str, time: Floats, named: str) -> Floats:
    unit = units.expect("time", named, where) if named else evidence.of_time(time).unit
    if not unit and len(time) > 1:
        raise FormatError(f"{where}: unit of time not named; call the column time (s), (ms), (us) or (ns)")
    return time / units.FACTORS["time"][unit or "s"]


def _provenance(facts: Mapping[str, str]) -> Provenance:
    try:
        parameters = json.loads(facts.get("poise.parameters", "{}"))
    except ValueError:
        parameters = {}
    return Provenance(
        facts.get("poise.method", ""),
        parameters if isinstance(parameters, dict) else {},
        facts.get("poise.source", ""),
        facts.get("poise.source_sha256", ""),
    )
