"""Estimators side by side on one recording: their errors, or how far, when and why they disagree.

    comparison = compare(recording, peers="vqf,imufusion")
    for run in comparison.runs:
        print(run.name, run.failure or run.figures())
    comparison.stretches()  # who departs, from when to when, by how much, and why

Where the recording has a reference, the errors are those of :func:`poise.evaluate`. Where it has none, what most of the
estimators agree on takes its place: the same figures, but of a distance, and a majority may be wrong together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import radians
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.comparison.agreement import aligned, consensus
from poise.comparison.departures import Judged, Stretch, settled, stretches, worst
from poise.data.attitude import Attitude
from poise.data.recording import Recording
from poise.errors import MethodError, PoiseError, RecordingError
from poise.estimators import METHODS
from poise.evaluation import Errors, evaluate
from poise.peers import PEERS, Peer, chosen, installed

Floats = NDArray[np.float64]
Heading = Literal["own", "aligned", "none"]

__all__ = ["LIMIT_DEG", "Comparison", "Run", "Stretch", "available_peers", "compare", "methods_named"]

LIMIT_DEG = 10.0
"""how far an estimator may be from the reference or the consensus before it is said to depart"""
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
        """s in all that an estimator is further than the limit from the reference or the consensus."""
        return float(sum(s.end - s.start for s in self.stretches(estimator)))

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


def compare(
    recording: Recording,
    methods: Mapping[str, Any] | Iterable[str] | None = None,
    peers: Mapping[str, Peer] | str = "",
    *,
    limit_deg: float = LIMIT_DEG,
    progress: Callable[[str, float], None] | None = None,
) -> Comparison:
    """Every method and peer on *recording*, side by side.

    *methods* are names of :data:`poise.METHODS` or methods by a name of your own; all with their defaults if not given.
    *peers* as :func:`poise.peers.chosen` understands them, "vqf,imufusion,ahrs". *progress* is called with the name of
    the estimator that is run and the share done. An estimator that cannot run is a run with its reason, and an attitude
    without a row is one; raises :class:`RecordingError` only for a recording without rows, and for names not known
    :class:`PoiseError`.
    """
    if not isinstance(recording, Recording):
        raise RecordingError(f"expected a Recording to compare on, found {type(recording).__name__}")
    if not np.isfinite(limit_deg) or not 0.0 < limit_deg <= 180.0:
        raise RecordingError(f"limit_deg: expected degrees above 0, up to 180, found {limit_deg!r}")
    todo: dict[str, Any] = dict(methods) if isinstance(methods, Mapping) else methods_named(methods)
    others: dict[str, Peer] = {}
    if peers:
        others = chosen(peers) if isinstance(peers, str) else dict(peers)
    if twice := todo.keys() & others.keys():
        raise MethodError(f"{', '.join(sorted(twice))}: a method and a peer of the same name; rename one")
    todo |= others
    if not todo:
        raise MethodError("nothing to compare: no method and no peer was chosen")
    if len(recording) == 0:
        raise RecordingError("the recording has no rows to compare on")
    runs = []
    for i, (name, estimator) in enumerate(todo.items()):
        if progress:
            progress(name, i / len(todo))
        runs.append(_run(name, estimator, recording))
    return _judged(recording, runs, limit_deg)


def methods_named(names: Iterable[str] | None = None) -> dict[str, Any]:
    """Methods with their defaults, by the names of :data:`poise.METHODS`; all of them if no names are given."""
    wanted = list(METHODS if names is None else [names] if isinstance(names, str) else names)
    for name in wanted:
        if name not in METHODS:
            raise MethodError(f"no method {name!r}; there are {', '.join(METHODS)}")
    return {name: METHODS[name]() for name in wanted}


def available_peers() -> dict[str, Peer]:
    """The peers whose package is installed."""
    return {name: peer for name, peer in PEERS.items() if installed(peer.package) is not None}


def _run(name: str, estimator: Any, recording: Recording) -> Run:
    from poise.estimators.engine import estimate
    from poise.estimators.parameters import as_dict

    has_heading, run = True, Run(name, "method", {})
    try:
        if isinstance(estimator, Peer):
            has_heading = estimator.has_heading
            settings = {
                "package": estimator.package,
                "version": installed(estimator.package),
                "settings": estimator.settings,
            }
            run = Run(name, "peer", settings)
            attitude = estimator.attitude(recording)
            run = replace(run, settings=settings | {"prepared": attitude.provenance.parameters.get("prepared", [])})
        else:
            run = Run(name, "method", as_dict(estimator) if hasattr(estimator, "_fields") else {})
            has_heading = hasattr(_core(estimator), "declination")
            attitude = estimate(estimator, recording)
    except PoiseError as problem:
        return replace(run, failure=str(problem))
    if not np.isfinite(attitude.quat).all(axis=1).any():
        return replace(run, failure=_why_nothing(attitude))
    heading: Heading = "none" if not has_heading else "aligned" if attitude.heading_reference == "arbitrary" else "own"
    return replace(run, heading=heading, attitude=attitude)


def _judged(recording: Recording, runs: list[Run], limit_deg: float) -> Comparison:
    """The runs with their errors from the reference, or from their consensus."""
    against: Literal["reference", "consensus"] = "consensus"
    reference: Attitude | None = None
    if recording.truth is not None and np.isfinite(recording.truth.quat).all(axis=1).any():
        against, reference = "reference", recording.truth
    first = reference or _first(runs, "own") or _first(runs, "aligned")
    if first is not None:
        runs = [
            replace(run, attitude=aligned(run.attitude, first)) if run.attitude and run.heading == "aligned" else run
            for run in runs
        ]
    there = [(run.attitude, run.heading != "none") for run in runs if run.attitude is not None]
    if reference is None and there:
        reference = consensus([a for a, _ in there], [own for _, own in there])
    compared_with = recording if against == "reference" else reference
    if compared_with is not None:
        runs = [replace(run, errors=evaluate(run.attitude, compared_with)) if run.attitude else run for run in runs]
    return Comparison(
        recording, reference, against, tuple(runs), limit_deg, _notes(recording, against, runs, limit_deg)
    )


def _first(runs: Iterable[Run], heading: Heading) -> Attitude | None:
    return next((run.attitude for run in runs if run.attitude is not None and run.heading == heading), None)


def _notes(recording: Recording, against: str, runs: list[Run], limit_deg: float) -> tuple[str, ...]:
    notes = []
    done = [run for run in runs if run.attitude is not None]
    if against == "consensus":
        notes.append("no reference: distances are from the estimators' consensus, which may be wrong as a whole")
        if len(done) == 1:
            notes.append("one estimator alone has nothing to be compared with")
        elif len(done) == 2:
            notes.append("two estimators: each is half of their distance from the middle, and neither can be blamed")
        elif done and (split := _without_majority(recording, done, limit_deg)) > 0.5:
            notes.append(
                f"for {split:.1f} s in all fewer than half of them are within {limit_deg:g}° of the consensus: there it says "
                "nothing"
            )
    if any(run.heading == "aligned" for run in done):
        notes.append(
            "no magnetometer: headings are arbitrary, and turned by one angle each to fit before they are compared"
        )
    if none := [run.name for run in done if run.heading == "none"]:
        notes.append(f"{', '.join(none)}: no heading of its own, judged by inclination only")
    truth = recording.truth
    if against == "reference" and truth is not None:
        own = {run.attitude.heading_reference for run in done if run.attitude is not None and run.heading == "own"}
        if truth.heading_reference == "true" and "magnetic" in own:
            notes.append(
                "the reference counts from true north, estimators from magnetic north: declination is in the error"
            )
    return tuple(notes)


def _without_majority(recording: Recording, runs: list[Run], limit_deg: float) -> float:
    """s for which no more than half of the estimators with an attitude are near the consensus."""
    judged = np.stack([run.judged for run in runs])
    with np.errstate(invalid="ignore"):
        near = np.sum(np.degrees(judged) <= limit_deg, axis=0)
    there = np.sum(np.isfinite(judged), axis=0)
    split = (there > 0) & (2 * near <= there)
    return float(split.sum() / recording.rate_hz) if recording.rate_hz > 0 else 0.0


def _why_nothing(attitude: Attitude) -> str:
    reasons = attitude.reasons()
    return f"no row has an attitude: {reasons[0].sentence}" if reasons else "no row has an attitude"


def _core(method: Any) -> Any:
    """The method inside its wrappers."""
    from poise.estimators.guard import Guard
    from poise.estimators.rest_bias import RestBias

    while isinstance(method, (Guard, RestBias)):
        method = method.method
    return method


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
