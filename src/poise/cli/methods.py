"""``poise methods``: what there is to choose from."""

from __future__ import annotations

import inspect
import sys
from typing import Annotated, Any

from cyclopts import Parameter

from poise.cli import show
from poise.cli.options import Running


def methods(name: str | None = None, /, *, json: Annotated[bool, Parameter(negative="")] = False) -> int:
    """List the methods, or one with all its parameters.

    Parameters
    ----------
    name
        A method: shows its source, its parameters with unit, meaning and default.
    json
        Print as JSON.
    """
    from poise.estimators import METHODS
    from poise.estimators.parameters import parameters

    if name is not None and name not in METHODS:
        show.problem(f"no method {name!r}; there are {', '.join(METHODS)}")
        return 2
    chosen = [name] if name else list(METHODS)
    found = [
        {
            "method": each,
            "class": METHODS[each].__name__,
            "what": _first_line(METHODS[each]),
            "heading": _heading(METHODS[each]),
            "default": each == Running.method,
            "parameters": [_row(parameter) for parameter in parameters(METHODS[each])],
        }
        for each in chosen
    ]
    if json:
        show.as_json(found)
    elif name is None:
        columns = ["method", "class", "heading from", "what it is"]
        show.table("", columns, [[_named(f), f["class"], f["heading"], f["what"]] for f in found])
    else:
        print(f"{name} ({found[0]['class']}): {found[0]['what']}\n")
        print(_source(METHODS[name]) + "\n")
        rows = [[p["name"], p["default"], p["unit"], p["meaning"]] for p in found[0]["parameters"]]
        show.table("parameters, as in --set NAME=VALUE", ["name", "default", "unit", "meaning"], rows)
    return 0


def _named(found: dict[str, Any]) -> str:
    return f"{found['method']} (default)" if found["default"] else str(found["method"])


def _heading(method: Any) -> str:
    if "declination" in method._fields:
        return "magnetometer"
    return "none" if getattr(method(), "no_heading", False) else "gyroscope"


def _row(parameter: Any) -> dict[str, Any]:
    choices = f" ({', '.join(parameter.choices)})" if parameter.choices else ""
    default = parameter.default
    if isinstance(default, tuple):
        default = ",".join(f"{end:.6g}" for end in default)
    elif not isinstance(default, (bool, str)):
        default = f"{default:.6g}"
    return {
        "name": parameter.name,
        "default": default,
        "unit": parameter.unit,
        "meaning": parameter.meaning + choices,
    }


def _first_line(method: type) -> str:
    return (inspect.getdoc(method) or "").partition("\n")[0]


def _source(method: type) -> str:
    """The module's own account of its source and departures."""
    return inspect.cleandoc(sys.modules[method.__module__].__doc__ or "").partition("\n\n")[2]
