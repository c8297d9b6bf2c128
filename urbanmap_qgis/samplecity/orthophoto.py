"""A conventional orthophoto: frames laid on the bare ground, each place from the frame whose nadir is nearest."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from ..progress import Progress
from .aerial_render import Frame
from .camera import Camera, Exposure, project
from .scene import Scene

CELL = 0.12
"""Of the orthophoto, m."""

ROWS_AT_ONCE = 512


def make_orthophoto(scene: Scene, camera: Camera, exposures: Sequence[Exposure], frames: Sequence[Frame],
                    corner: tuple[float, float], shape: tuple[int, int],
                    progress: Progress) -> tuple[np.ndarray, np.ndarray]:
    """Image (rows, columns, 3) and mask (rows, columns) of the orthophoto; buildings lean as in the frames.

    Parameters
    ----------
    corner : x, y of its north-west corner.  shape : rows, columns of `CELL`.
    """
    image, mask = np.zeros((*shape, 3), np.uint8), np.zeros(shape, np.uint8)
    x = corner[0] + (np.arange(shape[1]) + 0.5) * CELL
    for top in range(0, shape[0], ROWS_AT_ONCE):
        progress.step(top / shape[0])
        rows = slice(top, min(top + ROWS_AT_ONCE, shape[0]))
        ground_x, ground_y = np.meshgrid(x, corner[1] - (np.arange(rows.start, rows.stop) + 0.5) * CELL)
        points = np.stack([ground_x, ground_y, scene.ground_height(ground_x, ground_y)], axis=-1)
        nearest = np.argmin([(ground_x - e.x) ** 2 + (ground_y - e.y) ** 2 for e in exposures], axis=0)
        for number in np.unique(nearest):
            here = nearest == number
            pixels = np.full((*here.shape, 2), -1.0, np.float32)
            pixels[here] = project(camera, exposures[number], points[here])
            for source, target, how in ((frames[number].image, image, cv2.INTER_CUBIC),
                                        (frames[number].mask, mask, cv2.INTER_NEAREST)):
                target[rows][here] = cv2.remap(source, pixels[..., 0], pixels[..., 1], how)[here]
    return image, mask
