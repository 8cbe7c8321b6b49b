"""A level after a loss: samples are gathered before a method starts anew."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from poise.data.packet import Sample
from poise.estimators.protocol import resting_sample, with_sensors
from poise.math.compiled import compiled
from poise.math.quaternions import IDENTITY, Quat, conjugate, exp, renormalized, rotate, shortest_turn
from poise.math.vectors import UP, ZERO, Vec3, dot, present, unit, within

if TYPE_CHECKING:
    from poise.estimators.guard.guard import Guard

REST_RATE, _REST_FORCE = 0.1, 0.05  # rad/s with any bias; share of gravity


class Levelling(NamedTuple):
    """Samples after a loss, gathered to start anew from: one accelerometer sample in motion is no level."""

    turn: Quat  # from the body of now to that of the first of them, by the gyroscope
    force: Vec3  # m/s²·s, in the body of the first: the sum of the specific force
    field: Vec3  # µT·s
    time: float  # s
    moved: bool  # one of them was not at rest


NOT_YET = Levelling(IDENTITY, ZERO, ZERO, 0.0, False)


@compiled
def gathered(guard: Guard, old: Levelling, sample: Sample, rate: Vec3, turned: bool) -> Levelling:
    """The samples since the loss, with this one. *turned*: how far it turned since the last row is known; otherwise anew."""
    if not turned:
        return NOT_YET
    turn = renormalized(old.turn * exp(sample.dt * rate)) if old.time > 0.0 else IDENTITY
    if not present(sample.acc):  # of a slower accelerometer, or lost
        return Levelling(turn, old.force, old.field, old.time, old.moved)
    force = old.force + sample.acc_dt * rotate(turn, sample.acc)
    field = old.field + sample.mag_dt * rotate(turn, sample.mag) if present(sample.mag) else old.field
    return Levelling(turn, force, field, old.time + sample.acc_dt, old.moved or not at_rest(sample, guard.gravity))


@compiled
def enough(guard: Guard, levelling: Levelling) -> bool:
    return levelling.time >= (guard.level_time if levelling.moved else 0.04 * guard.level_time)


@compiled
def mean_of(levelling: Levelling, sample: Sample) -> Sample:
    """The sample with the mean force and field of the levelling, in the body of now."""
    back = conjugate(levelling.turn)
    acc = rotate(back, levelling.force / levelling.time)
    mag = rotate(back, levelling.field / levelling.time) if dot(levelling.field, levelling.field) > 0.0 else sample.mag
    acc = acc if dot(acc, acc) > 1e-6 else sample.acc
    return Sample(sample.dt, sample.gyr, acc, mag, 0.0, 0.0, levelling.time, levelling.time, 0.0)


@compiled
def to_restart_from(guard: Guard, attitude: Quat, sample: Sample, lost: bool) -> Sample:
    """The sample to start anew from: what is known of tilt and heading stays, the rest is the sample's.

    After a loss the tilt is the accelerometer's; a first magnetometer sample changes the heading only, and that of a
    method without magnetometer stays what it was.
    """
    if lost:
        attitude = shortest_turn(unit(rotate(attitude, sample.acc)), UP) * attitude
    rest = resting_sample(attitude, guard.declination)
    mag = sample.mag if guard.follows_mag and present(sample.mag) else rest.mag
    return with_sensors(sample, sample.gyr, rest.acc, mag)


@compiled
def at_rest(sample: Sample, gravity: float) -> bool:
    """No turning, and the length of gravity: an acceleration could then tilt the specific force by 18° at most."""
    least, most = (1.0 - _REST_FORCE) * gravity, (1.0 + _REST_FORCE) * gravity
    return within(sample.gyr, REST_RATE) and least * least < dot(sample.acc, sample.acc) < most * most
