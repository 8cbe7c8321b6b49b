"""Which estimators a comparison runs, by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from poise.errors import MethodError
from poise.estimators import METHODS
from poise.peers import PEERS, Peer, chosen, installed


def as_methods(methods: Any = None) -> dict[str, Any]:
    """Methods by name, from names of :data:`poise.METHODS`, methods by name, or a single one of either.

    Raises :class:`MethodError` for anything else; whether a method is one is said where it runs.
    """
    if _is_method(methods):
        return {_own_name(methods): methods}
    if not isinstance(methods, Mapping):
        return methods_named(methods)
    for name, method in methods.items():
        _check_name(name)
        if isinstance(method, type):
            raise MethodError(f"{name}: expected a method, found the class {method.__name__}; give {method.__name__}()")
        if not _is_method(method):
            raise MethodError(f"{name}: expected a method such as TwoStage(), found {method!r}")
    return dict(methods)


def as_peers(peers: Any = "") -> dict[str, Peer]:
    """Peers by name, from "vqf,imufusion", a list of such names, peers by name, or a single peer; none for none.

    Raises :class:`PoiseError` for anything else and for names not known.
    """
    if isinstance(peers, Peer):
        return {peers.name: peers}
    if isinstance(peers, Mapping):
        for name, peer in peers.items():
            _check_name(name)
            if not isinstance(peer, Peer):
                raise MethodError(f"{name}: expected a Peer of poise.peers, found {peer!r}")
        return dict(peers)
    words = [] if peers is None else _names(peers, "peers")
    return chosen(",".join(words)) if any(words) else {}


def methods_named(names: Iterable[str] | None = None) -> dict[str, Any]:
    """Methods with their defaults, by the names of :data:`poise.METHODS`; all of them if no names are given."""
    wanted = list(METHODS) if names is None else _names(names, "methods")
    for name in wanted:
        if name not in METHODS:
            raise MethodError(f"no method {name!r}; there are {', '.join(METHODS)}")
    return {name: METHODS[name]() for name in wanted}


def available_peers() -> dict[str, Peer]:
    """The peers whose package is installed."""
    return {name: peer for name, peer in PEERS.items() if installed(peer.package) is not None}


def _names(names: Any, what: str) -> list[str]:
    """One name, or several."""
    if isinstance(names, str):
        return [names]
    if isinstance(names, type) or not isinstance(names, Iterable):
        raise MethodError(f"{what}: expected names, or a dict of them by name, found {names!r}")
    found = list(names)
    for name in found:
        if not isinstance(name, str):
            raise MethodError(f"{what}: expected names, found {name!r} among them; give it a name: {{name: it}}")
    return found


def _check_name(name: object) -> None:
    if not isinstance(name, str) or not name:
        raise MethodError(f"expected a text as the name of an estimator, found {name!r}")


def _is_method(thing: object) -> bool:
    return isinstance(thing, tuple) and hasattr(thing, "_fields")


def _own_name(method: Any) -> str:
    if isinstance(method, Peer):
        return method.name
    return next((name for name, cls in METHODS.items() if type(method) is cls), type(method).__name__)
