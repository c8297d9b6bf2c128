"""Pictures of overlays: points and edges drawn on images, before and after beside each other."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from ...geometry.tolerances import LEAST_DIVISOR
from ..views.views import Source
from .overlay_layers import DrawnEdges, DrawnPoints

WINDOW = (1200, 900)  # Most columns and rows of a picture on a page.
EDGE_COLOUR = (255, 230, 0)
OTHER_CLASS = (200, 200, 255)
ONE_COLOUR = (0, 210, 255)
OPAQUE = 0.7  # of points: the image shows through

CLASS_COLOURS = {1: (170, 170, 170), 2: (166, 116, 54), 3: (120, 200, 80), 4: (60, 170, 60), 5: (20, 120, 40),
                 6: (226, 88, 62), 7: (255, 0, 255), 9: (60, 120, 230), 11: (150, 150, 160), 17: (240, 220, 90)}
"""Red, green, blue of ASPRS classes."""

_JPEG = [cv2.IMWRITE_JPEG_QUALITY, 88]


@dataclass(frozen=True, eq=False)
class Overlay:
    """What is drawn over an image in one state of the data."""

    points: DrawnPoints
    edges: DrawnEdges


@dataclass(frozen=True)
class PointColours:
    """How points are coloured: `kind` "height", "intensity", "class" or "one"; `low` and `high` end the ramp."""

    kind: str
    low: float = 0.0
    high: float = 1.0

    def of(self, values: np.ndarray) -> np.ndarray:
        """Red, green, blue (n, 3) uint8 of values (n,)."""
        if self.kind == "one" or not len(values):
            return np.broadcast_to(np.array(ONE_COLOUR, np.uint8), (len(values), 3))
        if self.kind == "class":
            table = np.full((256, 3), OTHER_CLASS, np.uint8)
            table[list(CLASS_COLOURS)] = list(CLASS_COLOURS.values())
            return table[np.clip(values, 0, 255).astype(int)]
        share = np.clip((values - self.low) / max(self.high - self.low, LEAST_DIVISOR), 0.0, 1.0)
        ramp = cv2.COLORMAP_TURBO if self.kind == "height" else cv2.COLORMAP_BONE
        return cv2.applyColorMap((255 * share).astype(np.uint8).reshape(-1, 1), ramp).reshape(-1, 3)[:, ::-1]


def draw(pixels: np.ndarray, overlay: Overlay, colours: PointColours, left: int = 0, top: int = 0) -> np.ndarray:
    """A window (rows, columns, 3) of an image with the overlay drawn on it; `left`, `top` are its place there."""
    picture = np.ascontiguousarray(pixels).copy()
    rows, columns = picture.shape[:2]
    column, row = overlay.points.column - left, overlay.points.row - top
    inside = (column >= 0) & (column < columns - 1) & (row >= 0) & (row < rows - 1)
    colour = OPAQUE * colours.of(overlay.points.value[inside])
    for across, down in ((0, 0), (1, 0), (0, 1), (1, 1)):
        at = row[inside] + down, column[inside] + across
        picture[at] = colour + (1.0 - OPAQUE) * picture[at]
    _draw_lines(picture, overlay.edges, left, top)
    return picture


def _draw_lines(image: np.ndarray, edges: DrawnEdges, left: int, top: int) -> None:
    """Draw edges, smooth, into an image in place."""
    rows, columns = image.shape[:2]
    start, end = edges.start - (left, top), edges.end - (left, top)
    low, high = np.minimum(start, end), np.maximum(start, end)
    inside = (high > -2).all(axis=1) & (low < (columns + 2, rows + 2)).all(axis=1)
    for points in np.rint(8 * np.stack([start[inside], end[inside]], axis=1)).astype(np.int32):
        cv2.line(image, points[0].tolist(), points[1].tolist(), (0, 0, 0), 4, cv2.LINE_AA, 3)
    for points in np.rint(8 * np.stack([start[inside], end[inside]], axis=1)).astype(np.int32):
        cv2.line(image, points[0].tolist(), points[1].tolist(), EDGE_COLOUR, 2, cv2.LINE_AA, 3)


def jpeg(pixels: np.ndarray) -> bytes:
    """An image (rows, columns, 3) as JPEG."""
    return cv2.imencode(".jpg", pixels[:, :, ::-1], _JPEG)[1].tobytes()


def beside(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Two images of one size beside each other, a white line between; wide ones below each other."""
    across = first.shape[1] <= 2 * first.shape[0]
    gap = np.full((first.shape[0], 8, 3) if across else (8, first.shape[1], 3), 255, np.uint8)
    return np.concatenate([first, gap, second], axis=1 if across else 0)


def best_windows(source: Source, overlay: Overlay, count: int) -> list[tuple[int, int, int, int]]:
    """Windows (left, top, right, bottom) in which most is drawn, the fullest first, none over another."""
    columns, rows = source.size()
    width, height = min(WINDOW[0], columns), min(WINDOW[1], rows)
    across, down = max(-(-columns // width), 1), max(-(-rows // height), 1)
    amount = np.zeros((down, across))
    middles = (overlay.edges.start + overlay.edges.end) / 2
    lengths = np.linalg.norm(overlay.edges.end - overlay.edges.start, axis=1)
    points = np.column_stack([overlay.points.column, overlay.points.row])
    for place, weight in ((middles, lengths), (points, np.full(len(points), 0.01))):
        if len(place):
            cell = np.floor(place / (width, height)).astype(int).clip(0, (across - 1, down - 1))
            np.add.at(amount, (cell[:, 1], cell[:, 0]), weight)
    found = []
    for number in np.argsort(-amount.ravel(), kind="stable")[:count]:
        row, column = np.unravel_index(number, amount.shape)
        if amount[row, column] > 0:
            left, top = min(column * width, columns - width), min(row * height, rows - height)
            found.append((int(left), int(top), int(left + width), int(top + height)))
    return found
