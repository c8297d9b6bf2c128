"""Lines along which a field is zero, finer than its cells (marching squares; Lorensen and Cline 1987 in the plane).

All lines of a field are made at once, as arrays: an image has hundreds of thousands of short ones.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components, depth_first_order

_TOP, _RIGHT, _BOTTOM, _LEFT = range(4)

_SEGMENTS = {
    1: [(_TOP, _LEFT)], 2: [(_RIGHT, _TOP)], 3: [(_RIGHT, _LEFT)], 4: [(_LEFT, _BOTTOM)], 5: [(_TOP, _BOTTOM)],
    6: [(_RIGHT, _TOP), (_LEFT, _BOTTOM)], 7: [(_RIGHT, _BOTTOM)], 8: [(_BOTTOM, _RIGHT)],
    9: [(_TOP, _LEFT), (_BOTTOM, _RIGHT)], 10: [(_BOTTOM, _TOP)], 11: [(_BOTTOM, _LEFT)], 12: [(_LEFT, _RIGHT)],
    13: [(_TOP, _RIGHT)], 14: [(_LEFT, _TOP)]}
"""Sides of a square where lines come in and go out, by which corners are high (1 upper left, 2 upper right, 4 lower
left, 8 lower right). High corners across a square do not touch."""


def zero_lines(field: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Closed lines between what is above zero and what is not.

    Parameters
    ----------
    field : (rows, columns) finite, nowhere zero, below zero all along its edges: all lines are closed then.

    Returns
    -------
    points : (n, 2) row and column, whole numbers at the field's values; the last of a line is its first again.
    counts : (m,) points of each line, at least five. Lines come in the order of their first square, row by row; they
        begin where they leave their last one, and turn the same way round all high ground.

    Raises
    ------
    ValueError : the field is not below zero along its edges.
    """
    high = field > 0
    if high[[0, -1]].any() or high[:, [0, -1]].any():
        raise ValueError("the field must be below zero along its edges")
    entry, leave = _segments(high)
    if not len(entry):
        return np.empty((0, 2)), np.empty(0, np.intp)
    order, counts = _in_lines(entry, leave, 2 * field.size)
    ends = np.cumsum(counts)
    points = _crossings(field, leave[order])
    return np.insert(points, ends, points[ends - counts], axis=0), counts + 1


def _segments(high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sides of squares where each piece of line comes in and goes out, square by square.

    The side to the right of a value has the value's place in the field as number, the one below it that and the
    field's size.
    """
    values = high.view(np.uint8)
    case = values[:-1, :-1] | values[:-1, 1:] << 1 | values[1:, :-1] << 2 | values[1:, 1:] << 3
    row, column = np.nonzero((case != 0) & (case != 15))
    case = case[row, column]
    width, size = high.shape[1], high.size
    side = np.array([0, size + 1, width, size])
    sides = np.full((16, 2, 2), -1)
    for number, pairs in _SEGMENTS.items():
        sides[number, :len(pairs)] = side[np.array(pairs)]
    found = sides[case] + (row * width + column)[:, None, None]
    found = found[sides[case, :, 0] >= 0]
    return found[:, 0], found[:, 1]


def _in_lines(entry: np.ndarray, leave: np.ndarray, sides: int) -> tuple[np.ndarray, np.ndarray]:
    """Pieces in the order in which lines run through them, line after line, and pieces of each line."""
    count = len(entry)
    at = np.empty(sides, np.int32)
    at[entry] = np.arange(count)
    follower = at[leave]
    steps = np.arange(count + 1)
    lines, line = connected_components(csr_matrix((np.ones(count, bool), follower, steps), (count, count)),
                                       connection="weak")
    first, last = np.empty(lines, np.intp), np.empty(lines, np.intp)
    last[line] = np.arange(count)
    first[line[::-1]] = np.arange(count)[::-1]
    turn = np.argsort(first)
    # Each line is cut before its last piece and leads into the next line: one path, walked in one go.
    before = np.empty(count, np.int32)
    before[follower] = np.arange(count)
    begin = last[turn]
    end = before[begin]
    follower[end[:-1]] = begin[1:]
    steps[end[-1] + 1:] -= 1
    path = csr_matrix((np.ones(count - 1, bool), np.delete(follower, end[-1]), steps), (count, count))
    order = depth_first_order(path, begin[0], return_predecessors=False)
    return order, np.bincount(line, minlength=lines)[turn]


def _crossings(field: np.ndarray, side: np.ndarray) -> np.ndarray:
    """Where the field is zero on sides, (n, 2) row and column, linear between the two values."""
    down = side >= field.size
    near = np.where(down, side - field.size, side)
    values = field.ravel()
    low, high = values[near].astype(np.float64), values[near + np.where(down, field.shape[1], 1)].astype(np.float64)
    share = (0.0 - low) / (high - low)
    row, column = np.divmod(near, field.shape[1])
    return np.column_stack([np.where(down, row + share, row), np.where(down, column, column + share)])
