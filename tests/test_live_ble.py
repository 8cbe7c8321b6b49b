"""BLE without a radio: bleak's client and scanner are doubles, all behind them is the real thing."""

from __future__ import annotations

import asyncio
import struct
from types import SimpleNamespace
from typing import Any

import bleak
import numpy as np
import pytest
from bleak.exc import BleakBluetoothNotAvailableError, BleakBluetoothNotAvailableReason, BleakError
from numpy.typing import NDArray

from live_helpers import METHOD, serving, wait_for
from poise.cli import run
from poise.live import ble
from poise.live.ble import Ble
from poise.live.described import Decoder, Description
from poise.live.devices import DeviceError
from poise.live.serial_port import SerialPort

UUID = "0000a001-0000-1000-8000-00805f9b34fb"
FIELDS = ["ax[g] i16", "ay i16", "az i16", "gx[deg/s] i16", "gy i16", "gz i16"]
TABLE: dict[str, Any] = {
    "rate": 50,
    "ble": {"characteristic": UUID},
    "frame": {"fields": FIELDS},
    "scale": {"acc": 1 / 2048, "gyr": 1 / 16.4},
}


def packed(n: int, first: int = 0) -> bytes:
    return b"".join(struct.pack("<6h", k, 0, 2048, 164, 0, -k) for k in range(first, first + n))


class Radio:
    """What the doubles of bleak find and hear; one entry of *sessions* a connection, the last one stays."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, *sessions: Any) -> None:
        self.sessions, self.scans, self.connections, self.closed = list(sessions), 0, 0, 0
        self.absent: list[Any] = []
        """what the first scans answer, before the device is found"""
        self.properties = ["notify"]
        radio = self

        class Scanner:
            @staticmethod
            async def find_device_by_filter(wanted: Any, timeout: float) -> Any:
                radio.scans += 1
                await asyncio.sleep(0)
                if radio.absent:
                    answer = radio.absent.pop(0)
                    if isinstance(answer, Exception):
                        raise answer
                    return None
                other = SimpleNamespace(name="Toaster", address="11:22:33:44:55:66")
                band = SimpleNamespace(name="Arm Band", address="AA:BB:CC:DD:EE:FF")
                near = [each for each in (other, band) if wanted(each, SimpleNamespace(local_name=each.name))]
                return near[0] if near else None

        class Client:
            def __init__(self, device: Any, disconnected: Any) -> None:
                assert device.name == "Arm Band"
                self._disconnected = disconnected
                one = SimpleNamespace(uuid=UUID, properties=radio.properties)
                self.services = SimpleNamespace(
                    characteristics={1: one}, get_characteristic=lambda uuid: one if uuid == UUID else None
                )

            async def __aenter__(self) -> Any:
                radio.connections += 1
                self._heard = radio.sessions.pop(0) if radio.sessions else []
                if isinstance(self._heard, Exception):
                    raise self._heard
                return self

            async def __aexit__(self, *_: object) -> None:
                radio.closed += 1

            async def start_notify(self, uuid: str, callback: Any) -> None:
                assert uuid == UUID
                for data in self._heard:
                    callback(None, bytearray(data))
                if radio.sessions:
                    self._disconnected(self)

        monkeypatch.setattr(bleak, "BleakScanner", Scanner)
        monkeypatch.setattr(bleak, "BleakClient", Client)
        monkeypatch.setattr(ble, "_RETRY", 0.001)


def source(name: str = "Arm Band", **changes: Any) -> Ble:
    return Ble(name, Description.of(TABLE | changes))


def played(device: Ble, n: int) -> NDArray[np.float64]:
    async def take() -> list[Any]:
        found: list[Any] = []
        arrivals = device.arrivals()
        async for arrival in arrivals:
            found.append(arrival.rows)
            if sum(map(len, found)) >= n:
                break
        await arrivals.aclose()  # type: ignore[attr-defined]
        return found

    return np.concatenate(asyncio.run(asyncio.wait_for(take(), 10.0)))


@pytest.mark.parametrize("name", ["Arm Band", "aa:bb:cc:dd:ee:ff"])
def test_notifications_are_samples_and_a_cut_connection_is_made_again(
    monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    radio = Radio(
        monkeypatch, [packed(2), packed(1, 2)], BleakError("failed"), TimeoutError(), [packed(1, 3)[:-1], packed(3, 3)]
    )
    radio.absent = [None]
    device, said = source(name), []
    device.tell = said.append
    rows = played(device, 6)
    np.testing.assert_allclose(rows[:, 0], np.arange(6) / 50)
    np.testing.assert_allclose(rows[:, 4], np.arange(6) / 2048 * 9.80665)
    np.testing.assert_allclose(rows[:, 1], np.radians(10.0))
    np.testing.assert_allclose(rows[:, 3], np.radians(-np.arange(6) / 16.4))
    assert np.isnan(rows[:, 7:10]).all()
    assert device.rejected == 1
    assert radio.connections == 4
    assert radio.closed == 2
    assert [text.removeprefix(f"ble:{name}: ").split()[0] for text in said] == [
        "not", "connected", "the", "cannot", "cannot", "connected",
    ]  # fmt: skip


def test_frames_with_a_sync_may_be_cut_anywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    data = b"".join(b"\x55\x61" + packed(1, k) for k in range(20))
    Radio(monkeypatch, [data[at : at + 17] for at in range(0, len(data), 17)])
    rows = played(source(frame={"sync": "55 61", "fields": FIELDS}), 20)
    np.testing.assert_allclose(rows[:, 4], np.arange(20) / 2048 * 9.80665)


def test_it_is_a_device_of_the_hub(monkeypatch: pytest.MonkeyPatch) -> None:
    Radio(monkeypatch, [packed(60)])
    with serving(source()) as live:
        wait_for(lambda: "Arm-Band" in live.hub.devices and live.hub.devices["Arm-Band"].health.samples == 60)
        assert live.hub.devices["Arm-Band"].shape == "band"
        assert any(event["text"] == "ble:Arm Band: connected" for event in live.hub.happened.all())


def test_no_bluetooth_is_refused_at_first_and_waited_for_later(monkeypatch: pytest.MonkeyPatch) -> None:
    away = BleakBluetoothNotAvailableError("no adapter", BleakBluetoothNotAvailableReason.NO_BLUETOOTH)
    for problem in (away, FileNotFoundError(2, "No such file or directory")):
        Radio(monkeypatch).absent = [problem]
        with pytest.raises(DeviceError, match=r"no Bluetooth here .*is there an adapter"):
            played(source(), 1)
    Radio(monkeypatch, [packed(2)]).absent = [None, away, away]
    assert len(played(source(), 2)) == 2


def test_a_characteristic_that_is_not_there_or_says_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    Radio(monkeypatch)
    with pytest.raises(DeviceError, match=f"no characteristic 00002a37-.*those that notify: {UUID}"):
        played(source(ble={"characteristic": "2A37"}), 1)
    Radio(monkeypatch).properties = ["read"]
    with pytest.raises(DeviceError, match="does not notify; those that notify: none"):
        played(source(), 1)


def test_descriptions_that_will_not_do(capsys: pytest.CaptureFixture[str]) -> None:
    for changes, said in (
        ({"ble": {"characteristic": "heart"}}, "expected characteristic"),
        ({"ble": {"service": UUID}}, "expected characteristic"),
        ({"ble": UUID}, "expected characteristic"),
        ({"frame": {"fields": FIELDS, "sync": ""}}, "sync"),
    ):
        with pytest.raises(DeviceError, match=said):
            Description.of(TABLE | changes)
    with pytest.raises(DeviceError, match="expected sync and fields"):
        Description.of({key: value for key, value in TABLE.items() if key != "ble"})
    with pytest.raises(DeviceError, match="has no sync"):
        SerialPort("/dev/null", Description.of(TABLE))
    rows, _ = Decoder(Description.of(TABLE)).message(packed(3))
    assert len(rows) == 3
    assert run(["live", "ble:Arm Band", "-m", METHOD, "--port", "0"]) == 2
    assert "--describe FILE.toml is needed" in capsys.readouterr().err
