"""A conventional orthophoto: frames laid on the bare ground, each place from the frame whose nadir is nearest."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from ..scene.world import Scene
from .camera import Camera, Exposure, project
from .render import RenderedFrame

CELL = 0.12
"""Of the orthophoto, m."""

ROWS_AT_ONCE = 512


class Orthophoto:
    """The orthophoto while frame after frame is laid on it; buildings lean as in the frames.

    Attributes
    ----------
    corner : x, y of its north-west corner.
    image : (rows, columns, 3) uint8.
    mask : (rows, columns) uint8, as those of the frames.
    """

    def __init__(self, scene: Scene, camera: Camera, exposures: Sequence[Exposure], corner: tuple[float, float],
                 shape: tuple[int, int]):
        self.corner = corner
        self.image, self.mask = np.zeros((*shape, 3), np.uint8), np.zeros(shape, np.uint8)
        self._scene, self._camera, self._exposures = scene, camera, exposures

    def add(self, number: int, frame: RenderedFrame) -> None:
        """Lay frame `number` where its nadir is the nearest of all exposures'."""
        for top in range(0, len(self.mask), ROWS_AT_ONCE):
            rows = slice(top, min(top + ROWS_AT_ONCE, len(self.mask)))
            x, y = np.meshgrid(self.corner[0] + (np.arange(self.mask.shape[1]) + 0.5) * CELL,
                               self.corner[1] - (np.arange(rows.start, rows.stop) + 0.5) * CELL)
            nearest = np.argmin([(x - e.x) ** 2 + (y - e.y) ** 2 for e in self._exposures], axis=0) == number
            if not nearest.any():
                continue
            points = np.column_stack([x[nearest], y[nearest], self._scene.ground_height(x[nearest], y[nearest])])
            pixels = np.full((*nearest.shape, 2), -1.0, np.float32)
            pixels[nearest] = project(self._camera, self._exposures[number], points)
            for source, target, how in ((frame.image, self.image, cv2.INTER_CUBIC),
                                        (frame.mask, self.mask, cv2.INTER_NEAREST)):
                target[rows][nearest] = cv2.remap(source, pixels[..., 0], pixels[..., 1], how)[nearest]
