"""The points of a tile's buildings (J 5.3.1): outlines moved to the points, then each point to one outline.

Only points that can be building take part: class 6 where the cloud is classified, otherwise what stands high above
the ground.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..geometry.grid import Grid
from ..io.points.point_buckets import stable_order
from ..io.points.pointcloud import PointLayout
from ..io.points.whole_records import record_rows
from ..progress import SILENT, Progress
from ..settings.buildings import PAPER, SegmentationParameters
from .building_points import coordinates
from .outlines.candidate_points import assign_candidates
from .outlines.courtyards import with_courtyards
from .outlines.footprint import Footprints
from .outlines.outline_placement import place_outlines
from .outlines.segmented_buildings import TREES, SegmentedBuildings
from .outlines.tile_ground import ground_of_points, heights_above
from .point_assignment import Assignment, points_in_expanded
from .seen.cloud_cover import cloud_cover

_ON_GROUND = 1.0
"""Height (m) above the ground up to which a point shows that a place is open."""


@dataclass(frozen=True)
class Tile:
    """One piece of work: the outlines in and near a square, and the points round them."""

    layout: PointLayout
    records: np.ndarray
    footprints: Footprints
    rows: np.ndarray
    inside: np.ndarray
    density: float
    parameters: SegmentationParameters
    ground: tuple[Grid, np.ndarray] | None = field(default=None)


def segment_tile(tile: Tile, progress: Progress = SILENT) -> tuple[np.ndarray, SegmentedBuildings, np.ndarray]:
    """Rows, table and sorted records of the buildings that a tile owns."""
    points, polygons = tile.layout.view(tile.records), tile.footprints.polygons
    x, y, z = coordinates(tile.layout, tile.records)
    classes = np.asarray(points.classification)
    ground = tile.ground or ground_of_points(x, y, z, classes, polygons, progress)
    table = SegmentedBuildings.empty(tile.footprints)
    if tile.parameters.method == PAPER:
        return _segment_as_paper(tile, table, x, y, ground)
    if tile.parameters.maximum_displacement and len(x):
        place_outlines(table, points, (x, y, z), tile.density, ground, tile.parameters.maximum_displacement, progress)
    progress.check()
    outlines, above = table.outlines, np.full(len(z), np.inf)
    if ground and len(x):
        above = heights_above(x, y, z, ground, outlines, tile.density)
        outlines[:] = with_courtyards(outlines, x, y, above < _ON_GROUND, tile.density)
    last = np.asarray(points.return_number) >= np.asarray(points.number_of_returns)
    assignment, trees = assign_candidates(x, y, z, classes, above, last, outlines, tile.parameters)
    assigned = np.flatnonzero((assignment.owner >= 0) & tile.inside[assignment.owner])
    order = assigned[stable_order(assignment.owner[assigned])]
    table.count_points(assignment, outlines, ground)
    table.status[trees] = TREES
    table.count_open(polygons, outlines)
    cover = cloud_cover(x, y, last, outlines, tile.density)
    table.cloud_density[:], table.beyond[:] = cover.density, cover.beyond
    return _of_tile(tile, table, order, assignment.owner[order])


def _segment_as_paper(tile: Tile, table: SegmentedBuildings, x: np.ndarray, y: np.ndarray,
                      ground: tuple[Grid, np.ndarray] | None) -> tuple[np.ndarray, SegmentedBuildings, np.ndarray]:
    """As `segment_tile`, by J 5.3.1 alone: every point within the expanded outline, outlines as given."""
    table.shift_status[:] = "kept"
    point, building, primary = points_in_expanded(x, y, table.outlines, tile.parameters.expansion)
    table.count_points(Assignment(building, primary), table.outlines, ground)
    assigned = tile.inside[building]
    return _of_tile(tile, table, point[assigned], building[assigned])


def _of_tile(tile: Tile, table: SegmentedBuildings, order: np.ndarray,
             owner: np.ndarray) -> tuple[np.ndarray, SegmentedBuildings, np.ndarray]:
    """Rows and table of the tile's own buildings, and their records: points `order` (m,) of the buildings `owner`."""
    records = record_rows(tile.records, order)
    records["building_id"] = tile.footprints.ids[owner]
    return tile.rows[tile.inside], table.select(tile.inside), records
