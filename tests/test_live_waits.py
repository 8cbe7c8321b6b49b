"""How long samples waited, by device: quantiles within their bins of 10 %."""

from __future__ import annotations

import numpy as np
import pytest

from live_helpers import made, rows_of, send, serving, wait_for
from poise.live.waits import Waits, WaitsOf


def test_quantiles_of_each_device_are_those_of_its_waits() -> None:
    random = np.random.default_rng(2)
    waits, one = WaitsOf(), Waits()
    drawn = np.exp(random.normal(-5.0, 0.5, (1500, 3)))
    numbers = np.array([40, 3, 100])
    for row in drawn:
        waits.add(numbers, row)
        one.add(row[1])
    for share in (0.5, 0.99):
        found = waits.quantiles([3, 40, 100, 7, 5000], share)
        wanted = np.quantile(drawn, share, axis=0)
        np.testing.assert_allclose(found[:3], wanted[[1, 0, 2]], rtol=0.15)
        assert found[3:] == [0.0, 0.0]
        assert found[0] == pytest.approx(one.quantile(share))


def test_what_is_long_ago_counts_less() -> None:
    waits, numbers = WaitsOf(), np.array([0])
    for seconds, times in ((1.0, 2000), (0.001, 12_000)):
        for _ in range(times):
            waits.add(numbers, np.array([seconds]))
    assert waits.quantiles([0], 0.98)[0] < 0.002


def test_waits_without_end_are_in_the_last_bin_and_none_in_the_first() -> None:
    waits = WaitsOf()
    waits.add(np.array([0, 1]), np.array([1e9, -1.0]))
    long, none = waits.quantiles([0, 1], 0.5)
    assert long > 100.0
    assert none < 2e-4


def test_health_and_metrics_have_them() -> None:
    rows = rows_of(made(1.0))
    with serving() as live, live.device("a") as device:
        live.call(lambda: live.hub.set_joint("elbow", "a", "b"))
        send(device, rows)
        wait_for(lambda: live.hub.devices["a"].health.samples == len(rows))
        said = wait_for(lambda: (d := live.http.get("/healthz").json()["devices"]) and d[0]["wait_ms"]["p50"] and d)
        assert 0.0 < said[0]["wait_ms"]["p50"] <= said[0]["wait_ms"]["p99"] < 20_000.0
        assert said[1]["wait_ms"] == {"p50": None, "p99": None}
        text = live.http.get("/metrics").text
        line = next(
            line
            for line in text.splitlines()
            if line.startswith('poise_device_wait_seconds{device="a",quantile="0.99"}')
        )
        assert float(line.split()[-1]) > 0.0
