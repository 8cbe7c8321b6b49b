"""How long it takes from the decision that a robot tips to the edge on the relay's pin.

    python benchmarks/responses.py [--trials N]

A mock pin notes the instant at which it changes; the decision is the instant before ``Responses.handle`` is called with it.
Beside it, in the same process, runs an estimator (`self-calibrating`, one sample a call), in another one a loop that only
burns time on a processor, and the slow responders speak, post and run a program at each alarm. ``flat out`` is an estimator
that never waits for its next sample; ``another thread`` a decision by a watchdog beside the estimator's thread.
"""

from __future__ import annotations

import argparse
import logging
import multiprocessing
import queue
import random
import shutil
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from itertools import cycle
from pathlib import Path
from typing import Any, NamedTuple

import gpiozero
import numpy as np
from gpiozero.pins.mock import MockFactory, MockPin

from poise import Packet, SelfCalibrating, Stream
from poise.data.event import TipEvent, TipState
from poise.responses import Responses, config_of
from poise.simulation import Sensor, forearm, measure
from tables import table

PIN, LIMIT = 17, 20.0  # BCM number; ms, what issue and documentation promise
PAUSE = (0.1, 0.3)  # s from one alarm to the next
FLAT_OUT = float("inf")
TIPPING = TipEvent(0.0, TipState.TIPPING, TipState.UPRIGHT, "forward", 0.6, 2.0, 0.3)
UPRIGHT = TipEvent(0.0, TipState.UPRIGHT, TipState.TIPPING)


class TimedPin(MockPin):  # type: ignore[misc]  (gpiozero is untyped)
    """A pin that notes when it last changed, s."""

    edge = 0.0

    def _change_state(self, value: bool) -> Any:
        changed = super()._change_state(value)
        if changed:
            self.edge = time.perf_counter()
            del self.states[:-1]
        return changed


class Scene(NamedTuple):
    """What goes on beside the decision."""

    name: str
    rate: float
    """Hz of the estimator; 0 for none"""
    burner: bool
    slow: bool
    """slow responders are fired too"""
    elsewhere: bool = False
    """another thread decides, not the estimator's"""
    handed_over: bool = False
    """not poise's way: the pin is driven by a thread of its own, which waits at a queue"""


SCENES = (
    Scene("nothing beside it, relay alone", 0.0, False, False),
    Scene("200 Hz", 200.0, True, True),
    Scene("1000 Hz", 1000.0, True, True),
    Scene("flat out", FLAT_OUT, True, True),
    Scene("1000 Hz, another thread", 1000.0, True, True, elsewhere=True),
    Scene("flat out, another thread", FLAT_OUT, True, True, elsewhere=True),
    Scene("flat out, pin driven by a thread at a queue", FLAT_OUT, True, True, handed_over=True),
)


class Slow(BaseHTTPRequestHandler):
    """A server that takes its time."""

    def do_HEAD(self) -> None:
        self.send_response(204)
        self.end_headers()

    def do_POST(self) -> None:
        self.rfile.read(int(self.headers["Content-Length"]))
        time.sleep(0.02)
        self.do_HEAD()

    def log_message(self, *_: Any) -> None:
        pass


def burn() -> None:
    while True:
        pass


@contextmanager
def burning() -> Iterator[None]:
    process = multiprocessing.get_context("spawn").Process(target=burn, daemon=True)
    process.start()
    try:
        yield
    finally:
        process.kill()
        process.join()


@contextmanager
def responding(slow: bool) -> Iterator[Responses]:
    """Responses with a relay, and with slow responders where asked."""
    responders: dict[str, Any] = {"power": {"type": "relay", "pin": PIN, "active_high": True}}
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        responders["log"] = {"type": "log", "file": "alarms.jsonl"}
        if slow:
            server = stack.enter_context(ThreadingHTTPServer(("127.0.0.1", 0), Slow))
            threading.Thread(target=server.serve_forever, daemon=True).start()
            stack.callback(server.shutdown)
            responders["web"] = {"type": "webhook", "url": f"http://127.0.0.1:{server.server_address[1]}/"}
            responders["program"] = {"type": "command", "argv": ["sleep", "0.05"]}
            if shutil.which("espeak-ng"):
                responders["voice"] = {"type": "voice", "wav": "said.wav"}
        fire = [name for name in responders if name != "log"]
        stages = [{"state": "tipping", "fire": fire[::-1]}]  # the relay last: it is driven first all the same
        yield stack.enter_context(Responses(config_of({"responders": responders, "stages": stages}, folder)))


def estimator(rate: float) -> Callable[[], None]:
    """One turn of a loop of *rate* Hz: waits for the next sample, takes it."""
    recording = measure(forearm(20.0, 200.0), Sensor())
    rows = cycle(zip(recording.gyr, recording.acc, recording.mag, strict=True))
    stream, stamp = Stream(SelfCalibrating()), 0.0
    step = 1.0 / (rate if np.isfinite(rate) else 1000.0)
    due = time.perf_counter()

    def turn() -> None:
        nonlocal stamp, due
        stamp += step
        stream.update(Packet(stamp, *next(rows)))
        if np.isfinite(rate):
            due = max(due + step, time.perf_counter() - 0.1)
            time.sleep(max(due - time.perf_counter(), 0.0))

    turn()  # compiled before anything is timed
    return turn


def measured(scene: Scene, trials: int) -> list[float]:
    """Seconds from decision to edge, one for each trial."""
    factory = MockFactory(pin_class=TimedPin)
    gpiozero.Device.pin_factory = factory
    chance, found = random.Random(1), []
    turn = estimator(scene.rate) if scene.rate else lambda: time.sleep(0.001)
    with ExitStack() as stack:
        if scene.burner:
            stack.enter_context(burning())
        responses = stack.enter_context(responding(scene.slow))
        responses.handle(UPRIGHT)  # from the start on it is cut
        pin = factory.pin(PIN)
        handle: Callable[[], None] = lambda: responses.handle(TIPPING)  # noqa: E731
        if scene.handed_over:
            waiting: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
            other = threading.Thread(target=lambda: [each() for each in iter(waiting.get, None)], daemon=True)
            other.start()
            stack.callback(waiting.put, None)
            handle = lambda: waiting.put(lambda: responses.handle(TIPPING))  # noqa: E731

        def trial() -> None:
            began = time.perf_counter()
            handle()
            while scene.handed_over and pin.edge < began:
                turn()
            assert pin.edge > began and pin.state
            found.append(pin.edge - began)
            responses.handle(UPRIGHT)
            responses.acknowledge()
            assert not pin.state

        def decide() -> None:
            while len(found) < trials:
                time.sleep(chance.uniform(*PAUSE))
                trial()

        if scene.elsewhere:
            watchdog = threading.Thread(target=decide)
            watchdog.start()
            while watchdog.is_alive():
                turn()
        else:
            while len(found) < trials:
                end = time.perf_counter() + chance.uniform(*PAUSE)
                while time.perf_counter() < end:
                    turn()
                trial()
        if responses.failures:
            print(f"{scene.name}: {len(responses.failures)} failures, {responses.failures[0].detail}", file=sys.stderr)
    factory.reset()
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=200, help="alarms a scene")
    trials = parser.parse_args().trials
    logging.getLogger("poise.responses").setLevel(logging.CRITICAL)  # counted below
    rows, base, worst = [], 0.0, 0.0
    for scene in SCENES:
        times = 1e3 * np.asarray(measured(scene, trials))
        median = float(np.median(times))
        base = base or median
        if not scene.handed_over:
            worst = max(worst, float(times.max()))
        rows.append([scene.name, median, float(np.percentile(times, 99)), float(times.max()), median / base])
    print(f"decision to edge, ms, {trials} alarms a scene; ratio of the medians")
    print(table(["beside it", "p50", "p99", "max", "ratio"], rows))
    print(f"longest by poise: {worst:.2f} ms, {'within' if worst <= LIMIT else 'BEYOND'} {LIMIT:g} ms")
    return 0


if __name__ == "__main__":
    sys.exit(main())
