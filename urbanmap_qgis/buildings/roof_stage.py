"""Roof segmentation of all buildings of a cloud (J 5.3.2): blocks of buildings, one building after another."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import astuple, dataclass

import numpy as np
import shapely

from ..errors import Cancelled, trouble_words
from ..execution import checkpoint, in_order
from ..io.points.pointcloud import PointCloud, PointLayout, cloud_writer
from ..io.points.whole_records import joined_records
from ..progress import SILENT, Progress
from ..settings.buildings import PAPER, PlaneParameters, RoofParameters
from ..wording import say
from .building_points import coordinates, iter_building_blocks, require_dimension
from .outlines.evidence import BUILDING_CLASS
from .outlines.footprint import Footprints
from .planes.plane_segmentation import segment_planes
from .roofs.paper_roofs import paper_roofs
from .roofs.roof_segmentation import RoofSegmentation, segment_roofs

SEGMENT_BUILDINGS = "Segment buildings"

CLASSED_HEIGHT = 0.5
"""m above the ground from which a point that the file calls a building's can be its roof: above the ground's noise and
kerbs; a shed's roof lies at 1.5 to 2 m."""


@dataclass(frozen=True)
class RoofRows:
    """One row a roof, all arrays (k,); see `roof_segmentation.RoofTable` and `plane_segmentation.PlaneRow` for the
    columns."""

    building_id: np.ndarray
    roof_id: np.ndarray
    height: np.ndarray
    height_max: np.ndarray
    points: np.ndarray
    area: np.ndarray
    density: np.ndarray
    rmse: np.ndarray
    slope: np.ndarray
    azimuth: np.ndarray
    status: np.ndarray


@dataclass(frozen=True)
class RoofBlock:
    """One piece of work: buildings and their points."""

    layout: PointLayout
    rows: np.ndarray
    records: list[np.ndarray]
    polygons: np.ndarray
    ground: np.ndarray
    density: float
    parameters: RoofParameters
    planes: PlaneParameters | None


def segment_cloud_roofs(cloud: PointCloud, footprints: Footprints, output: str | os.PathLike,
                        parameters: RoofParameters | None = None, ground: np.ndarray | None = None,
                        density: float | None = None, executor: Executor | None = None,
                        progress: Progress = SILENT, planes: PlaneParameters | None = None) -> RoofRows:
    """Write the buildings' points with their `roof_id`, and give the table of the roofs.

    Parameters
    ----------
    cloud : points with `building_id`.
    footprints : outlines at their right places (J: the primary outlines).
    ground : (n,) ground height of each building, m; the lowest of its points where NaN or not given.
    density : points/m2 on roofs (J: d); measured inside the outlines where not given.
    planes : roofs are planes, level or sloped, found so; None: level roofs as in the paper. A building whose points
        lie on no planes gets level roofs all the same, and so does the method of the paper.
    """
    require_dimension(cloud, "building_id", SEGMENT_BUILDINGS)
    layout = PointLayout(cloud, [("roof_id", "roof number in its building")])
    rows_of_roofs: list[tuple] = []
    grounds = np.full(len(footprints), np.nan) if ground is None else np.asarray(ground, float)
    found = density or measured_density(cloud, layout, footprints, progress.part(0.0, 0.2))
    blocks = (RoofBlock(layout, rows, records, footprints.polygons[rows], grounds[rows], found,
                        parameters or RoofParameters(), planes)
              for rows, records in iter_building_blocks(cloud, layout, footprints.ids, progress.part(0.2, 0.4)))
    done = 0
    with cloud_writer(output, layout) as writer:
        for rows, records, roofs, troubles in in_order(_segment_block, blocks, executor, progress.check):
            for row, words in troubles:
                progress.warn(say("Building {number} has no roofs: {words}.", number=int(footprints.ids[row]),
                                  words=words))
            for row, result in zip(rows, roofs):
                rows_of_roofs.extend((int(footprints.ids[row]), *values) for values in result)
            writer.write(records)
            done += len(rows)
            progress.part(0.4, 1.0).step(done / len(footprints))
    return _columns(rows_of_roofs)


def measured_density(cloud: PointCloud, layout: PointLayout, footprints: Footprints,
                     progress: Progress = SILENT) -> float:
    """Median over the buildings of the points inside the outline a m2 of its area (J's d)."""
    densities = []
    for rows, records in iter_building_blocks(cloud, layout, footprints.ids, progress, shape_only=True):
        for row, points in zip(rows, records):
            polygon = footprints.polygons[row]
            if polygon is None or not len(points):
                continue
            x, y, _ = coordinates(layout, points)
            shapely.prepare(polygon)
            densities.append(np.count_nonzero(shapely.contains_xy(polygon, x, y)) / polygon.area)
    positive = [value for value in densities if value > 0]
    return float(np.median(positive)) if positive else 1.0


def _segment_block(block: RoofBlock) -> tuple[np.ndarray, np.ndarray, list[list[tuple]], list[tuple[int, str]]]:
    """Rows, records with `roof_id`, the rows of the roofs of each building of a block, and which of them failed and
    why: these have no roofs."""
    results: list[list[tuple]] = []
    troubles: list[tuple[int, str]] = []
    for row, polygon, records, ground in zip(block.rows, block.polygons, block.records, block.ground):
        checkpoint()
        rows: list[tuple] = []
        if polygon is not None and len(records):
            try:
                records["roof_id"], rows = _segment_building(block, polygon, records, ground)
            except Cancelled:
                raise
            except Exception as error:  # one building's trouble is not the others'
                records["roof_id"] = 0
                troubles.append((int(row), trouble_words(error)))
        results.append(rows)
    records = joined_records(block.records) if block.records else np.zeros(0, block.layout.dtype)
    return block.rows, records, results, troubles


def _segment_building(block: RoofBlock, polygon: shapely.Geometry, records: np.ndarray,
                      ground: float) -> tuple[np.ndarray, list[tuple]]:
    """Roof of each point of one building, and the rows of its roofs without the building's number."""
    x, y, z = coordinates(block.layout, records)
    if block.parameters.method == PAPER:
        result = paper_roofs(x, y, z, polygon, block.density, block.parameters)
        return result.roof_of_point, list(_table_rows(result))
    foot = _known_ground(ground, z, block.parameters)
    points = block.layout.view(records)
    least = _least_heights(np.asarray(points.classification), block.parameters)
    if block.planes is not None:
        found = segment_planes(x, y, z, polygon, foot, block.density, block.planes, least)
        if found.rows:
            return found.roof_of_point, [(*astuple(row), found.status) for row in found.rows]
    result = segment_roofs(x, y, z, polygon, foot, block.density, block.parameters, least)
    return result.roof_of_point, list(_table_rows(result))


def _least_heights(classes: np.ndarray, parameters: RoofParameters) -> np.ndarray:
    """Least height (n,) above the ground, m, of a point that can be roof: what the file calls a building is believed
    lower down, as sheds and annexes are."""
    return np.where(classes == BUILDING_CLASS, min(CLASSED_HEIGHT, parameters.min_height), parameters.min_height)


def _known_ground(ground: float, z: np.ndarray, parameters: RoofParameters) -> float:
    """The ground under a building; where unknown, so low that all its points stand above it."""
    return float(ground) if np.isfinite(ground) else float(z.min()) - parameters.min_height


def _table_rows(result: RoofSegmentation) -> Iterator[tuple]:
    table = result.roofs
    for values in zip(table.number, table.height, table.height_max, table.points, table.area, table.density,
                      table.rmse):
        yield (*values, 0.0, float("nan"), result.status)


def _columns(rows: list[tuple]) -> RoofRows:
    """Rows of roofs as columns with their types."""
    types = (np.int64, np.int64, float, float, np.int64, float, float, float, float, float, object)
    return RoofRows(*(np.array([row[place] for row in rows], dtype=kind) for place, kind in enumerate(types)))
