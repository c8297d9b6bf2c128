"""One section of the path: its correction curve, and the windows about it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..records import RegistrationSettings
from ..start.correlation_start import OBSERVATION_AREA
from ..start.patch_points import PatchPoints
from ..start.reference import Coverage, GroundPart, Reference, require_same_datum
from .correction_curve import CorrectionCurve, curve_covariance, curve_step
from .ndt_map import NdtMap, build_ndt
from .ndt_match import Mixture, ndt_terms
from .patch_sums import PLANE, SPACE, PatchSums, by_patch, point_gradients, sum_points, window_sums
from .subpixel import FieldTerms, MarkingField, field_terms


@dataclass(frozen=True)
class PathSectionLimits:
    """Limits of path section, each with its unit."""

    around: float = 3.0  # m of reference beyond where points can come to lie
    # m and patches: markings nearer than this share their errors
    cluster: float = 2.0
    cluster_patches: int = 4
    consistent: float = 0.12  # contradiction up to which a window's clusters agree (0.05 to 0.10 on two cities)
    # m and patches of a group of points that is reweighted as one
    group_size: float = 4.0
    group_patches: int = 10
    rounds: int = 6  # of reweighting
    soft: float = 2.0  # reduced chi square of a group at which its weight is a half
    # variance of a group's gradient by its terms' squares, and at least
    usual_excess: float = 0.08
    min_variance: float = 1e-3
    min_excess: float = 0.02  # by how much a window's clusters disagree at least
    evened: int = 5  # patches to either side over which information is averaged


LIMITS = PathSectionLimits()

_TOLERANCE = np.array([0.002, 0.002, 0.002, 1e-4, 1e-4, 1e-4])  # m and radians: well below the sigma of a window
_STEP_LIMIT = np.array([0.3, 0.3, 0.5, 0.01, 0.01, 0.01])  # of the curve in one step: a third of a cell of 1 m
# Set on the sample cities "canyon", "elevated road" and "repainted" and on the independent one:
_WEAK_PRIOR = np.array([0.1, 0.1, 0.1, 0.003, 0.003, 0.003])  # of a window about the curve, m and radians


@dataclass(frozen=True)
class PathSection:
    """Patches that follow each other, those of the core with their windows.

    Attributes
    ----------
    first : number of the first patch in the survey.
    core_first, core_last : of the core, counted from `first`.
    chainage : (n,) m.
    stop_time : (n,) s stood up to there.
    place : (n, 3) m, reported.
    start_shift : (n, 2) m.
    fast_drift : (n,) m a metre, see `fast_drift_rate`.
    window_first, window_last : (k,) of the core's windows, counted from `first`.
    points : thinned marking points of these patches.
    """

    first: int
    core_first: int
    core_last: int
    chainage: np.ndarray
    stop_time: np.ndarray
    place: np.ndarray
    start_shift: np.ndarray
    fast_drift: np.ndarray
    window_first: np.ndarray
    window_last: np.ndarray
    points: PatchPoints


@dataclass(frozen=True)
class AdjustedSection:
    """What came out for the k patches of a section's core.

    Attributes
    ----------
    translation, rotation : (k, 3) the windows' corrections (m; rotation vectors in the map's axes, radians).
    covariance : (k, 6, 6) without the reference's floor, m and radians; 0 in what was not estimated.
    curve : (k, 6) the curve they were adjusted about.
    information, gradient : of the patches' own points about it.
    score, overlap : (k,).
    points : (k,) in the window.
    near : (k,) how many of them lie near any reference marking.
    converged : (k,) whether the curve converged.
    """

    translation: np.ndarray
    rotation: np.ndarray
    covariance: np.ndarray
    curve: np.ndarray
    information: np.ndarray
    gradient: np.ndarray
    score: np.ndarray
    overlap: np.ndarray
    points: np.ndarray
    converged: np.ndarray


def adjust_section(section: PathSection, reference: Reference, settings: RegistrationSettings) -> AdjustedSection:
    """Correction curve of the section, and its windows about it."""
    count = len(section.chainage)
    translation = np.column_stack([section.start_shift, np.zeros(count)])
    curve = CorrectionCurve(section.chainage, section.stop_time, translation, np.zeros((count, 3)),
                            section.fast_drift)
    points = section.points
    if not len(points):
        return _empty(section, curve)
    scene = _Scene.of(section, reference, settings)
    if settings.three_d:
        curve = _level(curve, scene)
    stages = [partial(_ndt_sums, grid=level * settings.ndt_grid)
              for level in settings.ndt_levels]
    if settings.refinement:
        stages += [partial(_field_sums, blur=blur) for blur in settings.blurs]
    for number, stage in enumerate(stages):
        tolerance = _TOLERANCE if number == len(stages) - 1 else 5 * _TOLERANCE
        curve, converged = _converge(curve, scene, stage(scene), settings.iterations, tolerance)
    contradiction = _contradiction(curve, scene)
    if settings.refinement and contradiction.max() > LIMITS.consistent:
        curve, converged, scene = _reweighted(curve, scene, contradiction)
    return _windows_about(curve, converged, contradiction, scene)


def _contradiction(curve: CorrectionCurve, scene: _Scene) -> np.ndarray:
    """(n,) by how much clusters of points disagree on the window's place, against their curvature; calm below 0.1."""
    section = scene.section
    window, scatter, _ = _normals_about(curve, scene)
    excess = _solve(window, scatter, list(scene.active))[2]
    core = np.arange(section.core_first, section.core_last + 1)
    return np.interp(np.arange(scene.patches), core, excess)


def _reweighted(curve: CorrectionCurve, scene: _Scene,
                contradiction: np.ndarray) -> tuple[CorrectionCurve, bool, _Scene]:
    """The curve where windows contradict themselves: groups with large gradients lose weight (J: repainted)."""
    share = np.clip((contradiction - LIMITS.consistent) / LIMITS.consistent, 0.0, 1.0)[scene.patch]
    field, whole, converged = MarkingField.of(scene.coverage, 0.0, scene.settings.background), scene, False
    for _ in range(LIMITS.rounds):
        weight = _cluster_weights(curve.transform(scene.section.points), field, whole)
        scene = replace(whole, point_weight=whole.point_weight * (1 - share + share * weight))
        curve, converged = _converge(curve, scene, _field_sums(scene, 0.0), scene.settings.iterations, _TOLERANCE)
    return curve, converged, scene


def _cluster_weights(moved: np.ndarray, field: MarkingField, scene: _Scene) -> np.ndarray:
    """(m,) weights of points by the gradient of their group against what its observations let expect (Cauchy)."""
    terms = field_terms(field, moved[:, 0], moved[:, 1])
    cluster = _cluster_numbers(moved, scene.patch // LIMITS.group_patches, LIMITS.group_size)
    count = int(cluster.max()) + 1
    weight = scene.point_weight
    gx, gy = (np.bincount(cluster, g * weight, count) for g in (terms.gx, terms.gy))
    xx, xy, yy = (np.bincount(cluster, product * weight, count) * LIMITS.usual_excess + same for product, same in (
        (terms.gx * terms.gx, LIMITS.min_variance), (terms.gx * terms.gy, 0.0),
        (terms.gy * terms.gy, LIMITS.min_variance)))
    gradient = (yy * gx * gx - 2 * xy * gx * gy + xx * gy * gy) / (xx * yy - xy * xy)
    return (1.0 / (1.0 + gradient / LIMITS.soft))[cluster]


def _cluster_numbers(moved: np.ndarray, group: np.ndarray, side: float) -> np.ndarray:
    """(m,) one number for each square of `side` m and group of patches, from 0."""
    cell = np.floor(moved[:, :2] / side).astype(np.int64)
    cell -= cell.min(axis=0)
    key = (group * (cell[:, 1].max() + 1) + cell[:, 1]) * (cell[:, 0].max() + 1) + cell[:, 0]
    return np.unique(key, return_inverse=True)[1].reshape(-1)


@dataclass(frozen=True)
class _Scene:
    """What is needed throughout a section."""

    section: PathSection
    settings: RegistrationSettings
    coverage: Coverage
    ground: GroundPart | None
    patch: np.ndarray
    origin: np.ndarray
    point_weight: np.ndarray
    active: tuple[int, ...]

    @classmethod
    def of(cls, section: PathSection, reference: Reference, settings: RegistrationSettings) -> _Scene:
        points = section.points
        around = settings.search + LIMITS.around
        x_min, y_min = points.place[:, :2].min(axis=0) - around
        x_max, y_max = points.place[:, :2].max(axis=0) + around
        ground = reference.ground_part(x_min, y_min, x_max, y_max) if settings.three_d else None
        point_weight = points.weight * settings.subsampling ** 2 / OBSERVATION_AREA
        return cls(section, settings, reference.coverage(x_min, y_min, x_max, y_max), ground,
                   points.patch - section.first, points.place.mean(axis=0), point_weight,
                   SPACE if settings.three_d else PLANE)

    @property
    def patches(self) -> int:
        return len(self.section.chainage)

    def sums(self, moved: np.ndarray, gradient: tuple, hessian: dict) -> PatchSums:
        return sum_points(moved - self.origin, gradient, hessian, self.patch, self.patches)


def _converge(curve: CorrectionCurve, scene: _Scene, sums: Callable[[CorrectionCurve], PatchSums], iterations: int,
            tolerance: np.ndarray) -> tuple[CorrectionCurve, bool]:
    """Newton's method on the curve until no patch moves by more than `tolerance`."""
    for _ in range(iterations):
        total = sums(curve)
        lever_arms = scene.section.place + curve.translation - scene.origin
        step = np.clip(curve_step(curve, total.about(lever_arms), scene.active), -_STEP_LIMIT, _STEP_LIMIT)
        curve = curve.plus(step)
        if (np.abs(step) < tolerance).all():
            return curve, True
    return curve, False


def _ndt_sums(scene: _Scene, grid: float) -> Callable[[CorrectionCurve], PatchSums]:
    """Sums of the score in the normal distributions of the reference."""
    places = scene.coverage.points()
    if scene.settings.three_d:
        height = scene.ground.interpolate(places[:, 0], places[:, 1])
        known = np.isfinite(height)
        places = np.column_stack([places, height])[known]
    ndt = build_ndt(places, grid, scene.coverage.grid.cell / np.sqrt(12))
    mixture = Mixture.of(scene.settings.outlier_share, grid, ndt.dimensions)

    def sums(curve: CorrectionCurve) -> PatchSums:
        moved = curve.transform(scene.section.points)
        return _sums_of_ndt(scene, ndt, mixture, moved)

    return sums


def _sums_of_ndt(scene: _Scene, ndt: NdtMap, mixture: Mixture, moved: np.ndarray) -> PatchSums:
    terms = ndt_terms(ndt, moved[:, :ndt.dimensions], mixture, scene.settings.cells, bound=True)
    axes = range(ndt.dimensions)
    gradient = tuple(terms.gradient[:, a] * scene.point_weight if a in axes else None for a in range(3))
    hessian = {(a, b): terms.hessian[:, a, b] * scene.point_weight for a in axes for b in axes if a <= b}
    return scene.sums(moved, gradient, hessian)


def _field_sums(scene: _Scene, blur: float) -> Callable[[CorrectionCurve], PatchSums]:
    """Sums of the score in the coverage field and, in 3D, of the heights over the ground."""
    field = MarkingField.of(scene.coverage, blur, scene.settings.background)

    def sums(curve: CorrectionCurve) -> PatchSums:
        moved = curve.transform(scene.section.points)
        terms = field_terms(field, moved[:, 0], moved[:, 1])
        total = scene.sums(moved, *_plan_terms(terms, scene.point_weight))
        if scene.settings.three_d:
            total = total + scene.sums(moved, *_height_terms(scene, moved))
        return total

    return sums


def _plan_terms(terms: FieldTerms, point_weight: np.ndarray) -> tuple[tuple, dict]:
    hessian = {(0, 0): terms.hxx * point_weight, (0, 1): terms.hxy * point_weight, (1, 1): terms.hyy * point_weight}
    return (terms.gx * point_weight, terms.gy * point_weight, None), hessian


def _height_terms(scene: _Scene, moved: np.ndarray) -> tuple[tuple, dict]:
    """Heights of points over the ground, robust (Geman and McClure)."""
    off = scene.ground.interpolate(moved[:, 0], moved[:, 1]) - moved[:, 2]
    known = np.isfinite(off)
    off = np.where(known, off, 0.0)
    sigma, robust = scene.settings.height_sigma, scene.settings.height_robust
    weight = known * scene.point_weight / (sigma * (1 + (off / robust) ** 2)) ** 2
    return (None, None, weight * off), {(2, 2): -weight}


def _level(curve: CorrectionCurve, scene: _Scene) -> CorrectionCurve:
    """Height of the curve: the middle difference to the ground.

    Raises
    ------
    InputError : it is so large that the heights belong to another datum.
    """
    moved = curve.transform(scene.section.points)
    off = scene.ground.interpolate(moved[:, 0], moved[:, 1]) - moved[:, 2]
    known = np.isfinite(off)
    if not known.any():
        return curve
    require_same_datum(off)
    middle = float(np.median(off[known]))
    translation = curve.translation.copy()
    translation[:, 2] = middle
    return CorrectionCurve(curve.chainage, curve.stop_time, translation, curve.rotation, curve.fast_drift)


def _normals_about(curve: CorrectionCurve, scene: _Scene) -> tuple[PatchSums, np.ndarray, tuple]:
    """Sums and scatter of the core's windows about their patches' corrected places; and the parts for the patches.

    The parts: sums of the patches about their own corrected places, and the points' terms in the coverage field.
    """
    section, field = scene.section, MarkingField.of(scene.coverage, 0.0, scene.settings.background)
    moved = curve.transform(section.points)
    terms = field_terms(field, moved[:, 0], moved[:, 1])
    gradient, hessian = _plan_terms(terms, scene.point_weight)
    sums = scene.sums(moved, gradient, hessian)
    if scene.settings.three_d:
        height_gradient, height_hessian = _height_terms(scene, moved)
        sums = sums + scene.sums(moved, height_gradient, height_hessian)
        gradient = (gradient[0], gradient[1], height_gradient[2])
    lever_arms = section.place + curve.translation - scene.origin
    core = slice(section.core_first, section.core_last + 1)
    first, last = section.window_first, section.window_last
    scatter = window_sums(_scatter(moved, gradient, scene), first, last)
    scatter = PatchSums(np.zeros((len(first), 6)), scatter).about(lever_arms[core]).information
    return sums.windows(first, last).about(lever_arms[core]), scatter, (sums.about(lever_arms), terms)


def _windows_about(curve: CorrectionCurve, converged: bool, contradiction: np.ndarray,
                   scene: _Scene) -> AdjustedSection:
    """Each window as a rigid body about the curve, and what the patches say on their own."""
    section, points, active = scene.section, scene.section.points, list(scene.active)
    window, scatter, (patchwise, terms) = _normals_about(curve, scene)
    step, covariance, excess = _solve(window, scatter, active)
    core = slice(section.core_first, section.core_last + 1)
    counted = max(float(np.median(excess)), LIMITS.min_excess)
    covariance += curve_covariance(curve, _evened(patchwise.information) / counted, scene.active)[core]
    covariance *= np.maximum(contradiction[core] / LIMITS.consistent, 1.0)[:, None, None] ** 2
    shares = by_patch(np.column_stack([np.ones(len(points)), terms.share, terms.on_marking]), scene.patch,
                      scene.patches)
    counted = window_sums(shares, section.window_first, section.window_last)
    results = curve.plus(_padded(step, section, scene.patches))
    with np.errstate(invalid="ignore"):
        score, overlap = counted[:, 1] / counted[:, 0], counted[:, 2] / counted[:, 0]
    return AdjustedSection(results.translation[core], results.rotation[core], covariance,
                           np.column_stack([curve.translation, curve.rotation])[core], patchwise.information[core],
                           patchwise.gradient[core], score, overlap, counted[:, 0].astype(np.int64),
                           np.full(core.stop - core.start, converged))


def _evened(information: np.ndarray) -> np.ndarray:
    """(n, 6, 6) shared out over neighbouring patches, so that each curves downwards as a larger piece of path does."""
    count = len(information)
    low, high = (np.clip(np.arange(count) + side * LIMITS.evened, 0, count - 1) for side in (-1, 1))
    values, vectors = np.linalg.eigh(window_sums(information / (high - low + 1)[:, None, None], low, high))
    return np.einsum("nij,nj,nkj->nik", vectors, np.maximum(values, 0), vectors)


def _padded(step: np.ndarray, section: PathSection, patches: int) -> np.ndarray:
    whole = np.zeros((patches, 6))
    whole[section.core_first:section.core_last + 1] = step
    return whole


def _scatter(moved: np.ndarray, gradient: tuple, scene: _Scene) -> np.ndarray:
    """(n, 6, 6) squares of the gradients of clusters of points, by patch: how uneven the observations really are."""
    group = scene.patch // LIMITS.cluster_patches
    cluster = _cluster_numbers(moved, group, LIMITS.cluster)
    order = np.argsort(cluster, kind="stable")
    start = np.flatnonzero(np.r_[True, np.diff(cluster[order]) != 0])
    total = np.add.reduceat(point_gradients(moved - scene.origin, gradient)[order], start, axis=0)
    patch = np.minimum(group[order][start] * LIMITS.cluster_patches + LIMITS.cluster_patches // 2, scene.patches - 1)
    by_group = np.argsort(patch, kind="stable")
    total, patch = total[by_group], patch[by_group]
    squares = np.einsum("ni,nj->nij", total, total)
    return by_patch(squares, patch, scene.patches)


def _solve(window: PatchSums, scatter: np.ndarray, active: list[int]
           ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Movements of windows (k, 6), their covariances (k, 6, 6), and how much too often observations count (k,)."""
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
    covariance = inverse * np.maximum(excess, LIMITS.min_excess)[:, None, None]
    step = np.zeros((count, 6))
    step[:, active] = solution
    full = np.zeros((count, 6, 6))
    full[np.ix_(np.arange(count), active, active)] = covariance
    return step, full, excess


def _empty(section: PathSection, curve: CorrectionCurve) -> AdjustedSection:
    core = slice(section.core_first, section.core_last + 1)
    count = core.stop - core.start
    nothing = np.full(count, np.nan)
    return AdjustedSection(curve.translation[core], curve.rotation[core], np.full((count, 6, 6), np.nan),
                           np.zeros((count, 6)), np.zeros((count, 6, 6)), np.zeros((count, 6)), nothing, nothing,
                           np.zeros(count, dtype=np.int64), np.zeros(count, dtype=bool))
