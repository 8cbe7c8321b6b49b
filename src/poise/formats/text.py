"""CSV, TSV and other text tables: parsed a block of whole lines at a time, strictly."""

from __future__ import annotations

import codecs
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from poise.errors import FormatError
from poise.formats import layouts, names, text_head, text_stamps
from poise.formats.devices import Devices
from poise.formats.layouts import Column
from poise.formats.limits import Limits, Options
from poise.formats.table import KIND, STRETCH, STRETCHES, Block, Columns, Table, joined
from poise.formats.text_head import Dialect
from poise.formats.text_parser import COMMENT, Parser

_BLOCK = 4 * 2**20  # bytes
_SMALL = 32 * 2**20  # bytes: a file of which every row is looked at before any is used
_STRETCH_BYTES = 16 * 2**20  # bytes that a stretch of the sample may take, should its lines be long


def read(path: Path, options: Options) -> Table:
    """The table in a text file. Raises :class:`FormatError` with line, column and reason where a row is not right."""
    where = str(path)
    with path.open("rb") as file:
        head = file.read(4 * options.limits.line)
        dialect = text_head.inspect(where, head, not file.read(1), options)
    if dialect.facts.get(KIND) == "attitude":
        raise FormatError(f"{where}: an attitude that poise wrote, not a recording; read it with read_attitude")
    header = layouts.renamed(where, dialect.names, options.columns, len(dialect.first))
    layout = layouts.choose(where, header, timed=options.rate is not None)
    columns = {key: column.index for key, column in layout.columns.items()}
    if options.rate is not None:
        columns.pop("time", None)  # which may hold anything then
    if layout.date and dialect.written(columns) == text_stamps.CLOCK:
        dated = columns | {"date": layout.date.index}
        if dialect.written(dated) != text_stamps.CLOCK:
            columns = dated
            layout = replace(layout, unused=tuple(name for name in layout.unused if name != layout.date.name))
    written = dialect.written(columns)
    rows = TextRows(where, path, dialect, columns, options.limits, layout.devices)
    rows.notes += [*dialect.notes, *layout.notes]
    return Table(
        dialect.sentence,
        layout,
        rows,
        dialect.facts,
        time_unit="s" if written or dialect.iso(columns.get("time")) else "",
        daily=written == text_stamps.CLOCK,
        notes=rows.notes,
        doubts=rows.doubts,
    )


class TextRows:
    """The rows of a text file; *columns* is key to column number.

    Its position is a byte, a line, lines to skip, and how many lines of text were left out before.
    *notes* and *doubts* grow when the end of the file is read. Raises :class:`FormatError` with line, column and
    reason where a row is not right.
    """

    def __init__(
        self,
        where: str,
        path: Path,
        dialect: Dialect,
        columns: dict[str, int],
        limits: Limits,
        devices: Sequence[Column] = (),
    ) -> None:
        self._where, self._path, self._dialect, self._limits = where, path, dialect, limits
        self._columns, self._devices = columns, Devices(where, devices)
        self._kept: list[Block] | None = None  # a small file is parsed once, for sample and rows
        self.notes: list[str] = []
        self.doubts: list[str] = []

    def sample(self) -> Columns:
        """Every row of a file up to 32 MiB, else evenly spread stretches of it."""
        size = self._path.stat().st_size
        if size <= _SMALL:
            self._kept = list(self.blocks())
            return joined([block.columns.copy() for block in self._kept])
        parts = []
        try:
            for i in range(STRETCHES):
                parts += self._stretch(self._line_after(i * (size // STRETCHES)) if i else None)
        except FormatError:
            said = len(self.notes), len(self.doubts)
            for _ in self.blocks():  # which says the line
                pass
            del self.notes[said[0] :], self.doubts[said[1] :]
        if not parts:
            raise FormatError(f"{self._where}: no whole row of numbers found; expected one sample a line")
        return joined(parts)

    def blocks(self, position: tuple[int, ...] | None = None) -> Iterator[Block]:
        """All rows, or those from a block on."""
        if self._kept is not None:
            yield from (block for block in self._kept if position is None or block.position >= tuple(position))
            return
        found, parser = position is not None, self._parser(position)
        for at, columns, ended in self._parsed(parser, position):
            if columns is None:
                self.notes.append(f"line {at[1]}: the last row is cut short and left out")
                continue
            if not ended:
                self.doubts.append("the file does not end with a line break: its last row may be cut short")
            found = True
            yield Block(at, columns)
        if parser.texts:
            self.notes.append(f"{names.counted(parser.texts, 'line')} of text between the rows, left out")
        if not found:
            raise FormatError(f"{self._where}: no whole row of numbers found; expected one sample a line")

    def _parser(self, position: tuple[int, ...] | None) -> Parser:
        return Parser(self._where, self._dialect, self._columns, self._devices, texts=position[3] if position else 0)

    def _parsed(
        self, parser: Parser, position: tuple[int, ...] | None
    ) -> Iterator[tuple[tuple[int, ...], Columns | None, bool]]:
        """Blocks with rows, None for a last row that is cut short, and whether a line break ends them."""
        place = position and position[:3]
        with self._path.open("rb") as file:
            for at, line, block, ended in _lines(self._where, file, self._dialect, self._limits, place):
                at = (*at, parser.texts)
                if not ended and parser.is_cut(block):
                    yield at, None, ended
                elif (rows := parser.rows(line, block)) is not None:
                    yield at, rows, ended

    def _stretch(self, position: tuple[int, ...] | None) -> list[Columns]:
        parts: list[Columns] = []
        missing = STRETCH
        for at, columns, _ in self._parsed(self._parser(position), position):
            if columns is None or missing <= 0 or at[0] - (position or (0,))[0] > _STRETCH_BYTES:
                break
            parts.append({key: values[:missing] for key, values in columns.items()})
            missing -= len(next(iter(columns.values())))
        return parts

    def _line_after(self, offset: int) -> tuple[int, ...]:
        """The position of the first line that begins behind *offset*."""
        wide = 1 if self._dialect.encoding == "utf-8" else 2
        offset += (offset - self._dialect.bom) % wide
        feed, back = (mark.encode(self._dialect.encoding) for mark in "\n\r")
        with self._path.open("rb") as file:
            file.seek(offset)
            window = file.read(wide * (self._limits.line + 4))
        at = 0
        while at < len(window) and window[at : at + wide] not in (feed, back):
            at += wide
        at += 2 * wide if window[at : at + 2 * wide] == back + feed else wide
        return offset + at, 0, 0, 0


def _lines(
    where: str, file: BinaryIO, dialect: Dialect, limits: Limits, position: tuple[int, ...] | None = None
) -> Iterator[tuple[tuple[int, ...], int, bytes, bool]]:
    """Blocks of whole lines as UTF-8 with \\n: position, first line's number, lines, whether a line break ends them."""
    offset, line, skip = position or (dialect.bom, 1, dialect.skip)
    file.seek(offset)
    decoder = codecs.getincrementaldecoder(dialect.encoding)() if dialect.encoding != "utf-8" else None
    rest = b""
    while raw := file.read(_BLOCK):
        at = (offset, line, skip)
        block = rest + (_transcode(where, line, decoder, raw) if decoder else raw)
        held = b"\r" if block.endswith(b"\r") else b""  # perhaps half of \r\n
        if b"\r" in block:
            block = block[: len(block) - len(held)].replace(b"\r\n", b"\n").replace(b"\r", b"\n")
        cut = block.rfind(b"\n") + 1
        rest, block = block[cut:] + held, block[:cut]
        offset = file.tell() - _pending(decoder) - len(rest.decode().encode(dialect.encoding) if decoder else rest)
        count = _check_lines(where, line, block, rest, limits)
        if block:
            for first, part in _without(block, line, skip):
                yield at, first, part, True
            line, skip = line + count, max(0, skip - count)
    at = (offset, line, skip)
    if rest.endswith(b"\r"):
        yield at, line, rest[:-1] + b"\n", True
    elif rest.strip() and not COMMENT.match(rest):
        yield at, line, rest, False


def _pending(decoder: Any) -> int:
    """Bytes that *decoder* has read and not yet given."""
    return len(decoder.getstate()[0]) if decoder else 0


def _without(block: bytes, line: int, skip: int) -> Iterator[tuple[int, bytes]]:
    start = 0
    for _ in range(min(skip, block.count(b"\n"))):
        start = block.index(b"\n", start) + 1
        line += 1
    if block[start:]:
        yield line, block[start:]


def _transcode(where: str, line: int, decoder: Any, raw: bytes) -> bytes:
    try:
        return bytes(decoder.decode(raw).encode("utf-8"))
    except UnicodeError as problem:
        raise FormatError(f"{where}: after line {line}: not UTF-16 text ({problem}); the file is damaged") from None


def _check_lines(where: str, line: int, block: bytes, rest: bytes, limits: Limits) -> int:
    """How many lines end in *block*; raises where one is too long or holds NUL bytes."""
    ends = np.flatnonzero(np.frombuffer(block, np.uint8) == 10)
    lengths = np.diff(ends, prepend=-1)
    longest = int(np.argmax(lengths)) if len(lengths) else 0
    if len(rest) > limits.line:
        limits.check(f"{where}: line {line + len(ends)}", "line", len(rest))
    if len(lengths):
        limits.check(f"{where}: line {line + longest}", "line", int(lengths[longest]) - 1)
    nul = block.find(b"\0")
    if nul >= 0 or b"\0" in rest:
        row = line + (int(np.searchsorted(ends, nul)) if nul >= 0 else len(ends))
        raise FormatError(
            f"{where}: line {row}: NUL bytes, which text does not have; the file is damaged (a logger lost power?). "
            "Cut it before this line"
        )
    return len(ends)
