"""What conform says of an estimator whose convention is known, made from an exact attitude or taken from another package."""

from __future__ import annotations

import os
from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import poise
from helpers import angle_between
from poise import Recording
from poise.conformance import Conformance, conform, frames, outputs
from poise.errors import MethodError
from poise.math.quaternions import Quat, attitude_of, exp
from poise.math.vectors import Vec3
from poise.peers import PEERS, installed
from poise.peers.raw import RAW
from poise.simulation import PERFECT, forearm, measure

Floats = NDArray[np.float64]
G = 9.80665


def exact(time: Floats, gyr: Floats, acc: Floats, mag: Floats, gain: float = 0.02) -> Rotation:
    """An independent filter, body to ENU, of rad/s and specific force of any size: gyroscope, pulled to acc and mag."""
    up = acc / np.linalg.norm(acc, axis=1, keepdims=True)
    east = np.cross(mag, up)
    east /= np.linalg.norm(east, axis=1, keepdims=True)
    seen = Rotation.from_matrix(np.stack([east, np.cross(up, east), up], axis=1))
    steps = Rotation.from_rotvec(gyr * np.diff(time, prepend=time[0])[:, None])
    latest, rows = seen[0], []
    for i in range(len(time)):
        latest = latest * steps[i]
        latest = Rotation.from_rotvec(gain * (seen[i] * latest.inv()).as_rotvec()) * latest
        rows.append(latest.as_quat())
    return Rotation.from_quat(np.array(rows))


def made(
    order: str = "wxyz",
    inverse: bool = False,
    frame: str = "ENU",
    gyr_unit: str = "rad/s",
    acc_sign: int = 1,
    mag_sign: int = 1,
    body: int = 0,
) -> Callable[..., Any]:
    """An estimator with a convention of its own, from :func:`exact`, quick enough to be fed dozens of times."""
    earth = Rotation.from_matrix(frames.MATRICES[[frames.earth_name(m) for m in frames.MATRICES].index(frame)])
    turn = frames.MATRICES[body]  # their body axes: v_theirs = turnᵀ v

    def estimator(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
        rate = np.radians(gyr) if gyr_unit == "deg/s" else gyr
        inside = quick(time, rate @ turn, acc_sign * acc @ turn, mag_sign * mag @ turn)
        out = earth * inside
        out = out.inv() if inverse else out
        return (
            out.as_matrix()
            if order == "matrix"
            else out.as_quat()[:, [3, 0, 1, 2] if order == "wxyz" else [0, 1, 2, 3]]
        )

    return estimator


def quick(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Rotation:
    """As :func:`exact` does, compiled: vqf where it is there."""
    if installed("vqf") is None:
        return exact(time, gyr, acc, mag)
    return Rotation.from_quat(np.asarray(RAW["vqf"](time, gyr, acc, mag))[:, [1, 2, 3, 0]])


def raw(name: str) -> Callable[..., Any]:
    """Another package's filter; skips where its package is absent."""
    if installed(name.partition("-")[0]) is None:
        reason = f"{name} is not installed (the extra 'peers' brings it)"
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)
    return RAW[name]


def assert_adapted(found: Conformance, estimator: Any, limit: float = 1.0) -> None:
    """The adapter's code, run on another recording, gives its true attitude (but for a heading that nobody knows)."""
    recording = measure(forearm(30.0, 100.0, seed=8), PERFECT)
    names: dict[str, Any] = {"mine": estimator}
    exec(found.adapter.replace("estimator = named", "estimator = mine"), names)
    attitude = names["attitude"](recording)
    assert recording.truth is not None
    if attitude.heading_reference == "arbitrary":
        error = np.degrees(poise.evaluate(attitude, recording).inclination)[1000:]
    else:
        error = np.degrees(angle_between(attitude.quat, recording.truth.quat))[1000:]
    assert np.sqrt(np.nanmean(error**2)) < limit


EVERY = ("wxyz", "xyzw", "matrix"), (False, True), ("ENU", "NED", "NWU", "SEU", "EUS"), ("rad/s", "deg/s")


@pytest.mark.parametrize(
    ("order", "inverse", "frame", "gyr_unit"),
    [combination for i, combination in enumerate(product(*EVERY)) if i % 3 == 0],  # every two of the values meet
)
def test_every_convention_is_named(order: str, inverse: bool, frame: str, gyr_unit: str) -> None:
    estimator = made(order, inverse, frame, gyr_unit)
    found = conform(estimator, name="named")
    assert found.verdict == "conforms", str(found)
    told = found.convention
    assert told["direction"] == ("Earth to body" if inverse else "body to Earth")
    assert told["gyr"] == gyr_unit
    assert found["body axes"].answer == "as fed"
    assert told["order"] == (None if order == "matrix" else order)
    assert (told["frame"], told["acc_sign"], told["mag_sign"]) == (frame, 1, 1)
    assert found.residual_deg < 0.5 and found.margin_deg > 20.0
    assert_adapted(found, estimator)


@settings(max_examples=12, deadline=None)
@given(
    order=st.sampled_from(["wxyz", "xyzw"]),
    inverse=st.booleans(),
    frame=st.sampled_from([frames.earth_name(m) for m in frames.MATRICES]),
    gyr_unit=st.sampled_from(["rad/s", "deg/s"]),
    acc_sign=st.sampled_from([1, -1]),
    mag_sign=st.sampled_from([1, -1]),
    body=st.integers(0, 23),
)
def test_whatever_it_is_called_its_adapter_gives_the_attitude(
    order: str, inverse: bool, frame: str, gyr_unit: str, acc_sign: int, mag_sign: int, body: int
) -> None:
    """Several names can mean one estimator (other signs, another frame); what is told has to be right in every case."""
    estimator = made(order, inverse, frame, gyr_unit, acc_sign, mag_sign, body)
    found = conform(estimator, name="named")
    assert found.verdict == "conforms" and found.convention["gyr"] == gyr_unit
    assert_adapted(found, estimator)


def test_gravity_for_acc_is_told_by_a_frame_that_is_known() -> None:
    told = conform(made(acc_sign=-1), name="named").convention
    assert (told["frame"], told["acc_sign"], told["mag_sign"]) == ("ENU", -1, 1)


def test_a_frame_that_two_signs_can_mean_is_said_both_ways() -> None:
    """NED from gravity is NWU from specific force: nothing that is fed can tell the two apart."""
    found = conform(made(frame="NED", acc_sign=-1), name="named")
    assert found.convention["frame"] == "NWU"
    assert "the same, said otherwise: NED, fed gravity (−acc)" in found.hints
    found = conform(made(mag_sign=-1), name="named")
    assert found.convention["frame"] == "WSU"
    assert "the same, said otherwise: ENU, fed specific force and a negated magnetometer" in found.hints


def test_axes_of_another_body_are_named() -> None:
    body = [frames.body_words(m.T) for m in frames.MATRICES].index("y -x z")
    found = conform(made(body=body), name="named")
    assert found.convention["frame"] == "ENU" and '"y -x z"' in found["body axes"].answer


@pytest.mark.parametrize(
    ("sequence", "degrees", "columns", "frame"),
    [("ZYX", True, [2, 1, 0], "NED"), ("ZYX", False, [0, 1, 2], "ENU"), ("ZXY", True, [0, 1, 2], "ENU")],
)
def test_euler_angles(sequence: str, degrees: bool, columns: list[int], frame: str) -> None:
    inner = made(frame=frame)

    def estimator(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
        turn = Rotation.from_quat(inner(time, gyr, acc, mag)[:, [1, 2, 3, 0]])
        return turn.as_euler(sequence, degrees=degrees)[:, columns]

    found = conform(estimator, name="named")
    told = found.convention
    assert (told["output"], told["order"], told["degrees"], told["frame"]) == ("Euler angles", sequence, degrees, frame)
    assert_adapted(found, estimator)


def test_a_compass_heading_is_a_turn_the_other_way() -> None:
    def estimator(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
        attitude = poise.Attitude.of(time, made()(time, gyr, acc, mag))
        return attitude.euler("ZXY", degrees=True) * [-1, 1, 1]

    found = conform(estimator, name="named")
    assert "from columns −1, 2, 3, degrees" in found["output"].answer
    assert_adapted(found, estimator)


@pytest.mark.parametrize(
    ("name", "frame", "gyr", "acc_sign"),
    [
        ("vqf", "ENU", "rad/s", 1),
        ("vqf-offline", "ENU", "rad/s", 1),
        ("imufusion", "NWU", "deg/s", 1),
        ("imufusion-enu", "ENU", "deg/s", 1),
        ("imufusion-ned", "NED", "deg/s", 1),
        ("ahrs-madgwick", "NWU", "rad/s", 1),
        ("ahrs-ekf", "ENU", "rad/s", -1),
    ],
)
def test_other_packages_have_the_frames_that_the_adapters_say(name: str, frame: str, gyr: str, acc_sign: int) -> None:
    rate = 50.0 if name.startswith("ahrs") else 100.0  # it is slow
    found = conform(
        raw(name), name=name, rate=rate, imported=f"from poise.peers.raw import {RAW[name].__name__} as estimator"
    )
    told = found.convention
    assert (told["order"], told["direction"], told["frame"]) == ("wxyz", "body to Earth", frame)
    assert (told["gyr"], told["acc_sign"], told["mag_sign"]) == (gyr, acc_sign, 1)
    if name == "ahrs-ekf":  # its field of Munich points 3.4° east of north
        assert found.convention["turn_about_up_deg"] == pytest.approx(3.4, abs=0.3)
    recording = measure(forearm(30.0, 100.0, seed=8), PERFECT)
    peer = PEERS[{"imufusion-enu": "imufusion", "imufusion-ned": "imufusion"}.get(name, name)]
    names: dict[str, Any] = {}
    exec(found.adapter, names)
    apart = np.degrees(angle_between(names["attitude"](recording).quat, peer.attitude(recording).quat))[1000:]
    assert np.sqrt(np.mean(apart**2)) < 4.0  # settings differ, frames do not


def test_without_a_magnetometer_the_heading_is_arbitrary() -> None:
    found = conform(raw("vqf-6d"), name="named")
    assert found["magnetometer"].answer == "not used" and found.convention["vertical"] == "z up"
    assert "heading arbitrary" in found["Earth frame"].answer and found.convention["frame"] is None
    assert_adapted(found, raw("vqf-6d"))


def test_our_own_method() -> None:
    found = conform(poise.TwoStage())
    told = found.convention
    assert (told["order"], told["direction"], told["frame"], told["gyr"]) == ("wxyz", "body to Earth", "ENU", "rad/s")
    assert found["time"].answer == "every step counts"


# -- what does not follow ------------------------------------------------------------------------------------------------


def test_the_truth_of_nothing_is_said_so() -> None:
    found = conform(lambda time, gyr, acc, mag: np.tile([1.0, 0.0, 0.0, 0.0], (len(time), 1)), name="identity")
    assert found.verdict == "does not conform" and found["output"].answer == "constant" and not found.adapter
    assert found.residual_deg > 60.0

    rng = np.random.default_rng(0)
    found = conform(lambda time, gyr, acc, mag: rng.normal(size=(len(time), 4)), name="random")
    assert found.verdict == "does not conform" and "another answer" in found["repeatability"].answer

    found = conform(lambda time, gyr, acc, mag: np.full((len(time), 4), np.nan), name="nan")
    assert found.verdict == "does not conform" and "NaN" in found.summary


@pytest.mark.parametrize(
    ("mistake", "hint"),
    [
        ({"gyr": [[1, 0, 0], [0, -1, 0], [0, 0, 1]]}, 'with gyr fed as "x -y z" it follows'),
        ({"gyr": [[0, 1, 0], [1, 0, 0], [0, 0, 1]]}, 'with gyr fed as "y x z" it follows'),
        ({"gyr": [[0, 0.5, 0], [-0.5, 0, 0], [0, 0, 0.5]]}, 'with gyr fed as "-y x z", times 2'),
        ({"mag": [[1, 0, 0], [0, -1, 0], [0, 0, 1]]}, 'with mag fed as "x -y z" it follows'),
        ({"acc": [[0, 1, 0], [1, 0, 0], [0, 0, 1]]}, 'with acc fed as "y x z" it follows'),
    ],
)
def test_a_mistake_in_one_sensor_is_found(mistake: dict[str, Any], hint: str) -> None:
    def estimator(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
        given_ = {"gyr": gyr, "acc": acc, "mag": mag}
        given_ |= {name: given_[name] @ np.array(matrix).T for name, matrix in mistake.items()}
        return made()(time, **given_)

    found = conform(estimator, name="wrong")
    assert found.verdict == "does not conform"
    assert any(hint in each for each in found.hints), found.hints


def test_a_gyroscope_of_the_other_sign_and_a_fixed_step_are_found() -> None:
    found = conform(lambda time, gyr, acc, mag: made()(time, -gyr, acc, mag), name="named")
    assert found.convention["gyr_sign"] == -1 and "wrong sign" in " ".join(found.hints)

    found = conform(lambda gyr, acc, mag: made()(np.arange(len(gyr)) / 256.0, gyr, acc, mag), name="named")
    assert found.convention["rate"] == 256.0 and "stamps ignored" in found["time"].answer
    found = conform(lambda gyr, acc, mag: made()(np.arange(len(gyr)) / 256.0, gyr, acc, mag), name="named", rate=256.0)
    assert found.verdict == "conforms" and "step of its own" not in " ".join(found.hints)


def test_a_filter_that_counts_in_g_is_told_from_one_that_does_not() -> None:
    """It listens to the accelerometer between 0.9 and 1.1 g only, so that in m/s² a gyroscope's bias runs away."""

    def estimator(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
        size = np.linalg.norm(acc, axis=1)
        if np.median(np.abs(size - 1.0)) > 0.1:
            acc = np.tile(acc[:1], (len(acc), 1))
        return made()(time, gyr, acc, mag)

    found = conform(estimator, name="named")
    assert "specific force (+g up at rest), g" in found["accelerometer"].answer


def test_an_inclination_alone() -> None:
    found = conform(poise.Tilt())
    assert found.verdict == "inclination only" and "slow motion" in found.summary


# -- the shapes that people have ------------------------------------------------------------------------------------------


class Updater:
    """One sample a call; the answer is an attribute, always the same array."""

    def __init__(self, dt: float = 0.01) -> None:
        self.dt = dt
        self.quat = np.array([1.0, 0.0, 0.0, 0.0])

    def update(self, gyr: Floats, acc: Floats, mag: Floats) -> None:
        seen = np.array(attitude_of(Vec3(*acc.tolist()), Vec3(*mag.tolist()), 0.0))
        now = np.array(Quat(*self.quat.tolist()) * exp(Vec3(*(self.dt * gyr).tolist())))
        now += 0.05 * (np.copysign(1.0, now @ seen) * seen - now)
        self.quat[:] = now / np.linalg.norm(now)


def maker() -> Updater:
    return Updater(0.01)


def maker_at(dt: float) -> Updater:
    return Updater(dt)


def triad(acc: Floats, mag: Floats) -> Floats:
    """(3, 3) of one sample: it remembers nothing."""
    up = acc / np.linalg.norm(acc)
    east = np.cross(mag, up) / np.linalg.norm(np.cross(mag, up))
    return np.array([east, np.cross(up, east), up])


def step(q: Floats, gx: float, gy: float, gz: float, dt: float) -> Any:
    """A step of the gyroscope alone, from the attitude before, x y z w."""
    return (Rotation.from_quat(q) * Rotation.from_rotvec(np.array([gx, gy, gz]) * dt)).as_quat()


def samples() -> Recording:
    return measure(forearm(8.0, 100.0, seed=1), PERFECT)


@pytest.mark.parametrize("estimator", [Updater, Updater(), maker, maker_at, triad, step, poise.TwoStage()])
def test_shapes_of_an_estimator(estimator: Any) -> None:
    recording = samples()
    arrays = (recording.time, recording.gyr, recording.acc, recording.mag)
    once, twice = outputs(estimator, *arrays), outputs(estimator, *arrays)
    assert len(once) == len(recording)
    np.testing.assert_array_equal(once, twice)  # from new every time
    assert not np.array_equal(once[0], once[-1])


def test_an_updater_is_named() -> None:
    found = conform(maker_at, name="named", rate=25.0)
    assert (found.convention["frame"], found.convention["gyr"]) == ("ENU", "rad/s")
    assert "at rest" in found["settling"].answer


def boom(time: Floats, gyr: Floats, acc: Floats, mag: Floats) -> Any:
    return {}["nothing"]


@pytest.mark.parametrize(
    ("estimator", "says"),
    [
        (boom, r"boom raised KeyError: 'nothing' \(test_conformance.py, line \d+, in boom: return {}\[\"nothing\"\]\)"),
        (lambda time, gyr, acc, mag: gyr[:, :2], r"returned an array of shape \(\d+, 2\); expected"),
        (lambda time, gyr, acc, mag: gyr.T, r"transpose it"),
        (lambda time, gyr, acc, mag: np.zeros((len(gyr) - 1, 4)), r"one row for every sample"),
        (lambda time, gyr, acc, mag: None, r"returned nothing"),
        (lambda time, gyr, acc, mag: "good", r"returned a str"),
        (lambda time, gyr, acc, beta: gyr, r"what is 'beta'\? expected f\(time, gyr, acc, mag\)"),
        (object(), r"has no update\(\)"),
        (7, r"cannot be called"),
    ],
)
def test_what_cannot_be_run_says_why(estimator: Any, says: str) -> None:
    with pytest.raises(MethodError, match=says):
        conform(estimator)


def gyroscope_alone(time: NDArray[np.float64], gyr: NDArray[np.float64]) -> NDArray[np.float64]:
    """Adds up turns from the identity; the reverse direction."""
    quat = [Quat(1.0, 0.0, 0.0, 0.0)]
    for each in (np.diff(time)[:, None] * gyr[1:]).tolist():
        quat.append(quat[-1] * exp(Vec3(*each)))
    return np.array(quat)[:, [1, 2, 3, 0]] * [-1, -1, -1, 1]


def test_of_a_gyroscope_alone_the_earth_frame_cannot_be_told() -> None:
    found = conform(gyroscope_alone, name="named")
    assert found.verdict == "conforms" and not found["Earth frame"].told
    assert "up and heading: cannot tell" in found.summary
    told = found.convention
    assert (told["order"], told["direction"], told["gyr"]) == ("xyzw", "Earth to body", "rad/s")
    assert told["frame"] is None and told["vertical"] is None and told["uses"] == ["gyr", "time"]
    assert "ENU" not in found.adapter and "Attitude" not in found.adapter
    recording = measure(forearm(10.0, 100.0, seed=8), PERFECT)
    names: dict[str, Any] = {"mine": gyroscope_alone}
    exec(found.adapter.replace("estimator = named", "estimator = mine"), names)
    assert recording.truth is not None
    true = Rotation.from_quat(recording.truth.quat[:, [1, 2, 3, 0]])
    apart = (names["turned"](recording).inv() * (true[0].inv() * true)).magnitude()
    assert np.degrees(apart).max() < 1.0
