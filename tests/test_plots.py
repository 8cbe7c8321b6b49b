"""Figures hold what they promise; files appear whole or not at all."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import poise
from poise import plots
from poise.comparison import compare
from poise.data.flags import LOST, MAG_MISSING, REST
from poise.errors import FormatError, PoiseError, RecordingError
from poise.math import arrays
from poise.plots.inline import inline_svg
from poise.plots.lines import spans
from poise.simulation import at_rest, forearm, measure


@pytest.fixture(scope="module")
def recording() -> poise.Recording:
    return measure(forearm(20.0), name="an arm")


@pytest.fixture(scope="module")
def attitude(recording: poise.Recording) -> poise.Attitude:
    return poise.estimate(poise.TwoStage(), recording)


def spinning(n: int, turns: float) -> poise.Attitude:
    """n rows that turn evenly about up, clockwise."""
    time = np.arange(n) / 100.0
    return poise.Attitude.of(time, arrays.turn_about_up(-2 * np.pi * turns * np.arange(n) / n))


def drawn(ax: Axes, label: str) -> np.ndarray:
    return next(np.asarray(line.get_ydata()) for line in ax.lines if line.get_label() == label)


def named(ax: Axes) -> list[str]:
    return [text.get_text() for text in ax.get_legend().get_texts()]


def shades(figure: Figure) -> list[str]:
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_with_a_reference(attitude: poise.Attitude, recording: poise.Recording) -> None:
    figure = plots.attitude_figure(attitude, recording)
    heading, angles, tilt, error = figure.axes
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["Heading (magnetic)", "Pitch and roll", "Tilt", "Error"]
    assert "magnetic north" in heading.get_ylabel() and error.get_xlabel() == "time [s]"
    assert set(named(heading)) == {"reference", "heading", "±3σ"}
    assert set(named(angles)) == {"reference", "pitch", "roll", "±3σ"}
    assert {name.partition(" (")[0] for name in named(error)} == {"total", "heading", "inclination", "3σ of the total"}
    np.testing.assert_allclose(drawn(tilt, "tilt"), np.degrees(attitude.tilt()), atol=1e-6)
    np.testing.assert_allclose(drawn(angles, "pitch"), attitude.euler(degrees=True)[:, 1], atol=1e-6)
    np.testing.assert_allclose(drawn(angles, "roll"), attitude.euler(degrees=True)[:, 2], atol=1e-6)
    np.testing.assert_allclose(drawn(heading, "heading") % 360, np.degrees(attitude.heading()), atol=1e-6)
    rmse = poise.evaluate(attitude, recording).rmse_deg()
    assert figure.get_suptitle() == "an arm"
    assert any(f"RMSE {rmse.total:.2f}°" in text.get_text() for text in figure.texts)


def test_without_a_reference(attitude: poise.Attitude, recording: poise.Recording) -> None:
    bare = replace(recording, truth=None)
    figure = plots.attitude_figure(attitude, bare, title="mine")
    assert figure.axes[3].get_title(loc="left") == "Gyroscope bias"
    assert {"x", "y", "z"} <= set(named(figure.axes[3]))
    assert "reference" not in named(figure.axes[0])
    assert figure.get_suptitle() == "mine"


def test_stretches_are_shaded_and_named(attitude: poise.Attitude) -> None:
    flags = np.zeros(len(attitude), np.uint32)
    flags[:400], flags[600:700], flags[900:950] = REST, LOST, MAG_MISSING
    figure = plots.attitude_figure(replace(attitude, flags=flags))
    assert shades(figure) == ["at rest", "not valid", "flagged: mag missing"]
    rest = figure.axes[2].collections[-3]
    spans = [(path.vertices[:, 0].min(), path.vertices[:, 0].max()) for path in rest.get_paths()]
    np.testing.assert_allclose(spans, [(attitude.time[0], attitude.time[400])], atol=1e-9)
    assert shades(plots.attitude_figure(replace(attitude, flags=np.zeros_like(flags)))) == []
    still = measure(at_rest(duration=5.0))
    assert "at rest" in shades(plots.attitude_figure(poise.estimate(poise.TwoStage(), still)))


def without_the_middle(recording: poise.Recording, long: float) -> poise.Recording:
    """The rows of the first and of the last third, with a silence of *long* seconds more between them."""
    n = len(recording)
    rows = np.r_[0 : n // 3, 2 * n // 3 : n]
    time = recording.time[rows] + long * (rows > n // 2)
    return poise.Recording(time, recording.gyr[rows], recording.acc[rows], recording.mag[rows], name="a gap")


def crosses(xs: np.ndarray, ys: np.ndarray, middle: float) -> bool:
    """Whether a line of these points goes over the time *middle*."""
    return bool((((xs[:-1] < middle) & (xs[1:] > middle)) & np.isfinite(ys[:-1]) & np.isfinite(ys[1:])).any())


@pytest.mark.parametrize("long", [0.0, 1e9])
def test_nothing_is_drawn_over_a_gap(recording: poise.Recording, long: float) -> None:
    gapped = without_the_middle(recording, long)
    middle = float(gapped.time[len(gapped) // 2 - 1 : len(gapped) // 2 + 1].mean())
    methods = {"a": poise.TwoStage(), "b": poise.Tilt()}
    attitude = poise.estimate(poise.TwoStage(), gapped)
    attitude = replace(attitude, flags=np.full(len(attitude), REST, np.uint32))
    figures = [
        plots.recording_figure(gapped, attitude),
        plots.attitude_figure(attitude, gapped),
        plots.comparison_figure(compare(gapped, methods)),
        plots.diagnosis_figure(poise.diagnose(gapped)),
    ]
    for figure in figures:
        for ax in figure.axes:
            if ax.get_title(loc="left").startswith(("Step", "Misfit")):
                continue
            for line in ax.lines:
                assert not crosses(np.asarray(line.get_xdata()), np.asarray(line.get_ydata()), middle), line.get_label()
            for area in ax.collections:  # bands, and what is shaded
                for path in area.get_paths():
                    x = path.vertices[:, 0]
                    assert not x.min() < middle < x.max(), area.get_label()


def test_states_in_turn_meet_and_end_at_gaps() -> None:
    time = np.r_[0.0:5.0:0.1, 20.0:25.0:0.1]
    first = time < 2.0
    (a,), b = spans(time, first), spans(time, ~first)
    assert a[0] == 0.0 and sum(a) == pytest.approx(b[0][0])  # no slit between them
    assert [round(sum(each), 6) for each in b] == [4.9, 24.9] and len(b) == 2


def test_a_spike_is_cut_off_and_told(recording: poise.Recording) -> None:
    acc, gyr = recording.acc.copy(), recording.gyr.copy()
    gyr[10, 0], acc[20, 1] = 1e6, 1e15
    _, ax, *_ = axes = plots.recording_figure(recording.with_samples(gyr=gyr, acc=acc)).axes
    assert "too large to be drawn" in ax.get_title(loc="left") and ax.get_ylim()[1] < 100.0
    assert "cut off: up to 5.73e+07" in axes[0].get_title(loc="left") and axes[0].get_ylim()[1] < 2e4
    huge = plots.recording_figure(recording.with_samples(acc=np.full_like(acc, 1e308)))
    assert "too large" in huge.axes[1].get_title(loc="left")
    huge.canvas.draw()


def test_a_method_without_a_heading_is_shown_by_its_inclination(recording: poise.Recording) -> None:
    estimate = poise.estimate(poise.Tilt(), recording)
    errors = poise.evaluate(estimate, recording)
    for figure in (plots.attitude_figure(estimate, recording), plots.recording_figure(recording, estimate)):
        told = [text.get_text() for text in figure.texts]
        assert any(f"RMSE of the inclination {errors.rmse_deg().inclination:.2f}°" in text for text in told)
        assert not any("heading" in text for text in told)
        error = figure.axes[-1]
        assert {"heading", "total"}.isdisjoint(named(error)) and "inclination" in named(error)


def test_a_long_recording_is_thinned_with_its_peaks() -> None:
    n = 300_000
    time = np.arange(n) / 100.0
    turn = 0.2 * np.sin(time / 50.0)
    turn[123_456] = 0.9
    attitude = poise.Attitude.of(time, np.column_stack([np.cos(turn), np.sin(turn), 0 * turn, 0 * turn]))
    figure = plots.attitude_figure(attitude)
    for ax in figure.axes:
        assert all(len(line.get_xdata()) <= plots.POINTS for line in ax.lines)
    tilt = drawn(figure.axes[2], "tilt")
    assert len(tilt) > 0.9 * plots.POINTS
    assert np.nanmax(tilt) == pytest.approx(np.degrees(1.8))


@pytest.mark.parametrize("n", [2000, 200_000])
def test_no_line_is_drawn_over_the_seam_of_the_heading(n: int) -> None:
    heading = drawn(plots.attitude_figure(spinning(n, 12.3)).axes[0], "heading")
    steps = np.diff(heading)
    assert np.nanmax(np.abs(steps)) < 20.0
    assert np.isnan(heading).sum() in (12, 13)
    assert np.nanmax(heading) - np.nanmin(heading) <= 360.0


def test_a_heading_around_north_has_no_seam() -> None:
    attitude = poise.Attitude.of(np.arange(500) / 100.0, arrays.turn_about_up(0.3 * np.sin(np.arange(500) / 50.0)))
    heading = drawn(plots.attitude_figure(attitude).axes[0], "heading")
    assert np.isfinite(heading).all() and np.ptp(heading) < 40.0


def test_steep_angles_are_pale() -> None:
    pitch = np.radians(np.linspace(0.0, 89.0, 500))
    quat = np.column_stack([np.cos(pitch / 2), np.sin(pitch / 2), 0 * pitch, 0 * pitch])
    angles = plots.attitude_figure(poise.Attitude.of(np.arange(500) / 100.0, quat)).axes[1]
    assert any("80°" in name for name in named(angles))
    steep = pitch > np.radians(80.0)
    np.testing.assert_array_equal(np.isnan(drawn(angles, "roll")), steep)
    assert np.isfinite(drawn(angles, "pitch")).all()


def test_epoch_stamps_are_shown_from_the_first(attitude: poise.Attitude) -> None:
    figure = plots.attitude_figure(replace(attitude, time=attitude.time + 1.7e9 + 0.5))
    assert figure.axes[3].get_xlabel() == "time [s] since 2023-11-14 22:13:20 UTC"
    assert figure.axes[3].get_xlim() == pytest.approx((0.0, attitude.time[-1] - attitude.time[0]), abs=1e-5)


def test_other_frames_are_shown_in_enu(attitude: poise.Attitude) -> None:
    a, b = plots.attitude_figure(attitude), plots.attitude_figure(attitude.to("ned"))
    np.testing.assert_allclose(drawn(b.axes[2], "tilt"), drawn(a.axes[2], "tilt"), atol=1e-9)
    with pytest.raises(RecordingError, match="frame"):
        plots.attitude_figure(attitude.relative_to(attitude))


@pytest.mark.parametrize("n", [0, 1])
def test_almost_nothing_can_be_drawn(n: int, tmp_path: Path) -> None:
    plots.save_figure(plots.attitude_figure(spinning(n, 0.0)), tmp_path / "a.png")
    unknown = poise.Attitude.of(np.full(n, np.nan), np.full((n, 4), np.nan))
    plots.save_figure(plots.attitude_figure(unknown), tmp_path / "b.png")


def test_rows_must_fit(attitude: poise.Attitude, recording: poise.Recording) -> None:
    with pytest.raises(RecordingError, match=r"recording has 100 rows, the attitude 2000"):
        plots.attitude_figure(attitude, recording[:100])
    with pytest.raises(RecordingError, match="table of errors"):
        plots.attitude_figure(attitude, errors=poise.evaluate(attitude[:5], recording[:5]))


@pytest.mark.parametrize(("name", "start"), [("a.png", b"\x89PNG"), ("a.SVG", b"<?xml"), ("a.pdf", b"%PDF")])
def test_files_are_written_whole(name: str, start: bytes, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_text("old")
    plots.save_figure(plots.attitude_figure(spinning(50, 0.1)), path)
    assert path.read_bytes().startswith(start)
    assert list(tmp_path.iterdir()) == [path]


def test_a_failure_leaves_the_old_file(tmp_path: Path) -> None:
    class Broken(Figure):
        def savefig(self, fname: Path, **_: object) -> None:
            Path(fname).write_text("half")
            raise OSError(28, "No space left on device")

    path = tmp_path / "a.png"
    path.write_text("old")
    with pytest.raises(FormatError, match="No space left"):
        plots.save_figure(Broken(), path)
    assert path.read_text() == "old" and list(tmp_path.iterdir()) == [path]


def test_paths_that_cannot_be_written(tmp_path: Path) -> None:
    figure = Figure()
    for name in ("a.bmp", "a"):
        with pytest.raises(FormatError, match=r"\.png, \.svg or \.pdf"):
            plots.save_figure(figure, tmp_path / name)
    with pytest.raises(FormatError, match="cannot write there"):
        plots.save_figure(figure, tmp_path / "nowhere" / "a.png")


def test_without_matplotlib(attitude: poise.Attitude, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(PoiseError, match=r'pip install "poise\[plots\]"'):
        plots.attitude_figure(attitude)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("share", [10, 1])
def test_samples_too_large_for_a_square_draw_without_a_warning(
    recording: poise.Recording, tmp_path: Path, share: int
) -> None:
    columns = {name: getattr(recording, name).copy() for name in ("gyr", "acc", "mag")}
    for values in columns.values():
        values[::share] = 1e300
    huge = replace(recording, truth=None, moving=None, **columns)
    comparison = poise.compare(huge, ["two-stage", "tilt"])
    assert isinstance(comparison.stretches(), tuple)
    for figure in (plots.recording_figure(huge), plots.comparison_figure(comparison)):
        plots.save_figure(figure, tmp_path / "a.png")


@pytest.mark.filterwarnings("error")
def test_stamps_that_are_all_equal_draw_without_a_warning(recording: poise.Recording, tmp_path: Path) -> None:
    few = recording[:40]
    plots.save_figure(plots.recording_figure(replace(few, time=np.full(len(few), 5.0))), tmp_path / "a.png")


@pytest.mark.filterwarnings("error")
def test_a_name_that_no_font_has_is_saved_without_a_warning(recording: poise.Recording, tmp_path: Path) -> None:
    plots.save_figure(plots.recording_figure(replace(recording, name="歩行")), tmp_path / "a.png")
    assert "歩行" in inline_svg(plots.recording_figure(replace(recording, name="歩行")), "a", "a walk")
