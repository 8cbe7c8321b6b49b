"""The two methods whose states are angles, armband and tilt, a second time; as oracles.py says."""

from __future__ import annotations

import numpy as np

from oracles import (
    Answer,
    Floats,
    angles_of,
    continuous,
    cross,
    from_angles,
    known,
    matrix,
    product,
    start_attitude,
    tilt_of,
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


def rate_map(x: Floats, least_cosine: float = 0.02) -> Floats:
    """J: (θ', γ', ψ') = J w. Open: how far cos θ is kept from 0."""
    st, ct, sg, cg = np.sin(x[PITCH]), np.cos(x[PITCH]), np.sin(x[ROLL]), np.cos(x[ROLL])
    if abs(ct) < least_cosine:
        ct = np.copysign(least_cosine, ct)
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

    # 1. start. Open: P0 is the wide one until there were 0.1 s of rest; what rest is (every sensor close, axis by axis, to
    # its mean so far, and the rate small); a field's mean is that of its directions.
    x = np.zeros(6)
    x[:3] = triple(start_attitude(acc[0], mag[0], declination))
    x[3:] = gyr[0]
    starting = True
    p = np.diag([wide**2] * 3 + [0.0] * 3)
    fs, ms, ws = [acc[0]], [mag[0] / np.linalg.norm(mag[0])] if known(mag[0]) else [], [gyr[0]]
    variance = np.zeros(3)

    quats, sigmas, rates = [], [], []

    def say() -> None:
        quats.append(quaternion(x))
        sigmas.append(about_earth(x, p[:3, :3]))
        rates.append(x[3:].copy())

    say()
    for i in range(1, len(time)):
        dt = time[i] - time[i - 1]
        w, f, m = gyr[i], acc[i], mag[i]

        if starting:
            starting = time[i] - time[0] < start_time and bool((np.abs([w, w - np.mean(ws, axis=0)]) <= rest_gyr).all())
            if known(f):
                starting &= bool((np.abs(f - np.mean(fs, axis=0)) <= rest_acc).all())
            if known(m) and ms:
                starting &= bool((np.abs(m / np.linalg.norm(m) - np.mean(ms, axis=0)) <= rest_mag).all())
        if starting:
            ws.append(w)
            fs += [f] if known(f) else []
            ms += [m / np.linalg.norm(m)] if known(m) else []
            mean_m = np.mean(ms, axis=0) if ms else np.full(3, np.nan)
            x[:3] = triple(start_attitude(np.mean(fs, axis=0), mean_m, declination))
            x[3:] = np.mean(ws, axis=0)
            if time[i] - time[0] >= 0.1:
                p = np.diag([initial_tilt**2, initial_tilt**2, initial_heading**2, 0.0, 0.0, 0.0])
            say()
            continue

        # 2., 3. predict
        x[3:] = w
        p[3:, :] = p[:, 3:] = 0.0
        j = np.eye(3) if kinematics == "small-angle" else rate_map(x)
        phi = np.block([[np.eye(3), dt * j], [np.zeros((3, 3)), np.eye(3)]])
        gamma = np.vstack([dt * j, np.eye(3)])
        q_noise = gyr_noise**2 / dt * np.eye(3)
        if kinematics == "exact":
            # Open: that the turn went past ±90°, for the signs of P: where the other triple is nearer to where it began.
            turned = triple(product(quaternion(x), turn(w * dt)))
            back = other_triple(turned)
            crossed = np.abs(wrap(back - x[:3])).sum() < np.abs(wrap(turned - x[:3])).sum()
            x[:3] = back if crossed else turned
        else:
            x = phi @ x
        p = phi @ p @ phi.T + gamma @ q_noise @ gamma.T
        if kinematics != "small-angle":
            x, p = folded(x, p)

        # 4. measurement. Open: what of it there is without an accelerometer (nothing) or a magnetometer (two rows of H).
        if not known(f):
            say()
            continue
        rows = [PITCH, ROLL, HEADING] if known(m) else [PITCH, ROLL]
        pitch, roll = tilt_of(f)
        measured = np.array([pitch, roll, true_heading(pitch, roll, m, declination) if known(m) else x[HEADING]])
        # Open: what is "nearer". The smaller sum of absolute differences of the angles that were measured.
        apart, other = wrap(measured - x[:3]), wrap(other_triple(measured) - x[:3])
        apart = min(apart, other, key=lambda differences: np.abs(differences[rows]).sum())
        z = weights * x[:3] + (1 - weights) * (x[:3] + apart)
        innovation = z - h @ x
        if r_mode == "running":
            # Open: the running variance is the mean square, from 0, with this sample in it; R the larger of the two.
            share = dt / (running_time + dt)
            for row in rows:
                variance[row] += share * (innovation[row] ** 2 - variance[row])
            r = np.diag(np.maximum(floor, variance * error_time)) / dt
        else:
            r = np.diag(floor) / dt

        # 5. update
        hr, rr = h[rows], r[np.ix_(rows, rows)]
        k = p @ hr.T @ np.linalg.inv(hr @ p @ hr.T + rr)
        x = x + k @ innovation[rows]
        p = (eye - k @ hr) @ p
        if kinematics != "small-angle":
            x, p = folded(x, p)
        say()
    return Answer(continuous(quats), np.array(sigmas), rate=np.array(rates))


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
    mean_f, rested = acc[0], 0.0
    rests: list[list[tuple[float, float, float]]] = [[]]

    quats, sigmas, biases, bias_sigmas = [], [], [], []

    def say() -> None:
        angles = np.array([xs[0][0], xs[1][0], 0.0])
        quats.append(quaternion(angles))
        p = np.diag([ps[0][0, 0], ps[1][0, 0], 0.0])
        sigmas.append([*about_earth(angles, p)[:2], np.pi])
        # Open: the bias in the body frame, and that of the rate which turns neither angle, of which nothing is learned.
        j = rate_map(angles, 1e-12)[:2] if kinematics == "euler" else np.eye(3)[:2]
        body, blind = j.T @ np.linalg.inv(j @ j.T), cross(j[0], j[1]) / np.linalg.norm(cross(j[0], j[1]))
        p = body @ np.diag([ps[PITCH][1, 1], ps[ROLL][1, 1]]) @ body.T + initial_bias**2 * np.outer(blind, blind)
        biases.append(body @ [xs[PITCH][1], xs[ROLL][1]])
        bias_sigmas.append(np.sqrt(np.diag(p)))

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
        fold_tilt(xs, kinematics)  # "fold as above": as armband does, before anything is compared with the measurement
        if known(f):
            z = np.array(tilt_of(f))
            # Open: what rest is, and what its variance is made of. The rate is small and the specific force close, axis
            # by axis, to a mean with a time constant of 0.5 s. All rests, each about its own mean; angle_noise until
            # there were 0.5 s of it. Every sample by its dt.
            mean_f = mean_f + dt / (0.5 + dt) * (f - mean_f)
            if np.linalg.norm(w) < rest_gyr and (np.abs(f - mean_f) <= rest_acc).all():
                rests[-1].append((dt, *z))
                rested += dt
            elif rests[-1]:
                rests.append([])
            variance = np.full(2, angle_noise**2 / dt)
            if r == "rest" and rested > 0.5:
                variance = np.maximum(pooled(rests), least_noise**2)
            apart = wrap(z - [xs[PITCH][0], xs[ROLL][0]])
            for axis in (PITCH, ROLL):
                x, p = xs[axis], ps[axis]
                # Open: the preset ratio is per second (the package's account says so); P by the Joseph form.
                k = p @ h.T @ np.linalg.inv(h @ p @ h.T + variance[axis])
                if gain == "fixed":
                    k = np.array([[min(ratio * dt, 1.0)], [0.0]])
                xs[axis] = x + k[:, 0] * apart[axis]
                ps[axis] = (np.eye(2) - k @ h) @ p @ (np.eye(2) - k @ h).T + variance[axis] * k @ k.T
            fold_tilt(xs, kinematics)
        say()
    return Answer(continuous(quats), np.array(sigmas), np.array(biases), np.array(bias_sigmas))


def pooled(rests: list[list[tuple[float, float, float]]]) -> Floats:
    """Variances of pitch and roll, each rest's about its own mean."""
    squares, seconds = np.zeros(2), 0.0
    for rest in filter(None, rests):
        dt, z = np.array(rest)[:, 0], np.unwrap(np.array(rest)[:, 1:], axis=0)
        squares += dt @ (z - np.average(z, axis=0, weights=dt)) ** 2
        seconds += dt.sum()
    return squares / seconds


def fold_tilt(xs: list[Floats], kinematics: str) -> None:
    """The other pair of angles past ±90° of pitch; the pitch then runs the other way, and so does its bias."""
    if kinematics == "euler" and folds(np.array([xs[0][0]])):
        xs[0] = np.array([wrap(np.pi - xs[0][0]), -xs[0][1]])
        xs[1] = np.array([wrap(xs[1][0] + np.pi), xs[1][1]])
