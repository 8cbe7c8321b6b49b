"""A device's clock against the host's."""

from __future__ import annotations

import numpy as np
import pytest

from poise.live.clock import DeviceClock


def fed(
    drift: float, jitter: float, seconds: float = 90.0, rate: float = 100.0, seed: int = 0
) -> tuple[DeviceClock, float]:
    """A clock that saw a device 1000 s behind, and what its host time is at the device's time of *seconds*."""
    random = np.random.default_rng(seed)
    clock = DeviceClock()
    for device in np.arange(0.0, seconds, 1.0 / rate):
        host = 1000.0 + device * (1.0 + drift) + 0.002 + random.exponential(jitter)
        clock.update(float(device), float(host))
    return clock, 1000.0 + seconds * (1.0 + drift) + 0.002


@pytest.mark.parametrize("drift", [0.0, 50e-6, -200e-6, 5e-3])
def test_offset_and_drift_are_found_behind_the_jitter(drift: float) -> None:
    clock, expected = fed(drift, jitter=0.02)
    assert clock.drift_ppm == pytest.approx(1e6 * drift, abs=30.0)
    assert clock.host(90.0) == pytest.approx(expected, abs=1.5e-3)
    assert clock.device(clock.host(42.0)) == pytest.approx(42.0, abs=1e-9)
    a, b = clock.line
    assert a + b * 17.0 == pytest.approx(clock.host(17.0), abs=1e-9)


def test_host_times_of_even_stamps_are_even() -> None:
    """The jitter of arrival does not reach the mapped stamps: between two fits they are a straight line."""
    clock, _ = fed(1e-4, jitter=0.02)
    steps = np.diff([clock.host(90.0 + 0.01 * k) for k in range(50)])
    assert np.ptp(steps) < 1e-9


def test_no_stamp_is_mapped_behind_its_arrival() -> None:
    random = np.random.default_rng(1)
    clock = DeviceClock()
    for device in np.arange(0.0, 30.0, 0.01):
        host = float(500.0 + device + 0.003 + random.exponential(0.01))
        clock.update(float(device), host)
        assert clock.host(float(device)) <= host + 1e-9


def test_a_clock_that_is_set_begins_anew() -> None:
    clock = DeviceClock()
    for k in range(1000):
        clock.update(0.01 * k, 100.0 + 0.01 * k)
    for k in range(1000, 2000):  # the device was restarted
        clock.update(0.01 * (k - 1000), 100.0 + 0.01 * k)
    assert clock.restarts == 1
    assert clock.host(9.99) == pytest.approx(119.99, abs=1e-6)
    for k in range(2000, 3000):  # and set an hour ahead
        clock.update(3600.0 + 0.01 * k, 100.0 + 0.01 * k)
    assert clock.restarts == 2
    assert clock.host(3629.99) == pytest.approx(129.99, abs=1e-6)


def test_a_stall_of_the_link_is_no_set_clock() -> None:
    clock = DeviceClock()
    for k in range(1000):
        clock.update(0.01 * k, 100.0 + 0.01 * k)
    for k in range(1000, 1300):  # three seconds of samples that come all at once
        clock.update(0.01 * k, 113.0 + 1e-5 * (k - 1000))
    for k in range(1300, 2000):
        clock.update(0.01 * k, 100.0 + 0.01 * k)
    assert clock.restarts == 0
    assert clock.host(19.99) == pytest.approx(119.99, abs=1e-6)


def test_stamps_that_are_none_change_nothing() -> None:
    clock = DeviceClock()
    assert np.isnan(clock.host(1.0))
    clock.update(float("nan"), 5.0)
    clock.update(1.0, float("inf"))
    assert np.isnan(clock.offset)
    clock.update(1.0, 5.0)
    assert clock.offset == pytest.approx(4.0)
