"""How fast poise is beside other packages, in one run on one machine.

    python benchmarks/speed.py [--rounds N] [--write | GROUP...]

Contenders take turns (A B A B …) and are warm before the first round: compiling is not counted, and the machine's moods
meet all of them. Ratios are what to compare; the times belong to the machine they were measured on.
"""

from __future__ import annotations

import argparse
import gc
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import cycle
from time import perf_counter_ns
from typing import Any, NamedTuple

import numpy as np

import accuracy
from poise import METHODS, Attitude, Flag, Packet, Recording, SelfCalibrating, Stream, TwoStage, estimate, smooth
from poise.math import arrays
from poise.peers import installed, period
from poise.peers.adapters import imufusion_ahrs, imufusion_filter, imufusion_units
from poise.simulation import Sensor, forearm, measure
from stacked import Stacked
from tables import Cell, heading, table

ROUNDS = 9  # the least that is worth a median
SAMPLES, RATE = 57_000, 286.0
LIVE = 2_000  # samples a round where they come one a call
TARGET = (0.9238795325112867, 0.0, 0.0, 0.3826834323650898)  # w x y z: where the controller turns to
STIFFNESS, DAMPING = 4.0, 1.0  # N·m, N·m·s/rad

FORMS: dict[str, Any] = {
    "two stages": TwoStage(decouple=False),
    "stacked": Stacked(TwoStage(decouple=False)),
    "two stages, decoupled (default)": TwoStage(),
}

Run = Callable[[], object]
Loop = Callable[[list[Packet]], None]


class Timing(NamedTuple):
    """A contender's times a sample and their ratios to the first contender's."""

    least: float
    """ns"""
    median: float
    """ns"""
    ratio_of_least: float
    median_ratio: float
    """over the rounds, of the ratio within a round"""


ORDINARY = Sensor(mag_delay=0.0, jitter=0.0)


class Group(NamedTuple):
    """Contenders that are compared with one another."""

    title: str
    unit: str
    digits: int
    samples: int
    """samples a turn"""
    runs: dict[str, Run]


def recording() -> Recording:
    """200 s of a made forearm, as long and as fast as a BROAD trial; an ordinary sensor, no sample absent."""
    return measure(forearm(SAMPLES / RATE, RATE), ORDINARY)


def interleaved(group: Group, rounds: int) -> dict[str, Timing]:
    """The times of contenders that take turns, after a first turn that is not counted."""
    times: dict[str, list[float]] = {name: [] for name in group.runs}
    for run in group.runs.values():
        run()
    gc.collect()
    gc.disable()
    try:
        for _ in range(rounds):
            for name, run in group.runs.items():
                began = perf_counter_ns()
                run()
                times[name].append((perf_counter_ns() - began) / group.samples)
    finally:
        gc.enable()
    reference = next(iter(times.values()))
    return {name: _timing(own, reference) for name, own in times.items()}


def groups(made: Recording) -> dict[str, Group]:
    """Everything that is timed, by the name it is stored under."""
    n = len(made)
    return {
        "batch": Group("A whole recording", "ns", 0, n, batch(made)),
        "offline": Group("A whole recording, from all of it", "ns", 0, n, offline(made)),
        "live": Group("Live, one sample a call", "µs", 2, LIVE, live(made)),
        "stages": Group("Two stages beside one stacked update", "ns", 0, n, _estimates(made)),
        "stages_bare": Group("The same without guard and rest bias", "ns", 0, n, _estimates(made, False)),
        "guard": Group("Without the guard and inside it", "ns", 0, n, guarded(made)),
        "control": Group("A control cycle: one sample in, a torque out", "µs", 2, LIVE, control(made)),
    }


def batch(made: Recording) -> dict[str, Run]:
    """Whole recordings: every method as `estimate` runs it, the peers as they can."""
    from vqf import VQF

    seconds = period(made)
    return {
        "vqf updateBatch": lambda: VQF(seconds).updateBatch(made.gyr, made.acc, made.mag),
        **{name: _estimate(method(), made) for name, method in METHODS.items()},
        "imufusion, a Python loop (it has no batch)": lambda: imufusion_ahrs(made),
    }


def offline(made: Recording) -> dict[str, Run]:
    """Whole recordings with the future known."""
    from vqf import offlineVQF

    # Of an eighth of the field it finds the hard iron, and begins once more.
    assert ORDINARY.mag is not None
    calibrated, beside_iron = (
        measure(forearm(SAMPLES / RATE, RATE), replace(ORDINARY, mag=replace(ORDINARY.mag, bias=bias)))
        for bias in (0.0, (4.0, -3.0, 3.0))
    )
    assert (estimate(SelfCalibrating(), beside_iron).flags & Flag.HARD_IRON).any()
    return {
        "offlineVQF": lambda: offlineVQF(made.gyr, made.acc, made.mag, period(made)),
        "smooth": lambda: smooth(calibrated),
        "smooth, which finds a hard iron": lambda: smooth(beside_iron),
    }


def late(made: Recording) -> list[list[Cell]]:
    """How long single calls of `Stream.update` take: µs, of all after the first 1000 by quantile."""
    packets, rows = _packets(made), []
    for name, method in METHODS.items():
        stream, took = Stream(method()), []
        for packet in packets:
            began = perf_counter_ns()
            stream.update(packet)
            took.append(perf_counter_ns() - began)
        told = np.percentile(np.array(took[1000:]) * 1e-3, [50.0, 99.0, 99.9])
        rows.append([name, *(f"{value:.1f}" for value in told)])
    return rows


def live(made: Recording) -> dict[str, Run]:
    """One sample a call, arrays of three in, an attitude out."""
    packets = _packets(made)
    foreign = list(map(Packet, made.time.tolist(), *imufusion_units(made)))
    return {
        "vqf update + getQuat9D": _fed(_vqf_loop(period(made)), packets),
        **{f"{name} Stream.update": _fed(_stream_loop(method()), packets) for name, method in METHODS.items()},
        "imufusion update + get_quaternion": _fed(_imufusion_loop(made), foreign),
    }


def control(made: Recording) -> dict[str, Run]:
    """One sample into a stream, a torque out."""
    packets = _packets(made)
    return {name: _fed(_control_loop(method), packets) for name, method in FORMS.items()}


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


def form_errors() -> dict[str, float]:
    """The mean total RMSE of the filter's forms on the BROAD trials, degrees; empty where there are none."""
    scores = accuracy.measure(accuracy.trial_files(), FORMS)
    return {name: float(np.mean([s.judged for s in trials.values()])) for name, trials in scores.items() if trials}


def largest_difference_deg(made: Recording) -> float:
    """The largest angle between the attitudes of two stages and of the stacked update, degrees."""
    p, q = (estimate(FORMS[name], made).quat for name in ("two stages", "stacked"))
    return float(np.degrees(arrays.angle(arrays.multiply(p, arrays.conjugate(q))).max()))


def main(arguments: list[str] | None = None) -> int:
    """The command."""
    options = _options(arguments)
    absent = [package for package in ("vqf", "imufusion") if not installed(package)]
    if absent:
        print(f"compares with {' and '.join(absent)}, not installed: pip install poise[peers]", file=sys.stderr)
        return 1
    made = recording()
    results: dict[str, Any] = {"samples": SAMPLES, "rate_hz": RATE, "rounds": options.rounds, "versions": _versions()}
    every = groups(made)
    if unknown := set(options.groups) - set(every):
        print(f"no group {', '.join(sorted(unknown))}; there are {', '.join(every)}", file=sys.stderr)
        return 2
    for key, group in every.items():
        if options.groups and key not in options.groups:
            continue
        timings = interleaved(group, options.rounds)
        _show(group, timings)
        results[key] = {name: _ratios(timing) for name, timing in timings.items()}
    if options.groups:
        return 0
    print(heading("Single calls of Stream.update: µs, the clock's own 0.1 µs included"))
    print(table(["", "median", "99 %", "99.9 %"], late(made)))
    errors = form_errors()
    print(heading("Mean total RMSE on the BROAD trials, degrees"))
    print(table(["", "total"], list(errors.items())) if errors else "no recordings; POISE_DATA says where they are")
    print(f"On the made recording two stages and stacked differ by at most {largest_difference_deg(made):.0e} degrees.")
    results["stages_total_rmse_deg"] = {name: round(error, 6) for name, error in errors.items()}
    if options.write:
        accuracy.store("speed.json", results)
    return 0


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("groups", nargs="*", metavar="GROUP", help="batch, offline, live, guard …: these only")
    parser.add_argument("--rounds", type=int, default=ROUNDS, help=f"turns of every contender, {ROUNDS} or more")
    parser.add_argument("--write", action="store_true", help="store the ratios")
    options = parser.parse_args(arguments)
    if options.rounds < ROUNDS:
        parser.error(f"--rounds {options.rounds}: fewer than {ROUNDS} say little")
    if options.groups and options.write:
        parser.error("--write stores all groups: name none")
    return options


def _versions() -> dict[str, str | None]:
    return {package: installed(package) for package in ("poise", "numba", "vqf", "imufusion")}


def _timing(own: Sequence[float], reference: Sequence[float]) -> Timing:
    within = float(np.median(np.divide(own, reference)))
    return Timing(min(own), float(np.median(own)), min(own) / min(reference), within)


def _ratios(timing: Timing) -> dict[str, float]:
    return {name: round(getattr(timing, name), 3) for name in ("ratio_of_least", "median_ratio")}


def _show(group: Group, timings: dict[str, Timing]) -> None:
    scale = 1e-3 if group.unit == "µs" else 1.0
    rows: list[list[Cell]] = [
        [name, *(f"{time * scale:.{group.digits}f}" for time in timing[:2]), *timing[2:]]
        for name, timing in timings.items()
    ]
    print(heading(f"{group.title}: {group.unit} a sample, ratios to {next(iter(timings))}"))
    print(table(["", "min", "median", "ratio of mins", "median ratio"], rows, digits=2))


def _packets(made: Recording) -> list[Packet]:
    return list(map(Packet, made.time.tolist(), made.gyr, made.acc, made.mag))


def _estimates(made: Recording, wrapped: bool = True) -> dict[str, Run]:
    return {name: _estimate(method, made, wrapped) for name, method in FORMS.items()}


def guarded(made: Recording) -> dict[str, Run]:
    """Methods without the guard and inside it, the bias from rests beside both, and what vqf takes."""
    runs = {name: run for name, run in batch(made).items() if name.startswith("vqf")}
    for name in ("adaptive-gain", "two-stage", "self-calibrating"):
        method = METHODS[name]()
        runs[f"{name}, no guard"] = lambda method=method: estimate(method, made, guard=None)
        runs[f"{name}, guard"] = lambda method=method: estimate(method, made)
    return runs


def _estimate(method: Any, made: Recording, wrapped: bool = True) -> Run:
    return lambda: estimate(method, made, guard=wrapped or None, rest_bias=wrapped)


def _fed(loop: Loop, packets: list[Packet]) -> Run:
    """*loop* over the next LIVE packets."""
    chunks = cycle(packets[first : first + LIVE] for first in range(0, len(packets) - LIVE + 1, LIVE))
    return lambda: loop(next(chunks))


def _stream_loop(method: Any) -> Loop:
    stream = Stream(method)

    def loop(packets: list[Packet]) -> None:
        for packet in packets:
            stream.update(packet)

    return loop


def _control_loop(method: Any) -> Loop:
    stream = Stream(method)

    def loop(packets: list[Packet]) -> None:
        for packet in packets:
            torque(stream.update(packet))

    return loop


def _vqf_loop(seconds: float) -> Loop:
    from vqf import VQF

    vqf = VQF(seconds)

    def loop(packets: list[Packet]) -> None:
        for _, gyr, acc, mag in packets:
            vqf.update(gyr, acc, mag)
            vqf.getQuat9D()

    return loop


def _imufusion_loop(made: Recording) -> Loop:
    _, ahrs = imufusion_filter(made)

    def loop(packets: list[Packet]) -> None:
        for _, gyr, acc, mag in packets:
            ahrs.update(gyr, acc, mag)
            ahrs.get_quaternion()

    return loop


if __name__ == "__main__":
    sys.exit(main())
