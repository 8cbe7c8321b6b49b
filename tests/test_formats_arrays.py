"""npz, MATLAB and Parquet files: what they may hold, and what hostile ones may not do."""

from __future__ import annotations

import io
import os
import pickle
import struct
import subprocess
import sys
import time as clock
import zipfile
import zlib
from pathlib import Path

import numpy as np
import pytest

from data_files import data_path
from poise.errors import FormatError
from poise.formats import Limits, read, sniff

N = 50
RNG = np.random.default_rng(3)
GYR, ACC, MAG = RNG.normal(size=(N, 3)), RNG.normal(size=(N, 3)) + np.array([0, 0, 9.8]), RNG.normal(size=(N, 3))
TIME = np.arange(N) / 100
UNITS = {"gyr": "rad/s", "acc": "m/s2", "mag": "uT", "time": "s"}


def test_npz_by_name_with_rate_or_stamps(tmp_path):
    path = tmp_path / "a.npz"
    np.savez_compressed(path, imu_gyr=GYR, imu_acc=ACC.astype(np.float32), magnetometer=MAG, sampling_rate=100.0)
    recording = read(path, units=UNITS)
    np.testing.assert_array_equal(recording.gyr, GYR)
    np.testing.assert_array_equal(recording.acc, ACC.astype(np.float32))
    np.testing.assert_array_equal(recording.time, TIME)
    np.savez(path, t=TIME[:, None], gyro=GYR.T, accelerometer=ACC, mag_x=MAG[:, 0], mag_y=MAG[:, 1], mag_z=MAG[:, 2])
    recording = read(path, units=UNITS)
    np.testing.assert_array_equal(recording.gyr, GYR)
    np.testing.assert_array_equal(recording.mag, MAG)
    assert any("transpose" in note for note in recording.notes)
    np.savez(path, G=GYR, A=ACC, dt=0.01)
    recording = read(path, columns="G=gyr[rad/s],A=acc[m/s2]")
    np.testing.assert_allclose(recording.time, TIME)


@pytest.mark.parametrize(
    ("arrays", "reason"),
    [
        ({"gyr": GYR, "acc": ACC[:-1], "time": TIME}, "acc_x has 49 rows, gyr has 50"),
        ({"gyr": GYR[:, :2], "acc": ACC, "time": TIME}, r"array 'gyr' has shape \(50, 2\), expected \(n, 3\)"),
        ({"gyr": GYR, "acc": ACC}, "no time column"),
        ({"stuff": GYR}, "no sensor among its arrays"),
        ({"gyr": GYR[:0], "acc": ACC[:0], "fs": 100.0}, "no rows|shape"),
        ({"gyr": GYR, "acc": ACC, "fs": 0.0}, "rate"),
        ({"gyr": GYR, "acc": ACC, "fs": np.nan}, "rate"),
    ],
)
def test_npz_that_does_not_fit(tmp_path, arrays, reason):
    np.savez(tmp_path / "a.npz", **arrays)
    with pytest.raises(FormatError, match=reason):
        read(tmp_path / "a.npz", units=UNITS)


class Bomb:
    """Leaves a file behind when it is unpickled."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self):
        return (open, (str(self.path), "w"))


@pytest.mark.parametrize("name", ["evil.npz", "evil.npy", "evil.pkl", "evil.csv"])
def test_nothing_is_ever_unpickled(tmp_path, name):
    sign, path = tmp_path / "sign", tmp_path / name
    if name == "evil.npz":
        np.savez(path, gyr=np.array([Bomb(sign)], object), acc=ACC, time=TIME, allow_pickle=True)
    elif name == "evil.npy":
        np.save(path, np.array([Bomb(sign)], object), allow_pickle=True)
    else:
        path.write_bytes(pickle.dumps(Bomb(sign)))
    with pytest.raises(FormatError):
        read(path)
    assert not sign.exists()


def member(shape: str, data: bytes = b"", descr: str = "<f8") -> bytes:
    header = f"{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}".ljust(117).encode() + b"\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + data


@pytest.mark.parametrize(
    "content",
    [
        member("(1000000000, 3)", b"\0" * 24),
        member("(-1, 3)", b"\0" * 24),
        member("(10**30, 3)"),
        member("(1, 3)", b"\0" * 2400),
        member("(3, 1)", b"\0" * 24, "|O"),
        member("(" + "9" * 5000 + ",)"),
        member("__import__('os').system('true')"),
        b"\x93NUMPY\x09\x00" + b"\0" * 100,
        b"\x93NUMPY\x02\x00" + b"\xff" * 4 + b" " * 1000,
        member("(3, 1), 'x': '''"),
        member("(" * 60 + "3" + ")" * 60),
        member("(1, 3)", b"\0" * 24, "<f99999999"),
        member("(1" + " " * 30_000 + ", 3)", b"\0" * 24),
        b"not numpy at all",
        b"",
    ],
)
def test_npz_with_lying_headers(tmp_path, content):
    path = tmp_path / "a.npz"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("gyr.npy", content)
    with pytest.raises(FormatError):
        read(path)


def test_archives_that_are_not_npz(tmp_path):
    path = tmp_path / "a.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("../../etc/evil.csv", "1,2,3")
    with pytest.raises(FormatError, match="a zip archive of 1 files; unpack it"):
        read(path)
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["a.zip"]


def bounded(path: Path, memory: int = 1100) -> tuple[str, float, float]:
    """Read *path* in a process with an address limit (MiB): the outcome, its seconds and its peak memory (MiB)."""
    script = (
        "import resource, sys, time\n"
        f"resource.setrlimit(resource.RLIMIT_AS, ({memory} << 20,) * 2)\n"
        "import poise.formats as f, poise.errors as e\n"
        "start = time.perf_counter()\n"
        "try: print('read', len(f.read(sys.argv[1])))\n"
        "except e.PoiseError as problem: print('refused', problem)\n"
        "print(time.perf_counter() - start)\n"
        "own = int(open('/proc/self/status').read().split('VmHWM:')[1].split()[0])\n"
        "print(max(own, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss) / 1024)"
    )
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, "-c", script, str(path)], capture_output=True, text=True, env=environment, check=False
    )
    assert done.returncode == 0, done.stderr
    *outcome, seconds, memory_used = done.stdout.strip().splitlines()
    return " ".join(outcome), float(seconds), float(memory_used)


def element(kind: int, data: bytes) -> bytes:
    return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)


def matrix(name: str, rows: int, columns: int, data: bytes, flags: int = 6, kind: int = 9) -> bytes:
    parts = element(6, struct.pack("<II", flags, 0)) + element(5, struct.pack("<ii", rows, columns))
    return element(14, parts + element(1, name.encode()) + element(kind, data))


MAT = b"MATLAB 5.0 MAT-file".ljust(116) + b"\0" * 8 + b"\x00\x01IM"


def hostile(kind: str, path: Path) -> None:
    if kind == "npz bomb":
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("gyr.npy", "w") as stream:
            stream.write(member("(20000000, 3)"))
            for _ in range(480):
                stream.write(b"\0" * 1_000_000)
    elif kind == "one line of 50 MB":
        path.write_bytes(b"time,gx,gy,gz,ax,ay,az\n0,1,2,3,4,5,6\n" + b"1" * 50_000_000)
    elif kind == "first line of 50 MB":
        path.write_bytes(b"1," * 25_000_000)
    elif kind == "mat bomb":
        packer = zlib.compressobj(1)
        start = matrix("gyr", 100_000_000, 1, b"")[:-8] + struct.pack("<II", 9, 800_000_000)
        packed = packer.compress(start[:4] + struct.pack("<I", 800_000_056) + start[8:])
        packed += b"".join(packer.compress(bytes(1_000_000)) for _ in range(800)) + packer.flush()
        path.write_bytes(MAT + element(15, packed))
    elif kind == "mat lying dimensions":
        path.write_bytes(MAT + matrix("gyr", 2**31 - 1, 2**31 - 1, b"\0" * 24))
    elif kind == "mat lying length":
        path.write_bytes(MAT + struct.pack("<II", 14, 2**32 - 8) + matrix("gyr", 1, 3, b"\0" * 24)[8:])
    elif kind == "mat crafted tags":
        good = matrix("gyr", 1, 3, b"\0" * 24)
        path.write_bytes(MAT + good.replace(struct.pack("<II", 9, 24), struct.pack("<II", 0xFFFF0009, 0xFFFFFFF0)))
    elif kind == "mat nested cells":
        inner = matrix("", 1, 1, b"", 1)
        for _ in range(3000):
            inner = element(14, inner[8:48] + inner)
        path.write_bytes(MAT + inner)


@pytest.mark.parametrize(
    "kind",
    [
        "npz bomb",
        "one line of 50 MB",
        "first line of 50 MB",
        "mat bomb",
        "mat lying dimensions",
        "mat lying length",
        "mat crafted tags",
        "mat nested cells",
    ],
)
def test_hostile_files_are_refused_in_time_and_memory(tmp_path, kind):
    path = tmp_path / "a.bin"
    hostile(kind, path)
    outcome, seconds, memory = bounded(path)
    assert outcome.startswith(f"refused {path}"), outcome
    assert seconds < 5 and memory < 300, (outcome, seconds, memory)


def test_mat_structs_and_names(tmp_path):
    from scipy.io import savemat

    path = tmp_path / "a.mat"
    savemat(path, {"data": {"gyr": GYR, "acc": ACC, "mag": MAG, "note": "hello"}, "fs": 100.0, "other": {"a": 1}})
    recording = read(path, units=UNITS)
    np.testing.assert_array_equal(recording.gyr, GYR)
    assert sniff(path, units=UNITS).columns["gyr_x"] == "gyr_x"
    with pytest.raises(FormatError, match=r"rows, more|50 rows"):
        read(path, units=UNITS, limits=Limits(rows=10))


def test_mat_child_keeps_its_hands_off_the_package(tmp_path):
    from poise.formats import bounded, mat

    limits = [str(1 << 30), "4"]
    listed = subprocess.run(
        [sys.executable, "-P", "-X", "importtime", bounded.CHILD, mat._SCRIPT, *limits, tmp_path / "none"],
        capture_output=True,
        check=False,
        text=True,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
    )
    assert listed.returncode == 1 and "FileNotFoundError" in listed.stderr
    assert not any(name in listed.stderr for name in ("poise", "numba", "pyarrow"))


def test_benchmark_file():
    path = data_path("broad", "01_undisturbed_slow_rotation_A.mat")
    start = clock.perf_counter()
    recording = read(path)
    assert clock.perf_counter() - start < 5  # typically 0.5 s, most of it the child's imports
    assert len(recording) == 56_940 and recording.rate_hz == pytest.approx(285.714, abs=0.01)
    np.testing.assert_array_equal(recording.time, np.arange(56_940) / 285.71428571428572, strict=True)
    assert recording.truth is not None and recording.moving is not None and recording.has_mag
    seen = np.isfinite(recording.truth.quat).all(axis=1)
    assert 0.5 < seen.mean() < 1 or seen.all()
    np.testing.assert_allclose(np.linalg.norm(recording.truth.quat[seen], axis=1), 1, atol=1e-12)
    assert 0 < recording.moving.mean() < 1
    assert np.median(np.linalg.norm(recording.mag, axis=1)) == pytest.approx(45, abs=20)


def test_mat_v73_is_refused_with_advice(tmp_path):
    path = tmp_path / "a.mat"
    path.write_bytes(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(512) + b"\x89HDF\r\n\x1a\n")
    with pytest.raises(FormatError, match=r"v7.3.*'-v7'"):
        read(path)


def test_parquet_foreign(tmp_path):
    import pyarrow as pa
    from pyarrow import parquet

    path = tmp_path / "a.bin"
    columns = {"timestamp": pa.array((TIME * 1e6).astype(np.int64), pa.timestamp("us"))}
    columns |= {f"gyro_{axis} [dps]": pa.array(GYR[:, i]) for i, axis in enumerate("xyz")}
    columns |= {
        f"acc_{axis} (g)": pa.array(ACC[:, i] / 9.80665, mask=np.arange(N) % 7 == 3) for i, axis in enumerate("xyz")
    }
    columns |= {"label": pa.array(["walk"] * N)}
    parquet.write_table(pa.table(columns), path)
    recording = read(path)
    np.testing.assert_allclose(recording.time, TIME, atol=1e-9)
    np.testing.assert_allclose(recording.gyr, np.deg2rad(GYR), rtol=1e-15)
    assert np.isnan(recording.acc[3]).all() and not recording.has_mag
    with pytest.raises(FormatError, match=r"50 rows.*Limits\(rows="):
        read(path, limits=Limits(rows=49))
    columns["acc_x (g)"] = pa.array(["1"] * N)
    parquet.write_table(pa.table(columns), path)
    with pytest.raises(FormatError, match=r"column 'acc_x \(g\)' \(acc_x\) holds string, expected numbers"):
        read(path)


def test_parquet_that_unpacks_to_too_much(tmp_path):
    import pyarrow as pa
    from pyarrow import parquet

    path = tmp_path / "a.parquet"
    zero = pa.array(np.zeros(2_000_000))
    names = ["time (s)", *(f"{sensor}_{axis}" for sensor in ("gyr", "acc") for axis in "xyz")]
    parquet.write_table(pa.table(dict.fromkeys(names, zero)), path, compression="zstd")
    with pytest.raises(FormatError, match="decompression bomb"):
        read(path)


@pytest.mark.parametrize(
    ("head", "reason"),
    [
        (b"\x89HDF\r\n\x1a\n", "an HDF5 file; export"),
        (b"ULog\x01\x12\x35", "a PX4 ULog; export"),
        (b"\x1f\x8b\x08\0", "gzip data; unpack it first"),
        (b"%PDF-1.7\n", "a PDF document; poise reads CSV"),
        (b"\x89PNG\r\n\x1a\n", "a PNG image"),
        (b"<!DOCTYPE html>", "a web page"),
        (bytes(range(256)) * 20, "binary data of no kind that is known"),
        (b"PAR1" + b"\0" * 40, "damaged Parquet file"),
        (b"PK\x03\x04" + b"\0" * 40, "damaged zip or npz"),
        (MAT[:60], "MATLAB"),
    ],
)
def test_other_kinds_are_named(tmp_path, head, reason):
    path = tmp_path / "data.csv"
    path.write_bytes(head)
    with pytest.raises(FormatError, match=reason):
        read(path)


def test_what_is_no_file(tmp_path):
    fifo = tmp_path / "fifo"
    os.mkfifo(fifo)
    for path, reason in [
        (tmp_path, "a folder"),
        (fifo, "a device or pipe"),
        (Path("/dev/zero"), "a device or pipe"),
        (tmp_path / "none.csv", "No such file"),
        (tmp_path / ("x" * 300), "cannot be opened"),
        (Path("a\0b"), "cannot be opened"),
    ]:
        with pytest.raises(FormatError, match=reason) as caught:
            read(path)
        assert str(caught.value).startswith(str(path))


def test_import_is_light():
    script = (
        "import sys, poise.formats; print([m for m in ('pyarrow', 'scipy', 'pandas', 'numba') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    alone = subprocess.run(
        [sys.executable, "-c", script.replace("poise.formats", "poise.data.recording")],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == alone.stdout and "pyarrow" not in done.stdout


def damaged(content: bytes, seed: int) -> bytes:
    rng = np.random.default_rng(seed)
    if seed % 2:
        return content[: rng.integers(len(content))]
    flipped = bytearray(content)
    for _ in range(rng.choice([1, 3, 30])):
        flipped[rng.integers(len(flipped))] = rng.integers(256)
    return bytes(flipped)


@pytest.mark.parametrize(
    ("kind", "count"), [("npz", 150), ("packed npz", 150), ("parquet", 150), ("mat", 8), ("packed mat", 8)]
)
def test_damaged_files_are_read_or_refused(tmp_path, kind, count):
    import pyarrow as pa
    from pyarrow import parquet
    from scipy.io import savemat

    buffer, arrays = io.BytesIO(), {"time": TIME, "gyr": GYR, "acc": ACC, "mag": MAG}
    if "npz" in kind:
        (np.savez_compressed if "packed" in kind else np.savez)(buffer, **arrays)
    elif "mat" in kind:
        savemat(buffer, arrays, do_compression="packed" in kind)
    else:
        parquet.write_table(pa.table({"t (s)": TIME} | {f"{s}{a}": GYR[:, 0] for s in "gam" for a in "xyz"}), buffer)
    path = tmp_path / "a.bin"
    for seed in range(count):
        path.write_bytes(damaged(buffer.getvalue(), seed))
        try:
            read(path, units=UNITS)
        except FormatError as problem:
            assert str(problem).startswith(str(path))
