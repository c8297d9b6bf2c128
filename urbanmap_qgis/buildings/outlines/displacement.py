"""Official outlines that are off by a metre or two, moved to where the laser points show the buildings.

J 5.3.1 takes the outlines of the 2D map as a good estimation of the buildings. Where a map is displaced, that
fails; here all outlines are adjusted together: each should cover building and nothing else, none
should overlap its neighbour, and walls that neighbours share should meet.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import shapely

from ...errors import InputError
from ...geometry.grid import Grid
from ...geometry.linked_groups import linked_groups
from ...geometry.tolerances import LEAST_DIVISOR
from ...progress import SILENT, Progress
from ...wording import say
from .displacement_adjust import adjust_to_walls, wall_snap_candidates
from .displacement_boundary import COARSE_PIECE, edges_of, pieces_of, row_sums
from .displacement_pairs import neighbours, overlap_tables, walls_between
from .displacement_search import (
    COARSE_STEP,
    DEPARTURE_PRICE,
    FINE_STEPS,
    OutlineNetwork,
    choose,
    coarse_search,
    covered_by_others,
    drop_insignificant_shifts,
    fine_search,
    separate_overlapping,
    shift_lattice,
)

KEPT, MOVED, NOT_OBSERVABLE = "kept", "moved", "not observable"
MAX_SHIFT = 2.5  # m

OUTLINES_AT_ONCE = 1000  # connected sets of outlines are worked on together up to this number
MIN_MEASURED = 0.2  # share of its area that must hold points (in a sparse cloud many cells hold none)
HALF_MEASURED = 0.4  # the same, for the common shift: one cut by the end of the points does not count
UNSEEN_WEIGHT = 100.0  # price of departing, for an outline that is not observable
STACKED = 0.9  # share of the smaller outline in the larger one from which the two lie above one another
REGISTER_SIGMA = 0.2  # m: outlines are walls, points are roofs; their difference cannot be told from a shift
MISFIT = 0.5  # share of the strip that an outline covers wrongly which its place is uncertain by
MIN_COMMON = 0.35  # m, a shorter common shift may as well be eaves, or the strips' own error
MOVED_FROM = 0.005  # m, shorter shifts are none

MIN_SEEN = 0.25  # share of its area that must be covered by building evidence somewhere in reach
NOISE = 0.8  # m2, worth that chance adds: sets the scale of sigma


@dataclass(frozen=True)
class Displacements:
    """Shifts of n outlines, in the order given.

    Attributes
    ----------
    dx, dy : (n,) m, to be added to the outline.
    sigma : (n,) m, uncertainty of dx and of dy (each).
    status : (n,) of "kept", "moved", "not observable" (no building to be seen in reach: the outline follows the
        common shift of its connected set, which is mostly none).
    """

    dx: np.ndarray
    dy: np.ndarray
    sigma: np.ndarray
    status: np.ndarray


def estimate_displacements(polygons: np.ndarray, evidence: np.ndarray, grid: Grid,
                           surface: np.ndarray | None = None, max_shift: float = MAX_SHIFT,
                           progress: Progress = SILENT) -> Displacements:
    """Where each outline belongs, found for all outlines together.

    First the common shift of every connected set of outlines (a map sheet is often off as a whole), then each
    outline's own: a search on a coarse and two finer lattices, last an adjustment wall to wall. An outline leaves
    the common shift only where the evidence for it is clear. The result depends on the outlines of a connected set
    (nearer to each other than twice `max_shift`), not on other sets nor on the order of outlines.

    Parameters
    ----------
    polygons : (n,) shapely polygons or multipolygons; missing or empty ones get status "not observable".
    evidence : (rows, columns) in [-1, 1] on `grid`, see `EvidenceAccumulator.evidence`.
    surface : (rows, columns) highest z, NaN where no point fell: if given, an outline that would come to lie
        mostly where there are no points is not observable, whatever the evidence beside it suggests.
    max_shift : m, longest shift of an outline.

    Raises
    ------
    InputError : evidence not on the grid, or `max_shift` not positive.
    """
    polygons = np.asarray(polygons, dtype=object)
    evidence = np.asarray(evidence)
    if evidence.shape != grid.shape:
        raise InputError(say("The building evidence does not lie on its grid: give both the same rows and columns."))
    if not max_shift >= COARSE_STEP:
        raise InputError(say("The longest shift of an outline must be at least {coarse_step} m.",
                             coarse_step=COARSE_STEP))
    n = len(polygons)
    shifts, sigma = np.zeros((n, 2)), np.full(n, float(max_shift))
    seen = np.zeros(n, bool)
    sums = row_sums(np.nan_to_num(evidence), grid.cell)
    measured = None if surface is None else row_sums(np.isfinite(surface), grid.cell)
    usable = np.flatnonzero(shapely.is_geometry(polygons) & (shapely.area(polygons) > 0))
    usable = usable[_place_order(polygons[usable])]
    pairs = neighbours(polygons[usable], 2 * max_shift)
    done = 0
    for members, own_pairs in _batches(len(usable), pairs):
        progress.step(done / max(len(usable), 1))
        which = usable[members]
        part = _placed(polygons[which], own_pairs, sums, measured, grid, max_shift)
        shifts[which], sigma[which], seen[which] = part
        done += len(members)
    progress.step(1.0)
    far = np.hypot(*shifts.T) >= MOVED_FROM
    status = np.where(seen, np.where(far, MOVED, KEPT), NOT_OBSERVABLE)
    return Displacements(shifts[:, 0], shifts[:, 1], sigma, status)


def shifted_outlines(polygons: np.ndarray, displacements: Displacements) -> np.ndarray:
    """The outlines (n,) at their new places; missing ones stay missing."""
    polygons = np.array(polygons, dtype=object)
    points, owner = shapely.get_coordinates(polygons, include_z=True, return_index=True)
    points[:, 0] += displacements.dx[owner]
    points[:, 1] += displacements.dy[owner]
    flat = ~shapely.has_z(polygons)[owner]
    if flat.all():
        return shapely.set_coordinates(polygons, points[:, :2])
    points[flat, 2] = 0
    return np.where(shapely.has_z(polygons), shapely.set_coordinates(polygons, points),
                    shapely.force_2d(shapely.set_coordinates(polygons.copy(), points)))


def _place_order(polygons: np.ndarray) -> np.ndarray:
    """An order that depends on where the outlines lie, not on how they were listed."""
    box = shapely.bounds(polygons)
    return np.lexsort((shapely.area(polygons), box[:, 3], box[:, 2], box[:, 1], box[:, 0]))


def _batches(n: int, pairs: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Connected sets, put together to batches: members (m,), ascending, and their pairs numbered within."""
    if not n:
        return []
    _, label = linked_groups(*pairs.T, n)
    size = np.bincount(label)
    batch = (np.cumsum(size) - size) // OUTLINES_AT_ONCE
    of_outline, of_pair = batch[label], batch[label[pairs[:, 0]]]
    number = np.empty(n, np.int64)
    result = []
    by_outline, by_pair = np.argsort(of_outline, kind="stable"), np.argsort(of_pair, kind="stable")
    for b in np.unique(batch):
        members = by_outline[slice(*np.searchsorted(of_outline[by_outline], (b, b + 1)))]
        number[members] = np.arange(len(members))
        pair_rows = by_pair[slice(*np.searchsorted(of_pair[by_pair], (b, b + 1)))]
        result.append((members, number[pairs[pair_rows]].reshape(-1, 2)))
    return result


def _placed(polygons: np.ndarray, pairs: np.ndarray, sums: np.ndarray, measured: np.ndarray | None, grid: Grid,
            max_shift: float) -> tuple[np.ndarray, ...]:
    """Shifts, sigma, and whether observable, of one batch."""
    area = shapely.area(polygons)
    network = _network(polygons, area, pairs, sums, grid, max_shift)
    still = np.zeros((len(area), 1, 2))
    measured_share = np.ones(len(area)) if measured is None else network.of(measured, still)[:, 0] / area
    network, cover = _with_common_shift(network, measured_share >= HALF_MEASURED, max_shift)
    seen = cover.max(axis=1) >= MIN_SEEN * area
    network = replace(network, common=np.where(_in_observed_set(network, seen)[:, None], network.common, 0.0))
    if measured is not None:
        seen &= network.of(measured, network.common[:, None])[:, 0] >= MIN_MEASURED * area
    network = replace(network, shift_weight=np.where(seen, 1.0, UNSEEN_WEIGHT))
    shifts = coarse_search(network, cover, max_shift)
    beliefs = []
    for step, width in FINE_STEPS:
        shifts, belief = fine_search(network, shifts, step, width)
        beliefs.append(belief)
    shifts = _wall_to_wall(network, shifts, max_shift)
    separated = separate_overlapping(network, shifts, area, cover, max_shift)
    if (separated != shifts).any():
        again = _wall_to_wall(network, separated, max_shift)
        shifts = np.where(covered_by_others(network, again, area)[:, None], separated, again)
    shifts = drop_insignificant_shifts(network, shifts)
    shifts = np.where(seen[:, None], shifts, network.common)
    shifts = np.round(shifts * np.minimum(1, max_shift / np.maximum(np.hypot(*shifts.T), LEAST_DIVISOR))[:, None], 3)
    score = np.clip(network.cover(shifts[:, None])[:, 0] / area, -1, 1)  # mean building evidence under the outline
    # What an outline covers wrongly even at its best place, as a strip along its boundary: it has another shape.
    strip = area * (1 - score) / network.perimeter
    sigma = np.hypot(_sigma(beliefs[0], FINE_STEPS[0][0], max_shift), MISFIT * strip)
    return shifts, np.where(seen, np.minimum(sigma, max_shift), max_shift), seen


def _wall_to_wall(network: OutlineNetwork, shifts: np.ndarray, max_shift: float) -> np.ndarray:
    """Shifts (n, 2) adjust_to_walls so that walls which neighbours share meet, where that is worth it."""
    for _ in range(2):
        better = adjust_to_walls(network, shifts)
        shifts = choose(network, np.concatenate((
            shifts[:, None], better[:, None], network.common[:, None],
            wall_snap_candidates(network, shifts, max_shift, 4),
            wall_snap_candidates(network, better, max_shift, 4)), axis=1))
    return shifts


def _network(polygons: np.ndarray, area: np.ndarray, pairs: np.ndarray, sums: np.ndarray, grid: Grid,
            max_shift: float) -> OutlineNetwork:
    edges = edges_of(polygons)
    pieces = pieces_of(edges)
    reach = 2 * max_shift
    overlaps = overlap_tables(polygons, pieces, pairs, reach)
    middle = overlaps.shape[1] // 2
    stacked = overlaps[:, middle, middle] > STACKED * area[pairs].min(axis=1)
    overlaps[stacked] = 0
    perimeter = np.bincount(edges.owner, np.hypot(*(edges.end - edges.start).T), len(polygons))
    return OutlineNetwork(edges, pieces, pieces_of(edges, COARSE_PIECE), perimeter, sums, grid, pairs,
                  walls_between(edges, pairs, reach), overlaps, np.zeros((len(polygons), 2)), np.ones(len(polygons)))


def _with_common_shift(network: OutlineNetwork, observed: np.ndarray,
                       max_shift: float) -> tuple[OutlineNetwork, np.ndarray]:
    """The network with the common shift of every connected set, and the cover (n, k) m2 on the coarse lattice.

    Outlines that are not `observed` (n,) bool follow the shift that the others find.
    """
    n = len(network.perimeter)
    pairs = network.pairs
    sets, label = linked_groups(*pairs.T, n)
    steps = shift_lattice(COARSE_STEP, max_shift) * COARSE_STEP
    cover = network.cover(np.broadcast_to(steps, (n, *steps.shape)), coarse=True)
    table = _sum_by(label[observed], cover[observed], sets)
    shift = steps[table.argmax(1)]
    for step, _ in FINE_STEPS:
        around = shift[:, None] + shift_lattice(1, 2.9) * step
        finer = _sum_by(label[observed], network.cover(around[label])[observed], sets)
        shift = np.take_along_axis(around, finer.argmax(1)[:, None, None], 1)[:, 0]
    gain = finer.max(1) - table[:, np.flatnonzero((steps == 0).all(1))[0]]
    # Chance adds up slower than the outlines; an offset between all roofs and walls is no shift of the map.
    perimeter, members = np.bincount(label, network.perimeter, sets), np.bincount(label, minlength=sets)
    price = DEPARTURE_PRICE * perimeter / np.sqrt(members)
    clear = (gain >= price) & (np.hypot(*shift.T) >= MIN_COMMON)
    shift = np.where(clear[:, None], shift, 0)
    return replace(network, common=shift[label]), cover


def _in_observed_set(network: OutlineNetwork, seen: np.ndarray) -> np.ndarray:
    """Mask (n,) of the outlines whose connected set holds one that was seen: ground by itself shows no shift."""
    _, label = linked_groups(*network.pairs.T, len(seen))
    return np.bincount(label, seen)[label] > 0


def _sum_by(label: np.ndarray, values: np.ndarray, groups: int) -> np.ndarray:
    """Sums (groups, k) of the rows (n, k) that carry each label."""
    result = np.zeros((groups, values.shape[1]))
    np.add.at(result, label, values)
    return result


def _sigma(belief: np.ndarray, step: float, max_shift: float) -> np.ndarray:
    """Uncertainty (n,) m of a shift, from how fast the belief (n, 25) falls off around its best place."""
    places = shift_lattice(1, 2.9) * step
    loss = belief.max(1, keepdims=True) - belief
    best = places[belief.argmax(1)]
    away = places[None] - best[:, None]
    weight = np.exp(-np.minimum(loss / NOISE, 50.0))
    spread = (weight[..., None] * away**2).sum(1) / weight.sum(1)[:, None]
    return np.minimum(np.sqrt(spread.mean(1) + REGISTER_SIGMA**2), max_shift)
