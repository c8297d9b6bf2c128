"""The points of a tile's buildings (J 5.3.1): outlines moved to the points, then each point to one outline.

Only points that can be building take part: class 6 where the cloud is classified, otherwise what stands high above
the ground.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import shapely

from ..errors import InsufficientDataError
from ..geometry.grid import Grid
from ..geometry.sampling import sample
from ..geometry.tolerances import LEAST_DIVISOR
from ..io.points.point_buckets import stable_order
from ..io.points.pointcloud import PointLayout
from ..progress import SILENT, Progress
from ..terrain.surface import ground_raster
from .base_height import outline_ground
from .building_points import coordinates
from .outlines.courtyards import with_courtyards
from .outlines.decks import ground_without_decks
from .outlines.displacement import estimate_displacements, shifted_outlines
from .outlines.evidence import BUILDING_CLASS, EvidenceAccumulator, evidence_cell
from .outlines.footprint import Footprints
from .point_assignment import Assignment, assign_points, points_in_expanded
from .seen.cloud_cover import cloud_cover
from .unclassified_roofs import unclassified_roof_points


@dataclass(frozen=True)
class TileSegmentationLimits:
    """Limits of tile segmentation, each with its unit."""

    ground_cell: float = 1.0  # Side (m) of the cells of the ground heights that are made where none are given.
    # LAS classes that are never roofs: ground, vegetation, water, road surface, bridge deck.
    not_building: tuple[float, ...] = (2, 3, 4, 5, 9, 11, 17)
    # Class 6 is trusted for a building where it holds at least this share of its high points.
    min_classed_share: float = 0.2
    min_roof_points: int = 3
    on_ground: float = 1.0  # Height (m) above the ground up to which a point shows that a place is open.


LIMITS = TileSegmentationLimits()

BUFFER = 60.0
"""Reach (m) beyond a tile within which points and outlines are seen: wide enough for ground round blocks."""

FULL, PAPER = "full", "paper"
"""Methods: outlines adjusted and candidate points chosen, or all points in the expanded outlines as in the paper."""


@dataclass(frozen=True)
class SegmentationParameters:
    """What the user can set.

    Attributes
    ----------
    expansion : m by which outlines are expanded (J 5.3.1: "pre-defined threshold").
    minimum_height : m above ground from which an unclassified point may be building.
    maximum_displacement : m by which an outline may be moved to its points; 0 leaves them in place.
    method : `FULL` or `PAPER`, which uses the expansion only: outlines stay in place, all points in the expanded
        outline are the building's, and a point in several is written once for each.
    """

    expansion: float = 1.0
    minimum_height: float = 2.0
    maximum_displacement: float = 2.5
    method: str = FULL


@dataclass(frozen=True)
class SegmentedBuildings:
    """One row a footprint.

    Attributes
    ----------
    outlines : (n,) outlines at their found places.
    points : (n,) points given to the building.
    density : (n,) points inside the outline a m2.
    ground : (n,) lowest ground height along the outline, m; NaN where it is not known.
    open_share : (n,) share of the outline that was cut out as open ground (courtyards).
    cloud_density : (n,) pulses a m2 of the cloud round the outline; NaN where it was not looked for.
    beyond : (n,) share of the outline beyond the cloud's edge.
    shift_x, shift_y, shift_sigma : (n,) displacement that was applied and its standard deviation, m.
    status : (n,) words: "ok", or what is missing.
    """

    outlines: np.ndarray
    points: np.ndarray
    density: np.ndarray
    ground: np.ndarray
    shift_x: np.ndarray
    shift_y: np.ndarray
    shift_sigma: np.ndarray
    shift_status: np.ndarray
    status: np.ndarray
    open_share: np.ndarray
    cloud_density: np.ndarray
    beyond: np.ndarray

    @classmethod
    def empty(cls, footprints: Footprints) -> SegmentedBuildings:
        """Rows for buildings of which nothing is known yet."""
        count = len(footprints)
        return cls(footprints.polygons.copy(), np.zeros(count, np.int64), np.zeros(count),
                   np.full(count, np.nan), np.zeros(count), np.zeros(count), np.full(count, np.nan),
                   np.full(count, "not observable", object), np.full(count, "no points", object),
                   np.zeros(count), np.full(count, np.nan), np.full(count, np.nan))

    def put(self, rows: np.ndarray, part: SegmentedBuildings) -> None:
        """Fill in the rows that a tile has worked out."""
        for name in self.__dataclass_fields__:
            getattr(self, name)[rows] = getattr(part, name)


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
    points = tile.layout.view(tile.records)
    x, y, z = coordinates(tile.layout, tile.records)
    classes = np.asarray(points.classification)
    ground = tile.ground or _made_ground(x, y, z, classes, tile.footprints.polygons, progress)
    if tile.parameters.method == PAPER:
        return _segment_as_paper(tile, x, y, ground)
    outlines, table = _placed_outlines(tile, x, y, z, classes, points, ground, progress)
    progress.check()
    above = np.full(len(z), np.inf)
    if ground and len(x):
        above = z - ground_without_decks(outlines, x, y, z, sample(*ground, x, y), tile.density)
        outlines[:] = with_courtyards(outlines, x, y, above < LIMITS.on_ground, tile.density)
    several = np.asarray(points.number_of_returns) > 1
    assignment = _assign_candidates(x, y, z, classes, above, several, outlines, tile.parameters)
    assigned = np.flatnonzero((assignment.owner >= 0) & tile.inside[assignment.owner])
    order = assigned[stable_order(assignment.owner[assigned])]
    records = tile.records[order]
    records["building_id"] = tile.footprints.ids[assignment.owner[order]]
    _count_points(table, assignment, outlines, ground)
    table.open_share[:] = _open_shares(tile.footprints.polygons, outlines)
    last = np.asarray(points.return_number) >= np.asarray(points.number_of_returns)
    cover = cloud_cover(x, y, last, outlines, tile.density)
    table.cloud_density[:], table.beyond[:] = cover.density, cover.beyond
    mine = SegmentedBuildings(*(getattr(table, name)[tile.inside] for name in table.__dataclass_fields__))
    return tile.rows[tile.inside], mine, records


def _open_shares(given: np.ndarray, outlines: np.ndarray) -> np.ndarray:
    """Share (n,) of each given outline that was cut out as open ground."""
    before, after = shapely.area(given), shapely.area(outlines)
    return np.where(before > 0, np.clip(1.0 - after / np.maximum(before, LEAST_DIVISOR), 0.0, 1.0), 0.0)


def _segment_as_paper(tile: Tile, x: np.ndarray, y: np.ndarray, ground: tuple[Grid, np.ndarray] | None
                      ) -> tuple[np.ndarray, SegmentedBuildings, np.ndarray]:
    """As `segment_tile`, by J 5.3.1 alone: every point within the expanded outline, outlines as given."""
    table = SegmentedBuildings.empty(tile.footprints)
    table.shift_status[:] = "kept"
    point, building, primary = points_in_expanded(x, y, table.outlines, tile.parameters.expansion)
    _count_points(table, Assignment(building, primary), table.outlines, ground)
    assigned = tile.inside[building]
    records = tile.records[point[assigned]]
    records["building_id"] = tile.footprints.ids[building[assigned]]
    mine = SegmentedBuildings(*(getattr(table, name)[tile.inside] for name in table.__dataclass_fields__))
    return tile.rows[tile.inside], mine, records


def _made_ground(x: np.ndarray, y: np.ndarray, z: np.ndarray, classes: np.ndarray,
                 polygons: np.ndarray, progress: Progress) -> tuple[Grid, np.ndarray] | None:
    """Ground heights of a tile from its own points, None where they hold no ground."""
    if not len(x):
        return None
    x_min, y_min, x_max, y_max = shapely.total_bounds(polygons)
    grid = Grid.covering(max(x.min(), x_min - BUFFER), max(y.min(), y_min - BUFFER),
                         min(x.max(), x_max + BUFFER), min(y.max(), y_max + BUFFER), LIMITS.ground_cell)
    try:
        return grid, ground_raster(x, y, z, classes if classes.any() else None, grid, progress=progress)
    except InsufficientDataError:
        return None


def _placed_outlines(tile: Tile, x: np.ndarray, y: np.ndarray, z: np.ndarray, classes: np.ndarray,
                     points: object, ground: tuple[Grid, np.ndarray] | None, progress: Progress
                     ) -> tuple[np.ndarray, SegmentedBuildings]:
    """Outlines of a tile moved to their points, and the table's first columns."""
    table = SegmentedBuildings.empty(tile.footprints)
    reach = tile.parameters.maximum_displacement
    if not reach or not len(x):
        return table.outlines, table
    margin = reach + 5.0
    x_min, y_min, x_max, y_max = shapely.total_bounds(tile.footprints.polygons)
    grid = Grid.covering(x_min - margin, y_min - margin, x_max + margin, y_max + margin,
                         evidence_cell(tile.density))
    evidence = EvidenceAccumulator(grid)
    evidence.add(x, y, z, classes, np.asarray(points.return_number), np.asarray(points.number_of_returns))
    centre_x, centre_y = np.meshgrid(*grid.centres())
    heights = (sample(*ground, centre_x.ravel(), centre_y.ravel()).reshape(grid.shape) if ground
               else np.full(grid.shape, np.nan))
    shifts = estimate_displacements(tile.footprints.polygons, evidence.evidence(heights), grid,
                                    evidence.surface, reach, progress)
    table.outlines[:] = shifted_outlines(tile.footprints.polygons, shifts)
    table.shift_x[:], table.shift_y[:], table.shift_sigma[:] = shifts.dx, shifts.dy, shifts.sigma
    table.shift_status[:] = shifts.status
    return table.outlines, table


def _assign_candidates(x: np.ndarray, y: np.ndarray, z: np.ndarray, classes: np.ndarray, above: np.ndarray,
                       several: np.ndarray, outlines: np.ndarray, parameters: SegmentationParameters) -> Assignment:
    """Owners of the points that can be building: by class where it can be trusted, else by height."""
    owner = np.full(len(x), -1, np.int64)
    primary = np.zeros(len(x), bool)
    open_to_all = np.ones(256, bool)
    open_to_all[[*LIMITS.not_building, BUILDING_CLASS]] = False
    high = np.flatnonzero(open_to_all[classes] & ~(above < parameters.minimum_height))

    def assign(candidates: np.ndarray, wanted: np.ndarray) -> Assignment:
        found = assign_points(x[candidates], y[candidates], z[candidates], wanted, parameters.expansion)
        taken = found.owner >= 0
        owner[candidates[taken]], primary[candidates[taken]] = found.owner[taken], found.primary[taken]
        return found

    classed = np.flatnonzero(classes == BUILDING_CLASS)
    if not len(classed):
        assign(high, outlines)
        return Assignment(owner, primary & (owner >= 0))
    found = assign(classed, outlines)
    others = assign_points(x[high], y[high], np.zeros(len(high)), outlines, 0.0)
    trusted = _trusted_classes(found, others, len(outlines))
    owner[(owner >= 0) & ~trusted[owner]] = -1
    other_rows, found_rows = (_rows_by_owner(claims.owner, len(outlines)) for claims in (others, found))
    for row in np.flatnonzero(trusted):
        mine, known = high[other_rows[row]], classed[found_rows[row]]
        density = np.count_nonzero(found.primary[found_rows[row]]) / outlines[row].area
        roof = mine[unclassified_roof_points(x[mine], y[mine], z[mine], several[mine], x[known], y[known],
                                             outlines[row], max(density, 0.1))]
        owner[roof], primary[roof] = row, True
    assign(high, np.where(trusted, None, outlines))
    return Assignment(owner, primary & (owner >= 0))


def _rows_by_owner(owner: np.ndarray, count: int) -> list[np.ndarray]:
    """Ascending numbers of the points of each of `count` buildings; `owner` (n,) is -1 where there is none."""
    order = stable_order(owner + 1)
    ends = np.cumsum(np.bincount(owner + 1, minlength=count + 1))
    return [order[start:end] for start, end in zip(ends, ends[1:])]


def _trusted_classes(found: Assignment, others: Assignment, count: int) -> np.ndarray:
    """Mask of the buildings whose class 6 points (`found`) describe them: enough, and not few beside the `others`."""
    classed = np.bincount(found.owner[found.primary & (found.owner >= 0)], minlength=count)
    unclassed = np.bincount(others.owner[others.owner >= 0], minlength=count)
    return (classed >= LIMITS.min_roof_points) & (classed >= LIMITS.min_classed_share * (classed + unclassed))


def _count_points(table: SegmentedBuildings, assignment: Assignment, outlines: np.ndarray,
                  ground: tuple[Grid, np.ndarray] | None) -> None:
    """Fill in points, density, ground height and status."""
    count = len(outlines)
    table.points[:] = np.bincount(assignment.owner[assignment.owner >= 0], minlength=count)
    inside = np.bincount(assignment.owner[assignment.primary], minlength=count)
    table.density[:] = inside / np.maximum(shapely.area(outlines), LEAST_DIVISOR)
    if ground is not None:
        table.ground[:] = outline_ground(outlines, *ground)
    table.status[:] = np.where(table.points >= LIMITS.min_roof_points, "ok",
                               np.where(table.points > 0, "too few points", "no points"))
