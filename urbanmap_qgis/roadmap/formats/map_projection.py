"""Coordinates of a Lanelet2 file: latitude and longitude, and the local ones of Autoware with its projector file."""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np
import pyproj

from ...errors import InputError
from ...io.files.atomic import written_beside
from ...io.reference.system_parts import plan_part
from ...wording import say

PROJECTORS = ("TransverseMercator", "MGRS")
SCALE = 0.9996
"""Of Autoware's transverse Mercator projection, as in UTM."""

_BANDS = "CDEFGHJKLMNPQRSTUVWX"
_COLUMNS = {1: "ABCDEFGH", 2: "JKLMNPQR", 0: "STUVWXYZ"}
_ROWS = {1: "ABCDEFGHJKLMNPQRSTUV", 0: "FGHJKLMNPQRSTUVABCDE"}


@dataclass(frozen=True)
class MapCoordinates:
    """Coordinates of places in the ways that a Lanelet2 file gives them.

    Attributes
    ----------
    latitude, longitude : (n,) degrees.
    local : (n, 2) m in the projector's plane.
    projector : name.
    origin : latitude and longitude of the local origin.
    grid : MGRS square, or "".
    """

    latitude: np.ndarray
    longitude: np.ndarray
    local: np.ndarray
    projector: str
    origin: tuple[float, float]
    grid: str = ""


def map_coordinates(xy: np.ndarray, crs_wkt: str, projector: str = "TransverseMercator") -> MapCoordinates:
    """Coordinates of places (n, 2) of a projected CRS.

    Parameters
    ----------
    projector : "TransverseMercator" (about the middle of the map) or "MGRS" (in its square of 100 km).

    Raises
    ------
    InputError : the CRS is not on the earth, or the map lies in more than one square.
    """
    try:
        crs = pyproj.CRS.from_wkt(crs_wkt)
        back = pyproj.Transformer.from_crs(plan_part(crs), "EPSG:4326", always_xy=True)
    except pyproj.exceptions.ProjError as error:
        raise InputError(say("The lines' CRS cannot be brought to latitude and longitude, which a Lanelet2 file "
                             "needs: assign a projected CRS known to PROJ.")) from error
    longitude, latitude = back.transform(xy[:, 0], xy[:, 1])
    if not (np.isfinite(longitude).all() and np.isfinite(latitude).all()):
        raise InputError(say("Places of the map have no latitude and longitude in its CRS: check the CRS of the "
                             "lines."))
    if projector == "MGRS":
        return _in_mgrs(np.asarray(latitude), np.asarray(longitude))
    origin = (round(float(np.mean(latitude)), 6), round(float(np.mean(longitude)), 6))
    plane = pyproj.Proj(proj="tmerc", lat_0=origin[0], lon_0=origin[1], k=SCALE, ellps="WGS84")
    local = np.column_stack(plane(longitude, latitude))
    return MapCoordinates(np.asarray(latitude), np.asarray(longitude), local, projector, origin)


def _in_mgrs(latitude: np.ndarray, longitude: np.ndarray) -> MapCoordinates:
    zone = int((np.mean(longitude) + 180.0) // 6.0) + 1
    plane = pyproj.Proj(proj="utm", zone=zone, south=bool(np.mean(latitude) < 0), ellps="WGS84")
    utm = np.column_stack(plane(longitude, latitude))
    square = np.unique(np.floor(utm / 1e5).astype(int), axis=0)
    if len(square) > 1:
        raise InputError(say("The map lies in more than one MGRS square, in which Autoware's local coordinates would "
                             "repeat: take the projector TransverseMercator."))
    east, north = square[0]
    band = _BANDS[min(int((np.mean(latitude) + 80.0) // 8.0), len(_BANDS) - 1)]
    grid = f"{zone}{band}{_COLUMNS[zone % 3][east - 1]}{_ROWS[zone % 2][north % 20]}"
    return MapCoordinates(latitude, longitude, utm - square[0] * 1e5, "MGRS",
                          (float(np.mean(latitude)), float(np.mean(longitude))), grid)


def write_projector(path: str | os.PathLike, coordinates: MapCoordinates, vertical_datum: str) -> None:
    """Write Autoware's map_projector_info.yaml; `vertical_datum` is "WGS84", "EGM2008" or "" (not stated)."""
    lines = [f"projector_type: {coordinates.projector}"]
    if vertical_datum:
        lines.append(f"vertical_datum: {vertical_datum}")
    else:
        lines.append("# vertical_datum: heights are those of the lines given; their system was not stated")
    if coordinates.grid:
        lines.append(f"mgrs_grid: {coordinates.grid}")
    else:
        latitude, longitude = coordinates.origin
        lines += ["map_origin:", f"  latitude: {latitude:.6f}", f"  longitude: {longitude:.6f}"]
    with written_beside(path) as temporary:
        temporary.write_text("\n".join(lines) + "\n", encoding="utf-8")
