"""The adjustment of outlines: the score of an arrangement, and the search for the best one.

Score (m2) of an arrangement: building evidence covered, less what is covered that is no building, less overlaps,
plus walls that meet their neighbours', less what it costs to depart from the common shift.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ...geometry.grid import Grid
from ...geometry.linked_groups import linked_groups
from ...geometry.tolerances import ROUNDING
from .displacement_boundary import Edges, Pieces, sums_inside
from .displacement_pairs import MASK_CELL, SharedWalls, meeting_tables

# score lost per m2 of overlap: 1 for the evidence counted twice, the rest for the overlap itself
OVERLAP = 1.5
DEPARTURE_RANGE = 0.25  # m, the whole price is paid from this departure on
# m, the same distance for the coarse lattice and for the last choice
COARSE_WIDTH = 0.6
EXACT_WIDTH = 0.15
ROUNDS = 16
DAMPING = 0.3
CHANCE = .5  # share of the score of newly meeting walls that speaks for a departure
SAME_PLACE = 1e-3  # m
MAX_COVERED = 0.4  # share of its area that others cover from which an outline looks for another place
PAIRS_AT_ONCE = 2048  # pairs whose tables over all candidates are held at once

WALL = 1.6  # m2, score of one metre of meeting wall
DEPARTURE_PRICE = 0.1  # m: an outline departs from the common shift only if it gains such a strip all around it
TIE = 0.01  # m2 a metre of boundary and of departure: decides where nothing else does
COARSE_STEP = 0.5  # m
FINE_STEPS = ((0.2, 0.4), (0.1, 0.25))  # m: step of the lattice, distance at which a wall no longer meets


@dataclass(frozen=True)
class OutlineNetwork:
    """What the score of an arrangement needs, of n outlines with p pairs of neighbours.

    Attributes
    ----------
    edges, pieces, coarse : boundaries.
    perimeter : (n,) m.
    sums, grid : row sums of the evidence.
    pairs : (p, 2) first < second.
    walls : see `SharedWalls`.
    overlaps : tables of `overlap_tables`.
    common : (n, 2) m, shift of the whole set that each outline belongs to.
    shift_weight : (n,) factor on the price of departing from it.
    """

    edges: Edges
    pieces: Pieces
    coarse: Pieces
    perimeter: np.ndarray
    sums: np.ndarray
    grid: Grid
    pairs: np.ndarray
    walls: SharedWalls
    overlaps: np.ndarray
    common: np.ndarray
    shift_weight: np.ndarray

    def cover(self, shifts: np.ndarray, coarse: bool = False) -> np.ndarray:
        """Evidence covered (m2) by each outline at its shifts (n, k, 2): (n, k)."""
        return sums_inside(self.coarse if coarse else self.pieces, shifts, self.sums, self.grid)

    def of(self, sums: np.ndarray, shifts: np.ndarray) -> np.ndarray:
        """Another raster, given by its row sums, added up over each outline at its shifts (n, k, 2): (n, k)."""
        return sums_inside(self.pieces, shifts, sums, self.grid)

    def unary_score(self, shifts: np.ndarray, cover: np.ndarray | None = None) -> np.ndarray:
        """Score (m2) of each outline by itself at its shifts (n, k, 2): (n, k). `cover` saves computing it."""
        away = np.hypot(*np.moveaxis(shifts - self.common[:, None], 2, 0))
        price = DEPARTURE_PRICE * np.minimum(away / DEPARTURE_RANGE, 1) + TIE * away
        return (self.cover(shifts) if cover is None else cover) - (self.shift_weight * self.perimeter)[:, None] * price

    def relative(self, shifts: np.ndarray) -> np.ndarray:
        """Shift (p, 2) of the second outline of each pair against the first."""
        return shifts[self.pairs[:, 1]] - shifts[self.pairs[:, 0]]

    def only(self, keep: np.ndarray) -> OutlineNetwork:
        """The same outlines with only those pairs that `keep` (p,) marks."""
        chosen = keep[self.walls.pair]
        number = np.cumsum(keep) - 1
        walls = SharedWalls(number[self.walls.pair[chosen]], self.walls.length[chosen], self.walls.meeting[chosen])
        return replace(self, pairs=self.pairs[keep], walls=walls, overlaps=self.overlaps[keep])

    def pair_score(self, relative: np.ndarray, width: float) -> np.ndarray:
        """Score (m2) of each pair at its relative shifts (p, k, 2): (p, k)."""
        return self.meeting(relative, width) - OVERLAP * self.overlap(relative)

    def meeting(self, relative: np.ndarray, width: float) -> np.ndarray:
        """Score (m2) of the walls of each pair that meet at its relative shifts (p, k, 2): (p, k)."""
        return WALL * meeting_tables(self.walls, len(self.pairs), relative, width)

    def overlap(self, relative: np.ndarray) -> np.ndarray:
        """Overlap (m2) of each pair at its relative shifts (p, k, 2), bilinear in the tables: (p, k)."""
        side = self.overlaps.shape[1]
        place = np.clip(relative / MASK_CELL + side // 2, 0, side - 1.001)
        cell = place.astype(np.int64)
        u, v = np.moveaxis(place - cell, 2, 0)
        flat = (np.arange(len(relative))[:, None] * side + cell[..., 1]) * side + cell[..., 0]
        table = self.overlaps.reshape(-1)
        below = table[flat] * (1 - u) + table[flat + 1] * u
        above = table[flat + side] * (1 - u) + table[flat + side + 1] * u
        return below * (1 - v) + above * v


def shift_lattice(step: float, reach: float) -> np.ndarray:
    """Whole numbers (k, 2) of steps whose length is at most `reach` m."""
    q = int(np.floor(reach / step + ROUNDING))
    square = _square(q)
    return square[np.hypot(*square.T) * step <= reach + ROUNDING]


def _square(q: int) -> np.ndarray:
    steps = np.arange(-q, q + 1)
    return np.stack(np.meshgrid(steps, steps), -1).reshape(-1, 2)


def max_sum_belief(single: np.ndarray, pairs: np.ndarray, score: Callable[[slice], np.ndarray]) -> np.ndarray:
    """Belief (n, k) in every candidate of every outline: its score with the others at their best around it.

    Max-sum message passing, all outlines at once, a fixed number of rounds: the work is linear in the outlines,
    each outline hears of others at most `ROUNDS` neighbours away, and no order of outlines matters.

    Parameters
    ----------
    single : (n, k) score of the candidates by themselves.
    score : gives for a slice of the pairs (m, k, k): candidate of the first outline, of the second.
    """
    single = single.astype(np.float32)
    if not len(pairs):
        return single
    parts = [slice(b, b + PAIRS_AT_ONCE) for b in range(0, len(pairs), PAIRS_AT_ONCE)]
    stored = score(parts[0]).astype(np.float32) if len(parts) == 1 else None
    to_second = np.zeros((len(pairs), single.shape[1]), np.float32)
    to_first = np.zeros_like(to_second)
    belief = single
    first, second = pairs.T
    receiver = np.concatenate((first, second))
    order = np.argsort(receiver, kind="stable")
    begin = np.flatnonzero(np.r_[True, np.diff(receiver[order]) > 0])
    sums = np.empty((min(len(pairs), PAIRS_AT_ONCE), single.shape[1], single.shape[1]), np.float32)
    for _ in range(ROUNDS):
        new_second, new_first = np.empty_like(to_second), np.empty_like(to_first)
        for part in parts:
            table = score(part).astype(np.float32) if stored is None else stored
            of_first = belief[first[part]] - to_first[part]
            of_second = belief[second[part]] - to_second[part]
            both = sums[:len(table)]
            np.add(of_first[:, :, None], table, out=both).max(1, out=new_second[part])
            np.add(of_second[:, None, :], table, out=both).max(2, out=new_first[part])
        to_second = _damped(to_second, new_second)
        to_first = _damped(to_first, new_first)
        belief = single.copy()
        belief[receiver[order][begin]] += np.add.reduceat(np.concatenate((to_first, to_second))[order], begin, axis=0)
    return belief


def _damped(old: np.ndarray, new: np.ndarray) -> np.ndarray:
    return np.float32(DAMPING) * old + np.float32(1 - DAMPING) * (new - new.max(1, keepdims=True))


def coarse_search(network: OutlineNetwork, cover: np.ndarray, max_shift: float) -> np.ndarray:
    """Best shifts (n, 2) on the coarse lattice within `max_shift` m; `cover` (n, k) m2 on that lattice."""
    steps = shift_lattice(COARSE_STEP, max_shift)
    q = 2 * int(np.abs(steps).max())
    single = network.unary_score(np.broadcast_to(steps * COARSE_STEP, (*cover.shape, 2)), cover)
    fits = meeting_tables(network.walls, len(network.pairs), _square(q) * COARSE_STEP, COARSE_WIDTH)
    stride, middle = round(COARSE_STEP / MASK_CELL), network.overlaps.shape[1] // 2
    at = middle + stride * _square(q)
    tables = (WALL * fits - OVERLAP * network.overlaps[:, at[:, 1], at[:, 0]]).astype(np.float32)
    difference = steps[None, :] - steps[:, None]
    index = (difference[..., 1] + q) * (2 * q + 1) + difference[..., 0] + q
    belief = max_sum_belief(single, network.pairs, lambda part: tables[part][:, index])
    return steps[belief.argmax(1)] * COARSE_STEP


def fine_search(network: OutlineNetwork, shifts: np.ndarray, step: float,
                width: float) -> tuple[np.ndarray, np.ndarray]:
    """Best shifts (n, 2) on a lattice of two steps around `shifts`, and the belief (n, 25) in its places."""
    steps, differences = _square(2), _square(4)
    around = shifts[:, None] + steps * step
    difference = steps[None, :] - steps[:, None]
    index = (difference[..., 1] + 4) * 9 + difference[..., 0] + 4
    tables = network.pair_score(network.relative(shifts)[:, None] + differences * step, width)
    belief = max_sum_belief(network.unary_score(around), network.pairs, lambda part: tables[part][:, index])
    return np.take_along_axis(around, belief.argmax(1)[:, None, None], 1)[:, 0], belief


def choose(network: OutlineNetwork, candidates: np.ndarray) -> np.ndarray:
    """Best combination (n, 2) of candidate shifts (n, k, 2); the first candidate wins where they are equal."""
    k = candidates.shape[1]

    def score(part: slice) -> np.ndarray:
        return tables[part].reshape(-1, k, k)

    first, second = candidates[network.pairs[:, 0]], candidates[network.pairs[:, 1]]
    relative = (second[:, None, :] - first[:, :, None]).reshape(len(network.pairs), k * k, 2)
    tables = network.pair_score(relative, EXACT_WIDTH)
    belief = max_sum_belief(network.unary_score(candidates), network.pairs, score)
    return np.take_along_axis(candidates, belief.argmax(1)[:, None, None], 1)[:, 0]


def separate_overlapping(network: OutlineNetwork, shifts: np.ndarray, area: np.ndarray, cover: np.ndarray,
                         max_shift: float) -> np.ndarray:
    """Shifts (n, 2) where outlines that came to lie on others found places of their own, one after another.

    The search for all may end with two equal sheds in one place and none beside it; here one outline moves at a
    time, the one that gains most, while all others stay. `cover` (n, k) is that of the coarse lattice.
    """
    shifts = shifts.copy()
    n = len(shifts)
    steps = shift_lattice(COARSE_STEP, max_shift) * COARSE_STEP
    unary = network.unary_score(np.broadcast_to(steps, (n, *steps.shape)), cover)
    placed = np.zeros(n, bool)
    while True:
        overlapping = covered_by_others(network, shifts, area) & ~placed
        if not overlapping.any():
            return shifts
        part = network.only(overlapping[network.pairs].any(axis=1))
        first, second = shifts[part.pairs[:, 0]][:, None], shifts[part.pairs[:, 1]][:, None]
        score = unary + _of_both(part, part.pair_score(second - steps, COARSE_WIDTH),
                                 part.pair_score(steps - first, COARSE_WIDTH))
        present = part.pair_score(part.relative(shifts)[:, None], COARSE_WIDTH)
        gain = score.max(axis=1) - (network.unary_score(shifts[:, None]) + _of_both(part, present, present))[:, 0]
        mover = np.where(overlapping, gain, -np.inf).argmax()
        if gain[mover] <= 0:
            return shifts
        shifts[mover] = steps[score[mover].argmax()]
        placed[mover] = True


def covered_by_others(network: OutlineNetwork, shifts: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Mask (n,) of the outlines that lie on others with too much of their area (n,) m2."""
    overlap = network.overlap(network.relative(shifts)[:, None])
    return _of_both(network, overlap, overlap)[:, 0] > MAX_COVERED * area


def _of_both(network: OutlineNetwork, of_first: np.ndarray, of_second: np.ndarray) -> np.ndarray:
    """Sums (n, k) over the pairs of each outline of what the pairs (p, k) mean to their first and their second."""
    total = np.zeros((len(network.perimeter), of_first.shape[1]))
    np.add.at(total, network.pairs[:, 0], of_first)
    np.add.at(total, network.pairs[:, 1], of_second)
    return total


def drop_insignificant_shifts(network: OutlineNetwork, shifts: np.ndarray) -> np.ndarray:
    """Shifts (n, 2) where outlines that gain nothing by departing from the common shift are put back to it.

    Neighbours that depart together are judged together: equal sheds that only changed places go back. SharedWalls that
    come to meet count in part only, for equal walls may meet by chance; walls torn apart count whole.
    """
    n = len(shifts)
    departing = np.hypot(*(shifts - network.common).T) > SAME_PLACE
    inside = departing[network.pairs].all(axis=1)
    groups, label = linked_groups(*network.pairs[inside].T, n)
    gain = np.bincount(label, _difference(network.unary_score(np.stack((network.common, shifts), 1))), groups)
    relative = np.stack((network.relative(network.common), network.relative(shifts)), 1)
    of_pair = np.where(departing[network.pairs[:, 0]], *label[network.pairs].T)
    gain -= OVERLAP * np.bincount(of_pair, _difference(network.overlap(relative)), groups)
    walls = np.bincount(of_pair, _difference(network.meeting(relative, EXACT_WIDTH)), groups)
    gain += np.where(walls > 0, CHANCE * walls, walls)
    return np.where((gain[label] > 0)[:, None], shifts, network.common)


def _difference(before_and_after: np.ndarray) -> np.ndarray:
    return before_and_after[:, 1] - before_and_after[:, 0]
