"""What the doctor finds of mistakes made on purpose, in every recording at hand: units, axes, time; false alarms.

    python benchmarks/doctor.py            # all: 48 axes of each sensor, 5 units, on every recording
    python benchmarks/doctor.py --markdown # the tables of docs/doctor.md

The thresholds were chosen on one half of the trials; the other half is the check. A recording turns about every axis where
gravity and the field both swing by more than 5° RMS between windows.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from poise import Diagnosis, Recording, diagnose, read
from poise.doctor.axes import words
from poise.doctor.turning import signed_axes
from scores import CHOSEN, HELD_OUT
from tables import heading, table

DATA = Path(os.environ.get("POISE_DATA") or Path(__file__).parents[2] / "shared" / "data")
TURNS = 5.0  # degrees
UNITS = {"gyr in deg/s": "gyr=deg/s", "acc in g": "acc=g", "acc in mg": "acc=mg", "ms": "time=ms", "µs": "time=us"}


class Counts(NamedTuple):
    """Of the mistakes made in the axes of one recording."""

    right: int
    """named with their fix, after which the recording is the original, but for a rotation common to all sensors"""
    refused: int
    """known to be wrong, without the one fix"""
    open: int
    """told that it cannot be told"""
    wrong: int
    """a fix said to be sure that is not right, or nothing said at all"""
    upside_down: int = 0
    """a fix said to be sure, or nothing said, and acc and mag both negated: no motion and no dip tells"""

    def __add__(self, other: Counts) -> Counts:  # type: ignore[override]
        return Counts(*(a + b for a, b in zip(self, other, strict=True)))


def mistaken(recording: Recording, name: str) -> Recording:
    """*recording* with one of :data:`UNITS` mistaken for SI."""
    changes = {
        "gyr in deg/s": lambda r: {"gyr": np.degrees(r.gyr)},
        "acc in g": lambda r: {"acc": r.acc / 9.80665},
        "acc in mg": lambda r: {"acc": r.acc / 9.80665e-3},
        "ms": lambda r: {"time": r.time * 1e3},
        "µs": lambda r: {"time": r.time * 1e6},
    }
    return recording.with_samples(**changes[name](recording))


def same(one: Recording, other: Recording) -> bool:
    """Whether two recordings are equal up to a rotation that is common to all sensors."""
    for turn in signed_axes()[:24]:
        if all(
            np.allclose(getattr(one, s) @ turn.T, getattr(other, s), equal_nan=True, rtol=1e-9, atol=1e-12)
            for s in ("gyr", "acc", "mag")
        ):
            return True
    return False


def count(original: Recording, wrong: Recording) -> Counts:
    """What becomes of one mistake."""
    found = diagnose(wrong, thorough=False)
    if not found.repairs and found.found("sure"):
        return Counts(0, 1, 0, 0)
    if not found.repairs and (found.found("cannot-tell") or found.found("likely")):
        return Counts(0, 0, 1, 0)
    repaired = found.repair(wrong)
    if found.repairs and all(f.fix and f.decided for f in found.found("sure")) and same(repaired, original):
        return Counts(1, 0, 0, 0)
    if not found.repairs.axes and (axes := [f for f in found.findings if f.name.endswith(("axes", "sign"))]):
        known = (
            axes[0].severity == "sure"
        )  # a unit repaired: of the axes it says that they are wrong, or cannot be told
        return Counts(0, int(known), int(not known), 0)
    negated = same(repaired.with_samples(acc=-repaired.acc, mag=-repaired.mag), original)
    return Counts(0, 0, 0, int(not negated), int(negated))


def of_axes(recording: Recording, sensor: str, every: int) -> Counts:
    """The 47 other ways to name a sensor's axes, or every *every*-th."""
    total = Counts(0, 0, 0, 0)
    for matrix in signed_axes()[1::every]:
        total += count(recording, recording.remap(words(matrix), sensor))
    return total


def of_pairs(recording: Recording, kind: str, number: int, rng: np.random.Generator) -> Counts:
    """*number* pairs of wrong sensors: both renamed, both turned, one renamed and one negated; or one renamed, gyr in deg/s."""
    total, every = Counts(0, 0, 0, 0), signed_axes()
    for _ in range(number):
        one, two = rng.choice(("gyr", "acc", "mag"), 2, replace=False)
        i, j = rng.integers(1, 24 if kind == "both turned" else 48, 2)
        wrong = recording.remap(words(every[i]), one)
        if kind == "one renamed, gyr in deg/s":
            wrong = mistaken(wrong, "gyr in deg/s")
        else:
            wrong = wrong.remap("-x -y -z" if kind == "one renamed, one negated" else words(every[j]), two)
        total += count(recording, wrong)
    return total


PAIRS = ("both turned", "both renamed", "one renamed, one negated", "one renamed, gyr in deg/s")


def print_pairs(number: int, seed: int, *, markdown: bool) -> None:
    """What becomes of *number* pairs of each kind in every recording."""
    rng = np.random.default_rng(seed)
    found = dict.fromkeys(PAIRS, Counts(0, 0, 0, 0))
    for _, path in recordings():
        recording = read(path)
        for kind in PAIRS:
            found[kind] += of_pairs(recording, kind, number, rng)
    print(heading("Two mistakes at once", markdown=markdown))
    names = ["two mistakes", "pairs", "named", "refused", "cannot tell", "wrong", "wrong, but upside down alike"]
    print(table(names, [[kind, sum(each), *each] for kind, each in found.items()], markdown=markdown))


def turns(found: Diagnosis) -> bool:
    """Whether the recording turns about every axis."""
    if found.evidence is None:
        return False
    seen = (found.evidence.acc.still_total, found.evidence.mag.still_total)
    return all(np.degrees(np.sqrt(loss)) > TURNS for loss in seen)


def seconds(recording: Recording) -> float:
    """What the checks of one recording take, the median of five."""
    taken = []
    for _ in range(5):
        started = time.perf_counter()
        diagnose(recording, thorough=False)
        taken.append(time.perf_counter() - started)
    return float(np.median(taken))


def recordings() -> Iterable[tuple[str, Path]]:
    for path in sorted([*DATA.glob("broad/*.mat"), *DATA.glob("other/*.bag"), *DATA.glob("other/*.csv")]):
        number = path.name[:2]
        half = "other"
        if path.suffix == ".mat":
            half = "chosen" if int(number) in CHOSEN else "check" if int(number) in HELD_OUT else "other"
        yield half, path


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--every", type=int, default=1, help="only every n-th way to name the axes")
    parser.add_argument("--pairs", type=int, help="only this many pairs of mistakes of each kind in every recording")
    parser.add_argument("--seed", type=int, default=0, help="of the pairs")
    options = parser.parse_args()
    if options.pairs:
        print_pairs(options.pairs, options.seed, markdown=options.markdown)
        return
    rows, units_right, units_all, alarms, costs = [], 0, 0, 0, []
    sums: dict[tuple[str, bool], Counts] = {}
    for half, path in recordings():
        recording = read(path)
        clean = diagnose(recording, thorough=False)
        costs.append((seconds(recording), len(recording)))
        alarm = bool(clean.repairs or clean.found("sure"))
        alarms += alarm
        named = sum(
            diagnose(mistaken(recording, k), thorough=False).options() == f"--units {o}" for k, o in UNITS.items()
        )
        units_right, units_all = units_right + named, units_all + len(UNITS)
        every = turns(clean)
        cells: list[str] = []
        for sensor in ("gyr", "acc", "mag"):
            found = of_axes(recording, sensor, options.every)
            sums[half, every] = sums.get((half, every), Counts(0, 0, 0, 0)) + found
            cells.append(" / ".join(map(str, found[:4])))
        late = [f.fix.delays.get("mag") for f in diagnose(recording).findings if f.name == "mag delay"]
        delay = f"{1e3 * late[0]:.1f}" if late and late[0] is not None else "-"
        rows.append(
            [
                path.stem[:34],
                half,
                "yes" if every else "no",
                "ALARM" if alarm else "none",
                f"{named} of 5",
                *cells,
                delay,
            ]
        )
    columns = ["recording", "half", "turns", "clean", "units", "gyr axes", "acc axes", "mag axes", "mag late, ms"]
    print(heading("Named / refused unnamed / cannot tell / wrong, by sensor renamed", markdown=options.markdown))
    print(table(columns, rows, markdown=options.markdown))
    print(heading("Axes, together", markdown=options.markdown))
    lines = []
    for (half, every), found in sorted(sums.items()):
        share = found.right / max(sum(found), 1)
        lines.append([half, "yes" if every else "no", sum(found), *found[:4], f"{share:.1%}"])
    names = ["half", "turns about every axis", "mistakes", "named", "refused", "cannot tell", "wrong", "share named"]
    print(table(names, lines, markdown=options.markdown))
    slowest, size = max(costs)
    print(f"\nunits named with their fix: {units_right} of {units_all}")
    print(f"false alarms on clean recordings: {alarms} of {len(costs)}")
    print(f"the checks that poise estimate runs: at most {1e3 * slowest:.0f} ms ({size} rows)")


if __name__ == "__main__":
    main()
