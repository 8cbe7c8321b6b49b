"""What every sample of an attitude says about itself: the bits, their names, their sentences, and the rule for *valid*."""

from __future__ import annotations

from enum import IntFlag

import numpy as np
from numpy.typing import NDArray


class Flag(IntFlag):
    """One bit per fact about a sample; several may hold at once."""

    INITIALISING = 1 << 0
    GYR_MISSING = 1 << 1
    ACC_MISSING = 1 << 2
    MAG_MISSING = 1 << 3
    TIME_DISORDER = 1 << 4
    GAP = 1 << 5
    LOST = 1 << 6
    RESET = 1 << 7
    SILENT = 1 << 8
    REST = 1 << 9
    ACC_DOUBTED = 1 << 10
    CORRECTION_FORCED = 1 << 11
    HEADING_ARBITRARY = 1 << 12
    START_IN_MOTION = 1 << 13
    MAG_DISTURBED = 1 << 14
    GYR_CLIPPED = 1 << 15
    GYR_IGNORED = 1 << 16
    ACC_IGNORED = 1 << 17
    MAG_IGNORED = 1 << 18
    STUCK_GYR = 1 << 19
    STUCK_ACC = 1 << 20
    STUCK_MAG = 1 << 21
    ACC_CLIPPED = 1 << 22
    MAG_CLIPPED = 1 << 23
    CLOCK_JUMP = 1 << 24
    JITTER = 1 << 25
    UNSETTLED = 1 << 26
    HARD_IRON = 1 << 27
    HEADING_UNPROVEN = 1 << 28
    ANOTHER_FIELD = 1 << 29


SENTENCES: dict[Flag, str] = {
    Flag.INITIALISING: "no attitude yet: no usable accelerometer sample so far",
    Flag.GYR_MISSING: "no usable gyroscope sample: predicted with the last rate",
    Flag.ACC_MISSING: "no accelerometer sample for a while: the inclination rests on the gyroscope alone",
    Flag.MAG_MISSING: "no magnetometer sample that tells a heading for a while: it rests on the gyroscope alone",
    Flag.TIME_DISORDER: "time stamp missing or not after the one before: taken for the usual interval, or held",
    Flag.GAP: "gap in the time stamps: the motion inside it is unknown",
    Flag.LOST: "the rotation was not measured for too long: the attitude is unknown",
    Flag.RESET: "set anew from the accelerometer and magnetometer, with the bias it had: the attitude jumps",
    Flag.SILENT: "no sample has arrived in time, or none whose stamp goes on: the attitude now is unknown",
    Flag.REST: "at rest: the gyroscope's bias is being measured",
    Flag.ACC_DOUBTED: "specific force far from gravity: the accelerometer counts less",
    Flag.HEADING_ARBITRARY: (
        "no magnetometer sample since the start, or a field along gravity: the heading counts from where it started"
    ),
    Flag.START_IN_MOTION: "started in motion: the angles of one sample, which may be far off",
    Flag.MAG_DISTURBED: "the field here differs from what was learned of it: the magnetometer counts less",
    Flag.GYR_CLIPPED: "the rate is at the end of the gyroscope's range: the turn is larger than measured",
    Flag.GYR_IGNORED: "a spike in the gyroscope, which nothing else shows: left out",
    Flag.ACC_IGNORED: "a spike in the accelerometer, which nothing else shows: left out",
    Flag.MAG_IGNORED: "a spike in the magnetometer: left out",
    Flag.STUCK_GYR: "the gyroscope repeats one value: taken for absent",
    Flag.STUCK_ACC: "the accelerometer repeats one value: taken for absent",
    Flag.STUCK_MAG: "the magnetometer repeats one value: taken for absent",
    Flag.ACC_CLIPPED: "the accelerometer is at the end of its range: the force is larger than measured",
    Flag.MAG_CLIPPED: "the magnetometer is at the end of its range: left out",
    Flag.CLOCK_JUMP: "the clock was set: the usual interval is taken",
    Flag.JITTER: "a step between stamps of less than half or more than twice the usual",
    Flag.UNSETTLED: (
        "after rotation that was not measured, or with a bias that turned out wrong: "
        "the attitude may be off by more than 6 degrees, and is settling"
    ),
    Flag.HARD_IRON: (
        "a hard iron on the sensor was found by how the field goes with its turns: it is taken off from here on, and the "
        "heading, if that was far off, jumps"
    ),
    Flag.HEADING_UNPROVEN: (
        "iron on the sensor, or beside it at the start, may turn the heading: it has not turned enough to rule that out, and "
        "sigma allows for neither"
    ),
    Flag.ANOTHER_FIELD: (
        "the heading was set beside something that turned the field: it is set anew by the field that the sensor has "
        "turned in since"
    ),
    Flag.CORRECTION_FORCED: "the correction stood out from its history: the preset gain was forced",
}

# An attitude that carries one of these is not to be acted on; everything else is a remark.
INVALID: int = int(Flag.INITIALISING | Flag.LOST | Flag.SILENT | Flag.UNSETTLED)
# Bits 30 and 31 never leave the package: a smoother counts its log in them.
KNOWN: int = (1 << 30) - 1

# Kernels see plain integers.
INITIALISING = int(Flag.INITIALISING)
GYR_MISSING = int(Flag.GYR_MISSING)
ACC_MISSING = int(Flag.ACC_MISSING)
MAG_MISSING = int(Flag.MAG_MISSING)
TIME_DISORDER = int(Flag.TIME_DISORDER)
GAP = int(Flag.GAP)
LOST = int(Flag.LOST)
RESET = int(Flag.RESET)
SILENT = int(Flag.SILENT)
REST = int(Flag.REST)
ACC_DOUBTED = int(Flag.ACC_DOUBTED)
CORRECTION_FORCED = int(Flag.CORRECTION_FORCED)
HEADING_ARBITRARY = int(Flag.HEADING_ARBITRARY)
START_IN_MOTION = int(Flag.START_IN_MOTION)
MAG_DISTURBED = int(Flag.MAG_DISTURBED)
GYR_CLIPPED = int(Flag.GYR_CLIPPED)
GYR_IGNORED = int(Flag.GYR_IGNORED)
ACC_IGNORED = int(Flag.ACC_IGNORED)
MAG_IGNORED = int(Flag.MAG_IGNORED)
STUCK_GYR = int(Flag.STUCK_GYR)
STUCK_ACC = int(Flag.STUCK_ACC)
STUCK_MAG = int(Flag.STUCK_MAG)
ACC_CLIPPED = int(Flag.ACC_CLIPPED)
MAG_CLIPPED = int(Flag.MAG_CLIPPED)
CLOCK_JUMP = int(Flag.CLOCK_JUMP)
JITTER = int(Flag.JITTER)
UNSETTLED = int(Flag.UNSETTLED)
HARD_IRON = int(Flag.HARD_IRON)
HEADING_UNPROVEN = int(Flag.HEADING_UNPROVEN)
ANOTHER_FIELD = int(Flag.ANOTHER_FIELD)


def why_invalid(flags: int) -> str:
    """The sentences of those of *flags* for which an attitude is not to be acted on; empty without one."""
    return "; ".join(SENTENCES[flag] for flag in Flag if flag & flags & INVALID)


def valid(flags: NDArray[np.uint32]) -> NDArray[np.bool_]:
    """Whether the attitude may be acted on, (n,) bool: none of the bits of :data:`INVALID` is set."""
    return np.asarray((flags & np.uint32(INVALID)) == 0)
