"""Table: what every reader hands on, columns of numbers as the file has them and what was said about them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from poise.formats.names import Layout

Floats = NDArray[np.float64]
KIND = "poise.kind"  # in the facts of what poise wrote: "recording" or "attitude"


@dataclass
class Table:
    """The columns of one file that are used, (n,) each, in the file's own units; emptied as the recording is made."""

    format: str
    layout: Layout
    columns: dict[str, Floats]
    facts: dict[str, str] = field(default_factory=dict)
    """what a file of poise's own says beside its columns"""
    rate: float | None = None
    """1/s, where the file says it instead of stamps"""
    time_unit: str = ""
    """where the values themselves tell, not the column's name"""
    notes: list[str] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)

    @property
    def own(self) -> bool:
        """Whether poise wrote it, so that its units are a fact and need no evidence."""
        return self.facts.get(KIND) == "recording"


class Blocks:
    """Rows that arrive a block at a time, kept as whole columns that grow; a block is free again once it is added."""

    def __init__(self, width: int) -> None:
        self.rows = 0
        self._columns = [np.empty(0)] * width

    def add(self, block: list[Floats]) -> None:
        """Take the next rows: one array of one length for each column."""
        start, end = self.rows, self.rows + len(block[0])
        for i, values in enumerate(block):
            if end > len(self._columns[i]):
                grown = np.empty(end + end // 2)  # what is not written to yet takes no memory
                grown[:start] = self._columns[i][:start]
                self._columns[i] = grown
            self._columns[i][start:end] = values
        self.rows = end

    def columns(self) -> list[Floats]:
        """Every column, (rows,)."""
        return [column[: self.rows] for column in self._columns]
