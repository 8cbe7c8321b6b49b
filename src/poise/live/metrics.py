"""Health as Prometheus reads it."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from poise.data.flags import Flag

if TYPE_CHECKING:
    from poise.live.server import Server

_DEVICE = (
    ("samples_total", "counter", "samples taken", "samples"),
    ("lost_total", "counter", "samples that never came, by their numbers", "lost"),
    ("repeated_total", "counter", "samples that came again", "repeated"),
    ("rejected_total", "counter", "frames that could not be read", "rejected"),
    ("throttled_total", "counter", "samples not taken since there were too many a second", "throttled"),
    ("late_total", "counter", "packets more than 50 ms later than its clock says", "late"),
    ("silences_total", "counter", "times it fell silent", "silences"),
    ("rate_hz", "gauge", "samples a second of late", "rate_hz"),
    ("silent", "gauge", "1 while nothing comes", "silent"),
    ("standing", "gauge", "1 while its clock stands still", "standing"),
    ("failed", "gauge", "1 after a fault has ended its run", "failed"),
    ("clock_drift_ppm", "gauge", "how much the host's clock gains on the device's", "clock_drift_ppm"),
)
_STATES = ("silent", "standing", "failed")


def metrics(server: Server) -> str:
    """All figures as Prometheus' text format."""
    now = time.monotonic()
    conditions = server.hub.conditions(server.hub.devices.values(), now)
    lines: list[str] = []
    for name, kind, text, key in _DEVICE:
        values = [(_label(c), c["state"] == key if key in _STATES else c[key]) for c in conditions]
        _family(lines, f"poise_device_{name}", kind, text, values)
    invalid = [(f'{_label(c)},method="{m}"', n) for c in conditions for m, n in c["invalid"].items()]
    _family(lines, "poise_invalid_total", "counter", "attitudes not to be acted on", invalid)
    flags = [
        (f'device="{device.name}",method="{run.choice.name}",flag="{flag.name}"', 1.0)
        for device in server.hub.devices.values()
        for run in device.runs
        for flag in Flag(int(server.hub.newest.records["flags"][run.slot]))
    ]
    _family(lines, "poise_flag", "gauge", "1 while the newest attitude has this flag", flags)
    waits_of = [
        (f'{_label(c)},quantile="{q}"', c["wait_ms"][key] / 1e3)
        for c in conditions
        for q, key in ((0.5, "p50"), (0.99, "p99"))
    ]
    text = "from a sample's arrival to its attitude, of a device"
    _family(lines, "poise_device_wait_seconds", "gauge", text, waits_of)
    sources = [(f'source="{_escaped(c["name"])}",state="{c["state"]}"', 1.0) for c in server.feeding.conditions()]
    _family(lines, "poise_source", "gauge", "1 for the state that a source is in", sources)
    _family(lines, "poise_viewers", "gauge", "connected viewers", [("", len(server.viewers))])
    _family(lines, "poise_tick_seconds", "gauge", "mean cost of a tick with samples", [("", server.hub.tick_cost)])
    waits = server.hub.waits
    quantiles = [(f'quantile="{q}"', waits.quantile(q)) for q in (0.5, 0.99)]
    _family(lines, "poise_sample_to_attitude_seconds", "gauge", "from a sample's arrival to its attitude", quantiles)
    if server.recorder is not None:
        condition = server.recorder.condition()
        _family(lines, "poise_recording", "gauge", "1 while samples are written", [("", condition["reason"] is None)])
        _family(lines, "poise_recorder_waiting", "gauge", "samples not written yet", [("", condition["waiting"])])
        _family(lines, "poise_recorder_lost_total", "counter", "samples never written", [("", condition["lost"])])
    return "\n".join(lines) + "\n"


def _escaped(text: str) -> str:
    return text.replace("\\", r"\\").replace('"', r"\"").replace("\n", " ")


def _label(condition: dict[str, Any]) -> str:
    return f'device="{condition["id"]}"'


def _family(lines: list[str], name: str, kind: str, text: str, values: list[tuple[str, float]]) -> None:
    lines += [f"# HELP {name} {text}", f"# TYPE {name} {kind}"]
    lines += [
        f"{name}{{{label}}} {float(value):.9g}" if label else f"{name} {float(value):.9g}" for label, value in values
    ]
