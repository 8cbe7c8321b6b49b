"""Worlds: bodies moved by physics (MuJoCo, extra ``sim``) that carry sensors with the errors of real parts.

``world = worlds.make("balance", seed=1)``, then ``world.step(command)`` for every sample; ``worlds.stream(world)`` for a
live device. :class:`World` says what they have in common.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from poise.estimators.parameters import Parameter, parameters
from poise.simulation.parts import names as sensor_names
from poise.simulation.worlds.arm import Arm
from poise.simulation.worlds.attitude import AttitudeBody
from poise.simulation.worlds.balance import Balance
from poise.simulation.worlds.handle import Handle
from poise.simulation.worlds.physics import MissingExtra, WorldError
from poise.simulation.worlds.world import Driver, Truth, World, run, stream

WORLDS: dict[str, type[World]] = {world.name: world for world in (Balance, AttitudeBody, Arm, Handle)}

__all__ = [
    "WORLDS",
    "About",
    "Arm",
    "AttitudeBody",
    "Balance",
    "Driver",
    "Handle",
    "MissingExtra",
    "Truth",
    "World",
    "WorldError",
    "about",
    "make",
    "run",
    "sensor_names",
    "stream",
]


class About(NamedTuple):
    """A world as people are shown it."""

    name: str
    what: str
    sensors: tuple[str, ...]
    commands: tuple[str, ...]
    driver: str
    """what drives it where nobody else does"""
    options: tuple[Parameter, ...]


def about(name: str) -> About:
    """What there is to know about the world called *name*, without making it."""
    world = _known(name)
    options: type = world.Options
    said = " ".join((world.__doc__ or "").partition("\n\n")[0].split())
    driver = " ".join((world.driver.__doc__ or "").split())
    return About(name, said, world.sensors, world.commands, driver, parameters(options))


def make(name: str, **options: Any) -> World:
    """The world called *name*, with its seed, sensor, rate and options. Raises :class:`WorldError` where there is none."""
    return _known(name)(**options)


def _known(name: str) -> type[World]:
    if name not in WORLDS:
        raise WorldError(f"no world {name!r}; there are {', '.join(WORLDS)}")
    return WORLDS[name]
