"""Latitudes and longitudes of tables: degrees, or degrees, minutes and seconds, laid into a plane system.

They are taken in the datum of the system chosen, as SBET's are. Headings and kappas that count from true north are
turned by the meridian convergence of their place.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from pyproj import CRS, Proj, Transformer
from pyproj.exceptions import ProjError

from ..errors import InputError
from ..io.files.columns import LATITUDE as LATITUDE_NAMES
from ..io.files.columns import LONGITUDE as LONGITUDE_NAMES
from ..io.files.named_table import WRITTEN_NUMBER
from ..io.reference.plane_rectangular import zone_epsg, zone_numbers
from ..io.reference.system_parts import metric_plane
from ..wording import say

LATITUDE = ("latitude", "latitude_minutes", "latitude_seconds")
LONGITUDE = ("longitude", "longitude_minutes", "longitude_seconds")
POLAR = (*LATITUDE, *LONGITUDE)
"""Columns of places on the ellipsoid; minutes and seconds have columns of their own, or stand in one with degrees."""

POLAR_ALIASES = {
    **dict.fromkeys(LATITUDE_NAMES[1:], "latitude"), **dict.fromkeys(LONGITUDE_NAMES[1:], "longitude"),
    **dict.fromkeys(("latmin", "latminutes", "latitudemin", "latitudeminutes", "緯度分"), "latitude_minutes"),
    **dict.fromkeys(("latsec", "latseconds", "latitudesec", "latitudeseconds", "緯度秒"), "latitude_seconds"),
    **dict.fromkeys(("lonmin", "longmin", "lonminutes", "longitudemin", "longitudeminutes", "経度分"),
                    "longitude_minutes"),
    **dict.fromkeys(("lonsec", "longsec", "lonseconds", "longitudesec", "longitudeseconds", "経度秒"),
                    "longitude_seconds")}
"""The column by other names of it, as `named_table.plain_name` gives them."""

_SIGNS = re.compile("[\\s°º˚度分秒′″’”'\":]+|(?<=\\d)-(?=\\d)|(?<=\\d)[dDmM](?=[\\s\\d])")
"""What stands between degrees, minutes and seconds in one cell."""

_JAPAN = (122.4, 20.2, 154.1, 46.0)  # west, south, east, north of Japan's islands, degrees
_NOT_JAPAN = ((122.4, 34.9, 129.95, 46.0), (122.4, 37.5, 135.9, 46.0), (122.4, 42.0, 139.2, 46.0),
              (141.0, 45.6, 145.0, 46.0), (122.4, 29.0, 127.9, 34.9))
"""Boxes within, where other countries lie: Korea, the coast of Russia, Sakhalin, China."""


def degrees_of(cells: Sequence[str]) -> float | None:
    """Degrees in cells: one with degrees, or with degrees, minutes and seconds, or one for each; None for no angle."""
    text = " ".join(cell.strip() for cell in cells)
    if WRITTEN_NUMBER.match(text):
        return float(text)
    negative = text[:1] in "-−SWsw" if text else False
    letters = re.sub(r"[NSEWnsew北南東西緯経]", " ", text.lstrip("+-−"))
    negative |= bool(re.search("[SWsw南西]", text))
    parts = [part for part in _SIGNS.sub(" ", letters).split() if part]
    if not 1 <= len(parts) <= 3 or not all(WRITTEN_NUMBER.match(part) for part in parts):
        return None
    values = [float(part) for part in parts]
    if any(value < 0.0 for value in values) or any(value >= 60.0 for value in values[1:]):
        return None
    total = sum(value / 60.0**power for power, value in enumerate(values))
    return -total if negative else total


def suggested_crs(longitude: float, latitude: float) -> str:
    """The plane system for a place (degrees): its zone of the Japan Plane Rectangular CS (JGD2011), elsewhere of UTM.

    Near the border of two zones of Japan the nearest town says which.
    """
    if _inside(_JAPAN, longitude, latitude) and not any(_inside(box, longitude, latitude) for box in _NOT_JAPAN):
        return f"EPSG:{zone_epsg(int(zone_numbers(longitude, latitude)[0]))}"
    zone = int((longitude + 180.0) % 360.0 // 6.0) + 1
    return f"EPSG:{(32600 if latitude >= 0.0 else 32700) + zone}"


def _inside(box: tuple[float, float, float, float], longitude: float, latitude: float) -> bool:
    west, south, east, north = box
    return west <= longitude <= east and south <= latitude <= north


def placed_in(crs: str, longitude: np.ndarray, latitude: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x and y (n,), m, in a system (a code or WKT), and by how many degrees grid north is east of true north there.

    Raises
    ------
    InputError : the system is none, is not one of plane coordinates in metres, or does not reach a place.
    """
    plan = metric_plane(say("The table"), crs)
    if (np.abs(latitude) > 90.0).any() or (np.abs(longitude) > 360.0).any():
        raise InputError(say("A latitude is beyond 90°, or a longitude beyond 360°: choose other columns."))
    try:
        x, y = Transformer.from_crs(plan.geodetic_crs, plan, always_xy=True).transform(longitude, latitude)
        convergence = np.asarray(Proj(plan).get_factors(longitude, latitude).meridian_convergence)
    except ProjError as error:
        raise InputError(_outside(plan)) from error
    if not np.isfinite([x, y, convergence]).all():
        raise InputError(_outside(plan))
    return np.asarray(x), np.asarray(y), convergence


def _outside(plan: CRS) -> str:
    return say("The places do not lie in {crs}: choose the system of the survey, or swap latitude and longitude.",
               crs=plan.name)
