"""`estimate` over a recording: a :class:`Stream` fed in blocks."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.data.attitude import COLUMNS, Attitude
from poise.data.learned import Learned, Learning
from poise.data.recording import Recording
from poise.errors import RecordingError
from poise.estimators.engine import Stream
from poise.estimators.loop import ROW_COLUMNS, WIDTH, pack
from poise.estimators.starting import every
from poise.estimators.wrapping import at_gravity

Floats = NDArray[np.float64]

_BLOCK = 2048  # rows of a recording at a time: their buffer stays in the processor's cache


def estimate(
    method: Any,
    recording: Recording,
    start: Attitude | ArrayLike | None = None,
    *,
    bias: ArrayLike = (0.0, 0.0, 0.0),
    guard: bool | None = True,
    rest_bias: bool = True,
    start_from: Learned | Attitude | None = None,
    slew: float | None = None,
    learning: float | None = None,
    progress: Callable[[int], None] | None = None,
) -> Attitude:
    """The attitude after every row of *recording*, in its order, by *method* (``TwoStage()``, ``AdaptiveGain()``, …).

    Arguments as for :class:`Stream`; *learning* (s) is how often what is known of the sensors by then is taken down, for
    ``attitude.learning``; *progress* is called with the number of rows done so far.
    Raises :class:`RecordingError` or :class:`MethodError` where the two cannot be used.
    """
    if not isinstance(recording, Recording):
        raise RecordingError(
            f"expected a Recording, found {type(recording).__name__}; see poise.read and poise.Recording"
        )
    method = at_gravity(method, recording.gravity)
    stream = Stream(method, start, bias=bias, guard=guard, rest_bias=rest_bias, start_from=start_from, slew=slew)
    return feed(stream, recording, learning=learning, progress=progress)


def estimate_chunks(method: Any, chunks: Iterable[Recording], **options: Any) -> Iterator[tuple[Recording, Attitude]]:
    """Each of the consecutive recordings *chunks* and its attitude: together, bit for bit, those of :func:`estimate`.

    For recordings that do not fit into memory; *options* are those of :class:`Stream`.
    """
    stream = None
    for recording in chunks:
        stream = stream or Stream(at_gravity(method, recording.gravity), **options)
        yield recording, feed(stream, recording)


def feed(
    stream: Stream,
    recording: Recording,
    block: int = _BLOCK,
    *,
    after: Callable[[slice, NDArray[np.uint32]], None] | None = None,
    learning: float | None = None,
    progress: Callable[[int], None] | None = None,
) -> Attitude:
    """What *stream* says about the next rows, *recording*, *block* at a time; *after* is told of each: rows, flags."""
    n = len(recording)
    cuts = frozenset() if learning is None else frozenset(every(learning, recording.time))
    times: list[float] = []
    found: list[tuple[list[str], Floats, Floats]] = []
    table, flags = np.empty((n, COLUMNS)), np.empty(n, np.uint32)
    columns = tuple(np.ascontiguousarray(getattr(recording, name)) for name in ROW_COLUMNS)
    buffer = np.empty((min(block, n), WIDTH))
    first = 0
    for last in sorted({*range(block, n, block), *cuts, n} - {0}):
        part = slice(first, last)
        first = last
        rows = buffer[: last - part.start]
        pack(rows, *(column[part] for column in columns))
        stream._see_mag(rows)
        stream._advance_into(rows, table[part], flags[part])
        if after is not None:
            after(part, flags[part])
        if last in cuts and (learned := stream.learned) is not None:
            times.append(float(recording.time[last - 1]))
            found.append(learned.numbers())
        if progress is not None:
            progress(last)
    provenance = replace(stream._provenance, source=recording.source, source_hash=recording.source_hash)
    last_known = stream.learned
    if last_known is not None:
        last_known = replace(last_known, source=recording.name)
    over_time = None if learning is None or last_known is None else Learning.of(times, found, last_known)
    return Attitude(recording.time.copy(), table, flags, stream._heading, "enu", provenance, last_known, over_time)
