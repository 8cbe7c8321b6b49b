"""From trials to a choice: what is fed until an estimator follows, and what else is varied to see what it listens to."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.conformance.answers import Answer
from poise.conformance.calling import Run
from poise.conformance.conventions import Level, levelled
from poise.conformance.feeding import FEEDS, FOLLOWS, Choice, Feed, Trial, apart, chosen, differs, tried
from poise.conformance.scene import Pulses, Scene, arm, pulses, turntable
from poise.data.recording import Recording
from poise.errors import MethodError
from poise.math import arrays

Floats = NDArray[np.float64]

REST, LONG_REST = 10.0, 120.0  # s to settle in; the second for what starts from identity with a low gain
_ASIDE = arrays.matrix(np.array([np.cos(0.35), 0.6 * np.sin(0.35), 0.8 * np.sin(0.35), 0.0]))
_DEAF = 1e-6  # degrees: an output that moves by less does not listen


CLEARLY = 3.0  # by so many times a unit has to be worse to be the wrong one: either may suit a filter's gates by chance


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
    plain = next((t.like(fit) for t in found.trials if t.feed == feeds[0]), None)
    this = int(trial.feed.acc == "g" and (plain is None or plain.residual > FOLLOWS))
    if errors[this] > CLEARLY * errors[1 - this] + 0.5:
        this = 1 - this
    known = Arm(feeds[1 - this].acc, moved, errors[this], errors[1 - this])
    again = next((t for t in found.trials if t.feed == feeds[this]), trial)
    return replace(found, arm=known, choice=Choice(again, again.like(fit) or fit))


def followed(run: Run, rate: float) -> Examined:
    """Trials until the estimator follows: the plain ones, another rate, a gyroscope of the other sign, more time to settle.

    Raises :class:`MethodError` with its own error where it fails at whatever it is fed.
    """
    first = _examined(run, rate, REST, FEEDS)
    if all(trial.error for trial in first.trials):
        raise first.trials[0].error or MethodError(run.name)
    dead = all(
        t.answer is None or np.ptp(t.answer.values[first.scene.rest :], axis=0).max() < 1e-9 for t in first.trials
    )
    if dead or (first.follows and first.upright):
        return first
    if not first.hears["time"] and (own := fixed_rate(run, rate)) and abs(own / rate - 1.0) > 0.02:
        other = _examined(run, own, REST, FEEDS)
        if other.follows:
            return replace(other, own_rate=own)
    # −mag is left out: what is not decided by it differs from these by half a turn of the frame only.
    fewer = [feed for feed in FEEDS if feed.mag_sign > 0]
    for rest, sign in ((REST, -1), (LONG_REST, 1)):
        again = _examined(run, rate, rest, [feed._replace(gyr_sign=sign) for feed in fewer])
        if again.follows and (again.upright or not first.follows):
            return again
    return first


def _examined(run: Run, rate: float, rest: float, feeds: list[Feed]) -> Examined:
    scene = turntable(rate, rest)
    trials: list[Trial] = []
    plain: dict[Feed, Trial] = {}
    deaf_to_size = False
    for feed in feeds:
        in_si = plain.get(feed._replace(acc="m/s²"))
        if feed.acc == "g" and in_si is not None and deaf_to_size:
            trials.append(replace(in_si, feed=feed))
            continue
        trial = tried(run, scene, feed)
        trials.append(trial)
        if feed.acc == "m/s²":
            plain[feed] = trial
        elif in_si is not None and in_si.answer and trial.answer:
            deaf_to_size = apart(in_si.answer, trial.answer) < _DEAF
    best = chosen(trials, heading=True)
    feed = best[0].trial.feed if best else feeds[0]
    given = best[0].trial.answer if best else next((t.answer for t in trials if t.answer), None)
    hears = _listens(run, scene, feed, given) if given else dict.fromkeys(("gyr", "acc", "mag", "time"), True)
    best = chosen(trials, heading=hears["mag"] and hears["acc"], vertical=hears["acc"])
    return Examined(run, rate, scene, trials, best[0] if best else None, best[1] if best else [], hears)


def _listens(run: Run, scene: Scene, feed: Feed, given: Answer) -> dict[str, bool]:
    """Whether the output changes when a sensor says the same all the time, or the stamps lie twice as far apart."""
    fed = scene.recording
    # acc and mag point 40° away, so that one who listens at the start only is heard too.
    aside = {"gyr": np.eye(3), "acc": _ASIDE, "mag": _ASIDE}
    held = {s: np.tile(getattr(fed, s)[:1] @ turn, (len(fed), 1)) for s, turn in aside.items()}
    others = {s: replace(fed, truth=None, **_only(s, rows)) for s, rows in held.items()}
    others["time"] = replace(fed, time=2.0 * fed.time, truth=None)
    return {name: differs(run, feed, given, other) > _DEAF for name, other in others.items()}


def _only(sensor: str, rows: Floats) -> dict[str, Any]:
    return {sensor: rows}


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
        level = levelled(trial.answer, found.scene.quat, found.scene.judged) if trial.answer else None
        if level and (best is None or level.residual < best[1].residual - 0.2):
            best = trial, level
    return best


def vertical_in_slow_motion(found: Examined, feed: Feed) -> float:
    """Degrees RMS of up, with the whole motion eight times slower."""
    scene = turntable(found.rate, found.scene.rest / found.rate, slower=8.0)
    try:
        given = found.run(feed.of(scene.recording))
    except MethodError:
        return float("inf")
    level = levelled(given, scene.quat, scene.judged)
    return level.residual if level else float("inf")


class Response(NamedTuple):
    """By how much of a turn that only the gyroscope tells of the output turns: row i for a turn about body axis i."""

    trial: Trial
    """in the unit of the gyroscope that is heard better"""
    body: Floats
    """(3, 3) about the body's axes: the identity for a filter whose gyroscope is right"""
    earth: Floats
    """(3, 3) about the axes of its Earth frame: the identity for a product the wrong way round"""


def response(found: Examined, trial: Trial) -> Response | None:
    """What the output does for the gyroscope alone, in the plainest reading that makes most sense of it."""
    feeds = [trial.feed, trial.feed._replace(gyr="rad/s" if trial.feed.gyr == "deg/s" else "deg/s")]
    known = [t for feed in feeds for t in found.trials if t.feed == feed and t.fits]
    made = pulses(found.rate, REST)
    best: tuple[float, Response] | None = None
    for each in known:
        again = tried(found.run, made.scene, each.feed)
        for fit in (f for f in each.fits if again.answer and f.body == 0 and f.reading.form != "Euler angles"):
            assert again.answer
            quat = fit.reading.quat(again.answer.values)
            if not np.isfinite(quat[made.scene.rest :]).all():
                continue
            back = arrays.conjugate(quat[:-1])
            turns = (arrays.multiply(back, quat[1:]), arrays.multiply(quat[1:], back))
            body, earth = (_summed(turn, made) for turn in turns)
            clear = (
                min(_unlike_axes(body), _unlike_axes(earth) + 0.1) + 0.02 * fit.reading.inverse + 0.001 * fit.residual
            )
            if best is None or clear < best[0]:
                best = clear, Response(each, body, earth)
    return best[1] if best else None


def _summed(turns: Floats, made: Pulses) -> Floats:
    turns = turns * np.where(turns[:, :1] < 0, -1.0, 1.0)
    sine = np.linalg.norm(turns[:, 1:], axis=1)
    vectors = 2.0 * (np.arctan2(sine, turns[:, 0]) / np.maximum(sine, 1e-12))[:, None] * turns[:, 1:]
    return np.array([vectors[first:last].sum(axis=0) for first, last in made.rows]) / made.angle


def _unlike_axes(matrix: Floats) -> float:
    """How far a response is from turns of the right size about three axes, each about its own."""
    lengths = np.linalg.norm(matrix, axis=1)
    largest = np.abs(matrix).max(axis=1)
    spread = np.linalg.norm(np.sqrt(np.maximum(lengths**2 - largest**2, 0.0)) / np.maximum(lengths, 1e-9))
    size = float(np.mean(np.abs(np.log(np.clip(lengths, 1e-4, 1e4)))))
    exchanged = 0.3 * bool((np.argmax(np.abs(matrix), axis=1) != np.arange(3)).any())
    return float(spread) + size + exchanged + 0.02 * int(np.sum(np.diag(matrix) < 0))


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
    gain = float(np.cbrt(abs(np.linalg.det(matrix.body))))
    rates = [rate / g for g in (gain, gain * 180.0 / np.pi) if g > 0]  # its unit is not known yet
    usual = [20, 25, 30, 40, 50, 60, 75, 100, 104, 119, 120, 125, 128, 150, 200, 208, 225, 238, 250, 256, 286, 300, 400, 416,
             500, 512, 800, 833, 1000, 1600, 2000]  # fmt: skip
    near = [(abs(np.log(r / u)), float(u)) for r in rates for u in usual]
    off, own = min(near, default=(np.inf, rate))
    if off < 0.03:
        return own
    return next((r for r in rates if 10.0 <= r <= 2000.0), None)
