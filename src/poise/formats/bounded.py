"""Numbers from a file whose library cannot be trusted with it: read by a child process with limits on memory and time."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from poise.formats import npz
from poise.formats.limits import Limits

CHILD = Path(__file__).with_name("bounded_child.py")


class ChildFailure(Exception):
    """Why the child gave up: one line."""


def arrays(
    where: str, script: Path, arguments: list[str], *, memory: int, seconds: int, limits: Limits
) -> dict[str, NDArray[Any]]:
    """What ``load(*arguments)`` of *script* returns: named numeric and text arrays.

    *memory* is address space in bytes, *seconds* processor time; twice that long is waited. Raises
    :class:`ChildFailure`; and :class:`FormatError` where the arrays themselves are above the *limits*.
    """
    with tempfile.TemporaryFile() as output, tempfile.TemporaryDirectory() as scratch:
        # One thread, because the stacks of a linear algebra library's pool count against the address space.
        quiet = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1", "TMPDIR": scratch}
        command = [sys.executable, "-P", "-B", str(CHILD), str(script), str(memory), str(seconds), *arguments]
        try:
            done = subprocess.run(
                command,
                check=False,
                stdin=subprocess.DEVNULL,
                stdout=output.fileno(),
                stderr=subprocess.PIPE,
                timeout=2 * seconds,
                env={**os.environ, **quiet},
            )
        except subprocess.TimeoutExpired:
            raise ChildFailure("it took too long") from None
        if done.returncode:
            lines = done.stderr.decode("utf-8", "replace").strip().splitlines()
            raise ChildFailure(lines[-1][:300] if lines and done.returncode > 0 else "the reader crashed on it")
        output.seek(0)
        found = npz.load(where, output, limits)
    return {name[2:]: array for name, array in found.items()}
