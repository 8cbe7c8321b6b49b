"""One file to one recording: recognise, read, make sure of the units."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from poise.data.recording import Recording
from poise.errors import FormatError, RecordingError
from poise.formats import bag, mat, npz, parquet, recognise, text
from poise.formats.assemble import Sniffed, assemble
from poise.formats.limits import Limits, Options

_DEFAULT = Limits()
_READERS = {"text": text.read, "parquet": parquet.read, "npz": npz.read, "mat": mat.read} | dict.fromkeys(
    bag.KINDS, bag.read
)


def read(
    path: str | os.PathLike[str],
    *,
    columns: str | Sequence[str] | None = None,
    units: Mapping[str, str] | None = None,
    delimiter: str | None = None,
    decimal: str | None = None,
    rate: float | None = None,
    topic: str | None = None,
    limits: Limits = _DEFAULT,
) -> Recording:
    """The recording in a file: a text table, Parquet, npz, MATLAB or ROS bag, recognised by its content.

    *columns* names the columns where the file does not, in order (``"time,gx,gy,gz,ax,ay,az"``, ``-`` skips one) or
    one by one (``"their_name=gyr_x"``); *units* says what the file does not (``{"gyr": "deg/s", "acc": "g"}``); *rate*
    (1/s) replaces the stamps; *topic* picks a bag's inertial unit, or both (``"/imu/data_raw,/imu/mag"``). Everything
    that was assumed or left out is in ``Recording.notes``.

    Raises :class:`FormatError` with the line, the column and what to do.
    """
    return _load(path, Options(columns, dict(units or {}), delimiter, decimal, rate, topic, limits))[0]


def sniff(
    path: str | os.PathLike[str],
    *,
    columns: str | Sequence[str] | None = None,
    units: Mapping[str, str] | None = None,
    delimiter: str | None = None,
    decimal: str | None = None,
    rate: float | None = None,
    topic: str | None = None,
    limits: Limits = _DEFAULT,
) -> Sniffed:
    """What :func:`read` recognises in a file, with the same options and errors: rate, gaps, units, columns, doubts."""
    return _load(path, Options(columns, dict(units or {}), delimiter, decimal, rate, topic, limits))[1]


def examine(
    path: str | os.PathLike[str],
    *,
    columns: str | Sequence[str] | None = None,
    units: Mapping[str, str] | None = None,
    delimiter: str | None = None,
    decimal: str | None = None,
    rate: float | None = None,
    topic: str | None = None,
    limits: Limits = _DEFAULT,
    as_is: bool = False,
) -> tuple[Recording, Sniffed]:
    """What :func:`read` and :func:`sniff` give, in one go.

    With *as_is* no unit is asked of the samples, and none refused for them: those that the file or *units* states are
    taken, SI where none does, so that what is wrong can be found out afterwards.
    """
    return _load(path, Options(columns, dict(units or {}), delimiter, decimal, rate, topic, limits, as_is))


def _load(path: str | os.PathLike[str], options: Options) -> tuple[Recording, Sniffed]:
    source = str(path)
    path = Path(path)
    recognise.check(source, path, options.limits)
    reader = _READERS[recognise.kind(source, path)]
    try:
        table = reader(path, options)
        digest = _digest(path)
        with np.errstate(all="ignore"):  # infinite samples and stamps are the guard's business, later
            return assemble(path, table, options, source, digest)
    except RecordingError as problem:
        raise FormatError(f"{source}: {problem}") from None
    except OSError as problem:
        raise FormatError(f"{source}: cannot be read: {problem.strerror or problem}") from None
    except MemoryError:
        raise FormatError(f"{source}: does not fit into memory; split it") from None


def _digest(path: Path) -> str:
    """SHA-256 of a file, or of a bag's files one after the other."""
    digest = hashlib.sha256()
    for part in recognise.files(path):
        with part.open("rb") as file:
            hashlib.file_digest(file, lambda: digest)
    return digest.hexdigest()
