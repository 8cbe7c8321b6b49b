"""Guard: keeps what is not a measurement away from a method, bridges short losses, restarts after long ones, and says so."""

from __future__ import annotations

from math import cos, pi, radians, sqrt
from typing import Annotated, Any, NamedTuple

from poise.data.flags import HEADING_ARBITRARY, INITIALISING, LOST, RESET, UNSETTLED
from poise.data.packet import Output, Sample
from poise.estimators.guard.field import Field, begun, due, later, looked_at, plainly_across, unknown, vertical
from poise.estimators.guard.levelling import (
    NOT_YET,
    Levelling,
    at_rest,
    enough,
    gathered,
    mean_of,
    to_restart_from,
)
from poise.estimators.guard.look import Look, acc_limits, common, examined, gyr_limits, mag_limits, untouched
from poise.estimators.guard.samples import Channel, fresh
from poise.estimators.guard.stamps import UNKNOWN, Pace
from poise.estimators.protocol import output, restart, resting_sample, start, step, with_sensors
from poise.math.compiled import compiled
from poise.math.quaternions import IDENTITY, Quat, up_in_body
from poise.math.vectors import ABSENT, ZERO, Vec3, dot, norm, present

_LEVELLED = 0.12  # rad: how far the mean force of three seconds in motion may be from up


class Past(NamedTuple):
    """What the guard itself remembers."""

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
    field: Field  # whether what it says tells a heading
    lost: bool  # the motion was not measured for too long: start anew when it is again
    gyr_absent: float  # s
    acc_absent: float
    mag_absent: float
    astray: float  # s at rest with a tilt that gravity contradicts
    doubt: float  # rad: how far the body may have turned unmeasured
    flags: int


class State(NamedTuple):
    """The two are apart for speed: a function that is given an array, and branches, counts its owners."""

    inner: Any
    past: Past


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
        acc = acc if dot(acc, acc) > acc_limits(self).least else ABSENT
        mag = mag if dot(mag, mag) > mag_limits(self, ZERO).least else ABSENT
        gyr = sample.gyr if dot(sample.gyr, sample.gyr) <= self.largest_gyr**2 else bias  # NaN is not
        seen = present(acc)
        points = begun(with_sensors(sample, gyr, acc, mag), self.gravity)
        mag = ABSENT if vertical(points) else mag
        placeholder = resting_sample(IDENTITY, self.declination)
        first = with_sensors(sample, gyr, acc if seen else placeholder.acc, mag if seen else ABSENT)
        inner = start(self.method, first, bias)
        has_mag = present(mag)
        aligned = seen and has_mag
        flags = (0 if seen else INITIALISING) | (0 if aligned else HEADING_ARBITRARY)
        field = mag if has_mag else ZERO
        after = Past(
            fresh(gyr, gyr_limits(self)), fresh(acc if seen else ZERO, acc_limits(self)),
            fresh(field, mag_limits(self, field)), UNKNOWN, NOT_YET, 0.0, False,
            seen, aligned, False, points, False, 0.0, 0.0, 0.0, 0.0, 0.0, flags,
        )  # fmt: skip
        return State(inner, after)

    def step(self, state: State, sample: Sample) -> State:
        """A common row is told by a few comparisons; all others are looked at one by one."""
        past = state.past
        look = untouched(self, past, sample) if common(self, past, sample) else examined(self, past, sample)
        if not look.goes_on:
            return _waiting(self, state, look)
        clean = look.sample
        inner = step(self.method, state.inner, clean)
        astray = past.astray
        if look.usable and at_rest(clean, self.gravity):
            astray = _astray(self, astray, clean, output(self.method, inner, clean).attitude)
        lost = astray > self.astray_time
        points = later(past.field, clean.dt)
        seen = sample.mag if vertical(points) else clean.mag  # one that is faulty points nowhere
        if due(points, seen):
            if plainly_across(points, sample.acc, seen):
                points = Field(points.along, points.across, 0.0)
            else:
                points = looked_at(points, up_in_body(output(self.method, inner, clean).attitude), seen, self.gap)
        aligned = past.aligned and not (vertical(points) and unknown(points))
        flags = (LOST if lost else 0) | (0 if aligned and not unknown(points) else HEADING_ARBITRARY)
        after = Past(
            look.gyr, look.acc, look.mag, look.pace, NOT_YET, clean.dt,
            look.usable and look.doubt == 0.0 and not lost, True, aligned, look.mag_seen, points, lost,
            look.gyr_absent, look.acc_absent, look.mag_absent, astray, look.doubt, look.flags | flags,
        )  # fmt: skip
        return State(inner, after)

    def output(self, state: State, sample: Sample) -> Output:
        """What the method says; it sees the rate, not the other sensors, which it had in ``step``.

        Doubt is part of sigma. While the method waits to be started anew, what it says stands still.
        """
        past = state.past
        seen = Sample(past.dt, past.gyr.value, ABSENT, ABSENT, 0.0, 0.0, past.dt, past.dt, 0.0)
        out = output(self.method, state.inner, seen)
        attitude = out.attitude if past.started else Quat(ABSENT.x, ABSENT.x, ABSENT.x, ABSENT.x)
        sigma = out.sigma
        if past.doubt > 0.0 or past.lost:
            doubt = pi if past.lost else past.doubt
            sigma = Vec3(_with(sigma.x, doubt), _with(sigma.y, doubt), _with(sigma.z, doubt))
        return Output(out.dt, attitude, out.rate, out.bias, sigma, out.bias_sigma, out.flags | past.flags)


@compiled
def _waiting(guard: Guard, state: State, look: Look) -> State:
    """The method does not step: it waits for samples to start from, or is started from this one."""
    past = state.past
    sample, lost, doubt, flags = look.sample, look.lost, look.doubt, look.flags
    levelling, ready = past.levelling, False
    if sample.dt > 0.0:
        bias = output(guard.method, state.inner, sample).bias
        levelling = gathered(guard, levelling, sample, sample.gyr - bias, look.turned)
        ready = look.usable and (not lost or enough(guard, levelling))
    if not ready:
        if not past.started:
            flags |= INITIALISING
        elif lost:
            flags |= LOST
        elif doubt > guard.valid_doubt:
            flags |= UNSETTLED
        flags |= 0 if past.aligned else HEADING_ARBITRARY
        after = Past(
            look.gyr, look.acc, look.mag, look.pace, levelling, sample.dt, False,
            past.started, past.aligned, look.mag_seen, past.field, lost, look.gyr_absent, look.acc_absent, look.mag_absent,
            0.0, doubt, flags,
        )  # fmt: skip
        return State(state.inner, after)
    before = output(guard.method, state.inner, sample)
    if lost:
        sample = mean_of(levelling, sample)
        doubt = _LEVELLED if levelling.moved else 0.0
    has_mag = present(sample.mag)
    if past.started:
        flags |= RESET
        sample = to_restart_from(guard, before.attitude, sample, lost)
    inner = restart(guard.method, state.inner, sample, before.bias)  # from the placeholder too: what it knew stays
    kept = past.aligned and (not past.mag_seen or not guard.follows_mag)
    aligned = kept if past.started and not guard.follows_mag else has_mag or (past.started and kept)
    flags |= (0 if aligned else HEADING_ARBITRARY) | (UNSETTLED if doubt > guard.valid_doubt else 0)
    after = Past(
        look.gyr, look.acc, look.mag, look.pace, NOT_YET, sample.dt, doubt == 0.0,
        True, aligned, look.mag_seen, past.field, False, look.gyr_absent, look.acc_absent, look.mag_absent, 0.0, doubt, flags,
    )  # fmt: skip
    return State(inner, after)


@compiled
def _astray(guard: Guard, astray: float, sample: Sample, attitude: Quat) -> float:
    """s at rest with a tilt that gravity contradicts; a row in which it does not sets it back."""
    along = dot(up_in_body(attitude), sample.acc)
    # 0.9 < cos²(18.4°): nearer than any astray_angle, and the cosine is left for the rare case
    if along < 0.0 or along * along < 0.9 * dot(sample.acc, sample.acc):
        return astray + sample.acc_dt if along < cos(guard.astray_angle) * norm(sample.acc) else 0.0
    return 0.0


@compiled
def _with(sigma: float, doubt: float) -> float:
    """rad; an angle of which nothing is known is not further off than half a turn; NaN stays."""
    whole = sqrt(sigma * sigma + doubt * doubt)
    return pi if whole > pi else whole
