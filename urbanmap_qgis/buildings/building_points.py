"""The points of one building after another, from files of any size and order."""

from __future__ import annotations

from collections.abc import Iterator

import laspy
import numpy as np

from ..errors import InputError
from ..io.points.point_buckets import PointBuckets, stable_order
from ..io.points.pointcloud import PointCloud, PointLayout, iter_chunks, valid_points
from ..io.points.whole_records import record_rows
from ..progress import SILENT, Progress
from ..wording import say

BUILDINGS_AT_ONCE = 64
"""Buildings that are worked on together."""


def require_dimension(cloud: PointCloud, name: str, maker: str) -> None:
    """Refuse a cloud without an attribute that an earlier step writes.

    Raises
    ------
    InputError : some file has no such attribute.
    """
    if not cloud.has_dimension(name):
        raise InputError(say("{paths} has no attribute {name}: run “{maker}” first and give its result.",
                             paths=cloud.paths[0].name, name=name, maker=maker))


def iter_building_blocks(cloud: PointCloud, layout: PointLayout, ids: np.ndarray,
                         progress: Progress = SILENT, *, shape_only: bool = False
                         ) -> Iterator[tuple[np.ndarray, list[np.ndarray]]]:
    """Give the records of the buildings `ids`, a block of buildings at a time.

    Yields the rows of `ids` in the block and, for each, its records (of `layout`) in file order.
    Points of other buildings, noise and withheld points are left out. `shape_only`: see `iter_chunks`.
    """
    order = np.argsort(ids, kind="stable")
    known = ids[order]
    with PointBuckets(layout.dtype) as buckets:
        for chunk in iter_chunks(cloud, progress, shape_only=shape_only):
            building = np.asarray(chunk["building_id"]).astype(np.int64)
            place = np.minimum(np.searchsorted(known, building), len(ids) - 1)
            keep = (known[place] == building) & valid_points(chunk)
            buckets.add(place[keep] // BUILDINGS_AT_ONCE, layout.adapt(chunk, keep))
        for block in range((len(ids) + BUILDINGS_AT_ONCE - 1) // BUILDINGS_AT_ONCE):
            rows = order[block * BUILDINGS_AT_ONCE:(block + 1) * BUILDINGS_AT_ONCE]
            yield rows, _split(buckets.pop(block), ids[rows])


def _split(records: np.ndarray, ids: np.ndarray) -> list[np.ndarray]:
    """Records of each building of a block; `ids` ascending."""
    building = np.ascontiguousarray(records["building_id"])
    if (building[1:] < building[:-1]).any():
        sequence = stable_order(building)
        records, building = record_rows(records, sequence), building[sequence]
    starts = np.searchsorted(building, ids, side="left")
    ends = np.searchsorted(building, ids, side="right")
    return [records[start:end] for start, end in zip(starts, ends)]


def coordinates(layout: PointLayout, records: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Scaled x, y and z (each (n,)) of records of a layout."""
    points: laspy.ScaleAwarePointRecord = layout.view(records)
    return np.asarray(points.x), np.asarray(points.y), np.asarray(points.z)
