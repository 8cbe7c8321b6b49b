"""The table ``[tipover]`` of a TOML file: the monitor's parameters as people write them, in degrees, seconds and metres."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from math import degrees, inf, isfinite, radians, tan
from pathlib import Path
from typing import Any

from poise.errors import FormatError, MethodError, PoiseError
from poise.estimators.parameters import Parameter, parameters
from poise.math.quaternions import IDENTITY
from poise.math.vectors import Vec3, unit
from poise.monitor.parameters import checked, level_at, mounted
from poise.monitor.sides import NO_EDGES, Directions
from poise.monitor.support import Support
from poise.monitor.tip_over import TipOver

_SUPPORT = ("polygon", "centre", "mass", "payload", "payload_at", "margin")
_PLAIN = tuple(p.name for p in parameters(TipOver) if p.name not in ("range", "self_balancing", "edges", "mount"))
KNOWN = ("range", "self_balancing", "mount", "tare", *_PLAIN, "support")


def read_settings(path: str | Path) -> TipOver:
    """The parameters in the table ``[tipover]`` of a TOML file.

    Raises :class:`FormatError` that names the file and the field.
    """
    path = Path(path)
    try:
        with path.open("rb") as file:
            tables = tomllib.load(file)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as problem:
        raise FormatError(f"{path}: no TOML file: {problem}") from None
    except OSError as problem:
        raise FormatError(f"{path}: cannot be read: {problem.strerror or problem}") from None
    table = tables.get("tipover")
    if not isinstance(table, Mapping):
        raise FormatError(f"{path}: no table [tipover] in it, where the monitor's parameters stand")
    try:
        return from_table(table)
    except PoiseError as problem:
        raise FormatError(f"{path}: [tipover]: {problem}") from None


def from_table(table: Mapping[str, Any], base: TipOver | None = None) -> TipOver:
    """The parameters of *base* with those in *table*, whose angles are in degrees: see ``docs/tipover.md``.

    Raises :class:`MethodError` that names the field as it stands there, with its angles in degrees.
    """
    try:
        return _from_table(table, base)
    except MethodError as problem:
        raise MethodError(str(problem).replace("TipOver.", "")) from None


def _from_table(table: Mapping[str, Any], base: TipOver | None) -> TipOver:
    for name in table:
        if name not in KNOWN:
            raise MethodError(f"{name}: no parameter of the monitor; there are {', '.join(KNOWN)}")
    tipover = TipOver() if base is None else base
    given: dict[str, Any] = {}
    for name in ("range", "self_balancing"):
        if name in table:
            given[name] = _directions(name, table[name], getattr(tipover, name))
    for parameter in parameters(TipOver):
        if parameter.name in table and parameter.name in _PLAIN:
            number = _number(parameter.name, table[parameter.name])
            if parameter.unit in ("rad", "rad/s"):
                number = radians(_bounded(parameter, number))
            given[parameter.name] = table[parameter.name] if parameter.kind is int else number
    if "mount" in table:
        given["mount"] = mounted(table["mount"])
    if given.keys() & {"range", "self_balancing"}:
        given["edges"] = NO_EDGES  # angles given after a support take its place
    tipover = tipover._replace(**given)
    if "tare" in table:
        tipover = _level(tipover, table["tare"])
    if "support" in table:
        if "range" in table or "self_balancing" in table:
            raise MethodError(
                "support: a support decides the angles; leave range and self_balancing out, or the support"
            )
        support = _support(table["support"])
        tipover = tipover._replace(edges=support.edges())
        if "pendulum" not in table:
            tipover = tipover._replace(pendulum=support.pendulum())
    return checked(tipover)


def _support(table: Any) -> Support:
    if not isinstance(table, Mapping) or not {"polygon", "centre"} <= set(table):
        raise MethodError("support: expected a table with polygon and centre")
    for name in table:
        if name not in _SUPPORT:
            raise MethodError(f"support.{name}: not known; there are {', '.join(_SUPPORT)}")
    given = dict(table)
    if "margin" in given:
        given["margin"] = radians(_number("support.margin", given["margin"]))
    return Support(**given)


def _level(tipover: TipOver, tare: Any) -> TipOver:
    """*tare*: how far, in degrees forward and to the right, a robot that stands upright seems to lean."""
    if not isinstance(tare, (list, tuple)) or len(tare) != 2:
        raise MethodError(f"tare: expected two angles in degrees, forward and right, found {tare!r}")
    forward, right = (_number("tare", angle) for angle in tare)
    if not (abs(forward) < 80.0 and abs(right) < 80.0):
        raise MethodError(f"tare: expected angles within ±80°, found {tare!r}; a sensor mounted otherwise needs mount")
    up = unit(Vec3(-tan(radians(right)), -tan(radians(forward)), 1.0))
    levelled = level_at(tipover._replace(mount=IDENTITY), up)  # the tare counts in the robot's frame, after the mount
    return tipover._replace(mount=levelled.mount * tipover.mount)


def _directions(name: str, value: Any, usual: Directions) -> Directions:
    """One number for all directions, or some of ``{ forward = 15, back = 25, left = 20, right = 20 }``."""
    if isinstance(value, Mapping):
        for key in value:
            if key not in Directions._fields:
                raise MethodError(f"{name}.{key}: no direction; there are {', '.join(Directions._fields)}")
        return usual._replace(**{key: radians(_angle(f"{name}.{key}", angle)) for key, angle in value.items()})
    return Directions(*[radians(_angle(name, value))] * 4)


def _angle(name: str, value: Any) -> float:
    """Degrees of a range or a limit: what is no such angle is told in the unit that it was given in."""
    number = _number(name, value)
    if not 0.0 < number <= 90.0:
        raise MethodError(
            f"{name}: expected degrees above 0, up to 90, found {number:g}" + " (an empty range)" * (number <= 0.0)
        )
    return number


def _bounded(parameter: Parameter, number: float) -> float:
    """*number*, degrees (a second), where the *parameter* may be that."""
    low, high = degrees(parameter.low), degrees(parameter.high)
    if not (low <= number <= high and isfinite(number)):
        unit = "degrees a second" if parameter.unit == "rad/s" else "degrees"
        allowed = f"{low:g} {unit} or more" if high == inf else f"{low:g} to {high:g} {unit}"
        raise MethodError(f"{parameter.name}: expected {allowed}, found {number:g}")
    return number


def _number(name: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise MethodError(f"{name}: expected a number, found {value!r}")
    return float(value)
