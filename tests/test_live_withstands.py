"""What one device, one source or one wrong word must not do to a server, or to the safety of a robot."""

from __future__ import annotations

import json
import socket
import time
from collections.abc import Callable, Iterator
from math import inf, nan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from websockets.exceptions import InvalidStatus

import poise
from live_helpers import METHOD, Running, ask, heard, made, rows_of, seen, send, serving, wait_for
from poise.data.event import TipState
from poise.errors import PoiseError
from poise.live import frames
from poise.live.access import parsed_tokens
from poise.live.clock import Standstill
from poise.live.devices import Arrival
from poise.live.feeding import Feeding
from poise.live.film import Strip, of_recording
from poise.live.hub import Hub
from poise.live.methods import Choice
from poise.live.recorder import Recorder
from poise.live.session import Session
from poise.live.udp import Udp
from poise.live.watching import Watch
from poise.responses import Responses, config_of
from programs import mock_board

Floats = NDArray[np.float64]
ALL, READ = "all-the-scopes-of-it", "may-only-read-of-it"


@pytest.fixture(scope="module")
def live() -> Iterator[Running]:
    with serving() as running:
        yield running


def upright(seconds: float, rate: float = 100.0, start: float = 0.0) -> Floats:
    """(n, 10) rows of a body that stands, with a little noise."""
    n = int(seconds * rate)
    noise = np.random.default_rng(1).normal(0.0, 1e-3, (n, 6))
    still = np.tile([0.0, 0.0, 0.0, 0.0, 0.0, 9.81], (n, 1)) + noise
    return np.column_stack([start + np.arange(n) / rate, still, np.full((n, 3), nan)])


def told(live: Running, kind: str, device: str | None = None) -> list[str]:
    """The sentences of the events of one kind."""
    events = live.hub.happened.all()
    return [event["text"] for event in events if event["kind"] == kind and device in (None, event["device"])]


def condition(live: Running, name: str) -> dict[str, Any]:
    return next(each for each in live.http.get("/healthz").json()["devices"] if each["id"] == name)


def number(live: Running, name: str) -> int:
    """Of the sample of its newest attitude; -1 before the first."""
    record = live.hub.latest(live.hub.find(name))
    return -1 if record is None else int(record["sequence"])


def goes_on(live: Running, name: str) -> None:
    """Another device is still served."""
    with live.device(name) as device:
        send(device, upright(0.3))
        wait_for(lambda: live.http.get(f"/devices/{name}/attitude").status_code == 200)


# -- stamps and numbers ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("stamp", [nan, inf, -inf])
def test_a_stamp_that_is_no_number_and_then_silence(live: Running, stamp: float) -> None:
    name, rows = f"stamp{stamp}".replace("-", "m"), upright(0.3)
    rows[-1, 0] = stamp
    with live.device(name) as device:
        send(device, rows, size=1)
        wait_for(lambda: told(live, "silent", name))
        assert condition(live, name)["state"] == "silent"
        assert not live.http.get(f"/devices/{name}/attitude").json()["valid"]
        send(device, upright(0.3, start=0.5), first=30)
        wait_for(lambda: told(live, "back", name))
    goes_on(live, f"beside{name}")


def test_a_datagram_whose_only_stamp_is_no_number() -> None:
    with serving(Udp("127.0.0.1", 0)) as live, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        source: Any = live.server.feeding.sources[0]
        wait_for(lambda: source.port)
        sender.sendto(b"@x\nnan,0,0,0,0,0,9.81", ("127.0.0.1", source.port))
        wait_for(lambda: told(live, "silent", "x"))
        goes_on(live, "beside")


@pytest.mark.parametrize(
    ("frame", "says"),
    [
        (frames.encoded(upright(0.05), 2**64 - 3), "sequence"),
        ('{"time": 1, "gyr": [0, 0, 0], "acc": [0, 0, 9.81], "sequence": 18446744073709551613}', "sequence"),
        ('{"time": 1e308, "gyr": [0, 0, 0], "acc": [0, 0, 9.81]}', "time"),
        ('{"time": -1e308, "gyr": [0, 0, 0], "acc": [0, 0, 9.81]}', "time"),
        (frames.encoded(upright(0.05, start=-1e13)), "time"),
    ],
)
def test_a_number_that_nothing_can_have_got_to_is_an_error(live: Running, frame: bytes | str, says: str) -> None:
    with live.device("far") as device:
        device.send(frame)
        assert says in heard(device, "error")["message"]
        before = live.hub.find("far").health.samples
        send(device, upright(0.3), first=live.hub.find("far").next)
        wait_for(lambda: live.hub.find("far").health.samples == before + 30)
    goes_on(live, "beside-far")


def test_the_largest_number_that_is_taken_can_be_counted_on_from(live: Running) -> None:
    with live.device("large") as device, live.viewer(every=True) as viewer:
        send(device, upright(0.3), first=frames.MOST_NUMBER, size=30)
        send(device, upright(0.3, start=0.3), first=frames.UNNUMBERED, size=30)
        found = seen(viewer, 60)["sequence"]
    assert found.tolist() == [frames.MOST_NUMBER + k for k in range(60)]


# -- faults of ours -------------------------------------------------------------------------------------------------


class Fault(RuntimeError):
    """Not one of ours: what nobody has thought of."""


def failing(*_: Any, **__: Any) -> Any:
    raise Fault("a method's own")


def configured(folder: Path, **more: Any) -> Responses:
    """Responses that only keep a log."""
    path = folder / "robot.toml"
    head = "".join(f"{key} = {json.dumps(value)}\n" for key, value in more.items())
    path.write_text(
        head + f'[responders.note]\ntype = "log"\nfile = "{folder / "said.log"}"\n'
        '[[stages]]\nname = "stop"\nstate = "tipping"\nfire = ["note"]\n'
    )
    return Responses.from_toml(path)


def logged(folder: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in (folder / "said.log").read_text().splitlines()]


def test_a_method_that_raises_ends_the_run_of_its_device_alone(tmp_path: Path) -> None:
    watch = Watch(responses={"robot": configured(tmp_path, unknown="as tipping")})
    with serving(watch=watch) as live, live.device("robot") as robot, live.device("other") as other:
        send(robot, upright(0.5), size=5)
        send(other, upright(0.5), size=5)
        wait_for(lambda: live.hub.find("robot").tip == TipState.UPRIGHT)
        live.call(lambda: setattr(live.hub.find("robot").runs[0].stream, "update_rows", failing))
        rows = upright(2.0, start=0.5)
        for at in range(0, 100, 5):
            send(robot, rows[at : at + 5], first=50 + at)
            send(other, rows[at : at + 5], first=50 + at)
            if told(live, "failed", "robot"):
                break
            time.sleep(0.02)
        assert "Fault: a method's own" in wait_for(lambda: told(live, "failed", "robot"))[0]
        robot.send(frames.encoded(rows[100:101], 150))
        assert "Fault: a method's own" in heard(robot, "error")["message"]
        answer = live.http.get("/healthz")
        assert answer.status_code == 503
        assert any("robot: its run has ended" in reason for reason in answer.json()["reasons"])
        assert condition(live, "robot")["state"] == "failed"
        record = live.http.get("/devices/robot/attitude").json()
        assert not record["valid"]
        assert live.hub.find("robot").tip == TipState.UNKNOWN
        assert "stop" in watch.responses["robot"].active  # as its `unknown` asks
        before = live.hub.find("other").next
        send(other, rows[100:150], first=before, size=5)
        wait_for(lambda: number(live, "other") == before + 49)
        assert live.hub.find("other").health.lost == 0
        # its methods chosen anew, it begins anew
        assert live.http.put("/devices/robot/methods", json=[{"name": METHOD}]).status_code == 200
        with live.device("robot") as again:
            send(again, upright(0.5, start=9.0), first=live.hub.find("robot").next, size=5)
            wait_for(lambda: live.hub.find("robot").tip == TipState.UPRIGHT)
        assert condition(live, "robot")["failed"] is None
    assert [each["reason"] for each in logged(tmp_path) if each["state"] == "unknown" and "Fault" in each["reason"]]


@pytest.mark.parametrize("where", ["clock.update", "monitor.update", "monitor.check", "take"])
def test_whatever_raises_for_one_device_is_its_own(where: str) -> None:
    with serving(watch=Watch()) as live, live.device("robot") as robot, live.device("other") as other:
        send(robot, upright(0.5), size=5)
        send(other, upright(0.5), size=5)
        wait_for(lambda: live.hub.find("robot").tip == TipState.UPRIGHT)
        *path, name = where.split(".")

        def spoil() -> None:
            target: Any = live.hub.find("robot")
            for each in path:
                target = getattr(target, each)
            setattr(target, name, failing)

        live.call(spoil)
        if where != "monitor.check":  # which silence calls
            robot.send(frames.encoded(upright(0.01, start=0.5), 50))
        wait_for(lambda: told(live, "failed", "robot"))
        assert live.hub.find("robot").tip == TipState.UNKNOWN
        send(other, upright(0.5, start=0.6), first=50, size=5)
        wait_for(lambda: number(live, "other") == 99)


def test_a_fault_before_any_stamp_is_told_with_one_that_is_a_number() -> None:
    with serving(watch=Watch()) as live, live.device("robot") as robot:
        wait_for(lambda: any(device.name == "robot" for device in live.hub.devices.values()))
        live.call(lambda: setattr(live.hub.find("robot").clock, "update", failing))
        send(robot, upright(0.1), size=5)
        wait_for(lambda: told(live, "failed", "robot"))
        json.dumps(live.hub.happened.all(), allow_nan=False)
        assert told(live, "tip", "robot")


def test_what_came_before_a_fault_is_recorded(tmp_path: Path) -> None:
    recorder = Recorder(Session.below(tmp_path))
    with serving(recorder=recorder) as live, live.device("robot") as robot, live.device("other") as other:
        send(robot, upright(0.5), size=5)
        send(other, upright(0.5), size=5)
        wait_for(lambda: number(live, "robot") == number(live, "other") == 49)
        live.call(lambda: setattr(live.hub.find("robot").runs[0].stream, "update_rows", failing))
        live.call(lambda: setattr(live.hub.find("robot").runs[0].stream, "save", failing))
        send(robot, upright(0.5, start=0.5), first=50, size=5)
        wait_for(lambda: told(live, "failed", "robot"))
        live.call(lambda: recorder.checkpoint(live.hub.find("robot")))  # as at the end of a journal file
        send(other, upright(0.5, start=0.5), first=50, size=5)
        wait_for(lambda: number(live, "other") == 99)
        assert live.http.put("/devices/robot/methods", json=[{"name": METHOD}]).status_code == 200
        first = live.hub.find("robot").next
        with live.device("robot") as again:
            send(again, upright(0.5, start=1.0), first=first, size=5)
            wait_for(lambda: number(live, "robot") == first + 49)
    other, robot = (len(poise.read(recorder.session.folder / f"{name}.parquet")) for name in ("other", "robot"))
    assert other == 100
    assert 100 <= robot < 150


def test_what_cannot_be_shown_of_one_device_is_shown_of_the_others() -> None:
    with serving() as live, live.device("odd") as odd, live.device("even") as even:
        send(odd, upright(0.5), size=5)
        wait_for(lambda: live.hub.devices.get("odd") and live.hub.find("odd").runs)
        live.call(lambda: setattr(live.hub.find("odd"), "tip", 1 << 80))  # fits in no record
        for at in range(0, 50, 5):
            odd.send(frames.encoded(upright(0.05, start=0.5 + at / 100), 50 + at))
            even.send(frames.encoded(upright(0.05, start=at / 100), at))
        wait_for(lambda: told(live, "failed", "odd"))
        wait_for(lambda: number(live, "even") == 49)
        assert live.hub.find("even").failed == ""


def test_a_joint_that_raises_is_no_more_and_its_devices_go_on() -> None:
    with serving() as live, live.device("arm") as arm, live.device("base") as base:
        live.call(lambda: live.hub.set_joint("elbow", "arm", "base"))
        live.call(lambda: setattr(live.hub.joints.all["elbow"], "advance", failing))
        for at in range(0, 50, 5):
            for device in (arm, base):
                device.send(frames.encoded(upright(0.05, start=at / 100), at))
        wait_for(lambda: any("elbow has failed" in text for text in told(live, "failed")))
        wait_for(lambda: number(live, "arm") == 49)


def test_a_source_that_raises_is_told_and_the_others_go_on() -> None:
    class Odd:
        name, shape = "odd", "board"

        async def arrivals(self) -> Any:
            yield Arrival("x", np.zeros((1, 12)))
            raise Fault("a source's own")

    with serving(Odd()) as live:
        wait_for(lambda: told(live, "failed"))
        assert live.http.get("/healthz").status_code == 503
        goes_on(live, "beside")


# -- a clock that stands still --------------------------------------------------------------------------------------


def test_a_fall_while_the_clock_stands_still_is_not_called_upright() -> None:
    with serving(watch=Watch()) as live, live.device("robot") as robot:
        rows = upright(1.0)
        for at in range(100):
            robot.send(frames.encoded(rows[at : at + 1], at))
            time.sleep(0.01)
        assert live.hub.find("robot").tip == TipState.UPRIGHT
        stood, took, seen_standing = time.monotonic(), inf, False
        for at in range(200):
            lean = min(0.03 * at, 1.5)
            fall = [rows[-1, 0], -3.0, 0, 0, 0, -9.81 * np.sin(lean), 9.81 * np.cos(lean), nan, nan, nan]
            robot.send(frames.encoded(np.array([fall]), 100 + at))
            time.sleep(0.01)
            record, health = live.call(
                lambda: (live.hub.latest(live.hub.find("robot")).copy(), live.hub.find("robot").condition())
            )
            if record["tip"] == TipState.UNKNOWN and told(live, "clock", "robot"):
                took = min(took, time.monotonic() - stood)
            if health["state"] == "standing":  # samples come, and no time: not silent
                seen_standing = True
                assert not record["valid"]
                assert record["flags"] & int(poise.Flag.SILENT)
            if at > 50 and seen_standing:
                break
        assert seen_standing
        assert took < 0.3  # 50 ms, and what two busy cores add
        answer = live.http.get("/healthz").json()
        assert any("clock stands still" in reason for reason in answer["reasons"])
        flags: list[str] = []
        for at in range(50):
            robot.send(frames.encoded(upright(0.01, start=2.0 + at / 100), 300 + at))
            time.sleep(0.01)
            flags = live.http.get("/devices/robot/attitude").json()["flags"]
        assert "SILENT" not in flags
        assert told(live, "clock", "robot")[-1].endswith("its clock goes on")


@pytest.mark.parametrize("size", [10, 25])
def test_packets_that_share_a_stamp_are_no_standstill(size: int) -> None:
    rows = upright(3.0)
    rows[:, 0] = rows[size - 1 :: size, 0].repeat(size)  # that of the packet's last
    with serving(watch=Watch()) as live, live.device("robot") as robot:
        for at in range(0, 300, size):
            robot.send(frames.encoded(rows[at : at + size], at))
            time.sleep(size / 100)
        assert not told(live, "clock", "robot")
        assert any("upright" in text for text in told(live, "tip", "robot"))
        unknown = [text for text in told(live, "tip", "robot") if "unknown" in text]
        assert all("no attitude for" in text for text in unknown)  # a busy machine may be late, that is all


def walked(stamps: Floats, arrivals: Floats) -> NDArray[np.bool_]:
    """Whether it stands after each of *stamps*, which arrive one by one."""
    clock, found = Standstill(), []
    for stamp, arrived in zip(stamps, arrivals, strict=True):
        clock.see(np.array([stamp]), float(stamp), float(arrived))
        found.append(clock.standing)
    return np.array(found)


def test_how_long_a_clock_may_stand() -> None:
    host = np.arange(400) * 0.01
    assert not walked(host, host).any()
    assert not walked(host - 50.0, host).any()
    stands = walked(np.minimum(host, 2.0), host)
    assert np.argmax(stands) == 205  # 50 ms
    assert stands[205:].all()
    coarse = walked(np.floor(host * 10.0) / 10.0, host)
    assert not coarse[10:].any()  # as long as is usual for it, three times over
    assert walked(np.floor(host), host)[150:200].any()  # a whole second without time is too long whatever is usual
    lost = host.copy()
    lost[100:140:3] = nan
    assert not walked(lost, host).any()
    assert walked(np.full(400, nan), host)[5:].all()
    set_back = np.where(host < 2.0, host, host - 1000.0)
    assert not walked(set_back, host).any()


# -- silence on a busy server ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("took", [0.04, 0.09])
def test_silence_is_told_in_time_though_every_tick_is_late(took: float) -> None:
    with serving() as live, live.device("robot") as robot, live.device("other") as other:
        live.call(lambda: live.hub.on_batch.append(lambda batch: time.sleep(took)))
        rows, told_at = upright(4.0), 0.0
        live.call(
            lambda: live.hub.on_event.append(lambda event: at.append(time.monotonic()) if silent(event) else None)
        )
        at: list[float] = []

        def silent(event: dict[str, Any]) -> bool:
            return event["kind"] == "silent" and event["device"] == "robot"

        stopped = 0.0
        for k in range(400):
            other.send(frames.encoded(rows[k : k + 1], k))
            if k < 150:
                robot.send(frames.encoded(rows[k : k + 1], k))
                stopped = time.monotonic()
            time.sleep(0.01)
            if k == 140:
                assert not at  # it was not taken for silent before
                reasons = live.http.get("/healthz").json()["reasons"]
                assert any(reason.startswith("overloaded") for reason in reasons)
            if at:
                break
        told_at = at[0] - stopped
        assert told_at < 0.3 + took  # 0.2 s, and what two busy cores add
        live.call(live.hub.on_batch.pop)
        wait_for(lambda: not any(r.startswith("overloaded") for r in live.http.get("/healthz").json()["reasons"]))
        assert not told(live, "silent", "other") or told(live, "overloaded")


# -- responses ------------------------------------------------------------------------------------------------------


@pytest.fixture
def board(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The pins of a mock board."""
    yield from mock_board(monkeypatch)


def guarded(folder: Path, **more: Any) -> Watch:
    """The robot of docs/protect-your-robot.md."""
    power = {"type": "relay", "pin": 17, "active_high": True}
    log = {"type": "log", "file": str(folder / "said.log")}
    stage = {"name": "tips over", "state": ["tipping", "fallen", "free fall"], "fire": ["power", "log"]}
    table = {"responders": {"power": power, "log": log}, "stages": [stage], **more}
    return Watch(responses={"robot": Responses(config_of(table))})


def lying(seconds: float, start: float = 0.0) -> Floats:
    rows = upright(seconds, start=start)
    rows[:, 4:7] = rows[:, 4:7] @ np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
    return rows


def paced(device: Any, rows: Floats, first: int = 0) -> None:
    for at in range(0, len(rows), 5):
        device.send(frames.encoded(rows[at : at + 5], first + at))
        time.sleep(0.05)


def test_the_power_stays_off_while_the_robot_lies_and_comes_back_once_acknowledged(tmp_path: Path, board: Any) -> None:
    with serving(watch=guarded(tmp_path), tokens=parsed_tokens((ALL, f"read:{READ}"))) as live:
        head = {"Authorization": f"Bearer {ALL}"}
        with live.device("robot", additional_headers=head) as robot:
            assert board.pin(17).state  # nothing is known yet
            paced(robot, lying(1.0))
            wait_for(lambda: live.hub.find("robot").tip == TipState.FALLEN)
            assert board.pin(17).state  # and it was so all the time
            assert all(each.state for each in board.pin(17).states[1:])
            where = "/devices/robot/acknowledge"
            assert live.http.post(where, headers={"Authorization": f"Bearer {READ}"}).status_code == 401
            answer = live.http.post(where, headers=head)
            assert answer.json() == {"device": "robot", "holding": ["tips over", "start"]}
            assert board.pin(17).state  # it lies
            paced(robot, upright(4.0, start=2.0), first=100)
            wait_for(lambda: not board.pin(17).state)
            assert told(live, "acknowledged", "robot")
        assert live.http.post("/devices/nobody/acknowledge", headers=head).status_code == 404
        with live.viewer(additional_headers=head) as viewer:
            assert ask(viewer, type="acknowledge", device="robot")["type"] == "done"
            assert "there are: robot" in ask(viewer, type="acknowledge", device="nobody")["message"]
        with live.viewer(additional_headers={"Authorization": f"Bearer {READ}"}) as viewer:
            assert "scope 'write'" in ask(viewer, type="acknowledge", device="robot")["message"]
    kinds = [each["kind"] for each in logged(tmp_path)]
    assert kinds.count("acknowledged") >= 1
    assert "released" in kinds


def test_a_robot_that_never_sends_is_as_its_policy_asks(
    tmp_path: Path, board: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("poise.responses.staging._PATIENCE", 0.3)
    monkeypatch.setattr("poise.live.missing._PATIENCE", 0.3)
    with serving(watch=guarded(tmp_path, unknown="as tipping")) as live:
        assert board.pin(17).state
        wait_for(lambda: any(each["kind"] == "fired" for each in logged(tmp_path)))
        wait_for(lambda: told(live, "missing"))
        assert live.http.post("/devices/robot/acknowledge").json()["holding"]
        assert board.pin(17).state


# -- names ----------------------------------------------------------------------------------------------------------


def test_a_wrong_name_of_a_device_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("poise.live.missing._PATIENCE", 0.5)
    watch = Watch(responses={"Robot": configured(tmp_path)})
    with serving(watch=watch) as live, live.device("robot") as robot:
        live.call(lambda: live.hub.set_joint("elbow", "robot", "bases"))
        send(robot, upright(0.3))
        texts = wait_for(lambda: (found := told(live, "missing")) and len(found) == 2 and found)
        assert "--respond Robot: no such device so far; there are: robot" in texts
        assert "joint elbow, bases: no such device so far; there are: robot" in texts
        answer = live.http.get("/healthz")
        assert answer.status_code == 503
        assert set(texts) <= set(answer.json()["reasons"])
        with live.device("Robot") as named, live.device("bases") as base:
            send(named, upright(0.3))
            send(base, upright(0.3))
            wait_for(lambda: not any("such device" in r for r in live.http.get("/healthz").json()["reasons"]))
        time.sleep(1.2)
        assert len(told(live, "missing")) == 2  # once each


def test_what_a_source_may_not_send_is_told_once_a_name_and_reason() -> None:
    class Odd:
        name, shape = "odd", "board"

    feeding, source = Feeding(hub := Hub((Choice.of(METHOD),)), ()), Odd()
    for _ in range(3):
        for name in ("b/d", "w orse"):
            with pytest.raises(PoiseError) as refused:
                hub.device(name)
            feeding._refused(None, source, name, refused.value)  # type: ignore[arg-type]
    texts = [event["text"] for event in hub.happened.all()]
    assert [sum(name in text for text in texts) for name in ("b/d", "w orse")] == [1, 1]
    for number in range(3000):  # made up
        feeding._refused(None, source, str(number), PoiseError(f"no {number}"))  # type: ignore[arg-type]
    assert len(hub.happened.all()) < 110
    assert feeding.refused == 3006


# -- view -----------------------------------------------------------------------------------------------------------


def test_a_view_takes_no_samples_and_can_be_ended() -> None:
    recording = made(1.0)
    film = of_recording(recording, [Strip("adaptive-gain", poise.estimate(poise.AdaptiveGain(), recording))])
    with serving(methods=(), films=(film,)) as live:
        with pytest.raises(InvalidStatus) as refused, live.device("pushed"):
            pass
        assert refused.value.response.status_code == 400
        assert b"poise view" in refused.value.response.body
        assert "pushed" not in live.hub.devices


def test_samples_that_nothing_will_run_do_not_keep_a_server_from_ending() -> None:
    began: Callable[[], float] = time.monotonic
    with serving(methods=()) as live, live.device("pushed") as device:
        send(device, rows_of(made(0.5)))
        wait_for(lambda: live.hub.starting)
        ended = began()
    assert began() - ended < 10.0
