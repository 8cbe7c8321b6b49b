"""``poise conform``: which frame, direction, order and units an estimator really has."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Sequence
from contextlib import redirect_stdout
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from cyclopts import Parameter

from poise.cli import show
from poise.cli.words import UsageError, usage
from poise.errors import FormatError, PoiseError

if TYPE_CHECKING:
    from poise.conformance import Conformance


class Target(NamedTuple):
    """An estimator, and the line of Python that makes it."""

    name: str
    estimator: Any
    imported: str


def conform(
    targets: Annotated[list[str], Parameter(name="ESTIMATOR", negative="")],
    /,
    *,
    rate: float = 100.0,
    json: Annotated[bool, Parameter(negative="")] = False,
) -> int:
    """Find out which frame, direction, order, units and signs an estimator really has.

    It is fed made truth, in every unit and sign that it may expect, and its output is read in every way; what follows the
    truth is the answer, with the error in degrees and that of the next best answer. Prints Python, too, that makes its
    output an attitude of poise. One that follows nothing is said not to conform, with what it does for each axis.

    ESTIMATOR is `FILE.py:NAME` or `MODULE:NAME`, a function `f(time, gyr, acc, mag) -> (n, 4)`, or a class whose objects
    have `update(gyr, acc, mag)`; a method of poise; or `vqf`, `vqf-6d`, `imufusion`, `imufusion-ned`, `ahrs-madgwick`, … as
    those packages are (`ahrs` is all of that package).

    Exit code 1 where one does not conform. Examples: `poise conform my_filter.py:run`; `poise conform vqf ahrs --json`

    Parameters
    ----------
    targets
        One or more estimators. The file or module is imported: its code runs.
    rate
        Samples per second that it is fed, for one that is made for a rate of its own.
    json
        Print everything as JSON.
    """
    found: list[Conformance] = []
    problems: list[dict[str, str]] = []
    try:
        if not 10.0 <= rate <= 2000.0:
            usage(f"--rate {rate:g}: expected 10 to 2000 samples per second")
        words = [(word, _kind(word)) for word in targets]
    except UsageError as error:
        show.problem(error)
        return 2
    for word, kind in words:
        try:
            with redirect_stdout(sys.stderr):  # what a stranger's code prints is no part of the result
                done = [_told(target, rate) for target in _targets(word, kind)]
        except PoiseError as error:
            problems.append({"estimator": word, "error": str(error)})
            show.problem(error)
            continue
        found += done
        if not json:
            for each in done:
                tell(each)
    if json:
        show.as_json({"results": [each.to_dict() for each in found], "errors": problems})
    return 1 if problems or any(each.verdict == "does not conform" for each in found) else 0


def tell(found: Conformance) -> None:
    """The findings as a table, the summary above it, the hints and the adapter below."""
    rows = [[f.question, f.answer, f.evidence] for f in found.findings]
    print(f"{found.name} {found.summary}")
    show.table("", ["question", "answer", "error in degrees, RMS"], rows)
    for hint in found.hints:
        print(f"  {hint}")
    if found.adapter:
        print(f"\n{found.adapter}")
    else:
        print()


def _told(target: Target, rate: float) -> Conformance:
    from poise.conformance import conform as examine

    return examine(target.estimator, name=target.name, rate=rate, imported=target.imported)


def _kind(word: str) -> str:
    """One of method, peer, file and module. Raises :class:`UsageError` for what is none of them."""
    from poise.estimators import METHODS
    from poise.peers.raw import RAW

    if word in METHODS:
        return "method"
    if word in RAW or any(name.partition("-")[0] == word for name in RAW):
        return "peer"
    place, colon, name = word.rpartition(":")
    if word.endswith(".py") or place.endswith(".py"):
        return "file"
    if not (colon and place and name):
        usage(
            f"ESTIMATOR {word!r}: expected FILE.py:NAME or MODULE:NAME, a method ({', '.join(METHODS)}) or one of "
            f"{', '.join(RAW)}"
        )
    return "module"


def _targets(word: str, kind: str) -> list[Target]:
    from poise.estimators import METHODS
    from poise.peers.raw import named

    if kind == "method":
        return [Target(word, METHODS[word](), f"estimator = poise.{METHODS[word].__name__}()")]
    if kind == "peer":
        line = "from poise.peers.raw import {} as estimator"
        return [Target(name, raw, line.format(raw.__name__)) for name, raw in named(word).items()]
    place, _, name = word.rpartition(":")
    if kind == "file" and word.endswith(".py"):
        place, name = word, ""
    module = _module_in(Path(place)) if kind == "file" else _module_named(place)
    thing = _attribute(module, place, name)
    first, *rest = name.split(".")
    source = Path(place).stem if kind == "file" else place
    line = f"from {source} import {first}" + ("" if rest else " as estimator" if first != "estimator" else "")
    return [Target(word, thing, line + (f"\n\nestimator = {name}" if rest else ""))]


def _module_in(path: Path) -> Any:
    """What a file of Python defines. Raises :class:`FormatError` where it is not there, its own error where it fails."""
    from poise.conformance.calling import guarded

    if not path.is_file():
        raise FormatError(f"{path}: {'a folder, not a file' if path.is_dir() else 'no such file'}")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        raise FormatError(f"{path}: not a file of Python")
    module = importlib.util.module_from_spec(spec)
    before, known = list(sys.path), sys.modules.get(path.stem)
    sys.path.insert(0, str(path.resolve().parent))  # it may import its neighbours, also when it is called
    sys.modules[path.stem] = module
    try:
        guarded(str(path), partial(spec.loader.exec_module, module))
    except PoiseError:
        sys.path[:] = before
        if known is None:
            del sys.modules[path.stem]
        else:
            sys.modules[path.stem] = known
        raise
    return module


def _module_named(name: str) -> Any:
    from poise.conformance.calling import guarded

    if not all(part.isidentifier() for part in name.split(".")):
        raise FormatError(f"{name}: neither a file ending in .py nor the name of a module")
    if str(Path.cwd()) not in sys.path and "" not in sys.path:
        sys.path.insert(0, str(Path.cwd()))

    def load() -> Any:
        try:
            return importlib.import_module(name)
        except ModuleNotFoundError as problem:
            if problem.name and (name == problem.name or name.startswith(f"{problem.name}.")):
                raise FormatError(f"no module {problem.name!r} here or installed; is it FILE.py:NAME?") from None
            raise

    return guarded(name, load)


def _attribute(module: Any, place: str, name: str) -> Any:
    from poise.peers.raw import RAW

    there = _callables(module)
    offer = f"it has {', '.join(there)}" if there else "name a class or function of it"
    if any(known.partition("-")[0] == place for known in RAW):
        offer += f"; plain {place} is that package as it is"
    if not name:
        raise FormatError(f"{place}: which of it? {place}:NAME; {offer}")
    thing = module
    for part in name.split("."):
        if not hasattr(thing, part):
            raise FormatError(f"{place}: no {name!r} in it; {offer}")
        thing = getattr(thing, part)
    return thing


def _callables(module: Any) -> Sequence[str]:
    family = module.__name__.partition(".")[0]  # a package gathers what its modules define

    def belongs(value: Any) -> bool:
        return callable(value) and str(getattr(value, "__module__", "")).partition(".")[0] == family

    own = [n for n, v in vars(module).items() if belongs(v)]
    return [n for n in own if not n.startswith("_")][:12]
