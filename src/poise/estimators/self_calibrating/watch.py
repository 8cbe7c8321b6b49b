"""Whether gravity has contradicted the tilt for so long that the gyroscope's bias must have changed.

A filter that is sure of its bias follows gravity slowly, and takes what contradicts it for motion. Motion has no mean for
long, though: over seconds the mean specific force stands upright, by as much as the motion that is in it lets one expect.
"""

from __future__ import annotations

from math import atan2, radians, sqrt
from typing import TYPE_CHECKING

from poise.estimators.self_calibrating.covariance import forget
from poise.estimators.self_calibrating.leans import NOTHING_TOLD, forget_lean, judged, lean_of, take_lean, told
from poise.estimators.self_calibrating.model import BIAS, KEPT, SUMS, TURN, TURNED, VELOCITY, Floats, Sums, put, vector
from poise.estimators.self_calibrating.recall import recall
from poise.math.compiled import compiled
from poise.math.matrices import Mat3
from poise.math.vectors import ZERO, Vec3, cross, dot

if TYPE_CHECKING:
    from poise.estimators.self_calibrating.causal import SelfCalibrating

_MEAN = 10  # where the row of sums keeps the mean of the horizontal specific force (2) and of the square of all of it
_SEEN, _TURNED = 13, 16  # and of a calm stretch the field it began with (3) and the turn since (3), body frame
_FIELD = 19  # and the mean of the field as it was seen (3), Earth frame, of its square, and of its misfit
_UNSETTLED = 24  # and the seconds that the attitude is unsettled for, after the bias was doubted
_SURE_TILT = radians(3.0)  # after which it is settled all the same
_SAME, _STEADY = 0.1, 0.12  # lengths that its north and up may be off, and that it may stray from its mean
_UNDISTURBED = 0.07  # lengths that dip and length may be off, for four times as long
_FAR = 1.0  # rad: a turn after which the field is looked at anew: it may come back
_WOULD_LEAN = 0.1  # rad: gravity would have moved by as much; a vehicle in a bend leans a little less than upright
_WOULD_SHOW, _SHOWS = 0.05, 0.3  # lengths: the field would have moved by as much, and moved by that share of it
_JUMP = 54.0  # spreads, squared length: a change from block to block of three sigma about each axis is a magnet's, not a bias's
_LAST = 21  # where, in the row of what was known before, the field of the block before is (3)
_UPRIGHT = 21  # and in the row behind it, up in the body as _SEEN was seen (3)
_SLOW = 25  # and the mean of the horizontal specific force over twice the time (2)
_PER_BIAS = 9  # and where rows of what a block adds up keep how a bias has turned the attitude lately, J (9)
_WATCHED = 27  # and for how many seconds: a mean of less than watch_time is that of one movement
_OF_MOTION, _OF_LONGER = 0.6, 0.4  # s: of the motion's root mean square that share of a second may be left in a mean


@compiled
def contradicted(method: SelfCalibrating, P: Floats, s: Sums, still: Vec3, error: Vec3, field: Vec3) -> int:
    """Takes the block into the means, and says what they tell of: TILTED, the tilt cannot be right (eq. 22).

    *still* is the mean rate without the bias, *error* that of the *field* in lengths, Earth frame, ZERO where none was seen.
    """
    P[SUMS + 2, _UNSETTLED] = max(float(P[SUMS + 2, _UNSETTLED]) - s.time, 0.0)
    row, share = SUMS + 2, s.time / (method.watch_time + s.time)
    if s.force_time == 0.0:  # what was seen before says less and less
        for k in (_MEAN, _MEAN + 1, _SLOW, _SLOW + 1):
            P[row, k] -= share * P[row, k]
        return NOTHING_TOLD
    lean = lean_of(P, s, still, error, method.gravity)
    take_lean(P, 0, share, lean)
    x = float(P[row, _MEAN]) + share * (lean.x - float(P[row, _MEAN]))
    y = float(P[row, _MEAN + 1]) + share * (lean.y - float(P[row, _MEAN + 1]))
    square = s.excess_square / (s.samples * method.gravity * method.gravity)
    square = float(P[row, _MEAN + 2]) + share * (square - float(P[row, _MEAN + 2]))
    P[row, _MEAN], P[row, _MEAN + 1], P[row, _MEAN + 2] = x, y, square
    share = s.time / (2.0 * method.watch_time + s.time)
    take_lean(P, 1, share, lean)
    longer_x = float(P[row, _SLOW]) + share * (lean.x - float(P[row, _SLOW]))
    longer_y = float(P[row, _SLOW + 1]) + share * (lean.y - float(P[row, _SLOW + 1]))
    P[row, _SLOW], P[row, _SLOW + 1] = longer_x, longer_y
    P[row, _WATCHED] = min(float(P[row, _WATCHED]) + s.time, 2.0 * method.watch_time)
    if P[row, _WATCHED] < method.watch_time:
        return NOTHING_TOLD
    motion = sqrt(max(square - (x * x + y * y), 0.0))
    least = method.watch_tilt + _OF_MOTION / method.watch_time * motion
    least_longer = method.watch_tilt + _OF_LONGER / (2.0 * method.watch_time) * motion
    soon, later = told(method, P, 0, x, y, least, field), told(method, P, 1, longer_x, longer_y, least_longer, field)
    return judged(P, max(soon, later), s.time)


@compiled
def turn_per_bias(P: Floats, rotation: Mat3, share: float) -> None:
    """J ← (1 − share) J − S_R: how far one rad/s of a bias, new since about *watch_time*, has turned the attitude."""
    for i in range(3):
        row = rotation.x if i == 0 else (rotation.y if i == 1 else rotation.z)
        put(P, TURNED + i, _PER_BIAS, (1.0 - share) * vector(P, TURNED + i, _PER_BIAS) - row)


@compiled
def turned_away(method: SelfCalibrating, P: Floats, s: Sums, seen: Vec3, field: Vec3, spread: float) -> bool:
    """Whether the field stands there as it always did, but another way round: then it is the heading that has turned (eq. 23).

    *seen* and *field* in lengths, Earth frame; *spread* the mean square of an axis. What disturbs a field changes its dip
    or length, moves with the body, or came all at once, where a wrong bias turns the heading little by little.
    """
    row = SUMS + 2
    share = s.mag_time / (method.watch_time + s.mag_time)
    mean = vector(P, row, _FIELD)
    mean = mean + share * (seen - mean)
    put(P, row, _FIELD, mean)
    square = float(P[row, _FIELD + 3])
    square += share * (dot(seen, seen) - square)
    P[row, _FIELD + 3] = square
    up, longer = seen.z - field.z, sqrt(dot(seen, seen)) - 1.0
    misfit = float(P[row, _FIELD + 4])
    misfit += 0.25 * share * (up * up + longer * longer - misfit)
    last = vector(P, KEPT, _LAST)
    put(P, KEPT, _LAST, seen)
    jump = seen - last
    if last != ZERO and dot(jump, jump) > _JUMP * spread:
        misfit = 1.0  # and so for twenty times watch_time, in which the magnet is learned, nothing is concluded
    P[row, _FIELD + 4] = misfit
    if misfit > _UNDISTURBED**2:
        return False
    north = sqrt(mean.x * mean.x + mean.y * mean.y)
    strayed = square - dot(mean, mean)
    if abs(north - field.y) > _SAME or abs(mean.z - field.z) > _SAME or strayed > _STEADY**2:
        return False
    return abs(atan2(mean.x, mean.y)) > method.watch_heading and mean.x * mean.x > strayed  # not all of it is new


@compiled
def turns_alone(P: Floats, field: Vec3, up: Vec3, off: Vec3, time: float, rest: bool, calm: bool) -> bool:
    """Whether the gyroscope alone turns, evenly, by *off* rad/s beside the bias, and what is seen in the body stands (eq. 24).

    *field* in lengths, *up* the specific force in g; ZERO where nothing was measured. At rest the field is
    enough. A *calm* body may turn as evenly as that, with a magnet on it whose field stands: there gravity must stand too.
    The turn about what is seen shows nowhere.
    """
    row = SUMS + 2
    if not calm:
        put(P, row, _SEEN, ZERO)
        return False
    seen, upright = vector(P, row, _SEEN), vector(P, KEPT + 1, _UPRIGHT)
    turned = vector(P, row, _TURNED) + time * off
    put(P, row, _TURNED, turned)
    if field == ZERO:
        return False
    if seen == ZERO or dot(turned, turned) > _FAR**2:
        put(P, row, _SEEN, field)
        put(P, KEPT + 1, _UPRIGHT, up)
        put(P, row, _TURNED, ZERO)
        return False
    would, moved = cross(turned, seen), field - seen
    stands = dot(would, would) > _WOULD_SHOW**2 and dot(moved, moved) < _SHOWS**2 * dot(would, would)
    if rest or not stands or up == ZERO:
        return rest and stands
    would, moved = cross(turned, upright), up - upright
    return dot(would, would) > _WOULD_LEAN**2 and dot(moved, moved) < _SHOWS**2 * dot(would, would)


@compiled
def doubt_bias(method: SelfCalibrating, P: Floats) -> None:
    """The bias is as unknown as at the start, and so the attitude is uncertain by more than what was seen of its error."""
    row = SUMS + 2
    off = float(P[row, _MEAN]) ** 2 + float(P[row, _MEAN + 1]) ** 2
    forget(P, BIAS, 3, 0.0)
    forget(P, TURN, 2, max(4.0 * off, method.initial_tilt**2))
    mean = vector(P, row, _FIELD)
    away = atan2(mean.x, mean.y)  # 0 where none has been seen
    heading = float(P[TURN + 2, TURN + 2]) + 9.0 * max(off, method.initial_tilt**2) + away * away
    forget(P, TURN + 2, 1, min(heading, method.initial_heading**2))
    unsure_bias(P, method.initial_bias**2)
    forget(P, VELOCITY, 3, 1.0)
    recall(P, 0.5 * float(P[row, _FIELD + 4]))
    forget_watch(P)
    P[row, _UNSETTLED] = method.watch_time


@compiled
def unsure_bias(P: Floats, variance: float) -> None:
    """P_b += *variance*: what is off in the bias has turned the attitude, J δb, and the one tells of the other (eq. 26)."""
    for k in range(3):
        P[BIAS + k, BIAS + k] += variance
    for i in range(3):
        own = variance * vector(P, TURNED + i, _PER_BIAS)
        for k in range(3):
            P[TURN + i, TURN + k] += dot(own, vector(P, TURNED + k, _PER_BIAS))
        put(P, TURN + i, BIAS, vector(P, TURN + i, BIAS) + own)
        P[BIAS, TURN + i] += own.x
        P[BIAS + 1, TURN + i] += own.y
        P[BIAS + 2, TURN + i] += own.z


@compiled
def settled(P: Floats) -> bool:
    """Whether the bias has not been doubted for a while, or gravity has made the tilt sure again since."""
    return float(P[SUMS + 2, _UNSETTLED]) <= 0.0 or P[TURN, TURN] + P[TURN + 1, TURN + 1] < 2.0 * _SURE_TILT**2


@compiled
def forget_watch(P: Floats) -> None:
    """Nothing seen yet."""
    put(P, SUMS + 2, _MEAN, ZERO)
    put(P, SUMS + 2, _SEEN, ZERO)
    put(P, SUMS + 2, _FIELD, ZERO)
    put(P, KEPT, _LAST, ZERO)
    for i in range(3):
        put(P, TURNED + i, _PER_BIAS, ZERO)
    forget_lean(P)
    P[SUMS + 2, _FIELD + 3], P[SUMS + 2, _FIELD + 4] = 0.0, 0.0
    P[SUMS + 2, _SLOW], P[SUMS + 2, _SLOW + 1], P[SUMS + 2, _WATCHED] = 0.0, 0.0, 0.0
