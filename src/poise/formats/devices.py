"""Rows of several devices in one file: no attitude can be made of them together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite

from poise.errors import FormatError
from poise.formats.layouts import Column
from poise.formats.names import listed

_MOST = 100  # numbers: a column of more counts something
_EMPTY = {"nan", "NaN", "NAN"}


class Devices:
    """The values seen in *columns* that are named as devices are, block after block."""

    def __init__(self, where: str, columns: Sequence[Column] = ()) -> None:
        self._where = where
        self.columns = tuple(columns)
        self._seen: dict[Column, set[str]] = {column: set() for column in columns}

    def see(self, column: Column, values: Iterable[str]) -> None:
        """Raises :class:`FormatError` where the different *values* of a block and those before are not one device's."""
        seen = self._seen[column]
        if len(seen) <= _MOST:
            seen.update(value for value in values if value)
        if len(seen - _EMPTY) > 1 and not _is_quantity(seen):
            raise FormatError(
                f"{self._where}: column {column.name!r} names more than one device ({listed(sorted(seen), 6)}), and an "
                f"attitude is of one: split the file by it, or, where it names none, leave it out: --columns {column.name}=-"
            )


def _is_quantity(values: Iterable[str]) -> bool:
    """Whether *values* count or measure something: many whole numbers, or one with a fraction."""
    try:
        numbers = {number for value in values if isfinite(number := float(value))}  # an empty cell may say nan
    except ValueError:
        return False
    return len(numbers) > _MOST or any(number % 1.0 for number in numbers)
