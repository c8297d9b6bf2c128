"""Roofs of one building by the paper's histogram alone (J 5.3.2, to the letter)."""

from __future__ import annotations

import numpy as np
import shapely

from ...settings.buildings import RoofParameters
from .height_histogram import PARAPET_SHARE, HeightPeaks, height_histogram, height_peaks, minimum_points
from .roof_segmentation import NO_POINTS, NO_ROOFS, OK, RoofSegmentation, RoofTable


def paper_roofs(x: np.ndarray, y: np.ndarray, z: np.ndarray, outline: shapely.Geometry, density: float,
                parameters: RoofParameters) -> RoofSegmentation:
    """Roofs of a building from the height histogram of the points in its primary outline (J 5.3.2).

    Local maxima of at least alpha = `min_roof_area` times `density` points are roofs; consecutive ones are one
    roof where the histogram between them stays above beta. No other rule applies: two parts of one height are one
    roof, and a building without such a maximum has none. A roof's points are those of the expanded outline in its
    height interval: up to where the histogram is emptiest between two roofs, up to the highest point in the primary
    outline for the highest roof, and down to the first local minimum below the lowest.

    Parameters
    ----------
    x, y, z : (n,) all points in the expanded outline, m.
    outline : the primary outline.
    density : points/m2 of the scan (J: d).
    parameters : `bin_width`, `bin_shift`, `min_roof_area` and `parapet_threshold` are used; beta is by default
        `PARAPET_SHARE` of alpha, as the paper gives no number.
    """
    x, y, z = (np.asarray(a, dtype=float) for a in (x, y, z))
    shapely.prepare(outline)
    primary = z[shapely.contains_xy(outline, x, y)]
    alpha = minimum_points(parameters.min_roof_area, density)
    beta = PARAPET_SHARE * alpha if parameters.parapet_threshold is None else parameters.parapet_threshold
    peaks = height_peaks(primary, parameters.bin_width, parameters.bin_shift, alpha=alpha, beta=beta)
    if not len(peaks):
        return RoofSegmentation(np.zeros(len(z), np.int32), NO_ROOFS, NO_POINTS)
    roof = peaks.assign(z) + 1
    roof[(z < lower_limit(primary, peaks, parameters.bin_width, parameters.bin_shift)) | (z > primary.max())] = 0
    return RoofSegmentation(roof.astype(np.int32), _table(z, roof, len(peaks), density), OK)


def lower_limit(z: np.ndarray, peaks: HeightPeaks, bin_width: float, bin_shift: float) -> float:
    """Height (m) of the first local minimum of the histogram of z (n,) below the lowest roof's maximum."""
    centre, count = height_histogram(z, bin_width, bin_shift)
    place = int(np.argmin(np.abs(centre - peaks.height[0])))
    while place > 0 and count[place - 1] <= count[place] and count[place] > 0:
        place -= 1
    return float(centre[place])


def _table(z: np.ndarray, roof: np.ndarray, count: int, density: float) -> RoofTable:
    """Table of the roofs: `height_max` is the paper's height; the area follows from points and density."""
    heights_of = [z[roof == number] for number in range(1, count + 1)]
    height = np.array([np.median(values) for values in heights_of])
    points = np.array([len(values) for values in heights_of])
    rmse = np.array([np.sqrt(np.mean((values - level) ** 2)) for values, level in zip(heights_of, height)])
    highest = np.array([values.max() for values in heights_of])
    return RoofTable(np.arange(1, count + 1, dtype=np.int32), height, highest, points,
                     points / density, np.full(count, float(density)), rmse)
