"""What a comparison found out: the runs, their distances, and where they disagree."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import radians
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.comparison.departures import Judged, Stretch, beyond, settled, stretches, worst
from poise.data.attitude import Attitude
from poise.data.recording import Recording
from poise.evaluation import Errors, evaluate

Floats = NDArray[np.float64]
Heading = Literal["own", "aligned", "none"]

_EPOCH = (1e8, 1e11)  # s: stamps between these count from 1970, not from the start of a recording
_KINDS = ("total", "heading", "inclination")


@dataclass(frozen=True, eq=False)
class Run:
    """One estimator on one recording: its attitude and how far that is from the reference, or why there is none."""

    name: str
    kind: Literal["method", "peer"]
    settings: Mapping[str, Any]
    """parameters of a method; package, version and settings of a peer"""
    heading: Heading = "own"
    """measured; arbitrary and turned by one angle to fit the others; or not estimated: then the inclination is judged"""
    attitude: Attitude | None = None
    errors: Errors | None = None
    """from the reference of the recording, or from the consensus"""
    failure: str = ""
    """why there is no attitude"""

    @property
    def judged(self) -> Floats:
        """(n,) rad: the total error, or the inclination's of an estimator without heading; empty after a failure."""
        if self.errors is None:
            return np.empty(0)
        return self.errors.inclination if self.heading == "none" else self.errors.total

    def figures(self) -> dict[str, dict[str, float]]:
        """RMSE, mean, median, 95th percentile, maximum by kind of error, degrees; without a heading, inclination only."""
        table = self.errors.table() if self.errors is not None else {}
        return {kind: table[kind] for kind in _KINDS if kind in table and (self.heading != "none" or kind == _KINDS[2])}

    @property
    def diverged(self) -> bool:
        """Whether the judged error stays above 90° for 5 s somewhere."""
        return self.errors is not None and replace(self.errors, total=self.judged).diverged


class Pairs(NamedTuple):
    """How far every two estimators are apart, RMS over time, degrees."""

    names: tuple[str, ...]
    heading: Floats
    """(k, k); NaN where one of the two has no heading"""
    inclination: Floats
    """(k, k)"""


@dataclass(frozen=True, eq=False)
class Comparison:
    """Several estimators on one recording; :func:`compare` makes it."""

    recording: Recording
    reference: Attitude | None
    """what the errors are counted from; None where no estimator gave an attitude"""
    against: Literal["reference", "consensus"]
    runs: tuple[Run, ...]
    limit_deg: float
    notes: tuple[str, ...]
    """what to bear in mind when reading the figures"""

    @property
    def done(self) -> list[Run]:
        """The runs that gave an attitude."""
        return [run for run in self.runs if run.errors is not None]

    @property
    def zero(self) -> float:
        """s that people see as 0: the first stamp where stamps count from 1970, else 0. Stamps themselves are kept."""
        known = self.recording.time[np.isfinite(self.recording.time)]
        return float(known[0]) if len(known) and _EPOCH[0] < known[0] < _EPOCH[1] else 0.0

    @property
    def best(self) -> Run | None:
        """Of poise's methods that have a heading, the one with the least RMS distance; else any run that is done."""

        def rank(run: Run) -> tuple[bool, bool, float]:
            figures = run.figures().get("total" if run.heading != "none" else "inclination")
            return run.kind != "method", run.heading == "none", figures["rmse"] if figures else np.inf

        return min(self.done, key=rank, default=None)

    @cached_property
    def found(self) -> tuple[Stretch, ...]:
        """Every stretch of disagreement, the worst first."""
        judged = {
            run.name: Judged(run.attitude, run.errors, run.heading != "none")
            for run in self.runs
            if run.attitude is not None and run.errors is not None
        }
        if self.reference is None:
            return ()
        return tuple(stretches(self.recording, judged, self.reference, radians(self.limit_deg)))

    def stretches(self, estimator: str | None = None) -> tuple[Stretch, ...]:
        """Where an estimator, or any, is further than the limit from the reference or the consensus, the worst first."""
        return tuple(s for s in self.found if estimator is None or s.estimator == estimator)

    @cached_property
    def pairs(self) -> Pairs:
        """The distance of every two estimators from each other."""
        runs = self.done
        apart = np.zeros((2, len(runs), len(runs)))
        for i, a in enumerate(runs):
            for j, b in enumerate(runs[:i]):
                assert a.attitude is not None and b.attitude is not None  # done
                rmse = evaluate(a.attitude, b.attitude).rmse_deg()
                both = a.heading != "none" and b.heading != "none"
                apart[:, i, j] = apart[:, j, i] = rmse.heading if both else np.nan, rmse.inclination
        for i, run in enumerate(runs):
            apart[0, i, i] = np.nan if run.heading == "none" else 0.0
        return Pairs(tuple(run.name for run in runs), apart[0], apart[1])

    def seconds_away(self, estimator: str) -> float:
        """s in all that an estimator is further than the limit from the reference or the consensus; 0 if it has no errors.

        The time of the rows themselves: without what a stretch bridges, with what is too short to be one.
        """
        return sum(
            beyond(r.errors.time, r.judged, radians(self.limit_deg))
            for r in self.done
            if r.name == estimator and r.errors
        )

    def to_dict(self) -> dict[str, Any]:
        """Everything but the samples, as plain values; figures that do not exist are None."""
        recording = self.recording
        facts: dict[str, Any] = _plain(
            {
                "recording": {
                    "name": recording.name,
                    "source": recording.source,
                    "sha256": recording.source_hash,
                    "rows": len(recording),
                    "seconds": recording.duration,
                    "rate_hz": recording.rate_hz,
                    "sensors": [s for s in ("gyr", "acc", "mag") if _present(recording, s)],
                    "reference": recording.truth is not None,
                    "notes": list(recording.notes),
                },
                "against": self.against,
                "limit_deg": self.limit_deg,
                "notes": list(self.notes),
                "estimators": [self._line(run) for run in self.runs],
                "apart_rms_deg": {
                    "names": self.pairs.names,
                    "heading": self.pairs.heading.tolist(),
                    "inclination": self.pairs.inclination.tolist(),
                },
                "stretches": [s._asdict() for s in self.found],
            }
        )
        return facts

    def _line(self, run: Run) -> dict[str, Any]:
        line: dict[str, Any] = {
            "name": run.name,
            "kind": run.kind,
            "settings": dict(run.settings),
            "heading": run.heading,
            "failure": run.failure or None,
            "error_deg": dict.fromkeys(_KINDS) | run.figures(),
            "rows": 0,
            "missing": None,
            "valid": None,
            "diverged": None,
            "settled_s": None,
            "worst_5s": None,
            "seconds_away": None,
        }
        if run.errors is not None and run.attitude is not None:
            time = run.errors.time
            line |= {
                "rows": int(run.errors.counted.sum()),
                "missing": run.errors.missing,
                "valid": float(run.attitude.valid.mean()),
                "diverged": run.diverged,
                "settled_s": settled(time, run.judged, radians(self.limit_deg)),
                "worst_5s": worst(time, run.judged),
                "seconds_away": self.seconds_away(run.name),
            }
        return line


def _present(recording: Recording, sensor: str) -> bool:
    return recording.has_mag if sensor == "mag" else bool(np.isfinite(getattr(recording, sensor)).any())


def _plain(value: Any) -> Any:
    """Values of JSON only: what is not a finite number is None."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float):
        return value if np.isfinite(value) else None
    return value if isinstance(value, (str, int, bool, type(None))) else str(value)
