"""How accurate poise's methods are on the BROAD trials, compared with the table that is stored.

    python benchmarks/accuracy.py [--peers] [--write] [--json | --markdown] [--figure FILE] [--jobs N]

Every method with its defaults, nothing aligned or tuned per trial; RMSE in degrees over the rows that count, by trial and by
the benchmark's groups of trials. A method whose heading no sensor gives is judged by its inclination. Ends with 1 where a
trial is more than 1 %, or a mean more than 0.5 %, worse than stored; a peer is compared where its release is the stored one,
so that a worse one means a worse adapter. POISE_DATA says where the recordings are.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Collection, Iterable, Mapping
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import scores as scoring
from accuracy_figure import draw
from poise import METHODS, Attitude, PoiseError, Recording, SelfCalibrating, estimate, read, smooth
from poise.peers import PEERS, Peer, installed
from scores import ERRORS, Score, Scores, compare, document, facts_of, groups, halves, judged_by, load, means, score
from tables import Cell, heading, table


class Offline(NamedTuple):
    """`smooth`, as a contender."""

    declination: float = 0.0

    def attitude(self, recording: Recording) -> Attitude:
        return smooth(recording, SelfCalibrating(declination=self.declination))


def own() -> dict[str, Any]:
    """poise's methods with their defaults, the flagship offline too."""
    methods = {name: method() for name, method in METHODS.items()}
    return {"self-calibrating": methods.pop("self-calibrating"), "self-calibrating-offline": Offline()} | methods


def data_folder() -> Path:
    """Where the trials are: below POISE_DATA, or below ../shared/data beside the checkout."""
    root = os.environ.get("POISE_DATA") or Path(__file__).parents[2] / "shared" / "data"
    return Path(root) / "broad"


def trial_files() -> list[Path]:
    """The trials' files in order; empty where the recordings are absent."""
    return sorted(data_folder().glob("[0-9][0-9]_*.mat"))


def run(contender: Any, recording: Recording) -> Attitude:
    """The attitude that a method of poise, or another package's filter, makes."""
    return contender.attitude(recording) if isinstance(contender, Peer | Offline) else estimate(contender, recording)


def has_heading(contender: Any) -> bool:
    """Whether a magnetometer gives the heading, so that it can be judged."""
    return contender.has_heading if isinstance(contender, Peer) else hasattr(contender, "declination")


def measure(files: Iterable[Path], contenders: Mapping[str, Any], jobs: int = 1) -> Scores:
    """The scores of all contenders on the trials in *files*, of which *jobs* run at a time."""
    paths = list(files)
    if jobs == 1:
        rows = [_trial(path, contenders) for path in paths]
    else:
        warm(contenders)
        with ProcessPoolExecutor(jobs) as pool:
            rows = list(pool.map(_trial, paths, [dict(contenders)] * len(paths)))
    return {name: {path.stem: row[name] for path, row in zip(paths, rows, strict=True)} for name in contenders}


def _trial(path: Path, contenders: Mapping[str, Any]) -> dict[str, Score]:
    recording = read(path)
    return {name: score(run(c, recording), recording, has_heading(c)) for name, c in contenders.items()}


def warm(contenders: Mapping[str, Any]) -> None:
    """Compile the methods once, before several processes would do so at the same time."""
    still = Recording.at_rate(100.0, np.zeros((2, 3)), np.tile([0.0, 0.0, 9.81], (2, 1)))
    for contender in contenders.values():
        if not isinstance(contender, Peer):
            run(contender, still)


def report(scores: Scores, markdown: bool) -> str:
    """The means of all, by halves and by groups, then each one's trials."""
    columns = ["/".join(ERRORS), "all", "chosen half", "held-out half", "diverged"]
    parts = [heading("Mean RMSE over the trials, degrees", markdown=markdown)]
    parts.append(table(columns, [_summary(name, trials) for name, trials in scores.items()], markdown=markdown))
    sizes = {group: len(members) for group, members in groups(_trials(scores)).items()}
    columns = ["trials", *(f"{group} ({size})" for group, size in sizes.items())]
    for kind in ERRORS:
        parts.append(heading(f"By group of trials: mean RMSE of the {kind} error, degrees", markdown=markdown))
        judged = {name: trials for name, trials in scores.items() if judged_by(trials, kind)}
        by_group = [_by_group(name, trials, kind, sizes) for name, trials in judged.items()]
        parts.append(table(columns, by_group, markdown=markdown))
    for name, trials in scores.items():
        parts.append(heading(f"{name}: RMSE, degrees", markdown=markdown))
        rows: list[list[Cell]] = [
            [trial, *s[:3], "yes" if s.diverged else "no", s.missing or None] for trial, s in trials.items()
        ]
        rows += [[f"mean, {half}", *mean.values(), None, None] for half, mean in means(trials, halves(trials)).items()]
        parts.append(table(["trial", *Score._fields], rows, markdown=markdown))
    return "\n".join(parts)


def _summary(name: str, trials: Mapping[str, Score]) -> list[Cell]:
    mean = means(trials, halves(trials))
    texts = [
        "/".join("-" if e is None else f"{e:.3f}" for e in mean[half].values()) if half in mean else None
        for half in ("all", "chosen", "held-out")
    ]
    return [name, *texts, sum(s.diverged for s in trials.values())]


def _by_group(name: str, trials: Mapping[str, Score], kind: str, columns: Iterable[str]) -> list[Cell]:
    mean = means(trials, groups(trials))
    return [name, *(mean[group][kind] if group in mean else None for group in columns)]


def _trials(scores: Scores) -> list[str]:
    return list(dict.fromkeys(trial for trials in scores.values() for trial in trials))


def check(own: Scores, foreign: Scores | None = None) -> int:
    """Say how poise's scores, and those of the peers that ran, stand against the stored tables; the exit code."""
    codes = [_check("accuracy.json", own)]
    if foreign:
        path = scoring.RESULTS / "peers.json"
        other = _other_releases(path) if path.exists() else {}
        for sentence in other.values():
            print(sentence, file=sys.stderr)
        same = {name: trials for name, trials in foreign.items() if name not in other}
        codes.append(_check("peers.json", same, left_out=PEERS.keys() - same.keys()))
    if not any(codes):
        print("\nno trial is more than 1 %, and no mean more than 0.5 %, worse than stored", file=sys.stderr)
    return max(codes)


def _check(name: str, scores: Scores, left_out: Collection[str] = ()) -> int:
    path = scoring.RESULTS / name
    if not path.exists():
        print(f"\nno stored table to compare with; --write makes {name}", file=sys.stderr)
        return int(bool(os.environ.get("CI")))
    stored = load(path)
    worse = compare({method: trials for method, trials in stored.items() if method not in left_out}, scores)
    for sentence in worse:
        print(f"WORSE {sentence}", file=sys.stderr)
    for method in (method for method in scores if method not in stored):
        print(f"{method} is not in the stored table: not compared", file=sys.stderr)
    return int(bool(worse))


def _other_releases(path: Path) -> dict[str, str]:
    """Why a peer's figures are not compared, where another release of its package was measured when they were stored."""
    stored = {name: entry.get("version") for name, entry in facts_of(path).items() if name in PEERS}
    now = {name: installed(PEERS[name].package) for name in stored}
    return {
        name: f"{name}: stored with release {then}, measured with {now[name]}: not compared"
        for name, then in stored.items()
        if now[name] not in (None, then)
    }


def main(arguments: list[str] | None = None) -> int:
    """The command."""
    options = _options(arguments)
    files = trial_files()
    if not files:
        print(f"no BROAD trials in {data_folder()}; POISE_DATA says where they are", file=sys.stderr)
        return int(bool(os.environ.get("CI")))
    peers = _peers() if options.peers else {}
    methods = own()
    scores = measure(files, methods | peers, options.jobs)
    ours, foreign = ({name: scores[name] for name in group} for group in (methods, peers))
    facts = {name: {"version": installed(PEERS[name].package), "settings": PEERS[name].settings} for name in foreign}
    if options.json:
        print(json.dumps(document(scores, facts), indent=1, ensure_ascii=False))
    else:
        print(report(scores, options.markdown))
    if options.figure:
        draw(scores, options.figure)
    if not options.write:
        return check(ours, foreign)
    store("accuracy.json", document(ours))
    if foreign:
        store("peers.json", document(foreign, facts))
    return 0


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("--peers", action="store_true", help="other packages too")
    parser.add_argument("--write", action="store_true", help="store the figures, compare nothing")
    parser.add_argument("--figure", type=Path, help="draw the errors by trial and group (.png, .svg, .pdf)")
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count() or 1), help="trials at a time (default 2)")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print JSON")
    form.add_argument("--markdown", action="store_true", help="print Markdown tables")
    options = parser.parse_args(arguments)
    if options.jobs < 1:
        parser.error(f"--jobs {options.jobs}: expected 1 or more")
    return options


def _peers() -> dict[str, Peer]:
    """The peers that are installed."""
    for package in sorted({peer.package for peer in PEERS.values() if not installed(peer.package)}):
        print(f"{package} is not installed and left out", file=sys.stderr)
    print("running peers too, some of which take minutes", file=sys.stderr)
    return {name: peer for name, peer in PEERS.items() if installed(peer.package)}


def store(name: str, content: dict[str, Any]) -> None:
    """Write one file of results."""
    scoring.RESULTS.mkdir(exist_ok=True)
    path = scoring.RESULTS / name
    path.write_text(json.dumps(content, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(f"stored {name}", file=sys.stderr)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except PoiseError as error:
        sys.exit(f"accuracy: {error}")
