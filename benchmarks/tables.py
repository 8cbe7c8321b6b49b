"""Tables of figures, as plain text or Markdown."""

from __future__ import annotations

from collections.abc import Sequence

Cell = str | float | int | None


def table(columns: Sequence[str], rows: Sequence[Sequence[Cell]], *, markdown: bool = False, digits: int = 3) -> str:
    """The rows under their columns: the first column to the left, all others to the right."""
    lines = [list(columns), *([_text(cell, digits) for cell in row] for row in rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(columns))]
    padded = [[line[0].ljust(widths[0]), *map(str.rjust, line[1:], widths[1:])] for line in lines]
    if not markdown:
        return "\n".join("  ".join(line).rstrip() for line in padded)
    rule = ["-" * w if i == 0 else "-" * (w - 1) + ":" for i, w in enumerate(widths)]
    return "\n".join(f"| {' | '.join(line)} |" for line in [padded[0], rule, *padded[1:]])


def heading(text: str, *, markdown: bool = False) -> str:
    """A line above a table."""
    return f"\n### {text}\n" if markdown else f"\n{text}"


def _text(cell: Cell, digits: int) -> str:
    if cell is None:
        return "-"
    return f"{cell:.{digits}f}" if isinstance(cell, float) else str(cell)
