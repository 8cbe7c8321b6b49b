"""What keeps from a method what is no measurement: the stamps, the samples, and the wrapper that judges both."""

from poise.estimators.guard.guard import Guard
from poise.estimators.guard.stamps import unpacked

__all__ = ["Guard", "unpacked"]
