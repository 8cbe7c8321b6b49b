"""Stretches of time in which an attitude is far from the others, or from the reference, and what explains them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.attitude import Attitude
from poise.data.flags import SENTENCES, Flag
from poise.data.recording import Recording
from poise.evaluation import Errors
from poise.math import arrays

Floats = NDArray[np.float64]
Rows = NDArray[np.intp]

BRIDGE = 1.0  # s: departures less far apart are one
SHORTEST = 0.5  # s: a shorter one is not told
SETTLING = 10.0  # s: a departure that begins with the attitude and is over by then is its start
_AROUND = 2.0  # s before and after a stretch begins: an event (a restart, a gap) in there may have caused it
_SHARE = 0.2  # of a stretch's rows that have to carry a flag for it to explain the stretch
_LIFT = 1.5  # … and so many times more often than the rest of the recording, if that carries it too
_FIELD, _DIP, _FORCE, _FAST = 0.1, 10.0, 0.2, 300.0  # of its strength, °, g RMS, °/s: what is told of the sensors
_EARLIER = 15.0  # s before a stretch in which the sensors may have caused it
_MAINLY = 2.0  # times the other part of the error

_EVENTS = (Flag.RESET, Flag.GAP, Flag.TIME_DISORDER, Flag.LOST, Flag.SILENT, Flag.HARD_IRON)
_OF_HEADING = (Flag.MAG_MISSING, Flag.HEADING_ARBITRARY, Flag.HEADING_UNPROVEN, Flag.HARD_IRON)
_OF_INCLINATION = (Flag.ACC_MISSING, Flag.ACC_DOUBTED)

Part = Literal["heading", "inclination", "heading and inclination"]


class Stretch(NamedTuple):
    """One estimator away from the reference, or from what the others agree on, for a while."""

    estimator: str
    start: float
    """s, as the recording's stamps"""
    end: float
    """s"""
    part: Part
    """what is off"""
    median_deg: float
    peak_deg: float
    heading_deg: float | None
    """median; None for an estimator without a heading of its own"""
    inclination_deg: float
    """median"""
    others_within: int
    """how many of the other estimators stay within the limit for most of it"""
    others: int
    reasons: tuple[str, ...]
    """sentences of the attitude's own flags that explain it"""
    sensors: tuple[str, ...]
    """what the sensors measured meanwhile that is out of the ordinary"""

    @property
    def majority(self) -> bool:
        """Whether most of the others agree, so that the blame is more than a guess."""
        return 2 * self.others_within > self.others

    @property
    def severity(self) -> float:
        """degree-seconds, by which stretches are ranked."""
        return self.median_deg * max(self.end - self.start, 0.0)


class Judged(NamedTuple):
    """An attitude with its errors, as stretches are looked for in it."""

    attitude: Attitude
    errors: Errors
    heading: bool
    """whether its heading counts"""

    @property
    def angle(self) -> Floats:
        """(n,) rad: the total error, or the inclination's where that is all that counts."""
        return self.errors.total if self.heading else self.errors.inclination


def stretches(recording: Recording, judged: Mapping[str, Judged], reference: Attitude, limit: float) -> list[Stretch]:
    """Every stretch in which an estimator is more than *limit* (rad) off the *reference*, the worst first."""
    clock = _rising(recording.time)
    sensors = _Sensors(recording, reference)
    found = []
    for name, one in judged.items():
        others = {other: each for other, each in judged.items() if other != name}
        for rows in _departures(clock, one.angle, limit):
            found.append(_told(sensors, clock, name, one, others, rows, limit))
    return sorted(found, key=lambda stretch: -stretch.severity)


def _departures(clock: Floats, angle: Floats, limit: float) -> list[Rows]:
    """The first and last row of each departure."""
    rows = np.flatnonzero(angle > limit)
    if not len(rows):
        return []
    cuts = np.flatnonzero(np.diff(clock[rows]) > BRIDGE) + 1
    return [part for part in np.split(rows, cuts) if clock[part[-1]] - clock[part[0]] >= SHORTEST]


def _told(
    sensors: _Sensors, clock: Floats, name: str, one: Judged, others: Mapping[str, Judged], rows: Rows, limit: float
) -> Stretch:
    whole = np.arange(rows[0], rows[-1] + 1)
    heading, inclination = (
        float(np.degrees(np.nanmedian(e[whole]))) for e in (one.errors.heading, one.errors.inclination)
    )
    part: Part = "heading and inclination"
    if not one.heading or inclination > _MAINLY * heading:
        part = "inclination"
    elif heading > _MAINLY * inclination:
        part = "heading"
    near = [_share(each.angle[whole] <= limit) > 0.5 for each in others.values()]
    angle = np.degrees(one.angle[whole])
    return Stretch(
        estimator=name,
        start=float(clock[rows[0]]),
        end=float(clock[rows[-1]]),
        part=part,
        median_deg=float(np.nanmedian(angle)),
        peak_deg=float(np.nanmax(angle)),
        heading_deg=heading if one.heading else None,
        inclination_deg=inclination,
        others_within=sum(near),
        others=len(others),
        reasons=_reasons(clock, one, whole, part, limit),
        sensors=sensors.remarks(whole) or sensors.before(clock, whole),
    )


def _reasons(clock: Floats, one: Judged, rows: Rows, part: Part, limit: float) -> tuple[str, ...]:
    """Sentences of the flags that explain a departure: its events as it begins, its states while it lasts."""
    flags = one.attitude.flags
    start, end = clock[rows[0]], clock[rows[-1]]
    found = []
    around = np.flatnonzero((clock >= start - _AROUND) & (clock <= min(start + _AROUND, end)))
    unrelated = {"inclination": _OF_HEADING, "heading": _OF_INCLINATION}.get(part, ())
    for flag in Flag:
        if flag == Flag.REST or flag in unrelated:
            continue
        carried = (flags & np.uint32(flag)) != 0
        if flag in _EVENTS:
            when = clock[around[carried[around]]]
            if len(when):
                found.append(f"{SENTENCES[flag]} ({_times(when - start)})")
            continue
        inside, overall = _share(carried[rows]), _share(np.delete(carried, rows))
        if inside >= _SHARE and inside >= _LIFT * overall:
            found.append(f"{SENTENCES[flag]} ({inside:.0%} of the stretch)")
    known = np.flatnonzero(np.isfinite(one.angle))
    after = known[known > rows[-1]]
    over = len(after) > 0 and one.angle[after[0]] <= limit
    if over and rows[0] == known[0] and end - start < SETTLING:
        found.append("its start: it is over once the filter has settled")
    return tuple(found)


class _Sensors:
    """What the sensors measured, in terms of what is usual for them."""

    def __init__(self, recording: Recording, reference: Attitude) -> None:
        field = arrays.length(recording.mag)
        field[~((field > 0.0) & np.isfinite(field))] = np.nan
        up = arrays.rotate(arrays.conjugate(reference.to("enu").quat), np.array([0.0, 0.0, 1.0]))
        with np.errstate(invalid="ignore", over="ignore"):
            dip = np.degrees(np.arcsin(np.clip(-np.sum(recording.mag * up, axis=1) / field, -1.0, 1.0)))
        self.has_mag = recording.has_mag
        self.field = field / _median(field)
        self.dip = dip - _median(dip)
        self.force = arrays.length(recording.acc) / recording.gravity - 1.0
        self.rate = np.degrees(arrays.length(recording.gyr))

    def before(self, clock: Floats, rows: Rows) -> tuple[str, ...]:
        """What was out of the ordinary just before: a filter may be slow to follow, or to come back."""
        start = clock[rows[0]]
        earlier = np.flatnonzero((clock >= start - _EARLIER) & (clock < start))
        return tuple(f"in the {_EARLIER:g} s before: {text}" for text in self.remarks(earlier)) if len(earlier) else ()

    def remarks(self, rows: Rows) -> tuple[str, ...]:
        """What is out of the ordinary in *rows*: field, specific force, turning."""
        found = []
        field, dip = _known(self.field[rows]), _known(self.dip[rows])
        if self.has_mag and not len(field):
            found.append("no magnetometer sample")
        elif len(field):
            low, high = np.percentile(field, [5, 95])
            if low < 1.0 - _FIELD or high > 1.0 + _FIELD:
                found.append(f"magnetic field {low:.2f} to {high:.2f} times its usual strength")
            if len(dip) and (lean := float(np.percentile(np.abs(dip), 95))) > _DIP:
                found.append(f"magnetic field dips up to {lean:.0f}° off its usual angle")
        force, rate = _known(self.force[rows]), _known(self.rate[rows])
        if len(force) and (strong := float(np.sqrt(np.mean(force**2)))) > _FORCE:
            found.append(f"accelerated: specific force {strong:.2f} g RMS off 1 g")
        if len(rate) and (fast := float(np.percentile(rate, 95))) > _FAST:
            found.append(f"turning fast: {fast:.0f} °/s")
        return tuple(found)


def _known(values: Floats) -> Floats:
    return values[np.isfinite(values)]


def _median(values: Floats) -> float:
    known = _known(values)
    return float(np.median(known)) if len(known) else float("nan")


def _times(since: Floats) -> str:
    """When events were, s from the beginning of the stretch."""
    first = float(since[0])
    return "as it begins" if abs(first) < 0.05 else f"{abs(first):.1f} s {'before' if first < 0 else 'after'} it begins"


def _share(mask: NDArray[np.bool_]) -> float:
    return float(np.mean(mask)) if len(mask) else 0.0


def _rising(time: Floats) -> Floats:
    """The stamps with missing ones filled and set-back ones held, so that stretches have an order."""
    known = np.isfinite(time)
    if known.all() and (np.diff(time) >= 0).all():
        return time
    return np.asarray(np.maximum.accumulate(np.where(known, time, time[known][0] if known.any() else 0.0)))


def worst(time: Floats, angle: Floats, seconds: float = 5.0) -> dict[str, Any] | None:
    """The *seconds* with the largest mean of *angle* (n,) rad: start and end, s, and that mean in degrees."""
    clock = _rising(time)
    known = np.isfinite(angle)
    if not known.any():
        return None
    stamps, values = clock[known], np.degrees(angle[known])
    total = np.concatenate([[0.0], np.cumsum(values)])
    after = np.searchsorted(stamps, stamps + seconds, side="right")
    whole = stamps + seconds <= stamps[-1] + 1e-9
    whole[0] = True  # a shorter recording is its own worst stretch
    first = np.flatnonzero(whole)
    means = (total[after[first]] - total[first]) / (after[first] - first)
    best = int(np.argmax(means))
    start = first[best]
    return {"start": float(stamps[start]), "end": float(stamps[after[start] - 1]), "mean_deg": float(means[best])}


def beyond(time: Floats, angle: Floats, limit: float) -> float:
    """s in all that *angle* (n,) is above *limit*, both rad: each row lasts until the next stamp, over a gap as usual."""
    clock = _rising(time)
    steps = np.diff(clock)
    usual = float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
    lasting = np.append(np.where(steps > max(BRIDGE, usual), usual, steps), usual)[: len(clock)]
    return float(np.sum(lasting[angle > limit]))


def settled(time: Floats, angle: Floats, limit: float, seconds: float = 1.0) -> float | None:
    """s after the first known row until *angle* (n,) has stayed within *limit*, rad, for *seconds*; None if never."""
    clock = _rising(time)
    known = np.flatnonzero(np.isfinite(angle))
    if not len(known):
        return None
    stamps, good = clock[known], angle[known] <= limit
    edges = np.flatnonzero(np.diff(np.concatenate([[False], good, [False]]).astype(np.int8)))
    for start, end in zip(edges[0::2], edges[1::2], strict=True):
        if stamps[end - 1] - stamps[start] >= seconds:
            return float(stamps[start] - stamps[0])
    return None
