"""The code that turns an estimator's output into an attitude of poise."""

from __future__ import annotations

from poise.conformance import frames
from poise.conformance.conventions import Fit
from poise.conformance.examining import Examined
from poise.conformance.feeding import Feed


def adapter(found: Examined, name: str, imported: str, heading: bool) -> str:
    """A function from a recording to its attitude, as Python source; *imported* makes ``estimator``."""
    assert found.choice
    feed, fit = found.choice.trial.feed, found.choice.fit
    upright = found.hears["acc"]
    frame = (
        "ENU"
        if heading
        else "z up, heading arbitrary"
        if upright
        else "its own at the first row, for up cannot be told"
    )
    lines = [
        "import numpy as np",
        "from scipy.spatial.transform import Rotation",
        "",
        *(["import poise"] if upright else []),
        "from poise.conformance import outputs",
        "",
        imported,
        "",
        "",
        f"def {'attitude' if upright else 'turned'}(recording):",
        f'    """The {"attitude" if upright else "turn"} by {name} of a poise.Recording: body to {frame}."""',
        f"    gyr = {_gyr(feed)}",
        f"    acc = {_acc(feed)}",
        f"    mag = {'-' * (feed.mag_sign < 0)}recording.mag",
        "    out = outputs(estimator, recording.time, gyr, acc, mag)  # or your own call",
        f"    turn = {_read(fit)}",
    ]
    if fit.reading.inverse:
        lines.append("    turn = turn.inv()  # Earth to body → body to Earth")
    if fit.nearest != 0 and upright:
        what = f"{fit.frame} → ENU" if heading else "z up"
        lines.append(f"    turn = Rotation.from_matrix({_matrix(fit.nearest)}).inv() * turn  # {what}")
    if heading and abs(fit.turn_about_up) >= 1.0:
        degrees = -fit.turn_about_up
        lines.append(
            f'    turn = Rotation.from_euler("z", {-degrees:.2f}, degrees=True) * turn  # its north is not magnetic north'
        )
    if fit.body != 0:
        lines.append(
            f"    turn = turn * Rotation.from_matrix({_matrix(fit.body)}).inv()  # its body axes → the sensor's"
        )
    if not upright:
        return "\n".join([*lines, "    return turn[0].inv() * turn"]) + "\n"
    reference = "magnetic" if heading else "arbitrary"
    lines.append(
        f'    return poise.Attitude.of(recording.time, turn.as_quat()[:, [3, 0, 1, 2]], heading_reference="{reference}")'
    )
    return "\n".join(lines) + "\n"


def _gyr(feed: Feed) -> str:
    plain = "np.degrees(recording.gyr)  # deg/s" if feed.gyr == "deg/s" else "recording.gyr  # rad/s"
    return f"{'-' * (feed.gyr_sign < 0)}{plain}"


def _acc(feed: Feed) -> str:
    sign = "-" * (feed.acc_sign < 0)
    words = "specific force" if feed.acc_sign > 0 else "gravity"
    return (
        f"{sign}recording.acc / 9.80665  # {words}, g" if feed.acc == "g" else f"{sign}recording.acc  # {words}, m/s²"
    )


def _read(fit: Fit) -> str:
    reading = fit.reading
    if reading.form == "Euler angles":
        signed = f" * {list(reading.signs)}" if min(reading.signs) < 0 else ""
        degrees = ", degrees=True" if reading.degrees else ""
        return f'Rotation.from_euler("{reading.order}", out[:, {list(reading.columns)}]{signed}{degrees})'
    if reading.form == "rotation matrix":
        return "Rotation.from_matrix(out)"
    return (
        "Rotation.from_quat(out)" if reading.order == "xyzw" else "Rotation.from_quat(out[:, [1, 2, 3, 0]])  # w x y z"
    )


def _matrix(index: int) -> str:
    return str(frames.MATRICES[index].astype(int).tolist())
