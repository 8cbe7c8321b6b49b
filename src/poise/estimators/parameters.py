"""Parameters of a method: what they mean, and the one place where they are checked before a kernel sees them."""

from __future__ import annotations

import math
from functools import cache
from typing import Annotated, Any, Literal, NamedTuple, get_args, get_origin, get_type_hints

import numpy as np

from poise.errors import MethodError
from poise.math.choices import Choice
from poise.math.matrices import Mat3
from poise.math.vectors import Vec3

Interval = tuple[float, float] | None  # None stands for the whole range that the parameter is declared with


class Parameter(NamedTuple):
    """One parameter of a method, as people are shown it.

    A method declares it as ``name: Annotated[float, unit, meaning] = default``, with ``(low, high)`` behind the meaning
    where the range is not "0 or more".
    """

    name: str
    kind: Any
    default: Any
    unit: str
    meaning: str
    low: float
    high: float

    @property
    def choices(self) -> tuple[str, ...]:
        """The texts that may be given, where the parameter is a choice."""
        return get_args(self.kind) if get_origin(self.kind) is Literal else ()


@cache
def parameters(method_class: type) -> tuple[Parameter, ...]:
    """The parameters of a method class, in order."""
    found = []
    for name, hint in get_type_hints(method_class, include_extras=True).items():
        kind, *facts = get_args(hint) if get_origin(hint) is Annotated else (hint,)
        anything = (0.0, math.inf) if facts else (-math.inf, math.inf)  # a plain annotation says nothing of a range
        low, high = next((fact for fact in facts if isinstance(fact, tuple)), anything)
        unit, meaning = [*(fact for fact in facts if isinstance(fact, str)), "", ""][:2]
        default = getattr(method_class, "_field_defaults", {}).get(name)
        found.append(Parameter(name, kind, default, unit, meaning, low, high))
    return tuple(found)


def prepared(method: Any) -> Any:
    """*method* with every parameter of the exact type its declaration names, ready for a kernel.

    An int where a float is declared would compile everything anew. Raises :class:`MethodError` for a value of the wrong
    kind or out of range.
    """
    if isinstance(method, type):
        raise MethodError(f"{method.__name__} is a class; give a method: {method.__name__}()")
    if not (isinstance(method, tuple) and hasattr(method, "_fields") and hasattr(method, "step")):
        raise MethodError(f"expected a method such as TwoStage(), found {type(method).__name__}")
    return checked(method)


def checked(values: Any) -> Any:
    """*values*, any NamedTuple declared like a method's parameters, with every field of the exact type and in its range.

    Raises :class:`MethodError` where a value is not.
    """
    cls: type = type(values)
    return cls(**{p.name: _checked(f"{cls.__name__}.{p.name}", getattr(values, p.name), p) for p in parameters(cls)})


def _checked(name: str, value: Any, parameter: Parameter) -> Any:
    if parameter.choices:
        if not isinstance(value, str) or value not in parameter.choices:
            raise MethodError(f"{name}: expected one of {', '.join(map(repr, parameter.choices))}, found {value!r}")
        return Choice(value)
    if parameter.kind is bool:
        if not isinstance(value, (bool, np.bool_)):
            raise MethodError(f"{name}: expected True or False, found {value!r}")
        return bool(value)
    if parameter.kind == Interval:
        return _interval(name, value, parameter)
    if parameter.kind in (int, float):
        return _number(name, value, parameter)
    if parameter.kind is Vec3:
        return Vec3(*(float(_number(name, each, parameter)) for each in _parts(name, value, "three numbers")))
    if parameter.kind is Mat3:
        row = parameter._replace(kind=Vec3)
        return Mat3(*(_checked(name, each, row) for each in _parts(name, value, "three rows of three numbers")))
    if parameter.kind is Any or isinstance(value, type) or hasattr(value, "step"):  # a method inside a wrapper
        return prepared(value)
    return value


def _interval(name: str, value: Any, parameter: Parameter) -> tuple[float, float]:
    if value is None:
        return parameter.low, parameter.high
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        raise MethodError(f"{name}: expected two numbers ({parameter.unit}) or None, found {value!r}")
    low, high = (float(_number(name, end, parameter)) for end in value)
    if not low < high:
        raise MethodError(f"{name}: expected the lower end first, found {value!r}")
    return low, high


def _parts(name: str, value: Any, expected: str) -> tuple[Any, ...]:
    if not isinstance(value, (tuple, list, np.ndarray)) or len(value) != 3:
        raise MethodError(f"{name}: expected {expected}, found {value!r}")
    return tuple(value)


def _number(name: str, value: Any, parameter: Parameter) -> float | int:
    try:
        number = float(value)
        if isinstance(value, (str, bool)) or math.isnan(number) or (parameter.kind is int and number != int(number)):
            raise ValueError
    except (TypeError, ValueError, OverflowError):
        expected = "a whole number" if parameter.kind is int else "a number"
        unit = f" ({_unit(parameter)})" if _unit(parameter) else ""
        raise MethodError(f"{name}: expected {expected}{unit}, found {value!r}") from None
    if not (parameter.low <= number <= parameter.high and math.isfinite(number)):
        allowed = f"{parameter.low:g} to {parameter.high:g} {_unit(parameter)}".rstrip()
        raise MethodError(f"{name}: expected {allowed}, found {value!r}")
    return int(number) if parameter.kind is int else number


def _unit(parameter: Parameter) -> str:
    """Its unit behind a number; a share has none to be read aloud."""
    return "" if parameter.unit == "1" else parameter.unit


def as_dict(method: Any) -> dict[str, Any]:
    """The parameters of *method* by name, nested methods included, for files and reports."""
    return {
        name: as_dict(value) if hasattr(value, "_fields") else (str(value) if isinstance(value, str) else value)
        for name, value in zip(method._fields, method, strict=True)
    }
