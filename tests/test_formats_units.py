"""Units: named ones are used, missing ones are told by the samples or asked for, wrong ones are found."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from data_files import data_path
from poise.errors import FormatError
from poise.formats import read, sniff, units

RATE, ROWS = 100.0, 4000
DEG = np.pi / 180


def motion(turning: float = 1.5) -> dict[str, np.ndarray]:
    """A body that turns about changing axes without accelerating; rad/s, m/s², µT."""
    from scipy.spatial.transform import Rotation

    time = np.arange(ROWS) / RATE
    gyr = turning * np.stack([np.sin(0.7 * time), np.cos(0.45 * time), np.sin(0.3 * time + 1)], axis=1)
    turn = Rotation.identity()
    acc, mag = np.empty((ROWS, 3)), np.empty((ROWS, 3))
    for i in range(ROWS):
        acc[i], mag[i] = turn.inv().apply([[0, 0, 9.81], [0, 20, -43]])
        turn = turn * Rotation.from_rotvec(gyr[i] / RATE)
    rng = np.random.default_rng(0)
    noisy = {"gyr": gyr + 0.01 * rng.normal(size=gyr.shape), "acc": acc + 0.1 * rng.normal(size=gyr.shape)}
    return noisy | {"mag": mag + 0.3 * rng.normal(size=gyr.shape), "time": time}


MOVING, RESTING = motion(), motion(0.0)


def save(path: Path, samples: dict[str, np.ndarray], **names: str) -> Path:
    labels = {name: names.get(name, name) for name in samples}
    np.savez(path, **{labels[name]: values for name, values in samples.items()})
    return path


@pytest.mark.parametrize("magnetometer", [True, False])
@pytest.mark.parametrize("gyr", ["rad/s", "deg/s", "mdeg/s"])
@pytest.mark.parametrize("acc", ["m/s²", "g", "mg"])
@pytest.mark.parametrize("time", ["s", "ms", "us", "ns"])
def test_samples_tell_their_units(tmp_path, gyr, acc, time, magnetometer):
    found = {
        "time": MOVING["time"] * units.FACTORS["time"][time],
        "gyr": MOVING["gyr"] / units.FACTORS["gyr"][gyr],
        "acc": MOVING["acc"] / units.FACTORS["acc"][acc],
    } | ({"mag": MOVING["mag"]} if magnetometer else {})
    path = save(tmp_path / "a.npz", found)
    recording, sniffed = read(path), sniff(path)
    assert [sniffed.sensors[name].unit for name in ("time", "gyr", "acc")] == [time, gyr, acc]
    for name in ("time", "gyr", "acc"):
        np.testing.assert_allclose(getattr(recording, name), MOVING[name], rtol=1e-12, atol=1e-12)
        assert any(note.startswith(f"{name}: taken as") for note in recording.notes)


def test_undecided_units_are_asked_for(tmp_path):
    resting = save(tmp_path / "rest.npz", RESTING)
    with pytest.raises(FormatError, match=r"samples do not decide.*--units gyr=rad/s or gyr=deg/s"):
        read(resting)
    assert len(read(resting, units={"gyr": "rad/s"})) == ROWS
    raw = save(tmp_path / "raw.npz", MOVING | {"acc": MOVING["acc"] * 1671})
    with pytest.raises(FormatError, match=r"median length is 1.6\d+e\+04; say it: --units acc="):
        read(raw)
    slow = save(tmp_path / "slow.npz", MOVING | {"time": MOVING["time"] * 20})
    with pytest.raises(FormatError, match="5 Hz in s or 5000 Hz in ms; say it: --units time=s"):
        read(slow)
    assert read(slow, units={"time": "ms", "gyr": "rad/s"}).rate_hz == pytest.approx(5000)


@pytest.mark.parametrize(
    ("names", "scale", "fix"),
    [
        ({"gyr": "gyr (rad/s)"}, {"gyr": 1 / DEG}, "gyr is named by the file as rad/s, but .*say --units gyr=deg/s"),
        ({"gyr": "gyr [dps]"}, {}, "gyr is named by the file as deg/s, but .*say --units gyr=rad/s"),
        ({"acc": "acc (m/s^2)"}, {"acc": 1 / 9.80665}, "acc is named by the file as m/s², but .*say --units acc=g"),
        ({"acc": "acc (g)"}, {}, "acc is named by the file as g, but .*say --units acc=m/s²"),
        ({"acc": "acc (m/s2)"}, {"acc": 0.2}, "acceleration without gravity"),
        ({"time": "time (s)"}, {"time": 1000.0}, "means 0.1 samples per second, but .*say --units time=ms"),
        ({"time": "time (ms)"}, {}, "means 1e.05 samples per second, but .*say --units time=s"),
    ],
)
def test_named_unit_that_the_samples_contradict(tmp_path, names, scale, fix):
    samples = {name: values * scale.get(name, 1.0) for name, values in MOVING.items()}
    path = save(tmp_path / "a.npz", samples, **names)
    with pytest.raises(FormatError, match=fix):
        read(path)
    with pytest.raises(FormatError, match=r"given as|given\)"):
        sensor = next(iter(names))
        stated = names[sensor].split("(" if "(" in names[sensor] else "[")[1][:-1]
        read(save(tmp_path / "b.npz", samples), units={sensor: stated})


def test_option_wins_over_the_header(tmp_path):
    path = save(tmp_path / "a.npz", MOVING, gyr="gyr (deg/s)", acc="acc (g)")
    recording = read(path, units={"gyr": "rad/s", "acc": "m/s^2"})
    np.testing.assert_array_equal(recording.gyr, MOVING["gyr"])


def test_slightly_wrong_scale_is_a_doubt(tmp_path):
    path = save(tmp_path / "a.npz", MOVING | {"acc": MOVING["acc"] * 1.5}, acc="acc (m/s2)")
    assert any("off by a factor of 1.50" in doubt for doubt in sniff(path).doubts)


def test_gravity_free_by_its_samples(tmp_path):
    free = np.random.default_rng(1).normal(size=(ROWS, 3)) * 0.4
    with pytest.raises(FormatError, match=r"acceleration without gravity.*raw or total"):
        read(save(tmp_path / "a.npz", MOVING | {"acc": free}))


@pytest.mark.parametrize(("unit", "scale"), [("T", 1e6), ("mT", 1e3), ("uT", 1), ("nT", 1e-3), ("G", 100), ("mG", 0.1)])
def test_magnetometer_units(tmp_path, unit, scale):
    path = save(tmp_path / "a.npz", MOVING, mag=f"mag ({unit})")
    np.testing.assert_allclose(read(path).mag, MOVING["mag"] * scale, rtol=1e-15)


def test_unknown_magnetometer_unit_is_kept(tmp_path):
    path = save(tmp_path / "a.npz", MOVING, mag="mag (a.u.)")
    recording = read(path)
    np.testing.assert_array_equal(recording.mag, MOVING["mag"])
    assert any(note.startswith("mag: unit not known") for note in recording.notes)


@pytest.mark.parametrize(
    ("sensor", "word", "unit"),
    [
        ("gyr", "°/s", "deg/s"),
        ("gyr", "rad s⁻¹", "rad/s"),
        ("gyr", "degrees per second", "deg/s"),
        ("gyr", "mdps", "mdeg/s"),
        ("acc", "m/s²", "m/s²"),
        ("acc", "m/s^2", "m/s²"),
        ("acc", "G", "g"),
        ("mag", "mG", "mG"),
        ("mag", "µT", "µT"),
        ("mag", "μT", "µT"),
        ("time", "sec", "s"),
        ("time", "µs", "us"),
        ("gyr", "g", None),
        ("length", "m", None),
    ],
)
def test_unit_words(sensor, word, unit):
    assert units.named(sensor, word) == unit


@pytest.mark.parametrize("trial", ["01_undisturbed_slow_rotation_A", "21_undisturbed_fast_combined"])
def test_benchmark_units_are_found_in_any_unit(tmp_path, trial):
    original = read(data_path("broad", f"{trial}.mat"))
    scaled = {
        "time": original.time * 1e6,
        "gyr": original.gyr / DEG,
        "acc": original.acc / 9.80665,
        "mag": original.mag,
    }
    again = read(save(tmp_path / "a.npz", scaled))
    np.testing.assert_allclose(again.gyr, original.gyr, rtol=1e-12)
    np.testing.assert_allclose(again.acc, original.acc, rtol=1e-12)
    np.testing.assert_allclose(again.time, original.time, rtol=1e-12)
