"""A recording with the attitudes that several methods make of it, for a page to play: what ``poise view`` serves."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite, nan
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude
from poise.data.recording import Recording
from poise.errors import PoiseError
from poise.live.frames import ATTITUDE, NOT_MONITORED, attitudes

MOST_RECORDS = 20_000
"""of one strip, in one answer"""
_STRETCHES = 2000  # told of one strip; a page cannot show more
REFERENCE = "reference"


class FilmError(PoiseError):
    """What a page asked for and cannot be shown."""


class Strip(NamedTuple):
    """One attitude over the recording's rows, body to east-north-up."""

    name: str
    """of the method, or :data:`REFERENCE`"""
    attitude: Attitude
    settings: str = "{}"
    """JSON"""
    tip: NDArray[np.uint8] | None = None
    """(n,) the monitor's :class:`~poise.data.event.TipState`, where it watched"""
    error_deg: dict[str, float] | None = None
    """RMSE against the reference: total, heading, inclination"""


class Film:
    """*strips* over the rows of *recording*, or of one attitude alone where there is none.

    Raises :class:`FilmError` where there is nothing to show, or rows do not fit each other.
    """

    def __init__(
        self, name: str, strips: Sequence[Strip], recording: Recording | None = None, source: str = ""
    ) -> None:
        if not strips or not len(strips[0].attitude):
            raise FilmError(f"{name}: there is nothing to show: no row")
        rows = {len(strip.attitude) for strip in strips} | ({len(recording)} if recording is not None else set())
        if len(rows) > 1:
            raise FilmError(
                f"{name}: attitudes and samples of different lengths: {', '.join(map(str, sorted(rows)))} rows"
            )
        self.name, self.source, self.strips, self._recording = name, source or name, tuple(strips), recording
        time = strips[0].attitude.time
        known = np.isfinite(time)
        if not known.any():
            raise FilmError(f"{name}: no row has a time")
        # as Attitude.reasons() has it: stamps that go backwards are no reason to lose a row
        self._clock = np.maximum.accumulate(np.where(known, time, time[known][0]))

    @property
    def start(self) -> float:
        """s, of the first row."""
        return float(self._clock[0])

    @property
    def end(self) -> float:
        """s, of the last row."""
        return float(self._clock[-1])

    def described(self, number: int) -> dict[str, Any]:
        """What pages are told about it; *number* is its place among the films."""
        time = self._clock
        step = float(np.median(np.diff(time))) if len(time) > 1 else 0.0
        return {
            "number": number,
            "id": self.name,
            "source": self.source,
            "shape": "joint" if self.strips[0].attitude.frame == "body" else "board",
            "start": self.start,
            "end": self.end,
            "rows": len(time),
            "rate_hz": 1.0 / step if step > 0.0 else None,
            "sensors": self._recording is not None,
            "methods": [
                {
                    "number": k,
                    "name": strip.name,
                    "settings": strip.settings,
                    "heading": strip.attitude.heading_reference,
                    "reference": strip.name == REFERENCE,
                    "error_deg": strip.error_deg and {key: _number(v) for key, v in strip.error_deg.items()},
                    "stretches": self._stretches(strip),
                }
                for k, strip in enumerate(self.strips)
            ],
        }

    @staticmethod
    def _stretches(strip: Strip) -> list[dict[str, Any]]:
        """Every flagged stretch, the longest where there are too many."""
        found = strip.attitude.reasons()
        if len(found) > _STRETCHES:
            found = sorted(sorted(found, key=lambda each: each.start - each.end)[:_STRETCHES])
        return [
            {
                "flag": each.flag.name,
                "start": each.start,
                "end": each.end,
                "rows": each.samples,
                "text": "the reference is not known here" if strip.name == REFERENCE else each.sentence,
            }
            for each in found
        ]

    def frame(self, number: int, start: float, end: float, most: float) -> bytes:
        """The frame of attitudes (docs/live.md) of all strips from *start* to *end*, s: at most *most* records of each.

        A record that stands for several rows has the flags of all of them in ``flags_since``. Raises :class:`FilmError`.
        """
        if not (isfinite(start) and isfinite(end) and start <= end and 1 <= most <= MOST_RECORDS):
            raise FilmError(
                f"expected start <= end, in s, and most from 1 to {MOST_RECORDS}; found {start:g}, {end:g}, {most:g}"
            )
        first, last = np.searchsorted(self._clock, [start, end], side="left")
        last += int(last < len(self._clock) and self._clock[last] == end)
        rows = np.unique(np.linspace(first, last, min(int(most), last - first) + 1).astype(np.intp)[:-1])
        records = np.zeros((len(self.strips), len(rows)), ATTITUDE)
        records["device"] = number
        for k in range(len(self.strips) if len(rows) else 0):
            self._fill(records[k], k, rows, last)
        return attitudes(records.reshape(-1), 0)

    def _fill(self, found: NDArray[np.void], k: int, rows: NDArray[np.intp], last: int) -> None:
        strip, attitude = self.strips[k], self.strips[k].attitude
        found["method"], found["sequence"] = k, rows
        found["time"] = found["host"] = self._clock[rows]
        found["flags"] = attitude.flags[rows]
        found["flags_since"] = np.bitwise_or.reduceat(attitude.flags[rows[0] : last], rows - rows[0])
        found["quat"], found["rate"], found["sigma"] = attitude.quat[rows], attitude.rate[rows], attitude.sigma[rows]
        found["valid"] = attitude.valid[rows]
        found["tip"] = NOT_MONITORED if strip.tip is None else strip.tip[rows]
        for sensor in ("gyr", "acc", "mag"):
            found[sensor] = np.nan if self._recording is None else getattr(self._recording, sensor)[rows]


def of_recording(recording: Recording, attitudes: Sequence[Strip]) -> Film:
    """The film of *attitudes*, made of *recording*, beside its reference, if it has one, and with their errors."""
    from poise.estimators import judged_by
    from poise.evaluation import evaluate

    strips = list(attitudes)
    if (truth := recording.truth) is not None:
        for k, strip in enumerate(strips):
            errors = evaluate(strip.attitude, recording).rmse_deg()._asdict()
            if judged_by(strip.attitude.provenance.method) == "inclination":  # it answers for no heading
                errors |= {"total": nan, "heading": nan}
            strips[k] = strip._replace(error_deg=errors)
        strips.append(Strip(REFERENCE, _in_enu(truth)))
    return Film(recording.name or "recording", strips, recording, recording.source)


def of_attitude(name: str, attitude: Attitude, tip: NDArray[np.uint8] | None = None) -> Film:
    """The film of an attitude alone, and of what the monitor said of it."""
    return Film(name, [Strip(attitude.provenance.method or "attitude", _in_enu(attitude), tip=tip)])


def _in_enu(attitude: Attitude) -> Attitude:
    """A page draws east-north-up; the frame of another body is drawn as if it stood there."""
    return attitude if attitude.frame == "body" else attitude.to("enu")


def _number(value: float) -> float | None:
    return float(value) if isfinite(value) else None
