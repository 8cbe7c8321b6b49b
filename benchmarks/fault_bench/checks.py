"""Requirements that are no row of the matrix: fuzz (E1), a silent link (E4), other devices (E9), equal bits (E10, E16)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

from fault_bench.alarms import other_devices
from fault_bench.bits import same_bits
from fault_bench.checked import Check
from fault_bench.fuzz import fuzz
from fault_bench.live import asked_while_silent


class CheckTask(NamedTuple):
    """The checks of some groups for one method."""

    group: str
    file: Path
    seed: int
    method: str
    sequences: int

    def __str__(self) -> str:
        return f"checks of {self.group} for {self.method}"


def check_tasks(
    files: Sequence[Path], seed: int, methods: Iterable[str], groups: Sequence[str], sequences: int
) -> list[CheckTask]:
    """Every check of the groups that were asked for (all where none was), each method on another trial."""
    return [
        CheckTask(group, files[i % len(files)], seed, name, sequences)
        for i, name in enumerate(methods)
        for group in _CHECKS
        if not groups or group in groups
    ]


def check(task: CheckTask) -> list[Check]:
    """What the checks of one task say."""
    return _CHECKS[task.group](task)


_CHECKS = {
    "E1": lambda task: fuzz(task.method, task.sequences, task.seed),
    "E4": lambda task: asked_while_silent(task.method, task.file, task.seed),
    "E9": lambda task: other_devices(task.method, task.file.parents[1] / "other"),
    "E16": lambda task: same_bits(task.method, task.file, task.seed),
}
