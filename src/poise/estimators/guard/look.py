"""A look at a row: what its stamp and its samples are worth, what is absent, how far the body may have turned unmeasured."""

from __future__ import annotations

from math import pi, sqrt
from typing import TYPE_CHECKING, NamedTuple

from poise.data.flags import (
    ACC_CLIPPED,
    ACC_IGNORED,
    ACC_MISSING,
    GAP,
    GYR_CLIPPED,
    GYR_IGNORED,
    GYR_MISSING,
    MAG_CLIPPED,
    MAG_IGNORED,
    MAG_MISSING,
    STUCK_ACC,
    STUCK_GYR,
    STUCK_MAG,
    UNSETTLED,
)
from poise.data.packet import Sample
from poise.estimators.guard.field import vertical
from poise.estimators.guard.levelling import REST_RATE
from poise.estimators.guard.samples import (
    CLIPPED,
    SPIKE,
    STUCK,
    Channel,
    Limits,
    change,
    fresh,
    judged,
    jumped,
    own_time,
    repeats,
    stirred,
    taken,
    usual,
)
from poise.estimators.guard.stamps import Pace, counted_on, evenly, timed
from poise.math.compiled import compiled
from poise.math.vectors import ABSENT, ZERO, Vec3, cross, dot, norm, present, within

if TYPE_CHECKING:
    from poise.estimators.guard.guard import Guard, Past

_TURNING = 0.5  # rad/s about one axis at least: such a rate is not met again by chance
_SURE = 0.01  # rad of doubt: no longer worth a thought

_OFF_LINE = 5e-3  # (share of the difference)² about each axis, by which the turn between two rates is off the line
_LEFT = 0.1  # of the doubt of a few rows that a straight line between their neighbours has made good


class Look(NamedTuple):
    """What a row is found to be."""

    gyr: Channel
    acc: Channel
    mag: Channel
    pace: Pace
    sample: Sample  # what the method may see of it, and how long it lasts
    goes_on: bool  # the method steps; otherwise it waits, or is started
    usable: bool  # gyroscope and accelerometer were measured
    turned: bool  # how far it turned is known, but for a few rows at most: good for starting anew from
    mag_seen: bool
    gyr_absent: float  # s
    acc_absent: float
    mag_absent: float
    lost: bool
    doubt: float  # rad
    flags: int


@compiled
def common(guard: Guard, past: Past, sample: Sample) -> bool:
    """Whether nothing has to be looked at: an even step, and samples as they usually are."""
    gyr, acc, mag = past.gyr, past.acc, past.mag
    by_mag = change(mag, sample.mag)
    if by_mag - by_mag == 0.0 and sample.mag != ZERO:
        field = usual(mag, sample.mag, by_mag, mag_limits(guard, mag.value)) and past.aligned and past.mag_seen
        field = field and not vertical(past.field)
    else:  # a large enough number may overflow in the square: that is for a closer look
        silent = past.mag_absent + sample.dt > max(guard.mag_loss, 3.0 * mag.every)
        field = not _measured(sample.mag) and not (silent and past.mag_seen)
    return (
        past.plain
        and field
        and evenly(past.pace, sample.dt, guard.gap)
        and usual(gyr, sample.gyr, change(gyr, sample.gyr), gyr_limits(guard))
        and not _dropped(gyr, sample.gyr)
        and usual(acc, sample.acc, change(acc, sample.acc), acc_limits(guard))
    )


@compiled
def _measured(field: Vec3) -> bool:
    """Whether a magnetometer said anything: zeros are no sample, as NaN is none."""
    return present(field) and field != ZERO


@compiled
def untouched(guard: Guard, past: Past, sample: Sample) -> Look:
    """What a common row is found to be: what the method may see of it is all that was measured."""
    gyr, acc, mag, dt = past.gyr, past.acc, past.mag, sample.dt
    still, silent, has_mag = within(sample.gyr, REST_RATE), past.mag_absent + dt, _measured(sample.mag)
    if has_mag:
        mag = taken(mag, sample.mag, change(mag, sample.mag), silent, still)
    clean = Sample(
        dt, sample.gyr, ABSENT if repeats(acc, sample.acc) else sample.acc, sample.mag if has_mag else ABSENT,
        sample.acc_age, sample.mag_age, min(own_time(acc, dt), guard.gap), min(silent, guard.gap), 0.0,
    )  # fmt: skip
    return Look(
        taken(gyr, sample.gyr, change(gyr, sample.gyr), dt, still), taken(acc, sample.acc, change(acc, sample.acc), dt, still),
        mag, counted_on(past.pace, dt), clean, True, True, True, past.mag_seen,
        0.0, 0.0, 0.0 if has_mag else silent, False, 0.0, 0,
    )  # fmt: skip


@compiled
def examined(guard: Guard, past: Past, sample: Sample) -> Look:
    """A row that is not a common one: its stamp and each of its samples is judged."""
    gyr, acc, mag = past.gyr, past.acc, past.mag
    by_gyr, by_acc, by_mag = change(gyr, sample.gyr), change(acc, sample.acc), change(mag, sample.mag)
    goes_on = sample.dt > guard.longest_loss and _continues(past, sample.gyr, by_gyr, by_acc, by_mag)
    repeated = by_gyr == 0.0 and not by_acc > 0.0 and not by_mag > 0.0
    row = timed(past.pace, sample.dt, repeated, goes_on, guard.gap, guard.longest_loss)
    dt, flags = row.dt, row.flags
    if dt == 0.0:  # no time can be given to it: nothing moves, and too many of them lose the attitude
        lost = past.lost or row.pace.held > guard.longest_disorder
        nothing = Sample(0.0, gyr.value, ABSENT, ABSENT, 0.0, 0.0, 0.0, 0.0, 0.0)
        return Look(
            gyr, acc, mag, row.pace, nothing, False, False, False, past.mag_seen,
            past.gyr_absent, past.acc_absent, past.mag_absent, lost, past.doubt, flags,
        )  # fmt: skip

    # What the samples are worth
    gyr_age, acc_age, mag_age = past.gyr_absent + dt, past.acc_absent + dt, past.mag_absent + dt
    still = within(gyr.value, REST_RATE)
    of_gyr, of_acc, of_mag = gyr_limits(guard), acc_limits(guard), mag_limits(guard, mag.value)
    usual_step = row.pace.step
    # A jump of the rate is an angular acceleration, which an accelerometer 1 cm off the axis feels
    felt = max(0.1 * guard.gravity, 0.01 * sqrt(by_gyr) / dt)
    spike = jumped(gyr, by_gyr, gyr_age, usual_step, of_gyr) and not stirred(acc, by_acc, felt)
    spike = spike or _dropped(gyr, sample.gyr)
    found = judged(gyr, sample.gyr, gyr_age, spike, not still, still, guard.stuck_time, of_gyr)
    gyr = found.channel
    has_gyr = present(found.value)
    spiked = present(sample.acc) and jumped(acc, by_acc, acc_age, usual_step, of_acc)
    shaken = has_gyr and stirred(past.gyr, by_gyr, REST_RATE)
    gyr_verdict = found.verdict
    turning = _across(gyr.value, acc.value) > REST_RATE
    found = judged(acc, sample.acc, acc_age, spiked and not shaken, turning, still, guard.stuck_time, of_acc)
    acc, acc_verdict = found.channel, found.verdict
    has_acc = present(found.value)
    turning = _across(gyr.value, mag.value) > REST_RATE
    spiked = past.mag_seen and jumped(mag, by_mag, mag_age, usual_step, of_mag)
    if not past.mag_seen and mag.most == 0.0 and present(sample.mag):
        mag, of_mag = fresh(sample.mag, mag_limits(guard, sample.mag)), mag_limits(guard, sample.mag)
    since = min(mag_age, max(mag.every, dt)) if vertical(past.field) else mag_age  # left out, but there
    found = judged(mag, sample.mag, since, spiked, turning, still, guard.stuck_time, of_mag)
    mag, mag_verdict = found.channel, found.verdict
    has_mag = present(found.value) and mag_verdict != CLIPPED and not vertical(past.field)
    flags |= _told(gyr_verdict, GYR_IGNORED, STUCK_GYR, GYR_CLIPPED)
    flags |= _told(acc_verdict, ACC_IGNORED, STUCK_ACC, ACC_CLIPPED)
    if guard.follows_mag:
        flags |= _told(mag_verdict, MAG_IGNORED, STUCK_MAG, MAG_CLIPPED)

    # What is absent, and since when
    gyr_absent = 0.0 if has_gyr else gyr_age
    acc_absent = 0.0 if has_acc else acc_age
    mag_absent = 0.0 if has_mag else mag_age
    mag_seen = past.mag_seen or has_mag
    flags |= 0 if has_gyr else GYR_MISSING
    flags |= ACC_MISSING if acc_absent > max(guard.acc_loss, 3.0 * acc.every) else 0
    silent = mag_absent > max(guard.mag_loss, 3.0 * mag.every)
    flags |= MAG_MISSING if mag_seen and guard.follows_mag and silent else 0
    rate = gyr.value

    # How far it may have turned unmeasured
    doubt, lost = past.doubt, past.lost
    if has_gyr and 0.0 < past.gyr_absent <= 0.25 * guard.gap and flags & GAP == 0:  # made good: see _over_loss
        doubt = max(doubt - (1.0 - _LEFT) * _unmeasured(past.gyr.value, past.gyr_absent), 0.0)
    hidden = 0.0  # rad
    if not has_gyr or flags & GAP != 0:
        stuck = past.gyr.same if gyr_verdict == STUCK and past.gyr_absent == 0.0 else 0.0
        hidden = _unmeasured(rate, dt + stuck)
        lost = lost or gyr_absent > guard.longest_loss or dt > guard.longest_loss
    elif gyr_verdict == CLIPPED:
        hidden = 0.25 * gyr.most * dt
    short = flags & GAP == 0 and gyr_verdict != STUCK and 0.0 < gyr_absent <= 0.25 * guard.gap
    turned = hidden == 0.0 or short
    variance = _of_line(past, by_gyr, dt, usual_step) if has_gyr else 0.0
    if hidden > 0.0:
        doubt = min(doubt + hidden, pi)
        if not short:  # of one run of rows the errors add up; a short one may yet be made good
            made_up = 0.0 < past.gyr_absent <= 0.25 * guard.gap
            variance = doubt * doubt - (0.0 if made_up else min(past.doubt, doubt) ** 2)
        lost = lost or doubt > guard.lost_doubt
    elif acc_verdict == CLIPPED:  # a force that is too small by as much tilts a method that settles in that time
        tilt = 0.25 * acc.most * dt / (guard.gravity * guard.settle_time)
        doubt = max(doubt, min(doubt + tilt, guard.valid_doubt))
    elif doubt > 0.0 and has_acc:
        doubt = doubt * guard.settle_time / (guard.settle_time + dt) if doubt > _SURE else 0.0
    lost = lost or past.pace.held > guard.longest_disorder
    if not past.started:  # nothing that could be lost
        doubt, lost = 0.0, False
    usable = has_acc and has_gyr
    goes_on = past.started and not lost and (past.aligned or not has_mag or not guard.follows_mag)
    force = sample.acc if has_acc else ABSENT
    if goes_on:  # a method that waits to be started takes what there is, repeated or not
        acc_age = own_time(past.acc, acc_age)
        if repeats(past.acc, force):
            force = ABSENT
    clean = Sample(
        dt, _over_loss(guard, past, rate, dt, usual_step) if has_gyr else rate,
        force, sample.mag if has_mag else ABSENT, sample.acc_age, sample.mag_age,
        min(acc_age, guard.gap), min(mag_age, guard.gap), variance,
    )  # fmt: skip
    flags |= UNSETTLED if goes_on and doubt > guard.valid_doubt else 0
    return Look(
        gyr, acc, mag, row.pace, clean, goes_on, usable, turned, mag_seen,
        gyr_absent, acc_absent, mag_absent, lost, doubt, flags,
    )  # fmt: skip


@compiled
def _dropped(gyr: Channel, rate: Vec3) -> bool:
    """Whether a rate is zero to the last bit that was none the row before: a driver's answer where it had none."""
    return dot(rate, rate) == 0.0 and not within(gyr.value, REST_RATE)


@compiled
def _continues(past: Past, rate: Vec3, by_gyr: float, by_acc: float, by_mag: float) -> bool:
    """Whether the samples go on from those before as if no time had passed: then it was the clock that jumped.

    At rest without a magnetometer the heading could have changed meanwhile.
    """
    known = past.mag_absent == 0.0 and past.mag_seen
    by_field = not stirred(past.mag, by_mag, 0.0) if known else not within(rate, _TURNING)
    return (
        past.plain
        and by_field
        and by_gyr - by_gyr == 0.0
        and by_acc - by_acc == 0.0
        and not stirred(past.gyr, by_gyr, 0.0)
        and not stirred(past.acc, by_acc, 0.0)
    )


@compiled
def _over_loss(guard: Guard, past: Past, rate: Vec3, dt: float, usual_step: float) -> Vec3:
    """The mean rate of a step in which rows were lost: between two samples the rate goes straight from one to the other.

    Where rows were there and the gyroscope's samples were not, the last rate was taken for them: made good here.
    """
    before = past.gyr.value
    if past.gyr_absent > 0.0:
        return rate + (0.5 * past.gyr_absent / dt) * (rate - before) if past.gyr_absent <= 0.25 * guard.gap else rate
    if usual_step > 0.0 and 1.5 * usual_step < dt <= guard.gap:
        return rate + (0.5 * (dt - usual_step) / dt) * (before - rate)
    return rate


@compiled
def _of_line(past: Past, by_gyr: float, dt: float, usual_step: float) -> float:
    """rad²: how well a straight line between two rates tells the turn between them: to a fourteenth of their difference.

    About each axis: on recordings of motion it is a sixteenth, of taps a sixth.
    """
    missing = past.gyr_absent if past.gyr_absent > 0.0 else max(dt - usual_step, 0.0)
    return _OFF_LINE * by_gyr * missing * missing if usual_step > 0.0 and missing > 0.5 * usual_step else 0.0


@compiled
def _unmeasured(rate: Vec3, time: float) -> float:
    """rad: how far the body may have turned otherwise; a rate goes on about half as wrong as it is large."""
    return 0.5 * (norm(rate) + 0.5) * time


@compiled
def _told(verdict: int, spike: int, stuck: int, clipped: int) -> int:
    if verdict == SPIKE:
        return spike
    if verdict == STUCK:
        return stuck
    return clipped if verdict == CLIPPED else 0


@compiled
def _across(rate: Vec3, v: Vec3) -> float:
    """rad/s: how fast a rate turns a direction; a turn about it does not show in it."""
    length = norm(v)
    return norm(cross(rate, v)) / length if length > 0.0 else 0.0


@compiled
def gyr_limits(guard: Guard) -> Limits:
    """A jump of 3 rad/s between two samples is beyond limbs and robots; no gyroscope ends below 125 deg/s."""
    return Limits(3.0, 1.0, 2.1, -1.0, guard.largest_gyr)


@compiled
def acc_limits(guard: Guard) -> Limits:
    """A jump of 4 g takes a blow; few accelerometers end below 2 g; at rest none shows more than g and its own error."""
    return Limits(4.0 * guard.gravity, 1.1 * guard.gravity, 18.0, 1e-6, guard.largest_acc)


@compiled
def mag_limits(guard: Guard, last: Vec3) -> Limits:
    """Whatever its unit: a jump is as long as the field itself, and no range ends below twice that of the Earth."""
    length = norm(last)
    return Limits(length, 2.0 * length, 2.0 * length, 1e-18, guard.largest_mag)
