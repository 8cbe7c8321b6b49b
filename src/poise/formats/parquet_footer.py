"""Parquet footers moved along the file: what a row group's footer says of places, by so many bytes further on."""

from __future__ import annotations

import io
from typing import BinaryIO

# Apache Thrift's compact protocol: https://github.com/apache/thrift/blob/master/doc/specs/thrift-compact-protocol.md
_TRUE, _FALSE, _BYTE, _I16, _I32, _I64, _DOUBLE, _BINARY, _LIST, _SET, _MAP, _STRUCT = range(1, 13)

# Where parquet.thrift has places in the file, as field numbers from FileMetaData down: row_groups, columns, meta_data.
_PLACES = {
    (4, 5),  # a row group's
    (4, 1, 2),  # a column chunk's
    (4, 1, 3, 9),  # data pages
    (4, 1, 3, 10),  # index pages
    (4, 1, 3, 11),  # the dictionary
    (4, 1, 3, 14),  # a Bloom filter
    (4, 1, 4),  # the offset index
    (4, 1, 6),  # the column index
}


def moved(footer: bytes, distance: int) -> bytes:
    """The FileMetaData *footer* with every place in it *distance* bytes further on; a place of 0 says nothing."""
    out = io.BytesIO()
    _struct(io.BytesIO(footer), out, (), distance)
    return out.getvalue()


def _struct(source: BinaryIO, out: BinaryIO, path: tuple[int, ...], distance: int) -> None:
    number = 0
    while True:
        head = _copied(source, out, 1)[0]
        if head == 0:
            return
        kind = head & 15
        number = number + (head >> 4) if head >> 4 else _signed(_copied_varint(source, out))
        _value(source, out, kind, (*path, number), distance)


def _value(source: BinaryIO, out: BinaryIO, kind: int, path: tuple[int, ...], distance: int) -> None:
    if kind in (_I16, _I32, _I64):
        found = _varint(source)
        place = kind == _I64 and path in _PLACES and found
        out.write(_as_varint(found + 2 * distance if place else found))  # zigzag: n ≥ 0 is written as 2n
    elif kind == _BYTE:
        _copied(source, out, 1)
    elif kind == _DOUBLE:
        _copied(source, out, 8)
    elif kind == _BINARY:
        _copied(source, out, _copied_varint(source, out))
    elif kind in (_LIST, _SET):
        head = _copied(source, out, 1)[0]
        count = head >> 4 if head >> 4 < 15 else _copied_varint(source, out)
        for _ in range(count):
            if head & 15 in (_TRUE, _FALSE):
                _copied(source, out, 1)
            else:
                _value(source, out, head & 15, path, distance)
    elif kind == _STRUCT:
        _struct(source, out, path, distance)
    elif kind not in (_TRUE, _FALSE):
        raise ValueError(f"a footer with a value of kind {kind}, which Parquet's do not have")


def _copied(source: BinaryIO, out: BinaryIO, count: int) -> bytes:
    data = source.read(count)
    if len(data) < count:
        raise ValueError("a footer that is cut short")
    out.write(data)
    return data


def _copied_varint(source: BinaryIO, out: BinaryIO) -> int:
    found = _varint(source)
    out.write(_as_varint(found))
    return found


def _varint(source: BinaryIO) -> int:
    value = shift = 0
    while True:
        byte = source.read(1)
        if not byte:
            raise ValueError("a footer that is cut short")
        value |= (byte[0] & 127) << shift
        shift += 7
        if byte[0] < 128:
            return value


def _as_varint(value: int) -> bytes:
    out = bytearray()
    while value > 127:
        out.append(value & 127 | 128)
        value >>= 7
    out.append(value)
    return bytes(out)


def _signed(zigzag: int) -> int:
    return (zigzag >> 1) ^ -(zigzag & 1)
