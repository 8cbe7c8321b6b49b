"""What a method found out about the sensors: Learned by now, Learning over time."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal, Self

import numpy as np
from numpy.typing import NDArray

from poise.data import arrow
from poise.errors import RecordingError

if TYPE_CHECKING:
    import pyarrow

Floats = NDArray[np.float64]

KIND = "learned"
# What the numbers of a quantity are called, by its shape.
_AXES = {
    (): ("",),
    (2,): ("_north", "_up"),
    (3,): ("_x", "_y", "_z"),
    (3, 3): tuple(f"_{row}{column}" for row in "xyz" for column in "xyz"),
}


@dataclass(frozen=True, eq=False, repr=False)
class Learned(Mapping[str, Mapping[str, Any]]):
    """What is known of the sensors: a mapping from a quantity's name to its ``value``, ``sigma`` of its shape and ``unit``.

    Write it with :func:`poise.write` (JSON), read it with :func:`poise.read_learned`, and give it as ``start_from`` for the
    next recording of the same sensor.
    """

    method: str
    """the class of the method that found it out"""
    quantities: Mapping[str, Mapping[str, Any]]
    states: tuple[str, ...] = ()
    """the numbers that *covariance* is about: gyr_bias_x, gyr_scale_xy, … , mag_delay"""
    covariance: Floats | None = None
    """(k, k) of *states*, in their order and units; None where only the sigmas are known"""
    source: str = ""
    """what was recorded when it was learned"""

    def __getitem__(self, name: str) -> Mapping[str, Any]:
        return self.quantities[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.quantities)

    def __len__(self) -> int:
        return len(self.quantities)

    def __repr__(self) -> str:
        return f"Learned({', '.join(self)} by {self.method}{f' from {self.source}' if self.source else ''})"

    def numbers(self) -> tuple[list[str], Floats, Floats]:
        """Every number's name (gyr_bias_x, …), value and sigma, in order."""
        names, values, sigmas = [], [], []
        for name, found in self.quantities.items():
            value, sigma = np.asarray(found["value"], float), np.asarray(found["sigma"], float)
            names += named(name, value)
            values += value.ravel().tolist()
            sigmas += sigma.ravel().tolist()
        return names, np.array(values), np.array(sigmas)

    def check(self) -> None:
        """Raises :class:`RecordingError` where its numbers do not fit together."""
        for name, found in self.quantities.items():
            _check_quantity(name, found)
        if self.covariance is not None:
            _check_covariance(self.states, self.covariance, self.numbers()[0])

    def as_json(self, indent: int | None = None) -> str:
        """All of it, on one line without *indent*; :meth:`of_json` reads it back, bit for bit."""
        kept: dict[str, Any] = {"poise": KIND, "method": self.method, "source": self.source}
        kept["learned"] = {name: dict(found) for name, found in self.quantities.items()}
        if self.covariance is not None:
            kept["states"] = list(self.states)
            kept["covariance"] = [row[: i + 1] for i, row in enumerate(self.covariance.tolist())]  # below the diagonal
        return json.dumps(kept, indent=indent)

    @classmethod
    def of_json(cls, text: str) -> Self:
        """What :meth:`as_json` wrote, or a person: without ``states`` and ``covariance`` only the sigmas count.

        Raises :class:`RecordingError` for any other text.
        """
        try:
            kept = json.loads(text)
            if kept["poise"] != KIND:
                raise RecordingError(f'not what was learned: expected "poise": "{KIND}", found {kept["poise"]!r}')
            states, rows = tuple(kept.get("states", ())), kept.get("covariance")
            covariance = None if rows is None else _square(rows)
            found = cls(str(kept["method"]), dict(kept["learned"]), states, covariance, str(kept.get("source", "")))
            found.check()
            return found
        except RecordingError:
            raise
        except (ValueError, KeyError, TypeError, AttributeError, IndexError, OverflowError, RecursionError) as problem:
            short = (str(problem) or type(problem).__name__).split("\n")[0][:120]
            raise RecordingError(f"not what poise wrote as learned, or damaged ({short})") from None


@dataclass(frozen=True, eq=False)
class Learning:
    """What was known of the sensors, over time: a table with one row at every moment that was asked for.

    Causal: each row knows the samples up to its time and no later one.
    """

    time: Floats
    """(k,) s"""
    names: tuple[str, ...]
    """(m) gyr_bias_x, gyr_scale_xy, …, as :meth:`Learned.numbers` has them"""
    units: tuple[str, ...]
    """(m)"""
    values: Floats
    """(k, m); NaN while a number is not known at all"""
    sigma: Floats
    """(k, m) standard deviations"""
    method: str = ""

    @classmethod
    def of(cls, time: Sequence[float], rows: Sequence[tuple[list[str], Floats, Floats]], last: Learned) -> Self:
        """From :meth:`Learned.numbers` at each of the times; *last* knows of every quantity."""
        units = {name: found["unit"] for key, found in last.items() for name in named(key, found["value"])}
        values, sigma = (np.full((len(time), len(units)), np.nan) for _ in range(2))
        place = {name: i for i, name in enumerate(units)}
        for i, (names, value, deviation) in enumerate(rows):
            columns = [place[name] for name in names]
            values[i, columns], sigma[i, columns] = value, deviation
        return cls(np.array(time, float), tuple(units), tuple(units.values()), values, sigma, last.method)

    def __len__(self) -> int:
        return len(self.time)

    def columns(self) -> dict[str, Floats]:
        """Every column by name: time, gyr_bias_x, gyr_bias_x_sigma, …"""
        columns = {"time": self.time}
        for i, name in enumerate(self.names):
            columns |= {name: self.values[:, i], f"{name}_sigma": self.sigma[:, i]}
        return columns

    def __getitem__(self, rows: slice) -> Learning:
        return replace(self, time=self.time[rows], values=self.values[rows], sigma=self.sigma[rows])

    def metadata(self) -> dict[str, str]:
        """What a file must say beside the columns."""
        from poise.version import __version__

        return {
            "poise.kind": "learning",
            "poise.version": __version__,
            "poise.method": self.method,
            "poise.units": "; ".join(["time s", *(f"{n} {u}" for n, u in zip(self.names, self.units, strict=True))]),
        }

    def to_arrow(self) -> pyarrow.Table:
        """An Arrow table with :meth:`columns` and, as its schema's metadata, :meth:`metadata`."""
        return arrow.table(self.columns()).replace_schema_metadata(self.metadata())

    def to_frame(self, backend: Literal["pandas", "polars"] = "pandas") -> Any:
        """A pandas or polars data frame of :meth:`columns`."""
        return arrow.frame(self.columns(), backend)


def named(name: str, value: Any) -> list[str]:
    """What the numbers of a quantity are called, in order: gyr_bias_x, …"""
    return [name + axis for axis in _AXES[np.shape(value)]]


def _square(rows: Any) -> Floats:
    """The symmetric matrix with these rows up to the diagonal."""
    matrix = np.zeros((len(rows), len(rows)))
    for i, row in enumerate(rows):
        if len(row) != i + 1:
            raise ValueError(f"row {i + 1} of the covariance has {len(row)} numbers")
        matrix[i, : i + 1] = matrix[: i + 1, i] = row
    return matrix


def _check_quantity(name: str, found: Any) -> None:
    try:
        value, sigma, unit = np.asarray(found["value"], float), np.asarray(found["sigma"], float), found["unit"]
    except (TypeError, KeyError, ValueError, OverflowError):
        raise RecordingError(f"{name}: expected value, sigma and unit, found {found!r}") from None
    if value.shape not in _AXES or sigma.shape != value.shape or not isinstance(unit, str):
        raise RecordingError(f"{name}: a value of shape {value.shape} with a sigma of {sigma.shape} in {unit!r}")
    if not (np.isfinite(value).all() and np.isfinite(sigma).all() and (sigma >= 0.0).all()):
        raise RecordingError(f"{name}: expected finite numbers with a sigma of 0 or more, found {found!r}")


def _check_covariance(states: tuple[str, ...], covariance: Floats, known: list[str]) -> None:
    k = len(states)
    if covariance.shape != (k, k) or len(set(states)) != k or not set(states) <= set(known):
        raise RecordingError(f"covariance of shape {covariance.shape} for {k} states: {', '.join(map(str, states))}")
    if not np.isfinite(covariance).all() or not np.array_equal(covariance, covariance.T):
        raise RecordingError("covariance: expected a symmetric matrix of finite numbers")
    variance = np.diag(covariance)
    scale = np.sqrt(np.where(variance > 0.0, variance, 1.0))
    if (variance < 0.0).any() or np.linalg.eigvalsh(covariance / np.outer(scale, scale)).min(initial=0.0) < -1e-6:
        raise RecordingError("covariance: has a negative variance; it is damaged")
