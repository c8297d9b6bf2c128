"""Simulated measurements registered to lines of the map by ICP, point to line: walls, or edges of markings (J 6.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ...mobile.registration.matching.ndt_match import RigidMotion
from ..localisation_settings import LocalisationSettings
from ..map_aliases import ScoreField
from ..walls.wall_cells import pieces_at_height, wall_points
from ..walls.wall_map import WallMap

REACH = 2.0  # m, to the line of a point in the first steps
SIGMAS = 3.0  # of the lines, and of the noise: farther points are left out in the last steps
STEPS = 20
SETTLED = 1e-4  # m
LEAST_POINTS = 5
FACING = 4.0  # m, that lines facing opposite ways count as apart


@dataclass(frozen=True)
class LineMap:
    """Lines of the map as points with normals, and the score in which a start is looked for.

    Attributes
    ----------
    field : the score.
    xy : (k, 2) points on the lines, m.
    normal : (k, 2) of the lines.
    tree : of both, normals times half of `FACING`.
    reach : m, of the last steps.
    faces : whether measured points have normals: edges of paint know their bright side, points of a scan do not.
    """

    field: ScoreField
    xy: np.ndarray
    normal: np.ndarray
    tree: cKDTree
    reach: float
    faces: bool

    dimensions = 2

    @classmethod
    def of(cls, field: ScoreField, xy: np.ndarray, normal: np.ndarray, sigma: float, faces: bool) -> LineMap:
        """Map of points (k, 2) on lines with normals (k, 2), whose places have the standard deviation `sigma`, m."""
        apart = FACING / 2 if faces else 0.0
        return cls(field, xy, normal, cKDTree(np.column_stack([xy, apart * normal])),
                   min(max(SIGMAS * sigma, 0.3), REACH), faces)

    def registered(self, points: np.ndarray, pose: RigidMotion, normal: np.ndarray | None = None,
                   sigma: np.ndarray | None = None) -> tuple[RigidMotion, float]:
        """Pose at which points (m, 2), from their sensor, lie on the lines, and the number of points that do.

        `normal` (m, 2) of the points, where they have them; `sigma` (m,) m, with which they count, by default all
        alike.
        """
        counts = np.ones(len(points)) if sigma is None else 1.0 / sigma
        angle, translation = np.arctan2(pose.rotation[1, 0], pose.rotation[0, 0]), pose.translation.copy()
        fits = 0.0
        for number in range(STEPS):
            c, s = np.cos(angle), np.sin(angle)
            arm = points @ np.array([[c, s], [-s, c]])
            faces = np.zeros_like(arm) if normal is None else normal @ np.array([[c, s], [-s, c]])
            away, nearest = self.tree.query(np.column_stack([arm + translation, FACING / 2 * faces]))
            n = self.normal[nearest]
            off = ((self.xy[nearest] - arm - translation) * n).sum(axis=1)
            rows = np.flatnonzero(away < (REACH if number < STEPS // 4 else self.reach))
            if len(rows) < LEAST_POINTS:
                return _pose(pose, translation, angle), 0.0
            turn = arm[rows, 0] * n[rows, 1] - arm[rows, 1] * n[rows, 0]
            design = np.column_stack([n[rows], turn]) * counts[rows, None]
            step = np.linalg.lstsq(design, off[rows] * counts[rows], rcond=1e-6)[0]
            translation, angle = translation + step[:2], angle + step[2]
            fits = float(np.maximum(1.0 - (off[rows] / self.reach) ** 2, 0.0).sum())
            if number >= STEPS // 4 and np.abs(step[:2]).max() < SETTLED:
                break
        return _pose(pose, translation, angle), fits


def _pose(before: RigidMotion, translation: np.ndarray, angle: float) -> RigidMotion:
    c, s = np.cos(angle), np.sin(angle)
    return RigidMotion(before.centre, translation, np.array([[c, -s], [s, c]]))


def lines_of_walls(walls: WallMap, field: ScoreField, settings: LocalisationSettings) -> LineMap:
    """Walls at the height of the scanner as lines."""
    points, piece = wall_points(walls.walls, pieces_at_height(walls.walls, settings.scanner.height))
    sigma = float(np.hypot(walls.sigma.max(), settings.scanner.noise))
    return LineMap.of(field, points, walls.walls.normal[piece], sigma, False)
