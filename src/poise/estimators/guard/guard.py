"""Guard: keeps what is not a measurement away from a method, bridges short losses, restarts after long ones, and says so."""

from __future__ import annotations

from math import cos, pi, radians, sqrt
from typing import Annotated, Any, NamedTuple

from poise.data.flags import (
    ACC_CLIPPED,
    ACC_IGNORED,
    ACC_MISSING,
    GAP,
    GYR_CLIPPED,
    GYR_IGNORED,
    GYR_MISSING,
    HEADING_ARBITRARY,
    INITIALISING,
    LOST,
    MAG_CLIPPED,
    MAG_IGNORED,
    MAG_MISSING,
    RESET,
    STUCK_ACC,
    STUCK_GYR,
    STUCK_MAG,
    UNSETTLED,
)
from poise.data.packet import Output, Sample
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
    stirred,
    taken,
    usual,
)
from poise.estimators.guard.stamps import Pace, counted_on, evenly, timed
from poise.estimators.protocol import output, restart, resting_sample, start, step, with_sensors
from poise.math.compiled import compiled
from poise.math.quaternions import IDENTITY, Quat, conjugate, exp, renormalized, rotate, shortest_turn, up_in_body
from poise.math.vectors import ABSENT, UP, ZERO, Vec3, cross, dot, norm, present, unit, within

_REST_RATE, _REST_FORCE = 0.1, 0.05  # rad/s with any bias; share of gravity
_SURE = 0.01  # rad of doubt: no longer worth a thought
_LEVELLED = 0.12  # rad: how far the mean force of three seconds in motion may be from up


class Levelling(NamedTuple):
    """Samples after a loss, gathered to start anew from: one accelerometer sample in motion is no level."""

    turn: Quat  # from the body of now to that of the first of them, by the gyroscope
    force: Vec3  # m/s²·s, in the body of the first: the sum of the specific force
    field: Vec3  # µT·s
    time: float  # s
    moved: bool  # one of them was not at rest


_NOT_YET = Levelling(IDENTITY, ZERO, ZERO, 0.0, False)


class State(NamedTuple):
    inner: Any
    gyr: Channel  # its value is the last rate that was measured: what a loss is bridged with
    acc: Channel
    mag: Channel
    pace: Pace
    levelling: Levelling
    dt: float  # s that the last row was taken to last
    plain: bool  # nothing is absent, lost, doubtful or to be waited for
    started: bool  # an accelerometer sample has given an attitude
    aligned: bool  # the heading is known: from a magnetometer sample, or given at the start
    mag_seen: bool  # the magnetometer has spoken
    lost: bool  # the motion was not measured for too long: start anew when it is again
    gyr_absent: float  # s
    acc_absent: float
    mag_absent: float
    astray: float  # s at rest with a tilt that gravity contradicts
    doubt: float  # rad: how far the body may have turned unmeasured
    flags: int


class Guard(NamedTuple):
    """Lets only measurements reach *method*, in time that runs forward, and says what it did to whom.

    A lost gyroscope sample is bridged with the last rate; after too long a loss the method starts anew from
    accelerometer and magnetometer and keeps the bias it had. So it does at rest, where gravity says that the tilt is
    wrong. Before the first usable accelerometer sample the attitude is NaN and not valid.
    """

    method: Any
    declination: Annotated[float, "rad", "the method's own, so that a restart keeps the heading", (-3.2, 3.2)] = 0.0
    gravity: Annotated[float, "m/s²", "length of gravity, which a resting accelerometer measures", (0.1, 100.0)] = (
        9.80665
    )
    follows_mag: Annotated[
        bool,
        "yes/no",
        "the method follows a magnetometer: starts anew at a late first sample of it; its loss is flagged",
    ] = True
    gap: Annotated[float, "s", "a longer step between stamps is flagged"] = 0.2
    longest_loss: Annotated[float, "s", "without rotation for longer, the attitude is unknown"] = 1.0
    acc_loss: Annotated[float, "s", "without accelerometer for longer, samples are flagged"] = 0.2
    mag_loss: Annotated[float, "s", "without a magnetometer that was there before for longer, samples are flagged"] = (
        0.2
    )
    stuck_time: Annotated[float, "s", "a sensor that was lively and repeats a value for longer, hangs"] = 0.2
    astray_angle: Annotated[float, "rad", "a tilt further from gravity, at rest, is wrong", (0.34, 3.2)] = radians(20.0)
    astray_time: Annotated[float, "s", "how long it may stay so before the method starts anew"] = 2.0
    level_time: Annotated[float, "s", "of samples in motion that the method starts anew from after a loss"] = 3.0
    valid_doubt: Annotated[float, "rad", "an attitude that may have turned further unmeasured is not valid"] = radians(
        6.0
    )
    lost_doubt: Annotated[float, "rad", "one that may have turned further than this is unknown"] = radians(30.0)
    settle_time: Annotated[float, "s", "in which a method takes back all but 37 % of such a turn", (1e-3, 1e6)] = 3.0
    longest_disorder: Annotated[int, "rows", "held for want of a stamp in a row for more, the attitude is unknown"] = 20
    largest_gyr: Annotated[float, "rad/s", "a larger rate is no measurement"] = 200.0
    largest_acc: Annotated[float, "m/s²", "a larger specific force is no measurement"] = 5000.0
    largest_mag: Annotated[float, "µT", "a larger field is no measurement"] = 1e6

    def start(self, sample: Sample, bias: Vec3) -> State:
        acc = sample.acc if dot(sample.acc, sample.acc) <= self.largest_acc**2 else ABSENT
        mag = sample.mag if dot(sample.mag, sample.mag) <= self.largest_mag**2 else ABSENT
        acc = acc if dot(acc, acc) > _acc_limits(self).least else ABSENT
        mag = mag if dot(mag, mag) > _mag_limits(self, ZERO).least else ABSENT
        gyr = sample.gyr if dot(sample.gyr, sample.gyr) <= self.largest_gyr**2 else bias  # NaN is not
        seen = present(acc)
        placeholder = resting_sample(IDENTITY, self.declination)
        first = with_sensors(sample, gyr, acc if seen else placeholder.acc, mag if seen else ABSENT)
        inner = start(self.method, first, bias)
        has_mag = present(mag)
        aligned = seen and has_mag
        flags = (0 if seen else INITIALISING) | (0 if aligned else HEADING_ARBITRARY)
        field = mag if has_mag else ZERO
        return State(
            inner, fresh(gyr, _gyr_limits(self)), fresh(acc if seen else ZERO, _acc_limits(self)),
            fresh(field, _mag_limits(self, field)), Pace(0.0, 0.0, 0.0, 0, 0), _NOT_YET, 0.0, False,
            seen, aligned, False, False, 0.0, 0.0, 0.0, 0.0, 0.0, flags,
        )  # fmt: skip

    def step(self, state: State, sample: Sample) -> State:
        """A common row is told by a few comparisons; all others are looked at one by one."""
        common = _common(self, state, sample)
        look = _NOTHING
        if common:
            clean = _plain(self, state, sample)
        else:
            look = _examined(self, state, sample)
            if not look.goes_on:
                return _waiting(self, state, look)
            clean = look.sample
        inner = step(self.method, state.inner, clean)
        astray = state.astray
        if (common or look.usable) and within(clean.gyr, _REST_RATE) and _at_rest(clean, self.gravity):
            astray = _astray(self, astray, clean, output(self.method, inner, clean).attitude)
        lost = astray > self.astray_time
        flags = (LOST if lost else 0) | (0 if state.aligned else HEADING_ARBITRARY)
        if common:
            still, silent = within(clean.gyr, _REST_RATE), state.mag_absent + clean.dt
            mag, has_mag = state.mag, present(clean.mag)
            if has_mag:
                mag = taken(mag, clean.mag, change(mag, clean.mag), silent, still)
            return State(
                inner, taken(state.gyr, clean.gyr, change(state.gyr, clean.gyr), clean.dt, still),
                taken(state.acc, clean.acc, change(state.acc, clean.acc), clean.dt, still), mag,
                counted_on(state.pace, clean.dt), state.levelling, clean.dt, not lost, True, state.aligned, state.mag_seen,
                lost, 0.0, 0.0, 0.0 if has_mag else silent, astray, 0.0, flags,
            )  # fmt: skip
        return State(
            inner, look.gyr, look.acc, look.mag, look.pace, _NOT_YET, clean.dt, look.usable and look.doubt == 0.0,
            True, state.aligned, look.mag_seen, lost, look.gyr_absent, look.acc_absent, look.mag_absent, astray,
            look.doubt, look.flags | flags,
        )  # fmt: skip

    def output(self, state: State, sample: Sample) -> Output:
        """What the method says; it sees the rate, not the other sensors, which it had in ``step``.

        Doubt is part of sigma. While the method waits to be started anew, what it says stands still.
        """
        seen = Sample(state.dt, state.gyr.value, ABSENT, ABSENT, 0.0, 0.0, state.dt, state.dt)
        out = output(self.method, state.inner, seen)
        attitude = out.attitude if state.started else Quat(ABSENT.x, ABSENT.x, ABSENT.x, ABSENT.x)
        sigma = out.sigma
        if state.doubt > 0.0 or state.lost:
            doubt = pi if state.lost else state.doubt
            sigma = Vec3(_with(sigma.x, doubt), _with(sigma.y, doubt), _with(sigma.z, doubt))
        return Output(out.dt, attitude, out.rate, out.bias, sigma, out.bias_sigma, out.flags | state.flags)


class Look(NamedTuple):
    """What a row is found to be."""

    gyr: Channel
    acc: Channel
    mag: Channel
    pace: Pace
    sample: Sample  # what the method may see of it, and how long it lasts
    goes_on: bool  # the method steps; otherwise it waits, or is started
    usable: bool  # gyroscope and accelerometer were measured
    gathers: bool  # and nothing turned unmeasured: good for starting anew from
    mag_seen: bool
    gyr_absent: float  # s
    acc_absent: float
    mag_absent: float
    lost: bool
    doubt: float  # rad
    flags: int


_EMPTY = fresh(ZERO, Limits(0.0, 0.0, 0.0, 0.0))
_NOTHING = Look(
    _EMPTY, _EMPTY, _EMPTY, Pace(0.0, 0.0, 0.0, 0, 0), Sample(0.0, ZERO, ZERO, ZERO, 0.0, 0.0, 0.0, 0.0),
    False, False, False, False, 0.0, 0.0, 0.0, False, 0.0, 0,
)  # fmt: skip


@compiled
def _common(guard: Guard, state: State, sample: Sample) -> bool:
    """Whether nothing has to be looked at: an even step, and samples as they usually are."""
    gyr, acc, mag = state.gyr, state.acc, state.mag
    by_mag = change(mag, sample.mag)
    if by_mag - by_mag == 0.0:
        field = usual(mag, sample.mag, by_mag, _mag_limits(guard, mag.value)) and state.aligned and state.mag_seen
    else:  # a large enough number may overflow in the square: that is for a closer look
        silent = state.mag_absent + sample.dt > max(guard.mag_loss, 3.0 * mag.every)
        field = not present(sample.mag) and not (silent and state.mag_seen)
    return (
        state.plain
        and not state.lost
        and field
        and evenly(state.pace, sample.dt, guard.gap)
        and usual(gyr, sample.gyr, change(gyr, sample.gyr), _gyr_limits(guard))
        and usual(acc, sample.acc, change(acc, sample.acc), _acc_limits(guard))
    )


@compiled
def _plain(guard: Guard, state: State, sample: Sample) -> Sample:
    """A common row as the method may see it."""
    dt, field = sample.dt, sample.mag if present(sample.mag) else ABSENT
    return Sample(
        dt, sample.gyr, sample.acc, field, sample.acc_age, sample.mag_age, dt, min(state.mag_absent + dt, guard.gap)
    )  # fmt: skip


@compiled
def _examined(guard: Guard, state: State, sample: Sample) -> Look:
    """A row that is not a common one: its stamp and each of its samples is judged."""
    gyr, acc, mag = state.gyr, state.acc, state.mag
    by_gyr, by_acc, by_mag = change(gyr, sample.gyr), change(acc, sample.acc), change(mag, sample.mag)
    row = timed(state.pace, sample.dt, by_gyr == 0.0 and not by_acc > 0.0 and not by_mag > 0.0, guard.gap)
    dt, flags = row.dt, row.flags
    if dt == 0.0:  # no time can be given to it: nothing moves, and too many of them lose the attitude
        lost = state.lost or row.pace.held > guard.longest_disorder
        nothing = Sample(0.0, gyr.value, ABSENT, ABSENT, 0.0, 0.0, 0.0, 0.0)
        return Look(
            gyr, acc, mag, row.pace, nothing, False, False, False, state.mag_seen,
            state.gyr_absent, state.acc_absent, state.mag_absent, lost, state.doubt, flags,
        )  # fmt: skip

    # What the samples are worth
    gyr_age, acc_age, mag_age = state.gyr_absent + dt, state.acc_absent + dt, state.mag_absent + dt
    still = within(gyr.value, _REST_RATE)
    gyr_limits, acc_limits, mag_limits = _gyr_limits(guard), _acc_limits(guard), _mag_limits(guard, mag.value)
    usual_step = row.pace.step
    # A jump of the rate is an angular acceleration, which an accelerometer 1 cm off the axis feels
    felt = max(0.1 * guard.gravity, 0.01 * sqrt(by_gyr) / dt)
    spike = jumped(gyr, by_gyr, gyr_age, usual_step, gyr_limits) and not stirred(acc, by_acc, felt)
    found = judged(gyr, sample.gyr, gyr_age, spike, not still, still, guard.stuck_time, gyr_limits)
    gyr = found.channel
    has_gyr = present(found.value)
    spiked = present(sample.acc) and jumped(acc, by_acc, acc_age, usual_step, acc_limits)
    shaken = has_gyr and stirred(state.gyr, by_gyr, _REST_RATE)
    gyr_verdict = found.verdict
    turning = _across(gyr.value, acc.value) > _REST_RATE
    found = judged(acc, sample.acc, acc_age, spiked and not shaken, turning, still, guard.stuck_time, acc_limits)
    acc, acc_verdict = found.channel, found.verdict
    has_acc = present(found.value) and acc_verdict != CLIPPED
    turning = _across(gyr.value, mag.value) > _REST_RATE
    spiked = state.mag_seen and jumped(mag, by_mag, mag_age, usual_step, mag_limits)
    if not state.mag_seen and mag.most == 0.0 and present(sample.mag):
        mag, mag_limits = fresh(sample.mag, _mag_limits(guard, sample.mag)), _mag_limits(guard, sample.mag)
    found = judged(mag, sample.mag, mag_age, spiked, turning, still, guard.stuck_time, mag_limits)
    mag, mag_verdict = found.channel, found.verdict
    has_mag = present(found.value) and mag_verdict != CLIPPED
    flags |= _told(gyr_verdict, GYR_IGNORED, STUCK_GYR, GYR_CLIPPED)
    flags |= _told(acc_verdict, ACC_IGNORED, STUCK_ACC, ACC_CLIPPED)
    if guard.follows_mag:
        flags |= _told(mag_verdict, MAG_IGNORED, STUCK_MAG, MAG_CLIPPED)

    # What is absent, and since when
    gyr_absent = 0.0 if has_gyr else gyr_age
    acc_absent = 0.0 if has_acc else acc_age
    mag_absent = 0.0 if has_mag else mag_age
    mag_seen = state.mag_seen or has_mag
    flags |= 0 if has_gyr else GYR_MISSING
    flags |= ACC_MISSING if acc_absent > max(guard.acc_loss, 3.0 * acc.every) else 0
    silent = mag_absent > max(guard.mag_loss, 3.0 * mag.every)
    flags |= MAG_MISSING if mag_seen and guard.follows_mag and silent else 0
    rate = gyr.value
    clean = Sample(
        dt, _over_loss(guard, state, rate, dt, usual_step) if has_gyr else rate,
        sample.acc if has_acc else ABSENT, sample.mag if has_mag else ABSENT, sample.acc_age, sample.mag_age,
        min(acc_age, guard.gap), min(mag_age, guard.gap),
    )  # fmt: skip

    # How far it may have turned unmeasured
    doubt, lost = state.doubt, state.lost
    hidden = 0.0  # rad
    if not has_gyr or flags & GAP != 0:
        stuck = state.gyr.same if gyr_verdict == STUCK and state.gyr_absent == 0.0 else 0.0
        hidden = 0.5 * (norm(rate) + 0.5) * (dt + stuck)  # a rate goes on about half as wrong as it is large
        lost = lost or gyr_absent > guard.longest_loss or dt > guard.longest_loss
    elif gyr_verdict == CLIPPED:
        hidden = 0.25 * gyr.most * dt
    if hidden > 0.0:
        doubt = min(doubt + hidden, pi)
        lost = lost or doubt > guard.lost_doubt
    elif doubt > 0.0 and has_acc:
        doubt = doubt * guard.settle_time / (guard.settle_time + dt) if doubt > _SURE else 0.0
    lost = lost or state.pace.held > guard.longest_disorder
    if not state.started:  # nothing that could be lost
        doubt, lost = 0.0, False
    usable = has_acc and has_gyr
    goes_on = state.started and not lost and (state.aligned or not has_mag or not guard.follows_mag)
    flags |= UNSETTLED if goes_on and doubt > guard.valid_doubt else 0
    return Look(
        gyr, acc, mag, row.pace, clean, goes_on, usable, usable and hidden == 0.0, mag_seen,
        gyr_absent, acc_absent, mag_absent, lost, doubt, flags,
    )  # fmt: skip


@compiled
def _waiting(guard: Guard, state: State, look: Look) -> State:
    """The method does not step: it waits for samples to start from, or is started from this one."""
    sample, lost, doubt, flags = look.sample, look.lost, look.doubt, look.flags
    levelling, ready = state.levelling, False
    if sample.dt > 0.0:
        bias = output(guard.method, state.inner, sample).bias
        levelling = _gathered(guard, levelling, sample, sample.gyr - bias, look.gathers)
        ready = look.usable and (not lost or _enough(guard, levelling))
    if not ready:
        if not state.started:
            flags |= INITIALISING
        elif lost:
            flags |= LOST
        elif doubt > guard.valid_doubt:
            flags |= UNSETTLED
        flags |= 0 if state.aligned else HEADING_ARBITRARY
        return State(
            state.inner, look.gyr, look.acc, look.mag, look.pace, levelling, sample.dt, False,
            state.started, state.aligned, look.mag_seen, lost, look.gyr_absent, look.acc_absent, look.mag_absent,
            0.0, doubt, flags,
        )  # fmt: skip
    before = output(guard.method, state.inner, sample)
    if lost:
        sample = _mean(levelling, sample)
        doubt = _LEVELLED if levelling.moved else 0.0
    has_mag = present(sample.mag)
    if state.started:
        flags |= RESET
        sample = _restart(guard, before.attitude, sample, lost)
    inner = restart(guard.method, state.inner, sample, before.bias)  # from the placeholder too: what it knew stays
    kept = state.aligned and (not state.mag_seen or not guard.follows_mag)
    aligned = kept if state.started and not guard.follows_mag else has_mag or (state.started and kept)
    flags |= (0 if aligned else HEADING_ARBITRARY) | (UNSETTLED if doubt > guard.valid_doubt else 0)
    return State(
        inner, look.gyr, look.acc, look.mag, look.pace, _NOT_YET, sample.dt, doubt == 0.0,
        True, aligned, look.mag_seen, False, look.gyr_absent, look.acc_absent, look.mag_absent, 0.0, doubt, flags,
    )  # fmt: skip


@compiled
def _over_loss(guard: Guard, state: State, rate: Vec3, dt: float, usual_step: float) -> Vec3:
    """The mean rate of a step in which rows were lost: between two samples the rate goes straight from one to the other.

    Where rows were there and the gyroscope's samples were not, the last rate was taken for them: made good here.
    """
    before = state.gyr.value
    if state.gyr_absent > 0.0:
        return rate + (0.5 * state.gyr_absent / dt) * (rate - before) if state.gyr_absent <= 0.25 * guard.gap else rate
    if usual_step > 0.0 and 1.5 * usual_step < dt <= guard.gap:
        return rate + (0.5 * (dt - usual_step) / dt) * (before - rate)
    return rate


@compiled
def _told(verdict: int, spike: int, stuck: int, clipped: int) -> int:
    if verdict == SPIKE:
        return spike
    if verdict == STUCK:
        return stuck
    return clipped if verdict == CLIPPED else 0


@compiled
def _gathered(guard: Guard, old: Levelling, sample: Sample, rate: Vec3, usable: bool) -> Levelling:
    """The samples since the loss, with this one; a row that lacks one of the two begins anew."""
    if not usable:
        return _NOT_YET
    turn = renormalized(old.turn * exp(sample.dt * rate)) if old.time > 0.0 else IDENTITY
    force = old.force + sample.acc_dt * rotate(turn, sample.acc)
    field = old.field + sample.mag_dt * rotate(turn, sample.mag) if present(sample.mag) else old.field
    return Levelling(turn, force, field, old.time + sample.acc_dt, old.moved or not _at_rest(sample, guard.gravity))


@compiled
def _enough(guard: Guard, levelling: Levelling) -> bool:
    return levelling.time >= (guard.level_time if levelling.moved else 0.04 * guard.level_time)


@compiled
def _mean(levelling: Levelling, sample: Sample) -> Sample:
    """The sample with the mean force and field of the levelling, in the body of now."""
    back = conjugate(levelling.turn)
    acc = rotate(back, levelling.force / levelling.time)
    mag = rotate(back, levelling.field / levelling.time) if dot(levelling.field, levelling.field) > 0.0 else sample.mag
    acc = acc if dot(acc, acc) > 1e-6 else sample.acc
    return Sample(sample.dt, sample.gyr, acc, mag, 0.0, 0.0, levelling.time, levelling.time)


@compiled
def _restart(guard: Guard, attitude: Quat, sample: Sample, lost: bool) -> Sample:
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
def _astray(guard: Guard, astray: float, sample: Sample, attitude: Quat) -> float:
    """s at rest with a tilt that gravity contradicts; a row in which it does not sets it back."""
    along = dot(up_in_body(attitude), sample.acc)
    # 0.9 < cos²(18.4°): nearer than any astray_angle, and the cosine is left for the rare case
    if along < 0.0 or along * along < 0.9 * dot(sample.acc, sample.acc):
        return astray + sample.dt if along < cos(guard.astray_angle) * norm(sample.acc) else 0.0
    return 0.0


@compiled
def _at_rest(sample: Sample, gravity: float) -> bool:
    """No turning, and the length of gravity: an acceleration could then tilt the specific force by 18° at most."""
    least, most = (1.0 - _REST_FORCE) * gravity, (1.0 + _REST_FORCE) * gravity
    return within(sample.gyr, _REST_RATE) and least * least < dot(sample.acc, sample.acc) < most * most


@compiled
def _across(rate: Vec3, v: Vec3) -> float:
    """rad/s: how fast a rate turns a direction; a turn about it does not show in it."""
    length = norm(v)
    return norm(cross(rate, v)) / length if length > 0.0 else 0.0


@compiled
def _with(sigma: float, doubt: float) -> float:
    """rad; an angle of which nothing is known is not further off than half a turn; NaN stays."""
    whole = sqrt(sigma * sigma + doubt * doubt)
    return pi if whole > pi else whole


@compiled
def _gyr_limits(guard: Guard) -> Limits:
    """A jump of 3 rad/s between two samples is beyond limbs and robots; no gyroscope ends below 125 deg/s."""
    return Limits(3.0, 2.1, -1.0, guard.largest_gyr)


@compiled
def _acc_limits(guard: Guard) -> Limits:
    """A jump of 4 g takes a blow; no accelerometer ends below 2 g."""
    return Limits(4.0 * guard.gravity, 18.0, 1e-6, guard.largest_acc)


@compiled
def _mag_limits(guard: Guard, last: Vec3) -> Limits:
    """Whatever its unit: a jump is as long as the field itself, and no range ends below twice that of the Earth."""
    length = norm(last)
    return Limits(length, 2.0 * length, 1e-18, guard.largest_mag)
