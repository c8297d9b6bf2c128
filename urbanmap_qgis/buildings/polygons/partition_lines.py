"""Borders of a label raster, main axes and walls of an outline: what lines that divide a plan follow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.polygon import orient

from ...geometry.polygon_rings import polygon_rings
from .regularisation import main_directions


@dataclass(frozen=True)
class LabelBoundaries:
    """Where cells of different roofs meet: middle points (n, 2) in metres, and both roofs (n,)."""

    xy: np.ndarray
    left: np.ndarray
    right: np.ndarray


def label_boundaries(labels: np.ndarray, x: np.ndarray, y: np.ndarray) -> LabelBoundaries:
    """LabelBoundaries of a label raster; cells of -1 lie outside and make none. x (columns,), y (rows,): centres."""
    row, column = np.nonzero((labels[:, 1:] != labels[:, :-1]) & (labels[:, 1:] >= 0) & (labels[:, :-1] >= 0))
    down, across = np.nonzero((labels[1:] != labels[:-1]) & (labels[1:] >= 0) & (labels[:-1] >= 0))
    xy = np.concatenate([np.column_stack([0.5 * (x[column] + x[column + 1]), y[row]]),
                         np.column_stack([x[across], 0.5 * (y[down] + y[down + 1])])])
    return LabelBoundaries(xy, np.concatenate([labels[row, column], labels[down, across]]),
                  np.concatenate([labels[row, column + 1], labels[down + 1, across]]))


def main_axes(outline: shapely.Geometry) -> np.ndarray:
    """The first main direction of an outline and the one across it, unit vectors as rows (2, 2)."""
    angle = np.radians(main_directions(edge_rows(outline)[:, 2:])[0])
    return np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])


def edge_rows(outline: shapely.Geometry) -> np.ndarray:
    """Edges as rows (x, y, dx, dy)."""
    xy, ring = shapely.get_coordinates(polygon_rings(shapely.get_parts(outline))[0], return_index=True)
    same = ring[1:] == ring[:-1]
    return np.column_stack([xy[:-1], np.diff(xy, axis=0)])[same]


def inward_walls(outline: shapely.Geometry, min_length: float) -> list[tuple[float, float, float]]:
    """Lines of the walls of at least `min_length` that end at an inward corner, the longest first."""
    rings = shapely.get_rings([orient(part) for part in shapely.get_parts(outline)])
    found = []
    for ring in rings:
        xy = shapely.get_coordinates(ring)[:-1]
        edge = np.roll(xy, -1, axis=0) - xy
        length = np.hypot(edge[:, 0], edge[:, 1])
        before = np.roll(edge, 1, axis=0)
        bend = before[:, 0] * edge[:, 1] - before[:, 1] * edge[:, 0]
        inward = bend < -np.sin(np.radians(30.0)) * length * np.roll(length, 1)
        for i in np.flatnonzero((inward | np.roll(inward, -1)) & (length >= min_length)):
            normal = np.array([-edge[i, 1], edge[i, 0]]) / length[i]
            found.append((float(length[i]), (*normal, float(normal @ xy[i]))))
    return [line for _, line in sorted(found, reverse=True)]
