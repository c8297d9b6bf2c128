"""Points of a mobile survey that can lie on facades: near a building's outline, below a height above ground (J 5.7).

The cloud is read once, in chunks. Which outline a point is near to is looked up in rasters of square tiles, made as
the points come; the points go to one bucket a building, on disk once they are many. What stands in front of the
facades (trees, vehicles) is kept thinned, as it explains why a wall is not seen.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import cv2
import numpy as np
import shapely
from scipy import ndimage

from ..errors import InsufficientDataError
from ..io.points.point_buckets import PointBuckets, stable_order
from ..io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ..io.points.whole_records import record_rows
from ..io.raster import RasterSampler
from ..progress import SILENT, Progress
from ..settings.facades import WallSettings
from ..wording import say
from .building_plans import BuildingPlans
from .plane_fit import component

RECORD = np.dtype([("x", "f8"), ("y", "f8"), ("z", "f8"), ("time", "f8")])

CELL = 0.25
"""Cells of the rasters that tell the nearest outline, m."""

TILE = 512
"""Cells along a tile."""

TILES_HELD = 64
FRONT = 6.0  # What stands up to this far from an outline (m) may hide the facade.
FRONT_CELL = 0.5
LOW_CELL = 1.0
FRONT_KEY = 1 << 40
MARGIN_BELOW = 3.0
BUCKET_BYTES = 120_000_000  # Points held in memory; more go to the disk.

DEFAULTS = WallSettings()


@dataclass(frozen=True, eq=False)
class FacadePoints:
    """What the survey measured of one building.

    Attributes
    ----------
    points : (n, 3) m, below the height and within tolerance.
    time : (n,) GPS seconds, NaN where the cloud has none.
    front : (k, 3) thinned places of what stands before it, and of itself.
    front_time : (k,) GPS seconds, NaN where the cloud has none.
    ground : (3,) plane of the ground round it, z = a + b x + c y, from `origin`; NaN where it is not known.
    origin : (2,) x and y.
    kept_share : share of the points that were kept.
    """

    points: np.ndarray
    time: np.ndarray
    front: np.ndarray
    front_time: np.ndarray
    ground: np.ndarray
    origin: np.ndarray
    kept_share: float = 1.0

    def height(self, points: np.ndarray) -> np.ndarray:
        """Height (n,) of points (n, 3) above the ground, m."""
        return points[:, 2] - (self.ground[0] + component(points[:, :2] - self.origin, self.ground[1:]))


class NearestOutline:
    """Looks up the building that points lie in, or within `max_distance` of, in rasters made tile by tile."""

    def __init__(self, plans: BuildingPlans, max_distance: float):
        self.max_distance = max_distance
        self.rows = np.flatnonzero(~shapely.is_missing(plans.plan))
        self.plans = plans.plan[self.rows]
        self.tree = shapely.STRtree(self.plans)
        self._tiles: OrderedDict[tuple[int, int], tuple[np.ndarray, np.ndarray] | None] = OrderedDict()

    def of(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Row of the building (n,), -1 beyond the maximum distance, and the distance outside of it (n,), to a cell's
        width.

        A place within it of several belongs to the one whose outline is nearest.
        """
        column, line = (np.floor(axis / CELL).astype(np.int64) for axis in (x, y))
        tile_x, tile_y = column // TILE, line // TILE
        row, distance = np.full(len(x), -1, np.int64), np.full(len(x), np.inf, np.float32)
        if not len(x):
            return row, distance
        code = (tile_x - tile_x.min()) * (int(np.ptp(tile_y)) + 1) + tile_y - tile_y.min()
        order = stable_order(code)
        code = code[order]
        for members in np.split(order, np.flatnonzero(code[1:] != code[:-1]) + 1):
            key = int(tile_x[members[0]]), int(tile_y[members[0]])
            tile = self._tile(key)
            if tile is not None:
                place = (line[members] - key[1] * TILE) * TILE + column[members] - key[0] * TILE
                row[members], distance[members] = tile[0].ravel()[place], tile[1].ravel()[place]
        return row, distance

    def _tile(self, key: tuple[int, int]) -> tuple[np.ndarray, np.ndarray] | None:
        """Nearest building and distance for the cells of a tile; None where no outline is near."""
        if key in self._tiles:
            self._tiles.move_to_end(key)
        else:
            self._tiles[key] = self._rasterised(key)
            if len(self._tiles) > TILES_HELD:
                self._tiles.popitem(last=False)
        return self._tiles[key]

    def _rasterised(self, key: tuple[int, int]) -> tuple[np.ndarray, np.ndarray] | None:
        pad = int(np.ceil(self.max_distance / CELL)) + 1
        low = np.array(key) * TILE - pad
        size = TILE + 2 * pad
        box = shapely.box(*(low * CELL), *((low + size) * CELL))
        near = np.sort(self.tree.query(box, predicate="intersects"))
        if not len(near):
            return None
        outline, inside = np.full((size, size), -1, np.int32), np.full((size, size), -1, np.int32)
        for number in near[::-1]:
            clipped = shapely.intersection(self.plans[number], box)
            dense = shapely.segmentize(shapely.intersection(shapely.boundary(self.plans[number]), box), CELL / 2)
            cells = np.floor(shapely.get_coordinates(dense) / CELL).astype(np.int64) - low
            cells = cells[((cells >= 0) & (cells < size)).all(axis=1)]
            outline[cells[:, 1], cells[:, 0]] = self.rows[number]
            rings = [np.floor(shapely.get_coordinates(ring) / CELL).astype(np.int64) - low
                     for part in shapely.get_parts(clipped) if part.geom_type == "Polygon"
                     for ring in shapely.get_rings(part)]
            if rings:
                cv2.fillPoly(inside, [ring.astype(np.int32) for ring in rings], int(self.rows[number]))
        distance, place = ndimage.distance_transform_edt(outline < 0, return_indices=True)
        core = slice(pad, pad + TILE), slice(pad, pad + TILE)
        distance = (distance[core] * CELL).astype(np.float32)
        nearest, inside = outline[place[0][core], place[1][core]], inside[core]
        deep = (inside >= 0) & (distance > CELL)
        # Far from all outlines of this tile the nearest one is not known; inside a building that does not matter.
        nearest = np.where(deep & ((nearest == inside) | (distance > self.max_distance)), inside, nearest)
        distance[deep & (nearest == inside)] = 0.0
        beyond = distance > self.max_distance
        return np.where(beyond, -1, nearest), np.where(beyond, np.inf, distance)


class LowestPoints:
    """Lowest point of each 1 m cell round each building: what the ground is taken from where none is given."""

    def __init__(self) -> None:
        self._pieces: list[np.ndarray] = []
        self._held = 0

    def add(self, row: np.ndarray, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> None:
        """Take points (n,) near buildings `row`."""
        cells = np.floor(x / LOW_CELL), np.floor(y / LOW_CELL)
        starts = np.flatnonzero(_changes(row, *cells))
        if len(starts):  # of points that follow each other in one cell the lowest
            table = np.column_stack([row[starts], *(cell[starts] for cell in cells), np.minimum.reduceat(z, starts)])
            self._pieces.append(_lowest(table))
        else:
            self._pieces.append(np.zeros((0, 4)))
        self._held += len(self._pieces[-1])
        if self._held > 4_000_000:
            self._pieces = [_lowest(np.concatenate(self._pieces))]
            self._held = len(self._pieces[0])

    def planes(self, count: int, origin: np.ndarray) -> np.ndarray:
        """Plane of the ground (count, 3) for each building, from its `origin` (count, 2); NaN where unknown."""
        planes = np.full((count, 3), np.nan)
        table = _lowest(np.concatenate(self._pieces)) if self._pieces else np.zeros((0, 4))
        rows = table[:, 0].astype(np.int64)
        starts = np.searchsorted(rows, np.arange(count + 1))
        for row in range(count):
            cells = table[starts[row]:starts[row + 1]]
            if len(cells):
                planes[row] = ground_plane((cells[:, 1:3] + 0.5) * LOW_CELL - origin[row], cells[:, 3])
        return planes


def _changes(*columns: np.ndarray) -> np.ndarray:
    """Mask (n,) of the rows that differ from the one before in a column (n,); the first does."""
    changed = np.zeros(len(columns[0]), bool)
    changed[:1] = True
    for values in columns:
        changed[1:] |= values[1:] != values[:-1]
    return changed


def _lowest(table: np.ndarray) -> np.ndarray:
    """Of rows (key, key, key, z) those with the lowest z of each key, sorted."""
    if not len(table):
        return table
    code, size = np.zeros(len(table), np.int64), 1
    for column in table[:, 2::-1].T:  # the first counts most
        number = (column - column.min()).astype(np.int64)
        code += number * size
        size *= int(number.max()) + 1
    if size >= 2**63:
        table = table[np.lexsort(table.T[::-1])]
        return table[_changes(*table[:, :3].T)]
    order = np.argsort(code, kind="stable")
    starts = np.flatnonzero(_changes(code[order]))
    return np.column_stack([table[order[starts], :3], np.minimum.reduceat(table[order, 3], starts)])


def ground_plane(xy: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Plane (3,) under heights: z = a + b x + c y through the lowest layer that has company.

    It starts level at the height above which nine of ten cells lie, takes cells within half a metre, and is fitted
    anew to them. Slopes of more than 20 % are not believed: then, and with few cells, it stays level.
    """
    plane = np.array([np.quantile(z, 0.1), 0.0, 0.0])
    for width in (1.5, 1.0, 0.5, 0.5):
        near = np.abs(z - plane[0] - component(xy, plane[1:])) < width
        if np.count_nonzero(near) < 8:
            break
        design = np.column_stack([np.ones(np.count_nonzero(near)), xy[near]])
        fitted = np.linalg.lstsq(np.einsum("ni,nj->ij", design, design), np.einsum("ni,n->i", design, z[near]),
                                 rcond=1e-12)[0]
        plane = fitted if np.hypot(*fitted[1:]) < 0.2 else np.array([np.median(z[near]), 0.0, 0.0])
    return plane


@contextmanager
def facade_points(cloud: PointCloud, plans: BuildingPlans, settings: WallSettings = DEFAULTS,
                  ground: RasterSampler | None = None,
                  progress: Progress = SILENT) -> Iterator[Iterator[tuple[int, FacadePoints]]]:
    """Read a cloud and give (row of the building, its points), building after building.

    Parameters
    ----------
    cloud : survey in the plans' CRS.
    ground : heights of the ground, m; without it the ground is taken from the lowest points round each building.

    Raises
    ------
    InsufficientDataError : no point lies near any building.
    """
    nearest = NearestOutline(plans, FRONT)
    low = LowestPoints()
    with PointBuckets(RECORD, BUCKET_BYTES) as buckets:
        rows = _collect(cloud, nearest, settings, ground, buckets, low, progress)
        if not rows:
            raise InsufficientDataError(
                say("No point of the survey lies near a building: check that both are of the same place and CRS, and "
                    "that the survey has been put on the map."))
        origin = np.array([[0.0, 0.0] if plan is None else plan.bounds[:2] for plan in plans.plan])
        planes = low.planes(len(plans), origin)
        if ground is not None:
            planes = _given_ground(plans, ground, origin, planes)
        yield _buildings(sorted(rows), buckets, plans, settings, origin, planes)


def _collect(cloud: PointCloud, nearest: NearestOutline, settings: WallSettings, ground: RasterSampler | None,
             buckets: PointBuckets, low: LowestPoints, progress: Progress) -> set[int]:
    """Sort the cloud's points into buckets; which buildings have any within tolerance."""
    timed = cloud.has_dimension("gps_time")
    rows: set[int] = set()
    for chunk in iter_chunks(cloud, progress, shape_only=True, timed=timed):
        x, y, z = (np.asarray(chunk[name]) for name in "xyz")
        row, distance = nearest.of(x, y)
        near = np.flatnonzero((row >= 0) & valid_points(chunk))
        if not len(near):
            continue
        x, y, z, row, distance = x[near], y[near], z[near], row[near], distance[near]
        low.add(row, x, y, z)
        records = np.empty(len(near), RECORD)
        records["x"], records["y"], records["z"] = x, y, z
        records["time"] = np.asarray(chunk["gps_time"])[near] if timed else np.nan
        within = distance <= settings.reach
        if ground is not None:
            height = z - ground.sample(x, y)
            within &= ~(height > settings.max_height)
        buckets.add(row[within], record_rows(records, within))
        rows.update(np.unique(row[within]).tolist())
        front = _thinned(x, y, z, row)
        buckets.add(row[front] + FRONT_KEY, record_rows(records, front))
    return rows


def _thinned(x: np.ndarray, y: np.ndarray, z: np.ndarray, row: np.ndarray) -> np.ndarray:
    """Indices of one point of each half-metre cube."""
    cube = [np.floor((axis - axis.min()) / FRONT_CELL).astype(np.int64) for axis in (x, y, z)]
    size = [int(axis.max()) + 1 for axis in cube]
    code = ((row * size[0] + cube[0]) * size[1] + cube[1]) * size[2] + cube[2]
    starts = np.flatnonzero(_changes(code))
    return starts[np.unique(code[starts], return_index=True)[1]]


def _given_ground(plans: BuildingPlans, ground: RasterSampler, origin: np.ndarray, planes: np.ndarray) -> np.ndarray:
    """Planes through the given ground round each outline; those of the low points where it has gaps."""
    planes = planes.copy()
    for row, plan in enumerate(plans.plan):
        if plan is None:
            continue
        ring = shapely.get_coordinates(shapely.segmentize(shapely.boundary(shapely.buffer(plan, 1.0)), 1.0))
        z = ground.sample(*ring.T)
        known = np.isfinite(z)
        if known.any():
            planes[row] = ground_plane(ring[known] - origin[row], z[known])
    return planes


def _buildings(rows: list[int], buckets: PointBuckets, plans: BuildingPlans, settings: WallSettings,
               origin: np.ndarray, planes: np.ndarray) -> Iterator[tuple[int, FacadePoints]]:
    """The buckets as the buildings' points, above the ground and below the height."""
    for row in rows:
        records = buckets.read(row)
        share = 1.0
        if len(records) > settings.max_points:
            share = settings.max_points / len(records)
            records = record_rows(records, np.random.default_rng(row).random(len(records)) < share)
        front = buckets.read(row + FRONT_KEY)
        plane = planes[row]
        if not np.isfinite(plane[0]) and np.isfinite(plans.base[row]):
            plane = np.array([plans.base[row], 0.0, 0.0])
        facade = FacadePoints(_xyz(records), records["time"], _xyz(front), front["time"], plane, origin[row], share)
        keep = np.ones(len(records), bool)
        if np.isfinite(plane[0]):
            height = facade.height(facade.points)
            keep = (height > -MARGIN_BELOW) & (height <= settings.max_height)
        yield row, replace(facade, points=facade.points[keep], time=facade.time[keep])


def _xyz(records: np.ndarray) -> np.ndarray:
    return np.column_stack([records[name] for name in "xyz"])
