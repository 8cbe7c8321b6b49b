"""Running a stranger's estimator: a function over all samples, a class, a factory, an object or a step, always from new."""

from __future__ import annotations

import inspect
import sys
import traceback
import warnings
from collections.abc import Callable, Mapping
from copy import deepcopy
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from poise.conformance.answers import Answer, a_kind, answer, held, row
from poise.conformance.signatures import SHAPES, Meaning, kind, meaning, parameters, wanted
from poise.data.recording import Recording
from poise.errors import MethodError, PoiseError

_STEPS = ("update", "step", "process", "filter", "__call__")
_BATCH = ("time", "gyr", "acc", "mag")
_SAMPLE = ("gyr", "acc", "mag", "dt")


class Run(NamedTuple):
    """An estimator by its name, and how it is run."""

    name: str
    shape: str
    """in words: a function of all samples, a step, …"""
    call: Callable[[Recording], Any]

    def __call__(self, fed: Recording) -> Answer:
        """Its answer to the samples as they are in *fed*. Its own error is a :class:`MethodError` with its type and line."""
        return answer(self.name, guarded(self.name, lambda: self.call(fed)), len(fed))


def runner(estimator: Any, name: str, probe: Recording) -> Run:
    """How to run *estimator*, tried on the samples of *probe*. Raises :class:`MethodError` where nothing fits."""
    if hasattr(type(estimator), "start") and hasattr(type(estimator), "_fields"):
        return Run(name, "a method of poise", lambda fed: _estimated(estimator, fed))
    if kind(estimator) == "class":
        return _of_maker(estimator, name, "a class")
    if kind(estimator) == "object":
        return _of_object(estimator, name)
    if not callable(estimator):
        raise MethodError(f"{name} is {a_kind(estimator)}, which cannot be called; {SHAPES}")
    found = parameters(estimator)
    if found is not None and _makes(found):
        return _of_maker(estimator, name, "a function that makes one")
    return _of_function(estimator, name, probe)


def guarded(name: str, work: Callable[[], Any]) -> Any:
    """What *work* gives; its errors as a :class:`MethodError` that keeps their type, text, file and line."""
    try:
        with np.errstate(all="ignore"), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return work()
    except PoiseError:
        raise
    except (Exception, SystemExit) as problem:
        raise MethodError(f"{name} raised {type(problem).__name__}: {problem}{_where(problem)}") from problem


def _where(problem: BaseException) -> str:
    """The deepest line that is the user's own: not of this package, nor of an installed one."""
    frames = traceback.extract_tb(problem.__traceback__)
    here = str(Path(__file__).parents[1])
    foreign = [frame for frame in frames if not frame.filename.startswith(here)]
    own = [
        f for f in foreign if "site-packages" not in f.filename and not f.filename.startswith(("<", sys.base_prefix))
    ]
    if not foreign:
        return ""
    frame = (own or foreign)[-1]
    line = f": {frame.line}" if frame.line else ""
    return f" ({Path(frame.filename).name}, line {frame.lineno}, in {frame.name}{line})"


def _makes(found: list[inspect.Parameter]) -> bool:
    """Whether a function needs no samples: it makes something that does."""
    meanings = [meaning(p.name) for p in found]
    needs = [m for p, m in zip(found, meanings, strict=True) if p.default is inspect.Parameter.empty]
    variadic = any(p.kind is inspect.Parameter.VAR_POSITIONAL for p in found)
    sensors = any(m and m.partition(".")[0] in ("gyr", "acc", "mag") for m in meanings)
    return not variadic and not sensors and all(m in ("dt", "rate") for m in needs)


def _estimated(method: Any, fed: Recording) -> Any:
    from poise.estimators.batch import estimate

    return estimate(method, fed).quat


def _of_maker(make: Any, name: str, what: str) -> Run:
    asked = wanted(name, make, ())
    meanings = set(asked.values() if isinstance(asked, dict) else asked)
    if "acc" in meanings and meanings & {"gyr", "mag"}:  # the constructor computes: ahrs
        return Run(name, f"{what} whose constructor takes all samples", lambda fed: held(_call(make, asked, fed, None)))

    def call(fed: Recording) -> Any:
        try:
            made = _call(make, asked, fed, None)
        except TypeError:
            if parameters(make) is not None:
                raise
            made = make(1.0 / fed.rate_hz)  # a class of a C extension does not tell that it needs one
        if _step_of(made) is None:
            raise MethodError(f"{name} makes {a_kind(made)}, which cannot be called and has no update(); {SHAPES}")
        return _all_or_steps(made, name, fed) if _step_of(made) == "__call__" else _stepped(made, name, fed)

    return Run(name, f"{what} of an object that takes a sample a call", call)


def _of_object(thing: Any, name: str) -> Run:
    if _step_of(thing) is None:
        raise MethodError(f"{name} is {a_kind(thing)} that cannot be called and has no update(); {SHAPES}")
    try:
        deepcopy(thing)
    except Exception as problem:
        raise MethodError(
            f"{name} cannot be copied ({type(problem).__name__}), so it cannot start anew for every test: give its class, or a "
            "function without arguments that makes one"
        ) from None
    if _step_of(thing) == "__call__" and not inspect.isroutine(thing):
        return Run(name, "an object that is called", lambda fed: _all_or_steps(deepcopy(thing), name, fed))
    return Run(name, "an object that takes a sample a call", lambda fed: _stepped(deepcopy(thing), name, fed))


def _of_function(function: Callable[..., Any], name: str, probe: Recording) -> Run:
    asked = wanted(name, function, _BATCH)
    meanings = set(asked.values() if isinstance(asked, dict) else asked)
    if not any(m.partition(".")[0] in ("gyr", "acc", "mag") for m in meanings):
        raise MethodError(f"{name} takes no sensor; {SHAPES}")
    if "state" in meanings or any("." in m for m in meanings):
        return Run(name, "a step", lambda fed: _steps(function, asked, fed))
    if "time" not in meanings and not _takes_all(function, asked, name, probe):
        return Run(name, "a step", lambda fed: _steps(function, asked, fed))
    return Run(name, "a function of all samples", lambda fed: _call(function, asked, fed, None))


def _takes_all(function: Callable[..., Any], asked: Any, name: str, probe: Recording) -> bool:
    """Whether a function without time stamps takes all samples at once, which only a trial can tell."""
    try:
        answer(name, guarded(name, lambda: _call(function, asked, probe, None)), len(probe))
    except MethodError as of_all:
        try:
            answer(name, guarded(name, lambda: _steps(function, asked, probe)), len(probe))
        except MethodError:
            raise of_all from None
        return False
    return True


def _all_or_steps(thing: Any, name: str, fed: Recording) -> Any:
    asked = wanted(name, thing, _BATCH)
    if "time" in (asked.values() if isinstance(asked, dict) else asked) or _takes_all(thing, asked, name, fed[:20]):
        return _call(thing, asked, fed, None)
    return _steps(thing, asked, fed)


def _stepped(thing: Any, name: str, fed: Recording) -> Any:
    method = getattr(thing, str(_step_of(thing)))
    asked = wanted(name, method, _SAMPLE[:3])
    inputs = _inputs(fed)
    rows = [_kept(row(thing, _with(method, asked, inputs, i))) for i in range(len(fed))]
    if rows and rows[0] is None:
        raise MethodError(f"{name}: {method.__name__}() returns nothing, and the object holds no quat, quaternion or q")
    return _stacked(rows)


def _steps(function: Callable[..., Any], asked: Any, fed: Recording) -> Any:
    inputs, latest = _inputs(fed), np.array([1.0, 0.0, 0.0, 0.0])
    rows = []
    for i in range(len(fed)):
        latest = _kept(row(None, _with(function, asked, inputs | {"state": latest}, i)))
        rows.append(latest)
    return _stacked(rows)


def _step_of(thing: Any) -> str | None:
    return next((name for name in _STEPS if callable(getattr(thing, name, None))), None)


def _stacked(rows: list[Any]) -> Any:
    if rows and hasattr(rows[0], "as_quat"):
        return type(rows[0]).concatenate(rows)
    return rows


def _kept(value: Any) -> Any:
    """A copy: many write every answer into the same array."""
    return value if value is None or hasattr(value, "as_quat") else np.array(value, copy=True)


def _inputs(fed: Recording) -> dict[Meaning, Any]:
    steps = np.diff(fed.time, prepend=fed.time[0] - np.median(np.diff(fed.time)))
    axes = {f"{s}.{a}": getattr(fed, s)[:, i] for s in ("gyr", "acc", "mag") for i, a in enumerate("xyz")}
    return {"time": fed.time, "gyr": fed.gyr, "acc": fed.acc, "mag": fed.mag, "dt": steps, "rate": fed.rate_hz} | axes


def _with(function: Callable[..., Any], asked: Any, inputs: Mapping[Meaning, Any], i: int) -> Any:
    def value(m: Meaning) -> Any:
        given = inputs[m]
        if m in ("state", "rate"):
            return given
        return float(given[i]) if given.ndim == 1 else given[i]

    if isinstance(asked, dict):
        return function(**{n: value(m) for n, m in asked.items()})
    return function(*map(value, asked))


def _call(function: Callable[..., Any], asked: Any, fed: Recording, state: Any) -> Any:
    """Once, with all samples; each call has copies of its own, which it may write into."""
    values: dict[Meaning, Any] = {s: getattr(fed, s).copy() for s in ("time", "gyr", "acc", "mag")}
    values |= {"dt": 1.0 / fed.rate_hz, "rate": fed.rate_hz, "state": state}
    if isinstance(asked, dict):
        return function(**{n: values[m] for n, m in asked.items() if m != "state"})
    return function(*(values[m] for m in asked))
