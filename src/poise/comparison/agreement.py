"""What several attitudes agree on, row by row: a median, so that one that is far off hardly moves it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude
from poise.data.flags import HEADING_ARBITRARY
from poise.math import arrays

Floats = NDArray[np.float64]

_ROUNDS = 25  # of Weiszfeld's iteration; 5 more move no direction by 0.05° on any recording at hand
_NEAREST = 1e-3  # rad: what is nearer to the median weighs no more, and where all agree the median is their mean
_UP = np.array([0.0, 0.0, 1.0])


def consensus(attitudes: Sequence[Attitude], headed: Sequence[bool]) -> Attitude:
    """The attitude that most of *attitudes* (of the same rows, ENU) are near to.

    Inclination: the geometric median of where each sees up in the body frame. Heading: the circular median of the headings
    of those that are *headed*. Rows that an attitude calls invalid do not count, nor does a heading that is flagged as
    arbitrary where another one is not; a row without any attitude is NaN.
    """
    quats = np.stack([np.where(a.valid[:, None], a.quat, np.nan) for a in attitudes])
    up = median_direction(arrays.rotate(arrays.conjugate(quats), _UP))
    level = _upright(up)
    turns = [_heading_vector(q, level) for q, own in zip(quats, headed, strict=True) if own]
    if not turns:
        return Attitude.of(attitudes[0].time, level)
    vectors = np.stack(turns)
    arbitrary = np.stack(
        [(a.flags & np.uint32(HEADING_ARBITRARY)) != 0 for a, own in zip(attitudes, headed, strict=True) if own]
    )
    vectors[arbitrary & ~arbitrary.all(axis=0)] = np.nan
    east, north = median_direction(vectors).T
    references = {a.heading_reference for a, own in zip(attitudes, headed, strict=True) if own}
    return Attitude.of(
        attitudes[0].time,
        arrays.multiply(arrays.turn_about_up(np.arctan2(north, east)), level),
        heading_reference=references.pop() if len(references) == 1 else "arbitrary",
    )


def aligned(attitude: Attitude, other: Attitude) -> Attitude:
    """*attitude* turned about up by the one angle that brings its heading, in the median over time, to that of *other*."""
    vectors = _heading_vector(other.quat, attitude.quat)
    if not np.isfinite(vectors).any():
        return attitude
    east, north = median_direction(vectors[:, None, :])[0]
    turned = attitude[:]
    turned = Attitude(
        turned.time, turned.table.copy(), turned.flags, attitude.heading_reference, attitude.frame, attitude.provenance
    )
    turned.quat[:] = arrays.multiply(arrays.turn_about_up(np.arctan2(north, east)), attitude.quat)
    return turned


def median_direction(vectors: Floats) -> Floats:
    """(n, m) unit vectors with the least sum of chords to k unit vectors (k, n, m); NaN ones do not count.

    Between two, the middle; where all are NaN, NaN.
    """
    known: NDArray[np.bool_] = np.asarray(np.isfinite(vectors).all(axis=2))
    v = np.where(known[..., None], vectors, 0.0)
    first = np.take_along_axis(v, np.argmax(known, axis=0)[None, :, None], axis=0)[0]
    centre = _unit(v.sum(axis=0), first)
    for _ in range(_ROUNDS):
        weights = known / np.maximum(np.linalg.norm(v - centre, axis=2), _NEAREST)
        centre = _unit(np.einsum("kn,knm->nm", weights, v), first)
    centre[~known.any(axis=0)] = np.nan
    return centre


def _unit(v: Floats, otherwise: Floats) -> Floats:
    """Rows of length one; *otherwise* where opposite vectors cancel."""
    length = np.linalg.norm(v, axis=1, keepdims=True)
    return np.where(length > 1e-9, v / np.maximum(length, 1e-9), otherwise)


def _upright(up: Floats) -> Floats:
    """(n, 4) the shortest turn that brings *up* (n, 3), as seen in the body, to up in the Earth frame."""
    w = 1.0 + up[:, 2]
    quat = np.column_stack([w, up[:, 1], -up[:, 0], np.zeros(len(up))])
    quat[w < 1e-9] = (0.0, 1.0, 0.0, 0.0)
    return arrays.normalize(quat)


def _heading_vector(quat: Floats, base: Floats) -> Floats:
    """(n, 2) cosine and sine of the heading of *quat* from that of *base*, as the benchmark's error splits it off."""
    w, _, _, z = np.moveaxis(arrays.multiply(quat, arrays.conjugate(base)), -1, 0)
    angle = 2.0 * np.arctan2(z, w)
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)
