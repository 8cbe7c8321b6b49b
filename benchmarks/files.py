"""What poise does with long, broken and hostile files: group F of the requirements, as measured.

    python benchmarks/files.py [F1 F2 F3 F4 F5 F6] [--rows N] [--cases N] [--kills N] [--markdown]

F1 needs 2 GB on disk for 10^7 rows, for as long as it runs. Every file is made here; with POISE_DATA the long one
repeats a real recording. Exits with 1 where a requirement is not met.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

import broken_files
from tables import Cell, heading, table

# A child's peak in the parent's accounts is that of the parent at the fork, if that was more: the child says its own.
_PEAK = """
def peak():
    import resource
    own, below = (resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    try:
        own = int(open("/proc/self/status").read().split("VmHWM:")[1].split()[0])
    except OSError:
        pass  # not Linux
    return max(own, below) / 1024
"""
_POISE = (
    _PEAK
    + """
import sys
sys.argv[0] = "poise"
out, code = sys.argv.pop(1), 99
try:
    from poise.cli import run
    code = run(sys.argv[1:])
finally:
    import os
    with open(out, "w") as file: print(sum(os.times()[:4]), peak(), file=file)
sys.exit(code)
"""
)
DATA = Path(os.environ.get("POISE_DATA") or Path(__file__).parents[2] / "shared" / "data")
TRIAL = ("broad", "07_undisturbed_fast_rotation_B.mat")


class Ended(NamedTuple):
    """How a process ended."""

    code: int
    """negative: by that signal"""
    seconds: float
    cpu: float
    """s of processor time, children included: what it would take on a core of its own"""
    mib: float
    """its peak memory, or that of a child of its own if it was larger"""
    stderr: str


class Row(NamedTuple):
    """One line of a table."""

    name: str
    cells: tuple[Cell, ...]
    met: bool


def run(arguments: list[str], *, one_core: bool = False, kill_after: float | None = None) -> Ended:
    """``poise ARGUMENTS`` in a process of its own."""
    pinned = ["taskset", "-c", "0"] if one_core and shutil.which("taskset") else []
    with tempfile.TemporaryFile() as errors, tempfile.NamedTemporaryFile("r") as peak:
        start = time.perf_counter()
        process = subprocess.Popen(
            [*pinned, sys.executable, "-c", _POISE, peak.name, *arguments],
            stdout=subprocess.DEVNULL,
            stderr=errors,
        )
        if kill_after is not None:
            time.sleep(kill_after)
            process.send_signal(signal.SIGKILL)
        code = process.wait()
        seconds = time.perf_counter() - start
        errors.seek(0)
        cpu, mib = map(float, (peak.read() or "nan nan").split())
        return Ended(code, seconds, cpu, mib, errors.read().decode("utf-8", "replace"))


# -- F1: long files ---------------------------------------------------------------------------------------------------


def long_file(path: Path, rows: int) -> None:
    """A CSV of so many rows: a recording repeated, its stamps going on."""
    from pyarrow import csv

    import poise
    from poise.data import arrow
    from poise.simulation import forearm, measure

    real = DATA.joinpath(*TRIAL)
    recording = poise.read(real) if real.exists() else measure(forearm(180.0, seed=1))
    period = recording.duration + 1.0 / recording.rate_hz
    with path.open("wb") as file:
        file.write(b"time (s),gyr_x (rad/s),gyr_y,gyr_z,acc_x (m/s2),acc_y,acc_z,mag_x (uT),mag_y,mag_z\n")
        for number, start in enumerate(range(0, rows, len(recording))):
            part = recording[: rows - start]
            columns = {"time": np.round(part.time + number * period, 6)}
            for name in ("gyr", "acc", "mag"):
                columns |= {f"{name}{i}": np.round(getattr(part, name)[:, i], 5) for i in range(3)}
            options = csv.WriteOptions(include_header=False, quoting_style="none")
            csv.write_csv(arrow.table(columns), file, options)


def f1(folder: Path, rows: int, kills: int) -> Iterator[Row]:
    """Time and memory of reading, estimating and writing; and the same bytes after kills."""
    if shutil.disk_usage(folder).free < 400 * rows:
        sys.exit(f"{folder}: not enough room for {rows:,} rows; say --rows or TMPDIR")
    log, short, whole, resumed = (
        folder / name for name in ("long.csv", "short.csv", "whole.parquet", "resumed.parquet")
    )
    long_file(short, rows // 10)
    run(["estimate", str(short), "-o", str(whole), "--limit", "whole=0"])  # compiles, if it must
    peaks = {}
    for path, share in ((short, 0.1), (log, 1.0)):
        if path is log:
            long_file(log, rows)
        done = run(["estimate", str(path), "-o", str(whole), "--limit", "whole=0"], one_core=True)
        peaks[share] = done.mib
        met = done.code == 0 and done.cpu <= max(30.0 * share * rows / 1e7, 5.0) and done.mib <= 600.0
        name = f"{int(rows * share):,} rows of CSV to Parquet, one core"
        yield Row(name, (done.seconds, done.cpu, done.mib, done.stderr[-60:].strip()), met)
    yield Row(
        "peak memory of ten times the rows",
        (None, None, peaks[1.0] - peaks[0.1], "more than for the tenth"),
        peaks[1.0] < peaks[0.1] + 50,
    )
    rng, killed = np.random.default_rng(7), 0
    while True:  # the last run is left alone, or was too fast to be killed
        after = float(rng.uniform(0.1, 0.4)) * done.seconds if killed < kills else None
        ended = run(["estimate", str(log), "-o", str(resumed), "--limit", "whole=0"], kill_after=after)
        if ended.code != -signal.SIGKILL:
            break
        killed += 1
    went = re.search(r"went on behind the ([\d,]+) rows", ended.stderr)
    same = resumed.exists() and _same(whole, resumed) and not list(folder.glob("*.partial"))
    yield Row(
        f"killed with -9 {killed} times, then to the end",
        (ended.seconds, ended.cpu, ended.mib, went[0] if went else "began anew"),
        same and bool(went or not killed),
    )


def _same(a: Path, b: Path) -> bool:
    return subprocess.run(["cmp", "-s", a, b], check=False).returncode == 0


# -- F2: texts --------------------------------------------------------------------------------------------------------


def f2(folder: Path) -> Iterator[Row]:
    """Every way to write a table: read right, or refused with the place and the reason."""
    from poise import PoiseError, read

    want = broken_files.samples()
    for name, case in broken_files.written().items():
        path = folder / "log.txt"
        path.write_bytes(case.content)
        try:
            found = read(path, **case.options)
        except PoiseError as problem:
            said = str(problem).removeprefix(f"{path}: ")
            right = (
                case.refused is not None and bool(re.search(case.refused, said)) and str(problem).startswith(str(path))
            )
            yield Row(name, ("refused", said[:110]), right)
            continue
        table_of = np.column_stack([found.time, found.gyr, found.acc, found.mag])
        rows = len(want) - case.left_out if len(table_of) < len(want) else len(want)
        said = "; ".join(note for note in found.notes if re.search("row|stamps", note))
        right = case.refused is None and np.array_equal(table_of[: rows - case.left_out], want[: rows - case.left_out])
        right = right and len(table_of) >= rows and bool(re.search(case.said, said))
        yield Row(name, ("read", said[:110] or "right"), right)


# -- F3: damage -------------------------------------------------------------------------------------------------------

_WORKER = (
    _PEAK
    + """
import sys, time
from pathlib import Path
import broken_files
from poise import PoiseError, read
source, count, every = Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3] == "every"
content, path = source.read_bytes(), Path(sys.argv[4]) / f"damaged{source.suffix}"
cuts = range(0, len(content), max(1, len(content) // (20 * count))) if every else ()
longest = refused = done = 0
cut_off, flipped = (content[:cut] for cut in cuts), (broken_files.damaged(content, seed) for seed in range(count))
for made in (*cut_off, *flipped):
    path.write_bytes(made)
    start = time.perf_counter()
    try:
        read(path)
    except PoiseError as problem:
        refused += 1
        assert str(problem).startswith(str(path)), problem
    longest, done = max(longest, time.perf_counter() - start), done + 1
print(done, refused, longest, peak())
"""
)


def f3(folder: Path, cases: int) -> Iterator[Row]:
    """Cut off anywhere and with flipped bytes: read or refused, in time and memory."""
    for name, path in broken_files.whole(folder).items():
        child = name.startswith(("mat", "bag", "mcap"))  # a process each: fewer of them
        count = max(cases // 10, 4) if child else cases
        found = subprocess.run(
            [sys.executable, "-c", _WORKER, str(path), str(count), "" if child else "every", str(folder)],
            env={**os.environ, "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), *sys.path])},
            capture_output=True,
            text=True,
            check=False,
        )
        if found.returncode:
            yield Row(
                name, (None, None, None, None, (found.stderr.strip() or f"signal {-found.returncode}")[-100:]), False
            )
            continue
        done, refused, longest, peak = (float(word) for word in found.stdout.split())
        yield Row(name, (int(done), int(refused), longest, peak, ""), longest <= 5.0 and peak <= 1024.0)


# -- F4: harm ---------------------------------------------------------------------------------------------------------


def f4(folder: Path) -> Iterator[Row]:
    """Bombs, lies, pickles: refused by one line, in 5 s and 300 MiB."""
    sign = folder / "sign"
    for name, path in broken_files.hostile(folder, sign).items():
        done = run(["estimate", str(path), "-o", str(folder / "out.parquet")])
        lines = done.stderr.strip().splitlines()
        met = done.code == 1 and done.seconds <= 5.0 and done.mib <= 300.0 and len(lines) == 1
        said = lines[-1].replace(f"poise: {path}: ", "") if lines else "nothing"
        yield Row(name, (done.code, done.seconds, done.mib, said[:80]), met)
        path.unlink()
    yield Row("anything unpickled", (None, None, None, "yes" if sign.exists() else "no"), not sign.exists())


# -- F5 and F6 --------------------------------------------------------------------------------------------------------


def f5(folder: Path) -> Iterator[Row]:
    """Each limit refuses what is above it, by name, and can be set on the command line."""
    from poise.formats import Limits

    path = folder / "log.csv"
    path.write_text(broken_files.text(broken_files.samples()))
    longest = max(len(line) for line in path.read_text().splitlines())
    for name, at in (("size", path.stat().st_size), ("rows", broken_files.ROWS), ("columns", 10), ("line", longest)):
        below, enough = (run(["sniff", str(path), "--limit", f"{name}={value}"]) for value in (at - 1, at))
        named = f"--limit {name}=" in below.stderr
        met = below.code == 1 and named and enough.code == 0
        yield Row(name, (getattr(Limits(), name), below.stderr.strip()[-90:]), met)


def f6(folder: Path) -> Iterator[Row]:
    """Exit codes and one line on stderr."""
    good, bad = folder / "good.csv", folder / "bad.csv"
    good.write_text(broken_files.text(broken_files.samples()))
    bad.write_text("no numbers\n")
    out = ["-o", str(folder / "out")]
    for name, arguments, code, problems in (
        ("a good file", ["estimate", str(good), *out], 0, 0),
        ("a bad file", ["estimate", str(bad), *out], 1, 1),
        ("a bad file among good ones", ["estimate", str(good), str(bad), *out], 1, 1),
        ("no such file", ["estimate", str(folder / "none.csv"), *out], 1, 1),
        ("a bad file in chunks", ["estimate", str(bad), *out, "--limit", "whole=0"], 1, 1),
        ("an option that is not there", ["estimate", str(good), "--nope"], 2, 1),
        ("a limit that is not there", ["estimate", str(good), "--limit", "height=3"], 2, 1),
        ("a limit that is no number", ["estimate", str(good), "--limit", "rows=many"], 2, 1),
        ("no file at all", ["estimate"], 2, 1),
    ):
        done = run(arguments)
        lines = [line for line in done.stderr.splitlines() if line.startswith("poise: ")]
        met = done.code == code and len(lines) == problems and "Traceback" not in done.stderr
        yield Row(name, (done.code, len(lines), lines[0][:80] if lines else ""), met)


TABLES: dict[str, tuple[str, tuple[str, ...]]] = {
    "F1": ("F1: long files (30 s of a core and 600 MiB for 10^7 rows)", ("s", "CPU s", "MiB", "said")),
    "F2": ("F2: texts, read right or refused with line, column and reason", ("outcome", "said")),
    "F3": ("F3: cut anywhere, flipped bytes (no crash, 5 s, 1 GiB)", ("cases", "refused", "longest s", "MiB", "")),
    "F4": ("F4: hostile files (refused in 5 s at 300 MiB, never a signal)", ("exit", "s", "MiB", "said")),
    "F5": ("F5: limits", ("default", "said above it")),
    "F6": ("F6: exit codes", ("exit", "lines", "said")),
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else "")
    parser.add_argument("groups", nargs="*", metavar="GROUP", help=", ".join(TABLES))
    parser.add_argument("--rows", type=lambda text: int(float(text)), default=10_000_000, help="of the long file")
    parser.add_argument("--cases", type=int, default=200, help="damaged files of a kind")
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--markdown", action="store_true")
    told = parser.parse_args()
    if unknown := set(told.groups) - set(TABLES):
        parser.error(f"no group {', '.join(sorted(unknown))}; there are {', '.join(TABLES)}")
    missed = 0
    for group in told.groups or TABLES:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            measure: dict[str, Callable[[], Iterator[Row]]] = {
                "F1": lambda folder=folder: f1(folder, told.rows, told.kills),  # type: ignore[misc]
                "F2": lambda folder=folder: f2(folder),  # type: ignore[misc]
                "F3": lambda folder=folder: f3(folder, told.cases),  # type: ignore[misc]
                "F4": lambda folder=folder: f4(folder),  # type: ignore[misc]
                "F5": lambda folder=folder: f5(folder),  # type: ignore[misc]
                "F6": lambda folder=folder: f6(folder),  # type: ignore[misc]
            }
            rows = list(measure[group]())
        title, columns = TABLES[group]
        print(heading(title, markdown=told.markdown))
        cells = [[row.name, "met" if row.met else "MISSED", *row.cells] for row in rows]
        print(table(["", "", *columns], cells, markdown=told.markdown, digits=2), flush=True)
        missed += sum(not row.met for row in rows)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
