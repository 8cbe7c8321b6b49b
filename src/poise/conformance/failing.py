"""What was seen of an estimator that does not follow the truth, so that it can be mended."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from poise.conformance.conventions import Level
from poise.conformance.examining import Examined, response, vertical_in_slow_motion, vertical_only
from poise.conformance.feeding import FOLLOWS, UPRIGHT, Trial, apart
from poise.conformance.mending import mended_axes, mended_gyroscope
from poise.conformance.result import CANNOT_TELL, Conformance, Finding

Floats = NDArray[np.float64]

_NOTHING = 30.0  # degrees: the best reading of what is further off means nothing


def failed(found: Examined, name: str) -> Conformance:
    """The verdict on an estimator whose attitude is not the truth in any reading."""
    if found.choice is None or found.choice.trial.answer is None:
        return _unusable(name)
    trial = found.choice.trial
    answers, hints = [_whole(found)], []
    level = vertical_only(found)
    known = level is not None and level[1].residual <= FOLLOWS
    slow = float("inf")
    if level and not known and level[1].residual < _NOTHING and not found.hears["mag"]:
        slow = vertical_in_slow_motion(found, level[0].feed)
    answers += [*_vertical(level, slow), *_lean(found)]
    moved = apart(found.choice.trial.answer, found.run(trial.feed.of(found.scene.recording)))
    dead = _dead(trial)
    if dead:
        answers.append(dead)
    elif moved > 1e-6:
        evidence = f"asked twice, it differs by up to {moved:.0f}°"
        answers.append(Finding("repeatability", "another answer to the same samples", evidence))
        hints.append(
            "it is random, or remembers the run before: give its class, or a function without arguments that makes it"
        )
    else:
        answers += _gyroscope(found, trial, known, hints)
    answers.append(_listens(found))
    residual = found.choice.fit.residual
    if slow <= FOLLOWS and level is not None:
        summary = f"inclination only, in slow motion: up within {slow:.2f}°, in fast motion {level[1].residual:.1f}°"
        return Conformance(name, "inclination only", summary, residual, float("nan"), tuple(answers), tuple(hints))
    if known and level is not None and not found.follows:
        if not found.hears["mag"]:
            summary = (
                f"inclination only: up within {level[1].residual:.2f}°; the heading, without magnetometer, does not"
            )
            return Conformance(name, "inclination only", summary, residual, float("nan"), tuple(answers), tuple(hints))
        summary = (
            f"does not conform: inclination follows ({level[1].residual:.2f}°), its heading does not ({residual:.0f}°)"
        )
        return Conformance(name, "does not conform", summary, residual, float("nan"), tuple(answers), tuple(hints))
    summary = f"does not conform: {residual:.1f}° from the truth at best, expected at most {FOLLOWS:g}°"
    if found.follows:
        summary = f"does not conform: its vertical is {found.choice.fit.tilted:.1f}° from any axis of its Earth frame"
    return Conformance(name, "does not conform", summary, residual, float("nan"), tuple(answers), tuple(hints))


def _unusable(name: str) -> Conformance:
    what = "hardly a row of its answers is a rotation (NaN, zeros, or mirror images)"
    findings = (Finding("output", CANNOT_TELL, what),)
    return Conformance(name, "does not conform", f"does not conform: {what}", float("nan"), float("nan"), findings)


def _whole(found: Examined) -> Finding:
    assert found.choice
    feed, fit = found.choice.trial.feed, found.choice.fit
    at_best = f"{fit.residual:.1f}° RMS at best"
    if fit.residual > _NOTHING:
        return Finding(
            "attitude", "does not follow", f"{at_best}, whatever is fed and however it is read", fit.residual
        )
    order = f" {' '.join(fit.reading.order)}" if fit.reading.order else ""
    way = "Earth to body" if fit.reading.inverse else "body to Earth"
    fed = f"gyr {'−' * (feed.gyr_sign < 0)}{feed.gyr}, acc {'−' * (feed.acc_sign < 0)}{feed.acc}"
    answer = "does not follow" if fit.residual > FOLLOWS else "follows"
    return Finding("attitude", answer, f"{at_best}, as {fit.reading.form}{order}, {way}, fed {fed}", fit.residual)


def _vertical(level: tuple[Trial, Level] | None, slow: float) -> list[Finding]:
    if level is None:
        return []
    residual = level[1].residual
    words = "follows" if residual <= FOLLOWS else "does not follow"
    if slow <= FOLLOWS:
        words = f"follows slow motion: {slow:.2f}° with all turns eight times slower"
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


def _dead(trial: Trial) -> Finding | None:
    assert trial.answer is not None
    values = trial.answer.values
    if np.ptp(values.reshape(len(values), -1), axis=0).max() < 1e-12:
        row = np.array2string(values[0].ravel(), precision=3, separator=", ")
        return Finding("output", "constant", f"every row is {row}, whatever the sensors say")
    return None


def _gyroscope(found: Examined, trial: Trial, level: bool, hints: list[str]) -> list[Finding]:
    """What the output does for the gyroscope alone; the mistake, if mending it makes the estimator follow, goes to *hints*."""
    heard = response(found, trial)
    if heard is None:
        return []
    trial, matrix = heard.trial, heard.body
    answers = []
    for i, axis in enumerate("xyz"):
        turned = ", ".join(f"{20 * v:.1f}" for v in matrix[i])
        text = f"20° about {axis} that gyr alone tells of turn the output by ({turned})° about x, y, z"
        answers.append(Finding(f"gyroscope {axis}", _named(i, matrix[i]), text))
    right = all(finding.answer == "right" for finding in answers)
    if not right and (hint := mended_gyroscope(found, trial, matrix)):
        hints.append(hint)
    elif not right and np.abs(np.abs(heard.earth) - np.eye(3)).max() < 0.3:
        hints.append("gyr turns it about the axes of the Earth instead of the body's: the product is q ⊗ ω, not ω ⊗ q")
    for sensor in ("mag",) if level else ("acc", "mag"):
        if right and found.hears[sensor] and (hint := mended_axes(found, trial, sensor)):
            hints.append(hint)
            break
    if not hints and float(np.linalg.norm(matrix)) < 0.05 and found.hears["gyr"]:
        hints.append("the gyroscope hardly turns the output: its unit, or the time step, is too small")
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


def _listens(found: Examined) -> Finding:
    names = {"gyr": "gyroscope", "acc": "accelerometer", "mag": "magnetometer", "time": "time stamps"}
    heard = [words for key, words in names.items() if found.hears[key]]
    deaf = [words for key, words in names.items() if not found.hears[key]]
    evidence = f"not to: {', '.join(deaf)}" if deaf else "each of them moves the output"
    return Finding("listens to", ", ".join(heard) or "nothing", evidence)
