"""A convention: how an output is to be read so that it is the attitude, body to ENU."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.conformance import frames
from poise.conformance.answers import Answer, Form
from poise.math import arrays

Floats = NDArray[np.float64]

WELL_KNOWN = ("ENU", "NED", "NWU")


class Reading(NamedTuple):
    """How one row of numbers is a rotation."""

    form: Form
    order: str = ""
    """wxyz or xyzw; of Euler angles the axes of the turns in their order, body-fixed: "ZYX" """
    columns: tuple[int, int, int] = (0, 1, 2)
    """of Euler angles: the column of each turn in *order*"""
    signs: tuple[int, int, int] = (1, 1, 1)
    degrees: bool = False
    inverse: bool = False
    """whether it turns Earth vectors into body vectors; never said of Euler angles, whose reverse is another order"""

    def quat(self, values: Floats) -> Floats:
        """(n, 4) w x y z, body to Earth."""
        if self.form == "Euler angles":
            quat = self._turned(values)
        elif self.form == "rotation matrix":
            quat = _of_matrices(values)
        else:
            quat = values[:, [3, 0, 1, 2]] if self.order == "xyzw" else values
        quat = arrays.normalize(quat)
        return arrays.conjugate(quat) if self.inverse else quat

    def _turned(self, values: Floats) -> Floats:
        angles = values[:, self.columns] * np.array(self.signs)
        half = 0.5 * (np.radians(angles) if self.degrees else angles)
        turns = np.zeros((3, len(values), 4))
        for i, axis in enumerate(self.order):
            turns[i, :, 0], turns[i, :, 1 + "XYZ".index(axis)] = np.cos(half[:, i]), np.sin(half[:, i])
        return arrays.multiply(arrays.multiply(turns[0], turns[1]), turns[2])


def readings(given: Answer) -> Iterator[Reading]:
    """All that an answer could mean."""
    if given.form == "Euler angles":
        for axes, columns, signs in product(permutations("XYZ"), permutations(range(3)), product((1, -1), repeat=3)):
            for degrees in (False, True):
                yield Reading(given.form, "".join(axes), columns, signs, degrees)  # type: ignore[arg-type]
        return
    orders = {"quaternion": ("wxyz", "xyzw"), "Rotation": ("wxyz",)}.get(given.form, ("",))
    for order, inverse in product(orders, (False, True)):
        yield Reading(given.form, order, inverse=inverse)


@dataclass(frozen=True, eq=False)
class Fit:
    """output = A · attitude · B over the judged rows, by the A that fits best and one of 24 B."""

    reading: Reading
    earth: Floats
    """(4,) A: from ENU to the output's Earth frame"""
    body: int
    """index of B among :data:`frames.QUATS`"""
    residual: float
    """degrees, RMS"""

    @cached_property
    def nearest(self) -> int:
        """Index of the named frame that is nearest to A."""
        return int(np.argmax(np.abs(frames.QUATS @ self.earth)))

    @cached_property
    def frame(self) -> str:
        return frames.earth_name(frames.MATRICES[self.nearest])

    @cached_property
    def off_axis(self) -> float:
        """Degrees from A to the named frame that is nearest."""
        return float(
            np.degrees(arrays.angle(arrays.multiply(self.earth, arrays.conjugate(frames.QUATS[self.nearest]))))
        )

    @cached_property
    def up(self) -> Floats:
        """(3,) up in the output's Earth frame."""
        w, x, y, z = self.earth.tolist()  # 1 µs where numpy takes 14 for one vector; fits are thousands
        return np.array([2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)])

    @cached_property
    def tilted(self) -> float:
        """Degrees from up to the nearest axis of the output's Earth frame."""
        return float(np.degrees(np.arccos(min(1.0, np.max(np.abs(self.up))))))

    @property
    def turn_about_up(self) -> float:
        """Degrees, counter-clockwise seen from above, from the named frame to the output's own."""
        turn = arrays.multiply(arrays.conjugate(self.earth), frames.QUATS[self.nearest])  # in ENU
        degrees = np.degrees(2.0 * np.arctan2(turn[3], turn[0]))
        return float((degrees + 180.0) % 360.0 - 180.0)

    def complexity(self, heading: bool) -> float:
        """How many words it takes to say: what is plain is preferred among what fits alike."""
        earth = 0.0 if (self.frame in WELL_KNOWN or not heading) else 1.0
        down = 0.1 if not heading and self.up[2] < 0.5 else 0.0
        return earth + down + 3.0 * (self.body != 0) + 0.5 * self.reading.inverse


def fits(given: Answer, quat: Floats, rows: NDArray[np.intp]) -> list[Fit]:
    """Every reading of the answer against the true attitude *quat* (n, 4) at *rows*; the best first."""
    values, true = given.values[rows], quat[rows]
    known = np.isfinite(values.reshape(len(values), -1)).all(axis=1)
    values, true = values[known], true[known]
    if len(values) < 10:
        return []
    # Euler angles of a turned body are Euler angles of another order: only the body as it is can be told.
    bodies = frames.QUATS[:1] if given.form == "Euler angles" else frames.QUATS
    back = arrays.conjugate(arrays.multiply(true[None], bodies[:, None]))
    found = []
    for reading in readings(given):
        read = reading.quat(values)
        if not np.isfinite(read).all():
            continue
        for i, (earth, residual) in enumerate(zip(*_best(arrays.multiply(read[None], back)), strict=True)):
            found.append(Fit(reading, earth, i, float(residual)))
    return sorted(found, key=lambda fit: fit.residual)


def distance(fit: Fit, earth: Floats, given: Answer, quat: Floats, rows: NDArray[np.intp]) -> float:
    """Degrees RMS of an answer, read as *fit* says, from the truth in the frame that *earth* (4,) is."""
    true = arrays.multiply(arrays.multiply(earth, quat[rows]), frames.QUATS[fit.body])
    error = arrays.angle(arrays.multiply(fit.reading.quat(given.values[rows]), arrays.conjugate(true)))
    return float(np.degrees(np.sqrt(np.nanmean(error**2))))


class Level(NamedTuple):
    """The reading by which up comes out best, whatever becomes of the heading."""

    reading: Reading
    body: int
    up: Floats
    residual: float
    """degrees, RMS"""


def levelled(given: Answer, quat: Floats, rows: NDArray[np.intp]) -> Level | None:
    """The best reading of an answer that may know the vertical only."""
    values, true = given.values[rows], quat[rows]
    known = np.isfinite(values.reshape(len(values), -1)).all(axis=1)
    if known.sum() < 10:
        return None
    up = arrays.rotate(arrays.conjugate(true[known]), np.array([0.0, 0.0, 1.0]))
    best: Level | None = None
    for reading in readings(given):
        read = reading.quat(values[known])
        for body in range(1 if given.form == "Euler angles" else 24):
            seen = arrays.rotate(read, up @ frames.MATRICES[body])
            mean = np.mean(seen, axis=0)
            mean /= max(float(np.linalg.norm(mean)), 1e-12)
            residual = float(np.degrees(np.sqrt(np.mean(np.arccos(np.clip(seen @ mean, -1.0, 1.0)) ** 2))))
            simpler = residual + 0.3 * (body != 0) + 0.1 * reading.inverse
            if best is None or simpler < best.residual + 0.3 * (best.body != 0) + 0.1 * best.reading.inverse:
                best = Level(reading, body, mean, residual)
    return best


def _best(errors: Floats) -> tuple[Floats, Floats]:
    """(k, 4) the mean of rotations (k, n, 4) and (k,) the RMS angle from it, degrees."""
    _, vectors = np.linalg.eigh(np.einsum("kni,knj->kij", errors, errors))
    mean = vectors[:, :, -1]
    cosine = np.minimum(np.abs(np.einsum("kni,ki->kn", errors, mean)), 1.0)
    return mean, np.degrees(2.0 * np.sqrt(np.mean(np.arccos(cosine) ** 2, axis=1)))


def _of_matrices(values: Floats) -> Floats:
    """(n, 4) of the rotations nearest to matrices (n, 3, 3); NaN where there is none, a mirror image too."""
    with np.errstate(all="ignore"):
        finite = np.where(np.isfinite(values), values, 0.0)
        u, size, v = np.linalg.svd(finite)
        nearest = u @ v
        proper = (np.linalg.det(nearest) > 0) & (size[:, -1] > 0.5 * size[:, 0])
    quat = np.full((len(values), 4), np.nan)
    for i in np.flatnonzero(proper):
        quat[i] = arrays.from_matrix(nearest[i])
    return quat
