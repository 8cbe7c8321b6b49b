"""Whether the field that the heading was set by is the one that the sensor has turned in since.

A field that was seen at one place at rest may be that of a magnet there: a dock, a table of steel. One that stays the same
while the sensor turns and moves is of the region. Step 12, eq. 31 and 32 of ``docs/methods/self-calibrating.md``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from poise.estimators.self_calibrating.iron import NOT_SHOWN, Shown, better, left_by, seems, set_by_field, shown_by
from poise.estimators.self_calibrating.lengths import fit_of_lengths, is_time_to_look, take_lengths
from poise.estimators.self_calibrating.model import (
    AGREED,
    ANOTHER_IRON,
    ANOTHER_NORTH,
    BY_FIND,
    CONFIRMED,
    FOUND,
    GOES_ON,
    IRON,
    LENGTHS,
    MEAN,
    OPEN,
    SEEN,
    SQUARE,
    Floats,
    Sensor,
    Sums,
    put,
    vector,
)
from poise.estimators.self_calibrating.turns import add_to_turns, fit_of_turns, forget_turns, mean_field, square_of
from poise.estimators.self_calibrating.unproven import ANY, MOST, begin_open, narrow, shrink, trace
from poise.math.compiled import compiled
from poise.math.matrices import I3, Mat3
from poise.math.vectors import ZERO, Vec3, dot, norm

if TYPE_CHECKING:
    from poise.estimators.self_calibrating.causal import SelfCalibrating

_TIME = 60.0  # s of turning that are remembered
_LEAST = 12.5  # s of it that tell: errors of the field last some seconds
_ALIKE = 0.1  # lengths: mean fields that differ by less are one
_FAR = 4.0  # sigmas
_AGREES = 2.5  # s of turning in which the field agreed with the usual one: that is not of one place only
_EVEN = 0.15  # lengths: one that strays by more from its mean, as the sensor turns, is no field of the region


@compiled
def look_at_field(
    method: SelfCalibrating, P: Floats, s: Sums, seen: Vec3, R: Mat3, rate_square: float, known: Vec3, now: Sensor
) -> tuple[Sensor, float, float]:
    """What is known after a block's field, by what angle the attitude is to be turned about up, and what became of all that.

    *seen* is the field without the *known* iron, Earth frame and lengths, *R* the mean R₀.
    """
    seconds = take_lengths(method, P, s, now.length) if method.least_iron < ANY else 0.0
    if seconds == 0.0:
        return now, 0.0, GOES_ON
    take_field(P, seen, R, known, now.field, seconds)
    if not is_time_to_look(P):
        return now, 0.0, GOES_ON
    by_lengths, by_turns = fit_of_lengths(method, P, known), fit_of_turns(method, P, known)
    rules = better(by_lengths, by_turns)
    V, beside = left_by(rules), seems(rules, known)
    if rules.length > 0.0:
        narrow(P, V, beside)
    # The lengths need no attitude, so that theirs is asked first, whichever is better.
    shown = shown_by(method, P, known, by_lengths) if by_lengths.length > 0.0 else NOT_SHOWN
    if shown.length == 0.0 and by_turns.length > 0.0:
        shown = shown_by(method, P, known, by_turns)
    if shown.length > 0.0:  # 10. Hard iron
        now, turned = set_by_field(method, P, shown, seen + R @ (known - shown.iron), rate_square, now)
        begin_open(P, method.least_iron)
        narrow(P, (1.0 / (shown.length * shown.length)) * shown.covariance, ZERO)
        P[OPEN, BY_FIND] = 1.0
        P[LENGTHS, FOUND] += 1.0
        forget_field(P)
        return now, turned, ANOTHER_IRON
    field = another_field(P, known, now.field)
    if field == ZERO:
        return now, 0.0, GOES_ON
    if rules.length == 0.0 or may_be_on_sensor(V + dot(beside, beside) * I3, R.z, field, now.field):
        return now, 0.0, GOES_ON
    # 12. Another field than the one that the heading was set by
    C = Mat3(vector(P, IRON, IRON), vector(P, IRON + 1, IRON), vector(P, IRON + 2, IRON))
    now, turned = set_by_field(method, P, Shown(known, norm(field), C, spread_of(P, known)), field, 0.0, now)
    shrink(P, norm(field))
    forget_field(P)
    return now, turned, ANOTHER_NORTH


@compiled
def may_be_on_sensor(V: Mat3, up: Vec3, field: Vec3, usual: Vec3) -> bool:
    """Whether iron that came to the sensor may be what makes the *field* another than the *usual* one (eq. 32).

    Not where what this look leaves open of that, V, could turn no heading, or is far less than the change; *up* in the body
    frame.
    """
    change = field - usual
    across = trace(V) - dot(up, V @ up)
    north = field.x * field.x + field.y * field.y
    return across > max(2.0 * MOST * MOST * north, dot(change, change) / (_FAR * _FAR))


@compiled
def forget_seen(P: Floats) -> None:
    """The frame in which the field was seen has turned."""
    put(P, OPEN, MEAN, ZERO)
    P[OPEN, SQUARE] = P[OPEN, SEEN] = P[OPEN, AGREED] = 0.0
    forget_turns(P)


@compiled
def forget_field(P: Floats) -> None:
    """The heading was set by another field: nothing has confirmed that yet."""
    forget_seen(P)
    P[OPEN, CONFIRMED] = 0.0


@compiled
def take_field(P: Floats, seen: Vec3, R: Mat3, known: Vec3, usual: Vec3, seconds: float) -> None:
    """A block's field *seen*, without the *known* iron, Earth frame and lengths; it stands for *seconds* of turning.

    The means are with that iron, which is another when they are read.
    """
    n = (1.0 - seconds / (_TIME + seconds)) * float(P[OPEN, SEEN]) + seconds
    share, mean, field, off = seconds / n, vector(P, OPEN, MEAN), seen + R @ known, seen - usual
    put(P, OPEN, MEAN, mean + share * (field - mean))
    P[OPEN, SQUARE] += share * (dot(field, field) - float(P[OPEN, SQUARE]))
    P[OPEN, SEEN] = n
    if dot(off, off) < _ALIKE * _ALIKE:
        P[OPEN, AGREED] += seconds
    add_to_turns(P, R, field, share)


@compiled
def another_field(P: Floats, known: Vec3, usual: Vec3) -> Vec3:
    """The mean field, without the *known* iron, where it is even, another than the *usual* one, and nothing spoke for that.

    Else nothing (eq. 31).
    """
    if P[OPEN, CONFIRMED] != 0.0 or P[OPEN, SEEN] < _LEAST:
        return ZERO
    mean = mean_field(P, known)
    off = mean - usual
    if spread_of(P, known) > _EVEN * _EVEN * dot(mean, mean):
        return ZERO
    if dot(off, off) < _ALIKE * _ALIKE and abs(mean.x) < MOST * mean.y:
        P[OPEN, CONFIRMED] = 1.0
        return ZERO
    return mean if P[OPEN, AGREED] < _AGREES else ZERO


@compiled
def spread_of(P: Floats, known: Vec3) -> float:
    """Mean square of what the field, without the *known* iron, has strayed from its mean, lengths²."""
    mean = mean_field(P, known)
    return max(square_of(P, known) - dot(mean, mean), 0.0)
