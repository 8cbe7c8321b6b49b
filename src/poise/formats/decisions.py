"""What a file's columns mean, decided once from a sample of its rows: units, rate, held sensors, gravity."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from poise.data.recording import STANDARD_GRAVITY, check_unit_of_time
from poise.data.stamps import Packed, Turns, packed, usual_step
from poise.errors import FormatError
from poise.formats import evidence, units
from poise.formats.evidence import Verdict
from poise.formats.held import usual_distance
from poise.formats.limits import Options
from poise.formats.names import SENSORS
from poise.formats.table import Columns, Floats, Table
from poise.formats.text_stamps import DAY

_TICKS = {"sampletimefine": "100us"}  # clocks that count in a unit of their own, or in a usual one (Xsens, Movella)
_BITS = (16, 32)  # of counters that begin anew
_SAME = 0.9  # of the steps: a clock that stands still so often is read, but does not tell the steps
_FREE = 3.0  # m/s²: no accelerometer on Earth shows less by its median


@dataclass
class Decisions:
    """How a file's columns become a recording."""

    unit: dict[str, str] = field(default_factory=dict)
    """by time, gyr, acc, mag: the unit that the file is in"""
    how: dict[str, str] = field(default_factory=dict)
    """how each was found"""
    rate: float | None = None
    """1/s, where stamps are made from it"""
    step: float = float("nan")
    """s, the usual one between rows"""
    packets: Packed | None = None
    """how rows came that have no stamp of their own"""
    held: dict[str, int] = field(default_factory=dict)
    """sensors whose samples are repeated, and over how many rows"""
    ends: tuple[float, ...] = ()
    """at which the stamps may begin anew, in their own unit"""
    across: float = 0.0
    """the longest step over such an end, in that unit"""
    gravity: float = STANDARD_GRAVITY
    notes: list[str] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)

    def factor(self, sensor: str) -> float:
        """What one unit of the file is in SI (µT for the magnetometer)."""
        return units.FACTORS[sensor][self.unit[sensor]]

    def turns(self) -> Turns:
        """What makes stamps that begin anew go on, from the first row on."""
        return Turns(self.ends, most=self.across)

    @property
    def gap(self) -> float:
        """s: a longer step is a gap."""
        return self.step * max(3.0, 1.5 * self.packets.most if self.packets else 0.0)


def decide(where: str, table: Table, options: Options) -> Decisions:
    """What the columns of *table* mean, by its words and by a sample of its rows.

    Raises :class:`FormatError` where a unit cannot be told, or contradicts the samples by more than a factor of five;
    :class:`RecordingError` where the stamps cannot be those of a gyroscope.
    """
    for sensor, unit in options.units.items():
        if sensor not in units.FACTORS:
            raise FormatError(f"{where}: --units {sensor}={unit}: expected one of {', '.join(units.FACTORS)}")
    sample = table.rows.sample()
    made = Decisions()
    time = _time(where, table, sample, options, made)
    made.step, made.packets = usual_step(time), packed(time)
    if made.rate is None and not table.own:
        made.ends = (DAY,) if table.daily else _ends(sample["time"])
        made.across = DAY / 2 if table.daily else made.gap * made.factor("time")
        if made.packets is None and not options.as_is:
            _check_coarse(where, time, table)
    if made.packets is not None:
        made.doubts.append(f"time: packets of {made.packets.words}, taken to be evenly apart")
    rows = {sensor: stacked(sample, sensor) for sensor in SENSORS if f"{sensor}_x" in sample}
    for sensor in ("acc", "mag", "gyr"):
        if sensor in rows:
            _sensor(where, sensor, time, rows, table, options, made)
    for sensor in ("acc", "mag"):
        if sensor in rows and not table.own and (usual := usual_distance(rows[sensor])):
            made.held[sensor] = usual
    if gravity := table.facts.get("poise.gravity"):
        made.gravity = _gravity(where, gravity)
    if not options.as_is:
        check_unit_of_time(time)
    return made


def stacked(columns: Columns, sensor: str) -> Floats:
    """(n, 3): a sensor's three columns side by side, in the file's unit."""
    axes = [columns[f"{sensor}_{axis}"] for axis in "xyz"]
    stack = np.empty((len(axes[0]), 3))
    for i, values in enumerate(axes):
        stack[:, i] = values
    return stack


def _time(where: str, table: Table, sample: Columns, options: Options, made: Decisions) -> Floats:
    """The sample's stamps in s."""
    stamps = sample.get("time", np.empty(0))
    rate = table.rate if options.rate is None and not len(stamps) else options.rate
    if rate is not None:
        if not (np.isfinite(rate) and rate > 0):
            raise FormatError(f"{where}: a rate of {rate} samples per second; expected a number above 0 (--rate HZ)")
        if "time" in table.layout.columns:
            made.notes.append(f"time: the file's own stamps are ignored for the given rate of {rate:g} Hz")
        made.unit["time"], made.how["time"], made.rate = "s", f"from the rate of {rate:g} Hz", rate
        return np.asarray(np.arange(len(sample["gyr_x"])) / rate)
    stated, how = _stated(where, "time", table, options)
    column = table.layout.columns.get("time")
    verdict = evidence.of_time(stamps, _TICKS.get(column.word, "") if column else "")
    if not stated and not verdict.unit and len(stamps) > 1 and not options.as_is:
        raise FormatError(
            f"{where}: unit of time not named, and {verdict.sentence}; say it: --units time=s (or ms, us, ns, 100us)"
        )
    unit = stated or verdict.unit or "s"
    if stated and not table.own and np.isfinite(verdict.size) and not options.as_is:
        hz = units.FACTORS["time"][unit] / verdict.size
        if not evidence.RATES[0] / 10 <= hz <= evidence.RATES[1] * 5:
            fix = f"; say --units time={verdict.unit}" if verdict.unit else "; say the unit with --units time="
            found = f"time {how} as {unit} means {hz:.4g} samples per second, but {verdict.sentence}"
            raise FormatError(f"{where}: {found}{fix}")
    if not stated and len(stamps) > 1:
        how = verdict.sentence
        made.notes.append(f"time: taken as {unit}, because {how}")
    made.unit["time"], made.how["time"] = unit, how or "assumed"
    return stamps / units.FACTORS["time"][unit]


def _check_coarse(where: str, time: Floats, table: Table) -> None:
    """Raises :class:`FormatError` where most stamps *time* (n,) are the one before, and not as rows in packets have it."""
    steps = np.diff(time)
    changes = np.flatnonzero(steps != 0.0)
    same = 1.0 - len(changes) / max(len(steps), 1)
    if same > _SAME and len(changes) > 1:
        hz = np.median(np.diff(changes)) / usual_step(time)
        hint = f" ({hz:.3g}, by how many share one)" if table.time_unit else ""
        raise FormatError(
            f"{where}: {same:.1%} of the stamps are that of the row before: they are too coarse to tell the steps between "
            f"rows; say --rate HZ{hint}, which makes even ones"
        )


def _ends(stamps: Floats) -> tuple[float, ...]:
    """Where a counter with the whole *stamps* (n,) of a sample may begin anew: behind its highest number."""
    known = stamps[np.isfinite(stamps)]
    if not len(known) or known.min() < 0.0 or (known != np.floor(known)).any():
        return ()
    return tuple(float(2**bits) for bits in _BITS if known.max() < 2**bits)


def _stated(where: str, sensor: str, table: Table, options: Options) -> tuple[str, str]:
    """The unit that the caller or the file names for *sensor*, and which of them; empty where neither does."""
    if sensor in options.units:
        return units.expect(sensor, options.units[sensor], where), "given"
    if sensor == "time" and table.time_unit:
        return table.time_unit, "calendar stamps"
    if text := table.layout.unit(sensor):
        if unit := units.named(sensor, text):
            return unit, "named by the file"
        if sensor != "mag":
            raise FormatError(
                f"{where}: unit {text!r} of {sensor} not understood; say it: --units {sensor}="
                f"{' or '.join(list(units.FACTORS[sensor])[:3])}"
            )
    if table.own:
        return units.SI[sensor], "written by poise"
    return "", ""


def _sensor(
    where: str, sensor: str, time: Floats, rows: Columns, table: Table, options: Options, made: Decisions
) -> None:
    unit, how = _stated(where, sensor, table, options)
    if sensor == "mag":
        unit, how = (unit, how) if unit else (units.AS_FOUND, "not named; only the direction counts")
        if unit == units.AS_FOUND:
            made.notes.append("mag: unit not known, values kept as they are: only the direction counts")
    elif options.as_is:
        unit, how = (unit, how) if unit else (units.SI[sensor], "not named")
    elif not table.own:
        if sensor == "acc":
            verdict = evidence.of_acc(rows["acc"])
        else:
            verdict = evidence.of_gyr(
                time, rows["gyr"], rows["acc"], rows.get("mag", np.full_like(rows["gyr"], np.nan))
            )
        if unit:
            _contradict(where, sensor, unit, how, verdict, made)
        else:
            unit, how = _decide(where, sensor, verdict), verdict.sentence
            made.notes.append(f"{sensor}: taken as {unit}, because {verdict.sentence}")
    made.unit[sensor], made.how[sensor] = unit, how


def _decide(where: str, sensor: str, verdict: Verdict) -> str:
    if verdict.unit:
        return verdict.unit
    if sensor == "acc" and verdict.size < _FREE:
        raise FormatError(f"{where}: {_gravity_free(verdict)}; if it is that already, say --units acc=g (or mg)")
    options = (
        "--units acc=m/s² or acc=g" if sensor == "acc" else "--units gyr=rad/s or gyr=deg/s (poise doctor may tell)"
    )
    raise FormatError(
        f"{where}: unit of {sensor} not named, and the samples do not decide: {verdict.sentence}; say it: {options}"
    )


def _gravity_free(verdict: Verdict) -> str:
    return (
        f"acceleration without gravity? {verdict.sentence}, gravity alone is 9.8 m/s². An attitude needs the "
        "accelerometer's own samples (specific force): export the raw or total acceleration"
    )


def _contradict(where: str, sensor: str, unit: str, how: str, verdict: Verdict, made: Decisions) -> None:
    """Raise where a stated unit is off by more than a factor of five, doubt where it is off by more than a quarter."""
    factor = units.FACTORS[sensor][unit]
    if not np.isfinite(verdict.size) or (sensor == "gyr" and not verdict.unit):
        return
    ratio = verdict.size * factor / 9.80665 if sensor == "acc" else factor / verdict.size
    if sensor == "acc" and verdict.size * factor < _FREE and not (verdict.unit and verdict.unit != unit):
        raise FormatError(f"{where}: {_gravity_free(verdict)} ({unit}, {how})")
    if not 0.2 <= ratio <= 5.0:
        fix = f"--units {sensor}={verdict.unit}" if verdict.unit else f"the unit with --units {sensor}="
        raise FormatError(f"{where}: {sensor} is {how} as {unit}, but {verdict.sentence}; say {fix}")
    if not (0.8 <= ratio <= 1.25 if sensor == "acc" else 0.5 <= ratio <= 2.0):
        made.doubts.append(f"{sensor}: {unit} ({how}) is off by a factor of {ratio:.2f}: {verdict.sentence}")


def _gravity(where: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise FormatError(f"{where}: poise.gravity is {text[:40]!r}, expected a number of m/s²") from None
