"""Corners of buildings by a surface raster (DSM), where Z 3.2 ties its survey to one.

Raised cells are those above the lowest height round them; along the outline of such cells each edge is drawn anew
where the surface falls through half of its step, and two edges meet in a corner. The surface holds the highest of what
lies in a cell: its edges are those of the roofs, outside of walls by what eaves stand out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree

from ...geometry.tolerances import SIGMA_OF_MAD
from ...io.raster import RasterSampler
from ...progress import SILENT, Progress
from ..trajectory import Trajectory
from .reference_corners import MAX_ANGLE, MIN_ANGLE, MIN_EDGE, BuildingCorners, joined_corners

STEP = 2.5  # m: neighbouring heights this far apart are a building's edge
AROUND = 8.0  # m: the ground of a cell is the lowest height so near
WINDOW = 512  # cells of a window that is read at once, without its margin
STRAIGHT = 1.5  # cells that a straight edge's cells lie off it at the most
ACROSS = 3.0  # cells looked at on either side of an edge
SEEN = 0.6  # share of an edge's length that must show the step
OUTLYING = 3.0  # times the noise beyond which a place of an edge counts no more


@dataclass(frozen=True)
class _Edge:
    """A straight edge: a point on it (2,), its unit direction (2,), in cells; noise of its places about it."""

    place: np.ndarray
    along: np.ndarray
    noise: float


def surface_corners(surface: RasterSampler, trajectory: Trajectory, max_distance: float,
                    progress: Progress = SILENT) -> BuildingCorners:
    """Corners of what stands higher than 2.5 m above its surroundings in a surface, within reach of a course.

    Parameters
    ----------
    surface : heights, m, in the trajectory's coordinate system.
    max_distance : corners farther from the course are left out, m.
    """
    grid, found = surface.grid, []
    margin = int(np.ceil((AROUND + 2 * MIN_EDGE) / grid.cell))
    windows = list(_windows(surface, trajectory, max_distance))
    for number, (row, column) in enumerate(windows):
        progress.step(number / len(windows))
        rows = slice(max(row - margin, 0), min(row + WINDOW + margin, grid.rows))
        columns = slice(max(column - margin, 0), min(column + WINDOW + margin, grid.columns))
        corners = raster_corners(surface.read(rows, columns), grid.cell)
        cells = corners.place + np.array([columns.start, rows.start])
        within = ((cells >= (column, row)) & (cells < (column + WINDOW, row + WINDOW))).all(axis=1)
        place = np.column_stack([grid.x_min + cells[within, 0] * grid.cell, grid.y_max - cells[within, 1] * grid.cell])
        found.append(BuildingCorners(place, corners.edge[within] * (1.0, -1.0), corners.length[within] * grid.cell))
    return joined_corners(found)


def _windows(surface: RasterSampler, trajectory: Trajectory, max_distance: float) -> Iterator[tuple[int, int]]:
    """First row and column of the windows that come near the course."""
    grid, size = surface.grid, WINDOW * surface.grid.cell
    course = cKDTree(trajectory.place[:, :2])
    for row in range(0, grid.rows, WINDOW):
        for column in range(0, grid.columns, WINDOW):
            middle = grid.x_min + column * grid.cell + size / 2, grid.y_max - row * grid.cell - size / 2
            if course.query(middle)[0] <= max_distance + size * np.sqrt(0.5):
                yield row, column


def raster_corners(heights: np.ndarray, cell: float) -> BuildingCorners:
    """Corners in a raster of heights (r, c), m, with NaN where nothing is known; places and lengths in cells, x to the
    right and y down from the raster's corner."""
    known = np.where(np.isfinite(heights), heights, np.inf)
    reach = 2 * int(np.ceil(AROUND / cell)) + 1
    ground = cv2.erode(known.astype(np.float32), np.ones((reach, reach), np.uint8), borderValue=np.inf)
    raised = (np.isfinite(heights) & (known > ground + STEP)).astype(np.uint8)
    outlines, _ = cv2.findContours(raised, cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)
    least = MIN_EDGE / cell
    filled = np.where(np.isfinite(heights), heights, np.nan)
    found = []
    for outline in outlines:
        ring = cv2.approxPolyDP(outline, STRAIGHT, True)[:, 0].astype(float)
        if len(ring) >= 3 and len(outline) >= 3 * least:
            found.append(_ring_corners(filled, ring, least))
    return joined_corners(found)


def _ring_corners(heights: np.ndarray, ring: np.ndarray, least: float) -> BuildingCorners:
    """Corners of a ring of cells (n, 2) whose two edges both show the step."""
    after = np.roll(ring, -1, axis=0)
    length = np.linalg.norm(after - ring, axis=1)
    edges = [_edge(heights, *ends) if long else None for *ends, long in zip(ring, after, length >= least)]
    places, directions, lengths = [np.empty((0, 2))], [np.empty((0, 2, 2))], [np.empty((0, 2))]
    for number, second in enumerate(edges):
        first = edges[number - 1]
        if first is None or second is None:
            continue
        turn = first.along[0] * second.along[1] - first.along[1] * second.along[0]
        angle = np.degrees(np.arccos(np.clip(-first.along @ second.along, -1.0, 1.0)))
        if not MIN_ANGLE < angle < MAX_ANGLE:
            continue
        away = second.place - first.place
        share = (away[0] * second.along[1] - away[1] * second.along[0]) / turn
        place = first.place + share * first.along
        if np.hypot(*(place - ring[number] - 0.5)) > ACROSS:
            continue
        places.append(place[None])
        directions.append(np.array([[-first.along, second.along]]))
        lengths.append(np.array([[length[number - 1], length[number]]]))
    return BuildingCorners(*map(np.concatenate, (places, directions, lengths)))


def _edge(heights: np.ndarray, start: np.ndarray, end: np.ndarray) -> _Edge | None:
    """The edge along the cells from `start` to `end` (x, y), drawn through the places where the surface falls through
    half of its step; None where too little of it shows one."""
    length = float(np.hypot(*(end - start)))
    along = (end - start) / length
    normal = np.array([-along[1], along[0]])
    # Near its ends a corner takes part.
    places = np.arange(min(ACROSS, length / 4), length - min(ACROSS, length / 4) + 0.5, 0.5)
    across = np.linspace(-ACROSS, ACROSS, 8 * int(ACROSS) + 1)
    x, y = (start[axis] + places[:, None] * along[axis] + across * normal[axis] for axis in (0, 1))
    profile = ndimage.map_coordinates(heights, [y, x], order=1, mode="nearest")
    third = len(across) // 4
    sides = np.median(profile[:, :third], axis=1), np.median(profile[:, -third:], axis=1)
    step = sides[1] - sides[0]
    with np.errstate(invalid="ignore"):
        shown = np.abs(step) > STEP
        above = (profile - (sides[0] + sides[1])[:, None] / 2) * np.sign(step)[:, None] > 0
    if np.count_nonzero(shown) < SEEN * len(places) or np.count_nonzero(shown) < 3:
        return None
    # Cells' values stand at their middles: half a cell from the raster's lattice.
    crossing = across[0] + np.count_nonzero(~above[shown], axis=1) * (across[1] - across[0]) - (across[1]
                                                                                              - across[0]) / 2
    return _line(start + 0.5, along, normal, places[shown], crossing)


def _line(start: np.ndarray, along: np.ndarray, normal: np.ndarray, places: np.ndarray,
          crossing: np.ndarray) -> _Edge | None:
    """The line through crossings at places along an edge, without outlying ones."""
    keep = np.ones(len(places), bool)
    for _ in range(4):
        if np.count_nonzero(keep) < 3:
            return None
        slope, offset = np.polyfit(places[keep], crossing[keep], 1)
        residual = crossing - offset - slope * places
        noise = max(SIGMA_OF_MAD * float(np.median(np.abs(residual[keep]))), 0.1)
        keep = np.abs(residual) < OUTLYING * noise
    direction = along + slope * normal
    return _Edge(start + offset * normal, direction / np.hypot(*direction), noise)
