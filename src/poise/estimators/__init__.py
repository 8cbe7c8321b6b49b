"""The methods, by the names the command knows them by."""

from __future__ import annotations

from typing import Any

from poise.estimators.adaptive_gain import AdaptiveGain
from poise.estimators.two_stage import TwoStage

METHODS: dict[str, Any] = {
    "two-stage": TwoStage,
    "adaptive-gain": AdaptiveGain,
}
