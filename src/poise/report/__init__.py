"""Comparisons as one HTML file that needs nothing beside it: no network, no script, light or dark as the reader likes."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from datetime import UTC, datetime
from html import escape
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from poise.comparison import Comparison, Run
from poise.comparison.tables import Table, estimators, mean_tables
from poise.errors import RecordingError
from poise.plots import attitude_figure, comparison_figure, inline_svg, recording_figure
from poise.plots.comparison import LEVELS
from poise.version import __version__

_TOLD = 25  # stretches of a recording; a report is read by people
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'"
_LIBRARIES = ("numpy", "numba", "scipy", "vqf", "imufusion", "ahrs")


def report(
    comparisons: Sequence[Comparison],
    *,
    title: str = "Attitude estimators compared",
    command: str = "",
    refused: Sequence[tuple[str, str]] = (),
    progress: Callable[[str, float], None] | None = None,
) -> str:
    """The page as text.

    *command* is what makes it again, *refused* are files that could not be read, with the reason. *progress* is called
    with the name of the recording that is drawn and the share done. Raises :class:`RecordingError` without a comparison.
    """
    if not comparisons:
        raise RecordingError("a report needs at least one comparison")
    parts = [f"<h1>{_text(title)}</h1>", f'<p class="quiet">poise {_text(__version__)}, {_now()}</p>']
    parts += [_contents(comparisons)] if len(comparisons) > 1 else []
    parts += [_table(table) for table in mean_tables(comparisons)]
    if refused:
        parts.append(_notes([f"{name}: {reason}" for name, reason in refused], "Not compared"))
    for i, comparison in enumerate(comparisons):
        if progress:
            progress(comparison.recording.name, i / len(comparisons))
        parts.append(_section(comparison, i))
    parts += [_settings(comparisons), _reproduce(command)]
    return page(title, parts)


def page(title: str, parts: Sequence[str]) -> str:
    """A whole page of *parts*, which are HTML already; *title* is plain text."""
    style = files("poise.report").joinpath("style.css").read_text(encoding="utf-8")
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{_text(title)}</title>\n<style>\n{style}</style>\n</head>\n<body>\n"
        + "\n".join(parts)
        + "\n</body>\n</html>\n"
    )


def write_report(path: str | Path, comparisons: Sequence[Comparison], **facts: Any) -> None:
    """Write :func:`report` to *path*: the whole file or nothing. Raises :class:`FormatError` where it cannot be written."""
    from poise.formats.saving import replacing

    with replacing(Path(path)) as file:  # where it cannot be written, that is said before anything is drawn
        file.write(report(comparisons, **facts).encode("utf-8", errors="replace"))


# -- a recording --------------------------------------------------------------------------------------------------


def _section(comparison: Comparison, i: int) -> str:
    recording, best = comparison.recording, comparison.best
    name = recording.name or "recording"
    table = estimators(comparison)
    parts = [f'<h2 id="r{i}">{_text(name)}</h2>', _facts(comparison), f"<h3>{_text(table.title)}</h3>"]
    parts += [_table(table._replace(title=""), {run.name for run in comparison.runs if run.failure})]
    parts += [_notes(comparison.notes)] if comparison.notes else []
    if comparison.done:
        parts.append(
            _figure(lambda n: comparison_figure(comparison, narrow=n), f"{i}-strips", "Who is how far off, and when")
        )
        parts += [_stretches(comparison), _matrices(comparison)]
    parts.append(_figure(lambda n: recording_figure(recording, narrow=n), f"{i}-sensors", "What the sensors measured"))
    if best is not None and best.attitude is not None:
        attitude, against = best.attitude, comparison.against == "reference" and best.heading != "none"
        caption = f"The attitude of {best.name}" + (", with the reference" if recording.truth is not None else "")
        errors = best.errors if against else None
        parts.append(
            _figure(lambda n: attitude_figure(attitude, recording, errors, narrow=n), f"{i}-attitude", caption)
        )
    return "\n".join(parts)


def _facts(comparison: Comparison) -> str:
    recording = comparison.recording
    told = comparison.to_dict()["recording"]
    rows = [
        ("file", told["source"] or "-"),
        ("SHA-256", told["sha256"] or "-"),
        ("length", f"{recording.duration:.1f} s, {len(recording)} rows at {recording.rate_hz:.2f} Hz"),
        ("sensors", "; ".join(_sensor(comparison, sensor) for sensor in told["sensors"]) or "none"),
        ("reference", _reference(comparison)),
        *(("note", note) for note in recording.notes),
    ]
    return "<dl>" + "".join(f"<dt>{_text(k)}</dt><dd>{_text(v)}</dd>" for k, v in rows) + "</dl>"


def _sensor(comparison: Comparison, sensor: str) -> str:
    names = {"gyr": "gyroscope", "acc": "accelerometer", "mag": "magnetometer"}
    share = float(np.mean(np.isfinite(getattr(comparison.recording, sensor)).all(axis=1)))
    return names[sensor] + ("" if share == 1.0 else f" (a sample in {share:.1%} of the rows)")


def _reference(comparison: Comparison) -> str:
    truth = comparison.recording.truth
    if truth is None and not comparison.done:
        return "none"
    if comparison.against == "consensus" or truth is None:
        return "none; the estimators' consensus takes its place"
    known = float(np.mean(np.isfinite(truth.quat).all(axis=1)))
    moving = comparison.recording.moving
    counted = "" if moving is None else f"; errors count in the {np.mean(moving):.1%} of the rows that move"
    return f"in the file, known in {known:.1%} of the rows{counted}"


def _stretches(comparison: Comparison) -> str:
    found = comparison.stretches()
    against, limit = comparison.against, f"{comparison.limit_deg:g}°"
    head = f"<h3>Stretches further than {limit} from the {against}</h3>"
    if not found:
        return f"{head}<p>None: every estimator stays within {limit} of the {against}, but for less than 0.5 s.</p>"
    rows = []
    for s in found[:_TOLD]:
        others = f"{s.others_within} of {s.others}"
        others += ", no majority" if against == "consensus" and s.others > 1 and not s.majority else ""
        why = "; ".join((*s.reasons, *s.sensors)) or "no flag and nothing unusual in the samples"
        cells = [
            f"{s.start - comparison.zero:.1f} – {s.end - comparison.zero:.1f} s",
            f"{s.median_deg:.1f}°",
            f"{s.peak_deg:.1f}°",
            s.part,
            others,
            why,
        ]
        kinds = ("time", "number", "number", "", "", "text")
        rows.append(
            f"<tr><th>{_text(s.estimator)}</th>"
            + "".join(f'<td class="{k}">{_text(c)}</td>' for k, c in zip(kinds, cells, strict=True))
            + "</tr>"
        )
    names = ("who", "when", "median", "peak", "in", f"others within {limit}", "what explains it")
    numbers = ("median", "peak")
    header = "".join(f'<th class="number">{n}</th>' if n in numbers else f"<th>{_text(n)}</th>" for n in names)
    rest = f'<p class="quiet">and {len(found) - _TOLD} lesser ones.</p>' if len(found) > _TOLD else ""
    return f"{head}{_grid(header, ''.join(rows))}{rest}"


def _matrices(comparison: Comparison) -> str:
    pairs = comparison.pairs
    if len(pairs.names) < 2:
        return ""
    blocks = []
    for part in ("heading", "inclination"):
        matrix = getattr(pairs, part)
        keep = [i for i in range(len(pairs.names)) if np.isfinite(matrix[i, i])]
        if len(keep) < 2:
            continue
        top = "".join(f"<th>{_text(pairs.names[j])}</th>" for j in keep)
        body = "".join(
            f"<tr><th>{_text(pairs.names[i])}</th>"
            + "".join("<td></td>" if i == j else _shaded(float(matrix[i, j])) for j in keep)
            + "</tr>"
            for i in keep
        )
        table = f'<table class="matrix"><thead><tr><th></th>{top}</tr></thead><tbody>{body}</tbody></table>'
        blocks.append(f'<div><p class="quiet">{part}</p><div class="scroll">{table}</div></div>')
    return f'<h3>Distance of every two from each other, RMS, degrees</h3><div class="matrices">{"".join(blocks)}</div>'


def _shaded(degrees: float) -> str:
    if not isfinite(degrees):
        return "<td>-</td>"
    return f'<td class="number l{int(np.searchsorted(LEVELS, degrees, side="right"))}">{degrees:.1f}</td>'


def _figure(draw: Callable[[bool], Any], key: str, caption: str) -> str:
    """A picture in two shapes, of which the page shows the one that fits."""
    shapes = "".join(
        f'<div class="{css}">{inline_svg(draw(narrow), f"{key}-{css}", caption)}</div>'
        for css, narrow in (("desk", False), ("phone", True))
    )
    return f"<h3>{_text(caption)}</h3><figure>{shapes}</figure>"


# -- around them ----------------------------------------------------------------------------------------------------


def _contents(comparisons: Sequence[Comparison]) -> str:
    items = "".join(
        f'<li><a href="#r{i}">{_text(c.recording.name or "recording")}</a></li>' for i, c in enumerate(comparisons)
    )
    return f"<ul>{items}</ul>"


def _settings(comparisons: Sequence[Comparison]) -> str:
    runs: dict[str, Run] = {run.name: run for comparison in comparisons for run in comparison.runs}
    blocks = []
    for run in runs.values():
        settings = {k: v for k, v in run.settings.items() if k != "prepared"}
        rows = "".join(f"<dt>{_text(k)}</dt><dd>{_text(_value(v))}</dd>" for k, v in settings.items())
        done = {
            note: c.recording.name
            for c in comparisons
            for one in c.runs
            if one.name == run.name
            for note in one.settings.get("prepared", ())
        }
        rows += "".join(f"<dt>done first to {_text(name)}</dt><dd>{_text(note)}</dd>" for note, name in done.items())
        blocks.append(f"<details><summary>{_text(run.name)}</summary><dl>{rows}</dl></details>")
    return (
        '<h2 id="settings">Settings of every estimator</h2><p class="quiet">Angles are in radians, as in the Python API; '
        "<code>poise methods NAME</code> says what each parameter means.</p>" + "".join(blocks)
    )


def _reproduce(command: str) -> str:
    versions = [f"{name} {found}" for name in _LIBRARIES if (found := _version(name))]
    told = f"<pre><code>{_text(command)}</code></pre>" if command else ""
    return (
        f'<h2 id="again">How to make this again</h2>{told}<p class="quiet">poise {_text(__version__)}; '
        f"{_text(', '.join(versions))}.</p>"
    )


def _table(table: Table, failed: Collection[str] = ()) -> str:
    numeric = [any(isinstance(row[i], float) for row in table.rows) for i in range(len(table.columns))]
    header = "".join(
        f'<th class="number">{_text(name)}</th>' if number else f"<th>{_text(name)}</th>"
        for name, number in zip(table.columns, numeric, strict=True)
    )
    rows = []
    for name, *cells in table.rows:
        told = "".join(f'<td class="{_kind(cell)}">{_text(_cell(cell))}</td>' for cell in cells)
        rows.append(f"<tr{' class=failed' if name in failed else ''}><th>{_text(name)}</th>{told}</tr>")
    return (f"<h3>{_text(table.title)}</h3>" if table.title else "") + _grid(header, "".join(rows))


def _grid(header: str, rows: str) -> str:
    return f'<div class="scroll"><table><thead><tr>{header}</tr></thead><tbody>{rows}</tbody></table></div>'


def _cell(cell: Any) -> str:
    return ("-" if not isfinite(cell) else f"{cell:.2f}") if isinstance(cell, float) else str(cell)


def _kind(cell: Any) -> str:
    return "number" if isinstance(cell, float) else "text" if len(str(cell)) > 30 else "time"


def _notes(notes: Sequence[str], title: str = "") -> str:
    head = f"<h3>{_text(title)}</h3>" if title else ""
    return f'{head}<ul class="notes quiet">{"".join(f"<li>{_text(note)}</li>" for note in notes)}</ul>'


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{k} {_value(v)}" for k, v in value.items())
    if isinstance(value, (list, tuple)):
        return ", ".join(map(_value, value))
    if isinstance(value, float):
        return "-" if not isfinite(value) else f"{value:.2f}" if abs(value) >= 1.0 else f"{value:.3g}"
    return str(value)


def _text(value: object) -> str:
    """Any text as it may stand in a page: without markup, and without characters that HTML has no place for."""
    return escape("".join(c if c.isprintable() else " " for c in str(value)), quote=True)


def _now() -> str:
    return f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC"


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""
