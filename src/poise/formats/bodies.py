"""Tables written a block at a time, so that a writer can go on behind what is already in the file."""

from __future__ import annotations

import io
import json
import struct
from typing import Any, BinaryIO, Protocol

from poise.formats.parquet_footer import moved

_PARQUET: dict[str, Any] = {"compression": "zstd", "use_dictionary": False, "write_page_checksum": True}
_MAGIC = b"PAR1"


class Body(Protocol):
    """The rows of a table in an open file; what begins and what ends the file may wait until all is known.

    *file* is appended to, and *index* keeps what :meth:`tail` needs; a body over both goes on where they end.
    """

    def add(self, table: Any) -> None:
        """Append an Arrow table."""

    def head(self, facts: dict[str, str], comments: list[str]) -> bytes:
        """What stands before the rows."""

    def tail(self, facts: dict[str, str]) -> bytes:
        """What stands behind the rows."""


class ParquetBody:
    """Row groups, one an added table. Each is made as a file of its own, whose rows are appended to *file*.

    Its footer, moved along, goes to *index*; the last footer names all row groups. Parquet keeps the places of its row
    groups in the footer only, so it can be made at any time, from whatever was appended.
    """

    def __init__(self, file: BinaryIO, index: BinaryIO, names: tuple[str, ...]) -> None:
        self._file, self._index, self._names = file, index, names

    def add(self, table: Any) -> None:
        """Append an Arrow table as one row group."""
        from pyarrow import parquet

        table, made = table.select(self._names), io.BytesIO()
        writer = parquet.ParquetWriter(made, table.schema, **_PARQUET)
        writer.write_table(table)
        end = made.tell()
        writer.close()
        start = self._file.tell() or self._file.write(_MAGIC)
        self._file.write(made.getbuffer()[len(_MAGIC) : end])
        footer = moved(bytes(made.getbuffer()[end:-8]), start - len(_MAGIC))  # behind it: its length and the magic
        self._index.write(struct.pack("<I", len(footer)) + footer)

    def head(self, facts: dict[str, str], comments: list[str]) -> bytes:
        """Nothing: the rows bring it."""
        return b""

    def tail(self, facts: dict[str, str]) -> bytes:
        """The footer: what is in the row groups, and the *facts* as the schema's metadata."""
        from pyarrow import parquet

        self._index.seek(0)
        whole: Any = None
        while length := self._index.read(4):
            footer = self._index.read(*struct.unpack("<I", length))
            group = parquet.read_metadata(io.BytesIO(_MAGIC + footer + length + _MAGIC))
            if whole is None:
                whole = _empty(group.schema.to_arrow_schema().with_metadata(facts))
            whole.append_row_groups(group)
        made = io.BytesIO()
        whole.write_metadata_file(made)
        return made.getvalue()[len(_MAGIC) :]


class TextBody:
    """Lines of comma or blank separated numbers below comments."""

    def __init__(self, file: BinaryIO, names: tuple[str, ...], delimiter: str) -> None:
        self._file, self._names, self._delimiter = file, names, delimiter

    def add(self, table: Any) -> None:
        """Append an Arrow table as lines."""
        from pyarrow import csv

        options = csv.WriteOptions(include_header=False, delimiter=self._delimiter, quoting_style="none")
        csv.write_csv(table.select(self._names), self._file, options)

    def head(self, facts: dict[str, str], comments: list[str]) -> bytes:
        """The *facts* and the *comments* as comments, and the names of the columns: in a comment where blanks separate."""
        lines = [f"# {key}: {_one_line(value)}" for key, value in facts.items()] + [f"# {text}" for text in comments]
        names = ("# " if self._delimiter == " " else "") + self._delimiter.join(self._names)
        return "".join(f"{line}\n" for line in [*lines, names]).encode()

    def tail(self, facts: dict[str, str]) -> bytes:
        """Nothing."""
        return b""


def _empty(schema: Any) -> Any:
    """The metadata of a file without rows."""
    from pyarrow import parquet

    file = io.BytesIO()
    parquet.ParquetWriter(file, schema, **_PARQUET).close()
    return parquet.read_metadata(file)


def _one_line(value: str) -> str:
    """*value*, or its JSON where it would not survive as the rest of a line."""
    return value if value.isprintable() and value == value.strip() and value[:1] != '"' else json.dumps(value)
