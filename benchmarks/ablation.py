"""What the flagship does on the trials, what each of its parts is worth and where it ends: the figures on its page.

    python benchmarks/ablation.py [SECTION...]     all of them by default

trials        causal and offline on every trial, beside vqf
without       one part left out at a time
sensitivity   each parameter halved and doubled alone
late          the first seconds cut off, so that the start is nearer to motion or in it
moving        pieces that begin in motion
rates         block means of 3 and 6 samples
six           without magnetometer: inclination, and drift of the heading from the first row in motion
sigma         how sigma covers the errors about the Earth's axes, by what the sensor does
start         from an attitude 60° wrong in heading and 20° in tilt
lying         a step of the gyroscope's bias, beyond any rest, 4 s after the last motion of the chosen half
magnet        a magnet attached in the middle of a recording
field         where the local field points, seen from the reference, and the heading's constant error
instant       the attitude given out some milliseconds later or earlier
tried         the rate by trapezoids; windows of the way back; the length of a block
iron          a magnetometer that was never calibrated: hard iron from the start
dock          a start beside a magnet or steel, which then goes
accelerometer one that has gravity's length wrong, and one with a bias
made          made recordings of an inexpensive sensor, and of one with white noise only
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import poise
from poise.data.flags import HEADING_UNPROVEN, MAG_DISTURBED, REST
from poise.data.packet import Packet
from poise.data.recording import Recording
from poise.estimators.parameters import parameters
from poise.estimators.self_calibrating.covariance import forget
from poise.estimators.self_calibrating.model import ACC_DELAY, SENSOR
from poise.math import arrays
from poise.peers import PEERS
from poise.simulation import Sensor, Triad, forearm, measure, phone, robot
from regimes import Table, Trials, main
from scores import CHOSEN, halves
from studies import block_means
from tables import Cell

Floats = NDArray[np.float64]
Run = Callable[[Recording], poise.Attitude]
FLAGSHIP = poise.SelfCalibrating()
PLACE = ("log", "lead", "gravity", "declination", "gyr_range")  # what is no matter of tuning
ONLY_SIGMA = ("local_field", "level_error", "time_error")  # no attitude changes with them
HALVES = ("all", "chosen", "held-out")


def causal(method: Any = FLAGSHIP) -> Run:
    return lambda recording: poise.estimate(method, recording)


def offline(method: Any = FLAGSHIP) -> Run:
    return lambda recording: poise.smooth(recording, method)


def without_acc_delay(recording: Recording) -> poise.Attitude:
    """The accelerometer's delay held at 0; half a sampling interval is its sigma whatever the parameters say."""
    stream = poise.Stream(FLAGSHIP)
    first = int(np.searchsorted(recording.time, recording.time[0] + 2.5 * FLAGSHIP.block))
    parts = []
    for rows in (slice(0, first), slice(first, None)):
        r = recording[rows]
        parts.append(stream.update(Packet(r.time, r.gyr, r.acc, r.mag)))
        state = stream.running_state
        while hasattr(state, "inner"):
            state = state.inner
        forget(state.P, ACC_DELAY, 1, 0.0)
        state.P[SENSOR, 19] = 0.0
    flags, whole = np.concatenate([part.flags for part in parts]), np.concatenate([part.table for part in parts])
    return replace(parts[0], time=recording.time, table=whole, flags=flags)


RUNS: dict[str, Run] = {
    "causal": causal(),
    "offline": offline(),
    "vqf": PEERS["vqf"].attitude,
    "vqf-offline": PEERS["vqf-offline"].attitude,
}


def errors(run: Run, trials: Trials) -> dict[str, Floats]:
    """Total, heading and inclination RMSE of every trial, degrees."""
    return {name: np.array(poise.evaluate(run(r), r).rmse_deg()) for name, r in trials.items()}


def mean(found: Mapping[str, Floats], half: str = "all") -> Floats:
    return np.asarray(np.mean([found[name] for name in halves(found)[half]], axis=0))


def slashed(values: Floats, digits: int = 3) -> str:
    return "/".join(f"{v:.{digits}f}" for v in values)


def per_trial(trials: Trials) -> Iterator[Table]:
    found = {name: errors(run, trials) for name, run in RUNS.items()}
    rows: list[list[Cell]] = [[trial, *(slashed(e[trial], 2) for e in found.values())] for trial in trials]
    rows += [[f"mean, {half}", *(slashed(mean(e, half)) for e in found.values())] for half in HALVES]
    yield "total/heading/inclination RMSE, degrees", ["", *RUNS], rows


def without(trials: Trials) -> Iterator[Table]:
    left_out: dict[str, dict[str, float]] = {
        "all of it": {},
        "magnetometer's delay at the expected 8 ms": {"mag_delay_sigma": 0.0},
        "magnetometer's delay at 0": {"mag_delay_sigma": 0.0, "mag_delay": 0.0},
        "A": {"initial_scale": 0.0},
        "A, k 3 times larger": {"initial_scale": 0.0, "scale_noise": 3.0 * FLAGSHIP.scale_noise},
        "the bias's walk in motion": {"bias_walk": FLAGSHIP.bias_walk_rest},
        "the accelerometer's bias": {"initial_acc_bias": 0.0, "acc_bias_walk": 0.0},
        "the accelerometer's scale": {"initial_acc_scale": 0.0},
        "either": {"initial_acc_bias": 0.0, "acc_bias_walk": 0.0, "initial_acc_scale": 0.0},
        "noise by shocks": {"shock_noise": 0.0},
        "hard iron": {"initial_iron": 0.0, "iron_walk": 0.0},
        "hard iron's walk, but 1 % at the start": {"initial_iron": 0.01, "iron_walk": 0.0},
        "noise by specific force": {"motion_noise": 0.0},
        "noise by rate": {"scale_noise": 0.0},
        "the field's walk": {"field_walk": 0.0},
        "the magnetometer tilting while unsure": {"sure_tilt": 10.0},
        "keeping the tilt from it when sure": {"sure_tilt": 0.0},
    }
    rows: list[list[Cell]] = []
    for name, changed in left_out.items():
        method = FLAGSHIP._replace(**changed)
        a, b = errors(causal(method), trials), errors(offline(method), trials)
        cells = [slashed(mean(a)), *(float(mean(a, half)[0]) for half in HALVES[1:])]
        rows.append([name, *cells, slashed(mean(b)), *(float(mean(b, half)[0]) for half in HALVES[1:])])
    a = errors(without_acc_delay, trials)
    rows.insert(
        1, ["accelerometer's delay", slashed(mean(a)), *(float(mean(a, h)[0]) for h in HALVES[1:]), *[None] * 3]
    )
    columns = ["without", "causal", "chosen", "held-out", "offline", "chosen", "held-out"]
    yield "mean total/heading/inclination RMSE, and of the halves the total, degrees", columns, rows


def sensitivity(trials: Trials) -> Iterator[Table]:
    whole = float(mean(errors(causal(), trials))[0])
    rows: list[list[Cell]] = []
    for parameter in parameters(type(FLAGSHIP)):
        if parameter.kind is float and parameter.name not in PLACE + ONLY_SIGMA:
            changes = []
            for factor in (0.5, 2.0):
                method = FLAGSHIP._replace(**{parameter.name: factor * getattr(FLAGSHIP, parameter.name)})
                changes.append(100.0 * (float(mean(errors(causal(method), trials))[0]) / whole - 1.0))
            rows.append([parameter.name, *(f"{change:+.1f}" for change in changes)])
    yield f"causal, {whole:.3f}°: change of the mean total RMSE, %", ["", "halved", "doubled"], rows


def late(trials: Trials) -> Iterator[Table]:
    rows: list[list[Cell]] = []
    for seconds in (0.0, 1.0, 2.5, 5.0, 7.5, 10.0):
        cut = {name: r[int(np.searchsorted(r.time, r.time[0] + seconds)) :] for name, r in trials.items()}
        found = {name: errors(run, cut) for name, run in RUNS.items()}
        rows.append([f"{seconds:g} s", *(slashed(mean(e)) for e in found.values())])
    yield "the first seconds cut off: mean total/heading/inclination RMSE, degrees", ["", *RUNS], rows


def moving(trials: Trials) -> Iterator[Table]:
    """Pieces of 60 s that begin in motion, every 4 s of the six trials that turn or shake most of the time."""
    found: dict[str, list[list[float]]] = {name: [] for name in RUNS}
    spans = [(0.0, 3.0), (3.0, 6.0), (6.0, np.inf), (0.0, np.inf)]
    for name, whole in trials.items():
        if name[:2] not in ("01", "07", "09", "15", "21", "31"):
            continue
        assert whole.moving is not None
        begin, end = whole.time[whole.moving][[0, -1]]
        for cut in np.arange(begin + 3.0, end - 45.0, 4.0):
            piece = whole.between(cut, cut + 60.0)
            for run, made in RUNS.items():
                e = poise.evaluate(made(piece), piece)
                t, square = piece.time[e.counted] - cut, e.total[e.counted] ** 2
                parts = [square[(a <= t) & (t < b)] for a, b in spans]
                means = [float(np.degrees(np.sqrt(part.mean()))) if len(part) else np.nan for part in parts]
                found[run].append(means)
    labels = ["first 3 s", "3 to 6 s", "from 6 s on", "all", "all: median", "all: largest"]
    rows: list[list[Cell]] = [[label] for label in labels]
    for errors_ in found.values():
        e_ = np.array(errors_)
        cells = [*np.nanmean(e_, axis=0), np.nanmedian(e_[:, 3]), np.nanmax(e_[:, 3])]
        for row, cell in zip(rows, cells, strict=True):
            row.append(float(cell))
    n = len(next(iter(found.values())))
    yield f"{n} pieces of 60 s that begin in motion: mean of their total RMSE, degrees", ["", *RUNS], rows


def rates(trials: Trials) -> Iterator[Table]:
    rows: list[list[Cell]] = []
    for samples in (1, 3, 6):
        thinned = {name: block_means(r, samples) for name, r in trials.items()}
        found = [errors(run, thinned) for run in (*RUNS.values(), without_acc_delay)]
        rows.append([f"{285.7 / samples:.0f} Hz", *(slashed(mean(e)) for e in found)])
    columns = ["", *RUNS, "causal, no accelerometer's delay"]
    yield "block means: mean total/heading/inclination RMSE, degrees", columns, rows


def six(trials: Trials) -> Iterator[Table]:
    rows: list[list[Cell]] = []
    for name, recording in trials.items():
        row: list[Cell] = [name]
        for run in RUNS.values():
            attitude = run(replace(recording, mag=None))
            e = poise.evaluate(attitude, recording)
            assert recording.truth is not None
            turn = arrays.multiply(attitude.quat, arrays.conjugate(recording.truth.quat))[e.counted]
            drift = np.unwrap(2.0 * np.arctan2(turn[:, 3], turn[:, 0]))
            row += [e.rmse_deg().inclination, float(np.degrees(np.sqrt(np.mean((drift - drift[0]) ** 2))))]
        rows.append(row)
    rows.append(["mean", *(float(np.mean([row[i] for row in rows])) for i in range(1, len(rows[0])))])  # type: ignore[arg-type]
    columns = ["", *(f"{run}{what}" for run in RUNS for what in (" incl.", ", drift"))]
    yield (
        "without magnetometer: inclination RMSE and RMS drift of the heading from the first row in motion, degrees",
        columns,
        rows,
    )


def axis_errors(attitude: poise.Attitude, recording: Recording) -> Floats:
    """(n, 3) rad about the Earth's axes; NaN without reference."""
    assert recording.truth is not None
    turn = arrays.multiply(recording.truth.quat, arrays.conjugate(attitude.quat))
    found = np.full((len(turn), 3), np.nan)
    known = np.isfinite(turn).all(axis=1)
    found[known] = Rotation.from_quat(turn[known][:, [1, 2, 3, 0]]).as_rotvec()
    return found


def sigma(trials: Trials) -> Iterator[Table]:
    for label, run in (("causal", causal()), ("offline", offline())):
        ratios, kinds = [], []
        for recording in trials.values():
            attitude = run(recording)
            ratios.append(np.abs(axis_errors(attitude, recording)) / attitude.sigma)
            rest, fast = attitude.flags & REST != 0, np.linalg.norm(attitude.rate, axis=1) > 1.0
            disturbed = attitude.flags & MAG_DISTURBED != 0
            assert recording.moving is not None
            kinds.append(np.column_stack([recording.moving, rest, ~rest & ~fast, ~rest & fast, disturbed]))
        ratio, kind = np.concatenate(ratios), np.concatenate(kinds)
        known = np.isfinite(ratio).all(axis=1)
        rows: list[list[Cell]] = []
        for i, name in enumerate(("in motion by the reference", "REST", "below 1 rad/s", "above", "MAG_DISTURBED")):
            part = ratio[known & kind[:, i]]
            inside, median = 100.0 * np.mean(part < 3.0, axis=0), np.median(part, axis=0)
            rows.append([name, len(part), *inside.tolist(), *median.tolist()])
        columns = ["", "rows", "within 3σ: east %", "north %", "up %", "median error/σ: east", "north", "up"]
        yield f"{label}: sigma about the Earth's axes, all trials pooled", columns, rows


def start(trials: Trials) -> Iterator[Table]:
    rows: list[list[Cell]] = []
    wrong = Rotation.from_euler("ZX", [60.0, 20.0], degrees=True).as_quat()[[3, 0, 1, 2]]
    for name, recording in trials.items():
        row: list[Cell] = [name]
        assert recording.truth is not None and recording.moving is not None
        known = np.isfinite(recording.truth.quat).all(axis=1)
        for first in (np.argmax(known), np.argmax(known & recording.moving)):
            r = recording[int(first) :]
            assert r.truth is not None
            right = poise.estimate(FLAGSHIP, r, start=r.truth.quat[0])
            attitude = poise.estimate(FLAGSHIP, r, start=arrays.multiply(wrong, r.truth.quat[0]))
            apart = arrays.angle(arrays.multiply(attitude.quat, arrays.conjugate(right.quat)))
            far = np.flatnonzero(np.degrees(apart) > 2.0)
            row += [float(r.time[far[-1] + 1] - r.time[0]) if far[-1] + 1 < len(r) else None]
            row += [poise.evaluate(a, r).rmse_deg().total for a in (attitude, right)]
        rows.append(row)
    figures = ("s until within 2°", "total RMSE", "of the other")
    yield (
        "started 60° wrong in heading and 20° in tilt: s until within 2° of the run that starts right, for good; degrees",
        ["", *(f"{where}: {figure}" for where in ("at rest", "in motion") for figure in figures)],
        rows,
    )


def lying(trials: Trials) -> Iterator[Table]:
    rows: list[list[Cell]] = []
    for size in (3.0, 6.0):
        taken, apart = [], []
        for name, recording in trials.items():
            if int(name[:2]) not in CHOSEN:
                continue
            assert recording.moving is not None
            after = recording.time > recording.time[np.flatnonzero(recording.moving)[-1]] + 4.0
            clean = causal()(recording)
            for seed in range(12):
                direction = np.random.default_rng(seed).normal(size=3)
                off = np.radians(size) * direction / np.linalg.norm(direction)
                stepped = causal()(replace(recording, gyr=recording.gyr + off * after[:, None]))
                wrong = after & (np.linalg.norm(stepped.bias - clean.bias - off, axis=1) > np.radians(0.3))
                taken.append(float(np.ptp(recording.time[wrong])))
                turn = arrays.angle(arrays.multiply(stepped.quat, arrays.conjugate(clean.quat)))
                apart.append(float(np.degrees(turn[after]).max()))
        rows.append([f"{size:g} deg/s", *np.percentile(taken, [50, 90, 100]), *np.percentile(apart, [50, 100])])
    columns = ["", "s until the bias is right within 0.3 deg/s: median", "90 %", "longest"]
    columns += ["most the attitude is off by, degrees: median", "worst"]
    yield "a step of the bias while the sensor lies still, seven trials and twelve directions", columns, rows


def magnet(trials: Trials) -> Iterator[Table]:
    undisturbed = {name: r for name, r in trials.items() if "undisturbed" in name}
    rows: list[list[Cell]] = []
    for length in (0.0, 5.0, 10.0, 20.0, 40.0):
        found: dict[str, list[Floats]] = {name: [] for name in RUNS}
        for recording in undisturbed.values():
            after = recording.time >= recording.time[0] + 0.5 * recording.duration
            for axis in range(3) if length else range(1):
                assert recording.mag is not None and recording.moving is not None
                attached = replace(recording, mag=recording.mag + length * np.outer(after, np.eye(3)[axis]))
                judged = replace(recording, moving=recording.moving & after)
                for name, run in RUNS.items():
                    found[name].append(np.array(poise.evaluate(run(attached), judged).rmse_deg()))
        means = {name: np.mean(e, axis=0) for name, e in found.items()}
        worst = {name: max(float(v[0]) for v in e) for name, e in found.items()}
        rows.append([f"{length:g} µT", *(f"{slashed(m, 2)}, {worst[name]:.1f}" for name, m in means.items())])
    title = (
        "a magnet on body x, y or z from the middle on, undisturbed trials: RMSE after it, degrees, and largest total"
    )
    yield title, ["", *RUNS], rows


def accelerometer(trials: Trials) -> Iterator[Table]:
    """Real accelerometers made worse, on the undisturbed trials that turn."""
    names = [name for name in trials if "undisturbed" in name and "translation" not in name]
    worse: dict[str, Callable[[Floats], Floats]] = {
        "as it is": lambda acc: acc,
        **{f"times {factor:g}": partial(np.multiply, factor) for factor in (0.95, 0.97, 1.03, 1.05)},
        **{f"bias of {bias:g} m/s²": partial(np.add, bias * np.array([1.0, -1.0, 0.5])) for bias in (0.05, 0.1, 0.2)},
    }
    rows: list[list[Cell]] = []
    for case, of in worse.items():
        spoiled = {name: replace(trials[name], acc=of(trials[name].acc)) for name in names}
        found = {name: np.array(list(errors(run, spoiled).values())) for name, run in RUNS.items()}
        rows.append([case, *(f"{slashed(e.mean(axis=0), 2)}, {e[:, 0].max():.1f}" for e in found.values())])
    yield "accelerometers made worse, undisturbed trials that turn: RMSE, degrees, and largest total", ["", *RUNS], rows


def settled(attitude: poise.Attitude, other: poise.Attitude, recording: Recording) -> float:
    """Seconds of the recording in motion until *attitude* is within 5 degrees of the *other* for good."""
    assert recording.moving is not None
    begun = float(recording.time[recording.moving][0])
    off = np.flatnonzero(arrays.angle(arrays.multiply(attitude.quat, arrays.conjugate(other.quat))) > np.radians(5.0))
    return max(float(recording.time[off[-1]]) - begun, 0.0) if len(off) else 0.0


CORNERS = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]) / np.sqrt(3.0)  # of a tetrahedron


def iron(trials: Trials) -> Iterator[Table]:
    """Hard iron on the sensor, from the first row to the last."""
    strengths = (0.0, 5.0, 10.0, 20.0, 40.0, 80.0)
    cases = {f"{strength:g} µT": (strength, 0.0, inf) for strength in strengths}
    yield from beside(trials, "hard iron from the start", cases, RUNS | {"causal, as the doctor advises": as_advised})


def dock(trials: Trials) -> Iterator[Table]:
    """A magnet, or steel, beside the sensor for the first seconds of its rest, which then goes; or one that comes then."""
    cases = {f"{s:g} s, {strength:g} µT": (strength, 0.0, s) for s in (5.0, 20.0) for strength in (10.0, 20.0, 40.0)}
    yield from beside(trials, "another field for the first seconds", cases, RUNS)
    cases = {f"{strength:g} µT": (strength, 15.0, inf) for strength in (10.0, 20.0, 40.0)}
    yield from beside(trials, "a magnet attached after 15 s, at rest", cases, RUNS)


def beside(
    trials: Trials, what: str, cases: dict[str, tuple[float, float, float]], runs: dict[str, Run]
) -> Iterator[Table]:
    """What *cases* (µT, from and until s) in four directions, fixed to the sensor, make of the undisturbed trials."""
    undisturbed = {name: recording for name, recording in trials.items() if "undisturbed" in name}
    for label, moved in (("that turn", False), ("that only move", True)):
        chosen = [recording for name, recording in undisturbed.items() if ("translation" in name) is moved]
        calibrated = [poise.estimate(FLAGSHIP, recording) for recording in chosen]
        rows: list[list[Cell]] = []
        times: list[list[Cell]] = []
        for case, (strength, first, last) in cases.items():
            found: dict[str, list[Floats]] = {name: [] for name in (*runs, "causal, second half")}
            within: dict[str, list[Floats]] = {"first half": [], "second half": [], "offline": []}
            told: dict[str, list[Floats]] = {"of those outside, causal": [], "offline": []}
            flagged: list[Floats] = []
            seconds = []
            for recording, other in zip(chosen, calibrated, strict=True):
                assert recording.mag is not None and recording.moving is not None
                since = recording.time - recording.time[0]
                later = since >= 0.5 * recording.duration
                for corner in CORNERS if strength else CORNERS[:1]:
                    given_to = replace(
                        recording, mag=recording.mag + np.outer((since >= first) & (since < last), strength * corner)
                    )
                    given = {name: run(given_to) for name, run in runs.items()}
                    for name, attitude in given.items():
                        found[name].append(np.array(poise.evaluate(attitude, recording).rmse_deg()))
                    half = replace(recording, moving=recording.moving & later)
                    found["causal, second half"].append(np.array(poise.evaluate(given["causal"], half).rmse_deg()))
                    seconds.append(settled(given["causal"], other, recording))
                    for name, attitude, part in (
                        ("first half", given["causal"], ~later),
                        ("second half", given["causal"], later),
                        ("offline", given["offline"], later | ~later),
                    ):
                        ratio = np.abs(axis_errors(attitude, recording)[:, 2]) / attitude.sigma[:, 2]
                        within[name].append(ratio[part & recording.moving & np.isfinite(ratio)] < 3.0)
                    for name, of in zip(told, ("causal", "offline"), strict=True):
                        attitude = given[of]
                        wrong = np.abs(axis_errors(attitude, recording)[:, 2]) > 3.0 * attitude.sigma[:, 2]
                        told[name].append(unproven(attitude)[wrong & recording.moving])
                    flagged.append(unproven(given["causal"])[recording.moving])
            cells = [f"{slashed(np.mean(e, axis=0), 2)}, {max(float(v[0]) for v in e):.1f}" for e in found.values()]
            rows.append([case, *cells])
            shares = [100.0 * float(np.mean(np.concatenate(part))) for part in within.values()]
            flags = [100.0 * float(np.mean(rows)) if len(rows) else "-" for rows in map(np.concatenate, told.values())]
            all_flags = 100.0 * float(np.mean(np.concatenate(flagged)))
            times.append([case, float(np.median(seconds)), max(seconds), *shares, all_flags, *flags])
        title = f"{what}, in four directions, undisturbed trials {label}"
        yield f"{title}: RMSE, degrees, and largest total", ["", *found], rows
        columns = ["", "median", "longest", *(f"% within 3 sigma about up: {name}" for name in within)]
        columns += ["% unproven, causal", *(f"% unproven {name}" for name in told)]
        yield f"{title}: s in motion until within 5 degrees of the calibrated, and sigma", columns, times


def unproven(attitude: poise.Attitude) -> NDArray[np.bool_]:
    """Rows that say that iron may turn their heading."""
    return np.asarray((attitude.flags & np.uint32(HEADING_UNPROVEN)) != 0)


def field(trials: Trials) -> Iterator[Table]:
    rows: list[list[Cell]] = []
    for name, recording in trials.items():
        assert recording.truth is not None and recording.mag is not None and recording.moving is not None
        known = np.isfinite(recording.truth.quat).all(axis=1) & recording.moving
        seen = arrays.rotate(recording.truth.quat[known], recording.mag[known])
        n = round(20.0 * recording.rate_hz)
        means = seen[: len(seen) // n * n].reshape(-1, n, 3).mean(axis=1)
        off = np.degrees(np.arctan2(means[:, 0], means[:, 1]))
        row: list[Cell] = [name, *np.percentile(off, [10, 50, 90]).tolist()]
        for run in (causal(), offline()):
            up = np.degrees(axis_errors(run(recording), recording)[known, 2])
            row += [float(np.mean(up)), float(np.sqrt(np.mean((up - np.mean(up)) ** 2)))]
        rows.append(row)
    columns = ["", "field east of north: 10 %", "median", "90 %", "causal error about up: mean", "rms about it",
               "offline: mean", "rms about it"]  # fmt: skip
    yield "means of the field over 20 s in the reference's frame, degrees, and truth − attitude about up", columns, rows


def instant(trials: Trials) -> Iterator[Table]:
    rows: list[list[Cell]] = []
    for lead in (-4e-3, -2e-3, 0.0, 2e-3, 4e-3, 6e-3):
        found = errors(causal(FLAGSHIP._replace(lead=lead)), trials)
        rows.append([f"{1e3 * lead:+g} ms", slashed(mean(found)), *(float(e[2]) for e in found.values())])
    columns = ["lead", "mean", *(name[:2] for name in trials)]
    yield "causal: mean total/heading/inclination RMSE, and inclination by trial, degrees", columns, rows


def tried(trials: Trials) -> Iterator[Table]:
    def trapezoids(r: Recording) -> Recording:
        return replace(r, gyr=np.concatenate([r.gyr[:1], 0.5 * (r.gyr[:-1] + r.gyr[1:])]))

    rows: list[list[Cell]] = []
    for samples in (1, 3, 6):
        thinned = {name: block_means(r, samples) for name, r in trials.items()}
        by_trapezoid = {name: trapezoids(r) for name, r in thinned.items()}
        cells = [slashed(mean(errors(causal(), t))) for t in (thinned, by_trapezoid)]
        rows.append([f"{285.7 / samples:.0f} Hz", *cells])
    yield "the rate by rectangles and by trapezoids: mean RMSE, degrees", ["", "rectangles", "trapezoids"], rows

    rows = []
    whole = {name: poise.smooth(r, window=1e9) for name, r in trials.items()}
    for window, overlap in ((600.0, 200.0), (60.0, 200.0), (60.0, 120.0), (60.0, 60.0), (60.0, 30.0), (60.0, 0.0)):
        apart, found = [], {}
        for name, r in trials.items():
            attitude = poise.smooth(r, window=window, overlap=overlap)
            turn = arrays.multiply(attitude.quat, arrays.conjugate(whole[name].quat))
            apart.append(float(np.degrees(np.nanmax(arrays.angle(turn)))))
            found[name] = np.array(poise.evaluate(attitude, r).rmse_deg())
        rows.append([f"{window:g} s, {overlap:g} s", max(apart), slashed(mean(found))])
    yield "window and overlap of the way back", ["", "largest distance from one window, °", "mean RMSE, °"], rows

    rows = []
    for block in (0.02, 0.04, 0.08, 0.12, 0.16):
        method = FLAGSHIP._replace(block=block)
        rows.append(
            [f"{1e3 * block:g} ms", *(slashed(mean(errors(r, trials))) for r in (causal(method), offline(method)))]
        )
    yield "length of a block: mean RMSE, degrees", ["", "causal", "offline"], rows


TYPICAL = Sensor()
NOISE = Sensor(gyr=Triad(TYPICAL.gyr.noise), acc=Triad(TYPICAL.acc.noise), mag=Triad(TYPICAL.mag.noise), mag_delay=0.0)


def as_advised(recording: Recording) -> poise.Attitude:
    """With the initial_iron that `poise doctor` tells, where it tells one."""
    told = " ".join(finding.sentence for finding in poise.diagnose(recording).findings)
    advice = re.search(r"initial_iron=([0-9.]+)", told)
    return poise.estimate(FLAGSHIP._replace(initial_iron=float(advice[1])) if advice else FLAGSHIP, recording)


def made(trials: Trials) -> Iterator[Table]:
    del trials
    iron = FLAGSHIP._replace(initial_iron=0.03)
    runs = RUNS | {"causal, initial_iron 0.03": causal(iron), "offline, initial_iron 0.03": offline(iron)}
    runs["causal, as the doctor advises"] = as_advised
    for label, sensor in (("an inexpensive sensor", TYPICAL), ("white noise only", NOISE)):
        rows: list[list[Cell]] = []
        for motion in (forearm, phone, robot):
            found: dict[str, list[Floats]] = {name: [] for name in runs}
            for seed in range(6):
                recording = measure(motion(120.0, 100.0, seed), sensor, seed=seed)
                for name, run in runs.items():
                    found[name].append(np.array(poise.evaluate(run(recording), recording).rmse_deg()))
            cells = [f"{slashed(np.mean(e, axis=0), 2)}, {max(float(v[0]) for v in e):.1f}" for e in found.values()]
            rows.append([motion.__name__, *cells])
        title = f"{label}, six made recordings of 120 s each: mean total/heading/inclination RMSE, degrees, and largest total"
        yield title, ["", *runs], rows


SECTIONS: dict[str, Callable[[Trials], Iterator[Table]]] = {
    "trials": per_trial, "without": without, "sensitivity": sensitivity, "late": late, "moving": moving, "rates": rates,
    "six": six, "sigma": sigma, "start": start, "lying": lying, "magnet": magnet, "iron": iron, "dock": dock,
    "accelerometer": accelerometer, "field": field, "instant": instant, "tried": tried, "made": made,
}  # fmt: skip

if __name__ == "__main__":
    main(SECTIONS, __doc__)
