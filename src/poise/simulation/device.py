"""A sensor instant by instant, with the errors of :class:`Sensor` and the ways its samples arrive."""

from __future__ import annotations

from collections import deque
from math import inf, nan

import numpy as np
from numpy.typing import NDArray

from poise.data.packet import Packet
from poise.simulation.sensor import Readings, Sensor

Floats = NDArray[np.float64]


class Device:
    """One sensor of a world, instant by instant: its samples arrive late, uneven or not at all, as :class:`Sensor` says.

    *rate* is samples per second; the same errors and noise for the same *seed*.
    """

    def __init__(self, sensor: Sensor, rate: float, seed: int | np.random.SeedSequence = 0) -> None:
        self.sensor, self.rate = sensor, rate
        for_gyr, for_acc, for_mag, self._for_time, self._for_loss = np.random.default_rng(seed).spawn(5)
        self._gyr, self._acc = Readings(sensor.gyr, rate, for_gyr), Readings(sensor.acc, rate, for_acc)
        self._mag = None if sensor.mag is None else Readings(sensor.mag, sensor.mag_rate or rate, for_mag)
        self._mag_step = 1.0 / min(sensor.mag_rate or rate, rate)
        self._next_mag = 0.0
        self._fields: deque[tuple[float, Floats]] = deque(maxlen=2 + int(sensor.mag_delay * rate))
        self._on_the_way: deque[tuple[float, Packet]] = deque()
        self._last_arrival = -inf
        self.absent = np.full(3, nan)

    @property
    def gyr_bias(self) -> Floats:
        """(3,) rad/s, in the last sample of the gyroscope."""
        return np.asarray(self._gyr.bias)

    def sample(self, time: float, gyr: Floats, acc: Floats, field: Floats) -> bool:
        """Take a sample at *time* of the true rate, specific force and field in the sensor's axes; was it sent?"""
        sensor = self.sensor
        of_gyr, of_acc = self._gyr.of(gyr[None])[0][0], self._acc.of(acc[None])[0][0]
        of_mag = self._magnetic(time, field)
        jitter, late = self._for_time.standard_normal(2)
        most = 0.45 / self.rate
        stamp = time + min(max(sensor.jitter * jitter, -most), most)
        if sensor.dropout > 0.0 and self._for_loss.random() < sensor.dropout:
            return False
        arrival = max(self._last_arrival, time + sensor.latency + sensor.latency_jitter * abs(late))
        self._last_arrival = arrival
        self._on_the_way.append((arrival, Packet(stamp, of_gyr, of_acc, of_mag)))
        return True

    def arrived(self, now: float) -> list[Packet]:
        """The samples that arrived since this was asked last, *now* included, in order."""
        came = []
        while self._on_the_way and self._on_the_way[0][0] <= now + 1e-9:
            came.append(self._on_the_way.popleft()[1])
        return came

    def _magnetic(self, time: float, field: Floats) -> Floats:
        """The magnetometer's sample that is ready at *time*; NaN between its samples."""
        if self._mag is None:
            return self.absent
        self._fields.append((time, field))
        if time + 1e-9 < self._next_mag:
            return self.absent
        self._next_mag = max(self._next_mag, time - self._mag_step) + self._mag_step
        instant = time - self.sensor.mag_delay
        before = self._fields[0]
        for after in self._fields:
            if after[0] >= instant:
                break
            before = after
        part = 0.0 if after[0] <= before[0] else min(max((instant - before[0]) / (after[0] - before[0]), 0.0), 1.0)
        return np.asarray(self._mag.of((before[1] + part * (after[1] - before[1]))[None])[0][0])
