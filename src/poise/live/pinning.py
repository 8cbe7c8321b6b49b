"""Which way a browser's motion sensors point, found by comparing them with the browser's own orientation.

Browsers agree on what an orientation is, and not on its rates: some give the acceleration with the other sign, some the
rotation rate in another order (https://github.com/w3c/deviceorientation/issues/44) or in rad/s. Nothing here knows a
browser: all signed orders are compared, and one is believed when motion has refuted every other.
"""

from __future__ import annotations

import re
from itertools import permutations, product
from math import radians
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

TIME, RATES, ACC, ANGLES = 0, slice(1, 4), slice(4, 7), slice(7, 10)
"""columns of raw motion: time in s; rotationRate alpha, beta, gamma; accelerationIncludingGravity x, y, z; orientation
alpha, beta, gamma in degrees"""
_GRAVITY = 9.81
_WINDOW = 0.2  # s
_LONGEST = 0.5  # s, else samples are missing in it
_MOST_WINDOWS, _BURST = (
    50.0,
    250.0,
)  # a second, and at once, that are looked at: a device with mad stamps must not cost more
_TURNED = radians(2.0)  # that a window must turn to say something about rates
_LEANED = radians(5.0)  # that up must have moved since a window that was counted, or rest would be counted for ever
_MOST_TURN = radians(60.0)  # more is a jump of the orientation (a compass that was corrected)
_SHAKEN = 3.0  # m/s² from gravity's length in any sample: the acceleration says too little about up
_RATE_EVIDENCE = 150.0 * radians(1.0) ** 2  # rad²; as 6° about an axis in one window, or 10° in three
_ACC_EVIDENCE = 1.0  # as up 20° off an axis' plane in two windows
_MISFIT = 0.15  # of the squared motion that the best may leave unexplained
_ORDERS = np.array(
    [
        np.diag(signs)[:, list(order)].astype(float)
        for order in permutations(range(3))
        for signs in product((1, -1), repeat=3)
    ]
)
_UNITS = {"deg": radians(1.0), "rad": 1.0}
_TEXT = re.compile(r"([+-][xyz]){3},([+-][abg]){3},(deg|rad)")
_HINTS = {
    "rates": (
        "tip the phone's top towards you and away",
        "tip the phone to the left and right",
        "turn the phone like a wheel",
    ),
    "acc": ("stand the phone on its long side", "hold the phone upright", "lay the phone flat"),
}


class Axes(NamedTuple):
    """How a browser's numbers become a body frame: x to the right of the screen, y up it, z out of it."""

    rates: Floats
    """(3, 3) signed order: gyr = unit · rates @ (alpha, beta, gamma)"""
    acc: Floats
    """(3, 3) signed order: acc = acc @ (x, y, z)"""
    unit: str
    """of the rates: deg or rad"""

    def rows(self, raw: Floats) -> Floats:
        """(n, 12) samples, as the estimators' loop reads them, of (n, 10) raw motion."""
        rows = np.zeros((len(raw), 12))
        rows[:, 0] = raw[:, TIME]
        rows[:, 1:4] = _UNITS[self.unit] * _ordered(raw[:, RATES], self.rates)
        rows[:, 4:7] = _ordered(raw[:, ACC], self.acc)
        rows[:, 7:10] = np.nan
        return rows

    def __str__(self) -> str:
        """Like ``-x-y-z,+b+g+a,deg``: what stands for the body's x, y and z, of the acceleration and of the rates."""
        return f"{_as_text(self.acc, 'xyz')},{_as_text(self.rates, 'abg')},{self.unit}"

    @classmethod
    def parse(cls, text: str) -> Axes:
        """The axes of such a text. Raises :class:`ValueError`."""
        if _TEXT.fullmatch(text):
            acc, rates, unit = text.split(",")
            try:
                return cls(_as_order(rates, "abg"), _as_order(acc, "xyz"), unit)
            except ValueError:
                pass
        raise ValueError(f"axes {text[:40]!r}: expected a text like -x-y-z,+b+g+a,deg")


def up(angles: Floats) -> Floats:
    """(n, 3) up in the body frame, of (n, 3) orientations alpha, beta, gamma in degrees."""
    return _rotations(angles)[:, 2, :]


class Pinning:
    """Takes raw motion until it can be only one thing.

    Signed orders and units are told apart by the squared differences, over windows of 0.2 s, between what the rates say was
    turned and what the orientation says, and between the acceleration and the orientation's up.
    """

    def __init__(self) -> None:
        self.axes: Axes | None = None
        self._rates, self._acc = _Evidence(), _Evidence()
        self._window: list[Floats] = []
        self._counted: Floats | None = None  # up in the last window that was counted
        self._oriented = self._rated = False
        self._length = _GRAVITY
        self._budget, self._now = _BURST, 0.0

    def add(self, raw: Floats, now: float) -> Axes | None:
        """Takes (n, 10) raw motion at *now* of the host's clock, s; the axes, once they are known."""
        self._budget = min(_BURST, self._budget + _MOST_WINDOWS * (now - self._now))
        self._now = now
        self._rated |= bool(np.isfinite(raw[:, RATES]).all(axis=1).any())
        self._oriented |= bool(np.isfinite(raw[:, ANGLES]).all(axis=1).any())
        known = np.asarray(np.isfinite(raw).all(axis=1))
        for row, whole in zip(raw, known, strict=True):
            if self.axes is not None:
                break
            if whole:
                self._add(row)
            else:
                self._window.clear()
        return self.axes

    @property
    def reason(self) -> str:
        """Why nothing is known yet, for the person who holds the phone."""
        if not self._rated:
            return "this browser gives no rotation rate: without a gyroscope there is nothing to go on"
        if not self._oriented:
            return "this browser gives no orientation to check the signs of its acceleration by"
        if abs(self._length - _GRAVITY) > _SHAKEN:
            length = f"its acceleration has a length of {self._length:.1f}, gravity is 9.8 m/s²"
            return f"hold the phone still for a moment: {length}"
        for name, evidence, enough in (
            ("rates", self._rates, _RATE_EVIDENCE),
            ("acc", self._acc, _ACC_EVIDENCE),
        ):
            missing = np.flatnonzero(4.0 * evidence.energy < enough)
            if len(missing):
                return _HINTS[name][missing[0]]
        return "turn the phone slowly to all sides: its rates, its acceleration and its orientation do not fit together yet"

    def _add(self, row: Floats) -> None:
        self._window.append(row)
        lasted = row[TIME] - self._window[0][TIME]
        if not 0.0 <= lasted <= _LONGEST:
            self._window = [row]
        elif lasted >= _WINDOW:
            if self._budget >= 1.0:
                self._budget -= 1.0
                self._look(np.array(self._window))
                self._decide()
            self._window = [row]

    def _look(self, window: Floats) -> None:
        rotations = _rotations(window[:, ANGLES])
        steps = np.diff(window[:, TIME])[:, None]
        turned = _small_turn(rotations[0].T @ rotations[-1])
        turn = float(np.linalg.norm(turned))
        if _TURNED <= turn <= _MOST_TURN:
            rates = window[:, RATES]
            self._rates.add(turned, np.sum(0.5 * steps * (rates[1:] + rates[:-1]), axis=0))
        lengths, upward = np.linalg.norm(window[:, ACC], axis=1), rotations[:, 2, :].mean(axis=0)
        self._length = float(lengths.mean())
        leaned = self._counted is None or np.linalg.norm(upward - self._counted) > _LEANED
        if leaned and turn <= _MOST_TURN and np.abs(lengths - _GRAVITY).max() <= _SHAKEN:
            self._counted = upward
            self._acc.add(upward, window[:, ACC].mean(axis=0) / _GRAVITY)

    def _decide(self) -> None:
        rates = self._rates.best(tuple(_UNITS.values()), _RATE_EVIDENCE)
        acc = self._acc.best((1.0,), _ACC_EVIDENCE)
        if rates is not None and acc is not None:
            self.axes = Axes(_ORDERS[rates[0]], _ORDERS[acc[0]], list(_UNITS)[rates[1]])


class _Evidence:
    """Sums over windows, enough to compare what was expected with every order of what was said."""

    def __init__(self) -> None:
        self.energy = np.zeros(3)
        """squares of what was expected, by axis"""
        self._said = 0.0
        self._cross = np.zeros((3, 3))

    def add(self, expected: Floats, said: Floats) -> None:
        self.energy += expected**2
        self._said += float(said @ said)
        self._cross += np.outer(expected, said)

    def best(self, factors: tuple[float, ...], enough: float) -> tuple[int, int] | None:
        """The numbers of the order and of the factor that alone explain what was expected."""
        alike = np.einsum("kij,ij->k", _ORDERS, self._cross)[:, None]
        k = np.array(factors)
        total = float(self.energy.sum())
        left = total + k**2 * self._said - 2.0 * k * alike
        first, second = np.partition(left.ravel(), 1)[:2]
        if second - first < max(enough, first) or first > _MISFIT * total:
            return None
        order, factor = np.unravel_index(int(left.argmin()), left.shape)
        return int(order), int(factor)


def _rotations(angles: Floats) -> Floats:
    """(n, 3, 3) body to Earth: about z by alpha, then the new x by beta, then the new y by gamma (W3C)."""
    ca, cb, cg = np.cos(np.radians(angles)).T
    sa, sb, sg = np.sin(np.radians(angles)).T
    rows = [
        [ca * cg - sa * sb * sg, -sa * cb, ca * sg + sa * sb * cg],
        [sa * cg + ca * sb * sg, ca * cb, sa * sg - ca * sb * cg],
        [-cb * sg, sb, cb * cg],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def _small_turn(rotation: Floats) -> Floats:
    """(3,) rotation vector, for turns below 90°; of more, a vector that is long."""
    sine = 0.5 * np.array(
        [rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]]
    )
    length = float(np.linalg.norm(sine))
    angle = np.arctan2(length, 0.5 * (np.trace(rotation) - 1.0))
    return sine * (angle / length) if length > 1e-12 else sine


def _ordered(values: Floats, order: Floats) -> Floats:
    """(n, 3) *values* in another order, exactly: a product would turn one NaN into three."""
    return np.asarray(values[:, np.abs(order).argmax(axis=1)] * order.sum(axis=1))


def _as_text(order: Floats, of: str) -> str:
    return "".join("+-"[int(row.sum() < 0)] + of[int(np.abs(row).argmax())] for row in order)


def _as_order(text: str, of: str) -> Floats:
    order = np.zeros((3, 3))
    for row, (sign, name) in zip(order, re.findall(r"([+-])(\w)", text), strict=True):
        row[of.index(name)] = -1.0 if sign == "-" else 1.0
    if not order.any(axis=0).all():
        raise ValueError(f"{text}: an axis twice")
    return order
