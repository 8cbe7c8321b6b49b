"""Axes: which sensor's axes are renamed or negated against the others', as far as the motion tells."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from poise.doctor.turning import Turns, changed, mean_cosines, signed_axes

Floats = NDArray[np.float64]
Hemisphere = Literal["north", "south"]
Sensor = Literal["", "gyr", "acc", "mag", "both"]

SURE = 3.5  # standard deviations of the windows' votes against every other answer, to name one; clean ones reach 1.6
_REFUTED = 4.5  # the same against the axes as they are alone, where none can be named
AGREED = 3.0  # the same, to say that the axes as they are fit best
_CLEAR = 2.0  # times smaller the loss must be: an alarm wants more than a consistent trifle
_WORST = 1.25  # times what no gyroscope at all leaves: an answer that leaves more explains nothing
_SCATTER = 0.15  # of gravity's squared length: in the right axes less is left, whatever the motion
_LEAST_DIP = 0.15  # cosine between specific force and field: nearer to the magnetic equator the dip has no sign


class Answer(NamedTuple):
    """A way in which the axes may be: one sensor renamed, or none."""

    sensor: Sensor
    acc: int
    """which of the 48 the gyroscope then is, seen from the accelerometer"""
    mag: int
    """the same, seen from the magnetometer"""


class Verdict(NamedTuple):
    """What the votes of the windows say."""

    answer: Answer
    """the likeliest"""
    sure: bool
    """whether it is another than the axes as they are, beyond doubt"""
    wrong: bool
    """whether the axes as they are cannot be right, whatever is"""
    agreed: bool
    """whether the axes as they are fit better than any other"""
    margin: float
    """standard deviations from the likeliest to the next"""
    rival: Answer
    """the next likely"""
    against: float
    """standard deviations from the likeliest to the axes as they are"""
    apart: float
    """standard deviations by which acc alone and mag alone put it before their own next, the smaller; below 0: they do not"""
    better: float
    """how many times smaller the loss of the likeliest is than that of the axes as they are, where they differ most"""


@cache
def single_answers() -> tuple[Answer, ...]:
    """The axes as they are, then every way to rename those of one sensor: 47 of the gyroscope, 23 pairs of the others."""

    def all_() -> Iterator[Answer]:
        yield Answer("", 0, 0)
        yield from (Answer("gyr", i, i) for i in range(1, 48))
        yield from (Answer("acc", i, 0) for i in range(1, 24))
        yield from (Answer("mag", 0, i) for i in range(1, 24))

    return tuple(all_())


def judge(acc: Turns, mag: Turns) -> Verdict:
    """Which of the answers the windows vote for, and by how much; with sensor "both" where one is not enough.

    Of two sensors it cannot be told who is wrong: the answer then is the gyroscope's axes, as seen from the other.
    """
    answers = single_answers()
    by_acc, by_mag = acc.votes, mag.votes
    if not len(by_acc) or not len(by_mag):
        answers = answers[:48]
    else:
        both = Answer("both", int(by_acc[:, :48].sum(axis=0).argmin()), int(by_mag[:, :48].sum(axis=0).argmin()))
        if not any(each[1:] == both[1:] for each in answers):
            found = _judged((*answers, both), acc, mag, by_acc, by_mag)
            if found.answer.sensor == "both" and found.sure:
                return found
    return _judged(answers, acc, mag, by_acc, by_mag)


def _judged(answers: Sequence[Answer], acc: Turns, mag: Turns, by_acc: Floats, by_mag: Floats) -> Verdict:
    a, m = np.array([each.acc for each in answers]), np.array([each.mag for each in answers])
    total = by_acc.sum(axis=0)[a] + by_mag.sum(axis=0)[m]
    best = int(np.argmin(total))
    squares = ((by_acc[:, a] - by_acc[:, [a[best]]]) ** 2).sum(axis=0)
    squares += ((by_mag[:, m] - by_mag[:, [m[best]]]) ** 2).sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        deviations = np.where(squares > 0, (total - total[best]) / np.sqrt(squares), 0.0)
    others = np.delete(np.arange(len(answers)), best)
    rival = int(others[np.argmin(deviations[others])])
    chosen, margin, against = answers[best], float(deviations[rival]), float(deviations[0])
    clear, better = _clear(chosen, acc, mag, by_acc, by_mag)
    sure = bool(best != 0 and margin >= SURE and clear)
    wrong = sure or bool(best != 0 and against >= _REFUTED and clear)
    agreed = bool(best == 0 and margin >= AGREED)
    apart = min(_alone(by_acc, chosen.acc), _alone(by_mag, chosen.mag))
    return Verdict(chosen, sure, wrong, agreed, margin, answers[rival], against, apart, better)


def _alone(votes: Floats, index: int) -> float:
    """Standard deviations of one sensor's votes from answer *index* to the likeliest of the other 47; infinite without a vote.

    Two sensors may be wrong: what is wrong with one is known only where the turning of acc and that of mag, each by itself,
    say the same. Together they do not: a clear vote of mag carries whatever acc, which shakes, does not contradict.
    """
    if not len(votes):
        return float("inf")
    votes = votes[:, :48]
    total = votes.sum(axis=0)
    spread = np.sqrt(((votes - votes[:, [index]]) ** 2).sum(axis=0))
    others = np.arange(len(total)) != index
    return float(np.min((total - total[index])[others] / np.maximum(spread[others], 1e-9)))


def _clear(answer: Answer, acc: Turns, mag: Turns, by_acc: Floats, by_mag: Floats) -> tuple[bool, float]:
    """Whether *answer* explains what is seen where the axes as they are do not, by size and not by consistency alone.

    It must also be better than a gyroscope that says nothing: a sensor that swings to and fro on a rope feels a force that
    stands still in the body, and axes that turn about that force would "explain" it. And gravity must then stand still: an
    acceleration without it may do so better in other axes, and not well.
    """
    better, worst, gained, spread = 1.0, 0.0, 0.0, 0.0
    for turns, votes, index in ((acc, by_acc, answer.acc), (mag, by_mag, answer.mag)):
        if index == 0 or not len(votes):
            continue
        loss = float(turns.total[index])
        worst = max(worst, loss / max(turns.still_total, 1e-12))
        better = max(better, float(turns.total[0]) / max(loss, 1e-12))
        difference = votes[:, 48] - votes[:, index]
        gained, spread = gained + float(difference.sum()), spread + float(np.sum(difference**2))
    clear = better >= _CLEAR and worst <= _WORST and gained >= AGREED * np.sqrt(max(spread, 1e-12))
    clear &= answer.acc == 0 or not len(by_acc) or float(acc.total[answer.acc]) < _SCATTER
    return bool(clear), better


class Fix(NamedTuple):
    """The axes that put one sensor right."""

    matrix: Floats
    """(3, 3), v_right = M v"""
    decided: bool
    """whether force and field then stand as they do in the hemisphere, clearly"""
    cosine: float
    """between specific force and field, thereafter"""
    otherwise: Floats | None = None
    """the axes of both acc and mag that would explain the same, where those are as few changes"""


def fix(answer: Answer, acc: Floats, mag: Floats, hemisphere: Hemisphere) -> Fix:
    """The axes for the one sensor of *answer*, from blocks of *acc* and *mag* (m, 3).

    The turning leaves the sign of gravity and of the field open: −v turns as v does. The one that is left as it is fixes
    the other's, since the field points down in the north and up in the south. A gyroscope leaves both as they are, and with
    them their sign: force and field that stand as in the other hemisphere are a second mistake, or that hemisphere.
    """
    along = mean_cosines(acc, mag)
    if answer.sensor == "gyr":
        matrix, cosine = signed_axes()[answer.acc], float(np.trace(along))
        same = 2 * changed(-matrix) <= changed(matrix) and np.linalg.det(matrix) > 0
        return Fix(matrix, _stands(cosine, hemisphere), cosine, -matrix.T if same else None)
    matrix = signed_axes()[answer.acc or answer.mag].T
    cosine = float(np.sum(matrix * (along.T if answer.sensor == "acc" else along)))
    if cosine * down(hemisphere) < 0:
        matrix, cosine = -matrix, -cosine
    return Fix(matrix, _stands(cosine, hemisphere), cosine)


def _stands(cosine: float, hemisphere: Hemisphere) -> bool:
    """Whether force and field stand as they do in the *hemisphere*, clearly."""
    return cosine * down(hemisphere) > _LEAST_DIP


class BothFixes(NamedTuple):
    """The axes that put two sensors right."""

    axes: dict[str, Floats]
    """(3, 3) by sensor, v_right = M v"""
    cosine: float
    """between specific force and field, thereafter"""


def both_fixes(verdict: Verdict, acc: Floats, mag: Floats, hemisphere: Hemisphere) -> BothFixes | None:
    """The axes for the two sensors of an answer "both"; None where the motion does not name each one's beyond doubt.

    One of the three is taken to be right; which one is a rotation common to all, which is no fault. The one that is changed
    least is chosen. Force and field stand as they do in the *hemisphere*; no motion tells the sign that they share.
    """
    seen = signed_axes()[verdict.answer.acc], signed_axes()[verdict.answer.mag]
    mirrored = np.linalg.det(seen[0]) < 0
    if verdict.apart < SURE or mirrored != (np.linalg.det(seen[1]) < 0):
        return None
    cosine = float(np.sum((seen[0].T @ mean_cosines(acc, mag)) * seen[1].T))
    relative = 1.0 if cosine * down(hemisphere) > 0 else -1.0
    between = seen[0] @ seen[1].T  # the field as seen from acc
    alike = [{"acc": seen[0].T, "mag": relative * seen[1].T}, {"acc": -seen[0].T, "mag": -relative * seen[1].T}]
    others = [{"gyr": seen[0], "mag": relative * between}, {"gyr": seen[1], "acc": relative * between.T}]
    candidates = others if mirrored else [*alike, *others]
    return BothFixes(min(candidates, key=_cost), relative * cosine)


def _cost(axes: dict[str, Floats]) -> int:
    """How many axes are changed."""
    return sum(map(changed, axes.values()))


def down(hemisphere: Hemisphere) -> float:
    """The sign of the cosine between specific force (up) and field."""
    return -1.0 if hemisphere == "north" else 1.0


def opposed(cosine: float, hemisphere: Hemisphere) -> bool:
    """Whether field and force lie as they do in the other hemisphere."""
    return cosine * down(hemisphere) < -_LEAST_DIP


def words(matrix: Floats) -> str:
    """The axes of a signed permutation as words, "y -x z"."""
    order = np.argmax(np.abs(matrix), axis=1)
    return " ".join(("-" if matrix[i, k] < 0 else "") + "xyz"[k] for i, k in enumerate(order))
