"""Bounds of an earlier map that are given as lines: those that were cut where its lanes were are one line again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from .map_records import MapLine

JOINT = 0.05
"""Bounds whose ends lie so near to each other share a node, m."""

ONWARD = np.cos(np.radians(30.0))
"""The next bound of a line turns no more than so at the node."""


def rejoined(lines: Sequence[MapLine]) -> list[MapLine]:
    """Lines with bounds of an earlier map in one row made one line of a class and colour, or lines of one chain.

    The places of their ends are its `joints`. Others than such bounds are as they were.
    """
    named = [line for line in lines if line.identifier >= 0 and line.kind != "virtual"]
    others = [line for line in lines if line.identifier < 0]
    chain = max([line.chain for line in lines], default=-1) + 1
    found = []
    for row in _rows(named):
        found += [replace(line, chain=chain) for line in _of_one_class(row)]
        chain += 1
    return found + others


def _rows(named: Sequence[MapLine]) -> list[list[MapLine]]:
    """Bounds that go on from each other, in their order and all in one direction."""
    tips = np.array([line.points[[0, -1], :2] for line in named]).reshape(-1, 2, 2)
    left = np.ones(len(named), bool)
    rows = []
    for first, line in enumerate(named):
        if not left[first]:
            continue
        left[first] = False
        row = [line]
        while (grown := _grown(row, named, np.flatnonzero(left & _beside(row, tips)))) is not None:
            row, used = grown
            left[used] = False
        rows.append(row)
    return rows


def _beside(row: Sequence[MapLine], tips: np.ndarray) -> np.ndarray:
    """Which bounds, given by their ends (n, 2, 2), have one where the row begins or ends: mask (n,)."""
    ends = np.array([row[0].points[0, :2], row[-1].points[-1, :2]])
    return (np.hypot(*np.moveaxis(tips[:, :, None] - ends, -1, 0)) <= JOINT).any(axis=(1, 2))


def _grown(row: list[MapLine], named: Sequence[MapLine], numbers: np.ndarray) -> tuple[list[MapLine], int] | None:
    """A row with the one of the numbered bounds that goes on from one of its ends, and its number, or None."""
    for number in numbers:
        line = named[number]
        for one in (line, replace(line, points=line.points[::-1], sigmas=line.sigmas[::-1])):
            if _goes_on(row[-1], one):
                return [*row, one], number
            if _goes_on(one, row[0]):
                return [one, *row], number
    return None


def _goes_on(one: MapLine, other: MapLine) -> bool:
    """Whether a line begins where another ends, in its direction."""
    if np.hypot(*(one.points[-1, :2] - other.points[0, :2])) > JOINT:
        return False
    before, after = one.points[-1, :2] - one.points[-2, :2], other.points[1, :2] - other.points[0, :2]
    return before @ after > ONWARD * np.hypot(*before) * np.hypot(*after)


def _of_one_class(row: Sequence[MapLine]) -> list[MapLine]:
    """Lines of a row, those next to each other of one class, colour and number of lines made one."""
    tips = [tuple(map(tuple, line.points[[0, -1], :2].tolist())) for line in row]
    found = [replace(row[0], joints=tips[0])]
    for line, ends in zip(row[1:], tips[1:]):
        last = found[-1]
        if (last.kind, last.colour, last.double) != (line.kind, line.colour, line.double):
            found.append(replace(line, joints=ends))
            continue
        sigmas = (*last.sigmas, *line.sigmas[1:]) if last.sigmas and line.sigmas else ()
        lengths = [shapely.length(shapely.LineString(one.points[:, :2])) for one in (last, line)]
        longer = last if lengths[0] >= lengths[1] else line
        found[-1] = replace(longer, points=np.vstack([last.points, line.points[1:]]), sigmas=sigmas,
                            joints=(*last.joints, ends[1]))
    return found
