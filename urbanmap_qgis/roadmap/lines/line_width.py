"""How wide the paint of lines is, from marking points of mobile surveys.

An image of pixels as large as the paint is wide shows where a line lies, not how wide it is: its outlines are off by
the blur of the image and by where its threshold lies, both ways. Points of a survey are denser than the paint is wide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.ndimage import gaussian_filter1d
from scipy.spatial import cKDTree

from ...geometry.tolerances import LEAST_DIVISOR


@dataclass(frozen=True)
class LineWidthLimits:
    """Limits of widths, each with its unit."""

    stretch: float = 2.0  # Stretches of a line over which a survey lies at one distance beside it, m.
    beside: float = 0.20  # Points so far beyond the paint's rough half width tell where it ends, m.
    least_points: int = 15  # A stretch of fewer does not tell where its middle lies.
    groups: int = 4  # Stretches are taken in so many groups, whose widths tell how sure the width is.
    bin: float = 0.005  # Of the profile across the line, m.
    blur: float = 0.015  # Standard deviation by which the profile is smoothed, m.
    edge: float = 0.5  # The paint ends where the density of points has fallen to this share of that in its middle.
    soft: tuple[float, float] = (0.25, 0.75)  # Shares between which the edge is soft.
    known: float = 0.03  # A width with a larger standard deviation is not known, m.
    alike: float = 0.15  # Outlines of two lines are alike in width where they differ by no more than this share.
    least_lines: int = 5  # So many lines with known widths tell what an image's outlines are off by.


LIMITS = LineWidthLimits()

_SOFT_OF_BLUR = 1.349
"""Distance of the quartiles of a normal distribution, in its standard deviations."""

UNKNOWN = (float("nan"), float("nan"))


def line_widths(courses: Sequence[np.ndarray], outlined: np.ndarray, ragged: np.ndarray,
                drives: Sequence[np.ndarray]) -> np.ndarray:
    """Widths of lines and their standard deviations (lines, 2), m; NaN where they cannot be told to `LIMITS.known`.

    Parameters
    ----------
    courses : centre line (n, 2) of each line, m.
    outlined : (lines,) width of the outlines of its paint, m.
    ragged : (lines,) spread of that width from cross-section to cross-section, m.
    drives : marking points (m, 2) of each drive, m, on their own: drives lie a little beside each other.

    Points of a survey come first. A line that they do not show takes the width of its outlines, less what the outlines
    of lines alike are too wide by, where enough of these are measured; else that of its outlines where these are sharp:
    an outline is off by about as much as it is ragged.
    """
    trees = [cKDTree(points) for points in drives if len(points)]
    outlined = np.asarray(outlined, float)
    found = np.array([_measured(course, width, trees) for course, width in zip(courses, outlined)]).reshape(-1, 2)
    found = _as_lines_alike(found, outlined)
    sharp_outline = np.isnan(found[:, 0]) & (3.0 * np.asarray(ragged) <= LIMITS.known)
    return np.where(sharp_outline[:, None], np.column_stack([outlined, ragged]), found)


def _measured(course: np.ndarray, rough: float, trees: Sequence[cKDTree]) -> tuple[float, float]:
    """Width of a line and its sigma, m, by the drives that show it."""
    seen = [each for each in (_by_drive(course, rough, tree) for tree in trees) if np.isfinite(each).all()]
    if not seen:
        return UNKNOWN
    width, spread, soft = np.array(seen).T
    weight = 1.0 / (spread ** 2 + soft ** 2)
    mean = float((weight * width).sum() / weight.sum())
    # Drives that disagree by more than they say of themselves: their scatter counts.
    scatter = (weight * (width - mean) ** 2).sum() / max(len(seen) - 1, 1)
    # Soft edges are soft for the same reasons in all drives.
    shared = float((weight * soft).sum() / weight.sum())
    sigma = float(np.hypot(np.sqrt(max(scatter, 1.0) * (weight ** 2 * spread ** 2).sum()) / weight.sum(), shared))
    return (mean, sigma) if sigma <= LIMITS.known else UNKNOWN


def _by_drive(course: np.ndarray, rough: float, tree: cKDTree) -> tuple[float, float, float]:
    """Width, and its standard deviations by scatter and by soft edges, m, as the points of one drive show them, all
    stretches laid over each other; NaN where they do not."""
    chainage, across = _across(course, rough / 2.0 + LIMITS.beside, tree)
    stretch = np.floor(chainage / LIMITS.stretch).astype(int)
    profiles = [across[stretch == number] for number in np.unique(stretch)]
    profiles = [offset - np.median(offset) for offset in profiles if len(offset) >= LIMITS.least_points]
    if len(profiles) < LIMITS.groups:
        return (np.nan,) * 3
    right, left, soft = _edges(np.concatenate(profiles), rough)
    parts = np.array([_edges(np.concatenate(profiles[first::LIMITS.groups]), rough)[:2]
                      for first in range(LIMITS.groups)])
    spread = float(np.std(parts[:, 1] - parts[:, 0], ddof=1)) / np.sqrt(LIMITS.groups)
    # What the smoothing alone makes of a sharp edge is known.
    beyond = np.sqrt(max(soft ** 2 - (_SOFT_OF_BLUR * LIMITS.blur) ** 2, 0.0))
    return left - right, float(np.hypot(spread, LIMITS.bin)), float(beyond)


def _across(course: np.ndarray, reach: float, tree: cKDTree) -> tuple[np.ndarray, np.ndarray]:
    """Chainage of the points near a line and their offset to the left of it, m."""
    line = shapely.LineString(course)
    stations = shapely.get_coordinates(shapely.line_interpolate_point(line, np.arange(0.0, line.length, reach)))
    near = np.unique(np.concatenate([np.zeros(0, np.int64), *map(np.asarray, tree.query_ball_point(
        stations, 1.5 * reach))]).astype(np.int64))
    points = tree.data[near]
    chainage = shapely.line_locate_point(line, shapely.points(points))
    begin = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(course, axis=0), axis=1))])
    part = np.clip(np.searchsorted(begin, chainage, "right") - 1, 0, len(course) - 2)
    along = np.diff(course, axis=0)[part]
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), LEAST_DIVISOR)
    off = points - course[part]
    across = along[:, 0] * off[:, 1] - along[:, 1] * off[:, 0]
    inner = (np.abs(across) <= reach) & (chainage > 0.0) & (chainage < line.length)
    return chainage[inner], across[inner]


def _edges(offset: np.ndarray, rough: float) -> tuple[float, float, float]:
    """Right and left edge of the paint, and how soft they are, m, by offsets (m,) of points; NaN where one is not
    seen: the points reach as far as they are looked for."""
    half = rough / 2.0 + LIMITS.beside
    bins = np.arange(-half, half + LIMITS.bin / 2.0, LIMITS.bin)
    counts = np.histogram(offset, np.append(bins - LIMITS.bin / 2.0, bins[-1] + LIMITS.bin / 2.0))[0]
    density = gaussian_filter1d(counts.astype(float), LIMITS.blur / LIMITS.bin)
    middle = float(np.median(offset))
    inside = density[np.abs(bins - middle) <= max(0.3 * rough, LIMITS.bin)]
    level = float(np.median(inside))
    if level <= 0.0:
        return (np.nan,) * 3
    crossings = [[_falls_to(bins, density, middle, share * level, side) for side in (-1, 1)]
                 for share in (LIMITS.edge, *LIMITS.soft)]
    (right, left), outer, inner = crossings
    return right, left, float(outer[1] - outer[0] - (inner[1] - inner[0])) / 2.0


def _falls_to(bins: np.ndarray, density: np.ndarray, middle: float, level: float, side: int) -> float:
    """Where the density falls to a level first, going out from the middle to one side, m; NaN where it does not."""
    outward = np.flatnonzero(bins >= middle) if side > 0 else np.flatnonzero(bins <= middle)[::-1]
    low = np.flatnonzero(density[outward] < level)
    if not len(low) or low[0] == 0:
        return float("nan")
    before, after = outward[low[0] - 1], outward[low[0]]
    share = (density[before] - level) / max(density[before] - density[after], LEAST_DIVISOR)
    return float(bins[before] + share * (bins[after] - bins[before]))


def _as_lines_alike(found: np.ndarray, rough: np.ndarray) -> np.ndarray:
    """Widths with those of lines that are not measured, by the outlines of lines alike that are."""
    known = np.isfinite(found[:, 0])
    widths = found.copy()
    for number in np.flatnonzero(~known):
        alike = known & (np.abs(rough - rough[number]) <= LIMITS.alike * rough[number])
        if alike.sum() < LIMITS.least_lines:
            continue
        excess = rough[alike] - found[alike, 0]
        usual = float(np.median(excess))
        spread = float(np.std(excess, ddof=1) * np.sqrt(1.0 + 1.0 / alike.sum()))
        spread = float(np.hypot(spread, np.median(found[alike, 1])))
        if spread <= LIMITS.known:
            widths[number] = rough[number] - usual, spread
    return widths
