"""Which column of a file is which: by its name, by the unit of three that stand together, or by the caller's word."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile

from poise.errors import FormatError
from poise.formats import units
from poise.formats.names import QUAT, SENSORS, Field, listed, parse, split, words

EXAMPLE = '--columns "time[s],gyr_x[deg/s],gyr_y,gyr_z,acc_x[g],acc_y,acc_z,mag_x,mag_y,mag_z" ("-" skips a column)'
_COMPUTED_WORDS = (
    "gravity grav linear lin user free earth world global nav ned enu bias offset error err std sigma var variance cov "
    "covariance mean delta truth ref reference"
)
_COMPUTED = set(_COMPUTED_WORDS.split())  # in the name of a vector that is no sensor's own sample, whatever its unit


@dataclass(frozen=True)
class Column:
    """One column that is used: where it stands, what the file calls it, and its name's unit and word for the quantity."""

    index: int
    name: str
    unit: str = ""
    word: str = ""


@dataclass(frozen=True)
class Layout:
    """Which column is what: time, gyr_x … mag_z, truth_qw … truth_qz, moving, acc_age, mag_age."""

    columns: dict[str, Column]
    notes: tuple[str, ...] = ()
    unused: tuple[str, ...] = ()
    """columns that nothing else is said about"""
    devices: tuple[Column, ...] = ()
    """columns that name the device a row is of"""
    date: Column | None = None
    """the day that times of day are of"""

    def unit(self, sensor: str) -> str:
        """The unit that the names of *sensor*'s columns carry, as written; "" where they carry none."""
        keys = (sensor, *(f"{sensor}_{axis}" for axis in "xyz"))
        return next((self.columns[key].unit for key in keys if key in self.columns and self.columns[key].unit), "")


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
        return ["" if change.get(name) == "-" else change.get(name, name) for name in names]
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
    fields = _parsed(names)
    notes = _by_unit(names, fields)
    for index, (name, parsed) in enumerate(zip(names, fields, strict=True)):
        if parsed.role in ("", "device", "date"):
            continue
        rivals.setdefault(parsed.role, []).append(name)
        other = found.get(parsed.role)
        if other and other[0].rank == parsed.rank:
            raise FormatError(
                f"{where}: columns {other[1].name!r} and {name!r} both claim to be {parsed.role}; "
                "pick with --columns, where - skips one"
            )
        if other is None or parsed.rank < other[0].rank:
            found[parsed.role] = parsed, Column(index, name, parsed.unit, parsed.word)
    for role, claims in rivals.items():
        if others := [name for name in claims if name != found[role][1].name]:
            notes.append(f"{role}: took column {found[role][1].name!r}, left out {listed(others)}")
    notes += _acceleration(where, found, names)
    columns = {role: column for role, (_, column) in found.items()}
    if not timed and "time" not in columns:
        raise FormatError(f"{where}: no time column among {listed(names)}; say --rate HZ, or name one with --columns")
    if any(f"quat_{q}" in columns for q in QUAT):
        notes.append("the file's own orientation (quaternion) is ignored; name it truth_qw … to compare with it")
    used = _complete(where, columns, names)
    said = (*used, "free_", "quat_")
    indices = {column.index for column in used.values()}
    unused = [n for i, n in enumerate(names) if n and i not in indices and not fields[i].role.startswith(said)]
    beside = [(field.role, Column(i, names[i])) for i, field in enumerate(fields)]
    devices = tuple(column for role, column in beside if role == "device")
    dates = [column for role, column in beside if role == "date"]
    return Layout(used, tuple(notes), tuple(unused), devices, dates[0] if len(dates) == 1 else None)


def _parsed(names: Sequence[str]) -> list[Field]:
    """What *names* say; where none is a gyroscope's, without the words that all of them begin with, a device's name."""
    fields = [parse(name) for name in names]
    unknown = [name for name, field in zip(names, fields, strict=True) if name and not field.role]
    same = takewhile(lambda letters: len(set(letters)) == 1, zip(*unknown, strict=False))
    common = "".join(letters[0] for letters in same)
    prefix = common[: max(common.rfind(mark) for mark in "_./: ") + 1]
    if not prefix or any(field.role.startswith("gyr") for field in fields):
        return fields
    return [
        field if field.role else parse(name.removeprefix(prefix)) for name, field in zip(names, fields, strict=True)
    ]


def _by_unit(names: Sequence[str], fields: list[Field]) -> list[str]:
    """Places in *fields* for three columns side by side whose unit is one sensor's only, where no word names that sensor.

    Returns what is to be said about it.
    """
    taken = {field.role.partition("_")[0].replace("free", "acc") for field in fields}
    groups: dict[str, list[int]] = {}
    for i in range(len(names) - 2):
        sensor = units.sensor(split(names[i])[1])
        if sensor in SENSORS and sensor not in taken and _are_axes(sensor, names[i : i + 3], fields[i : i + 3]):
            groups.setdefault(sensor, []).append(i)
    notes = []
    for sensor, (start, *others) in groups.items():
        three = names[start : start + 3]
        if not others:  # of two groups none is surely the one
            for i, (name, axis) in enumerate(zip(three, _axes(three), strict=True), start):
                fields[i] = Field(f"{sensor}_{axis}", split(name)[1])
            notes.append(f"{sensor}: columns {listed(three)}, known by their unit")
    return notes


def _are_axes(sensor: str, names: Sequence[str], fields: Sequence[Field]) -> bool:
    """Whether three columns that no word names can be the axes of *sensor* by their units and names."""
    units_of = {units.named(sensor, split(name)[1]) for name in names}
    computed = any(not _COMPUTED.isdisjoint(words(name)) for name in names)
    return len(units_of) == 1 and not computed and not any(field.role for field in fields) and bool(_axes(names))


def _axes(names: Sequence[str]) -> str:
    """The axes in the order of three names that differ in one letter only: "xyz", "zyx", …; else ""."""
    texts = [split(name)[0].lower() for name in names]
    if len({len(text) for text in texts}) != 1:
        return ""
    differing = ["".join(letters) for letters in zip(*texts, strict=True) if len(set(letters)) > 1]
    return differing[0] if len(differing) == 1 and sorted(differing[0]) == ["x", "y", "z"] else ""


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
