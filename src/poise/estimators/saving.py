"""A stream's state as text and back: JSON with a checksum, never pickle."""

from __future__ import annotations

import hashlib
import json
from typing import Any

import numpy as np

from poise.errors import StateError


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
        raise StateError(f"not a saved stream: {problem!r}; give the bytes that Stream.save() returned") from None


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
