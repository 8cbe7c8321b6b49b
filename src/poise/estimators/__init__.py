"""The methods, by the names the command knows them by."""

from __future__ import annotations

from typing import Any, Literal

from poise.estimators.adaptive_gain import AdaptiveGain
from poise.estimators.armband import Armband
from poise.estimators.gated import Gated
from poise.estimators.self_calibrating.causal import SelfCalibrating
from poise.estimators.tilt import Tilt
from poise.estimators.two_stage import TwoStage

METHODS: dict[str, Any] = {
    "self-calibrating": SelfCalibrating,
    "armband": Armband,
    "two-stage": TwoStage,
    "adaptive-gain": AdaptiveGain,
    "tilt": Tilt,
    "gated": Gated,
}


def judged_by(method: str) -> Literal["total", "inclination"]:
    """The error that *method*, by its name or that of its class, answers for: one without a heading has its inclination."""
    cls = METHODS.get(method) or next((each for each in METHODS.values() if each.__name__ == method), None)
    return "total" if cls is None or "declination" in cls._fields else "inclination"
