"""What a mean specific force that leans, and has leaned for seconds, tells of: a wrong tilt, or a body that is under way.

A vehicle in a bend is pushed across its way, by its speed times the rate about up; a wrong tilt would move the field, too; and
a tilt that gravity's own corrections have made wrong says nothing of the bias.
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import TYPE_CHECKING, NamedTuple

from poise.estimators.self_calibrating.covariance import forget
from poise.estimators.self_calibrating.model import BIAS, SENSOR, TURN, TURNED, VELOCITY, Floats, Sums, X, put, vector
from poise.math.compiled import compiled
from poise.math.vectors import ZERO, Vec3, cross, dot

if TYPE_CHECKING:
    from poise.estimators.self_calibrating.causal import SelfCalibrating

# Behind what has been turned, two rows keep the means over watch_time and over twice that: of the push (2) by a speed of 1 m/s,
# of the rate's square, of the push with the force (2), of the field's error (3), and of the time it was seen for. The third
# keeps the turn about up, what the corrections since _HELD have made of tilt (3) and bias (3) if all of them were wrong,
# whether it has rested since the attitude began (begun in motion it may be a tilt that leans, and the field was learned by
# it), and the seconds that it has been under way.
_PUSH, _RATE, _PUSHED, _ERROR, _SEEN = 18, 20, 21, 23, 26
_HEADING, _MADE, _LEARNED, _RESTED, _UNDER_WAY = 18, 19, 22, 25, 26
_WANDER = 24  # where in the row of the sensor s_v² is
_HELD = 30.0  # s, as long as recall.py goes back at least
_SPEED = 10.0  # m/s: σ of a vehicle's speed
_ROUND = 3.0  # watch_times: a bend that comes round sooner is upright in the mean that step 6 takes, too
_LONGEST = 120.0  # s: after so long under way a tilt is the likelier
_STANDS = 0.5  # of what a tilt would have moved the field by: where it has moved by less, no tilt is the likelier
NOTHING_TOLD, UNDER_WAY, TILTED = 0, 1, 2


class Lean(NamedTuple):
    """What a block has to say of a lean, Earth frame."""

    x: float  # the mean horizontal force, in g
    y: float
    push_x: float  # what a speed of 1 m/s along the body's own heading would push by, m/s²
    push_y: float
    field: Vec3  # the error of the field, in lengths
    seen: float  # the share of the block's time that it was seen for


@compiled
def lean_of(P: Floats, s: Sums, still: Vec3, error: Vec3, gravity: float) -> Lean:
    """Of a block; *still* its mean rate without the bias, *error* that of its field, ZERO where none was measured."""
    turn: Vec3 = s.rotation @ still
    heading = float(P[TURNED + 2, _HEADING])
    middle, rate = heading + 0.5 * turn.z, turn.z / s.time
    heading += turn.z
    if abs(heading) > pi:
        heading -= 2.0 * pi if heading > 0.0 else -2.0 * pi
    P[TURNED + 2, _HEADING] = heading
    per_time = 1.0 / (s.force_time * gravity)
    seen = s.mag_time / s.time if error != ZERO else 0.0
    return Lean(s.force.x * per_time, s.force.y * per_time, -rate * sin(middle), rate * cos(middle), error, seen)


@compiled
def take_lean(P: Floats, which: int, share: float, a: Lean) -> None:
    """Into the means, the first or the second."""
    row = TURNED + which
    P[row, _PUSH] += share * (a.push_x - P[row, _PUSH])
    P[row, _PUSH + 1] += share * (a.push_y - P[row, _PUSH + 1])
    P[row, _RATE] += share * (a.push_x * a.push_x + a.push_y * a.push_y - P[row, _RATE])
    P[row, _PUSHED] += share * (a.push_x * a.x + a.push_y * a.y - P[row, _PUSHED])
    P[row, _PUSHED + 1] += share * (a.push_x * a.y - a.push_y * a.x - P[row, _PUSHED + 1])
    error = vector(P, row, _ERROR)
    put(P, row, _ERROR, error + share * (a.seen * a.field - error))
    P[row, _SEEN] += share * (a.seen - P[row, _SEEN])


@compiled
def told(method: SelfCalibrating, P: Floats, which: int, x: float, y: float, least: float, field: Vec3) -> int:
    """What a mean force that leans by (x, y) g tells of, if it does so by more than *least* (eq. 34 to 36)."""
    if x * x + y * y <= least * least:
        return NOTHING_TOLD
    if P[TURNED + 2, _RESTED] == 0.0:
        return TILTED
    row = TURNED + which
    # What is left without the push by the likeliest speed.
    unsure, rate_square = least * method.gravity / _SPEED, float(P[row, _RATE])
    total = rate_square + unsure * unsure
    along, across = float(P[row, _PUSHED]) / total, float(P[row, _PUSHED + 1]) / total
    push_x, push_y = float(P[row, _PUSH]), float(P[row, _PUSH + 1])
    x -= push_x * along - push_y * across
    y -= push_y * along + push_x * across
    if x * x + y * y <= least * least:
        slow = 2.0 * pi / (_ROUND * method.watch_time)
        return UNDER_WAY if rate_square < slow * slow else NOTHING_TOLD
    # Without the corrections that were made for what leaned before.
    made = vector(P, TURNED + 2, _MADE)
    own_east, own_north = y - made.x, -x - made.y
    if own_east * own_east + own_north * own_north <= least * least:
        return NOTHING_TOLD
    moved = vector(P, row, _ERROR)
    would: Vec3 = float(P[row, _SEEN]) * cross(field, Vec3(y, -x, 0.0))
    return TILTED if dot(moved, moved) >= _STANDS**2 * dot(would, would) else UNDER_WAY


@compiled
def put_rested(P: Floats, rested: bool) -> None:
    """Whether the sensor has rested since its attitude began."""
    P[TURNED + 2, _RESTED] = 1.0 if rested else 0.0


@compiled
def take_correction(P: Floats, s: Sums) -> None:
    """What the block's corrections would have made of tilt and bias, were there nothing to correct."""
    made, learned = vector(P, TURNED + 2, _MADE), vector(P, TURNED + 2, _LEARNED)
    kept = _HELD / (_HELD + s.time)
    turned: Vec3 = s.rotation @ learned
    put(P, TURNED + 2, _MADE, kept * (made + turned) - vector(P, X, TURN))
    put(P, TURNED + 2, _LEARNED, kept * learned + vector(P, X, BIAS))


@compiled
def judged(P: Floats, lean: int, dt: float) -> int:
    """*lean*, but that of a body that has been under way for too long: what is not looked at drifts."""
    seconds = float(P[TURNED + 2, _UNDER_WAY])
    seconds = seconds + dt if lean == UNDER_WAY else max(seconds - dt, 0.0)
    P[TURNED + 2, _UNDER_WAY] = seconds
    return TILTED if seconds > _LONGEST else lean


@compiled
def go_on_under_way(method: SelfCalibrating, P: Floats) -> None:
    """The velocity that it has is its own, and tells nothing of the tilt; nor is it known how soon it loses that again."""
    put(P, SENSOR, 9, ZERO)
    P[SENSOR, _WANDER] = method.fastest**2
    forget(P, VELOCITY, 3, 1.0)


@compiled
def forget_lean(P: Floats) -> None:
    """Nothing seen yet, but whether it has rested."""
    rested = P[TURNED + 2, _RESTED]
    for i in range(3):
        for k in range(_PUSH, _SEEN + 1):
            P[TURNED + i, k] = 0.0
    P[TURNED + 2, _RESTED] = rested
