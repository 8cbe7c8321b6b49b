"""MATLAB files (up to v7): read by a bounded child process, because damaged ones crash every reader in this one."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from poise.errors import FormatError
from poise.formats import arrays, npz
from poise.formats.limits import Options
from poise.formats.table import Table

_CHILD = Path(__file__).with_name("mat_child.py")
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
    seconds = _SECONDS + size // 20_000_000
    memory = min(_BASE + _GROWTH * size, _MOST)
    with tempfile.TemporaryFile() as output:
        _run(where, [str(path.absolute()), str(memory), str(seconds)], output.fileno(), seconds)
        output.seek(0)
        found = npz.load(where, output, options.limits)
    return arrays.to_table(where, "MATLAB v7 or older", {name[2:]: array for name, array in found.items()}, options)


def _run(where: str, arguments: list[str], output: int, seconds: int) -> None:
    # One thread, because the stacks of a linear algebra library's pool count against the address space.
    quiet = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
    command = [sys.executable, "-P", "-B", str(_CHILD), *arguments]
    try:
        done = subprocess.run(
            command,
            check=False,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.PIPE,
            timeout=2 * seconds,
            env=quiet,
        )
    except subprocess.TimeoutExpired:
        raise FormatError(f"{where}: reading this MATLAB file took too long; it is damaged or hostile") from None
    if done.returncode:
        lines = done.stderr.decode("utf-8", "replace").strip().splitlines()
        reason = lines[-1][:200] if lines and done.returncode > 0 else "the reader crashed on it"
        raise FormatError(f"{where}: damaged MATLAB file ({reason}); save it again: save('name.mat', ..., '-v7')")
