"""`poise.live` over real sockets: devices push, viewers see, and who may do what."""

from __future__ import annotations

import asyncio
import json
import re
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest
from numpy.typing import NDArray
from websockets.exceptions import ConnectionClosed, InvalidStatus

import poise
from live_helpers import METHOD, Running, ask, heard, made, rows_of, seen, send, serving, wait_for
from poise.data.event import TipState
from poise.errors import PoiseError
from poise.live import frames
from poise.live.access import Access, AccessError, parsed_tokens
from poise.live.device import Device
from poise.live.hub import Hub, HubError
from poise.live.listening import Options, ServerError
from poise.live.methods import Choice
from poise.live.replay import Replay
from poise.live.server import Server
from poise.live.watching import Watch
from poise.monitor import judge
from poise.responses import Responses

ALL, READ, DEVICE = "all-the-scopes-of-it", "may-only-read-of-it", "may-only-push-samples"


@pytest.fixture(scope="module")
def live() -> Iterator[Running]:
    with serving() as running:
        yield running


@pytest.fixture(scope="module")
def guarded() -> Iterator[Running]:
    with serving(tokens=parsed_tokens((ALL, f"read:{READ}", f"device:{DEVICE}"))) as running:
        yield running


def later(rows: NDArray[np.float64], seconds: float) -> NDArray[np.float64]:
    """The last sample, so much later."""
    last = rows[-1:].copy()
    last[:, 0] += seconds
    return last


@pytest.mark.parametrize("size", [1, 7, 50])
def test_a_device_that_pushes_gets_the_attitudes_of_estimate(live: Running, size: int) -> None:
    recording = made(3.0, seed=size)
    with live.viewer(every=True) as viewer, live.device(f"exact-{size}") as device:
        assert heard(device, "welcome")["next"] == 0
        send(device, rows_of(recording), size=size)
        found = seen(viewer, len(recording))
    expected = poise.estimate(poise.AdaptiveGain(), recording)
    np.testing.assert_array_equal(found["quat"], expected.quat.astype("f4"))
    np.testing.assert_array_equal(found["flags"], expected.flags)
    np.testing.assert_array_equal(found["sequence"], np.arange(len(recording)))
    np.testing.assert_array_equal(found["time"], recording.time)
    np.testing.assert_array_equal(found["acc"], recording.acc.astype("f4"))
    assert (np.abs(found["host"] - time.time()) < 20.0).all()


def test_json_samples_are_the_same_samples(live: Running) -> None:
    recording = made(1.0, seed=3)
    with live.viewer(every=True) as viewer, live.device("json") as device:
        for i in range(0, len(recording), 10):
            part = recording[i : i + 10]
            values = {name: getattr(part, name).tolist() for name in ("time", "gyr", "acc", "mag")}
            device.send(json.dumps(values | {"sequence": i}))
        found = seen(viewer, len(recording))
    np.testing.assert_array_equal(found["quat"], poise.estimate(poise.AdaptiveGain(), recording).quat.astype("f4"))


def test_samples_that_come_again_count_once_and_gaps_are_counted(live: Running) -> None:
    rows = rows_of(made(2.0))
    with live.device("again") as device:
        send(device, rows[:100])
        send(device, rows[80:120], first=80, size=15)
        send(device, rows[150:], first=150)
        health = live.hub.find("again").health
        wait_for(lambda: health.samples == 170)
    with live.device("again") as device:
        assert heard(device, "welcome")["next"] == len(rows)
    assert (health.repeated, health.lost) == (20, 30)


def test_the_newest_wins_and_silence_is_said(live: Running) -> None:
    rows = rows_of(made(1.0))
    with live.viewer() as viewer, live.device("silent") as device:
        ask(viewer, type="subscribe", devices=["silent"], rate=100)
        send(device, rows)
        last = seen(viewer, 1)[-1]
        while last["flags"] & int(poise.Flag.SILENT) == 0:
            last = seen(viewer, 1)[-1]
        assert last["sequence"] == len(rows) - 1
        assert not last["valid"]
        assert np.isfinite(last["quat"]).all()
        device.send(frames.encoded(later(rows, 0.2), len(rows)))
        last = wait_for(lambda: seen(viewer, 1)[-1])
        assert not last["flags"] & int(poise.Flag.SILENT)
    state = live.http.get("/healthz").json()["devices"]
    assert next(d for d in state if d["id"] == "silent")["silences"] >= 1


def test_methods_change_without_a_sample_lost(live: Running) -> None:
    recording = made(6.0)
    rows = rows_of(recording)
    with live.viewer(every=True) as viewer, live.device("changing") as device:
        ask(viewer, type="subscribe", devices=["changing"], rate="every")
        send(device, rows[:200])
        first = seen(viewer, 200)
        both = [{"name": METHOD}, {"name": METHOD, "settings": {"k_rest": 0.05}}]
        assert ask(viewer, type="methods", device="changing", methods=both)["type"] == "done"
        send(device, rows[200:400], first=200)
        second = seen(viewer, 400)
        answer = live.http.put("/devices/changing/methods", json=[both[1]])
        assert answer.status_code == 200
        send(device, rows[400:], first=400)
        third = seen(viewer, 200)
    expected = poise.estimate(poise.AdaptiveGain(), recording)
    kept = np.concatenate([first, second[second["method"] == 0]])
    np.testing.assert_array_equal(kept["quat"], expected.quat[:400].astype("f4"))
    other = np.concatenate([second[second["method"] == 1], third])
    np.testing.assert_array_equal(other["sequence"], np.arange(200, 600))
    assert (third["method"] == 1).all()
    turn = np.abs(np.sum(other["quat"][0] * kept["quat"][199]))
    assert 2.0 * np.arccos(min(turn, 1.0)) < 0.1  # it begins where the device was


def test_a_heading_is_reset(live: Running) -> None:
    rows = rows_of(made(1.0))
    with live.viewer() as viewer, live.device("forward") as device:
        send(device, rows)
        wait_for(lambda: live.hub.find("forward").health.samples == len(rows))
        wait_for(lambda: live.hub.find("forward").runs[0].stream.latest is not None)
        assert ask(viewer, type="reset_heading", device="forward", forward="y")["type"] == "done"
        device.send(frames.encoded(later(rows, 0.01), len(rows)))
        wait_for(lambda: live.http.get("/devices/forward/attitude").json()["sequence"] == len(rows))
        found = live.http.get("/devices/forward/attitude").json()
    assert min(found["heading_deg"], 360.0 - found["heading_deg"]) < 3.0
    assert live.hub.find("forward").described()["methods"][0]["heading"] == "arbitrary"


@pytest.mark.parametrize(
    ("frame", "says"),
    [
        (b"", "16 bytes of header"),
        (b"\x02" + bytes(95), "version 2"),
        (frames.HEADER.pack(1, 7, 80, 1, 0) + bytes(80), "kind 7"),
        (frames.HEADER.pack(1, 1, 80, 3, 0) + bytes(80), "need a frame of 256"),
        (frames.HEADER.pack(1, 1, 72, 1, 0) + bytes(72), "80 or 96"),
        (frames.HEADER.pack(1, 1, 80, 0, 0), "1 to 4096"),
        ("{", "not JSON"),
        ("[1]", "expected an object"),
        ('{"time": 1, "gyr": [1], "acc": [1, 2, 3]}', "gyr"),
        ('{"time": [], "gyr": [], "acc": []}', "1 to 4096"),
        ('{"time": 1, "gyr": [1, 2, 3], "acc": [1, 2, 3], "sequence": -1}', "sequence"),
    ],
)
def test_a_malformed_frame_is_an_error_with_its_reason(live: Running, frame: bytes | str, says: str) -> None:
    with live.device("malformed") as device:
        device.send(frame)
        assert says in heard(device, "error")["message"]
        send(device, rows_of(made(0.5)), first=live.hub.find("malformed").next)  # and it goes on
    wait_for(lambda: live.hub.find("malformed").health.samples >= 50)


def test_stamps_in_milliseconds_are_refused(live: Running) -> None:
    rows = rows_of(made(0.5))
    rows[:, 0] *= 1000.0
    with live.device("milliseconds") as device:
        send(device, rows, size=10)
        assert "Multiply them by 0.001" in heard(device, "error")["message"]


def test_ten_malformed_frames_close_the_connection_and_nobody_elses(live: Running) -> None:
    with live.device("good") as good, live.device("bad") as bad:
        for _ in range(10):
            bad.send(b"nonsense")
        with pytest.raises(ConnectionClosed) as closed:
            while True:
                bad.recv(timeout=20.0)
        assert closed.value.rcvd is not None and closed.value.rcvd.code == 1008
        send(good, rows_of(made(0.5)))
        wait_for(lambda: live.hub.find("good").health.samples == 50)


def test_a_device_far_above_its_rate_is_cut_off() -> None:
    rows = np.tile(rows_of(made(1.0)), (10, 1))
    rows[:, 0] = np.arange(len(rows)) / 1000.0
    with serving(max_rate=500.0) as live, live.device("flood") as flood, live.device("calm") as calm:
        with pytest.raises(ConnectionClosed):
            for k in range(100):
                send(flood, rows, first=k * len(rows), size=100)
            while True:  # all of it may fit in the sockets' buffers before the closing is heard
                flood.recv(timeout=20.0)
        assert any(event["kind"] == "throttled" and event["device"] == "flood" for event in live.hub.happened.all())
        send(calm, rows[:100])
        wait_for(lambda: live.hub.find("calm").health.samples == 100)
        assert live.hub.find("calm").health.lost == 0


def test_the_rate_is_that_of_a_device_however_many_connections_it_has() -> None:
    rows = rows_of(made(10.0))
    with serving(max_rate=200.0) as live, live.device("flood") as one, live.device("flood") as other:

        def cut_off() -> bool:
            return any(event["kind"] == "throttled" for event in live.hub.happened.all())

        begun, sent = time.monotonic(), 0
        with suppress(ConnectionClosed):  # one of them may be cut off while it sends
            while sent < len(rows) and not cut_off():
                due = min(int(266.0 * (time.monotonic() - begun)) // 2 * 2, len(rows))  # 133 a second from each
                middle = (sent + due) // 2
                send(one, rows[sent:middle], first=sent)
                send(other, rows[middle:due], first=middle)
                sent = due
                time.sleep(0.1)
        wait_for(cut_off)


def test_packets_that_come_late_are_counted_and_flags_of_now_are_told() -> None:
    rows = rows_of(made(1.0))
    with serving() as live, live.device("arm") as device:
        for k in range(0, 100, 10):
            time.sleep(0.1 + 0.15 * (k == 70))
            send(device, rows[k : k + 10], first=k)
        wait_for(lambda: live.hub.find("arm").health.samples == 100)
        wait_for(lambda: live.hub.find("arm").health.silent)
        assert live.hub.find("arm").health.late >= 1
        told = live.http.get("/metrics").text
        assert f'poise_flag{{device="arm",method="{METHOD}",flag="SILENT"}} 1' in told
        assert 'poise_device_late_total{device="arm"}' in told


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ({"type": "nonsense"}, "expected subscribe"),
        ({"type": "subscribe", "rate": 0}, "rate"),
        ({"type": "subscribe", "devices": "all"}, "list of names"),
        ({"type": "methods", "device": "nobody", "methods": []}, "no device"),
        ({"type": "methods", "device": "asked", "methods": []}, "1 to 8"),
        ({"type": "methods", "device": "asked", "methods": [{"name": "magic"}]}, "no method 'magic'"),
        ({"type": "methods", "device": "asked", "methods": [{"name": METHOD, "settings": {"x": 1}}]}, "no parameter"),
        ({"type": "methods", "device": "asked", "methods": [{"name": METHOD, "settings": {"k_rest": -1}}]}, "k_rest"),
        ({"type": "reset_heading", "device": "asked"}, "no attitude yet"),
        ({"type": "reset_heading", "device": "asked", "forward": "up"}, "body axis"),
    ],
)
def test_a_wish_that_cannot_be_is_answered_with_its_reason(live: Running, asked: dict[str, Any], says: str) -> None:
    live.call(lambda: live.hub.device("asked"))
    with live.viewer() as viewer:
        answer = ask(viewer, **asked)
        assert answer["type"] == "error"
        assert says in answer["message"]


def test_over_http(live: Running) -> None:
    with live.device("web") as device:
        assert live.http.get("/devices/web/attitude").status_code == 404
        send(device, rows_of(made(1.0)))
        wait_for(lambda: live.http.get("/devices/web/attitude").status_code == 200)
        found = live.http.get("/devices/web/attitude").json()
    assert found["device"] == "web"
    assert len(found["quat_wxyz"]) == 4
    assert "web" in {each["id"] for each in live.http.get("/devices").json()}
    assert live.http.get("/devices/nobody/attitude").status_code == 404
    assert live.http.get("/devices/web/attitude?method=magic").status_code == 400
    garbage = live.http.put("/devices/web/methods", content=b"nonsense")
    assert garbage.status_code == 400 and re.search("not JSON: 'nonsense'.*two-stage", garbage.text)
    assert {each["name"] for each in live.http.get("/methods").json()} == set(poise.METHODS)
    assert 'poise_device_samples_total{device="web"} 100' in live.http.get("/metrics").text
    with live.http.stream("GET", "/events") as events:
        lines = iter(events.iter_lines())
        assert any("device web" in line for line in lines)


def test_a_replay_is_a_device() -> None:
    recording = made(3.0)
    with serving(Replay(recording, "played", speed=20.0)) as live:
        wait_for(lambda: live.hub.devices.get("played") and live.hub.find("played").health.samples == len(recording))
        wait_for(lambda: any(event["kind"] == "end" for event in live.hub.happened.all()))
        stream = live.hub.find("played").runs[0].stream
        expected = poise.estimate(poise.AdaptiveGain(), recording)
        latest = wait_for(lambda: stream.latest)
        np.testing.assert_array_equal(latest.quat[0], expected.quat[-1])


# -- who may do what ------------------------------------------------------------------------------------------------


def bearer(token: str) -> dict[str, str]:
    return {"Authorization": f"Bearer {token}"}


@pytest.mark.parametrize("token", [None, "x" * 20, ALL[:-1], ALL + "x", "-"])
def test_without_the_token_nothing_is_upgraded(guarded: Running, token: str | None) -> None:
    headers = {} if token is None else bearer(token)
    for connecting in (guarded.viewer, lambda **options: guarded.device("x", **options)):
        with pytest.raises(InvalidStatus) as refused, connecting(additional_headers=headers):
            pass
        assert refused.value.response.status_code == 401
    assert guarded.http.get("/devices", headers=headers).status_code == 401
    assert guarded.http.get("/healthz", headers=headers).json() == {"status": "ok"}


def test_scopes(guarded: Running) -> None:
    with guarded.viewer(additional_headers=bearer(READ)) as viewer:
        assert "scope 'write'" in ask(viewer, type="methods", device="x", methods=[])["message"]
    for connecting, token in ((guarded.viewer, DEVICE), (lambda **o: guarded.device("x", **o), READ)):
        with pytest.raises(InvalidStatus), connecting(additional_headers=bearer(token)):
            pass
    with guarded.device("pushes", additional_headers=bearer(DEVICE)) as device:
        heard(device, "welcome")
    assert guarded.http.get("/devices", headers=bearer(READ)).status_code == 200
    assert guarded.http.put("/devices/pushes/methods", headers=bearer(READ), json=[]).status_code == 401
    assert guarded.http.put("/devices/pushes/methods", headers=bearer(ALL), json=[]).status_code == 400
    with guarded.viewer(subprotocols=["poise", f"bearer.{READ}"]) as page:  # as a page has to
        assert page.subprotocol == "poise"


@pytest.mark.parametrize("origin", ["https://evil.example", "null", "http://127.0.0.1:1", "http://localhost"])
def test_foreign_origins_are_refused(live: Running, origin: str) -> None:
    with pytest.raises(InvalidStatus) as refused, live.viewer(additional_headers={"Origin": origin}):
        pass
    assert refused.value.response.status_code == 403
    assert live.http.get("/devices", headers={"Origin": origin}).status_code == 403


def test_the_own_origin_and_known_hosts_only(live: Running) -> None:
    with live.viewer(additional_headers={"Origin": f"http://{live.address}"}) as viewer:
        heard(viewer, "hello")
    assert live.http.get("/devices", headers={"Host": "evil.example"}).status_code == 403
    assert live.http.get("/devices", headers={"Host": "localhost:1"}).status_code == 200
    headers = live.http.get("/").headers
    assert "default-src 'none'" in headers["content-security-policy"]
    assert headers["x-content-type-options"] == "nosniff"


def test_beyond_loopback_only_with_a_token() -> None:
    with pytest.raises(AccessError, match="give --token"):
        Access("0.0.0.0", {})
    Access("0.0.0.0", parsed_tokens((ALL,)))
    for text in ("short", "read:short", "root:" + ALL, "with blanks " + ALL):
        with pytest.raises(AccessError) as refused:
            parsed_tokens((text,))
        assert text.rpartition(":")[2] not in str(refused.value)


def test_a_busy_port_is_named(live: Running) -> None:
    server = Server(Hub((Choice(METHOD),)), (), Options(port=live.server.options.port))
    with pytest.raises(ServerError, match="another program listens there"):
        asyncio.run(server.run())


def test_a_page_needs_no_token_but_holds_nothing(guarded: Running) -> None:
    answer = httpx.get(f"http://{guarded.address}/")
    assert answer.status_code == 200


def test_dear_ticks_do_not_keep_silence_from_being_noticed() -> None:
    """A method's first tick compiles; after that, and with many devices, ticks come as far apart as they may."""
    rows = np.zeros((3, 10))
    rows[:, 0], rows[:, 6] = np.arange(3) / 100, 9.81
    with serving() as live, live.device("arm") as device:
        live.call(lambda: setattr(live.hub, "tick_cost", 1.0))
        send(device, rows)
        wait_for(lambda: live.hub.find("arm").health.samples == 3 and live.hub.find("arm").health.silent)
        live.call(lambda: setattr(live.hub, "tick_cost", 1.0))
        rows[:, 0] += 0.1
        send(device, rows, first=3)
        wait_for(lambda: live.hub.find("arm").health.silences == 2)


def test_a_device_that_tips_over_is_said_and_answered(tmp_path: Path) -> None:
    lean = np.concatenate([np.zeros(200), np.linspace(0.0, 1.5, 100), np.full(100, 1.5)])  # rad, forward about x
    rate = np.gradient(lean, 0.01)
    zero = np.zeros_like(lean)
    rows = np.column_stack(
        [
            np.arange(400) / 100,
            -rate,
            zero,
            zero,
            zero,
            -9.81 * np.sin(lean),
            9.81 * np.cos(lean),
            *[np.full(400, np.nan)] * 3,
        ]
    )
    config = tmp_path / "robot.toml"
    config.write_text(
        f'[responders.note]\ntype = "log"\nfile = "{tmp_path / "said.log"}"\n'
        '[[stages]]\nname = "stop"\nstate = "tipping"\nfire = ["note"]\n'
    )
    watch = Watch(responses={"robot": Responses.from_toml(config)})
    with serving(watch=watch) as live, live.viewer() as viewer, live.device("robot") as device:
        ask(viewer, type="subscribe", rate=100)
        send(device, rows, size=5)
        states = []
        while "UNKNOWN" not in states[1:]:  # it falls silent at the end
            event = heard(viewer, "event")
            if event["kind"] == "tip":
                states.append(event["state"])
                assert event["device"] == "robot"
        record = live.call(lambda: live.hub.latest(live.hub.find("robot")).copy())
    assert states[0] == "UPRIGHT"
    assert "TIPPING" in states or "FALLEN" in states
    assert record["tip"] == TipState.UNKNOWN
    expected = judge(poise.estimate(poise.AdaptiveGain(), recording := as_recording(rows)), recording)
    assert states[: len(expected.events)] == [event.state.name for event in expected.events]
    assert "stop" in (tmp_path / "said.log").read_text()


def as_recording(rows: NDArray[np.float64]) -> poise.Recording:
    return poise.Recording(rows[:, 0], rows[:, 1:4], rows[:, 4:7], rows[:, 7:10])


def test_a_fault_of_ours_ends_the_server_loudly() -> None:
    class Faulty(Exception):
        pass

    def fail(batch: object) -> None:
        raise Faulty("ours")

    with pytest.raises(Faulty), serving() as live:
        live.hub.on_batch.append(fail)
        with live.device("any") as device:
            send(device, rows_of(made(0.5)))
            wait_for(live.server.stopping.is_set)


def test_no_flood_before_the_methods_are_loaded_ends_the_server_or_fills_the_memory() -> None:
    waiting: dict[Device, None] = {}
    together, apart = Device("together", 0, "", waiting), Device("apart", 1, "", waiting)
    rows = np.zeros((150_000, 12))
    rows[:, 0], rows[:, 6] = 0.01 * np.arange(len(rows)), 9.81
    together.receive(rows, 0.0)
    assert together.health.lost == 50_000
    taken = together.take()
    assert taken.sequence == 50_000 and len(taken.rows) == 100_000
    for k in range(1500):  # with a gap in the numbers before each
        apart.receive(rows[100 * k : 100 * k + 100], 0.0, 300 * k)
    kept = []
    while apart in waiting:
        del waiting[apart]
        kept.append(apart.take())
    assert sum(len(each.rows) for each in kept) == 100_000
    assert [each.sequence for each in kept] == list(range(300 * 500, 300 * 1500, 300))


def test_stamps_that_are_refused_are_not_kept() -> None:
    device = Device("arm", 0, "", {})
    rows = np.zeros((8, 12))
    for k in range(100):
        rows[:, 0] = 10.0 * np.arange(8 * k, 8 * k + 8)
        with pytest.raises(PoiseError):
            device.receive(rows, 0.0)
    assert device._stamps is not None and len(device._stamps) <= 16


@pytest.mark.parametrize("name", ["\U00010400" * 64, "arm.self-calibrating.attitude", ".arm", "a/b", ""])
def test_a_name_that_would_spoil_a_recordings_files_is_refused(name: str) -> None:
    hub = Hub((Choice.of(METHOD),))
    with pytest.raises(HubError, match="letters"):
        hub.device(name)
    hub.device("Unterarm-ü")


def test_a_heading_is_reset_for_all_methods_or_for_none() -> None:
    for name in (METHOD, "two-stage"):
        Choice.of(name).warm()
    hub = Hub((Choice.of(METHOD), Choice.of("two-stage")))
    device = hub.device("arm")
    first, second = device.runs
    first.stream.update(poise.Packet(0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 9.8), (0.0, 20.0, -40.0)))
    assert first.stream.latest is not None
    before = first.stream.latest.quat.copy()
    for runs in ([first, second], []):
        device.runs = runs
        with pytest.raises(HubError, match="no attitude yet"):
            hub.reset_heading(device, "x")
    np.testing.assert_array_equal(first.stream.latest.quat, before)
    assert hub.happened.all()[-1]["kind"] != "heading"


def test_a_body_over_http_is_read_no_further_than_it_may_go(live: Running) -> None:
    taken, answers = [], []
    host = [(b"host", live.address.encode())]
    scope = {"type": "http", "method": "PUT", "path": "/devices/arm/methods", "query_string": b"", "headers": host}

    async def receive() -> dict[str, Any]:
        taken.append(65536)
        return {"type": "http.request", "body": b" " * 65536, "more_body": len(taken) < 1000}

    async def send(message: Any) -> None:
        answers.append(message)

    asyncio.run(live.server.app(scope, receive, send))
    assert answers[0]["status"] == 400
    assert len(taken) == 2


def test_json_over_http_that_is_too_deep_is_refused(live: Running) -> None:
    live.call(lambda: live.hub.device("arm"))
    assert live.http.put("/devices/arm/methods", content="[" * 60_000).status_code == 400
    assert live.http.get("/healthz").status_code == 200


class Slow:
    """A source whose broker is not there, and that hears what it cannot read."""

    name, shape = "slow", "board"
    rejected, trouble = 3, "the broker cannot be reached"

    async def arrivals(self) -> Any:
        await asyncio.sleep(3600)
        yield None


def test_what_is_amiss_with_a_source_is_said_once(monkeypatch: pytest.MonkeyPatch) -> None:
    with serving(Slow()) as live:
        time.sleep(2.2)
        told = [event["text"] for event in live.hub.happened.all() if event["kind"] == "source"]
        monkeypatch.setattr(Slow, "trouble", "")
        wait_for(lambda: live.hub.happened.all()[-1]["text"] == "slow: it is there again")
    assert len(told) == 2 and "cannot be reached" in told[0] and "3 lines or frames" in told[1]


def test_a_replay_at_full_speed_waits_for_its_method(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("poise.live.methods._WARM", set())
    recording = poise.Recording.at_rate(100.0, np.zeros((150_000, 3)), np.full((150_000, 3), (0.0, 0.0, 9.81)))
    hub = Hub((Choice.of(METHOD),))
    server = Server(hub, [Replay(recording, "walk", float("inf"))])

    async def main() -> int:
        feeding = asyncio.ensure_future(server.feeding.feed(server.feeding.sources[0]))
        await asyncio.sleep(0.5)
        early = hub.devices["walk"].health.samples
        await asyncio.to_thread(Choice.of(METHOD).warm)
        hub.set_methods(hub.devices["walk"], hub.methods)
        while not feeding.done():
            hub.tick()
            await asyncio.sleep(0.001)
        return early

    assert asyncio.run(main()) <= 4096
    health = hub.devices["walk"].health
    assert (health.samples, health.lost) == (150_000, 0)
