"""Table: what every reader hands on, the columns of numbers as the file has them and what was said about them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from poise.formats.layouts import Layout
from poise.formats.limits import Limits

Floats = NDArray[np.float64]
Columns = dict[str, Floats]
"""ours (gyr_x, …) to (n,) values in the file's own units"""
KIND = "poise.kind"  # in the facts of what poise wrote: "recording" or "attitude"

BLOCK = 65_536  # rows
STRETCH, STRETCHES = 25_000, 8  # rows that a longer file's units are decided from: evenly spread stretches of it


class Block(NamedTuple):
    """The next rows of a file, and where its reader begins to read them again."""

    position: tuple[int, ...]
    columns: Columns


class Rows(Protocol):
    """The rows of one file: a bounded sample of them, and all of them a block at a time."""

    def sample(self) -> Columns:
        """Rows that stand for all; every one of a small file."""

    def blocks(self, position: tuple[int, ...] | None = None) -> Iterator[Block]:
        """All rows in their order, from the beginning or from the block at *position* on."""


@dataclass
class Table:
    """One file: which of its columns are what, what it says beside them, and its rows."""

    format: str
    layout: Layout
    rows: Rows
    facts: dict[str, str] = field(default_factory=dict)
    """what a file of poise's own says beside its columns"""
    rate: float | None = None
    """1/s, where the file says it instead of stamps"""
    time_unit: str = ""
    """where the values themselves tell, not the column's name"""
    notes: list[str] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)
    """both may still grow while the last rows are read"""
    daily: bool = False
    """whether time is that of a day, which begins anew at midnight"""

    @property
    def own(self) -> bool:
        """Whether poise wrote it, so that its units are a fact and need no evidence."""
        return self.facts.get(KIND) == "recording"


@dataclass
class Whole:
    """Rows that are in memory already: *columns* of one length."""

    columns: Columns

    def sample(self) -> Columns:
        """Every row of a short table, else evenly spread stretches of it."""
        return joined([{key: values[part] for key, values in self.columns.items()} for part in stretches(len(self))])

    def blocks(self, position: tuple[int, ...] | None = None) -> Iterator[Block]:
        """Views of the columns."""
        for start in range(position[0] if position else 0, len(self), BLOCK):
            yield Block((start,), {key: values[start : start + BLOCK] for key, values in self.columns.items()})

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))


def stretches(rows: int) -> list[slice]:
    """The rows of so many that a sample is made of: all, or evenly spread stretches."""
    if rows <= STRETCH * STRETCHES:
        return [slice(0, rows)]
    return [slice(start, start + STRETCH) for start in range(0, rows - rows % STRETCHES, rows // STRETCHES)]


def joined(blocks: list[Columns]) -> Columns:
    """The columns of consecutive *blocks*, which are emptied; at least one."""
    if len(blocks) == 1:
        return blocks[0]
    return {key: np.concatenate([block.pop(key) for block in blocks]) for key in list(blocks[0])}


def everything(where: str, rows: Rows, limits: Limits) -> Columns:
    """All rows of a file in memory. Raises :class:`FormatError` where they are more than the limit."""
    blocks, count = [], 0
    for block in rows.blocks():
        count += len(next(iter(block.columns.values())))
        limits.check(where, "rows", count)
        blocks.append(block.columns)
    return joined(blocks)
