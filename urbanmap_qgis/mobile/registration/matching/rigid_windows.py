"""Windows registered one after another, each a rigid body of its own (J 3.2.4.3 and 4.2)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ....progress import Progress
from ...markings.records import MarkingPoints
from ..records import AMBIGUOUS, REGISTERED, WEAK, RegistrationSettings, WindowResults
from ..start.correlation_start import CELL, OBSERVATION_AREA
from ..start.initial_shifts import InitialShifts
from ..start.patches import Patches
from ..start.reference import Reference, require_same_datum
from .ndt_map import NdtMap, build_ndt
from .ndt_match import Match, Mixture, RigidMotion, match_points
from .path_section import AdjustedSection
from .results import angle_changes, assemble
from .windows import Windows

_TILE = 400  # patches that share normal distributions
_AROUND = 3.0  # m of reference beyond the largest error looked for
_ON_MARKING = 0.5  # coverage from which a point lies on a marking
_ELSEWHERE = 4  # cells (0.8 m) from where correlation finds the survey: another place


def register_rigid_windows(markings: MarkingPoints, patches: Patches, windows: Windows, start: InitialShifts,
                           reference: Reference, settings: RegistrationSettings, progress: Progress) -> WindowResults:
    """Rows of all patches: each window starts from where the one before came to lie, the first from the start.

    A window without points keeps the motion of the one before. Where a window came to lie elsewhere than correlation
    along the whole path finds the survey, its row is ambiguous.
    """
    points = _Sorted.of(markings, patches)
    parts = []
    motion: RigidMotion | None = None
    for first in range(0, len(patches), _TILE):
        last = min(first + _TILE, len(patches)) - 1
        part, motion = _tile(first, last, points, patches, windows, start, reference, settings, motion,
                             progress.part(first / len(patches), (last + 1) / len(patches)))
        parts.append(part)
    results = assemble(patches, windows, start, parts, settings)
    return _kept_motions(_against_correlation(results, start), parts, settings)


def subsample(points: np.ndarray, cell: float) -> np.ndarray:
    """Mean of the points (m, d) in each cell of side `cell`, m, as (k, d) (J 3.2.4.3, chapter 4: 0.3 m)."""
    if not len(points):
        return points
    base = points.min(axis=0)
    index = np.floor((points - base) / cell).astype(np.int64)
    flat = np.ravel_multi_index(index.T, index.max(axis=0) + 1)
    _, number, count = np.unique(flat, return_inverse=True, return_counts=True)
    number = number.reshape(-1)
    return base + np.stack([np.bincount(number, axis) / count for axis in (points - base).T], axis=1)


@dataclass(frozen=True)
class _Sorted:
    """Places (m, 3) of marking points, sorted by their patches (m,)."""

    place: np.ndarray
    patch: np.ndarray

    @classmethod
    def of(cls, markings: MarkingPoints, patches: Patches) -> _Sorted:
        patch = patches.number_at(markings.time)
        order = np.argsort(patch, kind="stable")
        return cls(np.column_stack([markings.x, markings.y, markings.z])[order], patch[order])

    def between(self, first: int, last: int) -> np.ndarray:
        """Places of the points of the patches `first` to `last`."""
        return self.place[slice(*np.searchsorted(self.patch, [first, last + 1]))]


def _tile(first: int, last: int, points: _Sorted, patches: Patches, windows: Windows, start: InitialShifts,
          reference: Reference, settings: RegistrationSettings, motion: RigidMotion | None, progress: Progress
          ) -> tuple[AdjustedSection, RigidMotion | None]:
    part = points.between(int(windows.first[first:last + 1].min()), int(windows.last[first:last + 1].max()))
    dimensions = 3 if settings.three_d else 2
    maps, on_markings = _maps(part, reference, settings, dimensions)
    count = last - first + 1
    translation, rotation = np.zeros((count, 3)), np.zeros((count, 3))
    covariance = np.full((count, 6, 6), np.nan)
    score, overlap = np.full(count, np.nan), np.full(count, np.nan)
    size, converged = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=bool)
    for row in range(count):
        progress.step(row / count)
        patch = first + row
        window = subsample(points.between(windows.first[patch], windows.last[patch])[:, :dimensions],
                           settings.subsampling)
        size[row] = len(window)
        centre = patches.place[patch, :dimensions]
        if motion is None:
            above = _height_start(part, reference) if settings.three_d else 0.0
            motion = RigidMotion.identity(centre, np.r_[start.shift_at(np.array([patch]))[0], above][:dimensions])
        pose = _carried(motion, centre)
        if len(window) and on_markings is not None:
            match = _match(window, pose, maps, settings)
            pose, converged[row] = match.pose, match.converged
            overlap[row] = on_markings(pose.transform(window))
            score[row] = match.derivatives.value / (len(window) * maps[-1][1].height)
            covariance[row] = _covariance(match, settings)
        motion = pose
        translation[row, :dimensions] = pose.translation
        rotation[row] = _vector(pose.rotation)
    curve = np.concatenate([translation, rotation], axis=1)
    return AdjustedSection(translation, rotation, covariance, curve, np.zeros((count, 6, 6)), np.zeros((count, 6)),
                           score, overlap, size, converged), motion


def _height_start(points: np.ndarray, reference: Reference) -> float:
    """How far the ground lies above points (m, 3), m, median: where the first window starts from in height.

    The paper takes the reported height; a survey over half a cell (1 m) off would see no distribution from there.
    """
    if not len(points):
        return 0.0
    (x_min, y_min), (x_max, y_max) = points[:, :2].min(axis=0) - _AROUND, points[:, :2].max(axis=0) + _AROUND
    off = reference.ground_part(x_min, y_min, x_max, y_max).interpolate(points[:, 0], points[:, 1]) - points[:, 2]
    return float(np.median(off[np.isfinite(off)])) if np.isfinite(off).any() else 0.0


def _carried(motion: RigidMotion, centre: np.ndarray) -> RigidMotion:
    """The motion of the window before (J: M of patch i - 1), about another centre."""
    return RigidMotion(centre, motion.transform(centre[None])[0] - centre, motion.rotation)


def _maps(points: np.ndarray, reference: Reference, settings: RegistrationSettings, dimensions: int
          ) -> tuple[list[tuple[NdtMap, Mixture]], Callable[[np.ndarray], float] | None]:
    """Normal distributions of each level, and a function for the share of points on markings (None without points)."""
    if not len(points):
        return [], None
    around = settings.search + _AROUND
    x_min, y_min = points[:, :2].min(axis=0) - around
    x_max, y_max = points[:, :2].max(axis=0) + around
    coverage = reference.coverage(x_min, y_min, x_max, y_max)
    places = coverage.points()
    if dimensions == 3:
        ground = reference.ground_part(x_min, y_min, x_max, y_max)
        require_same_datum(ground.interpolate(points[:, 0], points[:, 1]) - points[:, 2])
        height = ground.interpolate(places[:, 0], places[:, 1])
        places = np.column_stack([places, height])[np.isfinite(height)]
    grids = [level * settings.ndt_grid for level in settings.ndt_levels]
    maps = [(build_ndt(places, grid), Mixture.of(settings.outlier_share, grid, dimensions)) for grid in grids]
    if not all(len(ndt) for ndt, _ in maps):
        return maps, None

    def on_markings(moved: np.ndarray) -> float:
        row, column, inside = coverage.grid.cells(moved[:, 0], moved[:, 1])
        return float((inside & (coverage.share[row, column] > _ON_MARKING)).mean())

    return maps, on_markings


def _match(points: np.ndarray, begin: RigidMotion, maps: list[tuple[NdtMap, Mixture]],
           settings: RegistrationSettings) -> Match:
    for ndt, mixture in maps:
        match = match_points(points, begin, ndt, mixture, settings.iterations, settings.cells)
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


def _against_correlation(results: WindowResults, start: InitialShifts) -> WindowResults:
    """Rows that lie elsewhere than the best path through all correlation scores become ambiguous."""
    best = CELL * start.best[np.arange(len(results)) // start.block]
    with np.errstate(invalid="ignore"):
        away = np.abs(results.correction[:, :2] - best).max(axis=1) >= _ELSEWHERE * CELL
    results.status[away & np.isin(results.status, (REGISTERED, WEAK))] = AMBIGUOUS
    return results


def _kept_motions(results: WindowResults, parts: list[AdjustedSection],
                  settings: RegistrationSettings) -> WindowResults:
    """Rows without markings with the motion of the window before, which the paper's method goes on with."""
    empty = ~np.isfinite(results.correction[:, 0])
    translation = np.concatenate([part.translation for part in parts])
    rows = np.flatnonzero(empty)
    if len(rows):
        results.correction[rows, :3] = translation[rows]
        results.correction[rows, 3:] = angle_changes(results.angles[rows],
                                                     np.concatenate([part.rotation for part in parts])[rows])
        if not settings.three_d:
            results.correction[rows, 2:5] = np.nan
    return results


def _vector(rotation: np.ndarray) -> np.ndarray:
    """Rotation vector of a rotation (2, 2) or (3, 3)."""
    if len(rotation) == 2:
        return np.array([0.0, 0.0, np.arctan2(rotation[1, 0], rotation[0, 0])])
    skew = rotation - rotation.T
    axis = np.array([skew[2, 1], skew[0, 2], skew[1, 0]]) / 2
    angle = np.arccos(np.clip((np.trace(rotation) - 1) / 2, -1, 1))
    return axis / np.sinc(angle / np.pi)
