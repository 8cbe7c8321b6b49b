"""The end of a block of SelfCalibrating: how its errors have grown, what rest, gravity and field say of them, what follows.

Steps 4 to 9 of ``docs/methods/self-calibrating.md``, which derives them.
"""

from __future__ import annotations

from math import atan2, sqrt
from typing import TYPE_CHECKING

from poise.estimators.self_calibrating.another_field import forget_field, forget_seen, look_at_field
from poise.estimators.self_calibrating.covariance import correct, correct_one, enter_block, forget, grow, symmetrise
from poise.estimators.self_calibrating.delay import expected_delay
from poise.estimators.self_calibrating.expected_scale import expect_more
from poise.estimators.self_calibrating.first_block import begun_at, in_motion, turned_sums
from poise.estimators.self_calibrating.iron import ANOTHER_WAY, forget_lengths
from poise.estimators.self_calibrating.leans import TILTED, UNDER_WAY, go_on_under_way, put_rested, take_correction
from poise.estimators.self_calibrating.learned import iron_from_before, of_this_unit
from poise.estimators.self_calibrating.lengths import add_turn
from poise.estimators.self_calibrating.model import (
    ACC_BIAS,
    ACC_DELAY,
    ACC_SCALE,
    ANOTHER_BIAS,
    ANOTHER_IRON,
    ANOTHER_NORTH,
    ANOTHER_VELOCITY,
    BEGUN_ANEW,
    BIAS,
    FIELD,
    GOES_ON,
    HEADING_SET,
    HELD,
    IRON,
    JUST_FOUND,
    MAG_DELAY,
    SCALE,
    SIZE,
    SUMS,
    TURN,
    VELOCITY,
    Floats,
    H,
    Noise,
    Sensor,
    State,
    Sums,
    X,
    begin_block,
    put,
    put_sensor,
    three,
    vector,
)
from poise.estimators.self_calibrating.recall import begin_memory, remember
from poise.estimators.self_calibrating.unproven import ANY, begin_open, judge_heading
from poise.estimators.self_calibrating.watch import (
    contradicted,
    doubt_bias,
    forget_watch,
    turn_per_bias,
    turned_away,
    turns_alone,
)
from poise.math.compiled import compiled
from poise.math.matrices import Mat3, matrix, transpose
from poise.math.quaternions import conjugate, exp, log, normalize
from poise.math.vectors import UP, ZERO, Vec3, dot, norm

if TYPE_CHECKING:
    from poise.estimators.self_calibrating.causal import SelfCalibrating

_UNKNOWN = 0.5  # rad: σ of a heading that a correction, which is linear, may not reach
_TEACHES = 10.0  # s of a rest that tell of the accelerometer's bias; then what jitters is regressed on itself
_ANOTHER = 100.0  # lengths: what was taken for the field, so much smaller than what came then, was none


@compiled
def closed(method: SelfCalibrating, state: State, s: Sums, known: Sensor) -> State:
    """The state after the end of a block: 4. covariance, 5. rest, 6. pseudo-velocity, 7. magnetometer, 8. inject."""
    P = state.P
    T, rate_square = s.time, s.rate_square / s.samples
    still = (1.0 / s.samples) * s.gyr - state.bias
    rest = state.still >= method.rest_time

    q = state.attitude
    if not state.begun:  # 1. Where up and north are
        q = begun_at(method, P, q, s, known.length)
        s = turned_sums(P, s, q * conjugate(state.attitude), method.gravity)

    # 4. Covariance
    walk = method.bias_walk_rest if rest else method.bias_walk
    noise = Noise(
        (method.gyr_noise**2 + method.scale_noise**2 * rate_square) * T + s.unmeasured,
        walk**2 * T,
        (method.acc_noise**2 + method.motion_noise**2 * s.excess_square / s.samples) * T
        + method.shock_noise**2 * s.jump_square,
        method.field_walk**2 * T,
        method.iron_walk**2 * T,
        method.acc_bias_walk**2 * T,
    )
    P[SUMS, HELD] = 1.0 if state.still > _TEACHES else 0.0
    grow(P, s, noise, method.gravity)
    if s.force_time == 0.0:
        lose_velocity(P, known.wander, T / method.speed_time if method.speed_time > T else 1.0)
    add_clipping(P, s.clipped, 0.4 * method.gyr_range)
    acc_delay = expected_delay(P, known.acc_delay, state.begun, T / s.samples)
    v = known.velocity + s.force - (method.gravity * s.force_time) * UP
    for j in range(SIZE):
        P[X, j] = 0.0

    # 5. At rest the mean rate is the bias, 6. the pseudo-velocity is near 0
    if rest and likely_bias(method, P, still):
        variance = method.rest_noise**2 * method.block / T
        correct_one(P, BIAS, still.x, variance)
        correct_one(P, BIAS + 1, still.y, variance)
        correct_one(P, BIAS + 2, still.z, variance)
    wander = known.wander
    if s.force_time > 0.0 and (state.begun or not in_motion(method, P)):
        if rest:
            variance = method.rest_speed**2 * method.block / T
        else:
            share, usual = T / (method.spread_time + T), wander + method.speed**2
            wander += share * (min(dot(v, v) / 3.0, 9.0 * usual) - wander)
            wander = min(wander, method.fastest**2)  # what it follows less it strays from more
            variance = (method.speed**2 + method.speed_time * wander) / s.force_time
        correct_one(P, VELOCITY, -v.x, variance)
        correct_one(P, VELOCITY + 1, -v.y, variance)
        correct_one(P, VELOCITY + 2, -v.z, variance)

    # 7. Magnetometer
    field, length, spread, iron = known.field, known.length, known.spread, known.iron
    anew = not state.begun
    e, turned = ZERO, 0.0
    if s.mags > 0.0:
        e = (1.0 / s.mags) * s.off
        if length < 0.0:  # a hard iron from before, in lengths of the field there
            to_iron: Mat3 = (1.0 / s.mags) * s.to_iron
            held = iron_from_before(known.iron, -length, e, to_iron)
            if not of_this_unit(known.iron, -length, e, to_iron):
                begin_open(P, method.least_iron)
                forget(P, IRON, 3, method.initial_iron**2)
                put(P, X, IRON, ZERO)
            there: Vec3 = to_iron @ held
            e = e - there
            iron = held / norm(e)
        if length <= 0.0:
            length = norm(e)
            field = Vec3(0.0, sqrt(e.x * e.x + e.y * e.y) / length, e.z / length)
            q = exp(atan2(e.x, e.y) * UP) * q
        elif dot(e, e) > _ANOTHER**2:
            length, anew, iron = 0.0, True, ZERO
            forget_lengths(P)
            begin_open(P, method.least_iron)
            forget_field(P)
            forget(P, IRON, 3, method.initial_iron**2)
            put(P, X, IRON, ZERO)
            forget(P, FIELD, 2, 0.25)
            forget(P, TURN + 2, 1, method.initial_heading**2)
        elif (
            P[TURN + 2, TURN + 2] > _UNKNOWN**2
            and dot(iron, iron) > method.least_iron**2  # which the sample that it was begun anew from may be smeared by
            and abs(atan2(e.x, e.y + field.y)) > ANOTHER_WAY
        ):
            turned, anew = atan2(e.x, e.y + field.y), True
            q = exp(turned * UP) * q
            forget_seen(P)
            forget(P, TURN + 2, 1, _UNKNOWN**2)
            e = Vec3(0.0, sqrt(e.x * e.x + (e.y + field.y) ** 2) - field.y, e.z)
        else:
            share = s.mag_time / (method.spread_time + s.mag_time)
            spread += share * (min(dot(e, e) / 3.0, 9.0 * spread) - spread)
            beyond_own = max(dot(e, e) - field.y * field.y * float(P[TURN + 2, TURN + 2]), 0.0)
            own = max(spread, beyond_own / 27.0)
            variance = (method.field_time * own + method.block * method.mag_rate_noise**2 * rate_square) / s.mag_time
            all_axes = P[0, 0] + P[1, 1] > 2.0 * method.sure_tilt**2
            told = from_behind(e, field)
            correct_field(P, told, field, (1.0 / s.mags) * s.to_iron, (1.0 / s.mags) * s.to_delay, all_axes, variance)
    if not rest:  # 13. Of a gyroscope that is worse than expected
        expect_more(P, method.initial_scale)
    symmetrise(P)
    seen = e + field if s.mags > 0.0 and length > 0.0 else ZERO
    at_hand, upright = ZERO, ZERO  # body frame, in lengths of the field and in g
    calm = state.calm >= method.rest_time
    if calm:
        to_body = transpose(matrix(q))
        at_hand = to_body @ seen
        upright = to_body @ ((1.0 / (method.gravity * s.force_time)) * s.force) if s.force_time > 0.0 else ZERO
    rate_is_bias = turns_alone(P, at_hand, upright, still, T, rest, calm)
    missed = e if s.mags > 0.0 and known.length > 0.0 and not anew else ZERO
    if rest:
        put_rested(P, True)
    lean = contradicted(method, P, s, still, missed, field)
    bias_changed = lean == TILTED or rate_is_bias
    bias_changed = bias_changed or (state.begun and s.mags > 0.0 and turned_away(method, P, s, seen, field, spread))

    # 8. Inject
    after = Sensor(
        known.scale + three(P, X, SCALE),
        v + vector(P, X, VELOCITY),
        field + Vec3(0.0, float(P[X, FIELD]), float(P[X, FIELD + 1])),
        iron + vector(P, X, IRON),
        known.mag_delay + float(P[X, MAG_DELAY]),
        acc_delay + float(P[X, ACC_DELAY]),
        length,
        spread,
        wander,
        known.acc_bias + vector(P, X, ACC_BIAS),
        known.acc_scale + float(P[X, ACC_SCALE]),
    )
    q = normalize(exp(vector(P, X, TURN)) * q)
    event = BEGUN_ANEW if anew else GOES_ON
    if not rest:
        add_turn(P, T * still)
    if s.mags > 0.0 and known.length > 0.0 and not anew and not bias_changed:  # 10. to 12. Iron, and another field
        by_block = matrix(exp(vector(P, X, TURN)))  # the attitude has been corrected since
        R: Mat3 = (1.0 / s.mags) * (by_block @ s.to_iron)
        after, turned, event = look_at_field(method, P, s, by_block @ seen, R, rate_square, iron, after)
        if event != GOES_ON:
            q = exp(turned * UP) * q
            forget_watch(P)
    put_sensor(P, after)
    if state.begun:
        remember(P, after, T)
    else:
        begin_memory(P, after)
    take_correction(P, s)
    turn_per_bias(P, s.rotation, T / (method.watch_time + T))
    if bias_changed:  # 9. What was thought to be known of it is not
        doubt_bias(method, P)
        event = ANOTHER_BIAS
        forget_seen(P)
    elif lean == UNDER_WAY:
        go_on_under_way(method, P)
        event = ANOTHER_VELOCITY if event == GOES_ON else event
    rested = state.still
    if rate_is_bias:  # and it rests, however far that is from the bias of before
        rested = state.calm
        correct_one(P, BIAS, still.x, method.rest_noise**2)
        correct_one(P, BIAS + 1, still.y, method.rest_noise**2)
        correct_one(P, BIAS + 2, still.z, method.rest_noise**2)
    if not state.begun:  # the rows of the first block are behind by all that its end has turned
        put(P, X, TURN, log(q * conjugate(state.attitude)))
    enter_block(P, s, event, method.gravity)
    begin_block(P)
    P[SUMS + 1, HEADING_SET] = turned
    P[SUMS + 1, JUST_FOUND] = event if event in (ANOTHER_IRON, ANOTHER_NORTH) else GOES_ON
    if after.length > 0.0 and method.least_iron < ANY:  # 11. What iron there may be beside that
        judge_heading(P, matrix(q).x, after.field.y)
    bias = state.bias + vector(P, X, BIAS)
    return State(q, bias, state.rate, state.mean_gyr, state.mean_acc, state.calm, rested, True, P)


@compiled
def likely_bias(method: SelfCalibrating, P: Floats, off: Vec3) -> bool:
    """Whether a mean rate this far from the bias can be the bias itself: a slow, even turn is not."""
    most = 25.0  # five sigma, squared
    own = method.rest_noise**2
    x, y, z = float(P[BIAS, BIAS]) + own, float(P[BIAS + 1, BIAS + 1]) + own, float(P[BIAS + 2, BIAS + 2]) + own
    return off.x * off.x < most * x and off.y * off.y < most * y and off.z * off.z < most * z


@compiled
def from_behind(e: Vec3, field: Vec3) -> Vec3:
    """The field's error *e*; of a field that points south, as if it were small: the heading's part by its angle (eq. 14a).

    East alone is nothing where the heading is half a turn off, and a heading that is would stay so.
    """
    north = e.y + field.y
    if north >= 0.0:
        return e
    return Vec3(field.y * atan2(e.x, north), sqrt(e.x * e.x + north * north) - field.y, e.z)


@compiled
def correct_field(
    P: Floats, e: Vec3, field: Vec3, to_iron: Mat3, to_delay: Vec3, all_axes: bool, variance: float
) -> None:
    """The three numbers of the field's error e = [h]× ε + δh + R₀ δb + R₀ (ω × u) δτ (eq. 14).

    Of [h]× only what turns the heading, unless the tilt is unsure: a disturbed field is not to tilt the horizon.
    """
    for k in range(3):
        for j in range(SIZE):
            P[H, j] = 0.0
        row = to_iron.x if k == 0 else (to_iron.y if k == 1 else to_iron.z)
        put(P, H, IRON, row)
        if k == 0:
            P[H, TURN + 2] = field.y
            P[H, TURN + 1] = -field.z if all_axes else 0.0
            P[H, MAG_DELAY] = to_delay.x
            correct(P, e.x, variance)
        elif k == 1:
            P[H, TURN] = field.z if all_axes else 0.0
            P[H, FIELD] = 1.0
            P[H, MAG_DELAY] = to_delay.y
            correct(P, e.y, variance)
        else:
            P[H, TURN] = -field.y if all_axes else 0.0
            P[H, FIELD + 1] = 1.0
            P[H, MAG_DELAY] = to_delay.z
            correct(P, e.z, variance)


@compiled
def lose_velocity(P: Floats, wander: float, share: float) -> None:
    """P_v += 2 σ_w² share: a velocity that was not measured goes over into another, of the same mean square."""
    for k in range(VELOCITY, VELOCITY + 3):
        P[k, k] += 2.0 * wander * share


@compiled
def add_clipping(P: Floats, clipped: Mat3, error: float) -> None:
    """Q_ε += V Vᵀ error²: a clipped rate is wrong by any part of the range, the same way for as long as it lasts (eq. 11)."""
    C: Mat3 = (error * error) * (clipped @ transpose(clipped))
    P[0, 0] += C.x.x
    P[0, 1] += C.x.y
    P[0, 2] += C.x.z
    P[1, 0] += C.y.x
    P[1, 1] += C.y.y
    P[1, 2] += C.y.z
    P[2, 0] += C.z.x
    P[2, 1] += C.z.y
    P[2, 2] += C.z.z
