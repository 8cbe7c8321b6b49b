"""Findings: what the doctor has to say of a recording, ranked, with what repairs it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from poise.data.corrections import Corrections
from poise.data.recording import Recording
from poise.doctor.axes import Verdict
from poise.doctor.turning import Turns
from poise.formats.units import FACTORS, SI

Severity = Literal["sure", "likely", "cannot-tell", "note"]
RANK: tuple[Severity, ...] = ("sure", "likely", "cannot-tell", "note")


@dataclass(frozen=True)
class Finding:
    """One thing that was found."""

    name: str
    """of the check: "gyr unit", "axes", "mag delay", …"""
    severity: Severity
    sentence: str
    """what is the matter, with the figures that show it"""
    fix: Corrections = field(default_factory=Corrections)
    """what repairs it, or may"""
    decided: bool = True
    """whether *fix* is the only one that it can be"""
    choices: tuple[Corrections, ...] = ()
    """of which one is right, and the recording does not tell which; without any correction it may be right as it is"""


@dataclass(frozen=True, eq=False)
class Evidence:
    """What the verdicts on units and axes rest on, for the sheet."""

    acc: Turns
    mag: Turns
    axes: Verdict


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """What :func:`poise.diagnose` found in a recording."""

    recording: Recording
    findings: tuple[Finding, ...]
    """the gravest first"""
    evidence: Evidence | None = None
    read_as: Mapping[str, str] = field(default_factory=dict)
    """the units that the file was read in, by sensor, where they are not SI"""

    @property
    def verdict(self) -> str:
        """One sentence."""
        sure = self.found("sure")
        if not sure:
            if self.untold:
                which = " or ".join(options(choice, self.read_as) for choice in self.untold[0].choices)
                return f"cannot tell: {', '.join(f.name for f in self.untold)}; say {which}"
            likely = self.found("likely")
            if likely:
                return f"nothing surely wrong; {len(likely)} to look at: {', '.join(f.name for f in likely)}"
            open_ = self.found("cannot-tell")
            return "fine" + (f", as far as it can be told (not: {', '.join(f.name for f in open_)})" if open_ else "")
        what = ", ".join(f.name for f in sure)
        if self.repairs and all(f.fix and f.decided for f in sure):
            return f"surely wrong: {what}; {self.options()} repairs it"
        return f"surely wrong: {what}; not all of it can be repaired for sure"

    @property
    def untold(self) -> tuple[Finding, ...]:
        """The findings that leave a choice which somebody else must make."""
        return tuple(f for f in self.findings if f.choices)

    @property
    def repairs(self) -> Corrections:
        """What is sure, together; empty where nothing is surely wrong."""
        return merged([f.fix for f in self.found("sure") if f.decided])

    def found(self, severity: Severity) -> tuple[Finding, ...]:
        """The findings of that severity."""
        return tuple(f for f in self.findings if f.severity == severity)

    def repair(self, recording: Recording) -> Recording:
        """*recording* with :attr:`repairs` applied."""
        return self.repairs.apply(recording)

    def options(self) -> str:
        """:attr:`repairs` as options of the command line; empty without any."""
        return options(self.repairs, self.read_as)

    def to_dict(self) -> dict[str, Any]:
        return {
            "verdict": self.verdict,
            "options": self.options(),
            "findings": [
                {
                    "name": f.name,
                    "severity": f.severity,
                    "sentence": f.sentence,
                    "options": options(f.fix, self.read_as),
                    "decided": f.decided,
                    "choices": [options(choice, self.read_as) for choice in f.choices],
                }
                for f in self.findings
            ],
        }


def merged(several: list[Corrections]) -> Corrections:
    """All of them as one; they concern different sensors or different things."""
    factors: dict[str, float] = {}
    axes: dict[str, str] = {}
    delays: dict[str, float] = {}
    for each in several:
        factors |= each.factors
        axes |= each.axes
        delays |= each.delays
    return Corrections(factors, axes, delays)


def options(fix: Corrections, read_as: Mapping[str, str] | None = None) -> str:
    """*fix* as options of the command line: ``--units gyr=deg/s --remap "acc=y -x z"``."""
    told = []
    named = {sensor: unit_after(sensor, factor, read_as) for sensor, factor in fix.factors.items()}
    units = [f"{sensor}={unit}" for sensor, unit in named.items() if unit]
    if units:
        told.append(f"--units {','.join(units)}")
    if fix.axes:
        told.append(f'--remap "{",".join(f"{sensor}={words}" for sensor, words in fix.axes.items())}"')
    if fix.delays:
        told.append("--delay " + ",".join(f"{sensor}={late:.4g}" for sensor, late in fix.delays.items()))
    return " ".join(told)


def unit_after(sensor: str, factor: float, read_as: Mapping[str, str] | None = None) -> str:
    """The unit of a sensor's numbers that were taken for *read_as* (or SI) and lack *factor*; empty where none is so large."""
    table = FACTORS[sensor]
    taken = table[(read_as or {}).get(sensor, SI[sensor])]
    wanted = taken / factor if sensor == "time" else taken * factor  # time: how many go into a second
    best = min(table, key=lambda unit: max(table[unit] / wanted, wanted / table[unit]))
    return best if 0.99 < table[best] / wanted < 1.01 else ""
