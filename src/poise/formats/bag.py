"""ROS bags: ROS 1 files, ROS 2 folders, and bare MCAP and SQLite files; one inertial unit and its magnetometer."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.recording import place
from poise.errors import FormatError
from poise.formats import bag_library, bag_stamps, bag_topics, bounded, names, recognise
from poise.formats.bag_topics import Topic
from poise.formats.held import fresh
from poise.formats.limits import Options
from poise.formats.names import QUAT
from poise.formats.table import Floats, Table

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
_FIELDS = {"stamp": "s", "angular_velocity": "rad/s", "linear_acceleration": "m/s²", "magnetic_field": "", "orientation": ""}
_EARTH = (2e-6, 2e-3)  # T: lengths that a magnetometer near its motors and magnets may still have
_CONSTANT = 1e-4  # relative spread of a length that a driver has set: every sensor is noisier


class _Messages(NamedTuple):
    """The messages of one topic in the order of arrival."""

    received: NDArray[np.int64]
    """(n,) ns"""
    stamp: NDArray[np.int64]
    """(n,) ns"""
    values: Floats
    """(n, 3), or (n, 21) of an inertial unit"""


def read(path: Path, options: Options) -> Table:
    """The table in a bag: stamps, angular velocity, linear acceleration (specific force) and magnetic field.

    Raises :class:`FormatError` where the bag is damaged, holds no inertial unit or more than one.
    """
    where, wanted = str(path), _wanted(options)
    bag = _Bag(path, options)
    topics = bag.topics()
    imu = bag_topics.imu(where, topics, wanted[0])
    mag = bag_topics.mag(where, topics, imu, wanted[1])
    notes, doubts = [_told(topics, imu, mag)], list[str]()
    messages = bag.messages(imu, doubts)
    time, clock = bag_stamps.of_imu(imu.name, messages.received, messages.stamp, notes)
    values: dict[str, Floats] = {
        "stamp": time,
        "angular_velocity": _present(messages.values[:, _GYR], messages.values[:, _GYR_KNOWN]),
        "linear_acceleration": _present(messages.values[:, _ACC], messages.values[:, _ACC_KNOWN]),
    }
    for field in ("angular_velocity", "linear_acceleration"):
        if not np.isfinite(values[field]).any():
            raise FormatError(f"{where}: {imu.name} carries no {field}; poise needs both in one Imu topic")
    quat, empty = _orientation(messages.values)
    if not empty:
        values["orientation"] = quat
    elif "orientation=" in str(options.columns):
        raise FormatError(f"{where}: the orientation in {imu.name} means nothing: {empty}")
    units, age = dict(_FIELDS), None
    if mag is not None:
        field, units["magnetic_field"], age = _magnetometer(bag, mag, time, clock, notes, doubts)
        values["magnetic_field"] = field
    notes.append(
        f"the orientation in {imu.name} means nothing: {empty}"
        if empty
        else f"the orientation in {imu.name} is somebody's own estimate and ignored; compare with it: "
        "--columns orientation=truth_quat"
    )
    return _table(where, bag.kind, values, units, age, options, notes, doubts)


def orientation(path: Path, options: Options) -> tuple[Floats, Floats, Floats]:
    """The times (n,) s, quaternions (n, 4) w x y z and sigmas (n, 3) rad that a bag's Imu messages carry.

    Raises :class:`FormatError` where they mean nothing.
    """
    where = str(path)
    bag = _Bag(path, options)
    imu = bag_topics.imu(where, bag.topics(), _wanted(options)[0], raw=False)
    messages = bag.messages(imu, [])
    quat, empty = _orientation(messages.values)
    if empty:
        raise FormatError(f"{where}: no attitude: the orientation in {imu.name} means nothing: {empty}")
    variance = messages.values[:, _COVARIANCE][:, [0, 4, 8]]
    with np.errstate(invalid="ignore"):
        sigma = np.sqrt(np.where((variance > 0).all(axis=1)[:, None], variance, np.nan))
    sigma[~np.isfinite(quat[:, 0])] = np.nan
    return bag_stamps.of_imu(imu.name, messages.received, messages.stamp, [])[0], quat, sigma


class _Bag:
    """A bag that is read by a bounded child process."""

    def __init__(self, path: Path, options: Options) -> None:
        self.where, self.path, self.limits = str(path), path, options.limits
        self.kind = recognise.kind(self.where, path)
        if bag_library.missing():
            install = 'pip install "poise[ros]"'
            raise FormatError(f"{self.where}: reading a {_NAMES[self.kind]} needs rosbags; install it with: {install}")

    def topics(self) -> list[Topic]:
        """Every topic, connections of one name and type together."""
        found = self._ask("topics")
        counts: dict[tuple[str, str], int] = {}
        for name, kind, count in zip(found["topic"], found["type"], found["count"], strict=True):
            counts[str(name), str(kind)] = counts.get((str(name), str(kind)), 0) + int(count)
        return [Topic(*key, count) for key, count in counts.items()]

    def messages(self, topic: Topic, doubts: list[str]) -> _Messages:
        """The messages of *topic*; at least one."""
        self.limits.check(self.where, "rows", topic.count)
        found = self._ask("messages", topic.name, topic.type, str(self.limits.rows))
        messages = _Messages(found["received"], found["stamp"], found["values"])
        if not len(messages.received):
            raise FormatError(f"{self.where}: {topic.name} should have {topic.count} messages, found none; {self._fix}")
        if (n := len(messages.received)) != topic.count:
            doubts.append(f"{topic.name}: the bag's index promises {topic.count} messages, {n} were found")
        return messages

    def _ask(self, work: str, *arguments: str) -> dict[str, NDArray[Any]]:
        size = sum(file.stat().st_size for file in recognise.files(self.path))
        try:
            return bounded.arrays(
                self.where,
                Path(bag_library.__file__),
                [work, self.kind, str(self.path.absolute()), *arguments],
                memory=min(_BASE + _GROWTH * size, _MOST),
                seconds=_SECONDS + size // 500_000,
                limits=self.limits,
            )
        except bounded.ChildFailure as problem:
            kind = _NAMES[self.kind]
            raise FormatError(f"{self.where}: {kind} that cannot be read ({problem}); {self._fix}") from None

    @property
    def _fix(self) -> str:
        return _REPAIR[self.kind]


def _wanted(options: Options) -> tuple[str, str]:
    """The topics that the caller names: "IMU" or "IMU,MAG"."""
    imu, _, mag = (options.topic or "").partition(",")
    return imu.strip(), mag.strip()


def _told(topics: list[Topic], imu: Topic, mag: Topic | None) -> str:
    left = [t.name for t in topics if t.type == bag_library.IMU and t.name != imu.name]
    told = f"topic {imu.name}" + (f", magnetometer {mag.name}" if mag else "")
    return told + (f"; left out {names.listed(left)}" if left else "")


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
    bag: _Bag, topic: Topic, rows: Floats, clock: bag_stamps.Clock, notes: list[str], doubts: list[str]
) -> tuple[Floats, str, Floats]:
    """Its field (n, 3) on the inertial unit's *rows*, the unit ("" for none), and the ages (n,) s of its samples."""
    messages = bag.messages(topic, doubts)
    field = messages.values
    time = bag_stamps.of_other(topic.name, messages.received, messages.stamp, clock, notes)
    if held := fresh(field):
        field = np.where(held[0][:, None], field, np.nan)
        notes.append(f"mag: {topic.name} repeats each sample {held[1]} times; the repeats are left out")
    clean = np.where(np.isfinite(rows), rows, -np.inf)
    rising = np.flatnonzero(clean > np.concatenate([[-np.inf], np.maximum.accumulate(clean)[:-1]]))
    placed, age = np.full((len(rows), 3), np.nan), np.zeros(len(rows))
    placed[rising], age[rising] = place(topic.name, rows[rising], time, field)
    if topic.type != bag_library.FIELD:
        return placed, "", age
    length = np.sqrt(np.einsum("ij,ij->i", field, field))
    length = length[np.isfinite(length)]
    median = float(np.median(length)) if len(length) else 0.0
    decade = 10.0 ** np.rint(np.log10(median)) if median > 0 else 0.0
    if decade and np.ptp(length) < _CONSTANT * median and abs(median / decade - 1) < _CONSTANT:
        notes.append(f"mag: every sample of {topic.name} has length {decade:g}: a direction that its driver normalised")
        return placed, "", age
    if len(length) and not _EARTH[0] <= median <= _EARTH[1]:
        notes.append(f"mag: {topic.name} should be in T, but its median length {median:.3g} is no field of the Earth's")
        return placed, "", age
    return placed, "T", age


def _table(
    where: str,
    kind: str,
    values: dict[str, Floats],
    units: dict[str, str],
    age: Floats | None,
    options: Options,
    notes: list[str],
    doubts: list[str],
) -> Table:
    columns: dict[str, Floats] = {}
    titles = names.renamed(where, list(values), options.columns, len(values))
    for field, title in zip(values, titles, strict=True):
        parsed = names.parse(title)
        if not parsed.role or parsed.role == "quat":
            continue
        unit = "" if parsed.unit or not units[field] else f" ({units[field]})"
        ends = [""] if values[field].ndim == 1 else [f"_{end}" for end in (QUAT if parsed.role == "truth" else "xyz")]
        columns |= {f"{title}{end}{unit}": part for end, part in zip(ends, np.atleast_2d(values[field].T), strict=True)}
    if age is not None and age.any():
        columns["mag_age (s)"] = age
    layout = names.choose(where, list(columns))
    found = list(columns.values())
    used = {key: np.array(found[column.index]) for key, column in layout.columns.items()}
    return Table(_NAMES[kind], layout, used, {}, None, "", notes, doubts)
