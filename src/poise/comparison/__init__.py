"""Estimators side by side on one recording: their errors, or how far, when and why they disagree.

    comparison = compare(recording, peers="vqf,imufusion")
    for run in comparison.runs:
        print(run.name, run.failure or run.figures())
    comparison.stretches()  # who departs, from when to when, by how much, and why

Where the recording has a reference, the errors are those of :func:`poise.evaluate`, but that without a
magnetometer headings are aligned with it first. Where it has none, what most of the
estimators agree on takes its place: the same figures, but of a distance, and a majority may be wrong together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from numbers import Real
from typing import Any, Literal

import numpy as np

from poise.comparison.agreement import aligned, consensus
from poise.comparison.choice import as_methods, as_peers, available_peers, methods_named
from poise.comparison.departures import Stretch
from poise.comparison.result import Comparison, Heading, Pairs, Run
from poise.data.attitude import Attitude
from poise.data.recording import Recording
from poise.errors import MethodError, PoiseError, RecordingError
from poise.evaluation import evaluate
from poise.peers import Peer, installed

__all__ = [
    "LIMIT_DEG",
    "Comparison",
    "Pairs",
    "Run",
    "Stretch",
    "available_peers",
    "compare",
    "methods_named",
]

LIMIT_DEG = 10.0
"""how far an estimator may be from the reference or the consensus before it is said to depart"""


def compare(
    recording: Recording,
    methods: Any = None,
    peers: Mapping[str, Peer] | Iterable[str] | Peer | str = "",
    *,
    limit_deg: float = LIMIT_DEG,
    progress: Callable[[str, float], None] | None = None,
) -> Comparison:
    """Every method and peer on *recording*, side by side.

    *methods* are names of :data:`poise.METHODS`, methods by a name of your own, or a single one of either; all with their
    defaults if not given. *peers* as :func:`poise.peers.chosen` understands them, "vqf,imufusion,ahrs", or a list of such
    names, or peers by name. *progress* is called with the name of
    the estimator that is run and the share done. An estimator that cannot run is a run with its reason, and an attitude
    without a row is one; raises :class:`RecordingError` only for a recording without rows, and for names not known
    :class:`PoiseError`.
    """
    if not isinstance(recording, Recording):
        raise RecordingError(f"expected a Recording to compare on, found {type(recording).__name__}")
    if not isinstance(limit_deg, Real) or isinstance(limit_deg, bool) or not 0.0 < limit_deg <= 180.0:
        raise RecordingError(f"limit_deg: expected degrees above 0, up to 180, found {limit_deg!r}")
    todo, others = as_methods(methods), as_peers(peers)
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


def _run(name: str, estimator: Any, recording: Recording) -> Run:
    from poise.estimators.batch import estimate
    from poise.estimators.parameters import as_dict
    from poise.estimators.wrapping import core

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
            has_heading = hasattr(core(estimator), "declination")
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
    if not done:
        return ("no estimator gave an attitude: there is nothing to compare",)
    if against == "consensus":
        notes.append("no reference: distances are from the estimators' consensus, which may be wrong as a whole")
        if len(done) == 1:
            notes.append("one estimator alone has nothing to be compared with")
        elif len(done) == 2:
            notes.append("two estimators: each is half of their distance from the middle, and neither can be blamed")
        elif (split := _without_majority(recording, done, limit_deg)) > 0.5:
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
    if against == "reference" and recording.moving is not None and not recording.moving.any():
        notes.append("no row moves, so none counts: there are no errors to tell; departures are told of all rows")
    if against == "reference" and truth is not None:
        own = {run.attitude.heading_reference for run in done if run.attitude is not None and run.heading == "own"}
        if truth.heading_reference == "true" and "magnetic" in own:
            notes.append(
                "the reference counts from true north, estimators from magnetic north: declination is in the error"
            )
    return tuple(notes)


def _without_majority(recording: Recording, runs: list[Run], limit_deg: float) -> float:
    """s for which fewer than half of the estimators with an attitude are near the consensus."""
    judged = np.stack([run.judged for run in runs])
    with np.errstate(invalid="ignore"):
        near = np.sum(np.degrees(judged) <= limit_deg, axis=0)
    there = np.sum(np.isfinite(judged), axis=0)
    split = (there > 0) & (2 * near < there)
    return float(split.sum() / recording.rate_hz) if recording.rate_hz > 0 else 0.0


def _why_nothing(attitude: Attitude) -> str:
    reasons = attitude.reasons()
    return f"no row has an attitude: {reasons[0].sentence}" if reasons else "no row has an attitude"
