"""The same truth in the units and signs that an estimator may expect."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.conformance.answers import Answer
from poise.conformance.calling import Run
from poise.conformance.conventions import Fit, fits
from poise.conformance.scene import Scene
from poise.data.recording import STANDARD_GRAVITY, Recording
from poise.errors import MethodError
from poise.math import arrays

Floats = NDArray[np.float64]


class Feed(NamedTuple):
    """One hypothesis of what an estimator expects."""

    gyr: str = "rad/s"
    acc: str = "m/s²"
    gyr_sign: int = 1
    acc_sign: int = 1
    """1 for specific force, +g up at rest; −1 for gravity, +g down"""
    mag_sign: int = 1

    def of(self, recording: Recording) -> Recording:
        """A recording of rad/s, m/s² and specific force as this hypothesis has it."""
        gyr = self.gyr_sign * (np.degrees(recording.gyr) if self.gyr == "deg/s" else recording.gyr)
        acc = self.acc_sign * (recording.acc / STANDARD_GRAVITY if self.acc == "g" else recording.acc)
        return replace(recording, gyr=gyr, acc=acc, mag=self.mag_sign * recording.mag, truth=None)

    @property
    def complexity(self) -> float:
        """What is plain is preferred among what fits alike."""
        # Many take gravity for acc; hardly any takes the field the wrong way round: an odd frame is likelier.
        signs = 0.3 * (self.acc_sign < 0) + 1.2 * (self.mag_sign < 0) + 5.0 * (self.gyr_sign < 0)
        return signs + 0.02 * (self.gyr != "rad/s") + 0.01 * (self.acc != "m/s²")


FOLLOWS = 3.0  # degrees RMS from the truth, up to which an estimator is said to follow it
UPRIGHT = 3.0  # degrees from the Earth frame's axis to the true vertical

FEEDS = [Feed(g, a, 1, s, m) for g, a, s, m in product(("rad/s", "deg/s"), ("m/s²", "g"), (1, -1), (1, -1))]


@dataclass(frozen=True, eq=False)
class Trial:
    """What came of one feed."""

    feed: Feed
    answer: Answer | None
    fits: tuple[Fit, ...] = ()
    """the best first; empty where there was no answer to judge"""
    error: MethodError | None = None

    @property
    def residual(self) -> float:
        return self.fits[0].residual if self.fits else float("inf")

    def like(self, fit: Fit) -> Fit | None:
        """This trial's fit of the same reading and body."""
        return next((f for f in self.fits if f.reading == fit.reading and f.body == fit.body), None)


def tried(run: Run, scene: Scene, feed: Feed) -> Trial:
    """A feed's trial; an error of the estimator is part of it."""
    try:
        given = run(feed.of(scene.recording))
    except MethodError as error:
        return Trial(feed, None, error=error)
    return Trial(feed, given, tuple(fits(given, scene.quat, scene.judged)))


class Choice(NamedTuple):
    """A hypothesis and how the answer to it is read."""

    trial: Trial
    fit: Fit


def chosen(trials: list[Trial], heading: bool, vertical: bool = True) -> tuple[Choice, list[Choice]] | None:
    """The plainest hypothesis among those that fit as well as the best, and the others that say the same otherwise.

    *heading* and *vertical* say whether the Earth frame has them: what has none points anywhere.
    """
    every = [Choice(t, fit) for t in trials for fit in t.fits if heading or t.feed.mag_sign > 0]
    upright = [c for c in every if c.fit.tilted < UPRIGHT] if vertical else []
    known = upright if upright and min(c.fit.residual for c in upright) < FOLLOWS else every
    if not known:
        return None
    best = min(c.fit.residual for c in known)
    alike = [c for c in known if c.fit.residual <= 1.25 * best + 0.15]
    alike.sort(key=lambda c: (round(c.fit.complexity(heading) + c.trial.feed.complexity, 6), c.fit.residual))
    return alike[0], alike[1:]


def differs(run: Run, feed: Feed, given: Answer, other: Recording) -> float:
    """Degrees by which the answer to *other* differs most from *given*; inf where it cannot be read."""
    try:
        found = run(feed.of(other))
    except MethodError:
        return float("inf")
    return apart(given, found)


def apart(one: Answer, other: Answer) -> float:
    """Degrees between two answers in the row where they differ most; NaN rows of both are alike."""
    if one.form != other.form or one.values.shape != other.values.shape:
        return float("inf")
    if np.array_equal(one.values, other.values, equal_nan=True):
        return 0.0
    if one.form in ("quaternion", "Rotation"):
        p, q = arrays.normalize(one.values), arrays.normalize(other.values)
        angles = np.degrees(arrays.angle(arrays.multiply(arrays.conjugate(p), q)))
    elif one.form == "rotation matrix":
        gap = np.linalg.norm(one.values - other.values, axis=(1, 2))
        angles = np.degrees(2.0 * np.arcsin(np.minimum(gap / np.sqrt(8.0), 1.0)))
    else:  # their unit is not known yet: whatever it is, more than this is a difference
        angles = np.abs(one.values - other.values).max(axis=1)
    return float(np.nanmax(angles)) if np.isfinite(angles).any() else float("inf")
