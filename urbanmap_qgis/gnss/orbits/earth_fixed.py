"""Between the map (projected CRS, its heights) and the earth-fixed frame of the satellites."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from pyproj import Transformer

from ...errors import InputError
from ...geometry.earth import curvature_radii, earth_fixed
from ...io.reference.system_parts import metric_plane
from ...wording import say

SPEED_OF_LIGHT = 299792458.0  # m/s
_NORTH_STEP = 20.0  # m, over which grid north is taken


@dataclass(frozen=True)
class EarthPlaces:
    """Places of the map on the earth.

    Attributes
    ----------
    earth_fixed : (n, 3) m (WGS 84).
    latitude, longitude : (n,) rad.
    axes : (n, 3, 3) rows are grid east, grid north and up as earth-fixed unit vectors.
    convergence : (n,) azimuth of grid north from true north, rad: true azimuth = grid azimuth + convergence.
    """

    earth_fixed: np.ndarray
    latitude: np.ndarray
    longitude: np.ndarray
    axes: np.ndarray
    convergence: np.ndarray


class MapFrame:
    """A projected CRS with its heights.

    Parameters
    ----------
    crs_wkt : of the map; of a compound CRS the horizontal part is used.
    geoid_separation : ellipsoidal less map height, m: 0 for ellipsoidal heights.

    Raises
    ------
    InputError : the CRS is missing, not projected, not in metres, or not known to PROJ.
    """

    def __init__(self, crs_wkt: str, geoid_separation: float = 0.0):
        crs = metric_plane(say("The map"), crs_wkt)
        self.geoid_separation = float(geoid_separation)
        self._to_degrees = Transformer.from_crs(crs, "EPSG:4326", always_xy=True)

    def places(self, place: np.ndarray) -> EarthPlaces:
        """Where places (n, 3), east, north, height, lie on the earth.

        Raises
        ------
        InputError : a place lies outside the area of the CRS.
        """
        place = np.asarray(place, float)
        longitude, latitude = self._geographic(place[:, 0], place[:, 1])
        further_lon, further_lat = self._geographic(place[:, 0], place[:, 1] + _NORTH_STEP)
        if not (np.isfinite(longitude).all() and np.isfinite(further_lat).all()):
            raise InputError(say("The trajectory lies outside the area of its CRS: check the CRS."))
        lower, meridian = curvature_radii(latitude)
        convergence = np.arctan2((further_lon - longitude) * lower * np.cos(latitude),
                                 (further_lat - latitude) * meridian)
        return EarthPlaces(earth_fixed(latitude, longitude, place[:, 2] + self.geoid_separation), latitude, longitude,
                           _axes(latitude, longitude, convergence), convergence)

    def _geographic(self, east: np.ndarray, north: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        # One place too many: pyproj takes an array of one for a number.
        longitude, latitude = self._to_degrees.transform(np.append(east, east[-1:]), np.append(north, north[-1:]))
        return np.radians(longitude[:-1]), np.radians(latitude[:-1])


def _axes(latitude: np.ndarray, longitude: np.ndarray, convergence: np.ndarray) -> np.ndarray:
    sin_lat, cos_lat, sin_lon, cos_lon = np.sin(latitude), np.cos(latitude), np.sin(longitude), np.cos(longitude)
    east = np.stack([-sin_lon, cos_lon, np.zeros_like(latitude)], axis=-1)
    north = np.stack([-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat], axis=-1)
    up = np.stack([cos_lat * cos_lon, cos_lat * sin_lon, sin_lat], axis=-1)
    cos, sin = np.cos(convergence)[:, None], np.sin(convergence)[:, None]
    return np.stack([cos * east - sin * north, sin * east + cos * north, up], axis=1)


def directions(axes: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """(n, 3) unit vectors to grid east, grid north and up of earth-fixed vectors (n, 3), by axes (n, 3, 3)."""
    local = np.einsum("nij,nj->ni", axes, vectors)
    return local / np.linalg.norm(local, axis=1, keepdims=True)


def elevation_azimuth(direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Elevation and azimuth from grid north, rad, of unit vectors (n, 3)."""
    east, north, up = np.ascontiguousarray(direction.T)
    return np.arcsin(np.clip(up, -1.0, 1.0)), np.arctan2(east, north) % (2 * np.pi)
