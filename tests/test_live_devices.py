"""Samples from real sockets, a pty pair and a real broker, and what a description makes of bytes."""

from __future__ import annotations

import os
import shutil
import socket
import struct
import subprocess
import time
import tty
from collections.abc import Iterator
from contextlib import suppress
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import poise
from live_helpers import made, rows_of, serving, wait_for
from poise.errors import PoiseError
from poise.live import frames
from poise.live.described import Decoder, Description
from poise.live.device import Device
from poise.live.devices import DeviceError
from poise.live.mqtt import Mqtt
from poise.live.replay import Replay
from poise.live.serial_port import SerialPort
from poise.live.sources import apart, source
from poise.live.udp import Udp

RECORDING = made(3.0)
ROWS = rows_of(RECORDING)
BINARY = {
    "device": "glove",
    "rate": 100,
    "frame": {
        "sync": "AA 55",
        "fields": [f"{name} i16" for name in ("gx[deg/s]", "gy", "gz", "ax[g]", "ay", "az")],
        "checksum": "sum8",
    },
    "scale": {"gyr": 1 / 16.4, "acc": 1 / 2048},
}


def lines(rows: NDArray[np.float64]) -> bytes:
    return "".join(",".join(map(repr, row)) + "\n" for row in rows.tolist()).encode()


def arrived(live: Any, name: str, n: int) -> Any:
    """The attitude after sample n of a device."""

    def latest() -> Any:
        device = live.hub.devices.get(name)
        return device and device.done == n and device.runs and device.runs[0].stream.latest

    return wait_for(lambda: live.call(latest))


def same_end(live: Any, name: str, recording: poise.Recording) -> None:
    latest = arrived(live, name, len(recording))
    np.testing.assert_array_equal(latest.quat[0], poise.estimate(poise.AdaptiveGain(), recording).quat[-1])


# -- UDP ------------------------------------------------------------------------------------------------------------


@pytest.fixture
def sender() -> Iterator[socket.socket]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as made:
        yield made


def bound(port: Udp) -> tuple[str, int]:
    wait_for(lambda: port.port)
    return "127.0.0.1", port.port


def test_datagrams_of_every_kind(sender: socket.socket) -> None:
    udp = Udp("127.0.0.1", 0)
    with serving(udp) as live:
        to = bound(udp)
        for k in range(0, 300, 10):
            sender.sendto(b"@binary\n" + frames.encoded(ROWS[k : k + 10], k), to)
            sender.sendto(lines(ROWS[k : k + 10]), to)
            sender.sendto(b'@json\n{"time": %r, "gyr": [0, 0, 0], "acc": [0, 0, 9.8]}' % (k / 100), to)
            sender.sendto(b"nonsense", to)
        same_end(live, "binary", RECORDING)
        same_end(live, "127.0.0.1", RECORDING)
        arrived(live, "json", 30)
        wait_for(lambda: udp.rejected == 30)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:  # at the same address
            other.sendto(lines(ROWS[:1]), to)
            arrived(live, f"127.0.0.1:{other.getsockname()[1]}", 1)


def test_made_up_names_take_few_places_and_noise_none(sender: socket.socket, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("poise.live.udp._MOST_PEERS", 3)
    udp = Udp("127.0.0.1", 0)
    with serving(udp) as live:
        to = bound(udp)
        for k in range(10):
            sender.sendto(b"@noise%d\nnonsense" % k, to)
        for k in range(5):
            sender.sendto(b"@made%d\n" % k + frames.encoded(ROWS[:10], 0), to)
        wait_for(lambda: udp.rejected == 12)
        wait_for(lambda: len(live.hub.devices) == 3)
        assert list(live.hub.devices) == ["made0", "made1", "made2"]
        sender.sendto(b"@made1\n" + frames.encoded(ROWS[10:20], 10), to)  # whoever has a place keeps it
        arrived(live, "made1", 20)


def test_lost_and_late_datagrams_are_counted(sender: socket.socket) -> None:
    udp = Udp("127.0.0.1", 0)
    with serving(udp) as live:
        to = bound(udp)
        for k in (0, 1, 2, 5, 6, 4, 6, 7):
            sender.sendto(b"@counting\n" + frames.encoded(ROWS[10 * k : 10 * k + 10], 10 * k), to)
            time.sleep(0.01)
        health = wait_for(lambda: "counting" in live.hub.devices and live.hub.find("counting").health)
        wait_for(lambda: health.samples == 60)
    assert (health.lost, health.repeated) == (20, 20)


def test_a_port_that_is_taken_is_an_event() -> None:
    first = Udp("127.0.0.1", 0)
    with serving(first) as live:
        with serving(Udp("127.0.0.1", bound(first)[1])) as other:
            wait_for(lambda: any("cannot listen" in event["text"] for event in other.hub.happened.all()))
            answer = other.http.get("/healthz")
            assert answer.status_code == 503
            assert any("cannot listen" in reason for reason in answer.json()["reasons"])
            assert 'state="failed"} 1' in other.http.get("/metrics").text
        assert live.http.get("/healthz").status_code == 200
        assert live.http.get("/healthz").json()["sources"] == [{"name": first.name, "state": "ok", "text": ""}]


def test_a_source_that_floods_is_held_to_the_rate_and_its_neighbour_loses_nothing(sender: socket.socket) -> None:
    udp = Udp("127.0.0.1", 0)
    with serving(udp, max_rate=200.0) as live:
        to = bound(udp)
        for k in range(0, 6000, 20):
            k %= 300
            sender.sendto(b"@flood\n" + lines(ROWS[k : k + 20]), to)
            if k % 100 == 0:
                time.sleep(0.01)
        sender.sendto(b"@calm\n" + frames.encoded(ROWS[:100], 0), to)
        arrived(live, "calm", 100)
        flood = live.hub.find("flood").health
        wait_for(lambda: flood.samples + flood.throttled == 6000)
        assert flood.throttled > 3000
        assert any(event["kind"] == "throttled" and event["device"] == "flood" for event in live.hub.happened.all())
        assert f'poise_device_throttled_total{{device="flood"}} {flood.throttled}' in live.http.get("/metrics").text


# -- serial ---------------------------------------------------------------------------------------------------------


class Pty:
    """A pty pair; *link* stands for the port, as udev would make it."""

    def __init__(self, link: Path) -> None:
        self.link = link
        self.plug()

    def plug(self) -> None:
        self.master, slave = os.openpty()
        tty.setraw(slave)
        self.link.symlink_to(os.ttyname(slave))
        self._slave = slave

    def unplug(self) -> None:
        self.link.unlink()
        os.close(self.master)
        os.close(self._slave)

    def write(self, data: bytes) -> None:
        for k in range(0, len(data), 1000):  # a terminal takes 4 KiB at a time
            os.write(self.master, data[k : k + 1000])
            time.sleep(0.002)


def test_lines_at_a_serial_port_and_a_replug(tmp_path: Path) -> None:
    port = Pty(tmp_path / "ttyARM")
    with serving(SerialPort(str(port.link))) as live:
        time.sleep(0.3)
        port.write(b"9.8,0,0\n" + lines(ROWS[:150]))  # it began in the middle of a line
        arrived(live, "ttyARM", 150)
        port.unplug()
        wait_for(lambda: live.hub.find("ttyARM").health.silent)
        port.plug()
        time.sleep(0.6)
        port.write(lines(ROWS[150:]))
        same_end(live, "ttyARM", RECORDING)
        port.unplug()


def test_binary_frames_at_a_serial_port(tmp_path: Path) -> None:
    port = Pty(tmp_path / "ttyGLOVE")
    counts = np.round(np.column_stack([RECORDING.gyr * 180 / pi * 16.4, RECORDING.acc / 9.80665 * 2048])).astype("<i2")
    made_frames = [b"\xaa\x55" + body + bytes([sum(body) & 0xFF]) for body in (row.tobytes() for row in counts)]
    spoilt = made_frames[5][:7] + b"\x00\xff" + made_frames[5][9:]
    port_source = SerialPort(str(port.link), Description.of(BINARY))
    with serving(port_source) as live:
        time.sleep(0.3)
        port.write(b"\x55\x01\xaa" + b"".join([*made_frames[:100], spoilt, *made_frames[100:]]))
        arrived(live, "glove", len(counts))
        port.unplug()
    latest = live.hub.newest.records[live.hub.find("glove").runs[0].slot]
    np.testing.assert_allclose(latest["acc"], counts[-1, 3:] / 2048 * 9.80665, rtol=1e-6)
    np.testing.assert_allclose(latest["time"], (len(counts) - 1) / 100)
    assert port_source.rejected >= 1


# -- MQTT -----------------------------------------------------------------------------------------------------------


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[int]:
    program = shutil.which("mosquitto") or "/usr/sbin/mosquitto"
    if not Path(program).exists():
        if os.environ.get("CI"):
            pytest.fail("mosquitto is not installed")
        pytest.skip("mosquitto is not installed")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = int(free.getsockname()[1])
    config = tmp_path / "mosquitto.conf"
    config.write_text(f"listener {port} 127.0.0.1\nallow_anonymous true\n")
    running = subprocess.Popen([program, "-c", str(config)], stderr=subprocess.DEVNULL)

    def up() -> bool:
        with socket.socket() as tried:
            return tried.connect_ex(("127.0.0.1", port)) == 0

    wait_for(up)
    yield port
    running.terminate()
    running.wait(10)


def test_messages_at_a_broker(broker: int) -> None:
    from paho.mqtt.client import Client
    from paho.mqtt.enums import CallbackAPIVersion

    with serving(Mqtt(f"mqtt://127.0.0.1:{broker}/lab/+")) as live:
        client = Client(CallbackAPIVersion.VERSION2)
        client.connect("127.0.0.1", broker)
        client.loop_start()
        time.sleep(0.5)  # until poise has subscribed
        for k in range(0, 300, 10):
            client.publish("lab/leg", frames.encoded(ROWS[k : k + 10], k), qos=1)
            client.publish("lab/arm", lines(ROWS[k : k + 10]), qos=1)
        same_end(live, "leg", RECORDING)
        same_end(live, "arm", RECORDING)
        client.disconnect()
        client.loop_stop()


@pytest.mark.parametrize(
    "source", [Mqtt("mqtt://127.0.0.1:1/lab/+"), SerialPort("/dev/ttyNowhere")], ids=["broker", "port"]
)
def test_what_is_not_there_is_said(source: Any) -> None:
    with serving(source) as live:
        told = wait_for(lambda: [e["text"] for e in live.hub.happened.all() if e["kind"] == "source"])
    assert told == [f"{source.name}: {source.trouble}"] and "it is" in told[0]


def test_a_password_is_in_no_name() -> None:
    assert "secret" not in Mqtt("mqtt://me:secret@broker/x").name
    assert Mqtt("mqtt://broker").name == "mqtt://broker:1883/poise/+"


# -- descriptions ---------------------------------------------------------------------------------------------------


def test_pieces_of_any_length_make_the_same_rows() -> None:
    described = Description.of({"columns": "t[ms], gx[deg/s], gy, gz, -, ax[g], ay, az"})
    text = b"12.5,0,0\n" + b"".join(b"%d;%d %d,%d,77,%d,0,1\r\n" % (10 * k, k, -k, 2 * k, k % 2) for k in range(50))
    whole = Decoder(described).feed(text)
    decoder = Decoder(described)
    pieces = np.concatenate([decoder.feed(text[k : k + 7]) for k in range(0, len(text), 7)])
    np.testing.assert_array_equal(whole, pieces)
    assert len(whole) == 50
    np.testing.assert_allclose(
        whole[3], [0.03, *np.array([3, -3, 6]) * pi / 180, 9.80665, 0, 9.80665, *[np.nan] * 3, 0, 0]
    )


def test_a_counter_that_wraps_goes_on() -> None:
    described = Description.of(
        {"frame": {"sync": "7e", "fields": ["time[us] u16", *[f"{s}{a} f32" for s in "ga" for a in "xyz"]]}}
    )
    stamps = (np.arange(300) * 10_000) % 65536
    data = b"".join(b"\x7e" + struct.pack("<H6f", stamp, 0, 0, 0, 0, 0, 9.8) for stamp in stamps)
    decoder = Decoder(described)
    found = np.concatenate([decoder.feed(data[k : k + 999]) for k in range(0, len(data), 999)])
    np.testing.assert_allclose(found[:, 0], np.arange(300) * 0.01, atol=1e-9)
    assert decoder.rejected == 0


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("columns = 'time,gx", "cannot be read as TOML"),
        ("speed = 1", "'speed' is none"),
        ("rate = 100", "either columns"),
        ("columns = 'time,gx,gy,gz,ax,ay'", "acc_z missing"),
        ("columns = 'gx,gy,gz,ax,ay,az'", "or has a rate"),
        ("columns = 'time,gx,gx,gz,ax,ay,az'", "a column twice"),
        ("columns = 'time,gx[parsec],gy,gz,ax,ay,az'", "unit 'parsec'"),
        ("columns = 'time,banana,gy,gz,ax,ay,az'", "'banana' is no column"),
        ("rate = -1\ncolumns = 'time,gx,gy,gz,ax,ay,az'", "expected a number"),
        ("[frame]\nfields = []", "expected sync and fields"),
        ("[frame]\nsync = 'aa'\nfields = 5", "expected sync and fields"),
        ("columns = 5", "columns: expected names"),
        ("rate = inf\ncolumns = 'gx,gy,gz,ax,ay,az'", "rate: expected a number"),
        ("baud = 0.5\ncolumns = 'time,gx,gy,gz,ax,ay,az'", "baud: expected a number"),
        ("columns = 'time,gx,gy,gz,ax,ay,az'\nscale = {acc = nan}", "scale: expected factors"),
        ("columns = 'time,gx,gy,gz,ax,ay,az'\nscale = {acc = 0}", "scale: expected factors"),
        ("[frame]\nsync = 'xx'\nfields = ['gx i16']", "in hex"),
        ("[frame]\nsync = 'aa'\nfields = ['gx i17']", "types u8"),
        ("[frame]\nsync = 'aa'\nfields = ['gx i16']\nchecksum = 'md5'", "checksum is one of"),
    ],
)
def test_a_description_that_cannot_be_is_refused(tmp_path: Path, text: str, says: str) -> None:
    path = tmp_path / "device.toml"
    path.write_text(text)
    with pytest.raises(DeviceError) as refused:
        Description.read(path)
    assert says in str(refused.value)


@pytest.mark.parametrize(
    "word",
    [
        "",
        "usb:1",
        "udp:nowhere",
        "udp::99999",
        "serial:",
        "mqtt://",
        "replay:",
        "replay:x@0x",
        "replay:x@1.2.3",
        "sim:arm@..",
    ],
)
def test_words_that_name_no_source(word: str) -> None:
    with pytest.raises(DeviceError):
        source(word, lambda path: RECORDING)


def test_a_speed_behind_a_replay() -> None:
    for word in ("replay:walk.csv@10", "replay:walk.csv@2.5x", "replay:a@b.csv@max"):
        found = source(word, lambda path: RECORDING)
        assert found is not None
        assert found.name.startswith("replay of")


def test_replays_of_one_name_are_devices_of_their_own() -> None:
    words = ("replay:walk.csv", "replay:walk.csv@2", "replay:other/walk.csv")
    found = apart([each for word in words if (each := source(word, lambda path: RECORDING))])
    assert [each.device for each in found if isinstance(each, Replay)] == ["replay", "replay-2", "replay-3"]


def test_no_bytes_bring_a_decoder_down() -> None:
    """Everything that is no sample is a FrameError: a datagram of anyone's must not end the server."""
    random = np.random.default_rng(0)
    seeds = [
        frames.encoded(ROWS[:3], 7),
        lines(ROWS[:3]),
        b'{"time": [1.0, 1.1], "gyr": [[0,0,0],[0,0,0]], "acc": [[0,0,9],[0,0,9]], "sequence": 3}',
        b'{"time": 1' + b"0" * 400 + b', "gyr": [0,0,0], "acc": [0,0,9]}',
        b'{"time": {}, "gyr": "abc", "acc": true, "mag": [[[]]]}',
        b'{"time": 1, "gyr": [0,0,0], "acc": [0,0,9], "sequence": 1e400}',
    ]
    decoders = [Decoder(), Decoder(Description.of(BINARY))]
    live = live_device()
    for turn in range(6000):
        data = bytearray(seeds[turn % len(seeds)])
        for _ in range(int(random.integers(0, 4))):
            data[int(random.integers(0, len(data)))] = int(random.integers(0, 256))
        data = data[: int(random.integers(0, len(data) + 1))] if random.random() < 0.3 else data
        for decoder in decoders:
            with suppress(PoiseError):
                rows, sequence = decoder.message(bytes(data))
                assert rows.shape[1] == 12
                live.receive(rows, 0.0, sequence)
            decoder.feed(bytes(data))
        with suppress(PoiseError):
            live.receive_frame(bytes(data), 0.0)


def live_device() -> Device:
    return Device("fuzzed", 0, "", {})


def test_a_name_that_cannot_be_stops_nobody(sender: socket.socket) -> None:
    udp = Udp("127.0.0.1", 0)
    with serving(udp) as live:
        to = bound(udp)
        sender.sendto(b"@../../etc\n" + frames.encoded(ROWS[:10], 0), to)
        sender.sendto(b"@fine\n" + frames.encoded(ROWS, 0), to)
        same_end(live, "fine", RECORDING)
        assert set(live.hub.devices) == {"fine"}
        assert live.server.feeding.refused == 1


def test_made_up_addresses_do_not_fill_the_memory() -> None:
    listening = Udp("127.0.0.1", 0)
    for k in range(30_000):
        listening._decoded([(b"nothing", (f"10.0.{k // 256}.{k % 256}", 9000))])
    assert listening.rejected == 30_000
    assert max(len(listening._owner), len(listening._decoders)) <= 10_000
