"""A real browser for the tests of the pages: Debian's Chromium, which draws WebGL in software."""

from __future__ import annotations

import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

ARGUMENTS = (
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)


@contextmanager
def chromium(*arguments: str) -> Iterator[Any]:
    """The browser; the test is skipped where there is none."""
    path = shutil.which("chromium")
    if path is None:
        pytest.skip("no chromium on the path (Debian: apt-get install chromium)")
    api = pytest.importorskip("playwright.sync_api")
    with (
        api.sync_playwright() as playwright,
        playwright.chromium.launch(executable_path=path, args=[*ARGUMENTS, *arguments]) as browser,
    ):
        yield browser


@contextmanager
def page_of(browser: Any, address: str, **context: Any) -> Iterator[Any]:
    """A page at *address* that may complain of nothing and ask for nothing from elsewhere."""
    with browser.new_context(**context) as opened:
        page = opened.new_page()
        complaints: list[str] = []
        page.on("console", lambda each: complaints.append(each.text) if each.type in ("error", "warning") else None)
        page.on("pageerror", lambda each: complaints.append(str(each)))
        own = address.split("//")[1].split("/")[0]
        page.on("request", lambda each: complaints.append(each.url) if own not in each.url else None)
        page.goto(address)
        yield page
        assert complaints == []


def until(page: Any, expression: str, argument: Any = None, seconds: float = 20.0) -> None:
    """Waits for *expression*; the page's own waiting would evaluate text, which its policy forbids."""
    end = time.monotonic() + seconds
    while not page.evaluate(expression, argument):
        assert time.monotonic() < end, expression
        page.wait_for_timeout(20)
