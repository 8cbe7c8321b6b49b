"""How much of an attitude is one: rows that are not valid are written and drawn, but say nothing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from poise.data.attitude import Attitude

WORTH_SAYING = 0.9  # a smaller share of valid rows is pointed out


def validity(attitude: Attitude) -> dict[str, Any]:
    """The share of valid rows, and why others are not."""
    import numpy as np

    from poise.data.flags import why_invalid

    return {
        "valid": float(attitude.valid.mean()) if len(attitude) else float("nan"),
        "invalid_because": why_invalid(int(np.bitwise_or.reduce(attitude.flags))),
    }


def none_valid(results: Sequence[dict[str, Any]], key: str, done: str = "written") -> list[dict[str, str]]:
    """The files of which no row came out valid: what was made of them, under *key*, says so row by row, but is no attitude."""
    return [
        {
            "file": result["file"],
            "error": f"no row is valid: {result['invalid_because'] or 'there is none'}; "
            f"{result[key]} was {done} all the same, poise doctor shows what is wrong with the samples",
        }
        for result in results
        if not result["valid"] > 0
    ]
