"""Outlines drawn on images become features of the map (Z 4.2)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from ...geometry.tolerances import SIGMA_OF_MAD
from ...io.points.pointcloud import PointCloud, iter_chunks, valid_points
from ...progress import SILENT, Progress
from ...wording import say
from .image_outlines import LINE, POINT, POLYGON, ImageOutline
from .object_surface import MIN_POINTS, SurfacePlane, nearest_surface, ray_intersections, surface_plane
from .outline_points import SNAP, OutlinePoints, outline_points

MEASURED, FACING, PARTLY, NOT_MEASURED = "measured", "faces the camera", "measured in part", "not measured"

_SAMPLE = 8.0
"""Pixels between the places at which a drawn line is measured."""

_NEAREST = 5


@dataclass(frozen=True, eq=False)
class MapObject:
    """An outline brought into the map.

    Attributes
    ----------
    feature : row of the layer of outlines.
    geometry : with z, None where it could not be measured.
    width, height : level and upright extent, m (of a line its length, and the rise between its ends).
    azimuth : direction that the surface faces, degrees from grid north; NaN for lines and points.
    area : m2, of polygons.
    z_low, z_high : m.
    distance : from the camera, m.
    points : laser points used.
    rmse : their scatter about the surface, m.
    sigma : standard deviation of a corner's place against the laser points, m; the trajectory's error is not in it.
    status, reason : in words.
    """

    feature: int
    geometry: shapely.Geometry | None
    width: float = np.nan
    height: float = np.nan
    azimuth: float = np.nan
    area: float = np.nan
    z_low: float = np.nan
    z_high: float = np.nan
    distance: float = np.nan
    points: int = 0
    rmse: float = np.nan
    sigma: float = np.nan
    status: str = NOT_MEASURED
    reason: str = ""


def objects_from_outlines(outlines: Sequence[ImageOutline], cloud: PointCloud, max_range: float = 50.0,
                          progress: Progress = SILENT) -> list[MapObject]:
    """Measure outlines with the laser points behind them, one feature an outline, in their order.

    Parameters
    ----------
    cloud : laser points placed by the same trajectory as the images.
    max_range : laser points farther from the camera are not used, m.
    """
    behind = outline_points(outlines, _chunks(cloud, progress.part(0.0, 0.9)), max_range)
    features = []
    for number, (outline, points) in enumerate(zip(outlines, behind)):
        progress.step(0.9 + 0.1 * number / len(outlines))
        features.append(measure_object(outline, points))
    return features


def _chunks(cloud: PointCloud, progress: Progress) -> Iterator[np.ndarray]:
    for chunk in iter_chunks(cloud, progress):
        keep = valid_points(chunk)
        yield np.column_stack([np.asarray(chunk[axis])[keep] for axis in "xyz"])


def measure_object(outline: ImageOutline, points: OutlinePoints) -> MapObject:
    """One outline with the laser points behind it."""
    if outline.kind == POLYGON:
        return _polygon(outline, points)
    return _line(outline, points) if outline.kind == LINE else _point(outline, points)


def _polygon(outline: ImageOutline, points: OutlinePoints) -> MapObject:
    """The outline's corners where their rays meet the nearest surface."""
    surface = nearest_surface(points)
    if not len(surface):
        return MapObject(outline.feature, None, points=len(points), reason=_too_few(points))
    middle = shapely.get_coordinates(outline.pixels.centroid)
    camera = outline.source.rays(*middle.T)[0][0]
    plane = surface_plane(surface, camera)
    rings = [shapely.get_coordinates(ring)[:-1] for ring in (outline.pixels.exterior, *outline.pixels.interiors)]
    corners = [ray_intersections(plane, *outline.source.rays(*ring.T)) for ring in rings]
    if not all(np.isfinite(ring).all() for ring in corners):
        return MapObject(outline.feature, None, points=len(surface), rmse=plane.rmse,
                         reason=say("the surface runs along the line of sight"))
    shape = shapely.Polygon(corners[0], corners[1:])
    width, height, azimuth, area, z_low, z_high = _extent(plane, corners[0])
    return MapObject(outline.feature, shape, width, height, azimuth, area, z_low, z_high,
                     distance=float(np.median(surface.distance)), points=plane.points, rmse=plane.rmse,
                     sigma=_sigma(outline, plane, middle), status=MEASURED if plane.fitted else FACING,
                     reason="" if plane.fitted else say("too few points or too narrow for a plane of its own"))


def _extent(plane: SurfacePlane, corners: np.ndarray) -> tuple[float, ...]:
    """Width, height, azimuth, area, lowest and highest z of corners (n, 3) in a plane."""
    level = np.array([-plane.normal[1], plane.normal[0], 0.0])
    length = np.linalg.norm(level)
    level = level / length if length > 0.05 else np.array([1.0, 0.0, 0.0])
    upwards = np.cross(plane.normal, level)
    flat = (corners - corners[0]) @ np.column_stack([level, upwards])
    width, height = np.ptp(flat, axis=0)
    azimuth = np.degrees(np.arctan2(plane.normal[0], plane.normal[1])) % 360.0 if length > 0.05 else np.nan
    return (float(width), float(height), float(azimuth), float(shapely.Polygon(flat).area),
            float(corners[:, 2].min()), float(corners[:, 2].max()))


def _sigma(outline: ImageOutline, plane: SurfacePlane, pixel: np.ndarray) -> float:
    """Standard deviation of a corner: of the plane along the ray, and half a pixel beside it."""
    steps = pixel + np.array([[-0.5, 0.0], [0.5, 0.0], [0.0, -0.5], [0.0, 0.5]])
    ends = ray_intersections(plane, *outline.source.rays(*steps.T))
    pixel_sides = np.linalg.norm(ends[[1, 3]] - ends[[0, 2]], axis=1)
    _, direction = outline.source.rays(*pixel.T)
    along = plane.sigma / max(abs(float(direction[0] @ plane.normal)), 0.05)
    return float(np.sqrt(along**2 + np.sum(pixel_sides**2) / 4.0))


def _line(outline: ImageOutline, points: OutlinePoints) -> MapObject:
    """A drawn line measured at many places; places without points are left out."""
    pixels = shapely.get_coordinates(shapely.segmentize(outline.pixels, _SAMPLE))
    places, spread, used = _sampled(outline, pixels, points)
    known = np.isfinite(places).all(axis=1)
    if known.sum() < 2:
        return MapObject(outline.feature, None, points=used, reason=_too_few(points))
    line = shapely.LineString(places[known])
    length = float(np.linalg.norm(np.diff(places[known], axis=0), axis=1).sum())
    ends_known = known[0] and known[-1]
    return MapObject(outline.feature, line, length, float(abs(places[known][-1, 2] - places[known][0, 2])),
                     z_low=float(places[known][:, 2].min()), z_high=float(places[known][:, 2].max()),
                     distance=float(np.median(points.distance)), points=used, rmse=float(np.nanmedian(spread)),
                     sigma=_sample_sigma(outline, pixels[known], places[known], spread[known]),
                     status=MEASURED if ends_known and known.mean() > 0.8 else PARTLY,
                     reason="" if known.all() else say("no laser points at {known_count} of {known_count_2} places",
                                                       known_count=np.count_nonzero(~known), known_count_2=len(known)))


def _point(outline: ImageOutline, points: OutlinePoints) -> MapObject:
    pixels = shapely.get_coordinates(outline.pixels)
    places, spread, used = _sampled(outline, pixels, points)
    if not np.isfinite(places).all():
        return MapObject(outline.feature, None, points=used, reason=_too_few(points))
    z = float(places[0, 2])
    return MapObject(outline.feature, shapely.Point(places[0]), z_low=z, z_high=z,
                     distance=float(np.median(points.distance)), points=used, rmse=float(spread[0]),
                     sigma=_sample_sigma(outline, pixels, places, spread), status=MEASURED)


def _sampled(outline: ImageOutline, pixels: np.ndarray,
             points: OutlinePoints) -> tuple[np.ndarray, np.ndarray, int]:
    """Places (n, 3) of pixels (n, 2): on their rays, as far as the nearest laser points beside them.

    Also the scatter (n,) of those points' distances, m, and how many points were used in all.
    """
    places, spread = np.full((len(pixels), 3), np.nan), np.full(len(pixels), np.nan)
    origin, direction = outline.source.rays(*pixels.T)
    used = 0
    for number, pixel in enumerate(pixels):
        off = np.hypot(points.column - pixel[0], points.row - pixel[1])
        near = np.flatnonzero(off <= SNAP)
        if len(near) < 3:
            continue
        near = near[np.argsort(off[near], kind="stable")[:4 * _NEAREST]]
        first = near[points.distance[near] <= points.distance[near].min() + 0.3][:_NEAREST]
        along = (points.place[first] - origin[number]) @ direction[number]
        places[number] = origin[number] + np.median(along) * direction[number]
        spread[number] = SIGMA_OF_MAD * np.median(np.abs(along - np.median(along)))
        used += len(first)
    return places, spread, used


def _sample_sigma(outline: ImageOutline, pixels: np.ndarray, places: np.ndarray, spread: np.ndarray) -> float:
    """Standard deviation of a measured place: scatter along the ray, half a pixel beside it; the median of all."""
    origin, _ = outline.source.rays(*pixels.T)
    distance = np.linalg.norm(places - origin, axis=1)
    _, right = outline.source.rays(pixels[:, 0], pixels[:, 1] + 1.0)
    _, direction = outline.source.rays(*pixels.T)
    beside = distance * np.linalg.norm(right - direction, axis=1) / 2.0
    return float(np.median(np.sqrt(np.maximum(spread, 0.01) ** 2 / 2.0 + beside**2)))


def _too_few(points: OutlinePoints) -> str:
    if not len(points):
        return say("no laser points lie behind it")
    return say("{points_count} laser points behind it are too few, or no group of them is connected (needed: "
               "{min_points})", points_count=len(points), min_points=MIN_POINTS)


def geometry_type(outlines: Sequence[ImageOutline]) -> str:
    """Name of the geometry type of the results, as QGIS names it; outlines of one layer are of one kind."""
    return {POLYGON: "PolygonZ", LINE: "LineStringZ", POINT: "PointZ"}[outlines[0].kind]
