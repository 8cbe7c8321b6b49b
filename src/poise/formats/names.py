"""Column names: what the tools people use call a gyroscope's x axis, and which column of a file is which."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from poise.errors import FormatError
from poise.formats import units

SENSORS = ("gyr", "acc", "mag")
QUAT = ("qw", "qx", "qy", "qz")
EXAMPLE = '--columns "time[s],gyr_x[deg/s],gyr_y,gyr_z,acc_x[g],acc_y,acc_z,mag_x,mag_y,mag_z" ("-" skips a column)'

_WORDS = {
    "gyr": "gyr gyro gyros gyroscope gyroscopes angularvelocity angularrate angvel rotationrate rotrate gyrorotation "
    "gyrorotationrate gyroscoperotation gyroscoperotationrate gyrodata omega turnrate rateofturn",
    "acc": "acc accel accelerometer accelerometers acceleration accelerations accelerometeracceleration accdata "
    "totalacceleration specificforce accelerationincludinggravity gforce",
    "free": "freeacc freeacceleration linearacceleration linearacc linacc linaccel linearaccel linearaccelerometer "
    "useracceleration useracc useraccel accelerationwithoutgravity accelerationwithoutg",
    "mag": "mag magn magneto magnetometer magnetometers magneticfield magnetic magfield compass magdata",
}
_ROLES = {word: role for role, words in _WORDS.items() for word in words.split()}
_LETTERS = {"g": "gyr", "w": "gyr", "a": "acc", "m": "mag"}  # only together with an axis: gx, wx, ax, mx
_TIMES_WORDS = (
    "time timestamp timestamps t secondselapsed elapsedtime timeelapsed elapsed headerstamp stamp seconds secs sec "
    "unixtime unixtimestamp epochtime epoch datetime utc loggingtime sampletime sampletimefine"
)
_TIMES = _TIMES_WORDS.split()  # the first is preferred
_TIMES_IN = {"millis": "ms", "milliseconds": "ms", "micros": "us", "microseconds": "us", "nanoseconds": "ns"}
_RATES = ("fs", "sr", "hz", "rate", "freq", "frequency", "samplerate", "samplingrate", "samplingfrequency")
_PERIODS = ("dt", "sampleperiod", "samplingperiod")
_NOISE = {"imu", "sensor", "sensors", "field", "device", "phone", "watch", "motion", "raw", "cal", "calibrated", "data"}
_QUAT = re.compile(r"(?:(truth|ref|reference|opt|optical)_)?(?:q|quat|quaternion|orientation)(?:_q)?_?([wxyz0-3])?")
_LONGEST = 200  # characters of a name that are looked at
_TOKEN = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z0-9]+|[A-Z]")
_BRACKET = re.compile(r"(.*?)\s*(?:\(([^()]*)\)|\[([^\[\]]*)\])\s*")


class Field(NamedTuple):
    """What one name says: its role, the unit it carries (as written, or "") and how little it is preferred."""

    role: str
    """"time", "gyr_x", "gyr" (all three axes), "free_x", "truth_qw", "quat_qw", "moving", "rate", …; "" is unknown"""
    unit: str = ""
    rank: int = 0
    word: str = ""


@dataclass(frozen=True)
class Column:
    """One column that is used: where it stands, what the file calls it and the unit its name carries."""

    index: int
    name: str
    unit: str


@dataclass(frozen=True)
class Layout:
    """Which column is what: time, gyr_x … mag_z, truth_qw … truth_qz, moving, acc_age, mag_age."""

    columns: dict[str, Column]
    notes: tuple[str, ...] = ()

    def unit(self, sensor: str) -> str:
        """The unit that the names of *sensor*'s columns carry, as written; "" where they carry none."""
        keys = (sensor, *(f"{sensor}_{axis}" for axis in "xyz"))
        return next((self.columns[key].unit for key in keys if key in self.columns and self.columns[key].unit), "")


def parse(name: str) -> Field:
    """What a column or array name says."""
    text, unit = name[:_LONGEST].strip().strip('"').strip(), ""
    bracket = _BRACKET.fullmatch(text)
    if bracket and bracket[1]:
        text, unit = bracket[1], (bracket[2] if bracket[2] is not None else bracket[3]).strip()
    tokens = [token.lower() for token in _TOKEN.findall(text)]
    if "_".join(tokens) in ("acc_age", "mag_age"):
        return Field("_".join(tokens), unit)
    rank = len(tokens)
    while tokens and tokens[0] in _NOISE and len(tokens) > 1:
        tokens = tokens[1:]
    while len(tokens) > 1 and tokens[-1] in _NOISE:
        tokens = tokens[:-1]
    return _other(tokens, unit) or _sensor(tokens, unit, rank - len(tokens)) or Field("")


def _other(tokens: list[str], unit: str) -> Field | None:
    if quat := _QUAT.fullmatch("_".join(tokens)):
        axis = quat[2] or ""
        kind = "truth" if quat[1] else "quat"
        return Field(f"{kind}_q{'wxyz'[int(axis)] if axis.isdigit() else axis}" if axis else kind, unit)
    joined = "".join(tokens)
    if joined in ("gfx", "gfy", "gfz"):
        return Field(f"acc_{joined[-1]}", unit or "g", word="gforce")
    if joined in ("moving", "movement"):
        return Field("moving")
    if joined in _RATES or joined in _PERIODS:
        return Field("rate" if joined in _RATES else "period", unit)
    if joined in _TIMES_IN:
        return Field("time", unit or _TIMES_IN[joined], len(_TIMES))
    for cut in range(len(tokens), 0, -1):
        word, rest = "".join(tokens[:cut]), "".join(tokens[cut:])
        if word in _TIMES and (not rest or units.named("time", rest)):
            return Field("time", unit or rest, _TIMES.index(word))
    return None


def _sensor(tokens: list[str], unit: str, noise: int) -> Field | None:
    axes = [i for i, token in enumerate(tokens) if token in ("x", "y", "z")]
    axis = ""
    if len(axes) == 1:
        axis = tokens[axes[0]]
        tokens = tokens[: axes[0]] + tokens[axes[0] + 1 :]
    elif not axes:
        for i, token in enumerate(tokens):
            if token[-1] in "xyz" and (token[:-1] in _ROLES or token[:-1] in _LETTERS):
                axis, tokens = token[-1], [*tokens[:i], token[:-1], *tokens[i + 1 :]]
                break
    for cut in range(len(tokens), 0, -1):
        word, rest = "".join(tokens[:cut]), "".join(tokens[cut:])
        role = _ROLES.get(word) or (_LETTERS.get(word) if axis else None)
        if role and (not rest or units.named("acc" if role == "free" else role, rest)):
            return Field(f"{role}_{axis}" if axis else role, unit or rest, noise, word)
        if role == "free" and rest in ("e", "n", "u"):  # an Earth frame's axes: Xsens
            return Field(f"free_{rest}", unit, noise, word)
    return None


def renamed(where: str, names: Sequence[str] | None, columns: str | Sequence[str] | None, found: int) -> list[str]:
    """The names to go by: the file's own *names*, or those of the caller, in order or as ``theirs=ours`` words.

    Raises :class:`FormatError` where they do not fit the *found* columns, or where there are none at all.
    """
    if columns is None:
        if names is None:
            raise FormatError(f"{where}: {found} columns without a header; say what they are: {EXAMPLE}")
        return list(names)
    words = [word.strip() for word in (columns.split(",") if isinstance(columns, str) else columns)]
    if names is not None and words and all("=" in word for word in words):
        change = dict(word.split("=", 1) for word in words)
        if missing := [theirs for theirs in change if theirs not in names]:
            raise FormatError(f"{where}: no column {missing[0]!r}; found {listed(names)}")
        return [change.get(name, name) for name in names]
    if len(words) != found:
        raise FormatError(f'{where}: --columns names {len(words)} columns, the file has {found}; use "-" to skip one')
    for word in words:
        if word != "-" and not parse(word).role:
            raise FormatError(f"{where}: --columns: {word!r} not understood; an example: {EXAMPLE}")
    return ["" if word == "-" else word for word in words]


def choose(where: str, names: Sequence[str], timed: bool = False) -> Layout:
    """Which of the columns *names* is what; with *timed* the caller gives a rate and no time is needed.

    Raises :class:`FormatError` where gyroscope, specific force or time are missing or two columns claim one place.
    """
    found: dict[str, tuple[Field, Column]] = {}
    rivals: dict[str, list[str]] = {}
    for index, name in enumerate(names):
        parsed = parse(name)
        if not parsed.role:
            continue
        rivals.setdefault(parsed.role, []).append(name)
        other = found.get(parsed.role)
        if other and other[0].rank == parsed.rank:
            raise FormatError(
                f"{where}: columns {other[1].name!r} and {name!r} both claim to be {parsed.role}; "
                "pick with --columns, where - skips one"
            )
        if other is None or parsed.rank < other[0].rank:
            found[parsed.role] = parsed, Column(index, name, parsed.unit)
    notes = []
    for role, claims in rivals.items():
        if others := [name for name in claims if name != found[role][1].name]:
            notes.append(f"{role}: took column {found[role][1].name!r}, left out {listed(others)}")
    notes += _acceleration(where, found, names)
    columns = {role: column for role, (_, column) in found.items()}
    if not timed and "time" not in columns:
        raise FormatError(f"{where}: no time column among {listed(names)}; say --rate HZ, or name one with --columns")
    if any(f"quat_{q}" in columns for q in QUAT):
        notes.append("the file's own orientation (quaternion) is ignored; name it truth_qw … to compare with it")
    return Layout(_complete(where, columns, names), tuple(notes))


def _acceleration(where: str, found: dict[str, tuple[Field, Column]], names: Sequence[str]) -> list[str]:
    free = {role: entry for role, entry in found.items() if role.startswith("free_")}
    ros = "gyr_x" in found and found["gyr_x"][0].word == "angularvelocity"
    if not free or "acc_x" in found:
        return ["gravity-free acceleration in the file is ignored; the specific force is used"] if free else []
    if ros and all(field.word == "linearacceleration" for field, _ in free.values()):
        found |= {role.replace("free", "acc"): entry for role, entry in free.items()}
        return ["linear_acceleration beside angular_velocity: taken as specific force, as ROS has it"]
    raise FormatError(
        f"{where}: only acceleration without gravity ({listed([column.name for _, column in free.values()])}); an "
        "attitude needs the accelerometer's own samples (specific force, 9.8 m/s² at rest). Export the raw or total "
        "acceleration too" + ("" if "gyr_x" in found else ", and the gyroscope")
    )


def _complete(where: str, columns: dict[str, Column], names: Sequence[str]) -> dict[str, Column]:
    single: tuple[str, ...] = ("time", "moving", "acc_age", "mag_age")
    used = {key: columns[key] for key in single if key in columns}
    groups = [(sensor, [f"{sensor}_{axis}" for axis in "xyz"]) for sensor in SENSORS]
    for group, keys in [*groups, ("truth", [f"truth_{q}" for q in QUAT])]:
        missing = [key for key in keys if key not in columns]
        if len(missing) == len(keys) and group in ("mag", "truth"):
            continue
        if missing:
            raise FormatError(
                f"{where}: no column for {', '.join(missing)} among {listed(names)}; say what they are: {EXAMPLE}"
            )
        stated = [columns[key].unit for key in keys if columns[key].unit]
        if len({units.named(group, unit) or unit for unit in stated}) > 1:
            raise FormatError(f"{where}: the columns of {group} name different units; give them one")
        used |= {key: columns[key] for key in keys}
    return used


def counted(number: int, noun: str) -> str:
    """ "1 row", "2 rows"."""
    return f"{number} {noun}{'s' * (number != 1)}"


def listed(names: Sequence[str], most: int = 12) -> str:
    """A short list of names for a message."""
    shown = ", ".join(name[:40] or "(unnamed)" for name in names[:most])
    return shown + (f" and {len(names) - most} more" if len(names) > most else "")
