"""How far an attitude is from a reference, by the error definition of the BROAD benchmark."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude
from poise.data.recording import Recording
from poise.errors import RecordingError
from poise.math import arrays

Floats = NDArray[np.float64]

DIVERGED_ANGLE, DIVERGED_TIME = np.pi / 2, 5.0  # rad, s: an error above it for so long is divergence


class Rmse(NamedTuple):
    """Root mean square errors, degrees."""

    total: float
    heading: float
    inclination: float


@dataclass(frozen=True, eq=False)
class Errors:
    """The error of every row, ``q_e = q_est ⊗ q_ref*`` in the Earth frame, split into heading and inclination.

    total = 2 acos|w|, heading = 2 atan|z/w|, inclination = 2 acos √(w² + z²) (Laidig et al. 2021,
    doi 10.3390/data6070072). Nothing is aligned first.
    """

    time: Floats
    """(n,) s"""
    total: Floats
    """(n,) rad in [0, π]; NaN where the attitude or the reference is unknown"""
    heading: Floats
    """(n,) rad in [0, π]"""
    inclination: Floats
    """(n,) rad in [0, π]"""
    counted: NDArray[np.bool_]
    """(n,) the rows that figures are made of: moving, reference known"""
    missing: int
    """rows that should count but have no attitude"""

    def rmse_deg(self) -> Rmse:
        """Root mean square of each error over the counted rows, degrees; NaN where there are none."""
        if not self.counted.any():
            return Rmse(*[float("nan")] * 3)
        squares = (np.mean(e[self.counted] ** 2) for e in (self.total, self.heading, self.inclination))
        return Rmse(*(float(np.degrees(np.sqrt(square))) for square in squares))

    def table(self) -> dict[str, dict[str, float]]:
        """RMSE, mean, median, 95th percentile and maximum of each error over the counted rows, degrees."""
        kinds: dict[str, dict[str, float]] = {}
        for name, rmse in self.rmse_deg()._asdict().items():
            e = np.degrees(getattr(self, name)[self.counted])
            if len(e):
                p50, p95 = np.percentile(e, [50, 95])
                kinds[name] = {
                    "rmse": rmse,
                    "mean": float(e.mean()),
                    "median": float(p50),
                    "p95": float(p95),
                    "max": float(e.max()),
                }  # fmt: skip
        return kinds

    @property
    def diverged(self) -> bool:
        """Whether the total error stays above 90° for 5 s somewhere."""
        return self.diverged_by("total")

    def diverged_by(self, kind: Literal["total", "heading", "inclination"]) -> bool:
        """Whether the error of that *kind* stays above 90° for 5 s somewhere."""
        stamped = np.isfinite(self.time)
        time, error = self.time[stamped], getattr(self, kind)[stamped]
        good = np.flatnonzero(~(error > DIVERGED_ANGLE))  # NaN ends a stretch
        edges = np.concatenate([[-1], good, [len(error)]])
        stretches = [time[b - 1] - time[a + 1] for a, b in zip(edges, edges[1:], strict=False) if b - a > 2]
        return bool(stretches) and float(max(stretches)) >= DIVERGED_TIME


def evaluate(attitude: Attitude, recording: Recording | Attitude) -> Errors:
    """The error of *attitude* against the reference of *recording*, or against a reference Attitude of its own times.

    A reference on the same rows is compared row by row; another one is resampled to the attitude's times.
    Raises :class:`RecordingError` where there is no reference, or it is in another frame.
    """
    if not isinstance(recording, (Recording, Attitude)):
        raise RecordingError(f"expected a Recording or an Attitude to compare with, found {type(recording).__name__}")
    truth = recording.truth if isinstance(recording, Recording) else recording
    if truth is None:
        raise RecordingError("the recording has no reference to evaluate against; give one with --reference FILE")
    if "body" in (getattr(attitude, "frame", ""), truth.frame):
        raise RecordingError("an attitude relative to another body cannot be evaluated against the Earth frame")
    if not isinstance(attitude, Attitude):
        raise RecordingError(f"expected an Attitude to evaluate, found {type(attitude).__name__}")
    attitude, truth = attitude.to("enu"), truth.to("enu")
    moving = moving_rows(recording, attitude.time) if isinstance(recording, Recording) else None
    if not _same_rows(truth.time, attitude.time):
        truth = truth.resample(attitude.time)
    error = arrays.multiply(attitude.quat, arrays.conjugate(truth.quat))
    w, x, y, z = np.abs(error.T)
    should = np.isfinite(truth.quat).all(axis=1)
    if moving is not None:
        should &= moving
    known = np.isfinite(error).all(axis=1)
    return Errors(
        time=attitude.time,
        total=2 * np.arctan2(np.sqrt(x**2 + y**2 + z**2), w),
        heading=2 * np.arctan2(z, w),
        inclination=2 * np.arctan2(np.hypot(x, y), np.hypot(w, z)),
        counted=np.asarray(should & known),
        missing=int(np.sum(should & ~known)),
    )


def moving_rows(reference: Recording, time: Floats) -> NDArray[np.bool_] | None:
    """(n,) whether the rows of *time* count: as the reference's row nearest to each does; None where it does not say."""
    if reference.moving is None or _same_rows(reference.time, time):
        return reference.moving
    return np.asarray(reference.moving[_nearest(reference.time, time)])


def _same_rows(a: Floats, b: Floats) -> bool:
    return len(a) == len(b) and np.array_equal(a, b, equal_nan=True)


def _nearest(own: Floats, wanted: Floats) -> NDArray[np.intp]:
    """The index of the stamp nearest to each wanted time."""
    order = np.argsort(own)
    ranked = own[order]
    after = np.clip(np.searchsorted(ranked, wanted), 1, max(len(own) - 1, 1))
    nearer = np.where(wanted - ranked[after - 1] <= ranked[after] - wanted, after - 1, after)
    return np.asarray(order[nearer])
