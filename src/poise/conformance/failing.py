"""What was seen of an estimator that does not follow the truth, so that it can be mended."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from poise.conformance.conventions import Level
from poise.conformance.examining import Examined, response, vertical_only
from poise.conformance.feeding import FOLLOWS, UPRIGHT, Trial, apart
from poise.conformance.findings import heading_known
from poise.conformance.result import CANNOT_TELL, Conformance, Finding

Floats = NDArray[np.float64]


def failed(found: Examined, name: str, imported: str) -> Conformance:
    """The verdict on an estimator whose attitude is not the truth in any reading."""
    trial = _best(found)
    if trial is None or trial.answer is None:
        return _unusable(found, name)
    level = vertical_only(found)
    answers = [_whole(found, trial), *_vertical(level), *_lean(found)]
    hints: list[str] = []
    if dead := _dead(found, trial):
        answers.append(dead)
    else:
        answers += _gyroscope(found, trial, hints)
    answers += _listens(found)
    again = found.run(trial.feed.of(found.scene.recording))
    if (moved := apart(trial.answer, again)) > 1e-6:
        answers.append(
            Finding("repeatability", "another answer to the same samples", f"asked twice, it differs by up to {moved:.0f}°")
        )
        hints.append("it is random, or remembers the run before: give its class, or a function without arguments that makes it")
    only = level is not None and level[1].residual <= FOLLOWS and not dead
    verdict = "inclination only" if only else "does not conform"
    residual = trial.residual
    if only and level is not None:
        summary = (
            f"inclination only: up comes out within {level[1].residual:.2f}°, the heading does not follow "
            f"({residual:.0f}° from the truth)"
        )
    else:
        lean = "" if found.upright or residual > FOLLOWS else ", in a frame whose axes are not the vertical"
        summary = f"does not conform: {residual:.0f}° from the truth at best, expected at most {FOLLOWS:g}°{lean}"
    return Conformance(name, verdict, summary, residual, float("nan"), tuple(answers), tuple(hints))


def _best(found: Examined) -> Trial | None:
    if found.choice is not None:
        return found.choice.trial
    return next((trial for trial in found.trials if trial.answer is not None), None)


def _unusable(found: Examined, name: str) -> Conformance:
    what = "its answers hold hardly a row that is a rotation (NaN or zeros)"
    summary = f"does not conform: {what}"
    return Conformance(name, "does not conform", summary, float("nan"), float("nan"), (Finding("output", CANNOT_TELL, what),))


def _whole(found: Examined, trial: Trial) -> Finding:
    if not trial.fits:
        return Finding("attitude", CANNOT_TELL, "too few of its rows are rotations")
    fit = trial.fits[0]
    feed = trial.feed
    order = f" {' '.join(fit.reading.order)}" if fit.reading.order else ""
    way = "Earth to body" if fit.reading.inverse else "body to Earth"
    fed = f"gyr {'−' * (feed.gyr_sign < 0)}{feed.gyr}, acc {'−' * (feed.acc_sign < 0)}{feed.acc}"
    number = len(found.trials)
    return Finding(
        "attitude",
        "does not follow" if fit.residual > FOLLOWS else "follows",
        f"{fit.residual:.1f}° RMS at best, of {number} kinds of input and every reading ({fit.reading.form}{order}, {way}, fed {fed})",
        fit.residual,
    )


def _vertical(level: tuple[Trial, Level] | None) -> list[Finding]:
    if level is None:
        return []
    residual = level[1].residual
    words = "follows" if residual <= FOLLOWS else "does not follow"
    axis = int(np.argmax(np.abs(level[1].up)))
    toward = f"{'xyz'[axis]} {'up' if level[1].up[axis] > 0 else 'down'}"
    return [Finding("inclination", words, f"up within {residual:.1f}° RMS, the heading set aside ({toward})", residual)]


def _lean(found: Examined) -> list[Finding]:
    if found.choice is None or found.upright or not found.follows:
        return []
    lean = found.choice.fit.tilted
    return [
        Finding(
            "Earth frame",
            "leans",
            f"its nearest axis is {lean:.1f}° from the vertical, at most {UPRIGHT:g}° expected: a field of another dip than "
            "63.7° assumed, or a sign of acc or mag that does not go with its reference?",
        )
    ]


def _dead(found: Examined, trial: Trial) -> Finding | None:
    assert trial.answer is not None
    values = trial.answer.values
    if np.ptp(values.reshape(len(values), -1), axis=0).max() < 1e-12:
        row = np.array2string(values[0].ravel(), precision=3, separator=", ")
        return Finding("output", "constant", f"every row is {row}, whatever the sensors say")
    return None


def _gyroscope(found: Examined, trial: Trial, hints: list[str]) -> list[Finding]:
    matrix = response(found, trial)
    if matrix is None:
        return []
    answers = []
    for i, axis in enumerate("xyz"):
        row = matrix[i]
        text = f"20° about {axis} that only gyr tells of turn the output by ({', '.join(f'{20 * v:.1f}' for v in row)})° about x, y, z"
        answers.append(Finding(f"gyroscope {axis}", _named(i, row), text))
    diagonal, size = np.diag(matrix), float(np.linalg.norm(matrix))
    straight = float(np.linalg.norm(diagonal)) > 0.95 * size
    if size < 0.05 and found.hears["gyr"]:
        hints.append("the gyroscope hardly turns the output: a unit, or the time step, is too small")
    elif straight and (np.sign(diagonal) != np.sign(np.median(diagonal))).any() and (np.abs(diagonal) > 0.5).all():
        wrong = [axis for axis, gain in zip("xyz", diagonal, strict=True) if gain < 0]
        hints.append(f"the gyroscope's sign is wrong about {', '.join(wrong)}")
    elif straight and (np.abs(np.abs(diagonal) - 1.0) > 0.2).any():
        hints.append(f"the gyroscope turns the output by {np.mean(diagonal):.2f} of what it says: a unit, ½ or the time step")
    elif not straight:
        hints.append("the gyroscope's axes are not those of the other sensors: columns exchanged, or the product q ⊗ ω the wrong way")
    return answers


def _named(i: int, row: Floats) -> str:
    largest = int(np.argmax(np.abs(row)))
    size = float(np.linalg.norm(row))
    if size < 0.05:
        return "hardly heard"
    if abs(row[largest]) < 0.9 * size:
        return "turns about another axis"
    if largest != i:
        return f"turns about {'−' * bool(row[largest] < 0)}{'xyz'[largest]} instead"
    if row[i] < 0:
        return "turns the wrong way"
    return "right" if abs(row[i] - 1.0) < 0.2 else f"{row[i]:.2f} of what it should be"


def _listens(found: Examined) -> list[Finding]:
    names = {"gyr": "gyroscope", "acc": "accelerometer", "mag": "magnetometer", "time": "time stamps"}
    heard = [words for key, words in names.items() if found.hears[key]]
    deaf = [words for key, words in names.items() if not found.hears[key]]
    answer = ", ".join(heard) or "nothing"
    return [Finding("listens to", answer, f"not to: {', '.join(deaf)}" if deaf else "each of them moves the output")]


__all__ = ["failed", "heading_known"]
