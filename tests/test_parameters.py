"""Parameters: made exact before a kernel sees them, refused with a name and a reason, and explained."""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
import pytest

from poise.errors import MethodError, PoiseError
from poise.estimators.adaptive_gain import AdaptiveGain
from poise.estimators.guard import Guard
from poise.estimators.parameters import as_dict, parameters, prepared
from poise.estimators.rest_bias import RestBias
from poise.estimators.two_stage import TwoStage
from poise.math.choices import Choice
from poise.math.vectors import Vec3


class Tried(NamedTuple):
    """A method with one parameter of every kind."""

    gain: Annotated[float, "1/s", "how hard it pulls"] = 1.0
    offset: Annotated[float, "rad", "where it starts", (-1.0, 1.0)] = 0.0
    count: Annotated[int, "samples", "how many", (1, 100)] = 10
    mode: Annotated[Literal["fast", "slow"], "", "which way"] = "fast"
    strict: Annotated[bool, "", "whether to insist"] = False
    bare: float = 2.0

    def start(self, sample: Any, bias: Any) -> Any:
        return None

    def step(self, state: Any, sample: Any) -> Any:
        return state


@pytest.mark.parametrize("three", [3, 3.0, np.int64(3), np.float32(3), np.array(3.0)])
def test_numbers_of_any_type_become_the_declared_one(three: Any) -> None:
    found = prepared(Tried(gain=three, count=three))
    assert type(found.gain) is float and found.gain == 3.0
    assert type(found.count) is int and found.count == 3


def test_choices_and_flags_become_what_kernels_know() -> None:
    found = prepared(Tried(mode="slow", strict=np.bool_(True)))  # type: ignore[arg-type]
    assert type(found.mode) is Choice and found.mode == "slow"
    assert found.strict is True


def test_what_is_right_already_stays_and_is_the_same_type() -> None:
    once = prepared(Tried())
    assert once == Tried()
    assert type(once) is Tried
    assert prepared(once) == once


def test_nested_methods_are_prepared_too() -> None:
    found = prepared(Guard(RestBias(AdaptiveGain(k_rest=1)), gap=1))
    assert type(found.gap) is float
    assert type(found.method.method.k_rest) is float
    assert type(found.method.method.gain) is Choice
    with pytest.raises(MethodError, match=r"AdaptiveGain\.gain"):
        prepared(Guard(RestBias(AdaptiveGain(gain="cubic"))))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"gain": "3"}, r"Tried\.gain: expected a number \(1/s\), found '3'"),
        ({"gain": None}, r"Tried\.gain: expected a number \(1/s\), found None"),
        ({"gain": float("nan")}, r"Tried\.gain: expected a number \(1/s\), found nan"),
        ({"gain": [1.0, 2.0]}, r"Tried\.gain: expected a number \(1/s\), found \[1"),
        ({"gain": 1j}, r"Tried\.gain: expected a number"),
        ({"gain": -0.1}, r"Tried\.gain: expected 0 to inf 1/s, found -0\.1"),
        ({"offset": 1.01}, r"Tried\.offset: expected -1 to 1 rad, found 1\.01"),
        ({"count": 2.5}, r"Tried\.count: expected a whole number \(samples\), found 2\.5"),
        ({"count": 0}, r"Tried\.count: expected 1 to 100 samples, found 0"),
        ({"count": float("inf")}, r"Tried\.count: expected"),
        ({"mode": "medium"}, r"Tried\.mode: expected one of 'fast', 'slow', found 'medium'"),
        ({"mode": 1}, r"Tried\.mode: expected one of 'fast', 'slow', found 1"),
        ({"strict": "yes"}, r"Tried\.strict: expected True or False, found 'yes'"),
        ({"strict": float("nan")}, r"Tried\.strict: expected True or False, found nan"),
        ({"gain": Vec3(1.0, 2.0, 3.0)}, r"Tried\.gain: expected a number"),
        ({"mode": TwoStage()}, r"Tried\.mode: expected one of"),
    ],
)
def test_wrong_values_are_refused_by_name(change: dict[str, Any], message: str) -> None:
    with pytest.raises(MethodError, match=message) as caught:
        prepared(Tried(**change))
    assert isinstance(caught.value, PoiseError) and isinstance(caught.value, ValueError)


@pytest.mark.parametrize("change", [{"offset": -1.0}, {"offset": 1}, {"gain": 0}, {"count": 1}, {"count": 100}])
def test_the_ends_of_a_range_belong_to_it(change: dict[str, Any]) -> None:
    assert prepared(Tried(**change)) == Tried(**change)


def test_a_class_instead_of_a_method_is_refused() -> None:
    with pytest.raises(MethodError, match=r"TwoStage is a class; give a method: TwoStage\(\)"):
        prepared(TwoStage)


@pytest.mark.parametrize("thing", [None, 3.0, "two-stage", {"gain": 1.0}, (1.0, 2.0), Vec3(1.0, 2.0, 3.0)])
def test_what_is_no_method_is_refused(thing: Any) -> None:
    with pytest.raises(MethodError, match=f"expected a method such as .*, found {type(thing).__name__}"):
        prepared(thing)


@pytest.mark.parametrize("thing", [TwoStage, 5.0, "two-stage", None])
def test_wrappers_refuse_what_is_no_method(thing: Any) -> None:
    with pytest.raises(MethodError, match="method"):
        prepared(Guard(RestBias(thing)))


def test_parameters_say_unit_meaning_default_and_range() -> None:
    gain, offset, count, mode, strict, bare = parameters(Tried)
    assert (gain.name, gain.kind, gain.default, gain.unit, gain.meaning) == (
        "gain",
        float,
        1.0,
        "1/s",
        "how hard it pulls",
    )
    assert (gain.low, gain.high) == (0.0, float("inf"))
    assert (offset.low, offset.high) == (-1.0, 1.0)
    assert count.kind is int
    assert mode.choices == ("fast", "slow")
    assert gain.choices == ()
    assert strict.kind is bool and strict.default is False
    assert (bare.unit, bare.meaning, bare.default) == ("", "", 2.0)


@pytest.mark.parametrize("method", [TwoStage, AdaptiveGain, Guard, RestBias])
def test_every_parameter_of_a_built_in_method_is_explained(method: Any) -> None:
    found = {p.name: p for p in parameters(method)}
    assert tuple(found) == method._fields
    explained = [p for p in found.values() if p.kind is not Any]
    assert all(p.meaning for p in explained)
    assert all(p.low <= p.default <= p.high for p in explained if p.kind is float)
    assert all(p.default in p.choices for p in explained if p.choices)


def test_as_dict_holds_plain_values_by_name_nested_methods_included() -> None:
    found = as_dict(prepared(RestBias(Tried(mode="slow"), rest_time=2)))
    assert found["rest_time"] == 2.0
    assert found["method"] == Tried(mode="slow")._asdict()
    assert type(found["method"]["mode"]) is str
