"""The method gated a second time; as oracles.py says."""

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
    start_attitude,
    tilt_of,
    turn,
)


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
    # Open: the start heading. That of the first magnetometer sample, magnetic, where there is one.
    q = start_attitude(acc[0], mag[0], 0.0)
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
        # 3. low-pass, and how long |f| has been gravity's length. Open: a time constant as τ/(τ + T).
        still += dt
        if known(f):
            keep = alpha if low_pass == "per-sample" else low_pass_time / (low_pass_time + dt)
            g = keep * g + (1 - keep) * f
            still = still if abs(np.linalg.norm(f) - gravity) < still_acc else 0.0
        # 2. gates. Open: nothing is corrected where the accelerometer has no sample.
        slow = np.linalg.norm(w) < gate_rate if rotation_gate == "rate" else np.linalg.norm(rot_v[1:]) < gate_vector
        inside = low < np.degrees(angles_of(q)[1]) < high
        steady = not still_gate or still >= still_time
        if slow and inside and steady and known(f):
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
