"""Normal equations of the marking points themselves about any correction curve, however it changes along the path.

Windows take their points for one rigid body. Here each point is moved by the correction at its own time, so that drift
within a window, and a jump while the vehicle waits, do not bend the result; what the points of each short piece then
say is summed about the piece. Repeated with the adjustment, this is Gauss and Newton's method on all of the survey.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ....estimation.normal_equations import PLANE, SPACE, NormalEquations
from ...markings.records import MarkingPoints
from ...trajectory import Trajectory, interpolate
from ..matching.patch_sums import PatchSums, by_patch, sum_points
from ..matching.results import angle_rates
from ..matching.subpixel import MarkingField, field_terms
from ..records import RegistrationSettings
from ..start.correlation_start import OBSERVATION_AREA
from ..start.patch_points import PatchPoints, thin_points
from ..start.patches import Patches
from ..start.reference import Reference
from .ground_errors import HeightDifferences, ground_sigma, without_shared_errors


@dataclass(frozen=True)
class PointObservationsLimits:
    """Limits of point observations, each with its unit."""

    fine: int = 4  # parts of a piece in which points are thinned
    around: float = 2.0  # m
    # Share of a section's points on reference markings: what chance alone gives, and what is surely more than
    # chance.
    chance: float = 0.03
    sure: float = 0.15
    averaged: int = 2  # pieces to either side over which curvatures are averaged


LIMITS = PointObservationsLimits()

_SECTION_PATCHES = 100  # pieces whose reference is held in memory
_OVERLAP_PIECES, _MET_PIECES = 3, 7  # pieces to either side over which the share is taken: for their belief, and told


@dataclass(frozen=True)
class _Moved:
    """Points as a curve corrects them: piece (m,), place and lever arm (m, 3) m, weight (m,) as observations."""

    piece: np.ndarray
    place: np.ndarray
    lever_arm: np.ndarray
    weight: np.ndarray


@dataclass(frozen=True)
class PointObservations:
    """Thinned marking points of a survey, by pieces of the path parameter, and the reference they are laid on.

    Attributes
    ----------
    points : thinned; their `path_parameter` is that of the drift, their `patch` counts it in parts of a piece.
    path_parameter : (n,) m, middles of the pieces.
    heading : (n,) degrees there.
    piece_length : m of path parameter.
    back : (n, 6, 6) of roll, pitch, heading (degrees) to rotation vectors (radians).
    """

    points: PatchPoints
    path_parameter: np.ndarray
    heading: np.ndarray
    piece_length: float
    back: np.ndarray
    reference: Reference
    settings: RegistrationSettings

    @classmethod
    def of(cls, markings: MarkingPoints, trajectory: Trajectory, path_parameter: np.ndarray, length: float,
           reference: Reference, settings: RegistrationSettings) -> PointObservations:
        """Pieces of `length` m of path parameter, which at the trajectory's epochs is `path_parameter` (e,)."""
        usable = trajectory.within(markings.time) & np.isfinite(markings.x + markings.y + markings.z)
        count = max(int(np.ceil((path_parameter[-1] - path_parameter[0]) / length)), 1)
        middle = np.minimum((np.arange(count) + 0.5) * length, path_parameter[-1])
        time = np.interp(middle, path_parameter, trajectory.time)
        pose = interpolate(trajectory, time)
        times, places = [np.repeat(time, LIMITS.fine), np.repeat(middle, LIMITS.fine)], [pose.place, pose.angles]
        none = np.zeros(len(path_parameter))  # the path parameter counts the stops already
        fine = Patches(length / LIMITS.fine, *times, *(np.repeat(values, LIMITS.fine, axis=0) for values in places),
                       np.zeros(LIMITS.fine * count), trajectory.time, path_parameter, none)
        points = thin_points(markings.select(usable), trajectory, fine, settings.subsampling)
        return cls(points, middle, pose.angles[:, 2], length, np.linalg.inv(angle_rates(pose.angles)), reference,
                   settings)

    def about(self, curve: Callable[[np.ndarray], np.ndarray], blur: float) -> NormalEquations:
        """Normal equations about a curve, which gives corrections (m, 6) at path parameters (m,).

        Parameters
        ----------
        blur : m, by which the reference is softened: how far off the curve may be.
        """
        count = len(self.path_parameter)
        none = PatchSums(np.zeros((count, 6)), np.zeros((count, 6, 6)))
        sums, heights, share, differences = none, none, np.zeros((count, 2)), []
        for first in range(0, count, _SECTION_PATCHES):
            part = self.points.of_patches(first * LIMITS.fine, (first + _SECTION_PATCHES) * LIMITS.fine - 1)
            if len(part):
                moved = self._transformed(part, curve(part.path_parameter))
                more, counted = self._section(part, moved, blur)
                sums, share = sums + more, share + counted
                if self.settings.three_d:
                    heights = heights + self._heights(part, moved, differences)
        if self.settings.three_d:
            sums = sums + self._trusted(heights, differences)
        active = list(SPACE if self.settings.three_d else PLANE)
        information = np.swapaxes(self.back, 1, 2) @ sums.information @ self.back
        gradient = np.einsum("nji,nj->ni", self.back, sums.gradient)
        believed = _belief(share)
        information = _averaged(information[:, active][:, :, active])
        place = curve(self.path_parameter)[:, active]
        return NormalEquations(tuple(active), self.path_parameter, place, gradient[:, active] * believed[:, None],
                        information * believed[:, None, None], (share[:, 0] > 0) & (believed > 0),
                        self.settings.three_d, _share_met(share, _MET_PIECES))

    def placed(self, curve: Callable[[np.ndarray], np.ndarray]) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """The points as a curve places them, section by section: (m, 2) m, whether on a marking, number of the piece.
        """
        count = len(self.path_parameter)
        for first in range(0, count, _SECTION_PATCHES):
            part = self.points.of_patches(first * LIMITS.fine, (first + _SECTION_PATCHES) * LIMITS.fine - 1)
            if len(part):
                moved = self._transformed(part, curve(part.path_parameter))
                place = moved.place[:, :2]
                field = MarkingField.of(self.reference.coverage(*(place.min(axis=0) - LIMITS.around),
                                                                *(place.max(axis=0) + LIMITS.around)), 0.0,
                                        self.settings.background)
                yield place, field_terms(field, *place.T).on_marking, moved.piece

    def _transformed(self, points: PatchPoints, correction: np.ndarray) -> _Moved:
        """Points moved by corrections (m, 6)."""
        piece = points.patch // LIMITS.fine
        rotation = np.einsum("nij,nj->ni", self.back[piece][:, 3:, 3:], correction[:, 3:])
        side = np.cross(rotation, points.lever_arm)
        lever_arm = points.lever_arm + side + 0.5 * np.cross(rotation, side)
        return _Moved(piece, points.place + correction[:, :3] + (lever_arm - points.lever_arm), lever_arm,
                      points.weight * self.settings.subsampling ** 2 / OBSERVATION_AREA)

    def _section(self, points: PatchPoints, transformed: _Moved, blur: float) -> tuple[PatchSums, np.ndarray]:
        """Sums in plan of some points by piece, and how many there are and lie on reference markings (n, 2)."""
        count, moved, point_weight = len(self.path_parameter), transformed.place, transformed.weight
        low = moved[:, :2].min(axis=0) - LIMITS.around - 3 * blur
        high = moved[:, :2].max(axis=0) + LIMITS.around + 3 * blur
        field = MarkingField.of(self.reference.coverage(*low, *high), blur, self.settings.background)
        terms = field_terms(field, moved[:, 0], moved[:, 1])
        gradient = (terms.gx * point_weight, terms.gy * point_weight, None)
        hessian = {(0, 0): terms.hxx * point_weight, (0, 1): terms.hxy * point_weight, (1, 1): terms.hyy * point_weight}
        counted = by_patch(np.column_stack([np.ones(len(points)), terms.on_marking]), transformed.piece, count)
        return sum_points(transformed.lever_arm, gradient, hessian, transformed.piece, count), counted

    def _heights(self, points: PatchPoints, transformed: _Moved, differences: list[HeightDifferences]) -> PatchSums:
        """Sums in height of some points by piece; their differences to the ground are appended."""
        moved = transformed.place
        box = (*(moved[:, :2].min(axis=0) - LIMITS.around), *(moved[:, :2].max(axis=0) + LIMITS.around))
        off = self.reference.ground_part(*box).interpolate(moved[:, 0], moved[:, 1]) - moved[:, 2]
        gradient, hessian = _height_terms(off, transformed.weight, self.settings)
        known = np.abs(off) < 3 * self.settings.height_robust
        heading = np.radians(self.heading[transformed.piece[known]])
        east, north = transformed.lever_arm[known, :2].T
        offset = np.column_stack([east * np.sin(heading) + north * np.cos(heading),
                                  east * np.cos(heading) - north * np.sin(heading)])
        differences.append(HeightDifferences(transformed.piece[known], offset, off[known]))
        return sum_points(transformed.lever_arm, (None, None, gradient), {(2, 2): hessian}, transformed.piece,
                          len(self.path_parameter))

    def _trusted(self, heights: PatchSums, differences: list[HeightDifferences]) -> PatchSums:
        """The sums in height, less what errors of the ground leave unknown."""
        sigma = self.settings.ground_sigma
        if sigma is None:
            sigma = ground_sigma(HeightDifferences(*(np.concatenate([getattr(part, name) for part in differences])
                                                     for name in ("piece", "offset", "off"))))
        return PatchSums(*without_shared_errors(heights.gradient, heights.information, sigma, self.piece_length))


def _height_terms(off: np.ndarray, point_weight: np.ndarray,
                  settings: RegistrationSettings) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivative of the score by height, robust (Geman and McClure); 0 where no ground is known."""
    known = np.isfinite(off)
    off = np.where(known, off, 0.0)
    weight = known * point_weight / (settings.height_sigma * (1 + (off / settings.height_robust) ** 2)) ** 2
    return weight * off, -weight


def _averaged(information: np.ndarray) -> np.ndarray:
    """Information (n, d, d) averaged over a few pieces, without the directions in which a score bends upwards."""
    window = np.arange(-LIMITS.averaged, LIMITS.averaged + 1)
    rows = np.clip(np.arange(len(information))[:, None] + window, 0, len(information) - 1)
    values, vectors = np.linalg.eigh(information[rows].mean(axis=1))
    return np.einsum("nij,nj,nkj->nik", vectors, np.maximum(values, 0.0), vectors)


def _belief(share: np.ndarray) -> np.ndarray:
    """(n,) 0 to 1: how far the pieces' points meet more reference markings than chance lets them."""
    return np.clip((_share_met(share, _OVERLAP_PIECES) - LIMITS.chance) / (LIMITS.sure - LIMITS.chance), 0.0, 1.0)


def _share_met(share: np.ndarray, pieces: int) -> np.ndarray:
    """(n,) share of the points of so many pieces to either side that lie on reference markings."""
    running = np.concatenate([np.zeros((1, 2)), np.cumsum(share, axis=0)])
    number = np.arange(len(share))
    low = np.maximum(number - pieces, 0)
    high = np.minimum(number + pieces + 1, len(share))
    total = running[high] - running[low]
    return total[:, 1] / np.maximum(total[:, 0], 1.0)
