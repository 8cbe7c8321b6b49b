"""Other packages' filters behind one shape: a recording in, its attitude out.

    for name, peer in chosen("vqf,imufusion").items():
        attitude = peer.attitude(recording)
        attitude.provenance.parameters["prepared"]  # what was done to the recording first: a sentence each

The extra ``peers`` brings the packages.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude, Provenance
from poise.data.flags import Flag
from poise.data.recording import Recording
from poise.errors import PoiseError, RecordingError
from poise.estimators.guard import unpacked
from poise.peers import adapters
from poise.peers.even import FEWEST, Prepared, period, pieces, prepared, rising

Floats = NDArray[np.float64]

__all__ = ["PEERS", "Peer", "Prepared", "chosen", "installed", "period", "prepared"]

_EXTRA = 'pip install "poise[peers]"'


class Peer(NamedTuple):
    """Another package's filter."""

    name: str
    package: str
    settings: str
    """what it runs with, in words"""
    run: Callable[[Recording], Floats]
    """(n, 4) w x y z, sensor to ENU, of an even and complete recording (:func:`prepared`)"""
    has_heading: bool = True
    """whether its heading comes from a magnetometer, where the recording has one"""

    def attitude(self, recording: Recording) -> Attitude:
        """Its attitude on the rows of any recording, by way of :func:`prepared`; its provenance holds the notes of that.

        Rows in gaps longer than 1 s are NaN and flagged LOST; after each gap the filter starts anew. Raises
        :class:`PoiseError` where the package is absent, :class:`RecordingError` for a recording it cannot run on.
        """
        release = installed(self.package)
        if release is None:
            raise PoiseError(f"{self.name} needs the package {self.package}, which is not installed: {_EXTRA}")
        even, notes = prepared(recording)
        quat, flags = np.full((len(even), 4), np.nan), np.zeros(len(even), np.uint32)
        for piece in pieces(even):
            if piece.stop - piece.start >= FEWEST:
                quat[piece] = self._quat(even[piece])
                flags[piece] = _heading_flags(even.mag[piece]) if self.has_heading else Flag.HEADING_ARBITRARY
                flags[piece.start] |= np.uint32(Flag.GAP if piece.start else 0)
        heading = self.has_heading and even.has_mag
        attitude = Attitude.of(
            even.time,
            quat,
            heading_reference="magnetic" if heading else "arbitrary",
            provenance=Provenance(
                f"{self.name} {release}",
                {"settings": self.settings, "prepared": list(notes)},
                recording.source,
                recording.source_hash,
            ),
        )
        attitude.flags[:] |= flags
        return _on_rows(attitude, recording)

    def _quat(self, even: Recording) -> Floats:
        try:
            with np.errstate(all="ignore"):
                return self.run(even)
        except PoiseError:
            raise
        except Exception as problem:  # another package's own: whatever it is, the user is told where it came from
            raise RecordingError(f"{self.name} cannot run on this recording: {problem}") from problem


PEERS: dict[str, Peer] = {
    peer.name: peer
    for peer in (
        Peer("vqf", "vqf", "defaults, causal", adapters.vqf_causal),
        Peer("vqf-offline", "vqf", "defaults, not causal", adapters.vqf_offline),
        Peer(
            "imufusion", "imufusion", "gain 0.5, rejections 10°, 5 s, with its bias algorithm", adapters.imufusion_ahrs
        ),
        Peer(
            "ahrs-madgwick",
            "ahrs",
            "gain 0.041 (0.033 without magnetometer), started from the first sample",
            adapters.ahrs_madgwick,
        ),
        Peer("ahrs-mahony", "ahrs", "k_P 1, k_I 0.3", adapters.ahrs_mahony),
        Peer("ahrs-ekf", "ahrs", "default noises, the recording's own median dip", adapters.ahrs_ekf),
    )
}


def installed(package: str) -> str | None:
    """The version of a package, None where it is not there."""
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def chosen(words: str) -> dict[str, Peer]:
    """The peers that "vqf,imufusion,ahrs-mahony" asks for: a package's name means all of its peers ("vqf" is two).

    Raises :class:`PoiseError` naming what there is for an unknown name, and how to get a package that is absent.
    """
    found: dict[str, Peer] = {}
    for word in (part.strip().lower() for part in words.split(",") if part.strip()):
        peers = {name: peer for name, peer in PEERS.items() if word == peer.package} or (
            {word: PEERS[word]} if word in PEERS else {}
        )
        if not peers:
            raise PoiseError(f"no peer or package called {word!r}; {_offer()}")
        found |= {name: peer for name, peer in peers.items() if name not in found}
    if not found:
        raise PoiseError(f"no peer named; {_offer()}")
    absent = sorted({peer.package for peer in found.values() if installed(peer.package) is None})
    if absent:
        raise PoiseError(f"not installed: {', '.join(absent)}; {_EXTRA} brings them")
    return found


def _offer() -> str:
    packages = dict.fromkeys(peer.package for peer in PEERS.values())
    return f"there are {', '.join(PEERS)}, or by package {', '.join(packages)}"


def _heading_flags(mag: Floats) -> NDArray[np.uint32]:
    """What a stretch's rows say about the heading where mag is absent (NaN or 0)."""
    silent = ~(np.isfinite(mag).all(axis=1) & mag.any(axis=1))
    before = np.logical_and.accumulate(silent)
    return np.where(before, np.uint32(Flag.HEADING_ARBITRARY), silent * np.uint32(Flag.MAG_MISSING)).astype(np.uint32)


def _on_rows(attitude: Attitude, recording: Recording) -> Attitude:
    """The attitude brought from prepared stamps to the recording's rows."""
    if np.array_equal(attitude.time, recording.time):
        return attitude
    clock, forward = rising(unpacked(recording.time))
    placed = attitude.resample(clock)
    placed.flags[~forward] |= np.uint32(Flag.TIME_DISORDER)
    placed.time[:] = recording.time
    return placed
