"""Recordings that are too long for memory: estimated in chunks, with what is told of them kept while they pass."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from poise.cli import corrected
from poise.cli.options import Reading, Running
from poise.cli.proof import HeadingProof
from poise.data.attitude import Attitude
from poise.data.flags import why_invalid
from poise.data.recording import Recording
from poise.errors import FormatError, RecordingError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from poise.formats.chunks import Chunks

ROWS = 65_536  # of a chunk, and of a row group in Parquet
_SHOWN = 65_536  # rows of a picture, at least half as many


def suits(file: Path, reading: Reading, running: Running, kind: str) -> bool:
    """Whether *file* is estimated in chunks: it is large, and neither its rows nor their attitudes are needed at once."""
    from poise.file_to_file import KINDS

    if running.offline or kind not in KINDS or corrected.with_profile(reading).delay:
        return False  # a delay moves samples from one chunk to another
    try:
        return file.stat().st_size > reading.limits().whole
    except OSError:
        return False  # said where the file is read


def estimate(
    file: Path,
    target: Path,
    kind: Any,
    frame: Any,
    picture: Path | None,
    reading: Reading,
    running: Running,
    tell: Callable[[str, float], None],
) -> dict[str, Any]:
    """Write the attitude, and its picture; the line of the summary. Goes on where a killed run got to."""
    from poise.estimators import METHODS, judged_by
    from poise.file_to_file import Account, estimate_file
    from poise.formats import read_chunks

    reading = corrected.with_profile(reading)
    chunks = read_chunks(file, ROWS, **reading.as_arguments())
    if not reading.force:
        check_before(reading, chunks)
    errors, shown, proof = ErrorSums(), Thinned(_SHOWN), HeadingProof()
    accounts: dict[str, Account] = {"errors": errors, "heading": proof}
    if picture:
        accounts["shown"] = shown
    written = estimate_file(
        chunks,
        target,
        running.build(),
        format=kind,
        frame=frame,
        correct=lambda recording: corrected.applied(reading, recording),
        corrected_by=reading.remap or "",
        heading_reference="true" if running.told_declination else None,
        accounts=accounts,
        progress=lambda rows: tell(f"estimating, {rows:,} rows done", 0.5),
        rest_bias=running.rest_bias,
        start_from=running.before(),
        slew=running.slew_per_second,
    )
    facts, notes = chunks.sniffed, list(chunks.notes)
    if written.resumed:
        notes.append(f"went on behind the {written.resumed:,} rows that an interrupted run had written")
    if picture:
        from poise.plots import attitude_figure, save_figure

        tell("drawing", 0.9)
        recording, attitude = shown.rows(frame, written.heading_reference)
        save_figure(attitude_figure(attitude, recording, title=chunks.name), picture)
        if shown.stride > 1:
            notes.append(f"the picture shows every {shown.stride}th row, with the flags of those between")
    judged = errors.rmse_deg()
    return {
        "file": str(file),
        "output": str(target),
        "plot": str(picture) if picture else None,
        "rows": written.rows,
        "seconds": facts.duration,
        "rate_hz": facts.rate_hz,
        "valid": written.valid,
        "invalid_because": why_invalid(written.flags),
        "heading": written.heading_reference,
        "heading_unproven": proof.unproven,
        "frame": frame,
        "error_deg": judged,
        "judged_by": judged_by(METHODS[running.method].__name__) if judged else None,
        "learned": written.learned,
        "notes": notes + proof.notes(offline=False),
    }


def check_before(reading: Reading, chunks: Chunks) -> None:
    """Refuse a file with units or axes that are surely wrong, as :func:`corrected.read` does, by a sample of its rows.

    That is all of a short file, and stretches spread over a long one, each looked at by itself: a file may begin with an
    hour of rest, which tells nothing.
    """
    sample = chunks.sample()
    steps = np.diff(sample.time)
    known = steps[steps > 0]
    apart = np.flatnonzero(~(np.abs(steps) < 1.0 + 10.0 * np.median(known))) + 1 if len(known) else np.empty(0, int)
    try:
        for rows in np.split(np.arange(len(sample)), apart):
            if len(rows) > 1:
                part = sample[int(rows[0]) : int(rows[-1]) + 1]
                corrected.check(reading, corrected.applied(reading, part), chunks.sniffed)
    except RecordingError as error:
        raise FormatError(f"{chunks.source}: {error}") from None


class ErrorSums:
    """The errors against the file's own reference, row by row as they pass."""

    def __init__(self) -> None:
        self._sums = np.zeros(4)  # counted rows, and the squares of total, heading and inclination, rad²
        self._judged = False

    def add(self, recording: Recording, attitude: Attitude) -> None:
        """The next rows."""
        if recording.truth is None:
            return
        from poise.evaluation import evaluate

        found = evaluate(attitude, recording)
        squares = [np.sum(e[found.counted] ** 2) for e in (found.total, found.heading, found.inclination)]
        self._sums += [found.counted.sum(), *squares]
        self._judged = True

    def rmse_deg(self) -> dict[str, float] | None:
        """Total, heading, inclination in degrees; None where the file holds no reference."""
        if not self._judged:
            return None
        with np.errstate(invalid="ignore", divide="ignore"):
            found = np.degrees(np.sqrt(self._sums[1:] / self._sums[0]))
        return dict(zip(("total", "heading", "inclination"), map(float, found), strict=True))

    def state(self) -> dict[str, NDArray[Any]]:
        """The sums."""
        return {"sums": self._sums, "judged": np.array(self._judged)}

    def restore(self, state: dict[str, NDArray[Any]]) -> None:
        """Go on from the sums."""
        self._sums, self._judged = state["sums"], bool(state["judged"])


class Thinned:
    """Every so manieth row, with the flags of the rows behind it: at most *most*, and half as many at least."""

    def __init__(self, most: int) -> None:
        self.stride = 1
        self._most = most
        self._rows = 0
        self._kept: dict[str, NDArray[Any]] = {}

    def add(self, recording: Recording, attitude: Attitude) -> None:
        """The next rows."""
        n = len(attitude)
        first = -self._rows % self.stride
        kept = slice(first, n, self.stride)
        if first and self._kept:
            self._kept["flags"][-1] |= np.bitwise_or.reduce(attitude.flags[:first])
        new: dict[str, NDArray[Any]] = {"time": attitude.time[kept], "table": attitude.table[kept]}
        starts = np.arange(n)[kept]
        new["flags"] = np.bitwise_or.reduceat(attitude.flags, starts) if len(starts) else attitude.flags[:0].copy()
        if recording.truth is not None:
            new["truth"] = recording.truth.to(attitude.frame).quat[kept]
        if recording.moving is not None:
            new["moving"] = recording.moving[kept]
        self._kept = {
            name: np.concatenate([self._kept[name], v]) if self._kept else v.copy() for name, v in new.items()
        }
        self._rows += n
        while len(self._kept["time"]) > self._most:
            flags = self._kept["flags"]
            flags[: len(flags) // 2 * 2 : 2] |= flags[1::2]
            self._kept = {name: values[::2].copy() for name, values in self._kept.items()}
            self.stride *= 2

    def rows(self, frame: Any, heading: Any) -> tuple[Recording, Attitude]:
        """The rows that are kept."""
        kept, none = self._kept, np.full((len(self._kept["time"]), 3), np.nan)
        attitude = Attitude(kept["time"], kept["table"], kept["flags"], heading, frame)
        truth = Attitude.of(kept["time"], kept["truth"], frame=frame) if "truth" in kept else None
        empty = Recording(np.empty(0), none[:0], none[:0])
        recording = empty.with_samples(
            time=kept["time"], gyr=none, acc=none, mag=none, truth=truth, moving=kept.get("moving")
        )
        return recording, attitude

    def state(self) -> dict[str, NDArray[Any]]:
        """The rows kept, and how they were chosen."""
        return {**self._kept, "counts": np.array([self.stride, self._rows])}

    def restore(self, state: dict[str, NDArray[Any]]) -> None:
        """Go on from the rows kept."""
        kept = dict(state)
        self.stride, self._rows = (int(v) for v in kept.pop("counts"))
        self._kept = kept
