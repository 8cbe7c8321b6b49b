"""What SelfCalibrating knows of its sensors, out of its memory and, for the next recording of the same sensor, into it."""

from __future__ import annotations

from math import radians
from typing import Any, NamedTuple

import numpy as np

from poise.data.learned import Learned, named
from poise.errors import MethodError
from poise.estimators.self_calibrating.covariance import forget
from poise.estimators.self_calibrating.expected_scale import expect_as_learned
from poise.estimators.self_calibrating.model import (
    ACC_BIAS,
    ACC_DELAY,
    ACC_SCALE,
    BIAS,
    BY_FIND,
    FOUND,
    IRON,
    LENGTHS,
    MAG_DELAY,
    OPEN,
    SCALE,
    SIZE,
    Floats,
    put_sensor,
    put_three,
    sensor_of,
    three,
)
from poise.estimators.self_calibrating.unproven import VAGUE, narrow, trace
from poise.math.compiled import compiled
from poise.math.matrices import I3, Mat3
from poise.math.vectors import ZERO, Vec3, norm

METHOD = "SelfCalibrating"
# What may change between two recordings of one sensor, as standard deviations added to each number's own.
GROWTH = {
    "gyr_bias": radians(
        0.2
    ),  # rad/s: 0.02 to 0.05 deg/s a kelvin, some kelvin, and what one turn-on differs from the next
    "gyr_scale": 1.5e-3,  # 0.02 to 0.05 % a kelvin, and 0.1 % that a rate is off its straight line
    "hard_iron": 0.01,  # lengths of the field: offset of the magnetometer, and what lies beside it
    "mag_delay": 1e-3,  # s: two clocks that start anew; firmware and filters stay
    "acc_delay": 3e-4,  # s
    "acc_bias": 0.02,  # m/s²: 0.1 to 0.5 mg a kelvin, some kelvin
    "acc_scale": 2e-3,  # 0.01 to 0.03 % a kelvin, and gravity of another place
}
_DOUBTED = 3.0  # sigmas
_UNIT = "of the magnetometer"  # whatever that is: only directions count
_LIKE = 4.0  # the Earth's field is 22 to 67 µT, so no two places differ by more; another unit does
_PLACES = {
    "gyr_bias": range(BIAS, BIAS + 3),
    "gyr_scale": range(SCALE, SCALE + 9),
    "acc_delay": range(ACC_DELAY, ACC_DELAY + 1),
    "acc_bias": range(ACC_BIAS, ACC_BIAS + 3),
    "acc_scale": range(ACC_SCALE, ACC_SCALE + 1),
    "hard_iron": range(IRON, IRON + 3),
    "mag_delay": range(MAG_DELAY, MAG_DELAY + 1),
}  # of what belongs to the sensor, not to the place
_SHAPES: dict[str, tuple[int, ...]] = {
    "gyr_bias": (3,), "gyr_scale": (3, 3), "acc_delay": (), "acc_bias": (3,), "acc_scale": (), "hard_iron": (3,),
    "mag_delay": (), "field": (2,),
}  # fmt: skip
_UNITS = {
    "gyr_bias": "rad/s", "gyr_scale": "1", "acc_delay": "s", "acc_bias": "m/s²", "acc_scale": "1", "mag_delay": "s",
}  # fmt: skip
_LARGEST = {
    "gyr_bias": 10.0, "gyr_scale": 1.0, "acc_delay": 1.0, "acc_bias": 10.0, "acc_scale": 1.0, "mag_delay": 1.0,
}  # fmt: skip


def learned(bias: Vec3, P: Floats) -> Learned:
    """What is known by now; the covariance is that of all that belongs to the sensor.

    ``gyr_bias`` (3) and ``gyr_scale`` (3, 3) with ω = (I + A)(gyr − bias); ``field`` (2), north and up, ``hard_iron`` (3,
    body frame) in the magnetometer's unit; ``mag_delay`` and ``acc_delay`` behind the gyroscope; ``acc_bias`` (3) and
    ``acc_scale`` with f = (1 + s)(acc − bias). Without a magnetometer
    nothing is said of one. As long as the sensor has not been turned about all axes, the iron is as unsure as that leaves it.
    """
    known, size = sensor_of(P), np.ones(SIZE)
    values: dict[str, Any] = {
        "gyr_bias": bias, "gyr_scale": known.scale, "acc_delay": known.acc_delay, "acc_bias": known.acc_bias,
        "acc_scale": known.acc_scale,
    }  # fmt: skip
    if known.length > 0.0:
        size[IRON - 2 : IRON + 3] = known.length  # the field's two stand before the hard iron's three
        values["field"] = known.length * np.array(known.field[1:])
        values["hard_iron"] = known.length * np.array(known.iron)
        values["mag_delay"] = known.mag_delay
    P = _with_open_iron(P)
    sigma = size * np.sqrt(np.maximum(P.diagonal(), 0.0))
    quantities = {}
    for name, value in values.items():
        at = range(IRON - 2, IRON) if name == "field" else _PLACES[name]
        own = sigma[at.start : at.stop].reshape(_SHAPES[name])
        unit = _UNITS.get(name, _UNIT)
        quantities[name] = {"value": np.array(value, float).tolist(), "sigma": own.tolist(), "unit": unit}
    at_all = [i for name, places in _PLACES.items() if name in values for i in places]
    covariance = P[np.ix_(at_all, at_all)] * np.outer(size[at_all], size[at_all])
    states = tuple(n for name in _PLACES if name in values for n in named(name, quantities[name]["value"]))
    return Learned(METHOD, quantities, states, 0.5 * (covariance + covariance.T))


def _with_open_iron(P: Floats) -> Floats:
    """The 29 errors' covariance, and in it what iron the motion leaves open where none was found."""
    errors, V = P[:SIZE, :SIZE].copy(), three(P, OPEN, 0)
    if P[OPEN, BY_FIND] == 0.0 and trace(V) > VAGUE**2:
        errors[IRON : IRON + 3, IRON : IRON + 3] += np.array(V)
    return errors


def check_start(learned: Learned) -> None:
    """Raises :class:`MethodError` where *learned* is not what this method learns, or cannot be that of a sensor."""
    if learned.method != METHOD:
        raise MethodError(f"start_from: what {learned.method or 'no method'} learned, expected that of {METHOD}")
    if "hard_iron" in learned and "field" not in learned:
        raise MethodError("start_from: a hard iron without the field that it was learned in")
    for name, shape in _SHAPES.items():
        if name not in learned and name not in ("gyr_bias", "gyr_scale", "acc_delay"):
            continue
        if name not in learned or np.shape(learned[name]["value"]) != shape:
            found = f"one of shape {np.shape(learned[name]['value'])}" if name in learned else "none"
            raise MethodError(f"start_from: expected {name} of shape {shape}, found {found}")
        unit, expected = learned[name]["unit"], _UNITS.get(name, _UNIT)
        if unit != expected:
            raise MethodError(f"start_from: {name} in {unit!r}, expected {expected!r}")
        largest = _LARGEST.get(name, (100.0 if name == "hard_iron" else 10.0) * _length(learned))
        if np.max(np.abs(learned[name]["value"])) > largest or np.max(learned[name]["sigma"]) > 10.0 * largest:
            raise MethodError(f"start_from: {name} {learned[name]['value']} {unit} is that of no sensor")
    if "field" in learned and not _length(learned) > 0.0:
        raise MethodError("start_from: a field of no length")


def take_over(P: Floats, learned: Learned, expected_iron: float, least_iron: float) -> None:
    """Begin with *learned*, each number as sure as it was, less what may have changed since; the bias is in the state.

    Its correlations come along: several numbers may be known together, none of them alone. The field is of the place and
    stays behind; the hard iron is kept in lengths of that field, told by a negative length, until there is one here. Its
    sigma remains that share of a field.
    """
    kept, size = [name for name in _PLACES if name in learned], np.ones(SIZE)
    known = sensor_of(P)
    if "hard_iron" in learned:
        length = _length(learned)
        size[IRON : IRON + 3] = length
        iron = Vec3(*(float(v) / length for v in learned["hard_iron"]["value"]))
        known = known._replace(iron=iron, mag_delay=float(learned["mag_delay"]["value"]), length=-length)
    scale = Mat3(*(Vec3(*map(float, row)) for row in learned["gyr_scale"]["value"]))
    known = known._replace(scale=scale, acc_delay=float(learned["acc_delay"]["value"]))
    if "acc_bias" in learned and "acc_scale" in learned:
        acc_bias = Vec3(*(float(v) for v in learned["acc_bias"]["value"]))
        known = known._replace(acc_bias=acc_bias, acc_scale=float(learned["acc_scale"]["value"]))
    put_sensor(P, known)
    for name in kept:
        forget(P, _PLACES[name].start, len(_PLACES[name]), 0.0)
    places = {n: i for name in kept for n, i in zip(named(name, learned[name]["value"]), _PLACES[name], strict=True)}
    names, _, sigma = learned.numbers()
    for name, deviation in zip(names, sigma, strict=True):
        if name in places:
            P[places[name], places[name]] = (deviation / size[places[name]]) ** 2
    if learned.covariance is not None:
        at = [places[name] for name in learned.states]
        P[np.ix_(at, at)] = learned.covariance / np.outer(size[at], size[at])
    for name in kept:
        for i in _PLACES[name]:
            P[i, i] += GROWTH[name] ** 2
    expect_as_learned(P)
    if "hard_iron" in kept:
        beside = P[IRON : IRON + 3, IRON : IRON + 3]
        narrow(P, Mat3(*(Vec3(*map(float, row)) for row in beside)), ZERO)
        if norm(known.iron) < least_iron:  # a larger one is the sensor's own
            _weigh_iron(P, expected_iron)


def without_iron(mag: Floats, learned: Learned, least: float) -> Floats:
    """A sample (3,) without the hard iron that :func:`take_over` carries whole; as it is where that is of another unit."""
    if "hard_iron" not in learned or not mag.any():
        return mag
    length = _length(learned)
    share = Vec3(*(float(v) / length for v in learned["hard_iron"]["value"]))
    return mag - iron_from_before(share, length, Vec3(*map(float, mag)), I3) if norm(share) >= least else mag


def _weigh_iron(P: Floats, expected: float) -> None:
    """What was learned beside σ *expected* without it: a hard iron that walks is in part of the place where it was learned."""
    known = sensor_of(P)
    iron = list(known.iron)
    for k in range(3):
        variance = float(P[IRON + k, IRON + k])
        weight = expected**2 / (expected**2 + variance) if variance > 0.0 else 1.0
        iron[k] *= weight
        forget(P, IRON + k, 1, weight * variance)
    put_sensor(P, known._replace(iron=Vec3(*iron)))


@compiled
def of_this_unit(share: Vec3, length: float, seen: Vec3, to_iron: Mat3) -> bool:
    """Whether the field *seen* can be in the unit of one of that *length*, which a hard iron is a *share* of."""
    held = length * share
    most, left = norm(held), norm(seen - to_iron @ held)
    can_be = (length - most) / _LIKE < norm(seen) < _LIKE * (length + most)
    return can_be and length / _LIKE < left < _LIKE * length


@compiled
def iron_from_before(share: Vec3, length: float, seen: Vec3, to_iron: Mat3) -> Vec3:
    """The hard iron in the field's unit where that is of this one: else nothing."""
    return length * share if of_this_unit(share, length, seen, to_iron) else ZERO


class KnownIron(NamedTuple):
    """A hard iron in the magnetometer's unit, its sigma per axis, the field's length where it was found, what is open."""

    iron: Floats
    sigma: float
    length: float
    beside: Mat3  # lengths²


def irons_found(P: Floats) -> int:
    """How often the lengths of the field have shown one."""
    return int(P[LENGTHS, FOUND])


def known_iron(P: Floats) -> KnownIron:
    """The hard iron as it is known by now."""
    known = sensor_of(P)
    sigma = np.sqrt(P[IRON : IRON + 3, IRON : IRON + 3].trace() / 3.0)
    return KnownIron(known.length * np.array(known.iron), float(known.length * sigma), known.length, three(P, OPEN, 0))


def begin_with_iron(P: Floats, known: KnownIron) -> None:
    """It is there from the first sample of the magnetometer on."""
    iron = Vec3(*(float(v) / known.length for v in known.iron))
    put_sensor(P, sensor_of(P)._replace(iron=iron, length=-known.length))
    forget(P, IRON, 3, (known.sigma / known.length) ** 2)
    put_three(P, OPEN, 0, known.beside)


def doubts(before: Learned, after: Learned) -> list[str]:
    """What speaks against *before*, which a recording was started from, being of its sensor, now that *after* is known."""
    names, values, sigma = before.numbers()
    found = dict(zip(*after.numbers()[:2], strict=True))
    told = []
    for name, was, deviation in zip(names, values, sigma, strict=True):
        quantity = next((key for key in (*_PLACES, "field") if name.startswith(key)), "")
        if quantity in _UNITS and name in found:
            expected = float(np.hypot(deviation, GROWTH[quantity]))
            if abs(found[name] - was) > _DOUBTED * expected:
                unit = before[quantity]["unit"]
                told.append(f"{name} was {was:.3g} ± {expected:.2g} {unit}, found {found[name]:.3g}")
    lengths = _length(before), _length(after)
    alike = min(lengths) > 0.0 and 1.0 / _LIKE < lengths[0] / lengths[1] < _LIKE
    if alike and "hard_iron" in before and "hard_iron" in after:
        was, now = (np.array([of["hard_iron"]["value"], of["hard_iron"]["sigma"]], float) for of in (before, after))
        expected = np.sqrt(was[1] ** 2 + now[1] ** 2 + (GROWTH["hard_iron"] * lengths[1]) ** 2)
        for axis in np.flatnonzero(np.abs(now[0] - was[0]) > _DOUBTED * expected):
            told.append(
                f"hard_iron_{'xyz'[axis]} was {was[0, axis]:.3g} ± {expected[axis]:.2g} {_UNIT}, found {now[0, axis]:.3g}: "
                "is it mounted as it was?"
            )
    if min(lengths) > 0.0 and not alike:
        told.append(
            f"the field was {lengths[0]:.3g} long, here {lengths[1]:.3g}: another unit? The hard iron was left out"
        )
    return told


def _length(learned: Learned) -> float:
    return float(np.linalg.norm(learned["field"]["value"])) if "field" in learned else 0.0
