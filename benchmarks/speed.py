"""How fast poise is beside other packages, in one run on one machine.

    python benchmarks/speed.py [--rounds N] [--write]

Contenders take turns (A B A B …) and are warm before the first round, so that compiling is not counted and the machine's
moods meet all of them. Ratios are what to compare; the times belong to the machine they were measured on.
"""

from __future__ import annotations

import argparse
import gc
import json
import sys
from collections.abc import Callable, Sequence
from itertools import batched, cycle
from time import perf_counter_ns
from typing import Any, NamedTuple

import numpy as np

import accuracy
from peers import imufusion_filter, imufusion_units, installed, period
from poise import METHODS, Attitude, Packet, Recording, Stream, TwoStage, estimate
from poise.math import arrays
from poise.simulation import Sensor, forearm, measure
from stacked import Stacked
from tables import Cell, heading, table

ROUNDS = 9  # the least that is worth a median
SAMPLES, RATE = 57_000, 286.0
LIVE = 2_000  # samples a round, one a call
TARGET = (0.9238795325112867, 0.0, 0.0, 0.3826834323650898)  # w x y z: where the controller turns to
STIFFNESS, DAMPING = 4.0, 1.0  # N·m, N·m·s/rad
COLUMNS = ("min", "median", "min / {0}", "median / {0}")

Run = Callable[[], object]


class Timing(NamedTuple):
    """A contender's times and their ratios to the reference's."""

    least: float
    median: float
    least_ratio: float
    median_ratio: float
    """median over the rounds of the ratio within a round"""


def recording() -> Recording:
    """200 s of a made forearm, as long and as fast as a BROAD trial, by an ordinary sensor without absent samples."""
    return measure(forearm(SAMPLES / RATE, RATE), Sensor(mag_delay=0.0, jitter=0.0))


def interleaved(contenders: dict[str, Run], samples: int, rounds: int, reference: str) -> dict[str, Timing]:
    """ns per sample of contenders that take turns, after a first turn that is not counted."""
    for run in contenders.values():
        run()
    times: dict[str, list[float]] = {name: [] for name in contenders}
    gc.collect()
    gc.disable()
    try:
        for _ in range(rounds):
            for name, run in contenders.items():
                began = perf_counter_ns()
                run()
                times[name].append((perf_counter_ns() - began) / samples)
    finally:
        gc.enable()
    return {name: _timing(own, times[reference]) for name, own in times.items()}


def _timing(own: Sequence[float], reference: Sequence[float]) -> Timing:
    ratios = np.divide(own, reference)
    return Timing(min(own), float(np.median(own)), min(own) / min(reference), float(np.median(ratios)))


def batch(made: Recording) -> dict[str, Run]:
    """Whole recordings: every method as `estimate` runs it, the peers as they can."""
    from vqf import VQF

    seconds = period(made)
    runs: dict[str, Run] = {"vqf updateBatch": lambda: VQF(seconds).updateBatch(made.gyr, made.acc, made.mag)}
    for name, method in METHODS.items():
        runs[name] = _estimating(method(), made)
    runs["imufusion (a Python loop: it has no batch)"] = lambda: _imufusion_loop(made)
    return runs


def live(made: Recording) -> dict[str, Run]:
    """One sample a call, arrays of three in, an attitude out."""
    from vqf import VQF

    packets = _packets(made)
    runs: dict[str, Run] = {"vqf update + getQuat9D": _vqf_feed(VQF(period(made)), packets)}
    for name, method in METHODS.items():
        runs[f"{name} Stream.update"] = _feed(Stream(method()).update, packets)
    runs["imufusion update + get_quaternion"] = _imufusion_feed(made)
    return runs


def stages(made: Recording) -> dict[str, Run]:
    """Two stages beside one stacked update, both not decoupled, as `estimate` runs them and without its wrappers."""
    two, stacked = TwoStage(decouple=False), Stacked(TwoStage(decouple=False))
    return {
        "two stages": _estimating(two, made),
        "stacked": _estimating(stacked, made),
        "two stages, decoupled (default)": _estimating(TwoStage(), made),
        "two stages, bare": lambda: estimate(two, made, guard=False, rest_bias=False),
        "stacked, bare": lambda: estimate(stacked, made, guard=False, rest_bias=False),
    }


def control(made: Recording) -> dict[str, Run]:
    """A control cycle: one sample into a stream, a torque out."""
    packets = _packets(made)
    methods = {"two stages": TwoStage(decouple=False), "stacked": Stacked(TwoStage(decouple=False))}
    return {name: _feed(_cycle(Stream(method)), packets) for name, method in methods.items()}


def torque(attitude: Attitude) -> tuple[float, float, float]:
    """N·m in the body frame: a spring to TARGET along the shorter way, and a damper."""
    (w, x, y, z), (p, q, r) = attitude.quat[-1].tolist(), attitude.rate[-1].tolist()
    a, b, c, d = TARGET
    e0 = a * w + b * x + c * y + d * z  # TARGET* ⊗ attitude
    e1 = a * x - b * w - c * z + d * y
    e2 = a * y + b * z - c * w - d * x
    e3 = a * z - b * y + c * x - d * w
    k = -STIFFNESS if e0 >= 0.0 else STIFFNESS
    return k * e1 - DAMPING * p, k * e2 - DAMPING * q, k * e3 - DAMPING * r


def _cycle(stream: Stream) -> Callable[[Packet], object]:
    return lambda packet: torque(stream.update(packet))


def _estimating(method: Any, made: Recording) -> Run:
    return lambda: estimate(method, made)


def _packets(made: Recording) -> list[Packet]:
    return list(map(Packet, made.time.tolist(), made.gyr, made.acc, made.mag))


def _feed(update: Callable[[Packet], object], packets: list[Packet]) -> Run:
    """The next LIVE packets, one a call."""
    rounds = iter(batched(packets, LIVE))

    def run() -> None:
        for packet in next(rounds):
            update(packet)

    return run


def _vqf_feed(vqf: Any, packets: list[Packet]) -> Run:
    def update(packet: Packet) -> object:
        vqf.update(packet.gyr, packet.acc, packet.mag)
        return vqf.getQuat9D()

    return _feed(update, packets)


def _imufusion_feed(made: Recording) -> Run:
    _, ahrs = imufusion_filter(made)
    gyr, acc, mag = imufusion_units(made)

    def update(packet: Packet) -> object:
        ahrs.update(packet.gyr, packet.acc, packet.mag)
        return ahrs.get_quaternion()

    return _feed(update, list(map(Packet, made.time.tolist(), gyr, acc, mag)))


def _imufusion_loop(made: Recording) -> None:
    from peers import imufusion_ahrs

    imufusion_ahrs(made)
