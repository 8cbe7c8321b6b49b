"""The answers, question by question, each with the figures that decide it."""

from __future__ import annotations

import numpy as np

from poise.conformance import frames
from poise.conformance.conventions import WELL_KNOWN, Fit, distance
from poise.conformance.examining import CLEARLY, Examined, repeats, rescaled, residual_on, uneven_steps
from poise.conformance.feeding import FOLLOWS, Feed, Trial, tried
from poise.conformance.result import CANNOT_TELL, Finding
from poise.conformance.scene import turntable
from poise.math import arrays

_INF = float("inf")
_SAME = 0.05  # degrees RMS: a difference of less decides nothing


def findings(found: Examined) -> list[Finding]:
    """All of them, for an estimator that follows."""
    assert found.choice
    return [
        _output(found),
        _direction(found),
        _earth(found),
        _body(found),
        _gyroscope(found),
        _accelerometer(found),
        _magnetometer(found),
        _time(found),
        _scalar(found),
        _settling(found),
        _repeatable(found),
    ]


def heading_known(found: Examined) -> bool:
    return found.hears["mag"] and found.hears["acc"]


def _output(found: Examined) -> Finding:
    fit = _fit(found)
    reading = fit.reading
    if reading.form == "Euler angles":
        others = [f for f in _fits(found) if f.reading.degrees == reading.degrees and f.reading != reading]
        answer = f"Euler angles, {euler_words(fit)}"
        return _against(answer, "output", fit.residual, others, "the next order or sign")
    if reading.form != "quaternion":
        return Finding("output", reading.form, f"{fit.residual:.2f}° from the truth", fit.residual)
    others = [f for f in _fits(found) if f.body == fit.body and f.reading.order != reading.order]
    answer = f"quaternion, {' '.join(reading.order)}"
    return _against(answer, "output", fit.residual, others, f"{'x y z w' if reading.order == 'wxyz' else 'w x y z'}")


def euler_words(fit: Fit) -> str:
    """The order of the turns, their columns with signs, and the unit."""
    reading = fit.reading
    columns = ", ".join(f"{'−' if s < 0 else ''}{c + 1}" for c, s in zip(reading.columns, reading.signs, strict=True))
    return f"turns about {' then '.join(reading.order.lower())} (body-fixed) from columns {columns}, " + (
        "degrees" if reading.degrees else "rad"
    )


def _direction(found: Examined) -> Finding:
    fit = _fit(found)
    if fit.reading.form == "Euler angles":
        return Finding("direction", "body to Earth", "by the order and signs of its angles", fit.residual)
    others = [
        f
        for f in _fits(found)
        if f.body == fit.body and f.reading == fit.reading._replace(inverse=not fit.reading.inverse)
    ]
    names = ("body to Earth", "Earth to body")
    this, other = names[fit.reading.inverse], names[not fit.reading.inverse]
    return _against(this, "direction", fit.residual, others, other)


def _earth(found: Examined) -> Finding:
    fit, question = _fit(found), "Earth frame"
    if not found.hears["acc"]:
        others = "a field alone does" if found.hears["mag"] else "a gyroscope alone does"
        evidence = f"{others} not tell which way is up: the output turns as the truth does, from wherever it starts"
        return Finding(question, CANNOT_TELL, evidence, fit.residual)
    if not heading_known(found):
        return Finding(question, f"{vertical_words(fit)}, heading arbitrary", _heading_evidence(found), fit.residual)
    snapped = [(_snapped(found, q), frames.earth_name(m)) for q, m in zip(frames.QUATS, frames.MATRICES, strict=True)]
    own = next(d for d, name in snapped if name == fit.frame)
    next_best = min((d, name) for d, name in snapped if name != fit.frame)
    turned = fit.turn_about_up
    answer = fit.frame if abs(turned) < 1.0 else f"{fit.frame} turned by {turned:.1f}° about up (a declination?)"
    return Finding(question, answer, f"{own:.2f}°, as {next_best[1]} {next_best[0]:.0f}°", own, next_best[0])


def vertical_words(fit: Fit) -> str:
    axis = int(np.argmax(np.abs(fit.up)))
    return f"{'xyz'[axis]} {'up' if fit.up[axis] > 0 else 'down'}"


def _heading_evidence(found: Examined) -> str:
    fit = _fit(found)
    assert found.choice and found.choice.trial.answer
    first = fit.reading.quat(found.choice.trial.answer.values[:1])
    matrix = arrays.matrix(first)[0]
    axis = int(np.argmax(np.abs(fit.up)))
    forward, left = matrix[(axis + 1) % 3, 0], matrix[(axis + 2) % 3, 0]
    heading = np.degrees(np.arctan2(left, forward))
    return f"the magnetometer changes nothing; body x starts at {heading:.0f}° from the frame's {'xyz'[(axis + 1) % 3]}"


def _body(found: Examined) -> Finding:
    fit, question = _fit(found), "body axes"
    others = [f for f in _fits(found) if f.body != fit.body and f.reading == fit.reading]
    if fit.reading.form == "Euler angles":
        return Finding(question, "as fed", "angles fit the axes as they are", fit.residual)
    answer = (
        "as fed"
        if fit.body == 0
        else f'turned: its x, y, z are "{frames.body_words(frames.MATRICES[fit.body].T)}" of yours'
    )
    return _against(answer, question, fit.residual, others, "the next of 24")


def _gyroscope(found: Examined) -> Finding:
    question, choice = "gyroscope", found.choice
    assert choice
    feed, fit = choice.trial.feed, choice.fit
    if not found.hears["gyr"]:
        return Finding(question, "not used", "if it says the same all the time, nothing changes", fit.residual)
    unit = feed.gyr if feed.gyr_sign > 0 else f"{feed.gyr}, of the other sign (it turns against the right-hand rule)"
    other = "deg/s" if feed.gyr == "rad/s" else "rad/s"
    residual = _as(found, feed._replace(gyr=other))
    return _decided(question, unit, other, fit.residual, residual)


def _accelerometer(found: Examined) -> Finding:
    question, choice = "accelerometer", found.choice
    assert choice
    feed, fit = choice.trial.feed, choice.fit
    if not found.hears["acc"]:
        return Finding(question, "not used", "if it says the same all the time, nothing changes", fit.residual)
    sign = "specific force (+g up at rest)" if feed.acc_sign > 0 else "gravity (+g down at rest)"
    unit, unit_evidence, unit_other = _acc_unit(found)
    turned = feed._replace(acc_sign=-feed.acc_sign)
    same = _same_otherwise(found, turned)
    if same:
        evidence = f"of the other sign: {same.residual:.2f}° too, as {_frame_words(found, same)}"
        other = unit_other
    else:
        other = _as(found, turned)
        evidence = f"{fit.residual:.2f}°, of the other sign {_degrees(other)}"
        other = min(other, unit_other)
    return Finding(question, f"{sign}, {unit}", f"{evidence}; {unit_evidence}", fit.residual, _nan(other))


def _acc_unit(found: Examined) -> tuple[str, str, float]:
    """Words, evidence, and the residual with the other unit where it is worse."""
    assert found.choice and found.arm
    other, apart, here, there = found.arm
    unit = found.choice.trial.feed.acc
    if apart < 0.01:
        return "m/s² or g", f"in {other} the output moves by less than 0.01°, on an arm too", float("nan")
    evidence = f"on an arm {_degrees(here)}, in {other} {_degrees(there)}, up to {_degrees(apart)} apart"
    if there > CLEARLY * here + 0.5:
        return unit, evidence, there
    return f"{CANNOT_TELL} m/s² from g", evidence, float("nan")


def _magnetometer(found: Examined) -> Finding:
    question, choice = "magnetometer", found.choice
    assert choice
    feed, fit = choice.trial.feed, choice.fit
    if not found.hears["mag"]:
        return Finding(question, "not used", "if it says the same all the time, nothing changes", fit.residual)
    words = [
        "as measured (points north and, in the north, down)" if feed.mag_sign > 0 else "negated (points south and up)"
    ]
    turned = feed._replace(mag_sign=-feed.mag_sign)
    same = _same_otherwise(found, turned)
    other = float("nan") if same else _as(found, turned)
    evidence = [
        f"negated: {same.residual:.2f}° too, as {_frame_words(found, same)}" if same else f"negated {_degrees(other)}"
    ]
    moved, residual = min((rescaled(found, "mag", factor) for factor in (0.01, 1.0 / 48.0)), key=lambda r: -r[0])
    if moved < 0.01:
        words.append("any unit")
    elif residual > 2.0 * fit.residual + _SAME:
        words.append("µT")
        evidence.append(f"in gauss or unit length {_degrees(residual)}")
    else:
        evidence.append(f"in gauss the output moves by up to {_degrees(moved)}")
    south = residual_on(found, turntable(found.rate, found.scene.rest / found.rate, southern=True))
    words.append("either hemisphere" if south <= 2.0 * fit.residual + 0.5 else "northern hemisphere only")
    evidence.append(f"with the field of the south {_degrees(south)}")
    return Finding(question, ", ".join(words), "; ".join(evidence), fit.residual, _nan(other))


def _time(found: Examined) -> Finding:
    question, fit = "time", _fit(found)
    if not found.hears["gyr"] and not found.hears["time"]:
        return Finding(question, "not used", "the output is the same with stamps twice as far apart", fit.residual)
    if not found.hears["time"]:
        made_for = f"made for {found.rate:g} samples a second"
        return Finding(question, f"stamps ignored, {made_for}", "the output is the same with stamps twice as far apart")
    slower = residual_on(found, found.scene, spaced=2.0)
    uneven, shuffled = uneven_steps(found)
    evidence = f"at half the rate {_degrees(slower)}, with uneven steps {_degrees(uneven)}"
    if slower > FOLLOWS:
        return Finding(question, CANNOT_TELL, f"stamps matter, but {evidence}", fit.residual, slower)
    if shuffled < 0.01:
        return Finding(
            question, "one rate for all samples", f"{evidence}, the same if these are shuffled", fit.residual, uneven
        )
    return Finding(
        question, "every step counts", f"{evidence}, {_degrees(shuffled)} apart if these are shuffled", fit.residual
    )


def _scalar(found: Examined) -> Finding:
    question, fit = "sign and length", _fit(found)
    assert found.choice and found.choice.trial.answer
    given = found.choice.trial.answer
    if given.form != "quaternion":
        return Finding(question, "-", "only a quaternion has them")
    values = given.values[np.isfinite(given.values).all(axis=1)]
    lengths = np.linalg.norm(values, axis=1)
    scalar = values[:, 3 if fit.reading.order == "xyzw" else 0]
    jumps = int(np.sum(np.einsum("ij,ij->i", values[1:], values[:-1]) < 0))
    if (scalar >= 0).all():
        sign = "w ≥ 0"
    elif (scalar <= 0).all():
        sign = "w ≤ 0"
    else:
        sign = "w of either sign"
    off = float(np.max(np.abs(lengths - 1.0)))
    length = "unit length" if off < 1e-6 else "not of unit length: normalise"
    return Finding(question, f"{sign}, {length}", f"{jumps} jumps from q to −q; |q| within {off:.0e} of 1")


def _settling(found: Examined) -> Finding:
    question, fit = "settling", _fit(found)
    assert found.choice and found.choice.trial.answer
    read = fit.reading.quat(found.choice.trial.answer.values[: found.scene.rest])
    truth = arrays.multiply(arrays.multiply(fit.earth, found.scene.quat[: found.scene.rest]), frames.QUATS[fit.body])
    error = np.degrees(arrays.angle(arrays.multiply(read, arrays.conjugate(truth))))
    far = np.flatnonzero(~(error < FOLLOWS))
    seconds = (far[-1] + 1) / found.rate if len(far) else 0.0
    first = f"the first row is {error[0]:.0f}° off" if np.isfinite(error[0]) else "the first row is no rotation"
    rest = found.scene.rest / found.rate
    if seconds >= rest:
        return Finding(question, CANNOT_TELL, f"{first}, and it is not within {FOLLOWS:g}° after {rest:g} s at rest")
    return Finding(
        question, f"{seconds:.1f} s at rest" if seconds else "at once", f"{first}; until within {FOLLOWS:g}°"
    )


def _repeatable(found: Examined) -> Finding:
    assert found.choice and found.choice.trial.answer
    apart = repeats(found)
    values = found.choice.trial.answer.values
    absent = float(np.mean(~np.isfinite(values.reshape(len(values), -1)).all(axis=1)))
    words = ["the same again" if apart < 1e-9 else "another answer to the same samples"]
    evidence = [f"asked twice, it differs by up to {_degrees(apart)}"]
    if absent:
        words.append("NaN in some rows")
        evidence.append(f"{absent:.1%} of the rows hold NaN")
    return Finding("repeatability", ", ".join(words), "; ".join(evidence))


# -- what they are made of --------------------------------------------------------------------------------------------


def _fit(found: Examined) -> Fit:
    assert found.choice
    return found.choice.fit


def _fits(found: Examined) -> tuple[Fit, ...]:
    assert found.choice
    return found.choice.trial.fits


def _as(found: Examined, feed: Feed) -> float:
    """Degrees RMS with another feed, read the same way; how far its frame leans, where that is more."""
    trial = _trial(found, feed)
    fit = trial.like(_fit(found))
    if fit is None:
        return _INF
    return max(fit.residual, fit.tilted) if found.hears["acc"] else fit.residual


def _trial(found: Examined, feed: Feed) -> Trial:
    known = next((trial for trial in found.trials if trial.feed == feed), None)
    return known or tried(found.run, found.scene, feed)


def _same_otherwise(found: Examined, feed: Feed) -> Fit | None:
    """The fit by which another sign is the same estimator, said otherwise: as good, in another frame."""
    trial, fit = _trial(found, feed), _fit(found)
    other = trial.like(fit)
    good = other is not None and other.residual <= 1.25 * fit.residual + 0.15
    return other if good and other is not None and (other.tilted < FOLLOWS or fit.tilted >= FOLLOWS) else None


def _frame_words(found: Examined, fit: Fit) -> str:
    return fit.frame if heading_known(found) else vertical_words(fit)


def _snapped(found: Examined, earth: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> float:
    assert found.choice and found.choice.trial.answer
    return distance(_fit(found), earth, found.choice.trial.answer, found.scene.quat, found.scene.judged)


def _against(answer: str, question: str, residual: float, others: list[Fit], name: str) -> Finding:
    best = min((f.residual for f in others), default=_INF)
    return _decided(question, answer, name, residual, best)


def _decided(question: str, answer: str, other_name: str, residual: float, other: float) -> Finding:
    if other <= 1.25 * residual + _SAME:
        evidence = f"{residual:.2f}°, but {other_name} {_degrees(other)} too"
        return Finding(question, CANNOT_TELL, f"{answer}? {evidence}", residual, _nan(other))
    return Finding(question, answer, f"{residual:.2f}°, {other_name} {_degrees(other)}", residual, _nan(other))


def _degrees(value: float) -> str:
    if not np.isfinite(value):
        return "fails"
    return f"{value:.0f}°" if value >= 9.95 else f"{value:.2f}°"


def _nan(value: float) -> float:
    return value if np.isfinite(value) else float("nan")


def equivalents(found: Examined) -> list[str]:
    """The same estimator in other words, those with a well-known frame."""
    assert found.choice
    seen = []
    for trial, fit in found.alike:
        same_reading = fit.reading == found.choice.fit.reading and fit.body == found.choice.fit.body
        known = fit.frame in WELL_KNOWN and trial.feed[:3] == found.choice.trial.feed[:3]
        if same_reading and known and heading_known(found) and fit.off_axis < FOLLOWS:
            seen.append(f"{fit.frame}, fed {_signs(trial.feed)}")
    return list(dict.fromkeys(seen))


def _signs(feed: Feed) -> str:
    acc = "gravity (−acc)" if feed.acc_sign < 0 else "specific force"
    return acc + (" and a negated magnetometer" if feed.mag_sign < 0 else "")


def runner_up(found: Examined, all_findings: list[Finding]) -> tuple[str, float]:
    """The question with the least margin, and the residual of its second best answer."""
    decided = [f for f in all_findings if f.question in _DECIDING and np.isfinite(f.next_deg)]
    closest = min(decided, key=lambda f: f.next_deg, default=None)
    return (closest.question, closest.next_deg) if closest else ("", float("nan"))


_DECIDING = ("output", "direction", "Earth frame", "body axes", "gyroscope", "accelerometer", "magnetometer")
