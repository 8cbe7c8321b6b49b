"""Files of named arrays (npz, MATLAB): vectors and (n, 3) blocks taken apart into the columns of a table."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from poise.errors import FormatError
from poise.formats import layouts, names
from poise.formats.devices import Devices
from poise.formats.layouts import Column
from poise.formats.limits import Options
from poise.formats.table import Table, Whole

_PARTS = {3: ("x", "y", "z"), 4: ("qw", "qx", "qy", "qz")}
_NAMES = "name them gyr, acc, mag (n, 3) and time (n,) or fs, or say --columns their_name=gyr,their_other=acc"


def to_table(where: str, kind: str, found: dict[str, NDArray[Any]], options: Options) -> Table:
    """The table in named numeric arrays; raises :class:`FormatError` where lengths or shapes do not fit."""
    titles = layouts.renamed(where, list(found), options.columns, len(found))
    columns: dict[str, NDArray[Any]] = {}
    unused, notes = [], []
    rate = None
    for title, array in zip(titles, found.values(), strict=True):
        parsed = names.parse(title)
        role = parsed.role
        if role in ("rate", "period") and array.size == 1:
            value = float(array.reshape(-1)[0])
            rate = value if role == "rate" else 1.0 / value if value > 0 else float("nan")
            continue
        if role == "device":
            named = Column(0, title)
            Devices(where, [named]).see(named, {f"{value:g}" for value in np.unique(array[np.isfinite(array)])})
        if not role or role in ("rate", "period", "device", "date"):
            unused.append(title)
            continue
        array = np.squeeze(array) if array.size != 1 else array.reshape(1)
        width = 4 if role in ("truth", "quat") else 3 if role in ("gyr", "acc", "mag", "free") else 1
        if width == 1:
            _expect(where, title, array.ndim == 1, array, "(n,)")
            columns[title] = array
            continue
        if array.ndim == 2 and array.shape[0] == width != array.shape[1]:
            notes.append(f"{title}: shape {array.shape} taken as its transpose")
            array = array.T
        if array.shape == (width,):
            array = array[None]
        _expect(where, title, array.ndim == 2 and array.shape[1] == width, array, f"(n, {width})")
        for i, part in enumerate(_PARTS[width]):
            label = role if width == 4 else role.replace("free", "freeacc")
            columns[f"{label}_{part}" + (f" ({parsed.unit})" if parsed.unit else "")] = array[:, i]
    table = _table(where, kind, columns, rate, notes, list(found), options)
    table.layout = replace(table.layout, unused=(*unused, *table.layout.unused))
    return table


def _table(
    where: str,
    kind: str,
    columns: dict[str, NDArray[Any]],
    rate: float | None,
    notes: list[str],
    found: list[str],
    options: Options,
) -> Table:
    options.limits.check(where, "columns", len(columns))
    if not columns:
        raise FormatError(f"{where}: no sensor among its arrays ({names.listed(found)}); {_NAMES}")
    titles = list(columns)
    layout = layouts.choose(where, titles, timed=(rate or options.rate) is not None)
    used = {key: columns[titles[column.index]] for key, column in layout.columns.items()}
    lengths = {key: len(values) for key, values in used.items()}
    rows = lengths["gyr_x"]
    options.limits.check(where, "rows", rows)
    if wrong := [key for key, length in lengths.items() if length != rows]:
        raise FormatError(
            f"{where}: {wrong[0]} has {names.counted(lengths[wrong[0]], 'row')}, gyr has {rows}; "
            "sensors with clocks of their own: merge them with Recording.from_sensors"
        )
    if not rows:
        raise FormatError(f"{where}: no rows")
    floats = {key: np.array(values, dtype=np.float64) for key, values in used.items()}
    return Table(kind, layout, Whole(floats), {}, rate, "", [*notes, *layout.notes])


def _expect(where: str, title: str, right: bool, array: NDArray[Any], expected: str) -> None:
    if not right:
        raise FormatError(f"{where}: array {title!r} has shape {array.shape}, expected {expected}")
