"""What was learned of the sensors: kept in files, over time, and as the start of the next recording."""

from __future__ import annotations

import json
import os
import pickle
import re
import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet
import pytest
from numpy.typing import NDArray

import poise
from data_files import data_path
from poise.cli import run
from poise.data.packet import Packet
from poise.errors import FormatError, MethodError, RecordingError
from poise.estimators.self_calibrating.learned import GROWTH
from poise.estimators.self_calibrating.model import BIAS, IRON, MAG_DELAY, SCALE, SENSOR
from poise.simulation import PERFECT, Sensor, Triad, forearm, measure

Floats = NDArray[np.float64]
FLAGSHIP = poise.SelfCalibrating()
A = np.array([[0.008, 0.003, -0.004], [0.002, -0.009, 0.003], [-0.003, 0.004, 0.007]])
BIASED = (0.030, -0.025, 0.020)  # rad/s
WHITE = replace(
    PERFECT, gyr=Triad(noise=1e-4, bias=BIASED), acc=Triad(noise=0.002), mag=Triad(noise=0.05), mag_delay=0.02
)


@cache
def made(seed: int = 4, duration: float = 120.0, iron: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> poise.Recording:
    """One sensor, with a bias, scale and misalignment and a late magnetometer, in motion of its own for each seed."""
    clean = measure(forearm(duration, 100.0, seed), replace(WHITE, mag=Triad(noise=0.05, bias=iron)), seed=seed)
    return replace(clean, gyr=(clean.gyr - BIASED) @ np.linalg.inv(np.eye(3) + A).T + BIASED)


@cache
def day1() -> poise.Attitude:
    return poise.estimate(FLAGSHIP, made(4), learning=1.0)


def known() -> poise.Learned:
    learned = day1().learned
    assert learned is not None
    return learned


def changed(**quantities: Any) -> poise.Learned:
    """The same with other values."""
    found = {name: {**quantity, "value": quantities.get(name, quantity["value"])} for name, quantity in known().items()}
    return replace(known(), quantities=found)


def P_of(stream: poise.Stream) -> Floats:
    state = stream.running_state
    while hasattr(state, "inner"):
        state = state.inner
    found: Floats = state.P
    return found


# -- over time ----------------------------------------------------------------------------------------------------------


def test_over_time_is_what_a_stream_says_at_those_times() -> None:
    learning = day1().learning
    assert learning is not None
    r, stream = made(4), poise.Stream(FLAGSHIP)
    first = 0
    for row in (0, 1, 7, 60):
        last = int(np.searchsorted(r.time, learning.time[row])) + 1
        stream.update(Packet(r.time[first:last], r.gyr[first:last], r.acc[first:last], r.mag[first:last]))
        first = last
        assert stream.learned is not None
        names, values, sigma = stream.learned.numbers()
        columns = [learning.names.index(name) for name in names]
        np.testing.assert_array_equal(learning.values[row, columns], values)
        np.testing.assert_array_equal(learning.sigma[row, columns], sigma)
    names, values, _ = known().numbers()
    np.testing.assert_array_equal(learning.values[-1], values)
    assert list(learning.names) == names


def test_over_time_has_a_row_at_every_interval_and_at_the_end() -> None:
    learning = day1().learning
    assert learning is not None
    assert len(learning) == 121
    np.testing.assert_allclose(np.diff(learning.time), 1.0, atol=0.03)
    assert learning.time[-1] == made(4).time[-1]
    assert np.isnan(learning.columns()["mag_delay"][0])  # the field is not known before the first block's end
    assert np.isfinite(learning.columns()["mag_delay_sigma"][1:]).all()
    first, last = learning.columns()["gyr_bias_x_sigma"][[0, -1]]
    assert last < 0.02 * first


def test_asking_for_it_changes_nothing_else() -> None:
    plain = poise.estimate(FLAGSHIP, made(4))
    assert plain.learning is None
    assert plain.table.tobytes() == day1().table.tobytes()
    assert poise.estimate(poise.TwoStage(), made(4)[:500], learning=1.0).learning is None
    offline = poise.smooth(made(4)[:3000], learning=0.5)
    assert offline.learning is not None
    assert offline.table.tobytes() == poise.smooth(made(4)[:3000]).table.tobytes()
    causal = poise.estimate(FLAGSHIP, made(4)[:3000], learning=0.5).learning
    assert causal is not None
    np.testing.assert_array_equal(offline.learning.values, causal.values)


def test_over_time_bears_any_clock() -> None:
    clean = made(4)[:1000]
    time = clean.time.copy()
    time[300:] += 1e6
    time[600:] -= 50.0
    time[[0, 5, 999]] = np.nan
    learning = poise.estimate(FLAGSHIP, replace(clean, time=time), learning=1.0).learning
    assert learning is not None
    assert len(learning) < 12
    assert (np.diff(learning.time) > 0.0).sum() >= 6
    assert len(poise.estimate(FLAGSHIP, clean[:0], learning=1.0)) == 0
    for seconds in (0.0, -1.0, float("inf"), float("nan"), "1 s"):
        with pytest.raises(MethodError, match="learning: expected seconds"):
            poise.estimate(FLAGSHIP, clean, learning=seconds)  # type: ignore[arg-type]


def test_over_time_as_tables(tmp_path: Path) -> None:
    learning = day1().learning
    assert learning is not None
    poise.write(learning, tmp_path / "a.parquet")
    poise.write(learning, tmp_path / "a.csv")
    table = pyarrow.parquet.read_table(tmp_path / "a.parquet")
    assert table.schema.metadata[b"poise.kind"] == b"learning"
    assert b"mag_delay s" in table.schema.metadata[b"poise.units"]
    np.testing.assert_array_equal(table["gyr_scale_xy"].to_numpy(), learning.columns()["gyr_scale_xy"])
    text = [line for line in (tmp_path / "a.csv").read_text().splitlines() if not line.startswith("#")]
    assert text[0].split(",") == list(learning.columns())
    assert len(text) == 1 + len(learning)
    assert list(learning.to_frame().columns) == list(learning.to_arrow().column_names)
    with pytest.raises(FormatError, match="tum is no format for what was learned over time"):
        poise.write(learning, tmp_path / "a.tum")


def test_its_picture(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    from poise.plots import learning_figure, save_figure

    learning = day1().learning
    assert learning is not None
    figure = learning_figure(learning, "made")
    assert len(figure.axes) == 8
    drawn = next(line for line in figure.axes[0].lines if line.get_label() == "x")
    np.testing.assert_allclose(np.asarray(drawn.get_ydata())[-1], np.degrees(known()["gyr_bias"]["value"][0]))
    save_figure(figure, tmp_path / "a.svg")
    without = poise.estimate(FLAGSHIP, replace(made(4)[:1000], mag=None), learning=1.0).learning
    assert without is not None
    assert len(learning_figure(without, narrow=True).axes) == 6
    assert len(learning_figure(without[:0]).axes) == 6


# -- files ----------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["sensor.json", "day1.parquet", "day1.csv"])
def test_files_keep_it_bit_for_bit(tmp_path: Path, name: str) -> None:
    poise.write(known() if name.endswith("json") else day1(), tmp_path / name)
    read = poise.read_learned(tmp_path / name)
    assert read == known()
    assert read.covariance is not None
    np.testing.assert_array_equal(read.covariance, known().covariance)
    assert (read.method, read.states, read.source) == ("SelfCalibrating", known().states, known().source)
    again = poise.estimate(FLAGSHIP, made(5)[:500], start_from=read)
    assert again.table.tobytes() == poise.estimate(FLAGSHIP, made(5)[:500], start_from=day1()).table.tobytes()


def test_it_is_pickled() -> None:
    twin = pickle.loads(pickle.dumps(known()))
    assert twin == known()


def test_a_file_by_hand_needs_no_covariance(tmp_path: Path) -> None:
    text = json.loads(known().as_json())
    del text["covariance"], text["states"], text["source"]
    (tmp_path / "hand.json").write_text(json.dumps(text))
    read = poise.read_learned(tmp_path / "hand.json")
    assert read.covariance is None
    attitude = poise.estimate(FLAGSHIP, made(5)[:500], start_from=read)
    assert attitude.valid.all()


def damaged() -> dict[str, str]:
    """Contents of files that are none, and what is said of them."""
    whole = json.loads(known().as_json())

    def other(**changes: Any) -> str:
        return json.dumps(whole | changes)

    bias = whole["learned"]["gyr_bias"]
    rows = whole["covariance"]
    return {
        known().as_json()[:1000]: "damaged",
        "{}": "damaged",
        '{"poise": "stream"}': 'expected "poise": "learned"',
        "[" * 100_000: "expected what poise learned",
        "{" + '"a":{' * 5000: "damaged",
        "time,gx\n1,2\n": "expected what poise learned",
        other(learned={"gyr_bias": bias | {"value": [1.0, 2.0]}}): "gyr_bias",
        other(learned={"gyr_bias": bias | {"value": [1.0, 2.0, float("nan")]}}): "finite",
        other(learned={"gyr_bias": bias | {"sigma": [1.0, -2.0, 1.0]}}): "sigma of 0 or more",
        other(learned={"gyr_bias": 3}): "expected value, sigma and unit",
        other(learned=[]): "damaged",
        other(covariance=[row[:-1] for row in rows]): "damaged",
        other(covariance=[[-v for v in row] for row in rows]): "negative variance",
        other(states=whole["states"][:-1]): "covariance of shape",
        other(states=[*whole["states"][:-1], "gyr_bias_x"]): "covariance of shape",
    }


def test_damaged_files_are_refused_with_a_reason(tmp_path: Path) -> None:
    for i, (text, reason) in enumerate(damaged().items()):
        path = tmp_path / f"{i}.json"
        path.write_text(text)
        with pytest.raises(FormatError, match=reason):
            poise.read_learned(path)
    (tmp_path / "bytes.json").write_bytes(b"{\xff\xfe\x00")
    with pytest.raises(FormatError, match="not UTF-8"):
        poise.read_learned(tmp_path / "bytes.json")
    poise.write(poise.estimate(poise.TwoStage(), made(4)[:200]), tmp_path / "two.parquet")
    with pytest.raises(FormatError, match="an attitude without anything learned"):
        poise.read_learned(tmp_path / "two.parquet")


# -- as a start -------------------------------------------------------------------------------------------------------------


def test_it_starts_with_those_values_and_grown_sigmas() -> None:
    stream = poise.Stream(FLAGSHIP, start_from=known())
    r = made(5)
    stream.update(Packet(float(r.time[0]), r.gyr[0], r.acc[0], r.mag[0]))
    P = P_of(stream)
    begun = stream.learned
    assert begun is not None
    assert begun["gyr_bias"]["value"] == known()["gyr_bias"]["value"]
    assert begun["gyr_scale"]["value"] == known()["gyr_scale"]["value"]
    assert begun["acc_delay"]["value"] == known()["acc_delay"]["value"]
    assert P[SENSOR, 18] == known()["mag_delay"]["value"]
    for name in ("gyr_bias", "gyr_scale", "acc_delay"):
        grown = np.hypot(known()[name]["sigma"], GROWTH[name])
        np.testing.assert_allclose(begun[name]["sigma"], grown, rtol=1e-9)
    np.testing.assert_allclose(P[MAG_DELAY, MAG_DELAY], known()["mag_delay"]["sigma"] ** 2 + GROWTH["mag_delay"] ** 2)
    # Scale and bias keep what relates them; attitude and hard iron begin anew.
    assert known().covariance is not None
    block = known().covariance[:12, :12].copy()
    growth = np.repeat([GROWTH["gyr_bias"], GROWTH["gyr_scale"]], [3, 9])
    np.testing.assert_allclose(P[BIAS : SCALE + 9, BIAS : SCALE + 9], block + np.diag(growth**2), rtol=1e-9, atol=1e-18)
    assert not P[IRON : IRON + 3, :IRON].any()
    assert (np.linalg.eigvalsh(P[:25, :25]) > -1e-12).all()


def test_the_next_recording_begins_where_it_would_end() -> None:
    """In motion from the first sample on, where a bias cannot be measured at rest."""
    recording = made(5)[3000:6000]
    cold, warm = poise.estimate(FLAGSHIP, recording), poise.estimate(FLAGSHIP, recording, start_from=day1())
    a, b = (float(np.mean(poise.evaluate(attitude, recording).total[200:])) for attitude in (cold, warm))
    assert b < 0.35 * a
    back = [poise.smooth(recording, start_from=k) for k in (None, known())]
    a, b = (poise.evaluate(attitude, recording).rmse_deg().total for attitude in back)
    assert b < a


def test_without_a_magnetometer_the_heading_drifts_less() -> None:
    recording = replace(made(6), mag=None)
    ends = []
    for start_from in (None, known()):
        attitude = poise.estimate(FLAGSHIP, recording, start_from=start_from)
        heading = np.unwrap(np.degrees(poise.evaluate(attitude, recording).heading), period=360.0)
        ends.append(np.abs(heading - heading[0]).max())
    assert ends[1] < 0.6 * ends[0]


def test_the_hard_iron_is_carried_in_the_magnetometers_unit() -> None:
    """To a place whose field is twice as strong, for a sensor that may have some."""
    expects = FLAGSHIP._replace(initial_iron=0.05)
    iron = np.array([3.0, -2.0, 1.5])
    before = poise.estimate(expects, made(4, iron=tuple(iron))).learned
    assert before is not None
    place = made(5)[:300]
    there = replace(place, mag=2.0 * place.mag + iron)
    stream = poise.Stream(expects, start_from=before)
    stream.update(Packet(there.time[:20], there.gyr[:20], there.acc[:20], there.mag[:20]))
    assert stream.learned is not None
    np.testing.assert_allclose(stream.learned["hard_iron"]["value"], iron, atol=1.0)
    twice = 2.0 * np.linalg.norm(known()["field"]["value"])
    np.testing.assert_allclose(np.linalg.norm(stream.learned["field"]["value"]), twice, rtol=0.05)


def test_a_hard_iron_in_another_unit_is_left_out() -> None:
    gauss = replace(made(5)[:300], mag=0.01 * made(5)[:300].mag)
    none = poise.estimate(FLAGSHIP, gauss, start_from=changed(hard_iron=[0.0, 0.0, 0.0]))
    warm = poise.estimate(FLAGSHIP, gauss, start_from=changed(hard_iron=[20.0, 0.0, 0.0]))
    assert warm.table.tobytes() == none.table.tobytes()
    assert warm.learned is not None
    assert np.abs(warm.learned["hard_iron"]["value"]).max() < 0.1
    assert any("another unit?" in text for text in FLAGSHIP.doubts(known(), warm.learned))


def test_it_survives_a_start_without_an_accelerometer() -> None:
    """The method is started from a placeholder first, and anew by the first sample that gives an attitude."""
    late = made(5)[:600]
    acc = late.acc.copy()
    acc[:50] = np.nan
    late = replace(late, acc=acc)
    attitude = poise.estimate(FLAGSHIP, late, start_from=known())
    np.testing.assert_allclose(attitude.bias[60], known()["gyr_bias"]["value"], atol=5e-3)
    assert np.degrees(attitude.bias_sigma[60]).max() < 0.25
    assert attitude.learned is not None
    np.testing.assert_allclose(attitude.learned["gyr_scale"]["value"], known()["gyr_scale"]["value"], atol=1e-3)


def test_a_stream_goes_on_alike_in_another_process() -> None:
    r = made(5)[:800]
    whole = poise.estimate(FLAGSHIP, r, start_from=known())
    stream = poise.Stream(FLAGSHIP, start_from=known())
    parts = [stream.update(Packet(r.time[:300], r.gyr[:300], r.acc[:300], r.mag[:300])).table]
    stream = pickle.loads(pickle.dumps(stream))
    parts.append(stream.update(Packet(r.time[300:], r.gyr[300:], r.acc[300:], r.mag[300:])).table)
    assert np.concatenate(parts).tobytes() == whole.table.tobytes()


_PLAIN = """
import sys, numpy, poise
r = poise.read(sys.argv[1])
numpy.save(sys.argv[3], poise.estimate(poise.SelfCalibrating(), r, start_from=poise.read_learned(sys.argv[2])).table)
"""


def test_compiled_and_plain_python_agree(tmp_path: Path) -> None:
    recording, sensor, out = tmp_path / "r.npz", tmp_path / "sensor.json", tmp_path / "plain.npy"
    poise.write(made(5)[:1500], recording)
    poise.write(known(), sensor)
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    arguments = [sys.executable, "-c", _PLAIN, str(recording), str(sensor), str(out)]
    subprocess.run(arguments, check=True, env=environment, timeout=120)
    compiled = poise.estimate(FLAGSHIP, made(5)[:1500], start_from=known())
    np.testing.assert_allclose(np.load(out), compiled.table, rtol=0, atol=1e-9)


def test_what_is_no_start_is_refused() -> None:
    r = made(4)[:10]
    wrong: dict[str, tuple[Any, type[Exception]]] = {
        "learns nothing about the sensors": (None, MethodError),
        "has nothing that was learned": (poise.estimate(poise.TwoStage(), r), MethodError),
        "expected what was learned": ({"gyr_bias": 1}, MethodError),
        "what Other learned, expected that of SelfCalibrating": (replace(known(), method="Other"), MethodError),
        "expected gyr_scale of shape": (replace(known(), quantities={"gyr_bias": known()["gyr_bias"]}, states=(),
                                                covariance=None), MethodError),
        "gyr_bias .* is that of no sensor": (changed(gyr_bias=[50.0, 0.0, 0.0]), MethodError),
        "gyr_bias: a value of shape": (changed(gyr_bias=[1.0, 2.0]), RecordingError),
    }  # fmt: skip
    for reason, (start_from, kind) in wrong.items():
        method = poise.TwoStage() if start_from is None else FLAGSHIP
        with pytest.raises(kind, match=reason):
            poise.estimate(method, r, start_from=known() if start_from is None else start_from)
    with pytest.raises(MethodError, match="both say the gyroscope's bias"):
        poise.Stream(FLAGSHIP, bias=(0.1, 0.0, 0.0), start_from=known())
    deg = {**known().quantities, "gyr_bias": {**known()["gyr_bias"], "unit": "deg/s"}}
    with pytest.raises(MethodError, match="gyr_bias in 'deg/s', expected 'rad/s'"):
        poise.Stream(FLAGSHIP, start_from=replace(known(), quantities=deg))


def test_another_sensor_is_doubted() -> None:
    other = measure(forearm(60.0, 100.0, 7), Sensor(gyr=Triad(noise=1e-4, bias=(-0.02, 0.02, 0.0))), seed=7)
    found = poise.estimate(FLAGSHIP, other, start_from=known()).learned
    same = poise.estimate(FLAGSHIP, made(5), start_from=known()).learned
    assert found is not None and same is not None
    doubt = re.compile(r"gyr_bias_x was 0\.03?\d* ± 0\.00\d+ rad/s, found -0\.0")
    assert any(doubt.match(text) for text in FLAGSHIP.doubts(known(), found)), FLAGSHIP.doubts(known(), found)
    assert FLAGSHIP.doubts(known(), same) == []


def test_from_one_trial_to_the_next_of_the_same_sensor() -> None:
    """29 after 21: the same gyroscope, as its bias and misalignment say; the table is on the flagship's page."""
    first, second = (poise.read(next(data_path("broad").glob(f"{number}_*.mat"))) for number in ("21", "29"))
    before = poise.estimate(FLAGSHIP, first).learned
    cold, warm = poise.estimate(FLAGSHIP, second), poise.estimate(FLAGSHIP, second, start_from=before)
    assert poise.evaluate(warm, second).rmse_deg().total < poise.evaluate(cold, second).rmse_deg().total
    assert before is not None and warm.learned is not None
    assert FLAGSHIP.doubts(before, warm.learned) == []


# -- the command --------------------------------------------------------------------------------------------------------------


def test_the_command_keeps_and_takes_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    poise.write(made(4)[:3000], "day1.csv")
    poise.write(made(5)[:3000], "day2.csv")
    options = ["--learned", "--save-learned", "sensor.json", "--learned-over-time", "over.csv", "--learned-every", "5"]
    assert run(["estimate", "day1.csv", *options]) == 0
    told = capsys.readouterr()
    assert "deg/s" in told.out and "ms" in told.out and "%" in told.out
    assert "what was learned in sensor.json" in told.err
    assert len([line for line in Path("over.csv").read_text().splitlines() if not line.startswith("#")]) == 1 + 7
    first = poise.estimate(FLAGSHIP, poise.read("day1.csv"))
    assert poise.read_learned("sensor.json") == first.learned
    expected = poise.estimate(FLAGSHIP, poise.read("day2.csv"), start_from=first)
    for start in ("sensor.json", "day1.attitude.parquet"):
        assert run(["estimate", "day2.csv", "--start-from", start, "-o", "day2.parquet", "--json"]) == 0
        np.testing.assert_array_equal(poise.read_attitude("day2.parquet").table, expected.table)
        (result,) = json.loads(capsys.readouterr().out)["results"]
        assert result["doubts"] == []
    assert run(["estimate", "day2.csv", "--start-from", "sensor.json", "--offline", "-o", "back.parquet"]) == 0
    smoothed = poise.smooth(poise.read("day2.csv"), start_from=first)
    np.testing.assert_array_equal(poise.read_attitude("back.parquet").table, smoothed.table)


def test_the_command_refuses_in_a_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    poise.write(made(4)[:300], "day.csv")
    Path("half.json").write_text(known().as_json()[:500])
    Path("other.json").write_text(replace(known(), method="Other").as_json())
    for arguments, reason in (
        (["--start-from", "half.json"], "--start-from half.json: not what poise wrote as learned, or damaged"),
        (["--start-from", "other.json"], "--start-from other.json: what Other learned"),
        (["--start-from", "none.json"], "none.json"),
        (["--start-from", "day.csv"], "--start-from day.csv: an attitude without anything learned"),
        (["--start-from", "half.json", "-m", "tilt"], "--start-from goes with --method self-calibrating"),
        (["--save-learned", "a.json", "-m", "tilt"], "tilt learns nothing about the sensors"),
        (["--save-learned", "a.csv"], "--save-learned a.csv: expected a folder, or a file ending in .json"),
        (["--learned-over-time", "a.txt"], "--learned-over-time a.txt: expected a folder"),
        (["--learned-over-time", "a.csv", "--learned-every", "0"], "--learned-every 0.0: expected seconds above 0"),
        (["--learned-over-time", "a.csv", "-o", "a.csv"], "two results would both be written to a.csv"),
    ):
        assert run(["estimate", "day.csv", *arguments]) == 2, arguments
        told = capsys.readouterr().err
        assert reason in told
        assert len(told.strip().splitlines()) == 1
    assert {path.name for path in tmp_path.iterdir()} == {"day.csv", "half.json", "other.json"}
