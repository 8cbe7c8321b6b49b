"""The three methods whose states are angles, or that rebuild from them, a second time. As in tests/oracles.py."""

from __future__ import annotations

import numpy as np

from oracles import (
    UP,
    Answer,
    Floats,
    angles_of,
    continuous,
    cross,
    from_angles,
    known,
    matrix,
    product,
    tilt as tilt_of,
    true_heading,
    turn,
)

PITCH, ROLL, HEADING = 0, 1, 2


def wrap(angle: Floats | float) -> Floats:
    """The same angle in [−π, π)."""
    return np.asarray((np.asarray(angle) + np.pi) % (2 * np.pi) - np.pi)


def quaternion(x: Floats) -> Floats:
    return from_angles(x[PITCH], x[ROLL], x[HEADING])


def triple(q: Floats) -> Floats:
    """(θ, γ, ψ) of an attitude."""
    heading, pitch, roll = angles_of(q)
    return np.array([pitch, roll, heading])


def other_triple(x: Floats) -> Floats:
    """The second triple that names the same attitude."""
    return np.array([np.pi - x[PITCH], x[ROLL] + np.pi, x[HEADING] + np.pi])


def folds(x: Floats) -> bool:
    return bool(abs(wrap(x[PITCH])) > np.pi / 2)


def rate_map(x: Floats) -> Floats:
    """M: (θ', γ', ψ') = M w."""
    st, ct, sg, cg = np.sin(x[PITCH]), np.cos(x[PITCH]), np.sin(x[ROLL]), np.cos(x[ROLL])
    if abs(ct) < 1e-3:
        ct = np.copysign(1e-3, ct)
    pitch = np.array([cg, 0.0, sg])
    heading = np.array([-sg, 0.0, cg]) / ct
    roll = np.array([0.0, 1.0, 0.0]) - st * heading
    return np.array([pitch, roll, heading])


def earth_axes(x: Floats) -> Floats:
    """Columns: the Earth's axes about which the body turns when θ, γ, ψ grow."""
    heading, both = matrix(from_angles(0, 0, x[HEADING])), matrix(from_angles(x[PITCH], 0, x[HEADING]))
    return np.column_stack([heading[:, 0], both[:, 1], [0.0, 0.0, 1.0]])


def about_earth(x: Floats, p: Floats) -> Floats:
    """Standard deviations about the Earth's axes of angles with covariance p."""
    return np.minimum(np.sqrt(np.maximum(np.diag(earth_axes(x) @ p @ earth_axes(x).T), 0.0)), np.pi)


# -- 1. armband --------------------------------------------------------------------------------------------------------


def armband(
    time: Floats,
    gyr: Floats,
    acc: Floats,
    mag: Floats,
    *,
    gyr_noise: float,
    pitch_noise: float,
    roll_noise: float,
    heading_noise: float,
    r_mode: str,
    running_time: float,
    error_time: float,
    alpha: float,
    beta: float,
    zeta: float,
    kinematics: str,
    start_time: float,
    initial_tilt: float,
    initial_heading: float,
    wide: float,
    rest_acc: float,
    rest_gyr: float,
    rest_mag: float,
    declination: float,
) -> Answer:
    eye = np.eye(6)
    h = np.hstack([np.eye(3), np.zeros((3, 3))])
    weights = np.array([alpha, beta, zeta])
    floor = np.array([pitch_noise, roll_noise, heading_noise]) ** 2

    # 1. start
    x = np.zeros(6)
    x[:3] = triple(start_attitude_of(acc[0], mag[0], declination))
    x[3:] = gyr[0]
    starting = bool((np.abs(gyr[0]) <= rest_gyr).all())
    sigma0 = [initial_tilt, initial_tilt, initial_heading] if starting else [wide] * 3
    p = np.diag([*np.square(sigma0), 0.0, 0.0, 0.0])
    mean_f, mean_m, mean_w, n = acc[0], mag[0], gyr[0], 1
    variance = np.zeros(3)

    quats, sigmas = [quaternion(x)], [about_earth(x, p[:3, :3])]
    for i in range(1, len(time)):
        dt = time[i] - time[i - 1]
        w, f, m = gyr[i], acc[i], mag[i]

        if starting:
            starting = bool(time[i] - time[0] <= start_time and (np.abs(w) <= rest_gyr).all())
            if starting and known(f):
                starting = bool((np.abs(f - mean_f) <= rest_acc).all())
            if starting and known(m) and known(mean_m):
                apart = m / np.linalg.norm(m) - mean_m / np.linalg.norm(mean_m)
                starting = bool((np.abs(apart) <= rest_mag).all())
        if starting:
            n += 1
            mean_w = mean_w + (w - mean_w) / n
            mean_f = mean_f + (f - mean_f) / n if known(f) else mean_f
            mean_m = mean_m + (m - mean_m) / n if known(m) else mean_m
            x[:3] = triple(start_attitude_of(mean_f, mean_m, declination))
            x[3:] = mean_w
            quats.append(quaternion(x))
            sigmas.append(about_earth(x, p[:3, :3]))
            continue

        # 2., 3. predict
        x[3:] = w
        p[3:, :] = p[:, 3:] = 0.0
        rates = np.eye(3) if kinematics == "small-angle" else rate_map(x)
        phi = np.block([[np.eye(3), dt * rates], [np.zeros((3, 3)), np.eye(3)]])
        gamma = np.vstack([dt * rates, np.eye(3)])
        q_noise = gyr_noise**2 / dt * np.eye(3)
        if kinematics == "exact":
            turned = triple(product(quaternion(x), turn(w * dt)))
            back = other_triple(turned)
            crossed = np.abs(wrap(back - x[:3])).sum() < np.abs(wrap(turned - x[:3])).sum()
            x[:3] = back if crossed else turned
        else:
            x = phi @ x
        p = phi @ p @ phi.T + gamma @ q_noise @ gamma.T
        if kinematics != "small-angle":
            x, p = folded(x, p)

        # 4. measurement
        rows, measured = [], np.zeros(3)
        if known(f):
            measured[:2] = tilt_of(f)
            rows += [PITCH, ROLL]
        else:
            measured[:2] = x[:2]
        if known(m):
            measured[HEADING] = true_heading(measured[PITCH], measured[ROLL], m, declination)
            rows += [HEADING]
        else:
            measured[HEADING] = x[HEADING]
        apart = wrap(measured - x[:3])
        apart_other = wrap(other_triple(measured) - x[:3])
        if np.abs(apart_other).sum() < np.abs(apart).sum():
            apart = apart_other
        z = weights * x[:3] + (1 - weights) * (x[:3] + apart)
        innovation = z - h @ x
        if r_mode == "running":
            share = dt / (running_time + dt)
            for row in rows:
                variance[row] += share * (innovation[row] ** 2 - variance[row])
            r = np.diag(np.maximum(floor, variance * error_time)) / dt
        else:
            r = np.diag(floor) / dt

        # 5. update
        if rows:
            hr, rr = h[rows], r[np.ix_(rows, rows)]
            k = p @ hr.T @ np.linalg.inv(hr @ p @ hr.T + rr)
            x = x + k @ innovation[rows]
            p = (eye - k @ hr) @ p
            if kinematics != "small-angle":
                x, p = folded(x, p)
        quats.append(quaternion(x))
        sigmas.append(about_earth(x, p[:3, :3]))
    return Answer(continuous(quats), np.array(sigmas))


def start_attitude_of(f: Floats, m: Floats, declination: float) -> Floats:
    pitch, roll = tilt_of(f)
    return from_angles(pitch, roll, true_heading(pitch, roll, m, declination) if known(m) else 0.0)


def folded(x: Floats, p: Floats) -> tuple[Floats, Floats]:
    """Past ±90° of pitch the other triple; the pitch's row and column of p change their sign."""
    if not folds(x):
        return x, p
    x, sign = x.copy(), np.ones(len(p))
    x[:3] = wrap(other_triple(x[:3]))
    sign[PITCH] = -1.0
    return x, np.outer(sign, sign) * p


# -- 4. tilt -----------------------------------------------------------------------------------------------------------


def tilt(
    time: Floats,
    gyr: Floats,
    acc: Floats,
    mag: Floats,
    *,
    q_angle: float,
    q_bias: float,
    q_scaling: str,
    r: str,
    angle_noise: float,
    least_noise: float,
    rest_acc: float,
    rest_gyr: float,
    gain: str,
    ratio: float,
    initial_angle: float,
    initial_bias: float,
    kinematics: str,
) -> Answer:
    h = np.array([[1.0, 0.0]])
    xs = [np.array([angle, 0.0]) for angle in tilt_of(acc[0])]
    ps = [np.diag([initial_angle**2, initial_bias**2]) for _ in xs]
    mean_f, rest_mean, rest_var, rest_n = acc[0], np.array(tilt_of(acc[0])), np.zeros(2), 0
    rest_noise = np.full(2, np.nan)

    quats, sigmas, biases, bias_sigmas = [], [], [], []

    def say() -> None:
        angles = np.array([xs[0][0], xs[1][0], 0.0])
        quats.append(quaternion(angles))
        p = np.diag([ps[0][0, 0], ps[1][0, 0], 0.0])
        sigmas.append([*about_earth(angles, p)[:2], np.pi])
        rates = rate_map(angles)[:2] if kinematics == "euler" else np.eye(3)[:2]
        body = np.linalg.pinv(rates)
        biases.append(body @ [xs[0][1], xs[1][1]])
        bias_sigmas.append(np.sqrt(np.diag(body @ np.diag([ps[0][1, 1], ps[1][1, 1]]) @ body.T)))

    say()
    for i in range(1, len(time)):
        dt = time[i] - time[i - 1]
        w, f = gyr[i], acc[i]
        angles = np.array([xs[0][0], xs[1][0], 0.0])
        u = rate_map(angles)[:2] @ w if kinematics == "euler" else w[:2]
        a, b = np.array([[1.0, -dt], [0.0, 1.0]]), np.array([dt, 0.0])
        q = np.diag([q_angle, q_bias]) * (dt if q_scaling == "continuous" else 1.0)
        for axis in (PITCH, ROLL):
            xs[axis] = a @ xs[axis] + b * u[axis]
            ps[axis] = a @ ps[axis] @ a.T + q
        fold_tilt(xs, ps, kinematics)
        if known(f):
            z = np.array(tilt_of(f))
            mean_f = mean_f + dt / (0.5 + dt) * (f - mean_f)
            still = np.linalg.norm(w) <= rest_gyr and (np.abs(f - mean_f) <= rest_acc).all()
            if still:
                rest_n += 1
                step = wrap(z - rest_mean)
                rest_mean = rest_mean + step / rest_n
                rest_var = rest_var + (step * wrap(z - rest_mean) - rest_var) / rest_n
                rest_noise = np.maximum(rest_var, least_noise**2)
            variance = np.full(2, angle_noise**2 / dt)
            if r == "rest" and rest_n > 1:
                variance = rest_noise
            apart = np.array([wrap(z[axis] - xs[axis][0]) for axis in (PITCH, ROLL)])
            flipped = np.array([wrap(np.pi - z[0] - xs[0][0]), wrap(z[1] + np.pi - xs[1][0])])
            if np.abs(flipped).sum() < np.abs(apart).sum():
                apart = flipped
            for axis in (PITCH, ROLL):
                x, p = xs[axis], ps[axis]
                if gain == "fixed":
                    xs[axis] = x + np.array([ratio * dt * apart[axis], 0.0])
                    continue
                k = p @ h.T @ np.linalg.inv(h @ p @ h.T + variance[axis] * np.eye(1))
                xs[axis] = x + k[:, 0] * apart[axis]
                ps[axis] = (np.eye(2) - k @ h) @ p
            fold_tilt(xs, ps, kinematics)
        say()
    return Answer(continuous(quats), np.array(sigmas), np.array(biases), np.array(bias_sigmas))


def fold_tilt(xs: list[Floats], ps: list[Floats], kinematics: str) -> None:
    """The other pair of angles past ±90° of pitch; the pitch then runs the other way, and so does its bias."""
    if kinematics == "euler" and folds(np.array([xs[0][0]])):
        xs[0] = np.array([wrap(np.pi - xs[0][0]), -xs[0][1]])
        xs[1] = np.array([wrap(xs[1][0] + np.pi), xs[1][1]])


# -- 5. gated ----------------------------------------------------------------------------------------------------------


def gated(
    time: Floats,
    gyr: Floats,
    acc: Floats,
    mag: Floats,
    *,
    rotation_gate: str,
    gate_rate: float,
    gate_vector: float,
    low_pass: str,
    low_pass_time: float,
    alpha: float,
    pitch_window: tuple[float, float] | None,
    rebuild: str,
    still_gate: bool,
    still_acc: float,
    still_time: float,
    gravity: float,
) -> Answer:
    q = from_angles(*tilt_of(acc[0]), 0.0)
    g, still = acc[0], 0.0
    low, high = pitch_window or (-89.0, 89.0)
    quats = [q]
    for i in range(1, len(time)):
        dt = time[i] - time[i - 1]
        w, f = gyr[i], acc[i]
        # 1. integrate
        rot_v = turn(w * dt)
        q = product(q, rot_v)
        q = q / np.linalg.norm(q)
        # 3. low-pass
        if known(f):
            keep = alpha if low_pass == "per-sample" else low_pass_time / (low_pass_time + dt)
            g = keep * g + (1 - keep) * f
            still = still + dt if abs(np.linalg.norm(f) - gravity) < still_acc else 0.0
        # 2. gates
        if rotation_gate == "rate":
            opened = np.linalg.norm(w) < gate_rate
        else:
            opened = np.linalg.norm(rot_v[1:]) < gate_vector
        opened &= low < np.degrees(triple(q)[PITCH]) < high
        opened &= not still_gate or still >= still_time
        if opened and known(f):
            if rebuild == "euler":
                q = from_angles(*tilt_of(g), angles_of(q)[0])
            else:
                up = matrix(q) @ g / np.linalg.norm(g)
                axis = cross(up, UP)
                length = np.linalg.norm(axis)
                if length > 0.0:
                    q = product(turn(axis / length * np.arctan2(length, up @ UP)), q)
        quats.append(q)
    return Answer(continuous(quats))
