"""Roof polygons of all buildings of a cloud (J 5.3.3): blocks of buildings, one building after another."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np
import shapely

from ..execution import checkpoint, in_order
from ..io.points.pointcloud import PointCloud, PointLayout
from ..progress import SILENT, Progress
from ..settings.buildings import POINTS, PolygonParameters
from .building_points import coordinates, iter_building_blocks, require_dimension
from .outlines.footprint import Footprints
from .roof_polygons.building_polygons import roof_polygons_or_block
from .roof_polygons.polygon_rows import RoofedBuilding, RoofPolygons

SEGMENT_ROOFS = "Segment roofs"


PARTY_WALL_REACH = 3.0
"""Distance (m) within which other outlines are neighbours that a building's own may not cross."""


@dataclass(frozen=True)
class PolygonBlock:
    """One piece of work: buildings and their points."""

    layout: PointLayout
    ids: np.ndarray
    records: list[np.ndarray]
    polygons: np.ndarray
    neighbours: list[list[shapely.Geometry]]
    parameters: PolygonParameters

    def buildings(self) -> Iterator[RoofedBuilding]:
        """The buildings that have an outline and points."""
        for number, outline, beside, records in zip(self.ids.tolist(), self.polygons, self.neighbours, self.records):
            checkpoint()
            if outline is not None and len(records):
                yield RoofedBuilding(number, outline, np.column_stack(coordinates(self.layout, records)),
                                     records["roof_id"].astype(np.int64), tuple(beside))


def cloud_roof_polygons(cloud: PointCloud, footprints: Footprints, parameters: PolygonParameters | None = None,
                        executor: Executor | None = None, progress: Progress = SILENT) -> RoofPolygons:
    """Roof polygons from points that carry `building_id` and `roof_id`.

    Buildings come in the order of their ids. A building with points but no roof becomes a plain block at the
    median height of its points, with `PAPER` it has no row, as one without points.
    """
    for name in ("building_id", "roof_id"):
        require_dimension(cloud, name, SEGMENT_ROOFS)
    parameters = parameters or PolygonParameters()
    table, done = RoofPolygons(), 0
    blocks = _blocks(cloud, footprints, parameters, progress.part(0.0, 0.3))
    for count, part in in_order(_block_polygons, blocks, executor, progress.check):
        table.extend(part)
        done += count
        progress.part(0.3, 1.0).step(done / len(footprints))
    return table


def _blocks(cloud: PointCloud, footprints: Footprints, parameters: PolygonParameters,
            progress: Progress) -> Iterator[PolygonBlock]:
    """The cloud's buildings, some at a time."""
    layout = PointLayout(cloud)
    beside = _neighbours(footprints.polygons) if parameters.method == POINTS else None
    for rows, records in iter_building_blocks(cloud, layout, footprints.ids, progress, shape_only=True):
        yield PolygonBlock(layout, footprints.ids[rows], records, footprints.polygons[rows],
                           [beside[row] for row in rows] if beside else [[]] * len(rows), parameters)


def _block_polygons(block: PolygonBlock) -> tuple[int, RoofPolygons]:
    """Number of buildings in a block and their polygons."""
    table = RoofPolygons()
    for building in block.buildings():
        table.extend(roof_polygons_or_block(building, block.parameters))
    return len(block.ids), table


def _neighbours(polygons: np.ndarray) -> list[list[shapely.Geometry]]:
    """Outlines near each outline, itself left out."""
    tree = shapely.STRtree(polygons)
    one, other = tree.query(polygons, "dwithin", PARTY_WALL_REACH)
    beside: list[list[shapely.Geometry]] = [[] for _ in polygons]
    for row, near in sorted(zip(one.tolist(), other.tolist())):
        if row != near:
            beside[row].append(polygons[near])
    return beside
