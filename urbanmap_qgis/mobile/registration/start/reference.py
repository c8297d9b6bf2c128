"""The aerial reference: how much of each place is paint, and how high the ground is there, read where it is needed."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from rasterio.features import rasterize
from rasterio.transform import Affine

from ....errors import InputError
from ....geometry.grid import Grid
from ....geometry.sampling import sample
from ....io.raster import RasterSampler
from ....wording import say
from .mask_check import refuse_unless_mask

POLYGON_CELL = 0.1
"""m, cells that polygons are drawn into; coverage is to a quarter of a cell."""

COARSEST = 0.5
"""m. Markings are 0.1 to 0.45 m wide: with larger pixels there is nothing to register to."""


_OTHER_DATUM = 5.0  # m: no survey is off so far in height, other datums are


@dataclass(frozen=True)
class Coverage:
    """How much of each cell is marking.

    Attributes
    ----------
    grid : place of the cells.
    share : (rows, columns) float32, 0 to 1.
    """

    grid: Grid
    share: np.ndarray

    def points(self, min_share: float = 0.5) -> np.ndarray:
        """(n, 2) m, middles of the cells that are marking to `min_share` or more."""
        row, column = np.nonzero(self.share >= min_share)
        x, y = self.grid.centres()
        return np.stack([x[column], y[row]], axis=1)


@dataclass(frozen=True)
class Reference:
    """Road markings of the aerial reference, from a mask raster or from polygons; heights from a raster or their z.

    Attributes
    ----------
    mask : path of the mask raster (above 0 = marking), or None.
    polygons : shapely polygons, or None.
    ground : path of the raster of ground heights; None for a reference in 2D, or where the polygons have z.
    crs_wkt : the CRS of the markings, "" where the file states none.
    """

    mask: str | None = None
    polygons: np.ndarray | None = None
    ground: str | None = None
    crs_wkt: str = ""

    @classmethod
    def from_mask(cls, path: str | os.PathLike, ground: str | os.PathLike | None = None) -> Reference:
        """From a mask raster.

        Raises
        ------
        InputError : a file cannot be read as a raster, or the mask's cells are too large to show markings, or it is an
            image.
        InsufficientDataError : the mask is empty.
        """
        with RasterSampler(path) as source:
            if source.grid.cell > COARSEST:
                raise InputError(say("{path} has cells of {cell:g} m: road markings need {coarsest:g} m or less, and "
                                     "a CRS in metres.", path=source.path.name, cell=source.grid.cell,
                                     coarsest=COARSEST))
            refuse_unless_mask(source)
            crs_wkt = source.crs_wkt
        return cls(mask=os.fspath(path), ground=_checked_ground(ground), crs_wkt=crs_wkt)

    @classmethod
    def from_polygons(cls, polygons: Sequence[shapely.Geometry], ground: str | os.PathLike | None = None,
                      crs_wkt: str = "") -> Reference:
        """From marking polygons, with z where they have it.

        Raises
        ------
        InputError : there is no polygon.
        """
        usable = np.array([g for g in polygons if g is not None and not g.is_empty], dtype=object)
        if not len(usable) or not np.isin(shapely.get_type_id(usable), (3, 6)).all():
            raise InputError(say("The reference markings must be polygons and at least one: choose another layer."))
        return cls(polygons=usable, ground=_checked_ground(ground), crs_wkt=crs_wkt)

    @property
    def has_heights(self) -> bool:
        """Whether heights of the ground are known."""
        return self.ground is not None or (self.polygons is not None and bool(shapely.has_z(self.polygons).all()))

    def coverage(self, x_min: float, y_min: float, x_max: float, y_max: float) -> Coverage:
        """The markings in a box (m); cells outside of what the reference covers are 0."""
        if self.polygons is not None:
            return _draw(self.polygons, Grid.covering(x_min, y_min, x_max, y_max, POLYGON_CELL))
        with RasterSampler(self.mask) as source:
            rows, columns, part = source.grid.window(x_min, y_min, x_max, y_max)
            whole = _covering(source.grid, x_min, y_min, x_max, y_max)
            share = np.zeros(whole.shape, dtype=np.float32)
            if part.rows and part.columns:
                top = round((whole.y_max - part.y_max) / part.cell)
                left = round((part.x_min - whole.x_min) / part.cell)
                share[top:top + part.rows, left:left + part.columns] = source.read(rows, columns) > 0
        return Coverage(whole, share)

    def heights(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Height of the ground at points (n,), m; NaN where it is not known."""
        if self.ground is not None:
            with RasterSampler(self.ground) as source:
                return source.sample(x, y).astype(np.float64)
        return _heights_of_polygons(self.polygons, np.asarray(x, float), np.asarray(y, float))

    def ground_part(self, x_min: float, y_min: float, x_max: float, y_max: float) -> GroundPart:
        """The ground's heights in a box, held in memory for many questions."""
        if self.ground is None:
            return GroundPart(None, None, self)
        with RasterSampler(self.ground) as source:
            margin = 2 * source.grid.cell
            rows, columns, part = source.grid.window(x_min - margin, y_min - margin, x_max + margin, y_max + margin)
            if not part.rows or not part.columns:
                return GroundPart(Grid(x_min, y_max, source.grid.cell, 2, 2), np.full((2, 2), np.nan, np.float32), self)
            return GroundPart(part, source.read(rows, columns), self)


@dataclass(frozen=True)
class GroundPart:
    """Heights of the ground in a box.

    Attributes
    ----------
    grid, heights : the raster's part; None where heights come from polygons.
    reference : whose ground it is.
    """

    grid: Grid | None
    heights: np.ndarray | None
    reference: Reference

    def interpolate(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Heights at points (n,), m; NaN where unknown."""
        if self.grid is None:
            return self.reference.heights(x, y)
        return sample(self.grid, self.heights, x, y).astype(np.float64)


def require_same_datum(off: np.ndarray) -> None:
    """Refuse heights of another datum, by the ground's heights less those of points (n,), m; NaN where unknown.

    Raises
    ------
    InputError : the middle difference is more than 5 m.
    """
    known = off[np.isfinite(off)]
    middle = float(np.median(known)) if len(known) else 0.0
    if abs(middle) > _OTHER_DATUM:
        raise InputError(say("The survey lies {middle:.1f} m {value} the reference's ground: heights above the "
                             "ellipsoid and above sea level cannot be mixed, convert one of the two.",
                             middle=abs(middle), value=say("below") if middle > 0 else say("above")))


def _checked_ground(path: str | os.PathLike | None) -> str | None:
    if path is None:
        return None
    with RasterSampler(path):
        return os.fspath(path)


def _covering(grid: Grid, x_min: float, y_min: float, x_max: float, y_max: float) -> Grid:
    """Grid over the box whose cells fall on those of `grid`, also beyond its edges."""
    left, right = (math.floor((x - grid.x_min) / grid.cell) for x in (x_min, x_max))
    top, bottom = (math.floor((grid.y_max - y) / grid.cell) for y in (y_max, y_min))
    return Grid(grid.x_min + left * grid.cell, grid.y_max - top * grid.cell, grid.cell, bottom - top + 1,
                right - left + 1)


def _draw(polygons: np.ndarray, grid: Grid) -> Coverage:
    """Polygons as shares of cells, drawn twice as fine in both directions."""
    x_min, y_min, x_max, y_max = grid.bounds
    inside = polygons[shapely.STRtree(polygons).query(shapely.box(x_min, y_min, x_max, y_max))]
    fine = np.zeros((2 * grid.rows, 2 * grid.columns), dtype=np.uint8)
    if len(inside):
        cell = grid.cell / 2
        rasterize(_shapes(inside), out=fine, transform=Affine(cell, 0, grid.x_min, 0, -cell, grid.y_max))
    quarters = fine[0::2, 0::2] + fine[0::2, 1::2] + fine[1::2, 0::2] + fine[1::2, 1::2]
    return Coverage(grid, quarters * np.float32(0.25))


def _shapes(polygons: np.ndarray) -> list[dict]:
    """Polygons (n,) as the drawing takes them, all at once; one by one they cost more than the drawing."""
    if (shapely.get_type_id(polygons) != shapely.GeometryType.POLYGON).any():
        return list(polygons)
    rings, owner = shapely.get_rings(polygons, return_index=True)
    ends = np.cumsum(shapely.get_num_coordinates(rings)).tolist()
    corners = shapely.get_coordinates(rings).tolist()
    shapes = [{"type": "Polygon", "coordinates": []} for _ in polygons]
    for number, start, end in zip(owner.tolist(), [0, *ends], ends):
        shapes[number]["coordinates"].append(corners[start:end])
    return shapes


def _heights_of_polygons(polygons: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Inverse-distance height of the corners of the nearest polygon, for points within 1 m of one."""
    height = np.full(len(x), np.nan)
    points, nearest = shapely.STRtree(polygons).query_nearest(shapely.points(x, y), max_distance=1.0,
                                                              all_matches=False)
    order = np.argsort(nearest, kind="stable")
    for part in np.split(order, np.flatnonzero(np.diff(nearest[order])) + 1):
        if not len(part):
            continue
        corners = shapely.get_coordinates(polygons[nearest[part[0]]], include_z=True)
        nearby = points[part]
        near = 1.0 / ((x[nearby, None] - corners[:, 0]) ** 2 + (y[nearby, None] - corners[:, 1]) ** 2 + 1e-4)
        height[nearby] = (near @ corners[:, 2]) / near.sum(axis=1)
    return height
