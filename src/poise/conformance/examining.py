"""From trials to a choice: what is fed until an estimator follows, and what else is varied to see what it listens to."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.conformance.answers import Answer
from poise.conformance.calling import Run
from poise.conformance.conventions import Level, levelled
from poise.conformance.feeding import FEEDS, FOLLOWS, Choice, Feed, Trial, apart, chosen, differs, tried
from poise.conformance.scene import Scene, arm, pulses, turntable
from poise.data.recording import Recording
from poise.errors import MethodError
from poise.math import arrays

Floats = NDArray[np.float64]

REST, LONG_REST = 10.0, 120.0  # s to settle in; the second for what starts from identity with a low gain
_DEAF = 1e-6  # degrees: an output that moves by less does not listen


class Arm(NamedTuple):
    """What becomes of the output if acc comes in the other unit, on an arm that accelerates."""

    other: str
    apart: float
    """degrees between the two outputs, where they differ most"""
    residual: float
    """degrees RMS in the unit that was chosen"""
    other_residual: float


@dataclass(frozen=True, eq=False)
class Examined:
    """All that was tried on an estimator, and what fits best."""

    run: Run
    rate: float
    scene: Scene
    trials: list[Trial]
    choice: Choice | None
    alike: list[Choice]
    hears: dict[str, bool]
    """whether the output changes with gyr, acc, mag, time"""
    arm: Arm | None = None
    """what the unit of the accelerometer was decided by"""
    own_rate: float | None = None
    """samples per second of a step that is fixed in the estimator, where another rate than that asked for had to be taken"""

    @property
    def follows(self) -> bool:
        return self.choice is not None and self.choice.fit.residual <= FOLLOWS

    @property
    def upright(self) -> bool:
        """Whether the output's Earth frame stands on the true vertical, where the estimator can know it."""
        return self.choice is not None and (not self.hears["acc"] or self.choice.fit.tilted < FOLLOWS)


def examined(run: Run, rate: float) -> Examined:
    """:func:`followed`, and the unit of the accelerometer, which shows only where something accelerates."""
    found = followed(run, rate)
    return _with_acc_unit(found) if found.follows and found.hears["acc"] else found


def _with_acc_unit(found: Examined) -> Examined:
    assert found.choice
    trial, fit = found.choice
    feeds = [trial.feed._replace(acc=unit) for unit in ("m/s²", "g")]
    scene = arm(found.rate)
    trials = [tried(found.run, scene, feed) for feed in feeds]
    kept = [each.like(fit) for each in trials]
    errors = [each.residual if each else float("inf") for each in kept]
    one, two = (each.answer for each in trials)
    moved = apart(one, two) if one and two else float("inf")
    this = int(errors[1] < 0.98 * errors[0] - 0.02) if moved >= 0.01 else int(trial.feed.acc == "g")
    known = Arm(feeds[1 - this].acc, moved, errors[this], errors[1 - this])
    again = next((t for t in found.trials if t.feed == feeds[this]), trial)
    same = again.like(fit)
    if same is None or same.residual > FOLLOWS:
        return replace(found, arm=Arm(feeds[this].acc, moved, errors[1 - this], errors[this]))
    return replace(found, arm=known, choice=Choice(again, same))


def followed(run: Run, rate: float) -> Examined:
    """Trials until the estimator follows: the plain ones, another rate, more time to settle, a gyroscope of the other sign.

    Raises :class:`MethodError` with its own error where it fails at whatever it is fed.
    """
    first = _examined(run, rate, REST, FEEDS)
    if all(trial.error for trial in first.trials):
        raise first.trials[0].error or MethodError(run.name)
    if first.follows and first.upright:
        return first
    if not first.hears["time"] and (own := fixed_rate(run, rate)) and abs(own / rate - 1.0) > 0.02:
        other = _examined(run, own, REST, FEEDS)
        if other.follows:
            return replace(other, own_rate=own)
    mirrored = _examined(run, rate, REST, [feed._replace(gyr_sign=-1) for feed in FEEDS])
    if mirrored.follows and mirrored.upright:
        return mirrored
    patient = _examined(run, rate, LONG_REST, FEEDS)
    return patient if patient.follows else first


def _examined(run: Run, rate: float, rest: float, feeds: list[Feed]) -> Examined:
    scene = turntable(rate, rest)
    trials = [tried(run, scene, feed) for feed in feeds]
    best = chosen(trials, heading=True)
    feed = best[0].trial.feed if best else feeds[0]
    given = best[0].trial.answer if best else next((t.answer for t in trials if t.answer), None)
    hears = _listens(run, scene, feed, given) if given else dict.fromkeys(("gyr", "acc", "mag", "time"), True)
    best = chosen(trials, heading=hears["mag"] and hears["acc"], vertical=hears["acc"])
    return Examined(run, rate, scene, trials, best[0] if best else None, best[1] if best else [], hears)


def _listens(run: Run, scene: Scene, feed: Feed, given: Answer) -> dict[str, bool]:
    """Whether the output changes when a sensor is held at its first sample, or the stamps lie twice as far apart."""
    fed = scene.recording
    held = {s: np.tile(getattr(fed, s)[:1], (len(fed), 1)) for s in ("gyr", "acc", "mag")}
    others = {s: replace(fed, truth=None, **{s: rows}) for s, rows in held.items()}
    others["time"] = replace(fed, time=2.0 * fed.time, truth=None)
    return {name: differs(run, feed, given, other) > _DEAF for name, other in others.items()}


def repeats(found: Examined) -> float:
    """Degrees between the answers to the same samples, asked twice."""
    assert found.choice and found.choice.trial.answer
    return differs(found.run, found.choice.trial.feed, found.choice.trial.answer, found.scene.recording)


def residual_on(found: Examined, scene: Scene, feed: Feed | None = None, *, spaced: float = 1.0) -> float:
    """Degrees RMS on another *scene*, read as was found; inf where it fails. *spaced* stretches time, so that rates fall."""
    assert found.choice
    if spaced != 1.0:
        fed = scene.recording
        slower = replace(fed, time=spaced * fed.time, gyr=fed.gyr / spaced, truth=None)
        scene = replace(scene, recording=slower)
    trial = tried(found.run, scene, feed or found.choice.trial.feed)
    fit = trial.like(found.choice.fit)
    return fit.residual if fit else float("inf")


def rescaled(found: Examined, sensor: str, factor: float) -> tuple[float, float]:
    """Degrees by which the output moves most, and RMS from the truth, with one *sensor*'s samples times *factor*."""
    assert found.choice and found.choice.trial.answer
    fed = found.scene.recording
    other: Recording = replace(fed, **{sensor: factor * getattr(fed, sensor)}, truth=None)
    trial = tried(found.run, replace(found.scene, recording=other), found.choice.trial.feed)
    fit = trial.like(found.choice.fit)
    if trial.answer is None or fit is None:
        return float("inf"), float("inf")
    return apart(found.choice.trial.answer, trial.answer), fit.residual


def uneven_steps(found: Examined) -> tuple[float, float]:
    """Degrees RMS with uneven stamps, and degrees by which the output moves if the same steps come in another order."""
    assert found.choice
    scene, feed = turntable(found.rate, found.scene.rest / found.rate, uneven=True), found.choice.trial.feed
    trial = tried(found.run, scene, feed)
    fit = trial.like(found.choice.fit)
    if trial.answer is None or fit is None:
        return float("inf"), float("inf")
    time = scene.recording.time
    steps = np.random.default_rng(1).permutation(np.diff(time))
    shuffled = replace(scene.recording, time=np.concatenate([time[:1], time[0] + np.cumsum(steps)]), truth=None)
    return fit.residual, differs(found.run, feed, trial.answer, shuffled)


def vertical_only(found: Examined) -> tuple[Trial, Level] | None:
    """The trial in which up comes out best, whatever the heading does."""
    best: tuple[Trial, Level] | None = None
    for trial in found.trials:
        if trial.answer is None:
            continue
        level = levelled(trial.answer, found.scene.quat, found.scene.judged)
        if level and (best is None or level.residual < best[1].residual - 0.2):
            best = trial, level
    return best


def response(found: Examined, trial: Trial) -> Floats | None:
    """(3, 3) by how much of a turn that only the gyroscope tells of the output turns: row i for a turn about body axis i.

    The identity for a filter whose gyroscope is right; in the body axes and the reading that fit best.
    """
    if not trial.fits or trial.answer is None:
        return None
    fit = trial.fits[0]
    plain = min((f for f in trial.fits if f.body == 0), key=lambda f: (f.residual, f.reading.inverse), default=fit)
    made = pulses(found.rate, REST)
    again = tried(found.run, made.scene, trial.feed)
    if again.answer is None:
        return None
    quat = plain.reading.quat(again.answer.values)
    turns = arrays.multiply(arrays.conjugate(quat[:-1]), quat[1:])
    turns *= np.where(turns[:, :1] < 0, -1.0, 1.0)
    vectors = 2.0 * turns[:, 1:]
    vectors *= (np.arctan2(np.linalg.norm(turns[:, 1:], axis=1), turns[:, 0])
                / np.maximum(np.linalg.norm(turns[:, 1:], axis=1), 1e-12))[:, None]  # fmt: skip
    found_turns = np.array([vectors[first:last].sum(axis=0) for first, last in made.rows])
    return found_turns / made.angle if np.isfinite(found_turns).all() else None


def fixed_rate(run: Run, rate: float) -> float | None:
    """Samples per second that an estimator without a clock seems to be made for, by how far it turns for a turn of 20°."""
    scene = turntable(rate, REST)
    trial = tried(run, scene, Feed())
    if not trial.fits:
        return None
    found = Examined(run, rate, scene, [trial], None, [], {})
    matrix = response(found, trial)
    if matrix is None:
        return None
    gain = float(np.cbrt(abs(np.linalg.det(matrix))))
    rates = [rate / g for g in (gain, gain * 180.0 / np.pi) if g > 0]  # its unit is not known yet
    usual = [20, 25, 30, 40, 50, 60, 75, 100, 104, 119, 120, 125, 128, 150, 200, 208, 225, 238, 250, 256, 286, 300, 400, 416,
             500, 512, 800, 833, 1000, 1600, 2000]  # fmt: skip
    near = [(abs(np.log(r / u)), float(u)) for r in rates for u in usual]
    off, own = min(near, default=(np.inf, rate))
    if off < 0.03:
        return own
    return next((r for r in rates if 10.0 <= r <= 2000.0), None)
