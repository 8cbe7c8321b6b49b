"""The fault matrix: what faults in real recordings do to poise's methods, and to other packages' filters.

    python benchmarks/faults.py [--final] [--methods NAMES] [--peers NAMES] [--rows E2,E3] [--json | --markdown]

Every fault is put into BROAD trials at places drawn from stated seeds, and judged against the clean run of the same method
and against the reference (docs/faults.md says how). Half of the trials and seeds are for developing, the other half, --final,
for the table that counts. Ends with 1 where a demand on a method of poise is not met.
POISE_DATA says where the recordings are.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Sequence
from pathlib import Path

from accuracy import data_folder, trial_files
from fault_bench.contenders import contender, names
from fault_bench.matrix import Case, run, tasks
from fault_bench.report import document, failures, group_tables, summary_table
from fault_bench.rows import FAULTS
from scores import CHOSEN, HELD_OUT

SEEDS, FINAL_SEEDS = (1, 2), (101, 102)


def main(arguments: list[str] | None = None) -> int:
    """The command."""
    options = _options(arguments)
    files = _files(options)
    if not files:
        print(f"no such BROAD trials in {data_folder()}; POISE_DATA says where they are", file=sys.stderr)
        return int(bool(os.environ.get("CI")))
    seeds = options.seeds or (FINAL_SEEDS if options.final else SEEDS)
    wanted = [fault.key for fault in FAULTS if not options.rows or fault.group in options.rows]
    who = names(f"{options.methods},{options.peers}")
    cases = run(tasks(files, seeds, who, wanted), options.jobs, lambda text: print(text, file=sys.stderr, flush=True))
    if options.json:
        print(json.dumps(document(cases), indent=1, ensure_ascii=False))
    else:
        print(report(cases, who, options.markdown))
    return int(failures(cases, who) > 0)


def report(cases: Sequence[Case], who: Sequence[str], markdown: bool) -> str:
    """The summary, then the tables by fault of poise's methods, then those of the peers."""
    own = [name for name in who if contender(name).package == "poise"]
    foreign = [name for name in who if name not in own]
    parts = summary_table(cases, list(who), markdown=markdown)
    for columns in (own, foreign):
        if columns:
            parts += group_tables(cases, columns, markdown=markdown)
    return "\n".join(parts)


def _files(options: argparse.Namespace) -> list[Path]:
    half = HELD_OUT if options.final else CHOSEN
    wanted = options.trials or [f"{number:02d}" for number in half]
    return [file for file in trial_files() if file.stem[:2] in wanted]


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--final", action="store_true", help="the trials and seeds that nothing was developed on")
    parser.add_argument("--methods", default="methods", help="methods of poise, by commas (default all)")
    parser.add_argument(
        "--peers", default="peers", help='peers or packages, by commas (default all installed; "" none)'
    )
    parser.add_argument("--rows", type=_words, help="groups of faults, by commas: E2,E3")
    parser.add_argument("--trials", type=_words, help="trials, by commas: 01,05 (default: the half)")
    parser.add_argument("--seeds", type=_numbers, help="seeds, by commas (default: the half)")
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count() or 1), help="processes (default 2)")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print every case as JSON")
    form.add_argument("--markdown", action="store_true", help="print Markdown tables")
    options = parser.parse_args(arguments)
    if options.jobs < 1:
        parser.error(f"--jobs {options.jobs}: expected 1 or more")
    return options


def _words(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]


def _numbers(text: str) -> list[int]:
    return [int(word) for word in _words(text)]


if __name__ == "__main__":
    sys.exit(main())
