"""Euler angles as a filter's state: their rates against a derivative, the fold, and the nearer of two triples."""

from __future__ import annotations

from math import copysign, cos, pi, sin
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from helpers import Floats, array, assert_compiled_as_python, assert_same_attitude, close, flat, for_all, plain, wxyz
from poise.math.compiled import compiled
from poise.math.euler import folded, folds, off_by, rate_map, slope_at, without_heading
from poise.math.quaternions import Angles

LEAST = 0.02  # cos θ that the rates are kept from
turns = st.floats(-pi, pi)
triples = st.builds(Angles, turns, turns, turns)
level_triples = st.builds(Angles, st.floats(-1.5, 1.5), turns, turns)  # pitch in ±86°, where no cosine is held


def attitude(angles: Any) -> Rotation:
    pitch, roll, heading = angles
    return Rotation.from_euler("ZXY", [heading, pitch, roll])


def near(angles: Floats | Angles) -> Floats:
    """The same angles in [−π, π)."""
    return (array(angles) + pi) % (2 * pi) - pi


def rates_at(pitch: float, roll: float) -> Floats:
    return array(plain(rate_map)(plain(slope_at)(pitch, roll)))


# -- rates ------------------------------------------------------------------------------------------------------------


@for_all(level_triples)
@example(Angles(0.0, 0.0, 0.0))
@example(Angles(-1.5, 3.0, -3.0))
def test_the_rate_map_is_the_derivative_of_the_angles(angles: Angles) -> None:
    found, h = rates_at(angles.pitch, angles.roll), 1e-6
    for axis, column in zip(np.eye(3), found.T, strict=True):
        ahead, behind = (
            (attitude(angles) * Rotation.from_rotvec(step * axis)).as_euler("ZXY")[[1, 2, 0]] for step in (h, -h)
        )
        np.testing.assert_allclose(column, near(ahead - behind) / (2 * h), rtol=0, atol=1e-7)


@for_all(triples)
def test_the_other_triple_turns_the_same_way_but_for_its_pitch(angles: Angles) -> None:
    other = plain(folded)(angles)
    close(rates_at(other.pitch, other.roll), np.diag([-1.0, 1.0, 1.0]) @ rates_at(angles.pitch, angles.roll), 1e-9)


@for_all(st.floats(-0.99 * LEAST, 0.99 * LEAST), turns, st.sampled_from([-1.0, 1.0]))
@example(0.0, 0.5, 1.0)
def test_near_the_pole_the_rates_stay_those_of_89_degrees(past: float, roll: float, pole: float) -> None:
    pitch = pole * (0.5 * pi - past)
    found, held = rates_at(pitch, roll), copysign(LEAST, cos(pitch))
    close(found[0], [cos(roll), 0.0, sin(roll)])
    close(found[2], np.array([-sin(roll), 0.0, cos(roll)]) / held, 1e-9)
    close(found[1], np.array([0.0, 1.0, 0.0]) - sin(pitch) * found[2], 1e-9)  # γ' = w_y − sin θ ψ'


@for_all(turns, turns)
def test_slope_holds_sines_and_cosines_and_makes_the_attitude_without_heading(pitch: float, roll: float) -> None:
    slope = plain(slope_at)(pitch, roll)
    close(slope, [sin(pitch), cos(pitch), sin(roll), cos(roll)])
    assert_same_attitude(plain(without_heading)(slope), wxyz(Rotation.from_euler("XY", [pitch, roll])))


# -- the fold ---------------------------------------------------------------------------------------------------------


@for_all(triples)
@example(Angles(0.5 * pi, 0.0, 0.0))
@example(Angles(pi, -pi, pi))
def test_the_fold_keeps_the_attitude_and_undoes_itself(angles: Angles) -> None:
    other = plain(folded)(angles)
    assert_same_attitude(wxyz(attitude(other)), wxyz(attitude(angles)))
    assert np.abs(array(other)).max() <= pi
    close(near(array(plain(folded)(other)) - array(angles)), 0.0)


@for_all(st.floats(-20.0, 20.0))
def test_just_one_of_the_two_triples_folds(pitch: float) -> None:
    assume(abs(cos(pitch)) > 1e-9)
    assert plain(folds)(pitch) == (cos(pitch) < 0.0)
    assert plain(folds)(plain(folded)(Angles(pitch, 0.0, 0.0)).pitch) != plain(folds)(pitch)


# -- the nearer triple ------------------------------------------------------------------------------------------------


@for_all(triples, triples)
def test_off_by_leads_to_the_measured_attitude_by_the_nearer_triple(measured: Angles, predicted: Angles) -> None:
    found = array(plain(off_by)(measured, predicted, True))
    assert_same_attitude(wxyz(attitude(array(predicted) + found)), wxyz(attitude(measured)))
    sizes = [np.abs(near(array(t) - array(predicted))).sum() for t in (measured, plain(folded)(measured))]
    assert np.abs(found).sum() == pytest.approx(min(sizes))


@for_all(triples, triples)
def test_off_by_does_not_care_which_triple_names_the_measured_attitude(measured: Angles, predicted: Angles) -> None:
    straight = array(plain(off_by)(measured, predicted, True))
    other = array(plain(off_by)(plain(folded)(measured), predicted, True))
    ways = [near(array(t) - array(predicted)) for t in (measured, plain(folded)(measured))]
    assume(abs(np.abs(ways[0]).sum() - np.abs(ways[1]).sum()) > 1e-6)  # neither is nearer
    close(near(straight - other), 0.0)


@for_all(triples, triples, turns)
def test_without_a_heading_pitch_and_roll_alone_decide(measured: Angles, predicted: Angles, heading: float) -> None:
    found = plain(off_by)(measured, predicted, False)
    assert found.heading == 0.0
    sizes = [np.abs(near(array(t)[:2] - array(predicted)[:2])).sum() for t in (measured, plain(folded)(measured))]
    assert np.abs(array(found)).sum() == pytest.approx(min(sizes))
    assert plain(off_by)(Angles(measured.pitch, measured.roll, heading), predicted, False) == found


def test_off_by_across_the_pole_is_small() -> None:
    """88° on one side and 88° on the other are 4° apart, though roll and heading differ by half a turn."""
    before, after = Angles(np.radians(92.0), 0.0, 0.3), Angles(np.radians(88.0), pi, 0.3 - pi)
    close(off_by(after, before, True), [0.0, 0.0, 0.0])
    close(np.degrees(off_by(after, Angles(np.radians(88.0), 0.0, 0.3), True)), [4.0, 0.0, 0.0])


# -- compiled ---------------------------------------------------------------------------------------------------------


@compiled
def euler_area(a: Angles, b: Angles) -> Any:
    slope = slope_at(a.pitch, a.roll)
    pole = slope_at(1.57, a.roll)
    ways = (off_by(a, b, True), off_by(folded(a), b, True), off_by(a, b, False))
    return slope, without_heading(slope), rate_map(slope), rate_map(pole), folded(a), folds(1.5), folds(1.6), ways


@pytest.mark.parametrize("a", [Angles(0.3, -2.0, 1.1), Angles(-1.4, 3.0, -3.1), Angles(2.0, 0.1, 0.2)])
def test_euler_compiled_as_python(a: Angles) -> None:
    b = Angles(1.4, 1.0, -2.0)
    assert_compiled_as_python(euler_area, a, b)
    assert len(flat(euler_area(a, b))) > 30
