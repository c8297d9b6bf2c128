"""Virtual control points: corners of markings that the survey and the aerial reference both show (J 3.3.5).

A marking seen in the survey, or drawn in the reference, that fills its smallest rectangle is a bar with four corners.
A corner of the survey and one of the reference that are each other's nearest after the registration are one point: its
true place is the reference's, its place and time in the survey are those of the points around the corner. They are as
good as both markings are drawn (some centimetres): a check where no points were surveyed, not a replacement.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
import shapely
from scipy.spatial import cKDTree

from urbanmap_qgis.errors import InsufficientDataError
from urbanmap_qgis.mobile.control import ControlPoints
from urbanmap_qgis.mobile.markings.records import MarkingPoints
from urbanmap_qgis.mobile.pose_correction import PoseCorrection
from urbanmap_qgis.mobile.registration.start.reference import Reference

CELL = 0.05
"""m, of the raster on which the survey's points become bars; gaps of up to 2 cells within a bar are closed."""

LENGTH, WIDTH, FILLED = (0.8, 12.0), (0.1, 0.8), 0.8
"""Sides of bars, m, and the share of its smallest rectangle that one fills."""

AT_CORNER, PASS = 0.25, 3.0
"""m round a corner whose points give its time and height, and s after which a place is seen by another pass."""


@dataclass(frozen=True)
class SurveyCorners:
    """Corners of bars in a survey: places (n, 3) m as reported, and times (n,) s."""

    place: np.ndarray
    time: np.ndarray


def survey_corners(markings: MarkingPoints) -> SurveyCorners:
    """Corners of the bars among a survey's marking points, of each pass on its own."""
    order = np.argsort(markings.time, kind="stable")
    markings = markings.select(order)
    cell = np.floor(np.column_stack([markings.x, markings.y]) / CELL).astype(np.int64)
    places, times = [np.zeros((0, 3))], [np.zeros(0)]
    for first in np.arange(markings.time[0] - 5.0, markings.time[-1], 20.0):  # pieces of 20 s that overlap
        rows = np.flatnonzero((markings.time >= first) & (markings.time < first + 30.0))
        if len(rows):
            found = _corners_of_piece(markings.select(rows), cell[rows])
            of_pass = (found.time >= first + 5.0) & (found.time < first + 25.0)
            places.append(found.place[of_pass])
            times.append(found.time[of_pass])
    return SurveyCorners(np.concatenate(places), np.concatenate(times))


def _corners_of_piece(markings: MarkingPoints, cell: np.ndarray) -> SurveyCorners:
    low = cell.min(axis=0) - 4
    mask = np.zeros(tuple((cell.max(axis=0) - low + 5)[::-1]), np.uint8)
    column, row = (cell - low).T
    mask[row, column] = 1
    mask = cv2.morphologyEx(mask, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    points = np.column_stack([markings.x, markings.y])
    tree = cKDTree(points)
    places, times = [np.zeros((0, 3))], [np.zeros(0)]
    for contour in contours:
        if len(contour) < 8:
            continue
        outline = (contour[:, 0] + low + 0.5) * CELL
        inside = tree.query_ball_point(outline.mean(axis=0), np.ptp(outline, axis=0).max())
        corners = bar_corners(points[inside][_in_outline(points[inside], outline)])
        near = [tree.query_ball_point(corner, AT_CORNER) for corner in corners]
        if len(corners) and all(near) and max(np.ptp(markings.time[some]) for some in near) < PASS:
            places.append(np.column_stack([corners, [np.median(markings.z[some]) for some in near]]))
            times.append(np.array([np.median(markings.time[some]) for some in near]))
    return SurveyCorners(np.concatenate(places), np.concatenate(times))


def _in_outline(points: np.ndarray, outline: np.ndarray) -> np.ndarray:
    area = shapely.Polygon(outline).buffer(CELL)
    return shapely.contains_xy(area, points[:, 0], points[:, 1])


def bar_corners(points: np.ndarray) -> np.ndarray:
    """(4, 2) corners of the smallest rectangle of points (m, 2) if it is a bar that they fill, otherwise (0, 2)."""
    if len(points) < 8:
        return np.zeros((0, 2))
    base = points.mean(axis=0)
    rectangle = cv2.minAreaRect((points - base).astype(np.float32))
    width, length = sorted(rectangle[1])
    hull = shapely.MultiPoint(points).convex_hull
    if not (LENGTH[0] <= length <= LENGTH[1] and WIDTH[0] <= width <= WIDTH[1]
            and hull.area >= FILLED * width * length):
        return np.zeros((0, 2))
    return cv2.boxPoints(rectangle).astype(float) + base


def reference_corners(reference: Reference, polygons: Sequence[shapely.Geometry]) -> np.ndarray:
    """(n, 3) corners of the bars among marking polygons, with the ground's height (NaN where it is not known)."""
    found = [np.zeros((0, 2))]
    for polygon in polygons:
        rectangle = shapely.minimum_rotated_rectangle(polygon)
        if rectangle.geom_type != "Polygon":
            continue
        corners = shapely.get_coordinates(rectangle)[:4]
        width, length = sorted(np.hypot(*(corners[1:3] - corners[:2]).T))
        if (LENGTH[0] <= length <= LENGTH[1] and WIDTH[0] <= width <= WIDTH[1]
                and polygon.area >= FILLED * rectangle.area):
            found.append(corners)
    corners = np.concatenate(found)
    height = reference.heights(*corners.T) if reference.has_heights and len(corners) else np.full(len(corners), np.nan)
    return np.column_stack([corners, height])


def virtual_control(survey: SurveyCorners, reference: np.ndarray, correction: PoseCorrection,
                    tolerance: float = 0.3) -> ControlPoints:
    """Control points from corners (n, 3) of the reference and those of a survey.

    Parameters
    ----------
    correction : of a registration, by which corners find each other; what is compared stays as reported.
    tolerance : m in plan that a pair may lie apart after it.

    Raises
    ------
    InsufficientDataError : no corner finds another.
    """
    if not len(survey.time) or not len(reference):
        raise InsufficientDataError("There is no bar among the markings of the survey or of the reference, whose "
                                    "corners could be control points.")
    moved = survey.place + correction.translations(survey.place, survey.time)
    away, nearest = cKDTree(reference[:, :2]).query(moved[:, :2])
    back = cKDTree(moved[:, :2]).query(reference[:, :2])[1]
    pair = np.flatnonzero((away < tolerance) & (back[nearest] == np.arange(len(moved)))
                          & np.isfinite(reference[nearest, 2]))
    if not len(pair):
        raise InsufficientDataError("No corner of a marking in the survey lies near one of the reference.")
    names = tuple(f"V{number}" for number in nearest[pair])
    return ControlPoints(names, reference[nearest[pair]], survey.time[pair], survey.place[pair])
