"""LAS, LAZ and COPC: from the header, and a few points from several places for their times."""

from __future__ import annotations

from pathlib import Path

from ...errors import InputError
from ...io.points.pointcloud import PointCloud, open_cloud
from ...io.reference.height_systems import heights_of
from ...mobile.gps_time import ADJUSTMENT, WEEK, sampled_span
from ...wording import say
from ..file_facts import POINTS, SCANS, FileFacts, without_system


def cloud_facts(path: Path, _head: bytes) -> list[FileFacts]:
    """What a LAS, LAZ or COPC file is.

    Raises
    ------
    InputError : it is damaged or cut off.
    """
    cloud = open_cloud([path], may_be_empty=True)
    crs, header = cloud.crs_wkt or "", cloud.headers[0]
    if not cloud.point_count:
        return [FileFacts(path, POINTS, crs_wkt=crs, count=0, problem=say(
            "{files} holds no points: choose another point cloud.", files=path.name))]
    raw = {"angle", "range"} <= {name.lower() for name in header.point_format.extra_dimension_names}
    detail = say("format {format}, {density:.1f} points/m²", format=header.point_format.id, density=_density(cloud))
    extent = (*map(float, cloud.minimum[:2]), *map(float, cloud.maximum[:2]))
    return [FileFacts(path, SCANS if raw else POINTS, detail=detail, crs_wkt=crs,
                      heights=heights_of(crs).word, extent=extent, times=_times(cloud), count=cloud.point_count,
                      notes=without_system(path.name, crs))]


def _density(cloud: PointCloud) -> float:
    """Points a square unit of the box around the cloud: at least so dense is it where it is."""
    side = cloud.maximum[:2] - cloud.minimum[:2]
    return float(cloud.point_count / max(side[0] * side[1], 1e-6))


def _times(cloud: PointCloud) -> tuple[float, float] | None:
    """First and last GPS time by samples, full seconds where the header says that they are adjusted."""
    try:
        first, last = sampled_span(cloud)
    except InputError:  # no times: not needed of an airborne cloud
        return None
    if int(cloud.headers[0].global_encoding.gps_time_type) == 1 and not 0.0 <= first < WEEK:
        return first + ADJUSTMENT, last + ADJUSTMENT
    return float(first), float(last)
