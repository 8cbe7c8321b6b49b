"""``poise simulate``: a recording with its exact reference from a world with real physics."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from poise.cli import show
from poise.cli.words import UsageError, parsed, usage
from poise.errors import PoiseError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from poise.simulation.worlds import About, World

_WAYS = (".parquet", ".csv", ".npz")
_PICTURES = (".png", ".gif")
_A_SECOND, _LONGEST, _SIZE = 8.0, 8.0, (320, 240)  # pictures, s, pixels of a picture that moves


def simulate(
    world: str | None = None,
    /,
    *,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    duration: float = 60.0,
    seed: int = 0,
    sensor: str = "MPU-6050+QMC5883L",
    rate: float = 200.0,
    at: str | None = None,
    set_: Annotated[tuple[str, ...], Parameter(name="--set", negative="")] = (),
    picture: Path | None = None,
    list_: Annotated[bool, Parameter(name="--list", negative="")] = False,
    json: Annotated[bool, Parameter(negative="")] = False,
) -> int:
    """Make a recording in a world with real physics, by a sensor with the errors of a real part, with its exact reference.

    Worlds: a robot that balances on two wheels (`balance`), a body on reaction wheels (`attitude`), an arm with a band
    (`arm`), a handle in a hand (`handle`). Each is driven open loop or by the truth, never by an estimate. Then:
    `poise evaluate robot.parquet --method two-stage`. Needs MuJoCo: `pip install "poise[sim]"`.

    Parameters
    ----------
    world
        One of those that --list shows.
    output
        Where the recording goes: .parquet, .csv or .npz; by default WORLD.parquet.
    duration
        Seconds.
    seed
        Draws the sensor's errors, its noise and what happens; the same recording for the same seed.
    sensor
        A part, and a magnetometer behind a plus: `ICM-42688-P+MMC5983MA`; --list shows them.
    rate
        Samples per second.
    at
        Which sensor of the world, where it has several (`arm`: forearm, upper_arm).
    set_
        An option of the world: `--set bumps=0.005`; repeat for more. --list shows them.
    picture
        A picture of its end (.png), or of its last seconds in motion (.gif).
    list_
        Show the worlds with their options, and the sensors.
    json
        Print as JSON.
    """
    try:
        if list_:
            return _list(json)
        if world is None:
            usage("which world? `poise simulate --list` shows them")
        made = _made(world, duration, {"seed": seed, "sensor": sensor, "rate": rate}, set_)
        target = output or Path(f"{world}.parquet")
        _check(made, target, picture, at)
    except UsageError as error:
        show.problem(error)
        return 2
    except PoiseError as error:
        show.problem(error)
        return 1
    try:
        return _write(made, duration, target, picture, at or made.sensors[0], json)
    except PoiseError as error:
        show.problem(error)
        return 1


def _made(name: str, duration: float, facts: dict[str, Any], settings: tuple[str, ...]) -> World:
    """The world as asked for; :class:`UsageError` where it cannot be."""
    from poise.formats.names import counted
    from poise.simulation import worlds

    if not 0.0 < duration <= 1e6:
        usage(f"--duration {duration}: expected seconds, above 0, at most 1e6")
    if facts["rate"] > 0.0 and round(duration * facts["rate"]) < 2:
        usage(
            f"--duration {duration:g} at --rate {facts['rate']:g} makes {counted(round(duration * facts['rate']), 'row')}, "
            f"expected 2 at least; give {2.0 / facts['rate']:g} s or more"
        )
    if facts["seed"] < 0:
        usage(f"--seed {facts['seed']}: expected 0 or more")
    try:
        kinds = {option.name: option.kind for option in worlds.about(name).options}
        for text in settings:
            option, _, value = text.partition("=")
            option = option.strip().replace("-", "_")
            if option not in kinds or not value:
                usage(f"--set {text!r}: expected NAME=VALUE with a NAME of {name}: {', '.join(kinds)}")
            facts[option] = parsed(value.strip(), kinds[option])
        return worlds.make(name, **facts)
    except worlds.MissingExtra:
        raise
    except PoiseError as error:
        usage(str(error))


def _check(world: World, target: Path, picture: Path | None, at: str | None) -> None:
    """Refuse what could not be written before any work is done for it."""
    from poise.cli.targets import check_room

    if target.suffix.lower() not in _WAYS:
        usage(f"--output {target}: expected a file ending in {', '.join(_WAYS)}")
    if picture is not None and picture.suffix.lower() not in _PICTURES:
        usage(f"--picture {picture}: expected a file ending in {' or '.join(_PICTURES)}")
    if at is not None and at not in world.sensors:
        usage(f"--at {at}: {world.name} has {', '.join(world.sensors)}")
    for place in (target, picture):
        if place is not None:
            check_room(place)
    if picture is not None:
        world.render(*_SIZE)  # a machine that cannot is told now


def _write(world: World, duration: float, target: Path, picture: Path | None, at: str, json: bool) -> int:
    from poise.formats import write

    frames = _run(world, duration, target, picture)
    recording = world.recording(at)
    write(recording, target)
    if picture is not None:
        import numpy as np

        from poise.plots import save_picture

        save_picture(np.array(frames or [world.render()]), picture, _A_SECOND)
    if json:
        show.as_json(
            {
                "world": world.name, "sensor": at, "file": target, "seed": world.seed, "rows": len(recording),
                "duration": recording.duration, "rate": world.rate, "impact": world.impact, "picture": picture,
            }
        )  # fmt: skip
        return 0
    print(
        f"{target}: {len(recording)} rows, {recording.duration:.1f} s, from the {at} of {world.name} with its reference"
    )
    show.note(f"driver: {' '.join((type(world).driver.__doc__ or '').split())}")
    if world.impact == world.impact:
        show.note(f"the body touched the ground at {world.impact:.3f} s")
    if picture is not None:
        show.note(f"picture: {picture}")
    return 0


def _run(world: World, duration: float, target: Path, picture: Path | None) -> list[NDArray[np.uint8]]:
    """Let the time pass; the frames of a picture that moves."""
    drive, count = world.driver(), round(duration * world.rate)
    moves = picture is not None and picture.suffix.lower() == ".gif"
    every = max(round(world.rate / _A_SECOND), 1)
    first = count - round(_LONGEST * world.rate) if moves else count
    frames = []
    with show.waiting([target]) as tell:
        for i in range(count):
            world.step(drive(world))
            if i % 200 == 0:
                tell(target, "simulating", i / count)
            if i >= first and i % every == 0:
                frames.append(world.render(*_SIZE))
    return frames


def _list(json: bool) -> int:
    from poise.simulation import parts, worlds

    known = [worlds.about(name) for name in worlds.WORLDS]
    sensors = {name: part.source for name, part in parts.INERTIAL.items()}
    sensors |= {f"+{name}": part.source for name, part in parts.MAGNETIC.items()}
    if json:
        show.as_json(
            {"worlds": [world._asdict() | {"options": _options(world)} for world in known], "sensors": sensors}
        )
        return 0
    for world in known:
        print(f"{world.name}: {world.what}")
        print(f"  sensors: {', '.join(world.sensors)}   commands: {'; '.join(world.commands)}")
        print(f"  driver: {world.driver}")
        rows = [[o["name"], f"{o['default']:.6g}", o["unit"], o["meaning"]] for o in _options(world)]
        show.table("", ["--set", "default", "unit", "meaning"], rows)
        print()
    rows = [[name, source] for name, source in sensors.items()]
    show.table("sensors, with the data sheets that their figures are from", ["--sensor", "source"], rows)
    return 0


def _options(world: About) -> list[dict[str, Any]]:
    return [{"name": o.name, "default": o.default, "unit": o.unit, "meaning": o.meaning} for o in world.options]
