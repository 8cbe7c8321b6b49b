"""A program that is run, with the alarm in its environment and, as JSON, on its standard input."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from poise.errors import ResponseError
from poise.responses.alarm import Alarm, Kind
from poise.responses.programs import run
from poise.responses.responder import Responder, Trouble


@dataclass(kw_only=True)
class Command(Responder):
    """Runs *argv*, without a shell; any exit code but 0, or none within *timeout*, is a failure."""

    argv: tuple[str, ...]
    timeout: float = 5.0

    kind: ClassVar[str] = "command"
    answers: ClassVar[frozenset[Kind]] = frozenset(("fired", "test"))
    acts: ClassVar[bool] = True

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.argv or not self.argv[0]:
            self.refuse("argv", 'a program and its arguments, such as ["systemctl", "stop", "motors"]', list(self.argv))

    def check(self) -> str:
        program = shutil.which(self.argv[0])
        if program is None:
            there = Path(self.argv[0]).exists()
            cure = "is no program that may be run: chmod +x" if there else "is not there: install it, or give its path"
            raise ResponseError(f"{self.name}.argv: {self.argv[0]} {cure}")
        return f"runs {program}"

    def open(self, trouble: Trouble) -> None:
        self.check()

    def fire(self, alarm: Alarm) -> None:
        told = {f"POISE_{key.upper()}": str(value) for key, value in alarm.as_dict().items() if value is not None}
        run(self.argv, self.timeout, stdin=alarm.as_json(), environment=told)
