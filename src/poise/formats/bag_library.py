"""The one module that imports rosbags. Its :func:`load` runs in a bounded child, by path; only writing runs in this process.

Message definitions inside a bag are never compiled: the three types that are read are ROS's own, and their layout is known.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from urllib.parse import quote

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

IMU, FIELD, VECTOR = "sensor_msgs/msg/Imu", "sensor_msgs/msg/MagneticField", "geometry_msgs/msg/Vector3Stamped"
_TYPES = (IMU, FIELD, VECTOR)
_MOST_TOPICS, _LONGEST_NAME = 1000, 200
_UNKNOWN, _ABSENT = [0.0] * 9, [-1.0] + [0.0] * 8  # ROS's words for a covariance that is not known, a value that is none


def missing() -> bool:
    """Whether rosbags is not installed."""
    from importlib.util import find_spec

    return find_spec("rosbags") is None


# -- reading, in the child --------------------------------------------------------------------------------------------


def load(work: str, kind: str, path: str, *arguments: str) -> dict[str, Any]:
    """What a bag holds ("topics"), or the messages of a topic as columns ("messages", topic, type, most rows)."""
    with _opened(kind, path) as reader:
        if work == "topics":
            return _topics(reader)
        topic, kind_of_message, most = arguments
        return _messages(reader, kind, topic, kind_of_message, int(most))


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


def _topics(reader: Any) -> dict[str, Any]:
    import numpy as np

    found = reader.connections[:_MOST_TOPICS]
    return {
        "topic": np.array([str(c.topic)[:_LONGEST_NAME] for c in found], dtype=f"U{_LONGEST_NAME}"),
        "type": np.array([str(c.msgtype)[:_LONGEST_NAME] for c in found], dtype=f"U{_LONGEST_NAME}"),
        "count": np.array([min(int(c.msgcount), 2**62) for c in found], dtype=np.int64),
    }


def _messages(reader: Any, kind: str, topic: str, msgtype: str, most: int) -> dict[str, Any]:
    import numpy as np

    chosen = [c for c in reader.connections if c.topic == topic and c.msgtype == msgtype]
    decode = _decoder(kind, chosen, msgtype)
    fields: Callable[[Any], tuple[float, ...]] = _imu if msgtype == IMU else _field if msgtype == FIELD else _vector
    received, stamps, values = array("q"), array("q"), array("d")
    for _, time, raw in reader.messages(chosen):
        if len(received) >= most:
            raise ValueError(f"{topic} has more messages than the {most} its index names")
        message = decode(raw, msgtype)
        stamp = message.header.stamp
        received.append(time)
        stamps.append(stamp.sec * 10**9 + stamp.nanosec)
        values.extend(fields(message))
    rows = np.frombuffer(values) if len(values) else np.empty(0)
    return {
        "received": np.array(received, dtype=np.int64),
        "stamp": np.array(stamps, dtype=np.int64),
        "values": rows.reshape(len(received), -1 if len(received) else 0),
    }


def _decoder(kind: str, connections: list[Any], msgtype: str) -> Any:
    """The function that decodes *msgtype*; raises ValueError where the bag's own definition of it is another one."""
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS1_NOETIC if kind == "ros1" else Stores.ROS2_HUMBLE)
    known = store.generate_msgdef(msgtype)[1] if kind == "ros1" else store.hash_rihs01(msgtype)
    for connection in connections:
        encoding = getattr(connection.ext, "serialization_format", "cdr")
        if encoding != "cdr":
            raise ValueError(f"{connection.topic} is encoded as {encoding[:40]!r}, expected cdr")
        if connection.digest and connection.digest not in ("*", known):
            raise ValueError(f"{connection.topic}: its {msgtype} is not the one that ROS defines")
    return store.deserialize_ros1 if kind == "ros1" else store.deserialize_cdr


def _imu(m: Any) -> tuple[float, ...]:
    q, w, a = m.orientation, m.angular_velocity, m.linear_acceleration
    known = (m.angular_velocity_covariance[0], m.linear_acceleration_covariance[0])
    return (q.w, q.x, q.y, q.z, w.x, w.y, w.z, a.x, a.y, a.z, *known, *m.orientation_covariance)


def _field(m: Any) -> tuple[float, ...]:
    return (m.magnetic_field.x, m.magnetic_field.y, m.magnetic_field.z)


def _vector(m: Any) -> tuple[float, ...]:
    return (m.vector.x, m.vector.y, m.vector.z)


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
        connection = writer.add_connection(topic, IMU, typestore=store)
        for stamp, message in _written(store.types, rows, frame_id, seq=kind == "bag"):
            writer.write(connection, stamp, encode(message, IMU))


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
        yield stamp, types[IMU](header, orientation, covariance, rate, rate_known, force, force_known)
