"""What responders are told: an alarm, as a sentence for people and as JSON for machines."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any, Literal

from poise.data.event import TipEvent, TipState

Kind = Literal["fired", "released", "failure", "recovered", "acknowledged", "event", "started", "closed", "test"]


@dataclass(frozen=True)
class Alarm:
    """One thing to be told or done, and the event behind it."""

    kind: Kind
    event: TipEvent
    """the change of state; for a ``test`` or a ``failure`` without one, of state ``UNKNOWN``"""
    utc: datetime
    """when it was decided"""
    robot: str = ""
    stage: str = ""
    count: int = 1
    """1, then one more at every repetition"""
    responder: str = ""
    """of a ``failure``: who failed"""
    detail: str = ""
    """of a ``failure``: why"""
    active: tuple[str, ...] = ()
    """the stages that hold after this"""
    failures: tuple[str, ...] = ()
    """who had failed by then, for the same event, and why"""

    def sentence(self) -> str:
        """One line for people; what is not known is left out."""
        return f"{self.robot}: {self._told()}" if self.robot else self._told()

    def _told(self) -> str:
        if self.kind == "failure":
            return f"{self.responder} failed: {self.detail}"
        if self.kind == "recovered":
            return f"{self.responder} works again"
        if self.kind in ("test", "started", "closed", "acknowledged"):
            return {"test": "this is a test", "started": "responses are ready", "closed": "responses have ended"}.get(
                self.kind, "acknowledged"
            )
        event = self.event
        said = [f"{named(event.state)} {event.direction}".strip()]
        for value, text in (
            (math.degrees(event.tilt), "tilt {:.0f}°"),
            (math.degrees(event.rate), "{:+.0f} °/s"),
            (event.time_to_impact, "impact in {:.2f} s"),
        ):
            if math.isfinite(value):
                said.append(text.format(value))
        line = ", ".join(said) + (f" ({event.reason})" if event.reason else "")
        return f"{self.stage} is over: {line}" if self.kind == "released" else line

    def as_dict(self) -> dict[str, Any]:
        """Everything by name, degrees in names that say so; None for what is not known."""
        event = self.event
        found = {
            "kind": self.kind,
            "utc": self.utc.isoformat(timespec="milliseconds").replace("+00:00", "Z"),
            "robot": self.robot,
            "state": named(event.state),
            "before": named(event.before),
            "direction": event.direction,
            "tilt_deg": _known(math.degrees(event.tilt)),
            "rate_deg_s": _known(math.degrees(event.rate)),
            "time_to_impact_s": _known(event.time_to_impact),
            "time_s": _known(event.time),
            "reason": event.reason,
            "stage": self.stage,
            "count": self.count,
            "active": list(self.active),
            "failures": list(self.failures),
            "sentence": self.sentence(),
        }
        return found | ({"responder": self.responder, "detail": self.detail} if self.responder else {})

    def as_json(self) -> str:
        """One line; NaN is null, as JSON has none."""
        return json.dumps(self.as_dict(), ensure_ascii=False, allow_nan=False)


@dataclass(frozen=True)
class Failure:
    """A responder that did not do what it was asked."""

    utc: datetime
    responder: str
    detail: str
    alarm: Alarm | None = None
    """what it was to tell or do; None where it failed in between, as a connection that breaks"""


def named(state: TipState) -> str:
    """``TipState.FREE_FALL`` as people write it: ``free fall``."""
    return state.name.lower().replace("_", " ")


def now_utc() -> datetime:
    """The wall clock."""
    return datetime.now(UTC)


def no_event(time: float = math.nan, reason: str = "") -> TipEvent:
    """What stands for the event where there is none."""
    return TipEvent(time, TipState.UNKNOWN, TipState.UNKNOWN, reason=reason)


def _known(value: float) -> float | None:
    return round(value, 6) if math.isfinite(value) else None
