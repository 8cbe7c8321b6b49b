"""The two-stage filter with its two updates done as one: what the two stages are compared with."""

from __future__ import annotations

from typing import NamedTuple

from poise.data.packet import Output, Sample
from poise.estimators.protocol import output, start
from poise.estimators.two_stage import State, TwoStage, levelled, north_matrix, transition_matrix, up_matrix
from poise.math.compiled import compiled
from poise.math.matrices import I3, I4, Mat34, Mat43, inverse, outer, transpose
from poise.math.quaternions import attitude_of, inner, normalize, up_in_body
from poise.math.vectors import Vec3, norm, present

_SILENCE = 1e12  # variance of a sensor that has no sample now


class Stacked(NamedTuple):
    """A TwoStage filter, not decoupled, whose six rows of accelerometer and magnetometer correct in one update."""

    filter: TwoStage = TwoStage(decouple=False)

    @property
    def declination(self) -> float:
        """rad; it tells streams that the heading comes from the magnetometer."""
        return self.filter.declination

    def start(self, sample: Sample, bias: Vec3) -> State:
        return start(self.filter, sample, bias)  # type: ignore[no-any-return]

    def step(self, state: State, sample: Sample) -> State:
        f, x, P, T = self.filter, state.attitude, state.covariance, sample.dt
        doubt, r_a, r_m = state.doubt, _SILENCE, _SILENCE

        # Predict, as TwoStage does
        A = transition_matrix(sample.gyr - state.bias, T, f.transition == "exact")
        Q = (0.25 * T * f.gyr_noise**2) * (I4 - outer(x, x))
        x = A @ x
        P = A @ P @ transpose(A) + Q

        # Observation
        acc = sample.acc if present(sample.acc) else up_in_body(x)
        q_am = attitude_of(acc, sample.mag, f.declination)
        q_am = -q_am if inner(q_am, x) < 0.0 else q_am
        if present(sample.acc):
            doubt = f.motion_factor * abs(norm(acc) - f.gravity) / f.gravity
            r_a = (f.acc_noise / f.gravity * (1.0 + doubt)) ** 2 / sample.acc_dt
        if present(sample.mag):
            r_m = f.mag_noise**2 / sample.mag_dt
        q_1 = q_am if f.stage1_heading == "measured" and present(sample.mag) else levelled(x, acc)
        H1, H2 = up_matrix(q_1), north_matrix(q_am)

        # One update with H (6 × 4), S (6 × 6) and K (4 × 6)
        e1, e2 = H1 @ (q_1 - x), H2 @ (q_am - x)
        HP1, HP2 = H1 @ P, H2 @ P
        K1, K2 = gains(H1, H2, HP1, HP2, r_a, r_m)
        x = x + K1 @ e1 + K2 @ e2
        P = P - K1 @ HP1 - K2 @ HP2
        return State(normalize(x), state.bias, P, doubt)

    def output(self, state: State, sample: Sample) -> Output:
        return output(self.filter, state, sample)  # type: ignore[no-any-return]


@compiled
def gains(H1: Mat34, H2: Mat34, HP1: Mat34, HP2: Mat34, r_a: float, r_m: float) -> tuple[Mat43, Mat43]:
    """P Hᵀ S⁻¹ by halves of three columns, from S (6 × 6) eliminated in 3 × 3 blocks.

    The fastest way found: a Cholesky solve number by number, in arrays, made the whole step a fifth slower.
    """
    S11 = HP1 @ transpose(H1) + r_a * I3
    S12 = HP1 @ transpose(H2)
    S22 = HP2 @ transpose(H2) + r_m * I3
    inverse11 = inverse(S11)
    G = transpose(S12) @ inverse11
    PH1 = transpose(HP1)
    K2 = minus(transpose(HP2), PH1 @ transpose(G)) @ inverse(S22 - G @ S12)
    return minus(PH1 @ inverse11, K2 @ G), K2


@compiled
def minus(A: Mat43, B: Mat43) -> Mat43:
    return Mat43(A.w - B.w, A.x - B.x, A.y - B.y, A.z - B.z)
