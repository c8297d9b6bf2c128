"""Lines where two planes meet with a step in height: along the walls, the eaves and the ridges of the building."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...execution import checkpoint
from ...geometry.tolerances import LEAST_SQUARE
from ..polygons.partition_lines import LabelBoundaries
from ..polygons.regularisation import main_directions

WINDOW = 1.3
"""Cracks within this many cells of a line across belong to it."""

GAP = 3.0
"""Cells without a crack that interrupt a line."""

FREE_DIRECTIONS = np.arange(0.0, 180.0, 15.0)
"""Degrees, tried besides the building's own directions."""

SAME_DIRECTION = np.sin(np.radians(3.0))
MOST_LINES_A_PAIR = 6


def building_directions(edges: np.ndarray, planes: np.ndarray) -> np.ndarray:
    """Unit normals (m, 2) of the outline's main directions and of the eaves of sloped planes, both ways.

    Parameters
    ----------
    edges : (e, 2) vectors of the outline's edges, m.
    planes : (k, 3).
    """
    angle = np.radians(main_directions(edges))
    level = np.column_stack([np.cos(angle), np.sin(angle)])
    sloped = planes[np.hypot(planes[:, 0], planes[:, 1]) > 0.15, :2]
    sloped = sloped / np.maximum(np.hypot(sloped[:, 0], sloped[:, 1]), LEAST_SQUARE)[:, None]
    distinct: list[np.ndarray] = []
    for direction in np.concatenate([level, sloped]):
        for turned in (direction, np.array([-direction[1], direction[0]])):
            if all(abs(turned[0] * other[1] - turned[1] * other[0]) > SAME_DIRECTION for other in distinct):
                distinct.append(turned)
    return np.array(distinct)


def step_lines(cracks: LabelBoundaries, normals: np.ndarray, cell: float, least_length: float, points: np.ndarray,
               label: np.ndarray) -> list[tuple]:
    """Lines (nx, ny, offset) with their first and last place along (-ny, nx) and their two planes, the longest first.

    Parameters
    ----------
    cracks : borders of planes that no intersection explains.
    normals : the building's own, (m, 2).
    points, label : (n, 2) and (n,), which place each line where it parts the points of its two planes best.
    """
    angle = np.radians(FREE_DIRECTIONS)
    free = np.column_stack([np.cos(angle), np.sin(angle)])
    tried = np.concatenate([normals, free])
    count = int(max(cracks.left.max(initial=0), cracks.right.max(initial=0), label.max(initial=0))) + 1
    order = np.argsort(label, kind="stable")
    own_points = np.split(order, np.cumsum(np.bincount(label + 1, minlength=count + 1))[:-1])[1:]
    found = []
    for one, two, members in cracks_by_pair(cracks, count):
        checkpoint()
        xy = cracks.xy[members]
        either = np.sort(np.concatenate([own_points[one], own_points[two]]))
        near = _in_box(points[either], xy, 2.0 * cell + 0.3)
        nearby, upper = points[either[near]], label[either[near]] == two
        for _ in range(MOST_LINES_A_PAIR):
            line, members, length = _longest(xy, tried, cell)
            if length < least_length:
                break
            along = xy[members] @ np.array([-line[1], line[0]])
            line = _placed(line, along, nearby, upper, 1.5 * cell)
            found.append((length, line, (float(along.min()), float(along.max())), (one, two)))
            xy = xy[~members]
    found.sort(key=lambda item: (-item[0], item[1]))
    return [(line, ends, pair) for _, line, ends, pair in found]


def cracks_by_pair(cracks: LabelBoundaries, count: int) -> Iterator[tuple[int, int, np.ndarray]]:
    """Every two planes (of `count`) that have cracks between them, the lower first, and the rows of these."""
    low, high = np.minimum(cracks.left, cracks.right), np.maximum(cracks.left, cracks.right)
    order = np.argsort(low * count + high, kind="stable")
    code = (low * count + high)[order]
    for members in np.split(order, np.flatnonzero(np.diff(code)) + 1):
        if len(members):
            yield int(low[members[0]]), int(high[members[0]]), members


def _in_box(points: np.ndarray, xy: np.ndarray, margin: float) -> np.ndarray:
    """Mask of the points (n, 2) in the box round places (m, 2), drawn larger by `margin` (m)."""
    return ((points >= xy.min(axis=0) - margin) & (points <= xy.max(axis=0) + margin)).all(axis=1)


def _longest(xy: np.ndarray, normals: np.ndarray, cell: float):
    """The line with the longest run of cracks, which of them belong to it, and its length; of length 0 if none."""
    none = (1.0, 0.0, 0.0), np.zeros(len(xy), bool), 0.0
    if len(xy) < 2:
        return none
    offset = normals @ xy.T
    ordered = np.sort(offset, axis=1)
    width = WINDOW * cell
    # One search for all rows: each is moved so far that no row reaches into the next.
    separation = np.arange(len(ordered))[:, None] * (np.ptp(ordered) + 2.0 * width)
    flat = (ordered + separation).ravel()
    last = np.searchsorted(flat, flat + width, side="right").reshape(ordered.shape)
    votes = last - np.arange(ordered.size).reshape(ordered.shape)
    row, place = np.unravel_index(np.argmax(votes), votes.shape)
    normal = normals[row]
    members = np.flatnonzero((offset[row] >= ordered[row, place]) & (offset[row] <= ordered[row, place] + width))
    along = xy[members] @ np.array([-normal[1], normal[0]])
    order = np.argsort(along, kind="stable")
    run = np.concatenate([[0], np.cumsum(np.diff(along[order]) > GAP * cell)])
    longest = np.bincount(run).argmax()
    members = members[order[run == longest]]
    chosen = np.zeros(len(xy), bool)
    chosen[members] = True
    along = along[order[run == longest]]
    line = (float(normal[0]), float(normal[1]), float(np.median(xy[members] @ normal)))
    return line, chosen, float(along.max() - along.min()) + cell


def _placed(line: tuple[float, float, float], along: np.ndarray, points: np.ndarray, upper: np.ndarray,
            reach: float) -> tuple[float, float, float]:
    """The line moved by at most `reach` to where most points lie on the side of their plane."""
    normal = np.array(line[:2])
    across = points @ normal - line[2]
    place = points @ np.array([-normal[1], normal[0]])
    near = (np.abs(across) < reach) & (place > along.min() - 0.3) & (place < along.max() + 0.3)
    if np.count_nonzero(near) < 4:
        return line
    order = np.argsort(across[near], kind="stable")
    side = np.where(upper[near][order], 1, -1)
    if side[:len(side) // 2].sum() < side[len(side) // 2:].sum():
        side = -side
    gain = np.concatenate([[0], np.cumsum(side)])
    best = np.flatnonzero(gain == gain.max())
    bounds = np.concatenate([[-reach], across[near][order], [reach]])
    return line[0], line[1], line[2] + float(0.5 * np.mean(bounds[best] + bounds[best + 1]))
