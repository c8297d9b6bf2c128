"""Elevation models of the GSI as one raster: meshes side by side, finer products over coarser, in any projection."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ...geometry.grid import Grid
from ...geometry.sampling import sample
from ...progress import SILENT, Progress
from ...wording import say
from ..conversion.reprojection import PlaneTransform
from ..raster import write_raster
from ..reference.height_systems import japanese, stating_heights
from ..reference.plane_rectangular import zone_epsg, zone_numbers
from .gsi_dem import PRODUCTS, DemMesh, DemMeshes

_GEOGRAPHIC = {"JGD2000": 4612, "JGD2011": 6668, "JGD2024": 6668}
_ZONES_BEFORE = {"JGD2000": 2442, "JGD2011": 6668, "JGD2024": 6668}
_WIDTH = 1024  # columns worked on at a time
_MOST_CELLS = 4 * 10**9


def dem_epsg(system: str) -> int:
    """EPSG code of the degrees that a model counts in."""
    return _GEOGRAPHIC[system]


def dem_zone(meshes: DemMeshes) -> int:
    """EPSG code of the Japan Plane Rectangular zone in which most meshes lie."""
    middles = np.array([(mesh.west + mesh.cell * mesh.heights.shape[1] / 2,
                         mesh.north - mesh.cell * mesh.heights.shape[0] / 2) for mesh in meshes.meshes])
    zone = int(np.bincount(zone_numbers(middles[:, 0], middles[:, 1])).argmax())
    return zone_epsg(zone) - _ZONES_BEFORE["JGD2011"] + _ZONES_BEFORE[meshes.system]


def dem_bounds(meshes: DemMeshes) -> tuple[float, float, float, float]:
    """West, south, east and north of all meshes, degrees."""
    return (min(mesh.west for mesh in meshes.meshes),
            min(mesh.north - mesh.cell * mesh.heights.shape[0] for mesh in meshes.meshes),
            max(mesh.west + mesh.cell * mesh.heights.shape[1] for mesh in meshes.meshes),
            max(mesh.north for mesh in meshes.meshes))


@dataclass(frozen=True)
class DemRaster:
    """What was written.

    Attributes
    ----------
    grid : its place.
    empty : share of the cells without a height.
    products : those that were used, finest first.
    system : height system, "JGD2011".
    lowest, highest : m, NaN where there is no height at all.
    """

    grid: Grid
    empty: float
    products: tuple[str, ...]
    system: str
    lowest: float
    highest: float


def write_dem(path: str | os.PathLike, meshes: DemMeshes, crs_wkt: str, transform: PlaneTransform | None,
              resolution: float | None = None, progress: Progress = SILENT) -> DemRaster:
    """Write meshes as one GeoTIFF; its CRS states the heights.

    A cell holds the height of the finest product that has one there; between cells heights are bilinear. A cell whose
    nearest cell is empty stays empty, so that water does not shrink.

    Parameters
    ----------
    crs_wkt : of the raster.
    transform : from the meshes' degrees to it; None where they are the raster's own.
    resolution : side of a cell in units of the CRS; by default that of the finest product (degrees as they are in the
        files, or 1, 5, 10 m).

    Raises
    ------
    InputError : the raster would have more than 4,000 million cells.
    """
    products = [_Product(name, [mesh for mesh in meshes.meshes if mesh.product == name]) for name in PRODUCTS
                if any(mesh.product == name for mesh in meshes.meshes)]
    grid = _target_grid(meshes, products[0], transform, resolution)
    if grid.rows * grid.columns > _MOST_CELLS:
        raise InputError(say("The raster would have {columns} x {rows} cells: load fewer meshes at a time, or choose "
                             "a coarser resolution.", columns=grid.columns, rows=grid.rows))
    rows = _Rows(grid, products, transform)
    write_raster(path, rows, grid, stating_heights(crs_wkt, japanese(meshes.system)), progress=progress)
    empty = 1.0 - rows.filled / (grid.rows * grid.columns)
    return DemRaster(grid, empty, tuple(product.name for product in products), meshes.system, rows.lowest, rows.highest)


class _Product:
    """The meshes of one product, from which windows are cut."""

    def __init__(self, name: str, meshes: Sequence[DemMesh]):
        self.name, self.meshes = name, meshes
        self.cell = meshes[0].cell
        # All meshes of a product lie on one grid: their corners are whole seconds. Odd ones are drawn to it.
        self.left = np.array([round(mesh.west / self.cell) for mesh in meshes])
        self.top = np.array([round(-mesh.north / self.cell) for mesh in meshes])
        self.right = self.left + [mesh.heights.shape[1] for mesh in meshes]
        self.bottom = self.top + [mesh.heights.shape[0] for mesh in meshes]

    def window(self, left: int, top: int, right: int, bottom: int) -> np.ndarray | None:
        """Heights of cells counted from longitude 0 east and latitude 0 south; None where no mesh reaches them."""
        hits = np.flatnonzero((self.left < right) & (self.right > left) & (self.top < bottom) & (self.bottom > top))
        if not len(hits):
            return None
        heights = np.full((bottom - top, right - left), np.nan, np.float32)
        for hit in hits.tolist():
            x0, x1 = max(left, self.left[hit]), min(right, self.right[hit])
            y0, y1 = max(top, self.top[hit]), min(bottom, self.bottom[hit])
            part = self.meshes[hit].heights[y0 - self.top[hit]:y1 - self.top[hit],
                                            x0 - self.left[hit]:x1 - self.left[hit]]
            place = heights[y0 - top:y1 - top, x0 - left:x1 - left]
            np.copyto(place, part, where=np.isfinite(part))
        return heights

    def interpolate(self, longitude: np.ndarray, latitude: np.ndarray) -> np.ndarray:
        """Bilinear heights (n,) at places; NaN where the cell at the place has none."""
        cell = self.cell
        left, right = math.floor(longitude.min() / cell) - 1, math.floor(longitude.max() / cell) + 2
        top, bottom = math.floor(-latitude.max() / cell) - 1, math.floor(-latitude.min() / cell) + 2
        part = self.window(left, top, right, bottom)
        if part is None:
            return np.full(longitude.shape, np.nan, np.float32)
        grid = Grid(left * cell, -top * cell, cell, bottom - top, right - left)
        heights = sample(grid, part, longitude, latitude)
        row, column, _ = grid.cells(longitude, latitude)
        heights[np.isnan(part[row, column])] = np.nan
        return heights


class _Rows:
    """The raster, computed as its rows are asked for: what a writer slices as if it were an array."""

    dtype = np.dtype(np.float32)

    def __init__(self, grid: Grid, products: Sequence[_Product], transform: PlaneTransform | None):
        self.grid, self.products, self.transform = grid, products, transform
        self.filled, self.lowest, self.highest = 0, math.nan, math.nan

    def __getitem__(self, rows: slice) -> np.ndarray:
        top, bottom, _ = rows.indices(self.grid.rows)
        block = np.empty((bottom - top, self.grid.columns), np.float32)
        for left in range(0, self.grid.columns, _WIDTH):
            right = min(left + _WIDTH, self.grid.columns)
            block[:, left:right] = self._block(top, bottom, left, right)
        heights = block[np.isfinite(block)]
        if len(heights):
            self.filled += len(heights)
            self.lowest = float(np.fmin(self.lowest, heights.min()))
            self.highest = float(np.fmax(self.highest, heights.max()))
        return block

    def _block(self, top: int, bottom: int, left: int, right: int) -> np.ndarray:
        x, y = self.grid.centres()
        x, y = (places.ravel() for places in np.meshgrid(x[left:right], y[top:bottom]))
        if self.transform is not None:
            x, y = self.transform(x, y, inverse=True)
        inside = np.isfinite(x) & np.isfinite(y)
        heights = np.full(len(x), np.nan, np.float32)
        for product in self.products:
            gaps = np.flatnonzero(np.isnan(heights) & inside)
            if len(gaps):
                heights[gaps] = product.interpolate(x[gaps], y[gaps])
        return heights.reshape(bottom - top, right - left)


def _target_grid(meshes: DemMeshes, finest: _Product, transform: PlaneTransform | None,
                 resolution: float | None) -> Grid:
    west, south, east, north = dem_bounds(meshes)
    if transform is None:
        cell = resolution or finest.cell
        left, right = round(west / cell), math.ceil(east / cell - 0.01)
        top, bottom = round(-north / cell), math.ceil(-south / cell - 0.01)
        return Grid(left * cell, -top * cell, cell, bottom - top, right - left)
    bounds = transform.transformer.transform_bounds(west, south, east, north)
    if not np.isfinite(bounds).all():
        raise InputError(say("The elevation model lies outside of where the reference system can be computed: choose "
                             "one made for Japan."))
    degrees = transform.transformer.target_crs is not None and transform.transformer.target_crs.is_geographic
    return Grid.covering(*bounds, resolution or (finest.cell if degrees else PRODUCTS[finest.name]))
