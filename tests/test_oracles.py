"""The package's kernels against tests/oracles.py, which was written from their specification: the same attitudes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

import oracles
import poise
from data_files import data_path
from helpers import Floats, angle_between
from poise.estimators.parameters import parameters
from poise.simulation import forearm, measure, phone

TOLERANCE = 1e-9  # rad; what is found is 1e-11 and less

ORACLES: dict[type, Callable[..., Floats]] = {
    poise.TwoStage: oracles.two_stage,
    poise.AdaptiveGain: oracles.adaptive_gain,
}


@cache
def recording(name: str) -> poise.Recording:
    """20 s that start with a sample of every sensor; "real" starts at rest, "wild" in fast motion, far from the truth."""
    if name not in ("real", "wild"):
        return measure({"forearm": forearm, "phone": phone}[name](20.0, 100.0, seed=3), seed=4)
    whole = poise.read(data_path("broad", "21_undisturbed_fast_combined.mat"))
    assert whole.moving is not None
    first = whole.time[np.argmax(whole.moving)] + (-3.0 if name == "real" else 40.0)
    whole = whole[(whole.time >= first) & np.isfinite(whole.acc + whole.mag).all(axis=1)]
    return whole.between(whole.time[0], whole.time[0] + 20.0)


def six_axes(full: poise.Recording) -> poise.Recording:
    return replace(full, mag=np.full_like(full.mag, np.nan))


def every(full: poise.Recording, acc: int = 1, mag: int = 1) -> poise.Recording:
    """Slower sensors: every so many rows, from the first."""
    thin = {}
    for name, step in (("acc", acc), ("mag", mag)):
        values = getattr(full, name).copy()
        values[np.arange(len(full)) % step != 0] = np.nan
        thin[name] = values
    return replace(full, **thin)


def disagreement(method: Any, data: poise.Recording) -> float:
    """The largest angle, rad, between package and oracle."""
    ours = poise.estimate(method, data, guard=False, rest_bias=False).quat
    theirs = ORACLES[type(method)](data.time, data.gyr, data.acc, data.mag, **method._asdict()).quat
    assert np.isfinite(ours).all() and np.isfinite(theirs).all()
    return float(angle_between(ours, theirs).max())


def one_by_one(method_class: Any) -> list[Any]:
    """The defaults, the print, and every value of every choice alone."""
    methods = [method_class(), method_class.as_printed()]
    for parameter in parameters(method_class):
        values = parameter.choices or ((True, False) if parameter.kind is bool else ())
        methods += [method_class(**{parameter.name: value}) for value in values if value != parameter.default]
    return methods


def label(value: Any) -> str:
    if not isinstance(value, tuple):
        return str(value)
    different = {k: v for k, v in value._asdict().items() if v != type(value)._field_defaults[k]}
    return "-".join([type(value).__name__, *(f"{k}={v}" for k, v in different.items())])


METHODS = [*one_by_one(poise.TwoStage), *one_by_one(poise.AdaptiveGain)]

COMBINED = [
    poise.TwoStage(declination=0.3, gravity=9.78, motion_factor=30.0, acc_noise=0.3),
    poise.TwoStage(stage1_heading="measured", decouple=True, declination=-2.0),
    poise.AdaptiveGain(declination=0.3, check_window=30, check_min_count=10, check_factor=1.0, check_floor=1e-4),
    poise.AdaptiveGain(deviation="rate-cross", check="absolute", check_threshold=1e-3, k_forced=0.0),
    poise.AdaptiveGain(deviation="euler-sum", check="absolute", check_threshold=1e-4, k_forced=2.0),
    poise.AdaptiveGain(deviation="euler-sum", check_floor=1e-6, check_factor=2.0, gain="gaussian", k_forced=1.0),
    poise.AdaptiveGain(rest_sensors="acc+gyr+mag", rest_time=0.1, rest_gyr=1.0, rest_acc=3.0, rest_mag=0.3),
]


@pytest.mark.parametrize("name", ["forearm", "real"])
@pytest.mark.parametrize("method", METHODS, ids=label)
def test_every_choice(method: Any, name: str) -> None:
    assert disagreement(method, recording(name)) < TOLERANCE


@pytest.mark.parametrize("method", COMBINED, ids=label)
def test_other_values(method: Any) -> None:
    assert disagreement(method, recording("forearm")) < TOLERANCE


@pytest.mark.parametrize("name", ["phone", "wild"])
@pytest.mark.parametrize("method_class", ORACLES, ids=lambda c: c.__name__)
def test_other_motions(method_class: Any, name: str) -> None:
    assert disagreement(method_class(), recording(name)) < TOLERANCE


@pytest.mark.parametrize("name", ["forearm", "real"])
@pytest.mark.parametrize("method_class", ORACLES, ids=lambda c: c.__name__)
def test_six_axes(method_class: Any, name: str) -> None:
    assert disagreement(method_class(), six_axes(recording(name))) < TOLERANCE


@pytest.mark.parametrize("sensors", [{"mag": 4}, {"acc": 3}, {"acc": 3, "mag": 4}], ids=str)
@pytest.mark.parametrize("method_class", ORACLES, ids=lambda c: c.__name__)
def test_slower_sensors(method_class: Any, sensors: dict[str, int]) -> None:
    assert disagreement(method_class(), every(recording("forearm"), **sensors)) < TOLERANCE


@pytest.mark.parametrize("thinned", [six_axes, lambda full: every(full, mag=4)], ids=["six axes", "slower mag"])
@pytest.mark.parametrize("method", [poise.TwoStage.as_printed(), poise.TwoStage(stage1_heading="measured")], ids=label)
def test_no_measured_heading(method: poise.TwoStage, thinned: Callable[[poise.Recording], poise.Recording]) -> None:
    """Stage 1 at the measured heading, where none was measured."""
    assert disagreement(method, thinned(recording("forearm"))) < TOLERANCE


@pytest.mark.parametrize("name", ["forearm", "phone"])
def test_the_two_readings_of_the_heading_of_x_differ_little(name: str) -> None:
    """The specification's "x⁻'s heading" is the Euler angle; the package turns x⁻ the shortest way.

    In slow motion they are the same. In fast motion, through steep pitches, they are not ("real": up to 30°, mean error
    13.4° with the Euler angle, 7.6° with the shortest turn), which is why the package has the latter.
    """
    data, method = recording(name), poise.TwoStage()
    by_turn, by_angles = (
        oracles.two_stage(data.time, data.gyr, data.acc, data.mag, **method._asdict(), level=level).quat
        for level in ("turn", "angles")
    )
    assert angle_between(by_turn, by_angles).max() < np.radians(0.1)
