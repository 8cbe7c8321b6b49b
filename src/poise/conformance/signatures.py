"""What the parameters of a stranger's function mean, by their names."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Sequence
from typing import Any, Literal

from poise.errors import MethodError

Meaning = str
"""time, gyr, acc, mag, dt, rate or state; gyr.x … mag.z for one axis each"""

SHAPES = (
    "expected f(time, gyr, acc, mag) -> (n, 4), names as here, mag optional, dt or rate instead of time; a class or a factory "
    "of an object with update(gyr, acc, mag); or a step f(q, gyr, acc, mag, dt) -> q"
)

_EXACT: dict[str, Meaning] = {
    **dict.fromkeys(("t", "ts", "secs", "seconds", "stamps"), "time"),
    **dict.fromkeys(("w", "omega", "ang_vel", "rates"), "gyr"),
    **dict.fromkeys(("a", "f", "specific_force"), "acc"),
    **dict.fromkeys(("m", "b", "field"), "mag"),
    **dict.fromkeys(("dt", "delta_t", "deltat", "h", "gyrts", "sampleperiod", "sample_time"), "dt"),
    **dict.fromkeys(("fs", "hz", "rate", "freq"), "rate"),
    **dict.fromkeys(("q", "q0", "q_prev", "state"), "state"),
}
_PREFIXES: tuple[tuple[str, Meaning], ...] = (
    ("gyr", "gyr"), ("omega", "gyr"), ("angular", "gyr"), ("acc", "acc"), ("mag", "mag"), ("time", "time"),
    ("stamp", "time"), ("quat", "state"), ("freq", "rate"),
)  # fmt: skip
_SUFFIXES: tuple[tuple[str, Meaning], ...] = (
    ("_rate", "rate"), ("_freq", "rate"), ("_hz", "rate"), ("period", "dt"), ("_dt", "dt"), ("_mag", "mag"),
)  # fmt: skip
_AXIS = re.compile(r"(g|gyr|gyro|w|a|acc|accel|m|mag)_?([xyz])")
_SENSOR = {"g": "gyr", "w": "gyr", "a": "acc", "m": "mag"}


def meaning(name: str) -> Meaning | None:
    """What a parameter called *name* asks for; None where the name says nothing."""
    name = name.lower().lstrip("_")
    if axis := _AXIS.fullmatch(name):
        return f"{_SENSOR[axis[1][0]]}.{axis[2]}"
    if name in _EXACT:
        return _EXACT[name]
    for part, found in _SUFFIXES:
        if name.endswith(part):
            return found
    return next((found for part, found in _PREFIXES if name.startswith(part)), None)


def parameters(thing: Callable[..., Any]) -> list[inspect.Parameter] | None:
    """Its parameters without self; None where it does not tell (a function of a C extension)."""
    try:
        return list(inspect.signature(thing).parameters.values())
    except (TypeError, ValueError):
        return None


def wanted(name: str, thing: Callable[..., Any], unnamed: Sequence[Meaning]) -> dict[str, Meaning] | list[Meaning]:
    """What to call *thing* with: by name, or, where names say nothing, in the order of *unnamed*.

    Raises :class:`MethodError` for a required parameter that nobody can guess.
    """
    found = parameters(thing)
    variadic = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    usable = [p for p in found or () if p.kind not in variadic]
    required = [p for p in usable if p.default is inspect.Parameter.empty]
    if found is None or (found and not usable and found[0].kind is inspect.Parameter.VAR_POSITIONAL):
        return list(unnamed)
    meanings = {p.name: meaning(p.name) for p in usable}
    unknown = [p.name for p in required if meanings[p.name] is None]
    if not unknown:
        given = {n: m for n, m in meanings.items() if m}
        if any(p.kind is inspect.Parameter.POSITIONAL_ONLY for p in usable):
            return list(given.values())
        return given
    if len(unknown) == len(required) and len(required) in (len(unnamed), len(unnamed) - 1):
        return list(unnamed[: len(required)])
    asked = ", ".join(p.name for p in usable)
    raise MethodError(f"{name}({asked}): what is {unknown[0]!r}? {SHAPES}")


def kind(thing: Any) -> Literal["class", "function", "object"]:
    if inspect.isclass(thing):
        return "class"
    return "function" if inspect.isroutine(thing) or hasattr(thing, "__wrapped__") else "object"
