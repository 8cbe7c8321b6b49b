"""The lines of a text table as columns of numbers, strictly: every row is right, or the first wrong one is named."""

from __future__ import annotations

import io
import re
from dataclasses import dataclass, field
from typing import Any

from poise.data import arrow
from poise.errors import FormatError
from poise.formats import text_head, text_stamps
from poise.formats.devices import Devices
from poise.formats.table import Columns
from poise.formats.text_head import Dialect

COMMENT = re.compile(rb"(?m)^[ \t]*(?:#|//|%)[^\n]*")
_MARKS = (b"#", b"/", b"%")  # single bytes are found fastest
_ABOVE = 20  # lines that a cut last one is compared with


@dataclass
class Parser:
    """Turns blocks of lines into columns of float64 for one file."""

    where: str
    dialect: Dialect
    columns: dict[str, int]
    devices: Devices
    texts: int = 0
    """lines of text between the rows so far, which are left out"""
    _above: list[bytes] = field(default_factory=list)
    """the last lines that were parsed"""

    def __post_init__(self) -> None:
        marks = re.escape(self.dialect.delimiter.encode()) + rb"\t" * (self.dialect.delimiter == " ")
        self._text = re.compile(rb"(?m)^[^0-9\n" + marks + rb"]+$")  # a row has digits, or more cells

    def rows(self, line: int, block: bytes) -> Columns | None:
        """The wanted columns of one block; None where it holds no row."""
        if any(mark in block for mark in _MARKS):
            block = COMMENT.sub(b"", block)
        if self.dialect.delimiter == " ":
            block = re.sub(rb"(?m)^ | $", b"", re.sub(rb"[ \t]+", b" ", block))
        if not block.strip():
            return None
        import pyarrow

        self._above = block.rsplit(b"\n", _ABOVE + 2)[1:]
        try:
            table, stamps = self._table(block)
        except pyarrow.ArrowException as problem:
            without, count = self._text.subn(b"", block)
            if count:
                self.texts += count
                return self.rows(line, without)
            self._refuse(line, block, str(problem))
        for column in self.devices.columns:
            self.devices.see(column, arrow.different(table.column(f"c{column.index}")))
        words = ("time", "date") if stamps else ()
        numbers = {key: arrow.floats(table.column(f"c{i}")) for key, i in self.columns.items() if key not in words}
        return {**stamps, **numbers}

    def _table(self, block: bytes) -> tuple[Any, Columns]:
        """The cells of a block, and its stamps if they are in words; raises ``ArrowInvalid`` where a line is not right."""
        import pyarrow

        table = self._parse(block)
        expected = block.count(b"\n") + (not block.endswith(b"\n"))
        if table.num_rows not in (expected, expected - len(re.findall(rb"(?m)^\n", block))):
            raise pyarrow.ArrowInvalid(f"{expected} lines gave {table.num_rows} rows")
        return table, self._stamps(table)

    def _stamps(self, table: Any) -> Columns:
        """The time in s where it is written in words."""
        pattern = self.dialect.written(self.columns)
        if not pattern:
            return {}
        texts = [table.column(f"c{self.columns[key]}") for key in ("date", "time") if key in self.columns]
        return {"time": text_stamps.seconds(texts, pattern)}

    def _parse(self, block: bytes) -> Any:
        import pyarrow
        from pyarrow import csv

        width = [f"c{i}" for i in range(len(self.dialect.first))]
        types: dict[str, Any] = {f"c{column.index}": pyarrow.binary() for column in self.devices.columns}
        types |= {f"c{index}": pyarrow.float64() for index in self.columns.values()}
        time = self.columns.get("time")
        if time is not None and self.dialect.iso(time):
            zoned = not re.search(r"\d$", cell := self.dialect.first[time]) or bool(re.search(r":\d\d.*[+-]\d\d", cell))
            types[f"c{time}"] = pyarrow.timestamp("ns", "UTC" if zoned else None)
        elif self.dialect.written(self.columns):
            types |= {f"c{self.columns[key]}": pyarrow.string() for key in ("date", "time") if key in self.columns}
        return csv.read_csv(
            io.BytesIO(block),
            csv.ReadOptions(use_threads=False, block_size=max(len(block) + 1, 1024), column_names=width),
            csv.ParseOptions(delimiter=self.dialect.delimiter, quote_char='"' if b'"' in block else False),
            csv.ConvertOptions(
                column_types=types,
                include_columns=list(types),
                null_values=list(text_head.MISSING),
                strings_can_be_null=True,
                decimal_point=self.dialect.decimal,
            ),
        )

    def is_cut(self, line: bytes) -> bool:
        """Whether the last line, which no line break ends, is the beginning of a row only.

        So it is where cells are missing, the last one is no number, or it has fewer decimals than each of those above.
        """
        cells = self._cells(line)
        last = len(self.dialect.first) - 1
        if len(cells) != last + 1 or last not in self.columns.values():
            return len(cells) <= last
        if not self._is_value(last, cells[last]):
            return True
        above = [found[last] for raw in self._above if len(found := self._cells(raw)) == last + 1]
        return len(above) >= _ABOVE // 2 and self._decimals(cells[last]) < min(map(self._decimals, above))

    def _cells(self, line: bytes) -> list[str]:
        return text_head.split(line.decode("utf-8", "replace"), self.dialect.delimiter)

    def _decimals(self, cell: str) -> int:
        return len(cell.partition(self.dialect.decimal)[2])

    def _is_value(self, index: int, cell: str) -> bool:
        if cell in text_head.MISSING:
            return True
        if index == self.columns.get("time") and self.dialect.iso(index):
            return text_head.ISO.fullmatch(cell) is not None
        if index == self.columns.get("date"):
            return bool(text_stamps.date(cell))
        if index == self.columns.get("time") and self.dialect.written(self.columns):
            return bool(text_stamps.clock(cell) or text_stamps.dated(cell))
        return text_head.number_pattern(self.dialect.decimal).fullmatch(cell) is not None

    def _refuse(self, line: int, block: bytes, problem: str) -> Any:
        """Find the first line of *block* that is not right and say why."""
        width = len(self.dialect.first)
        keys = {index: key for key, index in self.columns.items()}
        for number, raw in enumerate(block.decode("utf-8", "replace").split("\n"), line):
            cells = text_head.split(raw, self.dialect.delimiter)
            if not raw:
                continue
            bad = [i for i in keys if i < len(cells) and not self._is_value(i, cells[i])]
            if len(bad) > len(keys) / 2 or tuple(cells) == self.dialect.names:
                raise FormatError(
                    f"{self.where}: line {number}: text where numbers were expected ({raw[:60]!r}): "
                    "a second log begins here? Split the file and read the parts one by one"
                )
            if len(cells) != width:
                raise FormatError(
                    f"{self.where}: line {number}: {len(cells)} cells, expected {width} like the first row; "
                    "correct or delete the line"
                )
            if bad:
                label = (self.dialect.names or ())[bad[0] : bad[0] + 1]
                raise FormatError(
                    f"{self.where}: line {number}, column {bad[0] + 1} ({label[0] if label else keys[bad[0]]}): "
                    f"found {cells[bad[0]][:40]!r}, {self._advice(keys[bad[0]], cells[bad[0]])}"
                )
        raise FormatError(f"{self.where}: after line {line}: {problem}")

    def _advice(self, key: str, cell: str) -> str:
        if key in ("time", "date") and re.search(r"\d[-:/]\d", cell):
            return f"expected stamps like {text_stamps.EXAMPLES}; with --rate HZ the column is left out"
        other = "," if self.dialect.decimal == "." else "."
        if text_head.number_pattern(other).fullmatch(cell):
            return f'expected a number; if the decimal sign is "{other}", say --decimal "{other}"'
        return "expected a number; leave the cell empty where a sample is missing"
