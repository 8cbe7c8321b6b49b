"""Options of the tip-over monitor, and what they mean."""

from __future__ import annotations

import re
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Group, Parameter

from poise.cli.options import Dashed
from poise.cli.words import pairs, usage
from poise.errors import PoiseError

if TYPE_CHECKING:
    from poise.data.attitude import Attitude
    from poise.monitor import TipOver

MONITOR = Group("The monitor", sort_key=3)


@Parameter(name="*", group=MONITOR)
@dataclass(frozen=True)
class Watching:
    """When a body tips over; angles in degrees, times in seconds."""

    config: Path | None = None
    """A TOML file whose table `[tipover]` has the parameters, a support polygon too; options here count more."""

    range_: Annotated[str | None, Parameter(name="--range")] = None
    """Preset range: at or beyond it the body leans. One number (20 unless told), or `forward=15,back=25,left=20,right=20`."""

    self_balancing: str | None = None
    """Largest self-balancing angle: at or beyond it the body tips over. One number (40 unless told), or by direction."""

    dwell: float | None = None
    """How long a lean must hold before it counts (0.05 unless told)."""

    hysteresis: float | None = None
    """How far inside a limit the lean must come back (3 unless told)."""

    look_ahead: float | None = None
    """How far ahead the lean is predicted from its rate, once beyond the range (0.15 unless told; 0: not at all)."""

    impact: float | None = None
    """The lean at which the body hits the ground (80 unless told)."""

    mount: Dashed = None
    """Which of the sensor's axes point to the robot's right, forward and up: `--mount "y -x z"`."""

    tare: Dashed = None
    """`START,END`: seconds from the start of the recording in which the robot stands upright, without payload."""

    def build(self) -> TipOver:
        """The monitor's parameters; :class:`UsageError` where they cannot be."""
        from poise.monitor import checked, from_table, read_settings

        table: dict[str, Any] = {}
        for name, text in (("range", self.range_), ("self_balancing", self.self_balancing)):
            if text is not None:
                table[name] = _angles(f"--{name.replace('_', '-')}", text)
        for name in ("dwell", "hysteresis", "look_ahead", "impact", "mount"):
            if (value := getattr(self, name)) is not None:
                table[name] = value
        self._stretch()
        try:
            base = None if self.config is None else read_settings(self.config)
        except PoiseError as error:
            usage(f"--config {error}")
        try:
            return checked(from_table(table, base))
        except PoiseError as error:
            usage(_as_options(str(error)))

    def tared(self, tipover: TipOver, attitude: Attitude) -> TipOver:
        """With the slant of the sensor taken out. Raises :class:`RecordingError` where the robot does not stand there."""
        from poise.errors import RecordingError
        from poise.monitor import tared

        if (stretch := self._stretch()) is None:
            return tipover
        start, end = stretch
        since = attitude.time - attitude.time[0] if len(attitude) else attitude.time
        rows = (since >= start) & (since <= end)
        if not rows.any():
            raise RecordingError(f"--tare {self.tare}: the recording has no row between these seconds from its start")
        return tared(tipover, attitude[rows])

    def _stretch(self) -> tuple[float, float] | None:
        if self.tare is None:
            return None
        try:
            start, end = (float(part) for part in self.tare.split(","))
        except ValueError:
            start, end = 1.0, 0.0
        if not 0.0 <= start < end:
            usage(f"--tare {self.tare}: expected START,END in seconds, the start first")
        return start, end


def _as_options(text: str) -> str:
    """*text* about a parameter of the monitor, named as the option that sets it."""
    names = {field.name.rstrip("_") for field in fields(Watching)} - {"config"}
    if re.split(r"\W", text, maxsplit=1)[0] not in names:
        return text
    return "--" + text.replace("self_balancing", "--self-balancing").replace("look_ahead", "look-ahead").removeprefix(
        "--"
    )


def _angles(option: str, text: str) -> Any:
    """One number, or a number for each direction that is named."""
    if "=" not in text:
        return _degrees(option, text)
    return {name: _degrees(option, angle) for name, angle in (pairs(text, option, "forward=15,back=25") or {}).items()}


def _degrees(option: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        usage(f"{option} {text!r}: expected degrees, or pairs such as forward=15,back=25")
