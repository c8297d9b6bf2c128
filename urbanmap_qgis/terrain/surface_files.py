"""From point cloud files of any size to surface and ground rasters."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import Executor
from contextlib import ExitStack
from dataclasses import dataclass

import numpy as np

from ..errors import InsufficientDataError
from ..geometry.grid import Grid
from ..io.ply import mesh_writer
from ..io.points.pointcloud import open_cloud
from ..io.raster import write_raster
from ..io.reference.system_parts import metric_plane
from ..progress import SILENT, Progress
from ..settings.terrain import SurfaceSettings
from ..wording import say
from .cloud_tiles import CloudTiles
from .surface import GroundSource, ground_source
from .surface_canvas import Canvas


@dataclass(frozen=True)
class SurfaceSummary:
    """What was made.

    Attributes
    ----------
    points_read : all points in the files.
    points_used : without noise, withheld and points alone in space.
    ground_points : points taken as ground, None if no ground was asked for.
    ground_method : "classes", "cloth" or "".
    triangles : of the surface.
    triangles_left_out : longer than `max_edge`.
    empty_share : share of the cells without a height.
    far_share : share of the raster in triangles with a side of 10 m or more (for coarse rasters and sparse clouds 14
        cells or spacings), where the surface is a guess.
    grid : place of the rasters.
    crs_wkt : their CRS.
    """

    points_read: int
    points_used: int
    ground_points: int | None
    ground_method: str
    triangles: int
    triangles_left_out: int
    empty_share: float
    far_share: float
    grid: Grid
    crs_wkt: str


def surfaces_from_files(paths: Sequence[str | os.PathLike], surface_path: str | os.PathLike,
                        ground_path: str | os.PathLike | None = None, mesh_path: str | os.PathLike | None = None,
                        settings: SurfaceSettings | None = None, progress: Progress = SILENT,
                        executor: Executor | None = None, crs_wkt: str | None = None) -> SurfaceSummary:
    """Write the surface (DSM), the ground and the mesh of point cloud files (J 3.2.1.1, 4.1).

    The points are read once and sorted into tiles on disk; memory holds some tiles and the rasters. The result
    does not depend on the tiles nor on the executor.

    Parameters
    ----------
    paths : LAS, LAZ or COPC files.
    surface_path, ground_path : GeoTIFFs.
    mesh_path : PLY.
    crs_wkt : CRS where the files state none.

    Raises
    ------
    InputError : files, CRS or settings cannot be used.
    InsufficientDataError : too few points, or no ground points although the ground is asked for.
    OutputError : a result cannot be written.
    """
    cloud, settings = open_cloud(paths, crs_wkt), settings or SurfaceSettings()
    wkt = metric_plane(cloud.paths[0].name, cloud.crs_wkt).to_wkt()
    with ExitStack() as stack:
        points = CloudTiles(cloud, settings, executor, stack)
        points.read(progress.part(0.0, 0.35))
        source = _ground_source(points, progress) if ground_path else None
        points.reduce(source, progress.part(0.35, 0.6))
        mesh = stack.enter_context(mesh_writer(mesh_path)) if mesh_path else None
        surface = Canvas(points, points.highest, progress.part(0.6, 0.8), settings.max_edge, mesh)
        ground = _ground_under(surface, points, progress.part(0.8, 0.9)) if source else None
        _tell_gaps(surface, settings, progress)
        write_raster(surface_path, surface.raster, points.grid, wkt, progress=progress.part(0.9, 0.95))
        if ground is not None:
            write_raster(ground_path, ground, points.grid, wkt, progress=progress.part(0.95, 1.0))
        progress.step(1.0)
        empty = float(np.count_nonzero(np.isnan(surface.raster))) / surface.raster.size
        return SurfaceSummary(cloud.point_count, points.points_used, points.ground_points if source else None,
                              source.method if source else "", surface.triangles, surface.left_out, empty,
                              surface.far_share, points.grid, wkt)


def _ground_source(points: CloudTiles, progress: Progress) -> GroundSource:
    """Where the ground comes from, said with its reason."""
    source = ground_source(points.class_counts, points.settings.ground)
    progress.message(say("Ground by {value}: {reason}.",
                         value=say("classes") if source.method == "classes" else say("the cloth filter"),
                         reason=source.reason))
    return source


def _ground_under(surface: Canvas, points: CloudTiles, progress: Progress) -> np.ndarray:
    """(rows, columns) heights of the ground where the surface is; fills the surface's gaps where that is wished."""
    if not points.ground_points:
        raise InsufficientDataError(say("No ground points were found: check that the cloud shows the ground."))
    ground = Canvas(points, points.ground, progress, framed=True).raster
    if points.settings.ground_in_gaps:
        gap = np.isnan(surface.raster) & surface.covered
        surface.raster[gap] = ground[gap]
    ground[~surface.covered] = np.nan
    return ground


def _tell_gaps(surface: Canvas, settings: SurfaceSettings, progress: Progress) -> None:
    """Say what of the surface was left out, or is a guess."""
    if surface.left_out:
        progress.message(say("{left_out:,} of {triangles:,} triangles were longer than {max_edge:g} m and left "
                             "out.", left_out=surface.left_out, triangles=surface.triangles,
                             max_edge=settings.max_edge))
    if surface.far_share > 0.05 and not settings.max_edge:
        progress.warn(say("{far_share:.0f} % of the surface spans {far:g} m or more without points (water, "
                          "gaps): set a longest edge to leave such places out.", far_share=100 * surface.far_share,
                          far=surface.far))
