"""Between the city's projected coordinates and the earth-fixed frame of the satellites."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyproj

GEOID_SEPARATION = 36.60
"""Ellipsoidal height minus orthometric height in the city, m (near that of central Tokyo)."""

SEMI_MAJOR, FLATTENING = 6378137.0, 1 / 298.257222101
"""GRS 80, the ellipsoid of JGD2011 (within 0.1 mm of that of WGS 84, from which it is not told apart here)."""


@dataclass(frozen=True)
class CityFrame:
    """The place of the city on the earth.

    Attributes
    ----------
    latitude, longitude : of the middle, rad.
    grid : (3, 3) rows are grid east, grid north and up at the middle in the earth-fixed frame; grid north differs
        from true north by the meridian convergence.
    """

    latitude: float
    longitude: float
    grid: np.ndarray
    transformer: pyproj.Transformer

    @classmethod
    def of(cls, crs: str, x: float, y: float, z: float) -> CityFrame:
        """Frame of a city whose middle is at x, y, z of the projected CRS (east, north, orthometric height)."""
        system = pyproj.CRS.from_user_input(crs)
        transformer = pyproj.Transformer.from_crs(system, system.geodetic_crs, always_xy=True)
        longitude, latitude = np.radians(transformer.transform(x, y))
        step = 10.0 * np.eye(3)
        middle = np.array([x, y, z])
        difference = _earth_fixed(transformer, middle + step) - _earth_fixed(transformer, middle - step)
        grid = difference / np.linalg.norm(difference, axis=1, keepdims=True)
        return cls(float(latitude), float(longitude), grid, transformer)

    def earth_fixed(self, xyz: np.ndarray) -> np.ndarray:
        """(n, 3) earth-fixed places (m) of (n, 3) projected east, north and orthometric height."""
        return _earth_fixed(self.transformer, np.asarray(xyz, float))

    def directions(self, vectors: np.ndarray) -> np.ndarray:
        """(..., 3) unit vectors to grid east, grid north and up of earth-fixed vectors (..., 3)."""
        local = vectors @ self.grid.T
        return local / np.linalg.norm(local, axis=-1, keepdims=True)

    def true_azimuth(self, vectors: np.ndarray) -> np.ndarray:
        """(...) azimuth from true north, rad, of earth-fixed vectors (..., 3)."""
        sin_lat, cos_lat = np.sin(self.latitude), np.cos(self.latitude)
        sin_lon, cos_lon = np.sin(self.longitude), np.cos(self.longitude)
        east = vectors @ np.array([-sin_lon, cos_lon, 0.0])
        north = vectors @ np.array([-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat])
        return np.arctan2(east, north)


def _earth_fixed(transformer: pyproj.Transformer, xyz: np.ndarray) -> np.ndarray:
    longitude, latitude = np.radians(transformer.transform(xyz[:, 0], xyz[:, 1]))
    height = xyz[:, 2] + GEOID_SEPARATION
    squared = FLATTENING * (2 - FLATTENING)
    curvature = SEMI_MAJOR / np.sqrt(1 - squared * np.sin(latitude) ** 2)
    return np.column_stack([(curvature + height) * np.cos(latitude) * np.cos(longitude),
                            (curvature + height) * np.cos(latitude) * np.sin(longitude),
                            (curvature * (1 - squared) + height) * np.sin(latitude)])
