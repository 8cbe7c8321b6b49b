"""Magnetic declination by place and date, from the world magnetic model."""

from __future__ import annotations

import math
from datetime import date as Date
from functools import cache
from typing import Any

from poise.errors import PoiseError

_FIRST, _LAST = 2010, 2029  # the years that the models cover, five each


def declination(latitude: float, longitude: float, when: Date, altitude: float = 0.0) -> float:
    """Declination D, rad, east positive: true heading = magnetic heading + D.

    *latitude*, *longitude* in degrees (north and east positive), *altitude* in m. Source: WMM-2010 to WMM-2025, the one of
    the date's five years. Raises :class:`PoiseError` outside their places and years.
    """
    if not (-90.0 <= latitude <= 90.0 and -180.0 <= longitude <= 360.0):
        raise PoiseError(f"place {latitude}, {longitude}: expected latitude in ±90 and longitude in ±180 degrees")
    if not _FIRST <= when.year <= _LAST:
        raise PoiseError(f"date {when}: the magnetic models here cover {_FIRST} to {_LAST}; give --declination instead")
    days = (Date(when.year + 1, 1, 1) - Date(when.year, 1, 1)).days
    year = when.year + (when.timetuple().tm_yday - 1) / days
    field = _model(when.year // 5 * 5).calculate(latitude, longitude, altitude / 1000.0, year)
    return math.radians(field.d)


@cache
def _model(year: int) -> Any:
    from pygeomag import GeoMag

    name = "WMM_2015v2" if year == 2015 else f"WMM_{year}"
    return GeoMag(coefficients_file=f"wmm/{name}.COF")
