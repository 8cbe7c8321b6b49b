"""A phone is a device: a real browser at `/phone`, fed with recorded motion, against the offline estimate of the same motion."""

from __future__ import annotations

import json
import shutil
import ssl
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from data_files import data_path
from live_helpers import METHOD, Running, seen, serving, wait_for
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from websockets.sync.client import connect

import poise
from poise.live.certificate import own_certificate
from poise.live.methods import Choice

CHROMIUM = shutil.which("chromium")
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
    if (angles) dispatchEvent(new DeviceOrientationEvent("deviceorientation", { alpha: angles[0], beta: angles[1], gamma: angles[2] }));
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
    if CHROMIUM is None:
        pytest.skip("no chromium on the path (Debian: apt-get install chromium)")
    api = pytest.importorskip("playwright.sync_api")
    with api.sync_playwright() as playwright:
        with playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"]) as browser:
            yield browser


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


@pytest.mark.parametrize(
    ("sign", "order"), [(1.0, (2, 0, 1)), (-1.0, (0, 1, 2))], ids=["as the standard says", "as iOS does"]
)
def test_a_phones_attitude_is_that_of_its_recording(
    browser: Any, motion: Any, tmp_path: Path, sign: float, order: tuple[int, int, int]
) -> None:
    recording, truth = motion
    offline = poise.estimate(Choice.of(METHOD).method(), recording)
    files = own_certificate(["localhost", "127.0.0.1"], tmp_path)
    trusted = ssl.create_default_context(cafile=str(files[0]))
    with serving(tokens=TOKENS, certificate=files) as running:
        with phone(browser, f"https://{running.address}") as page:
            page.click("#start")
            page.wait_for_selector("#state[data-tone=good]")
            url = f"wss://{running.address}/ws/view"
            protocols: Any = ["poise", f"bearer.{READ}"]
            with connect(url, subprotocols=protocols, ssl=trusted, max_queue=None) as viewer:
                viewer.send(json.dumps({"type": "subscribe", "rate": "every"}))
                page.evaluate("([rows, speed]) => play(rows, speed)", [events(recording, truth, sign, order), 4.0])
                found = seen(viewer, len(recording) - 5)
            page.wait_for_function("document.querySelector('#valid').textContent === 'yes'")
            shown = float(page.text_content("#tilt").rstrip("°"))
            assert page.problems == []
            assert "#token" not in page.url
    device = running.hub.devices["pocket"]
    assert device.shape == "phone"
    assert device.health.lost == device.health.repeated == device.health.rejected == 0
    np.testing.assert_array_equal(found["sequence"], np.arange(len(found)))
    np.testing.assert_allclose(found["time"] - found["time"][0], recording.time[: len(found)], atol=2e-6)
    np.testing.assert_allclose(found["acc"], recording.acc[: len(found)], rtol=1e-6)
    assert apart(found["quat"].astype(float), offline.quat[: len(found)]).max() < 0.05
    browsers = Rotation.from_euler("zx", [137.0, 4.0], degrees=True) * Rotation.from_quat(np.nan_to_num(truth, nan=0.5))
    assert apart(browsers.as_quat()[: len(found), [3, 0, 1, 2]], offline.quat[: len(found)]).min() > 3.0
    assert np.abs(np.degrees(offline.tilt()[-30:]) - shown).min() < 0.2
