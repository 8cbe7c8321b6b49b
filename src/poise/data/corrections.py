"""Corrections: what must be done to a recording's samples before its sensors speak of one body in SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from poise.data.recording import Recording


@dataclass(frozen=True)
class Corrections:
    """Factors, axes and delays of single sensors; nothing at all by default."""

    factors: Mapping[str, float] = field(default_factory=dict)
    """by "time", "gyr", "acc", "mag": what the numbers are to be multiplied by"""
    axes: Mapping[str, str] = field(default_factory=dict)
    """by sensor: words, ``"y -x z"``; a mirror image, too"""
    delays: Mapping[str, float] = field(default_factory=dict)
    """by "acc", "mag": s that its samples come late against the gyroscope's"""

    def __bool__(self) -> bool:
        return bool(self.factors or self.axes or self.delays)

    def apply(self, recording: Recording) -> Recording:
        """*recording* with the factors, then the axes, then the delays. Raises :class:`RecordingError` for what cannot be."""
        scaled = {name: getattr(recording, name) * factor for name, factor in self.factors.items()}
        if "time" in self.factors:
            scaled |= {name: getattr(recording, name) * self.factors["time"] for name in ("acc_age", "mag_age")}
        fixed = recording.with_samples(**scaled) if scaled else recording
        for sensor, words in self.axes.items():
            fixed = fixed.remap(words, sensor)
        return fixed.advance(**self.delays) if self.delays else fixed
