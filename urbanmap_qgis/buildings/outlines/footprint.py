"""Official building outlines: made usable, numbered, none lost."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from ...errors import InputError
from ...geometry.polygon_rings import polygon_rings
from ...wording import say

# Outlines are wall_snap_candidates to this grid (m), so that all later steps see the same coordinates.
GRID_SIZE = 0.001
# A curved wall: bends between these angles (degrees) at edges shorter than this (m), on this share of the
# length.
MIN_BEND = 3.0
MAX_BEND = 35.0
LONGEST_CHORD = 5.0
CURVED_SHARE = 0.25


@dataclass(frozen=True)
class Footprints:
    """Building outlines in plan, one row a building.

    Attributes
    ----------
    ids : (n,) int64, unique and positive.
    polygons : (n,) shapely Polygon or MultiPolygon, valid and 2D; None where an outline is unusable.
    notes : (n,) what had to be said of the outline, empty where nothing.
    """

    ids: np.ndarray
    polygons: np.ndarray
    notes: np.ndarray

    def __len__(self) -> int:
        return len(self.ids)

    @property
    def usable(self) -> np.ndarray:
        """Mask (n,) of the rows that have an outline."""
        return ~shapely.is_missing(self.polygons)


def clean_footprints(geometries: np.ndarray, ids: np.ndarray | None = None) -> Footprints:
    """Outlines as surveyors deliver them, made valid; unusable ones keep their row and say why.

    Parameters
    ----------
    geometries : (n,) shapely geometries, 2D or 3D, possibly missing, empty, invalid or multipart.
    ids : (n,) numbers that name the buildings; by default 1 to n in the order given.

    Raises
    ------
    InputError : there are no outlines, or the ids are not unique positive whole numbers.
    """
    geometries = np.asarray(geometries, dtype=object)
    if not len(geometries):
        raise InputError(say("The layer of building outlines is empty: give a layer with polygons."))
    numbers = np.arange(1, len(geometries) + 1) if ids is None else _checked_ids(ids)
    polygons = np.empty(len(geometries), dtype=object)
    notes = np.empty(len(geometries), dtype=object)
    for row, geometry in enumerate(geometries):
        polygons[row], notes[row] = _clean(geometry)
    if shapely.is_missing(polygons).all():
        raise InputError(say("No building outline has a usable polygon: check the outlines' geometries."))
    return Footprints(numbers, polygons, notes)


def _checked_ids(ids: np.ndarray) -> np.ndarray:
    """Building ids as int64, refused where they could not name points in a point cloud."""
    try:
        given = np.asarray(ids).astype(np.float64)
    except (TypeError, ValueError, OverflowError):
        given = np.full(1, np.nan)
    if not (np.isfinite(given) & (given == np.floor(given))).all():
        raise InputError(say("Some building_id of the outlines is empty or no whole number: number the outlines or "
                             "remove the field."))
    if (given < 1).any() or (given >= 2**32).any():
        raise InputError(say("Some building_id of the outlines is below 1 or too large: number the outlines from 1 "
                             "or remove the field."))
    numbers = given.astype(np.int64)
    unique, counts = np.unique(numbers, return_counts=True)
    if (counts > 1).any():
        raise InputError(say("The outlines hold the building_id {unique} more than once: make it unique or remove "
                             "the field.", unique=unique[counts > 1][0]))
    return numbers


def _clean(geometry: shapely.Geometry | None) -> tuple[shapely.Geometry | None, str]:
    """One outline as a valid 2D polygon, and what was wrong with it."""
    if geometry is None or geometry.is_empty:
        return None, say("the outline is empty")
    if not np.isfinite(shapely.get_coordinates(geometry)).all():
        return None, say("the outline has coordinates that are not numbers")
    plan = shapely.force_2d(geometry)
    note = ""
    if not plan.is_valid:
        plan = shapely.make_valid(plan)
        note = say("the outline was invalid and was repaired")
    plan = _polygonal(shapely.set_precision(plan, GRID_SIZE))
    if plan is None:
        return None, say("the outline has no area")
    return plan, note


def has_curved_walls(outline: shapely.Geometry) -> bool:
    """Whether a quarter of an outline's length, or more, lies in short edges that turn the same way step by step."""
    for ring in polygon_rings(outline)[0]:
        edge = np.diff(shapely.get_coordinates(ring), axis=0)
        length = np.hypot(*edge.T)
        edge, length = edge[length > 0], length[length > 0]
        before = np.roll(edge, 1, axis=0)
        bend = np.degrees(np.arctan2(before[:, 0] * edge[:, 1] - before[:, 1] * edge[:, 0],
                                     (before * edge).sum(axis=1)))
        small = (np.abs(bend) > MIN_BEND) & (np.abs(bend) < MAX_BEND) & (length < LONGEST_CHORD)
        same = np.sign(bend) == np.sign(np.roll(bend, -1))
        if length[small & np.roll(small, -1) & same].sum() >= CURVED_SHARE * length.sum():
            return True
    return False


def _polygonal(geometry: shapely.Geometry) -> shapely.Geometry | None:
    """The polygons of a geometry as Polygon or MultiPolygon, None where it has no area."""
    parts = [part for part in shapely.get_parts(geometry)
             if part.geom_type in ("Polygon", "MultiPolygon") and part.area > 0]
    polygons = shapely.get_parts(np.array(parts, dtype=object)) if parts else []
    if not len(polygons):
        return None
    return polygons[0] if len(polygons) == 1 else shapely.MultiPolygon(list(polygons))
