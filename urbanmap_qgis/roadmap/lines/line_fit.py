"""Smooth centre lines of painted lines, from cross-sections of the paint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from scipy.linalg import solveh_banded
from scipy.ndimage import uniform_filter1d

from ...geometry.tolerances import LEAST_DIVISOR, SIGMA_OF_MAD

STATION = 0.1
"""Distance of the cross-sections, m."""

REACH = 0.15
"""A cross-section reaches so far beyond the paint's half width, m: less than to the partner of a double line."""

SMOOTHING = 3.0
"""Length over which the centre line is smoothed, m: what is shorter counts as ragged edges of the paint."""

CORRELATION = 0.6
"""Errors of the paint's edges are alike over so many metres."""

TOLERANCE = 0.01
"""Vertices are left out while the polyline stays so near, m."""


@dataclass(frozen=True)
class FittedLine:
    """A centre line and the paint along it.

    Attributes
    ----------
    axis : (n, 2) places at the stations, m, about `STATION` apart.
    chainage : (n,) distance along the axis, m.
    covered : (n,) whether there is paint of the line's width (the other stations are gaps).
    width : of the paint's outlines, m (median).
    ragged : spread of the single cross-sections' widths, m.
    sigma : of the axis across the line at the stations (n,), m, without what the markings' source is off.
    residual : spread of the single cross-sections' middles about the axis, m.
    """

    axis: np.ndarray
    chainage: np.ndarray
    covered: np.ndarray
    width: float
    ragged: float
    sigma: np.ndarray
    residual: float


def fit_centre_line(axis: np.ndarray, width: float, paint: shapely.STRtree) -> FittedLine | None:
    """Fit the centre line of a chain.

    Parameters
    ----------
    axis : (n, 2) rough centre line.
    width : of its strokes, m.
    paint : tree over the polygons of the markings.

    Returns
    -------
    The line, or None where fewer than three cross-sections show paint of its width.
    """
    rough = shapely.LineString(axis).simplify(0.03)
    stations = np.arange(0.0, rough.length + STATION / 2, STATION)
    place = _without_kinks(shapely.get_coordinates(shapely.line_interpolate_point(rough, stations)))
    normal = _normals(place)
    offset, across = _cross_sections(place, normal * (REACH + width / 2.0), paint)
    usual = float(np.median(across[across > 0])) if (across > 0).any() else width
    usual = float(np.clip(usual, 0.7 * width, 1.3 * width))
    covered = across >= 0.4 * usual
    good = (across >= 0.6 * usual) & (across <= 1.6 * usual)
    if good.sum() < 3:
        return None
    smooth, residual = _smoothed(offset, good)
    seen = uniform_filter1d(good.astype(float), int(2 * SMOOTHING / STATION), mode="constant") * 2 * SMOOTHING
    doubt = residual / np.sqrt(np.maximum(seen / CORRELATION, 0.5))
    beyond = _distance_to(good) * STATION
    sigma = np.hypot(doubt, 0.01 * np.maximum(0.0, beyond - 1.0))
    fitted = place + normal * smooth[:, None]
    chainage = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(fitted, axis=0), axis=1))])
    wide = float(np.median(across[good]))
    ragged = SIGMA_OF_MAD * float(np.median(np.abs(across[good] - wide)))
    return FittedLine(fitted, chainage, covered, wide, ragged, sigma, residual)


def polyline(axis: np.ndarray) -> np.ndarray:
    """The axis (n, 2) with only the vertices that it needs to stay within `TOLERANCE`."""
    return shapely.get_coordinates(shapely.LineString(axis).simplify(TOLERANCE))


def _without_kinks(place: np.ndarray) -> np.ndarray:
    """The path (n, 2) smoothed: what is left of its kinks would stay in the fitted line."""
    if len(place) < 3:
        return place
    matrix = (SMOOTHING / (2 * np.pi * STATION)) ** 4 * _second_differences(len(place))
    matrix[2] += 1.0
    origin = place.mean(axis=0)
    return solveh_banded(matrix, place - origin) + origin


def _normals(place: np.ndarray) -> np.ndarray:
    """Unit vectors (n, 2) to the left of a path."""
    tangent = np.gradient(place, axis=0)
    tangent /= np.maximum(np.linalg.norm(tangent, axis=1, keepdims=True), LEAST_DIVISOR)
    return np.column_stack([-tangent[:, 1], tangent[:, 0]])


def _cross_sections(place: np.ndarray, reach: np.ndarray, paint: shapely.STRtree) -> tuple[np.ndarray, np.ndarray]:
    """Offset (n,) of the paint's middle to the left of the path and its extent (n,) across, at each place, m.

    `reach` (n, 2) goes from the path to the left end of each cross-section.
    """
    lines = shapely.linestrings(np.stack([place - reach, place + reach], axis=1))
    normal = reach / np.linalg.norm(reach, axis=1, keepdims=True)
    station, polygon = paint.query(lines, predicate="intersects")
    pieces = shapely.intersection(lines[station], paint.geometries[polygon])
    length = shapely.length(pieces)
    middle = shapely.get_coordinates(shapely.centroid(pieces)) if len(pieces) else np.zeros((0, 2))
    side = ((middle - place[station]) * normal[station]).sum(axis=1)
    across = np.bincount(station, length, len(place))
    moment = np.bincount(station, length * side, len(place))
    return np.divide(moment, across, out=np.zeros_like(across), where=across > 0), across


def _smoothed(offset: np.ndarray, good: np.ndarray) -> tuple[np.ndarray, float]:
    """Offsets after robust smoothing by second differences, and the spread of the good ones about them."""
    weight = good.astype(float)
    stiff = (SMOOTHING / (2 * np.pi * STATION)) ** 4
    count, smooth, spread = len(offset), np.zeros(len(offset)), 0.0
    if count < 3:
        return np.full(count, offset[good].mean()), float(np.std(offset[good]))
    band = _second_differences(count)
    for _ in range(4):
        matrix = stiff * band
        matrix[2] += weight + 1e-6
        smooth = solveh_banded(matrix, weight * offset)
        deviation = np.abs(offset - smooth)
        spread = max(SIGMA_OF_MAD * float(np.median(deviation[good])), 0.004)
        weight = good * np.minimum(1.0, 2.0 * spread / np.maximum(deviation, LEAST_DIVISOR))
    return smooth, spread


def _second_differences(count: int) -> np.ndarray:
    """D2' D2 as upper band (3, count)."""
    band = np.zeros((3, count))
    for shift, first in ((0, 1.0), (1, -2.0), (2, 1.0)):
        band[2, shift:count - 2 + shift] += first * first
    band[1, 1:count - 1] += -2.0
    band[1, 2:count] += -2.0
    band[0, 2:count] += 1.0
    return band


def _distance_to(mask: np.ndarray) -> np.ndarray:
    """Number of stations (n,) from each to the nearest marked one."""
    marked = np.flatnonzero(mask)
    index = np.arange(len(mask))
    after = np.clip(np.searchsorted(marked, index), 0, len(marked) - 1)
    before = np.maximum(after - 1, 0)
    return np.minimum(np.abs(marked[after] - index), np.abs(marked[before] - index))
