"""An image that keeps, for each pixel, which of the faces drawn is nearest (a z-buffer)."""

from __future__ import annotations

import numpy as np

EMPTY = -1
"""Label of pixels in which nothing was drawn."""


class DepthImage:
    """Nearness and label of what is nearest in each pixel.

    Nearness is any quantity that grows towards the observer and is linear over the image on a flat face:
    1/depth in a perspective, height along parallel rays. Pixel (0, 0) has its centre at 0, 0.

    Attributes
    ----------
    nearness : (rows, columns) float32.
    label : (rows, columns) int32, `EMPTY` where nothing was drawn.
    """

    def __init__(self, nearness: np.ndarray):
        self.nearness = nearness
        self.label = np.full(nearness.shape, EMPTY, np.int32)

    def copy(self) -> DepthImage:
        """The same image to draw on."""
        other = DepthImage(self.nearness.copy())
        other.label[:] = self.label
        return other

    def draw_polygon(self, corners: np.ndarray, plane: np.ndarray, label: int) -> None:
        """Draw a convex polygon where it is nearer: pixels whose centres lie in it, edges included.

        Parameters
        ----------
        corners : (n, 2) column and row.
        plane : (a, b, c): nearness is a column + b row + c.
        """
        rows, columns = self.nearness.shape
        top = max(int(np.ceil(corners[:, 1].min())), 0)
        bottom = min(int(np.floor(corners[:, 1].max())) + 1, rows)
        if top >= bottom:
            return
        row = np.arange(top, bottom, dtype=float)
        first, last = _spans(corners, row)
        left, right = max(int(np.ceil(first.min())), 0), min(int(np.floor(last.max())) + 1, columns)
        if left >= right:
            return
        column = np.arange(left, right)
        near = ((plane[1] * row + plane[2])[:, None] + plane[0] * column).astype(np.float32)
        inside = (column >= first[:, None]) & (column <= last[:, None])
        self.draw_patch(top, left, near, inside, label)

    def draw_patch(self, top: int, left: int, near: np.ndarray, inside: np.ndarray, label: int) -> None:
        """Draw the pixels `inside` of a patch with nearness `near`, both (h, w), where they are nearer.

        The patch may reach beyond the image.
        """
        above, before = max(-top, 0), max(-left, 0)
        near, inside = near[above:, before:], inside[above:, before:]
        window = (slice(max(top, 0), max(top, 0) + near.shape[0]), slice(max(left, 0), max(left, 0) + near.shape[1]))
        rows, columns = self.nearness[window].shape
        near, inside = near[:rows, :columns], inside[:rows, :columns]
        nearest = inside & (near > self.nearness[window])
        np.copyto(self.nearness[window], near, where=nearest)
        np.copyto(self.label[window], label, where=nearest)


def _spans(corners: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where the rows enter and leave a convex polygon; entry after exit for a row outside it."""
    start, end = corners, np.roll(corners, -1, axis=0)
    low, high = np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1])
    rise = end[:, 1] - start[:, 1]
    crossing = (row[:, None] >= low) & (row[:, None] <= high) & (rise != 0)
    share = (row[:, None] - start[:, 1]) / np.where(rise == 0, 1.0, rise)
    at = start[:, 0] + share * (end[:, 0] - start[:, 0])
    return np.where(crossing, at, np.inf).min(axis=1), np.where(crossing, at, -np.inf).max(axis=1)
