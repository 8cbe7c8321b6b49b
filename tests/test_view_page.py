"""``poise view`` in a real browser: what is drawn is what was estimated."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import poise
from browsing import chromium, page_of, until
from data_files import data_path
from live_helpers import METHOD, serving
from poise.live.film import Film, Strip, of_attitude, of_recording
from poise.simulation import Sensor, forearm, measure

pytest.importorskip("starlette", reason="the extra `live` is not installed")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


def film_of(recording: poise.Recording) -> tuple[Film, poise.Attitude]:
    attitude = poise.estimate(poise.AdaptiveGain(), recording)
    return of_recording(recording, [Strip(METHOD, attitude)]), attitude


def drawn(page: Any, method: int, time: float) -> np.ndarray[Any, Any]:
    """w x y z of the body on the page at *time* from the start."""
    page.evaluate("time => poise.playhead.seek(time)", time)
    until(page, "poise.store.version === poise.painted()")
    [name] = page.evaluate("[...poise.store.devices.keys()]")
    return np.array(page.evaluate("([name, method]) => poise.drawn(name, method).quat", [name, method]), float)


def apart(p: Any, q: Any) -> float:
    """deg"""
    return float(np.degrees(2.0 * np.arccos(min(1.0, abs(float(np.dot(p, q)))))))


def test_a_real_trial_is_drawn_as_it_was_estimated(browser: Any, tmp_path: Path) -> None:
    recording = poise.read(data_path("broad", "05_undisturbed_slow_rotation_with_breaks_B.mat"))
    assert recording.truth is not None
    shown, attitude = film_of(recording)
    with serving(films=[shown]) as running, page_of(browser, f"http://{running.address}/?view") as page:
        until(page, "poise.store.devices.size === 1 && poise.store.edge() > 1")
        for at in (20.0, 61.5, 110.25):
            k = int(np.searchsorted(recording.time, recording.time[0] + at))
            assert (
                apart(drawn(page, 0, at), attitude.quat[k]) < 0.5
            )  # 8000 records of 200 s: the row is 25 ms off at most
            assert apart(drawn(page, 1, at), recording.truth.quat[k]) < 0.5
        table = page.locator(".errors").inner_text()
        assert f"{poise.evaluate(attitude, recording).rmse_deg().total:.2f}°" in table and "reference" in table
        page.locator(".stretch").first.click()
        first = min(each.start for method in (attitude, recording.truth) for each in method.reasons())
        assert page.evaluate("poise.playhead.time") == pytest.approx(first - recording.time[0], abs=0.01)


def test_it_plays_stops_and_is_scrubbed_by_keyboard(browser: Any) -> None:
    shown, _ = film_of(measure(forearm(20.0, rate=50.0), Sensor(), seed=2))
    with serving(films=[shown]) as running, page_of(browser, f"http://{running.address}/?view") as page:
        until(page, "poise.store.edge() > 1")
        page.select_option("#speed", "5")
        page.click("#play")
        until(page, "poise.playhead.time > 2")
        page.click("#play")
        at = page.evaluate("poise.playhead.time")
        page.wait_for_timeout(200)
        assert page.evaluate("poise.playhead.time") == at
        page.evaluate("document.activeElement.blur()")
        page.keyboard.press("ArrowRight")
        assert page.evaluate("poise.playhead.time") == pytest.approx(at + 1.0)
        page.keyboard.press("Space")
        until(page, "poise.playhead.time > poise.playhead.end - 1e-9 && !poise.playhead.playing")
        page.locator("#scrub").fill("3.5")
        assert page.evaluate("poise.playhead.time") == pytest.approx(3.5)
        assert "3.50 s of 20.0 s" in page.locator("#instant").inner_text()


def test_a_long_film_is_fetched_finely_where_it_is_looked_at(browser: Any) -> None:
    shown, attitude = film_of(measure(forearm(400.0, rate=100.0), Sensor(), seed=3))
    with serving(films=[shown]) as running, page_of(browser, f"http://{running.address}/?view") as page:
        until(page, "poise.store.edge() > 1")
        page.locator("label[for=window-5]").click()
        for at in (301.234, 12.345):  # it is looked at, fetched, and looked at again
            page.evaluate("time => poise.playhead.seek(time)", at)
            until(page, """at => { const { ring } = poise.store.mainTrack([...poise.store.devices.keys()][0]);
                const k = ring.find(at); return k >= 0 && at - ring.at(k) < 0.0101; }""", at)  # fmt: skip
            k = int(np.searchsorted(attitude.time, attitude.time[0] + at, side="right")) - 1
            assert apart(drawn(page, 0, at), attitude.quat[k]) < 0.05  # single precision


def test_two_films_have_tiles_at_phone_width(browser: Any) -> None:
    films = [film_of(measure(forearm(seconds, rate=50.0), Sensor(), seed=4))[0] for seconds in (5.0, 9.0)]
    with serving(films=films) as running:
        size = {"viewport": {"width": 390, "height": 844}, "color_scheme": "dark"}
        with page_of(browser, f"http://{running.address}/?view", **size) as page:
            until(page, "document.querySelectorAll('.tile').length === 2")
            assert page.evaluate("poise.playhead.end") == pytest.approx(8.98, abs=0.05)
            until(page, "document.documentElement.scrollWidth <= innerWidth")
            page.locator(".tile").last.click()
            page.wait_for_selector(".detail")
            until(page, "document.documentElement.scrollWidth <= innerWidth")


@pytest.mark.parametrize("address", ["", "?", "?x=1&view", "#/nobody", "#/%"])
def test_any_address_of_its_server_shows_the_recording(browser: Any, address: str) -> None:
    shown, _ = film_of(measure(forearm(5.0, rate=50.0), Sensor(), seed=5))
    with serving(films=[shown]) as running, page_of(browser, f"http://{running.address}/{address}") as page:
        page.locator(".errors").wait_for()
        until(page, "poise.store.edge() > 1")


def test_how_one_body_stood_seen_from_another_has_no_heading(browser: Any) -> None:
    _, attitude = film_of(measure(forearm(5.0, rate=50.0), Sensor(), seed=6))
    shown = of_attitude("elbow", attitude.relative_to(attitude[::2].resample(attitude.time)))
    with serving(films=[shown]) as running, page_of(browser, f"http://{running.address}/?view") as page:
        page.get_by_text("seen from another body").wait_for()
        assert page.locator(".chart h3").all_inner_texts() == ["Angle", "Turn", "Pitch", "Roll", "Rate"]


COLUMNS = """plot => {
    const canvas = document.querySelectorAll('.plot canvas')[plot], { width, height } = canvas;
    const copy = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, width, height);
    const blue = (x, y) => data[4 * (y * width + x)] < 120 && data[4 * (y * width + x) + 2] > 180;
    const heights = Array.from({ length: width }, (_, x) => [...Array(height).keys()].filter((y) => blue(x, y)).length);
    return [heights.slice(Math.round(0.12 * width), Math.round(0.97 * width)), height];
}"""


@pytest.mark.parametrize(("axis", "about", "plot"), [(2, 0.0, 0), (1, np.pi, 2)], ids=["north", "upside down"])
def test_an_angle_that_stays_beside_its_end_is_one_line(browser: Any, axis: int, about: float, plot: int) -> None:
    time = np.arange(0.0, 60.0, 0.02)
    half = (about + 0.1 * np.sin(9.0 * time) + 0.1 * np.sin(0.5 * time)) / 2.0
    quat = np.zeros((len(time), 4))
    quat[:, 0], quat[:, 1 + axis] = np.cos(half), np.sin(half)
    shown = of_attitude("steady", poise.Attitude.of(time, quat))
    with serving(films=[shown]) as running, page_of(browser, f"http://{running.address}/?view") as page:
        until(page, "poise.store.edge() > 1")
        line = columns(page, plot)
        assert np.mean(line > 0.0) > 0.99
        assert np.median(line) < 0.7
        page.evaluate("poise.playhead.seek(9)")  # where it is less than 360° or 180°
        said = page.locator(".chart").nth(plot).locator("b")
        until(page, "poise.store.version === poise.painted()")
        page.wait_for_timeout(300)
        k = int(np.searchsorted(time, 9.0))
        sign = -1.0 if axis == 2 else 1.0  # a heading is clockwise
        wanted = float(np.degrees(sign * 2.0 * half[k]))
        wanted = wanted % 360.0 if axis == 2 else (wanted + 180.0) % 360.0 - 180.0
        assert float(said.inner_text().replace("−", "-")) == pytest.approx(wanted, abs=1.0)


def test_an_alarm_moves_the_bodies_with_the_page(browser: Any) -> None:
    time = np.arange(0.0, 10.0, 0.02)
    tip = np.where(time > 5.0, 4, 1).astype(np.uint8)
    shown = of_attitude("robot", poise.Attitude.of(time, np.tile([1.0, 0.0, 0.0, 0.0], (len(time), 1))), tip)
    with serving(films=[shown]) as running, page_of(browser, f"http://{running.address}/?view") as page:
        until(page, "poise.store.edge() > 1")
        place = "[...document.querySelectorAll('#stage, .card .body')].map((e) => e.getBoundingClientRect().top)"
        page.wait_for_timeout(600)
        page.evaluate("poise.playhead.seek(6)")
        page.locator("#alarm", has_text="Fallen").wait_for()
        until(page, f"(([body, canvas]) => body > 100 && Math.abs(body - canvas) < 1.5)({place})")


def columns(page: Any, plot: int) -> np.ndarray[Any, Any]:
    """How much of each column of *plot* its line covers, as the picture stands once it stays the same."""
    found: list[Any] = []
    while len(found) < 3 or found[-1] != found[-3] or not any(found[-1][0]):
        assert len(found) < 60
        page.wait_for_timeout(400)
        found.append(page.evaluate(COLUMNS, plot))
    heights, height = found[-1]
    return np.array(heights) / height


@pytest.mark.parametrize(("axis", "plot"), [(2, 0), (1, 2)], ids=["heading", "roll"])
def test_an_angle_that_goes_round_is_drawn_without_lines_across_and_never_away(
    browser: Any, axis: int, plot: int
) -> None:
    time = np.arange(0.0, 100.0, 0.02)
    quat = np.zeros((len(time), 4))
    quat[:, 0], quat[:, 1 + axis] = np.cos(8.0 * time), np.sin(8.0 * time)  # once round in 0.4 s
    shown = of_attitude("top", poise.Attitude.of(time, quat))
    with serving(films=[shown]) as running, page_of(browser, f"http://{running.address}/?view") as page:
        until(page, "poise.store.edge() > 1")
        assert np.mean(columns(page, plot) > 0.3) > 0.95  # of all 255 turns: a solid band
        page.locator("label[for=window-5]").click()
        page.evaluate("poise.playhead.seek(50)")
        until(page, "poise.store.version === poise.painted()")
        slopes = columns(page, plot)  # of thirteen
        assert np.mean(slopes > 0.0) > 0.85
        assert slopes.max() < 0.25


def test_a_sigma_of_many_turns_leaves_the_angle_to_be_seen(browser: Any) -> None:
    recording = measure(forearm(10.0, rate=50.0), Sensor(), seed=2)
    attitude = poise.estimate(poise.AdaptiveGain(), recording)
    assert attitude.sigma is not None
    attitude.sigma[200:] = 100.0
    shown = of_attitude("wide", attitude)
    with serving(films=[shown]) as running, page_of(browser, f"http://{running.address}/?view") as page:
        page.evaluate("poise.playhead.seek(9)")
        until(page, "poise.ends('pitch')?.[1] > 60")
        low, high = page.evaluate("poise.ends('pitch')")
        assert -110.0 < low < -85.0 and 85.0 < high < 110.0
