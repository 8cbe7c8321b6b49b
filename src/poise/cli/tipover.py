"""``poise tipover``: what a tip-over monitor would have said of recordings."""

from __future__ import annotations

from collections.abc import Callable
from math import degrees, isfinite, isnan
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from poise.cli import show
from poise.cli.options import Reading, Running
from poise.cli.targets import PICTURES, distinct, targets
from poise.cli.watching import Watching
from poise.cli.words import UsageError, usage
from poise.errors import FormatError

if TYPE_CHECKING:
    from poise.data.event import TipEvent
    from poise.data.recording import Recording
    from poise.monitor import Alarm, DryRun, Judgement, TipOver

_NEARLY_ALL = 0.99  # of the time: a method settles first
_MOST = 40  # events of a file that are printed


def tipover(
    files: Annotated[list[Path], Parameter(name="FILE", negative="")],
    /,
    *,
    report: Annotated[bool, Parameter(negative="")] = False,
    falls: str | None = None,
    plot: Path | None = None,
    json: Annotated[bool, Parameter(negative="")] = False,
    reading: Reading | None = None,
    running: Running | None = None,
    watching: Watching | None = None,
) -> int:
    """Tell from recordings what a tip-over monitor would have triggered, and when: a dry run.

    Each FILE is a recording, which is estimated first, or an attitude that poise wrote (then free fall and picking up are
    not told from a fall: the specific force is not in it). The robot's axes are x right, y forward, z up; --mount and
    --tare say how the sensor sits on it.

    Whether an alarm was right is told where the truth is known: by a reference in the recording, or by --falls. What could
    not be judged is said; exit code 1 where nothing of a FILE could be.

    Examples: `poise tipover drive.csv --report --falls none`; `poise tipover log.csv -m tilt --range 15 --tare 0,5
    --plot moment.png`; `poise tipover logs/*.csv --config robot.toml --json`

    Parameters
    ----------
    files
        Recordings, or attitudes written by poise.
    report
        Print the alarms with their lead before the ground, falls that were missed, false alarms per hour, and how long each
        state lasted.
    falls
        When the robot hit the ground, in seconds on the recording's clock: `--falls 12.3,80`; `none` where it never did.
    plot
        A picture (.png, .svg, .pdf) of the moment: the first alarm, or where the least was left; a folder for several FILEs.
    json
        Print everything as JSON.
    """
    reading, running, watching = reading or Reading(), running or Running(), watching or Watching()
    try:
        running.build()
        reading.as_arguments()
        parameters = watching.build()
        grounds = _falls(falls)
        pictures = targets(files, plot, ".tipover.png", PICTURES, "--plot") if plot else {}
        distinct(files)

        def work(file: Path, tell: Callable[[str, float], None]) -> dict[str, Any]:
            return _watched(file, grounds, pictures.get(file), reading, running, watching, parameters, tell)

        running.warm()
        results, refused = show.each(files, work)
        _check_falls(grounds, results)
        unjudged = _unjudged(results)
        refused += unjudged
    except UsageError as error:
        show.problem(error)
        return 2
    except FormatError as error:
        show.problem(error)
        return 1
    if json:
        show.as_json({"results": [_document(result) for result in results], "errors": refused})
    elif results:
        _tell(results, report)
    for each in unjudged:
        show.problem(f"{each['file']}: {each['error']}")
    return 1 if refused else 0


def _unjudged(results: list[dict[str, Any]]) -> list[dict[str, str]]:
    """The files of which nothing was judged: that no alarm came of them says nothing."""
    return [
        {
            "file": str(result["file"]),
            "error": f"nothing was judged: in no row is the attitude known ({result['unknown_because']}); "
            "poise doctor shows what is wrong with the samples",
        }
        for result in results
        if not result["judgement"].judged.any()
    ]


def _falls(text: str | None) -> list[float] | None:
    if text is None:
        return None
    if text.strip().lower() == "none":
        return []
    try:
        found = [float(part) for part in text.split(",")]
    except ValueError:
        found = []
    if not found or not all(map(isfinite, found)):
        usage(f"--falls {text!r}: expected seconds such as 12.3,80, or none")
    return found


def _check_falls(grounds: list[float] | None, results: list[dict[str, Any]]) -> None:
    """A fall outside of every recording would make each right alarm a false one."""
    import numpy as np

    times = {result["file"].name: result["judgement"].time for result in results}
    known = {name: time[np.isfinite(time)] for name, time in times.items()}
    spans = {name: (float(time.min()), float(time.max())) for name, time in known.items() if len(time)}
    for ground in grounds or ():
        if spans and not any(start <= ground <= end for start, end in spans.values()):
            lasts = ", ".join(f"{name} lasts from {start:z.2f} to {end:z.2f} s" for name, (start, end) in spans.items())
            usage(f"--falls {ground:g}: {lasts}")


def _watched(
    file: Path,
    grounds: list[float] | None,
    picture: Path | None,
    reading: Reading,
    running: Running,
    watching: Watching,
    parameters: TipOver,
    tell: Callable[[str, float], None],
) -> dict[str, Any]:
    from poise.data.attitude import Attitude
    from poise.errors import RecordingError
    from poise.monitor import dry_run, judge, why_unknown

    tell("reading", 0.0)
    found = reading.read_either(file)
    recording: Recording | None = None
    if isinstance(found, Attitude):
        running.means_nothing_to(file)
        attitude = found
    else:
        recording = found
        tell("estimating (a first run compiles the method)", 0.3)
        attitude = running.estimate(recording)
    if not len(attitude):
        raise RecordingError("has no rows, so there is nothing to judge")
    tell("judging", 0.8)
    judgement = judge(attitude, recording, watching.tared(parameters, attitude))
    truth = recording.truth if recording is not None and grounds is None else None
    outcome = dry_run(judgement, grounds if grounds is not None else truth, recording)
    if picture:
        from poise.plots import save_figure, tip_over_figure

        save_figure(tip_over_figure(judgement, recording, title=file.stem, method=attitude.provenance.method), picture)
    return {
        "file": file,
        "method": attitude.provenance.method,
        "judgement": judgement,
        "outcome": outcome,
        "valid": float(attitude.valid.mean()),
        "unknown_because": why_unknown(judgement, ~judgement.judged),
        "force": recording is not None,
        "plot": picture,
    }


def _document(result: dict[str, Any]) -> dict[str, Any]:
    judgement: Judgement = result["judgement"]
    outcome: DryRun = result["outcome"]
    known = outcome.falls is not None
    margin, at = _closest(judgement)
    return {
        "file": result["file"],
        "method": result["method"],
        "plot": result["plot"],
        "rows": len(judgement),
        "valid": result["valid"],
        "judged": _share(judgement),
        "seconds": {state.name.lower(): seconds for state, seconds in judgement.seconds().items()},
        "events": [_event(event) for event in judgement.events],
        "alarms": [
            _event(alarm.event)
            | {"ground": alarm.ground, "lead": alarm.lead, "true": alarm.true}
            | {"lead_at_least": alarm.at_least, "lead_unknown": alarm.doubt or None}
            for alarm in outcome.alarms
        ],
        "falls": [vars(fall) for fall in outcome.falls or []] if known else None,
        "missed": [vars(fall) for fall in outcome.missed] if known else None,
        "false_per_hour": outcome.false_per_hour,
        "hours_known": outcome.hours,
        "least_margin_deg": margin,
        "least_margin_at": at,
        "mount_wxyz": list(judgement.tipover.mount),
    }


def _share(judgement: Judgement) -> float:
    """How much of the time was judged; of the rows, where these have no time."""
    from poise.data.event import TipState

    seconds = judgement.seconds()
    whole = sum(seconds.values())
    return 1.0 - seconds[TipState.UNKNOWN] / whole if whole > 0.0 else float(judgement.judged.mean())


def _event(event: TipEvent) -> dict[str, Any]:
    return {
        "time": event.time,
        "state": event.state.name.lower(),
        "before": event.before.name.lower(),
        "direction": event.direction,
        "tilt_deg": degrees(event.tilt),
        "rate_deg_s": degrees(event.rate),
        "time_to_impact": event.time_to_impact,
        "reason": event.reason,
    }


def _closest(judgement: Judgement) -> tuple[float, float]:
    """The least margin in degrees and its time, s; NaN where no row is known."""
    import numpy as np

    if not np.isfinite(judgement.margin).any():
        return float("nan"), float("nan")
    row = int(np.nanargmin(judgement.margin))
    return degrees(float(judgement.margin[row])), float(judgement.time[row])


def _tell(results: list[dict[str, Any]], report: bool) -> None:
    rows = []
    for result in results:
        outcome: DryRun = result["outcome"]
        margin, at = _closest(result["judgement"])
        said = [len(result["judgement"].events), len(outcome.alarms), margin, at]
        share = _share(result["judgement"])
        known = _verdict(outcome) if result["judgement"].judged.any() else ["not judged"] * 2 + [float("nan")]
        rows.append([result["file"].name, result["method"], f"{share:.1%}", *said, *known])
    columns = [
        "file",
        "method",
        "judged",
        "events",
        "alarms",
        "least margin °",
        "at s",
        "falls",
        "missed",
        "false alarms/h",
    ]
    show.table("Tip-over monitor: dry run", columns, rows)
    for result in results:
        _tell_events(result)
        if report:
            _tell_alarms(result)
    if report:
        lasted = [result["judgement"].seconds() for result in results]
        states = [state for state in lasted[0] if any(seconds[state] > 0.0 for seconds in lasted)]
        rows = [[r["file"].name, *(s[state] for state in states)] for r, s in zip(results, lasted, strict=True)]
        show.table("How long it was in each state, s", ["file", *(state.name.lower() for state in states)], rows)
    for result in results:
        if 0.0 < (share := _share(result["judgement"])) < _NEARLY_ALL:
            show.note(
                f"{result['file'].name}: {1.0 - share:.1%} of it was not judged, and no alarm could come there: the attitude "
                f"is not known ({result['unknown_because']})"
            )
        if not result["force"]:
            show.note(
                f"{result['file'].name}: an attitude without specific force: free fall and picking up are not told"
            )
        if result["plot"]:
            show.note(f"{result['file'].name}: picture in {result['plot']}")


def _verdict(outcome: DryRun) -> list[Any]:
    if outcome.falls is None:
        return ["not known", "not known", float("nan")]
    return [str(len(outcome.falls)), str(len(outcome.missed)), outcome.false_per_hour]


def _tell_events(result: dict[str, Any]) -> None:
    events = result["judgement"].events
    rows = [
        [event.time, event.state.name.lower(), event.direction or "-", event.time_to_impact, event.reason]
        for event in events
    ]
    if rows:
        columns = ["at s", "state", "direction", "impact in s", "why"]
        show.table(f"{result['file'].name}: what would have been told", columns, rows[:_MOST])
    if len(rows) > _MOST:
        show.note(f"{result['file'].name}: {len(rows) - _MOST} more; --json has all")


def _lead(alarm: Alarm) -> str:
    if alarm.true is False:
        return "-"
    if isnan(alarm.lead):
        return f"at least {alarm.at_least:.2f}" if isfinite(alarm.at_least) else "not known"
    return f"{alarm.lead:.2f}"


def _tell_alarms(result: dict[str, Any]) -> None:
    outcome: DryRun = result["outcome"]
    name = result["file"].name
    words = {True: "a fall", False: "false", None: "not known"}
    alarms = [
        [alarm.event.time, alarm.event.direction or "-", alarm.ground, _lead(alarm), words[alarm.true]]
        for alarm in outcome.alarms
    ]
    if alarms:
        by = "the attitude judged" if outcome.falls is None else "the truth"
        columns = ["alarm at s", "direction", "ground at s", "lead s", "was"]
        show.table(f"{name}: alarms; the ground as {by} has it", columns, alarms[:_MOST])
    elif result["judgement"].judged.any():
        show.note(f"{name}: no alarm")
    for alarm in outcome.alarms[:_MOST]:
        if alarm.doubt and alarm.true is not True:
            show.note(
                f"{name}: alarm at {alarm.event.time:.2f} s, lead not known, the ground was not seen: {alarm.doubt}"
            )
    for fall in outcome.missed[:_MOST]:
        show.note(f"{name}: missed: a fall at {fall.ground if isnan(fall.start) else fall.start:.2f} s")
