"""`poise live` under load: how many devices and viewers, what floods and malformed frames do, and what a killed server loses.

    python benchmarks/live.py                 every scenario, each ends by itself; loopback only
    python benchmarks/live.py load stalled    some of them; --seconds 10 for each

The server is `poise live` in a process of its own, whose processor time and memory are read from /proc; the devices are raw
sockets here. Latency is from before a frame is written here to after its attitude was read here by a viewer of every sample.
"""

from __future__ import annotations

import argparse
import asyncio
import base64
import gc
import json
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import uvloop

import poise
from poise.live import frames

RESULTS = Path(__file__).parent / "results" / "live.json"
CORES = 2.0
TICKS = os.sysconf("SC_CLK_TCK")


class Served:
    """`poise live` as a process."""

    def __init__(self, *options: str) -> None:
        command = [sys.executable, "-m", "poise", "live", "--port", "0", *options]
        began = time.monotonic()
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        assert self.process.stdout is not None
        self.port = int(self.process.stdout.readline().split("/")[2].rpartition(":")[2])
        self.start = time.monotonic() - began

    def cpu(self) -> float:
        """s of processor time so far."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / TICKS

    def rss(self) -> float:
        """MiB."""
        text = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(text.partition("VmRSS:")[2].split()[0]) / 1024

    def end(self, number: int = signal.SIGTERM) -> None:
        self.process.send_signal(number)
        self.process.wait(60)


class Device(asyncio.Protocol):
    """A WebSocket client that writes frames as they are and counts what comes back."""

    def __init__(self) -> None:
        self.buffer, self.texts, self.closed, self.up = b"", 0, False, asyncio.Event()
        self.keep = False
        self.acked = 0

    def connection_made(self, transport: Any) -> None:
        self.transport = transport

    def data_received(self, data: bytes) -> None:
        self.buffer += data
        if not self.up.is_set():
            if b"\r\n\r\n" not in self.buffer:
                return
            self.buffer = self.buffer.partition(b"\r\n\r\n")[2]
            self.up.set()
        while len(self.buffer) >= 2:
            size, at = self.buffer[1] & 127, 2
            if size == 126:
                size, at = struct.unpack_from(">H", self.buffer, 2)[0] if len(self.buffer) >= 4 else 1 << 30, 4
            elif size == 127:
                size, at = struct.unpack_from(">Q", self.buffer, 2)[0] if len(self.buffer) >= 10 else 1 << 30, 10
            if len(self.buffer) < at + size:
                return
            self.heard(self.buffer[0], self.buffer[at : at + size])
            self.buffer = self.buffer[at + size :]

    def heard(self, kind: int, payload: bytes) -> None:
        if kind == 0x89:
            self.transport.write(masked(payload, 0x8A))
        elif kind == 0x88:
            self.told = time.monotonic()
            self.transport.write(masked(payload, 0x88))
        elif kind == 0x81:
            self.texts += 1
            if payload.startswith(b'{"type": "ack"'):
                self.acked = json.loads(payload)["next"]
            elif payload.startswith(b'{"type": "welcome"'):
                self.next = json.loads(payload)["next"]

    def connection_lost(self, problem: Exception | None) -> None:
        self.closed = True
        self.up.set()


class Viewer(Device):
    """Counts the attitudes of every sample and how late they are: samples are stamped with this process's clock."""

    def __init__(self) -> None:
        super().__init__()
        self.rows, self.late = 0, []
        self.size, self.step = 1, 0.0

    def heard(self, kind: int, payload: bytes) -> None:
        if kind == 0x82:
            found = frames.records(payload)
            self.rows += len(found)
            sent = (
                found["time"] + (self.size - 1 - found["sequence"] % self.size) * self.step
            )  # with the frame's last sample
            self.late.append(time.monotonic() - sent)
        else:
            super().heard(kind, payload)


async def joined(port: int, path: str, make: Callable[[], Device] = Device, rcvbuf: int = 0) -> Device:
    loop = asyncio.get_running_loop()
    _, found = await loop.create_connection(make, "127.0.0.1", port)
    key = base64.b64encode(os.urandom(16)).decode()
    found.transport.write(
        f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode()
    )
    await asyncio.wait_for(found.up.wait(), 60)
    return found


def masked(payload: bytes, kind: int = 0x82) -> bytes:
    """A client's frame, masked with zeros: the server unmasks all the same."""
    size = len(payload)
    head = struct.pack(">BB", kind, 0x80 | size) if size < 126 else struct.pack(">BBH", kind, 0x80 | 126, size)
    return head + bytes(4) + payload


def said(viewer: Viewer, sent: int) -> dict[str, Any]:
    late = np.concatenate(viewer.late) if viewer.late else np.array([np.nan])
    return {
        "samples": sent,
        "lost": sent - viewer.rows,
        "p50_ms": round(1e3 * float(np.quantile(late, 0.5)), 1),
        "p99_ms": round(1e3 * float(np.quantile(late, 0.99)), 1),
        "max_ms": round(1e3 * float(late.max()), 1),
    }


async def pushing(devices: list[Device], rate: float, size: int, seconds: float, first: int = 0) -> int:
    """Every device *size* samples a frame, *rate* frames a second, evenly spread; how many samples were sent."""
    values = [0.1, 0.2, -0.1, 0.3, 0.2, 9.8, 1.0, 20.0, -40.0]
    tail = struct.pack("<9d", *values)
    lags = [(k - size + 1) / (rate * size) for k in range(size)]
    head = masked(bytes(frames.HEADER.size + 80 * size))[: -frames.HEADER.size - 80 * size]
    one, noise = struct.Struct("<2d"), np.random.default_rng(0).normal(0.1, 1e-3, 4096).tolist()
    began, sent, n = time.monotonic(), 0, len(devices)
    while True:
        now = time.monotonic()
        due = int(min(now - began, seconds) * rate * n)
        for _ in range(min(due - sent, 200)):  # then the viewer is to be read
            start = frames.HEADER.pack(frames.VERSION, frames.SAMPLES, 80, size, first + size * (sent // n))
            clock = time.monotonic()
            body = b"".join([one.pack(clock + lag, noise[(sent + k) & 4095]) + tail[8:] for k, lag in enumerate(lags)])
            device = devices[sent % n]
            if not device.closed:
                device.transport.write(head + start + body)
            sent += 1
        if now - began >= seconds and sent >= due:
            return sent * size
        await asyncio.sleep(0 if sent < due else 0.001)


async def watched(server: Served) -> Viewer:
    viewer = await joined(server.port, "/ws/view", Viewer)
    viewer.transport.write(masked(b'{"type": "subscribe", "rate": "every"}', 0x81))
    assert isinstance(viewer, Viewer)
    return viewer


async def drained(viewer: Viewer, sent: int, patience: float = 5.0) -> None:
    end = time.monotonic() + patience
    while viewer.rows < sent and time.monotonic() < end:
        await asyncio.sleep(0.02)


async def load(seconds: float, devices: int, rate: float, size: int, *options: str) -> dict[str, Any]:
    """S1."""
    server = Served("--max-rate", "20000", *options)
    try:
        viewer = await watched(server)
        viewer.size, viewer.step = size, 1.0 / (rate * size)
        found = [await joined(server.port, f"/ws/device/d{k}") for k in range(devices)]
        warm = await pushing(found, rate, size, 2.0)
        await drained(viewer, warm, 60.0)  # the method is being loaded
        viewer.late.clear()
        viewer.rows = 0
        cpu, rss, began = server.cpu(), server.rss(), time.monotonic()
        sent = await pushing(found, rate, size, seconds, 1_000_000)
        spent, grown = (server.cpu() - cpu) / (time.monotonic() - began), server.rss() - rss
        waits = (await asyncio.to_thread(http, server.port, "/healthz"))["wait_ms"]
        await drained(viewer, sent)
        answer = {"devices": devices, "frames_hz": rate, "samples_a_frame": size} | said(viewer, sent)
        return answer | {
            "in_the_server_ms": waits,
            "cores": round(spent, 2),
            "share": round(spent / CORES, 2),
            "rss_grown_mib": round(grown, 1),
        }
    finally:
        server.end()


async def stalled(seconds: float) -> dict[str, Any]:
    """S2: 100 viewers that never read, half of the newest and half of every sample."""
    server = Served("--max-rate", "20000")
    try:
        viewer = await watched(server)
        found = [await joined(server.port, f"/ws/device/d{k}") for k in range(50)]
        await drained(viewer, await pushing(found, 100, 1, 1.0), 60.0)
        viewer.late.clear()
        viewer.rows = 0
        sent = await pushing(found, 100, 1, seconds, 500_000)
        await drained(viewer, sent)
        before, rss = said(viewer, sent), server.rss()
        asleep = [await joined(server.port, "/ws/view") for _ in range(100)]
        for k, each in enumerate(asleep):
            if k % 2:
                each.transport.write(masked(b'{"type": "subscribe", "rate": "every"}', 0x81))
            each.transport.pause_reading()
        viewer.late.clear()
        viewer.rows = 0
        sent = await pushing(found, 100, 1, 5.0, 1_000_000)
        await drained(viewer, sent)
        filling = said(viewer, sent)  # until the buffers of the system are full, they are viewers like others
        viewer.late.clear()
        viewer.rows = 0
        sent = await pushing(found, 100, 1, 2 * seconds, 2_000_000)
        await drained(viewer, sent)
        after = said(viewer, sent)
        grown = server.rss() - rss
        return {
            "without": before,
            "with_their_buffers_filling": filling,
            "with": after,
            "rss_grown_mib": round(grown, 1),
        }
    finally:
        server.end()


async def flood(seconds: float) -> dict[str, Any]:
    """S3: 5000 idle connections, and one device that sends a hundred times its rate."""
    server = Served("--max-rate", "2000")
    try:
        viewer = await watched(server)
        idle = [await joined(server.port, "/ws/view", Device) for _ in range(0)]
        for start in range(0, 5000, 250):
            idle += await asyncio.gather(
                *(joined(server.port, f"/ws/device/idle{k}") for k in range(start, start + 250))
            )
        found = [await joined(server.port, f"/ws/device/d{k}") for k in range(20)]
        await drained(viewer, await pushing(found, 100, 1, 1.0), 60.0)
        viewer.late.clear()
        viewer.rows = 0
        offender = await joined(server.port, "/ws/device/flood")
        began, closed = time.monotonic(), []

        async def flooding() -> None:
            k, sample = 0, np.zeros((10, 10))
            sample[:, 6] = 9.8
            while not offender.closed:
                for _ in range(10):  # 10 000 samples a second
                    sample[:, 0] = time.monotonic() + np.arange(10) * 1e-5
                    offender.transport.write(masked(frames.encoded(sample, k)))
                    k += 10
                await asyncio.sleep(0.01)
            closed.append(time.monotonic() - began)

        pouring = asyncio.create_task(flooding())
        sent = await pushing(found, 100, 1, seconds, 2000)
        await asyncio.wait_for(pouring, 10)
        await drained(viewer, sent)
        health = (await asyncio.to_thread(http, server.port, "/healthz"))["devices"]
        others = [d for d in health if d["id"].startswith("d")]
        taken = sum(d["samples"] for d in others) - 2000
        return {
            "idle": sum(not each.closed for each in idle),
            "offender_cut_off_after_s": round(offender.told - began, 2),
            "offender_closed_after_s": round(closed[0], 2),
            "others_lost": sent - taken,
            "p99_ms": said(viewer, sent)["p99_ms"],
            "rss_mib": round(server.rss(), 1),
        }
    finally:
        server.end()


async def malformed(count: int) -> dict[str, Any]:
    """S4: so many malformed frames beside a device that sends good ones."""
    server = Served()
    random = np.random.default_rng(0)
    try:
        good = await joined(server.port, "/ws/device/good")
        pushed = asyncio.create_task(pushing([good], 100, 1, 5.0))
        sent = errors = connections = 0
        good_frame = frames.encoded(np.zeros((2, 10)), 0)
        while sent < count:
            bad = await joined(server.port, f"/ws/device/bad{connections % 50}")
            connections += 1
            for _ in range(10):
                body = bytearray(good_frame[: int(random.integers(0, len(good_frame)))])
                if len(body) > 3 and random.random() < 0.5:
                    body[int(random.integers(0, 3))] ^= int(random.integers(1, 255))
                bad.transport.write(masked(bytes(body)))
                sent += 1
            end = time.monotonic() + 5
            while not bad.closed and time.monotonic() < end:
                await asyncio.sleep(0)
            errors += bad.texts - 1  # the welcome
            bad.transport.close()
        good_sent = await pushed
        await asyncio.sleep(0.2)
        health = {d["id"]: d for d in (await asyncio.to_thread(http, server.port, "/healthz"))["devices"]}
        return {
            "frames": sent,
            "errors_told": errors,
            "connections_closed": connections,
            "rejected": sum(d["rejected"] for d in health.values()),
            "good_device_lost": good_sent - health["good"]["samples"],
            "alive": server.process.poll() is None,
            "rss_mib": round(server.rss(), 1),
        }
    finally:
        server.end()


async def killed(seconds: float, kills: int) -> dict[str, Any]:
    """S8: kill -9 at random instants under load, the same folder again; and S7's cuts come with it."""
    random = np.random.default_rng(0)
    devices, rate = 50, 100
    n = int(seconds * rate)
    made = [rows(k, n) for k in range(devices)]
    with tempfile.TemporaryDirectory() as folder:
        broken, serving, known = 0, [], [0] * devices
        for turn in range(kills + 1):
            server = Served("--record", folder, "--max-rate", "100000")
            serving.append(server.start)
            found = [await joined(server.port, f"/ws/device/d{k}") for k in range(devices)]
            await asyncio.sleep(0.1)
            at = [each.next for each in found]
            broken += sum(a < k for a, k in zip(at, known, strict=True))
            last = turn == kills
            end = time.monotonic() + (600 if last else float(random.uniform(0.5, 2.5)))
            while time.monotonic() < end and (any(a < n for a in at) or (last and min(f.acked for f in found) < n)):
                for k, each in enumerate(found):
                    if at[k] < n:
                        each.transport.write(masked(frames.encoded(made[k][at[k] : at[k] + 5], at[k])))
                        at[k] = min(at[k] + 5, n)
                await asyncio.sleep(5 / rate / (5 if last else 1))
            known = [max(a, each.acked) for a, each in zip(known, found, strict=True)]
            server.end(signal.SIGTERM if last else signal.SIGKILL)
            for each in found:
                with suppress(Exception):
                    each.transport.abort()
        session = next(Path(folder).iterdir())
        worst, missing = 0.0, 0
        for k in range(devices):
            kept = poise.read(session / f"d{k}.parquet")
            missing += n - len(kept)
            uncut = poise.estimate(poise.SelfCalibrating(), recording(made[k]))
            found_attitude = poise.read_attitude(session / f"d{k}.self-calibrating.attitude.parquet")
            if len(found_attitude) == n:
                worst = max(worst, float(np.abs(found_attitude.quat - uncut.quat).max()))
            else:
                worst = float("inf")
        return {
            "kills": kills,
            "devices": devices,
            "samples": n * devices,
            "acknowledged_lost": broken,
            "samples_missing": missing,
            "largest_difference": worst,
            "serving_again_s": round(max(serving), 2),
        }


def rows(seed: int, n: int) -> np.ndarray[Any, Any]:
    from poise.simulation import Sensor, forearm, measure

    made = measure(forearm(n / 100 + 1.0, rate=100.0), Sensor(), seed=seed)
    return np.column_stack([made.time, made.gyr, made.acc, made.mag])[:n]


def recording(values: np.ndarray[Any, Any]) -> poise.Recording:
    return poise.Recording(values[:, 0], values[:, 1:4], values[:, 4:7], values[:, 7:10])


def http(port: int, path: str) -> Any:
    import httpx

    return httpx.get(f"http://127.0.0.1:{port}{path}", timeout=30).json()


async def recorded(seconds: float) -> dict[str, Any]:
    with tempfile.TemporaryDirectory() as folder:
        return await load(seconds, 200, 100, 1, "--record", folder)


SCENARIOS: dict[str, Callable[[float], Any]] = {
    "load": lambda s: load(s, 200, 100, 1),
    "load-frames": lambda s: load(s, 1000, 10, 10),
    "load-recorded": recorded,
    "stalled": stalled,
    "flood": flood,
    "malformed": lambda s: malformed(int(10_000 * s)),
    "killed": lambda s: killed(s, 10),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenarios", nargs="*", metavar="SCENARIO", help=", ".join(SCENARIOS))
    parser.add_argument("--seconds", type=float, default=10.0)
    asked = parser.parse_args()
    kept = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    gc.freeze()  # what measures should not stand still itself
    gc.disable()
    for name in asked.scenarios or SCENARIOS:
        gc.collect()
        others = os.getloadavg()[0]
        found = uvloop.run(SCENARIOS[name](asked.seconds))
        kept[name] = found | {"seconds": asked.seconds, "load_before": round(others, 1)}
        print(name, json.dumps(kept[name]), flush=True)
        RESULTS.write_text(json.dumps(kept, indent=1) + "\n")


if __name__ == "__main__":
    main()
