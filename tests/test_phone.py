"""A phone is a device: a real browser at `/phone`, fed with recorded motion, against the offline estimate of it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import poise
from browsing import chromium, until
from data_files import data_path
from live_helpers import METHOD, seen, serving, wait_for
from poise.live.address import own_addresses
from poise.live.certificate import own_certificate
from poise.live.methods import Choice

DEVICE = "device-token-of-16"
READ = "reading-token-of-16"
TOKENS = {DEVICE: frozenset({"device"}), READ: frozenset({"read"})}
# As a browser's clock: the page is not told that it plays fast.
PLAYER = """
const real = performance.now.bind(performance);
let at = null;
performance.now = () => at ?? real();
window.play = async (rows, speed) => {
  const began = real(), from = at ?? real() + 1000;
  for (const [time, rate, acc, angles] of rows) {
    while ((real() - began) * speed < 1000 * (time - rows[0][0])) await new Promise((done) => setTimeout(done, 1));
    at = from + 1000 * (time - rows[0][0]);
    const [x, y, z] = acc, [alpha, beta, gamma] = rate;
    const turned = angles && { alpha: angles[0], beta: angles[1], gamma: angles[2] };
    if (turned) dispatchEvent(new DeviceOrientationEvent("deviceorientation", turned));
    const event = new DeviceMotionEvent("devicemotion", {
      accelerationIncludingGravity: { x, y, z }, rotationRate: { alpha, beta, gamma }, interval: 14 });
    Object.defineProperty(event, "timeStamp", { value: at });
    dispatchEvent(event);
  }
  at += 100;
};
"""


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium("--host-resolver-rules=MAP phone.test 127.0.0.1") as found:
        yield found


@pytest.fixture(scope="module")
def motion() -> tuple[poise.Recording, NDArray[np.float64]]:
    """A stretch of a real recording at 71 samples a second, without a magnetometer, and its reference (n, 4) x y z w."""
    found = poise.read(data_path("broad", "05_undisturbed_slow_rotation_with_breaks_B.mat"))
    assert found.moving is not None
    assert found.truth is not None
    begin = int(np.flatnonzero(found.moving)[0])
    n, step = 1600, 4
    rows = slice(begin, begin + n * step)
    gyr, acc = (getattr(found, name)[rows].reshape(n, step, 3).mean(axis=1) for name in ("gyr", "acc"))
    time = found.time[rows][step - 1 :: step] - found.time[rows][step - 1]
    quat = found.truth.to("enu").quat[rows][step - 1 :: step]
    return poise.Recording(time, gyr, acc), quat[:, [1, 2, 3, 0]]


def events(
    recording: poise.Recording, truth: NDArray[np.float64], sign: float, order: tuple[int, int, int], off: float = 4.0
) -> list[Any]:
    """What the browser of such a phone would say; its own orientation is *off* degrees wrong, and its north is elsewhere."""
    wrong = Rotation.from_euler("zx", [137.0, off], degrees=True) * Rotation.from_quat(np.nan_to_num(truth, nan=0.5))
    angles = wrong.as_euler("ZXY", degrees=True)
    known = np.isfinite(truth).all(axis=1)
    rates = np.degrees(recording.gyr)[:, list(order)]
    return [
        [t, rate.tolist(), (sign * acc).tolist(), angle.tolist() if there else None]
        for t, rate, acc, angle, there in zip(recording.time, rates, recording.acc, angles, known, strict=True)
    ]


def apart(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Degrees between attitudes w x y z."""
    return np.degrees(2.0 * np.arccos(np.clip(np.abs(np.sum(a * b, axis=1)), 0.0, 1.0)))


@contextmanager
def phone(browser: Any, address: str, token: str = DEVICE, name: str = "pocket", **options: Any) -> Iterator[Any]:
    """The page at *address*, its form filled in."""
    context = browser.new_context(viewport={"width": 390, "height": 844}, ignore_https_errors=True, **options)
    try:
        page = context.new_page()
        problems: list[str] = []
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.on("console", lambda line: problems.append(line.text) if line.type == "error" else None)
        page.problems = problems
        page.add_init_script(PLAYER)
        page.goto(f"{address}/phone" + (f"#token={token}" if token else ""))
        page.fill("#name", name)
        yield page
    finally:
        context.close()


def begin(page: Any) -> None:
    """Taps Start and waits until the phone is connected."""
    page.click("#start")
    page.wait_for_selector("#state[data-tone=good]")


def play(page: Any, rows: list[Any], speed: float = 4.0) -> None:
    page.evaluate("([rows, speed]) => play(rows, speed)", [rows, speed])


@pytest.mark.parametrize(
    ("sign", "order"), [(1.0, (2, 0, 1)), (-1.0, (0, 1, 2))], ids=["as the standard says", "as iOS does"]
)
def test_a_phones_attitude_is_that_of_its_recording(
    browser: Any, motion: Any, tmp_path: Path, sign: float, order: tuple[int, int, int]
) -> None:
    recording, truth = motion
    offline = poise.estimate(Choice.of(METHOD).method(), recording)
    files = own_certificate(["localhost", "127.0.0.1"], tmp_path)
    told: list[NDArray[np.void]] = []
    with serving(tokens=TOKENS, certificate=files) as running, phone(browser, f"https://{running.address}") as page:
        begin(page)
        # not over a socket: a client in threads that reads and writes one TLS connection at once can hang
        running.call(lambda: running.hub.on_batch.append(lambda batch: told.append(batch.records())))
        play(page, events(recording, truth, sign, order))
        wait_for(lambda: sum(map(len, told)) >= len(recording) - 5)
        found = np.concatenate(told)[: len(recording) - 5]
        until(page, "document.querySelector('#valid').textContent === 'yes'")
        tilts = np.degrees(offline.tilt()[-150:]).tolist()
        until(page, f"{tilts}.some((t) => Math.abs(t - parseFloat(document.querySelector('#tilt').textContent)) < 0.2)")
        # all at one instant: the page goes on
        *texts, style = page.evaluate(
            "[...['tilt', 'heading'].map((name) => document.getElementById(name).textContent),"
            " document.querySelector('#slab').style.transform]"
        )
        shown, heading = (float(text.rstrip("°")) for text in texts)
        drawn = re.search(r"matrix3d\((.*)\)", style)
        assert page.problems == []
        assert "#token" not in page.url
    assert drawn is not None
    turned = np.array([float(v) for v in drawn[1].split(",")]).reshape(4, 4)  # CSS: x right, y down, z to the eye
    up_the_screen, out_of_it = -turned[1], turned[2]
    assert np.degrees(np.arccos(-out_of_it[1])) == pytest.approx(shown, abs=0.2)
    assert abs(np.degrees(np.arctan2(up_the_screen[0], -up_the_screen[2])) - heading + 180) % 360 == pytest.approx(
        180, abs=1
    )
    device = running.hub.devices["pocket"]
    assert device.shape == "phone"
    assert device.health.lost == device.health.repeated == device.health.rejected == 0
    np.testing.assert_array_equal(found["sequence"], np.arange(len(found)))
    np.testing.assert_allclose(found["time"] - found["time"][0], recording.time[: len(found)], atol=2e-6)
    np.testing.assert_allclose(found["acc"], recording.acc[: len(found)], rtol=1e-6)
    assert apart(found["quat"].astype(float), offline.quat[: len(found)]).max() < 0.05
    browsers = Rotation.from_euler("zx", [137.0, 4.0], degrees=True) * Rotation.from_quat(np.nan_to_num(truth, nan=0.5))
    assert apart(browsers.as_quat()[: len(found), [3, 0, 1, 2]], offline.quat[: len(found)]).min() > 3.0


def test_a_phone_that_shows_the_dashboard_gets_to_its_page_by_a_tap(browser: Any) -> None:
    everything = "every-token-of-16"
    with serving(tokens={everything: frozenset({"read", "write", "device"})}) as running:
        context = browser.new_context(viewport={"width": 390, "height": 844})
        page = context.new_page()
        page.goto(f"http://{running.address}/#token={everything}")
        page.get_by_role("button", name="phone").click()
        page.get_by_role("dialog").get_by_text("no phone can get here").wait_for()  # as it serves this machine only
        page.get_by_role("link", name="Open that page here").click()
        page.wait_for_selector("#start:enabled")
        page.fill("#name", "pocket")
        begin(page)
        wait_for(lambda: "pocket" in running.hub.devices)
        assert everything not in page.url
        context.close()


def test_a_start_tapped_before_the_page_is_ready_is_not_lost(browser: Any) -> None:
    with serving() as running:
        context = browser.new_context(viewport={"width": 390, "height": 844})
        page = context.new_page()
        held: list[Any] = []

        def hold(route: Any) -> None:
            held.append(route)

        page.route("**/phone.js", hold)
        page.goto(f"http://{running.address}/phone", wait_until="commit")
        page.fill("#name", "early")
        assert page.locator("#start").is_disabled()  # or the browser would send the form itself, and the page with it
        while not held:
            page.wait_for_timeout(20)
        held[0].continue_()
        begin(page)
        wait_for(lambda: "early" in running.hub.devices)
        context.close()


def test_cut_connections_lose_nothing(browser: Any, motion: Any) -> None:
    recording, truth = motion
    rows = events(recording, truth, 1.0, (2, 0, 1))
    with serving() as running, phone(browser, f"http://{running.address}", token="") as page:
        begin(page)
        with running.viewer(every=True) as viewer:
            for at in range(0, len(rows), 400):
                play(page, rows[at : at + 400])
                running.call(
                    lambda: [running.server.spawn(s._close(1012, "cut")) for s in running.server.device_sockets]
                )
                until(page, "document.querySelector('#state').dataset.tone === 'warn'")
                page.wait_for_selector("#state[data-tone=good]")
            found = seen(viewer, len(recording) - 5)
        health = running.hub.devices["pocket"].health
    np.testing.assert_array_equal(found["sequence"], np.arange(len(found)))
    np.testing.assert_allclose(found["acc"], recording.acc[: len(found)], rtol=1e-6)
    assert health.lost == 0
    axes = [event for event in running.hub.happened.all() if event["kind"] == "axes"]
    assert len(axes) == 1  # the page was told them and tells them again


def test_a_server_that_was_restarted_is_sent_what_it_does_not_have(browser: Any, motion: Any) -> None:
    recording, truth = motion
    rows = events(recording, truth, -1.0, (0, 1, 2))
    with ExitStack() as first, ExitStack() as second:
        running = first.enter_context(serving())
        page = second.enter_context(phone(browser, f"http://{running.address}", token=""))
        begin(page)
        play(page, rows[:500])
        first.close()
        page.wait_for_selector("#state[data-tone=warn]")
        play(page, rows[500:600])
        again = second.enter_context(serving(port=running.server.options.port))
        page.wait_for_selector("#state[data-tone=good]")
        play(page, rows[600:800])
        wait_for(lambda: again.hub.devices["pocket"].next > 790)
        device = again.hub.devices["pocket"]
        assert (device.health.samples, device.health.lost, device.shape) == (device.next, 0, "phone")
        assert not [event for event in again.hub.happened.all() if event["kind"] == "axes"]  # the page knew them


def test_a_lasting_difference_from_the_browsers_own_orientation_is_an_event(browser: Any, motion: Any) -> None:
    recording, truth = motion
    good = events(recording, truth, -1.0, (0, 1, 2), off=2.0)
    bad = events(recording, truth, -1.0, (0, 1, 2), off=50.0)
    with serving() as running, phone(browser, f"http://{running.address}", token="") as page:
        begin(page)
        play(page, [*good[:600], *bad[600:1100], *good[1100:]])
        wait_for(lambda: len([e for e in running.hub.happened.all() if e["kind"] == "opinion"]) == 2)
        texts = [event["text"] for event in running.hub.happened.all() if event["kind"] == "opinion"]
    assert "differs in tilt" in texts[0]
    assert "agrees again" in texts[1]


def test_what_cannot_be_told_is_not_sent_on(browser: Any, motion: Any) -> None:
    recording, truth = motion
    rows = events(recording, truth, 1.0, (2, 0, 1))
    silent = [[time, rate, acc, None] for time, rate, acc, _ in rows[:300]]
    with serving() as running, phone(browser, f"http://{running.address}", token="") as page:
        begin(page)
        play(page, silent)
        until(page, "document.querySelector('#hint').textContent.includes('gives no orientation')")
        assert running.hub.devices["pocket"].health.samples == 0
        assert page.text_content("#tilt") == "–"
        play(page, rows)
        wait_for(lambda: running.hub.devices["pocket"].health.samples > 1000)
        until(page, "document.querySelector('#hint').hidden")


def test_over_plain_http_the_page_says_that_there_are_no_sensors(browser: Any) -> None:
    with serving(hosts=("phone.test",)) as running:
        port = running.server.options.port
        context = browser.new_context()
        page = context.new_page()
        page.goto(f"http://phone.test:{port}/phone#token={DEVICE}")
        assert page.text_content("#problem-title") == "No sensors over plain HTTP"
        assert "--https" in page.text_content("#problem-code")
        assert page.get_attribute("#problem-link", "href") == f"https://phone.test:{port}/phone#token={DEVICE}"
        assert not page.is_visible("#setup")
        context.close()


@pytest.mark.parametrize(("answer", "title"), [("denied", "Not permitted"), (None, "The browser did not ask you")])
def test_without_permission_nothing_is_sent(browser: Any, answer: str | None, title: str) -> None:
    body = f"return {answer!r}" if answer else "throw new Error('no tap')"
    with serving() as running, phone(browser, f"http://{running.address}", token="") as page:
        page.evaluate(f"() => {{ DeviceMotionEvent.requestPermission = async () => {{ {body} }} }}")
        page.click("#start")
        page.wait_for_selector("#problem:not([hidden])")
        assert page.text_content("#problem-title") == title
        assert page.is_visible("#start")
        page.evaluate("() => { DeviceMotionEvent.requestPermission = async () => 'granted' }")
        page.click("#start")
        page.wait_for_selector("#state[data-tone=good]")
        assert not page.is_visible("#problem")


def test_a_machine_without_sensors_says_so(browser: Any) -> None:
    with serving() as running, phone(browser, f"http://{running.address}", token="") as page:
        begin(page)
        page.wait_for_selector("#problem:not([hidden])")
        assert page.text_content("#problem-title") == "No sensor answers"


def test_a_phone_without_a_gyroscope_says_so(browser: Any, motion: Any) -> None:
    rows = [[time, [None] * 3, acc, angles] for time, _, acc, angles in events(*motion, 1.0, (2, 0, 1))[:20]]
    with serving() as running, phone(browser, f"http://{running.address}", token="") as page:
        begin(page)
        play(page, rows)
        page.wait_for_selector("#problem:not([hidden])")
        assert page.text_content("#problem-title") == "No gyroscope"
        assert running.hub.devices["pocket"].health.samples == 0


def test_a_wrong_token_and_a_hidden_page_are_told(browser: Any) -> None:
    with serving(tokens=TOKENS) as running:
        with phone(browser, f"http://{running.address}", token="not-the-right-token") as page:
            page.click("#start")
            page.wait_for_selector("#state[data-tone=bad]")
            assert "no valid token" in page.text_content("#state")
        with phone(browser, f"http://{running.address}") as page:
            begin(page)
            for state in ("hidden", "visible"):
                page.evaluate(
                    f"Object.defineProperty(document, 'visibilityState', {{ value: {state!r}, configurable: true }})"
                )
                page.evaluate("document.dispatchEvent(new Event('visibilitychange'))")
                page.wait_for_timeout(600)
            notes = [event["text"] for event in running.hub.happened.all() if event["kind"] == "note"]
            assert "is hidden" in notes[0]
            assert "shown again" in notes[1]
            assert "was hidden for 1 s" in page.text_content("#notes")
            page.click("#stop")
            assert page.text_content("#state") == "Stopped"
            wait_for(lambda: not running.server.device_sockets)


def test_the_dashboard_shows_the_code_to_those_who_may_write(browser: Any) -> None:
    if not own_addresses():
        pytest.skip("this machine is in no network")
    full = "a-token-for-all-of-it"
    tokens = {DEVICE: frozenset({"device"}), full: frozenset({"read", "write"})}
    with serving(host="0.0.0.0", tokens=tokens, phone_token=DEVICE) as running, browser.new_context() as context:
        page = context.new_page()
        page.goto(f"http://{running.address}/#token={full}")
        page.click("#phone")
        page.wait_for_selector("dialog[open] img")
        until(page, "document.querySelector('dialog[open] img').naturalWidth > 0")
