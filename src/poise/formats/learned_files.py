"""What was learned about a sensor, from files: its own JSON, or an attitude that poise wrote."""

from __future__ import annotations

import os
from pathlib import Path

from poise.data.learned import Learned
from poise.errors import FormatError, RecordingError
from poise.formats import recognise
from poise.formats.attitudes import read_attitude
from poise.formats.limits import Limits

_LARGEST = 2**20  # bytes of JSON; what poise writes is 5 kB


def read_learned(path: str | os.PathLike[str], *, limits: Limits | None = None) -> Learned:
    """What :func:`write` put into a JSON file, or what the attitude in a Parquet or CSV file came with.

    Raises :class:`FormatError` where there is nothing of the kind, or it is damaged.
    """
    where, path = str(path), Path(path)
    recognise.check(where, path, limits or Limits())
    head = b""
    if not path.is_dir():  # a ROS 2 bag
        with path.open("rb") as file:
            head = file.read(_LARGEST + 1)
    if not head.lstrip().startswith(b"{"):
        try:
            found = read_attitude(path, limits=limits).learned
        except FormatError as problem:
            raise FormatError(
                f"{where}: expected what poise learned (poise estimate --save-learned), or an attitude that it wrote: "
                f"{str(problem).removeprefix(f'{where}: ')}"
            ) from None
        if found is None:
            raise FormatError(
                f"{where}: an attitude without anything learned about its sensors; self-calibrating learns, and "
                "Parquet and CSV files keep it"
            )
        return found
    if len(head) > _LARGEST:
        raise FormatError(
            f"{where}: more than {_LARGEST:,} bytes of JSON; what poise writes as learned is a few thousand"
        )
    try:
        return Learned.of_json(head.decode("utf-8"))
    except UnicodeDecodeError:
        raise FormatError(f"{where}: not UTF-8 text; the file is damaged") from None
    except RecordingError as problem:
        raise FormatError(f"{where}: {problem}") from None
