"""The methods, by the names the command knows them by."""

from __future__ import annotations

from typing import Any

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
