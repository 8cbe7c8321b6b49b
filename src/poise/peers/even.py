"""Any recording as peers need it: one period between rows, and every sensor in every row."""

from __future__ import annotations

from math import isfinite
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.data.recording import Recording
from poise.data.stamps import packed
from poise.errors import RecordingError
from poise.estimators.guard import unpacked

Floats = NDArray[np.float64]
Rows = NDArray[np.bool_]

GAP = 1.0  # s: nothing is interpolated over more
FEWEST = 10  # rows: with fewer there is nothing to filter
_UNEVEN = 0.05  # the largest share by which a step between stamps may differ from the period that peers are given
_OWN_ROWS = 0.02  # … where rows have to be filled in or cut out: parts of them must stay even too
_GROWTH = 10  # an even grid of so many times the recording's rows has no meaning


class Prepared(NamedTuple):
    """A recording that peers can run on, and what was done to make it one."""

    recording: Recording
    """even within its stretches, which steps of another length divide; mag is 0 where it is unknown"""
    notes: tuple[str, ...]
    """a sentence for each thing done; none where the recording was even and complete: then it is the one given"""


def prepared(recording: Recording) -> Prepared:
    """The recording on even stamps at its own median rate, every sensor interpolated between its own samples.

    Where stamps are even already, rows stay where they are. Nothing is interpolated over more than 1 s: there rows are
    left out, and a peer starts anew after them; without a magnetometer sample for so long its rows hold 0, which every
    peer takes for silence. Raises :class:`RecordingError` where there is too little to run a filter on.
    """
    _check(recording)
    packets = packed(recording.time)
    if packets is None and _even(recording.time, _UNEVEN) and _complete(recording):
        return Prepared(recording, () if recording.has_mag else (_NO_MAG,))
    recording = recording.with_samples(time=unpacked(recording.time))
    clock, forward = rising(recording.time)
    seconds = 1.0 / Recording(clock[forward], *(getattr(recording, s)[forward] for s in ("gyr", "acc"))).rate_hz
    grid, regular = _grid(clock[forward], seconds, len(recording))
    notes = [f"packets of {packets.words}: taken to be evenly apart"] if packets else []
    notes += _notes(recording, forward, regular)
    gyr, gyr_known = _interpolated(grid, *_own(recording, "gyr", clock, forward))
    acc, acc_known = _interpolated(grid, *_own(recording, "acc", clock, forward))
    mag, mag_known = np.full_like(gyr, np.nan), None
    if recording.has_mag:
        mag, mag_known = _interpolated(grid, *_own(recording, "mag", clock, forward))
        mag[~mag_known] = 0.0
    keep = gyr_known & acc_known
    even = Recording(grid, gyr, acc, mag, gravity=recording.gravity, name=recording.name)[keep]
    long = [piece for piece in pieces(even) if piece.stop - piece.start >= FEWEST]
    if not long:
        raise RecordingError(f"peers need {FEWEST} rows in a row with gyr and acc, not more than {GAP:g} s apart")
    if len(pieces(even)) > 1:
        notes.append(f"gaps longer than {GAP:g} s: {len(pieces(even)) - 1}, the filter starts anew after each")
    if mag_known is not None and not mag_known[keep].all():
        notes.append(
            f"mag: no sample for more than {GAP:g} s in {np.mean(~mag_known[keep]):.1%} of the rows, left silent"
        )
    return Prepared(even, tuple(notes))


def period(recording: Recording) -> float:
    """s between samples, for filters that know one period and no absent sample.

    Raises :class:`RecordingError` for a recording that such a filter cannot run on; :func:`prepared` makes one that it can.
    """
    _check(recording)
    if not _even(recording.time, _UNEVEN):
        raise RecordingError("peers need even time stamps; resample the recording first")
    if not _complete(recording):
        raise RecordingError("peers need gyr and acc in every row, and mag in every row or in none")
    return 1.0 / recording.rate_hz


def pieces(recording: Recording) -> list[slice]:
    """The rows of each stretch without a gap, of a prepared recording."""
    steps = np.diff(recording.time) * recording.rate_hz
    cuts = np.flatnonzero(~(np.abs(steps - 1.0) < 0.5)) + 1
    edges = [0, *cuts.tolist(), len(recording)]
    return [slice(a, b) for a, b in zip(edges, edges[1:], strict=False)]


def rising(time: Floats) -> tuple[Floats, Rows]:
    """(n,) s that never fall, and the rows that take it forward; the other rows stand at the instant before them.

    A clock that was set back, and stays back for 1 s of rows, goes on 2 s after where it was: a gap.
    """
    if np.isfinite(time).all() and (np.diff(time) > 0).all():
        return time, np.ones(len(time), dtype=bool)
    steps = np.diff(time)
    patience = max(2, round(GAP / float(np.median(steps[steps > 0])))) if (steps > 0).any() else len(time)
    clock, forward = np.full(len(time), np.nan), np.zeros(len(time), dtype=bool)
    stamps = time.tolist()
    i, behind, offset, latest = 0, -1, 0.0, float("nan")
    while i < len(stamps):
        now = stamps[i] + offset
        if isfinite(now) and not now <= latest:
            latest, forward[i], behind = now, True, -1
        elif isfinite(now):
            behind = i if behind < 0 else behind
            if i - behind >= patience:
                offset, i, behind = latest + 2 * GAP - stamps[behind], behind, -1
                continue
        clock[i] = latest
        i += 1
    return clock, forward


_NO_MAG = "no magnetometer: gyroscope and accelerometer only, the heading is arbitrary"


def _check(recording: Recording) -> None:
    for sensor, name in (("gyr", "gyroscope"), ("acc", "accelerometer")):
        if not np.isfinite(getattr(recording, sensor)).all(axis=1).any():
            raise RecordingError(f"peers need gyroscope and accelerometer; no row has a sample of the {name}")
    if len(recording) < FEWEST:
        raise RecordingError(f"peers need at least {FEWEST} rows, found {len(recording)}")
    if not recording.rate_hz > 0.0:
        raise RecordingError("peers need time stamps that rise from row to row")


def _even(time: Floats, tolerance: float) -> bool:
    steps = np.diff(time)
    return bool(np.allclose(steps, np.median(steps), rtol=tolerance, atol=0.0)) and float(np.median(steps)) > 0.0


def _complete(recording: Recording) -> bool:
    sensors = [recording.gyr, recording.acc, *([recording.mag] if recording.has_mag else [])]
    return all(bool(np.isfinite(sensor).all()) for sensor in sensors)


def _grid(clock: Floats, seconds: float, rows: int) -> tuple[Floats, bool]:
    """Even instants from the first to the last stamp of each stretch without gap; whether they are the stamps themselves.

    Where stamps are not even, steps differ from *seconds* by what makes them end at the last stamp.
    """
    stretches = np.split(clock, np.flatnonzero(np.diff(clock) > GAP) + 1)
    own = [bool(np.allclose(np.diff(s), seconds, rtol=_OWN_ROWS, atol=0.0)) for s in stretches]
    steps = [max(1, round((s[-1] - s[0]) / seconds)) for s in stretches]
    if sum(steps) > _GROWTH * rows:
        raise RecordingError(
            f"peers need an even rate: the stamps' median step of {seconds:g} s would make {sum(steps)} rows of {rows}; "
            "check the stamps or thin the recording"
        )
    made = [s if o else np.linspace(s[0], s[-1], n + 1) for s, o, n in zip(stretches, own, steps, strict=True)]
    return np.concatenate(made), all(own)


def _own(recording: Recording, sensor: str, clock: Floats, forward: Rows) -> tuple[Floats, Floats]:
    """A sensor's samples at its own instants, in order."""
    values = getattr(recording, sensor)
    rows = forward & np.isfinite(values).all(axis=1)
    if sensor == "mag":
        rows &= values.any(axis=1)  # zeros are silence
    stamps = clock[rows]
    if sensor != "gyr":
        age = getattr(recording, f"{sensor}_age")[rows]
        stamps = stamps - np.where(np.isfinite(age), age, 0.0)
    stamps, first = np.unique(stamps, return_index=True)
    return stamps, values[rows][first]


def _interpolated(grid: Floats, own: Floats, values: Floats) -> tuple[Floats, Rows]:
    """(m, 3) between the sensor's own samples, and whether they are near enough: at the ends, within about its period."""
    if not len(own):
        return np.full((len(grid), 3), np.nan), np.zeros(len(grid), dtype=bool)
    own_period = float(np.median(np.diff(own))) if len(own) > 1 else np.inf
    held = min(GAP, 1.5 * own_period) if own_period <= GAP else 0.0
    after = np.searchsorted(own, grid)
    before, after = np.maximum(after - 1, 0), np.minimum(after, len(own) - 1)
    span = np.where(before < after, own[after] - own[before], 0.0)
    outside = np.maximum(np.maximum(own[0] - grid, grid - own[-1]), 0.0)
    known = ((span <= GAP * (1.0 + 1e-6)) | (own[after] == grid)) & (outside <= held)
    return np.column_stack([np.interp(grid, own, column) for column in values.T]), known


def _notes(recording: Recording, forward: Rows, regular: bool) -> list[str]:
    notes = []
    if not forward.all():
        notes.append(f"{int(np.sum(~forward))} rows left out, whose stamp does not rise")
    if not regular:
        notes.append(f"uneven stamps: gyr and acc interpolated to {recording.rate_hz:.1f} even samples per second")
    for sensor in ("gyr", "acc"):
        absent = int(np.sum(~np.isfinite(getattr(recording, sensor)).all(axis=1)))
        if absent:
            notes.append(f"{sensor}: no sample in {absent} rows, interpolated over up to {GAP:g} s")
    if not recording.has_mag:
        notes.append(_NO_MAG)
    elif (share := float(np.mean(np.isfinite(recording.mag).all(axis=1)))) < 1.0:
        notes.append(f"mag: a sample in {share:.0%} of the rows, interpolated between them")
    return notes
