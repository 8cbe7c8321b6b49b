"""A browser's motion events as a device: frames of raw motion in, samples out once it is known which way they point."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, get_args
from urllib.parse import parse_qs

import numpy as np

from poise.live import frames
from poise.live.devices import DeviceError, Shape
from poise.live.pinning import ANGLES, TIME, Axes, Floats, Pinning, up

if TYPE_CHECKING:
    from poise.live.batch import Newest
    from poise.live.device import Device

_MOST_HELD = 30.0  # s of samples that wait until the axes are known
_MOST_SAMPLES_HELD = 20_000  # whatever their stamps say
_REMEMBERED = 2000  # orientations, for the attitude of the same sample
_APART, _TOGETHER = 30.0, 20.0  # deg of tilt between the browser's orientation and ours
_SHAPES = tuple(shape for shape in get_args(Shape) if shape != "joint")  # which is between two devices, and none itself
_APART_FOR = 3.0  # s until that is told


def asked(query: bytes) -> tuple[Shape | None, Axes | None]:
    """What the query of ``/ws/device/NAME`` says: ``shape`` and ``axes``. Raises :class:`DeviceError`."""
    found = {name: values[-1] for name, values in parse_qs(query.decode("latin-1")).items()}
    shape, axes = found.get("shape"), found.get("axes")
    if shape is not None and shape not in _SHAPES:
        raise DeviceError(f"shape {shape[:40]!r}: expected one of {', '.join(_SHAPES)}")
    try:
        return shape, Axes.parse(axes) if axes else None  # type: ignore[return-value]
    except ValueError as problem:
        raise DeviceError(str(problem)) from None


class Motion:
    """The raw motion that one connection sends to *device*.

    Until the axes are known, samples are held back, the last 30 s of them: they are not in the device, so that a page that
    has to connect again is asked for them again. *axes* are those that the page was told before, if any.
    """

    def __init__(self, device: Device, axes: Axes | None, tell: Callable[[str, str], None]) -> None:
        self._device, self._tell, self.axes = device, tell, axes
        self._pinning = Pinning()
        self._held: list[tuple[int, Floats]] = []
        self._ups: dict[int, Floats] = {}
        self._said: dict[str, Any] = {}
        self._apart_since: float | None = None
        self._apart = False

    def take(self, frame: bytes, now: float) -> int:
        """Takes a frame of raw motion; how many samples of it are new. Raises :class:`FrameError`."""
        head = frames.head(frame, frames.MOTION)
        raw = np.frombuffer(frame, "<f8", offset=frames.HEADER.size).reshape(-1, 10)
        due = self._held[-1][0] + len(self._held[-1][1]) if self._held else self._device.next
        first = due if head.sequence == frames.UNNUMBERED else head.sequence
        self._remember(raw, first)
        if self.axes is not None:
            return self._device.receive(self.axes.rows(raw), now, first)
        known = max(0, due - first)
        if known < len(raw):
            self._held.append((first + known, raw[known:]))
            self._hold(raw[known:], now)
        return max(0, len(raw) - known)

    def _hold(self, raw: Floats, now: float) -> None:
        self.axes = self._pinning.add(raw, now)
        if self.axes is not None:
            held, self._held = self._held, []
            self._tell("axes", f"{self._device.name}: axes known from its motion: {self.axes}")
            for first, part in held:
                self._device.receive(self.axes.rows(part), now, first)
        while self._held and self._too_many():
            del self._held[0]

    def _too_many(self) -> bool:
        oldest, newest = self._held[0], self._held[-1]
        lasted = newest[1][-1, TIME] - oldest[1][-1, TIME]
        return bool(lasted > _MOST_HELD) or newest[0] + len(newest[1]) - oldest[0] > _MOST_SAMPLES_HELD

    def _remember(self, raw: Floats, first: int) -> None:
        self._ups.update(zip(range(first, first + len(raw)), up(raw[:, ANGLES]), strict=True))
        while len(self._ups) > _REMEMBERED + len(raw):
            del self._ups[next(iter(self._ups))]

    def answers(self, newest: Newest) -> Iterator[dict[str, Any]]:
        """What the page is to be told now: whether its axes are known, and its attitude."""
        axes = {
            "type": "axes",
            "axes": self.axes and str(self.axes),
            "reason": None if self.axes else self._pinning.reason,
        }
        if axes != self._said:
            self._said = axes
            yield axes
        run = self._device.runs[0] if self._device.runs else None
        if run is None or self.axes is None or not newest.versions[run.slot]:
            return
        from poise.live.http import as_json

        record = newest.records[run.slot]
        apart = self._difference(record)
        yield {"type": "attitude", "method": run.choice.name, "apart_deg": apart} | as_json(record, self._device.name)

    def _difference(self, record: Any) -> float | None:
        """Degrees of tilt between the browser's own orientation and ours, at the same sample."""
        upward = self._ups.get(int(record["sequence"]))
        w, x, y, z = (float(v) for v in record["quat"])
        ours = np.array([2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)])
        if upward is None or not (np.isfinite(upward).all() and np.isfinite(ours).all()):
            return None
        apart = float(np.degrees(np.arctan2(np.linalg.norm(np.cross(ours, upward)), ours @ upward)))
        self._judge(apart, float(record["time"]))
        return apart

    def _judge(self, apart: float, time: float) -> None:
        name = self._device.name
        if self._apart and apart < _TOGETHER:
            self._apart = False
            self._tell("opinion", f"{name}: the browser's own orientation agrees again")
        if apart <= _APART:
            self._apart_since = None
        elif self._apart_since is None or time < self._apart_since:
            self._apart_since = time
        elif time - self._apart_since >= _APART_FOR and not self._apart:
            self._apart = True
            self._tell("opinion", f"{name}: the browser's own orientation differs in tilt by {apart:.0f}° from ours")
