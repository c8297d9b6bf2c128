"""How two neighbouring outlines fit together, for every shift of one against the other.

Outlines of one register that touch share their walls to the centimetre: once each is at its place, their edges
meet with neither gap nor overlap. So the outlines themselves tell where a neighbour belongs, even where a party
wall shows in no height.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.fft
import shapely

from .displacement_boundary import Edges, Pieces

# m, cells that overlaps are computed on: a whole fraction of the coarse lattice; they hold shares, not 0 or 1.
MASK_CELL = 0.25
PARALLEL = np.sin(np.radians(2.0))  # edges of a shared wall differ less than this in direction
SHORTEST_WALL = 0.8  # m
EQUAL = 0.03  # m: edges whose lengths differ less are one wall, drawn for both; others may be strangers
PAIRS_AT_ONCE = 256


@dataclass(frozen=True)
class SharedWalls:
    """Edges that two outlines i and j may share: antiparallel and equally long.

    Edges that only partly face each other are left out: houses with a gap between them have those as well.

    Attributes
    ----------
    pair : (m,) number of the pair, sorted.
    length : (m,) m.
    meeting : (m, 2) m, the relative shift (shift of j less shift of i) at which both ends fall together.
    """

    pair: np.ndarray
    length: np.ndarray
    meeting: np.ndarray


def neighbours(polygons: np.ndarray, reach: float) -> np.ndarray:
    """Pairs (m, 2) of outlines that lie within `reach` m of each other, first < second, sorted."""
    tree = shapely.STRtree(polygons)
    first, second = tree.query(polygons, predicate="dwithin", distance=reach)
    pairs = np.column_stack((first, second))[first < second]
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def walls_between(edges: Edges, pairs: np.ndarray, reach: float) -> SharedWalls:
    """Edges of each pair (p, 2) that may be one wall, where a relative shift of up to `reach` m joins them."""
    vector = edges.end - edges.start
    length = np.hypot(*vector.T)
    long = length > SHORTEST_WALL
    owner, start, end, vector, length = (a[long] for a in (edges.owner, edges.start, edges.end, vector, length))
    count = np.bincount(owner, minlength=int(pairs.max()) + 1 if len(pairs) else 0)
    first = np.cumsum(count) - count
    combinations = count[pairs[:, 0]] * count[pairs[:, 1]]
    pair = np.repeat(np.arange(len(pairs)), combinations)
    number = np.arange(len(pair)) - np.repeat(np.cumsum(combinations) - combinations, combinations)
    i, j = pairs[pair].T
    a, b = first[i] + number // count[j], first[j] + number % count[j]
    equal = np.abs(length[a] - length[b]) < EQUAL
    pair, a, b = pair[equal], a[equal], b[equal]
    unit = vector / length[:, None]
    opposite = ((np.einsum("ij,ij->i", unit[a], unit[b]) < 0)
                & (np.abs(unit[a, 0] * unit[b, 1] - unit[a, 1] * unit[b, 0]) < PARALLEL))
    pair, a, b = pair[opposite], a[opposite], b[opposite]
    meeting = (start[a] + end[a] - start[b] - end[b]) / 2
    near = np.hypot(*meeting.T) <= reach
    return SharedWalls(pair[near], length[a][near], meeting[near])


def meeting_length(walls: SharedWalls, shifts: np.ndarray, width: float) -> np.ndarray:
    """Metres of each wall (m,) that meet at its relative shifts (m, k, 2): (m, k).

    Full length at an exact meeting, falling to none at `width` m.
    """
    away = np.sum((shifts - walls.meeting[:, None]) ** 2, axis=2)
    return walls.length[:, None] * np.maximum(1 - away / width**2, 0)


def meeting_tables(walls: SharedWalls, pairs: int, shifts: np.ndarray, width: float) -> np.ndarray:
    """`meeting_length` added up for each pair: (pairs, k); shifts (k, 2) for all, or (pairs, k, 2)."""
    table = np.zeros((pairs, shifts.shape[-2]))
    for begin in range(0, len(walls.pair), 4096):
        part = SharedWalls(*(getattr(walls, name)[begin:begin + 4096] for name in SharedWalls.__dataclass_fields__))
        moves = shifts[part.pair] if shifts.ndim == 3 else np.broadcast_to(shifts, (len(part.pair), *shifts.shape))
        first = np.flatnonzero(np.r_[True, part.pair[1:] != part.pair[:-1]])
        table[part.pair[first]] += np.add.reduceat(meeting_length(part, moves, width), first, axis=0)
    return table


def overlap_tables(polygons: np.ndarray, pieces: Pieces, pairs: np.ndarray, reach: float) -> np.ndarray:
    """Area (m2) that two outlines share at relative shifts (shift of j - shift of i) on a lattice.

    Returns (p, 2 q + 1, 2 q + 1) float32: [p, q + v, q + u] for the shift (u, v) * MASK_CELL, q = reach / MASK_CELL
    rounded up. Correlation of the two masks by FFT, on the windows that can meet only.
    """
    q = int(np.ceil(reach / MASK_CELL))
    tables = np.zeros((len(pairs), 2 * q + 1, 2 * q + 1), np.float32)
    if not len(pairs):
        return tables
    box = shapely.bounds(polygons)
    a, b = box[pairs[:, 0]], box[pairs[:, 1]]
    low = np.maximum(np.minimum(a[:, :2], b[:, :2]), np.maximum(a[:, :2], b[:, :2]) - reach)
    high = np.minimum(np.maximum(a[:, 2:], b[:, 2:]), np.minimum(a[:, 2:], b[:, 2:]) + reach)
    size = np.ceil((high - low).max(axis=1) / MASK_CELL).astype(int) + 1
    side = np.array([scipy.fft.next_fast_len(int(16 * np.ceil((s + q) / 16)), real=True) for s in size])
    count = np.bincount(pieces.owner, minlength=len(polygons))
    first = np.cumsum(count) - count
    for n in np.unique(side):
        of_size = np.flatnonzero(side == n)
        at_once = max(1, PAIRS_AT_ONCE * 64**2 // n**2)
        for begin in range(0, len(of_size), at_once):
            use = of_size[begin:begin + at_once]
            mask_i = _masks(pieces, first, count, pairs[use, 0], low[use], int(n))
            mask_j = _masks(pieces, first, count, pairs[use, 1], low[use], int(n))
            product = scipy.fft.rfft2(mask_i) * np.conj(scipy.fft.rfft2(mask_j))
            table = scipy.fft.irfft2(product, (n, n)) * np.float32(MASK_CELL**2)
            index = np.arange(-q, q + 1)
            # Rounded, so that the number of transforms done at once cannot show in the last digits.
            tables[use] = np.maximum(np.round(table[:, index[:, None], index[None, :]], 3), 0)
    return tables


def _masks(pieces: Pieces, first: np.ndarray, count: np.ndarray, outline: np.ndarray, corner: np.ndarray,
           n: int) -> np.ndarray:
    """Share of every cell that an outline covers, (k, n, n) float32; row 0, column 0 at the window's low corner."""
    number = count[outline]
    window = np.repeat(np.arange(len(outline)), number)
    piece = np.arange(len(window)) + np.repeat(first[outline] - (np.cumsum(number) - number), number)
    column = np.maximum((pieces.x[piece] - corner[window, 0]) / MASK_CELL, 0)
    row = np.floor((pieces.y[piece] - corner[window, 1]) / MASK_CELL).astype(int)
    use = (row >= 0) & (row < n) & (column < n - 1)
    window, column, row = window[use], column[use], row[use]
    area = -pieces.dy[piece][use] / MASK_CELL
    cell = column.astype(int)
    flat = (window * n + row) * n + cell
    part = column - cell
    total = len(outline) * n * n
    # A boundary piece covers, or uncovers, all to its right: its share of its own cell, then whole cells.
    steps = np.bincount(flat, area * (1 - part), total) + np.bincount(flat + 1, area * part, total)
    return np.cumsum(steps.reshape(-1, n, n), axis=2).astype(np.float32)
