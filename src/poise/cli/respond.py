"""``poise respond``: a configuration of responses, checked and tried."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from poise.cli import show
from poise.errors import PoiseError

if TYPE_CHECKING:
    from poise.responses import Config, Stage
    from poise.responses.trying import Tried


def respond(
    *,
    config: Annotated[Path, Parameter(name=["--config", "-c"])],
    test: Annotated[bool, Parameter(negative="")] = False,
    fire: Annotated[bool, Parameter(negative="")] = False,
    json: Annotated[bool, Parameter(negative="")] = False,
) -> int:
    """Check the responses to a tipping robot, and prove them.

    Without options: reads the file, and asks every responder for what it needs (program, voice, pin, broker, server, room
    for a log); nothing moves and nobody is told. Exit code 0: all of it would work; 1: what would not is said on stderr.

    Parameters
    ----------
    config
        The TOML file with [responders] and [[stages]].
    test
        Speak, publish, post and log a test message by every responder that tells somebody.
    fire
        With --test: also cut the power by every relay for 0.2 s, and run every command. What hangs on them goes off.
    json
        Print as JSON.
    """
    from poise.responses import load_config
    from poise.responses.trying import try_out

    if fire and not test:
        show.problem("--fire goes with --test: it moves relays and runs commands")
        return 2
    try:
        loaded = load_config(config)
    except PoiseError as problem:
        show.problem(problem)
        return 1
    done = try_out(loaded, test, fire)
    if json:
        show.as_json(
            {
                "config": config,
                "stages": [_stage(each) for each in loaded.stages],
                "responders": [vars(each) for each in done],
            }
        )
    else:
        _tell(loaded, done, test)
    for each in done:
        if each.problem is not None:
            show.problem(f"{config}: {each.problem}")
    return 1 if any(each.problem is not None for each in done) else 0


def _stage(stage: Stage) -> dict[str, Any]:
    from poise.responses.alarm import named

    states = [named(state) for state in sorted(stage.states)]
    return {**vars(stage), "states": states, "fire": list(stage.fire)}


def _tell(config: Config, done: list[Tried], test: bool) -> None:
    rows = []
    for each in done:
        became = "FAILED" if each.problem else ("tested" if each.fired else ("not tested: --fire" if test else "ready"))
        rows.append([each.responder, each.kind, became, each.problem or each.found])
    show.table("responders", ["name", "type", "", "found"], rows)
    stages = []
    for stage in map(_stage, config.stages):
        often = f"every {stage['repeat']:g} s" if stage["repeat"] else "once"
        until = "until acknowledged" if stage["latched"] else "until upright"
        wait = f"after {stage['after']:g} s" if stage["after"] else "at once"
        stages.append([", ".join(stage["states"]), ", ".join(stage["fire"]), wait, often, until])
    policy = config.unknown + (f", after {config.unknown_after:g} s" if config.unknown_after else "")
    stages.append(["unknown", f"({policy})", "", "", ""])
    show.table("stages", ["state", "fires", "when", "how often", "holds"], stages)
