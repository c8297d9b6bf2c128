"""Roof polygons of all buildings of a cloud (J 5.3.3): blocks of buildings, one building after another."""

from __future__ import annotations

import math
from concurrent.futures import Executor
from dataclasses import dataclass, field

import numpy as np
import shapely

from ..errors import Cancelled, InsufficientDataError, trouble_words
from ..execution import checkpoint, in_order
from ..geometry.grid import Grid
from ..io.points.pointcloud import PointCloud, PointLayout
from ..progress import SILENT, Progress
from .building_points import coordinates, iter_building_blocks, require_dimension
from .outlines.footprint import Footprints
from .planes.level_alternative import (
    BETTER,
    SUSPECT,
    has_lost_plane,
    high_points,
    level_roof_numbers,
    roof_misfit,
)
from .planes.plane_detection import LEVELS, PLANES
from .planes.plane_moments import azimuth_degrees, slope_degrees
from .planes.plane_partition import partition_planes
from .polygons.outline_from_points import outline_from_points
from .polygons.roof_plan import partition_roofs
from .polygons.roof_polygon import PaperParameters, paper_roof_polygons
from .quality import PARAPET_REACH

SEGMENT_ROOFS = "Segment roofs"

CELL = (0.25, 1.0)
"""Least and greatest cell (m) of the raster on which a plan is divided; the density sets it between them."""

BLOCK_STATUS, LOST_ROOFS, SIMPLIFIED = "plain block", "lost roofs", "simplified"
LEVELS_BETTER = "level roofs fit better"


@dataclass(frozen=True)
class PolygonStageLimits:
    """Limits of polygon stage, each with its unit."""

    # A flat roof inside a parapet: so many points well inside, of no more spread (m, robust standard deviation),
    # and so much (m) below the middle of all its points.
    min_inner_points: int = 10
    flat_spread: float = 0.15
    min_parapet: float = 0.5
    # Distance (m) within which other outlines are neighbours that a building's own may not cross.
    party_wall_reach: float = 3.0


LIMITS = PolygonStageLimits()

LOST_AREA = 4.0
"""Area (m2) inside the outline from which a roof that has no polygon is missed."""

PARTITION, POINTS, PAPER = "partition", "points", "paper"
"""The methods: the outline divided without gaps, the same with an outline drawn from the points, or each roof
outlined on its own as the paper does."""

ROBUST, MAXIMUM = "robust", "maximum"
"""The roof heights: the median of the roof's points, or the highest of them as in the paper."""


@dataclass(frozen=True)
class PolygonParameters:
    """What the user can set: one of the methods, one of the heights, the points of a line (J's n) for `PAPER`, and
    whether roofs are planes or levels; those of `PAPER` are levels always."""

    method: str = PARTITION
    height: str = ROBUST
    min_line_points: int = 5
    roofs: str = LEVELS


@dataclass
class RoofPolygons:
    """One row a polygon; a roof in several parts has several rows. Heights and lengths in m.

    Attributes
    ----------
    polygon : plan polygons, with z where roofs are planes.
    building_id, roof_id : what they belong to; roof 0 is a plain block.
    height, height_max : robust height and that of the highest point.
    points, density : roof points over the polygon, and a m2 of it.
    rmse : root mean square height difference of these points to `height`.
    coverage : share of the polygon's area with roof points.
    boundary_rms : of its inner edges to the points'.
    slope, azimuth : degrees, of the roof plane to the level, and where it falls to, clockwise from north (NaN: level).
    status : words.
    """

    polygon: list = field(default_factory=list)
    building_id: list = field(default_factory=list)
    roof_id: list = field(default_factory=list)
    height: list = field(default_factory=list)
    height_max: list = field(default_factory=list)
    points: list = field(default_factory=list)
    density: list = field(default_factory=list)
    rmse: list = field(default_factory=list)
    coverage: list = field(default_factory=list)
    boundary_rms: list = field(default_factory=list)
    slope: list = field(default_factory=list)
    azimuth: list = field(default_factory=list)
    status: list = field(default_factory=list)

    def extend(self, other: RoofPolygons) -> None:
        """Append the rows of another table."""
        for name in self.__dataclass_fields__:
            getattr(self, name).extend(getattr(other, name))


@dataclass(frozen=True)
class PolygonBlock:
    """One piece of work: buildings and their points."""

    layout: PointLayout
    ids: np.ndarray
    records: list[np.ndarray]
    polygons: np.ndarray
    neighbours: list[list[shapely.Geometry]]
    parameters: PolygonParameters


def cloud_roof_polygons(cloud: PointCloud, footprints: Footprints, parameters: PolygonParameters | None = None,
                        executor: Executor | None = None, progress: Progress = SILENT) -> RoofPolygons:
    """Roof polygons from points that carry `building_id` and `roof_id`.

    Buildings come in the order of their ids. A building with points but no roof becomes a plain block at the
    median height of its points, with `PAPER` it has no row, as one without points.
    """
    for name in ("building_id", "roof_id"):
        require_dimension(cloud, name, SEGMENT_ROOFS)
    layout = PointLayout(cloud)
    table = RoofPolygons()
    parameters = parameters or PolygonParameters()
    beside = _neighbours(footprints.polygons) if parameters.method == POINTS else None
    blocks = (PolygonBlock(layout, footprints.ids[rows], records, footprints.polygons[rows],
                           [beside[row] for row in rows] if beside else [[]] * len(rows), parameters)
              for rows, records in iter_building_blocks(cloud, layout, footprints.ids, progress.part(0.0, 0.2),
                                                       shape_only=True))
    done = 0
    for count, part in in_order(_block_polygons, blocks, executor, progress.check):
        table.extend(part)
        done += count
        progress.part(0.2, 1.0).step(done / len(footprints))
    return table


def _block_polygons(block: PolygonBlock) -> tuple[int, RoofPolygons]:
    """Number of buildings in a block and their polygons."""
    table = RoofPolygons()
    for number, outline, beside, records in zip(block.ids.tolist(), block.polygons, block.neighbours, block.records):
        checkpoint()
        if outline is None or not len(records):
            continue
        points = coordinates(block.layout, records)
        roof = records["roof_id"].astype(np.int64)
        drawn = RoofPolygons()
        try:
            roof_polygons_of(drawn, number, outline, beside, points, roof, block.parameters)
        except Cancelled:
            raise
        except Exception as error:  # one building's trouble is not the others'
            drawn = RoofPolygons()
            status = f"{SIMPLIFIED}: {trouble_words(error)}"
            if block.parameters.method != PAPER:
                _add_block(drawn, number, outline, points[2][roof > 0] if roof.any() else points[2], status)
        table.extend(drawn)
    return len(block.ids), table


def roof_polygons_of(table: RoofPolygons, number: int, outline: shapely.Geometry, beside: list[shapely.Geometry],
                       points: tuple, roof: np.ndarray, parameters: PolygonParameters) -> None:
    """Rows of one building's polygons."""
    if parameters.method == PAPER:
        _outline_each(table, number, outline, points, roof, parameters)
    elif not roof.any():
        _add_block(table, number, outline, points[2])
    else:
        divide = _divide_planes if parameters.roofs == PLANES else _divide_plan
        plan, status = outline, ""
        if parameters.method == POINTS:
            plan, status = _outline_of(points, roof, outline, beside)
        divide(table, number, plan, points, roof, parameters, status)


def _add_block(table: RoofPolygons, number: int, outline: shapely.Geometry, z: np.ndarray,
               status: str = BLOCK_STATUS) -> None:
    """Rows of a plain block over the whole outline."""
    height = float(np.median(z))
    for part in shapely.get_parts(outline):
        _add(table, number, 0, part, height, float(z.max()), z, math.nan, math.nan, status)


def _add(table: RoofPolygons, number: int, roof_id: int, polygon: shapely.Polygon, height: float, top: float,
         z: np.ndarray, coverage: float, boundary_rms: float, status: str, plane: np.ndarray | None = None,
         off: np.ndarray | None = None) -> None:
    """Add a row; `off`: distances of the points from a sloped roof `plane`, else taken from `height`."""
    off = z - height if off is None else off
    rmse = float(np.sqrt(np.mean(off ** 2))) if len(z) else math.nan
    slope, azimuth = (0.0, math.nan) if plane is None else (slope_degrees(plane), azimuth_degrees(plane))
    row = RoofPolygons([polygon], [number], [roof_id], [height], [top], [len(z)], [len(z) / polygon.area], [rmse],
                       [coverage], [boundary_rms], [slope], [azimuth], [status])
    table.extend(row)


def _divide_planes(table: RoofPolygons, number: int, outline: shapely.Geometry, points: tuple, roof: np.ndarray,
                   parameters: PolygonParameters, outline_status: str = "") -> None:
    """The whole outline divided among its roof planes, or among level roofs where those fit better."""
    xyz = np.column_stack(points)
    try:
        planes = _plane_rows(number, outline, xyz, roof, parameters, outline_status)
    except Cancelled:
        raise
    except Exception as error:  # what planes cannot do, levels may
        levels = level_roof_numbers(outline, xyz, roof)
        if not levels.any():
            raise
        status = f"{SIMPLIFIED}: {trouble_words(error)}"
        _divide_plan(table, number, outline, points, levels, parameters,
                     f"{status}; {outline_status}" if outline_status else status)
        return
    high = high_points(xyz, roof)
    off = roof_misfit(planes.polygon, high)
    if off > SUSPECT:
        other = level_roof_numbers(outline, xyz, roof)
        if other.any():
            levels = RoofPolygons()
            status = f"{LEVELS_BETTER}; {outline_status}" if outline_status else LEVELS_BETTER
            _divide_plan(levels, number, outline, points, other, parameters, status)
            if roof_misfit(shapely.force_3d(levels.polygon, levels.height).tolist(), high) < BETTER * off:
                planes = levels
    table.extend(planes)


def _plane_rows(number: int, outline: shapely.Geometry, xyz: np.ndarray, roof: np.ndarray,
                parameters: PolygonParameters, outline_status: str) -> RoofPolygons:
    """Rows of the polygons of a building's roof planes."""
    found, table = partition_planes(outline, xyz, roof), RoofPolygons()
    density = np.count_nonzero(roof) / outline.area
    lost = has_lost_plane(found.polygons, found.roof_numbers, xyz, roof, density, LOST_AREA)
    status = LOST_ROOFS if lost else found.status
    status = f"{status}; {outline_status}" if outline_status else status
    for polygon, roof_id, plane, coverage in zip(found.polygons, found.roof_numbers.tolist(), found.planes,
                                                 found.coverage.tolist()):
        members = roof == roof_id
        flat = shapely.force_2d(polygon)
        shapely.prepare(flat)
        members[members] = shapely.contains_xy(flat, *xyz[members, :2].T)
        z = xyz[members, 2]
        off = z - (xyz[members, :2] - found.origin) @ plane[:2] - plane[2]
        height = float((np.array(flat.centroid.coords[0]) - found.origin) @ plane[:2] + plane[2])
        top = float(z.max()) if len(z) else height
        _add(table, number, roof_id, polygon, top if parameters.height == MAXIMUM else height, top, z, coverage,
             math.nan, status, plane, off)
    return table


def _divide_plan(table: RoofPolygons, number: int, outline: shapely.Geometry, points: tuple, roof: np.ndarray,
                 parameters: PolygonParameters, outline_status: str = "") -> None:
    """The whole outline divided among its roofs: no gaps, common edges."""
    x, y, z = points
    on_roof = roof > 0
    x, y, z, roof = x[on_roof], y[on_roof], z[on_roof], roof[on_roof]
    cell = float(np.clip(1 / math.sqrt(max(len(x), 1) / outline.area), *CELL))
    grid = Grid.covering(*outline.bounds, cell)
    partition = partition_roofs(outline, grid, np.zeros(grid.shape, np.int32), _cell_heights(grid, x, y, z),
                                points=(x, y, roof))
    lost = _has_lost_roof(outline, x, y, roof, partition.roof_numbers)
    status = LOST_ROOFS if lost else partition.status
    status = f"{status}; {outline_status}" if outline_status else status
    levels = {roof_id: _height(z[roof == roof_id], parameters) for roof_id in np.unique(roof).tolist()}
    for place, (polygon, roof_id) in enumerate(zip(partition.polygons, partition.roof_numbers.tolist())):
        members = roof == roof_id
        shapely.prepare(polygon)
        members[members] = shapely.contains_xy(polygon, x[members], y[members])
        height = _inner_height(polygon, x[members], y[members], z[members],
                               parameters) if members.any() else levels[roof_id]
        top = float(z[members].max()) if members.any() else height
        _add(table, number, roof_id, polygon, height, top, z[members], float(partition.coverage[place]),
             float(partition.boundary_rms[place]), status)


def _has_lost_roof(outline: shapely.Geometry, x: np.ndarray, y: np.ndarray, roof: np.ndarray,
                   drawn: np.ndarray) -> bool:
    """Whether a roof with points on `LOST_AREA` m2 or more of the outline has no polygon."""
    numbers = np.setdiff1d(roof, drawn)
    if not len(numbers):
        return False
    shapely.prepare(outline)
    inside = shapely.contains_xy(outline, x, y)
    return bool(np.bincount(roof[inside]).max(where=np.isin(np.arange(roof[inside].max(initial=0) + 1), numbers),
                                              initial=0) >= LOST_AREA * inside.sum() / outline.area)


def _neighbours(polygons: np.ndarray) -> list[list[shapely.Geometry]]:
    """Outlines near each outline, itself left out."""
    tree = shapely.STRtree(polygons)
    one, other = tree.query(polygons, "dwithin", LIMITS.party_wall_reach)
    beside: list[list[shapely.Geometry]] = [[] for _ in polygons]
    for row, near in sorted(zip(one.tolist(), other.tolist())):
        if row != near:
            beside[row].append(polygons[near])
    return beside


def _outline_of(points: tuple, roof: np.ndarray, official: shapely.Geometry,
                beside: list[shapely.Geometry]) -> tuple[shapely.Geometry, str]:
    """Outline from the roof points; the official one, and a status that says so, where they are too few."""
    x, y, _ = points
    on_roof = roof > 0
    try:
        found = outline_from_points(x[on_roof], y[on_roof], np.count_nonzero(on_roof) / official.area,
                                    neighbours=beside)
    except InsufficientDataError:
        return official, "official outline, too few points for an own"
    return found.outline, f"outline from points, {found.status}"


def _cell_heights(grid: Grid, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Mean height of the points in each cell, NaN where there are none."""
    row, column, inside = grid.cells(x, y)
    cell = (row * grid.columns + column)[inside]
    size = grid.rows * grid.columns
    count = np.bincount(cell, minlength=size)
    total = np.bincount(cell, weights=z[inside], minlength=size)
    mean = np.full(size, np.nan)
    np.divide(total, count, out=mean, where=count > 0)
    return mean.reshape(grid.shape)


def _height(z: np.ndarray, parameters: PolygonParameters) -> float:
    """Height of a roof from its points, m."""
    return float(z.max() if parameters.height == MAXIMUM else np.median(z))


def _inner_height(polygon: shapely.Polygon, x: np.ndarray, y: np.ndarray, z: np.ndarray,
                  parameters: PolygonParameters) -> float:
    """Height of a roof from its points, m. A flat roof inside a parapet has the height of its inner points."""
    height = _height(z, parameters)
    if parameters.height == MAXIMUM:
        return height
    inner = shapely.buffer(polygon, -PARAPET_REACH)
    shapely.prepare(inner)
    heights = z[shapely.contains_xy(inner, x, y)]
    if len(heights) < LIMITS.min_inner_points:
        return height
    level = float(np.median(heights))
    flat = 1.4826 * float(np.median(np.abs(heights - level))) < LIMITS.flat_spread
    return level if flat and height - level >= LIMITS.min_parapet else height


def _outline_each(table: RoofPolygons, number: int, outline: shapely.Geometry, points: tuple, roof: np.ndarray,
                  parameters: PolygonParameters) -> None:
    """Each roof outlined on its own, as the paper does."""
    x, y, z = points
    if not roof.any():
        return
    shapely.prepare(outline)
    drawing = PaperParameters(min_line_points=parameters.min_line_points)
    density = max(np.count_nonzero(shapely.contains_xy(outline, x, y)), 1) / outline.area
    for drawn in paper_roof_polygons(x, y, roof, density, drawing):
        members = roof == drawn.roof_number
        height = _height(z[members], parameters)
        if drawn.polygon is None:
            continue
        for polygon in shapely.get_parts(drawn.polygon):
            _add(table, number, drawn.roof_number, polygon, height, float(z[members].max()), z[members], math.nan,
                 math.nan, drawn.status)
