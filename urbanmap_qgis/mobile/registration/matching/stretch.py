"""One stretch of the path: the course of its correction, and the windows about it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ....errors import InputError
from ..records import RegistrationSettings
from ..start.correlation_start import EVIDENCE_AREA
from ..start.patch_points import PatchPoints
from ..start.reference import Coverage, GroundPart, Reference
from .course import Course, course_covariance, course_step
from .ndt_map import NdtMap, build_ndt
from .ndt_match import Mixture, ndt_terms
from .patch_sums import PLANE, SPACE, PatchSums, by_patch, point_gradients, sum_points, window_sums
from .subpixel import FieldTerms, MarkingField, field_terms

_AROUND = 3.0  # m of reference beyond where points can come to lie
_LEVELS = (2.0, 1.0, 0.5)  # of the NDT grid
_BLURS = (0.15, 0.0)  # m, of the sub-pixel field
_REST = np.array([0.002, 0.002, 0.002, 1e-4, 1e-4, 1e-4])  # m and radians
_LONGEST = np.array([0.3, 0.3, 0.5, 0.01, 0.01, 0.01])  # step of the course
_CLUSTER = 2.0  # m: markings nearer than this share their errors
_CLUSTER_PATCHES = 4
_CALM = 0.12  # contradiction up to which a window's clusters agree (sample city and the independent one: 0.05 to 0.10)
_VOTE, _VOTE_PATCHES = 4.0, 10  # m and patches of a cluster that can be outvoted
_ROUNDS = 6
_SOFT = 2.0
_USUAL_EXCESS, _LEAST_VARIANCE = 0.08, 1e-3
_HEIGHT_SIGMA = 0.05  # m, of a point's height against the ground
_HEIGHT_ROBUST = 0.15  # m
_OTHER_DATUM = 5.0  # m
_LEAST_EXCESS = 0.02
_EVENED = 5  # patches to either side
_ON_MARKING = 0.5
_WEAK_PRIOR = np.array([0.1, 0.1, 0.1, 0.003, 0.003, 0.003])  # of a window about the course, m and radians


@dataclass(frozen=True)
class Stretch:
    """Patches that follow each other, those of the core with their windows.

    Attributes
    ----------
    first : number of the first patch in the survey. core_first, core_last : of the core, counted from `first`.
    way, standing : (n,) m driven and s waited. place : (n, 3) m, reported. shift : (n, 2) m, where to start.
    window_first, window_last : (k,) of the core's windows, counted from `first`.
    points : thinned marking points of these patches.
    """

    first: int
    core_first: int
    core_last: int
    way: np.ndarray
    standing: np.ndarray
    place: np.ndarray
    shift: np.ndarray
    window_first: np.ndarray
    window_last: np.ndarray
    points: PatchPoints


@dataclass(frozen=True)
class AdjustedStretch:
    """What came out for the k patches of a stretch's core.

    Attributes
    ----------
    shift, turn : (k, 3) the windows' corrections (m; rotation vectors in the map's axes, radians).
    covariance : (k, 6, 6) without the reference's floor, m and radians; 0 in what was not estimated.
    course : (k, 6) the course they were adjusted about. information, pull : of the patches' own points about it.
    score, overlap : (k,). points : (k,) in the window. near : (k,) how many of them lie near any reference marking.
    converged : (k,) whether the course came to rest.
    """

    shift: np.ndarray
    turn: np.ndarray
    covariance: np.ndarray
    course: np.ndarray
    information: np.ndarray
    pull: np.ndarray
    score: np.ndarray
    overlap: np.ndarray
    points: np.ndarray
    converged: np.ndarray


def adjust_stretch(stretch: Stretch, reference: Reference, settings: RegistrationSettings) -> AdjustedStretch:
    """Course of the stretch, and its windows about it."""
    count = len(stretch.way)
    shift = np.column_stack([stretch.shift, np.zeros(count)])
    course = Course(stretch.way, stretch.standing, shift, np.zeros((count, 3)))
    points = stretch.points
    if not len(points):
        return _empty(stretch, course)
    scene = _Scene.of(stretch, reference, settings)
    if settings.three_d:
        course = _level(course, scene)
    stages = [partial(_ndt_sums, grid=level * settings.ndt_grid)
              for level in (_LEVELS if settings.multi_resolution else (1.0,))]
    if settings.refinement:
        stages += [partial(_field_sums, blur=blur) for blur in _BLURS]
    for number, stage in enumerate(stages):
        rest = _REST if number == len(stages) - 1 else 5 * _REST
        course, converged = _settle(course, scene, stage(scene), settings.iterations, rest)
    contradiction = _contradiction(course, scene)
    if settings.refinement and contradiction.max() > _CALM:
        course, converged, scene = _outvoted(course, scene, contradiction)
    return _windows_about(course, converged, contradiction, scene)


def _contradiction(course: Course, scene: _Scene) -> np.ndarray:
    """(n,) by how much clusters of points disagree on the window's place, against their curvature; calm below 0.1."""
    stretch = scene.stretch
    window, scatter, _ = _evidence_about(course, scene)
    excess = _solve(window, scatter, list(scene.active))[2]
    core = np.arange(stretch.core_first, stretch.core_last + 1)
    return np.interp(np.arange(scene.patches), core, excess)


def _outvoted(course: Course, scene: _Scene, contradiction: np.ndarray) -> tuple[Course, bool, _Scene]:
    """The course where windows contradict themselves: clusters that pull hard lose weight in turn (J: repainted)."""
    share = np.clip((contradiction - _CALM) / _CALM, 0.0, 1.0)[scene.patch]
    field, whole, converged = MarkingField.of(scene.coverage, 0.0, scene.settings.background), scene, False
    for _ in range(_ROUNDS):
        weight = _cluster_weights(course.moved(scene.stretch.points), field, whole)
        scene = replace(whole, evidence=whole.evidence * (1 - share + share * weight))
        course, converged = _settle(course, scene, _field_sums(scene, 0.0), scene.settings.iterations, _REST)
    return course, converged, scene


def _cluster_weights(moved: np.ndarray, field: MarkingField, scene: _Scene) -> np.ndarray:
    """(m,) weights of points by how hard their cluster pulls against what its evidence lets expect (Cauchy)."""
    terms = field_terms(field, moved[:, 0], moved[:, 1])
    cluster = _cluster_numbers(moved, scene.patch // _VOTE_PATCHES, _VOTE)
    count = int(cluster.max()) + 1
    gx, gy = (np.bincount(cluster, g * scene.evidence, count) for g in (terms.gx, terms.gy))
    xx, xy, yy = (np.bincount(cluster, product * scene.evidence, count) * _USUAL_EXCESS + same for product, same in (
        (terms.gx * terms.gx, _LEAST_VARIANCE), (terms.gx * terms.gy, 0.0), (terms.gy * terms.gy, _LEAST_VARIANCE)))
    pull = (yy * gx * gx - 2 * xy * gx * gy + xx * gy * gy) / (xx * yy - xy * xy)
    return (1.0 / (1.0 + pull / _SOFT))[cluster]


def _cluster_numbers(moved: np.ndarray, group: np.ndarray, side: float) -> np.ndarray:
    """(m,) one number for each square of `side` m and group of patches, from 0."""
    cell = np.floor(moved[:, :2] / side).astype(np.int64)
    cell -= cell.min(axis=0)
    key = (group * (cell[:, 1].max() + 1) + cell[:, 1]) * (cell[:, 0].max() + 1) + cell[:, 0]
    return np.unique(key, return_inverse=True)[1].reshape(-1)


@dataclass(frozen=True)
class _Scene:
    """What is needed throughout a stretch."""

    stretch: Stretch
    settings: RegistrationSettings
    coverage: Coverage
    ground: GroundPart | None
    patch: np.ndarray
    origin: np.ndarray
    evidence: np.ndarray
    active: tuple[int, ...]

    @classmethod
    def of(cls, stretch: Stretch, reference: Reference, settings: RegistrationSettings) -> _Scene:
        points = stretch.points
        around = settings.search + _AROUND
        x_min, y_min = points.place[:, :2].min(axis=0) - around
        x_max, y_max = points.place[:, :2].max(axis=0) + around
        ground = reference.ground_part(x_min, y_min, x_max, y_max) if settings.three_d else None
        evidence = points.weight * settings.subsampling ** 2 / EVIDENCE_AREA
        return cls(stretch, settings, reference.coverage(x_min, y_min, x_max, y_max), ground,
                   points.patch - stretch.first, points.place.mean(axis=0), evidence,
                   SPACE if settings.three_d else PLANE)

    @property
    def patches(self) -> int:
        return len(self.stretch.way)

    def sums(self, moved: np.ndarray, gradient: tuple, hessian: dict) -> PatchSums:
        return sum_points(moved - self.origin, gradient, hessian, self.patch, self.patches)


def _settle(course: Course, scene: _Scene, sums: Callable[[Course], PatchSums], iterations: int,
            rest: np.ndarray) -> tuple[Course, bool]:
    """Newton's method on the course until no patch moves by more than `rest`."""
    for _ in range(iterations):
        total = sums(course)
        arms = scene.stretch.place + course.shift - scene.origin
        step = np.clip(course_step(course, total.about(arms), scene.active), -_LONGEST, _LONGEST)
        course = course.plus(step)
        if (np.abs(step) < rest).all():
            return course, True
    return course, False


def _ndt_sums(scene: _Scene, grid: float) -> Callable[[Course], PatchSums]:
    """Sums of the score in the normal distributions of the reference."""
    places = scene.coverage.points()
    if scene.settings.three_d:
        height = scene.ground.at(places[:, 0], places[:, 1])
        known = np.isfinite(height)
        places = np.column_stack([places, height])[known]
    ndt = build_ndt(places, grid, scene.coverage.grid.cell / np.sqrt(12))
    mixture = Mixture.of(scene.settings.outlier_share, grid, ndt.dimensions)

    def sums(course: Course) -> PatchSums:
        moved = course.moved(scene.stretch.points)
        return _sums_of_ndt(scene, ndt, mixture, moved)

    return sums


def _sums_of_ndt(scene: _Scene, ndt: NdtMap, mixture: Mixture, moved: np.ndarray) -> PatchSums:
    terms = ndt_terms(ndt, moved[:, :ndt.dimensions], mixture, scene.settings.neighbours, bound=True)
    axes = range(ndt.dimensions)
    gradient = tuple(terms.gradient[:, a] * scene.evidence if a in axes else None for a in range(3))
    hessian = {(a, b): terms.hessian[:, a, b] * scene.evidence for a in axes for b in axes if a <= b}
    return scene.sums(moved, gradient, hessian)


def _field_sums(scene: _Scene, blur: float) -> Callable[[Course], PatchSums]:
    """Sums of the score in the coverage field and, in 3D, of the heights over the ground."""
    field = MarkingField.of(scene.coverage, blur, scene.settings.background)

    def sums(course: Course) -> PatchSums:
        moved = course.moved(scene.stretch.points)
        terms = field_terms(field, moved[:, 0], moved[:, 1])
        total = scene.sums(moved, *_plan_terms(terms, scene.evidence))
        if scene.settings.three_d:
            total = total + scene.sums(moved, *_height_terms(scene, moved))
        return total

    return sums


def _plan_terms(terms: FieldTerms, evidence: np.ndarray) -> tuple[tuple, dict]:
    hessian = {(0, 0): terms.hxx * evidence, (0, 1): terms.hxy * evidence, (1, 1): terms.hyy * evidence}
    return (terms.gx * evidence, terms.gy * evidence, None), hessian


def _height_terms(scene: _Scene, moved: np.ndarray) -> tuple[tuple, dict]:
    """Heights of points over the ground, robust (Geman and McClure)."""
    off = scene.ground.at(moved[:, 0], moved[:, 1]) - moved[:, 2]
    known = np.isfinite(off)
    off = np.where(known, off, 0.0)
    weight = known * scene.evidence / (_HEIGHT_SIGMA * (1 + (off / _HEIGHT_ROBUST) ** 2)) ** 2
    return (None, None, weight * off), {(2, 2): -weight}


def _level(course: Course, scene: _Scene) -> Course:
    """Height of the course: the middle difference to the ground.

    Raises
    ------
    InputError : it is so large that the heights belong to another datum.
    """
    moved = course.moved(scene.stretch.points)
    off = scene.ground.at(moved[:, 0], moved[:, 1]) - moved[:, 2]
    known = np.isfinite(off)
    if not known.any():
        return course
    middle = float(np.median(off[known]))
    if abs(middle) > _OTHER_DATUM:
        raise InputError(f"The survey lies {abs(middle):.1f} m {'below' if middle > 0 else 'above'} the reference's "
                         "ground: heights above the ellipsoid and above sea level cannot be mixed, convert one of the "
                         "two.")
    shift = course.shift.copy()
    shift[:, 2] = middle
    return Course(course.way, course.standing, shift, course.turn)


def _evidence_about(course: Course, scene: _Scene) -> tuple[PatchSums, np.ndarray, tuple]:
    """Sums and scatter of the core's windows about their patches' corrected places; and the parts for the patches.

    The parts: sums of the patches about their own corrected places, and the points' terms in the coverage field.
    """
    stretch, field = scene.stretch, MarkingField.of(scene.coverage, 0.0, scene.settings.background)
    moved = course.moved(stretch.points)
    terms = field_terms(field, moved[:, 0], moved[:, 1])
    gradient, hessian = _plan_terms(terms, scene.evidence)
    sums = scene.sums(moved, gradient, hessian)
    if scene.settings.three_d:
        height_gradient, height_hessian = _height_terms(scene, moved)
        sums = sums + scene.sums(moved, height_gradient, height_hessian)
        gradient = (gradient[0], gradient[1], height_gradient[2])
    arms = stretch.place + course.shift - scene.origin
    core = slice(stretch.core_first, stretch.core_last + 1)
    first, last = stretch.window_first, stretch.window_last
    scatter = window_sums(_scatter(moved, gradient, scene), first, last)
    scatter = PatchSums(np.zeros((len(first), 6)), scatter).about(arms[core]).information
    return sums.windows(first, last).about(arms[core]), scatter, (sums.about(arms), terms)


def _windows_about(course: Course, converged: bool, contradiction: np.ndarray, scene: _Scene) -> AdjustedStretch:
    """Each window as a rigid body about the course, and what the patches say on their own."""
    stretch, points, active = scene.stretch, scene.stretch.points, list(scene.active)
    window, scatter, (own, terms) = _evidence_about(course, scene)
    step, covariance, excess = _solve(window, scatter, active)
    core = slice(stretch.core_first, stretch.core_last + 1)
    counted = max(float(np.median(excess)), _LEAST_EXCESS)
    covariance += course_covariance(course, _evened(own.information) / counted, scene.active)[core]
    covariance *= np.maximum(contradiction[core] / _CALM, 1.0)[:, None, None] ** 2
    shares = by_patch(np.column_stack([np.ones(len(points)), terms.share, terms.share > _ON_MARKING]), scene.patch,
                      scene.patches)
    counted = window_sums(shares, stretch.window_first, stretch.window_last)
    rows = course.plus(_padded(step, stretch, scene.patches))
    with np.errstate(invalid="ignore"):
        score, overlap = counted[:, 1] / counted[:, 0], counted[:, 2] / counted[:, 0]
    return AdjustedStretch(rows.shift[core], rows.turn[core], covariance,
                           np.column_stack([course.shift, course.turn])[core], own.information[core],
                           own.gradient[core], score, overlap, counted[:, 0].astype(np.int64),
                           np.full(core.stop - core.start, converged))


def _evened(information: np.ndarray) -> np.ndarray:
    """(n, 6, 6) shared out over neighbouring patches, so that each curves downwards as a larger piece of path does."""
    count = len(information)
    low, high = (np.clip(np.arange(count) + side * _EVENED, 0, count - 1) for side in (-1, 1))
    values, vectors = np.linalg.eigh(window_sums(information / (high - low + 1)[:, None, None], low, high))
    return np.einsum("nij,nj,nkj->nik", vectors, np.maximum(values, 0), vectors)


def _padded(step: np.ndarray, stretch: Stretch, patches: int) -> np.ndarray:
    whole = np.zeros((patches, 6))
    whole[stretch.core_first:stretch.core_last + 1] = step
    return whole


def _scatter(moved: np.ndarray, gradient: tuple, scene: _Scene) -> np.ndarray:
    """(n, 6, 6) squares of the gradients of clusters of points, by patch: how uneven the evidence really is."""
    group = scene.patch // _CLUSTER_PATCHES
    cluster = _cluster_numbers(moved, group, _CLUSTER)
    order = np.argsort(cluster, kind="stable")
    start = np.flatnonzero(np.r_[True, np.diff(cluster[order]) != 0])
    total = np.add.reduceat(point_gradients(moved - scene.origin, gradient)[order], start, axis=0)
    patch = np.minimum(group[order][start] * _CLUSTER_PATCHES + _CLUSTER_PATCHES // 2, scene.patches - 1)
    by_group = np.argsort(patch, kind="stable")
    total, patch = total[by_group], patch[by_group]
    squares = np.einsum("ni,nj->nij", total, total)
    return by_patch(squares, patch, scene.patches)


def _solve(window: PatchSums, scatter: np.ndarray, active: list[int]
           ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Movements of windows (k, 6), their covariances (k, 6, 6), and by how much evidence is counted too often (k,)."""
    count, width = len(window.gradient), len(active)
    information = window.information[:, active][:, :, active]
    gradient = window.gradient[:, active]
    prior = np.diag(1.0 / _WEAK_PRIOR[active] ** 2)
    values, vectors = np.linalg.eigh(information)
    positive = np.einsum("nij,nj,nkj->nik", vectors, np.maximum(values, 0), vectors) + prior
    inverse = np.linalg.inv(positive)
    solution = np.einsum("nij,nj->ni", inverse, gradient)
    scatter = scatter[:, active][:, :, active]
    excess = np.einsum("nij,nji->n", scatter, inverse) / width
    covariance = inverse * np.maximum(excess, _LEAST_EXCESS)[:, None, None]
    step = np.zeros((count, 6))
    step[:, active] = solution
    full = np.zeros((count, 6, 6))
    full[np.ix_(np.arange(count), active, active)] = covariance
    return step, full, excess


def _empty(stretch: Stretch, course: Course) -> AdjustedStretch:
    core = slice(stretch.core_first, stretch.core_last + 1)
    count = core.stop - core.start
    nothing = np.full(count, np.nan)
    return AdjustedStretch(course.shift[core], course.turn[core], np.full((count, 6, 6), np.nan),
                           np.zeros((count, 6)), np.zeros((count, 6, 6)), np.zeros((count, 6)), nothing, nothing,
                           np.zeros(count, dtype=np.int64), np.zeros(count, dtype=bool))
