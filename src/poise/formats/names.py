"""Column names: what the tools people use call a gyroscope's x axis."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from poise.formats import units

SENSORS = ("gyr", "acc", "mag")
QUAT = ("qw", "qx", "qy", "qz")

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
    "unixtime unixtimestamp epochtime epoch datetime utc loggingtime sampletime sampletimefine timestampunix"
)
_TIMES = _TIMES_WORDS.split()  # the first is preferred
_TIMES_IN = {"millis": "ms", "milliseconds": "ms", "micros": "us", "microseconds": "us", "nanoseconds": "ns"}
_RATES = ("fs", "sr", "hz", "rate", "freq", "frequency", "samplerate", "samplingrate", "samplingfrequency")
_PERIODS = ("dt", "sampleperiod", "samplingperiod")
_NOISE = {"imu", "sensor", "sensors", "field", "device", "phone", "watch", "motion", "raw", "cal", "calibrated", "data"}
_THINGS, _LABELS = (
    ("device", "sensor", "imu", "node", "tag", "mac"),
    ("", "id", "name", "tag", "address", "mac", "number"),
)
_DEVICES = {thing + label for thing in _THINGS for label in _LABELS} - {"sensor"}  # which alone may be a reading
_QUAT = re.compile(r"(?:(truth|ref|reference|opt|optical)_)?(?:q|quat|quaternion|orientation)(?:_q)?_?([wxyz0-3])?")
_LONGEST = 200  # characters of a name that are looked at
_TOKEN = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z0-9]+|[A-Z]")
_BRACKET = re.compile(r"(.*?)\s*(?:\(((?:[^()]|\([^()]*\))*)\)|\[([^\[\]]*)\])\s*")


class Field(NamedTuple):
    """What one name says: its role, the unit it carries (as written, or "") and how little it is preferred."""

    role: str
    """"time", "gyr_x", "gyr" (all three axes), "free_x", "truth_qw", "quat_qw", "moving", "rate", "device", …; "" is unknown"""
    unit: str = ""
    rank: int = 0
    word: str = ""
    """what names the sensor, or time"""


def parse(name: str) -> Field:
    """What a column or array name says."""
    text, unit = split(name)
    tokens = words(text)
    if "_".join(tokens) in ("acc_age", "mag_age"):
        return Field("_".join(tokens), unit)
    if "".join(tokens) in _DEVICES:
        return Field("device")
    rank = len(tokens)
    while tokens and tokens[0] in _NOISE and len(tokens) > 1:
        tokens = tokens[1:]
    while len(tokens) > 1 and tokens[-1] in _NOISE:
        tokens = tokens[:-1]
    found = _other(tokens, unit) or _sensor(tokens, unit, rank - len(tokens)) or Field("")
    return _stamps(found, text) if found.role == "time" else found


def _stamps(field: Field, text: str) -> Field:
    """A time column behind all others where it may be something else: a capital T is a temperature, too.

    A unit that is none of time says so of a single letter; of a word it may be how a calendar stamp is written (UTC).
    """
    foreign = bool(field.unit) and units.named("time", field.unit) is None
    if foreign and field.word == "t":
        return Field("")
    return field._replace(rank=field.rank + len(_TIMES) + 1) if foreign or text == "T" else field


def split(name: str) -> tuple[str, str]:
    """A name without its unit, and the unit in brackets behind it."""
    text = name[:_LONGEST].strip().strip('"').strip()
    bracket = _BRACKET.fullmatch(text)
    if bracket and bracket[1]:
        return bracket[1], (bracket[2] if bracket[2] is not None else bracket[3]).strip()
    return text, ""


def words(text: str) -> list[str]:
    """What *text* is made of, in lower case: "MagX" is mag and x."""
    return [token.lower() for token in _TOKEN.findall(text)]


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
    if joined == "date":
        return Field("date")
    if joined in _RATES or joined in _PERIODS:
        return Field("rate" if joined in _RATES else "period", unit)
    if joined in _TIMES_IN:
        return Field("time", unit or _TIMES_IN[joined], len(_TIMES), joined)
    for cut in range(len(tokens), 0, -1):
        word, rest = "".join(tokens[:cut]), "".join(tokens[cut:])
        if word in _TIMES and (not rest or units.named("time", rest)):
            return Field("time", unit or rest, _TIMES.index(word), word)
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


def counted(number: int, noun: str) -> str:
    """ "1 row", "2 rows"."""
    return f"{number} {noun}{'s' * (number != 1)}"


def listed(names: Sequence[str], most: int = 12) -> str:
    """A short list of names for a message."""
    shown = ", ".join(name[:40] or "(unnamed)" for name in names[:most])
    return shown + (f" and {len(names) - most} more" if len(names) > most else "")
