"""The command ``poise``: one light module a subcommand; what is heavy is imported when it is called."""

from __future__ import annotations

import errno
import io
import os
import sys
from contextlib import suppress
from pathlib import Path

from cyclopts import App, CycloptsError, Parameter, UnusedCliTokensError

from poise.cli.balance import balance
from poise.cli.compare import compare
from poise.cli.conform import conform
from poise.cli.demo import demo
from poise.cli.doctor import doctor
from poise.cli.estimate import estimate
from poise.cli.evaluate import evaluate
from poise.cli.live import live
from poise.cli.methods import methods
from poise.cli.plot import plot
from poise.cli.recover import recover
from poise.cli.respond import respond
from poise.cli.simulate import simulate
from poise.cli.sniff import sniff
from poise.cli.tipover import tipover
from poise.cli.view import view

app = App(
    name="poise",
    help="""Attitude from inertial samples: gyroscope, accelerometer and magnetometer in, orientation out,
with its uncertainty and its reasons.

Start with your own file: `poise doctor walk.csv` says what is wrong with it, `poise estimate walk.csv --plot walk.png`
writes the attitude and a picture. No file at hand?
`poise demo` makes three and compares every method on them. Every command explains itself with `--help`.""",
    help_format="markdown",
    default_parameter=Parameter(json_list=False, json_dict=False),  # "[1].csv" is a name
    version=lambda: f"poise {_version()}",
)
app.command(estimate)
app.command(evaluate)
app.command(compare)
app.command(conform)
app.command(plot)
app.command(doctor)
app.command(tipover)
app.command(respond)
app.command(sniff)
app.command(live)
app.command(view)
app.command(recover)
app.command(methods)
app.command(demo)
app.command(simulate)
app.command(balance)


_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EBADF)


def main() -> None:
    """Run the command line; exit code 0 fine, 1 some input bad, 2 usage."""
    nowhere = Path(os.devnull)
    sys.stdout = sys.stdout or nowhere.open("w", encoding="utf-8")  # closed by `>&-`: that is what was asked for
    sys.stderr = sys.stderr or nowhere.open("w", encoding="utf-8")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # names and units hold what a terminal of ASCII does not
            stream.reconfigure(errors="backslashreplace")
    sys.exit(run(sys.argv[1:]))


def run(arguments: list[str]) -> int:
    """The exit code of ``poise ARGUMENTS``."""
    try:
        code = app(arguments, exit_on_error=False, print_error=False, result_action="return_value")
        sys.stdout.flush()
        return code if isinstance(code, int) else 0
    except CycloptsError as error:
        command = " ".join(["poise", *(error.command_chain or ())])
        first = " ".join(str(error).split())
        if isinstance(error, UnusedCliTokensError) and error.unused_tokens:
            extra = error.unused_tokens[0]
            first = f"{extra!r} is one too many; what has no name stands together, before or behind all options."
        print(f"poise: {first} See `{command} --help`.", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # `poise … | head`: the reader has had enough
        _leave_stdout()
        return 0
    except OSError as error:
        if error.errno not in _FULL or error.filename is not None:
            raise  # of a file: a fault of poise's, which has a message for each that a user can cause
        _leave_stdout()
        print(f"poise: stdout cannot be written: {error.strerror}; what was to be printed is lost", file=sys.stderr)
        return 1


def _leave_stdout() -> None:
    """What is still to be written at the end goes nowhere, so that it fails no more."""
    with suppress(OSError, ValueError):  # a stdout without a descriptor is a test's
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _version() -> str:
    from poise.version import __version__

    return __version__
