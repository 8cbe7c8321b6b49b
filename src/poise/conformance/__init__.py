"""Which frame, direction, order and units an estimator really has, found out by feeding it made truth.

found = poise.conform(my_filter)        # a function of all samples, a class, a step, a method
print(found)                            # every answer with the figures that decide it
found["Earth frame"].answer             # "NED"
print(found.adapter)                    # Python that makes its output an attitude of poise
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.conformance.adapter import adapter
from poise.conformance.calling import runner
from poise.conformance.examining import REST, Examined, examined
from poise.conformance.failing import failed
from poise.conformance.findings import equivalents, findings, heading_known, runner_up, vertical_words
from poise.conformance.result import Conformance, Finding
from poise.conformance.scene import turntable
from poise.data.recording import Recording
from poise.errors import MethodError

__all__ = ["Conformance", "Finding", "conform", "outputs"]

_RATES = (10.0, 2000.0)


def conform(estimator: Any, *, name: str = "", rate: float = 100.0, imported: str = "") -> Conformance:
    """What *estimator* really takes and gives: its order, direction, frames, units and signs, each with figures.

    *estimator* is ``f(time, gyr, acc, mag) -> (n, 4)`` with (n,) s and (n, 3) samples. mag may be left out, dt or rate may
    stand for time, in any order if names tell what parameters are; the answer may be (n, 3, 3) matrices or (n, 3) Euler
    angles too. A class, or a function without arguments, that makes an object with ``update(gyr, acc, mag)``, which
    returns the attitude or holds it as ``quat``; such an object; a step ``f(q, gyr, acc, mag, dt) -> q``; a method of poise.
    *rate* is the samples per second of what it is fed, for an estimator that is made for one. *imported* is the line
    of Python that makes ``estimator``, for the adapter.

    Raises :class:`MethodError` where it cannot be called, gives no rotations, or raises whatever it is fed: the message
    has the type, text and line of its own error, which is the cause.
    """
    name = name or getattr(estimator, "__name__", type(estimator).__name__)
    if not isinstance(rate, (int, float)) or not _RATES[0] <= rate <= _RATES[1]:
        raise MethodError(f"rate: expected {_RATES[0]:g} to {_RATES[1]:g} samples per second, found {rate!r}")
    run = runner(estimator, name, turntable(float(rate), REST).recording)
    found = examined(run, float(rate))
    imported = imported or f"estimator = {name}  # your own"
    return _told(found, name, imported) if found.follows and found.upright else failed(found, name)


def outputs(
    estimator: Any, time: ArrayLike, gyr: ArrayLike, acc: ArrayLike, mag: ArrayLike | None = None
) -> NDArray[np.float64]:
    """What *estimator*, of any shape that :func:`conform` takes, gives for samples as they are: nothing is converted."""
    fed = Recording(time=time, gyr=gyr, acc=acc, mag=mag)  # type: ignore[arg-type]
    return runner(estimator, getattr(estimator, "__name__", type(estimator).__name__), fed)(fed).values


def _short(answer: str) -> str:
    return answer.replace(" (+g up at rest)", "").replace(" (+g down at rest)", "").partition(" (")[0]


def _told(found: Examined, name: str, imported: str) -> Conformance:
    assert found.choice
    answers = findings(found)
    heading = heading_known(found)
    trial, fit = found.choice
    question, second = runner_up(found, answers)
    frame = fit.frame if heading else vertical_words(fit) + ", heading arbitrary"
    if not found.hears["acc"]:
        frame = "a frame of its own (up and heading: cannot tell)"
    by = {f.question: f.answer for f in answers}
    arrow = f"{frame} to body" if fit.reading.inverse else f"body to {frame}"
    summary = (
        f"conforms: {by['output']}, {arrow}; gyr {by['gyroscope']}, acc {_short(by['accelerometer'])}, "
        f"mag {_short(by['magnetometer'])}: {fit.residual:.2f}° from the truth"
        + (f", the next best ({question}) {second:.0f}°" if question else "")
    )
    hints = [f"the same, said otherwise: {words}" for words in equivalents(found)]
    if found.own_rate is not None:
        hints.append(f"it ignores the stamps and has a step of its own: {found.own_rate:g} samples a second were fed")
    if trial.feed.gyr_sign < 0:
        hints.append("its gyroscope has the wrong sign: mend the sign of gyr, or feed −gyr as the adapter does")
    convention = {
        "output": fit.reading.form,
        "order": fit.reading.order or None,
        "degrees": fit.reading.degrees if fit.reading.form == "Euler angles" else None,
        "direction": "Earth to body" if fit.reading.inverse else "body to Earth",
        "frame": fit.frame if heading else None,
        "vertical": vertical_words(fit) if found.hears["acc"] else None,
        "turn_about_up_deg": fit.turn_about_up if heading else None,
        "body": by["body axes"],
        "gyr": trial.feed.gyr if found.hears["gyr"] else None,
        "gyr_sign": trial.feed.gyr_sign,
        "acc_sign": trial.feed.acc_sign if found.hears["acc"] else None,
        "mag_sign": trial.feed.mag_sign if found.hears["mag"] else None,
        "uses": [sensor for sensor, hears in found.hears.items() if hears],
        "rate": found.rate,
    }
    return Conformance(
        name,
        "conforms",
        summary,
        fit.residual,
        second - fit.residual,
        tuple(answers),
        tuple(hints),
        convention,
        adapter(found, name, imported, heading),
    )
