"""ROS bags: ROS 1 files, ROS 2 folders, and bare MCAP and SQLite files; one inertial unit and its magnetometer."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.recording import place
from poise.errors import FormatError
from poise.formats import bag_library, bag_stamps, bag_topics, bounded, layouts, names, recognise
from poise.formats.held import fresh
from poise.formats.limits import Limits, Options
from poise.formats.names import QUAT
from poise.formats.table import Floats, Table, Whole

_NAMES = {"ros1": "ROS 1 bag", "ros2": "ROS 2 bag", "mcap": "MCAP file", "db3": "ROS 2 SQLite file"}
KINDS = tuple(_NAMES)
_REPAIR = {
    "ros1": "repair it (rosbag reindex) or copy it again",
    "ros2": "repair it (ros2 bag reindex) or copy it again",
    "mcap": "repair it (mcap recover) or copy it again",
    "db3": "copy it again, with its -wal file if there is one, or convert it (ros2 bag convert)",
}
_BASE, _GROWTH, _MOST = 2**30, 40, 8 * 2**30  # bytes of address space: the interpreter and rosbags; a file's; at most
_SECONDS = 10  # s, plus one for every half megabyte: a slow machine decodes 3000 messages a second

_ROTATION, _GYR, _ACC, _GYR_KNOWN, _ACC_KNOWN, _COVARIANCE = (*map(slice, (0, 4, 7), (4, 7, 10)), 10, 11, slice(12, 21))
_FIELDS = {
    "stamp": "s",
    "angular_velocity": "rad/s",
    "linear_acceleration": "m/s²",
    "magnetic_field": "",
    "orientation": "",
}
_EARTH = (2e-6, 2e-3)  # T: lengths that a magnetometer near its motors and magnets may still have
_CONSTANT = 1e-4  # relative spread of a length that a driver has set: every sensor is noisier


class _Messages(NamedTuple):
    """The messages of one topic in the order of arrival; at least one."""

    topic: str
    type: str
    received: NDArray[np.int64]
    """(n,) ns"""
    stamp: NDArray[np.int64]
    """(n,) ns"""
    values: Floats
    """(n, 3), or (n, 21) of an inertial unit"""


class _Bag(NamedTuple):
    """What was taken from a bag."""

    kind: str
    imu: _Messages
    mag: _Messages | None
    notes: list[str]
    doubts: list[str]


def read(path: Path, options: Options) -> Table:
    """The table in a bag: stamps, angular velocity, linear acceleration (specific force) and magnetic field.

    Raises :class:`FormatError` where the bag is damaged, holds no inertial unit or more than one.
    """
    where, bag = str(path), _load(path, options, "recording")
    imu, notes = bag.imu, bag.notes
    time, clock = bag_stamps.of_imu(imu.topic, imu.received, imu.stamp, notes)
    values: dict[str, Floats] = {
        "stamp": time,
        "angular_velocity": _present(imu.values[:, _GYR], imu.values[:, _GYR_KNOWN]),
        "linear_acceleration": _present(imu.values[:, _ACC], imu.values[:, _ACC_KNOWN]),
    }
    for name in ("angular_velocity", "linear_acceleration"):
        if not np.isfinite(values[name]).any():
            raise FormatError(f"{where}: {imu.topic} carries no {name}; poise needs both in one Imu topic")
    quat, empty = _orientation(imu.values)
    if not empty:
        values["orientation"] = quat
    elif "orientation=" in str(options.columns):
        raise FormatError(f"{where}: the orientation in {imu.topic} means nothing: {empty}")
    units: dict[str, str] = dict(_FIELDS)
    age: Floats | None = None
    if bag.mag is not None:
        values["magnetic_field"], units["magnetic_field"], age = _magnetometer(bag.mag, time, clock, notes)
    notes.append(
        f"the orientation in {imu.topic} means nothing: {empty}"
        if empty
        else f"the orientation in {imu.topic} is somebody's own estimate and ignored; compare with it: "
        "--columns orientation=truth_quat"
    )
    return _table(where, bag, values, units, age, options)


def orientation(path: Path, options: Options) -> tuple[Floats, Floats, Floats]:
    """The times (n,) s, quaternions (n, 4) w x y z and sigmas (n, 3) rad that a bag's Imu messages carry.

    Raises :class:`FormatError` where they mean nothing.
    """
    where, imu = str(path), _load(path, options, "orientation").imu
    quat, empty = _orientation(imu.values)
    if empty:
        raise FormatError(f"{where}: no attitude: the orientation in {imu.topic} means nothing: {empty}")
    variance: Floats = imu.values[:, _COVARIANCE][:, [0, 4, 8]]
    with np.errstate(invalid="ignore"):
        sigma = np.sqrt(np.where(np.min(variance, axis=1, keepdims=True) > 0, variance, np.nan))
    sigma[~np.isfinite(quat[:, 0])] = np.nan
    return bag_stamps.of_imu(imu.topic, imu.received, imu.stamp, [])[0], quat, sigma


def own(path: Path, options: Options) -> bool:
    """Whether the orientation in a bag is an attitude that poise wrote, by the mark that its writer leaves."""
    return bool(_found(path, options, "own")["own"])


def _load(path: Path, options: Options, what: str) -> _Bag:
    """The inertial unit's messages and, for a "recording", the magnetometer's, from a bounded child process."""
    where, limits, kind = str(path), options.limits, recognise.kind(str(path), path)
    found = _found(path, options, what)
    if "refused" in found:
        raise FormatError(f"{where}: {found['refused']}")
    doubts: list[str] = []
    taken = {
        name: _taken(where, kind, name, found, limits, doubts) for name in ("imu", "mag") if f"{name}_topic" in found
    }
    told = f"topic {taken['imu'].topic}" + (f", magnetometer {taken['mag'].topic}" if "mag" in taken else "")
    if len(left := found["left"]):
        told += f"; left out {names.listed([str(name) for name in left])}"
    return _Bag(kind, taken["imu"], taken.get("mag"), [told], doubts)


def _found(path: Path, options: Options, what: str) -> dict[str, NDArray[Any]]:
    """The answer of :func:`bag_library.load`, in a bounded child process."""
    where, limits, kind = str(path), options.limits, recognise.kind(str(path), path)
    if bag_library.missing():
        install = 'pip install "poise[ros]"'
        raise FormatError(f"{where}: reading a {_NAMES[kind]} needs rosbags; install it with: {install}")
    size = sum(file.stat().st_size for file in recognise.files(path))
    imu, _, mag = (options.topic or "").partition(",")
    try:
        return bounded.arrays(
            where,
            Path(bag_library.__file__),
            [what, kind, str(path.absolute()), imu.strip(), mag.strip(), str(limits.rows)],
            memory=min(_BASE + _GROWTH * size, _MOST),
            seconds=_SECONDS + size // 500_000,
            limits=limits,
        )
    except bounded.ChildFailure as problem:
        raise FormatError(f"{where}: {_NAMES[kind]} that cannot be read ({problem}); {_REPAIR[kind]}") from None


def _taken(
    where: str, kind: str, name: str, found: dict[str, NDArray[Any]], limits: Limits, doubts: list[str]
) -> _Messages:
    topic, msgtype = map(str, found[f"{name}_topic"])
    promised = int(found[f"{name}_promised"])
    limits.check(where, "rows", promised)
    messages = _Messages(topic, msgtype, *(found[f"{name}_{column}"] for column in ("received", "stamp", "values")))
    if not len(messages.stamp):
        raise FormatError(f"{where}: {topic} should have {promised} messages, found none; {_REPAIR[kind]}")
    if len(messages.stamp) != promised:
        doubts.append(f"{topic}: the bag's index promises {promised} messages, {len(messages.stamp)} were found")
    return messages


def _present(vectors: Floats, covariance: Floats) -> Floats:
    """*vectors* (n, 3), NaN where ROS says that there is none: covariance −1, and nothing in its place."""
    absent = (covariance == -1) & ~np.nan_to_num(vectors).any(axis=1)
    return np.where(absent[:, None], np.nan, vectors)


def _orientation(values: Floats) -> tuple[Floats, str]:
    """The quaternions (n, 4), NaN where one means nothing, and why none of them does ("" where one does)."""
    quat = values[:, _ROTATION].copy()
    absent = values[:, _COVARIANCE][:, 0] == -1
    with np.errstate(invalid="ignore", over="ignore"):
        length = np.sqrt(np.einsum("ij,ij->i", quat, quat))
        broken = ~(np.abs(length - 1) < 0.1)
    quat[absent | broken] = np.nan
    known = quat[np.isfinite(quat[:, 0])]
    if not len(known):
        if absent.all():
            return quat, "its covariance is -1"
        if not (length > 0).any():
            return quat, "zero or NaN in every message"
        return quat, "no quaternion of length 1"
    if (np.abs(known[:, 0]) == 1).all() and not known[:, 1:].any():
        return quat, "the identity in every message"
    return quat, ""


def _magnetometer(
    mag: _Messages, rows: Floats, clock: bag_stamps.Clock, notes: list[str]
) -> tuple[Floats, str, Floats]:
    """Its field (n, 3) on the inertial unit's *rows*, the unit ("" for none), and the ages (n,) s of its samples."""
    field = mag.values
    time = bag_stamps.of_other(mag.topic, mag.received, mag.stamp, clock, notes)
    if held := fresh(field):
        field = np.where(held[0][:, None], field, np.nan)
        notes.append(f"mag: {mag.topic} repeats each sample {held[1]} times; the repeats are left out")
    clean = np.where(np.isfinite(rows), rows, -np.inf)
    rising = np.flatnonzero(clean > np.concatenate([[-np.inf], np.maximum.accumulate(clean)[:-1]]))
    placed, age = np.full((len(rows), 3), np.nan), np.zeros(len(rows))
    placed[rising], age[rising] = place(mag.topic, rows[rising], time, field)
    if mag.type != bag_topics.FIELD:
        return placed, "", age
    length = np.sqrt(np.einsum("ij,ij->i", field, field))
    length = length[np.isfinite(length)]
    median = float(np.median(length)) if len(length) else 0.0
    decade = 10.0 ** np.rint(np.log10(median)) if median > 0 else 0.0
    if decade and np.ptp(length) < _CONSTANT * median and abs(median / decade - 1) < _CONSTANT:
        notes.append(f"mag: every sample of {mag.topic} has length {decade:g}: a direction that its driver normalised")
        return placed, "", age
    if len(length) and not _EARTH[0] <= median <= _EARTH[1]:
        notes.append(f"mag: {mag.topic} should be in T, but its median length {median:.3g} is no field of the Earth's")
        return placed, "", age
    return placed, "T", age


def _table(
    where: str, bag: _Bag, values: dict[str, Floats], units: dict[str, str], age: Floats | None, options: Options
) -> Table:
    columns: dict[str, Floats] = {}
    titles = layouts.renamed(where, list(values), options.columns, len(values))
    for field, title in zip(values, titles, strict=True):
        parsed = names.parse(title)
        if not parsed.role or parsed.role == "quat":
            continue
        unit = "" if parsed.unit or not units[field] else f" ({units[field]})"
        ends = [""] if values[field].ndim == 1 else [f"_{end}" for end in (QUAT if parsed.role == "truth" else "xyz")]
        columns |= {f"{title}{end}{unit}": part for end, part in zip(ends, np.atleast_2d(values[field].T), strict=True)}
    if age is not None and age.any():
        columns["mag_age (s)"] = age
    layout = layouts.choose(where, list(columns))
    found = list(columns.values())
    used = {key: np.array(found[column.index]) for key, column in layout.columns.items()}
    return Table(_NAMES[bag.kind], layout, Whole(used), {}, None, "", bag.notes, bag.doubts)
