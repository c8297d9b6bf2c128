"""Places of a building that no plane explains, as level patches: low ones that its planes would be drawn on over, and
high ones, such as dormers, that stand on its planes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
import shapely
from scipy import ndimage

from .label_raster import LabelRaster

LEAST_AREA = 0.25  # Area (m2) of a patch.
REACH = 1.0  # Distance in plan (m) to which a low place goes on about what stands too high.
CLEARANCE = 0.4  # Height (m) over the highest point near from which a roof is too high.
BELOW = 0.5  # Points so far (m) under the lowest roof point are no roof.
NEAR = 0.5  # A point within this height (m) of a patch belongs to it.
# Height (m) over the roof, area (m2), width (m) and points from which a place is a high patch, and the scatter of
# its points' heights (m) up to which: a tree's is greater.
HIGH = 0.4
# Rise over run from which a roof has such: on level ones stand machines.
HIGH_SLOPE = 0.1
HIGH_AREA = 1.0
HIGH_WIDTH = 0.5
HIGH_POINTS = 4
HIGH_SCATTER = 0.2
LOWER_SHARE = 0.3  # Share of a high patch's points, the lowest, that its height leaves out: of edges.


@dataclass(frozen=True)
class LowPatches:
    """What a plan is divided by, with patches added.

    Attributes
    ----------
    raster : their cells have their numbers.
    planes : (k, 3), the patches last.
    label : (n,) plane of each point, -1 for none.
    taken_from : (p,) the plane that stood over each patch.
    """

    raster: LabelRaster
    planes: np.ndarray
    label: np.ndarray
    taken_from: np.ndarray


@dataclass(frozen=True)
class _Cells:
    """The points (n,) on a raster: row and column of each, which lie on it, and the highest of each cell, -inf for
    none."""

    row: np.ndarray
    column: np.ndarray
    on: np.ndarray
    top: np.ndarray

    @classmethod
    def of(cls, raster: LabelRaster, points: np.ndarray) -> _Cells:
        column = np.searchsorted(raster.x + raster.cell / 2, points[:, 0])
        row = np.searchsorted(-raster.y + raster.cell / 2, -points[:, 1])
        on = (column < len(raster.x)) & (row < len(raster.y))
        top = np.full(raster.label.shape, -np.inf)
        np.maximum.at(top, (row[on], column[on]), points[on, 2])
        return cls(row, column, on, top)

    def members(self, mask: np.ndarray) -> np.ndarray:
        """Mask (n,) of the points in the cells of a mask."""
        inside = np.zeros(len(self.on), bool)
        inside[self.on] = mask[self.row[self.on], self.column[self.on]]
        return inside


def low_patches(raster: LabelRaster, planes: np.ndarray, points: np.ndarray, label: np.ndarray,
                polygons: np.ndarray, chosen: np.ndarray, count: int) -> LowPatches | None:
    """Level patches where a divided plan stands higher than any point near it; None where there are none.

    Parameters
    ----------
    points, label : (n, 3) m, and (n,) plane of each, -1 for none.
    polygons, chosen : (f,) the division, and the plane of each polygon.
    count : number of the planes that are no patches; no patch is made on another.
    """
    shown = _shown(raster, polygons, chosen)
    x, y = np.meshgrid(raster.x, raster.y)
    a, b, c = np.moveaxis(planes[shown], -1, 0)
    height = a * x + b * y + c
    high = raster.inside & np.isfinite(raster.ceiling) & (height > raster.ceiling + CLEARANCE)
    if not high.any() or not (label >= 0).any():
        return None
    cells = _Cells.of(raster, points)
    floor = points[label >= 0, 2].min() - BELOW
    labels, of_point, level, taken_from = raster.label.copy(), label.copy(), [], []
    for place, patch in _places(raster, high, height, cells.top, count):
        if place < floor:
            continue
        number = len(planes) + len(level)
        labels[patch] = number
        of_point[cells.members(patch) & (np.abs(points[:, 2] - place) < NEAR)] = number
        level.append((0.0, 0.0, place))
        taken_from.append(int(np.bincount(shown[patch]).argmax()))
    if not level:
        return None
    return LowPatches(replace(raster, label=labels), np.concatenate([planes, np.array(level)]), of_point,
                      np.array(taken_from))


def high_patches(raster: LabelRaster, planes: np.ndarray, points: np.ndarray, label: np.ndarray,
                 polygons: np.ndarray, chosen: np.ndarray, count: int) -> LowPatches | None:
    """Level patches where points of one height stand on a divided plan's slopes; None where there are none.

    Parameters as for `low_patches`.
    """
    if not (np.hypot(*planes[:, :2].T) > HIGH_SLOPE).any():
        return None
    shown = _shown(raster, polygons, chosen)
    x, y = np.meshgrid(raster.x, raster.y)
    a, b, c = np.moveaxis(planes[shown], -1, 0)
    cells = _Cells.of(raster, points)
    high = (_filled(cells.top) > a * x + b * y + c + HIGH) & (np.hypot(a, b) > HIGH_SLOPE)
    part = _standing(raster, high, count)
    labels, of_point, level, taken_from = raster.label.copy(), label.copy(), [], []
    for number in range(1, int(part.max(initial=0)) + 1):
        patch = part == number
        members = cells.members(patch)
        place = _level_of(points[members, 2]) if np.count_nonzero(patch) * raster.cell**2 >= HIGH_AREA else None
        if place is None:
            continue
        below = int(np.bincount(shown[patch]).argmax())
        members &= np.abs(points[:, 2] - place) < NEAR
        if np.mean(label[members] == below) > 0.5:
            continue  # steps that one plane was fitted through
        labels[patch] = len(planes) + len(level)
        of_point[members] = len(planes) + len(level)
        level.append((0.0, 0.0, place))
        taken_from.append(below)
    if not level:
        return None
    return LowPatches(replace(raster, label=labels), np.concatenate([planes, np.array(level)]), of_point,
                      np.array(taken_from))


def _standing(raster: LabelRaster, high: np.ndarray, count: int) -> np.ndarray:
    """Number (rows, columns) of each connected broad place of the cells `high`, 0 elsewhere and on patches."""
    side = max(round(HIGH_WIDTH / raster.cell), 1)
    mask = raster.inside & (raster.label < count) & high
    broad = cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_OPEN, np.ones((side, side), np.uint8))
    return ndimage.label(broad)[0]


def _level_of(z: np.ndarray) -> float | None:
    """Height (m) of a high patch by those (n,) of its points; None where they are few or of no one height."""
    if not len(z):
        return None
    place = float(np.median(z[z >= np.quantile(z, LOWER_SHARE)]))
    near = z[np.abs(z - place) < NEAR]
    return place if len(near) >= HIGH_POINTS and np.std(near) <= HIGH_SCATTER else None


def _filled(top: np.ndarray) -> np.ndarray:
    """Heights of cells; one without points, -inf, is as high as the nearest that has any."""
    nearest = ndimage.distance_transform_edt(~np.isfinite(top), return_distances=False, return_indices=True)
    return top[tuple(nearest)]


def _places(raster: LabelRaster, high: np.ndarray, height: np.ndarray, top: np.ndarray,
            count: int) -> list[tuple[float, np.ndarray]]:
    """Height (m) and cells of each connected low place that has one of the cells `high`.

    `top` : height of the highest point of each cell, -inf for none; a cell without points is as low as the nearest that
    has any. Cells of planes from `count` on are left out.
    """
    filled = _filled(top)
    reach = max(round(REACH / raster.cell), 1)
    window = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1, 2 * reach + 1))
    about = cv2.dilate(high.astype(np.uint8), window) > 0
    part, _ = ndimage.label(about & raster.inside & (raster.label < count) & (filled < height - CLEARANCE))
    found = []
    for number in np.unique(part[high & (part > 0)]):
        patch = part == number
        if np.count_nonzero(patch) * raster.cell**2 >= LEAST_AREA:
            of_patch = patch & np.isfinite(top)
            found.append((float(np.median(filled[of_patch if of_patch.any() else patch])), patch))
    return found


def _shown(raster: LabelRaster, polygons: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Plane (rows, columns) of the polygon at each cell; where there is none, the raster's own."""
    shown = np.maximum(raster.label, 0)
    row, column = np.nonzero(raster.inside)
    place, polygon = shapely.STRtree(polygons).query(shapely.points(raster.x[column], raster.y[row]),
                                                     predicate="intersects")
    shown[row[place], column[place]] = chosen[polygon]
    return shown
