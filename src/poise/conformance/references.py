"""References: whether one that an attitude is far from is right, and only in another convention."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import Literal, NamedTuple

import numpy as np

from poise.conformance.conventions import Reading
from poise.data.attitude import Attitude, Frame
from poise.data.recording import Recording
from poise.evaluation import evaluate
from poise.math import arrays

Kind = Literal["total", "heading", "inclination"]

_FAR = 20.0  # degrees: what is nearer is an error of the attitude
_NEARER = 5.0  # times: what a convention explains, and what it is before the next
_TURNED = 45.0  # degrees: of one attitude any convention may make any other
_LEAST = 0.5  # degrees: nearer than that all are alike


class Misread(NamedTuple):
    """The one usual convention in which a reference agrees with an attitude, which as given it does not."""

    reading: Reading
    frame: Frame
    given: float
    """degrees, RMS, as the reference was given"""
    error: float
    """degrees, RMS, in this convention"""

    @property
    def sentence(self) -> str:
        what, cure = [], []
        if self.reading.order == "xyzw":
            what.append("has w last")
            cure.append("name its columns x y z w")
        if self.reading.inverse:
            what.append("is inverted (from Earth to body)")
            cure.append("negate its x, y and z")
        if self.frame == "ned":
            what.append("is in NED")
            cure.append('turn it by poise.Attitude.of(time, quat, frame="ned").to("enu")')
        return (
            f"the reference seems to be in another convention: as one that {' and '.join(what) or 'is in ENU'} it is "
            f"{self.error:.2f}° away, {self.given:.1f}° as given. If so, {', then '.join(cure) or 'say that it is in ENU'}; "
            "the figures are those of the reference as given"
        )


def misread(attitude: Attitude, against: Recording | Attitude, kind: Kind = "total") -> Misread | None:
    """The convention that explains why *attitude* is far from the reference *against*, by its error of that *kind*.

    None where it is not far or hardly turns, where no usual convention brings it much nearer, or two about as near.
    """
    truth = against.truth if isinstance(against, Recording) else against
    given = _error(attitude, against, kind)
    if truth is None or not given > _FAR or _turned(truth) < _TURNED:
        return None
    fits = []
    for reading, frame in _conventions(truth.frame):
        again = Attitude.of(
            truth.time, reading.quat(truth.quat), frame=frame, heading_reference=truth.heading_reference
        )
        error = _error(attitude, replace(against, truth=again) if isinstance(against, Recording) else again, kind)
        fits.append(Misread(reading, frame, given, error))
    best, second = sorted(fits, key=lambda fit: fit.error)[:2]
    alone = second.error >= _NEARER * max(best.error, _LEAST)
    return best if alone and best.error * _NEARER <= given else None


def _conventions(given: Frame) -> Iterator[tuple[Reading, Frame]]:
    """Inverse, w last, NED and what they make together; all but the one that was given."""
    frames: tuple[Frame, ...] = ("enu", "ned")
    for order, inverse, frame in product(("wxyz", "xyzw"), (False, True), frames):
        if (order, inverse, frame) != ("wxyz", False, given):
            yield Reading("quaternion", order, inverse=inverse), frame


def _turned(truth: Attitude) -> float:
    """Degrees, the furthest that *truth* (n rows) is from where it begins."""
    quat = truth.quat[np.isfinite(truth.quat).all(axis=1)]
    return float(np.degrees(arrays.angle(arrays.multiply(quat, arrays.conjugate(quat[0]))).max())) if len(quat) else 0.0


def _error(attitude: Attitude, against: Recording | Attitude, kind: Kind) -> float:
    return float(getattr(evaluate(attitude, against).rmse_deg(), kind))
