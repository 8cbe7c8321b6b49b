"""The page of `poise live`, as a real browser shows it: what is drawn, what can be done, what happens when things go wrong."""

from __future__ import annotations

import csv
import hashlib
import math
import re
import time
from collections.abc import Iterator
from contextlib import ExitStack
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.image import imread
from numpy.typing import NDArray

import poise
from browsing import chromium
from dashboards import RATE, TURN, Shown, falling, page_of, sending, turning
from live_helpers import seen, serving, wait_for
from poise.live import frames
from poise.live.server import DASHBOARD
from poise.live.watching import Watch

WEB = Path(__file__).parents[1] / "web"


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


def test_the_bundle_is_that_of_the_sources() -> None:
    digest = hashlib.sha256()
    names = [f"src/{path.name}" for path in (WEB / "src").iterdir()] + ["build.mjs", "package.json", "tsconfig.json"]
    for name in sorted(names):
        digest.update(f"{name}\0".encode() + (WEB / name).read_bytes() + b"\0")
    kept = (DASHBOARD / "sources.sha256").read_text().strip()
    assert kept == digest.hexdigest(), "the bundle is older than its sources: cd web && npm install && npm run build"


def test_the_bundle_names_its_licences_and_no_other_host() -> None:
    licences = (DASHBOARD / "LICENSES.txt").read_text()
    assert "three 0." in licences
    assert "uplot 1." in licences
    assert licences.count("MIT License") == 2
    page = (DASHBOARD / "index.html").read_text()
    assert "://" not in page
    assert "style=" not in page


def test_an_empty_server_says_how_devices_come(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown:
        page = shown.open()
        page.get_by_text("No device yet").wait_for()
        assert f"ws://{live.address}/ws/device/NAME" in page.inner_text("main")
        shown.must_be_clean()


def test_the_body_turns_as_the_device_turns(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown, live.viewer(every=True) as viewer:
        with sending(live, "turntable"):
            shown.open()
            shown.waits_for("window.poise.drawn('turntable')?.sequence > 100")
            pairs: list[Any] = []
            end = time.monotonic() + 20.0  # beside other work a picture in software may take a second
            while len(pairs) < 8 or (len({pair["sequence"] for pair in pairs}) <= 3 and time.monotonic() < end):
                pairs.append(shown.drawn("turntable"))
                time.sleep(0.15)
            last = max(pair["sequence"] for pair in pairs if pair)
            records = seen(viewer, last + 1)
        sent = {int(record["sequence"]): record for record in records}
        assert len({pair["sequence"] for pair in pairs}) > 3
        assert any(pair["valid"] for pair in pairs)  # a busy machine's sender pauses now and then: not valid, rightly
        for pair in pairs:
            record = sent[pair["sequence"]]
            np.testing.assert_allclose(pair["quat"], record["quat"], atol=1e-6)
            # and it is what the device did: to the left by TURN, so that the heading falls
            w, _, _, z = pair["quat"]
            error = 2 * math.atan2(z, w) - TURN * pair["sequence"] / RATE
            assert abs((error + math.pi) % (2 * math.pi) - math.pi) < math.radians(6)
        shown.must_be_clean()


def test_silence_is_not_valid_and_says_why(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown:
        with sending(live, "band"):
            page = shown.open()
            page.locator(".verdict", has_text=re.compile("^Valid$")).wait_for()
        page.locator(".verdict", has_text="Not valid").wait_for()
        assert "no sample has arrived in time" in page.inner_text(".why")
        page.locator(".lane.invalid", has_text="silent").wait_for()
        shown.waits_for("window.poise.drawn('band').valid === false")
        shown.must_be_clean()


def test_methods_and_parameters_change_on_the_page(browser: Any) -> None:
    with serving(methods=("adaptive-gain", "two-stage")) as live, page_of(browser, live) as shown:
        with sending(live, "band"):
            page = shown.open()
            page.get_by_label("Stop two-stage").click()
            wait_for(lambda: [m["name"] for m in live.http.get("/devices").json()[0]["methods"]] == ["adaptive-gain"])
            page.locator("#method-add").select_option("two-stage")
            wait_for(lambda: len(live.http.get("/devices").json()[0]["methods"]) == 2)
            shown.waits_for("window.poise.drawn('band', 1)?.sequence > 0")
            page.locator("summary").nth(1).click()
            field = page.locator(".method").nth(1).locator("input[type=number]").first
            name = field.get_attribute("id").split("-", 2)[2]
            field.fill("0.123")
            page.locator(".method").nth(1).get_by_role("button", name="Apply").click()
            wait_for(lambda: f'"{name}": 0.123' in live.http.get("/devices").json()[0]["methods"][1]["settings"])
            page.get_by_text("(1 changed)").wait_for()
        shown.must_be_clean()


def test_what_a_method_does_not_take_is_said(browser: Any) -> None:
    with serving(methods=("two-stage",)) as live, page_of(browser, live) as shown:
        with sending(live, "band"):
            page = shown.open()
            page.locator("summary").first.click()
            page.evaluate("document.querySelector('.parameters').noValidate = true")
            page.locator(".method input[type=number]").first.fill("-1e9")
            page.get_by_role("button", name="Apply").click()
            page.locator(".panel .answer.bad").wait_for()
            assert live.http.get("/devices").json()[0]["methods"][0]["settings"] == "{}"
        shown.must_be_clean()


def test_pause_scrub_and_download(browser: Any, tmp_path: Path) -> None:
    with serving() as live, page_of(browser, live, accept_downloads=True) as shown:
        with sending(live, "turntable"):
            page = shown.open()
            shown.waits_for("window.poise.drawn('turntable')?.sequence > 20")
        page.locator(".lane", has_text="silent").wait_for()  # is a row, too
        with sending(live, "turntable", first=live.hub.devices["turntable"].next) as source:
            shown.waits_for("window.poise.drawn('turntable')?.sequence > 300")
            page.get_by_role("button", name="Pause").click()
            time.sleep(1.5)  # for the redraw, and what was on its way
            stopped = shown.drawn("turntable")
            before = source.sent
            wait_for(lambda: source.sent > before + 50)
            assert shown.drawn("turntable") == stopped
            page.locator("#scrub").focus()
            for _ in range(20):
                page.keyboard.press("ArrowLeft")
            page.keyboard.press("PageDown")
            shown.waits_for(f"window.poise.drawn('turntable').sequence < {stopped['sequence'] - 20}")
            assert "s" in page.inner_text("#instant")
            page.get_by_role("button", name="Back to now").click()
            shown.waits_for(f"window.poise.drawn('turntable').sequence > {before + 50}")
            page.locator("body").press("Space")
            page.get_by_role("button", name="Back to now").click()
            page.get_by_role("button", name="Download").click()
            with page.expect_download() as download:
                page.get_by_role("button", name="Save as CSV").click()
            download.value.save_as(tmp_path / "held.csv")
        with (tmp_path / "held.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        assert len(rows) > 20
        assert {row["device"] for row in rows} == {"turntable"}
        for row in rows[::10]:
            expected = turning(int(row["sequence"]), 1)[0]
            found = [float(value) for name, value in row.items() if name.endswith(")")]
            np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-5)
        recording, attitude = poise.read(tmp_path / "held.csv"), poise.read_attitude(tmp_path / "held.csv")
        assert recording.time.tolist() == [float(row["time (s)"]) for row in rows] == attitude.time.tolist()
        np.testing.assert_allclose(
            recording.mag, turning(0, 10**4)[[int(row["sequence"]) for row in rows], 7:10], rtol=1e-5, atol=1e-5
        )
        np.testing.assert_allclose(attitude.quat[:, 0], [float(row["qw"]) for row in rows])
        silent = [bool(int(row["flags"]) & poise.Flag.SILENT) for row in rows]
        assert any(silent) and silent == ["SILENT" in row["flag_names"].split("|") for row in rows]
        assert not any(int(row["valid"]) for row in rows if "SILENT" in row["flag_names"])
        shown.must_be_clean()


def test_this_way_is_forward(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown:
        with sending(live, "phone", samples=_still):
            page = shown.open()
            page.get_by_text("0° is magnetic north").wait_for()
            shown.waits_for("parseFloat(document.querySelector('.figure').textContent) > 60")
            page.get_by_role("button", name="This way is forward").click()
            page.get_by_text("Heading set to 0°").wait_for()
            shown.waits_for(
                "Math.abs((parseFloat(document.querySelector('.figure').textContent) + 180) % 360 - 180) < 5"
            )
            page.get_by_text("0° is where it started").wait_for()
        shown.must_be_clean()


def _still(first: int, n: int) -> NDArray[np.float64]:
    """A level device that points east."""
    rows = turning(first, n, 0.0)
    rows[:, 7], rows[:, 8] = -20.0, 0.0
    return rows


def test_tipping_over_is_loud(browser: Any) -> None:
    watch = Watch()
    watch.warm()
    with serving(watch=watch) as live, page_of(browser, live) as shown:
        with sending(live, "robot", samples=falling):
            page = shown.open()
            alarm = page.get_by_role("alert")
            alarm.get_by_text("Fallen").wait_for()
            assert "robot" in alarm.inner_text()
            assert page.locator("#alarm").get_attribute("aria-live") == "assertive"
            assert page.locator("#alarm").bounding_box()["height"] > 40
            page.locator(".tip.bad").wait_for()
            assert "tipping" in page.inner_text(".events").lower()
        shown.must_be_clean()


def test_a_server_that_comes_back_is_found_again(browser: Any) -> None:
    with serving() as live:
        port = int(live.address.rpartition(":")[2])
        shown = Shown(browser, live)
        with sending(live, "turntable"):
            page = shown.open()
            shown.waits_for("window.poise.drawn('turntable')?.sequence > 10")
    page.get_by_text("Connection lost").first.wait_for()
    page.locator(".verdict", has_text="Not valid").wait_for()
    assert "connection lost" in page.inner_text(".why")
    with serving(port=port) as live:
        with sending(live, "other"), sending(live, "turntable"):
            page.locator(".link[data-state=open]").wait_for()
            shown.waits_for("window.poise.drawn('turntable')?.valid === true || location.hash === ''")
            assert page.inner_text("#banner") == ""
            page.locator(".tile", has_text="turntable").click()
            shown.waits_for("window.poise.drawn('turntable')?.valid === true")
        assert page.evaluate("window.violations") == []
        shown.context.close()


def test_a_token_is_asked_for_kept_in_no_address_and_may_be_for_looking_only(browser: Any) -> None:
    every, reader = "e" * 20, "r" * 20
    with serving(tokens={every: frozenset({"read", "write", "device"}), reader: frozenset({"read"})}) as live:
        device_headers = {"additional_headers": {"Authorization": f"Bearer {every}"}}
        with live.device("band", **device_headers) as device, page_of(browser, live) as shown:
            device.send(frames.encoded(turning(0, 100), 0))
            page = shown.open()
            dialog = page.get_by_role("dialog", name="This server wants a token")
            page.get_by_label("Token", exact=True).fill("wrong-wrong-wrong-wrong")
            page.get_by_role("button", name="Connect").click()
            dialog.get_by_text("not one of this server").wait_for()
            page.get_by_label("Token", exact=True).fill(reader)
            page.get_by_role("button", name="Connect").click()
            page.locator(".link[data-state=open]").wait_for()
            page.get_by_text("You may look, not change").wait_for()
            assert page.locator("#method-0").is_disabled()
            assert page.get_by_role("button", name="This way is forward").is_disabled()
            assert reader not in page.url
            assert page.evaluate("window.violations") == []
        with page_of(browser, live) as shown:
            page = shown.open(f"#token={every}")
            page.locator(".link[data-state=open]").wait_for()
            assert every not in page.url
            assert page.locator("#method-0").is_enabled()
            assert not any(every in url for url in shown.requests)
            shown.must_be_clean()


def test_a_token_that_cannot_be_one_is_said_to_be_and_one_pasted_into_an_open_tab_is_taken(browser: Any) -> None:
    token = "e" * 20
    with serving(tokens={token: frozenset({"read", "write", "device"})}) as live, page_of(browser, live) as shown:
        page = shown.open()
        dialog = page.get_by_role("dialog", name="This server wants a token")
        for wrong in ("schlüssel " * 3, "a b", '"><img src=x>'):
            page.get_by_label("Token", exact=True).fill(wrong)
            page.get_by_role("button", name="Connect").click()
            dialog.get_by_text("letters, digits").wait_for()
        page.evaluate("address => location.href = address", f"http://{live.address}/#token={token}")
        page.locator(".link[data-state=open]").wait_for()
        assert not dialog.is_visible()
        assert token not in page.url
        assert shown.page.evaluate("window.violations") == []


@pytest.mark.parametrize(
    "address", ["#/%", "#/%E0%A4%A", "#/nobody", "#/<img src=x onerror=alert(1)>", "?a=b&%", "?view"]
)
def test_an_address_may_be_anything(browser: Any, address: str) -> None:
    with serving() as live, page_of(browser, live) as shown, sending(live, "band"):
        shown.open(address).locator(".panel", has_text="Methods").wait_for()
        shown.waits_for("window.poise.drawn('band')?.sequence > 20")
        shown.must_be_clean()


def test_a_device_that_was_there_for_a_moment_is_shown(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown, sending(live, "band"):
        page = shown.open()
        shown.waits_for("window.poise.drawn('band')?.sequence > 20")
        names = [f"brief-{k}" for k in range(6)]
        for name in names:  # one after the other: the list of devices is told five times a second
            with live.device(name) as device:
                device.send(frames.encoded(turning(0, 50), 0))
            time.sleep(0.1)
        for name in names:
            page.locator(".tile", has_text=name).get_by_text("silent").wait_for()
        shown.waits_for("[...document.querySelectorAll('.tile b')].every((b) => b.textContent !== '–')")
        assert page.evaluate("poise.store.mainTrack('brief-0').ring.length") <= 4  # none of them twice
        shown.must_be_clean()


def test_many_devices_are_tiles_and_one_can_be_chosen_with_the_keyboard(browser: Any) -> None:
    names = tuple(f"unit-{k:02}" for k in range(12))
    with serving() as live, page_of(browser, live) as shown:
        with sending(live, *names):
            page = shown.open()
            shown.waits_for("document.querySelectorAll('.tile').length === 12")
            shown.waits_for("window.poise.drawn('unit-11')?.sequence > 20")
            page.locator(".tile").nth(2).focus()
            page.keyboard.press("Enter")
            page.get_by_role("heading", name="unit-02").wait_for()
            shown.waits_for("window.poise.drawn('unit-02')?.sequence > 20")
            page.keyboard.press("Escape")
            shown.waits_for("document.querySelectorAll('.tile').length === 12")
        shown.must_be_clean()


def on_tile(east: float, north: float, side: float) -> tuple[float, float]:
    """Where a point at the edge of the ground is on a tile's square of *side* pixels; the camera is that of scene.ts."""
    azimuth, elevation, distance, middle = 0.42, 0.5, 8.4, np.array([0.0, 0.0, -0.5])
    level = math.cos(elevation)
    back = np.array([math.sin(azimuth) * level, -math.cos(azimuth) * level, math.sin(elevation)])
    right = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    seen = np.array([1.9 * east, 1.9 * north, -1.35]) - middle - distance * back
    scale = 0.5 * side / (math.tan(math.radians(15.0)) * -(seen @ back))
    return side / 2 + scale * (seen @ right), side / 2 - scale * (seen @ np.cross(back, right))


def needle_of(page: Any, name: str) -> NDArray[np.float64]:
    """(n, 3): the pixels in the accent's colour on the square of a device's tile, right and down, and its side."""
    body = page.locator(".tile", has_text=name).locator(".body")
    picture = imread(BytesIO(body.screenshot()))[:, :, :3]
    accent = page.evaluate("getComputedStyle(document.documentElement).getPropertyValue('--accent').trim()")
    colour = np.array([int(accent[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0
    rows, columns = np.nonzero(np.abs(picture - colour).max(axis=2) < 0.12)
    height, width = picture.shape[:2]
    side = min(height, width)
    return np.column_stack([columns - (width - side) / 2, rows - (height - side) / 2, np.full(len(rows), side)])


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_tile_s_needle_points_where_the_device_points(browser: Any, scheme: str) -> None:
    headings = {"north": 0, "east": 90, "south": 180, "west": 270}

    def pointing(heading: float) -> Any:
        def samples(first: int, n: int) -> NDArray[np.float64]:
            rows = turning(first, n, 0.0)
            rows[:, 7], rows[:, 8] = -20.0 * math.sin(math.radians(heading)), 20.0 * math.cos(math.radians(heading))
            return rows

        return samples

    with serving() as live, page_of(browser, live, color_scheme=scheme) as shown, ExitStack() as stack:
        for name, heading in headings.items():
            stack.enter_context(sending(live, name, samples=pointing(heading)))
        more = tuple(f"more-{k:02}" for k in range(16))  # there is room for the first 16 bodies and then for more
        stack.enter_context(sending(live, *more))
        page = shown.open()
        for name in headings:
            shown.waits_for(f"window.poise.drawn('{name}')?.valid")
        for name, heading in headings.items():
            found = needle_of(page, name)
            side = found[0, 2]
            ahead, behind = (
                on_tile(sign * math.sin(math.radians(heading)), sign * math.cos(math.radians(heading)), side)
                for sign in (1.0, -1.0)
            )
            middle = np.array(on_tile(0.0, 0.0, side))
            share = [
                np.mean(
                    [
                        np.hypot(*(found[:, :2] - (middle + t * (np.array(end) - middle))).T).min() < 2.0
                        for t in np.linspace(0.4, 0.95, 12)
                    ]
                )
                for end in (ahead, behind)
            ]
            assert share[0] > 0.8 and share[1] < 0.2, (name, share)
        shown.must_be_clean()


def test_a_phone_s_width_and_the_dark_lose_nothing(browser: Any) -> None:
    with serving() as live, page_of(browser, live, color_scheme="dark", reduced_motion="reduce") as shown:
        with sending(live, "band"):
            page = shown.open()
            page.set_viewport_size({"width": 390, "height": 844})
            page.locator(".verdict", has_text=re.compile("^Valid$")).wait_for()
            page.locator(".plot canvas").nth(5).wait_for()
            shown.waits_for("document.documentElement.scrollWidth <= 390")
            background = page.evaluate("getComputedStyle(document.body).backgroundColor")
            assert sum(int(part) for part in background.strip("rgb()").split(",")) < 120
            unnamed = page.evaluate(
                "[...document.querySelectorAll('button, input, select, a')].filter((e) => e.offsetParent && !e.ariaLabel"
                " && !e.textContent.trim() && !e.labels?.length).map((e) => e.outerHTML)"
            )
            assert unnamed == []
        shown.must_be_clean()
