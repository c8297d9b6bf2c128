"""From point cloud files of any size to surface and ground rasters."""

from __future__ import annotations

import math
import os
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from pyproj import CRS

from ..errors import InputError, InsufficientDataError
from ..execution import in_order
from ..geometry.grid import Grid
from ..io.ply import MeshWriter, mesh_writer
from ..io.points.point_buckets import PointBuckets
from ..io.points.pointcloud import PointCloud, iter_chunks, open_cloud, plan_crs, valid_points
from ..io.raster import write_raster
from ..progress import SILENT, Progress
from ..wording import say
from .cloth import JAVANMARDI, ClothSettings, LowestHeights, final_cloth, first_cloth
from .delaunay import Blocks, bridge, cancel_twins
from .outliers import isolation_limit, plausible
from .rasterise import rasterise
from .surface import GROUND_CLASSES, GroundSource, frame_points, ground_source, shorter
from .tiles import (
    LEFT_OUT,
    POINT,
    VERTEX,
    ClothPart,
    TilePoints,
    TileSurface,
    TileVertices,
    Tiling,
    ground_of_tile,
    layer_of_tile,
    point_margin,
    reduce_tile,
    triangulate_tile,
)


@dataclass(frozen=True)
class SurfaceFilesLimits:
    """Limits of surface files, each with its unit."""

    most_cells: int = 4_000_000_000
    most_nodes: int = 100_000_000
    place: float = 1000.0  # m
    # times the squares of `place` with points: a corridor of 100 km from corner to corner takes 35
    least_filled: int = 300
    in_memory: int = 1_000_000_000
    widest_spacing: float = 5.0
    far: float = 10.0


LIMITS = SurfaceFilesLimits()


@dataclass(frozen=True)
class SurfaceSettings:
    """How surfaces are made.

    Parameters
    ----------
    resolution : raster cell, m.
    ground : where ground points come from: "automatic", "classes" or "cloth".
    cloth : parameters of the cloth filter.
    max_edge : triangles of the surface with a longer side in plan, m, are left out; 0 keeps all.
    ground_in_gaps : where triangles were left out, the surface is the ground.
    """

    resolution: float = 0.5
    ground: str = "automatic"
    cloth: ClothSettings = JAVANMARDI
    max_edge: float = 0.0
    ground_in_gaps: bool = False

    def __post_init__(self) -> None:
        if not self.resolution > 0:
            raise InputError(say("The resolution must be greater than 0."))
        if not self.max_edge >= 0:
            raise InputError(say("The longest edge must be 0 or greater."))


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


def metric_crs_wkt(cloud: PointCloud) -> str:
    """WKT of the cloud's CRS, which must be projected and in metres.

    Raises
    ------
    InputError : it is missing, geographic or in other units.
    """
    name = cloud.paths[0].name
    if not cloud.crs_wkt:
        raise InputError(say("{name} states no coordinate reference system: assign one to the file first.", name=name))
    crs = plan_crs(CRS.from_wkt(cloud.crs_wkt))
    if not crs.is_projected:
        raise InputError(say("{name} is in {crs}, which is not projected: reproject it to metres first.", name=name,
                             crs=crs.name))
    if any(abs(axis.unit_conversion_factor - 1.0) > 1e-9 for axis in crs.axis_info):
        raise InputError(say("{name} is in {crs}, which is not in metres: reproject it to metres first.", name=name,
                             crs=crs.name))
    return crs.to_wkt()


def surfaces_from_files(paths: Sequence[str | os.PathLike], surface_path: str | os.PathLike,
                        ground_path: str | os.PathLike | None = None, mesh_path: str | os.PathLike | None = None,
                        settings: SurfaceSettings = SurfaceSettings(), progress: Progress = SILENT,
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
    cloud = open_cloud(paths, crs_wkt)
    wkt = metric_crs_wkt(cloud)
    with ExitStack() as stack:
        work = _Work(cloud, settings, executor, stack)
        work.read(progress.part(0.0, 0.35))
        source = ground_source(work.class_counts, settings.ground) if ground_path else None
        if source:
            progress.message(say("Ground by {value}: {reason}.",
                                 value=say("classes") if source.method == "classes" else say("the cloth filter"),
                                 reason=source.reason))
        work.reduce(source, progress.part(0.35, 0.6))
        mesh = stack.enter_context(mesh_writer(mesh_path)) if mesh_path else None
        surface = _Canvas(work, work.highest, progress.part(0.6, 0.8), settings.max_edge, mesh)
        ground = None
        if source:
            if not work.ground_points:
                raise InsufficientDataError(say("No ground points were found: check that the cloud shows the ground."))
            ground = _Canvas(work, work.ground, progress.part(0.8, 0.9), framed=True).raster
            if settings.ground_in_gaps:
                gap = np.isnan(surface.raster) & surface.covered
                surface.raster[gap] = ground[gap]
            ground[~surface.covered] = np.nan
        empty = float(np.count_nonzero(np.isnan(surface.raster))) / surface.raster.size
        if surface.left_out:
            progress.message(say("{left_out:,} of {triangles:,} triangles were longer than {max_edge:g} m and left "
                                 "out.", left_out=surface.left_out, triangles=surface.triangles,
                                 max_edge=settings.max_edge))
        if surface.far_share > 0.05 and not settings.max_edge:
            progress.warn(say("{far_share:.0f} % of the surface spans {far:g} m or more without points (water, "
                              "gaps): set a longest edge to leave such places out.", far_share=100 * surface.far_share,
                              far=surface.far))
        write_raster(surface_path, surface.raster, work.grid, wkt, progress=progress.part(0.9, 0.95))
        if ground is not None:
            write_raster(ground_path, ground, work.grid, wkt, progress=progress.part(0.95, 1.0))
        progress.step(1.0)
        return SurfaceSummary(cloud.point_count, work.points_used, work.ground_points if source else None,
                              source.method if source else "", surface.triangles, surface.left_out, empty,
                              surface.far_share, work.grid, wkt)


class _Work:
    """The points of a cloud on their way to vertices, tile by tile."""

    def __init__(self, cloud: PointCloud, settings: SurfaceSettings, executor: Executor | None, stack: ExitStack):
        self.cloud, self.settings, self.executor, self.stack = cloud, settings, executor, stack
        extent = np.maximum(cloud.maximum[:2] - cloud.minimum[:2], settings.resolution)
        area = float(extent[0] * extent[1])
        spacing = math.sqrt(area / cloud.point_count)
        self.neighbours = isolation_limit(cloud.point_count, area)
        self.blocks = Blocks.for_spacing(max(settings.resolution, min(spacing, LIMITS.widest_spacing)))
        self.tiling = Tiling.for_blocks(settings.resolution, self.blocks)
        self.points = stack.enter_context(PointBuckets(POINT))
        self.highest, self.ground = _Vertices(stack), _Vertices(stack)
        self.class_counts = np.zeros(256, dtype=np.int64)
        self.keys: list[int] = []
        self.ground_points = 0

    @property
    def points_used(self) -> int:
        """Points that are neither noise nor withheld and have a height in reason."""
        return int(self.class_counts.sum())

    def read(self, progress: Progress) -> None:
        """Sort the points into tiles; find the extent."""
        low, high, keys, places = np.full(2, np.inf), np.full(2, -np.inf), set(), Counter()
        for chunk in iter_chunks(self.cloud, progress):
            records = np.empty(len(chunk), dtype=POINT)
            records["x"], records["y"], records["z"] = chunk.x, chunk.y, chunk.z
            records["c"] = chunk.classification
            records = records[valid_points(chunk) & plausible(records["x"], records["y"], records["z"])]
            if not len(records):
                continue
            self.class_counts += np.bincount(records["c"], minlength=256)
            low = np.minimum(low, [records["x"].min(), records["y"].min()])
            high = np.maximum(high, [records["x"].max(), records["y"].max()])
            tile = self.tiling.keys(records["x"], records["y"])
            keys.update(np.unique(tile).tolist())
            place, count = np.unique(np.floor(records["x"] / LIMITS.place) + 1j * np.floor(records["y"] / LIMITS.place),
                                     return_counts=True)
            places.update(dict(zip(place.tolist(), count.tolist())))
            self.points.add(tile, records)
        if not keys:
            raise InsufficientDataError(say("{paths} holds no usable points: all are noise, withheld or have no "
                                            "valid height.", paths=self.cloud.paths[0].name))
        self.keys = sorted(keys)
        self.grid = Grid.covering(*low, *high, self.settings.resolution)
        if self.grid.rows * self.grid.columns > LIMITS.most_cells:
            raise InputError(say("The raster would have {columns:,} x {rows:,} cells: choose a coarser resolution, "
                                 "or check for points far outside the area.", columns=self.grid.columns,
                                 rows=self.grid.rows))
        _require_filled(places)
        cell = self.settings.cloth.resolution
        cloth = Grid.covering(*low, *high, cell)
        self.cloth_grid = Grid(cloth.x_min, cloth.y_max, cell, cloth.rows + 1, cloth.columns + 1)

    def reduce(self, source: GroundSource | None, progress: Progress) -> None:
        """Highest points and ground points of all cells."""
        with_cloth = source is not None and source.method == "cloth"
        grid = self.cloth_grid if with_cloth else None
        if grid and grid.rows * grid.columns > LIMITS.most_nodes:
            raise InputError(say("The area is too large for one cloth: choose a coarser cloth resolution."))
        levels = [np.full(grid.shape, fill) for fill in (np.inf, np.inf, 0)] if grid else []
        work = partial(reduce_tile, cell=self.settings.resolution, neighbours=self.neighbours, cloth_grid=grid)
        progress.message(say("Finding the highest points of the cells."))
        pieces = self._tiles(point_margin(self.settings.cloth))
        for step, (highest, ground, part) in enumerate(in_order(work, pieces, self.executor)):
            self.highest.add(self.keys[step], highest)
            self.ground.add(self.keys[step], ground)
            if part:
                _put(levels, part)
            progress.step(0.4 * (step + 1) / len(self.keys))
        if with_cloth:
            self._drape(LowestHeights(*levels), progress.part(0.4, 1.0))
        elif source:
            self.ground_points = int(self.class_counts[list(GROUND_CLASSES)].sum())

    def _drape(self, levels: LowestHeights, progress: Progress) -> None:
        """Ground points by the cloth."""
        cloth = self.settings.cloth
        progress.message(say("Settling the cloth."))
        first, trend, lowest = first_cloth(levels, cloth, progress.part(0.0, 0.2))
        layer = [np.full(lowest.shape, np.inf)]
        work = partial(layer_of_tile, cloth_grid=self.cloth_grid, lowest=lowest, cloth=first)
        for step, part in enumerate(in_order(work, self._tiles(cloth.resolution), self.executor)):
            _put(layer, part)
            progress.step(0.2 + 0.3 * (step + 1) / len(self.keys))
        converged = final_cloth(layer[0], trend, cloth, progress.part(0.5, 0.6))
        work = partial(ground_of_tile, cell=self.settings.resolution, cloth_grid=self.cloth_grid, lowest=lowest,
                       cloth=converged, threshold=cloth.threshold)
        for step, (ground, count) in enumerate(in_order(work, self._tiles(0.0), self.executor)):
            self.ground.add(self.keys[step], ground)
            self.ground_points += count
            progress.step(0.6 + 0.4 * (step + 1) / len(self.keys))

    def _tiles(self, margin: float) -> Iterator[TilePoints]:
        """The points of each tile with those of a margin round it."""
        known = set(self.keys)
        for key in self.keys:
            inside = self.points.read(key)
            x_min, y_min, x_max, y_max = box = self.tiling.box(key)
            parts = [inside]
            for neighbour in self.tiling.around(key)[1:] if margin else []:
                if neighbour in known:
                    other = self.points.read(neighbour)
                    near = ((other["x"] >= x_min - margin) & (other["x"] <= x_max + margin)
                            & (other["y"] >= y_min - margin) & (other["y"] <= y_max + margin))
                    parts.append(other[near])
            yield TilePoints(np.concatenate(parts), len(inside), box)


def _require_filled(places: Counter[complex]) -> None:
    """Refuse points whose squares of `LIMITS.place` fill next to nothing of their box: one strange place does that."""
    corners = np.array([(place.real, place.imag) for place in places])
    if np.prod(np.ptp(corners, axis=0) + 1) > LIMITS.least_filled * len(corners):
        most = places.most_common(1)[0][0]
        away = np.linalg.norm(corners - (most.real, most.imag), axis=1) * LIMITS.place / 1000
        x, y = (corners[np.argmax(away)] + 0.5) * LIMITS.place
        raise InputError(say("The points fill next to nothing of the box around them, and some lie near "
                             "{x:.0f}, {y:.0f}, {length:.0f} km from the others: remove those, or work on the "
                             "places one by one.", x=x, y=y, length=away.max()))


def _put(layers: list[np.ndarray], part: ClothPart) -> None:
    """Lay a tile's nodes into the whole."""
    for layer, values in zip(layers, part.layers):
        layer[part.rows, part.columns] = values


class _Vertices:
    """Vertices of a surface by tiles, numbered from 0 in the order of the tiles' keys."""

    def __init__(self, stack: ExitStack):
        self._buckets = stack.enter_context(PointBuckets(VERTEX))
        self.counts: dict[int, int] = {}

    def add(self, key: int, vertices: np.ndarray) -> None:
        """Add the vertices of a tile."""
        if len(vertices):
            self._buckets.add(np.full(len(vertices), key), vertices)
            self.counts[key] = self.counts.get(key, 0) + len(vertices)

    def read(self, key: int) -> np.ndarray:
        """Vertices of a tile."""
        return self._buckets.read(key)

    def starts(self) -> dict[int, int]:
        """Number of the first vertex of each tile."""
        keys = sorted(self.counts)
        ends = np.cumsum([self.counts[key] for key in keys])
        return {key: int(end) - self.counts[key] for key, end in zip(keys, ends)}


class _Canvas:
    """One surface on the whole raster.

    While it is made, `LEFT_OUT` marks cells of triangles that are left out.

    Attributes
    ----------
    raster : (rows, columns) float32.
    covered : cells inside the surface's outline, also where triangles were left out.
    triangles, left_out, far_share : see `SurfaceSummary`.
    """

    def __init__(self, work: _Work, vertices: _Vertices, progress: Progress, max_edge: float = 0.0,
                 mesh: MeshWriter | None = None, framed: bool = False):
        self.work, self.vertices, self.max_edge, self.mesh = work, vertices, max_edge, mesh
        self.triangles = self.left_out = 0
        self.far = max(LIMITS.far, 2 * work.blocks.radius)
        progress.message(say("Triangulating the ground.") if framed else say("Triangulating the surface."))
        self.raster = self._blank()
        if mesh:
            for key in sorted(vertices.counts):
                piece = vertices.read(key)
                mesh.add_vertices(piece["x"], piece["y"], piece["z"])
        edges, numbers, places = self._small(progress.part(0.0, 0.9))
        self._large(edges, numbers, places, framed)
        progress.step(1.0)

    def _blank(self) -> np.ndarray:
        """An empty raster, in a temporary file if it is large."""
        shape = self.work.grid.shape
        if 4 * shape[0] * shape[1] <= LIMITS.in_memory:
            return np.full(shape, np.nan, dtype=np.float32)
        folder = self.work.stack.enter_context(tempfile.TemporaryDirectory(prefix="urbanmap-"))
        raster = np.memmap(Path(folder) / "raster", dtype=np.float32, mode="w+", shape=shape)
        raster[:] = np.nan
        return raster

    def _small(self, progress: Progress) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Lay the small triangles of all tiles; open edges, and numbers and places of what is on the rim."""
        keys = sorted({near for key in self.vertices.counts for near in self.work.tiling.around(key)})
        work = partial(triangulate_tile, tiling=self.work.tiling, blocks=self.work.blocks, grid=self.work.grid,
                       max_edge=self.max_edge)
        edges, numbers, places = ([np.empty((0, 2), dtype=np.int64)], [np.empty(0, dtype=np.int64)],
                                  [np.empty(0, dtype=VERTEX)])
        unused, used_elsewhere = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
        for step, tile in enumerate(in_order(work, self._tiles(keys), self.work.executor)):
            self._lay(tile)
            edges.append(tile.edges)
            numbers.append(tile.numbers)
            places.append(tile.vertices)
            unused.append(tile.unused)
            used_elsewhere.append(tile.used_elsewhere)
            progress.step((step + 1) / len(keys))
        open_edges = cancel_twins(np.concatenate(edges))
        alone = np.setdiff1d(np.concatenate(unused), np.concatenate(used_elsewhere))
        wanted = np.union1d(open_edges, alone)
        known, first = np.unique(np.concatenate(numbers), return_index=True)
        return open_edges, wanted, np.concatenate(places)[first[np.searchsorted(known, wanted)]]

    def _tiles(self, keys: list[int]) -> Iterator[TileVertices]:
        """Vertices of each tile and of a margin that holds its blocks."""
        starts = self.vertices.starts()
        margin = self.work.blocks.side + self.work.blocks.radius + 1.0
        for key in keys:
            x_min, y_min, x_max, y_max = self.work.tiling.box(key)
            parts, numbers, in_tile = [], [], []
            for near in sorted(self.work.tiling.around(key)):
                if near not in starts:
                    continue
                piece = self.vertices.read(near)
                inside = ((piece["x"] >= x_min - margin) & (piece["x"] <= x_max + margin)
                          & (piece["y"] >= y_min - margin) & (piece["y"] <= y_max + margin))
                parts.append(piece[inside])
                numbers.append(starts[near] + np.flatnonzero(inside))
                in_tile.append(np.full(len(parts[-1]), near == key))
            records = np.concatenate(parts)
            yield TileVertices(*(np.ascontiguousarray(records[name]) for name in "xyz"), np.concatenate(numbers),
                               np.concatenate(in_tile), key)

    def _lay(self, tile: TileSurface) -> None:
        """Put a tile's heights onto the raster and its triangles into the mesh."""
        target = self.raster[tile.rows, tile.columns]
        filled = ~np.isnan(tile.raster)
        target[filled] = tile.raster[filled]
        self.triangles += tile.count
        self.left_out += tile.count - len(tile.triangles)
        if self.mesh:
            self.mesh.add_triangles(tile.triangles)

    def _large(self, edges: np.ndarray, numbers: np.ndarray, places: np.ndarray, framed: bool) -> None:
        """Close the gaps between the small triangles."""
        x, y, z = (np.ascontiguousarray(places[name]) for name in "xyz")
        rim = np.searchsorted(numbers, edges)
        if framed:
            frame = frame_points(x, y, z, self.work.grid.bounds)
            x, y, z = (np.concatenate(pair) for pair in zip((x, y, z), frame))
        large = bridge(x, y, rim)
        if not self.triangles + len(large):
            raise InsufficientDataError(say("The points lie in fewer than three places or on one line: a surface "
                                            "cannot be built from them."))
        small = shorter(x, y, large, self.max_edge)
        rasterise(x, y, z, small, self.work.grid, self.raster)
        if len(small) < len(large):
            rasterise(x, y, np.full(len(z), LEFT_OUT), large, self.work.grid, self.raster, only_empty=True)
        self.covered = ~np.isnan(self.raster)
        self.raster[self.raster == LEFT_OUT] = np.nan
        self.triangles += len(large)
        self.left_out += len(large) - len(small)
        if self.mesh:
            self.mesh.add_triangles(numbers[small])
        self.far_share = _share_of(x, y, small, shorter(x, y, small, self.far), self.work.grid) if not framed else 0.0


def _share_of(x: np.ndarray, y: np.ndarray, triangles: np.ndarray, without: np.ndarray, grid: Grid) -> float:
    """Area of triangles less that of some of them, as a share of the grid's area."""
    def area(corners: np.ndarray) -> float:
        a, b, c = corners.T
        return 0.5 * float(np.sum((x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])))
    return (area(triangles) - area(without)) / (grid.rows * grid.columns * grid.cell ** 2)
