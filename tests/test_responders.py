"""Each responder with the real thing: speech, pins of a mock board, a broker, a server, programs."""

from __future__ import annotations

import json
import math
import sys
import threading
import time
import wave
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poise
from poise.data.event import TipEvent, TipState
from poise.errors import ResponseError
from poise.responses import Alarm, Responses, config_of
from poise.responses.alarm import now_utc
from programs import broker, free_port, hook, mock_board, program, subscriber, until

TIPPING = TipEvent(12.5, TipState.TIPPING, TipState.LEANING, "forward", 0.6, 1.5, 0.3, "beyond 30°")
UPRIGHT = TipEvent(20.0, TipState.UPRIGHT, TipState.RIGHTED)
LOG = {"type": "log", "file": "alarms.jsonl"}


@pytest.fixture
def board(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The pins of a mock board."""
    yield from mock_board(monkeypatch)


def levels(board: Any, pin: int) -> list[bool]:
    return [bool(each.state) for each in board.pin(pin).states]


def made(folder: Path, responders: dict[str, Any], *stages: dict[str, Any], **more: Any) -> Responses:
    every = [name for name in responders if name != "log" and not responders[name].pop("spare", False)]
    default = {"state": "tipping", "fire": every or ["log"]}
    return Responses(config_of({"responders": responders, "stages": list(stages) or [default], **more}, folder))


def lines(folder: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in (folder / "alarms.jsonl").read_text().splitlines()]


def sound(path: Path) -> tuple[float, float]:
    """Seconds, and the root mean square of full scale."""
    with wave.open(str(path)) as file:
        samples = np.frombuffer(file.readframes(file.getnframes()), dtype="<i2") / 32768.0
        return samples.size / file.getframerate(), float(np.sqrt(np.mean(samples**2)))


@pytest.mark.parametrize("language", ["en", "zh"])
def test_speech_that_can_be_heard(tmp_path: Path, language: str) -> None:
    program("espeak-ng")
    voice = {"type": "voice", "language": language, "wav": "said.wav"}
    with made(tmp_path, {"voice": voice}) as responses:
        responses.handle(TIPPING)
        assert responses.wait()
        assert responses.failures == ()
    seconds, loud = sound(tmp_path / "said.wav")
    assert 0.8 < seconds < 6.0 and loud > 0.02
    assert [path.name for path in tmp_path.iterdir()] == ["said.wav"]


def test_the_direction_and_own_words_are_said(tmp_path: Path) -> None:
    config = config_of(
        {
            "responders": {"v": {"type": "voice", "language": "zh", "text": {"fallen": "机器人{direction}倒下"}}},
            "stages": [{"state": "fallen", "fire": ["v"]}],
        }
    )
    voice = config.responders[0]
    words: Any = voice.words  # type: ignore[attr-defined]
    assert words(Alarm("fired", TIPPING, now_utc())) == "警告!机器人向前倾倒!"
    assert words(Alarm("fired", TipEvent(0, TipState.FALLEN, TipState.TIPPING, "left"), now_utc())) == "机器人向左倒下"
    assert words(Alarm("fired", TipEvent(0, TipState.LEANING, TipState.TIPPING), now_utc())) == "注意,正在倾斜。"
    assert words(Alarm("failure", TIPPING, now_utc(), responder="power")) == "注意!响应 power 失效。"


def test_a_voice_that_nobody_hears_has_failed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """espeak-ng ends with code 0 without a sound card, and where it cannot write; and there are stand-ins that say nothing."""
    real = program("espeak-ng")
    fake = tmp_path / "espeak-ng"
    for script, says in (
        ("exit 1", "ended with code 1"),
        ("echo 'error: No such file or directory' >&2", "No such file or directory"),
        ("exit 0", "nobody can have heard it"),
        ("sleep 60", "still running after"),
    ):
        rendering = f'case "$*" in *" -w "*) exec {real} "$@";; *" -a 0 "*) exit 0;; esac'
        fake.write_text(f"#!/bin/sh\n{rendering}\n{script}\n")
        fake.chmod(0o755)
        monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
        with made(tmp_path, {"voice": {"type": "voice", "timeout": 1.0}}) as responses:
            responses.handle(TIPPING)
            assert responses.wait()
            (failure,) = responses.failures
        assert failure.responder == "voice" and says in failure.detail
    fake.write_text('#!/bin/sh\necho "error: no card" >&2\n')  # not even at the start
    with pytest.raises(ResponseError, match="voice: espeak-ng"), made(tmp_path, {"voice": {"type": "voice"}}):
        pass
    monkeypatch.setenv("PATH", str(tmp_path / "nowhere"))
    with pytest.raises(ResponseError, match="apt install espeak-ng"), made(tmp_path, {"voice": {"type": "voice"}}):
        pass


def test_a_graver_state_breaks_off_what_is_being_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real, said = program("espeak-ng"), tmp_path / "said"
    fake = tmp_path / "espeak-ng"
    fake.write_text(
        f'#!/bin/sh\ncase "$*" in *" -w "*) exec {real} "$@";; *" -a 0 "*) exit 0;; esac\n'
        f'echo "$*" >> {said}\ncase "$*" in *Careful*) sleep 30;; *) sleep 1;; esac\n'
    )
    fake.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    stage = {"state": ["leaning", "tipping"], "fire": ["voice"]}
    with made(tmp_path, {"voice": {"type": "voice"}}, stage) as responses:
        responses.handle(TipEvent(1.0, TipState.LEANING, TipState.UPRIGHT, "left"))
        assert until(said.exists)
        responses.handle(TIPPING)
        assert until(lambda: "Tipping forward" in said.read_text(), 5.0)
        assert responses.wait() and responses.failures == ()


@pytest.mark.parametrize("active_high", [True, False])
def test_the_pin_moves_and_holds_until_acknowledged(tmp_path: Path, board: Any, active_high: bool) -> None:
    cut = active_high
    relay = {"type": "relay", "pin": 17, "active_high": active_high, "fail_safe": "release"}
    with made(tmp_path, {"power": relay}) as responses:
        pin = board.pin(17)
        assert pin.function == "output" and bool(pin.state) is not cut
        responses.handle(UPRIGHT)
        assert bool(pin.state) is not cut
        responses.handle(TIPPING)
        assert bool(pin.state) is cut  # before handle came back
        responses.handle(UPRIGHT)
        assert bool(pin.state) is cut and responses.active == ("tipping",)
        assert responses.acknowledge() == () and bool(pin.state) is not cut
        before = len(levels(board, 17))
    assert pin.function == "input" and levels(board, 17)[before - 1] is not cut


@pytest.mark.parametrize("unknown", ["ignore", "warn", "as tipping"])
@pytest.mark.parametrize("fail_safe", ["cut", "release"])
def test_the_power_comes_on_once_the_body_is_known_to_stand(
    tmp_path: Path, board: Any, unknown: str, fail_safe: str
) -> None:
    relay = {"type": "relay", "pin": 17, "active_high": True, "fail_safe": fail_safe}
    cut = fail_safe == "cut" or unknown == "as tipping"
    stage = {"name": "fall", "state": ["tipping", "fallen"], "fire": ["power"]}
    with made(tmp_path, {"power": relay, "log": dict(LOG)}, stage, unknown=unknown) as responses:
        pin = board.pin(17)
        assert bool(pin.state) is cut and responses.active == (("start",) if cut else ())
        if fail_safe == "cut":
            assert True in levels(board, 17) and False not in levels(board, 17)[1:]  # not for an instant
        assert responses.acknowledge() == (("start",) if cut else ())
        for state in (TipState.LEANING, TipState.FALLEN, TipState.UNKNOWN, TipState.FALLEN):
            responses.handle(TipEvent(1.0, state, TipState.UNKNOWN))
            assert bool(pin.state) is (cut or state != TipState.LEANING)
        responses.handle(UPRIGHT)
        assert bool(pin.state) is True and responses.active == ("fall",)  # it was seen lying
        assert responses.acknowledge() == () and not pin.state
        responses.handle(TipEvent(9.0, TipState.UNKNOWN, TipState.UPRIGHT))
        assert bool(pin.state) is (unknown == "as tipping")  # running, it is the policy alone
    released = [line["stage"] for line in lines(tmp_path) if line["kind"] == "released"]
    assert ("start" in released) is cut


def test_a_robot_that_never_sends_is_unknown(tmp_path: Path, board: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("poise.responses.staging._PATIENCE", 0.2)
    relay = {"type": "relay", "pin": 17, "active_high": True, "fail_safe": "release"}
    for unknown, cut in (("warn", False), ("as tipping", True), ("ignore", False)):
        (tmp_path / "alarms.jsonl").unlink(missing_ok=True)
        with made(tmp_path, {"power": dict(relay), "log": dict(LOG)}, unknown=unknown) as responses:
            told = lambda: [line for line in lines(tmp_path) if line["kind"] == "fired"]  # noqa: E731
            if unknown == "ignore":
                time.sleep(0.5)
                assert not told()
            else:
                assert until(told)
                assert told()[0]["reason"] == "no attitude since the start"
            assert bool(board.pin(17).state) is cut
            assert ("tipping" in responses.active) is cut
        board.reset()


def test_at_the_end_the_power_is_cut(tmp_path: Path, board: Any) -> None:
    relay = {"type": "relay", "pin": "GPIO4", "active_high": True}
    with pytest.raises(ZeroDivisionError), made(tmp_path, {"power": relay}):
        _ = 1 / 0
    assert levels(board, 4)[-2:] != [False, False] and True in levels(board, 4)
    assert board.pin(4).function == "input"


def test_a_relay_that_two_stages_hold_is_released_by_the_last(tmp_path: Path, board: Any) -> None:
    relay = {"type": "relay", "pin": 17, "active_high": True}
    carried = {"state": "picked up", "fire": ["power"], "latched": False}
    with made(tmp_path, {"power": relay}, {"state": "tipping", "fire": ["power"]}, carried) as responses:
        responses.handle(TipEvent(1.0, TipState.PICKED_UP, TipState.UPRIGHT))
        responses.handle(TIPPING)
        responses.handle(UPRIGHT)
        assert responses.active == ("tipping",) and board.pin(17).state
        responses.acknowledge()
        assert not board.pin(17).state


def test_pins_that_are_not_there_are_refused(tmp_path: Path, board: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    for pin in (99, "motor", "GND1"):
        with (
            pytest.raises(ResponseError, match=r"power\.pin: the board has no GPIO pin"),
            made(tmp_path, {"power": {"type": "relay", "pin": pin, "active_high": True}}),
        ):
            pass
    two = {name: {"type": "relay", "pin": 17, "active_high": True} for name in ("one", "two")}
    with pytest.raises(ResponseError, match=r"two\.pin: 17 cannot be used"), made(tmp_path, two):
        pass
    import gpiozero

    monkeypatch.setattr(gpiozero.Device, "pin_factory", None)
    monkeypatch.setenv("GPIOZERO_PIN_FACTORY", "nosuch")
    with pytest.raises(ResponseError, match="pip install lgpio"), made(tmp_path, {"one": {**two["one"]}}):
        pass


@pytest.mark.parametrize("how", ["raises", "does not follow", "hangs"])
def test_a_relay_that_fails_is_told_and_the_next_one_tried(tmp_path: Path, board: Any, how: str) -> None:
    released = threading.Event()
    relays = {
        "power": {"type": "relay", "pin": 17, "active_high": True, "if_failed": ["spare"]},
        "spare": {"type": "relay", "pin": 27, "active_high": True, "spare": True},
        "other": {"type": "relay", "pin": 22, "active_high": True},
        "log": dict(LOG),
    }
    with made(tmp_path, relays) as responses:
        responses.handle(UPRIGHT)
        pin = board.pin(17)

        def drive(value: bool) -> None:
            if how == "raises":
                raise OSError("no such device")
            if how == "hangs":
                released.wait(20.0)

        pin._set_state = drive
        caller = threading.Thread(target=responses.handle, args=(TIPPING,), daemon=True)
        caller.start()
        assert until(lambda: board.pin(27).state and board.pin(22).state)
        assert caller.is_alive() == (how == "hangs")
        assert until(lambda: any(line["kind"] == "failure" for line in lines(tmp_path)))
        (failure,) = responses.failures
        assert failure.responder == "power"
        released.set()
        caller.join(10.0)
    told = next(line for line in lines(tmp_path) if line["kind"] == "failure")
    assert told["responder"] == "power" and told["detail"]


def test_a_relay_that_hung_in_a_release_is_set_right_when_it_comes_back(tmp_path: Path, board: Any) -> None:
    """It would give the power back to a robot that tips by now."""
    relay = {"type": "relay", "pin": 17, "active_high": True}
    with made(tmp_path, {"power": relay, "log": dict(LOG)}) as responses:
        pin, drive, come_back = board.pin(17), board.pin(17)._set_state, threading.Event()

        def slowly(value: bool) -> None:
            if not value:
                come_back.wait(20.0)
            drive(value)

        responses.handle(TIPPING)
        responses.handle(UPRIGHT)
        pin._set_state = slowly
        caller = threading.Thread(target=responses.acknowledge, daemon=True)
        caller.start()
        assert until(lambda: responses.failures)
        responses.handle(TIPPING)  # fails, as the pin's driver still hangs; and comes back all the same
        assert pin.state and len(responses.failures) == 2
        come_back.set()
        caller.join(10.0)
        assert pin.state and [bool(each.state) for each in pin.states][-2:] == [False, True]
        assert responses.active == ("tipping",)
        pin._set_state = drive


def test_two_logs_without_room_do_not_tell_each_other_for_ever(tmp_path: Path) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    logs = {name: {"type": "log", "file": "/dev/full"} for name in ("one", "two")}
    stage = {"state": "tipping", "fire": ["one"]}
    with made(tmp_path, logs, stage) as responses:
        responses.handle(TIPPING)
        assert responses.wait()
        assert 4 <= len(responses.failures) < 40


def test_the_broker_gets_the_alarm_and_keeps_it(tmp_path: Path) -> None:
    pytest.importorskip("paho.mqtt")
    with broker(tmp_path) as server:
        mqtt = {"type": "mqtt", "broker": "127.0.0.1", "port": server.port, "topic": "robots/7"}
        with made(tmp_path, {"mqtt": mqtt}, name="R7") as responses, subscriber(server.port, "robots/7/#") as got:
            responses.handle(TIPPING)
            assert responses.wait() and responses.failures == ()  # confirmed, as QoS 1 is
            with subscriber(server.port, "robots/7/#") as late:  # who comes after the alarm still gets it
                assert until(lambda: len(late) >= 2)
            kept = {topic: (text, retained) for topic, text, retained, _ in late}
            assert kept["robots/7/availability"] == ("online", True)
            alarm = json.loads(kept["robots/7/alarm"][0])
            assert kept["robots/7/alarm"][1] and alarm["state"] == "tipping" and alarm["robot"] == "R7"
            assert alarm["tilt_deg"] == pytest.approx(math.degrees(0.6)) and alarm["active"] == ["tipping"]
            assert all(qos == 1 for *_, qos in got if _)
            responses.handle(UPRIGHT)
            responses.acknowledge()
            assert until(lambda: any(json.loads(t)["kind"] == "released" for n, t, *_ in got if n.endswith("alarm")))
        with subscriber(server.port, "robots/7/#") as late:
            assert until(lambda: ("robots/7/availability", "offline", True, 1) in late)


def test_the_last_will_tells_of_a_program_that_was_killed(tmp_path: Path) -> None:
    import subprocess

    pytest.importorskip("paho.mqtt")
    with broker(tmp_path) as server, subscriber(server.port, "r/availability") as got:
        text = f"""
import sys, time
from poise.responses import Responses, config_of
mqtt = {{"type": "mqtt", "broker": "127.0.0.1", "port": {server.port}, "topic": "r"}}
stages = [{{"state": "tipping", "fire": ["m"]}}]
Responses(config_of({{"responders": {{"m": mqtt}}, "stages": stages}})).open()
time.sleep(60)
"""
        robot = subprocess.Popen([sys.executable, "-c", text])
        try:
            assert until(lambda: [each[1] for each in got] == ["online"], 30.0)
        finally:
            robot.kill()
            robot.wait()
        assert until(lambda: [each[1] for each in got] == ["online", "offline"])


def test_a_broker_that_dies_is_told_the_next_is_tried_and_told_again_when_it_is_back(tmp_path: Path) -> None:
    pytest.importorskip("paho.mqtt")
    with broker(tmp_path) as server, hook() as web:
        responders = {
            "mqtt": {"type": "mqtt", "broker": "127.0.0.1", "port": server.port, "topic": "r", "if_failed": ["spare"]},
            "web": {"type": "webhook", "url": web.url},
            "spare": {"type": "command", "argv": ["touch", str(tmp_path / "spared")], "spare": True},
            "log": dict(LOG),
        }
        with made(tmp_path, responders) as responses:
            server.stop()
            assert until(lambda: responses.failures)  # before anything is to be told
            assert until(lambda: any("mqtt failed" in body["sentence"] for _, body in web.got))
            responses.handle(TIPPING)
            assert until((tmp_path / "spared").exists)
            assert responses.wait()
            assert any(body["kind"] == "fired" for _, body in web.got)
            server.start()  # it remembers nothing
            assert until(lambda: any(line["kind"] == "recovered" for line in lines(tmp_path)), 20.0)
            with subscriber(server.port, "r/alarm") as late:
                assert until(lambda: late)
            assert json.loads(late[0][1])["state"] == "tipping" and late[0][2]


def test_brokers_that_do_not_take_us_are_refused(tmp_path: Path) -> None:
    pytest.importorskip("paho.mqtt")
    dead = {"type": "mqtt", "broker": "127.0.0.1", "port": free_port()}
    with pytest.raises(ResponseError, match=r"mqtt: the broker .* cannot be reached .*apt install mosquitto"):
        made(tmp_path, {"mqtt": dead}).open()
    with hook() as web:  # something else answers there
        other = {"type": "mqtt", "broker": "127.0.0.1", "port": web.server_address[1], "timeout": 0.5}
        with pytest.raises(ResponseError, match="does not answer as MQTT"):
            made(tmp_path, {"mqtt": other}).open()
    secret = {"type": "mqtt", "username": "u", "password": "${POISE_TEST_SECRET}"}
    with pytest.raises(ResponseError, match="the environment has no POISE_TEST_SECRET"):
        made(tmp_path, {"mqtt": secret}).open()


def test_the_webhook_gets_the_alarm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("POISE_TEST_TOKEN", "abc")
    with hook() as web:
        headers = {"Authorization": "Bearer ${POISE_TEST_TOKEN}"}
        with made(tmp_path, {"web": {"type": "webhook", "url": web.url, "headers": headers}}) as responses:
            responses.handle(TIPPING)
            assert responses.wait() and responses.failures == ()
        ((headers, body),) = web.got
        assert body["state"] == "tipping" and body["direction"] == "forward" and body["reason"] == "beyond 30°"
        assert headers["Content-Type"] == "application/json" and headers["Authorization"] == "Bearer abc"


@pytest.mark.parametrize(
    ("code", "delay", "says"), [(500, 0.0, "answered 500"), (302, 0.0, "redirected"), (200, 2.0, "in time")]
)
def test_a_webhook_without_a_good_answer_has_failed(tmp_path: Path, code: int, delay: float, says: str) -> None:
    with hook() as web:
        web.code, web.delay = code, delay
        with made(tmp_path, {"web": {"type": "webhook", "url": web.url, "timeout": 0.3}}) as responses:
            responses.handle(TIPPING)
            assert responses.wait()
            (failure,) = responses.failures
        assert says in failure.detail
    with pytest.raises(ResponseError, match="does not answer"):
        made(tmp_path, {"web": {"type": "webhook", "url": f"http://127.0.0.1:{free_port()}/"}}).open()


def test_a_command_is_told_what_happens(tmp_path: Path) -> None:
    script = f'cat > {tmp_path}/json; echo "$POISE_STATE $POISE_DIRECTION $POISE_TILT_DEG" > {tmp_path}/env'
    with made(tmp_path, {"stop": {"type": "command", "argv": ["sh", "-c", script]}}) as responses:
        responses.handle(TIPPING)
        assert responses.wait() and responses.failures == ()
    assert json.loads((tmp_path / "json").read_text())["state"] == "tipping"
    assert (tmp_path / "env").read_text().startswith("tipping forward 34.3")


@pytest.mark.parametrize(
    ("argv", "says"),
    [
        (["sh", "-c", "echo no motor >&2; exit 3"], "ended with code 3: no motor"),
        (["sleep", "30"], "still running after 0.3 s"),
        (["sh", "-c", "sleep 30 & wait"], "still running after 0.3 s"),
    ],
)
def test_a_command_that_fails_makes_the_next_one_try(tmp_path: Path, argv: list[str], says: str) -> None:
    responders = {
        "first": {"type": "command", "argv": argv, "timeout": 0.3, "if_failed": ["second", "third", "fourth"]},
        "second": {"type": "command", "argv": ["false"], "spare": True},
        "third": {"type": "command", "argv": ["touch", str(tmp_path / "third")], "spare": True},
        "fourth": {"type": "command", "argv": ["touch", str(tmp_path / "fourth")], "spare": True},
        "log": dict(LOG),
    }
    with made(tmp_path, responders) as responses:
        responses.handle(TIPPING)
        assert until((tmp_path / "third").exists)
        assert responses.wait()
        assert [failure.responder for failure in responses.failures] == ["first", "second"]
        assert says in responses.failures[0].detail and not (tmp_path / "fourth").exists()
    assert [line["responder"] for line in lines(tmp_path) if line["kind"] == "failure"] == ["first", "second"]


def test_a_background_child_does_not_make_a_command_fail(tmp_path: Path) -> None:
    argv = ["sh", "-c", "sleep 3 & exit 0"]
    with made(tmp_path, {"stop": {"type": "command", "argv": argv, "timeout": 1.0}}) as responses:
        responses.handle(TIPPING)
        assert responses.wait() and responses.failures == ()


def test_programs_that_are_not_there_are_refused_and_all_that_is_wrong_is_said(tmp_path: Path) -> None:
    (tmp_path / "text").write_text("no program")
    responders = {
        "one": {"type": "command", "argv": ["no-such-program"]},
        "two": {"type": "command", "argv": [str(tmp_path / "text")]},
        "log": {"type": "log", "file": "no/such/folder.jsonl"},
    }
    with pytest.raises(ResponseError) as refused:
        made(tmp_path, responders).open()
    for part in ("one.argv: no-such-program is not there", "chmod +x", "log.file:", "cannot be written"):
        assert part in str(refused.value)


def test_the_log_tells_the_whole_story(tmp_path: Path) -> None:
    (tmp_path / "alarms.jsonl").write_text('{"kind": "cut off by a power cut')
    with made(tmp_path, {"log": dict(LOG)}) as responses:
        for each in (UPRIGHT, TIPPING, TIPPING, TipEvent(13.0, TipState.UNKNOWN, TipState.TIPPING), UPRIGHT):
            responses.handle(each)
        responses.acknowledge()
    text = (tmp_path / "alarms.jsonl").read_text().splitlines()
    assert text[0] == '{"kind": "cut off by a power cut'
    told = [f"{line['kind']} {line['state']}" for line in map(json.loads, text[1:])]
    assert told == [
        "started unknown",
        "event upright",
        "fired tipping",
        "event tipping",
        "fired unknown",
        "event unknown",
        "released upright",
        "event upright",
        "released upright",
        "acknowledged upright",
        "closed unknown",
    ]


def test_a_log_without_room_is_a_failure_that_others_tell(tmp_path: Path) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    with hook() as web:
        responders = {"log": {"type": "log", "file": "/dev/full"}, "web": {"type": "webhook", "url": web.url}}
        with made(tmp_path, responders) as responses:
            assert until(lambda: any("log failed" in body["sentence"] for _, body in web.got))
            responses.handle(TIPPING)
            assert responses.wait()


def test_repetitions_come_by_themselves_and_do_not_pile_up(tmp_path: Path) -> None:
    with hook() as web:
        stage = {"state": "tipping", "fire": ["web"], "repeat": 0.05}
        with made(tmp_path, {"web": {"type": "webhook", "url": web.url}}, stage) as responses:
            responses.handle(TIPPING)
            assert until(lambda: len(web.got) >= 4)
            assert [body["count"] for _, body in web.got[:4]] == [1, 2, 3, 4]
            responses.acknowledge()
            assert responses.wait()
            many = len(web.got)
            web.delay = 0.6
            responses.handle(UPRIGHT)
            responses.handle(TIPPING)
            time.sleep(0.7)
            responses.acknowledge()
            assert responses.wait()
        assert len(web.got) - many <= 4  # of about fourteen that were due meanwhile


def test_slow_responders_do_not_hold_up_the_robot(tmp_path: Path, board: Any) -> None:
    with hook() as web:
        web.delay = 1.0
        responders = {
            "web": {"type": "webhook", "url": web.url},
            "sleep": {"type": "command", "argv": ["sleep", "1"]},
            "power": {"type": "relay", "pin": 17, "active_high": True},
        }
        with made(tmp_path, responders) as responses:
            responses.handle(TIPPING)
            assert board.pin(17).state and not responses.wait(0.1)
            assert responses.wait() and responses.failures == ()


def test_events_of_nothing_but_nan_and_nonsense_are_unknown_and_crash_nothing(tmp_path: Path, board: Any) -> None:
    responders = {"power": {"type": "relay", "pin": 17, "active_high": True}, "log": dict(LOG)}
    nan = math.nan
    with made(tmp_path, responders, unknown="as tipping") as responses:
        responses.handle(UPRIGHT)
        responses.handle(TipEvent(nan, TipState.LEANING, TipState.UPRIGHT, "", nan, nan, nan))
        assert not board.pin(17).state
        responses.handle(TipEvent(None, 99, "x", None, "y", [], object(), None))  # type: ignore[arg-type]
        assert board.pin(17).state
        responses.handle(None)  # type: ignore[arg-type]
    assert {"state": "unknown", "tilt_deg": None}.items() <= lines(tmp_path)[-2].items()


def test_alarms_are_not_swallowed_before_or_after(tmp_path: Path) -> None:
    responses = made(tmp_path, {"log": dict(LOG)})
    with pytest.raises(ResponseError, match="not open"):
        responses.handle(TIPPING)
    with responses:
        responses.handle(TIPPING)
    responses.close()
    with pytest.raises(ResponseError, match="not open"):
        responses.handle(UPRIGHT)


def test_it_is_in_the_front_door() -> None:
    assert poise.Responses is Responses
