"""Who is put through the faults: poise's methods, and other packages' filters in two ways."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise import METHODS, Attitude, Recording, estimate
from poise.estimators import judged_by
from poise.peers import PEERS, installed, period
from poise.peers.adapters import imufusion_filter, imufusion_units

Floats = NDArray[np.float64]

FLAGSHIP = "self-calibrating"
SLOW = ("ahrs",)  # a package that takes seconds a run


class Contender(NamedTuple):
    """One column of the tables."""

    name: str
    package: str
    """"poise", or whose it is"""
    run: Callable[[Recording, Recording], Attitude]
    """of a recording, and of the clean one that it was made from"""
    has_heading: bool


def contender(name: str) -> Contender:
    """The contender of that name; by name, because processes cannot be handed functions made here."""
    if name in METHODS:
        return Contender(name, "poise", lambda r, _: estimate(METHODS[name](), r), judged_by(name) == "total")
    if name in _BARE:
        return Contender(name, name.removesuffix("-bare"), _BARE[name], True)
    peer = PEERS[name]
    return Contender(name, peer.package, lambda r, _: peer.attitude(r), peer.has_heading)


def names(words: str) -> list[str]:
    """The contenders that "methods", "peers", packages or names, separated by commas, mean; absent packages are left out.

    Raises ValueError for an unknown word.
    """
    found: list[str] = []
    for word in (part.strip() for part in words.split(",") if part.strip()):
        groups = {"methods": list(METHODS), "peers": [name for name in EVERY if name not in METHODS]}
        meant = groups.get(word) or [name for name in EVERY if word in (name, contender(name).package)]
        if not meant:
            raise ValueError(f"no method, peer or package called {word!r}; there are {', '.join(EVERY)}")
        found += [name for name in meant if name not in found]
    return [name for name in found if contender(name).package == "poise" or installed(contender(name).package)]


def _vqf_bare(recording: Recording, clean: Recording) -> Attitude:
    from vqf import VQF

    samples = (np.ascontiguousarray(v) for v in (recording.gyr, recording.acc, recording.mag))
    return _attitude(recording, VQF(period(clean)).updateBatch(*samples)["quat9D"])


def _imufusion_bare(recording: Recording, clean: Recording) -> Attitude:
    bias, ahrs = imufusion_filter(clean)
    quat = np.empty((len(recording), 4))
    for i, (gyr, acc, mag) in enumerate(zip(*imufusion_units(recording), strict=True)):
        ahrs.update(bias.update(gyr), acc, mag)
        quat[i] = ahrs.get_quaternion()
    return _attitude(recording, quat)


def _attitude(recording: Recording, quat: Floats) -> Attitude:
    return Attitude.of(recording.time, quat, heading_reference="magnetic")


# Rows as a user hands them over: as they come, at the data sheet's rate, without what poise.peers does for a peer.
_BARE: dict[str, Callable[[Recording, Recording], Attitude]] = {
    "vqf-bare": _vqf_bare,
    "imufusion-bare": _imufusion_bare,
}
EVERY = [*METHODS, *_BARE, *(name for name in PEERS if name != "vqf-offline")]  # the matrix is about causal ones
