"""MATLAB files (up to v7): read by a bounded child process, because damaged ones crash every reader in this one."""

from __future__ import annotations

from pathlib import Path

from poise.errors import FormatError
from poise.formats import arrays, bounded
from poise.formats.limits import Options
from poise.formats.table import Table

_SCRIPT = Path(__file__).with_name("mat_child.py")
_BASE = 512 * 2**20  # bytes of address space: the interpreter, numpy and scipy
_GROWTH = 40  # times the file's size: compressed doubles, their decompressed bytes and a copy
_MOST = 8 * 2**30  # bytes
_SECONDS = 4  # s, plus one for every 20 MB


def read(path: Path, options: Options) -> Table:
    """The table in a MATLAB file: imu_gyr, gyr, acc, …, time or sampling_rate, opt_quat.

    Raises :class:`FormatError` where it is damaged, hostile or not a recording.
    """
    where = str(path)
    size = path.stat().st_size
    try:
        found = bounded.arrays(
            where,
            _SCRIPT,
            [str(path.absolute())],
            memory=min(_BASE + _GROWTH * size, _MOST),
            seconds=_SECONDS + size // 20_000_000,
            limits=options.limits,
        )
    except bounded.ChildFailure as problem:
        advice = "save it again: save('name.mat', ..., '-v7')"
        raise FormatError(f"{where}: damaged MATLAB file ({problem}); {advice}") from None
    return arrays.to_table(where, "MATLAB v7 or older", found, options)
