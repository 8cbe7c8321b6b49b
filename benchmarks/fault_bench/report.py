"""The cases as tables: who meets what, by fault."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import isfinite, nan
from typing import Any, NamedTuple

import numpy as np

from fault_bench.checked import Check
from fault_bench.contenders import FLAGSHIP, contender
from fault_bench.matrix import CLEAN, Case
from fault_bench.rows import FAULTS, Demand, Fault
from tables import Cell, heading, table

SILENT_SHARE, COVERED_SHARE = 0.005, 0.95  # E15
LOST_RATIO = 2.0  # an error so many times the clean one is a wrong attitude that nobody asked for
TITLES = {
    "E2": "one bad row in any sensor",
    "E3": "1 s of NaN",
    "E4": "gyroscope or whole link lost",
    "E5": "rows lost, doubled, swapped; stamps uneven",
    "E6": "the clock",
    "E7": "saturation",
    "E8": "spikes",
    "E9": "stuck or zero sensors",
    "E10": "no magnetometer",
    "E11": "hard iron",
    "E12": "a step of the gyroscope's bias",
}


class Outcome(NamedTuple):
    """What one contender did with one demand, over all its cases."""

    median: float
    worst: float
    failed: int
    cases: int

    @property
    def applies(self) -> bool:
        """Whether any case had a figure."""
        return self.cases > 0


def outcome(demand: Demand, cases: Iterable[Case]) -> Outcome:
    """One demand over some cases; a case without figures, refused or crashed, fails it."""
    worst = np.inf if demand.kind == "at most" else -np.inf
    every = [case.figures.get(demand.figure, nan) if case.figures else worst for case in cases]
    values = np.array([value for value in every if value == value])
    if not len(values):
        return Outcome(nan, nan, 0, 0)
    extreme = float(values.max() if demand.kind == "at most" else values.min())
    median = float(np.sort(values)[len(values) // 2]) if np.isinf(values).any() else float(np.median(values))
    if demand.of == "median":
        return Outcome(median, extreme, int(not demand.met(median)), len(values))
    return Outcome(median, extreme, sum(not demand.met(value) for value in values), len(values))


def asked(demand: Demand, name: str) -> bool:
    """Whether that contender has to meet the demand; peers are measured by the same."""
    return not demand.flagship or name == FLAGSHIP


def by_fault(cases: Sequence[Case]) -> dict[tuple[str, str], list[Case]]:
    """The cases of each fault and contender."""
    found: dict[tuple[str, str], list[Case]] = {}
    for case in cases:
        found.setdefault((case.fault, case.contender), []).append(case)
    return found


def group_tables(cases: Sequence[Case], names: Sequence[str], *, markdown: bool) -> list[str]:
    """A table for each group of faults."""
    found, parts = by_fault(cases), []
    done = {case.fault for case in cases}
    for group, title in TITLES.items():
        rows: list[list[Cell]] = []
        for fault in (f for f in FAULTS if f.group == group and f.key in done):
            for i, demand in enumerate(fault.demands):
                cells = [_cell(demand, outcome(demand, found.get((fault.key, n), [])), asked(demand, n)) for n in names]
                rows.append([fault.name if i == 0 else "", demand.sentence, *cells])
            rows.append(["", "valid rows, %", *(_valid(found.get((fault.key, n), [])) for n in names)])
        if rows:
            parts.append(heading(f"{group}: {title}", markdown=markdown))
            parts.append(table(["fault", "asked: median / worst", *names], rows, markdown=markdown))
    return parts


def _cell(demand: Demand, found: Outcome, judged: bool) -> str | None:
    if not found.applies:
        return None
    median, worst = _figure(found.median, demand.unit), _figure(found.worst, demand.unit)
    text = median if median == worst else f"{median} / {worst}"
    if not judged:
        return f"({text})"
    return f"{text} ✗{found.failed}" if found.failed else text


def _figure(value: float, unit: str) -> str:
    if not isfinite(value):
        return "∞" if value > 0 else "none"
    value = 100.0 * value if unit == "%" else value
    if abs(value) < 0.0005:
        return "0"
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def _valid(cases: Sequence[Case]) -> str | None:
    shares = [case.figures["valid"] for case in cases if "valid" in case.figures]
    refused = sum(bool(case.refused) for case in cases)
    crashed = sum(bool(case.crashed) for case in cases)
    ends = [f"{100 * share:.4g}" for share in (np.median(shares), min(shares))] if shares else []
    words = [" / ".join(dict.fromkeys(ends))] if ends else []
    words += [f"{refused} refused"] if refused else []
    words += [f"{crashed} crashed"] if crashed else []
    return ", ".join(words) or None


def check_table(checks: Sequence[Check], names: Sequence[str], *, markdown: bool) -> list[str]:
    """The checks that are no rows of the matrix."""
    if not checks:
        return []
    found = {(check.group, check.name, check.asked, check.contender): check for check in checks}
    lines = list(dict.fromkeys((check.group, check.name, check.asked) for check in checks))
    rows: list[list[Cell]] = []
    for line in lines:
        cells = [found.get((*line, name)) for name in names]
        rows.append([f"{line[0]}: {line[1]}", line[2], *(c and f"{c.found}{'' if c.met else ' ✗'}" for c in cells)])
    return [heading("Checks", markdown=markdown), table(["", "asked", *names], rows, markdown=markdown)]


def summary_table(cases: Sequence[Case], names: Sequence[str], *, markdown: bool) -> list[str]:
    """How many demands each contender meets, and what holds over the whole matrix (E1, E15)."""
    rows: list[list[Cell]] = []
    done = [fault for fault in FAULTS if fault.key in {case.fault for case in cases}]
    found = by_fault(cases)
    for group, title in TITLES.items():
        faults = [fault for fault in done if fault.group == group]
        if faults:
            rows.append(
                [f"{group}: {title}", "demands failed / asked", *(_failed(found, faults, name) for name in names)]
            )
    for words, limit, figure in _WHOLE:
        rows.append([words, limit, *(figure([case for case in cases if case.contender == name]) for name in names)])
    return [
        heading("Over the whole matrix", markdown=markdown),
        table(["", "asked", *names], rows, markdown=markdown),
    ]


def _failed(found: Mapping[tuple[str, str], list[Case]], faults: Iterable[Fault], name: str) -> str | None:
    outcomes = [
        outcome(demand, found.get((fault.key, name), []))
        for fault in faults
        for demand in fault.demands
        if asked(demand, name)
    ]
    outcomes = [o for o in outcomes if o.applies]
    return f"{sum(o.failed > 0 for o in outcomes)} / {len(outcomes)}" if outcomes else None


def _mean(cases: Iterable[Case], figure: str) -> float:
    values = [case.figures[figure] for case in cases if case.figures.get(figure, nan) == case.figures.get(figure, nan)]
    values = [value for value in values if value == value]
    return float(np.mean(values)) if values else nan


def _faulty(cases: Iterable[Case]) -> list[Case]:
    return [case for case in cases if case.fault != CLEAN and "silent" in case.figures]


def _clean(cases: Iterable[Case]) -> list[Case]:
    return [case for case in cases if case.fault == CLEAN]


def _percent(value: float, met: bool) -> str | None:
    return None if value != value else f"{100 * value:.3g} %{'' if met else ' ✗'}"


def _bad_rows(cases: list[Case]) -> str:
    rows = int(sum(case.figures.get("bad rows", 0.0) for case in cases))
    return f"{rows}{' ✗' if rows else ''}"


def _silent(cases: list[Case]) -> str | None:
    share = _mean(_faulty(cases), "silent")
    return _percent(share, share <= SILENT_SHARE)


def _silent_clean(cases: list[Case]) -> str | None:
    return _percent(_mean(_clean(cases), "silent"), True)


def _covered(cases: list[Case]) -> str | None:
    share = _mean(_clean(cases), "within 3 sigma")
    return _percent(share, share >= COVERED_SHARE)


def _alarms(cases: list[Case]) -> str | None:
    share = _mean(_clean(cases), "false alarms")
    return _percent(share, share == 0.0)


def _for_ever(cases: list[Case]) -> str:
    """Runs that end in NaN or in an error of twice the clean one."""
    faulty = [case for case in cases if case.fault != CLEAN]
    wrong = [
        case
        for case in faulty
        if case.crashed or case.figures.get("lost for ever") or not case.figures.get("ratio", 0.0) <= LOST_RATIO
    ]
    return f"{len(wrong)} / {len(faulty)}"


_WHOLE = (
    ("E1: rows not finite", "0", _bad_rows),
    ("E15: valid and wrong by > 10° and 5σ, faulty", "≤ 0.5 %", _silent),
    ("… the same, clean", "", _silent_clean),
    ("E15: clean rows within 3σ", "≥ 95 %", _covered),
    ("E9: alarms on clean recordings", "0 %", _alarms),
    ("runs that end in NaN or twice the clean error", "", _for_ever),
)


def document(cases: Sequence[Case], checks: Sequence[Check]) -> dict[str, Any]:
    """Everything as JSON; figures that do not apply are left out, endless ones are text."""
    return {
        "cases": [
            case._asdict() | {"figures": {k: v if isfinite(v) else "inf" for k, v in case.figures.items() if v == v}}
            for case in cases
        ],
        "checks": [check._asdict() for check in checks],
    }


def failures(cases: Sequence[Case], names: Iterable[str]) -> int:
    """How many demands on methods of poise are not met."""
    found = by_fault(cases)
    own = [name for name in names if contender(name).package == "poise"]
    return sum(
        outcome(demand, found.get((fault.key, name), [])).failed > 0
        for fault in FAULTS
        for demand in fault.demands
        for name in own
        if asked(demand, name)
    )
