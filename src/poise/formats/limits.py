"""Limits: how much a file may ask for before it is refused, and the other options of a reader."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from poise.errors import FormatError

_WHAT = {"size": "bytes", "rows": "rows", "columns": "columns", "line": "bytes in one line"}
_SMALL = 64 * 2**20  # bytes: below this no expansion hurts
_EXPANSION = 200  # sensor noise does not compress better than that


@dataclass(frozen=True)
class Limits:
    """What a file may hold; raise one where a file deserves it, lower it where files come from strangers."""

    size: int = 4 * 2**30
    """bytes on disk"""
    rows: int = 50_000_000
    columns: int = 256
    line: int = 64 * 2**10
    """bytes of text without a line break"""
    whole: int = 64 * 2**20
    """bytes on disk: `poise estimate` works on a larger file in chunks"""

    def check(self, where: str, limit: str, found: int) -> None:
        """Raises :class:`FormatError` where *found* is above the limit of that name."""
        allowed = getattr(self, limit)
        if found > allowed:
            raise FormatError(
                f"{where}: {found:,} {_WHAT[limit]}, the limit is {allowed:,}; if the file is in order, "
                f"raise it: --limit {limit}=…, in Python read(path, limits=Limits({limit}=…))"
            )


def check_expansion(where: str, packed: int, unpacked: int) -> None:
    """Raises :class:`FormatError` where *packed* bytes claim to unpack to more than sensor data can."""
    if unpacked > _SMALL and unpacked > _EXPANSION * max(packed, 1):
        raise FormatError(
            f"{where}: {packed:,} bytes claim to unpack to {unpacked:,}, which no sensor's samples do; "
            "this looks like a decompression bomb. If it is not, save the file uncompressed"
        )


@dataclass(frozen=True)
class Options:
    """What the caller says about a file that the file does not say itself."""

    columns: str | Sequence[str] | None = None
    units: Mapping[str, str] = field(default_factory=dict)
    delimiter: str | None = None
    decimal: str | None = None
    rate: float | None = None
    topic: str | None = None
    limits: Limits = Limits()
    as_is: bool = False
    """take units as they are stated, or SI, and ask the samples nothing: the doctor does that"""
