"""How far apart neighbouring lane lines lie: lanes are about 3 m wide everywhere, so that a pixel size that is said
wrong shows in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.spatial import cKDTree


@dataclass(frozen=True)
class LaneSpacingLimits:
    """Limits of lane spacing, each with its unit."""

    most: int = 3000  # strokes: the longest
    shortest: float = 1.2  # m
    slender: float = 6.0  # times its width that a stroke is long
    width: float = 0.6  # m
    parallel: float = 4.0  # degrees
    in_line: float = 0.35  # m off the other's axis
    gap: float = 15.0  # m between strokes of one line
    line: float = 8.0  # m from which a stroke is a line of its own
    spacing: tuple[float, float] = (0.9, 9.0)  # m between lines that are looked at


LIMITS = LaneSpacingLimits()


@dataclass(frozen=True)
class LaneSpacing:
    """Median distance, m, of neighbouring parallel lines, and the length, m, over which lines have a neighbour."""

    spacing: float
    length: float


NO_SPACING = LaneSpacing(0.0, 0.0)


def lane_spacing(polygons: Sequence[shapely.Polygon], area: np.ndarray, length: np.ndarray, width: np.ndarray
                 ) -> LaneSpacing:
    """Spacing of the lines among markings.

    Parameters
    ----------
    polygons : (n,) in any unit, which their areas tell.
    area : (n,) m2.
    length, width : (n,) of the strokes, m.
    """
    strokes = np.flatnonzero((length > LIMITS.shortest) & (width < LIMITS.width) & (length > LIMITS.slender * width))
    strokes = strokes[np.argsort(-length[strokes], kind="stable")[:LIMITS.most]]
    if len(strokes) < 2:
        return NO_SPACING
    chosen = np.array([polygons[int(number)] for number in strokes])
    middle, along, half = _axes(chosen, float(np.sqrt(area[strokes].sum() / shapely.area(chosen).sum())))
    first, second = cKDTree(middle).query_pairs(LIMITS.gap + 2 * LIMITS.line, output_type="ndarray").T
    first, second = np.concatenate([first, second]), np.concatenate([second, first])
    offset = middle[second] - middle[first]
    ahead = np.einsum("ij,ij->i", offset, along[first])
    aside = offset[:, 0] * along[first, 1] - offset[:, 1] * along[first, 0]
    parallel = np.abs(np.einsum("ij,ij->i", along[first], along[second])) > np.cos(np.deg2rad(LIMITS.parallel))
    follows = parallel & (np.abs(aside) < LIMITS.in_line) & (np.abs(ahead) - half[first] - half[second] < LIMITS.gap)
    line = 2 * half > LIMITS.line
    line[first[follows]] = True
    shared = np.minimum(half[first], ahead + half[second]) - np.maximum(-half[first], ahead - half[second])
    low, high = LIMITS.spacing
    beside = parallel & line[first] & line[second] & (shared > 0) & (np.abs(aside) > low) & (np.abs(aside) < high)
    return _nearest(first[beside], aside[beside], shared[beside])


def _axes(polygons: np.ndarray, metres: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Middles (n, 2) in m, unit vectors (n, 2) along, and half the lengths (n,) in m of strokes in a unit of so many
    metres."""
    middle, along, half = np.empty((len(polygons), 2)), np.empty((len(polygons), 2)), np.empty(len(polygons))
    for number, polygon in enumerate(polygons):
        points = shapely.get_coordinates(polygon.exterior)[:-1] * metres
        middle[number] = points.mean(axis=0)
        axes = np.linalg.svd(points - middle[number], full_matrices=False)[2]
        along[number] = axes[0]
        half[number] = np.ptp(points @ axes[0]) / 2
    return middle, along, half


def _nearest(line: np.ndarray, aside: np.ndarray, shared: np.ndarray) -> LaneSpacing:
    """Median over lines of the distance of the nearest on either side, weighted by what they share."""
    key = 2 * line + (aside > 0)
    order = np.lexsort((np.abs(aside), key))
    chosen = order[np.flatnonzero(np.diff(key[order], prepend=-1))]
    if not len(chosen):
        return NO_SPACING
    chosen = chosen[np.argsort(np.abs(aside[chosen]), kind="stable")]
    total = np.cumsum(shared[chosen])
    return LaneSpacing(float(np.abs(aside[chosen])[np.searchsorted(total, total[-1] / 2)]), float(total[-1]))
