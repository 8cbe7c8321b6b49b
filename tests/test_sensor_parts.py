"""A part's samples have the noise, range, steps and delays that its data sheet and its bus state."""

from __future__ import annotations

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from poise.data.packet import Packet
from poise.data.recording import STANDARD_GRAVITY
from poise.errors import RecordingError
from poise.simulation import PERFECT, Sensor, Triad, at_rest, forearm, measure, parts
from poise.simulation.device import Device

UP, FIELD, STILL = np.array([0.0, 0.0, 9.81]), np.array([0.0, 19.7, -43.1]), np.zeros(3)


def sampled(device: Device, seconds: float) -> list[Packet]:
    """What a device at rest sends in time."""
    packets = []
    for i in range(1, round(seconds * device.rate) + 1):
        device.sample(i / device.rate, STILL, UP, FIELD)
        packets += device.arrived(i / device.rate)
    return packets


def allan(values: np.ndarray, rate: float, seconds: float) -> np.ndarray:
    """The Allan deviation (3,) over *seconds*."""
    size = round(seconds * rate)
    means = values[: len(values) // size * size].reshape(-1, size, 3).mean(axis=1)
    return np.asarray(np.sqrt(0.5 * np.mean(np.diff(means, axis=0) ** 2, axis=0)))


@pytest.mark.parametrize("name", [*parts.INERTIAL])
def test_the_allan_deviation_of_white_noise_is_the_data_sheets_density_over_the_root_of_time(name: str) -> None:
    stated, sensor = parts.INERTIAL[name], parts.part(name)
    packets = sampled(Device(sensor, 200.0, seed=5), 60.0)
    gyr, acc = np.array([p.gyr for p in packets]), np.array([p.acc for p in packets])
    for seconds in (0.1, 0.5):  # a bias that walks counts for more only later
        found = np.degrees(allan(gyr, 200.0, seconds)) * np.sqrt(seconds)
        np.testing.assert_allclose(found, stated.gyr_noise, rtol=0.25)
        found = allan(acc, 200.0, seconds) / (1e-6 * STANDARD_GRAVITY) * np.sqrt(seconds)
        np.testing.assert_allclose(found, stated.acc_noise, rtol=0.35)


def test_offsets_are_drawn_with_the_spread_that_parts_states() -> None:
    def offsets(as_delivered: bool) -> np.ndarray:
        sensor = parts.part("MPU-6050", as_delivered=as_delivered)
        return np.degrees([Device(sensor, 100.0, seed).gyr_bias for seed in range(400)]).std()

    assert offsets(False) == pytest.approx(0.5, rel=0.1)
    assert offsets(True) == pytest.approx(20.0 / 3.0, rel=0.1)


def test_readings_end_at_the_range_and_come_in_steps() -> None:
    device = Device(parts.part("MPU-6050"), 200.0, seed=1)
    device.sample(0.005, np.array([50.0, -50.0, 1.0]), np.array([300.0, 0.0, -300.0]), FIELD)
    (packet,) = device.arrived(1.0)
    assert abs(np.degrees(packet.gyr[0]) - 2000.0) < 0.1
    assert abs(np.degrees(packet.gyr[1]) + 2000.0) < 0.1
    np.testing.assert_allclose(np.abs(packet.acc)[[0, 2]] / STANDARD_GRAVITY, 16.0, atol=1e-3)
    step = radians(1 / 16.4)
    still = np.array([p.gyr for p in sampled(device, 2.0)]) / step
    np.testing.assert_allclose(still, np.round(still), atol=1e-6)


def test_samples_come_late_in_order_and_some_never() -> None:
    sensor = replace(parts.part("BMI270"), latency=0.0123, latency_jitter=0.004, dropout=0.1, jitter=1e-4)
    device, arrivals, sent = Device(sensor, 200.0, seed=3), [], []
    for i in range(1, 20001):  # asked every ms, in between samples too
        if i % 5 == 0 and device.sample(i / 1000, STILL, UP, FIELD):
            sent.append(i / 1000)
        arrivals += [(i / 1000, packet.time) for packet in device.arrived(i / 1000)]
    now, stamps = np.array(arrivals).T
    late = now - np.array(sent)[: len(now)]
    assert late.min() >= 0.0123
    assert late.mean() == pytest.approx(0.0123 + 0.004 * np.sqrt(2 / np.pi) + 0.0005, abs=0.0008)
    assert (np.diff(stamps) > 0).all()
    assert len(sent) == pytest.approx(3600, abs=80)
    assert (stamps - np.array(sent)[: len(now)]).std() == pytest.approx(1e-4, rel=0.1)


def test_a_slower_magnetometer_has_its_own_rate_and_lag() -> None:
    sensor = replace(PERFECT, mag_rate=75.0, mag_delay=0.012)
    device, found = Device(sensor, 200.0), []
    for i in range(1, 2001):
        time = i / 200
        device.sample(time, STILL, UP, np.array([time, 0.0, 0.0]))
        found += [(time, packet.mag[0]) for packet in device.arrived(time)]
    time, mag = np.array(found).T
    has = np.isfinite(mag)
    assert has.sum() == pytest.approx(750, abs=2)
    np.testing.assert_allclose((time - mag)[has][5:], 0.012, atol=1e-9)


def test_a_part_without_a_magnetometer_has_none() -> None:
    assert all(np.isnan(p.mag).all() for p in sampled(Device(parts.part("MPU-6050"), 200.0), 0.5))
    recording = measure(at_rest(duration=1.0), parts.part("LSM6DSOX"))
    assert not np.isfinite(recording.mag).any()
    assert parts.part("MPU-9250").mag is not None
    assert parts.part("MPU-6050+HMC5883L").mag_rate == 75.0


def test_formulas_lose_samples_as_a_device_does_and_are_otherwise_as_they_were() -> None:
    motion = forearm(20.0)
    whole, some = (measure(motion, replace(Sensor(), dropout=share), seed=2) for share in (0.0, 0.2))
    assert len(some) == pytest.approx(0.8 * len(whole), rel=0.05)
    kept = np.isin(whole.time, some.time)
    np.testing.assert_array_equal(whole.gyr[kept], some.gyr)
    assert some.truth is not None
    assert len(some.truth) == len(some)


def test_one_model_serves_formulas_and_worlds() -> None:
    """The same seed gives both the same scale, cross-axis errors and bias."""
    sensor = Sensor(gyr=Triad(bias=0.1, scale=0.1, misalignment=0.1), acc=Triad(bias=0.5), mag=None, jitter=0.0)
    device = Device(sensor, 100.0, seed=7)
    for i in range(1, 101):
        device.sample(i / 100, np.array([0.3, -0.2, 0.1]), UP, FIELD)
    live = device.arrived(9.0)[-1]
    still = measure(at_rest(duration=1.0), sensor, seed=7)
    np.testing.assert_allclose(live.acc - UP, still.acc[-1] - [0, 0, STANDARD_GRAVITY], atol=1e-12)
    assert not np.allclose(live.gyr - still.gyr[-1], [0.3, -0.2, 0.1], atol=1e-3), (
        "scale and cross-axis act on the rate"
    )
    np.testing.assert_allclose(live.gyr - still.gyr[-1], [0.3, -0.2, 0.1], atol=0.15)


@pytest.mark.parametrize("name", ["", "MPU", "QMC5883L", "MPU-6050+BMI270"])
def test_an_unknown_part_is_refused_with_those_there_are(name: str) -> None:
    with pytest.raises(RecordingError, match=r"expected one of MPU-6050.*QMC5883L"):
        parts.part(name)


def test_every_part_names_its_source() -> None:
    for name, part in (parts.INERTIAL | parts.MAGNETIC).items():
        assert len(part.source) > 10, name
    assert parts.names()[:2] == ["MPU-6050", "MPU-9250"]
