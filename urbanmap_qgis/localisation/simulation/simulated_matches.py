"""Simulated scans registered to the map as it was surveyed, with our own NDT or by ICP (J 6.2)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...mobile.registration.matching.ndt_map import NdtMap
from ...mobile.registration.matching.ndt_match import Mixture, RigidMotion, match_points, rotation_matrix
from ..evidence.effective_walls import LEVELS
from ..localisation_settings import LocalisationSettings
from ..map_aliases import EVIDENCE_OF_CELL, STEP, ScoreField
from ..walls.wall_cells import space_cells, wall_plan_cells
from ..walls.wall_map import WallMap
from .line_matches import LineMap

COARSE = LEVELS
GROUND_SIGMA = 0.05
SAME_START = 3.0  # Starts are looked for within so many sigmas.
STARTS = 2  # Starts from which the NDT is tried; the likeliest result is kept.
# Share of an independent observation that a point of a scan counts for, as its neighbours are on the same
# wall.
EVIDENCE_OF_POINT = 0.05


@dataclass(frozen=True)
class MatchingMap:
    """The map in the forms in which scans are registered to it: scores for the start, distributions of two levels."""

    field: ScoreField
    levels: tuple[NdtMap, ...]
    mixture: Mixture

    @property
    def dimensions(self) -> int:
        """2 or 3."""
        return self.levels[0].dimensions

    def registered(self, points: np.ndarray, pose: RigidMotion) -> tuple[RigidMotion, float]:
        """Pose of points (m, d) after the NDT of each level, coarse first, and the score in the last."""
        for level in self.levels:
            local = RigidMotion(pose.centre, pose.translation - level.origin, pose.rotation)
            found = match_points(points, local, replace(level, origin=np.zeros(level.dimensions)), self.mixture)
            pose = RigidMotion(pose.centre, found.pose.translation + level.origin, found.pose.rotation)
        return pose, found.derivatives.value


def plan_matching_map(walls: WallMap, field: ScoreField, settings: LocalisationSettings) -> MatchingMap:
    """Map for scans of one layer."""
    levels = tuple(wall_plan_cells(each, settings.cell, settings.scanner.height).ndt for each in _levels(walls))
    return MatchingMap(field, levels, Mixture.of(settings.outliers, settings.cell, 2))


def space_matching_map(walls: WallMap, field: ScoreField, settings: LocalisationSettings, xy: np.ndarray, foot: float
                       ) -> MatchingMap:
    """Map for scans of several layers around a place (2,), with a level road at height `foot`, m."""
    reach = settings.scanner.max_range
    rise = reach * np.tan(np.radians(max(settings.scanner.highest, 0.0))) + settings.scanner.height
    levels = tuple(space_cells(each, settings.cell, rise, foot, xy, reach + 5.0, GROUND_SIGMA)
                   for each in _levels(walls))
    return MatchingMap(field, levels, Mixture.of(settings.outliers, settings.cell, 3))


def _levels(walls: WallMap) -> list[WallMap]:
    """The walls with less and less tolerance, at last as accurate as they are."""
    return [replace(walls, sigma=np.maximum(walls.sigma, least)) for least in COARSE
            if walls.sigma.min() < least] + [walls]


def match_error(scan: np.ndarray, place: np.ndarray, city: MatchingMap | LineMap, settings: LocalisationSettings,
                rng: np.random.Generator) -> np.ndarray:
    """Error (3,) of the registered place, east and north, m, and turn, rad, of a scan (m, 3) taken at `place` (3,).

    The start is off by what was known before; the best start near it is found by correlation, then the NDT's levels
    or the ICP follow, all as a vehicle does.
    """
    dimensions = city.dimensions
    shift = rng.normal(0.0, settings.start_sigma, 2)
    turn = np.radians(rng.normal(0.0, settings.start_heading))
    points = (scan @ rotation_matrix(np.array([0.0, 0.0, turn])).T)[:, :dimensions]
    start = place[:dimensions].copy()
    start[:2] += shift
    best = (-np.inf, None)
    for moved, turned in _starts(points, start, city.field, settings):
        begin = start.copy()
        begin[:2] += moved
        rotation = rotation_matrix(np.array([0.0, 0.0, turned]))[:dimensions, :dimensions]
        found, value = city.registered(points, RigidMotion(np.zeros(dimensions), begin, rotation))
        turned = np.arctan2(found.rotation[1, 0], found.rotation[0, 0])
        away = ((found.translation - start)[:2] ** 2).sum() / settings.start_sigma ** 2
        away += (turned / np.radians(settings.start_heading)) ** 2
        likelihood = EVIDENCE_OF_POINT * value - away / 2
        if likelihood > best[0]:
            best = (likelihood, np.array([*(found.translation[:2] - place[:2]), turn + turned]))
    return best[1]


def _starts(points: np.ndarray, start: np.ndarray, field: ScoreField, settings: LocalisationSettings
            ) -> list[tuple[np.ndarray, float]]:
    """Shifts (2,), m, and turns, rad, that fit best, what was known before taken into account."""
    most = int(np.ceil(SAME_START * settings.start_sigma / STEP))
    offset = np.arange(-most, most + 1) * STEP
    before = (offset[:, None] ** 2 + offset ** 2) / (2 * settings.start_sigma ** 2)
    found = []
    for step in (-2, -1, 0, 1, 2):
        turn = np.radians(step * settings.start_heading)
        c, s = np.cos(turn), np.sin(turn)
        xy = points[:, :2] @ np.array([[c, s], [-s, c]]) + start[:2]
        score = EVIDENCE_OF_CELL * field.shifted(xy, most) - before - step ** 2 / 2
        row, column = np.unravel_index(score.argmax(), score.shape)
        found.append((float(score[row, column]), offset[column], offset[row], turn))
    found.sort(key=lambda each: -each[0])
    return [(np.array([east, north]), turn) for _, east, north, turn in found[:STARTS]]
