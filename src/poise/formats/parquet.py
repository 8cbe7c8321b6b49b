"""Parquet tables: the footer is checked before a value is read, and only the columns that are used are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from poise.data import arrow
from poise.errors import FormatError
from poise.formats import layouts
from poise.formats.devices import Devices
from poise.formats.layouts import Column
from poise.formats.limits import Options, check_expansion
from poise.formats.table import BLOCK, KIND, Block, Columns, Table, joined, stretches

_RATE = " or time stamps; with --rate HZ the column is left out"


def read(path: Path, options: Options) -> Table:
    """The table in a Parquet file. Raises :class:`FormatError` where it is damaged or not a recording."""
    where = str(path)
    with opened(where, path) as file:
        facts = metadata(file)
        if facts.get(KIND) == "attitude":
            raise FormatError(f"{where}: an attitude that poise wrote, not a recording; read it with read_attitude")
        options.limits.check(where, "columns", len(file.schema_arrow.names))
        header = layouts.renamed(where, file.schema_arrow.names, options.columns, len(file.schema_arrow.names))
        layout = layouts.choose(where, header, timed=options.rate is not None)
        wanted = {key: file.schema_arrow.names[column.index] for key, column in layout.columns.items()}
        if options.rate is not None:
            wanted.pop("time", None)  # which may hold anything then
        rows = ParquetRows(where, path, file, wanted, options, layout.devices)
    return Table("Parquet", layout, rows, facts, None, "s" if rows.calendar else "", list(layout.notes))


def opened(where: str, path: Path) -> Any:
    """The opened Parquet file; raises :class:`FormatError` where its footer is damaged."""
    import pyarrow
    from pyarrow import parquet

    try:
        # In pieces: a row group may be as long as the file.
        return parquet.ParquetFile(path, page_checksum_verification=True, pre_buffer=False, buffer_size=2**20)
    except (pyarrow.ArrowException, OSError, ValueError) as problem:
        raise FormatError(f"{where}: damaged Parquet file ({_short(problem)}); copy or export it again") from None


def metadata(file: Any) -> dict[str, str]:
    """What the schema says beside the columns."""
    found = file.schema_arrow.metadata or {}
    return {key.decode("utf-8", "replace"): value.decode("utf-8", "replace") for key, value in found.items()}


class ParquetRows:
    """The rows of a Parquet file, a batch at a time; *wanted* is key to column name.

    Raises :class:`FormatError` where the footer promises more than there can be, or a column holds no numbers.
    """

    def __init__(
        self,
        where: str,
        path: Path,
        file: Any,
        wanted: dict[str, str],
        options: Options,
        devices: Sequence[Column] = (),
    ) -> None:
        import pyarrow

        self._where, self._path, self._wanted = where, path, wanted
        self._devices = Devices(where, devices)
        self.count = int(file.metadata.num_rows)
        if self.count <= 0:
            raise FormatError(f"{where}: no rows")
        options.limits.check(where, "rows", self.count)
        check_expansion(where, path.stat().st_size, self.count * 8 * len(wanted))
        self.calendar = False
        """whether time is a calendar's (then in s)"""
        for key, name in wanted.items():
            kind = file.schema_arrow.field(name).type
            if pyarrow.types.is_timestamp(kind) and key == "time":
                self.calendar = True
            elif not _is_number(kind):
                raise FormatError(
                    f"{where}: column {name!r} ({key}) holds {kind}, expected numbers{_RATE * (key == 'time')}"
                )

    def sample(self) -> Columns:
        """Every row of a short file, else evenly spread stretches of it."""
        wanted = stretches(self.count)
        parts: list[Columns] = []
        for block in self._overlapping(wanted):
            start, end = block.position[0], block.position[0] + _length(block)
            for part in wanted:
                if part.start < end and part.stop > start:
                    rows = slice(max(part.start - start, 0), part.stop - start)
                    parts.append({key: values[rows] for key, values in block.columns.items()})
        if not parts:
            raise FormatError(f"{self._where}: the footer promises {self.count} rows, none were found; it is damaged")
        return joined(parts)

    def blocks(self, position: tuple[int, ...] | None = None) -> Iterator[Block]:
        """All rows, or those from a block on; raises :class:`FormatError` where the file is damaged."""
        found = position[0] if position else 0
        for block in self._overlapping([slice(found, self.count)]):
            found = block.position[0] + _length(block)
            yield block
        if found != self.count:
            raise FormatError(
                f"{self._where}: the footer promises {self.count} rows, {found} were found; the file is damaged"
            )

    def _overlapping(self, parts: list[slice]) -> Iterator[Block]:
        """The batches that hold any of those rows; a batch never spans two row groups."""
        import pyarrow

        try:
            with opened(self._where, self._path) as file:
                start = 0
                for group in range(file.metadata.num_row_groups):
                    end = start + file.metadata.row_group(group).num_rows
                    if any(part.start < end and part.stop > start for part in parts):
                        yield from self._group(file, group, start, parts)
                    start = end
        except (pyarrow.ArrowException, OSError, ValueError, KeyError) as problem:
            advice = "copy or export it again"
            raise FormatError(f"{self._where}: damaged Parquet file ({_short(problem)}); {advice}") from None

    def _group(self, file: Any, group: int, start: int, parts: list[slice]) -> Iterator[Block]:
        devices = {column: file.schema_arrow.names[column.index] for column in self._devices.columns}
        names = [*self._wanted.values(), *devices.values()]
        for batch in file.iter_batches(BLOCK, row_groups=[group], columns=names, use_threads=False):
            end = start + batch.num_rows
            if any(part.start < end and part.stop > start for part in parts):
                for column, name in devices.items():
                    self._devices.see(column, arrow.different(batch.column(name)))
                columns = {key: arrow.floats(batch.column(name)) for key, name in self._wanted.items()}
                yield Block((start,), columns)
            start = end


def _length(block: Block) -> int:
    return len(next(iter(block.columns.values())))


def _is_number(kind: Any) -> bool:
    from pyarrow import types

    return any(check(kind) for check in (types.is_floating, types.is_integer, types.is_boolean, types.is_decimal))


def _short(problem: BaseException) -> str:
    return (str(problem) or type(problem).__name__).split("\n")[0][:160]
