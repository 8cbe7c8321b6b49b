"""Proving the chain before it is trusted: every responder checked, and fired once as a test."""

from __future__ import annotations

from dataclasses import dataclass

from poise.errors import ResponseError
from poise.responses.alarm import Alarm, no_event, now_utc
from poise.responses.config import Config
from poise.responses.responder import Responder


@dataclass(frozen=True)
class Tried:
    """What became of one responder."""

    responder: str
    kind: str
    found: str
    """what its check found"""
    fired: bool
    """it was fired as a test"""
    problem: str | None
    """why it cannot be relied on"""


def try_out(config: Config, test: bool = False, fire: bool = False) -> list[Tried]:
    """Check every responder; with *test* fire those that tell somebody, with *fire* those that move something too."""
    return [_tried(each, config.name, test and (fire or not each.acts)) for each in config.responders]


def _tried(responder: Responder, robot: str, fire: bool) -> Tried:
    found, fired, problem = "", False, None
    try:
        found = responder.check()
        if fire:
            try:
                responder.open(lambda why: None)
                responder.fire(Alarm("test", no_event(), now_utc(), robot=robot))
                fired = True
            finally:
                responder.close()
    except ResponseError as error:
        problem = str(error)
    except Exception as error:  # a driver's own; to be shown like the others
        problem = f"{responder.name}: {type(error).__name__}: {error}"
    return Tried(responder.name, responder.kind, found, fired, problem)
