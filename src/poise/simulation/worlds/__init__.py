"""Worlds: bodies moved by physics (MuJoCo, extra ``sim``) that carry sensors with the errors of real parts.

``world = worlds.make("balance", seed=1)``, then ``world.step(command)`` for every sample; ``worlds.stream(world)`` for a
live device. :class:`World` says what they have in common.
"""

from __future__ import annotations

from typing import Any

from poise.simulation.parts import names as sensor_names
from poise.simulation.worlds.arm import Arm
from poise.simulation.worlds.attitude import AttitudeBody
from poise.simulation.worlds.balance import Balance
from poise.simulation.worlds.handle import Handle
from poise.simulation.worlds.physics import WorldError
from poise.simulation.worlds.world import Driver, Truth, World, run, stream

WORLDS: dict[str, type[World]] = {world.name: world for world in (Balance, AttitudeBody, Arm, Handle)}

__all__ = [
    "WORLDS",
    "Arm",
    "AttitudeBody",
    "Balance",
    "Handle",
    "Driver",
    "Truth",
    "World",
    "WorldError",
    "make",
    "run",
    "sensor_names",
    "stream",
]


def make(name: str, **options: Any) -> World:
    """The world called *name*, with its seed, sensor, rate and options. Raises :class:`WorldError` where there is none."""
    if name not in WORLDS:
        raise WorldError(f"no world {name!r}; there are {', '.join(WORLDS)}")
    return WORLDS[name](**options)
