"""Tip-over monitor: judges from an attitude whether a body stands, tips over, lies, falls freely or is carried."""

from poise.monitor.dry_run import Alarm, DryRun, Fall, dry_run, why_unknown
from poise.monitor.judging import Judgement, Monitor, judge
from poise.monitor.parameters import checked, mounted, tared
from poise.monitor.settings import from_table, read_settings
from poise.monitor.sides import Directions
from poise.monitor.support import Support
from poise.monitor.tip_over import TipOver

__all__ = [
    "Alarm",
    "Directions",
    "DryRun",
    "Fall",
    "Judgement",
    "Monitor",
    "Support",
    "TipOver",
    "checked",
    "dry_run",
    "from_table",
    "judge",
    "mounted",
    "read_settings",
    "tared",
    "why_unknown",
]
