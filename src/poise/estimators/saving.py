"""A stream's state as text and back: JSON with a checksum, never pickle."""

from __future__ import annotations

import hashlib
import json
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import COLUMNS, HeadingReference
from poise.errors import StateError
from poise.estimators.loop import ASIDE, TURN


class Saved(NamedTuple):
    """What a stream needs to go on."""

    identity: Any
    """of the method with its wrappers and parameters"""
    numbers: Any
    """the state's, in its shape; None where no sample had come"""
    aside: NDArray[np.float64]
    heading: HeadingReference
    reset: bool
    """whether the heading was set by hand"""
    latest: tuple[NDArray[np.float64], NDArray[np.uint32]] | None
    """the last row's table (1, 16) and flags (1,)"""


def sealed(kept: dict[str, Any]) -> bytes:
    """*kept* as JSON text with a checksum."""
    text = json.dumps(kept)
    return json.dumps({"poise": "stream", "sha256": _digest(text), "stream": text}).encode()


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def unsealed(saved: bytes) -> dict[str, Any]:
    """What :meth:`Stream.save` put into *saved*, which must be whole."""
    try:
        outer = json.loads(saved)
        if outer["poise"] != "stream" or outer["sha256"] != _digest(outer["stream"]):
            raise ValueError("damaged")
        kept = json.loads(outer["stream"])
        if not isinstance(kept, dict):
            raise TypeError("stream")
        return kept
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as problem:
        raise _no_stream(problem) from None


def read_saved(saved: bytes) -> Saved:
    """What :meth:`Stream.save` put into *saved*. Raises :class:`StateError` where it is damaged or none."""
    kept = unsealed(saved)
    try:
        aside, heading, latest = np.array(kept["aside"], float), kept["heading_reference"], kept["latest"]
        if aside.shape != (ASIDE,) or not abs(np.linalg.norm(aside[TURN : TURN + 4]) - 1.0) < 1e-6:
            raise ValueError("aside")
        if heading not in ("true", "magnetic", "arbitrary"):
            raise ValueError("heading_reference")
        row = None
        if latest is not None:
            row = np.array([latest[0]], float), np.array([latest[1]], np.uint32)
            if row[0].shape != (1, COLUMNS):
                raise ValueError("latest")
        return Saved(kept["method"], kept["state"], aside, heading, bool(kept["heading_reset"]), row)
    except (ValueError, KeyError, TypeError, IndexError, OverflowError) as problem:
        raise _no_stream(problem) from None


def _no_stream(problem: Exception) -> StateError:
    return StateError(f"not a saved stream: {problem!r}; give the bytes that Stream.save() returned")


def differences(saved: str, own: str) -> str:
    """What tells the identity of a *saved* stream from one's *own*, in words: the parameters that differ, or the method."""
    before, now = _parameters(saved), _parameters(own)
    if before.keys() == now.keys():
        changed = [f"{_leaf(path)} is {before[path]}, here {now[path]}" for path in before if before[path] != now[path]]
        return "; ".join(dict.fromkeys(changed))
    there, here = dict.fromkeys(map(_leaf, before)), dict.fromkeys(map(_leaf, now))
    lacking, new = [name for name in there if name not in here], [name for name in here if name not in there]
    told = " and ".join(filter(None, (_some(lacking, "here there is no"), _some(new, "there was no"))))
    return "another method, or others around it" + (f": {told}" if told else "")


def _parameters(identity: str) -> dict[str, str]:
    """The parameters in an identity by their path from the outermost, with its name."""
    outermost, brace, text = identity.partition("{")
    try:
        tree = json.loads(brace + text)
    except (ValueError, RecursionError):
        return {"": identity}

    def leaves(branch: dict[str, Any], path: str) -> dict[str, str]:
        found: dict[str, str] = {}
        for name, value in branch.items():
            inner = isinstance(value, dict)
            found |= leaves(value, f"{path}{name}.") if inner else {f"{path}{name}": json.dumps(value)}
        return found

    return leaves(tree, f"{outermost}.")


def _leaf(path: str) -> str:
    return path.rpartition(".")[2]


def _some(names: list[str], what: str, most: int = 4) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return f"{what} {', '.join(names[:most])}{more}" if names else ""


def copied(state: Any) -> Any:
    if isinstance(state, tuple):
        return type(state)(*map(copied, state))
    return state.copy() if isinstance(state, np.ndarray) else state


def flat(state: Any) -> Any:
    if isinstance(state, tuple):
        return [flat(part) for part in state]
    return state.tolist() if isinstance(state, np.ndarray) else state


def filled(template: Any, numbers: Any) -> Any:
    """*template* with the values of *numbers*, which must have its shape."""
    try:
        if isinstance(template, tuple):
            parts = [filled(part, value) for part, value in zip(template, numbers, strict=True)]
            return type(template)(*parts)
        if isinstance(template, np.ndarray):
            return np.array(numbers, template.dtype).reshape(template.shape)
        if isinstance(numbers, (list, str)) or numbers is None:
            raise TypeError
        return type(template)(numbers)
    except (TypeError, ValueError, OverflowError):
        raise StateError("the saved state does not fit this version of the method; start the stream anew") from None
