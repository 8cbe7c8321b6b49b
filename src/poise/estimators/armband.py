"""Armband: the complementary Kalman filter of a forearm band, on Euler angles.

Source: CN 110207647 A, arm-ring attitude by a complementary Kalman filter. Steps are numbered as in
``docs/methods/armband.md``, which derives them.

Departures from the print:

- The tilt formulas swap x and y, while heading formula and RFU axes need θ from f_y and γ from f_x; f/g becomes f/|f|.
- cos θ · m_x in the heading's numerator must be cos γ · m_x; arctan becomes atan2; one place prints arcsin.
- Z's third row prints X[1] for the heading state X[3]; X0 prints G_x three times, Q one δ three times, R one δ_CF three
  times; one Γ starts with 1 instead of T.
- The rate states are refreshed with each gyroscope sample and their rows of P zeroed: the print has Φ X only, which
  would never use the gyroscope again.
- φ − angle is wrapped to ±180°.
- ``kinematics``: the angles' increment comes from the turn of the attitude (``"exact"``) or from the rates of the Euler
  angles (``"euler"``), with Q mapped alike and the angles folded past ±90° of pitch. The print (``"small-angle"``) adds
  the body's rates to the angles and folds nothing.
- Of the two triples of angles that name the measured attitude, the one nearer to the prediction is compared with it.
"""

from __future__ import annotations

from math import cos, pi, radians, sin, sqrt
from typing import Annotated, Literal, NamedTuple, Self

from poise.data.flags import START_IN_MOTION
from poise.data.packet import Output, Sample
from poise.estimators.protocol import start
from poise.math.compiled import compiled
from poise.math.euler import folded, folds, off_by, rate_map, slope_at
from poise.math.matrices import Mat3, diagonal, inverse, transpose
from poise.math.quaternions import Angles, Quat, angles_from, angles_of, exp, from_angles, wrapped
from poise.math.vectors import ABSENT, ZERO, Vec3, present, unit, within

_SHORTEST = 0.1  # s: a start that is at rest for less was none
_UNKNOWN = 1e9  # rad², variance of an angle that was not measured


class State(NamedTuple):
    attitude: Quat  # of the three angles
    bias: Vec3  # always zero: the method has none of its own
    angles: Angles  # X: θ, γ, ψ
    rate: Vec3  # X: w
    covariance: Mat3  # P of the angles; the rows of the rates are zeroed at every refresh
    spread: Vec3  # running variance of Z − H X⁻, rad²
    starting: bool  # still in the first rest
    age: float  # s since the start
    rested: float  # s of rest that the start is a mean of
    counts: Vec3  # samples of gyr, acc, mag in it
    mean_acc: Vec3
    mean_gyr: Vec3
    mean_mag: Vec3  # of the field's direction


class Prediction(NamedTuple):
    angles: Angles  # of X⁻
    covariance: Mat3  # P⁻ of the angles
    shared: Mat3  # P⁻ of the angles with the rates


class Armband(NamedTuple):
    """Complementary Kalman filter: angles and rates, corrected by a weighted mean of gyroscope and acc/mag angles."""

    gyr_noise: Annotated[float, "rad/s/√Hz", "gyroscope noise σ_g of every axis", (1e-9, 1e3)] = 0.004
    pitch_noise: Annotated[float, "rad/√Hz", "noise σ_cf of the measured pitch", (1e-9, 1e6)] = 0.1
    roll_noise: Annotated[float, "rad/√Hz", "noise σ_cf of the measured roll", (1e-9, 1e6)] = 0.1
    heading_noise: Annotated[float, "rad/√Hz", "noise σ_cf of the measured heading", (1e-9, 1e6)] = 0.25
    r_mode: Annotated[
        Literal["fixed", "running"], "choice", "R from the noises above, or the running variance of Z − HX⁻ above them"
    ] = "running"
    running_time: Annotated[float, "s", "time constant of that variance", (1e-3, 1e6)] = 3.0
    error_time: Annotated[
        float, "s", "how long an error of φ lasts: that variance times it is R's density", (1e-3, 1e6)
    ] = 1.5
    alpha: Annotated[float, "1", "α: weight of the gyroscope's pitch in Z", (0.0, 1.0)] = 0.3
    beta: Annotated[float, "1", "β: weight of the gyroscope's roll in Z", (0.0, 1.0)] = 0.3
    zeta: Annotated[float, "1", "ζ: weight of the gyroscope's heading in Z", (0.0, 1.0)] = 0.3
    kinematics: Annotated[Literal["exact", "euler", "small-angle"], "choice", "how the rates change the angles"] = (
        "exact"
    )
    start_time: Annotated[float, "s", "longest rest that the start is averaged over: N samples"] = 1.0
    initial_tilt: Annotated[float, "rad", "how far pitch and roll of a rest may be off (P0)", (1e-9, 10.0)] = radians(
        2.0
    )
    initial_heading: Annotated[float, "rad", "how far the heading of a rest may be off (P0)", (1e-9, 10.0)] = radians(
        5.0
    )
    wide: Annotated[float, "rad", "how far angles of a start in motion may be off (P0)", (1e-9, 10.0)] = radians(40.0)
    rest_acc: Annotated[float, "m/s²", "largest distance of a still specific force from its mean, per axis"] = 0.5
    rest_gyr: Annotated[float, "rad/s", "largest rate at rest, per axis"] = 0.05
    rest_mag: Annotated[float, "1", "largest distance of a still field's direction from its mean, per axis"] = 0.1
    declination: Annotated[float, "rad", "true heading = magnetic heading + D, east positive", (-pi, pi)] = 0.0

    @classmethod
    def as_printed(cls) -> Self:
        """The print's choices: body rates added to the angles, a fixed R."""
        return cls(kinematics="small-angle", r_mode="fixed")

    def start(self, sample: Sample, bias: Vec3) -> State:
        """1. X0 of the first sample, P0 wide, until a rest says better."""
        angles = measured(self, sample.acc, sample.mag)
        mag = unit(sample.mag) if present(sample.mag) else ABSENT
        wide = self.wide**2
        return State(
            from_angles(angles), bias, angles, sample.gyr - bias, diagonal(wide, wide, wide), ZERO,
            True, 0.0, 0.0, Vec3(1.0, 1.0, 1.0 if present(sample.mag) else 0.0), sample.acc, sample.gyr, mag,
        )  # fmt: skip

    def restart(self, state: State, sample: Sample, bias: Vec3) -> State:
        """A sample that stands for a second or more is nearly as good as a rest; the running variance stays."""
        begun: State = start(self, sample, bias)
        if sample.acc_dt < self.start_time:
            return begun
        tilt, heading = (3.0 * self.initial_tilt) ** 2, (3.0 * self.initial_heading) ** 2
        return State(
            begun.attitude, bias, begun.angles, begun.rate, diagonal(tilt, tilt, heading), state.spread,
            False, 0.0, sample.acc_dt, ZERO, ZERO, ZERO, ZERO,
        )  # fmt: skip

    def step(self, state: State, sample: Sample) -> State:
        w, T, f, m = sample.gyr - state.bias, sample.dt, sample.acc, sample.mag
        age = state.age + T

        # 1. Start: the angles of the mean acc and mag, for as long as the band is held still
        if state.starting and age < self.start_time and at_rest(self, state, sample):
            return resting(self, state, sample)

        # 2. Noise, 3. Predict: X⁻ = Φ X with the rates of this sample, P⁻ = Φ P Φᵀ + Γ Q Γᵀ
        X, P, shared = predicted(self, state.angles, state.covariance, w, T)
        spread = state.spread

        if present(f):
            # 4. Measurement: Z − H X⁻ = (1 − α)(φ − X⁻)
            off = off_by(measured(self, f, m), X, present(m))
            innovation = Vec3(
                (1.0 - self.alpha) * off.pitch, (1.0 - self.beta) * off.roll, (1.0 - self.zeta) * off.heading
            )
            spread = spread_with(self, spread, innovation, sample)
            R = measurement_noise(self, spread, sample)

            # 5. Update: K = P⁻ Hᵀ (H P⁻ Hᵀ + R)⁻¹, X = X⁻ + K (Z − H X⁻), P = (I − K H) P⁻
            S = inverse(P + diagonal(R.x, R.y, R.z))
            pull: Vec3 = S @ innovation
            change: Vec3 = P @ pull
            turn: Vec3 = transpose(shared) @ pull
            w = w + turn
            P = P - P @ S @ P
            X = Angles(wrapped(X.pitch + change.x), wrapped(X.roll + change.y), wrapped(X.heading + change.z))
            if self.kinematics != "small-angle" and folds(X.pitch):
                X, P = folded(X), pitch_turned(P)
        return State(from_angles(X), state.bias, X, w, P, spread, False, age, state.rested, ZERO, ZERO, ZERO, ZERO)

    def output(self, state: State, sample: Sample) -> Output:
        """6. The angles' attitude and the rate state; sigma about the Earth's axes from P."""
        sp, cp = sin(state.angles.pitch), cos(state.angles.pitch)
        sh, ch = sin(state.angles.heading), cos(state.angles.heading)
        # Columns: the axes about which θ, γ and ψ turn, in the Earth frame
        L = Mat3(Vec3(ch, -sh * cp, 0.0), Vec3(sh, ch * cp, 0.0), Vec3(0.0, sp, 1.0))
        C: Mat3 = L @ state.covariance @ transpose(L)
        sigma = Vec3(_sigma(C.x.x), _sigma(C.y.y), _sigma(C.z.z))
        in_motion = state.rested < _SHORTEST and state.age < self.start_time and not state.starting
        flags = START_IN_MOTION if in_motion else 0
        return Output(sample.dt, state.attitude, state.rate, state.bias, sigma, ABSENT, flags)


@compiled
def _sigma(variance: float) -> float:
    """rad; an angle of which nothing is known is not further off than half a turn."""
    return min(sqrt(max(variance, 0.0)), pi)


@compiled
def predicted(method: Armband, X: Angles, P: Mat3, w: Vec3, T: float) -> Prediction:
    """X⁻ = Φ X and P⁻ = Φ P Φᵀ + Γ Q Γᵀ with Φ = [[I, T J], [0, I]], Γ = [T J; I], Q = σ_g²/T; J = I in the print.

    The rates are this sample's and their rows of P zero, so that P⁻ is P + T² J Q Jᵀ of the angles, T J Q with the rates.
    """
    q = method.gyr_noise**2 / T
    if method.kinematics == "small-angle":
        P = P + diagonal(T * T * q, T * T * q, T * T * q)
        X = Angles(wrapped(X.pitch + T * w.x), wrapped(X.roll + T * w.y), wrapped(X.heading + T * w.z))
        return Prediction(X, P, diagonal(T * q, T * q, T * q))
    J = rate_map(slope_at(X.pitch, X.roll))
    P = P + (T * T * q) * (J @ transpose(J))
    shared = (T * q) * J
    if method.kinematics == "exact":
        after = angles_from(from_angles(X) * exp(T * w))
        over = cos(after.roll - X.roll) < 0.0  # the turn went past ±90°
    else:
        rates: Vec3 = J @ w
        after = Angles(X.pitch + T * rates.x, wrapped(X.roll + T * rates.y), wrapped(X.heading + T * rates.z))
        over = folds(after.pitch)
        after = folded(after) if over else after
    return Prediction(after, pitch_turned(P), turned(shared)) if over else Prediction(after, P, shared)


@compiled
def spread_with(method: Armband, spread: Vec3, innovation: Vec3, sample: Sample) -> Vec3:
    """The running variance of Z − H X⁻ with one more of it; the heading's waits for the magnetometer."""
    share = sample.acc_dt / (method.running_time + sample.acc_dt)
    of_heading = sample.mag_dt / (method.running_time + sample.mag_dt) if present(sample.mag) else 0.0
    return Vec3(
        spread.x + share * (innovation.x**2 - spread.x),
        spread.y + share * (innovation.y**2 - spread.y),
        spread.z + of_heading * (innovation.z**2 - spread.z),
    )


@compiled
def measurement_noise(method: Armband, spread: Vec3, sample: Sample) -> Vec3:
    """R, rad²: the given noise or, "running", what the running variance says where that is more."""
    pitch, roll, heading = method.pitch_noise**2, method.roll_noise**2, method.heading_noise**2
    if method.r_mode == "running":
        pitch = max(pitch, method.error_time * spread.x)
        roll = max(roll, method.error_time * spread.y)
        heading = max(heading, method.error_time * spread.z)
    unmeasured = not present(sample.mag)
    return Vec3(pitch / sample.acc_dt, roll / sample.acc_dt, _UNKNOWN if unmeasured else heading / sample.mag_dt)


@compiled
def measured(method: Armband, acc: Vec3, mag: Vec3) -> Angles:
    """φ: the angles of acc and mag; heading 0 where mag says nothing."""
    angles = angles_of(acc, mag)
    if present(mag):
        return Angles(angles.pitch, angles.roll, wrapped(angles.heading - method.declination))
    return angles


@compiled
def at_rest(method: Armband, state: State, sample: Sample) -> bool:
    """Whether the sample is still like the mean of those since the start; a sensor without a sample does not object."""
    w, f, m = sample.gyr, sample.acc, sample.mag
    if not within(w - state.mean_gyr, method.rest_gyr) or not within(w - state.bias, method.rest_gyr):
        return False
    if present(f) and not within(f - state.mean_acc, method.rest_acc):
        return False
    return not (present(m) and present(state.mean_mag)) or within(unit(m) - state.mean_mag, method.rest_mag)


@compiled
def resting(method: Armband, state: State, sample: Sample) -> State:
    """The state after one more sample of the first rest: X0 from the means, P0 of a rest once it is one."""
    rested = state.rested + sample.dt
    n_gyr, n_acc, n_mag = state.counts
    n_gyr += 1.0
    gyr = state.mean_gyr + (sample.gyr - state.mean_gyr) / n_gyr
    acc, mag = state.mean_acc, state.mean_mag
    if present(sample.acc):
        n_acc += 1.0
        acc = acc + (sample.acc - acc) / n_acc
    if present(sample.mag):
        n_mag += 1.0
        mag = mag + (unit(sample.mag) - mag) / n_mag if present(mag) else unit(sample.mag)
    angles = measured(method, acc, mag)
    P = state.covariance
    if rested >= _SHORTEST:
        tilt, heading = method.initial_tilt**2, method.initial_heading**2
        P = diagonal(tilt, tilt, heading)
    return State(
        from_angles(angles),
        state.bias,
        angles,
        gyr - state.bias,
        P,
        ZERO,
        True,
        rested,
        rested,
        Vec3(n_gyr, n_acc, n_mag),
        acc,
        gyr,
        mag,
    )


@compiled
def turned(rows: Mat3) -> Mat3:
    """Rows for θ, γ, ψ after a fold: θ's changes sign."""
    return Mat3(-rows.x, rows.y, rows.z)


@compiled
def pitch_turned(P: Mat3) -> Mat3:
    """P after a fold: the rows and columns of θ change sign."""
    return Mat3(Vec3(P.x.x, -P.x.y, -P.x.z), Vec3(-P.y.x, P.y.y, P.y.z), Vec3(-P.z.x, P.z.y, P.z.z))
