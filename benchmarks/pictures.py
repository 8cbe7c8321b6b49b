"""The pictures of the pages in docs/images, as a real browser draws them.

    python benchmarks/pictures.py [live live-many live-joint view]     needs Debian's chromium and the package playwright

`live` and `view` play trials of BROAD (POISE_DATA says where they are), `live-joint` is the simulated arm, `live-many` is made.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import numpy as np
from playwright.sync_api import Browser, Page, sync_playwright
from websockets.sync.client import connect

from live import Served
from poise.live import frames

ROOT = Path(__file__).resolve().parents[1]
DATA = Path(os.environ.get("POISE_DATA") or ROOT.parent / "shared" / "data") / "broad"
ARGUMENTS = ["--no-sandbox", "--disable-background-networking", "--enable-unsafe-swiftshader"]
RATE, SILENT = 100.0, 3


@contextmanager
def served(*options: str) -> Iterator[str]:
    """The address of a `poise live`."""
    server = Served(*options)
    try:
        yield f"http://127.0.0.1:{server.port}/"
    finally:
        server.end()


@contextmanager
def viewed(*arguments: str) -> Iterator[str]:
    """The address of a `poise view`."""
    process = subprocess.Popen(
        [sys.executable, "-m", "poise", "view", *arguments, "--no-open"], stdout=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout is not None
        yield process.stdout.readline().split()[3]
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(30)


@contextmanager
def swaying(address: str, count: int) -> Iterator[None]:
    """*count* devices that sway, each in its own way; number SILENT stops after 3 s."""
    ended = threading.Event()
    sending = threading.Thread(target=_sway, args=(address.replace("http", "ws"), count, ended))
    sending.start()
    try:
        yield
    finally:
        ended.set()
        sending.join(10.0)


def _sway(address: str, count: int, ended: threading.Event) -> None:
    with ExitStack() as stack:
        sockets = [stack.enter_context(connect(f"{address}ws/device/unit-{k:02}")) for k in range(count)]
        began, sent = time.monotonic(), 0
        while not ended.wait(0.05):
            n = int((time.monotonic() - began) * RATE) - sent
            if n <= 0:
                continue
            for number, socket in enumerate(sockets):
                if number != SILENT or sent < 3 * RATE:
                    socket.send(frames.encoded(swayed(number, sent, n), sent))
            sent += n


def swayed(number: int, first: int, n: int) -> np.ndarray:
    """(n, 10) samples of device *number*: it turns about its z, and is tipped about an axis of its own."""
    from scipy.spatial.transform import Rotation

    t = np.arange(first - 1, first + n + 1) / RATE
    heading = np.deg2rad(50.0) * np.sin(0.3 * t + number)
    tilt = np.deg2rad(15.0 + 30.0 * np.sin(0.5 * t + 1.7 * number) ** 2)
    axis = np.array([np.cos(2.4 * number), np.sin(2.4 * number), 0.0])
    body = Rotation.from_rotvec(heading[:, None] * [0.0, 0.0, 1.0]) * Rotation.from_rotvec(tilt[:, None] * axis)
    rows = np.zeros((n, 10))
    rows[:, 0] = t[1:-1]
    rows[:, 1:4] = (body[:-2].inv() * body[2:]).as_rotvec() * RATE / 2.0
    rows[:, 4:7] = body[1:-1].inv().apply([0.0, 0.0, 9.81])
    rows[:, 7:10] = body[1:-1].inv().apply([0.0, 20.0, -40.0])
    return rows


def until(page: Page, expression: str, seconds: float = 120.0) -> None:
    end = time.monotonic() + seconds
    while not page.evaluate(expression):
        if time.monotonic() > end:
            raise TimeoutError(expression)
        page.wait_for_timeout(100)


def live(page: Page) -> None:
    word = f"replay:{DATA / '05_undisturbed_slow_rotation_with_breaks_B.mat'}"
    with served(word, "-m", "self-calibrating", "-m", "two-stage") as address:
        page.goto(address)
        until(page, "window.poise?.store.edge() - window.poise?.store.oldest() > 62")
        shoot(page, "live")


def live_many(page: Page) -> None:
    with served("-m", "self-calibrating") as address, swaying(address, 50):
        page.goto(address)
        until(page, "document.querySelectorAll('.tile').length === 50 && poise.drawn('unit-49')?.sequence > 1000")
        shoot(page, "live-many")


def live_joint(page: Page) -> None:
    with served("sim:arm", "--joint", "elbow=forearm/upper_arm") as address:
        page.goto(f"{address}#/elbow")
        until(page, "window.poise?.store.edge() - window.poise?.store.oldest() > 32")
        shoot(page, "live-joint")


def view(page: Page) -> None:
    file = DATA / "21_undisturbed_fast_combined.mat"
    with viewed(str(file), "-m", "self-calibrating", "-m", "two-stage") as address:
        page.goto(address)
        until(page, "window.poise?.store.edge() > 1")
        page.evaluate("poise.playhead.seek(70)")
        shoot(page, "view")


def shoot(page: Page, name: str) -> None:
    page.wait_for_timeout(700)  # for numbers, which are written less often than bodies are drawn
    page.screenshot(path=ROOT / "docs" / "images" / f"{name}.png")


PICTURES: dict[str, Callable[[Page], None]] = {
    "live": live,
    "live-many": live_many,
    "live-joint": live_joint,
    "view": view,
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(PICTURES))
    names = parser.parse_args().names or list(PICTURES)
    if absent := set(names) - PICTURES.keys():
        parser.error(f"no picture {min(absent)!r}; there are {', '.join(PICTURES)}")
    path = shutil.which("chromium")
    if path is None:
        print("no chromium on the path (Debian: apt-get install chromium)", file=sys.stderr)
        return 1
    with sync_playwright() as playwright:
        browser: Browser = playwright.chromium.launch(executable_path=path, args=ARGUMENTS)
        for name in names:
            page = browser.new_page(viewport={"width": 1360, "height": 900}, color_scheme="light")
            PICTURES[name](page)
            page.close()
            print(f"docs/images/{name}.png", flush=True)
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
