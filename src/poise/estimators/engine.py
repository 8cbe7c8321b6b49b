"""`Stream`: a method running over packets as they come; whole recordings are streams fed in blocks."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from math import isfinite, nan
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.data.attitude import COLUMNS, QUAT, Attitude, HeadingReference, Provenance
from poise.data.flags import SILENT
from poise.data.learned import Learned
from poise.data.packet import Packet
from poise.data.recording import check_unit_of_time, samples
from poise.errors import MethodError, RecordingError, StateError
from poise.estimators.loop import (
    ACC,
    ACC_AGE,
    CLOCK,
    DELTA,
    FIRST,
    GYR,
    LAST,
    MAG,
    RESET_AT,
    RESETS,
    TIME,
    TURN,
    WIDTH,
    advance,
    begin,
    begin_at,
    recall,
    state_of,
)
from poise.estimators.parameters import as_dict, prepared
from poise.estimators.saving import copied, differences, filled, flat, read_saved, sealed
from poise.estimators.starting import checked_start, start_quaternion, three_finite
from poise.estimators.wrapping import core, innermost, name_of, slewed, wrapped
from poise.math import arrays
from poise.math.compiled import CompileError, direct
from poise.math.vectors import Vec3

Floats = NDArray[np.float64]


class Stream:
    """A method running live: give it packets as they come, one sample or many, and get their attitudes.

    The answers are, bit for bit, those of :func:`estimate` over the same samples, however they are split into packets.

    *start* is an attitude to start at (an :class:`Attitude`, whose first known row counts, or w x y z, body to ENU); by
    default the first usable accelerometer and magnetometer samples decide. *bias* (rad/s) is the gyroscope's, where it
    is known. ``guard=None`` and ``rest_bias=False`` leave the wrappers out; a method given inside a ``Guard`` is taken as it
    is. Without the guard, stamps must rise and samples be finite: a method divides by the time between them.

    *start_from* is what was learned of the same sensor before (:class:`Learned`, or an attitude that has it). *slew* (rad/s)
    bounds how fast corrections turn the attitude given out: see :class:`Slewed` and :attr:`pending`.
    """

    def __init__(
        self,
        method: Any,
        start: Attitude | ArrayLike | None = None,
        *,
        bias: ArrayLike = (0.0, 0.0, 0.0),
        guard: bool | None = True,
        rest_bias: bool = True,
        silence: float = 0.05,
        start_from: Learned | Attitude | None = None,
        slew: float | None = None,
    ) -> None:
        self.method = method
        self._made_of = (method, start, tuple(three_finite("bias", bias)), guard, rest_bias, silence, start_from, slew)
        self._running = prepared(slewed(wrapped(method, guard, rest_bias), slew))
        if not isinstance(silence, (int, float)) or not silence >= 0.0:
            raise MethodError(f"silence: expected seconds, found {silence!r}")
        self._declination = float(getattr(core(method), "declination", 0.0))
        self._provenance = Provenance(name_of(method), as_dict(self._running))
        self._start = None if start is None else start_quaternion(start)
        self._bias = Vec3(*three_finite("bias", bias))
        self._known = None if start_from is None else checked_start(core(method), start_from, self._bias)
        if self._known is not None:
            self._bias = Vec3(*self._known["gyr_bias"]["value"])
        self._silence = silence
        self._memory: Any = None
        self._has_declination = hasattr(core(method), "declination")
        self._reset = False  # whether the heading was set by hand
        self._run: Any = None
        self._row = np.zeros((1, WIDTH))
        self._gyr, self._acc, self._mag = self._row[0, GYR:ACC], self._row[0, ACC:MAG], self._row[0, MAG:ACC_AGE]
        self._aside = np.array([nan, 1.0, 1.0, 0, 0, 0, 1.0, 0, 0, 0, 0, nan, nan, nan, nan])
        self._heading: HeadingReference = start.heading_reference if isinstance(start, Attitude) else "arbitrary"
        self._latest: Attitude | None = None
        self._space: Iterator[Any] = iter(())

    def update(self, packet: Packet) -> Attitude:
        """The attitudes after the samples of *packet*, one row each.

        Raises :class:`RecordingError` for a packet whose shapes do not fit; the stream goes on as if it had not come.
        """
        if not isinstance(packet, tuple) or len(packet) != 4:
            raise RecordingError(f"expected a Packet(time, gyr, acc, mag), found {packet!r}")
        if isinstance(packet[0], float):
            self._fill_row(packet)
            space = next(self._space, None)
            if space is None:
                self._space = _space()
                space = next(self._space)
            time, table, flags = space
            time[0] = packet[0]
            if self._run is not None:
                self._run(self._memory, self._row, table, flags)
            else:
                self._advance_into(self._row, table, flags)
            self._latest = attitude = Attitude.view(time, table, flags, self._heading, self._provenance)
            return attitude
        if isinstance(packet[0], (int, np.number)):
            return self.update(Packet(float(packet[0]), *packet[1:]))
        many = samples(*packet)
        check_unit_of_time(many["time"], even=True)
        rows = np.zeros((len(many["time"]), WIDTH))
        rows[:, TIME] = many["time"]
        rows[:, GYR:ACC], rows[:, ACC:MAG], rows[:, MAG:ACC_AGE] = many["gyr"], many["acc"], many["mag"]
        self._see_mag(rows)
        return self._advance(rows, many["time"])

    def update_rows(self, rows: Floats, table: Floats, flags: NDArray[np.uint32]) -> None:
        """:meth:`update` for *rows* (n, 12), n ≥ 1, as the loop reads them (``ROW_COLUMNS``), unchecked.

        For whoever runs hundreds of streams over one array of samples, and has a *table* (n, 16) and *flags* (n,) to fill.
        """
        self._see_mag(rows)
        self._advance_into(rows, table, flags)
        last = rows[-1:, TIME].copy(), table[-1:].copy(), flags[-1:].copy()  # a view would keep all of their arrays
        self._latest = Attitude.view(*last, self._heading, self._provenance)

    def _advance(self, rows: Floats, time: Floats) -> Attitude:
        n = len(time)
        table = np.empty((n, COLUMNS))
        flags = np.empty(n, np.uint32)
        if n:
            self._advance_into(rows, table, flags)
        attitude = Attitude.view(time, table, flags, self._heading, self._provenance)
        if n:
            self._latest = attitude
        return attitude

    def _advance_into(self, rows: Floats, table: Floats, flags: NDArray[np.uint32]) -> None:
        if self._run is not None:
            self._run(self._memory, rows, table, flags)
        else:
            try:
                self._begin(rows)
                advance(self._memory, rows, table, flags)
            except CompileError as problem:
                raise MethodError(
                    f"{name_of(self.method)} does not compile: {_reason(problem)}; "
                    "run it with NUMBA_DISABLE_JIT=1 to see where in plain Python"
                ) from problem
            self._run = direct(advance, self._memory, rows, table, flags)

    def _begin(self, rows: Floats) -> None:
        if self._start is None:
            first = rows[:1].copy()
            first[0, MAG:ACC_AGE] = self._cleared(first[0, MAG:ACC_AGE])
            self._memory = begin(self._running, first, self._bias, self._aside)
        else:
            self._memory = begin_at(self._running, self._start, self._declination, self._bias, self._aside)
            self._aside[LAST : LAST + 4] = self._start
        if self._known is not None:  # the state's arrays are written into; its numbers hold the bias already
            core(self._running).start_from(innermost(state_of(self._memory)), self._known)

    def _cleared(self, mag: Floats) -> Floats:
        """The first sample of the magnetometer, without what is known of its hard iron."""
        if self._known is None:
            return mag
        cleared: Floats = core(self._running).cleared(mag, self._known)
        return cleared

    def check(self, now: float) -> Attitude:
        """The attitude at *now* (s, the packets' clock) without a new sample, one row; for a timer.

        When the last sample is older than *silence* (0.05 s unless told) the row is flagged SILENT and not valid: the
        attitude it holds is the last one known.
        """
        if not isinstance(now, (int, float)) or not isfinite(now):
            raise RecordingError(f"now: expected seconds on the packets' clock, found {now!r}")
        if self._latest is None:
            row = Attitude.of([now], np.full((1, 4), nan))
            row.flags[:] |= np.uint32(SILENT)
            return row
        row = self._latest[-1:]
        flags = row.flags.copy()
        if not now - self._aside[CLOCK] <= self._silence:
            flags |= np.uint32(SILENT)
        return replace(row, time=np.array([float(now)]), table=row.table.copy(), flags=flags)

    def reset_heading(self, forward: str = "y") -> None:
        """From now on, the direction that the body axis *forward* points to at this moment is north.

        Raises :class:`StateError` where there is no attitude yet.
        """
        if self._latest is None or not isfinite(self._latest.quat[-1, 0]):
            raise StateError("no attitude yet, so there is no heading to reset; feed samples first")
        heading = float(self._latest[-1:].heading(forward)[0])
        turn = arrays.turn_about_up(np.array(heading))
        self._aside[TURN : TURN + 4] = arrays.multiply(turn, self._aside[TURN : TURN + 4])
        self._aside[LAST : LAST + 4] = arrays.multiply(turn, self._aside[LAST : LAST + 4])
        self._heading, self._reset = "arbitrary", True
        self._latest = _turned(self._latest[-1:], turn)

    @property
    def state(self) -> Any:
        """A snapshot of the method's state, wrappers included; None before the first sample."""
        return None if self._memory is None else copied(state_of(self._memory))

    @property
    def learned(self) -> Learned | None:
        """What the method has found out about the sensors so far, where it does: name → value, sigma and unit."""
        inside, state = core(self._running), self.running_state
        if state is None or not hasattr(inside, "learned"):
            return None
        found: Learned = inside.learned(innermost(state))
        return found

    @property
    def pending(self) -> Floats:
        """(3,) rad, about the Earth's axes: the turn from the attitude given out to the method's own; see *slew*."""
        state = self.running_state
        return np.array(getattr(state, "pending", (0.0, 0.0, 0.0)), float)

    @property
    def latest(self) -> Attitude | None:
        """The attitude after the last sample, one row; None before the first."""
        return None if self._latest is None else self._latest[-1:]

    @property
    def heading_reference(self) -> HeadingReference:
        """What a heading of zero means by now."""
        return self._heading

    @property
    def parameters(self) -> dict[str, Any]:
        """Every parameter of the method with its wrappers, by name."""
        return dict(self._provenance.parameters)

    @property
    def resets(self) -> int:
        """How often the attitude was set anew so far: rows flagged RESET."""
        return int(self._aside[RESETS])

    @property
    def reset_delta(self) -> Floats:
        """(3,) rad: the rotation vector, about the Earth's axes, by which the last reset turned the attitude; else NaN."""
        return self._aside[DELTA : DELTA + 3].copy()

    @property
    def reset_time(self) -> float:
        """s, the stamp of the last reset's row; NaN before the first."""
        return float(self._aside[RESET_AT])

    @property
    def running_state(self) -> Any:
        """The method's state itself, where it holds arrays, not a snapshot; None before the first sample."""
        return None if self._memory is None else state_of(self._memory)

    def save(self) -> bytes:
        """Everything needed to go on in another process: JSON text with a checksum, no pickle. See :meth:`restore`."""
        latest = self._latest
        kept = {
            "method": self.identity,
            "state": flat(self.state),
            "aside": self._aside.tolist(),
            "heading_reference": self._heading,
            "heading_reset": self._reset,
            "latest": None if latest is None else [latest.table[-1].tolist(), int(latest.flags[-1])],
        }
        return sealed(kept)

    def restore(self, saved: bytes) -> Self:
        """Go on where :meth:`save` was called, bit for bit; returns the stream.

        Raises :class:`StateError` where *saved* is not a stream's state, is damaged, or is that of another method or
        parameter set; the stream is then what it was.
        """
        kept = read_saved(saved)
        if kept.identity != self.identity:
            raise StateError(
                f"the saved stream differs from this one: {differences(str(kept.identity), self.identity)}; "
                "restore it into a Stream with the same method and parameters"
            )
        memory, run, aside, row = None, None, kept.aside, None
        if kept.numbers is not None:
            template = begin(self._running, np.full((1, WIDTH), nan), self._bias, aside)
            memory = recall(self._running, filled(state_of(template), kept.numbers), aside)
            empty = np.empty((0, WIDTH)), np.empty((0, COLUMNS)), np.empty(0, np.uint32)
            first = aside[FIRST]
            advance(memory, *empty)
            aside[FIRST] = first  # no row has been seen by that
            run = direct(advance, memory, *empty)
        if kept.latest is not None:
            row = Attitude(aside[[CLOCK]], *kept.latest, kept.heading, "enu", self._provenance)
        self._memory, self._run, self._aside = memory, run, aside
        self._heading, self._reset, self._latest = kept.heading, kept.reset, row
        return self

    def __reduce__(self) -> Any:
        """Copies and pickles are streams of their own, at the same place."""
        return _revived, (*self._made_of, self.save())

    @property
    def identity(self) -> str:
        """The method with its wrappers and every parameter: what a saved state belongs to."""
        return f"{type(self._running).__name__}{json.dumps(as_dict(self._running), default=repr)}"

    def _fill_row(self, packet: Packet) -> None:
        """One sample in the buffer that is kept for it: the common case live."""
        time, gyr, acc, mag = packet
        try:
            if len(gyr) != 3 or len(acc) != 3 or (mag is not None and len(mag) != 3):  # type: ignore[arg-type]
                raise ValueError
            self._gyr[:] = gyr
            self._acc[:] = acc
            self._mag[:] = nan if mag is None else mag
        except (TypeError, ValueError):
            raise RecordingError(
                f"packet of one sample: expected three numbers each for gyr, acc, mag, found {gyr!r}, {acc!r}, {mag!r}"
            ) from None
        self._row[0, TIME] = time
        if mag is not None and self._heading == "arbitrary":
            self._see_mag(self._row)

    def _see_mag(self, rows: Floats) -> None:
        """The heading means something once a magnetometer has spoken, until `reset_heading` gives it another zero."""
        if self._heading == "arbitrary" and self._has_declination and not self._reset:
            mag = rows[:, MAG:ACC_AGE]
            if (np.isfinite(mag).all(axis=1) & mag.any(axis=1)).any():
                self._heading = "true" if self._declination else "magnetic"


def _revived(method: Any, start: Any, *made_of: Any) -> Stream:
    bias, guard, rest_bias, silence, start_from, slew, saved = made_of
    stream = Stream(
        method, start, bias=bias, guard=guard, rest_bias=rest_bias, silence=silence, start_from=start_from, slew=slew
    )
    return stream.restore(saved)


def _space() -> Iterator[tuple[Floats, Floats, NDArray[np.uint32]]]:
    """Room for the answers to single samples: a view of a block is made in a third of an array's time."""
    n = 32
    return zip(np.empty((n, 1)), np.empty((n, 1, COLUMNS)), np.empty((n, 1), np.uint32), strict=True)


def _reason(problem: Exception) -> str:
    """The line of a compiler's report that says what is wrong."""
    lines = [line.strip() for line in str(problem).splitlines() if line.strip()]
    return next((line for line in lines if not line.startswith(("Failed", "During", "File"))), lines[0])


def _turned(row: Attitude, turn: Floats) -> Attitude:
    table = row.table.copy()
    table[:, QUAT] = arrays.multiply(turn, row.quat)
    return replace(row, table=table, heading_reference="arbitrary")
