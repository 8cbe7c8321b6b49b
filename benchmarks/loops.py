"""Closed loops in physics.

    python benchmarks/loops.py stands|pushes|drive|slews [--count N] [--seconds S] [--method M] [--write]
    python benchmarks/loops.py picture

stands: balancing for a minute, pushed by 3 N, to and fro at 0.3 m/s. pushes: random pushes; every fall is to be detected
150 ms before the impact, nothing that recovers. drive: over bumps and with vibration; no alarm. slews: every nine-axis
method against the truth in the same loop. picture: docs/images/slews.png.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from math import degrees, isfinite
from pathlib import Path

import numpy as np

from poise.loops import BalanceRun
from tables import Cell, table

os.environ.setdefault("GPIOZERO_PIN_FACTORY", "mock")

STANDS, PUSHES, DRIVE, SLEWS = 9000, 8000, 9101, 9200  # first seeds; gains and limits were chosen with others
DOCS = Path(__file__).parents[1] / "docs"
PAGES = {"stands": "balance.md", "pushes": "balance.md", "drive": "balance.md", "slews": "control.md"}
PICTURED, PHOTOGRAPHS = 200, (2.9, 4.0, 5.0, 13.0, 14.0)  # seed; s
NINE_AXIS = ("truth", "self-calibrating", "two-stage", "adaptive-gain", "armband")


def stands(methods: Sequence[str], count: int) -> str:
    from poise.loops.balancing import Push, balancing

    rows: list[Sequence[Cell]] = []
    pushed = tuple(Push(10.0 * i, (0.0, 3.0 if i % 2 else -3.0, 0.0)) for i in range(1, 6))
    for method in methods:
        runs = [balancing(method, seed=seed, pushes=pushed) for seed in range(STANDS, STANDS + count)]
        follows = []
        for run in runs:
            wanted = run["wanted"]
            driving = (np.abs(wanted) > 0.0) & (np.roll(wanted, 400) == wanted)  # for 2 s by then
            follows.append(float(np.mean(run["speed"][driving] * np.sign(wanted[driving]))) if driving.any() else 0.0)
        lean, estimate = ([degrees(f(run)) for run in runs] for f in (_leant, BalanceRun.estimate_rms))
        rows.append([
            method, f"{sum(not run.fell for run in runs)} of {count}", str(sum(run.triggered for run in runs)),
            f"{max(lean):.1f}", f"{min(follows):.2f} to {max(follows):.2f}", f"{np.mean(estimate):.2f} ({max(estimate):.2f})",
        ])  # fmt: skip
    columns = ["method", "stood", "alarms", "largest lean, °", "speed at ±0.3 m/s, m/s", "estimate RMS, ° (worst)"]
    seeds = f"seeds {STANDS} to {STANDS + count - 1}, 60 s each"
    told = f"`python benchmarks/loops.py stands --write`: {seeds}, pushed by 3 N for 0.1 s every 10 s."
    return f"{told}\n\n{table(columns, rows, markdown=True)}"


def _leant(run: BalanceRun) -> float:
    return float(np.abs(run["lean"]).max())


def pushes(method: str, count: int) -> str:
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
    rows: list[Sequence[Cell]] = [
        ["falls", str(falls)],
        ["not seen before the impact", str(missed)],
        [f"false alarms in the {count - falls} that recover", str(false_alarms)],
    ]
    if leads:
        spread = f"least {1e3 * min(leads):.0f} ms, median {1e3 * np.median(leads):.0f} ms; {short} below 150 ms"
        rows.append(["relay's edge to impact", spread])
        spread = f"median {1e3 * np.median(relays):.2f} ms, most {1e3 * max(relays):.2f} ms"
        rows.append(["sample to relay's edge", spread])
    told = f"`python benchmarks/loops.py pushes --write`, `{method}`, seeds {PUSHES} to {PUSHES + count - 1}."
    return f"{told}\n\n{table([f'{count} pushes', ''], rows, markdown=True)}"


def drive(methods: Sequence[str], seconds: float, count: int) -> str:
    from poise.loops.balancing import told
    from poise.loops.driving import BUMPS, VIBRATION, driven

    rows: list[Sequence[Cell]] = []
    for method in methods:
        for seed in range(DRIVE, DRIVE + count):
            run = driven(method, seed, seconds)
            print(told(run), file=sys.stderr)
            rows.append([
                method, str(seed), f"{run['time'][-1]:.0f}", "fell" if run.fell else "stood", "yes" if run.triggered else "no",
                f"{degrees(float(np.abs(run['lean']).max())):.1f}", f"{degrees(run.estimate_rms()):.2f}",
            ])  # fmt: skip
    columns = ["method", "seed", "s", "robot", "alarm", "largest lean, °", "estimate RMS, °"]
    command = f"python benchmarks/loops.py drive --count {count} --seconds {seconds:g} --write"
    told_by = f"`{command}`: ridges of {1e3 * BUMPS:g} mm, {VIBRATION:g} m/s² RMS at 45 Hz."
    return f"{told_by}\n\n{table(columns, rows, markdown=True)}"


def slews(count: int) -> str:
    from poise.loops.slewing import slewing

    rows: list[Sequence[Cell]] = []
    usual = float("nan")
    for calibrated in (True, False):
        for method in NINE_AXIS:
            if method == "truth" and not calibrated:
                continue
            turns = [
                turn
                for seed in range(SLEWS, SLEWS + count)
                for turn in slewing(method, seed=seed, calibrated=calibrated).turns
            ]
            times = [turn.settling for turn in turns]
            if method == "truth":
                usual = float(np.median(times))
            final = np.degrees([turn.final for turn in turns])
            settled = sum(map(isfinite, times))
            within = sum(time <= 1.2 * usual for time in times)
            rows.append([
                method, "yes" if calibrated else "no", f"{settled} of {len(turns)}", f"{within} of {len(turns)}",
                f"{np.median(times):.2f}", f"{np.median(final):.2f}", f"{final.max():.2f}",
                f"{np.median(np.degrees([turn.estimate for turn in turns])):.2f}",
            ])  # fmt: skip
            print(*rows[-1], sep="  ", file=sys.stderr)
    columns = ["method", "calibrated", "settled to 2°", "in 1.2 of the truth's time", "median, s",
               "error at the end, median °", "most °", "estimate RMS, °"]  # fmt: skip
    seeds = f"seeds {SLEWS} to {SLEWS + count - 1}, three slews each"
    told = f"`python benchmarks/loops.py slews --count {count} --write`: {seeds}."
    return f"{told}\n\n{table(columns, rows, markdown=True)}"


def picture(method: str, path: Path) -> None:
    """Three slews of a development seed as a picture with photographs."""
    from poise.loops.slewing import slewing
    from poise.plots import save_figure, slewing_figure
    from poise.simulation.worlds import AttitudeBody

    moments: list[tuple[float, np.ndarray]] = []

    def look(now: float, world: AttitudeBody) -> None:
        if len(moments) < len(PHOTOGRAPHS) and now >= PHOTOGRAPHS[len(moments)] - 1e-9:
            moments.append((now, world.render(420, 420)))

    run = slewing(method, seed=PICTURED, look=look)
    save_figure(slewing_figure(run, slewing("truth", seed=PICTURED), moments), path)


def write(what: str, found: str) -> None:
    """Put *found* between the marks of *what* in its page."""
    page = DOCS / PAGES[what]
    text = page.read_text(encoding="utf-8")
    begin, end = (f"<!-- {edge}: python benchmarks/loops.py {what} --write -->" for edge in ("begin", "end"))
    before, mark, rest = text.partition(begin)
    _, closing, after = rest.partition(end)
    if not (mark and closing):
        raise SystemExit(f"{page}: expected the lines {begin!r} and {end!r}")
    page.write_text(f"{before}{begin}\n{found.strip()}\n{end}{after}", encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=[*PAGES, "picture"])
    parser.add_argument("--count", type=int, help="seeds: 10 stands, 100 pushes, 3 drives, 10 bodies")
    parser.add_argument("--seconds", type=float, default=1800.0, help="of a drive")
    parser.add_argument("--method", help="instead of two-stage, for stands and drives also instead of self-calibrating")
    parser.add_argument("--write", action="store_true", help="put the table into its page")
    given = parser.parse_args()
    if given.what == "picture":
        picture(given.method or "self-calibrating", DOCS / "images" / "slews.png")
        return
    methods = [given.method] if given.method else ["two-stage", "self-calibrating"]
    if given.what == "stands":
        found = stands(methods, given.count or 10)
    elif given.what == "pushes":
        found = pushes(given.method or "two-stage", given.count or 100)
    elif given.what == "drive":
        found = drive(methods, given.seconds, given.count or 3)
    else:
        found = slews(given.count or 10)
    print(found)
    if given.write:
        write(given.what, found)


if __name__ == "__main__":
    main()
