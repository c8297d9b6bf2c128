"""Old buildings against a whole new cloud: same, changed, gone, unseen, and new ones."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace

import numpy as np
import shapely

from ...errors import InputError
from ...geometry.grid import Grid
from ...io.points.point_buckets import PointBuckets
from ...io.points.pointcloud import PointCloud
from ...progress import SILENT, Progress
from ...settings.buildings import DetectionSettings, UpdateSettings
from ...wording import say
from ..detection.detected_outline import OK, DetectedBuilding, detected_building
from ..detection.detection_stage import buildings_in
from ..detection.labelled_cloud import LabelledCloud
from ..detection.roof_points import ROOF
from ..detection.roof_regions import cell_side
from .building_change import (
    EXTENDED,
    NEW,
    SAME,
    SIGMAS,
    Change,
    OldBuilding,
    PlanCells,
    building_change,
    open_area,
    roof_differences,
)
from .epoch_offset import EpochOffset, epoch_offset

EAVES = 1.0
"""Distance (m) about an old outline within which new roof points belong to it: eaves hang over walls by less."""
REACH = 1.5
"""Distance (m) from an old outline within which new roof is built on to its building."""
THIN_CLOUD = 0.3
"""Standard deviation (m) of a cell's height where too few roofs tell it: that of old surveys by laser."""
BUILDINGS_AT_ONCE = 256


@dataclass(frozen=True)
class CityChanges:
    """What became of a city.

    Attributes
    ----------
    changes : of the old buildings, in their order.
    added : new buildings, and `additions` their changes.
    extensions : by row of an old building what was built on to it.
    standing : by row of an old building of which a part is open ground now the outline of the rest.
    offset : of the new cloud as a whole.
    """

    changes: list[Change]
    added: list[DetectedBuilding]
    additions: list[Change]
    extensions: dict[int, list[DetectedBuilding]]
    standing: dict[int, shapely.Geometry]
    offset: EpochOffset


def city_changes(old: Sequence[OldBuilding], cloud: PointCloud, settings: UpdateSettings | None = None,
                 ground: tuple[Grid, np.ndarray] | None = None, executor: Executor | None = None,
                 progress: Progress = SILENT) -> CityChanges:
    """Changes of buildings between an old model and a new cloud.

    The offset of the epochs as a whole is estimated from all roofs and taken off. A building is compared in cells of
    about two roof points each, by roof and ground points alone, so that crowns over it and vehicles beside it do not
    count; what the cloud does not show is unseen.

    Raises
    ------
    InputError : the cloud does not reach the buildings.
    """
    settings = settings or UpdateSettings()
    outlines = np.array([building.outline for building in old], dtype=object)
    with LabelledCloud(cloud, ground, True, executor, progress.part(0.0, 0.6)) as labelled:
        side = cell_side(labelled.density)
        cells, standing = _cells_of_all(old, outlines, labelled, side, settings, progress.part(0.6, 0.8))
        if not any(each.seen.any() for each in cells):
            raise InputError(say("No new point lies inside an old building: check that both are of the same place and "
                                 "in the same coordinate system."))
        offset = _offset(cells)
        noise = settings.sigma or (offset.noise if np.isfinite(offset.noise) else THIN_CLOUD)
        changes = [building_change(building, _moved(each, offset), noise, settings)
                   for building, each in zip(old, cells)]
        known = _Covered(outlines)
        found = buildings_in(labelled, DetectionSettings(min_area=settings.min_area),
                             lambda points: points["roof"] & ~known(points), progress.part(0.8, 1.0))
    added = [each for each in found.buildings if each.status == OK]
    return _with_added(CityChanges(changes, [], [], {}, standing, offset), outlines, added, settings)


class _Covered:
    """Which points lie within an old outline or under its eaves."""

    def __init__(self, outlines: np.ndarray):
        self._tree = shapely.STRtree(shapely.buffer(outlines, EAVES, join_style="mitre"))

    def __call__(self, points: np.ndarray) -> np.ndarray:
        inside = np.zeros(len(points), bool)
        inside[self._tree.query(shapely.points(points["x"], points["y"]), "intersects")[0]] = True
        return inside


def _cells_of_all(old: Sequence[OldBuilding], outlines: np.ndarray, labelled: LabelledCloud, side: float,
                  settings: UpdateSettings, progress: Progress) -> tuple[list[PlanCells], dict[int, shapely.Geometry]]:
    """Cells of each old building with the points inside its outline; by row what stands of those that lost a part."""
    tree = shapely.STRtree(outlines)
    cells: list[PlanCells] = []
    standing = {}
    with PointBuckets(np.dtype([*ROOF.descr, ("row", "i8")])) as buckets:
        for points in labelled:
            members, rows = tree.query(shapely.points(points["x"], points["y"]), "intersects")
            numbered = np.empty(len(members), buckets.dtype)
            for name in ROOF.names:
                numbered[name] = points[name][members]
            numbered["row"] = rows
            buckets.add(rows // BUILDINGS_AT_ONCE, numbered)
        for start in range(0, len(old), BUILDINGS_AT_ONCE):
            records = buckets.pop(start // BUILDINGS_AT_ONCE)
            records = records[np.argsort(records["row"], kind="stable")]
            ends = np.searchsorted(records["row"], np.arange(start, min(start + BUILDINGS_AT_ONCE, len(old)) + 1))
            for building, first, last in zip(old[start:], ends, ends[1:]):
                points = records[first:last]
                cells.append(roof_differences(building, points, side))
                if open_area(cells[-1]) >= settings.min_area:
                    rest = detected_building(points[points["roof"]], labelled.density,
                                             DetectionSettings(min_area=settings.min_area))
                    if rest is not None:
                        standing[len(cells) - 1] = rest.outline
            progress.step(len(cells) / len(old))
    return cells, standing


def _offset(cells: Sequence[PlanCells]) -> EpochOffset:
    """Offset of the epochs from the roofs of all buildings."""
    used = [each.inside & ~each.ground for each in cells]
    return epoch_offset(np.concatenate([each.difference[mask] for each, mask in zip(cells, used)]),
                        np.concatenate([each.slope[mask] for each, mask in zip(cells, used)]))


def _moved(cells: PlanCells, offset: EpochOffset) -> PlanCells:
    """Cells with the epochs' offset taken off."""
    east, north, up = offset.shift
    return replace(cells, difference=cells.difference - up + cells.slope @ np.array([east, north]))


def _with_added(found: CityChanges, outlines: np.ndarray, added: list[DetectedBuilding],
                settings: UpdateSettings) -> CityChanges:
    """Changes with what stands outside all old outlines: built on to a larger building, or new."""
    tree = shapely.STRtree(outlines)
    fresh, extensions = [], {}
    for building in added:
        hosts = [row for row in tree.query(building.outline, "dwithin", REACH) if outlines[row].area > building.area]
        strip = shapely.buffer(building.outline, REACH)
        if hosts:
            host = max(hosts, key=lambda row: strip.intersection(outlines[row]).area)
            extensions.setdefault(int(host), []).append(building)
        else:
            fresh.append(building)
    changes = list(found.changes)
    for row, parts in extensions.items():
        area = sum(part.area for part in parts)
        if changes[row].change == SAME:
            changes[row] = replace(changes[row], change=EXTENDED, reason=say("{area:.0f} m2 were built on to it.",
                                                                             area=area),
                                   area_change=area, significance=SIGMAS * area / settings.min_area)
        else:
            changes[row] = replace(changes[row], area_change=float(np.nansum([changes[row].area_change, area])))
    additions = [Change(NEW, say("{area:.0f} m2 of roof, {height:.1f} m high, where no building was.",
                                 area=building.area, height=building.height), building.height, building.area,
                        SIGMAS * building.area / settings.min_area, 1.0) for building in fresh]
    return replace(found, changes=changes, added=fresh, additions=additions, extensions=extensions)
