"""Joints between live devices: what `relative_to` says of the same rows, and the truth of a simulated elbow."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import poise
from live_helpers import METHOD, ask, heard, made, rows_of, seen, send, serving, wait_for
from poise.cli import run
from poise.data.attitude import Provenance
from poise.live.frames import widened
from poise.live.hub import Hub, HubError
from poise.live.joints import JointError
from poise.live.methods import Choice

Floats = NDArray[np.float64]


class Bench:
    """A hub whose clock a test turns, and everything that it said."""

    def __init__(self, *joints: tuple[str, str, str]) -> None:
        choice = Choice.of(METHOD)
        choice.warm()
        self.hub = Hub((choice,))
        self.hub._last_tick = -1e9
        self.tables: dict[str, list[Any]] = {}
        self.joint: list[Any] = []
        self.hub.on_batch.append(self._note)
        self.hub.joints.on_rows.append(lambda joint, attitude, records: self.joint.append((attitude, records)))
        for joint in joints:
            self.hub.set_joint(*joint)

    def _note(self, batch: Any) -> None:
        for span in batch.spans:
            kept = batch.rows[span.rows, 0].copy(), batch.table[span.out].copy(), batch.flags[span.out].copy()
            self.tables.setdefault(span.device.name, []).append(kept)

    def attitude(self, name: str) -> poise.Attitude:
        time, table, flags = (np.concatenate(each) for each in zip(*self.tables[name], strict=True))
        return poise.Attitude(time, table, flags, provenance=Provenance())

    def found(self) -> tuple[Floats, Floats, NDArray[np.uint32]]:
        """Time, table and flags of the joint."""
        parts = [attitude for attitude, _ in self.joint]
        return (
            np.concatenate([part.time for part in parts]),
            np.concatenate([part.table for part in parts]),
            np.concatenate([part.flags for part in parts]),
        )

    def play(self, devices: dict[str, tuple[Floats, float]], seconds: float, step: float = 0.01) -> None:
        """Rows of each device, at its stamps + an offset; ticks until that time."""
        done = dict.fromkeys(devices, 0)
        for now in np.arange(step, seconds, step):
            for name, (rows, offset) in devices.items():
                stop = int(np.searchsorted(rows[:, 0] + offset, now))
                if stop > done[name]:
                    self.hub.device(name).receive(widened(rows[done[name] : stop]), 1000.0 + now)
                    done[name] = stop
            self.hub.tick(1000.0 + now)


def test_on_one_clock_it_is_relative_to_on_the_same_rows() -> None:
    bench = Bench(("elbow", "fast", "slow"))
    for name in ("fast", "slow"):
        bench.hub.device(name).timebase = "both"
    slow = rows_of(made(6.0, rate=70.0, seed=1))
    slow[:, 0] += 0.003
    bench.play({"fast": (rows_of(made(6.0)), 0.0), "slow": (slow, 0.0)}, 6.2)
    time, table, flags = bench.found()
    wanted = bench.attitude("fast").relative_to(bench.attitude("slow"))
    assert len(time) > 590
    np.testing.assert_array_equal(time, wanted.time[: len(time)])
    np.testing.assert_allclose(table, wanted.table[: len(time)], rtol=0, atol=1e-12)
    np.testing.assert_array_equal(flags, wanted.flags[: len(time)])
    records = np.concatenate([records for _, records in bench.joint])
    np.testing.assert_array_equal(records["quat"], table[:, :4].astype("f4"))
    np.testing.assert_array_equal(records["sequence"], np.arange(len(time)))
    np.testing.assert_array_equal(records["valid"], wanted.valid[: len(time)])
    assert np.isfinite(records["sigma"]).all() == np.isfinite(wanted.sigma).all()


def test_clocks_of_their_own_are_aligned_on_the_hosts() -> None:
    bench = Bench(("elbow", "one", "other"))
    same = rows_of(made(6.0))
    far = same.copy()
    far[:, 0] += 5000.0  # the same motion on a clock that began elsewhere
    bench.play({"one": (same, 0.0), "other": (far, -5000.0)}, 6.2)
    _, table, flags = bench.found()
    good = (flags & np.uint32(poise.Flag.LOST)) == 0
    angles = 2.0 * np.arctan2(np.linalg.norm(table[good, 1:4], axis=1), np.abs(table[good, 0]))
    assert good.sum() > 500
    assert np.degrees(angles.max()) < 0.2


def test_a_base_that_is_absent_silent_or_new_makes_it_unknown() -> None:
    bench = Bench(("elbow", "one", "other"))
    rows = rows_of(made(4.0))
    bench.play({"one": (rows, 0.0), "other": (rows[:200], 0.0)}, 4.0)
    time, _, flags = bench.found()
    lost = (flags & np.uint32(poise.Flag.LOST)) != 0
    assert not lost[time < 1.9].any()
    assert lost[time > 2.01].all()
    assert len(time) >= 385  # all but those of the last 0.1 s
    joint = bench.hub.joints.all["elbow"]
    bench.hub._last_tick = 1003.99
    bench.hub.tick(1004.0)
    bench.hub.tick(1005.0)  # late
    bench.hub.tick(1005.01)
    record = bench.hub.latest(joint)
    assert not record["valid"]
    assert record["flags"] & poise.Flag.SILENT
    assert joint.condition(bench.hub.devices, 1005.0)["state"] == "silent"


def test_memory_is_bounded_while_the_segment_says_nothing() -> None:
    bench = Bench(("elbow", "one", "other"))
    bench.play({"other": (rows_of(made(8.0)), 0.0)}, 8.0)
    assert len(bench.hub.joints.all["elbow"]._before.time) <= 210


def test_what_cannot_be() -> None:
    hub = Hub((Choice.of(METHOD),))
    hub.device("board")
    hub.set_joint("elbow", "forearm", "upper_arm")
    for name, segment, base, said in (
        ("a/b", "x", "y", "1 to 64 letters"),
        ("a", "", "y", "1 to 64 letters"),
        ("a", "x", "x", "two different devices"),
        ("board", "x", "y", "a device of that name"),
        ("a", "elbow", "y", "'elbow' is a joint"),
    ):
        with pytest.raises((HubError, JointError), match=said):
            hub.set_joint(name, segment, base)
    with pytest.raises(HubError, match="a joint of that name"):
        hub.device("elbow")
    with pytest.raises(JointError, match="no joint 'knee'; there are: elbow"):
        hub.remove_joint("knee")
    hub.remove_joint("elbow")
    assert hub.device("elbow").number == 2  # no number twice


def test_over_the_wire(capsys: pytest.CaptureFixture[str]) -> None:
    rows = rows_of(made(2.0))
    with serving() as live, live.viewer(every=True) as viewer, live.device("a") as a, live.device("b") as b:
        assert ask(viewer, type="joint", name="elbow", segment="a", base="b")["type"] == "done"
        assert "two different" in ask(viewer, type="joint", name="knee", segment="a", base="a")["message"]
        listed = heard(viewer, "devices")["devices"]
        while [d["shape"] for d in listed] != ["board", "board", "joint"]:
            listed = heard(viewer, "devices")["devices"]
        number = listed[-1]["number"]
        assert (listed[-1]["segment"], listed[-1]["base"]) == ("a", "b")
        for at in range(0, len(rows), 10):
            send(a, rows[at : at + 10], at)
            send(b, rows[at : at + 10], at)
        found = 0
        while found < 100:
            records = seen(viewer, 1)
            found += int((records["device"] == number).sum())
        attitude = wait_for(lambda: live.http.get("/devices/elbow/attitude").json())
        assert attitude["heading_deg"] is None
        assert "angle_deg" in attitude
        health = live.http.get("/healthz").json()["devices"]
        assert [each["id"] for each in health] == ["a", "b", "elbow"]
        assert live.http.put("/joints/knee", json={"segment": "b", "base": "a"}).json()["shape"] == "joint"
        assert live.http.delete("/joints/knee").status_code == 204
        assert live.http.delete("/joints/knee").status_code == 404
        assert live.http.put("/joints/knee", json=[1]).status_code == 400
        assert ask(viewer, type="remove_joint", name="elbow")["type"] == "done"
        assert [d["id"] for d in live.http.get("/devices").json()] == ["a", "b"]
    for text in ("elbow", "elbow=a", "elbow=a/a", "=a/b", "a/b=c/d"):
        assert run(["live", "--joint", text, "-m", METHOD, "--port", "0"]) == 2
        assert "--joint" in capsys.readouterr().err


def test_a_reader_may_not_add_one() -> None:
    from poise.live.access import parsed_tokens

    with serving(tokens=parsed_tokens(("read:" + "r" * 20,))) as live:
        head = {"Authorization": "Bearer " + "r" * 20}
        assert live.http.put("/joints/elbow", json={"segment": "a", "base": "b"}, headers=head).status_code == 401
        with live.viewer(additional_headers=head) as viewer:
            assert "write" in ask(viewer, type="joint", name="elbow", segment="a", base="b")["message"]


@pytest.mark.skipif(find_spec("mujoco") is None, reason="needs poise[sim]")
def test_the_elbow_of_the_simulated_arm_is_the_truths() -> None:
    from poise.live.simulated import Simulated
    from poise.simulation import worlds

    source = Simulated("arm", 4.0, seed=4)
    with serving(source) as live:
        live.call(lambda: live.hub.set_joint("elbow", "forearm", "upper_arm"))
        found: list[Any] = []
        live.call(lambda: live.hub.joints.on_rows.append(lambda joint, attitude, records: found.append(attitude)))
        wait_for(lambda: found and found[-1].time[-1] > 20.0, 60.0)
    quat, time = np.concatenate([a.quat for a in found]), np.concatenate([a.time for a in found])
    valid = np.concatenate([a.valid for a in found])
    world = worlds.run(worlds.make("arm", seed=4), 22.0)
    forearm, upper = (world.recording(name).truth for name in ("forearm", "upper_arm"))
    assert forearm is not None
    assert upper is not None
    truth = forearm.relative_to(upper).resample(time)
    used = valid & (time > 5.0) & (time < 20.0) & np.isfinite(truth.quat[:, 0])
    error = (
        Rotation.from_quat(truth.quat[used], scalar_first=True).inv()
        * Rotation.from_quat(quat[used], scalar_first=True)
    ).magnitude()
    turned = Rotation.from_quat(truth.quat[used], scalar_first=True).magnitude()
    assert used.sum() > 2500
    assert np.degrees(np.ptp(turned)) > 40.0  # the elbow moves
    rms = float(np.degrees(np.sqrt(np.mean(error**2))))
    print(f"elbow: {rms:.2f}° RMS while it turns by {np.degrees(np.ptp(turned)):.0f}°")
    assert rms < 4.0
