"""``poise estimate``: recordings in, attitudes out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import degrees, inf
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from poise.cli import show
from poise.cli.options import Reading, Running
from poise.cli.targets import PICTURES, really, targets
from poise.cli.validity import WORTH_SAYING, none_valid, validity
from poise.cli.words import UsageError, usage
from poise.errors import FormatError

if TYPE_CHECKING:
    from poise.data.attitude import Attitude
    from poise.data.recording import Recording

_LARGE_IRON = 0.04  # of the field: what is pointed out
_WRITABLE = (".parquet", ".csv", ".tum", ".txt", ".bag", ".mcap")
_ROS = ("bag", "mcap", "ros2")
_OVER_TIME = (".csv", ".parquet", *PICTURES)
_READABLE = {  # factor and unit to print a quantity in, and how many digits behind the point
    "gyr_bias": (degrees(1.0), "deg/s", 4),
    "gyr_scale": (100.0, "%", 3),
    "acc_delay": (1e3, "ms", 2),
    "acc_bias": (1.0, "m/s²", 4),
    "acc_scale": (100.0, "%", 3),
    "mag_delay": (1e3, "ms", 2),
}
_Format = Literal["parquet", "csv", "tum", "bag", "mcap", "ros2"]


def estimate(
    files: Annotated[list[Path], Parameter(name="FILE", negative="")],
    /,
    *,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    format: _Format | None = None,
    plot: Path | None = None,
    frame: Literal["enu", "ned", "nwu"] = "enu",
    learned: Annotated[bool, Parameter(negative="")] = False,
    learned_over_time: Path | None = None,
    learned_every: float | None = None,
    save_learned: Path | None = None,
    json: Annotated[bool, Parameter(negative="")] = False,
    reading: Reading | None = None,
    running: Running | None = None,
) -> int:
    """Turn recordings into attitudes: the main job.

    Reads gyroscope, accelerometer and magnetometer samples, estimates the orientation after every one of them and writes
    it beside its rate, bias, uncertainty and flags: for each FILE, `NAME.attitude.parquet` in the current folder.

    Files above 64 MiB (`--limit whole=…`) are read, estimated and written in chunks, in a memory that does not grow. Where
    such a run is killed, the same command goes on from what it wrote, which stands in `OUTPUT.partial` until all is done.

    Quaternions are w x y z and turn sensor axes into Earth axes (east, north, up) unless --frame says otherwise.

    Examples: `poise estimate walk.csv --plot walk.png`; `poise estimate logs/*.csv -m adaptive-gain -o results/`;
    `poise estimate log.txt --columns time,gx,gy,gz,ax,ay,az --units gyr=deg/s,acc=g -o walk.csv`

    Parameters
    ----------
    files
        Recordings: CSV, TSV, Parquet, npz or MATLAB files or ROS bags, recognised by their content.
    output
        A file (.parquet, .csv, .tum for a trajectory in TUM text, .bag or .mcap for sensor_msgs/Imu messages) for one
        FILE, or a folder that is there for any number.
    format
        What to write where the output is a folder; `ros2` makes `NAME.attitude` there, the folder of a ROS 2 bag.
    plot
        A picture of the attitude (.png, .svg, .pdf); a folder for several FILEs.
    frame
        The Earth frame to write: east-north-up, north-east-down or north-west-up.
    learned
        Print what the method found out about the sensors: bias, scale, hard iron, delays (self-calibrating only).
    learned_over_time
        The same as it was known over time: a table (.csv, .parquet) or a picture (.png, .svg, .pdf); a folder for several.
    learned_every
        Seconds between the rows of that table; 1 if not given.
    save_learned
        Keep what was learned (.json) for --start-from of the next recording of that sensor; a folder for several.
    json
        Print the summary as JSON.
    """
    reading, running = reading or Reading(), running or Running()
    try:
        running.build()
        reading.as_arguments()
        outputs = targets(files, output, _ending(output, format), _WRITABLE, "--output")
        if frame != "enu" and any(_is_ros(target, format) for target in outputs.values()):
            usage(f"--frame {frame}: an orientation in a ROS bag is body to east-north-up (REP 103); leave --frame out")
        pictures = targets(files, plot, ".attitude.png", PICTURES, "--plot") if plot else {}
        running.before()
        if (learned_over_time or save_learned) and not hasattr(running.build(), "learned"):
            usage(f"{running.method} learns nothing about the sensors; take --method self-calibrating")
        if learned_every is not None and learned_over_time is None:
            usage("--learned-every goes with --learned-over-time FILE, the table that it is of")
        every = 1.0 if learned_every is None else learned_every
        if not 0.0 < every < inf:
            usage(f"--learned-every {learned_every}: expected seconds above 0")
        over_time = "--learned-over-time"
        tables = targets(files, learned_over_time, ".learned.csv", _OVER_TIME, over_time) if learned_over_time else {}
        kept = targets(files, save_learned, ".learned.json", (".json",), "--save-learned") if save_learned else {}
        _apart(outputs, pictures, tables, kept)

        def work(file: Path, tell: Callable[[str, float], None]) -> dict[str, Any]:
            from poise.cli import long

            tell("reading", 0.0)
            kind = format or outputs[file].suffix.lower().lstrip(".").replace("txt", "tum")
            if file not in tables and long.suits(file, reading, running, kind):
                result = long.estimate(file, outputs[file], kind, frame, pictures.get(file), reading, running, tell)
                result["doubts"] = running.doubts(result["learned"])
                return result | {"learned_over_time": None} | _keep(result["learned"], kept.get(file))
            recording = reading.read(file)
            tell("estimating (a first run compiles the method)", 0.2)
            n = max(len(recording), 1)
            attitude = running.estimate(
                recording,
                progress=lambda done: tell("estimating", 0.2 + 0.6 * done / n),
                learning=every if tables else None,
            )
            result = _finished(
                file, recording, attitude.to(frame), outputs[file], format, pictures.get(file), running.offline, tell
            )
            result["doubts"] = running.doubts(attitude.learned)
            over_time = _draw_or_write(attitude, recording, tables.get(file))
            return result | over_time | _keep(attitude.learned, kept.get(file))

        running.warm()
        results, refused = show.each(files, work)
    except UsageError as error:
        show.problem(error)
        return 2
    except FormatError as error:
        show.problem(error)
        return 1
    useless = none_valid(results, "output")
    refused += useless
    if json:
        show.as_json({"method": running.method, "results": results, "errors": refused})
    elif results:
        _report(results, running.method)
        if learned:
            _report_learned(results, running.method)
    for each in useless:
        show.problem(f"{each['file']}: {each['error']}")
    return 1 if refused else 0


def _finished(
    file: Path,
    recording: Recording,
    attitude: Attitude,
    target: Path,
    format: _Format | None,
    picture: Path | None,
    offline: bool,
    tell: Callable[[str, float], None],
) -> dict[str, Any]:
    """Write the attitude and its picture; the line of the summary."""
    from poise.cli.proof import HeadingProof
    from poise.estimators import judged_by
    from poise.evaluation import evaluate
    from poise.formats import write

    tell("writing", 0.8)
    write(attitude, target, format, recording=recording)
    errors = evaluate(attitude, recording) if recording.truth is not None else None
    if picture:
        from poise.plots import attitude_figure, save_figure

        tell("drawing", 0.9)
        save_figure(attitude_figure(attitude, recording, errors, title=recording.name), picture)
    proof = HeadingProof()
    proof.add(recording, attitude)
    return {
        "file": str(file),
        "output": str(target),
        "plot": str(picture) if picture else None,
        "rows": len(recording),
        "seconds": recording.duration,
        "rate_hz": recording.rate_hz,
        **validity(attitude),
        "heading": attitude.heading_reference,
        "heading_unproven": proof.unproven,
        "frame": attitude.frame,
        "error_deg": errors.rmse_deg()._asdict() if errors else None,
        "judged_by": judged_by(attitude.provenance.method) if errors else None,
        "learned": attitude.learned,
        "notes": [
            *recording.notes,
            *proof.notes(offline),
            *(_iron_from_the_start(attitude.learned) if offline else ()),
        ],
    }


def _iron_from_the_start(learned: Any) -> list[str]:
    """Of a recording gone over both ways: a hard iron that was known from the first row on, if it is a large one."""
    import numpy as np

    if not learned or "hard_iron" not in learned:
        return []
    iron, field = (float(np.linalg.norm(learned[name]["value"])) for name in ("hard_iron", "field"))
    if not iron >= _LARGE_IRON * field > 0.0:
        return []
    return [
        f"a hard iron on the sensor of {iron / field:.0%} of the field is taken off from the first row on; --learned tells it"
    ]


def _keep(learned: Any, kept: Path | None) -> dict[str, Any]:
    """Write what was learned by the end; where it went."""
    from poise.formats import write

    if kept and learned is not None:
        write(learned, kept)
    return {"learned_saved": kept and str(kept)}


def _draw_or_write(attitude: Attitude, recording: Recording, over_time: Path | None) -> dict[str, Any]:
    """What was learned over time as a picture or a table; where it went."""
    from poise.formats import write

    if over_time and attitude.learning is not None:
        if over_time.suffix.lower() in PICTURES:
            from poise.plots import learning_figure, save_figure

            save_figure(learning_figure(attitude.learning, title=recording.name), over_time)
        else:
            write(attitude.learning, over_time)
    return {"learned_over_time": over_time and str(over_time)}


def _apart(*places: Mapping[Path, Path]) -> None:
    """Raises :class:`UsageError` where two results would be written to one file."""
    taken: set[Path] = set()
    for place in (place for each in places for place in each.values()):
        if really(place) in taken:
            usage(f"two results would both be written to {place}; give them two names")
        taken.add(really(place))


def _report(results: list[dict[str, Any]], method: str) -> None:
    from poise.estimators import judged_by

    judged, with_truth = judged_by(method), any(result["error_deg"] for result in results)
    columns = ["file", "s", "Hz", "rows", "valid", "heading", "written to"]
    rows = []
    for result in results:
        row = [
            Path(result["file"]).name,
            result["seconds"],
            result["rate_hz"],
            result["rows"],
            f"{result['valid']:.1%}",
            result["heading"],
            result["output"],
        ]
        if with_truth:
            row.append(result["error_deg"][judged] if result["error_deg"] else float("nan"))
        rows.append(row)
    show.table(f"{method}: attitudes", columns + [f"{judged} error °"] * with_truth, rows)
    for result in results:
        if 0 < result["valid"] < WORTH_SAYING:
            show.note(
                f"{Path(result['file']).name}: only {result['valid']:.1%} of the rows are valid; "
                "the flags say why: poise.read_attitude(output).reasons()"
            )
        for text in result["notes"]:
            show.note(f"{Path(result['file']).name}: {text}")
        for text in result["doubts"]:
            show.note(f"{Path(result['file']).name}: was --start-from of another sensor? {text}")
        for what, key in (
            ("picture", "plot"),
            ("over time", "learned_over_time"),
            ("what was learned", "learned_saved"),
        ):
            if result[key]:
                show.note(f"{Path(result['file']).name}: {what} in {result[key]}")


def _report_learned(results: list[dict[str, Any]], method: str) -> None:
    for result in results:
        name = Path(result["file"]).name
        if result["learned"] is None:
            show.note(f"{name}: {method} learns nothing about the sensors that it could tell; take self-calibrating")
            continue
        rows = []
        for what, found in result["learned"].items():
            factor, unit, digits = _READABLE.get(what, (1.0, found["unit"], 2))
            rows.append([what, *(_numbers(found[key], factor, digits) for key in ("value", "sigma")), unit])
        show.table(f"{name}: learned", ["", "value", "sigma", "unit"], rows)


def _numbers(values: Any, factor: float, digits: int) -> str:
    if isinstance(values, list):
        between = "; " if values and isinstance(values[0], list) else " "
        return between.join(_numbers(value, factor, digits) for value in values)
    return f"{factor * values:.{digits}f}"


def _ending(output: Path | None, format: _Format | None) -> str:
    """What follows a recording's name in a folder; a *format* must not contradict the name of a single file."""
    suffix = "" if output is None or output.is_dir() else output.suffix.lower()
    if format and suffix in _WRITABLE and suffix not in (f".{format}", ".txt" if format == "tum" else ""):
        usage(f"--format {format} and --output {output} contradict each other")
    return ".attitude" if format == "ros2" else f".attitude.{format or 'parquet'}"


def _is_ros(target: Path, format: _Format | None) -> bool:
    return format in _ROS or target.suffix.lower() in (".bag", ".mcap")
