"""Whether the field points anywhere: along gravity, as at the magnetic poles or over iron, it tells no heading."""

from __future__ import annotations

from typing import NamedTuple

from poise.data.packet import Sample
from poise.estimators.guard.levelling import at_rest
from poise.math.compiled import compiled
from poise.math.vectors import Vec3, cross, dot, present

_LEAST = 0.06  # of the field, across gravity: of 50 µT the 3 µT below which a ship's compass counts as useless
_NEAR = 0.3  # the same by one accelerometer sample, which motion tilts: further away, no need to look closer
_CLEAR = 0.37  # sine of 22°: further than what moves a resting accelerometer can tilt it
_WHILE, _LONGEST, _KNOWN = 1.0, 2.0, 3.0  # s
_EVERY = 0.1  # s between two looks: one a sample costs more than all of the guard's other checks


class Field(NamedTuple):
    """For how long the field has pointed along gravity, and elsewhere."""

    along: float  # s, less what it pointed elsewhere since
    across: float  # s, up to what makes a heading known
    since: float  # s since it was looked at


@compiled
def begun(first: Sample, gravity: float) -> Field:
    """What a first sample says."""
    if _across(first.acc, first.mag, _LEAST):
        clear = at_rest(first, gravity) and _across(first.acc, first.mag, _CLEAR)
        return Field(0.0, _KNOWN if clear else 0.0, 0.0)
    return Field(_LONGEST if present(first.acc) and _points(first.mag) else 0.0, 0.0, 0.0)


@compiled
def later(field: Field, dt: float) -> Field:
    """*field* after *dt* s in which nobody looked."""
    return Field(field.along, field.across, field.since + dt)


@compiled
def due(field: Field, mag: Vec3) -> bool:
    """Whether it is time to look, and there is a field to look at."""
    return field.since >= _EVERY and _points(mag)


@compiled
def plainly_across(field: Field, acc: Vec3, mag: Vec3) -> bool:
    """Whether a sample says nothing new: as ever, its field is far from the specific force."""
    return field.along == 0.0 and field.across >= _KNOWN and _across(acc, mag, _NEAR)


@compiled
def looked_at(field: Field, up: Vec3, mag: Vec3, longest: float) -> Field:
    """*field* after a look; *up* is the method's, which motion does not tilt. It stands for *longest* s at most."""
    time = min(field.since, longest)
    if _across(up, mag, _LEAST):
        return Field(max(field.along - time, 0.0), min(field.across + time, _KNOWN), 0.0)
    return Field(min(field.along + time, _LONGEST), field.across, 0.0)


@compiled
def vertical(field: Field) -> bool:
    """Whether it has pointed along gravity for so long that the magnetometer is left out."""
    return field.along > _WHILE


@compiled
def unknown(field: Field) -> bool:
    """Whether it seems to point along gravity, and has not pointed elsewhere for long before: no heading came from it."""
    return field.along > 0.0 and field.across < _KNOWN


@compiled
def _points(mag: Vec3) -> bool:
    """Whether there is a field: zeros are a sensor that says nothing, not one that points along gravity."""
    return present(mag) and dot(mag, mag) > 0.0


@compiled
def _across(up: Vec3, mag: Vec3, share: float) -> bool:
    """Whether more than *share* of the field is horizontal."""
    sideways = cross(up, mag)
    return dot(sideways, sideways) > share * share * dot(up, up) * dot(mag, mag)
