"""Vertical motion from the specific force: whether somebody lifts the body, and whether nothing carries it."""

from __future__ import annotations

from math import exp, nan
from typing import NamedTuple

from poise.data.flags import ACC_CLIPPED, ACC_IGNORED, STUCK_ACC
from poise.math.compiled import compiled
from poise.math.vectors import Vec3, dot, norm, within

_MEMORY = 0.7  # s: how long a speed and a height are remembered
_MEAN_TIME = 3.0  # s: an accelerometer's offset and scale error are gone from the mean after that
_STEADY_TIME = 0.3  # s: and after that where the force holds steady, which no lift does
_SHORT_TIME = 0.25  # s, of the mean that steadiness is judged against
_STEADY_FORCE, _STEADY_RATE, _STEADY_AFTER = 0.3, 0.3, 0.5  # m/s², rad/s, s
_BLOW = 4.0  # gravities: a sample counts for no more, so that a blow is no lift
_NONE = 100.0  # gravities: more is no measurement
_STALE = 0.2  # s without an accelerometer sample after which nothing is known
_DOUBTED = ACC_IGNORED | ACC_CLIPPED | STUCK_ACC


class Vertical(NamedTuple):
    force: float  # m/s², length of the last specific force; NaN where there is none
    age: float  # s since then
    mean: float  # m/s², the specific force along the vertical, slowly
    seen: float  # s that the mean is made of
    short: float  # m/s², the same, fast
    steady: float  # s that it has held steady
    speed: float  # m/s upward, lately
    height: float  # m upward, lately


GROUND = Vertical(nan, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@compiled
def moved(old: Vertical, acc: Vec3, up: Vec3, rate: float, flags: int, dt: float, gravity: float) -> Vertical:
    """The vertical motion after a sample; *up* is the vertical in the sensor's frame, NaN where it is not known.

    Speed and height are integrals that forget, of what is left without the slow mean: they tell a lift within a second
    from a bump, which returns, and from an error of the accelerometer, which stays.
    """
    age = old.age + dt
    if not within(acc, _NONE * gravity) or flags & _DOUBTED != 0:  # NaN: no sample
        if age > _STALE:
            return Vertical(nan, age, old.mean, old.seen, old.short, 0.0, 0.0, 0.0)
        return Vertical(old.force, age, old.mean, old.seen, old.short, old.steady, old.speed, old.height)
    force, along = norm(acc), dot(acc, up)
    if along - along != 0.0 or age > _STALE:  # NaN: the attitude is not known
        return Vertical(force, 0.0, old.mean, old.seen, old.short, 0.0, 0.0, 0.0)
    if old.seen == 0.0:
        return Vertical(force, 0.0, along, max(age, 1e-3), along, 0.0, 0.0, 0.0)
    calm = abs(along - old.short) < _STEADY_FORCE and not rate >= _STEADY_RATE  # NaN: the rate is not known
    steady = old.steady + age if calm else 0.0
    still = steady > _STEADY_AFTER
    seen = min(old.seen + age, _MEAN_TIME)
    rise = min(max(along - old.mean, -_BLOW * gravity), _BLOW * gravity)
    left = exp(-age / (_STEADY_TIME if still else _MEMORY))
    speed = left * (old.speed + age * rise)
    height = left * (old.height + age * speed)
    mean = old.mean + age / ((_STEADY_TIME if still else seen) + age) * rise
    short = old.short + age / (_SHORT_TIME + age) * (old.mean + rise - old.short)
    return Vertical(force, 0.0, mean, seen, short, steady, speed, height)
