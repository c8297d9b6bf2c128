"""Buildings of a whole cloud without outlines."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np

from ...geometry.grid import Grid
from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import PointCloud
from ...progress import SILENT, Progress
from ...settings.buildings import DetectionSettings
from .detected_outline import DetectedBuilding, detected_building
from .labelled_cloud import LabelledCloud
from .roof_points import ROOF
from .roof_regions import cell_side, cells_of_points, regions_of_cells

REGIONS_AT_ONCE = 256
CROWN_BELOW = 0.8
"""Mean probability of a roof below which an outline is left out (Delft, 16 points/m2: all 11 trees that were outlined
lie below, no building does)."""


@dataclass(frozen=True)
class DetectedBuildings:
    """What was found.

    Attributes
    ----------
    buildings : from south to north.
    density : roof points/m2.
    told_by : "classes", "echoes" or "surfaces", see `roof_points`.
    too_small : groups of roof points below the least area.
    crowns : outlines left out because their points are no surer a roof than those of trees.
    """

    buildings: list[DetectedBuilding]
    density: float
    told_by: str
    too_small: int
    crowns: int


def detect_buildings(cloud: PointCloud, settings: DetectionSettings | None = None,
                     ground: tuple[Grid, np.ndarray] | None = None, executor: Executor | None = None,
                     progress: Progress = SILENT) -> DetectedBuildings:
    """Buildings of a cloud, classified or not.

    Class 6 is taken where the cloud has it; otherwise the surfaces of the points tell (`roof_odds`).

    Parameters
    ----------
    ground : grid and ground heights (rows, columns), m; made from the points where not given.

    Raises
    ------
    InsufficientDataError : no point of the cloud lies on a roof.
    """
    with LabelledCloud(cloud, ground, executor=executor, progress=progress.part(0.0, 0.7)) as labelled:
        return buildings_in(labelled, settings or DetectionSettings(), progress=progress.part(0.7, 1.0))


def buildings_in(labelled: LabelledCloud, settings: DetectionSettings,
                 wanted: Callable[[np.ndarray], np.ndarray] = lambda points: points["roof"],
                 progress: Progress = SILENT) -> DetectedBuildings:
    """Buildings of the roof points of a cloud, or of those (mask of records) that are wanted."""
    side = cell_side(labelled.density)
    cells = np.unique(np.concatenate([cells_of_points(points[wanted(points)], labelled.origin, side)
                                      for points in labelled]))
    region = regions_of_cells(cells)
    found: list[DetectedBuilding | None] = []
    with PointBuckets(np.dtype([*ROOF.descr, ("region", "i8")])) as buckets:
        for points in labelled:
            points = points[wanted(points)]
            numbered = np.empty(len(points), buckets.dtype)
            for name in ROOF.names:
                numbered[name] = points[name]
            numbered["region"] = region[np.searchsorted(cells, cells_of_points(points, labelled.origin, side))]
            buckets.add(numbered["region"] // REGIONS_AT_ONCE, numbered)
        groups = int(region.max(initial=-1)) // REGIONS_AT_ONCE + 1
        for group in range(groups):
            records = buckets.pop(group)
            records = records[np.argsort(records["region"], kind="stable")]
            for points in np.split(records, np.flatnonzero(np.diff(records["region"])) + 1):
                progress.check()
                found.append(detected_building(points, labelled.density, settings))
            progress.step((group + 1) / groups)
    buildings = [building for building in found if building]
    sure = [building for building in buildings if building.confidence >= CROWN_BELOW]
    return DetectedBuildings(sure, labelled.density, labelled.told_by, len(found) - len(buildings),
                             len(buildings) - len(sure))
