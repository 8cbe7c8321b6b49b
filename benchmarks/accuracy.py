"""How accurate poise's methods are on the BROAD trials, compared with the table that is stored.

    python benchmarks/accuracy.py [--peers] [--write] [--json | --markdown]

Every method with its defaults, nothing aligned or tuned per trial; RMSE in degrees over the rows that count. Ends with
1 where a trial is more than 1 % worse than stored. POISE_DATA says where the recordings are.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from poise import METHODS, Attitude, PoiseError, Recording, estimate, evaluate, read
from poise.peers import PEERS, Peer, installed
from tables import Cell, heading, table

RESULTS = Path(__file__).parent / "results"
ALLOWED = 1.01  # a trial's total error may grow by this factor
CHOSEN = frozenset((1, 5, 9, 15, 25, 29, 33))  # the trials that defaults were chosen on
HELD_OUT = frozenset((3, 7, 11, 21, 27, 31, 35))  # the trials that check the choice


class Score(NamedTuple):
    """A method's errors on one trial."""

    total: float
    """degrees RMSE, as the two below"""
    heading: float
    inclination: float
    diverged: bool
    missing: int
    """rows that should count but have no attitude"""


Scores = dict[str, dict[str, Score]]  # by method, by trial
Means = dict[str, dict[str, float]]


def data_folder() -> Path:
    """Where the trials are: below POISE_DATA, or below ../shared/data beside the checkout."""
    root = os.environ.get("POISE_DATA") or Path(__file__).parents[2] / "shared" / "data"
    return Path(root) / "broad"


def trial_files() -> list[Path]:
    """The trials' files in order; empty where the recordings are absent."""
    return sorted(data_folder().glob("[0-9][0-9]_*.mat"))


def score(attitude: Attitude, recording: Recording) -> Score:
    """The errors of one attitude against its recording's reference."""
    errors = evaluate(attitude, recording)
    return Score(*errors.rmse_deg(), errors.diverged, errors.missing)


def run_method(method: Any) -> Callable[[Recording], Attitude]:
    """How one of poise's methods makes an attitude."""
    return lambda recording: estimate(method, recording)


def run_peer(peer: Peer) -> Callable[[Recording], Attitude]:
    """How another package's filter makes an attitude."""
    return lambda recording: Attitude.of(recording.time, peer.run(recording), heading_reference="magnetic")


def measure(files: Iterable[Path], runs: Mapping[str, Callable[[Recording], Attitude]]) -> Scores:
    """The scores of everything in *runs* on the trials in *files*."""
    scores: Scores = {name: {} for name in runs}
    for path in files:
        recording = read(path)
        for name, run in runs.items():
            scores[name][path.stem] = score(run(recording), recording)
    return scores


def means(trials: Mapping[str, Score]) -> Means:
    """The mean RMSE over all trials and over each half that has any, degrees."""
    found: Means = {}
    for half, numbers in (("all", None), ("chosen", CHOSEN), ("held-out", HELD_OUT)):
        rows = [s[:3] for name, s in trials.items() if numbers is None or int(name[:2]) in numbers]
        if rows:
            found[half] = dict(zip(Score._fields, np.mean(rows, axis=0).tolist(), strict=False))
    return found


def compare(stored: Mapping[str, Mapping[str, Score]], measured: Mapping[str, Mapping[str, Score]]) -> list[str]:
    """What is worse than stored, a sentence each: an error grown by more than 1 %, a divergence, rows or trials lost."""
    worse = []
    for name, trials in stored.items():
        for trial, then in trials.items():
            now = measured.get(name, {}).get(trial)
            if now is None:
                worse.append(f"{name} on {trial}: stored, but not measured now")
            elif not now.total <= ALLOWED * then.total:  # NaN is worse
                growth = now.total / then.total - 1.0
                worse.append(f"{name} on {trial}: {then.total:.3f}° → {now.total:.3f}° ({growth:+.1%})")
            elif now.diverged and not then.diverged:
                worse.append(f"{name} on {trial}: diverges now")
            elif now.missing > then.missing:
                worse.append(f"{name} on {trial}: {then.missing} → {now.missing} rows without attitude")
    return worse


def load(path: Path) -> Scores:
    """A stored table."""
    methods = json.loads(path.read_text(encoding="utf-8"))["results"]
    return {name: {trial: Score(**s) for trial, s in entry["trials"].items()} for name, entry in methods.items()}


def document(scores: Scores, facts: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """The scores as they are stored and shown as JSON, with *facts* about each of their names."""
    return {
        "unit": "degrees RMSE over the rows that count, by the error definition of doi 10.3390/data6070072",
        "results": {
            name: {**(facts or {}).get(name, {}), "mean": _rounded(means(trials)), "trials": _as_dicts(trials)}
            for name, trials in scores.items()
        },
    }


def report(scores: Scores, markdown: bool) -> str:
    """The means of all, then each one's trials."""
    columns = ["total/heading/inclination", "all", "chosen half", "held-out half", "diverged"]
    parts = [heading("Mean RMSE over the trials, degrees", markdown=markdown)]
    parts.append(table(columns, [_summary(name, trials) for name, trials in scores.items()], markdown=markdown))
    for name, trials in scores.items():
        parts.append(heading(f"{name}: RMSE, degrees", markdown=markdown))
        rows: list[list[Cell]] = [
            [trial, *s[:3], "yes" if s.diverged else "no", s.missing or None] for trial, s in trials.items()
        ]
        rows += [[f"mean, {half}", *mean.values(), None, None] for half, mean in means(trials).items()]
        parts.append(table(["trial", *Score._fields], rows, markdown=markdown))
    return "\n".join(parts)


def check(scores: Scores) -> int:
    """Say how the scores stand against the stored table; the exit code."""
    path = RESULTS / "accuracy.json"
    if not path.exists():
        print(f"\nno stored table to compare with; --write makes {path.name}", file=sys.stderr)
        return int(bool(os.environ.get("CI")))
    stored = load(path)
    worse = compare(stored, scores)
    for sentence in worse:
        print(f"WORSE {sentence}", file=sys.stderr)
    for name in scores.keys() - stored.keys():
        print(f"{name} is not in the stored table: not compared", file=sys.stderr)
    if not worse:
        print("\nno trial is more than 1 % worse than stored", file=sys.stderr)
    return int(bool(worse))


def main(arguments: list[str] | None = None) -> int:
    """The command."""
    options = _options(arguments)
    files = trial_files()
    if not files:
        print(f"no BROAD trials in {data_folder()}; POISE_DATA says where they are", file=sys.stderr)
        return int(bool(os.environ.get("CI")))
    peers = _peers() if options.peers else {}
    runs = {name: run_method(method()) for name, method in METHODS.items()}
    scores = measure(files, runs | {name: run_peer(peer) for name, peer in peers.items()})
    own, foreign = ({name: scores[name] for name in group} for group in (METHODS, peers))
    facts = {name: {"version": installed(PEERS[name].package), "settings": PEERS[name].settings} for name in foreign}
    if options.json:
        print(json.dumps(document(scores, facts), indent=1, ensure_ascii=False))
    else:
        print(report(scores, options.markdown))
    if not options.write:
        return check(own)
    store("accuracy.json", document(own))
    if foreign:
        store("peers.json", document(foreign, facts))
    return 0


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--peers", action="store_true", help="other packages too (shown and stored, never compared)")
    parser.add_argument("--write", action="store_true", help="store the figures, compare nothing")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print JSON")
    form.add_argument("--markdown", action="store_true", help="print Markdown tables")
    return parser.parse_args(arguments)


def _peers() -> dict[str, Peer]:
    """The peers that are installed."""
    for package in sorted({peer.package for peer in PEERS.values() if not installed(peer.package)}):
        print(f"{package} is not installed and left out", file=sys.stderr)
    print("running peers too, some of which take minutes", file=sys.stderr)
    return {name: peer for name, peer in PEERS.items() if installed(peer.package)}


def _summary(name: str, trials: Mapping[str, Score]) -> list[Cell]:
    mean = means(trials)
    texts = [
        "/".join(f"{e:.3f}" for e in mean[half].values()) if half in mean else None
        for half in ("all", "chosen", "held-out")
    ]
    return [name, *texts, sum(s.diverged for s in trials.values())]


def _as_dicts(trials: Mapping[str, Score]) -> dict[str, dict[str, Any]]:
    return {trial: {key: _rounded(value) for key, value in s._asdict().items()} for trial, s in trials.items()}


def _rounded(value: Any) -> Any:
    """Floats to a millionth of a degree: what differs beyond is the machine."""
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    return round(value, 6) if isinstance(value, float) else value


def store(name: str, content: dict[str, Any]) -> None:
    """Write one file of results."""
    RESULTS.mkdir(exist_ok=True)
    path = RESULTS / name
    path.write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(f"stored {name}", file=sys.stderr)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except PoiseError as error:
        sys.exit(f"accuracy: {error}")
