"""Whether a metre of a reference system is a metre on the ground: the point scale of its projection where the data lie.

Snyder, Map Projections: A Working Manual (USGS 1987), 4: the scale of a projection differs from place to place; of a
Mercator for the web it is 1.23 at Tokyo, so that areas there are half too large.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from pyproj import Proj
from pyproj.exceptions import ProjError

from ...errors import InputError
from ...progress import notice
from ...wording import say
from .plane_rectangular import ZONE_NAMES, zone_epsg, zone_numbers
from .system_parts import parsed_crs, plan_part

REFUSED, TOLD = 0.01, 5e-4
"""Differences of the scale from 1: none within the zone of a survey's projection, and that of a UTM zone's rim."""

_JAPAN = (122.0, 20.0, 154.0, 46.0)
"""Least and greatest longitude and latitude, degrees."""


def point_scale(wkt: str, x: float, y: float) -> tuple[float, float, float] | None:
    """Lengths in a projected system for one on the ground at a place, mean of all directions, with its longitude and
    latitude, degrees; None where the system is not projected or does not know the place."""
    try:
        plan = plan_part(parsed_crs(wkt))
        if not plan.is_projected:
            return None
        projection = Proj(plan)
        longitude, latitude = projection(x, y, inverse=True, errcheck=True)
        factors = projection.get_factors(longitude, latitude, errcheck=True)
    except (InputError, ProjError):
        return None
    scale = float(np.sqrt(factors.areal_scale))
    return (scale, float(longitude), float(latitude)) if np.isfinite([scale, longitude, latitude]).all() else None


def require_true_lengths(name: str, wkt: str | None, bounds: Sequence[float]) -> None:
    """Refuse data in a projection whose lengths are not those on the ground; tell of small differences.

    Parameters
    ----------
    name : of the data, for messages.
    bounds : x_min, y_min, x_max, y_max of the data in the system.

    Raises
    ------
    InputError : the scale differs from 1 by more than 1 %, with a system that fits the place.
    """
    if not wkt or not np.isfinite(bounds).all():
        return
    middle = (bounds[0] + bounds[2]) / 2, (bounds[1] + bounds[3]) / 2
    corners = ((x, y) for x in bounds[::2] for y in bounds[1::2])
    found = [scaled for place in (middle, *corners) if (scaled := point_scale(wkt, *place)) is not None]
    if not found:
        return
    # Of a box that a stray point makes large, the place where lengths are best.
    scale, longitude, latitude = min(found, key=lambda scaled: abs(scaled[0] - 1.0))
    if abs(scale - 1.0) > REFUSED:
        raise InputError(say("{name}: in {crs} lengths at this place are {scale:.3f} times those on the ground; "
                             "reproject to a system whose metres are metres, such as {zone}. If the data lie "
                             "elsewhere, they are in another system than they say.", name=name, crs=plan_part(
                                 parsed_crs(wkt)).name, scale=scale, zone=metric_zone(longitude, latitude)))
    if abs(scale - 1.0) > TOLD:
        notice(say("{name}: in {crs} lengths at this place are {scale:.5f} times those on the ground; so are "
                   "the lengths of the results.", name=name, crs=plan_part(parsed_crs(wkt)).name,
                   scale=scale))


def metric_zone(longitude: float, latitude: float) -> str:
    """A projected system for a place (degrees): Japan's plane rectangular zone there, else UTM."""
    west, south, east, north = _JAPAN
    if west <= longitude <= east and south <= latitude <= north:
        zone = int(zone_numbers(longitude, latitude)[0])
        return f"EPSG:{zone_epsg(zone)} (JGD2011 / Japan Plane Rectangular CS {ZONE_NAMES[zone - 1]})"
    zone = int((longitude + 180.0) // 6) % 60 + 1
    half, code = ("N", 32600) if latitude >= 0 else ("S", 32700)
    return f"EPSG:{code + zone} (WGS 84 / UTM zone {zone}{half})"
