"""What bare ground looks like from above: asphalt with grain, wheel tracks and repairs, paving, plots and grass."""

from __future__ import annotations

import cv2
import numpy as np

from ..scene.ground import Surface
from ..scene.model import COLOUR, Material
from ..scene.world import Scene

COARSE = 4
"""Cells of the colours in a cell of the stains."""

TILE = 1024
"""Side of the grain, cells; it repeats."""

_PARKING = (94, 94, 96)
_GRAIN = {Surface.CARRIAGEWAY: 0.055, Surface.PAVEMENT: 0.035, Surface.PLOT: 0.04, Surface.PARKING: 0.05}

PARCEL = (27.0, 21.0)
"""Size of a parcel of open ground along u and v, m."""

_PARCELS = np.array([COLOUR[Material.PLOT], (138, 134, 128), (116, 114, 110), (104, 103, 102), (96, 96, 97),
                     (132, 118, 96), (84, 98, 58), (92, 104, 66)], np.float32)
"""Colours of parcels: concrete, gravel, asphalt, soil, grass."""

_GREEN = 6
"""From this parcel colour on it is grass, which is rougher than the rest."""


class GroundTexture:
    """Colours of the bare ground on a raster of `shape` cells of `cell` m with its corner at local `west`, `north`."""

    def __init__(self, scene: Scene, origin: np.ndarray, west: float, north: float, shape: tuple[int, int],
                 cell: float, rng: np.random.Generator):
        self._shape = shape
        grain = rng.standard_normal((TILE, TILE), np.float32)
        self._grain = 0.8 * grain + 0.6 * _spread(cv2.GaussianBlur(grain, (0, 0), 1.6, borderType=cv2.BORDER_REFLECT))
        coarse = (shape[0] // COARSE, shape[1] // COARSE)
        self._stain = 0.6 * _field(coarse, 0.5 / cell / COARSE, rng) + 0.8 * _field(coarse, 4.0 / cell / COARSE, rng)
        self._parcel = _parcels(scene, origin, west, north, coarse, cell * COARSE, rng)
        marks = _TrafficMarks(scene, origin, west, north, coarse, cell * COARSE, rng)
        self._traffic = marks.tracks
        self._repairs, self._covers = marks.repairs, marks.covers
        self._base = np.zeros((256, 3), np.float32)
        self._base[[Surface.CARRIAGEWAY, Surface.PAVEMENT, Surface.PLOT]] = COLOUR[
            [Material.ASPHALT, Material.PAVEMENT, Material.PLOT]]
        self._base[Surface.PARKING] = _PARKING
        self._rough = np.zeros(256, np.float32)
        self._rough[list(_GRAIN)] = list(_GRAIN.values())
        self._cell, self._west, self._north = cell, west, north

    def colour(self, strip: np.ndarray, kind: np.ndarray, top: int) -> None:
        """Fill a strip (rows, columns, 3) of the raster from row `top` on, whose `Surface` is `kind`."""
        rows, columns = kind.shape
        grain = np.tile(np.roll(self._grain, -(top % TILE), axis=0), (-(-rows // TILE), -(-columns // TILE)))
        stain = self._fine(self._stain, top, rows)
        road = (kind == Surface.CARRIAGEWAY).astype(np.float32)
        factor = 1.0 + self._rough[kind] * grain[:rows, :columns] + 0.035 * stain
        factor += road * (self._fine(self._traffic, top, rows) + self._shapes(top, rows))
        parcel = self._parcel[top // COARSE:(top + rows) // COARSE].repeat(COARSE, axis=0).repeat(COARSE, axis=1)
        parcel[kind != Surface.PLOT] = 0
        factor += (parcel > _GREEN) * (0.06 * grain[:rows, :columns] + 0.05 * stain)
        tone = np.concatenate([self._base, _PARCELS])
        which = np.where(parcel > 0, parcel + np.uint16(255), kind)
        for band in range(3):
            strip[..., band] = np.clip(tone[:, band][which] * factor, 0.0, 255.0)

    def _fine(self, coarse: np.ndarray, top: int, rows: int) -> np.ndarray:
        """Rows of a coarse field at the cells of the colours."""
        to_coarse = np.array([[1 / COARSE, 0.0, 0.5 / COARSE - 0.5], [0.0, 1 / COARSE, (top + 0.5) / COARSE - 0.5]])
        return cv2.warpAffine(coarse, to_coarse, (self._shape[1], rows),
                              flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP, borderMode=cv2.BORDER_REPLICATE)

    def _shapes(self, top: int, rows: int) -> np.ndarray:
        """Repairs (sharp quadrilaterals) and manhole covers as changes of the brightness."""
        image = np.zeros((rows, self._shape[1]), np.float32)
        for corners, change in self._repairs:
            self._fill(image, corners, top, change)
        for corners, change in self._covers:
            self._fill(image, corners, top, change)
        return image

    def _fill(self, image: np.ndarray, corners: np.ndarray, top: int, change: float) -> None:
        pixels = np.column_stack([(corners[:, 0] - self._west) / self._cell - 0.5,
                                  (self._north - corners[:, 1]) / self._cell - 0.5 - top])
        if pixels[:, 1].max() > -1 and pixels[:, 1].min() < len(image):
            cv2.fillConvexPoly(image, np.rint(pixels * 16).astype(np.int32), change, cv2.LINE_8, 4)


def _parcels(scene: Scene, origin: np.ndarray, west: float, north: float, shape: tuple[int, int], cell: float,
             rng: np.random.Generator) -> np.ndarray:
    """For each coarse cell 1 + the number of its parcel's colour, uint16. Parcels lie along the streets."""
    x = origin[0] + west + (np.arange(shape[1]) + 0.5) * cell
    y = origin[1] + north - (np.arange(shape[0]) + 0.5) * cell
    u, v = scene.ground.to_local(*np.meshgrid(x, y))
    shares = np.array([0.28, 0.16, 0.14, 0.1, 0.1, 0.1, 0.06, 0.06])
    table = rng.choice(len(_PARCELS), (64, 64), p=shares).astype(np.uint16) + np.uint16(1)
    row = np.floor(v / PARCEL[1]).astype(np.int32) & 63
    return table[row, np.floor(u / PARCEL[0] + 0.37 * row).astype(np.int32) & 63]


class _TrafficMarks:
    """What traffic and repairs leave on the lanes.

    Attributes
    ----------
    tracks : coarse raster.
    repairs, covers : local polygons; all as changes of the brightness.
    """

    def __init__(self, scene: Scene, origin: np.ndarray, west: float, north: float, shape: tuple[int, int],
                 cell: float, rng: np.random.Generator):
        self.tracks = np.zeros(shape, np.float32)
        self.repairs: list[tuple[np.ndarray, float]] = []
        self.covers: list[tuple[np.ndarray, float]] = []
        for lane in scene.lanes:
            start = np.array(lane.start) - origin
            along = (np.array(lane.end) - lane.start) / lane.length
            across = np.array([-along[1], along[0]])

            def to_plan(forward, left, start=start, along=along, across=across):
                return start + np.multiply.outer(forward, along) + np.multiply.outer(left, across)

            for left, width, change in ((0.78, 0.45, 0.05), (-0.78, 0.45, 0.05), (0.0, 0.5, -0.06)):
                ends = to_plan(np.array([0.0, lane.length]), np.full(2, left))
                pixels = np.column_stack([(ends[:, 0] - west) / cell - 0.5, (north - ends[:, 1]) / cell - 0.5])
                line = np.zeros(shape, np.uint8)
                cv2.line(line, *(tuple(int(v) for v in np.rint(p * 16)) for p in pixels), 255,
                         max(round(width / cell), 1), cv2.LINE_AA, 4)
                self.tracks += change / 255.0 * line
            for _ in range(rng.poisson(lane.length / 45.0)):
                length, width = rng.uniform(1.5, 9.0), rng.choice([0.6, 0.9, lane.width - 0.4])
                at, left = rng.uniform(0, lane.length - length), rng.uniform(-0.5, 0.5) * (lane.width - width)
                forward = np.array([0.0, length, length, 0.0]) + at
                side = np.array([-0.5, -0.5, 0.5, 0.5]) * width + left
                self.repairs.append((to_plan(forward, side), float(rng.choice([-0.16, -0.1, 0.1]))))
            turn = np.arange(16) * np.pi / 8
            for at in np.arange(rng.uniform(5.0, 40.0), lane.length, 38.0):
                left = rng.uniform(-0.4, 0.4)
                for radius, change in ((0.42, 0.12), (0.33, -0.3)):
                    self.covers.append((to_plan(at + radius * np.cos(turn), left + radius * np.sin(turn)), change))
        self.tracks = cv2.GaussianBlur(self.tracks, (0, 0), 0.8)


def _field(shape: tuple[int, int], spot: float, rng: np.random.Generator) -> np.ndarray:
    """A smooth random field of unit spread with spots of `spot` cells."""
    small = tuple(int(side / spot) + 4 for side in shape)
    field = cv2.resize(rng.standard_normal(small, np.float32), (shape[1], shape[0]), interpolation=cv2.INTER_CUBIC)
    return _spread(field)


def _spread(field: np.ndarray) -> np.ndarray:
    return (field / field.std()).astype(np.float32)
