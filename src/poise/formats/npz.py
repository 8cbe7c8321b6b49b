"""npz archives: sizes are checked against the archive's directory and each array's header before anything unpacks."""

from __future__ import annotations

import json
import math
import re
import struct
import zipfile
import zlib
from pathlib import Path
from typing import IO, Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from poise.errors import FormatError
from poise.formats import arrays
from poise.formats.limits import Limits, Options, check_expansion
from poise.formats.table import KIND, Table

FACTS = "poise"
_DAMAGE = (zipfile.BadZipFile, zlib.error, EOFError, OSError, ValueError, TypeError, RuntimeError, struct.error)
_LONGEST = 4096  # bytes of an array's header
_HEADER = re.compile(
    rb"\{ *'descr': *'([<>|=]?[fiubcSU]\d{1,9})', *'fortran_order': *(?:True|False), *"
    rb"'shape': *\(([\d, ]{0,99})\) *,? *\} *\n?"
)
_METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)


def read(path: Path, options: Options) -> Table:
    """The table in an npz file. Raises :class:`FormatError` where it is damaged, hostile or not a recording."""
    where = str(path)
    with path.open("rb") as file:
        found = load(where, file, options.limits)
    facts = _facts(found.pop(FACTS, None))
    if facts.get(KIND, "recording") != "recording":
        raise FormatError(f"{where}: holds a poise {facts[KIND]}, not a recording")
    numbers = {name: array for name, array in found.items() if array.dtype.kind in "fiub"}
    table = arrays.to_table(where, "npz", numbers, options)
    table.facts = facts
    return table


def load(where: str, file: BinaryIO, limits: Limits) -> dict[str, NDArray[Any]]:
    """The numeric and text arrays of an open npz; objects are refused, nothing is ever unpickled."""
    try:
        with zipfile.ZipFile(file) as archive:
            members = [info for info in archive.infolist() if info.filename.endswith(".npy")]
            limits.check(where, "columns", len(members))
            packed = sum(info.compress_size for info in members)
            unpacked = sum(info.file_size for info in members)
            limits.check(where, "size", unpacked)
            check_expansion(where, packed, unpacked)
            return {info.filename[:-4]: _member(where, archive, info) for info in members}
    except FormatError:
        raise
    except MemoryError:
        raise FormatError(f"{where}: its arrays do not fit into memory") from None
    except _DAMAGE as problem:
        reason = (str(problem) or type(problem).__name__).split("\n")[0][:160]
        raise FormatError(f"{where}: damaged npz file ({reason}); save it again with numpy.savez") from None


def _member(where: str, archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> NDArray[Any]:
    label = f"{where}: array {info.filename[:-4]!r}"
    if info.compress_type not in _METHODS:
        raise FormatError(f"{label}: packed in a way that numpy does not use; save it again with numpy.savez")
    with archive.open(info) as stream:
        size = _claimed_size(label, stream)
    if size != info.file_size:
        raise FormatError(f"{label}: its header claims {size} bytes, it has {info.file_size}; the file is damaged")
    with archive.open(info) as stream:
        return np.asarray(np.lib.format.read_array(stream, allow_pickle=False))


def _claimed_size(label: str, stream: IO[bytes]) -> int:
    """The bytes that an array's header claims for header and data; read strictly, for numpy evaluates it."""
    start = stream.read(12)
    width, code = {b"\x01": (2, "<H"), b"\x02": (4, "<I")}.get(start[6:7], (0, ""))
    if start[:6] != b"\x93NUMPY" or not width or len(start) < 12:
        raise FormatError(f"{label}: not an array of numpy's; save it again with numpy.savez")
    (length,) = struct.unpack(code, start[8 : 8 + width])
    header = start[8 + width :] + stream.read(max(0, min(length, _LONGEST) - (4 - width)))
    found = _HEADER.fullmatch(header)
    if not found:
        raise FormatError(f"{label}: holds no plain numbers, or its header is damaged; nothing is ever unpickled")
    count = math.prod(int(side) for side in found[2].split(b",") if side.strip())
    return int(8 + width + length + count * np.dtype(found[1].decode()).itemsize)


def _facts(array: NDArray[Any] | None) -> dict[str, str]:
    if array is None or array.dtype.kind != "U" or array.size != 1:
        return {}
    try:
        found = json.loads(str(array.reshape(-1)[0]))
    except ValueError:
        return {}
    return {str(key): str(value) for key, value in found.items()} if isinstance(found, dict) else {}
