"""Block by block from the columns of a file to recordings in SI units, and the account of what was seen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from poise.data.attitude import Attitude
from poise.data.recording import Recording
from poise.formats.decisions import Decisions, stacked
from poise.formats.held import Fresh
from poise.formats.names import QUAT as QUAT_NAMES
from poise.formats.names import SENSORS, counted, listed
from poise.formats.saving import readable
from poise.formats.table import Columns, Floats, Table
from poise.math import arrays


@dataclass(frozen=True)
class SensorFacts:
    """One sensor of a file (or its clock): the unit it is in, how that was found, and how many rows hold a sample."""

    unit: str
    how: str
    samples: int


@dataclass(frozen=True)
class Sniffed:
    """What was recognised in a file."""

    path: str
    format: str
    rows: int
    rate_hz: float
    duration: float
    """s"""
    gaps: tuple[int, float]
    """how many steps are longer than three usual ones, or than a packet, and the longest of them, s"""
    sensors: Mapping[str, SensorFacts]
    """by name: time, gyr, acc, mag"""
    columns: Mapping[str, str]
    """ours (gyr_x, …) to the file's"""
    notes: tuple[str, ...]
    doubts: tuple[str, ...]


class Assembler:
    """Makes recordings of consecutive blocks of one *table*'s columns, the same rows however they are cut.

    What it remembers between blocks fits into JSON: :meth:`state` and :meth:`restore` go on in another process.
    """

    def __init__(self, table: Table, made: Decisions, name: str, source: str, digest: str) -> None:
        self._table, self._made = table, made
        none, name, source = np.empty((0, 3)), readable(name), readable(source)
        self.empty = Recording(
            np.empty(0), none, none, none, gravity=made.gravity, name=name, source=source, source_hash=digest
        )
        self._turns = made.turns()
        self._fresh = {sensor: Fresh(usual) for sensor, usual in made.held.items()}
        self._seen: dict[str, Any] = {
            "rows": 0, "samples": dict.fromkeys(("time", *SENSORS), 0), "fresh": dict.fromkeys(made.held, 0),
            "first": None, "last": None, "before": None, "backward": 0, "gaps": [0, 0.0], "truth": None, "turned": False,
        }  # fmt: skip

    @property
    def rows(self) -> int:
        """How many rows came so far."""
        return int(self._seen["rows"])

    def recording(self, columns: Columns) -> Recording:
        """The next rows."""
        with np.errstate(all="ignore"):  # infinite samples and stamps are the guard's business, later
            count = len(columns["gyr_x"])
            values: dict[str, Any] = {"time": self._time(columns, count)}
            for sensor in SENSORS:
                values[sensor] = self._sensor(sensor, columns, count)
            for age in ("acc_age", "mag_age"):
                values[age] = columns[age] if age in columns else np.zeros(count)
            if "moving" in columns:
                values["moving"] = np.nan_to_num(columns["moving"]) != 0
            if "truth_qw" in columns:
                quat = np.column_stack([columns[f"truth_{name}"] for name in QUAT_NAMES])
                values["truth"] = self._truth(values["time"], quat)
            self._seen["rows"] += count
            return self.empty.with_samples(**values)

    def state(self) -> dict[str, Any]:
        """What :meth:`restore` needs."""
        fresh = {sensor: fresh.state() for sensor, fresh in self._fresh.items()}
        return {"seen": self._seen, "fresh": fresh, "turns": self._turns.state()}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on behind the rows that :meth:`state` was taken after."""
        self._seen = state["seen"]
        self._turns.restore(state["turns"])
        for sensor, fresh in self._fresh.items():
            fresh.restore(state["fresh"][sensor])

    def notes(self) -> tuple[str, ...]:
        """What is to be said about the rows so far."""
        return (*self._noted(), *self._doubted())

    def sniffed(self) -> Sniffed:
        """What was recognised, counted over the rows so far."""
        seen, made = self._seen, self._made
        return Sniffed(
            path=self.empty.source,
            format=self._table.format,
            rows=self.rows,
            rate_hz=1.0 / made.step,
            duration=0.0 if seen["first"] is None else seen["last"] - seen["first"],
            gaps=(seen["gaps"][0], seen["gaps"][1]),
            sensors={
                name: SensorFacts(unit, made.how[name], seen["fresh"].get(name, seen["samples"][name]))
                for name in ("time", *SENSORS)
                if (unit := made.unit.get(name))
            },
            columns={key: column.name for key, column in self._table.layout.columns.items()},
            notes=self._noted(),
            doubts=self._doubted(),
        )

    def _noted(self) -> tuple[str, ...]:
        said = [*self._table.notes, *self._made.notes]
        if not self._seen["samples"]["mag"]:
            said.append("no magnetometer: heading is arbitrary")
        if unused := self._table.layout.unused:
            said.append(f"not used: {listed(unused)}")
        for end, count in self._turns.passed.items():
            what = "it passes midnight" if self._table.daily else f"the counter begins anew at {end:.0f}"
            said.append(f"time: {what}, {counted(count, 'time')}; the stamps go on")
        for sensor, new in self._seen["fresh"].items():
            said.append(
                f"{sensor}: slower than the gyroscope, each sample was repeated over {self._made.held[sensor]} rows; "
                f"the repeats are left out ({new / max(self.rows, 1):.0%} of the rows hold a sample)"
            )
        return tuple(said)

    def _doubted(self) -> tuple[str, ...]:
        said = [*self._table.doubts, *self._made.doubts]
        if backward := self._seen["backward"]:
            said.append(f"time: {backward} stamps do not rise above the one before")
        return tuple(said)

    def _time(self, columns: Columns, count: int) -> Floats:
        seen, made = self._seen, self._made
        if made.rate is not None:
            time: Floats = np.arange(self.rows, self.rows + count) / made.rate
        else:
            per_second = made.factor("time")
            time = self._turns.of(columns["time"])
            if per_second != 1.0:
                time = time / per_second
        before = np.nan if seen["before"] is None else seen["before"]
        steps = np.diff(time, prepend=before)
        long = steps[steps > made.gap]
        if len(long):
            seen["gaps"] = [seen["gaps"][0] + len(long), max(seen["gaps"][1], float(long.max()))]
        seen["backward"] += int(np.sum((steps < 0) if made.packets else (steps <= 0)))
        known = time[np.isfinite(time)]
        seen["samples"]["time"] += len(known)
        if len(known):
            seen["first"] = float(known[0]) if seen["first"] is None else seen["first"]
            seen["last"] = float(known[-1])
        if count:
            seen["before"] = float(time[-1])
        return time

    def _sensor(self, sensor: str, columns: Columns, count: int) -> Floats:
        if f"{sensor}_x" not in columns:
            return np.full((count, 3), np.nan)
        rows = stacked(columns, sensor)
        if (factor := self._made.factor(sensor)) != 1.0:
            rows *= factor
        self._seen["samples"][sensor] += int(np.isfinite(rows).all(axis=1).sum())
        if fresh := self._fresh.get(sensor):
            new = fresh.of(rows)
            rows[~new] = np.nan
            self._seen["fresh"][sensor] += int(new.sum())
        return rows

    def _truth(self, time: Floats, quat: Floats) -> Attitude:
        """The reference, its sign continuous from block to block; quaternions of length 1 stay bit for bit."""
        seen, facts = self._seen, self._table.facts
        frame: Any = facts.get("poise.truth_frame", "enu")
        heading: Any = facts.get("poise.truth_heading_reference", "arbitrary")
        last = np.array([np.nan] * 4 if seen["truth"] is None else seen["truth"])
        complete = np.asarray(np.isfinite(quat).all(axis=1))
        led = arrays.normalize(np.vstack([last, np.where(complete[:, None], quat, np.nan)]))
        known = np.flatnonzero(np.isfinite(led).all(axis=1))
        truth = Attitude.of(time, quat, frame=frame, heading_reference=heading)
        steady = arrays.continuous(led) * (-1.0 if seen["turned"] else 1.0)
        if len(known):
            seen["truth"] = led[known[-1]].tolist()
            seen["turned"] = bool(np.dot(steady[known[-1]], led[known[-1]]) < 0)
        unit = np.abs(np.einsum("ij,ij->i", quat, quat) - 1) < 1e-12
        truth.quat[:] = np.where(unit[:, None], quat, steady[1:])
        return truth
