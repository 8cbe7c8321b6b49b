"""Alarms that wait for a person, and what has become of a device, on the page of `poise live` in a real browser."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest
from numpy.typing import NDArray

from browsing import chromium
from dashboards import RATE, Shown, page_of, sending, turning
from live_helpers import METHOD, Running, ask, heard, serving, wait_for
from poise.data.event import TipState
from poise.live import frames
from poise.live.device import State
from poise.live.hub import HubError
from poise.live.watching import Watch
from poise.responses import Responses, config_of
from programs import mock_board

SOURCES = Path(__file__).parents[1] / "web" / "src"
HELD = "Alarm not acknowledged: “tips over” holds until it has been and robot stands upright."


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


@pytest.fixture
def board(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The pins of a mock board; beside other work a sender may pause, which is not to be an alarm of its own here."""
    monkeypatch.setattr("poise.live.device._SILENCE", 5.0)
    yield from mock_board(monkeypatch)


def guarded(**more: Any) -> Watch:
    """A robot whose power is cut when it tips over, until somebody has seen it."""
    power = {"type": "relay", "pin": 17, "active_high": True}
    stage = {"name": "tips over", "state": ["tipping", "fallen", "free fall"], "fire": ["power"]}
    watch = Watch(
        responses={"robot": Responses(config_of({"responders": {"power": power}, "stages": [stage], **more}))}
    )
    watch.warm()
    return watch


class Robot:
    """It stands, falls on its face after two seconds, and lies there until it is stood up."""

    def __init__(self, live: Running) -> None:
        self._live, self._falls, self._rises = live, 200, 10**9  # numbers of samples

    def samples(self, first: int, n: int) -> NDArray[np.float64]:
        k = np.arange(first - 1, first + n + 1)
        down, up = np.clip((k - self._falls) / RATE, 0.0, 1.0), np.clip((k - self._rises) / (2.0 * RATE), 0.0, 1.0)
        tilt = 1.5 * down**2 * 0.5 * (1.0 + np.cos(np.pi * up))
        rows = np.zeros((n, 10))
        rows[:, 0] = k[1:-1] / RATE
        rows[:, 1] = -0.5 * RATE * (tilt[2:] - tilt[:-2])
        sine, cosine = np.sin(tilt[1:-1]), np.cos(tilt[1:-1])
        rows[:, 5], rows[:, 6] = -9.81 * sine, 9.81 * cosine
        rows[:, 8], rows[:, 9] = 20.0 * cosine + 40.0 * sine, 20.0 * sine - 40.0 * cosine
        return rows

    def lies(self) -> None:
        """Waits until it lies, with an alarm that nobody has seen."""
        wait_for(lambda: self._live.hub.watch.responses["robot"].unacknowledged)
        wait_for(lambda: self._live.hub.devices["robot"].tip == TipState.FALLEN)

    def stand_up(self) -> None:
        self._rises = self._live.hub.devices["robot"].next + 50
        wait_for(lambda: self._live.hub.devices["robot"].tip in (TipState.UPRIGHT, TipState.RIGHTED))

    def fall_again(self) -> None:
        self._falls, self._rises = self._live.hub.devices["robot"].next + 50, 10**9
        self.lies()


@contextmanager
def running_robot(live: Running) -> Iterator[Robot]:
    robot = Robot(live)
    with sending(live, "robot", samples=robot.samples):
        robot.lies()
        yield robot


def acknowledged(live: Running) -> list[str]:
    return [event["text"] for event in live.hub.happened.all() if event["kind"] == "acknowledged"]


def button(page: Any) -> Any:
    return page.get_by_role("button", name="Acknowledge the alarm of robot")


# -- an alarm -------------------------------------------------------------------------------------------------------


def test_a_latched_alarm_is_acknowledged_with_the_keyboard(browser: Any, board: Any) -> None:
    with serving(watch=guarded()) as live, page_of(browser, live) as shown:
        responses = live.hub.watch.responses["robot"]
        page = shown.open()
        page.get_by_text("No device yet").wait_for()
        assert responses.active == ("start",)  # nobody has to see that
        assert button(page).count() == 0
        with running_robot(live) as robot:
            page.locator("#latched").get_by_text(HELD).wait_for()
            assert board.pin(17).state
            button(page).focus()
            page.keyboard.press("Enter")
            page.get_by_text("Acknowledged. Until robot stands upright, there holds: “tips over”.").wait_for()
            assert acknowledged(live) == ["robot: acknowledged; until it stands upright, there holds: tips over"]
            assert not button(page).is_visible()
            shown.waits_for("document.activeElement.closest('#latched') !== null")  # and not the page's top again
            assert (responses.active, responses.unacknowledged) == (("tips over",), ())
            assert board.pin(17).state  # it lies
            robot.stand_up()
            page.get_by_text("Acknowledged: nothing holds any more.").wait_for()
            assert responses.active == () and not board.pin(17).state
            shown.waits_for("document.querySelector('#latched').childElementCount === 0")
        shown.must_be_clean()


def test_one_that_nobody_saw_is_still_told_when_the_robot_stands_and_a_double_click_is_one(
    browser: Any, board: Any
) -> None:
    with serving(watch=guarded()) as live, page_of(browser, live) as shown:
        with sending(live, "other"), running_robot(live) as robot:
            page = shown.open("#/other")  # whichever view there is
            page.locator("#latched").get_by_text(HELD).wait_for()
            robot.stand_up()
            wait_for(lambda: page.inner_text("#alarm") == "")
            assert board.pin(17).state
            button(page).dblclick()
            page.get_by_text("Acknowledged: nothing holds any more.").wait_for()
            assert acknowledged(live) == ["robot: acknowledged"]
            assert not board.pin(17).state
            page.locator("#latched").get_by_role("link", name="robot").click()
            page.get_by_role("heading", name="robot").wait_for()
        shown.must_be_clean()


def test_the_next_alarm_is_acknowledged_by_a_press_of_its_own(browser: Any, board: Any) -> None:
    with serving(watch=guarded()) as live, page_of(browser, live) as shown:
        page = shown.open()
        with running_robot(live) as robot:
            button(page).click()
            page.get_by_text("Acknowledged. Until robot").wait_for()
            robot.stand_up()
            robot.fall_again()
            page.locator("#latched").get_by_text(HELD).wait_for()
            assert len(acknowledged(live)) == 1
            button(page).dblclick()
            page.get_by_text("Acknowledged. Until robot").wait_for()
            assert len(acknowledged(live)) == 2
        shown.must_be_clean()


def test_what_the_server_refuses_is_said_and_can_be_asked_again(
    browser: Any, board: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(name: str) -> list[str]:
        raise HubError(f"{name} cannot be acknowledged just now")

    with serving(watch=guarded()) as live:
        port = int(live.address.rpartition(":")[2])
        shown = Shown(browser, live)
        page = shown.open()
        with running_robot(live):
            pass
        with monkeypatch.context() as patch:
            patch.setattr(live.server, "acknowledge", refused)
            button(page).click()
            page.get_by_text("Not acknowledged: robot cannot be acknowledged just now").wait_for()
            assert live.hub.watch.responses["robot"].unacknowledged == ("tips over",)
        shown.waits_for("document.querySelector('#latched button').ariaDisabled === 'false'")
        shown.must_be_clean()
    page.get_by_text("Connection lost").first.wait_for()
    button(page).click()
    page.get_by_text("No answer: there is no connection to the server").wait_for()
    with serving(port=port, watch=guarded()):  # it knows nothing of that alarm, and nobody has acknowledged it
        page.locator(".link[data-state=open]").wait_for()
        shown.waits_for("document.querySelector('#latched').childElementCount === 0")
        assert page.evaluate("window.violations") == []
        shown.context.close()


def test_who_may_only_look_is_told_so(browser: Any, board: Any) -> None:
    every, reader = "e" * 20, "r" * 20
    tokens = {every: frozenset({"read", "write", "device"}), reader: frozenset({"read"})}
    # an alarm of a robot that never comes is one, too: what is unknown is answered as if it tipped over
    with serving(watch=guarded(unknown="as tipping"), tokens=tokens) as live, page_of(browser, live) as shown:
        page = shown.open(f"#token={reader}")
        page.locator("#latched").get_by_text("This needs a token with the scope “write”.").wait_for()
        assert button(page).is_disabled()
        with live.viewer(additional_headers={"Authorization": f"Bearer {reader}"}) as viewer:
            assert heard(viewer, "health")["alarms"] == [
                {"device": "robot", "holding": ["tips over", "start"], "unacknowledged": ["tips over"]}
            ]
        page.evaluate("address => location.href = address", f"http://{live.address}/#token={every}")
        shown.waits_for("document.querySelector('#latched button')?.disabled === false")
        button(page).click()
        page.get_by_text("there holds: “tips over”, “start”.").wait_for()
        assert len(acknowledged(live)) == 1
        shown.must_be_clean()


def test_the_answer_to_a_viewer_and_the_health_say_what_holds(board: Any) -> None:
    with serving(watch=guarded()) as live, live.viewer() as viewer:
        assert heard(viewer, "health")["alarms"] == [{"device": "robot", "holding": ["start"], "unacknowledged": []}]
        assert ask(viewer, type="acknowledge", device="robot")["holding"] == ["start"]
        assert live.http.get("/healthz").json()["alarms"][0]["holding"] == ["start"]


# -- the states of a device -----------------------------------------------------------------------------------------


def test_the_page_knows_every_state_that_the_server_sends() -> None:
    (known,) = re.findall(r"type DeviceState = (.*);", (SOURCES / "protocol.ts").read_text(encoding="utf-8"))
    assert [word.strip('"') for word in known.split(" | ")] == list(get_args(State))


def failing(*_: Any, **__: Any) -> Any:
    raise ArithmeticError("a method's own")


def test_a_run_that_a_fault_has_ended_says_so_and_how_it_begins_anew(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown:
        with sending(live, "band"):
            page = shown.open()
            page.locator(".verdict", has_text=re.compile("^Valid$")).wait_for()
            page.locator("summary").first.click()
        live.call(lambda: setattr(live.hub.find("band").runs[0].stream, "update_rows", failing))
        with live.device("band") as band:
            band.send(frames.encoded(turning(live.hub.find("band").next, 1), live.hub.find("band").next))
            wait_for(lambda: live.hub.find("band").failed)
        link = page.get_by_role("region", name="Link")
        link.get_by_text("ended by a fault").wait_for()
        note = page.locator(".remedy").get_by_text(
            "ArithmeticError: a method's own. Nothing more is taken from it until it begins anew"
        )
        note.wait_for()
        shown.waits_for("document.querySelector('.why').textContent.includes('its run has ended by a fault')")
        assert "no sample has arrived" not in page.inner_text(".why")
        page.get_by_role("button", name="Apply").click()  # as the note says
        wait_for(lambda: not live.hub.find("band").failed)
        with sending(live, "band", first=live.hub.find("band").next):
            page.locator(".verdict", has_text=re.compile("^Valid$")).wait_for()
            shown.waits_for("document.querySelector('.remedy').textContent === ''")
        shown.must_be_clean()


def test_a_clock_that_stands_still_says_so(browser: Any) -> None:
    stood: list[float] = []

    def samples(first: int, n: int) -> NDArray[np.float64]:
        rows = turning(first, n)
        rows[:, 0] = stood[0] if stood else rows[:, 0]
        return rows

    with serving() as live, page_of(browser, live) as shown, sending(live, "band", samples=samples):
        page = shown.open()
        page.locator(".verdict", has_text=re.compile("^Valid$")).wait_for()
        stood.append(live.hub.find("band").next / RATE)
        link = page.get_by_role("region", name="Link")
        link.get_by_text("clock stands still").wait_for()
        page.locator(".remedy").get_by_text("See to what stamps its samples").wait_for()
        shown.waits_for("document.querySelector('.why').textContent.includes('the clock in them stands still')")
        assert "no sample has arrived" not in page.inner_text(".why")
        stood.clear()  # and it goes on by itself
        page.locator(".verdict", has_text=re.compile("^Valid$")).wait_for()
        shown.waits_for("document.querySelector('.remedy').textContent === ''")
        shown.must_be_clean()


def test_every_other_state_has_words_too(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown, live.device("waits"), live.device("loads") as loads:
        wait_for(lambda: "loads" in live.hub.devices)
        live.call(live.hub.find("loads").runs.clear)
        loads.send(frames.encoded(turning(0, 10), 0))
        with sending(live, "goes"):
            wait_for(lambda: "goes" in live.hub.devices and live.hub.devices["goes"].done > 10)
        wait_for(lambda: live.hub.devices["goes"].health.silent)
        live.call(lambda: live.hub.set_joint("bend", "goes", "waits"))
        states = {each["id"]: each["state"] for each in live.server.health()["devices"]}
        assert states == {"waits": "waiting", "loads": "starting", "goes": "silent", "bend": "silent"}
        page = shown.open()
        for name, word in (("waits", "waiting for samples"), ("loads", "loading its method"), ("goes", "silent")):
            page.locator(".tile", has_text=name).get_by_text(word).wait_for()
        told = {
            "waits": "See that it is switched on",
            "loads": "Its samples wait until the method is loaded",
            "goes": "See to its power, its cable or radio",
            "bend": "One of its two devices is not live",
        }
        for name, text in told.items():
            page.evaluate("name => location.hash = `#/${name}`", name)
            page.locator(".remedy").get_by_text(text).wait_for()
        live.call(lambda: live.hub.set_methods(live.hub.find("loads"), live.hub.methods))
        with sending(live, "goes", "waits", "loads"):
            page.evaluate("location.hash = '#/loads'")
            page.get_by_role("region", name="Methods").get_by_text(METHOD).first.wait_for(state="attached")
            shown.waits_for("document.querySelector('.remedy').textContent === ''")
        shown.must_be_clean()
