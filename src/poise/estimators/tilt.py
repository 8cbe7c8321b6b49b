"""Tilt: angle and gyroscope bias of each tilt axis, for the tip-over detection of a robot.

Source: CN 108225271 A, tip-over detection of a robot; its modules *angle acquisition* and *angle computation* (parameters,
angle prediction, covariance, gain, best angle, covariance update). Steps are numbered as in ``docs/methods/tilt.md``,
which derives them.

Departures from the print:

- The abstract's "estimated angle" is the claims' "control quantity" U; "angular acceleration" in [0019] is the angular
  rate; [0075] integrates an acceleration into an angle, a misprint.
- ``kinematics="euler"``: U are the rates of the Euler angles, and the angles fold past ±90° of pitch. The print
  (``"small-angle"``) takes the body's rates, right only near level.
- ``q_scaling="continuous"``: Q grows with the time between samples. The print adds it per step (``"print"``).
- The innovation is wrapped to ±180°.
- The value of R, "the noise of the angle measured by the accelerometer", is cut off: here a noise density
  (``r="fixed"``), or the variance of that angle at rest (``r="rest"``), as the text says of "the noise".
- ``gain="fixed"`` is the text's other form: its preset ratio is per second here, so that it means the same at every rate.
- The bias has a body frame here, for ``Output``: the smallest body rate that makes the two states' rates.
"""

from __future__ import annotations

from math import pi, radians, sqrt
from typing import Annotated, Literal, NamedTuple, Self

from poise.data.flags import HEADING_ARBITRARY
from poise.data.packet import Output, Sample
from poise.math.compiled import compiled
from poise.math.euler import Slope, folds, rate_map, slope_at, without_heading
from poise.math.quaternions import Angles, Quat, pitch_of, roll_of, wrapped
from poise.math.vectors import Vec3, dot, norm, present, within

_MEAN_TIME = 0.5  # s, time constant of the mean that stillness is judged against
_FIRST = 0.5  # s of rest before its variance is believed


class Axis(NamedTuple):
    """X and P of one tilt axis."""

    angle: float  # rad
    bias: float  # rad/s, of the angle's rate
    aa: float  # P: variance of the angle
    ab: float
    bb: float  # variance of the bias


class Axes(NamedTuple):
    pitch: Axis
    roll: Axis


class State(NamedTuple):
    attitude: Quat  # of the two angles, with heading 0
    bias: Vec3  # body frame: what was given at the start, and the two biases
    given: Vec3  # what was given at the start
    pitch: Axis
    roll: Axis
    slope: Slope  # of the two angles
    mean_acc: Vec3  # what stillness is judged against, for r="rest"
    rested: float  # s of rest that the variances are made of
    mean: Angles  # of the measured angles in the present rest
    in_rest: float  # s
    pitch_variance: float  # of the measured angles at rest
    roll_variance: float


class Tilt(NamedTuple):
    """Two small Kalman filters, one per tilt axis, for an angle from the vertical and the gyroscope's bias."""

    q_angle: Annotated[float, "rad²/s", "Q of the angle: the print's 0.001 deg², per second or (print) per step"] = (
        0.001 * radians(1.0) ** 2
    )
    q_bias: Annotated[float, "(rad/s)²/s", "Q of the bias: the print's 0.0005, per second or (print) per step"] = (
        0.0005 * radians(1.0) ** 2
    )
    q_scaling: Annotated[Literal["continuous", "print"], "choice", "Q per second, or per step as printed"] = (
        "continuous"
    )
    r: Annotated[Literal["fixed", "rest"], "choice", "R from angle_noise, or the variance of the angle at rest"] = (
        "fixed"
    )
    angle_noise: Annotated[
        float, "rad/√Hz", "noise of the accelerometer's angle, with what motion adds", (1e-9, 1e3)
    ] = 0.005
    least_noise: Annotated[float, "rad", "smallest standard deviation at rest that is believed", (1e-9, 1.0)] = 1e-4
    rest_acc: Annotated[float, "m/s²", "largest distance of a still specific force from its mean, per axis"] = 0.5
    rest_gyr: Annotated[float, "rad/s", "largest rate at rest"] = 0.05
    gain: Annotated[
        Literal["kalman", "fixed"], "choice", "gain from P, or the text's preset ratio, which learns no bias"
    ] = "kalman"
    ratio: Annotated[float, "1/s", "preset ratio of the error angle that is added, with gain='fixed'"] = 0.5
    initial_angle: Annotated[float, "rad", "how far the first angle may be off (P0)", (1e-9, 10.0)] = radians(10.0)
    initial_bias: Annotated[float, "rad/s", "how large the gyroscope's bias may be (P0)", (1e-9, 10.0)] = radians(2.0)
    kinematics: Annotated[
        Literal["euler", "small-angle"], "choice", "U: rates of the Euler angles, or the body's rates as printed"
    ] = "euler"

    @property
    def learns_bias(self) -> bool:
        """With the Kalman gain, in motion too: RestBias would take from it what it is to find."""
        return self.gain == "kalman"

    @property
    def no_heading(self) -> bool:
        """Two tilt angles are all it keeps: its heading is 0 whatever turns."""
        return True

    @classmethod
    def as_printed(cls) -> Self:
        """The print's choices: body rates, Q per step."""
        return cls(kinematics="small-angle", q_scaling="print")

    def start(self, sample: Sample, bias: Vec3) -> State:
        """X0 from the first acc, P0 wide."""
        tilt = Angles(pitch_of(sample.acc), roll_of(sample.acc), 0.0)
        slope = slope_at(tilt.pitch, tilt.roll)
        aa, bb = self.initial_angle**2, self.initial_bias**2
        pitch, roll = Axis(tilt.pitch, 0.0, aa, 0.0, bb), Axis(tilt.roll, 0.0, aa, 0.0, bb)
        return State(without_heading(slope), bias, bias, pitch, roll, slope, sample.acc, 0.0, tilt, 0.0, 0.0, 0.0)

    def step(self, state: State, sample: Sample) -> State:
        w, T, f = sample.gyr - state.given, sample.dt, sample.acc
        pitch, roll = state.pitch, state.roll
        mean_acc, rested, mean, in_rest = state.mean_acc, state.rested, state.mean, state.in_rest
        pitch_variance, roll_variance = state.pitch_variance, state.roll_variance

        # 1. Control quantity U: the rates of the two angles
        u_pitch, u_roll = w.x, w.y
        if self.kinematics == "euler":
            J = rate_map(state.slope)
            u_pitch, u_roll = dot(J.x, w), dot(J.y, w)

        # 2. Predict: X⁻ = A X + B U, P⁻ = A P Aᵀ + Q
        scale = T if self.q_scaling == "continuous" else 1.0
        q_angle, q_bias = scale * self.q_angle, scale * self.q_bias
        pitch = predicted(pitch, u_pitch, T, q_angle, q_bias)
        roll = predicted(roll, u_roll, T, q_angle, q_bias)

        pitch, roll = within_range(self, pitch, roll)

        if present(f):
            # 3. Z and its R
            Z = Angles(pitch_of(f), roll_of(f), 0.0)
            r_pitch = r_roll = self.angle_noise**2 / sample.acc_dt
            if self.r == "rest":
                smooth = T / (_MEAN_TIME + T)
                mean_acc = mean_acc + smooth * (f - mean_acc)
                if within(f - mean_acc, self.rest_acc) and norm(w) < self.rest_gyr:
                    rested, in_rest = rested + T, in_rest + T
                    off_pitch, off_roll = wrapped(Z.pitch - mean.pitch), wrapped(Z.roll - mean.roll)
                    share = T / in_rest
                    mean = Angles(mean.pitch + share * off_pitch, mean.roll + share * off_roll, 0.0)
                    kept, share = 1.0 - share, T / rested
                    pitch_variance += share * (kept * off_pitch**2 - pitch_variance)
                    roll_variance += share * (kept * off_roll**2 - roll_variance)
                else:
                    in_rest = 0.0
                if rested > _FIRST:
                    r_pitch = max(pitch_variance, self.least_noise**2)
                    r_roll = max(roll_variance, self.least_noise**2)

            # 4. Gain, best angle, covariance update
            ratio = min(self.ratio * sample.acc_dt, 1.0) if self.gain == "fixed" else -1.0
            pitch = corrected(pitch, wrapped(Z.pitch - pitch.angle), r_pitch, ratio)
            roll = corrected(roll, wrapped(Z.roll - roll.angle), r_roll, ratio)

        # 5. Fold past ±90° of pitch again
        pitch, roll = within_range(self, pitch, roll)
        slope = slope_at(pitch.angle, roll.angle)
        bias = state.given + body_bias(self, slope, pitch.bias, roll.bias)
        return State(
            without_heading(slope), bias, state.given, pitch, roll, slope, mean_acc,
            rested, mean, in_rest, pitch_variance, roll_variance,
        )  # fmt: skip

    def output(self, state: State, sample: Sample) -> Output:
        """The best angles as an attitude with heading 0; sigma from P, the heading's is unknown."""
        pitch, roll = sqrt(state.pitch.aa), abs(state.slope.cp) * sqrt(state.roll.aa)
        # ψ = 0: θ turns about Earth x, γ about (0, cos θ, sin θ)
        sigma = Vec3(min(pitch, pi), min(roll, pi), pi)
        return Output(
            sample.dt, state.attitude, sample.gyr - state.bias, state.bias, sigma,
            bias_sigma(self, state), HEADING_ARBITRARY,
        )  # fmt: skip


@compiled
def predicted(x: Axis, u: float, T: float, q_angle: float, q_bias: float) -> Axis:
    """X⁻ = A X + B u, P⁻ = A P Aᵀ + Q with A = [[1, −T], [0, 1]], B = [T, 0]."""
    ab = x.ab - T * x.bb
    return Axis(x.angle + T * (u - x.bias), x.bias, x.aa - T * (x.ab + ab) + q_angle, ab, x.bb + q_bias)


@compiled
def within_range(method: Tilt, pitch: Axis, roll: Axis) -> Axes:
    """The same angles wrapped and, past ±90° of pitch, folded: θ → 180° − θ changes the sign of its rate, so of its bias."""
    if method.kinematics == "euler" and folds(pitch.angle):
        pitch = Axis(pi - pitch.angle, -pitch.bias, pitch.aa, pitch.ab, pitch.bb)
        roll = Axis(roll.angle + pi, roll.bias, roll.aa, roll.ab, roll.bb)
    return Axes(
        Axis(wrapped(pitch.angle), pitch.bias, pitch.aa, pitch.ab, pitch.bb),
        Axis(wrapped(roll.angle), roll.bias, roll.aa, roll.ab, roll.bb),
    )


@compiled
def corrected(x: Axis, error: float, r: float, ratio: float) -> Axis:
    """K = P⁻Hᵀ/(H P⁻ Hᵀ + R), X = X⁻ + K · error, P = (I − K H) P⁻ with H = [1, 0]; a *ratio* from 0 on is K itself."""
    if ratio >= 0.0:  # not the optimal gain, so P takes the form that holds for any
        kept = 1.0 - ratio
        return Axis(x.angle + ratio * error, x.bias, kept * kept * x.aa + ratio * ratio * r, kept * x.ab, x.bb)
    s = 1.0 / (x.aa + r)
    k_angle, k_bias = x.aa * s, x.ab * s
    kept = r * s  # 1 − k_angle, without cancellation
    return Axis(x.angle + k_angle * error, x.bias + k_bias * error, kept * x.aa, kept * x.ab, x.bb - k_bias * x.ab)


@compiled
def body_bias(method: Tilt, at: Slope, pitch: float, roll: float) -> Vec3:
    """The smallest body rate whose angles' rates are *pitch* and *roll*: rows of J are at right angles."""
    if method.kinematics == "small-angle":
        return Vec3(pitch, roll, 0.0)
    level = at.cp * roll  # γ's row of J is 1/cos θ long
    return Vec3(at.cr * pitch + at.sp * at.sr * level, at.cp * level, at.sr * pitch - at.sp * at.cr * level)


@compiled
def bias_sigma(method: Tilt, state: State) -> Vec3:
    """Per body axis, rad/s, from P; about the direction that turns neither angle, what was known at the start."""
    pitch, roll, unknown = state.pitch.bb, state.roll.bb, method.initial_bias**2
    if method.kinematics == "small-angle":
        return Vec3(sqrt(pitch), sqrt(roll), method.initial_bias)
    # Unit vectors: the row of θ', that of γ' (which is 1/cos θ long) and up in the body are three axes
    sp, cp, sr, cr = state.slope
    level = cp * cp * roll
    return Vec3(
        sqrt(cr * cr * pitch + (sp * sr) ** 2 * level + (cp * sr) ** 2 * unknown),
        sqrt(cp * cp * level + sp * sp * unknown),
        sqrt(sr * sr * pitch + (sp * cr) ** 2 * level + (cp * cr) ** 2 * unknown),
    )
