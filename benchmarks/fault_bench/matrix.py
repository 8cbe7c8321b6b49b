"""The whole matrix, run: every fault on every trial, from every seed, for every contender."""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from fault_bench.contenders import SLOW, Contender, contender
from fault_bench.injectors import Injected
from fault_bench.judging import Clean, Figures, clean_figures, clean_run, judge
from fault_bench.rows import FAULTS, Fault
from poise import PoiseError, read

CLEAN = "clean"


class Case(NamedTuple):
    """One run: who, on what, with which figures; no figures where it was refused or crashed."""

    fault: str
    """a key of the matrix, or "clean" """
    contender: str
    trial: str
    seed: int
    figures: Figures
    refused: str = ""
    """what a poise error said"""
    crashed: str = ""
    """what any other exception said"""


class Task(NamedTuple):
    """What one process does at a time."""

    file: Path
    seed: int
    contenders: tuple[str, ...]
    faults: tuple[str, ...]

    def __str__(self) -> str:
        who = self.contenders[0] if len(self.contenders) == 1 else f"{len(self.contenders)} contenders"
        return f"{len(self.faults)} faults on {self.file.stem}, seed {self.seed}, {who}"


def tasks(files: Sequence[Path], seeds: Sequence[int], names: Sequence[str], faults: Iterable[str]) -> list[Task]:
    """Every trial with every seed for poise's methods, with the first one for peers; slow packages get one trial."""
    keys = tuple(faults)
    own = tuple(name for name in names if contender(name).package == "poise")
    peers = tuple(name for name in names if name not in own and contender(name).package not in SLOW)
    slow = [Task(files[0], seeds[0], (name,), keys) for name in names if contender(name).package in SLOW]
    others = [Task(file, seeds[0], peers, keys) for file in files if peers]
    return slow + others + [Task(file, seed, own, keys) for file in files for seed in seeds if own] if keys else []


def perform(task: Task) -> list[Case]:
    """Every case of one trial and seed."""
    recording = read(task.file)
    trial, cases = task.file.stem[:2], []
    clean: dict[str, tuple[Contender, Clean]] = {}
    for name in task.contenders:
        who = contender(name)
        clean[name] = who, clean_run(recording, who.run(recording, recording), who.has_heading)
        cases.append(Case(CLEAN, name, trial, task.seed, clean_figures(clean[name][1])))
    for fault in (fault for fault in FAULTS if fault.key in task.faults):
        try:
            injected = fault.inject(recording, generator(fault, trial, task.seed))
        except PoiseError as problem:  # the recording itself refuses the samples
            names = [name for name, (who, _) in clean.items() if not name.endswith("-bare")]
            cases += [
                Case(fault.key, name, trial, task.seed, refusal(fault, str(problem)), str(problem)) for name in names
            ]
            continue
        cases += [_case(fault, name, trial, task.seed, who, known, injected) for name, (who, known) in clean.items()]
    return cases


def generator(fault: Fault, trial: str, seed: int) -> np.random.Generator:
    """The same places for zeros as for NaN, others for every other fault, trial and seed."""
    what = fault.name.replace("zero", "NaN") if fault.group == "E10" else fault.name
    return np.random.default_rng([seed, int(trial), zlib.crc32(what.encode())])


def _case(
    fault: Fault, name: str, trial: str, seed: int, who: Contender, clean: Clean, injected: Injected
) -> Case:  # fmt: skip
    try:
        attitude = who.run(injected.recording, clean.recording)
    except PoiseError as problem:
        return Case(fault.key, name, trial, seed, refusal(fault, str(problem)), str(problem))
    except Exception as problem:  # another package's: a crash is what is to be counted
        return Case(fault.key, name, trial, seed, {}, "", f"{type(problem).__name__}: {problem}")
    figures = judge(clean, injected, attitude, fault.back, fault.sensor)
    if fault.refusal is not None:
        figures["refused or never valid"] = float(fault.refusal == "" and not attitude.valid.any())
    return Case(fault.key, name, trial, seed, figures)


def refusal(fault: Fault, message: str) -> Figures:
    """The figures of a run that was refused: a pass where the fault allows it and the message says what it must."""
    if fault.refusal is None:
        return {}
    return {"refused or never valid": float(fault.refusal in message)}
