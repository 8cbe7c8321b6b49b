"""What the words behind an option mean, or why they mean nothing."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Any, NoReturn

from poise.errors import PoiseError


class UsageError(PoiseError):
    """An option that cannot be understood: exit code 2."""


def usage(message: str) -> NoReturn:
    raise UsageError(message)


def method_choices(names: tuple[str, ...], settings: tuple[str, ...]) -> tuple[Any, ...]:
    """The live methods *names*, each with those of the *settings*, ``NAME=VALUE``, that it has.

    Raises :class:`UsageError` for a method that does not exist, and for a setting that none of them has.
    """
    from poise.estimators import METHODS
    from poise.estimators.parameters import parameters
    from poise.live.methods import Choice

    chosen: dict[str, dict[str, Any]] = {name: {} for name in names}
    kinds = {name: {p.name: p.kind for p in parameters(METHODS[name])} for name in chosen if name in METHODS}
    for text in settings:
        key, _, value = text.partition("=")
        key = key.strip().replace("-", "_")
        fitting = [name for name, known in kinds.items() if key in known]
        if not fitting or not value:
            usage(f"--set {text!r}: expected NAME=VALUE with a parameter of {' or '.join(chosen)}")
        for name in fitting:
            chosen[name][key] = parsed(value.strip(), kinds[name][key])
    try:
        return tuple(Choice.of(name, found) for name, found in chosen.items())
    except PoiseError as error:
        usage(str(error))


def amount(name: str, text: str) -> int:
    """What ``--limit NAME=TEXT`` sets."""
    from poise.formats.limits import Limits

    known = [field.name for field in fields(Limits)]
    if name not in known:
        usage(f"--limit {name}=…: expected one of {', '.join(known)}")
    number, power = text, 0
    for i, unit in enumerate(("KiB", "MiB", "GiB", "TiB"), 1):
        if text.lower().endswith(unit.lower()):
            number, power = text[:-3], i
    try:
        found = float(number) * 1024.0**power
    except ValueError:
        found = -1.0
    if not 0.0 <= found <= 2.0**63:
        usage(f"--limit {name}={text}: expected a number such as 2e8 or 20GiB")
    return int(found)


def declination_of(degrees: float) -> float:
    """rad."""
    if not -180.0 <= degrees <= 180.0:
        usage(f"--declination {degrees}: expected degrees in ±180, east positive")
    return math.radians(degrees)


def parsed(text: str, kind: Any) -> Any:
    """The value of *text* for a parameter of *kind*; a text that is no number stays one, to be refused by name."""
    from poise.estimators.parameters import Interval

    if kind is bool and text.lower() in ("true", "yes", "on", "1", "false", "no", "off", "0"):
        return text.lower() in ("true", "yes", "on", "1")
    if kind == Interval:
        return None if text.lower() == "none" else tuple(parsed(end, float) for end in text.split(","))
    if kind in (int, float):
        try:
            return float(text)
        except ValueError:
            return text
    return text


def pairs(text: str | None, option: str, example: str) -> dict[str, str] | None:
    """``NAME=VALUE,…`` of an *option*, as *example* shows."""
    if text is None:
        return None
    found = {}
    for part in text.split(","):
        name, equals, value = part.partition("=")
        if not (name.strip() and equals and value.strip()):
            usage(f"{option} {text!r}: expected pairs such as {example}")
        found[name.strip()] = value.strip()
    return found
