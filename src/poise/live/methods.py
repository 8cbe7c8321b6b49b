"""Which method a device runs, as people and pages name it, and compiling it ahead of time."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from poise.data.attitude import Attitude
from poise.data.packet import Packet
from poise.errors import MethodError
from poise.estimators import METHODS
from poise.estimators.engine import Stream
from poise.estimators.parameters import Interval, parameters, prepared

_WARM: set[str] = set()


class Choice(NamedTuple):
    """A method and the parameters that differ from its defaults, in a form that can be compared, kept and sent."""

    name: str
    settings: str = "{}"
    """JSON"""

    @classmethod
    def of(cls, name: str, settings: Mapping[str, Any] | None = None) -> Choice:
        """The choice of *name* with *settings*; raises :class:`MethodError` where they cannot be."""
        if name not in METHODS:
            raise MethodError(f"no method {name!r}; there are {', '.join(METHODS)}")
        known = {p.name: p for p in parameters(METHODS[name])}
        for key in settings or {}:
            if key not in known:
                raise MethodError(f"{name} has no parameter {key!r}; it has {', '.join(known)}")
        choice = cls(name, json.dumps(dict(sorted((settings or {}).items()))))
        choice.method()
        return choice

    def method(self) -> Any:
        """The method itself."""
        return prepared(METHODS[self.name](**json.loads(self.settings)))

    def stream(self, latest: Attitude | None = None) -> Stream:
        """A stream of it, which starts at the attitude and bias of *latest*, if given."""
        method = METHODS[self.name](**json.loads(self.settings))
        return Stream(method) if latest is None else Stream(method, latest[-1:], bias=latest.bias[-1])

    def warm(self) -> None:
        """Loads, or the first time compiles, the method; seconds, so not in the thread that serves."""
        for start in (None, [1.0, 0.0, 0.0, 0.0]):
            Stream(self.method(), start).update(Packet(0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 9.8), (0.0, 20.0, -40.0)))
        _WARM.add(self.name)


def startable(latest: Attitude) -> bool:
    """Whether a stream can start at *latest*: it is to be acted on, and its bias is known."""
    return bool(latest.valid[-1] and np.isfinite(latest.bias[-1]).all())


def warmed(choice: Choice) -> bool:
    """Whether a stream of it starts at once; parameters do not matter to the compiler."""
    return choice.name in _WARM


def described() -> list[dict[str, Any]]:
    """All methods with their parameters, for pages."""
    return [
        {
            "name": name,
            "parameters": [
                {
                    "name": p.name,
                    "default": p.default,
                    "unit": p.unit,
                    "meaning": p.meaning,
                    "low": p.low if np.isfinite(p.low) else None,
                    "high": p.high if np.isfinite(p.high) else None,
                    "choices": list(p.choices),
                    "kind": "choice" if p.choices else "interval" if p.kind == Interval else p.kind.__name__,
                }
                for p in parameters(cls)
            ],
        }
        for name, cls in METHODS.items()
    ]
