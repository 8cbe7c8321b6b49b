"""Comparisons as the tables that people read, on a terminal and in a report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from poise.comparison import Comparison, Run, Stretch

_NAN = float("nan")
_PARTS = ("total", "heading", "inclination")


class Table(NamedTuple):
    """A title, the names of the columns, and rows of texts and numbers; NaN is what does not exist."""

    title: str
    columns: tuple[str, ...]
    rows: list[list[Any]]


def estimators(comparison: Comparison) -> Table:
    """A row for every estimator: its errors, or its distances from the consensus, or why it has none."""
    limit = f"s beyond {comparison.limit_deg:g}°"
    if not comparison.done:
        return Table(
            "No estimator gave an attitude", ("estimator", "remark"), [[r.name, r.failure] for r in comparison.runs]
        )
    lines = {line["name"]: line for line in comparison.to_dict()["estimators"]}
    if comparison.against == "reference":
        columns = (
            "estimator", "total", "heading", "inclination", "p95", "max", "worst 5 s", "settled s", limit, "valid", "remark",
        )  # fmt: skip
        rows = [_with_reference(run, lines[run.name], comparison.zero) for run in comparison.runs]
        return Table("RMSE, 95th percentile, maximum and worst 5 s of the error, degrees", columns, rows)
    columns = (
        "estimator", "heading median", "p95", "max", "inclination median", "p95", "max", "worst 5 s", limit, "valid", "remark",
    )  # fmt: skip
    rows = [_without_reference(run, lines[run.name], comparison.zero) for run in comparison.runs]
    return Table("Distance from the consensus, degrees", columns, rows)


def means(comparisons: Sequence[Comparison]) -> list[dict[str, Any]]:
    """Mean RMS errors, and mean RMS distances from the consensus, over the recordings, degrees, a row each estimator.

    An estimator that failed on some of them has the mean over the others, and says over how many.
    """
    rows = []
    for against in ("reference", "consensus"):
        chosen = [c for c in comparisons if c.against == against]
        for name in dict.fromkeys(run.name for c in chosen for run in c.runs):
            figures = [run.figures() for c in chosen for run in c.runs if run.name == name]
            done = [f for f in figures if f]
            rms = {part: [f[part]["rmse"] for f in done if part in f] for part in _PARTS}
            mean = {part: sum(v) / len(v) if v else None for part, v in rms.items()}
            rows.append({"against": against, "name": name, "files": len(done), "of": len(chosen)} | mean)
    return rows


def mean_tables(comparisons: Sequence[Comparison]) -> list[Table]:
    """The means as tables, one for recordings with a reference and one for those without; none for a single recording."""
    tables = []
    for against, what in (("reference", "error"), ("consensus", "distance from the consensus")):
        rows = [row for row in means(comparisons) if row["against"] == against and row["of"] > 1]
        if any(row["files"] for row in rows):
            cells = [
                [r["name"], *(_NAN if r[part] is None else r[part] for part in _PARTS), f"{r['files']} of {r['of']}"]
                for r in rows
            ]
            title = f"Mean RMS {what} over {rows[0]['of']} recordings, degrees"
            tables.append(Table(title, ("estimator", *_PARTS, "recordings"), cells))
    return tables


def told(stretch: Stretch, comparison: Comparison) -> str:
    """A stretch as a sentence."""
    from_what = "the reference" if comparison.against == "reference" else "the consensus"
    near = ""
    if stretch.others > 1:
        near = f"; {stretch.others_within} of {stretch.others} others stay within {comparison.limit_deg:g}°"
        if comparison.against == "consensus" and not stretch.majority:
            near += ", no majority"
    why = "".join(f"; {text}" for text in (*stretch.reasons, *stretch.sensors))
    start, end = stretch.start - comparison.zero, stretch.end - comparison.zero
    return (
        f"{start:.1f}-{end:.1f} s: {stretch.estimator} is off {from_what} in {stretch.part}, "
        f"{stretch.median_deg:.1f}° (up to {stretch.peak_deg:.1f}°){near}{why}"
    )


def _with_reference(run: Run, line: dict[str, Any], zero: float) -> list[Any]:
    figures = run.figures()
    judged = figures.get("inclination" if run.heading == "none" else "total", {})
    return [
        run.name,
        *(figures.get(part, {}).get("rmse", _NAN) for part in _PARTS),
        judged.get("p95", _NAN),
        judged.get("max", _NAN),
        *_shared(run, line, zero, line["settled_s"]),
    ]


def _without_reference(run: Run, line: dict[str, Any], zero: float) -> list[Any]:
    figures = run.figures()
    spread = [figures.get(p, {}).get(k, _NAN) for p in ("heading", "inclination") for k in ("median", "p95", "max")]
    return [run.name, *spread, *_shared(run, line, zero)]


def _shared(run: Run, line: dict[str, Any], zero: float, *more: float | None) -> list[Any]:
    counts = run.errors is not None and bool(
        run.errors.counted.any()
    )  # figures of rows that do not count would mislead
    worst = line["worst_5s"] if counts else None
    return [
        f"{worst['mean_deg']:.1f} at {round(worst['start'] - zero)} s" if worst else "-",
        *(value if counts and value is not None else _NAN for value in more),
        line["seconds_away"] if counts else _NAN,
        "-" if line["valid"] is None else f"{line['valid']:.1%}",
        _remark(run),
    ]


def _remark(run: Run) -> str:
    words = [run.failure] if run.failure else []
    words += ["inclination only"] if run.heading == "none" and not run.failure else []
    words += ["heading aligned"] if run.heading == "aligned" else []
    words += ["diverged"] if run.diverged else []
    missing = run.errors.missing if run.errors is not None else 0
    words += [f"{missing} rows without attitude"] if missing else []
    return ", ".join(words)
