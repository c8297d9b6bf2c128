"""The points of each building for its mesh: by their building_id, or cut out by the outlines."""

from __future__ import annotations

from collections.abc import Iterator

import laspy
import numpy as np
import shapely

from ...errors import InsufficientDataError
from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ...io.points.whole_records import record_rows
from ...progress import SILENT, Progress
from ...wording import say
from ..outlines.evidence import BUILDING_CLASS
from ..outlines.footprint import Footprints
from ..point_assignment import PlanIndex

RECORD = np.dtype([("x", "f8"), ("y", "f8"), ("z", "f8"), ("class", "u1")])
GROUND_CLASS = 2
_OTHERS = (2, 3, 4, 5, 9, 17)
"""Classes that are no building: ground, vegetation, water, bridge."""

AROUND = 2.0
"""Points up to this far outside an outline (m) tell the ground there."""

_MIN_POINTS = 20


def building_points(cloud: PointCloud, footprints: Footprints,
                    progress: Progress = SILENT) -> Iterator[tuple[int, np.ndarray, float]]:
    """Give (row of the outline, its points (n, 3), height of the ground beside it or NaN), m, row after row.

    A cloud with the attribute building_id gives each building the points of its number. From others the points in
    each outline are cut out; of classified ones those of class 6, or all but ground, vegetation and the like where an
    outline has hardly any.

    Raises
    ------
    InsufficientDataError : no outline has any point.
    """
    numbered = cloud.has_dimension("building_id")
    with PointBuckets(RECORD) as buckets:
        found = False
        for chunk in iter_chunks(cloud, progress):
            keep = valid_points(chunk)
            records = _records(chunk, keep)
            rows, members = (_by_number(np.asarray(chunk["building_id"])[keep], footprints) if numbered
                             else _by_outline(records, footprints))
            buckets.add(rows, record_rows(records, members))
            found |= len(rows) > 0
        if not found:
            raise InsufficientDataError(say("No point lies in any outline: check that both are of the same place and "
                                            "CRS."))
        for row in range(len(footprints)):
            records = buckets.read(row)
            yield row, *_chosen(records, footprints.polygons[row], numbered)


def _records(chunk: laspy.ScaleAwarePointRecord, keep: np.ndarray) -> np.ndarray:
    records = np.empty(int(keep.sum()), RECORD)
    for name in "xyz":
        records[name] = np.asarray(chunk[name])[keep]
    records["class"] = np.asarray(chunk.classification)[keep]
    return records


def _by_number(building: np.ndarray, footprints: Footprints) -> tuple[np.ndarray, np.ndarray]:
    """Row and number of each point that has a building_id of the outlines."""
    order = np.argsort(footprints.ids, kind="stable")
    ids = footprints.ids[order]
    building = building.astype(np.int64)
    place = np.minimum(np.searchsorted(ids, building), len(ids) - 1)
    members = np.flatnonzero(ids[place] == building)
    return order[place[members]], members


def _by_outline(records: np.ndarray, footprints: Footprints) -> tuple[np.ndarray, np.ndarray]:
    """Row and number of each point near an outline; a point near two belongs to both."""
    rows, members = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)]
    if len(records):
        index = PlanIndex(records["x"], records["y"])
        box = shapely.box(records["x"].min(), records["y"].min(), records["x"].max(), records["y"].max())
        known = np.flatnonzero(~shapely.is_missing(footprints.polygons))
        for row in known[shapely.dwithin(footprints.polygons[known], box, AROUND)]:
            inside = index.inside(shapely.buffer(footprints.polygons[row], AROUND))
            rows.append(np.full(len(inside), row))
            members.append(inside)
    return np.concatenate(rows), np.concatenate(members)


def _chosen(records: np.ndarray, polygon: shapely.Geometry | None, numbered: bool) -> tuple[np.ndarray, float]:
    """A building's points on its outline, and the height of the ground beside it."""
    points = np.column_stack([records[name] for name in "xyz"])
    if polygon is None or not len(records):
        return points[:0], float("nan")
    shapely.prepare(polygon)
    inside = shapely.contains_xy(polygon, points[:, 0], points[:, 1])
    kind = records["class"]
    if numbered:
        return points[inside], float("nan")
    beside = points[(kind == GROUND_CLASS) & ~inside] if (kind == GROUND_CLASS).any() else points[~inside]
    ground = float(np.quantile(beside[:, 2], 0.02)) if len(beside) >= _MIN_POINTS else float("nan")
    building = inside & (kind == BUILDING_CLASS)
    if building.sum() < _MIN_POINTS:
        building = inside & ~np.isin(kind, _OTHERS)
    return points[building], ground
