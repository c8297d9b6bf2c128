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

from ...errors import InputError, OutputError
from ...geometry.grid import Grid
from ...io.files.atomic import written_beside
from ...io.raster import own_gdal
from ...progress import SILENT, Progress
from ...settings.aerial import OcclusionSettings
from ...wording import say
from .camera import ExteriorOrientation, FrameCamera, frame_rays, project_to_frame
from .normalised_surface import NormalisedSurface, cell_centres, wall_offsets
from .silhouette import SilhouetteEdges, fill_silhouette, silhouette_edges

HIDDEN = 255
_STRIP_VERTICES = 1_000_000
_STRIP_ROWS = 512

BLOCK = 256
PROBES = 64
DEEPER = 15.0
STANDING_HEIGHT = 2.0
STANDING_SHARE = 0.1

DEFAULT_OCCLUSION = OcclusionSettings()

PAPER_OCCLUSION = OcclusionSettings(low_parts=False, steepen_walls=False, shift_walls=False)
"""J 3.2.1.1: the triangles of the surface with a corner above the threshold, as they are."""


@dataclass(frozen=True)
class OcclusionSummary:
    """What was made.

    Attributes
    ----------
    hidden_share : share of the frame's pixels that are masked.
    uncovered_share : share of the frame that looks beyond the surface or ground raster, so that nothing is known.
    footprints_raised : outlines with a building.
    footprints_flat : outlines where the surface shows none (less than a tenth of their cells stands 2 m above the
        ground), which were left alone.
    """

    hidden_share: float
    uncovered_share: float
    footprints_raised: int
    footprints_flat: int


@dataclass(frozen=True)
class RaisedCells:
    """Cells of a surface raster that outlines lift, in order of rows: (n,) rows, columns and heights, m."""

    row: np.ndarray
    column: np.ndarray
    z: np.ndarray


def occlusion_map(camera: FrameCamera, pose: ExteriorOrientation, dsm: str | os.PathLike, ground: str | os.PathLike,
                  output: str | os.PathLike, settings: OcclusionSettings = DEFAULT_OCCLUSION, footprints: Sequence = (),
                  progress: Progress = SILENT) -> OcclusionSummary:
    """Write the mask of a frame: 255 where a pixel shows a building or what a building hides, else 0.

    The surface between the centres of the raster's cells is a mesh; its triangles with a corner higher than the
    threshold above the ground are filled in the frame, walls included.

    Parameters
    ----------
    dsm, ground : rasters of the surface and of the ground, heights in the system of the pose, m.
    output : TIFF with the frame's rows and columns, compressed.
    footprints : shapely polygons of buildings, lower ones than the threshold too; cells inside that the surface shows
        low are raised to the nearest cell of the same outline that is not.

    Raises
    ------
    InputError : a raster cannot be read, or the surface does not reach the frame.
    OutputError : nothing can be written.
    """
    with NormalisedSurface(dsm, ground) as surface:
        rows, columns, uncovered = frame_window(camera, pose, surface)
        if uncovered > 0.01:
            progress.warn(say("{uncovered:.0%} of {image} looks beyond the surface or the ground raster: buildings "
                              "there are not masked.", uncovered=uncovered, image=pose.image))
        raised, lifted, flat = raise_footprints(surface, footprints, rows, columns, settings, progress.part(0, 0.2))
        sides = frame_silhouette(camera, pose, surface, rows, columns, settings, raised, progress.part(0.2, 0.7))
    hidden = _write(output, camera, sides, progress.part(0.7, 1.0))
    return OcclusionSummary(hidden / (camera.width * camera.height), uncovered, lifted, flat)


def occlusion_mask(camera: FrameCamera, pose: ExteriorOrientation, surface: NormalisedSurface,
                   settings: OcclusionSettings = DEFAULT_OCCLUSION, footprints: Sequence = ()) -> np.ndarray:
    """The mask of `occlusion_map` as an array (rows, columns) bool."""
    rows, columns, _ = frame_window(camera, pose, surface)
    raised, _, _ = raise_footprints(surface, footprints, rows, columns, settings)
    sides = frame_silhouette(camera, pose, surface, rows, columns, settings, raised)
    return np.concatenate([mask for _, mask in _strips(camera, sides)])


def frame_window(camera: FrameCamera, pose: ExteriorOrientation, surface: NormalisedSurface
                 ) -> tuple[slice, slice, float]:
    """Rows and columns of the surface that the frame may see, and the share of the frame that looks beyond.

    Whatever the frame sees lies between the projection centre and a level below all ground.

    Raises
    ------
    InputError : the frame looks past the surface altogether.
    """
    grid, ground = surface.grid, surface.ground
    column, row = np.meshgrid(np.linspace(-0.5, camera.width - 0.5, PROBES),
                              np.linspace(-0.5, camera.height - 0.5, PROBES))
    ray = frame_rays(camera, pose, column.ravel(), row.ravel())
    x, y = (values.ravel() for values in np.meshgrid(*(
        np.linspace(low, high, PROBES) for low, high in zip(ground.grid.bounds[:2], ground.grid.bounds[2:]))))
    for _ in range(3):
        heights = ground.sample(x, y)
        if not np.isfinite(heights).any():
            break
        level = float(np.nanmedian(heights))
        bounds = _reach(pose, ray, float(np.nanmin(heights)) - DEEPER, grid)
        x, y = (values.ravel() for values in np.meshgrid(np.linspace(bounds[0], bounds[2], PROBES),
                                                         np.linspace(bounds[1], bounds[3], PROBES)))
    else:
        rows, columns, part = grid.window(*bounds)
        seen = surface.known(*_meet(pose, ray, level))
        if part.rows > 1 and part.columns > 1 and seen.any():
            return rows, columns, float(1 - seen.mean())
    raise InputError(say("{image} looks past the surface and ground rasters: choose rasters of its place, and check "
                         "that heights, CRS and angles fit.", image=pose.image))


def _meet(pose: ExteriorOrientation, ray: np.ndarray, level: float) -> tuple[np.ndarray, np.ndarray]:
    """x and y where rays (n, 3) meet a level, NaN where they do not."""
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = (level - pose.z) / ray[:, 2]
        distance = np.where(distance > 0, distance, np.nan)
    return pose.x + distance * ray[:, 0], pose.y + distance * ray[:, 1]


def _reach(pose: ExteriorOrientation, ray: np.ndarray, level: float, grid: Grid) -> tuple[float, float, float, float]:
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


def raise_footprints(surface: NormalisedSurface, footprints: Sequence, rows: slice, columns: slice,
                     settings: OcclusionSettings = DEFAULT_OCCLUSION, progress: Progress = SILENT
                     ) -> tuple[RaisedCells, int, int]:
    """Cells inside outlines; those that the surface shows low at the height of the nearest one that stands.

    Inside an outline a cell stands that is 2 m above the ground, or the threshold if that is less: no vehicle can be
    mistaken for the building there.

    Returns
    -------
    raised : the cells; how many outlines were raised; how many were left alone because nothing stands in them.
    """
    grid = surface.grid
    parts, lifted, flat = [], 0, 0
    for number, outline in enumerate(footprints):
        progress.step(number / len(footprints))
        if outline is None or outline.is_empty:
            continue
        down, across, part = grid.window(*outline.bounds)
        if (not part.rows or not part.columns or down.stop <= rows.start or down.start >= rows.stop
                or across.stop <= columns.start or across.start >= columns.stop):
            continue
        x, y = np.broadcast_arrays(*cell_centres(grid, down, across))
        shapely.prepare(outline)
        inside = shapely.contains_xy(outline, x, y)
        z, above = surface.heights(down, across)
        standing = (above > min(settings.threshold, STANDING_HEIGHT)) & inside
        if not standing.any() or standing.sum() < STANDING_SHARE * inside.sum():
            flat += 1
            continue
        nearest = distance_transform_edt(~standing, return_distances=False, return_indices=True)
        i, j = np.nonzero(inside)
        parts.append((i + down.start, j + across.start, z[nearest[0][i, j], nearest[1][i, j]]))
        lifted += 1
    row, column, z = (np.concatenate(values) for values in zip(*parts)) if parts else (np.zeros(0, np.int64),) * 3
    order = np.lexsort((z, column, row))
    return RaisedCells(row[order], column[order], z[order]), lifted, flat


def frame_silhouette(camera: FrameCamera, pose: ExteriorOrientation, surface: NormalisedSurface, rows: slice,
                     columns: slice, settings: OcclusionSettings = DEFAULT_OCCLUSION, raised: RaisedCells | None = None,
                     progress: Progress = SILENT) -> SilhouetteEdges:
    """Sides, in the frame, that enclose all that is raised in a window of the surface."""
    height = max(_STRIP_VERTICES // max(columns.stop - columns.start, 1), 2)
    parts = []
    for top in range(rows.start, rows.stop - 1, height):
        progress.step((top - rows.start) / (rows.stop - rows.start))
        # One row more than the strip: neighbours share it, and what they share cancels when it is filled.
        strip = slice(top, min(top + height + 1, rows.stop))
        wider = slice(max(top - 1, rows.start), min(strip.stop + 1, rows.stop))
        z, high = surface.raised(wider, columns, settings.threshold, settings.low_parts, settings.steepen_walls)
        if raised is not None and len(raised.row):
            _lift(z, high, raised, wider, columns)
        points = _vertices(surface.grid, wider, columns, high, settings.shift_walls)
        inner = slice(strip.start - wider.start, strip.stop - wider.start)
        parts.append(_strip_silhouette(camera, pose, *(values[inner] for values in (*points, z, high))))
    return SilhouetteEdges.joined(parts)


def _lift(z: np.ndarray, high: np.ndarray, raised: RaisedCells, rows: slice, columns: slice) -> None:
    """Put raised cells into a window, in place; where outlines overlap, the highest."""
    part = slice(*np.searchsorted(raised.row, (rows.start, rows.stop)))
    column = raised.column[part] - columns.start
    within = (column >= 0) & (column < z.shape[1])
    place = raised.row[part][within] - rows.start, column[within]
    z[place] = raised.z[part][within]
    high[place] = True


def _vertices(grid: Grid, rows: slice, columns: slice, high: np.ndarray,
              shift_walls: bool) -> tuple[np.ndarray, np.ndarray]:
    """x and y of the mesh's vertices in a window: cell centres, moved to the walls beside them where asked."""
    x, y = cell_centres(grid, rows, columns)
    if not shift_walls:
        return np.broadcast_arrays(x, y)
    east, north = wall_offsets(high, grid.cell)
    return x + east, y + north


def _strip_silhouette(camera: FrameCamera, pose: ExteriorOrientation, x: np.ndarray, y: np.ndarray, z: np.ndarray,
                      high: np.ndarray) -> SilhouetteEdges:
    """Sides of a strip of the surface; all (m, n)."""
    needed = _touching(high)
    # Half the time of doubles; a column of 100 megapixels is good to a thousandth of a pixel.
    column, row = np.full(z.shape, np.nan, np.float32), np.full(z.shape, np.nan, np.float32)
    points = np.stack([x[needed], y[needed], z[needed]], axis=-1)
    column[needed], row[needed], _ = project_to_frame(camera, pose, points)
    return silhouette_edges(column, row, z, high).within(camera.width, camera.height)


def _touching(high: np.ndarray) -> np.ndarray:
    """Vertices of the cells with a high corner."""
    cell = high[:-1, :-1] | high[1:, :-1] | high[:-1, 1:] | high[1:, 1:]
    needed = np.zeros_like(high)
    for down in (slice(None, -1), slice(1, None)):
        for across in (slice(None, -1), slice(1, None)):
            needed[down, across] |= cell
    return needed


def _strips(camera: FrameCamera, sides: SilhouetteEdges) -> Iterator[tuple[int, np.ndarray]]:
    """First row and mask (rows, width) of the frame's strips."""
    for first in range(0, camera.height, _STRIP_ROWS):
        yield first, fill_silhouette(sides, camera.width, first, min(_STRIP_ROWS, camera.height - first))


def _write(output: str | os.PathLike, camera: FrameCamera, sides: SilhouetteEdges, progress: Progress) -> int:
    """Write the mask strip by strip; returns how many pixels are masked."""
    profile = {"driver": "GTiff", "width": camera.width, "height": camera.height, "count": 1, "dtype": "uint8",
               "tiled": True, "blockxsize": BLOCK, "blockysize": BLOCK, "compress": "deflate",
               "zlevel": 1, "bigtiff": "if_safer"}
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
        raise OutputError(say("{output} cannot be written ({error}): choose another output.", output=Path(output).name,
                              error=error)) from error
    return hidden
