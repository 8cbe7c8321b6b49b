"""Attitude control: what is promised of every torque, and what a rigid body does under it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from math import degrees, inf, nan, pi, radians, sqrt
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import poise
from helpers import angle_between, random_quats
from poise.control import AttitudeControl, Controller, Slew, Target, lqr
from poise.control.attitude import checked
from poise.control.balance import BalanceControl, Balancer
from poise.control.target import NO_ATTITUDE
from poise.data.attitude import Attitude
from poise.data.flags import Flag
from poise.errors import MethodError
from poise.estimators.protocol import start, step
from poise.math import arrays
from poise.math.quaternions import IDENTITY, Quat, exp, renormalized
from poise.math.vectors import ZERO, Vec3

Floats = NDArray[np.float64]
INERTIA = np.array([[0.02, 0.002, 0.0], [0.002, 0.03, -0.001], [0.0, -0.001, 0.04]])
DT = 0.005
PD = AttitudeControl.design(INERTIA, 1.0)
few = settings(max_examples=8, deadline=None)
seeds = st.integers(0, 10_000)


def row(quat: Any, rate: Any = (0.0, 0.0, 0.0), time: float = 0.0, flags: int = 0) -> Attitude:
    """What a stream would say of a body, in one row."""
    table = np.zeros((1, 16))
    table[0, :4], table[0, 4:7] = quat, rate
    return Attitude(np.array([time]), table, np.array([flags], np.uint32))


def flown(
    controller: Controller,
    quat: Any,
    rate: Any = (0.0, 0.0, 0.0),
    seconds: float = 6.0,
    push: Any = (0.0, 0.0, 0.0),
    see: Callable[[int, Floats, Floats, Floats], None] | None = None,
) -> tuple[Floats, Floats]:
    """Attitude and rate of a rigid body after *seconds* under *controller* and a constant torque *push* (N m, body)."""
    q, w, back = np.array(quat, float), np.array(rate, float), np.linalg.inv(INERTIA)
    fine = 5
    for i in range(round(seconds / DT)):
        torque = controller.update(row(q, w, i * DT))[0]
        if see is not None:
            see(i, q, w, torque)
        for _ in range(fine):
            x, y, z = INERTIA @ w
            gyration = (w[1] * z - w[2] * y, w[2] * x - w[0] * z, w[0] * y - w[1] * x)
            w = w + DT / fine * (back @ (torque + push - gyration))
            q = np.array(renormalized(Quat(*q.tolist()) * exp(Vec3(*(DT / fine * w).tolist()))))
    return q, w


def holding(control: AttitudeControl, slew: Slew | None = None, goal: Any = IDENTITY) -> Controller:
    controller = Controller(control, slew)
    controller.hold(goal)
    return controller


def one_torque(control: AttitudeControl, attitude: Attitude, target: Target) -> Floats:
    controller = Controller(control)
    controller.follow(target)
    return controller.update(attitude)[0]


# ---------------------------------------------------------------------------------------------------------------------
# The body under it


@few
@given(seeds)
def test_a_body_comes_to_rest_at_its_goal_from_any_attitude_and_rate(seed: int) -> None:
    random = np.random.default_rng(seed)
    start_at, goal = random_quats(2, seed)
    q, w = flown(holding(PD, goal=goal), start_at, 3.0 * random.normal(size=3), 5.0)
    assert angle_between(q, goal) < radians(0.1) and np.linalg.norm(w) < 0.01


@few
@given(seeds)
def test_with_limits_too_and_within_them(seed: int) -> None:
    limits = np.array([0.05, 0.08, 0.06])
    control = AttitudeControl.design(INERTIA, 1.0, torque_limit=Vec3(*limits.tolist()), rate_limit=1.0)
    start_at, goal = random_quats(2, seed)
    fastest = [0.0]

    def see(_: int, q: Floats, w: Floats, torque: Floats) -> None:
        assert (np.abs(torque) <= limits * (1.0 + 1e-12)).all()
        fastest[0] = max(fastest[0], float(np.linalg.norm(w)))

    q, w = flown(holding(control, goal=goal), start_at, seconds=9.0, see=see)
    assert angle_between(q, goal) < radians(0.2) and np.linalg.norm(w) < 0.02
    assert fastest[0] < 1.02


@few
@given(seeds)
def test_energy_and_error_together_only_fall(seed: int) -> None:
    """V = ½ω·ω + 4k(1 − |w|) is what the law of Wie, Weiss and Arapostathis brings down: V' = −d|ω|²."""
    k = (2.0 * pi) ** 2
    values: list[float] = []

    def see(_: int, q: Floats, w: Floats, torque: Floats) -> None:
        values.append(0.5 * float(w @ w) + 4.0 * k * (1.0 - abs(float(q[0]))))

    slow = AttitudeControl.design(INERTIA, 1.0, 0.5)
    flown(holding(slow), random_quats(1, seed)[0], np.random.default_rng(seed).normal(size=3), 3.0, see=see)
    # the torque holds still for 5 ms: the first order in time of what that can add
    assert max(np.diff(values) - 2e-3 * np.array(values[:-1])) < 1e-9
    assert values[-1] < 1e-2 * values[0]


@few
@given(seeds, st.booleans())
def test_an_attitude_and_its_negative_are_one(seed: int, other: bool) -> None:
    a, b = random_quats(2, seed)
    rate = np.random.default_rng(seed).normal(size=3)
    kept, turned = holding(PD, goal=b), holding(PD, goal=-b if other else b)
    sign = 1.0
    for i in range(5):
        expected = kept.update(row(a, rate, i * DT))
        np.testing.assert_allclose(turned.update(row(sign * a, rate, i * DT)), expected, atol=1e-12)
        sign = -sign


@few
@given(seeds)
def test_the_way_back_is_never_longer_than_the_way_there(seed: int) -> None:
    """No unwinding: from rest the body never turns further than the smallest angle to its goal."""
    start_at, goal = random_quats(2, seed)
    turned = [0.0]

    def see(_: int, q: Floats, w: Floats, torque: Floats) -> None:
        turned[0] += float(np.linalg.norm(w)) * DT

    flown(holding(PD, goal=goal), start_at, see=see)
    assert turned[0] < 1.01 * float(angle_between(start_at, goal)) + 0.01


def test_noise_about_half_a_turn_does_not_make_it_hesitate() -> None:
    controller = holding(PD)
    noise = np.random.default_rng(1)
    torques = []
    for i in range(200):
        angle = pi + radians(0.5) * noise.normal()
        torques.append(controller.update(row([np.cos(angle / 2), np.sin(angle / 2), 0, 0], time=i * DT))[0])
    signs = np.sign(np.array(torques)[:, 0])
    assert abs(signs.sum()) == len(signs)  # and the side is left once the other is clearly shorter:
    angle = radians(200.0 if signs[0] < 0 else 160.0)
    back = controller.update(row([np.cos(angle / 2), np.sin(angle / 2), 0, 0], time=1.0))[0]
    assert np.sign(back[0]) == -signs[0]


def test_integral_takes_a_constant_torque_out() -> None:
    push = np.array([0.02, -0.01, 0.03])
    stays = flown(holding(PD), IDENTITY, push=push, seconds=8.0)[0]
    gone = flown(holding(AttitudeControl.design(INERTIA, 1.0, integral=0.3)), IDENTITY, push=push, seconds=8.0)[0]
    assert angle_between(stays, IDENTITY) > radians(0.9)
    assert angle_between(gone, IDENTITY) < radians(0.01)


def test_the_integral_does_not_wind_up_while_the_torque_is_at_its_limit() -> None:
    """Held from outside for 10 s and let go: a wound-up integral would carry the body far past its goal."""
    limited = AttitudeControl.design(INERTIA, 1.0, integral=0.3, torque_limit=(0.05, 0.05, 0.05))
    controller = holding(limited)
    away = np.array([np.cos(0.5), np.sin(0.5), 0.0, 0.0])
    for i in range(2000):
        controller.update(row(away, time=(i - 2000) * DT))
        assert i == 0 or controller.limited
    furthest = [0.0]

    def see(_: int, q: Floats, w: Floats, torque: Floats) -> None:
        furthest[0] = min(furthest[0], float(q[1]))

    q, _ = flown(controller, away, see=see, seconds=8.0)
    assert furthest[0] > -np.sin(radians(1.0) / 2) and angle_between(q, IDENTITY) < radians(0.2)


def test_feed_forward_follows_a_moving_target_without_a_lag() -> None:
    """A target that oscillates about two axes; without its rate and acceleration the body lags behind."""
    errors = {}
    for told in (True, False):
        controller = Controller(PD)
        worst = [0.0]
        q, w = np.array([1.0, 0, 0, 0]), np.zeros(3)
        attitude = IDENTITY
        for i in range(1200):
            t = i * DT
            rate = Vec3(1.5 * np.sin(2 * t), 1.0 - np.cos(3 * t), 0.0)
            acceleration = Vec3(3.0 * np.cos(2 * t), 3.0 * np.sin(3 * t), 0.0)
            controller.follow(Target(attitude, rate, acceleration) if told else Target(attitude))
            torque = controller.update(row(q, w, t))[0]
            w = w + DT * np.linalg.solve(INERTIA, torque - np.cross(w, INERTIA @ w))
            q = np.array(renormalized(Quat(*q.tolist()) * exp(Vec3(*(DT * w).tolist()))))
            attitude = renormalized(attitude * exp(DT * rate))
            worst[0] = max(worst[0], float(angle_between(q, np.array(attitude))))
        errors[told] = degrees(worst[0])
    assert errors[True] < 0.5 < 10.0 < errors[False]


def test_a_rate_is_held_wherever_it_leads() -> None:
    controller = Controller(AttitudeControl.design(INERTIA, 2.0, rate_limit=1.0))
    controller.turn((0.3, -0.4, 0.5))
    _, w = flown(controller, IDENTITY, seconds=3.0)
    np.testing.assert_allclose(w, [0.3, -0.4, 0.5], atol=1e-3)
    assert controller.doing == "rate"
    controller = Controller(AttitudeControl.design(INERTIA, 2.0, rate_limit=1.0))
    controller.turn((0.0, 3.0, 4.0))
    _, w = flown(controller, IDENTITY, seconds=3.0)
    np.testing.assert_allclose(w, [0.0, 0.6, 0.8], atol=1e-3)
    assert controller.limited == ("rate",)


# ---------------------------------------------------------------------------------------------------------------------
# Slews


@few
@given(seeds, st.floats(0.1, 5.0), st.floats(0.2, 20.0), st.booleans())
def test_a_slew_arrives_within_its_bounds_whatever_its_goal_does(
    seed: int, rate: float, acceleration: float, again: bool
) -> None:
    slew = Slew(rate, acceleration)
    first, goal, other = random_quats(3, seed)
    state = start(slew, Quat(*first.tolist()), ZERO)
    before = np.zeros(3)
    arrival = pi / rate + 2.0 * sqrt(pi / acceleration) + 2.0 * rate / acceleration
    steps = 150
    dt = arrival / 100
    for i in range(2 * steps):
        state = step(slew, state, dt, Quat(*(goal if i < steps / 3 or not again else other).tolist()))
        told = state.target
        now = np.array(told.rate)
        assert np.linalg.norm(now) <= rate * (1 + 1e-9)
        assert np.linalg.norm(now - before) <= acceleration * dt * (1 + 1e-9)
        np.testing.assert_allclose(np.array(told.acceleration) * dt, now - before, atol=1e-9)
        before = now
    assert angle_between(np.array(state.target.attitude), other if again else goal) < 1e-6
    assert np.linalg.norm(state.target.rate) < 1e-6


def test_a_slew_takes_the_time_of_a_trapezoid() -> None:
    slew, goal = Slew(1.0, 2.0), exp(Vec3(0.0, 0.0, 2.0))
    state, steps = start(slew, IDENTITY, ZERO), 0
    while angle_between(np.array(state.target.attitude), np.array(goal)) > 1e-6:
        state, steps = step(slew, state, 0.001, goal), steps + 1
        np.testing.assert_allclose([state.target.attitude.x, state.target.attitude.y], 0.0, atol=1e-12)
    assert abs(steps * 0.001 - (2.0 / 1.0 + 1.0 / 2.0)) < 0.01


@few
@given(seeds)
def test_a_body_follows_a_slew(seed: int) -> None:
    start_at, goal = random_quats(2, seed)
    controller = holding(PD, Slew(1.0, 2.0), goal)
    apart = [0.0]

    def see(_: int, q: Floats, w: Floats, torque: Floats) -> None:
        assert controller.target is not None
        apart[0] = max(apart[0], float(angle_between(q, np.array(controller.target.attitude))))

    q, _ = flown(controller, start_at, see=see)
    assert angle_between(q, goal) < radians(0.1) and apart[0] < radians(1.5)


def test_a_slew_begins_anew_where_the_body_is_after_a_loss() -> None:
    controller = holding(PD, Slew(1.0, 2.0), exp(Vec3(0.0, 0.0, 1.0)))
    away = np.array(exp(Vec3(1.0, 0.0, 0.0)))
    for i in range(100):
        controller.update(row([nan] * 4 if i < 50 else away, time=i * DT, flags=int(Flag.LOST) if i < 50 else 0))
        assert controller.doing == ("damping" if i < 50 else "attitude")
        if i == 50:
            assert controller.target is not None and angle_between(np.array(controller.target.attitude), away) < 1e-6


# ---------------------------------------------------------------------------------------------------------------------
# Bad input


def test_an_attitude_that_is_not_valid_is_not_acted_on() -> None:
    rate = np.array([0.1, -0.2, 0.3])
    tilted = np.array(exp(Vec3(0.5, 0.0, 0.0)))
    lost, silent = int(Flag.LOST), int(Flag.SILENT | Flag.GYR_MISSING)
    goal = Target(IDENTITY)
    plain = AttitudeControl.design(INERTIA, 1.0, gyroscopic=False)
    braking = -np.array(plain.damping) @ rate
    np.testing.assert_allclose(one_torque(plain, row(tilted, rate, flags=lost), goal), braking)
    np.testing.assert_allclose(one_torque(plain, row([nan] * 4, rate), goal), braking)
    off = plain._replace(when_invalid="off")
    assert not one_torque(off, row(tilted, rate, flags=lost), goal).any()
    for control in (plain, off):
        assert not one_torque(control, row(tilted, rate, flags=lost | silent), goal).any()
        assert not one_torque(control, row(tilted, [nan, 0.0, 0.0]), goal).any()
        held = one_torque(control, row(tilted, rate, flags=lost), Target(NO_ATTITUDE, Vec3(*rate.tolist())))
        np.testing.assert_allclose(held, 0.0, atol=1e-12)  # a rate needs no attitude


numbers = st.sampled_from([0.0, 1.0, -1.0, nan, inf, -inf, 1e-300, 1e200, -1e308, 0.3])


@settings(max_examples=300, deadline=None)
@given(st.lists(numbers, min_size=20, max_size=20), st.integers(0, 2**28 - 1), numbers, st.booleans())
def test_no_torque_is_ever_nan_or_over_the_limit(values: list[float], flags: int, time: float, slewed: bool) -> None:
    limited = AttitudeControl.design(INERTIA, 1.0, integral=0.1, torque_limit=(0.1, 0.2, 0.3))
    controller = Controller(limited, Slew() if slewed else None)
    controller.follow(Target(Quat(*values[7:11]), *(Vec3(*values[i : i + 3]) for i in (11, 14, 17))))
    controller.update(row([1, 0, 0, 0]))
    bad = controller.update(row(values[:4], values[4:7], time, flags))[0]
    after = controller.update(row([1, 0, 0, 0], time=1.0))[0]
    controller.hold(IDENTITY)
    fine = controller.update(row(np.array(exp(Vec3(0.1, 0, 0))), time=1.0 + DT))[0]
    for torque in (bad, after, fine):
        assert np.isfinite(torque).all() and (np.abs(torque) <= np.array([0.1, 0.2, 0.3]) * (1 + 1e-9)).all()
    assert controller.doing == "attitude"


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (lambda: AttitudeControl.design((0.1, 0.1, -0.1), 1.0), "inertia"),
        (lambda: AttitudeControl.design(nan, 1.0), "inertia"),
        (lambda: AttitudeControl.design([[1, 2], [3, 4]], 1.0), "inertia"),
        (lambda: AttitudeControl.design([[1, 0.5, 0], [0, 1, 0], [0, 0, 1]], 1.0), "inertia"),
        (lambda: AttitudeControl.design("heavy", 1.0), "inertia"),  # type: ignore[arg-type]
        (lambda: AttitudeControl.design(1.0, -1.0), "bandwidth_hz"),
        (lambda: AttitudeControl.design(1.0, inf), "bandwidth_hz"),
        (lambda: AttitudeControl.design(1.0, 1.0, 0.0), "damping"),
        (lambda: AttitudeControl.design(1.0, 1.0, integral=-0.1), "integral"),
        (lambda: AttitudeControl.optimal(1.0, rate_deg=0.0), "rate_deg"),
        (lambda: Controller(PD._replace(torque_limit=Vec3(1.0, 0.0, 1.0))), "torque_limit"),
        (lambda: Controller(PD._replace(torque_limit=1.0)), "torque_limit"),
        (lambda: Controller(PD._replace(rate_limit=nan)), "rate_limit"),
        (lambda: Controller(PD._replace(when_invalid="hope")), "when_invalid"),
        (lambda: Controller(PD._replace(damping=-1.0 * PD.damping)), "damping"),
        (lambda: Controller(PD._replace(stiffness=(1.0, 2.0))), "stiffness"),
        (lambda: Controller(PD, Slew(rate=0.0)), "rate"),
        (lambda: Controller(PD).hold((1.0, 0.0, 0.0)), "attitude"),
        (lambda: Controller(PD).hold((0.0, 0.0, 0.0, 0.0)), "attitude"),
        (lambda: Controller(PD).turn((1.0, nan, 0.0)), "rate"),
        (lambda: Controller("PD"), "AttitudeControl"),  # type: ignore[arg-type]
        (lambda: lqr([[0, 1], [0, 0]], [[0], [1]], np.eye(3), 1.0), "Q"),
        (lambda: lqr([[0, 1], [0, 0]], [[0], [1]], -np.eye(2), 1.0), "Q"),
        (lambda: lqr([[0, 1], [0, 0]], [[0], [1]], np.eye(2), 0.0), "R"),
        (lambda: lqr([[0, 1, 2]], [[0], [1]], np.eye(2), 1.0), "A"),
        (lambda: lqr([[1, 0], [0, 1]], [[0], [1]], np.eye(2), 1.0), "stabilises"),
    ],
)  # fmt: skip
def test_a_bad_parameter_is_named(make: Callable[[], Any], named: str) -> None:
    with pytest.raises(MethodError, match=named):
        make()


# ---------------------------------------------------------------------------------------------------------------------
# Design


def test_lqr_of_a_double_integrator_is_the_known_one() -> None:
    q, r = 4.0, 0.25  # K = (√(q/r), √(2 √(q/r))) for Q = diag(q, 0)
    gain = lqr([[0, 1], [0, 0]], [[0], [1]], [[q, 0], [0, 0]], [[r]])
    np.testing.assert_allclose(gain, [[sqrt(q / r), sqrt(2.0 * sqrt(q / r))]], rtol=1e-9)


@few
@given(seeds)
def test_no_other_gain_costs_less_than_the_regulator(seed: int) -> None:
    random = np.random.default_rng(seed)
    a, b = random.normal(size=(3, 3)), random.normal(size=(3, 2))
    gain = lqr(a, b, np.eye(3), np.eye(2))

    def cost(k: Floats) -> float:
        from scipy.linalg import solve_continuous_lyapunov

        closed = a - b @ k
        if not (np.linalg.eigvals(closed).real < 0).all():
            return inf
        return float(np.trace(solve_continuous_lyapunov(closed.T, -(np.eye(3) + k.T @ k))))

    assert cost(gain) <= min(cost(gain + 0.01 * random.normal(size=gain.shape)) for _ in range(5)) * (1 + 1e-9)


def test_placed_poles_are_where_they_were_asked_for() -> None:
    control = AttitudeControl.design(INERTIA, 0.5, 0.7, integral=0.2)
    j, k, d, i = (np.array(each) for each in control[:4])
    zero, one = np.zeros((3, 3)), np.eye(3)
    closed = np.block([[zero, one, zero], [zero, zero, one], [-np.linalg.solve(j, each) for each in (i, k, d)]])
    w = 2 * pi * 0.5
    poles = np.repeat([-0.2 * w, *np.roots([1, 2 * 0.7 * w, w * w])], 3)
    found = np.linalg.eigvals(closed)
    assert max(np.abs(found - pole).min() for pole in poles) < 1e-3 > max(np.abs(poles - each).min() for each in found)


@few
@given(seeds)
def test_the_regulator_of_a_body_brings_it_home(seed: int) -> None:
    control = AttitudeControl.optimal(INERTIA, error_deg=5.0, rate_deg=60.0, torque=0.05)
    np.testing.assert_allclose(np.array(control.stiffness), 0.05 / radians(5.0) * np.eye(3), rtol=1e-6, atol=1e-9)
    q, w = flown(holding(control), random_quats(1, seed)[0], seconds=8.0)
    assert angle_between(q, IDENTITY) < radians(0.5) and np.linalg.norm(w) < 0.02


# ---------------------------------------------------------------------------------------------------------------------
# Behind an estimator, compiled and plain

_PLAIN = """
import sys, numpy
from test_control import behind_an_estimator
numpy.save(sys.argv[1], behind_an_estimator())
"""


def behind_an_estimator() -> Floats:
    """The torques of a slewed PID behind AdaptiveGain on a made recording with a loss."""
    from poise.simulation import Sensor, forearm, measure

    recording = measure(forearm(6.0, 100.0, 4), Sensor(), seed=4)
    recording.gyr[200:330] = nan
    stream = poise.Stream(poise.AdaptiveGain())
    control = AttitudeControl.design(INERTIA, 0.5, integral=0.1, torque_limit=(0.1, 0.1, 0.1), rate_limit=1.0)
    controller = holding(control, Slew(1.0, 3.0))
    answers = [controller.update(stream.update(poise.Packet(*each)))[0] for each in zip(
        recording.time.tolist(), recording.gyr, recording.acc, recording.mag, strict=True
    )]  # fmt: skip
    return np.array(answers)


def test_compiled_and_plain_python_agree_and_blocks_change_nothing(tmp_path: Path) -> None:
    out = tmp_path / "plain.npy"
    environment = {
        **os.environ,
        "NUMBA_DISABLE_JIT": "1",
        "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), *sys.path]),
    }
    subprocess.run([sys.executable, "-c", _PLAIN, str(out)], check=True, env=environment, timeout=120)
    compiled = behind_an_estimator()
    np.testing.assert_allclose(np.load(out), compiled, atol=1e-9)
    assert np.abs(compiled).max() == pytest.approx(0.1) and not compiled[250:320].any()


def test_one_call_or_many_give_the_same_bits() -> None:
    quats = arrays.continuous(random_quats(50, 1))
    attitude = Attitude.of(np.arange(50) * DT, quats)
    attitude.rate[:] = 0.1
    whole = holding(PD, Slew(1.0, 2.0)).update(attitude)
    parts = holding(PD, Slew(1.0, 2.0))
    split = np.concatenate([parts.update(attitude[i : i + 1]) for i in range(50)])
    assert whole.tobytes() == split.tobytes()


def test_targets_row_by_row_and_the_last_one_holds() -> None:
    controller = Controller(PD)
    targets = [Target(Quat(*each.tolist())) for each in random_quats(3, 2)]
    controller.follow(*targets)
    attitude = Attitude.of(np.arange(5) * DT, random_quats(5, 3))
    attitude.rate[:] = 0.0
    torques = controller.update(attitude)
    for i in range(5):
        alone = one_torque(checked(PD), attitude[i : i + 1], targets[min(i, 2)])
        np.testing.assert_allclose(torques[i], alone, atol=1e-9)
    assert len(controller.update(attitude[:0])) == 0


def standing(i: int, lean: float = 0.0, quat: object = None) -> Attitude:
    """The *i*-th row, at 200 Hz, of a robot that leans forward and does not turn."""
    known = [np.cos(lean / 2), -np.sin(lean / 2), 0.0, 0.0]
    row = Attitude.of([0.005 * i], [known if quat is None else quat])
    row.rate[:] = 0.0
    return row


@pytest.mark.parametrize("first", ["wheels", "attitude"])
def test_wheels_are_driven_by_numbers_though_the_first_row_had_none(first: str) -> None:
    balancer = Balancer(BalanceControl.design(1.5, 0.12, 0.05))
    nan = [np.nan] * 4
    row, wheels = (standing(0), nan[:2]) if first == "wheels" else (standing(0, quat=nan), [0.0, 0.0])
    assert balancer.update(row, wheels) == (0.0, 0.0)
    torques = [balancer.update(standing(i, 0.05), (0.0, 0.0)) for i in (1, 2)]
    assert min(min(pair) for pair in torques) > 0.0


def test_a_way_rolled_while_nothing_was_known_is_no_speed() -> None:
    balancer = Balancer(BalanceControl.design(1.5, 0.12, 0.05))
    for i in range(3):
        balancer.update(standing(i), (0.0, 0.0))
    balancer.update(standing(3, quat=[np.nan] * 4), (5.0, 5.0))
    assert balancer.update(standing(4), (5.0, 5.0)) == (0.0, 0.0)
    assert balancer.state is not None and balancer.state.speed == 0.0


def test_the_wheels_do_not_mind_the_frame_of_the_attitude() -> None:
    told = [Balancer(BalanceControl.design(1.5, 0.12, 0.05)) for _ in range(2)]
    row = standing(0, 0.05)
    enu, ned = told[0].update(row, (0.0, 0.0)), told[1].update(row.to("ned"), (0.0, 0.0))
    assert min(enu) > 0.0
    np.testing.assert_allclose(ned, enu)
