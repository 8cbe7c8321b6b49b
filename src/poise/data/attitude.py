"""Attitude: what an estimator found out, row by row, and the ways out of it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from poise.data import arrow, axes
from poise.data.flags import GAP, LOST, Flag, valid
from poise.data.reasons import Reason, Reset, reasons, resets
from poise.errors import RecordingError
from poise.math import arrays

if TYPE_CHECKING:
    import pyarrow
    from scipy.spatial.transform import Rotation

    from poise.data.learned import Learned, Learning
    from poise.data.recording import Recording

Floats = NDArray[np.float64]
Frame = Literal["enu", "ned", "nwu", "body"]
HeadingReference = Literal["true", "magnetic", "arbitrary"]

# The columns of the one buffer that kernels write.
QUAT, RATE, BIAS, SIGMA, BIAS_SIGMA = slice(0, 4), slice(4, 7), slice(7, 10), slice(10, 13), slice(13, 16)
COLUMNS = 16

_H = np.sqrt(0.5)
_FROM_ENU = {"enu": np.array([1.0, 0, 0, 0]), "ned": np.array([0, _H, _H, 0]), "nwu": np.array([_H, 0, 0, -_H])}
_SIGMA_ORDER = {"enu": [0, 1, 2], "ned": [1, 0, 2], "nwu": [1, 0, 2]}


@dataclass(frozen=True)
class Provenance:
    """Where an attitude comes from, as it is written into files."""

    method: str = ""
    parameters: Mapping[str, Any] = field(default_factory=dict)
    source: str = ""
    source_hash: str = ""
    """SHA-256 of the file that was read"""


@dataclass(frozen=True, eq=False)
class Attitude:
    """Orientation over time, with its rate, bias, uncertainty and flags; one row per sample.

    Make one from your own quaternions with :meth:`of`; estimators fill the table directly.
    All fields below are views of one table: writing into them writes into the attitude.
    """

    time: Floats
    """(n,) s"""
    table: Floats
    """(n, 16): quat, rate, bias, sigma, bias_sigma side by side"""
    flags: NDArray[np.uint32]
    """(n,) bits of :class:`Flag`"""
    heading_reference: HeadingReference = "arbitrary"
    """what a heading of zero means: true north, magnetic north, or nothing outside this recording"""
    frame: Frame = "enu"
    """the frame that the quaternion turns body vectors into"""
    provenance: Provenance = Provenance()
    learned: Learned | None = None
    """what the method found out about the sensors by the last row, for one that does: name → value, sigma, unit"""
    learning: Learning | None = None
    """the same over time, where ``estimate`` or ``smooth`` was asked for it"""

    @classmethod
    def of(
        cls,
        time: ArrayLike,
        quat: ArrayLike,
        *,
        heading_reference: HeadingReference = "arbitrary",
        frame: Frame = "enu",
        provenance: Provenance | None = None,
    ) -> Attitude:
        """An attitude from times (n,) s and quaternions (n, 4) w x y z, body to *frame*.

        Quaternions are normalised; rows that are not finite or have no length are NaN and not valid.
        Raises :class:`RecordingError` where the shapes do not fit.
        """
        time, quat = np.array(time, float), np.array(quat, float)
        if time.ndim != 1 or quat.shape != (len(time), 4):
            raise RecordingError(f"time (n,) and quat (n, 4) expected, found {time.shape} and {quat.shape}")
        if frame not in (*_FROM_ENU, "body"):
            raise RecordingError(f"frame {frame!r} not known; expected enu, ned, nwu or body")
        table = np.full((len(time), COLUMNS), np.nan)
        quat[~np.isfinite(quat).all(axis=1)] = np.nan
        table[:, QUAT] = arrays.continuous(arrays.normalize(quat))
        flags = np.where(np.isfinite(table[:, 0]), 0, LOST).astype(np.uint32)
        return cls(time, table, flags, heading_reference, frame, provenance or Provenance())

    @classmethod
    def view(
        cls, time: Floats, table: Floats, flags: NDArray[np.uint32], heading: HeadingReference, provenance: Provenance
    ) -> Attitude:
        """An ENU attitude of these very arrays, unchecked: a frozen constructor costs a third of a one-sample update."""
        attitude = object.__new__(cls)
        attitude.__dict__.update(
            time=time, table=table, flags=flags, heading_reference=heading, frame="enu", provenance=provenance
        )  # fmt: skip
        return attitude

    @property
    def quat(self) -> Floats:
        """(n, 4) w x y z, body to Earth, continuous in sign; NaN where there is no attitude."""
        return self.table[:, QUAT]

    @property
    def quat_xyzw(self) -> Floats:
        """(n, 4) x y z w, the order of scipy and ROS."""
        return self.table[:, [1, 2, 3, 0]]

    @property
    def rate(self) -> Floats:
        """(n, 3) rad/s, angular rate in the body frame, bias removed."""
        return self.table[:, RATE]

    @property
    def bias(self) -> Floats:
        """(n, 3) rad/s, the gyroscope's bias in the body frame."""
        return self.table[:, BIAS]

    @property
    def sigma(self) -> Floats:
        """(n, 3) rad, standard deviation of the attitude about the Earth frame's x, y, z; NaN where a method has none."""
        return self.table[:, SIGMA]

    @property
    def bias_sigma(self) -> Floats:
        """(n, 3) rad/s, standard deviation of the bias; NaN where a method has none."""
        return self.table[:, BIAS_SIGMA]

    @property
    def valid(self) -> NDArray[np.bool_]:
        """(n,) whether the row may be acted on."""
        return valid(self.flags)

    def __len__(self) -> int:
        return len(self.time)

    def __getitem__(self, rows: slice | NDArray[Any]) -> Attitude:
        if not isinstance(rows, slice):
            rows = np.atleast_1d(rows)
        return replace(self, time=self.time[rows], table=self.table[rows], flags=self.flags[rows])

    def __repr__(self) -> str:
        span = f"{np.nanmin(self.time):g}-{np.nanmax(self.time):g} s, " if np.isfinite(self.time).any() else ""
        return (
            f"Attitude({len(self)} rows, {span}{self.frame.upper()}, heading {self.heading_reference}, "
            f"{np.mean(self.valid) if len(self) else 0:.1%} valid)"
        )

    # -- angles ---------------------------------------------------------------------------------------------------

    def euler(self, sequence: str = "ZXY", degrees: bool = False) -> Floats:
        """(n, 3) Euler angles of the quaternion, rad unless *degrees*.

        *sequence* as in scipy: capitals turn about the moving axes. "ZXY" (the default) gives heading ψ
        counter-clockwise from north, pitch θ, roll γ of a body with x right and y forward; "ZYX" gives yaw, pitch,
        roll of one with x forward. Near a middle angle of ±90° the outer two are not determined: prefer :meth:`tilt`.
        """
        import warnings

        x, y, z = list(sequence) if len(sequence) == 3 else [""] * 3
        if not (set(sequence) <= set("XYZ") or set(sequence) <= set("xyz")) or x == y or y == z:
            raise RecordingError(f'sequence {sequence!r} not understood; expected three axes such as "ZXY" or "ZYX"')
        angles = np.full((len(self), 3), np.nan)
        known = np.asarray(np.isfinite(self.quat).all(axis=1))
        if known.any():
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", UserWarning)  # gimbal lock: said above
                angles[known] = self[known].as_rotation().as_euler(sequence, degrees=degrees)  # type: ignore[call-overload]
        return angles

    def heading(self, forward: str = "y") -> Floats:
        """(n,) rad in [0, 2π): compass heading, clockwise from north, of the body axis *forward* ("x", "-y", …).

        Not determined where that axis points up or down.
        """
        east, north, _ = self._in_enu(forward).T
        heading = np.arctan2(east, north) % (2 * np.pi)
        return np.where(heading >= 2 * np.pi, 0.0, heading)  # −1e-17 % 2π is 2π

    def tilt(self, axis: str = "z") -> Floats:
        """(n,) rad in [0, π]: the angle between the body axis *axis* and up; it has no singularity."""
        east, north, up = self._in_enu(axis).T
        return np.asarray(np.arctan2(np.hypot(east, north), up))

    def angle(self) -> Floats:
        """(n,) rad in [0, π]: the whole angle of the turn; after :meth:`relative_to`, how far the joint is turned."""
        return arrays.angle(self.quat)

    def _in_enu(self, axis: str) -> Floats:
        if self.frame == "body":
            raise RecordingError("heading and tilt need an Earth frame; this attitude is relative to another body")
        return arrays.rotate(self.to("enu").quat, axes.unit_vector(axis))

    # -- with other things ----------------------------------------------------------------------------------------

    def linear_acceleration(self, recording: Recording, frame: Literal["earth", "body"] = "earth") -> Floats:
        """(n, 3) m/s²: the recording's acceleration without gravity, in the Earth frame (ENU) or the body frame.

        What was learned of the accelerometer's bias and scale is taken off.
        """
        if len(recording) != len(self):
            raise RecordingError(
                f"the recording has {len(recording)} rows, the attitude {len(self)}; resample the attitude to its time"
            )
        if frame not in ("earth", "body"):
            raise RecordingError(f'frame {frame!r} not understood; expected "earth" or "body"')
        quat = self.to("enu").quat
        gravity, acc = np.array([0.0, 0.0, recording.gravity]), recording.acc
        if self.learned is not None and "acc_bias" in self.learned and "acc_scale" in self.learned:
            acc = (1.0 + self.learned["acc_scale"]["value"]) * (acc - np.array(self.learned["acc_bias"]["value"]))
        if frame == "earth":
            return np.asarray(arrays.rotate(quat, acc) - gravity)
        return np.asarray(acc - arrays.rotate(arrays.conjugate(quat), gravity))

    def relative_to(self, other: Attitude) -> Attitude:
        """This body's orientation seen from the body of *other* (a joint's angle), at this attitude's times.

        The Earth frame cancels, and with it every error the two share; a heading offset between them does not. Sigma is
        about the axes of the other body, from both as if their errors were independent.
        """
        if self.frame != other.frame:
            raise RecordingError(f"frames differ: {self.frame} and {other.frame}; convert one with .to()")
        base = other if np.array_equal(self.time, other.time, equal_nan=True) else other.resample(self.time)
        quat = arrays.multiply(arrays.conjugate(base.quat), self.quat)
        table = np.full_like(self.table, np.nan)
        table[:, QUAT] = arrays.continuous(quat)
        table[:, RATE] = self.rate - arrays.rotate(arrays.conjugate(quat), base.rate)
        variance = self.sigma**2 + base.sigma**2
        table[:, SIGMA] = np.sqrt(np.einsum("nji,nj->ni", arrays.matrix(base.quat) ** 2, variance))
        return replace(self, table=table, flags=self.flags | base.flags, frame="body", heading_reference="arbitrary")

    def resample(self, time: ArrayLike, max_gap: float = 1.0) -> Attitude:
        """The attitude at other times (m,) s, turned evenly between neighbours.

        Outside the recording, beside rows without attitude and inside gaps longer than *max_gap* (s): NaN, not valid.
        Flags are those of both neighbours.
        """
        wanted = np.array(time, float)
        if wanted.ndim != 1:
            raise RecordingError(f"time (m,) expected, found {wanted.shape}")
        clock = np.where(np.isfinite(self.time), self.time, -np.inf)
        forward = np.flatnonzero(clock > np.concatenate([[-np.inf], np.maximum.accumulate(clock)[:-1]]))
        own = self.time[forward]
        table = np.full((len(wanted), COLUMNS), np.nan)
        flags = np.full(len(wanted), LOST, np.uint32)
        inside = np.flatnonzero((wanted >= own[0]) & (wanted <= own[-1])) if len(own) else np.empty(0, int)
        if len(inside):
            after = np.clip(np.searchsorted(own, wanted[inside], side="left"), 0, len(own) - 1)
            before = np.where(own[after] == wanted[inside], after, after - 1)
            span = own[after] - own[before]
            t = np.divide(wanted[inside] - own[before], span, out=np.zeros_like(span), where=span > 0)
            a, b = self.table[forward[before]], self.table[forward[after]]
            table[inside] = a + t[:, None] * (b - a)
            table[inside, QUAT] = arrays.slerp(a[:, QUAT], b[:, QUAT], t)
            flags[inside] = self.flags[forward[before]] | self.flags[forward[after]]
            torn = inside[span > max_gap]
            table[torn], flags[torn] = np.nan, flags[torn] | np.uint32(LOST | GAP)
        table[:, QUAT] = arrays.continuous(table[:, QUAT])
        return replace(self, time=wanted, table=table, flags=flags)

    def to(self, frame: Frame, body: str | ArrayLike | None = None) -> Attitude:
        """The same attitude in another Earth frame: "enu", "ned" or "nwu"; sigma follows.

        *body* also renames the body's axes, as in :meth:`Recording.remap`: ``to("ned", body="y x -z")`` is what an
        autopilot expects of a sensor whose axes are right, forward, up.
        """
        if frame not in _FROM_ENU or self.frame not in _FROM_ENU:
            raise RecordingError(f"cannot go from frame {self.frame!r} to {frame!r}; frames are enu, ned, nwu")
        change = arrays.multiply(_FROM_ENU[frame], arrays.conjugate(_FROM_ENU[self.frame]))
        table = self.table.copy()
        table[:, QUAT] = arrays.multiply(change, self.quat)
        if _SIGMA_ORDER[frame] != _SIGMA_ORDER[self.frame]:
            table[:, SIGMA] = self.sigma[:, [1, 0, 2]]
        if body is not None:
            turn = axes.rotation_matrix(body)
            table[:, QUAT] = arrays.multiply(table[:, QUAT], arrays.conjugate(arrays.from_matrix(turn)))
            for columns in (RATE, BIAS):
                table[:, columns] = table[:, columns] @ turn.T
            table[:, BIAS_SIGMA] = np.sqrt(table[:, BIAS_SIGMA] ** 2 @ (turn**2).T)
        return replace(self, table=table, frame=frame)

    # -- exits ----------------------------------------------------------------------------------------------------

    def as_rotation(self) -> Rotation:
        """A scipy ``Rotation``, body to Earth. Raises :class:`RecordingError` where rows have no attitude: slice them off."""
        from scipy.spatial.transform import Rotation

        unknown = int(np.sum(~np.isfinite(self.quat).all(axis=1)))
        if unknown:
            raise RecordingError(
                f"{unknown} of {len(self)} rows have no attitude, which a Rotation cannot hold; "
                "take attitude[attitude.valid] first"
            )
        return Rotation.from_quat(self.quat_xyzw)

    def columns(self) -> dict[str, NDArray[Any]]:
        """Every column by name: time, qw…qz, rate, bias, sigma, bias_sigma, flags, valid."""
        xyz = "xyz"
        named: dict[str, NDArray[Any]] = {"time": self.time}
        named |= {f"q{axis}": self.quat[:, i] for i, axis in enumerate("wxyz")}
        for name in ("rate", "bias", "sigma", "bias_sigma"):
            named |= {f"{name}_{axis}": getattr(self, name)[:, i] for i, axis in enumerate(xyz)}
        return named | {"flags": self.flags, "valid": self.valid}

    def metadata(self) -> dict[str, str]:
        """What a file must say beside the columns: frame, order, units, method, parameters, version, source."""
        from poise.version import __version__

        learned = {} if self.learned is None else {"poise.learned": self.learned.as_json()}
        return {
            "poise.kind": "attitude",
            "poise.version": __version__,
            "poise.frame": self.frame,
            "poise.quaternion": f"w x y z, Hamilton, body to {'other body' if self.frame == 'body' else self.frame.upper()}",
            "poise.units": "time s; rate, bias, bias_sigma rad/s; sigma rad",
            "poise.heading_reference": self.heading_reference,
            "poise.flags": json.dumps({flag.name: int(flag) for flag in Flag}),
            "poise.method": self.provenance.method,
            "poise.parameters": json.dumps(dict(self.provenance.parameters)),
            "poise.source": self.provenance.source,
            "poise.source_sha256": self.provenance.source_hash,
            **learned,
        }

    def to_arrow(self) -> pyarrow.Table:
        """An Arrow table with :meth:`columns` and, as its schema's metadata, :meth:`metadata`."""
        return arrow.table(self.columns()).replace_schema_metadata(self.metadata())

    def to_frame(self, backend: Literal["pandas", "polars"] = "pandas") -> Any:
        """A pandas or polars data frame of :meth:`columns`."""
        return arrow.frame(self.columns(), backend)

    def reasons(self, bridge: float = 0.25) -> list[Reason]:
        """Every flagged stretch with its start, end and a sentence, in order of time.

        Stretches of one flag less than *bridge* (s) apart are told as one.
        """
        return reasons(self.time, self.flags, bridge)

    def resets(self) -> list[Reset]:
        """Every row at which the attitude was set anew, and by how much that turned it.

        Whoever integrates or controls on the attitude takes the turn out instead of following it.
        """
        return resets(self.time, self.quat, self.flags)
