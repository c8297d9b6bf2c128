"""What a surface is made of at a point: paint on the road, windows in the walls."""

from __future__ import annotations

import numpy as np

from ..scene.model import FaceKind, Faces, Material
from ..scene.world import Scene
from .raycast import Hit, Hits

WINDOW_PITCH, STOREY = 2.6, 3.5
"""Windows come every 2.6 m along a wall and every storey."""

WINDOW_WIDTH, SILL, LINTEL = 1.7, 1.0, 2.8
"""Width of a window, and its lower and upper edge above the storey's floor, m."""


def hit_material(scene: Scene, epoch: str, points: np.ndarray, hits: Hits) -> np.ndarray:
    """`Material` (n,) uint8 where beams ended at points (n, 3); 0 where a beam met nothing."""
    material = np.zeros(len(points), np.uint8)
    ground = hits.source == Hit.GROUND
    material[ground] = scene.ground_material(points[ground, 0], points[ground, 1], epoch)
    face = hits.source == Hit.FACE
    material[face] = face_material(scene, scene.static_faces(epoch), hits.index[face], points[face])
    material[hits.source == Hit.VEHICLE] = Material.VEHICLE
    material[hits.source == Hit.CROWN] = Material.FOLIAGE
    return material


def face_material(scene: Scene, faces: Faces, index: np.ndarray, points: np.ndarray) -> np.ndarray:
    """`Material` (n,) at points (n, 3) on the faces of the numbers `index` (n,), with the windows of walls."""
    material = faces.material[index].copy()
    wall = np.flatnonzero(faces.kind[index] == FaceKind.WALL)
    along, height = wall_coordinates(scene, faces, index[wall], points[wall])
    material[wall[is_window(along, height)]] = Material.GLASS
    return material


def wall_coordinates(scene: Scene, faces: Faces, index: np.ndarray,
                     points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Place along a wall from its left lower corner, and height above the building's foot, m, (n,) each."""
    start, end = faces.corners[index, 0, :2], faces.corners[index, 1, :2]
    direction = (end - start) / np.linalg.norm(end - start, axis=1, keepdims=True)
    foot = np.zeros(len(scene.buildings) + 1)
    foot[[building.id for building in scene.buildings]] = [building.z_base for building in scene.buildings]
    return np.einsum("ij,ij->i", points[:, :2] - start, direction), points[:, 2] - foot[faces.building[index]]


def is_window(along: np.ndarray, height: np.ndarray) -> np.ndarray:
    """Whether a window is at the place of a wall."""
    storey = height % STOREY
    return (along % WINDOW_PITCH > WINDOW_PITCH - WINDOW_WIDTH) & (storey > SILL) & (storey < LINTEL)
