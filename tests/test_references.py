"""A reference in another convention is said to be so, and its figures stay; one that is only far away is not."""

from __future__ import annotations

import json
from itertools import product
from pathlib import Path

import numpy as np
import pytest

import poise
from poise.cli import run
from poise.conformance.references import misread
from poise.data.attitude import Attitude
from poise.math import arrays
from poise.simulation import PERFECT, forearm, measure

CONVENTIONS = [one for one in product((False, True), repeat=3) if any(one)]


@pytest.fixture(scope="module")
def found() -> Attitude:
    """The truth, 1° off."""
    made = measure(forearm(30.0, seed=2), PERFECT, seed=2)
    assert made.truth is not None
    off = np.array([np.cos(np.radians(0.5)), 0.0, 0.0, np.sin(np.radians(0.5))])
    return Attitude.of(made.time, arrays.multiply(off, made.truth.quat))


def written(true: Attitude, last: bool, inverse: bool, ned: bool) -> Attitude:
    """*true* as somebody writes it who has w last, turns Earth into body, or has NED; taken for what poise reads."""
    quat = (true.to("ned") if ned else true).quat
    quat = arrays.conjugate(quat) if inverse else quat
    return Attitude.of(true.time, quat[:, [1, 2, 3, 0]] if last else quat)


@pytest.mark.parametrize(("last", "inverse", "ned"), CONVENTIONS)
def test_every_usual_convention_is_named(found: Attitude, last: bool, inverse: bool, ned: bool) -> None:
    other = misread(found, written(found, last, inverse, ned))
    assert other is not None and other.error < 1e-3 < 20.0 < other.given
    assert (other.reading.order == "xyzw", other.reading.inverse, other.frame == "ned") == (last, inverse, ned)
    assert ("w last" in other.sentence, "inverted" in other.sentence, "NED" in other.sentence) == (last, inverse, ned)


def test_what_no_convention_explains_is_left_alone(found: Attitude) -> None:
    assert misread(found, found) is None
    for angle in (0.3, 1.5, np.pi / 2, np.pi):  # another heading is an error, or another zero
        turned = arrays.multiply(np.array([np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2)]), found.quat)
        assert misread(found, Attitude.of(found.time, turned)) is None
    other = measure(forearm(30.0, seed=5), PERFECT, seed=5)
    assert other.truth is not None and misread(found, other.truth) is None


def test_one_attitude_tells_no_convention() -> None:
    """A heading of 90° inverted is −90°: another convention, or another zero."""
    time, half = np.arange(100) / 100.0, np.sqrt(0.5)
    true = Attitude.of(time, np.tile([half, 0.0, 0.0, half], (100, 1)))
    assert misread(true, written(true, False, True, False)) is None


def test_two_that_explain_it_are_none() -> None:
    """Turns about north, without an axis of its own to tell: inverted in NED they are the turns that they were."""
    angle = np.linspace(0.0, 3.0, 300) / 2
    true = Attitude.of(np.arange(300) / 100.0, np.column_stack([np.cos(angle), 0 * angle, 0 * angle, np.sin(angle)]))
    for last, inverse, ned in CONVENTIONS:
        given = written(true, last, inverse, ned)
        other = misread(true, given)
        said = other and (other.reading.order == "xyzw", other.reading.inverse, other.frame == "ned")
        assert said in (None, (last, inverse, ned))


def test_the_command_says_so_and_keeps_the_figures(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    made = measure(forearm(30.0, seed=2), poise.simulation.Sensor(mag_delay=0.0), seed=2)
    assert made.truth is not None
    poise.write(made, tmp_path / "made.csv")
    poise.write(written(made.truth, False, True, False), tmp_path / "inverse.csv")
    told = ["evaluate", "made.csv", "-m", "two-stage", "--reference", "inverse.csv"]
    assert run(told) == 0
    assert "inverted (from Earth to body)" in capsys.readouterr().err
    assert run([*told, "--json"]) == 0
    (result,) = json.loads(capsys.readouterr().out)["results"]
    assert result["rmse_deg"]["total"] > 20.0 and "negate its x, y and z" in result["reference"]
    assert run(["evaluate", "made.csv", "-m", "two-stage"]) == 0
    assert "convention" not in capsys.readouterr().err
