"""Perspective occlusion maps: what buildings show in and hide from a frame (J 3.2.1.1)."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import rasterio
import shapely
from rasterio.errors import NotGeoreferencedWarning, RasterioError
from rasterio.windows import Window
from scipy.ndimage import distance_transform_edt

from ..errors import InputError, OutputError
from ..geometry.grid import Grid
from ..io.atomic import written_beside
from ..io.raster import RasterSampler, own_gdal
from ..progress import SILENT, Progress
from .camera import Camera, Pose, project, rays
from .silhouette import Sides, fill, surface_sides

HIDDEN = 255
_STRIP_VERTICES = 1_000_000
_STRIP_ROWS = 512
_BLOCK = 256
_PROBES = 64
_DEEPER = 15.0
_STANDING = 0.1


@dataclass(frozen=True)
class OcclusionSummary:
    """What was made.

    Attributes
    ----------
    hidden_share : share of the frame's pixels that are masked.
    uncovered_share : share of the frame that looks beyond the surface or ground raster, so that nothing is known.
    footprints_raised : outlines in which cells were raised. footprints_flat : outlines where the surface shows no
    building (less than a tenth of their cells is raised), which were left alone.
    """

    hidden_share: float
    uncovered_share: float
    footprints_raised: int
    footprints_flat: int


@dataclass(frozen=True)
class Raised:
    """Cells of a surface raster that outlines lift, in order of rows: (n,) rows, columns and heights, m."""

    row: np.ndarray
    column: np.ndarray
    z: np.ndarray


class Terrain:
    """A surface raster and the ground below it, read by windows. Use as a context manager.

    Attributes
    ----------
    grid : of the surface.
    """

    def __init__(self, dsm: str | os.PathLike, ground: str | os.PathLike):
        self._surface = RasterSampler(dsm)
        try:
            self.ground = RasterSampler(ground)
        except InputError:
            self._surface.__exit__()
            raise
        self.grid = self._surface.grid
        self.crs_wkt = self._surface.crs_wkt

    def __enter__(self) -> Terrain:
        return self

    def __exit__(self, *_exception: object) -> None:
        self._surface.__exit__()
        self.ground.__exit__()

    def surface(self, rows: slice, columns: slice) -> np.ndarray:
        """Heights of the surface, NaN where there are none."""
        return self._surface.read(rows, columns)

    def high(self, z: np.ndarray, rows: slice, columns: slice, threshold: float) -> np.ndarray:
        """Which cells of a window with surface heights `z` lie more than the threshold, m, above the ground."""
        if self.ground.grid == self.grid:
            ground = self.ground.read(rows, columns)
        else:
            x, y = centres(self.grid, rows, columns)
            x, y = np.broadcast_arrays(x, y[:, None])
            ground = self.ground.sample(x.ravel(), y.ravel()).reshape(x.shape)
        return z - ground > threshold

    def known(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Whether both heights are known at points (n,)."""
        return np.isfinite(self._surface.sample(x, y)) & np.isfinite(self.ground.sample(x, y))


def centres(grid: Grid, rows: slice, columns: slice) -> tuple[np.ndarray, np.ndarray]:
    """x and y of the cell centres of a window."""
    x, y = grid.centres()
    return x[columns], y[rows]


def occlusion_map(camera: Camera, pose: Pose, dsm: str | os.PathLike, ground: str | os.PathLike,
                  output: str | os.PathLike, threshold: float = 5.0, footprints: Sequence = (),
                  progress: Progress = SILENT) -> OcclusionSummary:
    """Write the mask of a frame: 255 where a pixel shows a building or what a building hides, else 0.

    The surface between the centres of the raster's cells is a mesh; its triangles with a corner higher than the
    threshold above the ground are filled in the frame, walls included.

    Parameters
    ----------
    dsm, ground : rasters of the surface and of the ground, heights in the system of the pose, m.
    output : TIFF with the frame's rows and columns, compressed.
    threshold : m above the ground.
    footprints : shapely polygons; cells inside that the surface shows low are raised to the nearest raised cell.

    Raises
    ------
    InputError : a raster cannot be read, or the surface does not reach the frame. OutputError : nothing can be written.
    """
    with Terrain(dsm, ground) as terrain:
        rows, columns, uncovered = frame_window(camera, pose, terrain)
        if uncovered > 0.01:
            progress.warn(f"{uncovered:.0%} of {pose.image} looks beyond the surface or the ground raster: buildings "
                          "there are not masked.")
        raised, lifted, flat = raise_footprints(terrain, footprints, rows, columns, threshold, progress.part(0, 0.2))
        sides = frame_sides(camera, pose, terrain, rows, columns, threshold, raised, progress.part(0.2, 0.7))
    hidden = _write(output, camera, sides, progress.part(0.7, 1.0))
    return OcclusionSummary(hidden / (camera.width * camera.height), uncovered, lifted, flat)


def occlusion_mask(camera: Camera, pose: Pose, terrain: Terrain, threshold: float = 5.0,
                   footprints: Sequence = ()) -> np.ndarray:
    """The mask of `occlusion_map` as an array (rows, columns) bool."""
    rows, columns, _ = frame_window(camera, pose, terrain)
    raised, _, _ = raise_footprints(terrain, footprints, rows, columns, threshold)
    sides = frame_sides(camera, pose, terrain, rows, columns, threshold, raised)
    return np.concatenate([mask for _, mask in _strips(camera, sides)])


def frame_window(camera: Camera, pose: Pose, terrain: Terrain) -> tuple[slice, slice, float]:
    """Rows and columns of the surface that the frame may see, and the share of the frame that looks beyond.

    Whatever the frame sees lies between the projection centre and a level below all ground.

    Raises
    ------
    InputError : the frame looks past the surface altogether.
    """
    grid, ground = terrain.grid, terrain.ground
    column, row = np.meshgrid(np.linspace(-0.5, camera.width - 0.5, _PROBES),
                              np.linspace(-0.5, camera.height - 0.5, _PROBES))
    ray = rays(camera, pose, column.ravel(), row.ravel())
    x, y = (values.ravel() for values in np.meshgrid(*(
        np.linspace(low, high, _PROBES) for low, high in zip(ground.grid.bounds[:2], ground.grid.bounds[2:]))))
    for _ in range(3):
        heights = ground.sample(x, y)
        if not np.isfinite(heights).any():
            break
        level = float(np.nanmedian(heights))
        bounds = _reach(pose, ray, float(np.nanmin(heights)) - _DEEPER, grid)
        x, y = (values.ravel() for values in np.meshgrid(np.linspace(bounds[0], bounds[2], _PROBES),
                                                         np.linspace(bounds[1], bounds[3], _PROBES)))
    else:
        rows, columns, part = grid.window(*bounds)
        seen = terrain.known(*_meet(pose, ray, level))
        if part.rows > 1 and part.columns > 1 and seen.any():
            return rows, columns, float(1 - seen.mean())
    raise InputError(f"{pose.image} looks past the surface and ground rasters: choose rasters of its place, and check "
                     "that heights, CRS and angles fit.")


def _meet(pose: Pose, ray: np.ndarray, level: float) -> tuple[np.ndarray, np.ndarray]:
    """x and y where rays (n, 3) meet a level, NaN where they do not."""
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = (level - pose.z) / ray[:, 2]
        distance = np.where(distance > 0, distance, np.nan)
    return pose.x + distance * ray[:, 0], pose.y + distance * ray[:, 1]


def _reach(pose: Pose, ray: np.ndarray, level: float, grid: Grid) -> tuple[float, float, float, float]:
    """Box around the projection centre and the rays' ends at a level; those that rise end beyond the grid."""
    beyond = 2 * max(abs(pose.x - grid.bounds[0]), abs(pose.x - grid.bounds[2]),
                     abs(pose.y - grid.bounds[1]), abs(pose.y - grid.bounds[3]))
    x, y = _meet(pose, ray, level)
    rising = np.isnan(x) & np.isfinite(ray[:, 2])
    x, y = np.where(rising, pose.x + beyond * ray[:, 0], x), np.where(rising, pose.y + beyond * ray[:, 1], y)
    x, y = np.append(x[np.isfinite(x)], pose.x), np.append(y[np.isfinite(y)], pose.y)
    low_x, low_y, high_x, high_y = grid.bounds
    return (min(max(x.min(), low_x), high_x), min(max(y.min(), low_y), high_y),
            max(min(x.max(), high_x), low_x), max(min(y.max(), high_y), low_y))


def raise_footprints(terrain: Terrain, footprints: Sequence, rows: slice, columns: slice, threshold: float,
                     progress: Progress = SILENT) -> tuple[Raised, int, int]:
    """Cells inside outlines that the surface shows low, at the height of the nearest raised cell of the same outline.

    Returns
    -------
    raised : the cells; outlines raised; outlines left alone because nothing stands in them.
    """
    grid = terrain.grid
    parts, lifted, flat = [], 0, 0
    for number, outline in enumerate(footprints):
        progress.step(number / len(footprints))
        if outline is None or outline.is_empty:
            continue
        down, across, part = grid.window(*outline.bounds)
        if (not part.rows or not part.columns or down.stop <= rows.start or down.start >= rows.stop
                or across.stop <= columns.start or across.start >= columns.stop):
            continue
        x, y = centres(grid, down, across)
        shapely.prepare(outline)
        inside = shapely.contains_xy(outline, *np.broadcast_arrays(x, y[:, None]))
        z = terrain.surface(down, across)
        high = terrain.high(z, down, across, threshold) & inside
        if not high.any() or high.sum() < _STANDING * inside.sum():
            flat += 1
            continue
        low = inside & ~high
        if low.any():
            nearest = distance_transform_edt(~high, return_distances=False, return_indices=True)
            i, j = np.nonzero(low)
            parts.append((i + down.start, j + across.start, z[nearest[0][low], nearest[1][low]]))
            lifted += 1
    row, column, z = (np.concatenate(values) for values in zip(*parts)) if parts else (np.zeros(0, np.int64),) * 3
    order = np.lexsort((z, column, row))
    return Raised(row[order], column[order], z[order]), lifted, flat


def frame_sides(camera: Camera, pose: Pose, terrain: Terrain, rows: slice, columns: slice, threshold: float,
                raised: Raised | None = None, progress: Progress = SILENT) -> Sides:
    """Sides, in the frame, that enclose all that is raised in a window of the surface."""
    height = max(_STRIP_VERTICES // max(columns.stop - columns.start, 1), 2)
    parts = []
    for top in range(rows.start, rows.stop - 1, height):
        progress.step((top - rows.start) / (rows.stop - rows.start))
        # One row more than the strip: neighbours share it, and what they share cancels when it is filled.
        strip = slice(top, min(top + height + 1, rows.stop))
        z = terrain.surface(strip, columns)
        high = terrain.high(z, strip, columns, threshold)
        if raised is not None and len(raised.row):
            _lift(z, high, raised, strip, columns)
        parts.append(_strip_sides(camera, pose, terrain.grid, strip, columns, z, high))
    return Sides.joined(parts)


def _lift(z: np.ndarray, high: np.ndarray, raised: Raised, rows: slice, columns: slice) -> None:
    """Put raised cells into a window, in place; where outlines overlap, the highest."""
    part = slice(*np.searchsorted(raised.row, (rows.start, rows.stop)))
    column = raised.column[part] - columns.start
    within = (column >= 0) & (column < z.shape[1])
    place = raised.row[part][within] - rows.start, column[within]
    z[place] = raised.z[part][within]
    high[place] = True


def _strip_sides(camera: Camera, pose: Pose, grid: Grid, rows: slice, columns: slice, z: np.ndarray,
                 high: np.ndarray) -> Sides:
    """Sides of a strip of the surface."""
    needed = _touching(high)
    x, y = centres(grid, rows, columns)
    i, j = np.nonzero(needed)
    column, row = np.full(z.shape, np.nan), np.full(z.shape, np.nan)
    column[i, j], row[i, j], _ = project(camera, pose, np.stack([x[j], y[i], z[i, j]], axis=-1))
    return surface_sides(column, row, z, high).within(camera.width, camera.height)


def _touching(high: np.ndarray) -> np.ndarray:
    """Vertices of the cells with a high corner."""
    cell = high[:-1, :-1] | high[1:, :-1] | high[:-1, 1:] | high[1:, 1:]
    needed = np.zeros_like(high)
    for down in (slice(None, -1), slice(1, None)):
        for across in (slice(None, -1), slice(1, None)):
            needed[down, across] |= cell
    return needed


def _strips(camera: Camera, sides: Sides) -> Iterator[tuple[int, np.ndarray]]:
    """First row and mask (rows, width) of the frame's strips."""
    for first in range(0, camera.height, _STRIP_ROWS):
        yield first, fill(sides, camera.width, first, min(_STRIP_ROWS, camera.height - first))


def _write(output: str | os.PathLike, camera: Camera, sides: Sides, progress: Progress) -> int:
    """Write the mask strip by strip; returns how many pixels are masked."""
    profile = {"driver": "GTiff", "width": camera.width, "height": camera.height, "count": 1, "dtype": "uint8",
               "tiled": True, "blockxsize": _BLOCK, "blockysize": _BLOCK, "compress": "deflate", "zlevel": 1,
               "bigtiff": "if_safer"}
    hidden = 0
    try:
        with own_gdal(), written_beside(output) as temporary, warnings.catch_warnings():
            warnings.simplefilter("ignore", NotGeoreferencedWarning)
            with rasterio.open(temporary, "w", **profile) as target:
                for first, mask in _strips(camera, sides):
                    progress.step(first / camera.height)
                    hidden += int(np.count_nonzero(mask))
                    target.write(mask.view(np.uint8) * np.uint8(HIDDEN), 1,
                                 window=Window(0, first, camera.width, len(mask)))
    except RasterioError as error:
        raise OutputError(f"{Path(output).name} cannot be written ({error}): choose another output.") from error
    return hidden
