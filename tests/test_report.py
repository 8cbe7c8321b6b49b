"""The report: one file that loads nothing, and that no file name can break."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

import poise
from poise import plots
from poise.comparison import Comparison
from poise.errors import FormatError, RecordingError
from poise.plots.inline import NAMES, inline_svg
from poise.report import report, write_report
from poise.simulation import forearm, measure

HOSTILE = "<script>alert(1)</script>\"'&<img src=x onerror=alert(2)>$x_$\x00.csv"
VOID = {"meta", "img", "br", "hr", "link", "input"}


class Page(HTMLParser):
    """Tags, references and balance of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.references: list[str] = []
        self.handlers: list[str] = []
        self.open: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.references += [value or "" for name, value in attrs if name in ("href", "src", "srcset", "action", "data")]
        self.handlers += [name for name, _ in attrs if name.startswith("on")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def comparison() -> Comparison:
    recording = measure(forearm(12.0), seed=2, name="an arm")
    return poise.compare(recording, ["two-stage", "tilt"], limit_deg=0.5)


@pytest.fixture(scope="module")
def hostile(comparison: Comparison) -> Comparison:
    recording = replace(comparison.recording, name=HOSTILE, source=HOSTILE, notes=(HOSTILE,), truth=None, moving=None)
    methods = {HOSTILE: poise.TwoStage(), "tilt": poise.Tilt()}
    return poise.compare(recording, methods, limit_deg=0.5)


@pytest.fixture(scope="module")
def text(comparison: Comparison) -> str:
    return report([comparison], command="poise compare arm.csv --report arm.html")


def test_nothing_is_loaded_from_anywhere(text: str) -> None:
    page = Page(text)
    assert page.open == []
    assert all(reference.startswith(("#", "data:image/png")) for reference in page.references)
    assert not re.search(r"https?:|//[a-z]|@import|url\((?!#)", text)
    assert not {"script", "link", "iframe", "object", "embed", "base", "form"} & set(page.tags)
    assert "default-src 'none'" in text and "script-src" not in text
    assert "poise compare arm.csv --report arm.html" in text


def test_the_report_holds_what_was_compared(comparison: Comparison, text: str) -> None:
    rmse = comparison.runs[0].figures()["total"]["rmse"]
    for words in ("an arm", f"{rmse:.2f}", "12.0 s", "Settings of every estimator", "mag_noise", "inclination only"):
        assert words in text
    for stretch in comparison.stretches():
        assert f"{stretch.start:.1f} – {stretch.end:.1f} s" in text
    assert text.count("<svg") == 6  # three pictures, each for a desk and for a phone


def test_pictures_follow_the_page_s_colours(text: str) -> None:
    style, drawn = text.split("</style>", 1)
    light, dark = style.split("prefers-color-scheme: dark", 1)
    for name in NAMES.values():
        assert f"--{name}:" in light and f"--{name}:" in dark
    for used in set(re.findall(r"var\(--([a-z0-9-]+)\)", drawn)):
        assert f"--{used}:" in light
    assert not re.search(r"(?:fill|stroke): #(?!000000)[0-9a-f]{6}", drawn), "a colour that dark mode cannot change"


@pytest.fixture(scope="module")
def twice(hostile: Comparison) -> str:
    return report([hostile, hostile], title=HOSTILE, command=HOSTILE, refused=[(HOSTILE, HOSTILE)])


def test_identifiers_are_unique_and_referred_to(twice: str) -> None:
    ids = re.findall(r' id="([^"]+)"', twice)
    assert len(ids) == len(set(ids))
    assert set(re.findall(r'href="#([^"]+)"|url\(#([^)]+)\)', twice)) <= {(i, "") for i in ids} | {("", i) for i in ids}


def test_hostile_text_stays_text(hostile: Comparison, twice: str, tmp_path: Path) -> None:
    page = Page(twice)
    assert page.open == [] and page.handlers == []
    assert not {"script", "img"} & set(page.tags)
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in twice and "\x00" not in twice
    for draw in (plots.comparison_figure(hostile), plots.recording_figure(hostile.recording)):
        plots.save_figure(draw, tmp_path / "a.png")


def test_a_report_without_anything_that_worked() -> None:
    empty = poise.Recording.at_rate(100.0, np.full((50, 3), np.nan), np.full((50, 3), np.nan), name="nothing")
    text = report([poise.compare(empty, ["two-stage"])])
    assert Page(text).open == [] and "no row has an attitude" in text
    with pytest.raises(RecordingError):
        report([])


def test_files_appear_whole(comparison: Comparison, tmp_path: Path) -> None:
    write_report(tmp_path / "a.html", [comparison])
    assert (tmp_path / "a.html").read_text(encoding="utf-8").endswith("</html>\n")
    assert [path.name for path in tmp_path.iterdir()] == ["a.html"]
    with pytest.raises(FormatError, match="cannot be written"):
        write_report(tmp_path / "nowhere" / "a.html", [comparison])


def test_the_picture_shows_every_estimator_with_its_figure(comparison: Comparison) -> None:
    figure = plots.comparison_figure(comparison)
    heading, inclination = figure.axes[2:4]
    assert [t.get_text() for t in heading.get_yticklabels()] == ["two-stage"]
    assert [t.get_text() for t in inclination.get_yticklabels()] == ["two-stage", "tilt"]
    assert "reference" in heading.get_title(loc="left")
    drawn = inline_svg(figure, "key", 'a "picture"')
    assert drawn.startswith('<svg role="img" aria-label="a &quot;picture&quot;" viewBox=')


def test_sensors_with_gaps_and_uneven_stamps_are_drawn(comparison: Comparison) -> None:
    recording = comparison.recording
    time = recording.time.copy()
    time[600:] += 3.0
    mag = recording.mag.copy()
    mag[np.arange(len(mag)) % 5 != 0] = np.nan
    figure = plots.recording_figure(replace(recording, time=time, mag=mag, truth=None))
    titles = [ax.get_title(loc="left") for ax in figure.axes]
    assert titles == ["Gyroscope", "Accelerometer", "Magnetometer (a sample in 20% of the rows)", "Step between stamps"]
    line = next(line for line in figure.axes[2].lines if line.get_label() == "x")
    assert np.isnan(line.get_ydata()).sum() == 1  # one gap, over which no line is drawn
