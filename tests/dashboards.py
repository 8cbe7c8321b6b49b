"""The dashboard as tests watch it: devices that send at their rate, and the page in a browser with all that it does."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from live_helpers import Running, wait_for
from poise.live import frames

RATE = 100.0
TURN = 0.6  # rad/s
WATCH = """
window.violations = [];
document.addEventListener("securitypolicyviolation", (event) => window.violations.push(event.violatedDirective));
"""


def turning(first: int, n: int, rate: float = TURN) -> NDArray[np.float64]:
    """(n, 10) samples of a level device that turns to the left at *rate*, and points north at its sample 0."""
    k = np.arange(first, first + n)
    heading = rate * k / RATE
    rows = np.zeros((n, 10))
    rows[:, 0] = k / RATE
    rows[:, 3] = rate
    rows[:, 6] = 9.81
    rows[:, 7], rows[:, 8], rows[:, 9] = 20.0 * np.sin(heading), 20.0 * np.cos(heading), -40.0
    return rows


def falling(first: int, n: int) -> NDArray[np.float64]:
    """(n, 10) samples of a device that stands for two seconds, falls on its face in the next and lies there."""
    k = np.arange(first, first + n)
    t = k / RATE
    tilt = np.clip(t - 2.0, 0.0, 1.0) ** 2 * 1.5
    rows = np.zeros((n, 10))
    rows[:, 0] = t
    rows[:, 1] = -np.where((t > 2.0) & (t < 3.0), 3.0 * (t - 2.0), 0.0)
    rows[:, 5], rows[:, 6] = -9.81 * np.sin(tilt), 9.81 * np.cos(tilt)
    north = np.array([20.0, -40.0])
    rows[:, 8] = north[0] * np.cos(tilt) - north[1] * np.sin(tilt)
    rows[:, 9] = north[0] * np.sin(tilt) + north[1] * np.cos(tilt)
    return rows


class Sending(threading.Thread):
    """Devices that send, at their rate, until told to stop."""

    def __init__(self, live: Running, names: tuple[str, ...], samples: Any, first: int = 0) -> None:
        super().__init__(daemon=True)
        self.live, self.names, self.samples, self.sent = live, names, samples, first
        self.ended = threading.Event()

    def run(self) -> None:
        with ExitStack() as stack:
            devices = [stack.enter_context(self.live.device(name)) for name in self.names]
            began, first = time.monotonic(), self.sent
            while not self.ended.wait(0.02):
                n = first + int((time.monotonic() - began) * RATE) - self.sent
                if n <= 0:
                    continue
                frame = frames.encoded(self.samples(self.sent, n), self.sent)
                for device in devices:
                    device.send(frame)
                self.sent += n

    def end(self) -> None:
        self.ended.set()
        self.join(10.0)


@contextmanager
def sending(live: Running, *names: str, samples: Any = turning, first: int = 0) -> Iterator[Sending]:
    source = Sending(live, names, samples, first)
    source.start()
    try:
        yield source
    finally:
        source.end()


class Shown:
    """The page in a browser, and all that it did: requests, errors, violations of its policy."""

    def __init__(self, browser: Any, live: Running, **options: Any) -> None:
        self.context = browser.new_context(viewport={"width": 1280, "height": 900}, **options)
        self.page = self.context.new_page()
        self.page.set_default_timeout(30_000)
        self.requests: list[str] = []
        self.errors: list[str] = []
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("console", lambda said: self.errors.append(said.text) if said.type == "error" else None)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.add_init_script(WATCH)
        self.address = live.address

    def open(self, fragment: str = "") -> Any:
        self.page.goto(f"http://{self.address}/{fragment}")
        return self.page

    def drawn(self, device: str) -> dict[str, Any] | None:
        found: dict[str, Any] | None = self.page.evaluate("(device) => window.poise.drawn(device)", device)
        return found

    def waits_for(self, expression: str) -> None:
        wait_for(lambda: self.page.evaluate(expression), 40.0)

    def must_be_clean(self) -> None:
        """Nothing left the server, nothing was reported."""
        assert self.page.evaluate("window.violations") == []
        outside = [url for url in self.requests if not url.startswith((f"http://{self.address}/", "blob:", "data:"))]
        assert outside == []
        assert self.errors == []


@contextmanager
def page_of(browser: Any, live: Running, **options: Any) -> Iterator[Shown]:
    shown = Shown(browser, live, **options)
    try:
        yield shown
    finally:
        shown.context.close()
