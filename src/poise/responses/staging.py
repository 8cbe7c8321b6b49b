"""Which stage fires, repeats and ends when: decided from events and a clock, without threads."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal

from poise.data.event import TipEvent, TipState

Unknown = Literal["ignore", "warn", "as tipping"]
_CALM = frozenset([TipState.UPRIGHT, TipState.RIGHTED])
_NOTHING = TipEvent(math.nan, TipState.UNKNOWN, TipState.UNKNOWN)
_NOT_YET = TipEvent(math.nan, TipState.UNKNOWN, TipState.UNKNOWN, reason="no attitude since the start")
_PATIENCE = 3.0  # s that the first attitude is waited for: a method is loaded in half of that
START = "start"
"""the stage of what holds from the start on"""


@dataclass(frozen=True, kw_only=True)
class Stage:
    """The responders that some states fire."""

    name: str
    states: frozenset[TipState]
    fire: tuple[str, ...]
    repeat: float = 0.0
    """s from one firing to the next while it holds; 0: once"""
    latched: bool = True
    """holds until it is acknowledged, and not only until the body is upright again"""
    after: float = 0.0
    """s that one of the states must last"""


@dataclass(frozen=True)
class Step:
    """What is to be done now."""

    what: Literal["fired", "released"]
    stage: Stage
    event: TipEvent
    count: int


@dataclass
class _Memory:
    event: TipEvent
    inside: bool = False
    since: float = 0.0  # s, inside without a break
    first: float = math.inf  # s, when it fires
    again: float = math.inf  # s, when it fires anew
    count: int = 0
    active: bool = False  # has fired and was not released
    acknowledged: bool = False


@dataclass
class Staging:
    """The stages and where they stand; *now* is any clock in seconds that does not go back.

    A state fires its stages when it comes, each time. A stage that is not latched ends when the body is upright: neither
    another dangerous state nor ``UNKNOWN`` ends it. A latched one ends when it has been acknowledged *and* the body stands.
    From :meth:`begin` on the state is unknown, until the first event.
    """

    stages: tuple[Stage, ...]
    unknown: Unknown = "warn"
    unknown_after: float = 0.0
    warned: tuple[str, ...] = ()
    """who is told of an unknown attitude where the policy is ``warn``"""
    at_start: tuple[str, ...] = ()
    """who has fired from the start on, until the body is first upright"""
    state: TipState | None = None
    event: TipEvent = _NOTHING
    _memories: list[_Memory] = field(default_factory=list)

    def __post_init__(self) -> None:
        if self.unknown == "warn" and self.warned:
            warning = Stage(name="unknown", states=frozenset([TipState.UNKNOWN]), fire=self.warned, latched=False)
            self.stages = (*self.stages, warning)
        if self.at_start:
            self.stages = (*self.stages, Stage(name=START, states=frozenset(), fire=self.at_start, latched=False))
        self._memories = [_Memory(_NOTHING) for _ in self.stages]

    def begin(self, now: float) -> None:
        """Nothing is known yet. That nothing comes at all is told after 3 s, for an attitude takes a moment."""
        for stage, memory in zip(self.stages, self._memories, strict=True):
            if self._belongs(stage, TipState.UNKNOWN):
                memory.inside, memory.since, memory.event = True, now, _NOT_YET
                memory.first = now + max(stage.after + self.unknown_after, _PATIENCE)
            memory.active = stage.name == START

    def handle(self, event: TipEvent, now: float) -> list[Step]:
        """What *event* makes due; nothing where the state is the one that held."""
        if event.state == self.state:
            return []
        self.state, self.event = event.state, event
        steps: list[Step] = []
        for stage, memory in zip(self.stages, self._memories, strict=True):
            if self._belongs(stage, event.state):
                if not memory.inside:
                    memory.inside, memory.since = True, now
                wait = stage.after + (self.unknown_after if event.state == TipState.UNKNOWN else 0.0)
                memory.event, memory.first = event, max(now, memory.since + wait)
            elif event.state != TipState.UNKNOWN:  # what is unknown ends nothing, and calls nothing off
                memory.inside, memory.first = False, math.inf
                if not stage.latched:
                    memory.again = math.inf
                steps += self._ended(stage, memory)
        return steps + self.due(now)

    def due(self, now: float) -> list[Step]:
        """What fires by *now*."""
        steps = []
        for stage, memory in zip(self.stages, self._memories, strict=True):
            if memory.first <= now:
                memory.count, memory.active, memory.acknowledged, memory.first = 1, True, False, math.inf
            elif memory.again <= now:
                memory.count += 1
            else:
                continue
            memory.again = now + stage.repeat if stage.repeat else math.inf
            steps.append(Step("fired", stage, memory.event, memory.count))
        return steps

    def next_due(self) -> float:
        """When :meth:`due` has something to say, if nothing happens before; ``inf`` for never."""
        return min((min(memory.first, memory.again) for memory in self._memories), default=math.inf)

    def acknowledge(self) -> list[Step]:
        """End the repetitions of what has fired, and release what holds no more."""
        steps: list[Step] = []
        for stage, memory in zip(self.stages, self._memories, strict=True):
            if memory.active:
                memory.acknowledged, memory.again = True, math.inf
                steps += self._ended(stage, memory)
        return steps

    def active(self) -> tuple[str, ...]:
        """The names of the stages that have fired and were not released."""
        return tuple(s.name for s, memory in zip(self.stages, self._memories, strict=True) if memory.active)

    def unacknowledged(self) -> tuple[str, ...]:
        """The names of those that do not end before :meth:`acknowledge`, whatever the body does."""
        both = zip(self.stages, self._memories, strict=True)
        return tuple(s.name for s, memory in both if memory.active and not memory.acknowledged and _waits(s))

    def _belongs(self, stage: Stage, state: TipState) -> bool:
        if state == TipState.UNKNOWN and self.unknown == "as tipping":
            state = TipState.TIPPING
        return state in stage.states

    def _ended(self, stage: Stage, memory: _Memory) -> list[Step]:
        if not memory.active or not self._over(stage, memory):
            return []
        memory.active, memory.again = False, math.inf
        return (
            [] if _calm(stage) else [Step("released", stage, self.event, memory.count)]
        )  # good news needs no all-clear

    def _over(self, stage: Stage, memory: _Memory) -> bool:
        if memory.inside:
            return False
        if _passes(stage):
            return True
        if memory.acknowledged:
            return self.state in _CALM
        return not stage.latched and self.state == TipState.UPRIGHT


def _calm(stage: Stage) -> bool:
    return bool(stage.states) and stage.states <= _CALM


def _passes(stage: Stage) -> bool:
    """Whether it ends with its states, though it is latched: good news, and that nothing is known."""
    return _calm(stage) or stage.states == {TipState.UNKNOWN}


def _waits(stage: Stage) -> bool:
    """Whether a person has to say that it was seen."""
    return stage.latched and not _passes(stage)
