"""Samples as text: JSON objects of one or many samples, and lines of numbers."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from poise.data.recording import samples
from poise.errors import RecordingError
from poise.live.frames import MOST_SAMPLES, UNNUMBERED, FrameError, check_number, widened

Floats = NDArray[np.float64]

_EXAMPLE = '{"time": 1.25, "gyr": [0, 0, 0], "acc": [0, 0, 9.81], "mag": [0, 20, -40]}'


def from_json(text: str | bytes) -> tuple[Floats, int]:
    """(n, 12) rows and the first one's sequence number from a JSON object.

    ``time``, ``gyr``, ``acc`` and, if you like, ``mag`` hold one sample or a list of them each; ``sequence`` numbers the
    first. Raises :class:`FrameError` for anything else.
    """
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        raise FrameError(f"not JSON: {text[:60]!r}; expected {_EXAMPLE}") from None
    if not isinstance(found, dict) or not {"time", "gyr", "acc"} <= found.keys():
        raise FrameError(f"expected an object like {_EXAMPLE}")
    one = not isinstance(found["time"], list)
    values = {name: found.get(name) for name in ("time", "gyr", "acc", "mag")}
    if one:
        values = {name: None if value is None else [value] for name, value in values.items()}
    sequence = found.get("sequence", UNNUMBERED)
    if not isinstance(sequence, int):
        raise FrameError(f"sequence: expected a whole number from 0 on, found {sequence!r}")
    check_number(sequence)
    return rows_of(values), sequence


def note(text: str) -> str | None:
    """What a device has to say for people: the text of ``{"type": "note", "text": "…"}``; None: something else."""
    if not text.startswith('{"type"'):
        return None
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return None
    said = found.get("text") if found.get("type") == "note" else None
    return " ".join(said.split())[:200] if isinstance(said, str) else None


def rows_of(values: dict[str, Any]) -> Floats:
    """(n, 12) rows of ``time`` (n,), ``gyr``, ``acc`` and ``mag`` (n, 3). Raises :class:`FrameError`."""
    try:
        many = samples(*(values[name] for name in ("time", "gyr", "acc", "mag")))
    except (RecordingError, OverflowError) as problem:
        raise FrameError(str(problem)) from None
    if not 0 < len(many["time"]) <= MOST_SAMPLES:
        raise FrameError(f"expected 1 to {MOST_SAMPLES} samples, found {len(many['time'])}")
    return widened(np.column_stack([many["time"], many["gyr"], many["acc"], many["mag"]]))
