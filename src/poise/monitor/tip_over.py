"""TipOver: whether a body stands, leans, tips over, lies, falls freely or is carried, from its attitude.

Source: CN 108225271 A, tip-over detection of a robot. Its four modules: *angle acquisition* and *angle computation* are
an estimator (``Tilt`` is the source's, any will do); *tip-over judgement* is this; *tip-over handling* is what is done
with the events. Derived in ``docs/tipover.md``.

Departures from the print: the angle may reach the range for a dwell time before it counts, and has to come back by a
hysteresis (the print acts on one sample); the preset range and the largest self-balancing angle are judged both, as
*leaning* and *tipping*; look-ahead, free fall, pick-up and "unknown" are ours.
"""

from __future__ import annotations

from math import atan2, isfinite, nan, radians, sqrt
from typing import Annotated, NamedTuple

from poise.data.event import TipState
from poise.data.flags import INVALID
from poise.data.packet import Output
from poise.math.compiled import compiled
from poise.math.quaternions import IDENTITY, Quat, inner, rotate, up_in_body
from poise.math.vectors import ABSENT, ZERO, Vec3, cross, norm, present
from poise.monitor.going import UNSTARTED, Clock, gone_on, stands
from poise.monitor.sides import (
    NEVER,
    NO_EDGES,
    Directions,
    Lean,
    Side,
    at_or_beyond,
    beyond_by,
    lean_across,
    predicted,
    time_to,
)
from poise.monitor.vertical import GROUND, Vertical, moved

# Kernels see plain integers.
UNKNOWN, UPRIGHT, LEANING, TIPPING = map(int, (TipState.UNKNOWN, TipState.UPRIGHT, TipState.LEANING, TipState.TIPPING))
FALLEN, FREE_FALL = int(TipState.FALLEN), int(TipState.FREE_FALL)
PICKED_UP, RIGHTED = int(TipState.PICKED_UP), int(TipState.RIGHTED)
FORWARD, BACK, LEFT, RIGHT = 1, 2, 3, 4
CLOCK_STANDS = 5  # in the place of a direction: why the state is unknown
DIRECTIONS = ("", "forward", "back", "left", "right")

_LEAK = 2.0  # a condition is forgotten twice as fast as it gathers: one good sample in a fall costs little
_TOPPLING = 0.25  # s: a body that topples measures next to nothing near 48°, for less than this
_QUIET_SPEED, _QUIET_RATE = 0.15, 0.5  # m/s upward, rad/s: more is being carried


class Held(NamedTuple):
    """For how long something has held, up to what is asked of it."""

    seconds: float
    samples: float


NEW = Held(0.0, 0.0)


class Conditions(NamedTuple):
    lean: Held  # at or beyond the range
    tip: Held  # at or beyond the self-balancing angle, or about to be
    back: Held  # below it, hysteresis and look-ahead included
    inside: Held  # below the range, hysteresis included
    hit: Held  # at or beyond the angle of impact
    lying: Held  # beyond the self-balancing angle and still
    lifted: Held
    quiet: Held  # neither lifted nor turned


class Seen(NamedTuple):
    """What one attitude says by itself."""

    leans: bool
    tips: bool
    beyond: bool
    back: bool
    inside: bool
    hits: bool
    tilt: float  # rad
    worst: Lean  # across the side that is furthest beyond its range, or nearest to it
    limit: float  # rad, of that side
    impact: float  # s; NaN
    direction: int


class State(NamedTuple):
    now: int  # TipState
    known: int  # the last one that was not UNKNOWN
    since: float  # s in it
    held: Conditions
    weightless: Held  # needs no attitude
    vertical: Vertical
    seen: Seen
    clock: Clock


NOTHING = Conditions(NEW, NEW, NEW, NEW, NEW, NEW, NEW, NEW)
UNSEEN = Seen(False, False, False, False, False, False, nan, Lean(nan, nan), nan, nan, 0)
TIMELESS = UNSEEN._replace(direction=CLOCK_STANDS)


class Verdict(NamedTuple):
    """What the monitor says after a sample."""

    state: int
    """:class:`poise.data.event.TipState`"""
    tilt: float
    """rad, between the robot's up and the vertical"""
    lean: float
    """rad, across the side that is furthest beyond its range, or nearest to it"""
    rate: float
    """rad/s, of that lean; NaN where it is not known"""
    limit: float
    """rad, the largest self-balancing angle there"""
    time_to_impact: float
    """s; NaN where it does not lean or does not get there"""
    direction: int
    """0 for none, else 1 to 4: forward, back, left, right; 5: unknown, since the clock stands still"""


class TipOver(NamedTuple):
    """Judges a body's stability from its attitude, and from its specific force where there is one.

    Robot's frame: x right, y forward, z up. ``step`` takes an :class:`Output` and the specific force (m/s², the sensor's
    frame, NaN for "not known"); ``output`` says what is made of it. :func:`poise.monitor.checked` checks the parameters.
    """

    range: Annotated[Directions, "rad", "preset range: at or beyond it the body leans"] = Directions(
        *[radians(20.0)] * 4
    )
    self_balancing: Annotated[Directions, "rad", "largest self-balancing angle: at or beyond it the body tips over"] = (
        Directions(*[radians(40.0)] * 4)
    )
    edges: Annotated[tuple[Side, ...], "", "sides from geometry, in the place of the two above"] = NO_EDGES
    mount: Annotated[Quat, "", "turns the sensor's axes into the robot's, w x y z; a tare is part of it"] = IDENTITY
    dwell: Annotated[float, "s", "how long something must hold before it counts"] = 0.05
    samples: Annotated[int, "", "and for how many samples at least", (1, 1000)] = 3
    hysteresis: Annotated[float, "rad", "how far inside a limit the lean must come back"] = radians(3.0)
    recovery: Annotated[float, "s", "how long it must be back before that counts"] = 0.3
    look_ahead: Annotated[float, "s", "beyond the range: how far ahead the lean is predicted; 0 for not at all"] = 0.15
    pendulum: Annotated[
        float, "m", "its length as a pendulum about the ground, for the prediction; 0: constant rate"
    ] = 0.0
    impact: Annotated[float, "rad", "the lean at which the body hits the ground", (0.0, radians(180.0))] = radians(80.0)
    lie: Annotated[float, "s", "how long a body that tipped over is still before it lies"] = 0.5
    still: Annotated[float, "rad/s", "largest rate of a body that lies"] = 0.2
    free_fall: Annotated[float, "1", "share of gravity below which nothing carries the body", (0.0, 1.0)] = 0.2
    free_fall_time: Annotated[float, "s", "how long the specific force must be that small"] = 0.1
    lift: Annotated[float, "m", "height by which a body that is picked up rises within a second"] = 0.1
    set_down: Annotated[float, "s", "how long a carried body must be quiet to be set down"] = 1.5
    hold: Annotated[float, "s", "how long a righted body stands before it is upright"] = 1.0
    gravity: Annotated[float, "m/s²", "gravity, which specific forces are compared with", (0.1, 100.0)] = 9.80665

    def start(self) -> State:
        """Before any sample: unknown."""
        return State(UNKNOWN, UNKNOWN, 0.0, NOTHING, NEW, GROUND, UNSEEN, UNSTARTED)

    def step(self, old: State, out: Output, acc: Vec3) -> State:
        dt = out.dt if out.dt > 0.0 and isfinite(out.dt) else 0.0
        clock = gone_on(old.clock, dt)
        timeless = stands(clock)
        square = inner(out.attitude, out.attitude)
        valid = out.flags & INVALID == 0 and not timeless and 0.9 < square < 1.1  # NaN is not between the two
        vertical_now = up_in_body(out.attitude) if valid else ABSENT
        vertical = moved(old.vertical, acc, vertical_now, norm(out.rate), out.flags, dt, self.gravity)
        light = vertical.force < self.free_fall * self.gravity
        weightless = _held(old.weightless, light, dt, _fall_time(self, old), self.samples)
        if not valid:
            since = old.since + dt if old.now == UNKNOWN else 0.0
            unseen = TIMELESS if timeless else UNSEEN
            return State(UNKNOWN, old.known, since, NOTHING, weightless, vertical, unseen, clock)
        rate = rotate(self.mount, out.rate)
        seen = _seen(self, rotate(self.mount, vertical_now), rate)
        held = _conditions(self, old, seen, vertical, norm(rate), dt)
        now = _next(self, old, held, weightless, dt)
        since = old.since + dt if now == old.now else 0.0
        return State(now, old.known if now == UNKNOWN else now, since, held, weightless, vertical, seen, clock)

    def output(self, state: State) -> Verdict:
        seen = state.seen
        return Verdict(
            state.now, seen.tilt, seen.worst.angle, seen.worst.rate, seen.limit, seen.impact, seen.direction
        )  # fmt: skip

    def sides(self) -> tuple[Side, ...]:
        """What the lean is judged across: the edges where there are any, else the four directions."""
        return _sides(self)


@compiled
def _sides(monitor: TipOver) -> tuple[Side, ...]:
    if monitor.edges[0].limit < 1e9:
        return monitor.edges
    a, b = monitor.range, monitor.self_balancing
    return (
        Side(0.0, 1.0, a.forward, b.forward, 0.0), Side(0.0, -1.0, a.back, b.back, 0.0),
        Side(-1.0, 0.0, a.left, b.left, 0.0), Side(1.0, 0.0, a.right, b.right, 0.0),
        NEVER, NEVER, NEVER, NEVER,
    )  # fmt: skip


@compiled
def _seen(monitor: TipOver, up: Vec3, rate: Vec3) -> Seen:
    """What the vertical *up* and the *rate*, both in the robot's frame, say of every side."""
    known = present(rate)
    change = cross(up, rate) if known else ZERO  # of an Earth-fixed vector, seen from the body
    growth = sqrt(monitor.gravity / monitor.pendulum) if monitor.pendulum > 0.0 else 0.0
    leans, tips, beyond, back, inside, hits = False, False, False, True, True, False
    worst, of_worst, most = Lean(0.0, 0.0), NEVER, -1e9
    for side in _sides(monitor):
        if side.limit < 1e9:
            lean = lean_across(side, up, change)
            out = at_or_beyond(lean.angle, side.range)
            over = at_or_beyond(lean.angle, side.limit)
            ahead = False
            if known and out and monitor.look_ahead > 0.0:
                ahead = at_or_beyond(predicted(side, lean, monitor.look_ahead, growth), side.limit)
            leans, beyond, tips = leans or out, beyond or over, tips or over or ahead
            back = back and not ahead and lean.angle < side.limit - monitor.hysteresis
            inside = inside and lean.angle < side.range - monitor.hysteresis
            hits = hits or at_or_beyond(lean.angle, monitor.impact)
            excess = beyond_by(side, up)
            if excess > most:
                worst, of_worst, most = lean, side, excess
    impact = time_to(monitor.impact, of_worst, worst, growth) if known and leans else nan
    worst = worst if known else Lean(worst.angle, nan)
    tilt = atan2(sqrt(up.x * up.x + up.y * up.y), up.z)
    return Seen(leans, tips, beyond, back, inside, hits, tilt, worst, of_worst.limit, impact, _direction(of_worst))


@compiled
def _direction(side: Side) -> int:
    if abs(side.forward) >= abs(side.right):
        return FORWARD if side.forward > 0.0 else BACK
    return RIGHT if side.right > 0.0 else LEFT


@compiled
def _held(old: Held, holds: bool, dt: float, time: float, samples: int) -> Held:
    """How long it has held, at most *time* and *samples*; what does not hold is forgotten, faster, not at once."""
    if holds:
        more = dt if old.samples > 0.0 else 0.0  # the time before the first sample is none of it
        return Held(min(old.seconds + more, time), min(old.samples + 1.0, float(samples)))
    return Held(max(old.seconds - _LEAK * dt, 0.0), max(old.samples - _LEAK, 0.0))


@compiled
def _has(held: Held, time: float, samples: int) -> bool:
    """Whether it has held for as long as asked."""
    return held.seconds >= time - 1e-9 and held.samples >= samples


@compiled
def _fall_time(monitor: TipOver, old: State) -> float:
    """How long nothing must carry the body until it falls freely; one that topples measures next to nothing for a while."""
    topples = old.now in (LEANING, TIPPING) or old.held.lean.samples > 0.0
    return max(monitor.free_fall_time, _TOPPLING) if topples else monitor.free_fall_time


@compiled
def _time_inside(monitor: TipOver, old: State) -> float:
    return monitor.dwell if old.now == UNKNOWN else monitor.recovery


@compiled
def _conditions(
    monitor: TipOver, old: State, seen: Seen, vertical: Vertical, rate: float, dt: float
) -> Conditions:  # fmt: skip
    held, dwell, n = old.held, monitor.dwell, monitor.samples
    still = rate < monitor.still
    inside = seen.inside or (
        old.now == UNKNOWN and not seen.leans
    )  # out of "unknown" there is nothing to come back from
    lifted = vertical.height >= monitor.lift and not (old.now == FALLEN and still)
    quiet = abs(vertical.speed) < _QUIET_SPEED and not rate >= _QUIET_RATE  # NaN: not known
    return Conditions(
        lean=_held(held.lean, seen.leans, dt, dwell, n),
        tip=_held(held.tip, seen.tips, dt, dwell, n),
        back=_held(held.back, seen.back, dt, monitor.recovery, n),
        inside=_held(held.inside, inside, dt, _time_inside(monitor, old), n),
        hit=_held(held.hit, seen.hits, dt, dwell, n),
        lying=_held(held.lying, seen.beyond and still, dt, monitor.lie, n),
        lifted=_held(held.lifted, lifted, dt, dwell, n),
        quiet=_held(held.quiet, quiet, dt, monitor.set_down, n),
    )


@compiled
def _next(monitor: TipOver, old: State, held: Conditions, weightless: Held, dt: float) -> int:
    """The state after a sample with a valid attitude."""
    now, n, dwell = old.now, monitor.samples, monitor.dwell
    leans, tips = _has(held.lean, dwell, n), _has(held.tip, dwell, n)
    inside = _has(held.inside, _time_inside(monitor, old), n)
    lies = _has(held.hit, dwell, n) or _has(held.lying, monitor.lie, n)
    if _has(weightless, _fall_time(monitor, old), n) or (now == FREE_FALL and weightless.samples > 0.0):
        return FREE_FALL
    if _has(held.lifted, dwell, n):
        return PICKED_UP
    if now == UNKNOWN and old.known == PICKED_UP:
        return PICKED_UP if leans or inside else UNKNOWN  # still carried, as far as is known
    if now == PICKED_UP:
        quiet = _has(held.quiet, monitor.set_down, n)
        if quiet and _has(held.lying, monitor.lie, n):
            return FALLEN
        if quiet and inside:
            return RIGHTED
        return LEANING if quiet and leans and not tips else PICKED_UP
    if now == FALLEN:
        return RIGHTED if inside else FALLEN
    if now == TIPPING:
        if lies:
            return FALLEN
        if inside:
            return UPRIGHT
        return LEANING if _has(held.back, monitor.recovery, n) else TIPPING
    if now == UNKNOWN and old.known == FALLEN and leans:
        return FALLEN
    if now == UNKNOWN and lies:
        return FALLEN
    if tips:
        return TIPPING
    if leans:
        return LEANING
    if now == RIGHTED:
        return UPRIGHT if old.since + dt >= monitor.hold - 1e-9 else RIGHTED
    if inside:
        return RIGHTED if now == FREE_FALL or _was_down(now, old.known) else UPRIGHT
    return now


@compiled
def _was_down(now: int, known: int) -> bool:
    return now == UNKNOWN and known in (FALLEN, FREE_FALL, RIGHTED)
