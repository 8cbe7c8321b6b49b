"""Scenes of a robot that stands, topples, is bumped, lifted or dropped, from formulas: what a sensor on it measures."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

import poise
from poise.math import arrays
from poise.simulation import Sensor, Triad, measure
from poise.simulation.motion import Motion

Floats = NDArray[np.float64]
RATE = 200.0
G = 9.80665

# The class of an MPU-6050: 0.005 °/s/√Hz, 400 µg/√Hz, offsets of a degree per second and 50 mg, 3 % scale.
MPU_6050 = Sensor(
    gyr=Triad(
        noise=np.radians(0.005), bias=np.radians(1.0), scale=0.01, misalignment=0.01, resolution=np.radians(1 / 65.5)
    ),
    acc=Triad(noise=400e-6 * G, bias=0.05 * G, scale=0.03, misalignment=0.01, resolution=G / 8192),
)


def times(duration: float, rate: float = RATE) -> Floats:
    return np.arange(round(duration * rate)) / rate


def motion(time: Floats, lean: Floats, height: Floats | None = None, mast: float = 0.3, way: str = "forward") -> Motion:
    """A robot that leans by *lean* (n,) rad about a point that rises by *height* (n,) m; the sensor sits *mast* m above it."""
    height = np.zeros_like(time) if height is None else height
    lean, height = gaussian_filter1d(lean, 2.0), gaussian_filter1d(height, 2.0)  # a blow lasts some 20 ms
    rate, half = np.gradient(lean, time), 0.5 * lean
    zero = np.zeros_like(time)
    axis = {"forward": (-1, 0), "back": (1, 0), "left": (0, -1), "right": (0, 1)}[way]
    quat = np.column_stack([np.cos(half), axis[0] * np.sin(half), axis[1] * np.sin(half), zero])
    place = arrays.rotate(quat, np.array([0.0, 0.0, mast])) + np.column_stack([zero, zero, height])
    acceleration = np.gradient(np.gradient(place, time, axis=0), time, axis=0)
    return Motion(time, quat, np.column_stack([axis[0] * rate, axis[1] * rate, zero]), acceleration)


def recorded(scene: Motion, sensor: Sensor = MPU_6050, seed: int = 0) -> poise.Recording:
    return measure(scene, sensor, seed=seed)


def step(u: Floats) -> Floats:
    """From 0 to 1 over u in [0, 1], with no jerk at the ends."""
    v = np.clip(u, 0.0, 1.0)
    return np.asarray(v**3 * (10.0 - 15.0 * v + 6.0 * v**2))


def toppling(time: Floats, at: float, length: float = 0.4, push: float = 0.3, end: float = 90.0) -> Floats:
    """The lean of a pendulum of *length* m pushed off upright at *push* rad/s, to the ground at *end* degrees."""
    lean, speed, out = 0.0, push, np.zeros_like(time)
    fine = 50
    for i in range(1, len(time)):
        for _ in range(fine if time[i] > at else 0):
            dt = (time[i] - time[i - 1]) / fine
            speed += G / length * np.sin(lean) * dt
            lean += speed * dt
        if lean >= np.radians(end):
            out[i:] = np.radians(end)
            break
        out[i] = lean
    return out


def first(events: list[poise.data.event.TipEvent], name: str) -> float:
    """s of the first event of that state; NaN where there is none."""
    return next((event.time for event in events if event.state.name == name), float("nan"))


def names(events: list[poise.data.event.TipEvent]) -> list[str]:
    return [event.state.name for event in events]


Scene = Callable[[Floats], Motion]
