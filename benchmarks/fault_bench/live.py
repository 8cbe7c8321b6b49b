"""E4 live: a timer that asks a stream about now, while the device is silent."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from fault_bench.checked import Check
from fault_bench.injectors import place
from poise import METHODS, Flag, Packet, Stream, read

DEADLINE, EARLY, ROUNDS = 0.050, 0.030, 20  # s


def asked_while_silent(name: str, file: Path, seed: int) -> list[Check]:
    """Break the link at random instants; `check` has to say so within 50 ms, not earlier than 30, and unsay it after."""
    recording, rng = read(file), np.random.default_rng([seed, 4])
    late = early = unsaid = 0
    for _ in range(ROUNDS):
        at = place(recording, rng, 0.0).start
        stream = Stream(METHODS[name]())
        stream.update(Packet(*(getattr(recording, s)[max(at - 600, 0) : at] for s in ("time", "gyr", "acc", "mag"))))
        last = float(recording.time[at - 1])
        early += bool(_unknown(stream, last + EARLY))
        late += not _unknown(stream, last + DEADLINE + 1e-6)
        stream.update(Packet(float(recording.time[at]), recording.gyr[at], recording.acc[at], recording.mag[at]))
        unsaid += bool(_unknown(stream, float(recording.time[at]) + EARLY))
    found = f"{ROUNDS - late} / {early} / {unsaid}"
    met = late == 0 and early == 0 and unsaid == 0
    words = f"link silent, Stream.check(now), {ROUNDS} times"
    return [Check("E4", words, f"unknown at 50 ms / at 30 ms / after: {ROUNDS} / 0 / 0", name, found, met)]


def _unknown(stream: Stream, now: float) -> bool:
    answer = stream.check(now)
    return bool(answer.flags[0] & np.uint32(Flag.SILENT)) and not answer.valid[0]
