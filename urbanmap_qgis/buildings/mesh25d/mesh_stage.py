"""2.5D meshes of buildings from their points: surfaces, walls at the height steps, simplified to a stated error."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial

import numpy as np
import shapely

from ...errors import InsufficientDataError
from ...execution import in_order
from ...geometry.solid import Solid
from ...io.ply import mesh_writer
from ...io.points.pointcloud import PointCloud
from ...progress import SILENT, Progress
from ...settings.buildings import MeshSettings
from ...wording import say
from ..outlines.footprint import Footprints
from ..solids.validity import check_solid
from .height_grid import HeightGrid, height_grid
from .mesh_build import build_mesh
from .mesh_points import building_points
from .mesh_quality import MeshFit, is_watertight, mesh_fit
from .node_heights import border_heights
from .surface_plan import SurfacePlan, surface_plan

OK, COARSE, GROUND_UNKNOWN, NOT_MODELLED = "ok", "error exceeded", "ground unknown", "not modelled"
"""Status of a mesh: sound; fewer than 95 % of the uppermost points within the stated error; foot assumed; none."""

STOREY = 3.0

ENOUGH = 0.95
# Shares of the stated error, step and minimum area that are tried one after another while the points are not
# met.
TRIES = (1.0, 0.7, 0.4)
UNDER = 0.02  # Share of points under the uppermost surface that is told.
GAIN = 0.01  # More triangles must bring at least this share of points within the error.
CHECKED = 4000  # Meshes of up to so many triangles are checked for self-intersection.

DEFAULTS = MeshSettings()


@dataclass(frozen=True, eq=False)
class BuildingMesh:
    """The mesh of a building, None with a reason where there is none; valid: closed without self-intersection, None
    where that was not looked at; surfaces: pieces separated by height steps."""

    building_id: int
    mesh: Solid | None
    status: str
    reason: str
    base: float = math.nan
    surfaces: int = 0
    watertight: bool = False
    valid: bool | None = None
    fit: MeshFit | None = None


def mesh_buildings(cloud: PointCloud, footprints: Footprints, base: np.ndarray,
                   settings: MeshSettings = DEFAULTS, executor: Executor | None = None,
                   progress: Progress = SILENT) -> list[BuildingMesh]:
    """Meshes of all buildings, in the order of the outlines.

    Parameters
    ----------
    cloud : points with building_id, or any that the outlines cut.
    base : (n,) height of the ground, NaN where unknown.

    Raises
    ------
    InsufficientDataError : no outline has any point.
    """
    pieces = _pieces(cloud, footprints, base, progress)
    meshes = []
    for mesh in in_order(partial(_mesh_piece, settings=settings), pieces, executor, progress.check):
        progress.check()
        meshes.append(mesh)
    return meshes


def _pieces(cloud: PointCloud, footprints: Footprints, base: np.ndarray, progress: Progress) -> Iterator[tuple]:
    """Number, plan, points, base and note of each building."""
    for row, points, ground in building_points(cloud, footprints, progress.part(0.0, 0.4)):
        progress.step(0.4 + 0.6 * row / len(footprints))
        yield (int(footprints.ids[row]), footprints.polygons[row], points,
               float(base[row]) if np.isfinite(base[row]) else ground, footprints.notes[row])


def _mesh_piece(piece: tuple, settings: MeshSettings) -> BuildingMesh:
    *building, note = piece
    return mesh_building(*building, settings, note)


def mesh_building(number: int, plan: shapely.Geometry | None, points: np.ndarray, base: float,
                  settings: MeshSettings = DEFAULTS, note: str = "") -> BuildingMesh:
    """The mesh of one building from its points (n, 3) within its plan; `base`: height of the ground, NaN unknown."""
    if plan is None:
        return BuildingMesh(number, None, NOT_MODELLED, note or say("it has no outline"))
    try:
        assumed = not math.isfinite(base)
        if assumed and len(points):
            base = float(np.quantile(points[:, 2], 0.05)) - STOREY
        best = None
        for share in TRIES:
            mesh = _meshed(number, plan, points, base, settings, share)
            if best is None or (mesh.watertight, mesh.fit.within - GAIN) > (best.watertight, best.fit.within):
                best = mesh
            if best.watertight and best.fit.within >= ENOUGH:
                break
    except InsufficientDataError as error:
        return BuildingMesh(number, None, NOT_MODELLED, "; ".join(filter(None, (note, str(error)))))
    return _judged(best, assumed, note, settings)


def _meshed(number: int, plan: shapely.Geometry, points: np.ndarray, base: float, settings: MeshSettings,
            share: float) -> BuildingMesh:
    tolerance = share * settings.max_error
    heights = height_grid(points, plan, share * settings.step, share * settings.min_area)
    parts = surface_plan(heights, heights.grid.cell)
    cells = surface_cells(heights, parts)
    levels = border_heights(parts, cells, base, max(1.0, 3 * heights.grid.cell), 0.5 * tolerance)
    mesh = build_mesh(parts, levels, cells, base, 0.7 * tolerance)
    return BuildingMesh(number, mesh, OK, "", base, len(parts.label), is_watertight(mesh), None,
                        mesh_fit(mesh, points, settings.max_error))


def surface_cells(heights: HeightGrid, plan: SurfacePlan) -> list[np.ndarray]:
    """Places and smoothed heights (k, 3) of the measured cells of each surface; its nearest cell where it has none."""
    grid = heights.grid
    x, y = np.meshgrid(*grid.centres())
    smooth = _smoothed(heights)
    cells = []
    for surface, label in enumerate(plan.label.tolist()):
        rings = [plan.edges.coordinates(ring) for ring in plan.rings(surface)]
        shape = shapely.Polygon(rings[0], rings[1:])
        shapely.prepare(shape)
        inside = shapely.contains_xy(shape, x, y) & (heights.label == label)
        chosen = inside & heights.measured
        chosen = chosen if chosen.any() else inside if inside.any() else heights.label == label
        cells.append(np.column_stack([x[chosen], y[chosen], smooth[chosen]]))
    return cells


def _smoothed(heights: HeightGrid) -> np.ndarray:
    """Median of each cell and those beside it of its own surface."""
    z, label = heights.z, heights.label
    padded, names = np.pad(z, 1, constant_values=np.nan), np.pad(label, 1, constant_values=-1)
    rows, columns = z.shape
    stack = [np.where(names[i:i + rows, j:j + columns] == label, padded[i:i + rows, j:j + columns], np.nan)
             for i, j in ((1, 1), (0, 1), (2, 1), (1, 0), (1, 2))]
    return np.nanmedian(stack, axis=0)


def _judged(mesh: BuildingMesh, assumed: bool, note: str, settings: MeshSettings) -> BuildingMesh:
    """The mesh with its status; one that is not closed is not given."""
    reasons = [note] if note else []
    if not mesh.watertight:
        return BuildingMesh(mesh.building_id, None, NOT_MODELLED,
                            "; ".join([*reasons, say("no closed mesh could be made")]), mesh.base)
    valid = not check_solid(mesh.mesh) if len(mesh.mesh.faces) <= CHECKED else None
    status = OK
    if assumed:
        status = GROUND_UNKNOWN
        reasons.append(say("its ground is not known, the foot is put {storey:g} m under its lowest roof",
                           storey=STOREY))
    if mesh.fit.within < ENOUGH:
        status = COARSE
        reasons.append(say("only {within:.0f} % of its uppermost points lie within {max_error:g} m",
                           within=100 * mesh.fit.within, max_error=settings.max_error))
    if mesh.fit.under > UNDER:
        reasons.append(say("{under:.0f} % of its points lie under the uppermost surface, which alone is meshed",
                           under=100 * mesh.fit.under))
    if valid is False:
        reasons.append(say("its surfaces touch or cross somewhere"))
    return BuildingMesh(mesh.building_id, mesh.mesh, status, "; ".join(reasons), mesh.base, mesh.surfaces, True, valid,
                        mesh.fit)


MESH_COLUMNS = ("building_id", "status", "reason", "triangles", "surfaces", "base", "height", "points", "rmse", "p95",
                "max_error", "within", "watertight", "valid")
"""Names of the columns of meshes."""


def mesh_columns(meshes: Sequence[BuildingMesh]) -> dict[str, list]:
    """Columns of `MESH_COLUMNS`; distances in m, `within` the share of the uppermost points within the stated error."""
    rows = []
    for item in meshes:
        fit, mesh = item.fit, item.mesh
        top = float(mesh.vertices[:, 2].max()) - item.base if mesh else math.nan
        figures = (fit.points, fit.rmse, fit.p95, fit.max_distance, fit.within) if fit else (0, *(math.nan,) * 4)
        rows.append((item.building_id, item.status, item.reason, len(mesh.faces) if mesh else 0, item.surfaces,
                     item.base, top, *figures, item.watertight, item.valid))
    return {name: [row[place] for row in rows] for place, name in enumerate(MESH_COLUMNS)}


def total_fit(meshes: Sequence[BuildingMesh]) -> tuple[float, float]:
    """Share of the uppermost points within the stated error, and RMSE (m) of all; NaN without points."""
    fits = [item.fit for item in meshes if item.fit and math.isfinite(item.fit.rmse)]
    points = sum(fit.points for fit in fits)
    if not points:
        return math.nan, math.nan
    return (sum(fit.within * fit.points for fit in fits) / points,
            math.sqrt(sum(fit.rmse**2 * fit.points for fit in fits) / points))


def write_ply(path: str | os.PathLike, meshes: Sequence[BuildingMesh]) -> None:
    """Write all meshes to one binary PLY file."""
    with mesh_writer(path) as writer:
        for item in meshes:
            if item.mesh is not None:
                corners = np.array([face[0] for face in item.mesh.faces])
                first = writer.vertex_count
                writer.add_vertices(*item.mesh.vertices.T)
                writer.add_triangles(corners + first)
