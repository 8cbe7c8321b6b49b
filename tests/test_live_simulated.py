"""Simulated worlds as devices: the world's own samples, at the clock's pace, without an end."""

from __future__ import annotations

import asyncio
import sys
import time
from importlib.util import find_spec
from math import inf

import numpy as np
import pytest
from numpy.typing import NDArray

from live_helpers import METHOD, serving, wait_for
from poise.cli import run
from poise.live.devices import DeviceError
from poise.live.simulated import Simulated

# not importorskip: importing MuJoCo here would be too early for the choice of a renderer
pytestmark = pytest.mark.skipif(find_spec("mujoco") is None, reason="needs poise[sim]")

Floats = NDArray[np.float64]


def played(source: Simulated, until: float) -> dict[str, Floats]:
    """The rows of every device up to a stamp."""

    async def take() -> dict[str, list[Floats]]:
        found: dict[str, list[Floats]] = {name: [] for name in source.devices}
        async for arrival in source.arrivals():
            found[arrival.device].append(arrival.rows)
            if arrival.rows[-1, 0] >= until:
                break
        return found

    return {name: np.concatenate(rows) for name, rows in asyncio.run(take()).items()}


@pytest.mark.parametrize("name", ["attitude", "arm", "handle"])
def test_a_device_sends_what_the_world_measures(name: str) -> None:
    from poise.simulation import worlds

    found = played(Simulated(name, inf, seed=3), 1.5)
    world = worlds.run(worlds.make(name, seed=3), 1.6)
    assert len(found) == len(world.sensors)
    for sensor, rows in zip(world.sensors, found.values(), strict=True):
        wanted = world.recording(sensor)[: len(rows)]
        assert len(rows) > 250
        np.testing.assert_array_equal(rows[:, :10], np.column_stack([wanted.time, wanted.gyr, wanted.acc, wanted.mag]))
        assert not rows[:, 10:].any()


def test_the_pace_is_the_clocks_and_changes_no_sample() -> None:
    began = time.monotonic()
    slow = played(Simulated("handle", 1.0), 0.4)["handle"]
    assert time.monotonic() - began > 0.35
    fast = played(Simulated("handle", inf), 0.4)["handle"]
    n = min(len(slow), len(fast))
    np.testing.assert_array_equal(slow[:n], fast[:n])
    assert not np.array_equal(played(Simulated("handle", inf, seed=1), 0.4)["handle"][:n], fast[:n])


def test_the_robot_stands_by_its_own_estimate_and_is_set_up_after_a_fall() -> None:
    calm = played(Simulated("balance", inf, push=0.0), 12.0)["balance"]
    up = calm[calm[:, 0] > 3.0, 6].mean()
    assert up > 9.0
    assert np.abs(calm[calm[:, 0] > 3.0, 1:4]).max() > 0.1  # it is let go, and drives about
    falls = played(Simulated("balance", inf, push=150.0), 20.0)["balance"]
    steps = np.diff(falls[:, 0])
    (gap, *_) = np.flatnonzero(steps > 1.0)
    assert 1.9 < steps[gap] < 2.2
    assert abs(falls[gap - 100 : gap, 6].mean()) < 6.0  # it lies
    assert falls[gap + 100 : gap + 300, 6].mean() > 9.0  # it stands again
    assert (steps > 0).all()


def test_two_bands_of_an_arm_are_two_devices_of_the_hub() -> None:
    with serving(Simulated.of("arm?name=left&seed=2", 4.0)) as live:
        wait_for(
            lambda: (
                all(live.hub.latest(d) is not None for d in live.hub.devices.values()) and len(live.hub.devices) == 2
            )
        )
        listed = live.http.get("/devices").json()
        assert [(d["id"], d["shape"], d["source"]) for d in listed] == [
            (name, "band", "sim:arm?name=left&seed=2") for name in ("left-forearm", "left-upper_arm")
        ]
        attitude = wait_for(lambda: (a := live.http.get("/devices/left-forearm/attitude").json())["valid"] and a)
        assert attitude["tilt_deg"] is not None


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("walk", "no world 'walk'; there are balance"),
        ("arm?bumps=1", "arm has no option 'bumps'; there are pace"),
        ("arm?pace=fast", "pace: expected a number"),
        ("arm?pace=90", "pace"),
        ("arm?seed=-1", "seed: expected a whole number"),
        ("arm?sensor=MPU", "MPU"),
        ("arm?push=3", "only balance is pushed"),
        ("balance?push=900", "expected 0 to 200 N"),
        ("balance?rate=100", "200 samples a second"),
        ("arm?pace", "expected OPTION=VALUE"),
        ("arm?seed=1&seed=2", "seed twice"),
    ],
)
def test_what_cannot_be(text: str, said: str) -> None:
    with pytest.raises(DeviceError, match=said):
        Simulated.of(text)


def test_the_command_says_what_is_missing(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["live", "sim:arm", "sim:arm?seed=2", "-m", METHOD, "--port", "0"]) == 2
    assert "forearm: two sources" in capsys.readouterr().err
    assert run(["live", "sim:arm?name=a/b", "-m", METHOD, "--port", "0"]) == 2
    assert "'a/b-forearm': expected 1 to 64 letters" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "mujoco", None)
    assert run(["live", "sim:arm", "-m", METHOD, "--port", "0"]) == 2
    assert 'pip install "poise[sim]"' in capsys.readouterr().err.replace("'", '"')
