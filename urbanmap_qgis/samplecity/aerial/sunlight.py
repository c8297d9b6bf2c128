"""Sunlight on the sample city: the light on a surface, and which places lie in a cast shadow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..scene.crowns import CROWN, Leaves
from ..scene.model import Crowns, Faces
from .depth_image import EMPTY, DepthImage

CELL = 0.10
"""Of the shadow map, m."""

DIRECT = np.array([0.68, 0.66, 0.62], np.float32)
AMBIENT = np.array([0.46, 0.48, 0.52], np.float32)
"""Shares of the sun and of the sky in the light on a level surface (red, green, blue)."""


@dataclass(frozen=True)
class Sun:
    """Azimuth clockwise from grid north and elevation above the horizon, degrees."""

    azimuth: float
    elevation: float

    @property
    def direction(self) -> np.ndarray:
        """Unit vector (3,) towards the sun."""
        azimuth, elevation = np.radians([self.azimuth, self.elevation])
        return np.array([np.sin(azimuth) * np.cos(elevation), np.cos(azimuth) * np.cos(elevation), np.sin(elevation)])

    @property
    def lean(self) -> np.ndarray:
        """Plan distance (2,) that a ray to the sun covers for a metre of height."""
        towards = self.direction
        return towards[:2] / towards[2]

    def strength(self, normal: np.ndarray) -> np.ndarray:
        """Direct light on lit faces with unit normals (..., 3), against that on a level surface."""
        return np.maximum(normal @ self.direction, 0.0) / self.direction[2]


class ShadowMap:
    """The height of what the sun's rays meet first, on the level plane z0 that they fall on.

    A place (x, y, z) belongs to the ray that meets the plane at (x, y) - lean (z - z0); it lies in shadow
    where something stands higher on that ray. Places are local: relative to `origin` in plan.
    """

    def __init__(self, sun: Sun, faces: Faces, crowns: Crowns, leaves: Leaves, origin: np.ndarray, z0: float):
        self.sun, self.origin, self.z0 = sun, origin, z0
        corners = faces.corners - [*origin, 0.0]
        centres = crowns.centre - [*origin, 0.0]
        reach = np.concatenate([self._fall(corners.reshape(-1, 3)),
                                self._fall(centres) + 6.0, self._fall(centres) - 6.0, np.zeros((1, 2))])
        self._west, self._north = reach[:, 0].min() - 15.0, reach[:, 1].max() + 15.0
        south, east = reach[:, 1].min() - 15.0, reach[:, 0].max() + 15.0
        shape = int(np.ceil((self._north - south) / CELL)), int(np.ceil((east - self._west) / CELL))
        self._image = DepthImage(np.full(shape, -np.inf, np.float32))
        self._draw_faces(faces, 0)
        self._draw_crowns(crowns, leaves)

    def with_faces(self, faces: Faces, first_label: int) -> ShadowMap:
        """The map with the shadows of more faces, labelled from `first_label`."""
        other = object.__new__(ShadowMap)
        other.__dict__.update(self.__dict__)
        other._image = self._image.copy()
        other._draw_faces(faces, first_label)
        return other

    def lit(self, x: np.ndarray, y: np.ndarray, z: np.ndarray, label: np.ndarray | int = EMPTY,
            slack: np.ndarray | float = 0.05) -> np.ndarray:
        """Whether the sun reaches local places; things `label` (their own) and within `slack` m cast no shadow."""
        column = (x - self.sun.lean[0] * (z - self.z0) - self._west) * (1 / CELL)
        row = (self._north - y + self.sun.lean[1] * (z - self.z0)) * (1 / CELL)
        rows, columns = self._image.label.shape
        place = (np.clip(row, 0, rows - 1).astype(np.int32) * columns
                 + np.clip(column, 0, columns - 1).astype(np.int32))
        lit = self._image.nearness.ravel()[place] <= z + slack
        if label is not EMPTY:
            lit |= self._image.label.ravel()[place] == label
        return lit

    def reach_of(self, corners: np.ndarray, z: float) -> np.ndarray:
        """Where the shadow of `corners` (..., 3) lies on the level z: local x_min, y_min, x_max, y_max."""
        fallen = self._fall(corners.reshape(-1, 3) - [*self.origin, 0.0]) + self.sun.lean * (z - self.z0)
        return np.concatenate([fallen.min(axis=0), fallen.max(axis=0)])

    def _fall(self, points: np.ndarray) -> np.ndarray:
        return points[:, :2] - self.sun.lean * (points[:, 2:] - self.z0)

    def _draw_faces(self, faces: Faces, first_label: int) -> None:
        """Draw faces; height over the map is (offset - n_h . q + n_h . lean z0) / (n . (lean, 1))."""
        corners = faces.corners - [*self.origin, 0.0]
        offset = faces.offset - faces.normal[:, :2] @ self.origin
        facing = faces.normal @ np.array([*self.sun.lean, 1.0])
        fallen = self._fall(corners.reshape(-1, 3)).reshape(-1, 4, 2)
        pixels = np.stack([(fallen[..., 0] - self._west) / CELL - 0.5, (self._north - fallen[..., 1]) / CELL - 0.5], -1)
        for i in np.flatnonzero(np.abs(facing) > 1e-6):
            a, b = -faces.normal[i, :2] / facing[i]
            c = (offset[i] + faces.normal[i, :2] @ self.sun.lean * self.z0) / facing[i]
            plane = np.array([a * CELL, -b * CELL,
                              c + a * (self._west + CELL / 2) + b * (self._north - CELL / 2)])
            self._image.draw_polygon(pixels[i], plane, first_label + i)

    def _draw_crowns(self, crowns: Crowns, leaves: Leaves) -> None:
        along = np.array([*self.sun.lean, 1.0])
        for k in range(len(crowns.centre)):
            centre = crowns.centre[k] - [*self.origin, 0.0]
            middle, half = self._fall(centre[None])[0], crowns.radii[k].max() * np.linalg.norm(along)
            left, top = (int((middle[0] - half - self._west) / CELL), int((self._north - middle[1] - half) / CELL))
            side = int(2 * half / CELL) + 2
            q_x = self._west + (left + np.arange(side) + 0.5) * CELL
            q_y = self._north - (top + np.arange(side) + 0.5) * CELL
            start = np.stack([*np.meshgrid(q_x, q_y), np.full((side, side), self.z0)], -1)
            _, leaving, inside = leaves.meet(k, start, np.broadcast_to(along, start.shape))
            self._image.draw_patch(top, left, (self.z0 + leaving).astype(np.float32), inside, CROWN + k)
