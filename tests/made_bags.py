"""Bags for tests, written by rosbags: one turning sensor, its messages as a real driver would publish them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np
from rosbags import rosbag1, rosbag2
from rosbags.typesys import Stores, get_typestore

RATE, START, ROWS = 100.0, 1_700_000_000, 400
IMU, FIELD = "sensor_msgs/msg/Imu", "sensor_msgs/msg/MagneticField"
VECTOR, TEXT = "geometry_msgs/msg/Vector3Stamped", "std_msgs/msg/String"
_STORES = {1: get_typestore(Stores.ROS1_NOETIC), 2: get_typestore(Stores.ROS2_HUMBLE)}

TIME = START + np.arange(ROWS) / RATE
GYR = np.column_stack([np.zeros(ROWS), np.zeros(ROWS), np.full(ROWS, 0.5)])
_HEADING = np.arange(ROWS) / RATE * 0.5
ACC = np.column_stack([np.zeros(ROWS), np.zeros(ROWS), np.full(ROWS, 9.81)])
MAG = 1e-6 * np.column_stack([18 * np.sin(_HEADING), 18 * np.cos(_HEADING), np.full(ROWS, -45.0)])  # T
QUAT = np.column_stack([np.cos(_HEADING / 2), np.zeros(ROWS), np.zeros(ROWS), np.sin(_HEADING / 2)])  # w x y z

Message = tuple[str, str, float, Callable[[Any, int], Any]]
"""topic, type, time of arrival in s, and what makes the message of a type store and a ROS version"""


def header(types: Any, ros: int, stamp: float) -> Any:
    whole = int(np.floor(stamp))
    time = types["builtin_interfaces/msg/Time"](sec=whole, nanosec=round((stamp - whole) * 1e9))
    return types["std_msgs/msg/Header"](**({"seq": 0} if ros == 1 else {}), stamp=time, frame_id="imu")


def imu(
    topic: str = "/imu/data_raw",
    *,
    stamps: Iterable[float] = TIME,
    quat: Any = (0.0, 0.0, 0.0, 0.0),
    covariance: float = 0.0,
    variance: float = 0.0,
    acc: Any = ACC,
    gyr: Any = GYR,
    absent: Iterable[int] = (),
    delay: float = 0.002,
    rows: int = ROWS,
) -> list[Message]:
    """Imu messages; *covariance* is the first element of orientation_covariance, *absent* rows have no acceleration."""
    stamps, missing = np.fromiter(stamps, float), set(absent)
    quat = np.broadcast_to(quat, (ROWS, 4))

    def message(i: int) -> Callable[[Any, int], Any]:
        def make(types: Any, ros: int) -> Any:
            vector, zero = types["geometry_msgs/msg/Vector3"], np.zeros(9)
            w, x, y, z = map(float, quat[i])
            known = np.diag([variance] * 3).reshape(9)
            known[0] = covariance or variance
            force = (0.0, 0.0, 0.0) if i in missing else tuple(map(float, acc[i]))
            lacking = np.array([-1.0] + [0.0] * 8) if i in missing else zero
            return types[IMU](
                header(types, ros, stamps[i]),
                types["geometry_msgs/msg/Quaternion"](x=x, y=y, z=z, w=w),
                known,
                vector(*map(float, gyr[i])),
                zero,
                vector(*force),
                lacking,
            )

        return make

    return [(topic, IMU, float(TIME[i]) + delay, message(i)) for i in range(rows)]


def mag(
    topic: str = "/imu/mag",
    *,
    every: int = 1,
    shift: float = 0.0,
    stamps: Iterable[float] | None = None,
    field: Any = MAG,
    kind: str = FIELD,
    delay: float = 0.002,
) -> list[Message]:
    """Messages of a magnetometer that samples *shift* seconds after every *every*-th row."""
    own = np.fromiter(stamps, float) if stamps is not None else TIME + shift

    def message(i: int) -> Callable[[Any, int], Any]:
        def make(types: Any, ros: int) -> Any:
            vector = types["geometry_msgs/msg/Vector3"](*map(float, field[i]))
            rest = (np.zeros(9),) if kind == FIELD else ()
            return types[kind](header(types, ros, own[i]), vector, *rest)

        return make

    return [(topic, kind, float(TIME[i]) + shift + delay, message(i)) for i in range(0, ROWS, every)]


def text(topic: str = "/chatter") -> list[Message]:
    return [(topic, TEXT, float(TIME[0]), lambda types, ros: types[TEXT](data="hello"))]


def save(path: Path, messages: list[Message], kind: str = "bag") -> Path:
    """Write a "bag" (ROS 1), or a ROS 2 folder of "mcap" or "sqlite3", or its "bare-mcap" or "bare-sqlite3" file."""
    ros = 1 if kind == "bag" else 2
    store = _STORES[ros]
    bare = kind.startswith("bare-")
    place = path.with_name(f"{path.name}.folder") if bare else path
    if ros == 1:
        writer: Any = rosbag1.Writer(path)
        encode: Any = store.serialize_ros1
    else:
        plugin = rosbag2.StoragePlugin.MCAP if "mcap" in kind else rosbag2.StoragePlugin.SQLITE3
        writer, encode = rosbag2.Writer(place, version=9, storage_plugin=plugin), store.serialize_cdr
    with writer:
        connections: dict[tuple[str, str], Any] = {}
        for topic, msgtype, arrival, make in sorted(messages, key=lambda m: m[2]):
            if (topic, msgtype) not in connections:
                connections[topic, msgtype] = writer.add_connection(topic, msgtype, typestore=store)
            writer.write(connections[topic, msgtype], round(arrival * 1e9), encode(make(store.types, ros), msgtype))
    if bare:
        next(file for file in place.iterdir() if file.suffix in (".mcap", ".db3")).rename(path)
    return path
