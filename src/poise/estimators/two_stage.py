"""TwoStage: the two-stage Kalman filter for attitude control.

Source: Goertek, "Attitude control method and device based on Kalman filtering", technical number 16427160. The
description is cut there; the claims are whole. Steps are numbered as in ``docs/methods/two-stage.md``, which derives them.

Departures from the print:

- Claim 3 and the summary let both stages start from x(k−1); here stage 1 starts from the prediction x⁻, stage 2 from
  the temporary optimum x'.
- The iteration state values z1, z2 also take the data-sheet error coefficients in the print; they enter through r_a and
  σ_m here.
- Stage 2 once names the accelerometer's observation matrix where the magnetometer's is meant.
- ``transition="exact"``: A = exp(T/2 Ω(w)) where the print has its first two terms, I + T/2 Ω(w), which lose (|w|T)²/12
  of the rate: 2.5 deg/s at 1000 deg/s and 100 Hz. ``"first-order"`` is the print.
- ``stage1_heading="predicted"``: H1 and z1 are taken at the accelerometer's tilt with the heading of x⁻, reached by the
  smallest turn from x⁻, so that no pitch is singular. ``"measured"`` is the print.
- ``decouple``: each stage corrects only what its sensor knows (after Sabatelli et al. 2013, doi
  10.1109/TIM.2012.2218692); the covariance then takes the Joseph form. The print has neither.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import Annotated, Literal, NamedTuple, Self

from poise.data.flags import ACC_DOUBTED
from poise.data.packet import Output, Sample
from poise.math.compiled import compiled
from poise.math.matrices import I3, I4, Mat3, Mat4, Mat34, Mat43, diagonal, inverse, outer, transpose
from poise.math.quaternions import Quat, attitude_of, exp, inner, normalize, rotate, shortest_turn, up_in_body
from poise.math.vectors import ABSENT, UP, Vec3, norm, present, unit

_START_TIME = 0.01  # s that a first sample's noise is taken as averaged over, at least: P0 from the sensors' densities


class State(NamedTuple):
    attitude: Quat  # x
    bias: Vec3  # always zero: the method has none of its own
    covariance: Mat4  # P
    doubt: float  # κ ||f| − g| / g of the last accelerometer sample


class TwoStage(NamedTuple):
    """Two-stage Kalman filter: the accelerometer corrects the tilt, then the magnetometer the heading."""

    gyr_noise: Annotated[
        float, "rad/s/√Hz", "gyroscope noise σ_g, with what scale and misalignment add", (1e-9, 1e3)
    ] = 0.01
    acc_noise: Annotated[float, "m/s²/√Hz", "accelerometer noise σ_a, with the acceleration of motion", (1e-9, 1e6)] = (
        1.2
    )
    mag_noise: Annotated[float, "1/√Hz", "noise σ_m of the magnetometer's unit vector", (1e-9, 1e6)] = 0.65
    motion_factor: Annotated[float, "1", "κ: how the accelerometer's error grows with ||f| − g|/g"] = 0.05
    gravity: Annotated[float, "m/s²", "length of gravity g", (0.1, 100.0)] = 9.80665
    declination: Annotated[float, "rad", "true heading = magnetic heading + D, east positive", (-3.2, 3.2)] = 0.0
    transition: Annotated[
        Literal["exact", "first-order"], "choice", "A for a rate that is constant over the step, or its first two terms"
    ] = "exact"
    stage1_heading: Annotated[
        Literal["predicted", "measured"], "choice", "whose heading the accelerometer's stage is linearised at"
    ] = "predicted"
    decouple: Annotated[bool, "yes/no", "stage 1 cannot turn the heading, stage 2 cannot tilt the horizon"] = True

    @classmethod
    def as_printed(cls) -> Self:
        """The print's choices: A to first order, stage 1 at the measured heading, no decoupling."""
        return cls(transition="first-order", stage1_heading="measured", decouple=False)

    def start(self, sample: Sample, bias: Vec3) -> State:
        """1. Angles from the first acc and mag → x0; P0 from the sensors' noise."""
        x = attitude_of(sample.acc, sample.mag, self.declination)
        tilt, heading = (self.acc_noise / self.gravity) ** 2, self.mag_noise**2
        L, per_time = turns_about_earth(x), 0.25 / max(_START_TIME, sample.acc_dt)
        return State(x, bias, per_time * (L @ diagonal(tilt, tilt, heading) @ transpose(L)), 0.0)

    def step(self, state: State, sample: Sample) -> State:
        x, P, T, doubt = state.attitude, state.covariance, sample.dt, state.doubt

        # 2. Predict
        A = transition_matrix(sample.gyr - state.bias, T, self.transition == "exact")
        Q = (0.25 * T * self.gyr_noise**2) * (I4 - outer(x, x))  # (T/2)² Ξ Ξᵀ σ_g²/T; Ξ Ξᵀ = I − x xᵀ
        x = A @ x
        P = A @ P @ transpose(A) + Q

        # 3. Observation: the quaternion of acc and mag, on the side of x⁻; without acc now, the predicted tilt
        f = sample.acc if present(sample.acc) else up_in_body(x)
        q_am = attitude_of(f, sample.mag, self.declination)
        q_am = -q_am if inner(q_am, x) < 0.0 else q_am

        # 4. Stage 1: the actual error coefficient r_a grows with the distance of |f| from g
        if present(sample.acc):
            doubt = self.motion_factor * abs(norm(f) - self.gravity) / self.gravity
            r_a = (self.acc_noise / self.gravity * (1.0 + doubt)) ** 2 / sample.acc_dt
            measured = self.stage1_heading == "measured" and present(sample.mag)
            q_1 = q_am if measured else levelled(x, f)
            H1 = up_matrix(q_1)
            z1 = H1 @ q_1  # the first-stage iteration state value
            HP = H1 @ P
            S = HP @ transpose(H1) + r_a * I3
            K1 = transpose(HP) @ inverse(S)
            if self.decouple:
                t = heading_turn(x)
                K1 = (I4 - outer(t, t)) @ K1
            x = x + K1 @ (z1 - H1 @ x)  # x', the temporary optimum
            P = updated(P, K1, HP, S, self.decouple)  # P1

        # 5. Stage 2: the magnetometer, from x' and P1
        if present(sample.mag):
            r_m = self.mag_noise**2 / sample.mag_dt
            H2 = north_matrix(q_am)
            z2 = H2 @ q_am  # the second-stage iteration state value
            HP = H2 @ P
            S = HP @ transpose(H2) + r_m * I3
            K2 = transpose(HP) @ inverse(S)
            if self.decouple:
                t = heading_turn(x)
                K2 = outer(t, t) @ K2
            x = x + K2 @ (z2 - H2 @ x)
            P = updated(P, K2, HP, S, self.decouple)
        return State(normalize(x), state.bias, P, doubt)

    def output(self, state: State, sample: Sample) -> Output:
        """6. The attitude that steers the device; sigma about the Earth's axes from P."""
        L = turns_about_earth(state.attitude)
        C = transpose(L) @ state.covariance @ L
        sigma = Vec3(_sigma(C.x.x), _sigma(C.y.y), _sigma(C.z.z))
        flags = ACC_DOUBTED if state.doubt > 1.0 else 0
        return Output(sample.dt, state.attitude, sample.gyr - state.bias, state.bias, sigma, ABSENT, flags)


@compiled
def _sigma(variance: float) -> float:
    """rad; an angle of which nothing is known is not further off than half a turn."""
    return min(2.0 * sqrt(max(variance, 0.0)), pi)


@compiled
def rate_matrix(w: Vec3) -> Mat4:
    """Ω(w): q' = ½ Ω(w) q."""
    return Mat4(
        Quat(0.0, -w.x, -w.y, -w.z), Quat(w.x, 0.0, w.z, -w.y), Quat(w.y, -w.z, 0.0, w.x), Quat(w.z, w.y, -w.x, 0.0)
    )


@compiled
def transition_matrix(w: Vec3, T: float, exact: bool) -> Mat4:
    """A: x⁻ = A x turns the body by T w; exp(T/2 Ω(w)), or I + T/2 Ω(w)."""
    half = exp(T * w) if exact else Quat(1.0, 0.5 * T * w.x, 0.5 * T * w.y, 0.5 * T * w.z)
    return half.w * I4 + rate_matrix(Vec3(half.x, half.y, half.z))


@compiled
def up_matrix(q: Quat) -> Mat34:
    """H1 = ∂(up in the body frame)/∂q; H1(q) q is twice that direction."""
    return 2.0 * Mat34(Quat(-q.y, q.z, -q.w, q.x), Quat(q.x, q.w, q.z, q.y), Quat(q.w, -q.x, -q.y, q.z))


@compiled
def north_matrix(q: Quat) -> Mat34:
    """H2 = ∂(north in the body frame)/∂q; H2(q) q is twice that direction."""
    return 2.0 * Mat34(Quat(q.z, q.y, q.x, q.w), Quat(q.w, -q.x, q.y, -q.z), Quat(-q.x, -q.w, q.z, q.y))


@compiled
def turns_about_earth(q: Quat) -> Mat43:
    """Columns e_x ⊗ q, e_y ⊗ q, e_z ⊗ q: how q changes when the body turns about the Earth's axes (twice that)."""
    return Mat43(Vec3(-q.x, -q.y, -q.z), Vec3(q.w, q.z, -q.y), Vec3(-q.z, q.w, q.x), Vec3(q.y, -q.x, q.w))


@compiled
def heading_turn(x: Quat) -> Quat:
    """t = (e_z ⊗ x)/|x|: the direction in which x changes when only the heading does."""
    return normalize(Quat(-x.z, -x.y, x.x, x.w))


@compiled
def levelled(x: Quat, acc: Vec3) -> Quat:
    """The accelerometer's tilt with the heading of x: x turned about a horizontal axis until acc points up."""
    x = normalize(x)
    return shortest_turn(unit(rotate(x, acc)), UP) * x


@compiled
def updated(P: Mat4, K: Mat43, HP: Mat34, S: Mat3, joseph: bool) -> Mat4:
    """(I − K H) P, or (I − K H) P (I − K H)ᵀ + K R Kᵀ multiplied out (Joseph), which holds for a projected gain too."""
    KHP: Mat4 = K @ HP
    if joseph:
        PHK: Mat4 = transpose(KHP)
        KSK: Mat4 = K @ S @ transpose(K)
        return P - KHP - PHK + KSK
    return P - KHP
