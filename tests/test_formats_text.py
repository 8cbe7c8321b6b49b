"""Text tables: every quirk is read right, or refused with file, line, column and reason."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from data_files import data_path
from poise.errors import FormatError
from poise.formats import Limits, read, sniff

HEADER = "time (s),gx (rad/s),gy,gz,ax (m/s2),ay,az,mx (uT),my,mz\n"
NAMES = "time,gx[rad/s],gy,gz,ax[m/s2],ay,az,mx[uT],my,mz"
ROWS = "".join(f"{i * 0.01:.2f},0.5,{i}.25,-3e-1,0.5,-0.25,9.75,20.5,1.5,-40\n" for i in range(20))


@pytest.fixture
def made(tmp_path: Path):
    """Write text or bytes to a file and return its path."""

    def write(content: str | bytes, name: str = "log.dat") -> Path:
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return write


def expect(recording, rows: int = 20) -> None:
    np.testing.assert_array_equal(recording.time, [float(f"{i * 0.01:.2f}") for i in range(rows)])
    np.testing.assert_array_equal(recording.gyr, [[0.5, i + 0.25, -0.3] for i in range(rows)])
    np.testing.assert_array_equal(recording.acc, [[0.5, -0.25, 9.75]] * rows)
    np.testing.assert_array_equal(recording.mag, [[20.5, 1.5, -40]] * rows)


GERMAN = (HEADER + ROWS).replace(",", ";").replace(".", ",")
SAME = {
    "plain": HEADER + ROWS,
    "crlf": (HEADER + ROWS).replace("\n", "\r\n"),
    "cr": (HEADER + ROWS).replace("\n", "\r"),
    "mixed": HEADER + ROWS.replace("\n", "\r\n", 5),
    "bom": "\ufeff" + HEADER + ROWS,
    "utf-16": (HEADER + ROWS).encode("utf-16"),
    "utf-16-be": b"\xfe\xff" + (HEADER + ROWS).encode("utf-16-be"),
    "cp1252": (HEADER.replace("uT", "µT").replace("m/s2", "m/s²") + ROWS).encode("cp1252"),
    "semicolon": (HEADER + ROWS).replace(",", ";"),
    "decimal comma": GERMAN,
    "decimal comma, tabs": GERMAN.replace(";", "\t"),
    "quoted decimal comma": "\n".join(",".join(f'"{cell}"' for cell in line.split(";")) for line in GERMAN.splitlines())
    + "\n",
    "tab": (HEADER + ROWS).replace(",", "\t"),
    "bar": (HEADER + ROWS).replace(",", "|"),
    "blanks": (HEADER.replace(" (", "(") + ROWS).replace(",", "   "),
    "leading blanks": "  " + (HEADER.replace(" (", "(") + ROWS).replace(",", " ").replace("\n", " \n "),
    "blanks after commas": (HEADER + ROWS).replace(",", ", "),
    "sep line": "sep=;\n" + (HEADER + ROWS).replace(",", ";"),
    "comments": "# made by hand\n// x\n% y\n\n" + HEADER + "# between\n" + ROWS + "\n# after\n# end",
    "header in a comment": "# " + HEADER.replace(" (", "(").replace(",", " ") + ROWS.replace(",", " "),
    "title lines": "Logger 3000\nmade today\n" + HEADER + ROWS,
    "unit line": "time,gx,gy,gz,ax,ay,az,mx,my,mz\ns,rad/s,rad/s,rad/s,m/s²,m/s²,m/s²,µT,µT,µT\n" + ROWS,
    "quoted header": ",".join(f'"{name}"' for name in HEADER.strip().split(",")) + "\n" + ROWS,
    "trailing commas": HEADER + ROWS.replace("\n", ",\n"),
    "other columns": "label," + HEADER + "".join(f"walk {i},{row}\n" for i, row in enumerate(ROWS.splitlines())),
    "empty lines": HEADER + ROWS.replace("\n", "\n\n"),
    "no last line break": (HEADER + ROWS).rstrip("\n"),
}


@pytest.mark.parametrize("quirk", SAME)
def test_reads_the_same_from_every_way_to_write_it(made, quirk):
    expect(read(made(SAME[quirk])))


def test_content_decides_not_the_extension(made):
    expect(read(made(HEADER + ROWS, "log.parquet")))


@pytest.mark.parametrize("columns", [NAMES, NAMES.split(",")])
def test_no_header_needs_columns(made, columns):
    path = made(ROWS)
    with pytest.raises(FormatError, match=r"10 columns without a header; say what they are: --columns"):
        read(path)
    expect(read(path, columns=columns))


def test_columns_replace_or_rename_the_header(made):
    path = made(HEADER.replace("time", "zeit").replace("gx", "drehrate_1") + ROWS)
    expect(read(path, columns=NAMES))
    expect(read(path, columns="zeit (s)=time[s],drehrate_1 (rad/s)=gyr_x[rad/s]"))
    with pytest.raises(FormatError, match="names 2 columns, the file has 10"):
        read(path, columns="time,gx")
    with pytest.raises(FormatError, match="'bla' not understood"):
        read(path, columns=NAMES.replace("mz", "bla"))
    with pytest.raises(FormatError, match="no column 'nix'"):
        read(path, columns="nix=time")
    skipped = read(path, columns="time,gx[rad/s],gy,gz,ax[m/s2],ay,az,-,-,-")
    assert not skipped.has_mag and "no magnetometer: heading is arbitrary" in skipped.notes


BAD = {
    "ragged": (HEADER + ROWS + "0.2,1,2\n", r"line 22: 3 cells, expected 10"),
    "too many": (HEADER + ROWS + "0.2" + ",1" * 12 + "\n", r"line 22: 13 cells, expected 10"),
    "text": (
        HEADER + ROWS + "0.2,1,2,oops,4,5,6,7,8,9\n" + ROWS,
        r"line 22, column 4 \(gz\): found 'oops', expected a number",
    ),
    "two logs": (HEADER + ROWS + HEADER + ROWS, "line 22: text where numbers were expected.*a second log begins"),
    "two kinds of log": (HEADER + ROWS + "a,b,c,d\n1,2,3,4\n", "line 22: .*(second log|4 cells)"),
    "nul": ((HEADER + ROWS).encode() + b"\0" * 300, "line 22: NUL bytes"),
    "header only": (HEADER, "line 1 names columns, but no row of numbers follows"),
    "header twice as long": (HEADER.strip() + ",a,b,c\n" + ROWS, "line 2 has 10 cells, the header above it names 13"),
    "prose": ("It was a dark night.\nThe storm, however, raged.\n", "no rows of numbers found"),
    "thousands": (HEADER + ROWS.replace("9.75", "9'75", 1), r"line 2, column 7 \(az\): found \"9'75\""),
    "late decimal comma": (
        (HEADER + "0,0,0,0,0,0,10,0,0,0\n" * 80 + "0,0,0,0,0,0,9.75,0,0,0\n").replace(",", ";").replace(".", ","),
        r'line 82, column 7.*say --decimal ","',
    ),
    "quote never closed": (HEADER + ROWS + '0.2,"1,2,3,4,5,6,7,8,9\n' + ROWS, "line 22"),
    "no gyroscope": ("time (s),ax,ay,az\n0,1,2,3\n", "no column for gyr_x, gyr_y, gyr_z among"),
    "no time": (HEADER.replace("time (s)", "n") + ROWS, "no time column .*--rate HZ"),
    "two claims": ("time,gx,gy,gz,gyro_x,ax,ay,az\n0,1,2,3,4,5,6,7\n", "both claim to be gyr_x; pick with --columns"),
    "two units": ("time,gx (deg/s),gy (rad/s),gz,ax,ay,az\n0,1,2,3,4,5,6\n", "columns of gyr name different units"),
    "strange unit": (HEADER.replace("rad/s", "furlong") + ROWS, "unit 'furlong' of gyr not understood"),
    "empty": (b"", "the file is empty"),
    "long line": (HEADER + ROWS + "1" * 70_000 + "\n", "line 22: 70,000 bytes in one line, the limit is 65,536"),
}


@pytest.mark.parametrize("quirk", BAD)
def test_refuses_with_file_line_and_reason(made, quirk):
    content, reason = BAD[quirk]
    path = made(content)
    with pytest.raises(FormatError, match=reason) as caught:
        read(path)
    assert str(caught.value).startswith(str(path))


@pytest.mark.parametrize("end", ["0.20,0.5", "0.20,0.5,1,1,1,1,9.75,1,1,-", "0.20,0.5,1,1,1,1,9.75,1,1,1e"])
def test_cut_last_row_is_left_out_and_said(made, end):
    recording = read(made(HEADER + ROWS + end))
    expect(recording)
    assert any("line 22: the last row is cut short" in note for note in recording.notes)


def test_whole_last_row_without_line_break_is_doubted(made):
    assert any("does not end with a line break" in doubt for doubt in sniff(made(HEADER + ROWS.rstrip())).doubts)


def test_every_truncation_reads_whole_rows_or_refuses(made):
    content = HEADER + ROWS
    for cut in range(0, len(content), 7):
        try:
            recording = read(made(content[:cut]))
        except FormatError:
            assert cut <= len(HEADER) + 60
            continue
        whole = content[:cut].count("\n") - 1
        assert whole <= len(recording) <= whole + 1


def test_missing_cells_are_nan_and_rows_stay(made):
    rows = "0.00,1,2,3,,,,NaN,nan,NA\n0.01,,,,0.1,0.2,9.8,inf,-inf,null\n0.02,+1, 2 ,3e0,0.1,0.2,9.8,1,2,3\n"
    recording = read(made(HEADER + rows))
    assert len(recording) == 3
    assert np.isnan(recording.acc[0]).all() and np.isnan(recording.mag[0]).all() and np.isnan(recording.gyr[1]).all()
    np.testing.assert_array_equal(recording.gyr[2], [1, 2, 3])


@pytest.mark.parametrize(
    ("stamps", "origin"),
    [
        ("2024-01-01T00:00:00.{:03d}Z", 1704067200),
        ("2024-01-01 00:00:00.{:03d}", 1704067200),
        ("2024-01-01T02:00:00.{:03d}+02:00", 1704067200),
        ("1704067200{:03d}", 1704067200),
        ("1704067200{:03d}000000", 1704067200),
    ],
)
def test_calendar_and_epoch_stamps(made, stamps, origin):
    text = HEADER.replace("time (s)", "timestamp")
    text += "".join(f"{stamps.format(i * 10)},0.1,0,0,0,0,9.8,1,2,3\n" for i in range(50))
    np.testing.assert_allclose(read(made(text)).time, origin + np.arange(50) / 100, atol=3e-7, rtol=0)


HEADERS = {
    "x-io": "Time (s),Gyroscope X (deg/s),Gyroscope Y (deg/s),Gyroscope Z (deg/s),Accelerometer X (g),"
    "Accelerometer Y (g),Accelerometer Z (g),Magnetometer X (uT),Magnetometer Y (uT),Magnetometer Z (uT)",
    "ros": "time [s],angular_velocity.x,angular_velocity.y,angular_velocity.z,linear_acceleration.x,"
    "linear_acceleration.y,linear_acceleration.z,magnetic_field.x,magnetic_field.y,magnetic_field.z",
    "rostopic": "%time,field.angular_velocity.x,field.angular_velocity.y,field.angular_velocity.z,"
    "field.linear_acceleration.x,field.linear_acceleration.y,field.linear_acceleration.z,mx,my,mz",
    "snake": "time_s,gyr_x_deg_s,gyr_y_deg_s,gyr_z_deg_s,acc_x_g,acc_y_g,acc_z_g,mag_x_uT,mag_y_uT,mag_z_uT",
    "camel": "Timestamp,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,MagX,MagY,MagZ",
    "brackets": "t [s],gyro.x [dps],gyro.y [dps],gyro.z [dps],acc.x [m/s^2],acc.y [m/s^2],acc.z [m/s^2],"
    "compass_x [mG],compass_y [mG],compass_z [mG]",
    "letters": "t,wx,wy,wz,ax,ay,az,mx,my,mz",
    "iphone": "timestamp,gyroRotationX(rad/s),gyroRotationY(rad/s),gyroRotationZ(rad/s),"
    "accelerometerAccelerationX(G),accelerometerAccelerationY(G),accelerometerAccelerationZ(G),"
    "magnetometerX(µT),magnetometerY(µT),magnetometerZ(µT)",
    "g-force": "time,wx,wy,wz,gFx,gFy,gFz,Bx,By,Bz",
}


@pytest.mark.parametrize("tool", HEADERS)
def test_names_that_tools_use(made, tool):
    rows = "".join(f"{i * 0.01:.2f},0.5,0.25,0.1,0,0,1,20,1,-40\n" for i in range(20))
    units = {"time": "s", "gyr": "deg/s", "acc": "g"}
    sniffed = sniff(made(HEADERS[tool] + "\n" + rows), units=units)
    wanted = ["time", *(f"{sensor}_{axis}" for sensor in ("gyr", "acc") for axis in "xyz")]
    names = HEADERS[tool].split(",")
    assert [sniffed.columns[key] for key in wanted] == [name.lstrip("%") for name in names[:7]]
    assert tool == "g-force" or [sniffed.columns[f"mag_{axis}"] for axis in "xyz"] == names[7:]


@pytest.mark.parametrize("name", ["Linear Acceleration {} (m/s^2)", "userAcceleration{}", "linearAcceleration.{}"])
def test_gravity_free_acceleration_is_refused_alone_and_ignored_beside_specific_force(made, name):
    free = [name.format(axis) for axis in "xyz"]
    row = "0.00,0.1,0.1,0.1,0.1,0.1,0.1,0,0,9.8\n"
    alone = made(f"time (s),gx (rad/s),gy,gz,{','.join(free)},a,b,c\n" + row)
    with pytest.raises(FormatError, match=r"only acceleration without gravity.*raw or total"):
        read(alone)
    both = read(made(f"time (s),gx (rad/s),gy,gz,{','.join(free)},ax,ay,az\n" + row))
    np.testing.assert_array_equal(both.acc, [[0, 0, 9.8]])
    assert any("gravity-free acceleration" in note for note in both.notes)


def test_xsens_earth_frame_acceleration_is_gravity_free(made):
    with pytest.raises(FormatError, match="only acceleration without gravity"):
        read(made("time (s),Gyr_X,Gyr_Y,Gyr_Z,FreeAcc_E,FreeAcc_N,FreeAcc_U\n0,1,2,3,4,5,6\n"))


def test_truth_only_where_it_is_named_so(made):
    header = HEADER.strip() + ",{0}w,{0}x,{0}y,{0}z\n"
    rows = ROWS.replace("\n", ",0,1,0,0\n")
    truth = read(made(header.format("truth_q") + rows)).truth
    np.testing.assert_array_equal(truth.quat, [[0, 1, 0, 0]] * 20)
    own = read(made(header.format("q") + rows))
    assert own.truth is None and any("orientation (quaternion) is ignored" in note for note in own.notes)


def test_options_that_make_no_sense(made):
    path = made(HEADER + ROWS)
    for options, reason in [
        ({"delimiter": "abc"}, "--delimiter 'abc' not understood"),
        ({"decimal": "x"}, "--decimal 'x' not understood"),
        ({"units": {"gyro": "deg/s"}}, "expected one of time, gyr, acc, mag"),
        ({"units": {"gyr": "knots"}}, "unit 'knots' of gyr not understood; expected one of rad/s, deg/s"),
        ({"rate": 0.0}, "a rate of 0.0 samples per second"),
        ({"rate": -1.0}, "a rate of -1.0 samples per second"),
        ({"rate": float("nan")}, "a rate of nan samples per second"),
        ({"delimiter": ";"}, "no rows of numbers|no row of numbers"),
    ]:
        with pytest.raises(FormatError, match=reason):
            read(path, **options)
    expect(read(path, delimiter="comma", decimal="."))


def test_rate_instead_of_stamps(made):
    path = made(HEADER.replace("time (s)", "sample") + ROWS)
    np.testing.assert_array_equal(read(path, rate=50).time, np.arange(20) / 50)
    ignored = read(made(HEADER + ROWS), rate=50)
    assert ignored.rate_hz == pytest.approx(50) and any("own stamps are ignored" in note for note in ignored.notes)


def test_limits_are_named_and_settable(made):
    path = made(HEADER + ROWS)
    for limit, reason in [("rows", "20 rows"), ("columns", "10 columns"), ("size", "bytes"), ("line", "one line")]:
        with pytest.raises(FormatError, match=rf"{reason}.*Limits\({limit}="):
            read(path, limits=Limits(**{limit: 9}))


def test_many_blocks(made):
    rows = "".join(f"{i * 0.01:.2f},0.5,{i % 100}.25,-0.3,0.5,-0.25,9.75,20.5,1.5,-40\n" for i in range(200_000))
    recording = read(made(HEADER + rows))
    assert len(recording) == 200_000
    np.testing.assert_array_equal(recording.gyr[:, 1], np.arange(200_000) % 100 + 0.25)
    damaged = rows.replace("1999.00,0.5", "1999.00,o.5")
    with pytest.raises(FormatError, match=r"line 199902, column 2 \(gx \(rad/s\)\): found 'o.5'"):
        read(made(HEADER + damaged))


def test_real_file():
    path = data_path("other", "x-io_fusion_sensor_data.csv")
    recording, sniffed = read(path), sniff(path)
    assert len(recording) == 13_514 and recording.duration == pytest.approx(135.3, abs=0.1)
    assert np.median(np.linalg.norm(recording.acc, axis=1)) == pytest.approx(9.8, abs=0.1)
    assert recording.gyr[1, 0] == pytest.approx(np.deg2rad(0.01654156), rel=1e-15)
    assert recording.source == str(path) and recording.name == "x-io_fusion_sensor_data"
    assert len(recording.source_hash) == 64
    assert sniffed.rate_hz == pytest.approx(99.2, abs=0.1) and sniffed.sensors["gyr"].unit == "deg/s"
    assert any("mag: slower than the gyroscope" in note for note in sniffed.notes)
    assert np.isfinite(recording.mag[:, 0]).mean() == pytest.approx(0.2, abs=0.02)
    assert recording.notes == sniffed.notes + sniffed.doubts


def test_a_held_slower_sensor_counts_once(made):
    """A magnetometer at a fifth of the rate, repeated; then at rest on a coarse grid, where it never changes."""
    n = 1000
    slow = np.repeat(np.round(30 * np.sin(np.arange(n // 5) * 0.3), 2), 5)
    slow[600:] = slow[600]
    rows = "".join(
        f"{i * 0.01:.2f},{i % 7}.5,{i % 11}.25,-0.3,0.5,-0.25,9.{i % 97:02d},{slow[i]:.2f},1.5,-40\n" for i in range(n)
    )
    recording = read(made(HEADER + rows))
    rows_with_mag = np.flatnonzero(np.isfinite(recording.mag[:, 0]))
    np.testing.assert_array_equal(rows_with_mag, np.arange(0, n, 5))
    assert np.isfinite(recording.acc).all()
