"""The earth's ellipsoid, and places on it in earth-fixed coordinates."""

from __future__ import annotations

import numpy as np

WGS84 = 4326
"""EPSG code of longitude and latitude on its ellipsoid."""

SEMI_MAJOR = 6378137.0
"""Of WGS 84 and of GRS 80, m."""

_FLATTENING = 1 / 298.257223563
SQUARED_ECCENTRICITY = _FLATTENING * (2 - _FLATTENING)
"""Of WGS 84; that of GRS 80, the ellipsoid of JGD2011, is larger by 3e-11, which is 0.1 mm at the pole."""

METRES_A_DEGREE = 111_320.0
"""On the equator; along a meridian up to 0.7 % less: for distances that are told in rough."""


def curvature_radii(latitude: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Radii of curvature across and along the meridian, m, at latitudes (rad)."""
    root = np.sqrt(1 - SQUARED_ECCENTRICITY * np.sin(latitude) ** 2)
    return SEMI_MAJOR / root, SEMI_MAJOR * (1 - SQUARED_ECCENTRICITY) / root ** 3


def earth_fixed(latitude: np.ndarray, longitude: np.ndarray, height: np.ndarray) -> np.ndarray:
    """(n, 3) earth-fixed places, m, of latitudes and longitudes (rad) and ellipsoidal heights (m)."""
    across, _ = curvature_radii(latitude)
    return np.stack([(across + height) * np.cos(latitude) * np.cos(longitude),
                     (across + height) * np.cos(latitude) * np.sin(longitude),
                     (across * (1 - SQUARED_ECCENTRICITY) + height) * np.sin(latitude)], axis=-1)
