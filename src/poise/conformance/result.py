"""What was found out about an estimator, as data and as text."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple

Verdict = Literal["conforms", "inclination only", "does not conform"]


class Finding(NamedTuple):
    """One question about an estimator."""

    question: str
    answer: str
    """or "cannot tell", where nothing decides"""
    evidence: str
    residual_deg: float = float("nan")
    """RMS, read as the answer says"""
    next_deg: float = float("nan")
    """RMS of the best other answer; NaN where there is no other"""

    @property
    def told(self) -> bool:
        """Whether the question could be answered."""
        return self.answer != CANNOT_TELL


CANNOT_TELL = "cannot tell"


@dataclass(frozen=True, eq=False)
class Conformance:
    """What an estimator really takes and gives, found out by feeding it made truth."""

    name: str
    verdict: Verdict
    summary: str
    """one sentence"""
    residual_deg: float
    """RMS over a minute's turning, read as found"""
    margin_deg: float
    """by which the second best hypothesis is worse"""
    findings: tuple[Finding, ...]
    hints: tuple[str, ...] = ()
    """what was seen that a user may want to mend"""
    convention: Mapping[str, Any] = field(default_factory=dict)
    """the answers as keys and values, for programs; empty where it does not conform"""
    adapter: str = ""
    """Python that turns its output into an attitude of poise; empty where it does not conform"""

    def __getitem__(self, question: str) -> Finding:
        """The finding about "direction", "Earth frame", …"""
        for finding in self.findings:
            if finding.question == question:
                return finding
        raise KeyError(f"no question {question!r}; there are {', '.join(f.question for f in self.findings)}")

    def __str__(self) -> str:
        width = max((len(f.question) for f in self.findings), default=0)
        lines = [f"{self.name}: {self.summary}"]
        lines += [f"  {f.question:<{width}}  {f.answer}: {f.evidence}" for f in self.findings]
        return "\n".join([*lines, *(f"  {hint}" for hint in self.hints)])

    def to_dict(self) -> dict[str, Any]:
        """Everything, ready for JSON."""
        return {
            "name": self.name,
            "verdict": self.verdict,
            "summary": self.summary,
            "residual_deg": self.residual_deg,
            "margin_deg": self.margin_deg,
            "convention": dict(self.convention),
            "findings": [f._asdict() for f in self.findings],
            "hints": list(self.hints),
            "adapter": self.adapter,
        }
