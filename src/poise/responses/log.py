"""A log that is on the disk before anything else is said: one JSON line per event, response, failure and test."""

from __future__ import annotations

import logging
import os
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, ClassVar

from poise.errors import ResponseError
from poise.responses.alarm import Alarm, Kind
from poise.responses.responder import Responder, Trouble

LOGGER = logging.getLogger("poise.responses")
_LEVELS: dict[Kind, int] = {"fired": logging.WARNING, "failure": logging.ERROR, "test": logging.WARNING}


@dataclass(kw_only=True)
class Log(Responder):
    """Appends to *file*, or says it to Python's ``logging`` under ``poise.responses`` where there is none.

    Written whatever happens, in stages or not.
    """

    file: Path | None = None

    kind: ClassVar[str] = "log"
    answers: ClassVar[frozenset[Kind]] = frozenset(
        ("fired", "released", "failure", "recovered", "acknowledged", "event", "started", "closed", "test")
    )

    def check(self) -> str:
        if self.file is None:
            return "Python's logging, as poise.responses"
        existed = self.file.exists()
        try:
            with self.file.open("ab"):
                pass
            if not existed:
                self.file.unlink()
        except OSError as problem:
            raise ResponseError(
                f"{self.name}.file: {self.file} cannot be written: {problem.strerror or problem}; name a file in a "
                "folder that exists and may be written to"
            ) from None
        return f"appends to {self.file}"

    def open(self, trouble: Trouble) -> None:
        self.check()
        self._stream: BinaryIO | None = None
        if self.file is not None:
            self._stream = self.file.open("ab")
            if self.file.stat().st_size and not _ends_a_line(self.file):  # a power cut in the middle of a line
                self._stream.write(b"\n")

    def fire(self, alarm: Alarm) -> None:
        if self.file is None:
            LOGGER.log(_LEVELS.get(alarm.kind, logging.INFO), "%s", alarm.sentence())
            return
        assert self._stream is not None
        try:
            self._stream.write(alarm.as_json().encode("utf-8") + b"\n")
            self._stream.flush()
            os.fsync(self._stream.fileno())
        except OSError as problem:
            raise ResponseError(f"{self.file} cannot be written: {problem.strerror or problem}") from None

    def close(self) -> None:
        stream = getattr(self, "_stream", None)
        if stream is not None:
            try:
                stream.close()
            except OSError as problem:
                LOGGER.error("%s: %s", self.file, problem)


def _ends_a_line(path: Path) -> bool:
    with path.open("rb") as file:
        file.seek(-1, os.SEEK_END)
        return file.read(1) == b"\n"
