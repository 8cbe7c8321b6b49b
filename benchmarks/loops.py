"""Closed loops in physics: `python benchmarks/loops.py [pushes|drive|slews] [--count N] [--seconds S] [--method M]`.

pushes: random pushes; every fall is to be detected 150 ms before the impact, nothing that recovers. drive: over bumps and
with vibration; no alarm. slews: every nine-axis method against the truth in the same loop.
"""

from __future__ import annotations

import argparse
import os
from math import degrees, isfinite

import numpy as np

os.environ.setdefault("GPIOZERO_PIN_FACTORY", "mock")

PUSHES, DRIVE, SLEWS = 8000, 6000, 7000  # first seeds; gains and limits were chosen with seeds below 2000
NINE_AXIS = ("truth", "self-calibrating", "two-stage", "adaptive-gain", "armband")


def pushes(method: str, count: int) -> None:
    from poise.loops.pushing import pushed

    leads, relays, falls, false_alarms, missed = [], [], 0, 0, 0
    for seed in range(PUSHES, PUSHES + count):
        one = pushed(method, seed)
        false_alarms += one.false_alarm
        if one.cut is None:
            continue
        falls += 1
        run = one.cut
        if run.cut is None or not run.lead > 0.0:
            missed += 1
            print(f"seed {seed}: fell by {one.force:.1f} N at {degrees(one.direction):.0f}° and was not seen before")
            continue
        leads.append(run.lead)
        relays.append(run.cut.computed + run.cut.relay)
        print(
            f"seed {seed}: {one.force:.1f} N at {degrees(one.direction):4.0f}°: relay {run.cut.edge:.3f} s, "
            f"impact {run.impact:.3f} s, lead {1e3 * run.lead:.0f} ms; sample to edge {1e3 * relays[-1]:.2f} ms"
        )
    short = sum(lead < 0.15 for lead in leads)
    print(f"{count} pushes, {method}: {falls} falls, {missed} not seen before the impact, {false_alarms} false alarms")
    if leads:
        print(f"lead: least {1e3 * min(leads):.0f} ms, median {1e3 * np.median(leads):.0f} ms, {short} below 150 ms;")
        print(f"sample to relay edge: median {1e3 * np.median(relays):.2f} ms, most {1e3 * max(relays):.2f} ms")


def drive(method: str, seconds: float) -> None:
    from poise.loops.balancing import told
    from poise.loops.driving import BUMPS, VIBRATION, driven

    run = driven(method, DRIVE, seconds)
    print(told(run))
    print(
        f"{run['time'][-1]:.0f} s over bumps of {1e3 * BUMPS:g} mm, {VIBRATION:g} m/s² RMS: "
        f"{'alarm' if run.triggered else 'no alarm'}, {'fell' if run.fell else 'stood'}, "
        f"largest lean {degrees(float(np.abs(run['lean']).max())):.1f}°"
    )


def slews(count: int) -> None:
    from poise.loops.slewing import slewing

    for method in NINE_AXIS:
        turns = [turn for seed in range(SLEWS, SLEWS + count) for turn in slewing(method, seed=seed).turns]
        settled = [turn.settling for turn in turns if isfinite(turn.settling)]
        final = np.degrees([turn.final for turn in turns])
        estimate = np.degrees([turn.estimate for turn in turns])
        time = f"{np.median(settled):.2f} s" if settled else "-"
        print(
            f"{method:18} settled {len(settled):2d}/{len(turns)}, median {time}; error at the end median "
            f"{np.median(final):.2f}°, most {final.max():.2f}°; estimate RMS {np.median(estimate):.2f}°"
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=["pushes", "drive", "slews"])
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=1800.0)
    parser.add_argument("--method", default="two-stage")
    given = parser.parse_args()
    if given.what == "pushes":
        pushes(given.method, given.count)
    elif given.what == "drive":
        drive(given.method, given.seconds)
    else:
        slews(given.count)


if __name__ == "__main__":
    main()
