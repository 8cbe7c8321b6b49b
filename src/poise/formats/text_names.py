"""The column names of a text table, and the lines above its first row that are neither names nor rows."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from poise.errors import FormatError
from poise.formats import units
from poise.formats.layouts import EXAMPLE
from poise.formats.names import counted, listed, parse, split


class Above(NamedTuple):
    """A line above the first row of numbers."""

    number: int
    """from 1 on"""
    text: str
    cells: list[str]
    numbers: bool
    """whether it is a row of numbers, too, with another count of cells"""


def find(
    where: str,
    above: list[Above],
    comments: Sequence[list[str]],
    first: list[str],
    line: int,
    told: bool,
    notes: list[str],
) -> tuple[str, ...] | None:
    """The names of the columns of the row *first* in *line*; None where there are none, and the caller *told* them.

    They are in the last line above it, in one further up that names columns, or in a comment. What is left out is added
    to *notes*. Raises :class:`FormatError` where a line is no title, or names another number of columns.
    """
    above = _with_units(above)
    at = next((k for k in reversed(range(len(above))) if _fits(above[k], first, last=k == len(above) - 1)), -1)
    _no_row_among(where, above[at + 1 :] if at >= 0 else [], first)
    if at > 0:
        notes.append(f"{counted(at, 'line')} before the column names are left out")
    if rest := above[at + 1 :]:
        shown = f"{counted(len(rest), 'line')} before the first row ({listed([each.text for each in rest], 3)})"
        if at < 0 and not told and _commented(comments, first) is None:
            _refuse(where, rest[-1].cells, first, line, shown)
        notes.append(f"{shown}: left out")
    if at < 0:
        return _commented(comments, first)
    cells = above[at].cells
    return tuple(cells if len(cells) == len(first) else [*cells, ""])


def names_columns(cells: list[str]) -> bool:
    """Whether a line says what columns are, by their words or units."""
    return sum(bool(parse(cell).role or units.sensor(split(cell)[1])) for cell in cells) >= 2


def _commented(comments: Sequence[list[str]], first: list[str]) -> tuple[str, ...] | None:
    found = (tuple(row) for row in reversed(comments) if len(row) == len(first) and names_columns(row))
    return next(found, None)


def _fits(row: Above, first: list[str], last: bool) -> bool:
    """Whether a line names the columns of *first*: the *last* above it may do so in words that are not known."""
    right = len(row.cells) == len(first) or (len(row.cells) == len(first) - 1 and not first[-1])
    return right and not row.numbers and (last or names_columns(row.cells))


def _no_row_among(where: str, rest: list[Above], first: list[str]) -> None:
    for row in rest:
        if row.numbers:
            raise FormatError(
                f"{where}: line {row.number}: {counted(len(row.cells), 'cell')}, expected {len(first)} like the rows below; "
                "correct or delete the line"
            )


def _refuse(where: str, cells: list[str], first: list[str], line: int, shown: str) -> None:
    if names_columns(cells):
        raise FormatError(
            f"{where}: line {line} has {len(first)} cells, the header above it names {len(cells)} columns "
            f"({listed(cells)}); if the delimiter or the decimal sign was not recognised, say --delimiter or --decimal"
        )
    raise FormatError(
        f"{where}: {shown} name no columns, and {len(first)} follow without a header; say what they are, which leaves "
        f"those lines out: {EXAMPLE}"
    )


def _with_units(above: list[Above]) -> list[Above]:
    """The lines with a row of units below the names put into these."""
    if len(above) < 2 or not _are_units(above[-1].cells):
        return above
    *above, names, row = above
    stated = [re.sub(r"[()\[\]]", "", unit) for unit in row.cells]
    cells = [f"{name} ({unit})" if unit else name for name, unit in zip(names.cells, stated, strict=False)]
    return [*above, names._replace(cells=cells)]


def _are_units(cells: list[str]) -> bool:
    """Whether a row holds units, and perhaps some of quantities that are not read, but no names."""
    said = [cell for cell in cells if cell]
    known = sum(units.is_unit(cell.strip("[]")) for cell in said)
    return known == len(said) or (known >= 3 and known > sum(bool(parse(cell).role) for cell in said))
