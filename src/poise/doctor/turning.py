"""Turning: how well the gyroscope explains the way in which gravity and the magnetic field turn, whatever its axes."""

from __future__ import annotations

from functools import cache
from itertools import permutations, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.recording import Recording
from poise.math import arrays

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

BLOCK = 0.05  # s over which samples are averaged: longer than vibration, shorter than a quarter turn of most motions
WINDOW = 2.0  # s: long enough for accelerations to average out, short enough for a gyroscope's bias
LAGS = (1, 3)  # windows from one mean to those it is compared with
LEAST_WINDOWS = 8  # a short recording has shorter ones
_LONGEST = 2.0  # of the usual length: a shock is no vote
_SPARSEST = 4  # blocks for each row
_WILDEST = (
    1e7  # rad in a block: in no unit does anything turn like that, in one that is a thousand times another either
)
_SLOW = 0.05  # of the blocks
_ALIKE = 0.5  # of their middle: rates at rest lie nearer together
_LARGEST_BIAS = 0.1  # rad/s: more is a turn
FLOOR = 3e-4  # of the squared length, 1°: nearer than that no sensor's axes are


@cache
def signed_axes() -> Floats:
    """(48, 3, 3): every way to rename and negate three axes; the first 24 are rotations, the very first is none."""
    found = []
    for order in permutations(range(3)):
        for signs in product((1.0, -1.0), repeat=3):
            matrix = np.zeros((3, 3))
            matrix[range(3), order] = signs
            found.append(matrix)
    return np.array(sorted(found, key=lambda m: (np.linalg.det(m) < 0, changed(m))))


def changed(matrix: Floats) -> int:
    """How many axes *matrix* changes."""
    return int(np.sum(np.diag(matrix) != 1.0))


class Blocks(NamedTuple):
    """A recording in blocks of :data:`BLOCK` s; NaN where a block holds no sample."""

    start: float
    """s, where the first block begins"""
    width: float
    """s"""
    gyr: Floats
    """(m, 3) mean rates, in whatever unit"""
    acc: Floats
    mag: Floats
    """(m, 3) means, at the sensors' own instants"""


class Turns(NamedTuple):
    """How steady one sensor's vector is from outside, as the gyroscope tells, for all 48 answers at once.

    Gravity and the magnetic field stand still in the room. With v_k the vector in block k, S the gyroscope's axes as seen
    from the sensor's and R_k the turn from the first block to it that the rates as they are make, R_k Sᵀ v_k is one vector,
    as long as it should be, where S is right (with the turn of the negated rates where S is a mirror image).
    Accelerations leave the mean over a window nearly as it is. A loss is the squared distance from one window's mean to
    that of later ones and of both from their length, in units of that length.
    """

    loss: Floats
    """(windows, 48)"""
    still: Floats
    """(windows,) the same for a gyroscope that says nothing"""
    long: Floats
    """(means, 48) the length of a window's mean, of the usual length"""

    @property
    def votes(self) -> Floats:
        """(windows, 49) log-losses above a floor: a window's vote, which no single accident can carry; the last is still."""
        if not len(self.loss):
            return np.empty((0, 49))
        floor = FLOOR + float(np.median(self.loss.min(axis=1)))
        return np.asarray(np.log(floor + np.column_stack([self.loss, self.still])))

    @property
    def total(self) -> Floats:
        """(48,) the mean loss of each answer; NaN without a window."""
        return self.loss.mean(axis=0) if len(self.loss) else np.full(48, np.nan)

    @property
    def still_total(self) -> float:
        return float(self.still.mean()) if len(self.still) else float("nan")


def blocks(recording: Recording, time: Floats | None = None) -> Blocks:
    """The block means of *recording*; *time* (n,) s replaces its stamps, where they are in another unit or of packets."""
    stamps = recording.time if time is None else time
    known = np.isfinite(stamps)
    steps = np.diff(stamps[known])
    steps = steps[steps > 0]
    if not len(steps):
        return Blocks(0.0, BLOCK, *(np.empty((0, 3)) for _ in range(3)))
    width = max(BLOCK, 1.01 * float(np.median(steps)))
    low, high = float(stamps[known].min()), float(stamps[known].max())
    most = width * (_SPARSEST * len(stamps) + 1000)
    if high - low > most:  # stamps that jump: what is far from most of them is not looked at
        middle = float(np.median(stamps[known]))
        low, high = max(low, middle - most / 2), min(high, middle + most / 2)
    count = int((high - low) / width) + 1

    def means(values: Floats, ages: Floats | None) -> Floats:
        own = stamps if ages is None else stamps - ages
        with np.errstate(invalid="ignore"):
            place = (own - low) / width
            usable = (place >= 0) & (place < count) & np.isfinite(values.sum(axis=1))
        if usable.all():
            index, given = place.astype(np.intp), values
        else:
            index, given = place[usable].astype(np.intp), values[usable]
        n = np.bincount(index, minlength=count)
        with np.errstate(invalid="ignore"):
            return np.column_stack([np.bincount(index, given[:, i], count) / n for i in range(3)])

    aged = (bool(recording.acc_age.any()), bool(recording.mag_age.any()))
    return Blocks(
        low,
        width,
        means(recording.gyr, np.full(len(stamps), float(np.median(steps)) / 2)),  # the mean since the row before
        means(_heard(recording.acc), recording.acc_age if aged[0] else None),
        means(_heard(recording.mag), recording.mag_age if aged[1] else None),
    )


NO_TURNS = Turns(np.empty((0, 48)), np.empty(0), np.empty((0, 48)))


class Path(NamedTuple):
    """The attitude at the middle of every block, from any start, by rates as they are and by their negatives."""

    plain: Floats
    """(m, 4)"""
    mirrored: Floats
    unknown: NDArray[np.intp]
    """(m,) how many steps before a block have no rate"""


def _heard(vector: Floats) -> Floats:
    """*vector* (n, 3) with zeros as missing: a sensor of gravity or of a field that gives them gives nothing."""
    silent = (vector == 0).all(axis=1)
    return np.where(silent[:, None], np.nan, vector) if silent.any() else vector


def path(found: Blocks, factor: float = 1.0) -> Path:
    """The turn of *found*, its rates times *factor* in rad/s, less their bias."""
    offset = bias(found)
    if factor * float(np.linalg.norm(offset)) > _LARGEST_BIAS:
        offset = np.zeros(3)
    rate = (found.gyr - offset) * (factor * found.width)
    step = (rate[:-1] + rate[1:]) / 2
    absent = ~np.asarray((np.abs(step) < _WILDEST).all(axis=1))
    step = np.where(absent[:, None], 0.0, step)
    unknown = np.concatenate([[0], np.cumsum(absent)]).astype(np.intp)
    return Path(_chained(step), _chained(-step), unknown)


def _chained(step: Floats) -> Floats:
    """(m + 1, 4): the products of the turns (m, 3) rad one after the other, by doubling."""
    half = 0.5 * np.sqrt(np.einsum("ij,ij->i", step, step))
    quat = np.column_stack([np.cos(half), step * (0.5 * np.sinc(half / np.pi))[:, None]])
    quat = np.concatenate([[[1.0, 0.0, 0.0, 0.0]], quat])
    reach = 1
    while reach < len(quat):
        quat[reach:] = arrays.multiply(quat[:-reach], quat[reach:])
        reach *= 2
    return quat


def directions(vector: Floats) -> Floats:
    """(m, 3) unit vectors; NaN where there is no direction."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(vector / np.sqrt(np.einsum("ij,ij->i", vector, vector))[:, None])


def windows(count: int, width: float) -> NDArray[np.intp]:
    """(count,) the window that each block belongs to; shorter ones where the recording is short."""
    length = max(min(WINDOW / width, max(count / LEAST_WINDOWS, 3.0)), 1e-3)  # blocks
    return np.asarray((np.arange(count) + 0.5) / length, dtype=np.intp)


def turns(vector: Floats, along: Path, width: float, length: float) -> Turns:
    """How each of the 48 answers explains the turning of *vector* (m, 3), usually *length* long, window by window."""
    window = windows(len(vector), width)
    size = np.sqrt(np.einsum("ij,ij->i", vector, vector))
    broken = np.isin(window, window[1:][np.diff(along.unknown) > 0])  # a turn that is not known
    known = np.flatnonzero((size > 0) & np.isfinite(size) & ~broken)
    window, v = window[known], vector[known] / length
    v = v * np.minimum(1.0, _LONGEST * length / size[known])[:, None]  # a shock is no vote
    starts = np.flatnonzero(np.diff(window, prepend=-1))
    if len(starts) < 2:
        return NO_TURNS
    count = np.diff(np.append(starts, len(window)))
    means = np.empty((len(starts), 3, 49))  # the last column: as if nothing turned
    means[:, :, 48] = np.add.reduceat(v, starts) / count[:, None]
    for quat, part in ((along.plain, slice(0, 24)), (along.mirrored, slice(24, 48))):
        turn = _matrices(quat[known]).transpose(0, 2, 1)  # R_k
        both = turn[:, :, :, None] * v[:, None, None, :]  # R_jm v_l
        summed = np.add.reduceat(both.reshape(-1, 27), starts).reshape(-1, 3, 9) / count[:, None, None]
        answer = signed_axes()[part].transpose(0, 2, 1).reshape(24, 9)  # S_lm at (m, l)
        means[:, :, part] = summed @ answer.T
    whole = count >= 0.5 * np.median(count)
    apart, place = along.unknown[known[starts]], window[starts]
    long = np.sqrt(np.einsum("wis,wis->ws", means, means))
    longer = (long - 1.0) ** 2
    loss, found = np.zeros((len(starts), 49)), np.zeros(len(starts))
    for lag in LAGS:
        if lag >= len(starts):
            break
        near = whole[lag:] & whole[:-lag] & (place[lag:] - place[:-lag] == lag) & (apart[lag:] == apart[:-lag])
        step = means[lag:][near] - means[:-lag][near]
        loss[:-lag][near] += np.einsum("wis,wis->ws", step, step) / 2
        loss[:-lag][near] += (longer[lag:][near] + longer[:-lag][near]) / 2
        found[:-lag] += near
    loss = loss[found > 0] / found[found > 0, None]
    return Turns(loss[:, :48], loss[:, 48], long[whole, :48])


def _matrices(quat: Floats) -> Floats:
    """(n, 3, 3): the transposed matrices of unit quaternions (n, 4)."""
    w, x, y, z = np.ascontiguousarray(quat.T)
    return np.stack(
        [
            1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y),
            2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
            2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y),
        ],
        axis=1,
    ).reshape(-1, 3, 3)  # fmt: skip


def mean_cosines(acc: Floats, mag: Floats) -> Floats:
    """(3, 3), the mean of aᵢ mⱼ: directions of specific force and of the field, in blocks that hold both; else NaN."""
    both = np.isfinite(acc).all(axis=1) & np.isfinite(mag).all(axis=1)
    a, m = directions(acc[both]), directions(mag[both])
    known = np.isfinite(a).all(axis=1) & np.isfinite(m).all(axis=1)
    return np.asarray(a[known].T @ m[known] / known.sum()) if known.any() else np.full((3, 3), np.nan)


def bias(found: Blocks) -> Floats:
    """(3,) the rate of the slowest blocks, in its own unit: the gyroscope's bias; 0 where the sensor never rests."""
    speed = np.sqrt(np.einsum("ij,ij->i", found.gyr, found.gyr))
    known = np.isfinite(speed)
    if not known.any():
        return np.zeros(3)
    slow = found.gyr[known & (speed <= np.quantile(speed[known], _SLOW))]
    middle = np.median(slow, axis=0)
    spread = float(np.median(np.linalg.norm(slow - middle, axis=1)))
    # where nothing rests, the slowest blocks turn this way and that, and their middle is no bias
    return np.asarray(middle if spread < _ALIKE * float(np.linalg.norm(middle)) else np.zeros(3))
