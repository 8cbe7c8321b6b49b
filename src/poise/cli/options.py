"""Options that several commands share, and what they mean."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from datetime import date as Date
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Group, Parameter

from poise.cli.words import amount, declination_of, pairs, parsed, usage
from poise.errors import FormatError, PoiseError

if TYPE_CHECKING:
    from poise.data.attitude import Attitude
    from poise.data.learned import Learned
    from poise.data.recording import Recording
    from poise.formats.limits import Limits

FILE = Group("What the file does not say", sort_key=1)
METHOD = Group("The method", sort_key=2)

Dashed = Annotated[str | None, Parameter(allow_leading_hyphen=True)]
"""An option whose value may begin with "-": "-x y z", "-33.9,151.2"."""


@Parameter(name="*", group=FILE)
@dataclass(frozen=True)
class Reading:
    """How to read files; what a file says itself needs no option."""

    columns: Dashed = None
    """Names for a file without a header, in order: `time,gx,gy,gz,ax,ay,az,mx,my,mz`, with units if you like
    (`gx[deg/s]`), `-` for a column to skip; or names for single columns: `hx=mag_x,hy=mag_y,hz=mag_z,temp=-`."""

    units: str | None = None
    """Units the header does not name: `gyr=deg/s,acc=g,time=ms`."""

    delimiter: Dashed = None
    """What separates columns: `,` `;` `tab` `space`."""

    decimal: str | None = None
    """The decimal mark: `.` or `,`."""

    rate: float | None = None
    """Samples per second, for a file without time stamps."""

    topic: Dashed = None
    """The Imu topic of a ROS bag that has several, or both topics: `/imu/data_raw,/imu/mag` (`-`: no magnetometer)."""

    remap: Dashed = None
    """Rename the sensor's axes: `--remap "y -x z"` makes x its y, y its -x, z its z; those of one sensor against the
    others', which may be a mirror image: `--remap "acc=y -x z,mag=-x y z"`."""

    delay: str | None = None
    """Seconds that a sensor's samples come late against the gyroscope's: `--delay mag=0.015`."""

    profile: Path | None = None
    """A file with --units, --remap and --delay, as `poise doctor --save-profile` writes it."""

    force: Annotated[bool, Parameter(negative="")] = False
    """Go on with a recording whose units or axes are surely wrong."""

    limit: str | None = None
    """What a file may hold: `rows=2e8,size=20GiB,columns=512,line=1MiB`; and `whole=1GiB`, the size above which
    `poise estimate` works in chunks."""

    def read(self, path: Path) -> Recording:
        """The recording in *path*, corrected as told. Raises :class:`RecordingError` where it is surely wrong even so."""
        from poise.cli import corrected

        return corrected.read(self, path)

    def read_either(self, path: Path) -> Recording | Attitude:
        """The recording in *path*, or the attitude: what poise wrote as an attitude is one, in a ROS bag too."""
        from poise.formats import read_attitude, wrote_attitude

        if wrote_attitude(path, limits=self.limits()):
            return read_attitude(path, topic=self.topic, limits=self.limits())
        try:
            return self.read(path)
        except FormatError as no_recording:
            try:
                return read_attitude(path, topic=self.topic, limits=self.limits())
            except FormatError:
                raise no_recording from None

    def as_arguments(self) -> dict[str, Any]:
        """Keyword arguments of :func:`poise.read`; :class:`UsageError` where an option cannot be understood."""
        if self.profile is not None:
            from poise.cli import corrected

            return corrected.with_profile(self).as_arguments()
        self._check()
        delimiter = {"tab": "\t", "space": " "}.get(self.delimiter or "", self.delimiter)
        return {
            "columns": self.columns,
            "units": pairs(self.units, "--units", "gyr=deg/s,acc=g"),
            "delimiter": delimiter,
            "decimal": self.decimal,
            "rate": self.rate,
            "topic": self.topic,
            "limits": self.limits(),
        }

    def limits(self) -> Limits:
        """The limits for files; :class:`UsageError` where --limit cannot be understood."""
        from poise.formats.limits import Limits

        return Limits(
            **{name: amount(name, value) for name, value in (pairs(self.limit, "--limit", "rows=2e8") or {}).items()}
        )

    def _check(self) -> None:
        from poise.cli import corrected
        from poise.formats.units import FACTORS

        corrected.asked(self)
        for sensor, unit in (pairs(self.units, "--units", "gyr=deg/s,acc=g") or {}).items():
            if sensor not in FACTORS:
                usage(f"--units {sensor}=…: expected one of {', '.join(FACTORS)}")
            corrected.check_unit("--units", sensor, unit)
        if self.rate is not None and not 0.0 < self.rate < math.inf:
            usage(f"--rate {self.rate}: expected samples per second above 0")
        if self.delimiter is not None and self.delimiter not in ("tab", "space") and len(self.delimiter) != 1:
            usage(f"--delimiter {self.delimiter!r}: expected one character, tab or space")
        if self.decimal not in (None, ".", ","):
            usage(f"--decimal {self.decimal!r}: expected . or ,")


@Parameter(name="*", group=METHOD)
@dataclass(frozen=True)
class Running:
    """Which method, with which parameters, and where north is."""

    method: Annotated[str, Parameter(name=["--method", "-m"])] = "self-calibrating"
    """One of those that `poise methods` lists."""

    set_: Annotated[tuple[str, ...], Parameter(name="--set", negative="")] = ()
    """A parameter of the method: `--set initial_iron=0.036`; repeat for more. `poise methods METHOD` lists them."""

    declination: float | None = None
    """Degrees from true to magnetic north, east positive: headings become true."""

    place: Dashed = None
    """`LAT,LON` in degrees: looks the declination up in the world magnetic model, with --date."""

    date: str | None = None
    """The day of the recording, `YYYY-MM-DD`, for --place."""

    rest_bias: bool = True
    """Measure the gyroscope's bias whenever the sensor rests, for a method that does not learn it itself."""

    offline: Annotated[bool, Parameter(negative="")] = False
    """Use the whole recording for every row, what comes after it too (self-calibrating only)."""

    start_from: Path | None = None
    """What was learned of the same sensor before: a file of --save-learned, or an attitude that poise wrote."""

    slew: float | None = None
    """Degrees a second: corrections turn the attitude no faster than that, beside the gyroscope's own turning."""

    def build(self) -> Any:
        """The method with its parameters; :class:`UsageError` where they cannot be."""
        from poise.estimators import METHODS
        from poise.estimators.parameters import parameters, prepared

        if self.method not in METHODS:
            usage(f"no method {self.method!r}; there are {', '.join(METHODS)}")
        cls = METHODS[self.method]
        kinds = {p.name: p for p in parameters(cls)}
        chosen: dict[str, Any] = {}
        for text in self.set_:
            name, _, value = text.partition("=")
            name = name.strip().replace("-", "_")
            if name not in kinds or not value:
                usage(f"--set {text!r}: expected NAME=VALUE with a NAME of {self.method}: {', '.join(kinds)}")
            chosen[name] = parsed(value.strip(), kinds[name].kind)
        if (angle := self._declination()) is not None:
            if "declination" not in kinds:
                usage(f"{self.method} has no heading from a magnetometer, so a declination means nothing to it")
            chosen["declination"] = angle
        if self.offline and self.method != "self-calibrating":
            usage(f"--offline goes with --method self-calibrating, not with {self.method}")
        if self.start_from is not None and not hasattr(cls, "start_from"):
            usage(f"--start-from goes with --method self-calibrating, not with {self.method}, which learns nothing")
        if self.slew is not None and not 0.0 <= self.slew <= 1e9:
            usage(f"--slew {self.slew}: expected degrees a second, 0 to 1e9")
        if self.slew is not None and self.offline:
            usage("--slew bounds corrections as they come; --offline knows them all before: give one")
        try:
            method = cls(**chosen)
            prepared(method)
        except PoiseError as error:
            usage(str(error))
        return method

    @property
    def told_declination(self) -> bool:
        return self.declination is not None or self.place is not None

    @property
    def slew_per_second(self) -> float | None:
        """--slew in rad/s."""
        return None if self.slew is None else math.radians(self.slew)

    def estimate(
        self,
        recording: Recording,
        start: Attitude | None = None,
        progress: Callable[[int], None] | None = None,
        learning: float | None = None,
    ) -> Attitude:
        from poise.estimators.batch import estimate

        known: dict[str, Any] = {"start_from": self.before(), "learning": learning, "progress": progress}
        if self.offline:
            from poise.estimators.self_calibrating.smoother import smooth

            attitude = smooth(recording, self.build(), start, **known)
        else:
            attitude = estimate(
                self.build(), recording, start, rest_bias=self.rest_bias, slew=self.slew_per_second, **known
            )
        if self.told_declination and attitude.heading_reference == "magnetic":  # a declination of zero is a declination
            attitude = replace(attitude, heading_reference="true")
        return attitude

    def means_nothing_to(self, file: Path) -> None:
        """Raises :class:`UsageError` where options of the method are given for *file*, which is an attitude already."""
        usual = Running()
        words = {"set_": "set", "rest_bias": "no-rest-bias"}
        given = [f.name for f in fields(self) if getattr(self, f.name) != getattr(usual, f.name)]
        if given:
            told = ", ".join(f"--{words.get(name, name).replace('_', '-')}" for name in given)
            usage(
                f"{told}: {file} is an attitude already, which no method makes anew; leave that out, or give the recording"
            )

    def before(self) -> Learned | None:
        """What --start-from holds; :class:`UsageError` where that is nothing to start from."""
        if self.start_from is None:
            return None
        from poise.formats import read_learned

        try:
            found = read_learned(self.start_from)
            found.check()
            self.build().check_start(found)
        except (PoiseError, OSError) as error:
            text = str(error).removeprefix(f"{self.start_from}: ").removeprefix("start_from: ")
            usage(f"--start-from {self.start_from}: {text}")
        return found

    def doubts(self, learned: Any) -> list[str]:
        """What speaks against --start-from being of the sensor of which *learned* was found out."""
        before = self.before()
        if before is None or learned is None:
            return []
        found: list[str] = self.build().doubts(before, learned)
        return found

    def warm(self) -> None:
        """Load (or, the first time, compile) the method in the background, while a file is read."""

        def run() -> None:
            from poise.data.recording import Recording

            with suppress(PoiseError):  # said where the real recording is estimated
                self.estimate(Recording.at_rate(100.0, [[0.0, 0.0, 0.0]], [[0.0, 0.0, 9.8]]))

        threading.Thread(target=run, daemon=True).start()

    def _declination(self) -> float | None:
        if self.place is None:
            if self.date is not None:
                usage("--date goes with --place LAT,LON")
            return None if self.declination is None else declination_of(self.declination)
        if self.declination is not None:
            usage("--declination and --place say the same thing; give one")
        from poise.magnetic_model import declination

        if self.date is None:
            usage("--place needs --date YYYY-MM-DD: declination changes over the years")
        try:
            latitude, longitude = (float(part) for part in self.place.split(","))
            when = Date.fromisoformat(self.date)
        except ValueError:
            usage(f"--place {self.place} --date {self.date}: expected LAT,LON in degrees and YYYY-MM-DD")
        try:
            return declination(latitude, longitude, when)
        except PoiseError as error:
            usage(str(error))
