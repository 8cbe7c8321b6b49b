"""Tip-over monitor: judges from an attitude whether a body stands, tips over, lies, falls freely or is carried."""

from poise.monitor.judging import Judgement, Monitor, judge
from poise.monitor.parameters import checked, mounted, tared
from poise.monitor.settings import from_table, read_settings
from poise.monitor.sides import Directions
from poise.monitor.support import Support
from poise.monitor.tip_over import TipOver

__all__ = [
    "Directions",
    "Judgement",
    "Monitor",
    "Support",
    "TipOver",
    "checked",
    "from_table",
    "judge",
    "mounted",
    "read_settings",
    "tared",
]
