"""What a method is run inside: the guard, the bias from rests, corrections given out slowly."""

from __future__ import annotations

from math import inf
from typing import Any

from poise.data.recording import STANDARD_GRAVITY
from poise.errors import MethodError
from poise.estimators.guard import Guard
from poise.estimators.parameters import prepared
from poise.estimators.rest_bias import RestBias
from poise.estimators.slewed import Slewed


def core(method: Any) -> Any:
    """The method inside its wrappers."""
    while isinstance(method, (Guard, RestBias, Slewed)):
        method = method.method
    return method


def innermost(state: Any) -> Any:
    """The state of the method inside its wrappers."""
    while hasattr(state, "inner"):
        state = state.inner
    return state


def slewed(method: Any, slew: float | None) -> Any:
    if slew is None or slew == inf:
        return method
    if isinstance(method, Slewed):
        raise MethodError("slew: the method given is slewed already")
    return Slewed(method, slew, float(getattr(core(method), "lead", 0.0)))


def wrapped(method: Any, guard: bool | None, rest_bias: bool) -> Any:
    prepared(method)  # a clear error about the method itself, before it is wrapped
    if guard not in (True, None):
        raise MethodError(
            f"guard: expected True, or None to leave it out, found {guard!r}; give Guard(method, …) for others"
        )
    if isinstance(method, Guard):
        return method
    if isinstance(method, Slewed):
        return method._replace(method=wrapped(method.method, guard, rest_bias))
    if rest_bias and not isinstance(method, RestBias) and not getattr(method, "learns_bias", False):
        method = RestBias(method)
    if not guard:
        return method
    facts: dict[str, Any] = {
        name: float(getattr(core(method), name)) for name in ("declination", "gravity") if hasattr(core(method), name)
    }
    return Guard(method, follows_mag=hasattr(core(method), "declination"), **facts)


def at_gravity(method: Any, gravity: float) -> Any:
    """*method* with the recording's gravity, where it has one and was left at the usual."""
    if gravity == STANDARD_GRAVITY or isinstance(method, (Guard, RestBias, Slewed)):
        return method
    return method._replace(gravity=gravity) if getattr(method, "gravity", None) == STANDARD_GRAVITY else method


def name_of(method: Any) -> str:
    return type(core(method)).__name__
