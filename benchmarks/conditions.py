"""The flagship under conditions that the trials do not have: on vehicles, and with sensors that are worse.

    python benchmarks/conditions.py [SECTION...]     all of them by default

driving     made recordings of circling, a car and a weaving drive, with and without magnetometer
step        the same with a step of the gyroscope's bias under way
held        an accelerometer slower than the rows: its last sample repeated, or none between
scale       scale errors and misalignments of the gyroscope
drift       a bias of the gyroscope that drifts
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

import poise
from ablation import FLAGSHIP, RUNS, Run, axis_errors, causal, slashed
from poise.data.recording import Recording
from poise.simulation import Motion, Sensor, measure
from regimes import Table, Trials, main
from tables import Cell
from vehicles import car, circling, weaving

Floats = NDArray[np.float64]
Change = Callable[[Recording], Recording]

SIGMA = ("causal", "offline")  # the runs that tell how sure they are
UNWATCHED = RUNS | {"causal without (22)": causal(FLAGSHIP._replace(watch_tilt=9.0))}
STEP = 60.0  # s
SEEDS = range(8)
# rad/s, m, s: more than two minutes of a round slower than `watch_time`, in the last two, and less
ROUNDS = (
    *((rate, radius, 150.0) for rate, radius in ((0.5, 2.0), (0.5, 4.0), (0.7, 3.0), (0.8, 5.0), (1.0, 2.0))),
    *((rate, radius, seconds) for rate, radius in ((0.33, 18.0), (0.2, 100.0)) for seconds in (110.0, 150.0)),
)


def rows_of(cases: Mapping[str, Trials], runs: Mapping[str, Run]) -> Iterator[list[Cell]]:
    """What each case makes of the recordings: errors by run, and how far sigma covers those of the flagship."""
    for case, recordings in cases.items():
        found: dict[str, dict[str, Floats]] = {run: {} for run in runs}
        beyond: dict[str, list[Floats]] = {run: [] for run in SIGMA}
        for name, recording in recordings.items():
            for run, made in runs.items():
                attitude = made(recording)
                found[run][name] = np.array(poise.evaluate(attitude, recording).rmse_deg())
                if run in SIGMA:
                    beyond[run].append(outside(attitude, recording))
        has_heading = all(r.has_mag for r in recordings.values())
        shares = [100.0 * np.nanmean(np.concatenate(parts), axis=0) for parts in beyond.values()]
        yield [
            case,
            *(told(errors, has_heading) for errors in found.values()),
            *("/".join(f"{v:.1f}" for v in share[: 3 if has_heading else 2]) for share in shares),
        ]


def told(errors: dict[str, Floats], has_heading: bool) -> str:
    """Mean errors and the largest total, or inclination where nothing gives a heading, with its recording."""
    judged = 0 if has_heading else 2
    worst = max(errors, key=lambda name: errors[name][judged])
    mean = slashed(np.mean(list(errors.values()), axis=0)[:: 1 if has_heading else -3], 2)
    return f"{mean}, {errors[worst][judged]:.1f} ({worst[:2]})"


def outside(attitude: poise.Attitude, recording: Recording) -> Floats:
    """(m, 3) of the rows that count: not valid; of those that are, the tilt beyond 3 sigma, and the heading."""
    with np.errstate(divide="ignore"):
        ratio = np.abs(axis_errors(attitude, recording)) / attitude.sigma
    beyond = np.column_stack([~attitude.valid, ratio[:, :2].max(axis=1) > 3.0, ratio[:, 2] > 3.0]).astype(float)
    beyond[~attitude.valid, 1:] = np.nan
    return beyond[poise.evaluate(attitude, recording).counted]


def compared(what: str, cases: Mapping[str, Trials], runs: Mapping[str, Run] = RUNS) -> Table:
    columns = ["", *runs, *(f"% {run}" for run in SIGMA)]
    title = (
        f"{what}: mean total/heading/inclination RMSE, degrees (without magnetometer the inclination), and the worst; "
        "% of rows not valid/of valid ones beyond 3 sigma: tilt/heading"
    )
    return title, columns, list(rows_of(cases, runs))


# -- on vehicles ------------------------------------------------------------------------------------------------------


def measured(motion: Callable[[int], Motion]) -> Trials:
    return {f"{seed}": measure(motion(seed), Sensor(), seed=seed) for seed in SEEDS}


def without_mag(recordings: Trials) -> Trials:
    return {name: replace(recording, mag=None) for name, recording in recordings.items()}


def both(cases: Mapping[str, Trials]) -> dict[str, Trials]:
    return dict(cases) | {f"{case}, no magnetometer": without_mag(made) for case, made in cases.items()}


def driving(trials: Trials) -> Iterator[Table]:
    del trials
    cases = {
        f"{rate:g} rad/s at {radius:g} m, {rate**2 * radius:.1f} m/s², {seconds - 20.0:g} s": measured(
            partial(circling, rate, radius, seconds=seconds)
        )
        for rate, radius, seconds in ROUNDS
    }
    cases |= {"car": measured(car)}
    cases |= {f"weaving, ±{10.0 * turning:g} m/s²": measured(partial(weaving, turning)) for turning in (0.1, 0.3)}
    yield compared("vehicles with an inexpensive sensor, eight recordings each", both(cases), UNWATCHED)


def step(trials: Trials) -> Iterator[Table]:
    """About the body's x, across the way: what gravity then says of the tilt could be a push ahead."""
    del trials
    motions: dict[str, Callable[[int], Motion]] = {
        "straight": partial(weaving, 0.0),
        "weaving, ±3 m/s²": partial(weaving, 0.3),
        "0.5 rad/s at 4 m": partial(circling, 0.5, 4.0, seconds=250.0),
        "car": car,
    }
    cases: dict[str, Trials] = {}
    taken: list[list[Cell]] = []
    for motion, make in motions.items():
        for label, recordings in both({motion: measured(make)}).items():
            for size in (0.5, 2.0):
                case = f"{label}, {size:g} deg/s"
                cases[case] = {name: stepped(r, size) for name, r in recordings.items()}
                seconds = sorted(until_known(r, size) for r in cases[case].values())
                median = float(np.median(seconds))
                taken.append([case, median if median < np.inf else None, sum(s < np.inf for s in seconds)])
    yield compared(f"a step of the bias about x at {STEP:g} s, eight recordings each, from then on", cases, UNWATCHED)
    yield "s until the bias about x is right within 0.3 deg/s for 10 s, causal", ["", "median", "of eight"], taken


def stepped(recording: Recording, size: float) -> Recording:
    """A step (deg/s), and only what comes after it counts."""
    assert recording.moving is not None
    later = recording.time >= STEP
    gyr = recording.gyr + np.outer(later, np.radians([size, 0.0, 0.0]))
    return replace(recording, gyr=gyr, moving=recording.moving & later)


def until_known(recording: Recording, size: float) -> float:
    """Seconds from the step on until it is for 10 s on end, causal; inf where it never is."""
    assert recording.truth is not None
    off = np.abs(causal()(recording).bias[:, 0] - recording.truth.bias[:, 0] - np.radians(size))
    wrong = recording.time[(recording.time >= STEP) & ~(off < np.radians(0.3))]
    right_for = np.diff(wrong, append=recording.time[-1])
    return float(wrong[np.argmax(right_for > 10.0)] - STEP) if (right_for > 10.0).any() else np.inf


# -- worse sensors, on the trials -------------------------------------------------------------------------------------


def changed(trials: Trials, change: Change) -> Trials:
    return {name: change(recording) for name, recording in trials.items()}


def held(trials: Trials) -> Iterator[Table]:
    cases = {"as it is": trials}
    for label, of in (("the last one repeated", repeated), ("none between", single), ("means, none between", means)):
        for every in (6, 11, 29):
            slower = partial(_with_acc, of=partial(of, every=every))
            cases[f"{285.7 / every:.0f} Hz, {label}"] = changed(trials, slower)
    yield compared("accelerometers of fewer samples a second in rows of 286, all trials", cases)


def _with_acc(recording: Recording, of: Callable[[Floats], Floats]) -> Recording:
    return replace(recording, acc=of(recording.acc))


def repeated(rows: Floats, every: int) -> Floats:
    return rows[np.arange(len(rows)) // every * every]


def single(rows: Floats, every: int) -> Floats:
    return np.where((np.arange(len(rows)) % every == 0)[:, None], rows, np.nan)


def means(rows: Floats, every: int) -> Floats:
    """Each in the last of the rows that it is the mean of."""
    n = len(rows) // every * every
    found = np.full_like(rows, np.nan)
    found[every - 1 : n : every] = rows[:n].reshape(-1, every, 3).mean(axis=1)
    return found


def drawn(recording: Recording, *shape: int) -> Floats:
    """Normal deviates of the trial's own."""
    return np.random.default_rng(int(recording.name[:2])).standard_normal(shape)


def scale(trials: Trials) -> Iterator[Table]:
    def scaled(recording: Recording, share: float) -> Recording:
        return replace(recording, gyr=(1.0 + share) * recording.gyr)

    def misaligned(recording: Recording, share: float) -> Recording:
        return replace(recording, gyr=recording.gyr + share * recording.gyr @ drawn(recording, 3, 3).T)

    cases = {"as it is": trials}
    for label, of in (("of scale on all axes", scaled), ("in each of the 3 × 3, drawn", misaligned)):
        for percent in (1, 2, 3):
            cases[f"{percent} % {label}"] = changed(trials, partial(of, share=0.01 * percent))
    runs = RUNS | {"causal, initial_scale 0.02": causal(FLAGSHIP._replace(initial_scale=0.02))}
    yield compared("gyroscopes with scale errors and misalignments, all trials", cases, runs)


def drift(trials: Trials) -> Iterator[Table]:
    def drifting(recording: Recording, rate: float) -> Recording:
        direction = drawn(recording, 3)
        minutes = (recording.time - recording.time[0]) / 60.0
        off = np.radians(rate) * np.outer(minutes, direction / np.linalg.norm(direction))
        return replace(recording, gyr=recording.gyr + off)

    cases = {"as it is": trials}
    for rate in (0.1, 0.3, 1.0):
        cases[f"{rate:g} deg/s a minute"] = changed(trials, partial(drifting, rate=rate))
    runs = RUNS | {"causal, bias_walk 1e-3": causal(FLAGSHIP._replace(bias_walk=1e-3))}
    yield compared("a bias that drifts evenly, in a drawn direction, all trials", cases, runs)


SECTIONS: dict[str, Callable[[Trials], Iterator[Table]]] = {
    "driving": driving, "step": step, "held": held, "scale": scale, "drift": drift,
}  # fmt: skip

if __name__ == "__main__":
    main(SECTIONS, __doc__)
