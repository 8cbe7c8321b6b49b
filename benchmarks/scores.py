"""Errors of many methods on many trials: their means over groups of trials, stored, read back and compared."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from poise import Attitude, Recording, evaluate
from poise.evaluation import Errors

RESULTS = Path(__file__).parent / "results"
ALLOWED = 1.01  # a trial's error may grow by this factor
ALLOWED_MEAN = 1.005  # a mean over several trials by this one: a little on each of them adds up
CHOSEN = frozenset((1, 5, 9, 15, 25, 29, 33))  # the trials that defaults were chosen on
HELD_OUT = frozenset((3, 7, 11, 21, 27, 31, 35))  # the trials that check the choice
GROUPS = (  # the benchmark's own, by the words in a trial's name
    "slow",
    "fast",
    "rotation",
    "translation",
    "combined",
    "undisturbed",
    "tapping",
    "vibration",
    "stationary magnet",
    "attached magnet",
    "office",
    "mixed",
)
ERRORS = ("total", "heading", "inclination")
_FIGURES = ("mean", "groups", "trials")  # of a name in a stored table; what else is there are facts about it


class Score(NamedTuple):
    """A method's errors on one trial."""

    total: float | None
    """degrees RMSE, as the two below; None, like the heading's, for a method whose heading no sensor gives"""
    heading: float | None
    inclination: float
    diverged: bool
    missing: int
    """rows that should count but have no attitude"""

    @property
    def judged(self) -> float:
        """The error that counts: total, or inclination where that is all there is."""
        return self.inclination if self.total is None else self.total


Mean = dict[str, float | None]  # by ERRORS
Scores = dict[str, dict[str, Score]]  # by method, by trial


def score(attitude: Attitude, recording: Recording, has_heading: bool) -> Score:
    """The errors of one attitude against its recording's reference; only its inclination's without *has_heading*."""
    errors = evaluate(attitude, recording)
    rmse = errors.rmse_deg()
    if has_heading:
        return Score(*rmse, errors.diverged, errors.missing)
    e = errors.inclination  # the heading drifts, and the total error with it: neither is divergence
    leaning = Errors(errors.time, e, errors.heading, e, errors.counted, errors.missing)
    return Score(None, None, rmse.inclination, leaning.diverged, errors.missing)


def judged_by(trials: Mapping[str, Score], kind: str) -> bool:
    """Whether an error of a method counts: a method whose heading no sensor gives has no total nor heading error."""
    return any(getattr(s, kind) is not None for s in trials.values())


def halves(trials: Iterable[str]) -> dict[str, list[str]]:
    """All trials, and those of each half that has any."""
    names = list(trials)
    found = {"all": names}
    for half, numbers in (("chosen", CHOSEN), ("held-out", HELD_OUT)):
        found[half] = [name for name in names if int(name[:2]) in numbers]
    return {half: members for half, members in found.items() if members}


def groups(trials: Iterable[str]) -> dict[str, list[str]]:
    """The trials of each group that has any."""
    names = list(trials)
    found = {group: [n for n in names if f"_{group.replace(' ', '_')}_" in f"_{n}_"] for group in GROUPS}
    return {group: members for group, members in found.items() if members}


def means(trials: Mapping[str, Score], parts: Mapping[str, list[str]]) -> dict[str, Mean]:
    """The mean RMSE over each part of the trials, degrees; None for an error that is not judged."""
    return {part: _mean([trials[name] for name in members]) for part, members in parts.items()}


def _mean(scores: list[Score]) -> Mean:
    columns = {kind: [getattr(s, kind) for s in scores] for kind in ERRORS}
    return {kind: None if None in column else float(np.mean(column)) for kind, column in columns.items()}


def compare(stored: Mapping[str, Mapping[str, Score]], measured: Mapping[str, Mapping[str, Score]]) -> list[str]:
    """What is worse than stored, a sentence each: an error grown, a divergence, rows or trials lost."""
    worse = []
    for name, trials in stored.items():
        own = measured.get(name, {})
        for trial, then in trials.items():
            now = own.get(trial)
            if now is None:
                worse.append(f"{name} on {trial}: stored, but not measured now")
            elif (now.total is None) != (then.total is None):
                worse.append(
                    f"{name} on {trial}: the heading counted then or counts now, but not both; --write stores anew"
                )
            elif not now.judged <= ALLOWED * then.judged:  # NaN is worse
                worse.append(f"{name} on {trial}: {_growth(then.judged, now.judged)}")
            elif now.diverged and not then.diverged:
                worse.append(f"{name} on {trial}: diverges now")
            elif now.missing > then.missing:
                worse.append(f"{name} on {trial}: {then.missing} → {now.missing} rows without attitude")
        for part, members in (halves(trials) | groups(trials)).items():
            if len(members) > 1 and all(trial in own for trial in members):
                before, after = (float(np.mean([s[trial].judged for trial in members])) for s in (trials, own))
                if after > ALLOWED_MEAN * before:
                    worse.append(f"{name}, mean of {part}: {_growth(before, after)}")
    return worse


def _growth(then: float, now: float) -> str:
    return f"{then:.3f}° → {now:.3f}° ({now / then - 1.0:+.1%})"


def load(path: Path) -> Scores:
    """A stored table."""
    methods = json.loads(path.read_text(encoding="utf-8"))["results"]
    return {name: {trial: Score(**s) for trial, s in entry["trials"].items()} for name, entry in methods.items()}


def facts_of(path: Path) -> dict[str, dict[str, Any]]:
    """What a stored table says of each name beside its errors."""
    methods = json.loads(path.read_text(encoding="utf-8"))["results"]
    return {name: {k: v for k, v in entry.items() if k not in _FIGURES} for name, entry in methods.items()}


def document(scores: Scores, facts: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """The scores as they are stored and shown as JSON, with *facts* about each of their names."""
    return {
        "unit": "degrees RMSE over the rows that count, by the error definition of doi 10.3390/data6070072",
        "results": {
            name: {
                **(facts or {}).get(name, {}),
                "mean": _rounded(means(trials, halves(trials))),
                "groups": _rounded(means(trials, groups(trials))),
                "trials": {trial: _rounded(s._asdict()) for trial, s in trials.items()},
            }
            for name, trials in scores.items()
        },
    }


def _rounded(value: Any) -> Any:
    """Floats to a millionth of a degree: what differs beyond is the machine."""
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    return round(value, 6) if isinstance(value, float) else value
