"""What a device's bytes mean: text lines or binary frames as a TOML file describes them, and poise's own frames and JSON."""

from __future__ import annotations

import binascii
import re
import struct
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce
from math import isfinite
from operator import xor
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.stamps import Turns
from poise.formats import names, units
from poise.live import frames, texts
from poise.live.devices import DeviceError

Floats = NDArray[np.float64]

_TYPES = {
    "u8": "B",
    "i8": "b",
    "u16": "H",
    "i16": "h",
    "u32": "I",
    "i32": "i",
    "u64": "Q",
    "i64": "q",
    "f32": "f",
    "f64": "d",
}
_CHECKS: dict[str, tuple[str, Callable[[bytes], int]]] = {
    "none": ("", lambda data: 0),
    "sum8": ("B", lambda data: sum(data) & 0xFF),
    "xor8": ("B", lambda data: reduce(xor, data, 0)),
    "crc16-ccitt": ("H", lambda data: binascii.crc_hqx(data, 0xFFFF)),
    "crc32": ("I", binascii.crc32),
}
_COLUMNS = {"time": 0} | {f"{s}_{a}": 1 + 3 * i + k for i, s in enumerate(names.SENSORS) for k, a in enumerate("xyz")}
_UUID = re.compile(r"[0-9a-fA-F]{4}|[0-9a-fA-F]{8}(-[0-9a-fA-F]{4}){3}-[0-9a-fA-F]{12}")
_LONGEST = 4096  # bytes of a line or frame
_KEYS = {"device", "rate", "baud", "columns", "frame", "scale", "ble"}
_FRAME_KEYS = {"sync", "fields", "endian", "checksum"}
DEFAULT = "time[s],gx[rad/s],gy,gz,ax[m/s2],ay,az,mx[uT],my,mz"


class Column(NamedTuple):
    """Where a number of a line or frame goes, and what it is multiplied with."""

    at: int
    """the column of a row; −1: nowhere"""
    factor: float


@dataclass(frozen=True)
class Description:
    """What a device sends. Without a file: lines of time, gyr, acc and perhaps mag, in SI and µT."""

    where: str = "the usual lines"
    device: str = ""
    rate: float = 0.0
    """samples a second of a device that sends no time; else 0"""
    baud: int = 115200
    columns: tuple[Column, ...] = ()
    layout: str = ""
    """the struct of a binary frame's fields; empty for text lines"""
    sync: bytes = b""
    """what a frame begins with; empty: a notification holds whole frames and nothing else"""
    characteristic: str = ""
    """UUID of what notifies, of a device over Bluetooth Low Energy"""
    check: str = "none"
    wraps: float = 0.0
    """at which its clock begins anew, in s; 0: never"""

    @classmethod
    def read(cls, path: Path) -> Description:
        """The description in a TOML file. Raises :class:`DeviceError` that names what is wrong with it."""
        try:
            found = tomllib.loads(path.read_text("utf-8"))
        except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as problem:
            raise DeviceError(f"{path}: cannot be read as TOML: {problem}") from None
        return cls.of(found, str(path))

    @classmethod
    def of(cls, found: dict[str, Any], where: str = "description") -> Description:
        """The description in a table, as TOML has it."""
        unknown = sorted(found.keys() - _KEYS)
        if unknown or ("columns" in found) == ("frame" in found):
            known = ", ".join(sorted(_KEYS))
            text = f"{unknown[0]!r} is none" if unknown else "either columns (text lines) or frame (binary) is needed"
            raise DeviceError(f"{where}: {text}; keys are {known}")
        scale = found.get("scale", {})
        if not isinstance(scale, dict) or not all(_finite(v) and v for v in scale.values()):
            raise DeviceError(f"{where}: scale: expected factors to SI and µT, like {{acc = 4.79e-3}}")
        if wrong := scale.keys() - {"time", *names.SENSORS}:
            raise DeviceError(f"{where}: scale of {wrong.pop()!r}: expected time, gyr, acc or mag")
        facts = {"device": str(found.get("device", "")), "baud": _number(where, found, "baud", 115200)}
        if "ble" in found:
            facts["characteristic"] = _characteristic(where, found["ble"])
        rate = float(_number(where, found, "rate", 0))
        if "columns" in found:
            words = found["columns"].split(",") if isinstance(found["columns"], str) else found["columns"]
            if not isinstance(words, list):
                raise DeviceError(f"{where}: columns: expected names like {DEFAULT!r}, found {words!r}")
            made = cls(where, rate=rate, columns=_columns(where, [str(w) for w in words], scale), **facts)
        else:
            made = _binary(where, found["frame"], scale, rate, facts)
        has_time = any(column.at == 0 for column in made.columns)
        if has_time == (rate > 0):
            raise DeviceError(f"{where}: a device either sends its time or has a rate (samples a second)")
        needed = set(range(1, 7)) - {column.at for column in made.columns}
        if needed:
            missing = ", ".join(name for name, at in _COLUMNS.items() if at in needed)
            raise DeviceError(f"{where}: {missing} missing; gyroscope and accelerometer have three axes each")
        return made


def _characteristic(where: str, ble: Any) -> str:
    uuid = ble.get("characteristic") if isinstance(ble, dict) and ble.keys() == {"characteristic"} else None
    if not isinstance(uuid, str) or not _UUID.fullmatch(uuid):
        raise DeviceError(
            f'{where}: ble: expected characteristic = "UUID", 4 hex digits or 32 with hyphens, found {ble!r}'
        )
    return uuid.lower() if len(uuid) > 4 else f"0000{uuid.lower()}-0000-1000-8000-00805f9b34fb"


def _number(where: str, found: dict[str, Any], key: str, default: int) -> Any:
    value = found.get(key, default)
    if not _finite(value) or value < 0 or (key == "baud" and not value >= 1) or 0 < value < 1e-6:
        raise DeviceError(f"{where}: {key}: expected a number, found {value!r}")
    return int(value) if key == "baud" else value


def _finite(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)


def _columns(where: str, words: list[str], scale: dict[str, float]) -> tuple[Column, ...]:
    made, last = [], dict.fromkeys(("time", *names.SENSORS), 1.0)
    for word in words:
        word = word.strip()
        field = names.parse(word)
        if word == "-":
            made.append(Column(-1, 1.0))
            continue
        if field.role not in _COLUMNS:
            raise DeviceError(f'{where}: {word!r} is no column; expected names like gx[deg/s], ay[g], time[ms], or "-"')
        sensor = field.role.partition("_")[0]
        if field.unit:
            if units.named(sensor, field.unit) is None:
                raise DeviceError(
                    f"{where}: {word!r}: unit {field.unit!r} is none of {', '.join(units.FACTORS[sensor])}"
                )
            last[sensor] = units.FACTORS[sensor][str(units.named(sensor, field.unit))]
        factor = last[sensor] ** (-1 if sensor == "time" else 1)
        made.append(Column(_COLUMNS[field.role], factor * scale.get(sensor, 1.0)))
    taken = [column.at for column in made if column.at >= 0]
    if len(taken) != len(set(taken)):
        raise DeviceError(f"{where}: a column twice")
    return tuple(made)


def _binary(where: str, frame: Any, scale: dict[str, float], rate: float, facts: dict[str, Any]) -> Description:
    needed = {"fields"} if "characteristic" in facts else {"sync", "fields"}
    if (
        not isinstance(frame, dict)
        or not needed <= frame.keys() <= _FRAME_KEYS
        or not isinstance(frame["fields"], list)
    ):
        raise DeviceError(
            f"{where}: frame: expected sync and fields (fields for [ble]), and perhaps endian and checksum"
        )
    words = [str(w).split() for w in frame["fields"]]
    if not all(len(word) == 2 and word[1] in _TYPES for word in words):
        raise DeviceError(f'{where}: fields: expected a list like "gx[deg/s] i16", types {", ".join(_TYPES)}')
    check = str(frame.get("checksum", "none"))
    if check not in _CHECKS or frame.get("endian", "little") not in ("little", "big"):
        raise DeviceError(f"{where}: checksum is one of {', '.join(_CHECKS)}, endian little or big")
    try:
        sync = bytes.fromhex(str(frame.get("sync", "")))
    except ValueError:
        sync = b""
    if not sync and "sync" in frame:
        raise DeviceError(f'{where}: sync: expected the bytes that every frame begins with, in hex: "AA 55"')
    columns = _columns(where, [word[0] for word in words], scale)
    layout = ("<" if frame.get("endian", "little") == "little" else ">") + "".join(_TYPES[word[1]] for word in words)
    wraps = 0.0
    for column, (_, kind) in zip(columns, words, strict=True):
        if column.at == 0 and kind[0] in "ui":
            wraps = 2.0 ** int(kind[1:]) * column.factor
    return Description(where, rate=rate, columns=columns, layout=layout, sync=sync, check=check, wraps=wraps, **facts)


class Decoder:
    """Bytes to rows, as they come in pieces; what cannot be read is counted in ``rejected`` and skipped."""

    def __init__(self, description: Description | None = None) -> None:
        self._description = description or Description.of({"columns": DEFAULT}, "the usual lines")
        self._short = description is None  # the usual lines may leave the magnetometer out
        self._buffer = b""
        self._began = bool(self._description.layout)  # text may begin in the middle of a line
        self._count = 0
        whole = self._description.wraps
        self._turns = Turns([whole], most=0.5 * whole)
        self.rejected = 0

    def feed(self, data: bytes) -> Floats:
        """(n, 12) rows that are complete by now; n may be 0."""
        self._buffer += data
        rows = self._frames() if self._description.layout else self._lines()
        if len(self._buffer) > _LONGEST:
            self._buffer = b""
            self.rejected += 1
        return self._finished(rows)

    def message(self, data: bytes) -> tuple[Floats, int]:
        """(n, 12) rows of a message that is whole, and the number of the first: poise's frame, JSON, lines or described frames.

        Raises :class:`FrameError` where there is no sample in it, or more than samples.
        """
        if data[:2] == bytes((frames.VERSION, frames.SAMPLES)):
            return frames.samples(data), frames.head(data).sequence
        if data[:1] == b"{":
            return texts.from_json(data)
        self._buffer, self._began = data if self._description.layout else data.rstrip(b"\r\n") + b"\n", True
        before = self.rejected
        rows = self._finished(self._frames() if self._description.layout else self._lines())
        self._buffer = b""
        if not len(rows) or self.rejected > before:
            raise frames.FrameError(f"{data[:40]!r}: no sample as {self._description.where} says")
        return rows, frames.UNNUMBERED

    def _lines(self) -> list[tuple[float, ...]]:
        *lines, self._buffer = self._buffer.split(b"\n")
        if lines and not self._began:
            self._began = True
            del lines[0]
        rows, wanted = [], len(self._description.columns)
        for line in lines:
            words = line.replace(b",", b" ").replace(b";", b" ").split()
            if not words or words[0].startswith(b"#"):
                continue
            try:
                numbers = tuple(map(float, words))
            except ValueError:
                self.rejected += 1
                continue
            if self._short and len(numbers) == 7:
                numbers += (np.nan,) * 3
            if len(numbers) != wanted:
                self.rejected += 1
                continue
            rows.append(numbers)
        return rows

    def _whole(self, data: bytes) -> list[tuple[float, ...]]:
        """Of a notification, which holds frames from its beginning to its end."""
        code, check = _CHECKS[self._description.check]
        body, tail = struct.Struct(self._description.layout), struct.Struct(self._description.layout[0] + code)
        size = body.size + tail.size
        rows = []
        if not data or len(data) % size:
            self.rejected += 1
            return []
        for at in range(0, len(data), size):
            end = at + body.size
            if code and check(data[at:end]) != tail.unpack_from(data, end)[0]:
                self.rejected += 1
            else:
                rows.append(body.unpack_from(data, at))
        return rows

    def _frames(self) -> list[tuple[float, ...]]:
        found, sync, data = self._description, self._description.sync, self._buffer
        if not sync:
            self._buffer = b""
            return self._whole(data)
        code, check = _CHECKS[found.check]
        body, tail = struct.Struct(found.layout), struct.Struct(found.layout[0] + code)
        size = len(sync) + body.size + tail.size
        at, rows = 0, []
        while (start := data.find(sync, at)) >= 0 and start + size <= len(data):
            self.rejected += start > at
            end = start + len(sync) + body.size
            if code and check(data[start + len(sync) : end]) != tail.unpack_from(data, end)[0]:
                self.rejected += 1
                at = start + 1
                continue
            rows.append(body.unpack_from(data, start + len(sync)))
            at = start + size
        self._buffer = data[start:] if start >= 0 else data[max(at, len(data) - len(sync) + 1) :]
        return rows

    def _finished(self, numbers: list[tuple[float, ...]]) -> Floats:
        rows = np.zeros((len(numbers), 12))
        rows[:, 7:10] = np.nan
        if not numbers:
            return rows
        values = np.array(numbers, float)
        for k, (at, factor) in enumerate(self._description.columns):
            if at >= 0:
                rows[:, at] = values[:, k] * factor
        if self._description.rate:
            rows[:, 0] = (self._count + np.arange(len(rows))) / self._description.rate
        elif self._description.wraps:
            rows[:, 0] = self._turns.of(rows[:, 0])
        self._count += len(rows)
        return rows
