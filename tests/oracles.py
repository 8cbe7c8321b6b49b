"""The methods a second time: plain numpy, written from their specification and not from the package.

Everything is spelled out the textbook way (4×4 matrices, ``np.linalg.inv``, scipy for Euler angles) and slow. Where the
specification leaves a choice open, a comment that begins with "Open:" says which one is taken here (the package's, read
after this file was first finished, unless the comment says otherwise). Here are what all of them use, two_stage and
adaptive_gain; the others are in oracles_euler.py and oracles_gated.py.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Floats = NDArray[np.float64]


class Answer(NamedTuple):
    """What a method says, a row for every sample; None where it says nothing or it is not worked out here."""

    quat: Floats
    sigma: Floats | None = None
    bias: Floats | None = None
    bias_sigma: Floats | None = None
    rate: Floats | None = None


UP = np.array([0.0, 0.0, 1.0])
NORTH = np.array([0.0, 1.0, 0.0])


# -- the conventions -------------------------------------------------------------------------------------------------


def cross(u: Floats, v: Floats) -> Floats:
    """u × v; np.cross takes twenty times as long for one pair."""
    return np.array([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])


def product(p: Floats, q: Floats) -> Floats:
    """Hamilton's p ⊗ q, scalar first."""
    return np.array([p[0] * q[0] - p[1:] @ q[1:], *(p[0] * q[1:] + q[0] * p[1:] + cross(p[1:], q[1:]))])


def matrix(q: Floats) -> Floats:
    """The rotation matrix of a unit quaternion: v_earth = matrix(q) @ v_body."""
    return Rotation.from_quat(q[[1, 2, 3, 0]]).as_matrix()


def turn(vector: Floats) -> Floats:
    """The quaternion of a rotation vector, rad."""
    return Rotation.from_rotvec(vector).as_quat()[[3, 0, 1, 2]]


def from_angles(pitch: float, roll: float, heading: float) -> Floats:
    """q = Rz(heading) Rx(pitch) Ry(roll)."""
    return Rotation.from_euler("ZXY", [heading, pitch, roll]).as_quat()[[3, 0, 1, 2]]


def angles_of(q: Floats) -> Floats:
    """(heading, pitch, roll), rad."""
    return Rotation.from_quat(q[[1, 2, 3, 0]]).as_euler("ZXY")


def tilt_of(f: Floats) -> tuple[float, float]:
    """(pitch, roll), rad, of a resting accelerometer."""
    return float(np.arcsin(f[1] / np.linalg.norm(f))), float(np.arctan2(-f[0], f[2]))


def true_heading(pitch: float, roll: float, m: Floats, declination: float) -> float:
    """Heading, rad, counter-clockwise from true north."""
    st, ct, sg, cg = np.sin(pitch), np.cos(pitch), np.sin(roll), np.cos(roll)
    return float(np.arctan2(cg * m[0] + sg * m[2], st * sg * m[0] + ct * m[1] - st * cg * m[2]) - declination)


def known(v: Floats) -> bool:
    """Whether a sensor says something: finite, and not all zeros."""
    return bool(np.isfinite(v).all() and v.any())


def start_attitude(f: Floats, m: Floats, declination: float) -> Floats:
    """The attitude by the first sample; heading 0 without a magnetometer."""
    pitch, roll = tilt_of(f)
    return from_angles(pitch, roll, true_heading(pitch, roll, m, declination) if known(m) else 0.0)


def continuous(quats: list[Floats]) -> Floats:
    """The same attitudes without jumps of sign."""
    rows = np.array(quats)
    for i in range(1, len(rows)):
        if rows[i] @ rows[i - 1] < 0:
            rows[i] = -rows[i]
    return rows


# -- 2. two_stage ------------------------------------------------------------------------------------------------------


def omega(w: Floats) -> Floats:
    """4×4: q ⊗ (0, w) = omega(w) @ q."""
    x, y, z = w
    return np.array([[0, -x, -y, -z], [x, 0, z, -y], [y, -z, 0, x], [z, y, -x, 0]])


def exponential(a: Floats) -> Floats:
    """The power series of exp, for small a; scipy's expm takes seven times as long where cores are busy (threads)."""
    term = total = np.eye(len(a))
    for k in range(1, 25):
        term = term @ a / k
        total = total + term
    return total


def xi(q: Floats) -> Floats:
    """4×3: q ⊗ (0, w) = xi(q) @ w."""
    w, x, y, z = q
    return np.array([[-x, -y, -z], [w, -z, y], [z, w, -x], [-y, x, w]])


def up_jacobian(q: Floats) -> Floats:
    """H1, 3×4: derivative of body-frame up (2(xz − wy), 2(yz + wx), w² − x² − y² + z²)."""
    w, x, y, z = q
    return 2.0 * np.array([[-y, z, -w, x], [x, w, z, y], [w, -x, -y, z]])


def north_jacobian(q: Floats) -> Floats:
    """H2, 3×4: derivative of body-frame north (2(xy + wz), w² − x² + y² − z², 2(yz − wx))."""
    w, x, y, z = q
    return 2.0 * np.array([[z, y, x, w], [w, -x, y, -z], [-x, -w, z, y]])


def earth_turns(x: Floats) -> Floats:
    """4×3: its columns e_x ⊗ x, e_y ⊗ x, e_z ⊗ x are the directions in which x moves when the body turns about them."""
    return np.column_stack([product(np.array([0.0, *axis]), x) for axis in np.eye(3)])


def about_up(x: Floats) -> Floats:
    """t = (e_z ⊗ x)/|x|."""
    return earth_turns(x)[:, 2] / np.linalg.norm(x)


def about_earth(x: Floats, p: Floats) -> Floats:
    """Standard deviations about the Earth's axes, at most half a turn, of a quaternion with covariance p."""
    return np.minimum(2.0 * np.sqrt(np.maximum(np.diag(earth_turns(x).T @ p @ earth_turns(x)), 0.0)), np.pi)


def levelled(x: Floats, f: Floats, how: str) -> Floats:
    """The accelerometer's tilt with the heading of x.

    Open: what the heading of x is once the tilt has changed. ``"turn"``: x is turned about a horizontal axis until f
    points up (the package); ``"angles"``: the Euler angle ψ of x is kept (the specification read to the letter).
    """
    x = x / np.linalg.norm(x)
    if how == "angles":
        return from_angles(*tilt_of(f), angles_of(x)[0])
    up = matrix(x) @ f / np.linalg.norm(f)
    axis, angle = cross(up, UP), np.arccos(np.clip(up @ UP, -1.0, 1.0))
    length = np.linalg.norm(axis)
    return product(turn(axis / length * np.arctan2(length, np.cos(angle))), x) if length > 0.0 else x


def two_stage(
    time: Floats,
    gyr: Floats,
    acc: Floats,
    mag: Floats,
    *,
    gyr_noise: float,
    acc_noise: float,
    mag_noise: float,
    motion_factor: float,
    transition: str,
    stage1_heading: str,
    decouple: bool,
    declination: float,
    gravity: float,
    level: str = "turn",
) -> Answer:
    """*level* is how the heading of x⁻ is kept, see :func:`levelled`."""
    eye = np.eye(4)
    x = start_attitude(acc[0], mag[0], declination)
    # Open: what P0 is. The accelerometer's variance about east and north and the magnetometer's about up, as densities
    # averaged over 0.01 s; ½ turns rotation vectors into quaternions.
    sigma0 = np.array([acc_noise / gravity, acc_noise / gravity, mag_noise]) / np.sqrt(0.01)
    p = 0.25 * earth_turns(x) @ np.diag(sigma0**2) @ earth_turns(x).T
    quats, sigmas = [x], [about_earth(x, p)]
    for i in range(1, len(time)):
        dt = time[i] - time[i - 1]
        f, m = acc[i], mag[i]
        # 2. predict. Open: Ξ is taken at x(k−1), not at x⁻.
        a = exponential(0.5 * dt * omega(gyr[i])) if transition == "exact" else eye + 0.5 * dt * omega(gyr[i])
        q_noise = (0.5 * dt) ** 2 * xi(x) @ xi(x).T * gyr_noise**2 / dt
        x = a @ x
        p = a @ p @ a.T + q_noise
        # 3. observation. Open: without an accelerometer sample the tilt of x⁻ stands in; without a magnetometer sample
        # "measured" has no heading of its own, and that of x⁻ stands in.
        if not known(f):
            f = matrix(x / np.linalg.norm(x)).T @ UP
        q_level = levelled(x, f, level)
        q_am = q_level
        if known(m):
            q_am = from_angles(*tilt_of(f), true_heading(*tilt_of(f), m, declination))
        q_am = q_am if q_am @ x >= 0 else -q_am
        # 4. stage 1, accelerometer. Open: t of `decouple` is taken at the estimate that the stage starts from; without
        # `decouple` the Joseph form is the short one, since the gain is then the optimal one.
        if known(acc[i]):
            q_one = q_level if stage1_heading == "predicted" else q_am
            h1 = up_jacobian(q_one)
            off = abs(np.linalg.norm(f) - gravity) / gravity
            r1 = (acc_noise / gravity) ** 2 / dt * (1 + motion_factor * off) ** 2 * np.eye(3)
            k1 = p @ h1.T @ np.linalg.inv(h1 @ p @ h1.T + r1)
            if decouple:
                k1 = (eye - np.outer(about_up(x), about_up(x))) @ k1
            x = x + k1 @ (h1 @ q_one - h1 @ x)
            p = (eye - k1 @ h1) @ p @ (eye - k1 @ h1).T + k1 @ r1 @ k1.T
        # 5. stage 2, magnetometer
        if known(m):
            h2 = north_jacobian(q_am)
            r2 = mag_noise**2 / dt * np.eye(3)
            k2 = p @ h2.T @ np.linalg.inv(h2 @ p @ h2.T + r2)
            if decouple:
                k2 = np.outer(about_up(x), about_up(x)) @ k2
            x = x + k2 @ (h2 @ q_am - h2 @ x)
            p = (eye - k2 @ h2) @ p @ (eye - k2 @ h2).T + k2 @ r2 @ k2.T
        x = x / np.linalg.norm(x)
        quats.append(x)
        sigmas.append(about_earth(x, p))
    return Answer(continuous(quats), np.array(sigmas))


# -- 3. adaptive_gain --------------------------------------------------------------------------------------------------


def adaptive_gain(
    time: Floats,
    gyr: Floats,
    acc: Floats,
    mag: Floats,
    *,
    k_rest: float,
    k_fast: float,
    threshold: float,
    gain: str,
    gain_width: float,
    rest_sensors: str,
    rest_acc: float,
    rest_gyr: float,
    rest_mag: float,
    rest_time: float,
    deviation: str,
    check: str,
    check_factor: float,
    check_threshold: float,
    check_window: float,
    check_min_count: float,
    check_floor: float,
    k_forced: float,
    gravity: float,
    declination: float,
) -> Answer:
    q = start_attitude(acc[0], mag[0], declination)
    # Open: what "still" is. The rate is small; specific force and field direction are close, axis by axis, to means with
    # a time constant of 0.5 s; all of that for rest_time. A sensor without a sample does not object.
    # Open: how gravity is averaged. Over all rest so far, each sample by its dt.
    g_ref, rested, still = gravity, 0.0, 0.0
    f_mean = acc[0]
    m_mean = mag[0] / np.linalg.norm(mag[0]) if known(mag[0]) else np.zeros(3)
    mu, variance, count = 0.0, 0.0, 0
    quats = [q]
    for i in range(1, len(time)):
        dt = time[i] - time[i - 1]
        w, f, m = gyr[i], acc[i], mag[i]
        predicted = product(q, turn(w * dt))
        to_body = matrix(predicted).T
        # Open: without an accelerometer sample the step is the gyroscope's alone, with or without a magnetometer's.
        if not known(f):
            q = predicted / np.linalg.norm(predicted)
            quats.append(q)
            continue

        # 1. gravity
        weight = dt / (0.5 + dt)
        f_mean = f_mean + weight * (f - f_mean)
        quiet = True
        if "acc" in rest_sensors:
            quiet &= bool((np.abs(f - f_mean) <= rest_acc).all())
        if "gyr" in rest_sensors:
            quiet &= bool(np.linalg.norm(w) <= rest_gyr)
        if "mag" in rest_sensors and known(m):
            direction = m / np.linalg.norm(m)
            m_mean = m_mean + weight * (direction - m_mean)
            quiet &= bool((np.abs(direction - m_mean) <= rest_mag).all())
        still = still + dt if quiet else 0.0
        if still >= rest_time:
            rested += dt
            g_ref = g_ref + (np.linalg.norm(f) - g_ref) * dt / rested

        # 2. motion acceleration
        motion = float(np.linalg.norm(f - g_ref * to_body @ UP))

        # 3. correction gain. Open: the gaussian falls from k_rest towards k_fast, and jumps at the threshold.
        if motion > threshold:
            k = k_fast
        elif gain == "linear":
            k = k_rest + (k_fast - k_rest) * motion / threshold
        else:
            k = k_fast + (k_rest - k_fast) * np.exp(-0.5 * (motion / gain_width) ** 2)

        # 4. correction vector
        up = f / np.linalg.norm(f)
        e = cross(up, to_body @ UP)
        if known(m):
            measured = matrix(start_attitude(f, m, declination)).T
            e = e + cross(measured @ NORTH, to_body @ NORTH)

        # 5. calibrated rate
        w_c = w + k * e

        # 6. deviation check. Open: µ and s take in the δ of the gain of step 3, also where another gain is forced; each
        # with weight 1/count, count ending at the window, which forgets exponentially.
        if deviation == "rate-norm":
            delta = float(np.linalg.norm(w - w_c))
        elif deviation == "rate-cross":
            delta = float(np.linalg.norm(cross(w, w_c)))
        else:
            difference = angles_of(predicted) - angles_of(product(q, turn(w_c * dt)))
            delta = float(np.abs((difference + np.pi) % (2 * np.pi) - np.pi).sum())
        if check != "off" and count >= check_min_count:
            s = max(np.sqrt(variance), check_floor)
            stands_out = delta - mu > check_threshold if check == "absolute" else abs(delta - mu) > check_factor * s
            if stands_out:
                w_c = w + k_forced * e
        count += 1
        weight = 1.0 / min(count, check_window)
        step = delta - mu
        mu += weight * step
        variance = (1 - weight) * (variance + weight * step**2)

        # 7. integrate
        q = product(q, turn(w_c * dt))
        q = q / np.linalg.norm(q)
        quats.append(q)
    return Answer(continuous(quats))
