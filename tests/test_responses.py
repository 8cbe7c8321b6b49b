"""Responses to a tipping robot: which stage fires, repeats, holds and ends when, and what a configuration may say."""

from __future__ import annotations

from math import nan
from pathlib import Path
from typing import Any

import pytest

from poise.data.event import TipEvent, TipState
from poise.errors import PoiseError, ResponseError
from poise.responses import Alarm, Stage, Staging, config_of, load_config
from poise.responses.alarm import now_utc

S = TipState


def event(state: TipState, before: TipState = S.UPRIGHT, **more: Any) -> TipEvent:
    return TipEvent(1.0, state, before, **more)


def stage(*states: TipState, **more: Any) -> Stage:
    return Stage(**{"name": "a", "states": frozenset(states), "fire": ("horn",)} | more)


class Played:
    """A staging whose clock the test sets."""

    def __init__(self, *stages: Stage, **more: Any) -> None:
        self.staging = Staging(stages=stages, **more)

    def at(self, now: float, state: TipState | None = None) -> list[str]:
        steps = self.staging.due(now) if state is None else self.staging.handle(event(state), now)
        return [f"{step.what} {step.stage.name} {step.count}" for step in steps]

    def acknowledge(self) -> list[str]:
        return [f"{step.what} {step.stage.name}" for step in self.staging.acknowledge()]


def test_a_state_fires_its_stage_once_each_time_it_comes() -> None:
    play = Played(stage(S.TIPPING))
    assert play.at(0.0, S.UPRIGHT) == []
    assert play.at(1.0, S.TIPPING) == ["fired a 1"]
    assert play.at(1.1, S.TIPPING) == [] and play.at(99.0) == []
    assert play.at(100.0, S.LEANING) == [] and play.at(101.0, S.TIPPING) == ["fired a 1"]


def test_repeated_until_acknowledged() -> None:
    play = Played(stage(S.TIPPING, repeat=2.0))
    assert play.at(0.0, S.TIPPING) == ["fired a 1"]
    assert play.staging.next_due() == 2.0
    assert play.at(1.9) == [] and play.at(2.0) == ["fired a 2"]
    assert play.at(9.0, S.UPRIGHT) == ["fired a 3"]  # latched: it stands, and nobody has said that he saw it
    assert play.at(10.0) == [] and play.at(11.0) == ["fired a 4"]
    assert play.acknowledge() == ["released a"] and play.at(99.0) == [] and play.staging.active() == ()


def test_an_alarm_that_is_acknowledged_too_early_holds_until_the_robot_stands() -> None:
    play = Played(stage(S.TIPPING))
    play.at(0.0, S.TIPPING)
    assert play.acknowledge() == [] and play.staging.active() == ("a",)
    for state in (S.FALLEN, S.PICKED_UP, S.UNKNOWN, S.LEANING):
        assert play.at(1.0, state) == []
    assert play.at(2.0, S.RIGHTED) == ["released a 1"]


def test_only_what_a_person_has_to_see_waits_for_one() -> None:
    play = Played(stage(S.TIPPING), stage(S.LEANING, S.TIPPING, name="b", latched=False), at_start=("horn",))
    play.staging.begin(0.0)
    assert play.staging.active() == ("start",) and play.staging.unacknowledged() == ()
    play.at(1.0, S.TIPPING)
    assert play.staging.active() == ("a", "b", "start") and play.staging.unacknowledged() == ("a",)
    play.at(2.0, S.UPRIGHT)
    assert play.staging.active() == play.staging.unacknowledged() == ("a",)
    play.acknowledge()
    assert play.staging.active() == play.staging.unacknowledged() == ()
    play.at(3.0, S.TIPPING)
    play.acknowledge()
    assert play.staging.active() == ("a", "b") and play.staging.unacknowledged() == ()


@pytest.mark.parametrize("state", [S.UPRIGHT, S.RIGHTED, S.UNKNOWN])
def test_what_ends_by_itself_though_latched_waits_for_nobody(state: TipState) -> None:
    play = Played(stage(state))
    assert play.at(0.0, state) == ["fired a 1"]
    assert play.staging.active() == ("a",) and play.staging.unacknowledged() == ()


def test_fired_again_it_must_be_acknowledged_again() -> None:
    play = Played(stage(S.TIPPING))
    play.at(0.0, S.TIPPING)
    play.acknowledge()
    play.at(1.0, S.LEANING)
    assert play.at(2.0, S.TIPPING) == ["fired a 1"]
    assert play.at(3.0, S.UPRIGHT) == [] and play.staging.active() == ("a",)


def test_not_latched_it_ends_when_the_robot_is_upright_and_not_before() -> None:
    play = Played(stage(S.PICKED_UP, latched=False, repeat=1.0))
    assert play.at(0.0, S.PICKED_UP) == ["fired a 1"] and play.at(1.0) == ["fired a 2"]
    assert play.at(1.5, S.TIPPING) == [] and play.at(5.0) == []  # no repetition of what is no more
    assert play.at(6.0, S.UNKNOWN) == [] and play.at(7.0, S.RIGHTED) == []
    assert play.at(8.0, S.UPRIGHT) == ["released a 2"]


def test_a_state_must_last() -> None:
    play = Played(stage(S.LEANING, S.TIPPING, after=0.5))
    assert play.at(0.0, S.LEANING) == [] and play.at(0.3, S.UPRIGHT) == [] and play.at(1.0) == []
    assert (
        play.at(2.0, S.LEANING) == [] and play.at(2.4, S.TIPPING) == []
    )  # from one of its states to another: it lasts
    assert play.at(2.45, S.UNKNOWN) == []  # losing the attitude calls nothing off
    assert play.at(2.5) == ["fired a 1"]


@pytest.mark.parametrize(("policy", "fired"), [("ignore", []), ("warn", ["unknown"]), ("as tipping", ["a"])])
def test_what_unknown_means(policy: Any, fired: list[str]) -> None:
    play = Played(stage(S.TIPPING), stage(S.FALLEN, name="b"), unknown=policy, warned=("horn",))
    assert play.at(0.0, S.UNKNOWN) == [f"fired {name} 1" for name in fired]
    assert list(play.staging.active()) == fired
    after = play.at(1.0, S.UPRIGHT)
    assert after == (["released unknown 1"] if policy == "warn" else [])
    assert play.staging.active() == (("a",) if policy == "as tipping" else ())  # a power cut holds until acknowledged


def test_a_short_loss_of_the_attitude_may_be_waited_out() -> None:
    play = Played(stage(S.TIPPING), unknown="as tipping", unknown_after=0.2)
    assert play.at(0.0, S.UNKNOWN) == [] and play.at(0.1, S.UPRIGHT) == [] and play.at(9.0) == []
    assert play.at(10.0, S.UNKNOWN) == [] and play.at(10.2) == ["fired a 1"]
    assert Played(stage(S.TIPPING), unknown="as tipping", unknown_after=0.2).at(0.0, S.TIPPING) == ["fired a 1"]


def test_good_news_ends_without_an_all_clear() -> None:
    play = Played(stage(S.RIGHTED))
    assert play.at(0.0, S.RIGHTED) == ["fired a 1"] and play.at(1.0, S.UPRIGHT) == [] and play.staging.active() == ()


def test_an_alarm_in_words_leaves_out_what_is_not_known() -> None:
    bare = Alarm("fired", event(S.FREE_FALL), now_utc(), robot="R7")
    assert bare.sentence() == "R7: free fall" and bare.as_dict()["tilt_deg"] is None and "NaN" not in bare.as_json()
    full = event(S.TIPPING, direction="left", tilt=0.5, rate=2.0, time_to_impact=0.31, reason="as it is")
    assert Alarm("fired", full, now_utc()).sentence() == (
        "tipping left, tilt 29°, +115 °/s, impact in 0.31 s (as it is)"
    )
    assert Alarm("fired", event(S.FALLEN, tilt=nan, rate=float("inf")), now_utc()).sentence() == "fallen"


GOOD = """
[responders.power]
type = "relay"
pin = 17
active_high = false
[responders.horn]
type = "voice"
[[stages]]
state = "tipping"
fire = ["power", "horn"]
"""


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('"relay"', '"realy"', "did you mean 'relay'?"),
        ('"relay"', '"laser"', "expected one of 'relay', 'command', 'voice', 'mqtt', 'webhook', 'log'"),
        ("pin = 17", "pinn = 17", "did you mean 'pin'?"),
        ("pin = 17", "", "responders.power.pin: is missing"),
        ("pin = 17", "pin = 1.5", "responders.power.pin: expected a whole number or a text, found 1.5"),
        ("active_high = false", "", "true where a high pin cuts the power"),
        ("active_high = false", 'active_high = "low"', "expected true or false, found 'low'"),
        ("pin = 17", 'pin = 17\nfail_safe = "cutt"', "did you mean 'cut'?"),
        ("pin = 17", 'pin = 17\nif_failed = ["hron"]', "did you mean 'horn'?"),
        ("pin = 17", 'pin = 17\nif_failed = ["power"]', "responders.power.if_failed: 'power' is itself"),
        ("pin = 17", "pin = 17\ntimeout = -1", "responders.power.timeout: expected seconds above 0"),
        ("pin = 17", "pin = 17\ntimeout = nan", "expected a number, found nan"),
        ('"voice"', '"voice"\nlanguage = "xx"', "texts of our own are in en and zh, not in 'xx'"),
        ('"voice"', '"voice"\nvolume = 0', "nobody hears it"),
        ('"voice"', '"voice"\ntext = {tiping = "ho"}', "did you mean 'tipping'?"),
        ('"voice"', '"voice"\ntext = {tipping = " "}', "a silent alarm is none"),
        ('"voice"', '"voice"\ntext = {tipping = "{where}"}', "expected words with {direction}"),
        ('"tipping"', '"tiping"', "did you mean 'tipping'?"),
        ('"tipping"', '"unknown"', 'unknown = "warn" at the top'),
        ('"tipping"', '["tipping", "upright"]', "power would cut the power of a robot that stands upright"),
        ('"tipping"', "[]", 'expected state = "tipping"'),
        ('["power", "horn"]', '["power"]', "responders.horn: no stage fires it"),
        ('["power", "horn"]', '["power", "horn", "hrn"]', "did you mean 'horn'?"),
        ('["power", "horn"]', '["power", "horn"]\nrepeat = -1', "stages, number 1.repeat: expected seconds"),
        ("[[stages]]", "[[stage]]", "did you mean 'stages'?"),
        ("\n[responders.power]", 'unknown = "as tiping"\n[responders.power]', "did you mean 'as tipping'?"),
        ('"tipping"', '"fallen"\nlatched = 1', "latched: expected true or false"),
        ("[[stages]]", "[tipovr]\n[[stages]]", "did you mean 'tipover'?"),
        ("pin = 17", "pin = ", "is no TOML"),
    ],
)
def test_a_wrong_configuration_is_refused_with_what_to_change(tmp_path: Path, old: str, new: str, says: str) -> None:
    (tmp_path / "good.toml").write_text(GOOD)
    assert [r.name for r in load_config(tmp_path / "good.toml").responders] == ["power", "horn", "logging"]
    assert old in GOOD
    path = tmp_path / "robot.toml"
    path.write_text(GOOD.replace(old, new, 1))
    with pytest.raises(ResponseError) as refused:
        load_config(path)
    assert says in str(refused.value) and str(refused.value).startswith(str(path))


def test_no_file_and_no_text(tmp_path: Path) -> None:
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    for path in (tmp_path / "absent.toml", tmp_path, tmp_path / "binary.toml"):
        with pytest.raises(PoiseError, match=path.name):
            load_config(path)


def test_the_monitors_table_is_passed_on() -> None:
    log = {"responders": {"log": {"type": "log"}}, "stages": [{"state": "free-fall", "fire": ["log"]}]}
    config = config_of({**log, "tipover": {"forward": 20.0}})
    assert config.tipover == {"forward": 20.0} and config.stages[0].states == {S.FREE_FALL}
