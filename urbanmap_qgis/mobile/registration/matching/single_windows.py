"""Windows registered one after another, each a rigid body of its own (J 3.2.4.3 and 4.2, to the letter if so set)."""

from __future__ import annotations

import numpy as np

from ....progress import Progress
from ..records import RegistrationSettings, WindowResults
from ..start.patch_points import PatchPoints
from ..start.patches import Patches
from ..start.reference import Reference
from .ndt_map import NdtMap, build_ndt
from .ndt_match import Match, Mixture, RigidMotion, match_points
from .path_section import OBSERVATION_AREA, AdjustedSection
from .results import InitialShifts, assemble
from .windows import Windows

_LEVELS = (2.0, 1.0, 0.5)  # of the NDT grid
_TILE = 400  # patches that share normal distributions
_AROUND = 3.0  # m
_ON_MARKING = 0.5


def register_single(points: PatchPoints, patches: Patches, windows: Windows, start: InitialShifts, reference: Reference,
                    settings: RegistrationSettings, progress: Progress) -> WindowResults:
    """Rows of all patches: each window starts from where the one before came to lie, the first from the start."""
    parts = []
    pose: RigidMotion | None = None
    for first in range(0, len(patches), _TILE):
        last = min(first + _TILE, len(patches)) - 1
        part, pose = _tile(first, last, points, patches, windows, start, reference, settings, pose,
                           progress.part(first / len(patches), (last + 1) / len(patches)))
        parts.append(part)
    return assemble(patches, windows, start, parts, settings)


def _tile(first: int, last: int, points: PatchPoints, patches: Patches, windows: Windows, start: InitialShifts,
          reference: Reference, settings: RegistrationSettings, pose: RigidMotion | None, progress: Progress
          ) -> tuple[AdjustedSection, RigidMotion | None]:
    part = points.of_patches(int(windows.first[first:last + 1].min()), int(windows.last[first:last + 1].max()))
    dimensions = 3 if settings.three_d else 2
    maps, coverage = _maps(part, reference, settings, dimensions)
    count = last - first + 1
    translation, rotation = np.zeros((count, 3)), np.zeros((count, 3))
    covariance = np.full((count, 6, 6), np.nan)
    score, overlap = np.full(count, np.nan), np.full(count, np.nan)
    size, converged = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=bool)
    for row in range(count):
        progress.step(row / count)
        patch = first + row
        window = part.of_patches(windows.first[patch], windows.last[patch])
        size[row] = len(window)
        centre = patches.place[patch, :dimensions]
        begin = _begin(pose, centre, start.shift_at(np.array([patch]))[0])
        if len(window):
            match = _match(window.place[:, :dimensions], begin, maps, settings)
            pose, converged[row] = match.pose, match.converged
            moved = match.pose.moved(window.place[:, :dimensions])
            overlap[row] = coverage(moved)
            score[row] = match.derivatives.value / (len(window) * maps[-1][1].height)
            covariance[row] = _covariance(match, settings)
            begin = match.pose
        translation[row, :dimensions] = begin.translation
        rotation[row] = _vector(begin.rotation)
    curve = np.concatenate([translation, rotation], axis=1)
    return AdjustedSection(translation, rotation, covariance, curve, np.zeros((count, 6, 6)), np.zeros((count, 6)),
                           score, overlap, size, converged), pose


def _begin(pose: RigidMotion | None, centre: np.ndarray, shift: np.ndarray) -> RigidMotion:
    """The movement of the window before, about another centre."""
    if pose is None:
        return RigidMotion.identity(centre, np.r_[shift, np.zeros(len(centre) - 2)])
    return RigidMotion(centre, pose.moved(centre[None])[0] - centre, pose.rotation)


def _maps(points: PatchPoints, reference: Reference, settings: RegistrationSettings, dimensions: int):
    """Normal distributions of each level, and a function that tells the share of points on markings."""
    if not len(points):
        return [(build_ndt(np.zeros((0, dimensions)), settings.ndt_grid), Mixture.of(
            settings.outlier_share, settings.ndt_grid, dimensions))], None
    around = settings.search + _AROUND
    x_min, y_min = points.place[:, :2].min(axis=0) - around
    x_max, y_max = points.place[:, :2].max(axis=0) + around
    coverage = reference.coverage(x_min, y_min, x_max, y_max)
    places = coverage.points()
    if dimensions == 3:
        height = reference.ground_part(x_min, y_min, x_max, y_max).at(places[:, 0], places[:, 1])
        places = np.column_stack([places, height])[np.isfinite(height)]
    grids = [level * settings.ndt_grid for level in (_LEVELS if settings.multi_resolution else (1.0,))]

    def on_markings(moved: np.ndarray) -> float:
        row, column, inside = coverage.grid.cells(moved[:, 0], moved[:, 1])
        return float((inside & (coverage.share[row, column] > _ON_MARKING)).mean())

    return [(build_ndt(places, grid), Mixture.of(settings.outlier_share, grid, dimensions)) for grid in grids], \
        on_markings


def _match(points: np.ndarray, begin: RigidMotion, maps: list[tuple[NdtMap, Mixture]], settings: RegistrationSettings
           ) -> Match:
    for ndt, mixture in maps:
        match = match_points(points, begin, ndt, mixture, settings.iterations, settings.neighbours)
        begin = match.pose
    return match


def _covariance(match: Match, settings: RegistrationSettings) -> np.ndarray:
    """(6, 6) of independent evidence; 0 in what was not estimated, all NaN where it is not determined."""
    full = np.zeros((6, 6))
    active = [0, 1, 5] if len(match.derivatives.gradient) == 3 else list(range(6))
    information = -match.derivatives.hessian * settings.subsampling ** 2 / OBSERVATION_AREA
    values, vectors = np.linalg.eigh(information)
    if values[0] > 0:
        full[np.ix_(active, active)] = vectors @ np.diag(1 / values) @ vectors.T
        return full
    return np.full((6, 6), np.nan)


def _vector(rotation: np.ndarray) -> np.ndarray:
    """Rotation vector of a rotation (2, 2) or (3, 3)."""
    if len(rotation) == 2:
        return np.array([0.0, 0.0, np.arctan2(rotation[1, 0], rotation[0, 0])])
    skew = rotation - rotation.T
    axis = np.array([skew[2, 1], skew[0, 2], skew[1, 0]]) / 2
    angle = np.arccos(np.clip((np.trace(rotation) - 1) / 2, -1, 1))
    return axis / np.sinc(angle / np.pi)
