"""poise: attitude from inertial samples, with its uncertainty and its reasons.

recording = poise.read("walk.csv")
attitude = poise.estimate(poise.TwoStage(), recording)
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from poise.version import __version__ as __version__

# Names are imported when they are first used: `poise --help` must not wait for a compiler.
_HOME = {
    "AdaptiveGain": "poise.estimators.adaptive_gain",
    "Armband": "poise.estimators.armband",
    "Attitude": "poise.data.attitude",
    "AttitudeControl": "poise.control.attitude",
    "Comparison": "poise.comparison",
    "Conformance": "poise.conformance",
    "Controller": "poise.control.controller",
    "Diagnosis": "poise.doctor",
    "Errors": "poise.evaluation",
    "Flag": "poise.data.flags",
    "Gated": "poise.estimators.gated",
    "Guard": "poise.estimators.guard",
    "Learned": "poise.data.learned",
    "Learning": "poise.data.learned",
    "METHODS": "poise.estimators",
    "Monitor": "poise.monitor",
    "Packet": "poise.data.packet",
    "PoiseError": "poise.errors",
    "Recording": "poise.data.recording",
    "Responses": "poise.responses",
    "RestBias": "poise.estimators.rest_bias",
    "SelfCalibrating": "poise.estimators.self_calibrating.causal",
    "Slew": "poise.control.target",
    "Slewed": "poise.estimators.slewed",
    "Stream": "poise.estimators.engine",
    "Target": "poise.control.target",
    "Tilt": "poise.estimators.tilt",
    "TipOver": "poise.monitor",
    "TwoStage": "poise.estimators.two_stage",
    "compare": "poise.comparison",
    "conform": "poise.conformance",
    "diagnose": "poise.doctor",
    "estimate": "poise.estimators.batch",
    "estimate_chunks": "poise.estimators.batch",
    "estimate_file": "poise.file_to_file",
    "evaluate": "poise.evaluation",
    "lqr": "poise.control.design",
    "read": "poise.formats",
    "read_attitude": "poise.formats",
    "read_learned": "poise.formats",
    "read_chunks": "poise.formats",
    "smooth": "poise.estimators.self_calibrating.smoother",
    "sniff": "poise.formats",
    "write": "poise.formats",
}

__all__ = [*_HOME]  # noqa: PLE0604  (a literal below would say everything twice)

if TYPE_CHECKING:
    from poise.comparison import Comparison as Comparison
    from poise.comparison import compare as compare
    from poise.conformance import Conformance as Conformance
    from poise.conformance import conform as conform
    from poise.control.attitude import AttitudeControl as AttitudeControl
    from poise.control.controller import Controller as Controller
    from poise.control.design import lqr as lqr
    from poise.control.target import Slew as Slew
    from poise.control.target import Target as Target
    from poise.data.attitude import Attitude as Attitude
    from poise.data.flags import Flag as Flag
    from poise.data.learned import Learned as Learned
    from poise.data.learned import Learning as Learning
    from poise.data.packet import Packet as Packet
    from poise.data.recording import Recording as Recording
    from poise.doctor import Diagnosis as Diagnosis
    from poise.doctor import diagnose as diagnose
    from poise.errors import PoiseError as PoiseError
    from poise.estimators import METHODS as METHODS
    from poise.estimators.adaptive_gain import AdaptiveGain as AdaptiveGain
    from poise.estimators.armband import Armband as Armband
    from poise.estimators.batch import estimate as estimate
    from poise.estimators.batch import estimate_chunks as estimate_chunks
    from poise.estimators.engine import Stream as Stream
    from poise.estimators.gated import Gated as Gated
    from poise.estimators.guard import Guard as Guard
    from poise.estimators.rest_bias import RestBias as RestBias
    from poise.estimators.self_calibrating.causal import SelfCalibrating as SelfCalibrating
    from poise.estimators.self_calibrating.smoother import smooth as smooth
    from poise.estimators.slewed import Slewed as Slewed
    from poise.estimators.tilt import Tilt as Tilt
    from poise.estimators.two_stage import TwoStage as TwoStage
    from poise.evaluation import Errors as Errors
    from poise.evaluation import evaluate as evaluate
    from poise.file_to_file import estimate_file as estimate_file
    from poise.formats import read as read
    from poise.formats import read_attitude as read_attitude
    from poise.formats import read_chunks as read_chunks
    from poise.formats import read_learned as read_learned
    from poise.formats import sniff as sniff
    from poise.formats import write as write
    from poise.monitor import Monitor as Monitor
    from poise.monitor import TipOver as TipOver
    from poise.responses import Responses as Responses


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'poise' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*_HOME, "__version__"])
