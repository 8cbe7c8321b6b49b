"""Diagnoses as one HTML file: the verdict of each recording, the findings, and the plots behind them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from poise.doctor import Diagnosis
from poise.doctor.findings import options
from poise.plots import diagnosis_figure, recording_figure
from poise.report import _figure, _grid, _now, _text, page
from poise.version import __version__


def sheet(diagnoses: Sequence[tuple[Diagnosis, str]], title: str = "What the doctor found") -> str:
    """The page as text; each diagnosis comes with the command that repairs its recording, or without one."""
    parts = [f"<h1>{_text(title)}</h1>", f'<p class="quiet">poise {_text(__version__)}, {_now()}</p>']
    for i, (diagnosis, command) in enumerate(diagnoses):
        parts.append(_section(diagnosis, command, i))
    return page(title, parts)


def write_sheet(path: str | Path, diagnoses: Sequence[tuple[Diagnosis, str]]) -> None:
    """Write :func:`sheet` to *path*: the whole file or nothing. Raises :class:`FormatError` where it cannot be written."""
    from poise.formats.saving import replacing

    text = sheet(diagnoses).encode("utf-8", errors="replace")
    with replacing(Path(path)) as file:
        file.write(text)


def _section(diagnosis: Diagnosis, command: str, i: int) -> str:
    recording = diagnosis.recording
    parts = [f'<h2 id="r{i}">{_text(recording.name or "recording")}</h2>', f"<p><b>{_text(diagnosis.verdict)}</b></p>"]
    if command:
        parts.append(f"<p>Repaired:</p><pre><code>{_text(command)}</code></pre>")
    rows = []
    for f in diagnosis.findings:
        option = " or ".join(options(each, diagnosis.read_as) for each in f.choices or (f.fix,))
        cells = (("time", f.name), ("text", f.sentence), ("option", option))
        rows.append(
            f"<tr><th>{_text(f.severity)}</th>"
            + "".join(f'<td class="{k}">{_text(c)}</td>' for k, c in cells)
            + "</tr>"
        )
    header = "".join(f"<th>{name}</th>" for name in ("how sure", "what", "figures", "option"))
    parts.append(f'<div class="findings">{_grid(header, "".join(rows))}</div>')
    if len(recording) > 1:
        caption = "What the verdicts rest on"
        parts.append(_figure(lambda n: diagnosis_figure(diagnosis, narrow=n), f"d{i}-evidence", caption))
        caption = "What the sensors measured, repaired" if diagnosis.repairs else "What the sensors measured"
        fixed = diagnosis.repair(recording)
        parts.append(_figure(lambda n: recording_figure(fixed, narrow=n), f"d{i}-sensors", caption))
    return "\n".join(parts)
