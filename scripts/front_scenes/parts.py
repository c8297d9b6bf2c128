"""Flat faces that fronts are made of. Metres; x along the front, the street at y < 0, z from the ground."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from urbanmap_qgis.samplecity.laser.raycast import FaceGrid
from urbanmap_qgis.samplecity.scene.model import Faces

SOLID, WINDOWS, GLASS, FRAME = range(4)
"""What a face lets through: nothing; beams on its windows; most beams; nothing, but it stands before glass."""


@dataclass(frozen=True, eq=False)
class Face:
    """A flat face: its four corners (4, 3) in order, and what it lets through."""

    corners: np.ndarray
    kind: int = SOLID


def upright(x0: float, x1: float, y: float, low: float, high: float, kind: int = SOLID) -> Face:
    """A face along the street."""
    return Face(np.array([[x0, y, low], [x1, y, low], [x1, y, high], [x0, y, high]]), kind)


def side(x: float, y0: float, y1: float, low: float, high: float, kind: int = SOLID) -> Face:
    """A face across the street."""
    return Face(np.array([[x, y0, low], [x, y1, low], [x, y1, high], [x, y0, high]]), kind)


def level(x0: float, x1: float, y0: float, y1: float, z0: float, z1: float | None = None) -> Face:
    """A level face, or one that rises from `z0` at `y0` to `z1` at `y1`."""
    z1 = z0 if z1 is None else z1
    return Face(np.array([[x0, y0, z0], [x1, y0, z0], [x1, y1, z1], [x0, y1, z1]]))


def box(x0: float, x1: float, y0: float, y1: float, low: float, high: float, kind: int = SOLID) -> list[Face]:
    """All faces of a box but the one towards the ground where it stands there; only the street side has `kind`."""
    sides = [upright(x0, x1, y0, low, high, kind), upright(x0, x1, y1, low, high), side(x0, y0, y1, low, high),
             side(x1, y0, y1, low, high), level(x0, x1, y0, y1, high)]
    return sides + ([level(x0, x1, y0, y1, low)] if low > 0 else [])


def grid_of(faces: list[Face]) -> FaceGrid:
    """The faces, ready to be met by beams."""
    corners = np.array([face.corners for face in faces])
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    none = np.zeros(len(faces), np.uint8)
    return FaceGrid(Faces(corners, normal, (normal * corners[:, 0]).sum(axis=1), none, none,
                          np.zeros((len(faces), 3), np.uint8), none.astype(int), none.astype(int)))
