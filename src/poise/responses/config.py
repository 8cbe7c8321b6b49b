"""The configuration: one TOML file, checked whole before anything is opened."""

from __future__ import annotations

import difflib
import math
import os
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import MISSING, dataclass, fields
from pathlib import Path
from typing import Any, Literal, get_args, get_origin, get_type_hints

from poise.data.event import TipState
from poise.errors import ResponseError
from poise.responses.alarm import named
from poise.responses.command import Command
from poise.responses.log import Log
from poise.responses.mqtt import Mqtt
from poise.responses.relay import Relay
from poise.responses.responder import Responder
from poise.responses.staging import START, Stage, Unknown
from poise.responses.voice import Voice
from poise.responses.webhook import Webhook

RESPONDERS: dict[str, type[Responder]] = {each.kind: each for each in (Relay, Command, Voice, Mqtt, Webhook, Log)}
_TOP = ("name", "unknown", "unknown_after", "responders", "stages", "tipover")
_STAGE = ("name", "state", "fire", "repeat", "latched", "after")
_LARGEST = 2**20  # bytes


@dataclass(frozen=True, kw_only=True)
class Config:
    """Who is there to respond, and when; checked, and nothing opened."""

    responders: tuple[Responder, ...]
    stages: tuple[Stage, ...]
    name: str = ""
    """of the robot, said in every message"""
    unknown: Unknown = "warn"
    unknown_after: float = 0.0
    tipover: Mapping[str, Any] | None = None
    """the table of the tip-over monitor's own parameters, as it stands in the file"""


def load_config(path: str | os.PathLike[str]) -> Config:
    """The configuration in a TOML file; :class:`ResponseError` names the file and the key, and what is near to it."""
    where = Path(path)
    try:
        if where.stat().st_size > _LARGEST:
            raise ResponseError("is larger than any configuration")
        found = tomllib.loads(where.read_text(encoding="utf-8"))
        return config_of(found, where.parent)
    except OSError as problem:
        raise ResponseError(f"{where}: cannot be read: {problem.strerror or problem}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as problem:
        raise ResponseError(f"{where}: is no TOML: {problem}") from None
    except ResponseError as problem:
        raise ResponseError(f"{where}: {problem}") from None


def config_of(found: Mapping[str, Any], folder: Path = Path()) -> Config:
    """The configuration in parsed TOML; files in it are below *folder*."""
    _known("", found, _TOP)
    responders = _responders(found.get("responders"), folder)
    if not any(each.kind == "log" for each in responders):  # what fails must be said somewhere
        responders = (*responders, Log(name="logging"))
    names = [each.name for each in responders]
    for each in responders:
        for other in each.if_failed:
            _one_of(f"responders.{each.name}.if_failed", other, names)
            if other == each.name:
                raise ResponseError(f"responders.{each.name}.if_failed: {other!r} is itself; name another one")
    stages = _stages(found.get("stages"), {each.name: each for each in responders})
    _all_used(responders, stages)
    unknown = found.get("unknown", "warn")
    _one_of("unknown", unknown, get_args(Unknown))
    if unknown == "as tipping" and not any(TipState.TIPPING in stage.states for stage in stages):
        raise ResponseError('unknown: "as tipping" fires the stages of tipping, and there are none')
    return Config(
        responders=responders,
        stages=stages,
        name=_of_kind("name", found.get("name", ""), str),
        unknown=unknown,
        unknown_after=_seconds("unknown_after", found.get("unknown_after", 0.0)),
        tipover=found.get("tipover"),
    )


def _responders(tables: Any, folder: Path) -> tuple[Responder, ...]:
    if not isinstance(tables, Mapping) or not tables or not all(isinstance(t, Mapping) for t in tables.values()):
        raise ResponseError('responders: expected at least one table such as [responders.horn] type = "voice"')
    return tuple(_responder(name, table, folder) for name, table in tables.items())


def _responder(name: str, table: Mapping[str, Any], folder: Path) -> Responder:
    where = f"responders.{name}"
    if "type" not in table:
        raise ResponseError(f"{where}.type: is missing; expected one of {', '.join(RESPONDERS)}")
    _one_of(f"{where}.type", table["type"], RESPONDERS)
    cls = RESPONDERS[table["type"]]
    options = {each.name: each for each in fields(cls) if each.name != "name"}
    _known(where, table, ("type", *options))
    hints = get_type_hints(cls)
    given = {key: _of_kind(f"{where}.{key}", value, hints[key]) for key, value in table.items() if key != "type"}
    for key, option in options.items():
        if key not in given and option.default is MISSING and option.default_factory is MISSING:
            raise ResponseError(f"{where}.{key}: is missing; {_needed(cls, key)}")
    given = {key: folder / value if isinstance(value, Path) else value for key, value in given.items()}
    try:
        return cls(name=name, **given)
    except ResponseError as problem:
        raise ResponseError(f"responders.{problem}") from None


def _needed(cls: type[Responder], key: str) -> str:
    if (cls.kind, key) == ("relay", "active_high"):
        return "true where a high pin cuts the power, false where a low one does"
    return f"a {cls.kind} needs it"


def _stages(tables: Any, responders: Mapping[str, Responder]) -> tuple[Stage, ...]:
    if not isinstance(tables, list) or not tables or not all(isinstance(table, Mapping) for table in tables):
        raise ResponseError('stages: expected at least one table such as [[stages]] state = "tipping" fire = ["horn"]')
    stages: list[Stage] = []
    for number, table in enumerate(tables, 1):
        stage = _stage(f"stages, number {number}", table, responders)
        if stage.name in ["unknown", START, *(other.name for other in stages)]:
            raise ResponseError(
                f"stages, number {number}.name: {stage.name!r} is the name of another; give each its own"
            )
        stages.append(stage)
    return tuple(stages)


def _stage(where: str, table: Mapping[str, Any], responders: Mapping[str, Responder]) -> Stage:
    _known(where, table, _STAGE)
    texts = table.get("state")
    states = frozenset(_state(f"{where}.state", text) for text in ([texts] if isinstance(texts, str) else texts or ()))
    fire = _of_kind(f"{where}.fire", table.get("fire", []), tuple[str, ...])
    if not states or not fire:
        raise ResponseError(f'{where}: expected state = "tipping" (one or a list) and fire = [names of responders]')
    for name in fire:
        _one_of(f"{where}.fire", name, responders)
    if TipState.UPRIGHT in states and (cuts := [n for n in fire if responders[n].kind == "relay"]):
        raise ResponseError(
            f"{where}: {cuts[0]} would cut the power of a robot that stands upright; take one of them out"
        )
    default = " or ".join(named(state) for state in sorted(states))
    return Stage(
        name=_of_kind(f"{where}.name", table.get("name", default), str),
        states=states,
        fire=tuple(dict.fromkeys(fire)),
        repeat=_seconds(f"{where}.repeat", table.get("repeat", 0.0)),
        latched=_of_kind(f"{where}.latched", table.get("latched", True), bool),
        after=_seconds(f"{where}.after", table.get("after", 0.0)),
    )


def _state(where: str, text: Any) -> TipState:
    name = text.replace("_", " ").replace("-", " ") if isinstance(text, str) else text
    if name == "unknown":
        raise ResponseError(
            f'{where}: what an unknown attitude means is said once: unknown = "warn" at the top of the file'
        )
    _one_of(where, name, [named(state) for state in TipState if state != TipState.UNKNOWN])
    return TipState[name.upper().replace(" ", "_")]


def _all_used(responders: Iterable[Responder], stages: Iterable[Stage]) -> None:
    used = {name for stage in stages for name in stage.fire} | {name for r in responders for name in r.if_failed}
    for each in responders:
        if each.name not in used and each.kind != "log":
            raise ResponseError(f"responders.{each.name}: no stage fires it; name it in a stage's fire, or take it out")


def _known(where: str, table: Mapping[str, Any], names: Iterable[str]) -> None:
    for key in table:
        _one_of(where, key, names)


def _one_of(where: str, value: Any, names: Iterable[str]) -> None:
    known = list(names)
    if value in known:
        return
    near = difflib.get_close_matches(str(value), known, 1)
    hint = f"did you mean {near[0]!r}?" if near else f"expected one of {', '.join(map(repr, known))}"
    raise ResponseError(f"{where}: {value!r} is not known; {hint}" if where else f"{value!r} is not known; {hint}")


def _seconds(where: str, value: Any) -> float:
    seconds: float = _of_kind(where, value, float)
    if not 0.0 <= seconds <= 86400.0:
        raise ResponseError(f"{where}: expected seconds, 0 or more, found {value!r}")
    return seconds


def _of_kind(where: str, value: Any, kind: Any) -> Any:
    """*value* as its declaration wants it; TOML has no paths and no tuples."""
    if get_origin(kind) is Literal:
        _one_of(where, value, get_args(kind))
        return value
    texts = isinstance(value, (list, dict)) and all(
        isinstance(each, str) for each in (value.values() if isinstance(value, dict) else value)
    )
    number = isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
    for wanted, fits, made in (
        (bool, isinstance(value, bool), lambda: value),
        (str, isinstance(value, str), lambda: value),
        (int, number and isinstance(value, int), lambda: value),
        (float, number, lambda: float(value)),
        (Path, isinstance(value, str) and bool(value), lambda: Path(value)),
        (tuple[str, ...], texts and isinstance(value, list), lambda: tuple(value)),
        (dict[str, str], texts and isinstance(value, dict), lambda: dict(value)),
    ):
        if fits and (kind == wanted or wanted in get_args(kind)):
            return made()
    expected = {
        bool: "true or false", str: "a text", int: "a whole number", float: "a number", Path: "the name of a file",
        tuple[str, ...]: 'a list of texts such as ["a", "b"]', dict[str, str]: "a table of texts",
    }  # fmt: skip
    kinds = [kind] if kind in expected else [each for each in get_args(kind) if each in expected]
    raise ResponseError(f"{where}: expected {' or '.join(expected[each] for each in kinds)}, found {value!r}")
