"""What a check has found out about one method."""

from __future__ import annotations

from typing import NamedTuple


class Check(NamedTuple):
    """One line of the table of checks, for one method."""

    group: str
    name: str
    asked: str
    contender: str
    found: str
    met: bool
