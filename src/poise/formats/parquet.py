"""Parquet tables: the footer is checked before a value is read, and only the columns that are used are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from poise.data import arrow
from poise.errors import FormatError
from poise.formats import names
from poise.formats.limits import Options, check_expansion
from poise.formats.table import KIND, Blocks, Floats, Table

_BATCH = 65_536  # rows


def read(path: Path, options: Options) -> Table:
    """The table in a Parquet file. Raises :class:`FormatError` where it is damaged or not a recording."""
    where = str(path)
    with opened(where, path) as file:
        facts = metadata(file)
        if facts.get(KIND) == "attitude":
            raise FormatError(f"{where}: an attitude that poise wrote, not a recording; read it with read_attitude")
        options.limits.check(where, "columns", len(file.schema_arrow.names))
        header = names.renamed(where, file.schema_arrow.names, options.columns, len(file.schema_arrow.names))
        layout = names.choose(where, header, timed=options.rate is not None)
        wanted = {key: file.schema_arrow.names[column.index] for key, column in layout.columns.items()}
        values, calendar = columns(where, path, file, wanted, options)
    return Table("Parquet", layout, values, facts, None, "s" if calendar else "", list(layout.notes))


def opened(where: str, path: Path) -> Any:
    """The opened Parquet file; raises :class:`FormatError` where its footer is damaged."""
    import pyarrow
    from pyarrow import parquet

    try:
        return parquet.ParquetFile(path, page_checksum_verification=True)
    except (pyarrow.ArrowException, OSError, ValueError) as problem:
        raise FormatError(f"{where}: damaged Parquet file ({_short(problem)}); copy or export it again") from None


def metadata(file: Any) -> dict[str, str]:
    """What the schema says beside the columns."""
    found = file.schema_arrow.metadata or {}
    return {key.decode("utf-8", "replace"): value.decode("utf-8", "replace") for key, value in found.items()}


def columns(
    where: str, path: Path, file: Any, wanted: dict[str, str], options: Options
) -> tuple[dict[str, Floats], bool]:
    """The *wanted* columns (key to name) as float64, and whether time is a calendar's (then in s)."""
    import pyarrow

    rows = file.metadata.num_rows
    if rows <= 0:
        raise FormatError(f"{where}: no rows")
    options.limits.check(where, "rows", rows)
    check_expansion(where, path.stat().st_size, rows * 8 * len(wanted))
    calendar = False
    blocks = Blocks(len(wanted))
    try:
        kinds = {name: file.schema_arrow.field(name).type for name in wanted.values()}
        for key, name in wanted.items():
            if pyarrow.types.is_timestamp(kinds[name]) and key == "time":
                calendar = True
            elif not _is_number(kinds[name]):
                raise FormatError(f"{where}: column {name!r} ({key}) holds {kinds[name]}, expected numbers")
        for batch in file.iter_batches(_BATCH, columns=list(wanted.values()), use_threads=False):
            blocks.add([arrow.floats(batch.column(name)) for name in wanted.values()])
    except (pyarrow.ArrowException, OSError, ValueError, KeyError) as problem:
        raise FormatError(f"{where}: damaged Parquet file ({_short(problem)}); copy or export it again") from None
    if blocks.rows != rows:
        raise FormatError(f"{where}: the footer promises {rows} rows, {blocks.rows} were found; the file is damaged")
    return dict(zip(wanted, blocks.columns(), strict=True)), calendar


def _is_number(kind: Any) -> bool:
    from pyarrow import types

    return any(check(kind) for check in (types.is_floating, types.is_integer, types.is_boolean, types.is_decimal))


def _short(problem: BaseException) -> str:
    return (str(problem) or type(problem).__name__).split("\n")[0][:160]
