"""What is said about a body's stability, and when it changed: the words that monitor, responses and viewers share."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from math import nan


class TipState(IntEnum):
    """How a body stands. A body whose attitude is not valid is ``UNKNOWN``, never upright."""

    UNKNOWN = 0
    """the attitude is not valid, or none has come in time"""
    UPRIGHT = 1
    """inside the preset range"""
    LEANING = 2
    """at or beyond the preset range, and can still balance itself"""
    TIPPING = 3
    """at or beyond the largest self-balancing angle, or about to be"""
    FALLEN = 4
    """lies"""
    FREE_FALL = 5
    """in the air with nothing that carries it"""
    PICKED_UP = 6
    """carried by somebody"""
    RIGHTED = 7
    """stands again after it had fallen or was picked up; upright once it has held for a while"""


@dataclass(frozen=True)
class TipEvent:
    """A change of state, as the monitor judged it."""

    time: float
    """s, the clock of the samples"""
    state: TipState
    before: TipState
    direction: str = ""
    """``forward``, ``back``, ``left`` or ``right``: the way it leans; empty where there is none"""
    tilt: float = nan
    """rad, between the body's up and the vertical, mounting and tare removed"""
    rate: float = nan
    """rad/s, how fast the tilt in that direction grows"""
    time_to_impact: float = nan
    """s until the angle of impact is reached if it goes on like this; NaN where it does not get there"""
    reason: str = ""
    """a sentence for people"""
