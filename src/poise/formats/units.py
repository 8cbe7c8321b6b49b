"""Units: the words people write for them, and the factors to rad/s, m/s², µT and seconds."""

from __future__ import annotations

import re

import numpy as np

from poise.data.recording import STANDARD_GRAVITY
from poise.errors import FormatError

SI = {"time": "s", "gyr": "rad/s", "acc": "m/s²", "mag": "µT"}
AS_FOUND = "as found"  # a magnetometer in no known unit: only its direction counts

# What one unit is in SI (µT for the magnetometer); for time, how many go into a second, so that stamps divide exactly.
FACTORS: dict[str, dict[str, float]] = {
    "time": {"s": 1.0, "ms": 1e3, "us": 1e6, "ns": 1e9, "100us": 1e4},
    "gyr": {"rad/s": 1.0, "deg/s": np.pi / 180, "mdeg/s": np.pi / 180e3, "mrad/s": 1e-3},
    "acc": {"m/s²": 1.0, "g": STANDARD_GRAVITY, "mg": STANDARD_GRAVITY * 1e-3, "cm/s²": 1e-2},
    "mag": {"µT": 1.0, "T": 1e6, "mT": 1e3, "nT": 1e-3, "G": 100.0, "mG": 0.1, AS_FOUND: 1.0},
}

# Spellings, after _plain: lower case, no blanks, no ^ * · ( ) ², µ as u, ° as deg.
_SPELLINGS: dict[str, dict[str, str]] = {
    "time": {
        "s": "s sec secs second seconds",
        "ms": "ms msec millis millisecond milliseconds",
        "us": "us usec micros microsecond microseconds",
        "ns": "ns nsec nanos nanosecond nanoseconds",
        "100us": "100us 0.1ms 1e-4s",
    },
    "gyr": {
        "rad/s": "rad/s rads rps radps rad/sec rads-1 radian/s radians/s radian/second radians/second",
        "deg/s": "deg/s degs dps degps deg/sec degs-1 degree/s degrees/s degree/second degrees/second",
        "mdeg/s": "mdps mdeg/s mdegs",
        "mrad/s": "mrad/s mrads mradps",
    },
    "acc": {
        "m/s²": "m/s2 ms2 m/s/s mss mps2 ms-2 m/sec2 msec2 meter/s2 meters/s2 meter/second2 meters/second2",
        "g": "g gs g0 gee",
        "mg": "mg",
        "cm/s²": "cm/s2 cms2 gal",
    },
    "mag": {
        "µT": "ut microt utesla microtesla",
        "T": "t tesla",
        "mT": "mt mtesla millitesla",
        "nT": "nt ntesla nanotesla",
        "G": "g gs gauss ga",
        "mG": "mg mgauss milligauss mga",
        AS_FOUND: "a.u. au a.u arb arb. raw counts normalized normalised 1 lsb",
    },
}
_BY_CASE = {"g": "acc", "mg": "acc", "mG": "mag"}  # a G alone is written for both
_WORDS = {
    sensor: {word: unit for unit, words in table.items() for word in words.split()}
    | {unit.lower().replace("µ", "u").replace("²", "2"): unit for unit in table}
    for sensor, table in _SPELLINGS.items()
}


def named(sensor: str, text: str) -> str | None:
    """The unit that *text* names for "time", "gyr", "acc" or "mag"; None where it names none."""
    return _WORDS.get(sensor, {}).get(_plain(text))


def expect(sensor: str, text: str, where: str) -> str:
    """The unit that *text* names; raises :class:`FormatError` with the known ones where it names none."""
    unit = named(sensor, text)
    if unit is None:
        known = ", ".join(FACTORS[sensor])
        raise FormatError(f"{where}: unit {text!r} of {sensor} not understood; expected one of {known}")
    return unit


def sensor(text: str) -> str:
    """The one sensor (or "time") whose unit *text* is; "" where it is none's, or may be that of two."""
    found = [name for name in FACTORS if named(name, text) not in (None, AS_FOUND)]
    return found[0] if len(found) == 1 else _BY_CASE.get(text.strip(), "")


def is_unit(text: str) -> bool:
    """Whether *text* is a unit of anything that a recording holds."""
    return any(named(sensor, text) for sensor in FACTORS)


def _plain(text: str) -> str:
    text = text.strip().lower().replace("µ", "u").replace("μ", "u").replace("²", "2").replace("°", "deg")
    text = text.replace("⁻¹", "-1").replace("⁻²", "-2").replace("per ", "/")
    return re.sub(r"[\s^*·_()]", "", text)
