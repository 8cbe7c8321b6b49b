"""Declination against the test values published with the world magnetic model."""

from __future__ import annotations

import math
from datetime import date

import pytest

from poise.errors import PoiseError
from poise.magnetic_model import declination


@pytest.mark.parametrize(
    ("when", "latitude", "longitude", "expected"),
    [  # WMM-2020 test values at 0 km: NOAA NCEI, WMM2020testvalues
        (date(2020, 1, 1), 80, 0, -1.28),
        (date(2020, 1, 1), 0, 120, 0.16),
        (date(2020, 1, 1), -80, 240, 69.36),
    ],
)
def test_published_values(when: date, latitude: float, longitude: float, expected: float) -> None:
    assert math.degrees(declination(latitude, longitude, when)) == pytest.approx(expected, abs=0.02)


@pytest.mark.parametrize(
    ("latitude", "longitude", "when", "says"),
    [(91, 0, date(2024, 1, 1), "latitude"), (0, 400, date(2024, 1, 1), "longitude"), (0, 0, date(2009, 1, 1), "2010")],
)
def test_outside_is_refused(latitude: float, longitude: float, when: date, says: str) -> None:
    with pytest.raises(PoiseError, match=says):
        declination(latitude, longitude, when)


def test_every_covered_year_has_a_model() -> None:
    values = [math.degrees(declination(52.5, 13.4, date(year, 6, 1))) for year in range(2010, 2030)]
    assert all(2.0 < a < b + 0.3 < 9.0 for a, b in zip(values, values[1:], strict=False))
