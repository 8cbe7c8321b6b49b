"""An attitude to a ROS bag: sensor_msgs/Imu with orientation, as a filter node would have published it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from poise.data.attitude import Attitude
from poise.data.recording import Recording
from poise.errors import FormatError
from poise.formats import bag_library, bag_stamps
from poise.formats.names import counted
from poise.formats.saving import making

KINDS = ("bag", "mcap", "ros2")
TOPIC, FRAME_ID = "/imu/data", "imu_link"  # REP 145
_LATEST = {"bag": 2**32, "mcap": 2**31, "ros2": 2**31}  # s since 1970 that a stamp can hold


def write(attitude: Attitude, path: Path, kind: str, recording: Recording | None) -> None:
    """Write "bag" (ROS 1), "mcap" (one file, ROS 2) or "ros2" (a folder with MCAP inside) to *path*.

    Angular velocity and linear acceleration are the *recording*'s; without one, the attitude's rate and none. Raises
    :class:`FormatError` where the frame is not ENU, rows do not match or ROS has no such time.
    """
    if attitude.frame != "enu":
        raise FormatError(
            f"{path}: an orientation in ROS is body to east-north-up (REP 103), this attitude's frame is "
            f"{attitude.frame}; write attitude.to('enu'), or leave --frame out"
        )
    if bag_library.missing():
        raise FormatError(f'{path}: writing a ROS bag needs rosbags; install it with: pip install "poise[ros]"')
    rows = _rows(attitude, path, kind, recording)
    facts = attitude.metadata()
    with making(path) as place:
        if kind == "bag":
            bag_library.write_imu(place, "bag", rows, TOPIC, FRAME_ID, facts)
        elif kind == "ros2":
            _guard(path)
            bag_library.write_imu(place, "ros2", rows, TOPIC, FRAME_ID, facts)
        else:  # rosbags makes folders only: the one file inside is the bag
            folder = place.with_name("folder")
            bag_library.write_imu(folder, "ros2", rows, TOPIC, FRAME_ID, facts)
            next(folder.glob("*.mcap")).rename(place)


def _guard(path: Path) -> None:
    """A folder may take the place of a ROS 2 bag's or of an empty one, of nothing else."""
    if path.is_dir() and any(path.iterdir()) and not (path / "metadata.yaml").exists():
        raise FormatError(f"{path}: a folder with other files than a ROS 2 bag's; nothing is written over it")
    if path.exists() and not path.is_dir():
        raise FormatError(f"{path}: a file, where the folder of a ROS 2 bag should go")


def _rows(attitude: Attitude, path: Path, kind: str, recording: Recording | None) -> bag_library.ImuRows:
    if recording is not None and len(recording) != len(attitude):
        raise FormatError(f"{path}: the recording has {counted(len(recording), 'row')}, the attitude {len(attitude)}")
    timed = np.isfinite(attitude.time)
    part = attitude[timed]
    if len(part) and not (part.time.min() >= 0 and part.time.max() < _LATEST[kind]):
        raise FormatError(
            f"{path}: times from {part.time.min():g} to {part.time.max():g} s; "
            f"a ROS stamp holds 0 to {_LATEST[kind]:,} s (since 1970)"
        )
    nothing = np.full((len(part), 3), np.nan)
    return bag_library.ImuRows(
        bag_stamps.nanoseconds(part.time),
        np.where(part.valid[:, None], part.quat, np.nan),
        part.sigma**2,
        part.rate if recording is None else recording.gyr[timed],
        nothing if recording is None else recording.acc[timed],
    )
