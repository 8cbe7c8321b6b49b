"""Of what is remembered every device has its share."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from live_helpers import METHOD
from poise.live.happened import Happened, shared
from poise.live.hub import Hub
from poise.live.methods import Choice

DEVICES = st.sampled_from([None, "a", "b", "c", "d"])


@given(st.lists(DEVICES, max_size=60), st.integers(1, 40), st.sampled_from(["note", "tip"]))
def test_shares_are_even_and_the_newest(names: list[str | None], most: int, kind: str) -> None:
    events = [{"device": name, "kind": kind, "number": number} for number, name in enumerate(names)]
    kept = shared(events, most)
    assert len(kept) <= most
    assert [event["number"] for event in kept] == sorted(event["number"] for event in kept)
    if len(events) <= most:
        assert kept == events
    counts = {name: sum(event["device"] == name for event in kept) for name in set(names)}
    for name, count in counts.items():
        own = [event for event in events if event["device"] == name]
        assert [event for event in kept if event["device"] == name] == own[len(own) - count :]
        if count < len(own) and len(counts) <= most:  # something of it was left out: nobody has more than it
            assert count == max(counts.values()) > 0


def test_one_device_does_not_push_out_another() -> None:
    happened = Happened(100)
    happened.add({"device": "robot", "kind": "note", "number": 0})
    for number in range(1, 5000):
        happened.add({"device": "noisy", "kind": "note", "number": number})
    assert happened.all()[0]["device"] == "robot"
    assert happened.newest(50)[0]["device"] == "robot" and len(happened.newest(50)) == 50
    assert len(happened.all()) <= 125
    assert [event["number"] for event in happened.after(4990)] == list(range(4991, 5000))


@given(st.lists(st.tuples(DEVICES, st.sampled_from(["tip", "note"])), max_size=80), st.integers(2, 40))
def test_alarms_have_half_of_the_room(told: list[tuple[str | None, str]], most: int) -> None:
    events = [{"device": name, "kind": kind, "number": number} for number, (name, kind) in enumerate(told)]
    kept = shared(events, most)
    assert len(kept) <= most
    if len(events) <= most:
        assert kept == events
    alarms = [event for event in events if event["kind"] == "tip"]
    left = sum(event["kind"] == "tip" for event in kept)
    assert left == len(alarms) or left > most // 2 - len({event["device"] for event in alarms})


def test_made_up_names_push_out_no_alarm() -> None:
    happened = Happened(100)
    happened.add({"device": "robot", "kind": "tip", "number": 0})
    for number in range(1, 5000):
        happened.add({"device": f"made-up-{number}", "kind": "device", "number": number})
    assert happened.newest(50)[0]["device"] == "robot" and len(happened.newest(50)) == 50


def test_a_hub_remembers_an_alarm_under_a_flood_of_events() -> None:
    hub = Hub((Choice.of(METHOD),))
    hub.event("tip", None, "robot: fallen")
    device = hub.device("noisy")
    for _ in range(3000):
        hub.event("note", device, "again")
    assert "robot: fallen" in [event["text"] for event in hub.happened.newest(50)]
