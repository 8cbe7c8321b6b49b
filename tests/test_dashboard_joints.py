"""A joint on the page: two devices, and the angle between them as a real browser shows it."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from browsing import chromium
from dashboards import RATE, TURN, page_of, sending, turning
from live_helpers import serving

BENT = math.radians(40.0)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


def still(first: int, n: int) -> NDArray[np.float64]:
    """A level device that points north."""
    return turning(first, n, 0.0)


def bent(first: int, n: int) -> NDArray[np.float64]:
    """A device that points north with its forward end 40° up."""
    rows = still(first, n)
    for up in (5, 8):  # of force and field
        north, above = rows[:, up].copy(), rows[:, up + 1].copy()
        rows[:, up] = math.cos(BENT) * north + math.sin(BENT) * above
        rows[:, up + 1] = math.cos(BENT) * above - math.sin(BENT) * north
    return rows


def east(first: int, n: int) -> NDArray[np.float64]:
    """A level device that points east."""
    rows = still(first, n)
    rows[:, 7], rows[:, 8] = -20.0, 0.0
    return rows


def figures(page: Any) -> list[float]:
    """Angle, turn, pitch and roll, as the page says them."""
    texts = page.locator(".pair").locator(".figure, dd").all_inner_texts()
    return [float(text.replace("−", "-").rstrip("°")) for text in texts]


def test_a_bent_joint_has_its_angle_on_its_tile_and_on_its_page(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown:
        live.call(lambda: live.hub.set_joint("knee", "shank", "thigh"))
        with sending(live, "shank", samples=bent), sending(live, "thigh", samples=still):
            page = shown.open()
            tile = page.locator(".tile", has_text="knee")
            tile.get_by_text("Angle").wait_for()
            shown.waits_for(
                "/angle (39|40|41) degrees/.test(document.querySelector('.tile[aria-label^=knee]')?.ariaLabel)"
            )
            assert "Heading" not in tile.inner_text() and "Tilt" not in tile.inner_text()
            assert "2 devices, 1 joint" in page.inner_text("#bar")
            tile.click()
            page.locator(".verdict", has_text=re.compile("^Valid$")).wait_for()
            shown.waits_for("Math.abs(parseFloat(document.querySelector('.figure').textContent) - 40) < 1")
            assert figures(page)[1:] == pytest.approx([0.0, 40.0, 0.0], abs=1.0)
            assert "of shank, seen from thigh" in page.inner_text(".readouts")
            assert page.locator(".chart h3").all_inner_texts() == ["Angle", "Turn", "Pitch", "Roll", "Rate"]
            # what a joint has not: methods of its own, a north
            assert page.locator("select").count() == 0
            assert "north" not in page.inner_text("main")
            page.get_by_role("link", name="thigh").click()
            page.get_by_role("heading", name="thigh").wait_for()
            page.get_by_text("Methods").wait_for()
        shown.must_be_clean()


def test_a_joint_turns_as_its_segment_turns(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown:
        live.call(lambda: live.hub.set_joint("neck", "head", "trunk"))
        with sending(live, "head"), sending(live, "trunk", samples=still):
            page = shown.open("#/neck")
            shown.waits_for("window.poise.drawn('neck')?.sequence > 150 && window.poise.drawn('neck').valid")
            page.get_by_role("button", name="Pause").click()
            shown.waits_for("window.poise.store.version === window.poise.painted()")
            page.wait_for_timeout(300)  # for the numbers
            drawn = shown.drawn("neck")
            angle, turn, *level = figures(page)
        assert drawn is not None
        w, _, _, z = drawn["quat"]
        truth = (TURN * drawn["sequence"] / RATE + math.pi) % (2 * math.pi) - math.pi
        assert math.degrees(2 * math.atan2(z, w)) == pytest.approx(math.degrees(truth), abs=6.0)
        assert turn == pytest.approx(math.degrees(2 * math.atan2(z, w)), abs=0.2)
        assert angle == pytest.approx(abs(turn), abs=1.0)
        assert level == pytest.approx([0.0, 0.0], abs=2.0)
        shown.must_be_clean()


def test_both_point_the_same_way_takes_their_headings_out(browser: Any) -> None:
    with serving() as live, page_of(browser, live) as shown:
        live.call(lambda: live.hub.set_joint("elbow", "forearm", "upper"))
        with sending(live, "forearm", samples=east), sending(live, "upper", samples=still):
            page = shown.open("#/elbow")
            shown.waits_for("Math.abs(parseFloat(document.querySelector('.figure')?.textContent) - 90) < 3")
            assert figures(page)[1] == pytest.approx(-90.0, abs=3.0)
            page.get_by_role("button", name="Both point the same way").click()
            page.get_by_text("Both headings set to 0°").wait_for()
            shown.waits_for("parseFloat(document.querySelector('.figure').textContent) < 3")
            # the joint is put elsewhere while its page is open
            live.call(lambda: live.hub.set_joint("elbow", "upper", "forearm"))
            page.get_by_text("of upper, seen from forearm").wait_for()
        shown.must_be_clean()
