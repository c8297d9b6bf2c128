"""Given roads whose border is the kerb itself, but lies beside the measured one: moved onto it, and told.

Edges of the GSI at scale 1:2500 lie up to 1.75 m off. Without this, what lies between a kerb and its own drawing
would be a sidewalk that is not there.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from scipy.spatial import cKDTree

from ...wording import say
from ..road_records import RoadFinding

STEP = 0.5  # m between places along both borders
SEARCH = 3.0  # m; maps at 1:2500 keep 1.75 m (standard deviation)
LEAST = 0.1  # m; nearer borders stay
SAME = 0.2  # m between the moved border and a kerb that it is
SHARE = 0.7  # of the kerbs' places that have the border so near
SIDE = 0.3  # of the kerbs across the shift on one side of roads, those on the other at least
PLACES = 20
ROUNDS = 30
LONGEST = 10_000.0  # m; a border with a straight side longer than this is damaged and shows no shift


def laid_on_kerbs(official: Sequence[shapely.Polygon], kerbs: shapely.Geometry,
                  ) -> tuple[Sequence[shapely.Polygon], list[RoadFinding]]:
    """Given roads moved so that their border lies on the kerbs, where one shift does that; else as they are.

    Parameters
    ----------
    official : surfaces of roads, m.
    kerbs : measured lines, m.

    Returns
    -------
    The surfaces, and a finding where they were moved. Roads with sidewalks stay: no shift lays both of their borders
    on kerbs.
    """
    if not official or kerbs.is_empty:
        return official, []
    border = _places([ring for shape in official for ring in _rings(shape)])
    measured = _places(shapely.get_parts(kerbs))
    if not len(border):
        return official, []
    shift = _shift(measured, border)
    if len(measured) < PLACES or np.hypot(*shift) < LEAST:
        return official, []
    away, at = cKDTree(border + shift).query(measured)
    same = away < SAME
    if np.mean(same) < SHARE or not _both_sides(_courses(border)[at[same]], shift):
        return official, []
    moved = [shapely.transform(shape, lambda corners: corners + shift) for shape in official]
    x, y = measured[int(np.argmin(np.hypot(*(measured - measured.mean(axis=0)).T)))].tolist()
    return moved, [RoadFinding("given roads moved", say(
        "The given roads lay {distance:.2f} m beside the measured kerbs ({east:+.2f} m to the east, {north:+.2f} m to "
        "the north are put on them): their border was taken for the kerb.", distance=float(np.hypot(*shift)),
        east=float(shift[0]), north=float(shift[1])), x, y)]


def _rings(shape: shapely.Polygon) -> list[shapely.LinearRing]:
    """Rings of a surface, which lies to their left."""
    whole = shapely.geometry.polygon.orient(shape)
    return [whole.exterior, *whole.interiors]


def _both_sides(courses: np.ndarray, shift: np.ndarray) -> bool:
    """Whether the kerbs (n, 2, unit vectors, the road to their left) lie on both sides of roads across a shift: of one
    side alone a sidewalk is moved as well as a road."""
    outwards = np.column_stack([courses[:, 1], -courses[:, 0]]) @ (shift / np.hypot(*shift))
    ahead, behind = np.count_nonzero(outwards > 0.5), np.count_nonzero(outwards < -0.5)
    return min(ahead, behind) >= SIDE * max(ahead, behind, 1)


def _places(lines: Sequence[shapely.Geometry]) -> np.ndarray:
    """Places (n, 2) along lines, m, of those without a side longer than any road's."""
    parts = [shapely.segmentize(part, STEP) for part in lines if _longest_side(part) < LONGEST]
    return np.concatenate([np.zeros((0, 2)), *(shapely.get_coordinates(part) for part in parts)])


def _longest_side(line: shapely.Geometry) -> float:
    """m, inf where a corner is no place."""
    sides = np.hypot(*np.diff(shapely.get_coordinates(line), axis=0).T)
    return float(sides.max(initial=0.0)) if np.isfinite(sides).all() else np.inf


def _shift(measured: np.ndarray, border: np.ndarray) -> np.ndarray:
    """Shift (2,) of the border onto the measured places, m: medians across both, those near each other alone."""
    shift, reach = np.zeros(2), SEARCH
    course = _courses(border)
    for _ in range(ROUNDS):
        away, at = cKDTree(border + shift).query(measured)
        near = away < reach
        if np.count_nonzero(near) < PLACES:
            return np.zeros(2)
        across = np.column_stack([-course[at[near], 1], course[at[near], 0]])
        off = ((measured[near] - border[at[near]] - shift) * across).sum(axis=1)
        # Robust least squares across the border alone: along a straight road nothing tells.
        weight = 1.0 / np.maximum(np.abs(off), LEAST)
        normal = (across * weight[:, None]).T @ across + 1e-6 * np.eye(2) * weight.sum()
        change = np.linalg.solve(normal, (across * weight[:, None]).T @ off)
        shift = shift + change
        if np.hypot(*change) < 1e-3:
            break
    return shift


def _courses(places: np.ndarray) -> np.ndarray:
    """Unit vectors (n, 2) from each place to the one after it; of the one before where rings meet."""
    chord = np.diff(places, axis=0, append=places[-1:])
    length = np.hypot(*chord.T)
    far = (length == 0) | (length > 2.0 * STEP)
    chord[far] = np.roll(chord, 1, axis=0)[far]
    return chord / np.maximum(np.hypot(*chord.T), 1e-12)[:, None]
