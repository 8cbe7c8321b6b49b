"""Which column is what: by words, by units, and what is said of the others."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from poise.errors import FormatError
from poise.formats import read, read_chunks, sniff

USUAL = "time (s),gx (rad/s),gy,gz,ax (m/s2),ay,az"
Writer = Callable[..., Path]


@pytest.fixture
def made(tmp_path: Path) -> Writer:
    """Write a table with *header*: time, gyr, acc and then *more* columns, one number or text each."""

    def write(header: str, *more: object, rows: int = 20) -> Path:
        path = tmp_path / "log.csv"
        lines = [
            ",".join([f"{i * 0.01:.2f}", "0.5", f"{i}.25", "-0.3", "0.5", "-0.25", "9.75", *map(str, more)])
            for i in range(rows)
        ]
        path.write_text("\n".join([header, *lines, ""]))
        return path

    return write


@pytest.mark.parametrize("names", ["hx,hy,hz", "magneto_1,magneto_2,magneto_3", "Roll,Pitch,Yaw", "device_id,label,n"])
def test_what_is_not_used_is_said(made: Writer, names: str) -> None:
    path = made(f"{USUAL},{names}", 1, 2, 3)
    notes = read(path).notes
    assert notes[-2:] == ("no magnetometer: heading is arbitrary", f"not used: {names.replace(',', ', ')}")
    assert sniff(path).notes == notes
    skipped = read(path, columns=",".join(f"{name}=-" for name in names.split(",")))
    assert not any("not used" in note for note in skipped.notes)  # the caller knows


def test_of_many_that_are_not_used_some_are_named(made: Writer) -> None:
    names = [f"extra{i}" for i in range(30)]
    assert read(made(f"{USUAL},{','.join(names)}", *range(30))).notes[-1].endswith("extra11 and 18 more")


def test_what_is_said_of_a_column_is_said_once(made: Writer) -> None:
    header = f"{USUAL},elapsed,linear_acceleration_x,linear_acceleration_y,linear_acceleration_z,qw,qx,qy,qz"
    assert not any("not used" in note for note in read(made(header, *range(8))).notes)


def test_arrays_that_are_not_used_are_said(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    rows = np.tile([0.0, 0.0, 9.8], (50, 1))
    np.savez(path, time=np.arange(50) / 100, gyr=rows, acc=rows, pressure=np.ones(50), count=7)
    assert read(path, units={"gyr": "rad/s"}).notes[-1] == "not used: pressure, count"


@pytest.mark.parametrize("unit", ["uT", "µT", "gauss", "mG", "nT"])
@pytest.mark.parametrize("names", [("Bx", "By", "Bz"), ("field_z", "field_y", "field_x")])
def test_a_unit_that_only_magnetometers_have(made: Writer, names: tuple[str, ...], unit: str) -> None:
    recording = read(made(f"{USUAL},{','.join(f'{name} ({unit})' for name in names)}", 20, 1, -40))
    factor = {"gauss": 100, "mG": 0.1, "nT": 1e-3}.get(unit, 1.0)
    wanted = [20, 1, -40] if names[0] == "Bx" else [-40, 1, 20]
    np.testing.assert_allclose(recording.mag, np.tile(wanted, (20, 1)) * factor)
    assert any(note.startswith("mag: columns ") and note.endswith("known by their unit") for note in recording.notes)


@pytest.mark.parametrize(
    "names",
    [
        "Bx (uT),By (uT),Bz (uT),Cx (uT),Cy (uT),Cz (uT)",  # which of the two?
        "bias_x (uT),bias_y (uT),bias_z (uT)",
        "Bx (uT),By (uT),Bw (uT)",
        "Bx (uT),By (mT),Bz (uT)",
        "Bx (uT),n,By (uT),Bz (uT)",
        "hx (G),hy (G),hz (G)",  # gauss, or g
    ],
)
def test_a_unit_that_settles_nothing(made: Writer, names: str) -> None:
    recording = read(made(f"{USUAL},{names}", *range(names.count(",") + 1)))
    assert not recording.has_mag and recording.notes[-1] == f"not used: {names.replace(',', ', ')}"


def test_gravity_is_no_accelerometer(made: Writer) -> None:
    header = "time (s),gx (rad/s),gy,gz,gravity_x (m/s2),gravity_y (m/s2),gravity_z (m/s2)"
    with pytest.raises(FormatError, match="no column for acc_x, acc_y, acc_z"):
        read(made(header))


def test_names_in_a_comment_that_only_units_explain(made: Writer) -> None:
    axes = [f"{letter}_RS_S_{axis} [{unit}]" for letter, unit in (("w", "rad s^-1"), ("a", "m s^-2")) for axis in "xyz"]
    path = made(f"#timestamp [s],{','.join(axes)}")
    recording, sniffed = read(path), sniff(path)
    np.testing.assert_array_equal(recording.gyr[3], [0.5, 3.25, -0.3])
    np.testing.assert_array_equal(recording.acc, np.tile([0.5, -0.25, 9.75], (20, 1)))
    assert [sniffed.columns[f"{sensor}_{axis}"] for sensor in ("gyr", "acc") for axis in "xyz"] == axes


@pytest.mark.parametrize("name", ["device", "device_id", "DeviceName", "sensor_id", "tag", "MAC", "node", "imuId"])
def test_several_devices_in_one_file_are_refused(made: Writer, tmp_path: Path, name: str) -> None:
    one = made(f"{USUAL},{name}", "left").read_text()
    path = tmp_path / "two.csv"
    header, _, rows = one.partition("\n")
    other = rows.replace("left", " right ")
    interleaved = "".join(a + b for a, b in zip(rows.splitlines(True), other.splitlines(True), strict=True))
    for content in (rows + other, interleaved):
        path.write_text(f"{header}\n{content}")
        for use in (read, lambda path: list(read_chunks(path, 7))):
            reason = rf"column '{name}' names more than one device \(left, right\).*split the file.*--columns {name}=-"
            with pytest.raises(FormatError, match=reason):
                use(path)
        assert len(read(path, columns=f"{name}=-")) == 40
    path.write_text(f"{header}\n{rows}" + rows.replace("left", ""))
    assert f"not used: {name}" in read(path).notes  # no second one is named


@pytest.mark.parametrize("name", ["activity", "label", "subject", "id", "class", "marker"])
def test_what_names_no_device_may_change(made: Writer, name: str) -> None:
    path = made(f"{USUAL},{name}", "walk")
    path.write_text(path.read_text() + path.read_text().partition("\n")[2].replace("walk", "run"))
    assert len(read(path)) == 40


@pytest.mark.parametrize("value", [str, lambda i: str(i % 7 + 0.5)], ids=["count", "measure"])
def test_a_quantity_is_no_device(made: Writer, value: Callable[[int], str]) -> None:
    path = made(f"{USUAL},node", "NUMBER", rows=200)
    for i in range(200):
        path.write_text(path.read_text().replace("NUMBER", value(i), 1))
    assert len(read(path)) == 200


def test_many_devices_are_several(made: Writer) -> None:
    path = made(f"{USUAL},mac", "NUMBER", rows=200)
    for i in range(200):
        path.write_text(path.read_text().replace("NUMBER", f"aa:{i:02x}", 1))
    with pytest.raises(FormatError, match=r"names more than one device \(aa:00, .* and 194 more\)"):
        read(path)


def test_an_empty_cell_that_says_nan_is_no_device(made: Writer) -> None:
    path = made(f"{USUAL},device_id", "NUMBER", rows=200)
    one = path.read_text()
    for i in range(200):
        one = one.replace("NUMBER", ("nan", "1")[i % 2], 1)
    path.write_text(one)
    assert len(read(path)) == 200
    path.write_text(one.replace(",1\n", ",2\n", 1))
    with pytest.raises(FormatError, match="names more than one device"):
        read(path)


def test_several_devices_in_parquet_and_npz(tmp_path: Path) -> None:
    from pyarrow import csv, parquet

    path = tmp_path / "a.csv"
    names = f"{USUAL},device_id"
    path.write_text(f"{names}\n" + "".join(f"{i / 100},1,2,3,0,0,9.8,{7 + i // 15}\n" for i in range(30)))
    parquet.write_table(csv.read_csv(path), tmp_path / "a.parquet", row_group_size=10)
    rows = np.tile([0.0, 0.0, 9.8], (30, 1))
    np.savez(tmp_path / "a.npz", time=np.arange(30) / 100, gyr=rows, acc=rows, device_id=7 + np.arange(30) // 15)
    for kind in ("csv", "parquet", "npz"):
        with pytest.raises(FormatError, match=r"'device_id' names more than one device \(7, 8\)"):
            read(tmp_path / f"a.{kind}")


def clocks(path: Path, *columns: tuple[str, Callable[[int], float]], rows: int = 40) -> Path:
    """A table of a sensor at rest with the clocks *columns*: name, and stamp by row."""
    lines = [
        ",".join(["0.1", "0", "0", "0", "0", "9.8", *(f"{stamp(i):.12g}" for _, stamp in columns)]) for i in range(rows)
    ]
    names = ",".join(["gx (rad/s),gy,gz,ax (m/s2),ay,az", *(name for name, _ in columns)])
    path.write_text("\n".join([names, *lines, ""]))
    return path


@pytest.mark.parametrize("name", ["millis", "micros", "Timestamp", "elapsed", "SampleTimeFine"])
@pytest.mark.parametrize("letter", ["T", "T (C)", "T(°)"])
def test_a_capital_t_may_be_a_temperature(tmp_path: Path, name: str, letter: str) -> None:
    path = clocks(tmp_path / "a.csv", (letter, lambda i: 25 + i / 10), (name, lambda i: 10_000.0 * i))
    sniffed = sniff(path, units={"time": "us"})
    assert sniffed.columns["time"] == name


def test_a_letter_alone_is_time_unless_its_unit_is_another(tmp_path: Path) -> None:
    for letter in ("t", "T", "T (s)", "t [ms]"):
        scale = 10.0 if "ms" in letter else 0.01
        path = clocks(tmp_path / "a.csv", (letter, lambda i, scale=scale: i * scale))
        assert read(path).rate_hz == pytest.approx(100)
    with pytest.raises(FormatError, match="no time column among"):
        read(clocks(tmp_path / "a.csv", ("T (C)", lambda i: 25 + i / 10)))
    with pytest.raises(FormatError, match="unit 'moons' of time not understood"):
        read(clocks(tmp_path / "a.csv", ("time (moons)", lambda i: i / 100)))


@pytest.mark.parametrize(
    ("step", "unit", "hz"),
    [(35, "100us", 285.7), (100, "100us", 100), (250, "100us", 40), (16_667, "us", 60), (8_333, "us", 120)],
)
def test_xsens_ticks_of_100_microseconds(tmp_path: Path, step: int, unit: str, hz: float) -> None:
    path = clocks(tmp_path / "a.csv", ("SampleTimeFine", lambda i: 5e6 + step * i))
    assert sniff(path).sensors["time"].unit == unit and read(path).rate_hz == pytest.approx(hz, rel=1e-3)
    other = clocks(tmp_path / "b.csv", ("time", lambda i: 35.0 * i))
    assert sniff(other).sensors["time"].unit == "ms"  # no other clock counts so


SHIMMER = [
    "Timestamp_Unix_CAL",
    *[f"{sensor}_{axis}_CAL" for sensor in ("Accel_LN", "Gyro", "Mag") for axis in "XYZ"],
]


def exported(path: Path, columns: list[str], units: list[str], first: str) -> Path:
    """Names that share a device's, a row of units and tabs."""
    names = "\t".join(f"Unit_8A4B_{name}" for name in columns)
    values = ["0.5", "-0.25", "9.75", "1", "2", "3", "0.1", "0.2", "0.3"][: len(columns) - 1]
    rows = ["\t".join([f"{1.7e12 + 10 * i:.6f}", *values]) for i in range(20)]
    head = [first, names, "\t".join(units)] if first else [names]
    path.write_text("\n".join([*head, *rows, ""]))
    return path


@pytest.mark.parametrize("acc", ["m/(s^2)", "m/s^2", "[m/s^2]", "(m/(s^2))"])
@pytest.mark.parametrize("mag", ["local_flux", "uT", ""])
def test_names_that_share_a_devices_above_units(tmp_path: Path, acc: str, mag: str) -> None:
    path = exported(tmp_path / "a.csv", SHIMMER, ["ms", *[acc] * 3, *["deg/s"] * 3, *[mag] * 3], "sep=\t")
    recording, sniffed = read(path), sniff(path)
    np.testing.assert_allclose(recording.time, 1.7e9 + np.arange(20) / 100, atol=1e-6, rtol=0)
    np.testing.assert_array_equal(recording.acc, np.tile([0.5, -0.25, 9.75], (20, 1)))
    np.testing.assert_allclose(recording.gyr, np.tile(np.deg2rad([1, 2, 3]), (20, 1)))
    np.testing.assert_array_equal(recording.mag, np.tile([0.1, 0.2, 0.3], (20, 1)))
    assert sniffed.columns["gyr_x"] == "Unit_8A4B_Gyro_X_CAL (deg/s)"
    assert sniffed.sensors["mag"].unit == ("µT" if mag == "uT" else "as found")


def test_units_in_the_names_and_of_what_is_not_read(tmp_path: Path) -> None:
    units = ["ms", *["m/(s^2)"] * 3, *["deg/s"] * 3]
    columns = [f"{name} ({unit})" for name, unit in zip(SHIMMER, units, strict=False)]
    assert len(read(exported(tmp_path / "a.csv", columns, [], ""))) == 20
    names = [*SHIMMER[:7], "Battery", "State"]
    recording = read(exported(tmp_path / "b.csv", names, [*units, "mV", "no_units"], "sep=\t"))
    assert "not used: Unit_8A4B_Battery (mV), Unit_8A4B_State (no_units)" in recording.notes


def test_of_two_accelerometers_by_their_units_none_is_taken(tmp_path: Path) -> None:
    columns = [*SHIMMER[:7], *[f"Accel_WR_{axis}_CAL" for axis in "XYZ"]]
    units = ["ms", *["m/(s^2)"] * 3, *["deg/s"] * 3, *["m/(s^2)"] * 3]
    path = exported(tmp_path / "a.csv", columns, units, "sep=\t")
    with pytest.raises(FormatError, match="no column for acc_x, acc_y, acc_z among"):
        read(path)
    chosen = ",".join(f"Unit_8A4B_Accel_LN_{axis}_CAL (m/s^2)=acc_{axis.lower()}[m/s2]" for axis in "XYZ")
    assert len(read(path, columns=chosen)) == 20


def test_a_second_device_beside_usual_names_is_not_used(made: Writer) -> None:
    names = [f"left_{name}" for name in ("gx", "gy", "gz", "ax", "ay", "az")]
    recording = read(made(f"{USUAL},{','.join(names)}", *range(6)))
    assert recording.notes[-1] == f"not used: {', '.join(names)}"
