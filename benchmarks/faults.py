"""The fault matrix: what faults in real recordings do to poise's methods, and to other packages' filters.

    python benchmarks/faults.py [--final | --made HZ] [--methods NAMES] [--peers NAMES] [--rows E2,E3] [--json | --write]

Every fault is put into BROAD trials at places drawn from stated seeds, and judged against the clean run of the same method
and against the reference (docs/faults.md says how). Half of the trials and seeds are for developing, the other half, --final,
for the table that counts; --made puts the faults into made recordings at any rate. Ends with 1 where a demand on a method of
poise is not met. POISE_DATA says where the recordings are.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
import time as clock
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

import poise
from accuracy import data_folder, trial_files, warm
from fault_bench.checked import Check
from fault_bench.checks import CheckTask, check, check_tasks
from fault_bench.contenders import contender, names
from fault_bench.matrix import Case, perform, tasks
from fault_bench.report import check_table, document, failures, group_tables, summary_table
from fault_bench.rows import FAULTS
from poise import METHODS
from poise.simulation import Sensor, forearm, measure, phone, robot
from scores import CHOSEN, HELD_OUT

SEEDS, FINAL_SEEDS = (1, 2), (101, 102)
PAGE = Path(__file__).parents[1] / "docs" / "faults.md"
MARK = "<!-- what follows is written by: python benchmarks/faults.py --write -->"


def main(arguments: list[str] | None = None) -> int:
    """The command."""
    options = _options(arguments)
    with tempfile.TemporaryDirectory() as folder:
        return judged(options, made(options.made, Path(folder)) if options.made is not None else _files(options))


def judged(options: argparse.Namespace, files: list[Path]) -> int:
    """The matrix on *files*, told as *options* say; the exit code."""
    if not files:
        print(f"no such BROAD trials in {data_folder()}; POISE_DATA says where they are", file=sys.stderr)
        return int(bool(os.environ.get("CI")))
    groups = options.rows or []
    wanted = [fault.key for fault in FAULTS if not groups or fault.group in groups]
    who = names(f"{options.methods},{options.peers}")
    own = [name for name in who if contender(name).package == "poise"]
    seeds = options.seeds or (FINAL_SEEDS if options.final else SEEDS)
    todo: list[Any] = [*tasks(files, seeds, who, wanted), *check_tasks(files, seeds[0], own, groups, options.sequences)]
    warm({name: METHODS[name]() for name in own})
    found = [part for parts in run(todo, options.jobs) for part in parts]
    cases = sorted(part for part in found if isinstance(part, Case))
    checks = [part for part in found if isinstance(part, Check)]
    if options.json:
        print(json.dumps(document(cases, checks), indent=1, ensure_ascii=False))
    elif options.write:
        which = f"Trials {', '.join(file.stem[:2] for file in files)}, seeds {', '.join(map(str, seeds))}"
        write(f"{which}{' (the half that nothing was developed on)' if options.final else ''}.", cases, checks, who)
    else:
        print(report(cases, checks, who, markdown=options.markdown))
    return int(failures(cases, who) > 0 or not all(c.met for c in checks))


def run(todo: Sequence[Any], jobs: int) -> list[list[Any]]:
    """What every task gives, in order, *jobs* of them at a time; says on stderr what is done."""
    start = clock.perf_counter()
    with ProcessPoolExecutor(jobs) as pool:
        futures = [pool.submit(_perform, task) for task in todo]
        for i, future in enumerate(as_completed(futures), 1):
            task = todo[futures.index(future)]
            print(f"{clock.perf_counter() - start:4.0f} s, {i}/{len(todo)}: {task}", file=sys.stderr, flush=True)
    return [future.result() for future in futures]


def _perform(task: Any) -> list[Any]:
    return check(task) if isinstance(task, CheckTask) else perform(task)


def report(cases: Sequence[Case], checks: Sequence[Check], who: Sequence[str], *, markdown: bool) -> str:
    """The summary, the checks, the tables by fault of poise's methods and, as plain text only, those of the peers."""
    own = [name for name in who if contender(name).package == "poise"]
    parts = summary_table(cases, list(who), markdown=markdown) if cases else []
    parts += check_table(checks, own, markdown=markdown)
    parts += group_tables(cases, own, markdown=markdown) if own else []
    foreign = [name for name in who if name not in own]
    parts += group_tables(cases, foreign, markdown=markdown) if foreign and not markdown else []
    return "\n".join(parts)


def write(which: str, cases: Sequence[Case], checks: Sequence[Check], who: Sequence[str]) -> None:
    """Put the tables into the page, behind its mark."""
    page = PAGE.read_text(encoding="utf-8")
    kept = page[: page.index(MARK) + len(MARK)]
    PAGE.write_text(f"{kept}\n\n{which}\n{report(cases, checks, who, markdown=True)}\n", encoding="utf-8")
    print(f"wrote the tables of {PAGE.name}", file=sys.stderr)


def made(rate: float, folder: Path) -> list[Path]:
    """An arm, a phone and a robot, 150 s each at *rate* samples a second, measured by an inexpensive sensor."""
    files = []
    for number, motion in enumerate((forearm, phone, robot), 91):  # numbered as trials are, beyond them
        files.append(folder / f"{number}_{motion.__name__}.parquet")
        poise.write(measure(motion(150.0, rate, 14), Sensor(), seed=14), files[-1])
    return files


def _files(options: argparse.Namespace) -> list[Path]:
    half = HELD_OUT if options.final else CHOSEN
    wanted = options.trials or [f"{number:02d}" for number in half]
    return [file for file in trial_files() if file.stem[:2] in wanted]


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--final", action="store_true", help="the trials and seeds that nothing was developed on")
    parser.add_argument("--made", type=float, metavar="HZ", help="made recordings at this rate instead of the trials")
    parser.add_argument("--methods", default="methods", help="methods of poise, by commas (default all)")
    parser.add_argument(
        "--peers", default="vqf,imufusion", help='peers or packages, by commas (default vqf,imufusion; "" none)'
    )
    parser.add_argument(
        "--rows", type=_words, help="groups of the matrix, by commas: E2,E3 (also E1, E16: checks only)"
    )
    parser.add_argument("--sequences", type=int, default=1_000_000, help="fuzzed sequences a method (default 10^6)")
    parser.add_argument("--trials", type=_words, help="trials, by commas: 01,05 (default: the half)")
    parser.add_argument("--seeds", type=_numbers, help="seeds, by commas (default: the half)")
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count() or 1), help="processes (default 2)")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print every case as JSON")
    form.add_argument("--markdown", action="store_true", help="print Markdown tables")
    form.add_argument("--write", action="store_true", help="write the tables into docs/faults.md")
    options = parser.parse_args(arguments)
    if options.made is not None and (
        options.write or options.final or options.trials or not 20.0 <= options.made <= 2000.0
    ):
        parser.error("--made: expected 20 to 2000 Hz, and none of --write, --final, --trials")
    if options.jobs < 1:
        parser.error(f"--jobs {options.jobs}: expected 1 or more")
    return options


def _words(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]


def _numbers(text: str) -> list[int]:
    return [int(word) for word in _words(text)]


if __name__ == "__main__":
    sys.exit(main())
