"""The beginning of a text table: its encoding, delimiter, decimal sign, comments and column names."""

from __future__ import annotations

import csv
import json
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import product

from poise.errors import FormatError
from poise.formats import text_names, text_stamps
from poise.formats.limits import Options
from poise.formats.names import parse
from poise.formats.text_names import Above

COMMENTS = ("#", "//", "%")
MISSING = ("", "nan", "NaN", "NAN", "-nan", "-NaN", "NA", "N/A", "null", "NULL", "None", "none")
LINE_BREAK = re.compile(r"\r\n|\n|\r")
_BOMS = ((b"\xef\xbb\xbf", "utf-8"), (b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be"))
_DELIMITERS = {",": "comma", ";": "semicolon", "\t": "tab", "|": "bar", " ": "blank"}
_WORDS = {"comma": ",", "semicolon": ";", "tab": "\t", "\\t": "\t", "space": " ", "blank": " ", "bar": "|"}
_INSPECTED = 60  # lines
ISO = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d(:\d\d([.,]\d+)?)?(Z|[+-]\d\d:?\d\d)?")


@dataclass(frozen=True)
class Dialect:
    """How one text table is written down."""

    encoding: str
    bom: int
    """bytes before the text"""
    delimiter: str
    """a blank stands for runs of blanks"""
    decimal: str
    names: tuple[str, ...] | None
    skip: int
    """lines before the first row of numbers"""
    first: tuple[str, ...]
    """the cells of the first row of numbers"""
    facts: dict[str, str]
    notes: tuple[str, ...]

    def iso(self, column: int | None) -> bool:
        """Whether that column holds calendar stamps (ISO 8601) instead of numbers."""
        return column is not None and _is_iso(self.first[column])

    def written(self, columns: Mapping[str, int]) -> str:
        """The pattern of "time" in words other than ISO 8601, with the day in "date" if that is given; "" for numbers."""
        if "time" not in columns or self.iso(columns["time"]):
            return ""
        cell = self.first[columns["time"]]
        day = text_stamps.date(self.first[columns["date"]]) if "date" in columns else ""
        return (
            text_stamps.both(day)
            if day and text_stamps.clock(cell)
            else text_stamps.clock(cell) or text_stamps.dated(cell)
        )

    @property
    def sentence(self) -> str:
        comma = ", decimal comma" if self.decimal == "," else ""
        return f"text table, {_DELIMITERS.get(self.delimiter, repr(self.delimiter))} separated{comma}, {self.encoding}"


def number_pattern(decimal: str) -> re.Pattern[str]:
    """What counts as a number in a cell with that decimal sign."""
    mark = re.escape(decimal)
    return re.compile(rf"[+-]?(\d+({mark}\d*)?|{mark}\d+)([eE][+-]?\d+)?|[+-]?(inf|Inf|INF|infinity|Infinity)")


def split(line: str, delimiter: str) -> list[str]:
    """The cells of one line, quotes resolved and blanks trimmed."""
    if delimiter == " ":
        return line.split()
    if '"' in line:
        with suppress(csv.Error):  # a cell longer than the csv module takes
            return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter), [])]
    return [cell.strip() for cell in line.split(delimiter)]


def encoding_of(head: bytes) -> tuple[str, int]:
    """The encoding of a text and the length of its byte order mark."""
    for bom, name in _BOMS:
        if head.startswith(bom):
            return name, len(bom)
    return "utf-8", 0


def inspect(where: str, head: bytes, whole: bool, options: Options) -> Dialect:
    """How the text that begins with *head* is written; *whole* says that nothing follows.

    Raises :class:`FormatError` where it is no table of numbers, or a header has no rows or does not fit them.
    """
    encoding, bom = encoding_of(head)
    lines = LINE_BREAK.split(_decode(head[bom:], encoding))
    if not whole:
        cut = lines.pop()
        options.limits.check(f"{where}: line {len(lines) + 1}", "line", len(cut) if not lines else 0)
    notes: list[str] = []
    told, start = options.delimiter, 0
    if (mark := re.fullmatch(r'"?sep=(.)"?', lines[0].strip(" "))) is not None:
        told, start = told or mark[1], 1
    body = [(i, line) for i, line in enumerate(lines) if i >= start and line.strip() and not _is_comment(line)][
        :_INSPECTED
    ]
    comments = [line.strip().lstrip("#%/").strip() for line in lines if _is_comment(line)]
    facts = dict(_fact(line) for line in comments if line.startswith("poise.") and ": " in line)
    delimiter, decimal, width = _delimiter(where, [line for _, line in body], told, options.decimal)
    rows = [(i, split(line, delimiter)) for i, line in body]
    skip, first = next((i, cells) for i, cells in rows if len(cells) == width and _share(cells, decimal) >= 0.5)
    above = [Above(i + 1, lines[i].strip(), cells, _share(cells, decimal) >= 0.5) for i, cells in rows if i < skip]
    said = [split(comment, delimiter) for comment in comments]
    names = text_names.find(where, above, said, first, skip + 1, options.columns is not None, notes)
    options.limits.check(where, "columns", len(first))
    return Dialect(encoding, bom, delimiter, decimal, names, skip, tuple(first), facts, tuple(notes))


def _fact(line: str) -> tuple[str, str]:
    key, value = line.split(": ", 1)
    with suppress(ValueError):
        value = json.loads(value) if value.startswith('"') else value
    return key, str(value)


def _decode(head: bytes, encoding: str) -> str:
    if encoding != "utf-8":
        return head.decode(encoding, "ignore")
    try:
        return head[: max(len(head) - 3, 0)].decode("utf-8") + head[max(len(head) - 3, 0) :].decode("utf-8", "ignore")
    except UnicodeDecodeError:
        return head.decode("cp1252", "replace")


def _is_iso(cell: str) -> bool:
    return ISO.fullmatch(cell) is not None and "," not in cell


def _is_stamp(cell: str) -> bool:
    return ":" in cell and bool(_is_iso(cell) or text_stamps.clock(cell) or text_stamps.dated(cell))


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith(COMMENTS)


def _delimiter(where: str, lines: list[str], told: str | None, decimal: str | None) -> tuple[str, str, int]:
    """What separates cells and decimals, and how many cells a row has."""
    if told is not None:
        told = _WORDS.get(told, told)
        if len(told) != 1 or (not told.isprintable() and told != "\t") or told.isalnum() or told in '."+-':
            raise FormatError(f'{where}: --delimiter {told!r} not understood; expected one character, "tab" or "space"')
    if decimal not in (None, ".", ","):
        raise FormatError(f'{where}: --decimal {decimal!r} not understood; expected "." or ","')
    best, choice = (0.0, 0), ("", "")
    for delimiter, mark in product(told or _DELIMITERS, decimal or ".,"):
        if (score := _score(lines, delimiter, mark)) > best:
            best, choice = score, (delimiter, mark)
    if best[1]:
        return *choice, best[1]
    if (told or decimal) and max(_score(lines, *each) for each in product(_DELIMITERS, ".,")) > (0.0, 0):
        given = [f"{name} {value!r}" for name, value in (("--delimiter", told), ("--decimal", decimal)) if value]
        raise FormatError(f"{where}: no rows of numbers with {' and '.join(given)}; without, there are: leave it out")
    for i, delimiter in product(range(min(3, len(lines))), _DELIMITERS):
        if sum(bool(parse(name).role) for name in split(lines[i], delimiter)) >= 3:
            raise FormatError(f"{where}: line {i + 1} names columns, but no row of numbers follows")
    shown = f"it begins with {lines[0][:60]!r}" if lines else "nothing but comments"
    raise FormatError(f"{where}: no rows of numbers found ({shown}); expected a table, one sample a line")


def _score(lines: list[str], delimiter: str, decimal: str) -> tuple[float, int]:
    """How much of *lines* becomes rows of numbers of one width when split that way, and that width."""
    rows = [split(line, delimiter) for line in lines]
    shares = [(share, len(row)) for row in rows if len(row) > 1 and (share := _share(row, decimal)) >= 0.5]
    if not shares:
        return 0.0, 0
    width = Counter(length for _, length in shares).most_common(1)[0][0]
    return round(sum(share for share, length in shares if length == width) / len(rows), 6), width


def _share(cells: Sequence[str], decimal: str) -> float:
    """How much of a row is numbers, stamps or nothing; 0 where not even one number is there."""
    pattern = number_pattern(decimal)
    numbers = sum(pattern.fullmatch(cell) is not None for cell in cells)
    other = sum(cell in MISSING or _is_stamp(cell) for cell in cells)
    return (numbers + other) / len(cells) if numbers else 0.0
