"""Walls put where reflected signals say they are, or left where they are with the reason (J 5.6).

Signals are traced among the models; those that are blocked for sure and that exactly one wall can have reflected are
observations on the offset of that wall. The offsets of all walls are estimated together with the errors that
observations share. A wall is adjusted only if the observations decide: enough of them, of several satellites and
passes, a small sigma, one answer, the same from any half of the passes. What they tell without deciding still moves it
where it takes away most of the prior's variance: such a wall is "likely", its sigma larger. The buildings are moved,
the signals traced again, until the observations stay the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from ...progress import SILENT, Progress
from ...settings.gnss import AdjustmentSettings
from ...wording import mark, say
from ..rays.reflections import LOS, REFLECTED, SignalPaths, possible_walls, trace
from ..rays.tracing import WallObstacles, mirror_reflections
from ..rays.wall_faces import WallPieces, WallTable, building_walls, wall_table
from ..signals.tables import Signals
from .moved_buildings import PlanNet, applied_offsets, move_buildings, moved_walls
from .offset_observations import OffsetObservations, gather_observations
from .offset_posterior import Offsets, estimate_offsets
from .receiver_clock import PassClock
from .residuals import corrected_residuals, line_of_sight_clocks
from .signal_strength import attenuation

ADJUSTED, LIKELY, NOT_OBSERVABLE, HELD = mark("adjusted"), mark("likely"), mark("not observable"), mark("held")
"""Moved by its observations; moved though they are few or contradict each other, with the larger sigma that they leave;
left because the observations tell too little; to be moved, but the building would not stay valid."""

RIVAL = 0.05  # probability of another offset
INLIER_SHARE = 0.6
HALVES = 3.0  # sigmas between the offsets of the halves of the passes
LIKELY_INLIERS = 3.0
LIKELY_SATELLITES = 2

UNWEAKENED = 3.0
"""Signals weaker by less than this are no reflections, dB."""


@dataclass(frozen=True)
class WallResult:
    """One row a wall, in the order of `table`.

    Attributes
    ----------
    table : the walls where the models have them.
    offset, sigma : (k,) outwards, m, as the observations say, whether they decide or not; NaN without observations.
    observations, signals, satellites, passes : (k,) behind it.
    inlier_share : (k,) share of the observations that are neither NLOS-delayed nor outliers; NaN without observations.
    status : (k,) ADJUSTED, LIKELY, NOT_OBSERVABLE or HELD.
    reason : (k,) why not adjusted, empty if it is.
    applied : (k,) how far the wall has moved outwards, m: by its own observations, or because its line or corners
        moved.
    distance : (k,) minimum distance of an antenna in front of it, m; NaN if none was.
    """

    table: WallTable
    offset: np.ndarray
    sigma: np.ndarray
    observations: np.ndarray
    signals: np.ndarray
    satellites: np.ndarray
    passes: np.ndarray
    inlier_share: np.ndarray
    status: np.ndarray
    reason: np.ndarray
    applied: np.ndarray
    distance: np.ndarray

    @property
    def is_moved(self) -> np.ndarray:
        """(k,) walls that their own observations move: adjusted or likely."""
        return (self.status == ADJUSTED) | (self.status == LIKELY)


@dataclass(frozen=True)
class Adjustment:
    """What an adjustment gives.

    Attributes
    ----------
    shapes : (n,) the buildings' shapes, moved.
    walls : results by wall.
    before, after : the pieces of the walls before and after.
    paths : paths of the signals among the moved walls.
    corrected : (n,) residual less the receiver's clock, m; NaN where the clock is not known.
    used : (n,) which signals were used.
    observations : the observations, and `offsets` what was made of them.
    clocks : of each pass.
    iterations : how often the signals were traced.
    """

    shapes: np.ndarray
    walls: WallResult
    before: WallPieces
    after: WallPieces
    paths: SignalPaths
    corrected: np.ndarray
    used: np.ndarray
    observations: OffsetObservations
    offsets: Offsets | None
    clocks: list[PassClock]
    iterations: int


@dataclass(frozen=True)
class _Iteration:
    """One tracing and what followed from it."""

    paths: SignalPaths
    used: np.ndarray
    clocks: list[PassClock]
    observations: OffsetObservations
    offsets: Offsets | None


def adjust_walls(shapes: Sequence[shapely.Geometry | None], building: np.ndarray, signals: Signals,
                 top: np.ndarray | None = None, low: np.ndarray | None = None,
                 settings: AdjustmentSettings | None = None, progress: Progress = SILENT) -> Adjustment:
    """Adjust the walls of buildings.

    Parameters
    ----------
    shapes, building, top, low : as in `walls.building_walls`; shapes of one `building` move together.
    signals : of all passes.

    Raises
    ------
    InputError : buildings without heights.
    InsufficientDataError : no signals, or all antennas within buildings.
    """
    settings = settings or AdjustmentSettings()
    before = building_walls(shapes, building, top, low)
    row = np.unique(np.asarray(building), return_inverse=True)[1].ravel()
    net = PlanNet.of(before)
    result = _undecided(before, signals, progress)
    walls, outwards, current = before, np.zeros(before.count), np.array(shapes, dtype=object)
    for number in range(settings.max_iterations):
        part = progress.part(0.95 * number / settings.max_iterations, 0.95 * (number + 1) / settings.max_iterations)
        one = _iterate(walls, signals, outwards, settings, part.part(0.0, 0.8))
        result = _judged(result, before, one, settings, part)
        weight = np.where(result.is_moved, result.sigma ** -2.0, 0.0)
        wanted = np.where(weight > 0, result.offset, 0.0)
        current, displacement, immovable = move_buildings(shapes, row, before, net, wanted, np.nan_to_num(weight),
                                                          part.part(0.8, 1.0))
        result = _with_held(result, immovable, applied_offsets(before, net, displacement))
        walls = moved_walls(before, net, displacement)
        converged = np.abs(result.applied - outwards).max(initial=0.0) < 0.03
        outwards = result.applied
        if converged:
            break
    paths = trace(walls, signals, settings.trace, progress.part(0.95, 1.0))
    corrected = corrected_residuals(signals, one.clocks)
    return Adjustment(current, _explained(result, before, signals, one, settings,
                                                    progress), before, walls, paths, corrected,
                      one.used, one.observations, one.offsets, one.clocks, number + 1)


def _iterate(walls: WallPieces, signals: Signals, outwards: np.ndarray, settings: AdjustmentSettings,
             progress: Progress) -> _Iteration:
    """Trace the signals, take the clocks off, gather observations and estimate offsets from the model's walls."""
    obstacles = WallObstacles.of(walls)
    paths = trace(walls, signals, settings.trace, progress.part(0.0, 0.5), obstacles)
    clocks = line_of_sight_clocks(signals, paths, progress)
    used = _usable_signals(walls, obstacles, signals, paths, settings, progress.part(0.5, 0.8))
    observations = gather_observations(walls, signals, paths, used, clocks, outwards, settings.block)
    progress.step(0.9)
    offsets = estimate_offsets(observations, settings.prior_sigma, progress=progress) if len(observations) else None
    return _Iteration(paths, used, clocks, observations, offsets)


def _usable_signals(walls: WallPieces, obstacles: WallObstacles, signals: Signals, paths: SignalPaths,
                    settings: AdjustmentSettings, progress: Progress) -> np.ndarray:
    """(n,) signals that are blocked for sure, weakened, and that no other wall can have reflected."""
    with np.errstate(invalid="ignore"):
        weakened = ~(attenuation(signals, (paths.kind == LOS) & paths.sure) < UNWEAKENED)
    rows = np.flatnonzero((paths.kind == REFLECTED) & paths.sure & weakened)
    used = np.zeros(len(signals), bool)
    if len(rows):
        used[rows] = possible_walls(walls, obstacles, signals, rows, settings.trace, progress) == 1
    return used


def _undecided(walls: WallPieces, signals: Signals, progress: Progress) -> WallResult:
    """The result before anything is known."""
    table = wall_table(walls)
    count = len(table)
    nothing = np.full(count, np.nan)
    zeros = np.zeros(count, np.int64)
    return WallResult(table, nothing, nothing, zeros, zeros, zeros, zeros, nothing,
                      np.full(count, NOT_OBSERVABLE, object), np.full(count, "", object), np.zeros(count),
                      _nearest(table, signals, progress))


def _nearest(table: WallTable, signals: Signals, progress: Progress) -> np.ndarray:
    """(k,) minimum distance in plan of an antenna that stands in front of each wall, m; NaN if none does."""
    places = np.unique(np.round(signals.epochs.place[:, :2]), axis=0)
    nearest = np.full(len(table), np.inf)
    along = np.column_stack([-table.normal[:, 1], table.normal[:, 0]])
    first = np.einsum("ij,ij->i", table.start, along)
    last = np.einsum("ij,ij->i", table.end, along)
    offset = np.einsum("ij,ij->i", table.start, table.normal)
    for chunk in np.array_split(places, max(1, len(places) * len(table) // 1_000_000)):
        progress.check()
        front = chunk @ table.normal.T - offset
        beside = chunk @ along.T
        beyond = np.maximum(np.maximum(first - beside, beside - last), 0.0)
        away = np.where(front > 0, np.hypot(front, beyond), np.inf)
        nearest = np.minimum(nearest, away.min(axis=0))
    return np.where(np.isfinite(nearest), nearest, np.nan)


def _judged(result: WallResult, walls: WallPieces, one: _Iteration, settings: AdjustmentSettings,
            progress: Progress) -> WallResult:
    """Offsets and numbers of an iteration, with the status of each wall that has observations."""
    count = walls.count
    offset, sigma, inlier_share = (np.full(count, np.nan) for _ in range(3))
    numbers = {name: np.zeros(count, np.int64) for name in ("observations", "signals", "satellites", "passes")}
    reason = np.full(count, "", object)
    reason[:] = "no observation"
    observations, found = one.observations, one.offsets
    if found is not None:
        offset[found.wall], sigma[found.wall] = found.offset, found.sigma
        numbers["observations"] = np.bincount(observations.wall, minlength=count)
        numbers["signals"] = np.bincount(observations.wall, observations.count, count).astype(np.int64)
        numbers["satellites"] = _different(observations.wall, observations.satellite, count)
        numbers["passes"] = _different(observations.wall, observations.source, count)
        inliers = np.bincount(observations.wall, found.inlier, count)
        inlier_share[found.wall] = (inliers / np.maximum(numbers["observations"], 1))[found.wall]
        halves = _halves_differ(observations, found, settings, progress)
        for k, wall in enumerate(found.wall):
            reason[wall] = _reason_against(k, wall, found, numbers, inlier_share, observations, halves, settings)
    status = np.where(reason == "", ADJUSTED, NOT_OBSERVABLE).astype(object)
    if found is not None:
        likely = found.wall[_are_likely(found, inliers, numbers, halves, settings)]
        status[likely[reason[likely] != ""]] = LIKELY
    return replace(result, offset=offset, sigma=sigma, inlier_share=inlier_share, status=status, reason=reason,
                   **numbers)


def _are_likely(found: Offsets, inliers: np.ndarray, numbers: dict, halves: np.ndarray,
                settings: AdjustmentSettings) -> np.ndarray:
    """(k,) walls of `found` of which the observations tell enough to move them, though they may not decide.

    `inliers` (walls,) observations that are expected to be neither NLOS-delayed nor outliers: these count, however many
    others there are.
    """
    wall = found.wall
    return ((found.sigma <= settings.likely_sigma) & (found.rival <= RIVAL) & (halves <= HALVES)
            & (np.abs(found.offset) <= settings.max_offset) & (inliers[wall] >= LIKELY_INLIERS)
            & (numbers["satellites"][wall] >= LIKELY_SATELLITES)
            & (numbers["passes"][wall] >= settings.min_passes))


def _reason_against(k: int, wall: int, found: Offsets, numbers: dict, inlier_share: np.ndarray,
                    observations: OffsetObservations, halves: np.ndarray, settings: AdjustmentSettings) -> str:
    """Why the observations of a wall do not decide; empty if they do."""
    count, satellites, passes = (int(numbers[name][wall]) for name in ("observations", "satellites", "passes"))
    if satellites == 1 and count > 1:
        return say("one satellite only")
    if count < settings.min_observations:
        return say("too few observations ({count} of {min_observations})", count=count,
                   min_observations=settings.min_observations)
    if satellites < settings.min_satellites:
        return say("too few satellites ({satellites} of {min_satellites})", satellites=satellites,
                   min_satellites=settings.min_satellites)
    if passes < settings.min_passes:
        return say("too few passes ({passes} of {min_passes})", passes=passes, min_passes=settings.min_passes)
    if found.rival[k] > RIVAL:
        return say("contradicting observations: two offsets are possible")
    if inlier_share[wall] < INLIER_SHARE:
        return say("contradicting observations: most are NLOS-delayed or outliers")
    if halves[k] > HALVES:
        return say("contradicting observations: the passes do not agree")
    if found.sigma[k] > settings.max_sigma:
        flat = np.median(observations.cosine[observations.wall == wall]) < 0.25
        if flat:
            return say("signals run along the wall (sigma {sigma:.2f} m)", sigma=found.sigma[k])
        return say("not precise enough (sigma {sigma:.2f} m)", sigma=found.sigma[k])
    if abs(found.offset[k]) > settings.max_offset:
        return say("offset of {offset:.1f} m is not credible", offset=found.offset[k])
    return ""


def _different(wall: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """(count,) number of different values with each wall."""
    number = np.unique(values, return_inverse=True)[1].ravel()
    return np.bincount(np.unique(np.column_stack([wall, number]), axis=0)[:, 0], minlength=count)


def _halves_differ(observations: OffsetObservations, found: Offsets, settings: AdjustmentSettings,
                   progress: Progress) -> np.ndarray:
    """(k,) difference of the offsets from the one and the other half of the passes of each wall, over its sigma.

    Each half starts from the same prior, which pulls both to zero: their differences are then smaller, but so are
    their sigmas; the sum of the variances is that of the difference.
    """
    rank = np.zeros(len(observations), np.int64)
    for wall in found.wall:
        members = np.flatnonzero(observations.wall == wall)
        rank[members] = np.unique(observations.source[members], return_inverse=True)[1].ravel()
    parts = []
    for half in (0, 1):
        chosen = np.flatnonzero(rank % 2 == half)
        parts.append(estimate_offsets(_some(observations, chosen), 3.0 * settings.prior_sigma, found.model, False,
                                      progress)
                     if len(chosen) else None)
    ratio = np.zeros(len(found.wall))
    if all(part is not None for part in parts):
        one, other = (dict(zip(part.wall, range(len(part.wall)))) for part in parts)
        for k, wall in enumerate(found.wall):
            if wall in one and wall in other:
                a, b = one[wall], other[wall]
                difference = parts[0].offset[a] - parts[1].offset[b]
                ratio[k] = abs(difference) / np.hypot(parts[0].sigma[a], parts[1].sigma[b])
    return ratio


def _some(observations: OffsetObservations, rows: np.ndarray) -> OffsetObservations:
    """Some of the observations."""
    columns = {name: getattr(observations, name)[rows]
               for name in ("wall", "source", "satellite", "block", "value", "cosine",
                            "distance", "variance", "count")}
    shares = tuple(share[np.isin(np.flatnonzero(observations.source == number), rows)]
                   for number, share in enumerate(observations.share))
    return replace(observations, share=shares, **columns)


def _with_held(result: WallResult, immovable: np.ndarray, applied: np.ndarray) -> WallResult:
    """The result with the walls that could not be moved."""
    status, reason = result.status.copy(), result.reason.copy()
    status[immovable] = HELD
    reason[immovable] = say("moved, the building would not stay valid or would run into another")
    return replace(result, status=status, reason=reason, applied=applied)


def _explained(result: WallResult, walls: WallPieces, signals: Signals, one: _Iteration,
               settings: AdjustmentSettings, progress: Progress) -> WallResult:
    """The result with the reason for each wall that has no observation."""
    met, blocked = (_walls_met(walls, signals, rows, settings, progress) for rows in (
        np.arange(len(signals)), np.flatnonzero(one.paths.kind != LOS)))
    free = np.bincount(walls.wall[one.paths.reflections.piece], minlength=walls.count) > 0
    unique = np.zeros(walls.count, bool)
    unique[walls.wall[one.paths.reflections.piece[one.paths.reflection[one.used]]]] = True
    reason = result.reason.copy()
    for wall in np.flatnonzero(result.observations == 0):
        if np.isnan(result.distance[wall]):
            reason[wall] = say("no antenna in front of it")
        elif result.distance[wall] > settings.trace.max_range:
            reason[wall] = f"too far ({result.distance[wall]:.0f} m)"
        elif not met[wall]:
            reason[wall] = say("no received signal could meet it")
        elif not blocked[wall]:
            reason[wall] = say("open sky: what it could reflect is in line of sight")
        elif not free[wall]:
            reason[wall] = say("hidden behind other buildings")
        elif not unique[wall]:
            reason[wall] = say("other walls could have reflected the same signals")
        else:
            reason[wall] = say("too few signals in a row")
    return replace(result, reason=reason)


def _walls_met(walls: WallPieces, signals: Signals, rows: np.ndarray, settings: AdjustmentSettings,
               progress: Progress) -> np.ndarray:
    """(walls,) whether each wall could reflect one of the signals of some rows, whatever obstructs it."""
    met = np.zeros(walls.count, bool)
    if len(rows):
        found = mirror_reflections(walls, signals.epochs.place, signals.epoch[rows], signals.direction[rows],
                                   settings.trace.max_range, progress=replace(progress, report=lambda _: None))
        met[walls.wall[found.piece]] = True
    return met
