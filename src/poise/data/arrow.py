"""Columns of numbers as an Arrow table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from poise.errors import RecordingError

if TYPE_CHECKING:
    import pyarrow


def table(columns: Mapping[str, NDArray[Any]]) -> pyarrow.Table:
    """An Arrow table of one-dimensional numpy *columns*; NaN stays NaN.

    From buffers: ``pyarrow.array`` imports pandas wherever it is installed, which costs more than a whole estimate.
    """
    import pyarrow

    return pyarrow.Table.from_arrays([_array(values) for values in columns.values()], names=list(columns))


def frame(columns: Mapping[str, NDArray[Any]], backend: str) -> Any:
    """A pandas or polars data frame of *columns*. Raises :class:`RecordingError` for another *backend*."""
    if backend == "pandas":
        import pandas

        return pandas.DataFrame(columns)
    if backend == "polars":
        import polars

        return polars.DataFrame(columns)
    raise RecordingError(f'backend {backend!r} not known; expected "pandas" or "polars"')


def _array(values: NDArray[Any]) -> Any:
    import pyarrow

    dense = np.ascontiguousarray(values)
    kind = pyarrow.from_numpy_dtype(dense.dtype)
    bits = np.packbits(dense, bitorder="little") if dense.dtype == bool else dense
    return pyarrow.Array.from_buffers(kind, len(dense), [None, pyarrow.py_buffer(bits.data)])


def floats(column: Any) -> NDArray[np.float64]:
    """A numeric Arrow array, whole or in chunks, as (n,) float64, null as NaN; time stamps as s since 1970.

    From buffers, for the reason above.
    """
    import pyarrow

    if pyarrow.types.is_timestamp(column.type):  # microseconds are exact as float64, nanoseconds are not
        micro = column.cast(pyarrow.timestamp("us", column.type.tz), safe=False)
        return np.asarray(floats(micro.cast(pyarrow.int64())) / 1e6)
    numbers = column.cast(pyarrow.float64(), safe=False)
    parts = []
    for chunk in getattr(numbers, "chunks", [numbers]):
        rows = slice(chunk.offset, chunk.offset + len(chunk))
        known, values = chunk.buffers()
        part = np.frombuffer(values, np.float64)[rows].copy() if len(chunk) else np.empty(0)
        if chunk.null_count:
            bits = np.unpackbits(np.frombuffer(known, np.uint8), bitorder="little")
            part[bits[rows] == 0] = np.nan
        parts.append(part)
    return np.concatenate(parts) if parts else np.empty(0)


def different(column: Any) -> set[str]:
    """The different values of an Arrow array of any type, as text without blanks around it; null is none."""
    found = (value for value in column.unique().to_pylist() if value is not None)
    return {(value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)).strip() for value in found}
