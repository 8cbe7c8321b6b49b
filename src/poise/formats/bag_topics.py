"""Which topics of a bag are the sensor: the inertial unit, and the magnetometer that belongs to it.

Runs in the bounded child that reads the bag, by path, and so imports the standard library only.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

IMU, FIELD, VECTOR = "sensor_msgs/msg/Imu", "sensor_msgs/msg/MagneticField", "geometry_msgs/msg/Vector3Stamped"
_MAG = re.compile(r"mag|compass", re.IGNORECASE)
_NO_MAG = re.compile(r"image|magnitude", re.IGNORECASE)
_RAW = re.compile(r"(^|_)raw($|_)|(^|_)uncal", re.IGNORECASE)
_SAME = 0.9  # share of the fullest topic's messages that the raw one must have


class Unclear(Exception):
    """Why no topic could be chosen, with those that are there."""


class Topic(NamedTuple):
    """A topic with its type in ROS 2's spelling and the number of its messages."""

    name: str
    type: str
    messages: int

    @property
    def place(self) -> str:
        """Everything but the last word of the name: topics of one driver share it."""
        return self.name.rpartition("/")[0]

    @property
    def word(self) -> str:
        return self.name.rpartition("/")[2]


def topics(connections: Iterable[tuple[str, str, int]]) -> list[Topic]:
    """The topics behind *connections* (name, type, messages), those of one name and type together."""
    counts: dict[tuple[str, str], int] = {}
    for name, kind, messages in connections:
        counts[str(name), str(kind)] = counts.get((str(name), str(kind)), 0) + int(messages)
    return [Topic(*key, messages) for key, messages in counts.items()]


def imu(topics: Sequence[Topic], wanted: str, *, raw: bool = True) -> Topic:
    """The inertial unit: the topic *wanted*, the only one, or of one driver's topics the raw one (or, the filtered one).

    Raises :class:`Unclear` with the list where there is none or the choice is not clear.
    """
    found = [topic for topic in topics if topic.type == IMU]
    if wanted:
        return _named(wanted, found, "sensor_msgs/Imu")
    full = [topic for topic in found if topic.messages]
    if not full:
        there = f"{_listed(found)} without a message" if found else f"found {_listed(topics) or 'no topic at all'}"
        raise Unclear(f"no sensor_msgs/Imu message in this bag: {there}")
    if len(full) == 1:
        return full[0]
    chosen = [topic for topic in full if (_RAW.search(topic.word) is not None) == raw]
    most = max(topic.messages for topic in full)
    if len(chosen) == 1 and len({topic.place for topic in full}) == 1 and chosen[0].messages >= _SAME * most:
        return chosen[0]
    raise Unclear(f"{len(full)} Imu topics: {_listed(full)}; say which: --topic {full[0].name}")


def mag(topics: Sequence[Topic], of: Topic, wanted: str) -> Topic | None:
    """The magnetometer that belongs to the inertial unit *of*; None where there is none, or where "-" is *wanted*.

    Raises :class:`Unclear` with the list where the choice is not clear.
    """
    found = [topic for topic in topics if topic.type == FIELD or (topic.type == VECTOR and _is_mag(topic.name))]
    if wanted == "-":
        return None
    if wanted:
        vectors = [topic for topic in topics if topic.type in (FIELD, VECTOR)]
        return _named(wanted, vectors, "sensor_msgs/MagneticField or geometry_msgs/Vector3Stamped")
    found = [topic for topic in found if topic.messages]
    closest = max((_shared(topic, of) for topic in found), default=0)
    rules: list[Callable[[Topic], bool]] = [
        lambda topic: _shared(topic, of) == closest,
        lambda topic: topic.type == FIELD,
        lambda topic: (_RAW.search(topic.word) is None) == (_RAW.search(of.word) is None),
    ]
    for rule in rules:
        found = [topic for topic in found if rule(topic)] or found
    if len(found) > 1:
        options = f"--topic {of.name},{found[0].name} (or {of.name},- for none)"
        raise Unclear(f"{len(found)} magnetometers beside {of.name}: {_listed(found)}; say which: {options}")
    return found[0] if found else None


def _named(wanted: str, found: Sequence[Topic], kind: str) -> Topic:
    for topic in found:
        if topic.name == wanted or topic.name == f"/{wanted}":
            if not topic.messages:
                raise Unclear(f"topic {topic.name} has no message")
            return topic
    raise Unclear(f"no topic {wanted!r} of type {kind}; there are {_listed(found) or 'none'}")


def _is_mag(name: str) -> bool:
    return _MAG.search(_NO_MAG.sub("", name)) is not None


def _shared(topic: Topic, other: Topic) -> int:
    """How many leading words of the names agree."""
    pairs = list(zip(topic.place.split("/"), other.place.split("/"), strict=False))
    return next((i for i, (a, b) in enumerate(pairs) if a != b), len(pairs))


def _listed(topics: Sequence[Topic], most: int = 8) -> str:
    shown = ", ".join(f"{t.name[:60]} ({t.type.replace('/msg/', '/')[:50]}, {t.messages})" for t in topics[:most])
    return shown + (f" and {len(topics) - most} more" if len(topics) > most else "")
