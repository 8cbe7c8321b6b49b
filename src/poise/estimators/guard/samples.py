"""Whether a sensor's sample is a measurement: spikes, values that hang, the end of the range."""

from __future__ import annotations

from math import log
from typing import NamedTuple

from poise.math.compiled import compiled
from poise.math.vectors import ABSENT, Vec3, dot, within

FINE, SPIKE, STUCK, CLIPPED = 0, 1, 2, 3
_MEAN_TIME = 0.3  # s over which the usual change from sample to sample is averaged
_JUMP, _STIR = 64.0, 16.0  # squares: 8 times the usual change is a jump, 4 times it shows that something happened
_TOLERANCE = 1e-4  # of the range: one end may lie a quantum further out than the other
_PROVEN = 10.0  # of evidence, a natural logarithm: less than one in 20 000 that the range does not end there
_LIKELY = 2.5  # of it with each sample beyond the least range that data sheets have
_SHARE = 4e-3  # of a new row in how often a component repeats by chance
_LINGERS = 10.0  # the coarser a sensor, the longer it stays at one value about a peak
_AT_FIRST, _RAREST = 0.1, 2e-3  # of that; a smaller share than the last cannot be told from none
_SLOWEST = 0.1  # s between samples: at a slower sensor a jump says nothing
_SHORT = 0.05  # s: no repetition to look at
_IN_MOTION, _AT_REST = 0.5, 1.5  # s of changing samples before one that repeats is thought to hang
_HELD, _NEW = 0.5, 0.125  # share of the changes that show a held sensor, for one; of a new change in that share


class Channel(NamedTuple):
    """What is remembered of one sensor."""

    value: Vec3  # the last sample that was a measurement
    change: float  # mean square of the change from sample to sample
    most: float  # the largest component so far, once more than a sensor shows at rest
    evidence: float  # that the range ends there
    repeats: float  # share of the components that are those of the row before: large in a coarse sensor
    same: float  # s since the value changed
    longest: float  # s that it has been the same before, by nature: a logger may repeat a slower sensor
    lively: float  # s of changing samples, those in motion counted up to 1: a coarse sensor is lively in motion only
    every: float  # s between its samples, as a rule
    rejected: int  # spikes in a row
    held: float  # share of its changes, lately, in which all components changed at once after all had repeated


class Limits(NamedTuple):
    """Where a sensor's samples become doubtful, from what sensors and motions can do."""

    jump: float  # a smaller change is never a spike
    resting: float  # a sensor that rests may show it, over and over
    range: float  # hardly a sensor's range is smaller: data sheets
    least: float  # square of the smallest vector that points somewhere; zeros are silence, but not a gyroscope's
    most: float  # more is no measurement of anything


class Judged(NamedTuple):
    """A sensor's sample: what is left of it, and what was found."""

    value: Vec3  # ABSENT where it is no measurement
    channel: Channel
    verdict: int


@compiled
def fresh(value: Vec3, limits: Limits) -> Channel:
    return Channel(value, 0.0, limits.resting, 0.0, _AT_FIRST, 0.0, 0.0, 0.0, 0.0, 0, 0.0)


@compiled
def change(channel: Channel, value: Vec3) -> float:
    """The square of the change since the last sample; NaN for one that is absent."""
    step = value - channel.value
    return dot(step, step)


@compiled
def is_held(channel: Channel) -> bool:
    """Whether a slower sensor's last sample is repeated in the rows until its next one: every sample must count once.

    Then all components repeat, and change, together. Of a coarse sensor that is quiet each repeats by chance, p of the
    rows: p³ (1 − p)³, 2 % at most, of its rows are a change of all of them after a repetition of all.
    """
    return channel.held > _HELD


@compiled
def repeats(channel: Channel, value: Vec3) -> bool:
    """Whether a sample is the last one over again, and no new one."""
    return is_held(channel) and value == channel.value


@compiled
def own_time(channel: Channel, age: float) -> float:
    """s that a new sample stands for, *age* s after the last row that had one: repetitions stood for nothing."""
    return age + channel.same if is_held(channel) else age


@compiled
def usual(channel: Channel, value: Vec3, changed: float, limits: Limits) -> bool:
    """Whether a sample is an ordinary one: no jump, below all that came before, not repeating for long; NaN is not."""
    return (
        changed < _JUMP * channel.change + limits.jump * limits.jump
        and within(value, (1.0 - _TOLERANCE) * channel.most)
        and dot(value, value) > limits.least
        and channel.rejected == 0
        and channel.same <= _SHORT
    )


@compiled
def taken(channel: Channel, value: Vec3, changed: float, dt: float, still: bool) -> Channel:
    """The channel after a sample that is a measurement, *dt* s after the last one."""
    mean = channel.change + dt / (_MEAN_TIME + dt) * (changed - channel.change)
    every = dt if channel.every == 0.0 else channel.every + 0.1 * (min(dt, 2.0 * channel.every + 0.05) - channel.every)
    if changed == 0.0:
        return Channel(
            value, mean, channel.most, channel.evidence, channel.repeats, channel.same + dt, channel.longest,
            channel.lively, every, 0, channel.held,
        )  # fmt: skip
    longest = max(channel.longest, channel.same)
    lively = channel.lively + dt if channel.lively < (2.0 if still else 1.0) else channel.lively
    old = channel.value
    again = (1.0 if value.x == old.x else 0.0) + (1.0 if value.y == old.y else 0.0) + (1.0 if value.z == old.z else 0.0)
    repeating = channel.repeats + _SHARE * (again * (1.0 / 3.0) - channel.repeats)
    at_once = 1.0 if again == 0.0 and channel.same > 0.0 else 0.0
    held = channel.held + _NEW * (at_once - channel.held)
    return Channel(value, mean, channel.most, channel.evidence, repeating, 0.0, longest, lively, every, 0, held)


@compiled
def jumped(channel: Channel, changed: float, age: float, usual_step: float, limits: Limits) -> bool:
    """Whether a sample is further from the last one than eight times what is usual over that time, and than takes a blow."""
    rows = max(age / usual_step, 1.0) if usual_step > 0.0 else 1.0
    return changed > _JUMP * channel.change * rows * rows + limits.jump * limits.jump and age + channel.same <= _SLOWEST


@compiled
def stirred(channel: Channel, changed: float, least: float) -> bool:
    """Whether a sample changed more than is usual, and than *least*: a blow shows in gyroscope and accelerometer alike."""
    return changed > _STIR * channel.change + least * least


@compiled
def judged(
    channel: Channel, value: Vec3, age: float, spike: bool, moving: bool, still: bool, least: float, limits: Limits
) -> Judged:  # fmt: skip
    """*age* s since the last sample; *moving*: turning so that the value must change; *least* s a value may repeat."""
    size = dot(value, value)
    if not limits.least < size <= limits.most * limits.most:  # NaN too
        return Judged(ABSENT, channel, FINE)
    c = channel
    if spike and c.rejected < 2:  # a third in a row is no spike: something did change
        return Judged(ABSENT, _rejected(c), SPIKE)
    changed = change(c, value)
    c = taken(c, value, changed, age, still)
    needed = _IN_MOTION if moving else _AT_REST
    if c.same > max(least, 4.0 * c.longest, 3.0 * c.every) and c.lively >= needed:
        return Judged(ABSENT, c, STUCK)
    if changed > 0.0 and channel.same > max(least, 4.0 * channel.longest) and channel.lively >= _IN_MOTION:
        c = _forgiven(c, channel.longest)  # it hung: that is not its nature
    largest = max(abs(value.x), abs(value.y), abs(value.z))
    if largest > (1.0 + _TOLERANCE) * c.most:
        return Judged(value, _widened(c, largest, 0.0), FINE)
    if largest >= (1.0 - _TOLERANCE) * c.most:  # by chance as rarely as a component repeats, where the range goes on
        chance = max(c.repeats, _RAREST) * (1.0 + _LINGERS * c.repeats)
        by_this = (_LIKELY if largest >= limits.range else 0.0) - log(min(chance, 1.0))
        c = _widened(c, c.most, min(c.evidence + (by_this if changed > 0.0 else 0.0), 2.0 * _PROVEN))
        return Judged(value, c, CLIPPED if c.evidence >= _PROVEN else FINE)
    return Judged(value, c, FINE)


@compiled
def _rejected(c: Channel) -> Channel:
    return Channel(
        c.value, c.change, c.most, c.evidence, c.repeats, c.same, c.longest, c.lively, c.every, c.rejected + 1, c.held
    )  # fmt: skip


@compiled
def _forgiven(c: Channel, longest: float) -> Channel:
    return Channel(
        c.value, c.change, c.most, c.evidence, c.repeats, c.same, longest, c.lively, c.every, c.rejected, c.held
    )  # fmt: skip


@compiled
def _widened(c: Channel, most: float, evidence: float) -> Channel:
    return Channel(
        c.value, c.change, most, evidence, c.repeats, c.same, c.longest, c.lively, c.every, c.rejected, c.held
    )  # fmt: skip
