"""The fault matrix: each fault with the figures that are asked of an attitude."""

from __future__ import annotations

from typing import Literal, NamedTuple

from fault_bench.injectors import (
    GRAVITY,
    Injector,
    absent,
    batched,
    bias_step,
    bursts,
    clipped,
    clock_jump,
    duplicates,
    fixed,
    from_then_on,
    hard_iron,
    jitter,
    link_lost,
    loss,
    scaled_stamps,
    spikes,
    stamps,
    stuck,
    swaps,
)

NAN, INF = float("nan"), float("inf")


class Demand(NamedTuple):
    """A figure and what it has to be."""

    figure: str
    """a name in what :func:`fault_bench.judging.judge` gives"""
    limit: float
    kind: Literal["at most", "at least"] = "at most"
    unit: str = ""
    of: Literal["worst", "median"] = "worst"
    flagship: bool = False
    """asked of the flagship only"""

    def met(self, value: float) -> bool:
        """Whether a figure passes; one that is NaN does not apply."""
        if value != value:
            return True
        return value <= self.limit if self.kind == "at most" else value >= self.limit

    @property
    def sentence(self) -> str:
        """The demand in words."""
        number = f"{100 * self.limit:g} %" if self.unit == "%" else f"{self.limit:g}"
        unit = "" if self.unit in ("", "%") else self.unit if self.unit == "°" else f" {self.unit}"
        sign = "≤" if self.kind == "at most" else "≥"
        return f"{self.figure} {sign} {number}{unit}{' (median)' if self.of == 'median' else ''}"


class Fault(NamedTuple):
    """A row of the matrix."""

    group: str
    name: str
    inject: Injector
    demands: tuple[Demand, ...]
    sensor: str = ""
    """whose flags announce it"""
    back: float = 2.0
    """deg from the clean run or the reference at which an attitude is back"""
    refusal: str | None = None
    """what a refusal has to say, where one passes; "" for any words"""

    @property
    def key(self) -> str:
        """Its name for people and seeds."""
        return f"{self.group} {self.name}"


def ratio(limit: float) -> Demand:
    return Demand("ratio", limit)


def deviation(limit: float) -> Demand:
    return Demand("deviation", limit, unit="°")


def recovery(limit: float) -> Demand:
    return Demand("recovery", limit, unit="s")


def latency(limit: float) -> Demand:
    return Demand("latency", limit, unit="s")


FLAGGED = Demand("flagged", 1.0, "at least", "%")
ONE_PERIOD = 0.004  # s: "at the first row after", for rows of 3.5 ms


def _one_row() -> list[Fault]:
    demands = (deviation(1.0), recovery(1.0), ratio(1.02))
    bad = [("NaN", NAN, ("gyr", "acc", "mag", "gyr acc mag")), ("inf", INF, ("gyr", "acc", "mag"))]
    bad += [("1e30", 1e30, ("gyr", "acc", "mag")), ("zero", 0.0, ("gyr", "acc", "mag"))]
    return [
        Fault(
            "E2", f"one row of {'all' if ' ' in s else s} {word}", fixed(s, value, 0.0), demands, s.split()[0], back=0.5
        )
        for word, value, sensors in bad
        for s in sensors
    ]


def _second_of_nan() -> list[Fault]:
    demands = (deviation(2.0), recovery(2.0))
    return [Fault("E3", f"1 s of NaN in {s}", fixed(s, NAN, 1.0), demands, s, back=1.0) for s in ("acc", "mag")]


def _lost() -> list[Fault]:
    found = []
    for seconds, limit in ((1.0, 10.0), (10.0, 5.0)):
        after = (recovery(limit), Demand("bias", 0.1, unit="deg/s"), ratio(1.1))
        gyr, link = (latency(0.05), *after), (latency(ONE_PERIOD), *after)
        found.append(Fault("E4", f"gyr lost for {seconds:g} s", fixed("gyr", NAN, seconds), gyr, "gyr", back=5.0))
        found.append(Fault("E4", f"link lost for {seconds:g} s", link_lost(seconds), link, "", back=5.0))
    return found


def _rows_and_stamps() -> list[Fault]:
    return [
        Fault("E5", "5 % of rows lost", loss(0.05), (ratio(1.1),)),
        Fault("E5", "30 % of rows lost", loss(0.30), (ratio(1.2),)),
        Fault("E5", "20 % jitter", jitter(0.20), (ratio(1.05),)),
        Fault("E5", "1 % of rows twice", duplicates(0.01), (ratio(1.02),)),
        Fault("E5", "1 % of rows swapped", swaps(0.01), (ratio(1.02),)),
        Fault("E5", "stamps in batches of 4-12", batched(4, 12), (ratio(1.1),)),
        Fault("E5", "stamps in bursts of 4-12", bursts(4, 12, 50e-6), (ratio(1.1),)),
    ]


def _clock() -> list[Fault]:
    demands = (latency(0.05), ratio(1.02))
    unusable = Demand("refused or never valid", 1.0, "at least", "%")
    return [
        Fault("E6", "clock back 10 s", clock_jump(-10.0), demands),
        Fault("E6", "clock forward 1 h", clock_jump(3600.0), demands),
        Fault("E6", "one stamp NaN", stamps(NAN, 0.0), demands),
        Fault("E6", "stamps zero for 1 s", stamps(0.0, 1.0), demands),
        Fault("E6", "all stamps zero", scaled_stamps(0.0), (unusable,), refusal=""),
        Fault("E6", "stamps in ms", scaled_stamps(1e3), (unusable,), refusal="0.001"),
        Fault("E6", "stamps in µs", scaled_stamps(1e6), (unusable,), refusal="1e-06"),
    ]


def _saturated() -> list[Fault]:
    demands = (
        Demand("flagged", 0.99, "at least", "%"),
        Demand("sigma growth", 1.01, "at least"),
        Demand("valid again", 10.0, unit="s"),
        Demand("misled", 0.0, unit="%"),
    )
    return [
        Fault("E7", "gyr clipped", clipped("gyr", 0.01, 1.0), demands, "gyr"),
        Fault("E7", "acc clipped", clipped("acc", 0.01, 1.2 * GRAVITY), demands, "acc"),
    ]


def _spiky() -> list[Fault]:
    return [
        Fault("E8", "acc spikes, 1 %, 50 m/s²", spikes("acc", 0.01, 50.0), (ratio(1.1),), "acc"),
        Fault("E8", "gyr spikes, 0.1 %, 10 rad/s", spikes("gyr", 0.001, 10.0), (ratio(1.1),), "gyr"),
        Fault("E8", "mag spikes, 1 %, 500 µT", spikes("mag", 0.01, 500.0), (ratio(1.1),), "mag"),
    ]


def _stuck() -> list[Fault]:
    found = []
    for sensor, limit in (("acc", 10.0), ("mag", 2.0), ("gyr", None)):
        turning = sensor == "gyr"
        demands = (latency(0.25), *([] if limit is None else [deviation(limit)]), recovery(10.0))
        found.append(Fault("E9", f"{sensor} stuck for 5 s", stuck(sensor, 5.0, turning), demands, sensor))
        found.append(Fault("E9", f"{sensor} zero for 5 s", fixed(sensor, 0.0, 5.0, turning), demands, sensor))
    return found


def _without_magnetometer() -> list[Fault]:
    level = (Demand("inclination ratio", 1.05), latency(1.0))
    covered = Demand("covered", 0.95, "at least", "%")
    return [
        *(
            Fault("E10", f"mag {word} for 30 s", fixed("mag", value, 30.0), (*level, covered, recovery(10.0)), "mag")
            for word, value in (("zero", 0.0), ("NaN", NAN))
        ),
        *(
            Fault("E10", f"mag {word} for ever", from_then_on("mag", value), (*level, covered), "mag")
            for word, value in (("zero", 0.0), ("NaN", NAN))
        ),
        Fault("E10", "no mag at all", absent, level, "mag"),
    ]


def _flagship() -> list[Fault]:
    silent = Demand("silent heading", 0.0, unit="%", flagship=True)
    iron = (
        Demand("heading", 10.0, unit="°", flagship=True),
        Demand("flagged later", 0.9, "at least", "%", flagship=True),
    )
    step = (Demand("ratio", 1.2, of="median", flagship=True), Demand("ratio", 2.0, flagship=True))
    return [
        Fault("E11", "hard iron 30 µT for 30 s", hard_iron(30.0, 30.0), (*iron, silent), "mag"),
        Fault("E11", "hard iron 30 µT for ever", hard_iron(30.0, None), (silent,), "mag"),
        Fault("E12", "gyr bias step 2 deg/s", bias_step(2.0), step, "gyr"),
    ]


FAULTS: tuple[Fault, ...] = tuple(
    fault
    for part in (
        _one_row,
        _second_of_nan,
        _lost,
        _rows_and_stamps,
        _clock,
        _saturated,
        _spiky,
        _stuck,
        _without_magnetometer,
        _flagship,
    )
    for fault in part()
)
