"""Road paint on the ground image: exact shares of the cells, worn as the scene says."""

from __future__ import annotations

import cv2
import numpy as np
import shapely
from rasterio.features import rasterize
from rasterio.transform import Affine

from ..scene.model import AERIAL, COLOUR, Material
from ..scene.paint import wear_field
from ..scene.world import Scene

FINE = 3
"""The share of a cell that a marking covers is counted on so many times as many points each way."""

SOFT = 0.2
"""Width of the step of the wear field from paint to none: spots have soft edges."""


def paint_markings(colour: np.ndarray, scene: Scene, origin: np.ndarray, west: float, north: float,
                   cell: float) -> None:
    """Paint the markings of the aerial epoch on a strip of the ground image.

    Parameters
    ----------
    colour : (rows, columns, 3) uint8, changed in place.
    origin : of the local places.
    west, north : the strip's corner, local m.
    cell : m.
    """
    markings = scene.markings_at(AERIAL)
    rows, columns = colour.shape[:2]
    x_min, y_max = origin[0] + west, origin[1] + north
    strip = shapely.box(x_min, y_max - rows * cell, x_min + columns * cell, y_max)
    near = [k for k, marking in enumerate(markings) if marking.plan.intersects(strip)]
    if not near:
        return
    left, _, right, _ = shapely.total_bounds([markings[k].plan for k in near])
    first = min(max(int((left - x_min) / cell) - 1, 0), columns)
    last = min(max(int((right - x_min) / cell) + 2, first + 1), columns)
    fine = cell / FINE
    number = rasterize([(markings[k].plan, k + 1) for k in near], out_shape=(rows * FINE, (last - first) * FINE),
                       transform=Affine(fine, 0.0, x_min + first * cell, 0.0, -fine, y_max), dtype="uint16")
    covered = cv2.resize((number > 0).astype(np.uint8) * np.uint8(255), (last - first, rows),
                         interpolation=cv2.INTER_AREA)
    row, column = np.nonzero(covered)
    which = cv2.dilate(number, np.ones((3, 3), np.uint8))[row * FINE + 1, column * FINE + 1] - 1
    wear = np.array([marking.wear for marking in markings])[which]
    holds = wear_field(x_min + (first + column + 0.5) * cell, y_max - (row + 0.5) * cell)
    left_over = np.where(wear > 0, np.clip((holds - wear) / SOFT + 0.5, 0.0, 1.0), 1.0)
    share = (covered[row, column] / 255.0 * left_over)[:, None]
    tint = np.array([COLOUR[Material.PAINT_YELLOW if marking.colour == "yellow" else Material.PAINT_WHITE]
                     for marking in markings], float)[which] * (1.0 - 0.15 * wear)[:, None]
    under = colour[row, first + column]
    tint *= 0.85 + 0.15 * np.minimum(under / 90.0, 1.3)
    colour[row, first + column] = np.rint(under + share * (tint - under))
