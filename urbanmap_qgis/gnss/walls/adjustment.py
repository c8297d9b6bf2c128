"""Walls put where reflected signals say they are, or left where they are with the reason (J 5.6).

Signals are traced among the models; those that are blocked for sure and that exactly one wall can have reflected vote
on the offset of that wall. The offsets of all walls are estimated together with the errors that votes share. A wall
is adjusted only if the votes decide: enough of them, of several satellites and passes, a small sigma, one answer, the
same from any half of the passes. The buildings are moved, the signals traced again, until the votes stay the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import shapely

from ...errors import InputError
from ...progress import SILENT, Progress
from ..rays.reflections import LOS, REFLECTED, TraceSettings, Ways, possible_walls, trace
from ..rays.tracing import Obstacles, bounces
from ..rays.wall_faces import Walls, WallTable, building_walls, wall_table
from ..signals.tables import Signals
from .moved_buildings import PlanNet, applied_offsets, moved_walls, settle
from .offset_observations import Votes, gather_votes
from .offset_posterior import Offsets, estimate_offsets
from .receiver_clock import PassClock
from .residuals import corrected_residuals, line_of_sight_clocks
from .signal_strength import weaker_by

ADJUSTED, NOT_OBSERVABLE, HELD = "adjusted", "not observable", "held"
"""Moved by its votes; left because the votes do not decide; decided, but the building would not stay valid."""

UNWEAKENED = 3.0
"""Signals weaker by less than this are no reflections, dB."""


@dataclass(frozen=True)
class AdjustmentSettings:
    """How walls are adjusted.

    Parameters
    ----------
    prior_sigma : how far walls are off before anything is measured (standard deviation, m).
    block : signals of a satellite within this many seconds are one vote.
    least_votes, least_satellites, least_passes : a wall with fewer is left where it is. A pass is an observation file.
    most_sigma : a wall whose offset has a larger sigma is left where it is, m.
    most_offset : an offset beyond this is not believed, m.
    rounds : how often buildings are moved and signals traced again, at most.
    trace : how signals are traced.
    """

    prior_sigma: float = 1.0
    block: float = 30.0
    least_votes: int = 8
    least_satellites: int = 4
    least_passes: int = 3
    most_sigma: float = 0.35
    most_offset: float = 3.0
    rounds: int = 4
    trace: TraceSettings = field(default_factory=TraceSettings)

    def __post_init__(self) -> None:
        if min(self.prior_sigma, self.block, self.most_sigma, self.most_offset) <= 0 or self.rounds < 1:
            raise InputError("Prior, block length, largest sigma, largest offset and rounds must be greater than 0.")
        if min(self.least_votes, self.least_satellites, self.least_passes) < 1:
            raise InputError("The least numbers of votes, satellites and passes must be at least 1.")


@dataclass(frozen=True)
class WallResult:
    """One row a wall, in the order of `table`.

    Attributes
    ----------
    table : the walls where the models have them.
    offset, sigma : (k,) outwards, m, as the votes say, whether they decide or not; NaN without votes.
    votes, signals, satellites, passes : (k,) behind it.
    on_time : (k,) share of the votes that are neither late nor strays; NaN without votes.
    status : (k,) ADJUSTED, NOT_OBSERVABLE or HELD.  reason : (k,) why not, empty if adjusted.
    applied : (k,) how far the wall has moved outwards, m: by its own votes, or because its line or corners moved.
    distance : (k,) least distance of an antenna in front of it, m; NaN if none was.
    """

    table: WallTable
    offset: np.ndarray
    sigma: np.ndarray
    votes: np.ndarray
    signals: np.ndarray
    satellites: np.ndarray
    passes: np.ndarray
    on_time: np.ndarray
    status: np.ndarray
    reason: np.ndarray
    applied: np.ndarray
    distance: np.ndarray


@dataclass(frozen=True)
class Adjustment:
    """What an adjustment gives.

    Attributes
    ----------
    shapes : (n,) the buildings' shapes, moved.
    walls : results by wall.
    before, after : the pieces of the walls before and after.
    ways : ways of the signals among the moved walls.
    corrected : (n,) residual less the receiver's clock, m; NaN where the clock is not known.
    used : (n,) which signals have voted.
    votes : the votes, and `offsets` what was made of them.
    clocks : of each pass.
    rounds : how often the signals were traced.
    """

    shapes: np.ndarray
    walls: WallResult
    before: Walls
    after: Walls
    ways: Ways
    corrected: np.ndarray
    used: np.ndarray
    votes: Votes
    offsets: Offsets | None
    clocks: list[PassClock]
    rounds: int


@dataclass(frozen=True)
class _Round:
    """One tracing and what followed from it."""

    ways: Ways
    used: np.ndarray
    clocks: list[PassClock]
    votes: Votes
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
    for number in range(settings.rounds):
        part = progress.part(0.95 * number / settings.rounds, 0.95 * (number + 1) / settings.rounds)
        one = _round(walls, signals, outwards, settings, part.part(0.0, 0.8))
        result = _judged(result, before, one, settings, part)
        weight = np.where(result.status == ADJUSTED, result.sigma ** -2.0, 0.0)
        wanted = np.where(weight > 0, result.offset, 0.0)
        current, displacement, held = settle(shapes, row, before, net, wanted, np.nan_to_num(weight),
                                             part.part(0.8, 1.0))
        result = _with_held(result, held, applied_offsets(before, net, displacement))
        walls = moved_walls(before, net, displacement)
        settled = np.abs(result.applied - outwards).max(initial=0.0) < 0.03
        outwards = result.applied
        if settled:
            break
    ways = trace(walls, signals, settings.trace, progress.part(0.95, 1.0))
    corrected = corrected_residuals(signals, one.clocks)
    return Adjustment(current, _explained(result, before, signals, one, settings,
                                                    progress), before, walls, ways, corrected,
                      one.used, one.votes, one.offsets, one.clocks, number + 1)


def _round(walls: Walls, signals: Signals, outwards: np.ndarray, settings: AdjustmentSettings,
           progress: Progress) -> _Round:
    """Trace the signals, take the clocks off, gather votes and estimate offsets from the model's walls."""
    obstacles = Obstacles.of(walls)
    ways = trace(walls, signals, settings.trace, progress.part(0.0, 0.5), obstacles)
    clocks = line_of_sight_clocks(signals, ways, progress)
    used = _voters(walls, obstacles, signals, ways, settings, progress.part(0.5, 0.8))
    votes = gather_votes(walls, signals, ways, used, clocks, outwards, settings.block)
    progress.step(0.9)
    offsets = estimate_offsets(votes, settings.prior_sigma, progress=progress) if len(votes) else None
    return _Round(ways, used, clocks, votes, offsets)


def _voters(walls: Walls, obstacles: Obstacles, signals: Signals, ways: Ways, settings: AdjustmentSettings,
            progress: Progress) -> np.ndarray:
    """(n,) signals that are blocked for sure, weakened, and that no other wall can have reflected."""
    with np.errstate(invalid="ignore"):
        weakened = ~(weaker_by(signals, (ways.kind == LOS) & ways.sure) < UNWEAKENED)
    rows = np.flatnonzero((ways.kind == REFLECTED) & ways.sure & weakened)
    used = np.zeros(len(signals), bool)
    if len(rows):
        used[rows] = possible_walls(walls, obstacles, signals, rows, settings.trace, progress) == 1
    return used


def _undecided(walls: Walls, signals: Signals, progress: Progress) -> WallResult:
    """The result before anything is known."""
    table = wall_table(walls)
    count = len(table)
    nothing = np.full(count, np.nan)
    zeros = np.zeros(count, np.int64)
    return WallResult(table, nothing, nothing, zeros, zeros, zeros, zeros, nothing,
                      np.full(count, NOT_OBSERVABLE, object), np.full(count, "", object), np.zeros(count),
                      _nearest(table, signals, progress))


def _nearest(table: WallTable, signals: Signals, progress: Progress) -> np.ndarray:
    """(k,) least distance in plan of an antenna that stands in front of each wall, m; NaN if none does."""
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


def _judged(result: WallResult, walls: Walls, one: _Round, settings: AdjustmentSettings,
            progress: Progress) -> WallResult:
    """Offsets and numbers of a round, with the status of each wall that has votes."""
    count = walls.count
    offset, sigma, on_time = (np.full(count, np.nan) for _ in range(3))
    numbers = {name: np.zeros(count, np.int64) for name in ("votes", "signals", "satellites", "passes")}
    reason = np.full(count, "", object)
    reason[:] = "no vote"
    votes, found = one.votes, one.offsets
    if found is not None:
        offset[found.wall], sigma[found.wall] = found.offset, found.sigma
        numbers["votes"] = np.bincount(votes.wall, minlength=count)
        numbers["signals"] = np.bincount(votes.wall, votes.count, count).astype(np.int64)
        numbers["satellites"] = _different(votes.wall, votes.satellite, count)
        numbers["passes"] = _different(votes.wall, votes.source, count)
        on_time[found.wall] = (np.bincount(votes.wall, found.on_time, count) / np.maximum(numbers["votes"], 1)
                               )[found.wall]
        halves = _halves_differ(votes, found, settings, progress)
        for k, wall in enumerate(found.wall):
            reason[wall] = _objection(k, wall, found, numbers, on_time, votes, halves, settings)
    status = np.where(reason == "", ADJUSTED, NOT_OBSERVABLE).astype(object)
    return replace(result, offset=offset, sigma=sigma, on_time=on_time, status=status, reason=reason, **numbers)


def _objection(k: int, wall: int, found: Offsets, numbers: dict, on_time: np.ndarray, votes: Votes,
               halves: np.ndarray, settings: AdjustmentSettings) -> str:
    """Why the votes of a wall do not decide; empty if they do."""
    count, satellites, passes = (int(numbers[name][wall]) for name in ("votes", "satellites", "passes"))
    if satellites == 1 and count > 1:
        return "one satellite only"
    if count < settings.least_votes:
        return f"too few votes ({count} of {settings.least_votes})"
    if satellites < settings.least_satellites:
        return f"too few satellites ({satellites} of {settings.least_satellites})"
    if passes < settings.least_passes:
        return f"too few passes ({passes} of {settings.least_passes})"
    if found.rival[k] > 0.05:
        return "contradicting votes: two offsets are possible"
    if on_time[wall] < 0.6:
        return "contradicting votes: most are late or strays"
    if halves[k] > 3.0:
        return "contradicting votes: the passes do not agree"
    if found.sigma[k] > settings.most_sigma:
        flat = np.median(votes.slope[votes.wall == wall]) < 0.25
        return f"{'signals run along the wall' if flat else 'not precise enough'} (sigma {found.sigma[k]:.2f} m)"
    if abs(found.offset[k]) > settings.most_offset:
        return f"offset of {found.offset[k]:.1f} m is not credible"
    return ""


def _different(wall: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """(count,) number of different values with each wall."""
    number = np.unique(values, return_inverse=True)[1].ravel()
    return np.bincount(np.unique(np.column_stack([wall, number]), axis=0)[:, 0], minlength=count)


def _halves_differ(votes: Votes, found: Offsets, settings: AdjustmentSettings, progress: Progress) -> np.ndarray:
    """(k,) difference of the offsets from the one and the other half of the passes of each wall, over its sigma.

    Each half starts from the same prior, which pulls both to zero: their differences are then smaller, but so are
    their sigmas; the sum of the variances is that of the difference.
    """
    rank = np.zeros(len(votes), np.int64)
    for wall in found.wall:
        members = np.flatnonzero(votes.wall == wall)
        rank[members] = np.unique(votes.source[members], return_inverse=True)[1].ravel()
    parts = []
    for half in (0, 1):
        chosen = np.flatnonzero(rank % 2 == half)
        parts.append(estimate_offsets(_some(votes, chosen), 3.0 * settings.prior_sigma, found.model, False, progress)
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


def _some(votes: Votes, rows: np.ndarray) -> Votes:
    """Some of the votes."""
    columns = {name: getattr(votes, name)[rows] for name in ("wall", "source", "satellite", "block", "value", "slope",
                                                             "distance", "variance", "count")}
    shares = tuple(share[np.isin(np.flatnonzero(votes.source == number), rows)]
                   for number, share in enumerate(votes.share))
    return replace(votes, share=shares, **columns)


def _with_held(result: WallResult, held: np.ndarray, applied: np.ndarray) -> WallResult:
    """The result with the walls that could not be moved."""
    status, reason = result.status.copy(), result.reason.copy()
    status[held] = HELD
    reason[held] = "moved, the building would not stay valid or would run into another"
    return replace(result, status=status, reason=reason, applied=applied)


def _explained(result: WallResult, walls: Walls, signals: Signals, one: _Round,
               settings: AdjustmentSettings, progress: Progress) -> WallResult:
    """The result with the reason for each wall that has no vote."""
    met, blocked = (_walls_met(walls, signals, rows, settings, progress) for rows in (
        np.arange(len(signals)), np.flatnonzero(one.ways.kind != LOS)))
    free = np.bincount(walls.wall[one.ways.bounces.piece], minlength=walls.count) > 0
    alone = np.zeros(walls.count, bool)
    alone[walls.wall[one.ways.bounces.piece[one.ways.bounce[one.used]]]] = True
    reason = result.reason.copy()
    for wall in np.flatnonzero(result.votes == 0):
        if np.isnan(result.distance[wall]):
            reason[wall] = "no antenna in front of it"
        elif result.distance[wall] > settings.trace.farthest:
            reason[wall] = f"too far ({result.distance[wall]:.0f} m)"
        elif not met[wall]:
            reason[wall] = "no received signal could meet it"
        elif not blocked[wall]:
            reason[wall] = "open sky: what it could reflect is in line of sight"
        elif not free[wall]:
            reason[wall] = "hidden behind other buildings"
        elif not alone[wall]:
            reason[wall] = "other walls could have reflected the same signals"
        else:
            reason[wall] = "too few signals in a row"
    return replace(result, reason=reason)


def _walls_met(walls: Walls, signals: Signals, rows: np.ndarray, settings: AdjustmentSettings,
               progress: Progress) -> np.ndarray:
    """(walls,) whether each wall could reflect one of the signals of some rows, whatever stands in the way."""
    met = np.zeros(walls.count, bool)
    if len(rows):
        found = bounces(walls, signals.epochs.place, signals.epoch[rows], signals.direction[rows],
                        settings.trace.farthest, progress=replace(progress, report=lambda _: None))
        met[walls.wall[found.piece]] = True
    return met
