"""Running a program within a time, with an error that says why it failed."""

from __future__ import annotations

import os
import signal
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

from poise.errors import ResponseError


def run(
    argv: Sequence[str],
    timeout: float,
    stdin: str = "",
    environment: dict[str, str] | None = None,
    started: Callable[[subprocess.Popen[Any]], None] = lambda process: None,
) -> str:
    """What *argv* said on stderr, once it has ended well; raises :class:`ResponseError` where it did not.

    When the time is up it is killed, with all that it started. *started* is given the running process.
    """
    # a file, not a pipe: what the program leaves behind in the background may hold a pipe open
    with tempfile.TemporaryFile() as said:
        try:
            process = subprocess.Popen(
                argv,
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=said,
                env={**os.environ, **(environment or {})},
                start_new_session=True,
            )
        except (OSError, ValueError) as problem:
            raise ResponseError(f"{argv[0]} cannot be run: {problem}") from None
        try:
            started(process)
            process.communicate(stdin.encode("utf-8"), timeout=timeout)
        except subprocess.TimeoutExpired:
            raise ResponseError(f"{argv[0]} was still running after {timeout:g} s; it was killed") from None
        finally:
            if process.poll() is None:
                kill(process)
                process.wait()
        said.seek(0)
        text = said.read(2**16).decode("utf-8", "replace").strip()
    if process.returncode != 0:
        last = text.splitlines()[-1][:200] if text else "it said nothing on stderr"
        raise ResponseError(f"{argv[0]} ended with code {process.returncode}: {last}")
    return text


def kill(process: subprocess.Popen[Any]) -> None:
    """End *process* and all that it started."""
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
