"""What poise writes, poise reads back exactly, and nothing half-written is left behind."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from data_files import data_path
from poise.data.attitude import COLUMNS, Attitude, Provenance
from poise.data.recording import Recording
from poise.errors import FormatError
from poise.formats import read, read_attitude, write

FORMATS = ("csv", "parquet", "npz")


def recording(n: int = 300, seed: int = 0, **facts) -> Recording:
    rng = np.random.default_rng(seed)
    time = 1.7e9 + np.cumsum(rng.uniform(0.009, 0.011, n))
    gyr, acc, mag = (rng.normal(size=(n, 3)) * size for size in (1, 10, 40))
    mag[rng.random(n) < 0.5] = np.nan
    acc[3] = np.nan
    quat = rng.normal(size=(n, 4))
    quat[:5] = np.nan
    given_facts = {"moving": rng.random(n) < 0.7, "acc_age": rng.random(n) * 0.01, "gravity": 9.81, "source": "a\nb"}
    return Recording(
        time, gyr, acc, mag, truth=Attitude.of(time, quat, heading_reference="true"), **given_facts | facts
    )


def attitude(n: int = 200, seed: int = 1) -> Attitude:
    rng = np.random.default_rng(seed)
    table = rng.normal(size=(n, COLUMNS)) * 10.0 ** rng.integers(-12, 12, (n, COLUMNS))
    table[:, :4] = rng.normal(size=(n, 4))
    table[:, :4] /= np.linalg.norm(table[:, :4], axis=1, keepdims=True)
    table[10:20] = np.nan
    flags = rng.integers(0, 2**32, n, dtype=np.uint32)
    provenance = Provenance("mahony", {"gain": 2.0, "name": "ä"}, ' "odd"\npath', "ab" * 32)
    return Attitude(np.cumsum(rng.random(n)), table, flags, "magnetic", "ned", provenance)


def assert_same(a: Recording, b: Recording) -> None:
    for name in ("time", "gyr", "acc", "mag", "acc_age", "mag_age", "moving"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name), err_msg=name, strict=True)
        if name != "moving":
            known = np.isfinite(getattr(a, name))
            assert (np.signbit(getattr(a, name))[known] == np.signbit(getattr(b, name))[known]).all()
    assert (a.truth is None) == (b.truth is None) and a.gravity == b.gravity
    if a.truth is not None and b.truth is not None:
        np.testing.assert_array_equal(a.truth.quat, b.truth.quat)
        assert (a.truth.frame, a.truth.heading_reference) == (b.truth.frame, b.truth.heading_reference)


@pytest.mark.parametrize("kind", FORMATS)
def test_recording_round_trip(tmp_path, kind):
    original = recording()
    path = write(original, tmp_path / f"a.{kind}")
    assert_same(original, read(path))
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("kind", FORMATS)
def test_recording_without_extras(tmp_path, kind):
    plain = Recording(time=[0, 0.01, 0.02], gyr=np.zeros((3, 3)), acc=np.ones((3, 3)) * 1e-3)
    again = read(write(plain, tmp_path / "a.bin", format=kind))
    assert_same(plain, again)
    assert "no magnetometer: heading is arbitrary" in again.notes


@pytest.mark.parametrize("kind", FORMATS)
@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_any_recording_round_trip(tmp_path, kind, data):
    n = data.draw(st.integers(1, 6))
    samples = arrays(np.float64, (n, 3), elements=st.floats(width=64))
    original = Recording(np.arange(n) / 7, data.draw(samples), data.draw(samples), data.draw(samples))
    assert_same(original, read(write(original, tmp_path / f"a.{kind}")))


@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_attitude_round_trip(tmp_path, kind):
    original = attitude()
    again = read_attitude(write(original, tmp_path / f"a.{kind}"))
    for name in ("time", "table", "flags"):
        np.testing.assert_array_equal(getattr(original, name), getattr(again, name), strict=True)
    assert (again.frame, again.heading_reference) == ("ned", "magnetic")
    assert again.provenance == original.provenance


def test_attitude_metadata_is_in_the_file(tmp_path):
    from pyarrow import parquet

    original = attitude()
    text = write(original, tmp_path / "a.csv").read_text()
    assert "# poise.frame: ned\n" in text and "\ntime,qw,qx,qy,qz,rate_x" in text
    schema = parquet.read_schema(write(original, tmp_path / "a.parquet"))
    assert schema.metadata[b"poise.heading_reference"] == b"magnetic"


def test_tum_round_trip_leaves_out_rows_without_attitude(tmp_path):
    original = attitude()
    path = write(original, tmp_path / "a.tum")
    lines = path.read_text().splitlines()
    assert "# 10 of 200 rows have no attitude and are left out" in lines
    assert "# timestamp tx ty tz qx qy qz qw" in lines
    first = [float(cell) for cell in lines[-190].split()]
    assert first[0] == original.time[0] and first[1:4] == [0, 0, 0] and first[7] == original.quat[0, 0]
    again = read_attitude(path)
    known = np.isfinite(original.quat[:, 0])
    np.testing.assert_array_equal(again.quat, original.quat[known])
    np.testing.assert_array_equal(again.time, original.time[known])
    assert (again.frame, again.heading_reference) == ("ned", "magnetic")


@pytest.mark.parametrize("kind", ["csv", "parquet", "tum"])
def test_an_attitude_is_not_a_recording(tmp_path, kind):
    path = write(attitude(), tmp_path / f"a.{kind}")
    with pytest.raises(FormatError, match="an attitude that poise wrote, not a recording"):
        read(path)


def test_foreign_references(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("# made elsewhere\n1.0 0 0 0 0 0 0 2\n1.1 5 6 7 1 0 0 0\n")
    np.testing.assert_array_equal(read_attitude(path).quat, [[1, 0, 0, 0], [0, 1, 0, 0]])
    path.write_text("time (ms);qw;qx;qy;qz\n" + "".join(f"{i * 10};1;0;0;0\n" for i in range(9)))
    np.testing.assert_allclose(read_attitude(path).time, np.arange(9) / 100)
    written = write(recording(), tmp_path / "r.csv")
    np.testing.assert_array_equal(read_attitude(written).quat, recording().truth.quat)
    path.write_text("time,a,b\n1,2,3\n")
    with pytest.raises(FormatError, match="no attitude: expected columns time, qw, qx, qy, qz, found time, a, b"):
        read_attitude(path)
    np.savez(tmp_path / "a.npz", a=1)
    with pytest.raises(FormatError, match="Parquet, CSV, TUM text and ROS bags, this is a npz file"):
        read_attitude(tmp_path / "a.npz")


def test_empty_attitude(tmp_path):
    empty = attitude()[:0]
    for kind in ("csv", "parquet", "tum"):
        path = write(empty, tmp_path / f"a.{kind}")
        with pytest.raises(FormatError, match="no row"):
            read_attitude(path)


@pytest.mark.parametrize(
    ("thing", "name", "reason"),
    [
        (attitude(), "a.npz", "npz is no format for an attitude; expected parquet, csv, tum"),
        (recording(), "a.tum", "tum is no format for a recording"),
        (recording(), "a.xyz", ".xyz is no format"),
        (recording(), "a", "no extension is no format"),
        ("text", "a.csv", "expected an Attitude or a Recording to write, found str"),
        (recording(), "missing/a.csv", "cannot be written: No such file"),
    ],
)
def test_what_cannot_be_written(tmp_path, thing, name, reason):
    with pytest.raises(FormatError, match=reason):
        write(thing, tmp_path / name)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("kind", ["csv", "parquet", "npz"])
def test_a_failure_leaves_the_old_file_and_nothing_else(tmp_path, kind, monkeypatch):
    path = write(recording(), tmp_path / f"a.{kind}")
    before = path.read_bytes()

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(FormatError, match="cannot be written: No space left on device"):
        write(recording(seed=5), path)
    assert path.read_bytes() == before and list(tmp_path.iterdir()) == [path]


def test_a_flipped_bit_in_parquet_is_noticed(tmp_path):
    path = write(recording(), tmp_path / "a.parquet")
    content = bytearray(path.read_bytes())
    noticed = 0
    for place in range(1000, len(content) - 8000, 997):
        flipped = content.copy()
        flipped[place] ^= 16
        path.write_bytes(flipped)
        try:
            assert_same(recording(), read(path))
        except FormatError:
            noticed += 1
    assert noticed > 10


@pytest.mark.parametrize("kind", FORMATS)
def test_written_twice_the_same_bytes(tmp_path, kind):
    first, second = (write(recording(), tmp_path / f"{name}.{kind}").read_bytes() for name in "ab")
    assert first == second


@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_benchmark_round_trip(tmp_path, kind):
    original = read(data_path("broad", "25_disturbed_tapping_B.mat"))[:5000]
    assert_same(original, read(write(original, tmp_path / f"a.{kind}")))


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(cut=st.integers(0, 2500), flips=st.lists(st.tuples(st.integers(0, 2500), st.integers(0, 255)), max_size=4))
def test_damaged_text_is_read_or_refused(tmp_path, cut, flips):
    path = tmp_path / "a.txt"
    buffer = bytearray(_text(tmp_path))
    for place, value in flips:
        buffer[place % len(buffer)] = value
    path.write_bytes(bytes(buffer[: cut if flips == [] else len(buffer)]))
    for reader in (read, read_attitude):
        try:
            reader(path)
        except FormatError as problem:
            assert str(problem).startswith(str(path))


def _text(folder: Path, cache: list[bytes] = []) -> bytes:  # noqa: B006  # made once
    if not cache:
        cache.append(write(recording(12), folder / "made.csv").read_bytes())
    return cache[0]


def test_paths_may_be_text(tmp_path):
    path = write(recording(), str(tmp_path / "a.csv"))
    assert isinstance(path, Path) and read(str(path)).source == str(path)


@pytest.mark.parametrize("kind", ["csv", "mcap"])
def test_the_longest_name_can_be_written(tmp_path, kind):
    name = "日" * ((254 - len(kind)) // 3) + f".{kind}"
    assert 250 < len(name.encode()) <= 255
    thing = recording() if kind == "csv" else Attitude.of([0.0, 0.5], [[1.0, 0, 0, 0]] * 2)
    write(thing, tmp_path / name)
    assert [path.name for path in tmp_path.iterdir()] == [name]
