"""The true line work of the markings: centre lines with class, colour and width, dashes joined to one line."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely

from ..scene.markings import DASH, GAP
from ..scene.model import Marking
from ..scene.world import Scene
from .geopackage import Layer

CLASSES = {"centre": "solid", "edge": "solid", "lane": "solid", "stop": "stop line"}
"""Class of the markings that are lines; a lane line no longer than a dash is one dash."""

SAME = 0.05
"""Dashes of one line follow each other at their period, and lie on one line, to so much, m."""


def true_lines(scene: Scene, epoch: str) -> Layer:
    """Centre lines of one epoch at the ground's height.

    Fields: class (solid, dashed, stop line), colour, width (m), period and dash (m, of dashed lines), dashes (begins
    and ends of the paint along the line, m), wear (share of the paint that is gone, mean).
    """
    markings = [marking for marking in scene.markings_at(epoch) if marking.kind in CLASSES and not marking.private]
    axes = [_axis(scene, marking) for marking in markings]
    single = [k for k, (ends, _) in enumerate(axes) if markings[k].kind != "lane" or _length(ends) > DASH + SAME]
    dashes = sorted(set(range(len(axes))) - set(single))
    plans, rows = [], []
    for group in [*([k] for k in single), *_rows([axes[k][0] for k in dashes], dashes)]:
        first, last = axes[group[0]][0][0], axes[group[-1]][0][1]
        x, y = scene.ground.to_world(*np.array([first, last]).T)
        plans.append(shapely.linestrings(np.column_stack([x, y, scene.ground_height(x, y)])))
        rows.append(_row([markings[k] for k in group], [axes[k] for k in group], group[0] in dashes))
    names = ("class", "colour", "width", "period", "dash", "dashes", "wear")
    return Layer(f"lines_{epoch}", plans, dict(zip(names, zip(*rows))) if rows else dict.fromkeys(names, ()))


def _row(markings: Sequence[Marking], axes: Sequence[tuple[np.ndarray, float]], dashed: bool) -> tuple:
    start = axes[0][0][0]
    paint = [np.linalg.norm(ends - start, axis=1) for ends, _ in axes]
    text = ";".join(f"{begin:.2f}-{end:.2f}" for begin, end in paint)
    kind = "dashed" if dashed else CLASSES[markings[0].kind]
    return (kind, markings[0].colour, axes[0][1], DASH + GAP if dashed else float("nan"),
            DASH if dashed else float("nan"), text, float(np.mean([marking.wear for marking in markings])))


def _axis(scene: Scene, marking: Marking) -> tuple[np.ndarray, float]:
    """Ends (2, 2) of a strip's middle line in the streets' frame, the lesser first, and its width, m."""
    corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(marking.plan).exterior)[:4]
    local = np.column_stack(scene.ground.to_local(*corners.T))
    sides = np.linalg.norm(np.roll(local, -1, axis=0) - local, axis=1)
    if sides[0] < sides[1]:
        local, sides = np.roll(local, -1, axis=0), np.roll(sides, -1)
    ends = np.array([local[0] + local[3], local[1] + local[2]]) / 2.0
    return ends[np.argsort(ends @ (1.0, 1.0))], float(sides[1])


def _rows(axes: Sequence[np.ndarray], numbers: Sequence[int]) -> list[list[int]]:
    """Dashes in rows: those on one line, one period after another."""
    def key(k: int) -> tuple:
        along = int(np.argmax(np.abs(axes[k][1] - axes[k][0])))
        return along, round(float(axes[k][0][1 - along]), 2), float(axes[k][0][along])

    rows: list[list[int]] = []
    before: tuple = ()
    for k in sorted(range(len(axes)), key=key):
        line_key = key(k)
        follows = before and line_key[0] == before[0] and abs(line_key[1] - before[1]) < SAME
        if follows and abs(line_key[2] - before[2] - DASH - GAP) < SAME:
            rows[-1].append(numbers[k])
        else:
            rows.append([numbers[k]])
        before = line_key
    return rows


def _length(ends: np.ndarray) -> float:
    return float(np.linalg.norm(ends[1] - ends[0]))
