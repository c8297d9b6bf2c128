"""Colours of faces and crowns in sun and shadow."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from ..scene.crowns import CROWN, Leaves
from ..scene.model import COLOUR, FaceKind, Faces, Material
from ..scene.world import Scene
from .sunlight import AMBIENT, DIRECT, ShadowMap

TEXTURE, TEXTURE_CELL = 1024, 0.1
"""Side (cells) and cell (m) of the stains on roofs; they repeat."""

STOREY, SILL, HEAD = 3.5, 0.95, 2.6
"""Height of a storey, of the lower and of the upper edge of its windows, m."""

GABLE_COURSE = 0.3
"""Of roof tiles, m."""

DECK = (8.0, 20.0)
"""Level tops of the elevated road between these widths (m) carry lanes."""


@dataclass(frozen=True)
class Surfaces:
    """Faces with all that their colour needs, by label. Plan coordinates are local."""

    colour: np.ndarray
    normal: np.ndarray
    corner: np.ndarray
    base: np.ndarray
    kind: np.ndarray
    material: np.ndarray
    style: np.ndarray
    direct: np.ndarray
    ambient: np.ndarray
    axes: np.ndarray
    width: np.ndarray

    @staticmethod
    def of(faces: Faces, scene: Scene, shadows: ShadowMap) -> Surfaces:
        """Prepare faces.

        `base` is the foot of a face's building, `style` a fixed random number of it in 0 to 1; `axes` (n, 2, 2)
        point along the longer and the shorter side in plan, `width` is the length of the shorter.
        """
        foot = np.array([0.0, *(building.z_base for building in scene.buildings)])
        level = faces.normal[:, 2:]
        axes, width = _axes(faces)
        sky = np.where(level < -0.5, 0.45, 0.72 + 0.28 * np.maximum(level, 0.0))
        return Surfaces(
            faces.colour.astype(np.float32), faces.normal.astype(np.float32),
            (faces.corners[:, 0] - [*shadows.origin, 0.0]).astype(np.float32),
            foot[np.maximum(faces.building, 0)].astype(np.float32), faces.kind, faces.material,
            (faces.building * 0.6180339887 % 1.0).astype(np.float32),
            (shadows.sun.strength(faces.normal)[:, None] * DIRECT).astype(np.float32),
            (sky * AMBIENT).astype(np.float32), axes.astype(np.float32), width.astype(np.float32))


class Shading:
    """Gives the light that comes from points on faces and crowns."""

    def __init__(self, surfaces: Surfaces, leaves: Leaves, shadows: ShadowMap, stains: np.ndarray):
        self._surfaces, self._leaves, self._shadows, self._stains = surfaces, leaves, shadows, stains

    def colour(self, label: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Colours (n, 3) float32 of local points (n, 3) on the things `label` (n,)."""
        crown = label >= CROWN
        if not crown.any():
            return self._faces(label, points)
        colour = np.empty((len(label), 3), np.float32)
        colour[~crown] = self._faces(label[~crown], points[~crown])
        colour[crown] = self._crowns(label[crown], points[crown])
        return colour

    def _faces(self, label: np.ndarray, points: np.ndarray) -> np.ndarray:
        surfaces = self._surfaces
        kind, material = surfaces.kind[label], surfaces.material[label]
        colour = surfaces.colour[label]
        stain = self._stain(points)
        rough = _ROUGH[kind]
        colour *= (1.0 + rough * stain)[:, None]
        walls = np.flatnonzero((kind == FaceKind.WALL) & (np.abs(surfaces.normal[label, 2]) < 0.1))
        if len(walls):
            colour[walls] = self._walls(label[walls], points[walls], colour[walls])
        tiles = np.flatnonzero((material == Material.ROOF) & (surfaces.normal[label, 2] < 0.995))
        if len(tiles):
            course = points[tiles, 2] / np.sqrt(1 - surfaces.normal[label[tiles], 2] ** 2) / GABLE_COURSE
            colour[tiles] *= (0.93 + 0.14 * (course % 1.0))[:, None]
        deck = np.flatnonzero((kind == FaceKind.BRIDGE) & (surfaces.normal[label, 2] > 0.9)
                              & (surfaces.width[label] > DECK[0]) & (surfaces.width[label] < DECK[1]))
        if len(deck):
            colour[deck] = self._deck(label[deck], points[deck], stain[deck])
        return colour * (surfaces.ambient[label] + surfaces.direct[label] * self._lit(label, points)[:, None])

    def _walls(self, label: np.ndarray, points: np.ndarray, colour: np.ndarray) -> np.ndarray:
        """Windows on walls: their pitch and width follow the building."""
        surfaces = self._surfaces
        normal, corner, style = surfaces.normal[label], surfaces.corner[label], surfaces.style[label]
        along = (points[:, 1] - corner[:, 1]) * normal[:, 0] - (points[:, 0] - corner[:, 0]) * normal[:, 1]
        up = points[:, 2] - surfaces.base[label]
        pitch, share = 1.8 + 2.4 * style, np.where(style > 0.75, 1.0, 0.5 + 0.4 * style)
        storey, column = np.floor(up / STOREY), np.floor(along / pitch)
        window = ((up - storey * STOREY > SILL) & (up - storey * STOREY < HEAD)
                  & (along - column * pitch < share * pitch))
        tone = np.abs(np.sin(storey * 12.9898 + column * 78.233) * 43758.5453) % 1.0
        glass = COLOUR[Material.GLASS].astype(np.float32) * (0.75 + 0.7 * tone * tone)[:, None]
        return np.where(window[:, None], glass, colour)

    def _deck(self, label: np.ndarray, points: np.ndarray, stain: np.ndarray) -> np.ndarray:
        """Asphalt with edge lines and a dashed line in the middle."""
        surfaces = self._surfaces
        offset = points[:, :2] - surfaces.corner[label, :2]
        along, across = (np.abs((offset * surfaces.axes[label, axis]).sum(axis=1)) for axis in (0, 1))
        edge = np.minimum(across, surfaces.width[label] - across)
        line = (np.abs(edge - 0.9) < 0.1) | ((np.abs(across - surfaces.width[label] / 2) < 0.08) & (along % 20.0 < 8.0))
        asphalt = COLOUR[Material.ASPHALT] * (1.05 + 0.07 * stain)[:, None]
        return np.where(line[:, None], COLOUR[Material.PAINT_WHITE] * 0.93, asphalt).astype(np.float32)

    def _crowns(self, label: np.ndarray, points: np.ndarray) -> np.ndarray:
        crown = label - CROWN
        normal = self._leaves.normal(crown, points)
        fine = self._stain(points * np.float32(3.0)) + 0.7 * self._stain(points * np.float32(9.0))
        facing = np.clip(0.35 + 0.65 * (normal @ self._shadows.sun.direction) + 0.16 * fine, 0.0, 1.3)
        lit = self._shadows.lit(points[:, 0], points[:, 1], points[:, 2], label, 0.5)
        light = AMBIENT * (0.45 + 0.4 * np.maximum(normal[:, 2:], 0.0)) + DIRECT * (facing * lit)[:, None]
        tint = (1.0 + 0.10 * np.sin(crown * 2.4))[:, None] * np.float32([1.0, 1.0, 0.95])
        return (COLOUR[Material.FOLIAGE] * tint * (1.0 + 0.2 * fine)[:, None] * light * 1.15).astype(np.float32)

    def _lit(self, label: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Share of sunlight: the mean over the corners of a square of half a shadow map's cell."""
        steep = np.abs(self._surfaces.normal[label] @ np.float32([*self._shadows.sun.lean, 1.0]))
        slack = 0.06 + 0.15 / np.maximum(steep, 0.08)
        x, y, z = points.T
        lit = np.zeros(len(label), np.float32)
        for step_x, step_y in ((-0.06, -0.06), (0.06, -0.06), (-0.06, 0.06), (0.06, 0.06)):
            lit += self._shadows.lit(x + np.float32(step_x), y + np.float32(step_y), z, label, slack)
        return lit * np.float32(0.25)

    def _stain(self, points: np.ndarray) -> np.ndarray:
        column = (points[:, 0] * np.float32(1 / TEXTURE_CELL)).astype(np.int32) & (TEXTURE - 1)
        row = (points[:, 1] * np.float32(1 / TEXTURE_CELL)).astype(np.int32) & (TEXTURE - 1)
        return self._stains[row, column]


def _axes(faces: Faces) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors in plan along the longer and the shorter of two neighbouring sides, and the shorter's length."""
    sides = np.stack([faces.corners[:, 1] - faces.corners[:, 0], faces.corners[:, 3] - faces.corners[:, 0]], 1)[..., :2]
    length = np.linalg.norm(sides, axis=2)
    order = np.argsort(-length, axis=1, kind="stable")
    axes = np.take_along_axis(sides / np.maximum(length, 1e-6)[..., None], order[..., None], axis=1)
    return axes, length.min(axis=1)


_ROUGH = np.zeros(256, np.float32)
_ROUGH[[FaceKind.ROOF, FaceKind.PARAPET_TOP, FaceKind.STRUCTURE, FaceKind.BRIDGE]] = (0.05, 0.015, 0.03, 0.04)


def make_stains(rng: np.random.Generator) -> np.ndarray:
    """Stains and grain of roofs, (TEXTURE, TEXTURE) float32 of unit spread, without a seam."""
    noise = rng.standard_normal((TEXTURE, TEXTURE), np.float32)
    total = 0.55 * noise
    for size, weight in ((3.0, 0.5), (12.0, 0.6), (40.0, 0.7)):
        reach = int(4 * size)
        wide = np.pad(rng.standard_normal((TEXTURE, TEXTURE), np.float32), reach, mode="wrap")
        smooth = cv2.GaussianBlur(wide, (0, 0), size)[reach:-reach, reach:-reach]
        total += np.float32(weight) * smooth / smooth.std()
    return (total / total.std()).astype(np.float32)
