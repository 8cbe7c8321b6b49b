"""The shape of every responder, and what several of them need."""

from __future__ import annotations

import os
import re
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from poise.errors import ResponseError
from poise.responses.alarm import Alarm, Kind

Trouble = Callable[[str | None], None]


@dataclass(kw_only=True)
class Responder(ABC):
    """One way to answer a tipping robot; its fields are the keys of its table in the configuration.

    ``check`` and ``open`` raise :class:`ResponseError` with what to install or to change; so does ``fire`` where it could
    not do what it was asked, and it is never called twice at a time.
    """

    name: str = ""
    timeout: float = 5.0
    """s; one that takes longer has failed"""
    if_failed: tuple[str, ...] = ()
    """the responders to try, one after the other, when this one fails"""

    kind: ClassVar[str]
    answers: ClassVar[frozenset[Kind]]
    """the kinds of alarms that it does something about"""
    acts: ClassVar[bool] = False
    """moves something, where others tell somebody"""
    immediate: ClassVar[bool] = False
    """takes microseconds: fired before all others, by the thread that judged"""

    def __post_init__(self) -> None:
        if not 0.0 < self.timeout <= 60.0:
            self.refuse("timeout", "seconds above 0, 60 at most", self.timeout)

    @abstractmethod
    def check(self) -> str:
        """What it found of all that it needs, in a few words; moves nothing, tells nobody."""

    @property
    def fired_at_start(self) -> bool:
        """It is as if fired from :meth:`open` on, until it is released."""
        return False

    def open(self, trouble: Trouble) -> None:  # noqa: B027
        """Get ready to fire. *trouble* is called with what broke in between, with None when it works again."""

    @abstractmethod
    def fire(self, alarm: Alarm) -> None:
        """Do what it is there for."""

    def interrupt(self, alarm: Alarm) -> None:  # noqa: B027
        """Break off the telling of *alarm*, if it is that which is being told; called from another thread."""

    def close(self) -> None:  # noqa: B027
        """Let go of everything; never raises."""

    def refuse(self, key: str, expected: str, found: object) -> None:
        """Raise what a value of the wrong kind deserves."""
        raise ResponseError(f"{self.name or self.kind}.{key}: expected {expected}, found {found!r}")


def filled_in(text: str, where: str) -> str:
    """*text* with every ``${NAME}`` from the environment, so that secrets stay out of the file."""

    def value(found: re.Match[str]) -> str:
        name = found[1]
        if name not in os.environ:
            raise ResponseError(f"{where}: the environment has no {name}; set it, or write the value itself")
        return os.environ[name]

    return re.sub(r"\$\{(\w+)\}", value, text)
