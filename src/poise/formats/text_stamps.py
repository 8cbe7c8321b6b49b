"""Stamps as text: dates and times of day to seconds, where they can be read in one way only."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from poise.data import arrow
from poise.formats.table import Floats

DAY = 86_400.0  # s
EXAMPLES = "2023-05-04T10:11:12.345, 04-May-2023 10:11:12.345 or 10:11:12.345"
_MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")

# For Python and Arrow. 04/05/2023 is two days, and not among them.
CLOCK = r"(?P<hour>\d{1,2}):(?P<minute>\d\d):(?P<second>\d\d(?:[.,]\d+)?)"
_DATES = (
    r"(?P<year>\d{4})[-/.](?P<month>\d{1,2})[-/.](?P<day>\d{1,2})",
    r"(?P<day>\d{1,2})[- ](?P<month>[A-Za-z]{3})[- ](?P<year>\d{4})",
)


def date(cell: str) -> str:
    """The pattern of the date in *cell*; "" where it is none."""
    return next((pattern for pattern in _DATES if re.fullmatch(pattern, cell)), "")


def clock(cell: str) -> str:
    """The pattern of the time of day in *cell*; "" where it is none."""
    return CLOCK if re.fullmatch(CLOCK, cell) else ""


def both(dates: str) -> str:
    """The pattern of a date and, behind T or a blank, a time of day."""
    return f"{dates}[T ]{CLOCK}"


def dated(cell: str) -> str:
    """The pattern of the date with a time of day in *cell*; "" where it is none."""
    return next((both(pattern) for pattern in _DATES if re.fullmatch(both(pattern), cell)), "")


def seconds(columns: Sequence[Any], pattern: str) -> Floats:
    """(n,) s since 1970, or since midnight where the *pattern* has no date, of one Arrow column or of two; null is NaN.

    Raises ``ArrowInvalid`` where a text is not of the pattern or no time.
    """
    import pyarrow
    import pyarrow.compute

    compute: Any = pyarrow.compute
    texts = columns[0] if len(columns) == 1 else compute.binary_join_element_wise(*columns, " ")
    found = compute.extract_regex(texts, pattern=f"^{pattern}$")
    if found.null_count != texts.null_count:
        raise pyarrow.ArrowInvalid("not all stamps are written like the first")
    parts: dict[str, Floats] = {}
    for name in re.findall(r"\?P<(\w+)>", pattern):
        words = compute.struct_field(found, name)
        if name == "month":
            numbers = [_month(text) * arrow.floats(compute.equal(words, text)) for text in arrow.different(words)]
            parts[name] = np.sum(numbers, axis=0) if numbers else arrow.floats(words)
        else:
            parts[name] = arrow.floats(compute.replace_substring(words, ",", "."))
    time = parts["hour"] * 3600.0 + parts["minute"] * 60.0 + parts["second"]
    known = np.isfinite(time)
    right = (parts["hour"] < 24) & (parts["minute"] < 60) & (parts["second"] < 61)  # 60 is a leap second
    if "year" in parts:
        months = ((parts["year"] - 1970) * 12 + parts["month"] - 1)[known].astype("M8[M]")
        days = months.astype("M8[D]") + (parts["day"][known] - 1).astype("m8[D]")
        right[known] &= (days.astype("M8[M]") == months) & (parts["month"][known] >= 1) & (parts["month"][known] <= 12)
        time[known] += days.astype(np.int64) * DAY
    if not right[known].all():
        raise pyarrow.ArrowInvalid("a stamp names a day or time that is none")
    return time


def _month(text: str) -> int:
    return int(text) if text.isdigit() else _MONTHS.index(text.lower()) + 1 if text.lower() in _MONTHS else 0
