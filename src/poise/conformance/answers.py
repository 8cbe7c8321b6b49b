"""What an estimator gave back, as rows of quaternions, matrices or angles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.errors import MethodError

Floats = NDArray[np.float64]
Form = Literal["quaternion", "Rotation", "rotation matrix", "Euler angles"]

_HOLDERS = (
    "quat", "quaternion", "Q", "q", "attitude", "orientation", "quat9D", "get_quaternion", "getQuat9D", "getQuat6D",
    "quat6D", "get_quat", "rotation", "R", "euler",
)  # fmt: skip
_ROWS: dict[tuple[int, ...], Form] = {(4,): "quaternion", (3, 3): "rotation matrix", (3,): "Euler angles"}


class Answer(NamedTuple):
    """n rows of one form: (n, 4), (n, 3, 3) or (n, 3)."""

    form: Form
    values: Floats


def answer(name: str, given: Any, n: int) -> Answer:
    """*given* as rows. Raises :class:`MethodError` that says what was found where they are none."""
    if hasattr(given, "as_quat"):
        values = np.atleast_2d(np.asarray(given.as_quat(), float))[:, [3, 0, 1, 2]]  # of scipy: x y z w
        return _checked(name, "Rotation", values, n)
    if hasattr(given, "table") and hasattr(given, "quat"):  # an Attitude
        given = given.quat
    given = _first(given, n)
    if given is None:
        raise MethodError(f"{name} returned nothing; {_expected(n)}")
    try:
        values = np.array(given, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise MethodError(f"{name} returned {_described(given)}; {_expected(n)}") from None
    if values.shape == (n, 9):
        values = values.reshape(n, 3, 3)
    form = _ROWS.get(values.shape[1:])
    if form is None or values.ndim < 2:
        hint = "; transpose it" if values.shape in ((4, n), (3, n)) else ""
        raise MethodError(f"{name} returned {_described(values)}{hint}; {_expected(n)}")
    return _checked(name, form, values, n)


def row(thing: Any, returned: Any) -> Any:
    """What one step of *thing* says: what it *returned*, or else what it holds under one of the usual names."""
    if returned is not None and returned is not thing:
        return _first(returned, None)
    return held(thing)


def held(thing: Any) -> Any:
    """The first of an object's usual names for its attitude; None where it has none."""
    for name in _HOLDERS:
        value = getattr(thing, name, None)
        if value is not None:
            return value() if callable(value) and not hasattr(value, "as_quat") else value
    return None


def _first(given: Any, n: int | None) -> Any:
    """The attitude among several things returned."""
    if isinstance(given, Mapping):
        return next((given[key] for key in _HOLDERS if key in given), given)
    if isinstance(given, tuple) and given and np.ndim(given[0]) > (0 if n is None else 1):
        return given[0]
    return given


def _checked(name: str, form: Form, values: Floats, n: int) -> Answer:
    if len(values) != n:
        raise MethodError(f"{name} returned {len(values)} rows for {n} samples; expected one row for every sample")
    return Answer(form, values)


def _expected(n: int) -> str:
    return (
        f"expected ({n}, 4) quaternions, ({n}, 3, 3) rotation matrices or ({n}, 3) Euler angles, a row for every sample"
    )


def _described(value: Any) -> str:
    shape = getattr(value, "shape", None)
    return f"an array of shape {shape}" if shape is not None else a_kind(value)


def a_kind(value: Any) -> str:
    """The type of *value* with its article: "an int"."""
    name = type(value).__name__
    return f"{'an' if name[:1].lower() in 'aeiou' else 'a'} {name}"
