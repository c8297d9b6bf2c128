"""Partition of a building's plan into roofs: the heights of J 5.3.2, and what the paper leaves open."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from scipy import ndimage

from ...geometry.grid_regions import grid_regions
from ...settings.buildings import RoofParameters
from .height_histogram import HeightPeaks, height_peaks, minimum_points
from .region_merging import RegionGraph
from .roof_surface import RoofSurface

PIECE_THICKNESS = 0.5  # Height range of the level pieces that roofs are put together from, m.
REFINEMENTS = 5  # Rounds of moving the boundaries between roofs; each moves them by one cell at most.
# Standard deviation (m) of cell heights up to which a region is a flat roof; level pieces of slopes have
# 0.15.
FLAT_SPREAD = 0.1
# Share of a roof inside the outline below which it is a neighbour's, unless it continues a roof inside.
MIN_INSIDE = 0.25
STRIP_ELONGATION = 8.0  # Regions this many times as long as wide are strips.

SMOOTHNESS = 0.15
"""What one neighbouring cell of another roof weighs beside squared height errors, in distinct_step squared.

Small enough that a real edge stays where the heights put it, large enough that single cells do not stand out.
"""

MAX_PARAPET_WIDTH = 2.0
"""Narrower strips that stand a little above their roof are its parapet, m."""


@dataclass(frozen=True)
class RoofLevels:
    """Roofs of a building in plan.

    Attributes
    ----------
    labels : (rows, columns) int, 1..k the roofs, 0 = none.
    height : (rows, columns) m, without gaps: a cell without a height of its own has that of the nearest one.
    measured : (rows, columns) bool, cells with a height of their own that is no tree.
    peaks : the roofs of the paper.
    """

    labels: np.ndarray
    height: np.ndarray
    measured: np.ndarray
    peaks: HeightPeaks


def roof_levels(surface: RoofSurface, z: np.ndarray, density: float, outline_area: float,
                   parameters: RoofParameters) -> RoofLevels:
    """Cut a building's plan into roofs.

    Parameters
    ----------
    surface : raster of the building.
    z : (n,) heights of the points the raster was made from, m.
    density : points/m2.
    outline_area : m2.
    """
    measured = surface.count > 0
    nearest = ndimage.distance_transform_edt(~measured, return_distances=False, return_indices=True)
    height = surface.height[tuple(nearest)]
    covered = cv2.morphologyEx(measured.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8)) > 0

    in_outline = surface.inside.ravel()[surface.cell_of_point]
    smallest_roof = min(parameters.min_roof_area, parameters.min_roof_share * outline_area)
    peaks = height_peaks(z[in_outline], parameters.bin_width, parameters.bin_shift,
                         alpha=minimum_points(smallest_roof, density), beta=parameters.parapet_threshold)

    smooth = cv2.medianBlur(height.astype(np.float32), 3).astype(float)
    # Single cells far off their neighbours are walls or clutter; they must not weigh as errors of the roof.
    height = np.where(np.abs(height - smooth) > parameters.distinct_step, smooth, height)
    labels = _pieces(smooth, covered, peaks, parameters)
    smallest = min(parameters.small_roof_area, outline_area / 4) / surface.grid.cell**2
    labels = _join(labels, height, peaks, smallest, parameters)
    if parameters.height_rmse:
        labels = _refine(labels, height, parameters)
    labels, parapet = _without_slivers(labels, height, smallest, surface.grid.cell, parameters)
    measured = measured & ~parapet if (measured & ~parapet).any() else measured
    labels = _of_this_building(labels, height, surface.inside, smallest, parameters)
    return RoofLevels(labels, height, measured, peaks)


def _pieces(height: np.ndarray, covered: np.ndarray, peaks: HeightPeaks,
            parameters: RoofParameters) -> np.ndarray:
    """Connected pieces of the plan that are level within PIECE_THICKNESS and in one roof of the paper."""
    inner = height[covered]
    piece = np.maximum(peaks.assign(inner), 0)
    if parameters.height_rmse:
        # The cuts lie where they meet the fewest cells: a flat roof must not fall apart along a cut.
        steps = 5
        fine = np.floor((inner - inner.min()) * (steps / PIECE_THICKNESS)).astype(np.int64)
        phase = np.bincount(fine % steps, minlength=steps)
        shift = int(np.argmin(phase + np.roll(phase, 1)))
        level = (fine - shift) // steps + 1
        piece = piece * (level.max() + 1) + level
    classes = np.zeros(height.shape, dtype=np.int64)
    classes[covered] = piece + 1
    return grid_regions(classes)


def _join(labels: np.ndarray, height: np.ndarray, peaks: HeightPeaks, smallest: float,
          parameters: RoofParameters) -> np.ndarray:
    """Join pieces to roofs."""
    graph = RegionGraph(labels, height)
    graph.absorb_small(smallest, parameters.distinct_step)
    if parameters.height_rmse:
        graph.merge_to_tolerance(parameters.height_rmse, parameters.distinct_step)
    return graph.lookup()[labels]


def _refine(labels: np.ndarray, height: np.ndarray, parameters: RoofParameters) -> np.ndarray:
    """Move boundaries: each cell goes to the roof beside it that fits its height and its neighbours best."""
    weight = SMOOTHNESS * parameters.distinct_step**2
    columns = labels.shape[1]
    offsets = np.array([i * (columns + 2) + j for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j])
    for _ in range(REFINEMENTS):
        n = np.bincount(labels.ravel())
        mean = np.bincount(labels.ravel(), height.ravel()) / np.maximum(n, 1)
        row, column = np.nonzero(_at_boundaries(labels))  # no other cell has a choice
        around = np.pad(labels, 1).ravel()[(row + 1) * (columns + 2) + column + 1 + offsets[:, None]]
        current, z = labels[row, column], height[row, column]
        best, lowest = current, None
        for candidate in (current, around[1], around[3], around[4], around[6]):
            energy = (z - mean[candidate])**2
            for beside in around:
                energy -= weight * (beside == candidate)
            energy[candidate == 0] = np.inf
            if lowest is None:
                lowest = energy
            else:
                better = energy < lowest
                best = np.where(better, candidate, best)
                lowest = np.where(better, energy, lowest)
        if np.array_equal(best, current):
            break
        labels = labels.copy()
        labels[row, column] = best
    return labels


def _at_boundaries(labels: np.ndarray) -> np.ndarray:
    """Mask of the cells of roofs that have another roof, or none, above, below, left or right of them."""
    padded = np.pad(labels, 1)
    return (labels > 0) & ((padded[:-2, 1:-1] != labels) | (padded[2:, 1:-1] != labels)
                           | (padded[1:-1, :-2] != labels) | (padded[1:-1, 2:] != labels))


def _without_slivers(labels: np.ndarray, height: np.ndarray, smallest: float, cell: float,
                     parameters: RoofParameters) -> tuple[np.ndarray, np.ndarray]:
    """Connected roofs; small ones and strips narrower than a roof are joined to their neighbours.

    With a mask of the cells of parapets: their heights are not those of the roof that they were joined to.
    """
    labels = grid_regions(labels)
    graph = RegionGraph(labels, height)
    width = _widths(labels, graph.size) * cell
    strip = (width < MAX_PARAPET_WIDTH) | (_strip_widths(labels, graph.size) * cell < MAX_PARAPET_WIDTH)
    raised = {r for r in graph.regions() if strip[r] and _is_parapet(graph, r, parameters)}
    narrow = raised | {r for r in graph.regions() if width[r] < parameters.min_roof_width}
    parapets = {r for r in raised if _is_parapet(graph, r, parameters, FLAT_SPREAD)}
    graph.absorb_small(smallest, parameters.distinct_step, narrow, parapets)
    return graph.lookup()[labels], np.isin(labels, list(parapets))


def _is_parapet(graph: RegionGraph, region: int, parameters: RoofParameters, spread: float = math.inf) -> bool:
    """Whether a narrow region rises from a neighbour by a parapet's height, with a step and not as a slope.

    `spread` : standard deviation of the heights that the neighbour may have, m.
    """
    return any(0 < graph.mean(region) - graph.mean(other) <= parameters.max_parapet
               and graph.step(region, other) >= parameters.distinct_step / 2
               and graph.squared_error(other) <= spread**2 * graph.n[other]
               for other in graph.neighbours[region])


def _widths(labels: np.ndarray, size: int) -> np.ndarray:
    """Diameter (size,) of the largest circle in each region, in cells."""
    padded = np.pad(labels, 1)
    middle = padded[1:-1, 1:-1]
    inner = ((middle == padded[:-2, 1:-1]) & (middle == padded[2:, 1:-1])
             & (middle == padded[1:-1, :-2]) & (middle == padded[1:-1, 2:]))
    # The border of the raster bounds regions like other regions do.
    distance = cv2.distanceTransform(np.pad(inner.astype(np.uint8), 1), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    widest = np.zeros(size)
    np.maximum.at(widest, labels.ravel(), distance[1:-1, 1:-1].ravel())
    # Two cells wide: no cell inside, but a square of four.
    corner = middle[:-1, :-1]
    square = (corner == middle[:-1, 1:]) & (corner == middle[1:, :-1]) & (corner == middle[1:, 1:])
    two = np.bincount(corner[square], minlength=size) > 0
    return np.maximum(2 * widest + 1, np.where(two, 2, 1))


def _strip_widths(labels: np.ndarray, size: int) -> np.ndarray:
    """Width (size,) of long strips, rings among them, from area and perimeter, in cells; inf for compact regions."""
    padded = np.pad(labels, 1)
    down, right = padded[1:] != padded[:-1], padded[:, 1:] != padded[:, :-1]
    ends = (padded[1:][down], padded[:-1][down], padded[:, 1:][right], padded[:, :-1][right])
    # Cell sides overrate the length of a line of any direction by 4 / pi on average.
    perimeter = np.bincount(np.concatenate(ends), minlength=size) * (math.pi / 4)
    area = np.bincount(labels.ravel(), minlength=size)
    width = 2 * area / np.maximum(perimeter, 1)
    length = perimeter / 2
    return np.where(length >= STRIP_ELONGATION * width, width, np.inf)


def _of_this_building(labels: np.ndarray, height: np.ndarray, inside: np.ndarray, smallest: float,
                      parameters: RoofParameters) -> np.ndarray:
    """Drop what is not this building's: outside the outline, and no continuation of a roof that is inside.

    Scraps without neighbours go too, unless nothing else is left. Labels come back as 1..k without gaps.
    """
    graph = RegionGraph(labels, height)
    inner = np.bincount(labels[inside], minlength=graph.size)
    members = {r for r in graph.regions()
                   if inner[r] >= smallest / 2 and inner[r] >= MIN_INSIDE * graph.area[r]}
    if not members:
        members = {max(graph.regions(), key=lambda r: (inner[r], graph.area[r], -r))}
    front = list(members)
    while front:
        r = front.pop()
        for other in graph.neighbours[r]:
            if other not in members and graph.step(r, other) < parameters.distinct_step:
                members.add(other)
                front.append(other)
    number = np.zeros(graph.size, dtype=np.int64)
    number[sorted(members)] = np.arange(1, len(members) + 1)
    return number[labels]
