"""``poise balance``: a robot that balances by an estimate, in physics, pushed and watched by the tip-over monitor."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from poise.cli import show
from poise.cli.words import UsageError, usage
from poise.errors import PoiseError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from poise.loops.balancing import BalanceLoop

_PICTURES, _SIZE = 5, (420, 420)
_MOST = 1e5  # of any number that is asked for
_REFRESH = 0.1  # s of the world


def balance(
    *,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    seed: int = 0,
    push: float = 3.0,
    every: float = 10.0,
    duration: float = 60.0,
    method: str = "two-stage",
    sensor: str = "MPU-6050",
    speed: float = 0.0,
    say: Path | None = None,
) -> int:
    """Watch a two-wheeled robot balance by what an estimator makes of an inexpensive sensor, never by the truth.

    It drives to and fro at 0.3 m/s and is pushed. Pushed too hard it falls: the tip-over monitor must see that before the
    ground does, cuts the motors through a relay (a mock pin, unless GPIOZERO_PIN_FACTORY names a real one) and says so.
    Try `poise balance --push 32 --duration 16 -o fall.png`. Needs `pip install "poise[sim,respond]"`.

    Parameters
    ----------
    output
        A picture of the run: .png, .svg or .pdf, with photographs.
    seed
        Draws the sensor's errors and noise.
    push
        N, for 0.1 s at the centre of mass, forward and back in turn; 0 for none.
    every
        Seconds from push to push; the first comes then.
    duration
        Seconds; it ends earlier where the robot has fallen.
    method
        The estimator, as `poise methods` shows them, or `truth` to compare with.
    sensor
        A part, as `poise simulate --list` shows them.
    speed
        How many times as fast as time it runs; 0 for as fast as it can.
    say
        A .wav file that the alarm is spoken into (needs espeak-ng).
    """
    try:
        _checked(output, say, seed, push, every, duration, method, sensor, speed)
        os.environ.setdefault("GPIOZERO_PIN_FACTORY", "mock")
        return _run(output, seed, push, every, duration, method, sensor, speed, say)
    except UsageError as error:
        show.problem(error)
        return 2
    except PoiseError as error:
        show.problem(error)
        return 1


def _checked(
    output: Path | None, say: Path | None, seed: int, push: float, every: float, duration: float, method: str,
    sensor: str, speed: float,
) -> None:  # fmt: skip
    from poise.cli.targets import check_room
    from poise.loops.eyes import check_method
    from poise.plots import FORMATS
    from poise.simulation.parts import part

    try:
        check_method(method)
        part(sensor)
    except PoiseError as error:
        usage(str(error))
    if seed < 0:
        usage(f"--seed {seed}: expected 0 or more")

    if output is not None:
        if output.suffix.lower().removeprefix(".") not in FORMATS:
            usage(f"--output: expected .png, .svg or .pdf, found {str(output)!r}")
        check_room(output)
    if say is not None:
        if say.suffix.lower() != ".wav":
            usage(f"--say {say}: the speech is written as WAVE; expected a file ending in .wav")
        check_room(say)
    for name, value, least in (
        ("push", push, 0.0),
        ("every", every, 1.0),
        ("duration", duration, 2.0),
        ("speed", speed, 0.0),
    ):
        if not least <= value < _MOST:
            usage(f"--{name}: expected {least:g} or more, below {_MOST:g}, found {value:g}")


def _run(
    output: Path | None, seed: int, push: float, every: float, duration: float, method: str, sensor: str, speed: float,
    say: Path | None,
) -> int:  # fmt: skip
    from poise.loops.balancing import BalanceLoop, to_and_fro, told

    with BalanceLoop(method, seed, sensor, wav=say) as loop, _View(loop) as view:
        moments: list[tuple[float, NDArray[np.uint8]]] = []
        began, sign = time.monotonic(), 1.0
        photographs = _Photographs(loop, duration) if output is not None else None
        while loop.world.time < duration - 1e-9 and not loop.world.time > loop.world.impact + 0.5:
            now = loop.world.time
            if push > 0.0 and now >= every * (len(loop.pushes) + 1) - 1e-9:
                loop.push((0.0, sign * push, 0.0))
                sign = -sign
            loop.drive(*to_and_fro(loop))
            loop.step()
            if photographs is not None:
                photographs.look()
            view.look()
            if speed > 0.0 and (ahead := (loop.world.time / speed) - (time.monotonic() - began)) > 0.0:
                time.sleep(ahead)
        if photographs is not None:
            photographs.look(last=True)
            moments = photographs.moments()
    run = loop.result()
    print(told(run))
    if output is not None:
        from poise.plots import balance_figure, save_figure

        save_figure(balance_figure(run, moments, f"Balancing by {method} on a {sensor}, seed {seed}"), output)
    return 0


class _Photographs:
    """A few of the run: spread over it, and of the push, the cut and the impact where it falls."""

    def __init__(self, loop: BalanceLoop, duration: float) -> None:
        self._loop, self._next, self._step = loop, 1.0, (duration - 1.0) / (_PICTURES - 1)
        self._spread: list[tuple[float, Any]] = []
        self._fall: list[tuple[float, Any]] = []
        self._told: set[str] = set()

    def look(self, *, last: bool = False) -> None:
        now = self._loop.world.time
        if now >= self._next - 1e-9 or last:
            self._take(self._spread)
            self._next += self._step
        if self._loop.cut is not None and "cut" not in self._told:
            self._told.add("cut")
            self._take(self._fall)
        elif self._loop.cut is not None and now > self._loop.cut.time + 0.1 and "falls" not in self._told:
            self._told.add("falls")
            self._take(self._fall)
        if now > self._loop.world.impact and "impact" not in self._told:
            self._told.add("impact")
            self._take(self._fall)

    def moments(self) -> list[tuple[float, Any]]:
        if not self._fall:
            return self._spread[:_PICTURES]
        before = [each for each in self._spread if each[0] < self._fall[0][0]]
        return [*before[-(_PICTURES - 1 - len(self._fall)) :], *self._fall, *self._spread[-1:]]

    def _take(self, into: list[tuple[float, Any]]) -> None:
        into.append((self._loop.world.time, self._loop.world.render(*_SIZE)))


class _View:
    """The robot as text while it runs, on a terminal only."""

    def __init__(self, loop: BalanceLoop) -> None:
        self._loop, self._next, self._live = loop, 0.0, None
        if sys.stdout.isatty():
            from rich.live import Live

            self._live = Live(refresh_per_second=12, transient=True)

    def __enter__(self) -> _View:
        if self._live is not None:
            self._live.start()
        return self

    def __exit__(self, *_: object) -> None:
        if self._live is not None:
            self._live.stop()

    def look(self) -> None:
        if self._live is None or self._loop.world.time < self._next:
            return
        self._next = self._loop.world.time + _REFRESH
        self._live.update(panel(self._loop))


def panel(loop: BalanceLoop) -> Any:
    """How the robot stands now, for a terminal."""
    from math import degrees, nan

    from rich.table import Table
    from rich.text import Text

    row = loop.rows[-1] if loop.rows else [0.0, *[nan] * 9]
    table = Table.grid(padding=(0, 2))
    table.add_row("time", f"{row[0]:7.2f} s", "state", Text(loop.monitor.state.name.lower(), style="bold"))
    table.add_row("lean", f"{degrees(row[2]):+7.2f}°", "truth", f"{degrees(row[1]):+7.2f}°")
    table.add_row("speed", f"{row[3]:+7.2f} m/s", "wanted", f"{row[4]:+7.2f} m/s")
    table.add_row("torque", f"{row[5] + row[6]:+7.2f} N m", "motors", "cut" if loop.cut else "powered")
    table.add_row("", _bar(degrees(row[1])))
    return table


def _bar(lean: float, half: int = 30) -> str:
    """The lean, ±90°, as a mark on a line."""
    at = half if lean != lean else min(max(round(half + lean / 90.0 * half), 0), 2 * half)
    return "".join("●" if i == at else "│" if i == half else "·" for i in range(2 * half + 1))
