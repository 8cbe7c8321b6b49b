"""The one module that imports rosbags. Its :func:`load` runs in a bounded child, by path; only writing runs in this process.

Message definitions inside a bag are never compiled: the three types that are read are ROS's own, and their layout is known.
"""

from __future__ import annotations

import struct
from array import array
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from urllib.parse import quote

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_IMU = "sensor_msgs/msg/Imu"
_OWN = "/poise_attitude"  # the node that a ROS 1 bag by poise names
_OWN_DATA = "poise.kind: attitude"  # among the custom data in the metadata.yaml of a ROS 2 bag by poise
_MCAP_END = struct.Struct("<BQQQI8s")  # the footer record and the magic: opcode, length, start of the summary, …
_UNKNOWN, _ABSENT = (
    [0.0] * 9,
    [-1.0] + [0.0] * 8,
)  # ROS's words for a covariance that is not known, a value that is none


def missing() -> bool:
    """Whether rosbags is not installed."""
    from importlib.util import find_spec

    return find_spec("rosbags") is None


# -- reading, in the child --------------------------------------------------------------------------------------------


def load(what: str, kind: str, path: str, imu: str, mag: str, most: str) -> dict[str, Any]:
    """The messages of a bag's inertial unit, and of its magnetometer if *what* is "recording" and not "orientation".

    *imu* and *mag* are the topics that the caller names, or ""; above *most* messages a topic is only counted. "refused"
    in the answer is why no topic could be chosen. Where *what* is "own", only whether the orientation in it is one that
    :func:`write_imu` wrote. Raises anything where the bag is damaged.
    """
    import runpy

    import numpy as np

    choose = runpy.run_path(str(Path(__file__).with_name("bag_topics.py")))  # by path, as this script is
    with _opened(kind, path) as reader:
        if what == "own":
            return {"own": np.array(_own(reader, kind, path))}
        topics = choose["topics"]((c.topic, c.msgtype, c.msgcount) for c in reader.connections)
        try:
            unit = choose["imu"](topics, imu, raw=what == "recording")
            field = choose["mag"](topics, unit, mag) if what == "recording" else None
        except choose["Unclear"] as problem:
            return {"refused": np.array(str(problem))}
        left = [topic.name for topic in topics if topic.type == unit.type and topic.name != unit.name]
        answer: dict[str, Any] = {"left": np.array(left, dtype="U200")}
        chosen = {name: topic for name, topic in (("imu", unit), ("mag", field)) if topic is not None}
        for name, topic in chosen.items():
            answer |= {f"{name}_topic": np.array(topic[:2]), f"{name}_promised": np.array(topic.messages)}
        if all(topic.messages <= int(most) for topic in chosen.values()):
            for name, columns in _messages(reader, kind, chosen, int(most)).items():
                answer |= {f"{name}_{column}": values for column, values in columns.items()}
        return answer


@contextmanager
def _opened(kind: str, path: str) -> Iterator[Any]:
    from rosbags import rosbag1, rosbag2

    reader: Any
    if kind == "ros1":
        reader = rosbag1.Reader(Path(path))
    elif kind == "ros2":
        reader = rosbag2.Reader(Path(path))
    else:  # by content, whatever the file is called; the SQLite reader puts the name into a URI
        storage: Any = rosbag2.Reader.STORAGE_PLUGINS
        reader = storage[f".{kind}"](Path(quote(path) if kind == "db3" else path))
    reader.open()
    try:
        yield reader
    finally:
        reader.close()


def _own(reader: Any, kind: str, path: str) -> bool:
    units = [connection for connection in reader.connections if connection.msgtype == _IMU]
    if kind == "ros1":
        return bool(units) and all(connection.ext.callerid == _OWN for connection in units)
    if kind == "db3":
        return False  # poise writes none
    folder = Path(path, "metadata.yaml")
    told = folder.read_text(errors="replace") if kind == "ros2" else _mcap_metadata(Path(path))
    return _OWN_DATA in told


def _mcap_metadata(path: Path) -> str:
    """The metadata.yaml that a bare MCAP file of ROS 2 carries, by the index in its summary; "" where there is none."""
    with path.open("rb") as file:
        file.seek(-_MCAP_END.size, 2)
        end = file.tell()
        _, _, start, *_ = _MCAP_END.unpack(file.read(_MCAP_END.size))
        if not 0 < start < end:
            return ""
        file.seek(start)
        summary, at = file.read(end - start), 0
        while at + 9 <= len(summary):
            opcode, length = struct.unpack_from("<BQ", summary, at)
            if opcode == 0x0D and length > 16:  # the index of a metadata record
                offset, size = struct.unpack_from("<QQ", summary, at + 9)
                file.seek(offset)
                return file.read(min(size, end)).decode(errors="replace")
            at += 9 + length
    return ""


def _messages(reader: Any, kind: str, chosen: dict[str, Any], most: int) -> dict[str, dict[str, Any]]:
    import numpy as np

    connections = [c for c in reader.connections if (c.topic, c.msgtype) in {topic[:2] for topic in chosen.values()}]
    decode = _decoder(kind, connections)
    taken = {topic[:2]: (array("q"), array("q"), array("d")) for topic in chosen.values()}
    for connection, time, raw in reader.messages(connections):
        received, stamps, values = taken[connection.topic, connection.msgtype]
        if len(received) >= most:
            raise ValueError(f"{connection.topic} has more messages than the limit of {most}")
        message = decode(raw, connection.msgtype)
        stamp = message.header.stamp
        received.append(time)
        stamps.append(stamp.sec * 10**9 + stamp.nanosec)
        values.extend(_FIELDS[connection.msgtype](message))
    found = {}
    for name, topic in chosen.items():
        received, stamps, values = taken[topic[:2]]
        rows = np.array(values, dtype=np.float64).reshape(len(received), -1 if len(received) else 0)
        found[name] = {
            "received": np.array(received, dtype=np.int64),
            "stamp": np.array(stamps, dtype=np.int64),
            "values": rows,
        }
    return found


def _decoder(kind: str, connections: list[Any]) -> Any:
    """The function that decodes a message; raises ValueError where the bag's own definition of its type is another one."""
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC if kind == "ros1" else Stores.ROS2_HUMBLE)
    for connection in connections:
        name = connection.msgtype
        known = store.generate_msgdef(name)[1] if kind == "ros1" else store.hash_rihs01(name)
        encoding = getattr(connection.ext, "serialization_format", "cdr")
        if encoding != "cdr":
            raise ValueError(f"{connection.topic} is encoded as {encoding[:40]!r}, expected cdr")
        if connection.digest and connection.digest not in ("*", known):
            raise ValueError(f"{connection.topic}: its {name} is not the one that ROS defines")
    return store.deserialize_ros1 if kind == "ros1" else store.deserialize_cdr


def _imu(m: Any) -> tuple[float, ...]:
    q, w, a = m.orientation, m.angular_velocity, m.linear_acceleration
    known = (m.angular_velocity_covariance[0], m.linear_acceleration_covariance[0])
    return (q.w, q.x, q.y, q.z, w.x, w.y, w.z, a.x, a.y, a.z, *known, *m.orientation_covariance)


def _field(m: Any) -> tuple[float, ...]:
    return (m.magnetic_field.x, m.magnetic_field.y, m.magnetic_field.z)


def _vector(m: Any) -> tuple[float, ...]:
    return (m.vector.x, m.vector.y, m.vector.z)


_FIELDS: dict[str, Callable[[Any], tuple[float, ...]]] = {
    "sensor_msgs/msg/Imu": _imu,
    "sensor_msgs/msg/MagneticField": _field,
    "geometry_msgs/msg/Vector3Stamped": _vector,
}


# -- writing ----------------------------------------------------------------------------------------------------------


class ImuRows(NamedTuple):
    """The messages of one topic, a row each; NaN where there is no value."""

    stamp: NDArray[np.int64]
    """(n,) ns"""
    quat: NDArray[np.float64]
    """(n, 4) w x y z"""
    variance: NDArray[np.float64]
    """(n, 3) rad², about Earth x, y, z"""
    gyr: NDArray[np.float64]
    acc: NDArray[np.float64]


def write_imu(path: Path, kind: str, rows: ImuRows, topic: str, frame_id: str, facts: dict[str, str]) -> None:
    """A new bag at *path* ("bag": a ROS 1 file; "ros2": a folder with MCAP inside) with *rows* as sensor_msgs/Imu."""
    from rosbags import rosbag1, rosbag2
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC if kind == "bag" else Stores.ROS2_HUMBLE)
    writer: Any
    if kind == "bag":
        writer, encode = rosbag1.Writer(path), store.serialize_ros1
    else:
        writer, encode = rosbag2.Writer(path, version=9, storage_plugin=rosbag2.StoragePlugin.MCAP), store.serialize_cdr
        for key, value in facts.items():
            writer.set_custom_data(key, value)
    with writer:
        own = {"callerid": _OWN} if kind == "bag" else {}
        connection = writer.add_connection(topic, _IMU, typestore=store, **own)
        for stamp, message in _written(store.types, rows, frame_id, seq=kind == "bag"):
            writer.write(connection, stamp, encode(message, _IMU))


def _written(types: Any, rows: ImuRows, frame_id: str, *, seq: bool) -> Iterator[tuple[int, Any]]:
    import numpy as np

    def vector(values: list[float]) -> tuple[Any, Any]:
        if all(map(np.isfinite, values)):
            return types["geometry_msgs/msg/Vector3"](*values), unknown
        return types["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0), absent

    unknown, absent = np.array(_UNKNOWN), np.array(_ABSENT)
    numbers = (array.tolist() for array in rows)
    for i, (stamp, quat, variance, gyr, acc) in enumerate(zip(*numbers, strict=True)):
        time = types["builtin_interfaces/msg/Time"](sec=stamp // 10**9, nanosec=stamp % 10**9)
        header = types["std_msgs/msg/Header"](**({"seq": i} if seq else {}), stamp=time, frame_id=frame_id)
        w, x, y, z = quat if np.isfinite(quat[0]) else (1.0, 0.0, 0.0, 0.0)
        covariance = absent if not np.isfinite(quat[0]) else unknown
        if covariance is unknown and all(map(np.isfinite, variance)):
            covariance = np.diag(variance).reshape(9)
        orientation = types["geometry_msgs/msg/Quaternion"](x=x, y=y, z=z, w=w)
        (rate, rate_known), (force, force_known) = vector(gyr), vector(acc)
        yield stamp, types[_IMU](header, orientation, covariance, rate, rate_known, force, force_known)
