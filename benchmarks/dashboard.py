"""The page of `poise live` in software GL: how soon it paints, and how often it is redrawn with 1 and with 50 devices.

    python benchmarks/dashboard.py            needs Debian's chromium and the package playwright; loopback only

The server and the devices run beside the browser on the same cores. Nothing here is asserted.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import threading
import time
from contextlib import ExitStack

import numpy as np
from playwright.sync_api import Browser, sync_playwright
from websockets.sync.client import connect

from live import Served
from poise.live import frames

RATE = 100.0
ARGUMENTS = ["--no-sandbox", "--disable-background-networking", "--enable-unsafe-swiftshader"]
PAINT = "performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? null"


def devices(port: int, count: int, ended: threading.Event) -> None:
    """*count* devices that turn at different rates, 100 samples a second in frames of 2."""
    with ExitStack() as stack:
        sockets = [stack.enter_context(connect(f"ws://127.0.0.1:{port}/ws/device/unit-{k:02}")) for k in range(count)]
        began, sent = time.monotonic(), 0
        while not ended.wait(0.02):
            n = int((time.monotonic() - began) * RATE) - sent
            if n <= 0:
                continue
            k = np.arange(sent, sent + n)
            for number, socket in enumerate(sockets):
                turn = 0.2 + 0.02 * number
                rows = np.zeros((n, 10))
                rows[:, 0], rows[:, 3], rows[:, 6] = k / RATE, turn, 9.81
                rows[:, 7] = 20.0 * np.sin(turn * k / RATE)
                rows[:, 8], rows[:, 9] = 20.0 * np.cos(turn * k / RATE), -40.0
                socket.send(frames.encoded(rows, sent))
            sent += n


def measured(browser: Browser, count: int, seconds: float) -> str:
    served = Served("-m", "adaptive-gain")
    ended = threading.Event()
    sending = threading.Thread(target=devices, args=(served.port, count, ended))
    sending.start()
    try:
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        page.goto(f"http://127.0.0.1:{served.port}/")
        last = f"unit-{count - 1:02}"
        until = time.monotonic() + 60.0
        while not page.evaluate(f"window.poise?.drawn('{last}')?.sequence > 0") and time.monotonic() < until:
            page.wait_for_timeout(50)
        page.wait_for_timeout(2000)
        paint, before, began = page.evaluate(PAINT), page.evaluate("window.poise.redraws()"), time.monotonic()
        cpu = served.cpu()
        page.wait_for_timeout(1000 * seconds)
        spent = time.monotonic() - began
        redraws = (page.evaluate("window.poise.redraws()") - before) / spent
        page.close()
        return (
            f"{count:3} devices: first paint {paint / 1000 if paint else float('nan'):.2f} s, {redraws:.1f} redraws/s, "
            f"server {100 * (served.cpu() - cpu) / spent:.0f} % of a core (load {os.getloadavg()[0]:.1f})"
        )
    finally:
        ended.set()
        sending.join(10.0)
        served.end()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=10.0)
    seconds = parser.parse_args().seconds
    path = shutil.which("chromium")
    if path is None:
        print("no chromium on the path (Debian: apt-get install chromium)", file=sys.stderr)
        return 1
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=ARGUMENTS)
        for count in (1, 50):
            print(measured(browser, count, seconds), flush=True)
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
