"""The beginning of a text table: its encoding, delimiter, decimal sign, comments and column names."""

from __future__ import annotations

import csv
import json
import re
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import product

from poise.errors import FormatError
from poise.formats import units
from poise.formats.limits import Options
from poise.formats.names import listed, parse
from poise.formats.names import split as split_name

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
        return column is not None and ISO.fullmatch(self.first[column]) is not None

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
    delimiter, decimal = _delimiter(where, [line for _, line in body], told, options.decimal)
    skip, first = next(
        ((i, split(line, delimiter)) for i, line in body if _share(split(line, delimiter), decimal) >= 0.5), (-1, [])
    )
    texts = [split(line, delimiter) for i, line in body if i < skip]
    names = _names(where, texts, comments, delimiter, first, skip, notes)
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


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith(COMMENTS)


def _delimiter(where: str, lines: list[str], told: str | None, decimal: str | None) -> tuple[str, str]:
    if told is not None:
        told = _WORDS.get(told, told)
        if len(told) != 1 or (not told.isprintable() and told != "\t") or told.isalnum() or told in '."+-':
            raise FormatError(f'{where}: --delimiter {told!r} not understood; expected one character, "tab" or "space"')
    if decimal not in (None, ".", ","):
        raise FormatError(f'{where}: --decimal {decimal!r} not understood; expected "." or ","')
    best, choice = (0.0, 0), None
    for delimiter, mark in product(told or _DELIMITERS, decimal or ".,"):
        if (score := _score(lines, delimiter, mark)) > best:
            best, choice = score, (delimiter, mark)
    if choice is not None:
        return choice
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
    other = sum(cell in MISSING or ISO.fullmatch(cell) is not None for cell in cells)
    return (numbers + other) / len(cells) if numbers else 0.0


def _names(
    where: str,
    texts: list[list[str]],
    comments: list[str],
    delimiter: str,
    first: list[str],
    skip: int,
    notes: list[str],
) -> tuple[str, ...] | None:
    if texts:
        cells = texts.pop()
        if texts and _are_units(cells):
            row = [re.sub(r"[()\[\]]", "", unit) for unit in cells]
            cells = [f"{name} ({unit})" if unit else name for name, unit in zip(texts.pop(), row, strict=False)]
        if texts:
            notes.append(f"{len(texts)} lines before the column names are left out")
    else:
        last = [split(comment, delimiter) for comment in comments]
        cells = next((row for row in reversed(last) if _names_columns(row, len(first))), [])
        if not cells:
            return None
    if len(cells) == len(first) - 1 and not first[-1]:
        cells = [*cells, ""]
    if len(cells) != len(first):
        raise FormatError(
            f"{where}: line {skip + 1} has {len(first)} cells, the header above it names {len(cells)} columns "
            f"({listed(cells)}); if the delimiter or the decimal sign was not recognised, say --delimiter or --decimal"
        )
    return tuple(cells)


def _are_units(cells: list[str]) -> bool:
    """Whether a row holds units, and perhaps some of quantities that are not read, but no names."""
    said = [cell for cell in cells if cell]
    known = sum(units.is_unit(cell.strip("[]")) for cell in said)
    return known == len(said) or (known >= 3 and known > sum(bool(parse(cell).role) for cell in said))


def _names_columns(cells: list[str], width: int) -> bool:
    return (
        len(cells) == width and sum(bool(parse(cell).role or units.sensor(split_name(cell)[1])) for cell in cells) >= 2
    )
