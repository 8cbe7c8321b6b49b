"""``poise view``: recordings on the page."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from poise.cli import page, show
from poise.cli.options import Reading
from poise.cli.targets import distinct
from poise.cli.words import UsageError, method_choices, usage
from poise.errors import PoiseError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from poise.data.attitude import Attitude
    from poise.data.recording import Recording
    from poise.live.film import Film
    from poise.live.methods import Choice
    from poise.monitor import TipOver


def view(
    files: Annotated[list[Path], Parameter(name="FILE", negative="")],
    /,
    *,
    method: Annotated[tuple[str, ...], Parameter(name=["--method", "-m"], negative="")] = ("self-calibrating",),
    set_: Annotated[tuple[str, ...], Parameter(name="--set", negative="")] = (),
    offline: Annotated[bool, Parameter(negative="")] = False,
    tipover: Path | None = None,
    port: int = 0,
    open: bool | None = None,
    reading: Reading | None = None,
) -> int:
    """Play recordings on the page of `poise live`: methods and reference side by side, with a time slider.

    A FILE may also be an attitude that poise wrote. The page is for this machine only; Ctrl-C ends it.

    Examples: `poise view walk.csv`; `poise view trial.mat -m self-calibrating -m two-stage`; `poise view walk.attitude.parquet`

    Parameters
    ----------
    files
        Recordings, or attitudes written by poise.
    method
        A method to show; repeat for several side by side.
    set_
        A parameter, `NAME=VALUE`, of every method above that has it.
    offline
        Show self-calibrating as it is known afterwards (`poise estimate --offline`) beside what it says live.
    tipover
        A TOML file with the tip-over monitor's parameters, as for `poise tipover`: its states are shown, too.
    port
        The port; a free one if not given.
    open
        Open the page in a browser; done unless told where there is a terminal and a screen.
    """
    from poise.live.listening import Listening, Options
    from poise.live.serving import check_installed, run

    reading = reading or Reading()
    try:
        check_installed()
        choices = method_choices(method, set_)
        if offline and "self-calibrating" not in method:
            usage("--offline is of the method self-calibrating; add -m self-calibrating")
        if not 0 <= port <= 65535:
            usage(f"--port {port}: expected 0 to 65535")
        reading.as_arguments()
        distinct(files)
        monitor = _monitor(tipover)
        with Listening(Options(port=port)):
            pass  # a port that is taken is told before the work, not after it

        def work(file: Path, tell: Callable[[str, float], None]) -> Film:
            return _film(file, choices, offline, monitor, reading, tell)

        films, refused = show.each(files, work)
        if not films:
            return 1
        run(_served(films, port, open))
    except UsageError as error:
        show.problem(error)
        return 2
    except (PoiseError, OSError) as error:
        show.problem(error)
        return 1
    return 1 if refused else 0


def _film(
    file: Path,
    choices: Sequence[Choice],
    offline: bool,
    monitor: TipOver | None,
    reading: Reading,
    tell: Callable[[str, float], None],
) -> Film:
    from poise.data.attitude import Attitude
    from poise.estimators import METHODS
    from poise.estimators.batch import estimate
    from poise.estimators.self_calibrating.smoother import smooth
    from poise.live.film import Strip, of_attitude, of_recording

    tell("reading", 0.0)
    found = reading.read_either(file)
    if isinstance(found, Attitude):
        return of_attitude(file.name, found, _judged(found, None, monitor))
    strips = []
    for k, choice in enumerate(choices):
        tell(f"estimating, {choice.name} (a first run compiles the method)", 0.1 + 0.8 * k / len(choices))
        # a method of the user's words, not `prepared`: `estimate` does that
        method = METHODS[choice.name](**json.loads(choice.settings))
        attitude = estimate(method, found)
        strips.append(Strip(choice.name, attitude, choice.settings, _judged(attitude, found, monitor)))
        if offline and choice.name == "self-calibrating":
            attitude = smooth(found, method)
            strips.append(Strip(f"{choice.name}, offline", attitude, choice.settings))
    return of_recording(found, strips)


def _monitor(settings: Path | None) -> TipOver | None:
    from poise.monitor import read_settings

    return None if settings is None else read_settings(settings)


def _judged(attitude: Attitude, recording: Recording | None, monitor: TipOver | None) -> NDArray[np.uint8] | None:
    from poise.monitor import judge

    return None if monitor is None else judge(attitude, recording, monitor).state


async def _served(films: list[Film], port: int, opened: bool | None) -> None:
    import asyncio

    from poise.live.hub import Hub
    from poise.live.listening import Options
    from poise.live.server import Server

    server = Server(Hub(()), options=Options(port=port), films=films)
    ready = asyncio.Event()

    async def tell() -> None:
        await ready.wait()
        where = page.address(server.options) + "?view"
        print(f"poise view on {where}  (Ctrl-C ends it)", flush=True)
        await asyncio.to_thread(page.show_in_browser, where, opened)

    telling = asyncio.create_task(tell())
    try:
        await server.run(ready)
    finally:
        telling.cancel()
